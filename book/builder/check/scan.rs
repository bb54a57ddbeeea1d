//! A page as lines: which are code, which are prose, and where each fence begins and ends.

/// One line of a page.
#[derive(Debug, Clone, Copy)]
pub struct Line<'a> {
    /// Its number, from 1.
    pub number: usize,
    /// Where its first byte stands in the page.
    pub start: usize,
    /// The line without its line end.
    pub text: &'a str,
    /// Which fence of the page it belongs to, the fence's own two lines included.
    pub fence: Option<usize>,
}

/// One fenced block of code.
#[derive(Debug, Clone)]
pub struct Fence<'a> {
    /// The line that opens it, counted from 0 in [`Scan::lines`].
    pub first: usize,
    /// The line that closes it, or one past the page's end.
    pub last: usize,
    /// The words after the marks, `rust` most often.
    pub info: &'a str,
    /// False when the page ends before the fence does.
    pub closed: bool,
}

/// A page's lines and its fences.
#[derive(Debug, Default)]
pub struct Scan<'a> {
    /// Every line.
    pub lines: Vec<Line<'a>>,
    /// Every fence, in the order they open.
    pub fences: Vec<Fence<'a>>,
}

impl<'a> Scan<'a> {
    /// Walks over a page once.
    pub fn new(text: &'a str) -> Self {
        let mut scan = Self::default();
        let mut start = 0;
        let mut marks: Option<&str> = None;
        for (index, whole) in text.split_inclusive('\n').enumerate() {
            let text = whole.trim_end_matches(['\n', '\r']);
            let here = marks_of(text);
            if let Some(open) = marks {
                scan.push(index, start, text, true);
                let closes = here.is_some_and(|(found, rest)| found.starts_with(open) && rest.is_empty());
                if closes {
                    marks = None;
                    scan.close(index, true);
                }
            } else {
                if let Some((open, info)) = here {
                    marks = Some(open);
                    scan.fences.push(Fence { first: index, last: index, info, closed: false });
                }
                scan.push(index, start, text, here.is_some());
            }
            start += whole.len();
        }
        if marks.is_some() {
            scan.close(scan.lines.len(), false);
        }
        scan
    }

    fn push(&mut self, index: usize, start: usize, text: &'a str, code: bool) {
        let fence = code.then(|| self.fences.len() - 1);
        self.lines.push(Line { number: index + 1, start, text, fence });
    }

    fn close(&mut self, index: usize, closed: bool) {
        if let Some(fence) = self.fences.last_mut() {
            fence.last = index;
            fence.closed = closed;
        }
    }

    /// The lines between a fence's own two.
    pub fn body(&self, fence: &Fence<'_>) -> &[Line<'a>] {
        self.lines.get(fence.first + 1..fence.last).unwrap_or_default()
    }

    /// The lines that are not code.
    pub fn prose(&self) -> impl Iterator<Item = &Line<'a>> {
        self.lines.iter().filter(|line| line.fence.is_none())
    }
}

/// The marks and the words of a line that opens or closes a fence.
fn marks_of(line: &str) -> Option<(&str, &str)> {
    let line = line.trim();
    let mark = line.chars().next().filter(|mark| ['`', '~'].contains(mark))?;
    let length = line.len() - line.trim_start_matches(mark).len();
    let (marks, info) = line.split_at(length);
    let opens = length >= 3 && !(mark == '`' && info.contains('`'));
    opens.then_some((marks, info.trim()))
}

/// The line with its code spans and formulas blanked out, byte for byte, so that what is left is prose.
pub fn blank_spans(line: &str) -> String {
    let mut rest = line;
    let mut prose = String::with_capacity(line.len());
    while let Some(at) = rest.find(['`', '$', '\\']) {
        prose.push_str(&rest[..at]);
        let found = &rest[at..];
        let length = span_length(found);
        prose.extend(std::iter::repeat_n(' ', length));
        rest = &found[length..];
    }
    prose.push_str(rest);
    prose
}

/// How many bytes the span takes that begins here; a mark that nothing closes stands for itself.
fn span_length(text: &str) -> usize {
    if let Some(escaped) = text.strip_prefix('\\') {
        return 1 + escaped.chars().next().map_or(0, char::len_utf8);
    }
    let mark = if text.starts_with('`') { '`' } else { '$' };
    let run = text.len() - text.trim_start_matches(mark).len();
    let (open, inside) = text.split_at(run);
    inside.find(open).map_or(run, |close| run + close + run)
}

/// How many words of prose a line has: tables, formulas, tags and directives are not counted.
pub fn words_of(line: &str) -> usize {
    if line.trim_start().starts_with(['|', '<']) || line.trim_start().starts_with("{{#") {
        return 0;
    }
    let spoken = |word: &&str| word.chars().any(char::is_alphanumeric);
    blank_spans(line).split_whitespace().filter(spoken).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fences_hold_their_lines() {
        let scan = Scan::new("a\n````rust\n```\nb\n````\nc\n");
        let inside: Vec<bool> = scan.lines.iter().map(|line| line.fence.is_some()).collect();
        assert_eq!(inside, [false, true, true, true, true, false]);
        assert_eq!((scan.fences[0].info, scan.body(&scan.fences[0]).len()), ("rust", 2));
        assert!(!Scan::new("```\nopen").fences[0].closed);
    }

    #[test]
    fn spans_are_blanked() {
        assert_eq!(blank_spans("a `b` $c$ \\$ d"), format!("a{}d", " ".repeat(12)));
        assert_eq!(blank_spans("a ` b"), "a   b");
    }

    #[test]
    fn words_are_prose_only() {
        let lines = ["One two – three.", "| a | b |", "{{#pinhole plan}}", "<summary>a</summary>", "`no` $no$"];
        assert_eq!(lines.map(words_of), [3, 0, 0, 0, 0]);
    }
}
