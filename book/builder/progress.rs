//! How far the commands of a build are: a line that counts in a terminal, one now and then in a log.

use std::io::{IsTerminal, Write};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// How often a terminal's line is written anew, and how often a log gets one.
const PACES: [Duration; 2] = [Duration::from_millis(200), Duration::from_secs(10)];

/// The commands of one build: how many there are and are done, and which run now, since when.
pub struct Progress {
    count: usize,
    state: Mutex<(usize, Vec<(Instant, String)>)>,
}

impl Progress {
    /// So many commands, none of them begun.
    pub fn new(count: usize) -> Self {
        Self { count, state: Mutex::default() }
    }

    /// Runs one of the commands.
    pub fn during<T>(&self, command: &str, run: impl FnOnce() -> T) -> T {
        let begun = (Instant::now(), command.to_owned());
        self.with(|(_, running)| running.push(begun.clone()));
        let answer = run();
        self.with(|(done, running)| {
            *done += 1;
            running.retain(|other| *other != begun);
        });
        answer
    }

    fn with<T>(&self, look: impl FnOnce(&mut (usize, Vec<(Instant, String)>)) -> T) -> T {
        look(&mut self.state.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// How far they are, in one line.
    fn line(&self) -> String {
        let (done, longest) = self.with(|(done, running)| (*done, running.iter().min().cloned()));
        let longest = longest.map(|(since, command)| format!(": `{command}`, {} s", since.elapsed().as_secs()));
        format!("{done} of {} commands{}", self.count, longest.unwrap_or_default())
    }

    /// Tells the standard error stream until nobody holds the other end.
    pub fn tell(&self, ended: &Receiver<()>) {
        let mut out = std::io::stderr();
        let is_terminal = out.is_terminal();
        let [begin, end] = if is_terminal { ["\r\x1b[K", ""] } else { ["", "\n"] };
        while let Err(RecvTimeoutError::Timeout) = ended.recv_timeout(PACES[usize::from(!is_terminal)]) {
            let line: String = self.line().chars().take(if is_terminal { 78 } else { usize::MAX }).collect();
            let _ = write!(out, "{begin}{line}{end}").and_then(|()| out.flush());
        }
        let _ = write!(out, "{}", if is_terminal { begin } else { "" });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_counts_and_names_what_takes_longest() {
        let progress = Progress::new(3);
        progress.during("plan 05", || ());
        progress.during("render 25", || {
            progress.during("plan 06", || assert_eq!(progress.line(), "1 of 3 commands: `render 25`, 0 s"));
        });
        assert_eq!(progress.line(), "3 of 3 commands");
    }
}
