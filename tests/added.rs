//! What another crate adds to the renderer (`tests/outside`), held against closed forms and against each other.

#[path = "added/again.rs"]
mod again;

use bevy_ecs::prelude::*;
use glam::DVec3;
use outside::bowl::{Bowl, PlacedBowl};
use outside::chalk::{Chalk, ChalkTable};
use outside::contours::{self, Contours};
use outside::lantern::{Lantern, PlacedLantern};
use outside::rings::Rings;
use outside::{add_to, stages, table, table_with_contours};
use pinhole::extend::*;
use pinhole::plan::{Census, Stage, plan};
use pinhole::render::{Execution, Worlds};
use pinhole::scene::*;
use pinhole_lab::measure::draws::Draws;
use std::f64::consts::PI;

fn film(scene: &World) -> pinhole::film::Film {
    render(scene, &stages(), &Execution::default(), &()).expect("renders").film
}

/// The means of all pixels.
fn bits(film: &pinhole::film::Film) -> Vec<[u32; 3]> {
    let pixels = (0..film.height).flat_map(|y| (0..film.width).map(move |x| (x, y)));
    pixels.map(|(x, y)| film.mean(x, y).map(f32::to_bits)).collect()
}

fn told(scene: &World, offer: &[Stage]) -> String {
    render(scene, offer, &Execution::default(), &()).err().expect("refused").to_string()
}

/// A camera that looks straight down from 5 above the origin, and a floor there.
fn floor_from_above(samples: u32, floor: impl Bundle) -> World {
    let mut scene = World::new();
    add_to(&mut scene);
    scene.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(20.0), axis: FovAxis::Vertical },
        LookAt { eye: DVec3::new(0.0, 5.0, 0.0), target: DVec3::ZERO, up: DVec3::NEG_Z },
        Resolution { width: 24, height: 24 },
    ));
    // A single ray a pixel passes through its centre.
    if samples > 1 {
        let camera = scene.query_filtered::<Entity, With<PerspectiveCamera>>().single(&scene).expect("one");
        scene.entity_mut(camera).insert(Sampling { samples, ..Sampling::default() });
    }
    scene.spawn((Name::new("floor"), Plane::default(), floor));
    scene
}

/// Where the middle of a pixel is on the floor.
fn on_floor(x: u32, y: u32) -> DVec3 {
    let half = 5.0 * (10.0_f64).to_radians().tan();
    let at = |pixel: u32| (2.0 * (f64::from(pixel) + 0.5) / 24.0 - 1.0) * half;
    DVec3::new(at(x), 0.0, at(y))
}

#[test]
fn everything_added_is_planned_and_the_picture_does_not_depend_on_how_it_is_made() {
    let scene = table_with_contours(48, 27);
    let planned = plan(&Census::of(&scene), &stages()).expect("plans");
    let row = |name: &str| planned.rows.iter().find(|row| row.stage == name).expect(name);
    for name in [
        "Intersect bowls",
        "List rows: bowls",
        "Compute surfaces: bowls",
        "Trace shadow rays: bowls",
        "Evaluate direct light: chalk",
        "Evaluate textures: rings",
        "Sample lanterns",
        "Draw contours",
    ] {
        assert!(row(name).kept, "{name}: {}", row(name).reason);
    }
    let expected = bits(&film(&scene));
    let mut tried = 0;
    for threads in [1, 2] {
        for tile_side in [8, 32] {
            for worlds in [Worlds::One, Worlds::PerWorker] {
                let execution = Execution { threads: Some(threads), tile_side, worlds, part: None };
                let other = render(&scene, &stages(), &execution, &()).expect("renders").film;
                assert_eq!(bits(&other), expected, "{threads} threads, tiles of {tile_side}, {worlds:?}");
                tried += 1;
            }
        }
    }
    let without = table(48, 27);
    assert_ne!(bits(&film(&without)), expected, "contours are drawn");
    let dropped = plan(&Census::of(&without), &stages()).expect("plans");
    let contours = dropped.rows.iter().find(|row| row.stage == "Draw contours").expect("a row");
    assert!(!contours.kept && contours.reason == "0 contours", "{}", contours.reason);
    eprintln!("added: {tried} renders, all equal");
}

/// A scene that says that it may have them and has none costs what it did.
#[test]
fn what_may_be_there_and_is_not_changes_nothing() {
    let mut scene = World::new();
    scene.spawn((PerspectiveCamera::default(), Placement::at(0.0, 1.0, 4.0), Resolution { width: 32, height: 18 }));
    scene.spawn((Sphere::default(), Matte::default(), Placement::at(0.0, 1.0, 0.0)));
    scene.spawn((PointLight { intensity: Rgb::grey(50.0), ..PointLight::default() }, Placement::at(2.0, 4.0, 3.0)));
    let (expected, kept) = (bits(&film(&scene)), plan(&Census::of(&scene), &every_stage_and([])).expect("plans"));
    add_to(&mut scene);
    assert_eq!(bits(&film(&scene)), expected);
    let now = plan(&Census::of(&scene), &stages()).expect("plans");
    let names = |stages: &[Stage]| stages.iter().map(|stage| stage.name).collect::<Vec<_>>();
    assert_eq!(names(&now.stages), names(&kept.stages));
}

/// Rays towards points of bowls: the hit is on the paraboloid, not behind the point, and no root before it is left out.
#[test]
fn a_bowl_is_hit_where_it_is() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    for index in 0..4000 {
        let mut draws = Draws::new(77, index);
        let bowl = Bowl { radius: draws.power_of_ten(-1.0, 1.0), height: draws.power_of_ten(-1.0, 1.0) };
        let mut scene = World::new();
        add_to(&mut scene);
        scene.spawn(PerspectiveCamera::default());
        scene.spawn((bowl.clone(), Matte::default()));
        let census = Census::of(&scene);
        let placed = census.table::<pinhole::extract::ShapesOf<PlacedBowl>>().expect("a bowl").row[0];
        let height = |x: f64, z: f64| bowl.height * (x * x + z * z) / (bowl.radius * bowl.radius);
        let (angle, radius) = (draws.unit() * 2.0 * PI, bowl.radius * draws.unit().sqrt() * 0.999);
        let (x, z) = (radius * angle.cos(), radius * angle.sin());
        let target = DVec3::new(x, height(x, z), z);
        let origin = target + draws.unit_vector() * draws.power_of_ten(-1.0, 2.0) * bowl.radius;
        let direction = (target - origin).normalize();
        let t = placed.intersection(origin, direction).t;
        let far = target.distance(origin);
        assert!(t <= far * (1.0 + 1e-9), "{index}: {t} beyond {far}");
        let at = origin + t * direction;
        worst = worst.max((at.y - height(at.x, at.z)).abs() / (bowl.radius + bowl.height + far));
        // Before it the ray is on one side: the implicit function has no further sign change within the rim.
        let side = |t: f64| {
            let p = origin + t * direction;
            (p.x.hypot(p.z) < bowl.radius * 0.999).then(|| (p.y - height(p.x, p.z)) > 0.0)
        };
        let before: Vec<bool> = (1..200).filter_map(|step| side(t * f64::from(step) / 200.0)).collect();
        assert!(before.windows(2).all(|pair| pair[0] == pair[1]), "{index}: an earlier root is left out");
        tried += 1;
    }
    eprintln!("bowls: {tried} rays, off the surface by {worst:.1e} of the size at most");
    assert!(worst < 1e-12, "{worst}");
}

/// E = I (1 + cos θ) / 2 · cos θ' / d², reflected by a matte floor, and the power by many starts.
#[test]
fn a_lantern_sends_what_its_formula_says() {
    let intensity = 30.0;
    let mut scene = floor_from_above(1, Matte { colour: Rgb::grey(0.5) });
    let place = DVec3::new(0.4, 3.0, -0.3);
    let ahead = (DVec3::new(0.2, 0.0, 0.1) - place).normalize();
    let look = LookAt { eye: place, target: place + ahead, up: DVec3::Z };
    scene.spawn((Lantern { intensity: Rgb::grey(intensity) }, look));
    let film = film(&scene);
    let mut worst = 0.0_f64;
    for (x, y) in (0..24).flat_map(|y| (0..24).map(move |x| (x, y))) {
        let from = on_floor(x, y) - place;
        let (d2, direction) = (from.length_squared(), from.normalize());
        let expected = 0.5 / PI * intensity * 0.5 * (1.0 + direction.dot(ahead)) * -direction.y / d2;
        worst = worst.max((film.mean(x, y)[1] as f64 / expected - 1.0).abs());
    }
    eprintln!("lantern: 576 pixels, off by {worst:.1e} at most");
    assert!(worst < 1e-5, "{worst}");

    let census = Census::of(&scene);
    let table = census.table::<pinhole::extract::LightsOf<PlacedLantern>>().expect("lanterns");
    let (mut sum, count) = (0.0, 40_000);
    for index in 0..count {
        let mut draws = Draws::new(5, index);
        let direction = [draws.unit(), draws.unit()];
        let start = StartDraws { light: 0, point: [0.5; 2], direction, target: 0.5, side: 0.5 };
        sum += table.row[0].start(&Targets::default(), &start).power[0];
    }
    let (mean, power) = (sum / f64::from(count as u32), table.row[0].power(1.0)[0]);
    // The standard deviation of a start is power · √(1/3).
    let error = power * (1.0 / 3.0_f64).sqrt() / f64::from(count as u32).sqrt();
    assert!((mean - power).abs() < 4.0 * error, "{mean} ± {error}, expected {power}");
}

/// Where its microfacets do not lean it is matte; where they do, both directions may be exchanged, and light sampling, BSDF
/// sampling and MIS see the same.
#[test]
fn chalk_is_matte_without_sigma_and_agrees_with_itself_with_it() {
    let colour = Rgb::new(0.7, 0.5, 0.3);
    let lit = |material: World| {
        let mut scene = material;
        scene.spawn((PointLight { intensity: Rgb::grey(40.0), ..PointLight::default() }, Placement::at(1.0, 3.0, 0.5)));
        film(&scene)
    };
    let matte = lit(floor_from_above(1, Matte { colour }));
    let chalk = lit(floor_from_above(1, Chalk { colour, sigma: Degrees(0.0) }));
    for (x, y) in (0..24).flat_map(|y| (0..24).map(move |x| (x, y))) {
        for part in 0..3 {
            let [one, other] = [matte.mean(x, y)[part], chalk.mean(x, y)[part]];
            assert!((one - other).abs() <= 1e-6 * one, "{x} {y}: {one} and {other}");
        }
    }
    let scene = floor_from_above(1, Chalk { colour, sigma: Degrees(35.0) });
    let census = Census::of(&scene);
    let table = census.table::<ChalkTable>().expect("chalk");
    let context = ShadingContext::opaque(0, Parameters::coloured([1.0; 3]));
    for index in 0..2000 {
        let mut draws = Draws::new(9, index);
        let mut above = || {
            let direction = draws.unit_vector();
            DVec3::new(direction.x, direction.y, direction.z.abs())
        };
        let (one, other) = (above(), above());
        assert_eq!(table.eval(&context, one, other), table.eval(&context, other, one));
    }
    let by = |lights: LightStrategy| {
        let mut scene = floor_from_above(4096, Chalk { colour, sigma: Degrees(35.0) });
        let camera = scene.query_filtered::<Entity, With<PerspectiveCamera>>().single(&scene).expect("one");
        scene.entity_mut(camera).insert(Integrator::Path { max_depth: 2, lights, roulette: 0 });
        scene.entity_mut(camera).insert(Resolution { width: 4, height: 4 });
        let lamp = (Rectangle { width: 1.5, depth: 1.5 }, Emissive { radiance: Rgb::grey(5.0), ..Emissive::default() });
        let down = glam::DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0);
        scene.spawn((lamp, Placement { orientation: down, ..Placement::at(2.5, 2.0, 0.0) }));
        let film = film(&scene);
        let pixels: Vec<f64> = (0..16).map(|pixel| f64::from(film.mean(pixel % 4, pixel / 4)[1])).collect();
        pixels.iter().sum::<f64>() / 16.0
    };
    let [light, bsdf, mis] = [LightStrategy::Light, LightStrategy::Bsdf, LightStrategy::Mis].map(by);
    eprintln!("chalk by light {light:.5}, BSDF {bsdf:.5}, MIS {mis:.5}");
    // One BSDF sample in 40 finds the lamp: of 65,536 some 1,600, so that 4 standard errors are 10 %.
    assert!(light > 0.01 && (light / mis - 1.0).abs() < 0.01 && (bsdf / mis - 1.0).abs() < 0.1);
}

#[test]
fn rings_are_where_their_formula_has_them() {
    let rings = Rings::default();
    let mut scene = floor_from_above(1, (Matte::default(), rings.clone()));
    // A light so far away that it is the same everywhere: the picture is the colour over π times a constant.
    let sun = DirectionalLight { irradiance: Rgb::grey(PI), ..DirectionalLight::default() };
    scene.spawn((sun, LookAt { eye: DVec3::new(0.0, 9.0, 0.0), target: DVec3::ZERO, up: DVec3::NEG_Z }));
    let film = film(&scene);
    let mut worst = 0.0_f64;
    for (x, y) in (0..24).flat_map(|y| (0..24).map(move |x| (x, y))) {
        let at = on_floor(x, y) / rings.width + DVec3::splat(0.5);
        let dark = at.x.hypot(at.z).fract().powi(2);
        let expected = rings.light.g + dark * (rings.dark.g - rings.light.g);
        worst = worst.max((f64::from(film.mean(x, y)[1]) - expected).abs());
    }
    assert!(worst < 1e-5, "{worst}");
}

/// 200 bowls by a hierarchy and, a few at a time, one by one.
#[test]
fn bowls_are_found_in_a_hierarchy() {
    let place = |index: u32| Placement::at(f64::from(index % 20) * 2.5 - 25.0, 0.0, -f64::from(index / 20) * 2.5);
    let scene_of = |bowls: &mut dyn Iterator<Item = u32>| {
        let mut scene = World::new();
        add_to(&mut scene);
        let look =
            LookAt { eye: DVec3::new(0.0, 12.0, 14.0), target: DVec3::new(0.0, 0.0, -10.0), ..LookAt::default() };
        scene.spawn((PerspectiveCamera::default(), look, Resolution { width: 64, height: 36 }));
        for index in bowls {
            scene.spawn((Bowl::default(), Matte::default(), place(index)));
        }
        scene
    };
    let t_of = |scene: &World| {
        let seen = inspect(scene, &stages(), 64).expect("inspects");
        let hits = seen.world.get::<pinhole::intersect::Hits>(seen.tiles[0]).expect("hits");
        hits.t.clone()
    };
    let together = t_of(&scene_of(&mut (0..200)));
    let mut apart = vec![f64::INFINITY; together.len()];
    for part in 0..10 {
        let some = t_of(&scene_of(&mut (part * 20..part * 20 + 20)));
        apart.iter_mut().zip(some).for_each(|(min, t)| *min = min.min(t));
    }
    let hits = together.iter().filter(|t| **t < f64::INFINITY).count();
    assert_eq!(together, apart);
    assert!(hits > 500, "{hits}");
}

#[test]
fn what_is_forgotten_is_said() {
    let scene = table(16, 9);
    let of_bowl = told(&scene, &every_stage_and(of_material::<ChalkTable>()));
    assert!(of_bowl.contains("bowl \"bowl\"") && of_bowl.contains("of_shape"), "{of_bowl}");
    let own =
        of_shape::<PlacedBowl>().into_iter().chain(of_material::<ChalkTable>()).chain([of_light::<PlacedLantern>()]);
    let of_rings = told(&scene, &every_stage_and(own));
    assert!(of_rings.contains("rings \"table\"") && of_rings.contains("of_texture"), "{of_rings}");
    let own = of_shape::<PlacedBowl>().into_iter().chain([of_light::<PlacedLantern>(), of_texture::<Rings>()]);
    let of_chalk = told(&scene, &every_stage_and(own));
    assert!(of_chalk.contains("chalk \"bowl\"") && of_chalk.contains("of_material"), "{of_chalk}");

    // A scene that does not say that it may have a bowl.
    let mut scene = World::new();
    scene.spawn((PerspectiveCamera::default(), Placement::at(0.0, 0.0, 9.0)));
    scene.spawn((Bowl::default(), Matte::default()));
    scene.spawn((Sphere::default(), Matte::default(), Placement::at(3.0, 0.0, 0.0)));
    let unknown = told(&scene, &stages());
    assert!(unknown.contains("bowl") && unknown.contains("add_shape"), "{unknown}");
    let mut scene = floor_from_above(1, Matte::default());
    scene.spawn((Bowl { radius: -1.0, height: 1.0 }, Matte::default()));
    let refused = told(&scene, &stages());
    assert!(refused.contains("radius is -1") && refused.contains("above 0"), "{refused}");
}

/// A stage alone: nothing has to be said of it.
#[test]
fn a_stage_needs_no_more_than_to_be_offered() {
    let mut scene = World::new();
    scene.spawn((PerspectiveCamera::default(), Placement::at(0.0, 0.0, 4.0), Resolution { width: 32, height: 32 }));
    scene.spawn((Sphere::default(), Matte::default()));
    scene.spawn((PointLight { intensity: Rgb::grey(80.0), ..PointLight::default() }, Placement::at(0.0, 0.0, 4.0)));
    let plain = film(&scene);
    scene.spawn(Contours { step: 0.5, width: 0.1 });
    let lined =
        render(&scene, &every_stage_and([contours::stage()]), &Execution::default(), &()).expect("renders").film;
    let darker = (0..32).filter(|&y| lined.mean(16, y)[1] < 0.3 * plain.mean(16, y)[1]).count();
    assert!((3..12).contains(&darker), "{darker} pixels of the middle column are on a line");
}
