//! The exact oracle of a ray against a torus, by Descartes' rule of signs on ever smaller intervals (Vincent, Collins
//! and
//! Akritas): hit or miss without any rounding, and t to 2^-60, from the f32 ray and the f64 torus that a kernel sees.

use super::exact::Dyadic;
use super::exact_vector::{ExactVector, Vector};
use super::oracle_frustum::to_unit;
use glam::Vec3;
use pinhole::shapes::PlacedTorus;

/// c₀ + c₁x + … + c₄x⁴.
type Quartic = [Dyadic; 5];

/// The quartic along the ray, positive outside: (e + 2ft + gt²)² less 4a² times the square across.
fn quartic(origin: Vec3, direction: Vec3, torus: &PlacedTorus) -> Quartic {
    let unit = |v: ExactVector| to_unit(&torus.space, &v);
    let p = unit(Vector::of(origin).minus(&Vector::of(torus.space.centre)));
    let (q, a, b) = (unit(Vector::of(direction)), Dyadic::of(torus.major), Dyadic::of(torus.minor));
    let across = |v: &[Dyadic; 3], w: &[Dyadic; 3]| &(&v[0] * &w[0]) + &(&v[2] * &w[2]);
    let dot = |v: &[Dyadic; 3], w: &[Dyadic; 3]| &across(v, w) + &(&v[1] * &w[1]);
    let (e, f, g) = (&dot(&p, &p) + &(&a.squared() - &b.squared()), dot(&p, &q), dot(&q, &q));
    let four = a.squared().scaled(2);
    [
        &e.squared() - &(&four * &across(&p, &p)),
        (&(&e * &f).scaled(1) - &(&four * &across(&p, &q))).scaled(1),
        &(&f.squared().scaled(1) + &(&e * &g)).scaled(1) - &(&four * &across(&q, &q)),
        (&f * &g).scaled(2),
        g.squared(),
    ]
}

/// The quartic of x + 1.
fn moved_on(mut c: Quartic) -> Quartic {
    (0..4).for_each(|first| (first..4).rev().for_each(|power| c[power] = &c[power] + &c[power + 1]));
    c
}

/// The quartic of x times 2^power.
fn stretched(c: &Quartic, power: i32) -> Quartic {
    [0, 1, 2, 3, 4].map(|own| c[own].scaled(own as i32 * power))
}

/// The changes of sign of (1 + x)⁴ c(1 / (1 + x)): as many as c has roots in (0, 1), or an even number more.
fn changes(mut c: Quartic) -> usize {
    c.reverse();
    let signs: Vec<i32> = moved_on(c).iter().map(Dyadic::sign).filter(|&sign| sign != 0).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// The first root of the quartic on (0, 1), which is an interval that begins here and was halved this often; two roots
/// in one of 2^-300 are one.
fn first(c: &Quartic, begin: &Dyadic, halved: i32) -> Option<Dyadic> {
    let (changes, middle) = (changes(c.clone()), begin + &Dyadic::of(1).scaled(-1 - halved));
    if changes == 0 || (changes == 1 && *begin > Dyadic::of(1).scaled(60 - halved)) || halved >= 300 {
        return (changes > 0).then_some(middle);
    }
    let near = stretched(c, -1);
    let far = moved_on(near.clone());
    let at_middle = (far[0].sign() == 0).then(|| middle.clone());
    first(&near, begin, halved + 1).or(at_middle).or_else(|| first(&far, &middle, halved + 1))
}

/// The smallest t > 0 at which the ray intersects the torus, rounded to f64; nothing when it does not.
pub fn torus_t(origin: Vec3, direction: Vec3, torus: &PlacedTorus) -> Option<f64> {
    let (centre, radius) = torus.space.culling_sphere();
    let most = 2.0 * (origin.as_dvec3().distance(centre) + radius) / direction.as_dvec3().length();
    let (power, along) = (libm::log2(most).ceil() as i32, quartic(origin, direction, torus));
    Some(first(&stretched(&along, power), &Dyadic::of(0), 0)?.scaled(power).to_f64())
}
