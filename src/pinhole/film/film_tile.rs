use super::develop::shown;
use crate::plan::{Column, ColumnComponent, ComponentValues, Lifetime, column_component};
use crate::rays::Tile;

/// The number of steps in which a render takes the first sample: for every eighth, fourth, second, and finally every
/// pixel.
pub const FIRST_SAMPLE_STEPS: u32 = 4;

/// A sample that was not added to the film, because a component was negative or not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rejected {
    /// The pixel, from the left and from the top of the image.
    pub pixel: [u32; 2],
    /// The sample's index within the pixel.
    pub sample: u32,
    /// The offending radiance.
    pub radiance: [f32; 3],
}

impl Rejected {
    /// How many of them a tile keeps; all are counted.
    pub const MAX: usize = 4;

    /// The order in which they are reported: by sample, then line by line from the top.
    pub(super) fn place(&self) -> [u32; 3] {
        [self.sample, self.pixel[1], self.pixel[0]]
    }
}

/// The film of one tile: sums in f64 and counts of samples, with a row per pixel.
///
/// All samples are summed; those of negative filter weight are also summed separately, so that both the weighted and
/// the unweighted mean can be computed; a tile without any allocates nothing for them.
/// Samples are added in order, so neither the number of threads nor the tile size changes a bit of the sums.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilmTile {
    /// The pixels that it covers.
    pub tile: Tile,
    /// Sum of red radiance.
    pub r: Vec<f64>,
    /// Sum of green radiance.
    pub g: Vec<f64>,
    /// Sum of blue radiance.
    pub b: Vec<f64>,
    /// Number of samples summed.
    pub count: Vec<u32>,
    /// Sums of the red, green and blue radiance of samples on a negative lobe of the filter; empty before the first.
    pub negative: [Vec<f64>; 3],
    /// Number of samples on a negative lobe; empty before the first.
    pub negative_count: Vec<u32>,
    /// Number of samples rejected.
    pub rejected: u64,
    /// The first of the rejected samples.
    pub first_rejected: Vec<Rejected>,
}

impl FilmTile {
    /// An empty film of a tile.
    pub fn new(tile: Tile) -> Self {
        let rows = tile.rows();
        let zeros = || vec![0.0; rows];
        Self { tile, r: zeros(), g: zeros(), b: zeros(), count: vec![0; rows], ..Self::default() }
    }

    /// Takes all samples away, and keeps the memory.
    pub(super) fn empty(&mut self) {
        for sums in [&mut self.r, &mut self.g, &mut self.b] {
            sums.fill(0.0);
        }
        self.count.fill(0);
        self.negative.iter_mut().for_each(Vec::clear);
        self.negative_count.clear();
        self.rejected = 0;
        self.first_rejected.clear();
    }

    /// Whether a sample is valid: all components are finite and not negative.
    #[inline(always)]
    pub fn accepts(radiance: [f32; 3]) -> bool {
        let [r, g, b] = radiance.map(|value| (value >= 0.0) & (value < f32::INFINITY));
        r & g & b
    }

    /// Adds a sample to a row, or rejects it if a component is negative or not finite.
    #[inline(always)]
    pub fn add(&mut self, row: usize, radiance: [f32; 3]) {
        if Self::accepts(radiance) {
            self.r[row] += f64::from(radiance[0]);
            self.g[row] += f64::from(radiance[1]);
            self.b[row] += f64::from(radiance[2]);
            self.count[row] += 1;
        } else {
            self.reject(row, radiance);
        }
    }

    /// Adds a sample to each row, component by component; there may be fewer samples than rows.
    pub fn add_rows(&mut self, r: &[f32], g: &[f32], b: &[f32]) {
        let samples = r.iter().zip(g).zip(b).map(|((&r, &g), &b)| [r, g, b]);
        if samples.clone().fold(true, |all, sample| all & Self::accepts(sample)) {
            for (sums, parts) in [(&mut self.r, r), (&mut self.g, g), (&mut self.b, b)] {
                sums.iter_mut().zip(parts).for_each(|(sum, &part)| *sum += f64::from(part));
            }
            self.count.iter_mut().zip(r).for_each(|(count, _)| *count += 1);
        } else {
            (0..self.rows()).zip(samples).for_each(|(row, sample)| self.add(row, sample));
        }
    }

    /// Keeps those that come first by sample and then by pixel, whatever the order in which they are traced.
    #[cold]
    fn reject(&mut self, row: usize, radiance: [f32; 3]) {
        self.rejected += 1;
        let rejected = Rejected { pixel: self.tile.pixel_of(row), sample: self.count[row], radiance };
        let at = self.first_rejected.partition_point(|earlier| earlier.place() <= rejected.place());
        self.first_rejected.insert(at, rejected);
        self.first_rejected.truncate(Rejected::MAX);
    }

    /// Adds a sample of negative filter weight, or rejects it.
    #[inline(never)]
    pub fn add_negative(&mut self, row: usize, radiance: [f32; 3]) {
        self.add(row, radiance);
        if Self::accepts(radiance) {
            let rows = self.rows();
            self.negative_count.resize(rows, 0);
            self.negative_count[row] += 1;
            for (sums, value) in self.negative.iter_mut().zip(radiance) {
                sums.resize(rows, 0.0);
                sums[row] += f64::from(value);
            }
        }
    }

    /// The radiance of a row as a picture shows it: the mean of its samples, weighted by the filter; black if there are
    /// none.
    ///
    /// If the sum of weights is not positive, which may happen after a few samples of a filter with negative lobes, it
    /// is the unweighted mean.
    /// Negative values, where such a filter rings, become 0.
    pub fn mean(&self, row: usize) -> [f32; 3] {
        self.shown_f64(row).map(shown)
    }

    /// The same, unrounded, and negative where a filter rings.
    #[inline(always)]
    pub fn shown_f64(&self, row: usize) -> [f64; 3] {
        self.weighted(row).unwrap_or_else(|| self.mean_f64(row))
    }

    /// The sum of a row's filter weights, which are 1 or −1.
    pub fn weight(&self, row: usize) -> i64 {
        let negative = self.negative_count.get(row).copied().unwrap_or(0);
        i64::from(self.count[row]) - 2 * i64::from(negative)
    }

    /// The weighted mean of a row, which may be negative; `None` if the sum of weights is not positive.
    pub fn weighted(&self, row: usize) -> Option<[f64; 3]> {
        let weight = self.weight(row);
        if weight <= 0 {
            return None;
        }
        Some(self.weighted_sums(row).map(|sum| sum / weight as f64))
    }

    /// The weighted sums of a row.
    pub fn weighted_sums(&self, row: usize) -> [f64; 3] {
        let negative = |channel: usize| self.negative[channel].get(row).copied().unwrap_or(0.0);
        [self.r[row] - 2.0 * negative(0), self.g[row] - 2.0 * negative(1), self.b[row] - 2.0 * negative(2)]
    }

    /// The unweighted mean of a row's samples, unrounded.
    #[inline(always)]
    pub fn mean_f64(&self, row: usize) -> [f64; 3] {
        let count = f64::from(self.count[row].max(1));
        [self.r[row] / count, self.g[row] / count, self.b[row] / count]
    }

    /// All components of sums, for checkpoints.
    pub fn sums(&self) -> [&Vec<f64>; 3] {
        [&self.r, &self.g, &self.b]
    }

    /// All components of sums, to be filled from a checkpoint.
    pub fn sums_mut(&mut self) -> [&mut Vec<f64>; 3] {
        [&mut self.r, &mut self.g, &mut self.b]
    }
}

column_component!(FilmTile);

impl Column for FilmTile {
    const NAME: &'static str = "pixel";
    const SPACE: &'static str = "film";
    const UNIT: &'static str = "summed linear Rec. 709";
    const LIFETIME: Lifetime = Lifetime::Film;

    fn rows(&self) -> usize {
        self.count.len()
    }

    fn components(&self) -> Vec<ColumnComponent<'_>> {
        let mut components = vec![
            ColumnComponent { name: "r", values: ComponentValues::F64(&self.r) },
            ColumnComponent { name: "g", values: ComponentValues::F64(&self.g) },
            ColumnComponent { name: "b", values: ComponentValues::F64(&self.b) },
            ColumnComponent { name: "count", values: ComponentValues::U32(&self.count) },
        ];
        if !self.negative_count.is_empty() {
            let names = ["negative_r", "negative_g", "negative_b"];
            let sums = names.into_iter().zip(&self.negative);
            components.extend(sums.map(|(name, sums)| ColumnComponent { name, values: ComponentValues::F64(sums) }));
            components
                .push(ColumnComponent { name: "negative_count", values: ComponentValues::U32(&self.negative_count) });
        }
        components
    }

    fn paint(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.mean(row)
    }
}
