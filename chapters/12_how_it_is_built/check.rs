//! Chapter 12: which stages are kept, beside pinhole's own plan.

use bevy_ecs::prelude::World;
use pinhole::film::FilmTile;
use pinhole::plan::{Census, Column, ColumnKind, Evidence, Lifetime, Stage, TileSystems, plan};
use pinhole::scene::View;
use pinhole::stages;
use pinhole_lab::exercise::apart::exact;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Probe, Question, Setting, StandIn, probes};
use pinhole_lab::measure::draws::Draws;

type Input = (Vec<StageWords>, String);

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

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("kept", question, move |(stages, asked)| yours(stages, asked), mine)
        .and_in("made-up stages", |_| ())
}

fn question() -> Question<Input, Vec<String>> {
    Question {
        pinhole_has: ("src/pinhole/plan/decide.rs", "fn decide"),
        probes: asked(),
        tell: |(stages, asked)| {
            let told: Vec<String> = stages.iter().map(told).collect();
            format!("asked for {asked}, of the stages\n               {}", told.join("\n               "))
        },
        right,
        apart: exact,
        allowed: 0.0,
        measured: "stages",
        mistakes: Mistakes::<Input, Vec<String>>::new()
            .say("whether the scene needs a stage is left out")
            .when(|input| by_rule(input, |_| true, true))
            .say("whether anything reads what a stage writes is left out")
            .when(|(stages, _)| named(stages, |stage| stage.needed))
            .say("the stages come out last to first")
            .when(|input| turned(right(input)))
            .say("a stage counts as read if an earlier one reads what it writes; only later ones can")
            .when(|input| by_rule(input, |stage| stage.needed, false))
            .say("the stages are gone through first to last; who reads a column comes later, so begin with the last")
            .when(|input| forward(input, |stage| stage.needed))
            .when(|input| forward(input, |_| true))
            .say("what a stage that the scene does not need reads is wanted too; only kept stages want anything")
            .when(|input| {
                let wanted = by_rule(input, |_| true, true);
                named(&input.0, |stage| stage.needed && wanted.contains(&stage.name))
            })
            .say("what a dropped stage reads is wanted too; only kept stages want anything")
            .when(|input| read_by(input, |_| true, false))
            .when(|input| read_by(input, |later| later.needed, false))
            .when(|input| read_by(input, |later| later.needed, true))
            .say("the column asked for is not wanted at first, so that nothing is kept that only it needs")
            .when(|(stages, _)| right(&(stages.clone(), String::new())))
            .say("a stage is kept only if all that it writes is wanted; one wanted column is enough")
            .when(|input| {
                backward(input, |stage, wanted| stage.writes.iter().all(|column| wanted.contains(column)), KEEP)
            })
            .when(|input| {
                let all = |stage: &StageWords, wanted: &[String]| {
                    !stage.writes.is_empty() && stage.writes.iter().all(|column| wanted.contains(column))
                };
                backward(input, all, KEEP)
            })
            .say("only the first column that a stage writes is looked at")
            .when(|input| {
                backward(input, |stage, wanted| stage.writes.first().is_some_and(|c| wanted.contains(c)), KEEP)
            })
            .say("a column counts as provided for once a stage writes it; every needed stage that writes it is kept")
            .when(|input| backward(input, writes_any, |stage, c| stage.writes.contains(c)))
            .when(|(stages, asked)| {
                let (mut wanted, mut kept, mut at) = (vec![asked], vec![false; stages.len()], 0);
                while at < wanted.len() {
                    let writes = |stage: &StageWords| stage.needed && stage.writes.contains(wanted[at]);
                    if let Some(first) = stages.iter().position(writes).filter(|&first| !kept[first]) {
                        kept[first] = true;
                        wanted.extend(&stages[first].reads);
                    }
                    at += 1;
                }
                stages.iter().zip(kept).filter(|(_, kept)| *kept).map(|(stage, _)| stage.name.clone()).collect()
            })
            .say("only what the last kept stage reads is wanted; what the others read stays wanted")
            .when(|input| backward(input, writes_any, |_, _| true))
            .say("what a stage reads and what it writes are swapped")
            .when(|(stages, asked)| {
                let swap = |stage: &StageWords| StageWords {
                    reads: stage.writes.clone(),
                    writes: stage.reads.clone(),
                    ..stage.clone()
                };
                by_rule(&(stages.iter().map(swap).collect(), asked.clone()), |stage| stage.needed, true)
            })
            .say("a stage is kept only if it reads what is wanted; it must write that")
            .when(|input| backward(input, |stage, wanted| stage.reads.iter().any(|c| wanted.contains(c)), KEEP))
            .say("only the stage that writes the column asked for is kept; it reads columns too")
            .when(|(stages, asked)| named(stages, |stage| stage.needed && stage.writes.contains(asked)))
            .say("only the stages that those of the column asked for read are kept; these read columns in their turn")
            .when(|(stages, asked)| {
                let last = |stage: &&StageWords| stage.needed && stage.writes.contains(asked);
                let wanted: Vec<&String> = stages.iter().filter(last).flat_map(|stage| &stage.reads).collect();
                named(stages, |stage| stage.needed && stage.writes.iter().any(|c| c == asked || wanted.contains(&c)))
            })
            .say("the stages come out in another order; they are named in theirs")
            .when(|input| {
                let mut names = right(input);
                names.sort_unstable();
                names
            })
            .say("the search ends at the first stage that is not kept; one before it may be")
            .when(|input| {
                let kept = right(input);
                let ends = input.0.iter().rev().take_while(|stage| kept.contains(&stage.name)).count();
                named(&input.0[input.0.len() - ends..], |_| true)
            }),
        hints: &[
            "a stage is kept when the scene needs it and a kept stage after it, or the one who asks, reads what it \
             writes; who must be decided first?",
            "go from the last stage to the first, with a list of the columns wanted so far; it begins with the one \
             asked for",
            "what does a stage that is kept want in its turn? and in which order do the names come out?",
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
    let mut some = |max: f64| -> Vec<String> {
        let count = draws.between(0.0, max) as usize;
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

/// Wanted columns stay wanted.
const KEEP: fn(&StageWords, &String) -> bool = |_, _| false;

fn right(input: &Input) -> Vec<String> {
    by_the_plan(input).unwrap_or_default()
}

fn turned(mut names: Vec<String>) -> Vec<String> {
    names.reverse();
    names
}

fn writes_any(stage: &StageWords, wanted: &[String]) -> bool {
    stage.writes.iter().any(|column| wanted.contains(column))
}

/// From the last stage to the first: which of the needed ones are kept, and which columns are wanted no longer then.
fn backward(
    (stages, asked): &Input,
    kept: fn(&StageWords, &[String]) -> bool,
    no_longer: fn(&StageWords, &String) -> bool,
) -> Vec<String> {
    let (mut wanted, mut names) = (vec![asked.clone()], Vec::new());
    for stage in stages.iter().rev().filter(|stage| stage.needed) {
        if kept(stage, &wanted) {
            names.push(stage.name.clone());
            wanted.retain(|column| !no_longer(stage, column));
            wanted.extend(stage.reads.iter().cloned());
        }
    }
    turned(names)
}

/// In one round from the first stage to the last.
fn forward((stages, asked): &Input, needed: fn(&StageWords) -> bool) -> Vec<String> {
    let mut wanted = vec![asked.clone()];
    let mut kept = |stage: &StageWords| {
        let kept = needed(stage) && writes_any(stage, &wanted);
        wanted.extend(stage.reads.iter().filter(|_| kept).cloned());
        kept
    };
    let kept: Vec<&StageWords> = stages.iter().filter(|stage| kept(stage)).collect();
    kept.into_iter().map(|stage| stage.name.clone()).collect()
}

/// The needed stages that write what is asked for, or what another reads that counts: one after them, or any.
fn read_by((stages, asked): &Input, counts: fn(&StageWords) -> bool, any: bool) -> Vec<String> {
    let wanted = |at: usize, column: &String| {
        let others = if any { &stages[..] } else { &stages[at + 1..] };
        column == asked || others.iter().any(|other| counts(other) && other.reads.contains(column))
    };
    let kept = |(at, stage): (usize, &StageWords)| {
        (stage.needed && stage.writes.iter().any(|column| wanted(at, column))).then(|| stage.name.clone())
    };
    stages.iter().enumerate().filter_map(kept).collect()
}

/// The chapter's stages in words, the painting of its view and the film among them, and those of them that are kept.
fn mine(ask: Ask<Input, Vec<String>>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    let mut stages = setting.chapter.stages();
    // A chapter's own stage stands last in its list; its set says when it runs.
    stages.sort_by_key(|stage| stage.set);
    let words: Vec<StageWords> = stages.iter().map(|stage| words_of(stage, setting)).collect();
    let kept = ask.once((words.clone(), FilmTile::NAME.into())).unwrap_or_default();
    if let Some(unknown) = kept.iter().find(|name| words.iter().all(|stage| stage.name != **name)) {
        ask.complain(format!("named \"{unknown}\", which is none of the stages that it was given"));
    }
    StandIn::keeping(kept)
}

fn words_of(stage: &Stage, setting: &Setting<'_>) -> StageWords {
    let names = |columns: &[ColumnKind]| columns.iter().map(|column| column.name.to_owned()).collect::<Vec<_>>();
    let mut reads = names(&stage.reads);
    if stage.reads_view {
        reads.extend(setting.camera::<View>().map(|view| view.column.clone()));
    }
    let needed = (stage.when)(&Census::of(setting.scene)).needed;
    StageWords { name: stage.name.into(), needed, reads, writes: names(&stage.writes) }
}

/// The stages of the exercise's inputs, an input a column, in several bands: bright what is kept, and the later the
/// brighter.
fn painted(ask: Ask<Input, Vec<String>>) -> StandIn {
    const COLUMNS: u32 = 32;
    let inputs: Vec<Input> = asked().into_iter().map(|probe| probe.input).collect();
    let band = inputs.iter().map(|(stages, _)| stages.len()).max().unwrap_or(0) as u32 + 1;
    let kept: Vec<Vec<String>> = inputs.iter().map(|input| ask.once(input.clone()).unwrap_or_default()).collect();
    StandIn::painted([COLUMNS, (inputs.len() as u32).div_ceil(COLUMNS) * band], move |[x, y]| {
        let input = (y / band * COLUMNS + x) as usize;
        let Some(stage) = inputs.get(input).and_then(|(stages, _)| stages.get((y % band) as usize)) else {
            return [0.0; 3];
        };
        let place = kept[input].iter().position(|name| *name == stage.name);
        place.map_or([0.1; 3], |place| [1.0, 0.3 + 0.7 * (place + 1) as f64 / kept[input].len() as f64, 0.3])
    })
}
