use super::error::{Error, Result};
use super::files::{Files, Targets};
use super::find;
use super::format::{Format, print_json};
use super::hints;
use super::interrupt::{Waiting, interrupted};
use super::long_render::{LongRender, render_long};
use super::options::{RenderOptions, SceneOptions};
use super::own_file::write_file;
use super::preflight::before_rendering;
use super::progress::Progress;
use super::streams::Streams;
use super::subject::Subject;
use super::summary::Summary;
use super::warnings::{mattes_left_out, notes, too_dark, warnings};
use bevy_ecs::prelude::World;
use pinhole::Chapter;
use pinhole::extract::{ChosenIntegrator, LayerTable, adaptive_of, camera_entity, integrator_of, validate};
use pinhole::film::{Curve, FileAttributes, PICTURE_GUIDES, PngKind, png_bytes, stops_of};
use pinhole::look::{Foretold, RenderStats};
use pinhole::plan::Census;
use pinhole::render::{Execution, RenderInProgress, SceneAt};
use pinhole::scene::{
    Exposure, FNV_BASIS, FileKind, Integrator, Layers, Sampling, check_memory, fingerprint, fnv, read_file,
};
use pinhole_lab::exercise::Mine;
use pinhole_lab::review::{PictureDifference, compare_pictures, picture_contrast};
use std::borrow::Cow;
use std::path::Path;
use std::time::Instant;

/// What was just written, to be compared.
const PICTURE: FileKind = FileKind { name: "a picture", max: 1 << 30 };

/// The main job: the cover, to `out/`.
pub fn render_cover(chapters: &[Chapter], format: Format, streams: &mut Streams<'_>) -> Result {
    let cover = Subject::Chapter(Cow::Borrowed(find::chapter(chapters, "cover")?));
    render_subject(&cover, &RenderOptions::default(), format, streams)
}

/// Renders a scene by a naive method; and beside it, unless a file is named, by pinhole's own, and how the two differ.
pub fn render_naive(
    subject: &Subject<'_>,
    options: &RenderOptions,
    format: Format,
    streams: &mut Streams<'_>,
) -> Result {
    render_with(subject, options, (None, None), format, streams)?;
    let targets = Targets::of(subject, options)?;
    match targets.pictures.first() {
        Some(naive) if is_compared(options, format) => {
            compare_with_pinhole(subject, &subject.stem(), options, naive, streams)
        }
        _ => Ok(()),
    }
}

/// Whether a picture is compared with pinhole's: not where only time ends a render, for the two would differ in samples.
fn is_compared(options: &RenderOptions, format: Format) -> bool {
    options.output.is_empty() && options.time.is_none() && format == Format::Text
}

/// Writes the picture of pinhole's own stages and how another differs from it, and says how far they are apart.
fn compare_with_pinhole(
    subject: &Subject<'_>,
    stem: &str,
    options: &RenderOptions,
    other: &Path,
    streams: &mut Streams<'_>,
) -> Result {
    let picture = |whose: &str| Path::new("out").join(format!("{stem}_{whose}.png"));
    let scene = subject.world(&options.asked(false));
    let watch = Waiting::with(Progress::hidden(), 0);
    let rendered = pinhole::render::render(&scene, &subject.stages(), &Execution::default(), &watch)?;
    let pinholes = png_bytes(&rendered.film, rendered.curve())?;
    let own = picture("pinhole");
    write_file(false, &own, &pinholes)?;
    let others = read_file(other, PICTURE).map_err(|error| Error::usage(error.to_string()))?;
    let apart = compare_pictures(&pinholes, &others).map_err(|error| Error::usage(error.to_string()))?;
    let PictureDifference { sizes: [[width, height], _], differing, largest, worst: [x, y], colours } = apart;
    let told = match differing {
        0 => "the same picture".to_owned(),
        _ => format!(
            "{differing} of {} pixels differ, by at most {largest} of 255, most at {x},{y}: {:?} in pinhole's, {:?} in the other",
            u64::from(width) * u64::from(height),
            colours[0],
            colours[1]
        ),
    };
    writeln!(streams.out, "{}, pinhole's own picture: {told}", own.display())?;
    if let (Some((bytes, words)), true) = (picture_contrast(&pinholes, &others)?, differing > 0) {
        let file = picture("difference");
        write_file(false, &file, &bytes)?;
        writeln!(streams.out, "{}: {words}", file.display())?;
    }
    Ok(())
}

/// Renders a scene and says in a few lines what came of it; with `--verbose` all that ran and was left out, too.
pub fn render_subject(
    subject: &Subject<'_>,
    options: &RenderOptions,
    format: Format,
    streams: &mut Streams<'_>,
) -> Result {
    render_with(subject, options, (None, None), format, streams)
}

/// The same with a reader's function in one of its stages, or at so many moments.
pub fn render_with(
    subject: &Subject<'_>,
    options: &RenderOptions,
    (mine, moments): (Option<Mine>, Option<(u32, SceneAt)>),
    format: Format,
    streams: &mut Streams<'_>,
) -> Result {
    let began = Instant::now();
    let json = options.stats || format == Format::Json;
    let targets = Targets::of(subject, options)?;
    targets.check()?;
    if let (Some(note), false) = (&targets.note, json) {
        streams.note(note)?;
    }
    let (threads, part) = (options.threads.map(usize::from), options.crop);
    let execution = Execution { threads, part, ..Execution::default() };
    let asked = options.asked(!options.quiet);
    let mut scene = subject.world(&asked);
    let placed = |error| subject.placed(error, &asked);
    let checked = |scene: &World| validate(&Census::of(scene)).map_err(|scene_error| placed(scene_error.into()));
    checked(&scene)?;
    check_requests(&Census::of(&scene), options, &targets, streams)?;
    if options.denoise {
        keep_guides(&mut scene);
        checked(&scene)?;
    }
    let census = &Census::of(&scene);
    let offer = match options.naive {
        Some(naive) => naive.put_in(subject.stages(), census)?,
        None => subject.stages(),
    };
    let mut render = RenderInProgress::begin(census, &offer, &execution).map_err(placed)?;
    if options.denoise {
        check_denoiser_fits(&render)?;
    }
    if let Some((count, scene_at)) = moments {
        render.at_moments(count, scene_at, offer);
    }
    let watched = (!json && !options.quiet).then(|| subject.shown());
    if let (Some(what), true) = (&watched, streams.waits) {
        Progress::announce(what, render.film.width, render.film.height);
    }
    if !(json || options.quiet) {
        notes(census)?.iter().try_for_each(|note| streams.note(note))?;
    }
    let Foretold { warnings: said, lit_pixel } =
        before_rendering(subject, census, options, (&render, began), json, streams)?;

    let mut png =
        PngKind { is_deep: options.bits == Some(16), text: hints::provenance(subject, options, mine.is_some()) };
    if render.moments() > 1 {
        png.text.push(("Moments", render.moments().to_string()));
    }
    let attributes = attributes(subject, options, &scene, (&render, mine.is_some()));
    let files = Files::new(targets, (attributes, options.denoise), &render, (png, mine));
    let waiting = waiting(watched.as_deref(), options, &render, streams);
    let long = if render.is_sampled() {
        Some(render_long(&mut render, census, options, &files, &waiting, &mut |note| {
            if json { Ok(()) } else { streams.note(note) }
        })?)
    } else {
        render_at_once(&mut render, &waiting, &files)?;
        None
    };
    if long.as_ref().is_some_and(|long| long.was_done) {
        return streams.note(&format!("{} is done", files.targets.told(None)));
    }
    let (outcome, checkpoint) = long.map(|LongRender { outcome, checkpoint, .. }| (outcome, checkpoint)).unzip();
    let (samples, rendered) = (render.sampling.samples, render.finish());
    files.send(&rendered.film, streams.out)?;

    let checkpoint = checkpoint.flatten();
    let is_dark_foretold =
        said.iter().any(|warning| warning.starts_with("the picture will") && warning.contains("black"));
    let mut warnings = warnings(subject, options, &rendered.film, &rendered.plan)?;
    warnings.extend(mattes_left_out(&rendered));
    warnings.extend(too_dark(&rendered.film, rendered.curve()).filter(|_| !is_dark_foretold));
    let told = files.targets.told(checkpoint.as_deref());
    if let Curve::Exposed(exposure @ Exposure { automatic: true, .. }, _) = rendered.curve()
        && !json
        && !options.quiet
    {
        let stops = stops_of(&rendered.film, exposure);
        streams.note(&format!(
            "note: the automatic exposure comes to {stops:.2} stops, as --exposure {stops:.2} has them"
        ))?;
    }
    if !json {
        warnings.iter().try_for_each(|warning| streams.note(&format!("warning: {warning}")))?;
    }
    // Where the picture itself goes to standard output, what is said of it does not.
    let out = if files.targets.standard_output { &mut *streams.notes } else { &mut *streams.out };
    if options.quiet && !json {
        writeln!(out, "wrote {told}")?;
        return Ok(());
    }
    let image = rendered.attributes.image.unwrap_or([rendered.film.width, rendered.film.height]);
    let stats = RenderStats::of(subject.name(), &rendered, execution.tile_side);
    let summary = Summary {
        stats: &stats,
        integrator: chosen_integrator(census),
        outcome: outcome.as_ref(),
        samples,
        target: adaptive_of(census)?.map(|adaptive| adaptive.error),
        files: told,
        plan: hints::plan(subject, options),
        next: hints::next(subject, options, image, lit_pixel),
    };
    if json {
        let written = files.targets.pictures.iter().chain(&checkpoint).map(|file| file.display().to_string());
        let warnings: Vec<String> = said.into_iter().chain(warnings).collect();
        return print_json(&summary.data(&written.collect::<Vec<_>>(), &warnings), out);
    }
    if options.verbose {
        write!(out, "{stats}")?;
    }
    summary.lines().iter().try_for_each(|line| Ok(writeln!(out, "{line}")?))
}

/// The integrator and its reason, where the camera names none and rays go beyond the first surface.
fn chosen_integrator(scene: &Census<'_>) -> Option<String> {
    let ChosenIntegrator { integrator, reason, is_named, .. } = integrator_of(scene);
    (!is_named && integrator != Integrator::RayCasting).then(|| format!("{}: {reason}", integrator.in_words()))
}

/// Checks that there is memory for what the denoiser knows of a picture's pixels, two times, beside their film.
fn check_denoiser_fits(render: &RenderInProgress) -> Result {
    const A_PIXEL: u64 = 160;
    let (width, height) = (render.film.width, render.film.height);
    check_memory(u64::from(width) * u64::from(height) * A_PIXEL).map_err(|too_little| {
        Error::usage(format!(
            "cannot denoise a picture of {width} × {height} pixels: what the filter knows of them {too_little}"
        ))
    })
}

/// Has the scene's camera keep the layers that guide the denoiser, beside its own.
pub fn keep_guides(scene: &mut World) {
    let Ok(camera) = camera_entity(&Census::of(scene)) else { return };
    let mut layers = scene.get::<Layers>(camera).cloned().unwrap_or_default();
    layers.kinds.extend(PICTURE_GUIDES);
    scene.entity_mut(camera).insert(layers);
}

/// What the picture's EXR says beside its pixels: nothing that differs between two renders of the same bits.
pub fn attributes(
    subject: &Subject<'_>,
    options: &RenderOptions,
    scene: &World,
    (render, mine): (&RenderInProgress, bool),
) -> FileAttributes {
    let mut attributes = FileAttributes { layer_names: options.layer_names, ..render.attributes.clone() };
    // An EXR does not depend on how its light is shown.
    let scene_options = SceneOptions { exposure: None, tone_map: None, ..options.scene.clone() };
    let own = RenderOptions { scene: scene_options, ..options.clone() };
    attributes.texts.extend(hints::same_picture(subject, &own, mine).map(|command| ("command", command)));
    attributes.texts.extend(options.frame.map(|frame| ("frame", frame.to_string())));
    if render.moments() > 1 {
        attributes.texts.push(("moments", render.moments().to_string()));
    }
    if render.is_sampled() {
        attributes.texts.push(("seed", render.sampling.seed.to_string()));
    }
    attributes.texts.push(("scene", format!("{:016x}", fnv(FNV_BASIS, fingerprint(scene).as_bytes()))));
    attributes
}

/// What shows how far the render is.
fn waiting(what: Option<&str>, options: &RenderOptions, render: &RenderInProgress, streams: &Streams<'_>) -> Waiting {
    // Where samples are counted, their number is told later.
    let steps = if render.is_sampled() { 0 } else { render.film.tiles.len() as u64 };
    let progress = match what {
        None => Progress::hidden(),
        Some(what) if streams.waits => Progress::of(what, steps, options.time),
        Some(_) => Progress::bar(steps),
    };
    Waiting::with(progress, steps)
}

/// Refuses what the picture's kind or the camera's rays cannot give.
fn check_requests(scene: &Census<'_>, options: &RenderOptions, targets: &Targets, streams: &Streams<'_>) -> Result {
    let refused = |what: &str| Err(Error::CommandLine(what.into()));
    if !LayerTable::kinds_of(scene).is_empty() && !targets.hold_layers() {
        let what = "layers are channels of an EXR, so the name must end in .exr, or be left out for both kinds";
        return refused(&format!("cannot write layers to {}: {what}", targets.told(None)));
    }
    if targets.standard_output && streams.terminal {
        return refused("`-o -` sends a PNG to standard output, which is a terminal here, and not a file or a program");
    }
    let sampling = camera_entity(scene).ok().and_then(|camera| scene.get::<Sampling>(camera));
    let sampled = sampling.is_some();
    if options.denoise && sampling.is_none_or(|sampling| sampling.samples < 2) {
        let what = "noise is what the samples of a pixel differ by, so take two of each at least, as --samples 4 does";
        return refused(&format!("cannot denoise a picture of one sample a pixel: {what}"));
    }
    if options.resume && !sampled {
        let what = "one ray a pixel is over at once; --samples, --time or --error take more";
        return refused(&format!("there is nothing to continue: {what}"));
    }
    if options.resume && targets.pictures.is_empty() {
        return refused("there is nothing to continue: what goes to standard output has no checkpoint beside it");
    }
    Ok(())
}

/// One ray through each pixel: all or nothing.
fn render_at_once(render: &mut RenderInProgress, waiting: &Waiting, files: &Files) -> Result {
    let rendered = render.advance(render.steps(), waiting);
    waiting.done();
    rendered?;
    let (mut written, denoised) = (Ok(()), files.denoised(&render.film));
    for file in &files.targets.pictures {
        if interrupted() {
            return Err(pinhole::Error::Interrupted.into());
        }
        written = written.and(files.write_one(&render.film, denoised.as_ref(), file));
    }
    Ok(written?)
}
