//! The naive methods that a render may run in place of pinhole's, by name: `render 10 --naive shadow-rays-from-the-hit`.

use super::boxes::{enters_by_min_and_max, meshes_in_boxes};
use super::caustics::{join_without_area, join_without_cosine};
use super::lens::radius_at_random;
use super::mesh::directions_normalised_in_object_space;
use super::mistake::{
    glass_that_keeps_beams_narrow, light_samples_counted_in_full, light_without_cosine, light_without_jacobian,
    metal_counted_as_matte, moments_in_turn, opening_filled_by, sky_in_all_directions_alike,
};
use super::screen::{mirrored, upside_down, without_aspect};
use super::stages::{
    first_found, in_packets, paths_without_cosine, screen_placed_by, shadow_rays_from_the_hit, spheres_in_f32,
    through_tree,
};
use super::tree::to_visit;
use pinhole::plan::{Census, Stage, plan};
use pinhole::shapes::Shape;
use pinhole::{Error, Result};

/// How often a shutter's moments come in turn.
const MOMENTS: u32 = 4;

/// A method of the textbooks, or a mistake that is often made, as a stage of a render.
pub struct NaiveMethod {
    /// What a reader types.
    pub name: &'static str,
    /// The number of the chapter that explains it.
    pub chapter: u32,
    /// What it does, and what is seen of it.
    pub about: &'static str,
    stage: fn() -> Stage,
    place: Place,
}

/// Where a naive stage runs.
#[derive(Clone, Copy)]
enum Place {
    /// In place of the one stage that does the same.
    Instead,
    /// In place of all stages that stand where it stands in the order.
    InsteadOfAll,
    /// After them.
    After,
}

const fn method(
    name: &'static str,
    chapter: u32,
    about: &'static str,
    (place, stage): (Place, fn() -> Stage),
) -> NaiveMethod {
    NaiveMethod { name, chapter, about, stage, place }
}

use Place::{After, Instead, InsteadOfAll};

/// All of them, in the order of the book.
pub static METHODS: [NaiveMethod; 22] = [
    method(
        "spheres-in-f32",
        3,
        "spheres by the quadratic formula in f32: silhouettes far away are decided by rounding",
        (Instead, spheres_in_f32),
    ),
    method(
        "screen-without-aspect",
        7,
        "the screen is a square whatever the image: circles become ovals",
        (InsteadOfAll, || screen_placed_by(without_aspect)),
    ),
    method(
        "screen-upside-down",
        7,
        "y still counts downward on the screen: the picture stands on its head",
        (InsteadOfAll, || screen_placed_by(upside_down)),
    ),
    method(
        "screen-mirrored",
        7,
        "x counts to the left on the screen: the picture is its mirror image",
        (InsteadOfAll, || screen_placed_by(mirrored)),
    ),
    method(
        "shadow-rays-from-the-hit",
        10,
        "shadow rays start at the rounded hit: surfaces shadow themselves in specks",
        (After, shadow_rays_from_the_hit),
    ),
    method(
        "metal-by-the-wrong-pdf",
        19,
        "microfacets are sampled, and divided by the pdf of a matte surface",
        (After, metal_counted_as_matte),
    ),
    method(
        "glass-without-eta-squared",
        20,
        "radiance is divided by the square of the index where it enters glass, and not multiplied where it leaves",
        (After, glass_that_keeps_beams_narrow),
    ),
    method(
        "area-light-without-cosine",
        21,
        "the light's own cosine is missing from the pdf of a point on it",
        (After, light_without_cosine),
    ),
    method(
        "area-light-without-jacobian",
        21,
        "the pdf per area is taken for one per solid angle: brightness depends on the scene's unit",
        (After, light_without_jacobian),
    ),
    method(
        "sky-without-cosine",
        22,
        "directions to the sky are uniform and count alike: corners become too bright",
        (InsteadOfAll, sky_in_all_directions_alike),
    ),
    method(
        "lens-by-random-radius",
        23,
        "points of the lens by a random radius: too many in the middle, so blur has a bright core",
        (InsteadOfAll, || opening_filled_by(radius_at_random)),
    ),
    method(
        "moments-in-turn",
        24,
        "the mean of a few moments in place of random ones: what moves is seen several times",
        (InsteadOfAll, || moments_in_turn(MOMENTS)),
    ),
    method(
        "paths-without-cosine",
        25,
        "matte surfaces send paths on without the cosine: light grows at every bounce",
        (InsteadOfAll, paths_without_cosine),
    ),
    method(
        "light-samples-in-full",
        26,
        "light samples are not weighted, though BSDF sampling finds the same light: it counts twice",
        (InsteadOfAll, light_samples_counted_in_full),
    ),
    method(
        "connection-without-cosine",
        27,
        "light paths are connected with the camera without the surface's cosine",
        (Instead, join_without_cosine),
    ),
    method(
        "connection-without-area",
        27,
        "light paths are connected with the camera without the pixel's area",
        (Instead, join_without_area),
    ),
    method(
        "directions-normalised",
        28,
        "rays are normalised in each mesh's object space, so that t of different meshes cannot be compared",
        (Instead, directions_normalised_in_object_space),
    ),
    method(
        "boxes-by-min-and-max",
        29,
        "boxes are tested by min and max, which lose rays in the plane of a face",
        (Instead, || meshes_in_boxes(enters_by_min_and_max)),
    ),
    method(
        "tree-first-found",
        30,
        "the tree is left at the first hit: what is behind may be in front",
        (Instead, || through_tree(first_found)),
    ),
    method(
        "plain-tree",
        30,
        "a plain tree, one box after another: the same picture, later",
        (Instead, || {
            through_tree(|tree, search, spheres| {
                let ray = search.ray;
                tree.closest(search, &to_visit, &mut |number| spheres[number].t(ray[0], ray[1]));
            })
        }),
    ),
    method(
        "signs-of-the-first-ray",
        31,
        "64 rays enter boxes by the signs of the first: where signs differ, rays miss",
        (Instead, || in_packets(true)),
    ),
    method(
        "plain-wide-tree",
        31,
        "the wide tree in plain f64, one ray after another: the same picture, later",
        (Instead, || in_packets(false)),
    ),
];

impl NaiveMethod {
    /// The offer with the naive stage in its place.
    ///
    /// Errors: the scene does not run the stage, so that nothing would be seen of it.
    pub fn put_in(&self, mut offer: Vec<Stage>, scene: &Census<'_>) -> Result<Vec<Stage>> {
        let naive = (self.stage)();
        match self.place {
            Place::Instead => offer.iter_mut().filter(|own| **own == naive).for_each(|own| *own = naive.clone()),
            Place::InsteadOfAll => {
                offer.retain(|own| own.set != naive.set);
                offer.push(naive.clone());
            }
            Place::After => offer.push(naive.clone()),
        }
        if plan(scene, &offer)?.stages.contains(&naive) {
            return Ok(offer);
        }
        let (name, chapter, stage) = (self.name, self.chapter, naive.name);
        Err(Error::Usage(format!(
            "{name} stands in \"{stage}\", which this render does not run; chapter {chapter} does"
        )))
    }
}
