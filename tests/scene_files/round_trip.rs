//! Export → load: the same picture and the same digests, bit for bit, and the same text again.

use crate::scenes::{self, Setup};
use crate::{chapters, parsed, typed};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::scene::*;
use pinhole::{Asked, review};
use std::fs;

#[test]
fn every_chapter_comes_back_from_its_file_bit_for_bit() {
    let asked = Asked { resolution: Some(Resolution { width: 96, height: 54 }), ..Asked::default() };
    for chapter in chapters::all() {
        let mut before = chapter.world(&asked);
        own_view_left_out(&mut before);
        let text = scene_text(&before).expect("a chapter's scene can be exported");
        let after = parsed(&text).unwrap_or_else(|problem| panic!("{}: {problem}\n{text}", chapter.name)).world();
        assert_eq!(scene_text(&after).expect("exported again"), text, "{}", chapter.name);
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
            scenes::pieces(setup),
            scenes::blurred(setup),
            scenes::matter::brushed(setup),
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
    let file = folder.path().join("scene.ron").display().to_string();
    for chapter in chapters::all() {
        let printed = typed(&["export", chapter.name]).expect("exported");
        ron::from_str::<ron::Value>(&printed).unwrap_or_else(|error| panic!("{}: {error}", chapter.name));
        let _ = fs::remove_file(&file);
        assert_eq!(typed(&["export", chapter.name, "-o", &file]).expect("exported"), format!("wrote {file}\n"));
        let text = fs::read_to_string(&file).expect("written");
        // Images are named from the current folder, and by their whole path in a file that lies elsewhere.
        let here = std::env::current_dir().expect("a folder").display().to_string();
        let printed = printed.replace("\"chapters/", &format!("\"{here}/chapters/"));
        assert_eq!(unfolded(&text.replace(&file, "scene.ron")), unfolded(&printed), "the same but for the file's name");
        let own = |line: &&str| !line.contains(", a column of its own");
        let without = printed.lines().filter(own).collect::<Vec<_>>().join("\n");
        let again = typed(&["export", &file]).expect("exported again");
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

#[test]
fn what_no_file_can_hold_is_refused() {
    let refused = |spawn: fn(&mut World)| {
        let mut world = World::new();
        spawn(&mut world);
        scene_text(&world).expect_err("refused").to_string()
    };
    let by_name = "in a scene file it is meant by name, so it must have one that no other has";
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
