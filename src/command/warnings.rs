//! What a reader should know of a picture that has been rendered.

use super::error::Result;
use super::options::RenderOptions;
use super::subject::Subject;
use pinhole::extract::{ImageFrame, PerspectiveProjection, SMALLEST_PIXEL, camera_entity, image_remarks};
use pinhole::film::{Curve, Film, RANKS, column_of_layer, left_out};
use pinhole::look::looks_black;
use pinhole::plan::{Census, Plan, Table};
use pinhole::render::Rendered;
use pinhole::scene::{Exposure, ModelNotes, PerspectiveCamera};

/// What was dropped, replaced or added where a scene's models and images were read, a line each.
///
/// Errors: an image that cannot be used.
pub fn notes(scene: &Census<'_>) -> Result<Vec<String>> {
    let of_models = scene.get_resource().map_or(&[][..], |ModelNotes(notes)| &notes[..]);
    Ok(of_models.iter().chain(&*image_remarks(scene)?).map(|note| format!("note: {note}")).collect())
}

/// All of it, each in one sentence.
pub fn warnings(subject: &Subject<'_>, options: &RenderOptions, film: &Film, plan: &Plan) -> Result<Vec<String>> {
    let mut told = Vec::new();
    told.extend(rejected(film));
    told.extend(too_much_light(film));
    told.extend(empty_layers(film, plan));
    told.extend(negative_weights(film));
    told.extend(narrow_pixels(subject, options)?);
    Ok(told)
}

/// How many pixels have gathered more light than a picture holds.
fn too_much_light(film: &Film) -> Option<String> {
    let pixels = film.too_bright();
    (pixels > 0).then(|| {
        format!("{pixels} pixels gathered more light than 32-bit floats hold; they show {:e} instead", f32::MAX)
    })
}

/// How dark a picture is that looks black all over; none where it shows a column in place of light.
pub fn too_dark(film: &Film, curve: Curve) -> Option<String> {
    let exposure = match curve {
        Curve::Straight => return None,
        Curve::Srgb => Exposure::default(),
        Curve::Exposed(exposure, _) => exposure,
    };
    let pixels = (0..film.height).flat_map(|y| (0..film.width).map(move |x| film.mean(x, y)));
    let brightest = pixels.flatten().fold(0.0, f32::max);
    if brightest == 0.0 {
        return Some("the picture is black: the radiance of every pixel is 0".into());
    }
    looks_black(f64::from(brightest), exposure).map(|how| format!("the picture looks black: {how}"))
}

/// In how many pixels more shapes are seen than the layer `cryptomatte` has room for.
pub fn mattes_left_out(rendered: &Rendered) -> Option<String> {
    let (pixels, largest) = left_out(&rendered.film, &rendered.attributes);
    (pixels > 0).then(|| {
        format!(
            "{pixels} pixels show more than the {RANKS} shapes that the layer `cryptomatte` names; those that it leaves out \
             cover up to {:.1} % of a pixel",
            100.0 * largest
        )
    })
}

fn rejected(film: &Film) -> Option<String> {
    let (count, first) = film.rejected();
    let which = first.first().map_or_else(
        || "all of them light from lamps".into(),
        |sample| {
            let ([x, y], [r, g, b]) = (sample.pixel, sample.radiance);
            format!("the first is sample {} of pixel {x},{y} with radiance ({r}, {g}, {b})", sample.sample)
        },
    );
    (count > 0).then(|| format!("{count} samples were negative or not finite and did not join the film; {which}"))
}

/// Layers that are 0 everywhere because nothing that runs writes what they are made of.
fn empty_layers<'a>(film: &'a Film, plan: &'a Plan) -> impl Iterator<Item = String> + 'a {
    let kinds = film.layers.first().map_or(&[][..], |layers| &layers.kinds);
    kinds.iter().filter_map(|kind| {
        let column = column_of_layer(*kind)?;
        let written = plan.columns.contains(&column);
        let word = kind.word();
        let told = || format!("the layer `{word}` is empty, for nothing that runs writes the column `{}`", column.name);
        (!written).then(told)
    })
}

/// Pixels that a filter that is negative in places has left without weight or below 0.
fn negative_weights(film: &Film) -> Vec<String> {
    let (without, below) = film.filter_artifacts();
    let mut told = Vec::new();
    if without > 0 {
        told.push(format!(
            "the weights of {without} pixels do not sum to more than 0 yet, so they show the plain mean of their samples; \
             more samples or another filter help"
        ));
    }
    if below > 0 {
        told.push(format!("{below} pixels came out below 0, for the filter is negative in places; they show 0"));
    }
    told
}

/// An angle so wide that pixels near the corners are narrower than f32 rays can be told apart.
fn narrow_pixels(subject: &Subject<'_>, options: &RenderOptions) -> Result<Option<String>> {
    let scene = subject.world(&options.scene.asked(false));
    let perspective = camera_entity(&scene).is_ok_and(|camera| scene.get::<PerspectiveCamera>(camera).is_some());
    if !perspective {
        return Ok(None);
    }
    let census = &Census::of(&scene);
    let narrowest = PerspectiveProjection::extract(census)?.narrowest_pixel(ImageFrame::extract(census)?);
    Ok((narrowest < SMALLEST_PIXEL).then(|| {
        format!(
            "so wide an angle leaves pixels in the corners {narrowest:.1e} rad wide, and world rays in f32 can be off by \
             about {:.2} of such a pixel",
            f64::from(f32::EPSILON) / narrowest
        )
    }))
}
