//! A problem file as it was written: one type per group of keys, one field per key.
//!
//! Plain data. Quantities are in SI already; what they mean together is checked elsewhere. The JSON
//! Schema and `docs/problem-file.md` are made from these types: the comment of a type is the text
//! above its keys, that of a field what its key means. `; .. where absent.` at the end of a comment
//! says what holds where a key is absent and no plain value, given as `default`, would do.

pub(super) mod contact;
pub(super) mod equipment;
mod form;
pub(super) mod quantity;
pub(super) mod scene;
pub(super) mod settings;
pub(super) mod stroke;

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, Visitor};

use contact::ContactsItem;
use equipment::{CoverageEntry, JetEntry, NozzleEntry, PathsEntry, ShotEntry, SurfaceEntry};
use scene::{PartEntry, TargetEntry};
use settings::{GoalsEntry, OneOrMany, SettingsEntry, SolveEntry, ToleranceEntry};
use stroke::StrokeEntry;

use super::field::{Field, Needed};
use crate::problem::LengthUnit;

/// The format that is read.
pub(super) const FORMAT: u64 = 1;

/// What a part looks like, what the jet is, what its target must receive and what the surfaces
/// around it may take.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
#[schemars(title = "peenpose problem file")]
pub(super) struct ProblemFile {
    /// Version of the file format.
    #[schemars(example = FORMAT, extend("const" = FORMAT))]
    pub format: Needed<u64>,
    /// What the problem is about; the name of the file where absent.
    #[schemars(example = &"Keyway floor")]
    pub title: Field<String>,
    /// Unit of coordinate lists and mesh files, which need it; none, for a file without any, where
    /// absent.
    #[schemars(example = &"mm")]
    pub lengths_in: Field<LengthUnit>,
    /// Named parts.
    #[schemars(extend("minProperties" = 1, "propertyNames" = form::names()))]
    pub scene: Needed<Named<PartEntry>>,
    /// What is to be peened.
    pub target: Needed<TargetEntry>,
    /// The shot.
    pub shot: Needed<ShotEntry>,
    /// How the shots leave the nozzle.
    pub jet: Needed<JetEntry>,
    /// The body that carries the jet; a nozzle that takes no room where absent.
    pub nozzle: Field<NozzleEntry>,
    /// The friction choices, such as lubricants, by name.
    #[schemars(
        with = "Needed<contact::ContactsSchema>",
        extend("minProperties" = 1, "propertyNames" = form::names())
    )]
    pub contacts: Needed<Named<ContactsItem>>,
    /// Where the nozzle travels while it peens; nowhere, for a spot, where absent.
    pub stroke: Field<StrokeEntry>,
    /// What may be chosen.
    pub settings: Needed<SettingsEntry>,
    /// What must be reached and what must not happen.
    pub goals: Needed<GoalsEntry>,
    /// Where one surface, by its full name, differs from the others; nowhere where absent.
    pub surfaces: Field<Named<SurfaceEntry>>,
    /// When a path ends; the defaults of its keys where absent.
    pub paths: Field<PathsEntry>,
    /// What is to be said about coverage; nothing where absent.
    pub coverage: Field<CoverageEntry>,
    /// How exactly a shop sets the settings; exactly where absent.
    pub tolerance: Field<ToleranceEntry>,
    /// Which effects are modelled. `auto` models all of them and gives a pose no more shots once it cannot
    /// become better; `full` saves nothing; what a list does not name is not modelled at all, in the search
    /// and in the figures. The [effects](#model) are listed at the end.
    #[schemars(
        with = "Field<form::ModelName>",
        example = ["rebounds", "spin"],
        extend("default" = "auto")
    )]
    pub model: Field<OneOrMany>,
    /// How the answer is searched; the defaults of its keys where absent.
    pub solve: Field<SolveEntry>,
}

/// Three coordinates in `lengths_in`, or a direction.
pub(super) type Triple = [Field<f64>; 3];

/// Two coordinates in `lengths_in`.
pub(super) type Pair = [Field<f64>; 2];

/// Names with a value each, in the order of the file.
#[derive(Clone, Debug)]
pub(super) struct Named<T>(pub Vec<(String, Needed<T>)>);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Named<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NamedVisitor<T>(PhantomData<T>);

        impl<'de, T: Deserialize<'de>> Visitor<'de> for NamedVisitor<T> {
            type Value = Named<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("names with a value each")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Named<T>, A::Error> {
                let mut entries = Vec::new();
                while let Some(entry) = map.next_entry()? {
                    entries.push(entry);
                }
                Ok(Named(entries))
            }
        }

        deserializer.deserialize_map(NamedVisitor(PhantomData))
    }
}

impl<T: JsonSchema> JsonSchema for Named<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("Named_{}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": "object",
            "additionalProperties": generator.subschema_for::<T>(),
        })
    }
}
