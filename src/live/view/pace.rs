use std::time::{Duration, Instant};

/// How long a frame may take while the camera moves.
const FRAME: Duration = Duration::from_millis(30);
/// How long after the last movement the camera is at rest.
const REST: Duration = Duration::from_millis(150);
/// How much of the least time is certainly not its pixels'.
const MIN_KNOWN: f64 = 0.8;
/// By how much a side of the picture may be divided while the camera moves.
const DIVISORS: [u32; 4] = [1, 2, 4, 8];

/// Whether the camera moves, and how coarse the picture must be then.
pub struct Pace {
    moved: Option<Instant>,
    /// The least that a new frame has taken, in seconds, however few pixels it had.
    min: f64,
    /// What a pixel takes beyond that.
    pixel: f64,
}

impl Default for Pace {
    /// As if the camera had just moved, through a scene that takes long: the first frame comes soon, whatever it shows.
    fn default() -> Self {
        Self { moved: Some(Instant::now()), min: f64::INFINITY, pixel: 1e-6 }
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

    /// Takes note of how long a new frame of so many pixels took.
    ///
    /// A frame that took hardly more than the least says only that a pixel takes no more than so much.
    pub fn note(&mut self, pixels: u64, time: Duration) {
        self.min = self.min.min(time.as_secs_f64());
        let time = time.as_secs_f64();
        let pixel = (time - MIN_KNOWN * self.min).max(0.0) / pixels.max(1) as f64;
        self.pixel = if MIN_KNOWN * time <= self.min { pixel.min(self.pixel) } else { pixel };
    }

    /// By how much to divide the sides of a picture of so many pixels now.
    pub fn divisor(&self, pixels: u64) -> u32 {
        let min = if self.min.is_finite() { self.min } else { 0.0 };
        let frame = FRAME.as_secs_f64();
        let left = (frame - min).max(frame / 3.0);
        let fits = |side: &u32| self.pixel * pixels as f64 / f64::from(side * side) <= left;
        if self.is_moving() { DIVISORS.into_iter().find(fits).unwrap_or(8) } else { 1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_picture_is_coarse_only_while_the_camera_moves_and_no_coarser_than_need_be() {
        let mut pace = Pace { moved: None, min: 0.0, pixel: 1.0 };
        pace.note(1000, Duration::from_millis(1));
        assert_eq!(pace.divisor(1_000_000), 1);
        pace.moved();
        assert_eq!([30_000, 31_000, 121_000, 500_000, 1 << 40].map(|pixels| pace.divisor(pixels)), [1, 2, 4, 8, 8]);
        pace.moved = Instant::now().checked_sub(REST);
        assert_eq!(pace.divisor(1_000_000), 1);
    }

    #[test]
    fn what_every_frame_takes_is_no_reason_for_fewer_pixels() {
        let mut pace = Pace::default();
        assert_eq!(pace.divisor(500_000), 8);
        for pixels in [100, 10_000, 100] {
            pace.note(pixels, Duration::from_micros(18_000 + pixels / 10));
        }
        assert!(pace.divisor(240 * 135) <= 2, "{}", pace.divisor(240 * 135));
    }
}
