//! What an OpenEXR file says of itself, read back by the `exr` crate: how it is packed, where its camera is, how its
//! channels are called, and which shapes its pixels show. `tests/bench/readers.py` asks other programs the same.

use crate::scenes::{EYES, Eye, Setup, all_round, fisheye, full, named, offer, turned};
use bevy_ecs::prelude::*;
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};
use exr::prelude::{AttributeValue, Compression, FlatSamples, LineOrder, Text, read_first_flat_layer_from_file};
use glam::DVec3;
use pinhole::extract::{CameraAxes, eye};
use pinhole::film::{
    FileAttributes, Film, GUIDES, LayerNames, denoise, exr_bytes, float_hash, hex_of, left_out, read_checkpoint,
    write_checkpoint, write_exr, write_exr_with,
};
use pinhole::plan::{Census, Table};
use pinhole::rays::Tile;
use pinhole::render::{Execution, Rendered, render};
use pinhole::scene::*;
use std::collections::BTreeMap;
use std::path::Path;

const SIZE: [u32; 2] = [97, 71];

/// A scene by a camera that keeps layers.
fn kept(mut scene: World, kinds: &[LayerKind], sampling: Option<Sampling>) -> World {
    let camera = named(&mut scene, "camera");
    scene.entity_mut(camera).insert(Layers { kinds: kinds.to_vec() });
    if let Some(sampling) = sampling {
        scene.entity_mut(camera).insert(sampling);
    }
    scene
}

fn rendered(scene: &World) -> Rendered {
    render(scene, &offer(), &Execution::default(), &()).expect("renders")
}

/// The header of a file, and its channels by name.
fn read(path: &Path) -> (Header, BTreeMap<String, Vec<f64>>) {
    let meta = MetaData::read_from_file(path, true).expect("a header");
    let layer = read_first_flat_layer_from_file(path).expect("an EXR").layer_data;
    let numbers = |samples: &FlatSamples| match samples {
        FlatSamples::F32(values) => values.iter().map(|&value| f64::from(value)).collect(),
        FlatSamples::U32(values) => values.iter().map(|&value| f64::from(value)).collect(),
        FlatSamples::F16(_) => panic!("no half floats are written"),
    };
    let channels = layer.channel_data.list.iter();
    let named = channels.map(|channel| (channel.name.to_string(), numbers(&channel.sample_data)));
    (meta.headers[0].clone(), named.collect())
}

fn text(header: &Header, name: &str) -> String {
    match header.own_attributes.other.get(&Text::from(name)) {
        Some(AttributeValue::Text(text)) => String::from_utf8(text.as_slice().to_vec()).expect("UTF-8"),
        other => panic!("{name} is {other:?}"),
    }
}

/// A row vector times a matrix as the format has it, divided by the fourth coordinate.
fn transformed(point: DVec3, matrix: &[f32; 16]) -> DVec3 {
    let along = |column: usize| {
        let entry = |row: usize| f64::from(matrix[4 * row + column]);
        point.x * entry(0) + point.y * entry(1) + point.z * entry(2) + entry(3)
    };
    DVec3::new(along(0), along(1), along(2)) / along(3)
}

#[test]
fn every_file_is_scan_lines_of_zip_that_say_what_their_colours_are() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("picture.exr");
    let one = Sampling { samples: 3, ..Sampling::default() };
    let mut files = 0;
    for scene in
        [full(Setup { size: SIZE, ..Setup::default() }), kept(full(Setup::default()), &LayerKind::ALL, Some(one))]
    {
        let Rendered { film, attributes, .. } = rendered(&scene);
        let said = FileAttributes { texts: vec![("command", "pinhole".into()), ("seed", "7".into())], ..attributes };
        write_exr_with(&film, None, &said, &path).expect("written");
        let (header, _) = read(&path);
        assert_eq!((header.compression, header.blocks), (Compression::ZIP16, BlockDescription::ScanLines));
        assert_eq!(header.line_order, LineOrder::Increasing);
        let chromaticities = header.shared_attributes.chromaticities.expect("chromaticities");
        let [red, green, blue, white] =
            [chromaticities.red, chromaticities.green, chromaticities.blue, chromaticities.white]
                .map(|place| [place.x(), place.y()]);
        // Recommendation ITU-R BT.709, item 1.3 and 1.4.
        assert_eq!([red, green, blue, white], [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06], [0.3127, 0.329]]);
        assert_eq!(header.shared_attributes.display_window, header.data_window());
        assert_eq!(header.own_attributes.software_name.as_ref().map(ToString::to_string), Some("pinhole".into()));
        let samples = if film.layers.is_empty() { "1" } else { "3" };
        let texts = ["command", "seed", "samples"].map(|name| text(&header, &format!("pinhole/{name}")));
        assert_eq!(texts, ["pinhole", "7", samples]);

        let bytes = std::fs::read(&path).expect("read");
        for _ in 0..16 {
            assert!(exr_bytes(&film, &said).expect("encoded") == bytes, "the same picture in other bytes");
        }
        let mut names = attribute_names(&bytes);
        assert_eq!(names.remove(0), "software", "the mark is where it is looked for, however long the rest");
        assert!(names.len() > 10 && names.is_sorted(), "{names:?}");
        files += 1;
    }
    eprintln!("files: {files} kinds, each the same bytes 16 times");
}

/// The names of a header's attributes in the order of the file.
fn attribute_names(bytes: &[u8]) -> Vec<String> {
    let (mut at, mut names) = (8, Vec::new());
    let word = |at: usize| {
        let length = bytes[at..].iter().position(|&byte| byte == 0).expect("ends");
        (String::from_utf8(bytes[at..at + length].to_vec()).expect("text"), at + length + 1)
    };
    while bytes[at] != 0 {
        let (name, after) = word(at);
        let (_, after) = word(after);
        names.push(name);
        at = after + 4 + u32::from_le_bytes(bytes[after..after + 4].try_into().expect("four bytes")) as usize;
    }
    names
}

#[test]
fn the_matrices_take_every_surface_to_its_pixel() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("picture.exr");
    let mut pixels = 0;
    for camera in EYES {
        let scene = turned(Setup { eye: camera, size: SIZE, ..Setup::default() });
        let scene = kept(scene, &[LayerKind::Position, LayerKind::DepthAlongAxis, LayerKind::Coverage], None);
        let Rendered { film, attributes, .. } = rendered(&scene);
        write_exr_with(&film, None, &attributes, &path).expect("written");
        let (header, channels) = read(&path);
        let world_to_camera = header.own_attributes.world_to_camera.expect("a matrix");
        let world_to_ndc = header.own_attributes.world_to_normalized_device.expect("a matrix");
        for pixel in (0..(SIZE[0] * SIZE[1]) as usize).filter(|&pixel| channels["coverage.A"][pixel] > 0.0) {
            let at = |name: &str| channels[name][pixel];
            let position = DVec3::new(at("position.X"), at("position.Y"), at("position.Z"));
            // What is far away has few digits behind the point, and the matrix has 24 bits.
            let slack = 1e-6 * (1.0 + position.length());
            let ndc = transformed(position, &world_to_ndc).truncate();
            let centre = glam::DVec2::new((pixel as u32 % SIZE[0]) as f64 + 0.5, (pixel as u32 / SIZE[0]) as f64 + 0.5)
                / glam::DVec2::new(f64::from(SIZE[0]), f64::from(SIZE[1]));
            assert!((ndc - centre).length() < 1e-4, "{camera:?} {position}: {ndc} is not {centre}");
            let in_camera = transformed(position, &world_to_camera);
            assert!((in_camera.z - at("Z")).abs() < slack, "{camera:?}: {in_camera} is not {} deep", at("Z"));
            pixels += 1;
        }
        // Left-handed: x to the right, y up, z forward.
        let census = &Census::of(&scene);
        let (eye, axes) = (eye(census).expect("an eye"), CameraAxes::extract(census).expect("axes").world_from_camera);
        for (axis, expected) in [(axes.x_axis, DVec3::X), (axes.y_axis, DVec3::Y), (-axes.z_axis, DVec3::Z)] {
            assert!((transformed(eye + axis, &world_to_camera) - expected).length() < 1e-5);
        }
        // The window is that on the plane at distance 1, and an orthographic camera says 1, as the format wants it.
        let half = f64::from(header.own_attributes.screen_window_width) / 2.0;
        match camera {
            Eye::Perspective => {
                let ndc = transformed(eye - axes.z_axis + half * axes.x_axis, &world_to_ndc);
                assert!((ndc.truncate() - glam::DVec2::new(1.0, 0.5)).length() < 1e-5, "{ndc}");
            }
            Eye::Orthographic => assert_eq!(half, 0.5),
        }
    }
    for scene in
        [fisheye(Setup { size: SIZE, ..Setup::default() }), all_round(Setup { size: SIZE, ..Setup::default() })]
    {
        let Rendered { film, attributes, .. } = rendered(&scene);
        write_exr_with(&film, None, &attributes, &path).expect("written");
        let own = read(&path).0.own_attributes;
        assert!(own.world_to_camera.is_some() && own.world_to_normalized_device.is_none(), "no image plane");
    }
    assert!(pixels > 5000, "{pixels}");
    eprintln!("matrices: {pixels} pixels of 2 cameras found again; 2 cameras without an image plane");
}

/// Radiance has been multiplied by alpha, as the format has it: where a sky shines, nothing behind it does.
#[test]
fn alpha_is_what_is_hidden_of_a_background() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("picture.exr");
    let sampling = Sampling { samples: 5, ..Sampling::default() };
    let (mut partly, mut tried) = (0, 0);
    for has_sky in [true, false] {
        let mut scene = full(Setup { size: SIZE, ..Setup::default() });
        if !has_sky {
            let sky = named(&mut scene, "sky");
            scene.despawn(sky);
        }
        for with_coverage in [true, false] {
            let kinds = if with_coverage { [LayerKind::Coverage] } else { [LayerKind::Albedo] };
            let scene = kept(full_again(&mut scene), &kinds, Some(sampling));
            let Rendered { film, attributes, .. } = rendered(&scene);
            write_exr_with(&film, None, &attributes, &path).expect("written");
            let (_, channels) = read(&path);
            assert_eq!(channels.contains_key("A"), with_coverage);
            tried += 1;
            if !with_coverage {
                continue;
            }
            for (&alpha, &coverage) in channels["A"].iter().zip(&channels["coverage.A"]) {
                assert_eq!(alpha, if has_sky { 1.0 } else { coverage });
                partly += usize::from(!has_sky && coverage > 0.0 && coverage < 1.0);
            }
        }
    }
    assert!(partly > 50, "{partly}");
    eprintln!("alpha: {tried} files; {partly} pixels cover a part");
}

/// The same scene with or without its sky, once more.
fn full_again(scene: &mut World) -> World {
    let mut again = full(Setup { size: SIZE, ..Setup::default() });
    if scene.query::<&Background>().iter(scene).next().is_none() {
        let sky = named(&mut again, "sky");
        again.despawn(sky);
    }
    again
}

/// The names that each program's sources and files have, written down from them.
#[test]
fn channels_are_called_as_each_program_calls_them() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("picture.exr");
    let mut kinds = LayerKind::ALL.to_vec();
    kinds.extend(GUIDES);
    let Rendered { film, attributes, .. } =
        rendered(&kept(full(Setup { size: [16, 9], ..Setup::default() }), &kinds, None));
    let radiance = denoise(&film, 1).expect("guides");
    // What Blender 5.0.1 writes, film.cpp of PBRT v4 lists, and split_exr.py of Open Image Denoise 2.3 looks for.
    let expected: [(LayerNames, &[&str]); 4] = [
        (LayerNames::Pinhole, &["R", "G", "B", "A", "Z", "albedo.R", "normal.X", "shading_normal.Y", "noisy.B"]),
        (
            LayerNames::Blender,
            &[
                "ViewLayer.Combined.R",
                "ViewLayer.Combined.A",
                "ViewLayer.Depth.Z",
                "ViewLayer.Position.X",
                "ViewLayer.Normal.Y",
                "ViewLayer.UV.U",
                "ViewLayer.UV.V",
                "ViewLayer.Denoising Albedo.B",
                "ViewLayer.Denoising Normal.Z",
                "ViewLayer.Noisy Image.G",
                "ViewLayer.CryptoObject00.r",
                "ViewLayer.CryptoObject02.a",
            ],
        ),
        (
            LayerNames::Pbrt,
            &[
                "R", "G", "B", "Albedo.R", "Albedo.G", "Albedo.B", "P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z", "Ns.X",
                "Ns.Y", "Ns.Z", "u", "v",
            ],
        ),
        (LayerNames::Oidn, &["R", "G", "B", "albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z"]),
    ];
    let mut found = 0;
    for (layer_names, expected) in expected {
        let said = FileAttributes { layer_names, ..attributes.clone() };
        write_exr_with(&film, Some(&radiance), &said, &path).expect("written");
        let (_, channels) = read(&path);
        for name in expected {
            assert!(channels.contains_key(*name), "{layer_names:?}: {name} among {:?}", channels.keys());
            found += 1;
        }
        assert_eq!(channels.len(), 3 + 3 + 1 + LayerKind::ALL.iter().map(|kind| kind.channels().len()).sum::<usize>());
        assert!(layer_names != LayerNames::Blender || channels.keys().all(|name| name.starts_with("ViewLayer.")));
        let of = |names: [&str; 3], part: usize| channels[names[part]].clone();
        let (shown, noisy) = match layer_names {
            LayerNames::Blender => (
                ["ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B"],
                ["ViewLayer.Noisy Image.R", "ViewLayer.Noisy Image.G", "ViewLayer.Noisy Image.B"],
            ),
            _ => (["R", "G", "B"], ["noisy.R", "noisy.G", "noisy.B"]),
        };
        for part in 0..3 {
            let means = (0..9).flat_map(|y| (0..16).map(move |x| (x, y)));
            let means: Vec<f64> = means.map(|(x, y)| f64::from(film.mean(x, y)[part])).collect();
            assert_eq!(of(noisy, part), means, "the picture as it was sampled");
            assert_eq!(of(shown, part), radiance[part].iter().map(|&value| f64::from(value)).collect::<Vec<_>>());
        }
    }
    eprintln!("names: {found} names of 4 programs found");
}

/// Cryptomatte by the other layers: its numbers are those of the names, its fractions add up to the coverage.
#[test]
fn cryptomatte_says_which_shapes_a_pixel_shows() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (path, checkpoint) = (folder.path().join("mattes.exr"), folder.path().join("mattes.checkpoint"));
    let kinds = [LayerKind::Coverage, LayerKind::Entity, LayerKind::Cryptomatte];
    let (mut shared, mut tried) = (0, 0);
    for samples in [None, Some(7)] {
        let sampling = samples.map(|samples| Sampling { samples, ..Sampling::default() });
        let scene = kept(turned(Setup { size: SIZE, ..Setup::default() }), &kinds, sampling);
        let Rendered { film, attributes, .. } = rendered(&scene);
        write_exr_with(&film, None, &attributes, &path).expect("written");
        let (header, channels) = read(&path);
        assert_eq!(text(&header, "cryptomatte/3ae39a5/name"), "CryptoObject");
        assert_eq!(text(&header, "cryptomatte/3ae39a5/hash"), "MurmurHash3_32");
        assert_eq!(text(&header, "cryptomatte/3ae39a5/conversion"), "uint32_to_float32");
        let manifest = text(&header, "cryptomatte/3ae39a5/manifest");
        let entities = text(&header, "entityNames");
        let names: Vec<&str> = entities.split("; ").map(|entry| entry.split('"').nth(1).expect("a name")).collect();
        for name in &names {
            let entry = format!("\"{name}\":\"{}\"", hex_of(float_hash(name)));
            assert_eq!(manifest.matches(&entry).count(), 1, "{entry} in {manifest}");
        }
        for pixel in 0..(SIZE[0] * SIZE[1]) as usize {
            let rank = |rank: usize| {
                let letters = [["r", "g"], ["b", "a"]][rank % 2];
                let [hash, part] =
                    letters.map(|letter| channels[&format!("CryptoObject0{}.{letter}", rank / 2)][pixel]);
                ((hash as f32).to_bits(), part)
            };
            let ranks: Vec<(u32, f64)> = (0..6).map(rank).filter(|&(_, part)| part > 0.0).collect();
            assert!(ranks.windows(2).all(|pair| pair[0].1 >= pair[1].1 && pair[0].0 != pair[1].0), "{ranks:?}");
            let sum: f64 = ranks.iter().map(|(_, part)| part).sum();
            assert!((sum - channels["coverage.A"][pixel]).abs() < 1e-6, "{ranks:?}");
            let first = channels["entity.ID"][pixel];
            if first < f64::from(u32::MAX) {
                let hash = float_hash(names[first as usize]).to_bits();
                assert!(ranks.iter().any(|&(own, _)| own == hash), "the first sample's shape is among them");
                assert!(samples.is_some() || ranks == [(hash, 1.0)]);
            }
            shared += usize::from(ranks.len() > 1);
            tried += 1;
        }
        assert_eq!(left_out(&film, &attributes), (0, 0.0));
        write_checkpoint(&film, 5, &checkpoint).expect("written");
        assert!(read_checkpoint(5, &film, false, &checkpoint).expect("read") == film, "a checkpoint holds them all");
    }
    assert!(shared > 100, "{shared}");
    eprintln!("cryptomatte: {tried} pixels, {shared} of which show several shapes");
}

/// A pixel that shows ten shapes, two of which have one name: six names are written, and what is not is told.
#[test]
fn what_cryptomatte_has_no_room_for_is_told() {
    let mut scene = World::new();
    let sampling = Sampling { samples: 4096, sampler: Sampler::Sobol, filter: Filter::Box { radius: 0.5 }, seed: 0 };
    let layers = Layers { kinds: vec![LayerKind::Cryptomatte] };
    let image = (OrthographicCamera { view_height: 1.0 }, Resolution { width: 1, height: 1 });
    scene.spawn((Name::new("camera"), image, sampling, layers));
    // Discs of known areas, none behind another: balls before an orthographic camera.
    let mut areas = BTreeMap::new();
    for number in 0..10 {
        let radius = 0.03 + 0.004 * f64::from(number);
        let place = DVec3::new(f64::from(number % 5) * 0.19 - 0.38, f64::from(number / 5) * 0.4 - 0.2, -3.0);
        let name = if number < 2 { "twins".to_owned() } else { format!("ball {number}") };
        *areas.entry(name.clone()).or_insert(0.0) += std::f64::consts::PI * radius * radius;
        scene.spawn((
            Name::new(name),
            Sphere { radius },
            Placement { position: place, ..Placement::default() },
            Matte::default(),
        ));
    }
    let Rendered { film, attributes, .. } = rendered(&scene);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("mattes.exr");
    write_exr_with(&film, None, &attributes, &path).expect("written");
    let (_, channels) = read(&path);
    let mut sorted: Vec<(&String, f64)> = areas.iter().map(|(name, &area)| (name, area)).collect();
    sorted.sort_by(|one, other| other.1.total_cmp(&one.1));
    let mut rest: f64 = areas.values().sum();
    for rank in 0..6 {
        let letter = ["g", "a"][rank % 2];
        let part = channels[&format!("CryptoObject0{}.{letter}", rank / 2)][0];
        assert!((part - sorted[rank].1).abs() < 1e-3, "rank {rank}: {part} of {:?}", sorted[rank]);
        rest -= sorted[rank].1;
    }
    let first = channels["CryptoObject00.r"][0] as f32;
    assert_eq!(first.to_bits(), float_hash(sorted[0].0).to_bits());
    let (pixels, part) = left_out(&film, &attributes);
    assert!(pixels == 1 && (part - rest).abs() < 3e-3, "{part} is not {rest}");
    eprintln!("cryptomatte: 9 names in a pixel, 6 areas as computed, the rest of {part:.4} told");
}

/// A file without anything that a scene says is written, too.
#[test]
fn a_film_alone_has_no_camera() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("film.exr");
    write_exr(&Film::new(3, 2, 32), &path).expect("written");
    let (header, channels) = read(&path);
    let own = header.own_attributes;
    assert!(own.world_to_camera.is_none() && own.world_to_normalized_device.is_none());
    assert_eq!(channels.into_iter().collect::<Vec<_>>(), ["B", "G", "R"].map(|name| (name.to_owned(), vec![0.0; 6])));
}

/// A part of an image has the pixels of the whole, and the file says which.
#[test]
fn a_part_is_the_same_pixels_as_in_the_whole_image() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("part.exr");
    let whole_part = Tile { x: 0, y: 0, width: SIZE[0], height: SIZE[1] };
    let parts = [
        Tile { x: 13, y: 7, width: 40, height: 35 },
        Tile { x: 0, y: 64, width: 97, height: 7 },
        Tile { x: 96, y: 0, width: 1, height: 1 },
        whole_part,
    ];
    let kinds = [LayerKind::Position, LayerKind::Cryptomatte, LayerKind::Variance];
    let (mut compared, mut files) = (0_u64, 0);
    for (camera, sampler) in [
        (Eye::Perspective, None),
        (Eye::Orthographic, Some(Sampler::Sobol)),
        (Eye::Perspective, Some(Sampler::Stratified)),
    ] {
        let sampling = sampler.map(|sampler| Sampling { samples: 5, sampler, ..Sampling::default() });
        let mut scene = kept(turned(Setup { eye: camera, size: SIZE, ..Setup::default() }), &kinds, sampling);
        for rasterises in [false, true] {
            let own = named(&mut scene, "camera");
            if rasterises {
                scene.entity_mut(own).insert(Rasterisation);
            }
            let rendered = |part: Option<Tile>, tile_side: u32| {
                let execution = Execution { part, tile_side, ..Execution::default() };
                render(&scene, &offer(), &execution, &()).expect("renders")
            };
            let whole = rendered(None, 32);
            for (part, tile_side) in parts.into_iter().zip([32, 16, 32, 8]) {
                let Rendered { film, attributes, .. } = rendered(Some(part), tile_side);
                assert_eq!(film.part(), part);
                write_exr_with(&film, None, &attributes, &path).expect("written");
                let (header, channels) = read(&path);
                let window = header.data_window();
                assert_eq!([window.position.x(), window.position.y()], [part.x as i32, part.y as i32]);
                assert_eq!([window.size.x(), window.size.y()], [part.width as usize, part.height as usize]);
                let display = header.shared_attributes.display_window;
                assert_eq!([display.position.x(), display.position.y()], [0, 0]);
                assert_eq!([display.size.x(), display.size.y()], SIZE.map(|side| side as usize));
                for (x, y) in (0..part.height).flat_map(|y| (0..part.width).map(move |x| (x, y))) {
                    let (in_part, in_whole) = (film.mean(x, y), whole.film.mean(part.x + x, part.y + y));
                    assert_eq!(in_part.map(f32::to_bits), in_whole.map(f32::to_bits), "{part:?} at {x},{y}");
                    let at = (y * part.width + x) as usize;
                    assert_eq!((channels["R"][at] as f32).to_bits(), in_whole[0].to_bits());
                    let (tile, row) = whole.film.place(part.x + x, part.y + y);
                    let position = whole.film.layers[tile].mean(LayerKind::Position, 0, row) as f32;
                    assert_eq!((channels["position.X"][at] as f32).to_bits(), position.to_bits());
                    compared += 1;
                }
                files += 1;
            }
        }
    }
    for part in [
        Tile { x: 0, y: 0, width: 0, height: 5 },
        Tile { x: 90, y: 0, width: 8, height: 5 },
        Tile { x: u32::MAX, y: 0, width: 2, height: 5 },
    ] {
        let scene = full(Setup { size: SIZE, ..Setup::default() });
        let execution = Execution { part: Some(part), ..Execution::default() };
        let Err(refused) = render(&scene, &offer(), &execution, &()) else { panic!("{part:?} is rendered") };
        assert!(refused.to_string().contains("must lie within the image, which has 97 × 71"), "{refused}");
    }
    eprintln!("parts: {compared} pixels of {files} files equal to those of the whole image; 3 refused");
}
