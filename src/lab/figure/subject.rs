use super::pixel_ray::{PixelRay, pixel_rays};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};
use pinhole::cameras::RaySpread;
use pinhole::extract::{
    CameraAxes, ImageFrame, MaterialTable, PlaneTable, PointLightTable, ShapeTable, SphereTable, camera_spread,
};
use pinhole::intersect::Hits;
use pinhole::plan::{Census, Table};
use pinhole::rays::WorldRays;
use pinhole::render::{Inspection, inspect};
use pinhole::scene::Resolution;
use pinhole::shapes::ShapeKind;
use pinhole::{Chapter, Overrides};
use pinhole::{Error, Result, stages};

/// What a chapter's camera does, and so how its rays lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// From the eye; tan(vertical angle / 2).
    Perspective(f64),
    /// Parallel; half the rectangle's height in scene units.
    Orthographic(f64),
}

/// A sphere in render space.
#[derive(Clone, Debug, PartialEq)]
pub struct Ball {
    /// Its centre, scene units.
    pub centre: DVec3,
    /// Its radius, scene units.
    pub radius: f64,
    /// The fraction of light that it sends on, linear Rec. 709.
    pub colour: [f64; 3],
    /// The number that hits carry.
    pub shape: u32,
}

/// A plane in render space: the points x with n·x = k.
#[derive(Clone, Debug, PartialEq)]
pub struct Planar {
    /// The unit normal n.
    pub normal: DVec3,
    /// The offset k, scene units.
    pub offset: f64,
    /// The fraction of light that it sends on, linear Rec. 709.
    pub colour: [f64; 3],
}

/// A chapter's scene and what the stages wrote for it at a small resolution: all that a figure is drawn from.
///
/// Space: render space, the world's axes with the eye at the origin; scene units.
pub struct Subject {
    /// The chapter's stem.
    pub chapter: &'static str,
    /// The image's shape.
    pub image: ImageFrame,
    /// The camera's x, y, z axes.
    pub axes: DMat3,
    /// Its lens.
    pub lens: Lens,
    /// Spheres in spawn order.
    pub balls: Vec<Ball>,
    /// Planes in spawn order.
    pub planar_shapes: Vec<Planar>,
    /// Point lights in spawn order.
    pub lights: Vec<DVec3>,
    /// A ray a pixel, row by row.
    pub rays: Vec<PixelRay>,
}

impl Subject {
    /// Runs a chapter's stages over its scene at this resolution and reads the columns.
    ///
    /// Errors: what a render of the chapter would be refused for.
    pub fn of(chapter: &Chapter, width: u32, height: u32) -> Result<Self> {
        let asked = Overrides { resolution: Some(Resolution { width, height }), ..Overrides::default() };
        let mut picture = chapter.clone();
        picture.view = None;
        let scene = picture.world(&asked);
        let inspection = inspected(&picture, &scene, width.max(height))?;
        let census = &Census::of(&scene);
        let lights = PointLightTable::extract(census)?.row.iter().map(|light| light.position).collect::<Vec<_>>();
        Ok(Self {
            chapter: chapter.name,
            image: inspection.image,
            axes: CameraAxes::extract(census)?.world_from_camera,
            lens: lens(&scene)?,
            balls: balls(&scene)?,
            planar_shapes: planar_shapes(&scene)?,
            rays: inspection
                .tiles
                .iter()
                .flat_map(|&tile| pixel_rays(&inspection.world.entity(tile), &lights))
                .collect(),
            lights,
        })
    }

    /// The ray of a pixel.
    pub fn ray(&self, [x, y]: [u32; 2]) -> &PixelRay {
        &self.rays[(y * self.image.width + x) as usize]
    }

    /// The sphere that a ray hits.
    pub fn ball_hit(&self, ray: &PixelRay) -> Option<&Ball> {
        let (_, shape) = ray.hit?;
        self.balls.iter().find(|ball| ball.shape == shape)
    }

    /// A pixel's distance from the image's centre, squared, in pixels.
    pub fn off_centre(&self, [x, y]: [u32; 2]) -> f64 {
        let [dx, dy] = [
            f64::from(x) + 0.5 - f64::from(self.image.width) / 2.0,
            f64::from(y) + 0.5 - f64::from(self.image.height) / 2.0,
        ];
        dx * dx + dy * dy
    }
}

/// The chapter's own stages, or all that pinhole has where those do not yet lead to a hit.
fn inspected(chapter: &Chapter, scene: &World, side: u32) -> Result<Inspection> {
    let complete = |inspection: &Inspection| {
        let tile = inspection.tiles.first().map(|&tile| inspection.world.entity(tile));
        tile.is_some_and(|tile| tile.contains::<WorldRays>() && tile.contains::<Hits>())
    };
    match inspect(scene, &chapter.stages(), side) {
        Ok(inspection) if complete(&inspection) => Ok(inspection),
        _ => {
            let mut whole = chapter.clone();
            whole.offer = [
                stages::camera_rays(),
                stages::wide_cameras(),
                stages::lens(),
                stages::motion(),
                stages::intersection(),
                stages::transforms(),
                stages::surfaces(),
                stages::direct_light(),
                stages::lights(),
            ]
            .concat();
            inspect(scene, &whole.stages(), side)
        }
    }
}

fn lens(scene: &World) -> Result<Lens> {
    Ok(match camera_spread(&Census::of(scene))? {
        RaySpread::Central(half_height) => Lens::Perspective(half_height),
        RaySpread::Parallel(half_height) => Lens::Orthographic(half_height),
        RaySpread::Angular(_) => {
            return Err(Error::Usage("figures are drawn of perspective and orthographic cameras only".into()));
        }
    })
}

/// The colours of shapes of one kind, in the order of that kind's table.
fn colours(scene: &World, kind: ShapeKind) -> Result<Vec<[f64; 3]>> {
    let census = &Census::of(scene);
    let (shapes, materials) = (ShapeTable::extract(census)?, MaterialTable::extract(census)?);
    let of_kind = (0..shapes.kind.len()).filter(|&shape| shapes.kind[shape] == kind);
    // A shape that only emits light is drawn black.
    let colour =
        |shape: usize| materials.parameters.get(shapes.material[shape] as usize).copied().unwrap_or_default().colour;
    Ok(of_kind.map(colour).collect())
}

fn balls(scene: &World) -> Result<Vec<Ball>> {
    let table = SphereTable::extract(&Census::of(scene))?;
    let colours = colours(scene, ShapeKind::Sphere)?.into_iter().enumerate();
    let ball = |(row, colour): (usize, _)| Ball {
        centre: table.row[row].centre,
        radius: table.row[row].radius,
        colour,
        shape: table.shape[row],
    };
    Ok(colours.map(ball).collect())
}

fn planar_shapes(scene: &World) -> Result<Vec<Planar>> {
    let table = PlaneTable::extract(&Census::of(scene))?;
    let colours = colours(scene, ShapeKind::Plane)?.into_iter().enumerate();
    Ok(colours
        .map(|(row, colour)| Planar { normal: table.row[row].normal, offset: table.row[row].offset, colour })
        .collect())
}
