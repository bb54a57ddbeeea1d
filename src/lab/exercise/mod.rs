//! What a chapter asks its reader to write, put beside what the kit computes.
//!
//! Reads: the reader's function, which is compiled from the chapter's `exercise.rs`.
//! Writes: how it did, the first input at which the two differ, and how often it was tried, to a file of progress.
//! The reader's code runs on a thread of its own: it may panic or run for ever without taking the program along.
//! Nothing here runs in a render.

mod ambient_occlusion;
mod answers;
mod apart;
mod camera_to_world;
mod caustics;
mod choosing_samples;
mod compare;
mod conventions;
mod depth_of_field;
mod error_and_time;
mod field_of_view;
mod glass;
mod hit;
mod how_it_is_built;
mod image;
mod light_and_shadow;
mod mirrors;
mod motion_blur;
mod ndc;
mod orthographic;
mod path_tracing;
mod pinhole;
mod progress;
mod question;
mod ray;
mod reflection;
mod report;
mod sampling;
mod screen;
mod shapes;
mod shown;
mod soft_shadows;
mod textures;
mod transforms;
mod turn;

pub use compare::{Mismatch, Outcome, Report};
pub use progress::{Progress, Tries};
pub use turn::{Turn, list_exercises, take_turn, turn};

use crate::attempt::Attempt;
use std::time::Duration;

/// How long one answer may take before the reader's function counts as running for ever.
pub const PATIENCE: Duration = Duration::from_secs(3);

/// Asks a reader's function all inputs of its exercise and says how it did.
pub fn check(attempt: Attempt, patience: Duration) -> Report {
    match attempt {
        Attempt::RasterFromIndex(yours) => image::check(yours, patience),
        Attempt::Unit(yours) => ray::check(yours, patience),
        Attempt::NearestSphereT(yours) => hit::check(yours, patience),
        Attempt::OrthographicRay(yours) => orthographic::check(yours, patience),
        Attempt::PerspectiveDirection(yours) => pinhole::check(yours, patience),
        Attempt::PixelFromNdc(yours) => ndc::check(yours, patience),
        Attempt::NdcFromScreen(yours) => screen::check(yours, patience),
        Attempt::VerticalFov(yours) => field_of_view::check(yours, patience),
        Attempt::NormalWorldFromObject(yours) => camera_to_world::check(yours, patience),
        Attempt::ReflectedRadiance(yours) => light_and_shadow::check(yours, patience),
        Attempt::PinholeFromTheirs(yours) => conventions::check(yours, patience),
        Attempt::Kept(yours) => how_it_is_built::check(yours, patience),
        Attempt::NearestBoxT(yours) => shapes::check(yours, patience),
        Attempt::VarianceAndBiasSquared(yours) => error_and_time::check(yours, patience),
        Attempt::MeanOfStripes(yours) => textures::check(yours, patience),
        Attempt::PhongRadiance(yours) => reflection::check(yours, patience),
        Attempt::FallingCosine(yours) => transforms::check(yours, patience),
        Attempt::TentOffset(yours) => sampling::check(yours, patience),
        Attempt::Mirrored(yours) => mirrors::check(yours, patience),
        Attempt::Refracted(yours) => glass::check(yours, patience),
        Attempt::SolidAnglePdf(yours) => soft_shadows::check(yours, patience),
        Attempt::LensDirection(yours) => depth_of_field::check(yours, patience),
        Attempt::MovingSphereT(yours) => motion_blur::check(yours, patience),
        Attempt::CosineDirection(yours) => ambient_occlusion::check(yours, patience),
        Attempt::AfterRoulette(yours) => path_tracing::check(yours, patience),
        Attempt::PowerHeuristic(yours) => choosing_samples::check(yours, patience),
        Attempt::PixelFraction(yours) => caustics::check(yours, patience),
    }
}
