//! What a scene does not need does not exist, and leaving it out changes nothing; what it needs cannot be left out.

use crate::scenes;

#[path = "plan/declared.rs"]
mod declared;
#[path = "plan/followed.rs"]
mod followed;
#[path = "plan/forced.rs"]
mod forced;
#[path = "plan/paintings.rs"]
mod paintings;
#[path = "plan/textures.rs"]
mod textures;
#[path = "plan/views.rs"]
mod views;

use bevy_ecs::prelude::*;
use bevy_ecs::schedule::Schedule;
use bevy_ecs::world::EntityRef;
use glam::DVec3;
use pinhole::Error;
use pinhole::extract::ImageFrame;
use pinhole::film::FilmTile;
use pinhole::plan::{
    Census, ColumnKind, ComponentValues, Evidence, Plan, PlanError, Stage, StageKind, TableKind, TileSystems, plan,
    view_names,
};
use pinhole::render::{RenderWorld, StageClock, inspect, prepare};
use pinhole::scene::*;
use scenes::{
    EYES, Eye, FilmBits, Setup, Toggle, VIEWED, combinations, film, film_by, full, named, offer, one_world,
    shapes_of_all_kinds, shining, singles_and_pairs, soft, stretched, textured, toggled,
};
use std::collections::{BTreeMap, BTreeSet};

/// Whether a combination cannot make a picture: its view asks for what nothing in it writes.
fn pictureless(on: &[Toggle]) -> bool {
    let shapes = [
        Toggle::Sphere,
        Toggle::Ellipsoid,
        Toggle::Plane,
        Toggle::Shapes,
        Toggle::Phong,
        Toggle::BlinnPhong,
        Toggle::Emissive,
        Toggle::Mirror,
        Toggle::Glass,
        Toggle::Metal,
        Toggle::RoughGlass,
        Toggle::Principled,
    ];
    on.contains(&Toggle::View) && !shapes.iter().any(|shape| on.contains(shape))
}

fn plan_of(scene: &World) -> Plan {
    plan(&Census::of(scene), &offer()).expect("plans")
}

/// The columns that the stages on offer could write, and the tables they could read.
fn registry(offer: &[Stage]) -> (Vec<ColumnKind>, Vec<TableKind>) {
    let (mut columns, mut tables) = (Vec::new(), Vec::new());
    for stage in offer {
        columns.extend(stage.writes.iter().filter(|column| !columns.contains(*column)).copied().collect::<Vec<_>>());
        let beside = stage.tables_with.iter().map(|(table, _)| table);
        let asked = stage.tables_where.iter().map(|(table, _)| table);
        let known = stage.tables.iter().chain(asked).chain(beside).filter(|table| !tables.contains(*table));
        tables.extend(known.copied().collect::<Vec<_>>());
    }
    (columns, tables)
}

/// The name of a stage's system, as a schedule calls it.
fn system_of(stage: &Stage) -> String {
    let mut schedule = Schedule::default();
    schedule.add_systems((stage.system)());
    schedule.initialize(&mut World::new()).map(|_| ()).expect("one system is a schedule");
    let mut systems = schedule.systems().expect("initialised");
    systems.next().map(|(_, system)| system.name().to_string()).expect("one system")
}

#[test]
fn rows_systems_columns_and_tables_are_one_list() {
    let offer = offer();
    let (columns, tables) = registry(&offer);
    let systems: Vec<String> = offer.iter().map(system_of).collect();
    assert_eq!(systems.iter().collect::<BTreeSet<_>>().len(), offer.len(), "a system a stage");
    let names: BTreeSet<&str> = offer.iter().map(|stage| stage.name).collect();
    assert_eq!(names.len(), offer.len(), "a name a stage");

    let mut bare = World::new();
    let mut schedule = Schedule::default();
    schedule.add_systems(|| {});
    schedule.initialize(&mut bare).map(|_| ()).expect("builds");
    let bare = bare.entities().count_spawned();
    let (mut planned, mut refused) = (0, 0);
    for on in combinations() {
        let scene = toggled(&on);
        if pictureless(&on) {
            refused += 1;
            match prepare(&Census::of(&scene), &offer).err().expect("refused") {
                Error::Plan(PlanError::NoSuchView { wanted, why }) => {
                    assert_eq!(wanted, VIEWED, "{on:?}");
                    assert!(why.contains("\"Classify hits\" is left out here (0 shapes"), "{on:?}: {why}");
                }
                other => panic!("{on:?}: {other}"),
            }
            continue;
        }
        planned += 1;
        let (plan, extracted) = prepare(&Census::of(&scene), &offer).unwrap_or_else(|error| panic!("{on:?}: {error}"));
        assert_eq!(plan.rows.len(), offer.len(), "{on:?}: a row a stage on offer");
        let mut frame = RenderWorld::new(&plan, &extracted, 1, &[]);
        frame.schedule.initialize(&mut frame.world).map(|_| ()).expect("builds");

        let kept: Vec<&str> = plan.rows.iter().filter(|row| row.kept).map(|row| row.stage).collect();
        let expected: Vec<&String> = kept.iter().map(|name| &systems[position(&offer, name)]).collect();
        let scheduled: Vec<String> =
            frame.schedule.systems().expect("initialised").map(|(_, system)| system.name().to_string()).collect();
        let (laps, found): (Vec<&String>, Vec<&String>) =
            scheduled.iter().partition(|name| name.contains("clock_hook"));
        assert_eq!(found.iter().collect::<BTreeSet<_>>(), expected.iter().collect::<BTreeSet<_>>(), "{on:?}: systems");
        assert_eq!(found.len(), kept.len(), "{on:?}: systems");
        let timed = on.contains(&Toggle::Statistics);
        assert_eq!(laps.len(), if timed { kept.len() } else { 0 }, "{on:?}: laps");
        assert_eq!(frame.world.contains_resource::<StageClock>(), timed, "{on:?}: the clock");

        let of_rows: BTreeSet<&str> = plan.rows.iter().flat_map(|row| &row.columns).copied().collect();
        let of_plan: BTreeSet<&str> = plan.columns.iter().map(|column| column.name).collect();
        assert_eq!(of_rows, of_plan, "{on:?}: columns");
        let tile = frame.world.entity(frame.tiles[0]);
        for column in &columns {
            assert_eq!((column.present)(&tile), of_plan.contains(column.name), "{on:?}: column {}", column.name);
        }
        // The tile and its depth; where samples are taken, which one, and of which pixels.
        let sampled = if on.contains(&Toggle::Samples) { 2 } else { 0 };
        assert_eq!(
            tile.archetype().components().len(),
            plan.columns.len() + 2 + sampled,
            "{on:?}: columns and the tile, no more"
        );

        let of_rows: BTreeSet<&str> = plan.rows.iter().flat_map(|row| &row.tables).copied().collect();
        let of_plan: BTreeSet<&str> = plan.tables.iter().map(|table| table.name).collect();
        assert_eq!(of_rows, of_plan, "{on:?}: tables");
        for table in &tables {
            assert_eq!((table.present)(&frame.world), of_plan.contains(table.name), "{on:?}: table {}", table.name);
        }
        // Only light that is followed can be given up.
        let stops = plan.stages.iter().any(|stage| stage.set == TileSystems::RemainingBounces);
        let entities = bare + 1 + plan.tables.len() as u32 + u32::from(timed) + u32::from(stops);
        assert_eq!(frame.world.entities().count_spawned(), entities, "{on:?}: a tile and the tables, no more");

        for row in plan.rows.iter().filter(|row| !row.kept) {
            assert!(row.columns.is_empty() && row.tables.is_empty(), "{on:?}: {} is dropped, so it is free", row.stage);
            assert!(!row.reason.is_empty(), "{on:?}: {} is dropped for a reason", row.stage);
        }
    }
    eprintln!(
        "one list: all {planned} + {refused} combinations of {} toggles; {refused} refused",
        scenes::TOGGLES.len()
    );
}

fn position(offer: &[Stage], name: &str) -> usize {
    offer.iter().position(|stage| stage.name == name).expect("on offer")
}

#[test]
fn plans_are_deterministic_and_forget_what_was_removed() {
    let all = combinations();
    for on in &all {
        let scene = toggled(on);
        let census = &Census::of(&scene);
        match (plan(census, &offer()), plan(census, &offer())) {
            (Ok(once), Ok(twice)) => assert_eq!(once.rows, twice.rows, "{on:?}"),
            (once, twice) => assert_eq!(once.map(|_| ()), twice.map(|_| ()), "{on:?}"),
        }
    }
    type Change = fn(&mut EntityWorldMut<'_>);
    let changes: Vec<(&str, Change, Change)> = vec![
        ("a light", add::<PointLight>, take::<PointLight>),
        ("a sphere", add::<(Sphere, Matte)>, take::<(Sphere, Matte)>),
        ("an ellipsoid", add_ellipsoid, take::<(Sphere, Matte, Placement)>),
        ("a plane", add::<(Plane, Matte)>, take::<(Plane, Matte)>),
        ("a disk", add::<(Disk, Matte)>, take::<(Disk, Matte)>),
        ("a rectangle", add::<(Rectangle, Matte)>, take::<(Rectangle, Matte)>),
        ("a cuboid", add::<(Cuboid, Matte)>, take::<(Cuboid, Matte)>),
        ("a triangle", add::<(Triangle, Matte)>, take::<(Triangle, Matte)>),
        ("a background", add::<Background>, take::<Background>),
        ("a view", add_view, take::<View>),
        ("statistics", add::<Statistics>, take::<Statistics>),
        ("a sun", add::<DirectionalLight>, take::<DirectionalLight>),
        ("a spot", add::<SpotLight>, take::<SpotLight>),
        ("a glossy ball", add::<(Sphere, Phong)>, take::<(Sphere, Phong)>),
        ("a satin ball", add::<(Sphere, BlinnPhong)>, take::<(Sphere, BlinnPhong)>),
        ("a glow", add::<(Sphere, Emissive)>, take::<(Sphere, Emissive)>),
        ("a mirror", add::<(Sphere, Mirror)>, take::<(Sphere, Mirror)>),
        ("a ball of glass", add::<(Sphere, Glass)>, take::<(Sphere, Glass)>),
        ("rough metal", add::<(Sphere, Metal)>, take::<(Sphere, Metal)>),
        ("a lens", add::<(PerspectiveCamera, Lens)>, take::<(PerspectiveCamera, Lens)>),
        ("a camera", add::<OrthographicCamera>, take::<OrthographicCamera>),
    ];
    let mut changed = 0;
    for (turn, on) in singles_and_pairs().into_iter().filter(|on| !pictureless(on)).enumerate() {
        let mut scene = toggled(&on);
        let before = plan_of(&scene);
        // All of them where one thing is there beside what every scene has, and a third in turn where two are.
        let tried = |at: usize| on.len() < 2 || (at + turn).is_multiple_of(3);
        for (_, (what, add, remove)) in changes.iter().enumerate().filter(|(at, _)| tried(*at)) {
            let entity = scene.spawn(Name::new("passing")).id();
            add(&mut scene.entity_mut(entity));
            changed += u32::from(plan_of(&scene).to_string() != before.to_string());
            remove(&mut scene.entity_mut(entity));
            let after = plan_of(&scene);
            assert_eq!(after.rows, before.rows, "{on:?}: {what} added and removed");
            assert_eq!(after.to_string(), before.to_string(), "{on:?}: {what} added and removed");
            scene.despawn(entity);
        }
    }
    assert!(changed > 100, "adding must change most plans, not {changed}");
    eprintln!("deterministic: {} plans twice; {changed} plans changed by adding, all back by removing", all.len());
}

fn add<B: Bundle + Default>(entity: &mut EntityWorldMut<'_>) {
    entity.insert(B::default());
}

fn take<B: Bundle>(entity: &mut EntityWorldMut<'_>) {
    entity.remove::<B>();
}

fn add_ellipsoid(entity: &mut EntityWorldMut<'_>) {
    let placement = Placement { scale: DVec3::new(1.0, 2.0, 1.0), ..Placement::default() };
    entity.insert((Sphere::default(), Matte::default(), placement));
}

fn add_view(entity: &mut EntityWorldMut<'_>) {
    entity.insert(View { column: "raster".into() });
}

#[test]
fn what_is_disabled_or_unused_is_dropped_by_name() {
    let kinds: [(&str, &[&str]); 12] = [
        ("ball", &["Intersect spheres", "Compute surfaces: spheres", "Trace shadow rays: spheres"]),
        ("egg", &["Intersect ellipsoids", "Compute surfaces: ellipsoids", "Trace shadow rays: ellipsoids"]),
        ("ground", &["Intersect planes", "Compute surfaces: planes", "Trace shadow rays: planes"]),
        ("coin", &["Intersect disks", "Compute surfaces: disks", "Trace shadow rays: disks"]),
        ("mat", &["Intersect rectangles", "Compute surfaces: rectangles", "Trace shadow rays: rectangles"]),
        ("brick", &["Intersect cuboids", "Compute surfaces: cuboids", "Trace shadow rays: cuboids"]),
        ("pipe", &["Intersect cylinders", "Compute surfaces: cylinders", "Trace shadow rays: cylinders"]),
        ("hat", &["Intersect cones", "Compute surfaces: cones", "Trace shadow rays: cones"]),
        ("ring", &["Intersect tori", "Compute surfaces: tori", "Trace shadow rays: tori"]),
        ("sail", &["Intersect triangles", "Compute surfaces: triangles", "Trace shadow rays: triangles"]),
        ("lamp", &["Sample point lights", "Clear shadow hits", "Evaluate direct light: matte"]),
        ("sky", &["Add the background"]),
    ];
    let on = [
        Toggle::Light,
        Toggle::Plane,
        Toggle::Sphere,
        Toggle::Ellipsoid,
        Toggle::Shapes,
        Toggle::Shadow,
        Toggle::Background,
    ];
    for (name, stages) in kinds {
        let mut scene = toggled(&on);
        let entity = named(&mut scene, name);
        assert!(stages.iter().all(|stage| row(&plan_of(&scene), stage).kept), "{name}: kept while enabled");
        scene.entity_mut(entity).insert(Disabled);
        let plan = plan_of(&scene);
        for stage in stages {
            let row = row(&plan, stage);
            let named = row.reason.contains(&format!("\"{name}\"")) && row.reason.contains("disabled");
            assert!(!row.kept && row.count == 0 && named, "{name} disabled: {row:?}");
        }
        film(&scene);
    }
    let kinds: [(&str, &str); 5] = [
        ("sun", "Sample directional lights"),
        ("spot", "Sample spot lights"),
        ("glossy ball", "Evaluate direct light: Phong"),
        ("satin ball", "Evaluate direct light: Blinn–Phong"),
        ("glow", "Add emission, weighted by MIS"),
    ];
    for (name, stage) in kinds {
        let mut scene = toggled(&[&on[..], &scenes::MORE].concat());
        assert!(row(&plan_of(&scene), stage).kept, "{name}: kept while enabled");
        let entity = named(&mut scene, name);
        scene.entity_mut(entity).insert(Disabled);
        let plan = plan_of(&scene);
        let row = row(&plan, stage);
        let named = row.reason.contains(&format!("\"{name}\"")) && row.reason.contains("disabled");
        assert!(!row.kept && row.count == 0 && named, "{name} disabled: {row:?}");
        film(&scene);
    }

    let mut scene = toggled(&on);
    let second = (Name::new("second camera"), OrthographicCamera::default(), Disabled);
    scene.spawn(second);
    let plan = plan_of(&scene);
    let row_of_second = row(&plan, "Generate camera rays: orthographic");
    assert!(!row_of_second.kept && row_of_second.reason.contains("\"second camera\", disabled"), "{row_of_second:?}");

    let mut scene = toggled(&[Toggle::Sphere]);
    scene.spawn((Name::new("spare"), Matte::default()));
    let plan = plan_of(&scene);
    let planar = row(&plan, "Show unlit surfaces");
    assert!(planar.kept && planar.count == 1 && !planar.reason.contains("spare"), "{planar:?}");
    let mut scene = toggled(&[Toggle::Light, Toggle::Shadow]);
    scene.spawn((Name::new("spare"), Matte::default()));
    let plan = plan_of(&scene);
    for stage in ["Clear shadow rays", "Sample point lights", "Evaluate direct light: matte"] {
        let row = row(&plan, stage);
        assert!(!row.kept && row.reason.contains("\"spare\"") && row.reason.contains("unused"), "{row:?}");
    }
    eprintln!("disabled: 10 entities, 26 stages; unused: 1 matte in 2 scenes");
}

fn row<'p>(plan: &'p Plan, stage: &str) -> &'p pinhole::plan::PlanRow {
    plan.rows.iter().find(|row| row.stage == stage).expect("on offer")
}

#[test]
fn reasons_name_the_first_three() {
    let mut scene = toggled(&[Toggle::Shadow, Toggle::Background]);
    for number in 1..=4 {
        let at = Placement::at(f64::from(number), 1.0, 0.0);
        scene.spawn((Name::new(format!("ball {number}")), Sphere { radius: 0.25 }, Matte::default(), at));
        let egg = Placement { scale: DVec3::new(1.0, 2.0, 1.0), ..at };
        scene.spawn((Name::new(format!("egg {number}")), Sphere { radius: 0.125 }, Matte::default(), egg));
        scene.spawn((Name::new(format!("pane {number}")), Plane::default(), Matte::default(), at));
        scene.spawn((Name::new(format!("sail {number}")), scenes::leaning_triangle(1.0), Matte::default(), at));
        let at = Placement::at(f64::from(number), 3.0, 1.0);
        scene.spawn((Name::new(format!("lamp {number}")), PointLight::default(), at));
    }
    let (balls, eggs, panes, sails, lamps) = (three("ball"), three("egg"), three("pane"), three("sail"), three("lamp"));
    let mattes = "\"ball 1\", \"egg 1\", \"pane 1\", …".to_string();
    let spheres = "\"ball 1\", \"egg 1\", \"ball 2\", …".to_string();
    let expected: [(&str, Vec<&String>); 19] = [
        ("Clear hits", vec![&spheres, &panes, &sails]),
        ("Intersect triangles", vec![&sails]),
        ("Compute surfaces: triangles", vec![&sails]),
        ("Trace shadow rays: triangles", vec![&sails, &lamps]),
        ("Intersect ellipsoids", vec![&eggs]),
        ("Compute surfaces: ellipsoids", vec![&eggs]),
        ("Trace shadow rays: ellipsoids", vec![&eggs, &lamps]),
        ("Intersect spheres", vec![&balls]),
        ("Intersect planes", vec![&panes]),
        ("Classify hits", vec![&spheres, &panes, &sails]),
        ("Compute surfaces: spheres", vec![&balls]),
        ("Compute surfaces: planes", vec![&panes]),
        ("Sample point lights", vec![&lamps, &mattes]),
        ("Clear shadow hits", vec![&lamps, &mattes]),
        ("Trace shadow rays: spheres", vec![&balls, &lamps]),
        ("Trace shadow rays: planes", vec![&panes, &lamps]),
        ("Evaluate direct light: matte", vec![&lamps, &mattes]),
        ("Show unlit surfaces", vec![&lamps]),
        ("Generate camera rays: perspective", vec![]),
    ];
    let plan = plan_of(&scene);
    for (stage, names) in &expected {
        let row = row(&plan, stage);
        for names in names {
            assert!(row.reason.contains(names.as_str()), "\"{stage}\" must name {names}: {}", row.reason);
        }
    }
    assert!(row(&plan, "Generate camera rays: perspective").reason.contains("\"camera\""));
    assert!(row(&plan, "Add the background").reason.contains("\"sky\""));
    for row in plan.rows.iter().filter(|row| row.count > 0) {
        assert!(row.reason.contains('"'), "\"{}\" counts {} and names none: {}", row.stage, row.count, row.reason);
    }
    eprintln!("reasons: {} stages name their first three of four", expected.len());
}

fn three(noun: &str) -> String {
    format!("\"{noun} 1\", \"{noun} 2\", \"{noun} 3\", …")
}

/// What lights nothing, because the camera's integrator aims at no area, says so, and a scene in which something shines is not shown unlit.
#[test]
fn an_emissive_surface_is_seen_and_lights_nothing() {
    let mut scene = toggled(&[Toggle::Emissive, Toggle::Plane]);
    let aimed = plan_of(&scene);
    assert_eq!(row(&aimed, "Add emission").reason, "added with its MIS weight");
    assert!(row(&aimed, "Add emission, weighted by MIS").kept);
    assert!(row(&aimed, "Sample area lights").kept && row(&aimed, "Evaluate direct light: matte").kept);
    let camera = named(&mut scene, "camera");
    scene.entity_mut(camera).insert(Integrator::RayCasting);
    let plan = plan_of(&scene);
    let emission = row(&plan, "Add emission");
    assert_eq!(emission.reason, "1 emissive surface: \"glow\", seen, but not lighting other surfaces");
    assert!(
        emission.kept && !row(&plan, "Show unlit surfaces").kept && !row(&plan, "Evaluate direct light: matte").kept
    );
    let alone = plan_of(&toggled(&[Toggle::Emissive, Toggle::Light]));
    let columns: Vec<&str> = alone.columns.iter().map(|column| column.name).collect();
    assert!(!columns.contains(&"surface") && !columns.contains(&"material rows"), "{columns:?}");
}
