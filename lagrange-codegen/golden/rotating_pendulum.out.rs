impl RotatingPendulum {
    #[allow(dead_code)]
    fn bob(&self, q: &RotatingPendulumCoordinates, t: f64) -> Vector3<f64> {
        let out = self.length * q.theta.sin();
        let (sin, cos) = (self.rate * t).sin_cos();
        Vector3::new(out * cos, out * sin, -self.length * q.theta.cos())
    }
    #[allow(dead_code)]
    fn gravity(&self, q: &RotatingPendulumCoordinates, t: f64) -> f64 {
        self.mass * self.g * self.bob(q, t).z
    }
}
///Generalized coordinates of [`RotatingPendulum`].
#[allow(non_snake_case)]
pub struct RotatingPendulumCoordinates<R = f64> {
    ///`theta`
    pub theta: R,
}
impl<R: ::core::marker::Copy> ::core::marker::Copy for RotatingPendulumCoordinates<R> {}
impl<R: ::core::marker::Copy> ::core::clone::Clone for RotatingPendulumCoordinates<R> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: ::core::fmt::Debug> ::core::fmt::Debug for RotatingPendulumCoordinates<R> {
    fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
        f.debug_struct("RotatingPendulumCoordinates")
            .field("theta", &self.theta)
            .finish()
    }
}
impl<R> ::core::convert::From<[R; 1usize]> for RotatingPendulumCoordinates<R> {
    fn from([x0]: [R; 1usize]) -> Self {
        Self { theta: x0 }
    }
}
impl<R> ::core::convert::From<RotatingPendulumCoordinates<R>> for [R; 1usize] {
    fn from(
        RotatingPendulumCoordinates { theta: x0 }: RotatingPendulumCoordinates<R>,
    ) -> Self {
        [x0]
    }
}
///Generalized velocities of [`RotatingPendulum`].
#[allow(non_snake_case)]
pub struct RotatingPendulumVelocities<R = f64> {
    ///`theta`
    pub theta: R,
}
impl<R: ::core::marker::Copy> ::core::marker::Copy for RotatingPendulumVelocities<R> {}
impl<R: ::core::marker::Copy> ::core::clone::Clone for RotatingPendulumVelocities<R> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: ::core::fmt::Debug> ::core::fmt::Debug for RotatingPendulumVelocities<R> {
    fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
        f.debug_struct("RotatingPendulumVelocities").field("theta", &self.theta).finish()
    }
}
impl<R> ::core::convert::From<[R; 1usize]> for RotatingPendulumVelocities<R> {
    fn from([x0]: [R; 1usize]) -> Self {
        Self { theta: x0 }
    }
}
impl<R> ::core::convert::From<RotatingPendulumVelocities<R>> for [R; 1usize] {
    fn from(
        RotatingPendulumVelocities { theta: x0 }: RotatingPendulumVelocities<R>,
    ) -> Self {
        [x0]
    }
}
const _: () = {
    use ::lagrangian::__private as lagrange;
    /**# Model

| place | coordinate | velocity | |
| --- | --- | --- | --- |
| 0 | θ `theta` | θ̇ |  |

Energies and constraints:

```text
T = ½ mass·length²·(θ̇² + rate²·sin² θ)
V = −mass·length·g cos θ
```

Equations of motion:

```text
mass·length²·θ̈ + mass·length·g sin θ − mass·length²·rate²·sin θ cos θ
      = 0
```

* mass matrix: constant and diagonal, solved by divisions
* the mass matrix is constant: factored once per run
* separable: no force depends on velocities
* conservative and autonomous: the Jacobi integral is conserved
* operations of one evaluation: 2 additions, 2 multiplications, 1 elementary function
*/
    #[automatically_derived]
    #[allow(clippy::all)]
    impl RotatingPendulum {
        /// The coordinates in the order of all vectors, to name the one that an error speaks of.
        pub const COORDINATES: [&'static str; 1usize] = ["theta"];
        /// Operations of one evaluation of the accelerations: all of them as derived, and as emitted without
        /// those done once per run. A factorisation in the runtime is in neither.
        pub const COST: lagrange::Costs = lagrange::Costs {
            before: lagrange::Cost::new(10u32, 28u32, 1u32, 0u32, 2u32),
            after: lagrange::Cost::new(2u32, 2u32, 0u32, 0u32, 1u32),
        };
        /// What was found in this system, and what its code therefore leaves out.
        pub const STRUCTURE: lagrange::Structure = lagrange::Structure {
            mass_matrix: "constant and diagonal, solved by divisions",
            facts: &[
                "the mass matrix is constant: factored once per run",
                "separable: no force depends on velocities",
                "conservative and autonomous: the Jacobi integral is conserved",
                "smooth: a Taylor series of the motion takes 3 convolutions and the recurrences of 2 functions an order",
            ],
            skipped: &[
                "time: nothing depends on it",
                "inputs",
                "dissipation",
                "applied forces",
                "the solution of a linear system: the mass matrix is diagonal",
                "constraints and multipliers",
                "in Taylor series: momenta, which are the velocities times constants",
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
            let _: fn(
                &lagrange::nalgebra::Vector3<f64>,
            ) -> lagrange::nalgebra::Vector3<f64> = <Vector3<f64>>::clone;
        }
        /**Accelerations a that solve M(q, v, t) a = Q − ∂D/∂v − b(q, v, t).

The mass matrix is constant and diagonal, solved by divisions.

# Errors

A singular mass matrix, with the coordinate and the time.*/
        #[inline]
        pub fn accelerations(
            &self,
            state: &lagrange::State<f64, 1>,
        ) -> ::core::result::Result<[f64; 1], lagrange::MotionError<f64>> {
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
            _state: &lagrange::State<f64, 1>,
        ) -> lagrange::nalgebra::SMatrix<f64, 1, 1> {
            let mass_2: f64 = self.mass;
            let length: f64 = self.length;
            lagrange::solve::symmetric([[mass_2 * (length * length)]])
        }
        /**Bias b(q, v, t) = d/dt(∂L/∂v) − ∂L/∂q at zero accelerations: inertia forces that depend on velocity, and ∂V/∂q. The equations of motion are M a + b = Q − ∂D/∂v.

- `b(theta) = mass·sin(theta)·length·(g − length·rate^2·cos(theta))`*/
        #[inline]
        pub fn bias(&self, state: &lagrange::State<f64, 1>) -> [f64; 1] {
            use lagrange::Real;
            let [theta] = state.q;
            let mass_2: f64 = self.mass;
            let length: f64 = self.length;
            let rate_2: f64 = self.rate;
            let g: f64 = self.g;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            [
                mass_2 * length
                    * (sin_theta * (g - length * (rate_2 * rate_2) * cos_theta)),
            ]
        }
        /**Generalized momenta p = ∂L/∂v.

- `p(theta) = theta′·mass·length^2`*/
        #[inline]
        pub fn momenta(&self, state: &lagrange::State<f64, 1>) -> [f64; 1] {
            let [theta_dot] = state.v;
            let mass_2: f64 = self.mass;
            let length: f64 = self.length;
            [mass_2 * (length * length) * theta_dot]
        }
        /**Kinetic energy T \[J\].

`T = 0.5·mass·length^2·(theta′^2 + sin(theta)^2·rate^2)`*/
        #[inline]
        pub fn kinetic_energy(&self, state: &lagrange::State<f64, 1>) -> f64 {
            use lagrange::Real;
            let [theta] = state.q;
            let [theta_dot] = state.v;
            let mass_2: f64 = self.mass;
            let length: f64 = self.length;
            let rate_2: f64 = self.rate;
            let sin_theta = Real::sin(theta);
            0.5 * mass_2 * (length * length)
                * (theta_dot * theta_dot + rate_2 * rate_2 * (sin_theta * sin_theta))
        }
        /**Potential energy V \[J\].

`V = −mass·length·cos(theta)·g`*/
        #[inline]
        pub fn potential_energy(&self, state: &lagrange::State<f64, 1>) -> f64 {
            use lagrange::Real;
            let [theta] = state.q;
            let mass_2: f64 = self.mass;
            let length: f64 = self.length;
            let g: f64 = self.g;
            let gravity = -(mass_2 * length * g * Real::cos(theta));
            gravity
        }
        /**Jacobi integral v·∂L/∂v − L \[J\]: conserved where neither L depends on time nor forces do work, while T + V is not.

`h = −mass·length·(cos(theta)·g − 0.5·length·(theta′^2 − sin(theta)^2·rate^2))`*/
        #[inline]
        pub fn jacobi_integral(&self, state: &lagrange::State<f64, 1>) -> f64 {
            use lagrange::Real;
            let [theta] = state.q;
            let [theta_dot] = state.v;
            let mass_2: f64 = self.mass;
            let length: f64 = self.length;
            let rate_2: f64 = self.rate;
            let g: f64 = self.g;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let w1 = g * cos_theta
                - 0.5 * length
                    * (theta_dot * theta_dot
                        - rate_2 * rate_2 * (sin_theta * sin_theta));
            -(mass_2 * length * w1)
        }
        ///Energy T + V \[J\].
        #[inline]
        pub fn energy(&self, state: &lagrange::State<f64, 1>) -> f64 {
            self.kinetic_energy(state) + self.potential_energy(state)
        }
        /**Parts (T₂, T₁, T₀) of L = T₂ + T₁ + T₀ − V of degrees two, one and zero in the velocities \[J\]; of a Lagrangian given as a whole the part without velocities is −V. The Jacobi integral is T₂ − T₀ + V.

- `T2 = 0.5·theta′^2·mass·length^2`
- `T1 = 0`
- `T0 = 0.5·mass·sin(theta)^2·length^2·rate^2`*/
        #[inline]
        pub fn kinetic_energy_parts(
            &self,
            state: &lagrange::State<f64, 1>,
        ) -> (f64, f64, f64) {
            use lagrange::Real;
            let [theta] = state.q;
            let [theta_dot] = state.v;
            let mass_2: f64 = self.mass;
            let length: f64 = self.length;
            let rate_2: f64 = self.rate;
            let sin_theta = Real::sin(theta);
            let w1 = 0.5 * mass_2 * (length * length);
            (
                w1 * (theta_dot * theta_dot),
                0.0,
                w1 * (rate_2 * rate_2) * (sin_theta * sin_theta),
            )
        }
        ///Generalized inertia forces −(d/dt ∂T/∂v − ∂T/∂q) at given accelerations, apart by their origin.
        #[inline]
        pub fn inertia_forces(
            &self,
            state: &lagrange::State<f64, 1>,
            accelerations: &[f64; 1],
        ) -> lagrange::InertiaForces<f64, 1> {
            use lagrange::Real;
            let [theta] = state.q;
            let [theta_ddot] = *accelerations;
            let mass_2: f64 = self.mass;
            let length: f64 = self.length;
            let rate_2: f64 = self.rate;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let mass_2_length_squared = mass_2 * (length * length);
            lagrange::InertiaForces {
                relative: [-(mass_2_length_squared * theta_ddot)],
                coriolis: [0.0],
                gyroscopic: [0.0],
                transport: [
                    mass_2_length_squared * (rate_2 * rate_2) * (sin_theta * cos_theta),
                ],
            }
        }
        #[allow(unused_variables)]
        /**d(T + V)/dt along the motion \[W\]: the power of the applied forces, and the explicit change of V and T.

# Errors

A singular system, with its cause and the time.*/
        #[inline]
        pub fn energy_rate(
            &self,
            state: &lagrange::State<f64, 1>,
        ) -> ::core::result::Result<f64, lagrange::MotionError<f64>> {
            use lagrange::Real;
            let balance = lagrange::Balance::<_, 1, 0> {
                accelerations: self.accelerations(state)?,
                multipliers: [],
                independence: lagrange::Independence::clear(0),
            };
            let ([], accelerations) = (balance.multipliers, &balance.accelerations);
            let [theta] = state.q;
            let [theta_dot] = state.v;
            let mass_2: f64 = self.mass;
            let length: f64 = self.length;
            let rate_2: f64 = self.rate;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            ::core::result::Result::Ok(
                2.0 * mass_2 * (length * length) * (rate_2 * rate_2)
                    * (theta_dot * sin_theta * cos_theta),
            )
        }
        /**Rate of the Jacobi integral along the motion \[W\]: the power of applied forces and of moving constraints, less ∂L/∂t.

`h′ = 0`*/
        #[inline]
        pub fn jacobi_rate(&self, _state: &lagrange::State<f64, 1>) -> f64 {
            0.0
        }
        ///Coriolis matrix C(q, v, t) with C_kj = Σᵢ \[ij, k] vᵢ + ½ ∂M_kj/∂t: Ṁ − 2C is skew, so that v·(M a + C v) is the rate of ½ vᵀM v. Where M does not depend on time, C v are the Coriolis and centrifugal terms of the bias (Siciliano et al., *Robotics*, section 7.2.1).
        #[inline]
        pub fn coriolis_matrix(
            &self,
            _state: &lagrange::State<f64, 1>,
        ) -> lagrange::nalgebra::SMatrix<f64, 1, 1> {
            let mut matrices = [[0.0; 1]; 1];
            lagrange::constraints::matrix(&matrices)
        }
        /**Christoffel symbols of the first kind \[ij, k] = ½ (∂M_ik/∂q_j + ∂M_jk/∂q_i − ∂M_ij/∂q_k) as `[k][i][j]`: Σ \[ij, k] vᵢ vⱼ is the part of the bias quadratic in the velocities (Lurie, *Analytical Mechanics*, chapter 4).
*/
        #[inline]
        pub fn christoffel_first(
            &self,
            _state: &lagrange::State<f64, 1>,
        ) -> [[[f64; 1]; 1]; 1] {
            let mut matrices = [[[0.0; 1]; 1]; 1];
            lagrange::analysis::symmetric(matrices)
        }
        /**Christoffel symbols of the second kind Γᵏ_ij = Σ (M⁻¹)_kl \[ij, l] as `[k][i][j]`: aₖ + Σ Γᵏ_ij vᵢ vⱼ is the contravariant acceleration.

# Errors

A singular mass matrix, with the coordinate and the time.*/
        #[inline]
        pub fn christoffel_second(
            &self,
            state: &lagrange::State<f64, 1>,
        ) -> ::core::result::Result<[[[f64; 1]; 1]; 1], lagrange::MotionError<f64>> {
            lagrange::analysis::second_kind(
                    &self.mass_matrix(state),
                    &self.christoffel_first(state),
                    state.t,
                )
                .map_err(|error| error.named(&<Self as lagrange::System<1, 0>>::NAMES))
        }
        /**Velocities that belong to momenta, p = ∂L/∂v(t, q, v): the inverse of `momenta`, by Newton's method where p is not affine in v.

# Errors

A singular ∂²L/∂v∂v, or momenta that no velocities have.*/
        #[inline]
        pub fn velocities_from_momenta(
            &self,
            t: f64,
            q: &[f64; 1],
            p: &[f64; 1],
        ) -> ::core::result::Result<[f64; 1], lagrange::MotionError<f64>> {
            lagrange::analysis::velocities(
                    |v: &[f64; 1]| {
                        let _ = v;
                        let [theta_dot] = *v;
                        let mass_2: f64 = self.mass;
                        let length: f64 = self.length;
                        let mass_2_length_squared = mass_2 * (length * length);
                        let mut mass = [[0.0; 1]; 1];
                        mass[0][0] = mass_2_length_squared;
                        (mass, [mass_2_length_squared * theta_dot])
                    },
                    t,
                    p,
                    true,
                )
                .map_err(|error| error.named(&<Self as lagrange::System<1, 0>>::NAMES))
        }
        /**Hamiltonian H(t, q, p) = p·v − L at the velocities that belong to p \[J\].

# Errors

As `velocities_from_momenta`.*/
        #[inline]
        pub fn hamiltonian(
            &self,
            t: f64,
            q: &[f64; 1],
            p: &[f64; 1],
        ) -> ::core::result::Result<f64, lagrange::MotionError<f64>> {
            let v = self.velocities_from_momenta(t, q, p)?;
            ::core::result::Result::Ok(
                self.jacobi_integral(&lagrange::State { t, q: *q, v }),
            )
        }
        #[allow(unused_variables)]
        /**Canonical equations: q̇ = ∂H/∂p and ṗ = −∂H/∂q + Q − ∂D/∂v + Aᵀλ, as (q̇, ṗ).

# Errors

As `velocities_from_momenta`, and where constraints have no multipliers.*/
        #[inline]
        pub fn canonical_at(
            &self,
            t: f64,
            q: &[f64; 1],
            p: &[f64; 1],
        ) -> ::core::result::Result<([f64; 1], [f64; 1]), lagrange::MotionError<f64>> {
            let velocities = self.velocities_from_momenta(t, q, p)?;
            let v = &velocities;
            let rates: [f64; 1] = {
                use lagrange::Real;
                let [theta] = *q;
                let mass_2: f64 = self.mass;
                let length: f64 = self.length;
                let rate_2: f64 = self.rate;
                let g: f64 = self.g;
                let (sin_theta, cos_theta) = Real::sin_cos(theta);
                [
                    -(mass_2 * length
                        * (sin_theta * (g - length * (rate_2 * rate_2) * cos_theta))),
                ]
            };
            ::core::result::Result::Ok((velocities, rates))
        }
        ///Cyclic coordinates: L does not depend on them, and neither force nor constraint acts on them, so that the momentum of each is conserved.
        pub const CYCLIC: [&'static str; 0] = [];
        /**Momenta of the cyclic coordinates, in the order of `CYCLIC`: conserved.
*/
        #[inline]
        pub fn cyclic_momenta(&self, _state: &lagrange::State<f64, 1>) -> [f64; 0] {
            []
        }
        ///Conserved quantities that follow from the symmetries of the equations: the energy or Jacobi integral, and those of Noether's theorem for shifts q → q + ε (S q + s) with constant S and s. There may be others.
        pub const CONSERVED: [&'static str; 1] = ["Jacobi integral"];
        /**Conserved quantities, in the order of `CONSERVED`.

- `Jacobi integral = −mass·length·(cos(theta)·g − 0.5·length·(theta′^2 − sin(theta)^2·rate^2))`*/
        #[inline]
        pub fn conserved(&self, state: &lagrange::State<f64, 1>) -> [f64; 1] {
            use lagrange::Real;
            let [theta] = state.q;
            let [theta_dot] = state.v;
            let mass_2: f64 = self.mass;
            let length: f64 = self.length;
            let rate_2: f64 = self.rate;
            let g: f64 = self.g;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let w1 = g * cos_theta
                - 0.5 * length
                    * (theta_dot * theta_dot
                        - rate_2 * rate_2 * (sin_theta * sin_theta));
            [-(mass_2 * length * w1)]
        }
        ///Lumped parameters π in which the equations are linear, M a + b = Y π; those that identification can tell apart at most. `1` stands for what no parameter multiplies.
        pub const REGRESSOR: [&'static str; 3] = [
            "mass·length²",
            "mass·length·g",
            "mass·length²·rate²",
        ];
        ///Values of the lumped parameters π, in the order of `REGRESSOR`.
        #[inline]
        pub fn lumped_parameters(&self) -> [f64; 3] {
            let mass_2: f64 = self.mass;
            let length: f64 = self.length;
            let rate_2: f64 = self.rate;
            let g: f64 = self.g;
            let mass_2_length_squared = mass_2 * (length * length);
            [
                mass_2_length_squared,
                mass_2 * length * g,
                mass_2_length_squared * (rate_2 * rate_2),
            ]
        }
        #[allow(unused_variables)]
        ///Regressor Y(q, v, a, t) with Y π = M a + b: a row for each coordinate, a column for each lumped parameter. It has inertia and what a potential or Lagrangian gives; damping and `#[force]` functions are not in it.
        #[inline]
        pub fn regressor(
            &self,
            state: &lagrange::State<f64, 1>,
            accelerations: &[f64; 1],
        ) -> lagrange::nalgebra::SMatrix<f64, 1, 3> {
            use lagrange::Real;
            let [theta] = state.q;
            let [theta_ddot] = *accelerations;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let mut matrices = [[0.0; 3]; 1];
            matrices[0][0] = theta_ddot;
            matrices[0][1] = sin_theta;
            matrices[0][2] = -(sin_theta * cos_theta);
            lagrange::constraints::matrix(&matrices)
        }
        /**Checks identities of this model at sampled states: the mass matrix is positive, Ṁ − 2C is skew, the accelerations satisfy Lagrange's equations, the power balance holds, conserved quantities stay, gradients of constraints are their derivatives, and the energies are those of the described functions. Coordinates and velocities are between −1 and 1: where the scales of the motion are far from one, `verify_at` takes states of your own.

# Errors

The first identity that does not hold, and by how much.*/
        #[inline]
        pub fn verify(
            &self,
        ) -> ::core::result::Result<lagrange::Certificate, lagrange::Violation> {
            lagrange::verify::verify::<Self, 1, 0>(self)
        }
        /**Checks the identities of `verify` at given states, moved onto the constraints if there are any.

# Errors

The first identity that does not hold, and by how much.*/
        #[inline]
        pub fn verify_at(
            &self,
            states: &[lagrange::State<f64, 1>],
        ) -> ::core::result::Result<lagrange::Certificate, lagrange::Violation> {
            lagrange::verify::verify_at::<Self, 1, 0>(self, states)
        }
        ///The equations of motion as derived, M a + b = Q − ∂D/∂v + Aᵀλ, a line for each coordinate.
        pub const EQUATIONS: &'static str = {
            let text = "mass·length²·θ\u{308} + mass·length·g sin θ − mass·length²·rate²·sin θ cos θ = 0";
            text
        };
        ///`EQUATIONS` in LaTeX, an `aligned` environment.
        pub const EQUATIONS_LATEX: &'static str = {
            let text = "\\begin{aligned}\n\\mathrm{mass} \\, {\\mathrm{length}}^{2} \\, \\ddot{\\theta} + \\mathrm{mass} \\, \\mathrm{length} \\, g \\sin \\theta - \\mathrm{mass} \\, {\\mathrm{length}}^{2} \\, {\\mathrm{rate}}^{2} \\, \\sin \\theta \\cos \\theta &= 0\n\\end{aligned}";
            text
        };
        ///`EQUATIONS` in MathML, a `math` element.
        pub const EQUATIONS_MATHML: &'static str = {
            let text = "<math xmlns=\"http://www.w3.org/1998/Math/MathML\" display=\"block\"><mtable displaystyle=\"true\">\n<mtr><mtd style=\"text-align: right\"><mrow><mrow><mi>mass</mi><mo>⋅</mo><msup><mi>length</mi><mn>2</mn></msup><mo>⋅</mo><mover accent=\"true\"><mi>θ</mi><mo>¨</mo></mover></mrow><mo>+</mo><mrow><mi>mass</mi><mo>⋅</mo><mi>length</mi><mo>⋅</mo><mi>g</mi><mo>\u{2062}</mo><mspace width=\"0.17em\"/><mrow><mi>sin</mi><mo>\u{2061}</mo><mspace width=\"0.17em\"/><mi>θ</mi></mrow></mrow><mo>−</mo><mrow><mi>mass</mi><mo>⋅</mo><msup><mi>length</mi><mn>2</mn></msup><mo>⋅</mo><msup><mi>rate</mi><mn>2</mn></msup><mo>⋅</mo><mspace width=\"0.17em\"/><mrow><mi>sin</mi><mo>\u{2061}</mo><mspace width=\"0.17em\"/><mi>θ</mi></mrow><mo>\u{2062}</mo><mspace width=\"0.17em\"/><mrow><mi>cos</mi><mo>\u{2061}</mo><mspace width=\"0.17em\"/><mi>θ</mi></mrow></mrow></mrow></mtd><mtd style=\"text-align: left\"><mo>=</mo><mn>0</mn></mtd></mtr>\n</mtable></math>";
            text
        };
    }
    #[automatically_derived]
    #[allow(clippy::all)]
    impl lagrange::System<1usize, 0usize> for RotatingPendulum {
        type Scalar = f64;
        type Method = lagrange::Jets;
        type Constants = [f64; 2];
        const NAMES: lagrange::Names = lagrange::Names {
            coordinates: &["theta"],
            constraints: &[],
        };
        #[inline]
        fn constants(&self) -> Self::Constants {
            let length: f64 = self.length;
            let rate_2: f64 = self.rate;
            let g: f64 = self.g;
            [rate_2 * rate_2, g / length]
        }
        #[inline]
        fn accelerations_at(
            &self,
            constants: &Self::Constants,
            _t: f64,
            q: &[f64; 1],
            _v: &[f64; 1],
            _u: &[f64; 0],
        ) -> [f64; 1] {
            use lagrange::Real;
            let [theta] = *q;
            let [rate_2_squared, g_over_length] = *constants;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            [-(sin_theta * (g_over_length - rate_2_squared * cos_theta))]
        }
        fn check_at(
            &self,
            _constants: &Self::Constants,
            _t: f64,
            _q: &[f64; 1],
            _v: &[f64; 1],
        ) -> ::core::result::Result<(), lagrange::Cause> {
            let mass_2: f64 = self.mass;
            let length: f64 = self.length;
            let mass_2_length_squared = mass_2 * (length * length);
            lagrange::solve::check(mass_2_length_squared, mass_2_length_squared, 0)?;
            ::core::result::Result::Ok(())
        }
        #[inline]
        fn energy_at(
            &self,
            _constants: &Self::Constants,
            t: f64,
            q: &[f64; 1],
            v: &[f64; 1],
        ) -> f64 {
            self.energy(&lagrange::State { t, q: *q, v: *v })
        }
        #[cfg(debug_assertions)]
        const READ: bool = true;
        #[cfg(debug_assertions)]
        #[allow(unused_variables)]
        fn check_reading_at(
            &self,
            state: &lagrange::State<f64, 1>,
            inputs: &[f64; 0],
        ) -> ::core::result::Result<(), lagrange::Cause> {
            use lagrange::Real;
            let [theta] = state.q;
            let t = state.t;
            let mass_2: f64 = self.mass;
            let length: f64 = self.length;
            let rate_2: f64 = self.rate;
            let g: f64 = self.g;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let rate_2_t = rate_2 * t;
            let (sin, cos) = Real::sin_cos(rate_2_t);
            let abs_theta = Real::abs(theta);
            let abs_t = Real::abs(t);
            let abs_sin_theta = Real::abs(sin_theta);
            let abs_cos_theta = Real::abs(cos_theta);
            let w1 = abs_sin_theta + abs_theta * abs_cos_theta;
            let abs_length = Real::abs(length);
            let abs_rate_2 = Real::abs(rate_2);
            let abs_sin = Real::abs(sin);
            let abs_cos = Real::abs(cos);
            let w2 = abs_cos_theta + abs_theta * abs_sin_theta;
            let bob_x = length * (sin_theta * cos);
            let bob_y = length * (sin_theta * sin);
            let bob_z = -(length * cos_theta);
            let gravity = -(mass_2 * length * g * cos_theta);
            use lagrange::reading::Numbers;
            let __coordinates = <RotatingPendulumCoordinates<
                f64,
            > as ::core::convert::From<_>>::from(state.q);
            lagrange::reading::compare(
                lagrange::Function(&["bob", lagrange::reading::MISREAD]),
                |take| self.bob(&__coordinates, state.t).each_number(take),
                &[bob_x, bob_y, bob_z],
                &[
                    abs_length * (w1 * (abs_cos + abs_rate_2 * (abs_t * abs_sin))),
                    abs_length * (w1 * (abs_sin + abs_rate_2 * (abs_t * abs_cos))),
                    abs_length * w2,
                ],
            )?;
            lagrange::reading::compare(
                lagrange::Function(&["gravity", lagrange::reading::MISREAD]),
                |take| self.gravity(&__coordinates, state.t).each_number(take),
                &[gravity],
                &[abs_length * Real::abs(mass_2) * Real::abs(g) * w2],
            )?;
            ::core::result::Result::Ok(())
        }
    }
    impl lagrange::ConstantMass<1usize, 0usize> for RotatingPendulum {}
    impl lagrange::Separable<1usize, 0usize> for RotatingPendulum {}
    impl lagrange::Autonomous<1usize, 0usize> for RotatingPendulum {}
    impl lagrange::Conservative<1usize, 0usize> for RotatingPendulum {}
    impl lagrange::Holonomic<1usize, 0usize> for RotatingPendulum {}
    #[automatically_derived]
    #[allow(clippy::all)]
    impl lagrange::Smooth<1usize, 0usize> for RotatingPendulum {
        type JetConstants = [f64; 3];
        type Tables<const ORDERS: usize> = lagrange::Tables<f64, 4, ORDERS>;
        #[inline]
        fn jet_constants(&self) -> [f64; 3] {
            use lagrange::Real;
            let mass_2: f64 = self.mass;
            let length: f64 = self.length;
            let rate_2: f64 = self.rate;
            [
                length * (rate_2 * rate_2),
                mass_2 * length,
                Real::recip(mass_2 * (length * length)),
            ]
        }
        #[inline]
        fn jet_at<const ORDERS: usize>(
            &self,
            constants: &[f64; 3],
            _t: f64,
            q: &[f64; 1],
            v: &[f64; 1],
            _u: &[f64; 0],
            h: f64,
            orders: usize,
            tables: &mut lagrange::Tables<f64, 4, ORDERS>,
            series: &mut lagrange::Series<f64, 1, ORDERS>,
        ) -> bool {
            use lagrange::Real;
            let [theta] = *q;
            let [theta_dot] = *v;
            let g: f64 = self.g;
            let [length_rate_2_squared, mass_2_length, w1] = *constants;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let theta_force_part = g - length_rate_2_squared * cos_theta;
            let mut theta_dot_last: f64 = theta_dot;
            let mut theta_force: f64 = -(mass_2_length * (sin_theta * theta_force_part));
            let mut sin_theta_flow: f64 = theta_dot * cos_theta;
            let mut cos_theta_flow: f64 = -(theta_dot * sin_theta);
            struct Products;
            impl lagrange::jets::Pairs<3> for Products {
                const FACTORS: &'static [[usize; 2]; 3] = &[[0, 1], [2, 3], [2, 0]];
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
                    let sin_theta_k = rate * sin_theta_flow;
                    let cos_theta_k = rate * cos_theta_flow;
                    let theta_force_part_known = length_rate_2_squared * cos_theta_k;
                    let theta_force_part_k = Real::mul_add(
                        theta_force_part,
                        sin_theta_k,
                        Real::mul_add(sin_theta, -theta_force_part_known, inner[0]),
                    );
                    let theta_dot_k = rate * theta_force * w1;
                    let theta_force_part_known_2 = mass_2_length * theta_force_part_k;
                    let w2 = Real::mul_add(
                        cos_theta,
                        theta_dot_k,
                        Real::mul_add(theta_dot, cos_theta_k, inner[1]),
                    );
                    let w3 = Real::mul_add(
                        -sin_theta,
                        theta_dot_k,
                        Real::mul_add(-theta_dot, sin_theta_k, -inner[2]),
                    );
                    series.set(order, [theta_k], [theta_dot_k]);
                    if order == orders {
                        return false;
                    }
                    products
                        .add(
                            order,
                            [
                                sin_theta_k,
                                -theta_force_part_known,
                                theta_dot_k,
                                cos_theta_k,
                            ],
                        );
                    [theta_dot_last, theta_force, sin_theta_flow, cos_theta_flow] = [
                        theta_dot_k,
                        -theta_force_part_known_2,
                        w2,
                        w3,
                    ];
                    true
                },
            );
            true
        }
    }
    #[automatically_derived]
    #[allow(clippy::all, unused_variables)]
    impl lagrange::Verifiable<1usize, 0usize> for RotatingPendulum {
        const CONSERVED: usize = 1;
        const CONSTRAINTS: usize = 0;
        const DEFINITE: bool = true;
        fn nearest_at(
            &self,
            state: &lagrange::State<f64, 1>,
        ) -> ::core::option::Option<lagrange::State<f64, 1>> {
            ::core::option::Option::Some(*state)
        }
        fn mass_at(&self, state: &lagrange::State<f64, 1>) -> [[f64; 1]; 1] {
            self.mass_matrix(state).data.0
        }
        fn coriolis_at(
            &self,
            state: &lagrange::State<f64, 1>,
        ) -> ::core::option::Option<[[f64; 1]; 1]> {
            ::core::option::Option::Some(self.coriolis_matrix(state).data.0)
        }
        fn momenta_at(&self, state: &lagrange::State<f64, 1>) -> [f64; 1] {
            self.momenta(state)
        }
        fn integral_at(&self, state: &lagrange::State<f64, 1>) -> f64 {
            self.jacobi_integral(state)
        }
        fn integral_rate_at(
            &self,
            state: &lagrange::State<f64, 1>,
            u: &[f64; 0],
        ) -> ::core::option::Option<f64> {
            ::core::option::Option::Some(self.jacobi_rate(state))
        }
        fn driven_at(
            &self,
            state: &lagrange::State<f64, 1>,
            u: &[f64; 0],
        ) -> ::core::option::Option<lagrange::verify::Driven<f64, 1>> {
            ::core::option::Option::Some(lagrange::verify::Driven {
                accelerations: self.accelerations(state).ok()?,
                loads: [0.0; 1],
            })
        }
        fn conserved_at(&self, state: &lagrange::State<f64, 1>, index: usize) -> f64 {
            self.conserved(state).get(index).copied().unwrap_or(0.0)
        }
        fn constraint_at(
            &self,
            state: &lagrange::State<f64, 1>,
            constraint: usize,
        ) -> f64 {
            0.0
        }
        fn gradient_at(
            &self,
            state: &lagrange::State<f64, 1>,
            constraint: usize,
        ) -> [f64; 1] {
            [0.0; 1]
        }
        fn is_holonomic(constraint: usize) -> bool {
            <[bool]>::get(&[], constraint).copied().unwrap_or(false)
        }
        fn energies_at(
            &self,
            state: &lagrange::State<f64, 1>,
        ) -> ::core::option::Option<[f64; 2]> {
            ::core::option::Option::Some([
                self.kinetic_energy(state),
                self.potential_energy(state),
            ])
        }
        fn described_at(
            &self,
            state: &lagrange::State<f64, 1>,
            time: f64,
        ) -> lagrange::verify::Described<f64> {
            let mass_2: f64 = self.mass;
            let weights: [(f64, [[f64; 3]; 3]); 1] = [
                (mass_2, [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]),
            ];
            let mut described = lagrange::verify::Described {
                kinetic: 0.0,
                potential: 0.0,
                lagrangian: 0.0,
                uncertainty: 0.0,
            };
            let path = |shift: f64| lagrange::State::<f64, 1> {
                t: state.t + shift,
                q: ::core::array::from_fn(|i| state.q[i] + shift * state.v[i]),
                v: state.v,
            };
            let (energy, doubt) = lagrange::verify::kinetic(
                |shift| {
                    let state = &path(shift);
                    let coordinates = <RotatingPendulumCoordinates<
                        f64,
                    > as ::core::convert::From<_>>::from(state.q);
                    self.bob(lagrange::verify::given(&coordinates), state.t)
                },
                time,
                weights[0].0,
                weights[0].1,
            );
            described.kinetic += energy;
            described.uncertainty += doubt;
            described.potential
                += {
                    let coordinates = <RotatingPendulumCoordinates<
                        f64,
                    > as ::core::convert::From<_>>::from(state.q);
                    self.gravity(lagrange::verify::given(&coordinates), state.t)
                };
            described
        }
    }
};
