use super::called::called;
use super::error::{Error, Result};
use super::files::{Files, Targets};
use super::format::{Format, print_json};
use super::hints;
use super::interrupt::{EndsByItself, Waiting};
use super::long_render::key_of;
use super::options::RenderOptions;
use super::progress::Progress;
use super::render::{attributes, keep_guides};
use super::streams::Streams;
use super::subject::Subject;
use bevy_ecs::prelude::World;
use pinhole::extract::{FilterTable, adaptive_of, validate};
use pinhole::film::{
    Check, CheckpointAt, Film, Merged, Part, PartFilm, PngKind, Replaces, checkpoint_at, keep_checkpoint, merge_parts,
    read_checkpoint,
};
use pinhole::plan::Census;
use pinhole::render::{Execution, RenderInProgress, Watch, error_of};
use pinhole::scene::printable_path;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// How often a part is written while it is computed, unless that is asked for otherwise.
const WRITE_EVERY: Duration = Duration::from_secs(10);
/// Writing takes at most one part in this many of the time.
const FRACTION_FOR_WRITING: u32 = 20;

/// The file of a part, beside the picture.
pub fn part_file(picture: &Path, number: u32, of: u32) -> PathBuf {
    let mut name = picture.file_stem().unwrap_or_default().to_os_string();
    name.push(format!(".part-{number}-of-{of}.checkpoint"));
    picture.with_file_name(name)
}

/// Whether a file's name is that of a part of a picture.
fn is_part_of(picture: &Path, file: &Path) -> bool {
    let (Some(stem), Some(name)) = (picture.file_stem(), file.file_name()) else { return false };
    let (stem, name) = (stem.to_string_lossy(), name.to_string_lossy());
    let numbers = name.strip_prefix(&*stem).and_then(|rest| rest.strip_prefix(".part-"));
    let numbers = numbers.and_then(|rest| rest.strip_suffix(".checkpoint")).and_then(|rest| rest.split_once("-of-"));
    numbers.is_some_and(|(number, of)| [number, of].iter().all(|word| word.parse::<u32>().is_ok()))
}

/// The parts beside a picture, in the order of their names.
fn parts_beside(picture: &Path) -> Vec<PathBuf> {
    let folder = picture.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let entries = std::fs::read_dir(folder).into_iter().flatten().filter_map(std::result::Result::ok);
    let mut files: Vec<PathBuf> = entries
        .map(|entry| picture.with_file_name(entry.file_name()))
        .filter(|file| is_part_of(picture, file))
        .collect();
    files.sort();
    files
}

/// The scene that all parts are of, and its render.
///
/// Errors: what a render is refused for.
fn begun(subject: &Subject<'_>, options: &RenderOptions) -> Result<(World, RenderInProgress)> {
    let asked = options.asked(false);
    let mut scene = subject.world(&asked);
    if options.denoise {
        keep_guides(&mut scene);
    }
    let placed = |error| subject.placed(error, &asked);
    let census = &Census::of(&scene);
    validate(census).map_err(|scene_error| placed(scene_error.into()))?;
    let execution = Execution { threads: options.threads.map(usize::from), part: options.crop, ..Execution::default() };
    let render = RenderInProgress::begin(census, &subject.stages(), &execution).map_err(placed)?;
    Ok((scene, render))
}

/// Computes one part of a render and leaves it in a file beside the picture, which is not written.
///
/// Errors: what a render is refused for; a stop, after which the same command with `--resume` continues.
pub fn render_part(
    subject: &Subject<'_>,
    options: &RenderOptions,
    part: Part,
    format: Format,
    streams: &mut Streams<'_>,
) -> Result {
    let by_itself = EndsByItself::begin();
    let targets = Targets::of(subject, options)?;
    let Some(picture) = targets.pictures.first() else {
        let what = "a part is kept in a file beside the picture, so --output has to name one";
        return Err(Error::CommandLine(what.into()));
    };
    let path = part_file(picture, part.number, part.of);
    let (scene, mut render) = begun(subject, options)?;
    let census = &Census::of(&scene);
    let progress = match streams.waits && !options.quiet && !options.openjd {
        true => Progress::of(&format!("part {} of {}", part.number, part.of), 0, None),
        false => Progress::hidden(),
    };
    let waiting = Waiting::with(progress, 0);
    let key = key_of(&render, census, options, &waiting).map_err(before_it_began)?;
    let adaptive = adaptive_of(census)?;
    let pilot = picture.with_extension("pilot.checkpoint");
    let has_pilot = adaptive.is_some() && matches!(checkpoint_at(&pilot, key), CheckpointAt::Own(_));
    if has_pilot {
        // Whoever writes it meanwhile writes the same; one that cannot be read is made again.
        if let Ok(film) = read_checkpoint(key, &render.film, true, &pilot) {
            render.take(film);
        }
    }
    let mut keep = |film: &Film| if has_pilot { Ok(()) } else { keep_checkpoint(film, key, &pilot).map(|_| ()) };
    let mut own = render.begin_part(part, adaptive, &waiting, &mut keep).map_err(before_it_began)?;
    let there = checkpoint_at(&path, key);
    match there {
        CheckpointAt::Other => {
            return Err(Error::usage(format!(
                "{} is no part of this render and stays; --output names another place",
                printable_path(&path)
            )));
        }
        CheckpointAt::Missing => {}
        CheckpointAt::Own(_) if options.resume => {
            let kept = PartFilm::read(&render.film, key, &path)?;
            if (kept.part, kept.samples, kept.batches) != (own.part, own.samples, own.batches) {
                return Err(Error::usage(format!(
                    "cannot continue from {}: it is a part of another number of samples, or of another --split",
                    printable_path(&path)
                )));
            }
            own = kept;
        }
        CheckpointAt::Own(_) => {
            streams.note(&format!("note: {} is replaced; --resume would continue from it", printable_path(&path)))?
        }
    }
    let all = render.samples_left(&PartFilm { units: Vec::new(), light: Vec::new(), ..own.clone() });
    let mut pause = options.write_every.unwrap_or(WRITE_EVERY);
    loop {
        let done = all - render.samples_left(&own);
        let percent = if all == 0 { 100.0 } else { 100.0 * done as f64 / all as f64 };
        if options.openjd {
            writeln!(streams.out, "openjd_progress: {percent:.1}")?;
        }
        waiting.expect(
            all,
            own.units.len() as u32,
            own.part.units(render.film.tiles.len() as u32, own.samples).len() as u32,
        );
        let advanced = render.advance_part(&mut own, Instant::now() + pause, &waiting);
        let began = Instant::now();
        let written = write_part(&render, &own, key, &path);
        if let (Err(refused @ pinhole::Error::Write { .. }), Ok(false)) = (&written, &advanced) {
            // A disk that is full now may have room later.
            streams.note(&format!("warning: {refused}; the part goes on, and it is written again later"))?;
        } else {
            written?;
        }
        pause = options.write_every.unwrap_or(WRITE_EVERY.max(began.elapsed() * FRACTION_FOR_WRITING));
        match advanced {
            Ok(true) => break,
            Ok(false) => {}
            Err(pinhole::Error::Interrupted) => {
                waiting.done();
                let left = render.samples_left(&own);
                return Err(Error::Unfinished(format!(
                    "stopped with {left} of {all} samples to take; {} holds the others, and the same command with --resume \
                     continues",
                    printable_path(&path)
                )));
            }
            Err(error) => return Err(error.into()),
        }
    }
    waiting.done();
    drop(by_itself);
    let told = format!("part {} of {}, {all} samples: {}", part.number, part.of, printable_path(&path));
    if options.openjd {
        writeln!(streams.out, "openjd_progress: 100.0\nopenjd_status: {told}")?;
    }
    match format {
        Format::Json => {
            let data = serde_json::json!({ "part": part.number, "of": part.of, "samples": all, "file": path });
            print_json(&data, streams.out)
        }
        Format::Text if options.openjd => Ok(()),
        Format::Text => Ok(writeln!(streams.out, "{told}")?),
    }
}

/// A stop before there is anything to keep.
fn before_it_began(error: pinhole::Error) -> Error {
    match error {
        pinhole::Error::Interrupted => Error::Unfinished("stopped before the part was begun".into()),
        error => error.into(),
    }
}

fn write_part(render: &RenderInProgress, own: &PartFilm, key: u64, path: &Path) -> pinhole::Result {
    let may_go = |path: &Path| matches!(checkpoint_at(path, key), CheckpointAt::Own(_) | CheckpointAt::Missing);
    own.write(&render.film, key, Replaces::If(&may_go).at(path))
}

/// Adds parts up to the picture that one machine would have rendered, and writes it; with some missing, what there is.
///
/// Errors: no part can be used; parts are missing or refused, after what there is has been written.
pub fn merge(
    subject: &Subject<'_>,
    options: &RenderOptions,
    (parts, verify): (&[PathBuf], usize),
    format: Format,
    streams: &mut Streams<'_>,
) -> Result {
    let targets = Targets::of(subject, options)?;
    targets.check()?;
    let (scene, render) = begun(subject, options)?;
    let census = &Census::of(&scene);
    let key = key_of(&render, census, options, &Waiting::with(Progress::hidden(), 0))?;
    let paths = match (parts, targets.pictures.first()) {
        ([], Some(picture)) => parts_beside(picture),
        (named, _) => named.to_vec(),
    };
    if let ([], Some(picture)) = (&paths[..], targets.pictures.first()) {
        let first = part_file(picture, 1, 4);
        return Err(Error::usage(format!(
            "there is no part to merge beside {}: {} makes one, such as {}",
            printable_path(picture),
            called(&format!("render {} --part 1/4", subject.name())),
            printable_path(&first)
        )));
    }
    let filter = census.table::<FilterTable>()?.filter;
    // Where the number of samples depends on the error, only the parts know it.
    let expected = adaptive_of(census)?.is_none().then(|| render.expected());
    let check = Check { pieces: verify, is_right: &mut |entry, samples| render.computes(entry, samples) };
    let Merged { film, samples, complete, used, missing, refused } =
        merge_parts(&render.film, key, (filter, expected), &paths, check)?;
    for (_, why) in &refused {
        streams.note(&format!("warning: {why}"))?;
    }
    let png = PngKind { is_deep: options.bits == Some(16), text: hints::provenance(subject, options, false) };
    let attributes = attributes(subject, options, &scene, (&render, false));
    let files = Files::new(targets, (attributes, options.denoise), &render, (png, None));
    files.write(&film)?;
    files.send(&film, streams.out)?;
    let mut written: Vec<PathBuf> = files.targets.pictures.clone();
    if let (true, true, Some(first)) = (complete, render.is_sampled(), files.targets.checkpoint()) {
        written.extend(keep_checkpoint(&film, key, &first)?.map(|(path, _)| path));
    }
    let told = Told::of(&film, samples, complete, used, &missing);
    let out = if files.targets.standard_output { &mut *streams.notes } else { &mut *streams.out };
    if format == Format::Json {
        let refused: Vec<&str> = refused.iter().map(|(_, why)| why.as_str()).collect();
        let missing: Vec<u32> = missing.iter().map(|part| part.number).collect();
        let data = serde_json::json!({
            "parts": used, "complete": complete, "missing": missing, "refused": refused,
            "samples": samples, "error": told.error, "files": written,
        });
        print_json(&data, out)?;
    } else {
        writeln!(
            out,
            "{}; wrote {}",
            told.sentence,
            files.targets.told(written.get(files.targets.pictures.len()).map(PathBuf::as_path))
        )?;
    }
    if complete { Ok(()) } else { Err(Error::Unfinished(told.lacks)) }
}

/// What is said of a merged film.
struct Told {
    sentence: String,
    lacks: String,
    error: Option<f64>,
}

impl Told {
    fn of(film: &Film, samples: u32, complete: bool, used: usize, missing: &[Part]) -> Self {
        let error = error_of(film);
        let is_told = match error {
            Some(error) if complete => format!("the pixels' standard error is {:.2} % of their light", 100.0 * error),
            Some(error) => {
                format!("where there are samples, the standard error is {:.2} % of the light", 100.0 * error)
            }
            None => "its error is not known, which takes more than 64 samples or --layers variance".into(),
        };
        let parts = if used == 1 { "1 part".into() } else { format!("{used} parts") };
        let sentence = match complete {
            true => format!("{parts} of {}: {samples} samples a pixel; {is_told}", size_of(film)),
            false => {
                let [least, mean] = samples_of(film);
                format!(
                    "{parts} of {}: {mean:.1} of {samples} samples a pixel, {least:.0} at least; {is_told}",
                    size_of(film)
                )
            }
        };
        let shown: Vec<String> = missing.iter().take(12).map(|part| part.number.to_string()).collect();
        let more = missing.len().saturating_sub(shown.len());
        let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
        let of = missing.first().map_or(0, |part| part.of);
        let lacks = format!("not complete: missing or unfinished of {of} parts: {}{rest}", shown.join(", "));
        Self { sentence, lacks, error }
    }
}

fn size_of(film: &Film) -> String {
    format!("{} × {} pixels", film.width, film.height)
}

/// The fewest samples of a pixel, and their mean.
fn samples_of(film: &Film) -> [f64; 2] {
    let counts = || film.tiles.iter().flat_map(|tile| &tile.count);
    let sum: u64 = counts().map(|&count| u64::from(count)).sum();
    let pixels = f64::from(film.width) * f64::from(film.height);
    [counts().copied().min().map_or(0.0, f64::from), sum as f64 / pixels]
}
