//! What pictures of an answer are drawn from: the surfaces as triangles, shots on their way, and
//! the places that are worth a test strip.

mod flights;
mod places;
mod shapes;
mod shown;
mod thinning;

pub use flights::{Flight, broken_by};
pub use places::Place;
pub(crate) use places::least_dented;
pub use shapes::Shape;
pub use shown::Shown;

use crate::control::Cancel;
use crate::jet::{Pose, Replicates, Samples, purpose};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;

/// Shots that a picture needs to show where they go.
pub const SHOTS: usize = 16_384;

/// Plot data of some settings.
#[derive(Clone, Debug)]
pub struct Evidence {
    /// Every surface as triangles, the target patch first.
    pub shapes: Vec<Shape>,
    /// The shots of the jet, in their order; what the setup tolerance and the scatter do to each
    /// is in them.
    pub flights: Vec<Flight>,
    /// The shots that are worth drawing.
    pub shown: Vec<Shown>,
    /// Where to put test strips.
    pub places: Vec<Place>,
}

impl Evidence {
    /// Fires `shots` validation shots; none where the nozzle does not fit. One is enough where all shots
    /// of a problem are the same, and the first ones after a request to end.
    pub fn of(scenario: &Scenario, settings: &Settings, shots: usize, cancel: &Cancel) -> Self {
        let shots = if scenario.problem.has_one_ray() {
            shots.min(1)
        } else {
            shots
        };
        let stream = Replicates::stream(purpose::EVIDENCE, 0);
        let jet = Samples::new(&scenario.problem, stream, shots);
        let pose = Pose::new(&scenario.target.frame, settings);
        let shapes = shapes::all(scenario, &pose);
        let flights = flights::fire(scenario, settings, &jet, &shapes, cancel);
        Self {
            shown: shown::pick(scenario, &flights),
            places: places::find(scenario, &pose, &flights),
            shapes: thinning::thinned(shapes, &scenario.target),
            flights,
        }
    }
}
