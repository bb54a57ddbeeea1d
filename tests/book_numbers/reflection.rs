//! What page 15 says of highlights, from their closed forms.

use super::page_says;
use pinhole::material::{blinn_phong_peak, phong_peak};
use pinhole_lab::naive::light::short_blinn_phong_peak;

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
