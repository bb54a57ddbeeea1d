//! Which mutations there are, in an order that a seed decides.

use super::source::{functions, masked};
use std::fs;
use std::path::Path;

/// Where mutations are looked for: lights, materials, integration, intersection, sampling, film and report.
pub const FOLDERS: &str = "src/pinhole/lights,src/pinhole/material,src/pinhole/shapes,src/pinhole/cameras,\
                       src/pinhole/filters,src/pinhole/shade,src/pinhole/follow,src/pinhole/intersect,\
                       src/pinhole/sample,src/pinhole/rays,src/pinhole/film,src/lab/report";

/// One change to one line of one function.
#[derive(Clone, Debug)]
pub struct Mutation {
    /// The file, from the workspace's root.
    pub file: String,
    pub line: usize,
    /// What is written in place of what.
    pub change: String,
    /// The line as it was, and as it is.
    pub before: String,
    pub after: String,
    /// The function's number in its file.
    pub function: usize,
    /// The bytes that are replaced, in the file, and by what.
    pub from: usize,
    pub to: usize,
    pub by: String,
    /// By which it is switched on; from 3.
    pub number: usize,
}

impl Mutation {
    pub fn place(&self) -> String {
        format!("{}:{}", self.file.trim_start_matches("src/"), self.line)
    }

    pub fn folder(&self) -> &str {
        self.file.rsplit_once('/').map_or("", |(folder, _)| folder)
    }

    /// Whether it only moves what lies exactly on a limit to the other side.
    pub fn is_boundary(&self) -> bool {
        ["< → <=", "<= → <", "> → >=", ">= → >"].contains(&self.change.as_str())
    }
}

/// What is replaced by what, wherever it stands in code.
const EXCHANGES: &[(&str, &str)] = &[
    (" + ", " - "),
    (" - ", " + "),
    (" * ", " / "),
    (" / ", " * "),
    (" += ", " -= "),
    (" *= ", " /= "),
    (" < ", " <= "),
    (" <= ", " < "),
    (" > ", " >= "),
    (" >= ", " > "),
    (" < ", " > "),
    (" > ", " < "),
    (" == ", " != "),
    (" != ", " == "),
    (" && ", " || "),
    (" || ", " && "),
    (".min(", ".max("),
    (".max(", ".min("),
    ("::sin(", "::cos("),
    ("::cos(", "::sin("),
    (".sqrt()", ""),
    (".abs()", ""),
    (".normalize()", ""),
    ("1.0 - ", ""),
    ("true", "false"),
    ("false", "true"),
    ("INFINITY", "MAX"),
    (".transpose()", ""),
    (".max(0.0)", ""),
];

fn is_word(byte: Option<&u8>) -> bool {
    byte.is_some_and(|byte| byte.is_ascii_alphanumeric() || *byte == b'_')
}

/// All mutations of the files below these folders, shuffled, no two of the first round in one function.
pub fn candidates(root: &Path, folders: &[String], seed: u64) -> Vec<Mutation> {
    let mut files = Vec::new();
    folders.iter().for_each(|folder| files_below(root, folder, &mut files));
    files.sort();
    let mut all: Vec<Vec<Mutation>> = files.iter().flat_map(|file| of_file(root, file)).collect();
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut below = |count: usize| {
        // SplitMix64 (Steele, Lea and Flood 2014).
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % count.max(1) as u64) as usize
    };
    let mut ordered = Vec::new();
    while !all.is_empty() {
        // One of each function in turn, functions in a new order each round.
        for at in (1..all.len()).rev() {
            all.swap(at, below(at + 1));
        }
        for of_function in &mut all {
            let chosen = below(of_function.len());
            ordered.push(of_function.swap_remove(chosen));
        }
        all.retain(|of_function| !of_function.is_empty());
    }
    ordered
}

fn files_below(root: &Path, folder: &str, files: &mut Vec<String>) {
    let Ok(entries) = fs::read_dir(root.join(folder)) else { return };
    for entry in entries.flatten() {
        let name = format!("{folder}/{}", entry.file_name().to_string_lossy());
        if entry.path().is_dir() {
            files_below(root, &name, files);
        } else if name.ends_with(".rs") {
            files.push(name);
        }
    }
}

/// The mutations of a file, function by function.
fn of_file(root: &Path, file: &str) -> Vec<Vec<Mutation>> {
    let source = fs::read_to_string(root.join(file)).expect("a source file");
    let code = masked(&source);
    let of_function = |(function, of): (usize, super::source::Function)| {
        let mut found = Vec::new();
        let mut add = |from: usize, to: usize, by: String| {
            let start = source[..from].rfind('\n').map_or(0, |at| at + 1);
            let end = source[to..].find('\n').map_or(source.len(), |at| to + at);
            let spelled = |text: &str| text.trim().to_string();
            let (old, new) = (spelled(&source[from..to]), spelled(&by));
            found.push(Mutation {
                file: file.into(),
                line: source[..from].matches('\n').count() + 1,
                change: format!("{old} → {}", if new.is_empty() { "nothing" } else { &new }),
                before: spelled(&source[start..end]),
                after: spelled(&format!("{}{by}{}", &source[start..from], &source[to..end])),
                function,
                from,
                to,
                by,
                number: 0,
            });
        };
        for at in of.body.clone() {
            for (old, new) in EXCHANGES {
                let word = old.as_bytes()[0].is_ascii_alphanumeric();
                let inside = word && (is_word(code.get(at.wrapping_sub(1))) || is_word(code.get(at + old.len())));
                if code[at..].starts_with(old.as_bytes()) && !inside {
                    add(at, at + old.len(), (*new).into());
                }
            }
            for (old, new) in [(".x", ".y"), (".y", ".z"), (".z", ".x"), ("[0]", "[1]"), ("[1]", "[0]"), ("[2]", "[1]")]
            {
                let ends = !is_word(code.get(at + 2)) || old.starts_with('[');
                if code[at..].starts_with(old.as_bytes()) && ends && (is_word(code.get(at.wrapping_sub(1)))) {
                    add(at, at + old.len(), new.into());
                }
            }
            if let Some(length) = float_at(&code, at) {
                let value: f64 = source[at..at + length].parse().unwrap_or(0.0);
                add(at, at + length, format!("{:?}", if value == 0.0 { 1.0 } else { 2.0 * value }));
            }
            if let Some(length) = factor_at(&code, at) {
                add(at, at + length, String::new());
            }
            // A sign or a negation dropped: after a bracket, a comma or an equals sign.
            let before = code[..at].iter().rev().find(|byte| **byte != b' ').copied().unwrap_or(b' ');
            let drops = matches!(code[at], b'-' | b'!') && b"(,={|&:".contains(&before);
            if drops && code.get(at + 1).is_some_and(|next| next.is_ascii_alphanumeric() || *next == b'(') {
                add(at, at + 1, String::new());
            }
        }
        found
    };
    let found = functions(&code).into_iter().enumerate().map(of_function);
    found.filter(|of_function| !of_function.is_empty()).collect()
}

/// The length of a number such as 0.5 that begins here.
fn float_at(code: &[u8], at: usize) -> Option<usize> {
    let before = at.checked_sub(1).and_then(|before| code.get(before));
    if !code[at].is_ascii_digit() || is_word(before) || before == Some(&b'.') {
        return None;
    }
    let length = code[at..].iter().take_while(|byte| byte.is_ascii_digit() || **byte == b'.').count();
    let text = &code[at..at + length];
    let dots = text.iter().filter(|byte| **byte == b'.').count();
    (dots == 1 && text.last() != Some(&b'.') && !is_word(code.get(at + length))).then_some(length)
}

/// The length of a factor, ` * name`, that begins here and ends a product.
fn factor_at(code: &[u8], at: usize) -> Option<usize> {
    if !code[at..].starts_with(b" * ") {
        return None;
    }
    let name = code[at + 3..].iter().take_while(|byte| is_word(Some(byte)) || b".:".contains(byte)).count();
    let after = code.get(at + 3 + name)?;
    (name > 0 && b" ,;)]\n".contains(after)).then_some(3 + name)
}
