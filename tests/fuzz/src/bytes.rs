//! Numbers and choices out of the bytes of an input.

use nalgebra::Vector3;

/// What is left of an input; zeros once it is used up.
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    /// Whether nothing is left.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    fn array<const N: usize>(&mut self) -> [u8; N] {
        let mut array = [0; N];
        let count = N.min(self.0.len());
        let (taken, rest) = self.0.split_at(count);
        array[..count].copy_from_slice(taken);
        self.0 = rest;
        array
    }

    pub fn byte(&mut self) -> u8 {
        u8::from_le_bytes(self.array())
    }

    pub fn short(&mut self) -> u16 {
        u16::from_le_bytes(self.array())
    }

    /// Any number at all.
    pub fn any(&mut self) -> f64 {
        f64::from_le_bytes(self.array())
    }

    /// A finite number: of any size up to `largest`, or a plain one.
    pub fn finite(&mut self, largest: f64) -> f64 {
        let value = self.any();
        if value.abs() <= largest {
            value
        } else {
            f64::from(value.to_bits() as i16) / 256.0
        }
    }

    pub fn yes(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    /// Up to `most`.
    pub fn count(&mut self, most: usize) -> usize {
        usize::from(self.byte()) % (most + 1)
    }

    pub fn of<'i, T>(&mut self, items: &'i [T]) -> &'i T {
        &items[usize::from(self.byte()) % items.len()]
    }

    /// Between both, ends included.
    pub fn within(&mut self, min: f64, max: f64) -> f64 {
        let share = f64::from(self.short()) / f64::from(u16::MAX);
        min * (1.0 - share) + max * share
    }

    /// A point of a coarse lattice within -8 to 8, or just beside it.
    pub fn lattice(&mut self) -> f64 {
        let coarse = f64::from(self.byte() as i8) / 16.0;
        match self.byte() {
            beside @ 250.. => coarse + (f64::from(beside) - 252.5) * 1e-9,
            _ => coarse,
        }
    }

    pub fn lattice_vector(&mut self) -> Vector3<f64> {
        let [x, y, z] = [0; 3].map(|_| self.lattice());
        Vector3::new(x, y, z)
    }

    pub fn direction(&mut self) -> Vector3<f64> {
        self.lattice_vector()
            .try_normalize(1e-6)
            .unwrap_or_else(Vector3::z)
    }
}
