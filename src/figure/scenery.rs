use super::grid::Grid;
use super::patch::Patch;
use super::sketch::{Extent, Frame, Sketch};
use super::subject::{Ball, Subject, screen_colour};
use super::svg::{Fill, IMAGE, INK, LIGHT, Pen, Svg};
use crate::Result;
use glam::{DVec2, DVec3};

/// From where a scene is sketched, in degrees: 0 is from behind the camera, 90 from its right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// Around the camera's upward axis.
    pub around: f64,
    /// Above its horizon.
    pub above: f64,
}

/// A straight line in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strand {
    /// Its beginning, render space.
    pub from: DVec3,
    /// Its end.
    pub to: DVec3,
    /// How it is drawn where nothing hides it.
    pub pen: Pen,
    /// Whether a head is drawn at its end.
    pub head: bool,
}

impl Strand {
    /// A line without a head.
    pub fn new(from: DVec3, to: DVec3, pen: Pen) -> Self {
        Self { from, to, pen, head: false }
    }

    /// A line with a head at its end.
    pub fn arrow(from: DVec3, to: DVec3, pen: Pen) -> Self {
        Self { from, to, pen, head: true }
    }
}

/// What stands before a point as the viewer sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Veil {
    Nothing,
    Image,
    Sphere,
}

/// A chapter's scene, ready to be drawn from one side.
pub struct Scenery<'s> {
    /// The scene and its columns.
    pub subject: &'s Subject,
    /// The projection.
    pub sketch: Sketch,
    /// The image in the scene.
    pub grid: Grid,
    /// The planes, as far as they are shown.
    pub patches: Vec<Patch>,
}

impl<'s> Scenery<'s> {
    /// Fits the spheres, the image and these further things into a frame; planes are shown as far as needed for that.
    pub fn new(subject: &'s Subject, grid: Grid, side: Side, more: &[Extent], frame: Frame) -> Result<Self> {
        let mut things: Vec<Extent> = subject.balls.iter().map(|ball| (ball.centre, ball.radius)).collect();
        things.extend(grid.corners().map(|corner| (corner, 0.0)));
        things.extend(more);
        let right = subject.axes.x_axis;
        let patches: Vec<Patch> = subject.flats.iter().map(|flat| Patch::under(flat, right, &things)).collect();
        things.extend(patches.iter().flat_map(Patch::corners).map(|corner| (corner, 0.0)));
        let (toward, up) = view(subject, side);
        things.extend(subject.lights.iter().map(|&light| (light, 0.3)));
        Ok(Self { subject, sketch: Sketch::fitting(toward, up, &things, frame)?, grid, patches })
    }

    /// Where a point comes to lie.
    pub fn point(&self, point: DVec3) -> DVec2 {
        self.sketch.point(point)
    }

    /// Draws everything from back to front; what hides a line is asked piece by piece.
    pub fn paint(&self, svg: &mut Svg, strands: &[Strand]) {
        for patch in &self.patches {
            self.paint_patch(svg, patch);
        }
        let pieces: Vec<(Strand, Veil)> = strands.iter().flat_map(|strand| self.pieces(strand)).collect();
        let image_nearness = self.sketch.nearness(self.grid.middle());
        let mut balls: Vec<&Ball> = self.subject.balls.iter().collect();
        balls.sort_by(|a, b| self.sketch.nearness(a.centre).total_cmp(&self.sketch.nearness(b.centre)));
        let nearer = balls.partition_point(|ball| self.sketch.nearness(ball.centre) < image_nearness);
        balls[..nearer].iter().for_each(|ball| self.paint_ball(svg, ball));
        self.paint_pieces(svg, &pieces, Veil::Image);
        self.paint_grid(svg);
        balls[nearer..].iter().for_each(|ball| self.paint_ball(svg, ball));
        self.paint_pieces(svg, &pieces, Veil::Sphere);
        self.paint_pieces(svg, &pieces, Veil::Nothing);
        for &light in &self.subject.lights {
            self.paint_light(svg, light);
        }
    }

    fn pieces(&self, strand: &Strand) -> Vec<(Strand, Veil)> {
        let toward = self.sketch.axes.z_axis;
        let veil = |point: DVec3| {
            if self.sketch.hidden(point, &self.subject.balls) {
                Veil::Sphere
            } else if self.grid.hides(point, toward) {
                Veil::Image
            } else {
                Veil::Nothing
            }
        };
        let cuts = self.sketch.cut(strand.from, strand.to, veil);
        let last = cuts.len() - 1;
        let piece = |(index, (from, to, veil)): (usize, (DVec3, DVec3, Veil))| {
            (Strand { from, to, head: strand.head && index == last, ..*strand }, veil)
        };
        cuts.into_iter().enumerate().map(piece).collect()
    }

    fn paint_pieces(&self, svg: &mut Svg, pieces: &[(Strand, Veil)], asked: Veil) {
        for (strand, _) in pieces.iter().filter(|(_, veil)| *veil == asked) {
            let (from, to) = (self.point(strand.from), self.point(strand.to));
            // What is inside or behind a sphere is only hinted at.
            let pen = match asked {
                Veil::Sphere => Pen { width: strand.pen.width * 0.75, ..strand.pen }.faint(0.45).dashed("2 3"),
                _ => strand.pen,
            };
            if strand.head {
                svg.arrow(from, to, pen);
            } else {
                svg.line(from, to, pen);
            }
        }
    }

    fn paint_patch(&self, svg: &mut Svg, patch: &Patch) {
        let fill = Fill::new(screen_colour(patch.colour.map(|part| part as f32)), 0.28);
        svg.polygon(&patch.corners().map(|corner| self.point(corner)), Some(&fill), None);
        for [from, to] in patch.lines() {
            svg.quiet_line(self.point(from), self.point(to), Pen::new(INK, 0.7).faint(0.16));
        }
        for (light, ball) in
            self.subject.lights.iter().flat_map(|light| self.subject.balls.iter().map(move |b| (light, b)))
        {
            let outline: Vec<DVec2> = patch.shadow(*light, ball).into_iter().map(|at| self.point(at)).collect();
            if !outline.is_empty() {
                svg.polygon(&outline, Some(&Fill::new("#000", 0.32)), None);
            }
        }
    }

    fn paint_ball(&self, svg: &mut Svg, ball: &Ball) {
        let above = self.subject.axes.y_axis - self.subject.axes.x_axis;
        let to_light = self.subject.lights.first().map_or(above, |light| *light - ball.centre);
        let lit = self.sketch.direction(to_light.normalize()) / self.sketch.scale;
        svg.ball(self.point(ball.centre), ball.radius * self.sketch.scale, lit, &tones(ball.colour));
    }

    fn paint_grid(&self, svg: &mut Svg) {
        for ray in &self.subject.rays {
            let cell = self.grid.cell(ray.pixel).map(|corner| self.point(corner));
            let pen = Pen::new(IMAGE, 0.7).faint(0.8);
            svg.polygon(&cell, Some(&Fill::new(ray.colour.as_str(), 0.93)), Some(pen));
        }
        let corners = self.grid.corners().map(|corner| self.point(corner));
        svg.polygon(&corners, None, Some(Pen::new(IMAGE, 1.8)));
        for line in 0..=self.grid.size[1] {
            let end = |x: u32| self.point(self.grid.point(f64::from(x), f64::from(line)));
            svg.obstacles.strokes.push([end(0), end(self.grid.size[0])]);
        }
    }

    fn paint_light(&self, svg: &mut Svg, light: DVec3) {
        let at = self.point(light);
        for step in 0..12 {
            let angle = f64::from(step) * std::f64::consts::TAU / 12.0;
            let out = DVec2::new(libm::cos(angle), libm::sin(angle));
            svg.quiet_line(at + out * 9.5, at + out * 13.0, Pen::new(LIGHT, 1.6));
        }
        svg.circle(at, 6.5, Some(&Fill::new(LIGHT, 1.0)), None);
        svg.obstacles.discs.push((at, 13.0));
    }
}

/// The direction to the viewer, and what points upward in the drawing.
fn view(subject: &Subject, side: Side) -> (DVec3, DVec3) {
    // The world's upward direction keeps the horizon level, unless the camera looks along it.
    let ahead = -subject.axes.z_axis;
    let up = if ahead.y.abs() < 0.9 { DVec3::Y } else { subject.axes.y_axis };
    let level = (ahead - up * ahead.dot(up)).normalize_or(ahead);
    let right = level.cross(up);
    let [around, above] = [side.around, side.above].map(|angle| crate::scene::Degrees(angle).radians());
    let horizontal = right * libm::sin(around) - level * libm::cos(around);
    (horizontal * libm::cos(above) + up * libm::sin(above), up)
}

/// Light, middle and dark of a matte colour, as a screen shows them.
fn tones(colour: [f64; 3]) -> [String; 3] {
    let tone = |change: fn(f64) -> f64| screen_colour(colour.map(|part| change(part) as f32));
    [tone(|part| part + (1.0 - part) * 0.35), tone(|part| part), tone(|part| part * 0.32)]
}

/// The eye: where all rays of a perspective camera meet.
pub fn paint_eye(svg: &mut Svg, at: DVec2, ahead: DVec2) {
    let along = ahead.normalize_or(DVec2::X);
    let open = DVec2::new(libm::cos(0.5), libm::sin(0.5));
    let lids = [open.rotate(along), DVec2::new(open.x, -open.y).rotate(along)];
    svg.circle(at, 9.0, Some(&Fill::new("var(--bg, #fff)", 1.0)), Some(Pen::new(INK, 1.4)));
    svg.circle(at, 3.2, Some(&Fill::new(INK, 1.0)), None);
    for lid in lids {
        svg.quiet_line(at + lid * 9.0, at + lid * 12.5, Pen::new(INK, 1.4));
    }
}
