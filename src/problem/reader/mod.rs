//! The tree of the file to typed values, without stopping at the first fault.
//!
//! A serde deserializer over [`Node`]. Every error is recorded once, at the innermost value that
//! it concerns, before it is returned; [`Field`](super::field::Field) then swallows it. Three
//! conventions carry meaning through serde's derived code:
//!
//! - a newtype struct whose serde name is that of a dimension (`length`, `speed`, ...) is a
//!   quantity with a unit and arrives in SI;
//! - an enum with variants called `scalar`, `list` or `map` is chosen by the form of the value,
//!   and its serde name says in messages what is expected;
//! - any other enum is a name out of a list.

mod access;
mod error;
mod scalar;

use serde::Deserializer;
use serde::de::{IntoDeserializer, Visitor};
use serde::forward_to_deserialize_any;

use access::{Entries, Form, Items};
use error::ReadError;

use super::fault::{Fault, one_of};
use super::fault_code::FaultCode;
use super::faults::Faults;
use super::yaml::{Entry, Node, Value};
use crate::units::{Dimension, shortened};

/// One node on its way to a typed value.
pub(super) struct Reader<'a> {
    node: &'a Node,
    key: String,
    faults: &'a Faults<'a>,
}

impl<'a> Reader<'a> {
    pub fn new(node: &'a Node, faults: &'a Faults<'a>) -> Self {
        Self {
            node,
            key: String::new(),
            faults,
        }
    }

    fn items(&self, expected: &str) -> Result<Items<'a>, ReadError> {
        match &self.node.value {
            Value::List(items) => Ok(Items {
                rest: items.iter().enumerate(),
                key: self.key.clone(),
                faults: self.faults,
            }),
            _ => Err(self.unexpected(expected)),
        }
    }

    fn entries(&self) -> Result<&'a [Entry], ReadError> {
        match &self.node.value {
            Value::Map(entries) => Ok(entries),
            _ => Err(self.unexpected("a group of keys")),
        }
    }

    fn access(&self, entries: Vec<&'a Entry>) -> Entries<'a> {
        Entries {
            rest: entries.into_iter(),
            current: None,
            key: self.key.clone(),
            faults: self.faults,
        }
    }

    fn form(&self) -> &'static str {
        match self.node.value {
            Value::Null | Value::Number(_) | Value::Text(_) => "scalar",
            Value::List(_) => "list",
            Value::Map(_) => "map",
        }
    }
}

macro_rules! whole_numbers {
    ($($method:ident)*) => {$(
        fn $method<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, ReadError> {
            let value = self.whole_number()?;
            self.record(visitor.visit_u64(value))
        }
    )*};
}

impl<'a> Deserializer<'a> for Reader<'a> {
    type Error = ReadError;

    fn deserialize_any<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, ReadError> {
        match &self.node.value {
            Value::Null => self.record(visitor.visit_unit()),
            Value::Number(_) => self.deserialize_f64(visitor),
            Value::Text(text) => self.record(visitor.visit_str(text)),
            Value::List(_) => self.deserialize_seq(visitor),
            Value::Map(_) => self.deserialize_map(visitor),
        }
    }

    fn deserialize_option<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, ReadError> {
        match self.node.value {
            Value::Null => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_f64<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, ReadError> {
        let value = self.number()?;
        self.record(visitor.visit_f64(value))
    }

    fn deserialize_f32<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, ReadError> {
        self.deserialize_f64(visitor)
    }

    whole_numbers! {
        deserialize_u8 deserialize_u16 deserialize_u32 deserialize_u64
        deserialize_i8 deserialize_i16 deserialize_i32 deserialize_i64
    }

    fn deserialize_str<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, ReadError> {
        let text = self.text()?;
        self.record(visitor.visit_str(text))
    }

    fn deserialize_string<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, ReadError> {
        self.deserialize_str(visitor)
    }

    fn deserialize_newtype_struct<V: Visitor<'a>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        let dimension = Dimension::ALL
            .into_iter()
            .find(|dimension| dimension.name() == name);
        match dimension {
            Some(dimension) => {
                let si = self.quantity(dimension)?;
                self.record(visitor.visit_newtype_struct(si.into_deserializer()))
            }
            None => visitor.visit_newtype_struct(self),
        }
    }

    fn deserialize_seq<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, ReadError> {
        let items = self.items("a list")?;
        self.record(visitor.visit_seq(items))
    }

    fn deserialize_tuple<V: Visitor<'a>>(
        self,
        length: usize,
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        let expected = match length {
            2 => "a list of 2, `[.., ..]`",
            _ => "a list of 3, `[x, y, z]`",
        };
        let items = self.items(expected)?;
        let found = items.rest.len();
        if found != length {
            return Err(self.refuse(
                FaultCode::WrongLength,
                format!("is a list of {found}"),
                expected,
            ));
        }
        self.record(visitor.visit_seq(items))
    }

    fn deserialize_map<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, ReadError> {
        let entries = self.entries()?.iter().collect();
        self.record(visitor.visit_map(self.access(entries)))
    }

    fn deserialize_struct<V: Visitor<'a>>(
        self,
        _: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        let (known, unknown): (Vec<&Entry>, Vec<&Entry>) = self
            .entries()?
            .iter()
            .partition(|entry| fields.contains(&entry.key.as_str()));
        for entry in unknown {
            self.faults
                .push_unknown_key(&self.key, &entry.key, entry.key_span, fields);
        }
        self.record(visitor.visit_map(self.access(known)))
    }

    fn deserialize_enum<V: Visitor<'a>>(
        self,
        name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        let by_form = ["scalar", "list", "map"]
            .iter()
            .any(|form| variants.contains(form));
        if by_form {
            let form = self.form();
            return if variants.contains(&form) {
                visitor.visit_enum(Form { form, reader: self })
            } else {
                Err(self.unexpected(name))
            };
        }
        let text = match &self.node.value {
            Value::Text(text) | Value::Number(text) => text,
            _ => return Err(self.unexpected(&one_of(variants))),
        };
        match variants.iter().find(|variant| *variant == text) {
            Some(variant) => self.record(visitor.visit_enum((*variant).into_deserializer())),
            None if text.trim().is_empty() => Err(self.no_value(&one_of(variants))),
            None => {
                let message = format!("`{}` is not known", shortened(text));
                Err(self.push(
                    Fault::at_key(FaultCode::UnknownWord, &self.key, message)
                        .expecting(one_of(variants))
                        .nearest(text, variants.iter().copied()),
                ))
            }
        }
    }

    fn deserialize_ignored_any<V: Visitor<'a>>(self, visitor: V) -> Result<V::Value, ReadError> {
        visitor.visit_unit()
    }

    forward_to_deserialize_any! {
        <V: Visitor<'a>>
        bool i128 u128 char bytes byte_buf unit unit_struct tuple_struct identifier
    }
}
