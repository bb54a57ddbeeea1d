//! What a scene does not need does not exist, and leaving it out changes nothing; what it needs cannot be left out.

mod scenes;

use bevy_ecs::component::ComponentId;
use bevy_ecs::prelude::*;
use bevy_ecs::query::ComponentAccessKind;
use bevy_ecs::schedule::Schedule;
use bevy_ecs::system::SystemAccess;
use bevy_ecs::world::EntityRef;
use pinhole::Error;
use pinhole::extract::ImageShape;
use pinhole::film::FilmTile;
use pinhole::plan::{ColumnKind, Evidence, LaneValues, Plan, PlanError, Stage, StageKind, TableKind, plan, view_names};
use pinhole::rays::Tile;
use pinhole::render::{Execution, RenderWorld, StageClock, inspect, prepare};
use pinhole::scene::*;
use scenes::{
    EYES, Eye, FilmBits, Setup, Toggle, VIEWED, combinations, film, film_by, full, named, offer, one_world,
    singles_and_pairs, toggled,
};
use std::collections::BTreeSet;

/// Whether a combination cannot make a picture: its view asks for what nothing in it writes.
fn pictureless(on: &[Toggle]) -> bool {
    on.contains(&Toggle::View) && !on.contains(&Toggle::Sphere) && !on.contains(&Toggle::Plane)
}

fn plan_of(scene: &World) -> Plan {
    plan(scene, &offer()).expect("plans")
}

/// The columns that the stages on offer could write, and the tables they could read.
fn registry(offer: &[Stage]) -> (Vec<ColumnKind>, Vec<TableKind>) {
    let (mut columns, mut tables) = (Vec::new(), Vec::new());
    for stage in offer {
        columns.extend(stage.writes.iter().filter(|column| !columns.contains(*column)).copied().collect::<Vec<_>>());
        tables.extend(stage.tables.iter().filter(|table| !tables.contains(*table)).copied().collect::<Vec<_>>());
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
            match prepare(&scene, &offer).err().expect("refused") {
                Error::Plan(PlanError::NoSuchView { asked, why }) => {
                    assert_eq!(asked, VIEWED, "{on:?}");
                    assert!(why.contains("\"Classify hits\" is left out here (0 spheres, 0 planes)"), "{on:?}: {why}");
                }
                other => panic!("{on:?}: {other}"),
            }
            continue;
        }
        planned += 1;
        let (plan, extracted) = prepare(&scene, &offer).unwrap_or_else(|error| panic!("{on:?}: {error}"));
        assert_eq!(plan.rows.len(), offer.len(), "{on:?}: a row a stage on offer");
        let mut frame = RenderWorld::new(&plan, &extracted, 1, &Execution::default(), &[]);
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
        assert_eq!(
            tile.archetype().components().len(),
            plan.columns.len() + 1,
            "{on:?}: columns and the tile, no more"
        );

        let of_rows: BTreeSet<&str> = plan.rows.iter().flat_map(|row| &row.tables).copied().collect();
        let of_plan: BTreeSet<&str> = plan.tables.iter().map(|table| table.name).collect();
        assert_eq!(of_rows, of_plan, "{on:?}: tables");
        for table in &tables {
            assert_eq!((table.present)(&frame.world), of_plan.contains(table.name), "{on:?}: table {}", table.name);
        }
        let entities = bare + 1 + plan.tables.len() as u32 + u32::from(timed);
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

/// What a stage declares is what its system touches, or the plan would prune by a lie.
#[test]
fn stages_declare_what_their_systems_touch() {
    let offer = offer();
    let (columns, tables) = registry(&offer);
    let scene = full(Setup::default());
    let mut world = World::new();
    let mut words: Vec<(ComponentId, String)> = Vec::new();
    for column in &columns {
        let mut tile = world.spawn_empty();
        (column.insert)(&mut tile);
        let id = tile.archetype().components()[0];
        words.push((id, format!("column {}", column.name)));
    }
    for table in &tables {
        let known: Vec<ComponentId> = world.components().iter_registered().map(|(id, _)| id).collect();
        ((table.extract)(&scene).expect("extracts").insert)(&mut world);
        let new = world.components().iter_registered().find(|(id, _)| !known.contains(id));
        let new = new.map(|(id, _)| id).expect("a table is a new resource");
        words.push((new, format!("table {}", table.name)));
    }
    let tile = world.register_component::<Tile>();
    let word = |id: ComponentId| words.iter().find(|(own, _)| *own == id).map(|(_, word)| word.clone());

    let mut compared = 0;
    for stage in &offer {
        let mut schedule = Schedule::default();
        schedule.add_systems((stage.system)());
        schedule.initialize(&mut world).map(|_| ()).expect("one system is a schedule");
        let (_, system) = schedule.systems_with_access().expect("initialised").next().expect("one system");
        let SystemAccess::Shared(access) = system.access() else {
            eprintln!("declared: \"{}\" takes the world whole", stage.name);
            continue;
        };
        let accesses = access.combined_access().try_iter_access().expect("finite");
        let (mut read, mut written) = (BTreeSet::new(), BTreeSet::new());
        for access in accesses {
            match access {
                ComponentAccessKind::Exclusive(id) => written.extend(word(id)),
                ComponentAccessKind::Shared(id) if id != tile => read.extend(word(id)),
                _ => {}
            }
        }
        let name = |column: &ColumnKind| format!("column {}", column.name);
        let writes: BTreeSet<String> = stage.writes.iter().map(name).collect();
        let mut reads: BTreeSet<String> = stage.reads.iter().chain(&stage.reads_if).map(name).collect();
        reads.extend(stage.tables.iter().map(|table| format!("table {}", table.name)));
        reads.retain(|word| !writes.contains(word));
        if stage.name == "Turn rays into the world" {
            // Its rays have origins only where the orthographic stage, an alternative, has brought its table.
            reads.insert("table view rectangle".into());
        }
        assert_eq!(written, writes, "\"{}\" writes", stage.name);
        assert_eq!(read, reads, "\"{}\" reads", stage.name);
        compared += 1;
    }
    eprintln!("declared: {compared} of {} stages compared with what bevy_ecs says they touch", offer.len());
}

#[test]
fn plans_are_deterministic_and_forget_what_was_removed() {
    let all = combinations();
    for on in &all {
        let scene = toggled(on);
        match (plan(&scene, &offer()), plan(&scene, &offer())) {
            (Ok(once), Ok(twice)) => assert_eq!(once.rows, twice.rows, "{on:?}"),
            (once, twice) => assert_eq!(once.map(|_| ()), twice.map(|_| ()), "{on:?}"),
        }
    }
    type Change = fn(&mut EntityWorldMut<'_>);
    let changes: [(&str, Change, Change); 7] = [
        ("a light", add::<PointLight>, take::<PointLight>),
        ("a sphere", add::<(Sphere, Matte)>, take::<(Sphere, Matte)>),
        ("a plane", add::<(Plane, Matte)>, take::<(Plane, Matte)>),
        ("a background", add::<Background>, take::<Background>),
        ("a view", add_view, take::<View>),
        ("statistics", add::<Statistics>, take::<Statistics>),
        ("a camera", add::<OrthographicCamera>, take::<OrthographicCamera>),
    ];
    let mut changed = 0;
    for on in singles_and_pairs().into_iter().filter(|on| !pictureless(on)) {
        let mut scene = toggled(&on);
        let before = plan_of(&scene);
        for (what, add, remove) in &changes {
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

fn add_view(entity: &mut EntityWorldMut<'_>) {
    entity.insert(View { column: "raster".into() });
}

#[test]
fn what_is_disabled_or_unused_is_dropped_by_name() {
    let kinds: [(&str, &[&str]); 4] = [
        ("ball", &["Intersect spheres", "Describe sphere surfaces", "Look for spheres in the way"]),
        ("ground", &["Intersect planes", "Describe plane surfaces", "Look for planes in the way"]),
        ("lamp", &["Aim at lights", "Start with light seen", "Add the light that arrives"]),
        ("sky", &["Add the background"]),
    ];
    let on = [Toggle::Light, Toggle::Plane, Toggle::Sphere, Toggle::Shadow, Toggle::Background];
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
    let mut scene = toggled(&on);
    let second = (Name::new("second camera"), OrthographicCamera::default(), Disabled);
    scene.spawn(second);
    let plan = plan_of(&scene);
    let row_of_second = row(&plan, "Start rays on the rectangle");
    assert!(!row_of_second.kept && row_of_second.reason.contains("\"second camera\", disabled"), "{row_of_second:?}");

    let mut scene = toggled(&[Toggle::Sphere]);
    scene.spawn((Name::new("spare"), Matte::default()));
    let plan = plan_of(&scene);
    let flat = row(&plan, "Show surfaces unlit");
    assert!(flat.kept && flat.count == 1 && !flat.reason.contains("spare"), "{flat:?}");
    let mut scene = toggled(&[Toggle::Light, Toggle::Shadow]);
    scene.spawn((Name::new("spare"), Matte::default()));
    let plan = plan_of(&scene);
    for stage in ["Aim at lights", "Start with light seen", "Add the light that arrives"] {
        let row = row(&plan, stage);
        assert!(!row.kept && row.reason.contains("\"spare\"") && row.reason.contains("unused"), "{row:?}");
    }
    eprintln!("disabled: 5 entities, 11 stages; unused: 1 matte in 2 scenes");
}

fn row<'p>(plan: &'p Plan, stage: &str) -> &'p pinhole::plan::PlanRow {
    plan.rows.iter().find(|row| row.stage == stage).expect("on offer")
}

/// The offer with one stage's say replaced.
fn forced(offer: &[Stage], names: &[&str], needed: bool) -> Vec<Stage> {
    let always: fn(&World) -> Evidence = |_| Evidence::always("forced on");
    let never: fn(&World) -> Evidence = |_| Evidence { reason: "forced off".into(), ..Evidence::default() };
    let mut offer = offer.to_vec();
    for stage in offer.iter_mut().filter(|stage| names.contains(&stage.name)) {
        stage.when = if needed { always } else { never };
    }
    offer
}

#[test]
fn forcing_an_exact_stage_on_changes_nothing() {
    let offer = offer();
    let (mut ran, mut unread, mut without_producer, mut together) = (0, 0, 0, 0);
    let mut tried: BTreeSet<&str> = BTreeSet::new();
    let mut scenes: Vec<(String, World)> = combinations()
        .into_iter()
        .filter(|on| on.len() <= 3 && !pictureless(on))
        .map(|on| (format!("{on:?}"), toggled(&on)))
        .collect();
    for eye in EYES {
        scenes.push((format!("full, {eye:?}"), full(Setup { eye, size: [24, 16], ..Setup::default() })));
    }
    for (name, scene) in &scenes {
        let expected = film(scene);
        let plan = plan_of(scene);
        let exact = |stage: &&Stage| stage.kind == StageKind::Exact && !row(&plan, stage.name).kept;
        let dropped: Vec<&str> = offer.iter().filter(exact).map(|stage| stage.name).collect();
        for &stage in &dropped {
            let offer = forced(&offer, &[stage], true);
            match film_by(scene, &offer, &one_world()) {
                Ok(film) => {
                    film.assert_is(&expected, &format!("{name}: \"{stage}\" forced on"));
                    if row(&pinhole::plan::plan(scene, &offer).expect("plans"), stage).kept {
                        ran += 1;
                        tried.insert(stage);
                    } else {
                        unread += 1;
                    }
                }
                Err(Error::Plan(PlanError::NoProducer { .. })) => without_producer += 1,
                Err(error) => panic!("{name}: \"{stage}\" forced on: {error}"),
            }
        }
        // All at once, so that each also finds the columns that it reads.
        // Light is added even where there is none, so that what only it reads is read.
        let all = [dropped.as_slice(), &["Add the light that arrives"]].concat();
        let offer = forced(&offer, &all, true);
        match film_by(scene, &offer, &one_world()) {
            Ok(film) => {
                film.assert_is(&expected, &format!("{name}: all of {dropped:?} forced on"));
                let plan = pinhole::plan::plan(scene, &offer).expect("plans");
                let kept: Vec<&str> = dropped.iter().copied().filter(|stage| row(&plan, stage).kept).collect();
                together += kept.len();
                tried.extend(kept);
            }
            Err(error) => panic!("{name}: all of {dropped:?} forced on: {error}"),
        }
    }
    let exact: BTreeSet<&str> =
        offer.iter().filter(|stage| stage.kind == StageKind::Exact).map(|stage| stage.name).collect();
    let untried: Vec<&&str> = exact.difference(&tried).collect();
    eprintln!(
        "forced on: {} scenes; alone: {ran} ran, {unread} read by nothing, {without_producer} without a producer; \
         together {together} ran; never dropped: {untried:?}",
        scenes.len()
    );
    assert_eq!(untried, [&"Add to the film", &"Place raster points", &"Start in the dark"], "tried too little");
}

#[test]
fn forcing_a_needed_stage_off_shows() {
    let offer = offer();
    let size = [24, 16];
    let witnesses: Vec<(&str, World)> = vec![
        ("everything", full(Setup { size, ..Setup::default() })),
        ("everything, orthographic", full(Setup { size, eye: Eye::Orthographic, ..Setup::default() })),
        ("unlit", toggled(&[Toggle::Sphere, Toggle::Plane])),
        ("viewed", toggled(&[Toggle::Sphere, Toggle::View])),
    ];
    for stage in &offer {
        let mut powers = Vec::new();
        for (name, scene) in &witnesses {
            if !row(&plan_of(scene), stage.name).kept {
                continue;
            }
            match film_by(scene, &forced(&offer, &[stage.name], false), &one_world()) {
                Ok(film) if film != self::film(scene) => powers.push(format!("changes \"{name}\"")),
                Ok(_) => {}
                Err(Error::Plan(PlanError::NoProducer { stage: reader, column, why })) => {
                    assert!(stage.writes.iter().any(|own| own.name == column), "\"{}\" writes {column}", stage.name);
                    assert!(why.contains(stage.name) && why.contains("forced off"), "{why}");
                    powers.push(format!("\"{reader}\" misses `{column}` in \"{name}\""));
                }
                Err(Error::Plan(PlanError::NoSuchView { asked, why })) => {
                    assert!(why.contains(stage.name) && why.contains("forced off"), "{why}");
                    powers.push(format!("the view misses `{asked}` in \"{name}\""));
                }
                Err(error) => panic!("\"{}\" forced off: {error}", stage.name),
            }
        }
        assert!(!powers.is_empty(), "\"{}\" forced off shows nowhere", stage.name);
        eprintln!("forced off: \"{}\": {}", stage.name, powers[0]);
    }
}

#[test]
fn reasons_name_the_first_three() {
    let mut scene = toggled(&[Toggle::Shadow, Toggle::Background]);
    for number in 1..=4 {
        let at = Placement::at(f64::from(number), 1.0, 0.0);
        scene.spawn((Name::new(format!("ball {number}")), Sphere { radius: 0.25 }, Matte::default(), at));
        scene.spawn((Name::new(format!("pane {number}")), Plane::default(), Matte::default(), at));
        let at = Placement::at(f64::from(number), 3.0, 1.0);
        scene.spawn((Name::new(format!("lamp {number}")), PointLight::default(), at));
    }
    let (balls, panes, lamps) = (three("ball"), three("pane"), three("lamp"));
    let mattes = "\"ball 1\", \"pane 1\", \"ball 2\", …".to_string();
    let expected: [(&str, Vec<&String>); 13] = [
        ("Start with nothing met", vec![&balls, &panes]),
        ("Intersect spheres", vec![&balls]),
        ("Intersect planes", vec![&panes]),
        ("Classify hits", vec![&balls, &panes]),
        ("Describe sphere surfaces", vec![&balls]),
        ("Describe plane surfaces", vec![&panes]),
        ("Aim at lights", vec![&lamps, &mattes]),
        ("Start with light seen", vec![&lamps, &mattes]),
        ("Look for spheres in the way", vec![&balls, &lamps]),
        ("Look for planes in the way", vec![&panes, &lamps]),
        ("Add the light that arrives", vec![&lamps, &mattes]),
        ("Show surfaces unlit", vec![&lamps]),
        ("Aim rays from the eye", vec![]),
    ];
    let plan = plan_of(&scene);
    for (stage, names) in &expected {
        let row = row(&plan, stage);
        for names in names {
            assert!(row.reason.contains(names.as_str()), "\"{stage}\" must name {names}: {}", row.reason);
        }
    }
    assert!(row(&plan, "Aim rays from the eye").reason.contains("\"camera\""));
    assert!(row(&plan, "Add the background").reason.contains("\"sky\""));
    for row in plan.rows.iter().filter(|row| row.count > 0) {
        assert!(row.reason.contains('"'), "\"{}\" counts {} and names none: {}", row.stage, row.count, row.reason);
    }
    eprintln!("reasons: {} stages name their first three of four", expected.len());
}

fn three(noun: &str) -> String {
    format!("\"{noun} 1\", \"{noun} 2\", \"{noun} 3\", …")
}

#[test]
fn a_view_of_an_unknown_word_names_what_is_on_offer() {
    let words = ["", "surfaces", "Surface", "pixel", "nonsense"];
    for word in words {
        let mut scene = toggled(&[Toggle::Sphere]);
        let camera = named(&mut scene, "camera");
        scene.entity_mut(camera).insert(View { column: word.into() });
        let error = plan(&scene, &offer()).expect_err("no such column");
        let PlanError::NoSuchView { asked, why } = &error else { panic!("{error}") };
        assert_eq!(asked, word);
        for name in view_names(&offer()) {
            assert!(why.contains(name), "`{word}`: {why} must name `{name}`");
        }
        assert_eq!(error.to_string(), format!("the view asks for the column `{word}`, but {why}"));
    }
    eprintln!("views: {} unknown words, each answered with {:?}", words.len(), view_names(&offer()));
}

/// A view runs fewer stages than the picture does, but those that run write the very same numbers.
#[test]
fn a_view_paints_the_columns_of_the_whole_picture() {
    let mut compared = 0;
    for eye in EYES {
        let setup = Setup { eye, size: [40, 33], ..Setup::default() };
        let whole = inspect(&full(setup), &offer(), 32).expect("inspects");
        for column in &whole.plan.columns {
            if column.name == "pixel" || column.name == "radiance" {
                continue;
            }
            let mut scene = full(setup);
            let camera = named(&mut scene, "camera");
            scene.entity_mut(camera).insert(View { column: column.name.into() });
            let viewed = film(&scene);
            let tiles: Vec<FilmTile> =
                whole.tiles.iter().map(|&tile| painted(&whole.world.entity(tile), column, whole.image)).collect();
            let expected = FilmBits::of_tiles(whole.image.width, whole.image.height, tiles.iter());
            viewed.assert_is(&expected, &format!("{eye:?}, view of {}", column.name));
            // An orthographic camera's rays all have one direction.
            let uniform = eye == Eye::Orthographic && matches!(column.name, "camera" | "world");
            assert_eq!(viewed.colours() == 1, uniform, "{eye:?}: the view of {} shows nothing", column.name);
            compared += 1;
        }
    }
    assert_eq!(compared, 2 * (view_names(&offer()).len() - 1), "every column but radiance, which is the picture");
    eprintln!("views: {compared} views, each equal to its column of the whole picture");
}

/// What a view of a column must show: a pixel's first row, black without one.
fn painted(tile: &EntityRef<'_>, column: &ColumnKind, image: ImageShape) -> FilmTile {
    let mut film = FilmTile::new(*tile.get::<Tile>().expect("a tile"));
    let rows = (column.rows)(tile);
    let lanes = (column.lanes)(tile);
    let paths = lanes.iter().find(|lane| lane.name == "path" || lane.name == "row").map(|lane| lane.values);
    for path in 0..film.count.len() {
        let first = match paths {
            Some(LaneValues::U32(paths)) => paths.iter().position(|&own| own as usize == path),
            _ => (path < rows).then_some(path),
        };
        let paint = |row| (column.paint)(tile, row, [image.width, image.height]);
        film.add(path, first.map_or([0.0; 3], paint));
    }
    film
}
