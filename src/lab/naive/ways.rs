//! The ways to find one path, in plain code: their weights, and the light of some of them alone.

use bevy_ecs::prelude::*;
use pinhole::follow::LightPower;
use pinhole::plan::{Column, Stage, TileSystems};
use pinhole::shade::{LightPdfs, ShadowRays};

// ANCHOR: way_weights
/// The weight of each way to find a path, given the pdf of each: its square over the sum of all squares.
pub fn way_weights(pdfs: &[f64]) -> Vec<f64> {
    let sum: f64 = pdfs.iter().map(|pdf| pdf * pdf).sum();
    pdfs.iter().map(|pdf| pdf * pdf / sum).collect()
}
// ANCHOR_END: way_weights

/// The weight of the first of four ways, given the pdf of each over that of the way before it: the squares of the others
/// over its own are products of squared ratios, which are summed from the last.
pub fn way_weight([second, third, fourth]: [f64; 3]) -> f64 {
    let others = second * second * (1.0 + third * third * (1.0 + fourth * fourth));
    1.0 / (1.0 + others)
}

/// What shadow rays and connections are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Rays to points sampled on lights.
    LightSamples,
    /// Rays to the vertices of light paths.
    Joins,
    /// Rays from light paths to the camera.
    ToTheCamera,
}

/// A stage that leaves the light of one kind of way, as it is weighted among all.
pub fn only(way: Way) -> Stage {
    let system = move |mut tiles: Query<(&LightPdfs, Option<&LightPower>, &mut ShadowRays)>| {
        for (pdfs, power, mut rays) in &mut tiles {
            let from_light = power.is_some_and(|power| power.rows() > 0);
            for ray in 0..rays.rows() {
                // Light samples come before what is joined.
                let own = match ray < pdfs.rows() {
                    _ if from_light => Way::ToTheCamera,
                    true => Way::LightSamples,
                    false => Way::Joins,
                };
                if own != way {
                    rays.weight_by(ray, [0.0; 3]);
                }
            }
        }
    };
    Stage::new("Keep one way", TileSystems::MisWeights, system).on_all_paths()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_and_pdfs_give_one_weight() {
        let pdfs = [0.3, 2.0, 0.01, 5.0];
        let ratios = [2.0 / 0.3, 0.01 / 2.0, 5.0 / 0.01];
        assert!((way_weight(ratios) - way_weights(&pdfs)[0]).abs() < 1e-15);
        assert!((way_weights(&pdfs).iter().sum::<f64>() - 1.0).abs() < 1e-15);
    }
}
