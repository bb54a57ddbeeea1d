//! What a medium may not be, in one sentence; and what it may, however odd.

use super::*;
use crate::scenes::unhurried;
use pinhole::look::{Preflight, preflight};
use pinhole::plan::Census;
use pinhole::render::prepare;

fn told(world: &World) -> String {
    let message = prepare(&Census::of(world), &offer()).map(|_| ()).expect_err("refused").to_string();
    assert!(!message.contains('\n') && !message.contains(". ") && !message.ends_with('.'), "{message}");
    message
}

fn room() -> World {
    let mut world = World::new();
    one_ray(&mut world, DVec3::Z * 5.0, -DVec3::Z, 1, 16);
    world.spawn((Name::new("sky"), Background { colour: Rgb::grey(1.0) }));
    world
}

fn ball_of(medium: Medium) -> World {
    let mut world = room();
    world.spawn((Name::new("cloud"), Sphere::default(), medium));
    world
}

#[test]
fn values_out_of_range_are_refused_by_name() {
    let own = Medium::default();
    let mut refused = 0;
    for value in [f64::NAN, -1.0, f64::INFINITY, -1e-300, 1e39] {
        let colour = Rgb::new(0.1, value, 0.1);
        let cases = [
            ("absorption", Medium { absorption: colour, ..own }),
            ("scattering", Medium { scattering: colour, ..own }),
            ("emission", Medium { emission: colour, ..own }),
        ];
        for (field, medium) in cases {
            let told = told(&ball_of(medium));
            assert!(["medium \"cloud\"", field, "from 0 to 3.4e38"].iter().all(|word| told.contains(word)), "{told}");
            refused += 1;
        }
    }
    for anisotropy in [f64::NAN, 1.0, -1.0, 1.5, -2.0, f64::INFINITY] {
        let told = told(&ball_of(Medium { anisotropy, ..own }));
        let words = ["medium \"cloud\"", "anisotropy", "above -1 and below 1"];
        assert!(words.iter().all(|word| told.contains(word)), "{told}");
        refused += 1;
    }
    eprintln!("media: {refused} values refused");
}

/// A change to a scene, and the words that its refusal must hold.
type Case = (&'static [&'static str], fn(&mut World));

#[test]
fn places_that_a_medium_cannot_fill_are_refused_by_name() {
    let cases: &[Case] = &[
        (&["disk \"lid\"", "open shape", "a sphere"], |w| {
            w.spawn((Name::new("lid"), Disk::default(), Medium::default()));
        }),
        (&["triangle \"sail\"", "open shape", "a sphere"], |w| {
            w.spawn((Name::new("sail"), Triangle::default(), Medium::default()));
        }),
        (&["cylinder \"pipe\"", "open shape", "a closed cylinder"], |w| {
            w.spawn((Name::new("pipe"), Cylinder { capped: false, ..Cylinder::default() }, Medium::default()));
        }),
        (&["medium \"ball\"", "Matte", "glass"], |w| {
            w.spawn((Name::new("ball"), Sphere::default(), Matte::default(), Medium::default()));
        }),
        (&["sphere \"lamp\"", "Emissive", "emission"], |w| {
            w.spawn((Name::new("lamp"), Sphere::default(), Emissive::default(), Medium::default()));
        }),
        (&["sphere \"ball\"", "\"gem\"", "glass"], |w| {
            let gem = w.spawn((Name::new("gem"), Glass::default())).id();
            w.spawn((Name::new("ball"), Sphere::default(), UsesMaterial(gem), Medium::default()));
        }),
        (&["medium \"mist\"", "\"haze\"", "all of space"], |w| {
            w.spawn((Name::new("haze"), Medium::default()));
            w.spawn((Name::new("mist"), Medium::default()));
        }),
        (&["medium \"haze\"", "emission", "all of space"], |w| {
            let emission = Rgb::new(0.0, 1.0, 0.0);
            let scattering = Rgb::new(1.0, 0.0, 1.0);
            w.spawn((Name::new("haze"), Medium { emission, scattering, ..Medium::default() }));
        }),
        (&["camera \"camera\"", "integrator", "\"haze\"", "Path()"], |w| {
            w.spawn((Name::new("haze"), Medium::default()));
            let camera = named(w, "camera");
            w.entity_mut(camera).insert(Integrator::WHITTED);
        }),
        (&["camera \"camera\"", "integrator", "\"haze\"", "Path()"], |w| {
            w.spawn((Name::new("haze"), Medium::default()));
            let camera = named(w, "camera");
            w.entity_mut(camera).insert(Integrator::RayCasting);
        }),
        (&["camera \"camera\"", "bidirectional_path_tracing", "\"haze\"", "64 lights"], |w| {
            w.spawn((Name::new("haze"), Medium::default()));
            for number in 0..65 {
                w.spawn((Sphere { radius: 0.1 }, Emissive::default(), Placement::at(f64::from(number), 0.0, 0.0)));
            }
            let camera = named(w, "camera");
            w.entity_mut(camera).insert(BidirectionalPathTracing::default());
        }),
        (&["camera \"camera\"", "photon_mapping", "\"haze\""], |w| {
            w.spawn((Name::new("haze"), Medium::default()));
            let camera = named(w, "camera");
            w.entity_mut(camera).insert(PhotonMapping::default());
        }),
    ];
    for (words, change) in cases {
        let mut world = room();
        change(&mut world);
        let told = told(&world);
        assert!(words.iter().all(|word| told.contains(word)), "{told} without {words:?}");
        eprintln!("{told}");
    }
}

/// Values at the ends of what is accepted: no number of the picture is none, and no render is without an end.
#[test]
fn extremes_are_rendered() {
    let mut tried = 0;
    for scattering in [0.0, 1e-30, 1.0, 1e30, 3e38] {
        for anisotropy in [-0.999_999, 0.0, 0.999_999, 1.0 - f64::EPSILON] {
            for absorption in [0.0, 1e-9, 1e30] {
                let (absorption, scattering) = (Rgb::grey(absorption), Rgb::grey(scattering));
                let own = Medium { absorption, scattering, anisotropy, emission: Rgb::grey(1e-3) };
                let measured = Measured::of(&ball_of(own));
                for mean in measured.mean {
                    assert!((0.0..=1.01).contains(&mean), "{own:?}: {measured:?}");
                }
                tried += 1;
            }
        }
    }
    eprintln!("extremes: {tried} media rendered");
}

/// Albedo 1 − 1e-9 loses next to nothing, and a scene without media has none of their stages.
#[test]
fn what_is_not_there_costs_nothing() {
    let absorption = Rgb::grey(1e-9);
    let nearly = Medium { absorption, scattering: Rgb::grey(1.0 - 1e-9), ..Medium::default() };
    Measured::of(&ball_of(nearly)).check("albedo 1 − 1e-9", [1.0; 3], 1e-3);
    let mut world = room();
    world.spawn((Name::new("ball"), Sphere::default(), Matte::default()));
    let before = pinhole::plan::plan(&Census::of(&world), &offer()).expect("a plan");
    let own: Vec<&str> = pinhole::stages::media().iter().map(|stage| stage.name).collect();
    let kept = before.rows.iter().filter(|row| row.kept && own.contains(&row.stage)).count();
    let asked = before.rows.iter().filter(|row| own.contains(&row.stage)).count();
    assert_eq!((kept, asked, own.len()), (0, 12, 12));
}

/// What is odd and yet rendered is said: fog that keeps the sky out, and fog too dense for single precision.
#[test]
fn odd_media_are_said() {
    let said = |world: &World| {
        let census = &Census::of(world);
        let (plan, tables) = prepare(census, &offer()).expect("prepared");
        let asked = Preflight { threads: Some(1), ends_in_time: true, ..unhurried() };
        preflight(census, (&plan, &tables), asked).expect("said")
    };
    assert_eq!(said(&ball_of(Medium::default())), Vec::<String>::new());
    let dense = said(&ball_of(Medium { scattering: Rgb::grey(1e7), ..Medium::default() }));
    assert!(dense.iter().any(|own| own.contains("medium \"cloud\" scatters light every 1e-7")), "{dense:?}");
    let mut world = room();
    world.spawn((Name::new("haze"), Medium::default()));
    let all = said(&world);
    assert!(all.iter().any(|own| own.contains("medium \"haze\" fills all of space")), "{all:?}");
    eprintln!("{dense:?} {all:?}");
}

#[test]
fn density_grids_are_refused_by_name() {
    let own = || DensityGrid::of([2, 1, 1], |_| 1.0);
    let cases: Vec<(&[&str], DensityGrid)> = vec![
        (&["size", "0 × 0 × 0", "a file"], DensityGrid::default()),
        (&["size", "4294967295 × 4294967295 × 2", "134217728"], DensityGrid { size: [u32::MAX, u32::MAX, 2], ..own() }),
        (&["values", "2 numbers", "3, one for each"], DensityGrid { size: [3, 1, 1], ..own() }),
        (&["values", "NaN", "finite"], DensityGrid { values: vec![1.0, f32::NAN], ..own() }),
        (&["values", "-1", "at least 0"], DensityGrid { values: vec![1.0, -1.0], ..own() }),
        (&["max", "(1, -1, 1)", "(-1, -1, -1)"], DensityGrid { max: DVec3::new(1.0, -1.0, 1.0), ..own() }),
        (&["max", "NaN"], DensityGrid { max: DVec3::splat(f64::NAN), ..own() }),
        (&["min", "1e30"], DensityGrid { min: DVec3::splat(-1e30), ..own() }),
        (&["values", "beside the file", "one of the two"], DensityGrid { file: "a.vol".into(), ..own() }),
        (&["file", "there is no file"], DensityGrid { file: "nowhere.vol".into(), ..DensityGrid::default() }),
        (&["file", "no .vol file"], DensityGrid { file: "Cargo.toml".into(), ..DensityGrid::default() }),
    ];
    let count = cases.len();
    for (words, grid) in cases {
        let mut world = ball_of(Medium::default());
        let cloud = named(&mut world, "cloud");
        world.entity_mut(cloud).insert(grid);
        let told = told(&world);
        eprintln!("{told}");
        assert!(told.contains("medium \"cloud\"") && words.iter().all(|word| told.contains(word)), "{told}");
    }
    let mut world = room();
    world.spawn((Name::new("ball"), Sphere::default(), Matte::default(), own()));
    let told = told(&world);
    assert!(told.contains("density grid \"ball\"") && told.contains("beside"), "{told}");
    eprintln!("density: {} grids refused by name", count + 1);
}
