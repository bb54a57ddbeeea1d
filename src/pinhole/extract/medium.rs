//! The participating media of a scene, and what each of them fills.

use super::cameras::{camera_of, eye};
use super::check::kind_and_name;
use super::density::{PlacedGrid, grid_beside, placed};
use super::integrator::integrator_of;
use super::material::used_material;
use super::motion::{moves_while_open, velocity_of};
use super::shapes::{bodies_in_words, listed_kinds, one_shape};
use super::{GlassBodyTable, GlassTable, glass_evidence, many_area_lights_evidence, shape_entities};
use crate::check::triple;
use crate::each::Each;
use crate::material::{Bsdf, PhaseTable, interior_of, is_material, material_entities, media_entities, one_material};
use crate::plan::{Census, Evidence, Table, united};
use crate::scene::{
    BidirectionalPathTracing, DensityGrid, Disabled, Emissive, Medium, PhotonMapping, SceneError, UsesMaterial, called,
};
use crate::shapes::{AnyShape, Bounds};
use bevy_ecs::prelude::*;
use glam::DVec3;
use std::collections::HashSet;
use std::sync::Arc;

/// What a medium does with light on a way of one scene unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Coefficients {
    /// How much it takes away, by absorbing or by scattering: red, green, blue.
    pub extinction: [f64; 3],
    /// How much it scatters.
    pub scattering: [f64; 3],
    /// How much it emits.
    pub emission: [f64; 3],
}

/// What a medium fills.
#[derive(Clone, Debug, PartialEq)]
pub enum MediumPlace {
    /// All of space but glass.
    Everywhere,
    /// The glass of this row of the table of glass, where it is present.
    Glass(u32),
    /// A shape without a surface.
    Body {
        /// The shape at the moment when the shutter opens, in render space.
        shape: Box<AnyShape>,
        /// Its velocity while the shutter is open, in scene units per unit of time.
        velocity: DVec3,
        /// A box around it at that moment; all of space for an infinite shape.
        bounds: Bounds,
    },
}

/// A place that a medium fills.
#[derive(Clone, Debug, PartialEq)]
pub struct Filled {
    /// The medium's row.
    pub medium: usize,
    /// The place.
    pub place: MediumPlace,
    /// By what the medium's coefficients are multiplied there; where nothing stands, by 1.
    pub density: Option<PlacedGrid>,
}

/// The participating media, and every place that one fills.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MediumTable {
    /// The coefficients of each medium, in spawn order.
    pub medium: Vec<Coefficients>,
    /// The places that media fill.
    pub place: Vec<Filled>,
    /// The shape number of a scattering event in the first medium, after those of all shapes.
    pub first_shape: u32,
    /// The row of the first medium's phase function in the table of materials.
    pub first_material: u32,
    /// The bodies of glass, and what they are made of: where a point is in glass decides which media are there.
    pub glass: Option<(Arc<GlassBodyTable>, Arc<GlassTable>)>,
}

impl MediumTable {
    /// Whether the density of any medium varies.
    pub fn varies(&self) -> bool {
        self.place.iter().any(|own| own.density.is_some())
    }
}

impl Table for MediumTable {
    const NAME: &'static str = "media";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        check_density_grids(scene)?;
        let media = media_entities(scene);
        let mut table = Self {
            first_shape: shape_entities(scene).len() as u32,
            first_material: material_entities(scene).len() as u32,
            ..Self::default()
        };
        if media.is_empty() {
            return Ok(table);
        }
        let mut everywhere = None;
        for (row, &entity) in media.iter().enumerate() {
            let own = scene.get::<Medium>(entity).copied().unwrap_or_default();
            let who = kind_and_name(scene, "medium", entity);
            PhaseTable::parameters(&own, &who)?;
            let [absorption, scattering] = [own.absorption, own.scattering].each(|colour| colour.to_array());
            let extinction = [0, 1, 2].each(|part| absorption[part] + scattering[part]);
            table.medium.push(Coefficients { extinction, scattering, emission: own.emission.to_array() });
            let shapes = shapes_of(scene, entity);
            let grid = grid_beside(scene, &who, entity)?;
            let density_in = |shape| grid.as_ref().map(|grid| placed(scene, &who, grid, shape)).transpose();
            let mut fill = |place, density| table.place.push(Filled { medium: row, place, density });
            if is_material(scene, entity) {
                fill(MediumPlace::Glass(glass_row(scene, entity, &who)?), density_in(None)?);
            } else if shapes.is_empty() {
                if let Some(other) = everywhere.replace(entity) {
                    let value = format!("without a shape, as that of {} is", called(scene, other));
                    let accepted = "one medium of a scene may fill all of space: put the other on a closed shape";
                    return Err(SceneError::new(who, "place", value, accepted));
                }
                let density = density_in(None)?;
                if density.is_none() {
                    check_finite(&own, &who, "all of space")?;
                }
                fill(MediumPlace::Everywhere, density);
            }
            for shape in shapes.into_iter().filter(|_| !is_material(scene, entity)) {
                let (body, density) = (body(scene, shape)?, density_in(Some(shape))?);
                let is_endless = matches!(&body, MediumPlace::Body { bounds, .. } if *bounds == Bounds::ALL);
                if is_endless && density.is_none() {
                    check_finite(&own, &who, "a shape without bounds")?;
                }
                fill(body, density);
            }
        }
        check_followed(scene, media[0])?;
        if glass_evidence(scene).needed {
            table.glass = Some((scene.table()?, scene.table()?));
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        // All that a medium fills shares its grid, as do media that name the same file.
        let mut grids: Vec<_> = self.place.iter().filter_map(|own| Some(&own.density.as_ref()?.grid)).collect();
        grids.sort_by_key(|grid| Arc::as_ptr(grid));
        grids.dedup_by(|one, other| Arc::ptr_eq(one, other));
        let grids = grids.into_iter().map(|grid| grid.bytes());
        let places = size_of_val(&self.place[..]) + self.place.len() * size_of::<AnyShape>();
        size_of_val(&self.medium[..]) + places + grids.sum::<usize>()
    }
}

/// Checks that every density grid stands beside a medium.
fn check_density_grids(scene: &Census<'_>) -> Result<(), SceneError> {
    let grids = scene.entities::<With<DensityGrid>>();
    let Some(&grid) = grids.iter().find(|&&grid| scene.get::<Medium>(grid).is_none()) else { return Ok(()) };
    let accepted = "it multiplies the coefficients of a medium, so it stands beside one";
    Err(SceneError::new(kind_and_name(scene, "density grid", grid), "medium", "missing", accepted))
}

/// The shapes that carry a medium or use the entity that does, in spawn order.
fn shapes_of(scene: &Census<'_>, medium: Entity) -> Vec<Entity> {
    all_shapes(scene).iter().copied().filter(|&shape| medium_of(scene, shape) == Some(medium)).collect()
}

/// All enabled shapes, those without a surface among them, in spawn order.
fn all_shapes(scene: &Census<'_>) -> Arc<[Entity]> {
    scene.once(|scene| united(&mut listed_kinds(scene).map(|listed| (listed.entities)(scene))).into())
}

/// The enabled entity that holds the medium of a shape: itself, or the one that it uses.
fn medium_of(scene: &Census<'_>, shape: Entity) -> Option<Entity> {
    let used = scene.get::<UsesMaterial>(shape).map(|used| used.0);
    let holds = |entity: &Entity| scene.get::<Medium>(*entity).is_some() && scene.get::<Disabled>(*entity).is_none();
    [Some(shape), used].into_iter().flatten().find(holds)
}

/// The shapes that have no surface: those filled by a medium that have neither a material nor an emission.
pub(super) fn bodies_without_surface(scene: &Census<'_>) -> Arc<HashSet<Entity>> {
    scene.once(|scene| {
        if media_entities(scene).is_empty() {
            return Arc::default();
        }
        let emits = |shape: Entity| {
            let used = scene.get::<UsesMaterial>(shape).map(|used| used.0);
            [Some(shape), used].into_iter().flatten().any(|entity| scene.get::<Emissive>(entity).is_some())
        };
        let is_body = |shape: &Entity| {
            medium_of(scene, *shape).is_some() && used_material(scene, *shape).is_none() && !emits(*shape)
        };
        Arc::new(all_shapes(scene).iter().copied().filter(is_body).collect())
    })
}

/// The row of the glass that an entity with a medium is.
///
/// Errors: a material that is not filled by anything.
fn glass_row(scene: &Census<'_>, entity: Entity, who: &str) -> Result<u32, SceneError> {
    if interior_of(scene, entity)?.is_none() {
        let value = format!("beside a {}", one_material(scene, entity)?.component);
        let accepted = "a medium fills glass, beside a Glass or a RoughGlass, or a closed shape without a material";
        return Err(SceneError::new(who, "place", value, accepted));
    }
    let before = material_entities(scene).iter().copied().take_while(|&other| other != entity).collect::<Vec<_>>();
    Ok(before.into_iter().filter(|&other| matches!(interior_of(scene, other), Ok(Some(_)))).count() as u32)
}

/// A shape that a medium fills.
///
/// Errors: a shape that has a surface, or no inside of its own.
fn body(scene: &Census<'_>, shape: Entity) -> Result<MediumPlace, SceneError> {
    let listed = one_shape(scene, shape)?;
    let who = kind_and_name(scene, listed.word, shape);
    if let Some(material) = used_material(scene, shape) {
        let accepted = "put the medium on the entity that is the glass, so that it fills that";
        return Err(SceneError::new(
            who,
            "medium",
            format!("beside the material {}", called(scene, material)),
            accepted,
        ));
    }
    if !bodies_without_surface(scene).contains(&shape) {
        let accepted = "what a medium fills has no surface that could emit: give the medium an emission instead";
        return Err(SceneError::new(who, "medium", "beside an Emissive", accepted));
    }
    if listed.is_part || !(listed.has_inside)(scene, shape) {
        let accepted = format!("a medium needs a shape with an inside of its own: {}", bodies_in_words(scene));
        return Err(SceneError::new(who, "medium", "in an open shape", accepted));
    }
    let own = (listed.body)(scene, shape, eye(scene)?)?;
    let velocity = if moves_while_open(scene)(shape) { velocity_of(scene, shape) } else { DVec3::ZERO };
    let bounds = own.bounds().unwrap_or(Bounds::ALL);
    Ok(MediumPlace::Body { shape: Box::new(own), velocity, bounds })
}

/// Checks that what a medium without bounds emits remains finite.
fn check_finite(own: &Medium, who: &str, filled: &str) -> Result<(), SceneError> {
    let [absorption, scattering, emission] =
        [own.absorption, own.scattering, own.emission].each(|colour| colour.to_array());
    if (0..3).all(|part| emission[part] == 0.0 || absorption[part] + scattering[part] > 0.0) {
        return Ok(());
    }
    let accepted = format!("in {filled} each part that is not 0 needs an absorption or scattering that is not 0");
    Err(SceneError::new(who, "emission", triple(own.emission.to_vec()), accepted))
}

/// Checks that the scene is rendered by the method that follows light through media.
fn check_followed(scene: &Census<'_>, first: Entity) -> Result<(), SceneError> {
    let camera = camera_of(scene)?;
    let who = kind_and_name(scene, "camera", camera);
    let medium = called(scene, first);
    let chosen = integrator_of(scene).integrator;
    if !chosen.transport().samples_diffuse {
        let accepted = format!("light in the medium {medium} is followed by path tracing alone: give it Path()");
        return Err(SceneError::new(who, "integrator", chosen.in_words(), accepted));
    }
    if scene.get::<PhotonMapping>(camera).is_some() {
        let accepted = "no photon is gathered in a medium: use light_tracing or bidirectional_path_tracing";
        return Err(SceneError::new(who, "photon_mapping", format!("with the medium {medium}"), accepted));
    }
    if scene.get::<BidirectionalPathTracing>(camera).is_some()
        && scattering_evidence(scene).needed
        && many_area_lights_evidence(scene).needed
    {
        let value = format!("with the medium {medium} and so many lights");
        let accepted = "with more than 64 lights one is chosen by the side of a surface, which a scattering event does \
                        not have: use fewer, or light_tracing";
        return Err(SceneError::new(who, "bidirectional_path_tracing", value, accepted));
    }
    Ok(())
}

/// Evidence of a medium that passes a test.
fn medium_that(scene: &Census<'_>, noun: &str, such: impl Fn(&Medium) -> bool) -> Evidence {
    let such = |&entity: &Entity| scene.get::<Medium>(entity).is_some_and(&such);
    let of = |entities: Arc<[Entity]>| entities.iter().copied().filter(such).collect::<Vec<_>>();
    let declared = of(scene.declared::<With<Medium>>());
    Evidence::among_entities(scene, noun, |_| true, &of(media_entities(scene)), &declared)
}

/// Evidence of a participating medium.
pub fn medium_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| medium_that(scene, "medium", |_| true))
}

/// Evidence of a medium that scatters light.
pub fn scattering_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| medium_that(scene, "scattering medium", |own| own.scattering.to_array() != [0.0; 3]))
}

/// Evidence of a medium that emits light.
pub fn emitting_medium_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| medium_that(scene, "emitting medium", |own| own.emission.to_array() != [0.0; 3]))
}
