//! What parts, contacts, surfaces and regions may be called.

/// What a name may consist of.
pub(super) const NAME_EXPECTED: &str = "letters, digits, `_` and `-`";

/// The same as a pattern for schemas, without classes such as `\p{N}`, which Python does not know: other
/// punctuation than that of ASCII only the check can tell.
pub(super) const NAME_PATTERN: &str = r"^[^\u0000-,./:-@\[-^`{-\u007f\s]+$";

/// Whether parts, contacts and surfaces may be called `name`.
pub(super) fn is_name(name: &str) -> bool {
    !name.is_empty()
        && name
            .chars()
            .all(|c| c.is_alphanumeric() || c == '_' || c == '-')
}
