//! Chapter 31: the mask of the boxes that a ray enters.

use bevy_ecs::prelude::*;
use pinhole::bvh::Bvh;
use pinhole::extract::SphereTable;
use pinhole::intersect;
use pinhole::intersect::Hits;
use pinhole::plan::{Column, Shared};
use pinhole::rays::WorldRays;
use pinhole::shapes::{Shape, hierarchy_of};
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Probe, Question, RowPlaces, Setting, Shown, StandIn, extremes, probes,
};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::naive::wide::{closest, entered, first_planes};
use std::sync::{Arc, OnceLock};

/// Where the ray's line enters and leaves the boxes, and its closest hit so far.
type Input = ([f64; 8], [f64; 8], f64);

/// What the reader writes.
pub type Yours = fn([f64; 8], [f64; 8], f64) -> u32;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("entered", question, move |&(enters, leaves, closest)| yours(enters, leaves, closest), mine)
        .and_in("eight boxes in a row", |_| ())
}

fn question() -> Question<Input, u32> {
    Question {
        pinhole_has: ("src/pinhole/bvh/slab_test.rs", "enters"),
        probes: asked(),
        tell: |(enters, leaves, closest)| {
            format!("enters {}, leaves {}, closest {closest:?}", enters.shown(), leaves.shown())
        },
        right: |&(enters, leaves, closest)| entered(enters, leaves, closest),
        apart: |yours, right| f64::from((yours ^ right).count_ones()),
        allowed: 0.0,
        measured: "wrong bits",
        mistakes: Mistakes::<Input, u32>::new()
            .say("only the last box is in the mask; all that the ray enters are to be")
            .when(|&(enters, leaves, closest)| {
                entered(enters, leaves, closest).checked_ilog2().map_or(0, |bit| 1 << bit)
            })
            .say("nothing is asked after the first box behind the closest hit; the boxes are not sorted")
            .when(|&(enters, leaves, closest)| {
                let end = enters.iter().position(|&t| t > closest).unwrap_or(8);
                entered(enters, leaves, closest) & ((1 << end) - 1)
            })
            .say("only some of the boxes are asked; there are eight")
            .when(|&(enters, leaves, closest)| entered(enters, leaves, closest) & 15)
            .when(|&(enters, leaves, closest)| entered(enters, leaves, closest) & 127)
            .say("the numbers of the boxes are added; box i sets bit i, which is worth 2^i")
            .when(|&(enters, leaves, closest)| bits(entered(enters, leaves, closest)).sum())
            .when(|&(enters, leaves, closest)| 2 * bits(entered(enters, leaves, closest)).sum::<u32>())
            .when(|&(enters, leaves, closest)| bits(entered(enters, leaves, closest)).map(|i| i * i).sum())
            .say("nothing is asked after the first box that the ray misses; those after it may be entered")
            .when(|&(enters, leaves, closest)| {
                let mask = entered(enters, leaves, closest);
                mask & ((1 << mask.trailing_ones()) - 1)
            })
            .say("the bits are in the opposite order: bit 0 is the first box")
            .when(|&(enters, leaves, closest)| entered(enters, leaves, closest).reverse_bits() >> 24)
            .say("the bits begin with bit 1: bit 0 is the first box")
            .when(|&(enters, leaves, closest)| entered(enters, leaves, closest) << 1)
            .say("the mask is inverted: a bit is to be set where the ray enters the box")
            .when(|&(enters, leaves, closest)| 255 ^ entered(enters, leaves, closest))
            .say("the boxes are counted; asked is a mask, with one bit for each")
            .when(|&(enters, leaves, closest)| entered(enters, leaves, closest).count_ones())
            .say("only the first box is in the mask; all that the ray enters are to be")
            .when(|&(enters, leaves, closest)| {
                entered(enters, leaves, closest) & entered(enters, leaves, closest).wrapping_neg()
            })
            .say("only the nearest box is in the mask; all that the ray enters are to be")
            .when(|&(enters, leaves, closest)| nearest(enters, leaves, closest))
            .say("a box that begins behind the closest hit is entered; it cannot hold a closer one")
            .when(|&(enters, leaves, _)| entered(enters, leaves, f64::INFINITY))
            .say("a box behind the ray is one that it has left before t = 0")
            .when(|&(enters, leaves, closest)| those(|i| enters[i] <= leaves[i] && enters[i] <= closest))
            .say("a box counts wherever it is on the ray's line; it is to be there at a t from 0 to `closest`")
            .when(|&(enters, leaves, _)| those(|i| enters[i] <= leaves[i]))
            .say("a box is missed in which the ray starts; it was entered before t = 0")
            .when(|&(enters, leaves, closest)| {
                those(|i| enters[i] <= leaves[i] && enters[i] >= 0.0 && enters[i] <= closest)
            })
            .when(|&(enters, leaves, closest)| {
                those(|i| enters[i] <= leaves[i] && enters[i] > 0.0 && enters[i] <= closest)
            })
            .say("a ray misses a box that it leaves before it enters it")
            .when(|&(enters, leaves, closest)| those(|i| leaves[i] >= 0.0 && enters[i] <= closest))
            .say("a box that reaches behind the closest hit counts, too, where it begins before")
            .when(|&(enters, leaves, closest)| those(|i| enters[i].max(0.0) <= leaves[i] && leaves[i] <= closest))
            .when(|&(enters, leaves, closest)| those(|i| enters[i].max(0.0) <= leaves[i] && leaves[i] < closest))
            .say("the comparison with the closest hit is the wrong way round: a box that begins behind it is missed")
            .when(|&(enters, leaves, closest)| those(|i| enters[i].max(0.0) <= leaves[i] && enters[i] >= closest))
            .say("flat boxes are lost: where a ray enters and leaves at the same t, it does enter")
            .when(|&(enters, leaves, closest)| those(|i| enters[i].max(0.0) < leaves[i].min(closest)))
            .when(|&(enters, leaves, closest)| {
                those(|i| enters[i] < leaves[i] && leaves[i] >= 0.0 && enters[i] <= closest)
            })
            .when(|&(enters, leaves, closest)| {
                those(|i| enters[i] < leaves[i] && leaves[i] > 0.0 && enters[i] < closest)
            })
            .say("a box that begins just at the closest hit is not behind it, so it counts")
            .when(|&(enters, leaves, closest)| those(|i| enters[i].max(0.0) <= leaves[i] && enters[i] < closest))
            .say("a box that the ray leaves just at t = 0 counts: the ray begins there")
            .when(|&(enters, leaves, closest)| those(|i| enters[i] <= leaves[i].min(closest) && leaves[i] > 0.0))
            .say("a box that just ends at 0, or begins at the closest hit, counts")
            .when(|&(enters, leaves, closest)| {
                those(|i| enters[i] <= leaves[i] && leaves[i] > 0.0 && enters[i] < closest)
            })
            .say(
                "the boxes are compared with one another; `closest` is of a hit, and a box that is entered is none \
                 yet",
            )
            .when(|&(enters, leaves, closest)| one_by_one(enters, leaves, closest, |_, leaves| leaves))
            .when(|&(enters, leaves, closest)| one_by_one(enters, leaves, closest, |enters, _| enters.max(0.0)))
            .when(|&(enters, leaves, closest)| one_by_one(enters, leaves, closest, |enters, _| enters)),
        hints: &[
            "one box first: the part of it that the ray can still use begins at max(enters, 0)",
            "and where does it end, if there is a hit already? the box counts if anything is left, be it a point",
            "a mask with a single bit is 1, shifted; how are two masks put together?",
        ],
    }
}

fn those(mut are: impl FnMut(usize) -> bool) -> u32 {
    (0..8).map(|child| u32::from(are(child)) << child).sum()
}

/// Of the boxes that are entered, the one that is so first.
/// The numbers of the bits that are set.
fn bits(mask: u32) -> impl Iterator<Item = u32> {
    (0..8).filter(move |bit| mask >> bit & 1 == 1)
}

fn nearest(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
    let mask = entered(enters, leaves, closest);
    let first = (0..8).filter(|child| mask >> child & 1 == 1).min_by(|&a, &b| enters[a].total_cmp(&enters[b]));
    first.map_or(0, |child| 1 << child)
}

/// Each box that is entered makes the closest hit closer.
fn one_by_one(enters: [f64; 8], leaves: [f64; 8], mut closest: f64, closer: fn(f64, f64) -> f64) -> u32 {
    those(|i| {
        let is_entered = enters[i].max(0.0) <= leaves[i].min(closest);
        closest = if is_entered { closest.min(closer(enters[i], leaves[i])) } else { closest };
        is_entered
    })
}

fn asked() -> Vec<Probe<Input>> {
    let row = |first: f64| [0, 1, 2, 3, 4, 5, 6, 7].map(|child| first + f64::from(child));
    let far = f64::INFINITY;
    let mut asked: Vec<_> = probes("eight boxes in a row", [(row(1.0), row(1.5), far)]).collect();
    asked.extend(probes("some behind a hit", [(row(1.0), row(1.5), 3.25), (row(1.0), row(9.0), 6.5)]));
    asked.extend(probes("some behind the ray", [(row(-4.5), row(-4.25), far)]));
    asked.extend(probes("from inside some", [(row(-4.5), row(2.25), far), ([-1.0; 8], row(-3.5), 2.0)]));
    asked.extend(probes("all missed", [(row(2.0), row(1.5), far)]));
    // The box of a child that is not there.
    asked.extend(probes(
        "a node of three children",
        [{
            let (mut enters, mut leaves) = (row(1.0), row(1.5));
            (3..8).for_each(|child| (enters[child], leaves[child]) = (1e30, -1e30));
            (enters, leaves, far)
        }],
    ));
    asked.extend(probes("flat boxes", [(row(1.0), row(1.0), far), (row(-3.5), row(-3.5), 2.25)]));
    asked.extend(probes("any boxes", (0..200).map(drawn)));
    asked.extend(extremes(
        "one that begins just at the closest hit",
        [(row(1.0), row(1.5), 3.0), (row(1.0), row(9.0), 5.0)],
    ));
    asked.extend(extremes(
        "one that ends just at the ray's origin",
        [(row(-4.5), row(-4.0), far), (row(-5.0), row(-3.0), 9.0)],
    ));
    asked
}

fn drawn(index: u64) -> Input {
    let mut draws = Draws::new(3102, index);
    let enters = [(); 8].map(|()| draws.between(-3.0, 5.0));
    let leaves = enters.map(|t| t + draws.between(-1.0, 3.0));
    (enters, leaves, if draws.unit() < 0.25 { f64::INFINITY } else { draws.between(0.0, 6.0) })
}

/// Spheres through the wide tree in plain f64, with the reader's mask at every node.
fn mine(ask: Ask<Input, u32>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    let tree: Arc<OnceLock<Bvh>> = Arc::default();
    StandIn::instead(
        intersect::sphere_stage,
        move |spheres: Res<Shared<SphereTable>>, mut tiles: Query<(RowPlaces, &WorldRays, &mut Hits)>| {
            // Spheres are bounded.
            let tree = tree.get_or_init(|| hierarchy_of(&spheres.row).unwrap_or_default());
            for (place, rays, mut hits) in &mut tiles {
                for row in 0..rays.rows() {
                    let ray = [rays.origin_of(row), rays.direction_of(row)];
                    let mask = |enters, leaves, t| ask.at(place, row, (enters, leaves, t)).unwrap_or(0);
                    let t_of = |number: usize| spheres.row[number].t(ray[0], ray[1]);
                    let (t, number) = closest(tree, (ray, first_planes(ray[1])), hits.t[row], mask, t_of);
                    if t < hits.t[row] {
                        (hits.t[row], hits.shape[row]) = (t, spheres.shape[number]);
                    }
                }
            }
        },
    )
}

/// Eight boxes behind each other, every third of them flat: ever farther ahead to the right, and further down with a hit
/// that is farther away. The colours are the bits.
fn painted(ask: Ask<Input, u32>) -> StandIn {
    StandIn::painted([64, 32], move |[x, y]| {
        let enters = [0, 1, 2, 3, 4, 5, 6, 7].map(|child| 0.75 * f64::from(child) + 0.125 * f64::from(x) - 6.0);
        let mut leaves = enters.map(|t| t + 0.5);
        (leaves[0], leaves[3], leaves[6]) = (enters[0], enters[3], enters[6]);
        let mask = ask.once((enters, leaves, 0.25 * f64::from(y))).unwrap_or_default();
        let part = |shift: u32, bits: u32| f64::from(mask >> shift & bits) / f64::from(bits);
        [part(0, 7), part(3, 7), part(6, 3)]
    })
}
