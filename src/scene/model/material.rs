//! The materials of a model, as components, and what of them has no counterpart here.

use super::components_of::name;
use super::material_notes::MaterialNotes;
use super::open_model::OpenModel;
use crate::{
    Degrees, EmissionMap, Emissive, Glass, ImageTexture, MetallicRoughnessMap, Name, NormalMap, Opacity,
    OpacityChannel, OpacityMap, Principled, Rgb, RoughGlass, Sides, SingleSided, TextureBy, ThinGlass, UvTransform,
    Wrap, WrapMode,
};
use bevy_ecs::prelude::*;
use glam::DVec2;
use pinhole_models::{AlphaMode, ModelMaterial, ModelTexture, TextureWrap};

/// The factor of roughness squared below which glass is smooth.
const SMOOTH: f64 = 1e-3;
/// The roughness above which a pane is seen to be frosted.
const FROSTED: f64 = 0.1;
/// The most that a surface of a model emits, well within what f32 holds.
const BRIGHTEST: f64 = 1e30;
/// The indices of refraction that glass may have, and those of a dielectric that lies over a diffuse base.
const OF_GLASS: [f64; 2] = [1.0, 1000.0];
const OF_DIELECTRICS: [f64; 2] = [1.0, 1e9];

/// How light goes through a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Transmits {
    /// Not at all.
    Opaque,
    /// Straight on, as through a window pane.
    Thin,
    /// Into an interior.
    Solid,
}

/// How light goes through surfaces of a material, of meshes that enclose an interior or do not.
///
/// What is metal lets no light through, and the rest as much as the material says; more than half counts as all.
fn transmits(own: &ModelMaterial, is_closed: impl FnOnce() -> bool) -> Transmits {
    // An image of metallic is one of the parts that are no glass.
    let metallic = if own.metallic_roughness_texture.is_some() { 0.0 } else { own.metallic };
    match own.transmission * (1.0 - metallic) > 0.5 {
        false => Transmits::Opaque,
        true if own.thin || !is_closed() => Transmits::Thin,
        true => Transmits::Solid,
    }
}

/// Spawns a material of a model, and counts what of it is left out.
///
/// Those that are single-sided are so here where it is asked for.
pub fn spawn_material(
    scene: &mut World,
    (model, material): (&OpenModel, usize),
    single_sided: bool,
    notes: &mut MaterialNotes,
) -> Entity {
    let Some(own) = model.model.materials.get(material).cloned() else {
        let tint = model.tint_of(material, false);
        // White under the colours of vertices.
        let base_colour = Rgb::grey(if tint.is_some() { 1.0 } else { 0.8 });
        let grey = Principled { base_colour, metallic: 0.0, roughness: 0.5, ..Principled::default() };
        let entity = scene.spawn((grey, Name::new("default material"))).id();
        if let Some(tint) = tint {
            scene.entity_mut(entity).insert(tint);
        }
        return entity;
    };
    let [r, g, b] = own.base_colour;
    let base_colour = Rgb::new(r, g, b);
    // 0 stands for a dielectric that reflects all light.
    let ior = |[min, max]: [f64; 2]| if own.ior == 0.0 { max } else { own.ior.clamp(min, max) };
    let transmits = transmits(&own, || model.is_closed(material));
    let alpha = own.roughness * own.roughness;
    let entity = match transmits {
        Transmits::Opaque => {
            let ior = ior(OF_DIELECTRICS);
            let (metallic, roughness) = (own.metallic, own.roughness);
            let (coat, coat_roughness) = (own.coat, own.coat_roughness);
            scene.spawn(Principled { base_colour, metallic, roughness, ior, coat, coat_roughness }).id()
        }
        Transmits::Thin => {
            notes.open_glass += usize::from(!own.thin);
            notes.frosted += usize::from(own.roughness > FROSTED);
            scene.spawn(ThinGlass { ior: ior(OF_GLASS), colour: base_colour }).id()
        }
        Transmits::Solid => {
            notes.tinted += usize::from(own.base_colour != [1.0; 3]);
            let [r, g, b] = own.absorption;
            let (ior, absorption) = (ior(OF_GLASS), Rgb::new(r, g, b));
            if alpha < SMOOTH {
                scene.spawn(Glass { ior, absorption, ..Glass::default() }).id()
            } else {
                scene.spawn(RoughGlass { ior, roughness: alpha, absorption, ..RoughGlass::default() }).id()
            }
        }
    };
    name(scene, entity, &own.name);
    remark(&own, transmits, !single_sided && model.is_open_somewhere(material), notes);
    let mut named = |scene: &mut World, texture: Option<ModelTexture>| {
        let texture = texture?;
        match model.name_of_image(scene, texture.image) {
            Ok(file) => Some((file, wrap_of(texture.wrap), transform_of(&texture), !texture.nearest)),
            Err(why) => {
                let materials = notes.missing_images.entry(why).or_default();
                if !materials.contains(&own.name) {
                    materials.push(own.name.clone());
                }
                None
            }
        }
    };
    if own.emission != [0.0; 3] {
        let [r, g, b] = own.emission.map(|part| part.min(BRIGHTEST));
        let map = named(scene, own.emission_texture);
        // Without its image, mostly black as a rule, all of the surface would shine.
        if map.is_some() || own.emission_texture.is_none() {
            let sides = if own.double_sided { Sides::Both } else { Sides::Front };
            scene.entity_mut(entity).insert(Emissive { radiance: Rgb::new(r, g, b), sides });
        }
        if let Some((file, wrap, transform, filter)) = map {
            scene.entity_mut(entity).insert(EmissionMap { file, size: 1.0, wrap, transform, filter });
        }
    }
    if let Some((file, wrap, transform, _)) = named(scene, own.normal_texture) {
        let scale = if own.normal_scale.is_finite() { own.normal_scale } else { 1.0 };
        scene.entity_mut(entity).insert(NormalMap { file, scale, size: 1.0, wrap, transform });
    }
    if transmits != Transmits::Opaque {
        return entity;
    }
    let base_colour_map = named(scene, own.base_colour_texture);
    if single_sided && !own.double_sided {
        scene.entity_mut(entity).insert(SingleSided {});
    }
    if let Some(opacity) = opacity_of(&own) {
        scene.entity_mut(entity).insert(opacity);
        let of_colour = || base_colour_map.clone().map(|map| (map, OpacityChannel::Alpha));
        let map = named(scene, own.opacity_texture).map(|map| (map, OpacityChannel::Red)).or_else(of_colour);
        if let Some(((file, wrap, transform, filter), channel)) = map {
            scene.entity_mut(entity).insert(OpacityMap { file, channel, size: 1.0, wrap, transform, filter });
        }
    }
    if let Some(tint) = model.tint_of(material, base_colour_map.is_some()) {
        scene.entity_mut(entity).insert(tint);
    }
    if let Some((file, wrap, transform, filter)) = base_colour_map {
        scene.entity_mut(entity).insert(ImageTexture { file, size: 1.0, by: TextureBy::Uv, wrap, transform, filter });
    }
    if let Some((file, wrap, transform, filter)) = named(scene, own.metallic_roughness_texture) {
        scene.entity_mut(entity).insert(MetallicRoughnessMap { file, size: 1.0, wrap, transform, filter });
    }
    entity
}

/// The opacity of a material, without its image; none where its alpha has no meaning.
fn opacity_of(own: &ModelMaterial) -> Option<Opacity> {
    match own.alpha_mode {
        AlphaMode::Opaque => None,
        AlphaMode::Mask { cutoff } => Some(Opacity { opacity: own.alpha, mask: true, cutoff }),
        AlphaMode::Blend => Some(Opacity { opacity: own.alpha, ..Opacity::default() }),
    }
}

/// Counts what a material says and its components do not.
fn remark(own: &ModelMaterial, transmits: Transmits, is_open: bool, notes: &mut MaterialNotes) {
    notes.in_part += usize::from(own.transmission > 0.0 && own.transmission < 1.0 && own.metallic < 1.0);
    if transmits == Transmits::Opaque {
        notes.seen_from_behind += usize::from(!own.double_sided && is_open);
        return;
    }
    let has_alpha = own.alpha < 1.0 || own.base_colour_texture.is_some();
    notes.glass_alphas += usize::from(has_alpha && own.alpha_mode != AlphaMode::Opaque);
    notes.glass_colours += usize::from(own.base_colour_texture.is_some());
    notes.glass_roughnesses += usize::from(own.metallic_roughness_texture.is_some());
}

fn wrap_of(axes: [TextureWrap; 2]) -> Wrap {
    let mode = |wrap| match wrap {
        TextureWrap::Repeat => WrapMode::Repeat,
        TextureWrap::Clamp => WrapMode::Clamp,
        TextureWrap::Mirror => WrapMode::Mirror,
    };
    axes.map(mode).into()
}

fn transform_of(texture: &ModelTexture) -> UvTransform {
    let ModelTexture { offset, rotation, scale, .. } = *texture;
    UvTransform { offset: offset.into(), rotation: Degrees(rotation.to_degrees()), scale: DVec2::from(scale) }
}
