//! A stage: lines of equal height are drawn into what the camera sees.

use pinhole::extend::{Radiance, eye};
use pinhole::intersect::{Hits, Surfaces};
use pinhole::plan::VectorRowsMut;
use pinhole::prelude::*;

/// On any entity: lines are drawn.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct Contours {
    /// From line to line, in scene units.
    pub step: f32,
    /// How wide a line is.
    pub width: f32,
}

/// The contours of a scene, relative to the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContourTable {
    contours: Contours,
    eye: f32,
}

impl Table for ContourTable {
    const NAME: &'static str = "contours";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let owner = scene.entities::<With<Contours>>().first().copied();
        let contours = owner.and_then(|owner| scene.get::<Contours>(owner)).copied();
        let contours = contours.unwrap_or(Contours { step: 1.0, width: 0.0 });
        if !(contours.step > 0.0) {
            return Err(SceneError::new("contours", "step", contours.step, "it must be above 0"));
        }
        Ok(Self { contours, eye: eye(scene)?.y as f32 })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// Darkens the rows whose surface is on a line.
fn draw(table: Res<Shared<ContourTable>>, mut tiles: Query<(&Hits, &Surfaces, &mut Radiance)>) {
    let Contours { step, width } = table.contours;
    for (hits, surfaces, mut radiance) in &mut tiles {
        for row in 0..hits.t.len() {
            let height = surfaces.position[1][row] + table.eye;
            if hits.t[row] < f64::INFINITY && (height + 0.5 * width).rem_euclid(step) < width {
                radiance.rgb.scale(row, [0.2; 3]);
            }
        }
    }
}

/// The stage that draws them, at what the camera sees first.
pub fn stage() -> Stage {
    Stage::new("Draw contours", TileSystems::Shade, draw)
        .on_first_bounce()
        .when(|scene| Evidence::of::<Contours>(scene, "contour"))
}
