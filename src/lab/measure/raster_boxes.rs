//! Pictures of shapes whose boxes are rasterised, beside those by rays: cameras anywhere, also inside of a shape.

use super::draws::Draws;
use super::film_bits::FilmBits;
use super::specimen::Specimen;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::camera_entity;
use pinhole::plan::{Census, plan};
use pinhole::render::{Execution, Worlds, render};
use pinhole::scene::*;
use pinhole::shapes::Listed;
use pinhole::stages;

/// Where a camera is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Whereabouts {
    /// A few radii away.
    Around,
    /// As close to a shape's box as a millionth of its size.
    Close,
    /// Inside of the sphere around a shape.
    Within,
    /// So far that a shape is as small as a hundredth of a pixel, or some pixels wide.
    Afar,
    /// Beside a shape, whose box is partly behind the camera.
    SurfaceData,
}

/// All of them.
pub const WHEREABOUTS: [Whereabouts; 5] =
    [Whereabouts::Around, Whereabouts::Close, Whereabouts::Within, Whereabouts::Afar, Whereabouts::SurfaceData];

/// What came of one camera.
#[derive(Clone, Debug, PartialEq)]
pub struct BoxPicture {
    /// Whether it sees more than one colour.
    pub sees: bool,
    /// How the picture in boxes differs from that by rays; nothing where every bit is the same.
    pub difference: Option<String>,
}

/// Renders some shapes of a kind both ways, by a camera that is drawn at random; nothing where the scene is refused.
///
/// Tiles are of a random size, and so is the image; three in four cameras take samples about the centres of their pixels.
#[must_use]
pub fn box_picture<S: Listed>(seed: u64, index: u64) -> Option<BoxPicture> {
    let mut draws = Draws::new(seed, index);
    let mut world = scene::<S>(&mut draws, WHEREABOUTS[(index % 5) as usize])?;
    let tile_side = [8, 32, 61][(draws.unit() * 3.0) as usize];
    let execution = Execution { worlds: Worlds::One, tile_side, ..Execution::default() };
    let film = |world: &World| render(world, &stages::all(), &execution, &()).map(|done| FilmBits::of(&done.film));
    let by_rays = film(&world).ok()?;
    let camera = camera_entity(&world).ok()?;
    world.entity_mut(camera).insert(Rasterisation);
    let in_boxes = match film(&world) {
        Ok(film) => film.difference(&by_rays),
        Err(error) => Some(error.to_string()),
    };
    let runs = plan(&Census::of(&world), &stages::all())
        .is_ok_and(|plan| plan.rows.iter().any(|row| row.kept && row.stage == S::NAMES.rasterise));
    let difference = if runs { in_boxes } else { Some("no stage rasterises boxes".into()) };
    Some(BoxPicture { sees: by_rays.colours() > 1, difference })
}

/// A few shapes in the sun, and a camera.
fn scene<S: Listed>(draws: &mut Draws, whereabouts: Whereabouts) -> Option<World> {
    let mut world = World::new();
    let power = draws.between(-5.0, 5.0);
    let shapes: Vec<Specimen<S>> = (0..3)
        .filter_map(|_| {
            let away = draws.between(0.0, 3.0);
            Specimen::<S>::drawn(draws, [power, power + 0.3], away)
        })
        .collect();
    spawn_camera(&mut world, draws, whereabouts, shapes.first()?.sphere_around());
    let is_mirror = draws.unit() < 0.2;
    for (number, Specimen { component, placement, .. }) in shapes.into_iter().enumerate() {
        let mut shape = world.spawn((component, placement));
        match is_mirror && number > 0 {
            true => shape.insert(Mirror::default()),
            false => shape.insert(Matte { colour: Rgb::grey(0.3 + 0.3 * number as f64) }),
        };
    }
    let sun = LookAt { eye: draws.unit_vector(), target: DVec3::ZERO, up: draws.unit_vector() };
    world.spawn((DirectionalLight::default(), sun));
    world.spawn(Background { colour: Rgb::new(0.1, 0.2, 0.4) });
    Some(world)
}

fn spawn_camera(world: &mut World, draws: &mut Draws, whereabouts: Whereabouts, (centre, radius): (DVec3, f64)) {
    let towards = draws.unit_vector();
    let distance = match whereabouts {
        Whereabouts::Around => draws.between(1.5, 10.0),
        Whereabouts::Close => 1.0 + draws.power_of_ten(-6.0, -1.0),
        Whereabouts::Within => draws.unit(),
        Whereabouts::Afar => draws.power_of_ten(1.0, 4.0),
        Whereabouts::SurfaceData => draws.between(0.8, 2.0),
    };
    let eye = centre - towards * (radius * distance);
    let target = match whereabouts {
        // Across the direction to the shape, or a little less or more.
        Whereabouts::SurfaceData => {
            eye + radius * (draws.unit_vector_across(towards) + towards * draws.between(-0.5, 0.7))
        }
        _ => centre + draws.unit_vector() * (radius * draws.unit()),
    };
    let [width, height] = [(); 2].map(|()| draws.between(1.0, 70.0) as u32);
    let integrator = if draws.unit() < 0.5 { Integrator::RayCasting } else { Integrator::Whitted { max_depth: 3 } };
    let look = LookAt { eye, target, up: draws.unit_vector() };
    let mut camera = world.spawn((look, Resolution { width, height }, integrator));
    if draws.unit() < 0.75 {
        let fov = match whereabouts {
            // From so far a shape is 115° / distance wide.
            Whereabouts::Afar => (115.0 / distance * draws.power_of_ten(0.0, 4.0)).min(170.0),
            _ => draws.between(10.0, 170.0),
        };
        camera.insert(PerspectiveCamera { fov: Degrees(fov), ..PerspectiveCamera::default() });
    } else {
        camera.insert(OrthographicCamera { view_height: radius * draws.power_of_ten(-1.0, 2.0) });
    }
    if draws.unit() < 0.75 {
        let filters = [Filter::BOX, Filter::Gaussian { radius: 2.0, sigma: 0.5 }, Filter::default()];
        let filter = filters[(draws.unit() * 3.0) as usize];
        camera.insert(Sampling { samples: 1 + (draws.unit() * 3.0) as u32, filter, ..Sampling::default() });
        // Only some pixels of a tile take part in the later passes.
        if draws.unit() < 0.2 {
            camera.insert((Sampling { samples: 12, filter, ..Sampling::default() }, Adaptive { error: 0.1, pilot: 4 }));
        }
    }
}
