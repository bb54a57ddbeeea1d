//! One scene with the right pdf, and with pdfs that have something forgotten.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::Picture;
use super::svg::Drawing;
use crate::naive::mistake::{light_without_cosine, light_without_jacobian};
use pinhole::Chapter;
use pinhole::Result;
use pinhole::plan::Stage;
use pinhole::scene::{Sampler, Sampling};

const SIZE: [u32; 2] = [276, 184];

/// Right; without the light's cosine; without distance and cosine.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let sampled = Sampling { samples: 32, seed: 21, sampler: Sampler::Sobol, ..Sampling::default() };
    let picture = |forget: Option<Stage>| {
        Picture::beside(chapter, SIZE, forget, |camera| {
            camera.insert(sampled);
        })
    };
    let lines = |one: &str, two: &str| vec![one.to_owned(), two.to_owned()];
    let exhibits = [
        Exhibit { picture: picture(None)?, lines: lines("*d*² / (*A* cos *θ*)", "as it should be") },
        Exhibit { picture: picture(Some(light_without_cosine()))?, lines: lines("*d*² / *A*", "without the cosine") },
        Exhibit {
            picture: picture(Some(light_without_jacobian()))?,
            lines: lines("1 / *A*", "without distance and cosine"),
        },
    ];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}
