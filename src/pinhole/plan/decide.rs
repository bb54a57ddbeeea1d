use super::{Census, ColumnKind, Lifetime, Stage, TableKind, TileSystems};
use crate::scene::{Statistics, View, printable};
use bevy_ecs::prelude::*;
use serde::Serialize;
use std::collections::BTreeSet;
use thiserror::Error;

/// Why no plan can be made of these stages for this scene.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum PlanError {
    /// A kept stage reads a column that no kept stage writes.
    #[error("the stage \"{stage}\" reads the column `{column}`, but {why}")]
    NoProducer {
        /// The reader.
        stage: &'static str,
        /// What it reads.
        column: &'static str,
        /// What became of the stages that could write it.
        why: String,
    },
    /// A kept stage reads a column where it exists, and it exists only after the stage has run.
    #[error(
        "the stage \"{stage}\" reads the column `{column}`, but \"{writer}\" writes it only afterwards: it belongs \
         in an earlier set"
    )]
    WrittenAfterwards {
        /// The reader.
        stage: &'static str,
        /// What it reads.
        column: &'static str,
        /// The first that writes it.
        writer: &'static str,
    },
    /// A view asks for a column that does not exist here.
    #[error("the view asks for the column `{asked}`, but {why}")]
    NoSuchView {
        /// The word asked for.
        asked: String,
        /// What there is instead.
        why: String,
    },
}

/// What one row of a batch stands for in a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RowKind {
    /// A pixel, seen from the camera.
    Pixel,
    /// A way of light that starts on a light.
    LightPath,
}

/// One run over all batches.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Pass {
    /// What it is called.
    pub name: &'static str,
    /// What a row is.
    pub row: RowKind,
    /// What it leaves behind.
    pub product: &'static str,
}

/// One stage on offer, kept or dropped, and why.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PlanRow {
    /// The stage's name.
    pub stage: &'static str,
    /// Whether it will run.
    pub kept: bool,
    /// Why, with the first entities that caused it.
    pub reason: String,
    /// How many reachable entities caused it.
    #[serde(rename = "entities")]
    pub count: usize,
    /// The columns it will write.
    pub columns: Vec<&'static str>,
    /// The tables it will read.
    pub tables: Vec<&'static str>,
}

/// What will run for a scene, what will not, and why.
#[derive(Clone, Debug)]
pub struct Plan {
    /// A row a stage on offer, in the order of the stages.
    pub rows: Vec<PlanRow>,
    /// The kept stages, in order.
    pub stages: Vec<Stage>,
    /// The columns that will exist, each a component of a tile's entity.
    pub columns: Vec<ColumnKind>,
    /// The tables that will exist, each a resource of a render world.
    pub tables: Vec<TableKind>,
    /// The runs over the image.
    pub passes: Vec<Pass>,
    /// The column that is painted instead of the picture.
    pub view: Option<ColumnKind>,
    /// Whether stages are timed and their rows counted.
    pub statistics: bool,
}

/// Decides which of the stages on offer this scene needs.
///
/// Pure and deterministic: the same scene and offer give the same plan.
pub fn plan(scene: &Census<'_>, offer: &[Stage]) -> Result<Plan, PlanError> {
    let mut offer: Vec<&Stage> = offer.iter().collect();
    // Where stages of one set add to the same sums, their order must not depend on who offered which first.
    let by_name = |stage: &Stage| if stage.set.order_free() { "" } else { stage.name };
    offer.sort_by_key(|stage| (stage.set, by_name(stage)));
    let view = requested::<View>(scene).map(|view| find_view(&offer, &view.column)).transpose()?;

    let mut wanted: BTreeSet<&'static str> = BTreeSet::new();
    let mut decided: Vec<(&Stage, PlanRow)> = Vec::new();
    for stage in offer.iter().rev() {
        let row = decide(scene, stage, view, &wanted);
        if row.kept {
            wanted.extend(stage.reads.iter().chain(&stage.reads_if).map(|column| column.name));
            let asked = stage.reads_where.iter().filter(|(_, predicate)| predicate(scene).needed);
            wanted.extend(asked.map(|(column, _)| column.name));
            if let (true, Some(column)) = (stage.reads_view, view) {
                wanted.insert(column.name);
            }
        }
        decided.push((stage, row));
    }
    decided.reverse();
    check_producers(&decided, view)?;
    Ok(collect(scene, decided, view))
}

/// The columns that a view may ask for among these stages, in order.
///
/// A view shows the first leg of light's way, on which what is kept a path holds nothing yet.
pub fn view_names(offer: &[Stage]) -> Vec<&'static str> {
    let mut offer: Vec<&Stage> = offer.iter().collect();
    offer.sort_by_key(|stage| stage.set);
    let mut names = Vec::new();
    let seen = offer.iter().filter(|stage| stage.runs_in(RowKind::Pixel));
    for column in seen.flat_map(|stage| &stage.writes).filter(|column| column.is_viewed()) {
        if !names.contains(&column.name) {
            names.push(column.name);
        }
    }
    names
}

fn decide(scene: &Census<'_>, stage: &Stage, view: Option<ColumnKind>, wanted: &BTreeSet<&'static str>) -> PlanRow {
    let evidence = (stage.when)(scene);
    let is_film = stage.writes.iter().any(|column| column.lifetime == Lifetime::Film);
    let read: Vec<&'static str> = stage
        .writes
        .iter()
        .filter(|column| wanted.contains(column.name) || column.lifetime == Lifetime::Film)
        .map(|column| column.name)
        .collect();
    let painted_over = view.is_some_and(|column| column.name != "radiance" || !stage.runs_in(RowKind::Pixel))
        && !stage.reads_view
        && (matches!(stage.set, TileSystems::Step | TileSystems::RemainingBounces)
            || !stage.runs_in(RowKind::Pixel)
            || stage.writes.iter().all(|column| column.name == "radiance"));
    let (kept, reason) = if !evidence.needed {
        (false, evidence.reason)
    } else if let (true, Some(column)) = (painted_over, view) {
        (false, format!("the view paints `{}` instead", column.name))
    } else if is_film || !read.is_empty() {
        (true, evidence.reason)
    } else {
        let words: Vec<String> = stage.writes.iter().map(|column| format!("`{}`", column.name)).collect();
        (false, format!("nothing that runs reads {}", words.join(" or ")))
    };
    let (columns, tables) = if kept {
        let tables = stage.tables_for(scene, &read);
        (read, tables.iter().map(|table| table.name).collect())
    } else {
        (Vec::new(), Vec::new())
    };
    let count = if kept || !evidence.needed { evidence.count } else { 0 };
    PlanRow { stage: stage.name, kept, reason, count, columns, tables }
}

fn check_producers(decided: &[(&Stage, PlanRow)], view: Option<ColumnKind>) -> Result<(), PlanError> {
    let mut written: BTreeSet<&'static str> = BTreeSet::new();
    for (stage, row) in decided.iter().filter(|(_, row)| row.kept) {
        if let (true, Some(column)) = (stage.reads_view, view)
            && !written.contains(column.name)
        {
            return Err(PlanError::NoSuchView { asked: column.name.into(), why: fate(decided, column.name) });
        }
        for column in &stage.reads {
            if !written.contains(column.name) {
                let why = fate(decided, column.name);
                return Err(PlanError::NoProducer { stage: stage.name, column: column.name, why });
            }
        }
        let beside = stage.reads_if.iter().chain(stage.reads_where.iter().map(|(column, _)| column));
        // The film's columns hold the samples before this one.
        for column in beside.filter(|column| column.lifetime != Lifetime::Film) {
            let of = |(_, row): &&(&Stage, PlanRow)| row.kept && row.columns.contains(&column.name);
            let writer = decided.iter().find(of).map(|(writer, _)| writer.name);
            if let (false, Some(writer)) = (written.contains(column.name), writer) {
                return Err(PlanError::WrittenAfterwards { stage: stage.name, column: column.name, writer });
            }
        }
        written.extend(&row.columns);
    }
    Ok(())
}

/// What became of the stages that could have written a column, in words.
///
/// Kinds of which the scene holds nothing, not even disabled, are passed over where another kind has something to say.
fn fate(decided: &[(&Stage, PlanRow)], column: &str) -> String {
    let could = |stage: &Stage| stage.writes.iter().any(|own| own.name == column);
    let holds_none = |row: &PlanRow| row.reason.starts_with("0 ") && !row.reason.contains('"');
    let none_to_tell = !decided.iter().any(|(stage, row)| could(stage) && !holds_none(row));
    let writers: Vec<String> = decided
        .iter()
        .filter(|(stage, row)| could(stage) && (none_to_tell || !holds_none(row)))
        .map(|(stage, row)| format!("\"{}\" is left out here ({})", stage.name, row.reason))
        .collect();
    match &writers[..] {
        [] => "no stage on offer writes it".into(),
        [one] => one.clone(),
        [one, other] => format!("{one} and {other}"),
        [first, between @ .., last] => format!("{first} and {last} and so are {} more that write it", between.len()),
    }
}

fn find_view(offer: &[&Stage], asked: &str) -> Result<ColumnKind, PlanError> {
    let stages: Vec<Stage> = offer.iter().map(|&stage| stage.clone()).collect();
    let mut names = view_names(&stages);
    names.retain(|name| !name.ends_with(" rows"));
    let found = offer.iter().flat_map(|stage| &stage.writes).find(|column| column.name == asked && column.is_viewed());
    found.copied().ok_or_else(|| PlanError::NoSuchView {
        asked: printable(asked, 40),
        why: format!("the columns on offer are {} and lists of rows", names.join(", ")),
    })
}

fn collect(scene: &Census<'_>, decided: Vec<(&Stage, PlanRow)>, view: Option<ColumnKind>) -> Plan {
    let (mut columns, mut tables): (Vec<ColumnKind>, Vec<TableKind>) = (Vec::new(), Vec::new());
    let (mut stages, mut rows) = (Vec::new(), Vec::new());
    for (stage, row) in decided {
        if row.kept {
            for column in stage.writes.iter().filter(|column| row.columns.contains(&column.name)) {
                if !columns.contains(column) {
                    columns.push(*column);
                }
            }
            for table in stage.tables_for(scene, &row.columns) {
                if !tables.contains(&table) {
                    tables.push(table);
                }
            }
            stages.push(stage.clone());
        }
        rows.push(row);
    }
    let mut passes = vec![Pass { name: "camera", row: RowKind::Pixel, product: "film" }];
    if stages.iter().any(|stage: &Stage| !stage.runs_in(RowKind::Pixel)) {
        passes.push(Pass { name: "light", row: RowKind::LightPath, product: "splats on the film" });
    }
    Plan { rows, stages, columns, tables, passes, view, statistics: requested::<Statistics>(scene).is_some() }
}

fn requested<'s, R: Component>(scene: &'s Census<'_>) -> Option<&'s R> {
    scene.entities::<With<R>>().first().and_then(|&entity| scene.get::<R>(entity))
}
