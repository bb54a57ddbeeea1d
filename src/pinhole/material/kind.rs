use super::{Bsdf, BsdfClass, for_each_bsdf, named_bsdf};

macro_rules! kinds {
    ($($kind:ident($table:ident, $name:literal),)+) => {
        /// The kinds of material: one for each BSDF.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum MaterialKind {
            $(#[doc = concat!("A row of [`", stringify!($table), "`](crate::material::", stringify!($table), ").")] $kind,)+
            /// A row of the table of a BSDF that a program adds.
            Custom {
                /// A number of its own among these.
                number: u8,
                /// How it scatters.
                class: BsdfClass,
                /// Whether light passes through its surface.
                transmits: bool,
            },
        }

        $(named_bsdf!(crate::material::$table, MaterialKind::$kind, $name);)+

        impl MaterialKind {
            /// How its BSDF scatters.
            #[inline(always)]
            const fn class(self) -> BsdfClass {
                match self {
                    $(Self::$kind => <crate::material::$table>::CLASS,)+
                    Self::Custom { class, .. } => class,
                }
            }

            /// Whether light passes through its surface.
            #[inline(always)]
            pub const fn transmits(self) -> bool {
                match self {
                    $(Self::$kind => <crate::material::$table>::TRANSMITS,)+
                    Self::Custom { transmits, .. } => transmits,
                }
            }
        }
    };
}

for_each_bsdf!(kinds);

impl MaterialKind {
    /// Whether its BSDF is a delta distribution.
    #[inline(always)]
    pub const fn is_specular(self) -> bool {
        matches!(self.class(), BsdfClass::Specular)
    }
}
