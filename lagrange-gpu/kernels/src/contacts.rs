//! Systems with contacts, dry friction and events as kernels. They are built and interpreted, to see that
//! nothing in them can panic; assembling them takes minutes.

use lagrangian::prelude::*;

use crate::{End, G, Until, end, spread};

/// A puck that is thrown onto a rough floor.
#[derive(Clone, Copy, Debug)]
pub struct Puck;

#[lagrangian(coordinates = [x, y])]
impl Puck {
    #[point(mass = 0.2)]
    fn puck(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        0.2 * G * q.y
    }

    #[unilateral(restitution = 0.6)]
    fn floor(&self, q: &Coordinates) -> f64 {
        q.y
    }

    #[friction(coefficient = 0.4, normal = floor)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x
    }

    #[event]
    fn apex(&self, v: &Velocities) -> f64 {
        v.y
    }
}

/// A mass on a spring and on a belt that runs.
#[derive(Clone, Copy, Debug)]
pub struct Belt;

#[lagrangian(coordinates = [x])]
impl Belt {
    #[kinetic]
    fn translation(&self, v: &Velocities) -> f64 {
        0.5 * v.x.powi(2)
    }

    #[potential]
    fn spring(&self, q: &Coordinates) -> f64 {
        4.5 * q.x.powi(2)
    }

    #[friction(limit = 2.4, static_limit = 4.0)]
    fn slip(&self, v: &Velocities) -> f64 {
        v.x - 0.2
    }
}

/// A stone on a slope of ice: friction in the two directions of a plane.
#[derive(Clone, Copy, Debug)]
pub struct Stone;

#[lagrangian(coordinates = [x, y])]
impl Stone {
    #[point(mass = 20.0)]
    fn stone(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        20.0 * G * 0.01 * q.y
    }

    #[friction(limit = 4.0, static_limit = 6.0)]
    fn slip(&self, v: &Velocities) -> Vector2<f64> {
        Vector2::new(v.x, v.y)
    }
}

/// A pendulum on a bearing with dry friction.
#[derive(Clone, Copy, Debug)]
pub struct Bearing;

#[lagrangian(coordinates = [x, y, phi])]
impl Bearing {
    #[point(mass = 1.0)]
    fn centre(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[kinetic]
    fn turning(&self, v: &Velocities) -> f64 {
        0.05 * v.phi.powi(2)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        G * q.y
    }

    #[holonomic]
    fn pin(&self, q: &Coordinates) -> [f64; 2] {
        [q.x - 0.5 * q.phi.sin(), q.y + 0.5 * q.phi.cos()]
    }

    #[friction(coefficient = 0.3, normal = [pin])]
    fn slip(&self, v: &Velocities) -> f64 {
        0.05 * v.phi
    }
}

/// The puck of an index, and its start above the floor.
fn a_puck(index: u64) -> State<f64, 2> {
    let [height, speed] = spread(index);
    State::new([0.0, 0.06 + 0.05 * height], [1.5 * speed, 0.0])
}

/// A puck that bounces and slides.
pub fn puck(index: u64, until: &Until) -> End<2> {
    end(Puck.simulate(a_puck(index)), until)
}

/// The highest point of a puck after its first impact.
pub fn puck_apex(index: u64, &(time, tolerance): &Until) -> End<2> {
    let mut motion = Puck.simulate(a_puck(index)).with_tolerance(tolerance);
    match motion.events(PuckEvent::Apex, time).falling().next() {
        Some(apex) => Ok(apex?.state),
        None => motion.advance_to(time).copied(),
    }
}

/// A mass that sticks to its belt and slips.
pub fn belt(index: u64, until: &Until) -> End<1> {
    let [place, speed] = spread(index);
    end(Belt.simulate(State::new([place], [speed])), until)
}

/// A puck in fixed steps.
pub fn puck_steps(index: u64, &(time, _): &Until) -> End<2> {
    let mut motion = Puck.stepper::<Jet<4>>(a_puck(index));
    for _ in 0..64 {
        motion.step(time / 64.0, &[])?;
    }
    Ok(*motion.state())
}

/// A stone that is pushed over the ice and stops.
pub fn stone(index: u64, until: &Until) -> End<2> {
    let [across, along] = spread(index);
    end(Stone.simulate(State::new([0.0; 2], [across, along])), until)
}

/// A pendulum that is let go and comes to rest.
pub fn bearing(index: u64, until: &Until) -> End<3> {
    let phi = 1.0 + 0.5 * spread(index)[0];
    let start = State::new([0.5 * phi.sin(), -0.5 * phi.cos(), phi], [0.0; 3]);
    end(Bearing.simulate(start), until)
}

lagrange_gpu::kernels!(puck, puck_apex, puck_steps, belt, stone, bearing);
