//! One group of keys under check: its key path, and the record of faults.

use crate::problem::fault::Fault;
use crate::problem::fault_code::FaultCode;
use crate::problem::faults::Faults;
use crate::problem::field::{Field, Needed};
use crate::problem::file::quantity::Quantity;
use crate::problem::file::settings::OneOrRange;
use crate::problem::setting::Range;
use crate::problem::source::{child_key, item_key};

use crate::problem::Limit;
use crate::problem::name::{NAME_EXPECTED, is_name};

/// One group of keys under check.
#[derive(Clone)]
pub(super) struct Scope<'a> {
    key: String,
    faults: &'a Faults<'a>,
}

impl<'a> Scope<'a> {
    /// The file as a whole.
    pub fn root(faults: &'a Faults<'a>) -> Self {
        Self {
            key: String::new(),
            faults,
        }
    }

    /// The group `name` within this one.
    pub fn of(&self, name: &str) -> Self {
        Self {
            key: child_key(&self.key, name),
            faults: self.faults,
        }
    }

    /// One item of this list.
    pub fn item(&self, index: usize) -> Self {
        Self {
            key: item_key(&self.key, index),
            faults: self.faults,
        }
    }

    /// A fault of the key `name`, not yet on record.
    pub fn fault(&self, rule: FaultCode, name: &str, message: impl Into<String>) -> Fault {
        Fault::at_key(rule, child_key(&self.key, name), message)
    }

    /// A fault of the group itself, not yet on record.
    pub fn own_fault(&self, rule: FaultCode, message: impl Into<String>) -> Fault {
        Fault::at_key(rule, &self.key, message)
    }

    /// Puts a fault on record, where the value of its key stands.
    pub fn report(&self, fault: Fault) {
        self.faults.push(fault);
    }

    /// Puts a fault on record, where the last name of its key stands.
    pub fn report_name(&self, fault: Fault) {
        self.faults.push_at_name(fault);
    }

    /// The value of a key that must be there.
    pub fn required<'f, T>(
        &self,
        name: &str,
        field: &'f Needed<T>,
        expected: &str,
    ) -> Option<&'f T> {
        self.required_here(name, field, expected)
    }

    /// The value of a key that must be there because of what stands, or does not stand, beside it.
    pub fn required_here<'f, T>(
        &self,
        name: &str,
        field: &'f Field<T>,
        expected: &str,
    ) -> Option<&'f T> {
        // A misspelt key has been reported already, with the name that it should have.
        if !field.is_given() && !self.faults.misspelt(&self.key, name) {
            let nozzle_frames = self.faults.source.has(&child_key(&self.key, name));
            let message = if nozzle_frames {
                "has no value"
            } else {
                "is missing"
            };
            let fault = self.fault(FaultCode::Missing, name, message);
            self.report(fault.expecting(expected));
        }
        field.value()
    }

    /// Whether an unknown key of this group was probably meant to be `name`.
    pub fn is_misspelt(&self, name: &str) -> bool {
        self.faults.misspelt(&self.key, name)
    }

    /// A key that must be there, within its limits.
    pub fn needed<Q: Quantity>(&self, name: &str, field: &Needed<Q>) -> Option<f64> {
        self.needed_here(name, field)
    }

    /// The same for a key that must be there because of what does not stand beside it.
    pub fn needed_here<Q: Quantity>(&self, name: &str, field: &Field<Q>) -> Option<f64> {
        let value = self.required_here(name, field, Q::LIMIT.expected)?;
        self.sound(name, *value)
    }

    /// The number of a value that is within its limits.
    pub fn sound<Q: Quantity>(&self, name: &str, value: Q) -> Option<f64> {
        self.within(name, value.si(), Q::LIMIT)
    }

    /// A key that has a default, within its limits.
    pub fn optional<Q: Quantity>(&self, name: &str, field: &Field<Q>, default: f64) -> Option<f64> {
        match field {
            Field::Missing => Some(default),
            Field::Faulty => None,
            Field::Present(value) => self.sound(name, *value),
        }
    }

    /// A key that may be absent; the outer `None` stands for a fault.
    #[expect(clippy::option_option, reason = "absent and faulty differ")]
    pub fn maybe<Q: Quantity>(&self, name: &str, field: &Field<Q>) -> Option<Option<f64>> {
        match field {
            Field::Missing => Some(None),
            Field::Faulty => None,
            Field::Present(value) => self.sound(name, *value).map(Some),
        }
    }

    /// A single value or a range that is the right way up, each end within its limits.
    pub fn range<Q: Quantity>(&self, name: &str, value: &OneOrRange<Q>) -> Option<Range> {
        self.range_within(name, value, Q::LIMIT)
    }

    /// The same within other limits than those of its kind.
    pub fn range_within<Q: Quantity>(
        &self,
        name: &str,
        value: &OneOrRange<Q>,
        limit: Limit,
    ) -> Option<Range> {
        let [min, max] = match value {
            OneOrRange::One(value) => {
                return self.within(name, value.si(), limit).map(Range::held);
            }
            OneOrRange::Range(ends) => ends,
        };
        let ends = self.of(name);
        let end = |index: usize, field: &Field<Q>| {
            let item = ends.item(index);
            if !field.is_given() {
                item.report(
                    item.own_fault(FaultCode::Missing, "is missing")
                        .expecting(limit.expected),
                );
            }
            item.within_own(field.value()?.si(), limit)
        };
        let (min, max) = (end(0, min), end(1, max));
        let (min, max) = (min?, max?);
        if min > max {
            self.report(
                self.fault(FaultCode::UpsideDown, name, "the range is upside down")
                    .expecting("the smaller value first"),
            );
            return None;
        }
        Some(Range { min, max })
    }

    /// `value` if it keeps to `limit`; the fault is on record otherwise.
    pub fn within(&self, name: &str, value: f64, limit: Limit) -> Option<f64> {
        self.of(name).within_own(value, limit)
    }

    /// The same for the value of this very key.
    pub fn within_own(&self, value: f64, limit: Limit) -> Option<f64> {
        let Some((rule, complaint)) = limit.complaint(value) else {
            return Some(value);
        };
        let message = match self.faults.source.written(&self.key) {
            Some(written) => format!("`{}` {complaint}", crate::units::shortened(written)),
            None => complaint.to_owned(),
        };
        self.report(self.own_fault(rule, message).expecting(limit.expected));
        None
    }

    /// Whether `name`, a key of this group, can name a part, a contact or a surface.
    pub fn valid_name(&self, name: &str) -> bool {
        let sound = is_name(name);
        if !sound {
            self.report_name(
                self.fault(FaultCode::UnusableName, name, "cannot be used as a name")
                    .expecting(NAME_EXPECTED),
            );
        }
        sound
    }
}
