//! A few rays a pixel: what they are for, what earlier frames know, and what the denoiser makes of them.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::{Picture, few};
use super::svg::Drawing;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::{camera_entity, eye};
use pinhole::film::{GUIDES, Guides, History, denoise, denoise_radiance};
use pinhole::plan::Census;
use pinhole::rasterise::Projection;
use pinhole::render::{Execution, Rendered, render};
use pinhole::scene::{Integrator, Layers, LightStrategy, LookAt, Mirror, Placement, Resolution, Sampling, Sphere};
use pinhole::{Chapter, Overrides, Result, stages};
use std::sync::Arc;

/// Three in a row.
const SMALL: [u32; 2] = [226, 127];
/// Two in a row.
const LARGE: [u32; 2] = [345, 194];
/// Where the denoiser's curves and the ghosts are measured.
pub(super) const MEASURED: [u32; 2] = [160, 90];
/// Samples a pixel of what is shown as the truth.
const TRUTH: u32 = 32;
/// Frames of a camera that moves, and how far it moves from one to the next, in scene units.
const FRAMES: u32 = 8;
const STEP: f64 = 0.06;

/// Radiance, a component each.
pub(super) type Radiance = [Vec<f32>; 3];

/// A frame of a chapter, and what finds a point of the world in it.
pub(super) struct Frame {
    pub history: History,
    /// Whether a pixel shows nothing of a mirror.
    pub is_plain: Vec<bool>,
    projection: Projection,
    eye: DVec3,
}

impl Frame {
    /// A frame of so many samples, seen from so far to the side.
    pub fn of(chapter: &Chapter, size: [u32; 2], [samples, seed]: [u32; 2], aside: f64) -> Result<Self> {
        let (mut scene, film) = shown(chapter, size, false, None, |camera| {
            if let Some(mut look) = camera.get_mut::<LookAt>() {
                look.eye.x += aside;
            }
            if let Some(mut sampling) = camera.get_mut::<Sampling>() {
                (sampling.samples, sampling.seed) = (samples, u64::from(seed));
            }
        })?;
        let unguided = || pinhole::Error::Usage("no layers guide the filter".into());
        let guides = Guides::of(&film.film).ok_or_else(unguided)?;
        let mut mirrors = scene.query_filtered::<(&Sphere, &Placement), With<Mirror>>();
        let mirrors: Vec<(f64, DVec3)> =
            mirrors.iter(&scene).map(|(own, place)| (own.radius, place.position)).collect();
        let point = |at: usize| {
            DVec3::from(guides.origin) + DVec3::from(guides.position.each_ref().map(|part| f64::from(part[at])))
        };
        let is_on = |at: usize| mirrors.iter().any(|(radius, centre)| (point(at) - centre).length() < 1.01 * radius);
        let on: Vec<bool> = (0..guides.normal[0].len()).map(is_on).collect();
        // A pixel beside it may show both.
        let (width, steps) = (size[0] as isize, [-1, 0, 1]);
        let near = |at: usize| {
            let offsets = steps.into_iter().flat_map(|down| steps.map(|right| down * width + right));
            offsets.filter_map(|offset| on.get(at.checked_add_signed(offset)?)).any(|on| *on)
        };
        let is_plain = (0..on.len()).map(|at| !near(at)).collect();
        let census = Census::of(&scene);
        let history = History::of(&film.film).ok_or_else(unguided)?;
        Ok(Self { history, is_plain, projection: *census.table::<Projection>()?, eye: eye(&census)? })
    }

    /// With what an earlier frame knows of the same surfaces.
    pub fn with_earlier(self, earlier: &Self) -> Self {
        Self { history: self.history.with_earlier(&earlier.history, &earlier.projection, earlier.eye), ..self }
    }

    /// The last of [`FRAMES`] frames of one sample, each with what those before know.
    fn of_many(chapter: &Chapter, size: [u32; 2], seed: u32) -> Result<Self> {
        let frame = |number: u32| {
            let aside = STEP * (f64::from(number) - f64::from(FRAMES - 1));
            Self::of(chapter, size, [1, 100 * seed + number], aside)
        };
        (1..FRAMES).try_fold(frame(0)?, |earlier, number| Ok(frame(number)?.with_earlier(&earlier)))
    }
}

/// What a picture should be, in two renders of different seeds: in a product of the distances from either, their noise
/// is 0 on average.
struct Truth {
    halves: [Radiance; 2],
    is_plain: Vec<bool>,
}

impl Truth {
    fn of(chapter: &Chapter, size: [u32; 2], samples: u32) -> Result<Self> {
        let half = |seed: u32| Frame::of(chapter, size, [few(samples / 2).max(1), seed], 0.0);
        let (one, other) = (half(9998)?, half(9999)?);
        Ok(Self { halves: [one.history, other.history].map(|half| half.denoised(0)), is_plain: one.is_plain })
    }

    fn mean(&self) -> Radiance {
        mean(&self.halves)
    }

    /// The MSE beside mirrors; negative where it is less than what noise leaves uncertain.
    fn error(&self, light: &Radiance) -> f64 {
        let [one, other] = &self.halves;
        let product = |part: usize, at: usize| {
            let [x, a, b] = [light, one, other].map(|image| f64::from(image[part][at]));
            (x - a) * (x - b)
        };
        mean_over(&self.is_plain, |at| (0..3).map(|part| product(part, at)).sum::<f64>() / 3.0)
    }

    /// The line below a picture.
    fn error_in_words(&self, light: &Radiance) -> String {
        format!("MSE {}", scientific(self.error(light)))
    }
}

/// The mean of a number over the pixels that count.
pub(super) fn mean_over(counts: &[bool], of: impl Fn(usize) -> f64) -> f64 {
    let kept: Vec<usize> = (0..counts.len()).filter(|&at| counts[at]).collect();
    kept.iter().map(|&at| of(at)).sum::<f64>() / kept.len().max(1) as f64
}

/// A chapter's scene with this camera, rendered by all stages, the layers of the denoiser kept; stages whose names begin
/// so do nothing.
fn shown(
    chapter: &Chapter,
    [width, height]: [u32; 2],
    statistics: bool,
    without: Option<&str>,
    change: impl FnOnce(&mut EntityWorldMut<'_>),
) -> Result<(World, Rendered)> {
    let asked = Overrides { resolution: Some(Resolution { width, height }), statistics, ..Overrides::default() };
    let mut whole = chapter.clone();
    (whole.view, whole.offer) = (None, stages::all());
    for stage in whole.offer.iter_mut().filter(|stage| without.is_some_and(|name| stage.name.starts_with(name))) {
        stage.system = Arc::new(|| (|| ()).into_configs());
    }
    let mut scene = whole.world(&asked);
    let camera = camera_entity(&scene)?;
    let mut camera = scene.entity_mut(camera);
    camera.insert(Layers { kinds: GUIDES.to_vec() });
    change(&mut camera);
    let rendered = render(&scene, &whole.stages(), &Execution::default(), &())?;
    Ok((scene, rendered))
}

/// A picture of radiance.
fn painted(size: [u32; 2], radiance: &Radiance) -> Result<Picture> {
    let pixels: Vec<[f32; 3]> = (0..radiance[0].len()).map(|at| radiance.each_ref().map(|part| part[at])).collect();
    Picture::painted(size, &pixels)
}

/// The mean of several images.
pub(super) fn mean(images: &[Radiance]) -> Radiance {
    let count = images.len() as f64;
    let sum = |part: usize, at: usize| images.iter().map(|image| f64::from(image[part][at])).sum::<f64>();
    [0, 1, 2].map(|part| (0..images[0][part].len()).map(|at| (sum(part, at) / count) as f32).collect())
}

/// The mean of the square of a difference over the pixels that count and over colours.
pub(super) fn mean_square(one: &Radiance, other: &Radiance, counts: &[bool]) -> f64 {
    let square = |part: usize, at: usize| {
        let apart = f64::from(one[part][at] - other[part][at]);
        apart * apart
    };
    mean_over(counts, |at| (0..3).map(|part| square(part, at)).sum::<f64>() / 3.0)
}

/// A number as pages have it: two digits and a power of ten.
pub(super) fn scientific(value: f64) -> String {
    let digits = format!("{value:.1e}").replace('-', "−");
    let (mantissa, exponent) = digits.split_once('e').unwrap_or((&digits, "0"));
    if value.abs() >= 0.0995 { format!("{value:.2}") } else { format!("{mantissa} · 10{}", raised(exponent)) }
}

pub(super) fn raised(exponent: &str) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    exponent.chars().map(|letter| letter.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize])).collect()
}

/// The same surfaces with more and more rays: direct light alone, shadows, reflections, light of surfaces and sky.
pub fn draw_ingredients(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let samples = few(6);
    let of = |what: &str, integrator: Integrator, without: Option<&str>| -> Result<Exhibit> {
        let (_, Rendered { film, plan, laps, .. }) = shown(chapter, LARGE, true, without, |camera| {
            camera.insert(integrator);
            if let Some(mut sampling) = camera.get_mut::<Sampling>() {
                sampling.samples = samples;
            }
        })?;
        let rows = |stage: &str| {
            let found = plan.stages.iter().zip(&laps).find(|(own, _)| own.name == stage);
            found.map_or(0.0, |(_, lap)| lap.rows as f64 / f64::from(LARGE[0] * LARGE[1] * samples))
        };
        let pixels = (0..LARGE[1]).flat_map(|y| (0..LARGE[0]).map(move |x| [x, y]));
        let pixels: Vec<[f32; 3]> = pixels.map(|[x, y]| film.mean(x, y)).collect();
        // A ray that is listed and not traced is none.
        let shadow_rays = if without.is_some() { 0.0 } else { rows("Clear shadow hits") };
        let rays = format!("{shadow_rays:.2} shadow rays and {:.2} others", rows("Advance to the next bounce"));
        Ok(Exhibit { picture: Picture::painted(LARGE, &pixels)?, lines: vec![what.into(), rays] })
    };
    const TRACE: &str = "Trace shadow rays";
    let path = Integrator::Path { max_depth: 3, lights: LightStrategy::Mis, roulette: 0 };
    let exhibits = [
        of("projected, and lit without shadow rays", Integrator::Distribution { max_depth: 2 }, Some(TRACE))?,
        of("with shadow rays", Integrator::Distribution { max_depth: 2 }, None)?,
        of("with reflected rays at the mirror", Integrator::Distribution { max_depth: 3 }, None)?,
        of("with a further ray everywhere", path, None)?,
    ];
    Ok(hang(figure, &exhibits, 2, &figure.stamp(LARGE, "rays a sample")))
}

/// What samples add up to while the camera rests.
pub fn draw_accumulated(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let truth = Truth::of(chapter, SMALL, 16)?;
    let of = |samples: u32| -> Result<Exhibit> {
        let light = Frame::of(chapter, SMALL, [few(samples), samples], 0.0)?.history.denoised(0);
        let samples = format!("{samples} {} a pixel", if samples == 1 { "sample" } else { "samples" });
        Ok(Exhibit { picture: painted(SMALL, &light)?, lines: vec![samples, truth.error_in_words(&light)] })
    };
    let exhibits = [of(1)?, of(6)?, of(36)?];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SMALL)))
}

/// A frame alone and with earlier ones, and which pixels took nothing over.
pub fn draw_reprojected(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    const NEW: [f32; 3] = [0.9, 0.28, 0.03];
    let alone = Frame::of(chapter, LARGE, [1, 100 + FRAMES - 1], 0.0)?.history;
    let joined = Frame::of_many(chapter, LARGE, 1)?.history;
    let truth = Truth::of(chapter, LARGE, 12)?;
    let is_new = |at: usize| joined.samples[at] <= alone.samples[at];
    let grey = truth.mean();
    let mark = |at: usize| if is_new(at) { NEW } else { [0.12 * (grey[0][at] + grey[1][at] + grey[2][at]); 3] };
    let map: Vec<[f32; 3]> = (0..joined.samples.len()).map(mark).collect();
    let part = 100.0 * (0..map.len()).filter(|&at| is_new(at)).count() as f64 / map.len() as f64;
    let exhibit = |what: String, light: Radiance| -> Result<Exhibit> {
        Ok(Exhibit { picture: painted(LARGE, &light)?, lines: vec![what, truth.error_in_words(&light)] })
    };
    let marked = vec!["orange: nothing taken over".into(), format!("{part:.1} % of the pixels")];
    let exhibits = [
        exhibit("one sample a pixel".into(), alone.denoised(0))?,
        exhibit(format!("with {} earlier frames", FRAMES - 1), joined.denoised(0))?,
        Exhibit { picture: Picture::painted(LARGE, &map)?, lines: marked },
        exhibit("and 2 levels of the filter".into(), joined.denoised(2))?,
    ];
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, LARGE)))
}

/// What the frames of a moving camera tend to, beside what it should be.
pub fn draw_ghosts(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let runs = (1..=few(4).max(2)).map(|run| Frame::of_many(chapter, SMALL, run)).collect::<Result<Vec<Frame>>>()?;
    let runs: Vec<Radiance> = runs.iter().map(|run| run.history.denoised(0)).collect();
    let truth = Truth::of(chapter, SMALL, TRUTH)?;
    let (middle, right) = (mean(&runs), truth.mean());
    let apart = [0, 1, 2].map(|part| {
        let pairs = middle[part].iter().zip(&right[part]);
        pairs.map(|(own, right)| 3.0 * (own - right).abs()).collect::<Vec<f32>>()
    });
    let exhibit = |lines: [String; 2], light: &Radiance| -> Result<Exhibit> {
        Ok(Exhibit { picture: painted(SMALL, light)?, lines: lines.to_vec() })
    };
    let exhibits = [
        exhibit(["what it should be".into(), format!("{TRUTH} samples at rest")], &right)?,
        exhibit([format!("mean of {} runs", runs.len()), format!("{FRAMES} frames each")], &middle)?,
        exhibit(["their difference".into(), "three times as bright".into()], &apart)?,
    ];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SMALL)))
}

/// One sample a pixel through more and more levels, and what it should be.
pub fn draw_denoised(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let frame = Frame::of(chapter, SMALL, [1, 35], 0.0)?;
    let truth = Truth::of(chapter, SMALL, TRUTH)?;
    let of = |levels: u32| -> Result<Exhibit> {
        let light = frame.history.denoised(levels);
        let what = match levels {
            0 => "one sample a pixel".into(),
            1 => "1 level".into(),
            _ => format!("{levels} levels"),
        };
        Ok(Exhibit { picture: painted(SMALL, &light)?, lines: vec![what, truth.error_in_words(&light)] })
    };
    let mut exhibits = (0..=4).map(of).collect::<Result<Vec<_>>>()?;
    let right = vec!["what it should be".into(), format!("{TRUTH} samples")];
    exhibits.push(Exhibit { picture: painted(SMALL, &truth.mean())?, lines: right });
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SMALL)))
}

/// The light of one sample through the filter, with and without the albedo that it is divided by.
pub fn draw_albedo(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    const LEVELS: u32 = 3;
    let seed = |camera: &mut EntityWorldMut<'_>| {
        if let Some(mut sampling) = camera.get_mut::<Sampling>() {
            (sampling.samples, sampling.seed) = (1, 35);
        }
    };
    let (_, Rendered { film, .. }) = shown(chapter, LARGE, false, None, seed)?;
    let Some((guides, light)) = Guides::of(&film).zip(denoise(&film, 0)) else {
        return Err(figure.unsuited("the layers that guide the filter"));
    };
    let plain = Guides { albedo: guides.albedo.each_ref().map(|part| vec![1.0; part.len()]), ..guides.clone() };
    let exhibit = |what: &str, guides: &Guides| -> Result<Exhibit> {
        let smooth = denoise_radiance(light.clone(), guides, LEVELS);
        Ok(Exhibit { picture: painted(LARGE, &smooth)?, lines: vec![what.into(), format!("{LEVELS} levels")] })
    };
    let exhibits = [exhibit("radiance smoothed", &plain)?, exhibit("radiance over albedo smoothed", &guides)?];
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, LARGE)))
}
