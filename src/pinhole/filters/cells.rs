/// The area under |f| from the pixel's centre to one side, divided into cells.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilterCells {
    /// For equal steps of the area, the first cell that ends beyond the step.
    pub first: Vec<u16>,
    /// The cells, from the centre outwards.
    pub cells: Vec<Span>,
}

/// A cell of a filter's table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// The area before it, as a fraction of the whole.
    pub start: f64,
    /// The area at its end; that of the last cell is beyond the whole.
    pub end: f64,
    /// The reciprocal of its own area.
    pub per_area: f64,
    /// Where it begins, in pixels from the centre.
    pub x: f64,
    /// Its width, in pixels.
    pub width: f64,
    /// |f| at its beginning, as a fraction of the sum of |f| at both ends: 1/2 where |f| is constant.
    pub slope: f64,
    /// Whether f is negative in it.
    pub negative: bool,
}

/// Samples |f| of a filter f by a table of its CDF on one side of the centre: the offset, and whether f is negative
/// there.
///
/// Within a cell of the table |f| is taken to be linear; its CDF is then a parabola, which is inverted without
/// cancellation.
#[inline(always)]
pub fn table_offset(u: f64, cells: &FilterCells) -> (f64, bool) {
    let side = 2.0 * u - 1.0;
    let area = side.abs();
    let mut at = usize::from(cells.first[(area * (cells.first.len() - 1) as f64) as usize]);
    while cells.cells[at].end <= area {
        at += 1;
    }
    let Span { start, per_area, x, width, slope, negative, .. } = cells.cells[at];
    let fraction = (area - start) * per_area;
    let along = fraction / (slope + (slope * slope + (1.0 - 2.0 * slope) * fraction).sqrt() + f64::MIN_POSITIVE);
    ((x + along * width).copysign(side), negative)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::filters::{Kernel, cells_of, filter_area, filter_value, radius_of, sign_change};
    use crate::sample::{Draw, Independent, PixelKey, Purpose, unit};
    use crate::scene::Filter;
    use std::f64::consts::PI;

    fn filters() -> impl Iterator<Item = Filter> {
        let odd = [
            Filter::Box { radius: 1.7 },
            Filter::Gaussian { radius: 2.0, sigma: 0.25 },
            Filter::Gaussian { radius: 1.0, sigma: 8.0 },
            Filter::Mitchell { radius: 2.0, b: 0.0, c: 0.5 },
            Filter::Mitchell { radius: 3.0, b: 1.0, c: 0.0 },
        ];
        Filter::ALL.map(|(_, filter)| filter).into_iter().chain(odd)
    }

    fn offset(filter: Filter, cells: &FilterCells, u: f64) -> (f64, bool) {
        crate::with_filter!(filter, kernel => kernel.offset(u, cells))
    }

    /// The fraction of the area under |f| that lies between −x and x.
    fn fraction(filter: Filter, x: f64) -> f64 {
        let turn = sign_change(filter);
        let positive = filter_area(filter, turn);
        let beyond = |x: f64| if x > turn { (filter_area(filter, x) - positive).abs() } else { 0.0 };
        (filter_area(filter, x.min(turn)) + beyond(x)) / (positive + beyond(radius_of(filter)))
    }

    /// The offsets of every 997th of the 2²⁴ numbers that there are, against the exact area under |f|.
    #[test]
    fn offsets_invert_the_exact_cdf() {
        let (mut tried, mut worst) = (0, 0.0_f64);
        for filter in filters() {
            let (cells, mut last) = (cells_of(filter), f64::NEG_INFINITY);
            for bits in (0..1_u32 << 24).step_by(997).chain([1, (1 << 23) - 1, 1 << 23, (1 << 24) - 1]) {
                let u = unit(bits << 8);
                let (x, negative) = offset(filter, &cells, u);
                assert!(x.abs() <= radius_of(filter) * (1.0 + 1e-15) && x.is_finite(), "{filter:?} at {u}: {x}");
                worst = worst.max((fraction(filter, x.abs()) - (2.0 * u - 1.0).abs()).abs());
                let value = filter_value(filter, x.abs());
                assert!(value.abs() < 1e-9 || negative == (value < 0.0), "{filter:?} at {x}: {value:e}");
                assert!(x >= last || bits % 997 != 0, "{filter:?} is not monotone at {u}");
                (last, tried) = (x, tried + 1);
            }
        }
        eprintln!("filters: {tried} offsets, the CDF at each off by {worst:.1e} at most");
        assert!(worst < 1e-6, "off by {worst:e}");
    }

    /// Kolmogorov–Smirnov: samples of each filter against its exact CDF, below the limit with probability 1 − 1e-4.
    #[test]
    fn samples_are_distributed_as_the_filter() {
        const SAMPLES: u32 = 100_000;
        for (axis, filter) in filters().flat_map(|filter| [(0, filter), (1, filter)]) {
            let cells = cells_of(filter);
            let place = |number: u32| {
                let key = PixelKey::new(3, [number % 1000, number / 1000]);
                offset(filter, &cells, unit(Independent::new(0, 0, Purpose::Pixel).two(key)[axis])).0
            };
            let mut places: Vec<f64> = (0..SAMPLES).map(place).collect();
            places.sort_by(f64::total_cmp);
            let before = |x: f64| 0.5 + 0.5 * fraction(filter, x.abs()).copysign(x);
            let n = f64::from(SAMPLES);
            let apart = (0..).zip(&places).map(|(rank, &x)| (before(x) - (f64::from(rank) + 0.5) / n).abs());
            let statistic = apart.fold(0.0, f64::max) * n.sqrt();
            assert!(statistic < 2.23, "{filter:?}, axis {axis}: {statistic}");
        }
        eprintln!("filters: {SAMPLES} samples of 10 filters on two axes, all distributed as their filters");
    }

    /// The integral of f(x) h(x) over that of f, by quadrature on each side of where f changes sign.
    fn convolved(filter: Filter, h: impl Fn(f64) -> f64, kink: f64) -> f64 {
        let (radius, turn) = (radius_of(filter), sign_change(filter));
        let mut ends = [-radius, -turn, -radius / 2.0, 0.0, radius / 2.0, turn, radius, kink.clamp(-radius, radius)];
        ends.sort_by(f64::total_cmp);
        let mut sum = 0.0;
        for pair in ends.windows(2) {
            const STEPS: u32 = 2000;
            let width = (pair[1] - pair[0]) / f64::from(STEPS);
            for step in 0..STEPS {
                // The midpoints of thirds, so that a kink at an end falls on the right side.
                for third in [1.0, 3.0, 5.0] {
                    let x = pair[0] + (f64::from(step) + third / 6.0) * width;
                    let weight = if third == 3.0 { 2.0 } else { 3.0 };
                    sum += width * weight / 8.0 * filter_value(filter, x.abs()) * h(x);
                }
            }
        }
        sum / (2.0 * filter_area(filter, radius))
    }

    /// The mean of signed samples of three steps and two waves against the convolution, within 4 standard errors; for
    /// box and tent also against sinc and sinc².
    #[test]
    fn signed_samples_estimate_the_convolution() {
        const SAMPLES: u32 = 40_000;
        let mut tried = 0;
        for filter in filters() {
            let cells = cells_of(filter);
            let step = |edge: f64| move |x: f64| if x < edge { 1.0 } else { 0.0 };
            let wave = |frequency: f64| move |x: f64| libm::cos(2.0 * PI * frequency * x);
            let functions: [(Box<dyn Fn(f64) -> f64>, f64); 5] = [
                (Box::new(step(0.0)), 0.0),
                (Box::new(step(0.3)), 0.3),
                (Box::new(step(-1.2)), -1.2),
                (Box::new(wave(0.25)), 0.0),
                (Box::new(wave(0.8)), 0.0),
            ];
            for (which, (function, kink)) in functions.iter().enumerate() {
                let truth = convolved(filter, function, *kink);
                if let (Filter::Box { radius } | Filter::Tent { radius }, 3..) = (filter, which) {
                    let tent = matches!(filter, Filter::Tent { .. });
                    let frequency = if which == 3 { 0.25 } else { 0.8 };
                    let t = if tent { PI * frequency * radius } else { 2.0 * PI * frequency * radius };
                    let sinc = libm::sin(t) / t;
                    let closed = if tent { sinc * sinc } else { sinc };
                    assert!((truth - closed).abs() < 1e-6, "{filter:?}: {truth} by steps, {closed} by the formula");
                }
                // The ratio of the means of sign × h and of sign, with the variance of a ratio to first order.
                let samples: Vec<[f64; 2]> = (0..SAMPLES)
                    .map(|number| {
                        let key = PixelKey::new(which as u64, [number, 0]);
                        let u = unit(Independent::new(0, 0, Purpose::Pixel).two(key)[0]);
                        let (x, negative) = offset(filter, &cells, u);
                        let sign = if negative { -1.0 } else { 1.0 };
                        [sign * function(x), sign]
                    })
                    .collect();
                let n = f64::from(SAMPLES);
                let [top, bottom] = [0, 1].map(|i| samples.iter().map(|s| s[i]).sum::<f64>() / n);
                let ratio = top / bottom;
                let off = |s: &[f64; 2]| s[0] - ratio * s[1];
                let spread = samples.iter().map(|s| off(s) * off(s)).sum::<f64>() / n;
                let error = (spread / n).sqrt() / bottom.abs();
                assert!(
                    (ratio - truth).abs() <= 4.0 * error + 1e-6,
                    "{filter:?}, function {which}: {ratio} for {truth}"
                );
                tried += 1;
            }
        }
        eprintln!(
            "filters: {tried} convolutions estimated by {SAMPLES} signed samples each, all within 4 standard errors"
        );
    }
}
