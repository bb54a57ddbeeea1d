//! Mistakes from raster to world rays.

use bevy_ecs::prelude::*;
use pinhole::extract::{CameraAxes, ImageFrame, PerspectiveProjection};
use pinhole::plan::{Column, Shared, VectorRowsMut};
use pinhole::rays::{
    CameraRays, NdcPoints, PixelSamples, RasterPoints, ScreenPoints, Tile, WorldRays, camera_ray_perspective,
    raster_from_pixel,
};

/// Corners of pixels for their centres.
pub fn half_pixel(mut tiles: Query<&mut RasterPoints>) {
    for mut raster in &mut tiles {
        let raster = &mut *raster;
        raster.point.iter_mut().flatten().for_each(|along| *along -= 0.5);
    }
}

/// The first pixel's point for all pixels of the tile.
pub fn one_pattern(mut tiles: Query<&mut RasterPoints>) {
    for mut raster in &mut tiles {
        let raster = &mut *raster;
        for component in &mut raster.point {
            let first = component.first().map_or(0.0, |first| first - first.floor());
            component.iter_mut().for_each(|along| *along = along.floor() + first);
        }
    }
}

/// Offsets from the centre doubled: a radius taken for a diameter.
pub fn radius_doubled(mut tiles: Query<(&Tile, &PixelSamples, &mut RasterPoints)>) {
    for (tile, samples, mut raster) in &mut tiles {
        for (row, &pixel) in samples.pixel.iter().enumerate() {
            let [x, y] = tile.pixel_of(pixel as usize);
            let centre = raster_from_pixel(x, y);
            raster.point[0][row] = 2.0 * raster.point[0][row] - centre.x;
            raster.point[1][row] = 2.0 * raster.point[1][row] - centre.y;
        }
    }
}

/// Divided by one pixel too few.
pub fn size_less_one(image: Res<Shared<ImageFrame>>, mut tiles: Query<&mut NdcPoints>) {
    let too_much = image.size() / (image.size() - 1.0);
    for mut ndc in &mut tiles {
        ndc.point[0].iter_mut().for_each(|x| *x *= too_much.x);
        ndc.point[1].iter_mut().for_each(|y| *y *= too_much.y);
    }
}

/// y left as raster space has it, downward.
pub fn y_down(mut tiles: Query<&mut ScreenPoints>) {
    for mut screen in &mut tiles {
        screen.point[1].iter_mut().for_each(|y| *y = -*y);
    }
}

/// x from −1 to 1, whatever the image's shape.
pub fn no_aspect(image: Res<Shared<ImageFrame>>, mut tiles: Query<&mut ScreenPoints>) {
    for mut screen in &mut tiles {
        screen.point[0].iter_mut().for_each(|x| *x /= image.aspect());
    }
}

/// The tangent of the whole angle for that of its half: tan 2a = 2 tan a / (1 − tan² a).
pub fn whole_angle(lens: Res<Shared<PerspectiveProjection>>, mut tiles: Query<(&ScreenPoints, &mut CameraRays)>) {
    let half = lens.tan_half_vertical;
    let whole = 2.0 * half / (1.0 - half * half);
    for (screen, mut rays) in &mut tiles {
        for row in 0..screen.rows() {
            let direction = camera_ray_perspective(screen.point(row), whole);
            rays.direction.put(row, direction);
        }
    }
}

/// A camera that looks along +z.
pub fn plus_z(mut tiles: Query<&mut CameraRays>) {
    for mut rays in &mut tiles {
        rays.direction[2].iter_mut().for_each(|z| *z = -*z);
    }
}

/// The view's height for its half.
pub fn whole_height(mut tiles: Query<&mut CameraRays>) {
    for mut rays in &mut tiles {
        let rays = &mut *rays;
        rays.origin.iter_mut().flatten().for_each(|along| *along *= 2.0);
    }
}

/// The camera's axes as rows where they are columns.
pub fn transposed(axes: Res<Shared<CameraAxes>>, mut tiles: Query<(&CameraRays, &mut WorldRays)>) {
    let wrong = axes.world_from_camera.transpose();
    for (camera, mut world) in &mut tiles {
        for row in 0..camera.rows() {
            let direction = wrong * camera.direction(row);
            world.direction.put(row, direction.as_vec3());
        }
    }
}
