/// Opens a file beside the model by its name as the model has it, and returns its bytes, or why that cannot be.
pub(super) type Open<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;
