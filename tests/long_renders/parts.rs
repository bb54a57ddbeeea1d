//! Parts of a render: whoever computes them, however the work is divided, they add up to the bits of one machine.

use super::*;
use pinhole::film::{Check, Part, PartEntry, PartFilm, Split, Unit, merge_parts};
use pinhole::{Chapter, Overrides, SamplingOverrides, Size};
use pinhole_lab::measure::draws::Draws;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

const SIZE_OF_PARTS: Resolution = Resolution { width: 33, height: 21 };

/// A scene of every integrator, and what is kept of a film beside its sums: name, chapter, samples, filter, error,
/// layers.
struct Case {
    name: &'static str,
    chapter: &'static str,
    samples: u32,
    filter: Option<Filter>,
    error: Option<f64>,
    layers: bool,
}

const PLAIN: Case = Case { name: "", chapter: "", samples: 70, filter: None, error: None, layers: false };
const CASES: [Case; 13] = [
    Case { name: "ray casting, one ray a pixel", chapter: "05_pinhole", samples: 0, ..PLAIN },
    Case { name: "ray casting, layers", chapter: "10_light_and_shadow", samples: 150, layers: true, ..PLAIN },
    Case { name: "Whitted", chapter: "20_glass", ..PLAIN },
    Case { name: "occlusion", chapter: "22_ambient_occlusion", samples: 129, ..PLAIN },
    Case { name: "distribution", chapter: "24_motion_blur", samples: 65, ..PLAIN },
    Case { name: "paths, layers", chapter: "25_path_tracing", layers: true, ..PLAIN },
    Case {
        name: "a filter with negative lobes",
        chapter: "26_choosing_samples",
        filter: Some(Filter::Mitchell { radius: 2.0, b: 1.0 / 3.0, c: 1.0 / 3.0 }),
        samples: 200,
        ..PLAIN
    },
    Case { name: "light tracing", chapter: "27_caustics", samples: 66, ..PLAIN },
    Case { name: "photons", chapter: "cover", samples: 66, ..PLAIN },
    Case { name: "joined paths", chapter: "39_both_ends", samples: 66, ..PLAIN },
    Case { name: "wavelengths", chapter: "38_dispersion", samples: 66, ..PLAIN },
    Case { name: "adaptive", chapter: "21_soft_shadows", samples: 300, error: Some(0.05), ..PLAIN },
    Case {
        name: "adaptive, layers",
        chapter: "25_path_tracing",
        samples: 140,
        error: Some(0.2),
        layers: true,
        ..PLAIN
    },
];

impl Case {
    fn chapter(&self) -> Chapter {
        chapters::all().into_iter().find(|own| own.name == self.chapter).expect("a chapter")
    }

    fn world(&self) -> World {
        let sampling = SamplingOverrides {
            samples: (self.samples > 0).then_some(self.samples),
            filter: self.filter,
            ..SamplingOverrides::default()
        };
        self.chapter().world(&Overrides {
            size: Some(Size::Pixels(SIZE_OF_PARTS)),
            sampling,
            error: self.error,
            layers: self.layers.then(Layers::all),
            ..Overrides::default()
        })
    }
}

fn begun(case: &Case, scene: &World, threads: usize) -> RenderInProgress {
    // Small tiles, so that a small picture has many.
    let execution = Execution { threads: Some(threads), tile_side: 16, ..Execution::default() };
    RenderInProgress::begin(&Census::of(scene), &case.chapter().stages(), &execution).expect("begins")
}

/// What one machine makes of it.
fn whole(case: &Case, scene: &World) -> Film {
    let mut render = begun(case, scene, 2);
    if !render.is_sampled() {
        render.advance(render.steps(), &()).expect("renders");
        return render.film;
    }
    let adaptive = pinhole::extract::adaptive_of(&Census::of(scene)).expect("a camera");
    render_in_passes(&mut render, &Limits { adaptive, ..Limits::default() }, &(), &mut |_| Ok(())).expect("renders");
    render.film
}

/// Computes a part and writes it, in as many runs as asked for, each from the file that the one before left.
fn write_part(case: &Case, scene: &World, part: Part, runs: u32, path: &Path) {
    let adaptive = pinhole::extract::adaptive_of(&Census::of(scene)).expect("a camera");
    for run in 0..runs {
        let mut render = begun(case, scene, 1 + (part.number + run) as usize % 3);
        let key = render.key(scene, &()).expect("nobody stops it");
        let mut own = render.begin_part(part, adaptive, &(), &mut |_| Ok(())).expect("begins");
        if run > 0 {
            own = PartFilm::read(&render.film, key, path).expect("the file of the run before");
        }
        let last = run + 1 == runs;
        let until = if last { Instant::now() + Duration::from_secs(3600) } else { Instant::now() };
        let complete = render.advance_part(&mut own, until, &()).expect("goes on");
        assert!(complete || !last);
        own.write(&render.film, key, path).expect("written");
    }
}

/// The same files in another order.
fn shuffled(mut paths: Vec<PathBuf>, seed: u64) -> Vec<PathBuf> {
    let mut draws = Draws::new(seed, 0);
    for at in (1..paths.len()).rev() {
        paths.swap(at, (draws.between(0.0, at as f64 + 1.0) as usize).min(at));
    }
    paths
}

/// No piece is checked but those on which two files disagree.
fn rendered_again(is_right: &mut dyn FnMut(&PartEntry, u32) -> bool) -> Check<'_> {
    Check { pieces: 0, is_right }
}

/// The camera's filter, and how many samples and light paths there are to be, where that does not depend on the error.
fn known(case: &Case, scene: &World) -> (Filter, Option<(u32, u64)>) {
    let filter = Census::of(scene).table::<pinhole::extract::FilterTable>().expect("a camera").filter;
    (filter, case.error.is_none().then(|| begun(case, scene, 1).expected()))
}

#[test]
fn parts_add_up_to_the_bits_of_one_machine() {
    let (mut merges, mut parts) = (0, 0);
    for case in &CASES {
        let scene = case.world();
        let expected = whole(case, &scene);
        let shape = begun(case, &scene, 1);
        let key = shape.key(&scene, &()).expect("nobody stops it");
        for (word, split) in Split::ALL {
            // More parts than there is work, once.
            let counts: &[u32] = if case.samples == 0 && split == Split::Both { &[1, 3, 40] } else { &[3] };
            for &of in counts {
                let folder = tempfile::tempdir().expect("a temporary folder");
                let path = |number: u32| folder.path().join(format!("{number}.checkpoint"));
                for number in 1..=of {
                    let runs = 1 + (number + of) % 2;
                    write_part(case, &scene, Part { number, of, split }, runs, &path(number));
                    parts += 1;
                }
                let paths = shuffled((1..=of).map(path).collect(), u64::from(of));
                let merged =
                    merge_parts(&shape.film, key, known(case, &scene), &paths, rendered_again(&mut |_, _| false))
                        .expect("merges");
                let what = format!("{}, {of} parts by {word}", case.name);
                assert_eq!((merged.complete, merged.used, merged.refused.len()), (true, of as usize, 0), "{what}");
                FilmBits::of(&merged.film).assert_is(&FilmBits::of(&expected), &what);
                assert!(merged.film == expected, "{what}: layers, moments, steps or rejected samples");
                merges += 1;
            }
        }
    }
    eprintln!("parts: {merges} merges of {} scenes, {parts} parts, every bit that of one machine", CASES.len());
}

/// A block ends with its 64th sample, wherever a pass does, and in one world for all tiles as in many.
#[test]
fn blocks_do_not_depend_on_passes_or_worlds() {
    let mut tried = 0;
    for case in [&CASES[1], &CASES[6], &CASES[9]] {
        let scene = case.world();
        let expected = whole(case, &scene);
        let adaptive = pinhole::extract::adaptive_of(&Census::of(&scene)).expect("a camera");
        for worlds in [Worlds::PerWorker, Worlds::One] {
            for cuts in [&[4, 66, 67, 68, 131][..], &[1, 67], &[130]] {
                let execution = Execution { threads: Some(2), tile_side: 16, worlds, ..Execution::default() };
                let mut render =
                    RenderInProgress::begin(&Census::of(&scene), &case.chapter().stages(), &execution).expect("begins");
                if let Some(adaptive) = adaptive {
                    render.begin_pilot();
                    render.advance(steps_of(adaptive.pilot), &()).expect("goes on");
                    let planned = pinhole::render::planned_samples(&render.film, adaptive.error);
                    render.begin_planned(planned);
                }
                let last = steps_of(if adaptive.is_some() {
                    render.film.most_planned().min(case.samples)
                } else {
                    case.samples
                });
                for &step in cuts.iter().filter(|step| **step < last).chain([&last]) {
                    render.advance(step, &()).expect("goes on");
                }
                assert!(render.film == expected, "{}, {worlds:?}, {cuts:?}", case.name);
                tried += 1;
            }
        }
    }
    eprintln!("blocks: {tried} ways to cut films of more than 64 samples, every field the same");
}

#[test]
fn a_merge_without_some_parts_says_so_and_shows_what_there_is() {
    let case = &CASES[5];
    let scene = case.world();
    let (expected, shape) = (whole(case, &scene), begun(case, &scene, 2));
    let key = shape.key(&scene, &()).expect("nobody stops it");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |number: u32| folder.path().join(format!("{number}.checkpoint"));
    let part = |number: u32| Part { number, of: 4, split: Split::Tiles };
    let mut lit = Vec::new();
    for number in [3, 1, 4, 2] {
        write_part(case, &scene, part(number), 1, &path(number));
        let paths: Vec<PathBuf> = (1..=4).map(path).filter(|path| path.exists()).collect();
        let merged = merge_parts(&shape.film, key, known(case, &scene), &paths, rendered_again(&mut |_, _| false))
            .expect("merges");
        assert_eq!(merged.complete, paths.len() == 4);
        assert_eq!(merged.missing.len(), 4 - paths.len());
        let done = merged.film.tiles.iter().zip(&expected.tiles).filter(|(own, other)| own == other).count();
        lit.push(done);
    }
    assert!(lit.windows(2).all(|pair| pair[0] < pair[1]) && lit[3] == expected.tiles.len(), "{lit:?}");
    // A part that was computed twice, and one that another division made, change nothing.
    fs::copy(path(2), folder.path().join("again.checkpoint")).expect("copied");
    write_part(case, &scene, Part { number: 2, of: 3, split: Split::Samples }, 1, &path(9));
    let mut paths: Vec<PathBuf> = (1..=4).map(path).collect();
    paths.extend([folder.path().join("again.checkpoint"), path(9)]);
    let merged =
        merge_parts(&shape.film, key, known(case, &scene), &paths, rendered_again(&mut |_, _| false)).expect("merges");
    assert!(merged.complete && merged.refused.is_empty() && merged.film == expected);
    // Without one, what is missing is a part of the division that most are of.
    paths.remove(0);
    let merged =
        merge_parts(&shape.film, key, known(case, &scene), &paths, rendered_again(&mut |_, _| false)).expect("merges");
    assert_eq!(merged.missing, [part(1)]);
    eprintln!("parts: tiles as they come {lit:?}, a part twice, and one of another division");
}

#[test]
fn a_part_that_is_not_of_this_render_is_refused_by_name() {
    let case = &CASES[5];
    let scene = case.world();
    let shape = begun(case, &scene, 2);
    let key = shape.key(&scene, &()).expect("nobody stops it");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (good, bad) = (folder.path().join("good.checkpoint"), folder.path().join("bad.checkpoint"));
    write_part(case, &scene, Part { number: 1, of: 2, split: Split::Tiles }, 1, &good);
    let other = |number: u32, samples: u32, write: &dyn Fn(PartFilm, &Film) -> PartFilm, key: u64| {
        let case = Case { samples, ..CASES[5] };
        let scene = case.world();
        let mut render = begun(&case, &scene, 1);
        let part = Part { number, of: 2, split: Split::Tiles };
        let mut own = render.begin_part(part, None, &(), &mut |_| Ok(())).expect("begins");
        render.advance_part(&mut own, Instant::now() + Duration::from_secs(60), &()).expect("goes on");
        write(own, &render.film).write(&render.film, key, &bad).expect("written");
    };
    let same = |own: PartFilm, _: &Film| own;
    let mut tried = 0;
    let mut refused = |because: &str| {
        // Whether it comes first or last, except where two hold the same samples: then the first counts.
        let paths = if because == "other sums" { [good.clone(), bad.clone()] } else { [bad.clone(), good.clone()] };
        let merged = merge_parts(&shape.film, key, known(case, &scene), &paths, rendered_again(&mut |_, _| false))
            .expect("the good part is used");
        assert_eq!((merged.used, merged.complete), (1, false), "{because}");
        let [(path, why)] = &merged.refused[..] else { panic!("{because}: {:?}", merged.refused) };
        assert!(path == &bad && why.contains("bad.checkpoint") && why.contains(because), "{because}: {why}");
        tried += 1;
    };
    other(2, 70, &same, key ^ 1);
    refused("another scene");
    other(2, 80, &same, key);
    refused("80 samples");
    other(
        1,
        70,
        &|mut own, _| {
            own.units[0].tile.sum[0][3] += 1e-6;
            own
        },
        key,
    );
    refused("other sums");
    other(
        2,
        70,
        &|mut own, _| {
            own.units[1].tile.sum[2][0] = -1.0;
            own
        },
        key,
    );
    refused("no render can have produced");
    other(
        2,
        70,
        &|mut own, _| {
            own.units[0].tile.count[0] -= 1;
            own
        },
        key,
    );
    refused("no render can have produced");
    other(
        2,
        70,
        &|mut own, _| {
            own.part.number = 1;
            own
        },
        key,
    );
    refused("no render can have produced");
    other(
        2,
        70,
        &|mut own, _| {
            own.units[0].unit.block = Some(0);
            own
        },
        key,
    );
    refused("no render can have produced");
    pinhole::film::write_checkpoint(&shape.film, key, &bad).expect("written");
    refused("a whole render");
    fs::write(&bad, [b'P'; 200]).expect("written");
    refused("not a checkpoint");
    other(2, 70, &same, key);
    let whole = fs::read(&bad).expect("read");
    let mut draws = Draws::new(3700, 0);
    for _ in 0..60 {
        let mut damaged = whole.clone();
        let at = (draws.between(0.0, whole.len() as f64) as usize).min(whole.len() - 1);
        damaged[at] ^= 1 << (draws.between(0.0, 8.0) as u32).min(7);
        fs::write(&bad, &damaged).expect("written");
        refused("");
        fs::write(&bad, &whole[..at]).expect("written");
        refused("");
    }
    fs::write(&bad, &whole).expect("written");
    assert!(
        merge_parts(&shape.film, key, known(case, &scene), &[good, bad], rendered_again(&mut |_, _| false))
            .expect("merges")
            .complete
    );
    eprintln!("parts: {tried} damaged, forged or foreign ones, each refused by name, the other one used");
}

/// A part whose sums somebody else has rendered, or made up, under this scene's key: nothing but rendering tells.
#[test]
fn a_part_that_is_made_up_is_told_by_rendering_some_of_it_again() {
    let mut tried = 0;
    for case in [&CASES[1], &CASES[5], &CASES[7], &CASES[9]] {
        let scene = case.world();
        let shape = begun(case, &scene, 2);
        let key = shape.key(&scene, &()).expect("nobody stops it");
        let expected = whole(case, &scene);
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = |name: &str| folder.path().join(format!("{name}.checkpoint"));
        let part = |number: u32, split: Split| Part { number, of: 2, split };
        for number in [1, 2] {
            write_part(case, &scene, part(number, Split::Tiles), 1, &path(&number.to_string()));
        }
        let adaptive = pinhole::extract::adaptive_of(&Census::of(&scene)).expect("a camera");
        for split in [Split::Tiles, Split::Both] {
            // All of its sums are others, black tiles included: whichever pieces are chosen, they are told.
            let mut render = begun(case, &scene, 1);
            let mut own = render.begin_part(part(2, split), adaptive, &(), &mut |_| Ok(())).expect("begins");
            render.advance_part(&mut own, Instant::now() + Duration::from_secs(60), &()).expect("goes on");
            own.units
                .iter_mut()
                .flat_map(|own| own.tile.sum.iter_mut().flatten())
                .for_each(|sum| *sum = 0.5 * *sum + 0.01);
            own.light.iter_mut().flat_map(|own| own.rgb.iter_mut().flatten()).for_each(|part| *part *= 0.5);
            own.write(&render.film, key, &path("made up")).expect("written");
            let again = begun(case, &scene, 2);
            let merged_with = |names: &[&str], pieces: usize| {
                let paths: Vec<PathBuf> = names.iter().map(|name| path(name)).collect();
                let check = Check { pieces, is_right: &mut |entry, samples| again.computes(entry, samples) };
                merge_parts(&shape.film, key, known(case, &scene), &paths, check).expect("merges")
            };
            let refused = |merged: &pinhole::film::Merged| match &merged.refused[..] {
                [(own, why)] => *own == path("made up") && why.contains("made up") && why.contains("other sums"),
                _ => false,
            };
            let checked = merged_with(&["1", "made up", "2"], 2);
            assert!(refused(&checked) && checked.film == expected, "{}: {:?}", case.name, checked.refused);
            if split == Split::Tiles {
                // Two that hold the same samples are told apart, whichever comes first.
                for names in [["1", "made up", "2"], ["2", "1", "made up"], ["made up", "2", "1"]] {
                    let merged = merged_with(&names, 0);
                    assert!(
                        refused(&merged) && merged.film == expected,
                        "{}, {names:?}: {:?}",
                        case.name,
                        merged.refused
                    );
                    tried += 1;
                }
                assert!(merged_with(&["1", "2"], 3).complete, "{}: true parts pass", case.name);
            }
            tried += 1;
        }
    }
    eprintln!(
        "parts: {tried} merges with one that is made up, which is refused by name, the picture that of one machine"
    );
}

/// Whatever the number of parts, every unit is in one part.
#[test]
fn every_unit_is_in_one_part() {
    let (mut tried, mut most) = (0, 0.0_f64);
    for tiles in [1, 2, 6, 35, 135, 2040] {
        for samples in [1, 64, 65, 1000] {
            for of in [1, 2, 3, 7, 64, 1000] {
                for (_, split) in Split::ALL {
                    let units = |number: u32| Part { number, of, split }.units(tiles, samples);
                    let all: Vec<Unit> = (1..=of).flat_map(units).collect();
                    let distinct: BTreeSet<Unit> = all.iter().copied().collect();
                    assert_eq!(all.len(), distinct.len(), "{split:?}");
                    let blocks = if all[0].block.is_none() { 1 } else { samples.div_ceil(pinhole::film::BLOCK) };
                    assert_eq!(all.len() as u32, tiles * blocks, "{split:?}, {of} parts of {tiles} tiles");
                    if split == Split::Chosen && all.len() as u32 >= of {
                        let sizes = (1..=of).map(|number| units(number).len());
                        let (min, max) = sizes.fold((usize::MAX, 0), |(min, max), own| (min.min(own), max.max(own)));
                        assert!(max - min <= 1, "{min} to {max} units");
                        most = most.max(max as f64 / (all.len() as f64 / f64::from(of)));
                    }
                    tried += 1;
                }
            }
        }
    }
    eprintln!("units: {tried} divisions, each unit in one part, the largest part {most:.2} times the mean one");
}
