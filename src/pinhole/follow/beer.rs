// ANCHOR: transmittance
/// The share of light left after a way of this length: e^(−σt), σ the absorption (Beer's law).
#[inline(always)]
pub fn transmittance(absorption: f64, length: f64) -> f64 {
    // A way without end in clear glass is 0 · ∞.
    if absorption > 0.0 { libm::exp(-absorption * length) } else { 1.0 }
}

/// The share of light that is absorbed on the way: 1 − e^(−σt), with all its digits where it is little.
#[inline(always)]
pub fn absorbed(absorption: f64, length: f64) -> f64 {
    if absorption > 0.0 { -libm::expm1(-absorption * length) } else { 0.0 }
}
// ANCHOR_END: transmittance

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn absorbed_and_left_are_all() {
        let mut worst = 0.0_f64;
        for step in 0..=4000 {
            let thickness = libm::exp10(f64::from(step) / 100.0 - 30.0);
            for absorption in [1e-3, 1.0, 40.0] {
                let (left, gone) = (transmittance(absorption, thickness), absorbed(absorption, thickness));
                assert!((0.0..=1.0).contains(&left) && (0.0..=1.0).contains(&gone));
                worst = worst.max((left + gone - 1.0).abs());
                let depth = absorption * thickness;
                if depth < 1e-4 {
                    // The series, whose next term is below 1e-14 of it.
                    let series = depth * (1.0 - 0.5 * depth * (1.0 - depth / 3.0 * (1.0 - 0.25 * depth)));
                    assert!((gone / series - 1.0).abs() < 1e-15, "{depth}");
                }
            }
        }
        assert!(worst <= f64::EPSILON, "{worst}");
        eprintln!("absorption: 12003 depths from 1e-33 to 4e11, worst {worst:.1e} from all");
    }

    #[test]
    fn ways_multiply() {
        for (first, second) in [(0.1, 0.7), (1e-9, 3.0), (20.0, 30.0)] {
            let parts = transmittance(1.7, first) * transmittance(1.7, second);
            assert!((parts / transmittance(1.7, first + second) - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn ways_without_end() {
        assert_eq!([transmittance(0.0, f64::INFINITY), transmittance(1e-9, f64::INFINITY)], [1.0, 0.0]);
        assert_eq!([absorbed(0.0, f64::INFINITY), absorbed(1e-9, f64::INFINITY)], [0.0, 1.0]);
    }
}
