impl<R: Real> CartPole<R> {
    #[allow(dead_code)]
    fn cart(&self, q: &CartPoleCoordinates<R>) -> Vector2<R> {
        Vector2::new(q.x, R::zero())
    }
    #[allow(dead_code)]
    fn tip(&self, q: &CartPoleCoordinates<R>) -> Vector2<R> {
        self.cart(q) + Vector2::new(q.theta.sin(), q.theta.cos()) * self.length
    }
    #[allow(dead_code)]
    fn gravity(&self, q: &CartPoleCoordinates<R>) -> R {
        self.pole_mass * self.g * self.tip(q).y
    }
    #[allow(dead_code)]
    fn bearing(&self, v: &CartPoleVelocities<R>) -> R {
        <R as ::lagrangian::Real>::from_f64(0.5) * self.damping * v.theta.powi(2)
    }
    #[allow(dead_code)]
    fn motor(&self, u: &CartPoleInputs<R>) -> Vector2<R> {
        Vector2::new(u.motor, R::zero())
    }
}
///Generalized coordinates of [`CartPole`].
#[allow(non_snake_case)]
pub struct CartPoleCoordinates<R = f64> {
    ///`x`
    pub x: R,
    ///`theta`
    pub theta: R,
}
impl<R: ::core::marker::Copy> ::core::marker::Copy for CartPoleCoordinates<R> {}
impl<R: ::core::marker::Copy> ::core::clone::Clone for CartPoleCoordinates<R> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: ::core::fmt::Debug> ::core::fmt::Debug for CartPoleCoordinates<R> {
    fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
        f.debug_struct("CartPoleCoordinates")
            .field("x", &self.x)
            .field("theta", &self.theta)
            .finish()
    }
}
impl<R> ::core::convert::From<[R; 2usize]> for CartPoleCoordinates<R> {
    fn from([x0, x1]: [R; 2usize]) -> Self {
        Self { x: x0, theta: x1 }
    }
}
impl<R> ::core::convert::From<CartPoleCoordinates<R>> for [R; 2usize] {
    fn from(CartPoleCoordinates { x: x0, theta: x1 }: CartPoleCoordinates<R>) -> Self {
        [x0, x1]
    }
}
///Generalized velocities of [`CartPole`].
#[allow(non_snake_case)]
pub struct CartPoleVelocities<R = f64> {
    ///`x`
    pub x: R,
    ///`theta`
    pub theta: R,
}
impl<R: ::core::marker::Copy> ::core::marker::Copy for CartPoleVelocities<R> {}
impl<R: ::core::marker::Copy> ::core::clone::Clone for CartPoleVelocities<R> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: ::core::fmt::Debug> ::core::fmt::Debug for CartPoleVelocities<R> {
    fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
        f.debug_struct("CartPoleVelocities")
            .field("x", &self.x)
            .field("theta", &self.theta)
            .finish()
    }
}
impl<R> ::core::convert::From<[R; 2usize]> for CartPoleVelocities<R> {
    fn from([x0, x1]: [R; 2usize]) -> Self {
        Self { x: x0, theta: x1 }
    }
}
impl<R> ::core::convert::From<CartPoleVelocities<R>> for [R; 2usize] {
    fn from(CartPoleVelocities { x: x0, theta: x1 }: CartPoleVelocities<R>) -> Self {
        [x0, x1]
    }
}
///Inputs of [`CartPole`].
#[allow(non_snake_case)]
pub struct CartPoleInputs<R = f64> {
    ///`motor`
    pub motor: R,
}
impl<R: ::core::marker::Copy> ::core::marker::Copy for CartPoleInputs<R> {}
impl<R: ::core::marker::Copy> ::core::clone::Clone for CartPoleInputs<R> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<R: ::core::fmt::Debug> ::core::fmt::Debug for CartPoleInputs<R> {
    fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
        f.debug_struct("CartPoleInputs").field("motor", &self.motor).finish()
    }
}
impl<R> ::core::convert::From<[R; 1usize]> for CartPoleInputs<R> {
    fn from([x0]: [R; 1usize]) -> Self {
        Self { motor: x0 }
    }
}
impl<R> ::core::convert::From<CartPoleInputs<R>> for [R; 1usize] {
    fn from(CartPoleInputs { motor: x0 }: CartPoleInputs<R>) -> Self {
        [x0]
    }
}
const _: () = {
    use ::lagrangian::__private as lagrange;
    #[automatically_derived]
    #[allow(clippy::all)]
    impl<R: Real> CartPole<R> {
        /// The coordinates in the order of all vectors, to name the one that an error speaks of.
        pub const COORDINATES: [&'static str; 2usize] = ["x", "theta"];
        /// Operations of one evaluation of the accelerations: all of them as derived, and as emitted without
        /// those done once per run. A factorisation in the runtime is in neither.
        pub const COST: lagrange::Costs = lagrange::Costs {
            before: lagrange::Cost::new(6u32, 17u32, 6u32, 0u32, 1u32),
            after: lagrange::Cost::new(5u32, 13u32, 1u32, 0u32, 1u32),
        };
        /// What was found in this system, and what its code therefore leaves out.
        pub const STRUCTURE: lagrange::Structure = lagrange::Structure {
            mass_matrix: "dense, solved by a factorisation written out (2 × 2)",
            facts: &[
                "smooth: a Taylor series of the motion takes 4 convolutions and the recurrences of 2 functions an order",
            ],
            skipped: &["time: nothing depends on it", "constraints and multipliers"],
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
            let theta @ _ = ();
            let motor @ _ = ();
            let _: fn(
                &lagrange::nalgebra::Vector2<R>,
            ) -> lagrange::nalgebra::Vector2<R> = <Vector2<R>>::clone;
        }
        /**Accelerations a that solve M(q, v, t) a = Q − ∂D/∂v − b(q, v, t).

The mass matrix is dense, solved by a factorisation written out (2 × 2).

# Errors

A singular mass matrix, with the coordinate and the time.*/
        #[inline]
        pub fn accelerations(
            &self,
            state: &lagrange::State<R, 2>,
            inputs: &[R; 1],
        ) -> ::core::result::Result<[R; 2], lagrange::MotionError<R>> {
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
            state: &lagrange::State<R, 2>,
        ) -> lagrange::nalgebra::SMatrix<R, 2, 2> {
            use lagrange::Real;
            let [_, theta] = state.q;
            let cart_mass: R = self.cart_mass;
            let pole_mass: R = self.pole_mass;
            let length: R = self.length;
            let mut mass = [[<R as lagrange::Zero>::zero(); 2]; 2];
            mass[0][0] = cart_mass + pole_mass;
            mass[1][0] = pole_mass * length * Real::cos(theta);
            mass[1][1] = pole_mass * (length * length);
            lagrange::solve::symmetric(mass)
        }
        /**Bias b(q, v, t) = d/dt(∂L/∂v) − ∂L/∂q at zero accelerations: inertia forces that depend on velocity, and ∂V/∂q. The equations of motion are M a + b = Q − ∂D/∂v.

- `b(x) = −theta′^2·pole_mass·sin(theta)·length`
- `b(theta) = −pole_mass·sin(theta)·length·g`*/
        #[inline]
        pub fn bias(&self, state: &lagrange::State<R, 2>) -> [R; 2] {
            use lagrange::Real;
            let [_, theta] = state.q;
            let [_, theta_dot] = state.v;
            let pole_mass: R = self.pole_mass;
            let length: R = self.length;
            let g: R = self.g;
            let sin_theta = Real::sin(theta);
            let pole_mass_length = pole_mass * length;
            [
                -(pole_mass_length * (theta_dot * theta_dot * sin_theta)),
                -(pole_mass_length * g * sin_theta),
            ]
        }
        /**Generalized applied forces Q − ∂D/∂v.

- `Q(x) = motor`
- `Q(theta) = −theta′·damping`*/
        #[inline]
        pub fn applied_forces(
            &self,
            state: &lagrange::State<R, 2>,
            inputs: &[R; 1],
        ) -> [R; 2] {
            let [_, theta_dot] = state.v;
            let [motor] = *inputs;
            let damping: R = self.damping;
            [motor, -(damping * theta_dot)]
        }
        /**Generalized momenta p = ∂L/∂v.

- `p(x) = theta′·pole_mass·cos(theta)·length + x′·(cart_mass + pole_mass)`
- `p(theta) = pole_mass·length·(theta′·length + x′·cos(theta))`*/
        #[inline]
        pub fn momenta(&self, state: &lagrange::State<R, 2>) -> [R; 2] {
            use lagrange::Real;
            let [_, theta] = state.q;
            let [x_dot, theta_dot] = state.v;
            let cart_mass: R = self.cart_mass;
            let pole_mass: R = self.pole_mass;
            let length: R = self.length;
            let cos_theta = Real::cos(theta);
            let pole_mass_length = pole_mass * length;
            [
                pole_mass_length * (theta_dot * cos_theta)
                    + (cart_mass + pole_mass) * x_dot,
                pole_mass_length * (length * theta_dot + x_dot * cos_theta),
            ]
        }
        /**Kinetic energy T \[J\].

`T = 0.5·theta′^2·pole_mass·length^2 + x′·(theta′·pole_mass·cos(theta)·length + 0.5·x′·(cart_mass + pole_mass))`*/
        #[inline]
        pub fn kinetic_energy(&self, state: &lagrange::State<R, 2>) -> R {
            use lagrange::Real;
            let [_, theta] = state.q;
            let [x_dot, theta_dot] = state.v;
            let cart_mass: R = self.cart_mass;
            let pole_mass: R = self.pole_mass;
            let length: R = self.length;
            let w1 = pole_mass * length * (theta_dot * Real::cos(theta))
                + <R as lagrange::Real>::from_f64(0.5) * (cart_mass + pole_mass) * x_dot;
            let w2 = <R as lagrange::Real>::from_f64(0.5) * pole_mass * (length * length)
                * (theta_dot * theta_dot);
            w2 + x_dot * w1
        }
        /**Potential energy V \[J\].

`V = pole_mass·cos(theta)·length·g`*/
        #[inline]
        pub fn potential_energy(&self, state: &lagrange::State<R, 2>) -> R {
            use lagrange::Real;
            let [_, theta] = state.q;
            let pole_mass: R = self.pole_mass;
            let length: R = self.length;
            let g: R = self.g;
            let gravity = pole_mass * length * g * Real::cos(theta);
            gravity
        }
        /**Power v·(Q − ∂D/∂v) of the applied forces \[W\].

`P = −(theta′^2·damping − x′·motor)`*/
        #[inline]
        pub fn power(&self, state: &lagrange::State<R, 2>, inputs: &[R; 1]) -> R {
            let [x_dot, theta_dot] = state.v;
            let [motor] = *inputs;
            let damping: R = self.damping;
            -(damping * (theta_dot * theta_dot) - x_dot * motor)
        }
        ///Energy T + V \[J\].
        #[inline]
        pub fn energy(&self, state: &lagrange::State<R, 2>) -> R {
            self.kinetic_energy(state) + self.potential_energy(state)
        }
        /**The equations of motion as derived, M a + b = Q − ∂D/∂v + Aᵀλ, a line for each coordinate.

```text
(cart_mass + pole_mass) ẍ + pole_mass·length·θ̈ cos θ
      − pole_mass·length·θ̇² sin θ = motor
pole_mass·length·ẍ cos θ + pole_mass·length²·θ̈
      − pole_mass·length·g sin θ = −damping·θ̇
```*/
        pub const EQUATIONS: &'static str = {
            let text = "(cart_mass + pole_mass) x\u{308} + pole_mass·length·θ\u{308} cos θ − pole_mass·length·θ\u{307}² sin θ = motor\npole_mass·length·x\u{308} cos θ + pole_mass·length²·θ\u{308} − pole_mass·length·g sin θ = −damping·θ\u{307}";
            text
        };
    }
    #[automatically_derived]
    #[allow(clippy::all)]
    impl<R: Real> lagrange::System<2usize, 1usize> for CartPole<R> {
        type Scalar = R;
        type Method = lagrange::Jets;
        type Constants = [R; 7];
        const NAMES: lagrange::Names = lagrange::Names {
            coordinates: &["x", "theta"],
            constraints: &[],
        };
        #[inline]
        fn constants(&self) -> Self::Constants {
            let cart_mass: R = self.cart_mass;
            let pole_mass: R = self.pole_mass;
            let length: R = self.length;
            let g: R = self.g;
            let cart_mass_plus_pole_mass = cart_mass + pole_mass;
            let pole_mass_length = pole_mass * length;
            [
                pole_mass_length,
                pole_mass_length * g,
                pole_mass / cart_mass_plus_pole_mass,
                pole_mass_length / cart_mass_plus_pole_mass,
                <R as lagrange::One>::one() / length,
                <R as lagrange::One>::one() / cart_mass_plus_pole_mass,
                <R as lagrange::One>::one() / (pole_mass * (length * length)),
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
            let [_, theta] = *q;
            let [_, theta_dot] = *v;
            let [motor] = *u;
            let damping: R = self.damping;
            let [pole_mass_length, pole_mass_length_g, w1, w2, inverse_length, w3, w4] = *constants;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let w5 = motor + pole_mass_length * (theta_dot * theta_dot * sin_theta);
            let w6 = lagrange::solve::pivot(
                <R as lagrange::One>::one() - w1 * (cos_theta * cos_theta),
                <R as lagrange::One>::one(),
            );
            let w7 = (pole_mass_length_g * sin_theta - damping * theta_dot
                - w2 * (cos_theta * w5)) / w6;
            [w3 * (w5 - inverse_length * (cos_theta * w7)), w4 * w7]
        }
        fn check_at(
            &self,
            _constants: &Self::Constants,
            _t: R,
            q: &[R; 2],
            _v: &[R; 2],
        ) -> ::core::result::Result<(), lagrange::Cause> {
            use lagrange::Real;
            let [_, theta] = *q;
            let cart_mass: R = self.cart_mass;
            let pole_mass: R = self.pole_mass;
            let length: R = self.length;
            let cos_theta = Real::cos(theta);
            let cart_mass_plus_pole_mass = cart_mass + pole_mass;
            let w1 = <R as lagrange::One>::one()
                - pole_mass / cart_mass_plus_pole_mass * (cos_theta * cos_theta);
            let pole_mass_length_squared = pole_mass * (length * length);
            lagrange::solve::check(
                cart_mass_plus_pole_mass,
                cart_mass_plus_pole_mass,
                0,
            )?;
            lagrange::solve::check(
                pole_mass_length_squared * w1,
                pole_mass_length_squared,
                1,
            )?;
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
        #[cfg(debug_assertions)]
        const READ: bool = true;
        #[cfg(debug_assertions)]
        #[allow(unused_variables)]
        fn check_reading_at(
            &self,
            state: &lagrange::State<R, 2>,
            inputs: &[R; 1],
        ) -> ::core::result::Result<(), lagrange::Cause> {
            use lagrange::Real;
            let [x, theta] = state.q;
            let [_, theta_dot] = state.v;
            let [motor] = *inputs;
            let pole_mass: R = self.pole_mass;
            let length: R = self.length;
            let g: R = self.g;
            let damping: R = self.damping;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let tip_x = x + length * sin_theta;
            let abs_x = Real::abs(x);
            let abs_theta = Real::abs(theta);
            let abs_sin_theta = Real::abs(sin_theta);
            let abs_cos_theta = Real::abs(cos_theta);
            let w1 = abs_cos_theta + abs_theta * abs_sin_theta;
            let abs_length = Real::abs(length);
            let abs_theta_dot = Real::abs(theta_dot);
            let tip_y = length * cos_theta;
            let gravity = pole_mass * length * g * cos_theta;
            let bearing = <R as lagrange::Real>::from_f64(0.5) * damping
                * (theta_dot * theta_dot);
            use lagrange::reading::Numbers;
            let __coordinates = <CartPoleCoordinates<
                R,
            > as ::core::convert::From<_>>::from(state.q);
            let __velocities = <CartPoleVelocities<
                R,
            > as ::core::convert::From<_>>::from(state.v);
            let __inputs = <CartPoleInputs<
                R,
            > as ::core::convert::From<_>>::from(*inputs);
            lagrange::reading::compare(
                lagrange::Function(&["cart", lagrange::reading::MISREAD]),
                |take| self.cart(&__coordinates).each_number(take),
                &[x, <R as lagrange::Zero>::zero()],
                &[abs_x, <R as lagrange::Zero>::zero()],
            )?;
            lagrange::reading::compare(
                lagrange::Function(&["tip", lagrange::reading::MISREAD]),
                |take| self.tip(&__coordinates).each_number(take),
                &[tip_x, tip_y],
                &[
                    abs_x + abs_length * (abs_sin_theta + abs_theta * abs_cos_theta),
                    abs_length * w1,
                ],
            )?;
            lagrange::reading::compare(
                lagrange::Function(&["gravity", lagrange::reading::MISREAD]),
                |take| self.gravity(&__coordinates).each_number(take),
                &[gravity],
                &[abs_length * Real::abs(pole_mass) * Real::abs(g) * w1],
            )?;
            lagrange::reading::compare(
                lagrange::Function(&["bearing", lagrange::reading::MISREAD]),
                |take| self.bearing(&__velocities).each_number(take),
                &[bearing],
                &[
                    <R as lagrange::Real>::from_f64(0.5) * Real::abs(damping)
                        * (abs_theta_dot * abs_theta_dot),
                ],
            )?;
            lagrange::reading::compare(
                lagrange::Function(&["motor", lagrange::reading::MISREAD]),
                |take| self.motor(&__inputs).each_number(take),
                &[motor, <R as lagrange::Zero>::zero()],
                &[Real::abs(motor), <R as lagrange::Zero>::zero()],
            )?;
            ::core::result::Result::Ok(())
        }
    }
    impl<R: Real> lagrange::Autonomous<2usize, 1usize> for CartPole<R> {}
    impl<R: Real> lagrange::Holonomic<2usize, 1usize> for CartPole<R> {}
    impl<R: Real> lagrange::Scleronomic<2usize, 1usize> for CartPole<R> {}
    #[automatically_derived]
    #[allow(clippy::all)]
    impl<R: Real> lagrange::Smooth<2usize, 1usize> for CartPole<R> {
        type JetConstants = [R; 3];
        type Tables<const ORDERS: usize> = lagrange::Tables<R, 4, ORDERS>;
        #[inline]
        fn jet_constants(&self) -> [R; 3] {
            let cart_mass: R = self.cart_mass;
            let pole_mass: R = self.pole_mass;
            let length: R = self.length;
            [cart_mass + pole_mass, pole_mass * length, pole_mass * (length * length)]
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
            tables: &mut lagrange::Tables<R, 4, ORDERS>,
            series: &mut lagrange::Series<R, 2, ORDERS>,
        ) -> bool {
            use lagrange::Real;
            let [_, theta] = *q;
            let [x_dot, theta_dot] = *v;
            let [motor] = *u;
            let g: R = self.g;
            let damping: R = self.damping;
            let [cart_mass_plus_pole_mass, pole_mass_length, pole_mass_length_squared] = *constants;
            let (sin_theta, cos_theta) = Real::sin_cos(theta);
            let theta_dot_sin_theta = theta_dot * sin_theta;
            let theta_force_part = damping * theta_dot
                - pole_mass_length * (g * sin_theta - x_dot * theta_dot_sin_theta);
            let mut mass = [[<R as lagrange::Zero>::zero(); 2]; 2];
            mass[0][0] = cart_mass_plus_pole_mass;
            mass[1][0] = pole_mass_length * cos_theta;
            mass[1][1] = pole_mass_length_squared;
            let ::core::option::Option::Some(x_factors) = lagrange::solve::factor::<
                lagrange::Ldlt<R, 2>,
                _,
                _,
            >(mass) else {
                return false;
            };
            let mut x_dot_last: R = x_dot;
            let mut x_force: R = motor;
            let mut theta_dot_last: R = theta_dot;
            let mut theta_force: R = -theta_force_part;
            let mut sin_theta_flow: R = theta_dot * cos_theta;
            let mut cos_theta_flow: R = -theta_dot_sin_theta;
            struct Products;
            impl lagrange::jets::Pairs<4> for Products {
                const FACTORS: &'static [[usize; 2]; 4] = &[
                    [0, 1],
                    [2, 3],
                    [0, 3],
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
                    let rate: R = lagrange::jets::rate(h, order);
                    let inner = products.sums(order);
                    let x_k = rate * x_dot_last;
                    let theta_k = rate * theta_dot_last;
                    let sin_theta_k = rate * sin_theta_flow;
                    let cos_theta_k = rate * cos_theta_flow;
                    let theta_dot_cos_theta_known = Real::mul_add(
                        theta_dot,
                        cos_theta_k,
                        inner[2],
                    );
                    let w1 = Real::mul_add(theta_dot, sin_theta_k, inner[0]);
                    let w2 = Real::mul_add(g, sin_theta_k, -inner[3]);
                    let [x_dot_k, theta_dot_k] = x_factors
                        .solve([
                            Real::mul_add(
                                rate,
                                x_force,
                                -(pole_mass_length * theta_dot_cos_theta_known),
                            ),
                            Real::mul_add(
                                rate,
                                theta_force,
                                -(pole_mass_length
                                    * Real::mul_add(x_dot, cos_theta_k, inner[1])),
                            ),
                        ]);
                    series.set(order, [x_k, theta_k], [x_dot_k, theta_dot_k]);
                    if order == orders {
                        return false;
                    }
                    let theta_dot_sin_theta_k = Real::mul_add(
                        sin_theta,
                        theta_dot_k,
                        w1,
                    );
                    let theta_force_part_k = Real::mul_add(
                        -theta_dot_sin_theta,
                        x_dot_k,
                        Real::mul_add(-x_dot, theta_dot_sin_theta_k, w2),
                    );
                    products
                        .add(
                            order,
                            [
                                theta_dot_k,
                                sin_theta_k,
                                x_dot_k,
                                cos_theta_k,
                                theta_dot_sin_theta_k,
                            ],
                        );
                    [
                        x_dot_last,
                        x_force,
                        theta_dot_last,
                        theta_force,
                        sin_theta_flow,
                        cos_theta_flow,
                    ] = [
                        x_dot_k,
                        <R as lagrange::Zero>::zero(),
                        theta_dot_k,
                        Real::mul_add(
                            -damping,
                            theta_dot_k,
                            pole_mass_length * theta_force_part_k,
                        ),
                        Real::mul_add(cos_theta, theta_dot_k, theta_dot_cos_theta_known),
                        -theta_dot_sin_theta_k,
                    ];
                    true
                },
            );
            true
        }
    }
};
