use super::{cosine_pdf, ggx_sample};
use crate::each::Each;
use crate::sample::DiskPoint;
use glam::DVec3;
use std::f64::consts::FRAC_1_PI;

/// The number of steps in which cosines are tabulated.
const STEPS: usize = 32;
/// Two Fibonacci numbers in a row: the points of a lattice over the square, and its second generator.
const LATTICE: [u32; 2] = [610, 377];

/// The energy that single scattering on rough microfacets loses, and the lobe that compensates for it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MultipleScattering {
    /// The fraction lost by each material; 0 where it is not compensated.
    pub lost: Vec<ByCosine>,
    /// The scale of the compensating lobe for each material, in 1/sr: red, green, blue.
    pub compensation: Vec<[f64; 3]>,
}

/// A quantity of rough microfacets by the cosine μ to the normal, in equal steps of μ (1 + α) / (μ + α).
///
/// For small α nearly all changes at cosines of about α, and these steps are fine there.
#[derive(Clone, Debug, PartialEq)]
pub struct ByCosine {
    alpha: f64,
    steps: [f64; STEPS + 1],
}

/// The mean of a function of the cosine between eye and microfacet normal, weighted by what single scattering reflects at
/// this cosine to the normal: for the function 1 the directional albedo of microfacets of reflectance 1.
///
/// It is averaged over [`ggx_sample`] at the points of a Fibonacci lattice (Sloan and Joe 1994).
/// The first number is 1 − s³ for a coordinate s of the lattice, so that the rare steep microfacets, whose light is lost,
/// get most of the points.
pub fn single_scattering(cosine: f64, alpha: f64, of: impl Fn(f64) -> f64) -> f64 {
    let to_eye = DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine);
    let [count, generator] = LATTICE;
    let weight = |at: u32| {
        let s = (f64::from(at) + 0.5) / f64::from(count);
        let turn = f64::from(at * generator % count) / f64::from(count);
        ggx_sample(to_eye, alpha, DiskPoint::polar(1.0 - s * s * s, turn)).map_or(0.0, |sample| {
            let facing = to_eye.dot((sample.to_light + to_eye).normalize());
            3.0 * s * s * sample.weight * of(facing)
        })
    };
    (0..count).map(weight).sum::<f64>() / f64::from(count)
}

impl ByCosine {
    /// Tabulates a function of the cosine.
    pub fn new(alpha: f64, of: impl Fn(f64) -> f64) -> Self {
        // At grazing incidence nothing is visible; the value just above stands for it.
        let cosine = |x: f64| (x * alpha / (1.0 + alpha - x)).clamp(1e-6, 1.0);
        Self { alpha, steps: std::array::from_fn(|step| of(cosine(step as f64 / STEPS as f64))) }
    }

    /// The fraction of light that single scattering loses at microfacets of reflectance 1.
    pub fn lost(alpha: f64) -> Self {
        Self::new(alpha, |cosine| (1.0 - single_scattering(cosine, alpha, |_| 1.0)).max(0.0))
    }

    /// 0 at all cosines.
    const NONE: Self = Self { alpha: 1.0, steps: [0.0; STEPS + 1] };

    /// The value at a cosine, interpolated linearly in the steps.
    #[inline(always)]
    pub fn at(&self, cosine: f64) -> f64 {
        let cosine = cosine.clamp(0.0, 1.0);
        let place = cosine * (1.0 + self.alpha) / (cosine + self.alpha) * STEPS as f64;
        let step = (place as usize).min(STEPS - 1);
        self.steps[step] + (place - step as f64) * (self.steps[step + 1] - self.steps[step])
    }

    /// The value at a cosine between those of two tables, a fraction `t` from the first to the second at each of their
    /// steps, where `alpha` is that in between.
    #[inline(always)]
    pub fn between([low, high]: [&Self; 2], t: f64, alpha: f64, cosine: f64) -> f64 {
        let cosine = cosine.clamp(0.0, 1.0);
        let place = cosine * (1.0 + alpha) / (cosine + alpha) * STEPS as f64;
        let step = (place as usize).min(STEPS - 1);
        // The ends are exact, so that a table's own α gives its own values.
        let at = |step: usize| (1.0 - t) * low.steps[step] + t * high.steps[step];
        at(step) + (place - step as f64) * (at(step + 1) - at(step))
    }

    /// The hemispherical average 2 ∫ value(μ) μ dμ, exactly for the interpolation of [`Self::at`].
    ///
    /// By parts it is the sum of [value μ²] − slope · ∫ μ² dx over the steps of x, with μ = α x / (1 + α − x).
    pub fn average(&self) -> f64 {
        let (alpha, whole) = (self.alpha, 1.0 + self.alpha);
        let cosine = |x: f64| alpha * x / (whole - x);
        let squares = |x: f64| {
            let left = whole - x;
            alpha * alpha * (whole * whole / left + 2.0 * whole * libm::log(left) - left)
        };
        let of_step = |step: usize| {
            let [low, high] = [step, step + 1].each(|step| step as f64 / STEPS as f64);
            let [first, last] = [self.steps[step], self.steps[step + 1]];
            let ends = last * cosine(high) * cosine(high) - first * cosine(low) * cosine(low);
            ends - (last - first) * STEPS as f64 * (squares(high) - squares(low))
        };
        (0..STEPS).map(of_step).sum()
    }
}

/// The albedo of the light that is scattered more than once, for microfacets of reflectance c that each pass the
/// fraction l on to the next: c² (1 − l) (1 + c l + c² l² + …) = c² (1 − l) / (1 − c l), summed over two, three and
/// more scatterings (Fdez-Agüera 2019).
#[inline(always)]
pub fn multiple_scattering_albedo(colour: f64, lost: f64) -> f64 {
    colour * colour * (1.0 - lost) / (1.0 - colour * lost)
}

impl MultipleScattering {
    /// Its memory, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.lost[..]) + size_of_val(&self.compensation[..])
    }

    /// Adds a material of this colour and α, or one without compensation.
    pub fn push(&mut self, colour: [f64; 3], alpha: Option<f64>) {
        let lost = alpha.map_or(ByCosine::NONE, ByCosine::lost);
        let average = lost.average();
        let scale = if average > 0.0 { FRAC_1_PI / average } else { 0.0 };
        self.lost.push(lost);
        self.compensation.push(colour.each(|colour| multiple_scattering_albedo(colour, average) * scale));
    }

    // ANCHOR: lobe
    /// The multiple-scattering lobe of a metal, in 1/sr.
    ///
    /// It is symmetric in the two directions, and its directional albedo is what [`ByCosine::at`] gives (Kulla and Conty
    /// 2017).
    #[inline(always)]
    pub fn brdf(&self, metal: usize, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        if to_light.z <= 0.0 || to_eye.z <= 0.0 {
            return [0.0; 3];
        }
        let both = self.lost[metal].at(to_light.z) * self.lost[metal].at(to_eye.z);
        self.compensation[metal].each(|scale| scale * both)
    }

    /// The pdf of sampling this lobe by the cosine with the fraction lost as probability, and otherwise with the pdf
    /// `visible` of single scattering, in 1/sr.
    #[inline(always)]
    pub fn pdf(&self, metal: usize, to_light: DVec3, to_eye: DVec3, visible: f64) -> f64 {
        let lost = self.lost[metal].at(to_eye.z);
        (1.0 - lost) * visible + lost * cosine_pdf(to_light.z)
    }
    // ANCHOR_END: lobe

    /// Whether to sample this lobe, by a number in [0, 1).
    #[inline(always)]
    pub fn is_lost(&self, metal: usize, to_eye: DVec3, number: f64) -> bool {
        number < self.lost[metal].at(to_eye.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{Bsdf, BsdfSample, MetalTable, Parameters, ShadingContext, ggx_brdf, ggx_g1};
    use crate::measure::chi_squared::{Bins, p_value};
    use crate::measure::draws::Draws;
    use crate::measure::hemisphere::Quadrature;
    use std::f64::consts::{LN_2, PI};

    const ALPHAS: [f64; 7] = [0.01, 0.03, 0.05, 0.1, 0.3, 0.6, 1.0];

    fn of(alpha: f64, colour: f64) -> ShadingContext {
        ShadingContext::opaque(0, Parameters { roughness: alpha, ..Parameters::coloured([colour; 3]) })
    }

    fn lobes(alpha: f64, colour: f64) -> MultipleScattering {
        let mut several = MultipleScattering::default();
        several.push([colour; 3], Some(alpha));
        several
    }

    fn metal(alpha: f64, colour: f64) -> MetalTable {
        MetalTable { several: Some(lobes(alpha, colour)) }
    }

    /// The fraction lost, by quadrature over the hemisphere, which is independent of visible normals.
    #[test]
    fn what_is_lost_is_what_quadrature_misses() {
        let (rule, mut worst, mut tried) = (Quadrature::default(), 0.0_f64, 0);
        for alpha in ALPHAS {
            let several = lobes(alpha, 1.0);
            for at in 0..40 {
                let angle = PI / 2.0 * f64::from(at) / 40.0;
                let lost = 1.0 - rule.albedo(angle, 0.5 * alpha, |light, eye| ggx_brdf(light, eye, alpha));
                let off = (several.lost[0].at(libm::cos(angle)) - lost).abs();
                (worst, tried) = (worst.max(off), tried + 1);
                assert!(off < 1e-3, "α {alpha}, {angle}: {off}");
            }
        }
        let roughest = lobes(1.0, 1.0);
        assert!((roughest.lost[0].at(1.0) - LN_2).abs() < 3e-4);
        eprintln!("energy lost: {tried} angles, worst difference from quadrature {worst:.1e}");
    }

    /// The furnace test: with compensation, metal of reflectance 1 reflects all of a uniform radiance of 1, and a
    /// coloured one less.
    #[test]
    fn furnace() {
        let (rule, mut min, mut max) = (Quadrature::default(), f64::INFINITY, 0.0_f64);
        for alpha in ALPHAS {
            let rough = metal(alpha, 1.0);
            for angle in [0.0, 0.3, 0.7, 1.1, 1.4, 1.5, 89.0 * PI / 180.0] {
                let all = rule.albedo(angle, 0.5 * alpha, |light, eye| rough.eval(&of(alpha, 1.0), light, eye)[0]);
                (min, max) = (min.min(all), max.max(all));
                assert!((1.0 - 3e-3..1.0 + 1e-3).contains(&all), "α {alpha}, {angle}: {all}");
            }
            let half = metal(alpha, 0.5);
            let all = rule.albedo(0.7, 0.5 * alpha, |light, eye| half.eval(&of(alpha, 0.5), light, eye)[0]);
            let once = 0.5 * rule.albedo(0.7, 0.5 * alpha, |light, eye| ggx_brdf(light, eye, alpha));
            assert!(all > once && all < 0.5, "α {alpha}: {once} once, {all} in all");
        }
        eprintln!("furnace: 49 sums from {min:.5} to {max:.5}");
        assert_eq!([multiple_scattering_albedo(1.0, 0.3), multiple_scattering_albedo(0.0, 0.3)], [1.0, 0.0]);
    }

    /// A coloured metal, scattering by scattering: each reflects c, the first passes all on, and every later one lets
    /// 1 − l out.
    #[test]
    fn the_albedo_of_several_scatterings_is_their_sum() {
        let mut tried = 0;
        for (colour, lost) in
            [0.1, 0.5, 0.9, 0.99].into_iter().flat_map(|colour| [0.01, 0.3, 0.69].map(|l| (colour, l)))
        {
            let (mut inside, mut left) = (colour, 0.0);
            for _ in 0..4000 {
                let reflected = inside * colour;
                left += reflected * (1.0 - lost);
                inside = reflected * lost;
            }
            let albedo = multiple_scattering_albedo(colour, lost);
            assert!((albedo - left).abs() < 1e-12, "c {colour}, l {lost}: {albedo} for {left}");
            tried += 1;
        }
        eprintln!("several scatterings: {tried} sums of 4000 terms");
    }

    #[test]
    fn several_mirrors_are_reciprocal() {
        let several = lobes(0.4, 0.8);
        for index in 0..10_000 {
            let mut draws = Draws::new(1941, index);
            let mut direction = || {
                let direction = draws.unit_vector();
                DVec3::new(direction.x, direction.y, direction.z.abs())
            };
            let (light, eye) = (direction(), direction());
            assert_eq!(several.brdf(0, light, eye), several.brdf(0, eye, light), "{index}");
        }
        assert_eq!(several.brdf(0, -DVec3::Z, DVec3::Z), [0.0; 3]);
        eprintln!("multiple scattering: 10000 pairs of directions, reciprocal bit for bit");
    }

    /// Sampled directions have the stated pdf in bins of cosine and azimuth; those below the surface have a bin of
    /// their own.
    #[test]
    fn directions_have_their_pdf() {
        const SAMPLES: u64 = 100_000;
        const LINES: usize = 12;
        for (which, (alpha, angle)) in [(0.4, 1.2_f64), (0.7, 0.5), (1.0, 0.0), (1.0, 1.45)].into_iter().enumerate() {
            let rough = metal(alpha, 0.9);
            let eye = DVec3::new(libm::sin(angle), 0.0, libm::cos(angle));
            let (rule, mut bins) = (Quadrature::default(), Bins::new(LINES * LINES + 1));
            let line = |at: usize| at as f64 / LINES as f64;
            for (cosine, turn) in (0..LINES).flat_map(|cosine| (0..LINES).map(move |turn| (cosine, turn))) {
                let fraction = rule.sum(line(cosine), line(cosine + 1), |z| {
                    rule.sum(2.0 * PI * line(turn), 2.0 * PI * line(turn + 1), |turn| {
                        let across = (1.0 - z * z).sqrt();
                        let light = DVec3::new(across * libm::cos(turn), across * libm::sin(turn), z);
                        rough.pdf(&of(alpha, 0.9), light, eye)
                    })
                });
                bins.expect(cosine * LINES + turn, fraction * SAMPLES as f64);
            }
            bins.expect(LINES * LINES, SAMPLES as f64 - bins.total());
            for index in 0..SAMPLES {
                let mut draws = Draws::new(1942 + which as u64, index);
                let (numbers, choice) = ([draws.unit(), draws.unit()], draws.unit());
                let Some(BsdfSample { to_light: light, .. }) = rough.sample(&of(alpha, 0.9), eye, numbers, choice)
                else {
                    bins.count(LINES * LINES);
                    continue;
                };
                let turn = libm::atan2(light.y, light.x).rem_euclid(2.0 * PI) / (2.0 * PI);
                let place = |part: f64| ((part * LINES as f64) as usize).min(LINES - 1);
                bins.count(place(light.z) * LINES + place(turn));
            }
            let (statistic, freedom) = bins.statistic();
            let p = p_value(statistic, freedom);
            eprintln!("several mirrors, α {alpha}, {angle}: chi squared {statistic:.1} of {freedom}, p {p:.3}");
            assert!(p > 1e-3, "α {alpha}, {angle}: χ² {statistic} of {freedom}");
        }
    }

    #[test]
    fn extreme_numbers_give_finite_samples() {
        let ends = [0.0, 1.0 / (1 << 24) as f64, 0.5, 1.0 - 1.0 / (1 << 24) as f64];
        let mut tried = 0;
        for (alpha, angle) in [(1e-3, 1.0), (0.3, 1e-9), (1.0, 0.0), (1.0, -0.3_f64)] {
            let rough = metal(alpha, 1.0);
            let lost = &rough.several.as_ref().expect("several mirrors").lost[0];
            let eye = DVec3::new((1.0 - angle * angle).sqrt(), 0.0, angle);
            assert!(ggx_g1(eye, alpha).is_finite());
            for (u, v) in ends.into_iter().flat_map(|u| ends.map(|v| (u, v))) {
                for choice in ends {
                    tried += 1;
                    let Some(BsdfSample { to_light: light, pdf, weight: weights }) =
                        rough.sample(&of(alpha, 1.0), eye, [u, v], choice)
                    else {
                        continue;
                    };
                    let [weight, ..] = weights;
                    assert!(light.is_finite() && pdf > 0.0 && pdf.is_finite(), "{alpha} {angle} {u} {v}");
                    // No more than either lobe by itself: what is seen of G₁ ≤ 1, and what is lost in this direction beside
                    // the average.
                    let [of_light, of_eye] = [light.z, eye.z].map(|cosine| lost.at(cosine));
                    let max = (1.0 / (1.0 - of_eye)).max(of_light / lost.average()) * (1.0 + 1e-9);
                    assert!((0.0..=max).contains(&weight), "{alpha} {angle} {u} {v}: {weight}, at most {max}");
                }
            }
        }
        eprintln!("several mirrors: {tried} of the hardest numbers, all finite");
    }

    #[test]
    fn its_memory_is_that_of_both_tables() {
        let mut several = MultipleScattering::default();
        several.push([0.5; 3], Some(0.1));
        assert_eq!(several.bytes(), size_of_val(&several.lost[..]) + size_of_val(&several.compensation[..]));
        assert!(!several.lost.is_empty() && !several.compensation.is_empty());
    }
}
