//! Shapes whose boxes are rasterised: the same hits as by rays, to the last bit.

use crate::scenes::{self, EYES, FilmBits, Setup, named, offer, one_world};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::intersect::{Hits, NO_SHAPE};
use pinhole::plan::Column;
use pinhole::rays::{WorldRays, camera_ray_orthographic, camera_ray_perspective};
use pinhole::render::{first_bounce_only, inspect, render};
use pinhole::scene::*;
use pinhole::shapes::{Listed, ShapeVisitor, visit_shapes};
use pinhole_lab::measure::raster_boxes::{WHEREABOUTS, box_picture};
use pinhole_lab::measure::ray_aim::Draws;

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

/// How far each ray of an image has been rounded, as the place where it should pass and the place where it does: of the
/// image plane at distance 1, or of the window.
fn rounding(world: &World, size: u32, is_upright: bool, is_perspective: bool) -> Vec<[f64; 2]> {
    let inspection = inspect(world, &first_bounce_only(&offer()), u32::MAX).expect("inspects");
    let rays = inspection.world.entity(inspection.tiles[0]).get::<WorldRays>().expect("rays");
    let place = |row: usize| {
        let ndc = (row as f64 + 0.5) / f64::from(size);
        let aspect = if is_upright { 1.0 } else { f64::from(size) };
        let screen = glam::DVec2::X * (2.0 * ndc - 1.0) * aspect;
        let screen = if is_upright { glam::DVec2::new(0.0, -screen.x) } else { screen };
        let axis = usize::from(is_upright);
        let (exact, rounded) = match is_perspective {
            true => {
                let (exact, rounded) = (camera_ray_perspective(screen, 1.0), rays.direction_of(row));
                (exact / -exact.z, rounded / -rounded.z)
            }
            false => (camera_ray_orthographic(screen, 1.0), rays.origin_of(row)),
        };
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
                false => camera.insert(OrthographicCamera { view_height: 2.0 }),
            };
            let camera = camera.id();
            let mut draws = Draws::new(3303, u64::from(size));
            // Something to see, so that there are rays, far behind everything else.
            world.spawn((Sphere::default(), Placement::at(0.0, 0.0, -1e9), Matte::default()));
            let mut expected = 0;
            for [exact, rounded] in rounding(&world, size, is_upright, is_perspective) {
                if rounded.abs() >= exact.abs() {
                    continue;
                }
                // A cuboid whose silhouette is between the two, as small against its place as f32 knows it.
                let (depth, edge) = (draws.between(1.0, 3.0), exact.abs() * 1e-4);
                let across = 0.5 * (exact.abs() + rounded.abs()) * if is_perspective { depth } else { 1.0 };
                let centre = exact.signum() * (across - 0.5 * edge);
                let [x, y] = if is_upright { [0.0, centre] } else { [centre, 0.0] };
                let long = if is_upright { DVec3::new(1.0, edge, edge) } else { DVec3::new(edge, 1.0, edge) };
                let cuboid = Cuboid { size: long };
                world.spawn((cuboid, Placement::at(x, y, -depth - 0.5 * edge), Matte::default()));
                expected += 1;
            }
            let by_rays = hits(&world);
            world.entity_mut(camera).insert(Rasterisation);
            let in_boxes = hits(&world);
            assert_eq!(in_boxes, by_rays, "upright {is_upright}, perspective {is_perspective}, {size} pixels");
            let hit = by_rays.iter().filter(|&&shape| shape != NO_SHAPE && shape > 0).count();
            assert!(hit > size as usize / 4 && 10 * hit >= 9 * expected, "{hit} of {expected}");
            tried += hit;
        }
    }
    eprintln!("{tried} cuboids are hit by rounded rays alone: all are in their boxes");
}
