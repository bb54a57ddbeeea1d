use super::label::{Label, Obstacles, Placed, place};
use super::pen::{Fill, INK, Pen, SMALL_TEXT, WIDTH, number};
use super::picture::Picture;
use glam::DVec2;
use std::fmt::Write;

/// A drawing that grows: x to the right, y down, [`WIDTH`] wide.
///
/// Labels wait until all lines are known, and are then placed where they touch the fewest.
pub struct Svg {
    height: f64,
    body: String,
    gradients: usize,
    name: String,
    /// What labels keep away from.
    pub obstacles: Obstacles,
    labels: Vec<Label>,
}

impl Svg {
    /// An empty drawing; its name keeps its gradients apart from another's on the same page.
    pub fn new(name: &str, height: f64) -> Self {
        let obstacles = Obstacles::default();
        Self { height, body: String::new(), gradients: 0, name: name.into(), obstacles, labels: Vec::new() }
    }

    /// A straight line.
    pub fn line(&mut self, from: DVec2, to: DVec2, pen: Pen) {
        self.obstacles.strokes.push([from, to]);
        self.quiet_line(from, to, pen);
    }

    /// A straight line that labels may cross.
    pub fn quiet_line(&mut self, from: DVec2, to: DVec2, pen: Pen) {
        let [[x1, y1], [x2, y2]] = [from, to].map(|end| [number(end.x), number(end.y)]);
        // Where lines that let light through join, round ends would lie on each other.
        let cap = if pen.opacity < 1.0 { "" } else { "stroke-linecap=\"round\" " };
        let line = format!("<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" {cap}{}/>", pen.attributes());
        let _ = writeln!(self.body, "{line}");
    }

    /// A line with a head at its end; the head's tip is the end.
    pub fn arrow(&mut self, from: DVec2, to: DVec2, pen: Pen) {
        let Some(along) = (to - from).try_normalize() else { return };
        let length = 4.0 + 2.6 * pen.width;
        self.line(from, to - along * length * 0.8, Pen { dash: pen.dash, ..pen });
        self.head(to, along, pen);
    }

    /// An arrow's head alone.
    pub fn head(&mut self, tip: DVec2, along: DVec2, pen: Pen) {
        let length = 4.0 + 2.6 * pen.width;
        let (back, across) = (tip - along * length, along.perp() * length * 0.4);
        self.polygon(&[tip, back + across, back - across], Some(&Fill::new(pen.colour, pen.opacity)), None);
        self.obstacles.strokes.push([back, tip]);
    }

    /// A closed outline, filled or drawn or both.
    pub fn polygon(&mut self, corners: &[DVec2], fill: Option<&Fill>, pen: Option<Pen>) {
        let points: Vec<String> = corners.iter().map(|c| format!("{},{}", number(c.x), number(c.y))).collect();
        let _ = writeln!(self.body, "<polygon points=\"{}\" {}/>", points.join(" "), paint(fill, pen));
    }

    /// A circle, filled or drawn or both.
    pub fn circle(&mut self, centre: DVec2, radius: f64, fill: Option<&Fill>, pen: Option<Pen>) {
        let [x, y, r] = [centre.x, centre.y, radius].map(number);
        let _ = writeln!(self.body, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" {}/>", paint(fill, pen));
        self.obstacles.discs.push((centre, radius));
    }

    /// A sphere in parallel projection: a circle, lighter where `lit` points, in three tones of one colour.
    pub fn ball(&mut self, centre: DVec2, radius: f64, lit: DVec2, tones: &[String; 3]) {
        self.gradients += 1;
        let id = format!("{}-{}", self.name, self.gradients);
        let focus = DVec2::splat(0.5) + lit.clamp_length_max(1.0) * 0.3;
        let [fx, fy] = [focus.x, focus.y].map(number);
        let _ = write!(self.body, "<radialGradient id=\"{id}\" cx=\"{fx}\" cy=\"{fy}\" r=\"0.75\">");
        for (tone, offset) in tones.iter().zip(["0", "0.5", "1"]) {
            let _ = write!(self.body, "<stop offset=\"{offset}\" stop-color=\"{tone}\"/>");
        }
        let _ = writeln!(self.body, "</radialGradient>");
        self.circle(centre, radius, Some(&Fill::new(format!("url(#{id})"), 1.0)), None);
    }

    /// A rendered picture, its upper left corner here, so large, with a thin frame that labels keep away from.
    pub fn picture(&mut self, low: DVec2, size: DVec2, picture: &Picture) {
        let [x, y, width, height] = [low.x, low.y, size.x, size.y].map(number);
        let _ = writeln!(
            self.body,
            "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" href=\"{}\"/>",
            picture.url
        );
        let [right, down] = [DVec2::X * size.x, DVec2::Y * size.y];
        let corners = [low, low + right, low + size, low + down];
        self.polygon(&corners, None, Some(Pen::new(INK, 0.8).faint(0.5)));
        for (corner, next) in [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3)] {
            self.obstacles.strokes.push([corners[corner], corners[next]]);
        }
    }

    /// A dot that marks a point.
    pub fn dot(&mut self, centre: DVec2, radius: f64, colour: &str) {
        self.circle(centre, radius, Some(&Fill::new(colour, 1.0)), None);
    }

    /// Words to be placed near a point once everything else is drawn.
    pub fn label(&mut self, label: Label) {
        self.labels.push(label);
    }

    /// Words exactly here: the middle of their line, at `size`.
    pub fn words(&mut self, placed: &Placed, opacity: f64) {
        let [x, y, size] = [placed.at.x, placed.at.y + placed.size * 0.35, placed.size].map(number);
        let (anchor, colour, opacity) = (placed.anchor, placed.colour, number(opacity));
        let _ = writeln!(
            self.body,
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\" fill=\"{colour}\" \
             fill-opacity=\"{opacity}\" style=\"paint-order: stroke; stroke: var(--bg, #fff); stroke-width: 3.5px; \
             stroke-linejoin: round\">{}</text>",
            spans(&placed.text)
        );
        self.obstacles.words.push(placed.extent());
    }

    /// Places the labels, adds the words at the foot, and closes the drawing.
    pub fn finish(mut self, about: &str, foot: &str) -> Drawing {
        let foot_at = DVec2::new(8.0, self.height - 12.0);
        self.words(
            &Placed {
                point: foot_at,
                at: foot_at,
                anchor: "start",
                size: SMALL_TEXT,
                colour: INK,
                text: foot.into(),
                crosses: 0,
            },
            0.62,
        );
        let canvas = [DVec2::splat(4.0), DVec2::new(WIDTH - 4.0, self.height - 20.0)];
        let mut labels = Vec::new();
        for label in std::mem::take(&mut self.labels) {
            let placed = place(&label, &self.obstacles, label.within.unwrap_or(canvas));
            if let Some(end) = placed.leader().filter(|_| label.leader) {
                // A rim in the page's colour, so that it is seen on dark pixels too.
                self.quiet_line(placed.point, end, Pen::new("var(--bg, #fff)", 2.6).faint(0.8));
                self.line(placed.point, end, Pen::new(INK, 0.9).faint(0.8));
            }
            self.words(&placed, 1.0);
            labels.push(placed);
        }
        let (width, height, about) = (number(WIDTH), number(self.height), escaped(about));
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" role=\"img\" \
             aria-label=\"{about}\" font-family=\"system-ui, sans-serif\" fill=\"none\">\n{}</svg>\n",
            self.body
        );
        Drawing { text, labels, obstacles: self.obstacles }
    }
}

/// A finished drawing, with what its tests ask about.
pub struct Drawing {
    /// The SVG.
    pub text: String,
    /// Where the labels came to stand.
    pub labels: Vec<Placed>,
    /// Everything they had to keep away from.
    pub obstacles: Obstacles,
}

fn paint(fill: Option<&Fill>, pen: Option<Pen>) -> String {
    let fill = fill.map_or_else(|| "fill=\"none\"".into(), Fill::attributes);
    let pen = pen.map_or_else(String::new, |pen| format!(" stroke-linejoin=\"round\" {}", pen.attributes()));
    fill + &pen
}

/// Words with `*italic*` mathematics and names of the code in backticks, as SVG has them.
fn spans(text: &str) -> String {
    let mut out = String::new();
    for (part, italic) in text.split('*').zip([false, true].into_iter().cycle()) {
        for (part, code) in part.split('`').zip([false, true].into_iter().cycle()) {
            let part = escaped(part);
            let _ = match (italic, code) {
                (_, true) => {
                    write!(out, "<tspan font-family=\"ui-monospace, monospace\" font-size=\"0.92em\">{part}</tspan>")
                }
                (true, _) => write!(out, "<tspan font-style=\"italic\" font-family=\"serif\">{part}</tspan>"),
                _ => write!(out, "{part}"),
            };
        }
    }
    out
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
