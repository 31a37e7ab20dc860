//! Walking through lists, groups of keys, and enums.

use serde::Deserializer;
use serde::de::value::StrDeserializer;
use serde::de::{DeserializeSeed, EnumAccess, Error, IntoDeserializer, MapAccess, SeqAccess};
use serde::de::{VariantAccess, Visitor};

use super::Reader;
use super::error::ReadError;
use crate::problem::faults::Faults;
use crate::problem::source::{child_key, item_key};
use crate::problem::yaml::{Entry, Node};

/// The rest of a list.
pub(super) struct Items<'a> {
    pub rest: std::iter::Enumerate<std::slice::Iter<'a, Node>>,
    pub key: String,
    pub faults: &'a Faults<'a>,
}

impl<'a> SeqAccess<'a> for Items<'a> {
    type Error = ReadError;

    fn next_element_seed<T: DeserializeSeed<'a>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, ReadError> {
        let Some((index, node)) = self.rest.next() else {
            return Ok(None);
        };
        let reader = Reader {
            node,
            key: item_key(&self.key, index),
            faults: self.faults,
        };
        seed.deserialize(reader).map(Some)
    }
}

/// The rest of a group of keys.
pub(super) struct Entries<'a> {
    pub rest: std::vec::IntoIter<&'a Entry>,
    pub current: Option<&'a Entry>,
    pub key: String,
    pub faults: &'a Faults<'a>,
}

impl<'a> MapAccess<'a> for Entries<'a> {
    type Error = ReadError;

    fn next_key_seed<K: DeserializeSeed<'a>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, ReadError> {
        self.current = self.rest.next();
        let Some(entry) = self.current else {
            return Ok(None);
        };
        let name: StrDeserializer<'_, ReadError> = entry.key.as_str().into_deserializer();
        seed.deserialize(name).map(Some)
    }

    fn next_value_seed<V: DeserializeSeed<'a>>(&mut self, seed: V) -> Result<V::Value, ReadError> {
        let Some(entry) = self.current.take() else {
            return Err(ReadError::custom("a value was asked for before its key"));
        };
        seed.deserialize(Reader {
            node: &entry.node,
            key: child_key(&self.key, &entry.key),
            faults: self.faults,
        })
    }
}

/// An enum that is chosen by the form of its value.
pub(super) struct Form<'a> {
    pub form: &'static str,
    pub reader: Reader<'a>,
}

impl<'a> EnumAccess<'a> for Form<'a> {
    type Error = ReadError;
    type Variant = Reader<'a>;

    fn variant_seed<V: DeserializeSeed<'a>>(
        self,
        seed: V,
    ) -> Result<(V::Value, Reader<'a>), ReadError> {
        let form: StrDeserializer<'_, ReadError> = self.form.into_deserializer();
        Ok((seed.deserialize(form)?, self.reader))
    }
}

impl<'a> VariantAccess<'a> for Reader<'a> {
    type Error = ReadError;

    fn unit_variant(self) -> Result<(), ReadError> {
        Ok(())
    }

    fn newtype_variant_seed<T: DeserializeSeed<'a>>(self, seed: T) -> Result<T::Value, ReadError> {
        seed.deserialize(self)
    }

    fn tuple_variant<V: Visitor<'a>>(
        self,
        length: usize,
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        self.deserialize_tuple(length, visitor)
    }

    fn struct_variant<V: Visitor<'a>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, ReadError> {
        self.deserialize_struct("", fields, visitor)
    }
}
