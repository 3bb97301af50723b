//! Hills on a step: whether the energy rises on the way and falls again.

use crate::number::real::{Ordered, Real, larger};

/// The rule of Kronrod with seven points on [−1, 1]: points, weights, and the weights of the rule of Gauss
/// with three of the points (R. Piessens et al., *QUADPACK*, 1983). The two points without weights check the
/// polynomial through the others.
pub(super) const RULE: [(f64, f64, f64); 9] = [
    (-0.960_491_268_708_020_3, 0.104_656_226_026_467_27, 0.0),
    (-0.774_596_669_241_483_4, 0.268_488_089_868_333_44, 5.0 / 9.0),
    (-0.6, 0.0, 0.0),
    (-0.434_243_749_346_802_55, 0.401_397_414_775_962_2, 0.0),
    (0.0, 0.450_916_538_658_474_14, 8.0 / 9.0),
    (0.2, 0.0, 0.0),
    (0.434_243_749_346_802_55, 0.401_397_414_775_962_2, 0.0),
    (0.774_596_669_241_483_4, 0.268_488_089_868_333_44, 5.0 / 9.0),
    (0.960_491_268_708_020_3, 0.104_656_226_026_467_27, 0.0),
];

/// The places from one point of the rule to the next at which a hill is looked for.
const BETWEEN: usize = 4;

/// The part of the largest power below which the energy hardly falls.
const LEVEL: f64 = 1.0 / 32.0;

/// The part of a step until a point.
pub(super) fn share<R: Real>(point: f64) -> R {
    R::from_f64(0.5 * (1.0 + point))
}

/// Whether powers at the points of the rule and between them leave open that the energy falls, then rises or
/// hardly falls, and falls again: at these points or on their polynomial, which has to meet the others. A
/// valley less deep than the level is one that the points may have missed. A step that ends where a rise has
/// become half as steep as it was may end on a hill.
pub(super) fn may_rise<R: Ordered>(powers: &[R; RULE.len()]) -> bool {
    let most = powers.iter().fold(R::zero(), |most, x| larger(x.abs(), most));
    let [level, noise] = [R::from_f64(LEVEL), R::epsilon().sqrt()].map(|share| share * most);
    let meets = |(&(point, ..), &power): (&(f64, f64, f64), &R)| (at(powers, point) - power).abs() <= level;
    if !RULE.iter().zip(powers).all(meets) {
        return true;
    }
    let (mut falls, mut levels, mut rises, mut steepest) = (false, false, false, R::zero());
    for number in 0..=BETWEEN * (RULE.len() - 1) {
        let (first, part) = (number / BETWEEN, (number % BETWEEN) as f64 / BETWEEN as f64);
        let power = at(powers, point(first) + part * (point(first + 1) - point(first)));
        if levels && power > level + level || rises && power > noise {
            return true;
        }
        falls |= power > level + level;
        levels |= falls && power < level;
        rises |= power < -noise;
        if power < steepest {
            steepest = power;
        } else if steepest < -level && power + power > steepest {
            return true;
        }
    }
    false
}

fn has_weight(k: usize) -> bool {
    RULE.get(k).is_some_and(|rule| rule.1 > 0.0)
}

fn point(k: usize) -> f64 {
    RULE.get(k).map_or(1.0, |rule| rule.0)
}

/// The polynomial through the powers at the points that have weights.
fn at<R: Ordered>(powers: &[R; RULE.len()], place: f64) -> R {
    let weight = |k: usize| {
        let others = (0..RULE.len()).filter(|&other| other != k && has_weight(other));
        others.fold(1.0, |product, other| product * (place - point(other)) / (point(k) - point(other)))
    };
    let terms = powers.iter().enumerate().filter(|&(k, _)| has_weight(k));
    terms.fold(R::zero(), |sum, (k, &power)| R::mul_add(R::from_f64(weight(k)), power, sum))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_of_kronrod_has_its_degree() {
        for degree in 0..12 {
            let sum = |weight: fn(&(f64, f64, f64)) -> f64| -> f64 {
                RULE.iter().map(|rule| weight(rule) * rule.0.powi(degree)).sum()
            };
            let exact = if degree % 2 == 0 { 2.0 / f64::from(degree + 1) } else { 0.0 };
            assert!((sum(|rule| rule.1) - exact).abs() < 1e-15, "{degree}");
            assert_eq!((sum(|rule| rule.2) - exact).abs() < 1e-15, degree < 6 || degree % 2 == 1, "{degree}");
        }
    }

    #[test]
    fn valleys_between_points_are_seen() {
        let rises = |power: fn(f64) -> f64| may_rise(&RULE.map(|rule| power(rule.0)));
        assert!(!rises(|_| 1.0));
        assert!(!rises(|x| 1.0 - x));
        // Beyond a minimum the energy rises alone, and from a maximum on it falls alone.
        assert!(!rises(|x| 0.8 - x));
        assert!(!rises(|x| 1.0 + x));
        assert!(rises(|x| (x + 0.6) * (x - 0.3)));
        // A valley between two points, and a slope that comes as near to zero as one.
        assert!(rises(|x| (x - 0.2).powi(2) - 0.01));
        assert!(rises(|x| (x - 0.2).powi(2) + 0.01));
        // The top of a hill.
        assert!(rises(|x| 0.2 - (2.2 * x + 0.5).sin()));
        // As many waves as the points do not show.
        assert!(rises(|x| 1.0 - 2.0 * (7.3 * x).cos()));
    }
}
