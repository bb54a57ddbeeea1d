use super::Exercise;
use super::mine::{Mine, Setting, Whose};
use super::seen::Seen;
use bevy_ecs::prelude::*;
use pinhole::extract::camera_entity;
use pinhole::film::{Curve, Film, rgba_of};
use pinhole::render::{Execution, Rendered, Watch, render};
use pinhole::scene::Sampling;
use pinhole::{Chapter, Overrides, Result, SamplingOverrides};
use std::sync::OnceLock;

/// The light of a picture, line by line from the top.
pub type Pixels = Vec<[f32; 3]>;

/// Two pictures of one scene with the same random numbers, one with pinhole's function in it and one with the reader's.
pub struct PicturePair {
    /// How many pixels they have, across and down.
    pub size: [u32; 2],
    /// How their light becomes bytes.
    pub curve: Curve,
    /// Pinhole's picture and the reader's.
    pub light: [Pixels; 2],
    /// The same by two halves of the samples, which differ by their noise; none where there is no noise.
    pub halves: Option<[[Pixels; 2]; 2]>,
    /// What the reader's render has come to, by half of the samples where there are several; none where
    /// the function's answers are painted.
    pub rendered: Option<Rendered>,
}

impl PicturePair {
    /// Renders both in one of the scenes of the exercise, with what the reader asks of it. A size and a column to paint are
    /// for the chapter's own scene, the first.
    ///
    /// Errors: why no picture shows the function; what the render has to say against it; what a render would be refused for.
    pub fn render(
        exercise: &Exercise,
        of_chapter: (&Chapter, usize),
        asked: &Overrides,
        by: (&Execution, &dyn Watch),
    ) -> Result<Self> {
        Self::render_beside(&OnceLock::new(), exercise, of_chapter, asked, by)
    }

    /// The same beside pinhole's pictures of the same scene, of which the same is asked: they are rendered where they are
    /// not there yet, and kept for other functions.
    ///
    /// Errors: the same.
    pub fn render_beside(
        pinholes: &OnceLock<Vec<Pixels>>,
        exercise: &Exercise,
        (chapter, number): (&Chapter, usize),
        asked: &Overrides,
        (execution, watch): (&Execution, &dyn Watch),
    ) -> Result<Self> {
        let chapter = exercise.pictured(chapter, number);
        let asked = match number {
            0 => asked.clone(),
            _ => Overrides { size: None, view: None, ..asked.clone() },
        };
        let scene = chapter.world(&asked);
        let mut readers = Mine::by(Whose::Readers, exercise, &Setting { chapter: &chapter, scene: &scene, number })?;
        if let Some((size, light)) = readers.painted() {
            let pinholes = Mine::by(Whose::Pinholes, exercise, &Setting { chapter: &chapter, scene: &scene, number })?;
            let right = { pinholes }.painted().map_or_else(Vec::new, |(_, light)| light);
            return Ok(Self { size, curve: Curve::Straight, light: [right, light], halves: None, rendered: None });
        }
        let by = |whose: Whose, asked: &Overrides| {
            let scene = chapter.world(asked);
            let mine = Mine::by(whose, exercise, &Setting { chapter: &chapter, scene: &scene, number })?;
            let rendered = render(&scene, &mine.chapter.stages(), execution, watch)?;
            mine.answers()?;
            Ok::<_, pinhole::Error>(rendered)
        };
        let parts = halves_of(&scene, &asked);
        // The reader's comes first: it has something to say against the function, and pinhole's has not.
        let rendered = by(Whose::Readers, &parts[0])?;
        let (size, curve) = ([rendered.film.width, rendered.film.height], rendered.curve());
        let pinholes = match pinholes.get() {
            Some(kept) => kept,
            None => {
                let pictures = parts.iter().map(|part| Ok(light_of(&by(Whose::Pinholes, part)?.film)));
                let pictures = pictures.collect::<Result<_>>()?;
                pinholes.get_or_init(|| pictures)
            }
        };
        let mut pinholes = pinholes.iter().cloned();
        let first = [pinholes.next().unwrap_or_default(), light_of(&rendered.film)];
        let Some(second) = parts.get(1) else {
            return Ok(Self { size, curve, light: first, halves: None, rendered: Some(rendered) });
        };
        let second = [pinholes.next().unwrap_or_default(), light_of(&by(Whose::Readers, second)?.film)];
        let light = [0, 1].map(|whose| mean(&first[whose], &second[whose]));
        Ok(Self { size, curve, light, halves: Some([first, second]), rendered: Some(rendered) })
    }

    /// What a person sees of the difference.
    pub fn seen(&self) -> Seen {
        Seen::of(self)
    }

    /// A picture as bytes.
    pub fn bytes(&self, light: &Pixels) -> Vec<[u8; 3]> {
        let rows = [0, 1, 2].map(|part| light.iter().map(|pixel| pixel[part]).collect());
        rgba_of(&rows, self.curve).chunks_exact(4).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
    }
}

/// What to ask for twice, where the scene is sampled: half of the samples each, by other random numbers.
fn halves_of(scene: &World, asked: &Overrides) -> Vec<Overrides> {
    let camera = camera_entity(scene).ok();
    let Some(&Sampling { samples, seed, .. }) = camera.and_then(|camera| scene.get::<Sampling>(camera)) else {
        return vec![asked.clone()];
    };
    if samples < 2 {
        return vec![asked.clone()];
    }
    let half = |seed: u64| {
        let sampling = SamplingOverrides { samples: Some(samples / 2), seed: Some(seed), ..asked.sampling };
        Overrides { sampling, ..asked.clone() }
    };
    vec![half(seed), half(seed.wrapping_add(1))]
}

fn light_of(film: &Film) -> Pixels {
    (0..film.height).flat_map(|y| (0..film.width).map(move |x| film.mean(x, y))).collect()
}

fn mean(one: &Pixels, other: &Pixels) -> Pixels {
    one.iter().zip(other).map(|(one, other)| [0, 1, 2].map(|part| 0.5 * (one[part] + other[part]))).collect()
}
