use bevy_ecs::world::EntityWorldMut;
use pinhole::scene::Integrator;

/// One of the renders that a key chooses.
pub struct Mode {
    /// The key.
    pub key: char,
    /// What the page calls it.
    pub name: &'static str,
    /// Changes the camera's components before a frame.
    pub prepare: fn(&mut EntityWorldMut<'_>),
}

/// All modes, in the order of their keys; the first is that of a scene just opened.
pub const MODES: &[Mode] = &[
    Mode { key: '1', name: "as the scene says", prepare: |_| () },
    Mode { key: '2', name: "direct light", prepare: |camera| integrate(camera, Integrator::RayCasting) },
    Mode { key: '3', name: "path traced", prepare: |camera| integrate(camera, Integrator::PATH) },
];

fn integrate(camera: &mut EntityWorldMut<'_>, integrator: Integrator) {
    camera.insert(integrator);
}
