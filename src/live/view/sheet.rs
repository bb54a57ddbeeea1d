use super::look::{Look, Region};
use super::modes::MODES;
use super::orbit::CameraAt;
use super::painted::{ColumnRow, QUANTITIES};
use pinhole::plan::PlanRow;
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
    pub columns: Vec<ColumnRow>,
    /// The numbers of the picture that can be, each with its unit.
    pub quantities: Vec<(&'static str, &'static str)>,
    /// What is painted, as an order names it.
    pub column: Option<String>,
    /// The curves by their words.
    pub curves: Vec<&'static str>,
    /// How the film is shown.
    pub look: Look,
    /// What it can be compared with.
    pub reference: Option<String>,
    /// Whether no further samples are taken.
    pub paused: bool,
    /// Where alone further samples are taken.
    pub region: Option<Region>,
    /// Whether the page has asked for a size.
    pub fills: bool,
    /// The pixels that are read with every frame.
    pub pins: Vec<[f64; 2]>,
    /// The camera where it has been moved.
    pub camera: Option<CameraAt>,
    /// How many steps can be taken back, and forward again.
    pub undo: [usize; 2],
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

/// The numbers of the picture, each with its unit.
pub fn quantities() -> Vec<(&'static str, &'static str)> {
    QUANTITIES.iter().map(|&(name, _, unit)| (name, unit)).collect()
}
