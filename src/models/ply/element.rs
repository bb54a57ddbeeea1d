/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Number {
    /// `char`
    I8,
    /// `uchar`
    U8,
    /// `short`
    I16,
    /// `ushort`
    U16,
    /// `int`
    I32,
    /// `uint`
    U32,
    /// `float`
    F32,
    /// `double`
    F64,
}

impl Number {
    /// The type of this name.
    pub fn named(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    /// Its size in a binary file, in bytes.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// Whether it is a whole number.
    pub fn is_whole(self) -> bool {
        !matches!(self, Self::F32 | Self::F64)
    }
}

/// A property of an element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Property {
    /// Its name.
    pub name: String,
    /// The type of its numbers.
    pub number: Number,
    /// The type of their count, if it is a list.
    pub count: Option<Number>,
}

/// An element: rows of the same properties.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Element {
    /// Its name.
    pub name: String,
    /// The number of its rows.
    pub rows: u64,
    /// The properties of a row.
    pub properties: Vec<Property>,
}

impl Element {
    /// The fewest bytes that a row may have, in binary or as text.
    pub fn least_size(&self, is_text: bool) -> u64 {
        // In text, a number is a digit and a space.
        let size = |property: &Property| {
            if is_text { 2 } else { property.count.unwrap_or(property.number).size() }
        };
        self.properties.iter().map(|property| size(property) as u64).sum()
    }

    /// The place of the first property of one of these names.
    pub fn find(&self, names: &[&str]) -> Option<usize> {
        self.properties.iter().position(|property| names.contains(&&*property.name))
    }

    /// Whether every row has as many bytes in a binary file.
    pub fn is_fixed(&self) -> bool {
        self.properties.iter().all(|property| property.count.is_none())
    }
}
