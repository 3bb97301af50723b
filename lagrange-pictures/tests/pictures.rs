//! Pictures of motions as a user sees them, read back from their text, and every error.

use std::error::Error;

use lagrange_pictures::{Chart, Figure, Film, PictureError, Record};
use lagrangian::prelude::*;

/// A point mass on a rod, in Cartesian coordinates.
#[derive(Clone, Copy, Debug)]
struct Pendulum;

#[lagrangian(coordinates = [x, y])]
impl Pendulum {
    #[point(mass = 2.0)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        Vector2::new(q.x, q.y)
    }

    #[potential]
    fn gravity(&self, q: &Coordinates) -> f64 {
        2.0 * 9.81 * q.y
    }

    #[holonomic]
    fn rod(&self, q: &Coordinates) -> f64 {
        self.bob(q).norm() - 1.0
    }
}

/// A body in a plane, without forces.
struct Puck;

#[lagrangian(coordinates = [x, y, phi])]
impl Puck {
    #[body(mass = 1.0, inertia = 1.0)]
    fn disc(&self, q: &Coordinates) -> Isometry2<f64> {
        Isometry2::new(Vector2::new(q.x, q.y), q.phi)
    }
}

fn record(intervals: usize) -> Result<Record<'static, Pendulum, 2>, PictureError> {
    Record::of(&mut Pendulum.simulate(State::at_rest([1.0, 0.0])), 1.0, intervals)
}

/// The values of the first animation of an attribute.
fn values<'s>(svg: &'s str, attribute: &str) -> Vec<&'s str> {
    let head = format!("attributeName=\"{attribute}\"");
    let (_, rest) = svg.split_once(&head).unwrap_or_else(|| panic!("{attribute} does not move"));
    let (_, rest) = rest.split_once("values=\"").expect("values");
    rest.split_once('"').expect("an end").0.split(';').collect()
}

#[test]
fn a_record_has_the_states_at_both_ends() -> Result<(), Box<dyn Error>> {
    let record = record(8)?;
    let times: Vec<f64> = record.states().iter().map(|state| state.t).collect();
    assert_eq!(times, (0..=8).map(|k| 0.125 * f64::from(k)).collect::<Vec<_>>());
    let energies = record.over_time(Pendulum::energy);
    assert!(energies.iter().all(|(_, energy)| energy.abs() < 1e-9));
    assert_eq!(record.path(Pendulum::bob)[0], (1.0, 0.0));
    Ok(())
}

#[test]
fn inputs_are_those_of_each_state() -> Result<(), Box<dyn Error>> {
    /// A mass on a rail, which the input pushes across the rail. The constraint bears the push.
    struct Held;

    #[lagrangian(coordinates = [x, y], inputs = [push])]
    impl Held {
        #[point(mass = 1.0)]
        fn mass(&self, q: &Coordinates) -> Vector2<f64> {
            Vector2::new(q.x, q.y)
        }

        #[force(at = mass)]
        fn hand(&self, u: &Inputs) -> Vector2<f64> {
            Vector2::new(0.0, u.push)
        }

        #[holonomic]
        fn rail(&self, q: &Coordinates) -> f64 {
            q.y
        }
    }

    let start = State::new([0.0, 0.0], [1.0, 0.0]);
    let mut motion = Held.simulate(start).with_control(|state: &State<f64, 2>| [-5.0 * state.q[0]]);
    let svg = Record::of(&mut motion, 2.0, 50)?.reactions().svg()?;
    // The mass moves at 1 m/s, so the multiplier 5 x ends at 10 after 2 s, and so do the ticks.
    assert!(svg.contains(">\n10\n<") && !svg.contains(">\n11\n<"), "{svg}");
    Ok(())
}

#[test]
fn charts_have_titles_names_and_curves() -> Result<(), Box<dyn Error>> {
    let record = record(100)?;
    let portrait = record.phase_portrait("y")?.svg()?;
    assert!(portrait.contains("\ny′\n") && portrait.contains("<polyline"), "{portrait}");
    let energies = record.energies(Pendulum::kinetic_energy, Pendulum::potential_energy).svg()?;
    for name in ["kinetic", "potential", "total"] {
        assert!(energies.contains(&format!("\n{name}\n")), "{name}");
    }
    assert!(record.reactions().svg()?.contains("\nrod\n"));
    assert!(record.energy_change().svg()?.contains("10⁻¹²"));
    let two = Figure::new([record.phase_portrait("x")?, record.phase_portrait("y")?]).svg()?;
    assert_eq!(two.matches("Phase portrait").count(), 2);
    Ok(())
}

#[test]
fn a_film_moves_what_moves() -> Result<(), Box<dyn Error>> {
    // 100 states a second, 25 frames.
    let record = record(100)?;
    let film = record.film().rods(|p, q| [Vector2::zeros(), p.bob(q)]);
    let svg = film.svg()?;
    let (x, y) = (values(&svg, "cx"), values(&svg, "cy"));
    assert_eq!(x.len(), 26);
    // The scale is that of the picture: a rod of 1 m keeps its length.
    let number = |text: &str| text.parse::<f64>().expect("a number");
    let pivot = svg.split_once("cx=\"").and_then(|(_, rest)| rest.split_once('"')).expect("a pivot").0;
    let pivot =
        [number(pivot), number(svg.split("cy=\"").nth(1).and_then(|s| s.split('"').next()).expect("y"))];
    let lengths: Vec<f64> =
        x.iter().zip(&y).map(|(x, y)| (number(x) - pivot[0]).hypot(number(y) - pivot[1])).collect();
    assert!(lengths.iter().all(|length| (length - lengths[0]).abs() < 0.2), "{lengths:?}");
    assert!(svg.contains("dur=\"1000ms\""), "{svg}");
    // The pivot rests.
    assert_eq!(svg.matches("attributeName=\"cx\"").count(), 1);
    let slow = record.film().slower(2.0).point(Pendulum::bob).svg()?;
    assert!(slow.contains("dur=\"2000ms\"") && values(&slow, "cx").len() == 51);
    Ok(())
}

#[test]
fn bodies_turn_and_open_contacts_have_no_arrow() -> Result<(), Box<dyn Error>> {
    let record = Record::of(&mut Puck.simulate(State::new([0.0; 3], [1.0, 0.0, 3.0])), 1.0, 25)?;
    let square = [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]];
    let nothing = |_: &Puck, _: &State<f64, 3>| [0.0, 0.0];
    let film = record.film().ground([[0.0, -0.2], [1.0, -0.2]]).body(Puck::disc, &square);
    let svg = film.force(|_: &Puck, q: &PuckCoordinates| (q.x, q.y), nothing).svg()?;
    assert!(svg.contains("<polygon"));
    let frames = values(&svg, "points");
    assert_eq!((frames.len(), frames[0].split(' ').count()), (26, 4));
    assert_ne!(frames[0], frames[5]);
    let arrow =
        svg.split("stroke-linecap=\"butt\"").nth(1).map(|rest| values(rest, "points")).expect("an arrow");
    let spread = |frame: &str| frame.split(' ').collect::<std::collections::BTreeSet<_>>().len();
    assert!(arrow.iter().all(|frame| spread(frame) == 1), "{arrow:?}");
    Ok(())
}

#[test]
fn reactions_are_arrows_of_one_scale() -> Result<(), Box<dyn Error>> {
    // The rod pulls with 3 m g sin φ at a fall of φ below the horizontal: nothing at the start.
    let record = record(50)?;
    let film = record.film().point(Pendulum::bob);
    let svg = film.reaction(Pendulum::bob, |p, state, found| p.bob(&state.q.into()) * found.rod).svg()?;
    let arrows =
        svg.split("stroke-linecap=\"butt\"").nth(1).map(|rest| values(rest, "points")).expect("an arrow");
    let number = |text: &str| text.parse::<f64>().expect("a number");
    let length = |frame: &&str| {
        let points: Vec<_> = frame.split(' ').map(|at| at.split_once(',').expect("a point")).collect();
        (number(points[1].0) - number(points[0].0)).hypot(number(points[1].1) - number(points[0].1))
    };
    let states = record.states().iter().step_by(2);
    for (frame, state) in arrows.iter().zip(states) {
        // The lowest point is passed within the second, where the pull is largest.
        let expected = 60.0 * -state.q[1];
        assert!((length(frame) - expected).abs() < 1.0, "{} px at {state:?}", length(frame));
    }
    assert_eq!(length(&arrows[0]), 0.0);
    Ok(())
}

#[test]
fn space_is_seen_from_a_direction() -> Result<(), Box<dyn Error>> {
    let record = record(50)?;
    let film =
        || record.film().trail(|p, q| p.bob(q).push(0.0)).point(|_, _: &PendulumCoordinates| [0.0, 0.0, 1.0]);
    let above = film().seen_from(0.0, std::f64::consts::FRAC_PI_2).svg()?;
    let side = film().seen_from(0.0, 0.0).svg()?;
    assert_ne!(above, side);
    // Seen along the x axis, the path in the x-y plane is a line.
    let line = side.split("points=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("a trail");
    let heights: std::collections::BTreeSet<_> = line.split(' ').map(|at| at.split(',').nth(1)).collect();
    assert_eq!(heights.len(), 1, "{line}");
    Ok(())
}

#[test]
fn files_are_written_with_their_folders() -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("a/b/portrait.svg");
    let written = record(10)?.phase_portrait("x")?.save(&path)?;
    assert!(std::fs::read_to_string(written)?.starts_with("<svg"));
    let error = record(10)?.phase_portrait("x")?.save(folder.path()).expect_err("a folder is no file");
    assert!(matches!(error, PictureError::Io { .. }), "{error}");
    Ok(())
}

fn refusal(film: &Film<'_, Pendulum, 2>) -> PictureError {
    film.svg().expect_err("this film cannot be")
}

#[test]
fn every_refusal_has_a_type() -> Result<(), Box<dyn Error>> {
    let record = record(10)?;
    let unknown = record.phase_portrait("z").expect_err("there is no z");
    assert_eq!(unknown.to_string(), "there is no coordinate `z`; there are x, y");
    assert!(matches!(Chart::new("", "", "").svg(), Err(PictureError::Empty)));
    assert!(matches!(Figure::new([]).svg(), Err(PictureError::Empty)));
    let hole = Chart::new("", "", "").line("", [(0.0, 1.0), (1.0, f64::NAN)]);
    assert!(matches!(hole.svg(), Err(PictureError::NotFinite { at: 1.0, .. })));
    assert!(matches!(self::record(0), Err(PictureError::Motion(_))));

    assert!(matches!(refusal(&record.film()), PictureError::Empty));
    let vanishes = record.film().point(|_, q: &PendulumCoordinates| [q.y.ln(), 0.0]);
    assert!(matches!(refusal(&vanishes), PictureError::NotFinite { .. }));
    assert!(matches!(
        refusal(&record.film().slower(0.0).point(Pendulum::bob)),
        PictureError::NotFinite { .. }
    ));
    let grows =
        record.film().rods(|_, q: &PendulumCoordinates| vec![[q.x, q.y]; if q.x > 0.9 { 2 } else { 3 }]);
    assert!(matches!(refusal(&grows), PictureError::ChangingShape { at } if at > 0.0));
    let states = [0.0, 0.1, 0.4].map(|t| State::at_rest([1.0, 0.0]).at_time(t));
    let uneven = Record::new(&Pendulum, states);
    assert!(
        matches!(refusal(&uneven.film().point(Pendulum::bob)), PictureError::UnequalTimes { at } if at == 0.1)
    );
    let single = Record::new(&Pendulum, [State::at_rest([1.0, 0.0])]);
    assert!(matches!(refusal(&single.film().point(Pendulum::bob)), PictureError::Empty));
    Ok(())
}
