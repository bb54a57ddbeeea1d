//! The reader's program after each step, compiled and run, and with mistakes put into it.

use pinhole_lab::yours::{Comparison, Expected, Program, picture_of_program, program_after};

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
    (13, "match along.is_sign_positive()", "match along.is_sign_negative()"),
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

/// What is found of a program and of its picture.
pub struct Found {
    pub comparison: Comparison,
    pub program: Program,
}

impl Found {
    /// Whether anything is said to be wrong.
    pub fn is_wrong(&self) -> bool {
        !matches!(self.comparison, Comparison::Same { .. }) || matches!(self.program, Program::Wrong(..))
    }

    /// Whether the lines in which a program is not as a right one are said to be wrong, with at most two others.
    pub fn names(&self, right: &str, program: &str) -> bool {
        let Program::Wrong(_, places) = &self.program else { return false };
        let same = right.lines().zip(program.lines()).take_while(|(one, other)| one == other).count();
        let behind = right.lines().rev().zip(program.lines().rev()).take_while(|(one, other)| one == other).count();
        // A statement may begin on the line before; what is taken out is missed in the one that follows.
        let lines = same..program.lines().count().saturating_sub(behind).max(same) + 2;
        places.len() <= 3 && places.iter().any(|place| lines.contains(&place.line))
    }
}

/// A chapter's program with some edits; none where one finds nothing to change.
pub fn edited(chapter: u32, edits: &[Edit]) -> Option<String> {
    let program = program_after(chapter).expect("applies");
    edits.iter().try_fold(program, |program, (_, old, new)| program.contains(old).then(|| program.replace(old, new)))
}

/// What is found of a program and of the picture that it writes.
///
/// Errors: a program that does not compile, or makes no picture.
pub fn found_of(expected: &Expected, program: &str) -> Result<Found, String> {
    let picture = picture_of_program(program)?;
    let mut comparison = expected.compare(&picture).map_err(|told| told.to_string())?;
    // Made a moment ago.
    let own = || Ok(picture.clone());
    let into = expected.look_into_both(program, &own, &picture, &mut comparison, &mut || ());
    Ok(Found { comparison, program: into.map_err(|told| told.to_string())? })
}

/// Edits, each with its program and what is found of it, chapter by chapter.
pub fn found(edits: &[Edit]) -> Vec<(Edit, String, Found)> {
    let mut edits = edits.to_vec();
    edits.sort_by_key(|edit| edit.0);
    let of_chapter = |edits: &[Edit]| {
        let expected = Expected::after(edits[0].0).expect("renders");
        let found = |edit: &Edit| {
            let program = edited(edit.0, &[*edit]).unwrap_or_else(|| panic!("{edit:?} changes nothing"));
            let found = found_of(&expected, &program).expect("a picture");
            (*edit, program, found)
        };
        edits.iter().map(found).collect::<Vec<_>>()
    };
    edits.chunk_by(|one, other| one.0 == other.0).flat_map(of_chapter).collect()
}
