//! Every registered light without an area, tested with no line for it: what it sends, what arrives, what it is refused.

#[path = "lights/many.rs"]
mod many;

use crate::scenes::named;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::lights::{
    Light, LightVisitor, ListedLight, PlacedLight, SceneLight, StartDraws, Target, Targets, visit_lights,
};
use pinhole::plan::Census;
use pinhole::render::{Execution, render};
use pinhole::scene::*;
use pinhole_lab::measure::draws::Draws;
use std::f64::consts::{PI, TAU};

/// The least likely of a thousand numbers lies within so many standard errors, 99 times in 100 (Šidák).
const LIMIT: f64 = 4.5;
/// Rays that start on each light.
const RAYS: u64 = 100_000;
/// The cells along each side of what is lit.
const CELLS: usize = 4;

/// A light as its component is by default, anywhere and turned anywhere.
fn placed<L: Light>(draws: &mut Draws) -> L {
    let (position, ahead) = (draws.unit_vector() * draws.between(0.0, 3.0), draws.unit_vector());
    let placed = PlacedLight { who: "a light", position, ahead: &|| Ok(ahead) };
    L::place(&L::Component::default(), &placed).expect("placed")
}

fn start_draws(draws: &mut Draws) -> StartDraws {
    let two = |draws: &mut Draws| [draws.unit(), draws.unit()];
    let (point, direction) = (two(draws), two(draws));
    StartDraws { light: 0, point, direction, target: draws.unit(), side: draws.unit() }
}

/// Sums of samples, cell by cell.
#[derive(Default)]
struct Sums([(f64, f64); CELLS * CELLS]);

impl Sums {
    fn add(&mut self, cell: usize, value: f64) {
        self.0[cell].0 += value;
        self.0[cell].1 += value * value;
    }

    /// How many standard errors the mean in a cell is off.
    fn off(&self, cell: usize, expected: f64) -> f64 {
        let (n, (sum, squares)) = (RAYS as f64, self.0[cell]);
        let (mean, variance) = (sum / n, squares / n - sum * sum / (n * n));
        // Where all rays have the same weight, rounding is all that is left.
        let error = (variance / n).sqrt().max(1e-9 * expected.abs());
        if mean == 0.0 && expected == 0.0 { 0.0 } else { (mean - expected) / error.max(f64::MIN_POSITIVE) }
    }
}

/// The place of a number in [0, 1) among the cells of a side.
fn cell_of([x, y]: [f64; 2]) -> Option<usize> {
    let inside = (0.0..1.0).contains(&x) && (0.0..1.0).contains(&y);
    inside.then(|| (y * CELLS as f64) as usize * CELLS + (x * CELLS as f64) as usize)
}

/// The mean over a cell of a function of the unit square, of which it takes `fine` values a side.
fn over_cell(cell: usize, fine: usize, of: impl Fn([f64; 2]) -> f64) -> f64 {
    let at = |cell: usize, part: usize| (cell as f64 + (part as f64 + 0.5) / fine as f64) / CELLS as f64;
    let parts = (0..fine).flat_map(|y| (0..fine).map(move |x| (x, y)));
    parts.map(|(x, y)| of([at(cell % CELLS, x), at(cell / CELLS, y)])).sum::<f64>() / (fine * fine) as f64
}

/// The rays that start on a light bring every part of a square the power that sampling the light says arrives there.
struct Squares {
    seed: u64,
    tried: usize,
    worst: f64,
}

impl Squares {
    fn check<L: ListedLight>(&mut self, light: &L, distance: f64, cosine: f64, draws: &mut Draws) {
        // A point on which its light falls.
        let lit = (0..100_000).map(|_| draws.unit_vector() * 4.0).find_map(|there| {
            let sample = light.sample(there);
            let to_light = sample.direction.as_dvec3();
            let moved =
                if sample.distance.is_finite() { there + to_light * (sample.distance - distance) } else { there };
            (light.sample(moved).strength[1] > 0.0).then_some((moved, to_light))
        });
        let (middle, to_light) = lit.expect("somewhere");
        let across = draws.unit_vector_across(to_light);
        let normal = to_light * cosine + across * (1.0 - cosine * cosine).sqrt();
        let (right, up) = normal.any_orthonormal_pair();
        let side = 0.3 * distance;
        // Its own sphere and two that overlap it.
        let radius = side * 0.72;
        let mut sphere = vec![Target { centre: middle, radius }];
        for _ in 0..2 {
            sphere.push(Target {
                centre: middle + draws.unit_vector() * radius,
                radius: radius * draws.between(0.5, 1.5),
            });
        }
        let scene = Target::around_all(&sphere);
        let whole = (draws.unit() < 0.5).then_some(scene);
        let targets = Targets { sphere, whole, scene, infinite: Vec::new() };
        let place = |[x, y]: [f64; 2]| middle + (right * (x - 0.5) + up * (y - 0.5)) * side;

        let mut sums = Sums::default();
        for _ in 0..RAYS {
            let start = light.start(&targets, &start_draws(draws));
            let (origin, falls) = (start.origin.as_dvec3(), start.direction.dot(normal));
            let hit = origin + start.direction * ((middle - origin).dot(normal) / falls) - middle;
            let at = [hit.dot(right) / side + 0.5, hit.dot(up) / side + 0.5];
            if let Some(cell) = cell_of(at).filter(|_| falls < 0.0) {
                sums.add(cell, start.power[1]);
            }
        }
        for cell in 0..CELLS * CELLS {
            let received = over_cell(cell, 32, |at| {
                let sample = light.sample(place(at));
                L::irradiance(&sample, normal.dot(sample.direction.as_dvec3()).max(0.0))[1]
            });
            let off = sums.off(cell, received * side * side / (CELLS * CELLS) as f64);
            self.worst = self.worst.max(off.abs());
            assert!(off.abs() < LIMIT, "{} at {distance}, cosine {cosine}: {off:+.1} SE", L::NAMES.table);
            self.tried += 1;
        }
    }
}

impl LightVisitor for Squares {
    fn visit<L: ListedLight>(&mut self) {
        for (index, distance) in [0.2, 1.0, 30.0].into_iter().enumerate() {
            for (other, cosine) in [1.0, 0.6, 0.15].into_iter().enumerate() {
                let mut draws = Draws::new(self.seed, 3 * index as u64 + other as u64);
                let light = placed::<L>(&mut draws);
                self.check(&light, distance, cosine, &mut draws);
            }
        }
        self.seed += 1;
    }
}

#[test]
fn rays_that_start_on_a_light_bring_the_irradiance_that_sampling_it_gives() {
    let mut squares = Squares { seed: 9100, tried: 0, worst: 0.0 };
    visit_lights(&mut squares);
    eprintln!("lights on squares: {} cells of {RAYS} rays each, worst {:.1} SE", squares.tried, squares.worst);
    assert!(squares.tried >= 3 * 9 * CELLS * CELLS);
}

/// The power of a light is what its radiant intensity sums to, and the rays that start on it have it between them.
struct Powers {
    tried: usize,
    worst: f64,
}

impl LightVisitor for Powers {
    fn visit<L: ListedLight>(&mut self) {
        for index in 0..4 {
            let mut draws = Draws::new(9200, index);
            let light = placed::<L>(&mut draws);
            if L::IS_DISTANT {
                let (across, sample) = (draws.between(0.1, 9.0), light.sample(draws.unit_vector()));
                let passes = L::irradiance(&sample, 1.0)[1] * across;
                assert!((light.power(across)[1] / passes - 1.0).abs() < 1e-12, "{}", L::NAMES.table);
                self.tried += 1;
                continue;
            }
            let sample = light.sample(DVec3::ZERO);
            let position = sample.direction.as_dvec3() * sample.distance;
            let direction = |[x, y]: [f64; 2]| {
                let (level, (sine, cosine)) = (2.0 * y - 1.0, libm::sincos(TAU * x));
                let out = (1.0 - level * level).max(0.0).sqrt();
                DVec3::new(out * cosine, level, out * sine)
            };
            let mut sums = Sums::default();
            for _ in 0..RAYS {
                let start = light.start(&Targets::default(), &start_draws(&mut draws));
                let DVec3 { x, y, z } = start.direction;
                let turn = libm::atan2(z, x) / TAU;
                let at = [if turn < 0.0 { turn + 1.0 } else { turn }, 0.5 + 0.5 * y].map(|part| part.min(1.0 - 1e-12));
                sums.add(cell_of(at).expect("a direction"), start.power[1]);
            }
            let mut whole = 0.0;
            for cell in 0..CELLS * CELLS {
                let mean = over_cell(cell, 400, |at| light.sample(position + direction(at)).strength[1]);
                let expected = mean * 4.0 * PI / (CELLS * CELLS) as f64;
                whole += expected;
                let off = sums.off(cell, expected);
                self.worst = self.worst.max(off.abs());
                assert!(off.abs() < LIMIT, "{}: {off:+.1} SE", L::NAMES.table);
            }
            let power = light.power(0.0)[1];
            assert!((whole / power - 1.0).abs() < 2e-3, "{}: {whole} for {power}", L::NAMES.table);
            self.tried += 1;
        }
    }
}

#[test]
fn the_power_of_a_light_is_the_sum_of_what_leaves_it() {
    let mut powers = Powers { tried: 0, worst: 0.0 };
    visit_lights(&mut powers);
    eprintln!("powers of lights: {} lights, worst direction {:.1} SE", powers.tried, powers.worst);
    assert!(powers.tried >= 12);
}

/// What every light is refused, and that each is on offer, is kept where it is needed and lights a ball.
struct InScenes(usize);

impl LightVisitor for InScenes {
    fn visit<L: ListedLight>(&mut self) {
        let scene = |motion: bool| {
            let mut world = World::new();
            world.spawn((Name::new("camera"), PerspectiveCamera::default(), Placement::at(0.0, 0.0, 4.0)));
            world.spawn((Sphere { radius: 1.0 }, Placement::default(), Matte::default()));
            let light = world.spawn((L::Component::default(), Placement::at(0.0, 0.0, 3.0))).id();
            if motion {
                let camera = named(&mut world, "camera");
                world.entity_mut(camera).insert(Shutter::default());
                world.entity_mut(light).insert(Motion { velocity: DVec3::X });
            }
            world
        };
        let film = render(&scene(false), &pinhole::stages::all(), &Execution::default(), &()).expect("renders").film;
        let middle = film.mean(film.width / 2, film.height / 2)[1];
        assert!(middle > 0.0, "{}: a ball in front of it is black", L::NAMES.table);
        let names = |world: &World| {
            let plan = pinhole::plan::plan(&Census::of(world), &pinhole::stages::all()).expect("a plan");
            plan.rows.iter().filter(|row| row.kept && row.stage == L::NAMES.sample).count()
        };
        assert_eq!(names(&scene(false)), 1, "{}", L::NAMES.sample);
        assert!(L::Component::default().casts_shadows(), "a light casts shadows unless it says otherwise");
        let moving = render(&scene(true), &pinhole::stages::all(), &Execution::default(), &()).err();
        let said = moving.expect("a light may not move").to_string();
        assert!(said.contains("only shapes and the camera may move, no light"), "{said}");
        self.0 += 1;
    }
}

#[test]
fn every_light_is_on_offer_lights_a_ball_and_may_not_move() {
    let mut scenes = InScenes(0);
    visit_lights(&mut scenes);
    eprintln!("lights in scenes: {}", scenes.0);
    assert!(scenes.0 >= 3);
}

/// E = I cos θ / d², of which a matte surface sends on ρ E / π, each colour by itself.
#[test]
fn a_coloured_point_light_fades_with_the_square_of_the_distance() {
    let (intensity, colour) = (Rgb::new(1.0, 2.0, 5.0), Rgb::new(0.9, 0.6, 0.2));
    let mut world = World::new();
    let look = LookAt { eye: DVec3::Y, target: DVec3::ZERO, up: DVec3::Z };
    world.spawn((OrthographicCamera { view_height: 1e-6 }, look, Resolution { width: 1, height: 1 }));
    world.spawn((Plane::default(), Matte { colour }));
    world.spawn((PointLight { intensity, ..PointLight::default() }, Placement::at(3.0, 4.0, 0.0)));
    let film = render(&world, &pinhole::stages::all(), &Execution::default(), &()).expect("renders").film;
    let reflected = colour.to_vec() * intensity.to_vec() * (4.0 / 5.0) / 25.0 / PI;
    let off = DVec3::from(film.mean(0, 0).map(f64::from)) / reflected - 1.0;
    assert!(off.abs().max_element() < 1e-6, "{:?} for {reflected}", film.mean(0, 0));
}

/// A file's sun, spotlight and camera may point straight down, or up, though nobody wrote an `up`: a light has no roll, so
/// that any other `up` gives the same, and the camera's is the default's.
#[test]
fn what_points_straight_down_needs_no_up() {
    let beam = "intensity: (40, 40, 40), inner_angle: 40, outer_angle: 60";
    let film = |camera: &str, light: &str, [camera_up, light_up]: [&str; 2]| {
        let text = format!(
            "[({camera}, resolution: (width: 24, height: 16), look_at: (eye: (0.5, 6, 1), target: (0.5, 0, 1){camera_up})),
              (cuboid: (size: (1, 2, 1)), matte: (colour: (0.8, 0.4, 0.2))),
              (plane: (normal: (0, 1, 0)), matte: (colour: (0.5, 0.5, 0.5))),
              ({light}, look_at: (eye: (0, 5, 0), target: (0, 0, 0){light_up}))]"
        );
        let file = SceneFile::parse(std::path::Path::new("scene.ron"), text).expect("a scene");
        let film = render(&file.world(), &crate::scenes::offer(), &Execution::default(), &()).expect("renders").film;
        (0..16).flat_map(|y| (0..24).map(move |x| (x, y))).map(|(x, y)| film.mean(x, y)).collect::<Vec<_>>()
    };
    let mut tried = 0;
    for camera in [
        "perspective_camera: (fov: 60)",
        "orthographic_camera: (view_height: 6)",
        "fisheye_camera: ()",
        "equirectangular_camera: ()",
    ] {
        for light in ["directional_light: (irradiance: (3, 3, 3))".to_owned(), format!("spot_light: ({beam})")] {
            let [default, written, other] =
                [["", ""], [", up: (0, 0, -1)", ""], ["", ", up: (1, 0, 0)"]].map(|ups| film(camera, &light, ups));
            assert!(default.iter().any(|light| light[0] > 0.1), "{camera}, {light}: nothing is lit");
            assert!(default == written && default == other, "{camera}, {light}");
            tried += 1;
        }
    }
    eprintln!("straight down: {tried} cameras and lights");
}
