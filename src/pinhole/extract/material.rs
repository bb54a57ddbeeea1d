//! Which materials shapes are made of, and the evidence that stages need of them.

use super::medium::scattering_evidence;
use super::shapes::shape_entities;
use crate::material::{
    Bsdf, BsdfClass, MaterialKind, Registration, declared_materials, is_material, material_entities, material_kind,
    registered_materials,
};
use crate::plan::{Census, Evidence};
use crate::scene::{Disabled, UsesMaterial};
use bevy_ecs::prelude::*;
use std::collections::HashSet;
use std::sync::Arc;

/// The enabled entity that holds a shape's material: itself, or the one that it uses.
pub(super) fn used_material(scene: &Census<'_>, shape: Entity) -> Option<Entity> {
    let used = scene.get::<UsesMaterial>(shape).map(|used| used.0);
    let is_there = |entity: &Entity| is_material(scene, *entity) && scene.get::<Disabled>(*entity).is_none();
    [Some(shape), used].into_iter().flatten().find(is_there)
}

/// The entities that hold the materials of shapes.
pub(super) fn in_use(scene: &Census<'_>) -> Arc<HashSet<Entity>> {
    scene.once(|scene| {
        let shapes = shape_entities(scene);
        let used = shapes.iter().filter_map(|&shape| scene.get::<UsesMaterial>(shape)).map(|used| used.0);
        Arc::new(used.chain(shapes.iter().copied()).collect())
    })
}

/// Evidence of a shape that carries this component, or uses a material that does.
pub fn material_kind_evidence<C: Component>(scene: &Census<'_>, noun: &str) -> Evidence {
    let in_use = in_use(scene);
    Evidence::among::<With<C>>(scene, noun, |entity| in_use.contains(&entity.id()))
}

/// Evidence of a shape whose material is of a kind that passes a test; `noun` names one such surface.
pub fn materials_evidence(scene: &Census<'_>, noun: &str, such: impl Fn(MaterialKind) -> bool) -> Evidence {
    let (in_use, such) = (in_use(scene), |&entity: &Entity| material_kind(scene, entity).is_some_and(&such));
    let of = |entities: Arc<[Entity]>| entities.iter().copied().filter(such).collect::<Vec<_>>();
    let (enabled, declared) = (of(material_entities(scene)), of(declared_materials(scene)));
    Evidence::among_entities(scene, noun, |entity| in_use.contains(&entity), &enabled, &declared)
}

/// Evidence of a shape with this BSDF.
pub fn bsdf_evidence<B: Bsdf>(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| materials_evidence(scene, B::NOUN, |kind| kind == B::KIND))
}

/// The evidence of each BSDF that passes a test, those in use one after another.
fn any_evidence(scene: &Census<'_>, none: &str, such: impl Fn(&Registration) -> bool) -> Evidence {
    let each = registered_materials(scene).filter(|own| such(own));
    let each = each.map(|own| materials_evidence(scene, own.noun, |kind| kind == own.kind));
    let found = each.filter(|own| own.needed).reduce(Evidence::or);
    found.unwrap_or_else(|| {
        materials_evidence(scene, none, |kind| registered_materials(scene).any(|own| own.kind == kind && such(own)))
    })
}

/// Evidence of a shape whose material is not specular, any but mirrors and smooth glass, or of a medium that scatters.
pub fn material_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| or_scattering(scene, materials_evidence(scene, "material", |kind| !kind.is_specular())))
}

/// The evidence of surfaces, and that of media that scatter light as they do, where a scene has any.
fn or_scattering(scene: &Census<'_>, surfaces: Evidence) -> Evidence {
    let scattering = scattering_evidence(scene);
    if scattering.needed { surfaces.or(scattering) } else { surfaces }
}

/// Evidence of a shape with diffuse reflection, whatever else its material has.
pub fn matte_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| any_evidence(scene, "matte surface", |own| own.class == BsdfClass::Diffuse))
}

/// Evidence of a shape whose material is glossy, so that it shows what surrounds it.
pub fn glossy_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| any_evidence(scene, "glossy surface", |own| own.class == BsdfClass::Glossy))
}

/// Evidence of a shape whose material is specular.
pub fn specular_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| any_evidence(scene, "specular surface", |own| own.class == BsdfClass::Specular))
}

/// Evidence of a shape whose surface transmits light.
pub fn glass_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| any_evidence(scene, "glass surface", |own| own.transmits))
}

/// Evidence of a shape that transmits light and is lit by light sampling, or of a medium that scatters.
pub fn lit_from_behind_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| {
        let such = |own: &Registration| own.transmits && own.class != BsdfClass::Specular;
        or_scattering(scene, any_evidence(scene, "diffusely transmitting surface", such))
    })
}
