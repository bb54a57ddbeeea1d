//! Motion blur as first thought of: a few frames, one after the other, and their mean.

// ANCHOR: time_of_frame
/// The time of a sample where all pixels take the same few moments, in turn.
///
/// What moves farther than its own width between two of them shows as so many ghosts, at any number of samples.
#[must_use]
pub fn time_of_frame(sample: u32, frames: u32, length: f64) -> f64 {
    (f64::from(sample % frames) + 0.5) / f64::from(frames) * length
}
// ANCHOR_END: time_of_frame
