//! Meshes in scenes: the same pictures as their triangles one by one, shared geometry, model files and what is said of
//! them.

#[path = "models/exporters.rs"]
mod exporters;

#[path = "../chapters/28_meshes/seashell.rs"]
mod seashell;

use crate::scenes::{named, offer, one_world};
use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use pinhole::extract::{MeshTable, validate};
use pinhole::film::Film;
use pinhole::intersect::Hits;
use pinhole::plan::{Census, Table};
use pinhole::rays::WorldRays;
use pinhole::render::{inspect, render};
use pinhole::scene::*;
use pinhole::shade::{EmissionFactors, MetallicRoughness};
use pinhole::shapes::{PlacedMesh, Shape};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::extremes::{Group, try_group};
use pinhole_lab::measure::torus_knot::torus_knot;
use pinhole_lab::naive::mesh::{closest_hit, vertex_normals};
use seashell::{MOON, TOWER, coiled};
use std::fs;
use std::path::Path;

/// What `cargo run --profile bench -- extremes hierarchy --rays 1000000` tries in full.
#[test]
fn a_hierarchy_finds_what_testing_everything_finds_and_no_ray_leaks() {
    const RAYS: u64 = 2048;
    let cases = try_group(Group::Hierarchy, "", RAYS, &());
    for case in &cases {
        eprint!("{case}");
        assert!(case.held(), "{case}");
        assert!(case.rays == RAYS && case.hits > RAYS / 10, "{}: {} of {}", case.name, case.hits, case.rays);
    }
}

fn lit() -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.0, 5.0, 8.0), target: DVec3::new(0.0, -0.3, 0.0), ..LookAt::default() };
    let camera = (Name::new("camera"), PerspectiveCamera::default(), look, Resolution { width: 64, height: 48 });
    world.spawn(camera);
    world.spawn((PointLight { intensity: Rgb::grey(900.0), ..PointLight::default() }, Placement::at(4.0, 9.0, 6.0)));
    world
}

fn film(scene: &World) -> Film {
    render(scene, &offer(), &one_world(), &()).expect("renders").film
}

/// The greatest difference of a pixel of two films.
fn apart(one: &Film, other: &Film) -> f64 {
    let pixels = (0..one.height).flat_map(|y| (0..one.width).map(move |x| (x, y)));
    let part = |(x, y)| (0..3).map(move |part| (one.mean(x, y)[part] - other.mean(x, y)[part]).abs());
    pixels.flat_map(part).map(f64::from).fold(0.0, f64::max)
}

fn turned() -> Placement {
    let orientation = DQuat::from_xyzw(0.1, 0.3, -0.2, 0.9).normalize();
    Placement { position: DVec3::new(0.3, 0.2, -0.4), orientation, scale: DVec3::new(1.0, 0.8, 1.1) }
}

/// A mesh in its object space, and the same triangles, each an entity in render space.
#[test]
fn a_mesh_looks_like_its_triangles() {
    let knot = torus_knot(60, 12);
    let (mut together, mut apart_from) = (lit(), lit());
    let matte = Matte { colour: Rgb::new(0.6, 0.5, 0.4) };
    for triangle in 0..knot.triangles.len() {
        let vertices = knot.corners(triangle).map(|corner| DVec3::from(corner.map(f64::from)));
        apart_from.spawn((Triangle { vertices, ..Triangle::default() }, turned(), matte));
    }
    together.spawn((MeshInstance { geometry: MeshGeometry::new(knot) }, turned(), matte));
    let worst = apart(&film(&together), &film(&apart_from));
    eprintln!("a mesh of 1440 triangles and as many entities: pixels differ by {worst:.1e} at most");
    assert!(worst < 1e-5, "{worst}");
}

#[test]
fn instances_have_one_geometry_and_look_like_copies() {
    let geometry = MeshGeometry::new(torus_knot(60, 12));
    let scene = |copied: bool| {
        let mut scene = lit();
        for x in [-1.5, 1.5] {
            let own = if copied { MeshGeometry::new((*geometry).clone()) } else { geometry.clone() };
            let placement = Placement { position: DVec3::X * x, scale: DVec3::splat(0.4), ..turned() };
            scene.spawn((MeshInstance { geometry: own }, placement, Matte::default()));
        }
        scene
    };
    let shared = scene(false);
    let meshes = Census::of(&shared).table::<MeshTable>().expect("meshes");
    assert!(meshes.row[0].geometry.is(&meshes.row[1].geometry), "the geometry is there once");
    assert_eq!(apart(&film(&shared), &film(&scene(true))), 0.0);
}

/// A square of two triangles as a PLY, with one more that has no area.
const SQUARE: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
    element face 3\nproperty list uchar int vertex_indices\nend_header\n\
    -1 0 -1\n-1 0 1\n1 0 1\n1 0 -1\n3 0 1 2\n3 0 2 3\n3 1 1 2\n";

const CAMERA: &str = "(perspective_camera: (), look_at: (eye: (0, 5, 8)), resolution: (width: 8, height: 6))";

fn opened(folder: &Path, entities: &str) -> World {
    let path = folder.join("scene.ron");
    fs::write(&path, format!("[{CAMERA}, {entities}]")).expect("written");
    SceneFile::open(&path).expect("a scene file").world()
}

#[test]
fn a_scene_file_places_meshes_and_gives_them_materials() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("square.ply"), SQUARE).expect("written");
    let mesh = "mesh: (file: \"square.ply\")";
    let mut scene = opened(
        folder.path(),
        &format!("(name: \"own\", {mesh}, mirror: ()), (name: \"file's\", {mesh}, placement: (position: (3, 0, 0)))"),
    );
    validate(&Census::of(&scene)).expect("accepted");
    let [own, of_file] = ["own", "file's"].map(|name| named(&mut scene, name));
    assert!(scene.get::<Children>(own).is_none(), "one mesh of its own material is on the entity itself");
    let parts: Vec<Entity> = scene.get::<Children>(of_file).expect("parts").iter().collect();
    assert_eq!(parts.len(), 1);
    let used = scene.get::<UsesMaterial>(parts[0]).expect("a material").0;
    assert!(scene.get::<Principled>(used).is_some(), "the file's material");
    let [one, other] = [own, parts[0]].map(|mesh| scene.get::<MeshInstance>(mesh).expect("a mesh").geometry.clone());
    assert!(one.is(&other) && one.triangles.len() == 2, "the file is read once");
    let ModelNotes(notes) = scene.resource::<ModelNotes>();
    assert!(notes.iter().any(|note| note.contains("square.ply") && note.contains("without an area")), "{notes:?}");
    let text = scene_text(&scene).expect("can be written");
    assert!(text.matches("square.ply").count() == 2 && !text.contains("part 1"), "{text}");
    film(&scene);
}

/// A mesh that only emits has no other material: not the file's either.
#[test]
fn a_mesh_of_a_file_shines_by_its_own_emission() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("square.ply"), SQUARE).expect("written");
    let scene = |emits: &str| {
        let placed = "mesh: (file: \"square.ply\"), placement: (position: (0, 1, 0))";
        opened(
            folder.path(),
            &format!("(name: \"lamp\", {placed}, emissive: (radiance: ({emits}))), (plane: (), matte: ())"),
        )
    };
    let mut shining = scene("4, 3, 2");
    let lamp = named(&mut shining, "lamp");
    assert!(shining.get::<MeshInstance>(lamp).is_some() && shining.get::<Children>(lamp).is_none());
    let [bright, dark] = [film(&shining), film(&scene("0, 0, 0"))];
    let light =
        |film: &Film| (0..8).flat_map(|x| (0..6).map(move |y| [x, y])).map(|[x, y]| film.mean(x, y)[0]).sum::<f32>();
    assert!(light(&bright) > 1.0 && light(&dark) == 0.0, "{} and {}", light(&bright), light(&dark));
}

#[test]
fn what_a_mesh_cannot_be_is_one_sentence() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("square.ply"), SQUARE).expect("written");
    fs::write(folder.path().join("broken.ply"), &SQUARE[..150]).expect("written");
    fs::write(folder.path().join("broken.obj"), "v 0 0 0\nf 1 2 3\n").expect("written");
    fs::write(folder.path().join("square.stl"), SQUARE).expect("written");
    let said = |entities: &str| {
        let scene = opened(folder.path(), entities);
        let error = validate(&Census::of(&scene)).expect_err(entities).to_string();
        eprintln!("{error}");
        assert!(!error.contains('\n') && !error.contains(". "), "{error}");
        error
    };
    let missing = said("(name: \"m\", mesh: (file: \"none.ply\"))");
    assert!(missing.contains("mesh \"m\"") && missing.contains("none.ply"), "{missing}");
    assert!(said("(name: \"m\", mesh: (file: \"broken.ply\"))").contains("broken.ply"));
    assert!(said("(name: \"m\", mesh: (file: \"broken.obj\"))").contains("broken.obj"));
    assert!(said("(name: \"m\", mesh: (file: \"square.stl\"))").contains(".ply"));
    assert!(said("(name: \"m\", mesh: (file: \"square.ply\"), glass: ())").contains("glass"), "an open mesh of glass");
    let mut scene = World::new();
    scene.spawn(PerspectiveCamera::default());
    scene.spawn(Mesh { file: "square.ply".into(), ..Mesh::default() });
    let error = validate(&Census::of(&scene)).expect_err("nothing has read it").to_string();
    assert!(error.contains("load_meshes"), "{error}");
}

/// The fingerprint of a scene is that of what its files hold.
#[test]
fn another_mesh_is_another_film() {
    let folder = tempfile::tempdir().expect("a folder");
    let print = |text: &str| {
        fs::write(folder.path().join("square.ply"), text).expect("written");
        fingerprint(&opened(folder.path(), "(mesh: (file: \"square.ply\"))"))
    };
    let (one, again, other) = (print(SQUARE), print(SQUARE), print(&SQUARE.replace("1 0 1\n1", "2 0 1\n1")));
    assert!(one == again && one != other);
}

/// The book's model: closed, its triangles anticlockwise from outside, its normals those of its faces on the whole.
#[test]
fn shells_are_closed_and_their_normals_point_outward() {
    for (coil, along, around) in
        [(&TOWER, 300, 16), (&TOWER, 64, 12), (&TOWER, 30, 5), (&MOON, 100, 24), (&MOON, 20, 3)]
    {
        let geometry = coiled(coil, along, around);
        assert!(PlacedMesh::has_inside(&MeshInstance { geometry: geometry.clone() }), "{along} x {around}");
        let corners = |triangle: usize| geometry.corners(triangle).map(|at| DVec3::from(at.map(f64::from)));
        let faces = (0..geometry.triangles.len()).map(corners);
        let volume: f64 = faces.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum();
        assert!(volume > 0.1, "{along} x {around}: {volume}");
        let normals = geometry.normals.as_ref().expect("normals");
        let of_faces = vertex_normals(&geometry);
        let apart =
            normals.iter().zip(&of_faces).filter(|(own, face)| face.dot(DVec3::from(own.map(f64::from))) <= 0.0);
        let apart = apart.count();
        eprintln!("{along} x {around}: volume {volume:.3}, {apart} of {} normals on the other side", normals.len());
        // Where the tube comes close to the axis, coarse faces lie far from the surface.
        assert!(around < 12 || apart * 12 < normals.len(), "{along} x {around}: {apart} of {}", normals.len());
    }
}

/// The textbook's loop over all triangles, and pinhole's hierarchy.
#[test]
fn brute_force_finds_the_same_hits_on_a_shell() {
    const RAYS: u64 = 4000;
    let mut scene = lit();
    let geometry = coiled(&TOWER, 80, 10);
    scene.spawn((MeshInstance { geometry: geometry.clone() }, turned()));
    let table = MeshTable::extract(&Census::of(&scene)).expect("a mesh");
    let mesh = &table.row[0];
    let (mut hits, mut wrong) = (0, 0);
    for index in 0..RAYS {
        let mut draws = Draws::new(2802, index);
        let target = mesh.position + draws.unit_vector() * draws.unit();
        let origin = target + 4.0 * draws.unit_vector();
        let direction = (target - origin).normalize();
        let own = [mesh.object_from_world * (origin - mesh.position), mesh.object_from_world * direction];
        let expected = closest_hit(own[0], own[1], &geometry);
        let found = mesh.closest(origin, direction);
        hits += u64::from(expected.is_some());
        wrong += u64::from(match expected {
            None => found.t < f64::INFINITY,
            Some((t, _)) => (found.t - t).abs() > 1e-9 * t,
        });
    }
    eprintln!("{RAYS} rays at a shell of {} triangles: {hits} hit, {wrong} differ", geometry.triangles.len());
    assert_eq!(wrong, 0);
    assert!(hits > RAYS / 5, "{hits}");
}

/// A tile whose numbers change from square to square, as its exporter was told; the points are those of the world.
#[test]
fn a_file_s_maps_give_points_what_its_exporter_was_told() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/models/trimesh_worn_tile.glb");
    let (mut scene, eye) = (lit(), DVec3::new(0.3, 5.0, 3.0));
    let camera = named(&mut scene, "camera");
    // Pixels are much smaller than texels.
    let near = PerspectiveCamera { fov: Degrees(25.0), ..PerspectiveCamera::default() };
    let look = LookAt { eye, target: DVec3::ZERO, ..LookAt::default() };
    let size = Resolution { width: 128, height: 128 };
    scene.entity_mut(camera).insert((near, look, size, Integrator::RayCasting));
    scene.spawn(Mesh { file: file.to_string_lossy().into_owned(), ..Mesh::default() });
    load_meshes(&mut scene);
    let ModelNotes(notes) = scene.resource::<ModelNotes>();
    assert!(!notes.iter().any(|note| note.contains("left out")), "{notes:?}");
    let linear = |byte: u8| {
        let c = f64::from(byte) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { libm::pow((c + 0.055) / 1.055, 2.4) }
    };
    let inspection = inspect(&scene, &offer(), 128).expect("inspects");
    let tile = inspection.world.entity(inspection.tiles[0]);
    let (rays, hits) = (tile.get::<WorldRays>().expect("rays"), tile.get::<Hits>().expect("hits"));
    let found = tile.get::<MetallicRoughness>().expect("metallic and roughness");
    let (factors, radiance) = (tile.get::<EmissionFactors>().expect("factors"), [1.0, 0.5, 0.25]);
    let used = scene.query::<&Emissive>().iter(&scene).next().expect("the material emits").radiance.to_array();
    assert_eq!(used, radiance);
    let mut tried = [0; 2];
    for row in (0..hits.t.len()).filter(|&row| hits.t[row].is_finite()) {
        let at = eye + rays.point_at(row, hits.t[row]);
        // In squares, of which there are four along each side; the far left one is the image's first.
        let [across, down] = [at.x, at.z].map(|part| 2.0 * (part + 1.0));
        let inside = |place: f64| (0.35..0.65).contains(&(place - place.floor()));
        if !(inside(across) && inside(down)) {
            continue;
        }
        let odd = (across as u32 + down as u32) % 2 == 1;
        // The image's first square is of the second colours that the exporter was told.
        let (green, blue, light) = if odd { (51, 255, [0; 3]) } else { (204, 0, [188, 90, 20]) };
        let [metallic, roughness] = found.get(row);
        assert!((metallic - 0.8 * f64::from(blue) / 255.0).abs() < 1e-6, "{at}: {metallic}");
        assert!((roughness - 0.9 * f64::from(green) / 255.0).abs() < 1e-6, "{at}: {roughness}");
        let factor = factors.times(row, [1.0; 3]);
        let off = (0..3).map(|part| (f64::from(factor[part]) - linear(light[part])).abs()).fold(0.0, f64::max);
        assert!(off < 1e-6, "{at}: {factor:?}");
        tried[usize::from(odd)] += 1;
    }
    eprintln!("a tile of an exporter: {tried:?} points on its squares have their numbers");
    assert!(tried.iter().all(|tried| *tried > 100), "{tried:?}");
}
