//! Shapes of glass in one another, as many as there may be.

use super::*;
use glam::DVec3;
use pinhole::follow::DeeperMedia;
use pinhole::plan::{Census, Column};
use pinhole::render::inspect;
use pinhole::scene::*;

/// Balls of glass about one centre, or eggs, or cuboids, in an even sky of radiance 1.
fn shells(count: u32, absorption: f64, shape: &dyn Fn(&mut World, f64) -> Entity) -> World {
    let mut world = World::new();
    let size = Resolution { width: 24, height: 16 };
    let look = LookAt { eye: DVec3::new(0.3, 1.5, 5.0), target: DVec3::ZERO, ..LookAt::default() };
    let camera = (Name::new("camera"), PerspectiveCamera { fov: Degrees(30.0), ..PerspectiveCamera::default() });
    world.spawn((camera, look, size, Integrator::PATH));
    for number in 0..count {
        let part = f64::from(number) / f64::from(count);
        let made = shape(&mut world, 1.0 - 0.7 * part);
        let glass = Glass { ior: 1.2 + 0.4 * part, absorption: Rgb::grey(absorption), priority: number };
        world.entity_mut(made).insert((Name::new(format!("shell {number}")), glass));
    }
    world.spawn((Name::new("sky"), Background { colour: Rgb::grey(1.0) }));
    world
}

/// Glass that absorbs nothing hands all of an even sky on, so however many shells a ray goes through, it brings 1.
#[test]
fn an_even_sky_is_seen_evenly_through_any_number_of_shells() {
    let kinds: [(&str, &dyn Fn(&mut World, f64) -> Entity); 3] = [
        ("balls", &|world, size| world.spawn(Sphere { radius: size }).id()),
        ("eggs", &|world, size| {
            let place = Placement { scale: DVec3::new(1.2, 1.0, 0.8), ..Placement::default() };
            world.spawn((Sphere { radius: size }, place)).id()
        }),
        ("cuboids", &|world, size| world.spawn(Cuboid { size: DVec3::splat(size) }).id()),
    ];
    let mut tried = 0;
    for (kind, shape) in kinds {
        for count in [1, 4, 5, 8, 20] {
            let world = shells(count, 0.0, shape);
            let film = render(&world, &offer(), &Execution::default(), &()).expect("renders").film;
            let (mut lowest, mut highest) = (f32::MAX, 0.0_f32);
            for part in (0..24).flat_map(|x| (0..16).map(move |y| (x, y))).flat_map(|(x, y)| film.mean(x, y)) {
                (lowest, highest) = (lowest.min(part), highest.max(part));
            }
            eprintln!("{count:>2} {kind}: from {lowest} to {highest}");
            // What is caught in a cuboid for 4096 segments is lost, and is never more than a fraction of a pixel's light.
            assert!((highest - 1.0).abs() < 1e-5, "{count} {kind}: {highest}");
            assert!(kind == "cuboids" || (lowest - 1.0).abs() < 1e-5, "{count} {kind}: {lowest}");
            tried += 1;
        }
    }
    eprintln!("nested glass: {tried} scenes of up to 20 shells, each as bright as the sky");
}

/// The column for what lies beyond the fourth glass is there for those who need it, and costs the others nothing.
#[test]
fn only_glass_that_nests_deeply_has_the_deeper_column() {
    let has = |world: &World| {
        let plan = pinhole::plan::plan(&Census::of(world), &offer()).expect("a plan");
        ["media", "deeper media"].map(|name| plan.columns.iter().any(|column| column.name == name))
    };
    let ball = |world: &mut World, size: f64| world.spawn(Sphere { radius: size }).id();
    let apart = |world: &mut World, size: f64| {
        world.spawn((Sphere { radius: 0.01 }, Placement::at(100.0 * size, 0.0, 0.0))).id()
    };
    assert_eq!(has(&shells(1, 0.0, &ball)), [false, false]);
    assert_eq!(has(&shells(4, 0.0, &ball)), [true, false]);
    assert_eq!(has(&shells(5, 0.0, &ball)), [true, true]);
    assert_eq!(has(&shells(12, 1.0, &apart)), [true, false], "they absorb, but lie apart");
}

/// A double pyramid of glass triangles, without one of them or whole.
fn gem(missing: Option<u32>) -> World {
    let mut world = shells(0, 0.0, &|world, _| world.spawn_empty().id());
    let glass = world.spawn((Name::new("glass"), Glass::default())).id();
    for octant in (0..8).filter(|octant| Some(*octant) != missing) {
        let side = |bit: u32| if octant >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let [a, b, c] = [DVec3::X * side(0), DVec3::Y * side(1), DVec3::Z * side(2)];
        let outward = side(0) * side(1) * side(2) > 0.0;
        let vertices = if outward { [a, b, c] } else { [a, c, b] };
        world.spawn((
            Name::new(format!("face {octant}")),
            Triangle { vertices, ..Triangle::default() },
            UsesMaterial(glass),
        ));
    }
    world
}

/// A closed mesh of glass hands an even sky on; with a face missing it has no interior, and is refused for each of them.
#[test]
fn a_mesh_of_glass_is_closed_or_refused() {
    let film = render(&gem(None), &offer(), &Execution::default(), &()).expect("renders").film;
    let brightest = (0..24 * 16).map(|at| film.mean(at % 24, at / 24)[1]).fold(0.0, f32::max);
    assert!((brightest - 1.0).abs() < 1e-5, "{brightest}");
    for missing in 0..8 {
        let told = render(&gem(Some(missing)), &offer(), &Execution::default(), &()).map(|_| ());
        let told = told.expect_err("refused").to_string();
        assert!(["triangle \"face ", "material", "\"glass\"", "interior"].iter().all(|w| told.contains(w)), "{told}");
    }
    eprintln!("glass meshes: one closed and as bright as the sky, 8 with a hole refused");
}

/// Of the rays that leave the sixth surface some are inside six shells, others outside all.
#[test]
fn rays_inside_more_than_four_shells_are_painted_white() {
    let mut world = shells(8, 0.0, &|world, size| world.spawn(Sphere { radius: size }).id());
    let camera = named(&mut world, "camera");
    let integrator = Integrator::Path { max_depth: 6, lights: LightStrategy::Mis, roulette: 0 };
    world.entity_mut(camera).insert(integrator);
    let inspection = inspect(&world, &offer(), 24).expect("inspects");
    let deeper = inspection.world.get::<DeeperMedia>(inspection.tiles[0]).expect("more than four shells");
    let mut painted = [0; 2];
    for row in 0..deeper.rows() {
        let inside = usize::from(!deeper.0.get(row).is_empty());
        assert_eq!(deeper.paint(row, [24, 16]), [inside as f32; 3], "{:?}", deeper.0.get(row));
        painted[inside] += 1;
    }
    assert!(painted.iter().all(|&rays| rays > 10), "{painted:?} rays");
}
