//! Normal impulses on one surface: each of them while they are few, then how many lie in each of many fine
//! classes.

use std::collections::BTreeMap;

use super::Spread;

/// Impulses of which mean and range are wanted.
#[derive(Clone, Debug, Default)]
pub(super) struct Impulses {
    each: Vec<f64>,
    classes: Option<Classes>,
}

/// How many values lie in each class.
#[derive(Clone, Debug, Default)]
struct Classes {
    /// By the leading bits of the values, which are ordered like the values as none is negative.
    counts: BTreeMap<u32, usize>,
    count: usize,
    sum: f64,
    largest: f64,
}

/// Bits of a value that are left out: a class is 1/4096 of its values wide.
const LEFT_OUT: u32 = f64::MANTISSA_DIGITS - 1 - 12;

impl Impulses {
    /// Takes one more.
    #[inline]
    pub fn push(&mut self, impulse: f64) {
        match &mut self.classes {
            None => self.each.push(impulse),
            Some(classes) => classes.add(impulse),
        }
    }

    /// Takes all of another surface's or set's.
    pub fn append(&mut self, other: &Self) {
        if let Some(classes) = &other.classes {
            self.count_in_classes();
            if let Some(all) = &mut self.classes {
                all.append(classes);
            }
        }
        match &mut self.classes {
            None => self.each.extend_from_slice(&other.each),
            Some(classes) => other.each.iter().for_each(|&impulse| classes.add(impulse)),
        }
    }

    /// From here on counts them only: they would take too much memory.
    pub fn count_in_classes(&mut self) {
        let classes = self.classes.get_or_insert_default();
        for impulse in std::mem::take(&mut self.each) {
            classes.add(impulse);
        }
    }

    /// Mean and range; zeros when there are none.
    pub fn spread(self) -> Spread {
        match self.classes {
            None => Spread::of(self.each),
            Some(classes) => classes.spread(),
        }
    }
}

impl Classes {
    fn add(&mut self, impulse: f64) {
        *self
            .counts
            .entry((impulse.to_bits() >> LEFT_OUT) as u32)
            .or_insert(0) += 1;
        self.count += 1;
        self.sum += impulse;
        self.largest = self.largest.max(impulse);
    }

    fn append(&mut self, other: &Self) {
        for (class, count) in &other.counts {
            *self.counts.entry(*class).or_insert(0) += count;
        }
        self.count += other.count;
        self.sum += other.sum;
        self.largest = self.largest.max(other.largest);
    }

    fn spread(&self) -> Spread {
        if self.count == 0 {
            return Spread::default();
        }
        let quantile = |share: f64| {
            let place = ((self.count - 1) as f64 * share).round() as usize;
            let mut seen = 0;
            let class = self.counts.iter().find(|(_, count)| {
                seen += **count;
                seen > place
            });
            // The middle of the class.
            let half = 1 << (LEFT_OUT - 1);
            let middle = class.map_or(0.0, |(&class, _)| {
                f64::from_bits(u64::from(class) << LEFT_OUT | half)
            });
            middle.min(self.largest)
        };
        Spread {
            mean: (self.sum / self.count as f64).min(self.largest),
            low: quantile(0.05),
            high: quantile(0.95),
            largest: self.largest,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_give_the_same_mean_and_range() {
        let values: Vec<f64> = (0..50_000)
            .map(|i| 1e-6 * (1.0 + f64::from(i * 7_919 % 50_000)))
            .collect();
        let mut each = Impulses::default();
        let (mut first, mut second) = (Impulses::default(), Impulses::default());
        for (index, &value) in values.iter().enumerate() {
            each.push(value);
            if index == 20_000 {
                first.count_in_classes();
            }
            if index < 30_000 {
                &mut first
            } else {
                &mut second
            }
            .push(value);
        }
        // Whichever of them is in classes.
        for (one, other) in [(&first, &second), (&second, &first)] {
            let mut both = one.clone();
            both.append(other);
            assert!(both.each.is_empty());
            let (found, exact) = (both.spread(), each.clone().spread());
            assert_eq!(found.largest, exact.largest);
            for (found, exact) in [
                (found.mean, exact.mean),
                (found.low, exact.low),
                (found.high, exact.high),
            ] {
                assert!(
                    (found / exact - 1.0).abs() < 1.0 / 4096.0,
                    "{found} {exact}"
                );
            }
        }
        let mut none = Impulses::default();
        none.count_in_classes();
        assert_eq!(none.spread(), Spread::default());
    }

    #[test]
    fn memory_is_bounded() {
        let mut many = Impulses::default();
        many.count_in_classes();
        for i in 0..2_000_000_u32 {
            many.push(f64::from(i % 100_000) * 1e-9);
        }
        let classes = many.classes.expect("it counts");
        assert_eq!(classes.count, 2_000_000);
        assert!(classes.counts.len() < 80_000, "{}", classes.counts.len());
        assert!(many.each.capacity() == 0);
    }
}
