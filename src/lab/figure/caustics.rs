//! One scene by the camera's rays alone, and with rays from the lights.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::Picture;
use super::svg::Drawing;
use crate::naive::caustics::join_without_cosine;
use bevy_ecs::prelude::*;
use pinhole::Chapter;
use pinhole::Result;
use pinhole::plan::Stage;
use pinhole::scene::{Integrator, LightTracing, Sampling};

/// Two in a row.
const SIZE: [u32; 2] = [384, 216];

fn exhibit(
    chapter: &Chapter,
    replaced: Option<Stage>,
    traced: Option<LightTracing>,
    samples: u32,
    lines: [&str; 2],
) -> Result<Exhibit> {
    let change = |camera: &mut EntityWorldMut<'_>| {
        camera.insert((Integrator::PATH, Sampling { samples, seed: 27, ..Sampling::default() }));
        match traced {
            Some(traced) => camera.insert(traced),
            None => camera.remove::<LightTracing>(),
        };
    };
    let picture = Picture::replacing(chapter, SIZE, replaced, change)?;
    Ok(Exhibit { picture, lines: lines.map(str::to_owned).to_vec() })
}

/// At the same number of samples.
pub fn draw_sides(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    const SAMPLES: u32 = 4;
    let [once, often] = [1.0, 8.0].map(|paths| Some(LightTracing { paths }));
    let exhibits = [
        exhibit(chapter, None, None, SAMPLES, ["from the camera alone", "few rays hit the light"])?,
        exhibit(chapter, None, once, SAMPLES, ["from the lamp too", "as many rays again"])?,
        exhibit(chapter, None, often, SAMPLES, ["more from the lamp", "eight for each of the camera"])?,
        exhibit(
            chapter,
            Some(join_without_cosine()),
            once,
            SAMPLES,
            ["the cosine forgotten", "too bright at grazing incidence"],
        )?,
    ];
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, SIZE)))
}
