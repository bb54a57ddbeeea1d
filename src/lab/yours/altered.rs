//! Small mistakes that nobody wrote down: every line of a chapter's step with one word of it changed, all compiled into one
//! program, which is told at its start which of them to make.

use super::known::Compiled;
use super::program::{program_after, steps};
use std::ops::Range;

/// What tells the program which mistake to make.
pub const WHICH: &str = "PINHOLE_ALTERED";

/// How often what does not compile is left out.
const ROUNDS: usize = 6;

/// A line of a function, as the page has it and with a mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Altered {
    /// The line's number in the program, from 0.
    at: usize,
    right: String,
    wrong: String,
}

/// A function of a program: its lines, its name, its parameters, and whether it is a method.
struct Function {
    lines: Range<usize>,
    name: String,
    /// From `(` to before `{`, with a space behind.
    signature: String,
}

/// The program after a chapter with all small mistakes in the functions that its step changed, and what is said of each; the
/// mistake of a number from 1 is made where [`WHICH`] has that number. None where there is no compiler.
pub fn altered(chapter: u32, edit: impl Fn(String) -> String) -> Option<(Compiled, Vec<String>)> {
    let program = edit(program_after(chapter).ok()?);
    let before = steps().iter().map(|step| step.number).filter(|&number| number < chapter).max();
    let before = before.and_then(|number| program_after(number).ok()).map(&edit).unwrap_or_default();
    let lines: Vec<&str> = program.lines().collect();
    let functions = functions(&lines);
    let mut all: Vec<(usize, Altered)> = Vec::new();
    for (which, function) in functions.iter().enumerate() {
        // What was there before was compared before.
        if before.contains(&lines[function.lines.clone()].join("\n")) {
            continue;
        }
        for at in function.lines.start + 1..function.lines.end - 1 {
            let wrong = alterations(lines[at]).into_iter();
            all.extend(wrong.map(|wrong| (which, Altered { at, right: lines[at].into(), wrong })));
        }
    }
    for _ in 0..ROUNDS {
        let (text, places) = joined(&lines, &functions, &all);
        match Compiled::of(&text) {
            Ok(compiled) => {
                let told = |(which, altered): &(usize, Altered)| {
                    let code = |line: &'_ str| line.split("//").next().unwrap_or_default().trim().to_owned();
                    let [wrong, right] = [&altered.wrong, &altered.right].map(|line| code(line));
                    let name = &functions[*which].name;
                    match wrong.is_empty() {
                        true => format!("in `{name}` the line `{right}` were missing"),
                        false => format!("in `{name}` the line `{right}` were `{wrong}`"),
                    }
                };
                return Some((compiled, all.iter().map(told).collect()));
            }
            Err(told) => {
                let wrong: Vec<usize> = error_lines(&told).collect();
                let kept = all.len();
                let mut place = places.iter();
                all.retain(|_| place.next().is_some_and(|place| !wrong.iter().any(|line| place.contains(line))));
                if all.len() == kept {
                    return None;
                }
            }
        }
    }
    None
}

/// The lines of the program that the compiler names in its errors, from 0.
fn error_lines(told: &str) -> impl Iterator<Item = usize> {
    let places = told.lines().filter_map(|line| line.trim().strip_prefix("--> main.rs:"));
    places.filter_map(|place| place.split(':').next()?.parse::<usize>().ok()).map(|line| line.saturating_sub(1))
}

/// A program in which each function asks which mistake is to be made, and the lines of each mistake's copy of its function.
fn joined(lines: &[&str], functions: &[Function], all: &[(usize, Altered)]) -> (String, Vec<Range<usize>>) {
    let mut text: Vec<String> = Vec::new();
    let mut places = vec![0..0; all.len()];
    let mut at = 0;
    for (which, function) in functions.iter().enumerate() {
        text.extend(lines[at..function.lines.start].iter().map(|line| (*line).to_owned()));
        at = function.lines.end;
        let own = || all.iter().enumerate().filter(|(_, (of, _))| *of == which);
        if own().next().is_none() {
            text.extend(lines[function.lines.clone()].iter().map(|line| (*line).to_owned()));
            continue;
        }
        let Function { name, signature, .. } = function;
        let (is_method, arguments) = arguments(signature);
        let call = |number: usize| {
            let dot = if is_method { "self." } else { "" };
            format!("{dot}{name}_{number}({})", arguments.join(", "))
        };
        let plain = signature.replace("(mut ", "(").replace(", mut ", ", ");
        text.push(format!("fn {name}{plain} {{ match altered() {{"));
        text.extend(own().map(|(number, _)| format!("{} => {},", number + 1, call(number + 1))));
        text.push(format!("_ => {} }} }}", call(0)));
        let copies = std::iter::once((0, None)).chain(own().map(|(number, (_, altered))| (number + 1, Some(altered))));
        for (number, altered) in copies {
            let first = text.len();
            text.push(format!("fn {name}_{number}{signature} {{"));
            for line in function.lines.start + 1..function.lines.end {
                let wrong = altered.filter(|altered| altered.at == line);
                text.push(wrong.map_or(lines[line], |altered| &altered.wrong).to_owned());
            }
            if number > 0 {
                places[number - 1] = first..text.len();
            }
        }
    }
    text.extend(lines[at..].iter().map(|line| (*line).to_owned()));
    text.push(format!(
        "static ALTERED: std::sync::LazyLock<u32> = std::sync::LazyLock::new(|| \
         std::env::var(\"{WHICH}\").ok().and_then(|own| own.parse().ok()).unwrap_or(0));\n\
         fn altered() -> u32 {{ *ALTERED }}"
    ));
    (text.join("\n") + "\n", places)
}

/// The functions of a program whose head is one line.
fn functions(lines: &[&str]) -> Vec<Function> {
    let mut all = Vec::new();
    for (start, line) in lines.iter().enumerate() {
        let indent = line.len() - line.trim_start().len();
        let Some(rest) = line.trim_start().strip_prefix("fn ") else { continue };
        let (Some(open), Some(head)) = (rest.find('('), rest.strip_suffix(" {")) else { continue };
        let closes = |other: &&str| other.starts_with('}') || (other.trim() == "}" && other.len() == indent + 1);
        let Some(length) = lines[start + 1..].iter().position(closes) else { continue };
        if indent > 4 || all.last().is_some_and(|last: &Function| last.lines.contains(&start)) {
            continue;
        }
        all.push(Function {
            lines: start..start + length + 2,
            name: rest[..open].to_owned(),
            signature: head[open..].to_owned(),
        });
    }
    all
}

/// Whether a function is a method, and the names of its other parameters.
fn arguments(signature: &str) -> (bool, Vec<String>) {
    let inner = &signature[1..close(signature, 0).unwrap_or(signature.len())];
    let parts = split(inner, ',');
    let is_method = parts.first().is_some_and(|first| first.trim().ends_with("self"));
    let names = parts.iter().filter(|part| !part.trim().ends_with("self") && !part.trim().is_empty());
    let name = |part: &&str| part.split(':').next().unwrap_or_default().trim().trim_start_matches("mut ").to_owned();
    (is_method, names.map(name).collect())
}

/// A line with each small mistake that it can have.
fn alterations(line: &str) -> Vec<String> {
    let code = line.split("//").next().unwrap_or_default().trim_end();
    if code.contains('"') || code.trim().len() < 3 {
        return Vec::new();
    }
    let mut all = Vec::new();
    for (from, to) in WORDS {
        all.extend(code.match_indices(from).map(|(at, _)| code[..at].to_owned() + to + &code[at + from.len()..]));
    }
    for (at, _) in code.match_indices(['*', '/', '+', '-']) {
        let is_between = code[..at].ends_with(' ') && code[at + 1..].starts_with(' ');
        if is_between {
            let (left, right) = (term_before(code, at - 1), term_after(code, at + 2));
            all.push(code[..at - 1].to_owned() + &code[right..]);
            all.push(code[..left].to_owned() + &code[at + 2..]);
        } else if code[at..].starts_with('-') && code[at + 1..].starts_with(|c: char| c.is_ascii_alphanumeric()) {
            all.push(code[..at].to_owned() + &code[at + 1..]);
        }
    }
    // A call or its two arguments.
    for (at, _) in code.match_indices('(') {
        let Some(end) = close(code, at) else { continue };
        let name = code[..at].rfind(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).map_or(0, |before| before + 1);
        let is_method = code[..name].ends_with('.') && name < at;
        let inner = &code[at + 1..end];
        if is_method && (DROPPED.contains(&&code[name..at])) {
            all.push(code[..name - 1].to_owned() + &code[end + 1..]);
        }
        if is_method && &code[name..at] == "dot" {
            all.push(code[..=end].to_owned() + ".sqrt()" + &code[end + 1..]);
        }
        let parts = split(inner, ',');
        for (one, other) in (1..parts.len()).flat_map(|other| (0..other).map(move |one| (one, other))) {
            let mut parts: Vec<&str> = parts.iter().map(|part| part.trim()).collect();
            parts.swap(one, other);
            all.push(code[..=at].to_owned() + &parts.join(", ") + &code[end..]);
        }
        for name in
            parts.iter().map(|part| part.trim()).filter(|part| part.chars().all(|c| c == '_' || c.is_alphabetic()))
        {
            all.extend(word_indices(&code[at..end], name).first().map(|word| {
                let behind = at + word + name.len();
                format!("{}.unit(){}", &code[..behind], &code[behind..])
            }));
        }
        if is_method && parts.len() == 1 && ["cross", "sub", "min", "max"].contains(&&code[name..at]) {
            let receiver = term_before(code, name);
            let of = code[receiver..name].trim_end_matches('.');
            all.push(format!("{}({inner}).{}({of}){}", &code[..receiver], &code[name..at], &code[end + 1..]));
        }
    }
    // Which part of a vector.
    for (at, _) in code.match_indices('.') {
        let is_part = code[..at].ends_with(|c: char| c.is_ascii_alphabetic() || c == '_')
            && code[at + 1..].starts_with(['0', '1', '2'])
            && !code[at + 2..].starts_with(|c: char| c.is_ascii_digit());
        let parts = ["0", "1", "2"].into_iter().filter(|part| is_part && !code[at + 1..].starts_with(part));
        all.extend(parts.map(|part| code[..=at].to_owned() + part + &code[at + 2..]));
    }
    // Names that are bound or written side by side.
    for (one, other) in names_of_a_kind(code) {
        all.extend(
            word_indices(code, one).into_iter().map(|at| code[..at].to_owned() + other + &code[at + one.len()..]),
        );
    }
    for (one, other) in names_of_a_kind(code).into_iter().filter(|(one, other)| one < other) {
        all.push(exchanged(code, one, other));
    }
    if let Some(rest) = code.trim_start().strip_prefix("if ")
        && let Some(condition) = rest.strip_suffix(" {")
        && !condition.starts_with("let ")
    {
        all.push(format!("if !({condition}) {{"));
        for joint in [" && ", " || "] {
            for (at, _) in condition.match_indices(joint) {
                all.push(format!("if {} {{", &condition[..at]));
                all.push(format!("if {} {{", &condition[at + joint.len()..]));
            }
        }
    }
    let is_step = code.ends_with(';') && !code.trim_start().starts_with("let ") && !code.contains("return");
    if is_step && code.contains(" = ") {
        all.push(String::new());
    }
    if let Some((start, sum)) = code.split_once(" += ") {
        all.push(format!("{start} = {sum}"));
    }
    let mut seen = std::collections::HashSet::new();
    all.retain(|wrong| wrong != code && seen.insert(wrong.clone()));
    all
}

/// Words for one another.
const WORDS: [(&str, &str); 34] = [
    (".tan()", ".sin()"),
    (".tan()", ".cos()"),
    (".sin()", ".cos()"),
    (".cos()", ".sin()"),
    (" + ", " - "),
    (" - ", " + "),
    (" * ", " / "),
    (" / ", " * "),
    (" < ", " > "),
    (" > ", " < "),
    (" <= ", " >= "),
    (" >= ", " < "),
    (".min(", ".max("),
    (".max(", ".min("),
    (".add(", ".sub("),
    (".sub(", ".add("),
    ("2.0 * ", "4.0 * "),
    ("4.0 * ", "2.0 * "),
    ("4.0 * ", "1.0 * "),
    ("/ PI", "/ (2.0 * PI)"),
    ("/ PI", "/ (4.0 * PI)"),
    ("WIDTH", "HEIGHT"),
    ("HEIGHT", "WIDTH"),
    ("width", "height"),
    ("height", "width"),
    ("1e-9", "0.0"),
    ("1e-9", "-1e-9"),
    ("true", "false"),
    ("false", "true"),
    ("+ 1", "+ 0"),
    ("INFINITY", "MIN_POSITIVE"),
    (" as f64 + ", " as f64 + 0.5 + "),
    ("SAMPLES as f64", "(SAMPLES - 1) as f64"),
    (" = ", " = -"),
];

/// Calls that are forgotten.
const DROPPED: [&str; 18] = [
    "sqrt",
    "unit",
    "abs",
    "max",
    "min",
    "clamp",
    "round",
    "to_radians",
    "times",
    "by",
    "add",
    "sub",
    "normal",
    "signum",
    "floor",
    "rev",
    "skip",
    "wrapping_add",
];

/// Names of one line of which any may stand for any other.
const MANY: usize = 5;

/// Pairs of names of one line that may stand for one another.
fn names_of_a_kind(code: &str) -> Vec<(&str, &str)> {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let is_name = |word: &&str| word.starts_with(|c: char| c.is_ascii_alphabetic()) && *word != "let" && *word != "mut";
    let mut words: Vec<&str> = code.split(|c| !is_word(c)).filter(is_name).collect();
    words.retain(|word| {
        !["if", "else", "return", "as", "f64", "V", "Some", "match", "for", "in", "fn", "ref"].contains(word)
    });
    // Methods, types and functions are none.
    words.retain(|word| {
        word_indices(code, word).iter().any(|&at| {
            !code[..at].ends_with('.')
                && !code[at + word.len()..].starts_with(['(', ':'])
                && !code[at..].starts_with("f64")
        })
    });
    words.dedup();
    words.sort_unstable();
    words.dedup();
    if words.len() > MANY {
        return Vec::new();
    }
    let pairs = words.iter().flat_map(|one| words.iter().map(move |other| (*one, *other)));
    pairs.filter(|(one, other)| one != other).collect()
}

/// With each of two words in place of the other.
fn exchanged(code: &str, one: &str, other: &str) -> String {
    let mut places: Vec<(usize, &str, &str)> = word_indices(code, one).into_iter().map(|at| (at, one, other)).collect();
    places.extend(word_indices(code, other).into_iter().map(|at| (at, other, one)));
    places.sort_unstable();
    let mut made = code.to_owned();
    for (at, from, to) in places.into_iter().rev() {
        made.replace_range(at..at + from.len(), to);
    }
    made
}

/// Where a word stands by itself.
fn word_indices(code: &str, word: &str) -> Vec<usize> {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let alone =
        |&(at, _): &(usize, &str)| !code[..at].ends_with(is_word) && !code[at + word.len()..].starts_with(is_word);
    code.match_indices(word).filter(alone).map(|(at, _)| at).collect()
}

/// Where the bracket that opens here is closed.
fn close(code: &str, open: usize) -> Option<usize> {
    let mut depth = 0;
    code[open..].char_indices().find_map(|(at, c)| {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            _ => {}
        }
        (depth == 0).then_some(open + at)
    })
}

/// The parts between separators outside brackets.
fn split(code: &str, by: char) -> Vec<&str> {
    let (mut depth, mut from, mut parts) = (0, 0, Vec::new());
    for (at, c) in code.char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            _ if c == by && depth == 0 => {
                parts.push(&code[from..at]);
                from = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&code[from..]);
    parts
}

/// Where the term ends that begins here: a name or a number with its calls and parts, or a bracket.
fn term_after(code: &str, from: usize) -> usize {
    let mut at = from;
    while let Some(c) = code[at..].chars().next() {
        match c {
            '(' | '[' => at = close(code, at).map_or(code.len(), |end| end + 1),
            '-' if at == from => at += 1,
            _ if c.is_ascii_alphanumeric() || c == '_' || c == '.' || c == ':' => at += 1,
            _ => break,
        }
    }
    if code[at..].starts_with(" as f64") { at + " as f64".len() } else { at }
}

/// Where the term begins that ends here.
fn term_before(code: &str, to: usize) -> usize {
    let (mut at, mut depth) = (to, 0);
    for (before, c) in code[..to].char_indices().rev() {
        match c {
            ')' | ']' => depth += 1,
            '(' | '[' if depth > 0 => depth -= 1,
            _ if depth > 0 => {}
            _ if c.is_ascii_alphanumeric() || c == '_' || c == '.' => {}
            ' ' if code[..before].ends_with(" as") || code[before..].starts_with(" as f64") => {}
            _ => break,
        }
        at = before;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_the_small_mistakes_that_readers_make() {
        let all = alterations("    let up = half * (1.0 - 2.0 * y / HEIGHT as f64); // upward");
        for wrong in [
            "    let up = half * (1.0 + 2.0 * y / HEIGHT as f64);",
            "    let up = half * (1.0 - 2.0 * y / WIDTH as f64);",
            "    let up = half * (1.0 - y / HEIGHT as f64);",
            "    let up = (1.0 - 2.0 * y / HEIGHT as f64);",
            "    let up = half * (2.0 * y / HEIGHT as f64);",
            "    let up = half * (1.0 - 2.0 * y);",
        ] {
            assert!(all.iter().any(|one| one == wrong), "{wrong} is none of {all:#?}");
        }
        let all = alterations("let right = up.cross(back).unit();");
        for wrong in ["let right = up.cross(back);", "let right = (back).cross(up).unit();", "let right = up.unit();"] {
            assert_eq!(all.iter().any(|one| one == wrong), !wrong.contains("up.unit"), "{wrong}: {all:#?}");
        }
    }

    #[test]
    fn the_steps_that_are_quick_compile_with_their_small_mistakes() {
        for chapter in [5, 19] {
            let (_, told) = altered(chapter, |program| program).expect("compiles");
            assert!(told.len() > 50, "{chapter}: {}", told.len());
        }
    }
}
