//! What pages 15, 19 and 20 say of highlights, metal and glass, from their closed forms.

use super::page_says;
use pinhole::material::{SMOOTHEST_METAL, blinn_phong_peak, fresnel, fresnel_parts, phong_peak};
use pinhole_lab::naive::light::short_blinn_phong_peak;

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
    page_says("20_glass.md", &format!("each surface of a window reflects {:.0} %", 100.0 * fresnel(1.0, 1.5)));
    let critical = libm::asin(1.0 / 1.5).to_degrees();
    page_says("20_glass.md", &format!("everything from {critical:.0}° on"));
    assert!(fresnel(0.5, 1.5) < 0.1);
    page_says("20_glass.md", "less than a tenth is reflected up to 60°");
    let [across, within] = fresnel_parts(1.0 / libm::sqrt(1.0 + 1.5 * 1.5), 1.5);
    assert!(within < 1e-20 && across > 0.1, "at Brewster's angle");
    assert_eq!(fresnel(0.3, 1.0), 0.0, "exactly 0 between equals");
}

#[test]
fn highlights_reflect_what_page_15_says() {
    // Without its factor Phong's lobe reflects 2π / (n + 2), one over the factor.
    let without = |exponent: f64| 1.0 / phong_peak(exponent);
    assert!(without(1.0) > 2.0 && without(1.0) < 2.2);
    let left = format!("{:.0} %", 100.0 * without(100.0));
    page_says(
        "15_reflection.md",
        &format!("$n = 1$ reflects more than twice what arrives, and $n = 100$ loses all but {left}"),
    );
    let over = |step: u32| {
        let exponent = f64::from(step) / 100.0;
        short_blinn_phong_peak(exponent) / blinn_phong_peak(exponent) - 1.0
    };
    let max = (0..10_000).map(over).fold(0.0, f64::max);
    page_says("15_reflection.md", &format!("gives up to {:.1} % too much", 100.0 * max));
    let half = libm::acos(libm::exp2(-1e-9)).to_degrees();
    page_says("15_reflection.md", &format!("end at $10^9$, where a highlight falls to half within {half:.3}°"));
    eprintln!("page 15: the short factor is at most {:.3} % over", 100.0 * max);
}
