//! Sums over the hemisphere by quadrature: what a reflection model sends on of the light that it gets.

use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Points of the rule on each panel; exact for polynomials up to degree 31.
const POINTS: usize = 16;

/// The rule of Gauss and Legendre on [−1, 1]: places and weights, by Newton's method on the recurrence.
fn gauss_legendre() -> [[f64; 2]; POINTS] {
    let count = POINTS as f64;
    std::array::from_fn(|at| {
        let mut x = libm::cos(PI * (at as f64 + 0.75) / (count + 0.5));
        let mut slope = 1.0;
        for _ in 0..8 {
            let (mut before, mut value) = (1.0, x);
            for k in 2..=POINTS {
                let k = k as f64;
                (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
            }
            slope = count * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        [x, 2.0 / ((1.0 - x * x) * slope * slope)]
    })
}

/// A rule for sums over panels, made once.
pub struct Quadrature {
    rule: [[f64; 2]; POINTS],
}

impl Default for Quadrature {
    fn default() -> Self {
        Self { rule: gauss_legendre() }
    }
}

impl Quadrature {
    /// ∫ f from `low` to `high`, for f smooth between.
    pub fn sum(&self, low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        half * self.rule.iter().map(|[x, weight]| weight * f(middle + half * x)).sum::<f64>()
    }

    /// ∫ f over several panels.
    pub fn sum_of_panels(&self, ends: &[f64], f: impl Fn(f64) -> f64) -> f64 {
        ends.windows(2).map(|pair| self.sum(pair[0], pair[1], &f)).sum()
    }

    /// The albedo: the fraction of a beam's light that a surface with normal z sends on: ∫ f(l, ω) cos θ dω over the hemisphere, for a
    /// beam that falls at `angle` to the normal.
    ///
    /// `brdf` gets the ways to the light and to the eye.
    /// Rings about the mirrored direction, narrow where a lobe of width `width` needs it, each ring as far as it lies above
    /// the surface.
    pub fn albedo(&self, angle: f64, width: f64, brdf: impl Fn(DVec3, DVec3) -> f64) -> f64 {
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        let (to_light, mirrored) = (DVec3::new(sin, 0.0, cos), DVec3::new(-sin, 0.0, cos));
        let (inward, across) = (DVec3::new(cos, 0.0, sin), DVec3::Y);
        let mut ends = vec![0.0, FRAC_PI_2 - angle, FRAC_PI_2];
        let mut end = 0.5 * width;
        while end < FRAC_PI_2 + angle {
            ends.push(end);
            end *= 1.7;
        }
        ends.push(FRAC_PI_2 + angle);
        ends.sort_by(f64::total_cmp);
        self.sum_of_panels(&ends, |ring| {
            let (sin_ring, cos_ring) = (libm::sin(ring), libm::cos(ring));
            // Above the surface: cos_ring · cos + sin_ring · sin · cos φ > 0.
            let extent = match (-cos_ring * cos) / (sin_ring * sin) {
                edge if edge >= 1.0 => return 0.0,
                edge if edge > -1.0 => libm::acos(edge),
                _ => PI,
            };
            let along = |turn: f64| {
                let direction = cos_ring * mirrored + sin_ring * (libm::cos(turn) * inward + libm::sin(turn) * across);
                brdf(to_light, direction) * direction.z.max(0.0)
            };
            2.0 * sin_ring * self.sum_of_panels(&[0.0, 0.5 * extent, extent], along)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_with_closed_forms() {
        let quadrature = Quadrature::default();
        assert!((quadrature.sum(-1.0, 2.0, |x| libm::pow(x, 9.0)) - 102.3).abs() < 1e-12);
        for angle in [0.0, 0.3, 1.2, 1.57] {
            let matte = quadrature.albedo(angle, 1.0, |_, _| 1.0 / PI);
            // Where a ring begins to be cut off, its extent grows as a root does, which costs digits.
            assert!((matte - 1.0).abs() < 1e-8, "a matte surface lit at {angle}: {matte}");
        }
        // Lobes of cosⁿ about the normal: 2π / (n + 2).
        for exponent in [1.0, 7.0, 1e3, 1e6] {
            let width = 1.0 / libm::sqrt(exponent + 1.0);
            let lobe = quadrature.albedo(0.0, width, |_, direction| libm::pow(direction.z.clamp(0.0, 1.0), exponent));
            assert!((lobe * (exponent + 2.0) / (2.0 * PI) - 1.0).abs() < 1e-9, "exponent {exponent}: {lobe}");
        }
    }
}
