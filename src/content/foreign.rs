//! Files that bear the name of a format that is read here but are of another kind.

use std::fmt;

/// What a file is, and what to do with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Foreign {
    /// With its article: "a gzip archive".
    what: &'static str,
    advice: &'static str,
}

const UNPACK: &str = "unpack it";
const EXPORT: &str = "export the part as .stl, .obj or .ply";
const DOWNLOAD: &str = "download the file itself";
const AS_UTF8: &str = "save it as UTF-8";

/// Files that begin with these bytes.
const MAGICS: &[(&[u8], &str, &str)] = &[
    (b"\x1f\x8b", "a gzip archive", UNPACK),
    (b"BZh", "a bzip2 archive", UNPACK),
    (b"\xfd7zXZ\0", "an xz archive", UNPACK),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive", UNPACK),
    (b"\x28\xb5\x2f\xfd", "a zstd archive", UNPACK),
    (b"\x04\x22\x4d\x18", "an LZ4 archive", UNPACK),
    (b"\x1f\x9d", "a compressed file (.Z)", UNPACK),
    (b"Rar!\x1a\x07", "a RAR archive", UNPACK),
    (b"ISO-10303-21", "a STEP file", EXPORT),
    (b"glTF", "a glTF file", EXPORT),
    (
        b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1",
        "a file of a CAD or office program",
        EXPORT,
    ),
    (b"**ABCDEFGHIJKLMNOPQRSTUVWXYZ", "a Parasolid file", EXPORT),
    (b"Kaydara FBX Binary", "an FBX file", EXPORT),
    (b"BLENDER", "a Blender file", EXPORT),
    (b"3D Geometry File Format", "a Rhino file", EXPORT),
    (b"PXR-USDC", "a USD file", EXPORT),
    (b"#usda", "a USD file", EXPORT),
    (b"#VRML", "a VRML file", EXPORT),
    (b"#X3D", "an X3D file", EXPORT),
    (b"# vtk DataFile", "a VTK file", EXPORT),
    (b"$MeshFormat", "a Gmsh file", EXPORT),
    (b"%PDF", "a PDF document", EXPORT),
    (b"\x89PNG", "a picture", EXPORT),
    (b"\xff\xd8\xff", "a picture", EXPORT),
    (
        b"version https://git-lfs.github.com/spec/",
        "a Git LFS pointer, not the file",
        DOWNLOAD,
    ),
    (b"\xff\xfe\0\0", "UTF-32 text", AS_UTF8),
    (b"\0\0\xfe\xff", "UTF-32 text", AS_UTF8),
];

/// Text files that begin with these words, in small or capital letters, behind blanks.
const WORDS: &[(&str, &str, &str)] = &[
    ("<!doctype html", "a web page", DOWNLOAD),
    ("<html", "a web page", DOWNLOAD),
];

impl Foreign {
    /// The kind of a file that begins like this; `None` if it may be of any other.
    pub fn of(head: &[u8]) -> Option<Self> {
        let known = |what, advice| Some(Self { what, advice });
        let text = head.strip_prefix(super::UTF8_MARK).unwrap_or(head);
        let text = text.trim_ascii_start();
        let magic = MAGICS
            .iter()
            .find(|(magic, ..)| head.starts_with(magic) || text.starts_with(magic));
        if let Some((_, what, advice)) = magic {
            return known(what, advice);
        }
        let word = WORDS.iter().find(|(word, ..)| {
            let start = text.get(..word.len());
            start.is_some_and(|start| start.eq_ignore_ascii_case(word.as_bytes()))
        });
        if let Some((_, what, advice)) = word {
            return known(what, advice);
        }
        if head.starts_with(b"PK\x03\x04") {
            return match holds(head, b"3D/") || holds(head, b"3dmodel") {
                true => known("a 3MF file", EXPORT),
                false => known("a zip archive", UNPACK),
            };
        }
        if head.get(257..262) == Some(b"ustar") {
            return known("a tar archive", UNPACK);
        }
        if text.starts_with(b"<?xml") {
            return known("an XML file, such as AMF, COLLADA or X3D,", EXPORT);
        }
        if text.starts_with(b"{") && holds(head, b"\"asset\"") {
            return known("a glTF file", EXPORT);
        }
        if is_iges(head) {
            return known("an IGES file", EXPORT);
        }
        None
    }
}

impl fmt::Display for Foreign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "this is {}: {}", self.what, self.advice)
    }
}

fn holds(head: &[u8], word: &[u8]) -> bool {
    head.windows(word.len()).any(|window| window == word)
}

/// The first line has 72 columns, and behind these the letter of its section and its number.
fn is_iges(head: &[u8]) -> bool {
    let is_of_text = |text: &[u8]| text.iter().all(|it| (b' '..=b'~').contains(it));
    match (head.get(..72), head.get(72..80)) {
        (Some(columns), Some([b'S' | b's', number @ ..])) => {
            is_of_text(columns) && number.trim_ascii_start() == b"1"
                || number.iter().all(|it| matches!(it, b'0' | b'1')) && number.ends_with(b"1")
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(head: impl AsRef<[u8]>) -> Option<String> {
        Foreign::of(head.as_ref()).map(|foreign| foreign.to_string())
    }

    #[test]
    fn files_are_told_by_how_they_begin() {
        let iges = format!("{:<72}S      1\n", "A part,,31HOpen");
        let mut tar = vec![b'a'; 257];
        tar.extend(b"ustar\x0000");
        for (head, expected) in [
            (
                &b"\x1f\x8b\x08\x08"[..],
                "this is a gzip archive: unpack it",
            ),
            (
                b"PK\x03\x04\x14\0\x06\0mesh.stl",
                "this is a zip archive: unpack it",
            ),
            (
                b"PK\x03\x04\x14\0\x06\0_rels/.rels 3D/3dmodel.model",
                "this is a 3MF file: export the part as .stl, .obj or .ply",
            ),
            (&tar, "this is a tar archive: unpack it"),
            (
                b"\xef\xbb\xbf\r\nISO-10303-21;\n",
                "this is a STEP file: export the part as .stl, .obj or .ply",
            ),
            (
                iges.as_bytes(),
                "this is an IGES file: export the part as .stl, .obj or .ply",
            ),
            (
                b"{ \"scene\": 0, \"asset\": { \"version\": \"2.0\" } }",
                "this is a glTF file: export the part as .stl, .obj or .ply",
            ),
            (
                b"\n <!DOCTYPE HTML>\n<html>",
                "this is a web page: download the file itself",
            ),
            (
                b"version https://git-lfs.github.com/spec/v1\noid sha256:4d",
                "this is a Git LFS pointer, not the file: download the file itself",
            ),
        ] {
            assert_eq!(told(head).as_deref(), Some(expected));
        }
    }

    #[test]
    fn files_that_are_read_here_are_not_foreign() {
        let plain = [
            "",
            "S",
            "solid PK\n",
            "ply\nformat ascii 1.0\n",
            "# vtx\nv 0 0 0\n",
            "format: 1\n",
            "{ format: 1 }\n",
        ];
        for head in plain {
            assert_eq!(told(head), None, "{head}");
        }
        assert_eq!(told([0; 1024]), None);
        assert_eq!(told(format!("{:<72}S1234567\n", "solid")), None);
    }
}
