//! Stages forced on that a scene does not need, and off that it does.

use super::*;
use pinhole::film::{FilmLayers, FilmMoments};
use pinhole::plan::Census;
use pinhole::render::render;
use pinhole::shade::join_point_stage;
use scenes::followed::{INTEGRATORS, followed};

/// The offer with one stage's say replaced.
fn forced(offer: &[Stage], names: &[&str], needed: bool) -> Vec<Stage> {
    let always: fn(&Census<'_>) -> Evidence = |_| Evidence::always("forced on");
    let never: fn(&Census<'_>) -> Evidence = |_| Evidence { reason: "forced off".into(), ..Evidence::default() };
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
    let mut scenes: Vec<(String, World, bool)> = singles_and_pairs()
        .into_iter()
        .filter(|on| !pictureless(on))
        .map(|on| (format!("{on:?}"), toggled(&on), on.len() < 2))
        .collect();
    for eye in EYES {
        scenes.push((
            format!("shapes, {eye:?}"),
            shapes_of_all_kinds(Setup { eye, size: [24, 16], ..Setup::default() }),
            true,
        ));
        scenes.push((
            format!("stretched, {eye:?}"),
            stretched(Setup { eye, size: [24, 16], ..Setup::default() }),
            true,
        ));
        scenes.push((format!("textured, {eye:?}"), textured(Setup { eye, size: [24, 16], ..Setup::default() }), true));
        scenes.push((format!("shining, {eye:?}"), shining(Setup { eye, size: [24, 16], ..Setup::default() }), true));
        scenes.push((format!("soft, {eye:?}"), soft(Setup { eye, size: [24, 16], ..Setup::default() }), true));
        scenes.push((format!("full, {eye:?}"), full(Setup { eye, size: [24, 16], ..Setup::default() }), true));
    }
    for (name, scene, alone) in &scenes {
        let expected = film(scene);
        let plan = plan_of(scene);
        let exact = |stage: &&Stage| stage.kind == StageKind::Exact && !row(&plan, stage.name).kept;
        let dropped: Vec<&str> = offer.iter().filter(exact).map(|stage| stage.name).collect();
        // All pairs are forced together below, which finds all that one by one would.
        for &stage in dropped.iter().filter(|_| *alone) {
            let offer = forced(&offer, &[stage], true);
            match pinhole::plan::plan(&Census::of(scene), &offer) {
                Ok(found) if !row(&found, stage).kept => {
                    assert_eq!(found.columns, plan.columns, "{name}: \"{stage}\" forced on, and read by nothing");
                    unread += 1;
                }
                Ok(_) => {
                    let film = film_by(scene, &offer, &one_world()).expect("renders");
                    film.assert_is(&expected, &format!("{name}: \"{stage}\" forced on"));
                    ran += 1;
                    tried.insert(stage);
                }
                Err(PlanError::NoProducer { .. }) => without_producer += 1,
                Err(error) => panic!("{name}: \"{stage}\" forced on: {error}"),
            }
        }
        // All at once, so that each also finds the columns that it reads.
        // Light is added even where there is none, so that what only it reads is read.
        let all = [dropped.as_slice(), &["Evaluate direct light: matte"]].concat();
        let offer = forced(&offer, &all, true);
        match film_by(scene, &offer, &one_world()) {
            Ok(film) => {
                film.assert_is(&expected, &format!("{name}: all of {dropped:?} forced on"));
                let plan = pinhole::plan::plan(&Census::of(scene), &offer).expect("plans");
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
    // Two are needed by every picture; media, wavelengths and the surfaces that rays leave are carried where a scene needs
    // them, or read by nothing; the rows of glass are read by alternatives only, and counts of tests by views.
    let never = [
        "Accumulate film",
        "Carry wavelengths to the next bounce",
        "Clear radiance",
        "Clear the surfaces that rays left",
        "Count tests",
        "Keep the surfaces that rays leave",
        "List rows: glass",
        "List rows: thin glass",
    ];
    assert_eq!(untried, never.each_ref(), "tried too little");
}

/// What a film keeps beside its light.
fn beside(scene: &World, offer: &[Stage]) -> (Vec<FilmLayers>, Vec<FilmMoments>) {
    let film = render(scene, offer, &one_world(), &()).expect("renders").film;
    (film.layers, film.moments)
}

/// A scene with a view of this column.
fn viewed(column: &str) -> World {
    let mut scene = toggled(&[Toggle::Sphere, Toggle::View]);
    let camera = named(&mut scene, "camera");
    scene.entity_mut(camera).insert(View { column: column.into() });
    scene
}

/// Paths among things in motion, over a pattern that pixels cover several cells of.
fn paths_in_motion(setup: Setup) -> World {
    let mut scene = followed(INTEGRATORS[6], setup);
    let [camera, ball, floor] = ["camera", "matte ball", "floor"].map(|name| named(&mut scene, name));
    scene.entity_mut(camera).insert(Shutter::default());
    scene.entity_mut(ball).insert(Motion { velocity: DVec3::new(0.5, 0.25, 0.0) });
    scene.entity_mut(floor).insert(Checker { size: 0.1, ..Checker::default() });
    scene
}

/// In one set stages run in the order in which they are offered, so what one of them writes is not there for those before.
#[test]
fn what_is_written_in_the_same_set_is_not_read_there() {
    let scene = through_a_lens();
    let mut offer = offer();
    offer.retain(|stage| !stage.is(join_point_stage));
    offer.push(Stage { set: TileSystems::SampleLights, ..join_point_stage() });
    let error = pinhole::plan::plan(&Census::of(&scene), &offer).expect_err("refused").to_string();
    eprintln!("{error}");
    let words =
        ["\"Connect to the camera\"", "`join`", "\"Sample the lens for connections\"", "afterwards", "earlier set"];
    assert!(words.iter().all(|word| error.contains(word)), "{error}");
}

/// Caustics from the lamps, seen out of focus.
fn through_a_lens() -> World {
    let mut world = scenes::caustics::traced(|| scenes::caustics::caustics(true))();
    let camera = scenes::named(&mut world, "camera");
    world.entity_mut(camera).insert(Lens { focus_distance: 1.0, ..Lens::default() });
    world
}

fn under_an_evening() -> World {
    let mut world = scenes::caustics::traced(|| scenes::caustics::caustics(true))();
    let file = "chapters/16_textures/evening.hdr".into();
    world.spawn(pinhole::scene::Environment { file, ..Default::default() });
    world
}

/// Light traced onto rough glass and a principled material.
fn on_frosted_glass() -> World {
    let mut world = scenes::caustics::traced(|| scenes::caustics::caustics(true))();
    let frosted = RoughGlass { roughness: 0.3, ..RoughGlass::default() };
    world.spawn((Name::new("frosted ball"), Sphere { radius: 0.35 }, Placement::at(0.3, 0.45, 1.5), frosted));
    let bubble = (Sphere { radius: 0.4 }, Placement::at(-0.7, 0.5, 0.9), ThinGlass::default());
    world.spawn((Name::new("bubble"), bubble));
    world.spawn((Name::new("pebble"), Sphere { radius: 0.3 }, Placement::at(-1.5, 0.35, 1.4), Principled::default()));
    world
}

/// A lit ball with a normal map of one texel, which leans.
fn bumps() -> World {
    const MAP: &[u8] = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\xc0\x80\xc0\x80";
    let mut world = toggled(&[Toggle::Sphere, Toggle::Light]);
    let ball = named(&mut world, "ball");
    world.entity_mut(ball).insert(NormalMap { file: "map.hdr".into(), ..NormalMap::default() });
    world.insert_resource(EmbeddedFiles(&[("map.hdr", MAP)]));
    world
}

/// A lit ball that shines, with maps of one texel.
fn maps() -> World {
    const MAP: &[u8] = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x40\x80\xc0\x80";
    let mut world = toggled(&[Toggle::Sphere, Toggle::Light]);
    let ball = named(&mut world, "ball");
    let map = MetallicRoughnessMap { file: "map.hdr".into(), ..MetallicRoughnessMap::default() };
    let emission = EmissionMap { file: "map.hdr".into(), ..EmissionMap::default() };
    world.entity_mut(ball).remove::<Matte>().insert((Principled::default(), map, Emissive::default(), emission));
    world.insert_resource(EmbeddedFiles(&[("map.hdr", MAP)]));
    world
}

fn rasterised(mut world: World) -> World {
    let camera = pinhole::extract::camera_entity(&world).expect("a camera");
    world.entity_mut(camera).insert(Rasterisation);
    world
}

/// An octahedron whose vertices have normals, and its shadow.
/// Films of glass on a floor and above it, too thin for single precision to keep their sides apart.
fn films() -> World {
    let mut world = toggled(&[Toggle::Light, Toggle::Shadow, Toggle::Plane, Toggle::Background]);
    let camera = named(&mut world, "camera");
    world.entity_mut(camera).insert(Integrator::PATH);
    for (number, height) in [0.0, 0.7].into_iter().enumerate() {
        let thin = 6e-7;
        let film = Cuboid { size: DVec3::new(1.6, thin, 1.2) };
        let at = Placement::at(number as f64 - 0.5, height + 0.5 * thin, 0.4);
        world.spawn((film, at, Glass { priority: number as u32, ..Glass::default() }));
    }
    world
}

/// A block of frosted glass on another with a lamp in it, nearer than single precision keeps apart.
fn frosted_blocks() -> World {
    let mut world = toggled(&[Toggle::Light, Toggle::Shadow, Toggle::Plane]);
    let (camera, lamp) = (named(&mut world, "camera"), named(&mut world, "lamp"));
    let sampling = Sampling { samples: 16, ..Sampling::default() };
    world.entity_mut(camera).insert((Integrator::PATH, sampling));
    world.entity_mut(lamp).insert(Placement::at(0.0, 0.5, 0.4));
    for (middle, ior) in [(0.5, 1.8), (0.9 + 1.5e-6, 1.5)] {
        let block = (Cuboid { size: DVec3::new(1.2, 0.4, 1.2) }, Placement::at(0.0, middle, 0.4));
        world.spawn((block, RoughGlass { ior, roughness: 0.4, ..RoughGlass::default() }));
    }
    world
}

/// The eye on the surface of the sea over a floor, and a lamp a hair above it.
fn on_the_sea() -> World {
    let mut world = toggled(&[Toggle::Light, Toggle::Shadow, Toggle::Plane]);
    let (camera, lamp) = (named(&mut world, "camera"), named(&mut world, "lamp"));
    let look = LookAt { eye: DVec3::new(0.0, 1.5, 2.0), target: DVec3::ZERO, ..LookAt::default() };
    world.entity_mut(camera).insert((look, Integrator::PATH));
    let glass = Glass { absorption: Rgb::grey(0.3), ..Glass::default() };
    world.spawn((Plane::default(), Placement::at(0.0, 1.5, 0.0), glass));
    world.entity_mut(lamp).insert(Placement::at(0.0, 1.5 + 1e-7, 0.4));
    world
}

/// Caustics that photons find, on every kind of material.
fn by_photons() -> World {
    let mut world = scenes::caustics::caustics(true);
    for number in 0..4 {
        let place = Placement::at(-1.0 + 0.45 * f64::from(number), 0.04, 0.4);
        let mut tile = world.spawn((Cuboid { size: DVec3::new(0.4, 0.06, 0.8) }, place));
        match number {
            0 => tile.insert(Phong::default()),
            1 => tile.insert(BlinnPhong::default()),
            2 => tile.insert(Principled::default()),
            _ => tile.insert(RoughGlass::default()),
        };
    }
    let camera = named(&mut world, "camera");
    world.entity_mut(camera).insert(PhotonMapping { radius: 0.1, ..PhotonMapping::default() });
    world
}

/// A ball whose index depends on the wavelength, over a lit floor.
fn a_diamond() -> World {
    let mut world = toggled(&[Toggle::Light, Toggle::Shadow, Toggle::Plane, Toggle::Background]);
    let camera = named(&mut world, "camera");
    world.entity_mut(camera).insert(Integrator::PATH);
    world.spawn((Sphere { radius: 0.8 }, Placement::at(0.0, 0.9, 0.4), Glass::default(), Dispersion::Diamond));
    world
}

/// Every kind of material that is not specular around a lamp, by paths that are joined; and a ball of glass.
fn by_joined_paths() -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.0, 4.0, 3.0), target: DVec3::ZERO, ..LookAt::default() };
    let camera = (PerspectiveCamera::default(), Resolution { width: 24, height: 24 }, Integrator::PATH);
    world.spawn((Name::new("camera"), look, camera, BidirectionalPathTracing::default()));
    let lamp = Emissive { radiance: Rgb::grey(20.0), ..Emissive::default() };
    world.spawn((Sphere { radius: 0.3 }, lamp, Placement::at(0.0, 1.2, 0.0)));
    world.spawn((Sphere { radius: 0.4 }, Glass::default(), Placement::at(0.0, 0.45, 0.9)));
    for number in 0..6 {
        let (x, z) = (2.0 * f64::from(number % 3) - 2.0, 2.0 * f64::from(number / 3) - 1.0);
        let mut tile = world.spawn((Cuboid { size: DVec3::new(1.9, 0.2, 1.9) }, Placement::at(x, -0.1, z)));
        match number {
            0 => tile.insert(Phong::default()),
            1 => tile.insert(BlinnPhong::default()),
            2 => tile.insert(Principled::default()),
            3 => tile.insert(RoughGlass { roughness: 0.5, ..RoughGlass::default() }),
            4 => tile.insert(Metal { roughness: 0.4, ..Metal::default() }),
            _ => tile.insert(Matte::default()),
        };
    }
    world.spawn((Rectangle { width: 6.0, depth: 3.0 }, Placement::at(0.0, 2.5, -1.0), Matte::default()));
    world
}

/// A ball that is half there, over a floor and its shadow.
fn half_there() -> World {
    let mut world = toggled(&[Toggle::Sphere, Toggle::Light, Toggle::Shadow, Toggle::Plane]);
    let ball = named(&mut world, "ball");
    world.entity_mut(ball).insert(Opacity { opacity: 0.5, ..Opacity::default() });
    world
}

/// A lamp, a floor and the camera within ink.
fn in_ink() -> World {
    let mut world = toggled(&[Toggle::Light, Toggle::Shadow, Toggle::Plane]);
    let camera = named(&mut world, "camera");
    world.entity_mut(camera).insert(Integrator::PATH);
    let ink = Glass { ior: 1.0, absorption: Rgb::grey(0.1), ..Glass::default() };
    world.spawn((Cuboid { size: DVec3::splat(40.0) }, ink));
    world
}

fn a_mesh() -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.0, 3.0, 6.0), target: DVec3::ZERO, ..LookAt::default() };
    world.spawn((PerspectiveCamera::default(), look, Resolution { width: 24, height: 16 }));
    let mut octahedron = (*MeshGeometry::default()).clone();
    octahedron.normals = Some(octahedron.positions.clone());
    let mesh = MeshInstance { geometry: MeshGeometry::new(octahedron) };
    world.spawn((mesh, Placement::at(0.0, 1.5, 0.0), Matte::default()));
    world.spawn((Plane::default(), Matte::default()));
    world.spawn((PointLight { intensity: Rgb::grey(60.0), ..PointLight::default() }, Placement::at(1.0, 5.0, 0.0)));
    world
}

/// The same mesh, in the colours of its vertices.
fn a_tinted_mesh() -> World {
    let mut world = a_mesh();
    let mesh = world.query_filtered::<Entity, With<MeshInstance>>().single(&world).expect("one mesh");
    let mut octahedron = (*world.get::<MeshInstance>(mesh).expect("its geometry").geometry).clone();
    octahedron.colours = Some(octahedron.positions.iter().map(|at| at.map(f32::abs)).collect());
    let geometry = MeshGeometry::new(octahedron);
    world.entity_mut(mesh).insert((MeshInstance { geometry }, Tint { factor: Rgb::grey(1.0), by_vertex: true }));
    world
}

/// A lamp in a glowing cloud.
fn in_a_cloud() -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.0, 0.5, 5.0), target: DVec3::ZERO, ..LookAt::default() };
    world.spawn((PerspectiveCamera::default(), look, Resolution { width: 24, height: 16 }, Integrator::PATH));
    let cloud = Medium { scattering: Rgb::grey(1.0), emission: Rgb::grey(0.1), ..Medium::default() };
    world.spawn((Sphere { radius: 1.5 }, cloud));
    let lamp = Emissive { radiance: Rgb::grey(5.0), ..Emissive::default() };
    world.spawn((Sphere { radius: 0.5 }, lamp, Placement::at(0.0, 1.0, 0.0)));
    world
}

/// The same, with paths from the lamp.
fn joined_in_a_cloud() -> World {
    let mut world = in_a_cloud();
    let mut cameras = world.query_filtered::<Entity, With<PerspectiveCamera>>();
    let camera = cameras.single(&world).expect("a camera");
    world.entity_mut(camera).insert(BidirectionalPathTracing::default());
    world
}

/// A glass ball throws the light of a sun, which comes through a cloud, on the ground.
fn sun_through_a_cloud() -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.0, 2.0, 5.0), target: DVec3::ZERO, ..LookAt::default() };
    let size = Resolution { width: 24, height: 16 };
    world.spawn((PerspectiveCamera::default(), look, size, Integrator::PATH, LightTracing::default()));
    world.spawn((Rectangle { width: 6.0, depth: 6.0 }, Matte::default()));
    world.spawn((Sphere { radius: 0.7 }, Glass::default(), Placement::at(0.0, 0.9, 0.0)));
    let cloud = Medium { absorption: Rgb::grey(0.5), ..Medium::default() };
    world.spawn((Sphere::default(), cloud, Placement::at(0.0, 9.0, 0.0)));
    world.spawn((DirectionalLight::default(), LookAt { eye: DVec3::Y, target: DVec3::ZERO, up: DVec3::X }));
    world
}

#[test]
fn forcing_a_needed_stage_off_shows() {
    let two_bounces = Integrator::Path { max_depth: 2, lights: LightStrategy::Mis, roulette: 0 };
    let offer = offer();
    let size = [24, 16];
    let witnesses: Vec<(&str, World)> = vec![
        // First those whose paths end by themselves where no roulette ends them.
        ("paths", followed(INTEGRATORS[6], Setup { size, ..Setup::default() })),
        ("paths in motion", paths_in_motion(Setup { size, ..Setup::default() })),
        ("paths of two segments", followed(two_bounces, Setup { size, ..Setup::default() })),
        ("everything", full(Setup { size, ..Setup::default() })),
        ("everything, orthographic", full(Setup { size, eye: Eye::Orthographic, ..Setup::default() })),
        ("shapes", shapes_of_all_kinds(Setup { size, ..Setup::default() })),
        ("stretched", stretched(Setup { size, ..Setup::default() })),
        ("textured", textured(Setup { size, ..Setup::default() })),
        ("textured, orthographic", textured(Setup { size, eye: Eye::Orthographic, ..Setup::default() })),
        ("shining", shining(Setup { size, ..Setup::default() })),
        ("soft", soft(Setup { size, ..Setup::default() })),
        ("unlit", toggled(&[Toggle::Sphere, Toggle::Plane])),
        ("viewed", toggled(&[Toggle::Sphere, Toggle::View])),
        ("layers", toggled(&[Toggle::Sphere, Toggle::Layers])),
        ("a view of tests", viewed("tests")),
        ("everything, larger", full(Setup { size: [80, 60], ..Setup::default() })),
        ("samples", toggled(&[Toggle::Sphere, Toggle::Samples])),
        ("a fisheye", scenes::fisheye(Setup { size, ..Setup::default() })),
        ("all round", scenes::all_round(Setup { size, ..Setup::default() })),
        ("specular", scenes::material::specular(Setup { size, ..Setup::default() })),
        ("brushed", scenes::material::brushed(Setup { size, ..Setup::default() })),
        ("in motion", scenes::moving(Setup { size, ..Setup::default() })),
        ("a lens", toggled(&[Toggle::Sphere, Toggle::Plane, Toggle::Lens])),
        ("paths, BSDF sampling", followed(INTEGRATORS[4], Setup { size, ..Setup::default() })),
        ("Whitted's rays", followed(Integrator::WHITTED, Setup { size, ..Setup::default() })),
        ("light from lamps", scenes::caustics::traced(|| scenes::caustics::caustics(true))()),
        ("photons", by_photons()),
        ("joined paths", by_joined_paths()),
        ("light from lamps through a lens", through_a_lens()),
        ("light from an environment", under_an_evening()),
        ("light from lamps on frosted glass", on_frosted_glass()),
        ("bumps", bumps()),
        ("maps", maps()),
        ("a mesh", a_mesh()),
        ("a tinted mesh", a_tinted_mesh()),
        ("a rasterised mesh", rasterised(a_mesh())),
        ("rasterised shapes", rasterised(shapes_of_all_kinds(Setup { size, ..Setup::default() }))),
        ("rasterised ellipsoids", rasterised(stretched(Setup { size, ..Setup::default() }))),
        ("rasterised spheres", rasterised(shining(Setup { size, ..Setup::default() }))),
        ("many lights", scenes::many::many_lights(Setup { size, ..Setup::default() })),
        ("films", films()),
        ("a ball that is half there", half_there()),
        ("a lamp in ink", in_ink()),
        ("frosted blocks", frosted_blocks()),
        ("an eye and a lamp on the sea", on_the_sea()),
        ("a diamond", a_diamond()),
        ("a lamp in a cloud", in_a_cloud()),
        ("a lamp in a cloud from both ends", joined_in_a_cloud()),
        ("a sun through a cloud", sun_through_a_cloud()),
        ("the sky", followed(INTEGRATORS[2], Setup { size, ..Setup::default() })),
    ];
    let witnesses: Vec<_> = witnesses.into_iter().map(|(name, scene)| (name, plan_of(&scene), scene)).collect();
    let mut films: BTreeMap<&str, FilmBits> = BTreeMap::new();
    for stage in &offer {
        let power = witnesses.iter().find_map(|(name, plan, scene)| {
            if !row(plan, stage.name).kept {
                return None;
            }
            match film_by(scene, &forced(&offer, &[stage.name], false), &one_world()) {
                Ok(film) if film != *films.entry(name).or_insert_with(|| self::film(scene)) => {
                    Some(format!("changes \"{name}\""))
                }
                Ok(_) => (beside(scene, &forced(&offer, &[stage.name], false)) != beside(scene, &offer))
                    .then(|| format!("changes what \"{name}\" keeps beside its light")),
                Err(Error::Plan(PlanError::NoProducer { stage: reader, column, why })) => {
                    assert!(stage.writes.iter().any(|own| own.name == column), "\"{}\" writes {column}", stage.name);
                    assert!(why.contains(stage.name) && why.contains("forced off"), "{why}");
                    Some(format!("\"{reader}\" misses `{column}` in \"{name}\""))
                }
                Err(Error::Plan(PlanError::WrittenAfterwards { stage: reader, column, writer })) => {
                    assert!(stage.writes.iter().any(|own| own.name == column), "\"{}\" writes {column}", stage.name);
                    Some(format!("\"{reader}\" finds `{column}` only after \"{writer}\" in \"{name}\""))
                }
                Err(Error::Plan(PlanError::NoSuchView { wanted, why })) => {
                    assert!(why.contains(stage.name) && why.contains("forced off"), "{why}");
                    Some(format!("the view misses `{wanted}` in \"{name}\""))
                }
                Err(error) => panic!("\"{}\" forced off: {error}", stage.name),
            }
        });
        let power = power.unwrap_or_else(|| panic!("\"{}\" forced off shows nowhere", stage.name));
        eprintln!("forced off: \"{}\": {power}", stage.name);
    }
}
