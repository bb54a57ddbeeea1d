use crate::extract::{PixelSteps, filtered_evidence};
use crate::intersect::{Hits, MaterialRows, Surfaces};
use crate::plan::{Column, Shared, Stage, TileSystems, column};
use crate::rays::WorldRays;
use bevy_ecs::prelude::*;
use glam::DVec3;

column! {
    /// What a pixel covers of each surface: where its right and its lower neighbour's rays would meet the tangent plane,
    /// from where its own does; infinite where they would not.
    pub struct Footprints("footprint", "world", "scene units", Ray, begun in Footprint) {
        /// The step to the right, x.
        rx: f64,
        /// The step to the right, y.
        ry: f64,
        /// The step to the right, z.
        rz: f64,
        /// The step down, x.
        dx: f64,
        /// The step down, y.
        dy: f64,
        /// The step down, z.
        dz: f64,
    }
}

impl Footprints {
    /// The root of each step's length, right as red and down as green, on a scale on which 1 unit is half of it.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        let shade = |step: DVec3| {
            let root = step.length().sqrt();
            if root.is_finite() { (root / (1.0 + root)) as f32 } else { 1.0 }
        };
        let [right, down] = self.get(row);
        [shade(right), shade(down), 0.0]
    }

    /// The steps of a row: to the right, down.
    #[inline(always)]
    pub fn get(&self, row: usize) -> [DVec3; 2] {
        [DVec3::new(self.rx[row], self.ry[row], self.rz[row]), DVec3::new(self.dx[row], self.dy[row], self.dz[row])]
    }
}

// ANCHOR: step_on_surface
/// How far a hit moves along its tangent plane where its ray moves to the next pixel's (Igehy 1999).
///
/// Without the plane the hit at O + tR would move by `moved`: by the step of the origin, and by t times that of the
/// direction.
/// That leaves the plane n · x = k by n · moved; so much is taken back along R.
/// A ray along the plane divides by 0: its pixel has no end on the surface.
#[inline(always)]
pub fn step_on_surface(moved: DVec3, direction: DVec3, normal: DVec3) -> DVec3 {
    let step = moved - direction * (normal.dot(moved) / normal.dot(direction));
    if step.is_finite() { step } else { DVec3::INFINITY }
}
// ANCHOR_END: step_on_surface

/// Fills what each pixel covers of the surface that it sees.
pub fn measure_footprints(
    steps: Res<Shared<PixelSteps>>,
    mut tiles: Query<(&WorldRays, &Hits, &Surfaces, &MaterialRows, &mut Footprints)>,
) {
    for (rays, hits, surfaces, list, mut footprints) in &mut tiles {
        let (rx, ry, rz, dx, dy, dz) = footprints.slices_mut(surfaces.rows());
        [&mut *rx, ry, rz, dx, dy, dz].into_iter().for_each(|component| component.fill(0.0));
        for &row in &list.row {
            let row = row as usize;
            let direction = rays.direction_of(row);
            let normal = surfaces.get(row).normal.as_dvec3();
            // The steps are those of a direction that reaches the image plane at distance 1; this one has length 1.
            let distance = hits.t[row] * direction.dot(steps.ahead);
            let moved = match steps.angle {
                None => [0, 1].map(|way| steps.origin[way] + steps.direction[way] * distance),
                Some(angle) => {
                    <[DVec3; 2]>::from(direction.any_orthonormal_pair()).map(|way| way * (angle * hits.t[row]))
                }
            };
            let [right, down] = moved.map(|moved| step_on_surface(moved, direction, normal));
            (rx[row], ry[row], rz[row]) = right.into();
            (dx[row], dy[row], dz[row]) = down.into();
        }
    }
}

/// The stage on offer.
pub fn footprint_stage() -> Stage {
    Stage::new("Compute footprints", TileSystems::Footprint, measure_footprints).when(filtered_evidence)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_lies_in_the_plane_and_ends_on_the_neighbour_s_ray() {
        // A floor 1 below the eye, a ray 45° down and ahead, its lower neighbour a thousandth steeper on the image plane.
        let (normal, unit) = (DVec3::Y, DVec3::new(0.0, -1.0, -1.0));
        let direction = unit.normalize();
        let (t, distance) = (2.0_f64.sqrt(), 1.0);
        let small = DVec3::new(0.0, -1e-3, 0.0);
        let step = step_on_surface(small * distance, direction, normal);
        let neighbour = (unit + small) / 1.001;
        let truth = neighbour - direction * t;
        assert!(step.y.abs() < 1e-15 && (step - truth).length() < 2e-6, "{step} for {truth}");
        // The other way: towards the horizon, where a derivative is no longer a difference, but finite.
        assert!(step_on_surface(DVec3::X, DVec3::NEG_Z, DVec3::Y) == DVec3::INFINITY);
        assert!(step_on_surface(DVec3::X, DVec3::new(0.0, -1e-300, -1.0), DVec3::Y).x == 1.0);
    }
}
