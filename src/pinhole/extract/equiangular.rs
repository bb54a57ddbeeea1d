use super::integrator::{bidirectional_evidence, shadowed_point_evidence};
use super::lights_of::light_kinds;
use super::luminance;
use super::medium::scattering_evidence;
use crate::plan::{Census, Evidence, Table};
use crate::scene::SceneError;
use glam::DVec3;

/// The lights with a position and no area, beside which a medium is brightest: distances are sampled towards one of them.
///
/// None where a scene has no use for it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EquiangularTable {
    /// Where each is, in render space.
    pub position: Vec<DVec3>,
    /// Of all power, what it and those before it have together; the last one 1.
    pub until: Vec<f64>,
}

impl EquiangularTable {
    /// The position of a light chosen in proportion to its power by a number in [0, 1).
    #[inline(always)]
    pub fn chosen(&self, number: f64) -> DVec3 {
        let last = self.position.len() - 1;
        self.position[self.until.partition_point(|&until| until <= number).min(last)]
    }
}

impl Table for EquiangularTable {
    const NAME: &'static str = "lights in media";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (mut table, mut sum) = (Self::default(), 0.0);
        if !equiangular_evidence(scene).needed {
            return Ok(table);
        }
        for kind in light_kinds(scene).filter(|kind| !kind.is_distant) {
            for light in (kind.sources)(scene)? {
                let power = luminance(light.power(0.0));
                if let (Some(position), true) = (light.position(), power > 0.0) {
                    sum += power;
                    table.position.push(position);
                    table.until.push(sum);
                }
            }
        }
        table.until.iter_mut().for_each(|until| *until /= sum);
        Ok(table)
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.position[..]) + size_of_val(&self.until[..])
    }
}

/// Evidence of a medium that scatters the light of a light with a position and no area, and of no paths from there that
/// would be joined to what is beside it.
fn equiangular_evidence(scene: &Census<'_>) -> Evidence {
    let joined = bidirectional_evidence(scene);
    if joined.needed {
        return Evidence { needed: false, ..joined };
    }
    scattering_evidence(scene).and(|| shadowed_point_evidence(scene))
}
