//! Closed meshes: what is inside cannot look out, and what is aimed at an edge or a corner hits one of its faces.

use super::bench::Bench;
use super::triangle::{BESIDE, T_BOUND, by_function, exact};
use super::triangle_aim::{Mesh, ray_at};
use super::{Group, Method, Tally, Trial};
use crate::measure::ray_aim::{AimedRay, Draws};
use crate::naive::triangle::{hit_f32, hit_inside_strictly};
use glam::{DVec3, Vec3};
use pinhole::extract::TriangleTable;
use pinhole::intersect::{Hits, NO_SHAPE, start_stage, triangle_stage};
use std::ops::Range;

/// Rays that one mesh in one place is aimed at with.
const RAYS_A_MESH: u64 = 512;
/// Rays that the stage gets at once.
const AT_ONCE: usize = 64;

const METHODS: [Method; 3] = [
    Method::pinhole("pinhole, no ray leaks", "", 0.0),
    Method::pinhole("pinhole, faces about the edge or corner", "u of t", T_BOUND),
    Method::naive("naive Moller-Trumbore, 1e-6, f32", "", 0.0),
];
/// Rows of the case where rays lie on edges exactly.
const ON_EDGES: [Method; 3] = [
    Method::pinhole("pinhole, no ray leaks", "", 0.0),
    Method::pinhole("pinhole, every face", "u of t", T_BOUND),
    Method::naive("naive, strictly inside, f64", "", 0.0),
];

/// Where mesh and eye stand, and where rays start.
#[derive(Clone, Copy)]
struct View {
    seed: u64,
    place: DVec3,
    /// Whether the eye stands by the mesh; else at the world's origin, and the table's numbers are as large as the place.
    eye_near: bool,
    inside: bool,
    mesh: fn() -> Mesh,
}

/// The cases.
pub fn trials() -> Vec<Trial> {
    const FAR: DVec3 = DVec3::new(148_376.0, 1234.0, -223_423.0);
    let thousands = DVec3::new(1e4, 1e4, 1e4);
    let (ball, fans): (fn() -> Mesh, fn() -> Mesh) = (Mesh::icosahedron, || Mesh::fans(24));
    let views = [
        ("closed, edges and corners, from inside, at 0", DVec3::ZERO, false, true, ball),
        ("the same at (1e4, 1e4, 1e4), eye near", thousands, true, true, ball),
        ("the same at (1e4, 1e4, 1e4), eye at 0", thousands, false, true, ball),
        ("the same at (148376, 1234, -223423), eye near", FAR, true, true, ball),
        ("the same at (148376, 1234, -223423), eye at 0", FAR, false, true, ball),
        ("two fans of 24, from inside, at 0", DVec3::ZERO, false, true, fans),
        ("closed, edges and corners, from outside, at 0", DVec3::ZERO, false, false, ball),
    ];
    let trial = |(seed, (name, place, eye_near, inside, mesh)): (u64, (&str, DVec3, bool, bool, fn() -> Mesh))| {
        let view = View { seed, place, eye_near, inside, mesh };
        let trial = Trial::new(Group::Triangle, name, &METHODS, move |range| check(view, range));
        if inside { trial } else { trial.at_most(BESIDE) }
    };
    let mut trials: Vec<Trial> = (221..).zip(views).map(trial).collect();
    let on_edges = Trial::new(Group::Triangle, "closed, on a grid, rays exactly on edges", &ON_EDGES, check_on_edges);
    trials.push(on_edges.at_most(BESIDE));
    trials
}

fn check(view: View, range: Range<u64>) -> Tally {
    let mut tally = Tally::new(METHODS.len());
    let mut bench = Bench::new(&[start_stage(), triangle_stage()]);
    let mut start = range.start;
    while start < range.end {
        let number = start / RAYS_A_MESH;
        let end = range.end.min((number + 1) * RAYS_A_MESH);
        let mut draws = Draws::new(view.seed, number);
        let beside = draws.unit_vector() * 8.0;
        let eye = if view.eye_near { view.place + beside } else { DVec3::ZERO };
        match (view.mesh)().placed(&mut draws, eye, view.place) {
            Ok(table) => check_mesh(view, &mut bench, &table, view.place - eye, start..end, &mut tally),
            Err(_) => tally.scores[0].check(false),
        }
        start = end;
    }
    tally
}

fn check_mesh(
    view: View,
    bench: &mut Bench,
    table: &TriangleTable,
    centre: DVec3,
    range: Range<u64>,
    tally: &mut Tally,
) {
    bench.insert(table.clone());
    let rounded: Vec<[Vec3; 3]> = table.row.iter().map(|triangle| triangle.corners.map(|c| c.as_vec3())).collect();
    let rays: Vec<(AimedRay, [DVec3; 2])> = range.map(|index| aimed(view, table, centre, index)).collect();
    for rays in rays.chunks(AT_ONCE) {
        bench.aim(&rays.iter().map(|&(ray, _)| ray).collect::<Vec<_>>());
        bench.run();
        let hits = bench.column::<Hits>().clone();
        for (row, &(ray, at)) in rays.iter().enumerate() {
            let hit = hits.shape[row] != NO_SHAPE;
            tally.count(hit);
            let nearest = table.row.iter().map(|triangle| by_function(ray, triangle)).fold(f64::INFINITY, f64::min);
            let must = view.inside || hit || table.row.iter().any(|triangle| exact(ray, triangle.corners).is_some());
            tally.scores[0].check(hits.t[row].to_bits() == nearest.to_bits() && hit == must);
            let found = table.row.get(hits.shape[row] as usize);
            let about = table.row.iter().filter(|triangle| at.iter().all(|corner| triangle.corners.contains(corner)));
            for triangle in about.chain(found) {
                let t = by_function(ray, triangle);
                tally.scores[1].check_t(Some(t).filter(|t| t.is_finite()), exact(ray, triangle.corners));
            }
            if must {
                let by_f32 = rounded.iter().any(|&corners| hit_f32(ray.origin, ray.direction, corners).is_some());
                tally.scores[2].check(by_f32);
            }
        }
    }
}

/// A ray at an edge or a corner: from well inside, or from outside, 1.5 to 150 units from the middle.
fn aimed(view: View, table: &TriangleTable, centre: DVec3, index: u64) -> (AimedRay, [DVec3; 2]) {
    let mut draws = Draws::new(view.seed + 1000, index);
    let away = if view.inside { draws.between(0.0, 0.5) } else { 3.2 * draws.power_of_ten(0.0, 2.0) };
    let origin = (centre + draws.unit_vector() * away).as_vec3();
    ray_at(&mut draws, table, origin)
}

/// An octahedron of edges and corners that f32 holds, looked at from inside along rays that lie on an edge without any
/// rounding: a ray that no face claims would leak.
fn check_on_edges(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(ON_EDGES.len());
    let mut bench = Bench::new(&[start_stage(), triangle_stage()]);
    let table = Mesh::octahedron();
    bench.insert(table.clone());
    for index in range {
        let mut draws = Draws::new(235, index);
        let mut eighth = |most: f64| draws.between(-most, most + 1.0).floor() / 8.0;
        let origin = DVec3::new(eighth(2.0), eighth(2.0), eighth(2.0));
        let fraction = eighth(4.0) + 0.5;
        let face = &table.row[(draws.unit() * 8.0) as usize];
        let target = face.corners[0] * fraction + face.corners[1] * (1.0 - fraction);
        let ray = AimedRay { origin: origin.as_vec3(), direction: (target - origin).as_vec3() };
        bench.aim(&[ray]);
        bench.run();
        let hit = bench.column::<Hits>().shape[0] != NO_SHAPE;
        tally.count(hit);
        tally.scores[0].check(hit);
        for triangle in &table.row {
            let t = by_function(ray, triangle);
            tally.scores[1].check_t(Some(t).filter(|t| t.is_finite()), exact(ray, triangle.corners));
        }
        let strictly =
            |corners| hit_inside_strictly(ray.origin.as_dvec3(), ray.direction.as_dvec3(), corners).is_some();
        tally.scores[2].check(table.row.iter().any(|triangle| strictly(triangle.corners)));
    }
    tally
}
