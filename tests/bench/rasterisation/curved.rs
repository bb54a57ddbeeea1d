//! First hits of spheres: by rays, in their rasterised boxes, and tessellated to a stated error.

use super::interval::interval;
use super::{EYE, FOV, after, stages_of};
use bevy_ecs::prelude::*;
use cpu_time::ProcessTime;
use glam::DVec3;
use pinhole::plan::Census;
use pinhole::render::{Execution, RenderInProgress};
use pinhole::scene::*;
use pinhole_lab::measure::ray_aim::Draws;
use pinhole_lab::measure::tessellated_sphere::tessellated_sphere;

const COUNTS: [u32; 5] = [1, 10, 100, 1000, 10_000];
const SIZES: [[u32; 2]; 2] = [[640, 360], [1920, 1080]];
/// The greatest distances between the spheres and their triangles, in pixels.
const ERRORS: [f64; 2] = [1.0 / 2.0, 1.0 / 256.0];
/// More triangles than this are left out.
const MOST: usize = 4_000_000;
/// How far the spheres are from the origin at most.
const REACH: f64 = 3.0;
/// How far the eye is from the origin where it is close.
const CLOSE: f64 = 1.4;

/// How spheres are found: the name, and what the scene of it is.
#[derive(Clone, Copy)]
enum Method {
    Rays,
    Boxes,
    Triangles(f64),
}

/// Spheres in a ball about the origin; as many times smaller as there are more of them by volume.
fn spheres(count: u32) -> (Vec<DVec3>, f64) {
    let mut draws = Draws::new(3301, u64::from(count));
    let places = (0..count).map(|sphere| {
        let away = if sphere == 0 { 0.0 } else { REACH * libm::cbrt(draws.unit()) };
        draws.unit_vector() * away
    });
    (places.collect(), 1.2 / libm::cbrt(f64::from(count)))
}

/// The scene of a method, and how many triangles it has; none where they are too many.
fn scene(method: Method, count: u32, distance: f64, [width, height]: [u32; 2]) -> Option<(World, usize)> {
    let (places, radius) = spheres(count);
    let eye = EYE.normalize() * distance;
    let mut world = World::new();
    let projection = PerspectiveCamera { fov: Degrees(FOV), axis: FovAxis::Vertical };
    let look = LookAt { eye, target: DVec3::ZERO, ..LookAt::default() };
    let (size, view) = (Resolution { width, height }, View { column: "hit".into() });
    let mut camera = world.spawn((projection, look, size, view, Integrator::RayCasting));
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
    if triangles > MOST {
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
    least: [f64; 2],
}

impl Frames {
    fn of(method: Method, count: u32, distance: f64, size: [u32; 2]) -> Option<Self> {
        let (world, triangles) = scene(method, count, distance, size)?;
        let execution = Execution { threads: Some(1), ..Execution::default() };
        let render = RenderInProgress::begin(&Census::of(&world), &stages_of(), &execution).expect("begins");
        let mut frames = Self { world, render, triangles, least: [f64::INFINITY; 2] };
        frames.next();
        frames.least = [f64::INFINITY; 2];
        Some(frames)
    }

    /// The processor time of a frame: until all tables are made anew, and from then on.
    fn next(&mut self) -> [f64; 2] {
        let started = ProcessTime::now();
        self.render.begin_frame(&Census::of(&self.world), &stages_of()).expect("a frame");
        let tables = started.elapsed().as_secs_f64();
        self.render.advance(self.render.steps(), &()).expect("renders");
        let times = [tables, started.elapsed().as_secs_f64() - tables];
        self.least = [0, 1].map(|part| self.least[part].min(times[part]));
        times
    }

    fn printed(&self) -> String {
        format!("{:7.2} + {:8.2}", 1e3 * self.least[0], 1e3 * self.least[1])
    }
}

/// The cost of a picture of spheres by each method.
pub fn curved() {
    let (rounds, most) = (after("--rounds", 15), after("--spheres", COUNTS[COUNTS.len() - 1]));
    println!("first hits of spheres, one thread, processor time a frame in ms: tables made anew + the picture");
    println!("how many times as fast in boxes: as by rays, as by rays whose tables are kept, as tessellated");
    for close in [false, true] {
        let distance = if close { CLOSE } else { EYE.length() };
        for count in COUNTS.into_iter().filter(|&count| count <= if close { 10 } else { most }) {
            for size in SIZES {
                compare(count, distance, size, rounds);
            }
        }
    }
}

fn compare(count: u32, distance: f64, size: [u32; 2], rounds: usize) {
    let of = |method| Frames::of(method, count, distance, size);
    let (Some(mut rays), Some(mut boxes)) = (of(Method::Rays), of(Method::Boxes)) else { return };
    let mut tessellated = ERRORS.map(|error| of(Method::Triangles(error)));
    let mut logs = [(); 4].map(|()| Vec::new());
    for _ in 0..rounds {
        let (own, other) = (boxes.next(), rays.next());
        let own: f64 = own.iter().sum();
        logs[0].push(((other[0] + other[1]) / own).ln());
        logs[1].push((other[1] / own).ln());
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
        "{count} spheres{}, {} × {}: rays {}; boxes {}; boxes are {} and {} times as fast as rays",
        if distance < EYE.length() { " close to the camera" } else { "" },
        size[0],
        size[1],
        rays.printed(),
        boxes.printed(),
        ratio(&logs[0]),
        ratio(&logs[1]),
    );
    for ((error, frames), logs) in ERRORS.iter().zip(&tessellated).zip(&logs[2..]) {
        match frames {
            Some(frames) => println!(
                "    within 1/{} pixel, {} triangles: {}; boxes are {} times as fast",
                1.0 / error,
                frames.triangles,
                frames.printed(),
                ratio(logs),
            ),
            None => println!("    within 1/{} pixel: more than {MOST} triangles, left out", 1.0 / error),
        }
    }
}
