//! Names → the entities that they refer to.

use super::found::shown;
use super::mistake::{Mistake, place_of};
use super::nearest::nearest;
use super::read::{FileEntity, FilePart, quoted, read_value};
use super::scan::Part;
use std::collections::HashMap;

/// The greatest depth of the hierarchy.
const MAX_PARENTS: usize = 64;

/// Looks up every parent and every material by name, and checks that the hierarchy has no cycle.
pub fn resolve(text: &str, entities: &mut [FileEntity]) -> Result<(), Mistake> {
    let mut named: HashMap<String, Vec<usize>> = HashMap::new();
    for (number, entity) in entities.iter().enumerate() {
        if let Some(name) = &entity.name {
            named.entry(name.clone()).or_default().push(number);
        }
    }
    for number in 0..entities.len() {
        for (word, noun) in [("parent", "a parent"), ("material", "the owner of its material")] {
            let entity = &entities[number];
            let Some(part) = entity.parts.iter().find(|part| part.word == word) else { continue };
            let other = find(text, entities, &named, number, part)?;
            if other == number {
                let what = format!("{}: {word} is this entity itself, but {noun} must be another", who(entity));
                return Err(Mistake::new(part.value.start, what));
            }
            match word {
                "parent" => entities[number].parent = Some(other),
                _ => entities[number].material = Some(other),
            }
        }
    }
    check_parents(entities)
}

fn find(
    text: &str,
    entities: &[FileEntity],
    named: &HashMap<String, Vec<usize>>,
    number: usize,
    part: &FilePart,
) -> Result<usize, Mistake> {
    let who = who(&entities[number]);
    let name: String = read_value(text, &Part { word: &part.word, at: part.at, value: part.value.clone() }, &who)?;
    let what = match named.get(&name).map_or([].as_slice(), |found| found) {
        [one] => return Ok(*one),
        [first, .., last] => {
            let [first, last] = [first, last].map(|&number| place_of(text, entities[number].at).line);
            let is_called = format!("several entities have that name, the first on line {first}, the last on {last}");
            format!("{who}: {} is {}, but {is_called}", part.word, shown(&format!("\"{name}\"")))
        }
        [] => {
            let nearest = nearest(named.keys().map(String::as_str), &name);
            let nearest = nearest.map_or(String::new(), |nearest| format!("; the nearest is {}", quoted(nearest)));
            let missing = format!("no entity has that name{nearest}");
            format!("{who}: {} is {}, but {missing}", part.word, shown(&format!("\"{name}\"")))
        }
    };
    Err(Mistake::new(part.value.start, what))
}

fn check_parents(entities: &[FileEntity]) -> Result<(), Mistake> {
    for (number, entity) in entities.iter().enumerate() {
        let mut steps = 0;
        let (mut at, mut above) = (number, vec![number]);
        while let Some(parent) = entities[at].parent {
            steps += 1;
            let circle = above.contains(&parent);
            if circle || steps > MAX_PARENTS {
                let found = if circle {
                    format!("forms a cycle through {}", who(&entities[parent]))
                } else {
                    format!("has more than {MAX_PARENTS} ancestors")
                };
                let accepted = format!("parents must lead to a root entity in at most {MAX_PARENTS} steps");
                let place = entity.parts.iter().find(|part| part.word == "parent");
                let place = place.map_or(entity.at, |part| part.value.start);
                return Err(Mistake::new(place, format!("{}: parent {found}, but {accepted}", who(entity))));
            }
            above.push(parent);
            at = parent;
        }
    }
    Ok(())
}

fn who(entity: &FileEntity) -> String {
    entity.name.as_ref().map_or_else(|| "an unnamed entity".into(), |name| quoted(name))
}
