//! The things that stand in a drawn scene, each by itself.

use super::grid::Grid;
use super::patch::Patch;
use super::pen::{Fill, IMAGE, INK, LIGHT, Pen};
use super::pixel_ray::{Onward, screen_colour};
use super::scenery::{Scenery, Strand};
use super::subject::Ball;
use super::svg::Svg;
use glam::{DVec2, DVec3};

impl Scenery<'_> {
    /// A part of a plane, ruled, with the shadows that fall on it.
    pub(super) fn paint_patch(&self, svg: &mut Svg, patch: &Patch) {
        let fill = Fill::new(screen_colour(patch.colour.map(|part| part as f32)), 0.26);
        let corners: Vec<DVec2> = patch.corners().into_iter().map(|corner| self.point(corner)).collect();
        svg.polygon(&corners, Some(&fill), Some(Pen::new(INK, 0.8).faint(0.25)));
        for [from, to] in patch.lines() {
            svg.quiet_line(self.point(from), self.point(to), Pen::new(INK, 0.7).faint(0.14));
        }
        for light in &self.subject.lights {
            for ball in &self.subject.balls {
                let outline: Vec<DVec2> = patch.shadow(*light, ball).into_iter().map(|at| self.point(at)).collect();
                if !outline.is_empty() {
                    svg.polygon(&outline, Some(&Fill::new("#000", 0.3)), None);
                }
            }
        }
    }

    /// A sphere, lighter towards the first light.
    pub(super) fn paint_ball(&self, svg: &mut Svg, ball: &Ball) {
        let above = self.subject.axes.y_axis - self.subject.axes.x_axis;
        let to_light = self.subject.lights.first().map_or(above, |light| *light - ball.centre);
        let lit = self.sketch.direction(to_light.normalize_or(above)) / self.sketch.scale;
        svg.ball(self.point(ball.centre), ball.radius * self.sketch.scale, lit, &tones(ball.colour));
    }

    /// The image, each pixel in the colour that pinhole rendered.
    pub(super) fn paint_grid(&self, svg: &mut Svg) {
        for ray in &self.subject.rays {
            let cell = self.grid.cell(ray.pixel).map(|corner| self.point(corner));
            let pen = Pen::new(IMAGE, 0.7).faint(0.8);
            svg.polygon(&cell, Some(&Fill::new(ray.colour.as_str(), 0.93)), Some(pen));
        }
        let corners = self.grid.corners().map(|corner| self.point(corner));
        svg.polygon(&corners, None, Some(Pen::new(IMAGE, 1.8)));
        for [from, to] in lines(&self.grid) {
            svg.obstacles.strokes.push([self.point(from), self.point(to)]);
        }
    }

    /// A ray to a light, up to where the light's sign begins.
    pub(super) fn shadow_ray(&self, onward: Onward, pen: Pen, size: f64) -> Strand {
        let length = self.point(onward.from).distance(self.point(onward.to));
        let fraction = (1.0 - 15.0 * size / length.max(1.0)).max(0.5);
        Strand::arrow(onward.from, onward.from.lerp(onward.to, fraction), pen)
    }

    /// A light: a disc with short rays; `size` is 1 in a drawing of full width.
    pub(super) fn paint_light(&self, svg: &mut Svg, light: DVec3, size: f64) {
        let at = self.point(light);
        for step in 0..12 {
            let angle = f64::from(step) * std::f64::consts::TAU / 12.0;
            let out = DVec2::new(libm::cos(angle), libm::sin(angle)) * size;
            svg.quiet_line(at + out * 9.5, at + out * 13.0, Pen::new(LIGHT, 1.6 * size));
        }
        svg.circle(at, 6.5 * size, Some(&Fill::new(LIGHT, 1.0)), None);
        svg.obstacles.discs.push((at, 13.0 * size));
    }
}

/// The edges of the image and the lines between its pixels' rows.
fn lines(grid: &Grid) -> Vec<[DVec3; 2]> {
    let [width, height] = grid.size.map(f64::from);
    let rows = (0..=grid.size[1]).map(|row| [grid.point(0.0, f64::from(row)), grid.point(width, f64::from(row))]);
    let sides = [0.0, width].map(|x| [grid.point(x, 0.0), grid.point(x, height)]);
    rows.chain(sides).collect()
}

/// Light, middle and dark of a matte colour, as a screen shows them.
fn tones(colour: [f64; 3]) -> [String; 3] {
    let tone = |change: fn(f64) -> f64| screen_colour(colour.map(|part| change(part) as f32));
    [tone(|part| part + (1.0 - part) * 0.35), tone(|part| part), tone(|part| part * 0.32)]
}

/// The eye: where all rays of a perspective camera start; `size` is 1 in a drawing of full width.
pub fn paint_eye(svg: &mut Svg, at: DVec2, ahead: DVec2, size: f64) {
    let along = ahead.normalize_or(DVec2::X);
    let open = DVec2::new(libm::cos(0.55), libm::sin(0.55));
    let pen = Pen::new(INK, 1.4 * size);
    svg.circle(at, 9.0 * size, Some(&Fill::new("var(--bg, #fff)", 1.0)), Some(pen));
    svg.circle(at, 3.2 * size, Some(&Fill::new(INK, 1.0)), None);
    for lid in [open.rotate(along), DVec2::new(open.x, -open.y).rotate(along)] {
        svg.quiet_line(at + lid * 9.0 * size, at + lid * 13.0 * size, pen);
    }
}
