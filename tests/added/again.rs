//! A sphere, a mirror and a point light of the library, added once more as another crate would: whatever is done with
//! them, the picture must be that of the library's own.

use super::bits;
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};
use pinhole::extend::*;
use pinhole::lights::PlacedPointLight;
use pinhole::material::{MirrorTable, mirror_direction};
use pinhole::plan::{Census, Stage, Table};
use pinhole::render::Execution;
use pinhole::scene::*;
use pinhole::shapes::PlacedSphere;

#[derive(Component, Clone, Debug, Default, PartialEq)]
struct Ball(Sphere);

impl SceneShape for Ball {
    const NAME: &'static str = "Ball";
    const WORD: &'static str = "ball";

    fn scale(&mut self, by: f64) {
        self.0.radius *= by;
    }
}

#[derive(Clone, Debug, PartialEq)]
struct PlacedBall(PlacedSphere);

pinhole::extend::custom_shape!(PlacedBall, 7, "balls");

impl Shape for PlacedBall {
    type Component = Ball;
    type SurfaceData = ();
    type Emitter = NeverSampled;
    type Prepared = ();
    const HAS_UV_SPACE: bool = true;

    fn has_inside(_: &Ball) -> bool {
        true
    }
    fn place(ball: &Ball, placed: &Placed<'_>) -> Result<(Self, ()), SceneError> {
        PlacedSphere::place(&ball.0, placed).map(|(sphere, data)| (Self(sphere), data))
    }
    fn intersection(&self, origin: DVec3, direction: DVec3) -> Intersection {
        self.0.intersection(origin, direction)
    }
    fn precise_t(&self, origin: DVec3, direction: DVec3) -> f64 {
        self.0.precise_t(origin, direction)
    }
    fn surface(&self, data: &(), hit: &RayHit) -> SurfacePoint {
        self.0.surface(data, hit)
    }
    fn uv(&self, data: &(), hit: &RayHit, at: DVec3, own: DVec3) -> [f64; 2] {
        self.0.uv(data, hit, at, own)
    }
    fn uv_slope(&self, data: &(), uv_from_world: DMat3) -> UvSlope {
        self.0.uv_slope(data, uv_from_world)
    }
    fn bounds(&self) -> Option<Bounds> {
        self.0.bounds()
    }
    fn bounding_sphere(&self) -> Option<(DVec3, f64)> {
        self.0.bounding_sphere()
    }
    fn contains(&self, point: DVec3) -> bool {
        self.0.contains(point)
    }
    fn thickness(&self) -> f64 {
        self.0.thickness()
    }
}

#[derive(Component, Clone, Debug, Default, PartialEq)]
struct Silver(Mirror);

#[derive(Clone, Debug, Default, PartialEq)]
struct SilverTable {
    colour: Vec<[f64; 3]>,
}

custom_bsdf!(SilverTable, 7, "silver");

impl Table for SilverTable {
    const NAME: &'static str = "silver";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let kind = <Self as pinhole::material::Named>::KIND;
        let colour = |entity| scene.get::<Silver>(entity).map_or([0.0; 3], |own| own.0.colour.to_array());
        Ok(Self { colour: entities_of_kind(scene, kind).into_iter().map(colour).collect() })
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.colour[..])
    }
}

impl Bsdf for SilverTable {
    type Component = Silver;
    const COMPONENT: &'static str = "Silver";
    const WORD: &'static str = "silver";
    const NOUN: &'static str = "silver surface";
    const CLASS: BsdfClass = BsdfClass::Specular;

    fn parameters(silver: &Silver, who: &str) -> Result<Parameters, SceneError> {
        MirrorTable::parameters(&silver.0, who)
    }
    fn specular_directions(&self, context: &ShadingContext, direction: DVec3, normal: DVec3) -> [SpecularSample; 2] {
        let (direction, weight) = (mirror_direction(direction, normal), self.colour[context.row]);
        [SpecularSample { direction, weight, through: false }, SpecularSample::default()]
    }
    fn examples() -> Vec<Example<Silver>> {
        Vec::new()
    }
}

#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
struct Candle(PointLight);

impl SceneLight for Candle {
    const WORD: &'static str = "candle";

    fn casts_shadows(&self) -> bool {
        self.0.casts_shadows
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct PlacedCandle(PlacedPointLight);

custom_light!(PlacedCandle, "candles");

impl Light for PlacedCandle {
    type Component = Candle;
    const IS_DISTANT: bool = false;

    fn place(candle: &Candle, placed: &PlacedLight<'_>) -> Result<Self, SceneError> {
        PlacedPointLight::place(&candle.0, placed).map(Self)
    }
    fn sample(&self, from: DVec3) -> LightSample {
        self.0.sample(from)
    }
    fn power(&self, across: f64) -> [f64; 3] {
        self.0.power(across)
    }
    fn bounds(&self) -> Option<LightBounds> {
        self.0.bounds()
    }
    fn start(&self, targets: &Targets, draws: &StartDraws) -> LightStart {
        self.0.start(targets, draws)
    }
}

fn stages() -> Vec<Stage> {
    let own = of_shape::<PlacedBall>().into_iter().chain(of_material::<SilverTable>());
    every_stage_and(own.chain([of_light::<PlacedCandle>()]))
}

/// What a ball is made of, and what is asked of the camera.
type Case = (&'static str, fn(&mut EntityWorldMut<'_>, bool), fn(&mut EntityWorldMut<'_>));

/// Three balls, a floor and two lights; the balls, one mirror and the lamp are the library's or added.
fn scene((_, made_of, asked): &Case, is_added: bool) -> World {
    let mut scene = World::new();
    add_shape::<PlacedBall>(&mut scene);
    add_material::<SilverTable>(&mut scene);
    add_light::<PlacedCandle>(&mut scene);
    let look = LookAt { eye: DVec3::new(0.0, 1.4, 5.0), target: DVec3::new(0.0, 0.6, 0.0), up: DVec3::Y };
    let fov = PerspectiveCamera { fov: Degrees(36.0), axis: FovAxis::Vertical };
    let mut camera = scene.spawn((Name::new("camera"), fov, look, Resolution { width: 40, height: 24 }));
    camera.insert(Sampling { samples: 4, ..Sampling::default() });
    asked(&mut camera);
    scene.spawn((Name::new("floor"), Plane::default(), Matte { colour: Rgb::grey(0.6) }));
    for (x, radius) in [(-1.3, 0.6), (0.1, 0.7), (1.4, 0.5)] {
        let place = Placement::at(x, radius + 0.01, 0.2 * x);
        let mut ball = scene.spawn((Name::new("ball"), place));
        if is_added {
            ball.insert(Ball(Sphere { radius }));
        } else {
            ball.insert(Sphere { radius });
        }
        made_of(&mut ball, is_added);
    }
    let lamp = PointLight { intensity: Rgb::grey(60.0), ..PointLight::default() };
    let mut light = scene.spawn((Name::new("lamp"), Placement::at(-2.0, 4.0, 2.5)));
    if is_added {
        light.insert(Candle(lamp));
    } else {
        light.insert(lamp);
    }
    let sun = DirectionalLight { irradiance: Rgb::grey(0.4), ..DirectionalLight::default() };
    scene.spawn((sun, LookAt { eye: DVec3::new(2.0, 5.0, 3.0), target: DVec3::ZERO, up: DVec3::Y }));
    scene
}

fn matte(ball: &mut EntityWorldMut<'_>, _: bool) {
    ball.insert(Matte { colour: Rgb::new(0.7, 0.4, 0.2) });
}

fn mirror(ball: &mut EntityWorldMut<'_>, is_added: bool) {
    let mirror = Mirror { colour: Rgb::new(0.9, 0.8, 0.7) };
    if is_added {
        ball.insert(Silver(mirror));
    } else {
        ball.insert(mirror);
    }
}

fn nothing(_: &mut EntityWorldMut<'_>) {}

fn paths(camera: &mut EntityWorldMut<'_>) {
    camera.insert(Integrator::Path { max_depth: 6, lights: LightStrategy::Mis, roulette: 3 });
}

const CASES: &[Case] = &[
    ("matte", matte, nothing),
    ("matte, by paths", matte, paths),
    ("rasterised", matte, |camera| {
        camera.insert(Rasterisation);
    }),
    ("mirrors", mirror, nothing),
    ("mirrors, by paths", mirror, paths),
    ("mirrors, by light tracing", mirror, |camera| {
        paths(camera);
        camera.insert(LightTracing::default());
    }),
    ("glass", |ball, _| _ = ball.insert(Glass::default()), paths),
    (
        "absorbing glass, by light tracing",
        |ball, _| _ = ball.insert(Glass { absorption: Rgb::new(0.2, 0.6, 1.0), ..Glass::default() }),
        |camera| {
            paths(camera);
            camera.insert(LightTracing::default());
        },
    ),
    ("rough glass", |ball, _| _ = ball.insert(RoughGlass::default()), paths),
    (
        "a camera in glass",
        |ball, _| _ = ball.insert(Glass::default()),
        |camera| {
            paths(camera);
            camera.insert(LookAt { eye: DVec3::new(0.1, 0.7, 0.2), target: DVec3::new(-3.0, 0.2, -2.0), up: DVec3::Y });
        },
    ),
    (
        "moving",
        |ball, _| {
            ball.insert((Matte::default(), Motion { velocity: DVec3::new(0.4, 0.3, 0.0) }));
        },
        |camera| {
            camera.insert(Shutter { open: 0.0, close: 1.0 });
        },
    ),
    (
        "moving glass",
        |ball, _| {
            ball.insert((Glass::default(), Motion { velocity: DVec3::new(0.4, 0.3, 0.0) }));
        },
        |camera| {
            paths(camera);
            camera.insert(Shutter { open: 0.0, close: 1.0 });
        },
    ),
    (
        "a veil",
        |ball, _| {
            ball.insert((Matte::default(), Opacity { opacity: 0.5, ..Opacity::default() }));
        },
        paths,
    ),
    (
        "single-sided",
        |ball, _| {
            ball.insert((Matte::default(), SingleSided {}));
        },
        nothing,
    ),
    (
        "checkered by uv, filtered",
        |ball, _| {
            ball.insert((Matte::default(), Checker { size: 0.05, by: TextureBy::Uv, ..Checker::default() }));
        },
        nothing,
    ),
    (
        "checkered in space",
        |ball, _| _ = ball.insert((Matte::default(), Checker { size: 0.2, ..Checker::default() })),
        nothing,
    ),
    ("ambient occlusion", matte, |camera| {
        camera.insert(Integrator::AmbientOcclusion { distance: f64::INFINITY });
    }),
    (
        "Whitted's rays",
        |ball, _| _ = ball.insert(Glass::default()),
        |camera| {
            camera.insert(Integrator::WHITTED);
        },
    ),
];

#[test]
fn what_is_added_makes_the_picture_of_the_librarys_own() {
    let mut wrong = Vec::new();
    for case in CASES {
        let [own, added] = [false, true].map(|is_added| {
            let rendered = render(&scene(case, is_added), &stages(), &Execution::default(), &());
            rendered.map(|rendered| bits(&rendered.film)).map_err(|error| error.to_string())
        });
        match (own, added) {
            (Ok(own), Ok(added)) => {
                let differ = own.iter().zip(&added).filter(|(one, other)| one != other).count();
                let lit = own.iter().filter(|pixel| **pixel != own[0]).count();
                assert!(lit > 200, "{}: only {lit} pixels show something", case.0);
                if differ > 0 {
                    wrong.push(format!("{}: {differ} of {} pixels", case.0, own.len()));
                }
            }
            (own, added) => wrong.push(format!("{}: {:?} and {:?}", case.0, own.err(), added.err())),
        }
    }
    eprintln!("added again: {} cases, {} differ", CASES.len(), wrong.len());
    assert!(wrong.is_empty(), "{wrong:#?}");
}
