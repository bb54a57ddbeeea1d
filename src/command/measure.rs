//! `measure`: whatever is kept of earlier measurements and is not of the present program is measured anew.
//!
//! Times grow old and say how old they are. What is tested is only that they are of the stages that the plan has today, and
//! that errors are of today's film.

use super::cost::{film_of, measure_and_keep, stages_of};
use super::error::{Error, Result};
use super::find;
use super::format::{Format, print_json, shown};
use super::methods;
use super::report::{has_report, measure_one, rivals, variants};
use super::report_arguments::{MeasureAnew, ReportErrors};
use super::streams::Streams;
use super::subject::Subject;
use pinhole::Chapter;
use pinhole::scene::Resolution;
use pinhole_lab::measure::cost::{kept_costs, kept_film, kept_stages};
use pinhole_lab::report::kept::kept;
use pinhole_lab::report::provenance::load;
use serde_json::json;
use std::process;
use std::time::Instant;

/// The benches whose numbers are kept beside a chapter: the chapter, the file, and what follows `cargo bench --bench`.
const BENCHES: [(&str, &str, &[&str]); 5] = [
    ("12_how_it_is_built", "entity_per_ray.txt", &["entity_per_ray", "--", "--write"]),
    ("25_path_tracing", "yours.txt", &["yours", "--", "--write"]),
    ("31_wide_tree", "curves.txt", &["curves", "--", "--write"]),
    ("34_both", "curves.txt", &["rasterisation", "--", "curves", "--write"]),
    ("37_rows", "curves.txt", &["rows", "--", "--write"]),
];

/// A chapter's report as it was made last: what it is compared with is what it was compared with.
pub(super) fn again(chapter: &Chapter, asked: &ReportErrors) -> ReportErrors {
    let against = kept(chapter.name).map_or_else(|_| asked.against.clone(), |report| report.against);
    ReportErrors { subject: chapter.name.into(), against, ..asked.clone() }
}

/// Why a chapter's kept costs are not of its plan, in a few words; none where its stages are the very ones that were
/// measured, in the same order.
///
/// Errors: the scene has no plan.
pub fn outdated_costs(chapter: &Chapter) -> Result<Option<String>> {
    let Ok(text) = kept_costs(chapter.name) else { return Ok(Some("no costs are kept".into())) };
    let (now, kept) = (stages_of(chapter)?, kept_stages(&text));
    let kept: Vec<&str> = kept.iter().map(|stage| stage.name.as_str()).collect();
    let told = |names: Vec<&str>| names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
    let without = |names: &[&'static str], others: &[&str]| {
        names.iter().copied().filter(|name| !others.contains(name)).collect::<Vec<_>>()
    };
    let came = without(&now, &kept);
    let went: Vec<&str> = kept.iter().copied().filter(|name| !now.contains(name)).collect();
    Ok(match (came.is_empty(), went.is_empty()) {
        _ if now == kept => None,
        (true, true) => Some("the stages run in another order".into()),
        (false, true) => Some(format!("stages that were not measured: {}", told(came))),
        (true, false) => Some(format!("stages that are gone: {}", told(went))),
        (false, false) => Some(format!("{} instead of {}", told(came), told(went))),
    })
}

/// Why the errors of a chapter's kept report are not of its film, in a few words; none where they are.
///
/// Errors: what a render would be refused for.
pub fn outdated_report(chapters: &[Chapter], chapter: &Chapter) -> Result<Option<String>> {
    let Ok(report) = kept(chapter.name) else { return Ok(Some("no report is kept".into())) };
    let subject = Subject::find(chapters, chapter.name)?;
    let rivals = rivals(chapters, &report.against)?;
    let [width, height] = report.size;
    for (now, kept) in variants(&subject, &rivals, Resolution { width, height })?.iter().zip(&report.variants) {
        if now.film()? != kept.film {
            return Ok(Some(format!("the errors of {} are of another film", kept.name)));
        }
    }
    Ok(None)
}

/// What is kept beside a chapter, by what is measured at once.
#[derive(Clone, Copy, PartialEq)]
enum Kept {
    Costs,
    Report,
    Methods,
}

/// All that asks for a chapter to be measured anew, in a few words each.
fn reasons(chapters: &[Chapter], chapter: &Chapter) -> Result<Vec<(Kept, String)>> {
    let mut reasons: Vec<(Kept, String)> = outdated_costs(chapter)?.into_iter().map(|why| (Kept::Costs, why)).collect();
    let film = film_of(chapter)?;
    if kept_costs(chapter.name).is_ok_and(|text| kept_film(&text) != Some(&film)) {
        reasons.push((Kept::Costs, "the errors of its stages are of another film".into()));
    }
    if has_report(chapter) {
        reasons.extend(outdated_report(chapters, chapter)?.map(|why| (Kept::Report, why)));
    }
    if keeps_methods(chapter) {
        reasons.extend(methods::outdated_methods(chapters)?.map(|why| (Kept::Methods, why)));
    }
    Ok(reasons)
}

/// Whether the curves of all methods are kept beside a chapter.
fn keeps_methods(chapter: &Chapter) -> bool {
    methods::KEPT.starts_with(&format!("chapters/{}/", chapter.name))
}

/// Measures what asks for it, or what it is told to, and keeps it beside the chapters.
pub fn measure_anew(chapters: &[Chapter], asked: &MeasureAnew, format: Format, streams: &mut Streams<'_>) -> Result {
    let told: Vec<&Chapter> = match asked.chapter.as_deref() {
        None | Some("all") => chapters.iter().collect(),
        Some(name) => vec![find::chapter(chapters, name)?],
    };
    let (mut chosen, named) = (Vec::new(), asked.chapter.is_some());
    for chapter in told {
        let reasons = reasons(chapters, chapter)?;
        if named || !reasons.is_empty() {
            chosen.push((chapter, reasons));
        }
    }
    let cores = std::thread::available_parallelism().map_or(1, usize::from) as f64;
    let busy = load().filter(|load| *load > 0.5 * cores && !asked.dry_run && !chosen.is_empty());
    if let Some(load) = busy {
        streams.note(&format!("note: the machine is busy, its load is {load:.2}; that is kept with the times"))?;
    }
    let (began, mut all) = (Instant::now(), Vec::new());
    for (chapter, reasons) in &chosen {
        let told: Vec<&str> = reasons.iter().map(|(_, why)| why.as_str()).collect();
        if !format.is_json() {
            let why = if told.is_empty() { "as asked".into() } else { told.join("; ") };
            writeln!(streams.out, "{}: {why}", chapter.name)?;
        }
        let began = Instant::now();
        let asks = |kept: Kept| named || reasons.iter().any(|(own, _)| *own == kept);
        let files = if asked.dry_run { Vec::new() } else { measure_chapter(chapters, chapter, asks)? };
        let seconds = began.elapsed().as_secs_f64();
        if !format.is_json() && !asked.dry_run {
            writeln!(streams.out, "  wrote {} in {seconds:.0} s", files.join(", "))?;
        }
        all.push(json!({ "chapter": chapter.name, "reasons": told, "files": files, "seconds": seconds }));
    }
    if format.is_json() {
        return print_json(&all, streams.out);
    }
    let seconds = began.elapsed().as_secs_f64();
    match (all.len(), asked.dry_run) {
        (0, _) => writeln!(streams.out, "nothing asks to be measured anew")?,
        (some, true) => writeln!(streams.out, "{some} of {} chapters would be measured", chapters.len())?,
        (some, false) => writeln!(streams.out, "measured {some} of {} chapters in {seconds:.0} s", chapters.len())?,
    }
    Ok(())
}

/// Measures what asks for it of all that is kept beside a chapter, and gives the files.
fn measure_chapter(chapters: &[Chapter], chapter: &Chapter, asks: impl Fn(Kept) -> bool) -> Result<Vec<String>> {
    let mut files = Vec::new();
    if asks(Kept::Costs) {
        files.push(shown(&measure_and_keep(chapter)?));
    }
    if has_report(chapter) && asks(Kept::Report) {
        let asked = again(chapter, &ReportErrors { write: true, ..ReportErrors::default() });
        let report = measure_one(chapters, &asked, Format::Json, &mut std::io::sink())?;
        files.extend(report.files.into_iter().filter(|file| file.starts_with("chapters")));
    }
    if keeps_methods(chapter) && asks(Kept::Methods) {
        methods::measure_methods(chapters)?;
        files.push(methods::KEPT.into());
    }
    // A bench's own stages are those of the chapter.
    let benches = BENCHES.iter().filter(|(name, ..)| *name == chapter.name && asks(Kept::Costs));
    for (_, file, words) in benches {
        let bench = process::Command::new("cargo")
            .args(["bench", "--quiet", "--bench"])
            .args(*words)
            .current_dir(pinhole_lab::repository())
            .stdout(process::Stdio::null())
            .status();
        if !bench.is_ok_and(|status| status.success()) {
            return Err(Error::usage(format!("`cargo bench --bench {}` did not end well", words.join(" "))));
        }
        files.push(format!("chapters/{}/{file}", chapter.name));
    }
    Ok(files)
}
