//! Normal maps: a level one changes no bit, no surface gives back more than it gets, and light from the lamps agrees with
//! the camera's paths.

use super::*;
use glam::DVec3;
use pinhole::film::{Film, write_exr};
use pinhole::material::material_entities;
use pinhole::scene::*;
use scenes::caustics::{caustics, traced};
use scenes::followed::{INTEGRATORS, followed};
use scenes::{Setup, film, shapes_of_all_kinds, stretched, textured};
use std::path::Path;

/// Writes a normal map of so many texels a side, whose directions are `of` its texels'.
pub fn write_map(path: &Path, side: u32, of: impl Fn(u32) -> [f64; 3]) {
    let mut image = Film::new(side, side, side);
    for texel in 0..side * side {
        image.tiles[0].add(texel as usize, of(texel).map(|part| (0.5 + 0.5 * part) as f32));
    }
    write_exr(&image, path).expect("written");
}

/// Texels that lean in all directions, by up to some 50°.
fn bumpy(texel: u32) -> [f64; 3] {
    let part = |salt: u32| f64::from((texel * 7919 + salt * 104_729) % 1009) / 504.0 - 1.0;
    let (x, y) = (0.6 * part(1), 0.6 * part(2));
    [x, y, libm::sqrt(1.0 - x * x - y * y)]
}

/// Gives every material of a scene a normal map.
fn mapped(world: &mut World, file: &Path, size: f64) {
    let map = NormalMap { file: file.to_string_lossy().into_owned(), size, ..NormalMap::default() };
    let materials = material_entities(&Census::of(world));
    materials.iter().for_each(|&material| _ = world.entity_mut(material).insert(map.clone()));
}

#[test]
fn a_level_map_keeps_every_bit() {
    let folder = tempfile::tempdir().expect("a folder");
    let [level, bumps] = ["level.exr", "bumps.exr"].map(|name| folder.path().join(name));
    write_map(&level, 2, |_| [0.0, 0.0, 1.0]);
    write_map(&bumps, 8, bumpy);
    let setup = Setup { size: [24, 16], ..Setup::default() };
    let scenes: [(&str, World); 6] = [
        ("textured", textured(setup)),
        ("shapes", shapes_of_all_kinds(setup)),
        ("stretched", stretched(setup)),
        ("paths", followed(INTEGRATORS[6], setup)),
        ("Whitted's rays", followed(Integrator::WHITTED, setup)),
        ("light from lamps", traced(|| caustics(true))()),
    ];
    for (name, mut scene) in scenes {
        let expected = film(&scene);
        mapped(&mut scene, &level, 0.25);
        film(&scene).assert_is(&expected, &format!("{name} with a level map"));
        mapped(&mut scene, &bumps, 0.25);
        assert!(film(&scene) != expected, "{name}: bumps show");
    }
    eprintln!("level normal maps: 6 scenes keep every bit");
}

/// A ball and a lying plate in a white sky.
fn furnace(material: impl Bundle + Clone, file: &Path) -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.0, 1.2, 4.0), target: DVec3::ZERO, up: DVec3::Y };
    let integrator = Integrator::Path { max_depth: 40, lights: LightStrategy::Mis, roulette: 0 };
    let size = Resolution { width: 32, height: 32 };
    let camera = PerspectiveCamera { fov: Degrees(30.0), ..PerspectiveCamera::default() };
    world.spawn((Name::new("camera"), camera, look, size, integrator));
    world.spawn(Background { colour: Rgb::grey(1.0) });
    world.spawn((Sphere { radius: 0.6 }, Placement::at(0.0, 0.4, 0.0), material.clone()));
    world.spawn((Cuboid { size: DVec3::new(3.0, 0.2, 3.0) }, Placement::at(0.0, -0.5, 0.0), material));
    mapped(&mut world, file, 0.1);
    world
}

#[test]
fn in_a_white_furnace_no_block_is_brighter_than_the_sky() {
    const SETS: u64 = 8;
    const SAMPLES: u32 = 64;
    const SIDE: usize = 8;
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("bumps.exr");
    write_map(&file, 16, bumpy);
    let white = Rgb::grey(1.0);
    let metal = |roughness| Metal { colour: white, roughness, multiple_scattering: true };
    let principled =
        |metallic, roughness| Principled { base_colour: white, metallic, roughness, ..Principled::default() };
    // The same image of numbers from 0 to 1, as metallic and roughness.
    let by_image = MetallicRoughnessMap { file: file.to_string_lossy().into_owned(), size: 0.3, ..Default::default() };
    let furnaces: [(&str, World); 9] = [
        ("matte", furnace(Matte { colour: white }, &file)),
        ("mirror", furnace(Mirror { colour: white }, &file)),
        ("metal", furnace(metal(0.2), &file)),
        ("rough metal", furnace(metal(1.0), &file)),
        ("plastic", furnace(principled(0.0, 0.3), &file)),
        ("principled metal", furnace(principled(1.0, 0.8), &file)),
        ("principled, by an image", furnace((principled(1.0, 1.0), by_image), &file)),
        ("glass", furnace(Glass::default(), &file)),
        ("rough glass", furnace(RoughGlass { roughness: 0.4, ..RoughGlass::default() }, &file)),
    ];
    let mut tried = 0;
    for (name, world) in furnaces {
        let text = pinhole::scene::scene_text(&world).expect("text");
        let make = || SceneFile::parse(Path::new("furnace.ron"), text.clone()).expect("a scene").world();
        let images = renders(&make, LightStrategy::Mis, SAMPLES, 0..SETS);
        let [width, height] = images[0].size.map(|side| side as usize);
        let (mut brightest, mut mean) = (0.0_f64, 0.0);
        for (x, y) in (0..height).step_by(SIDE).flat_map(|y| (0..width).step_by(SIDE).map(move |x| (x, y))) {
            let block = |image: &Numbers| {
                let rows = (y..y + SIDE).flat_map(|y| (x..x + SIDE).map(move |x| image.pixels[y * width + x][1]));
                rows.sum::<f64>() / (SIDE * SIDE) as f64
            };
            let means: Vec<f64> = images.iter().map(block).collect();
            let own = means.iter().sum::<f64>() / SETS as f64;
            let squares: f64 = means.iter().map(|mean| (mean - own) * (mean - own)).sum();
            let error = (squares / (SETS * (SETS - 1)) as f64).sqrt();
            assert!(error < 0.01, "{name}: a block is known to {error} only");
            assert!(own < 1.0 + 1e-3 + 4.5 * error, "{name}: block {x}, {y}: {own} ± {error}");
            (brightest, mean) = (brightest.max(own), mean + own * (SIDE * SIDE) as f64 / (width * height) as f64);
            tried += 1;
        }
        eprintln!("normal maps in the furnace: {name}: mean {mean:.4}, brightest block {brightest:.4}");
        assert!(mean > 0.5, "{name}: nearly black");
    }
    eprintln!(
        "normal maps in the furnace: {tried} blocks of {} samples",
        SIDE * SIDE * SETS as usize * SAMPLES as usize
    );
}

#[test]
fn light_from_lamps_agrees_with_the_camera_s_paths() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("bumps.exr");
    write_map(&file, 8, |texel| {
        let [x, y, _] = bumpy(texel).map(|part| 0.5 * part);
        [x, y, libm::sqrt(1.0 - x * x - y * y)]
    });
    let make = || {
        let mut world = caustics(true);
        mapped(&mut world, &file, 0.5);
        world
    };
    super::caustics::agrees("caustics of bumps", &make, 16);
}
