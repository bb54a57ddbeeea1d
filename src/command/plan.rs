use super::error::Result;
use super::format::{Format, print_json};
use super::options::SceneOptions;
use super::subject::Subject;
use pinhole::plan::{Census, ColumnKind, Lifetime, Pass, PlanRow};
use pinhole::render::prepare;
use pinhole_lab::review::plan_text;
use serde::Serialize;
use serde_json::{Value, json};
use std::io::Write;

/// The plan of a scene.
pub fn print_plan(subject: &Subject<'_>, options: &SceneOptions, format: Format, out: &mut dyn Write) -> Result {
    let asked = options.asked(false);
    let (world, stages) = (subject.world(&asked), subject.stages());
    let placed = |error| subject.placed(error, &asked);
    if !format.is_json() {
        write!(out, "{}", plan_text(subject.name(), subject.title(), &world, &stages).map_err(placed)?)?;
        return Ok(());
    }
    let (plan, tables) = prepare(&Census::of(&world), &stages).map_err(placed)?;
    let columns: Vec<PlannedColumn> = plan.columns.iter().map(PlannedColumn::of).collect();
    let planned = Planned {
        scene: subject.name(),
        title: subject.title(),
        passes: &plan.passes,
        stages: &plan.rows,
        column_bytes_per_row: columns.iter().map(|column| column.bytes_per_row).sum(),
        columns,
        tables: tables.iter().map(|table| json!({ "name": table.name, "bytes": table.bytes })).collect(),
        table_bytes: tables.iter().map(|table| table.bytes).sum(),
        view: plan.view.map(|column| column.name),
        statistics: plan.statistics,
    };
    print_json(&planned, out)
}

#[derive(Serialize)]
struct Planned<'a> {
    scene: &'a str,
    title: &'a str,
    passes: &'a [Pass],
    stages: &'a [PlanRow],
    columns: Vec<PlannedColumn>,
    column_bytes_per_row: usize,
    tables: Vec<Value>,
    table_bytes: usize,
    view: Option<&'static str>,
    statistics: bool,
}

#[derive(Serialize)]
struct PlannedColumn {
    name: &'static str,
    space: &'static str,
    unit: &'static str,
    lifetime: Lifetime,
    bytes_per_row: usize,
}

impl PlannedColumn {
    fn of(column: &ColumnKind) -> Self {
        let ColumnKind { name, space, unit, lifetime, .. } = *column;
        Self { name, space, unit, lifetime, bytes_per_row: column.bytes_a_row() }
    }
}
