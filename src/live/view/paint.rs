use super::sheet::columns;
use bevy_ecs::prelude::World;
use pinhole::extract::camera_entity;
use pinhole::plan::{Census, Plan, Stage, plan, view_names};
use pinhole::render::prepare;
use pinhole::scene::View;

/// Puts the view of a column on the scene's camera, or takes it away, and says which columns could be viewed, and by which
/// plan the picture is made.
///
/// Errors: the scene cannot be rendered so.
pub fn paint(world: &mut World, offer: &[Stage], column: Option<&str>) -> pinhole::Result<(Vec<&'static str>, Plan)> {
    let camera = camera_entity(world)?;
    world.entity_mut(camera).remove::<View>();
    // The first chapters have columns and no picture.
    let columns = plan(&Census::of(world), offer).map_or_else(|_| view_names(offer), |plan| columns(&plan));
    if let Some(column) = column {
        world.entity_mut(camera).insert(View { column: column.into() });
    }
    let (plan, _) = prepare(&Census::of(world), offer)?;
    Ok((columns, plan))
}
