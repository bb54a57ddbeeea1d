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
use std::path::Path;

#[test]
fn an_edited_source_is_another_program() {
    let folders = [(); 2].map(|()| tempfile::tempdir().expect("a temporary folder"));
    let write = |at: usize, text: &str| {
        fs::create_dir_all(folders[at].path().join("src/pinhole/rays")).expect("made");
        fs::write(folders[at].path().join("Cargo.lock"), "[[package]]\n").expect("written");
        fs::write(folders[at].path().join("src/pinhole/rays/ndc.rs"), text).expect("written");
        hash_of(&folders[at].path().join("src"), &folders[at].path().join("Cargo.lock")).expect("read")
    };
    let before = write(0, "fn ndc() {\n    0.5\n}\n");
    assert_eq!(before, write(1, "fn ndc() {\r\n    0.5\r\n}\r\n"), "neither the folder nor the ends of lines count");
    assert_ne!(before, write(0, "fn ndc() {\n    0.6\n}\n"));
}

#[test]
fn the_key_of_a_film_knows_the_sources_that_the_program_was_built_from() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let sources = hash_of(&root.join("src/pinhole"), &root.join("Cargo.lock")).expect("the sources are here");
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
