//! Radiance → pixels → files.
//!
//! Reads: [`Radiance`](crate::shade::Radiance), the columns that layers are made of, and the splats of light tracing.
//! Writes: [`FilmTile`], sums in f64 and counts; checkpoints; at the end an image of 8-bit or 16-bit sRGB (PNG), which
//! the camera's exposure and tone mapping may change, or of linear floats (EXR), which nothing does.
//! The renderer writes to disk nowhere else, and never leaves a partial file behind.
//!
//! ```
//! use pinhole::film::{Curve, Film, png_bytes};
//!
//! let mut film = Film::new(2, 1, 32);
//! film.tiles[0].add(1, [1.0, 0.25, 0.0]);
//! assert_eq!(film.mean(1, 0), [1.0, 0.25, 0.0]);
//! assert!(png_bytes(&film, Curve::Srgb)?.starts_with(b"\x89PNG"));
//! # Ok::<(), std::io::Error>(())
//! ```

mod accumulate;
mod blocks;
mod checkpoint;
mod cryptomatte;
mod denoise;
mod denoise_picture;
mod develop;
mod exr_channels;
mod exr_files;
mod file_attributes;
mod film_tile;
mod layers;
mod parts;
mod plausible;
mod png_files;
mod replaces;
mod reproject;
mod splats;
mod tone;
mod whole_file;

#[doc(hidden)]
pub use crate::extract::linear_from_srgb;
#[doc(hidden)]
pub use accumulate::{
    FilmMoments, PixelErrors, add_to_film, add_to_moments, film_stage, moments_stage, variance_evidence,
};
#[doc(hidden)]
pub use blocks::{BLOCK, EarlierBlocks};
#[doc(hidden)]
pub use checkpoint::{
    CheckpointAt, SamplesKept, checkpoint_at, checkpoint_place, is_done, keep_checkpoint, read_checkpoint,
    write_checkpoint, write_done,
};
#[doc(hidden)]
pub use cryptomatte::{RANKS, float_hash, hex_of, left_out};
#[doc(hidden)]
pub use denoise::{GUIDES, Guides, denoise, denoise_radiance, film_of_radiance};
#[doc(hidden)]
pub use denoise_picture::{PICTURE_GUIDES, denoise_picture};
pub use develop::Curve;
#[doc(hidden)]
pub use develop::{byte_from_linear, srgb_from_linear};
#[doc(hidden)]
pub use exr_channels::{LayerNames, NO_DEPTH};
pub use exr_files::write_exr;
#[doc(hidden)]
pub use exr_files::{ENTITY_NAMES, exr_bytes, write_exr_with};
#[doc(hidden)]
pub use file_attributes::{CameraMatrices, FileAttributes, ShapeName};
pub use film_tile::Film;
#[doc(hidden)]
pub use film_tile::{FIRST_SAMPLE_STEPS, FilmTile, Rejected};
#[doc(hidden)]
pub use layers::{FilmLayers, MATTE_BYTES, add_to_layers, column_of_layer, layers_stage};
#[doc(hidden)]
pub use parts::{Check, LightUnit, Merged, Part, PartEntry, PartFilm, Split, Unit, UnitFilm, merge_parts};
pub use png_files::write_png;
#[doc(hidden)]
pub use png_files::{PngKind, png_bytes, png_bytes_as, png_bytes_by, rgba_bytes, rgba_of, write_png_as};
#[doc(hidden)]
pub use replaces::{MARK, Replaces, Target, marked};
#[doc(hidden)]
pub use reproject::History;
#[doc(hidden)]
pub use splats::{FilmSplats, SplatFilter};
#[doc(hidden)]
pub use tone::{stops_of, tone_mapped};
#[doc(hidden)]
pub use whole_file::{check_place, may_be_written, remove_own, set_aside, write_whole, writes_in_progress};
