use super::NdcPoints;
use crate::extract::ImageFrame;
use crate::plan::{Column, Shared, Stage, TileSystems, VectorRows, VectorRowsMut, column};
use bevy_ecs::prelude::*;
use glam::DVec2;
use multiversion::multiversion;

column! {
    /// Points of the image in screen space: the origin at the centre, y up from −1 to 1, x from −aspect to aspect.
    pub struct ScreenPoints("screen", "screen", "half heights", Pixel) {
        /// To the right, from −aspect to aspect, and upward, from −1 to 1.
        point: DVec2 as [x, y],
    }
}

impl ScreenPoints {
    /// Paints x as red, which grows to the right, and y as green, which grows upward; both are 0.5 at the centre.
    fn paint_row(&self, row: usize, size: [u32; 2]) -> [f32; 3] {
        let aspect = f64::from(size[0]) / f64::from(size[1]);
        let [x, y] = self.point.at(row);
        [(0.5 + 0.5 * x / aspect) as f32, (0.5 + 0.5 * y) as f32, 0.0]
    }
}

// ANCHOR: screen_from_ndc
/// Transforms an NDC point to screen space: origin at the centre, y up, x scaled by the aspect ratio.
#[inline(always)]
pub fn screen_from_ndc(ndc: DVec2, aspect: f64) -> DVec2 {
    DVec2::new((2.0 * ndc.x - 1.0) * aspect, 1.0 - 2.0 * ndc.y)
}
// ANCHOR_END: screen_from_ndc

/// Fills a tile's screen points.
pub fn fill_screen(image: Res<Shared<ImageFrame>>, mut tiles: Query<(&NdcPoints, &mut ScreenPoints)>) {
    for (ndc, mut screen) in &mut tiles {
        screen_rows(ndc, image.aspect(), &mut screen);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn screen_rows(ndc: &NdcPoints, aspect: f64, screen: &mut ScreenPoints) {
    let rows = ndc.rows();
    let (in_ndc, mut in_screen) = (ndc.slices(), screen.slices_mut(rows));
    for row in 0..rows {
        in_screen.put(row, screen_from_ndc(in_ndc.at(row).into(), aspect));
    }
}

/// The stage that runs this system.
pub fn screen_stage() -> Stage {
    Stage::new("Compute screen points", TileSystems::Screen, fill_screen)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_lie_at_aspect_and_one() {
        assert_eq!(screen_from_ndc(DVec2::ZERO, 2.0), DVec2::new(-2.0, 1.0));
        assert_eq!(screen_from_ndc(DVec2::ONE, 2.0), DVec2::new(2.0, -1.0));
        assert_eq!(screen_from_ndc(DVec2::splat(0.5), 2.0), DVec2::ZERO);
    }
}
