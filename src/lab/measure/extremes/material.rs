//! Mirrors, glass and rough metal: media that are nearly one, angles at which all is reflected, highlights of any width.

use super::{Group, Method, Tally, Trial};
use crate::measure::draws::Draws;
use crate::measure::exact::{Dyadic, UNIT_ROUNDOFF_F32 as U};
use crate::measure::hemisphere::Quadrature;
use crate::naive::material::{
    frame_by_division_f32, fresnel_by_sines_f32, ggx_brdf_unmasked, ggx_d_f32, refract_unchecked, schlick,
};
use glam::{DVec3, Vec3};
use pinhole::material::{
    Bsdf, MetalTable, MultipleScattering, Parameters, ShadingContext, cosine_direction, frame_of, fresnel, ggx_brdf,
    ggx_d, ggx_sample, refract, visible_normal, visible_pdf,
};
use pinhole::sample::disk_point;
use std::f64::consts::{FRAC_PI_2, LN_2};
use std::ops::Range;

const FACING: [Method; 2] = [
    Method::pinhole("pinhole, a sum of squares", "of itself", 1e-6),
    Method::naive("naive, textbook in f32", "of itself", 1e-6),
];
const DENSER: [Method; 3] = [
    Method::pinhole("pinhole, by g", "of all", 3e-7),
    Method::naive("naive, by sines in f32", "of all", 3e-7),
    Method::naive("naive, Schlick", "of all", 3e-7),
];
const THINNER: [Method; 3] = [
    Method::pinhole("pinhole, by g", "of all", 5e-6),
    Method::naive("naive, by sines in f32", "of all", 5e-6),
    Method::naive("naive, Schlick", "of all", 5e-6),
];
const CRITICAL: [Method; 2] =
    [Method::pinhole("pinhole, by g", "of all", 3e-4), Method::naive("naive, by sines in f32", "of all", 3e-4)];
const BENT: [Method; 2] =
    [Method::pinhole("pinhole", "of the sine", 1e-12), Method::naive("naive, root unchecked", "of the sine", 1e-12)];
const FRAME: [Method; 2] =
    [Method::pinhole("pinhole, Duff and others", "u", 4.0), Method::naive("naive, Frisvad in f32", "u", 4.0)];
const NORMAL_INCIDENCE: [Method; 2] =
    [Method::pinhole("pinhole", "off 1 - ln 2", 1e-6), Method::naive("naive, no masking", "off 1 - ln 2", 1e-6)];
const OVER: [Method; 2] =
    [Method::pinhole("pinhole", "over 1", 1e-6), Method::naive("naive, no masking", "over 1", 1e-6)];
const WHOLE: [Method; 2] = [
    Method::pinhole("pinhole, multiple scattering", "off 1", 1e-2),
    Method::naive("naive, single scattering", "off 1", 1e-2),
];
const NUMBERS: [Method; 1] = [Method::pinhole("pinhole", "", 0.0)];

/// The cases of the group.
pub fn trials() -> Vec<Trial> {
    let one =
        |name, methods: &[Method], check: fn(Range<u64>) -> Tally| Trial::new(Group::Material, name, methods, check);
    vec![
        one("facing of microfacets, alpha 1e-4 to 1", &FACING, check_facing),
        one("fresnel, a medium denser by 1e-7 to 30", &DENSER, |range| check_fresnel(range, false)),
        one("fresnel, a thinner medium off the critical angle", &THINNER, |range| check_fresnel(range, true)),
        one("fresnel within 200 steps of f32 of the critical angle", &CRITICAL, check_critical),
        one("refraction at any angle, into denser and thinner", &BENT, check_bent),
        one("frames about normals near -z", &FRAME, check_frames),
        one("furnace, rough metal at normal incidence, alpha 1", &NORMAL_INCIDENCE, check_normal_incidence).at_most(1),
        one("furnace, rough metal at any angle, alpha 0.05 to 1", &OVER, check_any_angle).at_most(60),
        one("furnace, multiple scattering at any angle, alpha 0.05 to 1", &WHOLE, check_several).at_most(40),
        one("directions by numbers at their ends", &NUMBERS, check_numbers),
    ]
}

/// Facings of f32: x and y are what they are, and z follows, exactly for the oracle.
fn check_facing(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(FACING.len());
    for index in range {
        let mut draws = Draws::new(1901, index);
        let alpha = (draws.power_of_ten(-4.0, 0.0) as f32).clamp(1e-4, 1.0);
        let across = draws.unit_vector_across(DVec3::Z) * f64::from(alpha) * draws.power_of_ten(-2.0, 1.0);
        let (x, y) = (across.x as f32, across.y as f32);
        let planar = f64::from(x) * f64::from(x) + f64::from(y) * f64::from(y);
        tally.count(planar < 0.9);
        if planar >= 0.9 {
            continue;
        }
        let [a, ex, ey, one] = [f64::from(alpha), f64::from(x), f64::from(y), 1.0].map(Dyadic::of);
        let across_squared = &ex.squared() + &ey.squared();
        let sum = &across_squared + &(&a.squared() * &(&one - &across_squared));
        let exact = a.squared().divided_by(&sum.squared()).to_f64() / std::f64::consts::PI;
        let half = DVec3::new(x.into(), y.into(), (1.0 - planar).sqrt());
        tally.scores[0].measure((ggx_d(half, alpha.into()) / exact - 1.0).abs());
        let naive = f64::from(ggx_d_f32(half.z as f32, alpha));
        tally.scores[1].measure((naive / exact - 1.0).abs());
    }
    tally
}

/// The Fresnel reflectance in exact arithmetic but for roots and quotients below 2⁻³⁰⁰: r_s = (c − g)/(c + g) and
/// r_p = (η²c − g)/(η²c + g).
fn exact_fresnel(cosine: f64, eta: f64) -> f64 {
    let [c, eta, one] = [cosine, eta, 1.0].map(Dyadic::of);
    let squared = &(&eta.squared() - &one) + &c.squared();
    if squared.sign() < 0 {
        return 1.0;
    }
    let g = squared.square_root();
    let reflectance =
        |a: &Dyadic| if (a + &g).sign() == 0 { Dyadic::of(0.0) } else { (a - &g).divided_by(&(a + &g)).squared() };
    (&reflectance(&c) + &reflectance(&(&eta.squared() * &c))).scaled(-1).to_f64()
}

/// Every fourth time the two media are one, where nothing is reflected.
fn check_fresnel(range: Range<u64>, thinner: bool) -> Tally {
    let methods = if thinner { &THINNER } else { &DENSER };
    let mut tally = Tally::new(methods.len());
    for index in range {
        let mut draws = Draws::new(1902, index);
        let denser = match index % 4 {
            0 => 1.0,
            1 => 1.0 + draws.power_of_ten(-6.9, 0.0),
            _ => draws.power_of_ten(0.0, 1.5),
        };
        let eta = if thinner { 1.0 / denser } else { denser } as f32;
        let cosine = if index % 3 == 0 { draws.power_of_ten(-6.0, 0.0) } else { draws.unit() } as f32;
        let critical = (1.0 - f64::from(eta) * f64::from(eta)).max(0.0).sqrt();
        let apart = !thinner || (f64::from(cosine) - critical).abs() > 1e-2 * critical;
        tally.count(apart);
        if !apart {
            continue;
        }
        let (c, n) = (f64::from(cosine), f64::from(eta));
        let exact = exact_fresnel(c, n);
        tally.scores[0].check(n != 1.0 || fresnel(c, n) == 0.0);
        let naive = [f64::from(fresnel_by_sines_f32(cosine, eta)), schlick(c, n)];
        for (score, reflectance) in tally.scores.iter_mut().zip([fresnel(c, n), naive[0], naive[1]]) {
            score.measure((reflectance - exact).abs());
        }
    }
    tally
}

fn check_critical(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(CRITICAL.len());
    for index in range {
        let mut draws = Draws::new(1903, index);
        let eta = draws.between(0.05, 0.999) as f32;
        let critical = (1.0 - f64::from(eta) * f64::from(eta)).sqrt() as f32;
        let steps = draws.between(-200.0, 200.0) as i64;
        let cosine = f32::from_bits((i64::from(critical.to_bits()) + steps) as u32);
        tally.count(cosine <= 1.0);
        if cosine <= 1.0 {
            let (c, n) = (f64::from(cosine), f64::from(eta));
            let exact = exact_fresnel(c, n);
            tally.scores[0].measure((fresnel(c, n) - exact).abs());
            tally.scores[1].measure((f64::from(fresnel_by_sines_f32(cosine, eta)) - exact).abs());
        }
    }
    tally
}

/// A direction must come out where the exact g² is above 0 by more than rounding, none where it is below, and the sines
/// must keep to Snell's law.
fn check_bent(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(BENT.len());
    for index in range {
        let mut draws = Draws::new(1904, index);
        let eta = draws.power_of_ten(-0.7, 0.7);
        let normal = draws.unit_vector().normalize();
        let cosine = if index % 4 == 0 { draws.power_of_ten(-9.0, 0.0) } else { draws.unit() };
        let across = draws.unit_vector_across(normal);
        let direction = (across * (1.0 - cosine * cosine).sqrt() - normal * cosine).normalize();
        let cosine = direction.dot(normal);
        let squared = (eta - 1.0) * (eta + 1.0) + cosine * cosine;
        let (passes, uncertain) = (squared > 0.0, squared.abs() < 1e-14);
        tally.count(passes);
        let snell = |bent: DVec3| (bent.cross(normal) * eta - direction.cross(normal)).length();
        let pinhole = refract(direction, normal, eta);
        tally.scores[0].check(uncertain || pinhole.is_some() == passes);
        if let Some(bent) = pinhole {
            tally.scores[0].check(bent.is_finite() && bent.dot(normal) <= 0.0);
            tally.scores[0].measure(snell(bent));
        }
        let naive = refract_unchecked(direction, normal, eta);
        tally.scores[1].check(naive.is_finite());
        if naive.is_finite() {
            tally.scores[1].measure(snell(naive));
        }
    }
    tally
}

fn check_frames(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(FRAME.len());
    for index in range {
        let mut draws = Draws::new(1905, index);
        let across = draws.unit_vector_across(DVec3::Z) * draws.power_of_ten(-6.0, 0.0);
        let normal = (across - DVec3::Z).normalize();
        tally.count(true);
        let off = |x: DVec3, y: DVec3, z: DVec3| {
            let off = [x.dot(y), x.dot(z), y.dot(z), x.length_squared() - 1.0, y.length_squared() - 1.0];
            off.into_iter().fold(0.0_f64, |worst, off| worst.max(off.abs())) / U
        };
        let frame = frame_of(normal);
        tally.scores[0].measure(off(frame.x_axis, frame.y_axis, normal));
        let near: Vec3 = normal.as_vec3();
        let [x, y] = frame_by_division_f32(near).map(|axis| axis.as_dvec3());
        tally.scores[1].measure(off(x, y, near.as_dvec3()));
    }
    tally
}

fn check_normal_incidence(range: Range<u64>) -> Tally {
    let (mut tally, rule) = (Tally::new(NORMAL_INCIDENCE.len()), Quadrature::default());
    for _ in range {
        tally.count(true);
        let albedos = [ggx_brdf, ggx_brdf_unmasked].map(|brdf| rule.albedo(0.0, 0.5, |l, v| brdf(l, v, 1.0)));
        for (score, albedo) in tally.scores.iter_mut().zip(albedos) {
            score.measure((albedo - (1.0 - LN_2)).abs());
        }
    }
    tally
}

fn check_any_angle(range: Range<u64>) -> Tally {
    let (mut tally, rule) = (Tally::new(OVER.len()), Quadrature::default());
    for index in range {
        let mut draws = Draws::new(1906, index);
        let alpha = draws.power_of_ten(-1.3, 0.0);
        let angle = FRAC_PI_2 - draws.power_of_ten(-2.0, 0.19);
        tally.count(true);
        for (score, brdf) in tally.scores.iter_mut().zip([ggx_brdf, ggx_brdf_unmasked]) {
            score.measure((rule.albedo(angle, 0.5 * alpha, |l, v| brdf(l, v, alpha)) - 1.0).max(0.0));
        }
    }
    tally
}

fn check_several(range: Range<u64>) -> Tally {
    let (mut tally, rule) = (Tally::new(WHOLE.len()), Quadrature::default());
    for index in range {
        let mut draws = Draws::new(1908, index);
        let alpha = draws.power_of_ten(-1.3, 0.0);
        let angle = FRAC_PI_2 - draws.power_of_ten(-2.0, 0.19);
        tally.count(true);
        let mut several = MultipleScattering::default();
        several.push([1.0; 3], Some(alpha));
        for (score, several) in tally.scores.iter_mut().zip([Some(several), None]) {
            let parameters = Parameters { roughness: alpha, ..Parameters::coloured([1.0; 3]) };
            let (rough, context) = (MetalTable { several }, ShadingContext::opaque(0, parameters));
            score.measure((rule.albedo(angle, 0.5 * alpha, |l, v| rough.eval(&context, l, v)[0]) - 1.0).abs());
        }
    }
    tally
}

/// The ends of what random numbers may be, eyes along the surface and beneath it, every roughness.
fn check_numbers(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(NUMBERS.len());
    let ends = [0.0, U, 0.5, 1.0 - U];
    for index in range {
        let mut draws = Draws::new(1907, index);
        let numbers = [ends[index as usize % 4], ends[index as usize / 4 % 4]];
        let alpha = [1e-3, 0.01, 1.0, draws.power_of_ten(-3.0, 0.0)][index as usize / 16 % 4];
        let height = [draws.power_of_ten(-9.0, 0.0), 1.0, 0.0, -draws.unit()][index as usize / 64 % 4];
        let eye = (draws.unit_vector_across(DVec3::Z) * (1.0 - height * height).max(0.0).sqrt() + height * DVec3::Z)
            .normalize();
        tally.count(true);
        let score = &mut tally.scores[0];
        score.check(cosine_direction(numbers).z > 0.0);
        match ggx_sample(eye, alpha, disk_point(numbers)) {
            Some(microfacet_sample) => {
                let within = (0.0..=1.0).contains(&microfacet_sample.weight)
                    && microfacet_sample.pdf > 0.0
                    && microfacet_sample.pdf.is_finite();
                score.check(
                    eye.z > 0.0
                        && microfacet_sample.to_light.is_finite()
                        && microfacet_sample.to_light.z > 0.0
                        && within,
                );
                score.check(ggx_brdf(microfacet_sample.to_light, eye, alpha).is_finite());
            }
            None if eye.z >= 0.0 => {
                let half = visible_normal(eye, alpha, disk_point(numbers));
                score.check(half.z > 0.0 && half.is_finite() && visible_pdf(half, eye, alpha).is_finite());
            }
            None => {}
        }
    }
    tally
}
