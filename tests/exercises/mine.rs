//! `render NN --mine`: a solution makes pinhole's picture, a mistake another one, and what fails says so in a sentence.

use super::answers::{ALL, Answers, chapter_05_pinhole, chapter_10_light_and_shadow, chapter_22_ambient_occlusion};
use super::listed::chapter_10_light_and_shadow::check::exercise as light;
use super::listed::chapter_22_ambient_occlusion::check::exercise as sky;
use super::shown::{Scenes, Shown, mistakes_of};
use super::{listed, pinhole as perspective, right, run, untouched};
use ::pinhole::film::{Film, GUIDES, denoise};
use ::pinhole::render::{Execution, render};
use ::pinhole::scene::{Filter, Layers, Resolution, Sampling};
use ::pinhole::{Chapter, Overrides, SamplingOverrides};
use chapters::all;
use pinhole_lab::exercise::{Exercise, Mine, end_at_panics};
use pinhole_lab::naive::denoise::LEVELS;
use std::fs;
use std::process::Command;

const WIDTH: u32 = 48;
const HEIGHT: u32 = 27;

/// How a solution's picture may differ from pinhole's.
enum Differ {
    /// In no bit.
    Nowhere,
    /// By this part of the brightest pixel, in all but so many pixels, whose rays pass an edge on its other side.
    By(f32, usize),
}

/// What each exercise allows; where its answers are exact, so is the picture.
fn allowed(chapter: &str) -> Differ {
    match &chapter[..2] {
        "01" | "06" | "11" | "12" => Differ::Nowhere,
        _ => Differ::By(1e-4, 4),
    }
}

/// A small size, and few samples where pixels are sampled at all.
fn asked(chapter: &Chapter) -> Overrides {
    let resolution = Some(Resolution { width: WIDTH, height: HEIGHT });
    let own = Overrides { resolution, ..Overrides::default() };
    let mut scene = chapter.world(&own);
    let sampled = scene.query::<&Sampling>().iter(&scene).next().is_some();
    let samples = sampled.then_some(if chapter.name.starts_with("21") { 256 } else { 2 });
    // The exercise of chapter 17 writes the tent's places.
    let filter = chapter.name.starts_with("17").then_some(Filter::Tent { radius: 1.0 });
    Overrides { sampling: SamplingOverrides { samples, filter, ..SamplingOverrides::default() }, ..own }
}

fn film(chapter: &Chapter, asked: &Overrides) -> ::pinhole::Result<Film> {
    Ok(render(&chapter.world(asked), &chapter.stages(), &Execution::default(), &())?.film)
}

/// Pinhole's picture. The function of chapter 35 stands in the denoiser, so that is what its picture has gone through.
fn kept(chapter: &Chapter) -> Film {
    let asked = asked(chapter);
    if !chapter.name.starts_with("35") {
        return film(chapter, &asked).expect("renders");
    }
    let layers = Some(Layers { kinds: GUIDES.to_vec() });
    let film = film(chapter, &Overrides { layers, ..asked }).expect("renders");
    let smooth = denoise(&film, LEVELS).expect("its layers");
    let mut picture = Film::new(WIDTH, HEIGHT, film.tile_side);
    for tile in &mut picture.tiles {
        for row in 0..tile.tile.rows() {
            let [x, y] = tile.tile.pixel_of(row);
            tile.add(row, smooth.each_ref().map(|part| part[(y * WIDTH + x) as usize]));
        }
    }
    picture
}

/// The picture with a function in it.
fn mine(chapter: &Chapter, exercise: &Exercise) -> ::pinhole::Result<Film> {
    let asked = asked(chapter);
    let mine = Mine::of(exercise, chapter, &chapter.world(&asked))?;
    let film = film(&mine.chapter, &asked)?;
    mine.answers()?;
    Ok(film)
}

fn pixels(film: &Film) -> Vec<[f32; 3]> {
    (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y))).map(|(x, y)| film.mean(x, y)).collect()
}

/// Whether the two are alike, and in what they differ.
fn alike(kept: &Film, made: &Film, allowed: &Differ) -> (bool, String) {
    let (kept, made) = (pixels(kept), pixels(made));
    let brightest = kept.iter().flatten().fold(0.0_f32, |max, part| max.max(part.abs()));
    let apart = |a: &[f32; 3], b: &[f32; 3]| (0..3).map(|part| (a[part] - b[part]).abs()).fold(0.0, f32::max);
    let off: Vec<f32> = kept.iter().zip(&made).map(|(a, b)| apart(a, b) / brightest).collect();
    let bits = kept.iter().flatten().zip(made.iter().flatten()).filter(|(a, b)| a.to_bits() != b.to_bits()).count();
    let max = off.iter().fold(0.0_f32, |max, off| max.max(*off));
    let far = off.iter().filter(|off| **off > 1e-4).count();
    let told = format!("{bits} numbers differ, {far} pixels by more than 1e-4, the most by {max:.1e}");
    let is = match *allowed {
        Differ::Nowhere => bits == 0,
        Differ::By(part, edges) => off.iter().filter(|off| off.is_nan() || **off > part).count() <= edges,
    };
    (is, told)
}

#[test]
fn a_solution_makes_pinhole_s_picture_and_a_mistake_another_one() {
    let (chapters, mut seen, mut wrong) = (all(), 0, Vec::new());
    for (name, answers) in ALL {
        let chapter = chapters.iter().find(|chapter| chapter.name == *name).expect("the chapter");
        let Answers { solution: solved, wrong: mistakes, .. } = answers();
        // Its function stands in no stage, and its picture is painted.
        if name.starts_with("18") {
            continue;
        }
        let kept = kept(chapter);
        match mine(chapter, &solved).map(|made| alike(&kept, &made, &allowed(name))) {
            Ok((true, told)) => eprintln!("{name}: {told}"),
            Ok((false, told)) => wrong.push(format!("{name}: the solution's picture is not pinhole's: {told}")),
            Err(refused) => wrong.push(format!("{name}: {refused}")),
        }
        let differs = |exercise: &Exercise| match mine(chapter, exercise) {
            Ok(made) => !alike(&kept, &made, &allowed(name)).0,
            Err(_) => true,
        };
        // One is enough here; the next test tries all.
        if !mistakes.iter().any(|(mistake, _)| differs(mistake)) {
            wrong.push(format!("{name}: no mistake shows in the picture"));
        }
        seen += 1;
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    eprintln!("mine: {seen} chapters of {} render with a reader's function", ALL.len());
    assert!(seen >= 26);
}

/// Mistakes that no picture shows, each with the reason.
const UNSEEN: [(&str, &str); 0] = [];

/// At smaller sizes than `render N --mine` has by default, which `cargo bench --bench mine` tries: the second for what the
/// first does not show.
#[test]
fn the_picture_shows_every_mistake_that_is_named() {
    let (chapters, mut mistakes, mut wrong) = (all(), 0, Vec::new());
    for (name, answers) in ALL {
        let chapter = chapters.iter().find(|chapter| chapter.name == *name).expect("the chapter");
        let (mut small, mut large) = (asked(chapter), asked(chapter));
        small.sampling.samples = small.sampling.samples.map(|_| 2);
        large.resolution = Some(Resolution { width: 96, height: 54 });
        large.sampling.samples = large.sampling.samples.map(|_| 4);
        match Shown::of(chapter, &answers().solution, &large) {
            Shown::Pictures(_, seen) if seen.iter().all(|seen| !seen.is_shown() && seen.part_over_3 < 1e-3) => {}
            Shown::Pictures(_, seen) => wrong.push(format!("{name}: the solution's picture differs: {seen:?}")),
            Shown::Sentence(told) => wrong.push(format!("{name}: {told}")),
        }
        for (mistake, shown) in mistakes_of(chapter, *answers, &[small, large], Scenes::UntilShown) {
            mistakes += 1;
            let is_known = UNSEEN.contains(&(name, mistake));
            if shown.is_shown() == is_known {
                wrong.push(format!("{name}, {mistake}: {}", if is_known { "is shown by now" } else { "is not shown" }));
            }
        }
    }
    assert!(wrong.is_empty(), "{} of {mistakes}:\n{}", wrong.len(), wrong.join("\n"));
    assert!(20 * UNSEEN.len() <= mistakes);
    eprintln!("mistakes: {} of {mistakes} are seen in a picture", mistakes - UNSEEN.len());
}

/// What is the same in both pictures cancels, whatever its noise; what is not is told beyond it.
#[test]
fn a_sentence_says_by_how_much_the_pictures_differ() {
    let chapters = all();
    let said = |name: &str, exercise: Exercise| {
        let chapter = chapters.iter().find(|chapter| chapter.name == name).expect("the chapter");
        match Shown::of(chapter, &exercise, &asked(chapter)) {
            Shown::Pictures(_, seen) => seen[0].sentence(),
            Shown::Sentence(told) => told,
        }
    };
    assert_eq!(said("05_pinhole", right()), "yours is pinhole's picture, to the last bit");
    let half = said(
        "10_light_and_shadow",
        light(|c, i, p, n, l| 0.5 * chapter_10_light_and_shadow::answers::solution(c, i, p, n, l)),
    );
    assert!(half.starts_with("yours is 50 % darker on average; "), "{half}");
    let brighter =
        said("22_ambient_occlusion", sky(|u, v| chapter_22_ambient_occlusion::answers::solution(0.5 * u, v)));
    assert!(brighter.contains(" % brighter on average (noise alone: ± "), "{brighter}");
    assert!(!brighter.contains("as far as its noise lets one see"), "eight standard errors are none: {brighter}");
}

#[test]
fn what_no_picture_can_hold_is_told_with_pixel_input_and_answer() {
    let chapters = all();
    let chapter = chapters.iter().find(|chapter| chapter.name == "05_pinhole").expect("the chapter");
    let told = |exercise: Exercise| mine(chapter, &exercise).map(|_| ()).expect_err("refused").to_string();
    let panics = told(perspective(|screen, tan| {
        assert!(screen[0] < 0.5, "too far\nto the right");
        chapter_05_pinhole::answers::solution(screen, tan)
    }));
    assert!(panics.starts_with("perspective_direction panicked at pixel ("), "{panics}");
    assert!(panics.contains("asked screen (") && panics.ends_with(": too far to the right"), "{panics}");
    let nan = told(perspective(|[x, y], tan| [x / (x - x), y * tan, -1.0]));
    assert!(nan.starts_with("perspective_direction gave (") && nan.ends_with("no picture can hold that"), "{nan}");
    assert!(nan.contains(" at pixel (") && nan.contains("tan_half_vertical"), "{nan}");
    let huge = told(perspective(|_, _| [1e200; 3]));
    assert!(huge.contains("gave (1e200, 1e200, 1e200)"), "{huge}");
}

/// The program renders so that a panic ends it, since a release build could not go on; here a copy of this test does.
#[test]
fn a_panic_on_a_thread_of_a_render_ends_the_program_with_its_sentence() {
    const COPY: &str = "PINHOLE_TEST_ENDS_AT_A_PANIC";
    if std::env::var_os(COPY).is_some() {
        end_at_panics(|sentence| {
            eprintln!("pinhole: {sentence}");
            std::process::exit(7)
        });
        let chapters = all();
        let chapter = chapters.iter().find(|chapter| chapter.name == "05_pinhole").expect("the chapter");
        _ = mine(chapter, &perspective(|_, _| panic!("not\nyet written")));
        std::process::exit(8);
    }
    let this = std::env::current_exe().expect("this program");
    let test = "exercises::mine::a_panic_on_a_thread_of_a_render_ends_the_program_with_its_sentence";
    let ended = Command::new(this).args(["--exact", test, "--nocapture"]).env(COPY, "").output().expect("it runs");
    let said = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(7), "{said}");
    let sentence = said.lines().find(|line| line.starts_with("pinhole: ")).expect("a sentence");
    assert!(sentence.starts_with("pinhole: perspective_direction panicked at pixel ("), "{sentence}");
    assert!(sentence.contains("asked screen (") && sentence.ends_with(": not yet written"), "{sentence}");
}

#[test]
fn every_stub_renders_or_is_refused_in_a_sentence() {
    let chapters = all();
    let mut refusals = 0;
    for (name, exercise) in listed::all().into_iter().filter(|(name, _)| untouched(name)) {
        let chapter = chapters.iter().find(|chapter| chapter.name == name).expect("the chapter");
        match mine(chapter, &exercise) {
            Ok(film) => assert_eq!(pixels(&film).len(), (WIDTH * HEIGHT) as usize),
            Err(refused) => {
                eprintln!("{name}: {refused}");
                refusals += 1;
                assert!(!refused.to_string().contains('\n'), "{name}: {refused}");
            }
        }
    }
    eprintln!("stubs: {refusals} refused");
}

#[test]
fn a_render_that_does_not_run_the_stage_says_so() {
    let chapters = all();
    let chapter = chapters.iter().find(|chapter| chapter.name == "05_pinhole").expect("the chapter");
    let seen_by = Overrides { view: Some("raster".into()), ..asked(chapter) };
    let refused = Mine::of(&right(), chapter, &chapter.world(&seen_by)).err().expect("refused").to_string();
    assert!(refused.starts_with("perspective_direction stands in \"Generate camera rays: perspective\""), "{refused}");
}

#[test]
fn the_command_renders_notes_and_refuses() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let said = |words: &[&str]| {
        let output = run(folder.path(), words);
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
        (output.status.code(), text(output.stdout), text(output.stderr))
    };
    if untouched("05_pinhole") {
        let (status, out, notes) = said(&["render", "5", "--mine", "--size", "48x27"]);
        assert_eq!(status, Some(0), "{notes}");
        assert!(notes.contains("perspective_direction gives one and the same answer, as the stub does"), "{notes}");
        let written: Vec<_> = fs::read_dir(folder.path().join("out")).expect("listed").flatten().collect();
        assert!(written.len() == 1 && written[0].file_name() == "05_mine.png", "{written:?}");
        assert!(out.contains("out/05_mine.png: pinhole's picture, the one with your perspective_direction"), "{out}");
        assert!(out.contains("% of the pixels differ visibly, most about column "), "{out}");
        let (status, out, notes) = said(&["render", "5", "--mine", "--size", "48x27", "-o", "mine.png"]);
        assert!(status == Some(0) && out.contains("mine.png") && !out.contains("differ"), "{out} {notes}");
    }
    // What only time ends is compared with nothing, which would have no end.
    let naive = "area-light-without-cosine";
    let (status, out, notes) = said(&["render", "21", "--naive", naive, "--size", "16x9", "--time", "100ms"]);
    assert!(status == Some(0) && out.contains(naive) && !out.contains("differ"), "{out} {notes}");
    let (status, _, notes) = said(&["render", "5", "--mine", "--resume"]);
    assert!(status == Some(2) && notes.contains("`--mine` begins anew") && notes.lines().count() == 1, "{notes}");
    let (status, _, notes) = said(&["render", "18", "--mine", "-o", "mine.png"]);
    assert!(status == Some(1) && notes.contains("`render 18 --mine` alone writes it"), "{notes}");
    let (status, _, notes) = said(&["render", "cover", "--mine"]);
    assert!(status == Some(1) && notes.contains("cover has no exercise"), "{notes}");
    let (status, _, notes) = said(&["render", "scene.ron", "--mine"]);
    assert!(status == Some(2) && notes.contains("a scene file asks for none"), "{notes}");
}
