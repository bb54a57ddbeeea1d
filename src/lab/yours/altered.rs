//! Small mistakes that nobody wrote down: every line of a chapter's step with one thing in it changed.

use super::joined::{Frame, Function, Mistake, code_of, functions, split};

/// All small mistakes in the functions of a program that are not in the one before, the likely ones first.
pub fn small_mistakes(program: &str, before: &str) -> Vec<Mistake> {
    let lines: Vec<&str> = program.lines().collect();
    let (mut likely, mut others) = (Vec::new(), Vec::new());
    let functions = functions(&lines);
    // What was there before was compared before.
    let is_new = |function: &&Function| !before.contains(&lines[function.lines.clone()].join("\n"));
    for function in functions.iter().filter(is_new) {
        let name = &function.name;
        let mut bound = function.parameters();
        for at in function.lines.start + 1..function.lines.end - 1 {
            let right = code_of(lines[at]);
            let one = |wrong: String| {
                let told = match wrong.trim() {
                    "" => format!("in `{name}` the line `{}` were missing", right.trim()),
                    wrong => format!("in `{name}` the line `{}` were `{wrong}`", right.trim()),
                };
                Mistake { told, changes: vec![(at..at + 1, vec![wrong])] }
            };
            let few = alterations(right);
            let more = exchanged_for(right, &bound).into_iter().filter(|wrong| !few.contains(wrong));
            // Not where each would take a copy of the function.
            others.extend(more.filter(|_| Frame::of(&lines, at).is_some()).map(one));
            likely.extend(few.into_iter().map(one));
            if let Some(next) = lines.get(at + 1).map(|next| code_of(next))
                && is_step(right)
                && is_step(next)
            {
                let told = format!("in `{name}` the lines `{}` and `{}` were exchanged", right.trim(), next.trim());
                likely.push(Mistake { told, changes: vec![(at..at + 2, vec![next.into(), right.into()])] });
            }
            bound.extend(bound_in(right).map(String::from));
        }
    }
    likely.append(&mut others);
    likely
}

/// Whether a line is a statement that changes something.
fn is_step(code: &str) -> bool {
    let code = code.trim_start();
    code.ends_with(';') && code.contains(" = ") && !code.starts_with("let ") && !code.starts_with("return")
}

/// The names that a line binds.
fn bound_in(code: &str) -> impl Iterator<Item = &str> {
    let pattern = code.trim_start().strip_prefix("let ").and_then(|rest| rest.split(" = ").next()).unwrap_or_default();
    let words = pattern.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
    words.filter(|word| word.starts_with(|c: char| c.is_ascii_lowercase()) && *word != "mut")
}

/// A line with a name, or what a call is given, exchanged for another name that is bound there.
fn exchanged_for(code: &str, bound: &[String]) -> Vec<String> {
    let from = code.find(" = ").map_or(0, |at| at + 3);
    let mut places: Vec<(usize, usize)> = Vec::new();
    for name in bound {
        let own = word_indices(code, name).into_iter().filter(|&at| at >= from && !code[..at].ends_with('.'));
        places.extend(own.map(|at| (at, at + name.len())));
    }
    for (at, _) in code.match_indices('(') {
        let Some(end) = close(code, at) else { continue };
        let mut start = at + 1;
        for part in split(&code[at + 1..end], ',') {
            let own = part.trim();
            let first = start + (part.len() - part.trim_start().len());
            if own.contains(['.', '(']) && first >= from && !own.contains('|') {
                places.push((first, first + own.len()));
            }
            start += part.len() + 1;
        }
    }
    let of = |&(start, end): &(usize, usize)| {
        let others = bound.iter().filter(move |other| code[start..end] != ***other);
        others.map(move |other| code[..start].to_owned() + other + &code[end..]).collect::<Vec<_>>()
    };
    let mut all: Vec<String> = places.iter().flat_map(of).collect();
    all.sort_unstable();
    all.dedup();
    all
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
        all.extend([format!("if !({condition}) {{"), "if false {".into(), "if true {".into()]);
        for joint in [" && ", " || "] {
            for (at, _) in condition.match_indices(joint) {
                all.push(format!("if {} {{", &condition[..at]));
                all.push(format!("if {} {{", &condition[at + joint.len()..]));
            }
        }
    }
    if is_step(code) {
        all.push(String::new());
    }
    for (at, end) in literals(code) {
        let number = &code[at..end];
        let others = match number.parse::<f64>() {
            Ok(own) if number.contains('.') => {
                [-own, 0.0, 1.0, 2.0 * own, own / 2.0, 10.0 * own, own / 10.0, own + 1.0]
                    .map(|other| format!("{other:?}"))
                    .to_vec()
            }
            Ok(own) => [own + 1.0, own - 1.0, 1.0, 0.0].map(|other| format!("{other}")).to_vec(),
            Err(_) => Vec::new(),
        };
        all.extend(others.into_iter().map(|other| code[..at].to_owned() + &other + &code[end..]));
    }
    if let Some((start, sum)) = code.split_once(" += ") {
        all.push(format!("{start} = {sum}"));
    }
    let mut seen = std::collections::HashSet::new();
    all.retain(|wrong| wrong != code && !wrong.contains("--") && seen.insert(wrong.clone()));
    all
}

/// Where numbers stand by themselves.
fn literals(code: &str) -> Vec<(usize, usize)> {
    let mut all = Vec::new();
    let mut at = 0;
    while let Some(start) = code[at..].find(|c: char| c.is_ascii_digit()).map(|from| at + from) {
        let is_within = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let mut end = start + code[start..].find(|c: char| !is_within(c)).unwrap_or(code.len() - start);
        if code[end..].starts_with('.') && code[end + 1..].starts_with(|c: char| c.is_ascii_digit()) {
            end += 1;
            end += code[end..].find(|c: char| !is_within(c)).unwrap_or(code.len() - end);
        }
        // Neither a part of a vector nor of a name, nor with a power of ten.
        if !code[..start].ends_with(|c: char| is_within(c) || c == '.') && !code[start..end].contains('e') {
            all.push((start, end));
        }
        at = end;
    }
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
}
