//! What a reader sees on the first day: the Rust that is asked for, and commands that compile nothing a second time.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn cargo(words: &[&str]) -> String {
    let told = Command::new(env!("CARGO")).current_dir(repository()).args(words).output().expect("cargo starts");
    assert!(told.status.success(), "cargo {words:?}: {}", String::from_utf8_lossy(&told.stderr));
    String::from_utf8(told.stdout).expect("UTF-8")
}

/// The version that the manifests name, which cargo checks, and the README and the book say, is the greatest that any
/// package asks for. Those of the book are asked as well, which on a new machine nothing has downloaded yet.
#[test]
fn the_rust_that_is_asked_for_is_the_rust_that_is_needed() {
    let rustc = Command::new("rustc").arg("-vV").output().expect("rustc starts");
    let told = String::from_utf8(rustc.stdout).expect("UTF-8");
    let host = told.lines().find_map(|line| line.strip_prefix("host: ")).expect("a host");
    let words = ["metadata", "--locked", "--format-version", "1", "--filter-platform", host];
    let metadata: serde_json::Value = serde_json::from_str(&cargo(&words)).expect("JSON");
    let used = |id: &serde_json::Value| {
        metadata["resolve"]["nodes"].as_array().expect("nodes").iter().any(|node| node["id"] == *id)
    };
    let packages = metadata["packages"].as_array().expect("packages");
    let parts =
        |version: &str| -> Vec<u32> { version.split('.').map(|part| part.parse().expect("a number")).collect() };
    let (mut named, mut needed) = (BTreeSet::new(), (vec![0], String::new()));
    for package in packages.iter().filter(|package| used(&package["id"])) {
        let Some(version) = package["rust_version"].as_str() else { continue };
        if package["source"].is_null() {
            named.insert(version.to_owned());
        } else if parts(version)[..2] > needed.0[..] {
            needed = (parts(version)[..2].to_vec(), package["name"].to_string());
        }
    }
    let version = named.first().expect("a version").clone();
    assert_eq!(named.len(), 1, "{named:?}");
    assert_eq!(parts(&version), needed.0, "{} asks for {:?}", needed.1, needed.0);
    for file in ["README.md", "book/src/cover.md", "book/src/teaching.md"] {
        let text = fs::read_to_string(repository().join(file)).expect("kept");
        assert!(text.contains(&format!("{version} or later")), "{file} names another Rust than {version}");
    }
    eprintln!("Rust {version}: {} of {} packages ask for one", needed.1, packages.len());
}

/// Whoever looks for a folder finds it on the README's map, and on that of the book's first page, with what it is for.
#[test]
fn every_folder_of_the_sources_is_on_both_maps() {
    let read = |file: &str| fs::read_to_string(repository().join(file)).expect("kept");
    let (readme, cover, mut folders) = (read("README.md"), read("book/src/cover.md"), 0);
    for package in ["src/pinhole", "src/lab"] {
        for entry in fs::read_dir(repository().join(package)).expect("a folder").flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            if !entry.path().is_dir() {
                continue;
            }
            let at = [format!("]({package}/{name}/mod.rs)"), format!("]({package}/{name}.rs)")];
            assert!(at.iter().any(|link| readme.contains(link)), "the README's map lacks {package}/{name}");
            assert!(
                cover.lines().any(|line| line.split(' ').next() == Some(&name)),
                "the cover page's map lacks {name}"
            );
            folders += 1;
        }
    }
    assert!(folders > 20, "{folders}");
}

/// Features of the packages that a build takes in, by name and version.
fn features(edges: &str) -> BTreeMap<String, BTreeSet<String>> {
    let words = ["tree", "--offline", "--locked", "-e", edges, "--prefix", "none", "-f", "{p} [{f}]"];
    let mut found: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for line in cargo(&words).lines().filter(|line| !line.is_empty()) {
        let line = line.trim_end_matches(" (*)");
        let (package, features) = line.split_once(" [").expect("features");
        found.entry(package.into()).or_default().insert(features.into());
    }
    found
}

/// `cargo run --release --example 05_pinhole` takes in what tests ask of packages, and `cargo run` does not: where the
/// features differ, the renderer is compiled a second time. So does `cargo run -- review` after `cargo test`.
#[test]
fn what_tests_ask_for_compiles_nothing_a_second_time() {
    let (plain, with_tests) = (features("normal,build"), features("normal,build,dev"));
    let differ: Vec<_> = plain
        .iter()
        .filter(|(package, features)| with_tests.get(*package) != Some(*features))
        .map(|(package, features)| format!("{package}: {features:?}, {:?} beside tests", with_tests.get(package)))
        .collect();
    eprintln!("features: {} packages of the program, {} with those of tests", plain.len(), with_tests.len());
    assert!(plain.len() > 60 && with_tests.len() > plain.len());
    assert!(differ.is_empty(), "{differ:#?}");
}
