//! Hierarchies: each finds what testing everything finds, to the last bit; and no ray leaks out of a closed mesh.

use super::{Group, Method, Tally, Trial};
use crate::measure::draws::Draws;
use crate::measure::oracle::Oracle;
use crate::measure::ray_aim::{AimedRay, rounded_ray};
use crate::measure::specimen::Specimen;
use crate::measure::torus_knot::{MIN_RADIUS, curve, torus_knot};
use glam::{DQuat, DVec3, Vec3};
use pinhole::intersect::NO_SHAPE;
use pinhole::scene::{MeshGeometry, MeshInstance, Placement};
use pinhole::shapes::{
    ClosestHits, HierarchyRoom, PlacedMesh, RaySlices, Shape, hierarchy_of, keep_closest_of, with_shapes,
};
use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::LazyLock;

const SAME: [Method; 1] = [Method::pinhole("pinhole, same number and the same bits of t", "", 0.0)];
const LEAKS: [Method; 1] = [Method::pinhole("pinhole, no ray leaks", "", 0.0)];

/// The shapes of one hierarchy.
const SHAPES: usize = 60;
/// The rays that are tried with one set of shapes.
const RAYS_A_SET: u64 = 512;
/// The rays that go through a hierarchy together, the last of which is looked at.
const TOGETHER: usize = 40;

/// The offsets of a mesh from the eye.
const OFFSETS: [(&str, DVec3); 3] = [
    ("at the eye", DVec3::ZERO),
    ("1e4 away", DVec3::splat(1e4)),
    ("at (148376, 1234, -223423)", DVec3::new(148_376.0, 1234.0, -223_423.0)),
];

/// The cases of the group.
pub fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    macro_rules! all {
        ($($kind:ident($shape:ty) $field:ident $plural:literal,)+) => {
            $(if <$shape>::IS_BOUNDED {
                let name = concat!("hierarchy of ", $plural).to_string();
                trials.push(Trial::new(Group::Hierarchy, name, &SAME, check_shapes::<$shape>));
            })+
        };
    }
    with_shapes!(all);
    trials.push(Trial::new(Group::Hierarchy, "triangles of a mesh".to_string(), &SAME, check_mesh));
    for (shown, offset) in OFFSETS {
        let name = format!("closed mesh {shown}: rays from inside to edges and vertices");
        trials.push(Trial::new(Group::Hierarchy, name, &LEAKS, move |range| check_leaks(offset, range)));
    }
    trials
}

/// A hit's number, primitive and t.
type Found = (u32, u32, u64);

/// What a kernel that intersects a column of rays, each up to its t_max, finds along the last of them.
fn found(rays: &[(AimedRay, f64)], any: bool, keep_closest: impl FnOnce(RaySlices<'_>, ClosestHits<'_>)) -> Found {
    let part = |vector: fn(&AimedRay) -> Vec3, axis: usize| -> Vec<f32> {
        rays.iter().map(|(ray, _)| vector(ray)[axis]).collect()
    };
    let origin = [0, 1, 2].map(|axis| part(|ray| ray.origin, axis));
    let direction = [0, 1, 2].map(|axis| part(|ray| ray.direction, axis));
    let slices = RaySlices {
        origin: origin.each_ref().map(|part| &part[..]),
        direction: direction.each_ref().map(|part| &part[..]),
    };
    let mut t: Vec<f64> = rays.iter().map(|(_, t_max)| *t_max).collect();
    let (mut shape, mut primitive) = (vec![NO_SHAPE; rays.len()], vec![0; rays.len()]);
    keep_closest(slices, ClosestHits { t: &mut t, shape: &mut shape, primitive: Some(&mut primitive), any });
    let last = rays.len() - 1;
    (shape[last], if shape[last] == NO_SHAPE { 0 } else { primitive[last] }, t[last].to_bits())
}

/// Shapes of any size close together, some of them twice, so that there are ties.
fn set_of<S: Oracle>(draws: &mut Draws) -> Vec<S> {
    let mut shapes: Vec<S> = Vec::new();
    while shapes.len() < SHAPES {
        let Some(specimen) = Specimen::<S>::drawn(draws, [-1.0, 1.0], 3.0) else { continue };
        let again = draws.unit() < 0.1;
        shapes.extend(again.then(|| specimen.shape.clone()));
        shapes.push(specimen.shape);
    }
    shapes
}

fn check_shapes<S: Oracle>(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(SAME.len());
    let mut set = u64::MAX;
    let (mut shapes, mut numbers, mut bvh) = (Vec::new(), Vec::new(), None);
    let (mut room, mut together) = (HierarchyRoom::default(), Vec::new());
    let mut prepared = S::Prepared::default();
    for index in range {
        if index / RAYS_A_SET != set {
            set = index / RAYS_A_SET;
            shapes = set_of::<S>(&mut Draws::new(901, set));
            // Numbers against the order of the table decide ties otherwise than the first that is found.
            numbers = (0..shapes.len() as u32).rev().collect();
            (bvh, prepared) = (hierarchy_of(&shapes), S::prepared(&shapes));
        }
        let Some(bvh) = &bvh else { continue };
        let mut draws = Draws::new(902, index);
        let towards = &shapes[(draws.unit() * shapes.len() as f64) as usize];
        let (centre, radius) = towards.bounding_sphere().unwrap_or((DVec3::ZERO, 1.0));
        let origin = (centre + draws.unit_vector() * (radius * draws.power_of_ten(-1.0, 2.0))).as_vec3();
        let target = centre + draws.unit_vector() * (radius * draws.unit());
        let mut ray = rounded_ray(origin, target - origin.as_dvec3());
        if draws.unit() < 0.2 {
            ray.direction = along_an_axis(&mut draws);
        }
        let t_max = if draws.unit() < 0.2 { draws.power_of_ten(-1.0, 2.0) } else { f64::INFINITY };
        // The ray's way must not depend on those that go through the hierarchy with it.
        together.push((ray, t_max));
        if together.len() > TOGETHER {
            together.remove(0);
        }
        let all = found(&[(ray, t_max)], false, |rays, hits| {
            S::keep_closest((&shapes, &prepared), &numbers, rays, hits);
        });
        let [some, any] = [false, true].map(|any| {
            found(&together, any, |rays, hits| keep_closest_of((&shapes, &numbers, bvh), rays, hits, &mut room))
        });
        tally.count(all.0 != NO_SHAPE);
        let any = any.0 != NO_SHAPE;
        tally.scores[0].check(all == some && any == (all.0 != NO_SHAPE));
    }
    tally
}

/// A direction whose other components are 0 or −0.
fn along_an_axis(draws: &mut Draws) -> Vec3 {
    let mut sign = || if draws.unit() < 0.5 { -1.0 } else { 1.0 };
    let mut direction = Vec3::new(0.0 * sign(), 0.0 * sign(), 0.0 * sign());
    let side = sign();
    direction[(draws.unit() * 3.0) as usize] = side;
    direction
}

/// The knot of 7,680 triangles.
static KNOT: LazyLock<MeshGeometry> = LazyLock::new(|| MeshGeometry::new(torus_knot(160, 24)));

fn knot_at(position: DVec3, draws: &mut Draws) -> Option<PlacedMesh> {
    let [x, y, z, w] = [(); 4].map(|()| draws.between(-1.0, 1.0));
    let orientation = DQuat::from_xyzw(x, y, z, w).normalize();
    let scale = DVec3::new(draws.between(0.5, 2.0), -draws.between(0.5, 2.0), draws.between(0.5, 2.0));
    let placement = Placement { position, orientation, scale };
    Specimen::<PlacedMesh>::of(MeshInstance { geometry: KNOT.clone() }, placement).map(|specimen| specimen.shape)
}

/// A vertex of the mesh, or a point of an edge, in render space.
fn corner_or_edge(mesh: &PlacedMesh, draws: &mut Draws) -> DVec3 {
    let triangle = (draws.unit() * mesh.geometry.triangles.len() as f64) as usize;
    let [a, b, _] = mesh.placed_triangle(triangle);
    if draws.unit() < 0.5 { a } else { a + (b - a) * draws.unit() }
}

/// The hierarchy of a mesh against all of its triangles, aimed at vertices, edges and anywhere.
fn check_mesh(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(SAME.len());
    for index in range {
        let mut draws = Draws::new(903, index);
        let position = draws.unit_vector() * draws.power_of_ten(0.0, 3.0);
        let Some(mesh) = knot_at(position, &mut draws) else { continue };
        let origin = (position + draws.unit_vector() * draws.power_of_ten(-1.0, 2.0)).as_vec3();
        let target = match draws.unit() {
            part if part < 0.6 => corner_or_edge(&mesh, &mut draws),
            _ => position + draws.unit_vector() * (3.0 * draws.unit()),
        };
        let mut ray = rounded_ray(origin, target - origin.as_dvec3());
        if draws.unit() < 0.1 {
            ray.direction = along_an_axis(&mut draws);
        }
        let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        let (all, some) = (mesh.closest_of_all(origin, direction), mesh.closest(origin, direction));
        tally.count(all.t < f64::INFINITY);
        tally.scores[0].check((all.t.to_bits(), all.primitive) == (some.t.to_bits(), some.primitive));
    }
    tally
}

/// From inside a closed mesh every ray hits it, also one aimed at an edge or a vertex.
fn check_leaks(offset: DVec3, range: Range<u64>) -> Tally {
    let mut tally = Tally::new(LEAKS.len());
    for index in range {
        let mut draws = Draws::new(904, index);
        let Some(mesh) = knot_at(offset, &mut draws) else { continue };
        let near = draws.unit_vector() * (0.5 * MIN_RADIUS * draws.unit());
        let inside = mesh.world_from_object * (curve(draws.between(0.0, TAU)) + near) + mesh.position;
        let origin = inside.as_vec3();
        let ray = rounded_ray(origin, corner_or_edge(&mesh, &mut draws) - origin.as_dvec3());
        let t = mesh.closest(ray.origin.as_dvec3(), ray.direction.as_dvec3()).t;
        tally.count(true);
        tally.scores[0].check(t < f64::INFINITY);
    }
    tally
}
