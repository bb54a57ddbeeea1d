use super::arguments::{Arguments, after_help};
use super::called::called;
use super::error::{Error, Result};
use super::find;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Command, CommandFactory, Parser};
use pinhole::Chapter;
use std::ffi::{OsStr, OsString};

/// Where no one waits, the help is as wide as this whatever the terminal is, so that the book's is always the same.
const WIDTH: usize = 100;

/// The command line of the program.
pub fn program() -> Command {
    Arguments::command().after_help(after_help())
}

/// The words with `render` before a chapter or a scene file that stands where a command would.
pub fn with_render(chapters: &[Chapter], words: &[OsString]) -> Vec<OsString> {
    let mut words = words.to_vec();
    let at = match words.first().map(|word| word.to_string_lossy()).as_deref() {
        Some("--format") => 2,
        Some(word) if word.starts_with("--format=") => 1,
        _ => 0,
    };
    let command = program();
    let names = |word: &OsStr| word == "help" || command.get_subcommands().any(|own| own.get_name() == word);
    if words.get(at).is_some_and(|word| !names(word) && find::is_subject(chapters, word)) {
        words.insert(at, "render".into());
    }
    words
}

/// The arguments that words stand for.
///
/// Errors: clap's own, to which a chapter is added that a word comes near to; or help, which is asked for in the same way.
pub fn parsed<P: Parser>(command: Command, chapters: &[Chapter], words: &[OsString], waits: bool) -> Result<P> {
    let mut command = command.bin_name(called(""));
    if !waits {
        command = command.term_width(WIDTH);
    }
    let all = std::iter::once(OsStr::new("pinhole")).chain(words.iter().map(OsString::as_os_str));
    let matches = command.try_get_matches_from_mut(all).map_err(|mut answer| {
        match answer.kind() {
            ErrorKind::InvalidSubcommand => name_chapters(chapters, &mut answer),
            ErrorKind::UnknownArgument => name_begun_option(&mut command, words, &mut answer),
            _ => {}
        }
        Error::Clap(Box::new(answer))
    })?;
    P::from_arg_matches(&matches).map_err(|answer| Error::Clap(Box::new(answer.format(&mut command))))
}

/// The fewest letters that begin an option for it to be meant.
const BEGUN: usize = 3;

/// Names the option that a word begins, which is nearer to it than one of about the same letters: `--sample` is
/// `--samples`.
fn name_begun_option(command: &mut Command, words: &[OsString], answer: &mut clap::Error) {
    let Some(ContextValue::String(word)) = answer.get(ContextKind::InvalidArg) else { return };
    let Some(begun) = word.strip_prefix("--").filter(|begun| begun.len() >= BEGUN).map(str::to_owned) else { return };
    let Some(named) = words.iter().find_map(|word| Some(command.find_subcommand(word)?.get_name().to_owned())) else {
        return;
    };
    let Some(own) = command.find_subcommand_mut(named) else { return };
    let options = own.get_arguments().filter_map(|option| option.get_long());
    if let Some(option) = options.filter(|option| option.starts_with(&begun)).min_by_key(|option| option.len()) {
        let option = format!("--{option}");
        answer.insert(ContextKind::SuggestedArg, ContextValue::String(option));
        answer.insert(ContextKind::Usage, ContextValue::StyledStr(own.render_usage()));
    }
}

/// Adds the chapters that a word comes near to, which is no command.
fn name_chapters(chapters: &[Chapter], answer: &mut clap::Error) {
    let Some(ContextValue::String(word)) = answer.get(ContextKind::InvalidSubcommand) else { return };
    let tip = |name: &&str| StyledStr::from(format!("a chapter has a similar name: {}", called(name)));
    let tips: Vec<StyledStr> = find::nearest(chapters, word).iter().map(tip).collect();
    if !tips.is_empty() {
        answer.insert(ContextKind::Suggested, ContextValue::StyledStrs(tips));
    }
}
