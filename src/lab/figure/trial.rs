//! Chapters that the figures' own tests draw: small scenes of both kinds of camera.

use bevy_ecs::prelude::*;
use pinhole::Chapter;
use pinhole::scene::{
    BlinnPhong, Checker, Cuboid, DQuat, Degrees, Emissive, Glass, Integrator, LookAt, Matte, Name, OrthographicCamera,
    PerspectiveCamera, Phong, Placement, Plane, PointLight, Rectangle, Rgb, Sphere,
};
use pinhole::stages;

/// A chapter of this name with a scene that suits its figure.
pub fn chapter(name: &'static str) -> Chapter {
    let scene = match name {
        "04_orthographic" => parallel,
        "13_shapes" => boxed,
        "16_textures" => checkered,
        "15_reflection" => glossy,
        "21_soft_shadows" => soft,
        "20_glass" => clear,
        "22_ambient_occlusion" => occluded,
        _ => central,
    };
    Chapter::new(name, "a trial", scene).offer(stages::all())
}

/// All chapters that figures show.
pub fn chapters() -> Vec<Chapter> {
    ["02_ray", "03_hit", "04_orthographic", "05_pinhole", "06_ndc", "07_screen", "08_field_of_view"]
        .into_iter()
        .chain(["09_camera_to_world", "10_light_and_shadow", "13_shapes", "15_reflection", "16_textures"])
        .chain([
            "17_sampling",
            "19_mirrors",
            "20_glass",
            "21_soft_shadows",
            "22_ambient_occlusion",
            "23_depth_of_field",
            "24_motion_blur",
            "25_path_tracing",
            "26_choosing_samples",
            "27_caustics",
        ])
        .map(chapter)
        .collect()
}

fn central(world: &mut World) {
    let look = LookAt { eye: [0.0, 1.6, 5.0].into(), target: [0.0, 0.8, 0.0].into(), ..LookAt::default() };
    world.spawn((PerspectiveCamera { fov: Degrees(40.0), ..PerspectiveCamera::default() }, look));
    things(world);
    let light = PointLight { intensity: Rgb::grey(120.0), ..PointLight::default() };
    world.spawn((Name::new("lamp"), light, Placement::at(3.0, 5.0, 3.5)));
}

fn occluded(world: &mut World) {
    central(world);
    let camera = world.query_filtered::<Entity, With<PerspectiveCamera>>().iter(world).next();
    if let Some(camera) = camera {
        world.entity_mut(camera).insert(Integrator::AmbientOcclusion { distance: f64::INFINITY });
    }
}

fn boxed(world: &mut World) {
    central(world);
    let tilt = DQuat::from_xyzw(0.0, 0.26, 0.1, 0.96).normalize();
    let brick = Placement { orientation: tilt, ..Placement::at(1.6, 0.4, 0.6) };
    world.spawn((Cuboid { size: [0.8, 0.6, 0.7].into() }, brick, Matte::default()));
}

fn checkered(world: &mut World) {
    central(world);
    world.spawn((Plane::default(), Placement::at(0.0, 0.1, 0.0), Matte::default(), Checker::default()));
}

fn glossy(world: &mut World) {
    central(world);
    world.spawn((Sphere { radius: 0.2 }, Placement::at(-0.5, 0.2, 2.0), Phong { exponent: 20.0, ..Phong::default() }));
    let satin = BlinnPhong { exponent: 80.0, ..BlinnPhong::default() };
    world.spawn((Sphere { radius: 0.2 }, Placement::at(0.0, 0.2, 2.0), satin));
}

fn soft(world: &mut World) {
    central(world);
    let tray = Placement { orientation: DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0), ..Placement::at(0.0, 3.0, 0.0) };
    world.spawn((Rectangle::default(), tray, Emissive::default()));
}

fn clear(world: &mut World) {
    central(world);
    world.spawn((Sphere { radius: 0.2 }, Placement::at(-0.5, 0.2, 2.0), Glass::default()));
}

fn parallel(world: &mut World) {
    let look = LookAt { eye: [0.0, 1.3, 4.0].into(), target: [0.0, 1.0, 0.0].into(), ..LookAt::default() };
    world.spawn((OrthographicCamera { view_height: 2.4 }, look));
    things(world);
}

fn things(world: &mut World) {
    let (red, gold) = (Rgb::new(0.85, 0.35, 0.2), Rgb::new(0.9, 0.75, 0.3));
    world.spawn((Sphere { radius: 0.8 }, Placement::at(-1.0, 0.8, 0.5), Matte { colour: red }));
    world.spawn((Sphere { radius: 0.7 }, Placement::at(0.5, 0.7, -1.5), Matte { colour: gold }));
    let egg = Placement { scale: [0.6, 1.0, 0.4].into(), ..Placement::at(0.9, 0.3, 1.4) };
    world.spawn((Sphere { radius: 0.3 }, egg, Matte { colour: gold }));
    world.spawn((Plane::default(), Matte { colour: Rgb::grey(0.6) }));
}
