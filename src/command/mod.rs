//! The command line: what a reader types, and what they see.
//!
//! Everything is written to the `out` that the caller hands over, so that the book shows what a terminal would.

mod angles;
mod arguments;
mod check;
mod closed_forms;
mod compare;
mod conventions;
mod cost;
mod draw;
mod export;
mod extremes;
mod figure;
mod find;
mod format;
mod hints;
mod interrupt;
mod list;
mod long_render;
mod options;
mod plan;
mod planted;
mod preflight;
mod progress;
mod refused;
mod render;
mod report;
mod report_arguments;
mod review;
mod span;
mod subject;
mod sweep;
mod trace;
mod watch;

pub use interrupt::{Waiting, stop_on_interrupt};
pub use progress::Progress;
pub use report::has_report;

use crate::chapter::Chapter;
use crate::{Error, Result};
use arguments::{Arguments, Command};
use clap::Parser;
use clap::error::ErrorKind;
use options::ExampleArguments;
use std::io::Write;
use std::process::ExitCode;
use subject::Subject;

/// Runs one command line, without the program's name, and writes what a reader sees to `out`.
///
/// Errors: one sentence; nothing of a failed command is left on disk.
pub fn run(chapters: &[Chapter], arguments: &[String], out: &mut dyn Write) -> Result {
    let words = std::iter::once("pinhole").chain(arguments.iter().map(String::as_str));
    let Some(arguments) = parsed::<Arguments>(words, out)? else { return Ok(()) };
    match arguments.command {
        None => render::render_cover(chapters, out),
        Some(Command::Figure(asked)) => figure::draw_figure(chapters, &asked, out),
        Some(Command::Draw(asked)) => draw::draw_image(&asked, out),
        Some(Command::List) => list::list(chapters, out),
        Some(Command::Render(asked)) if asked.watch => watch::render_at_every_save(chapters, &asked, out),
        Some(Command::Render(asked)) => {
            render::render_subject(&Subject::find(chapters, &asked.chapter)?, &asked.options, out)
        }
        Some(Command::Plan(asked)) => plan::print_plan(&Subject::find(chapters, &asked.chapter)?, &asked.options, out),
        Some(Command::Preflight(asked)) => preflight::print_preflight(chapters, &asked, out),
        Some(Command::Angles(asked)) => {
            angles::print_angles(find::chapter(chapters, &asked.chapter)?, &asked.options, out)
        }
        Some(Command::Trace(asked)) => {
            let subject = Subject::find(chapters, &asked.chapter)?;
            trace::print_trace(&subject, asked.pixel, asked.sample, &asked.options, out)
        }
        Some(Command::Export(asked)) => export::export(chapters, &asked, out),
        Some(Command::ClosedForms(asked)) => closed_forms::print_closed_forms(&asked, out),
        Some(Command::Extremes(asked)) => extremes::print_extremes(chapters, &asked, out),
        Some(Command::Sweep(asked)) => sweep::print_sweep(&Subject::find(chapters, &asked.chapter)?, out),
        Some(Command::Check(asked)) => check::check(chapters, asked.chapter.as_deref(), out),
        Some(Command::Cost(asked)) => cost::print_cost(chapters, &asked, out),
        Some(Command::Report(asked)) => report::report(chapters, &asked, out),
        Some(Command::Review(asked)) => review::review(chapters, &asked, out),
        Some(Command::Compare(asked)) => compare::compare(&asked, out),
        Some(Command::Conventions(asked)) => conventions::print_conventions(chapters, &asked, out),
    }
}

/// A chapter's example: renders it, or looks inside, as the command line asks.
pub fn run_example(chapter: &Chapter, arguments: &[String], out: &mut dyn Write) -> Result {
    let words = std::iter::once(chapter.name).chain(arguments.iter().map(String::as_str));
    let Some(arguments) = parsed::<ExampleArguments>(words, out)? else { return Ok(()) };
    match arguments.trace {
        Some(pixel) => {
            let (subject, options) = (Subject::Chapter(chapter), &arguments.options.scene);
            trace::print_trace(&subject, pixel, arguments.sample, options, out)
        }
        None => render::render_subject(&Subject::Chapter(chapter), &arguments.options, out),
    }
}

/// Parses, or answers a call for help by itself.
fn parsed<'a, P: Parser>(words: impl Iterator<Item = &'a str>, out: &mut dyn Write) -> Result<Option<P>> {
    match P::try_parse_from(words) {
        Ok(arguments) => Ok(Some(arguments)),
        Err(answer) if matches!(answer.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) => {
            write!(out, "{answer}")?;
            Ok(None)
        }
        Err(answer) => Err(Error::Usage(refused::sentence(&answer, &P::command()))),
    }
}

/// What a program's `main` does with a command: prints a failure as one sentence, and takes a closed pipe for an end.
pub fn conclude(result: Result) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(Error::Print(broken)) if broken.kind() == std::io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(stop @ (Error::Interrupted | Error::Stopped(_))) => {
            let _ = writeln!(std::io::stderr(), "pinhole: {stop}");
            ExitCode::from(130)
        }
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "pinhole: {error}");
            ExitCode::FAILURE
        }
    }
}
