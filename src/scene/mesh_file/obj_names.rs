//! Which level of an OBJ file tells its faces apart, and so names the surfaces.

use super::assembly::{ALL, Assembly};
use super::mending::Mending;

/// What programs write for "none", in whatever case: they tell nothing.
const NOTHING: [&str; 5] = ["", "default", "off", "none", "(null)"];

/// What an OBJ file calls a face.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Labels {
    /// By `g`.
    pub group: String,
    /// By `o`.
    pub object: String,
    /// By `usemtl`.
    pub material: String,
}

/// Stands between labels in a key; no name has a control character.
const BETWEEN: char = '\0';

impl Labels {
    /// A name for surfaces, different for different labels, until the level is known.
    pub fn key(&self) -> String {
        [&*self.group, &*self.object, &*self.material].join("\0")
    }

    fn of_key(key: &str) -> [&str; 3] {
        let mut labels = key.splitn(3, BETWEEN);
        std::array::from_fn(|_| labels.next().unwrap_or_default())
    }
}

/// Names the surfaces, which have their labels' keys until now.
///
/// The first level that tells faces apart is used: `g`, `o`, `usemtl`. If none does, it is `g`, or `o`
/// in a file without `g`.
pub(super) fn name_surfaces(assembly: &mut Assembly) {
    const GROUP: usize = 0;
    const OBJECT: usize = 1;
    const MATERIAL: usize = 2;
    let keys = assembly.surface_names();
    let labels: Vec<[&str; 3]> = keys.iter().map(|key| Labels::of_key(key)).collect();
    let has_groups = labels.iter().any(|it| !it[GROUP].is_empty());
    let telling = [GROUP, OBJECT, MATERIAL]
        .into_iter()
        .find(|&level| tells_apart(labels.iter().map(|it| it[level])));
    let level = telling.unwrap_or(if has_groups { GROUP } else { OBJECT });
    assembly.rename_surfaces(|key| match Labels::of_key(key)[level] {
        "" => ALL.to_owned(),
        name => name.to_owned(),
    });
    match level {
        OBJECT if has_groups => assembly.mended(Mending::NamesOfObjects),
        MATERIAL => assembly.mended(Mending::NamesOfMaterials),
        _ => {}
    }
}

/// Whether there are several names, at least one of which is a name.
fn tells_apart<'a>(names: impl Iterator<Item = &'a str> + Clone) -> bool {
    let is_name = |name: &str| !NOTHING.iter().any(|it| it.eq_ignore_ascii_case(name));
    let mut rest = names.clone();
    let first = rest.next();
    rest.any(|name| Some(name) != first) && names.into_iter().any(is_name)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The names of the surfaces of faces with these labels, and what was noted.
    fn named(labels: &[[&str; 3]]) -> (Vec<String>, Vec<Mending>) {
        let mut assembly = Assembly::new(1.0);
        let corners: Vec<u32> = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
            .into_iter()
            .map(|corner| assembly.vertex(corner).expect("it is near"))
            .collect();
        for labels in labels {
            let [group, object, material] = labels.map(str::to_owned);
            let labels = Labels {
                group,
                object,
                material,
            };
            let surface = assembly.surface(&labels.key());
            assembly.face(&corners, surface).expect("it is small");
        }
        name_surfaces(&mut assembly);
        let found = assembly.finish().expect("it has faces");
        let name = |number: u32| found.mesh.surfaces[number as usize].clone();
        let faces = found.mesh.triangles.iter();
        (
            faces.map(|face| name(face.surface)).collect(),
            found.mendings,
        )
    }

    #[test]
    fn the_first_level_that_tells_faces_apart_names_them() {
        const OBJECTS: &[Mending] = &[Mending::NamesOfObjects];
        const MATERIALS: &[Mending] = &[Mending::NamesOfMaterials];
        for (labels, names, noted) in [
            // One level alone.
            (
                &[["a", "", ""], ["b", "", ""]][..],
                &["a", "b"][..],
                &[][..],
            ),
            (&[["", "a", ""], ["", "b", ""]], &["a", "b"], &[]),
            (&[["", "", "a"], ["", "", "b"]], &["a", "b"], MATERIALS),
            // Groups go before objects, and objects before materials.
            (&[["a", "o", "m"], ["b", "p", "n"]], &["a", "b"], &[]),
            (&[["", "o", "m"], ["", "p", "n"]], &["o", "p"], &[]),
            // What programs write for no group hides nothing.
            (
                &[["default", "o", ""], ["default", "p", ""]],
                &["o", "p"],
                OBJECTS,
            ),
            (
                &[["off", "o", ""], ["default", "p", ""]],
                &["o", "p"],
                OBJECTS,
            ),
            (
                &[["part", "o", ""], ["part", "p", ""]],
                &["o", "p"],
                OBJECTS,
            ),
            (
                &[["part", "o", "m"], ["part", "o", "n"]],
                &["m", "n"],
                MATERIALS,
            ),
            (
                &[["", "Cube", "None"], ["", "Cube", "steel"]],
                &["None", "steel"],
                MATERIALS,
            ),
            // Faces without a name where others have one.
            (&[["", "", ""], ["lip", "", ""]], &["all", "lip"], &[]),
            (
                &[["default", "", ""], ["lip", "", ""]],
                &["default", "lip"],
                &[],
            ),
            // Equal names are one surface.
            (
                &[["a", "", ""], ["b", "", ""], ["a", "", ""]],
                &["a", "b", "a"],
                &[],
            ),
            (
                &[["a", "", "m"], ["b", "", ""], ["a", "", "n"]],
                &["a", "b", "a"],
                &[],
            ),
            // Nothing tells them apart.
            (
                &[["part", "o", "m"], ["part", "o", "m"]],
                &["part", "part"],
                &[],
            ),
            (&[["", "o", "m"]], &["o"], &[]),
            (&[["", "", "m"]], &["all"], &[]),
            (
                &[["default", "", ""], ["off", "", ""]],
                &["default", "off"],
                &[],
            ),
        ] {
            let (found, mendings) = named(labels);
            assert_eq!(found, names, "{labels:?}");
            assert_eq!(mendings, noted, "{labels:?}");
        }
    }
}
