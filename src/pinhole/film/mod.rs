//! Radiance → pixels → files.
//!
//! Reads: [`Radiance`](crate::shade::Radiance), the columns that layers are made of, and the splats of light tracing.
//! Writes: [`FilmTile`], sums in f64 and counts; checkpoints; at the end an image of 8-bit sRGB (PNG) or linear floats
//! (EXR).
//! The renderer writes to disk nowhere else, and never leaves a partial file behind.

mod accumulate;
mod checkpoint;
mod develop;
mod exr;
mod film_tile;
mod layered_exr;
mod layers;
mod moments;
mod plausible;
mod png;
mod splats;
mod whole_file;

pub use crate::extract::linear_from_srgb;
pub use accumulate::{add_to_film, film_stage};
pub use checkpoint::{read_checkpoint, write_checkpoint};
pub use develop::{Curve, byte_from_linear, srgb_from_linear};
pub use exr::write_exr;
pub use film_tile::{FIRST_SAMPLE_STEPS, Film, FilmTile, Rejected};
pub use layered_exr::{ENTITY_NAMES, write_layered_exr};
pub use layers::{FilmLayers, add_to_layers, column_of_layer, layers_stage};
pub use moments::{FilmMoments, add_to_moments, moments_stage, variance_evidence};
pub use png::{png_bytes, png_bytes_by, write_png};
pub use splats::{FilmSplats, SplatFilter};
pub use whole_file::{check_place, write_whole, writes_in_progress};
