//! Rays against triangle meshes beside Embree, which casts the same rays one by one; see README.md.

#[path = "../common/mod.rs"]
mod common;

use std::env;
use std::error::Error;
use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Instant;

use nalgebra::{Point3, Vector3};
use peenpose::jet::{Pose, Samples, Stream};
use peenpose::objective::Tally;
use peenpose::problem;
use peenpose::problem::setting::{Settings, Tolerance};
use peenpose::scenario::Scenario;
use peenpose::scene::ray::{HitId, Ray};
use peenpose::scene::{Scene, Walls};
use peenpose::trace::Tracer;

use common::settings;

const SHOTS: usize = 8192;
/// Times that all rays are cast, turn and turn about.
const ROUNDS: usize = 15;
/// Rays that leave a surface meet nothing nearer than this in Embree, m.
const NEAREST: f32 = 1e-6;

fn main() -> Result<(), Box<dyn Error>> {
    let given = |argument: &String| !argument.starts_with("--");
    let Some(program) = env::args().skip(1).find(given) else {
        eprintln!("benches/peers/README.md says how to compare with Embree");
        return Ok(());
    };
    println!(
        "mesh               triangles     rays   Embree  agree    ours / Embree    built in, s"
    );
    println!(
        "                                      Mray/s      %   cast     trace    ours  Embree"
    );
    let blind = settings(63.0, 0.0, 8e-3, 48.0);
    compare(
        &program,
        "blind keyway",
        "keyway-blind.yaml",
        Walls::Exact,
        &blind,
    )?;
    for (name, file, settings) in [
        (
            "keyway 40 mm",
            "keyway.yaml",
            settings(78.0, 0.0, 8e-3, 9.4),
        ),
        (
            "keyway 200 mm",
            "keyway-long.yaml",
            settings(60.0, 20.0, 10e-3, 10.0),
        ),
    ] {
        for degrees in [0.66, 0.066, 0.0066, 0.00066_f64] {
            let walls = Walls::TriangleMesh {
                chord_angle: degrees.to_radians(),
            };
            compare(&program, name, file, walls, &settings)?;
        }
    }
    Ok(())
}

/// Prints one line of the table.
fn compare(
    program: &str,
    name: &str,
    file: &str,
    walls: Walls,
    settings: &Settings,
) -> Result<(), Box<dyn Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("problems")
        .join(file);
    let mut problem = problem::read(&path)?
        .problem
        .ok_or("a shipped problem has no faults")?;
    // One pose for all shots, so that the rays can be told from outside.
    problem.tolerance = Tolerance::default();
    // Embree casts rays, not spheres.
    problem.paths.shot_size = false;
    let start = Instant::now();
    let scenario = Scenario::new(problem, walls).map_err(|faults| faults[0].to_string())?;
    let built = start.elapsed().as_secs_f64();
    let samples = Samples::new(&scenario.problem, Stream::Search, SHOTS);
    let flights = flights(&scenario, settings, &samples);
    let mut peer = Peer::start(program, &scenario.scene, &flights)?;

    let (mut embree, mut cast, mut trace) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        let peer_seconds = peer.seconds()?;
        let cast_seconds = seconds(|| {
            let hits = flights.iter().filter(|f| f.hit(&scenario.scene).is_some());
            hits.count()
        });
        let mut rays = 0;
        let trace_seconds = seconds(|| {
            rays = Tally::trace(&scenario, settings, 1.0, &samples.shots).rays;
            rays
        });
        assert_eq!(rays, flights.len());
        embree.push(peer_seconds);
        cast.push(cast_seconds / peer_seconds);
        trace.push(trace_seconds / peer_seconds);
    }
    println!(
        "{name:16} {:11} {:8}   {:6.2} {:6.2}   {:4.2}      {:4.2}   {built:5.2}   {:5.2}",
        scenario.scene.triangles(),
        flights.len(),
        flights.len() as f64 / median(embree) / 1e6,
        100.0 * peer.agreeing as f64 / flights.len() as f64,
        median(cast),
        median(trace),
        peer.built,
    );
    Ok(())
}

fn seconds(work: impl FnOnce() -> usize) -> f64 {
    let start = Instant::now();
    std::hint::black_box(work());
    start.elapsed().as_secs_f64()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// One ray that the tracer casts.
struct Flight {
    ray: Ray,
    leaving: Option<HitId>,
    distance: Option<f64>,
}

impl Flight {
    fn hit(&self, scene: &Scene) -> Option<f64> {
        let hit = scene.first_hit(&self.ray, self.leaving)?;
        Some(hit.distance)
    }
}

/// All rays of a jet, in the order in which shots are followed.
fn flights(scenario: &Scenario, settings: &Settings, samples: &Samples) -> Vec<Flight> {
    let pose = Pose::new(&scenario.target.frame, settings);
    let tracer = Tracer::new(scenario, settings, 1.0);
    let mut flights = Vec::new();
    for shot in &samples.shots {
        let [across, up, forward] = shot.cone;
        let mut ray = Ray {
            origin: pose.exit + pose.side * shot.exit[0] + pose.up * shot.exit[1],
            direction: pose.side * across + pose.up * up + pose.direction * forward,
        };
        let mut departures: Vec<(Point3<f64>, Vector3<f64>)> = Vec::new();
        let (_, rays) = tracer.follow(shot, |impact| {
            departures.push((impact.point, impact.velocity));
        });
        let mut leaving = None;
        for index in 0..rays {
            let hit = scenario.scene.first_hit(&ray, leaving);
            flights.push(Flight {
                ray,
                leaving,
                distance: hit.map(|hit| hit.distance),
            });
            if let (Some(hit), Some((point, velocity))) = (hit, departures.get(index)) {
                assert_eq!(hit.point, *point, "the tracer casts another ray");
                leaving = Some(hit.hit_id);
                ray = Ray {
                    origin: *point,
                    // To the last bit as the tracer has it.
                    direction: velocity * (1.0 / velocity.dot(velocity).sqrt()),
                };
            }
        }
    }
    flights
}

/// The program that casts with Embree.
struct Peer {
    child: Child,
    orders: ChildStdin,
    answers: BufReader<ChildStdout>,
    /// s.
    built: f64,
    /// Rays that meet something at our distance, or nothing as ours.
    agreeing: usize,
}

impl Peer {
    fn start(program: &str, scene: &Scene, flights: &[Flight]) -> Result<Self, Box<dyn Error>> {
        let file = tempfile::NamedTempFile::new()?;
        write_scene(file.as_file(), scene, flights)?;
        let mut child = Command::new(program)
            .arg(file.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| format!("{program}: {error}"))?;
        let mut peer = Self {
            orders: child.stdin.take().ok_or("no pipe")?,
            answers: BufReader::new(child.stdout.take().ok_or("no pipe")?),
            child,
            built: 0.0,
            agreeing: 0,
        };
        (peer.built, peer.agreeing) = peer.answer()?;
        Ok(peer)
    }

    /// How long all rays take once, s.
    fn seconds(&mut self) -> Result<f64, Box<dyn Error>> {
        self.orders.write_all(b"\n")?;
        let (nanoseconds, _) = self.answer()?;
        Ok(nanoseconds * 1e-9)
    }

    fn answer(&mut self) -> Result<(f64, usize), Box<dyn Error>> {
        let mut line = String::new();
        self.answers.read_line(&mut line)?;
        let (time, count) = line.trim().split_once(' ').ok_or("no answer")?;
        Ok((time.parse()?, count.parse()?))
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        // A program that has ended already is no fault here.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Corners, triangles and rays as embree.cpp reads them.
fn write_scene(file: &File, scene: &Scene, flights: &[Flight]) -> std::io::Result<()> {
    let mut file = BufWriter::new(file);
    let surfaces = 0..scene.surfaces().len() as u32;
    let triangles: Vec<_> = surfaces.flat_map(|s| scene.surface_triangles(s)).collect();
    write_count(&mut file, 3 * triangles.len())?;
    for corner in triangles.iter().flatten() {
        write_numbers(&mut file, &corner.coords)?;
    }
    write_count(&mut file, triangles.len())?;
    for index in 0..3 * triangles.len() as u32 {
        file.write_all(&index.to_ne_bytes())?;
    }
    write_count(&mut file, flights.len())?;
    for flight in flights {
        write_numbers(&mut file, &flight.ray.origin.coords)?;
        write_numbers(&mut file, &flight.ray.direction)?;
        let nearest = flight.leaving.map_or(0.0, |_| NEAREST);
        file.write_all(&nearest.to_ne_bytes())?;
        let expected = flight.distance.unwrap_or(-1.0) as f32;
        file.write_all(&expected.to_ne_bytes())?;
    }
    file.flush()
}

fn write_count(file: &mut impl Write, count: usize) -> std::io::Result<()> {
    file.write_all(&(count as u64).to_ne_bytes())
}

fn write_numbers(file: &mut impl Write, vector: &Vector3<f64>) -> std::io::Result<()> {
    let mut numbers = vector.iter();
    numbers.try_for_each(|&number| file.write_all(&(number as f32).to_ne_bytes()))
}
