"""The keyway solved by a script: Embree casts, numpy reckons, scipy searches.

    python3 -m venv /tmp/scipy && /tmp/scipy/bin/pip install numpy scipy embreex
    cargo build --release
    /tmp/scipy/bin/python benches/peers/keyway_scipy.py target/release/peenpose

It solves problems/keyway.yaml without its tolerance block. Centres of shots fly among walls that are set
back by their radius. The speed is taken out as peenpose does it, so the searches go over incidence,
azimuth and standoff alone. What an answer is worth, `peenpose evaluate` says from 2^18 shots, for the
script's answers and for the best settings known. `peenpose solve` runs in between, as a whole process,
with the same seeds.
"""

import csv
import json
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh
from scipy.optimize import differential_evolution, minimize
from scipy.special import ndtri
from scipy.stats import qmc

ROOT = Path(__file__).resolve().parents[2]
LENGTH, BORE, HALF_WIDTH, FLOOR = 40.0, 15.0, 4.0, 18.3  # mm
CORNER, HALF_ANGLE = np.sqrt(BORE**2 - HALF_WIDTH**2), np.arcsin(HALF_WIDTH / BORE)
AIM = np.array([0.0, FLOOR, 20.0])
BODY, RADIUS = 3.0, 0.5
MASS = 7000.0 * 4.0 / 3.0 * np.pi * 0.5e-3**3
NORMAL, TANGENTIAL, ALLOWED = 40e-6 / MASS, 8e-6 / MASS, 10e-6 / MASS  # impulses per mass, m/s
WEIGHTS = {"normal": 1.0, "tangential": 1.0, "rebound": 0.5, "miss": 2.0}
CONTACTS = {"dry": (0.30, 0.27), "damp": (0.15, 0.135), "oiled": (0.06, 0.054)}
RESTITUTION = 0.25
MOST_IMPACTS, LEAST_ENERGY = 6, 0.01
BOUNDS = [(30.0, 85.0), (-90.0, 90.0), (6.0, 20.0)]
SPEEDS = (5.0, 40.0)
INFEASIBLE = 1e3
SEEDS = range(1, 6)
SHOTS = {"Nelder-Mead": (1024, 4096, 16384), "differential evolution": (1024, 4096)}
NAMES = ("incidence", "azimuth", "standoff", "speed")


def hub():
    """Triangles that centres of shots meet, chords of one degree; the first two are the floor."""
    bore = np.linspace(HALF_ANGLE, 2 * np.pi - HALF_ANGLE, 330)
    edge = np.linspace(np.pi / 2, HALF_ANGLE, 76) + np.pi
    right = np.array([HALF_WIDTH, CORNER]) + RADIUS * np.transpose([np.sin(edge), np.cos(edge)])
    outline = [(RADIUS - HALF_WIDTH, FLOOR - RADIUS), (HALF_WIDTH - RADIUS, FLOOR - RADIUS)]
    outline += list(right[:-1])
    outline += list((BORE - RADIUS) * np.transpose([np.sin(bore), np.cos(bore)]))
    outline += list((right * [-1.0, 1.0])[-2::-1])
    corners = np.array(outline)
    triangles = []
    for (x, y), (u, v) in zip(corners, np.roll(corners, -1, axis=0)):
        triangles.append([(x, y, 0.0), (u, v, 0.0), (u, v, LENGTH)])
        triangles.append([(x, y, 0.0), (u, v, LENGTH), (x, y, LENGTH)])
    return np.array(triangles, dtype=np.float32)


class Part:
    """The hub in Embree, and where a nozzle fits."""

    def __init__(self):
        triangles = hub()
        self.scene = rtcore_scene.EmbreeScene()
        self.mesh = TriangleMesh(self.scene, triangles)
        sides = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
        normals = np.cross(*sides).astype(float)
        self.normals = normals / np.linalg.norm(normals, axis=1)[:, None]

    def cast(self, start, flight):
        """Distances and triangles; -1 where a ray leaves the hub."""
        found = self.scene.run(start.astype(np.float32), flight.astype(np.float32), output=1)
        return found["tfar"].astype(float), found["primID"]

    def clearance(self, exit_point):
        """From the exit to the walls in the cross-section, less the nozzle's radius."""
        x, y, _ = exit_point
        walls = [FLOOR - y]
        if y > CORNER:
            walls.append(HALF_WIDTH - abs(x))
        else:
            walls.append(np.hypot(HALF_WIDTH - abs(x), CORNER - y))
            if np.arctan2(abs(x), y) > HALF_ANGLE:
                walls.append(BORE - np.hypot(x, y))
        return min(walls) - BODY


def aimed(point):
    """Exit point and axis of the jet."""
    incidence, azimuth, standoff = point
    incidence, azimuth = np.radians(incidence), np.radians(azimuth)
    # n = -y, a = z, b = a x n = x.
    axis = np.array([
        np.cos(incidence) * np.sin(azimuth),
        np.sin(incidence),
        np.cos(incidence) * np.cos(azimuth),
    ])
    return AIM - standoff * axis, axis


class Jet:
    """The same shots for every pose: scrambled Sobol points."""

    def __init__(self, shots, seed):
        points = qmc.Sobol(5, seed=seed).random(shots)
        self.radius = 0.75 * np.sqrt(points[:, 0])
        self.turn = 2 * np.pi * points[:, 1]
        self.cosine = 1.0 - (1.0 - np.cos(np.radians(4.0))) * points[:, 2]
        self.heading = 2 * np.pi * points[:, 3]
        low, high = 0.0227501319, 0.9772498681  # cut at two standard deviations
        self.scatter = 1.0 + 0.05 * ndtri(low + (high - low) * points[:, 4])

    def fire(self, exit_point, axis):
        side = np.cross(axis, [0.0, 0.0, 1.0])
        side /= np.linalg.norm(side)
        up = np.cross(side, axis)
        start = exit_point + self.radius[:, None] * (
            np.cos(self.turn)[:, None] * side + np.sin(self.turn)[:, None] * up
        )
        sine = np.sqrt(1.0 - self.cosine**2)[:, None]
        flight = self.cosine[:, None] * axis
        flight = flight + sine * np.cos(self.heading)[:, None] * side
        return start, flight + sine * np.sin(self.heading)[:, None] * up


def impulses(part, jet, point, friction):
    """Impulses per mass and speed: N* and f* of first hits on target, N* of all other impacts."""
    mu_s, mu_d = friction
    start, direction = jet.fire(*aimed(point))
    shots = len(start)
    velocity = direction * jet.scatter[:, None]
    spin = np.zeros_like(velocity)  # R w
    least = LEAST_ENERGY * jet.scatter**2
    which = np.arange(shots)
    on_target = np.zeros(shots, dtype=bool)
    normals, tangentials, others = np.zeros(shots), np.zeros(shots), []
    for number in range(MOST_IMPACTS):
        speed = np.linalg.norm(velocity, axis=1)
        distance, triangle = part.cast(start, velocity / speed[:, None])
        hit = triangle >= 0
        if not hit.any():
            break
        start, velocity, spin, which = start[hit], velocity[hit], spin[hit], which[hit]
        triangle = triangle[hit]
        start = start + (distance[hit] / speed[hit])[:, None] * velocity
        normal = part.normals[triangle]
        facing = np.einsum("ij,ij->i", velocity, normal)
        normal = np.where(facing[:, None] > 0.0, -normal, normal)
        approach = -np.abs(facing)
        slip = velocity - approach[:, None] * normal - np.cross(spin, normal)
        size = np.linalg.norm(slip, axis=1)
        push = -(1.0 + RESTITUTION) * approach
        share = np.full(len(size), 2.0 / 7.0)
        slides = share * size > mu_s * push
        share[slides] = mu_d * push[slides] / size[slides]
        drag = share[:, None] * slip
        velocity = velocity + push[:, None] * normal - drag
        spin = spin + 2.5 * np.cross(normal, drag)
        start = start + 1e-4 * normal
        patch = (triangle < 2) & (np.abs(start[:, 0]) <= 3.0) & (np.abs(start[:, 2] - 20.0) <= 5.0)
        if number == 0:
            on_target[which] = patch
            normals[which], tangentials[which] = push, share * size
        others.append(push[~patch])
        energy = np.sum(velocity**2, axis=1) + 0.4 * np.sum(spin**2, axis=1)
        goes_on = energy >= least[which]
        start, velocity, spin, which = (x[goes_on] for x in (start, velocity, spin, which))
        if not len(which):
            break
    others = np.concatenate(others) if others else np.zeros(0)
    return normals[on_target], tangentials[on_target], others, shots


def best_speed(normals, tangentials, others, shots):
    """J at its best speed, and that speed: J is convex in it and quadratic between breakpoints."""
    rebound = WEIGHTS["rebound"] * np.sum((others / ALLOWED) ** 2) / shots
    miss = WEIGHTS["miss"] * (1.0 - len(normals) / shots)
    if not len(normals):
        return miss + rebound * SPEEDS[0] ** 2, SPEEDS[0]
    n, t = normals / NORMAL, tangentials / TANGENTIAL

    def slope(speed):
        over = np.maximum(0.0, t * speed - 1.0)
        return np.mean(n * (n * speed - 1.0)) + np.mean(t * over) + rebound * speed

    low, high = SPEEDS
    while high - low > 1e-6 * high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if slope(middle) < 0.0 else (low, middle)
    over = np.maximum(0.0, t * low - 1.0)
    target = np.mean((n * low - 1.0) ** 2) + WEIGHTS["tangential"] * np.mean(over**2)
    return target + rebound * low**2 + miss, low


def objective(part, jet, friction):
    def value(point):
        violation = -min(0.0, part.clearance(aimed(point)[0]))
        if violation > 0.0:
            return INFEASIBLE + violation
        return best_speed(*impulses(part, jet, point, friction))[0]

    return value


def nelder_mead(value, seed):
    """Down from the best three of 64 points, within the bounds."""
    lower, upper = np.transpose(BOUNDS)
    starts = qmc.scale(qmc.Sobol(3, seed=seed).random(64), lower, upper)
    values = [value(start) for start in starts]
    ends = []
    for index in np.argsort(values)[:3]:
        options = {"xatol": 1e-3, "fatol": 1e-7, "maxfev": 400}
        ends.append(minimize(value, starts[index], method="Nelder-Mead", bounds=BOUNDS, options=options))
    best = min(ends, key=lambda end: end.fun)
    return best.x, best.fun


def evolution(value, seed):
    best = differential_evolution(value, BOUNDS, seed=seed, popsize=10, tol=1e-3, polish=False)
    return best.x, best.fun


def solve(part, method, shots, seed):
    """The best settings over all contacts, and the seconds that took."""
    before = time.perf_counter()
    answers = []
    for contact, friction in CONTACTS.items():
        jet = Jet(shots, seed)
        point, value = method(objective(part, jet, friction), seed)
        answers.append((value, contact, point, best_speed(*impulses(part, jet, point, friction))[1]))
    _, contact, point, speed = min(answers, key=lambda answer: answer[0])
    return (contact, *point, speed), time.perf_counter() - before


def true_objective(program, problem, settings):
    """J on many shots, by peenpose."""
    contact, *numbers = settings
    command = [program, "evaluate", problem, "--json", "--quiet", "--shots", str(1 << 18)]
    command += ["--set", f"contact={contact}"]
    for name, number, unit in zip(NAMES, numbers, ("deg", "deg", "mm", "m/s")):
        command += ["--set", f"{name}={float(number)} {unit}"]
    answer = subprocess.run(command, capture_output=True, text=True)
    if not answer.stdout:
        sys.exit(answer.stderr)
    objective = json.loads(answer.stdout)["best"]["objective"]
    return objective["total"] if objective else np.inf


def peenpose(program, problem, seed):
    before = time.perf_counter()
    command = [program, "solve", problem, "--json", "--quiet", "--seed", str(seed)]
    answer = subprocess.run(command, capture_output=True, text=True)
    seconds = time.perf_counter() - before
    best = json.loads(answer.stdout)["best"]
    to = best["settings"]
    pose = (to["incidence_deg"], to["azimuth_deg"], 1e3 * to["standoff_m"], to["speed_m_s"])
    return (best["contact"], *pose), seconds


def main():
    program = sys.argv[1]
    part = Part()
    shipped = (ROOT / "problems/keyway.yaml").read_text()
    with tempfile.TemporaryDirectory() as folder:
        problem = str(Path(folder) / "keyway.yaml")
        Path(problem).write_text(re.sub(r"(?m)^tolerance:.*\n", "", shipped))
        runs = {"peenpose": lambda seed: peenpose(program, problem, seed)}
        for name, method in (("Nelder-Mead", nelder_mead), ("differential evolution", evolution)):
            for shots in SHOTS[name]:
                runs[f"{name}, {shots} shots"] = (
                    lambda seed, method=method, shots=shots: solve(part, method, shots, seed)
                )
        found = {name: [] for name in runs}
        for seed in SEEDS:
            for name, run in runs.items():
                settings, seconds = run(seed)
                found[name].append((true_objective(program, problem, settings), seconds))
        least = min(true_objective(program, problem, settings) for settings in best_known())
        print(f"{'':36} {'median s':>9} {'within 1 %':>11} {'median excess':>14} {'worst':>7}")
        for name, results in found.items():
            excesses = np.array([objective / least - 1.0 for objective, _ in results])
            seconds = np.median([seconds for _, seconds in results])
            print(
                f"{name:36} {seconds:9.3f} {np.sum(excesses < 0.01):5} of {len(excesses):2}"
                f" {100 * np.median(excesses):12.2f} % {100 * excesses.max():5.1f} %"
            )


def best_known():
    """The best settings that brute force found for this problem."""
    with open(ROOT / "tests/data/best_known.csv", newline="") as table:
        for row in csv.DictReader(table):
            if (row["file"], row["tolerance"], row["shots"]) == ("keyway.yaml", "no", "spheres"):
                columns = ("incidence_deg", "azimuth_deg", "standoff_mm", "speed_m_s")
                yield row["contact"], *(float(row[column]) for column in columns)


if __name__ == "__main__":
    main()
