//! A path through a room in section: its vertices, its cosines, its throughput, and the shadow rays to the light.

use super::Figure;
use super::angle::{arc, write, write_in};
use super::label::Label;
use super::pen::{Fill, IMAGE, INK, LIGHT, Pen, RAY};
use super::svg::{Drawing, Svg};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::Result;
use pinhole::extract::{AreaLightTable, MaterialTable, NO_ROW, ShapeTable, SphereTable, any_shapes, camera_entity};
use pinhole::material::{Bsdf, MatteTable, Parameters, ShadingContext, frame_of};
use pinhole::plan::{Census, Table};
use pinhole::sample::square_of_disk;
use pinhole::scene::LookAt;
use pinhole::shade::irradiance_from_area;
use pinhole::shapes::{AnyShape, Emitter, RayHit, point_on};
use pinhole::{Chapter, Overrides};
use std::f64::consts::{FRAC_1_PI, TAU};

const HEIGHT: f64 = 580.0;
/// Units of the drawing for a scene unit, and where the scene's z = 0 and y = 0 lie.
const SCALE: f64 = 192.0;
const ORIGIN: DVec2 = DVec2::new(494.0, 430.0);
/// The eye's distance before the room's middle, nearer than the chapter's, so that the room is large.
const EYE_Z: f64 = 2.2;
/// The slope of the camera ray, and the random numbers that choose the angles of the three others; all directions stay
/// in the section.
const FIRST_SLOPE: f64 = -0.36;
const TURNS: [f64; 3] = [-0.22, -0.417, -0.0154];
/// The red component stands for all three.
const RED: usize = 0;

/// A vertex of the path.
struct Vertex {
    position: DVec3,
    normal: DVec3,
    albedo: [f64; 3],
}

/// What a light sends to a vertex.
struct Arriving {
    to: DVec3,
    blocked: bool,
    /// Red irradiance.
    irradiance: f64,
}

/// The chapter's room cut through the eye and the middle of its light.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let mut scene = chapter.world(&Overrides::default());
    let camera = camera_entity(&scene)?;
    let Some(mut look) = scene.get_mut::<LookAt>(camera) else { return Err(figure.unsuited("a camera that looks at")) };
    look.eye.z = EYE_Z;
    let eye = look.eye;
    let room = Room::of(&scene)?;
    let Some(&lamp) = room.lights.emitter.first() else { return Err(figure.unsuited("an area light")) };
    let at = |point: DVec3| ORIGIN + SCALE * DVec2::new(-(point.z + eye.z), -(point.y + eye.y));
    let on_page = |direction: DVec3| DVec2::new(-direction.z, -direction.y);

    let mut svg = Svg::new(figure.name, HEIGHT);
    room.paint(&scene, &mut svg, at, eye)?;
    let (mut from, mut direction) = (DVec3::ZERO, DVec3::new(0.0, FIRST_SLOPE, -1.0).normalize());
    let mut throughput = [1.0; 3];
    let eye_at = at(from);
    svg.dot(eye_at, 5.0, INK);
    svg.label(Label::near(eye_at, "eye", DVec2::new(-0.3, -1.0), 8.0).large());
    for number in 0..=TURNS.len() {
        // Off a surface that the section does not cut at right angles, the path would leave it.
        let vertex = room.hit(from, direction).filter(|vertex| vertex.normal.x.abs() < 1e-9);
        let Some(vertex) = vertex else { return Err(figure.unsuited("a room whose walls reflect within the section")) };
        let place = at(vertex.position);
        svg.arrow(at(from), place, Pen::new(RAY, 2.6));
        let normal = on_page(vertex.normal);
        svg.arrow(place, place + normal * 66.0, Pen::new(INK, 1.3));
        let light = room.light_at(&vertex, &lamp);
        let seen = light.irradiance > 0.0 && !light.blocked;
        let end = at(vertex.position + light.to);
        let pen = if seen { Pen::new(LIGHT, 1.8).dashed("7 4") } else { Pen::new(INK, 1.3).faint(0.6).dashed("2 5") };
        svg.line(place, end, pen);
        svg.dot(place, 5.0, RAY);
        let outward = Label::near(place, &format!("*x*{}", lowered(number)), -normal, 10.0);
        svg.label(outward.large().coloured(RAY));

        let brought = if seen { throughput[RED] * vertex.albedo[RED] * FRAC_1_PI * light.irradiance } else { 0.0 };
        let column = DVec2::new(20.0 + 175.0 * number as f64, 480.0);
        let told = format!("*β*{} = {}", lowered(number), short(throughput[RED]));
        write(&mut svg, column, "start", &told);
        let told = if seen { format!("light {brought:.2}") } else { "no light".into() };
        write_in(&mut svg, column + DVec2::Y * 28.0, "start", &told, if seen { LIGHT } else { INK });
        let Some(&turn) = TURNS.get(number) else { break };
        let (next, weight) = room.bounce(&vertex, turn);
        let cosine = next.dot(vertex.normal);
        let middle = arc(&mut svg, place, [normal, on_page(next)], 44.0, Pen::new(INK, 1.2));
        let beside = (on_page(next) + normal).normalize_or(normal);
        svg.label(Label::near(middle, &format!("*θ*{}", lowered(number + 1)), beside, 5.0).large());
        let told = format!("cos *θ*{} = {cosine:.2}", lowered(number + 1));
        write(&mut svg, column + DVec2::Y * 56.0, "start", &told);
        throughput = [0, 1, 2].map(|part| throughput[part] * weight[part]);
        (from, direction) = (vertex.position + vertex.normal * 1e-9, next);
    }
    let note = format!("in section, the eye moved to z = {EYE_Z} · red parts");
    let foot = format!("scene {}, {note} · cargo run --release -- figure {}", chapter.name, figure.name);
    Ok(svg.finish(figure.about, &foot))
}

/// The room's shapes and lights, in render space.
struct Room {
    bodies: Vec<AnyShape>,
    shapes: ShapeTable,
    materials: MaterialTable,
    lights: AreaLightTable,
}

impl Room {
    fn of(scene: &World) -> Result<Self> {
        let census = &Census::of(scene);
        Ok(Self {
            bodies: any_shapes(census)?,
            shapes: ShapeTable::extract(census)?,
            materials: MaterialTable::extract(census)?,
            lights: AreaLightTable::extract(census)?,
        })
    }

    /// The nearest surface along a ray, if it is one that reflects.
    fn hit(&self, origin: DVec3, direction: DVec3) -> Option<Vertex> {
        let distance = |shape: &usize| self.bodies[*shape].t(origin, direction);
        let shape = (0..self.bodies.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let (t, material) = (distance(&shape), self.shapes.material[shape]);
        if t == f64::INFINITY || material == NO_ROW {
            return None;
        }
        let hit = RayHit { origin, direction, t, primitive: 0, displacement: DVec3::ZERO };
        let normal = self.bodies[shape].surface(&hit).normal;
        Some(Vertex {
            position: origin + direction * t,
            normal,
            albedo: self.materials.parameters[material as usize].colour,
        })
    }

    /// A sample of the middle of the light as the renderer weights it, and whether anything is in between.
    fn light_at(&self, vertex: &Vertex, lamp: &Emitter) -> Arriving {
        let from = vertex.position + vertex.normal * 1e-9;
        let point = point_on(lamp, from, [0.5, 0.5]);
        let direction = point.to.normalize();
        let shines = point.pdf > 0.0 && (!self.lights.one_sided[0] || lamp.faces(from));
        let cosine = direction.dot(vertex.normal).max(0.0);
        let t_max = point.to.length() * (1.0 - 1e-6);
        let blocked = self.bodies.iter().any(|body| body.t(from, direction) < t_max);
        let irradiance = irradiance_from_area(self.lights.radiance[0], cosine, point.pdf)[RED];
        Arriving { to: point.to, blocked, irradiance: if shines { irradiance } else { 0.0 } }
    }

    /// The direction that BSDF sampling finds for a random number, to the side that its sign says, and its weight.
    fn bounce(&self, vertex: &Vertex, number: f64) -> (DVec3, [f64; 3]) {
        let frame = frame_of(vertex.normal);
        // The azimuth of the section's plane, across x.
        let along = frame.transpose() * DVec3::X.cross(vertex.normal) * number.signum();
        let azimuth = libm::atan2(along.y, along.x) / TAU;
        let numbers = square_of_disk(number.abs(), azimuth.rem_euclid(1.0));
        match MatteTable.sample(&ShadingContext::opaque(0, Parameters::coloured(vertex.albedo)), DVec3::Z, numbers, 0.0)
        {
            Some(sample) => (frame * sample.to_light, sample.weight),
            None => (vertex.normal, [0.0; 3]),
        }
    }

    /// What the section's plane cuts: the walls that it crosses at right angles, the light, and the spheres.
    fn paint(&self, scene: &World, svg: &mut Svg, at: impl Fn(DVec3) -> DVec2, eye: DVec3) -> Result<()> {
        let point = |y: f64, z: f64| at(DVec3::new(0.0, y, z) - DVec3::new(0.0, eye.y, eye.z));
        // The walls as rays from the middle of the room find them.
        let middle = DVec3::new(0.0, 1.0, 0.0) - eye;
        let wall = |direction: DVec3| self.hit(middle, direction).map(|vertex| vertex.position + eye);
        let (floor, ceiling, back) = (wall(DVec3::NEG_Y), self.above(middle), wall(DVec3::NEG_Z));
        if let (Some(floor), Some(ceiling), Some(back)) = (floor, ceiling.map(|up| up + eye), back) {
            let (front, back) = (-back.z, back.z);
            let pen = Pen::new(INK, 3.0);
            svg.line(point(floor.y, front), point(floor.y, back), pen);
            svg.line(point(floor.y, back), point(ceiling.y, back), pen);
            svg.line(point(ceiling.y, back), point(ceiling.y, front), pen);
        }
        if let Some(Emitter::Rectangle(lamp)) = self.lights.emitter.first() {
            let half = lamp.half_edges.iter().map(|half| half.z.abs()).fold(0.0, f64::max);
            let [near, far] = [1.0, -1.0].map(|side| at(lamp.centre + DVec3::Z * (side * half)) + DVec2::Y * 2.0);
            svg.line(near, far, Pen::new(LIGHT, 6.0));
            svg.label(Label::near(near.midpoint(far), "light", DVec2::NEG_Y, 8.0).large().coloured(LIGHT));
        }
        for sphere in SphereTable::extract(&Census::of(scene))?.row {
            let across = sphere.radius * sphere.radius - (sphere.centre.x + eye.x) * (sphere.centre.x + eye.x);
            if across > 0.0 {
                let (fill, pen) = (Fill::new(IMAGE, 0.35), Pen::new(INK, 1.4));
                svg.circle(at(sphere.centre), across.sqrt() * SCALE, Some(&fill), Some(pen));
            }
        }
        Ok(())
    }

    /// The ceiling above a point, past the light below it.
    fn above(&self, from: DVec3) -> Option<DVec3> {
        let beside = from + DVec3::Z * 0.7;
        self.hit(beside, DVec3::Y).map(|vertex| vertex.position)
    }
}

/// A number as a subscript.
fn lowered(number: usize) -> char {
    ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'][number % 10]
}

/// Two decimals, none for 1.
fn short(value: f64) -> String {
    if value == 1.0 { "1".into() } else { format!("{value:.2}") }
}
