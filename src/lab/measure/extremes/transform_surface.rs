//! Normals of stretched spheres, and the shadow rays that start on them.

use super::shadow_stages::{ShadowStages, leaving};
use super::transform_aim::{From, SampleLights, Stretched, View, ellipsoid_table, shot};
use super::{Group, Method, Score, Tally, Trial};
use crate::measure::enclosure::Enclosure;
use crate::measure::exact::{Dyadic, UNIT_ROUNDOFF_F32 as U};
use crate::measure::exact_vector::{EnclosedVector, ExactVector, Vector};
use crate::measure::number::Number;
use crate::measure::oracle_ellipsoid::{enclosed_outward, outward, side_of_ellipsoid};
use crate::measure::ray_aim::{AimedRay, Draws};
use crate::naive::ellipsoid::normal_as_direction;
use crate::naive::shadow::start_off_surface;
use glam::Vec3;
use pinhole::intersect::Surface;
use pinhole::shapes::offset_origin;
use std::ops::Range;

const METHODS: [Method; 5] = [
    Method::pinhole("pinhole, normal, angle to the exact one", "u", 4.0),
    Method::pinhole("pinhole, normal, its length", "u", 4.0),
    Method::pinhole("pinhole, shadow rays off it by its bound", "", 0.0),
    Method::naive("naive, normal as a direction", "u", 4.0),
    Method::naive("naive, shadow rays 1e-4 n off it", "", 0.0),
];

/// The cases of normals and starts.
pub fn trials() -> Vec<Trial> {
    let views = [
        ("surface anywhere, 10 times as long, 1e3 radii away", 1.0, 0.0, SampleLights::Anywhere, From::Far(1e3)),
        ("surface anywhere, 1e4 times as long, any size", 4.0, 8.0, SampleLights::Anywhere, From::Far(1e3)),
        ("surface at tips, 1e4 times as long, 1e7 radii away", 4.0, 0.0, SampleLights::Pole, From::Far(1e7)),
        ("surface anywhere, 1e7 times as long, 1e7 radii away", 7.0, 8.0, SampleLights::Anywhere, From::Far(1e7)),
        ("surface at tips, 1e7 times as long, from near", 7.0, 8.0, SampleLights::Pole, From::Near(-6.0)),
        ("surface at silhouettes, 1e3 times as long", 3.0, 3.0, SampleLights::Silhouette, From::Far(1e5)),
        ("surface from inside, 1e3 times as long, any size", 3.0, 8.0, SampleLights::Anywhere, From::Inside),
    ];
    let trial = |(seed, (name, ratio, sizes, aim, from)): (u64, (&str, f64, f64, SampleLights, From))| {
        let view = View { seed, ratio, sizes, aim, from };
        Trial::new(Group::Transform, name, &METHODS, move |range| check(view, range))
    };
    (111..).zip(views).map(trial).collect()
}

fn check(view: View, range: Range<u64>) -> Tally {
    let (mut tally, mut stages) = (Tally::new(METHODS.len()), ShadowStages::of_ellipsoids());
    for index in range {
        let (ray, shape) = shot(view, index);
        stages.ellipsoids(ellipsoid_table([shape.ellipsoid]));
        // From inside, a bound that is not well below the sharpest bend's radius leaves no room to start in.
        let room = shape.shortest * shape.shortest / shape.longest / 7.0;
        let inside = matches!(view.from, From::Inside);
        let hit = stages.surface(ray).filter(|(_, surface)| !inside || f64::from(surface.bound) <= room);
        tally.count(hit.is_some());
        let Some((_, surface)) = hit else { continue };
        check_normal(ray, &shape, inside, surface, &mut tally.scores);
        check_start(&shape, inside, surface, &mut tally.scores);
        let mut draws = Draws::new(view.seed + 1000, index);
        let light = surface.position.as_dvec3() + leaving(&mut draws, surface.normal, 3.0) * shape.longest;
        if let (false, Some(shadow)) = (inside, stages.shadow(surface, light)) {
            tally.scores[2].check(shadow.blocked.is_none());
        }
    }
    tally
}

/// The angle between a normal and the exact one, in u; infinite where it points the other way.
///
/// Nothing where these numbers cannot tell, which exact ones always can.
pub(super) fn angle<N: Number>(normal: Vec3, exact: &Vector<N>) -> Option<f64> {
    let normal = Vector::of(normal);
    if normal.dot(exact).sign()? <= 0 {
        return Some(f64::INFINITY);
    }
    let lengths = normal.dot(&normal).by(&exact.dot(exact)).about()?.sqrt();
    Some(normal.cross(exact).length_about()? / lengths / U)
}

/// The angles of some normals, by enclosures where these can tell and exactly where not.
pub(super) fn angles<const COUNT: usize>(
    normals: [Vec3; COUNT],
    enclosed: Option<EnclosedVector>,
    exact: impl FnOnce() -> Option<ExactVector>,
) -> Option<[f64; COUNT]> {
    fn all<N: Number, const COUNT: usize>(normals: [Vec3; COUNT], truth: &Vector<N>) -> Option<[f64; COUNT]> {
        let mut angles = [0.0; COUNT];
        for (told, normal) in angles.iter_mut().zip(normals) {
            *told = angle(normal, truth)?;
        }
        Some(angles)
    }
    enclosed.and_then(|truth| all(normals, &truth)).or_else(|| all(normals, &exact()?))
}

/// The normal on the side of the ray, outward but from inside, whatever the map mirrors.
fn check_normal(ray: AimedRay, shape: &Stretched, inside: bool, surface: Surface, scores: &mut [Score]) {
    let (side, ellipsoid) = (if inside { -1.0 } else { 1.0 }, &shape.ellipsoid);
    let on_unit = ellipsoid.unit_from_world * (surface.position.as_dvec3() - ellipsoid.centre) * side;
    let naive = normal_as_direction(shape.world_from_unit, on_unit).as_vec3();
    let enclosed = enclosed_outward(ray.origin, ray.direction, ellipsoid).map(|out| out.times(&Enclosure::of(side)));
    let exact = || Some(outward(ray.origin, ray.direction, ellipsoid)?.times(&Dyadic::of(side)));
    scores[1].measure((surface.normal.as_dvec3().length() - 1.0).abs() / U);
    match angles([surface.normal, naive], enclosed, exact) {
        Some([pinhole, naive]) => {
            scores[0].measure(pinhole);
            scores[3].measure(naive);
        }
        None => scores[0].check(false),
    }
}

/// A start is right when it lies strictly on the side of the ray.
fn check_start(shape: &Stretched, inside: bool, surface: Surface, scores: &mut [Score]) {
    let side = if inside { -1 } else { 1 };
    let right = |start: Vec3| side_of_ellipsoid(start.as_dvec3(), &shape.ellipsoid) == side;
    scores[2].check(right(offset_origin(surface.position, surface.normal, surface.bound)));
    scores[4].check(right(start_off_surface(surface.position, surface.normal).origin));
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Enclosures are a shortcut to what exact arithmetic says, and nothing else.
    #[test]
    fn enclosed_angles_are_the_exact_ones() {
        let (mut tried, mut fell_back) = (0, 0);
        for (ratio, aim, from) in [
            (1.0, SampleLights::Anywhere, From::Far(1e3)),
            (7.0, SampleLights::Anywhere, From::Far(1e7)),
            (3.0, SampleLights::Silhouette, From::Far(1e5)),
        ] {
            for index in 0..2000 {
                let (ray, shape) = shot(View { seed: 7, ratio, sizes: 3.0, aim, from }, index);
                let Some(exact) = outward(ray.origin, ray.direction, &shape.ellipsoid) else { continue };
                let [x, y, z] = [&exact.x, &exact.y, &exact.z].map(Dyadic::to_f64);
                // A little off the exact one, as pinhole's is, by nothing to a few roundings.
                let normal = glam::DVec3::new(x, y, z).normalize().as_vec3();
                let expected = angle(normal, &exact).expect("exact numbers tell");
                let enclosed = enclosed_outward(ray.origin, ray.direction, &shape.ellipsoid);
                match enclosed.and_then(|truth| angle(normal, &truth)) {
                    Some(told) => assert!((told - expected).abs() <= 1e-5 * expected, "{told} for {expected}"),
                    None => fell_back += 1,
                }
                tried += 1;
            }
        }
        eprintln!("angles: {tried} by enclosures are the exact ones, {fell_back} could not be told");
        assert!(tried - fell_back > 2000);
    }
}
