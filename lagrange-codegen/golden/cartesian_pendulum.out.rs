impl CartesianPendulum {
    #[allow(dead_code)]
    fn bob(&self, q: &CartesianPendulumCoordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }
    #[allow(dead_code)]
    fn gravity(&self, q: &CartesianPendulumCoordinates) -> f64 {
        self.mass * self.g * q.y
    }
    /// The rod pulls at the bob with `reactions().rod`.
    #[allow(dead_code)]
    fn rod(&self, q: &CartesianPendulumCoordinates) -> f64 {
        self.bob(q).norm() - self.length
    }
}
///Generalized coordinates of [`CartesianPendulum`].
#[allow(non_snake_case)]
pub struct CartesianPendulumCoordinates<R = f64> {
    ///`x`
    pub x: R,
    ///`y`
    pub y: R,
}
impl<R: ::core::marker::Copy> ::core::marker::Copy for CartesianPendulumCoordinates<R> {}
impl<R: ::core::marker::Copy> ::core::clone::Clone for CartesianPendulumCoordinates<R> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: ::core::fmt::Debug> ::core::fmt::Debug for CartesianPendulumCoordinates<R> {
    fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
        f.debug_struct("CartesianPendulumCoordinates")
            .field("x", &self.x)
            .field("y", &self.y)
            .finish()
    }
}
impl<R> ::core::convert::From<[R; 2usize]> for CartesianPendulumCoordinates<R> {
    fn from([x0, x1]: [R; 2usize]) -> Self {
        Self { x: x0, y: x1 }
    }
}
impl<R> ::core::convert::From<CartesianPendulumCoordinates<R>> for [R; 2usize] {
    fn from(
        CartesianPendulumCoordinates { x: x0, y: x1 }: CartesianPendulumCoordinates<R>,
    ) -> Self {
        [x0, x1]
    }
}
///Generalized velocities of [`CartesianPendulum`].
#[allow(non_snake_case)]
pub struct CartesianPendulumVelocities<R = f64> {
    ///`x`
    pub x: R,
    ///`y`
    pub y: R,
}
impl<R: ::core::marker::Copy> ::core::marker::Copy for CartesianPendulumVelocities<R> {}
impl<R: ::core::marker::Copy> ::core::clone::Clone for CartesianPendulumVelocities<R> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: ::core::fmt::Debug> ::core::fmt::Debug for CartesianPendulumVelocities<R> {
    fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
        f.debug_struct("CartesianPendulumVelocities")
            .field("x", &self.x)
            .field("y", &self.y)
            .finish()
    }
}
impl<R> ::core::convert::From<[R; 2usize]> for CartesianPendulumVelocities<R> {
    fn from([x0, x1]: [R; 2usize]) -> Self {
        Self { x: x0, y: x1 }
    }
}
impl<R> ::core::convert::From<CartesianPendulumVelocities<R>> for [R; 2usize] {
    fn from(
        CartesianPendulumVelocities { x: x0, y: x1 }: CartesianPendulumVelocities<R>,
    ) -> Self {
        [x0, x1]
    }
}
///One value for each constraint of [`CartesianPendulum`].
#[allow(non_snake_case)]
pub struct CartesianPendulumReactions<T = f64> {
    ///`rod`
    pub rod: T,
}
impl<T: ::core::marker::Copy> ::core::marker::Copy for CartesianPendulumReactions<T> {}
impl<T: ::core::marker::Copy> ::core::clone::Clone for CartesianPendulumReactions<T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T: ::core::fmt::Debug> ::core::fmt::Debug for CartesianPendulumReactions<T> {
    fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
        f.debug_struct("CartesianPendulumReactions").field("rod", &self.rod).finish()
    }
}
impl<T> ::core::convert::From<[T; 1usize]> for CartesianPendulumReactions<T> {
    fn from([x0]: [T; 1usize]) -> Self {
        Self { rod: x0 }
    }
}
impl<T> ::core::convert::From<CartesianPendulumReactions<T>> for [T; 1usize] {
    fn from(
        CartesianPendulumReactions { rod: x0 }: CartesianPendulumReactions<T>,
    ) -> Self {
        [x0]
    }
}
const _: () = {
    use ::lagrangian::__private as lagrange;
    #[automatically_derived]
    #[allow(clippy::all)]
    impl CartesianPendulum {
        /// The coordinates in the order of all vectors, to name the one that an error speaks of.
        pub const COORDINATES: [&'static str; 2usize] = ["x", "y"];
        /// The constraints in the order of all vectors of them, to name the one that an error speaks of.
        pub const CONSTRAINTS: [&'static str; 1usize] = ["rod"];
        /// Operations of one evaluation of the accelerations: all of them as derived, and as emitted without
        /// those done once per run. A factorisation in the runtime is in neither.
        pub const COST: lagrange::Costs = lagrange::Costs {
            before: lagrange::Cost::new(6u32, 13u32, 1u32, 1u32, 0u32),
            after: lagrange::Cost::new(5u32, 12u32, 1u32, 1u32, 0u32),
        };
        /// What was found in this system, and what its code therefore leaves out.
        pub const STRUCTURE: lagrange::Structure = lagrange::Structure {
            mass_matrix: "constant and diagonal, eliminated from the saddle-point system of the constraints",
            facts: &[
                "the mass matrix is constant",
                "constraints, each with a multiplier: rod",
                "conservative and autonomous: the energy is conserved",
                "smooth: a Taylor series of the motion takes 4 convolutions and the recurrences of no functions an order",
            ],
            skipped: &[
                "time: nothing depends on it",
                "inputs",
                "dissipation",
                "applied forces",
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
            let x @ _ = ();
            let y @ _ = ();
            let _: fn(
                &lagrange::nalgebra::Vector2<f64>,
            ) -> lagrange::nalgebra::Vector2<f64> = <Vector2<f64>>::clone;
        }
        /**Accelerations a that solve M(q, v, t) a = Q − ∂D/∂v − b(q, v, t) + Aᵀλ, with the multipliers λ of the constraints solved for.

The mass matrix is constant and diagonal, eliminated from the saddle-point system of the constraints.

# Errors

A singular system, with its cause and the time.*/
        #[inline]
        pub fn accelerations(
            &self,
            state: &lagrange::State<f64, 2>,
        ) -> ::core::result::Result<[f64; 2], lagrange::MotionError<f64>> {
            lagrange::reading::checked(self, state, &[])?;
            lagrange::constraints::sound::<Self, 2, 0, 1>(self, state)?;
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
            _state: &lagrange::State<f64, 2>,
        ) -> lagrange::nalgebra::SMatrix<f64, 2, 2> {
            let mass_2: f64 = self.mass;
            let mut mass = [[0.0; 2]; 2];
            mass[0][0] = mass_2;
            mass[1][1] = mass_2;
            lagrange::solve::symmetric(mass)
        }
        /**Bias b(q, v, t) = d/dt(∂L/∂v) − ∂L/∂q at zero accelerations: inertia forces that depend on velocity, and ∂V/∂q. The equations of motion are M a + b = Q − ∂D/∂v.

- `b(x) = 0`
- `b(y) = mass·g`*/
        #[inline]
        pub fn bias(&self, _state: &lagrange::State<f64, 2>) -> [f64; 2] {
            let mass_2: f64 = self.mass;
            let g: f64 = self.g;
            [0.0, mass_2 * g]
        }
        /**Generalized momenta p = ∂L/∂v.

- `p(x) = x′·mass`
- `p(y) = y′·mass`*/
        #[inline]
        pub fn momenta(&self, state: &lagrange::State<f64, 2>) -> [f64; 2] {
            let [x_dot, y_dot] = state.v;
            let mass_2: f64 = self.mass;
            [mass_2 * x_dot, mass_2 * y_dot]
        }
        /**Kinetic energy T \[J\].

`T = 0.5·mass·(x′^2 + y′^2)`*/
        #[inline]
        pub fn kinetic_energy(&self, state: &lagrange::State<f64, 2>) -> f64 {
            let [x_dot, y_dot] = state.v;
            let mass_2: f64 = self.mass;
            0.5 * mass_2 * (x_dot * x_dot + y_dot * y_dot)
        }
        /**Potential energy V \[J\].

`V = y·mass·g`*/
        #[inline]
        pub fn potential_energy(&self, state: &lagrange::State<f64, 2>) -> f64 {
            let [_, y] = state.q;
            let mass_2: f64 = self.mass;
            let g: f64 = self.g;
            let gravity = mass_2 * g * y;
            gravity
        }
        ///Energy T + V \[J\].
        #[inline]
        pub fn energy(&self, state: &lagrange::State<f64, 2>) -> f64 {
            self.kinetic_energy(state) + self.potential_energy(state)
        }
        /**Multipliers λ of the constraints, by name: the generalized force of a constraint f is λ ∂f/∂q, of a constraint g on velocities λ ∂g/∂v, each as it is written. Where the gradient is a unit vector, λ is the force itself. `are_unique()` is false where redundant constraints leave them undetermined; they are then those of least Σ λ².

# Errors

A singular system, with its cause and the time.*/
        #[inline]
        pub fn reactions(
            &self,
            state: &lagrange::State<f64, 2>,
        ) -> ::core::result::Result<
            lagrange::Reactions<CartesianPendulumReactions<f64>>,
            lagrange::MotionError<f64>,
        > {
            let balance = <Self as lagrange::Surface<
                2,
                0,
                1,
            >>::balance_at(
                self,
                &<Self as lagrange::System<2, 0>>::constants(self),
                state.t,
                &state.q,
                &state.v,
                &[],
            );
            lagrange::constraints::finite::<Self, 2, 0, 1>(self, state, &balance)?;
            ::core::result::Result::Ok(
                lagrange::Reactions::new(
                    balance.multipliers.into(),
                    balance.independence.rank == 1,
                ),
            )
        }
        /**Generalized forces λ ∂f/∂q of the constraints, by name, components in the order of the coordinates.

# Errors

A singular system, with its cause and the time.*/
        #[inline]
        pub fn reaction_forces(
            &self,
            state: &lagrange::State<f64, 2>,
        ) -> ::core::result::Result<
            CartesianPendulumReactions<[f64; 2]>,
            lagrange::MotionError<f64>,
        > {
            let balance = <Self as lagrange::Surface<
                2,
                0,
                1,
            >>::balance_at(
                self,
                &<Self as lagrange::System<2, 0>>::constants(self),
                state.t,
                &state.q,
                &state.v,
                &[],
            );
            lagrange::constraints::finite::<Self, 2, 0, 1>(self, state, &balance)?;
            ::core::result::Result::Ok(
                CartesianPendulumReactions::from(
                    lagrange::constraints::forces::<
                        Self,
                        2,
                        0,
                        1,
                    >(self, state, &balance.multipliers),
                ),
            )
        }
        #[allow(unused_variables)]
        /**Power v·Aᵀλ of the reactions \[W\]: zero unless a constraint moves.

# Errors

A singular system, with its cause and the time.*/
        #[inline]
        pub fn reaction_power(
            &self,
            state: &lagrange::State<f64, 2>,
        ) -> ::core::result::Result<f64, lagrange::MotionError<f64>> {
            let balance = <Self as lagrange::Surface<
                2,
                0,
                1,
            >>::balance_at(
                self,
                &<Self as lagrange::System<2, 0>>::constants(self),
                state.t,
                &state.q,
                &state.v,
                &[],
            );
            lagrange::constraints::finite::<Self, 2, 0, 1>(self, state, &balance)?;
            let ([rod_multiplier], accelerations) = (
                balance.multipliers,
                &balance.accelerations,
            );
            ::core::result::Result::Ok(0.0)
        }
        #[allow(unused_variables)]
        /**d(T + V)/dt along the motion \[W\]: the power of applied forces and of moving constraints, and the explicit change of V and T.

# Errors

A singular system, with its cause and the time.*/
        #[inline]
        pub fn energy_rate(
            &self,
            state: &lagrange::State<f64, 2>,
        ) -> ::core::result::Result<f64, lagrange::MotionError<f64>> {
            let balance = <Self as lagrange::Surface<
                2,
                0,
                1,
            >>::balance_at(
                self,
                &<Self as lagrange::System<2, 0>>::constants(self),
                state.t,
                &state.q,
                &state.v,
                &[],
            );
            lagrange::constraints::finite::<Self, 2, 0, 1>(self, state, &balance)?;
            let ([rod_multiplier], accelerations) = (
                balance.multipliers,
                &balance.accelerations,
            );
            ::core::result::Result::Ok(0.0)
        }
        #[allow(unused_variables)]
        /**Cartesian forces of the constraints on `bob` \[N\], by name: λ ∂f/∂r where f is written through its position r, or in coordinates that are components of it. What f says of other coordinates is not in it.

# Errors

A singular system, with its cause and the time.*/
        #[inline]
        pub fn reactions_on_bob(
            &self,
            state: &lagrange::State<f64, 2>,
        ) -> ::core::result::Result<
            CartesianPendulumReactions<lagrange::nalgebra::SVector<f64, 2>>,
            lagrange::MotionError<f64>,
        > {
            use lagrange::Real;
            let balance = <Self as lagrange::Surface<
                2,
                0,
                1,
            >>::balance_at(
                self,
                &<Self as lagrange::System<2, 0>>::constants(self),
                state.t,
                &state.q,
                &state.v,
                &[],
            );
            lagrange::constraints::finite::<Self, 2, 0, 1>(self, state, &balance)?;
            let ([rod_multiplier], accelerations) = (
                balance.multipliers,
                &balance.accelerations,
            );
            let [x, y] = state.q;
            let w1 = rod_multiplier / Real::sqrt(x * x + y * y);
            ::core::result::Result::Ok(
                CartesianPendulumReactions::from([
                    lagrange::nalgebra::SVector::from([x * w1, y * w1]),
                ]),
            )
        }
        /**How far a state is off the constraints: f of the holonomic ones, g of the nonholonomic ones, in the order of `CONSTRAINTS`.

- `f(rod) = √(x^2 + y^2) − length`*/
        #[inline]
        pub fn constraint_residuals(&self, state: &lagrange::State<f64, 2>) -> [f64; 1] {
            use lagrange::Real;
            let [x, y] = state.q;
            let length: f64 = self.length;
            let rod = Real::sqrt(x * x + y * y) - length;
            [rod]
        }
        /**The constraints at the level of velocities: df/dt of the holonomic ones, g of the nonholonomic ones.

- `w(rod) = (x^2 + y^2)^(-1/2)·(x·x′ + y·y′)`*/
        #[inline]
        pub fn constraint_rates(&self, state: &lagrange::State<f64, 2>) -> [f64; 1] {
            use lagrange::Real;
            let [x, y] = state.q;
            let [x_dot, y_dot] = state.v;
            [(x * x_dot + y * y_dot) / Real::sqrt(x * x + y * y)]
        }
        ///Gradients A of the constraints: ∂f/∂q of the holonomic ones, ∂g/∂v of the nonholonomic ones, a row each.
        #[inline]
        pub fn constraint_jacobian(
            &self,
            state: &lagrange::State<f64, 2>,
        ) -> lagrange::nalgebra::SMatrix<f64, 1, 2> {
            use lagrange::Real;
            let [x, y] = state.q;
            let w1 = 1.0 / Real::sqrt(x * x + y * y);
            let mut gradients = [[0.0; 2]; 1];
            gradients[0][0] = x * w1;
            gradients[0][1] = y * w1;
            lagrange::constraints::matrix(&gradients)
        }
        /**The nearest state on the constraints in the metric of the mass matrix: coordinates, then velocities.

# Errors

Constraints that contradict each other, that have no gradient, or that Newton's method cannot satisfy from here: the constraint, and how far off it is.*/
        #[inline]
        pub fn consistent(
            &self,
            state: lagrange::State<f64, 2>,
        ) -> ::core::result::Result<
            lagrange::State<f64, 2>,
            lagrange::MotionError<f64>,
        > {
            lagrange::reading::checked::<Self, 2, 0>(self, &state, &[0.0; 0])?;
            lagrange::constraints::consistent::<Self, 2, 0, 1>(self, state)
        }
        /**The equations of motion as derived, M a + b = Q − ∂D/∂v + Aᵀλ, a line for each coordinate.

```text
mass·ẍ = x λ(rod)/√(x² + y²)
mass·ÿ + mass·g = y λ(rod)/√(x² + y²)
```*/
        pub const EQUATIONS: &'static str = {
            let text = "mass·x\u{308} = x λ(rod)/√(x² + y²)\nmass·y\u{308} + mass·g = y λ(rod)/√(x² + y²)";
            text
        };
    }
    #[automatically_derived]
    #[allow(clippy::all)]
    impl lagrange::System<2usize, 0usize> for CartesianPendulum {
        type Scalar = f64;
        type Method = lagrange::Jets;
        type Constants = [f64; 2];
        #[inline]
        fn constants(&self) -> Self::Constants {
            let mass_2: f64 = self.mass;
            let g: f64 = self.g;
            [1.0 / mass_2, -(mass_2 * g)]
        }
        const NAMES: lagrange::Names = lagrange::Names {
            coordinates: &["x", "y"],
            constraints: &["rod"],
        };
        const CONSTRAINED: bool = true;
        const CONSERVES_ENERGY: bool = true;
        #[inline]
        fn accelerations_at(
            &self,
            constants: &Self::Constants,
            t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
            u: &[f64; 0],
        ) -> [f64; 2] {
            <Self as lagrange::Surface<2, 0, 1>>::balance_at(self, constants, t, q, v, u)
                .accelerations
        }
        fn check_at(
            &self,
            _constants: &Self::Constants,
            t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
        ) -> ::core::result::Result<(), lagrange::Cause> {
            lagrange::constraints::check::<Self, 2, 0, 1>(self, t, q, v)
        }
        fn begin_at(
            &self,
            _constants: &Self::Constants,
            start: &mut lagrange::State<f64, 2>,
        ) -> ::core::result::Result<(), lagrange::Cause> {
            lagrange::constraints::begin::<Self, 2, 0, 1>(self, start)
        }
        #[inline]
        fn project_at(
            &self,
            _constants: &Self::Constants,
            state: &mut lagrange::State<f64, 2>,
            from: ::core::option::Option<&lagrange::State<f64, 2>>,
        ) -> ::core::result::Result<(), lagrange::Cause> {
            lagrange::constraints::project::<Self, 2, 0, 1>(self, state, from)
        }
        #[inline]
        fn land_at(
            &self,
            constants: &Self::Constants,
            state: &mut lagrange::State<f64, 2>,
            inputs: ::core::option::Option<&[f64; 0]>,
        ) -> ::core::result::Result<lagrange::Footing<f64, 2>, lagrange::Cause> {
            lagrange::constraints::land::<Self, 2, 0, 1>(self, constants, state, inputs)
        }
        fn tangential_at(
            &self,
            state: &lagrange::State<f64, 2>,
            change: &lagrange::State<f64, 2>,
        ) -> lagrange::State<f64, 2> {
            lagrange::constraints::tangential::<Self, 2, 0, 1>(self, state, change)
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
            inputs: &[f64; 0],
        ) -> ::core::result::Result<(), lagrange::Cause> {
            use lagrange::Real;
            let [x, y] = state.q;
            let mass_2: f64 = self.mass;
            let g: f64 = self.g;
            let length: f64 = self.length;
            let rod = Real::sqrt(x * x + y * y) - length;
            let abs_x = Real::abs(x);
            let abs_y = Real::abs(y);
            let gravity = mass_2 * g * y;
            use lagrange::reading::Numbers;
            let __coordinates = <CartesianPendulumCoordinates<
                f64,
            > as ::core::convert::From<_>>::from(state.q);
            lagrange::reading::compare(
                lagrange::Function(&["bob", lagrange::reading::MISREAD]),
                |take| self.bob(&__coordinates).each_number(take),
                &[x, y],
                &[abs_x, abs_y],
            )?;
            lagrange::reading::compare(
                lagrange::Function(&["gravity", lagrange::reading::MISREAD]),
                |take| self.gravity(&__coordinates).each_number(take),
                &[gravity],
                &[Real::abs(mass_2) * Real::abs(g) * abs_y],
            )?;
            lagrange::reading::compare(
                lagrange::Function(&["rod", lagrange::reading::MISREAD]),
                |take| self.rod(&__coordinates).each_number(take),
                &[rod],
                &[Real::sqrt(abs_x * abs_x + abs_y * abs_y) + Real::abs(length)],
            )?;
            ::core::result::Result::Ok(())
        }
    }
    #[automatically_derived]
    #[allow(clippy::all)]
    impl lagrange::Surface<2usize, 0usize, 1usize> for CartesianPendulum {
        type Saddle = lagrange::saddle::Diagonal<f64, 2, 1>;
        #[inline]
        fn equations_at(
            &self,
            constants: &Self::Constants,
            t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
            u: &[f64; 0],
        ) -> lagrange::Equations<Self::Saddle, f64, 2, 1> {
            use lagrange::Real;
            let [x, y] = *q;
            let [x_dot, y_dot] = *v;
            let [inverse_mass_2, minus_mass_2_g] = *constants;
            let x_x_dot_plus_y_y_dot = x * x_dot + y * y_dot;
            let w1 = 1.0 / Real::sqrt(x * x + y * y);
            let w2 = x_dot * x_dot + y_dot * y_dot
                - x_x_dot_plus_y_y_dot * x_x_dot_plus_y_y_dot * (w1 * w1);
            let mass = [inverse_mass_2, inverse_mass_2];
            let mut gradients = [[0.0; 2]; 1];
            gradients[0][0] = x * w1;
            gradients[0][1] = y * w1;
            lagrange::Equations {
                saddle: lagrange::saddle::Diagonal::<
                    f64,
                    2,
                    1,
                >::factor(mass, &gradients),
                gradients,
                forces: [0.0, minus_mass_2_g],
                gamma: [-(w2 * w1)],
            }
        }
        #[inline]
        fn residuals_at(
            &self,
            t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
        ) -> lagrange::Residuals<f64, 1> {
            use lagrange::Real;
            let [x, y] = *q;
            let [x_dot, y_dot] = *v;
            let length: f64 = self.length;
            let x_squared_plus_y_squared = x * x + y * y;
            let w1 = Real::sqrt(x_squared_plus_y_squared);
            let rod = w1 - length;
            let abs_x = Real::abs(x);
            let abs_y = Real::abs(y);
            lagrange::Residuals {
                positions: [rod],
                position_sizes: [
                    Real::sqrt(abs_x * abs_x + abs_y * abs_y) + Real::abs(length),
                ],
                rates: [(x * x_dot + y * y_dot) / w1],
                rate_sizes: [
                    (abs_x * Real::abs(x_dot) + abs_y * Real::abs(y_dot))
                        / Real::sqrt(Real::abs(x_squared_plus_y_squared)),
                ],
            }
        }
        #[inline]
        fn saddle_at(
            &self,
            t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
        ) -> (Self::Saddle, [[f64; 2]; 1]) {
            use lagrange::Real;
            let [x, y] = *q;
            let mass_2: f64 = self.mass;
            let inverse_mass_2 = 1.0 / mass_2;
            let w1 = 1.0 / Real::sqrt(x * x + y * y);
            let mass = [inverse_mass_2, inverse_mass_2];
            let mut gradients = [[0.0; 2]; 1];
            gradients[0][0] = x * w1;
            gradients[0][1] = y * w1;
            (
                lagrange::saddle::Diagonal::<f64, 2, 1>::factor(mass, &gradients),
                gradients,
            )
        }
    }
    #[automatically_derived]
    #[allow(clippy::all)]
    impl lagrange::Constrained<2usize, 0usize> for CartesianPendulum {
        type Reactions = CartesianPendulumReactions<f64>;
        #[inline]
        fn reactions_at(
            &self,
            constants: &Self::Constants,
            t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
            u: &[f64; 0],
        ) -> lagrange::Reactions<CartesianPendulumReactions<f64>> {
            let balance = <Self as lagrange::Surface<
                2,
                0,
                1,
            >>::balance_at(self, constants, t, q, v, u);
            lagrange::Reactions::new(
                balance.multipliers.into(),
                balance.independence.rank == 1,
            )
        }
    }
    impl lagrange::ConstantMass<2usize, 0usize> for CartesianPendulum {}
    impl lagrange::Autonomous<2usize, 0usize> for CartesianPendulum {}
    impl lagrange::Conservative<2usize, 0usize> for CartesianPendulum {}
    impl lagrange::Holonomic<2usize, 0usize> for CartesianPendulum {}
    impl lagrange::Scleronomic<2usize, 0usize> for CartesianPendulum {}
    #[automatically_derived]
    #[allow(clippy::all)]
    impl lagrange::Smooth<2usize, 0usize> for CartesianPendulum {
        type JetConstants = [f64; 2];
        type Tables<const ORDERS: usize> = lagrange::Tables<f64, 4, ORDERS>;
        #[inline]
        fn jet_constants(&self) -> [f64; 2] {
            let mass_2: f64 = self.mass;
            let g: f64 = self.g;
            [mass_2 * g, 1.0 / mass_2]
        }
        #[inline]
        fn jet_at<const ORDERS: usize>(
            &self,
            constants: &[f64; 2],
            _t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
            _u: &[f64; 0],
            h: f64,
            orders: usize,
            tables: &mut lagrange::Tables<f64, 4, ORDERS>,
            series: &mut lagrange::Series<f64, 2, ORDERS>,
        ) -> bool {
            use lagrange::Real;
            let [x, y] = *q;
            let [x_dot, y_dot] = *v;
            let [mass_2_g, inverse_mass_2] = *constants;
            let x_inverse_mass_2 = x * inverse_mass_2;
            let y_inverse_mass_2 = y * inverse_mass_2;
            let mut mass = [[0.0; 1]; 1];
            mass[0][0] = x_inverse_mass_2 * x + y_inverse_mass_2 * y;
            let saddle = lagrange::saddle::Schur::<
                f64,
                1,
            >::factor::<2>(mass, || ([inverse_mass_2, inverse_mass_2], [[x, y]]));
            if !saddle.is_finite() || saddle.vanishing().is_some() {
                return false;
            }
            let mut x_dot_last: f64 = x_dot;
            let mut x_force: f64 = 0.0;
            let mut y_dot_last: f64 = y_dot;
            let mut y_force: f64 = -mass_2_g;
            struct Products;
            impl lagrange::jets::Pairs<4> for Products {
                const FACTORS: &'static [[usize; 2]; 4] = &[
                    [0, 1],
                    [2, 3],
                    [0, 4],
                    [2, 4],
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
                    let x_k = rate * x_dot_last;
                    let y_k = rate * y_dot_last;
                    let w1 = inverse_mass_2 * (rate * (x_force + inner[2]));
                    let w2 = inverse_mass_2 * (rate * (y_force + inner[3]));
                    let w3 = Real::mul_add(
                        -x,
                        w1,
                        Real::mul_add(
                            -y_dot,
                            y_k,
                            Real::mul_add(-x_dot, x_k, -inner[0] - inner[1]),
                        ),
                    );
                    let [rod_multiplier_impulse] = saddle
                        .solve_order(order, &mass, [Real::mul_add(-y, w2, w3)]);
                    let rod_multiplier_k = lagrange::jets::multiplier(
                        rod_multiplier_impulse,
                        rate,
                    );
                    let x_dot_k = Real::mul_add(
                        x_inverse_mass_2,
                        rod_multiplier_impulse,
                        w1,
                    );
                    let y_dot_k = Real::mul_add(
                        y_inverse_mass_2,
                        rod_multiplier_impulse,
                        w2,
                    );
                    series.set(order, [x_k, y_k], [x_dot_k, y_dot_k]);
                    if order == orders {
                        return false;
                    }
                    products.add(order, [x_k, x_dot_k, y_k, y_dot_k, rod_multiplier_k]);
                    [x_dot_last, x_force, y_dot_last, y_force] = [
                        x_dot_k,
                        0.0,
                        y_dot_k,
                        0.0,
                    ];
                    true
                },
            );
            true
        }
    }
};
