use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

/// Base64 with or without padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true),
);

/// The bytes of a data URI; nothing if it is the name of a file.
///
/// Base64 may have percent escapes, as RFC 2397 allows in any URI, and line breaks.
/// Errors: what it must be.
pub fn data_of(uri: &str) -> Option<Result<Vec<u8>, String>> {
    let uri = uri.trim_ascii_start();
    let data = uri.get(5..).filter(|_| uri[..5].eq_ignore_ascii_case("data:"))?;
    let Some((head, body)) = data.split_once(',') else { return Some(Err("data has a comma before them".into())) };
    if !head.trim_ascii_end().to_ascii_lowercase().ends_with(";base64") {
        return Some(Ok(percent_decoded(body.as_bytes())));
    }
    let is_odd = |byte: &u8| *byte == b'%' || byte.is_ascii_whitespace();
    let decoded = if body.as_bytes().iter().any(is_odd) {
        let mut plain = percent_decoded(body.as_bytes());
        plain.retain(|byte| !byte.is_ascii_whitespace());
        BASE64.decode(plain)
    } else {
        BASE64.decode(body)
    };
    Some(decoded.map_err(|error| format!("its data must be base64: {error}")))
}

/// The file name of a URI: percent signs and the two digits behind them are a byte, and backslashes separate folders, as
/// exporters on Windows write them.
///
/// It is the shortest name of its file, so that `b.bin`, `./b.bin` and `a/../b.bin` are one.
pub fn file_name(uri: &str) -> String {
    let decoded = String::from_utf8_lossy(&percent_decoded(uri.as_bytes())).replace('\\', "/");
    let is_absolute = decoded.starts_with('/');
    if decoded.contains("://") {
        return decoded;
    }
    let mut parts: Vec<&str> = Vec::new();
    for part in decoded.split('/') {
        match (part, parts.last()) {
            ("" | ".", _) => {}
            ("..", Some(last)) if *last != ".." => drop(parts.pop()),
            _ => parts.push(part),
        }
    }
    format!("{}{}", if is_absolute { "/" } else { "" }, parts.join("/"))
}

fn percent_decoded(bytes: &[u8]) -> Vec<u8> {
    let digit = |byte: Option<&u8>| byte.and_then(|byte| char::from(*byte).to_digit(16));
    let mut decoded = Vec::with_capacity(bytes.len());
    let mut rest = bytes;
    while let Some((first, behind)) = rest.split_first() {
        rest = behind;
        match (*first, digit(behind.first()), digit(behind.get(1))) {
            // Two digits of sixteen are a byte.
            (b'%', Some(high), Some(low)) => {
                decoded.push((16 * high + low) as u8);
                rest = &behind[2..];
            }
            _ => decoded.push(*first),
        }
    }
    decoded
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_are_decoded() {
        let data = |uri: &str| data_of(uri).map(|data| data.map_err(|error| error.to_string()));
        assert_eq!(data("data:application/octet-stream;base64,AQID"), Some(Ok(vec![1, 2, 3])));
        assert_eq!(data("data:;base64,AQI="), Some(Ok(vec![1, 2])));
        assert_eq!(data("data:;base64,AQI"), Some(Ok(vec![1, 2])));
        assert_eq!(data("data:text/plain,a%20b%"), Some(Ok(b"a b%".to_vec())));
        assert_eq!(data("data:;base64"), Some(Err("data has a comma before them".into())));
        assert_eq!(data("data:;base64,AQ%49%44"), Some(Ok(vec![1, 2, 3])));
        assert_eq!(data(" DATA:;Base64,AQ\n  I\r\n%3D"), Some(Ok(vec![1, 2])));
        let wrong = data("data:;base64,A*==").expect("data").expect_err("wrong");
        assert!(wrong.starts_with("its data must be base64: "), "{wrong}");
        assert_eq!(data("a.bin"), None);
    }

    #[test]
    fn one_file_has_one_name() {
        for uri in ["b.bin", "./b.bin", ".//b.bin", "a/../b.bin", "a/c/../../b.bin", ".%2Fb.bin", ".\\b.bin"] {
            assert_eq!(file_name(uri), "b.bin", "{uri}");
        }
        assert_eq!(file_name("sub\\a%5Cchk.png"), "sub/a/chk.png");
        assert_eq!([file_name("../b.bin"), file_name("a/../../b.bin")], ["../b.bin"; 2]);
        assert_eq!(file_name("/x//y"), "/x/y");
        assert_eq!(file_name("http://a//b"), "http://a//b");
    }

    #[test]
    fn names_of_files_are_decoded() {
        assert_eq!(file_name("a%20b/%C3%A4.bin"), "a b/ä.bin");
        assert_eq!(file_name("100%.bin"), "100%.bin");
        assert_eq!(file_name("%zz%4"), "%zz%4");
    }
}
