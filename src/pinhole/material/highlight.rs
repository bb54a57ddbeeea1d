// ANCHOR: highlight
/// The BRDF of a highlight, a lobe of N cosⁿ of the angle from its axis, in 1/sr.
///
/// It is 0 from a right angle on; a cosine above 1 by rounding is clamped, since a large power would amplify it.
#[inline(always)]
pub fn highlight(peak: f64, exponent: f64, cosine: f64) -> f64 {
    if cosine > 0.0 { peak * libm::pow(cosine.min(1.0), exponent) } else { 0.0 }
}
// ANCHOR_END: highlight

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{blinn_phong_peak, half_vector_cosine, mirror_cosine, phong_peak};
    use crate::measure::ray_aim::Draws;
    use glam::DVec3;

    /// The BRDF stays the same when light and eye are exchanged.
    #[test]
    fn highlights_are_reciprocal() {
        for index in 0..20_000 {
            let mut draws = Draws::new(1511, index);
            let exponent = draws.power_of_ten(0.0, 6.0);
            let normal = draws.unit_vector();
            let mut direction = || (normal * draws.between(0.0, 1.0) + draws.unit_vector_across(normal)).normalize();
            let (light, eye) = (direction(), direction());
            for (peak, cosine) in [
                (phong_peak(exponent), mirror_cosine as fn(_, _, _) -> f64),
                (blinn_phong_peak(exponent), half_vector_cosine),
            ] {
                let there = highlight(peak, exponent, cosine(normal, light, eye));
                let back = highlight(peak, exponent, cosine(normal, eye, light));
                let doubt = (exponent + 8.0) * 1e-14 / cosine(normal, light, eye).abs();
                assert!((there - back).abs() <= doubt * there.max(back), "{index}: {there} {back}");
            }
        }
        eprintln!("highlights: 20000 pairs of directions, two models, reciprocal");
    }

    #[test]
    fn highlights_at_their_limits() {
        assert_eq!(highlight(2.0, 1e9, 1.000_001), 2.0, "a cosine above 1 by rounding");
        assert_eq!(highlight(2.0, 1e9, 0.999), 0.0);
        assert_eq!([highlight(2.0, 0.0, 1e-300), highlight(2.0, 0.0, 0.0), highlight(2.0, 2.0, -1.0)], [2.0, 0.0, 0.0]);
        assert_eq!(highlight(2.0, 5.0, f64::NAN), 0.0);
        let opposite = half_vector_cosine(DVec3::Y, DVec3::X, -DVec3::X);
        assert_eq!(highlight(2.0, 5.0, opposite), 0.0, "light and eye are opposite");
        assert!(phong_peak(1e9).is_finite() && blinn_phong_peak(1e9).is_finite());
        assert!((blinn_phong_peak(0.0) - std::f64::consts::FRAC_1_PI).abs() < 1e-16, "an exponent of 0 is matte");
    }
}
