use super::find;
use super::hints::try_next;
use super::interrupt::{Waiting, interrupted};
use super::long_render::{Files, render_long, tell_outcome, warn_of_empty_layers};
use super::options::RenderOptions;
use super::subject::Subject;
use crate::chapter::Chapter;
use crate::extract::{ImageShape, LayerTable, PinholeLens, SMALLEST_PIXEL, adaptive_of, camera_entity, validate};
use crate::film::{Film, check_place};
use crate::look::{Preflight, RenderStats, preflight};
use crate::plan::Table;
use crate::render::{Execution, RenderUnderWay};
use crate::scene::{PerspectiveCamera, Sampling};
use crate::{Error, Result};
use bevy_ecs::prelude::*;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The main job: the cover, to `out/`.
pub fn render_cover(chapters: &[Chapter], out: &mut dyn Write) -> Result {
    render_subject(&Subject::Chapter(find::chapter(chapters, "cover")?), &RenderOptions::default(), out)
}

/// Renders a scene and says what ran, what was left out, and what to try next.
pub fn render_subject(subject: &Subject<'_>, options: &RenderOptions, out: &mut dyn Write) -> Result {
    let pictures = files(subject, options)?;
    pictures.iter().try_for_each(|file| check_place(file))?;
    let execution = Execution { threads: options.threads.map(usize::from), ..Execution::default() };
    let asked = options.asked(!options.quiet);
    let scene = subject.world(&asked);
    let placed = |error| subject.placed(error, &asked);
    validate(&scene).map_err(|refusal| placed(refusal.into()))?;
    check_requests(&scene, options, &pictures)?;
    let mut render = RenderUnderWay::begin(&scene, &subject.stages(), &execution).map_err(placed)?;
    if !options.quiet && !options.stats {
        let (threads, ends_in_time) = (execution.threads, options.time.is_some());
        let asked = Preflight { threads, ends_in_time, ..Preflight::default() };
        for warning in preflight(&scene, (&render.plan, render.tables()), asked)? {
            writeln!(out, "before rendering: {warning}")?;
        }
    }
    let files = Files::new(pictures, &scene, &render.plan);
    let outcome = if render.is_sampled() {
        Some(render_long(&mut render, &scene, options, &files, out)?)
    } else {
        render_at_once(&mut render, options, &files)?;
        None
    };
    let (samples, rendered) = (render.sampling.samples, render.finish());
    if options.stats {
        let stats = RenderStats::of(subject.name(), &rendered, execution.tile_side);
        let json = serde_json::to_string_pretty(&stats).map_err(std::io::Error::from)?;
        writeln!(out, "{json}")?;
        return Ok(());
    }
    if !options.quiet {
        write!(out, "{}", RenderStats::of(subject.name(), &rendered, execution.tile_side))?;
        if let Some(outcome) = &outcome {
            let target = adaptive_of(&scene)?.map(|adaptive| adaptive.error);
            tell_outcome(outcome, samples, target, out)?;
        }
    }
    writeln!(out, "wrote {}", files.told(outcome.is_some() && files.checkpoint().exists()))?;
    warn_of_rejected(&rendered.film, out)?;
    tell_of_too_much_light(&rendered.film, out)?;
    warn_of_empty_layers(&rendered.film, &rendered.plan, out)?;
    tell_of_negative_weights(&rendered.film, out)?;
    warn_of_narrow_pixels(subject, options, out)?;
    if !options.quiet {
        write!(out, "{}", try_next(subject, rendered.film.width, rendered.film.height))?;
    }
    Ok(())
}

/// Refuses what the picture's kind or the camera's rays cannot give.
fn check_requests(scene: &World, options: &RenderOptions, pictures: &[PathBuf]) -> Result {
    let is_exr = |file: &PathBuf| ending(file) == "exr";
    if !LayerTable::kinds_of(scene).is_empty() && !pictures.iter().any(is_exr) {
        let named = pictures.first().map_or_else(String::new, |file| file.display().to_string());
        let what = "layers are channels of an EXR, so the name must end in .exr, or be left out for both kinds";
        return Err(Error::Usage(format!("cannot write layers to {named}: {what}")));
    }
    let sampled = camera_entity(scene).is_ok_and(|camera| scene.get::<Sampling>(camera).is_some());
    if options.resume && !sampled {
        let what = "one ray a pixel is over at once; --samples, --time or --error take more";
        return Err(Error::Usage(format!("there is nothing to continue: {what}")));
    }
    Ok(())
}

/// One ray through each pixel: all or nothing.
fn render_at_once(render: &mut RenderUnderWay, options: &RenderOptions, files: &Files) -> Result {
    let waiting = Waiting::new(render.film.tiles.len() as u64, options.quiet || options.stats);
    let rendered = render.advance(render.steps(), &waiting);
    waiting.done();
    rendered?;
    for file in &files.pictures {
        if interrupted() {
            return Err(Error::Interrupted);
        }
        files.write_one(&render.film, file)?;
    }
    Ok(())
}

/// Where to write: the file asked for, or both kinds in `out/`.
fn files(subject: &Subject<'_>, options: &RenderOptions) -> Result<Vec<PathBuf>> {
    let Some(file) = &options.output else {
        let stem = match &options.scene.view {
            Some(column) => format!("{}_{}", subject.stem(), column.replace(' ', "_")),
            None => subject.stem(),
        };
        return Ok(["png", "exr"].map(|ending| Path::new("out").join(format!("{stem}.{ending}"))).to_vec());
    };
    match ending(file) {
        "png" | "exr" => Ok(vec![file.clone()]),
        _ => Err(Error::Usage(format!("cannot write {}: the name must end in .png or .exr", file.display()))),
    }
}

fn ending(file: &Path) -> &str {
    file.extension().and_then(|ending| ending.to_str()).unwrap_or("")
}

fn warn_of_rejected(film: &Film, out: &mut dyn Write) -> Result {
    let (count, first) = film.rejected();
    let which = first.first().map_or_else(
        || "all of them light from lamps".into(),
        |sample| {
            let ([x, y], [r, g, b]) = (sample.pixel, sample.radiance);
            format!("the first is sample {} of pixel {x},{y} with radiance ({r}, {g}, {b})", sample.sample)
        },
    );
    if count > 0 {
        writeln!(out, "warning: {count} samples were negative or not finite and did not join the film; {which}")?;
    }
    Ok(())
}

/// Says how many pixels have gathered more light than a picture holds.
fn tell_of_too_much_light(film: &Film, out: &mut dyn Write) -> Result {
    let pixels = film.too_bright();
    if pixels > 0 {
        writeln!(
            out,
            "note: {pixels} pixels gathered more light than 32-bit floats hold; they show {:e} instead",
            f32::MAX
        )?;
    }
    Ok(())
}

/// Says how many pixels a filter that is negative in places has left without weight or below 0.
fn tell_of_negative_weights(film: &Film, out: &mut dyn Write) -> Result {
    let (without, below) = film.weighed_out();
    if without > 0 {
        writeln!(
            out,
            "note: the weights of {without} pixels do not sum to more than 0 yet, so they show the plain mean of their \
             samples; more samples or another filter help"
        )?;
    }
    if below > 0 {
        writeln!(out, "note: {below} pixels came out below 0, for the filter is negative in places; they show 0")?;
    }
    Ok(())
}

/// Says where an angle is so wide that pixels near the corners are narrower than f32 rays can be told apart.
fn warn_of_narrow_pixels(subject: &Subject<'_>, options: &RenderOptions, out: &mut dyn Write) -> Result {
    let scene = subject.world(&options.scene.asked(false));
    let perspective = camera_entity(&scene).is_ok_and(|camera| scene.get::<PerspectiveCamera>(camera).is_some());
    if !perspective {
        return Ok(());
    }
    let narrowest = PinholeLens::extract(&scene)?.narrowest_pixel(ImageShape::extract(&scene)?);
    if narrowest < SMALLEST_PIXEL {
        writeln!(
            out,
            "warning: so wide an angle leaves pixels in the corners {narrowest:.1e} rad wide, and world rays in f32 can \
             be off by about {:.2} of such a pixel",
            f64::from(f32::EPSILON) / narrowest
        )?;
    }
    Ok(())
}
