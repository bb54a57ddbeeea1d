use super::kernel::{Kernel, within};
use crate::scene::SceneError;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// The Gaussian, shifted down so that it ends at zero.
#[derive(Clone, Copy, Debug)]
pub struct GaussianKernel {
    /// In pixels.
    pub radius: f64,
    /// The standard deviation in pixels.
    pub sigma: f64,
}

impl GaussianKernel {
    fn exponent(self, x: f64) -> f64 {
        -x * x / (2.0 * self.sigma * self.sigma)
    }
}

impl Kernel for GaussianKernel {
    fn radius(self) -> f64 {
        self.radius
    }

    fn check(self, who: &str) -> Result<(), SceneError> {
        let range = [self.radius / 8.0, self.radius * 8.0];
        within(who, "filter sigma", self.sigma, range, "a number of pixels that fits the radius,")
    }

    fn value(self, x: f64) -> f64 {
        self.factor() * self.value_over_factor(x)
    }

    fn factor(self) -> f64 {
        libm::exp(self.exponent(self.radius))
    }

    #[inline(always)]
    fn value_over_factor(self, x: f64) -> f64 {
        libm::expm1(self.exponent(x) - self.exponent(self.radius))
    }

    fn area(self, x: f64) -> f64 {
        let Self { radius, sigma } = self;
        let edge = libm::exp(-radius * radius / (2.0 * sigma * sigma));
        sigma * (PI / 2.0).sqrt() * libm::erf(x / sigma * FRAC_1_SQRT_2) - x * edge
    }
}
