//! Every bug planted on purpose is found, and the message names the very stage it was planted at.

use crate::chapters;
use crate::message::mismatch;
use pinhole::naive::planted::{PLANTED, Planted};
use pinhole::review::{DEVELOP, Snapshots};
use pinhole::{Asked, Chapter};
use std::collections::{BTreeMap, BTreeSet};

fn chapter(name: &str) -> Chapter {
    chapters::all().into_iter().find(|chapter| chapter.name == name).expect("a chapter")
}

#[test]
fn the_message_names_the_stage_of_each_planted_bug() {
    let mut before: BTreeMap<&str, Snapshots> = BTreeMap::new();
    for planted in &PLANTED {
        let chapter = chapter(planted.chapter);
        let before = before.entry(planted.chapter).or_insert_with(|| Snapshots::of(&chapter).expect("renders"));
        let now = planted.snapshots(&chapter).expect("renders with the bug");
        let message = format!("{:?}", mismatch(chapter.name, before, &now, &["digests"]));
        let first = message.lines().next().unwrap_or_default();
        let expected =
            format!("{}: the first stage whose numbers differ is \"{}\" (column ", chapter.name, planted.stage);
        assert!(first.starts_with(&expected), "{}: {first}", planted.name);
    }
    eprintln!("planted: {} bugs, each named at its stage", PLANTED.len());
}

#[test]
fn every_stage_that_a_chapter_runs_has_a_planted_bug() {
    let mut stages: BTreeSet<String> = BTreeSet::from([DEVELOP.into()]);
    for chapter in chapters::all() {
        let plan = pinhole::plan::plan(&chapter.world(&Asked::default()), &chapter.stages()).expect("a plan");
        stages.extend(plan.stages.iter().map(|stage| stage.name.to_string()));
    }
    let planted: BTreeSet<String> = PLANTED.iter().map(|planted| planted.stage.to_string()).collect();
    assert_eq!(planted, stages, "the stages with a planted bug (src/naive/planted/table.rs), and those there are");
    let names: BTreeSet<&str> = PLANTED.iter().map(|planted| planted.name).collect();
    assert_eq!(names.len(), PLANTED.len(), "two bugs have one name");
    eprintln!("planted: {} stages", stages.len());
}

#[test]
fn a_bug_that_cannot_be_planted_is_refused_in_a_sentence() {
    let told = Planted::named("half-pixle").expect_err("no such bug").to_string();
    assert!(told.starts_with("there is no bug \"half-pixle\" to be planted; the nearest is half-pixel"), "{told}");
    let planted = Planted::named("no-cosine").expect("a bug");
    let told = planted.snapshots(&chapter("01_image")).expect_err("no lights").to_string();
    assert_eq!(told, "01_image does not run \"Aim at lights\", where no-cosine is planted; 05_pinhole does");
}
