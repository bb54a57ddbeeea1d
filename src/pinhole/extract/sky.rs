//! What is seen, and what shines, where no shape is.

use super::Texels;
use super::check::{at_most_one, kind_and_name, light_colour, number};
use super::image_files::background_image;
use crate::each::Each;
use crate::lights::luminance;
use crate::plan::{Census, Evidence, Table};
use crate::scene::{Background, Environment, Gradient, Rgb, SceneError, called};
use bevy_ecs::prelude::*;
use std::f64::consts::PI;
use std::sync::Arc;

/// The radiance of a ray that hits nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BackgroundTable {
    /// Linear Rec. 709.
    pub radiance: [f32; 3],
}

impl Table for BackgroundTable {
    const NAME: &'static str = "background";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        check_one_kind(scene)?;
        let colour = match at_most_one::<Background>(scene, "background", "Background")? {
            None => Rgb::BLACK,
            Some(entity) => {
                let background = scene.get::<Background>(entity).copied().unwrap_or_default();
                light_colour(&kind_and_name(scene, "background", entity), "colour", background.colour)?
            }
        };
        Ok(Self { radiance: colour.to_array().each(|part| part as f32) })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// Checks that a scene has at most one kind of background.
fn check_one_kind(scene: &Census<'_>) -> Result<(), SceneError> {
    let kinds = [
        ("a Background", scene.entities::<With<Background>>()),
        ("a Gradient", scene.entities::<With<Gradient>>()),
        ("an Environment", scene.entities::<With<Environment>>()),
    ];
    let given: Vec<String> = kinds
        .iter()
        .filter_map(|(kind, found)| found.first().map(|&entity| format!("{kind} by {}", called(scene, entity))))
        .collect();
    if given.len() > 1 {
        let accepted = "it must be one of Background, Gradient and Environment";
        return Err(SceneError::new("the scene", "background", format!("given as {}", given.join(" and ")), accepted));
    }
    Ok(())
}

/// The radiance of a background that changes with elevation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GradientTable {
    /// Towards −y, linear Rec. 709.
    pub bottom: [f64; 3],
    /// Towards +y.
    pub top: [f64; 3],
}

impl Table for GradientTable {
    const NAME: &'static str = "gradient";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let Some(entity) = at_most_one::<Gradient>(scene, "gradient", "Gradient")? else { return Ok(Self::default()) };
        let gradient = scene.get::<Gradient>(entity).copied().unwrap_or_default();
        let who = kind_and_name(scene, "gradient", entity);
        let colour = |field, colour: Rgb| light_colour(&who, field, colour).map(Rgb::to_array);
        Ok(Self { bottom: colour("bottom", gradient.bottom)?, top: colour("top", gradient.top)? })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

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

/// The distribution of an environment's light over directions, for sampling it by importance.
///
/// A cell lies between the centres of four texels, or of two texels and a pole: there the image is interpolated from
/// the cell's corners, so a cell with black corners is black throughout, and only such cells are never chosen.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EnvironmentLightTable {
    /// The number of cells from left to right, as many as texels.
    pub columns: usize,
    /// The number of cells from top to bottom, one more than texels.
    pub rows: usize,
    /// 1 − cos of the polar angle of each row's upper edge, and of the last row's lower edge.
    pub versine: Vec<f64>,
    /// The marginal distribution of rows: the fraction of all light above each of these edges.
    pub above: Vec<f64>,
    /// Row by row, the conditional distribution of columns: the fraction of the row's light to the left of each cell,
    /// and 1 at the end.
    pub left: Vec<f64>,
}

impl EnvironmentLightTable {
    // ANCHOR: environment_cells
    /// The distribution of an image: each cell has the mean luminance of its corners times its solid angle.
    pub fn new(image: &Texels) -> Self {
        let (columns, rows) = (image.width, image.height + 1);
        let edge = |line: usize| ((line as f64 - 0.5) / image.height as f64).clamp(0.0, 1.0) * PI;
        let versine: Vec<f64> = (0..=rows).map(|line| versine_of(edge(line))).collect();
        let mut table = Self { columns, rows, versine, above: vec![0.0], left: Vec::new() };
        let (mut upper, mut sums) = (line_of(image, 0), Vec::new());
        for row in 0..rows {
            let lower = line_of(image, row + 1);
            let corners = |left: usize| {
                let right = (left + 1) % columns;
                upper[left] + upper[right] + lower[left] + lower[right]
            };
            let mut sum = 0.0;
            let start = table.left.len();
            table.left.push(0.0);
            for column in 0..columns {
                sum += corners(column);
                table.left.push(sum);
            }
            table.left[start..].iter_mut().for_each(|left| *left = if sum > 0.0 { *left / sum } else { 0.0 });
            sums.push(sum * (table.versine[row + 1] - table.versine[row]));
            upper = lower;
        }
        let whole: f64 = sums.iter().sum();
        let mut so_far = 0.0;
        for sum in sums {
            so_far += sum;
            table.above.push(if whole > 0.0 { so_far / whole } else { 0.0 });
        }
        table
    }
    // ANCHOR_END: environment_cells

    /// The cell that two numbers in [0, 1) select, and the position within it: row, column, and two fractions.
    ///
    /// A row or cell without light has zero width in the distributions, so it is never selected.
    #[inline(always)]
    pub fn chosen(&self, u: [f64; 2]) -> ([usize; 2], [f64; 2]) {
        let (row, down) = between(&self.above, u[1]);
        let (column, across) = between(&self.left[row * (self.columns + 1)..][..=self.columns], u[0]);
        ([row, column], [down, across])
    }

    /// The pdf of directions in a cell, in 1/sr.
    #[inline(always)]
    pub fn pdf(&self, [row, column]: [usize; 2]) -> f64 {
        let left = &self.left[row * (self.columns + 1) + column..];
        let probability = (self.above[row + 1] - self.above[row]) * (left[1] - left[0]);
        probability * self.columns as f64 / (2.0 * PI * (self.versine[row + 1] - self.versine[row]))
    }
}

/// The step of an increasing list that contains a number, and the fraction of the step at which it is.
#[inline(always)]
fn between(edges: &[f64], u: f64) -> (usize, f64) {
    // A number beyond the last edge, which rounding may leave below 1, belongs to the last step with a width.
    let u = u.min(edges[edges.len() - 1].next_down());
    let step = edges.partition_point(|&edge| edge <= u).clamp(1, edges.len() - 1) - 1;
    let width = edges[step + 1] - edges[step];
    (step, if width > 0.0 { ((u - edges[step]) / width).clamp(0.0, 1.0) } else { 0.5 })
}

/// 1 − cos, without losing the digits of a small angle.
fn versine_of(angle: f64) -> f64 {
    let sine = libm::sin(0.5 * angle);
    2.0 * sine * sine
}

/// The luminances along the centres of a row of texels; the first and the last line are the poles, where each texel
/// continues in the one half a turn away.
fn line_of(image: &Texels, line: usize) -> Vec<f64> {
    let row = line.clamp(1, image.height) - 1;
    let texel = |column: usize| luminance(image.rgb[row * image.width + column % image.width].each(f64::from));
    let pole = line == 0 || line > image.height;
    let across = |column: usize| 0.5 * (texel(column + image.width / 2) + texel(column + image.width.div_ceil(2)));
    (0..image.width).map(|column| if pole { 0.5 * (texel(column) + across(column)) } else { texel(column) }).collect()
}

impl Table for EnvironmentLightTable {
    const NAME: &'static str = "light of the environment";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        Ok(Self::new(&scene.table::<EnvironmentTable>()?.image))
    }

    fn bytes(&self) -> usize {
        (self.versine.len() + self.above.len() + self.left.len()) * size_of::<f64>()
    }
}

/// Evidence that there is an environment image; a constant background or a gradient needs no light sampling.
pub fn environment_light_evidence(scene: &Census<'_>) -> Evidence {
    Evidence::among::<With<Environment>>(scene, "environment", |entity| {
        entity.get::<Environment>().is_some_and(|environment| environment.scale != 0.0)
    })
}

/// Evidence that light arrives from what surrounds the scene: a background, a gradient or an environment that is not
/// black.
pub fn sky_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| {
        let background = Evidence::among::<With<Background>>(scene, "coloured background", |entity| {
            entity.get::<Background>().is_some_and(|background| background.colour != Rgb::BLACK)
        });
        let gradient = Evidence::among::<With<Gradient>>(scene, "coloured gradient", |entity| {
            entity.get::<Gradient>().is_some_and(|sky| sky.bottom != Rgb::BLACK || sky.top != Rgb::BLACK)
        });
        let environment = Evidence::among::<With<Environment>>(scene, "environment", |entity| {
            entity.get::<Environment>().is_some_and(|environment| environment.scale != 0.0)
        });
        background.or(gradient).or(environment)
    })
}
