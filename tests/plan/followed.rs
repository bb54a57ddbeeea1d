//! Light that is followed: each stage, column and table exists where something asks for it, and nowhere else.

use super::*;
use pinhole::plan::Census;
use scenes::followed::{FollowToggle, INTEGRATORS, followed_by};

/// Nothing, all, each alone, and all pairs of what a followed scene may have.
fn all() -> Vec<Vec<FollowToggle>> {
    let toggles = FollowToggle::ALL;
    let mut found = vec![Vec::new(), toggles.to_vec()];
    for (at, &one) in toggles.iter().enumerate() {
        found.push(vec![one]);
        found.extend(toggles[at + 1..].iter().map(|&other| vec![one, other]));
    }
    found
}

#[test]
fn an_integrator_brings_what_it_needs_and_nothing_else() {
    use FollowToggle::*;
    use LightStrategy::{Bsdf, Light, Mis};
    let (mut tried, setup) = (0, Setup { size: [12, 8], ..Setup::default() });
    for integrator in INTEGRATORS {
        for on in all() {
            let has = |toggle| on.contains(&toggle);
            let scene = followed_by(&on, integrator, setup);
            let (plan, tables) =
                prepare(&Census::of(&scene), &offer()).unwrap_or_else(|error| panic!("{on:?}: {error}"));
            let sky = matches!(integrator, Integrator::AmbientOcclusion { .. });
            let followed = !sky && integrator != Integrator::RayCasting;
            let lights = match integrator {
                Integrator::Path { lights, .. } => lights,
                Integrator::Distribution { .. } => Light,
                _ => Bsdf,
            };
            let (samples_lights, mis) = (lights != Bsdf, lights == Mis);
            let whitted = matches!(integrator, Integrator::Whitted { .. });
            let path = matches!(integrator, Integrator::Path { .. });
            let random = path || matches!(integrator, Integrator::Distribution { .. });
            let absorbing = has(Glass) && has(Absorbing);
            let stages = [
                ("Start paths", followed),
                ("Clear scattered rays", followed),
                ("End at the maximum depth", followed),
                ("Add the bounce's light to its path", followed),
                ("Advance to the next bounce", followed),
                ("Trace the remaining bounces", followed),
                ("Sum the light of all bounces", followed),
                ("Sample BSDFs: mirror", followed && has(Mirror)),
                ("Split rays at glass", whitted && has(Glass)),
                ("Sample BSDFs: glass", random && has(Glass)),
                ("Absorb light in glass", followed && absorbing),
                ("Find the media that rays start in", followed && absorbing),
                ("Sample BSDFs: metal", random && has(Metal)),
                ("Sample BSDFs: matte", path),
                ("Russian roulette", path),
                ("Sample area lights", samples_lights && has(Lamp)),
                ("Sample the environment", samples_lights && has(Environment)),
                ("Compute MIS weights: matte", mis && (has(Lamp) || has(Environment))),
                ("Compute MIS weights: metal", mis && has(Metal) && (has(Lamp) || has(Environment))),
                ("Add emission, weighted by MIS", samples_lights && has(Lamp)),
                ("Add emission", !samples_lights && !sky && has(Lamp)),
                ("Add the environment, weighted by MIS", samples_lights && has(Environment)),
                ("Add the environment", !samples_lights && !sky && has(Environment)),
                ("Evaluate direct light: metal", !sky && has(Metal)),
                ("Evaluate direct light: matte", !sky),
                ("Sample point lights", !sky),
                ("Sample the open sky", sky),
                ("Show ambient occlusion", sky),
                ("Show unlit surfaces", false),
            ];
            for (stage, needed) in stages {
                let row = row(&plan, stage);
                assert_eq!(row.kept, needed, "{integrator:?} {on:?}: {stage}: {}", row.reason);
            }
            let columns: BTreeSet<&str> = plan.columns.iter().map(|column| column.name).collect();
            let expected = [
                ("path", followed),
                ("path light", followed),
                ("scattered", followed),
                ("light pdf", mis && (has(Lamp) || has(Environment))),
                ("media", followed && absorbing),
                ("side", (followed && has(Glass)) || (!sky && has(Lamp) && has(OneSided))),
            ];
            for (column, needed) in expected {
                assert_eq!(columns.contains(column), needed, "{integrator:?} {on:?}: {column}");
            }
            let tables: BTreeSet<&str> = tables.iter().map(|table| table.name).collect();
            for (table, needed) in [
                ("integrator", followed || sky),
                ("lights with area", samples_lights && has(Lamp)),
                ("light of the environment", samples_lights && has(Environment)),
            ] {
                assert_eq!(tables.contains(table), needed, "{integrator:?} {on:?}: {table}");
            }
            let film = film(&scene);
            assert_eq!(film.rejected, 0, "{integrator:?} {on:?}");
            tried += 1;
        }
    }
    eprintln!("followed light: {tried} combinations, each with its own stages, columns and tables");
}

#[test]
fn the_integrator_is_the_least_that_shows_what_the_scene_holds() {
    use FollowToggle::*;
    let chosen = |on: &[FollowToggle]| {
        let mut scene = followed_by(on, Integrator::RayCasting, Setup::default());
        let camera = named(&mut scene, "camera");
        scene.entity_mut(camera).remove::<Integrator>();
        pinhole::extract::integrator_of(&Census::of(&scene))
    };
    assert_eq!(chosen(&[]).integrator, Integrator::RayCasting);
    let sky = chosen(&[Environment]);
    assert_eq!((sky.integrator, sky.without_sky), (Integrator::PATH, Some(Integrator::RayCasting)));
    assert!(sky.reason.contains("\"evening\""), "{}", sky.reason);
    assert_eq!(chosen(&[Mirror, Environment]).without_sky, Some(Integrator::WHITTED));
    for specular in [Mirror, Glass] {
        assert_eq!(chosen(&[specular]).integrator, Integrator::WHITTED);
    }
    for by_bsdf in [Metal, Lamp] {
        let found = chosen(&[by_bsdf, Mirror]);
        assert_eq!((found.integrator, found.without_sky), (Integrator::PATH, None));
        assert!(found.reason.starts_with("1 "), "{}", found.reason);
    }
}
