//! How many digits of a result are true: the same description in doubles and with 31 digits.
//!
//! `cargo run --release --features double-double --example true_digits`
//!
//! A double pendulum from rest is chaotic: what rounding and truncation change at the start grows by a factor
//! of ten about every second. No estimate of one run can say how much of its end is left; a second run with
//! twice the digits and a tolerance far below can.

use lagrangian::DoubleDouble;
use lagrangian::prelude::*;

/// Two equal masses on rods of equal lengths. Whatever is no literal has the scalar's type.
struct DoublePendulum<R> {
    /// Length of the rods [m].
    length: R,
}

#[lagrangian(coordinates = [theta: [2]])]
impl<R: Real> DoublePendulum<R> {
    #[point(mass = 1.0)]
    fn upper(&self, q: &Coordinates<R>) -> Vector2<R> {
        Vector2::new(q.theta[0].sin(), -q.theta[0].cos()) * self.length
    }

    #[point(mass = 1.0)]
    fn lower(&self, q: &Coordinates<R>) -> Vector2<R> {
        self.upper(q) + Vector2::new(q.theta[1].sin(), -q.theta[1].cos()) * self.length
    }

    #[potential]
    fn gravity(&self, q: &Coordinates<R>) -> R {
        9.81 * (self.upper(q).y + self.lower(q).y)
    }
}

/// Prints the upper angle and how many of its digits two runs in doubles have.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A parameter that is no double would differ between the two. Then parse the decimal that is meant:
    // "0.7".parse().
    let exact = DoublePendulum { length: DoubleDouble::from(0.5) };
    let rough = DoublePendulum { length: 0.5 };
    println!("   t   upper angle, true to all digits shown   true digits of a run at 1e-10 and at 1e-14");
    let mut reference =
        exact.simulate(State::at_rest([2.0, 2.1].map(DoubleDouble::from))).with_tolerance("1e-28".parse()?);
    let mut runs =
        [1e-10, 1e-14].map(|tolerance| rough.simulate(State::at_rest([2.0, 2.1])).with_tolerance(tolerance));
    for t in [1.0, 2.0, 5.0, 10.0, 15.0] {
        let truth = *reference.advance_to(DoubleDouble::from(t))?;
        let mut digits = [0.0; 2];
        for (run, digits) in runs.iter_mut().zip(&mut digits) {
            *digits = run.advance_to(t)?.digits_in_common(&truth).least();
        }
        let [loose, tight] = digits;
        println!("{t:4}   {:22.18}   {loose:26.1} {tight:19.1}", truth.q[0]);
        // The tolerances differ by a factor of ten thousand. So the tight run has more digits, until the
        // loose one has none.
        assert!(tight > loose || loose < 1.0);
        assert!(t > 1.0 || (tight > 12.0 && loose > 7.0));
    }
    Ok(())
}
