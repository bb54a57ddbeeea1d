use super::sphere::{Intersection, LANES, RayBlock, vector};
use glam::DVec3;

// ANCHOR: keep_closest
/// Intersects a block of rays with one shape and keeps the closest hits: all rays in f64, and the uncertain ones again
/// in double-double.
///
/// At equal distances the lower shape number wins.
#[inline(always)]
pub fn keep_closest(
    rays: &RayBlock,
    intersection: impl Fn(DVec3, DVec3) -> Intersection,
    double_double: impl Fn(DVec3, DVec3) -> f64,
    number: u32,
    t: &mut [f64],
    shape: &mut [u32],
) {
    let (mut found, mut uncertain) = ([f64::INFINITY; LANES], [false; LANES]);
    for lane in 0..LANES {
        let intersection = intersection(vector(&rays.o, lane), vector(&rays.d, lane));
        (found[lane], uncertain[lane]) = (intersection.t, intersection.uncertain);
    }
    for (lane, (t, shape)) in t.iter_mut().zip(shape).enumerate() {
        if uncertain[lane] {
            found[lane] = double_double(vector(&rays.o, lane), vector(&rays.d, lane));
        }
        if found[lane] < *t || (found[lane] == *t && number < *shape && found[lane] < f64::INFINITY) {
            (*t, *shape) = (found[lane], number);
        }
    }
}
// ANCHOR_END: keep_closest
