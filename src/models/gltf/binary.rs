use crate::model_error::ModelError;
use crate::model_error::shown_bytes;

/// The parts of a binary file: its JSON, and its first buffer if it has one.
pub fn binary_parts<'b>(file: &str, bytes: &'b [u8]) -> Result<(&'b [u8], Option<&'b [u8]>), ModelError> {
    let word = |bytes: &[u8], at: usize| {
        let bytes = bytes.get(at..).and_then(|rest| rest.first_chunk());
        bytes.map(|bytes| u32::from_le_bytes(*bytes))
    };
    let refused = |place: &str, value: String, accepted: &str| Err(ModelError::new(file, place, value, accepted));
    match word(bytes, 4) {
        Some(2) => {}
        version => {
            let shown = version.map_or("missing".to_owned(), |version| version.to_string());
            return refused("the version of the binary file", shown, "it must be 2");
        }
    }
    let length = word(bytes, 8).map_or(u64::MAX, u64::from);
    if length > bytes.len() as u64 || length < 12 {
        let place = format!("the length that the file says it has, {length} bytes,");
        return refused(&place, "wrong".into(), &format!("the file has {} bytes", bytes.len()));
    }
    let mut rest = &bytes[12..length as usize];
    let (mut json, mut buffer) = (None, None);
    while !rest.is_empty() && (json.is_none() || buffer.is_none()) {
        let number = if json.is_none() { "first" } else { "next" };
        let (Some(length), Some(kind)) = (word(rest, 0), rest.get(4..8)) else {
            return refused(&format!("the {number} chunk's head"), "missing".into(), "a chunk begins with 8 bytes");
        };
        let Some(chunk) = rest[8..].get(..length as usize) else {
            let accepted = format!("{} bytes are left of the file", rest.len() - 8);
            return refused(&format!("the {number} chunk's length"), length.to_string(), &accepted);
        };
        match (kind, json) {
            (b"JSON", None) => json = Some(chunk),
            (kind, None) => {
                return refused("the first chunk's type", shown_bytes(kind), "it must be \"JSON\"");
            }
            (b"BIN\0", Some(_)) => buffer = Some(chunk),
            // Other chunks are to be passed over.
            _ => {}
        }
        rest = &rest[8 + chunk.len()..];
    }
    match json {
        Some(json) => Ok((json, buffer)),
        None => refused("the first chunk", "missing".into(), "a binary file has a chunk of JSON"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(version: u32, excess: u32, chunks: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
        let mut bytes = b"glTF".to_vec();
        let length = 12 + chunks.iter().map(|(_, chunk)| 8 + chunk.len() as u32).sum::<u32>();
        bytes.extend([version, length + excess].iter().flat_map(|word| word.to_le_bytes()));
        for (kind, chunk) in chunks {
            bytes.extend((chunk.len() as u32).to_le_bytes());
            bytes.extend(*kind);
            bytes.extend(*chunk);
        }
        bytes
    }

    #[test]
    fn the_parts_are_found_among_others() {
        let whole = file(2, 0, &[(b"JSON", b"{}"), (b"XTRA", b"1234"), (b"BIN\0", b"12")]);
        assert_eq!(binary_parts("a.glb", &whole), Ok((&b"{}"[..], Some(&b"12"[..]))));
        assert_eq!(binary_parts("a.glb", &file(2, 0, &[(b"JSON", b"{}")])), Ok((&b"{}"[..], None)));
    }

    #[test]
    fn damaged_containers_are_refused() {
        let refused = |bytes: &[u8]| binary_parts("a.glb", bytes).expect_err("refused").to_string();
        let whole = file(2, 0, &[(b"JSON", b"{}"), (b"BIN\0", b"12")]);
        for length in 4..whole.len() {
            let _ = refused(&whole[..length]);
        }
        let version = "a.glb: the version of the binary file is 1, but it must be 2";
        assert_eq!(refused(&file(1, 0, &[(b"JSON", b"{}")])), version);
        assert_eq!(refused(b"glTF"), "a.glb: the version of the binary file is missing, but it must be 2");
        let length = "a.glb: the length that the file says it has, 23 bytes, is wrong, but the file has 22 bytes";
        assert_eq!(refused(&file(2, 1, &[(b"JSON", b"{}")])), length);
        let kind = "a.glb: the first chunk's type is \"BIN\\u{0}\", but it must be \"JSON\"";
        assert_eq!(refused(&file(2, 0, &[(b"BIN\0", b"{}")])), kind);
        assert_eq!(
            refused(&file(2, 0, &[])),
            "a.glb: the first chunk is missing, but a binary file has a chunk of JSON"
        );
        let mut long = file(2, 0, &[(b"JSON", b"{}")]);
        long[12] = 3;
        assert_eq!(refused(&long), "a.glb: the first chunk's length is 3, but 2 bytes are left of the file");
        let mut short = file(2, 0, &[(b"JSON", b"{}")]);
        short.truncate(18);
        short[8] = 18;
        assert_eq!(refused(&short), "a.glb: the first chunk's head is missing, but a chunk begins with 8 bytes");
    }
}
