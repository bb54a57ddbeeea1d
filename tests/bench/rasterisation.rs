//! Pictures by projection and by rays; projection beside another rasteriser; spheres by rays, in boxes and
//! tessellated; frames of a moving camera.
//!
//! `cargo bench --bench rasterisation` measures all four; `-- curves`, `-- peer`, `-- curved` or `-- frames` one of them.
//! `frames --mode 0` renders frames of the first mode alone, and says what its stages took.
//! `--rounds 5` says how often each pair is timed, `--frames 1000` how many frames are rendered, `--max 1000000` where
//! the curve against triangles ends, `--spheres 10000` where `curved` does; `curves --write` keeps the curves beside
//! chapter 34.
//! All but the frames run on one thread and are timed in processor time; frames take as many threads as there are
//! processors, and are timed as the viewer makes them, from the camera's pose to the bytes of the pixels.

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_types,
    reason = "what is measured here may come from the platform's functions"
)]
#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

#[path = "rasterisation/curved.rs"]
mod curved;
#[path = "rasterisation/curves.rs"]
mod curves;
#[path = "rasterisation/frames.rs"]
mod frames;
#[allow(dead_code, reason = "a benchmark takes what it needs")]
mod interval;

use bevy_ecs::prelude::*;
use euc::rasterizer::Triangles;
use euc::{DepthStrategy, Pipeline, buffer::Buffer2d};
use glam::{DVec3, Mat4, Vec3, Vec4};
use interval::{cpu, interval};
use pinhole::film::Film;
use pinhole::plan::{Census, Stage, Table};
use pinhole::rasterise::{Cover, RasterTriangles};
use pinhole::rays::{RasterPoints, Tile, fill_raster};
use pinhole::render::{Execution, RenderInProgress};
use pinhole::scene::*;
use pinhole::stages;
use pinhole_lab::measure::torus_knot::torus_knot;

const EYE: DVec3 = DVec3::new(0.0, 5.0, 8.0);
const TARGET: DVec3 = DVec3::new(0.0, -0.3, 0.0);
const FOV: f64 = 40.0;

/// Steps along the knot and around its tube, for some 10² to 10⁶ triangles.
const KNOTS: [[u32; 2]; 5] = [[16, 4], [50, 10], [160, 32], [800, 64], [2560, 200]];
const SIZES: [[u32; 2]; 3] = [[320, 180], [640, 360], [1920, 1080]];

/// What follows a flag on the command line.
fn after<N: std::str::FromStr>(flag: &str, default: N) -> N {
    let mut words = std::env::args().skip_while(|word| word != flag);
    words.nth(1).and_then(|word| word.parse().ok()).unwrap_or(default)
}

fn main() {
    let wanted = |part: &str| {
        let words: Vec<String> = std::env::args().collect();
        words.iter().any(|word| word == part)
            || !["curves", "peer", "curved", "frames"].iter().any(|own| words.iter().any(|word| word == own))
    };
    let single = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    if wanted("curves") {
        single.install(curves::measure);
    }
    if wanted("peer") {
        single.install(peer);
    }
    if wanted("curved") {
        single.install(curved::curved);
    }
    if wanted("frames") {
        frames::measure();
    }
}

fn scene(knot: [u32; 2], [width, height]: [u32; 2]) -> (World, Entity) {
    let mut world = World::new();
    let camera = PerspectiveCamera { fov: Degrees(FOV), axis: FovAxis::Vertical };
    let look = LookAt { eye: EYE, target: TARGET, ..LookAt::default() };
    let camera = world.spawn((camera, look, Resolution { width, height }, Integrator::RayCasting)).id();
    world.spawn((MeshInstance { geometry: MeshGeometry::new(torus_knot(knot[0], knot[1])) }, Matte::default()));
    (world, camera)
}

fn rendered(world: &World, threads: Option<usize>) -> Film {
    let execution = Execution { threads, ..Execution::default() };
    let mut render = RenderInProgress::begin(&Census::of(world), &stages_of(), &execution).expect("begins");
    render.advance(render.steps(), &()).expect("renders");
    render.film
}

/// All stages, and the one that paints a view.
fn stages_of() -> Vec<Stage> {
    let mut offer = stages::all();
    offer.push(pinhole::look::view_stage(&offer));
    offer
}

/// The same mesh, projected by euc: what is nearest at each pixel, as a number made of its place.
struct Nearest {
    clip_from_world: Mat4,
}

impl Pipeline for Nearest {
    type Vertex = Vec3;
    type VsOut = (f32, f32);
    type Pixel = u32;

    #[inline(always)]
    fn vert(&self, vertex: &Vec3) -> ([f32; 4], (f32, f32)) {
        ((self.clip_from_world * Vec4::from((*vertex, 1.0))).to_array(), (vertex.x, vertex.y))
    }

    fn get_depth_strategy(&self) -> DepthStrategy {
        DepthStrategy::IfLessWrite
    }

    #[inline(always)]
    fn frag(&self, (x, y): &(f32, f32)) -> u32 {
        x.to_bits() ^ y.to_bits()
    }
}

/// The matrix of the same camera, with depths from 0.1 to 100 mapped to 0 to 1.
fn clip_from_world(aspect: f32) -> Mat4 {
    let back = (EYE - TARGET).as_vec3().normalize();
    let right = Vec3::Y.cross(back).normalize();
    let camera_from_world =
        Mat4::from_cols(right.extend(0.0), back.cross(right).extend(0.0), back.extend(0.0), Vec4::W).transpose()
            * Mat4::from_translation(-EYE.as_vec3());
    let (near, far, up) = (0.1_f32, 100.0_f32, (1.0 / libm::tan(Degrees(FOV).radians() / 2.0)) as f32);
    let depth = far / (near - far);
    let clip_from_camera = Mat4::from_cols(
        Vec4::new(up / aspect, 0.0, 0.0, 0.0),
        Vec4::new(0.0, up, 0.0, 0.0),
        Vec4::new(0.0, 0.0, depth, -1.0),
        Vec4::new(0.0, 0.0, near * depth, 0.0),
    );
    clip_from_camera * camera_from_world
}

/// Projection beside euc on the same meshes: vertices to the nearest triangle at each pixel, on one thread.
fn peer() {
    let rounds = after("--rounds", 15);
    println!("projection beside euc 0.5, one thread, processor time");
    for knot in KNOTS {
        for size in SIZES {
            let (mut world, camera) = scene(knot, size);
            world.entity_mut(camera).insert(Rasterisation);
            let tiles = tiles(size);
            let pinhole = || {
                let table = RasterTriangles::extract(&Census::of(&world)).expect("a scene");
                let mut cover = Cover::default();
                let seen = |(tile, raster): &(Tile, RasterPoints)| {
                    cover.fill(&table, tile, raster, true);
                    (0..tile.rows()).filter(|&row| cover.nearest(row).is_some()).count()
                };
                tiles.iter().map(seen).sum::<usize>()
            };
            let mesh = torus_knot(knot[0], knot[1]);
            let vertices: Vec<Vec3> =
                mesh.triangles.iter().flatten().map(|&vertex| Vec3::from(mesh.positions[vertex as usize])).collect();
            let aspect = size[0] as f32 / size[1] as f32;
            let nearest = Nearest { clip_from_world: clip_from_world(aspect) };
            let euc = || {
                let mut colour = Buffer2d::new(size.map(|side| side as usize), 0_u32);
                let mut depth = Buffer2d::new(size.map(|side| side as usize), 1.0_f32);
                nearest.draw::<Triangles<_, euc::rasterizer::BackfaceCullingDisabled>, _>(
                    &vertices,
                    &mut colour,
                    Some(&mut depth),
                );
                depth.as_ref().iter().filter(|&&depth| depth < 1.0).count()
            };
            let covered = [pinhole(), euc()];
            let (mut logs, mut times) = (Vec::new(), [f64::INFINITY; 2]);
            for _ in 0..rounds {
                let pair = [cpu(&pinhole).as_secs_f64(), cpu(&euc).as_secs_f64()];
                times = [0, 1].map(|which| times[which].min(pair[which]));
                logs.push((pair[1] / pair[0]).ln());
            }
            let (low, middle, high) = interval(&logs);
            println!(
                "{:8} triangles, {:4} × {:4}: pinhole {:8.2} ms, euc {:8.2} ms; {middle:.2} [{low:.2}, {high:.2}] times euc's speed; pixels covered {} and {}",
                2 * knot[0] * knot[1],
                size[0],
                size[1],
                1e3 * times[0],
                1e3 * times[1],
                covered[0],
                covered[1],
            );
        }
    }
}

/// The tiles of an image with their raster points, as the renderer places them.
fn tiles([width, height]: [u32; 2]) -> Vec<(Tile, RasterPoints)> {
    const SIDE: usize = 32;
    let places = (0..height).step_by(SIDE).flat_map(|y| (0..width).step_by(SIDE).map(move |x| (x, y)));
    let mut world = World::new();
    let tiles: Vec<Entity> = places
        .map(|(x, y)| {
            let tile = Tile { x, y, width: (width - x).min(SIDE as u32), height: (height - y).min(SIDE as u32) };
            world.spawn((tile, RasterPoints::default())).id()
        })
        .collect();
    world.run_system_cached(fill_raster).expect("raster points");
    tiles.into_iter().map(|tile| world.entity_mut(tile).take::<(Tile, RasterPoints)>().expect("both")).collect()
}
