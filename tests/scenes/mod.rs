//! Scenes that several tests use, and the film as bits, so that equal means equal.
#![allow(dead_code, reason = "each test takes what it needs")]

pub mod caustics;
pub mod followed;
pub mod many;
pub mod material;
pub mod public;
mod soft;
mod textured;
mod toggled;

use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use pinhole::look::{Preflight, view_stage};
use pinhole::plan::{Census, Stage};
use pinhole::render::{Execution, Worlds, render};
use pinhole::scene::*;
use pinhole::shapes::SceneShape;
use pinhole::{shade, stages};
pub use pinhole_lab::measure::film_bits::FilmBits;
#[allow(unused_imports, reason = "each test takes what it needs")]
pub use soft::soft;
use std::time::Duration;
#[allow(unused_imports, reason = "each test takes what it needs")]
pub use textured::{TextureToggle, textured, textured_by};
#[allow(unused_imports, reason = "each test takes what it needs")]
pub use toggled::{MORE, TOGGLES, Toggle, VIEWED, combinations, singles_and_pairs, toggled};

/// Which camera a scene gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Eye {
    Perspective,
    Orthographic,
}

/// Both.
pub const EYES: [Eye; 2] = [Eye::Perspective, Eye::Orthographic];

/// What a test changes about a scene.
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    pub eye: Eye,
    pub size: [u32; 2],
    /// Every length is multiplied by it, and every light's intensity by its square.
    pub scale: f64,
    /// Every root is moved by it.
    pub shift: DVec3,
}

impl Default for Setup {
    fn default() -> Self {
        Self { eye: Eye::Perspective, size: [97, 31], scale: 1.0, shift: DVec3::ZERO }
    }
}

impl Setup {
    fn point(&self, x: f64, y: f64, z: f64) -> DVec3 {
        on_grid(DVec3::new(x, y, z)) * self.scale + self.shift
    }

    fn placed(&self, [x, y, z]: [f64; 3], scale: [f64; 3], orientation: DQuat) -> Placement {
        Placement { position: self.point(x, y, z), orientation, scale: DVec3::from(scale) }
    }

    fn camera(&self, world: &mut World, look: LookAt) {
        let [width, height] = self.size;
        let mut camera = world.spawn((Name::new("camera"), look, Resolution { width, height }));
        match self.eye {
            Eye::Perspective => camera.insert(PerspectiveCamera { fov: Degrees(50.0), ..Default::default() }),
            Eye::Orthographic => camera.insert(OrthographicCamera { view_height: 4.0 * self.scale }),
        };
    }

    fn light(&self, intensity: f64, casts_shadows: bool) -> PointLight {
        PointLight { intensity: Rgb::grey(intensity * self.scale * self.scale), casts_shadows }
    }
}

/// The nearest point whose coordinates are multiples of 2⁻³²: far finer than f32 can hold at 2²⁰.
fn on_grid(point: DVec3) -> DVec3 {
    let steps = 4_294_967_296.0;
    (point * steps).round() / steps
}

/// Every stage that a chapter can offer.
pub fn offer() -> Vec<Stage> {
    let mut offer = stages::all();
    offer.push(view_stage(&offer));
    offer
}

/// Conditions in which no test ray is cut off because another test keeps the processor busy.
pub fn unhurried() -> Preflight {
    Preflight { patience: Some(Duration::from_secs(10)), ..Preflight::default() }
}

/// Every stage of direct light, after which no path goes on.
pub fn offer_of_direct_light() -> Vec<Stage> {
    let mut offer = [
        stages::camera_rays(),
        stages::samples(),
        stages::wide_cameras(),
        stages::lens(),
        stages::motion(),
        stages::intersection(),
        stages::surfaces(),
        stages::transforms(),
        stages::direct_light(),
        stages::lights(),
        stages::highlights(),
        stages::textures(),
        stages::environment(),
        vec![shade::area_light_stage(), shade::environment_light_stage()],
        stages::film(),
    ]
    .concat();
    stages::sort(&mut offer);
    offer
}

/// Names the integrator that a scene would have in front of a black sky, so that its sky is seen and lights nothing.
pub fn lit_by_lights_alone(mut world: World) -> World {
    let without_sky = pinhole::extract::integrator_of(&Census::of(&world)).without_sky;
    let camera = named(&mut world, "camera");
    if let Some(integrator) = without_sky {
        world.entity_mut(camera).insert(integrator);
    }
    world
}

/// A scene that needs every stage of its camera but the view: balls and planes, lights with and without shadows, one
/// of them under the ground, a shared material, a child, a mirrored thing, a background.
///
/// All coordinates lie on a 2⁻³² grid, and nothing but the view is turned, so that it may be moved by 2²⁰ exactly.
pub fn full(setup: Setup) -> World {
    let mut world = World::new();
    let look = LookAt { eye: setup.point(0.23, 1.03, 4.9), target: setup.point(0.01, 1.27, 0.02), up: DVec3::Y };
    setup.camera(&mut world, look);
    add_things(&mut world, &setup);
    lit_by_lights_alone(world)
}

/// The same with turned parents, whose coordinates are not on a grid any more.
pub fn turned(setup: Setup) -> World {
    let mut world = full(setup);
    let orientation = DQuat::from_xyzw(0.5, -0.1, 0.7, 0.5).normalize();
    let group = Placement { position: setup.point(0.3, 1.1, -2.2), orientation, scale: DVec3::new(-1.5, 1.5, 1.5) };
    let group = world.spawn((Name::new("turned group"), group)).id();
    for (x, radius) in [(-0.7, 0.31), (0.9, 0.57)] {
        let position = DVec3::new(x, 0.4, 0.2) * setup.scale;
        let ball = (Sphere { radius: radius * setup.scale }, Placement { position, ..Placement::default() });
        world.spawn((Name::new("turned ball"), ball, Matte { colour: Rgb::new(0.7, 0.2, 0.9) }, ChildOf(group)));
    }
    world
}

fn add_things(world: &mut World, setup: &Setup) {
    let at = |x, y, z| Placement { position: setup.point(x, y, z), ..Placement::default() };
    let sphere = |radius: f64| Sphere { radius: radius * setup.scale };
    let gold = world.spawn((Name::new("gold"), Matte { colour: Rgb::new(0.9, 0.7, 0.2) })).id();
    world.spawn((Name::new("left ball"), sphere(0.75), at(-1.27, 0.75, 0.53), UsesMaterial(gold)));
    world.spawn((Name::new("ground"), Plane::default(), at(0.0, 0.017, 0.0), Matte { colour: Rgb::grey(0.6) }));
    world.spawn((
        Name::new("middle ball"),
        sphere(0.5),
        at(0.29, 0.5, 1.09),
        Matte { colour: Rgb::new(0.2, 0.5, 0.9) },
    ));
    // The same ball again in another colour: every ray that hits one hits the other at the very same distance.
    world.spawn((Name::new("double"), sphere(0.5), at(0.29, 0.5, 1.09), Matte { colour: Rgb::new(0.9, 0.1, 0.1) }));
    let mirrored = Placement { scale: DVec3::new(-2.0, 2.0, 2.0), ..at(1.53, 0.27, -0.51) };
    let group = world.spawn((Name::new("group"), mirrored)).id();
    let child = Placement { position: DVec3::new(0.0, 0.25, 0.0) * setup.scale, ..Placement::default() };
    world.spawn((Name::new("child"), sphere(0.25), child, UsesMaterial(gold), ChildOf(group)));
    let wall = Plane { normal: DVec3::new(1.0, 0.0, -0.25) };
    world.spawn((Name::new("wall"), wall, at(-3.03, 0.0, 0.0), Matte { colour: Rgb::new(0.5, 0.7, 0.5) }));
    let sail = (leaning_triangle(setup.scale), at(-0.5, 1.75, 0.5));
    world.spawn((Name::new("sail"), sail, Matte { colour: Rgb::new(0.4, 0.7, 0.9) }));
    let flag = Triangle { normals: None, ..leaning_triangle(setup.scale) };
    let stretched = Placement { scale: DVec3::new(0.5, -0.75, 2.0), ..at(1.03, 2.26, -0.25) };
    world.spawn((Name::new("flag"), flag, stretched, UsesMaterial(gold)));
    world.spawn((Name::new("lamp"), setup.light(60.0, true), at(2.51, 4.02, 3.03)));
    world.spawn((Name::new("cellar lamp"), setup.light(20.0, true), at(0.07, -1.01, 2.53)));
    world.spawn((Name::new("fill"), setup.light(15.0, false), at(-2.91, 2.01, 2.02)));
    world.spawn((Name::new("sky"), Background { colour: Rgb::new(0.3, 0.5, 0.8) }));
}

/// A lens wide enough to blur these scenes, of as many units to a unit.
pub fn lens(scale: f64) -> Lens {
    let aperture = Aperture::Radius { radius: 0.125 * scale };
    Lens { aperture, focus_distance: 4.0 * scale, blades: 5, turn: Degrees(10.0) }
}

/// The scene of [`turned`] through a lens, where the camera is a perspective one.
pub fn blurred(setup: Setup) -> World {
    let mut world = turned(setup);
    if setup.eye == Eye::Perspective {
        let camera = named(&mut world, "camera");
        world.entity_mut(camera).insert(lens(setup.scale));
    }
    world
}

/// The scene of [`turned`] while its camera and some of its balls move.
pub fn moving(setup: Setup) -> World {
    let mut world = turned(setup);
    set_in_motion(&mut world, &setup);
    world
}

/// Lets the camera move, and of these things those that there are.
fn set_in_motion(world: &mut World, setup: &Setup) {
    let velocity = |x, y, z| Motion { velocity: DVec3::new(x, y, z) * setup.scale };
    let camera = named(world, "camera");
    world.entity_mut(camera).insert((Shutter { open: 0.0, close: 0.5 }, velocity(0.25, 0.0, -0.125)));
    for (name, motion) in [
        ("ball", velocity(0.5, 0.25, 0.0)),
        ("left ball", velocity(0.5, 0.25, 0.0)),
        ("double", velocity(0.0, 0.5, 0.25)),
        ("coin", velocity(-0.5, 0.0, 0.5)),
        ("mat", velocity(0.0, 0.25, 0.0)),
    ] {
        let mut names = world.query::<(Entity, &Name)>();
        let found = names.iter(world).find(|(_, own)| own.as_str() == name).map(|(entity, _)| entity);
        if let Some(entity) = found {
            world.entity_mut(entity).insert(motion);
        }
    }
}

/// The textured scene by a fisheye that sees more than half of all directions.
pub fn fisheye(setup: Setup) -> World {
    other_camera(setup, FisheyeCamera { fov: Degrees(200.0), axis: FovAxis::Smaller })
}

/// The textured scene in all directions.
pub fn all_round(setup: Setup) -> World {
    other_camera(setup, EquirectangularCamera)
}

fn other_camera(setup: Setup, camera: impl Component) -> World {
    let mut world = textured(Setup { eye: Eye::Perspective, ..setup });
    let own = named(&mut world, "camera");
    world.entity_mut(own).remove::<PerspectiveCamera>().insert(camera);
    world
}

/// Spheres that their placements stretch: an egg, a mirrored and turned pancake, a needle, one that a parent shears, and
/// two that are the same; no sphere among them stays one.
///
/// All places lie on the grid of [`full`], so that it may be moved exactly; nothing but the scale is in scene units.
pub fn stretched(setup: Setup) -> World {
    let mut world = World::new();
    let look = LookAt { eye: setup.point(0.23, 1.03, 4.9), target: setup.point(0.01, 0.77, 0.02), up: DVec3::Y };
    setup.camera(&mut world, look);
    let matte = |r, g, b| Matte { colour: Rgb::new(r, g, b) };
    let sphere = Sphere { radius: 0.5 * setup.scale };
    let tilt = DQuat::from_xyzw(0.5, -0.1, 0.7, 0.5).normalize();
    let placed = |at, scale, orientation| setup.placed(at, scale, orientation);
    let upright = DQuat::IDENTITY;
    let egg = placed([-1.27, 1.02, 0.53], [1.0, 1.5, 1.0], upright);
    let pancake = placed([0.29, 0.5, 1.09], [-2.0, 0.25, 1.5], tilt);
    let needle = placed([1.2, 1.31, 0.33], [0.01, 3.0, 0.01], tilt);
    let ground = placed([0.0, 0.017, 0.0], [1.0, 3.0, -2.0], upright);
    world.spawn((Name::new("ground"), Plane::default(), ground, matte(0.6, 0.6, 0.6)));
    world.spawn((Name::new("egg"), sphere, egg, matte(0.9, 0.7, 0.2)));
    world.spawn((Name::new("pancake"), sphere, pancake, matte(0.2, 0.5, 0.9)));
    world.spawn((Name::new("double"), sphere, pancake, matte(0.9, 0.1, 0.1)));
    world.spawn((Name::new("needle"), sphere, needle, matte(0.5, 0.9, 0.5)));
    pipe_hat_and_ring(&mut world, setup);
    world.spawn((
        Name::new("gem"),
        gem(setup),
        placed([-0.35, 0.45, 1.6], [-1.0, 1.5, 1.0], tilt),
        matte(0.5, 0.9, 0.8),
    ));
    let group = world.spawn((Name::new("group"), placed([1.7, 0.6, -0.9], [1.0, -2.0, 1.0], upright))).id();
    let turned = Placement { orientation: tilt, ..Placement::default() };
    world.spawn((Name::new("sheared"), sphere, turned, matte(0.7, 0.2, 0.9), ChildOf(group)));
    world.spawn((Name::new("lamp"), setup.light(60.0, true), placed([2.51, 4.02, 3.03], [1.0; 3], upright)));
    world.spawn((Name::new("fill"), setup.light(15.0, false), placed([-2.91, 2.01, 2.02], [1.0; 3], upright)));
    world.spawn((Name::new("sky"), Background { colour: Rgb::new(0.3, 0.5, 0.8) }));
    lit_by_lights_alone(world)
}

/// A tube without caps, a cone and a torus.
fn pipe_hat_and_ring(world: &mut World, setup: Setup) {
    let matte = |r, g, b| Matte { colour: Rgb::new(r, g, b) };
    let tilt = DQuat::from_xyzw(0.5, -0.1, 0.7, 0.5).normalize();
    let pipe = setup.placed([-2.1, 0.9, -0.3], [1.0, 1.5, -1.0], tilt);
    let cylinder = Cylinder { radius: 0.25 * setup.scale, height: 0.8 * setup.scale, capped: false };
    world.spawn((Name::new("pipe"), cylinder, pipe, matte(0.2, 0.6, 0.3)));
    let hat = setup.placed([1.9, 0.83, 0.6], [1.0; 3], DQuat::IDENTITY);
    let cone = Cone { radius: 0.35 * setup.scale, height: 1.6 * setup.scale, capped: true };
    world.spawn((Name::new("hat"), cone, hat, matte(0.5, 0.3, 0.6)));
    let ring = setup.placed([-0.3, 1.5, 0.2], [1.0, 0.5, 1.0], tilt);
    let torus = Torus { radius: 0.4 * setup.scale, tube: 0.125 * setup.scale };
    world.spawn((Name::new("ring"), torus, ring, matte(0.7, 0.6, 0.5)));
}

/// Disks, rectangles and cuboids: stretched, mirrored and turned ones, one of each that a parent shears, pairs that are the
/// same, and an edge that two share; nothing else.
///
/// All places lie on the grid of [`full`], so that it may be moved exactly; nothing but the scale is in scene units.
pub fn shapes_of_all_kinds(setup: Setup) -> World {
    let mut world = World::new();
    let look = LookAt { eye: setup.point(0.23, 1.53, 4.9), target: setup.point(0.01, 0.77, 0.02), up: DVec3::Y };
    setup.camera(&mut world, look);
    let matte = |r, g, b| Matte { colour: Rgb::new(r, g, b) };
    let disk = |radius: f64| Disk { radius: radius * setup.scale };
    let rectangle = |width: f64, depth: f64| Rectangle { width: width * setup.scale, depth: depth * setup.scale };
    let cuboid = |x: f64, y: f64, z: f64| Cuboid { size: DVec3::new(x, y, z) * setup.scale };
    let tilt = DQuat::from_xyzw(0.5, -0.1, 0.7, 0.5).normalize();
    let upright = DQuat::IDENTITY;
    let placed = |at, scale, orientation| setup.placed(at, scale, orientation);
    let floor = placed([0.0, 0.017, 0.0], [1.0, -3.0, 1.0], upright);
    world.spawn((Name::new("floor"), rectangle(7.0, 5.0), floor, matte(0.6, 0.6, 0.6)));
    let brick = placed([-1.27, 0.55, 0.53], [-1.0, 1.5, 1.0], tilt);
    world.spawn((Name::new("brick"), cuboid(1.0, 0.5, 0.7), brick, matte(0.9, 0.7, 0.2)));
    world.spawn((Name::new("double brick"), cuboid(1.0, 0.5, 0.7), brick, matte(0.9, 0.1, 0.1)));
    let coin = placed([0.29, 0.8, 1.09], [-1.0, 1.0, 0.5], tilt);
    world.spawn((Name::new("coin"), disk(0.5), coin, matte(0.2, 0.5, 0.9)));
    world.spawn((Name::new("double coin"), disk(0.5), coin, matte(0.1, 0.9, 0.1)));
    for x in [0.75, 1.25] {
        let tile = placed([x, 0.5, -0.75], [1.0, 1.0, -1.0], upright);
        world.spawn((Name::new("tile"), rectangle(0.5, 0.5), tile, matte(x - 0.5, 0.7, 0.3)));
    }
    pipe_hat_and_ring(&mut world, setup);
    let group = world.spawn((Name::new("group"), placed([1.7, 0.6, -0.9], [1.0, -2.0, 0.5], upright))).id();
    let turned = |x| Placement { orientation: tilt, position: DVec3::X * x * setup.scale, ..Placement::default() };
    world.spawn((Name::new("sheared brick"), cuboid(0.5, 0.5, 0.5), turned(0.0), matte(0.7, 0.2, 0.9), ChildOf(group)));
    world.spawn((Name::new("sheared coin"), disk(0.25), turned(0.75), matte(0.7, 0.9, 0.2), ChildOf(group)));
    world.spawn((Name::new("sheared tile"), rectangle(0.5, 0.25), turned(-0.75), matte(0.2, 0.9, 0.9), ChildOf(group)));
    world.spawn((Name::new("lamp"), setup.light(60.0, true), placed([2.51, 4.02, 3.03], [1.0; 3], upright)));
    world.spawn((Name::new("fill"), setup.light(15.0, false), placed([-2.91, 2.01, 2.02], [1.0; 3], upright)));
    world.spawn((Name::new("sky"), Background { colour: Rgb::new(0.3, 0.5, 0.8) }));
    lit_by_lights_alone(world)
}

/// A small octahedron whose vertices have normals.
fn gem(setup: Setup) -> MeshInstance {
    let mut octahedron = (*MeshGeometry::default()).clone();
    octahedron.normals = Some(octahedron.positions.clone());
    let mut gem = MeshInstance { geometry: MeshGeometry::new(octahedron) };
    gem.scale(0.25 * setup.scale);
    gem
}

/// Surfaces with highlights and surfaces that emit light, alone and beside a material, of their own and by the material
/// that they use, under a lamp, two suns and two spots, one of each without shadows.
///
/// All places lie on the grid of [`full`], so that it may be moved exactly.
pub fn shining(setup: Setup) -> World {
    let mut world = World::new();
    let look = LookAt { eye: setup.point(0.23, 1.43, 4.9), target: setup.point(0.01, 0.77, 0.02), up: DVec3::Y };
    setup.camera(&mut world, look);
    let at = |x, y, z| Placement { position: setup.point(x, y, z), ..Placement::default() };
    let sphere = |radius: f64| Sphere { radius: radius * setup.scale };
    let (colour, specular) = (Rgb::new(0.5, 0.2, 0.1), Rgb::new(0.3, 0.4, 0.5));
    let glow = |r, g, b| Emissive { radiance: Rgb::new(r, g, b), ..Emissive::default() };
    let gold = (Name::new("gold"), Phong { colour, specular, exponent: 9.5 }, glow(0.05, 0.0, 0.1));
    let gold = world.spawn(gold).id();
    world.spawn((Name::new("matte ball"), sphere(0.5), at(-1.77, 0.5, 0.53), Matte { colour }, glow(0.0, 0.1, 0.0)));
    world.spawn((Name::new("golden ball"), sphere(0.6), at(-0.5, 0.6, 0.3), UsesMaterial(gold)));
    let satin = BlinnPhong { colour, specular, exponent: 70.0 };
    world.spawn((Name::new("satin ball"), sphere(0.6), at(0.8, 0.6, 0.3), satin));
    world.spawn((Name::new("glow"), sphere(0.25), at(1.51, 0.25, 1.2), glow(0.5, 0.4, 0.1)));
    let ember = world.spawn((Name::new("ember"), glow(0.3, 0.1, 0.0))).id();
    world.spawn((Name::new("coal"), sphere(0.2), at(-1.03, 0.2, 1.3), UsesMaterial(ember)));
    let floor = Phong { colour: Rgb::grey(0.3), specular: Rgb::grey(0.3), exponent: 300.0 };
    world.spawn((Name::new("floor"), Plane::default(), at(0.0, 0.017, 0.0), floor));
    world.spawn((Name::new("lamp"), setup.light(20.0, true), at(2.51, 4.02, 3.03)));
    let towards = |eye: [f64; 3], target: [f64; 3]| LookAt {
        eye: setup.point(eye[0], eye[1], eye[2]),
        target: setup.point(target[0], target[1], target[2]),
        up: DVec3::Y,
    };
    for (name, x, casts_shadows) in [("sun", 3.0, true), ("sky light", -3.0, false)] {
        let sun = DirectionalLight { irradiance: Rgb::new(0.4, 0.5, 0.6), casts_shadows };
        world.spawn((Name::new(name), sun, towards([x, 5.0, 2.0], [0.0, 0.0, 0.0])));
    }
    for (name, x, casts_shadows) in [("spot", 1.3, true), ("second spot", -1.2, false)] {
        let intensity = Rgb::new(20.0, 15.0, 9.0);
        let Rgb { r, g, b } = intensity;
        let strength = setup.scale * setup.scale;
        let intensity = Rgb::new(r * strength, g * strength, b * strength);
        let (inner_angle, outer_angle) = (Degrees(12.0), Degrees(38.0));
        let spot = SpotLight { intensity, inner_angle, outer_angle, casts_shadows };
        world.spawn((Name::new(name), spot, towards([x, 4.1, 2.3], [x * 0.5, 0.1, 0.4])));
    }
    world.spawn((Name::new("sky"), Background { colour: Rgb::new(0.1, 0.2, 0.3) }));
    world
}

/// A triangle of about this size that faces the viewer, with normals of its own.
pub fn leaning_triangle(size: f64) -> Triangle {
    let corners = [[0.0, 0.0, 0.0], [0.875, 0.125, 0.25], [0.25, 0.9375, -0.125]];
    let normals = [[-0.5, -0.25, 1.0], [0.5, 0.0, 1.0], [0.0, 0.5, 1.0]].map(DVec3::from);
    Triangle { vertices: corners.map(|corner| DVec3::from(corner) * size), normals: Some(normals), uvs: None }
}

/// How many pixels of [`ties`] see a ball and the pane at the very same distance.
pub const TIED_PIXELS: usize = 8;

/// Eight balls whose tops touch a pane from behind, each top at the very centre of a pixel, half of them made before the
/// pane and half after: at those pixels a sphere and a plane are hit at the same distance, and the lower number wins.
pub fn ties() -> World {
    let mut world = World::new();
    let size = [32, 32];
    world.spawn((
        Name::new("camera"),
        OrthographicCamera { view_height: 4.0 },
        Placement::at(0.0, 0.0, 5.0),
        Resolution { width: size[0], height: size[1] },
    ));
    let ball = |world: &mut World, number: u32| {
        let x = f64::from(number % 4) - 1.5 + 1.0 / 16.0;
        let y = f64::from(number / 4) - 0.5 + 1.0 / 16.0;
        let matte = Matte { colour: Rgb::new(1.0, 0.0, 0.0) };
        world.spawn((Name::new("ball"), Sphere { radius: 0.25 }, Placement::at(x, y, -0.25), matte));
    };
    (0..4).for_each(|number| ball(&mut world, number));
    let pane = Plane { normal: DVec3::Z };
    world.spawn((Name::new("pane"), pane, Placement::default(), Matte { colour: Rgb::new(0.0, 1.0, 0.0) }));
    (4..8).for_each(|number| ball(&mut world, number));
    world
}

/// The first entity of a name.
pub fn named(world: &mut World, name: &str) -> Entity {
    let mut names = world.query::<(Entity, &Name)>();
    let found = names.iter(world).find(|(_, own)| own.as_str() == name);
    found.map(|(entity, _)| entity).expect("the scene has an entity of this name")
}

/// Renders by these stages, or says why not.
pub fn film_by(scene: &World, offer: &[Stage], execution: &Execution) -> pinhole::Result<FilmBits> {
    render(scene, offer, execution, &()).map(|rendered| FilmBits::of(&rendered.film))
}

/// Renders in one world on one thread, the quickest for a small picture.
pub fn film(scene: &World) -> FilmBits {
    film_by(scene, &offer(), &one_world()).expect("the scene renders")
}

/// One world, no pool of workers.
pub fn one_world() -> Execution {
    Execution { worlds: Worlds::One, ..Execution::default() }
}
