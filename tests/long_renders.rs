//! Renders in passes: the same bits however they are cut, stopped and continued; by time; by error; with layers.

use crate::scenes;
use pinhole::plan::Census;

#[path = "long_renders/adaptive.rs"]
mod adaptive;
#[path = "long_renders/kept.rs"]
mod kept;
#[path = "long_renders/kill.rs"]
mod kill;
#[path = "long_renders/killed.rs"]
mod killed;
#[path = "long_renders/layers.rs"]
mod layers;
#[path = "long_renders/parts.rs"]
mod parts;
#[path = "long_renders/rare_light.rs"]
mod rare_light;
#[path = "long_renders/stopped.rs"]
mod stopped;

use bevy_ecs::prelude::*;
use pinhole::Error;
use pinhole::film::{Film, read_checkpoint, write_checkpoint};
use pinhole::render::{Execution, Limits, RenderInProgress, Watch, Worlds, render, render_in_passes, steps_of};
use pinhole::scene::*;
use pinhole_lab::measure::film_bits::FilmBits;
use scenes::{Setup, full, named};
use std::fs;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Every stage, and those that every chapter has.
pub fn offer() -> Vec<pinhole::plan::Stage> {
    pinhole::Chapter::new("all", "all", |_| ()).offer(crate::scenes::offer_of_direct_light()).stages()
}

/// A scene whose camera takes samples, and whatever else is put on it.
pub fn sampled(size: [u32; 2], sampling: Sampling, more: impl Bundle) -> World {
    let mut scene = full(Setup { size, ..Setup::default() });
    let camera = named(&mut scene, "camera");
    scene.entity_mut(camera).insert((sampling, more));
    scene
}

/// The key of a scene's film.
pub fn key_of(scene: &World) -> u64 {
    let render = RenderInProgress::begin(&Census::of(scene), &offer(), &Execution::default()).expect("begins");
    render.key(scene, &()).expect("nobody stops it")
}

const SIZE: [u32; 2] = [45, 37];

fn seven(sampler: Sampler) -> Sampling {
    Sampling { samples: 7, seed: 5, sampler, ..Sampling::default() }
}

fn everything_of(film: &Film) -> (FilmBits, &Vec<pinhole::film::FilmMoments>) {
    (FilmBits::of(film), &film.moments)
}

#[test]
fn passes_of_any_lengths_make_the_same_film() {
    let variance = Layers { kinds: vec![LayerKind::Variance] };
    let mut tried = 0;
    for (_, sampler) in Sampler::ALL {
        let scene = sampled(SIZE, seven(sampler), variance.clone());
        let whole = render(&scene, &offer(), &Execution::default(), &()).expect("renders").film;
        assert!(FilmBits::of(&whole).colours() > 500);
        let cuts: [&[u32]; 5] = [&[1, 2, 3, 4], &[2, 5, 6, 9], &[4], &[3, 8], &[1, 10]];
        for (number, cut) in cuts.into_iter().enumerate() {
            for worlds in [Worlds::PerWorker, Worlds::One] {
                let threads = Some(1 + number % 3);
                let execution = Execution { threads, worlds, ..Execution::default() };
                let mut in_progress =
                    RenderInProgress::begin(&Census::of(&scene), &offer(), &execution).expect("begins");
                for &step in cut.iter().chain([&steps_of(7)]) {
                    in_progress.advance(step, &()).expect("goes on");
                }
                assert!(everything_of(&in_progress.film) == everything_of(&whole), "{sampler:?}, {cut:?}, {worlds:?}");
                tried += 1;
            }
        }
        for tile_side in [8, 31, 64] {
            let execution = Execution { tile_side, ..Execution::default() };
            let mut in_progress = RenderInProgress::begin(&Census::of(&scene), &offer(), &execution).expect("begins");
            for step in [1, 2, 3, 6, steps_of(7)] {
                in_progress.advance(step, &()).expect("goes on");
            }
            FilmBits::of(&in_progress.film).assert_is(&FilmBits::of(&whole), &format!("tiles of {tile_side}"));
            tried += 1;
        }
        let limits = Limits { write_every: Some(Duration::ZERO), ..Limits::default() };
        let mut in_progress =
            RenderInProgress::begin(&Census::of(&scene), &offer(), &Execution::default()).expect("begins");
        let mut kept = 0;
        let mut keep = |_: &Film| {
            kept += 1;
            Ok(())
        };
        let outcome = render_in_passes(&mut in_progress, &limits, &(), &mut keep).expect("renders");
        assert_eq!((outcome.samples, outcome.stopped, outcome.out_of_time), (7, false, false));
        assert!(kept >= 3, "kept {kept} times");
        assert!(everything_of(&in_progress.film) == everything_of(&whole), "{sampler:?} in passes");
        tried += 1;
    }
    eprintln!("passes: {tried} ways to cut {} films of 7 samples, every bit the same", Sampler::ALL.len());
}

#[test]
fn the_first_pass_shows_every_eighth_pixel_and_the_others_show_it_too() {
    let scene = sampled(SIZE, seven(Sampler::Sobol), ());
    let mut in_progress =
        RenderInProgress::begin(&Census::of(&scene), &offer(), &Execution::default()).expect("begins");
    let mut seen = Vec::new();
    for (step, lattice) in [(1, 8), (2, 4), (3, 2), (4, 1)] {
        in_progress.advance(step, &()).expect("goes on");
        let film = &in_progress.film;
        let traced: u32 = film.tiles.iter().flat_map(|tile| &tile.count).sum();
        assert_eq!(traced, SIZE[0].div_ceil(lattice) * SIZE[1].div_ceil(lattice));
        for y in 0..SIZE[1] {
            for x in 0..SIZE[0] {
                let shown = film.mean(x, y);
                assert_eq!(shown, film.mean(x / lattice * lattice, y / lattice * lattice), "{x},{y} of {lattice}");
            }
        }
        seen.push(traced);
    }
    eprintln!("low resolution first: {seen:?} of {} pixels are traced", SIZE[0] * SIZE[1]);
}

/// Stops after so many tiles.
struct StopAfter(AtomicU64);

impl Watch for StopAfter {
    fn tile_done(&self) {
        let _ = self.0.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1));
    }

    fn stopped(&self) -> bool {
        self.0.load(Ordering::Relaxed) == 0
    }
}

#[test]
fn a_render_that_is_stopped_between_two_tiles_goes_on_from_its_checkpoint() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("picture.checkpoint");
    let sampling = seven(Sampler::Sobol);
    let scene = sampled(SIZE, sampling, Layers::all());
    let census = &Census::of(&scene);
    let key = key_of(&scene);
    let whole = render(&scene, &offer(), &Execution::default(), &()).expect("renders").film;
    let mut stops = 0;
    for tiles in 1..20 {
        let execution = Execution { threads: Some(2), tile_side: 16, ..Execution::default() };
        let mut in_progress = RenderInProgress::begin(census, &offer(), &execution).expect("begins");
        let watch = StopAfter(AtomicU64::new(tiles));
        for step in [1, 4, 6, steps_of(7)] {
            match in_progress.advance(step, &watch) {
                Ok(()) => {}
                Err(Error::Interrupted) => {
                    stops += 1;
                    break;
                }
                Err(error) => panic!("{error}"),
            }
        }
        write_checkpoint(&in_progress.film, key, &path).expect("written");
        let kept = read_checkpoint(key, &in_progress.film, false, &path).expect("read");
        assert!(kept == in_progress.film, "a checkpoint holds all of a film");
        let mut next = RenderInProgress::begin(census, &offer(), &Execution::default()).expect("begins");
        next.take(kept);
        next.advance(steps_of(7), &()).expect("goes on");
        FilmBits::of(&next.film).assert_is(&FilmBits::of(&whole), &format!("stopped after {tiles} tiles"));
        let by_pixel = |film: &Film| -> Vec<Vec<u64>> {
            let places = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
            let bits = |(x, y)| {
                let (tile, row) = film.place(x, y);
                let (layers, moments) = (&film.layers[tile], &film.moments[tile]);
                let sums = layers.sums.iter().map(|component| component[row].to_bits());
                let counts = layers.counts().map(|component| u64::from(component[row]));
                sums.chain(counts).chain([moments.sum[0][row].to_bits(), moments.sum[2][row].to_bits()]).collect()
            };
            places.map(bits).collect()
        };
        assert!(by_pixel(&next.film) == by_pixel(&whole), "layers and moments after {tiles} tiles");
    }
    assert!(stops > 5, "only {stops} stops");
    eprintln!("stopped: {stops} times between two tiles, continued to the same bits with all layers");
}

#[test]
fn a_checkpoint_that_is_not_this_render_s_is_refused_in_one_sentence() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("picture.checkpoint");
    let key_of = |sampling: Sampling, more: Layers| key_of(&sampled(SIZE, sampling, more));
    let (sobol, layers) = (seven(Sampler::Sobol), Layers { kinds: vec![LayerKind::Position] });
    let key = key_of(sobol, layers.clone());
    assert_eq!(key, key_of(Sampling { samples: 70, ..sobol }, layers.clone()), "more samples continue it");
    for other in [
        key_of(Sampling { seed: 6, ..sobol }, layers.clone()),
        key_of(Sampling { filter: Filter::Box { radius: 0.25 }, ..sobol }, layers.clone()),
        key_of(sobol, Layers { kinds: vec![LayerKind::Normal] }),
        key_of(seven(Sampler::Independent), layers.clone()),
    ] {
        assert_ne!(key, other);
    }
    let stratified = seven(Sampler::Stratified);
    assert_ne!(key_of(stratified, layers.clone()), key_of(Sampling { samples: 8, ..stratified }, layers.clone()));

    let scene = sampled([16, 16], sobol, layers);
    let film = render(&scene, &offer(), &Execution::default(), &()).expect("renders").film;
    write_checkpoint(&film, key, &path).expect("written");
    let good = fs::read(&path).expect("read");
    let refused = |bytes: &[u8], key: u64| {
        fs::write(&path, bytes).expect("written");
        let said = read_checkpoint(key, &film, false, &path).err().map(|error| error.to_string()).unwrap_or_default();
        assert!(said.starts_with(&format!("cannot continue from {}: ", path.display())), "{said}");
        assert!(!said.contains('\n') && !said.ends_with('.'), "{said}");
        said
    };
    let mut cut = 0;
    for length in (0..good.len()).step_by(97).chain([good.len() - 1]) {
        let said = refused(&good[..length], key);
        assert!(said.contains("cut short or damaged"), "{length}: {said}");
        cut += 1;
    }
    let mut damaged = 0;
    for at in (32..good.len()).step_by(61) {
        let mut bytes = good.clone();
        bytes[at] ^= 0x10;
        let said = refused(&bytes, key);
        assert!(said.contains("cut short or damaged"), "{at}: {said}");
        damaged += 1;
    }
    assert!(refused(&[good.as_slice(), b"x"].concat(), key).contains("cut short or damaged"));
    assert!(refused(b"PNG and more than twenty bytes", key).contains("not a checkpoint"));
    assert!(refused(&good, key + 1).contains("belongs to another scene"));
    let mut later = good.clone();
    later[20] = 9;
    assert!(refused(&later, key).contains("version 9"));
    eprintln!("checkpoints: {cut} cut short, {damaged} damaged, all refused");
}

/// The checksum is no signature, so whoever wants to can write one: no film that no render leaves is taken.
#[test]
fn a_forged_checkpoint_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("picture.checkpoint");
    let scene =
        sampled([40, 24], seven(Sampler::Sobol), Layers { kinds: vec![LayerKind::Position, LayerKind::Variance] });
    let film = render(&scene, &offer(), &Execution::default(), &()).expect("renders").film;
    write_checkpoint(&film, 1, &path).expect("written");
    assert!(read_checkpoint(1, &film, false, &path).expect("read") == film, "the true one is taken");
    let forgeries: [(&str, fn(&mut Film)); 13] = [
        ("counts", |film| film.tiles[0].count[3] = u32::MAX),
        ("one count too many", |film| film.tiles[0].count[3] += 1),
        ("infinite light", |film| film.tiles[1].sum[0][0] = f64::INFINITY),
        ("light that is NaN", |film| film.tiles[1].sum[1][5] = f64::NAN),
        ("negative light", |film| film.tiles[0].sum[2][0] = -1.0),
        ("infinite moments", |film| film.moments[0].sum[0][0] = f64::INFINITY),
        ("steps", |film| film.done[0] = u32::MAX),
        ("all steps", |film| film.done.fill(u32::MAX)),
        ("a pilot without an error", |film| film.pilot = true),
        ("a plan without an error", |film| {
            film.planned = film.tiles.iter().map(|own| vec![9; own.count.len()]).collect()
        }),
        ("rejected samples", |film| film.tiles[0].rejected = u64::MAX),
        ("layers", |film| film.layers[0].hits[0] = film.layers[0].taken[0] + 1),
        ("tiles of one pixel", |film| {
            *film = Film { done: vec![10; 960], moments: film.moments.clone(), ..Film::new(40, 24, 1) };
        }),
    ];
    for (what, forge) in forgeries {
        let mut forged = film.clone();
        forge(&mut forged);
        write_checkpoint(&forged, 1, &path).expect("written");
        let said = read_checkpoint(1, &film, false, &path).err().map(|error| error.to_string()).unwrap_or_default();
        assert!(said.ends_with("the file is cut short or damaged"), "{what}: {said}");
    }
}

/// A pipe that nobody writes to once made `--resume` wait for ever.
#[cfg(unix)]
#[test]
fn a_checkpoint_that_is_a_pipe_is_refused_at_once() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("picture.checkpoint");
    assert!(std::process::Command::new("mkfifo").arg(&path).status().expect("mkfifo").success());
    let said = read_checkpoint(1, &Film::new(1, 1, 32), false, &path).expect_err("refused").to_string();
    assert!(said.starts_with("cannot continue: ") && said.ends_with("is not a regular file"), "{said}");
}

#[test]
fn a_time_is_kept_to_within_a_pass() {
    let sampling = Sampling { samples: 1 << 20, ..seven(Sampler::Sobol) };
    let scene = sampled(SIZE, sampling, ());
    for time in [50, 200, 600].map(Duration::from_millis) {
        let mut in_progress =
            RenderInProgress::begin(&Census::of(&scene), &offer(), &Execution::default()).expect("begins");
        let began = Instant::now();
        let limits = Limits { time: Some(time), ..Limits::default() };
        let outcome = render_in_passes(&mut in_progress, &limits, &(), &mut |_| Ok(())).expect("renders");
        let took = began.elapsed();
        assert!(outcome.out_of_time && outcome.samples >= 1);
        // A machine that others work on too may take a pass out of turn.
        assert!(took < time * 3 + Duration::from_millis(300), "{time:?} became {took:?}");
        let over = took.as_secs_f64() / time.as_secs_f64() - 1.0;
        eprintln!("time: {time:?} asked, {took:?} taken ({:+.1} %), {} samples", over * 100.0, outcome.samples);
    }
}
