//! The kit's sphere method on trial: prototypes beside the oracle, over every class of hard ray.
//!
//! `PINHOLE_TRIAL_RAYS=1000000 cargo test --release --lib trial -- --nocapture` runs it in full.

use super::exact::{UNIT_ROUNDOFF_F32 as U, relative_error};
use super::oracle_sphere::{Sphere, sphere_hit};
use super::ray_aim::{self, AimedRay};
use crate::naive;
use glam::DVec3;

/// How many rays a trial takes: few in a plain test run, as many as the environment says in a full
/// one.
pub fn trial_rays(few: u64) -> u64 {
    let asked = std::env::var("PINHOLE_TRIAL_RAYS").ok();
    asked.and_then(|rays| rays.parse().ok()).unwrap_or(few)
}

/// What a method says: the nearest t > 0, and whether it asked for the wide path.
pub type Verdict = (Option<f64>, bool);

/// The halves of a product or a sum that together are exact.
pub type Wide = (f64, f64);

/// a + b without any error (Knuth).
pub fn wide_sum(a: f64, b: f64) -> Wide {
    let sum = a + b;
    let b_seen = sum - a;
    (sum, (a - (sum - b_seen)) + (b - b_seen))
}

/// a · b without any error (Dekker), by cutting each factor into halves of 26 bits.
pub fn wide_product(a: f64, b: f64) -> Wide {
    let halves = |x: f64| {
        let scaled = x * 134_217_729.0;
        let high = scaled - (scaled - x);
        (high, x - high)
    };
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (halves(a), halves(b));
    let error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
    (product, error)
}

/// The sum of two wide numbers, rounded at 2^-104 of the larger one.
pub fn add(a: Wide, b: Wide) -> Wide {
    let (sum, error) = wide_sum(a.0, b.0);
    let (low, lower) = wide_sum(a.1, b.1);
    let (sum, error) = wide_sum(sum, error + low);
    wide_sum(sum, error + lower)
}

/// The product of two wide numbers, rounded at 2^-104.
fn multiply(a: Wide, b: Wide) -> Wide {
    let (product, error) = wide_product(a.0, b.0);
    wide_sum(product, error + (a.0 * b.1 + a.1 * b.0))
}

fn wide_dot(a: [Wide; 3], b: [Wide; 3]) -> Wide {
    add(add(multiply(a[0], b[0]), multiply(a[1], b[1])), multiply(a[2], b[2]))
}

pub fn negated(a: Wide) -> Wide {
    (-a.0, -a.1)
}

/// The quadratic in pairs of f64, about 106 bits: b² − a c needs no perpendicular form here.
fn wide_hit(ray: AimedRay, sphere: Sphere) -> Option<f64> {
    let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let d = direction.to_array().map(|x| (x, 0.0));
    let f = [0, 1, 2].map(|i| wide_sum(sphere.centre[i], -origin[i]));
    let (a, b) = (wide_dot(d, d), wide_dot(f, d));
    let c = add(wide_dot(f, f), negated(wide_product(sphere.radius, sphere.radius)));
    let discriminant = add(multiply(b, b), negated(multiply(a, c))).0;
    if discriminant < 0.0 || a.0 == 0.0 {
        return None;
    }
    let larger = b.0 + b.0.signum() * discriminant.sqrt();
    let (outer, inner) = (larger / a.0, c.0 / larger);
    [outer.min(inner), outer.max(inner)].into_iter().find(|t| *t > 0.0)
}

/// How the near root is found once s, the foot of the perpendicular, and h, half the chord, are
/// known.
#[derive(Clone, Copy, Debug)]
pub enum Root {
    /// s − h.
    Difference,
    /// (f·f − r²) / (d·d (s + h)).
    SquaresOverSum,
    /// (|f| − r)(|f| + r) / (d·d (s + h)).
    FactorsOverSum,
}

/// The perpendicular form in f64, and whether its error bound leaves the verdict or t in doubt.
pub fn perpendicular_hit(ray: AimedRay, sphere: Sphere, root: Root) -> Verdict {
    let (d, r) = (ray.direction.as_dvec3(), sphere.radius);
    let f = sphere.centre - ray.origin.as_dvec3();
    let (dd, ff) = (d.dot(d), f.dot(f));
    let s = f.dot(d) / dd;
    let passing: DVec3 = f - d * s;
    let ll = passing.dot(passing);
    let discriminant = r * r - ll;
    // With ε = 2^-53, f and s·d are each rounded by ε|f| and their difference by ε|l|, the error of
    // s moves the foot along d only, and the squares add 3ε l² + ε r²: at most 9ε |f||l| + ε r² in
    // all, and 50 ε² f² of second order.
    let bound = 2f64.powi(-50) * (2.0 * ff * (r * r + ll + 2f64.powi(-100) * ff)).sqrt();
    if discriminant < 0.0 {
        return (None, -discriminant <= bound);
    }
    let h = (discriminant / dd).sqrt();
    let c = match root {
        Root::FactorsOverSum => (ff.sqrt() - r) * (ff.sqrt() + r),
        _ => ff - r * r,
    };
    let t = match (c > 0.0, s > 0.0) {
        (true, false) => return (None, c <= bound),
        (true, true) if matches!(root, Root::Difference) => s - h,
        (true, true) => c / (dd * (s + h)),
        (false, true) => s + h,
        (false, false) => c / (dd * (s - h)),
    };
    // The chord's part of t's error is bound / (2 h dd), and c's is at most as large, because
    // t = c / (dd (s + h)); a c whose sign is in doubt may name the wrong root altogether.
    let doubtful = bound >= (U * dd * t * h).min(c.abs());
    (Some(t), doubtful)
}

/// The perpendicular form, and the wide quadratic where its own bound says that it may be wrong.
pub fn guarded_hit(ray: AimedRay, sphere: Sphere) -> Verdict {
    match perpendicular_hit(ray, sphere, Root::SquaresOverSum) {
        (_, true) => (wide_hit(ray, sphere), true),
        sure => sure,
    }
}

/// What a method did over one class of rays.
#[derive(Default)]
struct Score {
    hits: u64,
    misjudged: u64,
    doubtful: u64,
    worst: f64,
}

fn score(rays: u64, case: impl Fn(u64) -> (AimedRay, Sphere), method: impl Fn(AimedRay, Sphere) -> Verdict) -> Score {
    let mut score = Score::default();
    for index in 0..rays {
        let (ray, sphere) = case(index);
        let exact = sphere_hit(ray.origin, ray.direction, sphere);
        let (verdict, doubtful) = method(ray, sphere);
        score.hits += u64::from(exact.is_some());
        score.doubtful += u64::from(doubtful);
        score.misjudged += u64::from(exact.is_some() != verdict.is_some());
        if let (Some(exact), Some(t)) = (exact, verdict) {
            score.worst = score.worst.max(relative_error(t, &exact) / U);
        }
    }
    score
}

/// Puts the methods side by side on one class; the guarded one is to judge every ray rightly, with
/// t within u.
fn compare(name: &str, rays: u64, case: impl Fn(u64) -> (AimedRay, Sphere) + Copy) -> u64 {
    let plain = |ray: AimedRay, sphere: Sphere| {
        (naive::sphere::hit_f64_plain(ray.origin, ray.direction, sphere.centre, sphere.radius), false)
    };
    let perpendicular = |root| move |ray, sphere| perpendicular_hit(ray, sphere, root);
    let plain = score(rays, case, plain);
    let difference = score(rays, case, perpendicular(Root::Difference));
    let squares = score(rays, case, perpendicular(Root::SquaresOverSum));
    let factors = score(rays, case, perpendicular(Root::FactorsOverSum));
    let guarded = score(rays, case, guarded_hit);
    eprintln!("{name}: {rays} rays, {} hits; misjudged, worst t in u", guarded.hits);
    for (method, s) in [
        ("plain b2-ac", &plain),
        ("s-h", &difference),
        ("squares/(s+h)", &squares),
        ("factors/(s+h)", &factors),
        ("guarded", &guarded),
    ] {
        eprintln!("  {method:14} {:6} {:9.3e}  wide {:.4}", s.misjudged, s.worst, s.doubtful as f64 / rays as f64);
    }
    assert_eq!(guarded.misjudged, 0, "{name}");
    assert!(guarded.worst <= 1.0, "{name}");
    plain.misjudged
}

#[test]
fn trial_of_the_sphere_methods() {
    let rays = trial_rays(1000);
    for distance in [1e3, 1e5, 1e7] {
        let name = format!("silhouette at {distance:e} radii");
        let plain = compare(&name, rays, |index| ray_aim::silhouette(21, index, distance));
        assert!(distance < 1e7 || rays < 1000 || plain > 0, "the plain method is expected to break");
    }
    compare("horizon, radius 1e6, height 1", rays, |index| ray_aim::horizon(22, index, 1e6, 1.0));
    compare("horizon, radius 1e8, height 1e-2", rays, |index| ray_aim::horizon(23, index, 1e8, 1e-2));
    compare("disc, radius 1e6, height 1", rays, |index| ray_aim::disc(24, index, 1e6, 1.0 + 1e-6));
    compare("tangent at 1e3 radii", rays, |index| ray_aim::tangent(25, index, 1.0, 1e3));
    compare("tangent at 1.5 radii", rays, |index| ray_aim::tangent(26, index, 1.0, 1.5));
    compare("centre at 1e5 radii", rays, |index| ray_aim::centre(27, index, 1.0, 1e5));
    compare("any size, seen", rays, |index| ray_aim::seen_sphere_of_any_size(28, index));
    compare("any size and place", rays, |index| ray_aim::sphere_of_any_size(29, index));
}
