//! The kit's plane method on trial, beside the oracle.

use super::exact::{UNIT_ROUNDOFF_F32 as U, relative_error};
use super::oracle_plane::{Plane, plane_hit};
use super::ray_aim::{AimedRay, plane_of_any_offset};
use super::sphere_trial::{add, trial_rays, wide_product};
use glam::DVec3;

/// |x| + |y| + |z|.
pub fn norm_1(v: DVec3) -> f64 {
    v.x.abs() + v.y.abs() + v.z.abs()
}

/// (offset − normal · origin) / (normal · direction) in f64, nothing more.
pub fn plain_plane(ray: AimedRay, plane: Plane) -> Option<f64> {
    let distance = plane.offset - plane.normal.dot(ray.origin.as_dvec3());
    let t = distance / plane.normal.dot(ray.direction.as_dvec3());
    (t > 0.0 && t.is_finite()).then_some(t)
}

/// offset − normal · point and normal · direction in f64, and in pairs of f64 where their sign is
/// in doubt.
pub fn guarded_plane(ray: AimedRay, plane: Plane) -> Option<f64> {
    let reach = |v: DVec3, rest: f64| {
        let terms = plane.normal * v;
        let plain = rest + (terms.x + terms.y + terms.z);
        // Three products and three sums are each rounded by ε of at most the sum of all magnitudes.
        if plain.abs() > 2f64.powi(-24) * (rest.abs() + norm_1(terms)) {
            return plain;
        }
        let wide = [0, 1, 2].map(|i| wide_product(plane.normal[i], v[i]));
        let sum = add(add((rest, 0.0), wide[0]), add(wide[1], wide[2]));
        sum.0
    };
    let distance = -reach(ray.origin.as_dvec3(), -plane.offset);
    let approach = reach(ray.direction.as_dvec3(), 0.0);
    let t = distance / approach;
    (t > 0.0 && t.is_finite()).then_some(t)
}

fn compare(name: &str, rays: u64, case: impl Fn(u64) -> (AimedRay, Plane)) {
    let (mut hits, mut misjudged, mut worst) = (0u64, [0u64; 2], [0.0f64; 2]);
    for index in 0..rays {
        let (ray, plane) = case(index);
        let exact = plane_hit(ray.origin, ray.direction, plane);
        hits += u64::from(exact.is_some());
        let verdicts = [plain_plane(ray, plane), guarded_plane(ray, plane)];
        for (method, verdict) in verdicts.into_iter().enumerate() {
            misjudged[method] += u64::from(exact.is_some() != verdict.is_some());
            if let (Some(exact), Some(t)) = (&exact, verdict) {
                worst[method] = worst[method].max(relative_error(t, exact) / U);
            }
        }
    }
    eprintln!("{name}: {rays} rays, {hits} hits");
    for (method, name) in ["f64", "guarded"].into_iter().enumerate() {
        let (misjudged, worst) = (misjudged[method], worst[method]);
        eprintln!("  {name:8} {misjudged:6} misjudged, t within {worst:.3e} u");
    }
    assert_eq!(misjudged[1], 0, "{name}");
    assert!(worst[1] <= 1.0, "{name}");
}

#[test]
fn trial_of_the_plane_methods() {
    let rays = trial_rays(1000);
    for flattest in [0.0, 4.0, 8.0, 12.0] {
        let name = format!("planes of any offset, slope from 1e-{flattest}");
        compare(&name, rays, |index| plane_of_any_offset(51, index, flattest));
    }
}
