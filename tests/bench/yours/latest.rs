//! The latest set: mistakes written from the pages when the sets before had been seen to, and tried once; and right programs.

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
pub const RIGHT: [Edit; 29] = [
    (1, "light.clamp(0.0, 1.0).sqrt()) as u8", "light.sqrt()).min(255.0) as u8"),
    (1, "normal.dot(to_light.unit()).max(0.0)", "(normal.dot(to_light) / to_light.dot(to_light).sqrt()).max(0.0)"),
    (5, "(2.0 * x - WIDTH as f64) / HEIGHT as f64", "(2.0 * x / WIDTH as f64 - 1.0) * (WIDTH as f64 / HEIGHT as f64)"),
    (5, "V(half * right, half * up, -1.0)", "V(right, up, -1.0 / half)"),
    (9, "V(0.0, 1.0, 0.0).cross(back).unit()", "V(back.2, 0.0, -back.0).unit()"),
    (9, "(1.0 - 2.0 * y / HEIGHT as f64)", "(HEIGHT as f64 - 2.0 * y) / HEIGHT as f64"),
    (10, "nearest(start, to_lamp).is_none_or(|hit| hit.0 > 1.0)", "nearest(lamp, start.sub(lamp)).is_none_or(|hit| hit.0 > 1.0 - 1e-6)"),
    (10, "1.055 * light.powf(1.0 / 2.4) - 0.055", "f64::from(1.055 * (light as f32).powf(1.0 / 2.4) - 0.055)"),
    (13, "(height - normal.dot(origin)) / normal.dot(direction)", "normal.times(height).sub(origin).dot(normal) / direction.dot(normal)"),
    (
        13,
        "let half_b = from_centre.dot(direction);
            let c = from_centre.dot(from_centre) - radius * radius;
            let root = (half_b * half_b - a * c).sqrt(); // NaN: a miss
            let both = [(-half_b - root) / a, (-half_b + root) / a];",
        "let b = 2.0 * from_centre.dot(direction);
            let c = from_centre.dot(from_centre) - radius * radius;
            if b * b < 4.0 * a * c {
                return None;
            }
            let root = (b * b - 4.0 * a * c).sqrt();
            let both = [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)];",
    ),
    (17, "SAMPLES: usize = 64;", "SAMPLES: usize = 25;"),
    (17, "Random((y * WIDTH + x) as u64)", "Random(((x as u64) << 32) ^ (7919 * y as u64))"),
    (
        17,
        "for _ in 0..SAMPLES {
        let (right, down) = (random.next(), random.next());",
        "let first = (random.next(), random.next());
    for sample in 0..SAMPLES {
        let sample = sample as f64;
        let (right, down) = ((first.0 + 0.754_877_666_246_692_7 * sample).fract(), (first.1 + 0.569_840_290_998_053_2 * sample).fract());",
    ),
    (19, "direction.sub(normal.times(2.0 * normal.dot(direction)))", "direction.sub(normal.times(normal.dot(direction))).times(2.0).sub(direction)"),
    (
        20,
        "let across = (cosine - eta * cosine_beyond) / (cosine + eta * cosine_beyond);
    let along = (cosine_beyond - eta * cosine) / (cosine_beyond + eta * cosine);",
        "let n = 1.0 / eta;
    let across = (n * cosine - cosine_beyond) / (n * cosine + cosine_beyond);
    let along = (n * cosine_beyond - cosine) / (n * cosine_beyond + cosine);",
    ),
    (
        21,
        "let height = 2.0 * self.next() - 1.0;
        let angle = 2.0 * PI * self.next();
        let across = (1.0 - height * height).sqrt();
        V(across * angle.cos(), height, across * angle.sin())",
        "loop {
            let (x, y) = (2.0 * self.next() - 1.0, 2.0 * self.next() - 1.0);
            let square = x * x + y * y;
            if square < 1.0 {
                let root = 2.0 * (1.0 - square).sqrt();
                return V(x * root, y * root, 1.0 - 2.0 * square);
            }
        }",
    ),
    (
        21,
        "let outward = random.direction();
    let start = point.add(normal.times(1e-9)); // off the surface
    let to_lamp = centre.add(outward.times(radius)).sub(start);
    let toward = to_lamp.unit();
    let (cosine, cosine_there) = (normal.dot(toward), -outward.dot(toward));",
        "// In the cone of directions that the lamp fills.
    let start = point.add(normal.times(1e-9));
    let to_centre = centre.sub(start);
    let least = (1.0 - radius * radius / to_centre.dot(to_centre)).max(0.0).sqrt();
    let axis = to_centre.unit();
    let aside = if axis.0.abs() < 0.5 { V(1.0, 0.0, 0.0) } else { V(0.0, 1.0, 0.0) };
    let first = V(axis.1 * aside.2 - axis.2 * aside.1, axis.2 * aside.0 - axis.0 * aside.2, axis.0 * aside.1 - axis.1 * aside.0).unit();
    let second = V(axis.1 * first.2 - axis.2 * first.1, axis.2 * first.0 - axis.0 * first.2, axis.0 * first.1 - axis.1 * first.0);
    let height = 1.0 - random.next() * (1.0 - least);
    let (across, angle) = ((1.0 - height * height).max(0.0).sqrt(), 2.0 * PI * random.next());
    let toward = axis.times(height).add(first.times(across * angle.cos())).add(second.times(across * angle.sin()));
    let cosine = normal.dot(toward);
    let seen = nearest(start, toward).is_some_and(|(_, _, thing)| matches!(thing.1, Lamp(_)));
    if seen && cosine > 0.0 {
        return emitted.times(cosine * 2.0 * PI * (1.0 - least));
    }
    let (to_lamp, outward, cosine, cosine_there) = (toward, toward, 0.0, 0.0);",
    ),
    (
        23,
        "let distance = LENS * random.next().sqrt();
    let angle = 2.0 * PI * random.next();
    let across = to_the_right.times(distance * angle.cos());
    EYE.add(across).add(upward.times(distance * angle.sin()))",
        "loop {
        let (x, y) = (2.0 * random.next() - 1.0, 2.0 * random.next() - 1.0);
        if x * x + y * y < 1.0 {
            return EYE.add(to_the_right.times(LENS * x)).add(upward.times(LENS * y));
        }
    }",
    ),
    (
        25,
        "direction = normal.add(random.direction());",
        "direction = random.direction();
                if direction.dot(normal) < 0.0 {
                    direction = direction.times(-1.0);
                }
                weight = weight.times(2.0 * normal.dot(direction));",
    ),
    (25, "weight.0.max(weight.1).max(weight.2).min(1.0)", "((weight.0 + weight.1 + weight.2) / 3.0).min(0.95)"),
    (26, "1.0 / (1.0 + (other / pdf) * (other / pdf))", "if pdf >= other { 1.0 } else { 0.0 }"),
    (30, "things.len() <= 4", "things.len() <= 1"),
    (33, "depth >= pixel.0", "depth > pixel.0"),
    (5, "normal.dot(to_light.unit())", "to_light.unit().dot(normal)"),
    (9, "EYE.sub(TARGET).unit()", "TARGET.sub(EYE).unit().times(-1.0)"),
    (10, "hit.0 > 1.0", "hit.0 >= 1.0"),
    (13, "t > 0.0 && t.is_finite()", "t > 0.0 && t < 1e12"),
    (17, "(1_u64 << 53) as f64", "9_007_199_254_740_992.0"),
    (19, "for _ in 0..12 {", "for _ in 0..40 {"),
];
