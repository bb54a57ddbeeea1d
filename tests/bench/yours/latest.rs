//! The latest set: mistakes written from the pages when the sets before had been seen to, and tried once; and right programs.

use super::programs::Edit;

/// Mistakes, each with what is wrong.
pub const MISTAKES: [Edit; 48] = [
    // The quadratic formula's 2a is kept although b is already halved, so every hit lies at half its distance.
    (1, "[(-half_b - root) / a, (-half_b + root) / a]", "[(-half_b - root) / (2.0 * a), (-half_b + root) / (2.0 * a)]"),
    // The aspect is divided in integers and so is 1 instead of 16/9.
    (1, "let aspect = width as f64 / height as f64;", "let aspect = (width / height) as f64;"),
    // The lamp's light replaces the little from everywhere instead of being added to it.
    (
        1,
        "        light += BRIGHTNESS * cosine / to_light.dot(to_light);",
        "        light = BRIGHTNESS * cosine / to_light.dot(to_light);",
    ),
    // Half the tangent of the angle is taken for the tangent of half the angle.
    (5, "let half = (ANGLE / 2.0).to_radians().tan();", "let half = ANGLE.to_radians().tan() / 2.0;"),
    // The intensity is treated as a power that spreads over the whole sphere, so it is divided by 4π.
    (
        5,
        "let irradiance = INTENSITY * cosine / to_light.dot(to_light);",
        "let irradiance = INTENSITY / (4.0 * PI) * cosine / to_light.dot(to_light);",
    ),
    // The byte is linear in the light: the curve for the screen is left out.
    (5, "(255.0 * light.clamp(0.0, 1.0).sqrt()).round() as u8", "(255.0 * light.clamp(0.0, 1.0)).round() as u8"),
    // The cross product's y component has the terms in the other order, so its sign is wrong.
    (9, "self.2 * o.0 - self.0 * o.2);", "self.0 * o.2 - self.2 * o.0);"),
    // The vector to the right is not made a unit vector, so the image plane shrinks with the camera's tilt.
    (9, "let to_the_right = V(0.0, 1.0, 0.0).cross(back).unit();", "let to_the_right = V(0.0, 1.0, 0.0).cross(back);"),
    // The world's up is used for the picture's vertical instead of the camera's own upward.
    (9, "add(upward.times(up)).sub(back)", "add(V(0.0, up, 0.0)).sub(back)"),
    // The light of each lamp replaces that of those before, so that only the last unhidden lamp counts.
    (
        10,
        "            light = light.add(intensity.times(cosine / to_lamp.dot(to_lamp)));",
        "            light = intensity.times(cosine / to_lamp.dot(to_lamp));",
    ),
    // The sRGB curve is decoded instead of encoded.
    (
        10,
        "        ..0.0031308 => 12.92 * light,
        _ => 1.055 * light.powf(1.0 / 2.4) - 0.055,",
        "        ..0.04045 => light / 12.92,
        _ => ((light + 0.055) / 1.055).powf(2.4),",
    ),
    // The first lamp that is hidden or behind ends the loop, so the ones after it are not asked.
    (
        10,
        "            light = light.add(intensity.times(cosine / to_lamp.dot(to_lamp)));
        }",
        "            light = light.add(intensity.times(cosine / to_lamp.dot(to_lamp)));
        } else {
            break;
        }",
    ),
    // For a ray that runs towards smaller coordinates the near and the far face of a pair are not exchanged.
    (13, "                    false => (high, low, 1.0),", "                    false => (low, high, 1.0),"),
    // The sphere's normal is as long as the radius, not of length 1.
    (13, "Some((t, from_centre.add(direction.times(t)).unit()))", "Some((t, from_centre.add(direction.times(t))))"),
    // The loop over the block's pairs of faces is one short: the block has no end in z.
    (
        13,
        "for (low, high, from, along, axis) in pairs {",
        "for (low, high, from, along, axis) in pairs.into_iter().take(2) {",
    ),
    // The loop takes one sample fewer than the sum is divided by.
    (17, "    for _ in 0..SAMPLES {", "    for _ in 1..SAMPLES {"),
    // A ray through the pixel's centre is added to the sum but not to the number that it is divided by.
    (
        17,
        "    let mut sum = V(0.0, 0.0, 0.0);
    for _ in 0..SAMPLES {",
        "    let mut sum = radiance(EYE, camera_direction(x as f64 + 0.5, y as f64 + 0.5));
    for _ in 0..SAMPLES {",
    ),
    // The random places are cut to whole numbers, so every ray goes through the pixel's upper left corner.
    (
        17,
        "let direction = camera_direction(x as f64 + right, y as f64 + down);",
        "let direction = camera_direction((x + right as usize) as f64, (y + down as usize) as f64);",
    ),
    // The samples of a pixel come from a square of 3 by 3 pixels, so the picture is blurred.
    (
        17,
        "let (right, down) = (random.next(), random.next());",
        "let (right, down) = (3.0 * random.next() - 1.0, 3.0 * random.next() - 1.0);",
    ),
    // The formula for a vector that points away from the surface is used for one that points to it, so the ray goes on into the mirror.
    (
        19,
        "direction.sub(normal.times(2.0 * normal.dot(direction)))",
        "normal.times(2.0 * normal.dot(direction)).sub(direction)",
    ),
    // The sky that is seen in a mirror is not weighted by the mirror's colour.
    (
        19,
        "            return weight.by(V(0.5, 0.7, 1.0)); // the sky",
        "            return V(0.5, 0.7, 1.0); // the sky",
    ),
    // The ray goes on in the mirrored direction but still from where it began before.
    (
        19,
        "                direction = mirrored;
                origin = point.add(normal.times(1e-9));",
        "                direction = mirrored;",
    ),
    // Schlick's approximation with the cosine on this side, also when the ray leaves the glass.
    (
        20,
        "    (across * across + along * along) / 2.0",
        "    let r0 = ((1.0 - eta) / (1.0 + eta)).powi(2);
    let _ = (across, along);
    r0 + (1.0 - r0) * (1.0 - cosine).powi(5)",
    ),
    // Snell's law with the index where its square belongs.
    (20, "(1.0 - cosine * cosine) / (eta * eta)", "(1.0 - cosine * cosine) / eta"),
    // The reflected part counts twice: as the probability and as a factor of the weight.
    (
        20,
        "                    direction = mirrored;
                    origin = point.add(normal.times(1e-9));
                } else {",
        "                    direction = mirrored;
                    weight = weight.times(reflected);
                    origin = point.add(normal.times(1e-9));
                } else {",
    ),
    // The polar angle is uniform instead of the height, so directions crowd at the poles.
    (21, "let height = 2.0 * self.next() - 1.0;", "let height = (PI * self.next()).cos();"),
    // Without the margin the sampled point of the lamp often hides itself by rounding.
    (21, "hit.0 < 1.0 - 1e-9", "hit.0 < 1.0"),
    // The point on the lamp is taken on a ball of radius 1 instead of the lamp's radius.
    (21, "centre.add(outward.times(radius)).sub(start)", "centre.add(outward).sub(start)"),
    // The focus distance is measured along each ray instead of along the view: what is sharp is a ball, not a plane.
    (23, "let in_focus = EYE.add(direction.times(FOCUS));", "let in_focus = EYE.add(direction.unit().times(FOCUS));"),
    // The lens is a slanted line: both coordinates use the cosine.
    (23, "distance * angle.sin()", "distance * angle.cos()"),
    // The lens's radius is taken for its diameter and halved.
    (23, "let distance = LENS * random.next().sqrt();", "let distance = LENS / 2.0 * random.next().sqrt();"),
    // The new direction is uniform over the hemisphere but is weighted as if it were as frequent as its cosine.
    (
        25,
        "direction = normal.add(random.direction());",
        "direction = random.direction();
                if direction.dot(normal) < 0.0 {
                    direction = direction.times(-1.0);
                }",
    ),
    // The direct light is added before the surface's colour is multiplied into the weight.
    (
        25,
        "                weight = weight.by(colour);
                sum = sum.add(weight.by(light).times(1.0 / PI));",
        "                sum = sum.add(weight.by(light).times(1.0 / PI));
                weight = weight.by(colour);",
    ),
    // The 1/π of the reflection stays in the path's weight, where the sampling has already cancelled it.
    (
        25,
        "                weight = weight.by(colour);
                sum = sum.add(weight.by(light).times(1.0 / PI));",
        "                weight = weight.by(colour).times(1.0 / PI);
                sum = sum.add(weight.by(light));",
    ),
    // A path that ends by roulette loses also what it has already found.
    (
        25,
        "        if random.next() >= survives {
            return sum;",
        "        if random.next() >= survives {
            return V(0.0, 0.0, 0.0);",
    ),
    // The light of the lamp that is asked for keeps its full weight, beside the weighted one that the path finds.
    (
        26,
        "    emitted.times(part * cosine * cosine_there * area / to_lamp.dot(to_lamp))",
        "    let _ = part;
    emitted.times(cosine * cosine_there * area / to_lamp.dot(to_lamp))",
    ),
    // After a mirror the pdf of the matte surface before it is kept, so the lamp in the mirror counts only in part, though nothing else finds it.
    (
        26,
        "            Mirror(colour) => {
                pdf = f64::INFINITY;
",
        "            Mirror(colour) => {
",
    ),
    // The pdf of the lamp is computed for the vector from the world's origin to the lamp instead of from the surface.
    (26, "lamp_pdf(point.sub(origin), outward)", "lamp_pdf(point, outward)"),
    // The second triangle of each quadrilateral is missing.
    (
        28,
        "            triangles.push(triangle(b, d, c));
",
        "            let _ = d;
",
    ),
    // The loop around a ring is one short, so the shell has a slit.
    (28, "        for side in 0..SIDES {", "        for side in 0..SIDES - 1 {"),
    // The triangle's normal is as long as twice its area, not of length 1.
    (28, ".then(|| (t, normal.unit()))", ".then(|| (t, normal))"),
    // The second half is given what was known before the first, so it may replace a nearer hit of the first or forget it.
    (
        30,
        "                best = search(half, origin, direction, best);",
        "                best = search(half, origin, direction, known);",
    ),
    // The search ends after the first half if anything is hit, though the other half may hold a nearer hit.
    (
        30,
        "                best = search(half, origin, direction, best);",
        "                best = search(half, origin, direction, best);
                if best.is_some() {
                    return best;
                }",
    ),
    // The first triangle of each leaf is never tested.
    (30, "            for thing in things {", "            for thing in things.iter().skip(1) {"),
    // The boxes hold only two corners of each triangle.
    (
        30,
        "        Triangle(a, b, c) => [a, b, c],
        _ =>",
        "        Triangle(a, b, _) => [a, a, b],
        _ =>",
    ),
    // The depth is interpolated in a straight line over the picture instead of its reciprocal.
    (
        33,
        "let depth = 1.0 / (parts[0] / a.2 + parts[1] / b.2 + parts[2] / c.2);",
        "let depth = parts[0] * a.2 + parts[1] * b.2 + parts[2] * c.2;",
    ),
    // The depth along the view is taken for the distance along the ray.
    (33, "LAMP.0.sub(EYE.add(direction.times(depth)))", "LAMP.0.sub(EYE.add(direction.unit().times(depth)))"),
    // The rows of a triangle end one too early.
    (
        33,
        "(top, bottom) = (a.1.min(b.1).min(c.1), a.1.max(b.1).max(c.1) + 1.0);",
        "(top, bottom) = (a.1.min(b.1).min(c.1), a.1.max(b.1).max(c.1));",
    ),
];

/// Programs that are right, and look unlike the book's.
pub const RIGHT: [Edit; 41] = [
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
    (1, "    let half_b = from_centre.dot(direction);
    let c = from_centre.dot(from_centre) - sphere.radius * sphere.radius;
    let root = (half_b * half_b - a * c).sqrt(); // NaN where the ray misses
    [(-half_b - root) / a, (-half_b + root) / a].into_iter().find(|&t| t > 1e-4)", "    // The point of the line nearest to the centre, and from there back and forth.
    let middle = -from_centre.dot(direction) / a;
    let nearest = from_centre.add(direction.times(middle));
    let left = sphere.radius * sphere.radius - nearest.dot(nearest);
    if left < 0.0 {
        return None;
    }
    let half_chord = (left / a).sqrt();
    if middle - half_chord > 1e-4 {
        Some(middle - half_chord)
    } else if middle + half_chord > 1e-4 {
        Some(middle + half_chord)
    } else {
        None
    }"),
    (9, "    let back = EYE.sub(TARGET).unit();
    let to_the_right = V(0.0, 1.0, 0.0).cross(back).unit();
    let upward = back.cross(to_the_right);
    to_the_right.times(right).add(upward.times(up)).sub(back)", "    let ahead = TARGET.sub(EYE);
    let far = ahead.dot(ahead).sqrt();
    let side = V(-ahead.2, 0.0, ahead.0).unit(); // level, at right angles to the view
    let top = side.cross(ahead).times(1.0 / far);
    ahead.add(side.times(right * far)).add(top.times(up * far))"),
    (10, "        let to_lamp = lamp.sub(start);
        let cosine = normal.dot(to_lamp.unit());
        if cosine > 0.0 && nearest(start, to_lamp).is_none_or(|hit| hit.0 > 1.0) {
            light = light.add(intensity.times(cosine / to_lamp.dot(to_lamp)));
        }", "        // From the lamp to the surface: what it meets first must be this point.
        let down = point.sub(lamp);
        let distance = down.dot(down).sqrt();
        let way = down.times(1.0 / distance);
        let falling = -normal.dot(way);
        let Some((met, _)) = nearest(lamp, way) else { continue };
        if falling <= 0.0 || met < distance - 1e-6 {
            continue;
        }
        let V(r, g, b) = intensity;
        let k = falling / distance.powi(2);
        light = V(light.0 + k * r, light.1 + k * g, light.2 + k * b);"),
    (13, "            let mut enters = (f64::NEG_INFINITY, V(0.0, 0.0, 0.0));", "            let (box_low, box_high) = (low, high);
            let mut found: Option<(f64, V)> = None;
            for (low, high, from, along, axis) in pairs {
                for (face, side) in [(low, -1.0), (high, 1.0)] {
                    let t = (face - from) / along;
                    let p = origin.add(direction.times(t));
                    // How far outside the block the point is across the other two axes.
                    let out = |x: f64, l: f64, h: f64, a: f64| a == 0.0 && (x < l || x > h);
                    let outside = out(p.0, box_low.0, box_high.0, axis.0)
                        || out(p.1, box_low.1, box_high.1, axis.1)
                        || out(p.2, box_low.2, box_high.2, axis.2);
                    if t > 0.0 && t.is_finite() && !outside && found.is_none_or(|f| t < f.0) {
                        found = Some((t, axis.times(side)));
                    }
                }
            }
            if true {
                return found;
            }
            let mut enters = (f64::NEG_INFINITY, V(0.0, 0.0, 0.0));"),
    (17, "        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64", "        // PCG: a linear congruence, of which the high bits are rotated.
        let mut out = || {
            let old = self.0;
            self.0 = old.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((((old >> 18) ^ old) >> 27) as u32).rotate_right((old >> 59) as u32)
        };
        let _ = (out(), out());
        (out() as f64 + 0.5) / 4294967296.0"),
    (17, "    for _ in 0..SAMPLES {
        let (right, down) = (random.next(), random.next());
        let direction = camera_direction(x as f64 + right, y as f64 + down);", "    for cell in 0..SAMPLES {
        // One random point in each cell of a grid of 8 by 8.
        let (column, row) = ((cell % 8) as f64, (cell / 8) as f64);
        let (right, down) = ((column + random.next()) / 8.0, (row + random.next()) / 8.0);
        let direction = camera_direction(x as f64 + right, y as f64 + down);"),
    (20, "                let reflected = reflected_part(eta, cosine, beyond);
                if squared <= 0.0 || random.next() < reflected {
                    direction = mirrored;
                    origin = point.add(normal.times(1e-9));
                } else {
                    let down = normal.times(cosine / eta - beyond);
                    direction = direction.times(1.0 / eta).add(down);
                    origin = point.sub(normal.times(1e-9));
                }", "                // A fair coin, and what it decides counts by how much light goes there.
                let reflected = if squared <= 0.0 { 1.0 } else { reflected_part(eta, cosine, beyond) };
                if random.next() < 0.5 {
                    weight = weight.times(2.0 * reflected);
                    direction = mirrored;
                    origin = point.add(normal.times(1e-9));
                } else {
                    weight = weight.times(2.0 * (1.0 - reflected));
                    let level = direction.add(normal.times(cosine)).times(1.0 / eta);
                    direction = level.sub(normal.times(beyond));
                    origin = point.sub(normal.times(1e-9));
                    if squared <= 0.0 {
                        direction = mirrored; // of no weight
                        origin = point.add(normal.times(1e-9));
                    }
                }"),
    (21, "    let outward = random.direction();
    let start = point.add(normal.times(1e-9)); // off the surface
    let to_lamp = centre.add(outward.times(radius)).sub(start);
    let toward = to_lamp.unit();
    let (cosine, cosine_there) = (normal.dot(toward), -outward.dot(toward));
    // The lamp itself is at t = 1.
    let hidden = nearest(start, to_lamp).is_some_and(|hit| hit.0 < 1.0 - 1e-9);
    if hidden || cosine <= 0.0 || cosine_there <= 0.0 {
        return V(0.0, 0.0, 0.0);
    }
    let area = 4.0 * PI * radius * radius;
    emitted.times(cosine * cosine_there * area / to_lamp.dot(to_lamp))", "    let start = point.add(normal.times(1e-9)); // off the surface
    // A direction in the cone in which the lamp is seen.
    let axis = centre.sub(start);
    let sine_squared = radius * radius / axis.dot(axis);
    let least = (1.0 - sine_squared).sqrt();
    let solid_angle = 2.0 * PI * (1.0 - least);
    let (u, phi) = (random.next(), 2.0 * PI * random.next());
    let along = 1.0 - u * (1.0 - least);
    let across = (1.0 - along * along).sqrt();
    let w = axis.unit();
    let helper = if w.0.abs() > 0.9 { V(0.0, 1.0, 0.0) } else { V(1.0, 0.0, 0.0) };
    let s = helper.sub(w.times(helper.dot(w))).unit();
    let q = V(w.1 * s.2 - w.2 * s.1, w.2 * s.0 - w.0 * s.2, w.0 * s.1 - w.1 * s.0);
    let toward = w
        .times(along)
        .add(s.times(across * phi.cos()))
        .add(q.times(across * phi.sin()));
    let cosine = normal.dot(toward);
    match nearest(start, toward) {
        Some((_, _, Thing(_, Lamp(_)))) if cosine > 0.0 => emitted.times(cosine * solid_angle),
        _ => V(0.0, 0.0, 0.0),
    }"),
    (25, "let survives = weight.0.max(weight.1).max(weight.2).min(1.0);", "let survives = (weight.0 * 0.2126 + weight.1 * 0.7152 + weight.2 * 0.0722).sqrt().clamp(0.2, 1.0);"),
    (26, "    1.0 / (1.0 + (other / pdf) * (other / pdf))", "    1.0 / (1.0 + other / pdf)"),
    (28, "            let (to_b, to_c, from_a) = (b.sub(a), c.sub(a), origin.sub(a));
            let normal = to_b.cross(to_c);
            let across = from_a.cross(direction);
            let facing = -normal.dot(direction);
            let (u, v) = (to_c.dot(across) / facing, -to_b.dot(across) / facing);
            let t = normal.dot(from_a) / facing;
            (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then(|| (t, normal.unit()))", "            let (e, f) = (b.sub(a), c.sub(a));
            let face = e.cross(f);
            let t = face.dot(a.sub(origin)) / face.dot(direction);
            if t.is_nan() || t <= 0.0 {
                return None;
            }
            let p = origin.add(direction.times(t)).sub(a);
            // p = beta e + gamma f, by the two equations p · e and p · f (Cramer's rule).
            let (ee, ef, ff, pe, pf) = (e.dot(e), e.dot(f), f.dot(f), p.dot(e), p.dot(f));
            let whole = ee * ff - ef * ef;
            let beta = pe * ff - pf * ef;
            let gamma = pf * ee - pe * ef;
            let alpha = whole - beta - gamma;
            if beta < 0.0 || gamma < 0.0 || alpha < 0.0 {
                return None;
            }
            Some((t, face.unit()))"),
    (33, "        let [a, b, c] = [*a, *b, *c].map(raster_from_world);
        // Twice the area of a triangle with a pixel, by which its third corner counts.
        let area = |p: V, q: V, r: V| (q.0 - p.0) * (r.1 - p.1) - (q.1 - p.1) * (r.0 - p.0);
        let end = |at: f64, size: usize| at.clamp(0.0, size as f64) as usize;
        let (left, right) = (a.0.min(b.0).min(c.0), a.0.max(b.0).max(c.0) + 1.0);
        let (top, bottom) = (a.1.min(b.1).min(c.1), a.1.max(b.1).max(c.1) + 1.0);
        for y in end(top, HEIGHT)..end(bottom, HEIGHT) {
            for x in end(left, WIDTH)..end(right, WIDTH) {
                let at = V(x as f64 + 0.5, y as f64 + 0.5, 0.0);
                let parts = [(b, c), (c, a), (a, b)].map(|(p, q)| area(p, q, at) / area(a, b, c));
                let depth = 1.0 / (parts[0] / a.2 + parts[1] / b.2 + parts[2] / c.2);
", "        let corner = *a;
        let [a, b, c] = [*a, *b, *c].map(raster_from_world);
        // Twice the area of a triangle with a pixel, by which its third corner counts.
        let area = |p: V, q: V, r: V| (q.0 - p.0) * (r.1 - p.1) - (q.1 - p.1) * (r.0 - p.0);
        let end = |at: f64, size: usize| at.clamp(0.0, size as f64) as usize;
        let (left, right) = (a.0.min(b.0).min(c.0), a.0.max(b.0).max(c.0) + 1.0);
        let (top, bottom) = (a.1.min(b.1).min(c.1), a.1.max(b.1).max(c.1) + 1.0);
        for y in end(top, HEIGHT)..end(bottom, HEIGHT) {
            for x in end(left, WIDTH)..end(right, WIDTH) {
                let at = V(x as f64 + 0.5, y as f64 + 0.5, 0.0);
                let parts = [(b, c), (c, a), (a, b)].map(|(p, q)| area(p, q, at) / area(a, b, c));
                // Where the ray through the pixel's centre meets the triangle's plane.
                let ray = camera_direction(at.0, at.1);
                let depth = corner.sub(EYE).dot(outward) / ray.dot(outward);
"),
];
