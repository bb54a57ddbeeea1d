//! Each chapter's kept costs are of the stages that its plan has, and were not measured by a debug build.

use pinhole::scene::*;
use pinhole_cli::command::outdated_costs;
use pinhole_lab::measure::cost::kept_costs;

#[test]
fn costs_are_of_the_stages_that_run() {
    let (mut wrong, mut looked) = (Vec::new(), 0);
    for chapter in chapters::all() {
        looked += 1;
        let why = outdated_costs(&chapter).expect("a plan");
        wrong.extend(why.map(|why| format!("{}: {why}", chapter.name)));
        let kept = kept_costs(chapter.name).unwrap_or_default();
        assert!(!kept.contains("built without --release"), "{}: its times say nothing", chapter.name);
        assert!(kept.lines().last().is_some_and(|line| line.starts_with("measured on ")), "{}: when?", chapter.name);
    }
    let anew = "cargo run --release -- measure";
    assert!(wrong.is_empty(), "{};\nto measure anew, on a quiet machine: {anew}", wrong.join(",\n"));
    eprintln!("costs: {looked} chapters, each of the stages that run");
}

#[test]
fn a_stage_that_was_not_measured_or_is_gone_asks_for_measuring() {
    let chapter =
        |number: &str| chapters::all().into_iter().find(|own| own.name.starts_with(number)).expect("a chapter");
    let told = |disk: bool, plane: bool| {
        let other = chapter("05").with_scene(move |world| {
            world.spawn(PerspectiveCamera::default());
            world.spawn((Sphere::default(), Placement::at(0.0, 0.0, -9.0), Matte::default()));
            world.spawn(Background { colour: Rgb::grey(0.1) });
            world.spawn((PointLight::default(), Placement::at(0.0, 5.0, 0.0)));
            if disk {
                world.spawn((Disk::default(), Placement::at(3.0, 0.0, -9.0), Matte::default()));
            }
            if plane {
                world.spawn((Plane::default(), Placement::at(0.0, -1.0, 0.0), Matte::default()));
            }
        });
        outdated_costs(&other).expect("a plan")
    };
    // Another scene with the same stages: times of it are as old as they say, and nothing else is asked.
    assert_eq!(told(false, true), None);
    let came = told(true, true).expect("another plan");
    assert!(came.starts_with("stages that were not measured: \"Intersect disks\", "), "{came}");
    let went = told(false, false).expect("another plan");
    assert!(went.starts_with("stages that are gone: ") && went.contains("\"Intersect planes\""), "{went}");
    let both = told(true, false).expect("another plan");
    assert!(both.contains("\"Intersect disks\"") && both.contains(" instead of \""), "{both}");
    let nobody = outdated_costs(&pinhole::Chapter::new("a new chapter", "", |_| ())).expect("a plan");
    assert_eq!(nobody.as_deref(), Some("no costs are kept"));
}
