//! Light → pixels → files.
//!
//! Reads: [`Radiance`](crate::shade::Radiance).
//! Writes: [`FilmTile`], sums in f64 and counts; then, once, an image of 8-bit sRGB (PNG) or of linear floats (EXR).
//! Nothing is written to disk anywhere else in the kit's renderer, and no file is ever left half written.

mod accumulate;
mod develop;
mod exr;
mod film_tile;
mod png;
mod whole_file;

pub use crate::extract::linear_from_srgb;
pub use accumulate::{add_to_film, film_stage};
pub use develop::{Curve, byte_from_linear, srgb_from_linear};
pub use exr::write_exr;
pub use film_tile::{Film, FilmTile, Rejected};
pub use png::{png_bytes, png_bytes_by, png_url, write_png};
pub use whole_file::{check_place, write_whole};
