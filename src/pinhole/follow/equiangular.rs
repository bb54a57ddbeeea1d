//! Distances at which much light of a point arrives, beside those at which much is scattered.
//!
//! The light of a point falls with the square of the distance, so that the nearest events bring most of it, and by
//! transmittance alone they are sampled as seldom as any other: the variance is infinite.
//! Equal angles seen from the light are sampled as often (Kulla and Fajardo 2012), and both pdfs are mixed, which is the
//! balance heuristic of one sample.

use super::distances::{
    ChosenColour, SampledDistance, Stretch, add_depth, both_transmittances, over, sample_distance, transmittances,
};
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

use crate::each::{Each, all_are};

/// The optical depth behind which nothing need be sampled by angle; what lies there the other pdf still finds.
const DEEP: f64 = 40.0;

/// The least angle that is divided, so that its parts are resolved.
const MIN_ANGLE: f64 = 1e-6;

/// A part of a ray as it is seen from a light.
struct Seen {
    /// Where the ray is nearest to the light.
    nearest: f64,
    /// How near.
    off: f64,
    /// The angles of its ends.
    angles: [f64; 2],
    /// Its ends.
    ends: [f64; 2],
}

impl Seen {
    /// None where the light is so nearly on the ray, or the angle so small, that angles are not resolved.
    fn new([origin, direction]: [DVec3; 2], light: DVec3, ends: [f64; 2]) -> Option<Self> {
        let nearest = (light - origin).dot(direction);
        let off = (light - origin - nearest * direction).length();
        let angles = ends.each(|end| if end < f64::INFINITY { libm::atan2(end - nearest, off) } else { FRAC_PI_2 });
        let is_resolved = off > 1e-9 * nearest.abs() && angles[1] - angles[0] > MIN_ANGLE;
        is_resolved.then_some(Self { nearest, off, angles, ends })
    }

    /// The distance at a part of the angle, from 0 to 1.
    fn distance(&self, part: f64) -> f64 {
        let [from, to] = self.angles;
        let t = self.nearest + self.off * libm::tan(from + part * (to - from));
        t.max(self.ends[0]).min(self.ends[1])
    }

    /// The pdf of a distance: the angle is even, and dθ/dt = D / (D² + (t − t₀)²).
    fn pdf(&self, t: f64) -> f64 {
        let ([from, to], along) = (self.angles, t - self.nearest);
        let is_within = t >= self.ends[0] && t <= self.ends[1];
        if is_within { self.off / ((to - from) * (self.off * self.off + along * along)) } else { 0.0 }
    }
}

/// The ends of the part of a ray where media scatter light and any that is carried is left, and the probability that a
/// distance sampled by transmittance ends in it.
fn scattering_part(stretches: &[Stretch], choice: [f64; 3]) -> Option<([f64; 2], f64)> {
    let (mut ends, mut rates) = (None, [0.0; 3]);
    for stretch in stretches {
        let rate = stretch.rate();
        if all_are(rate, 0.0) {
            continue;
        }
        let least = (0..3).filter(|&part| choice[part] > 0.0).map(|part| rates[part]).fold(f64::INFINITY, f64::min);
        if least >= DEEP {
            break;
        }
        // The colour that comes farthest decides.
        let far = |part: usize| if rate[part] > 0.0 { (DEEP - rates[part]).max(0.0) / rate[part] } else { 0.0 };
        let length = (stretch.to - stretch.from).min(far(0).max(far(1)).max(far(2)));
        ends = Some([ends.map_or(stretch.from, |[from, _]: [f64; 2]| from), stretch.from + length]);
        add_depth(&mut rates, rate, stretch.to - stretch.from);
    }
    let through = transmittances(rates);
    Some((ends?, 1.0 - (0..3).map(|part| choice[part] * through[part]).sum::<f64>()))
}

/// What is scattered at a distance, σs T in each colour, and the pdf of that distance by transmittance.
fn scattered_at(stretches: &[Stretch], choice: [f64; 3], t: f64) -> ([f64; 3], f64) {
    let (mut rates, mut depths) = ([0.0; 3], [0.0; 3]);
    for stretch in stretches {
        let length = t.min(stretch.to) - stretch.from;
        if length < 0.0 {
            break;
        }
        add_depth(&mut rates, stretch.rate(), length);
        add_depth(&mut depths, stretch.sum.extinction, length);
        if t <= stretch.to {
            let [sampled, left] = both_transmittances(rates, depths);
            let pdf = (0..3).map(|part| choice[part] * stretch.rate()[part] * sampled[part]).sum();
            return ([0, 1, 2].each(|part| stretch.sum.scattering[part] * left[part]), pdf);
        }
    }
    ([0.0; 3], 0.0)
}

/// Samples the distance at which light is scattered, by a number in [0, 1), half of the events by the angle at which a
/// light sees the ray and half by transmittance.
pub fn sample_distance_towards(
    stretches: &[Stretch],
    (ray, light): ([DVec3; 2], DVec3),
    throughput: [f64; 3],
    number: f64,
) -> SampledDistance {
    let plain = || sample_distance(stretches, throughput, number);
    let Some(ChosenColour { choice, .. }) = ChosenColour::of(throughput, number) else { return plain() };
    let Some((ends, scatters)) = scattering_part(stretches, choice) else { return plain() };
    let Some(seen) = Seen::new(ray, light, ends) else { return plain() };

    // As seldom as anything is scattered, so that what reaches a surface stays nearly as it was.
    let by_angle = 0.5 * scatters;
    let (t, weight) = if number < by_angle {
        (Some(seen.distance(number / by_angle)), [0.0; 3])
    } else {
        let left = ((number - by_angle) / (1.0 - by_angle)).min(1.0 - f64::EPSILON);
        let sampled = sample_distance(stretches, throughput, left);
        (sampled.t, sampled.weight)
    };
    let Some(t) = t else {
        return SampledDistance { t: None, weight: weight.each(|part| part / (1.0 - by_angle)) };
    };
    let (scattered, pdf) = scattered_at(stretches, choice, t);
    let mixed = (1.0 - by_angle) * pdf + by_angle * seen.pdf(t);
    SampledDistance { t: Some(t), weight: [0, 1, 2].each(|part| over(choice[part], scattered[part], mixed)) }
}

#[cfg(test)]
mod equiangular_tests {
    use super::*;
    use crate::extract::{Coefficients, NO_ROW};
    use crate::measure::draws::Draws;

    fn stretch(from: f64, to: f64, absorption: f64, scattering: [f64; 3]) -> Stretch {
        let sum = Coefficients { extinction: scattering.map(|part| part + absorption), scattering, emission: [0.0; 3] };
        Stretch { from, to, sum, varies: false, only: NO_ROW }
    }

    /// ∫ σs T f dt in each colour over what scatters, and T at the end, by many small steps.
    fn by_steps(stretches: &[Stretch], of: &dyn Fn(f64) -> f64) -> ([f64; 3], [f64; 3]) {
        const STEPS: u32 = 200_000;
        let (mut sum, mut depths) = ([0.0; 3], [0.0; 3]);
        for own in stretches {
            let length = (own.to - own.from).min(60.0);
            let step = length / f64::from(STEPS);
            for index in 0..STEPS {
                let along = (f64::from(index) + 0.5) * step;
                for part in 0..3 {
                    let left = libm::exp(-depths[part] - own.sum.extinction[part] * along);
                    sum[part] += own.sum.scattering[part] * left * of(own.from + along) * step;
                }
            }
            add_depth(&mut depths, own.sum.extinction, own.to - own.from);
        }
        (sum, transmittances(depths))
    }

    /// Means over all samples are the integrals, of the light of a point too; of that the squares are bounded as well, so
    /// that the mean is known.
    #[test]
    fn means_are_integrals_towards_a_light() {
        const SAMPLES: u32 = 200_000;
        let ray = [DVec3::new(0.3, -0.2, 0.1), DVec3::new(0.6, 0.0, 0.8)];
        let scenes = [
            vec![stretch(0.0, 9.0, 0.1, [0.2, 0.3, 0.1])],
            vec![stretch(0.5, 2.0, 0.0, [3.0, 0.0, 1.0]), stretch(2.5, f64::INFINITY, 0.4, [0.7, 1.0, 0.5])],
            vec![stretch(0.0, 1.0, 2.0, [0.0; 3]), stretch(1.0, 4.0, 0.0, [30.0, 1.0, 0.3])],
        ];
        let (mut tried, mut worst) = (0, 0.0_f64);
        for stretches in &scenes {
            for (along, off) in [(1.2, 0.3), (3.0, 0.01), (-1.0, 0.5), (2.2, 1e-4)] {
                let light = ray[0] + along * ray[1] + off * DVec3::Y;
                let brings = |t: f64| 1.0 / (ray[0] + t * ray[1] - light).length_squared();
                let ([scattered, through], [lit, _]) =
                    (<[_; 2]>::from(by_steps(stretches, &|_| 1.0)), <[_; 2]>::from(by_steps(stretches, &brings)));
                for throughput in [[1.0; 3], [1.0, 0.1, 0.0], [0.5, -0.7, 2.0]] {
                    let mut sums = [[[0.0_f64; 2]; 3]; 3];
                    for index in 0..SAMPLES {
                        let jitter = Draws::new(23, u64::from(index)).unit();
                        let number = (f64::from(index) + jitter) / f64::from(SAMPLES);
                        let SampledDistance { t, weight } =
                            sample_distance_towards(stretches, (ray, light), throughput, number);
                        for part in 0..3 {
                            let of = match t {
                                None => [weight[part], 0.0, 0.0],
                                Some(t) => [0.0, weight[part], weight[part] * brings(t)],
                            };
                            for (sum, value) in sums[part].iter_mut().zip(of) {
                                sum[0] += value;
                                sum[1] += value * value;
                            }
                        }
                    }
                    for part in (0..3).filter(|&part| throughput[part] != 0.0) {
                        for (sum, truth) in sums[part].iter().zip([through[part], scattered[part], lit[part]]) {
                            let (count, mean) = (f64::from(SAMPLES), sum[0] / f64::from(SAMPLES));
                            let error = ((sum[1] / count - mean * mean).max(0.0) / count).sqrt();
                            let off_by = (mean - truth) / error.max(1e-4 * truth).max(1e-300);
                            worst = worst.max(off_by.abs());
                            assert!(off_by.abs() < 4.0, "{along}, {off}, {throughput:?}, {part}: {mean} for {truth}");
                            assert!(truth != lit[part] || error <= 0.02 * truth, "{along}, {off}: {mean} ± {error}");
                            tried += 1;
                        }
                    }
                }
            }
        }
        eprintln!("distances towards lights: {tried} means, worst {worst:.2} standard errors of independent samples");
    }

    #[test]
    fn extremes_are_numbers() {
        let mut tried = 0;
        for scattering in [1e-300, 1e-30, 1.0, 1e30, 3e38] {
            for end in [1e-18, 1.0, 1e18, f64::INFINITY] {
                for (along, off) in [(0.0, 0.0), (0.5, 0.0), (0.5, 1e-300), (1e18, 1.0), (-3.0, 1e18), (1e-30, 1e-30)] {
                    for number in [0.0, 0.25, 0.5, 1.0 - 1.0 / 4_294_967_296.0] {
                        let stretches = [stretch(0.0, end, 0.0, [scattering, 0.0, 1.0])];
                        let (ray, light) = ([DVec3::ZERO, DVec3::X], DVec3::new(along, off, 0.0));
                        let sampled = sample_distance_towards(&stretches, (ray, light), [1.0, 0.5, 0.0], number);
                        assert!(sampled.weight.iter().all(|own| own.is_finite() && *own >= 0.0), "{sampled:?}");
                        assert!(sampled.t.is_none_or(|t| (0.0..=end).contains(&t) && t.is_finite()), "{sampled:?}");
                        tried += 1;
                    }
                }
            }
        }
        eprintln!("distances towards lights: {tried} at the ends of what is accepted");
    }
}
