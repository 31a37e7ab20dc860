"""The keyway traced in its cross-section by numba: what a good script reaches on one core.

    python3 -m venv /tmp/numba && /tmp/numba/bin/pip install numba
    taskset -c 0 /tmp/numba/bin/python benches/peers/keyway_numba.py
    taskset -c 0 cargo bench --bench pose -- 'rays/keyway 200 mm, exact'

Both trace a jet at 60 deg incidence, 20 deg azimuth and 10 mm standoff in the hub of
problems/keyway-long.yaml, dry, up to six impacts, and count rays with impacts and sums included.
The shots are drawn beforehand in both.
"""

import math
import time

import numpy as np
from numba import njit

LENGTH, BORE, HALF_WIDTH, FLOOR = 0.2, 0.015, 0.004, 0.0183
CORNER = math.sqrt(BORE**2 - HALF_WIDTH**2)
MU_S, MU_D, RESTITUTION = 0.30, 0.27, 0.25
MOST_IMPACTS, LEAST_ENERGY = 6, 0.01
NOWHERE, FLOOR_WALL, NEGATIVE, POSITIVE, ARC = 0, 1, 2, 3, 4


@njit(error_model="numpy", inline="always")
def first_wall(x, y, z, u, v, w, left):
    """Distance and wall of the first crossing; `left` is the wall that the ray starts from."""
    best, wall = np.inf, NOWHERE
    if left != FLOOR_WALL:
        t = (FLOOR - y) / v
        if 0.0 < t < best and abs(x + t * u) <= HALF_WIDTH and 0.0 <= z + t * w <= LENGTH:
            best, wall = t, FLOOR_WALL
    if left != NEGATIVE:
        t = (-HALF_WIDTH - x) / u
        if 0.0 < t < best and CORNER <= y + t * v <= FLOOR and 0.0 <= z + t * w <= LENGTH:
            best, wall = t, NEGATIVE
    if left != POSITIVE:
        t = (HALF_WIDTH - x) / u
        if 0.0 < t < best and CORNER <= y + t * v <= FLOOR and 0.0 <= z + t * w <= LENGTH:
            best, wall = t, POSITIVE
    a, b = u * u + v * v, x * u + y * v
    c = 0.0 if left == ARC else x * x + y * y - BORE * BORE
    root = b * b - a * c
    if root > 0.0:
        root = math.sqrt(root)
        for t in ((-b - root) / a, (-b + root) / a):
            if 1e-12 < t < best and 0.0 <= z + t * w <= LENGTH:
                if y + t * v < CORNER or abs(x + t * u) > HALF_WIDTH:
                    best, wall = t, ARC
    return best, wall


@njit(error_model="numpy", fastmath=True)
def trace(start, flight):
    """Sums of normal impulses per mass, squared after the first impact, and the rays cast."""
    first, later, rays = 0.0, 0.0, 0
    for i in range(start.shape[0]):
        x, y, z = start[i, 0], start[i, 1], start[i, 2]
        u, v, w = flight[i, 0], flight[i, 1], flight[i, 2]
        p = q = r = 0.0  # R w
        least = LEAST_ENERGY * (u * u + v * v + w * w)
        wall = NOWHERE
        for number in range(MOST_IMPACTS):
            rays += 1
            t, wall = first_wall(x, y, z, u, v, w, wall)
            if wall == NOWHERE:
                break
            x, y, z = x + t * u, y + t * v, z + t * w
            if wall == FLOOR_WALL:
                nx, ny = 0.0, -1.0
            elif wall == NEGATIVE:
                nx, ny = 1.0, 0.0
            elif wall == POSITIVE:
                nx, ny = -1.0, 0.0
            else:
                nx, ny = -x / BORE, -y / BORE
            speed = u * nx + v * ny
            # Slip of the contact point: tangential velocity and n x R w.
            a, b, c = u - speed * nx + ny * r, v - speed * ny - nx * r, w + nx * q - ny * p
            slip = math.sqrt(a * a + b * b + c * c)
            normal = -(1.0 + RESTITUTION) * speed
            share = 2.0 / 7.0
            if share * slip > MU_S * normal:
                share = MU_D * normal / slip
            a, b, c = a * share, b * share, c * share
            u, v, w = u + normal * nx - a, v + normal * ny - b, w - c
            p, q, r = p + 2.5 * ny * c, q - 2.5 * nx * c, r + 2.5 * (nx * b - ny * a)
            if number == 0:
                first += normal
            else:
                later += normal * normal
            if u * u + v * v + w * w + 0.4 * (p * p + q * q + r * r) < least:
                break
    return first, later, rays


def jet(shots, seed=1):
    """Exit points and velocities of a jet that is uniform in its disc and in solid angle."""
    rng = np.random.default_rng(seed)
    incidence, azimuth = math.radians(60.0), math.radians(20.0)
    axis = np.array([
        math.cos(incidence) * math.sin(azimuth),
        math.sin(incidence),
        math.cos(incidence) * math.cos(azimuth),
    ])
    side = np.cross(axis, [0.0, 0.0, 1.0])
    side /= np.linalg.norm(side)
    up = np.cross(side, axis)
    radius, turn = 0.75e-3 * np.sqrt(rng.random(shots)), 2 * np.pi * rng.random(shots)
    exits = np.array([0.0, FLOOR, LENGTH / 2]) - 10e-3 * axis
    exits = exits + np.outer(radius * np.cos(turn), side) + np.outer(radius * np.sin(turn), up)
    cosine = 1.0 - (1.0 - math.cos(math.radians(4.0))) * rng.random(shots)
    sine, turn = np.sqrt(1.0 - cosine**2), 2 * np.pi * rng.random(shots)
    flight = np.outer(cosine, axis) + np.outer(sine * np.cos(turn), side)
    flight += np.outer(sine * np.sin(turn), up)
    scatter = 1.0 + 0.05 * np.clip(rng.standard_normal(shots), -2.0, 2.0)
    return exits, flight * scatter[:, None]


def main():
    start, flight = jet(1024)
    trace(start, flight)
    times = []
    for _ in range(2000):
        before = time.perf_counter()
        _, _, rays = trace(start, flight)
        times.append(time.perf_counter() - before)
    print(f"{rays / 1024:.2f} rays a shot, {rays / np.median(times) / 1e6:.1f} million rays/s")


if __name__ == "__main__":
    main()
