use super::sphere::{Intersection, LANES, RayBlock, vector};
use glam::DVec3;

// ANCHOR: keep_closest
/// Narrows the hits of a block of rays by one shape: all by the quick verdict, and those in doubt by the wide one.
///
/// Among equal distances the lower shape number stays.
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
    for component in 0..LANES {
        let intersection = intersection(vector(&rays.o, component), vector(&rays.d, component));
        (found[component], uncertain[component]) = (intersection.t, intersection.uncertain);
    }
    for (component, (t, shape)) in t.iter_mut().zip(shape).enumerate() {
        if uncertain[component] {
            found[component] = double_double(vector(&rays.o, component), vector(&rays.d, component));
        }
        if found[component] < *t || (found[component] == *t && number < *shape && found[component] < f64::INFINITY) {
            (*t, *shape) = (found[component], number);
        }
    }
}
// ANCHOR_END: keep_closest
