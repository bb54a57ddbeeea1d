//! The fourth set: written from the pages when the third had been seen to, and tried once.

use super::programs::Edit;

/// Mistakes.
pub const MISTAKES: [Edit; 28] = [
    (1, "/ width as f64 - 1.0) * aspect", "/ width as f64 - 1.0)"),
    (1, "|(t, _)| t < 1.0", "|(t, _)| t > 1.0"),
    (5, "LIGHT.sub(point)", "LIGHT.sub(origin)"),
    (5, "(255.0 * light", "(100.0 * light"),
    (9, "upward.times(up)", "V(0.0, 1.0, 0.0).times(up)"),
    (9, "EYE.sub(TARGET).unit()", "TARGET.times(-1.0).unit()"),
    (10, "..0.0031308 => 12.92 * light", "..0.0031308 => light"),
    (10, "sphere.colour.by(light_at(point, normal))", "light_at(point, normal)"),
    (13, "let faces = normal.dot(direction) < 0.0;", "let faces = true;"),
    (13, "hits.min_by(|a, b| a.0.total_cmp(&b.0))", "{ hits }.next()"),
    (17, "let (right, down) =", "let mut random = Random((y * WIDTH + x) as u64);\n        let (right, down) ="),
    (19, "weight = weight.by(colour);", "weight = weight.add(colour);"),
    (20, "(1.0 - cosine * cosine) / (eta * eta)", "(1.0 - cosine) / (eta * eta)"),
    (20, "random.next() < reflected", "random.next() < 0.5"),
    (
        21,
        "let outward = random.direction();",
        "let outward = V(2.0 * random.next() - 1.0, 2.0 * random.next() - 1.0, 2.0 * random.next() - 1.0).unit();",
    ),
    (21, "cosine_there * area / to_lamp", "cosine_there / to_lamp"),
    (21, "nearest(start, to_lamp)", "nearest(start, toward)"),
    (23, "to_the_right.times(distance * angle.cos())", "V(distance * angle.cos(), 0.0, 0.0)"),
    (
        25,
        "if random.next() >= survives {\n            return sum;",
        "if random.next() >= survives {\n            return V(0.0, 0.0, 0.0);",
    ),
    (
        25,
        "direction = normal.add(random.direction());",
        "direction = normal.add(random.direction());\n                weight = weight.times(normal.dot(direction.unit()));",
    ),
    (26, "pdf = normal.dot(direction) / PI;", "pdf = 1.0;"),
    (26, "1.0 / (1.0 + (other / pdf) * (other / pdf))", "1.0 / (1.0 + other)"),
    (28, "u + v <= 1.0", "u <= v"),
    (30, "best = Some((t, normal, thing));", "return Some((t, normal, thing));"),
    (30, "best = search(half, origin, direction, best);", "best = best.or(search(half, origin, direction, best));"),
    (33, "let depth = 1.0 / (parts[0] / a.2 + parts[1] / b.2 + parts[2] / c.2);", "let depth = a.2;"),
    (33, "point.sub(EYE), (ANGLE / 2.0)", "point.sub(EYE), ANGLE"),
    (33, "|part| part < 0.0", "|part| part < 0.1"),
];

/// Programs that are right, and look unlike the book's.
pub const RIGHT: [Edit; 6] = [
    (5, "normal.dot(to_light.unit())", "to_light.unit().dot(normal)"),
    (9, "EYE.sub(TARGET).unit()", "TARGET.sub(EYE).unit().times(-1.0)"),
    (10, "hit.0 > 1.0", "hit.0 >= 1.0"),
    (13, "t > 0.0 && t.is_finite()", "t > 0.0 && t < 1e12"),
    (17, "(1_u64 << 53) as f64", "9_007_199_254_740_992.0"),
    (19, "for _ in 0..12 {", "for _ in 0..40 {"),
];
