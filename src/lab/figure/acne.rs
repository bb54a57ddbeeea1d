//! Shadow rays that start where textbooks have them, in three sizes of one scene.

use super::Figure;
use super::label::Label;
use super::pen::WIDTH;
use super::picture::Picture;
use super::svg::{Drawing, Svg};
use crate::naive::shadow::{ShadowStart, start_after_constant, start_at_hit, start_off_surface};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3, Vec3};
use pinhole::Result;
use pinhole::extract::{MaterialTable, any_shapes};
use pinhole::film::FilmTile;
use pinhole::intersect::{NO_SHAPE, Surfaces};
use pinhole::material::lambertian;
use pinhole::plan::{Census, Table};
use pinhole::render::inspect;
use pinhole::scene::{LookAt, Placement, PointLight, Resolution, Rgb, Sphere};
use pinhole::shade::{ShadowHits, ShadowRays};
use pinhole::shapes::AnyShape;
use pinhole::{Chapter, Overrides};

/// A scene's shapes, for figures that send rays of their own; the intersection is pinhole's.
pub struct Occluders(Vec<AnyShape>);

impl Occluders {
    /// The shapes of a scene, in render space.
    pub fn of(scene: &World) -> Result<Self> {
        Ok(Self(any_shapes(&Census::of(scene))?))
    }

    /// Whether anything is hit before `t_max`.
    pub fn block(&self, origin: DVec3, direction: DVec3, t_max: f64) -> bool {
        self.0.iter().any(|shape| shape.t(origin, direction) < t_max)
    }
}

/// Pixels of each small picture.
const SIZE: [u32; 2] = [144, 81];
/// How many times as large the scene is made, and what the drawing says of it.
const SCALES: [(f64, &str); 3] = [
    (1.0, "the scene as it is"),
    (1e5, "everything 100,000 times as large and as far away"),
    (1e-4, "everything 10,000 times as small and as near"),
];

/// What a textbook makes of a hit's position and normal.
type Start = fn(Vec3, Vec3) -> ShadowStart;
const STARTS: [(&str, Start); 3] = [
    ("from the hit itself", |position, _| start_at_hit(position)),
    ("the same, only *t* > 0.001", |position, _| start_after_constant(position)),
    ("from hit + 0.0001 *n*", start_off_surface),
];

const GAP: f64 = 10.0;
const HEAD: f64 = 30.0;
const WORDS: f64 = 22.0;

/// The chapter's own hits with the starts of shadow rays that textbooks have, in three sizes of the scene.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let across = (WIDTH - 4.0 * GAP) / 3.0;
    let panel = DVec2::new(across, across * f64::from(SIZE[1]) / f64::from(SIZE[0]));
    let row_height = WORDS + panel.y + WORDS;
    let corner = |column: usize, row: usize| {
        DVec2::new(GAP + column as f64 * (across + GAP), HEAD + row as f64 * row_height + WORDS)
    };
    let mut svg = Svg::new(figure.name, HEAD + 3.0 * row_height + 34.0);
    for (column, (name, _)) in STARTS.iter().enumerate() {
        let at = DVec2::new(corner(column, 0).x + across / 2.0, 26.0);
        svg.label(Label::near(at, name, DVec2::NEG_Y, 0.0).title(1.0));
    }
    for (row, (scale, told)) in SCALES.iter().enumerate() {
        let shadows = Shadows::of(chapter, figure, *scale)?;
        svg.label(Label::near(corner(0, row) - DVec2::Y * 9.0, told, DVec2::X, 0.0).title(0.92));
        for (column, (_, start)) in STARTS.iter().enumerate() {
            let (pixels, wrong) = shadows.started_by(*start);
            let low = corner(column, row);
            svg.picture(low, panel, &Picture::painted(SIZE, &pixels)?);
            let count = format!("{wrong} of {} wrong", shadows.rays.row.len());
            let at = low + DVec2::new(across / 2.0, panel.y + 4.0);
            svg.label(Label::near(at, &count, DVec2::Y, 0.0).title(0.92));
        }
    }
    Ok(svg.finish(figure.about, &figure.stamp(SIZE, "")))
}

/// What the stages wrote up to the shadow rays, and the shapes that may stand in the way.
struct Shadows {
    occluders: Occluders,
    materials: MaterialTable,
    surfaces: Surfaces,
    rays: ShadowRays,
    hits: ShadowHits,
    /// What each pixel has without the light of any light source.
    unlit: Vec<[f32; 3]>,
}

impl Shadows {
    /// Runs the chapter's stages over its scene, scaled.
    fn of(chapter: &Chapter, figure: &Figure, scale: f64) -> Result<Self> {
        let [width, height] = SIZE;
        let mut scene =
            chapter.world(&Overrides { resolution: Some(Resolution { width, height }), ..Overrides::default() });
        scale_scene(&mut scene, scale);
        let inspection = inspect(&scene, &chapter.stages(), width.max(height))?;
        let tile = inspection.tiles.first().map(|&tile| inspection.world.entity(tile));
        let columns = tile.and_then(|tile| {
            let lit = (tile.get::<Surfaces>()?.clone(), tile.get::<ShadowRays>()?.clone());
            Some((lit, tile.get::<ShadowHits>()?.clone(), tile.get::<FilmTile>()?))
        });
        let ((surfaces, rays), hits, film) = columns.ok_or_else(|| figure.unsuited("a light that casts shadows"))?;
        // A surface begins black, and what is behind everything has its light already.
        let is_hit = |row: usize| surfaces.get(row).normal != Vec3::ZERO;
        let unlit = |row: usize| if is_hit(row) { [0.0; 3] } else { film.mean(row) };
        let unlit = (0..film.count.len()).map(unlit).collect();
        let (occluders, materials) = (Occluders::of(&scene)?, MaterialTable::extract(&Census::of(&scene))?);
        Ok(Self { occluders, materials, surfaces, rays, hits, unlit })
    }

    /// The pixels with another start of each shadow ray, and how many of them differ from pinhole's.
    fn started_by(&self, start: Start) -> (Vec<[f32; 3]>, usize) {
        let (rays, mut pixels, mut wrong) = (&self.rays, self.unlit.clone(), 0);
        for (ray, &path) in rays.row.iter().enumerate() {
            let surface = self.surfaces.get(path as usize);
            let direction = rays.direction_of(ray);
            let blocked = self.blocked(start(surface.position, surface.normal), direction, f64::from(rays.t_max[ray]));
            wrong += usize::from(blocked != (self.hits.shape[ray] != NO_SHAPE));
            if !blocked {
                let colour =
                    self.materials.parameters.get(surface.material as usize).copied().unwrap_or_default().colour;
                let irradiance = rays.irradiance(ray).map(f64::from);
                let brings = [0, 1, 2].map(|part| lambertian(colour)[part] * irradiance[part]);
                pixels[path as usize].iter_mut().zip(brings).for_each(|(sum, part)| *sum += part as f32);
            }
        }
        (pixels, wrong)
    }

    /// Whether anything is hit between `t_min` and `t_max`.
    fn blocked(&self, start: ShadowStart, direction: DVec3, t_max: f64) -> bool {
        let t_min = f64::from(start.t_min);
        self.occluders.block(start.origin.as_dvec3() + t_min * direction, direction, t_max - t_min)
    }
}

/// Makes a scene larger by this factor, and its lights stronger by its square, since they are then farther away.
fn scale_scene(scene: &mut World, scale: f64) {
    for mut placement in scene.query::<&mut Placement>().iter_mut(scene) {
        placement.position *= scale;
    }
    for mut look in scene.query::<&mut LookAt>().iter_mut(scene) {
        (look.eye, look.target) = (look.eye * scale, look.target * scale);
    }
    for mut sphere in scene.query::<&mut Sphere>().iter_mut(scene) {
        sphere.radius *= scale;
    }
    for mut light in scene.query::<&mut PointLight>().iter_mut(scene) {
        let [r, g, b] = light.intensity.to_array().map(|part| part * scale * scale);
        light.intensity = Rgb::new(r, g, b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::trial;

    #[test]
    fn each_start_fails_somewhere_and_the_hit_s_own_place_everywhere() {
        let figure = trial::figure(draw);
        let chapter = trial::chapter(trial::central);
        let mut wrong = [[0; 3]; 3];
        let mut rays = 0;
        for ((scale, _), row) in SCALES.iter().zip(&mut wrong) {
            let shadows = Shadows::of(&chapter, &figure, *scale).expect("shadows");
            rays += shadows.rays.row.len();
            *row = STARTS.map(|(_, start)| shadows.started_by(start).1);
        }
        eprintln!("wrong of {rays} shadow rays in three sizes: {wrong:?}");
        let [near, far, small] = wrong;
        assert!(near[0] > 1000 && far.iter().all(|&count| count > 500) && small.iter().all(|&count| count > 100));
        assert!(near[1] < 20 && near[2] < 20, "constants suit the size that they were made for");
    }
}
