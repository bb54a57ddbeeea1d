use super::{EmissionMapTable, EnvironmentTable, ImageTable, MetallicRoughnessTable, NormalMapTable, Pyramid};
use crate::plan::Census;
use crate::scene::SceneError;
use std::collections::BTreeSet;
use std::sync::Arc;

/// What was done to the texels of a scene's images so that they can be used, one sentence each, each once.
///
/// Errors: an image that cannot be used.
pub fn image_remarks(scene: &Census<'_>) -> Result<Vec<String>, SceneError> {
    fn of(pyramids: &[Arc<Pyramid>]) -> impl Iterator<Item = String> {
        pyramids.iter().flat_map(|image| image.remarks.iter().cloned())
    }
    let mut said = Vec::new();
    said.extend(of(&scene.table::<ImageTable>()?.pyramid));
    said.extend(of(&scene.table::<MetallicRoughnessTable>()?.images.pyramid));
    said.extend(of(&scene.table::<EmissionMapTable>()?.images.pyramid));
    said.extend(scene.table::<NormalMapTable>()?.image.iter().flat_map(|image| image.remarks.iter().cloned()));
    said.extend(scene.table::<EnvironmentTable>()?.remarks.iter().cloned());
    let mut seen = BTreeSet::new();
    said.retain(|sentence| seen.insert(sentence.clone()));
    Ok(said)
}
