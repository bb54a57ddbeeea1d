//! A checkpoint belongs to the program that wrote it: another program's samples are others.

#[expect(dead_code, reason = "its main is run by cargo")]
#[path = "../../src/pinhole/build.rs"]
mod build;

use super::{offer, sampled};
use build::hash_of;
use pinhole::plan::{Census, plan};
use pinhole::render::film_key;
use pinhole::scene::{FNV_BASIS, Sampling, fingerprint, fnv};
use std::fs;
use std::path::{Path, PathBuf};

fn hash_of_one(text: &str) -> String {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::create_dir_all(folder.path().join("src/pinhole/rays")).expect("made");
    fs::write(folder.path().join("Cargo.lock"), "[[package]]\n").expect("written");
    fs::write(folder.path().join("src/pinhole/rays/ndc.rs"), text).expect("written");
    hash_of(&[&folder.path().join("src")], &folder.path().join("Cargo.lock")).expect("read")
}

#[test]
fn an_edited_source_is_another_program() {
    let code = "fn ndc() -> f64 {\n    0.5\n}\n#[inline]\nfn two() -> [f64; 2] {\n    [1.0, -2.0]\n}\n";
    let edits = [("0.5", "0.6"), ("f64 {", "f32 {"), ("-2.0", "2.0"), ("#[inline]", ""), ("fn two", "pub fn two")];
    for (old, new) in edits {
        assert!(code.contains(old));
        assert_ne!(hash_of_one(code), hash_of_one(&code.replace(old, new)), "{old} became {new}");
    }
    assert_ne!(hash_of_one("fn a() { (b, c) }"), hash_of_one("fn a() { b, c }"));
    assert_ne!(hash_of_one("fn a() { [b] }"), hash_of_one("fn a() { (b) }"));
}

#[test]
fn what_is_not_code_makes_no_other_program() {
    let code = "/// Half.\nfn ndc() -> f64 {\n    0.5\n}\n";
    let same = [
        ("another folder", code.to_string()),
        ("other ends of lines", code.replace('\n', "\r\n")),
        ("a comment", code.replace("0.5", "// The middle.\n /* /* of */ one */ 0.5")),
        ("other documentation", code.replace("Half.", "One half, \"#{[ and so on.")),
        ("documentation of the file", format!("//! Points.\n\n{code}")),
        ("other line breaks", code.replace("{\n    0.5\n}", "{ 0.5 }")),
        ("a unit test", format!("{code}\n#[cfg(test)]\n#[allow(unused)]\nmod tests {{\n    fn a() {{}}\n}}\n")),
        ("what a unit test uses", format!("#[cfg(test)]\nuse a::b;\n{code}")),
    ];
    for (what, text) in same {
        assert_eq!(hash_of_one(&text), hash_of_one(code), "{what}");
    }
    let comment_in_text = hash_of_one("const A: &str = \"// one\";");
    assert_ne!(comment_in_text, hash_of_one("const A: &str = \"// two\";"), "within a string it is no comment");
}

#[test]
fn the_key_of_a_film_knows_the_sources_that_the_program_was_built_from() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let packages = ["src/pinhole", "src/scene"].map(|package| root.join(package));
    let sources =
        hash_of(&packages.each_ref().map(PathBuf::as_path), &root.join("Cargo.lock")).expect("the sources are here");
    let scene = sampled([16, 9], Sampling::default(), ());
    let plan = plan(&Census::of(&scene), &offer()).expect("a plan");
    let key_of = |sources: &str| {
        let stages = plan.rows.iter().filter(|row| row.kept).map(|row| format!("{}\n", row.stage));
        let text = format!("{sources}{}{}", fingerprint(&scene), stages.collect::<String>());
        fnv(FNV_BASIS, text.as_bytes())
    };
    assert_eq!(film_key(&scene, &plan), key_of(&sources));
    assert_ne!(film_key(&scene, &plan), key_of("another program"));
}
