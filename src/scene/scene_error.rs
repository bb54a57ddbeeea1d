use std::fmt;

/// Why a scene cannot be rendered; displayed as one sentence with the entity, the field, the value and what is
/// accepted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError {
    /// The kind and name of the entity, such as `camera "main"`.
    pub entity: String,
    /// The component's field, or the component itself.
    pub field: &'static str,
    /// The offending value, as the author wrote it.
    pub value: String,
    /// What would be accepted.
    pub accepted: String,
}

impl SceneError {
    /// An error from its four parts.
    pub fn new(
        entity: impl Into<String>,
        field: &'static str,
        value: impl fmt::Display,
        accepted: impl Into<String>,
    ) -> Self {
        Self { entity: entity.into(), field, value: value.to_string(), accepted: accepted.into() }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} is {}, but {}", self.entity, self.field, self.value, self.accepted)
    }
}

impl std::error::Error for SceneError {}
