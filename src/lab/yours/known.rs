//! Mistakes that no change of the scene makes: each is put into the program, which is compiled and run, to see whether a
//! picture looks like it.

use super::program::{program_after, steps};
use pinhole::scene::{FileKind, read_file};
use std::fs;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// How long a program may run.
const PATIENCE: Duration = Duration::from_secs(60);

/// A mistake, as an edit of the program.
struct Known {
    /// What the right program says.
    right: &'static str,
    /// What a wrong one says.
    wrong: &'static str,
    /// What the picture looks like, as the end of a sentence.
    looks_like: &'static str,
}

const fn known(right: &'static str, wrong: &'static str, looks_like: &'static str) -> Known {
    Known { right, wrong, looks_like }
}

const KNOWN: [Known; 86] = [
    known(
        "point.add(normal.times(1e-9))",
        "point",
        "it is full of specks: rays start exactly on the surface, and hit it again.",
    ),
    known(
        "hit.0 < 1.0 - 1e-9",
        "hit.0 < 1.0",
        "the lamp's own surface hides it from half of the rays: it is at t = 1, up to rounding.",
    ),
    known(
        "return sum.add(weight.by(V(0.5, 0.7, 1.0)));",
        "return weight.by(V(0.5, 0.7, 1.0));",
        "a path that ends in the sky forgets the light that it has found before.",
    ),
    known("= INTENSITY * cosine", "= INTENSITY", "the cosine between normal and light is missing."),
    known(
        "let cosine = normal.dot(to_light.unit())",
        "let cosine = normal.dot(to_light)",
        "light falls with the distance and not with its square, or the direction to the light is not a unit vector.",
    ),
    known(
        "/ to_light.dot(to_light);",
        "/ to_light.dot(to_light).sqrt();",
        "light falls with the distance and not with its square, or the direction to the light is not a unit vector.",
    ),
    known("/ to_light.dot(to_light);", ";", "light does not fall with the distance."),
    known("(ANGLE / 2.0).to_radians()", "(ANGLE / 2.0)", "the angle is in degrees where its tangent is taken."),
    known(
        "EYE.sub(TARGET).unit()",
        "EYE.sub(TARGET)",
        "`back` is not a unit vector, so the plane is not at distance 1.",
    ),
    known("t > 0.0 && t.is_finite()", "t.is_finite()", "a plane is also hit behind the start of the ray."),
    known(
        "both.into_iter().find(|&t| t > 0.0)?",
        "both.into_iter().next()?",
        "a sphere is also hit behind the start of the ray.",
    ),
    known(
        "[(-half_b - root) / a, (-half_b + root) / a]",
        "[(-half_b + root) / a, (-half_b - root) / a]",
        "spheres are hit on their far side first.",
    ),
    known("axis.times(side)", "axis.times(-side)", "the block's normals point inward."),
    known("hits.min_by(", "hits.max_by(", "the farthest hit is taken, and not the nearest."),
    known(
        "2.0 * normal.dot(direction)",
        "normal.dot(direction)",
        "mirrored directions lie along the surface: the 2 is missing.",
    ),
    known(
        "direction.sub(normal.times(2.0",
        "direction.add(normal.times(2.0",
        "mirrored directions have the wrong sign.",
    ),
    known(
        "                direction = mirrored;\n                origin = point.add(normal.times(1e-9));\n            }\n        }",
        "                direction = mirrored;\n            }\n        }",
        "a mirror's ray goes on from where it came: `origin` stays behind.",
    ),
    known("random.next() < reflected", "random.next() < 0.0", "glass reflects nothing."),
    known("random.next() < reflected", "random.next() >= reflected", "glass reflects what it should let through."),
    known("squared <= 0.0 || ", "", "there is no total reflection."),
    known(
        "origin = point.sub(normal.times(1e-9));",
        "origin = point.add(normal.times(1e-9));",
        "a refracted ray starts on the wrong side of the surface.",
    ),
    known(
        "normal.times(eta * cosine - beyond)",
        "normal.times(eta * cosine + beyond)",
        "a refracted ray has the wrong sign along the normal.",
    ),
    known(
        "normal.times(eta * cosine - beyond)",
        "normal.times(cosine - beyond)",
        "`eta` is missing where the ray is refracted.",
    ),
    known("let enters = outward.dot(direction) < 0.0;", "let enters = true;", "glass is left as it was entered."),
    known(
        "(across * across + along * along) / 2.0",
        "across * across + along * along",
        "glass reflects twice of what it should: the mean of two is taken.",
    ),
    known("cosine * cosine_there * area", "cosine * area", "the cosine at the lamp is missing."),
    known("cosine * cosine_there * area", "cosine_there * area", "the cosine at the surface is missing."),
    known(
        "area / to_lamp.dot(to_lamp)",
        "area / to_lamp.dot(to_lamp).sqrt()",
        "light falls with the distance, and not with its square.",
    ),
    known("area / to_lamp.dot(to_lamp)", "area", "light does not fall with the distance."),
    known(
        "|hit| hit.0 < 1.0 - 1e-9",
        "|hit| hit.0 < 0.0",
        "nothing casts a shadow: what is done with the ray to the lamp?",
    ),
    known(
        "|hit| hit.0 < 1.0 - 1e-9",
        "|hit| hit.0 < 1.0 + 1e-9",
        "the lamp casts a shadow of itself: its own surface is at t = 1.",
    ),
    known(
        "LENS * random.next().sqrt()",
        "LENS * random.next()",
        "the lens is sampled too often in its middle: the root is missing.",
    ),
    known(
        "radiance(start, in_focus.sub(start), &mut random)",
        "radiance(start, direction, &mut random)",
        "rays from all over the lens are parallel, so nothing near is sharp.",
    ),
    known(
        "radiance(start, in_focus.sub(start), &mut random)",
        "radiance(EYE, direction, &mut random)",
        "everything is sharp: the rays start at the eye.",
    ),
    known(
        "                lamps_count = false;\n",
        "",
        "the lamp is counted twice: by the shadow ray and by the path that meets it.",
    ),
    known(
        "                weight = weight.by(colour);\n                sum",
        "                sum",
        "a matte surface takes nothing of the light that it passes on.",
    ),
    known(
        "        weight = weight.times(1.0 / survives);\n",
        "",
        "paths that survive are not weighted for those that end.",
    ),
    known(
        "normal.add(random.direction())",
        "random.direction()",
        "light goes on in all directions, into the surface as well.",
    ),
    known(
        "normal.add(random.direction())",
        "normal.add(random.direction()).times(-1.0)",
        "paths go on into the surface.",
    ),
    known(
        "sum = sum.add(weight.by(light).times(1.0 / PI));",
        "sum = sum.add(weight.by(light));",
        "direct light is π times too bright.",
    ),
    known(
        "weight.by(emitted).times(part)",
        "weight.by(emitted)",
        "light that a path meets by itself counts in full, though the lamp is sampled as well.",
    ),
    known(
        "emitted.times(part * cosine",
        "emitted.times(cosine",
        "light of the sampled lamp counts in full, though paths meet it as well.",
    ),
    known(
        "(to_c.dot(across) / facing, -to_b.dot(across) / facing)",
        "(-to_c.dot(across) / facing, to_b.dot(across) / facing)",
        "triangles lie mirrored at their first corner: a sign of u and v is wrong.",
    ),
    known(" && u + v <= 1.0", "", "triangles are parallelograms: u + v is at most 1."),
    known(
        "for half in halves.iter() {",
        "for half in halves.iter().take(1) {",
        "half of the triangles are missing: both halves of a node are searched.",
    ),
    known("depth >= pixel.0", "false", "the last triangle stays, and not the nearest."),
    known(
        "V(x as f64 + 0.5, y as f64 + 0.5, 0.0)",
        "V(x as f64, y as f64, 0.0)",
        "pixels are asked at their corner, and not at their middle.",
    ),
    known(
        "|&t| t > 1e-4",
        "|&t| t > 0.0",
        "it is full of specks: rays start exactly on the surface, and hit it again.",
    ),
    known("- sphere.radius * sphere.radius", "- sphere.radius", "the radius is not squared."),
    known("- radius * radius;", "- radius;", "the radius is not squared."),
    known(
        "(min, nearest) = (t, Some((t, sphere)));",
        "nearest = Some((t, sphere));",
        "what is hit last in the list is taken, and not what is nearest.",
    ),
    known(
        "x as f64 + 0.5, y as f64 + 0.5",
        "x as f64, y as f64",
        "rays go through the corners of pixels, and not through their middle.",
    ),
    known(
        "x as f64 + right, y as f64 + down",
        "x as f64 + right - 0.5, y as f64 + down - 0.5",
        "rays are spread about the corners of pixels, and not about their middle.",
    ),
    known(".cross(back).unit()", ".cross(back)", "the axis to the right is not a unit vector."),
    known("V(0.0, 1.0, 0.0).cross", "V(0.0, 0.0, 1.0).cross", "the world's upward direction is taken for another one."),
    known(
        "self.2 * o.0 - self.0 * o.2",
        "self.0 * o.2 - self.2 * o.0",
        "the second part of the cross product has the wrong sign.",
    ),
    known(
        "nearest(point, to_light)",
        "nearest(point, LIGHT)",
        "shadow rays lead to the lamp's place as if the point were the origin.",
    ),
    known("light = light.add(intensity", "light = (intensity", "only one lamp counts: is their light added up?"),
    known(
        "point.add(normal.times(1e-9)); // off",
        "point.sub(normal.times(1e-9)); // off",
        "shadow rays start below the surface.",
    ),
    known("light.powf(1.0 / 2.4)", "light.powf(1.0 / 2.2)", "the exponent of the screen's curve is another one."),
    known("(height - normal.dot(origin))", "(height + normal.dot(origin))", "a sign is wrong where a plane is hit."),
    known("(height - normal.dot(origin))", "(normal.dot(origin) - height)", "a sign is wrong where a plane is hit."),
    known(
        "origin.2, direction.2, V",
        "origin.2, direction.1, V",
        "one of the block's three directions is taken twice.",
    ),
    known(
        "from_centre.add(direction.times(t)).unit()",
        "from_centre.add(direction.times(t))",
        "a sphere's normal is not a unit vector.",
    ),
    known("sum.times(1.0 / SAMPLES as f64)", "sum", "the sum of the samples is not divided by their number."),
    known("        sum = sum.add(radiance(", "        sum = (radiance(", "only the last sample counts."),
    known(
        "return weight.by(V(0.5, 0.7, 1.0)); // the sky",
        "return V(0.5, 0.7, 1.0); // the sky",
        "the sky in a mirror has lost the mirror's colour: `weight` is left out there.",
    ),
    known(
        "return weight.by(colour).by(light).times(1.0 / PI);",
        "return colour.by(light).times(1.0 / PI);",
        "what is seen in a mirror has lost the mirror's colour: `weight` is left out there.",
    ),
    known("1.0 - eta * eta *", "1.0 - eta *", "a square is missing in Snell's law."),
    known("        direction = direction.unit();\n", "", "directions are not unit vectors where glass needs them."),
    known(
        "across * across + along * along",
        "across * across + across * across",
        "glass reflects by one polarisation only.",
    ),
    known("4.0 * PI * radius * radius", "PI * radius * radius", "the area of the lamp is that of a disk."),
    known("4.0 * PI * radius * radius", "2.0 * PI * radius * radius", "the area of the lamp is that of half a sphere."),
    known("2.0 * self.next() - 1.0", "self.next()", "random directions are in the upper half only."),
    known("random.next() >= survives", "random.next() < survives", "the roulette ends what should go on."),
    known(
        "weight = weight.times(1.0 / survives);",
        "weight = weight.times(survives);",
        "paths that survive are weighted by the probability, and not by one over it.",
    ),
    known(
        "pdf = normal.dot(direction) / PI;",
        "pdf = 1.0 / (2.0 * PI);",
        "the pdf of a matte surface's directions is that of uniform ones.",
    ),
    known(
        "pdf = normal.dot(direction) / PI;",
        "pdf = normal.dot(direction);",
        "the pdf of a matte surface's directions lacks its π.",
    ),
    known(
        "leaves = one.max(other).min(leaves);",
        "leaves = one.min(other).min(leaves);",
        "boxes are passed by though rays hit them: which of two ends is where a ray leaves?",
    ),
    known(
        "1.0 / (parts[0] / a.2 + parts[1] / b.2 + parts[2] / c.2)",
        "parts[0] * a.2 + parts[1] * b.2 + parts[2] * c.2",
        "depth is taken as linear in the picture; one over depth is.",
    ),
    known("outward.times(-outward.dot(direction).signum())", "outward", "normals are not turned to the eye."),
    known("LAMP.2.times(PI * LAMP.1 * LAMP.1)", "LAMP.2", "the lamp's radiance is taken for its intensity."),
    known(
        "EYE.add(direction.times(depth))",
        "EYE.add(direction.unit().times(depth))",
        "depth is taken along the ray, and not along the view.",
    ),
    known("right * height) / 2.0", "right * width) / 2.0", "it is too wide: x reaches as far as y."),
    known(
        "area(p, q, at) / area(a, b, c)",
        "area(p, q, at) / area(a, b, c).abs()",
        "triangles of one orientation are missing: areas have a sign.",
    ),
    known("depth >= pixel.0", "depth <= pixel.0", "the farthest stays, and not the nearest."),
];

/// A picture of bytes: its width, its height and its pixels.
pub type Picture = ([usize; 2], Vec<[u8; 3]>);

/// The pictures of all known mistakes that the program of a chapter can have, and what each is; none where there is no
/// compiler.
pub fn known_mistakes(chapter: u32) -> Vec<(&'static str, Picture)> {
    let Ok(program) = program_after(chapter) else { return Vec::new() };
    // Fewer samples are enough to tell one mistake from another, but where a lamp of some size makes noise.
    let program = match chapter {
        17..21 | 30.. => program.replace("SAMPLES: usize = 64;", "SAMPLES: usize = 16;"),
        _ => program.replace("SAMPLES: usize = 16;", "SAMPLES: usize = 4;"),
    };
    let mut all: Vec<(&str, String)> = KNOWN
        .iter()
        .filter(|known| program.contains(known.right))
        .map(|known| (known.looks_like, program.replace(known.right, known.wrong)))
        .collect();
    let before = steps().iter().map(|step| step.number).filter(|&number| number < chapter).max().unwrap_or(1);
    if let Ok(earlier) = program_after(before) {
        all.insert(0, ("it is the picture of your program as it was before this step.", earlier));
    }
    let all = Mutex::new(all.into_iter().enumerate());
    let found = Mutex::new(Vec::new());
    let next = || all.lock().ok()?.next();
    let work = || {
        while let Some((at, (looks_like, program))) = next() {
            if let Ok(picture) = picture_of_program(&program)
                && let Ok(mut found) = found.lock()
            {
                found.push((at, looks_like, picture));
            }
        }
    };
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| (0..workers).for_each(|_| _ = scope.spawn(work)));
    let mut found = found.into_inner().unwrap_or_default();
    found.sort_by_key(|found| found.0);
    found.into_iter().map(|(_, looks_like, picture)| (looks_like, picture)).collect()
}

/// Compiles a program as a reader does, runs it, and reads the picture that it wrote.
///
/// Errors: no compiler; what the compiler says; a program that does not end, or ends without a picture.
pub fn picture_of_program(program: &str) -> Result<Picture, String> {
    Compiled::of(program)?.picture()
}

/// A program in a folder of its own.
pub struct Compiled(tempfile::TempDir);

impl Compiled {
    /// Compiles a program as a reader does.
    ///
    /// Errors: no compiler; what the compiler says.
    pub fn of(program: &str) -> Result<Self, String> {
        let failed = |error: std::io::Error| error.to_string();
        let folder = tempfile::tempdir().map_err(failed)?;
        fs::write(folder.path().join("main.rs"), program).map_err(failed)?;
        let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        let words = ["-O", "--edition", "2024", "-A", "warnings", "main.rs", "-o", "program"];
        let told = Command::new(compiler).args(words).current_dir(folder.path()).output().map_err(failed)?;
        if told.status.success() { Ok(Self(folder)) } else { Err(String::from_utf8_lossy(&told.stderr).into_owned()) }
    }

    /// Runs it, and reads the picture that it wrote.
    ///
    /// Errors: a program that does not end, or ends without a picture.
    pub fn picture(&self) -> Result<Picture, String> {
        let (failed, folder) = (|error: std::io::Error| error.to_string(), self.0.path());
        let mut run = Command::new(folder.join("program"));
        let mut run = run.current_dir(folder).stdout(Stdio::null()).stderr(Stdio::null()).spawn().map_err(failed)?;
        let began = Instant::now();
        while run.try_wait().map_err(failed)?.is_none() {
            if began.elapsed() > PATIENCE {
                run.kill().and_then(|()| run.wait()).map_err(failed)?;
                return Err(format!("the program has not ended after {} s", PATIENCE.as_secs()));
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        let kind = FileKind { name: "a picture", max: 16 << 20 };
        let text = read_file(&folder.join("picture.ppm"), kind).map_err(|told| told.to_string())?;
        picture_in(&String::from_utf8_lossy(&text))
    }
}

/// The picture in a text of the format PPM.
///
/// Errors: what is not so, as the end of a sentence.
pub fn picture_in(text: &str) -> Result<Picture, String> {
    let mut words = text.split_whitespace();
    if words.next() != Some("P3") {
        return Err("it does not begin with P3, as the text of a picture in the format PPM does".into());
    }
    let numbers: Option<Vec<usize>> = words.map(|word| word.parse().ok()).collect();
    match numbers.as_deref() {
        Some([width, height, 255, parts @ ..])
            if width.checked_mul(*height).and_then(|pixels| pixels.checked_mul(3)) == Some(parts.len()) =>
        {
            let byte = |part: usize| u8::try_from(part).map_err(|_| "a number is above 255");
            let pixel = |own: &[usize]| Ok([byte(own[0])?, byte(own[1])?, byte(own[2])?]);
            Ok(([*width, *height], parts.chunks_exact(3).map(pixel).collect::<Result<_, &str>>()?))
        }
        Some(_) => Err("after P3 come width, height, 255 and three numbers for each pixel".into()),
        None => Err("all that follows P3 must be whole numbers".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_known_mistake_can_be_made_in_some_program() {
        let programs: Vec<String> = steps().iter().map(|step| program_after(step.number).expect("applies")).collect();
        for known in &KNOWN {
            assert!(programs.iter().any(|program| program.contains(known.right)), "{}", known.right);
        }
    }
}
