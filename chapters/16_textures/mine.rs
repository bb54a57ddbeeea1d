//! The reader's function in the picture of chapter 16: checkers, each of three stripes.

use super::question::Input;
use bevy_ecs::prelude::*;
use pinhole::extract::{CheckerTable, NO_TEXTURE};
use pinhole::intersect::{MaterialRows, Surfaces};
use pinhole::plan::Shared;
use pinhole::shade;
use pinhole::shade::{SurfaceColours, TexturePoints, box_width, wave_mean};
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// A width that rounding makes of none, in stripes.
const LEAST: f64 = 1e-6;

/// Colours of checkers: a checker is the product of stripes along its three axes.
pub fn mine(ask: Ask<Input, f64>, _: &Setting<'_>) -> StandIn {
    StandIn::instead(
        shade::checker_stage,
        move |checkers: Res<Shared<CheckerTable>>,
              mut tiles: Query<(RowPlaces, &Surfaces, &MaterialRows, &TexturePoints, &mut SurfaceColours)>| {
            for (place, surfaces, list, points, mut colours) in &mut tiles {
                for &row in &list.row {
                    let row = row as usize;
                    let texture = checkers.0.of_material[surfaces.material[row] as usize];
                    if texture == NO_TEXTURE {
                        continue;
                    }
                    let texture = texture as usize;
                    let at = if checkers.0.filter[texture] { points.get(row) } else { points.get(row).alone() };
                    let [right, down] = at.steps;
                    let mean = |axis: usize| {
                        let (x, width) = (at.point[axis], box_width(right[axis], down[axis]));
                        // Along the floor's normal a pixel covers nothing but rounding, which no mean can be taken over.
                        if width < LEAST {
                            wave_mean(x, width)
                        } else {
                            ask.at(place, row, (x, width)).unwrap_or_default()
                        }
                    };
                    let first = 0.5 + 0.5 * mean(0) * mean(1) * mean(2);
                    let (one, other) = (checkers.0.first[texture], checkers.0.second[texture]);
                    let colour = [0, 1, 2].map(|part| first * one[part] + (1.0 - first) * other[part]);
                    (colours.r[row], colours.g[row], colours.b[row]) = colour.into();
                }
            }
        },
    )
}
