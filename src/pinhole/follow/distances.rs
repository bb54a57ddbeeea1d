//! How far light goes through participating media before it is scattered.

use crate::each::{Each, all_are};
use crate::extract::{Coefficients, Filled, MediumPlace, MediumTable, NO_ROW, list_around};
use crate::shapes::{l1_norm, stretches_inside};
use glam::DVec3;

/// A part of a ray along which the same media are around it, from one distance to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Where it begins, in scene units from the ray's origin.
    pub from: f64,
    /// Where it ends; infinite for a ray that hits nothing.
    pub to: f64,
    /// The sum of the coefficients of all media there; where their density varies, of the majorant.
    pub sum: Coefficients,
    /// Whether the density of any of them varies.
    pub varies: bool,
    /// The number of the only span there; [`NO_ROW`] where there are several.
    pub only: u32,
}

/// σ · length, which is 0 for an infinite way through nothing.
#[inline(always)]
pub(super) fn depth(coefficient: f64, length: f64) -> f64 {
    if coefficient > 0.0 { coefficient * length } else { 0.0 }
}

impl Stretch {
    /// The coefficients by which distances are sampled: none where nothing scatters, so that a medium which only absorbs
    /// ends no path.
    #[inline(always)]
    pub(super) fn rate(&self) -> [f64; 3] {
        if all_are(self.sum.scattering, 0.0) { [0.0; 3] } else { self.sum.extinction }
    }
}

/// Adds what a stretch contributes to an optical depth, colour by colour.
#[inline(always)]
pub(super) fn add_depth(sum: &mut [f64; 3], coefficients: [f64; 3], length: f64) {
    (0..3).for_each(|part| sum[part] += depth(coefficients[part], length));
}

/// e^(−τ) of each part, once where all are equal.
#[inline(always)]
pub(super) fn transmittances(depths: [f64; 3]) -> [f64; 3] {
    if depths[0] == depths[1] && depths[0] == depths[2] {
        return [libm::exp(-depths[0]); 3];
    }
    depths.each(|depth| libm::exp(-depth))
}

/// The same of the depths by which distances are sampled, and of those of all that takes light away, which differ where
/// something only absorbs.
#[inline(always)]
pub(super) fn both_transmittances(rates: [f64; 3], depths: [f64; 3]) -> [[f64; 3]; 2] {
    let sampled = transmittances(rates);
    [sampled, if rates == depths { sampled } else { transmittances(depths) }]
}

/// The transmittance along all stretches of a ray.
pub fn transmittance_along(stretches: &[Stretch]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    stretches.iter().for_each(|own| add_depth(&mut sum, own.sum.extinction, own.to - own.from));
    transmittances(sum)
}

/// The radiance that the media along a ray emit towards its origin; `absorption` is what else absorbs all along it.
///
/// Along a stretch it is the integral of ε e^(−σs), ε (1 − e^(−σl)) / σ.
pub fn emission_along(stretches: &[Stretch], absorption: [f64; 3]) -> [f64; 3] {
    let (mut sum, mut depths, mut at) = ([0.0; 3], [0.0; 3], 0.0);
    for stretch in stretches {
        let Stretch { from, to, sum: Coefficients { extinction, .. }, .. } = stretch;
        add_depth(&mut depths, absorption, from - at);
        let emitted = emission_between(stretch, absorption);
        for part in 0..3 {
            sum[part] += libm::exp(-depths[part]) * emitted[part];
            depths[part] += depth(extinction[part] + absorption[part], to - from);
        }
        at = *to;
    }
    sum
}

/// What a stretch emits towards its beginning.
#[inline]
pub(super) fn emission_between(stretch: &Stretch, absorption: [f64; 3]) -> [f64; 3] {
    let length = stretch.to - stretch.from;
    [0, 1, 2].each(|part: usize| {
        let extinction = stretch.sum.extinction[part] + absorption[part];
        match stretch.sum.emission[part] {
            0.0 => 0.0,
            emission if extinction > 0.0 => emission / extinction * -libm::expm1(-extinction * length),
            emission => emission * length,
        }
    })
}

/// What becomes of a ray in the media along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampledDistance {
    /// How far it goes before it is scattered; none where it reaches the end of its last stretch.
    pub t: Option<f64>,
    /// The factor of its throughput: transmittance, and the scattering coefficient, over the pdf.
    pub weight: [f64; 3],
}

impl SampledDistance {
    /// That of a ray which carries nothing.
    pub(super) const UNSCATTERED: Self = Self { t: None, weight: [1.0; 3] };
}

/// The colour by which a distance is sampled.
pub(super) struct ChosenColour {
    /// The probability of each colour.
    pub(super) choice: [f64; 3],
    /// The one that was chosen.
    pub(super) colour: usize,
    /// Its optical depth at which light is scattered.
    pub(super) depth: f64,
}

// ANCHOR: sample_distance
impl ChosenColour {
    /// Chooses a colour in proportion to the throughput, and its depth by e^(−τ), both by one number in [0, 1); none for a
    /// ray that carries nothing.
    pub(super) fn of(throughput: [f64; 3], number: f64) -> Option<Self> {
        let carried = throughput.each(f64::abs);
        let sum = carried.iter().sum::<f64>();
        if !(sum > 0.0) {
            return None;
        }
        let choice = carried.each(|part| part / sum);
        let (colour, number) = chosen(choice, number);
        Some(Self { choice, colour, depth: -libm::log1p(-number) })
    }
}

/// Samples the distance at which light is scattered along a ray of this throughput, by a number in [0, 1).
///
/// The depth of a colour is sampled by its own e^(−τ), that colour having been chosen in proportion to its throughput; the
/// sample counts for all three, divided by the mean of their pdfs in that proportion (the balance heuristic).
/// So the weight is at most the sum of the throughputs over that of the sampled colour, however much the colours differ.
/// Of a path with a wavelength a part may be negative, and its size counts.
pub fn sample_distance(stretches: &[Stretch], throughput: [f64; 3], number: f64) -> SampledDistance {
    let Some(ChosenColour { choice, colour, depth: wanted }) = ChosenColour::of(throughput, number) else {
        return SampledDistance::UNSCATTERED;
    };
    let (mut rates, mut depths) = ([0.0; 3], [0.0; 3]);
    for stretch in stretches {
        let (rate, extinction, length) = (stretch.rate(), stretch.sum.extinction, stretch.to - stretch.from);
        let left = wanted - rates[colour];
        if depth(rate[colour], length) > left {
            let reached = left / rate[colour];
            add_depth(&mut rates, rate, reached);
            add_depth(&mut depths, extinction, reached);
            let [sampled, reached_by] = both_transmittances(rates, depths);
            let pdf = (0..3).map(|part| choice[part] * rate[part] * sampled[part]).sum::<f64>();
            let weight = |part: usize| over(choice[part], stretch.sum.scattering[part] * reached_by[part], pdf);
            return SampledDistance { t: Some(stretch.from + reached), weight: [0, 1, 2].each(weight) };
        }
        add_depth(&mut rates, rate, length);
        add_depth(&mut depths, extinction, length);
    }
    let [sampled, reached_by] = both_transmittances(rates, depths);
    let probability = (0..3).map(|part| choice[part] * sampled[part]).sum::<f64>();
    SampledDistance { t: None, weight: [0, 1, 2].each(|part| over(choice[part], reached_by[part], probability)) }
}
// ANCHOR_END: sample_distance

/// A value over its pdf; 0 for a colour that the path does not carry, whose quotient may be no number.
#[inline(always)]
pub(super) fn over(choice: f64, value: f64, pdf: f64) -> f64 {
    if choice > 0.0 && pdf >= f64::MIN_POSITIVE { value / pdf } else { 0.0 }
}

/// Chooses one of three with these probabilities, and what is left of the number, in [0, 1) again.
#[inline(always)]
fn chosen(probabilities: [f64; 3], number: f64) -> (usize, f64) {
    let mut before = 0.0;
    let mut last = (0, 0.0);
    for (place, probability) in probabilities.into_iter().enumerate().filter(|(_, own)| *own > 0.0) {
        last = (place, ((number - before) / probability).clamp(0.0, 1.0 - f64::EPSILON));
        before += probability;
        if number < before {
            break;
        }
    }
    last
}

/// A part of a ray along which it runs through a medium.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub(super) from: f64,
    pub(super) to: f64,
    /// The row of the medium.
    pub(super) medium: usize,
    /// The number of its grid along the ray, where the density varies; [`NO_ROW`] where it does not.
    pub(super) grid: u32,
    /// The greatest density, its majorant.
    pub(super) majorant: f64,
}

/// The media along one ray after another.
#[derive(Debug, Default)]
pub struct MediaAlong {
    pub(super) spans: Vec<Span>,
    /// Those before they were divided into the blocks of grids.
    pub(super) whole: Vec<Span>,
    cuts: Vec<f64>,
    around: Vec<u32>,
    /// The places whose density varies, and the ray in the index space of each.
    pub(super) grids: Vec<(u32, [DVec3; 2])>,
    /// The stretches of the ray, from its origin on; none in a vacuum.
    pub stretches: Vec<Stretch>,
    /// The row of the glass that the ray runs through.
    pub glass: u32,
}

impl MediaAlong {
    /// Finds the media along a ray that hits nothing before its end, at a time since the shutter opened.
    pub fn find(&mut self, media: &MediumTable, ray: [DVec3; 2], time: f64, end: f64) {
        self.find_spans(media, (ray, time), end);
        if self.varies() {
            self.divide_into_blocks(media);
        }
        self.add_up(&media.medium);
    }

    /// The transmittance of the media along a ray, at a time since the shutter opened.
    pub fn find_transmittance(&mut self, media: &MediumTable, of: ([DVec3; 2], f64), end: f64) -> [f64; 3] {
        self.find_spans(media, of, end);
        if self.varies() {
            return self.transmittance(media);
        }
        self.add_up(&media.medium);
        transmittance_along(&self.stretches)
    }

    /// Finds from where to where a ray runs through each medium.
    pub(super) fn find_spans(&mut self, media: &MediumTable, (ray, time): ([DVec3; 2], f64), end: f64) {
        let [origin, direction] = ray;
        self.spans.clear();
        self.stretches.clear();
        self.grids.clear();
        self.glass = NO_ROW;
        if let Some((bodies, glass)) = &media.glass {
            // No surface is between its ends: what is around its middle is around all of it.
            let middle = if end < f64::INFINITY { 0.5 * end } else { l1_norm(origin) + 1.0 };
            list_around(&bodies.row, glass, (origin + middle * direction, time), &mut self.around);
            self.glass = self.around.first().copied().unwrap_or(NO_ROW);
        }
        for (Filled { medium, place, density }, number) in media.place.iter().zip(0..) {
            let grid = if density.is_some() { self.grids.len() as u32 } else { NO_ROW };
            let before = self.spans.len();
            let mut add = |from, to| self.spans.push(Span { from, to, medium: *medium, grid, majorant: 1.0 });
            let mut start = origin;
            match place {
                MediumPlace::Everywhere if self.glass == NO_ROW => add(0.0, end),
                MediumPlace::Glass(row) if self.glass == *row => add(0.0, end),
                MediumPlace::Everywhere | MediumPlace::Glass(_) => {}
                MediumPlace::Body { shape, velocity, bounds } => {
                    start = origin - *velocity * time;
                    stretches_inside((shape, bounds), [start, direction], end, |[from, to]| add(from, to));
                }
            }
            if let Some(placed) = density
                && self.spans.len() > before
            {
                self.grids.push((number, placed.index_ray([start, direction])));
            }
        }
    }

    /// Whether the density of any medium along the ray varies.
    pub fn varies(&self) -> bool {
        !self.grids.is_empty()
    }

    /// Divides the ray where a medium begins or ends, and adds up the coefficients between.
    fn add_up(&mut self, media: &[Coefficients]) {
        let alone = |own: &Span| {
            let Coefficients { extinction, scattering, emission } = media[own.medium];
            let varies = own.grid != NO_ROW;
            let of = |parts: [f64; 3]| if varies { parts.each(|part| part * own.majorant) } else { parts };
            let sum = Coefficients { extinction: of(extinction), scattering: of(scattering), emission: of(emission) };
            Stretch { from: own.from, to: own.to, sum, varies, only: NO_ROW }
        };
        if self.spans.windows(2).all(|pair| pair[0].to <= pair[1].from) {
            let stretches = self.spans.iter().zip(0..).map(|(own, only)| Stretch { only, ..alone(own) });
            self.stretches.extend(stretches);
            return;
        }
        self.cuts.clear();
        self.cuts.extend(self.spans.iter().flat_map(|own| [own.from, own.to]));
        self.cuts.sort_by(f64::total_cmp);
        self.cuts.dedup();
        for pair in self.cuts.windows(2) {
            let within = self.spans.iter().filter(|own| own.from <= pair[0] && pair[1] <= own.to);
            let sum = within.map(alone).reduce(|mut all, own| {
                for part in 0..3 {
                    all.sum.extinction[part] += own.sum.extinction[part];
                    all.sum.scattering[part] += own.sum.scattering[part];
                    all.sum.emission[part] += own.sum.emission[part];
                }
                Stretch { varies: all.varies | own.varies, ..all }
            });
            self.stretches.extend(sum.map(|sum| Stretch { from: pair[0], to: pair[1], ..sum }));
        }
    }

    /// The spans that a distance lies in.
    fn at(&self, t: f64) -> impl Iterator<Item = &Span> {
        self.spans.iter().filter(move |own| own.from <= t && t <= own.to)
    }

    /// Chooses, by a number in [0, 1), one of the media that scatter light at a distance, in proportion to what each
    /// scatters of this throughput; returns its row, and the factor of the throughput.
    pub fn choose(&self, media: &MediumTable, t: f64, throughput: [f64; 3], number: f64) -> (usize, [f64; 3]) {
        let of = |own: &Span| {
            let scattering = media.medium[own.medium].scattering;
            if own.grid == NO_ROW { scattering } else { scattering.each(|part| part * self.density(media, own, t)) }
        };
        let scatters = |own: &Span| (0..3).map(|part| throughput[part].abs() * of(own)[part]).sum::<f64>();
        let (mut all, mut sum) = ([0.0; 3], 0.0);
        for own in self.at(t) {
            sum += scatters(own);
            (0..3).for_each(|part| all[part] += of(own)[part]);
        }
        let (mut before, mut chosen) = (0.0, None);
        for own in self.at(t).filter(|own| scatters(own) > 0.0) {
            chosen = Some(own);
            before += scatters(own);
            if number * sum < before {
                break;
            }
        }
        let Some(own) = chosen else { return (self.at(t).next().map_or(0, |own| own.medium), [0.0; 3]) };
        let probability = scatters(own) / sum;
        let of_all = |part: usize| if all[part] > 0.0 { of(own)[part] / all[part] / probability } else { 0.0 };
        (own.medium, [0, 1, 2].each(of_all))
    }
}

#[cfg(test)]
mod distance_tests {
    use super::*;
    use crate::measure::draws::Draws;

    fn stretch(from: f64, to: f64, absorption: [f64; 3], scattering: [f64; 3]) -> Stretch {
        let extinction = [0, 1, 2].map(|part| absorption[part] + scattering[part]);
        Stretch {
            from,
            to,
            sum: Coefficients { extinction, scattering, emission: [0.0; 3] },
            varies: false,
            only: NO_ROW,
        }
    }

    /// Stretches with gaps, of which some absorb, some scatter and some do both, by different amounts in each colour.
    fn examples() -> Vec<Vec<Stretch>> {
        vec![
            vec![stretch(0.0, f64::INFINITY, [0.0; 3], [1.0, 2.0, 0.3])],
            vec![stretch(0.5, 2.0, [0.3, 0.0, 2.0], [0.7, 1.0, 0.1])],
            vec![
                stretch(0.0, 0.4, [1.0, 0.2, 0.0], [0.0; 3]),
                stretch(0.4, 1.0, [0.1; 3], [3.0, 0.0, 0.5]),
                stretch(1.7, 2.5, [0.0; 3], [0.2, 4.0, 1.0]),
            ],
            vec![stretch(0.0, 1.0, [5.0; 3], [0.0; 3])],
            vec![stretch(0.0, 1e-6, [1.0; 3], [1e6, 1e3, 1.0]), stretch(1e-6, 3.0, [0.0; 3], [0.2, 1e-2, 0.0])],
        ]
    }

    /// The mean over all samples of what reaches a distance, or is scattered before it, is its integral: of survival the
    /// transmittance, of scattering ∫ σs T, and of its distance ∫ t σs T.
    #[test]
    fn means_are_integrals() {
        const SAMPLES: u32 = 400_000;
        let (mut tried, mut worst) = (0, 0.0_f64);
        for (example, stretches) in examples().iter().enumerate() {
            for throughput in [[1.0; 3], [1.0, 0.1, 0.0], [1e-6, 1.0, 30.0], [2.0, -0.7, 0.3]] {
                let mut sums = [[[0.0_f64; 2]; 3]; 3];
                for index in 0..SAMPLES {
                    // Stratified, so that little noise is left.
                    let jitter = Draws::new(17, u64::from(index)).unit();
                    let number = (f64::from(index) + jitter) / f64::from(SAMPLES);
                    let SampledDistance { t, weight } = sample_distance(stretches, throughput, number);
                    for part in 0..3 {
                        let carried = throughput[part] * weight[part];
                        assert!(carried.is_finite() && carried * throughput[part] >= 0.0);
                        let of = match t {
                            None => [carried, 0.0, 0.0],
                            Some(t) => [0.0, carried, carried * t.min(1e3)],
                        };
                        for (sum, value) in sums[part].iter_mut().zip(of) {
                            sum[0] += value;
                            sum[1] += value * value;
                        }
                    }
                }
                for part in 0..3 {
                    let truth = integrals(stretches, part).map(|own| own * throughput[part]);
                    for (sum, truth) in sums[part].iter().zip(truth) {
                        let (count, mean) = (f64::from(SAMPLES), sum[0] / f64::from(SAMPLES));
                        let error = ((sum[1] / count - mean * mean).max(0.0) / count).sqrt();
                        let off = (mean - truth) / error.max(1e-9 * truth.abs()).max(1e-300);
                        worst = worst.max(off.abs());
                        assert!(
                            off.abs() < 4.0,
                            "example {example}, {throughput:?}, colour {part}: {mean} for {truth}"
                        );
                        tried += 1;
                    }
                }
            }
        }
        eprintln!(
            "distances: {tried} means of {SAMPLES} samples, worst {worst:.2} standard errors of independent ones"
        );
    }

    /// T at the end, ∫ σs T and ∫ t σs T, stretch by stretch in closed form.
    fn integrals(stretches: &[Stretch], part: usize) -> [f64; 3] {
        let (mut transmitted, mut scattered, mut moment) = (1.0, 0.0, 0.0);
        for Stretch { from, to, sum, .. } in stretches {
            let (sigma, length) = (sum.extinction[part], to - from);
            if sigma == 0.0 {
                continue;
            }
            let through = libm::exp(-sigma * length);
            let within = if length.is_finite() { length * through } else { 0.0 };
            let lost = -libm::expm1(-sigma * length);
            scattered += transmitted * sum.scattering[part] / sigma * lost;
            moment += transmitted * sum.scattering[part] / sigma * (from * lost + lost / sigma - within);
            transmitted *= through;
        }
        [transmitted, scattered, moment]
    }

    /// Where nothing is absorbed, the sum of the colours stays what it was, whatever is sampled: no weight exceeds it.
    #[test]
    fn the_sum_of_the_colours_is_kept() {
        let stretches = [stretch(0.2, 1.0, [0.0; 3], [9.0, 0.5, 0.0]), stretch(1.0, 4.0, [0.0; 3], [0.1, 3.0, 1.0])];
        let mut tried = 0;
        for index in 0..10_000 {
            let mut draws = Draws::new(5, index);
            let throughput = [draws.unit(), draws.unit() * 1e-3, draws.unit() * 1e3];
            let sampled = sample_distance(&stretches, throughput, draws.unit());
            let sum: f64 = (0..3).map(|part| throughput[part] * sampled.weight[part]).sum();
            assert!((sum / throughput.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{sampled:?}");
            tried += 1;
        }
        eprintln!("distances: {tried} samples keep the sum of the colours");
    }

    /// No number is lost at either end of what is accepted, nor with numbers at the ends of [0, 1).
    #[test]
    fn extremes_are_numbers() {
        let mut tried = 0;
        for scattering in [0.0, 1e-300, 1e-30, 1.0, 1e30, 3e38] {
            for absorption in [0.0, 1e-300, 1.0, 3e38] {
                for end in [1e-18, 1.0, 1e18, f64::INFINITY] {
                    for number in [0.0, 0.5, 1.0 - f64::EPSILON / 2.0, 1.0 - 1.0 / 4_294_967_296.0] {
                        for throughput in [[1.0; 3], [0.0; 3], [1e-300, 1.0, 0.0]] {
                            let stretches = [stretch(0.0, end, [absorption; 3], [scattering, 0.0, 1.0])];
                            let sampled = sample_distance(&stretches, throughput, number);
                            let SampledDistance { t, weight } = sampled;
                            assert!(weight.iter().all(|own| own.is_finite() && *own >= 0.0), "{sampled:?}");
                            assert!(t.is_none_or(|t| (0.0..=end).contains(&t) && t.is_finite()), "{sampled:?}");
                            tried += 1;
                        }
                    }
                }
            }
        }
        eprintln!("distances: {tried} at the ends of what is accepted");
    }
}
