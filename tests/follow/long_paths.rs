//! Paths of thousands of bounces: what is said of them, and what it costs to follow one.

use super::*;
use pinhole::look::{Preflight, preflight, trace};
use pinhole::plan::Census;
use pinhole::render::prepare;
use pinhole::scene::*;
use std::time::{Duration, Instant};

/// A camera in a closed ball that absorbs nothing.
fn closed_ball(max_depth: u32, material: impl Bundle) -> World {
    let mut world = World::new();
    let size = Resolution { width: 24, height: 16 };
    let integrator = Integrator::Path { max_depth, lights: LightStrategy::Mis, roulette: 0 };
    world.spawn((Name::new("camera"), PerspectiveCamera::default(), Placement::at(0.0, 1.0, 6.0), size, integrator));
    world.spawn((Name::new("ball"), Sphere { radius: 100.0 }, material));
    let lamp = Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() };
    world.spawn((Name::new("lamp"), Sphere { radius: 1.0 }, Placement::at(0.0, 0.0, 90.0), lamp));
    world
}

fn silver() -> Mirror {
    Mirror { colour: Rgb::grey(1.0) }
}

fn said(scene: &World, patience: Duration) -> (Vec<String>, Duration) {
    let census = &Census::of(scene);
    let (plan, tables) = prepare(census, &offer()).expect("prepared");
    let asked = Preflight { threads: Some(1), ends_in_time: false, patience: Some(patience) };
    let began = Instant::now();
    (preflight(census, (&plan, &tables), asked).expect("said"), began.elapsed())
}

#[test]
fn what_does_not_end_is_said_in_time() {
    let patience = Duration::from_millis(300);
    let (told, took) = said(&closed_ball(u32::MAX, silver()), patience);
    eprintln!("{took:?}: {told:#?}");
    assert!(took < Duration::from_secs(2), "{took:?}");
    assert_eq!(told.len(), 2, "{told:?}");
    for words in ["test rays was finished", "a max_depth of 4294967295"] {
        assert!(told[0].contains(words), "no \"{words}\" in {told:?}");
    }
    assert!(told[1].contains("inside the sphere \"ball\""), "{told:?}");

    // What ends, but only after a hundred bounces, is told otherwise.
    let white = Matte { colour: Rgb::grey(1.0) };
    let (told, _) = said(&closed_ball(101, white), Duration::from_secs(60));
    eprintln!("{told:#?}");
    assert!(
        told.iter().any(|sentence| sentence.contains("is followed by") && sentence.contains("max_depth below 101")),
        "{told:?}"
    );
    let grey = closed_ball(101, Matte { colour: Rgb::grey(0.5) });
    let camera = Integrator::Path { max_depth: 101, lights: LightStrategy::Mis, roulette: 5 };
    let mut grey = grey;
    let entity = named(&mut grey, "camera");
    grey.entity_mut(entity).insert(camera);
    let (told, _) = said(&grey, Duration::from_secs(60));
    assert!(!told.iter().any(|sentence| sentence.contains("is followed by")), "{told:?}");
}

/// Four times the bounces take about four times as long to be traced and printed, not sixteen times.
#[test]
fn a_trace_grows_with_its_bounces_and_no_faster() {
    let traced = |max_depth| {
        let scene = closed_ball(max_depth, silver());
        let began = Instant::now();
        let mut trace = trace(&Census::of(&scene), &offer(), TracePixel { x: 3, y: 3 }).expect("traced");
        trace.prints_all = true;
        let text = trace.to_string();
        (began.elapsed(), trace, text)
    };
    let fastest = |max_depth| (0..3).map(|_| traced(max_depth).0).min().expect("three");
    let times = [1024, 4096].map(fastest);
    let ratio = times[1].as_secs_f64() / times[0].as_secs_f64();
    eprintln!("traces of 1,024 and 4,096 max_depth: {times:?}, a factor of {ratio:.1}");
    assert!(ratio < 8.0, "{times:?}");

    let (_, mut trace, all) = traced(100);
    let max_depth = |text: &str| text.lines().filter(|line| line.starts_with("pixel 3,3")).count();
    assert_eq!(max_depth(&all), 101, "each bounce, and the first again once the light of all is summed");
    trace.prints_all = false;
    let short = trace.to_string();
    assert_eq!(max_depth(&short), 21, "{short}");
    assert!(short.contains("\nbounces 16 to 95 are left out; --all prints them\n"), "{short}");
    assert!(
        short.contains("bounce 15\n") && short.contains("bounce 96\n") && !short.contains("bounce 16\n"),
        "{short}"
    );
    assert!(trace.stages.iter().any(|recorded| recorded.depth == 50), "what is recorded stays");
}
