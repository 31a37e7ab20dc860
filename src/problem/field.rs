//! One key of the file: absent, faulty or present.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;
use std::ops::Deref;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::{Deserialize, Deserializer, Visitor};

/// The value of a key. Reading goes on after a faulty one, whose fault is on record.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Field<T> {
    /// The key is absent or has no value.
    #[default]
    Missing,
    /// The value could not be read; the reader has recorded why.
    Faulty,
    /// The value.
    Present(T),
}

impl<T> Field<T> {
    /// The value if it is there and sound.
    pub fn value(&self) -> Option<&T> {
        match self {
            Self::Present(value) => Some(value),
            Self::Missing | Self::Faulty => None,
        }
    }

    /// Whether the key is there, sound or not.
    pub fn is_given(&self) -> bool {
        !matches!(self, Self::Missing)
    }
}

impl<T: Clone> Field<T> {
    /// The value, or `default` where the key is absent; `None` where it is faulty.
    pub fn or(&self, default: T) -> Option<T> {
        match self {
            Self::Present(value) => Some(value.clone()),
            Self::Missing => Some(default),
            Self::Faulty => None,
        }
    }
}

/// The value of a key that must be there: the check asks for it, and so does the schema.
#[derive(Clone, Copy, Debug, PartialEq, serde::Deserialize)]
#[serde(transparent, bound = "T: Deserialize<'de>")]
pub(super) struct Needed<T>(Field<T>);

impl<T> Default for Needed<T> {
    fn default() -> Self {
        Self(Field::Missing)
    }
}

impl<T> From<T> for Needed<T> {
    fn from(value: T) -> Self {
        Self(Field::Present(value))
    }
}

impl<T> Deref for Needed<T> {
    type Target = Field<T>;

    fn deref(&self) -> &Field<T> {
        &self.0
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Field<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct FieldVisitor<T>(PhantomData<T>);

        impl<'de, T: Deserialize<'de>> Visitor<'de> for FieldVisitor<T> {
            type Value = Field<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a value")
            }

            fn visit_none<E>(self) -> Result<Field<T>, E> {
                Ok(Field::Missing)
            }

            fn visit_some<D: Deserializer<'de>>(self, value: D) -> Result<Field<T>, D::Error> {
                Ok(T::deserialize(value).map_or(Field::Faulty, Field::Present))
            }
        }

        deserializer.deserialize_option(FieldVisitor(PhantomData))
    }
}

/// What marks the schema of a key that must be there.
pub(super) const NEEDED: &str = "x-needed";

impl<T: JsonSchema> JsonSchema for Field<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        generator.subschema_for::<T>()
    }
}

impl<T: JsonSchema> JsonSchema for Needed<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = generator.subschema_for::<T>();
        schema.insert(NEEDED.into(), true.into());
        schema
    }
}
