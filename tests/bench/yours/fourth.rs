//! The fourth set, of the first chapters: written from the pages when the third had been seen to.

use super::programs::Edit;

/// Mistakes.
pub const MISTAKES: [Edit; 27] = [
    (1, "point.sub(sphere.centre).unit()", "sphere.centre.sub(point).unit()"),
    (1, "(y as f64 + 0.5) / height", "(y as f64) / height"),
    (1, "light = 0.1", "light = 1.0"),
    (1, "from_centre.dot(direction)", "origin.dot(direction)"),
    (5, "2.0 * x - WIDTH as f64", "x - WIDTH as f64"),
    (5, "to_light.dot(to_light)", "to_light.dot(normal)"),
    (5, "const ANGLE: f64 = 60.0", "const ANGLE: f64 = 90.0"),
    (9, "const TARGET: V = V(0.0, -0.3, -3.0)", "const TARGET: V = V(0.0, 0.3, -3.0)"),
    (9, "self.2 * o.0 - self.0 * o.2", "self.0 * o.2 - self.2 * o.0"),
    (9, "back.cross(to_the_right)", "to_the_right.cross(back)"),
    (10, "V(self.0 * o.0, self.1 * o.1, self.2 * o.2)", "V(self.0 * o.0, self.1 * o.0, self.2 * o.0)"),
    (10, "point.add(normal.times(1e-9))", "point.sub(normal.times(1e-9))"),
    (10, "1.0 / 2.4", "1.0 / 2.2"),
    (10, "intensity.times(cosine /", "intensity.times(1.0 /"),
    (
        13,
        "(height - normal.dot(origin)) / normal.dot(direction)",
        "(height - normal.dot(origin)) / direction.dot(direction)",
    ),
    (13, "enters.0 <= leaves.0", "enters.0 >= leaves.0"),
    (13, "false => (high, low, 1.0)", "false => (low, high, 1.0)"),
    (13, "from_centre.dot(from_centre) - radius", "from_centre.dot(from_centre) + radius"),
    (17, "sum = sum.add(radiance(EYE, direction));", "sum = radiance(EYE, direction);"),
    (17, "1.0 / SAMPLES as f64", "1.0 / 100.0"),
    (19, "weight.by(V(0.5, 0.7, 1.0))", "V(0.5, 0.7, 1.0)"),
    (19, "direction = mirrored;", "direction = normal;"),
    (20, "direction.times(1.0 / eta).add(down)", "direction.add(down)"),
    (20, "squared <= 0.0 || random.next() < reflected", "squared <= 0.0"),
    (20, "(1.0 - cosine * cosine)", "(cosine * cosine)"),
    (21, "hidden || cosine <= 0.0", "cosine <= 0.0"),
    (21, "cosine * cosine_there * area", "cosine_there * area"),
];
