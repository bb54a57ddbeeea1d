//! Shapes whose boxes are rasterised: the same hits as by rays, to the last bit.

use crate::scenes::{self, EYES, FilmBits, Setup, named, offer, one_world};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::extract::CuboidTable;
use pinhole::intersect::{Hits, NO_SHAPE};
use pinhole::plan::{Census, Column};
use pinhole::rays::{WorldRays, camera_ray_orthographic, camera_ray_perspective};
use pinhole::render::{first_bounce_only, inspect, render};
use pinhole::scene::*;
use pinhole::shapes::{Bounds, Listed, Shape, ShapeVisitor, visit_shapes};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::raster_boxes::{WHEREABOUTS, box_picture};

/// What `cargo run --release -- extremes rasterisation --case boxes` tries in full.
#[test]
fn boxes_show_what_rays_show_wherever_the_camera_is() {
    struct Cameras(usize);
    impl ShapeVisitor for Cameras {
        fn visit<S: Listed>(&mut self) {
            const TRIED: u64 = 30;
            if !S::IS_BOUNDED || S::IS_TRIANGULAR {
                return;
            }
            let mut sees = WHEREABOUTS.map(|_| 0);
            for index in 0..TRIED {
                let Some(found) = box_picture::<S>(3302, index) else { continue };
                let whereabouts = (index % 5) as usize;
                let what = format!("{} {:?}, number {index}", S::NAMES.table, WHEREABOUTS[whereabouts]);
                assert_eq!(found.difference, None, "{what}");
                sees[whereabouts] += usize::from(found.sees);
                self.0 += 1;
            }
            assert!(sees.iter().all(|&sees| sees > 0), "{}: {sees:?} of {WHEREABOUTS:?} see some", S::NAMES.table);
        }
    }
    let mut cameras = Cameras(0);
    visit_shapes(&mut cameras);
    eprintln!("{} cameras: every picture in boxes is that by rays, to the last bit", cameras.0);
    assert!(cameras.0 > 200);
}

/// Scenes of all kinds of shapes, with planes and lights among them.
#[test]
fn scenes_of_all_kinds_are_the_same_to_the_last_bit() {
    let scenes = [scenes::shapes_of_all_kinds, scenes::stretched, scenes::shining, scenes::textured];
    for (number, scene) in scenes.into_iter().enumerate() {
        for eye in EYES {
            let mut world = scene(Setup { eye, ..Setup::default() });
            let by_rays = scenes::film(&world);
            let camera = named(&mut world, "camera");
            world.entity_mut(camera).insert(Rasterisation);
            for side in [5, 32, 100] {
                let execution = pinhole::render::Execution { tile_side: side, ..one_world() };
                let film = FilmBits::of(&render(&world, &offer(), &execution, &()).expect("renders").film);
                film.assert_is(&by_rays, &format!("scene {number}, {eye:?}, tiles of {side}"));
            }
        }
    }
}

/// The hits of a scene's camera, pixel by pixel along its only line.
fn hits(world: &World) -> Vec<u32> {
    let inspection = inspect(world, &first_bounce_only(&offer()), u32::MAX).expect("inspects");
    let tile = inspection.world.entity(inspection.tiles[0]);
    tile.get::<Hits>().expect("hits").shape.clone()
}

/// Half the height of the image plane at distance 1, and of the window.
const HALF_HEIGHTS: [f64; 2] = [1.0, 1.0 / 3.0];

/// Where each ray of the image should pass, and where it does since it has been rounded: on the image plane at distance
/// 1, or on the window.
fn places(world: &World, size: u32, is_upright: bool, is_perspective: bool) -> Vec<[f64; 2]> {
    let inspection = inspect(world, &first_bounce_only(&offer()), u32::MAX).expect("inspects");
    let rays = inspection.world.entity(inspection.tiles[0]).get::<WorldRays>().expect("rays");
    let place = |row: usize| {
        let ndc = (row as f64 + 0.5) / f64::from(size);
        let screen = match is_upright {
            true => DVec2::new(0.0, 1.0 - 2.0 * ndc),
            false => DVec2::new((2.0 * ndc - 1.0) * f64::from(size), 0.0),
        };
        let (exact, rounded) = match is_perspective {
            true => {
                let (exact, rounded) = (camera_ray_perspective(screen, HALF_HEIGHTS[0]), rays.direction_of(row));
                (exact / -exact.z, rounded / -rounded.z)
            }
            false => (camera_ray_orthographic(screen, HALF_HEIGHTS[1]), rays.origin_of(row)),
        };
        let axis = usize::from(is_upright);
        [exact[axis], rounded[axis]]
    };
    (0..rays.rows()).map(place).collect()
}

/// A ray that is rounded towards the axis hits a cuboid that its sample passes by less than the rounding: the rectangle
/// has to be that much larger than the cuboid's image.
#[test]
fn what_only_the_rounded_ray_hits_is_in_its_box() {
    let mut tried = 0;
    for (is_upright, is_perspective) in [(false, false), (false, true), (true, false), (true, true)] {
        for size in [64_u32, 301, 1000] {
            let mut world = World::new();
            let [width, height] = if is_upright { [1, size] } else { [size, 1] };
            let mut camera = world.spawn((Resolution { width, height }, Integrator::RayCasting));
            match is_perspective {
                true => camera.insert(PerspectiveCamera { fov: Degrees(90.0), axis: FovAxis::Vertical }),
                false => camera.insert(OrthographicCamera { view_height: 2.0 * HALF_HEIGHTS[1] }),
            };
            let camera = camera.id();
            let mut draws = Draws::new(3303, u64::from(size));
            // Something to see, so that there are rays, far behind everything else.
            world.spawn((Sphere::default(), Placement::at(0.0, 0.0, -1e9), Matte::default()));
            let mut passed_by = Vec::new();
            for [exact, rounded] in places(&world, size, is_upright, is_perspective) {
                // Rounded away from the axis, or by no more than a few digits of f64.
                if exact.abs() - rounded.abs() <= exact.abs() * 1e-10 {
                    continue;
                }
                // A small cube whose outer edge is between the two.
                let (depth, edge) = (draws.between(1.0, 3.0), exact.abs() * 1e-4);
                let across = 0.5 * (exact.abs() + rounded.abs()) * if is_perspective { depth } else { 1.0 };
                let centre = exact.signum() * (across - 0.5 * edge);
                let [x, y] = if is_upright { [0.0, centre] } else { [centre, 0.0] };
                let cube = Cuboid { size: DVec3::splat(edge) };
                world.spawn((cube, Placement::at(x, y, -depth - 0.5 * edge), Matte::default()));
                passed_by.push(exact.abs());
            }
            let by_rays = hits(&world);
            let cubes = Census::of(&world).table::<CuboidTable>().expect("cubes");
            world.entity_mut(camera).insert(Rasterisation);
            let in_boxes = hits(&world);
            let what = format!("upright {is_upright}, perspective {is_perspective}, {size} pixels");
            assert_eq!(in_boxes, by_rays, "{what}");
            // The image of most boxes, as such, does not reach the sample.
            let outermost = |bounds: Bounds| {
                let axis = usize::from(is_upright);
                bounds.min[axis].abs().max(bounds.max[axis].abs()) / if is_perspective { -bounds.max.z } else { 1.0 }
            };
            let bounds = cubes.row.iter().map(|cube| cube.bounds().expect("a box"));
            let beside = bounds.zip(&passed_by).filter(|&(bounds, &sample)| outermost(bounds) < sample).count();
            let hit = by_rays.iter().filter(|&&shape| shape != NO_SHAPE && shape > 0).count();
            let all = passed_by.len();
            assert!(10 * hit >= 9 * all && 10 * beside >= 9 * all, "{what}: {hit} hit, {beside} beside, of {all}");
            assert!(4 * all > size as usize, "{what}: {all} rays are rounded towards the axis");
            tried += hit;
        }
    }
    eprintln!("{tried} cubes are hit by rounded rays alone: all are in their boxes");
}
