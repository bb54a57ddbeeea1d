use super::modes::MODES;
use pinhole::plan::{Plan, PlanRow};
use serde::Serialize;

/// What can be chosen on the page, and what is chosen.
#[derive(Serialize)]
pub struct Sheet {
    /// The scene's name.
    pub scene: String,
    /// Its text.
    pub text: String,
    /// The size of the whole picture.
    pub size: [u32; 2],
    /// The modes, each with its key.
    pub modes: Vec<(char, &'static str)>,
    /// The key of the chosen mode.
    pub mode: char,
    /// The columns that can be painted.
    pub columns: Vec<&'static str>,
    /// The one that is painted.
    pub column: Option<String>,
    /// The stages on offer, and those taken out of it.
    pub stages: Vec<StageRow>,
    /// The number of changes so far.
    pub change: u64,
}

/// A stage in the table.
#[derive(Serialize)]
pub struct StageRow {
    name: &'static str,
    kept: bool,
    offered: bool,
    reason: String,
}

impl StageRow {
    /// A stage that was offered to the plan.
    pub fn offered(row: &PlanRow) -> Self {
        Self { name: row.stage, kept: row.kept, offered: true, reason: row.reason.clone() }
    }

    /// A stage that was not.
    pub fn taken_out(name: &'static str) -> Self {
        Self { name, kept: false, offered: false, reason: "taken out of the offer".into() }
    }
}

/// All modes as the page lists them.
pub fn modes() -> Vec<(char, &'static str)> {
    MODES.iter().map(|mode| (mode.key, mode.name)).collect()
}

/// The columns of a plan that can be painted.
pub fn columns(plan: &Plan) -> Vec<&'static str> {
    plan.columns.iter().filter(|column| column.is_viewed()).map(|column| column.name).collect()
}
