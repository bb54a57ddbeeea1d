//! No more than two files of the renderer need one another: a larger circle of imports can only be read whole.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The most files that may import one another in a circle.
const LARGEST: usize = 2;

/// The imports of a file: for each the words of its path, from `crate` or `super` on, one path a leaf.
fn imports(text: &str) -> Vec<Vec<String>> {
    let code = text.split("mod tests {").next().unwrap_or(text);
    let mut found = Vec::new();
    for (at, _) in code.match_indices("use ") {
        let starts_a_line = code[..at].lines().last().is_none_or(|line| ["", "pub "].contains(&line.trim_start()));
        if let (true, Some(end)) = (starts_a_line || code[..at].ends_with('\n'), code[at..].find(';')) {
            leaves(&[], &code[at + 4..at + end], &mut found);
        }
    }
    found
}

/// The leaves of a tree of imports such as `super::{a::B, c::{D, E}}`.
fn leaves(before: &[String], tree: &str, found: &mut Vec<Vec<String>>) {
    let tree = tree.trim();
    let Some((path, group)) = tree.split_once('{') else {
        let path = tree.split(" as ").next().unwrap_or(tree);
        if !path.is_empty() {
            let words = path.split("::").map(|word| word.trim().to_owned());
            found.push(before.iter().cloned().chain(words).collect());
        }
        return;
    };
    let words = path.split("::").map(|word| word.trim().to_owned()).filter(|word| !word.is_empty());
    let before: Vec<String> = before.iter().cloned().chain(words).collect();
    let group = group.trim_end().strip_suffix('}').unwrap_or(group);
    let (mut depth, mut start) = (0, 0);
    for (at, letter) in group.char_indices().chain([(group.len(), ',')]) {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                leaves(&before, &group[start..at], found);
                start = (at + 1).min(group.len());
            }
            _ => {}
        }
    }
}

/// All sources of the renderer by their module's path, such as `extract::camera`; a `mod.rs` has its folder's.
fn modules() -> BTreeMap<String, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/pinhole");
    let mut folders: Vec<PathBuf> = vec![root.clone()];
    let mut found = BTreeMap::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a readable folder") {
            let path = entry.expect("a readable entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                let inside = path.strip_prefix(&root).expect("inside").with_extension("");
                let mut words: Vec<String> = inside.iter().map(|word| word.to_string_lossy().into_owned()).collect();
                words.pop_if(|word| word == "mod");
                found.insert(words.join("::"), fs::read_to_string(path).expect("a readable file"));
            }
        }
    }
    found.retain(|module, _| !module.starts_with("measure") && !["lib", "build"].contains(&module.as_str()));
    found
}

/// The module that a path leads to, through what a `mod.rs` hands on.
fn leads_to(path: &[String], modules: &BTreeMap<String, String>, from: &str) -> Option<String> {
    let mut at: Vec<String> = from.split("::").map(str::to_owned).collect();
    let mut words = path.iter();
    match words.next()?.as_str() {
        "crate" => at.clear(),
        "super" => _ = at.pop(),
        "self" => {}
        first if modules.contains_key(&format!("{from}::{first}")) => at.push(first.to_owned()),
        _ => return None,
    }
    for word in words {
        let (here, next) = (at.join("::"), [at.as_slice(), std::slice::from_ref(word)].concat().join("::"));
        if word == "super" {
            at.pop();
        } else if modules.contains_key(&next) {
            at.push(word.clone());
        } else {
            // A name that this module defines, or one that it hands on.
            let text = modules.get(&here)?;
            let handed_on = imports(text).into_iter().find(|path| path.last() == Some(word) && path.len() > 1);
            return match handed_on {
                Some(path) if text.contains("pub use ") => leads_to(&path, modules, &here).or(Some(here)),
                _ => Some(here),
            };
        }
    }
    Some(at.join("::"))
}

/// The modules that can be reached from one, itself only by a circle.
fn reached<'m>(from: &'m str, arrows: &'m BTreeMap<String, BTreeSet<String>>) -> BTreeSet<&'m str> {
    let (mut found, mut open) = (BTreeSet::new(), vec![from]);
    while let Some(module) = open.pop() {
        for next in arrows.get(module).into_iter().flatten() {
            if found.insert(next.as_str()) {
                open.push(next);
            }
        }
    }
    found
}

#[test]
fn no_more_than_two_files_import_one_another() {
    let modules = modules();
    // What stands in a mod.rs is its folder's table of contents, so arrows end at the files that it names.
    let is_folder = |module: &str| modules.keys().any(|other| other.starts_with(&format!("{module}::")));
    let mut arrows: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (module, text) in modules.iter().filter(|(module, _)| !is_folder(module)) {
        for path in imports(text) {
            if let Some(to) = leads_to(&path, &modules, module).filter(|to| to != module && !is_folder(to)) {
                arrows.entry(module.clone()).or_default().insert(to);
            }
        }
    }
    let count: usize = arrows.values().map(BTreeSet::len).sum();
    assert!(count > 300, "only {count} imports between files were found");
    let mut circles: BTreeSet<BTreeSet<&str>> = BTreeSet::new();
    for module in arrows.keys() {
        let circle: BTreeSet<&str> = reached(module, &arrows)
            .into_iter()
            .filter(|other| reached(other, &arrows).contains(module.as_str()))
            .collect();
        if circle.len() > LARGEST {
            circles.insert(circle);
        }
    }
    assert!(circles.is_empty(), "files that import one another: {circles:#?}");
    eprintln!("circles: {} files, {count} imports, no circle of more than {LARGEST} files", modules.len());
}

#[test]
fn a_circle_through_a_table_of_contents_is_seen() {
    let of = |text: &str| text.to_owned();
    let modules = BTreeMap::from([
        (of("a"), of("mod x;\nmod y;\npub use x::X;\npub use y::{Y, Z};\n")),
        (of("a::x"), of("use super::{Y, inner::Q};\nuse crate::a::Z;\n")),
        (of("a::y"), of("use super::X;\n")),
    ]);
    assert_eq!(imports("use super::{A, b::{C, D as E}};\n").len(), 3);
    let to = |path: &[&str], from: &str| {
        leads_to(&path.iter().map(|word| (*word).to_owned()).collect::<Vec<_>>(), &modules, from)
    };
    assert_eq!(to(&["super", "Y"], "a::x").as_deref(), Some("a::y"));
    assert_eq!(to(&["crate", "a", "Z"], "a::x").as_deref(), Some("a::y"));
    assert_eq!(to(&["super", "X"], "a::y").as_deref(), Some("a::x"));
    assert_eq!(to(&["bevy_ecs", "World"], "a::y"), None);
}
