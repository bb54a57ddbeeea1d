//! Half the height of the image plane at distance 1, as it is often computed from a full angle in degrees.

// ANCHOR: naive_tan_half
/// The right formula in f32.
///
/// Near 180° the rounding of the angle is a large part of what is missing to 180°; and half of 180° in f32 is more than
/// π/2, where the tangent is negative and the picture makes half a turn.
#[must_use]
pub fn tan_half_f32(degrees: f32) -> f32 {
    libm::tanf(degrees.to_radians() / 2.0)
}

/// The half forgotten: too wide, and above 90° negative, so that the picture makes half a turn.
#[must_use]
pub fn tan_of_full_angle(degrees: f32) -> f32 {
    libm::tanf(degrees.to_radians())
}

/// Degrees handed to a tangent that takes radians.
#[must_use]
pub fn tan_half_of_degrees_as_radians(degrees: f32) -> f32 {
    libm::tanf(degrees / 2.0)
}

/// The plane's whole height taken for half of it.
#[must_use]
pub fn whole_height(degrees: f32) -> f32 {
    2.0 * libm::tanf(degrees.to_radians() / 2.0)
}
// ANCHOR_END: naive_tan_half

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::exact::{Dyadic, UNIT_ROUNDOFF_F32, relative_error};
    use crate::measure::exact_angle::tan_of_degrees;
    use pinhole::extract::tan_half;
    use pinhole::scene::Degrees;

    /// The relative error of a tangent of half an angle, in u = 2⁻²⁴.
    fn error_in_u(tangent: f64, degrees: f64) -> f64 {
        relative_error(tangent, &tan_of_degrees(&Dyadic::of(degrees).scaled(-1))) / UNIT_ROUNDOFF_F32
    }

    #[test]
    fn near_180_degrees_f32_loses_digits_and_at_180_the_sign() {
        let naive = error_in_u(f64::from(tan_half_f32(179.99)), 179.99);
        let pinhole = error_in_u(tan_half(Degrees(179.99)), 179.99);
        eprintln!(
            "tan(179.99° / 2): naive {naive:.0} u off, pinhole {pinhole:.1e} u; naive of 180°: {:.1e}",
            tan_half_f32(180.0)
        );
        assert!(naive > 9000.0 && pinhole < 1e-8);
        assert!(tan_half_f32(180.0) < -2e7);
    }

    #[test]
    fn pinhole_keeps_its_digits_at_every_angle() {
        let angles: Vec<f64> = (1..1800)
            .map(|tenth| f64::from(tenth) / 10.0)
            .chain((1..=300).flat_map(|step| {
                let small = libm::pow(10.0, -f64::from(step) / 30.0);
                [small, 180.0 - small]
            }))
            .collect();
        let worst = angles.iter().map(|&angle| error_in_u(tan_half(Degrees(angle)), angle)).fold(0.0, f64::max);
        eprintln!("{} angles: pinhole's tangent is at most {worst:.1e} u off", angles.len());
        assert!(worst * UNIT_ROUNDOFF_F32 < 4.0 * f64::EPSILON);
    }

    #[test]
    fn the_mistakes_are_far_off_at_an_everyday_angle() {
        let half = tan_half_f32(60.0);
        assert!((tan_of_full_angle(60.0) / half - 3.0).abs() < 1e-5);
        assert!((whole_height(60.0) / half - 2.0).abs() < 1e-5);
        assert!(tan_half_of_degrees_as_radians(60.0) < -6.0);
    }
}
