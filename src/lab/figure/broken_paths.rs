//! One scene by paths whose surfaces send on too much or too little.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::Picture;
use super::svg::Drawing;
use crate::naive::mistake::{MatteSample, scatter_matte_by};
use crate::naive::path::{uniform_direction, weight_without_cosine, weight_without_pi};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::Chapter;
use pinhole::Result;
use pinhole::material::cosine_direction;
use pinhole::scene::{Integrator, LightStrategy, Sampling};

/// Three in a row.
const SIZE: [u32; 2] = [276, 155];
/// Path segments: so few that what grows at each of them is still a picture.
const MAX_DEPTH: u32 = 4;

/// Right, then with each mistake.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let change = |camera: &mut EntityWorldMut<'_>| {
        let integrator = Integrator::Path { max_depth: MAX_DEPTH, lights: LightStrategy::Light, roulette: 0 };
        camera.insert((integrator, Sampling { samples: 4, seed: 25, ..Sampling::default() }));
    };
    let alike = |u| DVec3::from(uniform_direction(u));
    let by = |sample: MatteSample, lines: [&str; 2]| {
        let picture = Picture::of(chapter, SIZE, Some(scatter_matte_by(sample)), change)?;
        Ok::<_, pinhole::Error>(Exhibit { picture, lines: lines.map(str::to_owned).to_vec() })
    };
    let right = Exhibit {
        picture: Picture::of(chapter, SIZE, None, change)?,
        lines: vec!["right".to_owned(), format!("{MAX_DEPTH} segments")],
    };
    let twice = Exhibit {
        picture: Picture::encoded_twice(chapter, SIZE, change)?,
        lines: vec!["gamma twice".to_owned(), "light is right, bytes are not".to_owned()],
    };
    let exhibits = [
        right,
        by(
            MatteSample { direction: alike, weight: |albedo, _| weight_without_cosine(albedo) },
            ["the missing cosine", "twice what it may"],
        )?,
        by(
            MatteSample { direction: cosine_direction, weight: |albedo, _| weight_without_pi(albedo) },
            ["the forgotten π", "π times too much"],
        )?,
        by(
            MatteSample { direction: alike, weight: |albedo, _| albedo },
            ["the wrong pdf", "uniform directions, counted as cosine-weighted"],
        )?,
        by(
            MatteSample { direction: cosine_direction, weight: |albedo, cosine| albedo * cosine },
            ["the cosine twice", "a third is lost"],
        )?,
        twice,
    ];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}
