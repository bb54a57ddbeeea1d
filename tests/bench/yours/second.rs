//! The second set: written from the pages when the first had been seen to, before looking at what was known by then.

use super::programs::Edit;

/// Mistakes.
pub const MISTAKES: [Edit; 50] = [
    (1, "let up = 1.0 - 2.0 * (y as f64", "let up = 1.0 - 2.0 * (x as f64"),
    (1, "(2.0 * (x as f64 + 0.5) / width as f64 - 1.0) * aspect", "2.0 * (x as f64 + 0.5) / height as f64 - 1.0"),
    (1, "light += BRIGHTNESS", "light = BRIGHTNESS"),
    (1, "if t < min {", "if t < f64::INFINITY {"),
    (1, "self.times(1.0 / self.dot(self).sqrt())", "self.times(1.0 / self.dot(self))"),
    (5, "to_radians().tan()", "to_radians().sin()"),
    (5, "2.0 * y / HEIGHT as f64", "2.0 * y / WIDTH as f64"),
    (5, "irradiance / PI", "irradiance / (4.0 * PI)"),
    (5, "light.clamp(0.0, 1.0).sqrt()", "light.clamp(0.0, 1.0)"),
    (9, "let back = EYE.sub(TARGET).unit();", "let back = EYE.sub(TARGET);"),
    (9, "V(0.0, 1.0, 0.0).cross(back).unit()", "V(0.0, 1.0, 0.0).cross(back)"),
    (9, "let upward = back.cross(to_the_right);", "let upward = V(0.0, 1.0, 0.0);"),
    (9, "self.0 * o.1 - self.1 * o.0)", "self.0 * o.1 + self.1 * o.0)"),
    (10, "light.add(intensity.times(", "light.add(LAMPS[0].1.times("),
    (10, "normal.dot(to_lamp.unit())", "normal.dot(to_lamp)"),
    (10, "light.powf(1.0 / 2.4)", "light.powf(2.4)"),
    (10, "hit.0 > 1.0", "hit.0 < 1.0"),
    (
        10,
        "light = light.add(intensity.times(cosine / to_lamp.dot(to_lamp)));",
        "return intensity.times(cosine / to_lamp.dot(to_lamp));",
    ),
    (13, "height - normal.dot(origin)", "height + normal.dot(origin)"),
    (13, "origin.1, direction.1, V(0.0", "origin.1, direction.2, V(0.0"),
    (13, "from_centre.add(direction.times(t)).unit()", "origin.add(direction.times(t)).unit()"),
    (13, "if faces { normal } else { normal.times(-1.0) }", "if faces { normal.times(-1.0) } else { normal }"),
    (17, "1.0 / SAMPLES as f64", "1.0 / (SAMPLES - 1) as f64"),
    (17, "y as f64 + down", "y as f64 + right"),
    (17, "x as f64 + right, y as f64 + down", "x as f64 + 0.5 + right, y as f64 + 0.5 + down"),
    (17, "Random((y * WIDTH + x) as u64)", "Random(x as u64)"),
    (19, "2.0 * normal.dot(direction)", "normal.dot(direction)"),
    (19, "0..12", "0..1"),
    (19, "return weight.by(colour).by(light)", "return colour.by(light)"),
    (20, "1.0 - eta * eta * (1.0 - cosine * cosine)", "1.0 - eta * (1.0 - cosine * cosine)"),
    (20, "eta * cosine - beyond)", "cosine - beyond)"),
    (20, "(across * across + along * along) / 2.0", "across * across"),
    (20, "random.next() < reflected", "random.next() > reflected"),
    (21, "let height = 2.0 * self.next() - 1.0;", "let height = (PI * self.next()).cos();"),
    (21, "let angle = 2.0 * PI * self.next();", "let angle = PI * self.next();"),
    (21, "1.0 - 1e-9", "1.0"),
    (23, "LENS * random.next().sqrt()", "LENS * random.next()"),
    (23, "EYE.add(direction.times(FOCUS))", "EYE.add(direction.unit().times(FOCUS))"),
    (25, "normal.add(random.direction())", "random.direction()"),
    (25, "weight.times(1.0 / survives)", "weight.times(survives)"),
    (25, "weight.by(light).times(1.0 / PI)", "weight.by(light)"),
    (26, "let area = 4.0 * PI * LAMP.1 * LAMP.1;", "let area = PI * LAMP.1 * LAMP.1;"),
    (26, "pdf = normal.dot(direction) / PI;", "pdf = normal.dot(direction);"),
    (26, "weight_of(lamp_pdf(to_lamp, outward), cosine / PI)", "weight_of(cosine / PI, lamp_pdf(to_lamp, outward))"),
    (28, "let t = normal.dot(from_a) / facing;", "let t = -normal.dot(from_a) / facing;"),
    (28, "point(ring + 1, side + 1));", "point(ring + 1, side));"),
    (
        30,
        "enters = one.min(other).max(enters);\n        leaves = one.max(other).min(leaves);",
        "enters = one.max(enters);\n        leaves = other.min(leaves);",
    ),
    (30, "best = search(half, origin, direction, best);", "best = search(half, origin, direction, known);"),
    (
        33,
        "1.0 / (parts[0] / a.2 + parts[1] / b.2 + parts[2] / c.2)",
        "parts[0] * a.2 + parts[1] * b.2 + parts[2] * c.2",
    ),
    (33, "let depth = -from_eye.dot(back);", "let depth = from_eye.dot(from_eye).sqrt();"),
];

/// Programs that are right, and look unlike the book's.
pub const RIGHT: [Edit; 22] = [
    (1, "[(-half_b - root) / a, (-half_b + root) / a]", "[(half_b + root) / -a, (root - half_b) / a]"),
    (5, "(ANGLE / 2.0).to_radians().tan()", "(ANGLE * PI / 360.0).sin() / (ANGLE * PI / 360.0).cos()"),
    (5, "(255.0 * light.clamp(0.0, 1.0).sqrt()).round() as u8", "(light.clamp(0.0, 1.0).sqrt() * 255.0 + 0.5) as u8"),
    (9, "back.cross(to_the_right)", "V(0.0, 1.0, 0.0).sub(back.times(back.1)).unit()"),
    (9, "sub(back)\n", "sub(back).unit()\n"),
    (10, "normal.times(1e-9)", "normal.times(1e-7)"),
    (10, "light.powf(1.0 / 2.4)", "(light.ln() / 2.4).exp()"),
    (
        10,
        "sphere.colour.by(light_at(point, normal)).times(1.0 / PI)",
        "let V(r, g, b) = sphere.colour.times(1.0 / PI).by(light_at(point, normal));
    V(f64::from(r as f32), f64::from(g as f32), f64::from(b as f32))",
    ),
    (
        13,
        "hits.min_by(|a, b| a.0.total_cmp(&b.0))",
        "let mut first: Option<(f64, V, &'static Thing)> = None;
    for hit in hits {
        if first.is_none_or(|known| hit.0 < known.0) {
            first = Some(hit);
        }
    }
    first",
    ),
    (
        13,
        "if faces { normal } else { normal.times(-1.0) }",
        "normal.times(if faces { 1.0 } else { -1.0 } * normal.dot(normal))",
    ),
    (
        17,
        "for _ in 0..SAMPLES {
        let (right, down) = (random.next(), random.next());",
        "for sample in 0..SAMPLES {
        let (column, row) = ((sample % 8) as f64, (sample / 8) as f64);
        let (right, down) = ((column + random.next()) / 8.0, (row + random.next()) / 8.0);",
    ),
    (
        17,
        "bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64",
        "bits = (bits ^ (bits >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        bits = (bits ^ (bits >> 33)).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
        f64::from(((bits ^ (bits >> 33)) >> 32) as u32) / 4_294_967_296.0",
    ),
    (
        19,
        "direction.sub(normal.times(2.0 * normal.dot(direction)))",
        "normal.times(-2.0 * normal.dot(direction) / normal.dot(normal)).add(direction)",
    ),
    (19, "0..12", "0..50"),
    (
        20,
        "if squared <= 0.0 || random.next() < reflected {",
        "let lean = if squared <= 0.0 { 1.0 } else { 0.25 + 0.5 * reflected };
                let is_reflected = random.next() < lean;
                weight = weight.times(match is_reflected {
                    true => if squared <= 0.0 { 1.0 } else { reflected / lean },
                    false => (1.0 - reflected) / (1.0 - lean),
                });
                if is_reflected {",
    ),
    (
        21,
        "let height = 2.0 * self.next() - 1.0;
        let angle = 2.0 * PI * self.next();
        let across = (1.0 - height * height).sqrt();
        V(across * angle.cos(), height, across * angle.sin())",
        "loop {
            let v = V(self.next(), self.next(), self.next()).times(2.0).sub(V(1.0, 1.0, 1.0));
            if v.dot(v) <= 1.0 && v.dot(v) > 1e-12 {
                return v.unit();
            }
        }",
    ),
    (
        21,
        "let outward = random.direction();
    let start = point.add(normal.times(1e-9)); // off the surface
    let to_lamp = centre.add(outward.times(radius)).sub(start);",
        "let mut outward = random.direction();
    let start = point.add(normal.times(1e-9)); // off the surface
    if outward.dot(start.sub(centre)) < 0.0 {
        outward = outward.times(-1.0);
    }
    let emitted = emitted.times(0.5); // twice as likely
    let to_lamp = centre.add(outward.times(radius)).sub(start);",
    ),
    (23, "let distance = LENS * random.next().sqrt();", "let distance = LENS * random.next().max(random.next());"),
    (25, "max(weight.2).min(1.0)", "max(weight.2).min(0.9)"),
    (
        25,
        "direction = normal.add(random.direction());",
        "let aside = if normal.0.abs() < 0.5 { V(1.0, 0.0, 0.0) } else { V(0.0, 1.0, 0.0) };
                let first = normal.cross(aside).unit();
                let (squared, turn) = (random.next(), 2.0 * PI * random.next());
                let second = normal.cross(first).times(turn.sin() * squared.sqrt());
                let flat = first.times(turn.cos() * squared.sqrt()).add(second);
                direction = flat.add(normal.times((1.0 - squared).sqrt()));",
    ),
    (26, "1.0 / (1.0 + (other / pdf) * (other / pdf))", "1.0 / (1.0 + other / pdf)"),
    (
        28,
        "let (u, v) = (to_c.dot(across) / facing, -to_b.dot(across) / facing);
            let t = normal.dot(from_a) / facing;",
        "let p = direction.cross(to_c);
            let det = to_b.dot(p);
            let q = from_a.cross(to_b);
            let (u, v, t) = (from_a.dot(p) / det, direction.dot(q) / det, to_c.dot(q) / det);
            let _ = (across, facing);",
    ),
];
