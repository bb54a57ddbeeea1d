use crate::sample::{NO_PLACES, series};
use std::f64::consts::{LN_2, LOG2_E};

/// The bits of √½, of 1, and how far the exponent is shifted in a number's bits.
const ROOT_OF_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
const BIAS: u64 = 1023;
const SHIFT: u32 = 52;

/// ln 2, as a number whose products with whole numbers up to 2¹¹ are exact, and the rest.
const LN_2_IN_TWO: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];

/// Below this power of e the result is 0.
const LEAST: f64 = -708.0;

/// Coefficients of the series of artanh s / s in powers of s², and of eˣ in powers of x: 1, 1/3, 1/5, … and 1/0!, 1/1!, ….
const ARTANH: [f64; 11] = {
    let mut all = [1.0; 11];
    let mut place = 1;
    while place < all.len() {
        all[place] = 1.0 / (2 * place + 1) as f64;
        place += 1;
    }
    all
};
const EXPONENTIAL: [f64; 14] = series([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13]);

/// The sum of a series, its even and its odd powers apart, so that the two are computed side by side (Estrin).
#[inline(always)]
fn sum<const N: usize>(series: &[f64; N], x: f64) -> f64 {
    let (xx, mut sums) = (x * x, [0.0; 2]);
    for place in (0..N).rev() {
        sums[place % 2] = sums[place % 2] * xx + series[place];
    }
    sums[0] + x * sums[1]
}

// ANCHOR: power_of_cosine
/// cⁿ for a cosine above 0 and up to 1, and n ≥ 0: within 4 · 10⁻¹⁵ of it where it is above 10⁻³, within 4 · 10⁻¹³ where it
/// is above 10⁻³⁰⁰, and 0 below 10⁻³⁰⁷.
///
/// cⁿ = exp(n ln c), and c = 2ᵏm with m from √½ to √2, so that ln c = k ln 2 + 2 artanh((m − 1) / (m + 1)); that has the
/// relative accuracy near 1 which a large power asks for.
/// eʸ = 2ʲeʳ, where r is at most ½ ln 2.
/// There is no branch and no table, so that rows are computed side by side, with the same bits on every machine; cosines
/// below 2⁻¹⁰²² count as that.
#[inline(always)]
pub fn power_of_cosine(cosine: f64, exponent: f64) -> f64 {
    let bits = cosine.max(f64::MIN_POSITIVE).to_bits();
    let biased = (bits + (BIAS << SHIFT) - ROOT_OF_HALF) >> SHIFT;
    let k = f64::from_bits(NO_PLACES.to_bits() + biased) - (NO_PLACES + BIAS as f64);
    let m = f64::from_bits(bits + (BIAS << SHIFT) - (biased << SHIFT));
    let s = (m - 1.0) / (m + 1.0);
    let y = exponent * (k * LN_2 + 2.0 * s * sum(&ARTANH, s * s));

    let held = y.max(LEAST);
    let shifted = held * LOG2_E + NO_PLACES;
    let j = shifted - NO_PLACES;
    let r = held - j * LN_2_IN_TWO[0] - j * LN_2_IN_TWO[1];
    let two_to_j = f64::from_bits((shifted.to_bits().wrapping_add(BIAS)) << SHIFT);
    if y < LEAST { 0.0 } else { sum(&EXPONENTIAL, r) * two_to_j }
}
// ANCHOR_END: power_of_cosine

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;

    /// The errors that are stated, against a library's powers, which are right within a rounding; cosines of every size,
    /// and so near to 1 that only a large power differs from it.
    #[test]
    fn powers_are_as_exact_as_is_said() {
        const TRIED: u64 = 200_000;
        let mut worst = [0.0_f64; 2];
        for index in 0..TRIED {
            let mut draws = Draws::new(2811, index);
            let cosine = match index % 4 {
                0 => draws.between(1e-300, 1.0),
                1 => 1.0 - draws.power_of_ten(-16.0, 0.0),
                2 => draws.power_of_ten(-300.0, 0.0),
                _ => 1.0 - draws.power_of_ten(-12.0, -6.0),
            };
            let exponent = draws.power_of_ten(-2.0, 9.0);
            let exponent = if index % 3 == 0 { exponent.floor() } else { exponent };
            let (own, known) = (power_of_cosine(cosine, exponent), libm::pow(cosine, exponent));
            if known < 1e-300 {
                assert!((0.0..1e-299).contains(&own), "{cosine}^{exponent}: {own}");
            } else {
                let of = &mut worst[usize::from(known < 1e-3)];
                *of = of.max((own / known - 1.0).abs());
            }
        }
        eprintln!("powers of cosines: {TRIED}, errors of at most {worst:?}");
        assert!(worst[0] < 4e-15 && worst[1] < 4e-13, "{worst:?}");
        for exponent in [0.0, 1.0, 1e9] {
            assert_eq!(power_of_cosine(1.0, exponent), 1.0);
            assert_eq!(power_of_cosine(f64::MIN_POSITIVE * 0.25, exponent), if exponent == 0.0 { 1.0 } else { 0.0 });
        }
    }
}
