use super::area_lights::{PARTS, light_distribution};
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
    /// Their cumulative distribution by power in units of 2⁻³², as in [`super::AreaLightTable`].
    pub until: Vec<u64>,
}

impl EquiangularTable {
    /// The position of a light chosen in proportion to its power by a number in [0, 1), which is asked for where there
    /// are several; none without a light.
    #[inline(always)]
    pub fn chosen(&self, number: impl FnOnce() -> f64) -> Option<DVec3> {
        if self.position.len() < 2 {
            return self.position.first().copied();
        }
        let part = (number() * PARTS as f64) as u64;
        self.position.get(self.until.partition_point(|&until| until <= part)).copied()
    }
}

impl Table for EquiangularTable {
    const NAME: &'static str = "lights in media";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        if !equiangular_evidence(scene).needed {
            return Ok(Self::default());
        }
        let (mut position, mut powers) = (Vec::new(), Vec::new());
        for kind in light_kinds(scene).filter(|kind| !kind.is_distant) {
            for light in (kind.sources)(scene)? {
                if let Some(place) = light.position() {
                    position.push(place);
                    powers.push(luminance(light.power(0.0)));
                }
            }
        }
        let (until, _) = light_distribution(&powers, 0.0);
        Ok(Self { position, until })
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
