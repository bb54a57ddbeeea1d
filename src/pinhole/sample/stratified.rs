use super::hash::{halves, mixed};
use super::{Draw, PixelKey, Purpose, SampleIndex, unit};

/// The stratified sampler: a stratum of the unit square or interval for each sample, and a jittered point within it.
///
/// Strata are assigned to samples by a permutation that differs between pixels and purposes, so that any number of
/// samples is unbiased and purposes are independent of each other.
/// When all strata have been used, the next block of samples uses them again in another order.
#[derive(Clone, Copy, Debug)]
pub struct Stratified {
    dimension: u32,
    sample: u32,
    strata: [u32; 2],
}

impl Stratified {
    /// A sample's numbers for a purpose at a bounce, with strata for `samples` samples.
    #[inline(always)]
    pub fn new(sample: u32, samples: u32, depth: u32, purpose: Purpose) -> Self {
        let strata = if purpose.numbers() == 2 { strata_of(samples) } else { [samples, 1] };
        Self { dimension: purpose.dimension(depth), sample, strata }
    }

    /// The stratum of this sample, and 64 random bits.
    #[inline(always)]
    fn stratum(self, pixel: PixelKey) -> (u32, u64) {
        let cells = self.strata[0] * self.strata[1];
        let (block, within) = (self.sample / cells, self.sample % cells);
        // The top bit distinguishes keys of blocks from those of samples.
        let order = pixel.bits(self.dimension | 1 << 31, block);
        (permuted(within, cells, order), pixel.bits(self.dimension, self.sample))
    }
}

impl Draw for Stratified {
    #[inline(always)]
    fn of(sample: SampleIndex, purpose: Purpose) -> Self {
        Self::new(sample.number, sample.samples, sample.depth, purpose)
    }

    #[inline(always)]
    fn one(self, pixel: PixelKey) -> u32 {
        let (cell, bits) = self.stratum(pixel);
        within(cell, self.strata[0] * self.strata[1], halves(bits)[0])
    }

    #[inline(always)]
    fn two(self, pixel: PixelKey) -> [u32; 2] {
        let [columns, lines] = self.strata;
        let (cell, bits) = self.stratum(pixel);
        let [right, down] = halves(bits);
        [within(cell % columns, columns, right), within(cell / columns, lines, down)]
    }
}

/// The 32-bit fraction of a jittered point within one of so many cells of the unit interval.
///
/// The edge of a cell, unless it is a multiple of 2⁻²⁴, is off by less than that.
#[inline(always)]
fn within(cell: u32, cells: u32, bits: u32) -> u32 {
    // The largest fraction may round to 2³², which the cast saturates.
    ((f64::from(cell) + unit(bits)) / f64::from(cells) * 4_294_967_296.0) as u32
}

// ANCHOR: strata_of
/// The columns and lines of a grid of at least so many strata, as close to a square as possible; a few strata may be
/// left over.
#[inline(always)]
pub fn strata_of(samples: u32) -> [u32; 2] {
    let columns = f64::from(samples).sqrt() as u32;
    [columns, samples.div_ceil(columns)]
}
// ANCHOR_END: strata_of

/// The image of a number below `count` under a random permutation that the key determines.
///
/// The rounds permute all numbers of that many bits; a result beyond the count is permuted again, which is cycle
/// walking (Black and Rogaway 2002), as in Kensler (2013).
/// The shift of each round is random too: with fixed shifts only few permutations of a small number of strata occur,
/// which a test of pairs detects.
#[inline(always)]
pub fn permuted(number: u32, count: u32, key: u64) -> u32 {
    const ROUNDS: u32 = 6;
    let bits = 32 - (count - 1).leading_zeros();
    if bits == 0 {
        return 0;
    }
    let mask = u32::MAX >> (32 - bits);
    let mut at = number;
    loop {
        let mut state = key;
        for _ in 0..ROUNDS {
            state = mixed(state);
            let [factor, flips] = halves(state);
            at = ((at ^ flips) & mask).wrapping_mul(factor | 1) & mask;
            at ^= at >> (1 + (((factor >> 16) * bits) >> 16)).min(31);
        }
        if at < count {
            break;
        }
    }
    let [rotation, _] = halves(mixed(!key));
    ((u64::from(at) + u64::from(rotation)) % u64::from(count)) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn permutations_are_bijective() {
        let mut tried = 0;
        for count in (1..=130).chain([255, 256, 257, 1000, 4096]) {
            for key in 0..8 {
                let mut taken = vec![false; count as usize];
                for number in 0..count {
                    let place = &mut taken[permuted(number, count, mixed(key)) as usize];
                    assert!(!*place, "two of {count} in one place");
                    *place = true;
                }
                tried += 1;
            }
        }
        eprintln!("permutations: {tried}, each number once in each");
    }

    /// Over all keys, two numbers are mapped to each pair of numbers equally often (χ² within 5 standard deviations).
    #[test]
    fn pairs_are_uniform() {
        const KEYS: u64 = 20_000;
        let mut worst = 0.0_f64;
        for count in [2_u32, 3, 4, 5, 8, 9, 16, 17] {
            let pairs = (count * (count - 1)) as usize;
            for other in 1..count {
                let mut times = vec![0_u32; (count * count) as usize];
                for key in 0..KEYS {
                    let [a, b] = [0, other].map(|number| permuted(number, count, mixed(key)));
                    times[(a * count + b) as usize] += 1;
                }
                let expected = KEYS as f64 / pairs as f64;
                let occurring = (0..count * count).filter(|pair| pair / count != pair % count);
                let off = |pair: u32| f64::from(times[pair as usize]) - expected;
                let square = |pair: u32| off(pair) * off(pair) / expected;
                let freedom = (pairs - 1) as f64;
                let chi = occurring.map(square).sum::<f64>();
                worst = worst.max((chi - freedom) / (2.0 * freedom).sqrt());
            }
        }
        eprintln!(
            "permutations: pairs of 8 counts × {KEYS} keys, worst χ² {worst:.2} standard deviations above its mean"
        );
        assert!(worst < 5.0);
    }

    /// Each block of samples has one in every stratum, even if their number is not a square.
    #[test]
    fn one_sample_per_stratum() {
        let mut tried = 0;
        for samples in [1_u32, 2, 3, 4, 7, 9, 12, 16, 64, 100] {
            let [columns, lines] = strata_of(samples);
            let cells = columns * lines;
            assert!(cells >= samples && cells - samples < columns, "{columns} × {lines} for {samples}");
            for block in 0..3 {
                let mut taken = vec![0_u32; cells as usize];
                for sample in block * cells..(block + 1) * cells {
                    let draw = Stratified::new(sample, samples, 0, Purpose::Pixel);
                    let [x, y] = draw.two(PixelKey::new(5, [3, 4])).map(unit);
                    // A small step forward, because a stratum's edge may be off by as much.
                    let cell = |u: f64, cells: u32| ((u + 1.0 / f64::from(1 << 25)) * f64::from(cells)) as u32;
                    taken[(cell(y, lines) * columns + cell(x, columns)) as usize] += 1;
                    tried += 1;
                }
                assert!(taken.iter().all(|&count| count == 1), "{samples} samples, block {block}: {taken:?}");
            }
        }
        eprintln!("strata: {tried} samples, one in every cell of every block");
    }
}
