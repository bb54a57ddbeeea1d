//! What a file has that is not read, wherever it stands.

use super::document::{Document, EXTENSIONS};
use super::json::Json;
use crate::model_error::ModelError;
use crate::remarks::Remarks;
use std::collections::BTreeSet;

/// Notes the extensions of a file that are not read.
pub fn remark_unread<'a>(document: &Document<'a>, json: &'a Json<'a>, remarks: &mut Remarks) -> Result<(), ModelError> {
    let required: BTreeSet<&str> = texts(document.root.list("extensionsRequired")?).collect();
    let mut say = |name: &str| {
        let why = if required.contains(name) { ", which the file requires" } else { "" };
        remarks.add_unread(&format!("the extension {name}{why}"), 1);
    };
    let mut seen = BTreeSet::new();
    let is_unread = |name: &&str| !EXTENSIONS.contains(name);
    extensions_in(json, &mut |name| {
        if is_unread(&name) {
            say(name);
            seen.insert(name);
        }
    });
    // Those that are listed, but used at no place where an extension stands.
    let listed: BTreeSet<&str> = texts(document.root.list("extensionsUsed")?).collect();
    listed.union(&required).filter(|name| is_unread(name) && !seen.contains(*name)).for_each(|name| say(name));
    Ok(())
}

fn texts<'a>(list: &'a [Json<'a>]) -> impl Iterator<Item = &'a str> {
    list.iter().filter_map(|json| if let Json::Text(text) = json { Some(&**text) } else { None })
}

/// Calls a function with the name of each extension in a value; JSON is nested 128 deep at most.
fn extensions_in<'a>(json: &'a Json<'a>, found: &mut impl FnMut(&'a str)) {
    match json {
        Json::List(list) => list.iter().for_each(|json| extensions_in(json, found)),
        Json::Object(fields) => {
            for (name, value) in fields {
                if let ("extensions", Json::Object(extensions)) = (&**name, value) {
                    extensions.iter().for_each(|(name, _)| found(name));
                }
                // Applications may put anything into `extras`.
                if name != "extras" {
                    extensions_in(value, found);
                }
            }
        }
        _ => {}
    }
}
