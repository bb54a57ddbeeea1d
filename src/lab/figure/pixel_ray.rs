use bevy_ecs::world::EntityRef;
use glam::DVec3;
use pinhole::film::{Curve, FilmTile, byte_from_linear};
use pinhole::intersect::{Hits, NO_SHAPE, Surface, Surfaces};
use pinhole::rays::{Tile, WorldRays};
use pinhole::shade::{ShadowHits, ShadowRays};

/// One pixel's ray as the stages left it, in render space.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelRay {
    /// The pixel, from the left and from the top.
    pub pixel: [u32; 2],
    /// Where the ray starts.
    pub origin: DVec3,
    /// Its direction, a unit vector to within f32.
    pub direction: DVec3,
    /// The distance and the shape it hits; none where nothing is hit.
    pub hit: Option<(f64, u32)>,
    /// The surface it hits; none where nothing is hit or no stage describes surfaces.
    pub surface: Option<Surface>,
    /// The colour that pinhole rendered, as a screen shows it.
    pub colour: String,
    /// From the surface on to each light that it faces: where it starts, the light, and what stands in between.
    pub onward: Vec<Onward>,
}

/// A ray from a surface to a light, in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Onward {
    /// On the surface.
    pub from: DVec3,
    /// The light.
    pub to: DVec3,
    /// How far along something stands in the way; none where the light arrives.
    pub blocked: Option<f64>,
}

impl PixelRay {
    /// r(t) = O + tR.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }

    /// Where it hits a surface.
    pub fn point(&self) -> Option<DVec3> {
        self.hit.map(|(t, _)| self.at(t))
    }

    /// The onward ray that brings light, if one does.
    pub fn lit(&self) -> Option<Onward> {
        self.onward.iter().copied().find(|onward| onward.blocked.is_none())
    }
}

/// Reads a tile's columns, a ray a pixel.
pub fn pixel_rays(tile: &EntityRef<'_>, lights: &[DVec3]) -> Vec<PixelRay> {
    let (Some(place), Some(world), Some(film)) = (tile.get::<Tile>(), tile.get::<WorldRays>(), tile.get::<FilmTile>())
    else {
        return Vec::new();
    };
    let hits = tile.get::<Hits>();
    let ray = |row: usize| {
        let hit = hits.filter(|hits| hits.shape[row] != NO_SHAPE).map(|hits| (hits.t[row], hits.shape[row]));
        PixelRay {
            pixel: place.pixel_of(row),
            origin: world.point_at(row, 0.0),
            direction: world.direction_of(row),
            hit,
            surface: hit.and_then(|_| tile.get::<Surfaces>()).map(|surfaces| surfaces.get(row)),
            colour: screen_colour(film.mean(row)),
            onward: onward(tile, row as u32, lights),
        }
    };
    (0..place.rows()).map(ray).collect()
}

/// The rays to lights that a pixel's surface sends.
fn onward(tile: &EntityRef<'_>, path: u32, lights: &[DVec3]) -> Vec<Onward> {
    let Some(rays) = tile.get::<ShadowRays>() else { return Vec::new() };
    let shadows = tile.get::<ShadowHits>();
    let of_row = |row: usize| {
        let (from, direction) = (rays.origin_of(row), rays.direction_of(row));
        let blocked = shadows.filter(|hits| hits.shape[row] != NO_SHAPE).map(|hits| hits.t[row]);
        // The column holds the direction only; the light is the one that lies there.
        let off = |light: &&DVec3| (**light - from).normalize().distance(direction);
        let to = lights.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
        to.map(|&to| Onward { from, to, blocked })
    };
    (0..rays.row.len()).filter(|&row| rays.row[row] == path).filter_map(of_row).collect()
}

/// Light as a screen shows it.
pub fn screen_colour(linear: [f32; 3]) -> String {
    let [r, g, b] = linear.map(|part| byte_from_linear(part, Curve::Srgb));
    format!("#{r:02x}{g:02x}{b:02x}")
}
