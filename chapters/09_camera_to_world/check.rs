//! Chapter 09: a normal, turned, stretched, mirrored and sheared with its surface, compared with exact arithmetic.

use bevy_ecs::prelude::*;
use glam::{DMat3, DQuat, DVec3};
use pinhole::extract::{EllipsoidTable, ShapeTable};
use pinhole::intersect;
use pinhole::intersect::{Hits, ShapeRows, Surfaces};
use pinhole::plan::Shared;
use pinhole::rays::WorldRays;
use pinhole::shapes::Ellipsoid;
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Part, Probe, Question, RowPlaces, Setting, Shown, StandIn, probes,
};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::exact::Dyadic;
use pinhole_lab::measure::exact_vector::ExactVector;

type Vector = [f64; 3];

/// The columns of the map, and the normal in object space.
type Input = ([Vector; 3], Vector);

/// What the reader writes.
pub type Yours = fn([Vector; 3], Vector) -> Vector;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("normal_world_from_object", question, move |&(columns, normal)| yours(columns, normal), mine)
}

fn question() -> Question<Input, Vector> {
    Question {
        pinhole_has: ("src/pinhole/shapes/space.rs", "normal_world_from_object"),
        probes: asked(),
        tell: |(columns, normal)| format!("columns {}, normal {}", columns.shown(), normal.shown()),
        right: |&(columns, normal)| {
            let normal = outward(columns, normal);
            let length = normal.length();
            [normal.x, normal.y, normal.z].map(|part| part.divided_by(&length).to_f64())
        },
        apart: |yours, right| absolute(yours, right),
        allowed: 1e-9,
        measured: "in a part",
        mistakes: mistakes(),
        hints: &[
            "the normal must stay at a right angle to everything that lies in the surface: n · v = 0 must become \
             n' · Mv = 0",
            "n' · Mv = (Mᵀn') · v, so Mᵀn' = n will do: n' is the inverse of the transpose of M, times n, brought to \
             length 1",
            "that matrix can be made of three cross products of the columns; of the determinant a unit vector keeps \
             the sign only, which is −1 in a mirroring map",
        ],
    }
}

fn mistakes() -> Mistakes<Input, Vector> {
    let turned = Part::<Input, DVec3>::new(|i| inverse_transpose(i) * normal(i))
        .say("the normal is mapped as a direction is; where the map stretches unevenly it tips over")
        .when(|i| matrix(i) * normal(i))
        .say("the inverse is not transposed, or the columns are taken for rows")
        .when(|i| matrix(i).inverse() * normal(i))
        .when(|i| cofactors(i).transpose() * normal(i))
        .say(
            "the normal is multiplied by the transpose; in Mᵀn' = n the unknown is n', so the transpose must \
                 be inverted",
        )
        .when(|i| matrix(i).transpose() * normal(i))
        .say("a mirroring map turns the normal inside out: the sign of the determinant is missing")
        .when(|i| cofactors(i) * normal(i))
        .say("the normal points inward: nothing may turn it, for the inverse transpose keeps its side")
        .when(|i| -(inverse_transpose(i) * normal(i)))
        .say(
            "the normal is turned to the side of the old one; a rotation may rightly take it beyond 90° from \
                 there",
        )
        .when(|i| towards(inverse_transpose(i) * normal(i), normal(i)))
        .when(|i| towards(matrix(i) * normal(i), normal(i)))
        .say(
            "the normal is divided by the length of each column; that is right only while the columns are at \
                 right angles",
        )
        .when(|i| scaled_axes(i, 2) * normal(i))
        .say("the scale is left out, as if the map only turned")
        .when(|i| scaled_axes(i, 1) * normal(i))
        .say("a cross product is in the wrong order: they go round, y × z, z × x, x × y")
        .when(|i| inverse_transpose(i) * (normal(i) * DVec3::new(1.0, -1.0, 1.0)))
        .when(|i| inverse_transpose(i) * (normal(i) * DVec3::new(-1.0, 1.0, 1.0)))
        .when(|i| inverse_transpose(i) * (normal(i) * DVec3::new(1.0, 1.0, -1.0)))
        .when(|i| cofactors(i) * (normal(i) * DVec3::new(1.0, -1.0, 1.0)))
        .when(|i| cofactors(i) * -normal(i))
        .say(
            "the cross products are given to the wrong parts: x of the normal goes with y × z, y with z × x, z \
                 with x × y",
        )
        .when(|i| inverse_transpose(i) * DVec3::new(i.1[2], i.1[0], i.1[1]))
        .say("the normal is handed back as it is; it turns with its surface")
        .when(normal)
        .say(
            "the normal is mapped as a direction is, and only turned where the map mirrors; uneven stretching \
                 tips it over",
        )
        .when(|i| matrix(i) * normal(i) * matrix(i).determinant())
        .say("only the numbers on the diagonal count; a map that turns has others")
        .when(|i| normal(i) / DVec3::new(i.0[0][0], i.0[1][1], i.0[2][2]));
    let brought_to_1 = Part::<[DVec3; 1], Vector>::new(|[v]| v.normalize().into())
        .say("the normal is not of length 1")
        .when(|&[v]| v.into())
        .say("the normal is divided by its squared length: a square root is missing")
        .when(|&[v]| (v / v.length_squared()).into());
    Mistakes::<Input, Vector>::new()
        .asked_as_given()
        .say("the normal is not of length 1")
        .when(|i| (cofactors(i) * normal(i)).into())
        .of_parts([turned], brought_to_1)
}

fn asked() -> Vec<Probe<Input>> {
    let side = |x, y, z| DVec3::new(x, y, z).normalize().to_array();
    let stretched = |x, y, z| [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
    let (tilted, tipped) = (side(1.0, 1.0, 0.0), side(1.0, -2.0, 2.0));
    let some = |seed, map: fn(&mut Draws) -> DMat3| {
        (0..30).map(move |at| {
            let mut draws = Draws::new(seed, at);
            let columns = map(&mut draws).to_cols_array_2d();
            (columns, draws.unit_vector().to_array())
        })
    };
    let mut asked: Vec<_> = probes("nothing is changed", [(stretched(1.0, 1.0, 1.0), tilted)]).collect();
    asked.extend(probes("turned", some(901, turned)));
    asked.extend(probes("twice as large", [tilted, tipped].map(|n| (stretched(2.0, 2.0, 2.0), n))));
    asked.extend(probes("stretched unevenly", [tilted, tipped].map(|n| (stretched(2.0, 1.0, 1.0), n))));
    asked.extend(probes("stretched unevenly and turned", some(902, |draws| turned(draws) * scaled(draws, 1.0))));
    asked
        .extend(probes("sheared", [tilted, tipped].map(|n| ([[1.0, 0.0, 0.0], [0.75, 1.0, 0.0], [0.0, 0.0, 1.0]], n))));
    asked.extend(probes(
        "turned, stretched, turned again: sheared",
        some(903, |draws| turned(draws) * scaled(draws, 0.5) * turned(draws)),
    ));
    asked.extend(probes("mirrored", [tilted, tipped].map(|n| (stretched(-1.0, 1.0, 1.0), n))));
    asked.extend(probes("mirrored three times", [tilted, tipped].map(|n| (stretched(-1.0, -2.0, -3.0), n))));
    asked.extend(probes(
        "mirrored, stretched and turned",
        some(904, |draws| {
            turned(draws) * scaled(draws, 0.5) * DMat3::from_diagonal(DVec3::new(1.0, -1.0, 1.0)) * turned(draws)
        }),
    ));
    asked.extend(probes("a millionth of its size", [(stretched(1e-6, 2e-6, 1e-6), tipped)]));
    asked.extend(probes("nearly planar", [(stretched(1.0, 1e-6, 1.0), tipped), (stretched(1e6, 1.0, 1e6), tilted)]));
    asked
}

fn turned(draws: &mut Draws) -> DMat3 {
    let [x, y, z] = draws.unit_vector().to_array();
    DMat3::from_quat(DQuat::from_xyzw(x, y, z, draws.between(-2.0, 2.0)).normalize())
}

fn scaled(draws: &mut Draws, powers: f64) -> DMat3 {
    let mut factor = || draws.power_of_ten(-powers, powers);
    DMat3::from_diagonal(DVec3::new(factor(), factor(), factor()))
}

/// The inverse transpose times the normal, times the size of the determinant: exact, and of any length.
fn outward([a, b, c]: [Vector; 3], normal: Vector) -> ExactVector {
    let [a, b, c] = [a, b, c].map(ExactVector::of);
    let [x, y, z] = normal.map(Dyadic::of);
    let (bc, ca, ab) = (b.cross(&c).times(&x), c.cross(&a).times(&y), a.cross(&b).times(&z));
    let sign = Dyadic::of(a.dot(&b.cross(&c)).sign());
    let sum = |bc: &Dyadic, ca: &Dyadic, ab: &Dyadic| &(&(bc + ca) + ab) * &sign;
    ExactVector { x: sum(&bc.x, &ca.x, &ab.x), y: sum(&bc.y, &ca.y, &ab.y), z: sum(&bc.z, &ca.z, &ab.z) }
}

fn matrix(&(columns, _): &Input) -> DMat3 {
    DMat3::from_cols_array_2d(&columns)
}

fn inverse_transpose(input: &Input) -> DMat3 {
    matrix(input).inverse().transpose()
}

fn normal(&(_, normal): &Input) -> DVec3 {
    normal.into()
}

/// The inverse transpose times the determinant: its columns are y × z, z × x and x × y.
fn cofactors(input: &Input) -> DMat3 {
    inverse_transpose(input) * matrix(input).determinant()
}

/// The columns, each over a power of its length.
fn scaled_axes(input: &Input, power: i32) -> DMat3 {
    let [a, b, c] = input.0.map(|column| DVec3::from(column) / DVec3::from(column).length().powi(power));
    DMat3::from_cols(a, b, c)
}

fn towards(vector: DVec3, side: DVec3) -> DVec3 {
    if vector.dot(side) < 0.0 { -vector } else { vector }
}

/// Normals of ellipsoids, from those of the unit spheres that they are in object space.
fn mine(ask: Ask<Input, Vector>, _: &Setting<'_>) -> StandIn {
    StandIn::after(
        intersect::ellipsoid_surface_stage,
        move |ellipsoids: Res<Shared<EllipsoidTable>>,
              shapes: Res<Shared<ShapeTable>>,
              mut tiles: Query<(RowPlaces, &WorldRays, &Hits, &ShapeRows<Ellipsoid>, &mut Surfaces)>| {
            for (place, rays, hits, list, mut surfaces) in &mut tiles {
                for &row in &list.row {
                    let row = row as usize;
                    let ellipsoid = &ellipsoids.row[shapes.row[hits.shape[row] as usize] as usize];
                    let from_centre = rays.point_at(row, hits.t[row]) - ellipsoid.centre;
                    let own = (ellipsoid.unit_from_world * from_centre).normalize();
                    // The same ball may be turned and mirrored before it becomes the ellipsoid.
                    let turned = DMat3::from_rotation_z(0.6) * DMat3::from_rotation_x(-0.9) * -1.0;
                    let (map, own) = (ellipsoid.unit_from_world.inverse() * turned.transpose(), turned * own);
                    let columns = [map.x_axis, map.y_axis, map.z_axis].map(DVec3::into);
                    let Some(normal) = ask.at(place, row, (columns, own.into())) else { continue };
                    let mut surface = surfaces.get(row);
                    let outside = surface.normal.as_dvec3().dot(from_centre) >= 0.0;
                    let normal = DVec3::from(normal).as_vec3();
                    surface.normal = if outside { normal } else { -normal };
                    surfaces.set(row, surface);
                }
            }
        },
    )
}
