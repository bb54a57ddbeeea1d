//! Builds the book: `cargo run -p book` writes it to `out/book/`, `-- --serve` shows it while you write.
//!
//! The pages are `book/src/*.md`. mdBook makes the site; what stands here is what mdBook does not do: checks that
//! fail ([`check`]), formulas without a network ([`math`]), listings, and text and pictures made by pinhole at every
//! build ([`page`], [`program`], [`figure`]). Served, figures have values that a reader moves ([`live`]).

mod build;
#[expect(dead_code, reason = "tests/book.rs includes this module too and asks for more than a build does")]
mod check;
mod edit;
mod exercises;
mod figure;
mod graph;
mod handout;
mod http;
mod index;
mod kept;
mod live;
mod live_figure;
#[cfg(test)]
mod live_page;
mod math;
mod measure;
mod page;
mod print;
mod program;
mod progress;
mod serve;
mod site;
mod slides;
mod teaching;
mod watch;

use clap::Parser;
use std::io::Write;
use std::process::ExitCode;
use std::time::Instant;

/// Builds the book into out/book/
#[derive(Debug, Parser)]
#[command(bin_name = "cargo run -p book --")]
struct Arguments {
    /// Shows the book in a browser on this machine, its figures with controls, and follows every change
    #[arg(long)]
    serve: bool,
    /// Says of each page how much is prose and how much is printed, and what is folded; builds nothing
    #[arg(long, conflicts_with = "serve")]
    measure: bool,
    /// The port at which it is shown
    #[arg(long, requires = "serve", default_value_t = 3000)]
    port: u16,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            say(&mut std::io::stderr(), &message);
            ExitCode::FAILURE
        }
    }
}

/// A closed pipe is the reader's choice, no failure of the build.
fn say(out: &mut dyn Write, message: &str) {
    let _ = writeln!(out, "{message}");
}

fn run(arguments: &Arguments) -> Result<(), String> {
    let book = build::Book::of_this_repository();
    // A command of pinhole may name a file; a reader would type it from the top of the repository.
    std::env::set_current_dir(&book.repository)
        .map_err(|error| format!("{} cannot be entered: {error}.", book.repository.display()))?;
    let out = &mut std::io::stdout();
    let program = program::Program::shared(&book.repository)?;
    if arguments.measure {
        return measure::measure(&book, &program, out);
    }
    if arguments.serve {
        return serve::serve(&book, &program, arguments.port, out);
    }
    let start = Instant::now();
    build::build(&book, &program)?;
    program.borrow().let_go();
    let index = book.out.join("index.html");
    say(out, &format!("{} (in {:.1} s)", index.display(), start.elapsed().as_secs_f64()));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::error::ErrorKind;
    use std::ffi::OsStr;

    fn asked(words: &[&OsStr]) -> Result<(bool, u16), (ErrorKind, i32)> {
        let arguments = Arguments::try_parse_from([OsStr::new("book")].iter().chain(words));
        arguments.map(|asked| (asked.serve, asked.port)).map_err(|error| (error.kind(), error.exit_code()))
    }

    fn typed(line: &str) -> Result<(bool, u16), (ErrorKind, i32)> {
        asked(&line.split_whitespace().map(OsStr::new).collect::<Vec<_>>())
    }

    #[test]
    fn arguments_are_read() {
        assert_eq!(typed(""), Ok((false, 3000)));
        assert_eq!(typed("--serve"), Ok((true, 3000)));
        assert_eq!(typed("--port 80 --serve"), Ok((true, 80)));
        assert_eq!(typed("--port 80"), Err((ErrorKind::MissingRequiredArgument, 2)));
        assert_eq!(typed("--serve --port x"), Err((ErrorKind::ValueValidation, 2)));
        assert_eq!(typed("--serve --port 65536"), Err((ErrorKind::ValueValidation, 2)));
        assert_eq!(typed("--open"), Err((ErrorKind::UnknownArgument, 2)));
        assert_eq!(typed("--help"), Err((ErrorKind::DisplayHelp, 0)));
    }

    #[cfg(unix)]
    #[test]
    fn words_that_are_not_utf8_are_refused() {
        use std::os::unix::ffi::OsStrExt;
        let [serve, port, odd] = [b"--serve".as_slice(), b"--port", b"caf\xe9"].map(OsStr::from_bytes);
        assert_eq!(asked(&[serve, odd]).map_err(|refused| refused.1), Err(2));
        assert_eq!(asked(&[serve, port, odd]).map_err(|refused| refused.1), Err(2));
    }
}
