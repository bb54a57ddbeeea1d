//! What stands on a camera for pictures that are looked at: exposure and tone mapping.
//!
//! Neither touches the film: an OpenEXR file, a checkpoint and a view of a column are the same with and without them.

use bevy_ecs::prelude::*;
use serde::{Deserialize, Serialize};

/// On the camera: by how much the film's radiance is multiplied in a PNG and in the viewer.
///
/// An OpenEXR file always keeps radiance as it is.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Exposure {
    /// In stops, from −128 to 128: radiance is multiplied by two to this power.
    pub stops: f64,
    /// Whether radiance is first multiplied so that the log-mean luminance of the picture becomes 0.18, as for the
    /// normal key of Reinhard et al. (2002).
    ///
    /// The log-mean is taken over the pixels that are not black, since the logarithm of 0 is not finite and a constant
    /// added to every pixel, as in the paper, would make the result depend on the unit of light.
    pub automatic: bool,
}

/// On the camera: which curve brings radiance brighter than white into the range of a display, in a PNG and in the
/// viewer.
///
/// Each maps linear Rec. 709 to linear Rec. 709 from 0 to 1, after [`Exposure`] and before the sRGB transfer function.
/// An OpenEXR file always keeps radiance as it is.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum ToneMapping {
    /// None: each component above 1 is clipped to 1.
    #[default]
    None,
    /// The global operator of Reinhard, Stark, Shirley and Ferwerda, "Photographic Tone Reproduction for Digital
    /// Images" (2002, <https://doi.org/10.1145/566654.566575>), equations 3 and 4, on luminance; the ratios of red,
    /// green and blue stay, and what is still above 1 is clipped.
    Reinhard {
        /// The smallest luminance that becomes white; every luminance stays below white if it is left out.
        #[serde(default = "infinite")]
        white: f64,
    },
    /// The ACES reference rendering and output transforms for sRGB as fitted by Stephen Hill (2016,
    /// <https://github.com/TheRealMJP/BakingLab/blob/master/BakingLab/ACES.hlsl>), without any further scale.
    Aces,
    /// The Khronos PBR Neutral tone mapper (2024,
    /// <https://github.com/KhronosGroup/ToneMapping/blob/main/PBR_Neutral/README.md>), which keeps colours below 0.8.
    PbrNeutral,
    /// AgX, the default view of Troy Sobotka's configuration (2022, <https://github.com/sobotka/AgX>), with the inverse
    /// matrix at its end that Benjamin Wrensch added in "Minimal AgX Implementation" (2023,
    /// <https://iolite-engine.com/blog_posts/minimal_agx_implementation>).
    Agx,
}

impl ToneMapping {
    /// All curves with their default parameters, each with its word on the command line.
    pub const ALL: [(&str, Self); 5] = [
        ("none", Self::None),
        ("reinhard", Self::Reinhard { white: infinite() }),
        ("aces", Self::Aces),
        ("pbr-neutral", Self::PbrNeutral),
        ("agx", Self::Agx),
    ];
}

const fn infinite() -> f64 {
    f64::INFINITY
}
