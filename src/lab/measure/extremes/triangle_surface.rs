//! Surfaces of triangles: where the hit lies, its normal, and the shadow ray that leaves it.

use super::shadow_stages::{Shadow, ShadowStages, leaving};
use super::transform_surface::angles;
use super::triangle::{BESIDE, by_function};
use super::triangle_aim::{Corners, From, SampleLights, View, shot, triangle_table};
use super::{Group, Method, Tally, Trial};
use crate::measure::exact::UNIT_ROUNDOFF_F32 as U;
use crate::measure::exact_vector::ExactVector;
use crate::measure::oracle_triangle::{exact_normal, exact_weights, side_of_triangle, triangle_t};
use crate::measure::ray_aim::{AimedRay, Draws};
use crate::naive::shadow::{start_after_constant, start_at_hit, start_off_surface};
use crate::naive::triangle::normal_by_winding;
use glam::DVec3;
use pinhole::intersect::{Surface, shading_normal};
use pinhole::shapes::{TriangleHit, TriangleRow};
use std::cmp::Ordering;
use std::ops::Range;

const METHODS: [Method; 7] = [
    Method::pinhole("pinhole, shadow rays, bound of the hit", "", 0.0),
    Method::pinhole("pinhole, normal, angle to the exact one", "u", 2.0),
    Method::pinhole("pinhole, hit point, off the exact plane", "u(|p|)", 1.1),
    Method::naive("naive, at the hit", "", 0.0),
    Method::naive("naive, t > 1e-3", "", 0.0),
    Method::naive("naive, hit + 1e-4 n", "", 0.0),
    Method::naive("naive, (b-a) x (c-a), f32", "u", 2.0),
];
/// Points farther away than this are beyond what f32 can carry on from.
const FARTHEST: f32 = 1e30;

/// The seed of the case that is tried in full.
const ANY_PLACE: u64 = 242;

/// The cases.
pub fn trials() -> Vec<Trial> {
    let views = [
        ("leave, seen from the eye, any size", 0.0, SampleLights::Inside, From::Eye(3.0)),
        ("leave, any size and place 1e-8 to 1e8", 0.0, SampleLights::Inside, From::Anywhere(0.0)),
        ("leave, any place, slope from 1e-12", 0.0, SampleLights::Inside, From::Anywhere(12.0)),
        ("leave slivers, 1e-6 as high as long", 6.0, SampleLights::Inside, From::Anywhere(3.0)),
        ("leave, at edges", 0.0, SampleLights::Edge, From::Eye(3.0)),
    ];
    let trial = |(seed, (name, thinnest, aim, from)): (u64, (&str, f64, SampleLights, From))| {
        let view = View { seed, thinnest, aim, from };
        let trial = Trial::new(Group::Triangle, name, &METHODS, move |range| check(view, range));
        if seed == ANY_PLACE { trial } else { trial.at_most(BESIDE) }
    };
    let mut trials: Vec<Trial> = (241..).zip(views).map(trial).collect();
    let barycentrics =
        Trial::new(Group::Triangle, "barycentrics, slivers, any slope", &BARYCENTRICS, check_barycentrics);
    trials.push(barycentrics.at_most(BESIDE));
    trials
}

fn check(view: View, range: Range<u64>) -> Tally {
    let (mut tally, mut stages) = (Tally::new(METHODS.len()), ShadowStages::of_triangles());
    for index in range {
        let (ray, corners) = shot(view, index);
        stages.triangles(triangle_table([corners]));
        let surface = stages.surface(ray).map(|(_, surface)| surface);
        let surface = surface.filter(|surface| surface.position.abs().max_element() < FARTHEST);
        let mut draws = Draws::new(view.seed + 1000, index);
        let shadow = surface.and_then(|surface| {
            let size = TriangleRow::new(corners).size + surface.position.as_dvec3().length();
            let away = leaving(&mut draws, surface.normal, 6.0) * (size * draws.power_of_ten(-2.0, 3.0));
            Some((surface, stages.shadow(surface, surface.position.as_dvec3() + away)?))
        });
        tally.count(shadow.is_some());
        let Some((surface, shadow)) = shadow else { continue };
        tally.scores[0].check(is_left(ray, shadow, corners));
        check_normal(ray, corners, surface, &mut tally);
        let exact = ExactVector::of(exact_normal(corners));
        let above = exact.dot(&ExactVector::of(surface.position).minus(&ExactVector::of(corners[0]))).to_f64();
        let size = U * surface.position.as_dvec3().abs().element_sum() + f64::from(f32::from_bits(1));
        tally.scores[2].measure(above.abs() / exact.squared_length().sqrt() / size);
        let Surface { position, normal, .. } = surface;
        let starts = [start_at_hit(position), start_after_constant(position), start_off_surface(position, normal)];
        for (score, start) in tally.scores[3..6].iter_mut().zip(starts) {
            let t = triangle_t(start.origin, shadow.direction, corners);
            score.check(!t.is_some_and(|t| t > f64::from(start.t_min)));
        }
    }
    tally
}

/// Whether the shadow ray starts strictly on the viewer's side of the plane, and never hits the triangle again.
fn is_left(ray: AimedRay, shadow: Shadow, corners: Corners) -> bool {
    let Shadow { origin, direction, blocked, .. } = shadow;
    let hits = by_function(AimedRay { origin, direction }, &TriangleRow::new(corners)).is_finite();
    let side = side_of_triangle(ray.origin.as_dvec3(), corners);
    side != Ordering::Equal
        && side_of_triangle(origin.as_dvec3(), corners) == side
        && !hits
        && triangle_t(origin, direction, corners).is_none()
        && blocked.is_none()
}

/// The normal on the viewer's side; the naive one is told the side.
fn check_normal(ray: AimedRay, corners: Corners, surface: Surface, tally: &mut Tally) {
    let turn = if side_of_triangle(ray.origin.as_dvec3(), corners) == Ordering::Less { -1.0 } else { 1.0 };
    let truth = exact_normal(corners) * turn;
    let scaled = truth / truth.abs().max_element();
    let [a, b, c] = corners.map(|corner| corner.as_vec3());
    let naive = (b - a).cross(c - a).normalize_or_zero() * turn as f32;
    let exact = || Some(ExactVector::of(scaled));
    if let Some([pinhole, naive]) = angles([surface.normal, naive], None, exact) {
        tally.scores[1].measure(pinhole);
        tally.scores[6].measure(naive);
    } else {
        tally.scores[1].check(false);
    }
}

const BARYCENTRICS: [Method; 3] = [
    Method::pinhole("pinhole, each barycentric", "u", 1.0),
    Method::pinhole("pinhole, mean of three normals, its length", "u", 1.0),
    Method::naive("naive, barycentrics by areas from o + td", "u", 1.0),
];

/// The barycentric coordinates of the hit against the exact ones, absolute.
fn check_barycentrics(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(BARYCENTRICS.len());
    for index in range {
        let view = View { seed: 251, thinnest: 8.0, aim: SampleLights::Inside, from: From::Anywhere(9.0) };
        let (ray, corners) = shot(view, index);
        let triangle = TriangleRow::new(corners);
        let t = by_function(ray, &triangle);
        let truth = if t.is_finite() { exact_weights(ray.origin, ray.direction, triangle.corners) } else { None };
        tally.count(truth.is_some());
        let Some(truth) = truth else { continue };
        let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        let triangle_hit = TriangleHit::of(origin, direction, &triangle);
        let off =
            |barycentrics: [f64; 3]| barycentrics.iter().zip(truth).map(|(a, b)| (a - b).abs() / U).fold(0.0, f64::max);
        tally.scores[0].measure(off(triangle_hit.weights));
        let mut draws = Draws::new(252, index);
        let normals = [(); 3].map(|()| (DVec3::Z + draws.unit_vector() * 0.99).normalize());
        tally.scores[1].measure((shading_normal(&normals, &triangle_hit).length() - 1.0).abs() / U);
        tally.scores[2].measure(off(by_areas(origin + t * direction, &triangle)));
    }
    tally
}

/// The barycentric coordinates as areas about a point that was reached along the ray.
fn by_areas(point: DVec3, triangle: &TriangleRow) -> [f64; 3] {
    let [a, b, c] = triangle.corners;
    let normal = normal_by_winding([a, b, c]);
    let area = |b: DVec3, c: DVec3| (b - point).cross(c - point).dot(normal);
    let areas = [area(b, c), area(c, a), area(a, b)];
    let whole: f64 = areas.iter().sum();
    areas.map(|area| area / whole)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn a_ray_that_starts_behind_its_triangle_is_seen() {
        let corners = [DVec3::new(-1.0, -1.0, -3.0), DVec3::new(1.0, -1.0, -3.0), DVec3::new(0.0, 1.0, -3.0)];
        let ray = AimedRay { origin: Vec3::ZERO, direction: Vec3::NEG_Z };
        let shadow = |z: f32| Shadow { origin: Vec3::Z * z, direction: Vec3::X, t_max: 1.0, blocked: None };
        assert!(is_left(ray, shadow(-2.999_999), corners));
        assert!(!is_left(ray, shadow(-3.0), corners) && !is_left(ray, shadow(-3.000_001), corners));
    }
}
