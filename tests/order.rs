//! The house is in order: each folder of `src/` names only those before it, and no file does what the house forbids.

use std::fs;
use std::path::{Path, PathBuf};

/// The packages of `src/`, and the folders and files of each in the order of the data; each may name itself and those
/// before it. What a package may name of another, cargo holds.
///
/// `error` is what everyone answers, so it is named by its types from everywhere; it names the first two.
const ORDER: &[(&str, &[&str])] = &[
    (
        "pinhole",
        &[
            "each",
            "scene",
            "plan",
            "check",
            "filters",
            "sample",
            "material",
            "cameras",
            "bvh",
            "shapes",
            "lights",
            "extract",
            "rays",
            "intersect",
            "rasterise",
            "shade",
            "follow",
            "film",
            "render",
            "look",
            "stages",
            "chapter",
            "example",
            "prelude",
            "extend",
        ],
    ),
    ("scene", &[]),
    (
        "models",
        &[
            "printable",
            "model_error",
            "open",
            "number",
            "memory",
            "remarks",
            "centre",
            "colour",
            "polygon",
            "model_material",
            "triangle_mesh",
            "model",
            "ply",
            "obj",
            "gltf",
            "read",
            "written",
        ],
    ),
    ("lab", &["png_url", "repository", "naive", "measure", "figure", "review", "report", "exercise", "yours"]),
    ("live", &["answer", "guard", "peer", "http", "view"]),
    ("", &["exercises", "checks", "figures", "command"]),
];

/// What every folder may name at the crate's root.
const ROOT: [&str; 3] = ["Error", "Result", "named"];

/// What stands at the root and belongs to a folder further down.
const REEXPORTED: [(&str, &str); 14] = [
    ("Chapter", "chapter"),
    ("Overrides", "chapter"),
    ("SamplingOverrides", "chapter"),
    ("Size", "chapter"),
    ("column", "plan"),
    ("light_names", "lights"),
    ("named_bsdf", "material"),
    ("shape_names", "shapes"),
    ("column_component", "plan"),
    ("part_names", "plan"),
    ("with_filter", "filters"),
    ("with_sampler", "sample"),
    ("render_scene", "chapter"),
    ("run", "example"),
];

/// The longest file.
const LONGEST: usize = 800;

struct Source {
    /// The folder of `src/` that the package is; none for the program's.
    package: &'static str,
    /// Within the package.
    path: PathBuf,
    /// The folder, or the file's stem where it lies in the package itself.
    folder: String,
    text: String,
}

fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    let mut folders = vec![root.clone()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a readable folder") {
            let path = entry.expect("a readable entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                let packages = ORDER.iter().map(|(package, _)| *package);
                let package = packages.clone().find(|package| path.starts_with(root.join(package))).expect("the last");
                let inside = path.strip_prefix(root.join(package)).expect("inside the package");
                let first = inside.components().next().expect("a name").as_os_str();
                let folder = Path::new(first).file_stem().expect("a stem").to_string_lossy().into_owned();
                let text = fs::read_to_string(&path).expect("a readable file");
                found.push(Source { package, path: inside.to_path_buf(), folder, text });
            }
        }
    }
    found.sort_by(|a, b| a.path.cmp(&b.path));
    found
}

/// The first words after every `crate::`, with those in braces one by one.
fn named_in(text: &str) -> Vec<String> {
    let mut names = Vec::new();
    for (at, _) in text.match_indices("crate::") {
        let before = text[..at].chars().next_back();
        if before.is_some_and(|before| before.is_alphanumeric() || before == '_') {
            continue;
        }
        let rest = &text[at + "crate::".len()..];
        match rest.strip_prefix('{') {
            Some(group) => names.extend(first_words(group)),
            None => names.push(word(rest)),
        }
    }
    names
}

/// The first word of each entry of a group of imports, up to the brace that closes it.
fn first_words(group: &str) -> Vec<String> {
    let (mut depth, mut start) = (0, 0);
    let mut words = Vec::new();
    for (at, letter) in group.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' if depth == 0 => {
                words.push(word(&group[start..at]));
                break;
            }
            '}' => depth -= 1,
            ',' if depth == 0 => {
                words.push(word(&group[start..at]));
                start = at + 1;
            }
            _ => {}
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

fn word(text: &str) -> String {
    text.trim_start().chars().take_while(|letter| letter.is_alphanumeric() || *letter == '_').collect()
}

fn place(package: &str, folder: &str) -> Option<usize> {
    let (_, order) = ORDER.iter().find(|(own, _)| *own == package)?;
    order.iter().position(|own| *own == folder)
}

/// A file without its unit tests, which may be checked by what comes later, such as the oracles of `measure`.
fn before_tests(text: &str) -> &str {
    text.split("#[cfg(test)]\nmod ").next().unwrap_or(text)
}

/// What a file may not name, and why.
fn misplaced(source: &Source) -> Vec<String> {
    let own = match source.folder.as_str() {
        "lib" | "main" | "build" => return Vec::new(),
        "measure" if source.package == "pinhole" => return Vec::new(), // the laboratory's, for unit tests only
        "error" => place(source.package, "extract"),
        _ if source.package == "scene" => return Vec::new(), // one folder, which has a package of its own
        folder => place(source.package, folder),
    };
    let Some(own) = own else { return vec![format!("{} has no place in the order", source.path.display())] };
    let mut wrong = Vec::new();
    for name in named_in(before_tests(&source.text)) {
        if ROOT.contains(&name.as_str()) {
            continue;
        }
        let folder = REEXPORTED.iter().find(|(word, _)| *word == name).map_or(name.as_str(), |(_, folder)| folder);
        match place(source.package, folder) {
            Some(other) if other <= own => {}
            Some(_) => wrong.push(format!("{} names {folder}, which comes later", source.path.display())),
            None => wrong.push(format!("{} names crate::{name}, which has no place", source.path.display())),
        }
    }
    wrong
}

#[test]
fn each_folder_names_only_those_before_it() {
    let sources = sources();
    let wrong: Vec<String> = sources.iter().flat_map(misplaced).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let paths: usize = sources.iter().map(|source| named_in(&source.text).len()).sum();
    assert!(paths > 100, "only {paths} paths were found");
    eprintln!("order: {} files, {paths} paths from the crate's root", sources.len());
}

/// `super` must not be a way round: it stays within the folder.
#[test]
fn no_folder_is_left_by_super() {
    for source in sources() {
        if source.package == "scene" {
            continue;
        }
        let nested = source.path.components().count() - 1;
        let is_mod = source.path.ends_with("mod.rs");
        let code = before_tests(&source.text);
        let levels = if is_mod { nested.saturating_sub(1) } else { nested };
        let steps = "super::".repeat(levels + 1);
        assert!(!code.contains(&steps), "{} leaves its folder by {steps}", source.path.display());
    }
}

#[test]
fn the_parser_sees_every_way_to_name_a_folder() {
    let text = "use crate::scene::{A, B};\nuse crate::{Error, plan::{C, D}, film};\nlet x = <crate::look::T as U>::f();\
                \n$crate::rays::Column; mycrate::shade::x";
    assert_eq!(named_in(text), ["scene", "Error", "plan", "film", "look", "rays"]);
    let bad = |folder: &str, text: &str| {
        let source = Source { package: "pinhole", path: "x.rs".into(), folder: folder.into(), text: text.into() };
        misplaced(&source).len()
    };
    assert_eq!(bad("rays", "use crate::{Error, film::Film};"), 1);
    assert_eq!(bad("film", "use crate::{Error, rays::Tile};"), 0);
    assert_eq!(bad("look", "use crate::Chapter;"), 1);
    assert_eq!(bad("rays", "#[cfg(test)]\nmod tests { use crate::film::Film; }"), 0);
    assert_eq!(bad("utils", ""), 1);
}

#[test]
fn each_library_lists_its_modules_in_that_order() {
    let sources = sources();
    for (package, order) in ORDER.iter().filter(|(package, _)| ["pinhole", "lab"].contains(package)) {
        let own = || sources.iter().filter(|source| source.package == *package);
        let lib = own().find(|source| source.folder == "lib").expect("lib.rs");
        let listed: Vec<&str> = lib
            .text
            .lines()
            .filter_map(|line| {
                let module =
                    line.strip_prefix("pub mod ").or_else(|| line.strip_prefix("pub extern crate pinhole_scene as "));
                module.and_then(|rest| rest.strip_suffix(';'))
            })
            .collect();
        let places: Vec<usize> =
            listed.iter().map(|name| place(package, name).unwrap_or_else(|| panic!("{name} has no place"))).collect();
        assert!(places.windows(2).all(|pair| pair[0] < pair[1]), "lib.rs lists {listed:?}, the order is {order:?}");
        assert!(listed.len() >= 5, "only {listed:?}");
        let told: Vec<&str> =
            lib.text.lines().filter_map(|line| line.split(". [`").nth(1)?.split("`]").next()).collect();
        assert_eq!(told, listed, "the list that lib.rs tells in words");
        eprintln!("{package}: {listed:?}");
    }
}

/// The code of a file without its comments: what is said there is not done.
fn code(text: &str) -> String {
    text.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n")
}

/// A name may lead to a pipe, a device or a bomb, so there is one door that looks first; what is there for tests, what the
/// system itself keeps under `/proc`, and folders need none.
#[test]
fn every_file_is_opened_through_one_door() {
    let openers = [
        "File::open(",
        "fs::read(",
        "read_to_string(",
        "ImageReader::open(",
        "from_file(",
        "read_from_file(",
        "File::options(",
    ];
    let exempt = [
        ("scene/open_file.rs", "OpenOptions::new("),
        ("scene/memory.rs", "read_to_string("),
        ("pinhole/render/memory.rs", "read_to_string("),
        ("lab/report/provenance.rs", "read_to_string("),
        ("pinhole/film/whole_file.rs", "File::open(folder_of("),
        ("pinhole/film/replaces.rs", "OpenOptions::new("),
        ("live/peer.rs", "read_to_string("),
    ];
    let mut wrong = Vec::new();
    for source in sources() {
        let path = Path::new(source.package).join(&source.path).to_string_lossy().replace('\\', "/");
        let mut code = code(before_tests(&source.text));
        for (_, allowed) in exempt.iter().filter(|(own, _)| *own == path) {
            assert!(code.contains(allowed), "{path} needs no exemption for {allowed}");
            code = code.replace(allowed, "");
        }
        let is_word = |letter: char| letter.is_alphanumeric() || letter == '_';
        let calls = |opener: &str| code.match_indices(opener).any(|(at, _)| !code[..at].ends_with(is_word));
        let found = openers.iter().chain(&["OpenOptions::new("]).filter(|opener| calls(opener));
        wrong.extend(
            found.map(|opener| format!("{path} calls {opener}, where open_file or read_file would look first")),
        );
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn no_drawer_for_everything_and_nothing_unfinished() {
    let mut longest = (0, PathBuf::new());
    for source in sources() {
        let shown = source.path.display();
        for part in source.path.iter().filter_map(|part| Path::new(part).file_stem()) {
            let part = part.to_string_lossy();
            let drawer = ["utils", "util", "common", "helpers", "helper", "core", "misc"].contains(&part.as_ref());
            assert!(!drawer, "{shown} is a drawer for everything");
        }
        for word in ["todo!", "unimplemented!", "FIXME", "TODO", "XXX"] {
            assert!(!source.text.contains(word), "{shown} holds {word}");
        }
        for module in ["utils", "common", "helpers", "core"] {
            assert!(!code(&source.text).contains(&format!("mod {module}")), "{shown} has a module {module}");
        }
        let lines = source.text.lines().count();
        assert!(lines <= LONGEST, "{shown} has {lines} lines, more than {LONGEST}");
        longest = longest.max((lines, source.path.clone()));
    }
    eprintln!("lengths: the longest is {} with {} lines", longest.1.display(), longest.0);
}
