//! The camera's axes, made of eye, target and up.

use super::Figure;
use super::label::Label;
use super::pen::{IMAGE, INK, LIGHT, Pen, RAY, WIDTH};
use super::props::paint_eye;
use super::sketch::{Frame, Sketch};
use super::svg::{Drawing, Svg};
use glam::{DVec2, DVec3};
use pinhole::Result;
use pinhole::extract::{CameraAxes, camera_entity};
use pinhole::plan::{Census, Table};
use pinhole::scene::{LookAt, Resolution};
use pinhole::{Chapter, Overrides};

const HEIGHT: f64 = 400.0;
/// How long the camera's axes are drawn, as a share of the way from eye to target.
const AXIS: f64 = 0.42;

/// The camera's three axes, made of eye, target and up.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let image = [96, 54];
    let resolution = Resolution { width: image[0], height: image[1] };
    let scene = chapter.world(&Overrides { resolution: Some(resolution), ..Overrides::default() });
    let look = scene.get::<LookAt>(camera_entity(&scene)?).ok_or_else(|| figure.unsuited("a camera with a LookAt"))?;
    let axes = CameraAxes::extract(&Census::of(&scene))?.world_from_camera;
    let view = look.target - look.eye;
    let length = AXIS * view.length();
    // From the camera's right and a little before it, so that no axis is seen end on.
    let toward = axes.x_axis + 0.55 * axes.z_axis + 0.45 * axes.y_axis;
    let tips = [axes.x_axis, axes.y_axis, axes.z_axis].map(|axis| axis * length);
    let up = look.up.normalize_or(DVec3::Y) * length;
    let origin = -look.eye;
    let world = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| origin + axis * (0.7 * length));
    let places = [DVec3::ZERO, view, tips[0], tips[1], tips[2], up, origin, world[0], world[1], world[2]];
    let things = places.map(|place| (place, 0.02 * view.length()));
    let frame = Frame { low: DVec2::new(60.0, 40.0), high: DVec2::new(WIDTH - 110.0, HEIGHT - 60.0) };
    let sketch = Sketch::fitting(toward, DVec3::Y, &things, frame)?;
    let mut svg = Svg::new(figure.name, HEIGHT);
    let [eye, target] = [DVec3::ZERO, view].map(|place| sketch.point(place));
    let [x, y, z] = tips.map(|tip| sketch.point(tip));
    svg.line(eye, target, Pen::new(INK, 1.2).dashed("5 4"));
    svg.dot(target, 4.5, INK);
    plane_of_view(&mut svg, &sketch, up, tips);
    svg.arrow(eye, sketch.point(up), Pen::new(INK, 1.8).dashed("3 3"));
    for (tip, colour) in [(z, RAY), (x, IMAGE), (y, LIGHT)] {
        svg.arrow(eye, tip, Pen::new(colour, 3.0));
    }
    right_angle(&mut svg, &sketch, tips[2], tips[0]);
    right_angle(&mut svg, &sketch, tips[2], tips[1]);
    paint_eye(&mut svg, eye, target - eye, 1.0);
    for (axis, name) in world.into_iter().zip(["*x*", "*y*", "*z*"]) {
        let [from, to] = [origin, axis].map(|place| sketch.point(place));
        svg.arrow(from, to, Pen::new(INK, 1.4).faint(0.6));
        svg.label(Label::near(to, name, to - from, 6.0).title(0.92));
    }
    svg.label(Label::near(sketch.point(origin), "the world's axes", DVec2::new(0.3, 1.0), 12.0).title(0.92));
    let beyond = |tip: DVec2| tip - eye;
    svg.label(Label::near(target, "`target`", target - eye, 9.0));
    svg.label(Label::near(eye, "`eye`", -beyond(x) - beyond(y), 16.0));
    svg.label(Label::near(sketch.point(up), "`up`, as given", beyond(sketch.point(up)), 8.0));
    svg.label(Label::near(z, "1. `back`: camera's *z*", beyond(z), 8.0).coloured(RAY));
    svg.label(Label::near(x, "2. `up` × `back`: *x*", beyond(x), 8.0).coloured(IMAGE));
    svg.label(Label::near(y, "3. `back` × *x*: *y*", beyond(y), 8.0).coloured(LIGHT));
    svg.label(Label::near(sketch.point(view * 0.6), "the view: −*z*", DVec2::Y, 8.0));
    Ok(svg.finish(figure.about, &figure.stamp(image, "axes drawn longer than 1")))
}

/// The plane through `up` and `back`, in which the camera's y lies too: a thin line between the tips.
fn plane_of_view(svg: &mut Svg, sketch: &Sketch, up: DVec3, [_, y, _]: [DVec3; 3]) {
    svg.line(sketch.point(up), sketch.point(y), Pen::new(INK, 0.8).faint(0.5).dashed("2 3"));
}

/// A small square between two axes.
fn right_angle(svg: &mut Svg, sketch: &Sketch, a: DVec3, b: DVec3) {
    let [a, b] = [a * 0.16, b * 0.16];
    let [from, corner, to] = [a, a + b, b].map(|place| sketch.point(place));
    svg.quiet_line(from, corner, Pen::new(INK, 1.0).faint(0.7));
    svg.quiet_line(corner, to, Pen::new(INK, 1.0).faint(0.7));
}
