use super::pen::{INK, LARGE_TEXT, TEXT};
use super::sketch::Frame;
use glam::DVec2;

/// Words that belong to a point of a drawing.
#[derive(Clone, Debug)]
pub struct Label {
    /// The point; where there are several, any of them will do.
    pub anchors: Vec<DVec2>,
    /// The words; `*italic*` and code in backticks.
    pub text: String,
    /// On which side of the point they stand if nothing is in the way; y down.
    pub toward: DVec2,
    /// Their colour.
    pub colour: &'static str,
    /// The least distance from the point.
    pub distance: f64,
    /// Text size.
    pub size: f64,
    /// The rectangle that they may not leave, upper left and lower right; the drawing's own where none is given.
    pub within: Option<[DVec2; 2]>,
    /// Whether a thin line leads to them where they stand far off.
    pub leader: bool,
}

/// Words with a place.
#[derive(Clone, Debug)]
pub struct Placed {
    /// The point that they belong to.
    pub point: DVec2,
    /// Where their anchor is; the middle of the line in y.
    pub at: DVec2,
    /// SVG's `text-anchor`.
    pub anchor: &'static str,
    /// Text size.
    pub size: f64,
    /// Their colour.
    pub colour: &'static str,
    /// The words.
    pub text: String,
    /// How many lines they cross.
    pub crosses: usize,
}

/// What words keep away from.
#[derive(Clone, Debug, Default)]
pub struct Obstacles {
    /// Straight lines.
    pub strokes: Vec<[DVec2; 2]>,
    /// Discs: centre and radius.
    pub discs: Vec<(DVec2, f64)>,
    /// Rectangles of words that stand already, upper left and lower right.
    pub words: Vec<[DVec2; 2]>,
}

impl Label {
    /// Words in the page's colour at their usual size, at this distance to this side of a point.
    pub fn near(anchor: DVec2, text: &str, toward: DVec2, distance: f64) -> Self {
        Self {
            anchors: vec![anchor],
            text: text.into(),
            toward,
            colour: INK,
            distance,
            size: TEXT,
            within: None,
            leader: true,
        }
    }

    /// The same, or at another of the thing's points if there is more room.
    pub fn or(mut self, anchors: impl IntoIterator<Item = DVec2>) -> Self {
        self.anchors.extend(anchors);
        self
    }

    /// The same in another colour.
    pub fn coloured(self, colour: &'static str) -> Self {
        Self { colour, ..self }
    }

    /// The same, larger or smaller by a factor, and never with a line to it.
    pub fn title(self, factor: f64) -> Self {
        Self { size: self.size * factor, leader: false, ..self }
    }

    /// The same, so large that it can be read where a page is as narrow as a phone.
    pub fn large(self) -> Self {
        Self { size: LARGE_TEXT, ..self }
    }

    /// The same, kept within a part of the drawing.
    pub fn within(self, frame: Frame) -> Self {
        Self { within: Some([frame.low, frame.high]), ..self }
    }
}

impl Placed {
    /// The rectangle that the words take, upper left and lower right, by a cautious guess at the font.
    pub fn extent(&self) -> [DVec2; 2] {
        let parts = self.text.split('`').zip([false, true].into_iter().cycle());
        let width_of = |(part, code): (&str, bool)| -> f64 {
            part.chars().filter(|c| *c != '*').map(|letter| if code { 0.57 } else { letter_width(letter) }).sum()
        };
        let width = parts.map(width_of).sum::<f64>() * self.size;
        let left = match self.anchor {
            "start" => self.at.x,
            "end" => self.at.x - width,
            _ => self.at.x - width / 2.0,
        };
        let half = self.size * 0.62;
        [DVec2::new(left, self.at.y - half), DVec2::new(left + width, self.at.y + half)]
    }

    /// Where a thin line from the point to its words ends, if they stand far enough off to need one.
    pub fn leader(&self) -> Option<DVec2> {
        let [low, high] = self.extent();
        let nearest = self.point.clamp(low, high);
        let gap = nearest - self.point;
        (gap.length() > 22.0).then(|| self.point + gap * (1.0 - 3.0 / gap.length()))
    }
}

/// A letter's width as a fraction of its size.
fn letter_width(letter: char) -> f64 {
    match letter {
        'i' | 'l' | 'j' | '.' | ',' | '(' | ')' | '|' | ' ' | 't' | 'f' | '\'' => 0.38,
        'm' | 'w' | 'M' | 'W' => 0.9,
        _ => 0.62,
    }
}

/// The best place for words: not on other words, within the drawing, across as few lines as may be, near their point.
pub fn place(label: &Label, obstacles: &Obstacles, within: [DVec2; 2]) -> Placed {
    let preferred = label.toward.try_normalize().unwrap_or(DVec2::NEG_Y);
    let mut best = (f64::INFINITY, beside(label, label.anchors[0], preferred, label.distance));
    for (rank, &anchor) in label.anchors.iter().enumerate() {
        for step in 0..16_i32 {
            // Turn by turn away from the preferred side: 0, +1, −1, +2, …
            let turns = (step + 1) / 2 * if step % 2 == 0 { -1 } else { 1 };
            let angle = f64::from(turns) * std::f64::consts::PI / 8.0;
            let side = DVec2::new(libm::cos(angle), libm::sin(angle)).rotate(preferred);
            for further in [0.0, 5.0, 10.0, 16.0, 24.0, 34.0, 48.0, 64.0] {
                let placed = beside(label, anchor, side, label.distance + further);
                let (cost, crosses) = cost(&placed, obstacles, within);
                let cost = cost + 5.0 * f64::from(turns.abs()) + 1.1 * further + 3.0 * rank as f64;
                if cost < best.0 {
                    best = (cost, Placed { crosses, ..placed });
                }
            }
        }
    }
    best.1
}

fn beside(label: &Label, point: DVec2, side: DVec2, distance: f64) -> Placed {
    let anchor = if side.x > 0.4 {
        "start"
    } else if side.x < -0.4 {
        "end"
    } else {
        "middle"
    };
    let at = point + side * distance + DVec2::new(0.0, label.size * 0.5 * side.y);
    Placed { point, at, anchor, size: label.size, colour: label.colour, text: label.text.clone(), crosses: 0 }
}

fn cost(placed: &Placed, obstacles: &Obstacles, within: [DVec2; 2]) -> (f64, usize) {
    let [low, high] = placed.extent();
    let outside = (within[0] - low).max(high - within[1]).max(DVec2::ZERO);
    // Two labels side by side must not read as one.
    let apart = DVec2::new(0.5 * placed.size, 0.0);
    let on_words = obstacles.words.iter().filter(|words| overlap([low - apart, high + apart], **words)).count();
    let crossed = obstacles.strokes.iter().filter(|stroke| crosses(**stroke, [low, high])).count();
    let on_disc = |(centre, radius): &(DVec2, f64)| {
        let nearest = centre.clamp(low, high);
        // A label may stand at the rim of the thing it names, not on it.
        nearest.distance(*centre) < *radius && placed.point.distance(*centre) > 1e-6 || nearest == *centre
    };
    let on_discs = obstacles.discs.iter().filter(|disc| on_disc(disc)).count();
    let leader = placed
        .leader()
        .map_or(0, |end| obstacles.words.iter().filter(|words| crosses([placed.point, end], **words)).count());
    let total = 4000.0 * (outside.x + outside.y)
        + 2000.0 * on_words as f64
        + 1000.0 * leader as f64
        + 45.0 * crossed as f64
        + 80.0 * on_discs as f64;
    (total, crossed)
}

/// Whether two rectangles share an area.
pub fn overlap(a: [DVec2; 2], b: [DVec2; 2]) -> bool {
    a[0].x < b[1].x && b[0].x < a[1].x && a[0].y < b[1].y && b[0].y < a[1].y
}

/// Whether a straight line passes through a rectangle, by cutting it off at the four sides.
pub fn crosses([from, to]: [DVec2; 2], [low, high]: [DVec2; 2]) -> bool {
    let along = to - from;
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        if along[axis] == 0.0 {
            if from[axis] < low[axis] || from[axis] > high[axis] {
                return false;
            }
            continue;
        }
        let (a, b) = ((low[axis] - from[axis]) / along[axis], (high[axis] - from[axis]) / along[axis]);
        (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
    }
    enter < leave
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: [DVec2; 2] = [DVec2::new(10.0, 10.0), DVec2::new(20.0, 14.0)];

    #[test]
    fn a_line_crosses_a_box_or_does_not() {
        assert!(crosses([DVec2::ZERO, DVec2::new(30.0, 24.0)], BOX));
        assert!(!crosses([DVec2::ZERO, DVec2::new(9.0, 9.0)], BOX));
        assert!(!crosses([DVec2::new(0.0, 5.0), DVec2::new(30.0, 5.0)], BOX));
    }

    #[test]
    fn a_label_goes_where_nothing_is() {
        let label = Label::near(DVec2::splat(100.0), "eye", DVec2::X, 8.0);
        let within = [DVec2::ZERO, DVec2::splat(200.0)];
        let free = place(&label, &Obstacles::default(), within);
        assert_eq!((free.anchor, free.crosses), ("start", 0));
        let wall = [DVec2::new(112.0, 0.0), DVec2::new(112.0, 200.0)];
        let blocked = place(&label, &Obstacles { strokes: vec![wall], ..Obstacles::default() }, within);
        assert_eq!(blocked.crosses, 0);
        assert!(blocked.extent()[1].x < 112.0 || blocked.extent()[0].x > 112.0);
    }
}
