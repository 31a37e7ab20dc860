//! What physics asks of whole paths and evaluations, in worlds at random: laws of mechanics from the
//! nozzle to the end of every path, and answers that do not depend on where the world stands, how it is
//! turned, in which units, at which scale, in which order and under which names it is written down.

mod conditioning;
mod laws;
mod mesh_views;
mod meshes;
mod view;
mod views;
mod world;
