//! The nozzle of a stroke as it travels, for glTF.

use gltf::json::accessor::{ComponentType, Type};
use gltf::json::animation::{Channel, Interpolation, Property, Sampler, Target};
use gltf::json::scene::{Node, UnitQuaternion};
use gltf::json::validation::Checked;
use gltf::json::{Accessor, Animation, Buffer, Index, Value};
use nalgebra::{UnitQuaternion as Turn, Vector3};

use super::glb::{File, accessor};
use super::piece::Body;
use crate::report::motion::Stop;

/// The motion of a nozzle: seconds and stops.
pub(super) struct Motion {
    seconds: Vec<f32>,
    stops: Vec<Stop>,
}

/// Where no feed is known the spot travels so fast, m/s.
const UNKNOWN_FEED: f64 = 10e-3;
/// What is done on the spot takes so long, s, as times must rise.
const ON_THE_SPOT: f64 = 1e-2;

impl Motion {
    /// One pass over the stops at a feed, m/s; `None` where nothing moves.
    pub fn new(stops: Vec<Stop>, feed: Option<f64>) -> Option<Self> {
        let feed = feed.filter(|feed| *feed > 0.0).unwrap_or(UNKNOWN_FEED);
        let mut time = 0.0;
        let mut seconds = vec![0.0];
        for pair in stops.windows(2) {
            time += ((pair[1].at - pair[0].at) / feed).max(ON_THE_SPOT);
            seconds.push(time as f32);
        }
        (stops.len() > 1).then_some(Self { seconds, stops })
    }

    /// Where a piece of the body that is drawn from its exit at the origin, along `drawn`, stands at a stop.
    fn turn(stop: &Stop, body: usize, drawn: &Vector3<f64>) -> Turn<f64> {
        let towards = stop.tips.get(body).copied().unwrap_or_default();
        Turn::rotation_between(drawn, &towards).unwrap_or_else(|| {
            // The other way round: about any axis across it.
            let across = drawn.cross(&Vector3::ith(drawn.map(f64::abs).imin(), 1.0));
            nalgebra::Unit::try_new(across, 0.0).map_or_else(Turn::identity, |axis| {
                Turn::from_axis_angle(&axis, std::f64::consts::PI)
            })
        })
    }
}

impl File {
    /// Lets nodes of the nozzle's bodies travel; each is drawn with its exit at the origin, along its direction.
    pub(super) fn travel(
        &mut self,
        motion: &Motion,
        nodes: &[(Index<Node>, Body)],
        buffer: Index<Buffer>,
    ) {
        let times = self.column(&motion.seconds, Type::Scalar, buffer);
        let last = motion.seconds.last().copied().unwrap_or_default();
        let ends = |time: f32| Some(Value::from(vec![time]));
        let input = &mut self.root.accessors[times.value()];
        (input.min, input.max) = (ends(0.0), ends(last));
        let exits: Vec<f32> = motion
            .stops
            .iter()
            .flat_map(|stop| [stop.exit.x, stop.exit.y, stop.exit.z].map(|it| it as f32))
            .collect();
        let exits = self.column(&exits, Type::Vec3, buffer);
        let mut animation = Animation {
            extensions: None,
            extras: Default::default(),
            channels: Vec::new(),
            name: Some("stroke".into()),
            samplers: Vec::new(),
        };
        let mut add = |node, path, output| {
            let sampler = Index::new(animation.samplers.len() as u32);
            animation.samplers.push(Sampler {
                extensions: None,
                extras: Default::default(),
                input: times,
                interpolation: Checked::Valid(Interpolation::Linear),
                output,
            });
            animation.channels.push(Channel {
                sampler,
                target: Target {
                    extensions: None,
                    extras: Default::default(),
                    node,
                    path: Checked::Valid(path),
                },
                extensions: None,
                extras: Default::default(),
            });
        };
        for (node, Body { index, tip, .. }) in nodes {
            let first = &motion.stops[0];
            let start = quaternion(&Motion::turn(first, *index, tip));
            self.root.nodes[node.value()].translation =
                Some([first.exit.x, first.exit.y, first.exit.z].map(|it| it as f32));
            self.root.nodes[node.value()].rotation = Some(UnitQuaternion(start));
            add(*node, Property::Translation, exits);
            if tip.norm() > 0.0 {
                let stops = motion.stops.iter();
                let turns = stops.flat_map(|stop| quaternion(&Motion::turn(stop, *index, tip)));
                let turns: Vec<f32> = turns.collect();
                let turns = self.column(&turns, Type::Vec4, buffer);
                add(*node, Property::Rotation, turns);
            }
        }
        self.root.push(animation);
    }

    fn column(&mut self, numbers: &[f32], of: Type, buffer: Index<Buffer>) -> Index<Accessor> {
        let bytes = numbers.iter().flat_map(|number| number.to_le_bytes());
        let view = self.view(bytes, None, buffer);
        let count = numbers.len() / of.multiplicity();
        let accessor = accessor(view, count, ComponentType::F32, of);
        self.root.push(accessor)
    }
}

fn quaternion(turn: &Turn<f64>) -> [f32; 4] {
    [turn.i, turn.j, turn.k, turn.w].map(|part| part as f32)
}
