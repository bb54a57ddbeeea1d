//! What stands beside a camera: how many pixels a picture has, how they are sampled and filtered, and what is asked of it.

use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// The number of pixels of a camera's image, from which its aspect ratio follows.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Resolution {
    /// Pixels from left to right, at least 1.
    pub width: u32,
    /// Pixels from top to bottom, at least 1.
    pub height: u32,
}

impl Default for Resolution {
    fn default() -> Self {
        Self { width: 480, height: 270 }
    }
}

/// On the camera: how many samples each pixel gets, and where in the pixel they lie.
///
/// A camera without it traces one ray through each pixel's centre.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sampling {
    /// Samples per pixel, from 1 to 16777216.
    pub samples: u32,
    /// The seed of all random numbers.
    pub seed: u64,
    /// Which sampler the random numbers come from.
    pub sampler: Sampler,
    /// The reconstruction filter.
    pub filter: Filter,
}

impl Default for Sampling {
    fn default() -> Self {
        Self { samples: 16, seed: 0, sampler: Sampler::default(), filter: Filter::default() }
    }
}

/// A source of sample points in the unit hypercube, as in PBRT.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Sampler {
    /// Independent uniform random numbers.
    Independent,
    /// Stratified: one jittered point in each cell of a grid.
    Stratified,
    /// The Sobol sequence with Owen scrambling: well distributed at any number of samples.
    #[default]
    Sobol,
}

impl Sampler {
    /// All samplers, each with its word on the command line.
    pub const ALL: [(&str, Self); 3] =
        [("sobol", Self::Sobol), ("stratified", Self::Stratified), ("independent", Self::Independent)];
}

/// The number of samples per pixel at which sampling stops if only a time or an error was asked for.
pub const OPEN_END: u32 = 65_536;

/// On the camera, beside `Sampling`: adaptive sampling, in which each pixel gets as many samples as its noise requires.
///
/// The error of a pixel is the standard error of its mean radiance, relative to that radiance:
/// √(V / n) / √(L² + 0.01), where V is the variance of a sample and L² the square of the mean, each averaged over red,
/// green and blue, and n the number of samples; its square is the relMSE that the pixel is expected to have.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Adaptive {
    /// The target error of each pixel, above 0 and at most 1.
    pub error: f64,
    /// Samples per pixel in the pilot pass, from which a pixel's number of samples is decided; at least 4, discarded
    /// afterwards.
    pub pilot: u32,
}

impl Default for Adaptive {
    fn default() -> Self {
        Self { error: 0.01, pilot: 16 }
    }
}

/// A reconstruction filter: a sample's weight by its offset from the pixel's centre, a separable product over x and y.
///
/// Beyond its radius, in pixels, a filter is zero; a larger radius blurs more and passes less of the detail that is
/// finer than a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Filter {
    /// Constant: with a radius of 0.5, the pixel's own square.
    Box {
        /// In pixels.
        #[serde(default = "half")]
        radius: f64,
    },
    /// Linear falloff.
    Tent {
        /// In pixels.
        #[serde(default = "one")]
        radius: f64,
    },
    /// The Gaussian, shifted down so that it ends at zero.
    Gaussian {
        /// In pixels.
        #[serde(default = "one_and_a_half")]
        radius: f64,
        /// The standard deviation in pixels.
        #[serde(default = "half")]
        sigma: f64,
    },
    /// Piecewise cubic, with negative lobes that sharpen (Mitchell and Netravali 1988).
    Mitchell {
        /// In pixels.
        #[serde(default = "two")]
        radius: f64,
        /// B: more blurs more; from 0 to 1.
        #[serde(default = "third")]
        b: f64,
        /// C: more sharpens more, and rings more; from 0 to 1, with no negative lobes at 0.
        #[serde(default = "third")]
        c: f64,
    },
    /// The Blackman–Harris window, a sum of three cosines (Harris 1978).
    BlackmanHarris {
        /// In pixels.
        #[serde(default = "one_and_a_half")]
        radius: f64,
    },
}

impl Filter {
    /// The pixel's own square, with constant weight.
    pub const BOX: Self = Self::Box { radius: half() };
    /// A tent that ends at the centres of the neighbouring pixels.
    pub const TENT: Self = Self::Tent { radius: one() };
    /// The default: non-negative, with little aliasing left.
    pub const GAUSSIAN: Self = Self::Gaussian { radius: one_and_a_half(), sigma: half() };
    /// The parameters that its authors recommend, B = C = 1/3.
    pub const MITCHELL: Self = Self::Mitchell { radius: two(), b: third(), c: third() };
    /// About as wide as the Gaussian.
    pub const BLACKMAN_HARRIS: Self = Self::BlackmanHarris { radius: one_and_a_half() };

    /// All filters with their default parameters, each with its word on the command line.
    pub const ALL: [(&str, Self); 5] = [
        ("box", Self::BOX),
        ("tent", Self::TENT),
        ("gaussian", Self::GAUSSIAN),
        ("mitchell", Self::MITCHELL),
        ("blackman-harris", Self::BLACKMAN_HARRIS),
    ];

    /// Whether it has negative lobes.
    pub fn is_signed(self) -> bool {
        matches!(self, Self::Mitchell { c, .. } if c > 0.0)
    }
}

impl Default for Filter {
    fn default() -> Self {
        Self::GAUSSIAN
    }
}

const fn half() -> f64 {
    0.5
}

const fn third() -> f64 {
    1.0 / 3.0
}

const fn one() -> f64 {
    1.0
}

const fn one_and_a_half() -> f64 {
    1.5
}

const fn two() -> f64 {
    2.0
}

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
    /// The shapes that the pixel's samples hit, and the fraction of the samples that hit each (Cryptomatte).
    Cryptomatte,
}

impl LayerKind {
    /// All kinds, in the order in which a file holds them.
    pub const ALL: [Self; 14] = [
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
        Self::Cryptomatte,
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
            Self::Cryptomatte => "cryptomatte",
        }
    }

    /// The names of its channels: the layer's name, a dot, and a letter; those of Cryptomatte are prescribed.
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
            Self::Cryptomatte => &[
                "CryptoObject00.r",
                "CryptoObject00.g",
                "CryptoObject00.b",
                "CryptoObject00.a",
                "CryptoObject01.r",
                "CryptoObject01.g",
                "CryptoObject01.b",
                "CryptoObject01.a",
                "CryptoObject02.r",
                "CryptoObject02.g",
                "CryptoObject02.b",
                "CryptoObject02.a",
            ],
        }
    }

    /// Whether it is a mean over the samples whose camera ray hit a surface.
    pub fn is_mean(self) -> bool {
        !matches!(self, Self::Coverage | Self::Entity | Self::Samples | Self::Variance | Self::Cryptomatte)
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

/// On the camera: what it sees is found by projecting shapes onto the image, and not by camera rays that look for them.
///
/// Rasterisation finds the same hits in object order: it fills the same column, and everything after it, from
/// shadow rays to bounces, is as before.
/// Of shapes that are not made of triangles the bounding boxes are projected, and only the camera rays of the pixels that
/// a box may cover are intersected with its shape; all camera rays are intersected with a plane, which has no box.
/// The camera must be a perspective or an orthographic one without a lens that is open, and must not move.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rasterisation;

/// On the camera, beside [`Integrator::Path`](super::Integrator::Path): caustics are traced from the lights (Arvo
/// 1986).
///
/// Paths that leave a light through specular surfaces, and whose last surface before the camera is non-specular, are
/// then found by particles that start on the lights; all others by paths from the camera, as before.
/// Point lights, spotlights and directional lights thus shine through glass too.
/// Light paths start on these, on shapes that emit light and on an [`Environment`](super::Environment), but not on a
/// [`Background`](super::Background) or a [`Gradient`](super::Gradient), whose light the camera's paths find with less
/// variance.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LightTracing {
    /// Light paths per camera path, from 1/1024 to 1024; a fraction of one is often enough.
    pub paths: f64,
}

impl Default for LightTracing {
    fn default() -> Self {
        Self { paths: 1.0 }
    }
}

/// On the camera, beside [`Integrator::Path`](super::Integrator::Path): caustics are found by photons (Jensen 1996), on
/// whatever a path from the camera meets, and so through glass and in mirrors as well.
///
/// Photons start where the paths of [`LightTracing`] do, go through specular surfaces only, and stay where they meet the
/// first other one.
/// A path from the camera that comes there counts those within a radius, of which all but the light that they carry is
/// guessed: the picture is blurred by as much.
/// Each sample has photons of its own and a smaller radius, so that both the noise and the blur go to 0 (Hachisuka and
/// Jensen 2009; Knaus and Zwicker 2011).
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PhotonMapping {
    /// Light paths per camera path, from 1/1024 to 1024.
    pub paths: f64,
    /// The radius for the first sample, in scene units; 0 for one that holds about ten photons where photons are.
    pub radius: f64,
}

impl Default for PhotonMapping {
    fn default() -> Self {
        Self { paths: 1.0, radius: 0.0 }
    }
}

/// On the camera, beside [`Integrator::Path`](super::Integrator::Path): paths from the camera are joined to paths from the
/// lights, each vertex to each (bidirectional path tracing; Lafortune and Willems 1993, Veach and Guibas 1995).
///
/// The same light is found in many ways, from a path of the camera that hits a lamp to one of a lamp that is joined to the
/// camera; each counts by its MIS weight.
/// Paths start on lights with a position or an area in all directions, a quarter of them towards mirrors and glass; on
/// directional lights towards the whole scene, or towards mirrors and glass alone where a shape is endless.
/// Light of a sky or an environment image is found as without it.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BidirectionalPathTracing {
    /// Light paths per camera path, from 1/1024 to 1024. Fewer take less time and leave more error: half as many pay in a
    /// Cornell box that a point lights, and do not in one under a sky, nor behind a keyhole.
    pub paths: f64,
}

impl Default for BidirectionalPathTracing {
    fn default() -> Self {
        Self { paths: 1.0 }
    }
}

/// On the camera: paint this column instead of the picture.
///
/// Stages that the column does not need are left out.
#[derive(Component, Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct View {
    /// The column's name, such as `ndc`.
    pub column: String,
}

/// On the camera: count the rows that every stage processes, and measure its time.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Statistics;

/// A pixel to be traced: every column of its row is recorded, stage by stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TracePixel {
    /// The pixel's column, from 0 at the left.
    pub x: u32,
    /// The pixel's row, from 0 at the top.
    pub y: u32,
}
