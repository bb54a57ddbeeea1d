use super::error::{Error, Result};
use super::figure::svg_place;
use super::format::{Format, print_json, print_written, shown};
use super::interrupt::{EndsByItself, interrupted, stop_flag};
use super::measure::again;
use super::own_file::write_file;
use super::report_arguments::ReportErrors;
use super::subject::Subject;
use bevy_ecs::prelude::EntityWorldMut;
use indicatif::{ProgressBar, ProgressStyle};
use pinhole::extract::{ImageFrame, camera_entity, integrator_of, validate};
use pinhole::film::{Replaces, check_place};
use pinhole::plan::{Census, Table};
use pinhole::render::Watch;
use pinhole::scene::{
    BidirectionalPathTracing, Filter, Integrator, LightStrategy, LightTracing, PhotonMapping, Resolution, Sampler,
    Sampling, scene_text,
};
use pinhole::{Chapter, Overrides, stages};
use pinhole_lab::report::kept::{keep, kept};
use pinhole_lab::report::ladder::Ladder;
use pinhole_lab::report::page::page;
use pinhole_lab::report::pictures::pictures;
use pinhole_lab::report::pitfalls::{pitfalls, pitfalls_table};
use pinhole_lab::report::plot::{Against, plot};
use pinhole_lab::report::provenance::{Provenance, load};
use pinhole_lab::report::run::{Shelf, hash, this_program};
use pinhole_lab::report::runner::{Progress, Variant, fingerprint, run_all};
use pinhole_lab::report::sum_up::{measure, sum_up};
use pinhole_lab::report::summary::{Report, SceneSummary};
use serde::Serialize;
use serde_json::json;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// The pixels of a report's image, unless it is told otherwise: as many as fit its time.
const PIXELS: f64 = 96.0 * 54.0;
/// The first chapter that has a report.
const FIRST_CHAPTER: u32 = 13;

/// Measures error against run time, or shows what is kept of an earlier measurement.
pub fn report(chapters: &[Chapter], asked: &ReportErrors, format: Format, out: &mut dyn Write) -> Result {
    if asked.kept {
        return show_kept(chapters, asked, format, out);
    }
    if asked.naive {
        let subject = Subject::find(chapters, &asked.subject)?;
        let variants = variants(&subject, &[], size(&subject, asked.size)?)?;
        let pitfalls = pitfalls(&variants[0])?;
        if format.is_json() {
            return print_json(&json!({ "scene": subject.name(), "measurements": pitfalls }), out);
        }
        write!(out, "{}", pitfalls_table(&pitfalls))?;
        return Ok(());
    }
    if asked.subject != "all" {
        let measured = measure_one(chapters, asked, format, out)?;
        return if format.is_json() { print_json(&measured, out) } else { Ok(()) };
    }
    let mut all = Vec::new();
    for chapter in chapters.iter().filter(|chapter| has_report(chapter)) {
        all.push(measure_one(chapters, &again(chapter, asked), format, out)?);
    }
    if format.is_json() { print_json(&all, out) } else { Ok(()) }
}

/// A report, and the files that it was written to.
#[derive(Serialize)]
pub(super) struct Measured {
    #[serde(flatten)]
    pub report: Report,
    pub files: Vec<String>,
}

/// Whether a chapter's report is kept beside it: from the first of many samples on.
pub fn has_report(chapter: &Chapter) -> bool {
    let number = chapter.name.split_once('_').and_then(|(number, _)| number.parse::<u32>().ok());
    number.is_some_and(|number| number >= FIRST_CHAPTER)
}

fn show_kept(chapters: &[Chapter], asked: &ReportErrors, format: Format, out: &mut dyn Write) -> Result {
    let report = kept(super::find::chapter(chapters, &asked.subject)?.name)?;
    if asked.output.is_none() {
        if format.is_json() {
            return print_json(&Measured { report, files: Vec::new() }, out);
        }
        write!(out, "{report}")?;
        return Ok(());
    }
    let file = svg_place(asked.output.as_ref(), &report.name)?;
    let against = if asked.samples_axis { Against::Samples } else { Against::Render };
    write_file(asked.output.is_some(), &file, plot(&report, against).text.as_bytes())?;
    print_written(&file, format, out)
}

/// Measures one subject, writes its report, and as text prints it too.
pub(super) fn measure_one(
    chapters: &[Chapter],
    asked: &ReportErrors,
    format: Format,
    out: &mut dyn Write,
) -> Result<Measured> {
    let subject = Subject::find(chapters, &asked.subject)?;
    let name = file_stem(&subject, &asked.against);
    let files = ["html", "json", "csv"].map(|ending| Path::new("out/report").join(format!("{name}.{ending}")));
    files.iter().try_for_each(|file| check_place(Replaces::Own.at(file)))?;
    let rivals = rivals(chapters, &asked.against)?;
    let size = size(&subject, asked.size)?;
    let variants = variants(&subject, &rivals, size)?;
    let ladder = Ladder::new(asked.quick);
    let threads = asked.threads.map_or(1, usize::from);
    let shelf_made_from = fingerprint(&variants, &ladder, &format!("{} {threads}", this_program()))?;
    let shelf = Shelf::new(Path::new("out/report").join(format!("{name}.runs")), shelf_made_from);
    let mut provenance = Provenance::now(asked.command_line());
    let waiting = Bar::new(&ladder, &variants);
    let ends_by_itself = EndsByItself::begin();
    let runs = run_all(&variants, &ladder, threads, &shelf, &waiting);
    waiting.bar.finish_and_clear();
    let runs = runs.map_err(|error| match error {
        pinhole::Error::Interrupted => Error::usage(format!(
            "stopped; the runs made so far are kept in out/report/{name}.runs, and the same command goes on from there"
        )),
        other => other.into(),
    })?;
    drop(ends_by_itself);
    provenance.load[1] = load();
    let measured = measure(&variants, &ladder, &runs)?;
    let scenes = variants.iter().map(|variant| {
        let world = (variant.scene)();
        let fingerprint = hash(scene_text(&world)?.as_bytes());
        let shapes = pinhole::extract::shape_entities(&Census::of(&world)).len();
        Ok(SceneSummary { fingerprint, film: variant.film()?, shapes })
    });
    let empty = Report {
        name: subject.stem(),
        title: subject.title().into(),
        against: asked.against.clone(),
        scenes: scenes.collect::<Result<Vec<_>>>()?,
        size: [size.width, size.height],
        ladder: ladder.clone(),
        threads,
        variants: Vec::new(),
        comparisons: Vec::new(),
        family_level: 0.0,
        timers: None,
        flags: Vec::new(),
        provenance,
    };
    let report = sum_up(empty, &variants, &runs, &measured);
    let html = page(&report, &pictures(&report, &variants, &runs, &measured))?;
    let json = serde_json::to_string_pretty(&report).map_err(std::io::Error::from)?;
    let texts = [html, json, pinhole_lab::report::csv::csv(&variants, &ladder, &runs, &measured)];
    for (file, text) in files.iter().zip(&texts) {
        write_file(false, file, text.as_bytes())?;
    }
    let mut written: Vec<String> = files.iter().map(|file| shown(file)).collect();
    if !format.is_json() {
        write!(out, "{report}")?;
    }
    if asked.write {
        keep(&report)?;
        let kept = shown(&pinhole_lab::report::kept::place(&report.name));
        if !format.is_json() {
            writeln!(out, "wrote {kept}")?;
        }
        written.push(kept);
    }
    shelf.clear()?;
    if !format.is_json() {
        writeln!(out, "wrote {}", files.map(|file| file.display().to_string()).join(", "))?;
    }
    Ok(Measured { report, files: written })
}

/// What the first variant is compared with.
pub(super) enum Rival<'c> {
    Subject(Subject<'c>),
    Sampler(&'static str, Sampler),
    Filter(&'static str, Filter),
    Lights(&'static str, LightStrategy),
    Method(&'static str, Method),
}

/// Asks a camera for a method to follow light.
type Method = fn(&mut EntityWorldMut<'_>);

/// The methods that follow light by paths, each in place of the others.
pub(super) const METHODS: [(&str, Method); 4] = [
    ("path_tracing", |_| ()),
    ("light_tracing", |camera| _ = camera.insert(LightTracing::default())),
    ("photon_mapping", |camera| _ = camera.insert(PhotonMapping::default())),
    ("bidirectional_path_tracing", |camera| _ = camera.insert(BidirectionalPathTracing::default())),
];

pub(super) fn rivals<'c>(chapters: &'c [Chapter], against: &[String]) -> Result<Vec<Rival<'c>>> {
    let rival = |word: &String| match word.split_once('=') {
        Some(("sampler", name)) => {
            let found = Sampler::ALL.into_iter().find(|(word, _)| *word == name);
            found
                .map(|(word, sampler)| Rival::Sampler(word, sampler))
                .ok_or_else(|| no_such("sampler", name, &Sampler::ALL))
        }
        Some(("filter", name)) => {
            let found = Filter::ALL.into_iter().find(|(word, _)| *word == name);
            found.map(|(word, filter)| Rival::Filter(word, filter)).ok_or_else(|| no_such("filter", name, &Filter::ALL))
        }
        Some(("lights", name)) => {
            let found = LightStrategy::ALL.into_iter().find(|(word, _)| *word == name);
            found
                .map(|(word, lights)| Rival::Lights(word, lights))
                .ok_or_else(|| no_such("light strategy", name, &LightStrategy::ALL))
        }
        Some(("method", name)) => {
            let found = METHODS.into_iter().find(|(word, _)| *word == name);
            found.map(|(word, method)| Rival::Method(word, method)).ok_or_else(|| no_such("method", name, &METHODS))
        }
        Some((other, _)) => Err(Error::usage(format!(
            "--against takes a chapter, a scene file, sampler=NAME, filter=NAME, lights=NAME or method=NAME, and {other} is \
             none of these"
        ))),
        None => Subject::find(chapters, word).map(Rival::Subject),
    };
    against.iter().map(rival).collect()
}

fn no_such<T>(kind: &str, name: &str, all: &[(&'static str, T)]) -> Error {
    let all: Vec<&str> = all.iter().map(|(word, _)| *word).collect();
    Error::usage(format!("there is no {kind} \"{name}\"; there are {}", all.join(", ")))
}

/// The subject itself, then each rival: the subject with another sampler or filter, or another scene.
pub(super) fn variants<'c>(
    subject: &'c Subject<'c>,
    rivals: &'c [Rival<'c>],
    size: Resolution,
) -> Result<Vec<Variant<'c>>> {
    let asked = move || Overrides { resolution: Some(size), view: None, ..Overrides::default() };
    let of =
        |subject: &'c Subject<'c>, name: String, change: &dyn Fn(&mut Sampling), reference| -> Result<Variant<'c>> {
            let world = subject.world(&asked());
            validate(&Census::of(&world)).map_err(|scene_error| subject.placed(scene_error.into(), &asked()))?;
            let camera = camera_entity(&world)?;
            let mut sampling = world.get::<Sampling>(camera).copied().unwrap_or_default();
            change(&mut sampling);
            let scene = Box::new(move || subject.world(&asked()));
            Ok(Variant { name, sampling, stages: subject.stages(), scene, reference })
        };
    let mut variants = vec![of(subject, String::new(), &|_| (), 0)?];
    for rival in rivals {
        let own = variants.len();
        let next = match rival {
            Rival::Sampler(word, sampler) => of(subject, (*word).into(), &|it| it.sampler = *sampler, 0)?,
            Rival::Filter(word, filter) => of(subject, (*word).into(), &|it| it.filter = *filter, own)?,
            Rival::Lights(word, lights) => {
                let integrator = paths_with(subject, word, *lights)?;
                let scene = Box::new(move || {
                    let mut world = subject.world(&asked());
                    // A scene that renders has one camera.
                    if let Ok(camera) = camera_entity(&world) {
                        world.entity_mut(camera).insert(integrator);
                    }
                    world
                });
                Variant { scene, ..of(subject, (*word).into(), &|_| (), 0)? }
            }
            Rival::Method(word, method) => {
                let scene = Box::new(move || {
                    let mut world = subject.world(&asked());
                    if let Ok(camera) = camera_entity(&world) {
                        let mut camera = world.entity_mut(camera);
                        camera.remove::<(LightTracing, PhotonMapping, BidirectionalPathTracing)>();
                        method(&mut camera);
                    }
                    world
                });
                // A chapter need not offer what another method takes.
                let mut stages = subject.stages();
                for stage in stages::all() {
                    if !stages.contains(&stage) {
                        stages.push(stage);
                    }
                }
                stages::sort(&mut stages);
                Variant { scene, stages, ..of(subject, (*word).into(), &|_| (), 0)? }
            }
            Rival::Subject(other) => of(other, other.stem(), &|_| (), own)?,
        };
        let same = variants.iter().position(|it: &Variant<'_>| it.name == next.name);
        if same.is_some() {
            return Err(Error::usage(format!("{} is named twice", next.name)));
        }
        variants.push(next);
    }
    variants[0].name = first_name(subject, rivals, &variants[0].sampling);
    Ok(variants)
}

/// The subject's paths with another way to find lights.
fn paths_with(subject: &Subject<'_>, word: &str, lights: LightStrategy) -> Result<Integrator> {
    match integrator_of(&Census::of(&subject.world(&Overrides::default()))).integrator {
        Integrator::Path { max_depth, roulette, .. } => Ok(Integrator::Path { max_depth, lights, roulette }),
        _ => Err(Error::usage(format!("--against lights={word}: {} has no paths to find lights by", subject.stem()))),
    }
}

/// What the subject is called: by what the others differ in.
fn first_name(subject: &Subject<'_>, rivals: &[Rival<'_>], sampling: &Sampling) -> String {
    let sampler = Sampler::ALL.iter().find(|(_, it)| *it == sampling.sampler).map_or("its sampler", |(word, _)| word);
    let filter = Filter::ALL.iter().find(|(_, it)| *it == sampling.filter).map_or("its filter", |(word, _)| word);
    let [samplers, filters] = [
        rivals.iter().any(|rival| matches!(rival, Rival::Sampler(..))),
        rivals.iter().any(|rival| matches!(rival, Rival::Filter(..))),
    ];
    if !samplers && !filters && rivals.iter().any(|rival| matches!(rival, Rival::Lights(..))) {
        let own = integrator_of(&Census::of(&subject.world(&Overrides::default()))).integrator;
        let named = |(_, it): &&(&str, LightStrategy)| matches!(own, Integrator::Path { lights, .. } if lights == *it);
        return LightStrategy::ALL.iter().find(named).map_or_else(|| subject.stem(), |(word, _)| (*word).into());
    }
    match (samplers, filters) {
        (true, false) => sampler.into(),
        (false, true) => filter.into(),
        (true, true) => format!("{sampler}, {filter}"),
        (false, false) => subject.stem(),
    }
}

/// The image's size: as asked, or the scene's own shape at a number of pixels that fits a report's time.
pub(super) fn size(subject: &Subject<'_>, asked: Option<Resolution>) -> Result<Resolution> {
    if let Some(size) = asked {
        return Ok(size);
    }
    let world = subject.world(&Overrides::default());
    let census = &Census::of(&world);
    validate(census).map_err(|scene_error| subject.placed(scene_error.into(), &Overrides::default()))?;
    let ImageFrame { width, height, .. } = ImageFrame::extract(census)?;
    let aspect = f64::from(width) / f64::from(height);
    let across = (PIXELS * aspect).sqrt().round().clamp(1.0, PIXELS);
    let down = (across / aspect).round().max(1.0);
    Ok(Resolution { width: (across as u32).min(width), height: (down as u32).min(height) })
}

fn file_stem(subject: &Subject<'_>, against: &[String]) -> String {
    let letter = |letter: char| if letter.is_ascii_alphanumeric() || "_-".contains(letter) { letter } else { '-' };
    let words: Vec<String> = against.iter().map(|word| word.chars().map(letter).collect()).collect();
    if words.is_empty() { subject.stem() } else { format!("{}-against-{}", subject.stem(), words.join("-")) }
}

/// A bar that counts samples.
pub(super) struct Bar {
    pub(super) bar: ProgressBar,
}

impl Bar {
    fn new(ladder: &Ladder, variants: &[Variant<'_>]) -> Self {
        let references = variants.iter().enumerate().filter(|(own, variant)| variant.reference == *own).count() as u64;
        Self::of(variants.len() as u64 * ladder.samples_of_runs() + references * ladder.reference_samples())
    }

    /// A bar of so many samples.
    pub(super) fn of(all: u64) -> Self {
        let bar = ProgressBar::new(all);
        if let Ok(style) = ProgressStyle::with_template("measuring {bar:40} {percent:>3} %  {eta} left") {
            bar.set_style(style);
        }
        Self { bar }
    }
}

impl Watch for Bar {
    fn stopped(&self) -> bool {
        interrupted()
    }

    fn stop_flag(&self) -> Option<Arc<AtomicBool>> {
        Some(stop_flag())
    }
}

impl Progress for Bar {
    fn run_done(&self, samples: u64) {
        self.bar.inc(samples);
    }
}
