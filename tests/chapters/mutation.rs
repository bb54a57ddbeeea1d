//! Every mutation is found, and the message names the very stage that was mutated.

use crate::message::{mismatch, what_to_do};
use pinhole::follow::{mis_emission_stage, mis_environment_stage};
use pinhole::plan::Census;
use pinhole::{Chapter, Overrides, stages};
use pinhole_lab::review::mutation::{MUTATIONS, Mutation};
use pinhole_lab::review::{DEVELOP, Snapshots};
use std::collections::{BTreeMap, BTreeSet};

fn chapter(name: &str) -> Chapter {
    chapters::all().into_iter().find(|chapter| chapter.name == name).expect("a chapter")
}

#[test]
fn the_message_names_the_stage_of_each_mutation() {
    let mut before: BTreeMap<&str, Snapshots> = BTreeMap::new();
    for mutation in MUTATIONS {
        let chapter = chapter(mutation.chapter);
        let before = before.entry(mutation.chapter).or_insert_with(|| Snapshots::of(&chapter).expect("renders"));
        let now = mutation.snapshots(&chapter).expect("renders with the bug");
        let message = format!("{:?}", mismatch(chapter.name, before, &now, &["digests"]));
        let first = message.lines().next().unwrap_or_default();
        let expected =
            format!("{}: the first stage whose numbers differ is \"{}\" (column ", chapter.name, mutation.stage());
        assert!(first.starts_with(&expected), "{}: {first}", mutation.name);
    }
    eprintln!("mutations: {}, each named at its stage", MUTATIONS.len());
}

#[test]
fn every_stage_of_pinhole_that_a_chapter_runs_has_a_mutation() {
    // Of paths that go on, snapshots hold no more than the light that they carry.
    let on_paths = [
        stages::bounces(),
        stages::path_continuation(),
        stages::specular_reflection(),
        stages::glossy_reflection(),
        stages::glass(),
        stages::ambient_occlusion(),
        stages::mis(),
        stages::light_tracing(),
        stages::photon_mapping(),
        stages::bidirectional_path_tracing(),
        stages::dispersion(),
        stages::media(),
        vec![mis_emission_stage(), mis_environment_stage()],
    ]
    .concat();
    let mut pinhole = Chapter::new("pinhole", "all that the renderer offers", |_| ()).offer(stages::all()).stages();
    pinhole.retain(|stage| !on_paths.contains(stage));
    let mut stages: BTreeSet<String> = BTreeSet::from([DEVELOP.into()]);
    for chapter in chapters::all() {
        let plan =
            pinhole::plan::plan(&Census::of(&chapter.world(&Overrides::default())), &chapter.stages()).expect("a plan");
        stages.extend(plan.stages.iter().filter(|stage| pinhole.contains(stage)).map(|stage| stage.name.to_string()));
    }
    let mutation: BTreeSet<String> = MUTATIONS.iter().map(|mutation| mutation.stage().to_string()).collect();
    assert_eq!(mutation, stages, "the stages with a mutation (src/lab/review/mutation/table.rs), and those there are");
    let names: BTreeSet<&str> = MUTATIONS.iter().map(|mutation| mutation.name).collect();
    assert_eq!(names.len(), MUTATIONS.len(), "two bugs have one name");
    eprintln!("mutations: {} stages", stages.len());
}

#[test]
fn a_mutation_that_cannot_be_made_is_refused_in_a_sentence() {
    let told = Mutation::named("half-pixle").expect_err("no such bug").to_string();
    assert!(told.starts_with("there is no mutation \"half-pixle\"; the nearest is half-pixel"), "{told}");
    let mutation = Mutation::named("no-cosine").expect("a bug");
    let told = mutation.snapshots(&chapter("01_image")).expect_err("no lights").to_string();
    assert_eq!(told, "01_image does not run \"Sample point lights\", where no-cosine belongs; 05_pinhole does");
}

/// The page shows a message with lines left out; what it shows must be what is said.
#[test]
fn the_book_shows_the_message_as_it_is() {
    let mutation = Mutation::named("no-cosine").expect("a bug");
    let chapter = chapter(mutation.chapter);
    let (before, now) = (Snapshots::of(&chapter).expect("renders"), mutation.snapshots(&chapter).expect("renders"));
    let message = format!("{:?}", mismatch(chapter.name, &before, &now, &["digests"]));
    let worst = pinhole_lab::review::compare_pictures(&before.picture, &now.picture).expect("pictures").worst;
    let said = message + &what_to_do(chapter.name, worst, true);
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/book/src/reviewing.md");
    let page = std::fs::read_to_string(page).expect("the page can be read");
    let shown = page.split("```text\n").nth(1).and_then(|rest| rest.split("```").next()).expect("the message");
    let mut lines = 0;
    for line in shown.lines().filter(|line| !line.is_empty() && line.trim() != "…") {
        assert!(
            said.lines().any(|other| other == line),
            "book/src/reviewing.md shows the line\n{line}\nand said is\n{said}"
        );
        lines += 1;
    }
    assert!(lines > 10, "{lines} lines of the message are shown");
}
