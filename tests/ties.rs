//! Two surfaces at the very same distance: the lower number wins, whatever the shapes and whichever is made first.

use crate::scenes;

use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use pinhole::scene::*;
use scenes::film;

/// One of every shape, with a point at the origin that a ray along −z hits from outside at exactly the distance of its
/// origin: all numbers are sums of few powers of two.
const SHAPES: [(&str, fn(&mut World) -> EntityWorldMut<'_>); 8] = [
    ("sphere", |world| world.spawn((Sphere { radius: 0.25 }, Placement::at(0.0, 0.0, -0.25)))),
    ("ellipsoid", |world| {
        let scale = DVec3::new(2.0, 1.0, 0.5);
        world.spawn((Sphere { radius: 0.5 }, Placement { scale, ..Placement::at(0.0, 0.0, -0.25) }))
    }),
    ("plane", |world| world.spawn(Plane { normal: DVec3::Z })),
    ("disk", |world| world.spawn((Disk { radius: 0.5 }, upright()))),
    ("rectangle", |world| world.spawn((Rectangle { width: 0.5, depth: 0.5 }, upright()))),
    ("cuboid", |world| world.spawn((Cuboid { size: DVec3::splat(0.5) }, Placement::at(0.0, 0.0, -0.25)))),
    ("triangle", |world| {
        let vertices = [DVec3::new(-1.0, -1.0, 0.0), DVec3::new(1.0, -1.0, 0.0), DVec3::new(0.0, 2.0, 0.0)];
        world.spawn(Triangle { vertices, ..Triangle::default() })
    }),
    ("moving ball", |world| {
        let motion = Motion { velocity: DVec3::X * 0.0625 };
        world.spawn((Sphere { radius: 0.25 }, Placement::at(0.0, 0.0, -0.25), motion))
    }),
];

/// Its normal, +y, turned to +z, with numbers that f64 holds: two quarter turns about other axes.
fn upright() -> Placement {
    Placement { orientation: DQuat::from_xyzw(0.5, 0.5, 0.5, 0.5), ..Placement::default() }
}

/// The colour that a single ray sees.
fn seen(shapes: &[usize]) -> [f64; 3] {
    let mut world = World::new();
    let eye = Placement::at(0.0, 0.0, 4.0);
    world.spawn((OrthographicCamera { view_height: 1.0 }, eye, Resolution { width: 1, height: 1 }));
    // Each has a colour of its own, by its place.
    for (place, &shape) in shapes.iter().enumerate() {
        let mut colour = [0.0; 3];
        colour[place] = 1.0;
        SHAPES[shape].1(&mut world).insert(Matte { colour: Rgb::new(colour[0], colour[1], colour[2]) });
    }
    let film = film(&world);
    [0, 1, 2].map(|part| f64::from_bits(film.pixels[0][part]))
}

#[test]
fn the_lower_number_wins_between_any_two_shapes() {
    let mut tried = 0;
    for (one, (name, _)) in SHAPES.iter().enumerate() {
        for (other, (beside, _)) in SHAPES.iter().enumerate() {
            assert_eq!(seen(&[one, other]), [1.0, 0.0, 0.0], "{name} made before {beside}");
            tried += 1;
        }
    }
    eprintln!("ties: {tried} pairs of shapes at one distance, the first made wins");
}

/// That they are at one distance at all: something that is nearer by 2⁻⁴⁰ hides each of them, and something that is
/// farther by as much hides none.
#[test]
fn a_hair_nearer_or_farther_is_no_tie() {
    let mut tried = 0;
    for (name, shape) in SHAPES {
        for (off, seen_first) in [(libm::exp2(-40.0), false), (-libm::exp2(-40.0), true)] {
            for plane_first in [false, true] {
                let mut world = World::new();
                let eye = Placement::at(0.0, 0.0, 4.0);
                world.spawn((OrthographicCamera { view_height: 1.0 }, eye, Resolution { width: 1, height: 1 }));
                let plane = |world: &mut World| {
                    let blue = Matte { colour: Rgb::new(0.0, 0.0, 1.0) };
                    world.spawn((Plane { normal: DVec3::Z }, Placement::at(0.0, 0.0, off), blue));
                };
                if plane_first {
                    plane(&mut world);
                }
                shape(&mut world).insert(Matte { colour: Rgb::new(1.0, 0.0, 0.0) });
                if !plane_first {
                    plane(&mut world);
                }
                let red = film(&world).pixels[0][0] == 1.0_f64.to_bits();
                assert_eq!(red, seen_first, "{name}, the plane {off:e} off, made first: {plane_first}");
                tried += 1;
            }
        }
    }
    eprintln!("no ties: {tried} pictures in which the nearer is seen");
}
