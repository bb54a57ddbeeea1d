//! What many lights cost, in time and in noise: `cargo bench --bench many_lights`.
//!
//! For 10 to 100,000 emitting triangles of the same power altogether, strewn over a floor or joined to a knot, it prints
//! CPU time a sample, the variance of a sample relative to the square of a pixel's mean, and both multiplied, once with a
//! light chosen by the hierarchy and once by power alone; then point lights, one chosen of many and all summed.
//! Rounds of both alternate in one thread, and the least time of each counts.
//! `-- --samples 16 --max 10000` takes fewer samples and fewer lights.
#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

use bevy_ecs::prelude::*;
use cpu_time::ProcessTime;
use glam::DVec3;
use pinhole::extract::{AreaLightTable, LightsOf};
use pinhole::film::FilmTile;
use pinhole::lights::{PlacedPointLight, luminance};
use pinhole::models::TriangleMesh;
use pinhole::plan::{Census, Column, ExtractedTable, RowKind, Shared, Table};
use pinhole::rays::{ActivePixels, SampleNumber, Tile};
use pinhole::render::{RenderWorld, prepare};
use pinhole::scene::*;
use pinhole::shade::Radiance;
use pinhole::stages;
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::torus_knot::torus_knot;
use std::time::{Duration, Instant};

/// The side of the only tile, in pixels.
const SIDE: u32 = 40;
/// Rounds that alternate.
const ROUNDS: u32 = 3;

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let after = |flag: &str| words.iter().position(|word| word == flag).and_then(|at| words.get(at + 1));
    let samples = after("--samples").and_then(|samples| samples.parse().ok()).unwrap_or(64);
    let max = after("--most").and_then(|max| max.parse().ok()).unwrap_or(100_000);
    for (name, make) in [("strewn triangles", strewn as fn(u32) -> TriangleMesh), ("a knot", knot)] {
        for (depth, what) in [(2, "direct light"), (5, "paths of 5 segments")] {
            println!("{name}, {what}");
            let mut first = None;
            for lights in [10, 100, 1000, 10_000, 100_000].into_iter().filter(|&lights| lights <= max) {
                let mesh = make(lights);
                area_lights(&scene(&mesh, depth), &mesh, samples, &mut first);
            }
        }
    }
    println!("point lights, direct light");
    for lights in [10, 100, 1000, 10_000, 100_000].into_iter().filter(|&lights| lights <= max) {
        point_lights(lights, samples);
    }
}

/// A floor with balls on it, seen from above, without a light.
///
/// The camera is below the lights, which would be the noisiest in its picture.
fn floor(max_depth: u32) -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::Y * 1.8, target: DVec3::ZERO, up: DVec3::NEG_Z };
    let camera = OrthographicCamera { view_height: 16.0 };
    let integrator = Integrator::Path { max_depth, lights: LightStrategy::Mis, roulette: 0 };
    let sampling = Sampling { samples: 1 << 12, sampler: Sampler::Independent, ..Sampling::default() };
    world.spawn((look, camera, Resolution { width: SIDE, height: SIDE }, integrator, sampling));
    let matte = Matte { colour: Rgb::grey(0.6) };
    world.spawn((Rectangle { width: 40.0, depth: 40.0 }, Placement::default(), matte));
    for number in 0..25 {
        let at = Placement::at(f64::from(number % 5) * 4.0 - 8.0, 0.7, f64::from(number / 5) * 4.0 - 8.0);
        world.spawn((Sphere { radius: 0.7 }, at, matte));
    }
    world
}

fn scene(mesh: &TriangleMesh, max_depth: u32) -> World {
    let mut world = floor(max_depth);
    let mesh = MeshInstance { geometry: MeshGeometry::new(mesh.clone()) };
    world.spawn((mesh, Placement::default(), Emissive { radiance: Rgb::grey(10.0), ..Emissive::default() }));
    world
}

/// Equilateral triangles turned anywhere, from 2 to 4 above the floor, of 4 square units altogether.
fn strewn(lights: u32) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    // An equilateral triangle in a circle of radius r has an area of 1.3 r².
    let radius = (4.0 / f64::from(lights) / 1.299).sqrt();
    for number in 0..lights {
        let mut draws = Draws::new(77, u64::from(number));
        let at = DVec3::new(draws.between(-10.0, 10.0), draws.between(2.0, 4.0), draws.between(-10.0, 10.0));
        let (right, up) = draws.unit_vector().normalize().any_orthonormal_pair();
        for corner in 0..3 {
            let (sine, cosine) = libm::sincos(std::f64::consts::TAU * f64::from(corner) / 3.0);
            mesh.positions.push((at + radius * (cosine * right + sine * up)).as_vec3().to_array());
        }
        mesh.triangles.push([3 * number, 3 * number + 1, 3 * number + 2]);
    }
    mesh
}

/// The knot above the floor, with about so many triangles.
fn knot(lights: u32) -> TriangleMesh {
    let around = (f64::from(lights) / 6.0).sqrt().max(3.0) as u32;
    let mut mesh = torus_knot((lights / (2 * around)).max(2), around);
    mesh.positions.iter_mut().for_each(|[_, y, _]| *y += 3.7);
    mesh
}

/// What one way to choose a light costs.
#[derive(Clone, Copy)]
struct Cost {
    /// Nanoseconds a sample.
    time: f64,
    /// Of a sample, relative to the square of its pixel's mean.
    variance: f64,
    mean: f64,
}

impl Cost {
    fn product(&self) -> f64 {
        self.time * self.variance
    }
}

/// One tile that is rendered again and again.
struct Bench {
    render: RenderWorld,
    time: Duration,
    sums: Vec<[f64; 2]>,
    taken: u32,
}

impl Bench {
    fn new(scene: &Census<'_>, change: impl FnOnce(&mut Vec<ExtractedTable>)) -> Self {
        let (plan, mut tables) = prepare(scene, &stages::all()).expect("prepared");
        change(&mut tables);
        let mut render = RenderWorld::of_pass(RowKind::Pixel, &plan, &tables, 1, &[]);
        let tile = render.tiles[0];
        let all = ActivePixels((0..SIDE * SIDE).collect());
        render.swap_film(tile, &mut FilmTile::new(Tile { x: 0, y: 0, width: SIDE, height: SIDE }));
        render.world.entity_mut(tile).insert(all);
        Self { render, time: Duration::MAX, sums: vec![[0.0; 2]; (SIDE * SIDE) as usize], taken: 0 }
    }

    fn take(&mut self, samples: u32) {
        let mut time = Duration::ZERO;
        for _ in 0..samples {
            self.render.world.entity_mut(self.render.tiles[0]).insert(SampleNumber(self.taken));
            let started = ProcessTime::now();
            self.render.run();
            time += started.elapsed();
            let radiance = self.render.world.get::<Radiance>(self.render.tiles[0]).expect("radiance");
            assert_eq!(radiance.rows(), self.sums.len());
            for ([sum, squares], &value) in self.sums.iter_mut().zip(&radiance.rgb[1]) {
                (*sum, *squares) = (*sum + f64::from(value), *squares + f64::from(value) * f64::from(value));
            }
            self.taken += 1;
        }
        self.time = self.time.min(time / samples);
    }

    fn cost(&self) -> Cost {
        let n = f64::from(self.taken);
        let lit = || self.sums.iter().filter(|[sum, _]| *sum > 0.0);
        let of_pixel = |[sum, squares]: &[f64; 2]| (squares / n) / (sum / n * sum / n) - 1.0;
        Cost {
            time: self.time.as_nanos() as f64 / f64::from(SIDE * SIDE),
            variance: lit().map(of_pixel).sum::<f64>() / lit().count() as f64 * n / (n - 1.0),
            mean: self.sums.iter().map(|[sum, _]| sum / n).sum::<f64>() / f64::from(SIDE * SIDE),
        }
    }
}

/// Both alternately.
fn compared([one, other]: [&mut Bench; 2], samples: u32) -> [Cost; 2] {
    for _ in 0..ROUNDS {
        one.take(samples);
        other.take(samples);
    }
    [one.cost(), other.cost()]
}

fn replace<T: Table + Clone>(tables: &mut [ExtractedTable], table: &T) {
    let place = tables.iter_mut().find(|own| own.name == T::NAME).expect("the table");
    let table = table.clone();
    place.insert = Box::new(move |world| world.insert_resource(Shared::new(table.clone())));
}

fn area_lights(world: &World, mesh: &TriangleMesh, samples: u32, first: &mut Option<Cost>) {
    let census = Census::of(world);
    let started = Instant::now();
    let lights = census.table::<AreaLightTable>().expect("lights");
    let (building, count) = (started.elapsed(), mesh.triangles.len());
    let bytes = lights.hierarchy.as_ref().map_or(0, |hierarchy| hierarchy.bytes()) as f64 / count as f64;
    let mut by_power = AreaLightTable::clone(&lights);
    by_power.hierarchy = None;
    (by_power.until, by_power.probability) = half_by_power(&by_power);
    let mut chosen = Bench::new(&census, |_| ());
    let mut power = Bench::new(&census, |tables| replace(tables, &by_power));
    let [own, power] = compared([&mut chosen, &mut power], samples);
    let ten = *first.get_or_insert(own);
    println!(
        "{count:>8} lights: {:>6.0} ns, variance {:>8.3}, product {:>9.0}; by power {:>6.0} ns, {:>9.3}, {:>9.0}; \
         efficiency {:>6.2} of by power; time {:.2}, product {:.2} of the first; means {:.4} and {:.4}; \
         {building:.1?}, {bytes:.0} bytes a light",
        own.time,
        own.variance,
        own.product(),
        power.time,
        power.variance,
        power.product(),
        power.product() / own.product(),
        own.time / ten.time,
        own.product() / ten.product(),
        own.mean,
        power.mean,
    );
}

/// The distribution that few lights have: half by power, half alike.
fn half_by_power(lights: &AreaLightTable) -> (Vec<u64>, Vec<f64>) {
    const PARTS: f64 = (1_u64 << 32) as f64;
    let count = lights.lights();
    let power = |light| lights.with_light(light, |emitter, radiance, _| luminance(radiance) * emitter.area());
    let powers: Vec<f64> = (0..count).map(power).collect();
    let all: f64 = powers.iter().sum();
    let mut sum = 0.0;
    let mut until: Vec<u64> = Vec::new();
    for power in powers {
        sum += 0.5 * (power / all + 1.0 / count as f64);
        until.push((sum * PARTS) as u64);
    }
    *until.last_mut().expect("a light") = 1 << 32;
    let before = std::iter::once(0).chain(until.iter().copied());
    let probability = until.iter().zip(before).map(|(until, before)| (until - before) as f64 / PARTS).collect();
    (until, probability)
}

fn point_lights(count: u32, samples: u32) {
    let mut world = floor(2);
    for number in 0..count {
        let mut draws = Draws::new(78, u64::from(number));
        let at = Placement::at(draws.between(-10.0, 10.0), draws.between(2.0, 4.0), draws.between(-10.0, 10.0));
        let intensity = Rgb::grey(40.0 / f64::from(count) * draws.power_of_ten(-1.0, 0.0));
        world.spawn((PointLight { intensity, ..PointLight::default() }, at));
    }
    let census = Census::of(&world);
    let lights = census.table::<LightsOf<PlacedPointLight>>().expect("lights");
    let mut own = Bench::new(&census, |_| ());
    if count > 1000 {
        (0..ROUNDS).for_each(|_| own.take(samples));
        let own = own.cost();
        return println!("{count:>8} lights: {:>8.0} ns, variance {:>8.4}", own.time, own.variance);
    }
    let summed = LightsOf { choice: None, ..LightsOf::clone(&lights) };
    let mut summed = Bench::new(&census, |tables| replace(tables, &summed));
    let [own, summed] = compared([&mut own, &mut summed], samples);
    println!(
        "{count:>8} lights: {:>8.0} ns, variance {:>8.4}; all summed {:>8.0} ns, {:>8.4}; means {:.4} and {:.4}",
        own.time, own.variance, summed.time, summed.variance, own.mean, summed.mean
    );
}
