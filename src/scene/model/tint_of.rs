use super::open_model::OpenModel;
use crate::{Rgb, Tint};

impl OpenModel {
    /// The tint of a material: its base colour where that has a texture that is read, and the colours of the vertices of its meshes;
    /// none where neither is there.
    pub fn tint_of(&self, material: usize, has_texture: bool) -> Option<Tint> {
        let own = self.model.materials.get(material).filter(|_| has_texture);
        let [r, g, b] = own.map_or([1.0; 3], |own| own.base_colour);
        let instances = self.model.instances.iter();
        let meshes = instances.filter(|instance| instance.material.unwrap_or(usize::MAX) == material);
        let by_vertex = meshes.map(|instance| instance.mesh).any(|mesh| self.model.meshes[mesh].colours.is_some());
        let factor = Rgb::new(r, g, b);
        (by_vertex || factor != Rgb::grey(1.0)).then_some(Tint { factor, by_vertex })
    }
}
