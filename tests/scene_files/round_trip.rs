//! Export → load: the same picture and the same digests, bit for bit, and the same text again.

use super::{parsed, typed};
use crate::scenes::{self, Setup};
use bevy_ecs::prelude::*;
use exr::prelude::read_first_flat_layer_from_file;
use glam::DVec3;
use pinhole::Overrides;
use pinhole::models::glb_of;
use pinhole::scene::*;
use pinhole_lab::review;
use std::fs;
use std::path::Path;

#[test]
fn every_chapter_comes_back_from_its_file_bit_for_bit() {
    let asked = Overrides { resolution: Some(Resolution { width: 96, height: 54 }), ..Overrides::default() };
    for chapter in chapters::all() {
        let mut before = chapter.world(&asked);
        own_view_left_out(&mut before);
        let text = scene_text(&before).expect("a chapter's scene can be exported");
        // As if the file stood in the chapter's folder, where its images are, or beside the meshes that it makes.
        let meshes = meshes_in_memory(&before);
        let folder = tempfile::tempdir().expect("a folder");
        for mesh in &meshes {
            let bytes = glb_of(&mesh.geometry).expect("a small file");
            fs::write(folder.path().join(&mesh.file), bytes).expect("written");
        }
        let own = Path::new("chapters").join(chapter.name);
        let beside = if meshes.is_empty() { &own } else { folder.path() }.join("scene.ron");
        let after = SceneFile::parse(&beside, text.clone());
        let mut after = after.unwrap_or_else(|problem| panic!("{}: {problem}\n{text}", chapter.name)).world();
        assert_eq!(scene_text(&after).expect("exported again"), text, "{}", chapter.name);
        // A bit that is another shows in few samples as in many.
        for scene in [&mut before, &mut after] {
            scene.query::<&mut Sampling>().iter_mut(scene).for_each(|mut own| own.samples = own.samples.min(8));
        }
        let films = [(&before, chapter.stages()), (&after, scenes::offer())]
            .map(|(scene, offer)| scenes::film_by(scene, &offer, &Default::default()).expect("renders"));
        assert!(films[0] == films[1], "{}: another picture", chapter.name);
        let digests = [review::digests(&before, &chapter.stages()), review::digests(&after, &scenes::offer())];
        let [before, after] = digests.map(|digests| digests.expect("digests"));
        assert_eq!(before, after, "{}: another digest", chapter.name);
    }
    eprintln!("round trips: {} chapters, picture, digests and text the same", chapters::all().len());
}

/// A chapter's own column is not offered to scene files, so that its picture is what comes back.
fn own_view_left_out(scene: &mut World) {
    let offered =
        |column: &str| scenes::offer().iter().flat_map(|stage| stage.writes.clone()).any(|c| c.name == column);
    let mut cameras = scene.query::<(Entity, &View)>();
    let own = cameras.iter(scene).find(|(_, view)| !offered(&view.column)).map(|(camera, _)| camera);
    if let Some(camera) = own {
        scene.entity_mut(camera).remove::<View>();
    }
}

#[test]
fn parents_materials_and_what_is_disabled_come_back_too() {
    let mut tried = 0;
    for eye in scenes::EYES {
        let setup = Setup { eye, scale: 1.0 / 3.0, shift: DVec3::new(0.1, -0.0, 1e-7), ..Setup::default() };
        let scenes = [
            scenes::full(setup),
            scenes::turned(setup),
            scenes::ties(),
            scenes::shining(setup),
            scenes::shapes_of_all_kinds(setup),
            scenes::blurred(setup),
            scenes::material::brushed(setup),
            scenes::moving(setup),
            scenes::fisheye(setup),
            scenes::all_round(setup),
            scenes::textured(setup),
        ];
        for before in scenes {
            let mut before = before;
            if before.query::<&Name>().iter(&before).any(|name| name.as_str() == "ground") {
                let ground = scenes::named(&mut before, "ground");
                before.entity_mut(ground).insert(Disabled);
            }
            let text = scene_text(&before).expect("exported");
            let after = parsed(&text).unwrap_or_else(|problem| panic!("{problem}\n{text}")).world();
            assert_eq!(scene_text(&after).expect("exported again"), text);
            assert!(scenes::film(&before) == scenes::film(&after), "another picture\n{text}");
            tried += 1;
        }
    }
    eprintln!("round trips: {tried} scenes with parents, shared materials and a disabled ground");
}

#[test]
fn every_sampler_and_filter_comes_back() {
    let mut tried = 0;
    let odd = Filter::Gaussian { radius: 1.0 / 3.0, sigma: 0.1 };
    for sampler in Sampler::ALL.map(|(_, sampler)| sampler) {
        for filter in Filter::ALL.map(|(_, filter)| filter).into_iter().chain([odd]) {
            let mut before = scenes::textured(Setup { size: [24, 16], ..Setup::default() });
            let camera = scenes::named(&mut before, "camera");
            let sampling = Sampling { samples: 3, seed: u64::MAX, sampler, filter };
            before.entity_mut(camera).insert(sampling);
            let text = scene_text(&before).expect("exported");
            let mut after = parsed(&text).unwrap_or_else(|problem| panic!("{problem}\n{text}")).world();
            let back = *after.query::<&Sampling>().single(&after).expect("one sampling camera");
            assert_eq!(back, sampling, "{text}");
            assert!(scenes::film(&before) == scenes::film(&after), "another picture\n{text}");
            tried += 1;
        }
    }
    eprintln!("round trips: {tried} samplings of a textured scene");
}

#[test]
fn every_form_of_dispersion_comes_back() {
    let forms = [
        ("Bk7", Dispersion::Bk7),
        ("Sf11", Dispersion::Sf11),
        ("Water", Dispersion::Water),
        ("Diamond", Dispersion::Diamond),
        ("Cauchy(a: 1.5, b: 0.004)", Dispersion::Cauchy { a: 1.5, b: 0.004, c: 0.0 }),
        (
            "Sellmeier(b: (1, 0.2, 1), c: (0.006, 0.02, 103.5))",
            Dispersion::Sellmeier { b: [1.0, 0.2, 1.0], c: [0.006, 0.02, 103.5] },
        ),
    ];
    for (text, expected) in forms {
        let file = format!("[(perspective_camera: ()), (sphere: (), glass: (), dispersion: {text})]");
        let mut world = parsed(&file).unwrap_or_else(|problem| panic!("{problem}")).world();
        let own = *world.query::<&Dispersion>().single(&world).expect("one glass that disperses");
        assert_eq!(own, expected, "{text}");
        let again = scene_text(&world).expect("exported");
        let mut world = parsed(&again).unwrap_or_else(|problem| panic!("{problem}\n{again}")).world();
        assert_eq!(*world.query::<&Dispersion>().single(&world).expect("still one"), expected, "{again}");
    }
}

#[test]
fn numbers_come_back_bit_for_bit() {
    let mut tried = 0;
    for bits in (0..64).flat_map(|bit| [1_u64 << bit, !(1_u64 << bit), 0x3ff0_0000_0000_0000 ^ (1 << bit)]) {
        let number = f64::from_bits(bits);
        if !number.is_finite() {
            continue;
        }
        let mut before = World::new();
        let scale = DVec3::new(1.0, number, -number);
        let placement = Placement { position: DVec3::new(number, -0.0, 0.1), scale, ..Placement::default() };
        before.spawn((Sphere { radius: number }, placement));
        let text = scene_text(&before).expect("exported");
        let mut after = parsed(&text).unwrap_or_else(|problem| panic!("{problem}\n{text}")).world();
        let (sphere, back) = after.query::<(&Sphere, &Placement)>().single(&after).expect("one sphere");
        let bits_of = |p: &Placement| [p.position, p.scale].map(|v| v.to_array().map(f64::to_bits));
        assert_eq!((sphere.radius.to_bits(), bits_of(back)), (number.to_bits(), bits_of(&placement)), "{text}");
        tried += 1;
    }
    eprintln!("numbers: {tried} come back bit for bit");
}

/// A scene file's text with every component on one line, whatever the length of the path of its image.
fn unfolded(text: &str) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    lines.join(" ").replace("( ", "(").replace(", )", ")")
}

#[test]
fn an_exported_file_is_ron_and_its_commands_work_as_typed() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut file = String::new();
    for chapter in chapters::all() {
        let beside = folder.path().join(chapter.name);
        fs::create_dir(&beside).expect("a folder of its own");
        file = beside.join("scene.ron").display().to_string();
        let printed = typed(&["export", chapter.name]).expect("exported");
        ron::from_str::<ron::Value>(&printed).unwrap_or_else(|error| panic!("{}: {error}", chapter.name));
        let wrote = typed(&["export", chapter.name, "-o", &file]).expect("exported");
        assert_eq!(wrote.lines().next(), Some(format!("wrote {file}").as_str()));
        let text = fs::read_to_string(&file).expect("written");
        // Images are named by their whole path where they are printed, and stand beside the file that is written.
        let own_folder = format!("{}/chapters/{}/", env!("CARGO_MANIFEST_DIR"), chapter.name);
        let printed = printed.replace(&own_folder, "");
        let printed: Vec<&str> = printed.lines().filter(|line| !line.contains(".glb is in the program only")).collect();
        let printed = printed.join("\n");
        assert_eq!(unfolded(&text.replace(&file, "scene.ron")), unfolded(&printed), "the same but for the file's name");
        let own = |line: &&str| !line.contains(", a column of its own");
        let without = printed.lines().filter(own).collect::<Vec<_>>().join("\n");
        let again = typed(&["export", &file]).expect("exported again");
        let again = again.replace(&format!("{}/", beside.display()), "");
        assert_eq!(unfolded(&again), unfolded(&without), "exported from the file");
        let plans = [chapter.name, &file].map(|name| typed(&["plan", name]).expect("planned"));
        let [of_chapter, of_file] = plans.map(|plan| plan.lines().nth(1).map(String::from));
        assert_eq!(of_chapter, of_file);
    }
    let traced = typed(&["trace", &file, "--pixel", "240,162"]).expect("traced");
    assert!(traced.contains("240,162"), "{traced}");
    let told = typed(&["export", "5", "-o", &file]).expect_err("it is there").to_string();
    assert!(told.ends_with("it is there already and may have been edited; move it away, or choose another name"));
}

/// What a scene's picture is, to the bit; the rest of the file says which scene it is.
fn rendered(scene: &str, folder: &Path) -> Vec<u32> {
    let picture = folder.join("picture.exr");
    let words = ["render", scene, "--size", "32x18", "--quiet", "-o", picture.to_str().expect("text")];
    typed(&words).unwrap_or_else(|error| panic!("{scene}: {error}"));
    let layer = read_first_flat_layer_from_file(&picture).expect("written").layer_data;
    let channels = layer.channel_data.list.iter();
    channels.flat_map(|channel| channel.sample_data.values_as_f32().map(f32::to_bits)).collect()
}

/// Meshes that a chapter makes are written once beside its scene file; from there the scene may be exported anywhere,
/// and still finds them.
#[test]
fn an_exported_scene_finds_its_meshes_from_everywhere() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let picture = rendered("28", folder.path());
    let wrote = typed(&["export", "28", "-o", &path("first/s.ron")]).expect("exported");
    assert_eq!(wrote.lines().count(), 4, "{wrote}");
    let wrote = typed(&["export", "28", "-o", &path("first/again.ron")]).expect("exported");
    assert_eq!(wrote.lines().count(), 1, "the meshes are there: {wrote}");
    // Other meshes of the same names stay what they are.
    let wrote = typed(&["export", "30", "-o", &path("first/beach.ron")]).expect("exported");
    assert!(wrote.contains("mesh-1-2.glb, which it names"), "{wrote}");
    let elsewhere = [("above.ron", "file: \"first/mesh-1.glb\""), ("other/s.ron", "/first/mesh-1.glb\"")];
    for (file, named) in elsewhere {
        let wrote = typed(&["export", &path("first/s.ron"), "-o", &path(file)]).expect("exported");
        assert_eq!(wrote.lines().count(), 1, "{wrote}");
        let text = fs::read_to_string(path(file)).expect("read");
        assert!(text.contains(named), "{file}: {text}");
        assert!(rendered(&path(file), folder.path()) == picture, "{file}: another picture");
    }
    assert!(rendered(&path("first/s.ron"), folder.path()) == picture);
}

#[test]
fn an_exported_scene_takes_its_images_along() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let names = |below: &str| {
        let entries = fs::read_dir(folder.path().join(below)).expect("a folder").map(|entry| entry.expect("listed"));
        let mut names: Vec<String> = entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    };
    let picture = rendered("16", folder.path());
    let [first, moved] = [path("first/s.ron"), path("moved/s.ron")];
    let wrote = typed(&["export", "16", "-o", &first]).expect("exported");
    assert_eq!(wrote.lines().count(), 3, "{wrote}");
    fs::rename(path("first"), path("moved")).expect("moved");
    assert!(rendered(&moved, folder.path()) == picture, "another picture from its own folder");
    assert_eq!(names("moved"), ["card.png", "evening.hdr", "s.ron"]);

    // What lies beside or below the file already keeps its place, by a name that moves with the folder.
    typed(&["export", &moved, "-o", &path("moved/again.ron")]).expect("exported");
    assert_eq!(names("moved"), ["again.ron", "card.png", "evening.hdr", "s.ron"]);
    let scene = |name: &str| {
        let text = fs::read_to_string(path(name)).expect("read");
        text.lines().filter(|line| !line.starts_with("//")).collect::<Vec<_>>().join("\n")
    };
    assert_eq!(scene("moved/again.ron"), scene("moved/s.ron"));
    typed(&["export", &moved, "-o", &path("above.ron")]).expect("exported");
    assert!(scene("above.ron").contains("file: \"moved/card.png\""), "{}", scene("above.ron"));
    assert!(rendered(&path("above.ron"), folder.path()) == picture);

    // Two images of one name, and a file in the way, all stay what they are.
    fs::create_dir(path("other")).expect("a folder");
    fs::write(path("other/card.png"), "mine").expect("written");
    fs::rename(path("moved/evening.hdr"), path("moved/card-2.hdr")).expect("renamed");
    fs::rename(path("moved/card.png"), path("moved/card-2.png")).expect("renamed");
    let text = fs::read_to_string(&moved).expect("read").replace("card.png", "card-2.png");
    fs::write(&moved, text.replace("evening.hdr", "card-2.hdr")).expect("written");
    fs::write(path("other/card-2.png"), "mine too").expect("written");
    let wrote = typed(&["export", &moved, "-o", &path("other/s.ron")]).expect("exported");
    assert!(wrote.contains("other/card-2-2.png, which it names\n"), "{wrote}");
    assert_eq!(names("other"), ["card-2-2.png", "card-2.hdr", "card-2.png", "card.png", "s.ron"]);
    assert_eq!(fs::read(path("other/card-2.png")).expect("read"), b"mine too");
    fs::remove_dir_all(path("moved")).expect("removed");
    assert!(rendered(&path("other/s.ron"), folder.path()) == picture, "its images are its own");

    // Printed, it may be saved anywhere.
    let printed = typed(&["export", &path("other/s.ron")]).expect("printed");
    fs::create_dir(path("away")).expect("a folder");
    fs::write(path("away/s.ron"), printed).expect("written");
    assert!(rendered(&path("away/s.ron"), folder.path()) == picture);
    fs::write(path("away/s.ron"), typed(&["export", "16"]).expect("printed")).expect("written");
    assert!(rendered(&path("away/s.ron"), folder.path()) == picture);

    fs::remove_file(path("other/card-2.hdr")).expect("removed");
    let told = typed(&["export", &path("other/s.ron"), "-o", &path("new/s.ron")]).expect_err("refused").to_string();
    assert!(told.contains("the image \"card-2.hdr\" cannot be copied beside it: "), "{told}");
    assert!(!Path::new(&path("new/s.ron")).exists());
}

#[test]
fn a_name_that_a_comment_cannot_hold_is_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for name in ["a\nb.ron", "a\r.ron", "\u{1b}[2J.ron", "a\u{85}b.ron", "a\nb/s.ron"] {
        let file = folder.path().join(name).display().to_string();
        let told = typed(&["export", "5", "-o", &file]).expect_err("refused").to_string();
        assert!(told.ends_with("its path must be without control characters"), "{told}");
        assert!(!told.contains(char::is_control), "{told:?}");
    }
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
}

#[test]
fn what_no_file_can_hold_is_refused() {
    let refused = |spawn: fn(&mut World)| {
        let mut world = World::new();
        spawn(&mut world);
        scene_text(&world).expect_err("refused").to_string()
    };
    let by_name = "a scene file refers to it by name, so its name must be unique";
    let unnamed = refused(|world| {
        let group = world.spawn(Placement::default()).id();
        world.spawn((Name::new("ball"), Sphere::default(), ChildOf(group)));
    });
    assert!(unnamed.starts_with("\"ball\": parent is (unnamed, entity ") && unnamed.ends_with(by_name), "{unnamed}");
    let twice = refused(|world| {
        let gold = world.spawn((Name::new("gold"), Matte::default())).id();
        world.spawn((Name::new("gold"), Matte::default()));
        world.spawn((Name::new("ball"), Sphere::default(), UsesMaterial(gold)));
    });
    assert_eq!(twice, format!("\"ball\": material is \"gold\", but {by_name}"));
    let lines = refused(|world| {
        world.spawn((Name::new("two\nlines"), Sphere::default()));
    });
    assert!(lines.contains(r#"name is "two\nlines", but"#), "{lines}");
    assert_eq!(parsed(&scene_text(&World::new()).expect("empty")).expect("an empty list").len(), 0);
}
