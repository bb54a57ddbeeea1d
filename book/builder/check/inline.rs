//! What stands inside a sentence and is filled in where a page is read: numbers, which are computed, and citations.
//!
//! `{{= 2*120.5/480 - 1 : 4}}` becomes −0.4979, and `[@kajiya1986]` a link to that entry of the bibliography.

use super::scan::{Line, Scan};
use super::{Page, Problem};
use std::collections::BTreeMap;

/// The page that lists what the others cite.
pub const BIBLIOGRAPHY: &str = "bibliography.md";

/// For each key of the bibliography, how it is cited: "Kajiya 1986".
pub type Citations = BTreeMap<String, String>;

/// The entries of the bibliography: lines of the form `- [@key]: Label. Everything else.`
pub fn citations(bibliography: &str) -> Citations {
    bibliography.lines().filter_map(entry).map(|(key, label, _)| (key.to_owned(), label.to_owned())).collect()
}

/// The key, the label and the rest of an entry.
fn entry(line: &str) -> Option<(&str, &str, &str)> {
    let (key, text) = line.strip_prefix("- [@")?.split_once("]: ")?;
    // A label ends with its year, and may hold other dots.
    let is_year = |&(at, _): &(usize, &str)| text[..at].ends_with(|letter: char| letter.is_ascii_digit());
    let (end, _) = text.match_indices(". ").find(is_year)?;
    Some((key, &text[..end], &text[end + 2..]))
}

/// A page's text with its numbers and citations; what cannot be filled in stays, and [`problems`] finds it.
pub fn filled(name: &str, text: &str, citations: &Citations) -> String {
    let (scan, mut is_formula) = (Scan::new(text), false);
    let edited = |line: &Line<'_>| {
        if line.fence.is_some() {
            return line.text.to_owned();
        }
        if let (BIBLIOGRAPHY, Some((key, label, rest))) = (name, entry(line.text)) {
            return format!("- <a id=\"{key}\"></a>**{label}.** {rest}");
        }
        let numbered = with_numbers(line.text, is_formula);
        is_formula ^= numbered.matches("$$").count() % 2 == 1;
        with_citations(&numbered, citations)
    };
    let lines: Vec<String> = scan.lines.iter().map(edited).collect();
    lines.join("\n") + if text.ends_with('\n') { "\n" } else { "" }
}

/// The mistakes in a page's numbers and citations.
pub fn problems(page: &Page) -> Vec<Problem> {
    let mut problems = Vec::new();
    for Line { number, text, .. } in Scan::new(&page.text).prose() {
        let mut told = |what: String| problems.push(Problem::new(&page.label, *number, what));
        for (at, _) in text.match_indices("{{=") {
            let what = number_at(&text[at..]).err().unwrap_or_default();
            told(format!("`{}` cannot be computed: {what}", &text[at..]));
        }
        for (at, _) in text.match_indices("[@") {
            let key = text[at + 2..].split(']').next().unwrap_or_default();
            told(format!(
                "`[@{key}]` is cited, and has no line `- [@{key}]: Name year. …` in book/src/{BIBLIOGRAPHY}."
            ));
        }
    }
    problems
}

/// Each run of citations as the sentence around it reads them: "Heckbert (1990) argues", "is older (Appel 1968)".
fn with_citations(line: &str, citations: &Citations) -> String {
    let (mut out, mut rest) = (String::new(), line);
    while let Some(at) = rest.find("[@") {
        let (before, from) = rest.split_at(at);
        out.push_str(before);
        let (cited, length) = run_of(from, citations);
        if cited.is_empty() {
            out.push_str("[@");
            rest = &from[2..];
        } else {
            out = cited_after(&out, &cited);
            rest = &from[length..];
        }
    }
    out + rest
}

/// The keys and labels of citations that only commas or semicolons part, and how long the run is.
fn run_of<'a>(text: &'a str, citations: &'a Citations) -> (Vec<(&'a str, &'a str)>, usize) {
    let (mut cited, mut length) = (Vec::new(), 0);
    let mut next = Some(text);
    while let Some(key) = next.and_then(|next| next.strip_prefix("[@")?.split(']').next()) {
        let Some(label) = citations.get(key) else { break };
        cited.push((key, label.as_str()));
        length = text.len() - next.map_or(0, str::len) + key.len() + "[@]".len();
        next = text.get(length..).and_then(|rest| rest.strip_prefix(", ").or_else(|| rest.strip_prefix("; ")));
    }
    (cited, length)
}

/// Words after which an author is named in the sentence: "as Kay and Kajiya (1986) did".
const BEFORE_AUTHORS: [&str; 12] =
    ["after", "and", "as", "by", "compare", "from", "in", "of", "see", "than", "what", "with"];

/// The beginning of a line, and a run of citations after it.
fn cited_after(before: &str, cited: &[(&str, &str)]) -> String {
    let linked = |key: &str, text: &str| format!("[{text}]({BIBLIOGRAPHY}#{key})");
    let whole: Vec<String> = cited.iter().map(|(key, label)| linked(key, label)).collect();
    let whole = whole.join("; ");
    let lead = before.trim_end();
    let words: Vec<&str> = lead.split([' ', '*', '_', '(']).filter(|word| !word.is_empty()).collect();
    let is_awaited = lead.ends_with(['.', ':', ';', '?', '!', '|', '-', '('])
        || words.last().is_none_or(|word| BEFORE_AUTHORS.contains(&word.to_lowercase().as_str()));
    if in_parentheses(before) {
        let comma = if is_awaited || lead.ends_with(',') { "" } else { "," };
        return if comma.is_empty() { format!("{before}{whole}") } else { format!("{lead}{comma} {whole}") };
    }
    let named = |label: &str| {
        let authors = label.rsplit_once(' ').map_or("", |(authors, _)| authors);
        let mut authors = authors.split(", ").flat_map(|some| some.split(" and ")).filter(|author| *author != "others");
        authors.any(|author| words.iter().rev().take(4).any(|word| word.starts_with(author)))
    };
    let in_text = |(key, label): &(&str, &str)| {
        let (authors, year) = label.rsplit_once(' ').unwrap_or((label, ""));
        format!("{} ({year})", linked(key, authors))
    };
    match cited {
        [(key, label)] if named(label) => {
            format!("{before}({})", linked(key, label.rsplit_once(' ').map_or(label, |(_, year)| year)))
        }
        _ if is_awaited => before.to_owned() + &cited.iter().map(in_text).collect::<Vec<_>>().join(" and "),
        _ => format!("{before}({whole})"),
    }
}

/// Whether a parenthesis is open at the end of a text; those in code and in formulas do not count.
fn in_parentheses(text: &str) -> bool {
    let prose = text.split('`').step_by(2).collect::<String>();
    let prose = prose.split('$').step_by(2).collect::<String>();
    prose.matches('(').count() > prose.matches(')').count()
}

/// `is_formula`: whether the line begins inside a formula between two `$$`.
fn with_numbers(line: &str, is_formula: bool) -> String {
    let (mut out, mut rest) = (String::new(), line);
    while let Some(at) = rest.find("{{=") {
        let (before, from) = rest.split_at(at);
        out.push_str(before);
        match number_at(from) {
            Ok((number, length)) => {
                let whole = out.matches("$$").count() % 2 == 1;
                let inline = out.replace("$$", "").matches('$').count() % 2 == 1;
                // A formula has a minus of its own.
                let is_formula = inline || (whole ^ is_formula);
                out.push_str(&if is_formula { number } else { number.replace('-', "−") });
                rest = &from[length..];
            }
            Err(_) => {
                out.push_str("{{=");
                rest = &from[3..];
            }
        }
    }
    out + rest
}

/// The number of a directive at the start of a text, and the directive's length.
fn number_at(text: &str) -> Result<(String, usize), String> {
    let end = text.find("}}").ok_or("it does not end with }}")?;
    let inside = &text["{{=".len()..end];
    let (expression, decimals) = inside.rsplit_once(':').ok_or("it needs `: decimals`")?;
    let decimals: usize = decimals.trim().parse().map_err(|_| "after the colon stands the number of decimals")?;
    let value = value_of(expression)?;
    if !value.is_finite() {
        return Err(format!("it is {value}"));
    }
    let shown = format!("{value:.decimals$}");
    let is_zero = shown.chars().all(|letter| !letter.is_ascii_digit() || letter == '0');
    let shown = if is_zero { shown.trim_start_matches('-').to_owned() } else { shown };
    Ok((shown, end + 2))
}

/// The value of an expression: + - * / ^, parentheses, numbers, `pi`, and functions of one or two arguments.
pub fn value_of(expression: &str) -> Result<f64, String> {
    let mut reader = Reader { letters: expression.chars().collect(), at: 0 };
    let value = reader.sum()?;
    reader.skip_spaces();
    match reader.letters.get(reader.at) {
        None => Ok(value),
        Some(letter) => Err(format!("`{letter}` is not expected there")),
    }
}

/// Reads an expression from left to right.
struct Reader {
    letters: Vec<char>,
    at: usize,
}

impl Reader {
    fn skip_spaces(&mut self) {
        _ = self.while_of(char::is_whitespace);
    }

    fn take(&mut self, wanted: char) -> bool {
        self.skip_spaces();
        let found = self.letters.get(self.at) == Some(&wanted);
        self.at += usize::from(found);
        found
    }

    fn sum(&mut self) -> Result<f64, String> {
        let mut value = self.product()?;
        loop {
            if self.take('+') {
                value += self.product()?;
            } else if self.take('-') {
                value -= self.product()?;
            } else {
                return Ok(value);
            }
        }
    }

    fn product(&mut self) -> Result<f64, String> {
        let mut value = self.signed()?;
        loop {
            if self.take('*') {
                value *= self.signed()?;
            } else if self.take('/') {
                value /= self.signed()?;
            } else {
                return Ok(value);
            }
        }
    }

    fn signed(&mut self) -> Result<f64, String> {
        if self.take('-') { Ok(-self.signed()?) } else { self.power() }
    }

    /// A power binds its left side more closely than a sign does, and is read from the right.
    fn power(&mut self) -> Result<f64, String> {
        let base = self.single()?;
        if self.take('^') { Ok(base.powf(self.signed()?)) } else { Ok(base) }
    }

    fn single(&mut self) -> Result<f64, String> {
        if self.take('(') {
            let value = self.sum()?;
            return if self.take(')') { Ok(value) } else { Err("a parenthesis is not closed".to_owned()) };
        }
        self.skip_spaces();
        let word = self.while_of(|letter| letter.is_ascii_alphabetic());
        if !word.is_empty() {
            return self.named(&word);
        }
        let mut number = self.while_of(|letter| letter.is_ascii_digit() || letter == '.');
        if !number.is_empty() && self.letters.get(self.at) == Some(&'e') {
            self.at += 1;
            number.push('e');
            if self.take('-') {
                number.push('-');
            }
            number += &self.while_of(|letter| letter.is_ascii_digit());
        }
        number.parse().map_err(|_| match self.letters.get(self.at) {
            Some(letter) => format!("a number is expected before `{letter}`"),
            None => "a number is expected at the end".to_owned(),
        })
    }

    fn while_of(&mut self, belongs: impl Fn(char) -> bool) -> String {
        let letters: String = self.letters[self.at..].iter().take_while(|&&letter| belongs(letter)).collect();
        self.at += letters.len();
        letters
    }

    fn named(&mut self, word: &str) -> Result<f64, String> {
        if word == "pi" {
            return Ok(std::f64::consts::PI);
        }
        // The names that end with a number.
        let mut name = word.to_owned();
        if matches!(word, "log" | "atan") {
            name += &self.while_of(|letter| letter.is_ascii_digit());
        }
        if !self.take('(') {
            return Err(format!("`{name}` is neither pi nor a function with its arguments"));
        }
        let mut arguments = vec![self.sum()?];
        while self.take(',') {
            arguments.push(self.sum()?);
        }
        if !self.take(')') {
            return Err(format!("the arguments of `{name}` do not end"));
        }
        let of_one = OF_ONE.iter().find(|(own, _)| *own == name);
        let of_two = OF_TWO.iter().find(|(own, _)| *own == name);
        match (of_one, of_two, arguments.as_slice()) {
            (Some((_, function)), _, &[x]) => Ok(function(x)),
            (_, Some((_, function)), &[a, b]) => Ok(function(a, b)),
            (.., given) => Err(format!("`{name}` with {} arguments is not known", given.len())),
        }
    }
}

/// The functions of one argument.
const OF_ONE: [(&str, fn(f64) -> f64); 15] = [
    ("sqrt", f64::sqrt),
    ("sin", f64::sin),
    ("cos", f64::cos),
    ("tan", f64::tan),
    ("asin", f64::asin),
    ("acos", f64::acos),
    ("atan", f64::atan),
    ("exp", f64::exp),
    ("ln", f64::ln),
    ("log2", f64::log2),
    ("log10", f64::log10),
    ("abs", f64::abs),
    ("floor", f64::floor),
    ("rad", f64::to_radians),
    ("deg", f64::to_degrees),
];

/// Those of two.
const OF_TWO: [(&str, fn(f64, f64) -> f64); 3] = [("atan2", f64::atan2), ("min", f64::min), ("max", f64::max)];

#[cfg(test)]
mod tests {
    use super::super::made_up;
    use super::*;

    fn told(text: &str) -> String {
        filled("page.md", text, &citations("- [@kajiya1986]: Kajiya 1986. James T. Kajiya: *The Rendering Equation*."))
    }

    #[test]
    fn expressions_have_the_value_that_arithmetic_gives_them() {
        for (expression, value) in [
            ("1 + 2*3", 7.0),
            ("2^3^2", 512.0),
            ("-2^2", -4.0),
            ("(1+2)*3/2", 4.5),
            ("2*-3", -6.0),
            ("8/2/2", 2.0),
            ("1e-3*1000", 1.0),
            ("sqrt(2)^2", 2.0),
            ("deg(atan2(1, 1)) + log2(8) + min(4, 2)", 50.0),
            ("cos(rad(60)) * pi / pi", 0.5),
        ] {
            let found = value_of(expression).expect(expression);
            assert!((found - value).abs() < 1e-12, "{expression} = {found}");
        }
        for wrong in ["", "1 +", "(1", "2 2", "sine(1)", "min(1)", "pi(", "1..2"] {
            assert!(value_of(wrong).is_err(), "{wrong:?} has no value");
        }
    }

    #[test]
    fn numbers_and_citations_are_filled_in() {
        assert_eq!(told("x = {{= 2*120.5/480 - 1 : 4}}."), "x = −0.4979.");
        assert_eq!(told("$x = {{= -1/3 : 2}}$, {{= -1/3 : 2}}"), "$x = -0.33$, −0.33");
        assert_eq!(told("$$\nx = {{= -1 : 0}}\n$$\n{{= -0.001 : 1}}"), "$$\nx = -1\n$$\n0.0");
        let code = "```text\n{{= 1 : 1}} [@nobody]\n```";
        assert_eq!(told(code), code);
        let entry = filled(BIBLIOGRAPHY, "- [@a1]: A et al. 1. *Title*.", &Citations::new());
        assert_eq!(entry, "- <a id=\"a1\"></a>**A et al. 1.** *Title*.");
    }

    #[test]
    fn citations_read_as_a_part_of_the_sentence() {
        let all = citations("- [@kay1986]: Kay and Kajiya 1986. *Slabs*.\n- [@appel1968]: Appel 1968. *Shades*.");
        let read = |text: &str| {
            let told = filled("page.md", text, &all);
            told.replace("](bibliography.md#kay1986)", "").replace("](bibliography.md#appel1968)", "").replace('[', "")
        };
        for (text, expected) in [
            ("the *shadow ray* [@appel1968]. It", "the *shadow ray* (Appel 1968). It"),
            ("was Appel's idea [@appel1968];", "was Appel's idea (1968);"),
            ("as Kay and Kajiya do it [@kay1986]", "as Kay and Kajiya do it (1986)"),
            ("- [@appel1968], [@kay1986]: old", "- Appel (1968) and Kay and Kajiya (1986): old"),
            ("- [@kay1986]: slabs", "- Kay and Kajiya (1986): slabs"),
            ("This is what [@kay1986] did", "This is what Kay and Kajiya (1986) did"),
            ("found early [@appel1968], [@kay1986].", "found early (Appel 1968; Kay and Kajiya 1986)."),
            (
                "(compare [@kay1986], page 2, or $f(x$ of [@appel1968])",
                "(compare Kay and Kajiya 1986, page 2, or $f(x$ of Appel 1968)",
            ),
            ("(slabs [@kay1986])", "(slabs, Kay and Kajiya 1986)"),
            ("`f(` is old [@appel1968]", "`f(` is old (Appel 1968)"),
        ] {
            assert_eq!(read(text), expected);
        }
        assert_eq!(filled("page.md", "[@appel1968] [@x]", &all), "[Appel](bibliography.md#appel1968) (1968) [@x]");
    }

    #[test]
    fn what_cannot_be_filled_in_is_told() {
        let text = "{{= 1/0 : 2}} and {{= 2 }}\nand [@nobody1900]";
        let problems = problems(&made_up("page.md", &told(text)));
        let lines: Vec<usize> = problems.iter().map(|problem| problem.line).collect();
        assert_eq!(lines, [1, 1, 2], "{problems:?}");
        assert!(problems[2].what.contains("nobody1900"));
    }
}
