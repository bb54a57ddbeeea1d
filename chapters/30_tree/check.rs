//! Chapter 30: which children of a node a ray visits, and in which order.

use bevy_ecs::prelude::*;
use pinhole::extract::SphereTable;
use pinhole::intersect;
use pinhole::intersect::Hits;
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole::shapes::Shape;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Probe, Question, RowPlaces, Setting, StandIn, at_most, probes};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::naive::tree::{Search, Tree, by_cost, to_visit};
use std::sync::{Arc, OnceLock};

/// Where a ray enters the children, and its closest hit so far.
type Input = ([Option<f64>; 2], f64);

type Answer = [Option<u32>; 2];

/// What the reader writes.
pub type Yours = fn([Option<f64>; 2], f64) -> Answer;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("to_visit", question, move |&(enters, closest)| yours(enters, closest), mine)
        .shown_in(|world| at_most(world, (320, 4)))
        .and_in("two boxes; right: a hit", |_| ())
}

fn question() -> Question<Input, Answer> {
    Question {
        pinhole_has: ("src/pinhole/bvh/traverse.rs", "step"),
        probes: asked(),
        tell: |(enters, closest)| format!("enters {enters:?}, closest {closest:?}"),
        right: |&(enters, closest)| to_visit(enters, closest),
        apart: |yours, right| if yours == right { 0.0 } else { 1.0 },
        allowed: 0.0,
        measured: "where 1 is a wrong list",
        mistakes: Mistakes::<Input, Answer>::new()
            .say("both are visited where either may hold a closer hit; each is asked by itself")
            .when(|&(enters, closest)| {
                let [a, b] = enters.map(|t| t.unwrap_or(f64::INFINITY));
                let both = if b < a { [Some(1), Some(0)] } else { [Some(0), Some(1)] };
                if a.min(b) < closest { both } else { [None; 2] }
            })
            .say("the farther child is left out: its box may overlap the nearer one and hold the closer hit")
            .when(|&(enters, closest)| [to_visit(enters, closest)[0], None])
            .when(|&(enters, closest)| [in_order((enters, closest))[0], None])
            .say("a child that begins behind the closest hit is visited: it cannot hold a closer one")
            .when(|&(enters, _)| to_visit(enters, f64::INFINITY))
            .say("`closest` is compared with the farther child alone; the nearer one, too, may begin behind the closest hit")
            .when(|&(enters, closest)| {
                let [near, far] = to_visit(enters, f64::INFINITY);
                [near, far.filter(|_| to_visit(enters, closest)[1].is_some())]
            })
            .say("both are visited if the nearer one begins before the closest hit; the farther one must do so, too")
            .when(|&(enters, closest)| both_or_none(enters, closest))
            .say("child 0 first, whichever is nearer: the picture is right, and takes longer")
            .when(|&input| in_order(input))
            .say("the farther child comes first: a hit there seldom spares the nearer one")
            .when(|&(enters, closest)| farther_first(enters, closest))
            .say("None stands before a child; where only one is visited, it is the first")
            .when(|&(enters, closest)| slots(enters, closest))
            .when(|&(enters, closest)| {
                if slots(enters, closest).contains(&None) { slots(enters, closest) } else { to_visit(enters, closest) }
            })
            .when(|&(enters, closest)| {
                let [lower, upper] = slots(enters, closest);
                if enters[1].zip(enters[0]).is_some_and(|(upper, lower)| upper < lower) {
                    [upper, lower]
                } else {
                    [lower, upper]
                }
            })
            .say("a box in which the ray begins, at t = 0, is left out; it is visited, too")
            .when(|&(enters, closest)| to_visit(enters.map(|t| t.filter(|&t| t > 0.0)), closest))
            .say("child 1 is first where both are equally near; then it is child 0")
            .when(
                |&(enters, closest)| {
                    if enters[0] == enters[1] { farther_first(enters, closest) } else { to_visit(enters, closest) }
                },
            )
            .say("the comparison is the wrong way round: a child is visited that begins before `closest`")
            .when(|&(enters, closest)| to_visit(enters.map(|t| t.filter(|&t| t >= closest)), f64::INFINITY))
            .say("the children are counted from 1; they are 0 and 1")
            .when(|&(enters, closest)| to_visit(enters, closest).map(|child| child.map(|number| number + 1)))
            .say("the numbers are the wrong way round: the first of the two is child 0")
            .when(|&(enters, closest)| to_visit(enters, closest).map(|child| child.map(|number| 1 - number)))
            .say("a child is visited whose box the ray misses")
            .when(|&(enters, closest)| to_visit(enters.map(|t| Some(t.unwrap_or(0.0))), closest))
            .when(|&(enters, closest)| to_visit(enters.map(|t| Some(t.unwrap_or(1e300))), closest))
            .when(|&(enters, closest)| to_visit(enters.map(|t| Some(t.unwrap_or(-1.0))), closest))
            .say("nothing is visited unless both children are; where only one is, it is visited alone")
            .when(|&(enters, closest)| if enters.contains(&None) { [None; 2] } else { to_visit(enters, closest) })
            .when(
                |&(enters, closest)| {
                    if slots(enters, closest).contains(&None) { [None; 2] } else { to_visit(enters, closest) }
                },
            ),
        hints: &[
            "there are four cases: neither child is visited, only child 0, only child 1, or both",
            "a child is visited if the ray enters its box, and does so before `closest`",
            "of two children the one with the smaller t is first",
        ],
    }
}

fn farther_first(enters: [Option<f64>; 2], closest: f64) -> Answer {
    match to_visit(enters, closest) {
        [first, Some(second)] => [Some(second), first],
        order => order,
    }
}

/// Each visited child at its own place.
fn slots(enters: [Option<f64>; 2], closest: f64) -> Answer {
    [0, 1].map(|child| enters[child as usize].filter(|&t| t < closest).map(|_| child))
}

fn both_or_none(enters: [Option<f64>; 2], closest: f64) -> Answer {
    if to_visit(enters, closest) == [None; 2] { [None; 2] } else { to_visit(enters, f64::INFINITY) }
}

fn in_order((enters, closest): Input) -> Answer {
    match to_visit(enters, closest) {
        [Some(1), Some(0)] => [Some(0), Some(1)],
        order => order,
    }
}

fn asked() -> Vec<Probe<Input>> {
    let both = ([Some(1.0), Some(2.0)], f64::INFINITY);
    let mut asked: Vec<_> = probes("two boxes ahead", [both, ([Some(2.0), Some(1.0)], f64::INFINITY)]).collect();
    asked.extend(probes("one box missed", [([Some(1.0), None], 9.0), ([None, Some(1.0)], 9.0)]));
    asked.extend(probes("both missed", [([None, None], 9.0)]));
    asked.extend(probes("from inside both", [([Some(0.0), Some(0.0)], f64::INFINITY), ([Some(0.0), Some(0.0)], 3.0)]));
    asked.extend(probes("from inside one", [([Some(0.5), Some(0.0)], 3.0), ([Some(0.0), Some(0.5)], 3.0)]));
    asked.extend(probes(
        "a hit before one box",
        [([Some(1.0), Some(2.0)], 1.5), ([Some(2.0), Some(1.0)], 1.5), ([None, Some(2.0)], 1.5)],
    ));
    asked.extend(probes("a hit before both", [([Some(3.0), Some(2.0)], 1.5), ([Some(3.0), None], 1.5)]));
    asked.extend(probes("any boxes", (0..100).map(drawn)));
    asked
}

/// Boxes that are entered at different t, none of them exactly at the closest hit.
fn drawn(index: u64) -> Input {
    let mut draws = Draws::new(3003, index);
    let enters = [(); 2].map(|()| (draws.unit() < 0.75).then(|| draws.between(0.0, 4.0)));
    (enters, if draws.unit() < 0.25 { f64::INFINITY } else { draws.between(0.0, 6.0) })
}

/// Spheres through the plain tree of the page, whose children are visited as the reader says.
fn mine(ask: Ask<Input, Answer>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    let tree: Arc<OnceLock<Tree>> = Arc::default();
    StandIn::instead(
        intersect::sphere_stage,
        move |spheres: Res<Shared<SphereTable>>, mut tiles: Query<(RowPlaces, &WorldRays, &mut Hits)>| {
            let tree = tree.get_or_init(|| Tree::of_shapes(&spheres.row, by_cost));
            for (place, rays, mut hits) in &mut tiles {
                for row in 0..rays.rows() {
                    let ray = [rays.origin_of(row), rays.direction_of(row)];
                    let mut search = Search::new(ray, hits.t[row]);
                    let order = |enters, closest| ask.at(place, row, (enters, closest)).unwrap_or_default();
                    tree.closest(&mut search, &order, &mut |number| spheres.row[number].t(ray[0], ray[1]));
                    if search.t < hits.t[row] {
                        (hits.t[row], hits.shape[row]) = (search.t, spheres.shape[search.number]);
                    }
                }
            }
        },
    )
}

/// Where two boxes are entered: the first ever later to the right, the second further down, and neither at all at the ends;
/// on the right there is a hit. Red is whom to visit first, green whom second.
fn painted(ask: Ask<Input, Answer>) -> StandIn {
    let enters = |at: u32| (at < 28).then(|| f64::from(at) / 8.0 - 0.5);
    StandIn::painted([64, 32], move |[x, y]| {
        let closest = if x < 32 { f64::INFINITY } else { 2.05 };
        let order = ask.once(([enters(x % 32), enters(y)], closest)).unwrap_or_default();
        let colour = |child: Option<u32>| child.map_or(0.0, |child| 0.5 + 0.5 * f64::from(child));
        [colour(order[0]), colour(order[1]), 0.1]
    })
}
