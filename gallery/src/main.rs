//! Prints the catalogue of the gallery as JSON: titles, sliders and names, which the pages read.
//! Equations come from `cargo lagrange equations`, which finds them by the file of a model.

use gallery::models::{
    cart_pole::CartPole, chain::Chain, double_pendulum::DoublePendulum, four_bar::FourBar,
    rocking_block::Block, stick_slip::Belt, three_body::ThreeBody, top::Top,
};
use gallery::{Model, Slider};

fn sliders(sliders: &[Slider]) -> String {
    let entry = |slider: &Slider| {
        let Slider { name, unit, range, start } = slider;
        format!("{{\"name\":{name:?},\"unit\":{unit:?},\"range\":{range:?},\"start\":{start:?}}}")
    };
    format!("[{}]", sliders.iter().map(entry).collect::<Vec<_>>().join(","))
}

/// `note` stands above the equations.
fn page<M: Model<N>, const N: usize>(name: &str, title: &str, about: &str, note: &str) -> String {
    format!(
        "{{\"name\":{name:?},\"title\":{title:?},\"about\":{about:?},\"note\":{note:?},\"parameters\":{},\
         \"settings\":{},\"reactions\":{:?},\"view\":{:?},\"conservative\":{},\"coordinates\":{N}}}",
        sliders(M::PARAMETERS),
        sliders(M::SETTINGS),
        M::REACTIONS,
        M::VIEW,
        M::CONSERVATIVE
    )
}

fn main() {
    let pages = [
        page::<DoublePendulum, 2>(
            "double_pendulum",
            "Double pendulum",
            "Two masses on rods: the textbook's chaotic system. Drag a mass and let it go.",
            "",
        ),
        page::<CartPole, 2>(
            "cart_pole",
            "Cart and pole",
            "A motor swings the pole up and balances it. Push the cart, or pull the pole down.",
            "",
        ),
        page::<ThreeBody, 6>(
            "three_body",
            "Three bodies",
            "Three equal masses follow each other along a figure eight. Change a mass a little, or drag a body away.",
            "",
        ),
        page::<Top, 3>(
            "top",
            "Spinning top",
            "A top with its tip on the ground. Its orientation is a coordinate, so no attitude is singular.",
            "",
        ),
        page::<FourBar, 3>(
            "four_bar",
            "Four-bar linkage",
            "Three bars and a frame, closed by a constraint. Its multipliers are the force in the hinge.",
            "",
        ),
        page::<Block, 3>(
            "rocking_block",
            "Rocking block",
            "A block falls from corner to corner, infinitely often in finite time, until it stands.",
            "In flight; a contact adds its reaction:",
        ),
        page::<Belt, 1>(
            "stick_slip",
            "Stick and slip",
            "A belt drags a block along until the spring tears it loose: how a violin string sounds and a brake squeals.",
            "Without friction, which adds its force:",
        ),
        page::<Chain, 10>("chain", "Chain of ten links", "A chain falls like a whip. Drag any joint.", ""),
    ];
    println!("[{}]", pages.join(",\n"));
}
