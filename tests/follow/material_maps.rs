//! Surfaces with maps of metallic, roughness and emission look like several surfaces that have these numbers one by one,
//! by every light strategy.

use super::*;
use glam::DVec3;
use pinhole::film::{Film, write_exr};
use pinhole::models::TriangleMesh;
use pinhole::scene::{
    EmissionMap, Emissive, LookAt, MeshGeometry, MeshInstance, MetallicRoughnessMap, OrthographicCamera, Placement,
    Principled, Rectangle, Wrap,
};
use std::path::Path;

/// What the quarters of the light emit, from the least x and z on, along x first.
const RADIANCE: [[f64; 3]; 4] = [[4.0, 1.0, 0.5], [0.5, 3.0, 1.0], [1.0, 1.0, 5.0], [0.0, 0.0, 0.0]];
/// The factor of the radiance that is not in the image.
const SCALE: f64 = 5.0;
/// Metallic and roughness of the two halves of the floor, from the least x on.
const HALVES: [[f64; 2]; 2] = [[0.25, 0.9], [1.0, 0.5]];
/// The side of a block of pixels.
const SIDE: u32 = 8;

fn write_texels(path: &Path, [width, height]: [u32; 2], texels: &[[f64; 3]]) -> String {
    let mut film = Film::new(width, height, width.max(height));
    for (at, texel) in texels.iter().enumerate() {
        film.tiles[0].add(at, texel.map(|part| part as f32));
    }
    write_exr(&film, path).expect("written");
    path.to_string_lossy().into_owned()
}

/// A camera above a floor and the light over it, neither of which is there yet.
fn room() -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.0, 4.0, 5.0), target: DVec3::ZERO, ..LookAt::default() };
    world.spawn((
        Name::new("camera"),
        OrthographicCamera { view_height: 4.0 },
        look,
        Resolution { width: 4 * SIDE, height: 4 * SIDE },
        Integrator::Path { max_depth: 4, lights: LightStrategy::Mis, roulette: 0 },
    ));
    world
}

fn one_by_one() -> World {
    let mut world = room();
    for (quarter, [r, g, b]) in RADIANCE.into_iter().enumerate() {
        let at = |number: usize| number as f64 - 0.5;
        let placement = Placement::at(at(quarter % 2), 1.5, at(quarter / 2));
        let emissive = Emissive { radiance: Rgb::new(r, g, b), ..Emissive::default() };
        world.spawn((Rectangle { width: 1.0, depth: 1.0 }, placement, emissive));
    }
    for (x, [metallic, roughness]) in [-1.5, 1.5].into_iter().zip(HALVES) {
        let own = Principled { base_colour: Rgb::new(0.9, 0.7, 0.4), metallic, roughness, ..Principled::default() };
        world.spawn((Rectangle { width: 3.0, depth: 6.0 }, Placement::at(x, 0.0, 0.0), own));
    }
    world
}

/// The same square as a mesh of so many triangles that a hierarchy would choose among them, were they sampled.
fn square() -> MeshInstance {
    const CELLS: u32 = 4;
    let corner = |at: u32| [at % (CELLS + 1), at / (CELLS + 1)].map(|cell| cell as f32 / CELLS as f32);
    let corners = (0..(CELLS + 1) * (CELLS + 1)).map(corner);
    let cell = |at: u32| {
        let first = at / CELLS * (CELLS + 1) + at % CELLS;
        let [right, below] = [first + 1, first + CELLS + 1];
        [[first, below, right], [right, below, below + 1]]
    };
    let mesh = TriangleMesh {
        positions: corners.clone().map(|[u, v]| [2.0 * u - 1.0, 0.0, 2.0 * v - 1.0]).collect(),
        triangles: (0..CELLS * CELLS).flat_map(cell).collect(),
        uvs: Some(corners.collect()),
        ..TriangleMesh::default()
    };
    MeshInstance { geometry: MeshGeometry::new(mesh) }
}

fn by_maps<B: Bundle>(shape: B, [emission, halves]: [&str; 2]) -> World {
    let mut world = room();
    world.spawn((
        shape,
        Placement::at(0.0, 1.5, 0.0),
        Emissive { radiance: Rgb::grey(SCALE), ..Emissive::default() },
        EmissionMap { file: emission.into(), wrap: Wrap::Clamp, filter: false, ..EmissionMap::default() },
    ));
    world.spawn((
        Rectangle { width: 6.0, depth: 6.0 },
        Principled { base_colour: Rgb::new(0.9, 0.7, 0.4), metallic: 1.0, roughness: 1.0, ..Principled::default() },
        MetallicRoughnessMap { file: halves.into(), wrap: Wrap::Clamp, filter: false, ..Default::default() },
    ));
    world
}

#[test]
fn a_map_is_as_good_as_a_surface_for_each_texel() {
    const SAMPLES: u32 = 32;
    let folder = tempfile::tempdir().expect("a folder");
    let texels = RADIANCE.map(|radiance| radiance.map(|part| part / SCALE));
    let emission = write_texels(&folder.path().join("emission.exr"), [2, 2], &texels);
    let texels = HALVES.map(|[metallic, roughness]| [0.0, roughness, metallic]);
    let halves = write_texels(&folder.path().join("halves.exr"), [2, 1], &texels);
    let mapped = || by_maps(Rectangle { width: 2.0, depth: 2.0 }, [&emission, &halves]);
    strategies_agree("maps", &mapped, ALL, SAMPLES, SIDE);
    // The light with an image is found by BSDF sampling, so it takes more samples.
    let one = renders(&mapped, LightStrategy::Mis, 4 * SAMPLES, 100..112);
    let other = renders(&one_by_one, LightStrategy::Mis, SAMPLES, 200..212);
    assert_agree("maps, and surfaces one by one", &one, &other, SIDE);
    let mesh = || by_maps(square(), [&emission, &halves]);
    for (lights, seeds) in [(LightStrategy::Mis, 300..312), (LightStrategy::Light, 400..412)] {
        let one = renders(&mesh, lights, 4 * SAMPLES, seeds);
        assert_agree("a mesh with an image of its emission, and surfaces one by one", &one, &other, SIDE);
    }
    let plan = pinhole::plan::plan(&Census::of(&mapped()), &offer()).expect("a plan");
    let said: Vec<&str> =
        plan.rows.iter().map(|row| &*row.reason).filter(|why| why.contains("found by BSDF")).collect();
    assert!(!said.is_empty(), "the plan does not say that the light is not sampled");
}

/// Images of 1 everywhere, at a roughness that has a table of its own: the same picture to the last bit, by the strategy
/// that finds both lights in the same way.
#[test]
fn maps_of_one_change_no_bit() {
    let folder = tempfile::tempdir().expect("a folder");
    let white = write_texels(&folder.path().join("white.exr"), [2, 2], &[[1.0; 3]; 4]);
    let plain = |lit: bool, worn: bool| {
        let mut world = room();
        let emissive = Emissive { radiance: Rgb::new(5.0, 4.0, 3.0), ..Emissive::default() };
        let mut light = world.spawn((Rectangle { width: 2.0, depth: 2.0 }, Placement::at(0.0, 1.5, 0.0), emissive));
        if lit {
            light.insert(EmissionMap { file: white.clone(), ..EmissionMap::default() });
        }
        for (x, filter) in [(-1.5, false), (1.5, true)] {
            let own = Principled {
                base_colour: Rgb::new(0.9, 0.7, 0.4),
                metallic: 0.75,
                roughness: 1.0,
                ..Principled::default()
            };
            let mut floor = world.spawn((Rectangle { width: 3.0, depth: 6.0 }, Placement::at(x, 0.0, 0.0), own));
            if worn {
                floor.insert(MetallicRoughnessMap { file: white.clone(), filter, ..MetallicRoughnessMap::default() });
            }
        }
        world
    };
    let bits = |lit: bool, worn: bool, lights: LightStrategy| -> Vec<[u64; 3]> {
        let images = renders(&|| plain(lit, worn), lights, 4, 0..1);
        images[0].pixels.iter().map(|pixel| pixel.map(f64::to_bits)).collect()
    };
    for (lit, worn, lights) in [
        (true, true, LightStrategy::Bsdf),
        (true, false, LightStrategy::Bsdf),
        (false, true, LightStrategy::Light),
        (false, true, LightStrategy::Mis),
    ] {
        let [found, expected] = [bits(lit, worn, lights), bits(false, false, lights)];
        let apart = found.iter().zip(&expected).filter(|(found, expected)| found != expected).count();
        assert_eq!(apart, 0, "{lit}, {worn}, {lights:?}: pixels of {}", expected.len());
        assert!(expected.iter().any(|pixel| *pixel != [0; 3]), "{lights:?}: something is seen");
    }
}
