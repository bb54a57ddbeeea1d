//! Normals of stretched spheres, and the shadow rays that start on them.

use super::shadow_stages::{ShadowStages, leaving};
use super::transform_aim::{Aim, From, Stretched, View, ellipsoid_table, shot};
use super::{Group, Method, Score, Tally, Trial};
use crate::intersect::{Surface, offset_origin};
use crate::measure::exact::UNIT_ROUNDOFF_F32 as U;
use crate::measure::exact_vector::ExactVector;
use crate::measure::oracle_ellipsoid::{ellipsoid_hit, excess, outward};
use crate::measure::ray_aim::{AimedRay, Draws};
use crate::naive::ellipsoid::normal_as_direction;
use crate::naive::shadow::start_off_surface;
use glam::Vec3;
use std::ops::Range;

const METHODS: [Method; 5] = [
    Method::kit("kit, normal, angle to the exact one", "u", 4.0),
    Method::kit("kit, normal, its length", "u", 4.0),
    Method::kit("kit, shadow rays off it by its bound", "", 0.0),
    Method::naive("naive, normal as a direction", "u", 4.0),
    Method::naive("naive, shadow rays 1e-4 n off it", "", 0.0),
];

/// The cases of normals and starts.
pub fn trials() -> Vec<Trial> {
    let views = [
        ("surface anywhere, 10 times as long, 1e3 radii away", 1.0, 0.0, Aim::Anywhere, From::Far(1e3)),
        ("surface anywhere, 1e4 times as long, any size", 4.0, 8.0, Aim::Anywhere, From::Far(1e3)),
        ("surface at tips, 1e4 times as long, 1e7 radii away", 4.0, 0.0, Aim::Pole, From::Far(1e7)),
        ("surface at tips, 1e7 times as long, from near", 7.0, 8.0, Aim::Pole, From::Near(-6.0)),
        ("surface at silhouettes, 1e3 times as long", 3.0, 3.0, Aim::Silhouette, From::Far(1e5)),
    ];
    let trial = |(seed, (name, ratio, sizes, aim, from)): (u64, (&str, f64, f64, Aim, From))| {
        let view = View { seed, ratio, sizes, aim, from };
        Trial::new(Group::Transform, name, &METHODS, move |range| judge(view, range))
    };
    (111..).zip(views).map(trial).collect()
}

fn judge(view: View, range: Range<u64>) -> Tally {
    let (mut tally, mut stages) = (Tally::new(METHODS.len()), ShadowStages::of_ellipsoids());
    for index in range {
        let (ray, shape) = shot(view, index);
        stages.ellipsoids(ellipsoid_table([shape.ellipsoid]));
        let hit = stages.surface(ray);
        tally.count(hit.is_some());
        if let Some((_, surface)) = hit {
            judge_normal(ray, &shape, surface, &mut tally.scores);
            judge_start(&mut stages, Draws::new(view.seed + 1000, index), &shape, surface, &mut tally.scores);
        }
    }
    tally
}

/// The angle between a normal and the exact one, in u; infinite where it points the other way.
pub(super) fn angle(normal: Vec3, exact: &ExactVector) -> f64 {
    let normal = ExactVector::of(normal);
    if normal.dot(exact).sign() <= 0 {
        return f64::INFINITY;
    }
    let sine = normal.cross(exact).length().divided_by(&(&normal.length() * &exact.length()));
    sine.to_f64() / U
}

/// All rays come from outside, so the outward normal is the one that is asked for, whatever the map mirrors.
fn judge_normal(ray: AimedRay, shape: &Stretched, surface: Surface, scores: &mut [Score]) {
    let Some(t) = ellipsoid_hit(ray.origin, ray.direction, &shape.ellipsoid) else {
        scores[0].judge(false);
        return;
    };
    let exact = outward(ray.origin, ray.direction, &t, &shape.ellipsoid);
    scores[0].measure(angle(surface.normal, &exact));
    scores[1].measure((surface.normal.as_dvec3().length() - 1.0).abs() / U);
    let on_unit = shape.ellipsoid.unit_from_world * (surface.position.as_dvec3() - shape.ellipsoid.centre);
    scores[3].measure(angle(normal_as_direction(shape.world_from_unit, on_unit).as_vec3(), &exact));
}

/// A start is right when it lies strictly outside, and so the light that it faces is seen.
fn judge_start(stages: &mut ShadowStages, mut draws: Draws, shape: &Stretched, surface: Surface, scores: &mut [Score]) {
    let outside = |start: Vec3| excess(start.as_dvec3(), &shape.ellipsoid).sign() > 0;
    scores[2].judge(outside(offset_origin(surface.position, surface.normal, surface.bound)));
    scores[4].judge(outside(start_off_surface(surface.position, surface.normal).origin));
    let light = surface.position.as_dvec3() + leaving(&mut draws, surface.normal, 3.0) * shape.longest;
    if let Some(shadow) = stages.shadow(surface, light) {
        scores[2].judge(shadow.blocked.is_none());
    }
}
