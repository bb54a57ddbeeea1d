//! Chapter 31: the mask of the boxes that a ray enters.

use super::mine::mine;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::ray_aim::Draws;
use pinhole_lab::naive::wide::entered;

/// Where the ray's line enters and leaves the boxes, and its closest hit so far.
pub(super) type Input = ([f64; 8], [f64; 8], f64);

/// What the reader writes.
pub type Yours = fn([f64; 8], [f64; 8], f64) -> u32;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::entered)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("entered", question, move |&(enters, leaves, closest)| yours(enters, leaves, closest), mine)
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
        mistakes: vec![
            Mistake::new("bit 0 is the first box: yours are in the opposite order", |&(enters, leaves, closest)| {
                entered(enters, leaves, closest).reverse_bits() >> 24
            }),
            Mistake::new(
                "a box that begins behind the closest hit cannot hold a closer one",
                |&(enters, leaves, _)| entered(enters, leaves, f64::INFINITY),
            ),
            Mistake::new("a box behind the ray is one that it has left before t = 0", |&(enters, leaves, closest)| {
                those(|i| enters[i] <= leaves[i] && enters[i] <= closest)
            }),
            Mistake::new(
                "a ray that starts from inside a box has entered it before t = 0",
                |&(enters, leaves, closest)| {
                    those(|i| enters[i] <= leaves[i] && enters[i] >= 0.0 && enters[i] <= closest)
                },
            ),
            Mistake::new("a ray misses a box that it leaves before it enters it", |&(enters, leaves, closest)| {
                those(|i| leaves[i] >= 0.0 && enters[i] <= closest)
            }),
        ],
        hints: &[
            "one box first: the part of it that the ray can still use begins at max(enters, 0)",
            "and it ends at min(leaves, closest): the box counts if that is not before the beginning",
            "box i sets the bit 1 << i; several bits are put together by |",
        ],
    }
}

fn those(are: impl Fn(usize) -> bool) -> u32 {
    (0..8).map(|child| u32::from(are(child)) << child).sum()
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
    asked.extend(probes("any boxes", (0..200).map(drawn)));
    asked
}

fn drawn(index: u64) -> Input {
    let mut draws = Draws::new(3102, index);
    let enters = [(); 8].map(|()| draws.between(-3.0, 5.0));
    let leaves = enters.map(|t| t + draws.between(-1.0, 3.0));
    (enters, leaves, if draws.unit() < 0.25 { f64::INFINITY } else { draws.between(0.0, 6.0) })
}
