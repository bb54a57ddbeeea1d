//! Mistakes that no change of the scene makes: each is put into the program, which is compiled and run, to see whether a
//! picture looks like it.

use super::altered::{WHICH, altered};
use super::program::{program_after, steps};
use pinhole::scene::{FileKind, read_file};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// How long a program may run, and one with a mistake that is tried.
const PATIENCE: Duration = Duration::from_secs(60);
const SHORT: Duration = Duration::from_secs(12);
/// How long small mistakes are tried, one after the other; a reader waits for it.
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

/// The program with fewer samples, which are enough to tell one mistake from another, but where a lamp of some size makes
/// noise.
fn with_few_samples(chapter: u32, program: &str) -> String {
    match chapter {
        17..21 | 30.. => program.replace("SAMPLES: usize = 64;", "SAMPLES: usize = 16;"),
        _ => program.replace("SAMPLES: usize = 16;", "SAMPLES: usize = 4;"),
    }
}

/// The pictures of small mistakes in the lines that a chapter's step brought, and what is said of each; none where there is
/// no compiler.
pub fn altered_pictures(chapter: u32) -> Vec<(String, Picture)> {
    let few = |program: String| program.replace("= 16; // until", "= 2; // until").replace("= 64; //", "= 16; //");
    let Some((compiled, told)) = altered(chapter, few) else { return Vec::new() };
    let began = Instant::now();
    let right = compiled.picture_with(0, SHORT).ok();
    // Some mistakes make it slow, and with some it never ends.
    let patience = (8 * began.elapsed() + Duration::from_millis(200)).min(SHORT);
    let all = told.into_iter().enumerate();
    // Of what changes nothing, nothing is said.
    in_parallel(all, |(at, told)| {
        if began.elapsed() > LONG {
            return None;
        }
        let picture = compiled.picture_with(at + 1, patience).ok()?;
        (Some(&picture) != right.as_ref()).then_some((told, picture))
    })
}

/// What work makes of each, in their order.
fn in_parallel<T, U: Send>(all: impl Iterator<Item = T> + Send, work: impl Fn(T) -> Option<U> + Sync) -> Vec<U> {
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

/// The pictures of all known mistakes that the program of a chapter can have, and what each is; none where there is no
/// compiler.
pub fn known_mistakes(chapter: u32) -> Vec<(String, Picture)> {
    let Ok(program) = program_after(chapter) else { return Vec::new() };
    let program = with_few_samples(chapter, &program);
    let mut all: Vec<(String, String)> = known()
        .filter(|[right, ..]| program.contains(right))
        .map(|[right, wrong, looks_like]| (looks_like, program.replace(&right, &wrong)))
        .collect();
    let before = steps().iter().map(|step| step.number).filter(|&number| number < chapter).max().unwrap_or(1);
    if let Ok(earlier) = program_after(before) {
        all.insert(0, ("it is the picture of your program as it was before this step.".into(), earlier));
    }
    // With some mistakes a path never ends; no reader has a picture of them.
    in_parallel(all.into_iter(), |(looks_like, program)| {
        Some((looks_like, Compiled::of(&program).and_then(|compiled| compiled.picture_within(SHORT)).ok()?))
    })
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
        let words = ["-O", "--edition", "2024", "-A", "warnings", "main.rs", "-o", "program"];
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
        self.picture_in(self.0.path(), patience, None)
    }

    /// The same, with the mistake of a number, in a folder of its own.
    fn picture_with(&self, mistake: usize, patience: Duration) -> Result<Picture, String> {
        let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
        self.picture_in(folder.path(), patience, Some(mistake))
    }

    fn picture_in(&self, folder: &Path, patience: Duration, mistake: Option<usize>) -> Result<Picture, String> {
        let failed = |error: std::io::Error| error.to_string();
        let mut run = Command::new(self.0.path().join("program"));
        let run = run.current_dir(folder).stdout(Stdio::null()).stderr(Stdio::null());
        let run = run.envs(mistake.map(|mistake| (WHICH, mistake.to_string())));
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
        let text = read_file(&folder.join("picture.ppm"), kind).map_err(|told| told.to_string())?;
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
