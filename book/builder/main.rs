//! Builds the book: `cargo run -p book` writes it to `out/book/`, `-- --serve` shows it while you write.
//!
//! The pages are `book/src/*.md`. mdBook makes the site; what stands here is what mdBook does not do: checks that
//! fail ([`check`]), formulas without a network ([`math`]), listings, and text and pictures made by the kit at every
//! build ([`page`], [`kit`], [`figure`]).

mod build;
#[expect(dead_code, reason = "tests/book.rs includes this module too and asks for more than a build does")]
mod check;
mod edit;
mod figure;
mod kit;
mod math;
mod page;
mod serve;
mod site;
mod watch;

#[path = "../../chapters/mod.rs"]
mod chapters;

use std::io::Write;
use std::process::ExitCode;
use std::time::Instant;

const USAGE: &str = "\
cargo run -p book                        build the book into out/book/
cargo run -p book -- --serve             show it at http://127.0.0.1:3000 and follow every change
cargo run -p book -- --serve --port N    the same at another port";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let told = wish(&arguments).and_then(|wish| fulfil(&wish));
    match told {
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

#[derive(Debug, PartialEq, Eq)]
enum Wish {
    Help,
    Build,
    Serve { port: u16 },
}

fn wish(arguments: &[String]) -> Result<Wish, String> {
    let (mut serve, mut port) = (false, None);
    let mut arguments = arguments.iter().map(String::as_str);
    while let Some(argument) = arguments.next() {
        match argument {
            "--help" | "-h" => return Ok(Wish::Help),
            "--serve" => serve = true,
            "--port" => {
                let number = arguments.next().unwrap_or_default();
                let wrong = |_| format!("--port takes a number from 0 to 65535, not `{number}`.");
                port = Some(number.parse().map_err(wrong)?);
            }
            other => {
                return Err(format!("`{other}` is not understood; accepted is:\n{USAGE}"));
            }
        }
    }
    match (serve, port) {
        (true, port) => Ok(Wish::Serve { port: port.unwrap_or(3000) }),
        (false, None) => Ok(Wish::Build),
        (false, Some(_)) => Err("--port goes with --serve.".to_owned()),
    }
}

fn fulfil(wish: &Wish) -> Result<(), String> {
    let book = build::Book::of_this_repository();
    // A command of the kit may name a file; a reader would type it from the top of the repository.
    std::env::set_current_dir(&book.repository)
        .map_err(|error| format!("{} cannot be entered: {error}.", book.repository.display()))?;
    let out = &mut std::io::stdout();
    match wish {
        Wish::Help => say(out, USAGE),
        Wish::Build => {
            let start = Instant::now();
            build::build(&book, &kit::Kit::shared())?;
            let index = book.out.join("index.html");
            say(out, &format!("{} (in {:.1} s)", index.display(), start.elapsed().as_secs_f64()));
        }
        Wish::Serve { port } => serve::serve(&book, &kit::Kit::shared(), *port, out)?,
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(line: &str) -> Result<Wish, String> {
        wish(&line.split_whitespace().map(str::to_owned).collect::<Vec<_>>())
    }

    #[test]
    fn arguments_are_read() {
        assert_eq!(asked(""), Ok(Wish::Build));
        assert_eq!(asked("--serve"), Ok(Wish::Serve { port: 3000 }));
        assert_eq!(asked("--port 80 --serve"), Ok(Wish::Serve { port: 80 }));
        assert_eq!(asked("--port 80"), Err("--port goes with --serve.".to_owned()));
        assert_eq!(asked("--serve --port x"), Err("--port takes a number from 0 to 65535, not `x`.".to_owned()));
        assert!(asked("--open").is_err_and(|told| told.starts_with("`--open` is not understood; accepted is:\n")));
    }
}
