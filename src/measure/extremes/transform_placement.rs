//! Placements: planes and spheres through parents, judged by the author's own numbers; what has no volume; look-at.

use super::transform_aim::{scales, turn};
use super::transform_surface::angle;
use super::{Group, Method, Tally, Trial};
use crate::extract::{Ellipsoid, EllipsoidTable, PlaneTable, SMALLEST_PIXEL, look_at_axes, world_from_entity};
use crate::measure::exact::{Dyadic, UNIT_ROUNDOFF_F32 as U};
use crate::measure::exact_vector::ExactVector;
use crate::measure::oracle_ellipsoid::excess;
use crate::measure::ray_aim::Draws;
use crate::naive::ellipsoid::{inverse_of_the_whole, look_at_unchecked, normal_as_direction};
use crate::plan::Table;
use crate::scene::{ChildOf, LookAt, Matte, PerspectiveCamera, Placement, Plane, Sphere};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};
use std::ops::Range;

const PLANES: [Method; 2] = [
    Method::kit("kit, normal, angle to the exact one", "u", 4.0),
    Method::naive("naive, normal as a direction", "u", 4.0),
];
const PIXELS: [Method; 2] = [
    Method::kit("kit, inverse from each placement", "px", 0.01),
    Method::naive("naive, inverse by the determinant", "px", 0.01),
];
const REFUSALS: [Method; 1] = [Method::kit("kit, refused beyond, taken within", "", 0.0)];
const LOOK_AT: [Method; 2] = [
    Method::kit("kit, refused or orthonormal", "u", 4.0),
    Method::naive("naive, cross and normalize", "u", 4.0),
];

/// The cases of placements.
pub fn trials() -> Vec<Trial> {
    let trial = |name, methods: &[Method], judge: fn(Range<u64>) -> Tally| {
        Trial::new(Group::Transform, name, methods, judge)
    };
    vec![
        trial("planes mirrored and 1e3 times as long, under 0 to 2 parents", &PLANES, judge_planes),
        trial("the author's ellipsoid, up to 1e7 times as long, 0 or 1 parent", &PIXELS, judge_pixels),
        trial("a scale of 0, and near it", &REFUSALS, judge_refusals),
        trial("look-at: eye = target, up along the view, any length", &LOOK_AT, judge_look_at),
    ]
}

/// Placements from the entity up to its last parent.
fn chain(draws: &mut Draws, parents: u32, ratio: f64) -> Vec<Placement> {
    let count = 1 + (draws.unit() * f64::from(parents + 1)) as u32;
    let mut placement = || {
        let scale = draws.power_of_ten(0.0, ratio);
        let position = draws.unit_vector() * draws.unit();
        Placement { scale: scales(draws, scale), orientation: turn(draws), position }
    };
    (0..count).map(|_| placement()).collect()
}

/// A scene with a camera at the origin and a shape under these placements.
fn scene(shape: impl Bundle, chain: &[Placement]) -> (World, Entity) {
    let mut world = World::new();
    world.spawn(PerspectiveCamera::default());
    let entity = world.spawn((shape, Matte::default(), chain[0])).id();
    let mut child = entity;
    for &placement in &chain[1..] {
        let parent = world.spawn(placement).id();
        world.entity_mut(child).insert(ChildOf(parent));
        child = parent;
    }
    (world, entity)
}

/// M v, exactly.
fn mapped(map: DMat3, v: &ExactVector) -> ExactVector {
    let [x, y, z] = [0, 1, 2].map(|row| ExactVector::of(map.row(row).to_array()).dot(v));
    ExactVector { x, y, z }
}

fn by_parts(v: &ExactVector, factors: [&Dyadic; 3]) -> ExactVector {
    ExactVector { x: &v.x * factors[0], y: &v.y * factors[1], z: &v.z * factors[2] }
}

/// A point through all placements, exactly.
fn exact_point(chain: &[Placement], point: DVec3) -> ExactVector {
    chain.iter().fold(ExactVector::of(point), |point, placement| {
        let scale = ExactVector::of(placement.scale);
        let turned = mapped(axes(placement), &by_parts(&point, [&scale.x, &scale.y, &scale.z]));
        turned.minus(&ExactVector::of(-placement.position))
    })
}

/// Along the exact normal: by the cofactors of each map, which are its inverse transpose but for the determinant.
fn exact_normal(chain: &[Placement], normal: DVec3) -> ExactVector {
    chain.iter().fold(ExactVector::of(normal), |normal, placement| {
        let (axes, ExactVector { x, y, z }) = (axes(placement), ExactVector::of(placement.scale));
        let [right, up, back] = [0, 1, 2].map(|axis| ExactVector::of(axes.col(axis)));
        let sign = Dyadic::of(if placement.scale.to_array().iter().product::<f64>() < 0.0 { -1 } else { 1 });
        let scaled = by_parts(&normal, [&(&y * &z), &(&z * &x), &(&x * &y)]).times(&sign);
        let parts = [up.cross(&back).times(&scaled.x), back.cross(&right).times(&scaled.y)];
        let sum = right.cross(&up).times(&-&scaled.z);
        parts[0].minus(&sum).minus(&parts[1].times(&Dyadic::of(-1)))
    })
}

fn axes(placement: &Placement) -> DMat3 {
    DMat3::from_quat(placement.orientation.normalize())
}

fn judge_planes(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(PLANES.len());
    for index in range {
        let mut draws = Draws::new(131, index);
        let (chain, normal) = (chain(&mut draws, 2, 3.0), draws.unit_vector());
        let (world, entity) = scene(Plane { normal }, &chain);
        let table = PlaneTable::extract(&world);
        tally.count(table.is_ok());
        let (Ok(table), Ok(map)) = (table, world_from_entity(&world, "", entity)) else {
            tally.scores[0].judge(false);
            continue;
        };
        let exact = exact_normal(&chain, normal);
        tally.scores[0].measure(angle(table.normal[0].as_vec3(), &exact));
        tally.scores[1].measure(angle(normal_as_direction(map.matrix3, normal).as_vec3(), &exact));
    }
    tally
}

/// How far the author's surface lies off the table's, in the narrowest pixels, seen from as far as it is long.
fn judge_pixels(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(PIXELS.len());
    for index in range {
        let mut draws = Draws::new(132, index);
        let (chain, radius) = (chain(&mut draws, 1, 3.5), draws.between(0.5, 2.0));
        let on_unit = draws.unit_vector();
        let (world, entity) = scene(Sphere { radius }, &chain);
        let (table, map) = (EllipsoidTable::extract(&world), world_from_entity(&world, "", entity));
        let ellipsoid = table.as_ref().ok().and_then(|table| table.ellipsoid.first().copied());
        tally.count(ellipsoid.is_some());
        let (Some(ellipsoid), Ok(map)) = (ellipsoid, map) else {
            // A draw that happens to be nearly even is a sphere.
            tally.scores[0].judge(table.is_ok());
            continue;
        };
        let point = exact_point(&chain, on_unit * (radius / on_unit.length()));
        let point = DVec3::new(point.x.to_f64(), point.y.to_f64(), point.z.to_f64());
        let pixels = |ellipsoid: &Ellipsoid| {
            let map = ellipsoid.unit_from_world;
            let gradient = map.transpose() * (map * (point - ellipsoid.centre)) * 2.0;
            let off = excess(point, ellipsoid).to_f64().abs() / gradient.length();
            off / ellipsoid.reach / SMALLEST_PIXEL
        };
        tally.scores[0].measure(pixels(&ellipsoid));
        let unit_from_world = inverse_of_the_whole(map.matrix3) * (1.0 / radius);
        tally.scores[1].measure(pixels(&Ellipsoid { unit_from_world, ..ellipsoid }));
    }
    tally
}

fn judge_refusals(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(REFUSALS.len());
    for index in range {
        let mut draws = Draws::new(133, index);
        let [beyond, zero, parent] = [(); 3].map(|()| draws.unit() < 0.5);
        let ratio = if beyond { draws.power_of_ten(7.01, 12.0) } else { draws.power_of_ten(0.1, 6.99) };
        let mut scale = scales(&mut draws, ratio);
        if beyond && zero {
            scale[(draws.unit() * 3.0) as usize] = 0.0;
        }
        let even = Placement { orientation: turn(&mut draws), ..Placement::default() };
        let uneven = Placement { scale, orientation: turn(&mut draws), ..Placement::default() };
        let chain = if parent { vec![even, uneven] } else { vec![uneven] };
        let (world, _) = scene(Sphere::default(), &chain);
        let refused = crate::extract::validate(&world).is_err();
        tally.count(!refused);
        tally.scores[0].judge(refused == beyond);
    }
    tally
}

fn judge_look_at(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(LOOK_AT.len());
    for index in range {
        let mut draws = Draws::new(134, index);
        let eye = draws.unit_vector() * draws.power_of_ten(-8.0, 8.0);
        let view = draws.unit_vector();
        let (here, along, none) = (draws.unit() < 0.1, draws.unit() < 0.1, draws.unit() < 0.1);
        let target = if here { eye } else { eye + view * draws.power_of_ten(-8.0, 8.0) };
        let aside = if along { 0.0 } else { draws.power_of_ten(-12.0, 0.0) };
        let view = (target - eye).try_normalize().unwrap_or(view);
        let length = if none { 0.0 } else { draws.power_of_ten(-30.0, 30.0) };
        let up = (view + draws.unit_vector_across(view) * aside) * length;
        let axes = look_at_axes("camera", &LookAt { eye, target, up });
        tally.count(axes.is_ok());
        let nothing = target == eye || along || none;
        let plain = !nothing && aside > 1e-5;
        tally.scores[0].judge(if nothing { axes.is_err() } else { axes.is_ok() || !plain });
        if let Ok(axes) = axes {
            tally.scores[0].measure(off_orthonormal(axes));
        }
        tally.scores[1].measure(off_orthonormal(look_at_unchecked(eye, target, up)));
    }
    tally
}

/// The worst part of AᵀA − I and of det A − 1, in u; infinite where A is not a number.
fn off_orthonormal(axes: DMat3) -> f64 {
    let off = (axes.transpose() * axes - DMat3::IDENTITY).to_cols_array();
    let parts = off.iter().copied().chain([axes.determinant() - 1.0]);
    parts.fold(0.0, |worst: f64, part| if part.is_nan() { f64::INFINITY } else { worst.max(part.abs()) }) / U
}
