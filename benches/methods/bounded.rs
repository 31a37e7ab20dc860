//! The objective as basin wants it: with the unit cube as its bounds.

use basin::{BoxBounds, ConstraintDescription, ConstraintSet, Constraints, CostFunction};

use crate::objective::{Objective, Over};

pub struct Bounded<'a, 'b> {
    pub objective: &'a Objective<'b>,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl<'a, 'b> Bounded<'a, 'b> {
    pub fn new(objective: &'a Objective<'b>) -> Self {
        Self {
            objective,
            lower: vec![0.0; objective.dimensions()],
            upper: vec![1.0; objective.dimensions()],
        }
    }
}

impl Constraints for Bounded<'_, '_> {
    type Set = ConstraintSet<BoxBounds<Vec<f64>>>;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        let bounds = BoxBounds::new(Some(&self.lower), Some(&self.upper));
        ConstraintSet::new().with_bounds(bounds)
    }
}

impl CostFunction for Bounded<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Over;

    fn cost(&self, point: &Vec<f64>) -> Result<f64, Over> {
        self.objective.cost(point)
    }
}
