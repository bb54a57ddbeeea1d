use super::deeper_media::near_and_far;
use super::{DeeperMedia, Media};
use crate::extract::{GlassTable, NO_ROW};
use crate::intersect::SurfaceSides;
use crate::plan::Shared;
use bevy_ecs::query::QueryData;

/// What is known of the media on both sides of surfaces; exists where a surface transmits light.
#[derive(QueryData)]
pub struct InterfaceView {
    /// The sides on which surfaces were hit.
    sides: Option<&'static SurfaceSides>,
    /// The media that rays start in, where they may start in any.
    media: Option<&'static Media>,
    /// Those beyond the fourth.
    deeper: Option<&'static DeeperMedia>,
}

/// The same, with the table of the media.
pub(super) struct Interface<'a> {
    glass: Option<&'a GlassTable>,
    sides: Option<&'a SurfaceSides>,
    media: Option<&'a Media>,
    deeper: Option<&'a DeeperMedia>,
}

impl<'a> Interface<'a> {
    #[inline(always)]
    pub fn new(view: InterfaceViewItem<'a, '_>, glass: Option<&'a Shared<GlassTable>>) -> Self {
        let InterfaceViewItem { sides, media, deeper } = view;
        Self { glass: glass.map(|glass| &**glass), sides, media, deeper }
    }

    /// The relative index η at a row's surface, the far side's over the near side's, where `own` fills the shape;
    /// without a column of media, everything outside it is a vacuum.
    #[inline(always)]
    pub fn eta(&self, own: u32, row: usize) -> f64 {
        let (Some(glass), Some(sides)) = (self.glass, self.sides) else { return 1.0 };
        let from_outside = sides.outside[row] != 0;
        let ior = |of: u32| if of == NO_ROW { 1.0 } else { glass.ior[of as usize] };
        match self.media {
            Some(media) => {
                let beyond = self.deeper.map_or(&[][..], |deeper| deeper.get(row));
                let [near, far] = near_and_far(media.get(row), beyond, own, from_outside, &glass.priority);
                ior(far) / ior(near)
            }
            None if from_outside => ior(own),
            None => 1.0 / ior(own),
        }
    }
}
