//! Frames of a camera that goes round a mesh of 102,400 triangles, at 640 × 360, as the viewer makes them.

use super::{TARGET, after, scene, stages_of};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::film::GUIDES;
use pinhole::film::{rgba_bytes, rgba_of};
use pinhole::scene::*;
use pinhole_live::{FrameSource, Shot};
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// What frames consist of.
struct Mode {
    name: &'static str,
    prepare: fn(&mut EntityWorldMut<'_>),
    casts_shadows: bool,
    /// Whether the ground is a mirror; it is matte otherwise.
    mirrors: bool,
    /// Whether there is a sky that lights what it sees.
    sky: bool,
    /// The levels of the denoiser.
    levels: u32,
}

const LIT: Mode = Mode {
    name: "projected and lit, no shadows",
    prepare: |camera| _ = camera.insert(Rasterisation),
    casts_shadows: false,
    mirrors: false,
    sky: false,
    levels: 0,
};

const MODES: [Mode; 5] = [
    LIT,
    Mode { name: "projected, with traced shadows", casts_shadows: true, ..LIT },
    Mode { name: "rays, with traced shadows", casts_shadows: true, prepare: |_| (), ..LIT },
    Mode {
        name: "projected, shadows and one reflection",
        prepare: |camera| _ = camera.insert((Rasterisation, Integrator::Whitted { max_depth: 3 })),
        casts_shadows: true,
        mirrors: true,
        ..LIT
    },
    Mode {
        name: "projected, shadows, one ray of reflection or of the sky's occlusion and a shadow ray where it hits, denoised",
        prepare: |camera| {
            let path = Integrator::Path { max_depth: 3, lights: LightStrategy::Bsdf, roulette: 0 };
            let sampling = Sampling { samples: 1, filter: Filter::BOX, ..Sampling::default() };
            camera.insert((Rasterisation, path, sampling, Layers { kinds: GUIDES.to_vec() }));
        },
        casts_shadows: true,
        mirrors: true,
        sky: true,
        levels: 3,
    },
];

/// Times the frames of each mode.
pub fn measure() {
    let frames = after("--frames", 1000_u32);
    let only = after("--mode", MODES.len());
    for (number, mode) in MODES.iter().enumerate().filter(|(number, _)| only == *number || only == MODES.len()) {
        let (mut world, camera) = scene([800, 64], [640, 360]);
        (mode.prepare)(&mut world.entity_mut(camera));
        let ground = [DVec3::new(-20.0, -1.6, -20.0), DVec3::new(0.0, -1.6, 20.0), DVec3::new(20.0, -1.6, -20.0)];
        let mut floor = world.spawn(Triangle { vertices: ground, ..Triangle::default() });
        match mode.mirrors {
            true => floor.insert(Mirror::default()),
            false => floor.insert(Matte::default()),
        };
        if mode.sky {
            world.spawn(Gradient { bottom: Rgb::grey(0.4), top: Rgb::new(0.5, 0.7, 1.0) });
        }
        let intensity = Rgb::grey(900.0);
        world.spawn((PointLight { intensity, casts_shadows: mode.casts_shadows }, Placement::at(4.0, 9.0, 6.0)));
        if only == number {
            world.entity_mut(camera).insert(Statistics);
        }
        let offer = stages_of();
        let (mut source, mut stages, mut pixels_took) = (FrameSource::default(), BTreeMap::new(), 0.0);
        let mut times: Vec<f64> = (0..=frames)
            .map(|frame| {
                let angle = f64::from(frame) * 0.01;
                let eye = DVec3::new(8.0 * libm::sin(angle), 5.0, 8.0 * libm::cos(angle));
                let started = Instant::now();
                world.entity_mut(camera).insert(LookAt { eye, target: TARGET, ..LookAt::default() });
                let shot = Shot {
                    scene: &world,
                    offer: &offer,
                    changed: true,
                    patience: Duration::ZERO,
                    gathers: mode.levels > 0,
                    region: None,
                };
                let progress = source.film(&shot, &()).expect("a frame");
                let rendered = started.elapsed().as_secs_f64();
                for (stage, lap) in progress.plan.stages.iter().zip(&progress.laps) {
                    *stages.entry(stage.name).or_insert(0.0) += lap.time.as_secs_f64();
                }
                let began = Instant::now();
                let picture = source.picture(mode.levels).expect("a film");
                std::hint::black_box(match &picture.denoised {
                    Some(radiance) => rgba_of(radiance, picture.curve),
                    None => rgba_bytes(picture.film, picture.curve),
                });
                let developed = began.elapsed().as_secs_f64();
                pixels_took += developed;
                rendered + developed
            })
            .collect();
        // The first frame starts the threads and builds what later ones keep.
        times.remove(0);
        times.sort_by(f64::total_cmp);
        let at = |part: f64| times[((times.len() - 1) as f64 * part) as usize];
        println!(
            "{}: median {:.1} ms ({:.0} frames a second), 99 % below {:.1} ms, {frames} frames; of which the bytes of the pixels {:.1} ms on average",
            mode.name,
            1e3 * at(0.5),
            1.0 / at(0.5),
            1e3 * at(0.99),
            1e3 * pixels_took / f64::from(frames + 1),
        );
        let mut stages: Vec<_> = stages.into_iter().filter(|&(_, time)| time > 0.0).collect();
        stages.sort_by(|one, other| other.1.total_cmp(&one.1));
        for (stage, time) in stages {
            println!("  {stage:45} {:7.2} ms, summed over the workers", 1e3 * time / f64::from(frames + 1));
        }
    }
}
