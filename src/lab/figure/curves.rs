//! What a ray or a picture costs over the number of things, as it was measured and is kept beside the chapter.

use super::Figure;
use super::label::Label;
use super::pen::{INK, Pen};
use super::svg::{Drawing, Svg};
use glam::DVec2;
use pinhole::scene::{FileKind, read_file};
use pinhole::{Chapter, Error, Result};

/// Where the axes are: left, top, right, bottom.
const FRAME: [f64; 4] = [66.0, 40.0, 566.0, 340.0];
const HEIGHT: f64 = 412.0;
const KEPT: FileKind = FileKind { name: "kept curves", max: 1 << 20 };

/// A table of the kept file: its columns' names, and a row for each count, whose cells may be empty.
#[derive(Clone, Debug, PartialEq)]
struct Kept {
    names: Vec<String>,
    rows: Vec<(f64, Vec<Option<f64>>)>,
}

impl Kept {
    /// The table below the line that starts with this word.
    ///
    /// Names are parted by at least two blanks, numbers by any.
    fn of(text: &str, title: &str) -> Option<Self> {
        let mut lines = text.lines().skip_while(|line| !line.starts_with(title)).skip(1);
        let names = lines.next()?.split("  ").map(str::trim).filter(|name| !name.is_empty());
        let names: Vec<String> = names.skip(1).map(str::to_owned).collect();
        let row = |line: &str| {
            let mut cells = line.split_whitespace();
            let count = cells.next()?.parse().ok()?;
            Some((count, cells.map(|cell| cell.parse().ok()).collect::<Vec<_>>()))
        };
        let rows: Vec<_> = lines.map_while(row).filter(|(_, cells)| cells.len() == names.len()).collect();
        (!rows.is_empty()).then_some(Self { names, rows })
    }

    /// The points of the first column whose name is as asked.
    fn column(&self, is: impl Fn(&str) -> bool) -> Vec<(f64, f64)> {
        let Some(at) = self.names.iter().position(|name| is(name)) else { return Vec::new() };
        self.rows.iter().filter_map(|(count, cells)| Some((*count, cells[at]?))).collect()
    }

    /// The points of the column of what must be in a cache.
    fn sizes(&self) -> Vec<(f64, f64)> {
        self.column(|name| name.ends_with(" KiB"))
    }
}

/// A curve: its column, what it is called, its pen.
type Shown = (&'static str, &'static str, Pen);

const GREY: &str = "#8a8a8a";
const ORANGE: &str = "#d9822b";
const BLUE: &str = "#4a90c9";
const GREEN: &str = "#4f9d5d";

/// What a figure's axes stand for.
#[derive(Clone, Copy)]
struct Axes {
    /// The word that the table's title starts with, and that stands below the axis across.
    across: &'static str,
    /// What takes the time.
    up: &'static str,
    /// The power of ten of the table's unit in nanoseconds.
    unit: i32,
    /// What measures it again.
    bench: &'static str,
}

const OF_RAYS: Axes = Axes { across: "", up: "a ray", unit: 0, bench: "--bench curves -- --write" };
const OF_PICTURES: Axes =
    Axes { across: "", up: "a picture", unit: 6, bench: "--bench rasterisation -- curves --write" };

/// Triangles of a mesh.
pub fn draw_triangles(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let shown = [
        ("all, random", "all of them", Pen::new(GREY, 1.8)),
        ("binary, random", "binary, random", Pen::new(GREEN, 1.8)),
        ("alone, random", "wide, random", Pen::new(ORANGE, 1.8).dashed("5 4")),
        ("lockstep, random", "in lockstep", Pen::new(ORANGE, 2.2)),
        ("alone, coherent", "wide, coherent", Pen::new(BLUE, 1.8).dashed("5 4")),
        ("packets, coherent", "in packets", Pen::new(BLUE, 2.2)),
    ];
    draw(chapter, figure, Axes { across: "triangles", ..OF_RAYS }, &shown)
}

/// Spheres at random.
pub fn draw_spheres(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let shown = [
        ("all, random", "all of them", Pen::new(GREY, 1.8)),
        ("binary, random", "binary, random", Pen::new(GREEN, 1.8)),
        ("wide, random", "wide, random", Pen::new(ORANGE, 2.2)),
        ("wide, coherent", "wide, coherent", Pen::new(BLUE, 2.2)),
    ];
    draw(chapter, figure, Axes { across: "spheres", ..OF_RAYS }, &shown)
}

/// One piece of work written three ways.
pub fn draw_rows(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let shown = [
        ("by library", "by library", Pen::new(GREY, 1.8)),
        ("by series", "by series", Pen::new(GREEN, 1.8)),
        ("in columns", "in columns", Pen::new(ORANGE, 2.2)),
        ("fused", "fused", Pen::new(BLUE, 2.2)),
    ];
    draw(chapter, figure, Axes { across: "rows", up: "a row", unit: 0, bench: "--bench rows -- --write" }, &shown)
}

/// First hits by both classes in a small and a large picture, and what rays need beforehand.
pub fn draw_first_hits_by_triangles(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let shown = [
        ("rays 320 × 180", "rays 320 × 180", Pen::new(BLUE, 1.8).dashed("5 4")),
        ("projection 320 × 180", "projection", Pen::new(ORANGE, 1.8).dashed("5 4")),
        ("rays 1920 × 1080", "rays 1920 × 1080", Pen::new(BLUE, 2.2)),
        ("projection 1920 × 1080", "projection", Pen::new(ORANGE, 2.2)),
        ("hierarchy", "building the tree", Pen::new(GREY, 1.8)),
    ];
    draw(chapter, figure, Axes { across: "triangles", ..OF_PICTURES }, &shown)
}

/// First hits by both classes.
pub fn draw_first_hits_by_pixels(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let shown = [("rays", "rays", Pen::new(BLUE, 2.2)), ("projection", "projection", Pen::new(ORANGE, 2.2))];
    draw(chapter, figure, Axes { across: "pixels", ..OF_PICTURES }, &shown)
}

/// A lit picture, with shadows and without.
pub fn draw_by_lights(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let shown = [
        ("rays, each light", "rays, each light", Pen::new(BLUE, 2.2)),
        ("projection, each light", "projection", Pen::new(ORANGE, 2.2)),
        ("without shadows", "without shadows", Pen::new(ORANGE, 1.8).dashed("5 4")),
        ("rays, one light", "rays, one chosen", Pen::new(BLUE, 2.2)),
        ("projection, one light", "projection", Pen::new(ORANGE, 2.2)),
        ("one, without shadows", "without shadows", Pen::new(ORANGE, 1.8).dashed("5 4")),
    ];
    draw(chapter, figure, Axes { across: "lights", ..OF_PICTURES }, &shown)
}

fn draw(chapter: &Chapter, figure: &Figure, axes: Axes, shown: &[Shown]) -> Result<Drawing> {
    let what = axes.across;
    let file = crate::repository().join("chapters").join(chapter.name).join("curves.txt");
    let text = read_file(&file, KEPT).unwrap_or_default();
    let text = String::from_utf8_lossy(&text);
    let missing = || {
        let place = format!("chapters/{}/curves.txt", chapter.name);
        Error::Usage(format!("{place} has no curve of {what}; `cargo bench {}` measures it", axes.bench))
    };
    let kept = Kept::of(&text, what).ok_or_else(missing)?;
    let points = || shown.iter().flat_map(|(column, ..)| kept.column(|name| name == *column));
    let xs = decades(points().map(|(count, _)| count));
    let (ys, levels) = levels(points().map(|(_, ns)| ns));
    let [left, top, right, bottom] = FRAME;
    let at = |(count, ns): (f64, f64)| {
        let part = |value: f64, [low, high]: [f64; 2]| (libm::log10(value) - low) / (high - low);
        DVec2::new(left + (right - left) * part(count, xs), bottom - (bottom - top) * part(ns, ys))
    };
    let mut svg = Svg::new(figure.name, HEIGHT);
    let grid = Pen::new(INK, 0.8).faint(0.16);
    for decade in xs[0] as i32..=xs[1] as i32 {
        let count = libm::exp10(f64::from(decade));
        let [foot, head] = [ys[0], ys[1]].map(|end| at((count, libm::exp10(end))));
        svg.quiet_line(foot, head, grid);
        svg.label(Label::near(foot, &power(decade), DVec2::Y, 5.0).title(0.85));
    }
    for (step, decade) in levels {
        let ns = f64::from(step) * libm::exp10(f64::from(decade));
        let [foot, end] = [xs[0], xs[1]].map(|end| at((libm::exp10(end), ns)));
        svg.quiet_line(foot, end, grid);
        svg.label(Label::near(foot, &time(step, decade + axes.unit), DVec2::NEG_X, 6.0).title(0.85));
    }
    let caches = caches(&text);
    for (place, (name, kib)) in caches.iter().enumerate() {
        let sizes = kept.sizes();
        let Some(count) = crossing(&sizes, *kib) else { continue };
        let x = at((count, 1.0)).x;
        svg.quiet_line(DVec2::new(x, top), DVec2::new(x, bottom), Pen::new(INK, 1.0).faint(0.5).dashed("2 4"));
        let words = if place == 0 { format!("fills {name}") } else { name.clone() };
        svg.label(Label::near(DVec2::new(x, top), &words, DVec2::NEG_Y, 4.0).title(0.85));
    }
    let mut ends = Vec::new();
    for (column, name, pen) in shown {
        let points = kept.column(|name| name == *column);
        for pair in points.windows(2) {
            svg.quiet_line(at(pair[0]), at(pair[1]), *pen);
        }
        points.iter().for_each(|&point| svg.dot(at(point), 2.4, pen.colour));
        ends.extend(points.last().map(|&point| (at(point), *name, pen.colour)));
    }
    // Each name at the end of its curve, none on another.
    ends.sort_by(|one, other| one.0.y.total_cmp(&other.0.y));
    let mut last = [f64::NEG_INFINITY; 2];
    for (end, name, colour) in ends {
        let is_right = usize::from(end.x > right - 90.0);
        let y = f64::max(end.y, last[is_right] + 17.0);
        last[is_right] = y;
        svg.label(Label::near(DVec2::new(end.x, y), name, DVec2::X, 7.0).coloured(colour).title(0.92));
    }
    let middle = DVec2::new(0.5 * (left + right), bottom + 22.0);
    svg.label(Label::near(middle, what, DVec2::Y, 0.0).title(0.92));
    svg.label(Label::near(DVec2::new(left, 14.0), axes.up, DVec2::X, 0.0).title(0.92));
    let note = machine(&text).unwrap_or_default();
    Ok(svg.finish(figure.about, &figure.kept_stamp(&note)))
}

/// Four scenes, and each method's error against time.
pub fn draw_methods(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    const METHODS: [(&str, &str, Pen); 4] = [
        ("path_tracing", "path tracing", Pen::new(GREY, 2.0)),
        ("light_tracing", "light tracing", Pen::new(GREEN, 2.0)),
        ("photon_mapping", "photon mapping", Pen::new(ORANGE, 2.0)),
        ("bidirectional_path_tracing", "from both ends", Pen::new(BLUE, 2.0)),
    ];
    let place = format!("chapters/{}/curves.txt", chapter.name);
    let text = read_file(&crate::repository().join(&place), KEPT).unwrap_or_default();
    let text = String::from_utf8_lossy(&text);
    let mut svg = Svg::new(figure.name, 566.0);
    for ((_, name, pen), x) in METHODS.iter().zip([66.0, 226.0, 386.0, 556.0]) {
        svg.quiet_line(DVec2::new(x, 16.0), DVec2::new(x + 22.0, 16.0), *pen);
        svg.label(Label::near(DVec2::new(x + 26.0, 16.0), name, DVec2::X, 3.0).coloured(pen.colour).title(0.92));
    }
    let titles = ["keyhole", "pool", "Cornell box", "Veach's plates"];
    for (panel, title) in titles.into_iter().enumerate() {
        let missing =
            || Error::Usage(format!("{place} has no curve of {title}; `measure {}` measures it", chapter.name));
        let kept = Kept::of(&text, title).ok_or_else(missing)?;
        let points = |method: &str| {
            let [errors, times] =
                [method.into(), format!("{method} ms")].map(|it: String| kept.column(|name| name == it));
            let pairs = times.iter().zip(&errors).map(|((_, time), (_, error))| (*time, *error));
            pairs.filter(|(_, error)| *error > 0.0).collect::<Vec<_>>()
        };
        let all = || METHODS.iter().flat_map(|(method, ..)| points(method));
        let (xs, ys) = (decades(all().map(|(time, _)| time)), decades(all().map(|(_, error)| error)));
        let low = DVec2::new(66.0 + 350.0 * (panel % 2) as f64, 268.0 + 240.0 * (panel / 2) as f64);
        let size = DVec2::new(280.0, -190.0);
        let at = |(time, error): (f64, f64)| {
            let part = |value: f64, [low, high]: [f64; 2]| (libm::log10(value) - low) / (high - low);
            low + size * DVec2::new(part(time, xs), part(error, ys))
        };
        let grid = Pen::new(INK, 0.8).faint(0.16);
        for decade in xs[0] as i32..=xs[1] as i32 {
            let [foot, head] = ys.map(|end| at((libm::exp10(f64::from(decade)), libm::exp10(end))));
            svg.quiet_line(foot, head, grid);
            svg.label(Label::near(foot, &time(1, decade + 6), DVec2::Y, 5.0).title(0.85));
        }
        for decade in ys[0] as i32..=ys[1] as i32 {
            let error = libm::exp10(f64::from(decade));
            let [foot, end] = xs.map(|end| at((libm::exp10(end), error)));
            svg.quiet_line(foot, end, grid);
            svg.label(Label::near(foot, &format!("{error}"), DVec2::NEG_X, 6.0).title(0.85));
        }
        let middle = low + DVec2::new(0.5 * size.x, size.y);
        svg.label(Label::near(middle, title, DVec2::NEG_Y, 6.0).title(0.92));
        for (method, _, pen) in METHODS {
            let points = points(method);
            points.windows(2).for_each(|pair| svg.quiet_line(at(pair[0]), at(pair[1]), pen));
            points.iter().for_each(|&point| svg.dot(at(point), 2.4, pen.colour));
        }
    }
    Ok(svg.finish(figure.about, &figure.kept_stamp(&machine(&text).unwrap_or_default())))
}

/// The whole decades around these numbers.
fn decades(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let logs: Vec<f64> = values.filter(|value| *value > 0.0).map(libm::log10).collect();
    let low = logs.iter().copied().fold(f64::INFINITY, f64::min).floor();
    let high = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max).ceil();
    if logs.is_empty() { [0.0, 1.0] } else { [low, f64::max(high, low + 1.0)] }
}

/// The same where whole decades leave room for what lies between: the logarithms of the ends, and the lines, each a
/// number times a power of ten.
///
/// Of values within a decade and a half, the axis begins and ends at 1, 2 or 5 of a decade.
fn levels(values: impl Iterator<Item = f64> + Clone) -> ([f64; 2], Vec<(i32, i32)>) {
    let ends = decades(values.clone());
    let whole = (ends[0] as i32..=ends[1] as i32).map(|decade| (1, decade));
    let [low, high] = values
        .filter(|value| *value > 0.0)
        .fold([f64::INFINITY, 0.0], |[low, high], value| [low.min(value), high.max(value)]);
    if !(high / low < 30.0) {
        return (ends, whole.collect());
    }
    let steps: Vec<(i32, i32)> = whole.flat_map(|(_, decade)| [1, 2, 5].map(|step| (step, decade))).collect();
    let value = |&(step, decade): &(i32, i32)| f64::from(step) * libm::exp10(f64::from(decade));
    let first = steps.iter().rposition(|step| value(step) <= low).unwrap_or(0);
    let last = steps.iter().position(|step| value(step) >= high).unwrap_or(steps.len() - 1);
    ([first, last].map(|end| libm::log10(value(&steps[end]))), steps[first..=last].to_vec())
}

/// 10, 100, 1000, 10⁴ …
fn power(decade: i32) -> String {
    const RAISED: [&str; 10] = ["⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"];
    if decade < 4 {
        format!("{}", libm::exp10(f64::from(decade)))
    } else {
        format!("10{}", RAISED[decade as usize % 10])
    }
}

/// So many times a power of ten nanoseconds.
fn time(step: i32, decade: i32) -> String {
    let (unit, ns) = if decade < 3 {
        ("ns", decade)
    } else if decade < 6 {
        ("µs", decade - 3)
    } else if decade < 9 {
        ("ms", decade - 6)
    } else {
        ("s", decade - 9)
    };
    format!("{} {unit}", f64::from(step) * libm::exp10(f64::from(ns)))
}

/// The caches that the file names, in KiB.
fn caches(text: &str) -> Vec<(String, f64)> {
    let Some((_, list)) = text.split_once("caches: ") else { return Vec::new() };
    let list = list.lines().next().unwrap_or_default().split(", ");
    let cache = |words: &str| {
        let mut words = words.split(' ');
        Some((words.next()?.to_owned(), words.next()?.parse().ok()?))
    };
    list.filter_map(cache).collect()
}

/// Where a curve first comes to a size, between two of its points on a straight line of logarithms.
fn crossing(sizes: &[(f64, f64)], size: f64) -> Option<f64> {
    let pair = sizes.windows(2).find(|pair| pair[0].1 < size && pair[1].1 >= size)?;
    let [(x, low), (end, high)] = [pair[0], pair[1]].map(|(count, size)| (libm::log10(count), libm::log10(size)));
    Some(libm::exp10(x + (end - x) * (libm::log10(size) - low) / (high - low)))
}

fn machine(text: &str) -> Option<String> {
    let (_, rest) = text.split_once("machine: ")?;
    rest.split([';', '\n']).next().map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "ns\n\ntriangles of a knot\n    count  all, random  hierarchy KiB\n      100         10.0           8\n\
                        1000            -          80\n\nspheres\n    count  b\n  1  2\n\nmachine: M; caches: L1 32 KiB, L2 1024 KiB\n";

    #[test]
    fn a_kept_table_is_read_by_its_names() {
        let kept = Kept::of(TEXT, "triangles").expect("a table");
        assert_eq!(kept.names, ["all, random", "hierarchy KiB"]);
        assert_eq!(kept.column(|name| name == "all, random"), [(100.0, 10.0)]);
        assert_eq!(kept.sizes(), [(100.0, 8.0), (1000.0, 80.0)]);
        assert_eq!(Kept::of(TEXT, "spheres").expect("a table").column(|name| name == "b"), [(1.0, 2.0)]);
        assert_eq!(Kept::of(TEXT, "cubes"), None);
        assert_eq!(caches(TEXT), [("L1".to_owned(), 32.0), ("L2".to_owned(), 1024.0)]);
        assert_eq!(machine(TEXT).as_deref(), Some("M"));
        assert_eq!(machine("machine: M\nmade from 1").as_deref(), Some("M"));
        let count = crossing(&kept.sizes(), 80.0).expect("it comes to that");
        assert!((count - 1000.0).abs() < 1e-9 && crossing(&kept.sizes(), 90.0).is_none());
        assert_eq!(
            [time(1, 0), time(1, 2), time(5, 3), time(1, 7), time(1, 10), power(3), power(7)],
            ["1 ns", "100 ns", "5 µs", "10 ms", "10 s", "1000", "10⁷"]
        );
        let ([low, high], lines) = levels([1.5, 16.7].into_iter());
        assert_eq!((low, lines), (0.0, vec![(1, 0), (2, 0), (5, 0), (1, 1), (2, 1)]));
        assert!((high - libm::log10(20.0)).abs() < 1e-12);
        assert_eq!(levels([1.5, 167.0].into_iter()), ([0.0, 3.0], vec![(1, 0), (1, 1), (1, 2), (1, 3)]));
    }
}
