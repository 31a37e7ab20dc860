//! Campaigns: many problems from one, planned, run anywhere in any order, and gathered in a table.
//!
//! A folder is all that the parts of a campaign share: `plan.json` and `cases.csv` say what there is to solve, and each case
//! becomes a file in `results`, whole or not at all. Who runs which cases is for an engine to say (a shell, a queue, a
//! cluster): it passes on a shard, and the same cases give the same table whoever has run them.

mod axis;
mod file;
mod folder;
mod plan;
mod table;

pub use folder::{CampaignFolder, CaseStatus, Outcome, Shard};
pub use plan::{Case, Plan};
