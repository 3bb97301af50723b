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
impl<R: ::core::marker::Copy> ::core::convert::From<[R; 3usize]> for TopCoordinates<R> {
    fn from(values: [R; 3usize]) -> Self {
        Self {
            phi: values[0usize],
            theta: values[1usize],
            psi: values[2usize],
        }
    }
}
impl<R: ::core::marker::Copy> ::core::convert::From<TopCoordinates<R>> for [R; 3usize] {
    fn from(record: TopCoordinates<R>) -> Self {
        [record.phi, record.theta, record.psi]
    }
}
impl<R: ::lagrangian::__private::Real> TopCoordinates<R> {
    /// All components in order.
    pub fn as_vector(&self) -> ::lagrangian::__private::nalgebra::SVector<R, 3usize> {
        <[R; 3usize]>::from(*self).into()
    }
}
///Generalized velocities of [`Top`].
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
impl<R: ::core::marker::Copy> ::core::convert::From<[R; 3usize]> for TopVelocities<R> {
    fn from(values: [R; 3usize]) -> Self {
        Self {
            phi: values[0usize],
            theta: values[1usize],
            psi: values[2usize],
        }
    }
}
impl<R: ::core::marker::Copy> ::core::convert::From<TopVelocities<R>> for [R; 3usize] {
    fn from(record: TopVelocities<R>) -> Self {
        [record.phi, record.theta, record.psi]
    }
}
impl<R: ::lagrangian::__private::Real> TopVelocities<R> {
    /// All components in order.
    pub fn as_vector(&self) -> ::lagrangian::__private::nalgebra::SVector<R, 3usize> {
        <[R; 3usize]>::from(*self).into()
    }
}
const _: () = {
    use ::lagrangian::__private as lagrange;
    impl Top {
        /// Operations of one evaluation of the accelerations, as derived and as emitted; what is
        /// computed once per run and the factorisation in the runtime, if any, are not counted.
        pub const COST: lagrange::Costs = lagrange::Costs {
            before: lagrange::Cost {
                additions: 28u32,
                multiplications: 65u32,
                divisions: 0u32,
                square_roots: 0u32,
                functions: 3u32,
            },
            after: lagrange::Cost {
                additions: 5u32,
                multiplications: 17u32,
                divisions: 1u32,
                square_roots: 0u32,
                functions: 1u32,
            },
        };
        /// What was found in this system, and what its code therefore leaves out.
        pub const STRUCTURE: lagrange::Structure = lagrange::Structure {
            mass_matrix: "block diagonal, solved by a factorisation written out (2 × 2)",
            facts: &[
                "inertially decoupled blocks: phi, psi | theta",
                "conservative and autonomous: the energy is conserved",
            ],
            skipped: &[
                "time: nothing depends on it",
                "inputs",
                "dissipation",
                "applied forces",
                "constraints and multipliers",
            ],
        };
        /**Accelerations a that solve M(q, v, t) a = Q − ∂D/∂v − b(q, v, t).

The mass matrix is block diagonal, solved by a factorisation written out (2 × 2).

# Errors

A singular mass matrix, with the coordinate and the time.*/
        #[inline]
        pub fn accelerations(
            &self,
            state: &lagrange::State<f64, 3>,
        ) -> ::core::result::Result<[f64; 3], lagrange::MotionError<f64>> {
            let constants = lagrange::System::constants(self);
            lagrange::System::accelerations_at(
                    self,
                    &constants,
                    state.t,
                    &state.q,
                    &state.v,
                    &[],
                )
                .map_err(|cause| lagrange::MotionError {
                    cause,
                    t: state.t,
                })
        }
        ///Mass matrix M = ∂²L/∂v∂v, symmetric [row, column in the order of the coordinates].
        #[inline]
        pub fn mass_matrix(
            &self,
            state: &lagrange::State<f64, 3>,
        ) -> lagrange::nalgebra::SMatrix<f64, 3, 3> {
            use lagrange::Real;
            let [_, theta, _] = state.q;
            let (sin_theta, attitude_22) = Real::sin_cos(theta);
            let w1 = self.across + self.mass * (self.arm * self.arm);
            [
                [
                    self.along * (attitude_22 * attitude_22)
                        + w1 * (sin_theta * sin_theta),
                    0.0,
                    self.along * attitude_22,
                ],
                [0.0, w1, 0.0],
                [self.along * attitude_22, 0.0, self.along],
            ]
                .into()
        }
        /**Bias b(q, v, t) = d/dt(∂L/∂v) − ∂L/∂q at zero accelerations: inertia forces that depend on velocity, and ∂V/∂q. The equations of motion are M a + b = Q − ∂D/∂v.

- `b(phi) = −theta′·sin(theta)·(psi′·along − 2·phi′·cos(theta)·(mass·arm^2 + (across − along)))`
- `b(theta) = −sin(theta)·(mass·arm·g − phi′·(psi′·along − phi′·cos(theta)·(mass·arm^2 + (across − along))))`
- `b(psi) = −phi′·theta′·along·sin(theta)`*/
        #[inline]
        pub fn bias(&self, state: &lagrange::State<f64, 3>) -> [f64; 3] {
            use lagrange::Real;
            let [_, theta, _] = state.q;
            let [phi_dot, theta_dot, psi_dot] = state.v;
            let (sin_theta, attitude_22) = Real::sin_cos(theta);
            let w1 = self.mass * (self.arm * self.arm) + (self.across - self.along);
            let phi_dot_attitude_22 = phi_dot * attitude_22;
            let along_psi_dot = self.along * psi_dot;
            let w2 = self.mass * self.arm * self.g
                - phi_dot * (along_psi_dot - w1 * phi_dot_attitude_22);
            let theta_dot_sin_theta = theta_dot * sin_theta;
            [
                -((along_psi_dot - 2.0 * w1 * phi_dot_attitude_22)
                    * theta_dot_sin_theta),
                -(sin_theta * w2),
                -(self.along * (phi_dot * theta_dot_sin_theta)),
            ]
        }
        /**Generalized momenta p = ∂L/∂v.

- `p(phi) = psi′·along·cos(theta) + phi′·(along·cos(theta)^2 + sin(theta)^2·(across + mass·arm^2))`
- `p(theta) = theta′·(across + mass·arm^2)`
- `p(psi) = along·(psi′ + phi′·cos(theta))`*/
        #[inline]
        pub fn momenta(&self, state: &lagrange::State<f64, 3>) -> [f64; 3] {
            use lagrange::Real;
            let [_, theta, _] = state.q;
            let [phi_dot, theta_dot, psi_dot] = state.v;
            let (sin_theta, attitude_22) = Real::sin_cos(theta);
            let gyroscope_rate_z = psi_dot + phi_dot * attitude_22;
            let w1 = self.across + self.mass * (self.arm * self.arm);
            let w2 = phi_dot
                * (self.along * (attitude_22 * attitude_22)
                    + w1 * (sin_theta * sin_theta));
            [
                self.along * (psi_dot * attitude_22) + w2,
                w1 * theta_dot,
                self.along * gyroscope_rate_z,
            ]
        }
        ///Kinetic energy T [J].
        #[inline]
        pub fn kinetic_energy(&self, state: &lagrange::State<f64, 3>) -> f64 {
            use lagrange::Real;
            let [_, theta, _] = state.q;
            let [phi_dot, theta_dot, psi_dot] = state.v;
            let (sin_theta, attitude_22) = Real::sin_cos(theta);
            let w1 = self.across + self.mass * (self.arm * self.arm);
            let w2 = phi_dot
                * (self.along * (attitude_22 * attitude_22)
                    + w1 * (sin_theta * sin_theta));
            let w3 = phi_dot * (2.0 * self.along * (psi_dot * attitude_22) + w2)
                + (self.along * (psi_dot * psi_dot) + w1 * (theta_dot * theta_dot));
            0.5 * w3
        }
        /**Potential energy V [J].

`V = mass·cos(theta)·arm·g`*/
        #[inline]
        pub fn potential_energy(&self, state: &lagrange::State<f64, 3>) -> f64 {
            use lagrange::Real;
            let [_, theta, _] = state.q;
            let attitude_22 = Real::cos(theta);
            let gravity = self.mass * self.arm * self.g * attitude_22;
            gravity
        }
        ///Energy T + V [J].
        #[inline]
        pub fn energy(&self, state: &lagrange::State<f64, 3>) -> f64 {
            use lagrange::Real;
            let [_, theta, _] = state.q;
            let [phi_dot, theta_dot, psi_dot] = state.v;
            let (sin_theta, attitude_22) = Real::sin_cos(theta);
            let w1 = self.across + self.mass * (self.arm * self.arm);
            let w2 = phi_dot
                * (self.along * (attitude_22 * attitude_22)
                    + w1 * (sin_theta * sin_theta));
            let w3 = phi_dot * (2.0 * self.along * (psi_dot * attitude_22) + w2)
                + (self.along * (psi_dot * psi_dot) + w1 * (theta_dot * theta_dot));
            self.mass * self.arm * self.g * attitude_22 + 0.5 * w3
        }
    }
    impl lagrange::System<3usize, 0usize> for Top {
        type Scalar = f64;
        type Constants = [f64; 5];
        #[inline]
        fn constants(&self) -> Self::Constants {
            let mass_arm_squared = self.mass * (self.arm * self.arm);
            let w1 = self.across + mass_arm_squared;
            let w2 = mass_arm_squared + (self.across - self.along);
            [w1, w2, self.mass * self.arm * self.g, self.along + 2.0 * w2, 1.0 / w1]
        }
        #[inline]
        fn accelerations_at(
            &self,
            constants: &Self::Constants,
            _t: f64,
            q: &[f64; 3],
            v: &[f64; 3],
            _u: &[f64; 0],
        ) -> ::core::result::Result<[f64; 3], lagrange::Cause> {
            use lagrange::Real;
            let [_, theta, _] = *q;
            let [phi_dot, theta_dot, psi_dot] = *v;
            let [w1, w2, mass_arm_g, w3, w4] = *constants;
            let (sin_theta, attitude_22) = Real::sin_cos(theta);
            let w5 = w1 * (sin_theta * sin_theta);
            let phi_dot_attitude_22 = phi_dot * attitude_22;
            let along_psi_dot = self.along * psi_dot;
            let w6 = (along_psi_dot - w3 * phi_dot_attitude_22) / sin_theta;
            lagrange::solve::pivot(
                w5,
                self.along * (attitude_22 * attitude_22) + w5,
                0,
            )?;
            ::core::result::Result::Ok([
                w4 * (theta_dot * w6),
                w4
                    * (sin_theta
                        * (mass_arm_g
                            - phi_dot * (along_psi_dot - w2 * phi_dot_attitude_22))),
                theta_dot * (phi_dot * sin_theta - w4 * (attitude_22 * w6)),
            ])
        }
        #[inline]
        fn energy_at(
            &self,
            _constants: &Self::Constants,
            _t: f64,
            q: &[f64; 3],
            v: &[f64; 3],
        ) -> f64 {
            use lagrange::Real;
            let [_, theta, _] = *q;
            let [phi_dot, theta_dot, psi_dot] = *v;
            let (sin_theta, attitude_22) = Real::sin_cos(theta);
            let w1 = self.across + self.mass * (self.arm * self.arm);
            let w2 = phi_dot
                * (self.along * (attitude_22 * attitude_22)
                    + w1 * (sin_theta * sin_theta));
            let w3 = phi_dot * (2.0 * self.along * (psi_dot * attitude_22) + w2)
                + (self.along * (psi_dot * psi_dot) + w1 * (theta_dot * theta_dot));
            self.mass * self.arm * self.g * attitude_22 + 0.5 * w3
        }
    }
};
