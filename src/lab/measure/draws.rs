//! Random numbers of tests and benches.
//!
//! All are a pure function of (seed, index), so a failure is named by two numbers.

use glam::DVec3;

/// The random numbers of one test case: a function of (seed, index) and of how many were drawn.
#[derive(Clone, Copy, Debug)]
pub struct Draws {
    state: u64,
}

impl Draws {
    /// The numbers of case `index` under `seed`.
    #[must_use]
    pub fn new(seed: u64, index: u64) -> Self {
        Self { state: scramble(seed ^ scramble(index)) }
    }

    /// The next number, uniform in [0, 1), a multiple of 2^-53.
    pub fn unit(&mut self) -> f64 {
        // The odd constant is 2^64 over the golden ratio, so that counters spread over all bits
        // (splitmix64).
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        (scramble(self.state) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// The next number, uniform between the two.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// 10 to a uniform power between the two: every order of magnitude has the same probability.
    pub fn power_of_ten(&mut self, low: f64, high: f64) -> f64 {
        libm::exp10(self.between(low, high))
    }

    /// A unit vector, uniform over the sphere.
    pub fn unit_vector(&mut self) -> DVec3 {
        let (z, angle) = (self.between(-1.0, 1.0), self.between(0.0, std::f64::consts::TAU));
        let across = libm::sqrt(1.0 - z * z);
        DVec3::new(across * libm::cos(angle), across * libm::sin(angle), z)
    }

    /// A unit vector at a right angle to the unit vector `axis`.
    pub fn unit_vector_across(&mut self, axis: DVec3) -> DVec3 {
        let across = axis.cross(self.unit_vector());
        across / libm::sqrt(across.length_squared())
    }
}

/// The finaliser of splitmix64: a bijection that spreads every input bit over all output bits.
fn scramble(mut bits: u64) -> u64 {
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}
