use super::Texels;
use super::check::{at_most_one, kind_and_name, number};
use super::image_file::background_image;
use crate::plan::{Census, Table};
use crate::scene::{Environment, SceneError};
use bevy_ecs::prelude::*;
use std::sync::Arc;

/// The radiance of an environment from an equirectangular image.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentTable {
    /// Linear Rec. 709 radiance.
    pub image: Arc<Texels>,
    /// Sine and cosine of the rotation about +y.
    pub turn: [f64; 2],
    /// What was done to the file's texels, one sentence each.
    pub remarks: Vec<String>,
}

impl Table for EnvironmentTable {
    const NAME: &'static str = "environment";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let Some(entity) = at_most_one::<Environment>(scene, "environment", "Environment")? else {
            let image = Texels::single([0.0; 3]).into();
            return Ok(Self { image, turn: [0.0, 1.0], remarks: Vec::new() });
        };
        let Environment { file, turn, scale } = scene.get::<Environment>(entity).cloned().unwrap_or_default();
        let who = kind_and_name(scene, "environment", entity);
        if !turn.0.is_finite() {
            return Err(SceneError::new(who, "turn", format!("{}°", number(turn.0)), "it must be a finite angle"));
        }
        if !(0.0..f64::INFINITY).contains(&scale) {
            return Err(SceneError::new(who, "scale", number(scale), "it must be a finite number of at least 0"));
        }
        let read = background_image(scene, &who, &file)?;
        let (mut image, remarks) = (Arc::clone(&read.texels), read.remarks.clone());
        if scale != 1.0 {
            let mut scaled = Texels::clone(&image);
            scaled.rgb.iter_mut().flatten().for_each(|part| *part = (f64::from(*part) * scale) as f32);
            image = scaled.into();
        }
        if image.rgb.iter().flatten().any(|part| !part.is_finite()) {
            let accepted = "the brightest texel times it must be at most 3.4e38";
            return Err(SceneError::new(who, "scale", number(scale), accepted));
        }
        let (sine, cosine) = libm::sincos(turn.radians());
        Ok(Self { image, turn: [sine, cosine], remarks })
    }

    fn bytes(&self) -> usize {
        self.image.bytes() + size_of::<[f64; 2]>()
    }
}
