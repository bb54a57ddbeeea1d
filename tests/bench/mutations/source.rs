//! As much of Rust's grammar as mutations need: what is code, and where functions begin and end.

use std::ops::Range;

/// A function: its name's place, and the body with its braces.
pub struct Function {
    pub start: usize,
    pub body: Range<usize>,
}

/// The source with comments, strings and characters blanked, byte by byte, up to its unit tests.
pub fn masked(source: &str) -> Vec<u8> {
    let end = source.find("#[cfg(test)]").unwrap_or(source.len());
    let bytes = source.as_bytes();
    let mut out = bytes.to_vec();
    let mut at = 0;
    while at < bytes.len() {
        let from = at;
        if bytes[at..].starts_with(b"//") {
            while at < bytes.len() && bytes[at] != b'\n' {
                at += 1;
            }
        } else if bytes[at] == b'"' {
            let hashes = bytes[..at].iter().rev().take_while(|&&byte| byte == b'#').count();
            let raw = at > hashes && bytes[at - hashes - 1] == b'r';
            let close = [&b"\""[..], &vec![b'#'; hashes]].concat();
            at += 1;
            while at < bytes.len() && !(if raw { bytes[at..].starts_with(&close) } else { bytes[at] == b'"' }) {
                at += if !raw && bytes[at] == b'\\' { 2 } else { 1 };
            }
            at += 1;
        } else if bytes[at] == b'\'' && (bytes.get(at + 1) == Some(&b'\\') || bytes.get(at + 2) == Some(&b'\'')) {
            at += 2;
            while at < bytes.len() && bytes[at] != b'\'' {
                at += 1;
            }
            at += 1;
        } else {
            at += 1;
            continue;
        }
        let to = at.min(bytes.len());
        out[from..to].iter_mut().filter(|byte| **byte != b'\n').for_each(|byte| *byte = b' ');
    }
    out.truncate(end);
    out
}

fn is_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

/// Where the brackets that open at a place are closed.
fn closed(code: &[u8], open: usize) -> Option<usize> {
    let mut depth = 0_i32;
    for (at, byte) in code.iter().enumerate().skip(open) {
        match byte {
            b'{' => depth += 1,
            b'}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some(at + 1);
        }
    }
    None
}

/// The outermost functions that can be given a second body: neither constant nor returning an opaque type.
pub fn functions(code: &[u8]) -> Vec<Function> {
    let mut found = Vec::new();
    let mut at = 0;
    while at + 3 < code.len() {
        if code[at..].starts_with(b"macro_rules!") || code[at..].starts_with(b"column! {") {
            let open = at + code[at..].iter().position(|&byte| byte == b'{').unwrap_or(0);
            at = closed(code, open).unwrap_or(code.len());
            continue;
        }
        if !code[at..].starts_with(b"fn ") || (at > 0 && is_word(code[at - 1])) {
            at += 1;
            continue;
        }
        let Some(open) = code[at..].iter().position(|&byte| byte == b'{' || byte == b';').map(|off| at + off) else {
            break;
        };
        // An array's length, as in `[f64; 3]`, is no end of a declaration.
        let mut open = open;
        while code[open] == b';'
            && code[at..open].iter().filter(|&&b| b == b'[').count()
                > code[at..open].iter().filter(|&&b| b == b']').count()
        {
            match code[open + 1..].iter().position(|&byte| byte == b'{' || byte == b';') {
                Some(off) => open += 1 + off,
                None => return found,
            }
        }
        let signature = String::from_utf8_lossy(&code[at..open]).into_owned();
        let returned = signature.rsplit_once("->").map_or("", |(_, returned)| returned);
        let constant = String::from_utf8_lossy(&code[at.saturating_sub(6)..at]).contains("const ");
        if code[open] == b';' {
            at = open;
            continue;
        }
        let Some(end) = closed(code, open) else { break };
        if !constant && !returned.contains("impl ") {
            found.push(Function { start: at, body: open..end });
        }
        at = end;
    }
    found
}
