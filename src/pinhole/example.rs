use crate::each::Each;
use crate::film::{write_exr_with, write_png};
use crate::render::{Execution, render};
use crate::scene::{Resolution, printable_message};
use crate::{Chapter, Error, Overrides, Result, Size};
use std::ffi::OsString;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The options of an example, and where to find everything else.
const TAKES: &str = "an example takes --size WIDTHxHEIGHT, --samples N and -o FILE; the program takes the rest: \
                     `cargo run --release -- render";

/// Renders a chapter to `out/NAME.png` and `out/NAME.exr`; a chapter's `main` is a call of this.
///
/// The command line may set the size, the number of samples and the file; everything else, such as a trace or a view,
/// is the program's business.
/// A failure is printed as one sentence, and the status that `main` returns is 1, or 2 if the command line makes no sense.
pub fn run(chapter: Chapter) -> ExitCode {
    let words: Vec<OsString> = std::env::args_os().skip(1).collect();
    let mut errors = std::io::stderr();
    let status = match parse(&words).map(|wanted| save(&chapter, &wanted)) {
        Ok(Ok(said)) => {
            let _ = writeln!(std::io::stdout(), "{said}");
            return ExitCode::SUCCESS;
        }
        Ok(Err(error)) => {
            let _ = writeln!(errors, "{}: {}", chapter.name, printable_message(&error));
            1
        }
        Err(word) => {
            let word = printable_message(&word.to_string_lossy());
            let _ = writeln!(errors, "{}: `{word}` is not understood: {TAKES} {}`", chapter.name, chapter.name);
            2
        }
    };
    ExitCode::from(status)
}

/// What the command line of an example asks for.
#[derive(Debug, Default, PartialEq)]
struct Wanted {
    overrides: Overrides,
    file: Option<PathBuf>,
}

/// The parsed command line, or the first word that makes no sense.
fn parse(words: &[OsString]) -> std::result::Result<Wanted, &OsString> {
    let mut wanted = Wanted::default();
    for pair in words.chunks(2) {
        let [option, value] = pair else { return Err(&pair[0]) };
        let text = value.to_str().unwrap_or_default();
        match option.to_str().unwrap_or_default() {
            "--size" => {
                let pixels = text.split_once('x').and_then(|(width, height)| {
                    Some(Resolution { width: width.parse().ok()?, height: height.parse().ok()? })
                });
                wanted.overrides.size = Some(Size::Pixels(pixels.ok_or(value)?));
            }
            "--samples" => wanted.overrides.sampling.samples = Some(text.parse().map_err(|_| value)?),
            "-o" => wanted.file = Some(PathBuf::from(value)),
            _ => return Err(option),
        }
    }
    Ok(wanted)
}

/// Renders the chapter, writes its picture, and returns a sentence that says what was done.
fn save(chapter: &Chapter, wanted: &Wanted) -> Result<String> {
    let files = match &wanted.file {
        Some(file) => vec![file.clone()],
        None => ["png", "exr"].each(|ending| Path::new("out").join(format!("{}.{ending}", chapter.name))).to_vec(),
    };
    let scene = chapter.world(&wanted.overrides);
    let rendered = render(&scene, &chapter.stages(), &Execution::default(), &())?;
    let film = &rendered.film;
    for file in &files {
        match file.extension().and_then(|ending| ending.to_str()) {
            Some("png") => write_png(film, rendered.curve(), file)?,
            Some("exr") => write_exr_with(film, None, &rendered.attributes, file)?,
            _ => return Err(Error::Usage(format!("{} must end in .png or .exr", file.display()))),
        }
    }
    let (width, height, seconds) = (film.width, film.height, rendered.time.as_secs_f64());
    let names: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
    Ok(format!("{}: {width} × {height} pixels in {seconds:.2} s", names.join(" and ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(words: &[&str]) -> Option<Wanted> {
        parse(&words.iter().map(OsString::from).collect::<Vec<_>>()).ok()
    }

    #[test]
    fn an_example_takes_a_size_samples_and_a_file() {
        assert_eq!(parsed(&[]), Some(Wanted::default()));
        let wanted = parsed(&["--size", "96x54", "--samples", "4", "-o", "a.png"]).expect("understood");
        assert_eq!(wanted.overrides.size, Some(Size::Pixels(Resolution { width: 96, height: 54 })));
        assert_eq!(wanted.overrides.sampling.samples, Some(4));
        assert_eq!(wanted.file, Some(PathBuf::from("a.png")));
        for words in [&["--size"][..], &["--size", "96"], &["--samples", "-1"], &["trace", "1,2"]] {
            assert_eq!(parsed(words), None, "{words:?}");
        }
    }
}
