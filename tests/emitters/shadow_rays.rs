//! Rays to lights with an area: a light never stands in its own way, and what stands before it always does.

use bevy_ecs::prelude::*;
use bevy_ecs::system::RunSystemOnce;
use glam::{DQuat, DVec3, Vec3};
use pinhole::extract::{
    AreaLightTable, CuboidTable, DiskTable, MeshTable, PlaneTable, RectangleTable, SamplingTable, SphereTable,
    TriangleTable,
};
use pinhole::intersect::{MaterialRows, NO_SHAPE, Surface, Surfaces, intersect_shapes};
use pinhole::lights::Receiver;
use pinhole::models::TriangleMesh;
use pinhole::plan::{Census, Column, Shared, Table};
use pinhole::rays::{SampleNumber, Tile};
use pinhole::scene::*;
use pinhole::shade::{LightPdfs, ShadowHits, ShadowRays, area_light_pdf, sample_area_lights, start_shadows};
use pinhole::shapes::emitter::EmittingTriangle;
use pinhole::shapes::{
    Emitter, PlacedDisk, PlacedMesh, PlacedPlane, PlacedRectangle, PlacedSphere, Slabs, TriangleRow, offset_bound,
    point_on,
};
use pinhole_lab::measure::draws::Draws;

/// Surfaces at once.
const ROWS: u32 = 1024;

fn insert<T: Table>(world: &mut World, scene: &World) {
    world.insert_resource(Shared::new(T::extract(&Census::of(scene)).expect("a table")));
}

/// A world with the stages' tables and one tile.
fn tile_world(scene: &World) -> (World, Entity) {
    let mut world = World::new();
    insert::<AreaLightTable>(&mut world, scene);
    insert::<SamplingTable>(&mut world, scene);
    insert::<SphereTable>(&mut world, scene);
    insert::<DiskTable>(&mut world, scene);
    insert::<RectangleTable>(&mut world, scene);
    insert::<CuboidTable>(&mut world, scene);
    insert::<TriangleTable>(&mut world, scene);
    insert::<PlaneTable>(&mut world, scene);
    insert::<MeshTable>(&mut world, scene);
    let columns = (
        Surfaces::default(),
        MaterialRows::default(),
        ShadowRays::default(),
        LightPdfs::default(),
        ShadowHits::default(),
    );
    let tile = world.spawn((Tile { x: 0, y: 0, width: 32, height: 32 }, SampleNumber(0), columns)).id();
    (world, tile)
}

/// Samples lights from these surfaces and traces the shadow rays: how many there are, and what each hit.
fn traced(world: &mut World, tile: Entity, surfaces: &[Surface], sample: u32) -> (usize, Vec<u32>) {
    let mut entity = world.entity_mut(tile);
    entity.insert(SampleNumber(sample));
    {
        let mut columns = entity.get_mut::<Surfaces>().expect("surfaces");
        columns.slices_mut(surfaces.len());
        surfaces.iter().enumerate().for_each(|(row, &surface)| columns.set(row, surface));
    }
    entity.get_mut::<MaterialRows>().expect("rows").row = (0..surfaces.len() as u32).collect();
    entity.get_mut::<ShadowRays>().expect("rays").clear();
    entity.get_mut::<LightPdfs>().expect("pdfs").clear();
    world.run_system_once(sample_area_lights).expect("runs");
    world.run_system_once(start_shadows).expect("runs");
    world.run_system_once(intersect_shapes::<PlacedSphere, ShadowRays, ShadowHits>).expect("runs");
    world.run_system_once(intersect_shapes::<PlacedDisk, ShadowRays, ShadowHits>).expect("runs");
    world.run_system_once(intersect_shapes::<PlacedRectangle, ShadowRays, ShadowHits>).expect("runs");
    world.run_system_once(intersect_shapes::<Slabs, ShadowRays, ShadowHits>).expect("runs");
    world.run_system_once(intersect_shapes::<TriangleRow, ShadowRays, ShadowHits>).expect("runs");
    world.run_system_once(intersect_shapes::<PlacedPlane, ShadowRays, ShadowHits>).expect("runs");
    world.run_system_once(intersect_shapes::<PlacedMesh, ShadowRays, ShadowHits>).expect("runs");
    let entity = world.entity(tile);
    let rays = entity.get::<ShadowRays>().expect("rays");
    assert_eq!(entity.get::<LightPdfs>().expect("pdfs").rows(), rays.rows());
    (rays.rows(), entity.get::<ShadowHits>().expect("hits").shape.clone())
}

type Lamp = fn(&mut World, Placement, f64);

/// Every kind of light, of about this size.
const LAMPS: [(&str, Lamp); 9] = [
    ("sphere", |w, at, size| {
        w.spawn((Sphere { radius: size }, at, Emissive::default()));
    }),
    ("disk", |w, at, size| {
        w.spawn((Disk { radius: size }, at, Emissive::default()));
    }),
    ("ellipse", |w, at, size| {
        let scale = DVec3::new(1.0, 1.0, 0.3);
        w.spawn((Disk { radius: size }, Placement { scale, ..at }, Emissive::default()));
    }),
    ("rectangle", |w, at, size| {
        w.spawn((Rectangle { width: size, depth: 2.0 * size }, at, Emissive::default()));
    }),
    ("parallelogram", |w, at, size| {
        let lean = Placement { orientation: DQuat::from_xyzw(0.1, 0.5, 0.2, 0.8).normalize(), ..Placement::default() };
        let parent = w.spawn(Placement { scale: DVec3::new(1.0, 0.4, 1.0), ..at }).id();
        w.spawn((Rectangle { width: size, depth: size }, lean, ChildOf(parent), Emissive::default()));
    }),
    ("triangle", |w, at, size| {
        let vertices = [DVec3::ZERO, DVec3::new(size, 0.2 * size, 0.0), DVec3::new(0.3 * size, 0.0, size)];
        w.spawn((Triangle { vertices, ..Triangle::default() }, at, Emissive::default()));
    }),
    ("cuboid", |w, at, size| {
        w.spawn((Cuboid { size: DVec3::new(1.0, 0.3, 2.0) * size }, at, Emissive::default()));
    }),
    ("flat mesh", |w, at, size| {
        let corner = |x: f64, y: f64| [(x * size) as f32, (y * size) as f32, 0.0];
        let positions = vec![corner(0.0, 0.0), corner(1.0, 0.1), corner(0.9, 1.0), corner(-0.1, 0.8), corner(0.4, 0.4)];
        let triangles = vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
        let mesh = TriangleMesh { positions, triangles, ..TriangleMesh::default() };
        w.spawn((MeshInstance { geometry: MeshGeometry::new(mesh) }, at, Emissive::default()));
    }),
    ("several", |w, at, size| {
        w.spawn((Sphere { radius: size }, at, Emissive::default()));
        let beside = at.position + DVec3::new(9.0, 2.0, -9.0) * size;
        w.spawn((Rectangle { width: size, depth: size }, Placement { position: beside, ..at }, Emissive::default()));
    }),
];

fn lit_scene(lamp: Lamp, at: Placement, size: f64) -> World {
    let mut scene = World::new();
    scene.spawn((PerspectiveCamera::default(), Placement::default()));
    lamp(&mut scene, at, size);
    scene
}

fn turned(draws: &mut Draws) -> DQuat {
    let [x, y, z, w] = [(); 4].map(|()| draws.between(-1.0, 1.0));
    DQuat::from_xyzw(x, y, z, w).normalize()
}

/// From as near as rounding lets a surface come, to a thousand sizes away.
#[test]
fn no_light_occludes_itself() {
    let (mut sent, mut blocked) = (0, 0);
    for (index, (name, lamp)) in LAMPS.into_iter().enumerate() {
        for case in 0..24 {
            let mut draws = Draws::new(500 + index as u64, case);
            let size = draws.power_of_ten(-3.0, 3.0);
            let far_off = draws.unit_vector() * (size * draws.power_of_ten(-1.0, 3.0));
            let at = Placement { position: far_off, orientation: turned(&mut draws), ..Placement::default() };
            let scene = lit_scene(lamp, at, size);
            let (mut world, tile) = tile_world(&scene);
            let lights = AreaLightTable::extract(&Census::of(&scene)).expect("lights");
            let surfaces: Vec<Surface> = (0..ROWS)
                .map(|row| {
                    let mut draws = Draws::new(900 + case, u64::from(row));
                    let from = far_off + draws.unit_vector() * size * 3.0;
                    let u = [draws.unit(), draws.unit()];
                    let on = from + lights.with_light(0, |emitter, _, _| point_on(emitter, from, u).to);
                    let away = draws.unit_vector() * (size * draws.power_of_ten(-7.0, 3.0));
                    let position = (on + away).as_vec3();
                    let normal = (-away.normalize() + 0.9 * draws.unit_vector()).normalize().as_vec3();
                    let bound = offset_bound(position.as_dvec3(), DVec3::ZERO, size);
                    Surface { position, normal, bound, material: 0 }
                })
                .collect();
            for sample in 0..2 {
                let (rays, blockers) = traced(&mut world, tile, &surfaces, sample);
                let occluders = blockers.iter().filter(|&&shape| shape != NO_SHAPE).count();
                // Of several, one may hide the other.
                if name != "several" {
                    assert_eq!(occluders, 0, "{name}, case {case}, size {size:e} at {far_off}");
                    blocked += occluders;
                }
                sent += rays;
            }
        }
    }
    eprintln!("light rays: {sent} sent to 9 kinds of light, {blocked} stopped by the light itself");
    assert!(sent > 100_000);
}

/// Surfaces below a plane, lights above it.
#[test]
fn what_stands_before_a_light_hides_it() {
    let mut sent = 0;
    for (index, (name, lamp)) in LAMPS.into_iter().enumerate() {
        for case in 0..8 {
            let mut draws = Draws::new(1500 + index as u64, case);
            let (size, height) = (draws.power_of_ten(-2.0, 0.0), draws.power_of_ten(-3.0, 1.0));
            let at = Placement {
                position: DVec3::Y * (6.0 * size + 1e-3),
                orientation: turned(&mut draws),
                ..Placement::default()
            };
            let mut scene = lit_scene(lamp, at, size);
            scene.spawn((Plane::default(), Matte::default()));
            let (mut world, tile) = tile_world(&scene);
            let surfaces: Vec<Surface> = (0..ROWS)
                .map(|row| {
                    let mut draws = Draws::new(1900 + case, u64::from(row));
                    let position = DVec3::new(draws.between(-3.0, 3.0), -height, draws.between(-3.0, 3.0)).as_vec3();
                    let bound = offset_bound(position.as_dvec3(), DVec3::ZERO, 0.0);
                    Surface { position, normal: Vec3::Y, bound, material: 0 }
                })
                .collect();
            let (rays, blockers) = traced(&mut world, tile, &surfaces, 0);
            assert!(blockers.iter().all(|&shape| shape != NO_SHAPE), "{name}, case {case}");
            sent += rays;
        }
    }
    eprintln!("light rays: {sent} sent at lights behind a plane, none arrived");
    assert!(sent > 30_000);
}

/// By how much the triangles from a point to the edges of a triangle are larger than it.
fn excess(emitter: &Emitter, at: DVec3) -> f64 {
    let Emitter::Mesh(EmittingTriangle { corners: [a, b, c], .. }) = *emitter else { return 0.0 };
    let area = |a: DVec3, b: DVec3, c: DVec3| (b - a).cross(c - a).length();
    area(at, a, b) + area(at, b, c) + area(at, c, a) - area(a, b, c)
}

/// The pdf beside each ray is the one that a ray which hits the light by BSDF sampling is given.
#[test]
fn both_strategies_know_one_pdf() {
    let (mut compared, mut worst) = (0, 0.0_f64);
    for (index, (name, lamp)) in LAMPS.into_iter().enumerate() {
        let mut draws = Draws::new(2500, index as u64);
        let at =
            Placement { position: DVec3::new(0.0, 4.0, 0.0), orientation: turned(&mut draws), ..Placement::default() };
        let scene = lit_scene(lamp, at, 1.0);
        let lights = AreaLightTable::extract(&Census::of(&scene)).expect("lights");
        let probabilities: f64 = lights.probability.iter().sum();
        assert_eq!(probabilities, 1.0);
        let (mut world, tile) = tile_world(&scene);
        let surfaces: Vec<Surface> = (0..ROWS)
            .map(|row| {
                let mut draws = Draws::new(2600, u64::from(row));
                let position = DVec3::new(draws.between(-3.0, 3.0), 0.0, draws.between(-3.0, 3.0)).as_vec3();
                Surface { position, normal: Vec3::Y, bound: 1e-6, material: 0 }
            })
            .collect();
        traced(&mut world, tile, &surfaces, 3);
        let entity = world.entity(tile);
        let (rays, pdfs) = (entity.get::<ShadowRays>().expect("rays"), entity.get::<LightPdfs>().expect("pdfs"));
        for ray in 0..rays.rows() {
            let from = rays.origin(ray).as_dvec3();
            let direction = rays.direction_of(ray);
            let at = from + direction * f64::from(rays.t_max[ray]);
            // The light that the ray ends on, by its shape and not by its pdf.
            let distance = |light: &usize| match &lights.emitter[*light] {
                Emitter::Sphere(sphere) => (at.distance(sphere.centre) - sphere.radius).abs(),
                Emitter::Rectangle(planar) => planar.normal.dot(at - planar.centre).abs(),
                _ => 0.0,
            };
            let nearest = (0..lights.emitter.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
            let triangle = || {
                // The triangle of a mesh that the point lies in: its areas with the corners add up to the least.
                let excess = |light: &usize| lights.with_light(*light, |emitter, _, _| excess(emitter, at));
                (0..lights.lights()).min_by(|a, b| excess(a).total_cmp(&excess(b))).expect("a light")
            };
            let light = nearest.unwrap_or_else(triangle);
            let receiver = Receiver { position: from, normal: DVec3::Y, depth: 0 };
            let off = (area_light_pdf(&lights, light, &receiver, at) / pdfs.pdf[ray] - 1.0).abs();
            // The direction is rounded to f32 in between, which at a disk's ends, where its pdf grows without end,
            // is much; from afar a pdf goes with the square of the distance, and t_max ends short of the light.
            // Where a planar light is seen obliquely, the rounding counts by one over the cosine more.
            let obliqueness = match &lights.with_light(light, |emitter, _, _| *emitter) {
                Emitter::Rectangle(planar) => planar.normal.dot(direction).abs(),
                Emitter::Triangle(EmittingTriangle { normal, .. }) | Emitter::Mesh(EmittingTriangle { normal, .. }) => {
                    normal.dot(direction).abs()
                }
                _ => 1.0,
            };
            let off = off * obliqueness;
            assert!(off < if matches!(name, "disk" | "ellipse") { 1e-3 } else { 5e-6 }, "{name}, ray {ray}: {off}");
            worst = worst.max(off);
            compared += 1;
        }
    }
    eprintln!("pdfs: {compared} rays, worst {worst:.1e} apart");
    assert!(compared > 4000);
}
