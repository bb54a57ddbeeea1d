//! Chapter 03: where a ray first hits a sphere, compared with exact arithmetic.

use super::mine::mine;
use glam::{DVec3, Vec3};
use pinhole::shapes::sphere_intersection;
use pinhole_lab::exercise::apart::{option, relative};
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::oracle_sphere::{Sphere, line_roots, sphere_hit};
use pinhole_lab::measure::ray_aim::{self, AimedRay, Draws};
use pinhole_lab::naive::sphere::hit_f64_plain;

/// Origin, direction, centre, radius; origin and direction have few digits, as f32 numbers.
pub(super) type Input = ([f64; 3], [f64; 3], [f64; 3], f64);
pub(super) type Answer = Option<f64>;

/// What the reader writes.
pub type Yours = fn([f64; 3], [f64; 3], [f64; 3], f64) -> Answer;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::nearest_sphere_t)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("nearest_sphere_t", question, move |&(o, d, c, r)| yours(o, d, c, r), mine)
}

fn question() -> Question<Input, Answer> {
    Question {
        pinhole_has: ("src/pinhole/shapes/sphere.rs", "sphere_intersection"),
        probes: asked(),
        tell: |(origin, direction, centre, radius)| {
            let [origin, direction, centre] = [origin, direction, centre].map(Shown::shown);
            format!("origin {origin}, direction {direction}, centre {centre}, radius {radius:?}")
        },
        right: |&(o, d, c, r)| sphere_hit(single(o), single(d), sphere(c, r)).map(|t| t.to_f64()),
        apart: |yours, right| option(yours, right, |yours, right| relative(&[*yours], &[*right])),
        allowed: 1e-7,
        measured: "of t",
        mistakes: vec![
            Mistake::new("what lies behind the origin is hit too: only t above 0 counts", |&(o, d, c, r)| {
                line_roots(single(o), single(d), sphere(c, r)).map(|roots| roots.near.to_f64())
            }),
            Mistake::new(
                "from inside, nothing is hit: the nearer root is behind, but the farther one is ahead",
                |input| {
                    let &(o, d, c, r) = input;
                    let roots = line_roots(single(o), single(d), sphere(c, r))?;
                    Some(roots.near.to_f64()).filter(|&t| t > 0.0)
                },
            ),
            Mistake::new("the farther root is taken where the nearer one is ahead", |&(o, d, c, r)| {
                let roots = line_roots(single(o), single(d), sphere(c, r))?;
                Some(roots.far.to_f64()).filter(|&t| t > 0.0)
            }),
            Mistake::new("the direction is taken to be of length 1; it may have any length", |&(o, d, c, r)| {
                let (d, f) = (DVec3::from(d), DVec3::from(c) - DVec3::from(o));
                let s = f.dot(d);
                let discriminant = r * r - (f - s * d).length_squared();
                let half_chord = (discriminant >= 0.0).then(|| discriminant.sqrt())?;
                [s - half_chord, s + half_chord].into_iter().find(|&t| t > 0.0)
            }),
            Mistake::new(
                "b² − ac is computed as it stands; far away it is a small difference of huge numbers",
                |input| {
                    let &(o, d, c, r) = input;
                    hit_f64_plain(single(o), single(d), c.into(), r)
                },
            ),
        ],
        hints: &[
            "put O + tR into |x − C| = r: a quadratic equation in t; its smallest root above 0 is asked for",
            "with f = C − O the ray is nearest to the centre at s = f·R / R·R; what is left across it, f − sR, decides \
             whether it hits the sphere, and nothing of the size of the distance is squared",
            "with h = √((r² − |f − sR|²) / R·R) the roots are s − h and s + h; there are none where the number under the \
             root is below 0",
            "so: s − h if that is above 0, else s + h if that is, else None; f is the difference of the two points, and \
             s is divided by R·R because R may have any length",
        ],
    }
}

fn asked() -> Vec<Probe<Input>> {
    let ahead = [0.0, 0.0, -1.0];
    let ball = [0.0, 0.0, -3.0];
    let mut asked: Vec<_> = probes("straight at a sphere", [([0.0; 3], ahead, ball, 1.0)]).collect();
    asked.extend(probes("past a sphere", [([3.0, 0.0, 0.0], ahead, ball, 1.0)]));
    asked.extend(probes("a sphere behind the origin", [([0.0; 3], ahead, [0.0, 0.0, 3.0], 1.0)]));
    asked.extend(probes("from inside", [(ball, ahead, ball, 2.0), ([0.5, 0.0, -2.5], [0.0, 1.0, 0.0], ball, 1.0)]));
    asked.extend(probes("a direction of length 2", [([0.0; 3], [0.0, 0.0, -2.0], ball, 1.0)]));
    asked.extend(probes("a direction of length 0.5", [([0.5, 0.0, 0.0], [0.0, 0.0, -0.5], ball, 1.0)]));
    let rays = |ray: fn(u64) -> (AimedRay, Sphere), count: u64| {
        (0..count).map(ray).map(|(ray, sphere)| input(ray.origin, ray.direction, sphere)).filter(decidable)
    };
    asked.extend(probes("any size and place", rays(|at| ray_aim::seen_sphere_of_any_size(301, at), 60)));
    asked.extend(probes("close to the tangent at 1.5 radii", rays(|at| ray_aim::tangent(302, at, 1.0, 1.5), 40)));
    asked.extend(probes("touching the sphere in one point", [([1.0, 0.0, 0.0], ahead, ball, 1.0)]));
    asked.extend(probes("from a point of the sphere, outward", [([0.0, 0.0, -2.0], [0.0, 0.0, 1.0], ball, 1.0)]));
    asked.extend(probes("from a point of the sphere, inward", [([0.0, 0.0, -2.0], ahead, ball, 1.0)]));
    asked.extend(probes("the centre, 1e5 radii away", rays(|at| ray_aim::centre(303, at, 1.0, 1e5), 20)));
    asked.extend(probes("a silhouette 1e3 radii away", rays(|at| ray_aim::silhouette(304, at, 1e3), 60)));
    asked.extend(probes("a silhouette 1e7 radii away", rays(|at| ray_aim::silhouette(305, at, 1e7), 300)));
    asked.extend(probes("the ground of a planet, 1e8 in radius, from 0.01 above", rays(|at| below(at, 1e8, 1e-2), 30)));
    asked
}

/// A ray from closely above a large sphere down to it.
fn below(index: u64, radius: f64, height: f64) -> (AimedRay, Sphere) {
    let mut draws = Draws::new(306, index);
    let tilted = DVec3::new(draws.between(-0.5, 0.5), -1.0, draws.between(-0.5, 0.5));
    let sphere = Sphere { centre: DVec3::new(0.0, -(radius + height), 0.0), radius };
    (ray_aim::rounded_ray(Vec3::ZERO, tilted), sphere)
}

fn input(origin: Vec3, direction: Vec3, Sphere { centre, radius }: Sphere) -> Input {
    (origin.as_dvec3().into(), direction.as_dvec3().into(), centre.into(), radius)
}

/// Whether f64 can tell a hit from a miss, and t to the digits asked for.
fn decidable(&(origin, direction, centre, radius): &Input) -> bool {
    !sphere_intersection(DVec3::from(centre) - DVec3::from(origin), direction.into(), radius).uncertain
}

fn single(v: [f64; 3]) -> Vec3 {
    DVec3::from(v).as_vec3()
}

fn sphere(centre: [f64; 3], radius: f64) -> Sphere {
    Sphere { centre: centre.into(), radius }
}
