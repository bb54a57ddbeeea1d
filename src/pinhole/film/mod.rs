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

pub use develop::Curve;
pub use exr_files::write_exr;
pub use file_attributes::FileAttributes;
pub use film_tile::Film;
pub use png_files::{png_bytes, rgba_bytes, write_png};

unstable! {
    use crate::extract::linear_from_srgb;
    use accumulate::{
        FilmMoments, PixelErrors, add_to_film, add_to_moments, film_stage, moments_stage, variance_evidence,
    };
    use blocks::{BLOCK, EarlierBlocks};
    use checkpoint::{
        CheckpointAt, SamplesKept, checkpoint_at, checkpoint_place, is_done, keep_checkpoint, read_checkpoint,
        write_checkpoint, write_done,
    };
    use cryptomatte::{RANKS, float_hash, hex_of, left_out};
    use denoise::{GUIDES, Guides, denoise, denoise_radiance, film_of_radiance};
    use denoise_picture::{PICTURE_GUIDES, denoise_picture};
    use develop::{byte_from_linear, srgb_from_linear};
    use exr_channels::{LayerNames, NO_DEPTH};
    use exr_files::{ENTITY_NAMES, exr_bytes, write_exr_with};
    use file_attributes::{CameraMatrices, ShapeName};
    use film_tile::{FIRST_SAMPLE_STEPS, FilmTile, Rejected};
    use layers::{FilmLayers, MATTE_BYTES, add_to_layers, column_of_layer, layers_stage};
    use parts::{Check, LightUnit, Merged, Part, PartEntry, PartFilm, Split, Unit, UnitFilm, merge_parts};
    use png_files::{PngKind, png_bytes_as, png_bytes_by, rgba_of, write_png_as};
    use replaces::{MARK, Replaces, Target, marked};
    use reproject::History;
    use splats::{FilmSplats, SplatFilter};
    use tone::{stops_of, tone_mapped};
    use whole_file::{check_place, may_be_written, remove_own, set_aside, write_whole, writes_in_progress};
}
