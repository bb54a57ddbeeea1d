//! Slabs: what they let through, and what they scatter once.

use super::*;

/// A slab of so much thickness about the origin, far wider than it is thick, seen along −z in front of a sky of radiance 1.
fn slab(medium: Medium, thickness: f64, samples: u32, max_depth: u32) -> World {
    let mut world = World::new();
    one_ray(&mut world, DVec3::Z * 50.0, -DVec3::Z, samples, max_depth);
    let wide = 2e4_f64.min(1e6 * thickness);
    world.spawn((Name::new("slab"), Cuboid { size: DVec3::new(wide, wide, thickness) }, medium));
    world
}

fn with_sky(mut world: World) -> World {
    world.spawn((Name::new("sky"), Background { colour: Rgb::grey(1.0) }));
    world
}

/// Of optical depths from 1e-8 to 1e8, with and without scattering; what is scattered ends at the depth limit.
#[test]
fn a_slab_transmits_by_its_optical_depth() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    for depth in [1e-8, 1e-3, 0.1, 1.0, 3.0, 10.0, 80.0, 1e8] {
        for thickness in [1e-3, 1.0, 20.0] {
            let parts = [depth, 0.5 * depth, 0.1 * depth];
            let coefficient = rgb(parts.map(|part| part / thickness));
            let absorbs = Medium { absorption: coefficient, scattering: Rgb::BLACK, ..Medium::default() };
            let measured = Measured::of(&with_sky(slab(absorbs, thickness, 1, 8)));
            worst = worst.max(measured.check(&format!("absorbing, depth {depth:e}"), transmittance(parts), 1e-6));
            tried += 1;
            if (0.1..=3.0).contains(&depth) {
                let scatters = Medium { absorption: Rgb::BLACK, scattering: coefficient, ..Medium::default() };
                let measured = Measured::of(&with_sky(slab(scatters, thickness, 4096, 1)));
                worst = worst.max(measured.check(&format!("scattering, depth {depth}"), transmittance(parts), 2e-3));
                tried += 1;
            }
        }
    }
    eprintln!("transmittance: {tried} slabs of depths from 1e-8 to 1e8, worst {worst:.1} standard errors");
}

/// Parallel light from either side, scattered once towards the camera:
/// L = σs p E ∫ e^(−σ s) e^(−σ s' / μ) ds over the slab, s' measured from the side that is lit.
#[test]
fn a_slab_scatters_once_as_the_integral_says() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    let (absorption, scattering) = ([0.1, 0.4, 0.0], [0.5, 0.2, 1.5]);
    for g in [-0.7, 0.0, 0.8] {
        for thickness in [0.2, 1.0, 6.0] {
            for to_light in [DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.8, 0.0, -0.6), DVec3::Z, -DVec3::Z] {
                let medium = Medium {
                    absorption: rgb(absorption),
                    scattering: rgb(scattering),
                    anisotropy: g,
                    ..Medium::default()
                };
                let mut world = slab(medium, thickness, 1024, 2);
                let irradiance = rgb([2.0, 1.0, 3.0]);
                let up = if to_light.x == 0.0 { DVec3::X } else { DVec3::Y };
                let look = LookAt { eye: to_light, target: DVec3::ZERO, up };
                world.spawn((DirectionalLight { irradiance, ..DirectionalLight::default() }, look));
                let (slant, is_behind) = (to_light.z.abs(), to_light.z < 0.0);
                // The camera looks along −z: light that comes from behind goes on forward.
                let scattered = phase(g, (-to_light).dot(DVec3::Z));
                let truth = [0, 1, 2].map(|part: usize| {
                    let extinction = absorption[part] + scattering[part];
                    let lit = integral(0.0, thickness, |s| {
                        let lit_depth = if is_behind { thickness - s } else { s };
                        (-extinction * (s + lit_depth / slant)).exp()
                    });
                    scattering[part] * scattered * irradiance.to_array()[part] * lit
                });
                let what = format!("g {g}, thickness {thickness}, light from {to_light}");
                worst = worst.max(Measured::of(&world).check(&what, truth, 3e-3));
                tried += 1;
            }
        }
    }
    eprintln!("single scattering: {tried} slabs × {} paths, worst {worst:.1} standard errors", 1024 * SIDE * SIDE);
}

/// A medium that emits: ε (1 − e^(−σ l)) / σ, and ε l where it takes nothing away.
#[test]
fn a_slab_emits_as_the_integral_says() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    for absorption in [0.0, 1e-9, 0.3, 40.0] {
        let emission = [1.0, 0.5, 2.0];
        let medium = Medium {
            absorption: Rgb::grey(absorption),
            scattering: Rgb::BLACK,
            emission: rgb(emission),
            ..Medium::default()
        };
        let length = 3.0;
        let of_one = if absorption > 0.0 { -(-absorption * length).exp_m1() / absorption } else { length };
        let measured = Measured::of(&slab(medium, length, 1, 4));
        worst = worst.max(measured.check(&format!("emission at {absorption}"), emission.map(|e| e * of_one), 1e-6));
        tried += 1;
    }
    // In equilibrium: what scatters as well as emits and absorbs is as bright as ε / σa where it is thick.
    let medium =
        Medium { absorption: Rgb::grey(1.0), scattering: Rgb::grey(1.0), emission: Rgb::grey(0.5), anisotropy: 0.3 };
    let world = with_sky_of(slab(medium, 30.0, 256, 4096), 0.5);
    worst = worst.max(Measured::of(&world).check("equilibrium", [0.5; 3], 1e-3));
    eprintln!("emission: {} slabs, worst {worst:.1} standard errors", tried + 1);
}

fn with_sky_of(mut world: World, radiance: f64) -> World {
    world.spawn((Name::new("sky"), Background { colour: Rgb::grey(radiance) }));
    world
}

/// Chandrasekhar's H function of isotropic scattering (Radiative Transfer, 1960, chapter V), by its integral equation
/// 1 / H(μ) = √(1 − ω) + ω/2 ∫ μ' H(μ') / (μ + μ') dμ'.
fn h_function(albedo: f64, cosine: f64) -> f64 {
    const PARTS: usize = 300;
    let node = |part: usize| (part as f64 + 0.5) / PARTS as f64;
    let next = |h: &[f64], cosine: f64| {
        let sum: f64 = h.iter().enumerate().map(|(part, h)| node(part) * h / (cosine + node(part))).sum();
        1.0 / ((1.0 - albedo).sqrt() + 0.5 * albedo * sum / PARTS as f64)
    };
    let mut h = vec![1.0; PARTS];
    for _ in 0..40 {
        // The mean of the last two, since the iteration swings about its limit.
        h = (0..PARTS).map(|part| 0.5 * (h[part] + next(&h, node(part)))).collect();
    }
    next(&h, cosine)
}

/// A half-space lit by a parallel beam reflects, after any number of scattering events,
/// L(μ) = ω E / 4π · μ₀ / (μ + μ₀) · H(μ) H(μ₀) (Chandrasekhar 1960).
#[test]
fn a_half_space_reflects_as_chandrasekhar_says() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    let albedo = [0.2, 0.8, 0.99];
    for (to_light, to_eye) in [(1.0, 1.0), (0.8, 0.6), (0.5, 0.96)] {
        for extinction in [[1.0; 3], [0.5, 1.0, 4.0]] {
            let tilted = |cosine: f64| DVec3::new((1.0_f64 - cosine * cosine).sqrt(), 0.0, cosine);
            let mut world = World::new();
            one_ray(&mut world, tilted(to_eye) * 4.0, -tilted(to_eye), 384, 4096);
            let scattering = rgb([0, 1, 2].map(|part: usize| albedo[part] * extinction[part]));
            let absorption = rgb([0, 1, 2].map(|part: usize| (1.0 - albedo[part]) * extinction[part]));
            world.spawn((Plane { normal: DVec3::Z }, Medium { absorption, scattering, ..Medium::default() }));
            let look = LookAt { eye: tilted(to_light), target: DVec3::ZERO, up: DVec3::Y };
            world.spawn((DirectionalLight { irradiance: Rgb::grey(3.0), ..DirectionalLight::default() }, look));
            let truth = albedo.map(|albedo| {
                let h = h_function(albedo, to_light) * h_function(albedo, to_eye);
                3.0 * albedo / (4.0 * std::f64::consts::PI) * to_light / (to_light + to_eye) * h
            });
            let what = format!("light {to_light}, eye {to_eye}, extinction {extinction:?}");
            worst = worst.max(Measured::of(&world).check(&what, truth, 1e-2));
            tried += 1;
        }
    }
    eprintln!("half-spaces: {tried} × {} paths, worst {worst:.1} standard errors", 384 * SIDE * SIDE);
}
