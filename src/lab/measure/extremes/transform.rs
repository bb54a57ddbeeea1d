//! Placements: planes and spheres through parents, checked by the author's own numbers; what has no volume; look-at.

use super::{Group, Method, Tally, Trial};
use crate::measure::draws::Draws;
use crate::measure::enclosure::Enclosure;
use crate::measure::exact::{Dyadic, UNIT_ROUNDOFF_F32 as U};
use crate::measure::exact_vector::{ExactVector, Vector, angles};
use crate::measure::number::Number;
use crate::measure::oracle_ellipsoid::excess;
use crate::measure::specimen::{scales, turn};
use crate::naive::ellipsoid::{look_at_unchecked, normal_as_direction};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};
use pinhole::extract::{EllipsoidTable, PlaneTable, SMALLEST_PIXEL, look_at_axes, world_from_entity};
use pinhole::plan::{Census, Table};
use pinhole::scene::{ChildOf, LookAt, Matte, PerspectiveCamera, Placement, Plane, Sphere};
use std::ops::Range;

/// The most inputs of a case that builds and validates a scene for each, which takes five times as long as a ray.
const SCENES: u64 = 200_000;

const PLANES: [Method; 2] = [
    Method::pinhole("pinhole, normal, angle to the exact one", "u", 4.0),
    Method::naive("naive, normal as a direction", "u", 4.0),
];
const PIXELS: [Method; 1] = [Method::pinhole("pinhole, inverse of each placement", "px", 1e-6)];
const REFUSALS: [Method; 1] = [Method::pinhole("pinhole, refused beyond, taken within", "", 0.0)];
const LOOK_AT: [Method; 2] = [
    Method::pinhole("pinhole, refused or orthonormal", "u", 4.0),
    Method::naive("naive, cross and normalize", "u", 4.0),
];

/// The cases of placements.
pub fn trials() -> Vec<Trial> {
    let trial =
        |name, methods: &[Method], check: fn(Range<u64>) -> Tally| Trial::new(Group::Transform, name, methods, check);
    vec![
        trial("planes mirrored and 1e3 times as long, under 0 to 2 parents", &PLANES, check_planes).at_most(SCENES),
        trial("the author's ellipsoid, up to 1e7 times as long, 0 or 1 parent", &PIXELS, check_pixels).at_most(SCENES),
        trial("a scale of 0, and near it", &REFUSALS, check_refusals).at_most(SCENES),
        trial("look-at: eye = target, up along the view, any length", &LOOK_AT, check_look_at),
    ]
}

/// Placements from the entity up to its last parent, each up to 10 to its power times as long one way as another.
fn chain(draws: &mut Draws, powers: &[f64]) -> Vec<Placement> {
    let mut placement = |&power: &f64| {
        let ratio = draws.power_of_ten(0.0, power);
        let position = draws.unit_vector() * draws.unit();
        Placement { scale: scales(draws, ratio), orientation: turn(draws), position }
    };
    powers.iter().map(&mut placement).collect()
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

/// M v.
fn mapped<N: Number>(map: DMat3, v: &Vector<N>) -> Vector<N> {
    let [x, y, z] = [0, 1, 2].map(|row| Vector::of(map.row(row).to_array()).dot(v));
    Vector { x, y, z }
}

fn by_parts<N: Number>(v: &Vector<N>, factors: [&N; 3]) -> Vector<N> {
    Vector { x: v.x.by(factors[0]), y: v.y.by(factors[1]), z: v.z.by(factors[2]) }
}

/// A point through all placements, exactly.
fn exact_point(chain: &[Placement], point: DVec3) -> ExactVector {
    chain.iter().fold(ExactVector::of(point), |point, placement| {
        let scale = ExactVector::of(placement.scale);
        let turned = mapped(axes(placement), &by_parts(&point, [&scale.x, &scale.y, &scale.z]));
        turned.minus(&ExactVector::of(-placement.position))
    })
}

/// Along the normal: by the cofactors of each map, which are its inverse transpose but for the determinant.
fn normal_through<N: Number>(chain: &[Placement], normal: DVec3) -> Vector<N> {
    chain.iter().fold(Vector::of(normal), |normal, placement| {
        let (axes, Vector { x, y, z }) = (axes(placement), Vector::<N>::of(placement.scale));
        let [right, up, back] = [0, 1, 2].map(|axis| Vector::<N>::of(axes.col(axis)));
        let sign = N::of(if placement.scale.to_array().iter().product::<f64>() < 0.0 { -1.0 } else { 1.0 });
        let scaled = by_parts(&normal, [&y.by(&z), &z.by(&x), &x.by(&y)]).times(&sign);
        // The cofactors of the axes: up × back, back × right, right × up, the last two turned round to be taken away.
        let [x, y, z] = [up.cross(&back), right.cross(&back), up.cross(&right)];
        x.times(&scaled.x).minus(&y.times(&scaled.y)).minus(&z.times(&scaled.z))
    })
}

fn axes(placement: &Placement) -> DMat3 {
    DMat3::from_quat(placement.orientation.normalize())
}

fn check_planes(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(PLANES.len());
    for index in range {
        let mut draws = Draws::new(131, index);
        let levels = 1 + (draws.unit() * 3.0) as usize;
        let (chain, normal) = (chain(&mut draws, &[3.0; 3][..levels]), draws.unit_vector());
        let (world, entity) = scene(Plane { normal }, &chain);
        let census = &Census::of(&world);
        let table = PlaneTable::extract(census);
        tally.count(table.is_ok());
        let (Ok(table), Ok(map)) = (table, world_from_entity(census, "", entity)) else {
            tally.scores[0].check(false);
            continue;
        };
        let normals = [table.row[0].normal, normal_as_direction(map.matrix3, normal)].map(|normal| normal.as_vec3());
        let enclosed = Some(normal_through::<Enclosure>(&chain, normal));
        match angles(normals, enclosed, || Some(normal_through::<Dyadic>(&chain, normal))) {
            Some([pinhole, naive]) => {
                tally.scores[0].measure(pinhole);
                tally.scores[1].measure(naive);
            }
            None => tally.scores[0].check(false),
        }
    }
    tally
}

/// How far the author's surface lies off the table's, in the narrowest pixels, seen from as far as it is long.
fn check_pixels(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(PIXELS.len());
    for index in range {
        let mut draws = Draws::new(132, index);
        // Who stretches: the entity, its parent, or each a part.
        let fraction = [0.0, 1.0, draws.unit()][(draws.unit() * 3.0) as usize];
        let chain = chain(&mut draws, &[6.9 * fraction, 6.9 * (1.0 - fraction)]);
        let (radius, on_unit) = (draws.between(0.5, 2.0), draws.unit_vector());
        let (world, _) = scene(Sphere { radius }, &chain);
        let table = EllipsoidTable::extract(&Census::of(&world));
        let ellipsoid = table.as_ref().ok().and_then(|table| table.row.first().copied());
        tally.count(ellipsoid.is_some());
        let Some(ellipsoid) = ellipsoid else {
            // A draw that happens to be nearly even is a sphere.
            tally.scores[0].check(table.is_ok());
            continue;
        };
        let point = exact_point(&chain, on_unit * (radius / on_unit.length()));
        let point = DVec3::new(point.x.to_f64(), point.y.to_f64(), point.z.to_f64());
        let map = ellipsoid.unit_from_world;
        let gradient = map.transpose() * (map * (point - ellipsoid.centre)) * 2.0;
        let off = excess(point, &ellipsoid).to_f64().abs() / gradient.length();
        tally.scores[0].measure(off / ellipsoid.bounding_radius / SMALLEST_PIXEL);
    }
    tally
}

fn check_refusals(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(REFUSALS.len());
    for index in range {
        let mut draws = Draws::new(133, index);
        let [beyond, zero, parent] = [(); 3].map(|()| draws.unit() < 0.5);
        let ratio = if beyond { draws.power_of_ten(7.01, 12.0) } else { draws.power_of_ten(0.1, 6.98) };
        let mut scale = scales(&mut draws, ratio);
        if beyond && zero {
            scale[(draws.unit() * 3.0) as usize] = 0.0;
        }
        let even = Placement { orientation: turn(&mut draws), ..Placement::default() };
        let non_uniform = Placement { scale, orientation: turn(&mut draws), ..Placement::default() };
        let chain = if parent { vec![even, non_uniform] } else { vec![non_uniform] };
        let (world, _) = scene(Sphere::default(), &chain);
        let refused = pinhole::extract::validate(&Census::of(&world)).is_err();
        tally.count(!refused);
        tally.scores[0].check(refused == beyond);
    }
    tally
}

fn check_look_at(range: Range<u64>) -> Tally {
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
        tally.scores[0].check(if nothing { axes.is_err() } else { axes.is_ok() || !plain });
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
