//! What highlights send on of the light that falls on them, summed over all directions by quadrature.

use super::{Group, Method, Tally, Trial};
use crate::measure::draws::Draws;
use crate::measure::hemisphere::Quadrature;
use crate::naive::light::{phong_without_factor, short_blinn_phong_peak};
use glam::DVec3;
use pinhole::material::{blinn_phong_peak, half_vector_cosine, highlight, mirror_cosine, phong_peak};
use std::ops::Range;

/// How far a sum by quadrature may be off.
const OFF: f64 = 1e-9;

const SQUARE: [Method; 4] = [
    Method::pinhole("pinhole, Phong", "off 1", OFF),
    Method::pinhole("pinhole, Blinn-Phong", "off 1", OFF),
    Method::naive("naive, Phong without a factor", "off 1", OFF),
    Method::naive("naive, Blinn-Phong, (n + 8) / 8 pi", "off 1", OFF),
];
const ANY_ANGLE: [Method; 4] = [
    Method::pinhole("pinhole, Phong", "over 1", OFF),
    Method::pinhole("pinhole, Blinn-Phong", "over 1", OFF),
    Method::naive("naive, Phong, cosine forgotten", "over 1", OFF),
    Method::naive("naive, Blinn-Phong, (n + 8) / 8 pi", "over 1", OFF),
];

/// The cases, those of one exponent first.
pub fn trials() -> Vec<Trial> {
    let square = |(name, exponent)| {
        Trial::new(Group::Light, name, &SQUARE, move |range| check_square(exponent, range)).at_most(1)
    };
    let exponents = [
        ("albedo of a highlight lit along the normal, n = 1", 1.0),
        ("albedo of a highlight lit along the normal, n = 10", 10.0),
        ("albedo of a highlight lit along the normal, n = 100", 100.0),
        ("albedo of a highlight lit along the normal, n = 1e6", 1e6),
    ];
    let any_angle = "albedo of a highlight lit obliquely, n = 0.1 to 1e6";
    let mut trials: Vec<Trial> = exponents.into_iter().map(square).collect();
    trials.push(Trial::new(Group::Light, any_angle, &ANY_ANGLE, check_any_angle).at_most(100));
    trials
}

/// About how wide a lobe is.
fn width(exponent: f64) -> f64 {
    1.0 / libm::sqrt(exponent + 1.0)
}

fn phong(exponent: f64) -> impl Fn(DVec3, DVec3) -> f64 {
    move |to_light, to_eye| highlight(phong_peak(exponent), exponent, mirror_cosine(DVec3::Z, to_light, to_eye))
}

fn blinn_phong(peak: f64, exponent: f64) -> impl Fn(DVec3, DVec3) -> f64 {
    move |to_light, to_eye| highlight(peak, exponent, half_vector_cosine(DVec3::Z, to_light, to_eye))
}

fn check_square(exponent: f64, range: Range<u64>) -> Tally {
    let (mut tally, quadrature) = (Tally::new(SQUARE.len()), Quadrature::default());
    for _ in range {
        tally.count(true);
        let without = |l, v| phong_without_factor(exponent, mirror_cosine(DVec3::Z, l, v));
        let albedos = [
            quadrature.albedo(0.0, width(exponent), phong(exponent)),
            quadrature.albedo(0.0, width(exponent), blinn_phong(blinn_phong_peak(exponent), exponent)),
            quadrature.albedo(0.0, width(exponent), without),
            quadrature.albedo(0.0, width(exponent), blinn_phong(short_blinn_phong_peak(exponent), exponent)),
        ];
        for (score, albedo) in tally.scores.iter_mut().zip(albedos) {
            score.measure((albedo - 1.0).abs());
        }
    }
    tally
}

fn check_any_angle(range: Range<u64>) -> Tally {
    let (mut tally, quadrature) = (Tally::new(ANY_ANGLE.len()), Quadrature::default());
    for index in range {
        let mut draws = Draws::new(405, index);
        let exponent = draws.power_of_ten(-1.0, 6.0);
        let angle = std::f64::consts::FRAC_PI_2 - draws.power_of_ten(-4.0, 0.19);
        tally.count(true);
        let of_phong = quadrature.albedo(angle, width(exponent), phong(exponent));
        let albedos = [
            of_phong,
            quadrature.albedo(angle, width(exponent), blinn_phong(blinn_phong_peak(exponent), exponent)),
            // Sent on of the light that would fall on it at normal incidence, over what does fall on it.
            of_phong / libm::cos(angle),
            quadrature.albedo(angle, width(exponent), blinn_phong(short_blinn_phong_peak(exponent), exponent)),
        ];
        for (score, albedo) in tally.scores.iter_mut().zip(albedos) {
            score.measure((albedo - 1.0).max(0.0));
        }
    }
    tally
}
