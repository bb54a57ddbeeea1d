//! Lights without an area: what such a light is, the lights there are, and the mathematics of each.
//!
//! Reads: a light's component and its placement; a point that it may illuminate.
//! Gives: the direction and the distance to the light, the irradiance there, its power, the rays that leave it.
//! Space: render space, with the axes of world space and the eye at its origin.
//!
//! [`Light`] is all that the rest of the renderer asks of one; `with_lights` lists those that implement it, one line
//! each.
//! A further light is a file of this folder, its lines here, and its component and its word in `scene`.
//! Shapes that emit and the environment have tables and stages of their own.

/// The registered lights, one line each; a further light is added with a line, and everything else is generic over it.
///
/// A line holds its name among lights of any kind, the type that implements [`Light`](crate::lights::Light), and its
/// plural.
/// The order is that of the stages, and thus that in which a surface sums their light.
// ANCHOR: light_list
macro_rules! with_lights {
    ($then:ident) => {
        $then! {
            Directional(crate::lights::PlacedDirectionalLight) "directional lights",
            Point(crate::lights::PlacedPointLight) "point lights",
            Spot(crate::lights::PlacedSpotLight) "spot lights",
        }
    };
}
// ANCHOR_END: light_list

mod choose_light;
mod directional;
mod light;
mod light_bounds;
mod light_hierarchy;
mod point;
mod spot;
mod targets;

pub use choose_light::{ChosenLight, Receiver};
pub use directional::PlacedDirectionalLight;
pub use light::{
    AnyLight, CustomLight, Light, LightNames, LightSample, LightStart, LightVisitor, ListedLight, PlacedLight,
    SceneLight, StartDraws, custom_light, irradiance_from_direction, irradiance_from_point, light_names, luminance,
    visit_lights,
};
pub use light_bounds::LightBounds;
pub use light_hierarchy::LightHierarchy;
pub use point::PlacedPointLight;
pub use spot::{PlacedSpotLight, spot_falloff, versine, versine_of_half};
pub use targets::{
    AT_ONCE, Cones, MAX_TARGETS, MAX_TARGETS_SOLID_ANGLE, NO_TARGETS, TOWARDS, Target, Targets, cones_around,
    direction_to_targets,
};
