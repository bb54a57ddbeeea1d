//! Maps of metallic, roughness and emission: the values at points are those of the image's texels.

use super::*;
use pinhole::plan::VectorRows;
use pinhole::render::Inspection;
use pinhole::shade::{EmissionFactors, MetallicRoughness};

/// Texels of the map, across and down.
const SIZE: [u32; 2] = [4, 3];
/// The factors that the material and the emission have of their own.
const METALLIC: f64 = 0.75;
const ROUGHNESS: f64 = 0.9;

/// A number of a texel, in 255ths.
fn byte(x: u32, y: u32, part: u32) -> u8 {
    ((x * 61 + y * 97 + part * 151 + 40) % 256) as u8
}

/// The definition of sRGB (IEC 61966-2-1).
fn linear(byte: u8) -> f64 {
    let c = f64::from(byte) / 255.0;
    if c <= 0.04045 { c / 12.92 } else { libm::pow((c + 0.055) / 1.055, 2.4) }
}

/// A PNG whose bytes are these.
fn write_bytes(path: &Path) {
    let of = |x, y| image::Rgb([0, 1, 2].map(|part| byte(x, y, part)));
    image::RgbImage::from_fn(SIZE[0], SIZE[1], of).save(path).expect("written");
}

/// A square of both maps, seen from above.
fn scene(file: &Path, from: DVec3, size: f64, filter: bool) -> World {
    let mut world = close_up(Eye::Perspective, from, DVec3::new(0.1, 0.0, -0.2));
    let camera = named(&mut world, "camera");
    let camera_of = PerspectiveCamera { fov: Degrees(20.0), ..PerspectiveCamera::default() };
    // Paths would leave the rows of their last bounce.
    world.entity_mut(camera).insert((camera_of, Integrator::RayCasting));
    let file = file.to_string_lossy().into_owned();
    world.spawn((
        Rectangle { width: 4.0, depth: 4.0 },
        Principled { metallic: METALLIC, roughness: ROUGHNESS, ..Principled::default() },
        Emissive::default(),
        MetallicRoughnessMap { file: file.clone(), size, filter, ..MetallicRoughnessMap::default() },
        EmissionMap { file, size, filter, ..EmissionMap::default() },
    ));
    world.spawn((PointLight::default(), Placement::at(0.0, 5.0, 0.0)));
    world
}

/// What each row of the one tile got: u and v, metallic and roughness, and the factor of its emission.
fn rows(inspection: &Inspection) -> Vec<([f64; 2], [f64; 2], [f64; 3])> {
    let tile = inspection.world.entity(inspection.tiles[0]);
    let (uvs, hits) = (tile.get::<SurfaceUvs>().expect("uvs"), tile.get::<Hits>().expect("hits"));
    let found = tile.get::<MetallicRoughness>().expect("metallic and roughness");
    let factors = tile.get::<EmissionFactors>().expect("factors");
    let hit = (0..hits.t.len()).filter(|&row| hits.t[row].is_finite());
    hit.map(|row| {
        let factor = factors.times(row, [1.0; 3]).map(f64::from);
        (uvs.uv.at(row), found.get(row), factor)
    })
    .collect()
}

#[test]
fn maps_give_their_texels_times_the_factors() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("map.png");
    write_bytes(&file);
    let mut tried = 0;
    for size in [1.0, 0.25] {
        let world = scene(&file, DVec3::new(0.3, 6.0, 0.9), size, false);
        for (uv, [metallic, roughness], factor) in rows(&inspect(&world, &offer(), 32).expect("inspects")) {
            let [x, y] = [0, 1].map(|axis| {
                let at = uv[axis] / size;
                ((at - at.floor()) * f64::from(SIZE[axis])) as u32
            });
            let [green, blue] = [1, 2].map(|part| f64::from(byte(x, y, part)) / 255.0);
            assert!((metallic - METALLIC * blue).abs() < 1e-7, "{uv:?}: {metallic}");
            assert!((roughness - ROUGHNESS * green).abs() < 1e-7, "{uv:?}: {roughness}");
            for part in 0..3 {
                let expected = linear(byte(x, y, part));
                assert!((factor[part as usize] - expected).abs() < 1e-6, "{uv:?}: {factor:?}, {expected}");
            }
            tried += 1;
        }
    }
    eprintln!("maps: {tried} points have the numbers of their texels");
    assert!(tried > 1500, "{tried}");
}

/// Where a pixel sees the image many times, it gets the mean of all texels; emission's in linear light.
#[test]
fn maps_are_filtered_over_the_footprint() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("map.png");
    write_bytes(&file);
    let texels = || (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
    let mean = |of: &dyn Fn(u8) -> f64, part| {
        texels().map(|(x, y)| of(byte(x, y, part))).sum::<f64>() / f64::from(SIZE[0] * SIZE[1])
    };
    let world = scene(&file, DVec3::new(0.3, 6.0, 0.9), 1e-3, true);
    let (mut tried, mut worst) = (0, 0.0_f64);
    for (_, [metallic, roughness], factor) in rows(&inspect(&world, &offer(), 32).expect("inspects")) {
        let as_it_is = |byte| f64::from(byte) / 255.0;
        worst = worst.max((metallic - METALLIC * mean(&as_it_is, 2)).abs());
        worst = worst.max((roughness - ROUGHNESS * mean(&as_it_is, 1)).abs());
        (0..3).for_each(|part| worst = worst.max((factor[part as usize] - mean(&linear, part)).abs()));
        tried += 1;
    }
    eprintln!("filtered maps: {tried} points, the worst {worst:.1e} from the mean");
    assert!(tried > 900 && worst < 1e-5, "{tried}, {worst}");
}

/// A shape that only emits has a footprint too.
#[test]
fn the_map_of_a_shape_without_a_material_is_filtered() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("map.exr");
    write_exr(&drawn([2, 1], |x, _| [x as f32 * 8.0; 3]), &file).expect("written");
    let mut world = close_up(Eye::Perspective, DVec3::new(0.0, 6.0, 0.1), DVec3::ZERO);
    let map = EmissionMap { file: file.to_string_lossy().into_owned(), size: 1e-4, ..EmissionMap::default() };
    world.spawn((Rectangle { width: 4.0, depth: 4.0 }, Emissive::default(), map));
    let inspection = inspect(&world, &offer(), 32).expect("inspects");
    let factors = inspection.world.get::<EmissionFactors>(inspection.tiles[0]).expect("factors");
    let seen: Vec<f32> = factors.rgb[0].iter().copied().filter(|factor| *factor != 1.0).collect();
    assert!(seen.len() == 32 * 32 && seen.iter().all(|factor| (factor - 4.0).abs() < 1e-4), "{seen:?}");
}
