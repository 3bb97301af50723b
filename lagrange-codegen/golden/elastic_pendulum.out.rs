impl ElasticPendulum {
    #[allow(dead_code)]
    fn bob(&self, q: &ElasticPendulumCoordinates) -> Vector2<f64> {
        q.r * Vector2::new(q.theta.sin(), -q.theta.cos())
    }
    #[allow(dead_code)]
    fn gravity(&self, q: &ElasticPendulumCoordinates) -> f64 {
        self.mass * self.g * self.bob(q).y
    }
    #[allow(dead_code)]
    fn spring(&self, q: &ElasticPendulumCoordinates) -> f64 {
        0.5 * self.stiffness * (q.r - self.length).powi(2)
    }
    #[allow(dead_code)]
    fn motor(&self, u: &ElasticPendulumInputs) -> f64 {
        u.motor
    }
}
///Generalized coordinates of [`ElasticPendulum`].
#[allow(non_snake_case)]
pub struct ElasticPendulumCoordinates<R = f64> {
    ///`theta`
    pub theta: R,
    ///`r`
    pub r: R,
}
impl<R: ::core::marker::Copy> ::core::marker::Copy for ElasticPendulumCoordinates<R> {}
impl<R: ::core::marker::Copy> ::core::clone::Clone for ElasticPendulumCoordinates<R> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: ::core::fmt::Debug> ::core::fmt::Debug for ElasticPendulumCoordinates<R> {
    fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
        f.debug_struct("ElasticPendulumCoordinates")
            .field("theta", &self.theta)
            .field("r", &self.r)
            .finish()
    }
}
impl<R> ::core::convert::From<[R; 2usize]> for ElasticPendulumCoordinates<R> {
    fn from([x0, x1]: [R; 2usize]) -> Self {
        Self { theta: x0, r: x1 }
    }
}
impl<R> ::core::convert::From<ElasticPendulumCoordinates<R>> for [R; 2usize] {
    fn from(
        ElasticPendulumCoordinates { theta: x0, r: x1 }: ElasticPendulumCoordinates<R>,
    ) -> Self {
        [x0, x1]
    }
}
///Generalized velocities of [`ElasticPendulum`].
#[allow(non_snake_case)]
pub struct ElasticPendulumVelocities<R = f64> {
    ///`theta`
    pub theta: R,
    ///`r`
    pub r: R,
}
impl<R: ::core::marker::Copy> ::core::marker::Copy for ElasticPendulumVelocities<R> {}
impl<R: ::core::marker::Copy> ::core::clone::Clone for ElasticPendulumVelocities<R> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: ::core::fmt::Debug> ::core::fmt::Debug for ElasticPendulumVelocities<R> {
    fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
        f.debug_struct("ElasticPendulumVelocities")
            .field("theta", &self.theta)
            .field("r", &self.r)
            .finish()
    }
}
impl<R> ::core::convert::From<[R; 2usize]> for ElasticPendulumVelocities<R> {
    fn from([x0, x1]: [R; 2usize]) -> Self {
        Self { theta: x0, r: x1 }
    }
}
impl<R> ::core::convert::From<ElasticPendulumVelocities<R>> for [R; 2usize] {
    fn from(
        ElasticPendulumVelocities { theta: x0, r: x1 }: ElasticPendulumVelocities<R>,
    ) -> Self {
        [x0, x1]
    }
}
///Inputs of [`ElasticPendulum`].
#[allow(non_snake_case)]
pub struct ElasticPendulumInputs<R = f64> {
    ///`motor`
    pub motor: R,
}
impl<R: ::core::marker::Copy> ::core::marker::Copy for ElasticPendulumInputs<R> {}
impl<R: ::core::marker::Copy> ::core::clone::Clone for ElasticPendulumInputs<R> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: ::core::fmt::Debug> ::core::fmt::Debug for ElasticPendulumInputs<R> {
    fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
        f.debug_struct("ElasticPendulumInputs").field("motor", &self.motor).finish()
    }
}
impl<R> ::core::convert::From<[R; 1usize]> for ElasticPendulumInputs<R> {
    fn from([x0]: [R; 1usize]) -> Self {
        Self { motor: x0 }
    }
}
impl<R> ::core::convert::From<ElasticPendulumInputs<R>> for [R; 1usize] {
    fn from(ElasticPendulumInputs { motor: x0 }: ElasticPendulumInputs<R>) -> Self {
        [x0]
    }
}
const _: () = {
    use ::lagrangian::__private as lagrange;
    #[automatically_derived]
    #[allow(clippy::all)]
    impl ElasticPendulum {
        /// The coordinates in the order of all vectors, to name the one that an error speaks of.
        pub const COORDINATES: [&'static str; 2usize] = ["theta", "r"];
        /// Operations of one evaluation of the accelerations: all of them as derived, and as emitted without
        /// those done once per run. A factorisation in the runtime is in neither.
        pub const COST: lagrange::Costs = lagrange::Costs {
            before: lagrange::Cost::new(10u32, 22u32, 2u32, 0u32, 1u32),
            after: lagrange::Cost::new(5u32, 10u32, 1u32, 0u32, 1u32),
        };
        /// What was found in this system, and what its code therefore leaves out.
        pub const STRUCTURE: lagrange::Structure = lagrange::Structure {
            mass_matrix: "diagonal, solved by divisions",
            facts: &[
                "smooth: a Taylor series of the motion takes 7 convolutions and the recurrences of 2 functions an order",
            ],
            skipped: &[
                "time: nothing depends on it",
                "dissipation",
                "the solution of a linear system: the mass matrix is diagonal",
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
            let theta @ _ = ();
            let r @ _ = ();
            let motor @ _ = ();
            let _: fn(
                &lagrange::nalgebra::Vector2<f64>,
            ) -> lagrange::nalgebra::Vector2<f64> = <Vector2<f64>>::clone;
        }
        /**Accelerations a that solve M(q, v, t) a = Q − ∂D/∂v − b(q, v, t).

The mass matrix is diagonal, solved by divisions.

# Errors

A singular mass matrix, with the coordinate and the time.*/
        #[inline]
        pub fn accelerations(
            &self,
            state: &lagrange::State<f64, 2>,
            inputs: &[f64; 1],
        ) -> ::core::result::Result<[f64; 2], lagrange::MotionError<f64>> {
            lagrange::reading::checked(self, state, inputs)?;
            let constants = lagrange::System::constants(self);
            let accelerations = lagrange::System::accelerations_at(
                self,
                &constants,
                state.t,
                &state.q,
                &state.v,
                inputs,
            );
            lagrange::solve::finite(self, &constants, state, accelerations)
        }
        ///Mass matrix M = ∂²L/∂v∂v, symmetric, rows and columns in the order of the coordinates.
        #[inline]
        pub fn mass_matrix(
            &self,
            state: &lagrange::State<f64, 2>,
        ) -> lagrange::nalgebra::SMatrix<f64, 2, 2> {
            let [_, r] = state.q;
            let mass_2: f64 = self.mass;
            let mut mass = [[0.0; 2]; 2];
            mass[0][0] = mass_2 * (r * r);
            mass[1][1] = mass_2;
            lagrange::solve::symmetric(mass)
        }
        /**Bias b(q, v, t) = d/dt(∂L/∂v) − ∂L/∂q at zero accelerations: inertia forces that depend on velocity, and ∂V/∂q. The equations of motion are M a + b = Q − ∂D/∂v.

- `b(theta) = r·mass·(sin(theta)·g + 2·theta′·r′)`
- `b(r) = r·(stiffness − theta′^2·mass) − (mass·cos(theta)·g + stiffness·length)`*/
        #[inline]
        pub fn bias(&self, state: &lagrange::State<f64, 2>) -> [f64; 2] {
            use lagrange::Real;
            let [theta, r] = state.q;
            let [theta_dot, r_dot] = state.v;
            let mass_2: f64 = self.mass;
            let g: f64 = self.g;
            let stiffness: f64 = self.stiffness;
            let length: f64 = self.length;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            [
                mass_2 * (r * (g * sin_theta + 2.0 * (theta_dot * r_dot))),
                r * (stiffness - mass_2 * (theta_dot * theta_dot))
                    - (mass_2 * g * cos_theta + stiffness * length),
            ]
        }
        /**Generalized applied forces Q − ∂D/∂v.

- `Q(theta) = motor`
- `Q(r) = 0`*/
        #[inline]
        pub fn applied_forces(
            &self,
            _state: &lagrange::State<f64, 2>,
            inputs: &[f64; 1],
        ) -> [f64; 2] {
            let [motor] = *inputs;
            [motor, 0.0]
        }
        /**Generalized momenta p = ∂L/∂v.

- `p(theta) = r^2·theta′·mass`
- `p(r) = r′·mass`*/
        #[inline]
        pub fn momenta(&self, state: &lagrange::State<f64, 2>) -> [f64; 2] {
            let [_, r] = state.q;
            let [theta_dot, r_dot] = state.v;
            let mass_2: f64 = self.mass;
            [mass_2 * (r * r * theta_dot), mass_2 * r_dot]
        }
        /**Kinetic energy T \[J\].

`T = 0.5·mass·(r′^2 + r^2·theta′^2)`*/
        #[inline]
        pub fn kinetic_energy(&self, state: &lagrange::State<f64, 2>) -> f64 {
            let [_, r] = state.q;
            let [theta_dot, r_dot] = state.v;
            let mass_2: f64 = self.mass;
            0.5 * mass_2 * (r_dot * r_dot + r * r * (theta_dot * theta_dot))
        }
        /**Potential energy V \[J\].

`V = −(r·mass·cos(theta)·g − 0.5·stiffness·(r − length)^2)`*/
        #[inline]
        pub fn potential_energy(&self, state: &lagrange::State<f64, 2>) -> f64 {
            use lagrange::Real;
            let [theta, r] = state.q;
            let mass_2: f64 = self.mass;
            let g: f64 = self.g;
            let stiffness: f64 = self.stiffness;
            let length: f64 = self.length;
            let r_minus_length = r - length;
            let w1 = mass_2 * g * (r * Real::cos(theta))
                - 0.5 * stiffness * (r_minus_length * r_minus_length);
            -w1
        }
        /**Power v·(Q − ∂D/∂v) of the applied forces \[W\].

`P = theta′·motor`*/
        #[inline]
        pub fn power(&self, state: &lagrange::State<f64, 2>, inputs: &[f64; 1]) -> f64 {
            let [theta_dot, _] = state.v;
            let [motor] = *inputs;
            theta_dot * motor
        }
        ///Energy T + V \[J\].
        #[inline]
        pub fn energy(&self, state: &lagrange::State<f64, 2>) -> f64 {
            self.kinetic_energy(state) + self.potential_energy(state)
        }
        /**The equations of motion as derived, M a + b = Q − ∂D/∂v + Aᵀλ, a line for each coordinate.

```text
mass·r² θ̈ + mass·g r sin θ + 2 mass·r θ̇ ṙ = motor
mass·r̈ + stiffness·r − mass·r θ̇² − mass·g cos θ − stiffness·length
      = 0
```*/
        pub const EQUATIONS: &'static str = {
            let text = "mass·r² θ\u{308} + mass·g r sin θ + 2 mass·r θ\u{307} r\u{307} = motor\nmass·r\u{308} + stiffness·r − mass·r θ\u{307}² − mass·g cos θ − stiffness·length = 0";
            text
        };
    }
    #[automatically_derived]
    #[allow(clippy::all)]
    impl lagrange::System<2usize, 1usize> for ElasticPendulum {
        type Scalar = f64;
        type Method = lagrange::Jets;
        type Constants = [f64; 3];
        const NAMES: lagrange::Names = lagrange::Names {
            coordinates: &["theta", "r"],
            constraints: &[],
        };
        #[inline]
        fn constants(&self) -> Self::Constants {
            let mass_2: f64 = self.mass;
            let stiffness: f64 = self.stiffness;
            let length: f64 = self.length;
            [stiffness / mass_2, stiffness * length / mass_2, 1.0 / mass_2]
        }
        #[inline]
        fn accelerations_at(
            &self,
            constants: &Self::Constants,
            _t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
            u: &[f64; 1],
        ) -> [f64; 2] {
            use lagrange::Real;
            let [theta, r] = *q;
            let [theta_dot, r_dot] = *v;
            let [motor] = *u;
            let mass_2: f64 = self.mass;
            let g: f64 = self.g;
            let [stiffness_over_mass_2, w1, inverse_mass_2] = *constants;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let w2 = inverse_mass_2
                * (motor - mass_2 * (r * (g * sin_theta + 2.0 * (theta_dot * r_dot))));
            [
                w2 / (r * r),
                r * (theta_dot * theta_dot - stiffness_over_mass_2)
                    + (g * cos_theta + w1),
            ]
        }
        fn check_at(
            &self,
            _constants: &Self::Constants,
            _t: f64,
            q: &[f64; 2],
            _v: &[f64; 2],
        ) -> ::core::result::Result<(), lagrange::Cause> {
            let [_, r] = *q;
            let mass_2: f64 = self.mass;
            let mass_2_r_squared = mass_2 * (r * r);
            lagrange::solve::check(mass_2_r_squared, mass_2_r_squared, 0)?;
            lagrange::solve::check(mass_2, mass_2, 1)?;
            ::core::result::Result::Ok(())
        }
        #[inline]
        fn energy_at(
            &self,
            _constants: &Self::Constants,
            t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
        ) -> f64 {
            self.energy(&lagrange::State { t, q: *q, v: *v })
        }
        #[cfg(debug_assertions)]
        const READ: bool = true;
        #[cfg(debug_assertions)]
        #[allow(unused_variables)]
        fn check_reading_at(
            &self,
            state: &lagrange::State<f64, 2>,
            inputs: &[f64; 1],
        ) -> ::core::result::Result<(), lagrange::Cause> {
            use lagrange::Real;
            let [theta, r] = state.q;
            let [motor] = *inputs;
            let mass_2: f64 = self.mass;
            let g: f64 = self.g;
            let stiffness: f64 = self.stiffness;
            let length: f64 = self.length;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let r_minus_length = r - length;
            let abs_theta = Real::abs(theta);
            let abs_r = Real::abs(r);
            let abs_sin_theta = Real::abs(sin_theta);
            let abs_cos_theta = Real::abs(cos_theta);
            let abs_r_plus_abs_length = abs_r + Real::abs(length);
            let bob_x = r * sin_theta;
            let r_cos_theta = r * cos_theta;
            let bob_y = -r_cos_theta;
            let gravity = -(mass_2 * g * r_cos_theta);
            let spring = 0.5 * stiffness * (r_minus_length * r_minus_length);
            let w1 = abs_r * (abs_cos_theta + abs_theta * abs_sin_theta);
            use lagrange::reading::Numbers;
            let __coordinates = <ElasticPendulumCoordinates<
                f64,
            > as ::core::convert::From<_>>::from(state.q);
            let __inputs = <ElasticPendulumInputs<
                f64,
            > as ::core::convert::From<_>>::from(*inputs);
            lagrange::reading::compare(
                lagrange::Function(&["bob", lagrange::reading::MISREAD]),
                |take| self.bob(&__coordinates).each_number(take),
                &[bob_x, bob_y],
                &[abs_r * (abs_sin_theta + abs_theta * abs_cos_theta), w1],
            )?;
            lagrange::reading::compare(
                lagrange::Function(&["gravity", lagrange::reading::MISREAD]),
                |take| self.gravity(&__coordinates).each_number(take),
                &[gravity],
                &[Real::abs(mass_2) * Real::abs(g) * w1],
            )?;
            lagrange::reading::compare(
                lagrange::Function(&["spring", lagrange::reading::MISREAD]),
                |take| self.spring(&__coordinates).each_number(take),
                &[spring],
                &[
                    0.5 * Real::abs(stiffness)
                        * (abs_r_plus_abs_length * abs_r_plus_abs_length),
                ],
            )?;
            lagrange::reading::compare(
                lagrange::Function(&["motor", lagrange::reading::MISREAD]),
                |take| self.motor(&__inputs).each_number(take),
                &[motor],
                &[Real::abs(motor)],
            )?;
            ::core::result::Result::Ok(())
        }
    }
    impl lagrange::Autonomous<2usize, 1usize> for ElasticPendulum {}
    impl lagrange::Holonomic<2usize, 1usize> for ElasticPendulum {}
    impl lagrange::Scleronomic<2usize, 1usize> for ElasticPendulum {}
    #[automatically_derived]
    #[allow(clippy::all)]
    impl lagrange::Smooth<2usize, 1usize> for ElasticPendulum {
        type JetConstants = [f64; 3];
        type Tables<const ORDERS: usize> = lagrange::Tables<f64, 8, ORDERS>;
        #[inline]
        fn jet_constants(&self) -> [f64; 3] {
            use lagrange::Real;
            let mass_2: f64 = self.mass;
            let g: f64 = self.g;
            let stiffness: f64 = self.stiffness;
            let length: f64 = self.length;
            [mass_2 * g, stiffness * length, Real::recip(mass_2)]
        }
        #[inline]
        fn jet_at<const ORDERS: usize>(
            &self,
            constants: &[f64; 3],
            _t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
            u: &[f64; 1],
            h: f64,
            orders: usize,
            tables: &mut lagrange::Tables<f64, 8, ORDERS>,
            series: &mut lagrange::Series<f64, 2, ORDERS>,
        ) -> bool {
            use lagrange::Real;
            let [theta, r] = *q;
            let [theta_dot, r_dot] = *v;
            let [motor] = *u;
            let mass_2: f64 = self.mass;
            let stiffness: f64 = self.stiffness;
            let [mass_2_g, stiffness_length, inverse_mass_2] = *constants;
            let r_force_part = stiffness - mass_2 * (theta_dot * theta_dot);
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let inverse_mass_2_r_squared = Real::recip(mass_2 * (r * r));
            let r_plus_r = r + r;
            let theta_dot_plus_theta_dot = theta_dot + theta_dot;
            let mut theta_dot_last: f64 = theta_dot;
            let mut theta_force: f64 = motor - mass_2_g * (r * sin_theta);
            let mut r_dot_last: f64 = r_dot;
            let mut r_force: f64 = -(r * r_force_part
                - (mass_2_g * cos_theta + stiffness_length));
            let mut sin_theta_flow: f64 = theta_dot * cos_theta;
            let mut cos_theta_flow: f64 = -(theta_dot * sin_theta);
            struct Products;
            impl lagrange::jets::Pairs<7> for Products {
                const FACTORS: &'static [[usize; 2]; 7] = &[
                    [0, 0],
                    [1, 2],
                    [1, 3],
                    [1, 1],
                    [4, 0],
                    [0, 5],
                    [0, 3],
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
                    let theta_k = rate * theta_dot_last;
                    let r_k = rate * r_dot_last;
                    let sin_theta_k = rate * sin_theta_flow;
                    let cos_theta_k = rate * cos_theta_flow;
                    let r_squared_k = Real::mul_add(r_plus_r, r_k, inner[3]);
                    let w1 = Real::mul_add(
                        rate,
                        theta_force,
                        -(mass_2 * Real::mul_add(theta_dot, r_squared_k, inner[4])),
                    );
                    let theta_dot_k = w1 * inverse_mass_2_r_squared;
                    let r_dot_k = rate * r_force * inverse_mass_2;
                    let r_force_part_known = mass_2
                        * Real::mul_add(theta_dot_plus_theta_dot, theta_dot_k, inner[0]);
                    let theta_force_part_known = mass_2_g
                        * Real::mul_add(
                            sin_theta,
                            r_k,
                            Real::mul_add(r, sin_theta_k, inner[2]),
                        );
                    let w2 = Real::mul_add(
                        -r,
                        -r_force_part_known,
                        Real::mul_add(
                            mass_2_g,
                            cos_theta_k,
                            Real::mul_add(-r_force_part, r_k, -inner[1]),
                        ),
                    );
                    let w3 = Real::mul_add(
                        cos_theta,
                        theta_dot_k,
                        Real::mul_add(theta_dot, cos_theta_k, inner[5]),
                    );
                    let w4 = Real::mul_add(
                        -sin_theta,
                        theta_dot_k,
                        Real::mul_add(-theta_dot, sin_theta_k, -inner[6]),
                    );
                    series.set(order, [theta_k, r_k], [theta_dot_k, r_dot_k]);
                    if order == orders {
                        return false;
                    }
                    products
                        .add(
                            order,
                            [
                                theta_dot_k,
                                r_k,
                                -r_force_part_known,
                                sin_theta_k,
                                r_squared_k,
                                cos_theta_k,
                            ],
                        );
                    [
                        theta_dot_last,
                        theta_force,
                        r_dot_last,
                        r_force,
                        sin_theta_flow,
                        cos_theta_flow,
                    ] = [theta_dot_k, -theta_force_part_known, r_dot_k, w2, w3, w4];
                    true
                },
            );
            true
        }
    }
    #[automatically_derived]
    #[allow(clippy::all, unused_variables)]
    impl lagrange::Linearized<2usize, 1usize> for ElasticPendulum {
        #[inline]
        fn residual_at(
            &self,
            _constants: &Self::Constants,
            t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
            accelerations: &[f64; 2],
            u: &[f64; 1],
        ) -> [f64; 2] {
            use lagrange::Real;
            let [theta, r] = *q;
            let [theta_dot, r_dot] = *v;
            let [theta_ddot, r_ddot] = *accelerations;
            let [motor] = *u;
            let mass_2: f64 = self.mass;
            let g: f64 = self.g;
            let stiffness: f64 = self.stiffness;
            let length: f64 = self.length;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let w1 = r * (stiffness - mass_2 * (theta_dot * theta_dot))
                - (mass_2 * g * cos_theta + stiffness * length);
            [
                motor
                    - mass_2
                        * (r
                            * (g * sin_theta + 2.0 * (theta_dot * r_dot)
                                + r * theta_ddot)),
                -(w1 + mass_2 * r_ddot),
            ]
        }
        #[inline]
        fn linearization_at(
            &self,
            _constants: &Self::Constants,
            t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
            accelerations: &[f64; 2],
            u: &[f64; 1],
        ) -> lagrange::Linearization<f64, 2> {
            use lagrange::Real;
            let [theta, r] = *q;
            let [theta_dot, r_dot] = *v;
            let [theta_ddot, _] = *accelerations;
            let mass_2: f64 = self.mass;
            let g: f64 = self.g;
            let stiffness: f64 = self.stiffness;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let mass_2_g = mass_2 * g;
            let gravity = -(mass_2_g * (r * cos_theta));
            let n2_mass_2 = 2.0 * mass_2;
            let n2_mass_2_r_theta_dot = n2_mass_2 * (r * theta_dot);
            let mut matrices = lagrange::Linearization {
                mass: [[0.0; 2]; 2],
                by_q: [[0.0; 2]; 2],
                by_v: [[0.0; 2]; 2],
            };
            matrices.mass[0][0] = mass_2 * (r * r);
            matrices.mass[1][1] = mass_2;
            matrices.by_q[0][0] = gravity;
            matrices.by_q[0][1] = -(mass_2
                * (g * sin_theta + 2.0 * (theta_dot * r_dot) + 2.0 * (r * theta_ddot)));
            matrices.by_q[1][0] = -(mass_2_g * sin_theta);
            matrices.by_q[1][1] = -(stiffness - mass_2 * (theta_dot * theta_dot));
            matrices.by_v[0][0] = -(n2_mass_2 * (r * r_dot));
            matrices.by_v[0][1] = -n2_mass_2_r_theta_dot;
            matrices.by_v[1][0] = n2_mass_2_r_theta_dot;
            matrices
        }
        #[inline]
        fn by_inputs_at(
            &self,
            _constants: &Self::Constants,
            t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
            u: &[f64; 1],
        ) -> [[f64; 1]; 2] {
            [[1.0], [0.0]]
        }
    }
    #[automatically_derived]
    #[allow(clippy::all, unused_variables)]
    impl lagrange::Tangent<2usize, 1usize, 0usize> for ElasticPendulum {
        const HOLONOMIC: [bool; 0] = [];
        const TURNS: [bool; 0] = [];
        #[inline]
        fn balanced_at(
            &self,
            constants: &Self::Constants,
            t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
            u: &[f64; 1],
        ) -> lagrange::Balance<f64, 2, 0> {
            lagrange::Balance {
                accelerations: <Self as lagrange::System<
                    2,
                    1,
                >>::accelerations_at(self, constants, t, q, v, u),
                multipliers: [],
                independence: lagrange::Independence::clear(0),
            }
        }
        #[inline]
        fn deviations_at(
            &self,
            t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
        ) -> lagrange::Residuals<f64, 0> {
            lagrange::Residuals {
                positions: [],
                position_sizes: [],
                rates: [],
                rate_sizes: [],
            }
        }
        #[inline]
        fn imbalance_at(
            &self,
            constants: &Self::Constants,
            place: &lagrange::Place<'_, f64, 2, 1, 0>,
        ) -> lagrange::Imbalance<f64, 2, 0> {
            lagrange::Imbalance {
                forces: <Self as lagrange::Linearized<
                    2,
                    1,
                >>::residual_at(
                    self,
                    constants,
                    place.t,
                    place.q,
                    place.v,
                    place.a,
                    place.u,
                ),
                conditions: [],
            }
        }
        #[inline]
        fn variation_at(
            &self,
            constants: &Self::Constants,
            place: &lagrange::Place<'_, f64, 2, 1, 0>,
        ) -> lagrange::Variation<f64, 2, 1, 0> {
            let lagrange::Place { t, q, v, a: accelerations, multipliers, u } = *place;
            let mut matrices = lagrange::Variation::zero();
            let linearization = <Self as lagrange::Linearized<
                2,
                1,
            >>::linearization_at(
                self,
                constants,
                place.t,
                place.q,
                place.v,
                place.a,
                place.u,
            );
            *matrices.mass = linearization.mass;
            *matrices.by_q = linearization.by_q;
            *matrices.by_v = linearization.by_v;
            *matrices.by_u = <Self as lagrange::Linearized<
                2,
                1,
            >>::by_inputs_at(self, constants, place.t, place.q, place.v, place.u);
            matrices
        }
    }
    #[automatically_derived]
    #[allow(clippy::all, unused_variables)]
    impl lagrange::Parametric<2usize, 1usize, 0usize, 0usize> for ElasticPendulum {
        #[inline]
        fn by_parameters_at(
            &self,
            constants: &Self::Constants,
            place: &lagrange::Place<'_, f64, 2, 1, 0>,
        ) -> lagrange::ByParameters<f64, 2, 0, 0> {
            lagrange::ByParameters::zero()
        }
    }
    #[automatically_derived]
    #[allow(clippy::all, unused_variables)]
    impl lagrange::Sensitive<2usize, 1usize, 0usize, 0usize, 4usize>
    for ElasticPendulum {
        const PARAMETERS: [&'static str; 0] = [];
        type Over<__Other: lagrange::Real> = __Over<__Other>;
        fn over<__Other: lagrange::Real>(
            &self,
            mut __parameter: impl ::core::ops::FnMut(
                f64,
                ::core::option::Option<usize>,
            ) -> __Other,
        ) -> __Over<__Other> {
            let mass_2: f64 = self.mass;
            let g: f64 = self.g;
            let stiffness: f64 = self.stiffness;
            let length: f64 = self.length;
            __Over {
                parameters: [
                    __parameter(mass_2, ::core::option::Option::None),
                    __parameter(g, ::core::option::Option::None),
                    __parameter(stiffness, ::core::option::Option::None),
                    __parameter(length, ::core::option::Option::None),
                ],
            }
        }
    }
    #[doc(hidden)]
    #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
    pub struct __Over<R> {
        parameters: [R; 4usize],
    }
    #[automatically_derived]
    #[allow(clippy::all)]
    impl<R: lagrange::Real> __Over<R> {
        #[inline]
        fn energy(&self, state: &lagrange::State<R, 2>) -> R {
            use lagrange::Real;
            let [theta, r] = state.q;
            let [theta_dot, r_dot] = state.v;
            let mass_2: R = self.parameters[0];
            let g: R = self.parameters[1];
            let stiffness: R = self.parameters[2];
            let length: R = self.parameters[3];
            let r_minus_length = r - length;
            let w1 = mass_2 * g * (r * Real::cos(theta))
                - <R as lagrange::Real>::from_f64(0.5) * stiffness
                    * (r_minus_length * r_minus_length);
            <R as lagrange::Real>::from_f64(0.5) * mass_2
                * (r_dot * r_dot + r * r * (theta_dot * theta_dot)) + -w1
        }
    }
    #[automatically_derived]
    #[allow(clippy::all)]
    impl<R: lagrange::Real> lagrange::System<2usize, 1usize> for __Over<R> {
        type Scalar = R;
        type Method = lagrange::Jets;
        type Constants = [R; 3];
        const NAMES: lagrange::Names = lagrange::Names {
            coordinates: &["theta", "r"],
            constraints: &[],
        };
        #[inline]
        fn constants(&self) -> Self::Constants {
            let mass_2: R = self.parameters[0];
            let stiffness: R = self.parameters[2];
            let length: R = self.parameters[3];
            [
                stiffness / mass_2,
                stiffness * length / mass_2,
                <R as lagrange::One>::one() / mass_2,
            ]
        }
        #[inline]
        fn accelerations_at(
            &self,
            constants: &Self::Constants,
            _t: R,
            q: &[R; 2],
            v: &[R; 2],
            u: &[R; 1],
        ) -> [R; 2] {
            use lagrange::Real;
            let [theta, r] = *q;
            let [theta_dot, r_dot] = *v;
            let [motor] = *u;
            let mass_2: R = self.parameters[0];
            let g: R = self.parameters[1];
            let [stiffness_over_mass_2, w1, inverse_mass_2] = *constants;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let w2 = mass_2
                * (r
                    * (g * sin_theta
                        + <R as lagrange::Real>::from_f64(2.0) * (theta_dot * r_dot)));
            [
                inverse_mass_2 * (motor - w2) / (r * r),
                r * (theta_dot * theta_dot - stiffness_over_mass_2)
                    + (g * cos_theta + w1),
            ]
        }
        fn check_at(
            &self,
            _constants: &Self::Constants,
            _t: R,
            q: &[R; 2],
            _v: &[R; 2],
        ) -> ::core::result::Result<(), lagrange::Cause> {
            let [_, r] = *q;
            let mass_2: R = self.parameters[0];
            let mass_2_r_squared = mass_2 * (r * r);
            lagrange::solve::check(mass_2_r_squared, mass_2_r_squared, 0)?;
            lagrange::solve::check(mass_2, mass_2, 1)?;
            ::core::result::Result::Ok(())
        }
        #[inline]
        fn energy_at(
            &self,
            _constants: &Self::Constants,
            t: R,
            q: &[R; 2],
            v: &[R; 2],
        ) -> R {
            self.energy(&lagrange::State { t, q: *q, v: *v })
        }
    }
    #[automatically_derived]
    #[allow(clippy::all)]
    impl<R: lagrange::Real> lagrange::Smooth<2usize, 1usize> for __Over<R> {
        type JetConstants = [R; 3];
        type Tables<const ORDERS: usize> = lagrange::Tables<R, 8, ORDERS>;
        #[inline]
        fn jet_constants(&self) -> [R; 3] {
            use lagrange::Real;
            let mass_2: R = self.parameters[0];
            let g: R = self.parameters[1];
            let stiffness: R = self.parameters[2];
            let length: R = self.parameters[3];
            [mass_2 * g, stiffness * length, Real::recip(mass_2)]
        }
        #[inline]
        fn jet_at<const ORDERS: usize>(
            &self,
            constants: &[R; 3],
            _t: R,
            q: &[R; 2],
            v: &[R; 2],
            u: &[R; 1],
            h: R,
            orders: usize,
            tables: &mut lagrange::Tables<R, 8, ORDERS>,
            series: &mut lagrange::Series<R, 2, ORDERS>,
        ) -> bool {
            use lagrange::Real;
            let [theta, r] = *q;
            let [theta_dot, r_dot] = *v;
            let [motor] = *u;
            let mass_2: R = self.parameters[0];
            let stiffness: R = self.parameters[2];
            let [mass_2_g, stiffness_length, inverse_mass_2] = *constants;
            let r_force_part = stiffness - mass_2 * (theta_dot * theta_dot);
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let inverse_mass_2_r_squared = Real::recip(mass_2 * (r * r));
            let r_plus_r = r + r;
            let theta_dot_plus_theta_dot = theta_dot + theta_dot;
            let mut theta_dot_last: R = theta_dot;
            let mut theta_force: R = motor - mass_2_g * (r * sin_theta);
            let mut r_dot_last: R = r_dot;
            let mut r_force: R = -(r * r_force_part
                - (mass_2_g * cos_theta + stiffness_length));
            let mut sin_theta_flow: R = theta_dot * cos_theta;
            let mut cos_theta_flow: R = -(theta_dot * sin_theta);
            struct Products;
            impl lagrange::jets::Pairs<7> for Products {
                const FACTORS: &'static [[usize; 2]; 7] = &[
                    [0, 0],
                    [1, 2],
                    [1, 3],
                    [1, 1],
                    [4, 0],
                    [0, 5],
                    [0, 3],
                ];
            }
            let mut products = lagrange::jets::Convolutions::new(tables, Products);
            lagrange::jets::in_line::<
                ORDERS,
            >(
                orders,
                #[inline(always)]
                |order| {
                    let rate: R = lagrange::jets::rate(h, order);
                    let inner = products.sums(order);
                    let theta_k = rate * theta_dot_last;
                    let r_k = rate * r_dot_last;
                    let sin_theta_k = rate * sin_theta_flow;
                    let cos_theta_k = rate * cos_theta_flow;
                    let r_squared_k = Real::mul_add(r_plus_r, r_k, inner[3]);
                    let w1 = Real::mul_add(
                        rate,
                        theta_force,
                        -(mass_2 * Real::mul_add(theta_dot, r_squared_k, inner[4])),
                    );
                    let theta_dot_k = w1 * inverse_mass_2_r_squared;
                    let r_dot_k = rate * r_force * inverse_mass_2;
                    let r_force_part_known = mass_2
                        * Real::mul_add(theta_dot_plus_theta_dot, theta_dot_k, inner[0]);
                    let theta_force_part_known = mass_2_g
                        * Real::mul_add(
                            sin_theta,
                            r_k,
                            Real::mul_add(r, sin_theta_k, inner[2]),
                        );
                    let w2 = Real::mul_add(
                        -r,
                        -r_force_part_known,
                        Real::mul_add(
                            mass_2_g,
                            cos_theta_k,
                            Real::mul_add(-r_force_part, r_k, -inner[1]),
                        ),
                    );
                    let w3 = Real::mul_add(
                        cos_theta,
                        theta_dot_k,
                        Real::mul_add(theta_dot, cos_theta_k, inner[5]),
                    );
                    let w4 = Real::mul_add(
                        -sin_theta,
                        theta_dot_k,
                        Real::mul_add(-theta_dot, sin_theta_k, -inner[6]),
                    );
                    series.set(order, [theta_k, r_k], [theta_dot_k, r_dot_k]);
                    if order == orders {
                        return false;
                    }
                    products
                        .add(
                            order,
                            [
                                theta_dot_k,
                                r_k,
                                -r_force_part_known,
                                sin_theta_k,
                                r_squared_k,
                                cos_theta_k,
                            ],
                        );
                    [
                        theta_dot_last,
                        theta_force,
                        r_dot_last,
                        r_force,
                        sin_theta_flow,
                        cos_theta_flow,
                    ] = [theta_dot_k, -theta_force_part_known, r_dot_k, w2, w3, w4];
                    true
                },
            );
            true
        }
    }
    impl<R: lagrange::Real> lagrange::Autonomous<2usize, 1usize> for __Over<R> {}
    impl<R: lagrange::Real> lagrange::Holonomic<2usize, 1usize> for __Over<R> {}
    impl<R: lagrange::Real> lagrange::Scleronomic<2usize, 1usize> for __Over<R> {}
};
