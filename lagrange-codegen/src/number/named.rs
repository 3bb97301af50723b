//! The constants of `std::f64::consts`, with what their doubles lack: by mpmath, `float(x - mpf(float(x)))`
//! with 600 bits.

use std::f64::consts;

use super::Number;

impl Number {
    /// A constant by its name in `std::f64::consts`.
    pub fn named(name: &str) -> Option<Number> {
        let (value, rest) = match name {
            "LN_2" => return Some(Number::LN_2),
            "LN_10" => return Some(Number::LN_10),
            "PI" => (consts::PI, 1.2246467991473532e-16),
            "TAU" => (consts::TAU, 2.4492935982947064e-16),
            "E" => (consts::E, 1.4456468917292502e-16),
            "SQRT_2" => (consts::SQRT_2, -9.667293313452913e-17),
            "LOG2_E" => (consts::LOG2_E, 2.0355273740931033e-17),
            "LOG10_E" => (consts::LOG10_E, 1.098319650216765e-17),
            "LOG2_10" => (consts::LOG2_10, 1.661617516973592e-16),
            "LOG10_2" => (consts::LOG10_2, -2.8037281277851704e-18),
            "FRAC_PI_2" => (consts::FRAC_PI_2, 6.123233995736766e-17),
            "FRAC_PI_3" => (consts::FRAC_PI_3, -1.072081766451091e-16),
            "FRAC_PI_4" => (consts::FRAC_PI_4, 3.061616997868383e-17),
            "FRAC_PI_6" => (consts::FRAC_PI_6, -5.360408832255455e-17),
            "FRAC_PI_8" => (consts::FRAC_PI_8, 1.5308084989341915e-17),
            "FRAC_1_PI" => (consts::FRAC_1_PI, -1.9678676675182486e-17),
            "FRAC_2_PI" => (consts::FRAC_2_PI, -3.935735335036497e-17),
            "FRAC_2_SQRT_PI" => (consts::FRAC_2_SQRT_PI, 1.533545961316588e-17),
            "FRAC_1_SQRT_2" => (consts::FRAC_1_SQRT_2, -4.833646656726457e-17),
            _ => return None,
        };
        Some(Number::Float(value, rest))
    }

    /// ln 2.
    pub const LN_2: Number = Number::Float(consts::LN_2, 2.3190468138462996e-17);

    /// ln 10.
    pub const LN_10: Number = Number::Float(consts::LN_10, -2.1707562233822494e-16);

    /// A degree in radians.
    pub const DEGREE: Number = Number::Float(consts::PI / 180.0, 2.9486522708701687e-19);

    /// A radian in degrees.
    pub const RADIAN: Number = Number::Float(180.0 / consts::PI, -1.9878495670576283e-15);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 38 digits of each, as an exact ratio: its parts are those of the table.
    #[test]
    fn constants_have_all_their_digits() {
        let digits = [
            ("PI", "3.1415926535897932384626433832795028842"),
            ("TAU", "6.2831853071795864769252867665590057684"),
            ("E", "2.7182818284590452353602874713526624978"),
            ("SQRT_2", "1.4142135623730950488016887242096980786"),
            ("LN_2", "0.69314718055994530941723212145817656808"),
            ("LN_10", "2.3025850929940456840179914546843642076"),
            ("LOG2_E", "1.4426950408889634073599246810018921374"),
            ("LOG10_E", "0.43429448190325182765112891891660508229"),
            ("LOG2_10", "3.3219280948873623478703194294893901759"),
            ("LOG10_2", "0.30102999566398119521373889472449302677"),
            ("FRAC_PI_2", "1.5707963267948966192313216916397514421"),
            ("FRAC_PI_3", "1.0471975511965977461542144610931676281"),
            ("FRAC_PI_4", "0.78539816339744830961566084581987572105"),
            ("FRAC_PI_6", "0.52359877559829887307710723054658381403"),
            ("FRAC_PI_8", "0.39269908169872415480783042290993786052"),
            ("FRAC_1_PI", "0.31830988618379067153776752674502872407"),
            ("FRAC_2_PI", "0.63661977236758134307553505349005744814"),
            ("FRAC_2_SQRT_PI", "1.1283791670955125738961589031215451717"),
            ("FRAC_1_SQRT_2", "0.70710678118654752440084436210484903928"),
        ];
        for (name, digits) in digits {
            assert_eq!(
                Number::named(name).unwrap().parts(),
                Number::parse(digits).unwrap().parts(),
                "{name}"
            );
        }
        assert_eq!(Number::named("GOLDEN_RATIO"), None);
    }
}
