//! glTF 2.0, binary: a node with a mesh and a material for each piece.

use std::borrow::Cow;
use std::io;
use std::mem::size_of;

use gltf::binary::Header;
use gltf::json::accessor::{ComponentType, GenericComponentType, Type};
use gltf::json::buffer::{Target, View};
use gltf::json::material::{AlphaMode, PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::{Checked, USize64};
use gltf::json::{Accessor, Asset, Buffer, Index, Material, Mesh, Node, Root, Scene, Value};

use super::animation::Motion;
use super::piece::{Cells, Piece};
use crate::elementary::power;

/// The file; it says that lengths are in m by being glTF.
pub(super) fn write(pieces: &[Piece], motion: Option<&Motion>) -> io::Result<Vec<u8>> {
    let mut file = File::default();
    file.root.asset = Asset {
        generator: Some(format!("peenpose {}", env!("CARGO_PKG_VERSION"))),
        ..Asset::default()
    };
    // The only buffer; its length is known at the end.
    let buffer = file.root.push(buffer(0));
    let mut travelling = Vec::new();
    let mut nodes = Vec::new();
    for piece in pieces {
        // What travels is drawn with its exit at the origin.
        let body = piece.body.filter(|_| motion.is_some());
        let origin = body.map_or([0.0; 3], |body| body.exit);
        let node = file.node(piece, origin, buffer);
        travelling.extend(body.map(|body| (node, body)));
        nodes.push(node);
    }
    if let Some(motion) = motion.filter(|_| !travelling.is_empty()) {
        file.travel(motion, &travelling, buffer);
    }
    let scene = file.root.push(Scene {
        extensions: None,
        extras: Default::default(),
        name: Some("peenpose".into()),
        nodes,
    });
    file.root.scene = Some(scene);
    file.root.buffers[buffer.value()] = self::buffer(file.bytes.len());
    gltf::Glb {
        header: Header {
            magic: *b"glTF",
            version: 2,
            length: 0,
        },
        json: Cow::Owned(file.root.to_vec().map_err(io::Error::other)?),
        bin: Some(Cow::Owned(file.bytes)),
    }
    .to_vec()
    .map_err(io::Error::other)
}

fn buffer(length: usize) -> Buffer {
    Buffer {
        byte_length: USize64::from(length),
        name: None,
        uri: None,
        extensions: None,
        extras: Default::default(),
    }
}

/// A file that is being written.
#[derive(Default)]
pub(super) struct File {
    pub(super) root: Root,
    bytes: Vec<u8>,
}

impl File {
    fn node(&mut self, piece: &Piece, origin: [f32; 3], buffer: Index<Buffer>) -> Index<Node> {
        let from_origin = |point: &[f32; 3]| [0, 1, 2].map(|axis| point[axis] - origin[axis]);
        let points: Vec<[f32; 3]> = piece.points.iter().map(from_origin).collect();
        let positions = self.positions(&points, buffer);
        let (mode, indices) = match &piece.cells {
            Cells::Triangles(triangles) => (
                Mode::Triangles,
                Some(self.indices(triangles.as_flattened(), buffer)),
            ),
            Cells::Lines(lines) => (
                Mode::Lines,
                Some(self.indices(lines.as_flattened(), buffer)),
            ),
            Cells::Points(_) => (Mode::Points, None),
        };
        let material = self.root.push(material(piece));
        let mesh = self.root.push(Mesh {
            extensions: None,
            extras: Default::default(),
            name: Some(piece.name.clone()),
            primitives: vec![Primitive {
                attributes: [(Checked::Valid(Semantic::Positions), positions)].into(),
                extensions: None,
                extras: Default::default(),
                indices,
                material: Some(material),
                mode: Checked::Valid(mode),
                targets: None,
            }],
            weights: None,
        });
        self.root.push(Node {
            mesh: Some(mesh),
            name: Some(piece.name.clone()),
            ..Node::default()
        })
    }

    fn positions(&mut self, points: &[[f32; 3]], buffer: Index<Buffer>) -> Index<Accessor> {
        let ends = |least: fn(f32, f32) -> f32, start: f32| {
            let corner = points.iter().fold([start; 3], |found, point| {
                [0, 1, 2].map(|axis| least(found[axis], point[axis]))
            });
            Some(Value::from(corner.to_vec()))
        };
        let (min, max) = (
            ends(f32::min, f32::INFINITY),
            ends(f32::max, f32::NEG_INFINITY),
        );
        let bytes = points.as_flattened().iter().flat_map(|x| x.to_le_bytes());
        let view = self.view(bytes, Some(Target::ArrayBuffer), buffer);
        self.root.push(Accessor {
            min,
            max,
            ..accessor(view, points.len(), ComponentType::F32, Type::Vec3)
        })
    }

    fn indices(&mut self, indices: &[u32], buffer: Index<Buffer>) -> Index<Accessor> {
        let bytes = indices.iter().flat_map(|index| index.to_le_bytes());
        let view = self.view(bytes, Some(Target::ElementArrayBuffer), buffer);
        let accessor = accessor(view, indices.len(), ComponentType::U32, Type::Scalar);
        self.root.push(accessor)
    }

    /// Appends bytes; all of them come in fours, so that every view is aligned.
    pub(super) fn view(
        &mut self,
        bytes: impl Iterator<Item = u8>,
        target: Option<Target>,
        buffer: Index<Buffer>,
    ) -> Index<View> {
        let start = self.bytes.len();
        debug_assert!(start.is_multiple_of(size_of::<f32>()));
        self.bytes.extend(bytes);
        self.root.push(View {
            buffer,
            byte_length: USize64::from(self.bytes.len() - start),
            byte_offset: Some(USize64::from(start)),
            byte_stride: None,
            name: None,
            target: target.map(Checked::Valid),
            extensions: None,
            extras: Default::default(),
        })
    }
}

pub(super) fn accessor(
    view: Index<View>,
    count: usize,
    component: ComponentType,
    of: Type,
) -> Accessor {
    Accessor {
        buffer_view: Some(view),
        byte_offset: None,
        count: USize64::from(count),
        component_type: Checked::Valid(GenericComponentType(component)),
        extensions: None,
        extras: Default::default(),
        type_: Checked::Valid(of),
        min: None,
        max: None,
        name: None,
        normalized: false,
        sparse: None,
    }
}

/// Dull, and seen from both sides.
fn material(piece: &Piece) -> Material {
    let [red, green, blue] = piece.color.map(linear);
    Material {
        name: Some(piece.name.clone()),
        double_sided: true,
        alpha_mode: Checked::Valid(if piece.opacity < 1.0 {
            AlphaMode::Blend
        } else {
            AlphaMode::Opaque
        }),
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_factor: PbrBaseColorFactor([red, green, blue, piece.opacity]),
            metallic_factor: StrengthFactor(0.0),
            roughness_factor: StrengthFactor(1.0),
            ..PbrMetallicRoughness::default()
        },
        ..Material::default()
    }
}

/// A component of an sRGB colour as a share of light (IEC 61966-2-1).
fn linear(component: u8) -> f32 {
    let share = f64::from(component) / 255.0;
    let light = if share <= 0.04045 {
        share / 12.92
    } else {
        power((share + 0.055) / 1.055, 2.4)
    };
    light as f32
}
