//! One scene by several integrators.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::Picture;
use super::svg::Drawing;
use pinhole::Chapter;
use pinhole::Result;
use pinhole::scene::{Integrator, LightStrategy, Sampling};

/// Three in a row.
const SMALL: [u32; 2] = [276, 155];
/// Two in a row.
const LARGE: [u32; 2] = [384, 216];

/// The chapter's scene by an integrator, with so many samples.
fn exhibit(
    chapter: &Chapter,
    size: [u32; 2],
    samples: u32,
    integrator: Integrator,
    lines: [&str; 2],
) -> Result<Exhibit> {
    let picture = Picture::of(chapter, size, None, |camera| {
        camera.insert((integrator, Sampling { samples, seed: 22, ..Sampling::default() }));
    })?;
    Ok(Exhibit { picture, lines: lines.map(str::to_owned).to_vec() })
}

/// What is near hides the sky, then what is farther too.
pub fn draw_distance(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let of = |distance, lines| exhibit(chapter, SMALL, 32, Integrator::AmbientOcclusion { distance }, lines);
    let exhibits = [
        of(0.25, ["distance 0.25", "only creases are dark"])?,
        of(1.0, ["distance 1", "what is near darkens"])?,
        of(f64::INFINITY, ["no distance", "all that hides the sky"])?,
    ];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SMALL)))
}

/// Ray casting beside paths of more and more segments.
pub fn draw_segments(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let paths = |max_depth| Integrator::Path { max_depth, lights: LightStrategy::Mis, roulette: 5 };
    let of = |integrator, lines| exhibit(chapter, LARGE, 12, integrator, lines);
    let exhibits = [
        of(Integrator::RayCasting, ["ray casting", "the lamp is seen, and lights nothing"])?,
        of(paths(2), ["paths of 2 segments", "light to surface to eye"])?,
        of(paths(3), ["paths of 3 segments", "off one more surface"])?,
        of(paths(1 << 20), ["paths of any length", "all the light there is"])?,
    ];
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, LARGE)))
}

/// Three strategies for the same lights.
pub fn draw_strategies(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let of = |lights, lines| {
        let integrator = Integrator::Path { max_depth: 2, lights, roulette: 0 };
        exhibit(chapter, SMALL, 16, integrator, lines)
    };
    let exhibits = [
        of(LightStrategy::Bsdf, ["BSDF sampling", "as the metal sends light on"])?,
        of(LightStrategy::Light, ["light sampling", "points on the lights"])?,
        of(LightStrategy::Mis, ["MIS", "both, each where its pdf is high"])?,
    ];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SMALL)))
}
