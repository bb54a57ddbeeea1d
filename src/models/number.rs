//! Words of a text file → numbers.

/// A file without the byte order mark that some editors put before a text.
pub fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// The words of a line.
pub fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// A decimal number; it may be infinite or NaN, also as C's libraries print it, such as `-nan(ind)` or `1.#QNAN`.
pub fn float(word: &[u8]) -> Option<f32> {
    std::str::from_utf8(word).ok()?.parse().ok().or_else(|| Some(not_a_number(word)? as f32))
}

/// The same in f64.
pub fn double(word: &[u8]) -> Option<f64> {
    std::str::from_utf8(word).ok()?.parse().ok().or_else(|| not_a_number(word))
}

#[cold]
fn not_a_number(word: &[u8]) -> Option<f64> {
    let word = word.to_ascii_lowercase();
    let word = word.strip_prefix(b"-").or_else(|| word.strip_prefix(b"+")).unwrap_or(&word);
    if word.starts_with(b"1.#inf") || word.starts_with(b"inf") {
        return Some(f64::INFINITY);
    }
    (word.starts_with(b"nan") || word.starts_with(b"1.#")).then_some(f64::NAN)
}

/// A decimal number that is finite.
pub fn finite(word: &[u8]) -> Option<f64> {
    let number: f64 = std::str::from_utf8(word).ok()?.parse().ok()?;
    number.is_finite().then_some(number)
}

/// A whole number, with or without a sign.
pub fn whole(word: &[u8]) -> Option<i64> {
    let digits = word.strip_prefix(b"-").or_else(|| word.strip_prefix(b"+")).unwrap_or(word);
    // Eighteen digits cannot overflow.
    if digits.is_empty() || digits.len() > 18 {
        return None;
    }
    let mut number = 0;
    for digit in digits {
        if !digit.is_ascii_digit() {
            return None;
        }
        number = 10 * number + i64::from(digit - b'0');
    }
    Some(if word[0] == b'-' { -number } else { number })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_what_stands_between_spaces() {
        assert_eq!(words(b"  f\t1/2/3  -4 \r").collect::<Vec<_>>(), [&b"f"[..], b"1/2/3", b"-4"]);
        assert_eq!(words(b" \t").count(), 0);
    }

    #[test]
    fn whole_numbers_have_a_sign_or_none() {
        assert_eq!([&b"12"[..], b"-7", b"+3", b"0"].map(whole), [Some(12), Some(-7), Some(3), Some(0)]);
        assert_eq!(whole(b"999999999999999999"), Some(999_999_999_999_999_999));
        for word in ["", "-", "+", "1.0", "1e3", "--1", "1000000000000000000", "x", "1x"] {
            assert_eq!(whole(word.as_bytes()), None, "{word}");
        }
    }

    #[test]
    fn numbers_may_be_infinite_only_where_that_is_counted() {
        assert_eq!([&b"1.5"[..], b"-2e-3", b".5", b"1."].map(float), [Some(1.5), Some(-2e-3), Some(0.5), Some(1.0)]);
        assert_eq!(float(b"1e99"), Some(f32::INFINITY));
        assert!(float(b"nan").is_some_and(f32::is_nan));
        for word in ["-nan", "-nan(ind)", "1.#QNAN", "-1.#IND", "NaN"] {
            assert!(float(word.as_bytes()).is_some_and(f32::is_nan), "{word}");
            assert!(double(word.as_bytes()).is_some_and(f64::is_nan), "{word}");
        }
        assert_eq!(
            ["1.#INF", "-inf", "Infinity"].map(|word| double(word.as_bytes()).map(f64::abs)),
            [Some(f64::INFINITY); 3]
        );
        assert_eq!(double(b"499000.1"), Some(499_000.1));
        assert_eq!([&b"1e999"[..], b"nan", b"x", b"\xff", b""].map(finite), [None; 5]);
        assert_eq!(finite(b"1e99"), Some(1e99));
    }
}
