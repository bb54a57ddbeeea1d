//! The reader's function in the picture of chapter 12: the stages that it keeps are the only ones on offer.

use super::question::{Input, StageWords};
use pinhole::film::FilmTile;
use pinhole::plan::{Census, Column, ColumnKind, Stage};
use pinhole::scene::View;
use pinhole_lab::exercise::{Ask, Setting, StandIn};

/// The chapter's stages in words, the painting of its view and the film among them, and those of them that are kept.
pub fn mine(ask: Ask<Input, Vec<String>>, setting: &Setting<'_>) -> StandIn {
    let mut stages = setting.chapter.stages();
    // A chapter's own stage stands last in its list; its set says when it runs.
    stages.sort_by_key(|stage| stage.set);
    let words: Vec<StageWords> = stages.iter().map(|stage| words(stage, setting)).collect();
    let kept = ask.once((words.clone(), FilmTile::NAME.into())).unwrap_or_default();
    if let Some(unknown) = kept.iter().find(|name| words.iter().all(|stage| stage.name != **name)) {
        ask.complain(format!("named \"{unknown}\", which is none of the stages that it was given"));
    }
    StandIn::keeping(kept)
}

fn words(stage: &Stage, setting: &Setting<'_>) -> StageWords {
    let names = |columns: &[ColumnKind]| columns.iter().map(|column| column.name.to_owned()).collect::<Vec<_>>();
    let mut reads = names(&stage.reads);
    if stage.reads_view {
        reads.extend(setting.camera::<View>().map(|view| view.column.clone()));
    }
    let needed = (stage.when)(&Census::of(setting.scene)).needed;
    StageWords { name: stage.name.into(), needed, reads, writes: names(&stage.writes) }
}
