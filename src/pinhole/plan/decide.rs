use super::{Census, Column, ColumnKind, Evidence, Lifetime, RowKind, Stage, TableKind, TileSystems};
use crate::scene::{Statistics, View, printable};
use bevy_ecs::prelude::*;
use serde::Serialize;
use std::any::TypeId;
use std::collections::BTreeSet;
use thiserror::Error;

/// The reason why no plan can be made of these stages for this scene.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum PlanError {
    /// A kept stage reads a column that no kept stage writes.
    #[error("the stage \"{stage}\" reads the column `{column}`, but {why}")]
    NoProducer {
        /// The reader.
        stage: &'static str,
        /// The column that it reads.
        column: &'static str,
        /// Why no stage writes it.
        why: String,
    },
    /// A kept stage reads a column that is written only after the stage has run.
    #[error(
        "the stage \"{stage}\" reads the column `{column}`, but \"{writer}\" writes it only afterwards: it belongs \
         in an earlier set"
    )]
    WrittenAfterwards {
        /// The reader.
        stage: &'static str,
        /// What it reads.
        column: &'static str,
        /// The first stage that writes it.
        writer: &'static str,
    },
    /// A view asks for a column that does not exist here.
    #[error("the view asks for the column `{wanted}`, but {why}")]
    NoSuchView {
        /// The name that was given.
        wanted: String,
        /// The columns there are instead.
        why: String,
    },
}

/// One run over all batches of rows.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Pass {
    /// Its name.
    pub name: &'static str,
    /// What a row represents.
    pub row: RowKind,
    /// What it produces.
    pub product: &'static str,
}

/// One stage on offer, kept or dropped, with the reason.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PlanRow {
    /// The stage's name.
    pub stage: &'static str,
    /// Whether it will run.
    pub kept: bool,
    /// The reason, with the first entities that cause it.
    pub reason: String,
    /// The number of entities in use that cause it.
    #[serde(rename = "entities")]
    pub count: usize,
    /// The columns it will write.
    pub columns: Vec<&'static str>,
    /// The tables it will read.
    pub tables: Vec<&'static str>,
}

/// The stages that will run for a scene, those that will not, and the reasons.
#[derive(Clone, Debug)]
pub struct Plan {
    /// One row per stage on offer, in the order of the stages.
    pub rows: Vec<PlanRow>,
    /// The kept stages, in order.
    pub stages: Vec<Stage>,
    /// The columns that will exist, each a component of a tile's entity.
    pub columns: Vec<ColumnKind>,
    /// The tables that will exist, each a resource of a render world.
    pub tables: Vec<TableKind>,
    /// The tables that will not, although there is something to put into them, each with the reason.
    pub tables_left_out: Vec<(TableKind, String)>,
    /// The passes over the image and over light paths.
    pub passes: Vec<Pass>,
    /// The column that is painted instead of the picture.
    pub view: Option<ColumnKind>,
    /// Whether stages are timed and their rows counted.
    pub statistics: bool,
}

impl Plan {
    /// Whether a column of this type will exist.
    pub fn keeps<C: Column>(&self) -> bool {
        self.columns.contains(&ColumnKind::of::<C>())
    }
}

/// Decides which of the stages on offer a scene needs.
///
/// Deterministic and without side effects: the same scene and offer give the same plan.
/// Stages of one set run in the order of their places, whichever was offered first.
pub fn plan(scene: &Census<'_>, offer: &[Stage]) -> Result<Plan, PlanError> {
    let mut offer: Vec<&Stage> = offer.iter().collect();
    offer.sort_by_key(|stage| (stage.set, if stage.set.order_free() { 0 } else { stage.place }));
    let view = requested::<View>(scene).map(|view| find_view(&offer, &view.column)).transpose()?;
    let painters = offer.iter().filter(|stage| stage.reads_view);
    let over: Vec<ColumnKind> = painters.flat_map(|stage| &stage.writes).copied().collect();
    let painted = view.map(|column| Painted { column, over: &over });

    let mut wanted: BTreeSet<TypeId> = BTreeSet::new();
    let mut decided: Vec<Decided<'_>> = Vec::new();
    for stage in offer.iter().rev() {
        let later = decided.iter().any(|other| other.row.kept && other.stage.traces_further());
        let decision = decide(scene, stage, (painted, later), &wanted);
        if decision.row.kept {
            wanted.extend(stage.reads.iter().chain(&stage.reads_if).map(|column| column.id));
            let needed = stage.reads_where.iter().filter(|(_, predicate)| predicate(scene).needed);
            wanted.extend(needed.map(|(column, _)| column.id));
            wanted.extend(view.filter(|_| stage.reads_view).map(|column| column.id));
        }
        decided.push(decision);
    }
    decided.reverse();
    check_producers(&decided, view)?;
    Ok(collect(scene, decided, view))
}

/// A stage on offer and the decision about it.
struct Decided<'s> {
    stage: &'s Stage,
    row: PlanRow,
    /// The columns that it will write.
    columns: Vec<ColumnKind>,
    /// The tables that it will read.
    tables: Vec<TableKind>,
    /// Whether another stage does its work at the first bounce.
    from_second_bounce: bool,
}

/// The columns of these stages that a view may show, in order.
///
/// A view shows the first bounce, at which columns of path lifetime have accumulated nothing yet.
pub fn view_names(offer: &[Stage]) -> Vec<&'static str> {
    let mut offer: Vec<&Stage> = offer.iter().collect();
    offer.sort_by_key(|stage| stage.set);
    let mut columns = Vec::new();
    let seen = offer.iter().filter(|stage| stage.runs_in(RowKind::Pixel));
    for column in seen.flat_map(|stage| &stage.writes).filter(|column| column.is_viewed()) {
        if !columns.contains(column) {
            columns.push(*column);
        }
    }
    columns.iter().map(|column| column.name).collect()
}

/// A view, and what is painted over for it.
#[derive(Clone, Copy)]
struct Painted<'p> {
    column: ColumnKind,
    /// The columns that the stage which paints it writes.
    over: &'p [ColumnKind],
}

fn decide<'s>(
    scene: &Census<'_>,
    stage: &'s Stage,
    (view, traced_further): (Option<Painted<'_>>, bool),
    wanted: &BTreeSet<TypeId>,
) -> Decided<'s> {
    let evidence = (stage.when)(scene);
    let spared = if evidence.needed { (stage.spared_first)(scene) } else { Evidence::default() };
    let of_film = |column: &ColumnKind| column.lifetime == Lifetime::Film;
    let read = stage.writes.iter().filter(|column| wanted.contains(&column.id) || of_film(column));
    let read: Vec<ColumnKind> = read.copied().collect();
    let is_painted_over = |view: &Painted<'_>| {
        (!view.over.contains(&view.column) || !stage.runs_in(RowKind::Pixel))
            && !stage.reads_view
            && (matches!(stage.set, TileSystems::Step | TileSystems::RemainingBounces)
                || !stage.runs_in(RowKind::Pixel)
                || stage.writes.iter().all(|column| view.over.contains(column)))
    };
    let (kept, reason) = if !evidence.needed {
        (false, evidence.reason)
    } else if spared.needed && !traced_further {
        (false, spared.reason)
    } else if let Some(view) = view.filter(is_painted_over) {
        (false, format!("the view paints `{}` instead", view.column.name))
    } else if !read.is_empty() && spared.needed {
        (true, format!("{}; from the second bounce on: {}", evidence.reason, spared.reason))
    } else if !read.is_empty() {
        (true, evidence.reason)
    } else {
        let words: Vec<String> = stage.writes.iter().map(|column| format!("`{}`", column.name)).collect();
        (false, format!("nothing that runs reads {}", words.join(" or ")))
    };
    let columns = if kept { read } else { Vec::new() };
    let tables = if kept { stage.tables_for(scene, &columns) } else { Vec::new() };
    let row = PlanRow {
        stage: stage.name,
        kept,
        reason,
        count: if kept || !evidence.needed { evidence.count } else { 0 },
        columns: columns.iter().map(|column| column.name).collect(),
        tables: tables.iter().map(|table| table.name).collect(),
    };
    Decided { stage, row, columns, tables, from_second_bounce: spared.needed }
}

fn check_producers(decided: &[Decided<'_>], view: Option<ColumnKind>) -> Result<(), PlanError> {
    let mut written: BTreeSet<TypeId> = BTreeSet::new();
    for Decided { stage, columns, .. } in decided.iter().filter(|decision| decision.row.kept) {
        if let Some(column) = view.filter(|column| stage.reads_view && !written.contains(&column.id)) {
            return Err(PlanError::NoSuchView { wanted: column.name.into(), why: fate(decided, column) });
        }
        if let Some(&column) = stage.reads.iter().find(|column| !written.contains(&column.id)) {
            let why = fate(decided, column);
            return Err(PlanError::NoProducer { stage: stage.name, column: column.name, why });
        }
        let beside = stage.reads_if.iter().chain(stage.reads_where.iter().map(|(column, _)| column));
        // The film's columns hold the samples before this one.
        for column in beside.filter(|column| column.lifetime != Lifetime::Film && !written.contains(&column.id)) {
            if let Some(writer) = decided.iter().find(|other| other.columns.contains(column)) {
                let writer = writer.stage.name;
                return Err(PlanError::WrittenAfterwards { stage: stage.name, column: column.name, writer });
            }
        }
        written.extend(columns.iter().map(|column| column.id));
    }
    Ok(())
}

/// Why the stages that could have written a column do not run, in words.
///
/// Kinds of which the scene has no entity, not even a disabled one, are omitted where another kind has a reason to
/// give.
fn fate(decided: &[Decided<'_>], column: ColumnKind) -> String {
    let could = |stage: &Stage| stage.writes.contains(&column);
    let holds_none = |row: &PlanRow| row.reason.starts_with("0 ") && !row.reason.contains('"');
    let none_to_tell = !decided.iter().any(|other| could(other.stage) && !holds_none(&other.row));
    let writers: Vec<String> = decided
        .iter()
        .filter(|other| could(other.stage) && (none_to_tell || !holds_none(&other.row)))
        .map(|other| format!("\"{}\" is left out here ({})", other.row.stage, other.row.reason))
        .collect();
    match &writers[..] {
        [] => "no stage on offer writes it".into(),
        [one] => one.clone(),
        [one, other] => format!("{one} and {other}"),
        [first, between @ .., last] => format!("{first} and {last} and so are {} more that write it", between.len()),
    }
}

fn find_view(offer: &[&Stage], wanted: &str) -> Result<ColumnKind, PlanError> {
    let stages: Vec<Stage> = offer.iter().map(|&stage| stage.clone()).collect();
    let mut names = view_names(&stages);
    names.retain(|name| !name.ends_with(" rows"));
    let found = offer.iter().flat_map(|stage| &stage.writes).find(|column| column.name == wanted && column.is_viewed());
    found.copied().ok_or_else(|| PlanError::NoSuchView {
        wanted: printable(wanted, 40),
        why: format!("the columns on offer are {} and lists of rows", names.join(", ")),
    })
}

fn collect(scene: &Census<'_>, decided: Vec<Decided<'_>>, view: Option<ColumnKind>) -> Plan {
    let (mut columns, mut tables): (Vec<ColumnKind>, Vec<TableKind>) = (Vec::new(), Vec::new());
    let (mut stages, mut rows, mut tables_left_out) = (Vec::new(), Vec::new(), Vec::new());
    for decision in decided {
        for column in decision.columns {
            if !columns.contains(&column) {
                columns.push(column);
            }
        }
        for table in decision.tables {
            if !tables.contains(&table) {
                tables.push(table);
            }
        }
        if decision.row.kept {
            for left_out in decision.stage.tables_left_out(scene) {
                if !tables_left_out.contains(&left_out) {
                    tables_left_out.push(left_out);
                }
            }
            let from_second_bounce = decision.from_second_bounce;
            stages.push(Stage { from_second_bounce, ..decision.stage.clone() });
        }
        rows.push(decision.row);
    }
    let mut passes = vec![Pass { name: "camera", row: RowKind::Pixel, product: "film" }];
    if stages.iter().any(|stage: &Stage| !stage.runs_in(RowKind::Pixel)) {
        let are_photons = columns.iter().any(|column| column.name == "photons");
        let are_vertices = columns.iter().any(|column| column.name == "light vertices");
        let product = match (are_photons, are_vertices) {
            (true, _) => "photons for each sample",
            (_, true) => "vertices for each sample, and splats on the film",
            _ => "splats on the film",
        };
        passes.push(Pass { name: "light", row: RowKind::LightPath, product });
    }
    Plan {
        rows,
        stages,
        columns,
        tables,
        tables_left_out,
        passes,
        view,
        statistics: requested::<Statistics>(scene).is_some(),
    }
}

fn requested<'s, R: Component>(scene: &'s Census<'_>) -> Option<&'s R> {
    scene.entities::<With<R>>().first().and_then(|&entity| scene.get::<R>(entity))
}
