//! What rays are tested against, counted by a stage that is there only where a view asks for it.

use crate::scenes::{named, offer, one_world};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::bvh::TestCounts;
use pinhole::intersect::{BoxTests, PrimitiveTests, TraversalDepths};
use pinhole::models::TriangleMesh;
use pinhole::plan::{Census, Column, plan};
use pinhole::render::{inspect, render};
use pinhole::scene::*;
use pinhole::shapes::{
    ClosestHit, ClosestHits, PlacedMesh, PlacedSphere, RaySlices, Shape, hierarchy_of, keep_closest_counted,
};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::specimen::Specimen;
use pinhole_lab::measure::torus_knot::torus_knot;

/// Spheres and instances of one mesh, so many of each.
fn scene(count: usize) -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.0, 1.0, 4.0), ..LookAt::default() };
    world.spawn((Name::new("camera"), PerspectiveCamera::default(), look, Resolution { width: 48, height: 32 }));
    world.spawn((Name::new("ground"), Plane::default(), Placement::at(0.0, -1.5, 0.0), Matte::default()));
    let geometry = MeshGeometry::new(torus_knot(40, 8));
    let mut draws = Draws::new(3006, 0);
    for _ in 0..count {
        let mut point = || DVec3::from([(); 3].map(|()| draws.between(-1.0, 1.0)));
        let (at, other) = (point(), point());
        world.spawn((Sphere { radius: 0.04 }, Placement { position: at, ..Placement::default() }, Matte::default()));
        let place = Placement { position: other, scale: DVec3::splat(0.02), ..Placement::default() };
        world.spawn((MeshInstance { geometry: geometry.clone() }, place, Matte::default()));
    }
    world
}

fn viewed<C: Column>(mut scene: World) -> World {
    let camera = named(&mut scene, "camera");
    scene.entity_mut(camera).insert(View { column: C::NAME.into() });
    scene
}

/// The counts of all pixels.
fn counts<C: Column>(scene: World, numbers: fn(&C) -> &Vec<u32>) -> Vec<u32> {
    let inspected = inspect(&viewed::<C>(scene), &offer(), 32).expect("inspects");
    let column = |&tile: &Entity| inspected.world.get::<C>(tile).map(|column| numbers(column).clone());
    inspected.tiles.iter().filter_map(column).flatten().collect()
}

#[test]
fn without_a_view_nothing_is_counted() {
    let stage = "Count tests";
    let scene = scene(200);
    let without = plan(&Census::of(&scene), &offer()).expect("a plan");
    let row = without.rows.iter().find(|row| row.stage == stage).expect("on offer");
    assert_eq!(row.reason, "nothing that runs reads `boxes` or `tests` or `depth`");
    assert!(!row.kept && row.columns.is_empty() && !without.keeps::<BoxTests>());
    let viewed = viewed::<BoxTests>(scene);
    let with = plan(&Census::of(&viewed), &offer()).expect("a plan");
    let row = with.rows.iter().find(|row| row.stage == stage).expect("on offer");
    assert_eq!((row.kept, &row.columns[..]), (true, ["boxes"].as_slice()), "one column and no other");
    assert!(row.tables.contains(&"hierarchy of meshes") && row.tables.contains(&"planes"), "{:?}", row.tables);
    assert!(!row.tables.contains(&"disks"), "{:?}", row.tables);
    assert!(!with.stages.iter().any(|stage| stage.name.starts_with("Intersect ")), "a view of counts needs no hits");
}

/// Where there is no hierarchy every ray is tested against everything, and against no box.
#[test]
fn few_shapes_are_all_tested() {
    let few = || {
        let mut scene = World::new();
        scene.spawn((Name::new("camera"), PerspectiveCamera::default(), Resolution { width: 8, height: 8 }));
        for x in 0..7 {
            scene.spawn((Sphere::default(), Placement::at(f64::from(x), 0.0, -9.0), Matte::default()));
            scene.spawn((Disk::default(), Placement::at(f64::from(x), 1.0, -8.0), Matte::default()));
        }
        scene
    };
    assert_eq!(counts::<PrimitiveTests>(few(), |column| &column.primitives), [14; 64]);
    assert_eq!(counts::<BoxTests>(few(), |column| &column.boxes), [0; 64]);
    assert_eq!(counts::<TraversalDepths>(few(), |column| &column.depth), [0; 64]);
}

#[test]
fn many_shapes_are_not() {
    let boxes = counts::<BoxTests>(scene(300), |column| &column.boxes);
    let primitives = counts::<PrimitiveTests>(scene(300), |column| &column.primitives);
    let depths = counts::<TraversalDepths>(scene(300), |column| &column.depth);
    let max = |counts: &[u32]| counts.iter().copied().max().unwrap_or(0);
    eprintln!("600 shapes: at most {} boxes, {} primitives, {} nodes", max(&boxes), max(&primitives), max(&depths));
    // The plane is tested by every ray; an instance is no primitive, and each has 640 triangles.
    assert!(primitives.iter().all(|&count| (1..300).contains(&count)) && max(&primitives) > 8);
    assert!(boxes.iter().all(|&count| count > 0 && count < 900));
    // Two levels over the shapes at least, and one in an instance.
    assert!(max(&depths) >= 3 && max(&depths) < 20);
    assert_eq!(boxes.len(), 48 * 32);
}

/// The counted traversal is that of the render: it finds the same hits to the last bit.
#[test]
fn the_counted_traversal_finds_the_same_hits() {
    let mut draws = Draws::new(3007, 0);
    let spheres: Vec<PlacedSphere> = (0..1000)
        .map(|_| PlacedSphere { centre: DVec3::from([(); 3].map(|()| draws.between(-3.0, 3.0))), radius: 0.1 })
        .collect();
    let numbers: Vec<u32> = (0..1000).collect();
    let bvh = hierarchy_of(&spheres).expect("bounded");
    let instance = MeshInstance { geometry: MeshGeometry::new(torus_knot(120, 20)) };
    let mesh = Specimen::<PlacedMesh>::of(instance, Placement::default()).expect("a mesh").shape;
    let (rays, mut hits) = (20_000, 0);
    for _ in 0..rays {
        let origin = DVec3::from([(); 3].map(|()| draws.between(-4.0, 4.0)));
        let (ray, mut tests) = ([origin, draws.unit_vector()], TestCounts::default());
        let shapes = (&spheres[..], &numbers[..], Some(&bvh));
        let found = keep_closest_counted(shapes, ray, ClosestHit::NONE, &mut tests);
        let t = spheres.iter().map(|sphere| sphere.t(ray[0], ray[1])).fold(f64::INFINITY, f64::min);
        assert_eq!(found.t.to_bits(), t.to_bits(), "{ray:?}");
        let of_mesh =
            keep_closest_counted((std::slice::from_ref(&mesh), &[0], None), ray, ClosestHit::NONE, &mut tests);
        let closest = mesh.closest(ray[0], ray[1]);
        assert_eq!((of_mesh.t.to_bits(), of_mesh.primitive), (closest.t.to_bits(), closest.primitive), "{ray:?}");
        hits += u32::from(t < f64::INFINITY) + u32::from(closest.t < f64::INFINITY);
    }
    eprintln!("counted: {rays} rays twice, {hits} hits, 0 differ");
    assert!(hits > rays / 4);
}

#[test]
fn a_view_of_counts_is_a_picture() {
    let film = render(&viewed::<TraversalDepths>(scene(300)), &offer(), &one_world(), &()).expect("renders").film;
    let colours = (0..32).flat_map(|y| (0..48).map(move |x| [x, y])).map(|[x, y]| film.mean(x, y).map(f32::to_bits));
    assert!(colours.collect::<std::collections::BTreeSet<_>>().len() > 2);
}

/// Rays of a camera in tiles, and random ones, as columns hold them.
fn columns(rays: usize, coherent: bool) -> [Vec<f32>; 6] {
    let mut draws = Draws::new(3103, u64::from(coherent));
    let mut columns: [Vec<f32>; 6] = Default::default();
    for row in 0..rays {
        let (packet, place) = (row / 64, row % 64);
        let [x, y] = [8 * (packet % 16) + place % 8, 8 * (packet / 16) + place / 8].map(|at| at as f64 / 64.0 - 1.0);
        let [origin, direction] = if coherent {
            [DVec3::new(0.1, 0.2, 8.0), DVec3::new(4.0 * x, 4.0 * y, -8.0).normalize()]
        } else {
            [DVec3::from([(); 3].map(|()| draws.between(-3.0, 3.0))), draws.unit_vector()]
        };
        for axis in 0..3 {
            columns[axis].push(origin[axis] as f32);
            columns[axis + 3].push(direction[axis] as f32);
        }
    }
    columns
}

/// A column goes through the kernel that is compiled for this machine's instructions, in packets, in packets that are
/// given up since their triangles are too small, and in lockstep; a single ray asked from here goes through the same source
/// compiled for the plainest machine of its kind.
#[test]
fn every_instruction_set_and_every_packet_gives_the_same_bits() {
    const TILE: usize = 1024;
    let (rays, mut tried, mut hits) = (1 << 14, 0, 0);
    for (along, around) in [(400, 40), (1000, 150)] {
        let instance = MeshInstance { geometry: MeshGeometry::new(torus_knot(along, around)) };
        let mesh = Specimen::<PlacedMesh>::of(instance, Placement::default()).expect("a mesh").shape;
        for (coherent, any) in [(true, false), (true, true), (false, false), (false, true)] {
            let columns = columns(rays, coherent);
            for start in (0..rays).step_by(TILE) {
                let [ox, oy, oz, dx, dy, dz] = columns.each_ref().map(|column| &column[start..start + TILE]);
                let slices = RaySlices { origin: [ox, oy, oz], direction: [dx, dy, dz] };
                let (mut t, mut shape, mut primitive) =
                    (vec![f64::INFINITY; TILE], vec![u32::MAX; TILE], vec![u32::MAX; TILE]);
                let found = ClosestHits { t: &mut t, shape: &mut shape, primitive: Some(&mut primitive), any };
                PlacedMesh::keep_closest((std::slice::from_ref(&mesh), &()), &[0], slices, found);
                for row in 0..TILE {
                    let [origin, direction] = slices.ray(row);
                    let alone = mesh.closest(origin, direction);
                    if any {
                        assert_eq!(
                            alone.t < f64::INFINITY,
                            t[row] < f64::INFINITY,
                            "ray {row}: whether there is a hit"
                        );
                    } else {
                        assert_eq!(
                            (alone.t.to_bits(), alone.primitive),
                            (t[row].to_bits(), primitive[row]),
                            "ray {row}"
                        );
                    }
                    (tried, hits) = (tried + 1, hits + u32::from(alone.t < f64::INFINITY));
                }
            }
        }
    }
    eprintln!("instruction sets: {tried} rays, {hits} hits, 0 differ");
    assert!(hits as usize > tried / 4);
}

/// Triangles of 121 sizes, each twice the next, in boxes that all rays enter and most hit nothing in: a ray puts off more
/// than its stack in lockstep has room for, and goes on alone.
#[test]
fn a_ray_that_puts_off_more_than_lockstep_has_room_for_finds_the_same() {
    let mut mesh = TriangleMesh::default();
    for exponent in -60..=60 {
        for part in 0..8 {
            // The last ones cover the corner of their box through which the rays go, the others the one across.
            let far = if exponent == 60 { 2.0 } else { 1.0 };
            let height = 1.0 + 0.01 * part as f32;
            let corners = [[far, far, height], [2.0, 1.0, height], [1.0, 2.0, height + 0.1]];
            let first = mesh.positions.len() as u32;
            let scale = libm::ldexpf(1.0, exponent);
            mesh.positions.extend(corners.map(|corner| corner.map(|part| part * scale)));
            mesh.triangles.push([first, first + 1, first + 2]);
        }
    }
    let instance = MeshInstance { geometry: MeshGeometry::new(mesh) };
    let mesh = Specimen::<PlacedMesh>::of(instance, Placement::default()).expect("a mesh").shape;
    let mut draws = Draws::new(3104, 0);
    let mut columns: [Vec<f32>; 6] = [const { Vec::new() }; 6];
    for row in 0..256 {
        let mut near = |at: f64| at + draws.between(-0.05, 0.05);
        let towards = DVec3::new(near(1.75), near(1.75), near(1.08)).normalize();
        // Every second one goes the other way, so that no packet is made of them.
        let direction = if row % 2 == 0 { towards } else { -towards };
        for axis in 0..3 {
            columns[axis].push(0.0);
            columns[axis + 3].push(direction[axis] as f32);
        }
    }
    let [ox, oy, oz, dx, dy, dz] = columns.each_ref().map(Vec::as_slice);
    let rays = RaySlices { origin: [ox, oy, oz], direction: [dx, dy, dz] };
    let mut hits = 0;
    for any in [false, true] {
        let (mut t, mut shape, mut primitive) = (vec![f64::INFINITY; 256], vec![u32::MAX; 256], vec![u32::MAX; 256]);
        let found = ClosestHits { t: &mut t, shape: &mut shape, primitive: Some(&mut primitive), any };
        PlacedMesh::keep_closest((std::slice::from_ref(&mesh), &()), &[0], rays, found);
        for row in 0..256 {
            let [origin, direction] = rays.ray(row);
            let all = mesh.closest_of_all(origin, direction);
            let same = (all.t.to_bits(), all.primitive) == (t[row].to_bits(), primitive[row]);
            assert!(same || any && all.t.is_finite() == t[row].is_finite(), "ray {row}, any hit: {any}");
            hits += u32::from(all.t.is_finite());
        }
    }
    eprintln!("lockstep and alone: 512 rays, {hits} hits, 0 differ");
    assert_eq!(hits, 256);
}
