use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On the camera: what to keep of every pixel beside its radiance (auxiliary channels, AOVs).
///
/// Each layer becomes channels of the picture's OpenEXR file; without this component none of them exists.
#[derive(Component, Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Layers {
    /// The kinds to keep; one that is named twice is kept once.
    pub kinds: Vec<LayerKind>,
}

/// An auxiliary channel of a pixel.
///
/// Unless stated otherwise it is the mean over the samples whose camera ray hit a surface, and 0 if none did.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum LayerKind {
    /// The fraction of samples whose camera ray hit a surface.
    Coverage,
    /// The hit point in world space.
    Position,
    /// The geometric normal in world space, facing the ray.
    Normal,
    /// The geometric normal in camera space: x to the right, y up, z backward.
    NormalCamera,
    /// The shading normal in world space; the geometric normal if the shape has no other.
    ShadingNormal,
    /// The shading normal in camera space.
    ShadingNormalCamera,
    /// The surface's texture coordinates u and v.
    Uv,
    /// The material's albedo, linear Rec. 709.
    Albedo,
    /// The distance from the camera ray's origin, along the ray.
    DepthAlongRay,
    /// The distance from the camera along its viewing axis.
    DepthAlongAxis,
    /// The number of the shape that the pixel's first sample hit.
    Entity,
    /// The number of samples taken in the pixel.
    Samples,
    /// The variance of the pixel's mean radiance, estimated from its samples.
    Variance,
}

impl LayerKind {
    /// All kinds, in the order in which a file holds them.
    pub const ALL: [Self; 13] = [
        Self::Coverage,
        Self::Position,
        Self::Normal,
        Self::NormalCamera,
        Self::ShadingNormal,
        Self::ShadingNormalCamera,
        Self::Uv,
        Self::Albedo,
        Self::DepthAlongRay,
        Self::DepthAlongAxis,
        Self::Entity,
        Self::Samples,
        Self::Variance,
    ];

    /// Its name on the command line and in a file.
    pub fn word(self) -> &'static str {
        match self {
            Self::Coverage => "coverage",
            Self::Position => "position",
            Self::Normal => "normal",
            Self::NormalCamera => "normal_camera",
            Self::ShadingNormal => "shading_normal",
            Self::ShadingNormalCamera => "shading_normal_camera",
            Self::Uv => "uv",
            Self::Albedo => "albedo",
            Self::DepthAlongRay => "depth_along_ray",
            Self::DepthAlongAxis => "depth_along_axis",
            Self::Entity => "entity",
            Self::Samples => "samples",
            Self::Variance => "variance",
        }
    }

    /// The names of its channels: the layer's name, a dot, and a letter.
    ///
    /// The letters are those that OpenImageIO and compositors know: they keep X, Y, Z and R, G, B together and in
    /// order.
    pub fn channels(self) -> &'static [&'static str] {
        match self {
            Self::Coverage => &["coverage.A"],
            Self::Position => &["position.X", "position.Y", "position.Z"],
            Self::Normal => &["normal.X", "normal.Y", "normal.Z"],
            Self::NormalCamera => &["normal_camera.X", "normal_camera.Y", "normal_camera.Z"],
            Self::ShadingNormal => &["shading_normal.X", "shading_normal.Y", "shading_normal.Z"],
            Self::ShadingNormalCamera => {
                &["shading_normal_camera.X", "shading_normal_camera.Y", "shading_normal_camera.Z"]
            }
            Self::Uv => &["uv.U", "uv.V"],
            Self::Albedo => &["albedo.R", "albedo.G", "albedo.B"],
            Self::DepthAlongRay => &["depth_along_ray.Z"],
            Self::DepthAlongAxis => &["depth_along_axis.Z"],
            Self::Entity => &["entity.ID"],
            Self::Samples => &["samples.N"],
            Self::Variance => &["variance.R", "variance.G", "variance.B"],
        }
    }

    /// Whether it is a mean over the samples whose camera ray hit a surface.
    pub fn is_mean(self) -> bool {
        !matches!(self, Self::Coverage | Self::Entity | Self::Samples | Self::Variance)
    }
}

impl Layers {
    /// All kinds.
    pub fn all() -> Self {
        Self { kinds: LayerKind::ALL.to_vec() }
    }

    /// The kinds named in a comma-separated list, or all of them for `all`.
    ///
    /// Errors: a word that names no layer, in one sentence that lists those that exist.
    pub fn of_words(words: &str) -> Result<Self, String> {
        if words.trim() == "all" {
            return Ok(Self::all());
        }
        let kind = |word: &str| {
            LayerKind::ALL.into_iter().find(|kind| kind.word() == word.trim()).ok_or_else(|| {
                let known: Vec<&str> = LayerKind::ALL.iter().map(|kind| kind.word()).collect();
                format!("there is no layer `{}`; the layers are {}, or all", word.trim(), known.join(", "))
            })
        };
        Ok(Self { kinds: words.split(',').map(kind).collect::<Result<_, _>>()? })
    }
}
