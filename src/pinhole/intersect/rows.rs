use crate::plan::column;
use crate::shapes::Listed;

/// Declares a column of the rows that hit one of several kinds, which its type parameter names.
macro_rules! rows_of_kind {
    ($(#[$doc:meta])* pub struct $rows:ident<$of:ident: $kind:ident>) => {
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $rows<$of> {
            /// Rows of the hits.
            pub row: Vec<u32>,
            of: std::marker::PhantomData<fn() -> $of>,
        }

        impl<$of> Default for $rows<$of> {
            fn default() -> Self {
                Self { row: Vec::new(), of: std::marker::PhantomData }
            }
        }

        // What `column!` writes for a column that is not generic.
        impl<$of: $kind> bevy_ecs::component::Component for $rows<$of> {
            const STORAGE_TYPE: bevy_ecs::component::StorageType = bevy_ecs::component::StorageType::Table;
            type Mutability = bevy_ecs::component::Mutable;

            fn register_required_components(
                _: bevy_ecs::component::ComponentId,
                _: &mut bevy_ecs::component::RequiredComponentsRegistrator<'_, '_>,
            ) {
                $crate::plan::ColumnKind::of::<Self>().remember();
            }
        }

        impl<$of: $kind> $crate::plan::Column for $rows<$of> {
            const NAME: &'static str = $of::NAMES.rows;
            const SPACE: &'static str = "rows of the tile";
            const UNIT: &'static str = "rows";
            const LIFETIME: $crate::plan::Lifetime = $crate::plan::Lifetime::Ray;

            fn rows(&self) -> usize {
                self.row.len()
            }

            fn components(&self) -> Vec<$crate::plan::ColumnComponent<'_>> {
                let values = $crate::plan::ComponentValue::values(&self.row);
                vec![$crate::plan::ColumnComponent { name: "row", values }]
            }

            fn paint(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
                [1.0; 3]
            }
        }
    };
}
pub(crate) use rows_of_kind;

rows_of_kind! {
    /// The rows that hit one kind of shape, ascending.
    pub struct ShapeRows<S: Listed>
}

column! {
    /// The rows whose surface has a non-specular material, which is every material but mirrors and glass; ascending.
    pub struct MaterialRows("material rows", "rows of the tile", "rows", Ray) {
        /// A row of the surfaces.
        row: u32,
    }
}

column! {
    /// The rows whose surface emits light, ascending.
    pub struct EmissiveRows("emissive rows", "rows of the tile", "rows", Ray) {
        /// A row of the hits.
        row: u32,
        /// A row of the table of emissive surfaces.
        emissive: u32,
    }
}

impl EmissiveRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}

impl MaterialRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}
