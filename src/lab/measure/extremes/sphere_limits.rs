//! Spheres and planes: hit points, thin shells, directions of any length, rays that are no rays.

use super::bench::{Bench, sphere_table};
use super::plane::{aim as aim_at_plane, by_function as plane_by_function};
use super::shadow_stages::{ShadowStages, leaving};
use super::sphere::by_function;
use super::{Group, Method, Tally, Trial};
use crate::measure::exact::UNIT_ROUNDOFF_F32 as U;
use crate::measure::oracle_sphere::{Sphere, height_in_u, sphere_t};
use crate::measure::ray_aim::{AimedRay, Draws, disc, silhouette};
use crate::naive::plane::hit_f32 as naive_plane;
use crate::naive::shadow::{start_after_constant, start_off_surface};
use crate::naive::sphere::{hit_f32, nearest_unless_farther, point_f32};
use glam::Vec3;
use pinhole::intersect::{Hits, NO_SHAPE, sphere_stage, start_stage};

/// Rays and spheres of one block, one of whose rays is none.
const BLOCK: usize = 16;

/// The cases.
pub fn trials() -> Vec<Trial> {
    vec![hit_points(), shells(), lengths_of_directions(), no_rays(), ends()]
}

/// A case whose inputs are checked one by one, each with what `make` makes for all.
fn one_by_one<Tool: 'static>(
    name: &str,
    methods: &[Method],
    make: fn() -> Tool,
    check: impl Fn(&mut Tool, u64, &mut Tally) + Send + Sync + 'static,
) -> Trial {
    let rows = methods.len();
    Trial::new(Group::Sphere, name, methods, move |range| {
        let (mut tally, mut tool) = (Tally::new(rows), make());
        range.for_each(|index| check(&mut tool, index, &mut tally));
        tally
    })
}

/// How far a hit point is off its sphere, over u (|c| + r), c from the eye: rounding it to f32 costs u|p|, and a third
/// is left for the path there. The naive point is reckoned in the world, where the eye is at 10⁴.
fn hit_points() -> Trial {
    const UNIT: &str = "u(|c|+r)";
    const ROWS: [Method; 2] = [
        Method::pinhole("pinhole, hit point from the eye", UNIT, 4.0),
        Method::naive("naive o + td in the world", UNIT, 4.0),
    ];
    one_by_one(
        "hit points before an eye at (1e4, 1e4, 1e4)",
        &ROWS,
        ShadowStages::of_spheres,
        |stages, index, tally| {
            let distance = Draws::new(131, index).between(1.5, 10.0);
            let (ray, sphere) = disc(132, index, 1.0, distance);
            stages.spheres(&[sphere]);
            let hit = stages.surface(ray);
            tally.count(hit.is_some());
            let (Some((_, surface)), Some(t)) = (hit, sphere_t(ray.origin, ray.direction, sphere)) else { return };
            let size = U * (sphere.centre.length() + sphere.radius);
            tally.scores[0].measure(height_in_u(surface.position.as_dvec3(), sphere));
            let eye = Vec3::splat(1e4);
            let from_eye = point_f32(eye, ray.direction, t as f32).as_dvec3() - eye.as_dvec3();
            tally.scores[1].measure(((from_eye - sphere.centre).length() - sphere.radius).abs() / size);
        },
    )
}

/// Two shells 4e-5 of their radius apart: what leaves the inner one outwards hits the outer one.
fn shells() -> Trial {
    const ROWS: [Method; 3] = [
        Method::pinhole("pinhole, bound of the hit", "", 0.0),
        Method::naive("naive, t > 1e-3", "", 0.0),
        Method::naive("naive, hit + 1e-4 n", "", 0.0),
    ];
    const APART: f64 = 4e-5;
    one_by_one("shells of radius 1 and 1 + 4e-5, all sizes", &ROWS, ShadowStages::of_spheres, |stages, index, tally| {
        let mut draws = Draws::new(133, index);
        let (size, distance) = (draws.power_of_ten(-8.0, 8.0), draws.between(1.5, 4.0));
        let (ray, inner) = disc(134, index, size, distance);
        let outer = Sphere { radius: inner.radius * (1.0 + APART), ..inner };
        stages.spheres(&[inner]);
        let surface = stages.surface(ray).map(|(_, surface)| surface);
        stages.spheres(&[inner, outer]);
        let shadow = surface.and_then(|surface| {
            let away = leaving(&mut draws, surface.normal, 2.0).normalize() * (3.0 * size);
            Some((surface, stages.shadow(surface, surface.position.as_dvec3() + away)?))
        });
        tally.count(shadow.is_some());
        let Some((surface, shadow)) = shadow else { return };
        tally.scores[0].check(shadow.blocked == Some(1));
        let starts = [start_after_constant(surface.position), start_off_surface(surface.position, surface.normal)];
        for (score, start) in tally.scores[1..].iter_mut().zip(starts) {
            let t = sphere_t(start.origin, shadow.direction, outer);
            let inside = outer.radius > (start.origin.as_dvec3() - outer.centre).length();
            score.check(inside && t.is_some_and(|t| t > f64::from(start.t_min)));
        }
    })
}

/// A direction 2ᵏ times as long gives t / 2ᵏ, to the last bit, for spheres and planes.
fn lengths_of_directions() -> Trial {
    const ROWS: [Method; 4] = [
        Method::pinhole("pinhole, sphere, every bit of t", "", 0.0),
        Method::pinhole("pinhole, plane, every bit of t", "", 0.0),
        Method::naive("naive b2 - 4ac, f32", "", 0.0),
        Method::naive("naive, |n.d| > 1e-6, t > 1e-3, f32", "", 0.0),
    ];
    one_by_one(
        "directions 2^-60 to 2^60 long",
        &ROWS,
        || (),
        |(), index, tally| {
            let power = (Draws::new(135, index).between(-60.0, 61.0)).floor() as i32;
            let scale = libm::ldexp(1.0, power);
            let longer = |ray: AimedRay| AimedRay { direction: ray.direction * scale as f32, ..ray };
            let same = |t: f64, of_longer: f64| t.to_bits() == (of_longer * scale).to_bits();
            let (ray, sphere) = silhouette(136, index, 1e3);
            tally.count(by_function(ray, sphere).is_finite());
            tally.scores[0].check(same(by_function(ray, sphere), by_function(longer(ray), sphere)));
            let rounded = (sphere.centre.as_vec3(), sphere.radius as f32);
            let naive = |ray: AimedRay| hit_f32(ray.origin, ray.direction, rounded.0, rounded.1).map(f64::from);
            tally.scores[2].check(same(naive(ray).unwrap_or(-1.0), naive(longer(ray)).unwrap_or(-1.0 / scale)));

            let (ray, plane) = aim_at_plane(137, index, 3.0);
            tally.scores[1].check(same(plane_by_function(ray, plane), plane_by_function(longer(ray), plane)));
            let (normal, offset) = (plane.normal.as_vec3(), plane.offset as f32);
            let naive = |ray: AimedRay| naive_plane(ray.origin, ray.direction, normal, offset).map(f64::from);
            tally.scores[3].check(same(naive(ray).unwrap_or(-1.0), naive(longer(ray)).unwrap_or(-1.0 / scale)));
        },
    )
}

/// A bench of spheres.
fn sphere_bench() -> Bench {
    Bench::new(&[start_stage(), sphere_stage()])
}

/// One ray of a block has a part that is NaN or not finite, or no direction: it hits nothing, and its neighbours
/// hit what they hit alone.
fn no_rays() -> Trial {
    const ROWS: [Method; 2] = [
        Method::pinhole("pinhole, hits nothing, spoils nothing", "", 0.0),
        Method::naive("naive, kept unless farther, f32", "", 0.0),
    ];
    one_by_one("a ray with no direction, NaN or infinite", &ROWS, sphere_bench, |bench, index, tally| {
        let shot = |component: usize| silhouette(138, index * BLOCK as u64 + component as u64, 1.5);
        let (mut rays, spheres): (Vec<AimedRay>, Vec<Sphere>) = (0..BLOCK).map(shot).unzip();
        let (bad, part) = (index as usize % BLOCK, index as usize / BLOCK % 3);
        match index / 3 % 4 {
            0 => rays[bad].direction = Vec3::ZERO,
            1 => rays[bad].direction[part] = f32::NAN,
            2 => rays[bad].direction[part] = f32::INFINITY,
            _ => rays[bad].origin[part] = f32::NAN,
        }
        bench.insert(sphere_table(&spheres));
        bench.aim(&rays);
        bench.run();
        let hits = bench.column::<Hits>();
        tally.count(true);
        for (component, &ray) in rays.iter().enumerate() {
            let nearest = spheres.iter().map(|&sphere| by_function(ray, sphere)).fold(f64::INFINITY, f64::min);
            let nothing = hits.t[component] == f64::INFINITY && hits.shape[component] == NO_SHAPE;
            tally.scores[0].check(if component == bad {
                nothing
            } else {
                hits.t[component].to_bits() == nearest.to_bits()
            });
        }
        let rounded: Vec<(Vec3, f32)> =
            spheres.iter().map(|sphere| (sphere.centre.as_vec3(), sphere.radius as f32)).collect();
        tally.scores[1].check(!nearest_unless_farther(rays[bad].origin, rays[bad].direction, &rounded).is_nan());
    })
}

/// A ray that looks without end, and one that looks as far as 1e30: both hit the same at the same distance.
fn ends() -> Trial {
    const ROWS: [Method; 1] = [Method::pinhole("pinhole, the same hits", "", 0.0)];
    let bench = || Bench::new(&[sphere_stage()]);
    one_by_one("rays that end at 1e30, and without end", &ROWS, bench, |bench, index, tally| {
        let (ray, sphere) = silhouette(139, index, 1e3);
        bench.insert(sphere_table(&[sphere]));
        bench.aim(&[ray]);
        let mut found = [1e30, f64::INFINITY].map(|end| {
            let mut hits = Hits::default();
            let (t, shape) = hits.slices_mut(1);
            (t[0], shape[0]) = (end, NO_SHAPE);
            bench.put(hits);
            bench.run();
            let hits = bench.column::<Hits>();
            (hits.t[0], hits.shape[0])
        });
        let hit = found[0].1 != NO_SHAPE;
        tally.count(hit);
        if !hit {
            found[0].0 = f64::INFINITY;
        }
        tally.scores[0].check(found[0] == found[1] && found[1].0 == by_function(ray, sphere));
    })
}

/// A point and its sphere, for the tests.
#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn a_point_on_its_sphere_is_off_by_nothing() {
        let sphere = Sphere { centre: DVec3::new(0.0, 0.0, -3.0), radius: 1.0 };
        assert_eq!(height_in_u(DVec3::new(0.0, 0.0, -2.0), sphere), 0.0);
        let off = height_in_u(DVec3::new(0.0, 0.0, -2.0 + 4.0 * U), sphere);
        assert!((off - 1.0).abs() < 1e-6, "{off}");
    }
}
