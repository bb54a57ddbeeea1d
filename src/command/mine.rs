//! `render N --mine`: the chapter's picture with the reader's function in it, beside pinhole's.

use super::arguments::RenderChapter;
use super::check::{Named, exercise_of};
use super::error::{Error, Result};
use super::find;
use super::format::Format;
use super::interrupt::Waiting;
use super::options::RenderOptions;
use super::own_file::{check_file, write_file};
use super::progress::Progress;
use super::render::render_with;
use super::status;
use super::streams::Streams;
use super::subject::Subject;
use super::warnings::{too_dark, warnings};
use pinhole::Chapter;
use pinhole::render::Execution;
use pinhole_lab::exercise::{Exercise, Mine, Outcome, PATIENCE, PicturePair, end_at_panics, sheet};
use std::borrow::Cow;
use std::path::Path;

/// Renders a chapter with the reader's function in place of one of pinhole's stages, and beside it the same with pinhole's
/// own, writes both and their difference to one picture, and says how much they differ. Where the reader names a file, or
/// only time ends the render, the picture is the reader's alone.
///
/// Errors: no chapter with an exercise, or one that no picture shows; --resume; a function that never answers, panics
/// or gives what no picture can hold, in one sentence, and then no file is written.
pub fn render_mine(
    chapters: &[Chapter],
    exercises: &[Named],
    asked: &RenderChapter,
    format: Format,
    streams: &mut Streams<'_>,
) -> Result {
    let (asked, mut options) = (&asked.chapter, asked.options());
    if options.resume {
        let what = "a function may have changed since, so `--mine` begins anew; leave out --resume";
        return Err(Error::CommandLine(format!("there is nothing to continue: {what}")));
    }
    if find::is_scene_file(asked) || asked == "-" {
        let what = "`--mine` renders a chapter with the function that it asks you to write; a scene file asks for none";
        return Err(Error::CommandLine(what.into()));
    }
    let (name, exercise) = exercise_of(chapters, exercises, &asked.to_string_lossy())?;
    let number = name.split('_').next().unwrap_or(name);
    let chapter = exercise.pictured(find::chapter(chapters, name)?, 0);
    if streams.waits {
        end_at_panics(end);
    }
    let mut mine = Mine::of(exercise, &chapter, &chapter.world(&options.asked(!options.quiet)))?;
    let report = exercise.check(PATIENCE);
    match &report.outcome {
        Outcome::Late(..) => {
            let late = report.sentence().unwrap_or_default();
            return Err(Error::usage(format!("{late}, so nothing is rendered; `check {number}` shows the input")));
        }
        _ if report.is_done() => {}
        _ if report.is_stub() => {
            streams.note(&format!("note: {} gives one and the same answer, as the stub does", exercise.function))?;
        }
        _ => {
            let sentence = report.sentence().unwrap_or_default();
            streams.note(&format!("note: {sentence}; `check {number}` shows the first"))?;
        }
    }
    let file = Path::new("out").join(format!("{number}_mine.png"));
    if mine.painted().is_some() && (!options.output.is_empty() || format != Format::Text) {
        let what = "stands in no stage, so its picture is painted beside pinhole's";
        return Err(Error::usage(format!("{} {what}: `render {number} --mine` alone writes it", exercise.function)));
    }
    let sampled_to_an_end = options.time.is_none() && options.scene.error.is_none();
    if options.output.is_empty() && sampled_to_an_end && format == Format::Text && !options.stats {
        return render_beside((find::chapter(chapters, name)?, exercise), &options, &file, streams);
    }
    if options.output.is_empty() {
        (options.output, options.output_is_chosen) = (vec![file], true);
    }
    let subject = Subject::Chapter(Cow::Owned(mine.chapter.clone()));
    render_with(&subject, &options, (Some(mine), None), format, streams)
}

/// Both pictures and their difference in each scene of the exercise, all in one file, and a sentence for each scene.
fn render_beside(
    (chapter, exercise): (&Chapter, &Exercise),
    options: &RenderOptions,
    file: &Path,
    streams: &mut Streams<'_>,
) -> Result {
    check_file(false, file)?;
    let execution = Execution { threads: options.threads.map(usize::from), ..Execution::default() };
    let (mut pairs, mut said): (Vec<(&str, PicturePair)>, Vec<String>) = (Vec::new(), Vec::new());
    let mut same = true;
    for (number, what) in exercise.scenes().enumerate() {
        let progress = if options.quiet { Progress::hidden() } else { Progress::bar(0) };
        let waiting = Waiting::with(progress, 0);
        let pair = PicturePair::render(exercise, (chapter, number), &options.asked(false), (&execution, &waiting));
        waiting.done();
        match pair {
            Err(pinhole::Error::Usage(told)) if number > 0 => {
                same = false;
                said.push(format!("{what}: {told}"));
            }
            pair => {
                let pair = pair?;
                let seen = pair.seen();
                same &= seen.is_same();
                said.push(if number == 0 { seen.sentence() } else { format!("{what}: {}", seen.sentence()) });
                pairs.push((what, pair));
                // What is there is kept, even if the function panics in the next scene.
                write_file(false, file, &sheet(&pairs)?)?;
            }
        }
        if let (0, Some((_, PicturePair { rendered: Some(rendered), .. }))) = (number, pairs.first()) {
            let subject = Subject::Chapter(Cow::Owned(exercise.pictured(chapter, 0)));
            let mut warned = warnings(&subject, options, &rendered.film, &rendered.plan)?;
            warned.extend(too_dark(&rendered.film, rendered.curve()));
            warned.iter().try_for_each(|warning| streams.note(&format!("warning: {warning}")))?;
        }
    }
    let shown = file.display();
    writeln!(streams.out, "{shown}: pinhole's picture, the one with your {}, and their difference", exercise.function)?;
    // Where all of them are the same, one sentence says it.
    said.truncate(if same { 1 } else { said.len() });
    Ok(said.iter().try_for_each(|line| writeln!(streams.out, "{line}"))?)
}

/// Ends the program as any failed command does; a panic on a thread of a render leaves nobody else to do so.
fn end(sentence: &str) -> ! {
    std::process::exit(status(Err(Error::usage(sentence))).into())
}
