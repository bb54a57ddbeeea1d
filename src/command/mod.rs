//! The command line: what a reader types, and what they see.
//!
//! Everything is written to the `out` that the caller hands over, so that the book shows what a terminal would.

mod angles;
mod arguments;
mod called;
mod chapter_text;
mod check;
mod closed_forms;
mod compare;
mod completions;
mod conventions;
mod cost;
mod draw;
mod error;
mod export;
mod export_images;
mod export_meshes;
mod export_model;
mod extremes;
mod farm;
mod figure;
mod files;
mod find;
mod format;
mod frames;
mod hints;
mod interrupt;
mod list;
mod live;
mod long_render;
mod measure;
mod methods;
mod mine;
mod mutation;
mod options;
mod own_file;
mod parse;
mod parts;
mod plan;
mod preflight;
mod progress;
mod render;
mod report;
mod report_arguments;
mod review;
mod span;
mod streams;
mod subject;
mod summary;
mod sweep;
mod trace;
mod view;
mod visible;
mod warnings;
mod watch;
mod yours;

pub use error::{Error, Result};
pub use interrupt::{Waiting, stop_on_interrupt};
pub use measure::{outdated_costs, outdated_report};
pub use methods::outdated_methods;
pub use progress::Progress;
pub use report::has_report;

use arguments::{Arguments, Command};
use parse::{parsed, program, with_render};
use pinhole::Chapter;
use pinhole::scene::printable_message;
use pinhole_lab::exercise::Exercise;
use std::ffi::{OsStr, OsString};
use std::io::{ErrorKind, IsTerminal, Write, stderr, stdout};
use streams::Streams;
use subject::Subject;
use visible::Visible;

/// What chapters ask their readers to write, each with the name of its chapter.
pub type Exercises = fn() -> Vec<(&'static str, Exercise)>;

/// Runs one command line, without the program's name, and writes what a reader sees to `out`; notes and warnings go to
/// standard error.
///
/// No chapter asks for a function here; the program itself hands them over ([`run_program`]).
///
/// Errors: one sentence, or what clap says of words that it cannot parse; nothing of a failed command is left on disk.
pub fn run(chapters: &[Chapter], arguments: &[impl AsRef<OsStr>], out: &mut dyn Write) -> Result {
    run_with_notes(chapters, arguments, out, &mut stderr())
}

/// The same, with notes and warnings to a place of their own.
///
/// Errors: as [`run`].
pub fn run_with_notes(
    chapters: &[Chapter],
    arguments: &[impl AsRef<OsStr>],
    out: &mut dyn Write,
    notes: &mut dyn Write,
) -> Result {
    let words: Vec<OsString> = arguments.iter().map(OsString::from).collect();
    let mut streams = Streams { out, notes, waits: false, terminal: false };
    match perform(chapters, Vec::new, &words, &mut streams) {
        Err(Error::Clap(help)) if !help.use_stderr() => Ok(write!(streams.out, "{help}")?),
        result => result,
    }
}

/// Runs the command line that the program was started with, and gives the status that it ends with.
pub fn run_program(chapters: &[Chapter], exercises: Exercises) -> u8 {
    called::remember();
    let words: Vec<OsString> = std::env::args_os().skip(1).collect();
    status(with_standard_streams(|streams| perform(chapters, exercises, &words, streams)))
}

fn with_standard_streams(perform: impl FnOnce(&mut Streams<'_>) -> Result) -> Result {
    let (mut out, mut notes) = (stdout().lock(), stderr());
    let terminal = out.is_terminal();
    perform(&mut Streams { out: &mut out, notes: &mut notes, waits: true, terminal })
}

fn perform(chapters: &[Chapter], exercises: Exercises, words: &[OsString], streams: &mut Streams<'_>) -> Result {
    let words = with_render(chapters, words);
    let Arguments { command, format } = parsed(program(), chapters, &words, streams.waits)?;
    match command {
        // These are for a shell and for another program.
        Some(Command::Completions { shell }) => return completions::print_completions(shell, streams.out),
        Some(Command::Live(asked)) => return live::live(chapters, &asked, streams.out),
        _ => {}
    }
    let (mut out, mut notes) = (Visible(&mut *streams.out), Visible(&mut *streams.notes));
    let streams = &mut Streams { out: &mut out, notes: &mut notes, waits: streams.waits, terminal: streams.terminal };
    let out = &mut *streams.out;
    match command {
        None => render::render_cover(chapters, format, streams),
        Some(Command::Figure(asked)) => figure::draw_figure(chapters, &asked, format, out),
        Some(Command::Draw(asked)) => draw::draw_image(&asked, format, out),
        Some(Command::List) => list::list(chapters, format, out),
        Some(Command::Render(asked)) if asked.watch => watch::render_at_every_save(chapters, &asked, format, streams),
        Some(Command::Render(asked)) if asked.mine => {
            mine::render_mine(chapters, &exercises(), &asked, format, streams)
        }
        Some(Command::Render(asked)) => {
            let subject = Subject::find(chapters, &asked.chapter)?.set(&asked.options.scene.set)?;
            match asked.options.naive {
                _ if asked.options.frames.is_some() => {
                    let (options, frames) = (asked.options(), asked.options.frames.unwrap_or_default());
                    frames::render_frames(&subject, &options, frames, format, streams)
                }
                _ if asked.options.part.is_some() => {
                    let options = asked.options();
                    parts::render_part(&subject, &options, options.part(), format, streams)
                }
                Some(_) => render::render_naive(&subject, &asked.options(), format, streams),
                None => render::render_subject(&subject, &asked.options(), format, streams),
            }
        }
        Some(Command::Merge(asked)) => {
            let subject = Subject::find(chapters, &asked.chapter)?.set(&asked.options.scene.set)?;
            match asked.options.frames {
                Some(frames) => frames::missing_frames(&subject, &asked.options, frames, streams),
                None => parts::merge(&subject, &asked.options, (&asked.parts, asked.verify), format, streams),
            }
        }
        Some(Command::Farm(asked)) => farm::farm(chapters, &asked, &words, format, streams),
        Some(Command::Plan(asked)) => {
            let subject = Subject::find(chapters, &asked.chapter)?.set(&asked.options.set)?;
            plan::print_plan(&subject, &asked.options, format, out)
        }
        Some(Command::Preflight(asked)) => preflight::print_preflight(chapters, &asked, format, streams),
        Some(Command::Angles(asked)) => {
            let subject = Subject::find(chapters, &asked.chapter)?.set(&asked.options.set)?;
            angles::print_angles(&subject, &asked.options, format, out)
        }
        Some(Command::Trace(asked)) => {
            let subject = Subject::find(chapters, &asked.chapter)?.set(&asked.options.set)?;
            trace::print_trace(&subject, asked.pixel, asked.sample, asked.all, &asked.options, format, out)
        }
        Some(Command::View(asked)) => view::view(chapters, &asked, format, streams),
        Some(Command::Export(asked)) => export::export(chapters, &asked, format, streams),
        Some(Command::ClosedForms(asked)) => closed_forms::print_closed_forms(&asked, format, out),
        Some(Command::Extremes(asked)) => extremes::print_extremes(chapters, &asked, format, out),
        Some(Command::Sweep(asked)) => sweep::print_sweep(&Subject::find(chapters, &asked.chapter)?, format, out),
        Some(Command::Check(asked)) => check::check(chapters, &exercises(), asked.chapter.as_deref(), format, out),
        Some(Command::Cost(asked)) => cost::print_cost(chapters, &asked, format, out),
        Some(Command::Measure(asked)) => measure::measure_anew(chapters, &asked, format, streams),
        Some(Command::Methods(asked)) => methods::print_methods(chapters, &asked, format, out),
        Some(Command::Report(asked)) => report::report(chapters, &asked, format, out),
        Some(Command::Review(asked)) => review::review(chapters, &asked, format, out),
        Some(Command::Yours(asked)) => yours::yours(&asked, format, streams),
        Some(Command::Compare(asked)) => compare::compare(&asked, format, out),
        Some(Command::Conventions(asked)) => conventions::print_conventions(chapters, &asked, format, out),
        Some(Command::Live(_) | Command::Completions { .. }) => Ok(()),
    }
}

/// Says how a command ended, and gives the status that the program ends with: 0 if all is well, and where the reader of
/// a pipe has seen enough; 1 for a failure; 2 for a command line that makes no sense; 75 where the same command is to be
/// run again; 130 for a stop by Ctrl-C.
pub fn status(result: Result) -> u8 {
    let (error, status) = match result {
        Ok(()) => return 0,
        Err(Error::Pinhole(pinhole::Error::Print(broken))) if broken.kind() == ErrorKind::BrokenPipe => return 0,
        Err(Error::Clap(answer)) => match answer.print() {
            Ok(()) => return u8::try_from(answer.exit_code()).unwrap_or(2),
            Err(broken) if broken.kind() == ErrorKind::BrokenPipe => return 0,
            Err(refused) => (refused.into(), 1),
        },
        Err(stop @ Error::Pinhole(pinhole::Error::Interrupted | pinhole::Error::Stopped(_))) => (stop, 130),
        Err(words @ Error::CommandLine(_)) => (words, 2),
        // EX_TEMPFAIL of sysexits.h, by which a scheduler knows that it is to run the same again.
        Err(later @ Error::Unfinished(_)) => (later, 75),
        Err(error) => (error, 1),
    };
    let _ = writeln!(stderr(), "pinhole: {}", printable_message(&error));
    status
}
