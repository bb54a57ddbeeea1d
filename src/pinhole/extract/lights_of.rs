//! Which entities are a light without an area, and what extraction asks of each kind.

use super::area_lights::{EVEN, LightChoice, hierarchy_of_lights, light_distribution};
use super::check::kind_and_name;
use super::pose::ahead;
use super::{eye, world_from_entity};
use crate::lights::{
    AnyLight, LightVisitor, ListedLight, PlacedDirectionalLight, PlacedLight, PlacedPointLight, PlacedSpotLight,
    SceneLight, luminance, visit_lights,
};
use crate::plan::{Added, Census, ComponentKind, Evidence, Table, TableKind, add_kind, check_is_added, with_added};
use crate::scene::SceneError;
use bevy_ecs::prelude::*;
use std::sync::{Arc, OnceLock};

/// The most lights of a kind to all of which each surface sends a shadow ray, which gives their light without noise.
///
/// A tile of 1024 surfaces then has 65,536 shadow rays of a kind at most, which take 5 MB.
const MAX_SUMMED: usize = 64;

/// Lights of one kind in render space, in spawn order.
#[derive(Clone, Debug, PartialEq)]
pub struct LightsOf<L: ListedLight> {
    /// The lights, as the sampling kernel reads them.
    pub row: Vec<L>,
    /// Whether shapes block the light of each.
    pub casts_shadows: Vec<bool>,
    /// How one of them is chosen for a surface where there are many; none where each surface gets a ray from all.
    pub choice: Option<LightChoice>,
}

/// The table of point lights.
pub type PointLightTable = LightsOf<PlacedPointLight>;
/// The table of directional lights.
pub type DirectionalLightTable = LightsOf<PlacedDirectionalLight>;
/// The table of spot lights.
pub type SpotLightTable = LightsOf<PlacedSpotLight>;

impl<L: ListedLight> Default for LightsOf<L> {
    fn default() -> Self {
        Self { row: Vec::new(), casts_shadows: Vec::new(), choice: None }
    }
}

impl<L: ListedLight> Table for LightsOf<L> {
    const NAME: &'static str = L::NAMES.table;

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        if L::IS_CUSTOM {
            check_is_added::<Self>(scene, L::Component::WORD, "add_light")?;
        }
        let eye = eye(scene)?;
        let mut table = Self::default();
        for &entity in scene.entities::<With<L::Component>>().iter() {
            let light = scene.get::<L::Component>(entity).copied().unwrap_or_default();
            let who = &kind_and_name(scene, L::Component::WORD, entity);
            let position = world_from_entity(scene, who, entity)?.translation - eye;
            let placed = PlacedLight { who, position, ahead: &|| ahead(scene, who, entity) };
            table.row.push(L::place(&light, &placed)?);
            table.casts_shadows.push(light.casts_shadows());
        }
        if table.row.len() > MAX_SUMMED {
            let powers = || table.row.iter().map(|light| luminance(light.power(1.0))).collect::<Vec<f64>>();
            table.choice = Some(if L::IS_DISTANT {
                let (until, probability) = light_distribution(&powers(), EVEN);
                LightChoice::Power { until, probability }
            } else {
                let bounds_of = |light: usize| table.row[light].bounds();
                LightChoice::Hierarchy(hierarchy_of_lights(L::NAMES.table, table.row.len(), bounds_of)?)
            });
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        let chosen = self.choice.as_ref().map_or(0, LightChoice::bytes);
        self.row.len() * (size_of::<L>() + size_of::<bool>()) + chosen
    }
}

/// A registered light as extraction handles it, without its type.
#[derive(Clone, Copy)]
pub struct LightKind {
    /// Its component.
    pub component: ComponentKind,
    /// Its component in messages.
    pub word: &'static str,
    /// Whether it has no position.
    pub is_distant: bool,
    /// Whether an entity carries one that casts shadows.
    pub casts_shadows: fn(EntityRef<'_>) -> bool,
    /// The entities that carry one, in spawn order.
    pub(super) entities: fn(&Census<'_>) -> Arc<[Entity]>,
    /// Extracts its table, which checks its components.
    pub(super) check: fn(&Census<'_>) -> Result<(), SceneError>,
    /// Whether one of many is chosen for each surface.
    is_chosen: fn(&Census<'_>) -> bool,
    /// Whether one of its lights is not black.
    shines: fn(&Census<'_>) -> Result<bool, SceneError>,
    /// Those of its lights that cast shadows.
    pub(super) sources: fn(&Census<'_>) -> Result<Vec<AnyLight>, SceneError>,
}

impl LightKind {
    fn of<L: ListedLight>() -> Self {
        Self {
            component: ComponentKind::of::<L::Component>(),
            word: L::Component::WORD,
            is_distant: L::IS_DISTANT,
            casts_shadows: |entity| entity.get::<L::Component>().is_some_and(SceneLight::casts_shadows),
            entities: |scene| scene.entities::<With<L::Component>>(),
            check: |scene| scene.table::<LightsOf<L>>().map(drop),
            is_chosen: |scene| many_lights_evidence::<L>(scene).needed,
            shines: |scene| {
                let lights = scene.table::<LightsOf<L>>()?;
                Ok(lights.row.iter().any(|light| luminance(light.power(1.0)) > 0.0))
            },
            sources: |scene| {
                let lights = scene.table::<LightsOf<L>>()?;
                let shadowed =
                    lights.row.iter().zip(&lights.casts_shadows).filter(|(_, casts_shadows)| **casts_shadows);
                Ok(shadowed.map(|(light, _)| light.clone().into_any()).collect())
            },
        }
    }
}

impl LightKind {
    /// Whether there are so many lights of this kind that one of them is chosen for each surface.
    pub(super) fn is_chosen_of_many(&self, scene: &Census<'_>) -> bool {
        (self.is_chosen)(scene)
    }
}

/// All registered lights without an area: those of the library, and then those that the scene adds.
pub fn light_kinds<'s>(scene: &'s Census<'_>) -> impl Iterator<Item = &'s LightKind> + Clone {
    with_added(library_kinds(), scene)
}

/// Adds a light of one's own to those that a scene may have, before it is planned.
pub fn add_light<L: ListedLight>(scene: &mut World) {
    let (table, entities) =
        (TableKind::of::<LightsOf<L>>(), |scene: &Census<'_>| scene.entities::<With<L::Component>>());
    let added = Added { table, word: L::Component::WORD, entities, stages: "of_light" };
    add_kind::<L, _>(scene, LightKind::of::<L>(), added);
}

/// The lights of the library, in the order of its list.
fn library_kinds() -> &'static [LightKind] {
    struct Collected(Vec<LightKind>);
    impl LightVisitor for Collected {
        fn visit<L: ListedLight>(&mut self) {
            self.0.push(LightKind::of::<L>());
        }
    }
    static KINDS: OnceLock<Vec<LightKind>> = OnceLock::new();
    KINDS.get_or_init(|| {
        let mut collected = Collected(Vec::new());
        visit_lights(&mut collected);
        collected.0
    })
}

/// Evidence of lights of one kind, and whether one of many is chosen for each surface.
pub fn lights_evidence<L: ListedLight>(scene: &Census<'_>) -> Evidence {
    let found = Evidence::of::<L::Component>(scene, L::Component::WORD);
    if found.count <= MAX_SUMMED {
        return found;
    }
    let by = if L::IS_DISTANT { "power" } else { "a hierarchy" };
    Evidence { reason: format!("{}; one of {} chosen by {by}", found.reason, found.count), ..found }
}

/// Evidence that one of many lights of a kind is chosen for each surface.
pub fn many_lights_evidence<L: ListedLight>(scene: &Census<'_>) -> Evidence {
    let found = lights_evidence::<L>(scene);
    Evidence { needed: found.count > MAX_SUMMED, count: 0, ..found }
}

/// The greatest number of shadow rays from a surface to lights without an area.
pub fn delta_light_rays(scene: &Census<'_>) -> usize {
    let of_kind = |lights: usize| if lights > MAX_SUMMED { 1 } else { lights };
    light_kinds(scene).map(|kind| of_kind((kind.entities)(scene).len())).sum()
}

/// Whether a light without an area is not black.
///
/// Errors: a light that is not accepted.
pub fn delta_light_shines(scene: &Census<'_>) -> Result<bool, SceneError> {
    let present = |kind: &&LightKind| !(kind.entities)(scene).is_empty();
    light_kinds(scene).filter(present).try_fold(false, |shines, kind| Ok(shines || (kind.shines)(scene)?))
}

/// Evidence of a light without an area that passes a test.
pub fn delta_light_evidence(scene: &Census<'_>, noun: &str, in_use: impl Fn(EntityRef<'_>) -> bool) -> Evidence {
    let components: Vec<ComponentKind> = light_kinds(scene).map(|kind| kind.component).collect();
    Evidence::among_any(scene, noun, &components, in_use)
}

/// Evidence that there is a light without an area.
pub fn point_evidence(scene: &Census<'_>) -> Evidence {
    delta_light_evidence(scene, "light without an area", |_| true)
}

/// The evidence of lights that cast shadows, and have no position or have one.
pub(super) fn shadowed_evidence(scene: &Census<'_>, is_distant: bool) -> Evidence {
    let each = light_kinds(scene).filter(|kind| kind.is_distant == is_distant);
    each.map(|kind| Evidence::among_any(scene, kind.word, &[kind.component], kind.casts_shadows))
        .reduce(Evidence::or)
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{ChildOf, DirectionalLight, LookAt, PerspectiveCamera, Placement};
    use glam::{DQuat, DVec3};

    fn to_light(spawn: impl FnOnce(&mut World)) -> DVec3 {
        let mut world = World::new();
        world.spawn(PerspectiveCamera::default());
        spawn(&mut world);
        DirectionalLightTable::extract(&Census::of(&world)).expect("extracts").row[0].to_light
    }

    /// Rays travel along −z, so the light is towards +z; rotated, looked at, scaled, mirrored, under a parent, moved.
    #[test]
    fn the_light_is_against_the_entity_s_own_minus_z() {
        let light = DirectionalLight::default();
        let half = std::f64::consts::FRAC_1_SQRT_2;
        assert_eq!(to_light(|w| _ = w.spawn(light)), DVec3::Z);
        assert_eq!(to_light(|w| _ = w.spawn((light, Placement::at(5.0, -7.0, 1e9)))), DVec3::Z);
        let turned = Placement { orientation: DQuat::from_xyzw(0.0, half, 0.0, half), ..Placement::default() };
        assert!((to_light(|w| _ = w.spawn((light, turned))) - DVec3::X).length() < 1e-15);
        let look = LookAt { eye: DVec3::new(0.0, 3.0, 4.0), target: DVec3::ZERO, up: DVec3::Y };
        assert!((to_light(|w| _ = w.spawn((light, look))) - DVec3::new(0.0, 0.6, 0.8)).length() < 1e-15);
        let scaled = Placement { scale: DVec3::new(2.0, 3.0, 1e-12), ..Placement::default() };
        assert_eq!(to_light(|w| _ = w.spawn((light, scaled))), DVec3::Z);
        let mirrored = Placement { scale: DVec3::new(1.0, 1.0, -1.0), ..Placement::default() };
        assert_eq!(to_light(|w| _ = w.spawn((light, mirrored))), DVec3::NEG_Z, "its own −z is mirrored with it");
        let under = to_light(|world| {
            let parent = world.spawn(turned).id();
            world.spawn((light, ChildOf(parent)));
        });
        assert!((under - DVec3::X).length() < 1e-15);
    }
}
