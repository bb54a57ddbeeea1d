use crate::Result;
use crate::extract::{contact_evidence, shape_name, starts_on_glass, unresolved};
use crate::plan::Census;

/// Warnings of glass that is thinner, or nearer to another surface, than single precision can keep apart.
pub fn unresolved_glass(scene: &Census<'_>) -> Result<Vec<String>> {
    if !contact_evidence(scene).needed {
        return Ok(Vec::new());
    }
    let warning = |([one, other], apart): ([usize; 2], f64)| {
        let [name, of] = [one, other].map(|shape| shape_name(scene, shape));
        if one == other {
            format!(
                "the {name} is {apart:.1e} thick, which single precision does not always keep apart at its distance from \
                 the camera: both of its sides reflect, but where it does not, nothing is absorbed between them, and on \
                 something opaque the {name} is not there"
            )
        } else {
            format!(
                "the {name} and the {of} are {apart:.1e} apart, which single precision does not always keep apart at their \
                 distance from the camera: where it does not, they are taken to touch"
            )
        }
    };
    Ok(unresolved(scene)?.into_iter().map(warning).collect())
}

/// Warnings of a camera or a light without an area that lies exactly on the surface of glass.
pub fn on_the_surface(scene: &Census<'_>) -> Result<Vec<String>> {
    let warning = |name: String| {
        format!(
            "the {name} lies exactly on the surface of glass: its rays start inside or outside, each on the side that it \
             leads to; move it a little to have all of them on one side"
        )
    };
    Ok(starts_on_glass(scene)?.into_iter().map(warning).collect())
}
