//! How a model becomes a scene: its camera, its lights, its glass, its instances.

use super::*;
use glam::{DAffine3, DVec3};
use pinhole::scene::Exposure;

/// A thing that glows dimly is no lamp; a ceiling that shines is one.
#[test]
fn a_sky_is_added_unless_the_model_is_lit() {
    let mut file = base();
    file["nodes"][2] = json!({});
    let skies = |emission: [f64; 3], strength: f64| {
        let mut file = file.clone();
        file["materials"][0]["emissiveFactor"] = json!(emission);
        set(&mut file, "/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength", json!(strength));
        let folder = tempfile::tempdir().expect("a folder");
        let mut world = world(&write(folder.path(), "m.gltf", &file)).expect("read");
        assert!(world.resource::<ModelNotes>().0.iter().any(|note| note.contains("sky")));
        world.query::<&Gradient>().iter(&world).count()
    };
    assert_eq!([skies([0.0; 3], 1.0), skies([0.05, 0.0, 0.0], 0.5), skies([1.0; 3], 10.0)], [1, 1, 0]);
}

/// Whatever the unit of the lights, and what shines beside them keeps its ratio to them.
#[test]
fn lights_and_surfaces_are_exposed_by_one_factor() {
    let of = |intensity: f64, emission: f64| {
        let file = with(&[
            ("/extensions/KHR_lights_punctual/lights/0/intensity", json!(intensity)),
            ("/materials/0/emissiveFactor", json!([1.0, 1.0, 1.0])),
            ("/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength", json!(emission)),
        ]);
        let folder = tempfile::tempdir().expect("a folder");
        let mut world = world(&write(folder.path(), "m.gltf", &file)).expect("read");
        assert!(world.resource::<ModelNotes>().0.iter().any(|note| note.contains("stops")));
        let light = world.query::<&PointLight>().iter(&world).next().expect("a light").intensity.to_array()[0];
        let shines = world.query::<&Emissive>().iter(&world).next().expect("emission").radiance.to_array()[0];
        let exposure = world.query::<&Exposure>().iter(&world).next().expect("an exposure").stops.exp2();
        [light * exposure, shines * exposure]
    };
    for scale in [1.0, 100.0, 683.0] {
        let [light, shines] = of(50.0 * scale, 2.0 * scale);
        let [other, other_shines] = of(50.0, 2.0);
        assert!((light / other - 1.0).abs() < 1e-12 && (shines / other_shines - 1.0).abs() < 1e-12);
        assert!((light / shines - 25.0).abs() < 1e-9, "{light} and {shines}");
    }
}

/// Metal stays metal whatever is said of its transmission; a window is a pane; what has an interior is filled.
#[test]
fn transmission_is_of_dielectrics_and_thin_unless_there_is_a_thickness() {
    let kinds = |metallic: f64, thickness: f64, closed: bool| {
        let mut file = with(&[
            ("/materials/0/extensions/KHR_materials_transmission/transmissionFactor", json!(0.8)),
            ("/materials/0/extensions/KHR_materials_volume/thicknessFactor", json!(thickness)),
            ("/materials/0/pbrMetallicRoughness/metallicFactor", json!(metallic)),
        ]);
        if closed {
            // The square from both sides encloses nothing, but every edge has its neighbour.
            let primitive = file["meshes"][0]["primitives"][0].clone();
            let corners: Vec<u8> =
                [0, 1, 2, 0, 2, 3, 0, 2, 1, 0, 3, 2].iter().flat_map(|index: &u16| index.to_le_bytes()).collect();
            set(&mut file, "/buffers/1", json!({ "byteLength": corners.len(), "uri": uri(&corners) }));
            set(&mut file, "/bufferViews/7", json!({ "buffer": 1, "byteLength": corners.len() }));
            let accessor = json!({ "bufferView": 7, "componentType": 5123, "count": 12, "type": "SCALAR" });
            set(&mut file, "/accessors/7", accessor);
            file["meshes"][0]["primitives"][0] = primitive;
            set(&mut file, "/meshes/0/primitives/0/indices", json!(7));
        }
        let folder = tempfile::tempdir().expect("a folder");
        let mut world = world(&write(folder.path(), "m.gltf", &file)).expect("read");
        [
            world.query::<&Principled>().iter(&world).count(),
            world.query::<&ThinGlass>().iter(&world).count(),
            world.query::<&RoughGlass>().iter(&world).count(),
        ]
    };
    assert_eq!(kinds(1.0, 0.0, false), [1, 0, 0], "metal");
    assert_eq!(kinds(0.0, 0.0, false), [0, 1, 0], "window");
    assert_eq!(kinds(0.0, 0.0, true), [0, 1, 0], "bubble");
    assert_eq!(kinds(0.0, 0.5, false), [0, 1, 0], "open mesh");
    assert_eq!(kinds(0.0, 0.5, true), [0, 0, 1], "solid");
}

/// As many instances as one likes of a mesh under matrices that shear have its triangles once.
#[test]
fn sheared_instances_share_their_mesh_and_stand_where_their_matrices_put_them() {
    let mut file = base();
    let matrices: Vec<[f64; 16]> = (1..20)
        .map(|number| {
            let by = f64::from(number) / 10.0;
            [1.0, 0.2, 0.0, 0.0, by, 1.0, 0.1, 0.0, 0.0, -by, 1.0, 0.0, by, 0.0, 0.0, 1.0]
        })
        .collect();
    for (number, matrix) in matrices.iter().enumerate() {
        set(&mut file, &format!("/nodes/{}", 3 + number), json!({ "mesh": 0, "matrix": matrix }));
    }
    let folder = tempfile::tempdir().expect("a folder");
    let mut world = world(&write(folder.path(), "m.gltf", &file)).expect("read");
    let parts: Vec<(Entity, MeshInstance)> =
        world.query::<(Entity, &MeshInstance)>().iter(&world).map(|(entity, mesh)| (entity, mesh.clone())).collect();
    assert_eq!(parts.len(), 20);
    assert!(parts.iter().all(|(_, mesh)| mesh.geometry.is(&parts[0].1.geometry)));
    let matrix_of = |mut entity: Entity| {
        let mut whole = DAffine3::IDENTITY;
        loop {
            let own = world.get::<Placement>(entity).copied().unwrap_or_default();
            whole = DAffine3::from_scale_rotation_translation(own.scale, own.orientation, own.position) * whole;
            match world.get::<ChildOf>(entity) {
                Some(parent) => entity = parent.parent(),
                None => return whole,
            }
        }
    };
    let found: Vec<DAffine3> = parts.iter().map(|(entity, _)| matrix_of(*entity)).collect();
    for matrix in matrices {
        let expected = glam::DMat4::from_cols_array(&matrix);
        let is_it = |own: &DAffine3| (glam::DMat4::from(*own) - expected).abs_diff_eq(glam::DMat4::ZERO, 1e-12);
        assert_eq!(found.iter().filter(|own| is_it(own)).count(), 1, "{matrix:?}");
    }
}

/// A vertex that no triangle uses moves no camera, and what is there in place of triangles is named.
#[test]
fn a_camera_is_fitted_to_what_is_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let fitted = |stray: &str| {
        let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{stray}f 1 2 3\n");
        let path = folder.path().join("m.obj");
        fs::write(&path, text).expect("written");
        let mut world = ModelScene::open(&path).expect("read").world();
        world.query::<&LookAt>().iter(&world).map(|look| look.target).collect::<Vec<DVec3>>()
    };
    assert_eq!(fitted(""), fitted("v 1e6 1e6 1e6\n"));
    let mut file = base();
    file["meshes"][0]["primitives"][0]["mode"] = json!(0);
    let error = ModelScene::open(&write(folder.path(), "p.gltf", &file)).expect_err("points").to_string();
    assert!(error.contains("points (1)") && error.contains("no triangles"), "{error}");
}

/// The picture has the proportions of the file's camera.
#[test]
fn a_camera_s_aspect_ratio_is_that_of_the_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let size = |aspect: Option<f64>| {
        let mut file = base();
        if let Some(aspect) = aspect {
            file["cameras"][0]["perspective"]["aspectRatio"] = json!(aspect);
        }
        let mut world = ModelScene::open(&write(folder.path(), "m.gltf", &file)).expect("read").world();
        let size = world.query::<&Resolution>().iter(&world).next().copied().expect("a resolution");
        [size.width, size.height]
    };
    assert_eq!([size(None), size(Some(16.0 / 9.0)), size(Some(1.0))], [[640, 360], [640, 360], [480, 480]]);
    assert_eq!(size(Some(0.25)), [240, 960]);
}

/// Lights are as the file says; the picture is exposed instead, by a number of stops that can be chosen.
#[test]
fn a_model_s_exposure_is_the_camera_s() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = write(folder.path(), "m.gltf", &base());
    let model = ModelScene::open(&path).expect("read");
    let mut world = model.world();
    let light = world.query::<&PointLight>().iter(&world).next().expect("a light").intensity;
    let shines = world.query::<&Emissive>().iter(&world).next().expect("emission").radiance;
    assert_eq!((light, shines), (Rgb::grey(50.0), Rgb::new(0.1, 0.05, 0.02)));
    let stops = |world: &mut World| world.query::<&Exposure>().iter(world).next().map(|own| own.stops);
    let ModelNotes(notes) = world.resource::<ModelNotes>();
    assert_eq!(notes.iter().filter(|note| note.contains("stops")).count(), 1, "{notes:?}");
    assert_eq!(stops(&mut world), Some(model.exposure.log2()));
    assert_eq!(stops(&mut model.clone().with_exposure(8.0).world()), Some(3.0));
    let mut plain = model.with_exposure(1.0).world();
    assert_eq!(stops(&mut plain), None);
    let ModelNotes(notes) = plain.resource::<ModelNotes>();
    assert!(!notes.iter().any(|note| note.contains("stops")), "{notes:?}");
}
