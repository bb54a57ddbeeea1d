//! What pages 19 and 20 say of metal and glass, from their closed forms.

use super::page_says;
use pinhole::material::{SMOOTHEST_METAL, fresnel, fresnel_parts};

#[test]
fn metal_reflects_what_page_19_says() {
    let sent = 1.0 - std::f64::consts::LN_2;
    assert!((sent - 0.3).abs() < 0.01);
    page_says("19_mirrors.md", "reflects $1 - \\ln 2$, three tenths");
    page_says("19_mirrors.md", &format!("the smooth ball the colour {sent:.2}"));
    // D falls to half where (tan θ / α)² = √2 − 1, and the mirrored direction turns by twice θ.
    let half = 2.0 * libm::atan(SMOOTHEST_METAL * libm::sqrt(std::f64::consts::SQRT_2 - 1.0)).to_degrees();
    page_says(
        "19_mirrors.md",
        &format!(
            "Below $\\alpha = {SMOOTHEST_METAL}$ metal counts as a mirror: its highlight falls to half within {half:.2}°"
        ),
    );
}

#[test]
fn glass_reflects_what_page_20_says() {
    page_says("20_glass.md", &format!("{:.0} % for glass", 100.0 * fresnel(1.0, 1.5)));
    let critical = libm::asin(1.0 / 1.5).to_degrees();
    page_says("20_glass.md", &format!("everything from {critical:.0}° on"));
    assert!(fresnel(0.5, 1.5) < 0.1);
    page_says("20_glass.md", "less than a tenth is reflected up to 60°");
    let [across, within] = fresnel_parts(1.0 / libm::sqrt(1.0 + 1.5 * 1.5), 1.5);
    assert!(within < 1e-20 && across > 0.1, "at Brewster's angle");
    assert_eq!(fresnel(0.3, 1.0), 0.0, "exactly 0 between equals");
}
