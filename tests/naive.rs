//! The naive methods that a render may run: each runs in the chapter that explains it, and all but those that are only
//! slower, or wrong where few rays go, change the picture.

use pinhole::plan::Census;
use pinhole::render::{Execution, render};
use pinhole::scene::Resolution;
use pinhole::{Overrides, SamplingOverrides};
use pinhole_lab::naive::methods::METHODS;

/// The same picture, as the methods' own lines say: later, or but for rays that hardly any camera sends.
const ALIKE: [&str; 4] = ["spheres-in-f32", "boxes-by-min-and-max", "plain-tree", "plain-wide-tree"];

#[test]
fn each_naive_method_runs_in_its_chapter_and_changes_the_picture() {
    let chapters = chapters::all();
    let sampling = SamplingOverrides { samples: Some(4), ..SamplingOverrides::default() };
    let mut alike = Vec::new();
    for method in &METHODS {
        let number = format!("{:02}_", method.chapter);
        let chapter = chapters.iter().find(|chapter| chapter.name.starts_with(&number)).expect("the chapter");
        let whole = Overrides { resolution: Some(Resolution { width: 160, height: 90 }), ..Overrides::default() };
        let is_sampled = method.chapter >= 17;
        let asked = if is_sampled { Overrides { sampling, ..whole } } else { whole };
        let scene = chapter.world(&asked);
        let naive = method
            .put_in(chapter.stages(), &Census::of(&scene))
            .unwrap_or_else(|error| panic!("{}: {error}", method.name));
        let [own, other] = [chapter.stages(), naive].map(|offer| {
            let rendered = render(&scene, &offer, &Execution::default(), &()).expect("a picture");
            let film = rendered.film;
            let places = (0..film.height).flat_map(|y| (0..film.width).map(move |x| (x, y)));
            places.map(|(x, y)| film.mean(x, y)).collect::<Vec<[f32; 3]>>()
        });
        assert!(other.iter().flatten().all(|part| part.is_finite()), "{}", method.name);
        if own == other {
            alike.push(method.name);
        }
    }
    eprintln!("naive: {} methods run; the same picture as pinhole's: {}", METHODS.len(), alike.join(", "));
    let unsaid: Vec<_> = alike.iter().filter(|name| !ALIKE.contains(name)).collect();
    assert!(unsaid.is_empty(), "{unsaid:?} change nothing");
}

#[test]
fn a_method_that_the_scene_has_no_place_for_is_refused() {
    let chapters = chapters::all();
    let chapter = chapters.iter().find(|chapter| chapter.name == "05_pinhole").expect("the chapter");
    let scene = chapter.world(&Overrides::default());
    let method = METHODS.iter().find(|method| method.name == "moments-in-turn").expect("the method");
    let told = method.put_in(chapter.stages(), &Census::of(&scene)).expect_err("refused").to_string();
    assert_eq!(
        told,
        "moments-in-turn stands in \"Take moments in turn\", which this render does not run; chapter 24 does"
    );
}
