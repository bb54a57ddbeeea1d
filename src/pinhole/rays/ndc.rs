use super::RasterPoints;
use super::raster::aligned_rows;
use crate::extract::ImageFrame;
use crate::plan::{Shared, Stage, TileSystems, VectorRows, VectorRowsMut, column};
use bevy_ecs::prelude::*;
use glam::DVec2;
use multiversion::multiversion;

column! {
    /// Points of the image in normalised device coordinates: (0, 0) is the top left corner, (1, 1) the bottom right.
    pub struct NdcPoints("ndc", "NDC", "image size", Pixel) {
        /// To the right, and downward.
        point: DVec2 as [x, y],
    }
}

impl NdcPoints {
    /// Paints x as red, which grows to the right, and y as green, which grows downward.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.point(row).as_vec2().extend(0.0).into()
    }
}

// ANCHOR: ndc_from_raster
/// Transforms a raster point to NDC by dividing by the image's size in pixels.
#[inline(always)]
pub fn ndc_from_raster(raster: DVec2, size: DVec2) -> DVec2 {
    raster / size
}
// ANCHOR_END: ndc_from_raster

/// Fills a tile's NDC points.
pub fn fill_ndc(image: Res<Shared<ImageFrame>>, mut tiles: Query<(&RasterPoints, &mut NdcPoints)>) {
    for (raster, mut ndc) in &mut tiles {
        ndc_rows(raster, image.size(), &mut ndc);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn ndc_rows(raster: &RasterPoints, size: DVec2, ndc: &mut NdcPoints) {
    let rows = aligned_rows(raster);
    let (in_raster, mut in_ndc) = (raster.slices(), ndc.slices_mut(rows));
    for row in 0..rows {
        in_ndc.put(row, ndc_from_raster(in_raster.at(row).into(), size));
    }
}

/// The stage that runs this system.
pub fn ndc_stage() -> Stage {
    Stage::new("Compute NDC points", TileSystems::Ndc, fill_ndc)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rays::raster_from_pixel;

    #[test]
    fn corners_go_to_corners_and_the_centre_to_a_half() {
        let size = DVec2::new(200.0, 100.0);
        assert_eq!(ndc_from_raster(DVec2::ZERO, size), DVec2::ZERO);
        assert_eq!(ndc_from_raster(size, size), DVec2::ONE);
        assert_eq!(ndc_from_raster(raster_from_pixel(0, 0), DVec2::ONE), DVec2::new(0.5, 0.5));
    }
}
