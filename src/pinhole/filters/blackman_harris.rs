use super::kernel::Kernel;
use std::f64::consts::PI;

/// The four coefficients of the window (Blackman–Harris, minimum 4-term; Harris 1978).
const HARRIS: [f64; 4] = [0.35875, 0.48829, 0.14128, 0.01168];

/// The Blackman–Harris window.
#[derive(Clone, Copy, Debug)]
pub struct BlackmanHarrisKernel {
    /// In pixels.
    pub radius: f64,
}

impl Kernel for BlackmanHarrisKernel {
    fn radius(self) -> f64 {
        self.radius
    }

    fn value(self, x: f64) -> f64 {
        let wave = |k: f64| libm::cos(k * PI * x / self.radius);
        HARRIS[0] + HARRIS[1] * wave(1.0) + HARRIS[2] * wave(2.0) + HARRIS[3] * wave(3.0)
    }

    fn area(self, x: f64) -> f64 {
        let wave = |k: f64| self.radius / (k * PI) * libm::sin(k * PI * x / self.radius);
        HARRIS[0] * x + HARRIS[1] * wave(1.0) + HARRIS[2] * wave(2.0) + HARRIS[3] * wave(3.0)
    }
}
