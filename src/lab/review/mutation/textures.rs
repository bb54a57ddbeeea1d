//! Mistakes in textures and environments.

use bevy_ecs::prelude::*;
use pinhole::extract::{
    CheckerTable, EnvironmentTable, ImageTable, NO_TEXTURE, Pattern, PatternTable, StripesTable, TexturePoint,
};
use pinhole::film::srgb_from_linear;
use pinhole::intersect::{Hits, MaterialRows, NO_SHAPE, Surfaces};
use pinhole::plan::{Column, Shared, VectorRowsMut};
use pinhole::rays::WorldRays;
use pinhole::scene::Checker;
use pinhole::shade::{Footprints, Radiance, SurfaceColours, TexturePoints, environment_radiance};

/// The step across two pixels for that across one.
pub fn two_pixels(mut tiles: Query<&mut Footprints>) {
    for mut footprints in &mut tiles {
        let footprints = &mut *footprints;
        footprints.right.iter_mut().flatten().for_each(|part| *part *= 2.0);
    }
}

/// A fraction of the light lost.
pub fn half_colour(mut tiles: Query<&mut SurfaceColours>) {
    for mut colours in &mut tiles {
        colours.rgb[0].iter_mut().for_each(|part| *part *= 0.5);
    }
}

/// Cells that begin where their middle should be.
pub fn half_cell(mut tiles: Query<&mut TexturePoints>) {
    for mut points in &mut tiles {
        points.point[0].iter_mut().for_each(|x| *x -= 0.5);
    }
}

/// The two colours of a checker exchanged.
pub fn colours_exchanged(
    checkers: Res<Shared<CheckerTable>>,
    mut tiles: Query<(&Surfaces, &MaterialRows, &TexturePoints, &mut SurfaceColours)>,
) {
    for (surfaces, list, points, mut colours) in &mut tiles {
        recolour(&checkers, surfaces, list, points, &mut colours, |own, at| {
            Checker { first: own.second, second: own.first, ..*own }.colour(&at)
        });
    }
}

/// Stripes at one point of each pixel.
pub fn stripes_at_a_point(
    stripes: Res<Shared<StripesTable>>,
    mut tiles: Query<(&Surfaces, &MaterialRows, &TexturePoints, &mut SurfaceColours)>,
) {
    for (surfaces, list, points, mut colours) in &mut tiles {
        recolour(&stripes, surfaces, list, points, &mut colours, |own, at| own.colour(&at.alone()));
    }
}

fn recolour<T: Pattern>(
    table: &PatternTable<T>,
    surfaces: &Surfaces,
    list: &MaterialRows,
    points: &TexturePoints,
    colours: &mut SurfaceColours,
    colour: impl Fn(&T, TexturePoint) -> [f64; 3],
) {
    for &row in &list.row {
        let row = row as usize;
        let texture = table.of_material[surfaces.material[row] as usize];
        if texture == NO_TEXTURE {
            continue;
        }
        colours.rgb.put(row, colour(&table.pattern[texture as usize], points.get(row)));
    }
}

/// An image's numbers taken for light as they stand in the file.
pub fn bytes_for_light(
    images: Res<Shared<ImageTable>>,
    mut tiles: Query<(&Surfaces, &MaterialRows, &mut SurfaceColours)>,
) {
    for (surfaces, list, mut colours) in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            if images.of_material[surfaces.material[row] as usize] != NO_TEXTURE {
                let colours = &mut *colours;
                for component in &mut colours.rgb {
                    component[row] = srgb_from_linear(component[row]);
                }
            }
        }
    }
}

/// The environment mirrored: longitude the other way round.
pub fn mirrored(
    environment: Res<Shared<EnvironmentTable>>,
    mut tiles: Query<(&WorldRays, Option<&Hits>, &mut Radiance)>,
) {
    for (rays, hits, mut radiance) in &mut tiles {
        for row in 0..rays.rows() {
            if hits.is_none_or(|hits| hits.shape[row] == NO_SHAPE) {
                let mut direction = rays.direction_of(row);
                direction.x = -direction.x;
                let found = environment_radiance(&environment, direction);
                radiance.rgb.add(row, found.map(|part| part as f32));
            }
        }
    }
}
