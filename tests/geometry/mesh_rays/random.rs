//! Random numbers that are the same in every run.

use std::f64::consts::TAU;

use nalgebra::Vector3;

/// SplitMix64.
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// In 0 to 1.
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn of<'a, T>(&mut self, items: &'a [T]) -> &'a T {
        &items[(self.bits() % items.len() as u64) as usize]
    }

    /// A unit vector.
    pub fn direction(&mut self) -> Vector3<f64> {
        let z = 2.0 * self.uniform() - 1.0;
        let (sin, cos) = (TAU * self.uniform()).sin_cos();
        let across = (1.0 - z * z).sqrt();
        Vector3::new(across * cos, across * sin, z)
    }

    /// A direction off a wall, by the cosine law.
    pub fn off(&mut self, normal: &Vector3<f64>) -> Vector3<f64> {
        loop {
            let direction = (normal + self.direction()).normalize();
            if direction.dot(normal) > 1e-12 {
                return direction;
            }
        }
    }

    /// Anywhere along a wall, off it by 1e-11 to 1 rad.
    pub fn grazing(&mut self, normal: &Vector3<f64>) -> Vector3<f64> {
        let along = normal.cross(&self.direction()).normalize();
        let off = 10.0_f64.powf(-11.0 * self.uniform());
        (along + normal * off).normalize()
    }
}
