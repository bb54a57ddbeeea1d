//! What a scene, a chapter or a stage of one's own begins with: the components, the plan, bevy_ecs and glam.
//!
//! ```
//! use pinhole::prelude::*;
//!
//! let mut scene = World::new();
//! let ball = scene.spawn((Name::new("ball"), Sphere { radius: 0.5 }, Matte::default())).id();
//! scene.entity_mut(ball).insert(Placement::at(0.0, 0.5, -3.0));
//! assert_eq!(scene.get::<Placement>(ball).map(|placement| placement.position.y), Some(0.5));
//! ```

pub use crate::plan::{Census, Column, Evidence, Lifetime, Plan, Shared, Stage, StageKind, Table, TileSystems};
pub use crate::render::{Execution, Rendered};
pub use crate::scene::prelude::*;
pub use crate::{Chapter, Overrides, render_scene};
#[doc(no_inline)]
pub use bevy_ecs::prelude::*;
#[doc(no_inline)]
pub use glam::{DAffine3, DMat3, DQuat, DVec2, DVec3, Vec3};
#[doc(no_inline)]
pub use {bevy_ecs, glam};
