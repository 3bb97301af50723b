//! An arm of six joints follows a motion: by computed torque, and by a linear-quadratic regulator about it.

use std::error::Error;

use lagrangian::pictures::{Chart, Figure};
use lagrangian::prelude::*;

#[path = "support/arm.rs"]
mod arm;
#[path = "support/regulator.rs"]
mod regulator;

use arm::{Arm, ArmCoordinates, DECAY, computed_torque, needed, regulated, wanted};
use regulator::{RATE, Regulator, SAMPLES, cost, design};

/// The length of a sample \[s].
const STEP: f64 = 1.0 / RATE as f64;

/// The law that sets the torques.
#[derive(Clone, Copy)]
enum Control<'a> {
    ComputedTorque,
    Regulator(&'a Regulator),
}

impl Control<'_> {
    /// The torques for the next sample. The controller knows of no payload.
    fn torque(self, sample: usize, state: &State<f64, 6>) -> Result<[f64; 6], MotionError<f64>> {
        let model = Arm { payload: 0.0 };
        match self {
            Control::ComputedTorque => computed_torque(&model, state, &wanted(state.t)),
            Control::Regulator(regulator) => regulated(&model, state, STEP, &regulator.gains[sample]),
        }
    }
}

/// A motion under control from a deviation: its states at the samples, and the cost of the deviations.
fn run(
    plant: &Arm<f64>,
    control: Control<'_>,
    start: [f64; 6],
) -> Result<(Vec<State<f64, 6>>, f64), MotionError<f64>> {
    let model = Arm { payload: 0.0 };
    let begin = wanted(0.0).state;
    let q = std::array::from_fn(|i| begin.q[i] + start[i]);
    let mut motion = plant.stepper::<Jet<6>>(State { q, ..begin });
    let (mut states, mut total) = (vec![*motion.state()], 0.0);
    for sample in 0..SAMPLES {
        let (state, aim) = (*motion.state(), wanted(motion.state().t));
        let torque = control.torque(sample, &state)?;
        let needed = needed(&model, state.t, STEP)?;
        let deviation = SVector::from_iterator(state.iter().zip(aim.state.iter()).map(|(x, aim)| x - aim));
        total += cost(&deviation, &SVector::from_fn(|i, _| torque[i] - needed[i]));
        states.push(*motion.step(STEP, &torque)?);
    }
    Ok((states, total))
}

/// How far the tool is from where it should be \[m].
fn astray(state: &State<f64, 6>) -> f64 {
    let (arm, aim) = (Arm { payload: 0.0 }, wanted(state.t).state);
    (arm.tool(&ArmCoordinates::from(state.q)) - arm.tool(&ArmCoordinates::from(aim.q))).norm()
}

/// Follows the motion from beside it, with and without a payload that the controllers know nothing of.
pub fn main() -> Result<(), Box<dyn Error>> {
    println!("{}\n\n{}\n", Arm::<f64>::STRUCTURE, Arm::<f64>::COST);
    let (exact, loaded) = (Arm { payload: 0.0 }, Arm { payload: 2.0 });
    let regulator = design(&exact)?;
    let beside = [0.05, -0.04, 0.03, -0.05, 0.06, -0.03];

    let mut chart = Chart::new("Back to the motion that is wanted", "time [s]", "tool astray [mm]");
    let mut worst = Vec::new();
    for (name, control) in
        [("computed torque", Control::ComputedTorque), ("regulator", Control::Regulator(&regulator))]
    {
        for (plant, load) in [(&exact, ""), (&loaded, ", 2 kg more")] {
            let (states, _) = run(plant, control, beside)?;
            let end = states.iter().skip(SAMPLES / 2).map(astray).fold(0.0, f64::max);
            println!("{name:>16}{load:12} the tool is astray by {:6.3} mm in the second half", 1e3 * end);
            chart = chart
                .line(&format!("{name}{load}"), states.iter().step_by(5).map(|x| (x.t, 1e3 * astray(x))));
            worst.push(end);
        }
    }

    // Errors under computed torque decay as designed: e₀ (1 + λt) exp(−λt), with torques held for a sample.
    let (states, _) = run(&exact, Control::ComputedTorque, beside)?;
    let mut error = Chart::new("Errors of the joints under computed torque", "time [s]", "error [rad]");
    for i in 0..6 {
        let of = |state: &State<f64, 6>| (state.t, state.q[i] - wanted(state.t).state.q[i]);
        error = error.line(&format!("joint {}", i + 1), states.iter().step_by(10).map(of));
    }
    let decay = |t: f64| (1.0 + DECAY * t) * (-DECAY * t).exp();
    let mut departure = 0.0_f64;
    for state in &states {
        let aim = wanted(state.t).state.q;
        for ((q, aim), beside) in state.q.iter().zip(aim).zip(beside) {
            departure = departure.max((q - aim - beside * decay(state.t)).abs());
        }
    }
    println!("\nErrors under computed torque depart from their law by {departure:.1e} rad");

    // From a small deviation the regulator costs what Riccati's recursion says.
    let small = beside.map(|angle| 1e-2 * angle);
    let deviation = SVector::<f64, 12>::from_fn(|i, _| if i < 6 { small[i] } else { 0.0 });
    let predicted = (deviation.transpose() * regulator.cost * deviation).x;
    let (_, paid) = run(&exact, Control::Regulator(&regulator), small)?;
    let (_, paid_by_other) = run(&exact, Control::ComputedTorque, small)?;
    println!(
        "Cost of a deviation: predicted {predicted:.6e}, paid {paid:.6e}, by computed torque {paid_by_other:.6e}"
    );
    println!("Drawn: {}", Figure::new([chart, error]).save("target/arm_control.svg")?.display());

    // A torque that is held for h lags by h/2: of a decay at the rate λ it misses about λh/2.
    let lag = DECAY * STEP;
    assert!(departure < lag * 0.06, "the errors depart by {departure} rad");
    // The motion is not linear: at 1 mrad, a thousandth.
    assert!((paid / predicted - 1.0).abs() < 1e-3, "{paid} was paid for {predicted}");
    assert!(paid < paid_by_other, "the optimal regulator costs {paid}, another {paid_by_other}");
    assert!(worst[0] < 1e-3 && worst[2] < 1e-3, "the tool is astray: {worst:?}");
    assert!(worst[1] > worst[0] && worst[3] > worst[2], "a payload has no effect: {worst:?}");
    Ok(())
}
