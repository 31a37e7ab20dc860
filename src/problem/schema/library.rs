//! Schemas of values that are names out of a list which the check looks them up in.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};

use crate::problem::file::contact::ContactEntry;
use crate::problem::media;
use crate::problem::model::Effect;

/// A medium of the library.
pub(in crate::problem) struct MediumName;

/// A contact of the library.
pub(in crate::problem) struct ContactName;

/// `auto`, `full`, or effects.
pub(in crate::problem) struct ModelName;

/// Contacts by name, of which `use` may hold names out of the library instead.
pub(in crate::problem) struct Contacts;

fn contact_names() -> Vec<&'static str> {
    media::contacts().iter().map(|known| known.name).collect()
}

macro_rules! inline_schemas {
    ($($name:ident: $schema:expr;)*) => {$(
        impl JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                let schema: fn(&mut SchemaGenerator) -> Schema = $schema;
                schema(generator)
            }
        }
    )*};
}

inline_schemas! {
    MediumName: |_| {
        let names: Vec<&str> = media::media().iter().map(|known| known.name).collect();
        json_schema!({ "enum": names })
    };
    ContactName: |_| json_schema!({ "enum": contact_names() });
    ModelName: |_| json_schema!({
        "anyOf": [
            { "enum": ["auto", "full"] },
            { "type": "array", "items": { "enum": Effect::ALL.map(Effect::name) } },
        ],
    });
    Contacts: |generator| {
        let own = generator.subschema_for::<ContactEntry>();
        json_schema!({
            "type": "object",
            "properties": {
                "use": {
                    "description": "Contacts of the library, `peenpose media`, beside the file's own.",
                    "anyOf": [
                        { "enum": contact_names() },
                        { "type": "array", "minItems": 1, "items": { "enum": contact_names() } },
                        own,
                    ],
                },
            },
            "additionalProperties": own,
        })
    };
}
