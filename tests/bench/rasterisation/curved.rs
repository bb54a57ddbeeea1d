//! First hits of spheres: by rays, in their rasterised boxes, and tessellated to a stated error.
//!
//! Spheres in a ball, all of them in view; from among them; and such that hundreds are one behind the other.

use super::interval::{cpu, interval};
use super::{EYE, FOV, after, stages_of};
use bevy_ecs::prelude::*;
use cpu_time::ProcessTime;
use glam::DVec3;
use pinhole::extract::{HierarchyOf, ShapesOf, hierarchy_evidence};
use pinhole::plan::{Census, Table};
use pinhole::render::{Execution, RenderInProgress};
use pinhole::scene::*;
use pinhole::shapes::PlacedSphere;
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::tessellated_sphere::tessellated_sphere;

const COUNTS: [u32; 5] = [1, 10, 100, 1000, 10_000];
const SIZES: [[u32; 2]; 2] = [[640, 360], [1920, 1080]];
/// The greatest distances between the spheres and their triangles, in pixels.
const ERRORS: [f64; 2] = [1.0 / 2.0, 1.0 / 256.0];
/// More triangles than this are left out.
const MAX: usize = 4_000_000;
/// How far the spheres are from the origin at most.
const FARTHEST: f64 = 3.0;
/// How far the eye is from the origin where it is close.
const CLOSE: f64 = 1.4;

/// Where the camera is, and how large the spheres are.
#[derive(Clone, Copy, Debug, PartialEq)]
enum View {
    Outside,
    Close,
    /// No sphere is smaller for there being more of them.
    Overlapping,
}

/// How spheres are found.
#[derive(Clone, Copy)]
enum Method {
    Rays,
    Boxes,
    Triangles(f64),
}

/// The centres of spheres in a ball about the origin, and their radius; together they always have the same volume, unless
/// they overlap.
fn spheres(count: u32, view: View) -> (Vec<DVec3>, f64) {
    let mut draws = Draws::new(3301, u64::from(count));
    let places = (0..count).map(|sphere| {
        let away = if sphere == 0 { 0.0 } else { FARTHEST * libm::cbrt(draws.unit()) };
        draws.unit_vector() * away
    });
    let smaller = if view == View::Overlapping { 1.0 } else { libm::cbrt(f64::from(count)) };
    (places.collect(), 1.2 / smaller)
}

/// The scene of a method, and how many triangles it has; none where they are too many.
fn scene(method: Method, count: u32, view: View, [width, height]: [u32; 2]) -> Option<(World, usize)> {
    let (places, radius) = spheres(count, view);
    let eye = if view == View::Close { EYE.normalize() * CLOSE } else { EYE };
    let mut world = World::new();
    let projection = PerspectiveCamera { fov: Degrees(FOV), axis: FovAxis::Vertical };
    let look = LookAt { eye, target: DVec3::ZERO, ..LookAt::default() };
    let painted = pinhole::scene::View { column: "hit".into() };
    let mut camera = world.spawn((projection, look, Resolution { width, height }, painted, Integrator::RayCasting));
    if !matches!(method, Method::Rays) {
        camera.insert(Rasterisation);
    }
    let Method::Triangles(error) = method else {
        for position in places {
            world.spawn((Sphere { radius }, Placement { position, ..Placement::default() }, Matte::default()));
        }
        return Some((world, 0));
    };
    // A sphere's outline is at this distance from the eye; one around the eye has none.
    let outline = |place: &DVec3| (place.distance_squared(eye) - radius * radius).max(0.0).sqrt();
    let nearest = places.iter().map(outline).filter(|&distance| distance > 0.0).fold(f64::INFINITY, f64::min);
    let pixels = f64::from(height) / (2.0 * libm::tan(Degrees(FOV).radians() / 2.0));
    let mesh = tessellated_sphere(error * nearest / pixels / radius);
    let triangles = mesh.triangles.len() * places.len();
    if triangles > MAX {
        return None;
    }
    let geometry = MeshGeometry::new(mesh);
    for position in places {
        let placement = Placement { position, scale: DVec3::splat(radius), ..Placement::default() };
        world.spawn((MeshInstance { geometry: geometry.clone() }, placement, Matte::default()));
    }
    Some((world, triangles))
}

/// A scene and its render, frame by frame.
struct Frames {
    world: World,
    render: RenderInProgress,
    triangles: usize,
    /// The least times so far.
    min: [f64; 2],
}

impl Frames {
    fn of(method: Method, count: u32, view: View, size: [u32; 2]) -> Option<Self> {
        let (world, triangles) = scene(method, count, view, size)?;
        let execution = Execution { threads: Some(1), ..Execution::default() };
        let render = RenderInProgress::begin(&Census::of(&world), &stages_of(), &execution).expect("begins");
        let mut frames = Self { world, render, triangles, min: [f64::INFINITY; 2] };
        frames.next();
        frames.min = [f64::INFINITY; 2];
        Some(frames)
    }

    /// The processor time of a frame: until all tables are made anew, and from then on.
    fn next(&mut self) -> [f64; 2] {
        let started = ProcessTime::now();
        self.render.begin_frame(&Census::of(&self.world), &stages_of()).expect("a frame");
        let tables = started.elapsed().as_secs_f64();
        self.render.advance(self.render.steps(), &()).expect("renders");
        let times = [tables, started.elapsed().as_secs_f64() - tables];
        self.min = [0, 1].map(|part| self.min[part].min(times[part]));
        times
    }

    /// The processor time in which the hierarchy over the spheres is built; none where they are tested one by one.
    fn building(&self) -> f64 {
        let census = Census::of(&self.world);
        if !hierarchy_evidence::<PlacedSphere>(&census).needed {
            return 0.0;
        }
        census.table::<ShapesOf<PlacedSphere>>().expect("spheres");
        cpu(&|| HierarchyOf::<PlacedSphere>::extract(&census)).as_secs_f64()
    }

    fn printed(&self) -> String {
        format!("{:7.2} + {:8.2}", 1e3 * self.min[0], 1e3 * self.min[1])
    }
}

/// The cost of a picture of spheres by each method.
pub fn curved() {
    let (rounds, max) = (after("--rounds", 15), after("--spheres", COUNTS[COUNTS.len() - 1]));
    println!("first hits of spheres, one thread, processor time a frame in ms: tables made anew + the picture");
    println!("boxes are so many times as fast as rays; as rays whose hierarchy is kept; as triangles");
    for view in [View::Outside, View::Close, View::Overlapping] {
        // Neither one sphere nor ten overlap more than others.
        for count in COUNTS.into_iter().filter(|&count| count <= max && (view != View::Overlapping || count > 10)) {
            for size in SIZES {
                compare(count, view, size, rounds);
            }
        }
    }
}

fn compare(count: u32, view: View, size: [u32; 2], rounds: usize) {
    let of = |method| Frames::of(method, count, view, size);
    let (Some(mut rays), Some(mut boxes)) = (of(Method::Rays), of(Method::Boxes)) else { return };
    let mut tessellated = ERRORS.map(|error| of(Method::Triangles(error)));
    let (mut logs, mut building) = ([(); 4].map(|()| Vec::new()), f64::INFINITY);
    for _ in 0..rounds {
        let [own, other] = [&mut boxes, &mut rays].map(|frames| frames.next().iter().sum::<f64>());
        let built = rays.building();
        building = building.min(built);
        logs[0].push((other / own).ln());
        logs[1].push(((other - built) / own).ln());
        for (frames, logs) in tessellated.iter_mut().zip(&mut logs[2..]) {
            if let Some(frames) = frames {
                logs.push((frames.next().iter().sum::<f64>() / own).ln());
            }
        }
    }
    let ratio = |logs: &Vec<f64>| {
        let (low, middle, high) = interval(logs);
        format!("{middle:.2} [{low:.2}, {high:.2}]")
    };
    println!(
        "{count} spheres, {view:?}, {} × {}: rays {} (hierarchy {:.2}); boxes {}: {}; {}",
        size[0],
        size[1],
        rays.printed(),
        1e3 * building,
        boxes.printed(),
        ratio(&logs[0]),
        ratio(&logs[1]),
    );
    for ((error, frames), logs) in ERRORS.iter().zip(&tessellated).zip(&logs[2..]) {
        match frames {
            Some(frames) => println!(
                "    within 1/{} pixel, {} triangles: {}: {}",
                1.0 / error,
                frames.triangles,
                frames.printed(),
                ratio(logs),
            ),
            None => println!("    within 1/{} pixel: more than {MAX} triangles, left out", 1.0 / error),
        }
    }
}
