//! NDC to screen as it is often written, each with one mistake.
//!
//! Reads and writes f64: these are wrong in principle, not by rounding.

use glam::DVec2;

// ANCHOR: naive_screen
/// The corners go to (∓1, ±1) whatever the image's shape: right for a square image only.
#[must_use]
pub fn without_aspect(ndc: DVec2, _aspect: f64) -> DVec2 {
    DVec2::new(2.0 * ndc.x - 1.0, 1.0 - 2.0 * ndc.y)
}

/// Down stays down: the picture stands on its head.
#[must_use]
pub fn upside_down(ndc: DVec2, aspect: f64) -> DVec2 {
    DVec2::new((2.0 * ndc.x - 1.0) * aspect, 2.0 * ndc.y - 1.0)
}

/// To the left instead of to the right: the picture as a mirror shows it.
#[must_use]
pub fn mirrored(ndc: DVec2, aspect: f64) -> DVec2 {
    DVec2::new((1.0 - 2.0 * ndc.x) * aspect, 1.0 - 2.0 * ndc.y)
}
// ANCHOR_END: naive_screen

#[cfg(test)]
mod tests {
    use super::*;
    use pinhole::rays::screen_from_ndc;

    /// The fraction of points of the image that a function puts elsewhere than pinhole does.
    fn elsewhere(naive: fn(DVec2, f64) -> DVec2, aspect: f64) -> f64 {
        let points: Vec<DVec2> = (0..64)
            .flat_map(|y| (0..64).map(move |x| DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) / 64.0))
            .collect();
        let wrong = points.iter().filter(|&&ndc| naive(ndc, aspect) != screen_from_ndc(ndc, aspect)).count();
        wrong as f64 / points.len() as f64
    }

    #[test]
    fn a_square_image_hides_the_forgotten_aspect_and_no_image_hides_the_others() {
        assert_eq!(elsewhere(without_aspect, 1.0), 0.0);
        for (naive, aspect) in [(without_aspect as fn(DVec2, f64) -> DVec2, 2.0), (upside_down, 1.0), (mirrored, 1.0)] {
            assert_eq!(elsewhere(naive, aspect), 1.0);
        }
    }

    #[test]
    fn the_often_read_corner_is_right_for_square_images_only() {
        assert_eq!(without_aspect(DVec2::ZERO, 2.0), DVec2::new(-1.0, 1.0));
        assert_eq!(screen_from_ndc(DVec2::ZERO, 2.0), DVec2::new(-2.0, 1.0));
        assert_eq!(screen_from_ndc(DVec2::ZERO, 1.0), DVec2::new(-1.0, 1.0));
    }
}
