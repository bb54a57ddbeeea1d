//! Mistakes that no change of the scene makes: each is put into the program, which is compiled and run, to see whether a
//! picture looks like it.

use super::program::{program_after, steps};
use pinhole::scene::{FileKind, read_file};
use std::fs;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// How long a program may run; those that end take up to half a minute, and several times that beside other work.
const PATIENCE: Duration = Duration::from_secs(600);
/// How long one with a known mistake may run.
const LATE: Duration = Duration::from_secs(12);
/// How long mistakes are tried, one after the other; a reader waits for it.
const LONG: Duration = Duration::from_secs(90);

/// The mistakes: after a minus what the right program says, after a plus what a wrong one says, and then what the picture
/// looks like, as the end of a sentence.
const KNOWN: &str = include_str!("known.diff");

/// Each with what the right program says, what a wrong one says, and what the picture looks like.
fn known() -> impl Iterator<Item = [String; 3]> {
    KNOWN.split("\n\n").map(|one| {
        let after = |mark: char| one.lines().filter_map(|line| line.strip_prefix(mark)).collect::<Vec<_>>().join("\n");
        [after('-'), after('+'), one.lines().last().unwrap_or_default().to_owned()]
    })
}

/// A picture of bytes: its width, its height and its pixels.
pub type Picture = ([usize; 2], Vec<[u8; 3]>);

/// A mistake that the program of a chapter can have: what the picture then looks like, and the program with it.
pub struct Known {
    pub looks_like: String,
    pub program: String,
}

/// Those of a chapter's program; the last is that it has not been changed by the chapter's step.
pub fn known_of(chapter: u32) -> Result<Vec<Known>, String> {
    let program = program_after(chapter)?;
    let fitting = known().filter(|[right, ..]| program.contains(right));
    let mut all: Vec<Known> = fitting
        .map(|[right, wrong, looks_like]| Known { looks_like, program: program.replace(&right, &wrong) })
        .collect();
    if let Some(before) = steps().iter().map(|step| step.number).filter(|&number| number < chapter).max() {
        let looks_like = "it is the picture of your program as it was before this step.".into();
        all.push(Known { looks_like, program: program_after(before)? });
    }
    Ok(all)
}

/// The pictures of programs with one pixel of so many in each direction, as [`few`] has it, each with its place among
/// them, as far as they come to an end.
pub fn pictures_of(programs: &[&str], every: usize) -> Vec<(usize, Picture)> {
    let began = Instant::now();
    in_parallel(programs.iter().enumerate(), |(at, program)| {
        let picture = || Compiled::of(&with_few(program, every)).ok()?.picture_within(LATE).ok();
        let picture = if began.elapsed() < LONG { picture() } else { None };
        Some((at, few(&picture?, every)))
    })
}

/// The program without the light of the pixels that are left out, if it has a function that finds that of a pixel.
fn with_few(program: &str, every: usize) -> String {
    const PIXEL: &str = "fn pixel(x: usize, y: usize) -> V {\n";
    let half = every / 2;
    let skips =
        format!("    if x % {every} != {half} || y % {every} != {half} {{\n        return V(0.0, 0.0, 0.0);\n    }}\n");
    program.replace(PIXEL, &format!("{PIXEL}{skips}"))
}

/// A picture with one pixel of so many in each direction, from the middle of the first so many on.
pub fn few(([width, height], pixels): &Picture, every: usize) -> Picture {
    let places = |size: usize| (every / 2..size).step_by(every);
    let own = places(*height).flat_map(|y| places(*width).map(move |x| pixels[y * width + x])).collect();
    ([places(*width).count(), places(*height).count()], own)
}

/// What work makes of each, in their order.
pub fn in_parallel<T, U: Send>(all: impl Iterator<Item = T> + Send, work: impl Fn(T) -> Option<U> + Sync) -> Vec<U> {
    let (all, found) = (Mutex::new(all.enumerate()), Mutex::new(Vec::new()));
    let next = || all.lock().ok()?.next();
    let share = || {
        while let Some((at, one)) = next() {
            if let Some(made) = work(one)
                && let Ok(mut found) = found.lock()
            {
                found.push((at, made));
            }
        }
    };
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| (0..workers).for_each(|_| _ = scope.spawn(share)));
    let mut found = found.into_inner().unwrap_or_default();
    found.sort_by_key(|found| found.0);
    found.into_iter().map(|(_, made)| made).collect()
}

/// Compiles a program as a reader does, runs it, and reads the picture that it wrote.
///
/// Errors: no compiler; what the compiler says; a program that does not end, or ends without a picture.
pub fn picture_of_program(program: &str) -> Result<Picture, String> {
    Compiled::of(program)?.picture()
}

/// A program in a folder of its own.
pub struct Compiled(tempfile::TempDir);

impl Compiled {
    /// Compiles a program as a reader does.
    ///
    /// Errors: no compiler; what the compiler says.
    pub fn of(program: &str) -> Result<Self, String> {
        let failed = |error: std::io::Error| error.to_string();
        let folder = tempfile::tempdir().map_err(failed)?;
        fs::write(folder.path().join("main.rs"), program).map_err(failed)?;
        let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        let words =
            ["-O", "--edition", "2024", "--cap-lints", "allow", "--error-format", "short", "main.rs", "-o", "program"];
        let told = Command::new(compiler).args(words).current_dir(folder.path()).output().map_err(failed)?;
        if told.status.success() { Ok(Self(folder)) } else { Err(String::from_utf8_lossy(&told.stderr).into_owned()) }
    }

    /// Runs it, and reads the picture that it wrote.
    ///
    /// Errors: a program that does not end, or ends without a picture.
    pub fn picture(&self) -> Result<Picture, String> {
        self.picture_within(PATIENCE)
    }

    fn picture_within(&self, patience: Duration) -> Result<Picture, String> {
        let failed = |error: std::io::Error| error.to_string();
        let folder = tempfile::tempdir().map_err(failed)?;
        let mut run = Command::new(self.0.path().join("program"));
        let run = run.current_dir(folder.path()).stdout(Stdio::null()).stderr(Stdio::null());
        let mut run = run.spawn().map_err(failed)?;
        let began = Instant::now();
        while run.try_wait().map_err(failed)?.is_none() {
            if began.elapsed() > patience {
                run.kill().and_then(|()| run.wait()).map_err(failed)?;
                return Err(format!("the program has not ended after {} s", patience.as_secs()));
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        let kind = FileKind { name: "a picture", max: 16 << 20 };
        let text = read_file(&folder.path().join("picture.ppm"), kind).map_err(|told| told.to_string())?;
        picture_in(&String::from_utf8_lossy(&text))
    }
}

/// The picture in a text of the format PPM.
///
/// Errors: what is not so, as the end of a sentence.
pub fn picture_in(text: &str) -> Result<Picture, String> {
    let mut words = text.split_whitespace();
    if words.next() != Some("P3") {
        return Err("it does not begin with P3, as the text of a picture in the format PPM does".into());
    }
    let numbers: Option<Vec<usize>> = words.map(|word| word.parse().ok()).collect();
    match numbers.as_deref() {
        Some([width, height, 255, parts @ ..])
            if width.checked_mul(*height).and_then(|pixels| pixels.checked_mul(3)) == Some(parts.len()) =>
        {
            let byte = |part: usize| u8::try_from(part).map_err(|_| "a number is above 255");
            let pixel = |own: &[usize]| Ok([byte(own[0])?, byte(own[1])?, byte(own[2])?]);
            Ok(([*width, *height], parts.chunks_exact(3).map(pixel).collect::<Result<_, &str>>()?))
        }
        Some(_) => Err("after P3 come width, height, 255 and three numbers for each pixel".into()),
        None => Err("all that follows P3 must be whole numbers".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_known_mistake_can_be_made_in_some_program() {
        let programs: Vec<String> = steps().iter().map(|step| program_after(step.number).expect("applies")).collect();
        let mut count = 0;
        for [right, wrong, looks_like] in known() {
            assert!(programs.iter().any(|program| program.contains(&right)), "{right}");
            assert!(right != wrong && looks_like.ends_with(['.', '?']), "{looks_like}");
            count += 1;
        }
        eprintln!("known mistakes in the reader's program: {count}");
    }
}
