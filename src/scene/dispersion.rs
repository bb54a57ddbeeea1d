use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// Beside a [`Glass`](super::Glass) or a [`RoughGlass`](super::RoughGlass): its index of refraction as a function of the
/// wavelength, in place of its `ior`, which is then not used.
///
/// Paths are traced at one wavelength each, from 380 to 780 nm, so that white light parts into colours.
/// Whitted's method, which splits rays instead of sampling them, uses the index at 587.56 nm.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Dispersion {
    /// Schott's crown glass N-BK7, which disperses little: index 1.5168, Abbe number 64.2.
    Bk7,
    /// Schott's dense flint glass SF11, which disperses much: index 1.7847, Abbe number 25.8.
    Sf11,
    /// Water at 20 °C: index 1.3334, Abbe number 55.8 (Daimon and Masumura 2007).
    Water,
    /// Diamond: index 2.4175, Abbe number 55.3 (Peter 1923).
    Diamond,
    /// Cauchy's equation n = a + b/λ² + c/λ⁴, with the wavelength λ in micrometres.
    Cauchy {
        /// The index for infinite wavelengths.
        a: f64,
        /// In µm².
        b: f64,
        /// In µm⁴.
        #[serde(default)]
        c: f64,
    },
    /// Sellmeier's equation n² = 1 + Σ bᵢ λ² / (λ² − cᵢ), with the wavelength λ in micrometres.
    Sellmeier {
        /// The strengths of three resonances.
        b: [f64; 3],
        /// The squares of their wavelengths, in µm².
        c: [f64; 3],
    },
}
