//! Orientations over a million steps: the energy and the angular momentum of bodies that tumble through all
//! attitudes wander as rounding errors add up, and do not drift. Slow: `scripts/check.sh long`.

use lagrangian::prelude::*;

use crate::close::between;

/// Steps of a run.
const STEPS: u64 = 1_000_000;

struct Free;

#[lagrangian(coordinates = [attitude: Rotation])]
impl Free {
    #[body(mass = 1.0, inertia = [1.0, 2.0, 3.0])]
    fn body(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::identity(), q.attitude)
    }
}

struct Heavy;

#[lagrangian(coordinates = [attitude: Rotation])]
impl Heavy {
    #[body(mass = 1.0, inertia = [0.35, 0.35, 0.05])]
    fn body(&self, q: &Coordinates) -> (Vector3<f64>, UnitQuaternion<f64>) {
        (Vector3::zeros(), q.attitude)
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        4.9 * (q.attitude * Vector3::z()).z
    }
}

/// The distance that rounding errors of a few ulps walk in so many steps. A drift of one ulp a step would go
/// 250 times as far.
const WALK: f64 = 4.0 * f64::EPSILON * 1000.0;

/// The quantities of a state that a system keeps.
type Kept<S> = fn(&S, &State<f64, 3>) -> Vec<f64>;

/// The largest change of what a system keeps, relative to the size of the first, over a run.
fn wandered<S>(name: &str, system: &S, start: State<f64, 3>, kept: Kept<S>) -> f64
where
    S: System<3, 0, Scalar = f64, Method = Jets> + lagrangian::Smooth<3>,
{
    let mut motion = system.simulate(start).with_tolerance(0.0);
    let first = kept(system, &start);
    let size = first.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    let (mut largest, mut shown, mut second) = (0.0_f64, 1000, 0.0);
    while motion.steps().accepted < STEPS {
        second += 1.0;
        let state = *motion.advance_to(second).unwrap();
        for (now, then) in kept(system, &state).iter().zip(&first) {
            largest = largest.max((now - then).abs() / size);
        }
        if motion.steps().accepted >= shown {
            println!("{name}: t = {second:.0}, {} steps, {largest:.1e}", motion.steps().accepted);
            shown *= 4;
        }
    }
    println!("{name}: t = {second:.0}, {} steps, {largest:.1e}", motion.steps().accepted);
    largest
}

/// R I ω, and twice the kinetic energy.
fn of_free(body: &Free, state: &State<f64, 3>) -> Vec<f64> {
    let attitude = FreeCoordinates::from(state.q).attitude;
    let rates = body.velocities(state).attitude;
    let momentum = rates.component_mul(&Vector3::new(1.0, 2.0, 3.0));
    let mut kept = (attitude * momentum).as_slice().to_vec();
    kept.push(momentum.dot(&rates));
    kept
}

/// The energy, the angular momentum about the vertical, and that about the axis of the top.
fn of_heavy(body: &Heavy, state: &State<f64, 3>) -> Vec<f64> {
    let attitude = HeavyCoordinates::from(state.q).attitude;
    let momentum = body.velocities(state).attitude.component_mul(&Vector3::new(0.35, 0.35, 0.05));
    vec![body.energy(state), (attitude * momentum).z, momentum.z]
}

#[test]
fn a_body_that_tumbles_about_its_unstable_axis_keeps_its_momentum() {
    let start = Free.state(
        FreeCoordinates { attitude: UnitQuaternion::from_euler_angles(0.3, -0.2, 0.9) },
        FreeVelocities { attitude: Vector3::new(0.01, 5.0, 0.02) },
    );
    between(0.0, wandered("free body", &Free, start, of_free), WALK);
}

#[test]
fn a_heavy_top_that_falls_past_hanging_keeps_its_energy() {
    let start = Heavy.state(
        HeavyCoordinates { attitude: UnitQuaternion::from_euler_angles(0.0, 0.3, 0.0) },
        HeavyVelocities { attitude: Vector3::new(0.0, 0.0, 0.5) },
    );
    between(0.0, wandered("heavy top", &Heavy, start, of_heavy), WALK);
}
