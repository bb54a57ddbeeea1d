//! Media whose density varies: held against quadrature, against media that do not vary, and against equilibrium.

use super::*;
use pinhole_lab::figure::cloud::cloud;
use pinhole_lab::measure::draws::Draws;

/// A medium that absorbs and scatters in each colour by an amount of its own.
fn coloured(anisotropy: f64) -> Medium {
    let (absorption, scattering) = (Rgb::new(0.1, 0.4, 0.0), Rgb::new(0.5, 0.2, 1.5));
    Medium { absorption, scattering, anisotropy, ..Medium::default() }
}

/// A density along z that rises, falls to nothing, and rises again: its values, and the same as a function of z in
/// −1 … 1, between the centres of voxels and beyond.
const ALONG_Z: [f32; 8] = [0.5, 2.0, 1.0, 0.0, 0.0, 0.25, 4.0, 1.0];

fn along_z(z: f64) -> f64 {
    let place = ((z + 1.0) * 0.5 * ALONG_Z.len() as f64 - 0.5).clamp(0.0, ALONG_Z.len() as f64 - 1.0);
    let below = (place as usize).min(ALONG_Z.len() - 2);
    let (one, other) = (f64::from(ALONG_Z[below]), f64::from(ALONG_Z[below + 1]));
    one + (other - one) * (place - below as f64)
}

fn grid_along_z(scale: f32) -> DensityGrid {
    DensityGrid { size: [1, 1, 8], values: ALONG_Z.map(|value| value * scale).to_vec(), ..DensityGrid::default() }
}

/// A wide cuboid about the origin, from −1 to 1 along its own z, placed anywhere.
fn layer(world: &mut World, medium: Medium, grid: DensityGrid, placement: Placement) -> Entity {
    let grid = DensityGrid { min: DVec3::new(-1e3, -1e3, -1.0), max: DVec3::new(1e3, 1e3, 1.0), ..grid };
    let shape = Cuboid { size: DVec3::new(2e3, 2e3, 2.0) };
    world.spawn((Name::new("layer"), shape, medium, grid, placement)).id()
}

fn sky(world: &mut World, radiance: f64) {
    world.spawn((Name::new("sky"), Background { colour: Rgb::grey(radiance) }));
}

/// Turned by 50° about x, so that a ray along −z is as long in it as 1 / cos 50°.
fn tilted() -> (Placement, f64) {
    let placement = Placement { orientation: axis_angle(DVec3::X, Degrees(50.0)), ..Placement::at(3.0, -2.0, 1.0) };
    (placement, 1.0 / 50.0_f64.to_radians().cos())
}

/// From next to nothing to opaque; where nothing scatters, where everything does, and both; by null collisions and by
/// exact distances.
#[test]
fn a_layer_transmits_by_the_integral_of_its_density() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    let (tilt, slant) = tilted();
    for scale in [1e-8, 0.01, 0.3, 1.0, 3.0] {
        for (placement, length) in [(Placement::default(), 1.0), (tilt, slant)] {
            for scattered in [0.0, 0.4, 1.0] {
                let extinction = [1.0, 0.5, 0.1];
                let part_of = |share: f64| rgb(extinction.map(|part| part * share));
                let medium = Medium {
                    absorption: part_of(1.0 - scattered),
                    scattering: part_of(scattered),
                    ..Medium::default()
                };
                let mut world = World::new();
                one_ray(&mut world, DVec3::new(3.0, -2.0, 40.0), -DVec3::Z, 512, 1);
                layer(&mut world, medium, grid_along_z(scale as f32), placement);
                sky(&mut world, 1.0);
                let depth = scale * length * integral(-1.0, 1.0, along_z);
                let known = if scattered == 0.0 { 1e-6 } else { 6e-2 };
                let what = format!("scale {scale}, length {length}, scattered {scattered}");
                let truth = transmittance(extinction.map(|part| part * depth));
                worst = worst.max(Measured::of(&world).check(&what, truth, known));
                tried += 1;
            }
        }
    }
    eprintln!("density: {tried} layers transmit as the integral says, worst {worst:.1} standard errors");
}

/// Sun scattered once in a layer, seen along its normal: L = σs p E ∫ ρ(z) e^(−σ (τ(z to the eye) + τ(z to the sun) / μ)) dz.
#[test]
fn a_layer_scatters_once_as_the_integral_says() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    for (g, scale) in [(0.0, 0.2), (0.6, 1.0), (-0.5, 3.0)] {
        for to_light in [DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.8, 0.0, -0.6)] {
            let mut world = World::new();
            one_ray(&mut world, DVec3::Z * 40.0, -DVec3::Z, 512, 2);
            let medium = coloured(g);
            layer(&mut world, medium, grid_along_z(scale as f32), Placement::default());
            let look = LookAt { eye: to_light, target: DVec3::ZERO, up: DVec3::Y };
            world.spawn((DirectionalLight { irradiance: Rgb::grey(2.0), ..DirectionalLight::default() }, look));
            // The optical depth of a unit of extinction from z up to the side of the eye, at 801 places.
            let steps = 800;
            let z_of = |step: usize| -1.0 + 2.0 * step as f64 / f64::from(steps);
            let mut above = vec![0.0; steps as usize + 1];
            for step in (0..steps as usize).rev() {
                let part = |at: f64| along_z(z_of(step) + at * (z_of(step + 1) - z_of(step)));
                let simpson = (part(0.0) + 4.0 * part(0.5) + part(1.0)) / 6.0;
                above[step] = above[step + 1] + scale * simpson * 2.0 / f64::from(steps);
            }
            let all = above[0];
            let depth_above = |z: f64| {
                let place = (z + 1.0) * 0.5 * f64::from(steps);
                let below = (place as usize).min(steps as usize - 1);
                let at = place - below as f64;
                above[below] + (above[below + 1] - above[below]) * at
            };
            let (slant, is_behind) = (to_light.z.abs(), to_light.z < 0.0);
            let truth = [0, 1, 2].map(|part: usize| {
                let scattering = medium.scattering.to_array()[part];
                let extinction = scattering + medium.absorption.to_array()[part];
                let lit = integral(-1.0, 1.0, |z| {
                    let to_eye = depth_above(z);
                    let to_sun = if is_behind { all - to_eye } else { to_eye };
                    scale * along_z(z) * (-extinction * (to_eye + to_sun / slant)).exp()
                });
                scattering * phase(g, (-to_light).dot(DVec3::Z)) * 2.0 * lit
            });
            let what = format!("g {g}, scale {scale}, light from {to_light}");
            worst = worst.max(Measured::of(&world).check(&what, truth, 3e-2));
            tried += 1;
        }
    }
    eprintln!("density: {tried} layers scatter once as the integral says, worst {worst:.1} standard errors");
}

/// What emits as well: L = ε ∫ ρ e^(−σ τ) dz, beside a medium that does not vary and over it.
#[test]
fn a_layer_emits_as_the_integral_says() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    for scale in [0.1, 1.0, 20.0] {
        for with_fog in [false, true] {
            let mut world = World::new();
            one_ray(&mut world, DVec3::Z * 40.0, -DVec3::Z, 64, 4);
            let (absorption, emission) = (Rgb::new(0.7, 0.1, 0.0), Rgb::new(1.0, 0.5, 2.0));
            let medium = Medium { absorption, scattering: Rgb::BLACK, emission, ..Medium::default() };
            layer(&mut world, medium, grid_along_z(scale as f32), Placement::default());
            let fog = Medium { absorption: Rgb::grey(0.3), scattering: Rgb::BLACK, emission: Rgb::grey(0.2), ..medium };
            if with_fog {
                world.spawn((Name::new("fog"), Cuboid { size: DVec3::new(2e3, 2e3, 2.0) }, fog));
            }
            let count = 20_000;
            let step = 2.0 / f64::from(count);
            let truth = [0, 1, 2].map(|part: usize| {
                let (mut sum, mut depth) = (0.0, 0.0_f64);
                for place in 0..count {
                    let density = scale * along_z(1.0 - (f64::from(place) + 0.5) * step);
                    let of = |own: Rgb, fog: Rgb| {
                        density * own.to_array()[part] + if with_fog { fog.to_array()[part] } else { 0.0 }
                    };
                    let (emitted, taken) = (of(emission, fog.emission), of(absorption, fog.absorption));
                    sum += (-(depth + 0.5 * taken * step)).exp() * emitted * step;
                    depth += taken * step;
                }
                sum
            });
            let what = format!("scale {scale}, with fog {with_fog}");
            worst = worst.max(Measured::of(&world).check(&what, truth, 2e-2));
            tried += 1;
        }
    }
    eprintln!("density: {tried} layers emit as the integral says, worst {worst:.1} standard errors");
}

/// A grid of noise: a third of it is empty, and a few voxels have the density `peak`.
fn noise(size: [u32; 3], seed: u64, peak: f32) -> DensityGrid {
    let mut draws = Draws::new(seed, 0);
    let mut value = || match draws.unit() {
        few if few < 0.33 => 0.0,
        few if few < 0.36 => peak,
        other => other as f32,
    };
    let values = (0..size.iter().product::<u32>()).map(|_| value()).collect();
    DensityGrid { size, values, ..DensityGrid::default() }
}

/// What a grid fills, or where it is.
const PLACES: [&str; 11] =
    ["sphere", "cuboid", "two", "moving", "glass", "space", "cylinder", "cone", "torus", "mesh", "half-space"];

/// In equilibrium, where everything that absorbs emits as it would within walls of one temperature, nothing is seen: every
/// ray brings the radiance of the sky, whatever the densities, whatever fills them, moving or not.
#[test]
fn nothing_is_seen_in_equilibrium() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    let medium = |albedo: [f64; 3], extinction: [f64; 3], anisotropy: f64| {
        let scattering = rgb([0, 1, 2].map(|part| albedo[part] * extinction[part]));
        let absorption = rgb([0, 1, 2].map(|part| (1.0 - albedo[part]) * extinction[part]));
        Medium { absorption, scattering, emission: absorption, anisotropy }
    };
    let media = [
        medium([0.8, 0.2, 0.5], [2.0, 1.0, 4.0], 0.5),
        medium([1.0; 3], [3.0; 3], 0.0),
        medium([0.0; 3], [1.0, 0.3, 5.0], 0.0),
        medium([0.9, 0.0, 0.5], [0.5, 8.0, 0.0], -0.4),
    ];
    for (number, own) in (0_u64..).zip(media) {
        // Where nothing is scattered, no path ends for want of depth or of precision.
        for peak in [1.0, if own.scattering == Rgb::BLACK { 1e8 } else { 30.0 }] {
            for (at, place) in PLACES.into_iter().enumerate() {
                // One medium in all shapes, and all media in some.
                if number > 0 && at >= 6 {
                    continue;
                }
                // Where media overlap, emission is sampled, and what few voxels emit within their first 1e-8 seldom.
                if place == "two" && peak > 1e3 {
                    continue;
                }
                let mut world = World::new();
                let camera = one_ray(&mut world, DVec3::new(0.2, 0.1, 5.0), -DVec3::Z, 32, 4096);
                if number == 3 {
                    // A colour that is only absorbed, and the others decide where paths end: one in some thousands reaches
                    // the sky and counts threefold. Of a few such the spread does not tell the error.
                    world.entity_mut(camera).insert(Resolution { width: 4 * SIDE, height: 4 * SIDE });
                }
                sky(&mut world, 1.0);
                let grid = noise([9, 17, 33], number, peak);
                let turned = Placement {
                    orientation: axis_angle(DVec3::new(1.0, 2.0, 3.0), Degrees(40.0)),
                    ..Placement::default()
                };
                match place {
                    "sphere" => drop(world.spawn((Sphere { radius: 1.0 }, own, grid, turned))),
                    "cuboid" => drop(world.spawn((Cuboid::default(), own, grid, turned))),
                    "two" => {
                        world.spawn((Cuboid::default(), own, grid, turned));
                        world.spawn((
                            Sphere { radius: 1.2 },
                            medium([0.5; 3], [1.0; 3], 0.2),
                            noise([4, 4, 4], 5, 3.0),
                        ));
                        world.spawn((Sphere { radius: 0.7 }, medium([0.3; 3], [0.4; 3], 0.0)));
                    }
                    "moving" => {
                        world.entity_mut(camera).insert(Shutter { open: 0.0, close: 1.0 });
                        let motion = Motion { velocity: DVec3::new(0.5, 0.0, 1.0) };
                        world.spawn((Cuboid::default(), own, grid, turned, motion));
                    }
                    "glass" => {
                        let glass = Glass { ior: 1.5, ..Glass::default() };
                        // Within glass of index n radiance in equilibrium is n² of what it is outside.
                        let emission = rgb(own.emission.to_array().map(|part| part * 1.5 * 1.5));
                        world.spawn((Sphere { radius: 0.9 }, glass, Medium { emission, ..own }, grid));
                    }
                    "cylinder" => drop(world.spawn((Cylinder::default(), own, grid, turned))),
                    "cone" => drop(world.spawn((Cone::default(), own, grid, turned))),
                    "torus" => drop(world.spawn((Torus::default(), own, grid, turned))),
                    "mesh" => drop(world.spawn((MeshInstance::default(), own, grid, turned))),
                    "half-space" => drop(world.spawn((Plane { normal: DVec3::Y }, own, grid, turned))),
                    _ => drop(world.entity_mut(camera).insert((own, grid))),
                }
                let measured = Measured::of(&world);
                let what = format!("medium {number}, peak {peak}, {place}");
                worst = worst.max(measured.check(&what, [1.0; 3], 0.1));
                tried += 1;
            }
        }
    }
    eprintln!("density: {tried} times nothing seen in equilibrium, worst {worst:.1} standard errors");
}

/// A grid of ones is no grid, for every way that light is sampled.
#[test]
fn a_density_of_one_everywhere_changes_nothing() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    for lights in [LightStrategy::Light, LightStrategy::Bsdf, LightStrategy::Mis] {
        let mean_of = |grid: Option<DensityGrid>| {
            let mut world = World::new();
            let camera = one_ray(&mut world, DVec3::Z * 5.0, -DVec3::Z, 256, 6);
            world.entity_mut(camera).insert(Integrator::Path { max_depth: 6, lights, roulette: 5 });
            sky(&mut world, 0.5);
            let lamp = (Sphere { radius: 0.4 }, Emissive { radiance: Rgb::grey(8.0), ..Emissive::default() });
            world.spawn((lamp, Placement::at(1.5, 1.5, 1.0)));
            let ball = world.spawn((Name::new("ball"), Sphere { radius: 0.9 }, coloured(0.3))).id();
            if let Some(grid) = grid {
                world.entity_mut(ball).insert(grid);
            }
            Measured::of(&world)
        };
        let (without, with) = (mean_of(None), mean_of(Some(DensityGrid::of([5, 6, 7], |_| 1.0))));
        for part in 0..3 {
            let error = without.error[part].hypot(with.error[part]);
            let off = (with.mean[part] - without.mean[part]) / error;
            assert!(off.abs() < 4.0 && error < 0.02 * without.mean[part], "{lights:?}: {with:?} for {without:?}");
            worst = worst.max(off.abs());
            tried += 1;
        }
    }
    eprintln!("density: {tried} means with a density of 1 and without, worst {worst:.1} standard errors");
}

/// The file beside the scene holds what this program says; `PINHOLE_WRITE_CLOUD=1` writes it.
#[test]
fn the_cloud_is_the_one_of_its_program() {
    let DensityGrid { size, values, .. } = cloud();
    let mut bytes = b"VOL\x03".to_vec();
    [1, size[0], size[1], size[2], 1].iter().for_each(|word| bytes.extend(word.to_le_bytes()));
    let numbers = [-2.2, -1.2, -1.5, 2.2, 1.2, 1.5].into_iter().chain(values);
    numbers.for_each(|number: f32| bytes.extend(number.to_le_bytes()));
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/media/cloud.vol");
    if std::env::var_os("PINHOLE_WRITE_CLOUD").is_some() {
        std::fs::write(file, &bytes).expect("written");
    }
    assert!(std::fs::read(file).expect("read") == bytes, "tests/media/cloud.vol is another cloud");
}
