//! Sampling rays in which light leaves towards mirrors and glass.

use super::light::{LightStart, StartDraws};
use crate::each::Each;
use crate::plan::VectorRows;
use crate::sample::disk_point;
use crate::shapes::emitter::{cone_direction, cone_versine};
use crate::shapes::{AnyShape, Bounds, l1_norm};
use glam::DVec3;
use multiversion::multiversion;
use std::f64::consts::{PI, TAU};

/// With more specular shapes than this, one sphere bounds them all.
pub const MAX_TARGETS: usize = 16;
/// Where paths start on a light with a position in all directions, this part of them starts towards mirrors and glass.
pub const TOWARDS: f64 = 0.25;
/// The factor by which a bounding sphere is enlarged, so that no rounding of a ray leads past it.
const MARGIN: f64 = 1.0 + 1e-5;
/// The rounding error of a ray in f32, relative to its origin and to the distance travelled.
const OF_PLACE: f64 = 1.0 / (1_u64 << 21) as f64;

/// A bounding sphere of mirrors or glass, towards which light paths start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Target {
    /// Relative to the eye.
    pub centre: DVec3,
    /// In scene units.
    pub radius: f64,
}

impl Target {
    /// A sphere that no rounding of a ray leads past.
    pub fn around((centre, radius): (DVec3, f64)) -> Self {
        Self { centre, radius: radius * MARGIN }
    }

    /// One sphere around several.
    pub fn around_all(targets: &[Self]) -> Self {
        let ends = targets.iter().map(|target| {
            let radius = DVec3::splat(target.radius);
            (target.centre - radius, target.centre + radius)
        });
        let (min, max) =
            ends.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |all, own| (all.0.min(own.0), all.1.max(own.1)));
        Self::around(Bounds { min, max }.sphere_around())
    }
}

/// The mirrors and the glass of a scene, as light paths start towards them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Targets {
    /// Spheres that together bound all mirrors and glass; none where one of these is infinite.
    pub sphere: Vec<Target>,
    /// A sphere around everything, where parallel light starts towards all shapes and not towards mirrors and glass alone.
    pub whole: Option<Target>,
    /// A sphere around every shape that is not infinite.
    pub scene: Target,
    /// The infinite shapes, none of them specular where there are targets: they hide targets from distant lights.
    pub infinite: Vec<AnyShape>,
}

impl Targets {
    /// Whether no light starts from outside.
    pub fn is_empty(&self) -> bool {
        self.sphere.is_empty() && self.whole.is_none()
    }

    /// The radius of the disk at right angles to parallel light that its rays through a target pass, enlarged by as
    /// much as a ray in f32 may miss it by.
    #[inline(always)]
    fn disk(&self, target: &Target) -> f64 {
        target.radius + (l1_norm(self.scene.centre) + 4.0 * self.scene.radius) * OF_PLACE
    }

    #[inline(always)]
    fn disk_area(&self, target: &Target) -> f64 {
        PI * self.disk(target) * self.disk(target)
    }

    /// The area of the disks of all targets, in square scene units: overlapping ones count once each.
    #[inline(always)]
    fn of_spheres(&self) -> f64 {
        self.sphere.iter().map(|target| self.disk_area(target)).sum()
    }

    /// The area that parallel light is sampled over, in square scene units: that of the disk of everything, or the sum of
    /// those of the targets.
    #[inline(always)]
    pub fn across(&self) -> f64 {
        self.whole.map_or_else(|| self.of_spheres(), |whole| self.disk_area(&whole))
    }

    /// By how many square scene units mirrors and glass are chosen together, and everything: one start in two goes towards
    /// each where there are both.
    #[inline(always)]
    fn chosen_by(&self) -> [f64; 2] {
        let of_spheres = self.of_spheres();
        match self.whole {
            Some(whole) if self.sphere.is_empty() => [0.0, self.disk_area(&whole)],
            Some(_) => [of_spheres; 2],
            None => [of_spheres, 0.0],
        }
    }

    /// How many targets a line of parallel light through a point passes, and how far from the point the first of them
    /// begins; it passes `chosen`, whatever rounding says. Everything counts as much as it is chosen more than for its area.
    #[inline(always)]
    fn passed(&self, direction: DVec3, point: DVec3, chosen: Option<usize>) -> (f64, f64) {
        let whole = self.whole.iter().map(|whole| (whole, self.chosen_by()[1] / self.disk_area(whole)));
        let targets = self.sphere.iter().map(|target| (target, 1.0)).chain(whole);
        let (mut passed, mut first) = (0.0, f64::INFINITY);
        for (number, (target, counts)) in targets.enumerate() {
            let to = target.centre - point;
            let (along, disk) = (to.dot(direction), self.disk(target));
            if chosen == Some(number) || (to - direction * along).length_squared() <= disk * disk {
                passed += counts;
                first = first.min(along - disk);
            }
        }
        (passed, first)
    }

    /// How far from a point a line of parallel light through it enters the scene, whose first target begins there.
    #[inline(always)]
    fn outside(&self, direction: DVec3, point: DVec3, first: f64) -> f64 {
        first.min((self.scene.centre - point).dot(direction) - self.scene.radius)
    }

    // ANCHOR: parallel_start
    /// Samples a ray of parallel light through one of the targets; its power is the irradiance times 1 over the pdf of
    /// its place, in square scene units.
    ///
    /// A target is chosen in proportion to the area of its disk, and a point uniformly on the disk.
    /// Where the ray passes one target only, the pdf is 1 over the sum of all areas A; where it passes n, it is n / A.
    /// It starts outside the scene, so that whatever is in front of the target blocks it.
    /// An infinite shape has no outside: where one of them crosses the ray before the first target, the power is 0.
    #[inline(always)]
    pub fn parallel_start(&self, direction: DVec3, irradiance: [f64; 3], draws: &StartDraws) -> LightStart {
        let [of_spheres, of_whole] = self.chosen_by();
        let all = of_spheres + of_whole;
        let targets = || self.sphere.iter().chain(&self.whole);
        let (mut left, mut chosen) = (draws.target * all, 0);
        while chosen + 1 < targets().count() && left >= self.disk_area(&self.sphere[chosen]) {
            left -= self.disk_area(&self.sphere[chosen]);
            chosen += 1;
        }
        let Some(target) = targets().nth(chosen) else { return LightStart::default() };
        let (right, up) = direction.any_orthonormal_pair();
        let [x, y] = disk_point(draws.point).point();
        let from_centre = (right * x + up * y) * self.disk(target);
        let middle = target.centre + from_centre;

        let (passed, first) = self.passed(direction, middle, Some(chosen));
        let nearest = middle + direction * first;
        if self.infinite.iter().any(|shape| shape.t(nearest, -direction) < f64::INFINITY) {
            return LightStart::default();
        }
        let origin = (middle + direction * self.outside(direction, middle, first)).as_vec3();
        let weight = all / passed;
        LightStart { origin, direction, power: irradiance.each(|part| part * weight) }
    }
    // ANCHOR_END: parallel_start

    /// The pdf with which [`Self::parallel_start`] samples the line through a point, in 1 over square scene units; 0 where it
    /// would start behind the point.
    #[inline(always)]
    pub fn parallel_pdf(&self, direction: DVec3, point: DVec3) -> f64 {
        let (passed, first) = self.passed(direction, point, None);
        let reaches = self.outside(direction, point, first) <= 0.0;
        if reaches { passed / self.chosen_by().iter().sum::<f64>() } else { 0.0 }
    }
}

/// Where paths start in all directions.
pub static NO_TARGETS: Targets = Targets {
    sphere: Vec::new(),
    whole: None,
    scene: Target { centre: DVec3::ZERO, radius: 0.0 },
    infinite: Vec::new(),
};

/// The axis of the cone that a sphere subtends from a point, and 1 − cos of its half angle; all directions from inside.
///
/// The sphere is enlarged by as much as a ray in f32 may miss it by.
#[inline(always)]
fn cone_to(target: &Target, from: DVec3) -> (DVec3, f64) {
    let to = target.centre - from;
    let dd = to.length_squared();
    let distance = dd.sqrt();
    let radius = target.radius + (l1_norm(from) + distance) * OF_PLACE;
    if distance <= radius { (DVec3::Z, 2.0) } else { (to / distance, cone_versine(radius * radius / dd)) }
}

/// How many directions are asked for at once.
pub const AT_ONCE: usize = 32;

/// Of points and a direction from each: 1 over 2π of the solid angles that targets subtend from the point, overlapping ones
/// once each, and how many of them the direction is in.
///
/// [`Cones`] say the same of one point.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
pub fn cones_around(
    targets: &[Target],
    from: &[[f64; AT_ONCE]; 3],
    direction: &[[f64; AT_ONCE]; 3],
) -> [[f64; AT_ONCE]; 2] {
    let mut all = [[0.0; AT_ONCE]; 2];
    for target in targets {
        for lane in 0..AT_ONCE {
            let (axis, whole) = cone_to(target, from.at(lane).into());
            let off = DVec3::from(direction.at(lane)) - axis;
            all[0][lane] += whole;
            all[1][lane] += if 0.5 * off.length_squared() <= whole { 1.0 } else { 0.0 };
        }
    }
    all
}

/// The cones that targets subtend from a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Cones {
    cone: [(DVec3, f64); MAX_TARGETS],
    count: usize,
    /// The sum of their solid angles, in sr.
    pub all: f64,
}

impl Cones {
    /// Those of some targets.
    #[inline(always)]
    pub fn new(targets: &[Target], from: DVec3) -> Self {
        let mut cone = [(DVec3::Z, 0.0); MAX_TARGETS];
        cone.iter_mut().zip(targets).for_each(|(cone, target)| *cone = cone_to(target, from));
        let all = TAU * cone[..targets.len()].iter().map(|(_, whole)| whole).sum::<f64>();
        Self { cone, count: targets.len(), all }
    }

    /// How many of them a direction is in; it is in `chosen`, whatever rounding says.
    #[inline(always)]
    pub fn around(&self, direction: DVec3, chosen: Option<usize>) -> usize {
        let own = self.cone[..self.count].iter().enumerate();
        own.filter(|(number, (axis, whole))| {
            chosen == Some(*number) || 0.5 * (direction - *axis).length_squared() <= *whole
        })
        .count()
    }

    // ANCHOR: direction_to_targets
    /// A direction to one of the targets, and 1 over its pdf, in sr.
    ///
    /// A target is chosen in proportion to its solid angle, and a direction uniformly in its cone.
    /// In the cone of a single target the pdf is 1 over the sum Ω of all solid angles; where n cones overlap it is n / Ω.
    #[inline(always)]
    pub fn sample(&self, choice: f64, u: [f64; 2]) -> (DVec3, f64) {
        let (mut left, mut chosen) = (choice * self.all, 0);
        while chosen + 1 < self.count && left >= TAU * self.cone[chosen].1 {
            left -= TAU * self.cone[chosen].1;
            chosen += 1;
        }
        let (axis, whole) = self.cone[chosen];
        let direction = cone_direction(axis, whole, u);
        (direction, self.all / self.around(direction, Some(chosen)) as f64)
    }
    // ANCHOR_END: direction_to_targets
}

/// The same; none where the targets subtend `limit` sr or more, or there is none.
#[inline(always)]
pub fn direction_to_targets(
    targets: &[Target],
    from: DVec3,
    limit: f64,
    choice: f64,
    u: [f64; 2],
) -> Option<(DVec3, f64)> {
    if targets.is_empty() {
        return None;
    }
    let cones = Cones::new(targets, from);
    (cones.all > 0.0 && cones.all < limit).then(|| cones.sample(choice, u))
}

/// Where the targets subtend more than this many sr, sampling directions towards them gains nothing.
pub const MAX_TARGETS_SOLID_ANGLE: f64 = PI;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;
    use crate::plan::VectorRowsMut;
    use crate::shapes::emitter::sphere_direction;

    /// Rays of parallel light towards balls of glass and towards everything have the pdf that is said of them, wherever they
    /// are asked for it after their start, and 0 before; it integrates to 1 over a plane across them.
    #[test]
    fn parallel_rays_have_their_pdf() {
        const TRIED: u64 = 40_000;
        let mut asked = 0;
        for index in 0..12 {
            let mut draws = Draws::new(2712, index);
            let of = |draws: &mut Draws| Target { centre: draws.unit_vector() * 2.0, radius: draws.between(0.2, 1.5) };
            let sphere: Vec<Target> = (0..index % 4).map(|_| of(&mut draws)).collect();
            let scene = Target { centre: DVec3::ZERO, radius: 4.0 };
            let whole = (index % 4 == 0 || index > 5).then_some(scene);
            let targets = Targets { sphere, whole, scene, infinite: Vec::new() };
            let direction = draws.unit_vector().normalize();
            let (right, up) = direction.any_orthonormal_pair();
            let (mut sum, mut squares) = (0.0, 0.0);
            for _ in 0..TRIED {
                let on_plane = right * draws.between(-5.0, 5.0) + up * draws.between(-5.0, 5.0);
                let value = 100.0 * targets.parallel_pdf(direction, on_plane + direction * 5.0);
                (sum, squares) = (sum + value, squares + value * value);
                let draws = StartDraws {
                    light: 0,
                    point: [draws.unit(), draws.unit()],
                    direction: [0.0; 2],
                    target: draws.unit(),
                    side: 0.0,
                };
                let start = targets.parallel_start(direction, [1.0; 3], &draws);
                let origin = start.origin.as_dvec3();
                for along in [1e-3, 3.0, 20.0] {
                    let pdf = targets.parallel_pdf(direction, origin + direction * along);
                    // On the edge of a disk rounding may say either.
                    asked += usize::from((pdf * start.power[0] - 1.0).abs() < 1e-9);
                }
                assert_eq!(targets.parallel_pdf(direction, origin - direction * 1e-3), 0.0, "{index}");
            }
            let n = TRIED as f64;
            let error = (squares / n - sum * sum / (n * n)).sqrt() / n.sqrt();
            assert!((sum / n - 1.0).abs() < 4.0 * error, "{index}: {} ± {error}", sum / n);
        }
        let all = 12 * 3 * TRIED as usize;
        assert!(all - asked < all / 10_000, "{} of {all} apart", all - asked);
        eprintln!("parallel rays: {asked} of {all} have their pdf, 12 integrals are 1");
    }

    /// Rows at once have the bits of one after another, from outside of targets and inside.
    #[test]
    fn cones_at_once_are_those_of_each_point() {
        const BLOCKS: u64 = 200;
        let mut within = 0;
        for index in 0..BLOCKS {
            let mut draws = Draws::new(2713, index);
            let of = |draws: &mut Draws| Target { centre: draws.unit_vector() * 3.0, radius: draws.between(0.1, 2.0) };
            let targets: Vec<Target> = (0..=index as usize % MAX_TARGETS).map(|_| of(&mut draws)).collect();
            let mut rays = [[[0.0; AT_ONCE]; 3]; 2];
            for lane in 0..AT_ONCE {
                rays[0].put(lane, draws.unit_vector() * draws.between(0.0, 4.0));
                rays[1].put(lane, draws.unit_vector().normalize());
            }
            let [wholes, passed] = cones_around(&targets, &rays[0], &rays[1]);
            for lane in 0..AT_ONCE {
                let cones = Cones::new(&targets, rays[0].at(lane).into());
                let around = cones.around(rays[1].at(lane).into(), None);
                assert_eq!((TAU * wholes[lane], passed[lane] as usize), (cones.all, around), "{index}, lane {lane}");
                within += usize::from(around > 0);
            }
        }
        eprintln!("cones: {} points, {within} directions to targets", BLOCKS as usize * AT_ONCE);
        assert!(within > 1000, "{within}");
    }

    /// Directions to targets, each weighted by 1 over its pdf, cover the union of the cones as uniform directions do.
    #[test]
    fn directions_to_targets_have_their_pdf() {
        const TRIED: u64 = 40_000;
        for index in 0..12 {
            let mut draws = Draws::new(2711, index);
            let targets: Vec<Target> = (0..3)
                .map(|_| Target { centre: draws.unit_vector().normalize() * 3.0, radius: draws.between(0.2, 2.0) })
                .collect();
            let within = |direction: DVec3| {
                targets.iter().any(|target| {
                    let (axis, whole) = cone_to(target, DVec3::ZERO);
                    0.5 * (direction - axis).length_squared() <= whole
                })
            };
            // The integrals of a smooth function of the direction, and of 1, agree with those over uniform directions.
            let function = |direction: DVec3| DVec3::new(1.0, 1.0 + direction.x, libm::exp(2.0 * direction.y));
            let (mut even, mut sampled, mut squares) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
            for _ in 0..TRIED {
                let direction = sphere_direction([draws.unit(), draws.unit()]);
                let value = function(direction) * if within(direction) { 4.0 * PI } else { 0.0 };
                (even, squares) = (even + value, squares + value * value);
                let (choice, u) = (draws.unit(), [draws.unit(), draws.unit()]);
                let sample = direction_to_targets(&targets, DVec3::ZERO, f64::INFINITY, choice, u);
                let (direction, weight) = sample.expect("targets");
                let value = function(direction) * weight;
                (sampled, squares) = (sampled + value, squares + value * value);
            }
            let n = TRIED as f64;
            let error = (squares / (n * n)).map(f64::sqrt);
            let off = (even - sampled) / n / error;
            assert!(off.abs().max_element() < 4.0, "{index}: {off}");
        }
        eprintln!("directions to targets: 12 sets of 3, {TRIED} each");
    }
}
