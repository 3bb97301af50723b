//! Motions in lanes: the bits of a row depend on its index alone, and its errors are those of a single
//! motion.

use lagrange_ensemble::{Ensemble, Error, Failure, Record, Row, Study};
use lagrangian::Lanes;
use lagrangian::prelude::*;
use lagrangian::wide::{f64x2, f64x4, f64x8};

/// Two masses on rods, the lower one damped.
struct Pendulum {
    length: f64,
    g: f64,
    damping: f64,
}

#[lagrangian(coordinates = [theta: [2]], jacobians)]
impl Pendulum {
    #[point(mass = 1.0)]
    fn upper(&self, q: &Coordinates) -> Vector2<f64> {
        self.length * Vector2::new(q.theta[0].sin(), -q.theta[0].cos())
    }

    #[point(mass = 2.0)]
    fn lower(&self, q: &Coordinates) -> Vector2<f64> {
        self.upper(q) + Vector2::new(q.theta[1].sin(), -q.theta[1].cos())
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        self.g * (self.upper(q).y + 2.0 * self.lower(q).y)
    }

    #[dissipation]
    fn bearing(&self, v: &Velocities) -> f64 {
        0.5 * self.damping * v.theta[1].powi(2)
    }
}

/// A planet, which may fall into its sun.
struct Planet {
    mu: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl Planet {
    #[point(mass = 1.0)]
    fn planet(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        -self.mu / self.planet(q).norm()
    }
}

/// A body that turns freely about its centre, and changes its triple of parameters now and then.
struct Top {
    inertia: f64,
}

#[lagrangian(coordinates = [attitude: Rotation], jacobians)]
impl Top {
    #[body(mass = 1.0, inertia = [self.inertia, 2.0, 1.5])]
    fn body(&self, q: &Coordinates) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::identity(), q.attitude)
    }
}

/// A pendulum in Cartesian coordinates: a constraint.
struct Rod {
    length: f64,
}

#[lagrangian(coordinates = [x, y], jacobians)]
impl Rod {
    #[point(mass = 1.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - self.length
    }
}

/// A four-bar linkage: two constraints, whose gradients depend on each other where all bars lie on a line.
struct Linkage {
    ground: f64,
    rocker: f64,
}

#[lagrangian(coordinates = [crank, coupler, arm], jacobians)]
impl Linkage {
    fn along(length: f64, angle: f64) -> Vector2<f64> {
        Vector2::new(angle.cos(), angle.sin()) * length
    }

    #[point(mass = 1.0)]
    fn pin(&self, q: &Coordinates) -> Vector2<f64> {
        Self::along(1.0, q.crank)
    }

    #[body(mass = 2.0, inertia = 0.5)]
    fn bar(&self, q: &Coordinates) -> (Vector2<f64>, f64) {
        (self.pin(q) + Self::along(1.5, q.coupler), q.coupler)
    }

    #[point(mass = 1.0)]
    fn end(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(self.ground, 0.0) + Self::along(self.rocker, q.arm)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        9.81 * (self.pin(q).y + 2.0 * self.bar(q).0.y + self.end(q).y)
    }

    #[holonomic]
    fn closure(&self, q: &Coordinates) -> Vector2<f64> {
        self.pin(q) + Self::along(3.0, q.coupler) - self.end(q)
    }
}

/// A mass matrix that is indefinite in three coordinates.
struct Saddle;

#[lagrangian(coordinates = [x, y, z], jacobians)]
impl Saddle {
    #[lagrangian]
    fn action(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.x * v.y + v.y * v.z + 0.5 * (2.0 + q.x.sin()) * v.z.powi(2) - 0.5 * (q.x.powi(2) + q.y.powi(2))
    }
}

/// The same with a constraint.
struct Tied;

#[lagrangian(coordinates = [x, y, z], jacobians)]
impl Tied {
    #[lagrangian]
    fn action(&self, q: &Coordinates, v: &Velocities) -> f64 {
        v.x * v.y + v.y * v.z + 0.5 * (2.0 + q.x.sin()) * v.z.powi(2) - 0.5 * (q.x.powi(2) + q.y.powi(2))
    }

    #[holonomic]
    fn tie(&self, q: &Coordinates) -> f64 {
        q.x + 0.5 * q.z.sin()
    }
}

/// The bits of all rows.
fn bits<F: Row<T>, T: Record>(study: &Study<F, T>) -> Vec<Result<Vec<u8>, Failure>> {
    let rows = study.run().expect("the study runs").to_vec().expect("the rows are in memory");
    let bytes = |record: T| {
        let mut bytes = Vec::new();
        record.store(&mut bytes);
        bytes
    };
    rows.into_iter().map(|row| row.map(bytes)).collect()
}

/// Small and large motions, fast and slow ones, pendulums at rest, and numbers that are not finite.
fn pendulums(index: u64) -> (Pendulum, State<f64, 2>) {
    let x = (index as f64 * 0.618_033_988_749_894_9).fract();
    let g = match index % 7 {
        3 => 100.0,
        5 => 1e-6,
        6 => f64::NAN,
        _ => 9.81,
    };
    let start = match index % 11 {
        0 => State::at_rest([0.0, 0.0]),
        1 => State::new([1e-9, 0.0], [0.0, 0.0]),
        2 => State::new([0.1, 0.0], [f64::INFINITY, 0.0]),
        _ => State::new([3.0 * x, 1.0 - x], [0.0, 5.0 * x]),
    };
    (Pendulum { length: 0.5 + x, g, damping: 0.1 * x }, start.at_time(x))
}

/// Circles, ellipses of any size, free falls.
fn planets(index: u64) -> (Planet, State<f64, 2>) {
    let x = (index as f64 * 0.618_033_988_749_894_9).fract();
    let mu = [1.0, 1e-6, 50.0][(index % 3) as usize];
    let speed = if index % 7 == 4 { 0.0 } else { (mu * (1.0 - 0.7 * x)).sqrt() };
    (Planet { mu }, State::new([1.0, 0.0], [0.0, speed]))
}

/// Rods that whirl and rods at rest, lengths that are NaN, and starts off the constraint.
fn rods(index: u64) -> (Rod, State<f64, 2>) {
    let x = (index as f64 * 0.618_033_988_749_894_9).fract();
    let length = if index % 7 == 6 { f64::NAN } else { 0.5 + x };
    let speed = if index.is_multiple_of(5) { 0.0 } else { 4.0 * x - 1.0 };
    let beside = if index % 11 == 8 { 1.01 } else { 1.0 };
    let (cos, sin) = (x.cos() * length * beside, x.sin() * length * beside);
    (Rod { length }, State::new([cos, sin], [-sin * speed, cos * speed]))
}

/// Linkages that turn round and that swing; every fifth is a parallelogram, and passes positions where it is
/// flat.
fn linkages(index: u64) -> Result<(Linkage, State<f64, 3>), MotionError<f64>> {
    let x = (index as f64 * 0.618_033_988_749_894_9).fract();
    let flat = index % 5 == 4;
    let linkage = Linkage { ground: 3.0, rocker: if flat { 1.0 } else { 1.5 + x } };
    let near = if flat { [2.5, 0.0, 2.5] } else { [1.2, 0.35, 1.9] };
    let start = linkage.consistent(State::new(near, [if flat { -3.0 } else { 9.0 * x - 3.0 }, 0.0, 0.0]))?;
    Ok((linkage, start))
}

macro_rules! same_bits {
    ($start:expr, $t:expr, $samples:literal, $orientations:expr) => {{
        // A motion may end with either triple of an orientation.
        let settled = |state: &_| lagrangian::attitude::settle(&$orientations, state).unwrap_or(*state);
        let study = |count| Ensemble::new(count, $start).with_tolerance(1e-9);
        let expected = bits(&study(48).in_lanes::<Lanes<f64x4>>().ends("ends", $t).with_threads(1));
        for threads in [3] {
            let study =
                study(48).in_lanes::<Lanes<f64x4>>().ends("ends", $t).with_threads(threads).with_part_size(5);
            assert!(bits(&study) == expected, "{threads} threads");
        }
        for size in [1, 1000] {
            let study = study(48).in_lanes::<Lanes<f64x4>>().ends("ends", $t).with_part_size(size);
            assert!(bits(&study) == expected, "parts of {size}");
        }
        // In vectors of other lengths, and with other neighbours.
        assert!(bits(&study(48).in_lanes::<Lanes<f64x2>>().ends("ends", $t).with_threads(1)) == expected);
        assert!(bits(&study(48).in_lanes::<Lanes<f64x8>>().ends("ends", $t).with_threads(1)) == expected);
        let backward = Ensemble::new(48, |index: u64| $start(47 - index)).with_tolerance(1e-9);
        let mut found = bits(&backward.in_lanes::<Lanes<f64x4>>().ends("ends", $t).with_threads(1));
        found.reverse();
        assert!(found == expected, "backward");

        // The motions are those that run alone, and so are their errors.
        let lanes = study(48).in_lanes::<Lanes<f64x4>>().ends("ends", $t).run().expect("the study runs");
        let alone = study(48).ends("ends", $t).run().expect("the study runs");
        let (lanes, alone) = (lanes.to_vec().expect("rows"), alone.to_vec().expect("rows"));
        for (index, (found, expected)) in lanes.into_iter().zip(alone).enumerate() {
            match (found, expected) {
                (Ok(found), Ok(expected)) => {
                    for (found, expected) in settled(&found).iter().zip(settled(&expected).iter()) {
                        let size = expected.abs().max(1.0);
                        assert!((found - expected).abs() < 1e-5 * size, "{index}: {found} {expected}");
                    }
                }
                (found, expected) => assert_eq!(found, expected, "{index}"),
            }
        }

        // States on the way are those of the same polynomials.
        let samples = || {
            study(24)
                .in_lanes::<Lanes<f64x4>>()
                .samples::<$samples, _, _, _, _, _, _, _>("samples", $t / $samples as f64)
        };
        let expected = bits(&samples().with_threads(1));
        assert!(bits(&samples().with_threads(3).with_part_size(5)) == expected);
        let found = samples().run().expect("runs").to_vec().expect("rows");
        let alone = study(24).samples::<$samples, _, _, _, _>("samples", $t / $samples as f64);
        let alone = alone.run().expect("runs").to_vec().expect("rows");
        for (index, (found, expected)) in found.into_iter().zip(alone).enumerate() {
            match (found, expected) {
                (Ok(found), Ok(expected)) => {
                    for (found, expected) in found.iter().zip(&expected) {
                        assert_eq!(found.t, expected.t);
                        for (found, expected) in settled(found).iter().zip(settled(expected).iter()) {
                            let size = expected.abs().max(1.0);
                            assert!((found - expected).abs() < 1e-5 * size, "{index}: {found} {expected}");
                        }
                    }
                }
                (found, expected) => assert_eq!(found, expected, "{index}"),
            }
        }
    }};
}

#[test]
fn pendulums_in_lanes_depend_on_their_index_alone() {
    same_bits!(pendulums, 1.5, 9, []);
    // Backward in time, too.
    same_bits!(pendulums, -1.0, 4, []);
}

#[test]
fn planets_in_lanes_depend_on_their_index_alone() {
    same_bits!(planets, 6.0, 50, []);
}

#[test]
fn orientations_in_lanes_depend_on_their_index_alone() {
    let start = |index: u64| {
        let x = index as f64 * 0.1;
        let top = Top { inertia: 1.0 + 0.01 * x };
        (top, State::new([0.1, x.sin(), x.cos()], [1.0 + x, 0.3, -0.2 * x]))
    };
    same_bits!(start, 3.0, 6, [0]);
}

#[test]
fn rods_in_lanes_depend_on_their_index_alone() {
    same_bits!(rods, 1.5, 9, []);
}

#[test]
fn linkages_in_lanes_depend_on_their_index_alone() {
    same_bits!(linkages, 1.5, 4, []);
}

#[test]
fn limits_of_steps_hold_in_lanes() {
    let ensemble = |count| Ensemble::new(count, planets).with_tolerances(1e-8, 1e-10);
    let few = ensemble(40).with_max_steps(3).in_lanes::<Lanes<f64x4>>().ends("ends", 6.0);
    let rows = few.run().expect("the study runs").to_vec().expect("rows");
    let failed = rows.iter().filter(|row| row.is_err()).count();
    assert!(failed > 10, "{failed}");
    let short = ensemble(40).with_step_limit(0.01).in_lanes::<Lanes<f64x4>>().ends("ends", 1.0);
    let free = ensemble(40).in_lanes::<Lanes<f64x4>>().ends("ends", 1.0);
    let (short, free) = (bits(&short), bits(&free));
    assert_ne!(short, free);
    let bad = ensemble(4).with_tolerance(-1.0).in_lanes::<Lanes<f64x4>>().ends("ends", 1.0);
    let bad = bad.run().expect("the study runs").to_vec().expect("rows");
    assert!(
        bad.iter().all(|row| row.as_ref().is_err_and(|failure| failure.cause.contains("tolerance"))),
        "{bad:?}"
    );
}

#[test]
fn a_study_in_lanes_goes_on_in_its_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let study = || {
        let ensemble = Ensemble::new(100, planets).with_tolerance(1e-9);
        ensemble.in_lanes::<Lanes<f64x4>>().ends("ends", 6.0).with_part_size(9)
    };
    assert!(study().in_folder(folder.path()).part(1, 2).expect("a share").run().expect("runs").is_none());
    let table = study().in_folder(folder.path()).run().expect("runs").expect("complete");
    let found = table.to_vec().expect("rows");
    assert_eq!(found, study().run().expect("runs").to_vec().expect("rows"));
    // One by one they are other bits: another study.
    let alone = Ensemble::new(100, planets).with_tolerance(1e-9).ends("ends", 6.0).with_part_size(9);
    let error = alone.in_folder(folder.path()).run().map(|_| ()).expect_err("another study");
    assert!(matches!(error, Error::AnotherStudy { what: "settings", .. }), "{error}");
}

#[test]
fn a_panic_in_lanes_names_its_index() {
    let start = |index: u64| {
        assert!(index != 33, "thirty-three");
        planets(index)
    };
    let study = Ensemble::new(100, start).in_lanes::<Lanes<f64x4>>().ends("ends", 1.0);
    let error = study.run().map(|_| ()).expect_err("it panics");
    assert!(matches!(error, Error::Panicked { index: 33, .. }), "{error}");
}

#[test]
fn systems_that_lanes_cannot_keep_apart_are_refused() {
    let study = Ensemble::new(10, |_| (Tied, State::at_rest([0.0, 0.0, 0.0])));
    let error = study.in_lanes::<Lanes<f64x4>>().ends("ties", 1.0).run().map(|_| ()).expect_err("pivots");
    assert!(matches!(&error, Error::NotInLanes { why } if why.contains("constraints")), "{error}");
    let study = Ensemble::new(10, |_| (Saddle, State::at_rest([1.0, 0.0, 0.0])));
    let error = study.in_lanes::<Lanes<f64x4>>().ends("saddles", 1.0).run().map(|_| ()).expect_err("pivots");
    assert!(matches!(&error, Error::NotInLanes { why } if why.contains("indefinite")), "{error}");
}
