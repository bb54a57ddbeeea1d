//! Chapter 14: the cosine at which light falls on a triangle whose corners have normals.

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::{ShapeTable, TriangleTable, VertexNormalTable};
use pinhole::intersect::{Hits, ShadingNormals, Surfaces, falling_cosine};
use pinhole::plan::{Column, Shared, VectorRowsMut};
use pinhole::rays::WorldRays;
use pinhole::shade;
use pinhole::shade::ShadowRays;
use pinhole::shapes::{ShapeKind, TriangleHit};
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Part, Probe, Question, RowPlaces, Setting, Shown, StandIn, probes,
};
use pinhole_lab::measure::draws::Draws;

type Vector = [f64; 3];

/// The triangle's own normal, its corners' normals, the barycentric coordinates, the directions to the eye and to the light.
type Input = (Vector, [Vector; 3], Vector, Vector, Vector);

/// What the reader writes.
pub type Yours = fn(Vector, [Vector; 3], Vector, Vector, Vector) -> f64;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered(
        "falling_cosine",
        question,
        move |&(geometric, normals, weights, eye, light)| yours(geometric, normals, weights, eye, light),
        mine,
    )
    .and_in("every light; right: below", |_| ())
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/pinhole/intersect/shading_normal.rs", "falling_cosine"),
        probes: asked(),
        tell: |(geometric, normals, weights, eye, light)| {
            let [geometric, weights, eye, light] = [geometric, weights, eye, light].map(Shown::shown);
            format!(
                "geometric {geometric}, normals {}, weights {weights}, to_eye {eye}, to_light {light}",
                normals.shown()
            )
        },
        right,
        apart: |yours, right| absolute(&[*yours], &[*right]),
        allowed: 1e-12,
        measured: "of the cosine",
        mistakes: mistakes(),
        hints: &[
            "three steps: mix the corners' normals by the weights; see on which side of the triangle eye and light are; \
             take the cosine",
            "the sum of weights times normals is shorter than 1; turn it so that it lies on the eye's side of the triangle, \
             which its scalar product with `geometric` tells",
            "does light reach the eye where the two are on different sides of the triangle? and what is a cosine \
             below 0 worth?",
        ],
    }
}

fn mistakes() -> Mistakes<Input, f64> {
    let normal = Part::<Input, DVec3>::new(turned)
        .say("light falls as the surface lies, whatever its corners' normals are")
        .when(faced)
        .say("the mixed normal is not brought to length 1")
        .when(|i| turned(i) * mixed(i).length())
        .say("the weights are left out; each corner's normal counts as much as its weight")
        .when(|i| turned(&weighted(i, [1.0 / 3.0; 3])))
        .say("the weights go with the wrong corners; the first belongs to the first normal")
        .when(|i| turned(&weighted(i, [i.2[1], i.2[2], i.2[0]])))
        .say("the normals are added without their weights")
        .when(|i| turned(&weighted(i, [1.0; 3])) * mixed(&weighted(i, [1.0; 3])).length())
        .say("the mixed normal is not turned to the eye's side of the surface")
        .when(|i| mixed(i).normalize())
        .say("the mixed normal is turned to the side of `geometric`, which may be the other one: what counts is the eye's")
        .when(|i| to_side(mixed(i).normalize(), i.0))
        .say(
            "the mixed normal is turned to the eye by its own direction; what counts is the side of the surface on \
             which the eye is",
        )
        .when(|i| to_side(mixed(i).normalize(), i.3))
        .say("the mixed normal is turned to the light; on which side of it the light is decides whether any falls")
        .when(|i| to_side(mixed(i).normalize(), i.4))
        .say("each corner's normal is turned to the eye by itself; they are all on one side of the triangle")
        .when(|i| {
            let normals = i.1.map(|normal| to_side(normal.into(), i.3).to_array());
            mixed(&(i.0, normals, i.2, i.3, i.4)).normalize()
        })
        .say("the mixed normal is reversed where the triangle's own is, but it may be on the other side already")
        .when(|i| if DVec3::from(i.0).dot(i.3.into()) < 0.0 { -mixed(i).normalize() } else { mixed(i).normalize() })
        .say("one corner's normal is taken; all three are to be mixed by their weights")
        .when(|i| {
            let heaviest = (0..3).fold(0, |best, corner| if i.2[corner] > i.2[best] { corner } else { best });
            to_side(i.1[heaviest].into(), faced(i).into())
        })
        .when(|i| to_side(i.1[0].into(), faced(i).into()));
    let to_light = Part::<Input, DVec3>::new(light)
        .say("the direction to the light is not brought to length 1")
        .when(|i| i.4.into())
        .say("the direction leads from the light to the point; the opposite is meant")
        .when(|i| -light(i));
    let cosine = Part::<[DVec3; 3], f64>::new(|&[side, normal, light]| falling_cosine(side, normal, light).max(0.0))
        .say("light comes from below the surface, where the mixed normal leans to it; that counts as none")
        .when(|&[_, normal, light]| normal.dot(light).max(0.0))
        .say("the answer is negative where the mixed normal faces away; it is 0")
        .when(|&[side, normal, light]| falling_cosine(side, normal, light))
        .say(FROM_BEHIND)
        .when(|&[side, normal, light]| falling_cosine(side, normal, light).abs())
        .when(|&[_, normal, light]| normal.dot(light).abs())
        .say("the cosine is multiplied by that of the surface itself; the mixed normal takes its place")
        .when(|&[side, normal, light]| falling_cosine(side, normal, light).max(0.0) * side.dot(light).max(0.0))
        .say("the smaller of the two cosines is taken; the surface's own only tells whether any light falls at all")
        .when(|&[side, normal, light]| side.dot(light).min(normal.dot(light)).max(0.0));
    Mistakes::<Input, f64>::new()
.say("seen from the side that `geometric` does not point to, nothing is lit; the side on which the eye is is lit")
.when(|i| if DVec3::from(i.0).dot(i.3.into()) < 0.0 { 0.0 } else { right(i) })
.say("that is the cosine to the half vector; the light's own direction is asked for")
.when(|&(geometric, normals, weights, eye, light)| {
    let half = DVec3::from(eye).normalize() + DVec3::from(light).normalize();
    right(&(geometric, normals, weights, eye, half.into()))
})
.say("the normal of the nearest corner is taken; mix all three, each by its weight")
.when(|i| {
    let most = i.2[0].max(i.2[1]).max(i.2[2]);
    let nearest = i.2.iter().position(|&weight| weight == most).unwrap_or(0);
    right(&weighted(i, [0, 1, 2].map(|at| f64::from(u8::from(at == nearest)))))
})
        .say("the cosines at the corners are mixed; mix the normals and take one cosine, of their mean brought to length 1")
        .when(|i| if above(i) { of_corners(i, |cosine| cosine.max(0.0)) } else { 0.0 })
        .when(|i| if above(i) { of_corners(i, f64::abs) } else { 0.0 })
        .when(|i| of_corners(i, |cosine| cosine.max(0.0)))
        // The same comes out where the normal is turned to the light.
        .say(FROM_BEHIND)
        .when(|i| falling_cosine(faced(i), turned(i), light(i)).abs())
        .when(|i| turned(i).dot(light(i)).abs())
        .say("the mixed normal is not turned to the eye's side of the surface")
        .when(|i| falling_cosine(faced(i), mixed(i).normalize(), light(i)))
        .say("the mixed normal is not turned to the eye's side, but light falls only on the side that `geometric` is on")
        .when(|i| on_own_side(i, mixed(i).normalize()))
        .say("the side is that of `geometric`, wherever the eye is; the triangle is lit on the eye's side")
        .when(|i| on_own_side(i, to_side(mixed(i).normalize(), i.0)))
        .say("the side that is lit is the light's; it is the eye's, and light from the other side counts as none")
        .when(|i| to_side(mixed(i).normalize(), to_side(i.0.into(), i.4).into()).dot(light(i)).max(0.0))
        .say("this is the cosine towards the eye; that towards the light is asked for")
        .when(|i| if above(i) { turned(i).dot(DVec3::from(i.3).normalize()).max(0.0) } else { 0.0 })
        .of_parts([Part::new(faced), normal, to_light], cosine)
}

fn mixed((_, normals, weights, ..): &Input) -> DVec3 {
    normals.iter().zip(weights).map(|(&normal, &weight)| DVec3::from(normal) * weight).sum()
}

/// The triangle's own normal on the eye's side.
fn faced(&(geometric, _, _, eye, _): &Input) -> DVec3 {
    to_side(geometric.into(), eye)
}

/// The mixed one there, a unit vector.
fn turned(input: &Input) -> DVec3 {
    to_side(mixed(input).normalize(), faced(input).into())
}

fn light(input: &Input) -> DVec3 {
    DVec3::from(input.4).normalize()
}

fn asked() -> Vec<Probe<Input>> {
    let up = DVec3::Y.to_array();
    let leaning = [[-0.6, 0.8, 0.0], [0.6, 0.8, 0.0], [0.0, 0.8, 0.6]];
    let third = [1.0 / 3.0; 3];
    let (above, aside) = ([0.0, 4.0, 1.0], [3.0, 4.0, 0.0]);
    let mut asked: Vec<_> = probes("at a corner", [(up, leaning, [1.0, 0.0, 0.0], above, aside)]).collect();
    asked.extend(probes(
        "between corners",
        [(up, leaning, third, above, aside), (up, leaning, [0.5, 0.5, 0.0], above, aside)],
    ));
    asked.extend(probes("three equal corner normals", [(up, [up; 3], third, above, aside)]));
    let down = DVec3::NEG_Y.to_array();
    asked.extend(probes("the triangle's own normal points down", [(down, leaning, third, above, aside)]));
    let below = |direction: Vector| direction.map(|part| -part);
    asked.extend(probes("eye and light below", [(up, leaning, third, below(above), below(aside))]));
    asked.extend(probes("the light below, the eye above", [(up, leaning, third, above, below(aside))]));
    let low = [5.0, -0.5, 0.0];
    asked.extend(probes(
        "light from just below, to which a corner's normal leans",
        [(up, leaning, [0.0, 1.0, 0.0], above, low)],
    ));
    asked.extend(probes(
        "light from just above, from which it leans away",
        [(up, leaning, [1.0, 0.0, 0.0], above, [5.0, 0.5, 0.0])],
    ));
    asked.extend(probes(
        "an eye from which it leans away",
        [(up, leaning, [1.0, 0.0, 0.0], [5.0, 0.5, 0.0], [-1.0, 3.0, 0.0])],
    ));
    asked.extend(probes("anywhere", (0..120).map(somewhere)));
    asked
}

fn somewhere(at: u64) -> Input {
    let mut draws = Draws::new(1401, at);
    let geometric = draws.unit_vector();
    let side = if at.is_multiple_of(2) { 1.0 } else { -1.0 };
    let normals = [(); 3].map(|()| (geometric * (side * 1.05) + draws.unit_vector()).normalize().to_array());
    let (a, b) = (draws.unit(), draws.unit());
    let weights = if a + b > 1.0 { [1.0 - a, 1.0 - b, a + b - 1.0] } else { [a, b, 1.0 - a - b] };
    let eye = draws.unit_vector() * draws.power_of_ten(-1.0, 2.0);
    let light = draws.unit_vector() * draws.power_of_ten(-1.0, 2.0);
    (geometric.to_array(), normals, weights, eye.to_array(), light.to_array())
}

fn right(input: &Input) -> f64 {
    falling_cosine(faced(input), turned(input), light(input)).max(0.0)
}

/// With other weights.
fn weighted(&(geometric, normals, _, eye, light): &Input, weights: Vector) -> Input {
    (geometric, normals, weights, eye, light)
}

/// Whether the light is on the eye's side of the triangle.
fn above(input: &Input) -> bool {
    faced(input).dot(light(input)) > 0.0
}

/// The weighted mean of what is made of each corner's cosine, its normal on the eye's side.
fn of_corners(input: &Input, made: fn(f64) -> f64) -> f64 {
    let fallen = |normal: Vector| made(to_side(normal.into(), faced(input).into()).dot(light(input)));
    input.1.iter().zip(input.2).map(|(&normal, weight)| weight * fallen(normal)).sum()
}

/// Where the light falls on the side that the triangle's own normal is on.
fn on_own_side(input: &Input, normal: DVec3) -> f64 {
    if DVec3::from(input.0).dot(light(input)) > 0.0 { normal.dot(light(input)).max(0.0) } else { 0.0 }
}

const FROM_BEHIND: &str = "light falls on the mixed normal from behind, too: where its cosine is below 0 the \
                           answer is 0, not the cosine without its sign";

fn to_side(normal: DVec3, side: Vector) -> DVec3 {
    if normal.dot(side.into()) < 0.0 { -normal } else { normal }
}

/// Irradiance from point lights on triangles whose corners have normals, by the cosine that the reader's function finds.
fn mine(ask: Ask<Input, f64>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::after(
        shade::point_light_stage,
        move |(triangles, normals, shapes): (
            Res<Shared<TriangleTable>>,
            Res<Shared<VertexNormalTable>>,
            Res<Shared<ShapeTable>>,
        ),
              mut tiles: Query<(RowPlaces, &WorldRays, &Hits, &Surfaces, &ShadingNormals, &mut ShadowRays)>| {
            for (place, eye, hits, surfaces, shading, mut rays) in &mut tiles {
                for ray in 0..rays.rows() {
                    let row = rays.row[ray] as usize;
                    let (shape, to_light) = (hits.shape[row] as usize, rays.direction_of(ray));
                    if shapes.kind[shape] != ShapeKind::Triangle {
                        continue;
                    }
                    let triangle = shapes.row[shape] as usize;
                    let corners = normals.normals[triangle];
                    if corners[0] == DVec3::ZERO {
                        continue;
                    }
                    let (origin, direction) = (eye.origin_of(row), eye.direction_of(row));
                    let weights = TriangleHit::of(origin, direction, &triangles.row[triangle]).weights;
                    let geometric = surfaces.get(row).normal.as_dvec3();
                    let asked =
                        (geometric.into(), corners.map(DVec3::into), weights, (-direction).into(), to_light.into());
                    let Some(cosine) = ask.at(place, row, asked) else { continue };
                    let more = (cosine / falling_cosine(geometric, shading.get(row), to_light)) as f32;
                    rays.irradiance.scale(ray, [more; 3]);
                }
            }
        },
    )
}

/// One triangle with slanting normals, lit from every direction: on the left eye and light are above it, on the right
/// below.
fn painted(ask: Ask<Input, f64>) -> StandIn {
    StandIn::painted([64, 32], move |[x, y]| {
        let [right, up] = [(f64::from(x % 32) - 15.5) / 16.0, (15.5 - f64::from(y)) / 16.0];
        let square = 1.0 - right * right - up * up;
        if square < 0.0 {
            return [0.0; 3];
        }
        let side = if x < 32 { 1.0 } else { -1.0 };
        let corners = [[0.8, 0.0, 0.6], [0.6, 0.3, 0.741_619_848_709_566_3], [0.0, 0.0, 1.0]];
        let light = [right, up, side * square.sqrt()];
        let asked = ([0.0, 0.0, 1.0], corners, [0.5, 0.4, 0.1], [0.0, 0.0, side], light);
        [ask.once(asked).unwrap_or_default(); 3]
    })
}
