//! The components that are materials; a new one is a module, an export and a word here.

mod blinn_phong;
mod glass;
mod matte;
mod metal;
mod mirror;
mod phong;
mod principled;
mod rough_glass;
mod thin_glass;

pub use blinn_phong::BlinnPhong;
pub use glass::Glass;
#[doc(hidden)]
pub use matte::UsedByShapes;
pub use matte::{Matte, UsesMaterial};
pub use metal::Metal;
pub use mirror::Mirror;
pub use phong::Phong;
pub use principled::Principled;
pub use rough_glass::RoughGlass;
#[doc(hidden)]
pub use thin_glass::ThinGlass;

use super::file::Word;
use bevy_ecs::prelude::*;

/// Whether an entity has a material of its own.
pub(super) fn is_material(entity: EntityRef<'_>) -> bool {
    MATERIALS.iter().any(|word| entity.contains_type_id((word.kind)()))
}

/// Every component that is a material, with its word in scene files.
pub(super) const MATERIALS: &[Word] = &[
    Word::of::<Matte>("matte"),
    Word::of::<Phong>("phong"),
    Word::of::<BlinnPhong>("blinn_phong"),
    Word::of::<Mirror>("mirror"),
    Word::of::<Glass>("glass"),
    Word::of::<Metal>("metal"),
    Word::of::<RoughGlass>("rough_glass"),
    Word::of::<Principled>("principled"),
    Word::of::<ThinGlass>("thin_glass"),
];
