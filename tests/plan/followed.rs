//! Light that is followed: each stage, column and table exists where something asks for it, and nowhere else.

use super::*;
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
    use LightSampling::{Aimed, ByChance, Weighed};
    let (mut tried, setup) = (0, Setup { size: [12, 8], ..Setup::default() });
    for integrator in INTEGRATORS {
        for on in all() {
            let has = |toggle| on.contains(&toggle);
            let scene = followed_by(&on, integrator, setup);
            let (plan, tables) = prepare(&scene, &offer()).unwrap_or_else(|error| panic!("{on:?}: {error}"));
            let sky = matches!(integrator, Integrator::AmbientOcclusion { .. });
            let followed = !sky && integrator != Integrator::RayCasting;
            let lights = match integrator {
                Integrator::Path { lights, .. } => lights,
                Integrator::Distribution { .. } => Aimed,
                _ => ByChance,
            };
            let (aimed, weighed) = (lights != ByChance, lights == Weighed);
            let whitted = matches!(integrator, Integrator::Whitted { .. });
            let path = matches!(integrator, Integrator::Path { .. });
            let chance = path || matches!(integrator, Integrator::Distribution { .. });
            let absorbing = has(Glass) && has(Absorbing);
            let stages = [
                ("Start ways of light", followed),
                ("Start with nothing scattered", followed),
                ("End at the last leg", followed),
                ("Add the leg's light to its way", followed),
                ("Step to the next leg", followed),
                ("Follow the legs that are left", followed),
                ("Gather the light of all legs", followed),
                ("Reflect at mirrors", followed && has(Mirror)),
                ("Reflect and refract at glass", whitted && has(Glass)),
                ("Reflect or refract at glass", chance && has(Glass)),
                ("Absorb light in glass", followed && absorbing),
                ("Find the glass that rays start in", followed && absorbing),
                ("Scatter off rough metal", chance && has(Metal)),
                ("Scatter off matte surfaces", path),
                ("End ways by chance", path),
                ("Aim at lights with area", aimed && has(Lamp)),
                ("Aim at the environment", aimed && has(Environment)),
                ("Weigh light aimed at from matte surfaces", weighed && (has(Lamp) || has(Environment))),
                ("Weigh light aimed at from rough metal", weighed && has(Metal) && (has(Lamp) || has(Environment))),
                ("Add what surfaces emit, as far as not aimed at", aimed && has(Lamp)),
                ("Add what surfaces emit", !aimed && !sky && has(Lamp)),
                ("Add the environment, as far as not aimed at", aimed && has(Environment)),
                ("Add the environment", !aimed && !sky && has(Environment)),
                ("Add the light off rough metal", !sky && has(Metal)),
                ("Add the light that arrives", !sky),
                ("Aim at point lights", !sky),
                ("Aim at the open sky", sky),
                ("Show how much of the sky is seen", sky),
                ("Show surfaces unlit", false),
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
                ("light density", weighed && (has(Lamp) || has(Environment))),
                ("media", followed && absorbing),
                ("side", (followed && has(Glass)) || (!sky && has(Lamp) && has(OneSided))),
            ];
            for (column, needed) in expected {
                assert_eq!(columns.contains(column), needed, "{integrator:?} {on:?}: {column}");
            }
            let tables: BTreeSet<&str> = tables.iter().map(|table| table.name).collect();
            for (table, needed) in [
                ("integrator", followed || sky),
                ("lights with area", aimed && has(Lamp)),
                ("light of the environment", aimed && has(Environment)),
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
        pinhole::extract::integrator_of(&scene)
    };
    assert_eq!(chosen(&[]).integrator, Integrator::RayCasting);
    assert_eq!(chosen(&[Environment]).integrator, Integrator::RayCasting);
    for polished in [Mirror, Glass] {
        assert_eq!(chosen(&[polished]).integrator, Integrator::WHITTED);
    }
    for by_chance in [Metal, Lamp] {
        let found = chosen(&[by_chance, Mirror]);
        assert_eq!(found.integrator, Integrator::PATH);
        assert!(found.reason.starts_with("1 "), "{}", found.reason);
    }
}
