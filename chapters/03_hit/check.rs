//! Chapter 03: where a ray first hits a sphere, compared with exact arithmetic.

use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use pinhole::extract::SphereTable;
use pinhole::intersect;
use pinhole::intersect::Hits;
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole::scene::{LookAt, View};
use pinhole::shapes::sphere_intersection;
use pinhole_lab::exercise::apart::{option, relative};
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Part, Probe, Question, RowPlaces, Setting, Shown, StandIn, extremes, on_camera, probes,
};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::oracle_sphere::{Sphere, line_ts, sphere_hit};
use pinhole_lab::measure::ray_aim;
use pinhole_lab::measure::ray_aim::AimedRay;
use pinhole_lab::naive::sphere::hit_f64_plain;

/// Origin, direction, centre, radius; origin and direction have few digits, as f32 numbers.
type Input = ([f64; 3], [f64; 3], [f64; 3], f64);

type Answer = Option<f64>;
type Roots = Option<[f64; 2]>;

/// What the reader writes.
pub type Yours = fn([f64; 3], [f64; 3], [f64; 3], f64) -> Answer;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("nearest_sphere_t", question, move |&(o, d, c, r)| yours(o, d, c, r), mine)
        .and_in("its normals", |world| on_camera(world, View { column: "surface".into() }))
        .and_in("the ball behind the eye", |world| on_camera(world, behind()))
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
        mistakes: mistakes(),
        hints: &[
            "put O + tR into |x − C| = r: a quadratic equation in t; its smallest root above 0 is asked for",
            "with f = C − O the ray is nearest to the centre at s = f·R / R·R; what is left across it, f − sR, decides \
             whether it hits the sphere, and nothing of the size of the distance is squared",
            "half the chord is the third side of a right triangle, beside r and what is left across; over the \
             direction's length it becomes a t",
            "the two roots lie equally far before and behind the nearest place; which is asked for depends on where \
             the ray begins",
        ],
    }
}

fn mistakes() -> Mistakes<Input, Answer> {
    let roots = Part::<Input, Roots>::new(both)
        .say("a ray past the sphere is given a t: where the number under the root is below 0, the answer is None")
        .when(|i| solved(coefficients(i), |[b, a, c]| (b * b - a * c).abs(), 1.0))
        .when(|i| solved(coefficients(i), |[b, a, c]| (b * b - a * c).max(0.0), 1.0))
        .say("the direction is taken to be of length 1; it may have any length")
        .when(|i| by_chord(i, 1.0, 1.0))
        .when(|i| {
            let [b, _, c] = coefficients(i);
            solved([b, 1.0, c], right_discriminant, 1.0)
        })
        .when(|i| solved(coefficients(i), |[b, _, c]| b * b - c, 1.0))
        .say("half the chord is added to t as a length; t counts in lengths of the direction, so divide it by |R|")
        .when(|i| by_chord(i, square(i), 1.0))
        .say("half the chord is divided by R·R; it is a length, so |R| divides it")
        .when(|i| by_chord(i, square(i), square(i)))
        .say("f·R is divided by |R| alone; s counts in lengths of R, which divides it once more")
        .when(|i| by_chord(i, square(i).sqrt(), square(i).sqrt()))
        .say(
            "b has the wrong sign, so that what is behind comes ahead: b = 2 f·R belongs to f = O − C, not to \
                 C − O",
        )
        .when(|i| both(i).map(|[near, far]| [-far, -near]))
        .say("the radius is not squared: c is f·f − r²")
        .when(|&(o, d, c, r)| both(&(o, d, c, r.sqrt())))
        .say("c is f·f + r²; the radius is to be taken off")
        .when(|i| {
            let [b, a, c] = coefficients(i);
            solved([b, a, c + 2.0 * i.3 * i.3], right_discriminant, 1.0)
        })
        .say("the radius is left out")
        .when(|&(o, d, c, _)| both(&(o, d, c, 0.0)))
        .say("the radius is doubled or a diameter")
        .when(|&(o, d, c, r)| both(&(o, d, c, 2.0 * r)))
        .say("the radius is halved; it is no diameter")
        .when(|&(o, d, c, r)| both(&(o, d, c, r / 2.0)))
        .say("the centre is left out, as if the sphere were at the origin of the space")
        .when(|&(o, d, _, r)| both(&(o, d, [0.0; 3], r)))
        .say("the ray's origin is left out: f is C − O")
        .when(|&(_, d, c, r)| both(&([0.0; 3], d, c, r)))
        .say(
            "the formula with b and that with half of b are mixed: with b = −2 f·R it has 4ac and 2a, with b = \
                 −f·R it has ac and a",
        )
        .when(|i| solved(coefficients(i), |[b, a, c]| b * b - 4.0 * a * c, 2.0))
        .when(|i| solved(coefficients(i), |[b, a, c]| b * b - 4.0 * a * c, 1.0))
        .when(|i| solved(coefficients(i), right_discriminant, 2.0))
        .when(|i| solved(coefficients(i), right_discriminant, 0.5))
        .when(|i| solved(doubled(i), right_discriminant, 2.0))
        .when(|i| solved(doubled(i), right_discriminant, 1.0))
        .say("the root of the discriminant is missing")
        .when(|i| solved(coefficients(i), |[b, a, c]| (b * b - a * c) * (b * b - a * c).abs(), 1.0))
        .say("b² − ac (or b² − 4ac) is computed as it stands; far away it is a small difference of huge numbers")
        .when(|i| solved(coefficients(i), right_discriminant, 1.0))
        .say(
            "−b and the root are subtracted where they are nearly equal; c / (−b + root) is the nearer root \
                 with all its digits",
        )
        .when(|i| by_chord(i, square(i), square(i).sqrt()))
        .say("a sphere whose centre is not ahead is passed over; from inside, the ray hits it all the same")
        .when(|i| both(i).filter(|[near, far]| near + far > 0.0))
        .when(|i| both(i).filter(|[near, far]| near + far >= 0.0))
        .say("the distance across the ray is squared and the radius is not; compare l·l with r²")
        .when(|i| {
            let [b, a, c] = coefficients(i);
            let across = c + i.3 * i.3 - b * b / a;
            both(i).filter(|_| across <= i.3)
        })
        .say("half the chord is r − |l|; by Pythagoras it is √(r² − |l|²)")
        .when(|i| {
            let [b, a, c] = coefficients(i);
            let half = (i.3 - (c + i.3 * i.3 - b * b / a).abs().sqrt()) / a.sqrt();
            (half >= 0.0).then(|| [-b / a - half, -b / a + half])
        })
        .say("a is the length of R; it is R·R, the length squared")
        .when(|i| {
            let [b, a, c] = coefficients(i);
            solved([b, a.sqrt(), c], right_discriminant, 1.0)
        })
        .say("brackets are missing: all of −b ∓ root is divided by 2a, not the root alone")
        .when(|i| {
            let [b, a, c] = doubled(i);
            let root = (b * b - 4.0 * a * c).sqrt() / (2.0 * a);
            (root >= 0.0).then_some([-b - root, -b + root])
        })
        .say("c is |f| − r; both are squared")
        .when(|i| {
            let [b, a, c] = coefficients(i);
            solved([b, a, (c + i.3 * i.3).sqrt() - i.3], right_discriminant, 1.0)
        });
    let hit = Part::<[Roots; 1], Answer>::new(|&[roots]| ahead(roots))
        .say("what lies behind the origin is hit too: only t above 0 counts")
        .when(|&[roots]| Some(roots?[0]))
        .when(|&[roots]| roots.map(|[near, far]| if near > 0.0 { near } else { far }))
        .when(|&[roots]| roots.map(|[near, far]| near.abs().min(far.abs())))
        .when(|&[roots]| roots.map(|[near, _]| near.abs()))
        .say("from inside, nothing is hit: the nearer root is behind, but the farther one is ahead")
        .when(|&[roots]| roots.map(|[near, _]| near).filter(|&t| t > 0.0))
        .say("the farther root is taken where the nearer one is ahead")
        .when(|&[roots]| roots.map(|[_, far]| far).filter(|&t| t > 0.0))
        .say("t = 0 counts as a hit; only t above 0 does")
        .when(|&[roots]| roots?.into_iter().find(|&t| t >= 0.0))
        .say("hits close to the origin are skipped; every t above 0 counts")
        .when(|&[roots]| roots?.into_iter().find(|&t| t > 1e-3))
        .when(|&[roots]| roots?.into_iter().find(|&t| t > 1e-4))
        .when(|&[roots]| roots?.into_iter().find(|&t| t > 1e-6))
        .say("a ray that only touches the sphere misses it; it hits")
        .when(|&[roots]| ahead(roots.filter(|[near, far]| near < far)))
        .say("a ray past the sphere is given a t: where the number under the root is below 0, the answer is None")
        .when(|&[roots]| roots.map_or(Some(f64::NAN), |roots| ahead(Some(roots))))
        .say("this is where the ray comes closest to the centre; it hits the sphere half a chord before")
        .when(|&[roots]| roots.map(|[near, far]| (near + far) / 2.0).filter(|&t| t > 0.0));
    Mistakes::<Input, Answer>::new()
        .asked_as_given()
        .say("the square root is missing: it is −b ± √(b² − 4ac)")
        .when(|i| ahead(unrooted(doubled(i), 4.0)))
        .when(|i| ahead(unrooted(coefficients(i), 1.0)))
        .say("c is of the origin alone; it is of the origin as seen from the centre: f·f − r²")
        .when(|i| {
            let ([b, a, _], c) = (coefficients(i), DVec3::from(i.0).length_squared() - i.3 * i.3);
            ahead(solved([b, a, c], right_discriminant, 1.0))
        })
        .say(
            "the direction is brought to length 1 and t is left so; t counts in lengths of the direction as it \
                 was given",
        )
        .when(|i| ahead(both(i)).map(|t| t * square(i).sqrt()))
        .say("t is multiplied by the direction's length")
        .when(|i| ahead(both(i)).map(|t| t * square(i)))
        .say("the quotient is multiplied by R·R: / 2.0 * a divides by 2 only")
        .when(|i| ahead(both(i)).map(|t| t * square(i) * square(i)))
        .say("b² − ac (or b² − 4ac) is computed as it stands; far away it is a small difference of huge numbers")
        .when(|&(o, d, c, r)| hit_f64_plain(single(o), single(d), c.into(), r))
        .of_parts([roots], hit)
}

fn asked() -> Vec<Probe<Input>> {
    let ahead = [0.0, 0.0, -1.0];
    let ball = [0.0, 0.0, -3.0];
    let mut asked: Vec<_> = probes("straight at a sphere", [([0.0; 3], ahead, ball, 1.0)]).collect();
    asked.extend(probes("past a sphere", [([3.0, 0.0, 0.0], ahead, ball, 1.0)]));
    asked.extend(probes("a sphere behind the origin", [([0.0; 3], ahead, [0.0, 0.0, 3.0], 1.0)]));
    asked.extend(probes(
        "from inside",
        [
            (ball, ahead, ball, 2.0),
            ([0.0, 0.0, -3.5], ahead, ball, 1.0),
            ([0.5, 0.0, -2.5], [0.0, 1.0, 0.0], ball, 1.0),
        ],
    ));
    asked.extend(probes("a direction of length 2", [([0.0; 3], [0.0, 0.0, -2.0], ball, 1.0)]));
    asked.extend(probes("a direction of length 0.5", [([0.5, 0.0, 0.0], [0.0, 0.0, -0.5], ball, 1.0)]));
    let rays = |ray: fn(u64) -> (AimedRay, Sphere), count: u64| {
        (0..count).map(ray).map(|(ray, sphere)| input(ray.origin, ray.direction, sphere)).filter(decidable)
    };
    let (far, near): (Vec<Input>, _) = rays(|at| ray_aim::seen_sphere_of_any_size(301, at), 60).partition(is_far);
    asked.extend(probes("any size and place", near));
    asked.extend(probes("close to the tangent at 1.5 radii", rays(|at| ray_aim::tangent(302, at, 1.0, 1.5), 40)));
    asked.extend(probes("touching the sphere in one point", [([1.0, 0.0, 0.0], ahead, ball, 1.0)]));
    asked.extend(probes("from a point of the sphere, outward", [([0.0, 0.0, -2.0], [0.0, 0.0, 1.0], ball, 1.0)]));
    asked.extend(probes("from a point of the sphere, inward", [([0.0, 0.0, -2.0], ahead, ball, 1.0)]));
    asked.extend(probes("the centre, 1e5 radii away", rays(|at| ray_aim::centre(303, at, 1.0, 1e5), 20)));
    asked.extend(probes("a silhouette 1e3 radii away", rays(|at| ray_aim::silhouette(304, at, 1e3), 60)));
    asked.extend(extremes("a sphere more than 1e4 radii away", far));
    asked.extend(extremes("a silhouette 1e7 radii away", rays(|at| ray_aim::silhouette(305, at, 1e7), 300)));
    asked.extend(extremes(
        "the ground of a planet, 1e8 in radius, from 0.01 above",
        rays(|at| below(at, 1e8, 1e-2), 30),
    ));
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

/// Whether the squared radius has few digits left beside the squared distance.
fn is_far(&(o, _, c, radius): &Input) -> bool {
    DVec3::from(o).distance(c.into()) > 1e4 * radius
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

/// The two roots, exact but for the last rounding.
fn both(&(o, d, c, r): &Input) -> Roots {
    line_ts(single(o), single(d), sphere(c, r))
}

fn ahead(roots: Roots) -> Answer {
    roots?.into_iter().find(|&t| t > 0.0)
}

/// Half of b, a, and c of the quadratic equation.
fn coefficients(&(o, d, c, r): &Input) -> [f64; 3] {
    let (f, d) = (DVec3::from(o) - DVec3::from(c), DVec3::from(d));
    [f.dot(d), d.length_squared(), f.length_squared() - r * r]
}

fn doubled(input: &Input) -> [f64; 3] {
    let [b, a, c] = coefficients(input);
    [2.0 * b, a, c]
}

fn right_discriminant([b, a, c]: [f64; 3]) -> f64 {
    b * b - a * c
}

fn solved(of: [f64; 3], discriminant: fn([f64; 3]) -> f64, times_a: f64) -> Roots {
    let root = discriminant(of).sqrt();
    (root >= 0.0).then(|| [-of[0] - root, -of[0] + root].map(|part| part / (times_a * of[1])))
}

/// The formula without its root.
fn unrooted([b, a, c]: [f64; 3], four: f64) -> Roots {
    let under = b * b - four * a * c;
    (under >= 0.0).then(|| [-b - under, -b + under].map(|part| part / (four.sqrt() * a)))
}

/// R·R.
fn square(input: &Input) -> f64 {
    DVec3::from(input.1).length_squared()
}

/// By Pythagoras, with f·R and half the chord over these numbers.
fn by_chord(&(o, d, c, r): &Input, along: f64, half: f64) -> Roots {
    let (d, f) = (DVec3::from(d), DVec3::from(c) - DVec3::from(o));
    let s = f.dot(d) / along;
    let half_chord = (r * r - (f - s * d).length_squared()).sqrt() / half;
    (half_chord >= 0.0).then_some([s - half_chord, s + half_chord])
}

/// The nearest sphere of each ray.
fn mine(ask: Ask<Input, Answer>, setting: &Setting<'_>) -> StandIn {
    // With the ball behind the eye, a t below 0 is what is to be seen.
    let least = if setting.number == 0 { 0.0 } else { f64::NEG_INFINITY };
    StandIn::instead(
        intersect::sphere_stage,
        move |spheres: Res<Shared<SphereTable>>, mut tiles: Query<(RowPlaces, &WorldRays, &mut Hits)>| {
            for (place, rays, mut hits) in &mut tiles {
                for row in 0..rays.rows() {
                    // A direction may have any length, and t counts in it.
                    let (origin, direction) = (rays.origin_of(row).into(), (0.5 * rays.direction_of(row)).into());
                    for (sphere, &shape) in spheres.row.iter().zip(&spheres.shape) {
                        let asked = (origin, direction, sphere.centre.into(), sphere.radius);
                        let t = ask.at(place, row, asked).flatten().map(|t| 0.5 * t);
                        if let Some(t) = t.filter(|t| *t > least && *t < hits.t[row]) {
                            (hits.t[row], hits.shape[row]) = (t, shape);
                        }
                    }
                }
            }
        },
    )
}

/// A camera that has the ball behind it.
fn behind() -> LookAt {
    LookAt { eye: [-0.6, 1.0, -2.5].into(), target: [0.6, 1.5, -8.0].into(), ..LookAt::default() }
}
