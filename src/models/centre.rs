use glam::DVec3;

/// How many times as far from the origin as it is large a mesh may be before it is moved there: then f32 still resolves
/// a millionth of it.
const FAR: f64 = 16.0;

/// The point that is subtracted from positions in f64 before they are rounded to f32; zero unless they are so far from
/// the origin that f32 would not tell neighbours apart.
///
/// It is a multiple of a power of two, so that decimals of few digits stay what they are.
pub fn centre_of(positions: impl Iterator<Item = [f64; 3]>) -> DVec3 {
    let (mut low, mut high, mut is_exact) = (DVec3::INFINITY, DVec3::NEG_INFINITY, true);
    for position in positions.map(DVec3::from).filter(|position| position.as_vec3().is_finite()) {
        low = low.min(position);
        high = high.max(position);
        is_exact &= position.as_vec3().as_dvec3() == position;
    }
    let half = 0.5 * (high - low).max_element();
    let farthest = low.abs().max(high.abs()).max_element();
    if is_exact || !(half > 0.0 && farthest > FAR * half) {
        return DVec3::ZERO;
    }
    let unit = libm::exp2(libm::floor(libm::log2(half)));
    let centre = ((0.5 * (low + high)) / unit).round() * unit;
    if centre.is_finite() { centre } else { DVec3::ZERO }
}

/// A position about that point.
#[inline(always)]
pub fn about(centre: DVec3, position: [f64; 3]) -> [f32; 3] {
    (DVec3::from(position) - centre).as_vec3().to_array()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_far_from_the_origin_keep_their_digits() {
        let grid = |x: f64, y: f64| (0..4).map(move |own| [x + 0.1 * f64::from(own), 3.1 * f64::from(own % 2), y]);
        for [x, y] in [[499_000.0, 5_349_000.7], [-2.5e9, 0.3], [1e12, -1e12]] {
            let centre = centre_of(grid(x, y));
            assert!(centre != DVec3::ZERO);
            for position in grid(x, y) {
                let found = centre + DVec3::from(about(centre, position).map(f64::from));
                let spacing = (x.abs() + y.abs()) * f64::EPSILON + 1e-6;
                assert!((found - DVec3::from(position)).abs().max_element() < spacing, "{found} for {position:?}");
            }
        }
    }

    #[test]
    fn others_stay_where_they_are() {
        let box_at =
            |x: f64, size: f64| (0..8).map(move |own| [x + size * f64::from(own & 1), f64::from(own >> 1), 0.1]);
        assert_eq!(centre_of(box_at(3.3, 1.0)), DVec3::ZERO);
        // As many digits as f32 has.
        assert_eq!(centre_of([[1e6, 0.0, 0.0], [1e6 + 0.5, 0.0, 0.0]].into_iter()), DVec3::ZERO);
        assert_eq!(centre_of([[1e9 + 0.1, 0.0, 0.0]].into_iter()), DVec3::ZERO);
        assert_eq!(centre_of([[f64::NAN; 3], [1e300; 3]].into_iter()), DVec3::ZERO);
        assert_eq!(centre_of(std::iter::empty()), DVec3::ZERO);
    }
}
