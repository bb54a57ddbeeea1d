use std::time::{Duration, Instant};

/// How long a frame may take while the camera moves.
const FRAME: Duration = Duration::from_millis(30);
/// How long after the last movement the camera is at rest.
const REST: Duration = Duration::from_millis(150);
/// By how much a side of the picture may be divided while the camera moves.
const DIVISORS: [u32; 4] = [1, 2, 4, 8];

/// Whether the camera moves, and how coarse the picture must be then.
pub struct Pace {
    moved: Option<Instant>,
    /// What a pixel of the last frame took, in seconds.
    pixel: f64,
}

impl Default for Pace {
    /// As if the camera had just moved, through a scene that takes long: the first frame comes soon, whatever it shows.
    fn default() -> Self {
        Self { moved: Some(Instant::now()), pixel: 1e-6 }
    }
}

impl Pace {
    /// The camera has just moved.
    pub fn moved(&mut self) {
        self.moved = Some(Instant::now());
    }

    /// Whether it moves.
    pub fn is_moving(&self) -> bool {
        self.moved.is_some_and(|moved| moved.elapsed() < REST)
    }

    /// Takes note of how long so many pixels took.
    pub fn note(&mut self, pixels: u64, time: Duration) {
        self.pixel = time.as_secs_f64() / pixels.max(1) as f64;
    }

    /// By how much to divide the sides of a picture of so many pixels now.
    pub fn divisor(&self, pixels: u64) -> u32 {
        let fits = |side: &u32| self.pixel * pixels as f64 / f64::from(side * side) <= FRAME.as_secs_f64();
        if self.is_moving() { DIVISORS.into_iter().find(fits).unwrap_or(8) } else { 1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_picture_is_coarse_only_while_the_camera_moves_and_no_coarser_than_need_be() {
        let mut pace = Pace { moved: None, pixel: 1.0 };
        pace.note(1000, Duration::from_millis(1));
        assert_eq!(pace.divisor(1_000_000), 1);
        pace.moved();
        assert_eq!([30_000, 31_000, 121_000, 500_000, 1 << 40].map(|pixels| pace.divisor(pixels)), [1, 2, 4, 8, 8]);
        pace.moved = Instant::now().checked_sub(REST);
        assert_eq!(pace.divisor(1_000_000), 1);
    }
}
