//! Worlds at random: a slot with a round floor, a pin in it and a lid over it.

use nalgebra::Point3;
use proptest::prelude::*;

use crate::physics_properties::meshes::Mesh;

/// Lengths in mm, angles in degrees.
#[derive(Clone, Copy, Debug)]
pub struct World {
    /// Half the width of the slot at its mouth, to either side.
    pub mouth: [f64; 2],
    /// The same at its foot.
    pub foot: [f64; 2],
    pub depth: f64,
    /// How far the middle of the floor lies below its ends.
    pub sag: f64,
    /// Centre and diameter of the pin, which runs along the slot.
    pub pin: [f64; 3],
    pub radius: f64,
    pub density: f64,
    /// mu_s, mu_d over mu_s, restitution and its exponent: 0 for one that does not fall with speed.
    pub contact: [f64; 4],
    /// Of the pin.
    pub hard: [f64; 4],
    pub incidence: f64,
    pub azimuth: f64,
    pub standoff: f64,
    pub speed: f64,
    pub shots_have_size: bool,
    /// Whether the left and the right wall may take less than the rest.
    pub is_weak: [bool; 2],
    /// Of the bumps, where slot and pin are meshes.
    pub bumps: Option<u32>,
    pub is_mirrored: bool,
}

fn contact() -> impl Strategy<Value = [f64; 4]> {
    let exponent = prop_oneof![Just(0.0), 0.1..0.3];
    (0.02..0.6, 0.5..1.0, 0.2..0.95, exponent).prop_map(|(s, d, e, x)| [s, d, e, x])
}

pub fn world() -> impl Strategy<Value = World> {
    let slot = (
        [3.0..5.0, 3.0..5.0],
        [1.5..2.5, 1.5..2.5],
        6.0..9.0,
        0.4..1.2,
        [-0.8..0.8, 3.0..4.0, 0.6..1.2],
    );
    let shot = (
        0.05..0.3,
        2000.0..8000.0,
        contact(),
        contact(),
        any::<bool>(),
    );
    let pose = (25.0..88.0, -180.0..180.0, 1.5..2.5, 5.0..60.0);
    (slot, shot, pose).prop_map(|(slot, shot, pose)| {
        let (mouth, foot, depth, sag, pin) = slot;
        let (radius, density, contact, hard, shots_have_size) = shot;
        let (incidence, azimuth, standoff, speed) = pose;
        World {
            mouth,
            foot,
            depth,
            sag,
            pin,
            radius,
            density,
            contact,
            hard,
            incidence,
            azimuth,
            standoff,
            speed,
            shots_have_size,
            is_weak: [false, true],
            bumps: None,
            is_mirrored: false,
        }
    })
}

/// The same with slots and pins of triangles.
pub fn meshed_world() -> impl Strategy<Value = World> {
    (world(), any::<u32>()).prop_map(|(world, seed)| World {
        bumps: Some(seed),
        ..world
    })
}

impl World {
    /// The same on both sides of the plane x = 0.
    pub fn symmetric(self) -> Self {
        Self {
            mouth: [self.mouth[0]; 2],
            foot: [self.foot[0]; 2],
            pin: [0.0, self.pin[1], self.pin[2]],
            is_weak: [true; 2],
            ..self
        }
    }

    /// In a mirror in the plane x = 0.
    pub fn mirrored(self) -> Self {
        let [x, y, diameter] = self.pin;
        let (mut mouth, mut foot, mut is_weak) = (self.mouth, self.foot, self.is_weak);
        mouth.reverse();
        foot.reverse();
        is_weak.reverse();
        Self {
            mouth,
            foot,
            pin: [-x, y, diameter],
            azimuth: -self.azimuth,
            is_weak,
            is_mirrored: !self.is_mirrored,
            ..self
        }
    }

    /// Slot and pin, where they are meshes.
    pub fn meshes(&self) -> Option<[Mesh; 2]> {
        const BUMP: f64 = 0.1;
        let seed = self.bumps?;
        if self.is_mirrored {
            let meshes = self.mirrored().meshes();
            return meshes.map(|meshes| meshes.map(Mesh::mirrored));
        }
        let [left, right] = [0, 1].map(|side| [self.foot[side], self.mouth[side]]);
        let wall = |[foot, mouth]: [f64; 2], share: f64| {
            [foot + share * (mouth - foot), share * self.depth]
        };
        let floor = |share: f64| {
            let x = left[0] + right[0];
            [share * x - left[0], -4.0 * self.sag * share * (1.0 - share)]
        };
        let on_left = |share| {
            let [x, y] = wall(left, share);
            ([-x, y], "left")
        };
        let section = [
            on_left(1.0),
            on_left(0.7),
            on_left(0.3),
            (floor(0.0), "floor"),
            (floor(0.3), "floor"),
            (floor(0.6), "floor"),
            (floor(1.0), "right"),
            (wall(right, 0.3), "right"),
            (wall(right, 0.7), "right"),
        ];
        let [x, y, diameter] = self.pin;
        let slot = Mesh::walls(&section, wall(right, 1.0), BUMP, seed);
        let pin = Mesh::rod([x, y], 0.5 * diameter, 22.0, 2.0 * BUMP, seed);
        Some([slot, pin])
    }

    /// Where the nozzle aims: the lowest line of a round floor, or the middle of a triangle, on whose
    /// edges the direction to aim from would be that of either side.
    pub fn aim(&self) -> [f64; 3] {
        let lowest = Point3::new(0.0, -self.sag, 0.0);
        let aim = match self.meshes() {
            Some([slot, _]) => slot.nearest_centre("floor", &lowest),
            None => lowest,
        };
        aim.coords.into()
    }

    pub fn with_azimuth(self, azimuth: f64) -> Self {
        Self { azimuth, ..self }
    }

    /// The largest static friction.
    pub fn friction(&self) -> f64 {
        self.contact[0].max(self.hard[0])
    }
}
