//! The scenes that are refused, and the fields that refuse NaN.

use crate::scenes::{Eye, named};
use bevy_ecs::prelude::*;
use glam::{DQuat, DVec2, DVec3};
use pinhole::scene::*;

/// A scene with one of each kind, all well.
pub fn good(eye: Eye) -> World {
    let mut world = World::new();
    let resolution = Resolution { width: 16, height: 9 };
    let mut camera = world.spawn((Name::new("main"), resolution, Placement::at(0.0, 1.0, 5.0)));
    match eye {
        Eye::Perspective => camera.insert(PerspectiveCamera::default()),
        Eye::Orthographic => camera.insert(OrthographicCamera::default()),
    };
    world.spawn((Name::new("ball"), Sphere::default(), Matte::default(), Placement::at(0.0, 1.0, 0.0)));
    world.spawn((Name::new("floor"), Plane::default(), Matte::default()));
    let normals = Some([DVec3::Z, DVec3::new(0.5, 0.0, 1.0), DVec3::new(0.0, 0.5, 1.0)]);
    let sail = Triangle { normals, uvs: Some([DVec2::ZERO, DVec2::X, DVec2::ONE]), ..Triangle::default() };
    world.spawn((Name::new("sail"), sail, Matte::default(), Placement::at(-2.0, 0.0, 0.0)));
    world.spawn((Name::new("lamp"), PointLight::default(), Placement::at(2.0, 4.0, 2.0)));
    world.spawn((Name::new("glossy"), Sphere { radius: 0.5 }, Phong::default(), Placement::at(-2.0, 1.0, 0.0)));
    world.spawn((Name::new("satin"), Sphere { radius: 0.5 }, BlinnPhong::default(), Placement::at(2.0, 1.0, 0.0)));
    world.spawn((Name::new("glow"), Sphere { radius: 0.25 }, Emissive::default(), Placement::at(0.0, 2.5, 0.0)));
    world.spawn((Name::new("sun"), DirectionalLight::default()));
    world.spawn((Name::new("spot"), SpotLight::default(), Placement::at(0.0, 1.0, 4.0)));
    world.spawn((Name::new("sky"), Background { colour: Rgb::grey(0.5) }));
    world
}

pub fn look_at(world: &mut World, look: LookAt) {
    let camera = named(world, "main");
    world.entity_mut(camera).insert((Placement::default(), look));
}

pub fn edit<C: Component<Mutability = bevy_ecs::component::Mutable>>(
    world: &mut World,
    name: &str,
    change: impl FnOnce(&mut C),
) {
    let entity = named(world, name);
    change(&mut world.get_mut::<C>(entity).expect("the entity has the component"));
}

pub fn put(world: &mut World, name: &str, bundle: impl Bundle) {
    let entity = named(world, name);
    world.entity_mut(entity).insert(bundle);
}

pub fn child_of(world: &mut World, child: &str, parent: Entity) {
    put(world, child, ChildOf(parent));
}

/// What is wrong, in words; the words that the refusal must hold; how to make it so.
pub type Case = (&'static str, &'static [&'static str], fn(&mut World));

pub const CAMERAS: &[Case] = &[
    ("no camera", &["camera", "missing", "PerspectiveCamera"], |w| {
        let camera = named(w, "main");
        w.despawn(camera);
    }),
    ("the only camera disabled", &["camera is \"main\", which is disabled"], |w| put(w, "main", Disabled)),
    ("no samples", &["\"main\"", "samples", "is 0,", "1 to 16777216"], |w| {
        put(w, "main", Sampling { samples: 0, ..Sampling::default() });
    }),
    ("more samples than a number tells apart", &["\"main\"", "samples", "16777217", "1 to 16777216"], |w| {
        put(w, "main", Sampling { samples: (1 << 24) + 1, ..Sampling::default() });
    }),
    ("a filter of no width", &["\"main\"", "filter radius", "is 0,", "0.015625 to 64"], |w| {
        filter(w, Filter::Tent { radius: 0.0 });
    }),
    ("a bell wider than its filter", &["\"main\"", "filter sigma", "is 20,", "0.1875 to 12"], |w| {
        filter(w, Filter::Gaussian { radius: 1.5, sigma: 20.0 });
    }),
    ("two cameras", &["camera", "\"main\"", "\"second\""], |w| {
        w.spawn((Name::new("second"), PerspectiveCamera::default()));
    }),
    ("two cameras, one unnamed", &["camera", "\"main\"", "(unnamed, entity "], |w| {
        w.spawn(OrthographicCamera::default());
    }),
    ("adaptive without sampling", &["\"main\"", "adaptive", "Sampling"], |w| put(w, "main", Adaptive::default())),
    ("an error of 0", &["\"main\"", "error", "above 0"], |w| {
        put(w, "main", (Sampling::default(), Adaptive { error: 0.0, ..Adaptive::default() }))
    }),
    ("an error that is NaN", &["\"main\"", "error", "NaN"], |w| {
        put(w, "main", (Sampling::default(), Adaptive { error: f64::NAN, ..Adaptive::default() }))
    }),
    ("a pilot of 3", &["\"main\"", "pilot", "3", "from 4"], |w| {
        put(w, "main", (Sampling::default(), Adaptive { pilot: 3, ..Adaptive::default() }))
    }),
    ("no layers", &["\"main\"", "kinds", "empty"], |w| put(w, "main", Layers::default())),
    ("layers twice", &["layers", "\"main\"", "\"ball\""], |w| {
        put(w, "main", Layers::all());
        put(w, "ball", Layers::all());
    }),
    ("both kinds on one", &["camera", "PerspectiveCamera and an OrthographicCamera", "\"main\""], |w| {
        put(w, "main", OrthographicCamera::default())
    }),
    ("fov 0", &["\"main\"", "fov", "0°"], |w| edit::<PerspectiveCamera>(w, "main", |c| c.fov = Degrees(0.0))),
    ("fov 180", &["\"main\"", "fov", "180°"], |w| edit::<PerspectiveCamera>(w, "main", |c| c.fov = Degrees(180.0))),
    ("fov −5", &["\"main\"", "fov", "-5°"], |w| edit::<PerspectiveCamera>(w, "main", |c| c.fov = Degrees(-5.0))),
    ("fov 1e300", &["\"main\"", "fov", "1e300°"], |w| {
        edit::<PerspectiveCamera>(w, "main", |c| c.fov = Degrees(1e300));
    }),
    ("fov 1e-4 over 1024 px", &["\"main\"", "fov", "0.0001°", "1024", "rad"], |w| {
        put(w, "main", Resolution { width: 1024, height: 1024 });
        edit::<PerspectiveCamera>(w, "main", |c| c.fov = Degrees(1e-4));
    }),
    ("resolution 0 × 5", &["\"main\"", "resolution", "0 × 5"], |w| {
        put(w, "main", Resolution { width: 0, height: 5 });
    }),
    ("resolution 5 × 0", &["\"main\"", "resolution", "5 × 0"], |w| {
        put(w, "main", Resolution { width: 5, height: 0 });
    }),
    ("resolution 70000 × 1", &["\"main\"", "resolution", "70000 × 1"], |w| {
        put(w, "main", Resolution { width: 70_000, height: 1 });
    }),
    ("resolution 65536 × 65536", &["\"main\"", "resolution", "65536 × 65536"], |w| {
        put(w, "main", Resolution { width: 65_536, height: 65_536 });
    }),
    ("eye at target", &["\"main\"", "target", "(1, 2, 3)"], |w| {
        look_at(w, LookAt { eye: DVec3::new(1.0, 2.0, 3.0), target: DVec3::new(1.0, 2.0, 3.0), up: DVec3::Y });
    }),
    ("up along the view", &["\"main\"", "up", "(0, 2, 0)", "(0, 0, -1) does not"], |w| {
        look_at(w, LookAt { eye: DVec3::new(0.0, 5.0, 0.0), target: DVec3::ZERO, up: 2.0 * DVec3::Y });
    }),
    ("up against the view", &["\"main\"", "up", "(0, 0, -3)"], |w| {
        look_at(w, LookAt { eye: DVec3::ZERO, target: DVec3::Z, up: DVec3::new(0.0, 0.0, -3.0) });
    }),
    ("up of length 0", &["\"main\"", "up", "(0, 0, 0)"], |w| {
        look_at(w, LookAt { up: DVec3::ZERO, ..LookAt::default() })
    }),
    ("LookAt and a set position", &["\"main\"", "position", "(1, 0, 0)", "LookAt"], |w| {
        put(w, "main", (LookAt::default(), Placement::at(1.0, 0.0, 0.0)));
    }),
    ("LookAt and a set orientation", &["\"main\"", "orientation", "(0, 1, 0, 0)", "LookAt"], |w| {
        let orientation = DQuat::from_xyzw(0.0, 1.0, 0.0, 0.0);
        put(w, "main", (LookAt::default(), Placement { orientation, ..Placement::default() }));
    }),
    ("a scaled camera", &["\"main\"", "scale", "(2, 2, 2)"], |w| {
        edit::<Placement>(w, "main", |p| p.scale = DVec3::splat(2.0));
    }),
    ("a mirrored camera", &["\"main\"", "scale is (-1, 1, 1), which mirrors"], |w| {
        edit::<Placement>(w, "main", |p| p.scale = DVec3::new(-1.0, 1.0, 1.0));
    }),
    ("a camera scaled by its parent", &["\"main\"", "scale", "(1, 3, 1)"], |w| {
        let scale = DVec3::new(1.0, 3.0, 1.0);
        let parent = w.spawn(Placement { scale, ..Placement::default() }).id();
        child_of(w, "main", parent);
    }),
    ("a camera mirrored by its parent", &["\"main\"'s parent", "scale is (-1, -1, -1), which mirrors"], |w| {
        let parent = w.spawn(Placement { scale: DVec3::splat(-1.0), ..Placement::default() }).id();
        child_of(w, "main", parent);
    }),
    ("two views", &["view", "\"main\"", "\"floor\""], |w| {
        put(w, "main", View { column: "hit".into() });
        put(w, "floor", View { column: "ndc".into() });
    }),
];

pub const SHAPES: &[Case] = &[
    ("orientation 0", &["\"ball\"", "orientation", "(0, 0, 0, 0)", "other than 0"], |w| {
        edit::<Placement>(w, "ball", |p| p.orientation = DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0));
    }),
    ("orientation about no axis", &["\"ball\"", "orientation", "NaN", "axis other than 0"], |w| {
        edit::<Placement>(w, "ball", |p| p.orientation = axis_angle(DVec3::ZERO, Degrees(30.0)));
    }),
    ("scale 0", &["\"floor\"", "scale", "(1, 0, 1)"], |w| {
        edit::<Placement>(w, "floor", |p| p.scale = DVec3::new(1.0, 0.0, 1.0));
    }),
    ("scale so small that it vanishes", &["\"floor\"", "placement"], |w| {
        edit::<Placement>(w, "floor", |p| p.scale = DVec3::splat(1e-200));
    }),
    ("position out of reach", &["\"ball\"", "position", "1e300"], |w| {
        edit::<Placement>(w, "ball", |p| p.position = DVec3::splat(1e300));
    }),
    ("a parent that is its own child", &["\"ball\"", "parent", "circle through \"ball\""], |w| {
        let (ball, floor) = (named(w, "ball"), named(w, "floor"));
        child_of(w, "ball", floor);
        child_of(w, "floor", ball);
    }),
    ("ancestors in a circle", &["\"ball\"", "parent", "circle through \"group\""], |w| {
        let group = w.spawn((Name::new("group"), Placement::default())).id();
        let second = w.spawn((Placement::default(), ChildOf(group))).id();
        w.entity_mut(group).insert(ChildOf(second));
        child_of(w, "ball", group);
    }),
    ("a parent with scale 0", &["\"ball\"", "parent", "\"group\"", "scale", "(1, 0, 1)"], |w| {
        let scale = DVec3::new(1.0, 0.0, 1.0);
        let group = w.spawn((Name::new("group"), Placement { scale, ..Placement::default() })).id();
        child_of(w, "ball", group);
    }),
    ("scales that vanish together", &["\"floor\"", "placement"], |w| {
        let mut parent = w.spawn(Placement::default()).id();
        for _ in 0..8 {
            let place = Placement { scale: DVec3::splat(1e-17), ..Placement::default() };
            parent = w.spawn((place, ChildOf(parent))).id();
        }
        child_of(w, "floor", parent);
    }),
    ("radius 0", &["\"ball\"", "radius", "is 0,"], |w| edit::<Sphere>(w, "ball", |s| s.radius = 0.0)),
    ("radius −1", &["\"ball\"", "radius", "is -1,"], |w| edit::<Sphere>(w, "ball", |s| s.radius = -1.0)),
    ("radius 1e300", &["\"ball\"", "radius", "is 1e300,"], |w| edit::<Sphere>(w, "ball", |s| s.radius = 1e300)),
    ("radius too small", &["\"ball\"", "radius", "is 1e-40,"], |w| edit::<Sphere>(w, "ball", |s| s.radius = 1e-40)),
    ("radius −1, scaled", &["\"ball\"", "radius", "is -1,"], |w| {
        edit::<Sphere>(w, "ball", |s| s.radius = -1.0);
        edit::<Placement>(w, "ball", |p| p.scale = DVec3::splat(2.0));
    }),
    ("radius out of reach by its scale", &["\"ball\"", "radius", "is 1e17 scaled by 1000,"], |w| {
        edit::<Sphere>(w, "ball", |s| s.radius = 1e17);
        edit::<Placement>(w, "ball", |p| p.scale = DVec3::splat(1e3));
    }),
    ("a sphere stretched too far", &["\"ball\"", "scale", "(1, -200000000, 1)", "1e7 times"], |w| {
        edit::<Placement>(w, "ball", |p| p.scale = DVec3::new(1.0, -2e8, 1.0));
    }),
    ("a sphere flattened by its parent", &["\"ball\"", "scale", "1.0e8 times as long"], |w| {
        let parent = w.spawn(Placement { scale: DVec3::new(1.0, 1e-8, 1.0), ..Placement::default() }).id();
        edit::<Placement>(w, "ball", |p| p.orientation = DQuat::from_xyzw(0.5, 0.5, 0.5, 0.5));
        child_of(w, "ball", parent);
    }),
    ("half axes out of reach", &["\"ball\"", "longest half axis", "is 1e20,"], |w| {
        edit::<Sphere>(w, "ball", |s| s.radius = 1e17);
        edit::<Placement>(w, "ball", |p| p.scale = DVec3::new(1e3, 1.0, 1.0));
    }),
    ("half axes too short", &["\"ball\"", "shortest half axis", "it must be a length"], |w| {
        edit::<Sphere>(w, "ball", |s| s.radius = 1e-17);
        edit::<Placement>(w, "ball", |p| p.scale = DVec3::new(1.0, 1.0, 1e-3));
    }),
    ("a flat sphere", &["\"ball\"", "scale", "(1, 0, 1)", "invertible"], |w| {
        edit::<Placement>(w, "ball", |p| p.scale = DVec3::new(1.0, 0.0, 1.0));
    }),
    ("radius −1, scaled unevenly", &["\"ball\"", "radius", "is -1,"], |w| {
        edit::<Sphere>(w, "ball", |s| s.radius = -1.0);
        edit::<Placement>(w, "ball", |p| p.scale = DVec3::new(1.0, 2.0, 1.0));
    }),
    ("normal 0", &["\"floor\"", "normal", "(0, 0, 0)"], |w| edit::<Plane>(w, "floor", |p| p.normal = DVec3::ZERO)),
    ("two shapes on one entity", &["\"ball\"", "Sphere and Plane"], |w| put(w, "ball", Plane::default())),
    ("a disk of radius 0", &["disk \"coin\"", "radius", "is 0,"], |w| coin(w, Disk { radius: 0.0 })),
    ("a width of −1", &["rectangle \"coin\"", "width", "is -1,"], |w| coin(w, Rectangle { width: -1.0, depth: 1.0 })),
    ("a depth of 1e300", &["rectangle \"coin\"", "depth", "is 1e300,"], |w| {
        coin(w, Rectangle { width: 1.0, depth: 1e300 });
    }),
    ("a cuboid without height", &["cuboid \"coin\"", "size", "(1, 0, 2)", "each part must be a length"], |w| {
        coin(w, Cuboid { size: DVec3::new(1.0, 0.0, 2.0) });
    }),
    ("a cuboid like a hair", &["cuboid \"coin\"", "size", "(1, 200000000, 1)", "1e7 times"], |w| {
        coin(w, Cuboid { size: DVec3::new(1.0, 2e8, 1.0) });
    }),
    ("a cuboid out of reach by its scale", &["\"coin\"", "longest placed edge", "it must be a length"], |w| {
        coin(w, Cuboid { size: DVec3::splat(1e17) });
        edit::<Placement>(w, "coin", |p| p.scale = DVec3::splat(1e5));
    }),
    ("a disk out of reach by its scale", &["\"coin\"", "placed size", "it must be a length"], |w| {
        coin(w, Disk { radius: 1e17 });
        edit::<Placement>(w, "coin", |p| p.scale = DVec3::new(1e5, 1.0, 1.0));
    }),
    ("a disk and a cuboid", &["\"coin\"", "Disk and Cuboid"], |w| {
        coin(w, Disk::default());
        put(w, "coin", Cuboid::default());
    }),
    ("a sphere and a triangle", &["\"ball\"", "Sphere and Triangle"], |w| put(w, "ball", Triangle::default())),
    ("corners on one line", &["triangle \"sail\"", "vertices", "(0, 0, 0), (1, 1, 1), (3, 3, 3)", "one line"], |w| {
        edit::<Triangle>(w, "sail", |t| t.vertices = [DVec3::ZERO, DVec3::ONE, DVec3::splat(3.0)]);
    }),
    ("corners on one line but for rounding", &["\"sail\"", "vertices", "(0.1, 0.2, 0.3)", "one line"], |w| {
        let corners = [DVec3::ZERO, DVec3::new(0.1, 0.2, 0.3), DVec3::new(1.0, 2.0, 3.0)];
        edit::<Triangle>(w, "sail", |t| t.vertices = corners);
    }),
    ("two corners in one place", &["\"sail\"", "vertices", "one line"], |w| {
        edit::<Triangle>(w, "sail", |t| t.vertices[1] = t.vertices[2]);
    }),
    ("three corners in one place", &["\"sail\"", "vertices", "(7, 7, 7), (7, 7, 7), (7, 7, 7)"], |w| {
        edit::<Triangle>(w, "sail", |t| t.vertices = [DVec3::splat(7.0); 3]);
    }),
    ("a corner out of reach", &["\"sail\"", "vertices", "(1, 1e19, 0)", "1e18"], |w| {
        edit::<Triangle>(w, "sail", |t| t.vertices[1].y = 1e19);
    }),
    ("a corner out of reach by its placement", &["\"sail\"", "vertices", "1e18"], |w| {
        edit::<Triangle>(w, "sail", |t| t.vertices[1].y = 1e12);
        edit::<Placement>(w, "sail", |p| p.scale = DVec3::splat(1e10));
    }),
    ("a normal of length 0", &["\"sail\"", "normals", "(0, 0, 0)", "direction other than 0"], |w| {
        edit::<Triangle>(w, "sail", |t| t.normals = Some([DVec3::Z, DVec3::ZERO, DVec3::Z]));
    }),
    ("normals to both sides", &["\"sail\"", "normals", "(0, 0, -1)", "one side"], |w| {
        edit::<Triangle>(w, "sail", |t| t.normals = Some([DVec3::Z, DVec3::Z, DVec3::NEG_Z]));
    }),
    ("a normal along the triangle", &["\"sail\"", "normals", "(1, 0, 0)", "one side"], |w| {
        edit::<Triangle>(w, "sail", |t| t.normals = Some([DVec3::Z, DVec3::Z, DVec3::X]));
    }),
    ("an unnamed sphere", &["(unnamed, entity ", "radius", "-2"], |w| {
        w.spawn((Sphere { radius: -2.0 }, Matte::default()));
    }),
];

/// A further shape.
fn coin(w: &mut World, shape: impl Bundle) {
    w.spawn((Name::new("coin"), shape, Matte::default()));
}

pub const MATERIAL: &[Case] = &[
    ("no material", &["\"ball\"", "material", "missing", "Matte"], |w| {
        let ball = named(w, "ball");
        w.entity_mut(ball).remove::<Matte>();
    }),
    ("two materials", &["\"ball\"", "material", "twice", "\"floor\""], |w| {
        let floor = named(w, "floor");
        put(w, "ball", UsesMaterial(floor));
    }),
    ("a material that is none", &["\"ball\"", "material", "\"lamp\"", "Matte"], |w| {
        let (ball, lamp) = (named(w, "ball"), named(w, "lamp"));
        w.entity_mut(ball).remove::<Matte>().insert(UsesMaterial(lamp));
    }),
    ("a material that is disabled", &["\"ball\"", "material", "\"gold\"", "disabled"], |w| {
        let gold = w.spawn((Name::new("gold"), Matte::default(), Disabled)).id();
        let ball = named(w, "ball");
        w.entity_mut(ball).remove::<Matte>().insert(UsesMaterial(gold));
    }),
    ("colour 1.5", &["\"ball\"", "colour", "(1.5, 0, 0)"], |w| {
        edit::<Matte>(w, "ball", |m| m.colour = Rgb::new(1.5, 0.0, 0.0));
    }),
    ("colour −0.1", &["\"ball\"", "colour", "(0, -0.1, 0)"], |w| {
        edit::<Matte>(w, "ball", |m| m.colour = Rgb::new(0.0, -0.1, 0.0));
    }),
    ("intensity −1", &["\"lamp\"", "intensity", "(0, 0, -1)"], |w| {
        edit::<PointLight>(w, "lamp", |l| l.intensity = Rgb::new(0.0, 0.0, -1.0));
    }),
    ("intensity 1e300", &["\"lamp\"", "intensity", "1e300"], |w| {
        edit::<PointLight>(w, "lamp", |l| l.intensity = Rgb::grey(1e300));
    }),
    ("two kinds of material", &["\"ball\"", "Matte and BlinnPhong at once", "one material only"], |w| {
        put(w, "ball", BlinnPhong::default());
    }),
    ("a Phong of its own and one that is used", &["\"glossy\"", "material", "twice", "\"floor\""], |w| {
        let floor = named(w, "floor");
        put(w, "glossy", UsesMaterial(floor));
    }),
    ("more than all the light", &["\"glossy\"", "specular", "(0, 0.5, 0)", "(0.4, 0.6, 0.4)", "at most 1"], |w| {
        edit::<Phong>(w, "glossy", |p| (p.colour.g, p.specular) = (0.6, Rgb::new(0.0, 0.5, 0.0)));
    }),
    ("more than all the light, Blinn–Phong", &["\"satin\"", "specular", "(1, 1, 1)", "at most 1"], |w| {
        edit::<BlinnPhong>(w, "satin", |p| p.specular = Rgb::grey(1.0));
    }),
    ("specular 1.5", &["\"glossy\"", "specular", "(1.5, 0, 0)", "from 0 to 1"], |w| {
        edit::<Phong>(w, "glossy", |p| p.specular = Rgb::new(1.5, 0.0, 0.0));
    }),
    ("exponent −1", &["\"glossy\"", "exponent", "is -1,", "from 0 to 1e9"], |w| {
        edit::<Phong>(w, "glossy", |p| p.exponent = -1.0);
    }),
    ("exponent 1e10", &["\"satin\"", "exponent", "is 1e10,", "from 0 to 1e9"], |w| {
        edit::<BlinnPhong>(w, "satin", |p| p.exponent = 1e10);
    }),
    ("a mirror brighter than its light", &["mirror \"coating\"", "colour", "(1.1, 1.1, 1.1)", "from 0 to 1"], |w| {
        material(w, Mirror { colour: Rgb::grey(1.1) });
    }),
    ("an index of refraction of 0", &["glass \"coating\"", "ior", "is 0,", "from 0.001 to 1000"], |w| {
        material(w, Glass { ior: 0.0, ..Glass::default() });
    }),
    ("an index of refraction of −1.5", &["glass \"coating\"", "ior", "is -1.5,"], |w| {
        material(w, Glass { ior: -1.5, ..Glass::default() });
    }),
    ("glass that gives light", &["glass \"coating\"", "absorption", "(0, -1, 0)", "from 0"], |w| {
        material(w, Glass { absorption: Rgb::new(0.0, -1.0, 0.0), ..Glass::default() });
    }),
    ("metal brighter than its light", &["metal \"coating\"", "colour", "(0, 2, 0)", "from 0 to 1"], |w| {
        material(w, Metal { colour: Rgb::new(0.0, 2.0, 0.0), ..Metal::default() });
    }),
    ("roughness 1.01", &["metal \"coating\"", "roughness", "is 1.01,", "from 0 to 1"], |w| {
        material(w, Metal { roughness: 1.01, ..Metal::default() });
    }),
    ("roughness −0.1", &["metal \"coating\"", "roughness", "is -0.1,"], |w| {
        material(w, Metal { roughness: -0.1, ..Metal::default() });
    }),
    ("a mirror and glass at once", &["\"coating\"", "Mirror and Glass at once", "one material only"], |w| {
        w.spawn((Name::new("coating"), Mirror::default(), Glass::default()));
    }),
    ("a disk of glass", &["disk \"lens\"", "material", "the glass \"lens\"", "an interior", "a sphere"], |w| {
        w.spawn((Name::new("lens"), Disk::default(), Glass::default()));
    }),
    ("a rectangle of used glass", &["rectangle \"window\"", "material", "the glass \"pane\"", "an interior"], |w| {
        let pane = w.spawn((Name::new("pane"), Glass::default())).id();
        w.spawn((Name::new("window"), Rectangle::default(), UsesMaterial(pane)));
    }),
    ("radiance −1", &["\"glow\"", "radiance", "(-1, 0, 0)"], |w| {
        edit::<Emissive>(w, "glow", |e| e.radiance = Rgb::new(-1.0, 0.0, 0.0));
    }),
    ("a used Emissive that is disabled", &["\"coal\"", "material", "\"ember\"", "disabled"], |w| {
        let ember = w.spawn((Name::new("ember"), Emissive::default(), Disabled)).id();
        w.spawn((Name::new("coal"), Sphere::default(), UsesMaterial(ember)));
    }),
    ("irradiance −1", &["\"sun\"", "irradiance", "(0, -1, 0)"], |w| {
        edit::<DirectionalLight>(w, "sun", |l| l.irradiance = Rgb::new(0.0, -1.0, 0.0));
    }),
    ("a spot's intensity 1e300", &["\"spot\"", "intensity", "1e300"], |w| {
        edit::<SpotLight>(w, "spot", |l| l.intensity = Rgb::grey(1e300));
    }),
    ("outer angle 180.1°", &["\"spot\"", "outer_angle", "180.1°", "up to 180°"], |w| {
        edit::<SpotLight>(w, "spot", |l| l.outer_angle = Degrees(180.1));
    }),
    ("outer angle 0°", &["\"spot\"", "outer_angle", "is 0°", "above 0°"], |w| {
        edit::<SpotLight>(w, "spot", |l| l.outer_angle = Degrees(0.0));
    }),
    ("inner angle beyond the outer", &["\"spot\"", "inner_angle", "is 61°", "60°"], |w| {
        edit::<SpotLight>(w, "spot", |l| l.inner_angle = Degrees(61.0));
    }),
    ("inner angle −1°", &["\"spot\"", "inner_angle", "is -1°"], |w| {
        edit::<SpotLight>(w, "spot", |l| l.inner_angle = Degrees(-1.0));
    }),
    ("a flattened sun", &["\"sun\"", "scale", "(1, 1, 0)", "invertible"], |w| {
        put(w, "sun", Placement { scale: DVec3::new(1.0, 1.0, 0.0), ..Placement::default() });
    }),
    ("background −1", &["\"sky\"", "colour", "(-1, 0, 0)"], |w| {
        edit::<Background>(w, "sky", |b| b.colour = Rgb::new(-1.0, 0.0, 0.0));
    }),
    ("two backgrounds", &["background", "\"sky\"", "(unnamed, entity "], |w| {
        w.spawn(Background::default());
    }),
    ("a spare colour of 2", &["\"spare\"", "colour", "(2, 2, 2)"], |w| {
        w.spawn((Name::new("spare"), Matte { colour: Rgb::grey(2.0) }));
    }),
];

pub const ORTHOGRAPHIC: &[Case] = &[
    ("view_height 0", &["\"main\"", "view_height", "is 0,"], |w| {
        edit::<OrthographicCamera>(w, "main", |c| c.view_height = 0.0);
    }),
    ("view_height −1", &["\"main\"", "view_height", "is -1,"], |w| {
        edit::<OrthographicCamera>(w, "main", |c| c.view_height = -1.0);
    }),
];

/// A camera that samples with this filter.
fn filter(world: &mut World, filter: Filter) {
    put(world, "main", Sampling { filter, ..Sampling::default() });
}

/// A material that no shape is made of; it is checked all the same.
fn material(world: &mut World, component: impl Component) {
    world.spawn((Name::new("coating"), component));
}

/// A field of a component, the entity, how to set it.
pub type Field = (&'static str, &'static str, fn(&mut World, f64));

/// Every number that an author writes.
pub const FIELDS: &[Field] = &[
    ("filter radius", "main", |w, v| filter(w, Filter::Box { radius: v })),
    ("filter radius", "main", |w, v| filter(w, Filter::Tent { radius: v })),
    ("filter radius", "main", |w, v| filter(w, Filter::BlackmanHarris { radius: v })),
    ("filter sigma", "main", |w, v| filter(w, Filter::Gaussian { radius: 1.5, sigma: v })),
    ("filter b", "main", |w, v| filter(w, Filter::Mitchell { radius: 2.0, b: v, c: 0.3 })),
    ("filter c", "main", |w, v| filter(w, Filter::Mitchell { radius: 2.0, b: 0.3, c: v })),
    ("fov", "main", |w, v| edit::<PerspectiveCamera>(w, "main", |c| c.fov = Degrees(v))),
    ("eye", "main", |w, v| look_at(w, LookAt { eye: DVec3::new(v, 0.0, 1.0), ..LookAt::default() })),
    ("eye", "main", |w, v| look_at(w, LookAt { eye: DVec3::new(0.0, v, 1.0), ..LookAt::default() })),
    ("eye", "main", |w, v| look_at(w, LookAt { eye: DVec3::new(0.0, 1.0, v), ..LookAt::default() })),
    ("target", "main", |w, v| look_at(w, LookAt { target: DVec3::new(v, 0.0, 1.0), ..LookAt::default() })),
    ("target", "main", |w, v| look_at(w, LookAt { target: DVec3::new(0.0, v, 1.0), ..LookAt::default() })),
    ("target", "main", |w, v| look_at(w, LookAt { target: DVec3::new(0.0, 1.0, v), ..LookAt::default() })),
    ("up", "main", |w, v| look_at(w, LookAt { up: DVec3::new(v, 1.0, 0.0), ..LookAt::default() })),
    ("up", "main", |w, v| look_at(w, LookAt { up: DVec3::new(0.0, v, 0.0), ..LookAt::default() })),
    ("up", "main", |w, v| look_at(w, LookAt { up: DVec3::new(0.0, 1.0, v), ..LookAt::default() })),
    ("position", "main", |w, v| edit::<Placement>(w, "main", |p| p.position.x = v)),
    ("orientation", "main", |w, v| edit::<Placement>(w, "main", |p| p.orientation.x = v)),
    ("orientation", "main", |w, v| edit::<Placement>(w, "main", |p| p.orientation.y = v)),
    ("orientation", "main", |w, v| edit::<Placement>(w, "main", |p| p.orientation.z = v)),
    ("orientation", "main", |w, v| edit::<Placement>(w, "main", |p| p.orientation.w = v)),
    ("scale", "main", |w, v| edit::<Placement>(w, "main", |p| p.scale.x = v)),
    ("position", "ball", |w, v| edit::<Placement>(w, "ball", |p| p.position.x = v)),
    ("position", "ball", |w, v| edit::<Placement>(w, "ball", |p| p.position.y = v)),
    ("position", "ball", |w, v| edit::<Placement>(w, "ball", |p| p.position.z = v)),
    ("scale", "ball", |w, v| edit::<Placement>(w, "ball", |p| p.scale.x = v)),
    ("scale", "ball", |w, v| edit::<Placement>(w, "ball", |p| p.scale.y = v)),
    ("scale", "ball", |w, v| edit::<Placement>(w, "ball", |p| p.scale.z = v)),
    ("radius", "ball", |w, v| edit::<Sphere>(w, "ball", |s| s.radius = v)),
    ("colour", "ball", |w, v| edit::<Matte>(w, "ball", |m| m.colour.r = v)),
    ("colour", "ball", |w, v| edit::<Matte>(w, "ball", |m| m.colour.g = v)),
    ("colour", "ball", |w, v| edit::<Matte>(w, "ball", |m| m.colour.b = v)),
    ("position", "floor", |w, v| edit::<Placement>(w, "floor", |p| p.position.y = v)),
    ("orientation", "floor", |w, v| edit::<Placement>(w, "floor", |p| p.orientation.w = v)),
    ("normal", "floor", |w, v| edit::<Plane>(w, "floor", |p| p.normal.x = v)),
    ("normal", "floor", |w, v| edit::<Plane>(w, "floor", |p| p.normal.y = v)),
    ("normal", "floor", |w, v| edit::<Plane>(w, "floor", |p| p.normal.z = v)),
    ("radius", "coin", |w, v| coin(w, Disk { radius: v })),
    ("width", "coin", |w, v| coin(w, Rectangle { width: v, depth: 1.0 })),
    ("depth", "coin", |w, v| coin(w, Rectangle { width: 1.0, depth: v })),
    ("size", "coin", |w, v| coin(w, Cuboid { size: DVec3::new(v, 1.0, 1.0) })),
    ("size", "coin", |w, v| coin(w, Cuboid { size: DVec3::new(1.0, v, 1.0) })),
    ("size", "coin", |w, v| coin(w, Cuboid { size: DVec3::new(1.0, 1.0, v) })),
    ("vertices", "sail", |w, v| edit::<Triangle>(w, "sail", |t| t.vertices[0].x = v)),
    ("vertices", "sail", |w, v| edit::<Triangle>(w, "sail", |t| t.vertices[2].z = v)),
    ("normals", "sail", |w, v| edit::<Triangle>(w, "sail", |t| t.normals.as_mut().expect("given")[1].y = v)),
    ("uvs", "sail", |w, v| edit::<Triangle>(w, "sail", |t| t.uvs.as_mut().expect("given")[2].x = v)),
    ("position", "lamp", |w, v| edit::<Placement>(w, "lamp", |p| p.position.z = v)),
    ("orientation", "lamp", |w, v| edit::<Placement>(w, "lamp", |p| p.orientation.w = v)),
    ("intensity", "lamp", |w, v| edit::<PointLight>(w, "lamp", |l| l.intensity.r = v)),
    ("intensity", "lamp", |w, v| edit::<PointLight>(w, "lamp", |l| l.intensity.g = v)),
    ("intensity", "lamp", |w, v| edit::<PointLight>(w, "lamp", |l| l.intensity.b = v)),
    ("colour", "glossy", |w, v| edit::<Phong>(w, "glossy", |p| p.colour.r = v)),
    ("specular", "glossy", |w, v| edit::<Phong>(w, "glossy", |p| p.specular.g = v)),
    ("exponent", "glossy", |w, v| edit::<Phong>(w, "glossy", |p| p.exponent = v)),
    ("colour", "satin", |w, v| edit::<BlinnPhong>(w, "satin", |p| p.colour.b = v)),
    ("specular", "satin", |w, v| edit::<BlinnPhong>(w, "satin", |p| p.specular.r = v)),
    ("exponent", "satin", |w, v| edit::<BlinnPhong>(w, "satin", |p| p.exponent = v)),
    ("colour", "coating", |w, v| material(w, Mirror { colour: Rgb::new(0.5, v, 0.5) })),
    ("ior", "coating", |w, v| material(w, Glass { ior: v, ..Glass::default() })),
    ("absorption", "coating", |w, v| material(w, Glass { absorption: Rgb::new(v, 0.0, 0.0), ..Glass::default() })),
    ("colour", "coating", |w, v| material(w, Metal { colour: Rgb::new(0.5, 0.5, v), ..Metal::default() })),
    ("roughness", "coating", |w, v| material(w, Metal { roughness: v, ..Metal::default() })),
    ("radiance", "glow", |w, v| edit::<Emissive>(w, "glow", |e| e.radiance.r = v)),
    ("radiance", "glow", |w, v| edit::<Emissive>(w, "glow", |e| e.radiance.b = v)),
    ("irradiance", "sun", |w, v| edit::<DirectionalLight>(w, "sun", |l| l.irradiance.g = v)),
    ("orientation", "sun", |w, v| edit::<Placement>(w, "sun", |p| p.orientation.x = v)),
    ("intensity", "spot", |w, v| edit::<SpotLight>(w, "spot", |l| l.intensity.r = v)),
    ("inner_angle", "spot", |w, v| edit::<SpotLight>(w, "spot", |l| l.inner_angle = Degrees(v))),
    ("outer_angle", "spot", |w, v| edit::<SpotLight>(w, "spot", |l| l.outer_angle = Degrees(v))),
    ("position", "spot", |w, v| edit::<Placement>(w, "spot", |p| p.position.z = v)),
    ("colour", "sky", |w, v| edit::<Background>(w, "sky", |b| b.colour.r = v)),
    ("colour", "sky", |w, v| edit::<Background>(w, "sky", |b| b.colour.g = v)),
    ("colour", "sky", |w, v| edit::<Background>(w, "sky", |b| b.colour.b = v)),
];
