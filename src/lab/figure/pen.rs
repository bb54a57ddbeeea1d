use std::fmt::Write;

/// The width of every drawing, in the units that pens and text sizes are given in.
pub const WIDTH: f64 = 720.0;
/// The size of a label.
pub const TEXT: f64 = 14.0;
/// The size of labels that stay legible where the drawing is shown at half its width.
pub const LARGE_TEXT: f64 = 21.0;
/// The size of the words at the foot.
pub const SMALL_TEXT: f64 = 11.0;

/// Lines and text take the page's own colour, so that a drawing fits light and dark pages.
pub const INK: &str = "currentColor";
/// Rays.
pub const RAY: &str = "#d9822b";
/// Light, and rays to it.
pub const LIGHT: &str = "#c9a400";
/// The image plane and its grid.
pub const IMAGE: &str = "#5f7f9f";

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pen {
    /// Any colour of SVG.
    pub colour: &'static str,
    /// In units of the drawing.
    pub width: f64,
    /// From 0, unseen, to 1.
    pub opacity: f64,
    /// Lengths of dashes and gaps; empty for an unbroken line.
    pub dash: &'static str,
}

impl Pen {
    /// An unbroken, opaque line.
    pub const fn new(colour: &'static str, width: f64) -> Self {
        Self { colour, width, opacity: 1.0, dash: "" }
    }

    /// The same, letting what is behind it through.
    pub const fn faint(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }

    /// The same, broken.
    pub const fn dashed(self, dash: &'static str) -> Self {
        Self { dash, ..self }
    }

    /// As SVG writes it.
    pub fn attributes(&self) -> String {
        let mut text = format!("stroke=\"{}\" stroke-width=\"{}\"", self.colour, number(self.width));
        if self.opacity < 1.0 {
            let _ = write!(text, " stroke-opacity=\"{}\"", number(self.opacity));
        }
        if !self.dash.is_empty() {
            let _ = write!(text, " stroke-dasharray=\"{}\"", self.dash);
        }
        text
    }
}

/// An area's colour and how much of it covers what is behind.
#[derive(Clone, Debug, PartialEq)]
pub struct Fill {
    /// Any colour of SVG.
    pub colour: String,
    /// From 0, unseen, to 1.
    pub opacity: f64,
}

impl Fill {
    /// A colour and its opacity.
    pub fn new(colour: impl Into<String>, opacity: f64) -> Self {
        Self { colour: colour.into(), opacity }
    }

    /// As SVG writes it.
    pub fn attributes(&self) -> String {
        format!("fill=\"{}\" fill-opacity=\"{}\"", self.colour, number(self.opacity))
    }
}

/// Two decimals, no more than needed, and no minus before a nought.
pub fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}
