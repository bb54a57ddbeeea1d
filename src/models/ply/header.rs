use super::element::{Element, Number, Property};
use crate::model_error::ModelError;
use crate::model_error::shown_bytes;
use crate::number::{whole, words};

/// The greatest number of elements, and of properties of each.
const MAX: usize = 256;

/// How the numbers of a file are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// As text.
    Ascii,
    /// In binary, the lowest byte first.
    LittleEndian,
    /// In binary, the highest byte first.
    BigEndian,
}

/// The header of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Header {
    /// How its numbers are written.
    pub format: Format,
    /// Its elements, in their order.
    pub elements: Vec<Element>,
    /// The image files that comments of the form `TextureFile name` give.
    pub textures: Vec<String>,
}

/// The line at the start of a text, without spaces about it, and what follows; its end may be a line feed, a carriage
/// return, or both.
fn first_line(text: &[u8], by_return: bool) -> Option<(&[u8], &[u8])> {
    let end = text.iter().position(|byte| *byte == if by_return { b'\r' } else { b'\n' })?;
    Some((text[..end].trim_ascii(), &text[end + 1..]))
}

impl Header {
    /// Reads the header, and returns it with the bytes that follow.
    ///
    /// Errors: a line that is not as it should be.
    pub fn read<'b>(file: &str, bytes: &'b [u8]) -> Result<(Self, &'b [u8]), ModelError> {
        let mut rest = bytes;
        let (mut format, mut elements): (Option<Format>, Vec<Element>) = (None, Vec::new());
        let mut textures = Vec::new();
        let end = bytes.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
        let by_return = end.is_some_and(|end| bytes[end] == b'\r' && bytes.get(end + 1) != Some(&b'\n'));
        for number in 1.. {
            let Some((line, behind)) = first_line(rest, by_return) else { break };
            rest = behind;
            let refused =
                |accepted: &str| Err(ModelError::new(file, format_args!("line {number}"), shown_bytes(line), accepted));
            let words: Vec<&[u8]> = words(line).take(6).collect();
            match words[..] {
                [b"ply"] if number == 1 => {}
                [b"comment" | b"obj_info", b"TextureFile", _, ..] => {
                    let name = line.trim_ascii_start().split(u8::is_ascii_whitespace).skip(2).collect::<Vec<_>>();
                    textures.push(text(name.join(&b' ').trim_ascii()));
                }
                [] | [b"comment" | b"obj_info", ..] => {}
                [b"format", name, b"1.0"] => match name {
                    b"ascii" => format = Some(Format::Ascii),
                    b"binary_little_endian" => format = Some(Format::LittleEndian),
                    b"binary_big_endian" => format = Some(Format::BigEndian),
                    _ => {
                        return refused("a format is ascii, binary_little_endian or binary_big_endian");
                    }
                },
                [b"element", name, rows] => {
                    let Some(rows) = whole(rows).and_then(|rows| u64::try_from(rows).ok()) else {
                        return refused("the number of an element's rows is a whole number of at most 18 digits");
                    };
                    let name = text(name);
                    if elements.len() == MAX {
                        return refused("a file has at most 256 elements");
                    }
                    if elements.iter().any(|element| element.name == name) {
                        return refused("each element is there once");
                    }
                    elements.push(Element { name, rows, properties: Vec::new() });
                }
                [b"property", ..] => {
                    let Some(property) = property(&words[1..]) else {
                        return refused(
                            "a property is `property type name` or `property list type type name`, \
                             its types char, uchar, short, ushort, int, uint, float or double, and a list's first a \
                             whole number",
                        );
                    };
                    let Some(element) = elements.last_mut() else { return refused("a property follows an element") };
                    if element.properties.len() == MAX {
                        return refused("an element has at most 256 properties");
                    }
                    if element.properties.iter().any(|own| own.name == property.name) {
                        return refused("each property of an element is there once");
                    }
                    element.properties.push(property);
                }
                [b"end_header"] => {
                    let Some(format) = format else { return refused("a line `format` comes before it") };
                    return Ok((Self { format, elements, textures }, rest));
                }
                _ => {
                    return refused("a line is `format`, `element`, `property`, `comment` or `end_header`");
                }
            }
        }
        Err(ModelError::new(file, "the header's last line", "missing", "a header ends with `end_header`"))
    }
}

fn property(words: &[&[u8]]) -> Option<Property> {
    match *words {
        [b"list", count, number, name] => {
            let count = Number::named(count).filter(|count| count.is_whole())?;
            Some(Property { name: text(name), number: Number::named(number)?, count: Some(count) })
        }
        [number, name] => Some(Property { name: text(name), number: Number::named(number)?, count: None }),
        _ => None,
    }
}

fn text(word: &[u8]) -> String {
    String::from_utf8_lossy(word).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Header, String> {
        let read = Header::read("a.ply", text.as_bytes()).map_err(|error| error.to_string())?;
        assert_eq!(read.1, b"1 2 3");
        Ok(read.0)
    }

    #[test]
    fn a_header_lists_elements_and_their_properties() {
        let text = "ply\r\nformat binary_big_endian 1.0\r\ncomment by hand\n\nobj_info x\nelement vertex 12\n\
                    property float32 x\nproperty  list uint8 int vertex_indices \nelement none 0\nend_header\n1 2 3";
        let header = read(text).expect("read");
        assert_eq!(header.format, Format::BigEndian);
        let names: Vec<_> = header.elements.iter().map(|element| (&*element.name, element.rows)).collect();
        assert_eq!(names, [("vertex", 12), ("none", 0)]);
        let property = |name: &str, number, count| Property { name: name.into(), number, count };
        assert_eq!(
            header.elements[0].properties,
            [property("x", Number::F32, None), property("vertex_indices", Number::I32, Some(Number::U8))]
        );
    }

    #[test]
    fn a_header_s_lines_end_as_on_any_system() {
        let lines = ["ply", "format ascii 1.0 ", "comment TextureFile a b.png", "element vertex 1", "end_header"];
        for end in ["\n", "\r\n", "\r"] {
            let header = read(&format!("{}{end}1 2 3", lines.join(end))).expect("read");
            assert_eq!((header.elements.len(), header.textures), (1, vec!["a b.png".to_owned()]), "{end:?}");
        }
    }

    #[test]
    fn every_other_line_is_refused() {
        let cases = [
            ("format text 1.0", "a format is ascii, binary_little_endian or binary_big_endian"),
            ("format ascii 2.0", "a line is `format`, `element`, `property`, `comment` or `end_header`"),
            ("vertex 3", "a line is `format`, `element`, `property`, `comment` or `end_header`"),
            ("element vertex -1", "the number of an element's rows is a whole number of at most 18 digits"),
            (
                "element vertex 1000000000000000000",
                "the number of an element's rows is a whole number of at most 18 digits",
            ),
            ("property float x", "a property follows an element"),
            ("end_header", "a line `format` comes before it"),
        ];
        for (line, accepted) in cases {
            let expected = format!("a.ply: line 2 is \"{line}\", but {accepted}");
            assert_eq!(read(&format!("ply\n{line}\n")), Err(expected));
        }
        let property = "a property is `property type name` or `property list type type name`, its types char, uchar, \
                        short, ushort, int, uint, float or double, and a list's first a whole number";
        let later = [
            ("element e 2", "each element is there once"),
            ("property int x", "each property of an element is there once"),
            ("property half y", property),
            ("property list float int y", property),
            ("property list int int", property),
            ("property int", property),
            ("property list uchar int y z w", property),
        ];
        for (line, accepted) in later {
            let expected = format!("a.ply: line 4 is \"{line}\", but {accepted}");
            assert_eq!(read(&format!("ply\nelement e 1\nproperty int x\n{line}\n")), Err(expected));
        }
        let many = |line: &str| (0..=256).map(|number| format!("{line}{number} 0\n")).collect::<String>();
        let elements = format!("ply\n{}", many("element a"));
        let expected = "a.ply: line 258 is \"element a256 0\", but a file has at most 256 elements";
        assert_eq!(read(&elements), Err(expected.into()));
        let properties = format!("ply\nelement a 0\n{}", many("property int a").replace(" 0\n", "\n"));
        let expected = "a.ply: line 259 is \"property int a256\", but an element has at most 256 properties";
        assert_eq!(read(&properties), Err(expected.into()));
        let missing = "a.ply: the header's last line is missing, but a header ends with `end_header`";
        assert_eq!(read("ply\nformat ascii 1.0\n"), Err(missing.into()));
        assert_eq!(read("ply"), Err(missing.into()));
    }
}
