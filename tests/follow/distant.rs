//! Light paths that start outside the scene, on suns and environments: closed forms, and the camera's paths alone.

use super::bidirectional::joined;
use super::caustics::{Form, WIDTH, agrees, camera, mean_of, white};
use super::*;
use glam::{DQuat, DVec3};
use pinhole::material::fresnel;
use pinhole::plan::Census;
use pinhole::scene::*;
use scenes::caustics::{caustics, traced};
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// A sun of irradiance π, whose light falls at this angle to the vertical, towards +x.
fn sun(degrees: f64) -> (DirectionalLight, LookAt) {
    let (sine, cosine) = libm::sincos(degrees.to_radians());
    let look = LookAt { eye: DVec3::ZERO, target: DVec3::new(sine, -cosine, 0.0), up: DVec3::Z };
    (DirectionalLight { irradiance: Rgb::grey(PI), casts_shadows: true }, look)
}

fn pane(world: &mut World) {
    let size = DVec3::new(3.0, 0.5, 3.0);
    world.spawn((Cuboid { size }, Placement::at(0.0, 1.25, 0.0), Glass { ior: 1.5, ..Glass::default() }));
}

/// What passes from one medium into another, by the sine of the angle in vacuum.
fn passes(sine: f64, from: f64, into: f64) -> f64 {
    let inside = sine / from;
    1.0 - fresnel(libm::sqrt(1.0 - inside * inside), into / from)
}

/// A pane between a sun and the ground, each of its faces crossed once.
fn through_a_pane() -> Form {
    let make = || {
        let mut world = World::new();
        camera(&mut world, DVec3::new(0.0, 0.9, 0.0), DVec3::ZERO, WIDTH, true, 4);
        // All of it lies behind the pane: a wider ground would be lit beside it, and be seen in the pane.
        world.spawn((Rectangle { width: 1.2, depth: 1.2 }, Placement::at(0.0, 0.0, 0.0), white()));
        pane(&mut world);
        world.spawn(sun(35.0));
        world
    };
    let (sine, cosine) = libm::sincos(35.0_f64.to_radians());
    let truth = cosine * passes(sine, 1.0, 1.5) * passes(sine, 1.5, 1.0);
    Form { name: "sun through a pane", truth, make: Box::new(make), samples: 80 }
}

/// A sun over water, seen on its ground by a camera in the water.
fn into_water() -> Form {
    let make = || {
        let mut world = World::new();
        camera(&mut world, DVec3::new(0.0, 0.9, 0.0), DVec3::ZERO, WIDTH, true, 3);
        world.spawn((Plane::default(), white()));
        // So wide that no light that enters at its sides comes as far as what is seen.
        let water = Glass { ior: 1.33, ..Glass::default() };
        world.spawn((Cuboid { size: DVec3::new(4.4, 1.6, 2.4) }, Placement::at(0.0, 0.7, 0.0), water));
        world.spawn(sun(20.0));
        world
    };
    let (sine, cosine) = libm::sincos(20.0_f64.to_radians());
    Form { name: "sun over water", truth: cosine * passes(sine, 1.0, 1.33), make: Box::new(make), samples: 60 }
}

/// The ground gets a sun's light, and that of its image in a mirror that stands upright.
fn beside_a_mirror() -> Form {
    let make = || {
        let mut world = World::new();
        camera(&mut world, DVec3::new(0.0, 0.9, 0.0), DVec3::ZERO, WIDTH, true, 3);
        world.spawn((Plane::default(), white()));
        let upright = DQuat::from_xyzw(0.0, 0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2);
        let place = Placement { orientation: upright, ..Placement::at(1.0, 1.5, 0.0) };
        world.spawn((Rectangle { width: 3.0, depth: 3.0 }, place, Mirror { colour: Rgb::grey(0.8) }));
        world.spawn(sun(45.0));
        world
    };
    Form { name: "sun beside a mirror", truth: 1.8 * FRAC_1_SQRT_2, make: Box::new(make), samples: 60 }
}

/// What is known of suns.
pub(super) fn forms() -> Vec<Form> {
    vec![through_a_pane(), into_water(), beside_a_mirror()]
}

/// An infinite shape has no outside to start on, and hides the sun all the same.
#[test]
fn a_roof_without_an_end_hides_the_sun() {
    let under = |height: f64| {
        move || {
            let mut world = (through_a_pane().make)();
            world.spawn((Plane { normal: DVec3::NEG_Y }, Placement::at(0.0, height, 0.0), white()));
            world
        }
    };
    for height in [1.6, 9.0] {
        let found = mean_of(&under(height), &offer(), 8, 0..2);
        assert_eq!(found.mean, 0.0, "a roof at {height}");
    }
    // A floor under the floor hides nothing.
    let above = mean_of(&under(-1.0), &offer(), 8, 0..2);
    eprintln!("a sun through a pane: 0 under two roofs, {:.3} without one", above.mean);
    assert!(above.mean > 0.5, "{}", above.mean);
}

/// The scene of caustics without its lamps.
fn under(sky: impl Bundle) -> World {
    let mut world = caustics(false);
    let mut lamps = world.query_filtered::<Entity, Or<(With<PointLight>, With<SpotLight>)>>();
    let lamps: Vec<Entity> = lamps.iter(&world).collect();
    assert_eq!(lamps.len(), 2);
    lamps.into_iter().for_each(|lamp| _ = world.despawn(lamp));
    world.spawn(sky);
    world
}

fn evening(scale: f64) -> Environment {
    Environment { file: "chapters/16_textures/evening.hdr".into(), turn: Degrees(77.0), scale }
}

#[test]
fn light_from_an_environment_brings_what_the_camera_s_paths_bring() {
    agrees("an evening", &|| under(evening(1.0)), 64); // few paths find the sun, so fewer are no normal distribution
}

/// BSDF sampling finds the light of an even sky or a gradient with less variance.
#[test]
fn no_light_paths_start_on_even_skies_gradients_and_black_environments() {
    let passes = |make: &dyn Fn() -> World| {
        let plan = pinhole::plan::plan(&Census::of(&traced(make)()), &offer()).expect("a plan");
        let leaves = plan.rows.iter().any(|row| row.kept && row.stage.starts_with("Leave the environment's caustics"));
        (plan.passes.len(), leaves)
    };
    let gradient = Gradient { bottom: Rgb::new(0.9, 0.6, 0.1), top: Rgb::new(0.2, 0.5, 1.5) };
    assert_eq!(passes(&|| under(Background { colour: Rgb::new(0.9, 0.7, 0.5) })), (1, false));
    assert_eq!(passes(&|| under(gradient)), (1, false));
    assert_eq!(passes(&|| under(evening(0.0))), (1, false));
    assert_eq!(passes(&|| under(evening(1.0))), (2, true));
}

/// A sun, and a ball so far away that it is seen as 0.4 degrees wide, with the same irradiance: paths start on it as on
/// any shape that emits.
#[test]
fn a_sun_s_caustics_are_those_of_a_small_far_light() {
    const SETS: u64 = 12;
    let away = DVec3::new(-1.6, 2.4, 0.0).normalize();
    let make = |far: bool| {
        move || {
            let irradiance = Rgb::new(3.0, 2.5, 2.0);
            let aim = LookAt { eye: away, target: DVec3::ZERO, up: DVec3::X };
            let mut world = World::new();
            // What the camera sees is matte: behind a first mirror, its own paths would have to find the far ball.
            camera(&mut world, DVec3::new(2.5, 1.5, 0.0), DVec3::new(0.1, 0.0, 0.0), 0.5, true, 6);
            world.spawn((Plane::default(), white()));
            world.spawn((Sphere { radius: 0.5 }, Placement::at(-0.6, 0.7, 0.0), Glass::default()));
            if !far {
                world.spawn((DirectionalLight { irradiance, casts_shadows: true }, aim));
            } else {
                let (distance, radius) = (300.0, 300.0 * libm::sin(0.2_f64.to_radians()));
                let brings = PI * radius * radius / (distance * distance);
                let [r, g, b] = irradiance.to_array().map(|part| part / brings);
                let place = away * distance;
                let emissive = Emissive { radiance: Rgb::new(r, g, b), ..Emissive::default() };
                world.spawn((Sphere { radius }, Placement::at(place.x, place.y, place.z), emissive));
            }
            world
        }
    };
    let sun = renders(&make(false), LightStrategy::Mis, 24, 0..SETS);
    let far = renders(&make(true), LightStrategy::Mis, 24, SETS..2 * SETS);
    assert_agree("a sun and a far ball", &sun, &far, 4);
    let from_both_ends = renders(&joined(&make(false)), LightStrategy::Mis, 12, 2 * SETS..3 * SETS);
    assert_agree("a sun from both ends, and a far ball", &from_both_ends, &far, 4);
    let without = || {
        let mut world = make(false)();
        let camera = named(&mut world, "camera");
        world.entity_mut(camera).remove::<LightTracing>();
        world
    };
    let without = renders(&without, LightStrategy::Mis, 24, 0..SETS);
    let found = agreement(&without, &sun, 4).expect("one size");
    eprintln!("a sun's caustics are seen in {} of {} blocks", found.apart, found.tests);
    assert!(!found.agrees(), "without light tracing they are missing");
}
