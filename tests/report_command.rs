//! `report` as a reader runs it: what it writes, how it stops and goes on, what it refuses.

use pinhole::plan::Stage;
use pinhole::render::Watch;
use pinhole::scene::{Filter, Resolution, Sampler, Sampling};
use pinhole::{Chapter, Error, Overrides};
use pinhole_cli::command::run;
use pinhole_lab::report::deviation::RELATIVE_MSE;
use pinhole_lab::report::interval::LEVEL;
use pinhole_lab::report::ladder::Ladder;
use pinhole_lab::report::run::{Shelf, hash};
use pinhole_lab::report::runner::{Progress, Runs, Variant, run_all};
use pinhole_lab::report::sum_up::measure;
use std::sync::atomic::{AtomicU32, Ordering};

fn chapter(name: &str) -> Chapter {
    chapters::all().into_iter().find(|chapter| chapter.name == name).expect("a chapter")
}

fn little_ladder() -> Ladder {
    Ladder { samples: vec![1, 4, 16], seeds: 8, batches: 8, batch_samples: 64 }
}

fn variant<'a>(chapter: &'a Chapter, stages: Vec<Stage>, sampler: Sampler) -> Variant<'a> {
    let asked = Overrides { resolution: Some(Resolution { width: 24, height: 14 }), ..Overrides::default() };
    let sampling = Sampling { sampler, filter: Filter::BOX, ..Sampling::default() };
    Variant { name: "one".into(), sampling, stages, scene: Box::new(move || chapter.world(&asked)), reference: 0 }
}

/// Stops after so many runs.
struct StopAfter(AtomicU32);

impl Watch for StopAfter {
    fn stopped(&self) -> bool {
        self.0.load(Ordering::Relaxed) == 0
    }
}

impl Progress for StopAfter {
    fn run_done(&self, _samples: u64) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

fn images(runs: &Runs) -> Vec<&Vec<[f64; 3]>> {
    runs.references
        .iter()
        .flatten()
        .chain(runs.levels.iter().flatten().flatten())
        .map(|run| &run.image.pixels)
        .collect()
}

#[test]
fn a_stopped_report_goes_on_and_gives_the_same_images() {
    let chapter = chapter("18_error_and_time");
    let variants = [variant(&chapter, chapter.stages(), Sampler::Independent)];
    let (ladder, folder) = (little_ladder(), tempfile::tempdir().expect("a temporary folder"));
    let shelf = |name: &str| Shelf::new(folder.path().join(name), hash(b"the same"));
    let whole = run_all(&variants, &ladder, 1, &shelf("whole"), &()).expect("runs");
    let mut stops = 0;
    let in_batches = loop {
        match run_all(&variants, &ladder, 1, &shelf("batches"), &StopAfter(AtomicU32::new(7 + 5 * stops))) {
            Ok(runs) => break runs,
            Err(Error::Interrupted) => stops += 1,
            Err(other) => panic!("{other}"),
        }
        assert!(stops < 20, "it never comes to its end");
    };
    assert!(stops >= 3, "it was stopped {stops} times only");
    assert_eq!(images(&whole), images(&in_batches));
    eprintln!("report: stopped {stops} times, {} images the same bit for bit", images(&whole).len());
}

#[test]
fn independent_samples_have_no_bias_and_slope_minus_one() {
    let chapter = chapter("18_error_and_time");
    let variants = [variant(&chapter, chapter.stages(), Sampler::Independent)];
    let (ladder, folder) = (little_ladder(), tempfile::tempdir().expect("a temporary folder"));
    let shelf = Shelf::new(folder.path().join("runs"), "x".into());
    let runs = run_all(&variants, &ladder, 1, &shelf, &()).expect("runs");
    let curve = &measure(&variants, &ladder, &runs).expect("measured")[0].curve;
    let slope = curve.slope(LEVEL).expect("carried").interval(0.9999);
    assert!(slope.holds(-1.0), "{slope:?}");
    for level in &curve.levels {
        let bias = level.ensemble.bias_squared().expect("8 seeds").interval(0.9999);
        assert!(bias.holds(0.0), "{} samples: {bias:?}", level.samples);
    }
    eprintln!("report: slope {:.3} of independent samples", slope.value);
}

#[test]
fn a_seed_of_both_runs_and_reference_is_refused_by_name() {
    let chapter = chapter("18_error_and_time");
    let variants = [variant(&chapter, chapter.stages(), Sampler::Independent)];
    // So many runs that their seeds reach those of the reference.
    let ladder = Ladder { samples: vec![1], seeds: 1_000_000, ..little_ladder() };
    let none = Runs { references: vec![], levels: vec![], stages: vec![], timers: None };
    let refused = measure(&variants, &ladder, &none).err().expect("refused").to_string();
    assert!(refused.starts_with("seed 1000000 is a run's and the reference's: the two would share"), "{refused}");
}

fn asked(line: &str) -> Result<String, String> {
    let words: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
    let mut out = Vec::new();
    match run(&chapters::all(), &words, &mut out) {
        Ok(()) => Ok(String::from_utf8_lossy(&out).into_owned()),
        Err(error) => Err(error.to_string()),
    }
}

#[test]
fn what_cannot_be_compared_is_refused_in_a_sentence() {
    let cases = [
        ("report 18 --against sampler=magic", "there is no sampler \"magic\"; there are "),
        ("report 18 --against method=magic", "there is no method \"magic\"; there are path_tracing, light_tracing, "),
        ("report 18 --against lights=magic", "there is no light strategy \"magic\"; there are bsdf, light, mis"),
        (
            "report 18 --against lights=light",
            "--against lights=light: 18_error_and_time has no paths to find lights by",
        ),
        ("report 18 --against filter=magic", "there is no filter \"magic\"; there are "),
        (
            "report 18 --against size=3",
            "--against takes a chapter, a scene file, sampler=NAME, filter=NAME, lights=NAME or method=NAME, and size",
        ),
        ("report 18 --against filter=box --against filter=box", "box is named twice"),
        ("report nothing", "there is no chapter \"nothing\""),
    ];
    for (line, sentence) in cases {
        let refused = asked(line).expect_err(line);
        assert!(refused.starts_with(sentence) && !refused.contains('\n'), "{line}: {refused}");
    }
}

/// What is kept is of today's films; the line is what a contributor sees before a release.
#[test]
fn measure_finds_nothing_to_measure_anew_or_says_what_it_would() {
    assert_eq!(asked("measure --dry-run").expect("looked"), "nothing asks to be measured anew\n");
    let told = asked("measure 5 --dry-run").expect("looked");
    assert_eq!(told, "05_pinhole: as asked\n1 of 40 chapters would be measured\n");
    assert!(asked("measure 99").expect_err("refused").starts_with("there is no chapter 99"));
}

/// In `out/`, as a reader finds it; the size is small, so that it is done in a moment.
#[test]
fn a_report_is_one_page_without_a_network_and_its_numbers_as_json_and_csv() {
    let said = asked("report 02_ray --quick --size 16x9 --against sampler=independent").expect("a report");
    assert!(said.contains(RELATIVE_MSE) && said.contains("against sobol"), "{said}");
    let read = |ending: &str| {
        std::fs::read_to_string(format!("out/report/02_ray-against-sampler-independent.{ending}")).expect(ending)
    };
    let page = read("html");
    assert!(page.contains("default-src 'none'") && page.matches("<svg").count() == 3);
    for fetched in ["http://", "https://", "src=\"/", "<script", "<link rel=\"stylesheet\""] {
        let outside = page.replace("http://www.w3.org/2000/svg", "");
        assert!(!outside.contains(fetched), "the page holds {fetched}");
    }
    let json: serde_json::Value = serde_json::from_str(&read("json")).expect("JSON");
    assert_eq!(json["variants"].as_array().map(Vec::len), Some(2));
    assert_eq!(
        json["provenance"]["command"],
        "cargo run --release -- report 02_ray --against sampler=independent --size 16x9 --quick"
    );
    let levels: Vec<&serde_json::Value> =
        json["variants"].as_array().into_iter().flatten().flat_map(|own| own["levels"].as_array()).flatten().collect();
    assert_eq!(levels.len(), 2 * 4);
    for level in levels {
        let tail = level["tail_fraction"].as_f64().expect("a number");
        assert!(page.contains(&format!(">{:.1} %<", 100.0 * tail)), "the page lacks the fraction {tail}");
    }
    check_plot(page.split("<svg").nth(1).expect("a plot"));
    // Two variants of four levels of eight seeds, and the names of the columns.
    assert_eq!(read("csv").lines().count(), 1 + 2 * 4 * 8);
}

/// What a tag of a drawing says of these attributes.
fn numbers<const N: usize>(tag: &str, names: [&str; N]) -> [f64; N] {
    names.map(|name| {
        let (_, after) = tag.split_once(&format!(" {name}=\"")).unwrap_or_else(|| panic!("no {name} in {tag}"));
        after.split('"').next().and_then(|number| number.parse().ok()).expect("a number")
    })
}

/// Both axes are marked, and the words "slope −1" stand beside the dashed line.
fn check_plot(svg: &str) {
    let words: Vec<&str> = svg.split("<text").skip(1).collect();
    let slope = words.iter().find(|word| word.contains("slope −1")).expect("the words");
    let dashed = svg.split("<line").find(|line| line.contains("stroke-dasharray=\"5 4\"")).expect("a dashed line");
    let [x1, y1, x2, y2] = numbers(dashed, ["x1", "y1", "x2", "y2"]);
    let [x, y] = numbers(slope, ["x", "y"]);
    let beside = [x - (x1 + 0.65 * (x2 - x1)), y - (y1 + 0.65 * (y2 - y1))];
    assert!(beside[0].abs() < 12.0 && beside[1].abs() < 12.0, "the words are {beside:?} off the line");
    for anchor in ["middle", "end"] {
        let anchor = format!("text-anchor=\"{anchor}\"");
        let marks = words.iter().filter(|word| word.contains(&anchor) && !word.contains("slope")).count();
        assert!(marks >= 3, "{marks} marks of {anchor}");
    }
}
