//! Layers: what they hold, what the file says of itself, and that they cost nothing where nobody asks.

use super::*;
use exr::prelude::{AnyChannels, AttributeValue, FlatSamples, Layer, Text, read_first_flat_layer_from_file};
use glam::DVec3;
use pinhole::extract::{CameraAxes, eye};
use pinhole::film::{ENTITY_NAMES, FilmLayers, write_exr_with};
use pinhole::plan::{Census, Table, VectorRows};
use pinhole::render::Rendered;
use std::collections::BTreeMap;
use std::path::Path;

/// A file's channels by name, as f64.
fn channels(layer: &Layer<AnyChannels<FlatSamples>>) -> BTreeMap<String, Vec<f64>> {
    let numbers = |samples: &FlatSamples| match samples {
        FlatSamples::F32(values) => values.iter().map(|&value| f64::from(value)).collect(),
        FlatSamples::U32(values) => values.iter().map(|&value| f64::from(value)).collect(),
        FlatSamples::F16(_) => panic!("no half floats are written"),
    };
    layer.channel_data.list.iter().map(|channel| (channel.name.to_string(), numbers(&channel.sample_data))).collect()
}

fn written(scene: &World, path: &Path) -> (Film, Layer<AnyChannels<FlatSamples>>) {
    let Rendered { film, attributes, .. } = render(scene, &offer(), &Execution::default(), &()).expect("renders");
    write_exr_with(&film, None, &attributes, path).expect("written");
    let layer = read_first_flat_layer_from_file(path).expect("an EXR").layer_data;
    (film, layer)
}

/// A scene with one ray a pixel, where every layer can be computed again from another.
fn plain(eye: scenes::Eye) -> World {
    let mut scene = full(Setup { eye, size: SIZE, ..Setup::default() });
    let camera = named(&mut scene, "camera");
    scene.entity_mut(camera).insert(Layers::all());
    scene
}

#[test]
fn layers_agree_with_each_other_and_with_the_scene() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (mut hit, mut missed) = (0, 0);
    for camera in scenes::EYES {
        let mut scene = plain(camera);
        let (_, layer) = written(&scene, &folder.path().join("layers.exr"));
        let Some(AttributeValue::Text(names)) = layer.attributes.other.get(&Text::from(ENTITY_NAMES)) else {
            panic!("no names of entities")
        };
        let names: Vec<String> = names.to_string().split("; ").map(String::from).collect();
        let colours: Vec<DVec3> = (0..names.len())
            .map(|number| {
                let name = names[number].split('"').nth(1).expect("a name in quotes");
                assert!(names[number].starts_with(&format!("{number} ")), "{names:?}");
                let entity = named(&mut scene, name);
                let material = scene.get::<UsesMaterial>(entity).map_or(entity, |used| used.0);
                scene.get::<Matte>(material).expect("matte").colour.to_vec()
            })
            .collect();
        let channels = channels(&layer);
        let at = |name: &str, pixel: usize| channels[name][pixel];
        let three = |word: &str, letters: &str, pixel: usize| {
            let mut parts = letters.chars().map(|letter| at(&format!("{word}.{letter}"), pixel));
            DVec3::from_array(std::array::from_fn(|_| parts.next().expect("three letters")))
        };
        let census = &Census::of(&scene);
        let (eye, axes) = (eye(census).expect("an eye"), CameraAxes::extract(census).expect("axes").world_from_camera);
        for pixel in 0..(SIZE[0] * SIZE[1]) as usize {
            let (position, normal) = (three("position", "XYZ", pixel), three("normal", "XYZ", pixel));
            assert_eq!(at("samples.N", pixel), 1.0);
            assert_eq!(three("variance", "RGB", pixel), DVec3::ZERO, "one sample tells no variance");
            if at("coverage.A", pixel) == 0.0 {
                assert_eq!(at("entity.ID", pixel), f64::from(u32::MAX));
                for name in ["position.X", "normal.Y", "normal_camera.Z", "albedo.R", "depth_along_ray.Z", "uv.U"] {
                    assert_eq!(at(name, pixel), 0.0, "{name} where nothing is hit");
                }
                assert_eq!(at("Z", pixel), 1e10, "as Blender writes it");
                missed += 1;
                continue;
            }
            hit += 1;
            let entity = at("entity.ID", pixel) as usize;
            let albedo = three("albedo", "RGB", pixel);
            assert!((albedo - colours[entity]).length() < 1e-6, "{albedo} of {}", names[entity]);
            assert!((normal.length() - 1.0).abs() < 1e-6);
            assert!((axes.transpose() * normal - three("normal_camera", "XYZ", pixel)).length() < 1e-6);
            let shading_normal = three("shading_normal", "XYZ", pixel);
            let in_camera = three("shading_normal_camera", "XYZ", pixel);
            assert!(
                (axes.transpose() * shading_normal - in_camera).length() < 1e-6,
                "{in_camera} in the camera's axes"
            );
            if names[entity].contains("sail") {
                assert!((shading_normal.length() - 1.0).abs() < 1e-6 && shading_normal != normal);
            } else {
                assert_eq!(normal, shading_normal, "only the sail has normals of its own");
            }
            let from_eye = position - eye;
            let size = from_eye.length() + eye.length();
            let axis = -axes.z_axis.dot(from_eye);
            assert!((axis - at("Z", pixel)).abs() < 1e-6 * size, "{axis}");
            let ray = match camera {
                scenes::Eye::Perspective => from_eye.length(),
                scenes::Eye::Orthographic => axis,
            };
            assert!((ray - at("depth_along_ray.Z", pixel)).abs() < 1e-6 * size, "{ray}");
        }
    }
    assert!(hit > 1000 && missed > 100, "{hit} hit, {missed} missed");
    eprintln!("layers: {hit} pixels that hit something and {missed} that did not, every layer checked by another");
}

/// Where a camera takes samples, a layer is the mean over those that hit something.
#[test]
fn layers_are_means_over_the_samples_that_hit_something() {
    let layers = Layers { kinds: vec![LayerKind::Coverage, LayerKind::Position, LayerKind::Variance] };
    let scene = sampled(SIZE, seven(Sampler::Independent), layers);
    let mut in_progress =
        RenderInProgress::begin(&Census::of(&scene), &offer(), &Execution::default()).expect("begins");
    // Each sample by itself: what the sums were after it, less what they were before.
    let pixels = || (0..SIZE[0] * SIZE[1]).map(|pixel| [pixel % SIZE[0], pixel / SIZE[0]]);
    let sum_of = |film: &Film, [x, y]: [u32; 2]| {
        let (tile, row) = film.place(x, y);
        let tile = &film.tiles[tile];
        DVec3::from(tile.sum.at(row))
    };
    let mut before = vec![DVec3::ZERO; (SIZE[0] * SIZE[1]) as usize];
    let mut values: Vec<Vec<DVec3>> = vec![Vec::new(); before.len()];
    for step in 0..=steps_of(7) {
        in_progress.advance(step, &()).expect("goes on");
        for ((values, before), at) in values.iter_mut().zip(&mut before).zip(pixels()) {
            let sum = sum_of(&in_progress.film, at);
            if step >= 4 {
                values.push(sum - *before);
                *before = sum;
            }
        }
    }
    let mut noisy = 0;
    for (values, [x, y]) in values.iter().zip(pixels()) {
        let mean = values.iter().copied().sum::<DVec3>() / values.len() as f64;
        let squares: DVec3 = values.iter().map(|&value| (value - mean) * (value - mean)).sum();
        let (tile, row) = in_progress.film.place(x, y);
        let variance = DVec3::from_array(in_progress.film.variance_of_mean(tile, row));
        let expected = squares / 6.0 / 7.0;
        let slack = 1e-12 * expected.length() + 1e-24 * mean.length_squared();
        assert!((variance - expected).length() <= slack, "pixel {x},{y}: {variance} is not {expected}");
        noisy += usize::from(expected.length() > 1e-20);
    }
    assert!(noisy > 100, "{noisy} pixels show noise");
    let (tile, row) = in_progress.film.place(20, 18);
    let layers = &in_progress.film.layers[tile];
    assert_eq!(layers.taken[row], 7);
    let edge = (0..SIZE[0] * SIZE[1]).filter(|pixel| {
        let (tile, row) = in_progress.film.place(pixel % SIZE[0], pixel / SIZE[0]);
        let coverage = in_progress.film.layers[tile].mean(LayerKind::Coverage, 0, row);
        assert!((0.0..=1.0).contains(&coverage));
        coverage > 0.0 && coverage < 1.0
    });
    let edge = edge.count();
    assert!(edge > 20, "{edge} pixels at an edge");
    eprintln!(
        "layers: variance of 7 samples by hand the same in {noisy} pixels with noise; {edge} pixels are partly covered"
    );
}

#[test]
fn a_file_names_its_channels_as_readers_of_layers_expect() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("layers.exr");
    let (film, layer) = written(&plain(scenes::Eye::Perspective), &path);
    let mut names: Vec<String> = layer.channel_data.list.iter().map(|channel| channel.name.to_string()).collect();
    assert!(names.is_sorted(), "the format wants channels sorted");
    let mut expected: Vec<String> = ["R", "G", "B", "A", "Z"].map(String::from).to_vec();
    let others = LayerKind::ALL.into_iter().filter(|&kind| kind != LayerKind::DepthAlongAxis);
    expected.extend(others.flat_map(|kind| kind.channels()).map(|name| name.to_string()));
    expected.sort();
    names.sort();
    assert_eq!(names, expected);

    // The header by its bytes: magic number, version 2, one part of scan lines, and the list of channels.
    let bytes = fs::read(&path).expect("read");
    assert_eq!(bytes[..4], [0x76, 0x2f, 0x31, 0x01]);
    assert_eq!(bytes[4], 2, "version");
    assert_eq!(bytes[5] & 0b1_1010, 0, "one part, no tiles, nothing deep");
    let list = bytes.windows(16).position(|window| window == b"channels\0chlist\0").expect("a list of channels") + 16;
    let mut at = list + 4;
    let mut found = Vec::new();
    while bytes[at] != 0 {
        let end = at + bytes[at..].iter().position(|&byte| byte == 0).expect("a name ends");
        let name = String::from_utf8(bytes[at..end].to_vec()).expect("text");
        let kind = u32::from_le_bytes(bytes[end + 1..end + 5].try_into().expect("four bytes"));
        let counts = name == "entity.ID" || name == "samples.N";
        assert_eq!(kind, if counts { 0 } else { 2 }, "{name}: 0 is u32, 2 is f32");
        found.push(name);
        at = end + 1 + 16;
    }
    assert_eq!(found, expected);
    let first = &layer.channel_data.list.iter().find(|channel| channel.name == *"R").expect("red").sample_data;
    let FlatSamples::F32(red) = first else { panic!("R is not f32") };
    assert_eq!(red[0].to_bits(), film.mean(0, 0)[0].to_bits());
    eprintln!("header: {} channels, by name and type", found.len());
}

#[test]
fn what_nobody_asks_for_takes_no_byte() {
    let bare = sampled(SIZE, seven(Sampler::Sobol), ());
    let with = sampled(SIZE, seven(Sampler::Sobol), Layers::all());
    let [bare_film, with_film] = [&bare, &with].map(|scene| {
        let rendered = render(scene, &offer(), &Execution::default(), &()).expect("renders");
        let kept = |name: &str| rendered.plan.columns.iter().any(|column| column.name == name);
        let beside = ["layers", "moments", "uv"].map(kept);
        assert_eq!(beside, [!rendered.film.layers.is_empty(); 3]);
        rendered.film
    });
    assert!(bare_film.layers.is_empty() && bare_film.moments.is_empty());
    let held = |layers: &FilmLayers| 12 * layers.taken.len() + 8 * layers.sums.iter().flatten().count();
    let held: usize = with_film.layers.iter().map(held).sum();
    assert!(with_film.bytes() - bare_film.bytes() >= held, "{held} bytes of layers");
    FilmBits::of(&with_film).assert_is(&FilmBits::of(&bare_film), "layers change no light");
    let mut empty = World::new();
    let camera = (PerspectiveCamera::default(), Resolution { width: 8, height: 8 }, Layers::all());
    empty.spawn((Name::new("camera"), camera));
    let film = render(&empty, &offer(), &Execution::default(), &()).expect("renders").film;
    assert!(film.layers.iter().all(|layers| layers.sums.iter().flatten().all(|&sum| sum == 0.0)));
    assert!(film.layers.iter().all(|layers| layers.entity.iter().all(|&entity| entity == u32::MAX)));
}

#[test]
fn a_view_paints_as_before_and_layers_are_kept_beside_it() {
    let view = View { column: "surface".into() };
    let viewed = sampled(SIZE, seven(Sampler::Sobol), (view.clone(), Layers::all()));
    let plain = sampled(SIZE, seven(Sampler::Sobol), view);
    let whole = sampled(SIZE, seven(Sampler::Sobol), Layers::all());
    let [viewed, plain, whole] =
        [viewed, plain, whole].map(|scene| render(&scene, &offer(), &Execution::default(), &()).expect("renders").film);
    FilmBits::of(&viewed).assert_is(&FilmBits::of(&plain), "the view");
    assert!(viewed.layers == whole.layers, "layers beside a view");
}

/// Beside a view nothing is lit, so that each layer has to read for itself what it is made of.
#[test]
fn a_layer_alone_is_the_same_as_beside_all_others() {
    let film = |kinds: &[LayerKind]| {
        let layers = Layers { kinds: kinds.to_vec() };
        let scene = sampled(SIZE, seven(Sampler::Sobol), (View { column: "hit".into() }, layers));
        render(&scene, &offer(), &Execution::default(), &()).expect("renders").film
    };
    let all = film(&LayerKind::ALL);
    for kind in LayerKind::ALL.into_iter().filter(|kind| kind.is_mean()) {
        let mut sum = 0.0;
        for (alone, beside) in film(&[kind]).layers.iter().zip(&all.layers) {
            for row in 0..alone.hits.len() {
                for channel in 0..kind.channels().len() {
                    let value = alone.mean(kind, channel, row);
                    assert_eq!(value, beside.mean(kind, channel, row), "{kind:?}");
                    sum += value.abs();
                }
            }
        }
        assert!(sum > 0.0, "{kind:?} is 0 everywhere");
    }
}
