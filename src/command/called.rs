//! What a reader typed to start the program, so that hints can be typed the same way.

use super::visible::is_hidden;
use std::ffi::OsStr;
use std::path::Path;
use std::sync::OnceLock;

/// How the book and the README start the program.
const BY_CARGO: &str = "cargo run --release --";
/// How the program of `cargo test` is started, which is there as soon as the tests are.
const DEBUG_BY_CARGO: &str = "cargo run --";

static CALLED: OnceLock<String> = OnceLock::new();

/// A command line of this program, as the one who started it would type it.
pub fn called(words: &str) -> String {
    let program = CALLED.get().map_or(BY_CARGO, String::as_str);
    if words.is_empty() { program.into() } else { format!("{program} {words}") }
}

/// Remembers how this program was started.
pub fn remember() {
    let started = std::env::args_os().next().unwrap_or_default();
    let exe = std::env::current_exe().unwrap_or_default();
    let _ = CALLED.set(name(std::env::var_os("CARGO").is_some(), &exe, &started));
}

/// Cargo sets `CARGO` for what it runs, and every other program inherits it, so the place of the program counts as well.
fn name(cargo: bool, exe: &Path, started: &OsStr) -> String {
    let is_in = |profile: &str| exe.ancestors().skip(1).take(2).filter_map(Path::file_name).any(|own| own == profile);
    if cargo && is_in("release") {
        return BY_CARGO.into();
    }
    if cargo && is_in("debug") {
        return DEBUG_BY_CARGO.into();
    }
    let file = Path::new(started).file_name().map(OsStr::to_string_lossy);
    file.map_or_else(|| "pinhole".into(), |file| quoted(&file))
}

/// A word that a shell takes as it stands.
pub fn quoted(word: &str) -> String {
    let word: String = word.chars().filter(|letter| !is_hidden(*letter)).collect();
    shlex::try_quote(&word).map_or_else(|_| String::new(), |quoted| quoted.into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_program_is_called_as_it_was_started() {
        let of = |cargo: bool, exe: &str, started: &str| name(cargo, Path::new(exe), started.as_ref());
        assert_eq!(of(true, "/a/target/release/pinhole", "target/release/pinhole"), BY_CARGO);
        assert_eq!(of(true, "/a/b/debug/pinhole", "b/debug/pinhole"), DEBUG_BY_CARGO);
        assert_eq!(of(false, "/a/target/release/pinhole", "target/release/pinhole"), "pinhole");
        assert_eq!(of(true, "/home/a/.cargo/bin/pinhole", "pinhole"), "pinhole");
        assert_eq!(of(false, "/usr/bin/rays", "/usr/bin/rays"), "rays");
        assert_eq!(of(false, "", ""), "pinhole");
    }

    #[test]
    fn a_shell_takes_a_quoted_word_as_it_stands() {
        for word in
            ["a b.ron", "$(touch x).ron", "`touch x`.ron", "a;b.ron", "it's.ron", "wow!.ron", "a\"b.ron", "*.ron"]
        {
            let quoted = quoted(word);
            assert_eq!(shlex::split(&quoted), Some(vec![word.to_string()]), "{quoted}");
            assert_ne!(quoted, word);
        }
        assert_eq!(quoted("scenes/room.ron"), "scenes/room.ron");
    }
}
