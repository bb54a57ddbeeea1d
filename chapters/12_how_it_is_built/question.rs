//! Chapter 12: which stages are kept, beside pinhole's own plan.

use super::mine::mine;
use bevy_ecs::prelude::World;
use pinhole::plan::{Census, ColumnKind, Evidence, Lifetime, Stage, TileSystems, plan};
use pinhole::stages;
use pinhole_lab::exercise::apart::exact;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, probes};
use pinhole_lab::measure::ray_aim::Draws;

pub(super) type Input = (Vec<StageWords>, String);

/// The names that made-up stages and columns have.
const STAGES: [&str; 8] = ["first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth"];
const COLUMNS: [&str; 5] = ["points", "rays", "hits", "light", "sum"];

/// A stage on offer, in words alone: what the exercise plans with.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StageWords {
    /// What it is called.
    pub name: String,
    /// Whether the scene holds what the stage is for.
    pub needed: bool,
    /// The columns it reads.
    pub reads: Vec<String>,
    /// The columns it writes.
    pub writes: Vec<String>,
}

/// What the reader writes.
pub type Yours = fn(&[StageWords], &str) -> Vec<String>;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::kept)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("kept", question, move |(stages, asked)| yours(stages, asked), mine)
}

fn question() -> Question<Input, Vec<String>> {
    Question {
        pinhole_has: ("src/pinhole/plan/decide.rs", "fn decide"),
        probes: asked(),
        tell: |(stages, asked)| {
            let told: Vec<String> = stages.iter().map(told).collect();
            format!("asked for {asked}, of the stages\n               {}", told.join("\n               "))
        },
        right: |input| by_the_plan(input).unwrap_or_default(),
        apart: exact,
        allowed: 0.0,
        measured: "stages",
        mistakes: vec![
            Mistake::new("whether the scene needs a stage is left out", |input| by_rule(input, |_| true, true)),
            Mistake::new("whether anything reads what a stage writes is left out", |(stages, _)| {
                named(stages, |stage| stage.needed)
            }),
            Mistake::new("the stages come out last to first", |input| {
                by_the_plan(input).unwrap_or_default().into_iter().rev().collect()
            }),
            Mistake::new(
                "a stage counts as read if an earlier one reads what it writes; only later ones can",
                |input| by_rule(input, |stage| stage.needed, false),
            ),
            Mistake::new(
                "what a dropped stage reads is wanted too; only kept stages want anything",
                |(stages, asked)| {
                    let wanted = |at: usize, column: &String| {
                        column == asked || stages[at + 1..].iter().any(|later| later.reads.contains(column))
                    };
                    let kept = |(at, stage): (usize, &StageWords)| {
                        (stage.needed && stage.writes.iter().any(|column| wanted(at, column)))
                            .then(|| stage.name.clone())
                    };
                    stages.iter().enumerate().filter_map(kept).collect()
                },
            ),
            Mistake::new(
                "only the stage that writes the column asked for is kept; it reads columns too",
                |(stages, asked)| named(stages, |stage| stage.needed && stage.writes.contains(asked)),
            ),
        ],
        hints: &[
            "a stage is kept when the scene needs it and a kept stage after it, or the one who asks, reads what it \
             writes; who must be decided first?",
            "go from the last stage to the first, with a list of the columns wanted so far; it begins with the one \
             asked for",
            "keep a stage that is needed and writes a wanted column, and add what it reads to the list; turn the kept \
             names about at the end",
        ],
    }
}

fn asked() -> Vec<Probe<Input>> {
    let chain = [("raster", "", "raster"), ("rays", "raster", "rays"), ("film", "rays", "pixel")];
    let chain = chain.map(|(name, reads, writes)| words(name, true, reads, writes));
    let mut asked: Vec<_> = probes("a chain of three", [(chain.to_vec(), "pixel".into())]).collect();
    asked.extend(probes("the same, asked for what the second writes", [(chain.to_vec(), "rays".into())]));
    asked.extend(probes("the same, asked for what nobody writes", [(chain.to_vec(), "normals".into())]));
    let two = [
        words("rays from the eye", true, "screen", "rays"),
        words("start on the rectangle", false, "screen", "rays"),
        words("film", true, "rays", "pixel"),
    ];
    let with_screen = [[words("centre", true, "", "screen")].as_slice(), &two].concat();
    asked.extend(probes("two that write the same, one of them not needed", [(with_screen, "pixel".into())]));
    let shadows = [
        words("intersect", true, "", "hits"),
        words("sample lights", false, "hits", "light"),
        words("trace shadow rays", true, "light", "shadow"),
        words("list what was hit", true, "hits", "rows"),
        words("paint", true, "hits", "pixel"),
    ];
    asked.extend(probes("stages that nothing reads", [(shadows.to_vec(), "pixel".into())]));
    asked.extend(probes("no stages", [(Vec::new(), "pixel".into())]));
    let made_up =
        |seed, count| (0..400).map(move |at| made_up(seed, at, count)).filter(|input| by_the_plan(input).is_some());
    asked.extend(probes("made up, four stages", made_up(1201, 4).take(40)));
    asked.extend(probes("made up, eight stages", made_up(1202, 8).take(80)));
    asked
}

fn words(name: &str, needed: bool, reads: &str, writes: &str) -> StageWords {
    let list = |names: &str| names.split_whitespace().map(String::from).collect();
    StageWords { name: name.into(), needed, reads: list(reads), writes: list(writes) }
}

/// Stages that read and write anything; the plan refuses those in which a reader finds no writer before it.
fn made_up(seed: u64, index: u64, count: usize) -> Input {
    let mut draws = Draws::new(seed, index);
    let mut some = |most: f64| -> Vec<String> {
        let count = draws.between(0.0, most) as usize;
        let mut columns: Vec<String> =
            (0..count).map(|_| COLUMNS[draws.between(0.0, COLUMNS.len() as f64) as usize].into()).collect();
        columns.dedup();
        columns
    };
    let mut stages: Vec<StageWords> = (0..count)
        .map(|at| StageWords { name: STAGES[at].into(), needed: true, reads: some(2.5), writes: some(3.0) })
        .collect();
    for stage in &mut stages {
        stage.needed = draws.unit() < 0.75;
    }
    (stages, COLUMNS[4].into())
}

/// What pinhole's plan keeps of such stages; none where it refuses them.
fn by_the_plan((stages, asked): &Input) -> Option<Vec<String>> {
    // The plan tells columns apart by their types, so each made-up one borrows the type of one of the renderer's.
    let mut types: Vec<ColumnKind> = Vec::new();
    for column in stages::all().iter().flat_map(|stage| &stage.writes) {
        if !types.contains(column) {
            types.push(*column);
        }
    }
    let mut known: Vec<&String> = Vec::new();
    let mut column = |name| {
        let number = known.iter().position(|&other| other == name).unwrap_or_else(|| {
            known.push(name);
            known.len() - 1
        });
        let lifetime = if name == asked { Lifetime::Film } else { Lifetime::Pixel };
        types.get(number).map(|borrowed| ColumnKind { lifetime, ..*borrowed })
    };
    let mut offer = Vec::new();
    for words in stages {
        let reads = words.reads.iter().map(&mut column).collect::<Option<_>>()?;
        let writes = words.writes.iter().map(&mut column).collect::<Option<_>>()?;
        let when: fn(&Census<'_>) -> Evidence =
            if words.needed { |_| Evidence::always("needed") } else { |_| Evidence::default() };
        offer.push(Stage { reads, writes, when, ..Stage::new("", TileSystems::Raster, || ()) });
    }
    let plan = plan(&Census::of(&World::new()), &offer).ok()?;
    Some(stages.iter().zip(&plan.rows).filter(|(_, row)| row.kept).map(|(words, _)| words.name.clone()).collect())
}

/// The stages that are needed and write a wanted column, each of which wants what it reads: only of those before it,
/// or of any.
fn by_rule((stages, asked): &Input, needed: fn(&StageWords) -> bool, of_those_before: bool) -> Vec<String> {
    let (mut wanted, mut kept) = (vec![asked.clone()], vec![false; stages.len()]);
    let rounds = if of_those_before { 1 } else { stages.len() };
    for _ in 0..rounds {
        for (stage, kept) in stages.iter().zip(&mut kept).rev() {
            if !*kept && needed(stage) && stage.writes.iter().any(|column| wanted.contains(column)) {
                *kept = true;
                wanted.extend(stage.reads.iter().cloned());
            }
        }
    }
    stages.iter().zip(kept).filter(|(_, kept)| *kept).map(|(stage, _)| stage.name.clone()).collect()
}

fn named(stages: &[StageWords], kept: impl Fn(&StageWords) -> bool) -> Vec<String> {
    stages.iter().filter(|stage| kept(stage)).map(|stage| stage.name.clone()).collect()
}

/// A stage on one line.
fn told(stage: &StageWords) -> String {
    let list = |columns: &[String]| if columns.is_empty() { "nothing".into() } else { columns.join(", ") };
    let needed = if stage.needed { "needed" } else { "not needed" };
    format!("{}: {needed}, reads {}, writes {}", stage.name, list(&stage.reads), list(&stage.writes))
}
