//! Chapter 09: a normal, turned, stretched, mirrored and sheared with its surface, compared with exact arithmetic.

use super::mine::mine;
use glam::{DMat3, DQuat, DVec3};
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Exercise, Mistake, Probe, Question, Shown, probes};
use pinhole_lab::measure::exact::Dyadic;
use pinhole_lab::measure::exact_vector::ExactVector;
use pinhole_lab::measure::ray_aim::Draws;

pub(super) type Vector = [f64; 3];
/// The columns of the map, and the normal in object space.
pub(super) type Input = ([Vector; 3], Vector);

/// What the reader writes.
pub type Yours = fn([Vector; 3], Vector) -> Vector;

/// The exercise with the function as the reader has it now.
pub fn yours() -> Exercise {
    exercise(super::exercise::normal_world_from_object)
}

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("normal_world_from_object", question, move |&(columns, normal)| yours(columns, normal), mine)
}

fn question() -> Question<Input, Vector> {
    Question {
        pinhole_has: ("src/pinhole/extract/pose.rs", "normal_world_from_object"),
        probes: asked(),
        tell: |(columns, normal)| format!("columns {}, normal {}", columns.shown(), normal.shown()),
        right: |&(columns, normal)| {
            let normal = outward(columns, normal);
            let length = normal.length();
            [normal.x, normal.y, normal.z].map(|part| part.divided_by(&length).to_f64())
        },
        apart: |yours, right| absolute(yours, right),
        allowed: 1e-9,
        measured: "in a part",
        mistakes: vec![
            Mistake::new(
                "the normal is mapped as a direction is; where the map stretches unevenly it tips over",
                |input| (matrix(input) * DVec3::from(input.1)).normalize().into(),
            ),
            Mistake::new("the normal is not of length 1", |input| {
                (inverse_transpose(input) * DVec3::from(input.1)).into()
            }),
            Mistake::new("the inverse is not transposed, or the columns are taken for rows", |input| {
                (matrix(input).inverse() * DVec3::from(input.1)).normalize().into()
            }),
            Mistake::new(
                "a mirroring map turns the normal inside out: the sign of the determinant is missing",
                |input| {
                    let turn = if matrix(input).determinant() < 0.0 { -1.0 } else { 1.0 };
                    (turn * (inverse_transpose(input) * DVec3::from(input.1)).normalize()).into()
                },
            ),
            Mistake::new(
                "the normal points inward: nothing may turn it, for the inverse transpose keeps its side",
                |input| (-(inverse_transpose(input) * DVec3::from(input.1)).normalize()).into(),
            ),
        ],
        hints: &[
            "the normal must stay at a right angle to everything that lies in the surface: n · v = 0 must become \
             n' · Mv = 0",
            "n' · Mv = (Mᵀn') · v, so Mᵀn' = n will do: n' is the inverse of the transpose of M, times n, brought to \
             length 1",
            "with columns a, b, c that is (n.x b×c + n.y c×a + n.z a×b) / det, det = a · b×c; of det \
             only the sign is left in a unit vector, and in a mirroring map it is −1",
        ],
    }
}

fn asked() -> Vec<Probe<Input>> {
    let side = |x, y, z| DVec3::new(x, y, z).normalize().to_array();
    let stretched = |x, y, z| [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
    let (tilted, tipped) = (side(1.0, 1.0, 0.0), side(1.0, -2.0, 2.0));
    let some = |seed, map: fn(&mut Draws) -> DMat3| {
        (0..30).map(move |at| {
            let mut draws = Draws::new(seed, at);
            let columns = map(&mut draws).to_cols_array_2d();
            (columns, draws.unit_vector().to_array())
        })
    };
    let mut asked: Vec<_> = probes("nothing is changed", [(stretched(1.0, 1.0, 1.0), tilted)]).collect();
    asked.extend(probes("turned", some(901, turned)));
    asked.extend(probes("twice as large", [tilted, tipped].map(|n| (stretched(2.0, 2.0, 2.0), n))));
    asked.extend(probes("stretched unevenly", [tilted, tipped].map(|n| (stretched(2.0, 1.0, 1.0), n))));
    asked.extend(probes("stretched unevenly and turned", some(902, |draws| turned(draws) * scaled(draws, 1.0))));
    asked
        .extend(probes("sheared", [tilted, tipped].map(|n| ([[1.0, 0.0, 0.0], [0.75, 1.0, 0.0], [0.0, 0.0, 1.0]], n))));
    asked.extend(probes(
        "turned, stretched, turned again: sheared",
        some(903, |draws| turned(draws) * scaled(draws, 0.5) * turned(draws)),
    ));
    asked.extend(probes("mirrored", [tilted, tipped].map(|n| (stretched(-1.0, 1.0, 1.0), n))));
    asked.extend(probes("mirrored three times", [tilted, tipped].map(|n| (stretched(-1.0, -2.0, -3.0), n))));
    asked.extend(probes(
        "mirrored, stretched and turned",
        some(904, |draws| {
            turned(draws) * scaled(draws, 0.5) * DMat3::from_diagonal(DVec3::new(1.0, -1.0, 1.0)) * turned(draws)
        }),
    ));
    asked.extend(probes("a millionth of its size", [(stretched(1e-6, 2e-6, 1e-6), tipped)]));
    asked.extend(probes("nearly planar", [(stretched(1.0, 1e-6, 1.0), tipped), (stretched(1e6, 1.0, 1e6), tilted)]));
    asked
}

fn turned(draws: &mut Draws) -> DMat3 {
    let [x, y, z] = draws.unit_vector().to_array();
    DMat3::from_quat(DQuat::from_xyzw(x, y, z, draws.between(-2.0, 2.0)).normalize())
}

fn scaled(draws: &mut Draws, powers: f64) -> DMat3 {
    let mut factor = || draws.power_of_ten(-powers, powers);
    DMat3::from_diagonal(DVec3::new(factor(), factor(), factor()))
}

/// The inverse transpose times the normal, times the size of the determinant: exact, and of any length.
fn outward([a, b, c]: [Vector; 3], normal: Vector) -> ExactVector {
    let [a, b, c] = [a, b, c].map(ExactVector::of);
    let [x, y, z] = normal.map(Dyadic::of);
    let (bc, ca, ab) = (b.cross(&c).times(&x), c.cross(&a).times(&y), a.cross(&b).times(&z));
    let sign = Dyadic::of(a.dot(&b.cross(&c)).sign());
    let sum = |bc: &Dyadic, ca: &Dyadic, ab: &Dyadic| &(&(bc + ca) + ab) * &sign;
    ExactVector { x: sum(&bc.x, &ca.x, &ab.x), y: sum(&bc.y, &ca.y, &ab.y), z: sum(&bc.z, &ca.z, &ab.z) }
}

fn matrix(&(columns, _): &Input) -> DMat3 {
    DMat3::from_cols_array_2d(&columns)
}

fn inverse_transpose(input: &Input) -> DMat3 {
    matrix(input).inverse().transpose()
}
