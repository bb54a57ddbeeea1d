use super::ShapesOf;
use super::shape_kind::kind_evidence;
use crate::bvh::Bvh;
use crate::plan::{Census, Evidence, Table};
use crate::scene::SceneError;
use crate::shapes::{Listed, hierarchy_of};
use std::marker::PhantomData;

/// So few shapes of a kind are tested one after another: sixteen rays at a time are as fast as a hierarchy there.
const FEW: usize = 16;

/// The hierarchy over the shapes of one kind, in the order of their table.
#[derive(Clone, Debug, Default)]
pub struct HierarchyOf<S: Listed> {
    /// The hierarchy.
    pub bvh: Bvh,
    of: PhantomData<fn() -> S>,
}

impl<S: Listed> Table for HierarchyOf<S> {
    const NAME: &'static str = S::NAMES.hierarchy;

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let shapes = scene.table::<ShapesOf<S>>()?;
        Ok(Self { bvh: hierarchy_of(&shapes.row).unwrap_or_default(), of: PhantomData })
    }

    fn bytes(&self) -> usize {
        self.bvh.bytes()
    }
}

/// Evidence that there are so many shapes of a kind that a hierarchy over them saves time.
pub fn hierarchy_evidence<S: Listed>(scene: &Census<'_>) -> Evidence {
    let found = kind_evidence::<S>(scene);
    let many = S::IS_BOUNDED && found.count > FEW;
    Evidence { needed: found.needed && many, ..found }
}
