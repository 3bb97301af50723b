impl Top {
    #[allow(dead_code)]
    fn gyroscope(&self, q: &TopCoordinates) -> Isometry3<f64> {
        let attitude = Rotation3::from_axis_angle(&Vector3::z_axis(), q.phi)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), q.theta)
            * Rotation3::from_axis_angle(&Vector3::z_axis(), q.psi);
        Isometry3::from_parts(
            (attitude * Vector3::new(0.0, 0.0, self.arm)).into(),
            attitude.into(),
        )
    }
    #[allow(dead_code)]
    fn gravity(&self, q: &TopCoordinates) -> f64 {
        self.mass * self.g * self.arm * q.theta.cos()
    }
}
///Generalized coordinates of [`Top`].
#[allow(non_snake_case)]
pub struct TopCoordinates<R = f64> {
    ///`phi`
    pub phi: R,
    ///`theta`
    pub theta: R,
    ///`psi`
    pub psi: R,
}
impl<R: ::core::marker::Copy> ::core::marker::Copy for TopCoordinates<R> {}
impl<R: ::core::marker::Copy> ::core::clone::Clone for TopCoordinates<R> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: ::core::fmt::Debug> ::core::fmt::Debug for TopCoordinates<R> {
    fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
        f.debug_struct("TopCoordinates")
            .field("phi", &self.phi)
            .field("theta", &self.theta)
            .field("psi", &self.psi)
            .finish()
    }
}
impl<R> ::core::convert::From<[R; 3usize]> for TopCoordinates<R> {
    fn from([x0, x1, x2]: [R; 3usize]) -> Self {
        Self {
            phi: x0,
            theta: x1,
            psi: x2,
        }
    }
}
impl<R> ::core::convert::From<TopCoordinates<R>> for [R; 3usize] {
    fn from(TopCoordinates { phi: x0, theta: x1, psi: x2 }: TopCoordinates<R>) -> Self {
        [x0, x1, x2]
    }
}
///Generalized velocities of [`Top`].
#[allow(non_snake_case)]
pub struct TopVelocities<R = f64> {
    ///`phi`
    pub phi: R,
    ///`theta`
    pub theta: R,
    ///`psi`
    pub psi: R,
}
impl<R: ::core::marker::Copy> ::core::marker::Copy for TopVelocities<R> {}
impl<R: ::core::marker::Copy> ::core::clone::Clone for TopVelocities<R> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: ::core::fmt::Debug> ::core::fmt::Debug for TopVelocities<R> {
    fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
        f.debug_struct("TopVelocities")
            .field("phi", &self.phi)
            .field("theta", &self.theta)
            .field("psi", &self.psi)
            .finish()
    }
}
impl<R> ::core::convert::From<[R; 3usize]> for TopVelocities<R> {
    fn from([x0, x1, x2]: [R; 3usize]) -> Self {
        Self {
            phi: x0,
            theta: x1,
            psi: x2,
        }
    }
}
impl<R> ::core::convert::From<TopVelocities<R>> for [R; 3usize] {
    fn from(TopVelocities { phi: x0, theta: x1, psi: x2 }: TopVelocities<R>) -> Self {
        [x0, x1, x2]
    }
}
const _: () = {
    use ::lagrangian::__private as lagrange;
    #[automatically_derived]
    #[allow(clippy::all)]
    impl Top {
        /// The coordinates in the order of all vectors, to name the one that an error speaks of.
        pub const COORDINATES: [&'static str; 3usize] = ["phi", "theta", "psi"];
        /// Operations of one evaluation of the accelerations: all of them as derived, and as emitted without
        /// those done once per run. A factorisation in the runtime is in neither.
        pub const COST: lagrange::Costs = lagrange::Costs {
            before: lagrange::Cost::new(33u32, 66u32, 2u32, 0u32, 3u32),
            after: lagrange::Cost::new(4u32, 13u32, 1u32, 0u32, 1u32),
        };
        /// What was found in this system, and what its code therefore leaves out.
        pub const STRUCTURE: lagrange::Structure = lagrange::Structure {
            mass_matrix: "block diagonal, solved by a factorisation written out (2 × 2)",
            facts: &[
                "inertially decoupled blocks: phi, psi | theta",
                "conservative and autonomous: the energy is conserved",
                "cyclic coordinates: phi, psi",
                "smooth: a Taylor series of the motion takes 10 convolutions and the recurrences of 2 functions an order",
            ],
            skipped: &[
                "time: nothing depends on it",
                "inputs",
                "dissipation",
                "applied forces",
                "constraints and multipliers",
            ],
        };
        #[doc(hidden)]
        #[allow(
            unused,
            unused_qualifications,
            unused_results,
            non_snake_case,
            non_upper_case_globals
        )]
        fn __meanings() {
            let phi @ _ = ();
            let theta @ _ = ();
            let psi @ _ = ();
            let _: fn(
                &lagrange::nalgebra::Isometry3<f64>,
            ) -> lagrange::nalgebra::Isometry3<f64> = <Isometry3<f64>>::clone;
            let _: fn(
                &lagrange::nalgebra::Vector3<f64>,
            ) -> lagrange::nalgebra::Vector3<f64> = Vector3::clone;
            let _: fn(
                &lagrange::nalgebra::Rotation3<f64>,
            ) -> lagrange::nalgebra::Rotation3<f64> = Rotation3::clone;
        }
        /**Accelerations a that solve M(q, v, t) a = Q − ∂D/∂v − b(q, v, t).

The mass matrix is block diagonal, solved by a factorisation written out (2 × 2).

# Errors

A singular mass matrix, with the coordinate and the time.*/
        #[inline]
        pub fn accelerations(
            &self,
            state: &lagrange::State<f64, 3>,
        ) -> ::core::result::Result<[f64; 3], lagrange::MotionError<f64>> {
            lagrange::reading::checked(self, state, &[])?;
            let constants = lagrange::System::constants(self);
            let accelerations = lagrange::System::accelerations_at(
                self,
                &constants,
                state.t,
                &state.q,
                &state.v,
                &[],
            );
            lagrange::solve::finite(self, &constants, state, accelerations)
        }
        ///Mass matrix M = ∂²L/∂v∂v, symmetric, rows and columns in the order of the coordinates.
        #[inline]
        pub fn mass_matrix(
            &self,
            state: &lagrange::State<f64, 3>,
        ) -> lagrange::nalgebra::SMatrix<f64, 3, 3> {
            use lagrange::Real;
            let [_, theta, _] = state.q;
            let mass_2: f64 = self.mass;
            let across: f64 = self.across;
            let along: f64 = self.along;
            let arm: f64 = self.arm;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let w1 = across + mass_2 * (arm * arm);
            let mut mass = [[0.0; 3]; 3];
            mass[0][0] = along * (cos_theta * cos_theta) + w1 * (sin_theta * sin_theta);
            mass[1][1] = w1;
            mass[2][0] = along * cos_theta;
            mass[2][2] = along;
            lagrange::solve::symmetric(mass)
        }
        /**Bias b(q, v, t) = d/dt(∂L/∂v) − ∂L/∂q at zero accelerations: inertia forces that depend on velocity, and ∂V/∂q. The equations of motion are M a + b = Q − ∂D/∂v.

- `b(phi) = −theta′·sin(theta)·(psi′·along − 2·phi′·cos(theta)·(across − along + mass·arm^2))`
- `b(theta) = −sin(theta)·(mass·arm·g − phi′·(psi′·along − phi′·cos(theta)·(mass·arm^2 + (across − along))))`
- `b(psi) = −phi′·theta′·along·sin(theta)`*/
        #[inline]
        pub fn bias(&self, state: &lagrange::State<f64, 3>) -> [f64; 3] {
            use lagrange::Real;
            let [_, theta, _] = state.q;
            let [phi_dot, theta_dot, psi_dot] = state.v;
            let mass_2: f64 = self.mass;
            let across: f64 = self.across;
            let along: f64 = self.along;
            let arm: f64 = self.arm;
            let g: f64 = self.g;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let across_minus_along = across - along;
            let mass_2_arm_squared = mass_2 * (arm * arm);
            let phi_dot_cos_theta = phi_dot * cos_theta;
            let along_psi_dot = along * psi_dot;
            let w1 = phi_dot
                * (along_psi_dot
                    - (mass_2_arm_squared + across_minus_along) * phi_dot_cos_theta);
            let theta_dot_sin_theta = theta_dot * sin_theta;
            let w2 = (along_psi_dot
                - 2.0 * (across_minus_along + mass_2_arm_squared) * phi_dot_cos_theta)
                * theta_dot_sin_theta;
            [
                -w2,
                -(sin_theta * (mass_2 * arm * g - w1)),
                -(along * (phi_dot * theta_dot_sin_theta)),
            ]
        }
        /**Generalized momenta p = ∂L/∂v.

- `p(phi) = along·cos(theta)·(psi′ + phi′·cos(theta)) + phi′·sin(theta)^2·(across + mass·arm^2)`
- `p(theta) = theta′·(across + mass·arm^2)`
- `p(psi) = along·(psi′ + phi′·cos(theta))`*/
        #[inline]
        pub fn momenta(&self, state: &lagrange::State<f64, 3>) -> [f64; 3] {
            use lagrange::Real;
            let [_, theta, _] = state.q;
            let [phi_dot, theta_dot, psi_dot] = state.v;
            let mass_2: f64 = self.mass;
            let across: f64 = self.across;
            let along: f64 = self.along;
            let arm: f64 = self.arm;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let gyroscope_rate_z = psi_dot + phi_dot * cos_theta;
            let w1 = across + mass_2 * (arm * arm);
            [
                along * (cos_theta * gyroscope_rate_z)
                    + w1 * (phi_dot * (sin_theta * sin_theta)),
                w1 * theta_dot,
                along * gyroscope_rate_z,
            ]
        }
        ///Kinetic energy T \[J\].
        #[inline]
        pub fn kinetic_energy(&self, state: &lagrange::State<f64, 3>) -> f64 {
            use lagrange::Real;
            let [_, theta, _] = state.q;
            let [phi_dot, theta_dot, psi_dot] = state.v;
            let mass_2: f64 = self.mass;
            let across: f64 = self.across;
            let along: f64 = self.along;
            let arm: f64 = self.arm;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let phi_dot_cos_theta = phi_dot * cos_theta;
            let w1 = along
                * (psi_dot * psi_dot
                    + (2.0 * psi_dot + phi_dot_cos_theta) * phi_dot_cos_theta);
            let w2 = (across + mass_2 * (arm * arm))
                * (theta_dot * theta_dot + phi_dot * phi_dot * (sin_theta * sin_theta));
            0.5 * (w1 + w2)
        }
        /**Potential energy V \[J\].

`V = mass·cos(theta)·arm·g`*/
        #[inline]
        pub fn potential_energy(&self, state: &lagrange::State<f64, 3>) -> f64 {
            use lagrange::Real;
            let [_, theta, _] = state.q;
            let mass_2: f64 = self.mass;
            let arm: f64 = self.arm;
            let g: f64 = self.g;
            let cos_theta = Real::cos(theta);
            let gravity = mass_2 * arm * g * cos_theta;
            gravity
        }
        ///Energy T + V \[J\].
        #[inline]
        pub fn energy(&self, state: &lagrange::State<f64, 3>) -> f64 {
            self.kinetic_energy(state) + self.potential_energy(state)
        }
        /**The equations of motion as derived, M a + b = Q − ∂D/∂v + Aᵀλ, a line for each coordinate.

```text
(along·cos² θ + (across + mass·arm²) sin² θ) φ̈ + along·ψ̈ cos θ
      − along·θ̇ ψ̇ sin θ
      + 2 (across − along + mass·arm²) φ̇ θ̇ sin θ cos θ = 0
(across + mass·arm²) θ̈ − mass·arm·g sin θ + along·φ̇ ψ̇ sin θ
      − (mass·arm² + across − along) φ̇² sin θ cos θ = 0
along·φ̈ cos θ + along·ψ̈ − along·φ̇ θ̇ sin θ = 0
```*/
        pub const EQUATIONS: &'static str = {
            let text = "(along·cos² θ + (across + mass·arm²) sin² θ) φ\u{308} + along·ψ\u{308} cos θ − along·θ\u{307} ψ\u{307} sin θ + 2 (across − along + mass·arm²) φ\u{307} θ\u{307} sin θ cos θ = 0\n(across + mass·arm²) θ\u{308} − mass·arm·g sin θ + along·φ\u{307} ψ\u{307} sin θ − (mass·arm² + across − along) φ\u{307}² sin θ cos θ = 0\nalong·φ\u{308} cos θ + along·ψ\u{308} − along·φ\u{307} θ\u{307} sin θ = 0";
            text
        };
    }
    #[automatically_derived]
    #[allow(clippy::all)]
    impl lagrange::System<3usize, 0usize> for Top {
        type Scalar = f64;
        type Method = lagrange::Jets;
        type Constants = [f64; 4];
        const NAMES: lagrange::Names = lagrange::Names {
            coordinates: &["phi", "theta", "psi"],
            constraints: &[],
        };
        #[inline]
        fn constants(&self) -> Self::Constants {
            let mass_2: f64 = self.mass;
            let across: f64 = self.across;
            let along: f64 = self.along;
            let arm: f64 = self.arm;
            let g: f64 = self.g;
            let arm_squared = arm * arm;
            let mass_2_arm_squared = mass_2 * arm_squared;
            [
                mass_2_arm_squared + (across - along),
                mass_2 * arm * g,
                2.0 * across - along + 2.0 * mass_2 * arm_squared,
                1.0 / (across + mass_2_arm_squared),
            ]
        }
        #[inline]
        fn accelerations_at(
            &self,
            constants: &Self::Constants,
            _t: f64,
            q: &[f64; 3],
            v: &[f64; 3],
            _u: &[f64; 0],
        ) -> [f64; 3] {
            use lagrange::Real;
            let [_, theta, _] = *q;
            let [phi_dot, theta_dot, psi_dot] = *v;
            let along: f64 = self.along;
            let [w1, mass_2_arm_g, w2, w3] = *constants;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let phi_dot_cos_theta = phi_dot * cos_theta;
            let along_psi_dot = along * psi_dot;
            let w4 = (along_psi_dot - w2 * phi_dot_cos_theta) / sin_theta;
            [
                w3 * (theta_dot * w4),
                w3
                    * (sin_theta
                        * (mass_2_arm_g
                            - phi_dot * (along_psi_dot - w1 * phi_dot_cos_theta))),
                theta_dot * (phi_dot * sin_theta - w3 * (cos_theta * w4)),
            ]
        }
        fn check_at(
            &self,
            _constants: &Self::Constants,
            _t: f64,
            q: &[f64; 3],
            _v: &[f64; 3],
        ) -> ::core::result::Result<(), lagrange::Cause> {
            use lagrange::Real;
            let [_, theta, _] = *q;
            let mass_2: f64 = self.mass;
            let across: f64 = self.across;
            let along: f64 = self.along;
            let arm: f64 = self.arm;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let w1 = across + mass_2 * (arm * arm);
            let w2 = w1 * (sin_theta * sin_theta);
            lagrange::solve::check(along, along, 2)?;
            lagrange::solve::check(w2, along * (cos_theta * cos_theta) + w2, 0)?;
            lagrange::solve::check(w1, w1, 1)?;
            ::core::result::Result::Ok(())
        }
        #[inline]
        fn energy_at(
            &self,
            _constants: &Self::Constants,
            t: f64,
            q: &[f64; 3],
            v: &[f64; 3],
        ) -> f64 {
            self.energy(&lagrange::State { t, q: *q, v: *v })
        }
        #[cfg(debug_assertions)]
        const READ: bool = true;
        #[cfg(debug_assertions)]
        #[allow(unused_variables)]
        fn check_reading_at(
            &self,
            state: &lagrange::State<f64, 3>,
            inputs: &[f64; 0],
        ) -> ::core::result::Result<(), lagrange::Cause> {
            use lagrange::Real;
            let [phi, theta, psi] = state.q;
            let mass_2: f64 = self.mass;
            let arm: f64 = self.arm;
            let g: f64 = self.g;
            let (sin_phi, cos_phi) = Real::sin_cos(phi);
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let (sin_psi, cos_psi) = Real::sin_cos(psi);
            let cos_phi_cos_psi = cos_phi * cos_psi;
            let sin_phi_sin_psi = sin_phi * sin_psi;
            let attitude_00 = cos_phi_cos_psi - cos_theta * sin_phi_sin_psi;
            let cos_phi_sin_psi = cos_phi * sin_psi;
            let sin_phi_cos_psi = sin_phi * cos_psi;
            let attitude_10 = sin_phi_cos_psi + cos_theta * cos_phi_sin_psi;
            let abs_phi = Real::abs(phi);
            let abs_theta = Real::abs(theta);
            let abs_psi = Real::abs(psi);
            let abs_sin_phi = Real::abs(sin_phi);
            let abs_cos_phi = Real::abs(cos_phi);
            let w1 = abs_sin_phi + abs_phi * abs_cos_phi;
            let w2 = abs_cos_phi + abs_phi * abs_sin_phi;
            let abs_sin_theta = Real::abs(sin_theta);
            let abs_cos_theta = Real::abs(cos_theta);
            let w3 = abs_sin_theta + abs_theta * abs_cos_theta;
            let w4 = abs_cos_theta + abs_theta * abs_sin_theta;
            let abs_sin_psi = Real::abs(sin_psi);
            let abs_cos_psi = Real::abs(cos_psi);
            let w5 = abs_sin_psi + abs_psi * abs_cos_psi;
            let w6 = abs_cos_psi + abs_psi * abs_sin_psi;
            let w7 = w2 * w6;
            let w8 = w1 * w5;
            let w9 = w2 * w5;
            let w10 = w1 * w6;
            let abs_arm = Real::abs(arm);
            let attitude_02 = sin_phi * sin_theta;
            let gyroscope_x = arm * attitude_02;
            let sin_theta_cos_phi = sin_theta * cos_phi;
            let gyroscope_y = -(arm * sin_theta_cos_phi);
            let gyroscope_z = arm * cos_theta;
            let attitude_01 = -(cos_phi_sin_psi + cos_theta * sin_phi_cos_psi);
            let attitude_11 = -(sin_phi_sin_psi - cos_theta * cos_phi_cos_psi);
            let attitude_12 = -sin_theta_cos_phi;
            let attitude_20 = sin_theta * sin_psi;
            let attitude_21 = sin_theta * cos_psi;
            let gravity = mass_2 * arm * g * cos_theta;
            let w11 = w1 * w3;
            let w12 = w3 * w2;
            use lagrange::reading::Numbers;
            let __coordinates = <TopCoordinates<
                f64,
            > as ::core::convert::From<_>>::from(state.q);
            lagrange::reading::compare(
                lagrange::Function(&["gyroscope", lagrange::reading::MISREAD]),
                |take| self.gyroscope(&__coordinates).each_number(take),
                &[
                    gyroscope_x,
                    gyroscope_y,
                    gyroscope_z,
                    attitude_00,
                    attitude_01,
                    attitude_02,
                    attitude_10,
                    attitude_11,
                    attitude_12,
                    attitude_20,
                    attitude_21,
                    cos_theta,
                ],
                &[
                    abs_arm * w11,
                    abs_arm * w12,
                    abs_arm * w4,
                    w7 + w4 * w8,
                    w9 + w4 * w10,
                    w11,
                    w10 + w4 * w9,
                    w8 + w4 * w7,
                    w12,
                    w3 * w5,
                    w3 * w6,
                    w4,
                ],
            )?;
            lagrange::reading::compare(
                lagrange::Function(&["gravity", lagrange::reading::MISREAD]),
                |take| self.gravity(&__coordinates).each_number(take),
                &[gravity],
                &[abs_arm * Real::abs(mass_2) * Real::abs(g) * w4],
            )?;
            ::core::result::Result::Ok(())
        }
    }
    impl lagrange::Autonomous<3usize, 0usize> for Top {}
    impl lagrange::Conservative<3usize, 0usize> for Top {}
    impl lagrange::Holonomic<3usize, 0usize> for Top {}
    impl lagrange::Scleronomic<3usize, 0usize> for Top {}
    impl lagrange::Cyclic<3usize, 0usize> for Top {}
    #[automatically_derived]
    #[allow(clippy::all)]
    impl lagrange::Smooth<3usize, 0usize> for Top {
        type JetConstants = [f64; 4];
        type Tables<const ORDERS: usize> = lagrange::Tables<f64, 12, ORDERS>;
        #[inline]
        fn jet_constants(&self) -> [f64; 4] {
            use lagrange::Real;
            let mass_2: f64 = self.mass;
            let across: f64 = self.across;
            let along: f64 = self.along;
            let arm: f64 = self.arm;
            let g: f64 = self.g;
            let w1 = across + mass_2 * (arm * arm);
            [w1, mass_2 * arm * g, along - w1, Real::recip(w1)]
        }
        #[inline]
        fn jet_at<const ORDERS: usize>(
            &self,
            constants: &[f64; 4],
            _t: f64,
            q: &[f64; 3],
            v: &[f64; 3],
            _u: &[f64; 0],
            h: f64,
            orders: usize,
            tables: &mut lagrange::Tables<f64, 12, ORDERS>,
            series: &mut lagrange::Series<f64, 3, ORDERS>,
        ) -> bool {
            use lagrange::Real;
            let [_, theta, _] = *q;
            let [phi_dot, theta_dot, psi_dot] = *v;
            let along: f64 = self.along;
            let [w1, mass_2_arm_g, w2, w3] = *constants;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let phi_momentum_part = psi_dot + phi_dot * cos_theta;
            let phi_dot_squared = phi_dot * phi_dot;
            let theta_force_part = mass_2_arm_g - along * (phi_dot * psi_dot)
                - w2 * (phi_dot_squared * cos_theta);
            let sin_theta_plus_sin_theta = sin_theta + sin_theta;
            let phi_dot_plus_phi_dot = phi_dot + phi_dot;
            let mut mass = [[0.0; 2]; 2];
            mass[0][0] = along * (cos_theta * cos_theta) + w1 * (sin_theta * sin_theta);
            mass[1][0] = along * cos_theta;
            mass[1][1] = along;
            let ::core::option::Option::Some(phi_factors) = lagrange::solve::factor::<
                lagrange::Ldlt<f64, 2>,
                _,
                _,
            >(mass) else {
                return false;
            };
            let mut phi_dot_last: f64 = phi_dot;
            let mut phi_force: f64 = 0.0;
            let mut theta_dot_last: f64 = theta_dot;
            let mut theta_force: f64 = sin_theta * theta_force_part;
            let mut psi_dot_last: f64 = psi_dot;
            let mut sin_theta_flow: f64 = theta_dot * cos_theta;
            let mut cos_theta_flow: f64 = -(theta_dot * sin_theta);
            struct Products;
            impl lagrange::jets::Pairs<10> for Products {
                const FACTORS: &'static [[usize; 2]; 10] = &[
                    [0, 1],
                    [0, 2],
                    [2, 3],
                    [4, 4],
                    [0, 5],
                    [0, 0],
                    [6, 2],
                    [4, 7],
                    [8, 2],
                    [8, 4],
                ];
            }
            let mut products = lagrange::jets::Convolutions::new(tables, Products);
            lagrange::jets::in_line::<
                ORDERS,
            >(
                orders,
                #[inline(always)]
                |order| {
                    let rate: f64 = lagrange::jets::rate(h, order);
                    let inner = products.sums(order);
                    let phi_k = rate * phi_dot_last;
                    let theta_k = rate * theta_dot_last;
                    let psi_k = rate * psi_dot_last;
                    let sin_theta_k = rate * sin_theta_flow;
                    let cos_theta_k = rate * cos_theta_flow;
                    let sin_theta_squared_k = Real::mul_add(
                        sin_theta_plus_sin_theta,
                        sin_theta_k,
                        inner[3],
                    );
                    let phi_momentum_part_known = Real::mul_add(
                        phi_dot,
                        cos_theta_k,
                        inner[1],
                    );
                    let phi_momentum_part_partial = Real::mul_add(
                        cos_theta,
                        phi_momentum_part_known,
                        Real::mul_add(phi_momentum_part, cos_theta_k, inner[2]),
                    );
                    let phi_momentum_part_partial_2 = Real::mul_add(
                        -w1,
                        Real::mul_add(phi_dot, sin_theta_squared_k, inner[4]),
                        -(along * phi_momentum_part_partial),
                    );
                    let theta_dot_k = rate * theta_force * w3;
                    let w4 = Real::mul_add(phi_dot_squared, cos_theta_k, inner[6]);
                    let theta_force_part_known = Real::mul_add(
                        theta_force_part,
                        sin_theta_k,
                        inner[7],
                    );
                    let w5 = Real::mul_add(
                        cos_theta,
                        theta_dot_k,
                        Real::mul_add(theta_dot, cos_theta_k, inner[8]),
                    );
                    let w6 = Real::mul_add(
                        -sin_theta,
                        theta_dot_k,
                        Real::mul_add(-theta_dot, sin_theta_k, -inner[9]),
                    );
                    let [phi_dot_k, psi_dot_k] = phi_factors
                        .solve([
                            Real::mul_add(rate, phi_force, phi_momentum_part_partial_2),
                            Real::mul_add(
                                rate,
                                phi_force,
                                -(along * phi_momentum_part_known),
                            ),
                        ]);
                    series
                        .set(
                            order,
                            [phi_k, theta_k, psi_k],
                            [phi_dot_k, theta_dot_k, psi_dot_k],
                        );
                    if order == orders {
                        return false;
                    }
                    let phi_dot_squared_k = Real::mul_add(
                        phi_dot_plus_phi_dot,
                        phi_dot_k,
                        inner[5],
                    );
                    let theta_force_part_known_2 = along
                        * Real::mul_add(
                            psi_dot,
                            phi_dot_k,
                            Real::mul_add(phi_dot, psi_dot_k, inner[0]),
                        );
                    let theta_force_part_k = Real::mul_add(
                        -w2,
                        Real::mul_add(cos_theta, phi_dot_squared_k, w4),
                        -theta_force_part_known_2,
                    );
                    products
                        .add(
                            order,
                            [
                                phi_dot_k,
                                psi_dot_k,
                                cos_theta_k,
                                Real::mul_add(
                                    cos_theta,
                                    phi_dot_k,
                                    phi_momentum_part_known + psi_dot_k,
                                ),
                                sin_theta_k,
                                sin_theta_squared_k,
                                phi_dot_squared_k,
                                theta_force_part_k,
                                theta_dot_k,
                            ],
                        );
                    [
                        phi_dot_last,
                        phi_force,
                        theta_dot_last,
                        theta_force,
                        psi_dot_last,
                        sin_theta_flow,
                        cos_theta_flow,
                    ] = [
                        phi_dot_k,
                        0.0,
                        theta_dot_k,
                        Real::mul_add(
                            sin_theta,
                            theta_force_part_k,
                            theta_force_part_known,
                        ),
                        psi_dot_k,
                        w5,
                        w6,
                    ];
                    true
                },
            );
            true
        }
    }
};
