//! Triangles and closed meshes, and rays aimed at their edges, corners and flats.

use super::transform_aim::{scales, turn};
use crate::measure::ray_aim::{AimedRay, BAND_IN_QUANTA, Draws, rounded_ray};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3, Vec3};
use pinhole::extract::TriangleTable;
use pinhole::plan::{Census, Table};
use pinhole::scene::{ChildOf, Matte, PerspectiveCamera, Placement, SceneError, Triangle};
use pinhole::shapes::TriangleFace;

/// One direction quantum: the spacing of f32 numbers just below 1.
const QUANTUM: f64 = 1.0 / (1_u64 << 24) as f64;

/// Three corners in render space.
pub type Corners = [DVec3; 3];

/// Where a ray is aimed.
#[derive(Clone, Copy, Debug)]
pub enum SampleLights {
    /// Anywhere on it.
    Inside,
    /// At an edge, up to a few direction quanta.
    Edge,
    /// At a corner.
    Corner,
}

/// Where a ray comes from.
#[derive(Clone, Copy, Debug)]
pub enum From {
    /// The eye, 10^U(0, this) of the longest edge away.
    Eye(f64),
    /// Anywhere, 10^U(−8, 8) away, at a slope of 10^U(−this, 0).
    Anywhere(f64),
}

/// What a case draws.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The case.
    pub seed: u64,
    /// The height is 10^U(−this, 0) of the longest edge.
    pub thinnest: f64,
    /// Where rays go.
    pub aim: SampleLights,
    /// Where they come from.
    pub from: From,
}

/// A ray and a triangle of size 10^U(−8, 8).
pub fn shot(view: View, index: u64) -> (AimedRay, Corners) {
    let mut draws = Draws::new(view.seed, index);
    let size = draws.power_of_ten(-8.0, 8.0);
    let height = size * draws.power_of_ten(-view.thinnest, 0.0);
    let axes = turn(&mut draws);
    let planar = [DVec3::ZERO, DVec3::X * size, DVec3::new(draws.between(-0.25, 1.25) * size, height, 0.0)];
    let place = match view.from {
        From::Eye(farthest) => draws.unit_vector() * (size * draws.power_of_ten(0.0, farthest)),
        From::Anywhere(_) => draws.unit_vector() * draws.power_of_ten(-8.0, 8.0),
    };
    let corners = planar.map(|corner| axes * corner + place);
    let normal = axes * DVec3::Z;
    let weights = weights(&mut draws, view.aim);
    let target: DVec3 = corners.iter().zip(weights).map(|(&corner, weight)| corner * weight).sum();
    let slope = match view.from {
        From::Eye(_) => return (band(&mut draws, view.aim, Vec3::ZERO, target), corners),
        From::Anywhere(flattest) => draws.power_of_ten(-flattest, 0.0),
    };
    let leaving = draws.unit_vector_across(normal) + normal * slope;
    let origin = (target + leaving * draws.power_of_ten(-8.0, 8.0)).as_vec3();
    (band(&mut draws, view.aim, origin, target), corners)
}

/// Barycentric coordinates that lead to a point of the kind.
fn weights(draws: &mut Draws, aim: SampleLights) -> [f64; 3] {
    let (a, b) = (draws.unit(), draws.unit());
    let mut weights = match aim {
        SampleLights::Inside if a + b > 1.0 => [1.0 - a, 1.0 - b, a + b - 1.0],
        SampleLights::Inside => [a, b, 1.0 - a - b],
        SampleLights::Edge => [a, 1.0 - a, 0.0],
        SampleLights::Corner => [1.0, 0.0, 0.0],
    };
    weights.rotate_left((draws.unit() * 3.0) as usize);
    weights
}

/// The ray from there, beside an edge by up to a few direction quanta.
fn band(draws: &mut Draws, aim: SampleLights, origin: Vec3, target: DVec3) -> AimedRay {
    let towards = target - origin.as_dvec3();
    let beside = match aim {
        SampleLights::Edge => draws.between(-BAND_IN_QUANTA, BAND_IN_QUANTA) * QUANTUM * towards.length(),
        _ => 0.0,
    };
    rounded_ray(origin, towards + draws.unit_vector() * beside)
}

/// The table of these triangles; a triangle's shape number is its place.
pub fn triangle_table(triangles: impl IntoIterator<Item = Corners>) -> TriangleTable {
    let mut table = TriangleTable::default();
    for (number, corners) in triangles.into_iter().enumerate() {
        table.push(TriangleFace::of(corners, [DVec2::ZERO, DVec2::X, DVec2::Y]), number as u32);
    }
    table
}

/// A closed mesh: every edge is shared by two faces.
pub struct Mesh {
    corners: Vec<DVec3>,
    faces: Vec<[usize; 3]>,
}

impl Mesh {
    /// Twenty equal faces about the origin, of radius 1.
    pub fn icosahedron() -> Self {
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
    pub fn fans(count: usize) -> Self {
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
    pub fn octahedron() -> TriangleTable {
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
    pub fn placed(&self, draws: &mut Draws, eye: DVec3, place: DVec3) -> Result<TriangleTable, SceneError> {
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
pub fn ray_at(draws: &mut Draws, table: &TriangleTable, origin: Vec3) -> (AimedRay, [DVec3; 2]) {
    let corners = table.row[(draws.unit() * table.row.len() as f64) as usize].corners;
    let first = (draws.unit() * 3.0) as usize;
    let second = if draws.unit() < 0.5 { first } else { (first + 1) % 3 };
    let (a, b) = (corners[first], corners[second]);
    let target = a + (b - a) * draws.unit();
    (rounded_ray(origin, target - origin.as_dvec3()), [a, b])
}
