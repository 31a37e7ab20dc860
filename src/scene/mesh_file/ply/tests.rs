use super::*;
use crate::scene::mesh::Mesh;

fn mesh(bytes: &[u8]) -> Result<Mesh, Defect> {
    let mut assembly = Assembly::new(1.0);
    read(bytes, &mut assembly).map_err(|fault| fault.defect)?;
    assembly.finish().map(|it| it.mesh)
}

fn header(encoding: &str, kind: &str, faces: usize, indices: &str) -> String {
    format!(
        "ply\nformat {encoding} 1.0\nelement vertex 3\nproperty {kind} x\nproperty float y\n\
         property float z\nelement face {faces}\nproperty list {indices} vertex_indices\n\
         end_header\n"
    )
}

#[test]
fn every_kind_of_number_is_read() {
    // The x coordinates -3, 7 and 100, or without a sign 3, 7 and 100.
    let signed = [-3_i8, 7, 100];
    let unsigned = [3_u8, 7, 100];
    let bytes = |number: &[u8], is_little: bool| {
        let mut number = number.to_vec();
        if !is_little {
            number.reverse();
        }
        number
    };
    for (names, kind) in [
        (["char", "int8"], 0),
        (["uchar", "uint8"], 1),
        (["short", "int16"], 2),
        (["ushort", "uint16"], 3),
        (["int", "int32"], 4),
        (["uint", "uint32"], 5),
        (["float", "float32"], 6),
        (["double", "float64"], 7),
    ] {
        let encoded = |corner: usize| match kind {
            0 => signed[corner].to_le_bytes().to_vec(),
            1 => unsigned[corner].to_le_bytes().to_vec(),
            2 => i16::from(signed[corner]).to_le_bytes().to_vec(),
            3 => u16::from(unsigned[corner]).to_le_bytes().to_vec(),
            4 => i32::from(signed[corner]).to_le_bytes().to_vec(),
            5 => u32::from(unsigned[corner]).to_le_bytes().to_vec(),
            6 => f32::from(signed[corner]).to_le_bytes().to_vec(),
            _ => f64::from(signed[corner]).to_le_bytes().to_vec(),
        };
        let first = if matches!(kind, 1 | 3 | 5) { 3.0 } else { -3.0 };
        for name in names {
            for (encoding, is_little) in
                [("binary_little_endian", true), ("binary_big_endian", false)]
            {
                let mut file = header(encoding, name, 1, "uchar ushort").into_bytes();
                for (corner, number) in unsigned.into_iter().enumerate() {
                    file.extend(bytes(&encoded(corner), is_little));
                    let y = f32::from(number) * 2.0;
                    file.extend(bytes(&y.to_le_bytes(), is_little));
                    let z = f32::from(number % 2) - 0.5;
                    file.extend(bytes(&z.to_le_bytes(), is_little));
                }
                file.push(3);
                for corner in [0_u16, 1, 2] {
                    file.extend(bytes(&corner.to_le_bytes(), is_little));
                }
                let found = mesh(&file).unwrap_or_else(|defect| panic!("{name}: {defect:?}"));
                let expected = [[first, 6.0, 0.5], [7.0, 14.0, 0.5], [100.0, 200.0, -0.5]];
                let expected = expected.map(nalgebra::Point3::from);
                assert_eq!(found.vertices, expected, "{name}, {encoding}");
                // A file that is cut short says so.
                let short = mesh(&file[..file.len() - 1]);
                assert!(
                    matches!(
                        short,
                        Err(Defect::EndsEarly {
                            expected: "another number"
                        })
                    ),
                    "{short:?}"
                );
            }
        }
    }
}

#[test]
fn faces_have_three_corners_to_as_many_as_are_bearable() {
    // The last corner of a face is no vertex; the fault of the size comes first.
    let found = |corners: usize| {
        let face: String = (1..corners)
            .map(|corner| format!(" {}", corner % 3))
            .collect();
        let head = header("ascii", "double", 1, "int int");
        mesh(format!("{head}0 0 0\n1 0 0\n0 1 0\n{corners}{face} 9\n").as_bytes())
    };
    for corners in [1, 3, MOST_CORNERS, MOST_CORNERS + 1] {
        let found = found(corners);
        assert!(matches!(found, Err(Defect::NoSuchVertex { index: 9, .. })));
    }
    assert!(matches!(
        found(MOST_CORNERS + 2),
        Err(Defect::TooManyCorners { corners }) if corners == MOST_CORNERS + 1
    ));
    let corners = |face: &str| {
        let head = header("ascii", "double", 1, "int int");
        mesh(format!("{head}0 0 0\n1 0 0\n0 1 0\n{face}\n").as_bytes())
    };
    assert!(matches!(corners("2 0 1"), Err(Defect::Unexpected { .. })));
    assert!(corners("3 0 1 2").is_ok());
    for face in ["3 0 1 1.5", "3.5 0 1 2"] {
        let found = corners(face);
        assert!(
            matches!(
                found,
                Err(Defect::Unexpected {
                    expected: "a whole number",
                    ..
                })
            ),
            "{found:?}"
        );
    }
}

#[test]
fn a_promise_of_too_many_faces_is_not_read() {
    let found = |faces: usize| mesh(header("ascii", "double", faces, "int int").as_bytes());
    let too_many = |faces: usize| matches!(found(faces), Err(Defect::TooManyTriangles));
    assert!(!too_many(MOST_TRIANGLES));
    assert!(too_many(MOST_TRIANGLES + 1));
    assert!(too_many(MOST_TRIANGLES + 2));
}

#[test]
fn vertices_come_before_faces() {
    let file = "ply\nformat ascii 1.0\nelement face 0\nproperty list int int vertex_indices\n\
                element vertex 0\nproperty float x\nproperty float y\nproperty float z\n\
                end_header\n";
    let Err(Defect::NotInHeader { missing }) = mesh(file.as_bytes()) else {
        panic!("the order is wrong");
    };
    assert_eq!(missing, "element `vertex` before the element `face`");
}

#[test]
fn other_lists_have_any_length_from_0_on() {
    let with = |length: i32| {
        let file = format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
             property float z\nproperty list int int tags\nelement face 1\n\
             property list int int vertex_indices\nend_header\n\
             0 0 0 0\n1 0 0 2 7 8\n0 1 0 {length}\n3 0 1 2\n"
        );
        mesh(file.as_bytes())
    };
    assert!(with(0).is_ok());
    assert!(matches!(
        with(-1),
        Err(Defect::Unexpected {
            expected: "the length of a list",
            ..
        })
    ));
}
