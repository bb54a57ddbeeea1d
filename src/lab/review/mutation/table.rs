use super::{Bug, Mutation, hits, light, moving, rays, shapes, textures};
use bevy_ecs::prelude::*;
use pinhole::film::film_stage;
use pinhole::follow::direct_light_stage;
use pinhole::intersect::{
    classify_stage, cuboid_stage, cuboid_surface_stage, disk_stage, disk_surface_stage, ellipsoid_stage,
    ellipsoid_surface_stage, mesh_stage, mesh_surface_stage, moving_stage, moving_surface_stage, plane_stage,
    plane_surface_stage, rectangle_stage, rectangle_surface_stage, shading_normal_stage, sphere_stage,
    sphere_surface_stage, triangle_stage, triangle_surface_stage,
};
use pinhole::look::view_stage;
use pinhole::material::{BlinnPhongTable, MatteTable, PhongTable};
use pinhole::plan::Stage;
use pinhole::rasterise::{box_stage, rasterise_stage};
use pinhole::rays::{
    lens_point_stage, lens_stage, ndc_stage, orthographic_stage, perspective_stage, place_samples_stage, raster_stage,
    screen_stage, time_stage, world_stage,
};
use pinhole::shade::{
    area_light_stage, background_stage, checker_stage, colour_stage, directional_light_stage, emissive_stage,
    environment_stage, footprint_stage, gradient_stage, image_stage, moving_shadow_stage, plane_shadow_stage,
    point_light_stage, shape_shadow_stage, sphere_shadow_stage, spot_light_stage, start_shadow_rays_stage,
    start_shadow_stage, stripes_stage, texture_point_stage, unlit_stage,
};
use pinhole::shapes::{
    Ellipsoid, PlacedDisk, PlacedMesh, PlacedRectangle, PlacedSphere, PlacedTorus, Slabs, TriangleRow,
};
use pinhole::{intersect, shade};

/// A row of the table.
const fn bug(
    name: &'static str,
    stage: fn() -> Stage,
    mistake: &'static str,
    chapter: &'static str,
    bug: Bug,
) -> Mutation {
    Mutation { name, at: Some(stage), mistake, chapter, bug }
}

/// The chapter in which most mutations are made: balls, a ground, a light and a background.
const PINHOLE: &str = "05_pinhole";
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
/// A wheel with a round rim.
const FILM: &str = "36_film";
/// Models of many triangles.
const MODELS: &str = "28_meshes";
/// A camera that rasterises.
const PROJECTED: &str = "32_projection";
/// A camera that rasterises a sphere's box.
const BOXED: &str = "33_rasterisation";
/// A gradient behind mirrors.
const MIRRORED: &str = "19_mirrors";
/// A column painted for the picture.
const PAINTED: &str = "02_ray";

/// Every bug, in the order of the stages; at least one at each.
#[rustfmt::skip]
pub static MUTATIONS: &[Mutation] = &[
    bug("half-pixel", raster_stage, "no + 0.5", PINHOLE, Bug::After(|| rays::half_pixel.into_configs())),
    bug("one-pattern", place_samples_stage, "every pixel alike", SAMPLED, Bug::After(|| rays::one_pattern.into_configs())),
    bug("radius-doubled", place_samples_stage, "twice as far from the centre", SAMPLED, Bug::After(|| rays::radius_doubled.into_configs())),
    bug("size-less-one", ndc_stage, "divided by size − 1", PINHOLE, Bug::After(|| rays::size_less_one.into_configs())),
    bug("y-down", screen_stage, "sign of y", PINHOLE, Bug::After(|| rays::y_down.into_configs())),
    bug("no-aspect", screen_stage, "aspect left out", PINHOLE, Bug::After(|| rays::no_aspect.into_configs())),
    bug("half-open", lens_point_stage, "half of the opening", BLURRED, Bug::After(|| moving::half_open.into_configs())),
    bug("all-at-once", time_stage, "one time for all rays", MOVING, Bug::After(|| moving::all_at_once.into_configs())),
    bug("left-for-right", lens_stage, "left for right", BLURRED, Bug::After(|| moving::left_for_right.into_configs())),
    bug("whole-angle", perspective_stage, "tangent of the whole angle", PINHOLE, Bug::After(|| rays::whole_angle.into_configs())),
    bug("plus-z", perspective_stage, "looks along +z", PINHOLE, Bug::After(|| rays::plus_z.into_configs())),
    bug("whole-height", orthographic_stage, "height for its half", PARALLEL, Bug::After(|| rays::whole_height.into_configs())),
    bug("transpose", world_stage, "matrix transposed", PINHOLE, Bug::After(|| rays::transposed.into_configs())),
    bug("near-end", intersect::start_stage, "nothing hit beyond t = 8", PINHOLE, Bug::After(|| hits::near_end.into_configs())),
    bug("not-dark", shade::start_stage, "light starts at 0.05", PINHOLE, Bug::After(|| light::not_dark.into_configs())),
    bug("light-left-over", start_shadow_rays_stage, "not emptied", PINHOLE, Bug::Instead(|| light::light_left_over.into_configs())),
    bug("far-root", sphere_stage, "where the ray leaves", PINHOLE, Bug::Instead(|| hits::far_root.into_configs())),
    bug("unit-ray", ellipsoid_stage, "unit ray, t kept", SCALED, Bug::Instead(|| hits::ellipsoid_unit_ray.into_configs())),
    bug("two-edges", triangle_stage, "third edge not asked for", MICROFACETS, Bug::Instead(|| shapes::two_edges.into_configs())),
    bug("own-unit", mesh_stage, "t in the mesh's own unit", MODELS, Bug::After(|| shapes::own_unit.into_configs())),
    bug("depth-for-distance", rasterise_stage, "depth taken for the distance along the ray", PROJECTED, Bug::After(|| shapes::depth_for_distance.into_configs())),
    bug("every-second-line", box_stage::<PlacedSphere>, "every second line left out", BOXED, Bug::After(|| shapes::every_second_line.into_configs())),
    bug("plane-sign", plane_stage, "sign of k", PINHOLE, Bug::Instead(|| hits::plane_sign.into_configs())),
    bug("disk-square", disk_stage, "the square about it", SHAPES, Bug::Instead(|| shapes::disk_square.into_configs())),
    bug("one-coordinate", rectangle_stage, "one coordinate asked", SHAPES, Bug::Instead(|| shapes::one_coordinate.into_configs())),
    bug("cuboid-far-side", cuboid_stage, "where the ray leaves", SHAPES, Bug::Instead(|| shapes::cuboid_far_side.into_configs())),
    bug("tori-unseen", intersect::intersect_stage::<PlacedTorus>, "not looked for", FILM, Bug::Instead(|| shapes::tori_ignored.into_configs())),
    bug("nothing-moves", moving_stage, "not looked for", MOVING, Bug::Instead(|| moving::nothing_moves.into_configs())),
    bug("zero-is-none", classify_stage, "shape 0 taken for none", PINHOLE, Bug::After(|| hits::zero_is_none.into_configs())),
    bug("normal-inward", sphere_surface_stage, "sign of the normal", PINHOLE, Bug::After(|| hits::normal_inward.into_configs())),
    bug("no-epsilon", sphere_surface_stage, "epsilon times 0", PINHOLE, Bug::After(|| hits::no_epsilon.into_configs())),
    bug("normal-as-direction", ellipsoid_surface_stage, "taken for a direction", SCALED, Bug::After(|| hits::normal_as_direction.into_configs())),
    bug("next-corner", triangle_surface_stage, "barycentrics one corner on", MICROFACETS, Bug::After(|| shapes::next_corner.into_configs())),
    bug("mesh-inward", mesh_surface_stage, "sign of the normal", MODELS, Bug::After(|| shapes::inward.into_configs())),
    bug("shorter-normal", shading_normal_stage, "not brought to length 1", MICROFACETS, Bug::After(|| shapes::shorter.into_configs())),
    bug("constant-epsilon", plane_surface_stage, "one epsilon, 1e-4", PINHOLE, Bug::After(|| hits::constant_epsilon.into_configs())),
    bug("disk-inward", disk_surface_stage, "sign of the normal", SHAPES, Bug::After(|| shapes::disk_inward.into_configs())),
    bug("rectangle-epsilon", rectangle_surface_stage, "one epsilon, 1e-4", SHAPES, Bug::After(|| shapes::rectangle_epsilon.into_configs())),
    bug("round-cuboid", cuboid_surface_stage, "normal as a sphere's", SHAPES, Bug::After(|| shapes::round_cuboid.into_configs())),
    bug("torus-inward", intersect::surface_stage::<PlacedTorus>, "sign of the normal", FILM, Bug::After(|| shapes::torus_inward.into_configs())),
    bug("turned-inward", moving_surface_stage, "sign of the normal", MOVING, Bug::After(|| moving::turned_inward.into_configs())),
    bug("two-pixels", footprint_stage, "two pixels for one", TEXTURED, Bug::After(|| textures::two_pixels.into_configs())),
    bug("half-colour", colour_stage, "half of red", TEXTURED, Bug::After(|| textures::half_colour.into_configs())),
    bug("half-cell", texture_point_stage, "corner for middle", TEXTURED, Bug::After(|| textures::half_cell.into_configs())),
    bug("colours-exchanged", checker_stage, "colours exchanged", TEXTURED, Bug::After(|| textures::colours_exchanged.into_configs())),
    bug("stripes-at-a-point", stripes_stage, "a point for the mean", TEXTURED, Bug::After(|| textures::stripes_at_a_point.into_configs())),
    bug("bytes-for-light", image_stage, "bytes taken for light", TEXTURED, Bug::After(|| textures::bytes_for_light.into_configs())),
    bug("mirrored", environment_stage, "left for right", TEXTURED, Bug::Instead(|| textures::mirrored.into_configs())),
    bug("upside-down", gradient_stage, "below for above", MIRRORED, Bug::Instead(|| moving::upside_down.into_configs())),
    bug("background-everywhere", background_stage, "also where something is hit", PINHOLE, Bug::Instead(|| light::background_everywhere.into_configs())),
    bug("no-cosine", point_light_stage, "cosine left out", PINHOLE, Bug::After(|| light::no_cosine.into_configs())),
    bug("sun-without-cosine", directional_light_stage, "cosine left out", REFLECTION, Bug::After(|| light::sun_without_cosine.into_configs())),
    bug("no-distance", area_light_stage, "square of the distance left out", SOFT, Bug::After(|| light::no_distance.into_configs())),
    bug("spot-without-fading", spot_light_stage, "edge as bright as the middle", REFLECTION, Bug::After(|| light::spot_without_fading.into_configs())),
    bug("endless-t-max", start_shadow_stage, "t_max without end", PINHOLE, Bug::After(|| light::endless_t_max.into_configs())),
    bug("spheres-ignored", sphere_shadow_stage, "not looked for", PINHOLE, Bug::Instead(|| light::spheres_ignored.into_configs())),
    bug("ellipsoids-ignored", shape_shadow_stage::<Ellipsoid>, "not looked for", SCALED, Bug::Instead(|| light::ellipsoids_ignored.into_configs())),
    bug("triangles-ignored", shape_shadow_stage::<TriangleRow>, "not looked for", MICROFACETS, Bug::Instead(|| shapes::triangles_ignored.into_configs())),
    bug("meshes-ignored", shape_shadow_stage::<PlacedMesh>, "not looked for", MODELS, Bug::Instead(|| shapes::meshes_ignored.into_configs())),
    bug("behind-counts", plane_shadow_stage, "t below 0 counts", PINHOLE, Bug::Instead(|| light::behind_counts.into_configs())),
    bug("disks-ignored", shape_shadow_stage::<PlacedDisk>, "not looked for", SHAPES, Bug::Instead(|| light::disks_ignored.into_configs())),
    bug("rectangles-ignored", shape_shadow_stage::<PlacedRectangle>, "not looked for", SHAPES, Bug::Instead(|| light::rectangles_ignored.into_configs())),
    bug("cuboids-ignored", shape_shadow_stage::<Slabs>, "not looked for", SHAPES, Bug::Instead(|| light::cuboids_ignored.into_configs())),
    bug("tori-ignored", shape_shadow_stage::<PlacedTorus>, "not looked for", FILM, Bug::Instead(|| shapes::tori_ignored.into_configs())),
    bug("movers-ignored", moving_shadow_stage, "not looked for", MOVING, Bug::Instead(|| moving::nothing_moves.into_configs())),
    bug("blue-first", unlit_stage, "blue, green, red", PARALLEL, Bug::After(|| light::blue_first.into_configs())),
    bug("shadow-forgotten", direct_light_stage::<MatteTable>, "shadows not looked up", PINHOLE, Bug::Instead(|| light::shadow_forgotten.into_configs())),
    bug("phong-forgotten", direct_light_stage::<PhongTable>, "none added", REFLECTION, Bug::Instead(|| light::phong_forgotten.into_configs())),
    bug("blinn-phong-forgotten", direct_light_stage::<BlinnPhongTable>, "none added", REFLECTION, Bug::Instead(|| light::blinn_phong_forgotten.into_configs())),
    bug("emitted-twice", emissive_stage, "added twice", REFLECTION, Bug::Instead(|| light::emitted_twice.into_configs())),
    bug("green-first", || view_stage(&[]), "green for x, red for y", PAINTED, Bug::After(|| light::green_first.into_configs())),
    bug("added-twice", film_stage, "added twice, counted once", PINHOLE, Bug::After(|| light::added_twice.into_configs())),
    Mutation { name: "gamma-twice", at: None, mistake: "the curve taken twice", chapter: PINHOLE, bug: Bug::Develop(light::gamma_twice) },
];
