//! The third set: written from the pages when the second had been seen to, before looking at what had become of it.

use super::programs::Edit;

/// Mistakes.
pub const MISTAKES: [Edit; 52] = [
    (1, "nearest(point, to_light).is_some_and", "nearest(point, to_light.unit()).is_some_and"),
    (1, "sphere.radius * sphere.radius;", "sphere.radius;"),
    (1, "V(0.5, 0.7, 1.0)", "V(1.0, 0.7, 0.5)"),
    (1, "radiance(V(0.0, 0.0, 0.0), V(right, up, -1.0))", "radiance(V(right, up, 0.0), V(0.0, 0.0, -1.0))"),
    (5, "(ANGLE / 2.0).to_radians().tan()", "(ANGLE / 2.0).tan()"),
    (5, "LIGHT.sub(point)", "point.sub(LIGHT)"),
    (5, "sphere.colour.times(irradiance / PI)", "sphere.colour.times(irradiance / PI / PI)"),
    (5, "V(half * right, half * up, -1.0)", "V(half * right, half * up, -half)"),
    (9, "EYE.sub(TARGET).unit()", "TARGET.sub(EYE).unit()"),
    (9, "add(upward.times(up)).sub(back)", "add(upward.times(up)).add(V(0.0, 0.0, -1.0))"),
    (
        9,
        "let up = half * (1.0 - 2.0 * y / HEIGHT as f64);",
        "let up = half * (1.0 - 2.0 * y / HEIGHT as f64) * WIDTH as f64 / HEIGHT as f64;",
    ),
    (9, "to_the_right.times(right).add(upward.times(up))", "to_the_right.times(up).add(upward.times(right))"),
    (10, "light_at(point, normal)).times(1.0 / PI)", "light_at(point, normal))"),
    (10, "lamp.sub(start)", "lamp.sub(start).unit()"),
    (10, "light = light.add(", "light = V(0.0, 0.0, 0.0).add("),
    (10, "1.055 * light.powf(1.0 / 2.4) - 0.055", "1.055 * light.powf(1.0 / 2.4)"),
    (13, "(t > 0.0 && t.is_finite()).then_some((t, normal))", "t.is_finite().then_some((t.abs(), normal))"),
    (13, "direction.2, V(0.0, 0.0, 1.0)", "direction.2, V(0.0, 1.0, 0.0)"),
    (13, "hits.min_by(", "hits.max_by("),
    (13, "from_centre.add(direction.times(t)).unit()", "from_centre.add(direction.times(t))"),
    (17, "for _ in 0..SAMPLES {", "for _ in 1..SAMPLES {"),
    (17, "x as f64 + right, y as f64 + down", "x as f64 + right - 0.5, y as f64 + down - 0.5"),
    (17, "(1_u64 << 53)", "(1_u64 << 52)"),
    (19, "direction.sub(normal.times(2.0", "direction.add(normal.times(2.0"),
    (19, "origin = point.add(normal.times(1e-9));", ""),
    (19, "weight = weight.by(colour);", ""),
    (20, "if enters { index } else { 1.0 / index }", "index"),
    (20, "origin = point.sub(normal.times(1e-9));", "origin = point.add(normal.times(1e-9));"),
    (20, "let cosine = -normal.dot(direction);", "let cosine = normal.dot(direction);"),
    (20, "reflected_part(eta, cosine, beyond)", "reflected_part(1.0 / eta, cosine, beyond)"),
    (20, "direction = direction.unit();", ""),
    (21, "4.0 * PI * radius * radius", "PI * radius * radius"),
    (21, "cosine * cosine_there * area", "cosine * area"),
    (21, "area / to_lamp.dot(to_lamp)", "area / to_lamp.dot(to_lamp).sqrt()"),
    (21, "centre.add(outward.times(radius))", "centre.add(outward)"),
    (23, "radiance(start, in_focus.sub(start), &mut random)", "radiance(start, direction, &mut random)"),
    (23, "let angle = 2.0 * PI * random.next();", "let angle = PI * random.next();"),
    (23, "EYE.add(across).add(upward", "across.add(upward"),
    (
        25,
        "weight = weight.by(colour);\n                sum = sum.add(weight.by(light).times(1.0 / PI));",
        "sum = sum.add(weight.by(light).times(1.0 / PI));\n                weight = weight.by(colour);",
    ),
    (25, "lamps_count = false;", ""),
    (
        25,
        "origin = point.add(normal.times(1e-9));\n                lamps_count",
        "origin = point;\n                lamps_count",
    ),
    (25, "return sum.add(weight.by(V(0.5, 0.7, 1.0)));", "return weight.by(V(0.5, 0.7, 1.0));"),
    (26, "(other / pdf) * (other / pdf)", "(pdf / other) * (pdf / other)"),
    (26, "emitted.times(part * cosine", "emitted.times(cosine"),
    (26, "lamp_pdf(point.sub(origin), outward)", "lamp_pdf(origin.sub(point), outward)"),
    (28, "u >= 0.0 && v >= 0.0 && u + v", "u >= 0.0 && u + v"),
    (28, "normal.unit()))", "normal))"),
    (30, "t < best.0", "t > best.0"),
    (
        30,
        "let others = things.split_off(things.len() / 2);",
        "let mut others = things.split_off(things.len() / 2);\n    others.remove(0);",
    ),
    (33, "depth >= pixel.0", "depth <= pixel.0"),
    (33, "(width + right * height) / 2.0", "(1.0 + right) * width / 2.0"),
    (33, "V(x as f64 + 0.5, y as f64 + 0.5, 0.0)", "V(x as f64, y as f64, 0.0)"),
];

/// Programs that are right, and look unlike the book's.
pub const RIGHT: [Edit; 23] = [
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
];
