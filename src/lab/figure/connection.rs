//! A path from a light whose vertices are connected to the camera, and below it a path from the camera through the same
//! pixel.

use super::Figure;
use super::angle::{arc, write, write_in};
use super::label::Label;
use super::pen::{Fill, IMAGE, INK, LIGHT, Pen, RAY};
use super::svg::{Drawing, Svg};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::Result;
use pinhole::extract::{AreaLightTable, CameraJoinTable, GlassTable, SphereTable, any_shapes, camera_entity};
use pinhole::lights::{MAX_TARGETS_SOLID_ANGLE, Target, direction_to_targets};
use pinhole::material::{cosine_direction, frame_of, mirror_direction, refract};
use pinhole::plan::{Census, Table};
use pinhole::rays::join_camera;
use pinhole::sample::square_of_disk;
use pinhole::scene::LookAt;
use pinhole::shapes::{AnyShape, sphere_t};
use pinhole::{Chapter, Overrides};

const HEIGHT: f64 = 796.0;
/// Units of the drawing for a scene unit, the point below the light in both drawings, and the ends of their floors.
const SCALE: f64 = 112.0;
const FEET: [DVec2; 2] = [DVec2::new(46.0, 304.0), DVec2::new(46.0, 690.0)];
const FLOOR: [f64; 2] = [-0.3, 5.95];
/// The eye in the section: how far behind the ball, how high; the camera looks at the floor this far behind the ball.
const EYE: [f64; 2] = [3.5, 2.15];
const LOOKED_AT: f64 = 1.4;
/// Which direction of the cone towards the ball the light path takes; and the camera path's, off the floor's normal.
const START: f64 = 0.6;
const BOUNCE: f64 = 0.15;
/// The directions that BSDF sampling is tried with at the floor: the square of this.
const TRIED: u32 = 256;
/// How far before the eye the image plane is drawn.
const PLANE: f64 = 0.85;

/// A centre and a radius.
type Sphere = (DVec3, f64);

/// The section through a chapter's light and its glass ball, in render space.
struct Plane {
    bodies: Vec<AnyShape>,
    join: CameraJoinTable,
    index: f64,
    lamp: Sphere,
    ball: Sphere,
    /// Level, from light to ball, and upward from the floor below the light.
    along: DVec3,
    foot: DVec3,
}

/// Both, in the vertical plane through light, ball and an eye that was moved there.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let mut scene = chapter.world(&Overrides::default());
    let Some(plane) = Plane::of(&mut scene)? else { return Err(figure.unsuited("a lamp and a ball of glass")) };
    let mut svg = Svg::new(figure.name, HEIGHT);
    let lit = plane.light_path();
    let Some(&end) = lit.last() else { return Err(figure.unsuited("light that reaches the floor")) };
    let Some(joined) = join_camera(&plane.join, DVec2::ZERO, end) else {
        return Err(figure.unsuited("a camera that sees the light"));
    };
    plane.paint(&mut svg, FEET[0], joined.raster.y);
    plane.paint(&mut svg, FEET[1], joined.raster.y);

    // From the light.
    let at = |point: DVec3| plane.at(FEET[0], point);
    for pair in lit.windows(2) {
        svg.arrow(at(pair[0]), at(pair[1]), Pen::new(LIGHT, 2.6));
    }
    for &specular in lit.iter().skip(1).take(lit.len() - 2) {
        svg.circle(at(specular), 5.0, Some(&Fill::new("var(--bg, #fff)", 1.0)), Some(Pen::new(INK, 1.6)));
    }
    svg.dot(at(end), 5.5, RAY);
    let free = !plane.blocked(end, joined.to_camera);
    svg.line(at(end), at(DVec3::ZERO), Pen::new(RAY, 2.4).dashed(if free { "8 5" } else { "2 5" }));
    let (normal, to_camera) = (DVec3::Y, joined.to_camera.normalize());
    svg.arrow(at(end), at(end) + DVec2::NEG_Y * 78.0, Pen::new(INK, 1.3));
    let on_page = |direction: DVec3| plane.direction(direction);
    let thin = Pen::new(INK, 1.2);
    let surface_at = arc(&mut svg, at(end), [DVec2::NEG_Y, on_page(to_camera)], 52.0, thin);
    let ahead = -plane.join.camera_from_world.row(2);
    svg.line(at(DVec3::ZERO), at(ahead * 1.9), Pen::new(INK, 1.0).faint(0.6).dashed("3 4"));
    let axis_at = arc(&mut svg, at(DVec3::ZERO), [on_page(ahead), on_page(-to_camera)], 170.0, thin);
    svg.label(Label::near(surface_at, "*θ*ₛ", DVec2::new(0.5, -1.0), 5.0).large());
    svg.label(Label::near(axis_at, "*θ*", DVec2::new(-1.0, -0.5), 8.0).large());
    svg.label(Label::near(at(end * 0.66), "*d*", DVec2::new(0.4, 1.0), 8.0).large().coloured(RAY));
    let entry = at(lit[1]);
    svg.label(Label::near(entry, "specular: not connected", DVec2::new(0.2, -1.0), 58.0).large());
    let distance = joined.to_camera.length();
    let (at_surface, at_camera) = (normal.dot(to_camera), ahead.dot(-to_camera));
    let below = FEET[0] + DVec2::Y * 28.0;
    let told = "adds *Φ* · *ρ*/π · cos *θ*ₛ / (*A d*² cos³ *θ*)";
    write(&mut svg, DVec2::new(14.0, below.y), "start", told);
    let told = format!("cos *θ*ₛ = {at_surface:.2}, *d* = {distance:.2}, cos *θ* = {at_camera:.3}");
    write(&mut svg, DVec2::new(14.0, below.y + 28.0), "start", &told);

    // From the camera.
    let at = |point: DVec3| plane.at(FEET[1], point);
    svg.arrow(at(DVec3::ZERO), at(end), Pen::new(RAY, 2.6));
    let seen = plane.camera_path(end);
    for pair in seen.windows(2) {
        svg.arrow(at(pair[0]), at(pair[1]), Pen::new(RAY, 2.6));
    }
    let to_lamp = plane.lamp.0 - end;
    let stopped = end + to_lamp.normalize() * plane.free_distance(end, to_lamp.normalize()).min(to_lamp.length());
    svg.line(at(end), at(stopped), Pen::new(LIGHT, 2.0).dashed("7 4"));
    svg.line(at(stopped), at(plane.lamp.0), Pen::new(LIGHT, 1.4).faint(0.6).dashed("2 5"));
    let across = DVec2::new(7.0, 7.0);
    for side in [across, across.perp()] {
        svg.line(at(stopped) - side, at(stopped) + side, Pen::new(INK, 2.2));
    }
    svg.dot(at(end), 5.5, RAY);
    if let Some(&out) = seen.last() {
        let told = if plane.is_on_lamp(out) { "hits the lamp" } else { "misses the lamp" };
        svg.label(Label::near(at(out), told, DVec2::new(0.4, -1.0), 10.0).large().coloured(RAY));
    }
    let below = FEET[1] + DVec2::Y * 28.0;
    let told = "light sampling: the ball blocks the shadow ray";
    write(&mut svg, DVec2::new(14.0, below.y), "start", told);
    let told = format!("BSDF sampling: {:.1} % of directions find the lamp", 100.0 * plane.fraction_to_lamp(end));
    write_in(&mut svg, DVec2::new(14.0, below.y + 28.0), "start", &told, RAY);
    let [x, y] = [joined.raster.x, joined.raster.y].map(|raster| raster.floor());
    let note = format!("in section · pixel {x},{y}, 1/(A d² cos³ θ) = {:.0}", joined.importance);
    let foot = format!("scene {}, {note} · cargo run --release -- figure {}", chapter.name, figure.name);
    Ok(svg.finish(figure.about, &foot))
}

impl Plane {
    /// Moves the camera into the vertical plane through light and ball; none where the scene lacks one of them.
    fn of(scene: &mut World) -> Result<Option<Self>> {
        let camera = camera_entity(scene)?;
        let eye = scene.get::<LookAt>(camera).map(|look| look.eye).unwrap_or_default();
        let Some((lamp, ball)) = Self::spheres(scene)? else { return Ok(None) };
        let (lamp, ball) = (lamp.0 + eye, ball.0 + eye);
        let along = ((ball - lamp) * DVec3::new(1.0, 0.0, 1.0)).normalize();
        let behind = |distance: f64, height: f64| DVec3::new(ball.x, height, ball.z) + along * distance;
        let eye = behind(EYE[0], EYE[1]);
        if let Some(mut look) = scene.get_mut::<LookAt>(camera) {
            (look.eye, look.target) = (eye, behind(LOOKED_AT, 0.0));
        }
        let census = &Census::of(scene);
        let glass = GlassTable::extract(census)?;
        let (Some((lamp, ball)), Some(&index)) = (Self::spheres(scene)?, glass.ior.first()) else { return Ok(None) };
        let foot = DVec3::new(lamp.0.x, -eye.y, lamp.0.z);
        let join = CameraJoinTable::extract(census)?;
        Ok(Some(Self { bodies: any_shapes(census)?, join, index, lamp, ball, along, foot }))
    }

    /// The first sphere that emits, and the first that does not, relative to the eye.
    fn spheres(scene: &World) -> Result<Option<(Sphere, Sphere)>> {
        let census = &Census::of(scene);
        let (table, lights) = (SphereTable::extract(census)?, AreaLightTable::extract(census)?);
        let of_kind = |emits: bool| {
            let is_of_kind = |row: &usize| lights.shape.contains(&table.shape[*row]) == emits;
            let row = (0..table.row.len()).find(is_of_kind)?;
            Some((table.row[row].centre, table.row[row].radius))
        };
        Ok(of_kind(true).zip(of_kind(false)))
    }

    /// A point in the drawing.
    fn at(&self, foot: DVec2, point: DVec3) -> DVec2 {
        foot + self.direction(point - self.foot) * SCALE
    }

    /// A direction in the drawing.
    fn direction(&self, direction: DVec3) -> DVec2 {
        DVec2::new(direction.dot(self.along), -direction.y)
    }

    /// How far a ray goes until it hits something.
    fn free_distance(&self, origin: DVec3, direction: DVec3) -> f64 {
        let origin = origin + direction * 1e-6;
        self.bodies.iter().map(|body| body.t(origin, direction)).fold(f64::INFINITY, f64::min)
    }

    fn blocked(&self, from: DVec3, to: DVec3) -> bool {
        self.free_distance(from + DVec3::Y * 1e-9, to.normalize()) < to.length() * (1.0 - 1e-6)
    }

    /// Of the directions that a sampling function makes from two numbers, the one in the section for the first number
    /// and the second, which turns them about their axis; the highest of the two in the plane, or the lowest.
    fn in_section(&self, number: f64, highest: bool, direction_of: impl Fn([f64; 2]) -> DVec3) -> DVec3 {
        let across = self.along.cross(DVec3::Y);
        let off = |turn: f64| direction_of([number, turn.rem_euclid(1.0)]).dot(across);
        let root = |from: f64| {
            let (mut low, mut high) = (from, from + 0.5);
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if (off(middle) > 0.0) == (off(low) > 0.0) { low = middle } else { high = middle }
            }
            direction_of([number, low.rem_euclid(1.0)])
        };
        // Half a turn apart, a direction is on either side of the plane, so there is one between.
        let pair = [root(0.0), root(0.5)];
        let first_is_higher = pair[0].y > pair[1].y;
        if first_is_higher == highest { pair[0] } else { pair[1] }
    }

    /// From the light through the ball to the floor: all vertices, the light's first.
    fn light_path(&self) -> Vec<DVec3> {
        let (centre, radius) = self.lamp;
        let target = Target { centre: self.ball.0, radius: self.ball.1 };
        let start = centre + (target.centre - centre).normalize() * radius;
        let sampled = |[fraction, turn]: [f64; 2]| {
            let limit = MAX_TARGETS_SOLID_ANGLE;
            let chosen =
                direction_to_targets(std::slice::from_ref(&target), start, limit, 0.0, square_of_disk(fraction, turn));
            chosen.map_or(DVec3::NEG_Y, |(direction, _)| direction)
        };
        let direction = self.in_section(START, true, sampled);
        let mut path = vec![start];
        path.extend(self.through_ball(start, direction));
        path
    }

    /// Into the ball and out of it again, and on to what is hit there: the points of both surfaces, and the end.
    fn through_ball(&self, from: DVec3, direction: DVec3) -> Vec<DVec3> {
        let (centre, radius) = self.ball;
        let t = sphere_t(from, direction, centre, radius);
        if t == f64::INFINITY {
            return Vec::new();
        }
        let entry = from + direction * t;
        let inward = refract(direction, (entry - centre) / radius, self.index);
        let inward = inward.unwrap_or_else(|| mirror_direction(direction, (entry - centre) / radius));
        let exit = entry + inward * (1e-6 + sphere_t(entry + inward * 1e-6, inward, centre, radius));
        let Some(outward) = refract(inward, (centre - exit) / radius, 1.0 / self.index) else {
            return vec![entry, exit];
        };
        let t = self.free_distance(exit, outward);
        let end = if t == f64::INFINITY { exit + outward * 2.2 } else { exit + outward * t };
        vec![entry, exit, end]
    }

    /// From the floor on in a direction that BSDF sampling may choose, through the ball.
    fn camera_path(&self, from: DVec3) -> Vec<DVec3> {
        let frame = frame_of(DVec3::Y);
        let sampled = |[fraction, turn]: [f64; 2]| frame * cosine_direction(square_of_disk(fraction, turn));
        let pair = self.in_section(BOUNCE, true, sampled);
        // Both are equally high; the one that leads back to the ball is wanted.
        let level = DVec3::new(pair.x, 0.0, pair.z).dot(self.along);
        let direction = if level < 0.0 { pair } else { pair - 2.0 * level * self.along };
        let mut path = vec![from];
        path.extend(self.through_ball(from, direction));
        path
    }

    fn is_on_lamp(&self, point: DVec3) -> bool {
        (point.distance(self.lamp.0) / self.lamp.1 - 1.0).abs() < 1e-3
    }

    /// The fraction of cosine-weighted directions from a point of the floor that lead through the ball to the light.
    fn fraction_to_lamp(&self, from: DVec3) -> f64 {
        let frame = frame_of(DVec3::Y);
        let number = |step: u32| (f64::from(step) + 0.5) / f64::from(TRIED);
        let finds = |[u, v]: [u32; 2]| {
            let direction = frame * cosine_direction([number(u), number(v)]);
            self.through_ball(from, direction).get(2).is_some_and(|&end| self.is_on_lamp(end))
        };
        let all = (0..TRIED).flat_map(|u| (0..TRIED).map(move |v| [u, v]));
        all.filter(|&numbers| finds(numbers)).count() as f64 / f64::from(TRIED * TRIED)
    }

    /// Floor, ball, light, and the camera with its image plane and this row of it.
    fn paint(&self, svg: &mut Svg, foot: DVec2, row: f64) {
        let at = |point: DVec3| self.at(foot, point);
        svg.line(foot + DVec2::X * (FLOOR[0] * SCALE), foot + DVec2::X * (FLOOR[1] * SCALE), Pen::new(INK, 2.0));
        let (fill, pen) = (Fill::new(IMAGE, 0.2), Pen::new(INK, 1.4));
        svg.circle(at(self.ball.0), self.ball.1 * SCALE, Some(&fill), Some(pen));
        svg.obstacles.discs.pop();
        let lamp = at(self.lamp.0);
        svg.circle(lamp, (self.lamp.1 * SCALE).max(6.0), Some(&Fill::new(LIGHT, 1.0)), None);
        svg.label(Label::near(lamp, "lamp", DVec2::new(0.4, -1.0), 9.0).large().coloured(LIGHT));
        let [up, back] = [1, 2].map(|row| self.join.camera_from_world.row(row));
        let height = |row: f64| up * (self.join.half_height * (1.0 - 2.0 * row / self.join.size.y));
        let on_plane = |row: f64| at((height(row) - back) * PLANE);
        svg.line(on_plane(0.0), on_plane(self.join.size.y), Pen::new(IMAGE, 2.2));
        let half = (on_plane(self.join.size.y) - on_plane(0.0)).normalize() * 5.0;
        svg.line(on_plane(row) - half, on_plane(row) + half, Pen::new(RAY, 6.0));
        svg.dot(at(DVec3::ZERO), 6.0, INK);
        svg.label(Label::near(at(DVec3::ZERO), "camera", DVec2::new(-0.2, -1.0), 10.0).large());
        svg.label(Label::near(on_plane(row), "pixel", DVec2::new(-0.5, 1.0), 14.0).large().coloured(IMAGE));
    }
}
