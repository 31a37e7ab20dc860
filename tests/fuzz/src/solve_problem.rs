//! Problem files of all kinds out of bytes.

use std::fmt::Write as _;

use super::bytes::Bytes;

/// A problem as text, with the mesh file that it may name.
pub struct Written {
    pub problem: String,
    pub mesh: String,
}

/// How a number comes about: mostly as a shop would write it, at times as far out as it may be.
struct Writer<'a, 'b> {
    bytes: &'a mut Bytes<'b>,
    text: String,
}

/// A problem that is legal in most cases.
pub fn write(bytes: &mut Bytes<'_>) -> Written {
    let mut writer = Writer {
        bytes,
        text: "format: 1\nlengths_in: mm\nscene:\n".into(),
    };
    let (surface, within) = writer.part();
    writer.other_part();
    writer.line(&format!("target: {{ surface: part.{surface}{within} }}"));
    writer.jet();
    let contacts = writer.contacts();
    writer.settings(contacts);
    writer.goals();
    writer.surfaces(surface);
    writer.rest();
    Written {
        problem: writer.text,
        mesh: mesh(writer.bytes),
    }
}

impl Writer<'_, '_> {
    fn line(&mut self, line: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "{line}");
    }

    /// A number that is mostly between both ends, at times at one of the extremes.
    fn number(&mut self, usual: [f64; 2], extreme: [f64; 2]) -> f64 {
        match self.bytes.byte() {
            0..8 => extreme[0],
            8..16 => extreme[1],
            16..24 => usual[0],
            24..32 => usual[1],
            _ => self.bytes.within(usual[0], usual[1]),
        }
    }

    fn length(&mut self, usual: [f64; 2]) -> String {
        format!("{:e} mm", self.number(usual, [1e-6, 1e6]))
    }

    /// Beside what a shape needs: `key: value` for a value that may be absent.
    fn perhaps(&mut self, line: impl FnOnce(&mut Self) -> String) -> String {
        if self.bytes.yes() {
            line(self)
        } else {
            String::new()
        }
    }

    /// The part with the target, one of its surfaces, and a box of that.
    fn part(&mut self) -> (&'static str, &'static str) {
        let length = self.length([1.0, 60.0]);
        match self.bytes.byte() % 5 {
            0 => {
                let (bore, width) = (self.length([10.0, 40.0]), self.length([2.0, 9.0]));
                let depth = self.length([1.0, 6.0]);
                let root = self.perhaps(|it| format!(", root_radius: {}", it.length([0.1, 1.0])));
                self.line(&format!(
                    "  part: {{ keyway: {{ bore: {bore}, width: {width}, depth: {depth}, length: {length}{root} }} }}"
                ));
                (
                    *self.bytes.of(&["floor", "bore", "wall_neg", "root_pos"]),
                    "",
                )
            }
            1 => {
                let diameter = self.length([5.0, 50.0]);
                let ends = self.ends();
                self.line(&format!(
                    "  part: {{ bore: {{ diameter: {diameter}, length: {length}{ends} }} }}"
                ));
                (*self.bytes.of(&["wall", "near", "far"]), "")
            }
            2 => {
                let far = self.number([1.0, 50.0], [1e-3, 1e6]);
                self.line(&format!(
                    "  part: {{ box: {{ min: [-20, -20, -5], max: [{far:e}, 20, 0] }} }}"
                ));
                let within = *self
                    .bytes
                    .of(&["", ", within: { min: [-5, -5, -1], max: [5, 5, 1] }"]);
                (
                    *self.bytes.of(&["z_max", "z_max", "x_max", "y_min"]),
                    within,
                )
            }
            3 => {
                self.extrusion(&length);
                (*self.bytes.of(&["floor", "wall", "near"]), "")
            }
            _ => {
                self.line("  part: { mesh: part.obj }");
                (*self.bytes.of(&["all", "one", "two"]), "")
            }
        }
    }

    fn ends(&mut self) -> String {
        let ends = [
            "",
            ", ends: closed",
            ", ends: { near: closed }",
            ", ends: { far: closed }",
        ];
        (*self.bytes.of(&ends)).to_owned()
    }

    /// A polygon, some of its sides arcs, mostly closed.
    fn extrusion(&mut self, length: &str) {
        let ends = self.ends();
        self.line(&format!(
            "  part: {{ extrude: {{ length: {length}{ends}, profile: ["
        ));
        let corners = 1 + self.bytes.count(6);
        let first = self.flat_point();
        for index in 0..corners {
            let from = if index == 0 {
                format!("from: {first}, ")
            } else {
                String::new()
            };
            let to = if index + 1 == corners && self.bytes.byte() < 200 {
                first.clone()
            } else {
                self.flat_point()
            };
            let path = if self.bytes.byte() < 80 {
                format!("arc_to: {to}, via: {}", self.flat_point())
            } else {
                format!("line_to: {to}")
            };
            let surface = *self.bytes.of(&["floor", "wall"]);
            self.line(&format!("    {{ {from}{path}, surface: {surface} }},"));
        }
        self.line("  ] } }");
    }

    fn flat_point(&mut self) -> String {
        format!(
            "[{}, {}]",
            4.0 * self.bytes.lattice(),
            4.0 * self.bytes.lattice()
        )
    }

    /// Perhaps one more, in the way or on the nozzle.
    fn other_part(&mut self) {
        let at = [0; 3].map(|_| 4.0 * self.bytes.lattice());
        match self.bytes.byte() {
            0..40 => self.line(&format!(
                "  pin: {{ bore: {{ diameter: 3 mm, length: 5 mm, ends: closed }}, place: {{ on: nozzle, at: {at:?}, rotate: [0 deg, 45 deg, 0 deg] }} }}"
            )),
            40..80 => {
                self.line(&format!(
                    "  mask: {{ box: {{ min: [-3, -3, -3], max: [3, 3, 3] }}, place: {{ at: {at:?} }} }}"
                ));
            }
            _ => {}
        }
    }

    fn jet(&mut self) {
        let radius = self.length([0.05, 2.0]);
        let density = self.number([2000.0, 8000.0], [1.0, 1e5]);
        let size =
            self.perhaps(|it| format!(", size_spread: {} %", it.number([0.0, 20.0], [0.0, 49.0])));
        self.line(&format!(
            "shot: {{ radius: {radius}, density: {density:e} kg/m3{size} }}"
        ));
        let exit = self.number([0.0, 3.0], [0.0, 1e6]);
        let divergence = self.number([0.0, 20.0], [0.0, 89.9]);
        let spread = *self.bytes.of(&["uniform", "gaussian"]);
        let speeds = self.number([0.0, 20.0], [0.0, 49.0]);
        let flow = self.perhaps(|it| {
            format!(
                ", mass_flow: {:e} kg/min",
                it.number([0.1, 10.0], [1e-10, 1e6])
            )
        });
        self.line(&format!(
            "jet: {{ exit_diameter: {exit:e} mm, divergence: {divergence} deg, spread: {spread}, speed_spread: {speeds} %{flow} }}"
        ));
        if self.bytes.yes() {
            let (ball, length) = (self.length([1.0, 5.0]), self.length([5.0, 50.0]));
            let clearance = self.number([0.0, 1.0], [0.0, 1e6]);
            self.line(&format!(
                "nozzle: {{ body: [ {{ ball: {{ radius: {ball} }} }}, {{ capsule: {{ length: {length}, radius: {ball} }} }} ], clearance: {clearance:e} mm }}"
            ));
        }
    }

    fn contacts(&mut self) -> usize {
        self.line("contacts:");
        let count = 1 + self.bytes.count(2);
        for index in 0..count {
            let contact = self.contact();
            self.line(&format!("  c{index}: {{ {contact} }}"));
        }
        count
    }

    fn contact(&mut self) -> String {
        let law = *self
            .bytes
            .of(&["stick_slip", "kinetic", "irrotational", "always_slip"]);
        let friction = self.number([0.0, 0.5], [0.0, 10.0]);
        let ratio = self.number([0.5, 1.0], [0.0, 1.0]);
        let friction = if self.bytes.byte() < 60 {
            format!(
                "mu_s: [0.01, {}], mu_d_ratio: {ratio}",
                0.02 + friction.min(9.0)
            )
        } else {
            format!("mu_s: {friction}, mu_d: {}", ratio * friction)
        };
        let value = self.number([0.1, 0.9], [0.0, 1.0]);
        let restitution = if self.bytes.byte() < 60 {
            let exponent = self.number([0.1, 0.5], [0.0, 1.0]);
            format!("{{ value: {value}, at: 5 m/s, exponent: {exponent} }}")
        } else {
            format!("{value}")
        };
        let back = self.perhaps(|it| {
            format!(
                ", tangential_restitution: {}",
                it.number([-0.5, 0.5], [-1.0, 1.0])
            )
        });
        format!("law: {law}, {friction}, restitution: {restitution}{back}")
    }

    /// A single value or a range.
    fn range(&mut self, usual: [f64; 2], extreme: [f64; 2], unit: &str) -> String {
        let (a, b) = (self.number(usual, extreme), self.number(usual, extreme));
        if self.bytes.byte() < 100 {
            format!("{a:e} {unit}")
        } else {
            format!("[{:e} {unit}, {:e} {unit}]", a.min(b), a.max(b))
        }
    }

    fn settings(&mut self, contacts: usize) {
        self.line("settings:");
        let incidence = self.range([20.0, 90.0], [1e-3, 90.0], "deg");
        let azimuth = self.range([-180.0, 180.0], [-180.0, 180.0], "deg");
        let standoff = self.range([2.0, 30.0], [1e-6, 1e6], "mm");
        let speed = self.range([1.0, 50.0], [1e-6, 1e4], "m/s");
        self.line(&format!("  incidence: {incidence}\n  azimuth: {azimuth}"));
        self.line(&format!("  standoff: {standoff}\n  speed: {speed}"));
        for shift in ["aim_along", "aim_across", "aim_above"] {
            if self.bytes.byte() < 60 {
                let shift_range = self.range([-2.0, 2.0], [-1e6, 1e6], "mm");
                self.line(&format!("  {shift}: {shift_range}"));
            }
        }
        if self.bytes.yes() {
            let chosen = self.bytes.count(contacts - 1);
            self.line(&format!("  contact: c{chosen}"));
        }
    }

    fn impulse(&mut self) -> String {
        format!("{:e} uN.s", self.number([1.0, 100.0], [1e-12, 1e12]))
    }

    fn weight(&mut self) -> f64 {
        self.number([0.0, 2.0], [0.0, 1e9])
    }

    fn share(&mut self) -> f64 {
        self.number([0.0, 20.0], [0.0, 100.0])
    }

    fn goals(&mut self) {
        let (target, share, weight) = (self.impulse(), self.share(), self.weight());
        let tolerance = self.number([1.0, 50.0], [0.0, 1000.0]);
        self.line("goals:");
        self.line(&format!(
            "  normal_impulse: {{ target: {target}, tolerance: {tolerance} %, share: {share} %, weight: {weight:e} }}"
        ));
        for (goal, key) in [("tangential_impulse", "limit"), ("rebound", "allow")] {
            if self.bytes.yes() {
                let (impulse, share, weight) = (self.impulse(), self.share(), self.weight());
                self.line(&format!(
                    "  {goal}: {{ {key}: {impulse}, share: {share} %, weight: {weight:e} }}"
                ));
            }
        }
        if self.bytes.yes() {
            let (share, weight) = (self.share(), self.weight());
            self.line(&format!(
                "  miss: {{ share: {share} %, weight: {weight:e} }}"
            ));
        }
    }

    fn surfaces(&mut self, surface: &str) {
        if self.bytes.byte() < 60 {
            let contact = self.contact();
            let roughness = self.number([0.0, 10.0], [0.0, 20.0]);
            let allow = self.impulse();
            self.line("surfaces:");
            self.line(&format!(
                "  part.{surface}: {{ allow: {allow}, roughness: {roughness} deg, contact: {{ {contact} }} }}"
            ));
        }
    }

    fn rest(&mut self) {
        if self.bytes.yes() {
            let impacts = 1 + self.bytes.count(40);
            let energy = self.number([0.0, 5.0], [0.0, 99.0]);
            self.line(&format!(
                "paths: {{ impacts: {impacts}, least_energy: {energy} % }}"
            ));
        }
        if self.bytes.yes() {
            let (incidence, standoff) = (
                self.number([0.0, 5.0], [0.0, 40.0]),
                self.number([0.0, 2.0], [0.0, 5.0]),
            );
            let (speed, restitution) = (
                self.number([0.0, 10.0], [0.0, 99.0]),
                self.number([0.0, 0.3], [0.0, 1.0]),
            );
            let friction = self.number([0.0, 30.0], [0.0, 99.0]);
            self.line(&format!(
                "tolerance: {{ incidence: {incidence} deg, standoff: {standoff} mm, speed: {speed} %, restitution: {restitution}, friction: {friction} % }}"
            ));
        }
        if self.bytes.byte() < 60 {
            let dent = self.length([0.1, 1.0]);
            let wanted = self.number([50.0, 300.0], [1e-6, 9999.0]);
            let speed = self.number([5.0, 40.0], [1e-3, 200.0]);
            let hardness = self.number([100.0, 600.0], [1.0, 9999.0]);
            let dents = [
                format!("dent_diameter: {dent}"),
                format!("dent_diameter: {dent}, measured_at: {{ speed: {speed} m/s }}"),
                format!("hardness: {hardness} HB"),
            ];
            let dent = self.bytes.of(&dents).clone();
            self.line(&format!("coverage: {{ {dent}, wanted: {wanted} % }}"));
        }
        let model = *self
            .bytes
            .of(&["auto", "full", "[]", "[shot_size, rebounds]"]);
        self.line(&format!("model: {model}"));
        let (accuracy, seed) = (self.number([0.1, 10.0], [1e-6, 100.0]), self.bytes.byte());
        self.line(&format!(
            "solve: {{ accuracy: {accuracy} %, seed: {seed} }}"
        ));
    }
}

/// A few triangles in two groups.
fn mesh(bytes: &mut Bytes<'_>) -> String {
    let vertices = 3 + bytes.count(9);
    let mut text = String::new();
    for _ in 0..vertices {
        let [x, y, z] = [0; 3].map(|_| 2.0 * bytes.lattice());
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for group in ["one", "two"] {
        let _ = writeln!(text, "g {group}");
        for _ in 0..=bytes.count(8) {
            let [a, b, c] = [0; 3].map(|_| 1 + usize::from(bytes.byte()) % vertices);
            let _ = writeln!(text, "f {a} {b} {c}");
        }
    }
    text
}
