use super::shape_kind::{listed_kinds, shape_entities};
use super::uv_space::UvSpaceTable;
use crate::plan::{Census, Table};
use crate::scene::SceneError;
use crate::shapes::UvSlope;

/// The gradients of u and v along each shape, in the order of the shapes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UvSlopes {
    /// One for each shape.
    pub slope: Vec<UvSlope>,
}

impl Table for UvSlopes {
    const NAME: &'static str = "uv slopes";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let spaces = scene.table::<UvSpaceTable>()?;
        let mut slope = vec![UvSlope::Nowhere; shape_entities(scene).len()];
        for listed in listed_kinds(scene) {
            (listed.fill_uv_slopes)(scene, &spaces.uv_from_world, &mut slope)?;
        }
        Ok(Self { slope })
    }

    fn bytes(&self) -> usize {
        self.slope.len() * size_of::<UvSlope>()
    }
}
