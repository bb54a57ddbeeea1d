//! What the renderer must hold, stage by stage and as a whole.

#![allow(clippy::disallowed_methods, reason = "what a test expects may come from the platform's functions")]

mod added;
mod boxes;
mod cameras;
mod census;
mod counted;
mod denoise;
mod emitters;
mod exposure;
mod exr_files;
mod film;
mod follow;
mod invariance;
mod lens;
mod lights;
mod media;
mod meshes;
mod motion;
mod order;
mod plan;
mod raster_boxes;
mod rasterisation;
mod reprojection;
mod sampling;
mod scenes;
mod shapes;
mod stages;
mod textures;
mod ties;
mod whole_models;
mod words;
