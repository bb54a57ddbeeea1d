//! pinhole's program as the reader has it, asked by command lines, its answers kept.

use crate::check::Page;
use crate::check::directive::{Directive, parse};
use crate::check::scan::Scan;
use crate::figure;
use crate::kept::Kept;
use crate::progress::Progress;
use std::cell::RefCell;
use std::collections::HashMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::rc::Rc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, mpsc};
use std::thread;

/// Runs one command line and writes what a reader would see; the error is one sentence.
type Run = dyn Fn(&[String], &mut dyn Write) -> Result<(), String> + Send + Sync;

/// Brings the program up to date with its sources, and finds its answers; the error is one sentence.
type Make = dyn Fn() -> Result<Option<Kept>, String>;

/// Answers commands, each only once however many pages ask.
pub struct Program {
    run: Box<Run>,
    make: Box<Make>,
    place: Option<Arc<Mutex<PathBuf>>>,
    /// How many commands run at once; each gets as many cores as are left for it.
    at_once: Arc<AtomicUsize>,
    answers: HashMap<Question, Result<Rc<[u8]>, String>>,
    /// The answers of earlier builds, where they are kept.
    kept: Option<Kept>,
}

/// A command, its words parted by single spaces, and the ending of the file that it makes, where that is the answer.
type Question = (String, Option<&'static str>);

fn question(command: &str, extension: Option<&'static str>) -> Question {
    (command.split_whitespace().collect::<Vec<_>>().join(" "), extension)
}

/// What is at the place now; nobody who held it can have left it half written.
fn at(place: &Mutex<PathBuf>) -> MutexGuard<'_, PathBuf> {
    place.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Program {
    /// The program of this repository, to be shared by the pages of one build.
    ///
    /// It is the one built for release; once its sources have been edited, the one of the profile for editing, which is
    /// there in seconds.
    /// Errors: cargo's, where the program cannot be compiled.
    pub fn shared(repository: &Path) -> Result<Rc<RefCell<Self>>, String> {
        let top = repository.to_path_buf();
        let kept = kept(&top, "release")?;
        let place = Arc::new(Mutex::new(kept.program()));
        let (asked, at_once) = (Arc::clone(&place), Arc::new(AtomicUsize::new(1)));
        let crowd = Arc::clone(&at_once);
        let program = Self::with(move |words, out| {
            let program = at(&asked).clone();
            ask(&program, (cores() / crowd.load(Ordering::Relaxed)).max(1), words, out)
        });
        let mut own = program.borrow_mut();
        own.at_once = at_once;
        own.place = Some(Arc::clone(&place));
        own.kept = Some(kept);
        own.make = Box::new(move || {
            let kept = self::kept(&top, "edit")?;
            *at(&place) = kept.program();
            Ok(Some(kept))
        });
        drop(own);
        Ok(program)
    }

    /// A program that answers as the function does.
    pub fn with(
        run: impl Fn(&[String], &mut dyn Write) -> Result<(), String> + Send + Sync + 'static,
    ) -> Rc<RefCell<Self>> {
        Rc::new(RefCell::new(Self {
            run: Box::new(run),
            make: Box::new(|| Ok(None)),
            place: None,
            at_once: Arc::default(),
            answers: HashMap::new(),
            kept: None,
        }))
    }

    /// Forgets every answer and compiles what has changed, so that the next build asks again.
    ///
    /// Errors: cargo's, where the program cannot be compiled; the one of before is asked then.
    pub fn renew(&mut self) -> Result<(), String> {
        self.answers.clear();
        self.kept = (self.make)()?;
        Ok(())
    }

    /// Lets go of kept answers that this build did not ask for.
    pub fn let_go(&self) {
        self.kept.iter().for_each(Kept::let_go);
    }

    /// Where the program is, once it is one of this repository.
    pub fn place(&self) -> Option<PathBuf> {
        self.place.as_ref().map(|place| at(place).clone())
    }

    /// Asks all that some pages ask, several commands at once: many have stretches of work for one core alone.
    pub fn ask_for(&mut self, pages: &[Page]) {
        let mut questions: Vec<Question> = pages.iter().flat_map(questions_of).collect();
        questions.retain(|own| !self.answers.contains_key(own));
        // Pictures take longest, and what takes long begins first.
        questions.sort_by(|one, other| (other.1, &one.0).cmp(&(one.1, &other.0)));
        questions.dedup();
        let count = questions.len();
        let (progress, waiting) = (Progress::new(count), Mutex::new(questions.into_iter()));
        let next = || waiting.lock().unwrap_or_else(PoisonError::into_inner).next();
        let asker = Asker { run: &*self.run, kept: self.kept.as_ref() };
        let work = |_ended: mpsc::Sender<()>| {
            let mut answers = Vec::new();
            while let Some((command, extension)) = next() {
                let answer = progress.during(&command, || asker.answer(&command, &words_of(&command), extension));
                answers.push(((command, extension), answer));
            }
            answers
        };
        // A render on one core does as much in the same time as half of one on two, and waits for nobody.
        let workers = cores();
        self.at_once.store(workers, Ordering::Relaxed);
        let answers: Vec<_> = thread::scope(|scope| {
            let (end, ended) = mpsc::channel();
            let work = &work;
            let started = (0..workers).map(|_| end.clone()).map(|end| scope.spawn(move || work(end)));
            let workers: Vec<_> = started.collect();
            drop(end);
            progress.tell(&ended);
            workers.into_iter().filter_map(|worker| worker.join().ok()).flatten().collect()
        });
        self.at_once.store(1, Ordering::Relaxed);
        self.answers.extend(answers.into_iter().map(|(question, answer)| (question, answer.map(Rc::from))));
    }

    /// The values in a chapter's scene that these paths lead to, one a line.
    pub fn values(&mut self, chapter: &str, paths: &[&str]) -> Result<String, String> {
        let mut words = vec!["live".to_owned(), chapter.to_owned()];
        words.extend(paths.iter().flat_map(|path| ["--value".to_owned(), (*path).to_owned()]));
        let command = words.join(" ");
        let printed = self.answer(&command, &words, None)?;
        Ok(String::from_utf8_lossy(&printed).into_owned())
    }

    /// What the command prints.
    pub fn text(&mut self, command: &str) -> Result<String, String> {
        let printed = self.answer(command, &words_of(command), None)?;
        Ok(String::from_utf8_lossy(&printed).trim_end().to_owned())
    }

    /// The file the command makes when it is told where to.
    pub fn file(&mut self, command: &str, extension: &'static str) -> Result<Rc<[u8]>, String> {
        self.answer(command, &words_of(command), Some(extension))
    }

    fn answer(&mut self, command: &str, words: &[String], extension: Option<&'static str>) -> Result<Rc<[u8]>, String> {
        let key = question(command, extension);
        if let Some(known) = self.answers.get(&key) {
            return known.clone();
        }
        let asker = Asker { run: &*self.run, kept: self.kept.as_ref() };
        let answer = asker.answer(&key.0, words, extension).map(Rc::from);
        self.answers.insert(key, answer.clone());
        answer
    }
}

/// What answers a question: an earlier build, or a run.
struct Asker<'a> {
    run: &'a Run,
    kept: Option<&'a Kept>,
}

impl Asker<'_> {
    fn answer(&self, command: &str, words: &[String], extension: Option<&str>) -> Result<Vec<u8>, String> {
        let run = || match extension {
            None => printed(self.run, command, words),
            Some(extension) => made(self.run, command, words, extension),
        };
        let Some(kept) = self.kept else { return run() };
        let (name, known) = kept.find(command, words, extension);
        if let Some(known) = known {
            return Ok(known);
        }
        let answer = run()?;
        kept.keep(&name, &answer);
        Ok(answer)
    }
}

/// What the pages' directives ask.
fn questions_of(page: &Page) -> Vec<Question> {
    let scan = Scan::new(&page.text);
    let of_line = |line: &crate::check::scan::Line<'_>| match parse(line.text)? {
        Ok(Directive::Pinhole { command }) => Some(question(command, None)),
        Ok(Directive::Figure { command, .. }) => Some(question(command, Some(figure::extension(command)))),
        _ => None,
    };
    scan.prose().filter_map(of_line).collect()
}

/// The words of a command as a shell reads them: those within quotes are one.
fn words_of(command: &str) -> Vec<String> {
    shlex::split(command).unwrap_or_else(|| command.split_whitespace().map(str::to_owned).collect())
}

fn printed(run: &Run, command: &str, words: &[String]) -> Result<Vec<u8>, String> {
    let mut out = Vec::new();
    run(words, &mut out).map_err(|error| failed(command, &error))?;
    Ok(out)
}

fn made(run: &Run, command: &str, words: &[String], extension: &str) -> Result<Vec<u8>, String> {
    let folder = tempfile::tempdir().map_err(|error| format!("no temporary folder can be made: {error}."))?;
    let file = folder.path().join(format!("figure.{extension}"));
    let words: Vec<String> = words.iter().cloned().chain(["-o".to_owned(), file.display().to_string()]).collect();
    run(&words, &mut Vec::new()).map_err(|error| failed(command, &error))?;
    std::fs::read(&file).map_err(|_| format!("`{command}` wrote no .{extension} file when told where with `-o`."))
}

fn failed(command: &str, error: &str) -> String {
    format!("`{command}` failed: {}", error.trim_end())
}

/// The program, compiled, and the answers it gave: below the folder that cargo put it into.
fn kept(repository: &Path, profile: &str) -> Result<Kept, String> {
    let program = compiled(repository, profile)?;
    let target = program.ancestors().nth(2).unwrap_or(repository);
    Kept::of(&program, &repository.join("chapters"), &target.join("book"))
}

/// Compiles the program, as `cargo run --profile` does, and says where it is.
fn compiled(repository: &Path, profile: &str) -> Result<PathBuf, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let told = Command::new(&cargo)
        .args(["build", "--profile", profile, "--quiet", "--bin", "pinhole"])
        .args(["--message-format", "json-render-diagnostics"])
        .current_dir(repository)
        .stderr(Stdio::inherit())
        .output()
        .map_err(|error| format!("{} cannot be started: {error}.", Path::new(&cargo).display()))?;
    let place = String::from_utf8_lossy(&told.stdout).lines().rev().find_map(executable);
    let place = place.filter(|_| told.status.success());
    place.ok_or_else(|| format!("pinhole cannot be compiled: `cargo build --profile {profile}` says why."))
}

/// The program that a line of cargo's messages tells of.
fn executable(message: &str) -> Option<PathBuf> {
    let message: serde_json::Value = serde_json::from_str(message).ok()?;
    message["executable"].as_str().map(PathBuf::from)
}

fn cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

/// One command line, as a reader types it, on so many cores; what is to be known before a render is for whoever waits for
/// it.
fn ask(program: &Path, cores: usize, words: &[String], out: &mut dyn Write) -> Result<(), String> {
    let lost = |error: std::io::Error| format!("{} cannot be started: {error}.", program.display());
    let cores = cores.to_string();
    let answer = Command::new(program)
        .args(words)
        .env("RAYON_NUM_THREADS", cores)
        .stdin(Stdio::null())
        .output()
        .map_err(lost)?;
    if !answer.status.success() {
        let said = String::from_utf8_lossy(&answer.stderr);
        let last = said.trim_end().lines().last().unwrap_or("it ended without a word.");
        return Err(last.trim_start_matches("pinhole: ").to_owned());
    }
    out.write_all(&answer.stdout).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::made_up;

    #[test]
    fn a_command_runs_once() {
        let count = Arc::new(AtomicUsize::new(0));
        let counted = Arc::clone(&count);
        let program = Program::with(move |words, out| {
            counted.fetch_add(1, Ordering::SeqCst);
            writeln!(out, "{}\n", words.join("+")).map_err(|error| error.to_string())
        });
        let mut program = program.borrow_mut();
        assert_eq!(program.text("plan 05"), Ok("plan+05".to_owned()));
        assert_eq!(program.text("plan  05"), Ok("plan+05".to_owned()));
        assert_eq!(count.load(Ordering::SeqCst), 1);
        program.ask_for(&[made_up("a.md", "{{#pinhole plan 05}}\n\n{{#pinhole plan 06}}\n\n{{#pinhole  plan 06}}\n")]);
        assert_eq!(program.text("plan 06"), Ok("plan+06".to_owned()));
        assert_eq!(count.load(Ordering::SeqCst), 2);
        assert_eq!(program.renew(), Ok(()));
        assert_eq!(program.text("plan 05"), Ok("plan+05".to_owned()));
        assert_eq!(count.load(Ordering::SeqCst), 3);
    }

    /// What a build made is there for the next one, even if it failed; and the program may go meanwhile.
    #[cfg(unix)]
    #[test]
    fn a_failed_build_keeps_its_answers_and_the_program_may_be_replaced() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let script = folder.path().join("script");
        std::fs::copy("/bin/sh", &script).expect("a program");
        let count = || std::fs::read_to_string(folder.path().join("count")).map_or(0, |text| text.len());
        let line = format!("-c 'printf x >> {}/count; echo $0; exit $1' ", folder.path().display());
        let page =
            |last: &str| made_up("a.md", &format!("{{{{#pinhole {line} one 0}}}}\n\n{{{{#pinhole {line} {last}}}}}\n"));
        for (last, runs, said) in [("two 1", 2, false), ("two 1", 3, false), ("two 0", 4, true), ("two 0", 4, true)] {
            let kept = Kept::of(&script, &folder.path().join("data"), &folder.path().join("shelf")).expect("a shelf");
            let place = kept.program();
            let program = Program::with(move |words, out| ask(&place, 1, words, out));
            let mut program = program.borrow_mut();
            program.kept = Some(kept);
            std::fs::remove_file(&script).expect("cargo removes it");
            program.ask_for(&[page(last)]);
            assert_eq!(program.text(&format!("{line} one 0")), Ok("one".to_owned()));
            assert_eq!(program.text(&format!("{line} {last}")).is_ok(), said, "{last}");
            assert_eq!(count(), runs, "{last}");
            std::fs::copy("/bin/sh", &script).expect("cargo puts it there again");
        }
    }

    #[test]
    fn the_program_is_where_cargo_says() {
        let place = |line| executable(line).map(|path| path.display().to_string());
        assert_eq!(place(r#"{"reason":"compiler-artifact","executable":"/a/pinhole"}"#), Some("/a/pinhole".to_owned()));
        assert_eq!(place(r#"{"reason":"compiler-artifact","executable":null}"#), None);
        assert_eq!(place("no message"), None);
    }

    #[cfg(unix)]
    #[test]
    fn a_process_answers_or_says_in_one_sentence_why_not() {
        let asked = |program: &str, words: &[&str]| {
            let mut out = Vec::new();
            let words: Vec<String> = words.iter().map(|word| (*word).to_owned()).collect();
            ask(Path::new(program), 1, &words, &mut out).map(|()| String::from_utf8_lossy(&out).into_owned())
        };
        assert_eq!(asked("echo", &["a", "b"]), Ok("a b\n".to_owned()));
        let refused = ["-c", "echo 'a note' >&2; echo 'pinhole: there is no chapter 99.' >&2; exit 2"];
        assert_eq!(asked("sh", &refused), Err("there is no chapter 99.".to_owned()));
        assert!(asked("/no/such/program", &[]).is_err_and(|said| said.starts_with("/no/such/program cannot be")));
    }

    #[test]
    fn a_failure_is_one_sentence() {
        let program =
            Program::with(|words, _| if words[0] == "fine" { Ok(()) } else { Err("there is no chapter 99.".into()) });
        let mut program = program.borrow_mut();
        assert_eq!(program.text("plan 99"), Err("`plan 99` failed: there is no chapter 99.".to_owned()));
        let told = program.file("fine x", "png").expect_err("no file");
        assert_eq!(told, "`fine x` wrote no .png file when told where with `-o`.");
    }
}
