macro_rules! kinds {
    ($($kind:ident($shape:ty) $field:ident $plural:literal,)+) => {
        /// The kinds of shape, in the order of the list.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum ShapeKind {
            $(#[doc = concat!("One of the ", $plural, " that keep still while the shutter is open.")] $kind,)+
            /// A shape of any kind that moves while the shutter is open.
            Moving,
            /// A scattering event in a medium, which takes the place of a hit on a shape.
            Medium,
            /// A shape that a program adds, with a number of its own among these.
            Custom(u8),
        }

        impl ShapeKind {
            /// The kinds that are listed, without the moving shapes.
            pub const LISTED: &[Self] = &[$(Self::$kind),+];
        }
    };
}
with_shapes!(kinds);
