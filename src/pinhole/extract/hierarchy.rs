use super::ShapesOf;
use super::shape_kind::kind_evidence;
use crate::bvh::Bvh;
use crate::plan::{Census, Evidence, Table, counted};
use crate::scene::SceneError;
use crate::shapes::{Listed, hierarchy_of};
use std::marker::PhantomData;

/// The hierarchy over the opaque shapes of one kind, in the order of their table.
#[derive(Clone, Debug, Default)]
pub struct HierarchyOf<S: Listed> {
    /// The hierarchy; none where a shape has no bounding box.
    pub bvh: Option<Bvh>,
    of: PhantomData<fn() -> S>,
}

impl<S: Listed> Table for HierarchyOf<S> {
    const NAME: &'static str = S::NAMES.hierarchy;

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let shapes = scene.table::<ShapesOf<S>>()?;
        let opaque = shapes.opaque().0;
        Ok(Self { bvh: if opaque.is_empty() { None } else { hierarchy_of(opaque) }, of: PhantomData })
    }

    fn bytes(&self) -> usize {
        self.bvh.as_ref().map_or(0, Bvh::bytes)
    }
}

/// Evidence that there are so many shapes of a kind that a hierarchy over them saves time.
pub fn hierarchy_evidence<S: Listed>(scene: &Census<'_>) -> Evidence {
    let found = kind_evidence::<S>(scene);
    if !(S::IS_BOUNDED && found.needed) {
        return Evidence { needed: false, count: 0, ..found };
    }
    let needed = found.count >= S::HIERARCHY_FROM;
    let those = counted(found.count, S::NOUN);
    let reason = match found.count {
        _ if needed => found.reason,
        1 => format!("{those} is tested alone"),
        _ => format!("{those} are tested one by one"),
    };
    Evidence { needed, reason, ..found }
}
