use super::buffers::Buffers;
use super::component::{Component, Strided};
use super::document::{Document, Table};
use super::object::Object;
use crate::memory::Memory;
use crate::model_error::ModelError;
use std::fmt;

/// What an accessor is read as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meant {
    /// Indices of vertices.
    Indices,
    /// The times of keys.
    Times,
    /// Numbers, such as weights.
    Scalars,
    /// Pairs of coordinates.
    Pairs,
    /// Vectors.
    Vectors,
    /// Rows of four: quaternions, or the joints of a vertex and their weights.
    Fours,
    /// Matrices, column by column.
    Matrices,
}

impl Meant {
    fn type_name(self) -> &'static str {
        match self {
            Self::Indices | Self::Times | Self::Scalars => "SCALAR",
            Self::Pairs => "VEC2",
            Self::Vectors => "VEC3",
            Self::Fours => "VEC4",
            Self::Matrices => "MAT4",
        }
    }

    fn parts(self) -> usize {
        match self {
            Self::Indices | Self::Times | Self::Scalars => 1,
            Self::Pairs => 2,
            Self::Vectors => 3,
            Self::Fours => 4,
            Self::Matrices => 16,
        }
    }

    fn accepts(self, component: Component) -> bool {
        match self {
            Self::Indices => matches!(component, Component::U8 | Component::U16 | Component::U32),
            Self::Scalars | Self::Pairs | Self::Vectors | Self::Fours => component != Component::U32,
            Self::Times | Self::Matrices => component == Component::F32,
        }
    }
}

/// Rows of numbers, all of them within their buffer.
pub struct Accessor<'a> {
    /// Its path, for messages.
    object: Object<'a>,
    /// The number of rows.
    pub count: u64,
    /// The rows, if they are not all zero but for the sparse ones.
    dense: Option<Strided<'a>>,
    /// Rows that stand in place of others, and which.
    sparse: Option<(Strided<'a>, Strided<'a>, u64)>,
}

impl<'a> Accessor<'a> {
    /// The accessor of an index.
    ///
    /// Errors: it is beyond its view, or is not what it is read as.
    pub fn of(
        document: &Document<'a>,
        buffers: &'a Buffers<'a>,
        index: usize,
        meant: Meant,
    ) -> Result<Self, ModelError> {
        let object = document.row(Table::Accessors, index)?;
        let kind = object.needed("type", object.text("type")?)?;
        if kind != meant.type_name() {
            let shown = crate::model_error::shown(kind);
            let accepted = format!("it is used as {}", meant.type_name());
            return Err(object.refused("type", shown, accepted));
        }
        let component = component(&object, |component| meant.accepts(component))?;
        let count = object.needed("count", object.whole("count")?)?;
        let normalized = object.flag("normalized")?;
        let size = meant.parts() * component.size();
        let place = Rows { document, buffers, holder: &object, count, size, component, normalized };
        let dense = if object.get("bufferView").is_some() { Some(place.find(true)?) } else { None };
        let sparse = match object.object("sparse")? {
            None => None,
            Some(sparse) => {
                let rows = sparse.needed("count", sparse.whole("count")?)?;
                let indices = sparse.needed("indices", sparse.object("indices")?)?;
                let values = sparse.needed("values", sparse.object("values")?)?;
                let index_type = self::component(&indices, |component| Meant::Indices.accepts(component))?;
                let place = Rows { holder: &values, count: rows, ..place };
                let found = place.find(false)?;
                let size = index_type.size();
                let place = Rows { holder: &indices, size, component: index_type, normalized: false, ..place };
                Some((place.find(false)?, found, rows))
            }
        };
        Ok(Self { object, count, dense, sparse })
    }

    /// Checks that there is a row for each vertex of a mesh.
    ///
    /// Errors: there are more or fewer.
    pub fn check_count(&self, vertices: u64) -> Result<(), ModelError> {
        if self.count == vertices {
            return Ok(());
        }
        Err(self.refused_count(format_args!("the mesh has {vertices} positions")))
    }

    /// The error of its number of rows.
    pub fn refused_count(&self, accepted: impl fmt::Display) -> ModelError {
        self.object.refused("count", self.count, accepted)
    }

    /// The rows of these indices in ascending order, or all; each of N numbers.
    ///
    /// Errors: they would take too much memory, or a sparse row stands in place of none.
    pub fn floats<const N: usize>(
        &self,
        wanted: Option<&[u32]>,
        memory: &mut Memory,
    ) -> Result<Vec<[f32; N]>, ModelError> {
        let rows = wanted.map_or(self.count, |wanted| wanted.len() as u64);
        self.take(rows, size_of::<[f32; N]>(), memory)?;
        let mut floats = match (&self.dense, wanted) {
            (None, _) => vec![[0.0; N]; rows as usize],
            (Some(dense), None) => dense.floats(0..rows as usize),
            (Some(dense), Some(wanted)) => dense.floats(wanted.iter().map(|row| *row as usize)),
        };
        for (place, value) in self.sparse_rows(memory)? {
            let place = match wanted {
                Some(wanted) => wanted.binary_search(&place).ok(),
                None => Some(place as usize),
            };
            if let (Some(row), Some((_, values, _))) = (place.and_then(|place| floats.get_mut(place)), &self.sparse) {
                *row = values.floats(std::iter::once(value))[0];
            }
        }
        Ok(floats)
    }

    /// All rows as indices.
    ///
    /// Errors: the same.
    pub fn indices(&self, memory: &mut Memory) -> Result<Vec<u32>, ModelError> {
        self.take(self.count, size_of::<u32>(), memory)?;
        let mut indices = match &self.dense {
            None => vec![0; self.count as usize],
            Some(dense) => dense.indices(0..self.count as usize),
        };
        for (place, value) in self.sparse_rows(memory)? {
            if let (Some(row), Some((_, values, _))) = (indices.get_mut(place as usize), &self.sparse) {
                *row = values.indices(std::iter::once(value))[0];
            }
        }
        Ok(indices)
    }

    /// The row that each sparse row stands in place of.
    fn sparse_rows(&self, memory: &mut Memory) -> Result<impl Iterator<Item = (u32, usize)> + use<>, ModelError> {
        let places = match &self.sparse {
            None => Vec::new(),
            Some((places, _, rows)) => {
                self.take(*rows, size_of::<u32>(), memory)?;
                places.indices(0..*rows as usize)
            }
        };
        if let Some(place) = places.iter().find(|place| u64::from(**place) >= self.count) {
            let accepted = format!("the accessor has {} rows", self.count);
            return Err(self.object.refused("sparse.indices' row", place, accepted));
        }
        Ok(places.into_iter().enumerate().map(|(value, place)| (place, value)))
    }

    fn take(&self, rows: u64, size: usize, memory: &mut Memory) -> Result<(), ModelError> {
        memory.take(rows, size as u64, || [self.object.file.into(), self.object.path.clone()])
    }
}

fn component(object: &Object<'_>, accepts: impl Fn(Component) -> bool) -> Result<Component, ModelError> {
    let code = object.needed("componentType", object.whole("componentType")?)?;
    let accepted = "positions, normals and texture coordinates may be 5120, 5121, 5122, 5123 or 5126, \
                    indices 5121, 5123 or 5125, and matrices and times 5126";
    Component::of(code)
        .filter(|component| accepts(*component))
        .ok_or_else(|| object.refused("componentType", code, accepted))
}

/// Rows of an accessor, to be found in its view.
struct Rows<'r, 'a> {
    document: &'r Document<'a>,
    buffers: &'a Buffers<'a>,
    /// The object that names the view.
    holder: &'r Object<'a>,
    count: u64,
    size: usize,
    component: Component,
    normalized: bool,
}

impl<'a> Rows<'_, 'a> {
    /// The rows' bytes.
    ///
    /// Errors: they go beyond the view.
    fn find(&self, may_stride: bool) -> Result<Strided<'a>, ModelError> {
        let Self { document, holder, count, size, .. } = *self;
        let view = holder.needed("bufferView", document.refer(holder, "bufferView", Table::Views)?)?;
        let bytes = self.buffers.view(document, &view)?;
        let offset = holder.whole("byteOffset")?.unwrap_or(0);
        let stride = view.whole("byteStride")?.filter(|_| may_stride).unwrap_or(size as u64);
        if stride < size as u64 {
            return Err(view.refused("byteStride", stride, format_args!("a row has {size} bytes")));
        }
        // The last row need not be followed by the gap that is between two.
        let end = count.checked_sub(1).map_or(Some(0), |rows| rows.checked_mul(stride)?.checked_add(size as u64));
        let end = end.and_then(|length| length.checked_add(offset));
        if end.is_none_or(|end| end > bytes.len() as u64) {
            let length = bytes.len();
            let accepted = format!(
                "its view has {length} bytes, of which it begins at {offset} and takes {size} a row, from one to the \
                 next {stride}"
            );
            return Err(holder.refused("count", count, accepted));
        }
        let bytes = &bytes[offset as usize..];
        Ok(Strided { bytes, stride: stride as usize, component: self.component, normalized: self.normalized })
    }
}

#[cfg(test)]
mod tests {
    use crate::written::{data, floats, read, refused};

    /// A file whose positions are this accessor, on a buffer of three positions, two others and two indices.
    fn with(accessor: &str, view: &str) -> String {
        let mut bytes = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 5.0, 0.0, 0.0, 7.0, 7.0, 0.0]);
        bytes.extend([1, 0, 2, 0]);
        format!(
            "'buffers':[{{'byteLength':64,'uri':'{}'}}],'bufferViews':[{{'buffer':0,{view}}},\
             {{'buffer':0,'byteOffset':36,'byteLength':24}},{{'buffer':0,'byteOffset':60,'byteLength':4}}],\
             'accessors':[{{{accessor}}}],'meshes':[{{'primitives':[{{'attributes':{{'POSITION':0}}}}]}}]",
            data(&bytes)
        )
    }

    const VIEW: &str = "'byteLength':36";
    const POSITIONS: &str = "'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'";

    fn positions(accessor: &str, view: &str) -> Vec<[f32; 3]> {
        read(&with(accessor, view)).expect("read").meshes[0].positions.clone()
    }

    #[test]
    fn rows_are_read_from_their_view() {
        assert_eq!(positions(POSITIONS, VIEW), [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        // From the second position on, and with gaps: the last row needs none behind it.
        let later = format!("{POSITIONS},'byteOffset':12");
        assert_eq!(positions(&later, "'byteLength':48"), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [5.0, 0.0, 0.0]]);
        let strided = positions(POSITIONS, "'byteLength':60,'byteStride':24");
        assert_eq!(strided, [[0.0; 3], [0.0, 1.0, 0.0], [7.0, 7.0, 0.0]]);
    }

    #[test]
    fn sparse_rows_stand_in_place_of_others() {
        let sparse = "'sparse':{'count':2,'indices':{'bufferView':2,'componentType':5123},'values':{'bufferView':1}}";
        let expected = [[0.0; 3], [5.0, 0.0, 0.0], [7.0, 7.0, 0.0]];
        assert_eq!(positions(&format!("{POSITIONS},{sparse}"), VIEW), expected);
        // Without a view, all others are zero.
        let alone = format!("'componentType':5126,'count':3,'type':'VEC3',{sparse}");
        assert_eq!(positions(&alone, VIEW), expected);
        let beyond = format!("'componentType':5126,'count':2,'type':'VEC3',{sparse}");
        let expected = "accessors[0].sparse.indices' row is 2, but the accessor has 2 rows";
        assert_eq!(refused(&with(&beyond, VIEW)), expected);
        let many = format!("{POSITIONS},{}", sparse.replace("'count':2", "'count':3"));
        let expected = "accessors[0].sparse.values.count is 3, but its view has 24 bytes, of which it begins at 0 and \
                        takes \
                        12 a row, from one to the next 12";
        assert_eq!(refused(&with(&many, VIEW)), expected);
        let floats = format!("{POSITIONS},{}", sparse.replace("5123", "5126"));
        assert!(refused(&with(&floats, VIEW)).starts_with("accessors[0].sparse.indices.componentType is 5126, but "));
    }

    #[test]
    fn rows_beyond_their_view_are_refused_before_there_is_memory_for_them() {
        let counted = |count: &str| refused(&with(&POSITIONS.replace("'count':3", &format!("'count':{count}")), VIEW));
        for count in ["4", "1000000000000", "9007199254740992"] {
            let expected = format!(
                "accessors[0].count is {count}, but its view has 36 bytes, of which it begins at 0 and takes 12 a row, \
                 from one to the next 12"
            );
            assert_eq!(counted(count), expected);
        }
        let whole = "but it must be a whole number from 0 to 2⁵³";
        assert_eq!(counted("1e16"), format!("accessors[0].count is 1e16, {whole}"));
        assert_eq!(counted("-1"), format!("accessors[0].count is -1, {whole}"));
        let zeros = |count: &str| refused(&with(&format!("'componentType':5126,'count':{count},'type':'VEC3'"), VIEW));
        let many = "accessors[0].count is 1000000000000, but a mesh may have 4294967295 vertices";
        assert_eq!(zeros("1000000000000"), many);
        assert!(
            zeros("4000000000").contains("the model would take 16000000000 bytes with it"),
            "{}",
            zeros("4000000000")
        );
        let stride = refused(&with(POSITIONS, "'byteLength':36,'byteStride':8"));
        assert_eq!(stride, "bufferViews[0].byteStride is 8, but a row has 12 bytes");
        assert!(
            read(&with(&POSITIONS.replace("'count':3", "'count':0"), VIEW)).is_ok_and(|model| model.meshes.is_empty())
        );
    }

    #[test]
    fn other_types_are_refused() {
        let kind = refused(&with(&POSITIONS.replace("VEC3", "VEC4"), VIEW));
        assert_eq!(kind, "accessors[0].type is \"VEC4\", but it is used as VEC3");
        let accepted = "positions, normals and texture coordinates may be 5120, 5121, 5122, 5123 or 5126, indices \
                        5121, 5123 or 5125, and matrices and times 5126";
        for code in ["5124", "5125"] {
            let component = refused(&with(&POSITIONS.replace("5126", code), VIEW));
            assert_eq!(component, format!("accessors[0].componentType is {code}, but {accepted}"));
        }
        let none = refused(&with("'bufferView':9,'componentType':5126,'count':3,'type':'VEC3'", VIEW));
        assert_eq!(none, "accessors[0].bufferView is 9, but it must be a whole number from 0 to 2, for there are 3");
    }
}
