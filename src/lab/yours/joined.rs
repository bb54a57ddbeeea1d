//! Many mistakes in one program, which is told at its start which of them to make, and how many of its pixels to leave out.

use super::known::Compiled;
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// What tells the program which mistake to make, by its number from 1, and of how many pixels of a line and of how many
/// lines it renders one.
pub const WHICH: [&str; 2] = ["PINHOLE_MISTAKE", "PINHOLE_EVERY"];

/// How often what does not compile is left out.
const ROUNDS: usize = 16;
/// How many copies a function has, at most; each is as long as the function.
const COPIES: usize = 120;

/// A mistake, as other lines in place of some of the program's.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// What is said of it.
    pub told: String,
    /// The lines in which it is, from 0, and what they become.
    pub changes: Vec<(Range<usize>, Vec<String>)>,
}

impl Mistake {
    /// That of other words wherever these stand in a program, if that is within functions.
    pub fn of_text(program: &str, (right, wrong): (&str, &str), told: &str) -> Option<Self> {
        let lines: Vec<&str> = program.lines().collect();
        let functions = functions(&lines);
        let mut changes: Vec<(Range<usize>, Vec<String>)> = Vec::new();
        let mut done = 0;
        for (at, _) in program.match_indices(right) {
            let line_of = |at: usize| program[..at].matches('\n').count();
            let (first, last) = (line_of(at), line_of(at + right.trim_end().len()));
            let is_within = |function: &Function| function.lines.start < first && last + 1 < function.lines.end;
            if at < done || !functions.iter().any(is_within) {
                return None;
            }
            let from = program[..at].rfind('\n').map_or(0, |end| end + 1);
            let end = (at + right.len()).max(from);
            let to = program[end..].find('\n').map_or(program.len(), |line| end + line);
            done = to;
            let text = format!("{}{wrong}{}", &program[from..at], &program[end..to]);
            changes.push((first..line_of(to) + 1, text.lines().map(String::from).collect()));
        }
        Some(Self { told: told.into(), changes })
    }
}

/// A function of a program whose head is one line: its lines, its name, and the head from `(` to before `{`.
pub struct Function {
    pub lines: Range<usize>,
    pub name: String,
    signature: String,
}

/// The program with those of the mistakes that compile; none where there is no compiler. All lie within functions.
pub fn joined(program: &str, mistakes: Vec<Mistake>) -> Option<(Compiled, Vec<Mistake>)> {
    let lines: Vec<&str> = program.lines().collect();
    let functions = functions(&lines);
    // Whether the mistake has a copy of its function, or only another expression in its line.
    let mut all: Vec<(Mistake, bool)> = mistakes.into_iter().map(|mistake| (mistake, false)).collect();
    for _ in 0..ROUNDS {
        let (text, places, left_out) = text_of(&lines, &functions, &all);
        let told = match Compiled::of(&text) {
            Ok(compiled) if left_out.is_empty() => {
                return Some((compiled, all.into_iter().map(|(mistake, _)| mistake).collect()));
            }
            Ok(_) => String::new(),
            Err(told) => told,
        };
        let mut wrong: Vec<usize> = error_lines(&told).filter_map(|line| *places.get(line)?).collect();
        wrong.extend(&left_out);
        wrong.sort_unstable();
        wrong.dedup();
        // One of them makes an error elsewhere; the likely ones come first.
        if wrong.is_empty() && all.len() > 1 {
            all.truncate(all.len() / 2);
            continue;
        } else if wrong.is_empty() {
            return None;
        }
        for &mistake in wrong.iter().rev() {
            // Two closures never are of one type.
            let has_closure = all[mistake].0.changes.iter().any(|(at, _)| lines[at.start].contains('|'));
            if has_closure && !all[mistake].1 && !left_out.contains(&mistake) {
                all[mistake].1 = true;
            } else {
                all.remove(mistake);
            }
        }
    }
    None
}

/// The lines of the program that the compiler names in its errors, from 0.
fn error_lines(told: &str) -> impl Iterator<Item = usize> {
    let places = told.lines().filter(|line| line.contains(" error")).filter_map(|line| line.strip_prefix("main.rs:"));
    places.filter_map(|place| place.split(':').next()?.parse::<usize>().ok()).map(|line| line.saturating_sub(1))
}

/// The text of the program, and to which mistake each of its lines belongs.
fn text_of(
    lines: &[&str],
    functions: &[Function],
    all: &[(Mistake, bool)],
) -> (String, Vec<Option<usize>>, HashSet<usize>) {
    let mut left_out = HashSet::new();
    let mut text: Vec<(String, Option<usize>)> = Vec::new();
    let mut at = 0;
    for function in functions {
        text.extend(lines[at..function.lines.start].iter().map(|line| ((*line).to_owned(), None)));
        at = function.lines.end;
        // Of a line, what may stand in its place; and what has a copy of the whole function.
        let mut instead: HashMap<usize, Vec<(usize, &str)>> = HashMap::new();
        let mut copies: Vec<usize> = Vec::new();
        for (number, (mistake, is_copied)) in all.iter().enumerate() {
            let own = || mistake.changes.iter().filter(|(at, _)| function.lines.contains(&at.start));
            let in_line = |(at, wrong): &(Range<usize>, Vec<String>)| {
                let [wrong] = &wrong[..] else { return None };
                let frame = Frame::of(lines, at.start).filter(|_| at.len() == 1)?;
                frame.inner(wrong).map(|_| at.start)
            };
            let places: Option<Vec<usize>> = own().map(in_line).collect();
            match places.filter(|_| !is_copied) {
                Some(places) => {
                    for (line, (_, wrong)) in places.into_iter().zip(own()) {
                        instead.entry(line).or_default().push((number, &wrong[0]));
                    }
                }
                None if copies.len() < COPIES => copies.push(number),
                None => _ = left_out.insert(number),
            }
        }
        let Function { name, signature, lines: own } = function;
        let hook = match name.as_str() {
            "main" => "start();",
            "pixel" if signature.contains("x: usize, y: usize") => "if is_left_out(x, y) { return V(0.0, 0.0, 0.0); }",
            _ => "",
        };
        let mut head = format!("fn {name}{signature} {{ {hook}");
        if !copies.is_empty() {
            let (is_method, arguments) = arguments(signature);
            let call = |number: usize| {
                let dot = if is_method { "self." } else { "" };
                format!("{dot}{name}_{number}({})", arguments.join(", "))
            };
            let plain = signature.replace("(mut ", "(").replace(", mut ", ", ");
            text.push((format!("fn {name}{plain} {{ {hook} match mistake() {{"), None));
            text.extend(copies.iter().map(|copy| (format!("{} => {},", copy + 1, call(copy + 1)), None)));
            text.push((format!("_ => {} }} }}", call(0)), None));
            for &copy in &copies {
                text.push((format!("fn {name}_{}{signature} {{", copy + 1), Some(copy)));
                let mut line = own.start + 1;
                while line < own.end {
                    let change = all[copy].0.changes.iter().find(|(at, _)| at.start == line);
                    match change {
                        Some((at, wrong)) => {
                            text.extend(wrong.iter().map(|wrong| (wrong.clone(), Some(copy))));
                            line = at.end;
                        }
                        None => {
                            text.push((lines[line].into(), Some(copy)));
                            line += 1;
                        }
                    }
                }
            }
            head = format!("fn {name}_0{signature} {{");
        }
        text.push((head, None));
        for line in own.start + 1..own.end {
            match (instead.get(&line), Frame::of(lines, line)) {
                (Some(wrong), Some(frame)) => frame.push(lines[line], wrong, &mut text),
                _ => text.push((lines[line].into(), None)),
            }
        }
    }
    text.extend(lines[at..].iter().map(|line| ((*line).to_owned(), None)));
    let [which, every] = WHICH;
    text.push((
        format!(
            "static MISTAKE: std::sync::atomic::AtomicUsize = std::sync::atomic::AtomicUsize::new(0);\n\
             static EVERY: std::sync::atomic::AtomicUsize = std::sync::atomic::AtomicUsize::new(1);\n\
             fn mistake() -> usize {{ MISTAKE.load(std::sync::atomic::Ordering::Relaxed) }}\n\
             fn written(path: &str, picture: String) -> std::io::Result<()> {{\n\
             let every = EVERY.load(std::sync::atomic::Ordering::Relaxed);\n\
             let words: Vec<&str> = picture.split_ascii_whitespace().collect();\n\
             let number = |at: usize| words.get(at).and_then(|word| word.parse::<usize>().ok()).unwrap_or(0);\n\
             let [width, height] = [number(1), number(2)];\n\
             if every < 2 || words.len() != 4 + 3 * width * height {{ return std::fs::write(path, picture); }}\n\
             let places = |size: usize| (every / 2..size).step_by(every);\n\
             let mut few = format!(\"P3 {{}} {{}} 255\\n\", places(width).count(), places(height).count());\n\
             for y in places(height) {{ for x in places(width) {{\n\
             let at = 4 + 3 * (y * width + x);\n\
             few += &format!(\"{{}} {{}} {{}}\\n\", words[at], words[at + 1], words[at + 2]);\n\
             }} }}\n\
             std::fs::write(path, few)\n\
             }}\n\
             fn is_left_out(x: usize, y: usize) -> bool {{\n\
             let every = EVERY.load(std::sync::atomic::Ordering::Relaxed);\n\
             x % every != every / 2 || y % every != every / 2\n\
             }}\n\
             fn start() {{\n\
             let number = |name: &str| std::env::var(name).ok().and_then(|own| own.parse().ok());\n\
             MISTAKE.store(number(\"{which}\").unwrap_or(0), std::sync::atomic::Ordering::Relaxed);\n\
             EVERY.store(number(\"{every}\").unwrap_or(1), std::sync::atomic::Ordering::Relaxed);\n\
             }}"
        ),
        None,
    ));
    for (line, _) in &mut text {
        *line = line.replace("std::fs::write(\"picture.ppm\"", "written(\"picture.ppm\"");
    }
    let places = text.iter().map(|(_, place)| *place).collect();
    (text.into_iter().map(|(line, _)| line).collect::<Vec<_>>().join("\n") + "\n", places, left_out)
}

/// What stands about an expression, or a statement, that fills the rest of a line.
pub struct Frame<'l> {
    before: &'l str,
    after: &'static str,
    is_statement: bool,
}

impl<'l> Frame<'l> {
    /// Of a line that has one.
    pub fn of(lines: &[&'l str], at: usize) -> Option<Self> {
        let line = code_of(lines[at]);
        let code = line.trim_start();
        let indent = line.len() - code.len();
        let previous = lines[..at].iter().rev().map(|line| code_of(line)).find(|line| !line.trim().is_empty())?;
        let next = lines.get(at + 1).map_or("", |line| line.trim_start());
        let begins = previous.ends_with([';', '{', '}']) || (previous.ends_with(',') && code.contains(" => "));
        let framed = |length: usize, after: &'static str| {
            Some(Self { before: &line[..indent + length], after, is_statement: false })
        };
        let within = |word: &str| code.find(word).map(|at| at + word.len());
        let frame = match () {
            () if code.contains(" else {") => None,
            () if code.starts_with(['.', ')', ']', '}', '|', '&', '+', '/']) => None,
            () if code.starts_with("let ") && code.ends_with(';') => framed(within(" = ")?, ";"),
            () if code.starts_with("if let ") || code.starts_with("while ") => None,
            () if code.starts_with("if ") && code.ends_with(" {") => framed(3, " {"),
            () if code.starts_with("for ") && code.ends_with(" {") => framed(within(" in ")?, " {"),
            () if code.contains(" => ") && code.ends_with(',') => framed(within(" => ")?, ","),
            () if begins && code.ends_with(';') => {
                Some(Self { before: &line[..indent], after: "", is_statement: true })
            }
            () if begins && !code.ends_with(['{', ',', '(', '[']) && next.starts_with('}') => framed(0, ""),
            () if previous.ends_with(['[', '(', ',']) && code.starts_with('(') && code.ends_with("),") => {
                framed(0, ",")
            }
            () => None,
        };
        frame.filter(|frame| frame.inner(line).is_some())
    }

    /// What it frames, of a line as it should be or not.
    fn inner<'w>(&self, line: &'w str) -> Option<&'w str> {
        let code = code_of(line);
        if code.trim().is_empty() && self.is_statement {
            return Some("");
        }
        let inner = code.strip_prefix(self.before)?.strip_suffix(self.after)?;
        is_balanced(inner).then_some(inner)
    }

    /// Adds the line, with each of the wrong ones in the place of a mistake's number.
    fn push(&self, right: &str, wrong: &[(usize, &str)], text: &mut Vec<(String, Option<usize>)>) {
        let arm = |line: &str| {
            let inner = self.inner(line).unwrap_or_default();
            if self.is_statement { format!("{{ {inner} }}") } else { format!("it = {inner},") }
        };
        // Each is assigned by itself, so that each is found that is of another type.
        let before = if self.is_statement { self.before.to_owned() } else { format!("{}{{ let it; ", self.before) };
        let after = if self.is_statement { "};".to_owned() } else { format!("}} it }}{}", self.after) };
        text.push((format!("{before}match mistake() {{ 0 => {}", arm(right)), None));
        text.extend(wrong.iter().map(|(number, wrong)| (format!("{} => {}", number + 1, arm(wrong)), Some(*number))));
        text.push((format!("_ => {} {after}", arm(right)), None));
    }
}

/// A line without its comment.
pub fn code_of(line: &str) -> &str {
    line.split("//").next().unwrap_or_default().trim_end()
}

fn is_balanced(code: &str) -> bool {
    let mut depth = 0;
    let never_below = code.chars().all(|c| {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            _ => {}
        }
        depth >= 0
    });
    never_below && depth == 0
}

/// The functions of a program whose head is one line.
pub fn functions(lines: &[&str]) -> Vec<Function> {
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
    let names = parameters(signature);
    (names.iter().any(|name| name == "self"), names.into_iter().filter(|name| name != "self").collect())
}

/// The names of the parameters.
fn parameters(signature: &str) -> Vec<String> {
    let inner = signature.split(" ->").next().unwrap_or_default();
    let inner = inner.trim_start_matches('(').trim_end_matches(')');
    let name = |part: &str| part.split(':').next().unwrap_or_default().trim().to_owned();
    let name = |part: &str| name(part).trim_start_matches(['&']).trim_start_matches("mut ").to_owned();
    split(inner, ',').into_iter().map(name).filter(|name| !name.is_empty()).collect()
}

impl Function {
    /// The names of the parameters.
    pub fn parameters(&self) -> Vec<String> {
        parameters(&self.signature)
    }
}

/// The parts between separators outside brackets.
pub fn split(code: &str, by: char) -> Vec<&str> {
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
