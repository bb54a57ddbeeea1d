//! Mistakes that no change of the scene makes: each is put into the program, which is compiled and run, to see whether a
//! picture looks like it.

use super::altered::small_mistakes;
use super::joined::{Mistake, WHICH, joined};
use super::program::{program_after, steps};
use pinhole::scene::{FileKind, read_file};
use std::fs;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// How long a program may run.
const PATIENCE: Duration = Duration::from_secs(60);
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

/// Programs that each make one mistake: all that fit are one program, which is told which of them to make.
pub struct Mistaken {
    joined: Compiled,
    apart: Vec<Compiled>,
    /// What is said of each; of the small ones that nobody wrote down, with the line in which it is.
    pub told: Vec<(String, Option<usize>)>,
}

impl Mistaken {
    /// Those that the program of a chapter can have, known ones first; none where there is no compiler.
    pub fn after(chapter: u32) -> Option<Self> {
        let program = program_after(chapter).ok()?;
        let before = steps().iter().map(|step| step.number).filter(|&number| number < chapter).max();
        let before = before.and_then(|number| program_after(number).ok());
        let (mut within, mut beside): (Vec<Mistake>, Vec<(String, String)>) = (Vec::new(), Vec::new());
        for [right, wrong, looks_like] in known().filter(|[right, ..]| program.contains(right)) {
            match Mistake::of_text(&program, (&right, &wrong), &looks_like) {
                Some(mistake) => within.push(mistake),
                None => beside.push((looks_like, program.replace(&right, &wrong))),
            }
        }
        if let Some(before) = &before {
            beside.push(("it is the picture of your program as it was before this step.".into(), before.clone()));
        }
        let count = within.len();
        within.extend(small_mistakes(&program, &before.unwrap_or_default()));
        let known: Vec<String> = within[..count].iter().map(|mistake| mistake.told.clone()).collect();
        let (joined_program, within) = joined(&program, within)?;
        let mut told: Vec<(String, Option<usize>)> = Vec::new();
        for mistake in within {
            let line = mistake.changes.first().map(|(at, _)| at.start).filter(|_| !known.contains(&mistake.told));
            told.push((mistake.told, line));
        }
        let mut apart = Vec::new();
        for (looks_like, program) in beside {
            if let Some((compiled, _)) = joined(&program, Vec::new()) {
                apart.push(compiled);
                told.push((looks_like, None));
            }
        }
        Some(Self { joined: joined_program, apart, told })
    }

    /// The right program's picture with one pixel of so many in each direction, as [`few`] has it.
    pub fn right(&self, every: usize) -> Option<Picture> {
        self.joined.picture_with([0, every], PATIENCE).ok()
    }

    /// The pictures of these mistakes, as [`Self::right`] has it, where the program comes to an end.
    pub fn pictures(&self, of: &[usize], every: usize, patience: Duration) -> Vec<(usize, Picture)> {
        let began = Instant::now();
        in_parallel(of.iter().copied(), |mistake| {
            if began.elapsed() > LONG {
                return None;
            }
            let inside = self.told.len() - self.apart.len();
            let (program, number) = match mistake.checked_sub(inside) {
                Some(at) => (&self.apart[at], 0),
                None => (&self.joined, mistake + 1),
            };
            Some((mistake, program.picture_with([number, every], patience).ok()?))
        })
    }
}

/// A picture with one pixel of so many in each direction, from the middle of the first so many on.
pub fn few(([width, height], pixels): &Picture, every: usize) -> Picture {
    let places = |size: usize| (every / 2..size).step_by(every);
    let own = places(*height).flat_map(|y| places(*width).map(move |x| pixels[y * width + x])).collect();
    ([places(*width).count(), places(*height).count()], own)
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
        self.picture_with([0, 1], PATIENCE)
    }

    /// The same, where it is told which mistake to make, and of how many pixels to render one.
    fn picture_with(&self, which: [usize; 2], patience: Duration) -> Result<Picture, String> {
        let failed = |error: std::io::Error| error.to_string();
        let folder = tempfile::tempdir().map_err(failed)?;
        let mut run = Command::new(self.0.path().join("program"));
        let run = run.current_dir(folder.path()).stdout(Stdio::null()).stderr(Stdio::null());
        let run = run.envs(WHICH.into_iter().zip(which.map(|number| number.to_string())));
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
