//! Light goes on: from each surface new rays, leg after leg, until a way ends.

mod beer;
mod classify;
mod frame;
mod fresnel;
mod ggx;

pub use beer::{absorbed, transmittance};
pub use classify::{GlassRows, MatteRows, MetalRows, MirrorRows, classify_matter, classify_matter_stage};
pub use frame::{cosine_density, cosine_direction, frame_of, same_side};
pub use fresnel::{fresnel, fresnel_parts, mirror_direction, refract};
pub use ggx::{Glint, ggx_brdf, ggx_d, ggx_g1, ggx_lambda, ggx_sample, visible_density, visible_normal};
