//! Files that are there whole or not at all.

use std::io::{self, Write};
use std::path::Path;

/// A temporary file that may be read by whom the umask lets; usually nobody else may.
pub fn temporary() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder
}

/// Writes a file into a folder: whoever looks sees the old file or the new one.
///
/// # Errors
/// The folder cannot be written.
pub fn write(folder: &Path, name: &str, contents: &[u8]) -> io::Result<()> {
    let mut file = temporary().tempfile_in(folder)?;
    file.write_all(contents)?;
    file.persist(folder.join(name))
        .map_err(|error| error.error)?;
    Ok(())
}
