use super::media::near_and_far;
use super::{DeeperMedia, Media};
use crate::each::Each;
use crate::extract::{GlassTable, NO_ROW};
use crate::intersect::{Contacts, GlassCrossing, SurfaceSides};
use crate::material::{fresnel, layered_reflectance};
use crate::plan::Shared;
use crate::rays::Wavelengths;
use bevy_ecs::query::QueryData;

/// What is known of the media on both sides of surfaces, where light is transmitted.
#[derive(QueryData)]
pub struct InterfaceView {
    /// The sides on which surfaces were hit.
    sides: Option<&'static SurfaceSides>,
    /// The media that rays start in, where they may start in any.
    media: Option<&'static Media>,
    /// Those beyond the fourth.
    deeper: Option<&'static DeeperMedia>,
    /// The surfaces that are crossed together with them, where any may coincide.
    contacts: Option<&'static Contacts>,
    /// The wavelengths of the rays, where any glass disperses light.
    wavelengths: Option<&'static Wavelengths>,
}

/// The same, with the table of the media.
pub(super) struct Interface<'a> {
    glass: Option<&'a GlassTable>,
    sides: Option<&'a SurfaceSides>,
    media: Option<&'a Media>,
    deeper: Option<&'a DeeperMedia>,
    contacts: Option<&'a Contacts>,
    wavelengths: Option<&'a Wavelengths>,
}

impl<'a> Interface<'a> {
    #[inline(always)]
    pub fn new(view: InterfaceViewItem<'a, '_>, glass: Option<&'a Shared<GlassTable>>) -> Self {
        let InterfaceViewItem { sides, media, deeper, contacts, wavelengths } = view;
        Self { glass: glass.map(|glass| &**glass), sides, media, deeper, contacts, wavelengths }
    }

    /// The media on the near and the far side of a row's surface, where `own` fills the shape; without a column of
    /// media, everything outside it is a vacuum.
    #[inline(always)]
    pub fn media(&self, own: u32, row: usize) -> [u32; 2] {
        let Some(sides) = self.sides else { return [self.media.map_or(NO_ROW, |media| media.get(row).top()); 2] };
        let from_outside = sides.outside[row] != 0;
        match (self.media, self.glass) {
            (Some(media), Some(glass)) if own != NO_ROW => {
                let (crossings, beyond) = (self.crossings(row), self.beyond_fourth(row));
                if !crossings.is_empty() {
                    let near = media.get(row);
                    return [near.top(), near.top_beyond(beyond, crossings.iter(), &glass.priority)];
                }
                near_and_far(media.get(row), beyond, own, from_outside, &glass.priority)
            }
            (Some(media), _) => [media.get(row).top(); 2],
            _ if from_outside => [NO_ROW, own],
            _ => [own, NO_ROW],
        }
    }

    /// The relative index η at a row's surface, the far side's over the near side's, where `own` fills the shape.
    #[inline(always)]
    pub fn eta(&self, own: u32, row: usize) -> f64 {
        let (Some(glass), Some(_)) = (self.glass, self.sides) else { return 1.0 };
        let [near, far] = self.media(own, row).each(|of| self.index(glass, of, row));
        far / near
    }

    /// The index of a medium for a row's ray: at its wavelength, where it has one.
    #[inline(always)]
    fn index(&self, glass: &GlassTable, of: u32, row: usize) -> f64 {
        match self.wavelengths {
            _ if of == NO_ROW => 1.0,
            None => glass.ior[of as usize],
            Some(wavelengths) => glass.index_at(of, wavelengths.nm(row)),
        }
    }

    /// Whether light of each wavelength goes its own way from a row's surface, where `own` fills the shape.
    #[inline(always)]
    pub fn disperses(&self, own: u32, row: usize) -> bool {
        let Some(glass) = self.glass else { return false };
        let [near, far] = self.media(own, row);
        near != far && (glass.disperses(near) || glass.disperses(far))
            || self.crossings(row).iter().any(|other| glass.disperses(other.glass))
    }

    /// The media around a row's ray origin beyond the fourth.
    #[inline(always)]
    fn beyond_fourth(&self, row: usize) -> &[u32] {
        self.deeper.map_or(&[], |deeper| deeper.0.get(row))
    }

    /// The surfaces that a row's ray crosses in one event; none where it crosses its hit alone.
    #[inline(always)]
    fn crossings(&self, row: usize) -> &[GlassCrossing] {
        self.contacts.map_or(&[], |contacts| contacts.crossings.get(row))
    }

    // ANCHOR: layers
    /// The reflectance of a row's surface for a ray with this cosine to its normal, where layers too thin to be kept apart
    /// lie there: the surfaces of those layers reflect one after the other.
    ///
    /// A layer is a body that is entered and left in one event; between bodies that touch there is none.
    #[inline(always)]
    pub fn reflectance(&self, row: usize, cosine: f64) -> Option<f64> {
        let crossings = self.crossings(row);
        let is_left = |glass: u32| crossings.iter().any(|other| other.glass == glass && !other.from_outside);
        let mut layers = crossings.iter().filter(|own| own.from_outside && is_left(own.glass)).peekable();
        let (Some(media), Some(glass)) = (self.media.filter(|_| layers.peek().is_some()), self.glass) else {
            return None;
        };
        let (near, deeper, priorities) = (media.get(row), self.beyond_fourth(row), &glass.priority);
        // What is on both sides is there in the layers, too.
        let within = layers.map(|layer| {
            let left = crossings.iter().filter(|own| !own.from_outside && own.glass != layer.glass);
            near.top_beyond(deeper, left.chain([layer]), priorities)
        });
        let far = near.top_beyond(deeper, crossings.iter(), priorities);
        let media = std::iter::once(near.top()).chain(within).chain([far]);
        let indices = media.map(|of| self.index(glass, of, row));
        let first = self.index(glass, near.top(), row);
        let mut last = None;
        let surfaces = indices.filter_map(|index| {
            let before = last.replace(index)?;
            // Snell's law: n sin θ is the same in all layers.
            let sine = first / before * (1.0 - cosine * cosine).max(0.0).sqrt();
            Some(if sine < 1.0 { fresnel((1.0 - sine * sine).sqrt(), index / before) } else { 1.0 })
        });
        Some(layered_reflectance(surfaces))
    }
    // ANCHOR_END: layers
}
