//! Where a system can stand: generic types, functions, paths, renamed crates, macros.

use lagrangian::prelude::*;

use crate::support::close::{all_close, close};

/// Lifetimes, const parameters and where clauses of the type are kept.
struct Weighted<'a, const K: usize, T>
where
    T: Fn(f64) -> f64,
{
    weights: &'a [f64; K],
    law: T,
}

#[lagrangian(coordinates = [x, y])]
impl<'a, const K: usize, T> Weighted<'a, K, T>
where
    T: Fn(f64) -> f64,
{
    #[kinetic]
    fn kinetic(&self, v: &Velocities) -> f64 {
        0.5 * (self.weights[0] * v.x.powi(2) + self.weights[1] * v.y.powi(2))
    }

    #[potential]
    fn slope(&self, q: &Coordinates) -> f64 {
        q.x + (K as f64) * q.y
    }
}

#[test]
fn generic_structs_with_lifetimes_and_closures_are_systems() {
    let weights = [2.0, 4.0, 8.0];
    let system = Weighted { weights: &weights, law: |x| 2.0 * x };
    all_close(system.accelerations(&State::at_rest([0.0, 0.0])).unwrap(), [-0.5, -0.75], 1e-15);
    assert_eq!((system.law)(1.5), 3.0);
}

#[test]
fn a_private_struct_in_a_function_can_be_a_system() {
    struct Local {
        k: f64,
    }

    #[lagrangian(coordinates = [x])]
    impl Local {
        const MASS: f64 = 4.0;

        #[point(mass = Self::MASS)]
        fn place(&self, q: &Coordinates) -> f64 {
            q.x
        }

        #[potential]
        fn spring(&self, q: &Coordinates) -> f64 {
            0.5 * self.k * q.x * q.x
        }
    }

    let local = Local { k: 16.0 };
    let end = *local.simulate(State::at_rest([1.0])).advance_to(std::f64::consts::PI).unwrap();
    all_close([end.q[0], end.v[0]], [1.0, 0.0], 1e-6);
}

/// Types by path, and the crate by another name.
mod inner {
    pub mod deeper {
        pub struct Bead {
            pub m: f64,
        }
    }

    pub use ::lagrangian as physics;
}

#[lagrangian(coordinates = [x], crate = inner::physics)]
impl inner::deeper::Bead {
    #[point(mass = self.m)]
    fn place(&self, q: &Coordinates) -> f64 {
        q.x
    }

    #[force]
    fn pull(&self, q: &Coordinates) -> f64 {
        -q.x
    }
}

#[test]
fn a_type_by_path_and_a_renamed_crate_work() {
    let bead = inner::deeper::Bead { m: 2.0 };
    all_close(bead.accelerations(&State::at_rest([3.0])).unwrap(), [-1.5], 1e-15);
    assert_eq!(BeadCoordinates { x: 3.0 }.x, 3.0);
}

/// A description written by a macro: names from its definition and from its call.
macro_rules! oscillator {
    ($name:ident, $coordinate:ident, $stiffness:expr, $function:ident) => {
        struct $name;

        #[lagrangian(coordinates = [$coordinate])]
        impl $name {
            #[kinetic]
            fn kinetic(&self, v: &Velocities) -> f64 {
                let rate = v.$coordinate;
                0.5 * rate * rate
            }

            #[potential]
            fn $function(&self, q: &Coordinates) -> f64 {
                let stretch = q.$coordinate;
                $stiffness * stretch * stretch / 2.0
            }
        }
    };
}

oscillator!(Slow, x, 1.0 + 3.0, spring);
oscillator!(Fast, y, 100.0, other);

#[test]
fn descriptions_may_come_from_macros() {
    // The expression is one operand, whatever stands in it.
    assert_eq!(Slow.accelerations(&State::at_rest([0.5])).unwrap(), [-2.0]);
    assert_eq!(Fast.accelerations(&State::at_rest([0.5])).unwrap(), [-50.0]);
    assert_eq!(Slow.spring(&SlowCoordinates { x: 1.0 }), 2.0);
    assert_eq!(Fast.other(&FastCoordinates { y: 1.0 }), 50.0);
}

/// Types with the names that generic parameters have.
macro_rules! letters {
    ($($name:ident)*) => {$(
        struct $name {
            g: f64,
        }

        #[lagrangian(coordinates = [theta], jacobians)]
        impl $name {
            #[point(mass = 1.0)]
            fn bob(&self, q: &Coordinates) -> Vector2<f64> {
                Vector2::new(q.theta.sin(), -q.theta.cos())
            }

            #[potential]
            fn weight(&self, q: &Coordinates) -> f64 {
                self.g * self.bob(q).y
            }
        }
    )*};
}

#[test]
fn types_may_have_names_of_one_letter() {
    mod single {
        use lagrangian::prelude::*;

        letters! { A B C D E F G H I J K L M N O P Q R S T U V W X Y Z }

        pub fn check() {
            assert!(P { g: 9.81 }.simulate(State::at_rest([0.1])).advance_to(1.0).is_ok());
            assert!(R { g: 9.81 }.simulate(State::at_rest([0.1])).advance_to(1.0).is_ok());
        }
    }
    single::check();
}

/// A chain of a number of beads that is a parameter of the type.
struct Beads<const N: usize> {
    stiffness: f64,
}

#[lagrangian(coordinates = [x: [2]])]
impl Beads<2> {
    #[point(mass = 1.0)]
    fn beads(&self, q: &Coordinates) -> [f64; 2] {
        q.x
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * (q.x[1] - q.x[0]).powi(2)
    }
}

#[lagrangian(coordinates = [x: [3]])]
impl Beads<3> {
    #[point(mass = 1.0)]
    fn beads(&self, q: &Coordinates) -> [f64; 3] {
        q.x
    }

    #[potential]
    fn springs(&self, q: &Coordinates) -> f64 {
        0.5 * self.stiffness * ((q.x[1] - q.x[0]).powi(2) + (q.x[2] - q.x[1]).powi(2))
    }
}

#[test]
fn several_numbers_of_one_type_are_several_systems() {
    let (two, three) = (Beads::<2> { stiffness: 3.0 }, Beads::<3> { stiffness: 3.0 });
    let start = State::at_rest(Beads2Coordinates { x: [0.0, 1.0] });
    assert_eq!(two.accelerations(&start).unwrap(), [3.0, -3.0]);
    let start = State::at_rest(Beads3Coordinates { x: [0.0, 1.0, 1.0] });
    assert_eq!(three.accelerations(&start).unwrap(), [3.0, -3.0, 0.0]);
}

/// Any letter may be the name of a scalar, also that of a system with contacts.
mod letters {
    use lagrangian::prelude::*;

    macro_rules! ball {
        ($module:ident, $letter:ident) => {
            pub mod $module {
                use super::*;

                pub struct Ball<$letter> {
                    pub e: $letter,
                }

                #[lagrangian(coordinates = [y], inputs = [pull], jacobians)]
                impl<$letter: Real> Ball<$letter> {
                    #[kinetic]
                    fn kinetic(&self, v: &Velocities<$letter>) -> $letter {
                        0.5 * v.y.powi(2)
                    }

                    #[force(on = y)]
                    fn pull(&self, u: &Inputs<$letter>) -> $letter {
                        u.pull - 2.0
                    }

                    #[unilateral(restitution = self.e)]
                    fn floor(&self, q: &Coordinates<$letter>) -> $letter {
                        q.y
                    }

                    #[event]
                    fn height(&self, q: &Coordinates<$letter>) -> $letter {
                        q.y - 0.1
                    }
                }
            }
        };
    }

    ball!(of_t, T);
    ball!(of_s, S);
    ball!(of_r, R);
    ball!(of_x, X);

    #[test]
    fn a_ball_bounces_whatever_its_scalar_is_called() {
        // It falls from 1 in a time of 1, and is back at rest at e² = 1/4 after half of that.
        macro_rules! bounces {
            ($($module:ident)*) => {$(
                let ball = $module::Ball { e: 0.5_f64 };
                let end = *ball.simulate(State::at_rest([1.0])).advance_to(1.5).unwrap();
                assert!((end.q[0] - 0.25).abs() < 1e-14 && end.v[0].abs() < 1e-14, "{end:?}");
            )*};
        }
        bounces!(of_t of_s of_r of_x);
    }
}

/// A system with the name of a parameter of generated code: of products enough for loops over their rows.
struct W;

#[lagrangian(coordinates = [theta: [4]])]
impl W {
    #[point(mass = 1.0)]
    fn joints(&self, q: &Coordinates) -> [Vector2<f64>; 4] {
        let mut joints = [Vector2::zeros(); 4];
        let mut end = Vector2::zeros();
        for i in 0..4 {
            end += Vector2::new(q.theta[i].sin(), -q.theta[i].cos());
            joints[i] = end;
        }
        joints
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.joints(q).iter().map(|joint| 9.81 * joint.y).sum()
    }
}

#[test]
fn a_system_may_have_the_name_of_a_parameter() {
    let start = State::at_rest([0.3, -0.2, 0.5, 0.1]);
    let mut motion = W.simulate(start);
    motion.advance_to(1.0).unwrap();
    close(motion.energy(), W.energy(&start), 1e-9);
}
