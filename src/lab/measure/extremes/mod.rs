//! Extremes: pinhole's own methods where numbers are hardest, beside the naive ones and the exact truth.
//!
//! Reads: aimed rays and cameras, each a function of (seed, index), so that every failure can be had again.
//! Writes: [`Case`]s. Every case runs pinhole's own functions and stages; nothing is copied here.
//! Zero failures in N rays bound the rate at 3/N (with 95 % confidence), so every case says its N.

mod bench;
mod camera;
mod camera_chain;
mod camera_limits;
mod camera_ndc;
mod camera_table;
mod case;
mod emitter;
mod film;
mod film_bytes;
mod hierarchy;
mod lens;
mod light;
mod light_albedo;
mod material;
mod print;
mod rasterisation;
mod sampling;
mod shadow;
mod shadow_stages;
mod shapes;
mod texture;
mod transform;
mod transport;
mod triangle;

pub use case::{Case, Method, Outcome, Score, Tally, Trial, Worst};
pub use print::Words;
pub use rasterisation::seen_by;

use pinhole::render::Watch;
use rayon::prelude::*;
use std::fmt;
use std::str::FromStr;

/// What a case is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Rays against every registered shape, and its normals.
    Shapes,
    /// Shadow rays: where they start on every registered shape, how far they look.
    Shadow,
    /// Cameras: raster → NDC → screen → camera → world.
    Camera,
    /// Placements through parents, look-at.
    Transform,
    /// Textures and environments: what a pixel covers, its mean, edges of images.
    Texture,
    /// Closed meshes of triangles, and where on a triangle a ray hits it.
    Triangle,
    /// Samples: their numbers, their places, what they count for.
    Sampling,
    /// Films: sums of samples, bytes of pictures.
    Film,
    /// Highlights, cones, suns: how much light there is.
    Light,
    /// Mirrors, glass and rough metal.
    Material,
    /// Lights with an area: points on them, and the pdf of each.
    Emitter,
    /// Lenses: where rays converge, where they start, how wide what is out of focus is.
    Lens,
    /// Hierarchies of shapes and of the triangles of meshes, against testing everything.
    Hierarchy,
    /// Triangles projected onto the image, against rays.
    Rasterisation,
    /// Light paths: what they carry, how they end, what they count for.
    Transport,
}

impl Group {
    /// All groups in order.
    pub const ALL: &[Self] = &[
        Self::Shapes,
        Self::Shadow,
        Self::Camera,
        Self::Transform,
        Self::Triangle,
        Self::Sampling,
        Self::Film,
        Self::Hierarchy,
        Self::Rasterisation,
        Self::Texture,
        Self::Light,
        Self::Material,
        Self::Emitter,
        Self::Lens,
        Self::Transport,
    ];

    /// Its cases.
    fn trials(self) -> Vec<Trial> {
        match self {
            Self::Shapes => shapes::trials(),
            Self::Shadow => shadow::trials(),
            Self::Camera => [camera::trials(), camera_table::trials(), camera_limits::trials(), camera_ndc::trials()]
                .into_iter()
                .flatten()
                .collect(),
            Self::Transform => transform::trials(),
            Self::Texture => texture::trials(),
            Self::Triangle => triangle::trials(),
            Self::Sampling => sampling::trials(),
            Self::Film => film::trials(),
            Self::Hierarchy => hierarchy::trials(),
            Self::Rasterisation => rasterisation::trials(),
            Self::Light => light::trials(),
            Self::Material => material::trials(),
            Self::Emitter => emitter::trials(),
            Self::Lens => lens::trials(),
            Self::Transport => transport::trials(),
        }
    }
}

impl fmt::Display for Group {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Shapes => "shapes",
            Self::Shadow => "shadow",
            Self::Camera => "camera",
            Self::Transform => "transform",
            Self::Texture => "texture",
            Self::Triangle => "triangle",
            Self::Sampling => "sampling",
            Self::Film => "film",
            Self::Hierarchy => "hierarchy",
            Self::Rasterisation => "rasterisation",
            Self::Light => "light",
            Self::Material => "material",
            Self::Emitter => "emitter",
            Self::Lens => "lens",
            Self::Transport => "transport",
        })
    }
}

impl FromStr for Group {
    type Err = String;
    fn from_str(word: &str) -> Result<Self, String> {
        let known = |group: &Self| group.to_string() == word;
        let names = || Self::ALL.iter().map(Self::to_string).collect::<Vec<_>>().join(", ");
        Self::ALL.iter().copied().find(known).ok_or_else(|| format!("it must be one of {}", names()))
    }
}

/// Tries every case of a group whose name holds each part of `named` between its `+` signs, with so many rays, the same on
/// any number of threads; fewer if the one who watches stops it.
pub fn try_group(group: Group, named: &str, rays: u64, watch: &dyn Watch) -> Vec<Case> {
    let trials: Vec<Trial> =
        group.trials().into_iter().filter(|trial| named.split('+').all(|part| trial.name.contains(part))).collect();
    trials.par_iter().map(|trial| trial.run(rays, watch)).collect()
}

/// The naive methods that no case shows to break: there, the cases prove nothing.
pub fn unbroken(cases: &[Case]) -> Vec<&'static str> {
    let naive = |passes: bool| {
        let outcomes = cases.iter().flat_map(|case| &case.outcomes);
        outcomes.filter(move |outcome| !outcome.method.of_pinhole && outcome.passes() == passes)
    };
    let breaks = |name: &str| naive(false).any(|outcome| outcome.method.name == name);
    let mut unbroken: Vec<_> = naive(true).map(|outcome| outcome.method.name).filter(|name| !breaks(name)).collect();
    unbroken.dedup();
    unbroken
}
