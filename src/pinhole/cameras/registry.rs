use super::camera::{Camera, CameraNames};
use crate::plan::Table;

/// A camera of the list.
pub trait Listed: Camera + Table {
    /// The names of what exists once for each camera.
    const NAMES: CameraNames;
}

macro_rules! registry {
    ($($component:ident($camera:ty) $noun:literal,)+) => {
        $(impl Listed for $camera {
            const NAMES: CameraNames = CameraNames {
                component: stringify!($component),
                noun: $noun,
                stage: concat!("Generate camera rays: ", $noun),
            };
        })+
    };
}
super::with_cameras!(registry);
