use super::camera_entity::camera_of;
use super::check::kind_and_name;
use crate::filters::{FilterCells, cells_of, check_filter};
use crate::plan::{Census, Table};
use crate::scene::{Filter, Sampling, SceneError};

/// The reconstruction filter, by which samples are distributed about a pixel's centre.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilterTable {
    /// The filter as the author wrote it.
    pub filter: Filter,
    /// Its table, where its sampling has no closed form; otherwise empty.
    pub cells: FilterCells,
}

impl Table for FilterTable {
    const NAME: &'static str = "filter";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let camera = camera_of(scene)?;
        let Some(&Sampling { filter, .. }) = scene.get::<Sampling>(camera) else { return Ok(Self::default()) };
        check_filter(&kind_and_name(scene, "camera", camera), filter)?;
        Ok(Self { filter, cells: cells_of(filter) })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(&self.cells.first[..]) + size_of_val(&self.cells.cells[..])
    }
}
