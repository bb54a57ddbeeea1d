//! Files of other people's exporters, compared with what their libraries say of them.

use glam::DVec3;
use pinhole::models::{ImageSource, LightKind, Model, Projection, TextureWrap, read_model};
use std::path::PathBuf;

/// Rounding of positions to f32, and to six digits in text.
const TOLERANCE: f64 = 2e-5;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/models")
}

fn read(name: &str) -> Model {
    let open = |other: &str| std::fs::read(folder().join(other)).map_err(|error| error.to_string());
    let bytes = open(name).expect("the file");
    read_model(name, &bytes, &open).expect(name)
}

/// The triangles of every instance, in the world.
fn world_triangles(model: &Model) -> Vec<[DVec3; 3]> {
    let mut triangles = Vec::new();
    for instance in &model.instances {
        let mesh = &model.meshes[instance.mesh];
        let corner = |index: u32| {
            let position = DVec3::from(mesh.positions[index as usize].map(f64::from));
            instance.world_from_object.transform_point3(position)
        };
        triangles.extend(mesh.triangles.iter().map(|triangle| triangle.map(corner)));
    }
    triangles
}

/// The least and the greatest corner, the area, and the volume with its sign.
fn measured(triangles: &[[DVec3; 3]]) -> [f64; 8] {
    let corners = || triangles.iter().flatten().copied();
    let min = corners().fold(DVec3::INFINITY, DVec3::min);
    let greatest = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
    let area: f64 = triangles.iter().map(|[a, b, c]| 0.5 * (b - a).cross(c - a).length()).sum();
    let volume: f64 = triangles.iter().map(|[a, b, c]| a.dot(b.cross(*c)) / 6.0).sum();
    [min.x, min.y, min.z, greatest.x, greatest.y, greatest.z, area, volume]
}

#[test]
fn files_of_exporters_hold_what_their_libraries_say() {
    let list = std::fs::read_to_string(folder().join("measured.txt")).expect("the list");
    let (mut files, mut worst) = (0, 0.0_f64);
    for line in list.lines() {
        let words: Vec<&str> = line.split(' ').collect();
        let number = |place: usize| words[place].parse::<f64>().expect(line);
        let name = words[0];
        let model = read(name);
        let triangles = world_triangles(&model);
        let found = measured(&triangles);
        let count = |place: usize| number(place) as usize;
        assert_eq!(model.instances.len(), count(1), "{name}: instances");
        assert_eq!(triangles.len(), count(2), "{name}: triangles");
        for (place, (found, what)) in found
            .iter()
            .zip(["least x", "least y", "least z", "greatest x", "greatest y", "greatest z", "area", "volume"])
            .enumerate()
        {
            let expected = number(3 + place);
            let error = (found - expected).abs() / expected.abs().max(1.0);
            worst = worst.max(error);
            assert!(error < TOLERANCE, "{name}: {what} is {found}, and the exporter's library says {expected}");
        }
        let mut materials: Vec<usize> = model.instances.iter().filter_map(|instance| instance.material).collect();
        // A file that has colours of its vertices, and no materials, gets one that shows them, and what has none in a glTF
        // file its default.
        materials
            .retain(|material| !["vertex colours", "default material"].contains(&&*model.materials[*material].name));
        materials.sort_unstable();
        materials.dedup();
        assert_eq!(materials.len(), count(11), "{name}: materials");
        assert_eq!(model.cameras.len(), count(12), "{name}: cameras");
        assert_eq!(model.lights.len(), count(13), "{name}: lights");
        eprintln!("{name}: {}", model.remarks.sentences().join(" "));
        files += 1;
    }
    eprintln!("{files} files of exporters, worst relative difference {worst:.1e}");
    assert!(files >= 14);
}

/// Where vertex normals are, they are on the side from which corners turn anticlockwise, as exporters mean them.
#[test]
fn normals_of_exporters_are_on_the_outer_side() {
    let mut with_normals = 0;
    for name in
        ["blender_scene.glb", "blender_scene.obj", "blender_polygons.ply", "trimesh_ball_little.ply", "open3d_cone.obj"]
    {
        for mesh in &read(name).meshes {
            let normals = mesh.normals.as_ref().expect(name);
            for triangle in &mesh.triangles {
                let [a, b, c] = triangle.map(|index| DVec3::from(mesh.positions[index as usize].map(f64::from)));
                let outward = (b - a).cross(c - a);
                for index in triangle {
                    let normal = DVec3::from(normals[*index as usize].map(f64::from));
                    assert!((normal.length() - 1.0).abs() < 1e-6, "{name}");
                    assert!(normal.dot(outward) > 0.0, "{name}");
                }
            }
            with_normals += 1;
        }
    }
    assert!(with_normals > 10);
}

#[test]
fn blender_s_scene_is_the_same_in_every_format() {
    for name in ["blender_scene.glb", "blender_scene.gltf", "blender_scene.obj"] {
        let model = read(name);
        let find = |own: &str| model.materials.iter().find(|material| &*material.name == own).expect(own).clone();
        let near = |a: f64, b: f64| (a - b).abs() < 1e-4;
        let red = find("red");
        assert!(near(red.base_colour[0], 0.8) && near(red.base_colour[2], 0.05), "{name}: {red:?}");
        assert!(near(red.metallic, 0.0) && near(red.roughness, 0.5), "{name}: {red:?}");
        let gold = find("gold");
        assert!(near(gold.metallic, 1.0) && near(gold.roughness, 0.2), "{name}: {gold:?}");
        let water = find("water");
        assert!(near(water.ior, 1.33), "{name}: {water:?}");
        if !name.ends_with("obj") {
            assert!(near(water.transmission, 1.0), "{name}: {water:?}");
        }
        let tiled = find("tiled");
        let texture = tiled.base_colour_texture.expect("a texture");
        let image = &model.images[texture.image];
        assert!(image.is_srgb && model.images.len() == 1);
        match &image.source {
            ImageSource::File(file) => assert_eq!(&**file, "blender_tiles.jpg"),
            ImageSource::Bytes(bytes) => assert!(bytes.starts_with(b"\xff\xd8\xff"), "a JPEG"),
        }
        let lit = find("lit");
        let strength = 7.0;
        assert!(near(lit.emission[0], strength) || name.ends_with("obj"), "{name}: {lit:?}");
        assert!(near(lit.emission[1] / lit.emission[0], 0.5), "{name}: {lit:?}");
        for camera in &model.cameras {
            assert!(matches!(camera.projection, Projection::Perspective { yfov, .. } if yfov > 0.1 && yfov < 2.0));
            // Blender's (0, −8, 3), with y up.
            assert!((camera.world_from_camera.translation - DVec3::new(0.0, 3.0, 8.0)).length() < 1e-5);
        }
        for light in &model.lights {
            let down = light.world_from_light.transform_vector3(DVec3::NEG_Z);
            match light.kind {
                LightKind::Directional => assert!(down.y < -0.5, "{name}: {light:?}"),
                LightKind::Point => {
                    assert!((light.world_from_light.translation.y - 4.0).abs() < 1e-5)
                }
                LightKind::Spot { inner, outer } => {
                    assert!(inner < outer && down.y < -0.9, "{name}: {light:?}")
                }
            }
        }
    }
}

#[test]
fn textures_are_upright_in_every_format() {
    // The box's uv were made from x and y, v up: here, y falls as v grows.
    for name in ["trimesh_box.obj", "trimesh_textured_scene.glb"] {
        let model = read(name);
        let instance = model.instances.iter().find(|own| own.material.is_some()).expect("the box");
        let mesh = &model.meshes[instance.mesh];
        let uvs = mesh.uvs.as_ref().expect("uvs");
        for (position, uv) in mesh.positions.iter().zip(uvs) {
            assert!((uv[0] - (position[0] + 0.5)).abs() < 1e-6, "{name}: {position:?} {uv:?}");
            assert!((uv[1] - (0.5 - 0.5 * position[1])).abs() < 1e-6, "{name}: {position:?} {uv:?}");
        }
    }
}

#[test]
fn samplers_and_cameras_of_pygltflib_are_read() {
    for name in ["pygltflib_strips.glb", "pygltflib_strips.gltf"] {
        let model = read(name);
        let texture = model.materials[0].base_colour_texture.expect("a texture");
        assert_eq!((texture.wrap, texture.nearest), ([TextureWrap::Clamp, TextureWrap::Mirror], true));
        assert!(matches!(&model.images[0].source, ImageSource::Bytes(bytes) if bytes.starts_with(b"\x89PNG")));
        assert_eq!(model.cameras[0].projection, Projection::Orthographic { xmag: 2.0, ymag: 1.0 });
        assert_eq!((&*model.cameras[0].name, &*model.instances[2].name), ("parallel", "lower"));
        let uvs = model.meshes[2].uvs.as_ref().expect("uvs");
        assert_eq!((uvs[0], uvs[8]), ([0.0; 2], [1.0; 2]));
    }
}
