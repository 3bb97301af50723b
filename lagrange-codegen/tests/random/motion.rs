//! Positions, attitudes and energies of a random system, in any number: the physics of the oracle.
//!
//! Velocities are slopes of positions along (q̇, 1); the angular velocity is read from Rᵀ Ṙ.

use crate::expression::{Body, Expr, Instant, Scope, Vector, dot};
use crate::function::Function;
use crate::number::{Dual, Number};
use crate::system::{Energy, Inertia, Role, Rotation, System, TILTED};

type Matrix<T> = [[T; 3]; 3];

/// T, V and the sum of the Lagrangians that are given as a whole.
#[derive(Clone, Copy, Debug)]
pub struct Energies<T> {
    pub kinetic: T,
    pub potential: T,
    pub whole: T,
}

impl<T: Number> Energies<T> {
    /// L.
    pub fn lagrangian(self) -> T {
        self.kinetic - self.potential + self.whole
    }
}

impl System {
    /// The positions that a role gives: one, or as many as its array has.
    pub fn positions<T: Number>(&self, role: usize, at: &Instant<T>) -> Vec<Vec<T>> {
        let scope = Scope::new(self, at, role);
        match &self.roles[role] {
            Role::Point { dimension, position, .. } => {
                vec![scope.run(position, |scope, result| scope.vector(result, *dimension))]
            }
            Role::Planar { pose, .. } => vec![scope.run(pose, |scope, (shift, _)| scope.vector(shift, 2))],
            Role::Spatial { pose, .. } => vec![scope.run(pose, |scope, (shift, _)| scope.vector(shift, 3))],
            Role::Chain { which, relative, length, .. } => {
                let length = scope.scalar(length);
                let mut end = [T::constant(0.0); 2];
                let mut sum = T::constant(0.0);
                let joints = self.looped(*which).1.map(|i| {
                    sum = sum + at.q[i];
                    let angle = if *relative { sum } else { at.q[i] };
                    end[0] = end[0] + length * angle.apply(Function::Sin);
                    end[1] = end[1] - length * angle.apply(Function::Cos);
                    end.to_vec()
                });
                joints.collect()
            }
            Role::Energy(..)
            | Role::ForceOn(..)
            | Role::ForceOnAll(_)
            | Role::ForceAt(..)
            | Role::Wrench(..)
            | Role::Constraint(..) => Vec::new(),
        }
    }

    /// The angle of a body in the plane.
    pub fn angle<T: Number>(&self, role: usize, at: &Instant<T>) -> Option<T> {
        let Role::Planar { pose, .. } = &self.roles[role] else { return None };
        Some(Scope::new(self, at, role).run(pose, |scope, (_, angle)| scope.scalar(angle)))
    }

    /// The rotation of a body in space, from body axes to space axes.
    pub fn attitude<T: Number>(&self, role: usize, at: &Instant<T>) -> Option<Matrix<T>> {
        let Role::Spatial { pose, .. } = &self.roles[role] else { return None };
        Some(Scope::new(self, at, role).run(pose, |scope, (_, turn)| rotation(scope, turn)))
    }

    /// All energies at one instant.
    pub fn energies<T: Number>(&self, at: &Instant<T>) -> Energies<T> {
        let moving = at.in_motion();
        let (half, zero) = (T::constant(0.5), T::constant(0.0));
        let mut energies = Energies { kinetic: zero, potential: zero, whole: zero };
        for (index, role) in self.roles.iter().enumerate() {
            let scope = || Scope::new(self, at, index);
            if let Some(mass) = role.mass() {
                let mass = scope().scalar(mass);
                for position in self.positions(index, &moving) {
                    let rate: Vec<T> = position.iter().map(|x| x.slope).collect();
                    energies.kinetic = energies.kinetic + half * mass * dot(&rate, &rate);
                }
            }
            match role {
                Role::Planar { inertia, .. } => {
                    if let Some(angle) = self.angle(index, &moving) {
                        let inertia = scope().scalar(inertia);
                        energies.kinetic = energies.kinetic + half * inertia * angle.slope * angle.slope;
                    }
                }
                Role::Spatial { inertia, .. } => {
                    if let Some(attitude) = self.attitude(index, &moving) {
                        let rate = body_rate(&attitude);
                        let momentum = tensor(&scope(), inertia).map(|row| dot(&row, &rate));
                        energies.kinetic = energies.kinetic + half * dot(&rate, &momentum);
                    }
                }
                Role::Energy(kind, body) => {
                    let value = self.scalar_role(index, body, at);
                    match kind {
                        Energy::Kinetic => energies.kinetic = energies.kinetic + value,
                        Energy::Potential => energies.potential = energies.potential + value,
                        Energy::Lagrangian => energies.whole = energies.whole + value,
                        Energy::Dissipation => {}
                    }
                }
                Role::Point { .. }
                | Role::Chain { .. }
                | Role::ForceOn(..)
                | Role::ForceOnAll(_)
                | Role::ForceAt(..)
                | Role::Wrench(..)
                | Role::Constraint(..) => {}
            }
        }
        energies
    }

    /// The result of a function that returns a scalar.
    pub fn scalar_role<T: Number>(&self, role: usize, body: &Body<Expr>, at: &Instant<T>) -> T {
        Scope::new(self, at, role).run(body, |scope, result| scope.scalar(result))
    }

    /// The result of a function that returns a vector.
    pub fn vector_role<T: Number>(
        &self,
        role: usize,
        body: &Body<Vector>,
        dimension: usize,
        at: &Instant<T>,
    ) -> Vec<T> {
        Scope::new(self, at, role).run(body, |scope, result| scope.vector(result, dimension))
    }
}

impl Role {
    /// The mass of every position that the role gives.
    fn mass(&self) -> Option<&Expr> {
        match self {
            Role::Point { mass, .. }
            | Role::Planar { mass, .. }
            | Role::Spatial { mass, .. }
            | Role::Chain { mass, .. } => Some(mass),
            Role::Energy(..)
            | Role::ForceOn(..)
            | Role::ForceOnAll(_)
            | Role::ForceAt(..)
            | Role::Wrench(..)
            | Role::Constraint(..) => None,
        }
    }
}

/// ω in body axes, from the skew matrix Rᵀ Ṙ.
fn body_rate<T: Number>(attitude: &Matrix<Dual<T>>) -> [T; 3] {
    let skew = |row: usize, column: usize| {
        (0..3).fold(T::constant(0.0), |sum, k| sum + attitude[k][row].value * attitude[k][column].slope)
    };
    [skew(2, 1), skew(0, 2), skew(1, 0)]
}

/// ω in space axes, from the skew matrix Ṙ Rᵀ.
pub fn space_rate<T: Number>(attitude: &Matrix<Dual<T>>) -> [T; 3] {
    let skew = |row: usize, column: usize| {
        (0..3).fold(T::constant(0.0), |sum, k| sum + attitude[row][k].slope * attitude[column][k].value)
    };
    [skew(2, 1), skew(0, 2), skew(1, 0)]
}

fn tensor<T: Number>(scope: &Scope<'_, T>, inertia: &Inertia) -> Matrix<T> {
    let mut tensor = [[T::constant(0.0); 3]; 3];
    for (axis, moment) in inertia.moments.iter().enumerate() {
        tensor[axis][axis] = scope.scalar(moment);
    }
    if let Some(product) = &inertia.product {
        tensor[0][1] = scope.scalar(product);
        tensor[1][0] = tensor[0][1];
    }
    tensor
}

fn rotation<T: Number>(scope: &Scope<'_, T>, turn: &Rotation) -> Matrix<T> {
    let unit = |axis: usize| [0, 1, 2].map(|i| if i == axis { 1.0 } else { 0.0 });
    match turn {
        Rotation::Axis(axis, angle) => about(unit(axis % 3), scope.scalar(angle)),
        Rotation::Tilted(angle) => about(TILTED, scope.scalar(angle)),
        Rotation::Euler(angles) => {
            let [roll, pitch, yaw] = [0, 1, 2].map(|i| about(unit(i), scope.scalar(&angles[i])));
            product(&yaw, &product(&pitch, &roll))
        }
        Rotation::Product(left, right) => product(&rotation(scope, left), &rotation(scope, right)),
        Rotation::Inverse(inner) => {
            let inner = rotation(scope, inner);
            [0, 1, 2].map(|i| [0, 1, 2].map(|j| inner[j][i]))
        }
        Rotation::Entries(inner) => rotation(scope, inner),
    }
}

/// Rodrigues: R = 1 + sin φ [e]ₓ + (1 − cos φ) [e]ₓ².
fn about<T: Number>(axis: [f64; 3], angle: T) -> Matrix<T> {
    let [x, y, z] = axis.map(T::constant);
    let zero = T::constant(0.0);
    let cross = [[zero, -z, y], [z, zero, -x], [-y, x, zero]];
    let square = product(&cross, &cross);
    let (sine, versine) = (angle.apply(Function::Sin), T::constant(1.0) - angle.apply(Function::Cos));
    [0, 1, 2].map(|i| {
        [0, 1, 2].map(|j| {
            let one = T::constant(if i == j { 1.0 } else { 0.0 });
            one + sine * cross[i][j] + versine * square[i][j]
        })
    })
}

fn product<T: Number>(a: &Matrix<T>, b: &Matrix<T>) -> Matrix<T> {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| (0..3).fold(T::constant(0.0), |sum, k| sum + a[i][k] * b[k][j])))
}
