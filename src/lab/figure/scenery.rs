use super::grid::Grid;
use super::patch::Patch;
use super::pen::Pen;
use super::side::Side;
use super::sketch::{Extent, Frame, Sketch};
use super::subject::{Ball, Subject};
use super::svg::Svg;
use glam::{DVec2, DVec3};
use pinhole::Result;

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
    /// The lowest part of the drawing that is in use.
    pub bottom: f64,
}

impl<'s> Scenery<'s> {
    /// Fits the spheres, the image and these further things into a frame; planes are shown as far as needed for that.
    pub fn new(subject: &'s Subject, grid: Grid, side: Side, more: &[Extent], frame: Frame) -> Result<Self> {
        let mut things: Vec<Extent> = subject.balls.iter().map(|ball| (ball.centre, ball.radius)).collect();
        things.extend(grid.corners().map(|corner| (corner, 0.0)));
        things.extend(more);
        let right = subject.axes.x_axis;
        let patches: Vec<Patch> =
            subject.planar_shapes.iter().map(|planar| Patch::under(planar, right, &things)).collect();
        things.extend(patches.iter().flat_map(Patch::corners).map(|corner| (corner, 0.0)));
        let (toward, up) = side.view(subject);
        things.extend(subject.lights.iter().map(|&light| (light, 0.2)));
        let sketch = Sketch::fitting(toward, up, &things, frame)?;
        let low = |&(at, extent): &Extent| sketch.point(at).y + extent * sketch.scale;
        let bottom = things.iter().map(low).fold(frame.low.y, f64::max);
        Ok(Self { subject, sketch, grid, patches, bottom })
    }

    /// Where a point comes to lie.
    pub fn point(&self, point: DVec3) -> DVec2 {
        self.sketch.point(point)
    }

    /// Whether a sphere or the image stands before a point.
    pub fn veiled(&self, point: DVec3) -> bool {
        self.sketch.hidden(point, &self.subject.balls) || self.grid.hides(point, self.sketch.axes.z_axis)
    }

    /// The middle of the longest part of a straight line that nothing stands before; its own middle where all is.
    pub fn open_middle(&self, from: DVec3, to: DVec3) -> DVec3 {
        let parts = self.sketch.cut(from, to, |point| self.veiled(point));
        let open = parts.into_iter().filter(|(_, _, veiled)| !veiled);
        let longest = open.max_by(|a, b| a.0.distance(a.1).total_cmp(&b.0.distance(b.1)));
        longest.map_or(from.lerp(to, 0.5), |(from, to, _)| from.lerp(to, 0.5))
    }

    /// How much of a straight line nothing stands before, in units of the drawing.
    pub fn open_length(&self, from: DVec3, to: DVec3) -> f64 {
        let parts = self.sketch.cut(from, to, |point| self.veiled(point));
        let open = parts.into_iter().filter(|(_, _, veiled)| !veiled);
        open.map(|(from, to, _)| self.point(from).distance(self.point(to))).sum()
    }

    /// Draws everything from back to front; what hides a line is asked piece by piece.
    /// The size of signs is 1 in a drawing of full width.
    pub fn paint(&self, svg: &mut Svg, strands: &[Strand], size: f64) {
        for patch in &self.patches {
            self.paint_patch(svg, patch);
        }
        let parts: Vec<(Strand, Veil)> = strands.iter().flat_map(|strand| self.parts(strand)).collect();
        let image_nearness = self.sketch.nearness(self.grid.middle());
        let mut balls: Vec<&Ball> = self.subject.balls.iter().collect();
        balls.sort_by(|a, b| self.sketch.nearness(a.centre).total_cmp(&self.sketch.nearness(b.centre)));
        let nearer = balls.partition_point(|ball| self.sketch.nearness(ball.centre) < image_nearness);
        balls[..nearer].iter().for_each(|ball| self.paint_ball(svg, ball));
        self.paint_parts(svg, &parts, Veil::Image);
        self.paint_grid(svg);
        balls[nearer..].iter().for_each(|ball| self.paint_ball(svg, ball));
        self.paint_parts(svg, &parts, Veil::Sphere);
        self.paint_parts(svg, &parts, Veil::Nothing);
        for &light in &self.subject.lights {
            self.paint_light(svg, light, size);
        }
    }

    fn parts(&self, strand: &Strand) -> Vec<(Strand, Veil)> {
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
        let part = |(index, (from, to, veil)): (usize, (DVec3, DVec3, Veil))| {
            (Strand { from, to, head: strand.head && index == last, ..*strand }, veil)
        };
        cuts.into_iter().enumerate().map(part).collect()
    }

    fn paint_parts(&self, svg: &mut Svg, parts: &[(Strand, Veil)], asked: Veil) {
        for (strand, _) in parts.iter().filter(|(_, veil)| *veil == asked) {
            let (from, to) = (self.point(strand.from), self.point(strand.to));
            // What is inside or behind a sphere is only hinted at.
            let pen = match asked {
                Veil::Sphere if strand.pen.opacity < 1.0 => continue,
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
}
