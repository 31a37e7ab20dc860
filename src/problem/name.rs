//! What parts, contacts, surfaces and regions may be called.

/// What a name may consist of.
pub(super) const NAME_EXPECTED: &str = "letters, digits, `_` and `-`";

/// The same as a pattern for schemas.
pub(super) const NAME_PATTERN: &str = r"^[\p{Alphabetic}\p{N}_-]+$";

/// Whether parts, contacts and surfaces may be called `name`.
pub(super) fn is_name(name: &str) -> bool {
    !name.is_empty()
        && name
            .chars()
            .all(|c| c.is_alphanumeric() || c == '_' || c == '-')
}
