//! The kernels as functions: their motions are right on the cores of this machine.

use std::error::Error;
use std::f64::consts::TAU;

use kernels::*;
use lagrange_gpu::{Gpu, kernel};
use lagrangian::prelude::*;

const STEPS: Steps = (1.0 / 256.0, 256);
const UNTIL: Until = (1.0, 1e-12);

fn numbers<const N: usize>(state: State<f64, N>) -> Vec<u64> {
    state.iter().map(f64::to_bits).collect()
}

/// The largest difference of two states.
fn apart<const N: usize>(a: State<f64, N>, b: State<f64, N>) -> f64 {
    a.iter().zip(b.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn starts_fill_the_square() {
    let cells = |count: u64| {
        let cell = |index| spread(index).map(|part| (8.0 * (part + 1.0)) as usize);
        let mut seen = [[false; 16]; 16];
        for [row, column] in (0..count).map(cell) {
            seen[row][column] = true;
        }
        seen.iter().flatten().filter(|seen| **seen).count()
    };
    assert_eq!(cells(1024), 256);
    assert!((0..1 << 16).flat_map(spread).all(|part| (-1.0..1.0).contains(&part)));
}

/// A study, on threads and through its table, has the bits of one motion after the other.
#[test]
fn a_study_has_the_bits_of_its_motions() -> Result<(), Box<dyn Error>> {
    let table = kernel!(four_bar_jet6).study(40, &STEPS).run()?.to_vec()?;
    for (index, row) in (0..).zip(table) {
        let (system, start) = a_four_bar(index)?;
        let mut motion = system.stepper::<Jet<6>>(start);
        for _ in 0..STEPS.1 {
            motion.step(STEPS.0, &[])?;
        }
        assert_eq!(numbers(row?), numbers(*motion.state()), "motion {index}");
    }
    let table = kernel!(links_adaptive).study(10, &UNTIL).run()?.to_vec()?;
    for (index, row) in (0..).zip(table) {
        let (system, start) = a_chain(index);
        let mut motion = system.simulate(start).with_tolerance(UNTIL.1);
        assert_eq!(numbers(row?), numbers(*motion.advance_to(UNTIL.0)?), "motion {index}");
    }
    Ok(())
}

/// An ellipse closes after the time that Kepler's third law says.
#[test]
fn planets_return() -> Result<(), Box<dyn Error>> {
    for index in 0..20 {
        let (Kepler { mu }, start) = a_planet(index);
        let speed_squared: f64 = start.v.iter().map(|v| v * v).sum();
        let axis = 1.0 / (2.0 / start.q[0] - speed_squared / mu);
        let period = TAU * (axis.powi(3) / mu).sqrt();
        for end in [kepler_adaptive(index, &(period, 1e-13))?, kepler_dop853(index, &(period, 1e-13))?] {
            assert!(apart(end, start.at_time(end.t)) < 1e-10, "planet {index}: {end:?}");
        }
        let steps = 4096;
        let end = kepler_jet6(index, &(period / steps as f64, steps))?;
        assert!(apart(end, start.at_time(end.t)) < 1e-10, "planet {index} by steps: {end:?}");
    }
    Ok(())
}

/// Energy is nowhere put in or taken out: a right motion keeps it, whatever the method.
#[test]
fn energy_stays() -> Result<(), Box<dyn Error>> {
    for index in 0..20 {
        let (pendulum, start) = a_double_pendulum(index);
        let energy = pendulum.energy(&start);
        for end in [
            double_pendulum_rk4(index, &(1.0 / 2048.0, 2048))?,
            double_pendulum_jet6(index, &STEPS)?,
            double_pendulum_adaptive(index, &UNTIL)?,
            double_pendulum_dop853(index, &UNTIL)?,
        ] {
            assert!((pendulum.energy(&end) - energy).abs() < 1e-6, "pendulum {index}: {end:?}");
        }
        let (chain, start) = a_chain(index);
        for end in [links_jet6(index, &STEPS)?, links_adaptive(index, &UNTIL)?, links_dop853(index, &UNTIL)?]
        {
            assert!((chain.energy(&end) - chain.energy(&start)).abs() < 1e-6, "chain {index}: {end:?}");
        }
    }
    Ok(())
}

#[test]
fn loops_stay_closed() -> Result<(), Box<dyn Error>> {
    for index in 0..20 {
        let (four_bar, start) = a_four_bar(index)?;
        for end in [
            four_bar_jet6(index, &STEPS)?,
            four_bar_adaptive(index, &UNTIL)?,
            four_bar_dop853(index, &UNTIL)?,
        ] {
            let residuals = four_bar.constraint_residuals(&end);
            assert!(residuals.iter().all(|f| f.abs() < 1e-13), "linkage {index}: {residuals:?}");
            let drift = four_bar.energy(&end) - four_bar.energy(&start);
            assert!(drift.abs() < 1e-7, "linkage {index}: {drift}");
            assert!((end.q[0] - start.q[0]).abs() > 0.5, "linkage {index} does not move");
        }
    }
    Ok(())
}

#[test]
fn poles_stand_and_fall() -> Result<(), Box<dyn Error>> {
    for index in 0..20 {
        let held = cart_pole_jet6(index, &(1.0 / 256.0, 4096))?;
        assert!(held.q[1].abs() < 0.05, "pole {index} fell: {held:?}");
        let (_, start) = a_cart_pole(index);
        for free in [cart_pole_adaptive(index, &UNTIL)?, cart_pole_dop853(index, &UNTIL)?] {
            assert!(free.q[1].abs() > start.q[1].abs(), "pole {index} stays: {free:?}");
        }
    }
    Ok(())
}

/// The error of a machine without a processor. On a machine with one, `scripts/gpu.sh run` runs the kernels.
#[test]
fn a_machine_without_a_processor_says_so() {
    match Gpu::new(0) {
        Err(error @ (lagrange_gpu::Error::NoDriver | lagrange_gpu::Error::NoDevice { .. })) => {
            assert!(error.to_string().starts_with("this machine has no "), "{error}");
        }
        Err(error) => panic!("{error}"),
        Ok(gpu) => assert_eq!(gpu.number(), 0),
    }
}
