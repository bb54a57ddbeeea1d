//! Wavelengths: how they are sampled, and what a path of one wavelength is worth in red, green and blue.

use std::sync::LazyLock;

use crate::each::Each;

/// The shortest and the longest wavelength of a path, in nm.
pub const SPECTRUM: [u32; 2] = [380, 780];

/// The number of intervals of 1 nm, in each of which the colour is taken to be that of its middle.
const INTERVALS: usize = (SPECTRUM[1] - SPECTRUM[0]) as usize;

/// A peak of one height, by its wavelength, that is a Gaussian of one width to the left and of another to the right.
fn peak(wavelength: f64, [height, middle, left, right]: [f64; 4]) -> f64 {
    let off = (wavelength - middle) / if wavelength < middle { left } else { right };
    height * libm::exp(-0.5 * off * off)
}

// ANCHOR: colour_matching
/// The colour-matching functions x̄, ȳ and z̄ of the CIE 1931 standard observer (2°) at a wavelength in nm, as sums of
/// Gaussian peaks (Wyman, Sloan and Shirley 2013, their equation 4).
pub fn colour_matching(wavelength: f64) -> [f64; 3] {
    let sum = |peaks: &[[f64; 4]]| peaks.iter().map(|&own| peak(wavelength, own)).sum();
    [
        sum(&[[1.056, 599.8, 37.9, 31.0], [0.362, 442.0, 16.0, 26.7], [-0.065, 501.1, 20.4, 26.2]]),
        sum(&[[0.821, 568.8, 46.9, 40.5], [0.286, 530.9, 16.3, 31.1]]),
        sum(&[[1.217, 437.0, 11.8, 36.0], [0.681, 459.0, 26.0, 13.8]]),
    ]
}
// ANCHOR_END: colour_matching

/// Linear Rec. 709 from CIE XYZ (IEC 61966-2-1).
const RGB_FROM_XYZ: [[f64; 3]; 3] = [
    [3.240_969_9, -1.537_383_2, -0.498_610_8],
    [-0.969_243_6, 1.875_967_5, 0.041_555_1],
    [0.055_630_1, -0.203_977, 1.056_971_5],
];

/// The colour of monochromatic light in linear Rec. 709; outside the triangle of its primaries, as all spectral colours
/// are, at least one component is negative.
fn rgb_of(wavelength: f64) -> [f64; 3] {
    let xyz = colour_matching(wavelength);
    RGB_FROM_XYZ.each(|row| (0..3).map(|part| row[part] * xyz[part]).sum())
}

/// The spectrum by intervals of 1 nm.
pub struct Spectrum {
    /// What each interval adds to white: red, green, blue, which sum up to 1 each.
    share: Vec<[f64; 3]>,
    /// The probability that a wavelength is below the end of an interval.
    below: Vec<f64>,
    /// The sum of all shares, signs and channels apart.
    size: f64,
}

fn size([r, g, b]: [f64; 3]) -> f64 {
    r.abs() + g.abs() + b.abs()
}

// ANCHOR: spectrum
/// Each channel is divided by its own integral, so that light which keeps its spectrum keeps its colour.
/// Wavelengths are sampled in proportion to what they add to all channels together, signs apart.
static TABLE: LazyLock<Spectrum> = LazyLock::new(|| {
    let middle = |interval: usize| f64::from(SPECTRUM[0]) + interval as f64 + 0.5;
    let colours: Vec<[f64; 3]> = (0..INTERVALS).map(|interval| rgb_of(middle(interval))).collect();
    let whole = [0, 1, 2].each(|channel| colours.iter().map(|rgb| rgb[channel]).sum::<f64>());
    let share: Vec<_> = colours.iter().map(|rgb| [0, 1, 2].each(|channel| rgb[channel] / whole[channel])).collect();
    let all: f64 = share.iter().copied().map(size).sum();
    let mut sum = 0.0;
    let below = share.iter().map(|&own| {
        sum += size(own) / all;
        sum
    });
    Spectrum { below: below.collect(), size: all, share }
});

impl Spectrum {
    /// The one that all paths sample.
    pub fn get() -> &'static Self {
        &TABLE
    }

    /// A wavelength in nm by a number in [0, 1), and its weight: for each channel what the nanometre around it adds to
    /// white, over the probability of that nanometre.
    ///
    /// The mean of the weights of all wavelengths is 1 in each channel; the weight of one of them may be negative.
    pub fn sample(&self, number: f64) -> (f64, [f64; 3]) {
        let interval = self.below.partition_point(|&below| below <= number).min(INTERVALS - 1);
        let from = if interval == 0 { 0.0 } else { self.below[interval - 1] };
        let within = ((number - from) / (self.below[interval] - from)).clamp(0.0, 1.0);
        let (share, probability) = self.at(interval);
        (f64::from(SPECTRUM[0]) + interval as f64 + within, share.each(|part| part / probability))
    }
    // ANCHOR_END: spectrum

    /// What an interval adds to white, and its probability.
    fn at(&self, interval: usize) -> ([f64; 3], f64) {
        let share = self.share[interval];
        (share, size(share) / self.size)
    }

    /// What the nanometre around a wavelength adds to white, red, green and blue, and its probability.
    pub fn white_share(&self, wavelength: f64) -> ([f64; 3], f64) {
        let interval = (wavelength - f64::from(SPECTRUM[0])).clamp(0.0, INTERVALS as f64 - 1.0);
        self.at(interval as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table of CIE 15:2004 (T.4) from 380 to 780 nm in steps of 5 nm, as cvrl.org's `ciexyz31` prints it, has the sums
    /// 106.858, 106.857 and 106.858, times 5 nm; the peaks of the fit have integrals in closed form, √(π/2) · height · (left
    /// + right).
    #[test]
    fn colour_matching_functions_have_the_integrals_of_the_tables() {
        const TABULATED: [f64; 3] = [106.858, 106.857, 106.858];
        const STEPS: usize = 800_000;
        let step = 800.0 / STEPS as f64;
        let mut sums = [0.0; 3];
        for own in 0..STEPS {
            let xyz = colour_matching(200.0 + (own as f64 + 0.5) * step);
            (0..3).for_each(|part| sums[part] += xyz[part] * step);
        }
        let closed = [
            1.056 * (37.9 + 31.0) + 0.362 * (16.0 + 26.7) - 0.065 * (20.4 + 26.2),
            0.821 * (46.9 + 40.5) + 0.286 * (16.3 + 31.1),
            1.217 * (11.8 + 36.0) + 0.681 * (26.0 + 13.8),
        ]
        .map(|sum| sum * std::f64::consts::FRAC_PI_2.sqrt());
        eprintln!("colour matching: integrals {sums:?}");
        for part in 0..3 {
            assert!((sums[part] / closed[part] - 1.0).abs() < 1e-9, "{part}: {} and {}", sums[part], closed[part]);
            assert!((sums[part] / TABULATED[part] - 1.0).abs() < 1e-3, "{part}: {}", sums[part]);
        }
    }

    /// Rows of the same table, which the fit misses by at most 0.024, at 425 nm.
    #[test]
    fn colour_matching_functions_are_near_the_table() {
        let rows = [
            (425.0, [0.2148, 0.0073, 1.0391]),
            (440.0, [0.3483, 0.0230, 1.7471]),
            (480.0, [0.0956, 0.1390, 0.8130]),
            (520.0, [0.0633, 0.7100, 0.0782]),
            (555.0, [0.5121, 1.0000, 0.0057]),
            (600.0, [1.0622, 0.6310, 0.0008]),
            (650.0, [0.2835, 0.1070, 0.0000]),
        ];
        let mut worst = 0.0_f64;
        for (wavelength, listed) in rows {
            let own = colour_matching(wavelength);
            (0..3).for_each(|part| worst = worst.max((own[part] - listed[part]).abs()));
        }
        assert!(worst < 0.025, "{worst}");
        eprintln!("colour matching: {} rows of the table, off by at most {worst:.3}", rows.len());
    }

    /// The mean weight is 1 in each channel, exactly: strata of the unit interval that no interval of 1 nm crosses.
    #[test]
    fn white_in_is_white_out() {
        let table = Spectrum::get();
        let mut mean = [0.0; 3];
        for interval in 0..INTERVALS {
            let probability = table.below[interval] - if interval == 0 { 0.0 } else { table.below[interval - 1] };
            let (wavelength, weight) = Spectrum::get().sample(table.below[interval] - 0.5 * probability);
            assert_eq!(wavelength.floor(), f64::from(SPECTRUM[0]) + interval as f64);
            (0..3).for_each(|channel| mean[channel] += probability * weight[channel]);
        }
        assert!(mean.iter().all(|own| (own - 1.0).abs() < 1e-13), "{mean:?}");
        let negative = |channel: usize| table.share.iter().filter(|share| share[channel] < 0.0).count();
        assert!((0..3).all(|channel| negative(channel) > 10), "spectral colours are out of the gamut");
    }

    /// Numbers map to wavelengths that ascend from end to end, and each number's weight is that of its wavelength.
    #[test]
    fn wavelengths_ascend_over_the_whole_spectrum() {
        let mut last = f64::from(SPECTRUM[0]);
        for own in 0..100_000 {
            let (wavelength, weight) = Spectrum::get().sample(f64::from(own) / 1e5);
            assert!(wavelength >= last && wavelength <= f64::from(SPECTRUM[1]), "{wavelength} after {last}");
            assert!(weight.iter().all(|part| part.is_finite()) && weight != [0.0; 3]);
            last = wavelength;
        }
        assert_eq!(Spectrum::get().sample(0.0).0, f64::from(SPECTRUM[0]));
        assert!(Spectrum::get().sample(1.0 - f64::EPSILON).0 > f64::from(SPECTRUM[1]) - 1.0);
    }

    /// The variance of a channel's weight, summed over the channels, beside that of wavelengths sampled uniformly.
    #[test]
    fn sampling_by_size_varies_less_than_uniform_sampling() {
        let (mut by_size, mut uniform) = ([0.0; 3], [0.0; 3]);
        for interval in 0..INTERVALS {
            let (share, probability) = Spectrum::get().at(interval);
            for channel in 0..3 {
                by_size[channel] += share[channel] * share[channel] / probability;
                uniform[channel] += share[channel] * share[channel] * INTERVALS as f64;
            }
        }
        let total = |squares: [f64; 3]| squares.iter().map(|square| square - 1.0).sum::<f64>();
        eprintln!("wavelengths: variance {by_size:.3?} − 1 by size, {uniform:.3?} − 1 uniformly");
        assert!(total(by_size) < total(uniform), "{by_size:?}, {uniform:?}");
    }
}
