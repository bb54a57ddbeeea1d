//! pinhole's program as the reader has it, asked by command lines, its answers kept.

use std::cell::RefCell;
use std::collections::HashMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::rc::Rc;

/// Runs one command line and writes what a reader would see; the error is one sentence.
type Run = dyn Fn(&[String], &mut dyn Write) -> Result<(), String>;

/// Brings the program up to date with its sources; the error is one sentence.
type Make = dyn Fn() -> Result<(), String>;

/// Answers commands, each only once however many pages ask.
pub struct Program {
    run: Box<Run>,
    make: Box<Make>,
    place: Option<Rc<RefCell<PathBuf>>>,
    answers: HashMap<(String, Option<&'static str>), Result<Rc<[u8]>, String>>,
}

impl Program {
    /// The program of this repository, to be shared by the pages of one build.
    ///
    /// It is the one built for release; once its sources have been edited, the one of the profile for editing, which is
    /// there in seconds.
    /// Errors: cargo's, where the program cannot be compiled.
    pub fn shared(repository: &Path) -> Result<Rc<RefCell<Self>>, String> {
        let top = repository.to_path_buf();
        let place = Rc::new(RefCell::new(compiled(&top, "release")?));
        let asked = Rc::clone(&place);
        let program = Self::with(move |words, out| ask(&asked.borrow(), words, out));
        program.borrow_mut().place = Some(Rc::clone(&place));
        program.borrow_mut().make = Box::new(move || {
            *place.borrow_mut() = compiled(&top, "edit")?;
            Ok(())
        });
        Ok(program)
    }

    /// A program that answers as the function does.
    pub fn with(run: impl Fn(&[String], &mut dyn Write) -> Result<(), String> + 'static) -> Rc<RefCell<Self>> {
        Rc::new(RefCell::new(Self {
            run: Box::new(run),
            make: Box::new(|| Ok(())),
            place: None,
            answers: HashMap::new(),
        }))
    }

    /// Forgets every answer and compiles what has changed, so that the next build asks again.
    ///
    /// Errors: cargo's, where the program cannot be compiled; the one of before is asked then.
    pub fn renew(&mut self) -> Result<(), String> {
        self.answers.clear();
        (self.make)()
    }

    /// Where the program is, once it is one of this repository.
    pub fn place(&self) -> Option<PathBuf> {
        self.place.as_ref().map(|place| place.borrow().clone())
    }

    /// The values in a chapter's scene that these paths lead to, one a line.
    pub fn values(&mut self, chapter: &str, paths: &[&str]) -> Result<String, String> {
        let mut words = vec!["live".to_owned(), chapter.to_owned()];
        words.extend(paths.iter().flat_map(|path| ["--value".to_owned(), (*path).to_owned()]));
        let command = words.join(" ");
        let printed = self.answer(&command, None, |program| program.printed(&command, &words))?;
        Ok(String::from_utf8_lossy(&printed).into_owned())
    }

    /// What the command prints.
    pub fn text(&mut self, command: &str) -> Result<String, String> {
        let words: Vec<String> = command.split_whitespace().map(str::to_owned).collect();
        let printed = self.answer(command, None, |program| program.printed(command, &words))?;
        Ok(String::from_utf8_lossy(&printed).trim_end().to_owned())
    }

    /// The file the command makes when it is told where to.
    pub fn file(&mut self, command: &str, extension: &'static str) -> Result<Rc<[u8]>, String> {
        self.answer(command, Some(extension), |program| program.made(command, extension))
    }

    fn answer(
        &mut self,
        command: &str,
        extension: Option<&'static str>,
        ask: impl FnOnce(&Self) -> Result<Vec<u8>, String>,
    ) -> Result<Rc<[u8]>, String> {
        let key = (command.split_whitespace().collect::<Vec<_>>().join(" "), extension);
        if let Some(known) = self.answers.get(&key) {
            return known.clone();
        }
        let answer = ask(self).map(Rc::from);
        self.answers.insert(key, answer.clone());
        answer
    }

    fn printed(&self, command: &str, words: &[String]) -> Result<Vec<u8>, String> {
        let mut out = Vec::new();
        let failed = |error: String| format!("`{command}` failed: {}", error.trim_end());
        (self.run)(words, &mut out).map_err(failed)?;
        Ok(out)
    }

    fn made(&self, command: &str, extension: &str) -> Result<Vec<u8>, String> {
        let folder = tempfile::tempdir().map_err(|error| format!("no temporary folder can be made: {error}."))?;
        let file = folder.path().join(format!("figure.{extension}"));
        let mut words: Vec<String> = command.split_whitespace().map(str::to_owned).collect();
        words.extend(["-o".to_owned(), file.display().to_string()]);
        let failed = |error: String| format!("`{command}` failed: {}", error.trim_end());
        (self.run)(&words, &mut Vec::new()).map_err(failed)?;
        std::fs::read(&file).map_err(|_| format!("`{command}` wrote no .{extension} file when told where with `-o`."))
    }
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

/// One command line, as a reader types it; what is to be known before a render is for whoever waits for it.
fn ask(program: &Path, words: &[String], out: &mut dyn Write) -> Result<(), String> {
    let lost = |error: std::io::Error| format!("{} cannot be started: {error}.", program.display());
    let answer = Command::new(program).args(words).stdin(Stdio::null()).output().map_err(lost)?;
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
    use std::cell::Cell;

    #[test]
    fn a_command_runs_once() {
        let count = Rc::new(Cell::new(0));
        let counted = Rc::clone(&count);
        let program = Program::with(move |words, out| {
            counted.set(counted.get() + 1);
            writeln!(out, "{}\n", words.join("+")).map_err(|error| error.to_string())
        });
        let mut program = program.borrow_mut();
        assert_eq!(program.text("plan 05"), Ok("plan+05".to_owned()));
        assert_eq!(program.text("plan  05"), Ok("plan+05".to_owned()));
        assert_eq!(count.get(), 1);
        assert_eq!(program.renew(), Ok(()));
        assert_eq!(program.text("plan 05"), Ok("plan+05".to_owned()));
        assert_eq!(count.get(), 2);
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
            ask(Path::new(program), &words, &mut out).map(|()| String::from_utf8_lossy(&out).into_owned())
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
