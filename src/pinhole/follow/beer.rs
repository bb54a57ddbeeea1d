// ANCHOR: transmittance
/// The transmittance of a path of this length: e^(−σt), with σ the absorption coefficient per scene unit (Beer's law).
#[inline(always)]
pub fn transmittance(absorption: f64, length: f64) -> f64 {
    // An infinite path through clear glass would give 0 · ∞.
    if absorption > 0.0 { libm::exp(-absorption * length) } else { 1.0 }
}

/// The fraction of light absorbed along a path of this length: 1 − e^(−σt), to full precision where it is small.
#[inline(always)]
pub fn absorbed(absorption: f64, length: f64) -> f64 {
    if absorption > 0.0 { -libm::expm1(-absorption * length) } else { 0.0 }
}
// ANCHOR_END: transmittance

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn absorbed_and_transmitted_add_up_to_one() {
        let mut worst = 0.0_f64;
        for step in 0..=4000 {
            let thickness = libm::exp10(f64::from(step) / 100.0 - 30.0);
            for absorption in [1e-3, 1.0, 40.0] {
                let (left, absorbed) = (transmittance(absorption, thickness), absorbed(absorption, thickness));
                assert!((0.0..=1.0).contains(&left) && (0.0..=1.0).contains(&absorbed));
                worst = worst.max((left + absorbed - 1.0).abs());
                let depth = absorption * thickness;
                if depth < 1e-4 {
                    // The Taylor series, whose next term is below 1e-14 of its value.
                    let series = depth * (1.0 - 0.5 * depth * (1.0 - depth / 3.0 * (1.0 - 0.25 * depth)));
                    assert!((absorbed / series - 1.0).abs() < 1e-15, "{depth}");
                }
            }
        }
        assert!(worst <= f64::EPSILON, "{worst}");
        eprintln!("absorption: 12003 optical depths from 1e-33 to 4e11, sum off by at most {worst:.1e}");
    }

    #[test]
    fn transmittances_multiply() {
        for (first, second) in [(0.1, 0.7), (1e-9, 3.0), (20.0, 30.0)] {
            let parts = transmittance(1.7, first) * transmittance(1.7, second);
            assert!((parts / transmittance(1.7, first + second) - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn infinite_paths() {
        assert_eq!([transmittance(0.0, f64::INFINITY), transmittance(1e-9, f64::INFINITY)], [1.0, 0.0]);
        assert_eq!([absorbed(0.0, f64::INFINITY), absorbed(1e-9, f64::INFINITY)], [0.0, 1.0]);
    }
}
