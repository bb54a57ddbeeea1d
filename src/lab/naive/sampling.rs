//! Sampling a pixel as first ray tracers have it.

// ANCHOR: naive_jitter
/// A raster coordinate as the pixel's number and a random part, added in f32.
///
/// From 2¹⁵ on f32 has 256 numbers in a pixel, and what rounds up lands in the next one.
#[must_use]
pub fn raster_plus_jitter_f32(pixel: u32, jitter: f32) -> f32 {
    pixel as f32 + jitter
}
// ANCHOR_END: naive_jitter

// ANCHOR: naive_unit
/// A number "below 1" from 32 random bits: the largest 128 of them round to 1.
#[must_use]
pub fn unit_of_32_bits(bits: u32) -> f32 {
    bits as f32 * (1.0 / 4_294_967_296.0)
}
// ANCHOR_END: naive_unit

/// Places in the pixel on a grid of `side` × `side`: the same in every pixel, and a pattern as regular as many that it is
/// to show.
#[must_use]
pub fn grid_place(sample: u32, side: u32) -> [f64; 2] {
    [sample % side, sample / side].map(|step| (f64::from(step) + 0.5) / f64::from(side))
}

/// The mean of weighted samples by the number of samples and the filter's whole weight: right on the average only.
#[must_use]
pub fn mean_by_count(samples: &[(f32, f32)], whole: f64) -> f64 {
    let sum: f64 = samples.iter().map(|&(value, weight)| f64::from(value) * f64::from(weight)).sum();
    sum / samples.len() as f64 / whole
}
