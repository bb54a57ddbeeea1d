use bevy_ecs::prelude::*;
use bevy_ecs::schedule::ScheduleLabel;
use serde::Serialize;

/// What one row of a batch represents in a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RowKind {
    /// A pixel, for paths from the camera.
    Pixel,
    /// A path that starts on a light.
    LightPath,
}

/// The schedule that takes one sample of every pixel of a tile from raster points to the film.
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash)]
pub struct Sample;

/// The schedule inside [`Sample`] that runs again for every further bounce.
#[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash)]
pub struct Bounce;

/// The order of the stages: the plan lists each set's after those of the set above it, and a schedule runs them so.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum TileSystems {
    /// Raster points, in pixels.
    Raster,
    /// The same points in normalised device coordinates, independent of the resolution.
    Ndc,
    /// The same points on the screen, with y up and the image's aspect ratio.
    Screen,
    /// The other random parameters of each camera ray, such as its point on the lens.
    Lens,
    /// Rays in camera space: the camera is at the origin and looks down −z.
    Camera,
    /// The same rays in world axes.
    World,
    /// Columns are cleared before anything is hit.
    Start,
    /// Rays are intersected with shapes, each kind of which keeps the closest hit, in any order.
    Intersect,
    /// Surfaces that coincide with a hit on glass within rounding are found, and hit or crossed in one event.
    Contact,
    /// The rows of each kind of shape and material are listed.
    Classify,
    /// Position, normal and error bound of each hit; every kind of shape fills its own rows.
    Surface,
    /// Shading normals, where they differ from the geometric ones.
    Normal,
    /// The footprint of each pixel on the surface that it sees.
    Footprint,
    /// Each surface's own colour and texture coordinates.
    Colour,
    /// Textures are evaluated for their own rows, in any order.
    Texture,
    /// Colours are multiplied by what the mesh and the material make of them.
    Tint,
    /// The radiance of rays that hit nothing.
    Background,
    /// Layers of the film are recorded, before the path is traced further.
    Layers,
    /// The medium along each ray is determined.
    Media,
    /// Throughput is multiplied by the transmittance along each ray.
    Absorb,
    /// Points on the camera's lens to which light paths are connected.
    Join,
    /// Lights are sampled: shadow rays from surfaces towards them.
    SampleLights,
    /// Shadow rays are set to unblocked.
    ClearShadows,
    /// Shadow rays are intersected with shapes, each kind of which keeps the closest hit, in any order.
    TraceShadowRays,
    /// The light of shadow rays is multiplied by the transmittance along them.
    AbsorbShadowRays,
    /// Light samples are weighted against BSDF sampling.
    MisWeights,
    /// The radiance of emission and of direct light is added up.
    Shade,
    /// BSDFs are sampled for further rays, one kind of material after another.
    SampleBsdfs,
    /// Some paths are terminated by Russian roulette.
    Roulette,
    /// The radiance of this bounce is added to its path's light.
    AddBounce,
    /// The scattered rays become those of the next bounce.
    Step,
    /// All further bounces, each running the sets from `Start` to `Step` again.
    RemainingBounces,
    /// The light of all bounces becomes the radiance of the first.
    SumBounces,
    /// Pixels outside a camera's image circle are blackened.
    Mask,
    /// A requested column is painted in place of the picture.
    View,
    /// The deviation of radiance from the film's mean is accumulated, before the radiance itself.
    Moments,
    /// Radiance is added to the film's sums.
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
        Self::Contact,
        Self::Classify,
        Self::Surface,
        Self::Normal,
        Self::Footprint,
        Self::Colour,
        Self::Texture,
        Self::Tint,
        Self::Background,
        Self::Layers,
        Self::Media,
        Self::Absorb,
        Self::Join,
        Self::SampleLights,
        Self::ClearShadows,
        Self::TraceShadowRays,
        Self::AbsorbShadowRays,
        Self::MisWeights,
        Self::Shade,
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

    /// Whether the stages of this set run at every bounce.
    pub fn on_every_bounce(self) -> bool {
        (Self::Start..=Self::Step).contains(&self) && self != Self::Layers && self != Self::Footprint
    }

    /// The passes that the stages of this set run in: surfaces treat paths from the camera and from lights alike.
    pub fn passes(self) -> &'static [RowKind] {
        let of_camera =
            matches!(self, Self::Background | Self::Layers | Self::Footprint | Self::SampleLights | Self::MisWeights);
        let on_both = (Self::Start..=Self::RemainingBounces).contains(&self) && !of_camera && self != Self::AddBounce;
        if on_both { &[RowKind::Pixel, RowKind::LightPath] } else { &[RowKind::Pixel] }
    }

    /// Whether the systems of this set may run in any order, because each keeps the closest hit or fills rows
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
