//! A block that rocks on its corners until it stands: impacts that follow each other ever faster, infinitely
//! many of them in finite time.

use std::error::Error;

use lagrangian::pictures::{Chart, Figure, Record};
use lagrangian::prelude::*;

/// A uniform block on a floor so rough that its corners do not slip.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    /// Mass \[kg].
    pub mass: f64,
    /// Half of the width \[m].
    pub half_width: f64,
    /// Half of the height \[m].
    pub half_height: f64,
    /// Coefficient of friction of the corners.
    pub friction: f64,
    /// Gravitational acceleration \[m/s²].
    pub g: f64,
}

#[lagrangian(coordinates = [x, y, phi])]
impl Block {
    #[body(mass = self.mass, inertia = self.mass * (self.half_width.powi(2) + self.half_height.powi(2)) / 3.0)]
    fn block(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.phi)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.mass * self.g * q.y
    }

    /// From the middle to the left and the right lower corner.
    fn arms(&self, q: &Coordinates) -> [Vector2<f64>; 2] {
        let turn = Rotation2::new(q.phi);
        [-1.0, 1.0].map(|side| turn * Vector2::new(side * self.half_width, -self.half_height))
    }

    /// Heights of the corners. Without a coefficient of restitution an impact is plastic.
    #[unilateral]
    fn corners(&self, q: &Coordinates) -> [f64; 2] {
        self.arms(q).map(|arm| q.y + arm.y)
    }

    /// Velocities of the corners along the floor.
    #[friction(coefficient = self.friction, normal = corners)]
    fn slips(&self, q: &Coordinates, v: &Velocities) -> [f64; 2] {
        self.arms(q).map(|arm| v.x - arm.y * v.phi)
    }
}

/// Lets the block go, tilted about its right corner.
pub fn main() -> Result<(), Box<dyn Error>> {
    let block = Block { mass: 40.0, half_width: 0.2, half_height: 0.5, friction: 5.0, g: 9.81 };
    let slender = (block.half_width / block.half_height).atan();
    let tilt = 0.6 * slender;
    let arm = Rotation2::new(-tilt) * Vector2::new(block.half_width, -block.half_height);
    let start = State::at_rest([block.half_width - arm.x, -arm.y, -tilt]);

    let mut motion = block.simulate(start).with_tolerance(1e-12);
    let record = Record::of(&mut motion, 3.0, 600)?;
    let states = record.states();
    let (w, h) = (block.half_width, block.half_height);
    let corners = [[-w, -h], [w, -h], [w, h], [-w, h]];
    let outline = |state: &State<f64, 3>| {
        let pose = block.block(&state.q.into());
        [0, 1, 2, 3, 0].map(|corner| (pose * Point2::from(corners[corner])).coords).map(|at| (at.x, at.y))
    };
    let mut pictures = Chart::new("A block falls from corner to corner", "x [m]", "y [m]").equal_scales();
    for (count, state) in states.iter().take(86).step_by(17).enumerate() {
        pictures = pictures.linkage("", f64::from(count as u32) / 5.0, outline(state));
    }
    let angle = Chart::new("The tilt dies out in finite time", "time [s]", "tilt [rad]")
        .line("", states.iter().map(|state| (state.t, state.q[2])));
    let rates = record.phase_portrait("phi")?.titled(
        "Phase portrait: each impact takes a fifth of the rate",
        "tilt [rad]",
        "rate [rad/s]",
    );
    println!("Drawn: {}", Figure::new([pictures, angle, rates]).save("target/rocking_block.svg")?.display());

    // The force of the floor on a corner, from the reactions of its contact and of its friction.
    let corner =
        |side: usize| move |b: &Block, q: &BlockCoordinates| b.block(q).translation.vector + b.arms(q)[side];
    let film = record
        .film()
        .slower(3.0)
        .ground([[-1.5 * w, 0.0], [1.5 * w, 0.0]])
        .body(Block::block, &corners)
        .reaction(corner(0), |_, _, found| [found.slips[0], found.corners[0]])
        .reaction(corner(1), |_, _, found| [found.slips[1], found.corners[1]]);
    println!("Drawn: {}", film.save("target/rocking_block.film.svg")?.display());

    // Housner: angular momentum about the corner that is hit is kept.
    let factor = 1.0 - 1.5 * slender.sin().powi(2);
    let mut motion = block.simulate(start).with_tolerance(1e-12);
    println!("time [s]   rate after the impact [rad/s]   ratio to the one before");
    let mut before: Option<f64> = None;
    for _ in 0..5 {
        let Some(impact) = motion.advance_to_switch(10.0)? else { break };
        let rate = impact.state.v[2].abs();
        let ratio = before.map(|before| rate / before);
        println!(
            "{:8.5} {rate:31.9} {:>25}",
            impact.state.t,
            ratio.map_or(String::new(), |r| format!("{r:.12}"))
        );
        assert!(
            ratio.is_none_or(|ratio| (ratio - factor).abs() < 1e-9),
            "an impact leaves {ratio:?}, not {factor}"
        );
        before = Some(rate);
    }
    let end = *motion.advance_to(60.0)?;
    println!(
        "After a minute it stands, tilted by {:.1e} rad; each corner carries {:.2?} N",
        end.q[2],
        motion.reactions().corners
    );
    assert!(end.v == [0.0; 3] && end.q[2].abs() < 1e-9, "the block does not stand: {end:?}");
    Ok(())
}
