//! What is said before a picture is rendered: of everything that goes wrong, and nothing where nothing does.

use super::*;
use glam::DVec3;
use pinhole::Error;
use pinhole::extract::{camera_entity, emissive_evidence};
use pinhole::look::{MISTAKES, Preflight, preflight};
use pinhole::plan::{Census, Stage, TileSystems};
use pinhole::render::prepare;
use pinhole::scene::*;
use pinhole::{Chapter, Overrides, stages};

/// What is said of a scene for which every stage is on offer, or the refusal.
fn said(scene: &World) -> Result<Vec<String>, Error> {
    let census = &Census::of(scene);
    let (plan, tables) = prepare(census, &offer())?;
    preflight(census, (&plan, &tables), Preflight { threads: Some(1), ends_in_time: true, ..unhurried() })
}

#[test]
fn mistakes_are_reported_before_the_picture_is_rendered() {
    let expected: &[(&str, &[&[&str]])] = &[
        ("nothing wrong", &[]),
        ("no light, by path tracing", &[&["probably be black", "there is no light"]]),
        ("a light behind the wall", &[&["probably be black", "faces away from every light", "\"lamp\""]]),
        ("a light inside the ball", &[&["probably be black", "shadow rays are blocked", "sphere \"ball\""]]),
        (
            "the camera inside the ball",
            &[&["probably be black"], &["inside the sphere \"ball\" and sees it from within"]],
        ),
        ("the camera inside a block of tinted glass", &[&["inside the cuboid \"block\" and sees it from within"]]),
        ("the camera looks the other way", &[&["probably be black", "rays hits a shape", "no background"]]),
        ("the same in front of a blue sky", &[&["none of", "test rays", "hits a shape"]]),
        ("a light a hundred times too bright", &[&["% of the test rays", "more than white", "EXR"]]),
        (
            "a small area light found by BSDF sampling alone",
            &[&["probably be black", "0 of 6144 rays", "at random", "Mis"]],
        ),
        ("a mirror, by ray casting", &[&["renders mirrors and glass black", "\"mirror\"", "Integrator::Whitted"]]),
        (
            "an area light, by Whitted's method",
            &[
                &["probably be black", "illuminate nothing", "\"panel\""],
                &["do not illuminate others", "\"panel\"", "Integrator::Path"],
            ],
        ),
        ("a focus distance of 0", &[&["refused", "camera \"camera\": focus_distance is 0,"]]),
    ];
    assert_eq!(
        MISTAKES.iter().map(|mistake| mistake.what).collect::<Vec<_>>(),
        expected.iter().map(|e| e.0).collect::<Vec<_>>()
    );
    let mut failures = Vec::new();
    for (mistake, (_, sentences)) in MISTAKES.iter().zip(expected) {
        let mut world = World::new();
        (mistake.scene)(&mut world);
        let told = said(&world).unwrap_or_else(|error| vec![format!("refused: {error}")]);
        eprintln!("{}: {told:#?}", mistake.what);
        let holds = |(sentence, words): (&String, &&[&str])| words.iter().all(|word| sentence.contains(word));
        if told.len() != sentences.len() || !told.iter().zip(*sentences).all(holds) {
            failures.push((mistake.what, told));
        }
        for sentence in failures.last().map_or(&[][..], |(_, told)| told) {
            assert!(!sentence.contains('\n') && !sentence.ends_with('.'), "{sentence}");
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

/// The camera at a point, and a shape about it, of radius or half side 1.
fn inside(spawn: &dyn Fn(&mut World) -> Entity, eye: DVec3) -> Vec<String> {
    let mut world = World::new();
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera::default(),
        Placement { position: eye, ..Placement::default() },
    ));
    world.spawn((Name::new("lamp"), PointLight::default(), Placement::at(0.2, 0.3, 0.1)));
    let shape = spawn(&mut world);
    world.entity_mut(shape).insert((Name::new("shape"), Matte::default()));
    said(&world).expect("said").into_iter().filter(|sentence| sentence.contains("inside the")).collect()
}

#[test]
fn a_camera_inside_a_shape_is_told() {
    let stretched = |x: f64| Placement { scale: DVec3::new(x, 1.0, 1.0), ..Placement::default() };
    let shapes: [(&str, &dyn Fn(&mut World) -> Entity); 3] = [
        ("sphere", &|world| world.spawn(Sphere { radius: 1.0 }).id()),
        ("cuboid", &|world| world.spawn(Cuboid { size: DVec3::splat(2.0) }).id()),
        ("ellipsoid", &|world| world.spawn((Sphere { radius: 1.0 }, stretched(3.0))).id()),
    ];
    let mut tried = 0;
    for (kind, spawn) in shapes {
        for (eye, within) in [
            (DVec3::new(0.0, 0.0, 0.9), true),
            (DVec3::new(0.0, 0.0, 1.1), false),
            (DVec3::new(1.1, 0.0, 0.0), kind == "ellipsoid"),
            (DVec3::new(0.9, 0.9, 0.9), kind == "cuboid"),
        ] {
            let told = inside(spawn, eye);
            assert_eq!(!told.is_empty(), within, "{kind} from {eye}: {told:?}");
            tried += 1;
        }
    }
    // Triangles that close; and with one of them taken away.
    for (eye, open, within) in [(0.0, false, true), (0.9, false, true), (1.1, false, false), (0.0, true, false)] {
        let mut world = World::new();
        world.spawn((Name::new("camera"), PerspectiveCamera::default(), Placement::at(0.0, 0.0, eye)));
        world.spawn((Name::new("lamp"), PointLight::default(), Placement::at(0.2, 0.3, 0.1)));
        numerics::ball_of_triangles(&mut world, 2);
        if open {
            let face = world.query_filtered::<Entity, With<Triangle>>().iter(&world).next().expect("a face");
            world.despawn(face);
        }
        let told = said(&world).expect("said");
        assert_eq!(told.iter().any(|sentence| sentence.contains("inside the triangle")), within, "{eye}: {told:?}");
        tried += 1;
    }
    eprintln!("cameras: {tried} places about 4 kinds of shapes");
}

/// Under a white sky all is white, but for a camera in glass brighter: that is no fault of the light, and is not called one.
#[test]
fn what_is_brighter_in_glass_is_not_blamed_on_the_lights() {
    let told = |eye: f64, spawn: &dyn Fn(&mut World)| {
        let mut world = World::new();
        let look = LookAt { eye: DVec3::new(0.0, 1.0, eye), target: DVec3::Y, ..LookAt::default() };
        world.spawn((Name::new("camera"), PerspectiveCamera::default(), look, Integrator::PATH));
        world.spawn(Background { colour: Rgb::grey(1.0) });
        spawn(&mut world);
        let told = said(&world).expect("said");
        told.into_iter().find(|sentence| sentence.contains("more than white")).unwrap_or_default()
    };
    let ball = |ior: f64, priority: u32, radius: f64| {
        move |world: &mut World| {
            let glass = Glass { ior, priority, ..Glass::default() };
            world.spawn((Sphere { radius }, Placement::at(0.0, 1.0, 0.0), glass));
        }
    };
    let inside = told(0.5, &ball(1.5, 0, 1.0));
    assert!(inside.contains("index of refraction is 1.5, where radiance is 2.250 times that outside"), "{inside}");
    assert!(!inside.contains("dimmer lights"), "{inside}");
    assert_eq!(told(6.0, &ball(1.5, 0, 1.0)), "");
    // A bubble of air, which displaces the glass, and a denser glass in a thinner one.
    let nested = |ior: f64| {
        move |world: &mut World| {
            ball(1.5, 0, 2.0)(world);
            ball(ior, 1, 1.0)(world);
        }
    };
    assert_eq!(told(0.5, &nested(1.0)), "");
    assert!(told(0.5, &nested(2.0)).contains("radiance is 4.000 times"), "{}", told(0.5, &nested(2.0)));
    let lamps = |world: &mut World| {
        world.spawn((Plane::default(), Matte { colour: Rgb::grey(0.9) }));
        world.spawn((PointLight { intensity: Rgb::grey(1e4), ..PointLight::default() }, Placement::at(0.0, 2.0, 0.0)));
    };
    assert!(told(6.0, &lamps).contains("dimmer lights or fewer stops"), "{}", told(6.0, &lamps));
}

/// A one-sided lamp that shines upward over the floor lights nothing that is seen.
#[test]
fn a_lamp_that_shines_the_other_way_is_told() {
    let scene = |turned: bool| {
        let mut world = World::new();
        let look = LookAt { eye: DVec3::new(0.0, 3.0, 4.0), target: DVec3::ZERO, ..LookAt::default() };
        world.spawn((Name::new("camera"), PerspectiveCamera { fov: Degrees(30.0), ..Default::default() }, look));
        world.spawn((Plane::default(), Matte::default()));
        let orientation = if turned { DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0) } else { DQuat::IDENTITY };
        let place = Placement { orientation, ..Placement::at(0.0, 6.0, 0.0) };
        let lamp = Emissive { radiance: Rgb::grey(5.0), sides: Sides::Front };
        world.spawn((Name::new("panel"), Rectangle { width: 2.0, depth: 2.0 }, place, lamp));
        said(&world).expect("said")
    };
    let told = scene(false);
    assert!(told.len() == 1 && told[0].contains("is not in any light's beam") && told[0].contains("panel"), "{told:?}");
    assert!(scene(true).is_empty(), "{:?}", scene(true));
}

/// Every chapter's own scene, with its own stages: nothing is said that is not so.
///
/// Four have mirrors or glass beside a light that no sampled ray can hit, and of them that is said, once; the book says so.
#[test]
fn nothing_is_said_of_the_chapters_scenes() {
    let mut said = Vec::new();
    let chapters = chapters::all();
    for chapter in &chapters {
        let asked = Overrides { resolution: Some(Resolution { width: 96, height: 54 }), ..Overrides::default() };
        let scene = chapter.world(&asked);
        let census = &Census::of(&scene);
        let (plan, tables) = prepare(census, &chapter.stages()).expect("prepared");
        let asked = Preflight { threads: Some(1), ends_in_time: true, ..unhurried() };
        let mut told = preflight(census, (&plan, &tables), asked).expect("said");
        let before = told.len();
        told.retain(|sentence| !sentence.contains("mirrors or glass"));
        let is_so = ["19_mirrors", "20_glass", "32_projection", "34_both"].contains(&chapter.name);
        assert_eq!(before - told.len(), usize::from(is_so), "{}", chapter.name);
        said.extend(told.into_iter().map(|sentence| format!("{}: {sentence}", chapter.name)));
    }
    eprintln!("{} chapters: {said:#?}", chapters.len());
    assert!(said.is_empty(), "{said:#?}");
}

/// A chapter that has not come to following light refuses what would be black in its picture.
#[test]
fn a_material_that_no_stage_samples_is_refused() {
    let scene = |spawn: &dyn Fn(&mut World) -> Entity| {
        let mut world = World::new();
        world.spawn((Name::new("camera"), PerspectiveCamera::default(), Placement::at(0.0, 0.0, 5.0)));
        world.spawn((Name::new("lamp"), PointLight::default(), Placement::at(3.0, 3.0, 3.0)));
        let shape = spawn(&mut world);
        world.entity_mut(shape).insert((Name::new("ball"), Sphere { radius: 1.0 }));
        world
    };
    let material: [(&str, &dyn Fn(&mut World) -> Entity); 4] = [
        ("mirror", &|world| world.spawn(Mirror::default()).id()),
        ("glass", &|world| world.spawn(Glass::default()).id()),
        ("metal", &|world| world.spawn(Metal::default()).id()),
        ("mirror", &|world| {
            let silver = world.spawn(Mirror::default()).id();
            world.spawn(UsesMaterial(silver)).id()
        }),
    ];
    let chapter = |followed: bool| {
        let offer = if followed { stages::all() } else { scenes::offer_of_direct_light() };
        Chapter::new("test", "a test", |_| ()).offer(offer)
    };
    for (word, spawn) in material {
        let mut world = scene(spawn);
        let census = &Census::of(&world);
        assert!(prepare(census, &chapter(true).stages()).is_ok(), "{word}");
        let refused = prepare(census, &chapter(false).stages()).err().map(|error| error.to_string());
        let sentence = format!(
            "sphere \"ball\": {word} is given, but no stage on offer samples its BSDF; offer stages::all(), \
             which do"
        );
        assert_eq!(refused, Some(sentence));
        // Who asks for ray casting gets it.
        let camera = named(&mut world, "camera");
        world.entity_mut(camera).insert(Integrator::RayCasting);
        assert!(prepare(&Census::of(&world), &chapter(false).stages()).is_ok(), "{word}, by ray casting");
    }
}

/// A floor under a light that paths sample, by this integrator.
fn under(integrator: impl Bundle, light: impl Fn(&mut World)) -> Vec<String> {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.0, 2.0, 6.0), ..LookAt::default() };
    world.spawn((Name::new("camera"), PerspectiveCamera::default(), look, integrator));
    world.spawn((Name::new("floor"), Plane::default(), Matte::default(), Placement::at(0.0, -20.0, 0.0)));
    light(&mut world);
    said(&world).expect("accepted")
}

/// A picture of light that reaches nothing in so few segments says that, by every integrator that has a `max_depth`, and no
/// longer once it may have two.
#[test]
fn a_max_depth_of_1_is_named_as_what_makes_a_picture_black() {
    let lamp = |world: &mut World| {
        let glow = Emissive { radiance: Rgb::grey(900.0), ..Emissive::default() };
        world.spawn((Name::new("lamp"), Sphere::default(), Placement::at(0.0, 30.0, 10.0), glow));
        world.spawn((Name::new("bulb"), PointLight::default(), Placement::at(0.0, 2.0, 0.0)));
    };
    let (roulette, mut tried) = (0, 0);
    for max_depth in [1, 2] {
        let by = [LightStrategy::Light, LightStrategy::Bsdf, LightStrategy::Mis].map(|lights| Integrator::Path {
            max_depth,
            lights,
            roulette,
        });
        for integrator in
            by.into_iter().chain([Integrator::Whitted { max_depth }, Integrator::Distribution { max_depth }])
        {
            let told = under(integrator, lamp);
            let named = told.iter().any(|line| line.contains("probably be black") && line.contains("at max_depth 1"));
            assert_eq!(named, max_depth == 1, "{integrator:?}: {told:?}");
            tried += 1;
        }
    }
    eprintln!("max_depth: {tried} scenes, named in those where it is 1");
}

/// Emitters that cannot be sampled are named where light sampling is asked for alone, and only there; lights in one place
/// always.
#[test]
fn emitters_that_light_sampling_cannot_sample_are_named() {
    let path = |lights| Integrator::Path { max_depth: 8, lights, roulette: 5 };
    let glow = Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() };
    let egg = Placement { scale: DVec3::new(1.0, 2.0, 1.0), ..Placement::at(0.0, 3.0, 0.0) };
    let shapes: [(&str, &dyn Fn(&mut World), bool); 3] = [
        ("egg", &|world| _ = world.spawn((Name::new("egg"), Sphere::default(), egg, glow)), true),
        (
            "roof",
            &|world| _ = world.spawn((Name::new("roof"), Plane::default(), Placement::at(0.0, 9.0, 0.0), glow)),
            true,
        ),
        (
            "ball",
            &|world| _ = world.spawn((Name::new("ball"), Sphere::default(), Placement::at(0.0, 3.0, 0.0), glow)),
            false,
        ),
    ];
    let mut tried = 0;
    for (name, add, unsampled) in shapes {
        for (integrator, alone) in [
            (path(LightStrategy::Light), true),
            (path(LightStrategy::Mis), false),
            (path(LightStrategy::Bsdf), false),
            (Integrator::DISTRIBUTION, true),
        ] {
            let told = under(integrator, add);
            let named = told.iter().any(|line| line.contains("cannot sample") && line.contains(name));
            assert_eq!(named, unsampled && alone, "{name}, {integrator:?}: {told:?}");
            tried += 1;
        }
    }
    let twins = |world: &mut World| {
        for name in ["one", "other"] {
            world.spawn((Name::new(name), Sphere::default(), Placement::at(0.0, 3.0, 0.0), glow));
        }
    };
    for lights in [LightStrategy::Light, LightStrategy::Mis] {
        let told = under(path(lights), twins);
        let both = ["\"one\"", "\"other\"", "the very same surface"];
        assert!(told.iter().any(|line| both.iter().all(|word| line.contains(word))), "{told:?}");
        tried += 1;
    }
    eprintln!("emitters: {tried} scenes, the warning in those that need it");
}

/// What keeps light for thousands of bounces is said beforehand: white rooms, glass about the camera, and glass about a
/// light, whose paths no ray of the camera shows; the same with something that lets the light go is not mentioned.
#[test]
fn paths_that_hardly_end_are_announced() {
    let room = |albedo: f64| {
        move |world: &mut World| {
            world.spawn((Cuboid { size: DVec3::splat(30.0) }, Matte { colour: Rgb::grey(albedo) }));
            world.spawn((PointLight::default(), Placement::at(0.0, 5.0, 0.0)));
        }
    };
    let glass_at = |y: f64| {
        move |world: &mut World| {
            world.spawn((Sphere { radius: 1.0 }, Glass::default()));
            world.spawn((PointLight::default(), Placement::at(0.0, y, 0.0)));
        }
    };
    let block = |world: &mut World| _ = world.spawn((Cuboid { size: DVec3::splat(30.0) }, Glass::default()));
    let long = |told: &[String]| told.iter().any(|line| line.contains("a max_depth below 4096"));
    let traced = (Integrator::PATH, LightTracing::default());
    for (what, told, announced) in [
        ("a white room", under(Integrator::PATH, room(1.0)), true),
        ("a grey room", under(Integrator::PATH, room(0.7)), false),
        ("in a block of glass", under(Integrator::PATH, block), true),
        ("a light on a glass ball", under(traced, glass_at(1.0)), true),
        ("a light in a glass ball, off its centre", under(traced, glass_at(0.9)), true),
        ("a light above a glass ball", under(traced, glass_at(2.0)), false),
    ] {
        eprintln!("{what}: {told:?}");
        assert_eq!(long(&told), announced, "{what}");
    }
}

/// Chapters whose lights are sampled by MIS do not offer the stage that adds emission in full; whoever asks for BSDF
/// sampling there is told so, and gets no black picture.
#[test]
fn emission_that_no_stage_on_offer_adds_is_refused() {
    let (mut refused, mut rendered) = (0, 0);
    let follows = |chapter: &Chapter| chapter.offer.iter().any(|stage| stage.set == TileSystems::RemainingBounces);
    for chapter in chapters::all().into_iter().filter(follows) {
        let mut world = chapter.world(&Overrides::default());
        let camera = camera_entity(&world).expect("a camera");
        // Paths that are joined need MIS, and say so.
        world.entity_mut(camera).remove::<BidirectionalPathTracing>();
        let by = |lights| Integrator::Path { max_depth: 3, lights, roulette: 0 };
        for (lights, is_refused) in [(LightStrategy::Mis, false), (LightStrategy::Bsdf, true)] {
            world.entity_mut(camera).insert(by(lights));
            let census = Census::of(&world);
            let is_lit = emissive_evidence(&census).needed;
            match prepare(&census, &chapter.stages()) {
                Err(error) if error.to_string().contains("paths find no light by hitting it") => {
                    let sentence = error.to_string();
                    assert!(is_refused && sentence.contains("\"Add emission\""), "{}: {sentence}", chapter.name);
                    refused += 1;
                }
                Err(error) => panic!("{} by {lights:?}: {error}", chapter.name),
                Ok((plan, _)) => {
                    let adds = |stage: &Stage| stage.name.starts_with("Add emission");
                    assert!(!is_lit || plan.stages.iter().any(adds), "{} by {lights:?}", chapter.name);
                    rendered += usize::from(is_lit);
                }
            }
        }
    }
    assert!(refused >= 3 && rendered >= 5, "{refused} {rendered}");
    eprintln!("emission: {refused} chapters say that nothing adds it, {rendered} plans with lights add it");
}

/// Glass that is thinner than single precision keeps apart, and narrow gaps, are said; what only touches is not.
#[test]
fn what_precision_cannot_keep_apart_is_said() {
    let scene = |bodies: &dyn Fn(&mut World)| {
        let mut world = World::new();
        let look = LookAt { eye: DVec3::new(0.0, 3.0, 20.0), target: DVec3::ZERO, ..LookAt::default() };
        world.spawn((Name::new("camera"), PerspectiveCamera::default(), look, Integrator::PATH));
        world.spawn(Background { colour: Rgb::grey(0.5) });
        bodies(&mut world);
        let told = said(&world).expect("a scene that can be rendered");
        told.into_iter().filter(|sentence| sentence.contains("single precision")).collect::<Vec<_>>()
    };
    let pane = |thin: f64| {
        scene(&move |world| {
            world.spawn((Name::new("pane"), Cuboid { size: DVec3::new(1.0, thin, 1.0) }, Glass::default()));
        })
    };
    let shell = |radius: f64| {
        scene(&move |world| {
            world.spawn((Name::new("ball"), Sphere { radius: 1.0 }, Matte::default()));
            world.spawn((Name::new("shell"), Sphere { radius }, Glass::default()));
        })
    };
    let [thin, narrow] = [pane(1e-6), shell(1.0 + 1e-6)];
    assert!(thin.len() == 1 && thin[0].contains("cuboid \"pane\" is 1.0e-6 thick"), "{thin:?}");
    assert!(narrow.len() == 1 && narrow[0].contains("\"shell\"") && narrow[0].contains("1.0e-6 apart"), "{narrow:?}");
    assert_eq!([pane(1e-2), shell(1.01), shell(1.0)], [const { Vec::<String>::new() }; 3]);
}

/// A lamp on the upper face of a block is asked about by its name; one beside it is not.
#[test]
fn what_lies_exactly_on_glass_is_said() {
    let told = |height: f64| {
        let mut world = World::new();
        let look = LookAt { eye: DVec3::new(0.0, 2.0, 6.0), target: DVec3::ZERO, ..LookAt::default() };
        world.spawn((PerspectiveCamera::default(), look, Resolution { width: 16, height: 16 }, Integrator::PATH));
        world.spawn((Name::new("block"), Cuboid { size: DVec3::ONE }, Placement::at(0.0, 0.5, 0.0), Glass::default()));
        world.spawn((Plane::default(), Matte::default()));
        world.spawn((Name::new("lamp"), PointLight::default(), Placement::at(0.0, height, 0.0)));
        let told = said(&world).expect("a scene that can be rendered");
        told.into_iter().filter(|sentence| sentence.contains("on the surface of glass")).collect::<Vec<_>>()
    };
    let on = told(1.0);
    assert!(on.len() == 1 && on[0].starts_with("the point light \"lamp\" lies exactly on"), "{on:?}");
    assert_eq!([told(1.01), told(0.9)], [const { Vec::<String>::new() }; 2]);
}
