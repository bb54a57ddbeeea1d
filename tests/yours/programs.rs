//! The reader's program after each step, compiled and run, and with mistakes put into it.

use pinhole_lab::yours::{Comparison, Expected, Picture, picture_of_program, program_after};

/// A chapter, what its program says there, and what is put in its place.
pub type Edit = (u32, &'static str, &'static str);

/// Mistakes, each of which shows in the picture.
pub const MISTAKES: [Edit; 58] = [
    (5, "camera_direction(x as f64 + 0.5, y as f64 + 0.5)", "camera_direction(x as f64, y as f64)"),
    (17, "x as f64 + right, y as f64 + down", "x as f64 + right - 0.5, y as f64 + down - 0.5"),
    (5, "times(irradiance / PI)", "times(irradiance)"),
    (5, "/ to_light.dot(to_light);", "/ to_light.dot(to_light).sqrt();"),
    (5, "(ANGLE / 2.0)", "ANGLE"),
    (5, "let up = 1.0 - 2.0 * y / HEIGHT as f64;", "let up = 2.0 * y / HEIGHT as f64 - 1.0;"),
    (5, "(2.0 * x - WIDTH as f64) / HEIGHT as f64", "(2.0 * x - WIDTH as f64) / WIDTH as f64"),
    (5, "V(half * right, half * up, -1.0)", "V(half * right, half * up, 1.0)"),
    (5, "|(t, _)| t < 1.0", "|(t, _)| t < 0.0"),
    (5, "sphere.colour.times(", "V(1.0, 1.0, 1.0).times("),
    (5, ".clamp(0.0, 1.0).sqrt()", ".clamp(0.0, 1.0)"),
    (5, "byte(r), byte(g), byte(b)", "byte(b), byte(g), byte(r)"),
    (5, "INTENSITY * cosine", "INTENSITY"),
    (9, "V(0.0, 1.0, 0.0).cross(back)", "back.cross(V(0.0, 1.0, 0.0))"),
    (9, ".sub(back)", ".add(back)"),
    (9, "const EYE: V = V(2.5, 1.4, 1.4);", "const EYE: V = V(0.0, 0.0, 0.0);"),
    (9, "back.cross(to_the_right)", "to_the_right.cross(back)"),
    (9, "EYE.sub(TARGET).unit()", "EYE.sub(TARGET)"),
    (10, "point.add(normal.times(1e-9))", "point.sub(normal.times(1e-9))"),
    (10, "in LAMPS {", "in LAMPS.into_iter().take(1) {"),
    (10, ".times(1.0 / PI)", ""),
    (10, "hit.0 > 1.0", "hit.0 < 1.0"),
    (10, "light.powf(1.0 / 2.4)", "light"),
    (13, "(height - normal.dot(origin))", "(normal.dot(origin) - height)"),
    (13, "    Thing(Block { low: V(-2.8, -1.0, -4.5), high: V(-1.4, 0.8, -3.1) }, V(0.3, 0.4, 0.8)),\n", ""),
    (13, "match along > 0.0", "match along < 0.0"),
    (13, "V(0.0, 1.0, 0.0)),\n                (low.2", "V(1.0, 0.0, 0.0)),\n                (low.2"),
    (17, "sum.times(1.0 / SAMPLES as f64)", "sum.times(2.0 / SAMPLES as f64)"),
    (17, "1_u64 << 53", "1_u64 << 50"),
    (19, "2.0 * normal.dot(direction)", "normal.dot(direction)"),
    (19, "                weight = weight.by(colour);\n", ""),
    (19, "direction.sub(normal.times(2.0", "direction.add(normal.times(2.0"),
    (20, "{ index } else { 1.0 / index }", "{ 1.0 / index } else { index }"),
    (20, "random.next() < reflected", "random.next() < 0.0"),
    (20, "origin = point.sub(normal.times(1e-9));", "origin = point.add(normal.times(1e-9));"),
    (20, "normal.times(cosine / eta - beyond)", "normal.times(cosine / eta + beyond)"),
    (21, "cosine * cosine_there * area", "cosine * area"),
    (21, "4.0 * PI * radius", "2.0 * PI * radius"),
    (21, "|hit| hit.0 < 1.0 - 1e-9", "|hit| hit.0 < 0.0"),
    (25, "                lamps_count = false;\n", ""),
    (25, "                weight = weight.by(colour);\n                sum", "                sum"),
    (25, "        weight = weight.times(1.0 / survives);\n", ""),
    (25, "normal.add(random.direction())", "random.direction()"),
    (25, "return sum.add(weight.by(V(0.5, 0.7, 1.0)));", "return sum;"),
    (23, "LENS * random.next().sqrt()", "LENS * random.next().powi(2)"),
    (23, "direction.times(FOCUS)", "direction.unit().times(FOCUS)"),
    (23, "in_focus.sub(start), &mut random)", "direction, &mut random)"),
    (23, "radiance(start, in_focus", "radiance(EYE, in_focus"),
    (26, "weight.by(emitted).times(part)", "weight.by(emitted)"),
    (26, "times(part * cosine * cosine_there", "times(cosine * cosine_there"),
    (26, "pdf = normal.dot(direction) / PI;", "pdf = 1.0 / (2.0 * PI);"),
    (26, "weight_of(lamp_pdf(to_lamp, outward), cosine / PI)", "weight_of(cosine / PI, lamp_pdf(to_lamp, outward))"),
    (28, " && u + v <= 1.0", ""),
    (28, "-normal.dot(direction);", "normal.dot(direction);"),
    (30, "halves.iter() {", "halves.iter().skip(1) {"),
    (30, "leaves = one.max(other).min(leaves);", "leaves = one.min(other).min(leaves);"),
    (33, "|| depth >= pixel.0", "|| depth <= pixel.0"),
    (33, "(1.0 - up) * height / 2.0", "(1.0 + up) * height / 2.0"),
];

/// Mistakes by someone who had not seen which are known; the first of each chapter up to 20 and those of 33 were seen before
/// the last known ones were written, those of 21 to 30 were not.
#[allow(dead_code, reason = "for the bench")]
pub const BLIND: [Edit; 93] = [
    (5, "(ANGLE / 2.0).to_radians().tan()", "(ANGLE / 2.0).tan()"), // tan of degrees
    (5, "let up = 1.0 - 2.0 * y / HEIGHT as f64;", "let up = 2.0 * y / HEIGHT as f64 - 1.0;"), // up = 2y/h - 1 (sign)
    (5, "t > 1e-4", "t > 0.0"),                                     // epsilon 1e-4 -> 0 (acne)
    (5, "normal.dot(to_light.unit())", "normal.dot(to_light)"),     // cosine with to_light not normalised
    (5, "/ to_light.dot(to_light);", "/ to_light.dot(to_light).sqrt();"), // falls with distance, not its square
    (5, "WIDTH as f64) / HEIGHT as f64", "WIDTH as f64) / WIDTH as f64"), // right divided by WIDTH (aspect)
    (5, "x as f64 + 0.5, y as f64 + 0.5", "x as f64, y as f64"),    // pixel centre forgotten (+0.5 missing)
    (5, "sphere.radius * sphere.radius", "sphere.radius"),          // radius not squared
    (5, "(min, nearest) = (t, Some((t, sphere)));", "nearest = Some((t, sphere));"), // min not updated: last sphere wins
    (9, "EYE.sub(TARGET).unit()", "TARGET.sub(EYE).unit()"),                         // back = TARGET - EYE
    (9, "V(0.0, 1.0, 0.0).cross(back)", "back.cross(V(0.0, 1.0, 0.0))"),             // right = back x up (swapped)
    (9, "cross(back).unit()", "cross(back)"),                                        // right not normalised
    (9, "V(0.0, 1.0, 0.0).cross", "V(0.0, 0.0, 1.0).cross"),                         // world's up is z
    (9, "self.2 * o.0 - self.0 * o.2)", "self.0 * o.2 - self.2 * o.0)"),             // cross: sign of y
    (9, "nearest(point, to_light)", "nearest(point, LIGHT)"), // shadow ray toward LIGHT, not to_light
    (
        10,
        "light = light.add(intensity.times(cosine / to_lamp.dot(to_lamp)));",
        "light = intensity.times(cosine / to_lamp.dot(to_lamp));",
    ), // light = not light.add: only the last lamp
    (10, "point.add(normal.times(1e-9))", "point"),           // start not off the surface
    (10, "point.add(normal.times(1e-9))", "point.sub(normal.times(1e-9))"), // start under the surface
    (10, "self.1 * o.1, self.2 * o.2)\n    }\n}\n\nstruct", "self.1 * o.1, self.1 * o.2)\n    }\n}\n\nstruct"), // by: self.1 twice
    (10, "1.0 / 2.4", "1.0 / 2.2"), // powf(1/2.2) in the sRGB curve
    (
        10,
        "            light = light.add(intensity.times(cosine / to_lamp.dot(to_lamp)));\n        }",
        "            light = light.add(intensity.times(cosine / to_lamp.dot(to_lamp)));\n        } else {\n            return V(0.0, 0.0, 0.0);\n        }",
    ), // return black at the first hidden lamp
    (10, "V(60.0, 54.0, 45.0)", "V(45.0, 54.0, 60.0)"), // lamp 1's colour typed in reverse
    (13, "(height - normal.dot(origin))", "(height + normal.dot(origin))"), // plane: height + normal.origin
    (13, "(t > 0.0 && t.is_finite())", "t.is_finite()"), // plane: t > 0 not asked
    (13, "direction.1, V(0.0, 1.0, 0.0)", "direction.1, V(1.0, 0.0, 0.0)"), // block: axis of y copied as x
    (13, "origin.2, direction.2,", "origin.2, direction.1,"), // block: along.2 typed direction.1
    (13, "[(-half_b - root) / a, (-half_b + root) / a]", "[(-half_b + root) / a, (-half_b - root) / a]"), // sphere: far root first
    (13, "from_centre.add(direction.times(t)).unit()", "from_centre.add(direction.times(t))"), // sphere: normal not unit
    (17, "sum.times(1.0 / SAMPLES as f64)", "sum"),                                            // sum not divided
    (17, "(random.next(), random.next())", "(random.next() - 0.5, random.next() - 0.5)"), // right - 0.5, down - 0.5
    (17, "1_u64 << 53", "1_u64 << 52"),                                                   // 2^63
    (17, "        let (right, down)", "        sum = V(0.0, 0.0, 0.0);\n        let (right, down)"), // sum reset in the loop
    (17, "Random((y * WIDTH + x) as u64)", "Random(1)"), // the same random numbers in every pixel
    (19, "normal.times(2.0 * normal.dot(direction))", "normal.times(normal.dot(direction))"), // mirrored without the 2
    (19, "direction.sub(normal.times(2.0", "direction.add(normal.times(2.0"), // mirrored with add
    (
        19,
        "                direction = mirrored;\n                origin = point.add(normal.times(1e-9));",
        "                direction = mirrored;",
    ), // mirror: origin not moved to the point
    (19, "return weight.by(V(0.5, 0.7, 1.0));", "return V(0.5, 0.7, 1.0);"), // sky without the weight
    (19, "0..12", "0..1"),                               // 0..1 bounces
    (19, "origin = point.add(normal.times(1e-9));", "origin = point.sub(normal.times(1e-9));"), // mirror's origin inside
    (20, "if enters { index } else { 1.0 / index }", "if enters { 1.0 / index } else { index }"), // eta inverted
    (20, "/ (eta * eta);", "/ eta;"), // Snell: eta not squared
    (20, "squared <= 0.0 || random.next() < reflected", "squared <= 0.0"), // no Fresnel: only total reflection
    (20, "random.next() < reflected", "random.next() > reflected"), // > for < reflected
    (20, "        direction = direction.unit();\n", ""), // direction not normalised
    (
        20,
        "                    direction = mirrored;\n                    origin",
        "                    weight = weight.times(reflected);\n                    direction = mirrored;\n                    origin",
    ), // weight also times reflected (double)
    (20, "along * along", "across * across"), // Fresnel: across twice
    (20, "origin = point.sub(normal.times(1e-9));", "origin = point.add(normal.times(1e-9));"), // refracted origin on the near side
    (21, "let area = 4.0 * PI", "let area = PI"), // area of a disk, PI r r
    (21, "cosine * cosine_there * area", "cosine * area"), // cosine at the lamp forgotten
    (21, "hit.0 < 1.0 - 1e-9", "hit.0 < 1.0"),    // hidden: hit.0 < 1.0
    (21, "2.0 * self.next() - 1.0", "self.next()"), // height 0..1 only
    (21, "(1.0 - height * height).sqrt()", "1.0 - height.abs()"), // across = 1 - height, no square and root
    (21, "outward.times(radius)", "outward"),     // lamp point not times the radius
    (
        21,
        "V(across * angle.cos(), height, across * angle.sin())",
        "V(height, 2.0 * self.next() - 1.0, 2.0 * self.next() - 1.0).unit()",
    ), // random direction from a cube
    (23, "random.next().sqrt()", "random.next()"), // lens without the root
    (23, "let angle = 2.0 * PI * random.next();\n    let across", "let angle = PI * random.next();\n    let across"), // lens angle PI: half a disk
    (23, "in_focus.sub(start)", "direction"), // radiance(start, direction): nothing in focus
    (23, "direction.times(FOCUS)", "direction.unit().times(FOCUS)"), // FOCUS along the unit direction
    (23, "distance * angle.sin()", "distance * angle.cos()"), // lens: cos twice
    (23, "FOCUS: f64 = 3.5", "FOCUS: f64 = 5.3"), // FOCUS 5.3
    (23, "LENS * random", "LENS / 2.0 * random"), // LENS taken as diameter
    (25, "lamps_count = false;", "lamps_count = true;"), // lamps counted twice after matte
    (25, "        weight = weight.times(1.0 / survives);\n", ""), // weight not divided by survives
    (
        25,
        "                weight = weight.by(colour);\n                sum = sum.add(weight.by(light).times(1.0 / PI));",
        "                sum = sum.add(weight.by(light).times(1.0 / PI));\n                weight = weight.by(colour);",
    ), // colour after the sum
    (
        25,
        "                // On in a random",
        "                weight = weight.times(1.0 / PI);\n                // On in a random",
    ), // indirect also over PI
    (25, "direction = normal.add(random.direction());", "direction = random.direction();"), // direction without the normal
    (25, "return sum.add(weight.by(V(0.5, 0.7, 1.0)));", "return weight.by(V(0.5, 0.7, 1.0));"), // sky forgets the sum
    (
        25,
        "direction = normal.add(random.direction());",
        "direction = random.direction();\n                if direction.dot(normal) < 0.0 { direction = direction.times(-1.0); }",
    ), // uniform hemisphere without its cosine
    (26, "emitted.times(part * cosine", "emitted.times(cosine"),                            // no part in light_at
    (26, "weight_of(lamp_pdf(to_lamp, outward), cosine / PI)", "weight_of(cosine / PI, lamp_pdf(to_lamp, outward))"), // weight_of swapped in light_at
    (26, "weight.by(emitted).times(part)", "weight.by(emitted)"), // no part where the lamp is hit
    (26, "pdf = normal.dot(direction) / PI;", "pdf = normal.dot(direction);"), // pdf without / PI
    (26, "direction = normal.add(random.direction()).unit();", "direction = normal.add(random.direction());"), // bounce not unit: pdf too large
    (28, " && u + v <= 1.0", ""),                         // u + v <= 1 missing
    (28, "(t, normal.unit())", "(t, normal)"),            // triangle normal not unit
    (28, "triangle(b, d, c)", "triangle(a, d, c)"),       // triangle(b, d, c) typed (a, d, c)
    (28, "0..SIDES {", "0..SIDES - 1 {"),                 // 0..SIDES - 1
    (28, "8.0 * PI", "2.0 * PI"),                         // turn 2 PI
    (28, "0.44 - down", "0.44 + down"),                   // box: down + for -
    (30, "return best; // past", "return None; // past"), // box missed: None, not best
    (30, "search(half, origin, direction, best)", "search(half, origin, direction, known)"), // search(half, .., known)
    (30, ".filter(nearer)", ""),                          // filter(nearer) missing
    (30, "flat_map(|thing| corners(thing))", "map(|thing| corners(thing)[0])"), // box of first corners only
    (
        30,
        "search(&TREE, origin, direction, hits.min_by(|a, b| a.0.total_cmp(&b.0)))",
        "search(&TREE, origin, direction, None).or(hits.min_by(|a, b| a.0.total_cmp(&b.0)))",
    ), // tree first, scene only where it misses
    (30, "by(p.2, q.2))", "by(p.2, q.1))"),               // box_around: z by y
    (
        33,
        "1.0 / (parts[0] / a.2 + parts[1] / b.2 + parts[2] / c.2)",
        "parts[0] * a.2 + parts[1] * b.2 + parts[2] * c.2",
    ), // depth linear in the picture
    (33, " || depth >= pixel.0", ""),                     // no depth test
    (33, "outward.times(-outward.dot(direction).signum())", "outward"), // normal not turned to the eye
    (33, "LAMP.2.times(PI * LAMP.1 * LAMP.1)", "LAMP.2"), // lamp PI r r forgotten
    (33, "direction.times(depth)", "direction.unit().times(depth)"), // depth along unit direction
    (33, "V(x as f64 + 0.5, y as f64 + 0.5, 0.0)", "V(x as f64, y as f64, 0.0)"), // no + 0.5 in the raster
    (33, "(width + right * height)", "(width + right * width)"), // right * width
    (33, "/ area(a, b, c));", "/ area(a, b, c).abs());"), // area's absolute value: one winding only
];

/// Programs that are right, and look unlike the book's.
pub const RIGHT: [Edit; 15] = [
    (17, "Random((y * WIDTH + x) as u64)", "Random(977 * (y * WIDTH + x) as u64 + 5)"),
    (17, "const SAMPLES: usize = 64;", "const SAMPLES: usize = 100;"),
    (10, "LAMPS {", "LAMPS.into_iter().rev() {"),
    (13, "SCENE.iter().filter_map", "SCENE.iter().rev().filter_map"),
    (
        25,
        "normal.add(random.direction())",
        "{ let d = random.direction(); let d = if d.dot(normal) < 0.0 { d.times(-1.0) } else { d }; weight = weight.times(2.0 * d.dot(normal)); d }",
    ),
    (25, "const SAMPLES: usize = 64;", "const SAMPLES: usize = 200;"),
    (25, "weight.0.max(weight.1).max(weight.2).min(1.0)", "((weight.0 + weight.1 + weight.2) / 3.0).min(1.0)"),
    (20, "random.next() < reflected", "random.next() > 1.0 - reflected"),
    (21, "let outward = random.direction();", "let outward = random.direction().times(-1.0);"),
    (9, "let upward = back.cross(to_the_right);", "let upward = V(0.0, 1.0, 0.0).sub(back.times(back.1)).unit();"),
    (23, "LENS * random.next().sqrt()", "LENS * random.next().max(random.next())"),
    (26, "1.0 / (1.0 + (other / pdf) * (other / pdf))", "1.0 / (1.0 + other / pdf)"),
    (28, "triangle(b, d, c)", "triangle(b, c, d)"),
    (30, "things.len() <= 4", "things.len() <= 1"),
    (33, "chain(&ground)", "chain(&ground).collect::<Vec<_>>().into_iter().rev()"),
];

/// What is said of a picture that is not pinhole's; none of one that is.
pub fn said(found: &Comparison) -> Option<&str> {
    match found {
        Comparison::Same { .. } => None,
        Comparison::Shifted { .. } => Some("it is shifted"),
        Comparison::Differs { looks_like, .. } => Some(looks_like.as_deref().unwrap_or(NOT_NAMED)),
    }
}

/// What is said of a picture that differs for a reason that is not known.
pub const NOT_NAMED: &str = "told, not named";

/// What a chapter's program, edited, makes.
///
/// Errors: a program that does not compile, or makes no picture.
pub fn picture_of_edited((chapter, old, new): Edit) -> Result<Picture, String> {
    let program = program_after(chapter).expect("applies");
    if !program.contains(old) {
        return Err(format!("the program of {chapter} has no {old}"));
    }
    picture_of_program(&program.replace(old, new))
}

/// Edits with what is found of their pictures, chapter by chapter.
pub fn found(edits: &[Edit]) -> Vec<(Edit, Comparison)> {
    let mut edits = edits.to_vec();
    edits.sort_by_key(|edit| edit.0);
    let of_chapter = |edits: &[Edit]| {
        let expected = Expected::after(edits[0].0).expect("renders");
        let found = |edit: &Edit| {
            (*edit, expected.compare(&picture_of_edited(*edit).expect("a picture"), &mut || ()).expect("of its size"))
        };
        edits.iter().map(found).collect::<Vec<_>>()
    };
    edits.chunk_by(|one, other| one.0 == other.0).flat_map(of_chapter).collect()
}
