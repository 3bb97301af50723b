//! Equilibria of stiff systems that soft forces move: valleys of the potential energy that are narrow and
//! curved.

use lagrangian::prelude::*;

use crate::support::sample::Samples;

/// A weight on a spring that may swing.
struct Bob {
    stiffness: f64,
    length: f64,
    weight: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl Bob {
    #[point(mass = 0.7)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * (self.bob(q).norm() - self.length).powi(2) + self.weight * q.y
    }
}

/// A Lennard-Jones bond that a weak force turns.
struct Bond {
    depth: f64,
    force: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl Bond {
    #[point(mass = 1.0)]
    fn atom(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn potential(&self, q: &Coordinates) -> f64 {
        let near = self.atom(q).norm_squared().powi(-3);
        4.0 * self.depth * (near * near - near) + self.force * q.y
    }
}

/// A guess beside the lowest place at this radius.
fn guess(samples: &mut Samples, radius: f64) -> [f64; 2] {
    let (radius, angle) = (radius * samples.number(0.98, 1.02), samples.number(-0.1, 0.1_f64));
    [radius * angle.sin(), -radius * angle.cos()]
}

#[test]
fn a_weight_on_a_stiff_spring_hangs_below_its_anchor() {
    let mut samples = Samples::new(5);
    for ratio in [1e2, 1e4, 1e5, 1e6, 1e7, 1e8] {
        for _ in 0..20 {
            let (length, weight) = (samples.number(0.5, 1.5), samples.number(1.0, 10.0));
            let bob = Bob { stiffness: ratio * weight / length, length, weight };
            let lowest = length + weight / bob.stiffness;
            let guess = guess(&mut samples, lowest);
            let found = [bob.equilibrium(guess, &[]).unwrap(), bob.stationary_point(guess, &[]).unwrap()];
            for found in found {
                let [x, y] = found.state.q;
                assert!(x.hypot(y + lowest) < 1e-13 * lowest, "{ratio}: {x} {y} {lowest}");
                // A stiffness of √ε of the largest one counts as none.
                assert!(found.is_isolated || ratio > 1e7);
            }
        }
    }
}

#[test]
fn a_bond_points_along_a_weak_force() {
    let mut samples = Samples::new(6);
    for ratio in [1e-5, 1e-4, 1e-3, 1e-2] {
        for _ in 0..20 {
            let depth = samples.number(20.0, 40.0);
            let bond = Bond { depth, force: ratio * depth };
            let guess = guess(&mut samples, 2_f64.powf(1.0 / 6.0));
            let [x, y] = bond.equilibrium(guess, &[]).unwrap().state.q;
            // The derivative of the potential energy.
            let left = 4.0 * depth * (6.0 * y.powi(-7) - 12.0 * y.powi(-13)) + bond.force;
            assert!(x.abs() < 1e-13 && left.abs() < 1e-12 * depth, "{ratio}: {x} {left:e}");
        }
    }
}
