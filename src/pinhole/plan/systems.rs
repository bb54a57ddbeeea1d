use bevy_ecs::prelude::*;
use bevy_ecs::schedule::ScheduleLabel;
use serde::Serialize;

/// What one row of a batch stands for in a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RowKind {
    /// A pixel, seen from the camera.
    Pixel,
    /// A path that starts on a light.
    LightPath,
}

/// The schedule that carries one sample of every pixel of a tile from raster to film.
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash)]
pub struct Sample;

/// The schedule inside [`Sample`] that is run again for every further leg of the light's way.
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash)]
pub struct Bounce;

/// The order of the stages: each set runs after the one above it.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum TileSystems {
    /// Points of the image, in pixels.
    Raster,
    /// The same points, free of the image's size.
    Ndc,
    /// The same points, y up, as wide as the image's shape.
    Screen,
    /// What else of each camera ray is left to chance: where on the lens it starts.
    Lens,
    /// Rays of a camera at the origin that looks down −z.
    Camera,
    /// The same rays, turned as the camera is.
    World,
    /// Empty hits and black radiance, before anything is met.
    Start,
    /// Rays meet surfaces; each kind of shape narrows the hit, in any order.
    Intersect,
    /// The rows of each kind of shape and matter are listed.
    Classify,
    /// Position, normal and error bound of what was hit; each kind fills its own rows.
    Surface,
    /// Normals by which light falls, where they are not the surfaces' own.
    Normal,
    /// What a pixel covers of the surface.
    Footprint,
    /// Each surface's own colour, and where on its texture it is.
    Colour,
    /// Textures colour their own rows, in any order.
    Texture,
    /// What a ray that met nothing brings back.
    Background,
    /// What else is asked of a pixel is taken down, before the light goes on its way.
    Layers,
    /// Where on the camera's lens light is joined to it.
    Join,
    /// Rays from surfaces towards lights.
    SampleLights,
    /// Every light counts as seen, before anything is met on the way to it.
    ClearShadows,
    /// Shadow rays meet what stands in between; each kind of shape narrows the hit, in any order.
    TraceShadowRays,
    /// Light that chance may find too counts for less.
    MisWeights,
    /// Light that arrives is added up.
    Shade,
    /// What each ray has come through is known.
    Media,
    /// What light lost on its way here is taken off.
    Absorb,
    /// Rays go on from surfaces, each kind of matter's after the other's.
    SampleBsdfs,
    /// Some of them end by chance.
    Roulette,
    /// What the leg brought is added to its way's light.
    AddBounce,
    /// The scattered rays become those of the next leg.
    Step,
    /// All further legs, each the sets from `Start` to `Step` again.
    RemainingBounces,
    /// The light of all legs becomes the radiance of the first.
    SumBounces,
    /// What lies outside a camera's image circle is made black.
    Mask,
    /// Where a reader asked to see a column, it is painted instead.
    View,
    /// How far radiance lies from the mean of what the film holds, before it joins.
    Moments,
    /// Radiance joins the film's sums.
    Film,
}

impl TileSystems {
    /// All sets in order.
    pub const ALL: &[Self] = &[
        Self::Raster,
        Self::Ndc,
        Self::Screen,
        Self::Lens,
        Self::Camera,
        Self::World,
        Self::Start,
        Self::Intersect,
        Self::Classify,
        Self::Surface,
        Self::Normal,
        Self::Footprint,
        Self::Colour,
        Self::Texture,
        Self::Background,
        Self::Layers,
        Self::Join,
        Self::SampleLights,
        Self::ClearShadows,
        Self::TraceShadowRays,
        Self::MisWeights,
        Self::Shade,
        Self::Media,
        Self::Absorb,
        Self::SampleBsdfs,
        Self::Roulette,
        Self::AddBounce,
        Self::Step,
        Self::RemainingBounces,
        Self::SumBounces,
        Self::Mask,
        Self::View,
        Self::Moments,
        Self::Film,
    ];

    /// Whether the stages of this set run on every leg of light's way.
    pub fn on_every_bounce(self) -> bool {
        (Self::Start..=Self::Step).contains(&self) && self != Self::Layers && self != Self::Footprint
    }

    /// The passes that the stages of this set run in: what light does at surfaces is the same whichever way it is followed.
    pub fn passes(self) -> &'static [RowKind] {
        let of_camera =
            matches!(self, Self::Background | Self::Layers | Self::Footprint | Self::SampleLights | Self::MisWeights);
        let on_both = (Self::Start..=Self::RemainingBounces).contains(&self) && !of_camera && self != Self::AddBounce;
        if on_both { &[RowKind::Pixel, RowKind::LightPath] } else { &[RowKind::Pixel] }
    }

    /// Whether the systems of this set may run in any order among themselves, because each narrows or fills rows
    /// independently of the others.
    pub fn order_free(self) -> bool {
        matches!(
            self,
            Self::Lens
                | Self::Start
                | Self::Intersect
                | Self::Surface
                | Self::Footprint
                | Self::Colour
                | Self::Texture
                | Self::TraceShadowRays
        )
    }
}
