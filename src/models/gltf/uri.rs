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
/// Errors: what it must be.
pub fn data_of(uri: &str) -> Option<Result<Vec<u8>, String>> {
    let data = uri.strip_prefix("data:")?;
    let Some((head, body)) = data.split_once(',') else { return Some(Err("data has a comma before them".into())) };
    if !head.ends_with(";base64") {
        return Some(Ok(percent_decoded(body.as_bytes())));
    }
    Some(BASE64.decode(body).map_err(|error| format!("its data must be base64: {error}")))
}

/// The file name of a URI: percent signs and the two digits behind them are a byte.
pub fn file_name(uri: &str) -> String {
    String::from_utf8_lossy(&percent_decoded(uri.as_bytes())).into_owned()
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
        let wrong = data("data:;base64,A*==").expect("data").expect_err("wrong");
        assert!(wrong.starts_with("its data must be base64: "), "{wrong}");
        assert_eq!(data("a.bin"), None);
    }

    #[test]
    fn names_of_files_are_decoded() {
        assert_eq!(file_name("a%20b/%C3%A4.bin"), "a b/ä.bin");
        assert_eq!(file_name("100%.bin"), "100%.bin");
        assert_eq!(file_name("%zz%4"), "%zz%4");
    }
}
