use super::{Bsdf, BsdfClass, Named, StageNames, for_each_bsdf};

macro_rules! kinds {
    ($($kind:ident($table:ident, $name:literal),)+) => {
        /// The kinds of material: one for each BSDF.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum MaterialKind {
            $(#[doc = concat!("A row of [`", stringify!($table), "`](crate::material::", stringify!($table), ").")] $kind,)+
        }

        $(impl Named for crate::material::$table {
            const KIND: MaterialKind = MaterialKind::$kind;
            const NAMES: StageNames = StageNames {
                sample: concat!("Sample BSDFs: ", $name),
                sample_from_lights: concat!("Sample BSDFs: ", $name, ", from lights"),
                split: concat!("Split rays at ", $name),
                direct_light: concat!("Evaluate direct light: ", $name),
                connections: concat!("Evaluate connections to the camera: ", $name),
                mis: concat!("Compute MIS weights: ", $name),
                classify: concat!("List rows: ", $name),
                rows: concat!($name, " rows"),
            };
        })+

        impl MaterialKind {
            /// The number of kinds.
            pub const COUNT: usize = [$(MaterialKind::$kind),+].len();
            const CLASSES: [BsdfClass; Self::COUNT] = [$(<crate::material::$table>::CLASS),+];
            const TRANSMITS: [bool; Self::COUNT] = [$(<crate::material::$table>::TRANSMITS),+];
        }
    };
}

for_each_bsdf!(kinds);

impl MaterialKind {
    /// Whether its BSDF is a delta distribution.
    #[inline(always)]
    pub const fn is_specular(self) -> bool {
        matches!(Self::CLASSES[self as usize], BsdfClass::Specular)
    }

    /// Whether light passes through its surface.
    #[inline(always)]
    pub const fn transmits(self) -> bool {
        Self::TRANSMITS[self as usize]
    }
}
