//! Closed meshes: what is inside cannot look out, and what is aimed at an edge or a corner hits one of its faces; and
//! where on a triangle a ray hits it.

use super::bench::Bench;
use super::{Group, Method, Tally, Trial};
use crate::measure::draws::Draws;
use crate::measure::exact::UNIT_ROUNDOFF_F32 as U;
use crate::measure::oracle_triangle::{exact_weights, triangle_t as exact_t};
use crate::measure::ray_aim::{AimedRay, rounded_ray};
use crate::measure::specimen::{scales, turn};
use crate::naive::triangle::{hit_f32, hit_inside_strictly, normal_by_winding};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3, Vec3};
use pinhole::extract::TriangleTable;
use pinhole::intersect::{Hits, NO_SHAPE, shading_normal, start_stage, triangle_stage};
use pinhole::plan::{Census, Table};
use pinhole::scene::{ChildOf, Matte, PerspectiveCamera, Placement, SceneError, Triangle};
use pinhole::shapes::{TriangleFace, TriangleHit, TriangleRow, triangle_t};
use std::ops::Range;

/// Three corners in render space.
type Corners = [DVec3; 3];

/// Rays of the cases beside those that the floor of a million is about.
const BESIDE: u64 = 100_000;
/// How far t may be off, relative to itself, in u.
const T_BOUND: f64 = 1.0;

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
    let slivers = Trial::new(Group::Triangle, "barycentrics, slivers, any slope", &BARYCENTRICS, check_barycentrics);
    trials.push(slivers.at_most(BESIDE));
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
        let mut eighth = |max: f64| draws.between(-max, max + 1.0).floor() / 8.0;
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

/// The exact distance, rounded to f64 once.
fn exact(ray: AimedRay, corners: Corners) -> Option<f64> {
    exact_t(ray.origin, ray.direction, corners)
}

/// The distance by pinhole's function of one ray and one triangle.
fn by_function(ray: AimedRay, triangle: &TriangleRow) -> f64 {
    triangle_t(ray.origin.as_dvec3(), ray.direction.as_dvec3(), triangle)
}

const BARYCENTRICS: [Method; 3] = [
    Method::pinhole("pinhole, each barycentric", "u", 1.0),
    Method::pinhole("pinhole, mean of three normals, its length", "u", 1.0),
    Method::naive("naive, barycentrics by areas from o + td", "u", 1.0),
];

/// The barycentric coordinates of the hit against the exact ones, absolute.
fn check_barycentrics(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(BARYCENTRICS.len());
    for index in range {
        let (ray, corners) = sliver(index);
        let triangle = TriangleRow::new(corners);
        let t = by_function(ray, &triangle);
        let truth = if t.is_finite() { exact_weights(ray.origin, ray.direction, triangle.corners) } else { None };
        tally.count(truth.is_some());
        let Some(truth) = truth else { continue };
        let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        let triangle_hit = TriangleHit::of(origin, direction, &triangle);
        let off =
            |barycentrics: [f64; 3]| barycentrics.iter().zip(truth).map(|(a, b)| (a - b).abs() / U).fold(0.0, f64::max);
        tally.scores[0].measure(off(triangle_hit.weights));
        let mut draws = Draws::new(252, index);
        let normals = [(); 3].map(|()| (DVec3::Z + draws.unit_vector() * 0.99).normalize());
        tally.scores[1].measure((shading_normal(&normals, &triangle_hit).length() - 1.0).abs() / U);
        tally.scores[2].measure(off(by_areas(origin + t * direction, &triangle)));
    }
    tally
}

/// The barycentric coordinates as areas about a point that was reached along the ray.
fn by_areas(point: DVec3, triangle: &TriangleRow) -> [f64; 3] {
    let [a, b, c] = triangle.corners;
    let normal = normal_by_winding([a, b, c]);
    let area = |b: DVec3, c: DVec3| (b - point).cross(c - point).dot(normal);
    let areas = [area(b, c), area(c, a), area(a, b)];
    let whole: f64 = areas.iter().sum();
    areas.map(|area| area / whole)
}

/// A sliver of any size, down to 1e-8 as high as long, and a ray at it from anywhere, at a slope down to 1e-9.
fn sliver(index: u64) -> (AimedRay, Corners) {
    let mut draws = Draws::new(251, index);
    let size = draws.power_of_ten(-8.0, 8.0);
    let height = size * draws.power_of_ten(-8.0, 0.0);
    let axes = turn(&mut draws);
    let planar = [DVec3::ZERO, DVec3::X * size, DVec3::new(draws.between(-0.25, 1.25) * size, height, 0.0)];
    let place = draws.unit_vector() * draws.power_of_ten(-8.0, 8.0);
    let corners = planar.map(|corner| axes * corner + place);
    let normal = axes * DVec3::Z;
    let (a, b) = (draws.unit(), draws.unit());
    let weights = if a + b > 1.0 { [1.0 - a, 1.0 - b, a + b - 1.0] } else { [a, b, 1.0 - a - b] };
    let target: DVec3 = corners.iter().zip(weights).map(|(&corner, weight)| corner * weight).sum();
    let leaving = draws.unit_vector_across(normal) + normal * draws.power_of_ten(-9.0, 0.0);
    let origin = (target + leaving * draws.power_of_ten(-8.0, 8.0)).as_vec3();
    (rounded_ray(origin, target - origin.as_dvec3()), corners)
}

/// The table of these triangles; a triangle's shape number is its place.
fn triangle_table(triangles: impl IntoIterator<Item = Corners>) -> TriangleTable {
    let mut table = TriangleTable::default();
    for (number, corners) in triangles.into_iter().enumerate() {
        table.push(TriangleFace::of(corners, [DVec2::ZERO, DVec2::X, DVec2::Y]), number as u32);
    }
    table
}

/// A closed mesh: every edge is shared by two faces.
struct Mesh {
    corners: Vec<DVec3>,
    faces: Vec<[usize; 3]>,
}

impl Mesh {
    /// Twenty equal faces about the origin, of radius 1.
    fn icosahedron() -> Self {
        let golden = 0.5 + libm::sqrt(1.25);
        let mut corners = Vec::new();
        for (long, short) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let corner = DVec3::new(0.0, short, golden * long);
            corners.extend([corner, DVec3::new(corner.z, 0.0, corner.y), DVec3::new(corner.y, corner.z, 0.0)]);
        }
        corners.iter_mut().for_each(|corner| *corner /= libm::hypot(1.0, golden));
        let near = |i: usize, j: usize| i < j && (1.0..1.2).contains(&corners[i].distance(corners[j]));
        let triples = (0..12).flat_map(|i| (0..12).flat_map(move |j| (0..12).map(move |k| [i, j, k])));
        let faces = triples.filter(|&[i, j, k]| near(i, j) && near(j, k) && near(i, k)).collect();
        Self { corners, faces }
    }

    /// Two tips of so many thin faces each, base to base.
    fn fans(count: usize) -> Self {
        let rim = (0..count).map(|corner| {
            let angle = std::f64::consts::TAU * corner as f64 / count as f64;
            DVec3::new(libm::cos(angle), libm::sin(angle), 0.0)
        });
        let corners = [DVec3::Z, DVec3::NEG_Z].into_iter().chain(rim).collect();
        let faces = (0..count).flat_map(|face| {
            let (here, next) = (2 + face, 2 + (face + 1) % count);
            [[0, here, next], [1, here, next]]
        });
        Self { corners, faces: faces.collect() }
    }

    /// Eight faces about the origin, their corners one unit along the axes, as they are.
    fn octahedron() -> TriangleTable {
        let signs = |bits: usize| [0, 1, 2].map(|bit| if bits >> bit & 1 == 0 { 1.0 } else { -1.0 });
        triangle_table((0..8).map(|bits| {
            let [x, y, z] = signs(bits);
            [DVec3::X * x, DVec3::Y * y, DVec3::Z * z]
        }))
    }

    /// A scene of it: the eye and the mesh at these places, the mesh turned and scaled unevenly by its parent, and
    /// extracted as a render does.
    ///
    /// Errors: none that a case should cause.
    fn placed(&self, draws: &mut Draws, eye: DVec3, place: DVec3) -> Result<TriangleTable, SceneError> {
        let mut scene = World::new();
        scene.spawn((PerspectiveCamera::default(), Placement { position: eye, ..Placement::default() }));
        let (orientation, scale) = (turn(draws).normalize(), scales(draws, 3.0));
        let parent = scene.spawn(Placement { position: place, orientation, scale }).id();
        for face in &self.faces {
            let vertices = face.map(|corner| self.corners[corner]);
            scene.spawn((Triangle { vertices, ..Triangle::default() }, Matte::default(), ChildOf(parent)));
        }
        TriangleTable::extract(&Census::of(&scene))
    }
}

/// A ray at an edge or a corner of a mesh, and the corners of the edge, or the corner twice.
fn ray_at(draws: &mut Draws, table: &TriangleTable, origin: Vec3) -> (AimedRay, [DVec3; 2]) {
    let corners = table.row[(draws.unit() * table.row.len() as f64) as usize].corners;
    let first = (draws.unit() * 3.0) as usize;
    let second = if draws.unit() < 0.5 { first } else { (first + 1) % 3 };
    let (a, b) = (corners[first], corners[second]);
    let target = a + (b - a) * draws.unit();
    (rounded_ray(origin, target - origin.as_dvec3()), [a, b])
}
