//! What stages read and write comes from their systems' parameters; little is left to declare.

use super::*;
use pinhole::cameras::ImageCircle;
use pinhole::follow::remaining_bounces_stage;
use pinhole::intersect::{classify_stage, sphere_stage};
use pinhole::plan::{Column, Shared, column};
use pinhole::rays::{CameraRays, RasterPoints, lens_point_stage, world_stage};
use pinhole::shade::{Radiance, image_mask_stage, point_light_stage};
use std::path::{Path, PathBuf};

/// The most that is declared by hand; 592 before stages declared themselves.
const MAX: usize = 112;

/// What a stage says that its system's parameters do not, and what a column says for all that change it.
const DECLARATIONS: [&str; 9] = [
    ".reads::<",
    ".writes::<",
    ".table::<",
    ".reads_where::<",
    ".table_where::<",
    ".table_with::<",
    ".appends::<",
    ".changes::<",
    ".reads_the_view()",
];

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn little_is_declared_by_hand() {
    let mut files = Vec::new();
    sources(Path::new("src/pinhole"), &mut files);
    assert!(files.len() > 200, "{} files", files.len());
    let (mut by_stages, mut by_columns) = (0, 0);
    for file in files.iter().filter(|file| !file.starts_with("src/pinhole/plan")) {
        let text = std::fs::read_to_string(file).expect("a source");
        for constructor in text.split("-> Stage {").skip(1).filter_map(|after| after.split("\n}").next()) {
            by_stages += DECLARATIONS.iter().map(|word| constructor.matches(word).count()).sum::<usize>();
        }
        by_columns += text.matches(", begun in ").count();
    }
    eprintln!("declared: {by_stages} lines at stages, {by_columns} at columns");
    assert!(by_stages > 20 && by_columns > 5, "the test must see them");
    assert!(by_stages + by_columns <= MAX, "{by_stages} + {by_columns} are more than {MAX}");
}

/// What a query asks for, where it asks for a tuple of columns.
fn tuples(text: &str) -> impl Iterator<Item = &str> {
    text.match_indices("Query<(").map(|(at, _)| {
        let mut depth = 0;
        let end = text[at..].find(|letter| {
            depth += i32::from(matches!(letter, '<' | '(')) - i32::from(matches!(letter, '>' | ')'));
            depth == 0 && letter == '>'
        });
        &text[at..at + end.expect("closed")]
    })
}

#[test]
fn queries_of_many_columns_have_names_for_them() {
    let mut files = Vec::new();
    sources(Path::new("src/pinhole"), &mut files);
    let mut counted = 0;
    for file in &files {
        let text = std::fs::read_to_string(file).expect("a source");
        for tuple in tuples(&text) {
            counted += 1;
            assert!(tuple.matches('&').count() <= 5, "{}: make a view of {tuple}", file.display());
        }
    }
    assert!(counted > 20, "the test must see them: {counted}");
}

/// A stage's columns and tables: those it needs, those it reads where they are, those for a reason, those it writes, its
/// tables and those for a reason.
fn touched(stage: &Stage) -> [Vec<&'static str>; 6] {
    let names = |columns: &[ColumnKind]| columns.iter().map(|column| column.name).collect();
    let tables = stage.tables.iter().map(|table| table.name);
    [
        names(&stage.reads),
        names(&stage.reads_if),
        stage.reads_where.iter().map(|(column, _)| column.name).collect(),
        names(&stage.writes),
        tables.collect(),
        stage.tables_where.iter().map(|(table, _)| table.name).collect(),
    ]
}

#[test]
fn systems_say_what_stages_touch() {
    let none: Vec<&str> = Vec::new();
    let stage = lens_point_stage();
    let expected =
        [vec!["raster"], vec!["samples"], none.clone(), vec!["lens"], vec!["lens", "sampling"], none.clone()];
    assert_eq!(touched(&stage), expected, "an optional column");

    let stage = world_stage();
    let reasons = vec!["shutter", "ray origins"];
    let expected = [vec!["camera"], none.clone(), vec!["time"], vec!["world"], vec!["camera axes"], reasons];
    assert_eq!(touched(&stage), expected, "what the scene must give a reason for");

    let stage = sphere_stage();
    let expected =
        [vec!["world", "hit"], none.clone(), none.clone(), vec!["hit"], vec!["spheres"], vec!["hierarchy of spheres"]];
    assert_eq!(touched(&stage), expected, "a column that an earlier set began is changed in place");
    assert!(!stage.appends);

    let stage = point_light_stage();
    let [reads, reads_if, _, writes, ..] = touched(&stage);
    assert_eq!(
        (reads, reads_if),
        (vec!["surface", "material rows", "shadow ray"], vec!["shading", "transmissive rows", "samples", "path"]),
        "a stage that appends"
    );
    assert_eq!((writes, stage.appends), (vec!["shadow ray", "light pdf"], true));

    let stage = remaining_bounces_stage();
    let [reads, _, reasons, writes, tables, _] = touched(&stage);
    assert_eq!((reads, writes), (vec!["world", "path light"], vec!["path light"]), "an exclusive system declares");
    assert_eq!((reasons.len(), tables), (9, vec!["integrator"]));

    let chapter = chapters::all().into_iter().find(|chapter| chapter.name == "12_how_it_is_built").expect("a chapter");
    let own = chapter.offer.iter().find(|stage| stage.name == "Compute facing ratios").expect("on offer");
    let expected = [vec!["world", "surface"], none.clone(), none.clone(), vec!["facing"], none.clone(), none];
    assert_eq!(touched(own), expected, "a column of a chapter's own");
}

#[test]
fn exclusive_systems_are_the_only_ones_that_declare_what_they_read() {
    let offer = offer();
    let named: Vec<&str> = offer.iter().filter(|stage| exclusive(stage)).map(|stage| stage.name).collect();
    assert_eq!(named, ["Trace the remaining bounces", "Paint the view"]);
}

fn exclusive(stage: &Stage) -> bool {
    let mut schedule = Schedule::default();
    schedule.add_systems((stage.system)());
    schedule.initialize(&mut World::new()).map(|_| ()).expect("one system is a schedule");
    schedule.systems_with_access().expect("initialised").any(|(_, system)| system.access().is_exclusive())
}

column! {
    /// A column of this test's, which no stage of the renderer writes.
    pub struct Made("made", "none", "1", Ray) {
        /// A number.
        number: f32,
    }
}

impl Made {
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.number[row]; 3]
    }
}

fn make(_: Res<Shared<ImageFrame>>, mut tiles: Query<(&RasterPoints, Option<&CameraRays>, &mut Made)>) {
    tiles.iter_mut().for_each(|(raster, _, mut made)| made.number.resize(raster.rows(), 0.5));
}

fn darken(mut tiles: Query<(&Made, &mut Radiance)>) {
    tiles.iter_mut().for_each(|(_, mut radiance)| radiance.rgb[0].fill(0.0));
}

#[test]
fn stages_are_told_apart_by_their_systems() {
    let [one, other] = [Stage::new("one", TileSystems::Shade, make), Stage::new("other", TileSystems::Mask, make)];
    assert_eq!(one, other, "a name does not tell stages apart");
    assert_ne!(one, Stage::new("one", TileSystems::Shade, darken));
    assert!(sphere_stage().is(sphere_stage) && !classify_stage().is(sphere_stage));
    assert_ne!(image_mask_stage::<ImageCircle>(), point_light_stage());

    let both = Stage::new("both", TileSystems::Shade, (make, darken));
    let [mut reads, reads_if, _, mut writes, tables, _] = touched(&both);
    // The systems of one stage are in no order.
    [&mut reads, &mut writes].into_iter().for_each(|names| names.sort());
    assert_eq!((reads, reads_if), (vec!["radiance", "raster"], vec!["camera"]), "several systems as one stage");
    assert_eq!((writes, tables), (vec!["made", "radiance"], vec!["image shape"]));
}
