use super::mirror_direction;
use crate::sample::DiskPoint;
use glam::DVec3;
use std::f64::consts::PI;

// ANCHOR: ggx_d
/// The distribution of microfacet normals D: microfacet area per unit of surface area and solid angle of normals about
/// `half`, a unit vector above the surface, in 1/sr (Trowbridge and Reitz 1975; named GGX by Walter et al. 2007).
///
/// The usual denominator (cos²θ (α² − 1) + 1)² subtracts two numbers close to 1; this sum contains no difference.
#[inline(always)]
pub fn ggx_d(half: DVec3, alpha: f64) -> f64 {
    let (x, y) = (half.x / alpha, half.y / alpha);
    let e = x * x + y * y + half.z * half.z;
    1.0 / (PI * alpha * alpha * e * e)
}
// ANCHOR_END: ggx_d

/// cos θ + √(cos²θ + α² sin²θ) for a direction above the surface; above 0 even at grazing angles.
#[inline(always)]
fn masked_cosine(w: DVec3, alpha: f64) -> f64 {
    let across = alpha * alpha * (w.x * w.x + w.y * w.y);
    w.z + (w.z * w.z + across).sqrt()
}

// ANCHOR: ggx_g1
/// Smith's Λ: the ratio of masked to visible microfacet area, seen from `w`.
#[inline(always)]
pub fn ggx_lambda(w: DVec3, alpha: f64) -> f64 {
    let slope_squared = alpha * alpha * (w.x * w.x + w.y * w.y) / (w.z * w.z);
    0.5 * ((1.0 + slope_squared).sqrt() - 1.0)
}

/// The masking function G₁: the fraction of microfacet area visible from `w`, 1 / (1 + Λ), and 0 from below.
#[inline(always)]
pub fn ggx_g1(w: DVec3, alpha: f64) -> f64 {
    if w.z > 0.0 { 2.0 * w.z / masked_cosine(w, alpha) } else { 0.0 }
}
// ANCHOR_END: ggx_g1

// ANCHOR: ggx_brdf
/// The single-scattering BRDF of a rough metal with a Fresnel reflectance of 1, in 1/sr: D G₁ G₁ / (4 cos θi cos θo),
/// with z along the normal; 0 where either direction is below the surface.
///
/// The cosines cancel against those in G₁, so nothing is divided by a cosine that may be 0.
#[inline(always)]
pub fn ggx_brdf(to_light: DVec3, to_eye: DVec3, alpha: f64) -> f64 {
    if to_light.z <= 0.0 || to_eye.z <= 0.0 {
        return 0.0;
    }
    ggx_d((to_light + to_eye).normalize(), alpha) / (masked_cosine(to_light, alpha) * masked_cosine(to_eye, alpha))
}
// ANCHOR_END: ggx_brdf

// ANCHOR: visible_normal
/// A microfacet normal sampled from those visible from `to_eye`, in proportion to their projected area, by a uniform point
/// of the unit disk.
///
/// Stretching by α makes the microsurface a hemisphere; the half vector between the direction to the eye and a uniform
/// point of the cap of directions that the hemisphere reflects the eye to is a visible normal of it (Dupuy and Benyoub
/// 2023).
#[inline(always)]
pub fn visible_normal(to_eye: DVec3, alpha: f64, on_disk: DiskPoint) -> DVec3 {
    let eye = DVec3::new(alpha * to_eye.x, alpha * to_eye.y, to_eye.z).normalize();
    // The height of the point on the cap above −eye.z, computed separately so that no digit is lost.
    let rise = (1.0 - on_disk.squared()) * (1.0 + eye.z);
    let height = rise - eye.z;
    let across = ((1.0 - height) * (1.0 + height)).max(0.0).sqrt();
    let [x, y] = on_disk.at(across);
    let half = DVec3::new(x + eye.x, y + eye.y, rise);
    DVec3::new(alpha * half.x, alpha * half.y, half.z).normalize()
}

/// The pdf of the reflection about a [`visible_normal`], in 1/sr: G₁ D / (4 cos θo), even where it leads below the
/// surface.
#[inline(always)]
pub fn visible_pdf(to_light: DVec3, to_eye: DVec3, alpha: f64) -> f64 {
    let half = to_light + to_eye;
    if half.z <= 0.0 || to_eye.z < 0.0 {
        return 0.0;
    }
    0.5 * ggx_d(half.normalize(), alpha) / masked_cosine(to_eye, alpha)
}
// ANCHOR_END: visible_normal

/// A BSDF sample: a direction to the light by a visible normal, its pdf, and its weight, BRDF · cosine / pdf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MicrofacetSample {
    /// The direction to the light in the surface's frame; a unit vector above the surface.
    pub to_light: DVec3,
    /// Its pdf, in 1/sr; above 0.
    pub pdf: f64,
    /// BRDF · cosine / pdf for a reflectance of 1; from 0 to 1.
    pub weight: f64,
}

// ANCHOR: ggx_sample
/// Samples the direction to the light for rough metal by a uniform point of the unit disk; none where it leads below the
/// surface, to a second microfacet.
#[inline(always)]
pub fn ggx_sample(to_eye: DVec3, alpha: f64, on_disk: DiskPoint) -> Option<MicrofacetSample> {
    if to_eye.z <= 0.0 {
        return None;
    }
    let to_light = mirror_direction(-to_eye, visible_normal(to_eye, alpha, on_disk));
    let pdf = visible_pdf(to_light, to_eye, alpha);
    (to_light.z > 0.0 && pdf > 0.0).then(|| MicrofacetSample { to_light, pdf, weight: ggx_g1(to_light, alpha) })
}
// ANCHOR_END: ggx_sample

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::chi_squared::{Bins, p_value};
    use crate::measure::draws::Draws;
    use crate::measure::exact::{Dyadic, relative_error};
    use crate::measure::hemisphere::Quadrature;
    use crate::sample::disk_point;
    use std::f64::consts::{FRAC_PI_2, LN_2};

    const ALPHAS: [f64; 4] = [0.005, 0.05, 0.3, 1.0];
    const ANGLES: [f64; 4] = [0.0, 45.0, 80.0, 89.9];
    /// Grid lines along each axis over the slopes of microfacets.
    const LINES: usize = 24;

    fn eye_at(degrees: f64) -> DVec3 {
        let angle = degrees * PI / 180.0;
        DVec3::new(libm::sin(angle), 0.0, libm::cos(angle))
    }

    /// Grid lines over slopes, mapped so that all slopes lie from −1 to 1; with `cut`, one at the slope where
    /// visibility ends.
    ///
    /// In units of α the slopes are p and q, and the second coordinate is q / √(1 + p²), so that D is a product of the
    /// two.
    fn lines(cut: Option<f64>) -> Vec<f64> {
        let mut lines: Vec<f64> = (0..=LINES).map(|at| 2.0 * at as f64 / LINES as f64 - 1.0).collect();
        lines.extend(cut);
        lines.sort_by(f64::total_cmp);
        lines
    }

    /// The mapped slope of a microfacet that is edge-on to the eye.
    fn edge_on(eye: DVec3, alpha: f64) -> Option<f64> {
        (eye.x > 0.0).then(|| mapped(-eye.z / eye.x / alpha))
    }

    fn mapped(slope: f64) -> f64 {
        libm::atan(slope) / FRAC_PI_2
    }

    /// ∫ f(h) dω over the microfacet normals in a cell of the grid.
    fn over_cell(rule: &Quadrature, alpha: f64, [x, y]: [[f64; 2]; 2], f: impl Fn(DVec3) -> f64) -> f64 {
        rule.sum(x[0], x[1], |a| {
            rule.sum(y[0], y[1], |b| {
                let (p, beside) = (libm::tan(FRAC_PI_2 * a), libm::tan(FRAC_PI_2 * b));
                let steep = (1.0 + p * p).sqrt();
                let half = DVec3::new(-alpha * p, -alpha * beside * steep, 1.0).normalize();
                let slopes = FRAC_PI_2 * FRAC_PI_2 * (1.0 + p * p) * (1.0 + beside * beside) * steep;
                f(half) * half.z * half.z * half.z * alpha * alpha * slopes
            })
        })
    }

    /// The sum over all cells.
    fn over_all(alpha: f64, cut: Option<f64>, f: impl Fn(DVec3) -> f64) -> f64 {
        let (rule, x, y) = (Quadrature::default(), lines(cut), lines(None));
        let cells = x.windows(2).flat_map(|x| y.windows(2).map(move |y| [[x[0], x[1]], [y[0], y[1]]]));
        cells.map(|cell| over_cell(&rule, alpha, cell, &f)).sum()
    }

    #[test]
    fn microfacets_cover_the_surface_and_visible_ones_cover_its_projection() {
        let mut worst = 0.0_f64;
        for alpha in ALPHAS {
            let whole = over_all(alpha, None, |half| ggx_d(half, alpha) * half.z);
            assert!((whole - 1.0).abs() < 1e-5, "α {alpha}: {whole}");
            for angle in ANGLES {
                let eye = eye_at(angle);
                let scale = ggx_g1(eye, alpha) / eye.z;
                let seen =
                    over_all(alpha, edge_on(eye, alpha), |half| scale * eye.dot(half).max(0.0) * ggx_d(half, alpha));
                worst = worst.max((seen - 1.0).abs());
                assert!((seen - 1.0).abs() < 1e-5, "α {alpha}, {angle}°: {seen}");
                let lambda = ggx_lambda(eye, alpha);
                assert!((ggx_g1(eye, alpha) * (1.0 + lambda) - 1.0).abs() < 1e-12, "G₁ and Λ disagree at {angle}°");
            }
        }
        eprintln!("microfacets: {} integrals over all normals, worst {worst:.1e} from 1", 5 * ALPHAS.len());
    }

    #[test]
    fn directions_have_their_pdf() {
        const SAMPLES: u64 = 100_000;
        for (which, alpha) in ALPHAS.into_iter().enumerate() {
            for (other, angle) in ANGLES.into_iter().enumerate() {
                let eye = eye_at(angle);
                let (x, y) = (lines(edge_on(eye, alpha)), lines(None));
                let rule = Quadrature::default();
                let mut bins = Bins::new((x.len() - 1) * (y.len() - 1));
                let bin = |column: usize, row: usize| column * (y.len() - 1) + row;
                for (column, x) in x.windows(2).enumerate() {
                    for (row, y) in y.windows(2).enumerate() {
                        // The Jacobian of reflection: dω of directions is 4 (v · h) dω of normals.
                        let pdf = |half: DVec3| match eye.dot(half) {
                            facing if facing > 0.0 => {
                                visible_pdf(mirror_direction(-eye, half), eye, alpha) * 4.0 * facing
                            }
                            _ => 0.0,
                        };
                        let fraction = over_cell(&rule, alpha, [[x[0], x[1]], [y[0], y[1]]], pdf);
                        bins.expect(bin(column, row), fraction * SAMPLES as f64);
                    }
                }
                assert!((bins.total() / SAMPLES as f64 - 1.0).abs() < 1e-5, "α {alpha}, {angle}°: {}", bins.total());
                for index in 0..SAMPLES {
                    let mut draws = Draws::new((1930 + 4 * which + other) as u64, index);
                    let half = visible_normal(eye, alpha, disk_point([draws.unit(), draws.unit()]));
                    let half = (mirror_direction(-eye, half) + eye).normalize();
                    let place = |lines: &[f64], slope: f64| {
                        lines.partition_point(|line| *line <= mapped(slope)).clamp(1, lines.len() - 1) - 1
                    };
                    let (p, q) = (-half.x / half.z / alpha, -half.y / half.z / alpha);
                    bins.count(bin(place(&x, p), place(&y, q / (1.0 + p * p).sqrt())));
                }
                let (statistic, freedom) = bins.statistic();
                let p = p_value(statistic, freedom);
                eprintln!("ggx α {alpha}, {angle}°: chi squared {statistic:.1} of {freedom}, p {p:.3}");
                assert!(p > 1e-3, "α {alpha}, {angle}°: χ² {statistic} of {freedom}");
            }
        }
    }

    /// Exchanging light and eye gives the same bits.
    #[test]
    fn rough_metal_is_reciprocal() {
        for index in 0..20_000 {
            let mut draws = Draws::new(1935, index);
            let alpha = draws.power_of_ten(-3.0, 0.0);
            let mut direction = || {
                let direction = draws.unit_vector();
                DVec3::new(direction.x, direction.y, direction.z.abs())
            };
            let (light, eye) = (direction(), direction());
            let there = ggx_brdf(light, eye, alpha);
            assert_eq!(there.to_bits(), ggx_brdf(eye, light, alpha).to_bits(), "{index}");
            let by_parts = ggx_d((light + eye).normalize(), alpha) * ggx_g1(light, alpha) * ggx_g1(eye, alpha);
            let by_parts = by_parts / (4.0 * light.z * eye.z);
            assert!((there - by_parts).abs() <= 1e-12 * there, "{index}: {there} {by_parts}");
        }
        eprintln!("ggx: 20000 pairs of directions, reciprocal bit for bit");
    }

    /// Weight times pdf is the BRDF times the cosine.
    #[test]
    fn weights_are_brdf_times_cosine_over_pdf() {
        let mut tried = 0;
        for index in 0..20_000 {
            let mut draws = Draws::new(1936, index);
            let (alpha, eye) = (draws.power_of_ten(-3.0, 0.0), eye_at(draws.between(0.0, 89.99)));
            let Some(microfacet_sample) = ggx_sample(eye, alpha, disk_point([draws.unit(), draws.unit()])) else {
                continue;
            };
            let sent = ggx_brdf(microfacet_sample.to_light, eye, alpha) * microfacet_sample.to_light.z;
            assert!((microfacet_sample.weight * microfacet_sample.pdf / sent - 1.0).abs() < 1e-9, "{index}");
            tried += 1;
        }
        eprintln!("ggx: {tried} weights × pdfs against the BRDF");
        assert!(tried > 15_000);
    }

    /// The furnace test: under uniform radiance 1, metal of reflectance 1 loses only what hits a second microfacet; at
    /// α = 1 and normal incidence it reflects 1 − ln 2, and never more than 1.
    #[test]
    fn furnace() {
        const SAMPLES: u64 = 200_000;
        for alpha in [1e-3, 0.05, 0.3, 1.0] {
            for angle in ANGLES {
                let (mut sum, mut squares) = (0.0, 0.0);
                for index in 0..SAMPLES {
                    let mut draws = Draws::new(1937, index);
                    let microfacet_sample = ggx_sample(eye_at(angle), alpha, disk_point([draws.unit(), draws.unit()]));
                    let weight = microfacet_sample.map_or(0.0, |microfacet_sample| microfacet_sample.weight);
                    assert!((0.0..=1.0).contains(&weight));
                    (sum, squares) = (sum + weight, squares + weight * weight);
                }
                let mean = sum / SAMPLES as f64;
                let error = ((squares / SAMPLES as f64 - mean * mean).max(0.0) / SAMPLES as f64).sqrt();
                assert!(mean <= 1.0 + 4.0 * error, "α {alpha}, {angle}°: {mean}");
                if (alpha, angle) == (1.0, 0.0) {
                    assert!((mean - (1.0 - LN_2)).abs() <= 4.0 * error && error < 0.01 * mean, "{mean} ± {error}");
                    eprintln!("furnace: {mean:.5} ± {error:.5}, 1 − ln 2 = {:.5}", 1.0 - LN_2);
                }
                let rule = Quadrature::default();
                let radians = angle * PI / 180.0;
                if alpha >= 0.3 && angle < 85.0 {
                    let summed = rule.albedo(radians, alpha, |light, eye| ggx_brdf(light, eye, alpha));
                    assert!((mean - summed).abs() <= 4.0 * error + 1e-4, "α {alpha}, {angle}°: {mean} {summed}");
                }
            }
        }
    }

    #[test]
    fn normals_against_exact_arithmetic() {
        let mut worst = 0.0_f64;
        for index in 0..4000 {
            let mut draws = Draws::new(1938, index);
            let alpha = draws.power_of_ten(-4.0, 0.0);
            let across = draws.unit_vector_across(DVec3::Z);
            let half = (DVec3::Z + across * alpha * draws.power_of_ten(-3.0, 3.0)).normalize();
            let [a, x, y, z] = [alpha, half.x, half.y, half.z].map(Dyadic::of);
            // π α² e² D = 1 with α² e = x² + y² + α² z², all exact except for one rounding of π.
            let sum = &(&x.squared() + &y.squared()) + &(&a.squared() * &z.squared());
            let exact = a.squared().divided_by(&sum.squared());
            worst = worst.max(relative_error(ggx_d(half, alpha) * PI, &exact));
        }
        eprintln!("D: 4000 normals, α from 1e-4 to 1, worst relative error {worst:.1e}");
        assert!(worst < 1e-14, "{worst}");
    }

    #[test]
    fn extreme_numbers_give_finite_samples() {
        const LAST: f64 = 1.0 - 1.0 / (1 << 24) as f64;
        let corners = [0.0, 1.0 / (1 << 24) as f64, 0.5, LAST];
        let mut tried = 0;
        for alpha in [1e-3, 0.005, 0.3, 1.0] {
            for angle in [0.0, 1e-7, 45.0, 80.0, 89.9, 89.999_999, 90.0, 120.0] {
                let eye = eye_at(angle);
                let eye = if angle == 90.0 { DVec3::X } else { eye };
                for numbers in corners.into_iter().flat_map(|u| corners.map(|v| [u, v])) {
                    tried += 1;
                    if eye.z >= 0.0 {
                        let half = visible_normal(eye, alpha, disk_point(numbers));
                        assert!(half.z > 0.0 && (half.length() - 1.0).abs() < 1e-14, "{alpha} {angle} {numbers:?}");
                        assert!(visible_pdf(mirror_direction(-eye, half), eye, alpha).is_finite());
                    }
                    let Some(microfacet_sample) = ggx_sample(eye, alpha, disk_point(numbers)) else { continue };
                    assert!(
                        microfacet_sample.to_light.is_finite() && microfacet_sample.to_light.z > 0.0 && eye.z > 0.0
                    );
                    assert!(
                        microfacet_sample.pdf > 0.0 && microfacet_sample.pdf.is_finite(),
                        "{alpha} {angle} {numbers:?}"
                    );
                    assert!((0.0..=1.0).contains(&microfacet_sample.weight));
                    assert!(ggx_brdf(microfacet_sample.to_light, eye, alpha).is_finite());
                }
            }
        }
        assert_eq!(ggx_brdf(-DVec3::Z, DVec3::Z, 0.3), 0.0);
        assert_eq!([ggx_g1(DVec3::X, 0.3), ggx_g1(-DVec3::Z, 0.3), ggx_g1(DVec3::Z, 0.3)], [0.0, 0.0, 1.0]);
        eprintln!("ggx: {tried} of the hardest numbers, all finite");
    }
}
