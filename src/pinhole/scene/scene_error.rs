use std::fmt;

/// Why a scene cannot be rendered: one sentence with the entity, the field, the value and what would be accepted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneError {
    /// What it is and how it is called, such as `camera "main"`.
    pub entity: String,
    /// The component's field, or the component.
    pub field: &'static str,
    /// The value found, as the author wrote it.
    pub value: String,
    /// What would be accepted.
    pub accepted: String,
}

impl SceneError {
    /// A refusal from its four parts.
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
