//! Materials: how a surface scatters light, one file for each BSDF (bidirectional scattering distribution function).
//!
//! Reads: the components of materials.
//! Writes: a table of parameters for each BSDF, and the [`MaterialTable`], which says which of them an entity has.
//! Space: directions are unit vectors in the frame of the surface, whose normal is +z, but for specular BSDFs, which
//! reflect and refract the rays of render space as they are.
//!
//! A BSDF implements [`Bsdf`] and stands in one list, `for_each_bsdf`; the stages that evaluate direct light, sample
//! directions and weight light samples are generic over it, and nothing outside its file asks which material it is.
//!
//! ```
//! use pinhole::material::fresnel;
//!
//! // Glass reflects 4 % of the light at normal incidence and all of it at grazing incidence.
//! assert!((fresnel(1.0, 1.5) - 0.04).abs() < 1e-15);
//! assert_eq!(fresnel(0.0, 1.5), 1.0);
//! ```

mod blinn_phong;
mod bsdf;
mod dispersion;
mod frame;
mod fresnel;
mod ggx;
mod glass;
mod highlight;
mod matte;
mod metal;
mod mirror;
mod multiple_scattering;
mod phase;
mod phong;
mod power;
mod principled;
mod rough_glass;
mod thin_glass;

/// Every BSDF: its kind, its table, and its name in the names of stages and columns; a new one is a line here.
// ANCHOR: bsdf_list
macro_rules! for_each_bsdf {
    ($then:ident) => {
        $then! {
            Matte(MatteTable, "matte"),
            Phong(PhongTable, "Phong"),
            BlinnPhong(BlinnPhongTable, "Blinn–Phong"),
            Mirror(MirrorTable, "mirror"),
            Glass(SmoothGlass, "glass"),
            Metal(MetalTable, "metal"),
            RoughGlass(RoughGlassTable, "rough glass"),
            Principled(PrincipledTable, "principled"),
            ThinGlass(ThinGlassTable, "thin glass"),
        }
    };
}
// ANCHOR_END: bsdf_list
pub use bsdf::{
    Bsdf, BsdfClass, BsdfSample, ErasedBsdf, Example, Interior, MaterialKind, MaterialTable, NO_ROW, Named, Parameters,
    REGISTERED, Registration, ShadingContext, Spawn, SpecularSample, StageNames, Transport, add_material,
    declared_materials, entities_of_kind, is_material, material_entities, material_kind, registered_materials,
};
pub(crate) use bsdf::{NUMBERS, check_kinds, components_in_words, frame_about, interior_of, one_material, reverse_pdf};
pub(crate) use for_each_bsdf;
pub use highlight::{Highlight, HighlightTable, Lobe, highlight};
pub use principled::PrincipledTable;

/// Gives a BSDF its kind, and its stages and its column the names that are made from its own.
#[doc(hidden)]
#[macro_export]
macro_rules! named_bsdf {
    ($table:ty, $kind:expr, $name:literal) => {
        impl $crate::named::Named for $table {
            const KIND: $crate::named::MaterialKind = $kind;
            const NAMES: $crate::named::StageNames = $crate::named::StageNames {
                sample: concat!("Sample BSDFs: ", $name),
                sample_from_lights: concat!("Sample BSDFs: ", $name, ", from lights"),
                split: concat!("Split rays at ", $name),
                direct_light: concat!("Evaluate direct light: ", $name),
                connections: concat!("Evaluate connections to the camera: ", $name),
                photons: concat!("Gather photons: ", $name),
                join: concat!("Join light vertices: ", $name),
                join_weights: concat!("Compute MIS weights of joins: ", $name),
                ratios: concat!("Carry MIS ratios on: ", $name),
                mis: concat!("Compute MIS weights: ", $name),
                classify: concat!("List rows: ", $name),
                rows: concat!($name, " rows"),
            };
        }
    };
}
pub use named_bsdf;

/// Makes a BSDF one that a scene can have by [`add_material`]: its number among those that a program adds, and its name in
/// the names of its stages.
#[macro_export]
macro_rules! custom_bsdf {
    ($table:ty, $number:literal, $name:literal) => {
        $crate::named_bsdf!(
            $table,
            $crate::named::MaterialKind::Custom {
                number: $number,
                class: <$table as $crate::named::Bsdf>::CLASS,
                transmits: <$table as $crate::named::Bsdf>::TRANSMITS,
            },
            $name
        );
    };
}
pub use custom_bsdf;

pub use blinn_phong::{BlinnPhongLobe, BlinnPhongTable, blinn_phong_peak, half_vector_cosine};
pub(crate) use dispersion::checked_curve;
pub use dispersion::{D_LINE, IndexCurve};
pub use frame::{cosine_direction, cosine_pdf, frame_of};
pub use fresnel::{fresnel, fresnel_parts, mirror_direction, refract};
pub use ggx::{MicrofacetSample, ggx_brdf, ggx_d, ggx_g1, ggx_lambda, ggx_sample, visible_normal, visible_pdf};
pub use glass::{SmoothGlass, glass_event, glass_samples, layered_reflectance};
pub use matte::{MatteTable, lambertian};
pub use metal::{MetalTable, SMOOTHEST_METAL};
pub use mirror::MirrorTable;
pub use multiple_scattering::{ByCosine, MultipleScattering, multiple_scattering_albedo, single_scattering};
pub use phase::{PhaseTable, henyey_greenstein, henyey_greenstein_sample, media_entities};
pub use phong::{PhongLobe, PhongTable, mirror_cosine, phong_peak};
pub use rough_glass::RoughGlassTable;
pub use thin_glass::{ThinGlassTable, pane_reflectance};
