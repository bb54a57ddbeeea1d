use bevy_ecs::world::EntityWorldMut;
use pinhole::film::GUIDES;
use pinhole::look::view_stage;
use pinhole::plan::Stage;
use pinhole::scene::{Filter, Integrator, Layers, LightStrategy, Rasterisation, Sampling};
use pinhole::stages;

/// One of the renders that a key chooses.
pub struct Mode {
    /// The key.
    pub key: char,
    /// What the page calls it.
    pub name: &'static str,
    /// Changes the camera's components before a frame.
    pub prepare: fn(&mut EntityWorldMut<'_>),
    /// Whether all stages are on offer, and not those of the scene's chapter.
    pub every_stage: bool,
    /// The levels of the denoiser that a frame of one sample is shown through.
    pub denoised: u32,
}

/// All modes, in the order of their keys; the first is that of a scene just opened.
pub const MODES: &[Mode] = &[
    Mode { every_stage: false, ..mode('1', "as the scene says", |_| ()) },
    mode('2', "direct light", |camera| _ = camera.insert(Integrator::RayCasting)),
    mode('3', "path traced", |camera| _ = camera.insert(Integrator::PATH)),
    mode('4', "projected, direct light", |camera| _ = camera.insert((Integrator::RayCasting, Rasterisation))),
    Mode { denoised: 3, ..mode('5', "hybrid: projected, then traced, denoised", hybrid) },
];

const fn mode(key: char, name: &'static str, prepare: fn(&mut EntityWorldMut<'_>)) -> Mode {
    Mode { key, name, prepare, every_stage: true, denoised: 0 }
}

/// What is seen is projected; shadow rays and one further ray a sample are traced from there.
///
/// Each sample is of its own pixel: a filter that reaches further would guide the denoiser by other pixels' surfaces.
fn hybrid(camera: &mut EntityWorldMut<'_>) {
    let path = Integrator::Path { max_depth: 3, lights: LightStrategy::Mis, roulette: 0 };
    let sampling = camera.get::<Sampling>().copied().unwrap_or(Sampling { samples: 64, ..Sampling::default() });
    let sampling = Sampling { filter: Filter::BOX, ..sampling };
    camera.insert((path, Rasterisation, sampling, Layers { kinds: GUIDES.to_vec() }));
}

/// All stages, and the one that paints a column.
pub fn every_stage() -> Vec<Stage> {
    let mut offer = stages::all();
    offer.push(view_stage(&offer));
    offer
}
