use crate::scene::{Degrees, FovAxis};

// ANCHOR: tan_half
/// tan(φ / 2) of a full angle φ, accurate to the last bits even near 180°: there it is the reciprocal of the tangent of
/// half the difference to 180°, which is subtracted exactly.
pub fn tan_half(angle: Degrees) -> f64 {
    if angle.0 > 90.0 {
        1.0 / libm::tan(Degrees(180.0 - angle.0).radians() / 2.0)
    } else {
        libm::tan(angle.radians() / 2.0)
    }
}
// ANCHOR_END: tan_half

// ANCHOR: half_extent
/// The extent of an image of this aspect ratio from its centre along `axis`, in half heights.
pub fn half_extent(axis: FovAxis, aspect: f64) -> f64 {
    match axis {
        FovAxis::Vertical => 1.0,
        FovAxis::Horizontal => aspect,
        FovAxis::Smaller => aspect.min(1.0),
        FovAxis::Larger => aspect.max(1.0),
        FovAxis::Diagonal => (1.0 + aspect * aspect).sqrt(),
    }
}

/// tan(fov / 2) for the vertical field of view, from an angle along `axis` of an image of this aspect ratio.
pub(super) fn tan_half_vertical(fov: Degrees, axis: FovAxis, aspect: f64) -> f64 {
    tan_half(fov) / half_extent(axis, aspect)
}
// ANCHOR_END: half_extent
