//! The public comparison scenes, number for number (shared/SCENES.md).

use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use pinhole::scene::*;
use pinhole_lab::measure::torus_knot::torus_knot;
use std::sync::OnceLock;

/// Their names.
pub const PUBLIC: [&str; 6] = ["cornell", "cornell-glass", "veach-mis", "spheres", "spheres-lens", "spheres-sky"];

const WHITE: [f64; 3] = [0.725, 0.71, 0.68];
const RED: [f64; 3] = [0.63, 0.065, 0.05];
const GREEN: [f64; 3] = [0.14, 0.45, 0.091];

type Quad = [[f64; 3]; 4];

const BOX: [(Quad, [f64; 3]); 5] = [
    ([[552.8, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 559.2], [549.6, 0.0, 559.2]], WHITE),
    ([[556.0, 548.8, 0.0], [556.0, 548.8, 559.2], [0.0, 548.8, 559.2], [0.0, 548.8, 0.0]], WHITE),
    ([[549.6, 0.0, 559.2], [0.0, 0.0, 559.2], [0.0, 548.8, 559.2], [556.0, 548.8, 559.2]], WHITE),
    ([[0.0, 0.0, 559.2], [0.0, 0.0, 0.0], [0.0, 548.8, 0.0], [0.0, 548.8, 559.2]], GREEN),
    ([[552.8, 0.0, 0.0], [549.6, 0.0, 559.2], [556.0, 548.8, 559.2], [556.0, 548.8, 0.0]], RED),
];

/// The corners of each block's lid, and its height; walls go down from each edge.
const BLOCKS: [([[f64; 2]; 4], f64); 2] = [
    ([[130.0, 65.0], [82.0, 225.0], [240.0, 272.0], [290.0, 114.0]], 165.0),
    ([[423.0, 247.0], [265.0, 296.0], [314.0, 456.0], [472.0, 406.0]], 330.0),
];

const PLATES: [(f64, Quad); 4] = [
    (0.005, plate([-2.70651, 0.25609], [-2.08375, -0.526323])),
    (0.02, plate([-3.28825, 1.36972], [-2.83856, 0.476536])),
    (0.05, plate([-3.73096, 2.70046], [-3.43378, 1.74564])),
    (0.1, plate([-3.99615, 4.0667], [-3.82069, 3.08221])),
];

const LAMPS: [([f64; 3], f64, f64); 5] = [
    ([-3.75, 0.0, 0.0], 0.03333, 901.803),
    ([-1.25, 0.0, 0.0], 0.1, 100.0),
    ([1.25, 0.0, 0.0], 0.3, 11.1111),
    ([3.75, 0.0, 0.0], 0.9, 1.23457),
    ([10.0, 10.0, 4.0], 0.5, 800.0),
];

const fn plate([low, near]: [f64; 2], [high, far]: [f64; 2]) -> Quad {
    [[-4.0, low, near], [4.0, low, near], [4.0, high, far], [-4.0, high, far]]
}

/// The scenes of a mesh: of 1,024,000 triangles, and of 102,400.
pub const MESHES: [&str; 4] = ["mesh", "mesh-ao", "mesh100k", "mesh100k-ao"];

/// A scene by its name, with the max_depth that it asks for.
pub fn public(name: &str, lights: LightStrategy) -> World {
    let mut world = World::new();
    let camera = |eye: [f64; 3], target: [f64; 3], fov, axis, size: [u32; 2], max_depth| {
        let look = LookAt { eye: eye.into(), target: target.into(), ..LookAt::default() };
        let integrator = Integrator::Path { max_depth, lights, roulette: 5 };
        let resolution = Resolution { width: size[0], height: size[1] };
        (Name::new("camera"), PerspectiveCamera { fov: Degrees(fov), axis }, look, resolution, integrator)
    };
    match name {
        "cornell" | "cornell-glass" => {
            let fov = 2.0 * libm::atan(0.0125 / 0.035) * 180.0 / std::f64::consts::PI;
            let max_depth = if name == "cornell" { 8 } else { 16 };
            let (eye, target) = ([278.0, 273.0, -800.0], [278.0, 273.0, 0.0]);
            world.spawn(camera(eye, target, fov, FovAxis::Vertical, [256, 256], max_depth));
            cornell(&mut world, name == "cornell");
        }
        "veach-mis" => {
            world.spawn(camera([0.0, 2.0, 15.0], [0.0, -2.0, 2.5], 28.0, FovAxis::Horizontal, [384, 256], 2));
            veach(&mut world);
        }
        "mesh" | "mesh-ao" | "mesh100k" | "mesh100k-ao" => {
            let mut eye =
                world.spawn(camera([0.0, 5.0, 8.0], [0.0, -0.3, 0.0], 40.0, FovAxis::Vertical, [256, 256], 6));
            let occlusion = name.ends_with("-ao");
            if occlusion {
                eye.insert(Integrator::AmbientOcclusion { distance: f64::INFINITY });
            }
            let [knot, ground] = if occlusion { [[1.0; 3]; 2] } else { [[0.6, 0.5, 0.4], [0.5; 3]] };
            // One for all renders, so that its hierarchy is built once: what peers time does not hold that either.
            static KNOTS: [OnceLock<MeshGeometry>; 2] = [const { OnceLock::new() }; 2];
            let (knot_of, [along, around]) =
                if name.starts_with("mesh100k") { (&KNOTS[0], [800, 64]) } else { (&KNOTS[1], [2560, 200]) };
            let geometry = knot_of.get_or_init(|| MeshGeometry::new(torus_knot(along, around))).clone();
            world.spawn((Name::new("knot"), MeshInstance { geometry }, matte(knot)));
            let [x, y, z] = [20.0, -1.6, 20.0];
            quad(&mut world, [[-x, y, -z], [-x, y, z], [x, y, z], [x, y, -z]], matte(ground));
            world.spawn((Name::new("sky"), Background { colour: Rgb::grey(1.0) }));
        }
        _ => {
            let mut eye = world.spawn(camera([13.0, 2.0, 3.0], [0.0; 3], 20.0, FovAxis::Vertical, [256, 144], 20));
            if name == "spheres-lens" {
                let radius = 10.0 * libm::tan(Degrees(0.3).radians());
                let aperture = Aperture::Radius { radius };
                eye.insert(Lens { aperture, focus_distance: 10.0, ..Lens::default() });
            }
            spheres(&mut world);
            if name == "spheres-sky" {
                world.spawn((Name::new("sky"), Gradient::default()));
            } else {
                world.spawn((Name::new("sky"), Background { colour: Rgb::new(0.7, 0.8, 1.0) }));
            }
        }
    }
    world
}

fn quad(world: &mut World, corners: Quad, material: impl Bundle + Clone) {
    let [a, b, c, d] = corners.map(DVec3::from);
    for vertices in [[a, b, c], [a, c, d]] {
        world.spawn((Triangle { vertices, ..Triangle::default() }, material.clone()));
    }
}

fn matte([r, g, b]: [f64; 3]) -> Matte {
    Matte { colour: Rgb::new(r, g, b) }
}

fn cornell(world: &mut World, blocks: bool) {
    for (corners, colour) in BOX {
        quad(world, corners, matte(colour));
    }
    if blocks {
        for (lid, height) in BLOCKS {
            let at = |corner: [f64; 2], height| [corner[0], height, corner[1]];
            quad(world, lid.map(|corner| at(corner, height)), matte(WHITE));
            for edge in 0..4 {
                let [from, to] = [lid[edge], lid[(edge + 3) % 4]];
                let wall = [at(from, 0.0), at(from, height), at(to, height), at(to, 0.0)];
                quad(world, wall, matte(WHITE));
            }
        }
    } else {
        world.spawn((Name::new("glass"), Sphere { radius: 90.0 }, Placement::at(160.0, 90.0, 190.0), Glass::default()));
        world.spawn((
            Name::new("mirror"),
            Sphere { radius: 90.0 },
            Placement::at(390.0, 90.0, 360.0),
            Mirror::default(),
        ));
    }
    // Turned over, so that its front looks down.
    let orientation = DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0);
    let place = Placement { position: DVec3::new(278.0, 548.7, 279.5), orientation, ..Placement::default() };
    let emissive = Emissive { radiance: Rgb::new(17.0, 12.0, 4.0), sides: Sides::Front };
    world.spawn((Name::new("light"), Rectangle { width: 130.0, depth: 105.0 }, place, emissive));
}

fn veach(world: &mut World) {
    for ([x, y, z], radius, radiance) in LAMPS {
        let emissive = Emissive { radiance: Rgb::grey(radiance), ..Emissive::default() };
        world.spawn((Sphere { radius }, Placement::at(x, y, z), emissive));
    }
    for (roughness, corners) in PLATES {
        quad(world, corners, Metal { colour: Rgb::grey(0.8), roughness, ..Metal::default() });
    }
    let y = -4.14615;
    quad(world, [[-10.0, y, -10.0], [-10.0, y, 10.0], [10.0, y, 10.0], [10.0, y, -10.0]], matte([0.4; 3]));
    let z = -2.0;
    quad(world, [[-10.0, -10.0, z], [10.0, -10.0, z], [10.0, 10.0, z], [-10.0, 10.0, z]], matte([0.4; 3]));
}

/// The scenes' own random numbers, by Lehmer's method.
struct Lehmer(u32);

impl Lehmer {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(self.0 >> 8) / f64::from(1 << 24)
    }
}

fn spheres(world: &mut World) {
    let mut numbers = Lehmer(12_345);
    for (a, b) in (-11..11).flat_map(|a| (-11..11).map(move |b| (f64::from(a), f64::from(b)))) {
        let [c, dx, dz, r1, g1, b1, r2, g2, b2] = [0; 9].map(|_| numbers.next());
        let centre = DVec3::new(a + 0.9 * dx, 0.2, b + 0.9 * dz);
        if centre.distance(DVec3::new(4.0, 0.2, 0.0)) <= 0.9 {
            continue;
        }
        let mut ball = world.spawn((Sphere { radius: 0.2 }, Placement { position: centre, ..Placement::default() }));
        let (colour, roughness) = (Rgb::new(0.5 + 0.5 * r1, 0.5 + 0.5 * g1, 0.5 + 0.5 * b1), 0.5 * r2);
        if c < 0.8 {
            ball.insert(matte([r1 * r2, g1 * g2, b1 * b2]));
        } else if c < 0.95 && roughness < 0.05 {
            ball.insert(Mirror { colour });
        } else if c < 0.95 {
            ball.insert(Metal { colour, roughness, ..Metal::default() });
        } else {
            ball.insert(Glass::default());
        }
    }
    let large = |radius, x, y| (Sphere { radius }, Placement::at(x, y, 0.0));
    world.spawn((Name::new("ground"), large(1000.0, 0.0, -1000.0), matte([0.5; 3])));
    world.spawn((large(1.0, 0.0, 1.0), Glass::default()));
    world.spawn((large(1.0, -4.0, 1.0), matte([0.4, 0.2, 0.1])));
    world.spawn((large(1.0, 4.0, 1.0), Mirror { colour: Rgb::new(0.7, 0.6, 0.5) }));
}
