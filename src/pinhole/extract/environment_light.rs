use super::{EnvironmentTable, Texels};
use crate::lights::luminance;
use crate::plan::{Census, Evidence, Table};
use crate::scene::{Environment, SceneError};
use bevy_ecs::prelude::*;
use std::f64::consts::PI;

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
    let texel = |column: usize| luminance(image.rgb[row * image.width + column % image.width].map(f64::from));
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
