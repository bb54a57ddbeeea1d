//! What is counted while the test rays of [`super::pilot`] are traced.

use crate::intersect::{Hits, NO_SHAPE};
use crate::plan::{Column, ColumnKind, Stage};
use crate::rays::{Depth, Tile};
use crate::render::Hook;
use crate::shade::{ShadowHits, ShadowRays};
use bevy_ecs::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// After this many bounces few rays are left, and they say little about what is wrong with a scene.
const MAX_DEPTH: u32 = 4;

/// What a hook has counted in one tile so far.
#[derive(Resource, Clone, Debug, Default)]
pub(super) struct Counted {
    /// The shapes that camera rays hit.
    pub(super) first: Vec<u32>,
    /// Shadow rays at each bounce.
    pub(super) to_lights: BTreeMap<u32, usize>,
    /// At each bounce, how many shadow rays each shape blocks.
    pub(super) blocked: BTreeMap<u32, BTreeMap<u32, usize>>,
    /// At each bounce, counted from 0, the number of rays and of those that hit nothing.
    pub(super) bounces: BTreeMap<u32, [usize; 2]>,
}

impl Counted {
    /// All rays that were counted.
    pub(super) fn rays(&self) -> usize {
        self.bounces.values().map(|[rays, _]| rays).sum()
    }
}

/// Counts what camera rays hit and, during the first bounces, which shapes block shadow rays.
///
/// Several stages write each of the two columns, so the last count of a bounce is the final one.
pub(super) fn counting_hook() -> Hook {
    Arc::new(|_, stage: &Stage, _| {
        let [writes_hits, writes_shadows] =
            [ColumnKind::of::<Hits>(), ColumnKind::of::<ShadowHits>()].map(|column| stage.writes.contains(&column));
        let count = move |world: &mut World,
                          tiles: &mut QueryState<
            (&Depth, Option<&Hits>, Option<(&ShadowRays, &ShadowHits)>),
            With<Tile>,
        >| {
            if !(writes_hits || writes_shadows) {
                return;
            }
            let mut counted = world.remove_resource::<Counted>().unwrap_or_default();
            let (mut missed, mut rows, mut to_lights, mut blocked) = (0, 0, 0, BTreeMap::new());
            let (mut depth, mut shapes) = (0, Vec::new());
            for (own, hit, light) in tiles.iter(world) {
                depth = own.0;
                if let Some(hit) = hit {
                    rows += hit.rows();
                    missed += hit.shape.iter().filter(|&&shape| shape == NO_SHAPE).count();
                    shapes.extend_from_slice(&hit.shape);
                }
                if let Some((rays, shadows)) = light {
                    to_lights += rays.rows();
                    for &shape in shadows.shape.iter().filter(|&&shape| shape != NO_SHAPE) {
                        *blocked.entry(shape).or_default() += 1;
                    }
                }
            }
            if writes_hits && depth == 0 {
                counted.first = shapes;
            }
            if writes_hits {
                counted.bounces.insert(depth, [rows, missed]);
            }
            if writes_shadows && depth < MAX_DEPTH {
                counted.to_lights.insert(depth, to_lights);
                counted.blocked.insert(depth, blocked);
            }
            world.insert_resource(counted);
        };
        count.into_configs()
    })
}
