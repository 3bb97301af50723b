//! Discs that fall on each other between two walls: many contacts close, slide and open at once, and in the
//! end all rest.

use lagrangian::prelude::*;

use crate::support::sample::Samples;

macro_rules! heap {
    ($name:ident, $discs:literal, $sides:literal, $pairs:literal) => {
        struct $name {
            radii: [f64; $discs],
            roughness: f64,
            restitution: f64,
            width: f64,
        }

        #[lagrangian(coordinates = [x: [N], y: [N], turn: [N]])]
        impl $name {
            const N: usize = $discs;

            #[kinetic]
            fn kinetic(&self, v: &Velocities) -> f64 {
                let mut sum = 0.0;
                for i in 0..Self::N {
                    let square = self.radii[i] * self.radii[i];
                    let turning = 0.5 * square * v.turn[i] * v.turn[i];
                    sum += 0.5 * square * (v.x[i] * v.x[i] + v.y[i] * v.y[i] + turning);
                }
                sum
            }

            #[potential]
            fn weight(&self, q: &Coordinates) -> f64 {
                let mut sum = 0.0;
                for i in 0..Self::N {
                    sum += 9.81 * self.radii[i] * self.radii[i] * q.y[i];
                }
                sum
            }

            #[unilateral(restitution = self.restitution)]
            fn sides(&self, q: &Coordinates) -> [f64; $sides] {
                let mut gaps = [0.0; $sides];
                for i in 0..Self::N {
                    gaps[3 * i] = q.y[i] - self.radii[i];
                    gaps[3 * i + 1] = q.x[i] - self.radii[i];
                    gaps[3 * i + 2] = self.width - q.x[i] - self.radii[i];
                }
                gaps
            }

            #[unilateral(restitution = self.restitution)]
            fn pairs(&self, q: &Coordinates) -> [f64; $pairs] {
                let mut gaps = [0.0; $pairs];
                let mut pair = 0;
                for i in 0..Self::N {
                    for j in 0..i {
                        let between = Vector2::new(q.x[i] - q.x[j], q.y[i] - q.y[j]);
                        gaps[pair] = between.norm() - self.radii[i] - self.radii[j];
                        pair += 1;
                    }
                }
                gaps
            }

            #[friction(coefficient = self.roughness, normal = sides)]
            fn rub_sides(&self, v: &Velocities) -> [f64; $sides] {
                let mut slips = [0.0; $sides];
                for i in 0..Self::N {
                    let rim = self.radii[i] * v.turn[i];
                    slips[3 * i] = v.x[i] + rim;
                    slips[3 * i + 1] = v.y[i] - rim;
                    slips[3 * i + 2] = v.y[i] + rim;
                }
                slips
            }

            #[friction(coefficient = self.roughness, normal = pairs)]
            fn rub_pairs(&self, q: &Coordinates, v: &Velocities) -> [f64; $pairs] {
                let mut slips = [0.0; $pairs];
                let mut pair = 0;
                for i in 0..Self::N {
                    for j in 0..i {
                        let across = Vector2::new(q.y[j] - q.y[i], q.x[i] - q.x[j]).normalize();
                        let slides = (v.x[i] - v.x[j]) * across.x + (v.y[i] - v.y[j]) * across.y;
                        slips[pair] = slides - self.radii[i] * v.turn[i] - self.radii[j] * v.turn[j];
                        pair += 1;
                    }
                }
                slips
            }
        }

        impl $name {
            /// Falls from random places above each other; energy is lost alone, nothing is penetrated, and in
            /// the end nothing moves. Returns whether it has come to rest; not if discs that are wedged
            /// between the walls could go on in several ways.
            fn settles(random: &mut Samples, restitution: f64) -> bool {
                let radii = [(); $discs].map(|()| random.number(0.1, 0.2));
                let (roughness, width) = (random.number(0.0, 0.6), random.number(0.45, 0.7));
                let heap = Self { radii, roughness, restitution, width };
                let mut start = State::at_rest([0.0; 3 * $discs]);
                for i in 0..$discs {
                    start.q[i] = random.number(0.2, width - 0.2);
                    start.q[$discs + i] = 0.3 + 0.45 * i as f64;
                }
                let mut motion = heap.simulate(start).with_tolerance(1e-8);
                let mut energy = motion.energy();
                for k in 1..=40 {
                    match motion.advance_to(0.1 * f64::from(k)) {
                        Err(MotionError { cause: Cause::SeveralReactions { .. }, .. }) => return false,
                        ended => {
                            assert!(ended.is_ok(), "{ended:?}: {roughness} {restitution} {width} {radii:?}")
                        }
                    }
                    assert!(motion.energy() < energy * (1.0 + 1e-9), "{} {energy}", motion.energy());
                    energy = motion.energy();
                    let State { q, .. } = *motion.state();
                    let place = |i: usize| Vector2::new(q[i], q[$discs + i]);
                    for i in 0..$discs {
                        assert!(place(i).y > radii[i] - 1e-12 && place(i).x > radii[i] - 1e-12);
                        assert!(place(i).x < width - radii[i] + 1e-12);
                        for j in 0..i {
                            assert!((place(i) - place(j)).norm() > radii[i] + radii[j] - 1e-12);
                        }
                    }
                }
                motion.state().v == [0.0; 3 * $discs]
            }
        }
    };
}

heap!(Three, 3, 9, 3);
heap!(Four, 4, 12, 6);

#[test]
#[ignore = "a minute without optimisation: scripts/check.sh runs it"]
fn three_discs_come_to_rest() {
    let mut random = Samples::new(41);
    let rest = (0..4).filter(|k| Three::settles(&mut random, 0.15 * f64::from(*k))).count();
    assert!(rest > 2, "{rest}");
}

#[test]
#[ignore = "half a minute: scripts/check.sh runs it"]
fn four_discs_come_to_rest() {
    let mut random = Samples::new(43);
    let rest = (0..30).filter(|k| Four::settles(&mut random, 0.02 * f64::from(*k))).count();
    assert!(rest > 24, "{rest}");
}
