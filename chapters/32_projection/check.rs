//! Chapter 32: where the image shows a point of the world.

use bevy_ecs::prelude::*;
use glam::{DMat3, DVec2, DVec3};
use pinhole::extract::{MeshTable, eye};
use pinhole::intersect::{HitPrimitives, Hits};
use pinhole::plan::{Census, Shared};
use pinhole::rasterise::{
    Edge, Projection, RasterTriangle, clip_from_camera, ndc_from_clip, raster_from_ndc, rasterise_stage,
};
use pinhole::rays::{RasterPoints, Tile, WorldRays};
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Part, Probe, Question, Setting, Shown, StandIn, probes};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::naive::rasterise::{fill_hits, raster_triangles};
use std::sync::{Arc, OnceLock};

/// Point, eye, axes, tan_half, size.
type Input = ([f64; 3], [f64; 3], [[f64; 3]; 3], f64, [u32; 2]);

/// What the reader writes.
pub type Yours = fn([f64; 3], [f64; 3], [[f64; 3]; 3], f64, [u32; 2]) -> [f64; 2];

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    let written = move |&(point, eye, axes, tan_half, size): &Input| yours(point, eye, axes, tan_half, size);
    Exercise::rendered("raster_from_world", question, written, mine)
}

fn question() -> Question<Input, [f64; 2]> {
    Question {
        pinhole_has: ("src/pinhole/rasterise/spaces.rs", "ndc_from_clip"),
        probes: asked(),
        tell: |(point, eye, axes, tan_half, size)| {
            let [right, up, back] = axes.map(|axis| axis.shown());
            let [point, eye] = [point, eye].map(Shown::shown);
            format!("point {point}, eye {eye}, axes {right} {up} {back}, tan_half {tan_half:?}, size {size:?}")
        },
        right,
        apart: |yours, right| absolute(yours, right),
        allowed: 1e-6,
        measured: "pixels",
        mistakes: mistakes(),
        hints: &[
            "subtract the eye from the point; what is left along each of the three axes is a dot product",
            "the depth is minus the part along the axis that points back; x and y divided by depth · tan_half are the \
             screen point of chapters 7 and 8, y from −1 to 1 and x from −aspect to aspect",
            "from the screen to NDC it is chapter 7, and from there to pixels chapter 6",
        ],
    }
}

fn mistakes() -> Mistakes<Input, [f64; 2]> {
    let seen = Part::<Input, DVec3>::new(camera)
        .say("the eye is not subtracted: the point is seen as if the camera stood at the origin")
        .when(|i| axes(i).transpose() * DVec3::from(i.0))
        .say("the eye is added; subtract it from the point")
        .when(|i| axes(i).transpose() * (DVec3::from(i.0) + DVec3::from(i.1)))
        .say("the eye is subtracted after the turn; it is a place of the world, so subtract it first")
        .when(|i| axes(i).transpose() * DVec3::from(i.0) - DVec3::from(i.1))
        .say(
            "the point goes from the camera to the world: multiply by the transpose, that is, take the dot product \
             with each axis",
        )
        .when(|i| axes(i) * (DVec3::from(i.0) - DVec3::from(i.1)))
        .when(|i| axes(i) * DVec3::from(i.0) - DVec3::from(i.1))
        .say("it is divided by z, which is negative in front of the camera: take −z")
        .when(|i| camera(i) * DVec3::new(-1.0, -1.0, 1.0))
        .say("it is divided by the distance from the eye; the depth is the distance along the axis")
        .when(|i| DVec3 { z: -camera(i).length(), ..camera(i) })
        .say("nothing is divided by the depth, as for an orthographic camera")
        .when(|i| DVec3 { z: -1.0, ..camera(i) });
    let half = Part::<Input, DVec3>::new(|i| half(i.3, aspect(i)))
        .say("the aspect is left out: x is in half heights until it is divided by width/height")
        .when(|i| half(i.3, 1.0))
        .say("the aspect is upside down: x is divided by width/height")
        .when(|i| half(i.3, 1.0 / aspect(i)))
        .say("the aspect is a division of whole numbers, which drops the rest: make them f64 first")
        .when(|i| half(i.3, f64::from(i.4[0] / i.4[1])))
        .say("tan_half is that of the vertical field of view: y is divided by it, and x by it and the aspect")
        .when(|i| half(i.3 / aspect(i), aspect(i)))
        .when(|i| DVec3::new(i.3, i.3 * aspect(i), 0.0))
        .when(|i| DVec3::new(i.3 * aspect(i), i.3 * aspect(i), 0.0))
        .when(|i| DVec3::new(i.3 * aspect(i), i.3 / aspect(i), 0.0))
        .say("the field of view is left out")
        .when(|i| half(1.0, aspect(i)))
        .say("it is multiplied by tan_half; the wider the field of view, the smaller is everything, so divide by it")
        .when(|i| half(1.0 / i.3, aspect(i)))
        .say("tan_half is taken for an angle; it is the tangent already")
        .when(|i| half(libm::tan(i.3), aspect(i)))
        .say("tan_half is halved or doubled; it belongs to half the angle already")
        .when(|i| half(0.5 * i.3, aspect(i)))
        .when(|i| half(2.0 * i.3, aspect(i)));
    let size = Part::<Input, DVec3>::new(|i| DVec3::new(f64::from(i.4[0]), f64::from(i.4[1]), 0.0));
    let place = Part::<[DVec3; 3], [f64; 2]>::new(raster)
        .say("y is not turned down: the picture stands on its head")
        .when(|of| on_image(of, |[x, y], [_, height]| [x, height - y]))
        .say("x is turned round: it is to the right in the camera and in the image")
        .when(|of| on_image(of, |[x, y], [width, _]| [width - x, y]))
        .say(
            "half a pixel is subtracted: x and y are counted from the corner, and pixel centres are at halves \
             already",
        )
        .when(|of| on_image(of, |[x, y], _| [x - 0.5, y - 0.5]))
        .say("half a pixel is added: it is a point that is asked for, and not a pixel's centre")
        .when(|of| on_image(of, |[x, y], _| [x + 0.5, y + 0.5]))
        .say("the point is rounded to a whole pixel; asked is where it is, with its fraction")
        .when(|of| on_image(of, |at, _| at.map(f64::floor)))
        .when(|of| on_image(of, |at, _| at.map(f64::round)))
        .say("the point is rounded to a pixel's centre; asked is where it is, with its fraction")
        .when(|of| on_image(of, |at, _| at.map(|part| part.floor() + 0.5)))
        .say("the last pixel is taken for the edge: NDC is times the size, not times the size less 1")
        .when(|of| on_image(of, |[x, y], [width, height]| [x - x / width, y - y / height]))
        .say("a point beside the image is pulled to its edge; it is somewhere outside")
        .when(|of| on_image(of, |[x, y], [width, height]| [x.clamp(0.0, width), y.clamp(0.0, height)]))
        .say("that is NDC, from 0 to 1; times the size it is in pixels")
        .when(|of| on_image(of, |[x, y], [width, height]| [x / width, y / height]))
        .say("that is the screen, from −1 to 1; pixels are counted from the upper left corner")
        .when(|of| on_image(of, |[x, y], [width, height]| [(2.0 * x - width) / height, 1.0 - 2.0 * y / height]))
        .when(|of| on_image(of, |[x, y], [width, height]| [2.0 * x / width - 1.0, 1.0 - 2.0 * y / height]))
        .say("the middle of the image is at half its size: x and y are moved there, and y is turned down")
        .when(|of| on_image(of, |[x, y], [width, height]| [x - width / 2.0, height / 2.0 - y]))
        .when(|of| on_image(of, |[x, y], [width, height]| [x - width / 2.0, y - height / 2.0]))
        .say("the image is 2 screen units high, from −1 to 1: the size is to be halved")
        .when(|of| on_image(of, |[x, y], [width, height]| [2.0 * x - width / 2.0, 2.0 * y - height / 2.0]))
        .when(|of| on_image(of, |[x, y], _| [2.0 * x, 2.0 * y]));
    Mistakes::<Input, [f64; 2]>::new()
        .say("the size is taken for height and width; it is width and height")
        .when(|&(point, eye, axes, tan_half, [width, height])| right(&(point, eye, axes, tan_half, [height, width])))
        .of_parts([seen, half, size], place)
}

fn aspect(&(.., [width, height]): &Input) -> f64 {
    f64::from(width) / f64::from(height)
}

fn axes(&(_, _, [x, y, z], ..): &Input) -> DMat3 {
    DMat3::from_cols(x.into(), y.into(), z.into())
}

/// The point in camera space, by the matrix's inverse.
fn camera(input: &Input) -> DVec3 {
    axes(input).inverse() * (DVec3::from(input.0) - DVec3::from(input.1))
}

/// Half the image's width and height on the plane at distance 1.
fn half(tan_half: f64, aspect: f64) -> DVec3 {
    DVec3::new(tan_half * aspect, tan_half, 0.0)
}

/// Of a point in camera space, these halves, and the size.
fn raster(&[camera, half, size]: &[DVec3; 3]) -> [f64; 2] {
    raster_from_ndc(ndc_from_clip(clip_from_camera(camera, half.truncate(), true)), size.truncate()).into()
}

/// The place changed with the size at hand.
fn on_image(of: &[DVec3; 3], change: fn([f64; 2], [f64; 2]) -> [f64; 2]) -> [f64; 2] {
    change(raster(of), of[2].truncate().to_array())
}

fn right(input: &Input) -> [f64; 2] {
    raster(&[camera(input), half(input.3, aspect(input)), DVec2::from(input.4.map(f64::from)).extend(0.0)])
}

fn asked() -> Vec<Probe<Input>> {
    const STRAIGHT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let at = |point| (point, [0.0; 3], STRAIGHT, 0.5, [200, 200]);
    let mut asked: Vec<_> = probes("straight ahead", [at([0.0, 0.0, -4.0])]).collect();
    asked.extend(probes("to the right and up", [at([1.0, 1.0, -4.0]), at([0.25, 0.5, -8.0])]));
    asked.extend(probes("a corner of the image", [at([1.0, 1.0, -2.0]), at([-1.0, -1.0, -2.0])]));
    let wide = |point| (point, [0.0; 3], STRAIGHT, 0.5, [480, 270]);
    asked.extend(probes("an image that is not square", [wide([1.0, 1.0, -4.0]), wide([-0.5, 0.25, -3.0])]));
    asked.extend(probes("another field of view", [([1.0, 0.5, -4.0], [0.0; 3], STRAIGHT, 2.0, [480, 270])]));
    let eye = [3.0, -1.0, 5.0];
    asked.extend(probes("a camera elsewhere", [([3.5, -0.5, 1.0], eye, STRAIGHT, 0.5, [480, 270])]));
    // It looks along −x.
    let left = [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
    asked.extend(probes("a camera that is turned", [([-1.0, -0.5, 4.5], eye, left, 0.5, [480, 270])]));
    asked.extend(probes("any camera and point", (0..200).map(drawn)));
    asked
}

/// A point in front of a camera that stands and looks anywhere.
fn drawn(index: u64) -> Input {
    let mut draws = Draws::new(3201, index);
    let back = draws.unit_vector();
    let right = draws.unit_vector_across(back);
    let axes = [right, back.cross(right), back];
    let eye = DVec3::from([(); 3].map(|()| draws.between(-10.0, 10.0)));
    let (depth, tan_half) = (draws.between(0.5, 50.0), draws.between(0.1, 1.5));
    let [x, y] = [(); 2].map(|()| draws.between(-2.0, 2.0) * depth * tan_half);
    let point = eye + axes[0] * x + axes[1] * y - axes[2] * depth;
    let size = [draws.between(1.0, 2000.0) as u32, draws.between(1.0, 2000.0) as u32];
    (point.into(), eye.into(), axes.map(DVec3::into), tan_half, size)
}

/// What each tile has to be rasterised.
type OfTile =
    (&'static Tile, &'static RasterPoints, &'static WorldRays, &'static mut Hits, Option<&'static mut HitPrimitives>);

/// Meshes rasterised in plain code, their vertices where the reader's function puts them.
fn mine(ask: Ask<Input, [f64; 2]>, setting: &Setting<'_>) -> StandIn {
    let eye = eye(&Census::of(setting.scene)).unwrap_or_default();
    let kept: Arc<OnceLock<Vec<RasterTriangle>>> = Arc::default();
    StandIn::instead(
        rasterise_stage,
        move |projection: Res<Shared<Projection>>, meshes: Res<Shared<MeshTable>>, mut tiles: Query<OfTile>| {
            let triangles = kept.get_or_init(|| {
                let rows = projection.camera_from_world.transpose();
                let axes = [rows.x_axis, rows.y_axis, rows.z_axis].map(DVec3::into);
                let size = [projection.size.x as u32, projection.size.y as u32];
                raster_triangles(&projection, &meshes, |point| {
                    let asked = ((point + eye).into(), eye.into(), axes, projection.half.y, size);
                    ask.once(asked).map_or(DVec2::ZERO, DVec2::from)
                })
            });
            for (tile, raster, rays, mut hits, mut primitives) in &mut tiles {
                let hits = (&mut *hits, primitives.as_deref_mut());
                fill_hits(triangles, &meshes, (tile, raster, rays), hits, |_, triangle, [x, y]| {
                    let [a, b, c] = triangle.corners;
                    let inside = |from, to| Edge::new(from, to, [0, 0]).at(f64::from(x), f64::from(y)) >= 0.0;
                    inside(a, b) && inside(b, c) && inside(c, a)
                });
            }
        },
    )
}
