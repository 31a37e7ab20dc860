//! Numbers, quantities and texts, and how everything else is refused.

use super::Reader;
use super::error::ReadError;
use crate::problem::fault::Fault;
use crate::problem::fault_code::FaultCode;
use crate::problem::yaml::Value;
use crate::units::{self, Dimension, UnitFault, shortened};

impl<'a> Reader<'a> {
    /// Records a fault of this very node.
    pub(super) fn refuse(
        &self,
        rule: FaultCode,
        message: impl Into<String>,
        expected: impl Into<String>,
    ) -> ReadError {
        self.push(Fault::at_key(rule, &self.key, message).expecting(expected))
    }

    /// Refuses a text without a letter.
    pub(super) fn no_value(&self, expected: &str) -> ReadError {
        self.refuse(FaultCode::EmptyText, "has no value", expected)
    }

    pub(super) fn push(&self, mut fault: Fault) -> ReadError {
        if self.key.is_empty() {
            fault.at = Some(self.node.span);
        }
        self.faults.push(fault);
        ReadError::Recorded
    }

    /// Records an error that a visitor has raised over this node.
    pub(super) fn record<T>(&self, result: Result<T, ReadError>) -> Result<T, ReadError> {
        result.map_err(|error| match error {
            ReadError::Recorded => ReadError::Recorded,
            ReadError::Fresh { message, expected } => {
                let mut fault = Fault::at_key(FaultCode::WrongKind, &self.key, message);
                fault.expected = expected;
                self.push(fault)
            }
        })
    }

    /// Refuses the kind of value that stands here.
    pub(super) fn unexpected(&self, expected: &str) -> ReadError {
        let found = match &self.node.value {
            Value::Text(text) if text.trim().is_empty() => return self.no_value(expected),
            Value::Null => "has no value".to_owned(),
            Value::Number(text) => format!("`{text}` is a number"),
            Value::Text(text) => format!("`{}` is text", shortened(text)),
            Value::List(_) => "is a list".to_owned(),
            Value::Map(_) => "is a group of keys".to_owned(),
        };
        self.refuse(FaultCode::WrongKind, found, expected)
    }

    /// Refuses a number that is text.
    pub(super) fn in_quotes(&self, text: &str, expected: &str) -> ReadError {
        let message = format!("`{}` is text", shortened(text));
        let expected = format!("{expected}, without quotes");
        self.refuse(FaultCode::WrongKind, message, expected)
    }

    /// A bare number.
    pub(super) fn number(&self) -> Result<f64, ReadError> {
        const EXPECTED: &str = "a plain number such as 0.25";
        let text = match &self.node.value {
            Value::Number(text) => text,
            Value::Text(text) if units::parse_number(text).is_some() => {
                return Err(self.in_quotes(text, EXPECTED));
            }
            _ => return Err(self.unexpected(EXPECTED)),
        };
        match units::parse_number(text) {
            Some(value) if value.is_finite() => Ok(value),
            Some(_) => Err(self.refuse(
                FaultCode::Overflow,
                format!("`{text}` is too large a number"),
                EXPECTED,
            )),
            None => Err(self.refuse(
                FaultCode::NotAPlainNumber,
                format!("`{text}` is not a plain number"),
                EXPECTED,
            )),
        }
    }

    pub(super) fn whole_number(&self) -> Result<u64, ReadError> {
        const EXPECTED: &str = "a whole number, 0 or more";
        let text = match &self.node.value {
            Value::Number(text) => text,
            Value::Text(text) if text.parse::<u64>().is_ok() => {
                return Err(self.in_quotes(text, EXPECTED));
            }
            _ => return Err(self.unexpected(EXPECTED)),
        };
        text.parse().map_err(|_| {
            self.refuse(
                FaultCode::NotAWholeNumber,
                format!("`{text}` is not a whole number"),
                EXPECTED,
            )
        })
    }

    pub(super) fn quantity(&self, dimension: Dimension) -> Result<f64, ReadError> {
        let (Value::Text(text) | Value::Number(text)) = &self.node.value else {
            return Err(self.unexpected(dimension.described()));
        };
        units::parse(dimension, text).map_err(|unit_fault| {
            let mut fault = Fault::at_key(rule_of(&unit_fault), &self.key, unit_fault.message())
                .expecting(unit_fault.expected());
            fault.suggestion = unit_fault.suggestion();
            self.push(fault)
        })
    }

    pub(super) fn text(&self) -> Result<&'a str, ReadError> {
        match &self.node.value {
            Value::Text(text) | Value::Number(text) => Ok(text),
            _ => Err(self.unexpected("text")),
        }
    }
}

/// Why a text is not a quantity.
fn rule_of(fault: &UnitFault) -> FaultCode {
    match fault {
        UnitFault::NotANumber { text, .. } if text.is_empty() => FaultCode::EmptyText,
        UnitFault::NotANumber { .. } => FaultCode::NotAQuantity,
        UnitFault::MissingUnit { .. } => FaultCode::NoUnit,
        UnitFault::UnknownUnit { .. } => FaultCode::UnknownUnit,
        UnitFault::WrongDimension { .. } => FaultCode::WrongDimension,
        UnitFault::TooLarge { .. } => FaultCode::Overflow,
    }
}
