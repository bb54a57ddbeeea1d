//! Hands the renderer a hash of its own code: a checkpoint written by another program must not be continued, because its
//! samples were taken by other code.
//!
//! The code counts, and not its text: comments, documentation, unit tests and line breaks make no other
//! program. The hash is FNV-1a, so that it does not depend on the compiler either.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let package = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let (scene, lock) = (package.join("../scene"), package.join("../../Cargo.lock"));
    let mut out = io::stdout();
    for watched in [&package, &scene, &lock] {
        io::Write::write_all(&mut out, format!("cargo::rerun-if-changed={}\n", watched.display()).as_bytes())?;
    }
    let hash = hash_of(&[&package, &scene], &lock)?;
    io::Write::write_all(&mut out, format!("cargo::rustc-env=PINHOLE_SOURCES={hash}\n").as_bytes())
}

/// A hash of the code of all sources below some folders, and of the versions that the lock file names, if there is one.
///
/// The same sources make the same program wherever they are checked out, so the folder does not count.
pub fn hash_of(packages: &[&Path], lock: &Path) -> io::Result<String> {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut add = |text: &str| {
        text.bytes().for_each(|byte| hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3));
    };
    if lock.exists() {
        add(&fs::read_to_string(lock)?.replace("\r\n", "\n"));
    }
    let mut files = Vec::new();
    for package in packages {
        let mut own = Vec::new();
        list(package, &mut own)?;
        files.extend(own.into_iter().map(|file| (*package, file)));
    }
    for (package, file) in files {
        add(&file.strip_prefix(package).unwrap_or(&file).to_string_lossy().replace('\\', "/"));
        let text = fs::read_to_string(&file)?;
        match text.parse::<TokenStream>() {
            Ok(tokens) => add_code(tokens, &mut add),
            // The compiler says better what is wrong with it.
            Err(_) => add(&text),
        }
    }
    Ok(format!("{hash:016x}"))
}

/// The tokens of a source but its documentation and what is compiled for tests alone.
fn add_code(tokens: TokenStream, add: &mut dyn FnMut(&str)) {
    let mut tokens = tokens.into_iter().peekable();
    while let Some(token) = tokens.next() {
        let is_hash = matches!(&token, TokenTree::Punct(punct) if punct.as_char() == '#');
        // The exclamation mark of an attribute that stands within what it is about.
        let inner =
            is_hash && tokens.next_if(|next| matches!(next, TokenTree::Punct(mark) if mark.as_char() == '!')).is_some();
        let attribute = match tokens.peek() {
            Some(TokenTree::Group(group)) if is_hash && group.delimiter() == Delimiter::Bracket => {
                group.stream().to_string().replace(' ', "")
            }
            _ => String::new(),
        };
        if attribute.starts_with("doc=") {
            tokens.next();
        } else if attribute == "cfg(test)" && !inner {
            // An item ends with its braces or with a semicolon.
            let ends = |token: &TokenTree| match token {
                TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
                TokenTree::Punct(punct) => punct.as_char() == ';',
                _ => false,
            };
            tokens.by_ref().find(ends);
        } else if let TokenTree::Group(group) = token {
            add(match group.delimiter() {
                Delimiter::Parenthesis => "(",
                Delimiter::Brace => "{",
                Delimiter::Bracket => "[",
                Delimiter::None => "",
            });
            add_code(group.stream(), add);
            add(")");
        } else {
            add(&token.to_string());
            add(" ");
        }
    }
}

/// Collects the sources of a folder and of its subfolders, sorted by name.
fn list(folder: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    let mut entries = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>()?;
    entries.sort();
    for entry in entries {
        if entry.is_dir() {
            list(&entry, files)?;
        } else if entry.extension().is_some_and(|ending| ending == "rs") {
            files.push(entry);
        }
    }
    Ok(())
}
