use super::{Bug, Mutation, hits, light, moving, rays, shapes, textures, triangles};
use crate::review::DEVELOP;
use bevy_ecs::prelude::*;

/// A row of the table.
const fn bug(
    name: &'static str,
    stage: &'static str,
    mistake: &'static str,
    chapter: &'static str,
    bug: Bug,
) -> Mutation {
    Mutation { name, stage, mistake, chapter, bug }
}

/// The chapter in which most mutations are made: balls, a ground, a light and a background.
const MOST: &str = "05_pinhole";
/// Parallel rays, and no light.
const PARALLEL: &str = "04_orthographic";
/// Spheres that are scaled unevenly.
const SCALED: &str = "09_camera_to_world";
/// Disks, rectangles and cuboids.
const SHAPES: &str = "13_shapes";
/// Surfaces with more than one colour, and an environment.
const TEXTURED: &str = "16_textures";
/// Three reflection models under three kinds of light.
const REFLECTION: &str = "15_reflection";
/// Triangles, with normals of their own and without.
const MICROFACETS: &str = "14_transforms";
/// Several samples a pixel.
const SAMPLED: &str = "17_sampling";
/// Lights with an area.
const SOFT: &str = "21_soft_shadows";
/// An opening in place of the pinhole.
const BLURRED: &str = "23_depth_of_field";
/// Things that move while the shutter is open.
const MOVING: &str = "24_motion_blur";
/// A gradient behind mirrors.
const MIRRORED: &str = "19_mirrors";
/// A column painted for the picture.
const PAINTED: &str = "02_ray";

/// Every bug, in the order of the stages; at least one at each.
#[rustfmt::skip]
pub static MUTATIONS: &[Mutation] = &[
    bug("half-pixel", "Place raster points", "no + 0.5", MOST, Bug::After(|| rays::half_pixel.into_configs())),
    bug("one-pattern", "Place samples", "every pixel alike", SAMPLED, Bug::After(|| rays::one_pattern.into_configs())),
    bug("radius-doubled", "Place samples", "twice as far from the centre", SAMPLED, Bug::After(|| rays::radius_doubled.into_configs())),
    bug("size-less-one", "Compute NDC points", "divided by size − 1", MOST, Bug::After(|| rays::size_less_one.into_configs())),
    bug("y-down", "Compute screen points", "sign of y", MOST, Bug::After(|| rays::y_down.into_configs())),
    bug("no-aspect", "Compute screen points", "aspect left out", MOST, Bug::After(|| rays::no_aspect.into_configs())),
    bug("half-open", "Sample the lens", "half of the opening", BLURRED, Bug::After(|| moving::half_open.into_configs())),
    bug("all-at-once", "Sample times", "one time for all rays", MOVING, Bug::After(|| moving::all_at_once.into_configs())),
    bug("left-for-right", "Generate camera rays: thin lens", "left for right", BLURRED, Bug::After(|| moving::left_for_right.into_configs())),
    bug("whole-angle", "Generate camera rays: perspective", "tangent of the whole angle", MOST, Bug::After(|| rays::whole_angle.into_configs())),
    bug("plus-z", "Generate camera rays: perspective", "looks along +z", MOST, Bug::After(|| rays::plus_z.into_configs())),
    bug("whole-height", "Generate camera rays: orthographic", "height for its half", PARALLEL, Bug::After(|| rays::whole_height.into_configs())),
    bug("transpose", "Transform rays to world space", "matrix transposed", MOST, Bug::After(|| rays::transposed.into_configs())),
    bug("near-end", "Clear hits", "nothing hit beyond t = 8", MOST, Bug::After(|| hits::near_end.into_configs())),
    bug("not-dark", "Clear radiance", "light starts at 0.05", MOST, Bug::After(|| light::not_dark.into_configs())),
    bug("light-left-over", "Clear light rays", "not emptied", MOST, Bug::Instead(|| light::light_left_over.into_configs())),
    bug("far-root", "Intersect spheres", "where the ray leaves", MOST, Bug::Instead(|| hits::far_root.into_configs())),
    bug("unit-ray", "Intersect ellipsoids", "unit ray, t kept", SCALED, Bug::Instead(|| hits::ellipsoid_unit_ray.into_configs())),
    bug("two-edges", "Intersect triangles", "third edge not asked for", MICROFACETS, Bug::Instead(|| triangles::two_edges.into_configs())),
    bug("plane-sign", "Intersect planes", "sign of k", MOST, Bug::Instead(|| hits::plane_sign.into_configs())),
    bug("disk-square", "Intersect disks", "the square about it", SHAPES, Bug::Instead(|| shapes::disk_square.into_configs())),
    bug("one-coordinate", "Intersect rectangles", "one coordinate asked", SHAPES, Bug::Instead(|| shapes::one_coordinate.into_configs())),
    bug("cuboid-far-side", "Intersect cuboids", "where the ray leaves", SHAPES, Bug::Instead(|| shapes::cuboid_far_side.into_configs())),
    bug("nothing-moves", "Intersect moving shapes", "not looked for", MOVING, Bug::Instead(|| moving::nothing_moves.into_configs())),
    bug("zero-is-none", "Classify hits", "shape 0 taken for none", MOST, Bug::After(|| hits::zero_is_none.into_configs())),
    bug("normal-inward", "Compute surfaces: spheres", "sign of the normal", MOST, Bug::After(|| hits::normal_inward.into_configs())),
    bug("no-epsilon", "Compute surfaces: spheres", "epsilon times 0", MOST, Bug::After(|| hits::no_epsilon.into_configs())),
    bug("normal-as-direction", "Compute surfaces: ellipsoids", "taken for a direction", SCALED, Bug::After(|| hits::normal_as_direction.into_configs())),
    bug("next-corner", "Compute surfaces: triangles", "barycentrics one corner on", MICROFACETS, Bug::After(|| triangles::next_corner.into_configs())),
    bug("shorter-normal", "Interpolate shading normals", "not brought to length 1", MICROFACETS, Bug::After(|| triangles::shorter.into_configs())),
    bug("constant-epsilon", "Compute surfaces: planes", "one epsilon, 1e-4", MOST, Bug::After(|| hits::constant_epsilon.into_configs())),
    bug("disk-inward", "Compute surfaces: disks", "sign of the normal", SHAPES, Bug::After(|| shapes::disk_inward.into_configs())),
    bug("rectangle-epsilon", "Compute surfaces: rectangles", "one epsilon, 1e-4", SHAPES, Bug::After(|| shapes::rectangle_epsilon.into_configs())),
    bug("round-cuboid", "Compute surfaces: cuboids", "normal as a sphere's", SHAPES, Bug::After(|| shapes::round_cuboid.into_configs())),
    bug("turned-inward", "Compute surfaces: moving shapes", "sign of the normal", MOVING, Bug::After(|| moving::turned_inward.into_configs())),
    bug("two-pixels", "Compute footprints", "two pixels for one", TEXTURED, Bug::After(|| textures::two_pixels.into_configs())),
    bug("half-colour", "Look up surface colours", "half of red", TEXTURED, Bug::After(|| textures::half_colour.into_configs())),
    bug("half-cell", "Compute texture points", "corner for middle", TEXTURED, Bug::After(|| textures::half_cell.into_configs())),
    bug("colours-exchanged", "Evaluate textures: checkers", "colours exchanged", TEXTURED, Bug::After(|| textures::colours_exchanged.into_configs())),
    bug("stripes-at-a-point", "Evaluate textures: stripes", "a point for the mean", TEXTURED, Bug::After(|| textures::stripes_at_a_point.into_configs())),
    bug("bytes-for-light", "Evaluate textures: images", "bytes taken for light", TEXTURED, Bug::After(|| textures::bytes_for_light.into_configs())),
    bug("mirrored", "Add the environment", "left for right", TEXTURED, Bug::Instead(|| textures::mirrored.into_configs())),
    bug("upside-down", "Add the gradient", "below for above", MIRRORED, Bug::Instead(|| moving::upside_down.into_configs())),
    bug("background-everywhere", "Add the background", "also where something is hit", MOST, Bug::Instead(|| light::background_everywhere.into_configs())),
    bug("no-cosine", "Sample point lights", "cosine left out", MOST, Bug::After(|| light::no_cosine.into_configs())),
    bug("sun-without-cosine", "Sample directional lights", "cosine left out", REFLECTION, Bug::After(|| light::sun_without_cosine.into_configs())),
    bug("no-distance", "Sample area lights", "square of the distance left out", SOFT, Bug::After(|| light::no_distance.into_configs())),
    bug("spot-without-fading", "Sample spot lights", "edge as bright as the middle", REFLECTION, Bug::After(|| light::spot_without_fading.into_configs())),
    bug("endless-t-max", "Clear shadow hits", "t_max without end", MOST, Bug::After(|| light::endless_t_max.into_configs())),
    bug("spheres-ignored", "Trace shadow rays: spheres", "not looked for", MOST, Bug::Instead(|| light::spheres_ignored.into_configs())),
    bug("ellipsoids-ignored", "Trace shadow rays: ellipsoids", "not looked for", SCALED, Bug::Instead(|| light::ellipsoids_ignored.into_configs())),
    bug("triangles-ignored", "Trace shadow rays: triangles", "not looked for", MICROFACETS, Bug::Instead(|| triangles::ignored.into_configs())),
    bug("behind-counts", "Trace shadow rays: planes", "t below 0 counts", MOST, Bug::Instead(|| light::behind_counts.into_configs())),
    bug("disks-ignored", "Trace shadow rays: disks", "not looked for", SHAPES, Bug::Instead(|| light::disks_ignored.into_configs())),
    bug("rectangles-ignored", "Trace shadow rays: rectangles", "not looked for", SHAPES, Bug::Instead(|| light::rectangles_ignored.into_configs())),
    bug("cuboids-ignored", "Trace shadow rays: cuboids", "not looked for", SHAPES, Bug::Instead(|| light::cuboids_ignored.into_configs())),
    bug("movers-ignored", "Trace shadow rays: moving shapes", "not looked for", MOVING, Bug::Instead(|| moving::nothing_moves.into_configs())),
    bug("blue-first", "Show unlit surfaces", "blue, green, red", PARALLEL, Bug::After(|| light::blue_first.into_configs())),
    bug("shadow-forgotten", "Evaluate direct light", "shadows not looked up", MOST, Bug::Instead(|| light::shadow_forgotten.into_configs())),
    bug("phong-forgotten", "Add Phong highlights", "none added", REFLECTION, Bug::Instead(|| light::phong_forgotten.into_configs())),
    bug("blinn-phong-forgotten", "Add Blinn–Phong highlights", "none added", REFLECTION, Bug::Instead(|| light::blinn_phong_forgotten.into_configs())),
    bug("emitted-twice", "Add emission", "added twice", REFLECTION, Bug::Instead(|| light::emitted_twice.into_configs())),
    bug("green-first", "Paint the view", "green for x, red for y", PAINTED, Bug::After(|| light::green_first.into_configs())),
    bug("added-twice", "Accumulate film", "added twice, counted once", MOST, Bug::After(|| light::added_twice.into_configs())),
    bug("gamma-twice", DEVELOP, "the curve taken twice", MOST, Bug::Develop(light::gamma_twice)),
];
