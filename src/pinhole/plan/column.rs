use super::TileSystems;
use crate::each::{set_all, set_length};
use bevy_ecs::prelude::*;
use bevy_ecs::world::{EntityRef, EntityWorldMut};
use glam::{DVec2, DVec3, Vec3};
use serde::Serialize;
use std::any::TypeId;
use std::fmt;
use std::ops::{AddAssign, MulAssign};

/// How long a row of a column remains valid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Lifetime {
    /// One sample of one pixel: written at the first bounce and kept until the film.
    Pixel,
    /// One path: updated at each bounce, and kept until the path ends.
    Path,
    /// One ray: overwritten at each bounce.
    Ray,
    /// All samples of one pixel: accumulated until the picture is done.
    ///
    /// Columns of this lifetime are what a render is for, so a stage that writes one needs no reader.
    Film,
}

/// The values of one component of a column, borrowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ComponentValues<'a> {
    /// 64-bit floats.
    F64(&'a [f64]),
    /// 32-bit floats.
    F32(&'a [f32]),
    /// Counts and indices; `u32::MAX` stands for "none".
    U32(&'a [u32]),
}

impl ComponentValues<'_> {
    /// The value in a row.
    pub fn number(&self, row: usize) -> ComponentNumber {
        match self {
            Self::F64(values) => ComponentNumber::F64(values[row]),
            Self::F32(values) => ComponentNumber::F32(values[row]),
            Self::U32(values) => ComponentNumber::U32((values[row] != u32::MAX).then_some(values[row])),
        }
    }

    /// The bits of the value in a row, for digests.
    pub fn bits(&self, row: usize) -> u64 {
        match self {
            Self::F64(values) => values[row].to_bits(),
            Self::F32(values) => u64::from(values[row].to_bits()),
            Self::U32(values) => u64::from(values[row]),
        }
    }

    /// Bytes of this component per row.
    pub fn bytes_per_row(&self) -> usize {
        match self {
            Self::F64(_) => 8,
            Self::F32(_) | Self::U32(_) => 4,
        }
    }
}

/// The value of a component in one row; JSON shows all of its digits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ComponentNumber {
    /// A 64-bit float.
    F64(f64),
    /// A 32-bit float.
    F32(f32),
    /// A count or an index, or none.
    U32(Option<u32>),
}

/// A form for people to read: fixed decimals, so that two runs compare line by line.
impl fmt::Display for ComponentNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = match *self {
            Self::F64(value) => value,
            Self::F32(value) => f64::from(value),
            Self::U32(None) => return f.write_str("none"),
            Self::U32(Some(value)) => return write!(f, "{value}"),
        };
        let size = value.abs();
        if value != 0.0 && size.is_finite() && !(1e-4..1e7).contains(&size) {
            write!(f, "{value:+.6e}")
        } else {
            write!(f, "{value:+.6}")
        }
    }
}

/// A number type of components.
pub trait ComponentValue: Copy + Default {
    /// Wraps a slice of values.
    fn values(slice: &[Self]) -> ComponentValues<'_>;
}

impl ComponentValue for f64 {
    fn values(slice: &[Self]) -> ComponentValues<'_> {
        ComponentValues::F64(slice)
    }
}

impl ComponentValue for f32 {
    fn values(slice: &[Self]) -> ComponentValues<'_> {
        ComponentValues::F32(slice)
    }
}

impl ComponentValue for u32 {
    fn values(slice: &[Self]) -> ComponentValues<'_> {
        ComponentValues::U32(slice)
    }
}

/// A named component of a column, such as x or r.
#[derive(Clone, Copy, Debug)]
pub struct ColumnComponent<'a> {
    /// The field's name.
    pub name: &'static str,
    /// Its values, one per row.
    pub values: ComponentValues<'a>,
}

/// The data that a stage writes for the rows of a tile: a component of the tile's entity, with one array per number.
///
/// The type of a column determines its space, so a system's signature says what it reads and writes.
pub trait Column: Component<Mutability = bevy_ecs::component::Mutable> + Default {
    /// The name that `--view`, `trace` and the plan use.
    const NAME: &'static str;
    /// The space of its rows, in words.
    const SPACE: &'static str;
    /// The unit of its components.
    const UNIT: &'static str;
    /// How long its rows remain valid.
    const LIFETIME: Lifetime;
    /// The set whose stages begin it, where stages of later sets update it in place.
    ///
    /// None for a column that every stage which writes it writes as a whole.
    const BEGUN: Option<TileSystems> = None;

    /// The number of rows.
    fn rows(&self) -> usize;
    /// Its components in order.
    fn components(&self) -> Vec<ColumnComponent<'_>>;
    /// A row as a colour to be displayed as it is, from 0 (black) to 1, for an image of `size` pixels.
    fn paint(&self, row: usize, size: [u32; 2]) -> [f32; 3];
}

/// Makes a type a component whose columns the plan knows as soon as bevy registers it in any world.
///
/// [`column!`](crate::column) uses it; columns that are written out by hand use it beside their type.
#[doc(hidden)]
#[macro_export]
macro_rules! column_component {
    ($column:ty) => {
        impl bevy_ecs::component::Component for $column {
            const STORAGE_TYPE: bevy_ecs::component::StorageType = bevy_ecs::component::StorageType::Table;
            type Mutability = bevy_ecs::component::Mutable;

            fn register_required_components(
                _: bevy_ecs::component::ComponentId,
                _: &mut bevy_ecs::component::RequiredComponentsRegistrator<'_, '_>,
            ) {
                $crate::plan::ColumnKind::of::<Self>().remember();
            }
        }
    };
}
pub use column_component;

/// A type of a column's values: a number, or a vector or colour, each of whose parts has an array of its own.
pub trait ColumnValue: Copy {
    /// The arrays that hold the values.
    type Arrays: ColumnArrays;
    /// The value of a row.
    fn read(arrays: &Self::Arrays, row: usize) -> Self;
}

/// One array, or one a part, of the same length.
pub trait ColumnArrays {
    /// The arrays, borrowed.
    type Slices<'a>
    where
        Self: 'a;
    /// The arrays, borrowed to be written.
    type SlicesMut<'a>
    where
        Self: 'a;
    /// The number of rows.
    fn rows(&self) -> usize;
    /// Their first rows.
    fn slices(&self, rows: usize) -> Self::Slices<'_>;
    /// All of them, made as long as `rows`; new ones are 0.
    fn slices_mut(&mut self, rows: usize) -> Self::SlicesMut<'_>;
    /// Removes all rows but keeps the memory.
    fn clear(&mut self);
    /// Lists the arrays under these names.
    fn list<'a>(&'a self, names: &[&'static str], listed: &mut Vec<ColumnComponent<'a>>);
}

impl<T: ComponentValue> ColumnArrays for Vec<T> {
    type Slices<'a>
        = &'a [T]
    where
        T: 'a;
    type SlicesMut<'a>
        = &'a mut [T]
    where
        T: 'a;

    #[inline(always)]
    fn rows(&self) -> usize {
        self.len()
    }

    #[inline(always)]
    fn slices(&self, rows: usize) -> &[T] {
        &self[..rows]
    }

    #[inline(always)]
    fn slices_mut(&mut self, rows: usize) -> &mut [T] {
        if self.len() != rows {
            set_length(self, rows, T::default);
        }
        &mut self[..rows]
    }

    fn clear(&mut self) {
        self.clear();
    }

    fn list<'a>(&'a self, names: &[&'static str], listed: &mut Vec<ColumnComponent<'a>>) {
        listed.push(ColumnComponent { name: names[0], values: T::values(self) });
    }
}

/// The rows of vectors or colours that are kept as one array a part.
pub trait VectorRows<T, const N: usize> {
    /// The parts of a row.
    fn at(&self, row: usize) -> [T; N];
}

/// The same, to be written.
pub trait VectorRowsMut<T, const N: usize> {
    /// Replaces the parts of a row.
    fn put(&mut self, row: usize, value: impl Into<[T; N]>);
    /// Replaces the parts of all rows.
    fn set_all(&mut self, value: [T; N]);
    /// Replaces all rows by the first ones of others.
    fn copy_from(&mut self, other: &[Vec<T>; N]);
    /// Adds to a row, part by part.
    fn add(&mut self, row: usize, value: [T; N])
    where
        T: AddAssign;
    /// Multiplies a row, part by part.
    fn scale(&mut self, row: usize, by: [T; N])
    where
        T: MulAssign;
}

/// What holds of vectors of so many parts, written out: a closure for each would be compiled for each.
macro_rules! vectors_of {
    ($count:literal: $($part:ident $place:tt)+) => {
        impl<T: ComponentValue> ColumnArrays for [Vec<T>; $count] {
            type Slices<'a> = [&'a [T]; $count] where T: 'a;
            type SlicesMut<'a> = [&'a mut [T]; $count] where T: 'a;

            #[inline(always)]
            fn rows(&self) -> usize {
                self[0].len()
            }

            #[inline(always)]
            fn slices(&self, rows: usize) -> [&[T]; $count] {
                [$(&self[$place][..rows]),+]
            }

            #[inline(always)]
            fn slices_mut(&mut self, rows: usize) -> [&mut [T]; $count] {
                let [$($part),+] = self;
                [$($part.slices_mut(rows)),+]
            }

            fn clear(&mut self) {
                $(self[$place].clear();)+
            }

            fn list<'a>(&'a self, names: &[&'static str], listed: &mut Vec<ColumnComponent<'a>>) {
                $(self[$place].list(&names[$place..], listed);)+
            }
        }

        impl<T: Copy, A: AsRef<[T]>> VectorRows<T, $count> for [A; $count] {
            #[inline(always)]
            fn at(&self, row: usize) -> [T; $count] {
                [$(self[$place].as_ref()[row]),+]
            }
        }

        impl<T: Copy, A: AsMut<[T]>> VectorRowsMut<T, $count> for [A; $count] {
            #[inline(always)]
            fn put(&mut self, row: usize, value: impl Into<[T; $count]>) {
                let value = value.into();
                $(self[$place].as_mut()[row] = value[$place];)+
            }

            #[inline(always)]
            fn set_all(&mut self, value: [T; $count]) {
                $(set_all(self[$place].as_mut(), value[$place]);)+
            }

            #[inline(always)]
            fn copy_from(&mut self, other: &[Vec<T>; $count]) {
                $({
                    let to = self[$place].as_mut();
                    to.copy_from_slice(&other[$place][..to.len()]);
                })+
            }

            #[inline(always)]
            fn add(&mut self, row: usize, value: [T; $count])
            where
                T: AddAssign,
            {
                $(self[$place].as_mut()[row] += value[$place];)+
            }

            #[inline(always)]
            fn scale(&mut self, row: usize, by: [T; $count])
            where
                T: MulAssign,
            {
                $(self[$place].as_mut()[row] *= by[$place];)+
            }
        }
    };
}
vectors_of!(2: x 0 y 1);
vectors_of!(3: x 0 y 1 z 2);
vectors_of!(4: x 0 y 1 z 2 w 3);

macro_rules! numbers {
    ($($number:ty)+) => {$(
        impl ColumnValue for $number {
            type Arrays = Vec<$number>;

            #[inline(always)]
            fn read(arrays: &Vec<$number>, row: usize) -> Self {
                arrays[row]
            }
        }
    )+};
}
numbers!(f32 f64 u32);

macro_rules! vectors {
    ($($vector:ty: [$number:ty; $count:literal],)+) => {$(
        impl ColumnValue for $vector {
            type Arrays = [Vec<$number>; $count];

            #[inline(always)]
            fn read(arrays: &[Vec<$number>; $count], row: usize) -> Self {
                Self::from(arrays.at(row))
            }
        }
    )+};
}
vectors! {
    DVec2: [f64; 2],
    [f64; 2]: [f64; 2],
    Vec3: [f32; 3],
    DVec3: [f64; 3],
    [f32; 3]: [f32; 3],
    [f64; 3]: [f64; 3],
    [u32; 4]: [u32; 4],
}

/// The names of a field's parts: its own name for a number.
#[doc(hidden)]
#[macro_export]
macro_rules! part_names {
    ($component:ident) => {
        &[stringify!($component)]
    };
    ($component:ident $($part:ident)+) => {
        &[$(stringify!($part)),+]
    };
}
pub use part_names;

/// Declares a column: its documentation, its name, space, unit and lifetime, and its components.
///
/// The lifetime may be followed by `begun in` and the set whose stages begin the column; see
/// [`Column::BEGUN`](crate::plan::Column::BEGUN).
/// A component is a number, or a vector or colour with the names that `trace` shows of its parts:
/// `origin: Vec3 as [ox, oy, oz]`.
///
/// The struct gets one `Vec` per number, and for each component the value of a row under the component's name;
/// `slices` and `slices_mut` give the arrays of all components at one length, those of a vector as one array of slices.
/// The column implements [`Column`](crate::plan::Column); a row is painted by the type's own `paint_row`.
#[macro_export]
macro_rules! column {
    ($(#[$doc:meta])* pub struct $column:ident(
        $name:literal, $space:literal, $unit:literal, $lifetime:ident $(, begun in $begun:ident)?
    ) {
        $($(#[$component_doc:meta])* $component:ident: $value:ty $(as [$($part:ident),+])?,)+
    }) => {
        $(#[$doc])*
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct $column {
            $($(#[$component_doc])* pub $component: <$value as $crate::plan::ColumnValue>::Arrays,)+
        }

        #[allow(dead_code, unused_parens)]
        impl $column {
            $($(#[$component_doc])*
            #[inline(always)]
            pub fn $component(&self, row: usize) -> $value {
                <$value as $crate::plan::ColumnValue>::read(&self.$component, row)
            })+

            /// All components, in order, at one length.
            #[inline(always)]
            pub fn slices(
                &self,
            ) -> ($(<<$value as $crate::plan::ColumnValue>::Arrays as $crate::plan::ColumnArrays>::Slices<'_>),+) {
                let rows = $crate::plan::Column::rows(self);
                ($($crate::plan::ColumnArrays::slices(&self.$component, rows)),+)
            }

            /// All components, in order, resized to `rows`.
            #[inline(always)]
            pub fn slices_mut(
                &mut self,
                rows: usize,
            ) -> ($(<<$value as $crate::plan::ColumnValue>::Arrays as $crate::plan::ColumnArrays>::SlicesMut<'_>),+) {
                ($($crate::plan::ColumnArrays::slices_mut(&mut self.$component, rows)),+)
            }

            /// Removes all rows but keeps the memory.
            pub fn clear(&mut self) {
                $($crate::plan::ColumnArrays::clear(&mut self.$component);)+
            }
        }

        $crate::column_component!($column);

        impl $crate::plan::Column for $column {
            const NAME: &'static str = $name;
            const SPACE: &'static str = $space;
            const UNIT: &'static str = $unit;
            const LIFETIME: $crate::plan::Lifetime = $crate::plan::Lifetime::$lifetime;
            $(const BEGUN: Option<$crate::plan::TileSystems> = Some($crate::plan::TileSystems::$begun);)?

            fn rows(&self) -> usize {
                [$($crate::plan::ColumnArrays::rows(&self.$component)),+][0]
            }

            fn components(&self) -> Vec<$crate::plan::ColumnComponent<'_>> {
                let mut listed = Vec::new();
                $($crate::plan::ColumnArrays::list(
                    &self.$component,
                    $crate::part_names!($component $($($part)+)?),
                    &mut listed,
                );)+
                listed
            }

            fn paint(&self, row: usize, size: [u32; 2]) -> [f32; 3] {
                self.paint_row(row, size)
            }
        }
    };
}
pub use column;

/// A column without its type, as the plan and the tools that inspect columns handle it.
///
/// This one registry serves `trace`, `--view`, snapshots and statistics.
#[derive(Clone, Copy)]
pub struct ColumnKind {
    /// The column's type, which identifies it.
    pub id: TypeId,
    /// The name that `--view`, `trace` and the plan use.
    pub name: &'static str,
    /// The space of its rows.
    pub space: &'static str,
    /// The unit of its components.
    pub unit: &'static str,
    /// How long its rows remain valid.
    pub lifetime: Lifetime,
    /// The set whose stages begin it, where those of later sets update it in place.
    pub begun: Option<TileSystems>,
    /// Adds an empty column to a tile's entity.
    pub insert: fn(&mut EntityWorldMut<'_>),
    /// Whether a tile's entity has the column.
    pub present: fn(&EntityRef<'_>) -> bool,
    /// The number of rows in the tile's column; 0 without it.
    pub rows: fn(&EntityRef<'_>) -> usize,
    /// The column's components; none without it.
    pub components: for<'w> fn(&EntityRef<'w>) -> Vec<ColumnComponent<'w>>,
    /// A row as a colour, for an image of this size; the tile must have the column.
    pub paint: fn(&EntityRef<'_>, usize, [u32; 2]) -> [f32; 3],
}

impl ColumnKind {
    /// The registry entry of a column type.
    pub fn of<C: Column>() -> Self {
        Self {
            id: TypeId::of::<C>(),
            name: C::NAME,
            space: C::SPACE,
            unit: C::UNIT,
            lifetime: C::LIFETIME,
            begun: C::BEGUN,
            insert: |tile| {
                tile.insert(C::default());
            },
            present: |tile| tile.contains::<C>(),
            rows: |tile| tile.get::<C>().map_or(0, C::rows),
            components: |tile| tile.get::<C>().map_or_else(Vec::new, C::components),
            paint: |tile, row, size| tile.get::<C>().map_or([0.0; 3], |column| column.paint(row, size)),
        }
    }

    /// Whether it is the column of this type.
    pub fn is<C: Column>(&self) -> bool {
        self.id == TypeId::of::<C>()
    }

    /// Whether a view may show it: at the first bounce, a column of path lifetime has accumulated nothing yet.
    pub fn is_viewed(&self) -> bool {
        matches!(self.lifetime, Lifetime::Pixel | Lifetime::Ray)
    }

    /// Bytes of the column per row, for all components together.
    pub fn bytes_per_row(&self) -> usize {
        let mut world = World::new();
        let mut tile = world.spawn_empty();
        (self.insert)(&mut tile);
        let entity = tile.id();
        (self.components)(&world.entity(entity)).iter().map(|component| component.values.bytes_per_row()).sum()
    }

    /// The rows that belong to a path: those that name it in the component `row`, or else the row of its number.
    pub fn rows_of_path(&self, tile: &EntityRef<'_>, path: u32) -> Vec<usize> {
        let components = (self.components)(tile);
        match components.iter().find(|component| component.name == "row").map(|component| component.values) {
            Some(ComponentValues::U32(rows)) => (0..rows.len()).filter(|&row| rows[row] == path).collect(),
            _ if (path as usize) < (self.rows)(tile) => vec![path as usize],
            _ => Vec::new(),
        }
    }
}

impl PartialEq for ColumnKind {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl Eq for ColumnKind {}

impl std::fmt::Debug for ColumnKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "ColumnKind({})", self.name)
    }
}
