//! Reactions of contacts that the motion does not determine say so.

use lagrangian::prelude::*;

use crate::support::close::close;

/// A ladder of 3 kg and 2 m on a rough floor against a wall.
struct Ladder {
    floor: f64,
    wall: f64,
}

#[lagrangian(coordinates = [x, y, phi])]
impl Ladder {
    #[body(mass = 3.0, inertia = 1.0)]
    fn rod(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.phi)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        3.0 * 9.81 * q.y
    }

    #[unilateral]
    fn foot(&self, q: &Coordinates) -> f64 {
        q.y - q.phi.sin()
    }

    #[unilateral]
    fn head(&self, q: &Coordinates) -> f64 {
        q.x - q.phi.cos()
    }

    #[friction(coefficient = self.floor, normal = foot)]
    fn along(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.x - q.phi.sin() * v.phi
    }

    #[friction(coefficient = self.wall, normal = head)]
    fn up(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.y + q.phi.cos() * v.phi
    }
}

fn leaning(phi: f64, floor: f64, wall: f64) -> (Ladder, State<f64, 3>) {
    (Ladder { floor, wall }, State::at_rest([phi.cos(), phi.sin(), phi]))
}

#[test]
fn a_ladder_between_rough_surfaces_has_more_reactions_than_equations() {
    for (floor, wall) in [(0.8, 0.8), (0.5, 0.3)] {
        let (ladder, start) = leaning(1.2, floor, wall);
        let mut motion = ladder.simulate(start);
        assert_eq!(motion.advance_to(1.0).unwrap().q, start.q);
        assert!(!motion.reactions().are_unique());
    }
}

#[test]
fn a_smooth_wall_leaves_the_reactions_determined() {
    let phi = 1.2_f64;
    let (ladder, start) = leaning(phi, 0.8, 0.0);
    let mut motion = ladder.simulate(start);
    assert_eq!(motion.advance_to(1.0).unwrap().q, start.q);
    let reactions = motion.reactions();
    assert!(reactions.are_unique());
    close(reactions.foot, 3.0 * 9.81, 1e-12);
    close(reactions.head, 3.0 * 9.81 / (2.0 * phi.tan()), 1e-12);
    close(reactions.along, -reactions.head, 1e-12);
}

#[test]
fn a_ladder_that_slides_has_the_friction_of_its_slips() {
    let (ladder, start) = leaning(0.5, 0.1, 0.1);
    let mut motion = ladder.simulate(start);
    motion.advance_to(0.1).unwrap();
    let reactions = motion.reactions();
    assert!(reactions.are_unique());
    close(reactions.along.abs(), 0.1 * reactions.foot, 1e-12);
    close(reactions.up.abs(), 0.1 * reactions.head, 1e-12);
}

/// A table on legs at these places, which does not tilt while all bear.
struct Table<const LEGS: usize> {
    legs: [[f64; 2]; 4],
}

macro_rules! table {
    ($legs:literal) => {
        #[lagrangian(coordinates = [z, roll, pitch])]
        impl Table<$legs> {
            #[kinetic]
            fn kinetic(&self, v: &Velocities) -> f64 {
                0.5 * (8.0 * v.z * v.z + v.roll * v.roll + v.pitch * v.pitch)
            }

            #[potential]
            fn weight(&self, q: &Coordinates) -> f64 {
                8.0 * 9.81 * q.z
            }

            #[unilateral]
            fn feet(&self, q: &Coordinates) -> [f64; $legs] {
                core::array::from_fn(|i| q.z + q.roll * self.legs[i][0] + q.pitch * self.legs[i][1])
            }
        }
    };
}

table!(3);
table!(4);

#[test]
fn a_table_on_three_legs_is_determined_and_on_four_is_not() {
    let legs = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
    let rest = State::at_rest([0.0; 3]);
    let four = Table::<4> { legs };
    let reactions = four.simulate(rest).reactions();
    assert!(!reactions.are_unique());
    close(reactions.feet.iter().sum(), 8.0 * 9.81, 1e-12);
    let three = Table::<3> { legs: [[1.0, 0.0], [-0.5, 0.8], [-0.5, -0.8], [0.0, 0.0]] };
    let reactions = three.simulate(rest).reactions();
    assert!(reactions.are_unique());
    reactions.feet.iter().for_each(|&foot| close(foot, 8.0 * 9.81 / 3.0, 1e-12));
}
