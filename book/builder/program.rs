//! pinhole's program inside the builder: runs command lines and keeps what they answer.

use std::cell::RefCell;
use std::collections::HashMap;
use std::io::Write;
use std::rc::Rc;

/// Runs one command line and writes what a reader would see; the error is one sentence.
type Run = dyn Fn(&[String], &mut dyn Write) -> Result<(), String>;

/// Answers commands, each only once however many pages ask.
pub struct Program {
    run: Box<Run>,
    answers: HashMap<(String, Option<&'static str>), Result<Rc<[u8]>, String>>,
}

impl Program {
    /// The program of this repository, to be shared by the pages of one build.
    pub fn shared() -> Rc<RefCell<Self>> {
        let chapters = chapters::all();
        Self::with(move |arguments, out| {
            // What is to be known before a render is for whoever waits for it; the pages show what comes of it.
            pinhole_cli::command::run_with_notes(&chapters, arguments, out, &mut std::io::sink())
                .map_err(|error| error.to_string())
        })
    }

    /// A program that answers as the function does.
    pub fn with(run: impl Fn(&[String], &mut dyn Write) -> Result<(), String> + 'static) -> Rc<RefCell<Self>> {
        Rc::new(RefCell::new(Self { run: Box::new(run), answers: HashMap::new() }))
    }

    /// Forgets every answer, so that the next build asks again.
    pub fn forget(&mut self) {
        self.answers.clear();
    }

    /// What the command prints.
    pub fn text(&mut self, command: &str) -> Result<String, String> {
        let printed = self.answer(command, None, |program| program.printed(command))?;
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

    fn printed(&self, command: &str) -> Result<Vec<u8>, String> {
        let words: Vec<String> = command.split_whitespace().map(str::to_owned).collect();
        let mut out = Vec::new();
        let failed = |error: String| format!("`{command}` failed: {}", error.trim_end());
        (self.run)(&words, &mut out).map_err(failed)?;
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
        program.forget();
        assert_eq!(program.text("plan 05"), Ok("plan+05".to_owned()));
        assert_eq!(count.get(), 2);
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
