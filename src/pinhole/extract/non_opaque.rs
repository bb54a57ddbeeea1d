//! Shapes that are not opaque everywhere, or not from behind.

use super::check::kind_and_name;
use super::eye;
use super::material::used_material;
use super::motion::moves_while_open;
use super::shapes::{one_shape, shape_entities};
use super::textures::{NO_TEXTURE, UvImages};
use super::uv::UvSpaceTable;
use crate::material::{components_in_words, is_material, one_material};
use crate::plan::{Census, Evidence, Table};
use crate::scene::{Opacity, OpacityMap, SceneError, SingleSided, number};
use crate::shapes::AnyShape;
use bevy_ecs::prelude::*;
use std::collections::{BTreeMap, HashSet};
use std::sync::Arc;

/// Shapes of every kind that are not opaque to every ray, in spawn order; the tables of the kinds hold them, too, after all
/// others.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NonOpaqueTable {
    /// The shape.
    pub body: Vec<AnyShape>,
    /// Its number.
    pub shape: Vec<u32>,
    /// Where its material is opaque.
    pub coverage: Vec<Coverage>,
    /// The images of opacity.
    pub images: UvImages,
    /// The uv spaces of all shapes, where there are images.
    pub uv_spaces: Option<Arc<UvSpaceTable>>,
}

/// Where a material is opaque.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coverage {
    /// Its opacity, the same everywhere.
    pub opacity: Opacity,
    /// The row of the image that is a factor of it; [`NO_TEXTURE`] if there is none.
    pub image: u32,
    /// Whether it is not there for rays that arrive from behind.
    pub single_sided: bool,
}

/// Whether a material is not opaque to every ray.
fn is_open(scene: &Census<'_>, material: Entity) -> bool {
    scene.get::<OpacityMap>(material).is_some()
        || scene.get::<SingleSided>(material).is_some()
        || scene.get::<Opacity>(material).is_some_and(|own| own.with(1.0) != 1.0)
}

/// A predicate for the shapes that are not opaque to every ray.
pub(super) fn is_non_opaque(scene: &Census<'_>) -> impl Fn(Entity) -> bool {
    let any = owners(scene).iter().any(|list| !list.is_empty());
    move |shape| any && used_material(scene, shape).is_some_and(|material| is_open(scene, material))
}

/// The entities with each component that makes a material less than opaque, in spawn order.
fn owners(scene: &Census<'_>) -> [Arc<[Entity]>; 3] {
    [scene.entities::<With<Opacity>>(), scene.entities::<With<OpacityMap>>(), scene.entities::<With<SingleSided>>()]
}

/// Checks that every opacity is a number that it may be, on a material that takes it.
fn check_owners(scene: &Census<'_>) -> Result<(), SceneError> {
    for &owner in owners(scene).iter().flat_map(|list| list.iter()) {
        let word = if scene.get::<SingleSided>(owner).is_some() { "single sided" } else { "opacity" };
        let who = kind_and_name(scene, word, owner);
        let of_opaque =
            || format!("it belongs on a {}", components_in_words(scene, "", |material| !material.transmits));
        if !is_material(scene, owner) {
            return Err(SceneError::new(who, "material", "missing", of_opaque()));
        }
        let material = one_material(scene, owner)?;
        if material.transmits {
            return Err(SceneError::new(who, "material", material.word, of_opaque()));
        }
        let Some(own) = scene.get::<Opacity>(owner) else { continue };
        if !(0.0..=1.0).contains(&own.opacity) {
            return Err(SceneError::new(who, "opacity", number(own.opacity), "it must be from 0 to 1"));
        }
        if !(own.cutoff >= 0.0 && own.cutoff.is_finite()) {
            return Err(SceneError::new(who, "cutoff", number(own.cutoff), "it must be finite and at least 0"));
        }
    }
    Ok(())
}

impl Table for NonOpaqueTable {
    const NAME: &'static str = "non-opaque shapes";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        check_owners(scene)?;
        let (eye, moves, is_non_opaque) = (eye(scene)?, moves_while_open(scene), is_non_opaque(scene));
        let (mut table, mut images) = (Self::default(), BTreeMap::new());
        for (number, &shape) in shape_entities(scene).iter().enumerate() {
            let Some(material) = used_material(scene, shape).filter(|_| is_non_opaque(shape)) else { continue };
            let listed = one_shape(scene, shape)?;
            if moves(shape) {
                let who = kind_and_name(scene, listed.word, shape);
                let accepted = "a shape that moves while the shutter is open must be opaque and have two sides";
                return Err(SceneError::new(who, "opacity", "given to a shape that moves", accepted));
            }
            let mut image = NO_TEXTURE;
            if let Some(map) = scene.get::<OpacityMap>(material) {
                let next = images.len() as u32;
                image = *images.entry(material).or_insert(next);
                if image == next {
                    table.images.push(scene, material, map)?;
                }
            }
            table.body.push((listed.body)(scene, shape, eye)?);
            table.shape.push(number as u32);
            table.coverage.push(Coverage {
                opacity: scene.get::<Opacity>(material).copied().unwrap_or_default(),
                image,
                single_sided: scene.get::<SingleSided>(material).is_some(),
            });
        }
        if !images.is_empty() {
            table.uv_spaces = Some(scene.table::<UvSpaceTable>()?);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.body.len() * (size_of::<AnyShape>() + size_of::<u32>() + size_of::<Coverage>()) + self.images.bytes()
    }
}

/// Evidence that a shape is not opaque to every ray.
pub fn non_opaque_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| {
        let is_non_opaque = is_non_opaque(scene);
        let shapes = shape_entities(scene);
        let those: HashSet<Entity> = shapes.iter().copied().filter(|&shape| is_non_opaque(shape)).collect();
        Evidence::of_kind::<()>(scene, "non-opaque shape", |entity| those.contains(&entity))
    })
}
