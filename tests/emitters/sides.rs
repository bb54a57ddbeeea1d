//! From which side a shape is hit, and what shines on one side only.

use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use pinhole::intersect::{Hits, NO_SHAPE, Surface, SurfaceSides, Surfaces};
use pinhole::plan::Stage;
use pinhole::render::inspect;
use pinhole::scene::*;
use pinhole::shade;

fn offer() -> Vec<Stage> {
    crate::scenes::offer_of_direct_light()
}

/// A scene with one shape that shines on one side, looked at along a line.
fn scene(eye: DVec3, target: DVec3, shape: impl Bundle, placement: Placement) -> World {
    let mut world = World::new();
    let up = (target - eye).any_orthonormal_vector();
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(0.01), ..PerspectiveCamera::default() },
        LookAt { eye, target, up },
        Resolution { width: 5, height: 5 },
    ));
    let emissive = Emissive { radiance: Rgb::new(3.0, 2.0, 1.0), sides: Sides::Front };
    world.spawn((Name::new("lamp"), shape, placement, emissive));
    world
}

/// What the middle ray says: whether it hit the shape from outside, and the red that it brings.
fn seen(world: &World) -> (u32, f32) {
    let inspection = inspect(world, &offer(), 32).expect("inspects");
    let tile = inspection.world.entity(inspection.tiles[0]);
    let sides = tile.get::<SurfaceSides>().expect("one-sided light reads sides");
    let radiance = tile.get::<shade::Radiance>().expect("radiance");
    assert!(sides.outside.iter().all(|side| *side == sides.outside[12]), "a narrow view sees one side");
    (sides.outside[12], radiance.rgb[0][12])
}

#[test]
fn every_kind_of_shape_knows_its_sides_also_mirrored() {
    let turns = [DQuat::IDENTITY, DQuat::from_xyzw(0.5, -0.1, 0.7, 0.5).normalize()];
    let scales = [[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [1.0, -2.0, 1.0], [1.0, 1.5, -1.0], [-1.0, -1.0, -1.0]];
    let corners = [DVec3::new(-1.0, 0.0, -1.0), DVec3::new(-1.0, 0.0, 2.0), DVec3::new(2.0, 0.0, -1.0)];
    let mut tried = 0;
    for (turn, scale) in turns.into_iter().flat_map(|turn| scales.map(|scale| (turn, DVec3::from(scale)))) {
        let position = DVec3::new(3.0, -2.0, 1.5);
        let placement = Placement { position, orientation: turn, scale };
        // A normal goes out by the inverse of the scale.
        let normal = |own: DVec3| (turn * (own / scale)).normalize();
        // A mirror turns the order of corners, but no side.
        let around = normal((corners[1] - corners[0]).cross(corners[2] - corners[0]));
        let mut check = |name: &str, shape: &dyn Fn(DVec3, DVec3) -> World, front: DVec3, distance: f64| {
            for (sign, expected) in [(1.0, (1, 3.0)), (-1.0, (0, 0.0))] {
                // From inside a closed shape, towards its wall.
                let [eye, target] = if distance > 0.0 {
                    if sign > 0.0 { [front * distance, DVec3::ZERO] } else { [DVec3::ZERO, front * distance] }
                } else {
                    [front * (sign * 2.0), DVec3::ZERO]
                };
                let world = shape(position + eye, position + target);
                assert_eq!(seen(&world), expected, "{name}, scale {scale}, turn {turn}, sign {sign}");
                tried += 1;
            }
        };
        let oblique = |front: DVec3| (front + 0.3 * front.any_orthonormal_vector()).normalize();
        let plane = DVec3::new(0.3, -1.0, 0.2);
        check("plane", &|eye, to| scene(eye, to, Plane { normal: plane }, placement), oblique(normal(plane)), 0.0);
        check("disk", &|eye, to| scene(eye, to, Disk::default(), placement), oblique(normal(DVec3::Y)), 0.0);
        check("rectangle", &|eye, to| scene(eye, to, Rectangle::default(), placement), oblique(normal(DVec3::Y)), 0.0);
        let bare = Triangle { vertices: corners, ..Triangle::default() };
        check("triangle", &|eye, to| scene(eye, to, bare, placement), oblique(around), 0.0);
        for up in [DVec3::Y, DVec3::NEG_Y] {
            let with = Triangle { normals: Some([up; 3]), ..bare };
            check("triangle with normals", &|eye, to| scene(eye, to, with, placement), oblique(normal(up)), 0.0);
        }
        let even = Placement { scale: scale.signum(), ..placement };
        for direction in [DVec3::X, DVec3::new(-0.6, 0.5, 0.7)] {
            check("sphere", &|eye, to| scene(eye, to, Sphere::default(), even), direction, 9.0);
            let non_uniform = Placement { scale: scale * DVec3::new(1.0, 1.0, 1.7), ..placement };
            check("ellipsoid", &|eye, to| scene(eye, to, Sphere::default(), non_uniform), direction, 9.0);
            check("cuboid", &|eye, to| scene(eye, to, Cuboid::default(), placement), direction, 9.0);
        }
    }
    eprintln!("sides: {tried} shapes hit from one side or the other");
}

#[test]
fn where_a_ray_misses_the_surface_is_zero() {
    let mut world = scene(DVec3::Z * 4.0, DVec3::ZERO, Sphere { radius: 1.0 }, Placement::default());
    let camera = crate::scenes::named(&mut world, "camera");
    world.entity_mut(camera).insert(PerspectiveCamera::default());
    world.spawn((Sphere { radius: 0.1 }, Matte::default()));
    let inspection = inspect(&world, &offer(), 32).expect("inspects");
    let tile = inspection.world.entity(inspection.tiles[0]);
    let (hits, surfaces) = (tile.get::<Hits>().expect("hits"), tile.get::<Surfaces>().expect("surfaces"));
    let zero = |row: &usize| surfaces.get(*row) == Surface::default();
    let (missed, hit): (Vec<usize>, Vec<usize>) = (0..25).partition(|&row| hits.shape[row] == NO_SHAPE);
    assert!(missed.len() > 4 && missed.iter().all(zero) && !hit.iter().any(zero), "{missed:?} missed, {hit:?} hit");
}
