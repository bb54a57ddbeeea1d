use super::deeper_media::near_and_far;
use super::{DeeperMedia, Media};
use crate::extract::{GlassTable, NO_ROW};
use crate::intersect::SurfaceSides;
use crate::plan::Shared;
use crate::shade::MetallicRoughness;
use bevy_ecs::query::QueryData;

/// What is known of surfaces beside their colour: the media on both sides, where light is transmitted, and what images
/// give them.
#[derive(QueryData)]
pub struct InterfaceView {
    /// The sides on which surfaces were hit.
    sides: Option<&'static SurfaceSides>,
    /// The media that rays start in, where they may start in any.
    media: Option<&'static Media>,
    /// Those beyond the fourth.
    deeper: Option<&'static DeeperMedia>,
    /// Metallic and roughness, where images give them.
    mapped: Option<&'static MetallicRoughness>,
}

/// The same, with the table of the media.
pub(super) struct Interface<'a> {
    glass: Option<&'a GlassTable>,
    sides: Option<&'a SurfaceSides>,
    media: Option<&'a Media>,
    deeper: Option<&'a DeeperMedia>,
    mapped: Option<&'a MetallicRoughness>,
}

impl<'a> Interface<'a> {
    #[inline(always)]
    pub fn new(view: InterfaceViewItem<'a, '_>, glass: Option<&'a Shared<GlassTable>>) -> Self {
        let InterfaceViewItem { sides, media, deeper, mapped } = view;
        Self { glass: glass.map(|glass| &**glass), sides, media, deeper, mapped }
    }

    /// Whether images give metallic and roughness to any surface of the scene.
    #[inline(always)]
    pub fn is_mapped(&self) -> bool {
        self.mapped.is_some()
    }

    /// The same without what images give.
    #[inline(always)]
    pub fn unmapped(self) -> Self {
        Self { mapped: None, ..self }
    }

    /// The metallic and the roughness that an image gives a row's surface; none where no image does.
    #[inline(always)]
    pub fn mapped(&self, row: usize) -> Option<[f64; 2]> {
        self.mapped.and_then(|mapped| mapped.get(row))
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
