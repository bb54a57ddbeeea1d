//! Rasterisation: what it sees against what rays see; shared edges; vertices where there should be none; shapes in their
//! boxes.

use super::{Group, Method, Tally, Trial};
use crate::measure::draws::Draws;
use crate::measure::raster_boxes::box_picture;
use crate::measure::torus_knot::torus_knot;
use crate::measure::visibility::compare_visibility;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::rasterise::{ClipPlanes, ClipPoint, Edge, Projection, edge_function, fixed};
use pinhole::scene::*;
use pinhole::shapes::{Listed, ShapeVisitor, visit_shapes};
use std::ops::Range;
use std::sync::LazyLock;

const SAME: [Method; 1] = [Method::pinhole("pinhole, every difference explained", "", 0.0)];
const ONCE: [Method; 1] = [Method::pinhole("pinhole, each sample in one of them", "", 0.0)];
const BOXES: [Method; 1] = [Method::pinhole("pinhole, the same to the last bit", "", 0.0)];
const INSIDE: [Method; 1] = [Method::pinhole("pinhole, clipped to what can be rasterised", "", 0.0)];

/// The sizes of images that cameras are tried with, and which of the indices tried is a camera: one in so many.
const SIZES: [([u32; 2], u64); 2] = [([48, 27], 10), ([640, 360], 100)];

/// A scene around the origin, without a camera.
type Scene = (&'static str, fn(&mut World, &mut Draws));

const SCENES: [Scene; 4] = [
    ("a mesh", |world, _| _ = world.spawn((KNOT.clone(), Matte::default()))),
    ("triangles through one another", |world, draws| {
        for _ in 0..60 {
            let centre = draws.unit_vector() * (3.0 * draws.unit());
            let size = draws.power_of_ten(-2.0, 1.0);
            let vertices = [(); 3].map(|()| centre + draws.unit_vector() * size);
            world.spawn((Triangle { vertices, ..Triangle::default() }, Matte::default()));
        }
    }),
    ("spheres in a mesh", |world, draws| {
        world.spawn((KNOT.clone(), Matte::default()));
        for _ in 0..8 {
            let position = draws.unit_vector() * (3.0 * draws.unit());
            let placement = Placement { position, ..Placement::default() };
            world.spawn((Sphere { radius: draws.between(0.1, 0.8) }, placement, Matte::default()));
        }
    }),
    ("a large ground below a mesh", |world, _| {
        world.spawn((KNOT.clone(), Matte::default()));
        let corner = |x: f64, z: f64| DVec3::new(x * 1e4, -2.0, z * 1e4);
        for vertices in [
            [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0)],
            [corner(-1.0, -1.0), corner(1.0, 1.0), corner(1.0, -1.0)],
        ] {
            world.spawn((Triangle { vertices, ..Triangle::default() }, Matte::default()));
        }
    }),
];

/// The knot of 7,680 triangles.
static KNOT: LazyLock<MeshInstance> =
    LazyLock::new(|| MeshInstance { geometry: MeshGeometry::new(torus_knot(160, 24)) });

/// The cases of the group.
pub fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    for scene in SCENES {
        for (size, every) in SIZES {
            let [width, height] = size;
            let name = format!("what cameras of {width} × {height} pixels see of {}, 1 of {every} tried", scene.0);
            let check = move |range| check_visibility(scene, (size, every), range);
            trials.push(Trial::new(Group::Rasterisation, name, &SAME, check));
        }
    }
    let name = "pairs of triangles: samples about their common edge".to_string();
    trials.push(Trial::new(Group::Rasterisation, name, &ONCE, check_pairs));
    let name = "vertices anywhere, not finite ones among them".to_string();
    trials.push(Trial::new(Group::Rasterisation, name, &INSIDE, check_clipping));
    trials.extend(box_trials());
    trials
}

/// One in so many of the indices tried is a camera that sees shapes in their boxes.
const EVERY: u64 = 20;

/// A case for each registered shape whose boxes are rasterised.
fn box_trials() -> Vec<Trial> {
    struct Collected(Vec<Trial>);
    impl ShapeVisitor for Collected {
        fn visit<S: Listed>(&mut self) {
            if S::IS_BOUNDED && !S::IS_TRIANGULAR {
                let name = format!("pictures of {} in boxes, 1 of {EVERY} tried", S::NAMES.table);
                self.0.push(Trial::new(Group::Rasterisation, name, &BOXES, check_boxes::<S>));
            }
        }
    }
    let mut collected = Collected(Vec::new());
    visit_shapes(&mut collected);
    collected.0
}

/// Compares each camera's picture with that by rays.
fn check_boxes<S: Listed>(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(BOXES.len());
    for index in range.filter(|index| index.is_multiple_of(EVERY)) {
        let Some(found) = box_picture::<S>(1604, index / EVERY) else { continue };
        tally.count(found.sees);
        tally.scores[0].check(found.difference.is_none());
    }
    tally
}

/// A camera anywhere about the origin, or among the triangles.
fn spawn_camera(world: &mut World, draws: &mut Draws, [width, height]: [u32; 2]) {
    let eye = draws.unit_vector() * draws.power_of_ten(-1.0, 1.5);
    let target = draws.unit_vector() * (2.0 * draws.unit());
    let look = LookAt { eye, target, up: draws.unit_vector() };
    let mut camera = world.spawn((look, Resolution { width, height }, Integrator::RayCasting));
    match draws.unit() < 0.75 {
        true => {
            camera.insert(PerspectiveCamera { fov: Degrees(draws.between(5.0, 150.0)), ..PerspectiveCamera::default() })
        }
        false => camera.insert(OrthographicCamera { view_height: draws.power_of_ten(-1.0, 1.0) }),
    };
}

/// A scene by its name, with the camera of an index.
///
/// Panics at a name that none of the scenes has.
pub fn seen_by(scene: &str, index: u64, size: [u32; 2]) -> World {
    let (_, fill) = SCENES.into_iter().find(|(name, _)| *name == scene).expect("one of the scenes");
    world_with(fill, index, size)
}

fn world_with(fill: fn(&mut World, &mut Draws), index: u64, size: [u32; 2]) -> World {
    let mut draws = Draws::new(1601, index);
    let mut world = World::new();
    spawn_camera(&mut world, &mut draws, size);
    fill(&mut world, &mut draws);
    world
}

/// Compares all pixels of each camera.
fn check_visibility((_, fill): Scene, (size, every): ([u32; 2], u64), range: Range<u64>) -> Tally {
    let mut tally = Tally::new(SAME.len());
    for index in range.filter(|index| index.is_multiple_of(every)) {
        let found = compare_visibility(&mut world_with(fill, index, size));
        tally.count(found.as_ref().is_ok_and(|found| found.covered > 0));
        tally.scores[0].check(found.is_ok_and(|found| found.unexplained.is_empty()));
    }
    tally
}

/// Two triangles on either side of an edge, and samples on it, beside it and at its ends.
fn check_pairs(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(ONCE.len());
    for index in range {
        let mut draws = Draws::new(1602, index);
        // Steps of 16, 256 or 4096 make level, upright and diagonal edges, and samples exactly on them, frequent.
        let step = [1, 16, 256, 4096][(draws.unit() * 4.0) as usize];
        let mut point = |max: f64| [(); 2].map(|()| (draws.between(-max, max) / f64::from(step)).round() as i32 * step);
        let [from, to, left, right] = [point(20_000.0), point(20_000.0), point(20_000.0), point(20_000.0)];
        let sides = [left, right].map(|apex| edge_function(from, to, apex));
        if sides[0].signum() * sides[1].signum() != -1 {
            continue;
        }
        let [right, left] = if sides[0] > 0 { [left, right] } else { [right, left] };
        let triangles = [[from, to, right], [to, from, left]];
        let mix = |fraction: f64, axis: usize| f64::from(from[axis]) + fraction * f64::from(to[axis] - from[axis]);
        let fraction = draws.unit();
        let near = [0, 1].map(|axis| (mix(fraction, axis) / f64::from(step)).round() as i32 * step);
        for sample in [near, [near[0] + 1, near[1]], [near[0], near[1] - 1]] {
            let inside = triangles.map(|[a, b, c]| {
                [Edge::new(a, b, [0, 0]), Edge::new(b, c, [0, 0]), Edge::new(c, a, [0, 0])]
                    .iter()
                    .all(|edge| edge.at(f64::from(sample[0]), f64::from(sample[1])) >= 0.0)
            });
            // Within the quadrilateral by more than the outer edges decide, one of the two has to have the sample.
            let outer = [[to, right], [right, from], [from, left], [left, to]];
            let well_inside = outer.iter().all(|&[a, b]| edge_function(a, b, sample) > 0);
            tally.count(well_inside);
            let count = inside.iter().filter(|&&inside| inside).count();
            tally.scores[0].check(if well_inside { count == 1 } else { count <= 1 });
        }
    }
    tally
}

/// Triangles whose vertices are anywhere in clip space; what is left of them can be rounded to fixed point.
fn check_clipping(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(INSIDE.len());
    for index in range {
        let mut draws = Draws::new(1603, index);
        let size = glam::DVec2::new(draws.power_of_ten(0.0, 4.8).floor(), draws.power_of_ten(0.0, 4.8).floor());
        let projection = Projection {
            camera_from_world: glam::DMat3::IDENTITY,
            half: glam::DVec2::new(draws.power_of_ten(-3.0, 3.0), draws.power_of_ten(-3.0, 3.0)),
            is_perspective: draws.unit() < 0.75,
            size,
        };
        let planes = ClipPlanes::new(&projection, 10.0);
        let corners: [ClipPoint; 3] = [(); 3].map(|()| projection.clip(anywhere(&mut draws)));
        let polygon = planes.clip(corners);
        let points = polygon.points();
        tally.count(points.len() >= 3);
        let kept = points.iter().all(|&point| {
            let raster = projection.raster(point);
            let [x, y] = fixed(raster);
            let far = |steps: i32, pixels: f64| f64::from(steps.abs()) <= (1.5 * pixels + 65_536.5) * 256.0;
            point.depth >= 0.5 * planes.near && raster.is_finite() && far(x, size.x) && far(y, size.y)
        });
        let whole = corners.iter().all(|&corner| planes.contain(corner));
        tally.scores[0].check(kept && points.len() <= 8 && (!whole || points == corners));
    }
    tally
}

/// A point in front of the camera, behind it, in its plane, at the eye, or nowhere.
fn anywhere(draws: &mut Draws) -> DVec3 {
    let mut part = || match draws.unit() {
        part if part < 0.1 => 0.0,
        part if part < 0.15 => 1e300,
        part if part < 0.17 => f64::NAN,
        part if part < 0.19 => f64::NEG_INFINITY,
        part if part < 0.5 => draws.power_of_ten(-9.0, 1.0),
        _ => -draws.power_of_ten(-9.0, 7.0),
    };
    DVec3::new(part(), part(), part())
}
