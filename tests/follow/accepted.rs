//! Sentences that list shapes, held against what is accepted of every registered shape.

use super::*;
use pinhole::extract::{sampled_shapes, shapes_with_inside};
use pinhole::render::prepare;
use pinhole::scene::*;
use pinhole::shapes::{Listed, SceneShape, ShapeVisitor, visit_shapes};

/// Each component's examples, as glass and as a lamp.
#[derive(Default)]
struct Tried {
    tried: usize,
    wrong: Vec<String>,
}

/// Whether a list names a kind, and whether it says that it must be closed.
fn named_in(list: &str, word: &str) -> (bool, bool) {
    let own = list
        .split([','])
        .flat_map(|part| part.split(" or "))
        .find(|part| part.split_whitespace().any(|own| own == word || own == format!("{word}s")));
    (own.is_some(), own.is_some_and(|own| own.contains("closed") || own.contains("close")))
}

impl ShapeVisitor for Tried {
    fn visit<S: Listed>(&mut self) {
        let word = S::Component::WORD;
        for (number, component) in S::Component::examples().into_iter().enumerate() {
            let mut world = World::new();
            world.spawn((Name::new("camera"), PerspectiveCamera::default(), Placement::at(0.0, 0.0, 9.0)));
            world.spawn((Name::new("one"), component.clone(), Glass::default()));
            let refused = prepare(&Census::of(&world), &offer()).err().map(|error| error.to_string());
            let is_glass = refused.is_none();
            // A triangle alone is refused, since no other closes it.
            let alone = refused.is_some_and(|told| !told.contains(&shapes_with_inside(&Census::of(&World::new()))));
            let (named, closed) = named_in(&shapes_with_inside(&Census::of(&World::new())), word);
            if is_glass && !named || !is_glass && named && !closed && !alone {
                self.wrong.push(format!("glass, {word} {number}: accepted {is_glass}, named {named}, closed {closed}"));
            }
            let mut world = World::new();
            let by_light = Integrator::Path { max_depth: 4, lights: LightStrategy::Light, roulette: 0 };
            world.spawn((Name::new("camera"), PerspectiveCamera::default(), Placement::at(0.0, 0.0, 9.0), by_light));
            world.spawn((Name::new("ground"), Plane::default(), Matte::default(), Placement::at(0.0, -9.0, 0.0)));
            let scale = if S::NON_UNIFORM == Some(true) { glam::DVec3::new(1.0, 2.0, 1.0) } else { glam::DVec3::ONE };
            let place = Placement { scale, ..Placement::at(0.0, 3.0, 0.0) };
            world.spawn((
                Name::new("one"),
                component,
                place,
                Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() },
            ));
            let told = super::foretold::said(&world);
            let is_sampled = !told.iter().any(|line| line.contains("cannot sample"));
            let (named, closed) = named_in(&sampled_shapes(&Census::of(&World::new())), word);
            let by_scale = S::NON_UNIFORM.is_some();
            if is_sampled && !named || !is_sampled && named && !closed && !by_scale {
                self.wrong.push(format!("lamp, {word} {number}: sampled {is_sampled}, named {named}: {told:?}"));
            }
            self.tried += 1;
        }
    }
}

#[test]
fn lists_of_shapes_name_what_is_accepted() {
    let mut tried = Tried::default();
    visit_shapes(&mut tried);
    let (glass, lights) = (shapes_with_inside(&Census::of(&World::new())), sampled_shapes(&Census::of(&World::new())));
    eprintln!("{} shapes; glass: {glass}; lights: {lights}", tried.tried);
    assert!(tried.tried >= 15 && tried.wrong.is_empty(), "{:#?}", tried.wrong);
}
