//! Uniform and cosine-weighted directions of a hemisphere, from the side, and the points of the disk below them.

use super::Figure;
use super::angle::{bow, write, write_in};
use super::label::Label;
use super::pen::{Fill, IMAGE, INK, Pen, RAY, WIDTH};
use super::svg::{Drawing, Svg};
use crate::naive::path::uniform_direction;
use glam::{DVec2, DVec3};
use pinhole::Chapter;
use pinhole::Result;
use pinhole::extract::{SamplingTable, camera_entity};
use pinhole::material::cosine_direction;
use pinhole::plan::{Census, Table};
use pinhole::sample::{Draw, PixelKey, Purpose, SampleIndex, Sobol, unit};
use std::f64::consts::{PI, TAU};

/// Directions of each kind.
const DIRECTIONS: u32 = 64;
const HEIGHT: f64 = 614.0;
/// The radius of hemisphere and disk, where the surface lies, and where the disk's centre is.
const RADIUS: f64 = 140.0;
const GROUND: f64 = 206.0;
const BELOW: f64 = 382.0;
/// Directions farther from the normal than this are counted: half of the uniform ones, a quarter of the others.
const LOW: f64 = 60.0;

/// The same random numbers as uniform and as cosine-weighted directions.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let scene = chapter.world(&Default::default());
    camera_entity(&scene)?;
    let pixel = PixelKey::new(SamplingTable::extract(&Census::of(&scene))?.seed, [240, 135]);
    let numbers = |number: u32| {
        let sample = SampleIndex { number, samples: DIRECTIONS, depth: 0 };
        Sobol::of(sample, Purpose::Direction).two(pixel).map(unit)
    };
    let mut svg = Svg::new(figure.name, HEIGHT);
    let kinds: [(&str, &str, fn([f64; 2]) -> DVec3); 2] = [
        ("uniform", "*p* = 1/2π", |numbers| DVec3::from(uniform_direction(numbers))),
        ("cosine-weighted", "*p* = cos *θ* / π", cosine_direction),
    ];
    for (panel, (name, pdf, direction_of)) in kinds.into_iter().enumerate() {
        let middle = WIDTH * (2.0 * panel as f64 + 1.0) / 4.0;
        let (foot, disk) = (DVec2::new(middle, GROUND), DVec2::new(middle, BELOW));
        let directions: Vec<DVec3> = (0..DIRECTIONS).map(|number| direction_of(numbers(number))).collect();
        write(&mut svg, DVec2::new(middle, 20.0), "middle", &format!("{name}, {pdf}"));
        svg.line(foot - DVec2::X * 165.0, foot + DVec2::X * 165.0, Pen::new(INK, 1.6));
        bow(&mut svg, foot, RADIUS, [0.0, PI], Pen::new(INK, 1.0).faint(0.6));
        svg.circle(disk, RADIUS, Some(&Fill::new(INK, 0.05)), Some(Pen::new(INK, 1.2)));
        for &direction in &directions {
            let [above, below] = [direction.z, direction.y].map(|up| DVec2::new(direction.x, -up) * RADIUS);
            // A direction towards the viewer is seen end-on, so its line is short.
            svg.quiet_line(foot, foot + above, Pen::new(RAY, 1.1).faint(0.55));
            svg.quiet_line(foot + above, disk + below, Pen::new(IMAGE, 0.7).faint(0.22));
            svg.circle(foot + above, 3.2, Some(&Fill::new(RAY, 1.0)), None);
            svg.circle(disk + below, 3.2, Some(&Fill::new(IMAGE, 1.0)), None);
        }
        let low = LOW.to_radians();
        let is_low = |direction: &&DVec3| direction.z < libm::cos(low);
        let count = directions.iter().filter(is_low).count();
        for side in [-1.0, 1.0] {
            let edge = DVec2::new(side * libm::sin(low), -libm::cos(low)) * (RADIUS + 14.0);
            svg.line(foot, foot + edge, Pen::new(INK, 1.3).dashed("6 4"));
        }
        bow(&mut svg, disk, RADIUS * libm::sin(low), [0.0, TAU], Pen::new(INK, 1.2).faint(0.7));
        let edge = foot + DVec2::new(libm::sin(low), -libm::cos(low)) * (RADIUS + 14.0);
        svg.label(Label::near(edge, &format!("{LOW}°"), DVec2::new(0.3, -1.0), 3.0).large());
        let told = format!("{count} of {DIRECTIONS} beyond {LOW}°");
        write_in(&mut svg, DVec2::new(middle, BELOW + RADIUS + 26.0), "middle", &told, RAY);
        let told = if panel == 0 { "crowded at the rim" } else { "uniform on the disk" };
        write_in(&mut svg, DVec2::new(middle, BELOW + RADIUS + 54.0), "middle", told, IMAGE);
        svg.label(Label::near(foot - DVec2::Y * RADIUS, "*n*", DVec2::NEG_Y, 4.0).title(1.5));
    }
    let note = "from the side, and from straight above";
    let foot = format!("scene {}, its seed · {note} · cargo run --release -- figure {}", chapter.name, figure.name);
    Ok(svg.finish(figure.about, &foot))
}
