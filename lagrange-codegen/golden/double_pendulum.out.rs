impl DoublePendulum {
    #[allow(dead_code)]
    fn upper(&self, q: &DoublePendulumCoordinates) -> Vector2<f64> {
        self.l[0] * Vector2::new(q.theta[0].sin(), -q.theta[0].cos())
    }
    #[allow(dead_code)]
    fn lower(&self, q: &DoublePendulumCoordinates) -> Vector2<f64> {
        self.upper(q) + self.l[1] * Vector2::new(q.theta[1].sin(), -q.theta[1].cos())
    }
    #[allow(dead_code)]
    fn gravity(&self, q: &DoublePendulumCoordinates) -> f64 {
        self.g * (self.m[0] * self.upper(q).y + self.m[1] * self.lower(q).y)
    }
}
///Generalized coordinates of [`DoublePendulum`].
#[allow(non_snake_case)]
pub struct DoublePendulumCoordinates<R = f64> {
    ///`theta`
    pub theta: [R; 2usize],
}
impl<R: ::core::marker::Copy> ::core::marker::Copy for DoublePendulumCoordinates<R> {}
impl<R: ::core::marker::Copy> ::core::clone::Clone for DoublePendulumCoordinates<R> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: ::core::fmt::Debug> ::core::fmt::Debug for DoublePendulumCoordinates<R> {
    fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
        f.debug_struct("DoublePendulumCoordinates").field("theta", &self.theta).finish()
    }
}
impl<R> ::core::convert::From<[R; 2usize]> for DoublePendulumCoordinates<R> {
    fn from([x0, x1]: [R; 2usize]) -> Self {
        Self { theta: [x0, x1] }
    }
}
impl<R> ::core::convert::From<DoublePendulumCoordinates<R>> for [R; 2usize] {
    fn from(
        DoublePendulumCoordinates { theta: [x0, x1] }: DoublePendulumCoordinates<R>,
    ) -> Self {
        [x0, x1]
    }
}
///Generalized velocities of [`DoublePendulum`].
#[allow(non_snake_case)]
pub struct DoublePendulumVelocities<R = f64> {
    ///`theta`
    pub theta: [R; 2usize],
}
impl<R: ::core::marker::Copy> ::core::marker::Copy for DoublePendulumVelocities<R> {}
impl<R: ::core::marker::Copy> ::core::clone::Clone for DoublePendulumVelocities<R> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: ::core::fmt::Debug> ::core::fmt::Debug for DoublePendulumVelocities<R> {
    fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
        f.debug_struct("DoublePendulumVelocities").field("theta", &self.theta).finish()
    }
}
impl<R> ::core::convert::From<[R; 2usize]> for DoublePendulumVelocities<R> {
    fn from([x0, x1]: [R; 2usize]) -> Self {
        Self { theta: [x0, x1] }
    }
}
impl<R> ::core::convert::From<DoublePendulumVelocities<R>> for [R; 2usize] {
    fn from(
        DoublePendulumVelocities { theta: [x0, x1] }: DoublePendulumVelocities<R>,
    ) -> Self {
        [x0, x1]
    }
}
const _: () = {
    use ::lagrangian::__private as lagrange;
    #[automatically_derived]
    #[allow(clippy::all)]
    impl DoublePendulum {
        /// The coordinates in the order of all vectors, to name the one that an error speaks of.
        pub const COORDINATES: [&'static str; 2usize] = ["theta[0]", "theta[1]"];
        /// Operations of one evaluation of the accelerations: all of them as derived, and as emitted without
        /// those done once per run. A factorisation in the runtime is in neither.
        pub const COST: lagrange::Costs = lagrange::Costs {
            before: lagrange::Cost::new(15u32, 31u32, 5u32, 0u32, 2u32),
            after: lagrange::Cost::new(9u32, 20u32, 1u32, 0u32, 2u32),
        };
        /// What was found in this system, and what its code therefore leaves out.
        pub const STRUCTURE: lagrange::Structure = lagrange::Structure {
            mass_matrix: "dense, solved by a factorisation written out (2 × 2)",
            facts: &[
                "conservative and autonomous: the energy is conserved",
                "smooth: a Taylor series of the motion takes 10 convolutions and the recurrences of 6 functions an order",
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
            let theta @ _ = ();
            let _: fn(
                &lagrange::nalgebra::Vector2<f64>,
            ) -> lagrange::nalgebra::Vector2<f64> = <Vector2<f64>>::clone;
        }
        /**Accelerations a that solve M(q, v, t) a = Q − ∂D/∂v − b(q, v, t).

The mass matrix is dense, solved by a factorisation written out (2 × 2).

# Errors

A singular mass matrix, with the coordinate and the time.*/
        #[inline]
        pub fn accelerations(
            &self,
            state: &lagrange::State<f64, 2>,
        ) -> ::core::result::Result<[f64; 2], lagrange::MotionError<f64>> {
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
            state: &lagrange::State<f64, 2>,
        ) -> lagrange::nalgebra::SMatrix<f64, 2, 2> {
            use lagrange::Real;
            let [theta_0, theta_1] = state.q;
            let m_0: f64 = self.m[0];
            let l_0: f64 = self.l[0];
            let m_1: f64 = self.m[1];
            let l_1: f64 = self.l[1];
            let (sin_theta_0, cos_theta_0) = Real::sin_cos(theta_0);
            let (sin_theta_1, cos_theta_1) = Real::sin_cos(theta_1);
            let mut mass = [[0.0; 2]; 2];
            mass[0][0] = l_0 * l_0 * (m_0 + m_1);
            mass[1][0] = l_0 * m_1 * l_1
                * (sin_theta_0 * sin_theta_1 + cos_theta_0 * cos_theta_1);
            mass[1][1] = m_1 * (l_1 * l_1);
            lagrange::solve::symmetric(mass)
        }
        /**Bias b(q, v, t) = d/dt(∂L/∂v) − ∂L/∂q at zero accelerations: inertia forces that depend on velocity, and ∂V/∂q. The equations of motion are M a + b = Q − ∂D/∂v.

- `b(theta[0]) = l[0]·(sin(theta[0])·g·(m[0] + m[1]) − theta′[1]^2·m[1]·l[1]·(cos(theta[0])·sin(theta[1]) − sin(theta[0])·cos(theta[1])))`
- `b(theta[1]) = m[1]·l[1]·(sin(theta[1])·g + theta′[0]^2·l[0]·(cos(theta[0])·sin(theta[1]) − sin(theta[0])·cos(theta[1])))`*/
        #[inline]
        pub fn bias(&self, state: &lagrange::State<f64, 2>) -> [f64; 2] {
            use lagrange::Real;
            let [theta_0, theta_1] = state.q;
            let [theta_0_dot, theta_1_dot] = state.v;
            let m_0: f64 = self.m[0];
            let l_0: f64 = self.l[0];
            let m_1: f64 = self.m[1];
            let l_1: f64 = self.l[1];
            let g: f64 = self.g;
            let (sin_theta_0, cos_theta_0) = Real::sin_cos(theta_0);
            let (sin_theta_1, cos_theta_1) = Real::sin_cos(theta_1);
            let w1 = cos_theta_0 * sin_theta_1 - sin_theta_0 * cos_theta_1;
            let m_1_l_1 = m_1 * l_1;
            [
                l_0
                    * (g * (m_0 + m_1) * sin_theta_0
                        - m_1_l_1 * (theta_1_dot * theta_1_dot * w1)),
                m_1_l_1 * (g * sin_theta_1 + l_0 * (theta_0_dot * theta_0_dot * w1)),
            ]
        }
        /**Generalized momenta p = ∂L/∂v.

- `p(theta[0]) = l[0]·(theta′[0]·l[0]·(m[0] + m[1]) + theta′[1]·m[1]·l[1]·(sin(theta[0])·sin(theta[1]) + cos(theta[0])·cos(theta[1])))`
- `p(theta[1]) = m[1]·l[1]·(theta′[1]·l[1] + theta′[0]·l[0]·(sin(theta[0])·sin(theta[1]) + cos(theta[0])·cos(theta[1])))`*/
        #[inline]
        pub fn momenta(&self, state: &lagrange::State<f64, 2>) -> [f64; 2] {
            use lagrange::Real;
            let [theta_0, theta_1] = state.q;
            let [theta_0_dot, theta_1_dot] = state.v;
            let m_0: f64 = self.m[0];
            let l_0: f64 = self.l[0];
            let m_1: f64 = self.m[1];
            let l_1: f64 = self.l[1];
            let (sin_theta_0, cos_theta_0) = Real::sin_cos(theta_0);
            let (sin_theta_1, cos_theta_1) = Real::sin_cos(theta_1);
            let w1 = sin_theta_0 * sin_theta_1 + cos_theta_0 * cos_theta_1;
            let m_1_l_1 = m_1 * l_1;
            [
                l_0 * (l_0 * (m_0 + m_1) * theta_0_dot + m_1_l_1 * (theta_1_dot * w1)),
                m_1_l_1 * (l_1 * theta_1_dot + l_0 * (theta_0_dot * w1)),
            ]
        }
        ///Kinetic energy T \[J\].
        #[inline]
        pub fn kinetic_energy(&self, state: &lagrange::State<f64, 2>) -> f64 {
            use lagrange::Real;
            let [theta_0, theta_1] = state.q;
            let [theta_0_dot, theta_1_dot] = state.v;
            let m_0: f64 = self.m[0];
            let l_0: f64 = self.l[0];
            let m_1: f64 = self.m[1];
            let l_1: f64 = self.l[1];
            let (sin_theta_0, cos_theta_0) = Real::sin_cos(theta_0);
            let (sin_theta_1, cos_theta_1) = Real::sin_cos(theta_1);
            let w1 = 0.5 * l_0 * (m_0 + m_1) * theta_0_dot
                + m_1 * l_1
                    * (theta_1_dot
                        * (sin_theta_0 * sin_theta_1 + cos_theta_0 * cos_theta_1));
            0.5 * m_1 * (l_1 * l_1) * (theta_1_dot * theta_1_dot)
                + l_0 * (theta_0_dot * w1)
        }
        /**Potential energy V \[J\].

`V = −g·(cos(theta[0])·l[0]·(m[0] + m[1]) + m[1]·cos(theta[1])·l[1])`*/
        #[inline]
        pub fn potential_energy(&self, state: &lagrange::State<f64, 2>) -> f64 {
            use lagrange::Real;
            let [theta_0, theta_1] = state.q;
            let m_0: f64 = self.m[0];
            let l_0: f64 = self.l[0];
            let m_1: f64 = self.m[1];
            let l_1: f64 = self.l[1];
            let g: f64 = self.g;
            -(g
                * (l_0 * (m_0 + m_1) * Real::cos(theta_0)
                    + m_1 * l_1 * Real::cos(theta_1)))
        }
        ///Energy T + V \[J\].
        #[inline]
        pub fn energy(&self, state: &lagrange::State<f64, 2>) -> f64 {
            self.kinetic_energy(state) + self.potential_energy(state)
        }
        /**The equations of motion as derived, M a + b = Q − ∂D/∂v + Aᵀλ, a line for each coordinate.

```text
l₀² (m₀ + m₁) θ̈₀ + l₀ m₁ l₁ θ̈₁ cos(θ₀ − θ₁) + l₀ g (m₀ + m₁) sin θ₀
      + l₀ m₁ l₁ θ̇₁² sin(θ₀ − θ₁) = 0
l₀ m₁ l₁ θ̈₀ cos(θ₀ − θ₁) + m₁ l₁² θ̈₁ + m₁ l₁ g sin θ₁
      − l₀ m₁ l₁ θ̇₀² sin(θ₀ − θ₁) = 0
```*/
        pub const EQUATIONS: &'static str = {
            let text = "l₀² (m₀ + m₁) θ\u{308}₀ + l₀ m₁ l₁ θ\u{308}₁ cos(θ₀ − θ₁) + l₀ g (m₀ + m₁) sin θ₀ + l₀ m₁ l₁ θ\u{307}₁² sin(θ₀ − θ₁) = 0\nl₀ m₁ l₁ θ\u{308}₀ cos(θ₀ − θ₁) + m₁ l₁² θ\u{308}₁ + m₁ l₁ g sin θ₁ − l₀ m₁ l₁ θ\u{307}₀² sin(θ₀ − θ₁) = 0";
            text
        };
    }
    #[automatically_derived]
    #[allow(clippy::all)]
    impl lagrange::System<2usize, 0usize> for DoublePendulum {
        type Scalar = f64;
        type Method = lagrange::Jets;
        type Constants = [f64; 6];
        const NAMES: lagrange::Names = lagrange::Names {
            coordinates: &["theta[0]", "theta[1]"],
            constraints: &[],
        };
        #[inline]
        fn constants(&self) -> Self::Constants {
            let m_0: f64 = self.m[0];
            let l_0: f64 = self.l[0];
            let m_1: f64 = self.m[1];
            let l_1: f64 = self.l[1];
            let g: f64 = self.g;
            let m_0_plus_m_1 = m_0 + m_1;
            [
                m_1 / m_0_plus_m_1,
                g * m_0_plus_m_1,
                m_1 * l_1,
                1.0 / m_0_plus_m_1,
                1.0 / (l_0 * m_0_plus_m_1),
                1.0 / l_1,
            ]
        }
        #[inline]
        fn accelerations_at(
            &self,
            constants: &Self::Constants,
            _t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
            _u: &[f64; 0],
        ) -> [f64; 2] {
            use lagrange::Real;
            let [theta_0, theta_1] = *q;
            let [theta_0_dot, theta_1_dot] = *v;
            let l_0: f64 = self.l[0];
            let m_1: f64 = self.m[1];
            let g: f64 = self.g;
            let [m_1_over_m_0_plus_m_1, g_m_0_plus_m_1, m_1_l_1, inverse_m_0_plus_m_1,
            inverse_l_0_m_0_plus_m_1, inverse_l_1] = *constants;
            let (sin_theta_0, cos_theta_0) = Real::sin_cos(theta_0);
            let (sin_theta_1, cos_theta_1) = Real::sin_cos(theta_1);
            let w1 = sin_theta_0 * sin_theta_1 + cos_theta_0 * cos_theta_1;
            let w2 = cos_theta_0 * sin_theta_1 - sin_theta_0 * cos_theta_1;
            let w3 = g_m_0_plus_m_1 * sin_theta_0
                - m_1_l_1 * (theta_1_dot * theta_1_dot * w2);
            let w4 = g * sin_theta_1 + l_0 * (theta_0_dot * theta_0_dot * w2)
                - inverse_m_0_plus_m_1 * (w1 * w3);
            let w5 = w4
                / lagrange::solve::pivot(1.0 - m_1_over_m_0_plus_m_1 * (w1 * w1), 1.0);
            [-(inverse_l_0_m_0_plus_m_1 * (w3 - m_1 * (w1 * w5))), -(inverse_l_1 * w5)]
        }
        fn check_at(
            &self,
            _constants: &Self::Constants,
            _t: f64,
            q: &[f64; 2],
            _v: &[f64; 2],
        ) -> ::core::result::Result<(), lagrange::Cause> {
            use lagrange::Real;
            let [theta_0, theta_1] = *q;
            let m_0: f64 = self.m[0];
            let l_0: f64 = self.l[0];
            let m_1: f64 = self.m[1];
            let l_1: f64 = self.l[1];
            let (sin_theta_0, cos_theta_0) = Real::sin_cos(theta_0);
            let (sin_theta_1, cos_theta_1) = Real::sin_cos(theta_1);
            let m_0_plus_m_1 = m_0 + m_1;
            let w1 = sin_theta_0 * sin_theta_1 + cos_theta_0 * cos_theta_1;
            let l_0_squared_m_0_plus_m_1 = l_0 * l_0 * m_0_plus_m_1;
            let m_1_l_1_squared = m_1 * (l_1 * l_1);
            lagrange::solve::check(
                l_0_squared_m_0_plus_m_1,
                l_0_squared_m_0_plus_m_1,
                0,
            )?;
            lagrange::solve::check(
                m_1_l_1_squared * (1.0 - m_1 / m_0_plus_m_1 * (w1 * w1)),
                m_1_l_1_squared,
                1,
            )?;
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
            inputs: &[f64; 0],
        ) -> ::core::result::Result<(), lagrange::Cause> {
            use lagrange::Real;
            let [theta_0, theta_1] = state.q;
            let m_0: f64 = self.m[0];
            let l_0: f64 = self.l[0];
            let m_1: f64 = self.m[1];
            let l_1: f64 = self.l[1];
            let g: f64 = self.g;
            let (sin_theta_0, cos_theta_0) = Real::sin_cos(theta_0);
            let (sin_theta_1, cos_theta_1) = Real::sin_cos(theta_1);
            let upper_x = l_0 * sin_theta_0;
            let lower_x = upper_x + l_1 * sin_theta_1;
            let l_0_cos_theta_0 = l_0 * cos_theta_0;
            let w1 = l_0_cos_theta_0 + l_1 * cos_theta_1;
            let abs_theta_0 = Real::abs(theta_0);
            let abs_sin_theta_0 = Real::abs(sin_theta_0);
            let abs_cos_theta_0 = Real::abs(cos_theta_0);
            let w2 = abs_cos_theta_0 + abs_theta_0 * abs_sin_theta_0;
            let abs_l_0 = Real::abs(l_0);
            let abs_theta_1 = Real::abs(theta_1);
            let abs_sin_theta_1 = Real::abs(sin_theta_1);
            let abs_cos_theta_1 = Real::abs(cos_theta_1);
            let abs_l_1 = Real::abs(l_1);
            let w3 = abs_l_0 * (abs_sin_theta_0 + abs_theta_0 * abs_cos_theta_0);
            let w4 = abs_l_0 * w2;
            let w5 = w4 + abs_l_1 * (abs_cos_theta_1 + abs_theta_1 * abs_sin_theta_1);
            let upper_y = -l_0_cos_theta_0;
            let lower_y = -w1;
            let gravity = -(g * (m_0 * l_0 * cos_theta_0 + m_1 * w1));
            use lagrange::reading::Numbers;
            let __coordinates = <DoublePendulumCoordinates<
                f64,
            > as ::core::convert::From<_>>::from(state.q);
            lagrange::reading::compare(
                lagrange::Function(&["upper", lagrange::reading::MISREAD]),
                |take| self.upper(&__coordinates).each_number(take),
                &[upper_x, upper_y],
                &[w3, w4],
            )?;
            lagrange::reading::compare(
                lagrange::Function(&["lower", lagrange::reading::MISREAD]),
                |take| self.lower(&__coordinates).each_number(take),
                &[lower_x, lower_y],
                &[w3 + abs_l_1 * (abs_sin_theta_1 + abs_theta_1 * abs_cos_theta_1), w5],
            )?;
            lagrange::reading::compare(
                lagrange::Function(&["gravity", lagrange::reading::MISREAD]),
                |take| self.gravity(&__coordinates).each_number(take),
                &[gravity],
                &[Real::abs(g) * (abs_l_0 * Real::abs(m_0) * w2 + Real::abs(m_1) * w5)],
            )?;
            ::core::result::Result::Ok(())
        }
    }
    impl lagrange::Autonomous<2usize, 0usize> for DoublePendulum {}
    impl lagrange::Conservative<2usize, 0usize> for DoublePendulum {}
    impl lagrange::Holonomic<2usize, 0usize> for DoublePendulum {}
    impl lagrange::Scleronomic<2usize, 0usize> for DoublePendulum {}
    #[automatically_derived]
    #[allow(clippy::all)]
    impl lagrange::Smooth<2usize, 0usize> for DoublePendulum {
        type JetConstants = [f64; 5];
        type Tables<const ORDERS: usize> = lagrange::Tables<f64, 12, ORDERS>;
        #[inline]
        fn jet_constants(&self) -> [f64; 5] {
            let m_0: f64 = self.m[0];
            let l_0: f64 = self.l[0];
            let m_1: f64 = self.m[1];
            let l_1: f64 = self.l[1];
            let g: f64 = self.g;
            let m_0_plus_m_1 = m_0 + m_1;
            [
                m_1 * l_1,
                g * m_0_plus_m_1,
                l_0 * l_0 * m_0_plus_m_1,
                l_0 * m_1 * l_1,
                m_1 * (l_1 * l_1),
            ]
        }
        #[inline]
        fn jet_at<const ORDERS: usize>(
            &self,
            constants: &[f64; 5],
            _t: f64,
            q: &[f64; 2],
            v: &[f64; 2],
            _u: &[f64; 0],
            h: f64,
            orders: usize,
            tables: &mut lagrange::Tables<f64, 12, ORDERS>,
            series: &mut lagrange::Series<f64, 2, ORDERS>,
        ) -> bool {
            use lagrange::Real;
            let [theta_0, theta_1] = *q;
            let [theta_0_dot, theta_1_dot] = *v;
            let l_0: f64 = self.l[0];
            let g: f64 = self.g;
            let [m_1_l_1, g_m_0_plus_m_1, l_0_squared_m_0_plus_m_1, l_0_m_1_l_1,
            m_1_l_1_squared] = *constants;
            let theta_0_minus_theta_1 = theta_0 - theta_1;
            let (sin_theta_0, cos_theta_0) = Real::sin_cos(theta_0);
            let (sin_theta_1, cos_theta_1) = Real::sin_cos(theta_1);
            let (sin_theta_0_minus_theta_1, cos_theta_0_minus_theta_1) = Real::sin_cos(
                theta_0_minus_theta_1,
            );
            let cos_theta_0_minus_theta_1_flow_part = theta_0_dot - theta_1_dot;
            let theta_1_dot_theta_0_dot = theta_1_dot * theta_0_dot;
            let theta_0_force_part = sin_theta_0_minus_theta_1 * theta_1_dot_theta_0_dot;
            let mut mass = [[0.0; 2]; 2];
            mass[0][0] = l_0_squared_m_0_plus_m_1;
            mass[1][0] = l_0_m_1_l_1
                * (sin_theta_0 * sin_theta_1 + cos_theta_0 * cos_theta_1);
            mass[1][1] = m_1_l_1_squared;
            let ::core::option::Option::Some(theta_0_factors) = lagrange::solve::factor::<
                lagrange::Ldlt<f64, 2>,
                _,
                _,
            >(mass) else {
                return false;
            };
            let mut theta_0_dot_last: f64 = theta_0_dot;
            let mut theta_0_force: f64 = -(l_0
                * (g_m_0_plus_m_1 * sin_theta_0 + m_1_l_1 * theta_0_force_part));
            let mut theta_1_dot_last: f64 = theta_1_dot;
            let mut theta_1_force: f64 = -(m_1_l_1
                * (g * sin_theta_1 - l_0 * theta_0_force_part));
            let mut sin_theta_0_flow: f64 = theta_0_dot * cos_theta_0;
            let mut cos_theta_0_flow: f64 = -(theta_0_dot * sin_theta_0);
            let mut sin_theta_1_flow: f64 = theta_1_dot * cos_theta_1;
            let mut cos_theta_1_flow: f64 = -(theta_1_dot * sin_theta_1);
            let mut cos_theta_0_minus_theta_1_flow: f64 = -(sin_theta_0_minus_theta_1
                * cos_theta_0_minus_theta_1_flow_part);
            let mut sin_theta_0_minus_theta_1_flow: f64 = cos_theta_0_minus_theta_1
                * cos_theta_0_minus_theta_1_flow_part;
            struct Products;
            impl lagrange::jets::Pairs<10> for Products {
                const FACTORS: &'static [[usize; 2]; 10] = &[
                    [0, 1],
                    [2, 1],
                    [2, 0],
                    [3, 4],
                    [0, 5],
                    [0, 6],
                    [2, 7],
                    [2, 8],
                    [3, 9],
                    [1, 9],
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
                    let theta_0_k = rate * theta_0_dot_last;
                    let theta_1_k = rate * theta_1_dot_last;
                    let sin_theta_0_k = rate * sin_theta_0_flow;
                    let cos_theta_0_k = rate * cos_theta_0_flow;
                    let sin_theta_1_k = rate * sin_theta_1_flow;
                    let cos_theta_1_k = rate * cos_theta_1_flow;
                    let cos_theta_0_minus_theta_1_k = rate
                        * cos_theta_0_minus_theta_1_flow;
                    let sin_theta_0_minus_theta_1_k = rate
                        * sin_theta_0_minus_theta_1_flow;
                    let theta_0_momentum_part_partial = -(l_0
                        * (m_1_l_1
                            * Real::mul_add(
                                theta_1_dot,
                                cos_theta_0_minus_theta_1_k,
                                inner[1],
                            )));
                    let theta_1_momentum_part_partial = -(m_1_l_1
                        * (l_0
                            * Real::mul_add(
                                theta_0_dot,
                                cos_theta_0_minus_theta_1_k,
                                inner[0],
                            )));
                    let w1 = Real::mul_add(
                        theta_1_dot_theta_0_dot,
                        sin_theta_0_minus_theta_1_k,
                        inner[3],
                    );
                    let w2 = g * sin_theta_1_k;
                    let w3 = g_m_0_plus_m_1 * sin_theta_0_k;
                    let theta_0_dot_cos_theta_0_known = Real::mul_add(
                        theta_0_dot,
                        cos_theta_0_k,
                        inner[4],
                    );
                    let cos_theta_0_flow_part_known = Real::mul_add(
                        -theta_0_dot,
                        sin_theta_0_k,
                        -inner[5],
                    );
                    let theta_1_dot_cos_theta_1_known = Real::mul_add(
                        theta_1_dot,
                        cos_theta_1_k,
                        inner[6],
                    );
                    let cos_theta_1_flow_part_known = Real::mul_add(
                        -theta_1_dot,
                        sin_theta_1_k,
                        -inner[7],
                    );
                    let cos_theta_0_minus_theta_1_flow_part_known = Real::mul_add(
                        -cos_theta_0_minus_theta_1_flow_part,
                        sin_theta_0_minus_theta_1_k,
                        -inner[8],
                    );
                    let sin_theta_0_minus_theta_1_flow_part_known = Real::mul_add(
                        cos_theta_0_minus_theta_1_flow_part,
                        cos_theta_0_minus_theta_1_k,
                        inner[9],
                    );
                    let [theta_0_dot_k, theta_1_dot_k] = theta_0_factors
                        .solve([
                            Real::mul_add(
                                rate,
                                theta_0_force,
                                theta_0_momentum_part_partial,
                            ),
                            Real::mul_add(
                                rate,
                                theta_1_force,
                                theta_1_momentum_part_partial,
                            ),
                        ]);
                    series
                        .set(
                            order,
                            [theta_0_k, theta_1_k],
                            [theta_0_dot_k, theta_1_dot_k],
                        );
                    if order == orders {
                        return false;
                    }
                    let cos_theta_0_minus_theta_1_flow_part_k = theta_0_dot_k
                        - theta_1_dot_k;
                    let theta_1_dot_theta_0_dot_k = Real::mul_add(
                        theta_0_dot,
                        theta_1_dot_k,
                        Real::mul_add(theta_1_dot, theta_0_dot_k, inner[2]),
                    );
                    let theta_0_force_part_k = Real::mul_add(
                        sin_theta_0_minus_theta_1,
                        theta_1_dot_theta_0_dot_k,
                        w1,
                    );
                    products
                        .add(
                            order,
                            [
                                theta_0_dot_k,
                                cos_theta_0_minus_theta_1_k,
                                theta_1_dot_k,
                                sin_theta_0_minus_theta_1_k,
                                theta_1_dot_theta_0_dot_k,
                                cos_theta_0_k,
                                sin_theta_0_k,
                                cos_theta_1_k,
                                sin_theta_1_k,
                                cos_theta_0_minus_theta_1_flow_part_k,
                            ],
                        );
                    [
                        theta_0_dot_last,
                        theta_0_force,
                        theta_1_dot_last,
                        theta_1_force,
                        sin_theta_0_flow,
                        cos_theta_0_flow,
                        sin_theta_1_flow,
                        cos_theta_1_flow,
                        cos_theta_0_minus_theta_1_flow,
                        sin_theta_0_minus_theta_1_flow,
                    ] = [
                        theta_0_dot_k,
                        -(l_0 * Real::mul_add(m_1_l_1, theta_0_force_part_k, w3)),
                        theta_1_dot_k,
                        -(m_1_l_1 * Real::mul_add(-l_0, theta_0_force_part_k, w2)),
                        Real::mul_add(
                            cos_theta_0,
                            theta_0_dot_k,
                            theta_0_dot_cos_theta_0_known,
                        ),
                        Real::mul_add(
                            -sin_theta_0,
                            theta_0_dot_k,
                            cos_theta_0_flow_part_known,
                        ),
                        Real::mul_add(
                            cos_theta_1,
                            theta_1_dot_k,
                            theta_1_dot_cos_theta_1_known,
                        ),
                        Real::mul_add(
                            -sin_theta_1,
                            theta_1_dot_k,
                            cos_theta_1_flow_part_known,
                        ),
                        Real::mul_add(
                            -sin_theta_0_minus_theta_1,
                            cos_theta_0_minus_theta_1_flow_part_k,
                            cos_theta_0_minus_theta_1_flow_part_known,
                        ),
                        Real::mul_add(
                            cos_theta_0_minus_theta_1,
                            cos_theta_0_minus_theta_1_flow_part_k,
                            sin_theta_0_minus_theta_1_flow_part_known,
                        ),
                    ];
                    true
                },
            );
            true
        }
    }
};
