use super::emitter::{AreaSample, Emitting, LightPoint, pdf_from_area};
use super::frustum::Frustum;
use super::offset::l1_norm;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// A capped cylinder or cone as a light: the parts of its side and caps that are visible, by area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmittingFrustum {
    frustum: Frustum,
    /// The areas of its side, its bottom and its top.
    areas: [f64; 3],
    /// The volume in render space per unit of volume in unit space.
    volume: f64,
}

/// The parts of it that are sampled from a point.
struct Visible {
    /// The longitude in the middle of the visible side, and half the range of longitudes.
    longitude: f64,
    half: f64,
    /// The areas of side, bottom and top; 0 for those that are hidden.
    areas: [f64; 3],
}

impl EmittingFrustum {
    /// The frustum, if it is closed.
    pub fn new(frustum: &Frustum) -> Option<Self> {
        const STEPS: u32 = 64;
        let volume = frustum.space.world_from_unit.determinant().abs();
        let mut light = Self { frustum: *frustum, areas: [0.0; 3], volume };
        let round = (0..STEPS).map(|step| TAU * f64::from(step) / f64::from(STEPS));
        let [bottom, top] = [-1.0, 1.0].map(|end| frustum.radius(end));
        let side: f64 = round.map(|longitude| light.side(longitude).length()).sum();
        let cap = light.area_normal(DVec3::Y).length();
        light.areas =
            [side * TAU / f64::from(STEPS) * (bottom + top), PI * bottom * bottom * cap, PI * top * top * cap];
        frustum.capped.then_some(light)
    }

    /// The area in render space of a unit of area in unit space with this unit normal, as a vector along its normal there.
    #[inline(always)]
    fn area_normal(&self, normal: DVec3) -> DVec3 {
        self.frustum.space.unit_from_world.transpose() * normal * self.volume
    }

    /// The area vector of its side at a longitude, per unit of longitude, of height and of radius.
    #[inline(always)]
    fn side(&self, longitude: f64) -> DVec3 {
        let (sine, cosine) = libm::sincos(longitude);
        self.area_normal(DVec3::new(cosine, -self.frustum.profile[1], sine))
    }

    /// At a longitude φ the side faces p where ρ cos(φ − φ_p) > r(p_y).
    #[inline(always)]
    fn visible(&self, from: DVec3) -> Visible {
        let (p, [side, bottom, top]) = (self.frustum.space.point(from), self.areas);
        if self.frustum.contains(from) {
            return self.whole();
        }
        let (across, radius) = ((p.x * p.x + p.z * p.z).sqrt(), self.frustum.radius(p.y));
        let half = if across > radius.abs() {
            libm::acos(radius / across)
        } else if radius < 0.0 {
            PI
        } else {
            0.0
        };
        let areas = [side * half / PI, if p.y < -1.0 { bottom } else { 0.0 }, if p.y > 1.0 { top } else { 0.0 }];
        Visible { longitude: libm::atan2(p.z, p.x), half, areas }
    }

    fn whole(&self) -> Visible {
        Visible { longitude: 0.0, half: PI, areas: self.areas }
    }

    /// 1 over the pdf per unit of area at a longitude of the visible side, where points are uniform in longitude and, along
    /// the height, as the radius is.
    #[inline(always)]
    fn area_at(&self, visible: &Visible, side: DVec3) -> f64 {
        let ends = self.frustum.radius(-1.0) + self.frustum.radius(1.0);
        side.length() * ends * 2.0 * visible.half * visible.areas.iter().sum::<f64>() / visible.areas[0]
    }

    /// A visible point, its normal, and 1 over its pdf per unit of area.
    #[inline(always)]
    fn sample(&self, visible: &Visible, u: [f64; 2]) -> (DVec3, DVec3, f64) {
        let (space, [a, b], [side, bottom, top]) = (&self.frustum.space, self.frustum.profile, visible.areas);
        let all = side + bottom + top;
        let mut left = u[0] * all;
        if left < side || bottom + top == 0.0 {
            let longitude = visible.longitude + visible.half * (2.0 * (left / side).min(1.0) - 1.0);
            let ends = [-1.0, 1.0].map(|end| self.frustum.radius(end) * self.frustum.radius(end));
            let radius = (ends[0] + u[1] * (ends[1] - ends[0])).sqrt();
            let height = if b == 0.0 { 2.0 * u[1] - 1.0 } else { (radius - a) / b };
            let (outward, (sine, cosine)) = (self.side(longitude), libm::sincos(longitude));
            let own = DVec3::new(radius * cosine, height, radius * sine);
            return (space.centre + space.world_from_unit * own, outward.normalize(), self.area_at(visible, outward));
        }
        left -= side;
        let (up, area) = if left < bottom || top == 0.0 { (-1.0, bottom) } else { (1.0, top) };
        left -= if up > 0.0 { bottom } else { 0.0 };
        let radius = self.frustum.radius(up) * (left / area).clamp(0.0, 1.0).sqrt();
        let (sine, cosine) = libm::sincos(TAU * u[1]);
        let own = DVec3::new(radius * cosine, up, radius * sine);
        (space.centre + space.world_from_unit * own, self.area_normal(DVec3::Y * up).normalize(), all)
    }
}

impl Emitting for EmittingFrustum {
    const IS_CLOSED: bool = true;

    fn area(&self) -> f64 {
        self.areas.iter().sum()
    }

    fn faces(&self, point: DVec3) -> bool {
        !self.frustum.contains(point)
    }

    fn point(&self, from: DVec3, u: [f64; 2]) -> LightPoint {
        let visible = self.visible(from);
        if visible.areas == [0.0; 3] {
            return LightPoint::NONE;
        }
        let (point, normal, area) = self.sample(&visible, u);
        LightPoint { to: point - from, pdf: pdf_from_area(point - from, normal, area) }
    }

    fn pdf(&self, from: DVec3, at: DVec3) -> f64 {
        let (visible, own) = (self.visible(from), self.frustum.space.point(at));
        let [side, bottom, top] = visible.areas;
        let across = (own.x * own.x + own.z * own.z).sqrt();
        let cap = if own.y < 0.0 { bottom } else { top };
        if cap > 0.0 && (1.0 - own.y.abs()).abs() < (across - self.frustum.radius(own.y)).abs() {
            return pdf_from_area(at - from, self.area_normal(DVec3::Y).normalize(), side + bottom + top);
        }
        let outward = self.side(libm::atan2(own.z, own.x));
        let pdf = pdf_from_area(at - from, outward.normalize(), self.area_at(&visible, outward));
        if side > 0.0 { pdf } else { 0.0 }
    }

    fn distance(&self, from: DVec3, direction: DVec3) -> f64 {
        let intersection = self.frustum.intersection(from, direction);
        if intersection.uncertain { self.frustum.precise_t(from, direction) } else { intersection.t }
    }

    fn spot(&self, u: [f64; 2]) -> AreaSample {
        let (position, normal, area) = self.sample(&self.whole(), u);
        let size = l1_norm(self.frustum.space.centre) + self.frustum.space.culling_sphere().1;
        AreaSample { position, normal, area, size }
    }
}
