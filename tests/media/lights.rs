//! Lights in media, each registered kind of them: what is scattered once is what quadrature says, and what is scattered
//! more often does not depend on how lights are found.

use super::*;
use pinhole::lights::{LightVisitor, ListedLight, PlacedLight, visit_lights};
use pinhole::plan::Census;
use pinhole::shapes::{Listed, SceneShape, ShapeVisitor, visit_shapes};

/// Where the camera stands, and the ball of fog that it looks through along −z.
const EYE: DVec3 = DVec3::new(0.1, 0.3, 6.0);
const RADIUS: f64 = 2.0;

fn fog() -> Medium {
    let (absorption, scattering) = (Rgb::new(0.05, 0.2, 0.0), Rgb::new(0.3, 0.1, 0.8));
    Medium { absorption, scattering, anisotropy: 0.6, ..Medium::default() }
}

/// From where to where a ray is in the ball.
fn in_ball(origin: DVec3, direction: DVec3) -> [f64; 2] {
    let (along, apart) = (-origin.dot(direction), origin.length_squared());
    let half = (RADIUS * RADIUS - (apart - along * along)).max(0.0).sqrt();
    [along - half, along + half]
}

/// Every registered light without an area, with no line for it.
struct EachLight {
    lights: usize,
    worst: f64,
}

impl LightVisitor for EachLight {
    fn visit<L: ListedLight>(&mut self) {
        for position in [DVec3::new(0.3, 3.0, 1.0), DVec3::new(-0.6, 0.7, 0.2)] {
            let mut world = World::new();
            one_ray(&mut world, EYE, -DVec3::Z, 2048, 2);
            world.spawn((Name::new("fog"), Sphere { radius: RADIUS }, fog()));
            let look = LookAt { eye: position, target: DVec3::new(0.1, 0.3, -0.2), ..LookAt::default() };
            world.spawn((L::Component::default(), look));
            let ahead = (look.target - look.eye).normalize();
            let placed = PlacedLight { who: "a light", position: position - EYE, ahead: &|| Ok(ahead) };
            let light = L::place(&L::Component::default(), &placed).expect("placed");

            let Medium { absorption, scattering, anisotropy, .. } = fog();
            let [first, last] = in_ball(EYE, -DVec3::Z);
            let truth = [0, 1, 2].map(|part: usize| {
                let scattered = scattering.to_array()[part];
                let extinction = absorption.to_array()[part] + scattered;
                integral(first, last, |s| {
                    let sample = light.sample(-DVec3::Z * s);
                    let to_light = sample.direction.as_dvec3();
                    let [_, leaves] = in_ball(EYE - DVec3::Z * s, to_light);
                    let depth = extinction * (s - first + leaves.min(sample.distance));
                    let irradiance = L::irradiance(&sample, 1.0)[part];
                    scattered * phase(anisotropy, -to_light.z) * irradiance * (-depth).exp()
                })
            });
            let what = format!("{} at {position}", L::NAMES.table);
            self.worst = self.worst.max(Measured::of(&world).check(&what, truth, 4e-3));
            self.lights += 1;
        }
    }
}

#[test]
fn each_light_is_scattered_once_as_quadrature_says() {
    let mut each = EachLight { lights: 0, worst: 0.0 };
    visit_lights(&mut each);
    eprintln!("lights in fog: {} × {} paths, worst {:.1} standard errors", each.lights, 2048 * SIDE * SIDE, each.worst);
    assert!(each.lights >= 6);
}

/// A point light in a medium without an end: L = ∫ σs p(θ) I / r² e^(−σ (s + r)) ds.
#[test]
fn a_point_light_in_a_medium_without_an_end() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    for g in [-0.5, 0.0, 0.9] {
        for apart in [0.2, 1.0, 4.0] {
            let mut world = World::new();
            let camera = one_ray(&mut world, EYE, -DVec3::Z, 2048, 2);
            world.entity_mut(camera).insert(Medium { anisotropy: g, ..fog() });
            let at = EYE + DVec3::new(0.0, apart, -3.0);
            world.spawn((
                PointLight { intensity: Rgb::grey(5.0), ..PointLight::default() },
                Placement::at(at.x, at.y, at.z),
            ));
            let Medium { absorption, scattering, .. } = fog();
            let truth = [0, 1, 2].map(|part: usize| {
                let scattered = scattering.to_array()[part];
                let extinction = absorption.to_array()[part] + scattered;
                integral(0.0, 60.0, |s| {
                    let distance = (apart * apart + (s - 3.0) * (s - 3.0)).sqrt();
                    let to_light_z = (s - 3.0) / distance;
                    let irradiance = 5.0 / (distance * distance);
                    scattered * phase(g, -to_light_z) * irradiance * (-extinction * (s + distance)).exp()
                })
            });
            worst = worst.max(Measured::of(&world).check(&format!("g {g}, {apart} apart"), truth, 1e-2));
            tried += 1;
        }
    }
    eprintln!("a point light without end: {tried} × {} paths, worst {worst:.1} standard errors", 2048 * SIDE * SIDE);
}

/// Every registered shape that can be sampled as a light, with no line for it.
struct EachEmitter {
    shapes: usize,
    worst: f64,
}

impl ShapeVisitor for EachEmitter {
    fn visit<S: Listed>(&mut self) {
        if S::NON_UNIFORM == Some(true) || S::HAS_PRIMITIVES || !S::is_sampled(&S::Component::default()) {
            return;
        }
        let found = |lights: LightStrategy| {
            let mut world = World::new();
            let camera = one_ray(&mut world, EYE, -DVec3::Z, 256, 5);
            world.entity_mut(camera).insert(Integrator::Path { max_depth: 5, lights, roulette: 0 });
            world.spawn((Name::new("fog"), Sphere { radius: RADIUS }, fog()));
            let lamp = Emissive { radiance: Rgb::grey(2.0), ..Emissive::default() };
            world.spawn((Name::new("lamp"), S::Component::default(), lamp, Placement::at(0.2, -1.9, -0.3)));
            Measured::of(&world)
        };
        let [by_phase, by_light, by_both] = [LightStrategy::Bsdf, LightStrategy::Light, LightStrategy::Mis].map(found);
        for (name, other) in [("phase sampling", by_phase), ("light sampling", by_light)] {
            for part in 0..3 {
                let error = (other.error[part].powi(2) + by_both.error[part].powi(2)).sqrt();
                let off = (other.mean[part] - by_both.mean[part]) / error;
                self.worst = self.worst.max(off.abs());
                let word = S::Component::WORD;
                assert!(off.abs() < 4.0, "{word}: {name} {other:?} for {by_both:?}, {off:+.1} standard errors");
                assert!(by_both.error[part] < 0.05 * by_both.mean[part], "{word}: {by_both:?}");
            }
        }
        self.shapes += 1;
    }
}

#[test]
fn emitters_shine_into_fog_alike_however_they_are_found() {
    let mut each = EachEmitter { shapes: 0, worst: 0.0 };
    visit_shapes(&mut each);
    eprintln!("emitters in fog: {} shapes × 3 strategies, worst {:.1} standard errors", each.shapes, each.worst);
    assert!(each.shapes >= 6);
}

/// Light sampling of an environment image reaches scattering events as well as surfaces.
#[test]
fn an_environment_shines_into_fog_alike_however_it_is_found() {
    let folder = std::env::temp_dir().join(format!("pinhole_fog_{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("sky.hdr");
    let mut text = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n".to_vec();
    (0..32_u8).for_each(|texel| text.extend([40 + 5 * texel, 60, 250 - 6 * texel, if texel == 9 { 134 } else { 128 }]));
    std::fs::write(&file, text).expect("written");
    let found = |lights: LightStrategy| {
        let mut world = World::new();
        let camera = one_ray(&mut world, EYE, -DVec3::Z, 512, 3);
        world.entity_mut(camera).insert(Integrator::Path { max_depth: 3, lights, roulette: 0 });
        world.spawn((Name::new("fog"), Sphere { radius: RADIUS }, fog()));
        world.spawn(Environment { file: file.display().to_string(), ..Environment::default() });
        Measured::of(&world)
    };
    let [by_phase, by_light, by_both] = [LightStrategy::Bsdf, LightStrategy::Light, LightStrategy::Mis].map(found);
    let mut worst = 0.0_f64;
    for part in 0..3 {
        for other in [by_phase, by_light] {
            let error = (other.error[part].powi(2) + by_both.error[part].powi(2)).sqrt();
            worst = worst.max(((other.mean[part] - by_both.mean[part]) / error).abs());
            assert!(worst < 4.0, "{other:?} for {by_both:?}");
        }
    }
    std::fs::remove_dir_all(&folder).expect("removed");
    eprintln!("an environment in fog: 3 strategies, worst {worst:.1} standard errors");
}

/// One of many lights is chosen for a scattering event as for a surface.
#[test]
fn many_lights_shine_into_fog_as_each_of_them_does() {
    let scene = |count: u32| {
        let mut world = World::new();
        one_ray(&mut world, EYE, -DVec3::Z, 512, 3);
        world.spawn((Name::new("fog"), Sphere { radius: RADIUS }, fog()));
        for number in 0..count {
            let turn = f64::from(number) * std::f64::consts::TAU / f64::from(count);
            let place = Placement::at(3.0 * turn.cos(), 3.0 * turn.sin(), 0.5);
            let strength = Rgb::grey(400.0 / f64::from(count));
            world.spawn((PointLight { intensity: strength, ..PointLight::default() }, place));
            let lamp = Emissive { radiance: strength, ..Emissive::default() };
            let place = Placement::at(2.5 * turn.cos(), 2.5 * turn.sin(), -0.5);
            world.spawn((Sphere { radius: 0.02 }, lamp, place));
        }
        world
    };
    assert!(!pinhole::extract::many_area_lights_evidence(&Census::of(&scene(8))).needed);
    assert!(pinhole::extract::many_area_lights_evidence(&Census::of(&scene(200))).needed);
    let [few, many] = [64, 200].map(|count| Measured::of(&scene(count)));
    let mut worst = 0.0_f64;
    for part in 0..3 {
        let error = (few.error[part].powi(2) + many.error[part].powi(2)).sqrt();
        // The rings are all but even: with 64 lights what lies between two of them changes nothing that is seen here.
        worst = worst.max(((few.mean[part] - many.mean[part]) / error).abs());
    }
    eprintln!("many lights in fog: {few:?} and {many:?}, {worst:.1} standard errors apart");
    assert!(worst < 4.0, "{few:?} {many:?}");
}
