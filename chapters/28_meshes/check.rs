//! Chapter 28: a ray in the object space of a mesh.

use bevy_ecs::prelude::*;
use glam::{DMat3, DQuat, DVec3};
use pinhole::extract::MeshTable;
use pinhole::intersect;
use pinhole::intersect::{HitPrimitives, Hits};
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole::shapes::{direction_object_from_world, point_object_from_world};
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Part, Probe, Question, RowPlaces, Setting, Shown, StandIn, at_most, probes,
};
use pinhole_lab::measure::draws::Draws;

/// Origin, direction, position, axes, scale.
type Input = ([f64; 3], [f64; 3], [f64; 3], [[f64; 3]; 3], [f64; 3]);

type Answer = [[f64; 3]; 2];

/// What the reader writes.
pub type Yours = fn([f64; 3], [f64; 3], [f64; 3], [[f64; 3]; 3], [f64; 3]) -> Answer;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    let written = move |&(o, d, position, axes, scale): &Input| yours(o, d, position, axes, scale);
    Exercise::rendered("ray_in_object_space", question, written, mine).shown_in(|world| at_most(world, (240, 2)))
}

fn question() -> Question<Input, Answer> {
    Question {
        pinhole_has: ("src/pinhole/shapes/mesh.rs", "near_ray"),
        probes: asked(),
        tell: |(origin, direction, position, axes, scale)| {
            let [origin, direction, position, scale] = [origin, direction, position, scale].map(Shown::shown);
            let axes = axes.shown();
            format!("origin {origin}, direction {direction}, position {position}, axes {axes}, scale {scale}")
        },
        right,
        apart: |yours, right| absolute(yours.as_flattened(), right.as_flattened()),
        allowed: 1e-9,
        measured: "in each part",
        mistakes: mistakes(),
        hints: &[
            "undo what placed the mesh, the last step first: the position, then the turn, then the scale",
            "a vector's component along an axis of length 1 is its dot product with that axis",
            "the direction is the difference of two places on the ray, so the position cancels in it",
            "leave the direction's length as it comes out: at each t both rays must be at the same place of the mesh",
        ],
    }
}

fn mistakes() -> Mistakes<Input, Answer> {
    let origin = Part::<Input, [f64; 3]>::new(|i| right(i)[0])
        .say("the origin is not divided by the scale; it is, as the direction is")
        .when(|i| scaled(i, [1.0; 3])[0])
        .say(TIMES)
        .when(|i| scaled(i, i.4.map(|part| 1.0 / part))[0])
        .say("the position is left out: the mesh is turned and scaled about its own origin")
        .when(|i| put_at(i, [0.0; 3]))
        .say("the position is added; to come back from it, subtract it")
        .when(|i| put_at(i, i.2.map(|part| -part)))
        .say("the position is subtracted last; it was added last, in the world, so it is the first to be undone")
        .when(|i| (DVec3::from(put_at(i, [0.0; 3])) - DVec3::from(i.2)).into())
        .when(|&(o, _, position, axes, scale)| {
            ((turned_back(axes, o.into()) - DVec3::from(position)) / DVec3::from(scale)).into()
        });
    let direction = Part::<Input, [f64; 3]>::new(|i| right(i)[1])
        .say(
            "the direction is of length 1 in object space too: then t counts in another unit than in the \
                 world, and hits of different meshes cannot be compared",
        )
        .when(|i| DVec3::from(right(i)[1]).normalize().into())
        .say("the direction is not divided by the scale; in object space it is longer or shorter, too")
        .when(|i| scaled(i, [1.0; 3])[1])
        .say("the place at t = 1 is taken for the direction: it is that less the origin")
        .when(|i| right(&((DVec3::from(i.0) + DVec3::from(i.1)).into(), i.1, i.2, i.3, i.4))[0])
        .say("the direction stays as it is in the world; it is turned and scaled, too")
        .when(|i| i.1)
        .say("the direction is moved by the position; it is no place, and only turned and scaled")
        .when(|&(_, d, position, axes, scale)| right(&(d, d, position, axes, scale))[0])
        .say(
            "the direction is multiplied by the scale, as a normal would be; it is divided by it, as the \
                 origin is",
        )
        .when(|i| scaled(i, i.4.map(|part| 1.0 / part))[1])
        .say(TIMES)
        .when(|i| scaled(i, i.4.map(|part| 1.0 / part))[1]);
    let whole = Part::<[[f64; 3]; 2], Answer>::new(|&ray| ray)
        .say("the two are swapped: the origin is first")
        .when(|&[origin, direction]| [direction, origin]);
    Mistakes::<Input, Answer>::new()
        .say("the turn is left out; it is undone, as the scale is")
        .when(|&(o, d, position, _, scale)| right(&(o, d, position, DMat3::IDENTITY.to_cols_array_2d(), scale)))
        .say("the scale is left out")
        .when(|i| scaled(i, [1.0; 3]))
        .say("one factor is taken for all three axes; each has its own")
        .when(|i| scaled(i, [i.4[0]; 3]))
        .say("the turn is to be undone before the scale, which is along the turned axes")
        .when(|&(o, d, position, axes, scale)| {
            [DVec3::from(o) - DVec3::from(position), d.into()].map(|v| turned_back(axes, v / DVec3::from(scale)).into())
        })
        .say(
            "the vector is taken from object to world space; to object space each component is its product \
                 with one axis",
        )
        .when(|&(o, d, position, axes, scale)| right(&(o, d, position, transposed(axes), scale)))
        .say(
            "that leads from the object to the world; asked is the opposite: subtract the position, undo the \
                 turn, divide by the scale",
        )
        .when(|&(o, d, position, axes, scale)| {
            let [o, d] = [o, d].map(|v| turned_back(transposed(axes), DVec3::from(v) * DVec3::from(scale)));
            [o + DVec3::from(position), d].map(DVec3::into)
        })
        .of_parts([origin, direction], whole)
}

fn scaled(&(o, d, position, axes, _): &Input, scale: [f64; 3]) -> Answer {
    right(&(o, d, position, axes, scale))
}

fn transposed(axes: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    DMat3::from_cols_array_2d(&axes).transpose().to_cols_array_2d()
}

/// A vector's component along each axis.
fn turned_back(axes: [[f64; 3]; 3], vector: DVec3) -> DVec3 {
    DMat3::from_cols_array_2d(&axes).transpose() * vector
}

/// By the inverse matrix, as pinhole does it.
fn right(&(origin, direction, position, axes, scale): &Input) -> Answer {
    let world_from_object = DMat3::from_cols_array_2d(&axes) * DMat3::from_diagonal(scale.into());
    let object_from_world = world_from_object.inverse();
    let start = point_object_from_world(object_from_world, position.into(), origin.into());
    [start.into(), direction_object_from_world(object_from_world, direction.into()).into()]
}

fn asked() -> Vec<Probe<Input>> {
    let (here, ahead, upright) = ([0.0; 3], [0.0, 0.0, -1.0], DMat3::IDENTITY.to_cols_array_2d());
    let mut asked: Vec<_> = probes("a mesh that is not moved", [(here, ahead, here, upright, [1.0; 3])]).collect();
    asked.extend(probes("a mesh that is moved", [([0.5, 0.25, 3.0], ahead, [0.5, 0.0, -4.0], upright, [1.0; 3])]));
    asked.extend(probes("twice as large", [(here, ahead, [0.0, 0.0, -4.0], upright, [2.0; 3])]));
    asked.extend(probes("flatter", [([1.0, 1.0, 2.0], [0.6, -0.8, 0.0], here, upright, [1.0, 0.25, 1.0])]));
    let quarter = [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
    asked.extend(probes("a quarter turn", [([1.0, 2.0, 3.0], [0.0, 0.6, -0.8], here, quarter, [1.0; 3])]));
    asked.extend(probes("mirrored", [([1.0, 2.0, 3.0], [0.0, 0.6, -0.8], here, upright, [-1.0, 1.0, 1.0])]));
    asked.extend(probes("any placement", (0..200).map(placed)));
    asked
}

/// A ray and a mesh anywhere, turned and scaled.
fn placed(index: u64) -> Input {
    let mut draws = Draws::new(2801, index);
    let mut three = |extent: f64| [0, 1, 2].map(|_| draws.between(-extent, extent));
    let (origin, position, turn, scale) = (three(3.0), three(3.0), three(1.0), three(1.0));
    let turn = DQuat::from_xyzw(turn[0], turn[1], turn[2], 0.5).normalize();
    let axes = DMat3::from_quat(turn).to_cols_array_2d();
    // From a quarter to four times as long.
    let scale = scale.map(|part| libm::exp2(2.0 * part));
    (origin, draws.unit_vector().into(), position, axes, scale)
}

const TIMES: &str = "the ray is multiplied by the scale: what is longer in the world has the same numbers in its own space, so divide by it";

/// The origin, with the mesh in another place.
fn put_at(&(o, d, _, axes, scale): &Input, position: [f64; 3]) -> [f64; 3] {
    right(&(o, d, position, axes, scale))[0]
}

/// The closest mesh of each ray, each asked along the ray that the reader's function gives, wherever that is in the world.
fn mine(ask: Ask<Input, Answer>, _: &Setting<'_>) -> StandIn {
    StandIn::instead(
        intersect::mesh_stage,
        move |meshes: Res<Shared<MeshTable>>,
              mut tiles: Query<(RowPlaces, &WorldRays, &mut Hits, Option<&mut HitPrimitives>)>| {
            for (place, rays, mut hits, mut primitives) in &mut tiles {
                for row in 0..rays.rows() {
                    let ray = [rays.origin_of(row), rays.direction_of(row)];
                    for (mesh, &shape) in meshes.row.iter().zip(&meshes.shape) {
                        let columns = [0, 1, 2].map(|axis| mesh.world_from_object.col(axis));
                        let (scale, axes) =
                            (columns.map(DVec3::length), columns.map(|column| column.normalize().into()));
                        let asked = (ray[0].into(), ray[1].into(), mesh.position.into(), axes, scale);
                        let Some([origin, direction]) = ask.at(place, row, asked) else { continue };
                        let origin = mesh.world_from_object * DVec3::from(origin) + mesh.position;
                        let closest = mesh.closest(origin, mesh.world_from_object * DVec3::from(direction));
                        if closest.t < hits.t[row] {
                            (hits.t[row], hits.shape[row]) = (closest.t, shape);
                            if let Some(primitives) = &mut primitives {
                                primitives.primitive[row] = closest.primitive;
                            }
                        }
                    }
                }
            }
        },
    )
}
