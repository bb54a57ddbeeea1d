//! Light inside glass and between glass: cameras and lights of every kind among bodies that nest, overlap, touch, are
//! hollow or very thin, against closed forms, and the methods to find light against each other.

use super::*;
use glam::{DQuat, DVec3};
use pinhole::scene::*;
use pinhole_lab::measure::draws::Draws;
use std::f64::consts::PI;

/// A body of glass, and how to tell without the renderer whether a point is in it.
#[derive(Clone, Copy, Debug)]
struct AnyShape {
    kind: &'static str,
    centre: DVec3,
    /// Half extents; the radius of a ball is the first.
    half: DVec3,
    glass: Glass,
}

impl AnyShape {
    /// Whether a point is in the shape, its centre at the origin and its half extents 1.
    fn contains(&self) -> fn(DVec3) -> bool {
        match self.kind {
            "ball" | "ellipsoid" => |p| p.length_squared() < 1.0,
            "box" | "mirrored box" => |p| p.abs().max_element() < 1.0,
            "cylinder" => |p| p.y.abs() < 1.0 && p.x * p.x + p.z * p.z < 1.0,
            "cone" => |p| p.y.abs() < 1.0 && (p.x * p.x + p.z * p.z).sqrt() < 0.5 * (1.0 - p.y),
            "torus" => |p| ((p.x * p.x + p.z * p.z).sqrt() - 0.7).powi(2) + p.y * p.y < 0.09,
            "mesh" | "triangles" | "mirrored triangles" => |p| p.abs().element_sum() < 1.0,
            "sea" => |p| p.y < 0.0,
            other => panic!("{other}"),
        }
    }

    fn spawn(&self, world: &mut World) {
        let mirror = if self.kind.starts_with("mirrored") { DVec3::new(-1.0, 1.0, 1.0) } else { DVec3::ONE };
        let scaled = Placement { position: self.centre, scale: self.half * mirror, ..Placement::default() };
        let at = Placement { position: self.centre, ..Placement::default() };
        match self.kind {
            "ball" => world.spawn((Sphere { radius: self.half.x }, at, self.glass)),
            "ellipsoid" => world.spawn((Sphere { radius: 1.0 }, scaled, self.glass)),
            "box" | "mirrored box" => world.spawn((Cuboid { size: DVec3::splat(2.0) }, scaled, self.glass)),
            "cylinder" => world.spawn((Cylinder { radius: 1.0, height: 2.0, capped: true }, scaled, self.glass)),
            "cone" => world.spawn((Cone { radius: 1.0, height: 2.0, capped: true }, scaled, self.glass)),
            "torus" => world.spawn((Torus { radius: 0.7, tube: 0.3 }, scaled, self.glass)),
            "mesh" => world.spawn((MeshInstance::default(), scaled, self.glass)),
            "sea" => world.spawn((Plane { normal: DVec3::Y }, at, self.glass)),
            "triangles" | "mirrored triangles" => {
                let glass = world.spawn(self.glass).id();
                let body = world.spawn(scaled).id();
                for octant in 0..8_u32 {
                    let side = |bit: u32| if octant >> bit & 1 == 0 { 1.0 } else { -1.0 };
                    let [a, b, c] = [DVec3::X * side(0), DVec3::Y * side(1), DVec3::Z * side(2)];
                    let vertices = if octant.count_ones() % 2 == 0 { [a, b, c] } else { [a, c, b] };
                    world.spawn((Triangle { vertices, ..Triangle::default() }, ChildOf(body), UsesMaterial(glass)));
                }
                world.entity_mut(body)
            }
            other => panic!("{other}"),
        };
    }
}

const KINDS: [&str; 11] = [
    "ball",
    "ellipsoid",
    "box",
    "mirrored box",
    "cylinder",
    "cone",
    "torus",
    "mesh",
    "triangles",
    "mirrored triangles",
    "sea",
];

/// Ink: glass that bends nothing, so that light goes straight through all of it.
fn ink(absorption: [f64; 3], priority: u32) -> Glass {
    Glass { ior: 1.0, absorption: Rgb { r: absorption[0], g: absorption[1], b: absorption[2] }, priority }
}

/// The transmittance from one point to another, and whether any surface lies between, by small steps; the absorption at a
/// point is that of the body of the highest priority, and among equals the first.
fn between(bodies: &[AnyShape], from: DVec3, to: DVec3) -> ([f64; 3], bool) {
    const STEPS: u32 = 1000;
    let mut ranked: Vec<&AnyShape> = bodies.iter().collect();
    ranked.sort_by_key(|body| std::cmp::Reverse(body.glass.priority));
    let contain: Vec<fn(DVec3) -> bool> = ranked.iter().map(|body| body.contains()).collect();
    // How many steps are absorbed by each body.
    let (mut steps, mut crosses) = (vec![0_u32; ranked.len()], false);
    let first: Vec<bool> =
        (0..ranked.len()).map(|at| contain[at]((from - ranked[at].centre) / ranked[at].half)).collect();
    // In the shape's own units, one step and the last, which is at the other end.
    let starts: Vec<[DVec3; 2]> =
        ranked.iter().map(|body| [(from - body.centre) / body.half, (to - from) / body.half]).collect();
    for number in 0..=STEPS {
        let along = if number < STEPS { (f64::from(number) + 0.5) / f64::from(STEPS) } else { 1.0 };
        let mut is_absorbed = number == STEPS;
        for (at, &[start, way]) in starts.iter().enumerate() {
            let is_inside = contain[at](start + way * along);
            crosses |= is_inside != first[at];
            steps[at] += u32::from(is_inside && !is_absorbed);
            is_absorbed |= is_inside;
        }
    }
    let step = (to - from).length() / f64::from(STEPS);
    let depth = |part: usize| -> f64 {
        let each = ranked.iter().zip(&steps);
        each.map(|(body, &steps)| body.glass.absorption.to_array()[part] * step * f64::from(steps)).sum()
    };
    ([0, 1, 2].map(|part| (-depth(part)).exp()), crosses)
}

/// Arrangements of up to four bodies about a floor at the origin and a light at [`LIGHT`].
fn arrangements() -> Vec<(String, Vec<AnyShape>)> {
    let body = |kind, centre: [f64; 3], half: [f64; 3], absorption: [f64; 3], priority| AnyShape {
        kind,
        centre: centre.into(),
        half: half.into(),
        glass: ink(absorption, priority),
    };
    let mut all = vec![("nothing".to_string(), vec![])];
    // A body of each kind around everything, or around the light alone, or around the floor alone.
    for kind in KINDS {
        let around = match kind {
            "sea" => body(kind, [0.0, 5.0, 0.0], [1.0; 3], [0.4, 0.2, 0.0], 0),
            // A torus around its hole only; its tube passes between floor and light.
            "torus" => body(kind, [0.7, 0.1, 0.0], [1.0, 2.0, 1.0], [0.4, 0.9, 1.3], 0),
            "ball" => body(kind, [0.2, 0.3, 0.0], [4.0; 3], [0.4, 0.2, 0.1], 0),
            _ => body(kind, [0.2, -1.0, 0.0], [6.0, 7.0, 6.0], [0.4, 0.2, 0.1], 0),
        };
        all.push((format!("within a {kind}"), vec![around]));
        if kind != "sea" && kind != "torus" {
            let half = if kind == "ball" { [0.3; 3] } else { [0.4, 0.35, 0.4] };
            let of_light = body(kind, LIGHT.to_array(), half, [1.0, 2.0, 0.5], 1);
            all.push((format!("a light in a {kind}"), vec![of_light]));
            let both = vec![around, of_light];
            all.push((format!("a light in a {kind} within another"), both.clone()));
            all.push(("the same the other way about".to_string(), both.into_iter().rev().collect()));
        }
    }
    let large = body("ball", [0.0, 0.3, 0.0], [3.0; 3], [0.5, 0.3, 0.1], 0);
    let bubble = body("ball", LIGHT.to_array(), [0.3; 3], [0.0; 3], 1);
    all.push(("a light in a bubble".into(), vec![large, bubble]));
    let air = body("box", [0.0, 0.0, 0.0], [0.6, 0.45, 0.6], [0.0; 3], 2);
    all.push(("a floor in a box of air".into(), vec![large, air]));
    all.push(("both".into(), vec![large, air, bubble]));
    for priority in [0, 2] {
        let floor = body("ball", [0.0, 0.0, 0.0], [0.7; 3], [0.9, 0.1, 0.4], 1);
        let light = body("box", [0.4, 0.9, 0.2], [0.5, 0.5, 0.5], [0.2, 1.1, 0.3], priority);
        all.push((format!("overlapping, {priority} over 1"), vec![floor, light]));
        all.push((
            format!("within a third, {priority} over 1"),
            vec![floor, light, AnyShape { glass: ink([0.1, 0.2, 0.3], 0), ..large }],
        ));
    }
    // Faces that coincide: floor and light in the same box, or in two that touch.
    let below = body("box", [0.0, -0.25, 0.0], [2.0, 0.75, 2.0], [0.6, 0.3, 0.2], 0);
    let above = body("box", [0.0, 1.25, 0.0], [2.0, 0.75, 2.0], [0.1, 0.5, 0.9], 0);
    all.push(("two boxes that touch".into(), vec![below, above]));
    all.push(("the same in the other order".into(), vec![above, below]));
    let standing = body("box", [0.0, 1.0, 0.0], [1.0, 1.0, 1.0], [0.3, 0.7, 0.2], 0);
    all.push(("a box on the floor".into(), vec![standing]));
    let within = body("cylinder", [0.1, 0.5, 0.0], [0.8, 0.5, 0.8], [0.9, 0.2, 0.1], 1);
    all.push(("a cylinder on the floor in a box on the floor".into(), vec![standing, within]));
    let four = (0..4).map(|number| {
        let size = 2.0 - 0.45 * f64::from(number);
        body("box", [0.05 * f64::from(number), 0.4, 0.0], [size; 3], [0.3, 0.1 * f64::from(number), 0.2], number)
    });
    all.push(("four in one another".into(), four.collect()));
    all
}

const LIGHT: DVec3 = DVec3::new(0.3, 0.9, 0.2);
const COLOUR: f64 = 0.5;
/// The side of the floor that the camera sees.
const SEEN: f64 = 0.16;

/// Where the camera stands above the floor: its pixels see even squares of it, straight from above or from a point.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Seen {
    Parallel,
    Perspective,
    Lens,
    Fisheye,
}

fn stage(bodies: &[AnyShape], seen: Seen, height: f64, floor_first: bool) -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::Y * height, target: DVec3::ZERO, up: DVec3::Z };
    let size = Resolution { width: 4, height: 4 };
    let camera = world.spawn((Name::new("camera"), look, size)).id();
    let fov = Degrees(2.0 * (0.5 * SEEN / height).atan().to_degrees());
    let perspective = PerspectiveCamera { fov, ..PerspectiveCamera::default() };
    let mut camera = world.entity_mut(camera);
    match seen {
        Seen::Parallel => camera.insert(OrthographicCamera { view_height: SEEN }),
        Seen::Perspective => camera.insert(perspective),
        Seen::Lens => {
            let aperture = Aperture::Radius { radius: 0.002 };
            camera.insert((perspective, Lens { aperture, focus_distance: height, ..Lens::default() }))
        }
        Seen::Fisheye => camera.insert(FisheyeCamera { fov, axis: FovAxis::Diagonal }),
    };
    let floor = |world: &mut World| {
        world.spawn((Name::new("floor"), Rectangle { width: 1.0, depth: 1.0 }, Matte { colour: Rgb::grey(COLOUR) }));
    };
    if floor_first {
        floor(&mut world);
    }
    bodies.iter().for_each(|body| body.spawn(&mut world));
    if !floor_first {
        floor(&mut world);
    }
    world
}

/// A light without an area, and the irradiance that it sends to a point of the floor, through what lies between.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Delta {
    Point,
    Spot,
    Sun,
}

const SUN: DVec3 = DVec3::new(-0.2, -0.9, -0.3);

impl Delta {
    fn spawn(self, world: &mut World) {
        let look = LookAt { eye: LIGHT, target: DVec3::ZERO, up: DVec3::Z };
        let white = Rgb::grey(1.0);
        match self {
            Self::Point => world.spawn((
                PointLight { intensity: white, ..PointLight::default() },
                Placement::at(LIGHT.x, LIGHT.y, LIGHT.z),
            )),
            Self::Spot => {
                let angles =
                    SpotLight { inner_angle: Degrees(60.0), outer_angle: Degrees(70.0), ..SpotLight::default() };
                world.spawn((SpotLight { intensity: white, ..angles }, look))
            }
            Self::Sun => {
                let look = LookAt { eye: -SUN, target: DVec3::ZERO, up: DVec3::Z };
                world.spawn((DirectionalLight { irradiance: white, ..DirectionalLight::default() }, look))
            }
        };
    }

    /// The irradiance at a point without anything between, and where the light comes from.
    fn irradiance(self, floor: DVec3) -> (f64, DVec3) {
        let to_light = LIGHT - floor;
        match self {
            Self::Sun => (-SUN.normalize().y, floor - 12.0 * SUN.normalize()),
            _ => (to_light.y / to_light.length().powi(3), LIGHT),
        }
    }
}

/// The radiance that the camera sees in its pixels on the mean, and whether paths from the camera, or those from the
/// lights beside them, can find all of it.
fn closed_form(bodies: &[AnyShape], light: Delta, seen: Seen, height: f64) -> ([f64; 3], bool, bool) {
    const SIDE: u32 = 4;
    let (mut sum, mut by_paths, mut by_both) = ([0.0; 3], true, true);
    for cell in 0..SIDE * SIDE {
        let along = |number: u32| SEEN * ((f64::from(number) + 0.5) / f64::from(SIDE) - 0.5);
        let floor = DVec3::new(along(cell % SIDE), 1e-9, along(cell / SIDE));
        let eye = if seen == Seen::Parallel { DVec3::new(floor.x, height, floor.z) } else { DVec3::Y * height };
        let (irradiance, from) = light.irradiance(floor);
        let ((to_light, hidden), (to_eye, behind)) = (between(bodies, floor, from), between(bodies, floor, eye));
        (by_paths, by_both) = (by_paths && !hidden, by_both && (!hidden || !behind));
        for part in 0..3 {
            sum[part] += COLOUR / PI * irradiance * to_light[part] * to_eye[part] / f64::from(SIDE * SIDE);
        }
    }
    (sum, by_paths, by_both)
}

/// The mean of an image over several seeds, and its standard error from how each pixel varies between them.
fn mean_of(world: &dyn Fn() -> World, integrator: Integrator, samples: u32, seeds: u64) -> ([f64; 3], [f64; 3]) {
    let images = renders_by(world, integrator, samples, 0..seeds);
    let (count, pixels) = (images.len() as f64, images[0].pixels.len());
    let (mut mean, mut variance) = ([0.0; 3], [0.0; 3]);
    for pixel in 0..pixels {
        for part in 0..3 {
            let own = images.iter().map(|image| image.pixels[pixel][part]);
            let middle = own.clone().sum::<f64>() / count;
            mean[part] += middle / pixels as f64;
            let squares: f64 = own.map(|value| (value - middle) * (value - middle)).sum();
            variance[part] += squares / (count * (count - 1.0)) / (pixels * pixels) as f64;
        }
    }
    (mean, variance.map(f64::sqrt))
}

/// Every light without an area, under every camera, in every arrangement: light goes straight through ink, and each
/// segment, from the light to the floor and from there to the eye, is absorbed by what it passes through.
#[test]
fn light_is_absorbed_by_all_that_it_passes_through() {
    let (mut tried, mut worst, mut not_found) = (0, 0.0_f64, 0);
    let mut failures = Vec::new();
    for (number, (name, bodies)) in arrangements().into_iter().enumerate() {
        for light in [Delta::Point, Delta::Spot, Delta::Sun] {
            for (seen, height) in
                [(Seen::Parallel, 0.4), (Seen::Perspective, 0.4), (Seen::Lens, 1.7), (Seen::Fisheye, 1.2)]
            {
                let (expected, by_paths, by_both) = closed_form(&bodies, light, seen, height);
                let make = |more: fn(&mut EntityWorldMut<'_>)| {
                    let mut world = stage(&bodies, seen, height, number % 2 == 0);
                    light.spawn(&mut world);
                    let camera = named(&mut world, "camera");
                    more(&mut world.entity_mut(camera));
                    world
                };
                if !by_paths && !by_both {
                    not_found += 1;
                    continue;
                }
                // No light path starts on a sun where glass is infinite, and the plan says so.
                let starts = light != Delta::Sun || !bodies.iter().any(|body| body.kind == "sea");
                let can_trace = seen != Seen::Fisheye && by_both && starts;
                let straight = |lights| Integrator::Path { max_depth: 64, lights, roulette: 0 };
                let mut methods = vec![Integrator::WHITTED, Integrator::DISTRIBUTION];
                methods.extend(ALL.iter().map(|&lights| straight(lights)));
                if !by_paths {
                    methods.clear();
                } else if times_samples() == 1 {
                    // One after another; with more samples asked for, each everywhere.
                    methods = vec![methods[tried % methods.len()]];
                }
                type Ask = fn(&mut EntityWorldMut<'_>);
                let mut methods: Vec<(_, &str, Ask, _)> =
                    methods.into_iter().map(|integrator| (integrator, "paths", (|_| ()) as Ask, (4, 4))).collect();
                // What paths from the camera do not find is for those from the lights.
                if can_trace
                    && !by_paths
                    && (times_samples() > 1 || (number + light as usize + height as usize).is_multiple_of(16))
                {
                    let traced: Ask = |camera| _ = camera.insert(LightTracing { paths: 8.0 });
                    methods.push((straight(LightStrategy::Mis), "light tracing", traced, (64, 6)));
                    if light != Delta::Sun {
                        let joined: Ask = |camera| _ = camera.insert(BidirectionalPathTracing { paths: 8.0 });
                        methods.push((straight(LightStrategy::Mis), "joined paths", joined, (64, 6)));
                    }
                }
                for (integrator, by, more, (samples, seeds)) in methods {
                    let (mean, error) = mean_of(&|| make(more), integrator, samples, seeds);
                    for part in 0..3 {
                        // The closed form is a sum of squares of the floor, good to a thousandth.
                        let allowed = 4.5 * error[part] + 2e-3 * expected[part];
                        let off = (mean[part] - expected[part]) / (error[part] + 5e-4 * expected[part]);
                        worst = worst.max(off.abs());
                        if !((mean[part] - expected[part]).abs() <= allowed) {
                            failures.push(format!("{name}, {light:?}, {seen:?}, {integrator:?}, {by}: {mean:?} ± {error:?} for {expected:?}"));
                            break;
                        }
                    }
                    tried += 1;
                }
            }
        }
    }
    eprintln!(
        "light through ink: {tried} renders against closed forms, worst {worst:.1} standard errors; {not_found} that no method finds"
    );
    assert!(failures.is_empty(), "{} of {tried}:\n{}", failures.len(), failures.join("\n"));
}

/// Shapes that emit, each of which is put where the light is.
const EMITTERS: [(&str, fn(&mut World) -> Entity); 9] = [
    ("ball", |world| world.spawn(Sphere { radius: 0.12 }).id()),
    ("disk", |world| world.spawn(Disk { radius: 0.15 }).id()),
    ("rectangle", |world| world.spawn(Rectangle { width: 0.3, depth: 0.2 }).id()),
    ("cuboid", |world| world.spawn(Cuboid { size: DVec3::new(0.2, 0.15, 0.25) }).id()),
    ("cylinder", |world| world.spawn(Cylinder { radius: 0.1, height: 0.2, capped: true }).id()),
    ("cone", |world| world.spawn(Cone { radius: 0.15, height: 0.2, capped: true }).id()),
    ("triangle", |world| {
        let vertices = [DVec3::new(-0.15, 0.0, 0.1), DVec3::new(0.15, 0.0, 0.12), DVec3::new(0.0, 0.02, -0.15)];
        world.spawn(Triangle { vertices, ..Triangle::default() }).id()
    }),
    ("mesh", |world| world.spawn(MeshInstance::default()).id()),
    ("ellipsoid", |world| world.spawn(Sphere { radius: 0.1 }).id()),
];

/// Every light with an area in every arrangement: light sampling, BSDF sampling and both agree with each other, and light
/// tracing and joined paths with them, in ink and in glass that bends light.
#[test]
fn strategies_agree_inside_glass() {
    let (mut tried, mut worst, mut known_to) = (0, 0.0_f64, Vec::new());
    let mut failures = Vec::new();
    let arrangements = arrangements();
    for (number, (name, bodies)) in arrangements.iter().enumerate() {
        // Each arrangement is tried with some of the lights, and each light with some arrangements.
        for (kind, spawn) in (0..if times_samples() > 1 { EMITTERS.len() } else { 1 })
            .map(|step| EMITTERS[(number + step) % EMITTERS.len()])
        {
            let bends = number % 2 == 1;
            let bodies: Vec<AnyShape> = bodies
                .iter()
                .enumerate()
                .map(|(at, body)| {
                    let ior = if bends { 1.2 + 0.15 * at as f64 } else { 1.0 };
                    AnyShape { glass: Glass { ior, ..body.glass }, ..*body }
                })
                .collect();
            let make = |more: fn(&mut EntityWorldMut<'_>)| {
                let mut world = stage(&bodies, Seen::Perspective, 0.4, number % 2 == 0);
                let emissive = Emissive { radiance: Rgb { r: 6.0, g: 9.0, b: 12.0 }, ..Emissive::default() };
                let scale = match kind {
                    "mesh" => DVec3::new(0.15, 0.1, 0.12),
                    "ellipsoid" => DVec3::new(1.0, 1.4, 0.8),
                    _ => DVec3::ONE,
                };
                let placement = Placement { position: LIGHT, scale, orientation: DQuat::from_rotation_z(0.2) };
                let lamp = spawn(&mut world);
                world.entity_mut(lamp).insert((placement, emissive));
                let camera = named(&mut world, "camera");
                more(&mut world.entity_mut(camera));
                world
            };
            let path = |lights| Integrator::Path { max_depth: 48, lights, roulette: 0 };
            type Ask = fn(&mut EntityWorldMut<'_>);
            let traced: Ask = |camera| _ = camera.insert(LightTracing { paths: 4.0 });
            let joined: Ask = |camera| _ = camera.insert(BidirectionalPathTracing::default());
            let methods: [(LightStrategy, Ask, u32); 5] = [
                (LightStrategy::Bsdf, |_| (), 128),
                (LightStrategy::Light, |_| (), 32),
                (LightStrategy::Mis, |_| (), 32),
                (LightStrategy::Mis, traced, 32),
                (LightStrategy::Mis, joined, 32),
            ];
            // Light sampling alone has no part in what BSDF sampling finds behind glass.
            let measured = methods.map(|(lights, more, samples)| mean_of(&|| make(more), path(lights), samples, 4));
            for (at, (mean, error)) in measured.iter().enumerate().skip(1) {
                let (first, spread) = &measured[0];
                for part in 0..3 {
                    let together = (error[part] * error[part] + spread[part] * spread[part]).sqrt();
                    let off = (mean[part] - first[part]).abs() / together.max(1e-12);
                    worst = worst.max(off);
                    known_to.push(together / first[part].max(1e-12));
                    if off > 4.5 {
                        failures.push(format!(
                            "{name}, {kind}, bends {bends}: method {at} {mean:?} ± {error:?} for {first:?} ± {spread:?}"
                        ));
                        break;
                    }
                }
                tried += 1;
            }
        }
    }
    known_to.sort_by(f64::total_cmp);
    let middle = 100.0 * known_to[known_to.len() / 2];
    eprintln!(
        "inside glass: {tried} comparisons of strategies, worst {worst:.1} standard errors, half of them below {middle:.1} %"
    );
    assert!(failures.is_empty(), "{} of {tried}:\n{}", failures.len(), failures.join("\n"));
}

/// Two blocks of frosted glass of which one stands on the other, by nothing or by less than is kept apart, with a lamp in
/// the lower one: the light that is sampled through their faces is what BSDF sampling finds.
#[test]
fn frosted_blocks_that_touch_are_lit_alike_by_all_strategies() {
    let mut worst = 0.0_f64;
    for gap in [0.0, 4e-7, 8e-7, 1.5e-6] {
        let make = || {
            let mut world = World::new();
            let look = LookAt { eye: DVec3::new(0.1, 4.0, 0.7), target: DVec3::ZERO, up: DVec3::Z };
            let camera = PerspectiveCamera { fov: Degrees(8.0), ..PerspectiveCamera::default() };
            world.spawn((Name::new("camera"), camera, look, Resolution { width: 4, height: 4 }));
            for (middle, ior) in [(-0.5, 1.8), (0.5 + gap, 1.5)] {
                let block = (Cuboid { size: DVec3::new(3.0, 1.0, 3.0) }, Placement::at(0.0, middle, 0.0));
                world.spawn((block, RoughGlass { ior, roughness: 0.5, ..RoughGlass::default() }));
            }
            let emissive = Emissive { radiance: Rgb::grey(10.0), ..Emissive::default() };
            world.spawn((Sphere { radius: 0.3 }, Placement::at(0.1, -0.5, 0.1), emissive));
            world
        };
        let path = |lights| Integrator::Path { max_depth: 24, lights, roulette: 0 };
        let measured =
            [512, 512, 256].iter().zip(ALL).map(|(&samples, &lights)| mean_of(&make, path(lights), samples, 8));
        let measured: Vec<_> = measured.collect();
        let (first, spread) = measured[0];
        for (lights, (mean, error)) in ALL.iter().zip(&measured).skip(1) {
            let together = (error[0] * error[0] + spread[0] * spread[0]).sqrt();
            let off = (mean[0] - first[0]).abs() / together;
            worst = worst.max(off);
            assert!(off < 4.5, "gap {gap}, {lights:?}: {mean:?} ± {error:?} for {first:?} ± {spread:?}");
            assert!(together < 0.05 * first[0], "gap {gap}, {lights:?}: known to {together} of {first:?} only");
        }
    }
    eprintln!("frosted blocks: 4 gaps, worst {worst:.1} standard errors");
}

/// Clear glass in an even sky of radiance 1 on a white floor, whatever it consists of and wherever its surfaces coincide:
/// the radiance at the eye is n² of the medium around it, along every path that ends (Liouville).
#[test]
fn clear_glass_that_touches_makes_and_loses_no_light() {
    let (mut scenes, mut paths, mut caught) = (0, 0, 0);
    let mut failures = Vec::new();
    for number in 0..TOUCHING {
        let mut draws = Draws::new(3401, number);
        let (name, world, index) = touching(&mut draws);
        let film = render(&world, &offer(), &Execution::default(), &()).expect("renders").film;
        let expected = (index * index) as f32;
        for part in (0..8).flat_map(|x| (0..8).map(move |y| (x, y))).flat_map(|(x, y)| film.mean(x, y)) {
            paths += 1;
            // What total reflection keeps in a corner for all of its segments is lost, and never more than is there.
            if part == 0.0 {
                caught += 1;
            } else if !((part / expected - 1.0).abs() < 2e-5) {
                failures.push(format!("{number} {name}: {part} for {expected}"));
                break;
            }
        }
        scenes += 1;
    }
    eprintln!("glass that touches: {scenes} scenes, {paths} paths, {caught} caught for good");
    assert!(failures.is_empty(), "{} of {scenes}:\n{}", failures.len(), failures.join("\n"));
    assert!(caught * 20 < paths, "{caught} of {paths} paths are caught");
}

const TOUCHING: u64 = 240;

/// A random pile of glass on a white floor, its bodies in a random order in the file, and the index around the eye.
fn touching(draws: &mut Draws) -> (String, World, f64) {
    let mut pick = |max: usize| ((draws.unit() * max as f64) as usize).min(max - 1);
    let mut bodies: Vec<(&str, DVec3, DVec3, f64, u32)> = Vec::new();
    let kinds = ["box", "cylinder", "mesh box", "shell", "film", "sunk", "beside"];
    let count = 1 + pick(4);
    let mut top = 0.0;
    let mut name = String::new();
    let far = [0.0, 7.0, -310.0][pick(3)];
    for _ in 0..count {
        let kind = kinds[pick(kinds.len())];
        let ior = [1.0, 1.33, 1.5, 1.9][pick(4)];
        name += &format!("{kind} {ior}, ");
        match kind {
            "film" => {
                let thin = [3e-7, 1e-6, 3e-5, 1e-3][pick(4)];
                bodies.push(("box", DVec3::new(0.0, top + 0.5 * thin, 0.0), DVec3::new(1.0, 0.5 * thin, 1.0), ior, 0));
                top += thin;
            }
            "shell" => {
                let thin = [1e-6, 1e-4, 0.1][pick(3)];
                bodies.push(("ball", DVec3::new(0.0, top + 0.5, 0.0), DVec3::splat(0.5), ior, 0));
                bodies.push(("ball", DVec3::new(0.0, top + 0.5, 0.0), DVec3::splat(0.5 - thin), 1.0, 1));
                top += 1.0;
            }
            "sunk" => {
                bodies.push(("box", DVec3::new(0.1, top + 0.1, 0.0), DVec3::new(0.7, 0.3, 0.8), ior, 2));
                top += 0.4;
            }
            "beside" => {
                for (side, ior) in [(-0.5, ior), (0.5, 1.4)] {
                    bodies.push(("box", DVec3::new(side, top + 0.4, 0.0), DVec3::new(0.5, 0.4, 0.7), ior, 0));
                }
                top += 0.8;
            }
            _ => {
                bodies.push((kind, DVec3::new(0.0, top + 0.3, 0.0), DVec3::new(0.8, 0.3, 0.6), ior, 0));
                top += 0.6;
            }
        }
    }
    let inside = pick(3) == 0;
    let eye = match bodies.first() {
        Some(&(_, centre, half, ..)) if inside => centre + half * DVec3::new(0.21, 0.13, -0.17),
        _ => DVec3::new(0.7, top + 1.5, 2.5),
    };
    let target = if inside { eye + DVec3::new(0.3, 0.2, -1.0) } else { DVec3::new(0.1, 0.5 * top, 0.0) };
    let shift = DVec3::new(far, 0.0, 0.3 * far);
    let mut world = World::new();
    let look = LookAt { eye: eye + shift, target: target + shift, ..LookAt::default() };
    let integrator = Integrator::Path { max_depth: 4096, lights: LightStrategy::Bsdf, roulette: 0 };
    let camera = (PerspectiveCamera { fov: Degrees(40.0), ..PerspectiveCamera::default() }, integrator);
    world.spawn((Name::new("camera"), camera, look, Resolution { width: 8, height: 8 }));
    world.spawn(Background { colour: Rgb::grey(1.0) });
    // The medium around the eye: of the highest priority, and among equals the first in the file.
    let floor_at = pick(bodies.len() + 1);
    let turned = pick(2) == 0;
    if turned {
        bodies.reverse();
    }
    let mut around: Option<(u32, f64)> = None;
    for (number, &(kind, centre, half, ior, priority)) in bodies.iter().enumerate() {
        if number == floor_at {
            spawn_floor(&mut world);
        }
        let placement = Placement { position: centre + shift, scale: half, ..Placement::default() };
        let glass = Glass { ior, priority, ..Glass::default() };
        let p = (eye - centre) / half;
        let is_in = match kind {
            "ball" => p.length() < 1.0,
            "cylinder" => p.y.abs() < 1.0 && p.x * p.x + p.z * p.z < 1.0,
            _ => p.abs().max_element() < 1.0,
        };
        if is_in && around.is_none_or(|(other, _)| priority > other) {
            around = Some((priority, ior));
        }
        match kind {
            "ball" => world.spawn((Sphere { radius: 1.0 }, placement, glass)),
            "cylinder" => world.spawn((Cylinder { radius: 1.0, height: 2.0, capped: true }, placement, glass)),
            "mesh box" => world.spawn((MeshInstance::new(box_mesh()), placement, glass)),
            _ => world.spawn((Cuboid { size: DVec3::splat(2.0) }, placement, glass)),
        };
    }
    if floor_at >= bodies.len() {
        spawn_floor(&mut world);
    }
    (format!("{name}inside {inside}, at {far}, turned {turned}"), world, around.map_or(1.0, |(_, ior)| ior))
}

/// A white floor, with black beneath it for rays that get through.
fn spawn_floor(world: &mut World) {
    world.spawn((Name::new("floor"), Plane { normal: DVec3::Y }, Matte { colour: Rgb::grey(1.0) }));
    world.spawn((Plane { normal: DVec3::Y }, Placement::at(0.0, -1.0, 0.0), Matte { colour: Rgb::grey(0.0) }));
}

/// A box of half extent 1 as a mesh.
fn box_mesh() -> pinhole::models::TriangleMesh {
    let corner = |at: u32| [0, 1, 2].map(|axis| if at >> axis & 1 == 0 { -1.0 } else { 1.0 });
    let mut triangles = Vec::new();
    for axis in 0..3_u32 {
        let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        for (side, order) in [(0, [0, v, u + v, u]), (1_u32 << axis, [0, u, u + v, v])] {
            let [a, b, c, d] = order.map(|offset| side + offset);
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    pinhole::models::TriangleMesh { positions: (0..8).map(corner).collect(), triangles, ..Default::default() }
}

/// A point light just below, on and just above the lower face of a block that absorbs, seen on the floor below: the
/// light that comes straight down and what is refracted in the block are never counted together.
#[test]
fn a_light_beside_a_face_of_glass_is_on_one_side_of_it() {
    let floor_of = |height: f64, from: f64, ior: f64| {
        let make = move || {
            let mut world = World::new();
            let look =
                LookAt { eye: DVec3::new(4.0, from, 0.0), target: DVec3::new(0.0, from - 3.0, 0.0), up: DVec3::Y };
            let fov = PerspectiveCamera { fov: Degrees(24.0), ..PerspectiveCamera::default() };
            let camera = (Name::new("camera"), fov, look);
            world.spawn((
                camera,
                Resolution { width: 8, height: 8 },
                Integrator::Path { max_depth: 60, lights: LightStrategy::Mis, roulette: 20 },
                LightTracing::default(),
            ));
            let glass = Glass { ior, absorption: Rgb::grey(1.0), ..Glass::default() };
            let block = Placement::at(0.0, from + 0.7, 0.0);
            world.spawn((Cuboid { size: DVec3::new(2.0, 1.2, 2.0) }, block, glass));
            let light = PointLight { intensity: Rgb::grey(100.0), ..PointLight::default() };
            world.spawn((light, Placement::at(0.0, from + 0.1 + height, 0.0)));
            let matte = Matte { colour: Rgb::grey(0.01) };
            world.spawn((Plane { normal: DVec3::Y }, Placement::at(0.0, from - 3.0, 0.0), matte));
            world
        };
        super::caustics::mean_of(&make, &offer(), 12, 0..8)
    };
    let mut worst = 0.0_f64;
    for (from, ior) in [(0.0, 1.5), (7.0, 1.5), (0.0, 1.0), (-3.0, 1.8)] {
        let [below, above] = [-1e-3, 1e-3].map(|height| floor_of(height, from, ior));
        // Where nothing is refracted, the two are alike.
        let differ = (below.mean - above.mean).abs() > 6.0 * (below.error + above.error);
        assert!(differ || ior == 1.0, "{below:?} and {above:?}");
        for height in [-1e-4, -1e-6, -1e-7, -1e-9, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4] {
            let (found, expected) = (floor_of(height, from, ior), if height < 0.0 { &below } else { &above });
            // Positions are rounded to f32, by 5e-7 at most here.
            let either = [&below, &above].map(|side| (found.mean - side.mean).abs() / found.error.hypot(side.error));
            let off = (found.mean - expected.mean).abs() / found.error.hypot(expected.error);
            let off = if height.abs() <= 5e-7 { either[0].min(either[1]) } else { off };
            worst = worst.max(off);
            assert!(off <= 4.0, "{height:e} from the face at {from}: {found:?} for {expected:?}");
        }
    }
    eprintln!("a light beside a face: 36 places, worst {worst:.1} standard errors");
}

/// The eye on the surface of absorbing water sees what is below it through the water, and what is above through air; in
/// the joint of two blocks it sees through glass.
#[test]
fn an_eye_on_the_surface_of_glass_sees_each_side_through_what_is_there() {
    let seen = |height: f64, down: f64, joint: bool| {
        let mut world = World::new();
        let look =
            LookAt { eye: DVec3::new(0.0, height, 0.0), target: DVec3::new(0.0, height - down, -1.0), up: DVec3::Y };
        let fov = PerspectiveCamera { fov: Degrees(20.0), ..PerspectiveCamera::default() };
        let size = Resolution { width: 8, height: 8 };
        world.spawn((fov, look, size, Integrator::Path { max_depth: 9, lights: LightStrategy::Mis, roulette: 8 }));
        let glass = Glass { ior: 1.33, absorption: Rgb::grey(1.0), ..Glass::default() };
        if joint {
            for side in [-0.5, 0.5] {
                world.spawn((Cuboid::default(), Placement::at(0.0, side, 0.0), glass));
            }
            world.spawn(Background { colour: Rgb::grey(1.0) });
        } else {
            world.spawn((Plane { normal: DVec3::Y }, glass));
            let bed = (Plane { normal: DVec3::Y }, Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() });
            world.spawn((bed, Placement::at(0.0, -1.0, 0.0)));
            world.spawn(Background { colour: Rgb::grey(0.25) });
        }
        numbers(&render(&world, &offer(), &Execution::default(), &()).expect("renders").film)
    };
    let mut tried = 0;
    for (joint, down, beside) in [(false, 1.0, -1e-6), (false, -1.0, 1e-6), (true, 1.0, -1e-6), (true, -1.0, 1e-6)] {
        let [on, next] = [0.0, beside].map(|height| seen(height, down, joint));
        for (on, next) in on.pixels.iter().zip(&next.pixels) {
            assert!((on[0] - next[0]).abs() < 1e-4, "{joint} {down}: {on:?} for {next:?}");
            tried += 1;
        }
    }
    eprintln!("an eye on the surface of glass: {tried} pixels");
}

/// Films that absorb half of the light, seen from afar: what the offset of rays passes by is absorbed, too.
#[test]
fn thin_films_absorb_what_they_should() {
    let mut worst = 0.0_f64;
    for thickness in [1e-2_f64, 1e-3, 1e-4, 3e-5] {
        for angle in [0.0, 50.0_f64] {
            let (sine, cosine) = angle.to_radians().sin_cos();
            let absorption = 2.0_f64.ln() / thickness;
            let make = move || {
                let mut world = World::new();
                let eye = DVec3::new(10.0 * sine, 10.0 * cosine, 0.0);
                let look = LookAt { eye, target: DVec3::ZERO, up: DVec3::Z };
                let fov = PerspectiveCamera { fov: Degrees(0.5), ..PerspectiveCamera::default() };
                let path = Integrator::Path { max_depth: 30, lights: LightStrategy::Mis, roulette: 29 };
                world.spawn((Name::new("camera"), fov, look, Resolution { width: 8, height: 8 }, path));
                let glass = Glass { ior: 1.5, absorption: Rgb::grey(absorption), ..Glass::default() };
                world.spawn((Cuboid { size: DVec3::new(4.0, thickness, 4.0) }, glass));
                let light = Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() };
                world.spawn((Plane { normal: DVec3::Y }, Placement::at(0.0, -1.0, 0.0), light));
                world
            };
            let found = super::caustics::mean_of(&make, &offer(), 16, 0..8);
            // A slab: T² e/(1 − R² e²), with Fresnel's R and e the transmittance of one way through it.
            let inside = (1.0 - (sine / 1.5).powi(2)).sqrt();
            let reflected = pinhole::material::fresnel(cosine, 1.5);
            let way = (-absorption * thickness / inside).exp();
            let truth = (1.0 - reflected).powi(2) * way / (1.0 - (reflected * way).powi(2));
            let off = (found.mean - truth).abs() / found.error.max(1e-4 * truth);
            worst = worst.max(off);
            assert!(off <= 4.0, "{thickness:e} thick at {angle}°: {found:?} for {truth}");
        }
    }
    eprintln!("thin films: 8, worst {worst:.1} standard errors");
}
