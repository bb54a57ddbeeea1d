use super::sphere::{LANES, RayBlock, Verdict, vector};
use glam::DVec3;

// ANCHOR: narrow
/// Narrows the hits of a block of rays by one shape: all by the quick verdict, and those in doubt by the wide one.
///
/// Among equal distances the lower shape number stays.
#[inline(always)]
pub fn narrow(
    rays: &RayBlock,
    verdict: impl Fn(DVec3, DVec3) -> Verdict,
    wide: impl Fn(DVec3, DVec3) -> f64,
    number: u32,
    t: &mut [f64],
    shape: &mut [u32],
) {
    let (mut found, mut doubtful) = ([f64::INFINITY; LANES], [false; LANES]);
    for lane in 0..LANES {
        let verdict = verdict(vector(&rays.o, lane), vector(&rays.d, lane));
        (found[lane], doubtful[lane]) = (verdict.t, verdict.doubtful);
    }
    for (lane, (t, shape)) in t.iter_mut().zip(shape).enumerate() {
        if doubtful[lane] {
            found[lane] = wide(vector(&rays.o, lane), vector(&rays.d, lane));
        }
        if found[lane] < *t || (found[lane] == *t && number < *shape && found[lane] < f64::INFINITY) {
            (*t, *shape) = (found[lane], number);
        }
    }
}
// ANCHOR_END: narrow
