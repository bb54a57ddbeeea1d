//! The exact oracle of a ray against a torus, by Descartes' rule of signs on ever smaller intervals (Vincent, Collins
//! and Akritas): hit or miss without any rounding, and t to 2^-60, from the f32 ray and the f64 torus that a kernel sees.

use super::enclosure::Enclosure;
use super::exact::Dyadic;
use super::exact_vector::Vector;
use super::number::Number;
use super::oracle_frustum::to_unit;
use glam::{DVec3, Vec3};
use pinhole::shapes::PlacedTorus;

/// c₀ + c₁x + … + c₄x⁴.
type Quartic<N> = [N; 5];

/// 2^power.
fn two_to<N: Number>(power: i32) -> N {
    N::of(libm::ldexp(1.0, power))
}

/// A point in unit space, and what its distance from the torus is made of: p·p + a² − b², and 4a².
fn unit_point<N: Number>(point: &Vector<N>, torus: &PlacedTorus) -> ([N; 3], N, N) {
    let p = to_unit(&torus.space, &point.minus(&Vector::of(torus.space.centre)));
    let (a, b) = (N::of(torus.major), N::of(torus.minor));
    let square = a.by(&a);
    let e = dot(&p, &p).plus(&square.less(&b.by(&b)));
    (p, e, N::of(4.0).by(&square))
}

/// The product of the parts across the axis.
fn across<N: Number>(v: &[N; 3], w: &[N; 3]) -> N {
    v[0].by(&w[0]).plus(&v[2].by(&w[2]))
}

fn dot<N: Number>(v: &[N; 3], w: &[N; 3]) -> N {
    across(v, w).plus(&v[1].by(&w[1]))
}

/// The quartic along the ray, positive outside: (e + 2ft + gt²)² less 4a² times the square across.
fn quartic<N: Number>(origin: Vec3, direction: Vec3, torus: &PlacedTorus) -> Quartic<N> {
    let (p, e, four) = unit_point::<N>(&Vector::of(origin), torus);
    let (q, two) = (to_unit(&torus.space, &Vector::of(direction)), N::of(2.0));
    let (f, g) = (dot(&p, &q), dot(&q, &q));
    [
        e.by(&e).less(&four.by(&across(&p, &p))),
        two.by(&two.by(&e.by(&f)).less(&four.by(&across(&p, &q)))),
        two.by(&two.by(&f.by(&f)).plus(&e.by(&g))).less(&four.by(&across(&q, &q))),
        N::of(4.0).by(&f.by(&g)),
        g.by(&g),
    ]
}

/// The quartic of x + 1.
fn moved_on<N: Number>(mut c: Quartic<N>) -> Quartic<N> {
    (0..4).for_each(|first| (first..4).rev().for_each(|power| c[power] = c[power].plus(&c[power + 1])));
    c
}

/// The quartic of x times 2^power.
fn stretched<N: Number>(c: &Quartic<N>, power: i32) -> Quartic<N> {
    [0, 1, 2, 3, 4].map(|own| c[own].by(&two_to(own as i32 * power)))
}

/// The changes of sign of (1 + x)⁴ c(1 / (1 + x)): as many as c has roots in (0, 1), or an even number more; nothing
/// where these numbers cannot tell.
fn changes<N: Number>(mut c: Quartic<N>) -> Option<usize> {
    c.reverse();
    let mut signs = Vec::with_capacity(5);
    for coefficient in moved_on(c) {
        signs.push(coefficient.sign()?);
    }
    signs.retain(|&sign| sign != 0);
    Some(signs.windows(2).filter(|pair| pair[0] != pair[1]).count())
}

/// The first root of the quartic on (0, 1), which is an interval that begins here and was halved this often, if there
/// is one; nothing where these numbers cannot tell.
///
/// Two roots in one interval of 2^-300 are one.
fn first<N: Number>(c: &Quartic<N>, begin: &N, halved: i32) -> Option<Option<N>> {
    let (changes, middle) = (changes(c.clone())?, begin.plus(&two_to(-1 - halved)));
    let is_known = changes == 1 && begin.less(&two_to(60 - halved)).sign()? > 0;
    if changes == 0 || is_known || halved >= 300 {
        return Some((changes > 0).then_some(middle));
    }
    let near = stretched(c, -1);
    let far = moved_on(near.clone());
    if let Some(found) = first(&near, begin, halved + 1)? {
        return Some(Some(found));
    }
    if far[0].sign()? == 0 {
        return Some(Some(middle));
    }
    first(&far, &middle, halved + 1)
}

/// The smallest t > 0 at which the ray intersects the torus, if it does; nothing where these numbers cannot tell.
fn hit<N: Number>(origin: Vec3, direction: Vec3, torus: &PlacedTorus) -> Option<Option<f64>> {
    let (centre, radius) = torus.space.culling_sphere();
    let max = 2.0 * (origin.as_dvec3().distance(centre) + radius) / direction.as_dvec3().length();
    let power = libm::log2(max).ceil() as i32;
    let along = quartic::<N>(origin, direction, torus);
    match first(&stretched(&along, power), &N::of(0.0), 0)? {
        None => Some(None),
        Some(part) => part.by(&two_to(power)).rounded().map(Some),
    }
}

/// The smallest t > 0 at which the ray intersects the torus, rounded to f64; nothing when it does not.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn torus_t(origin: Vec3, direction: Vec3, torus: &PlacedTorus) -> Option<f64> {
    enclosed_torus_t(origin, direction, torus).unwrap_or_else(|| exact_torus_t(origin, direction, torus))
}

/// The same by enclosures; nothing where these cannot tell.
pub fn enclosed_torus_t(origin: Vec3, direction: Vec3, torus: &PlacedTorus) -> Option<Option<f64>> {
    hit::<Enclosure>(origin, direction, torus)
}

/// The same in exact arithmetic alone.
pub fn exact_torus_t(origin: Vec3, direction: Vec3, torus: &PlacedTorus) -> Option<f64> {
    hit::<Dyadic>(origin, direction, torus).flatten()
}

/// 1 where the point lies outside the torus, −1 inside, 0 on it, exactly.
///
/// # Panics
/// When an input is not finite.
#[must_use]
pub fn side_of_torus(point: DVec3, torus: &PlacedTorus) -> i32 {
    fn side<N: Number>(point: DVec3, torus: &PlacedTorus) -> Option<i32> {
        let (p, e, four) = unit_point::<N>(&Vector::of(point), torus);
        e.by(&e).less(&four.by(&across(&p, &p))).sign()
    }
    side::<Enclosure>(point, torus).or_else(|| side::<Dyadic>(point, torus)).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;
    use crate::measure::oracle::Oracle;
    use crate::measure::ray_aim::rounded_ray;
    use crate::measure::specimen::Specimen;

    #[test]
    fn enclosures_tell_what_exact_arithmetic_tells() {
        const RAYS: u64 = 400;
        let (mut told, mut hits) = (0, 0);
        for index in 0..RAYS {
            let mut draws = Draws::new(641, index);
            let away = draws.power_of_ten(-1.0, 5.0);
            let specimen = Specimen::<PlacedTorus>::drawn(&mut draws, [-4.0, 4.0], away).expect("an accepted torus");
            let torus = &specimen.shape;
            let (point, radius) = (specimen.aim(&mut draws), specimen.sphere_around().1);
            // Close to the tube and at its silhouette, where half the rays miss.
            let aim = point + draws.unit_vector() * (radius * torus.minor * draws.between(0.0, 1.5));
            let ray = rounded_ray(Vec3::ZERO, aim);
            let exact = exact_torus_t(ray.origin, ray.direction, torus);
            hits += u64::from(exact.is_some());
            if let Some(enclosed) = enclosed_torus_t(ray.origin, ray.direction, torus) {
                assert_eq!(enclosed.map(f64::to_bits), exact.map(f64::to_bits), "{ray:?}, {torus:?}");
                told += 1;
            }
            assert_eq!(torus.exact_side(point), -1, "{torus:?}");
        }
        eprintln!("tori: {told} of {RAYS} rays told by enclosures as by exact arithmetic, {hits} of all hit");
        assert!(told > RAYS * 3 / 4 && hits > RAYS / 5 && hits < RAYS * 9 / 10, "{told} told, {hits} hit");
    }
}
