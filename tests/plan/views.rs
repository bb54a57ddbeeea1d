//! What a view paints, and what it answers to a word it does not know.

use super::*;
use pinhole::rays::Tile;
use pinhole::render::first_bounce_only;
use scenes::followed::{INTEGRATORS, followed};

#[test]
fn a_view_of_an_unknown_word_names_what_is_on_offer() {
    let words = ["", "surfaces", "Surface", "pixel", "nonsense"];
    for word in words {
        let mut scene = toggled(&[Toggle::Sphere]);
        let camera = named(&mut scene, "camera");
        scene.entity_mut(camera).insert(View { column: word.into() });
        let error = plan(&Census::of(&scene), &offer()).expect_err("no such column");
        let PlanError::NoSuchView { wanted, why } = &error else { panic!("{error}") };
        assert_eq!(wanted, word);
        for name in view_names(&offer()).into_iter().filter(|name| !name.ends_with(" rows")) {
            assert!(why.contains(name), "`{word}`: {why} must name `{name}`");
        }
        assert_eq!(error.to_string(), format!("the view asks for the column `{word}`, but {why}"));
    }
    eprintln!("views: {} unknown words, each answered with {:?}", words.len(), view_names(&offer()));
}

/// A view runs fewer stages than the picture does, but those that run write the very same numbers.
#[test]
fn a_view_paints_the_columns_of_the_whole_picture() {
    let (mut compared, mut seen) = (0, BTreeSet::new());
    let sampled = |setup: Setup| {
        let mut scene = full(setup);
        let camera = named(&mut scene, "camera");
        let sampling = Sampling { samples: 1, filter: Filter::Box { radius: 0.5 }, ..Sampling::default() };
        scene.entity_mut(camera).insert(sampling);
        scene
    };
    let paths = |setup: Setup| followed(INTEGRATORS[6], setup);
    let scenes: [fn(Setup) -> World; 11] = [
        full,
        stretched,
        shapes_of_all_kinds,
        shining,
        textured,
        soft,
        sampled,
        scenes::blurred,
        scenes::moving,
        scenes::material::specular,
        paths,
    ];
    for (eye, scene_of) in EYES.into_iter().flat_map(|eye| scenes.map(|scene| (eye, scene))) {
        let setup = Setup { eye, size: [40, 33], ..Setup::default() };
        let whole = inspect(&scene_of(setup), &first_bounce_only(&offer()), 32).expect("inspects");
        for column in &whole.plan.columns {
            if !column.is_viewed() || column.name == "radiance" {
                continue;
            }
            let mut scene = scene_of(setup);
            let camera = named(&mut scene, "camera");
            scene.entity_mut(camera).insert(View { column: column.name.into() });
            let viewed = film(&scene);
            let tiles: Vec<FilmTile> =
                whole.tiles.iter().map(|&tile| painted(&whole.world.entity(tile), column, whole.image)).collect();
            let expected = FilmBits::of_tiles(whole.image.width, whole.image.height, tiles.iter());
            viewed.assert_is(&expected, &format!("{eye:?}, view of {}", column.name));
            if viewed.colours() > 1 {
                seen.insert(format!("{eye:?} {}", column.name));
            }
            compared += 1;
        }
    }
    // No scene of one sample has rough glass; a sample's sign is what the film weights its view by; pdfs of light rays are there only where MIS needs them;
    // the first sample of every pixel has one number; tests are counted only where a view asks (tests/counted.rs).
    // No paths are joined here. No scene here has maps, or glass that touches other glass.
    let maps = ["metallic roughness", "emission factor", "contacts", "join ratios"];
    let unseen =
        [&["radiance", "sign", "light pdf", "samples", "transmissive rows", "boxes", "tests", "depth"][..], &maps]
            .concat();
    let views = view_names(&offer()).into_iter().filter(|name| !unseen.contains(name));
    let missing = views.flat_map(|name| EYES.map(|eye| format!("{eye:?} {name}"))).filter(|name| !seen.contains(name));
    // Parallel rays have no lens, and all of them one direction.
    let parallel = ["Orthographic lens", "Orthographic camera", "Orthographic world"];
    let missing: Vec<_> = missing.filter(|name| !parallel.contains(&name.as_str())).collect();
    assert!(missing.is_empty(), "of one colour in every scene: {missing:?}");
    eprintln!("views: {compared} views, each equal to its column of the whole picture");
}

/// What a view of a column must show: a pixel's first row, black without one.
fn painted(tile: &EntityRef<'_>, column: &ColumnKind, image: ImageFrame) -> FilmTile {
    let mut film = FilmTile::new(*tile.get::<Tile>().expect("a tile"));
    let rows = (column.rows)(tile);
    let components = (column.components)(tile);
    let paths = components.iter().find(|component| component.name == "row").map(|component| component.values);
    for path in 0..film.count.len() {
        let first = match paths {
            Some(ComponentValues::U32(paths)) => paths.iter().position(|&own| own as usize == path),
            _ => (path < rows).then_some(path),
        };
        let paint = |row| (column.paint)(tile, row, [image.width, image.height]);
        film.add(path, first.map_or([0.0; 3], paint));
    }
    film
}
