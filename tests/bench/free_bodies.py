#!/usr/bin/env python3
"""free_bodies.py N > scene.yaml: N free bodies under gravity, far apart, of all kinds.

A tenth of them are axisymmetric and a tenth spherical; the others have three different moments and
tumble at 0.1 to 10 rad/s about any axis. They have no shapes: nothing touches. The same N gives the
same file.

Closed form of each: the centre is c0 + v0 t + g t^2/2, the angular momentum stays, and the rotation is
that of a body without torque (tests/scenes/tumble.yaml)."""

import random
import sys


def moments(rng, i):
    """Principal moments [kg m2] of a solid: none exceeds the sum of the others."""
    if i % 10 == 0:
        return [1.0, 1.0, 1.0]
    if i % 10 == 1:
        return [1.0, 1.0, rng.uniform(0.1, 1.9)]
    a, b, c = (rng.uniform(0.1, 1.0) for _ in range(3))  # mean squares along the axes
    return [b + c, c + a, a + b]


def vector(rng, size):
    return [rng.uniform(-size, size) for _ in range(3)]


def text(numbers):
    return "[" + ", ".join(f"{x:.6g}" for x in numbers) + "]"


def main():
    if len(sys.argv) != 2 or not sys.argv[1].isdigit() or int(sys.argv[1]) == 0:
        sys.exit(f"usage: {sys.argv[0]} N > scene.yaml")
    count = int(sys.argv[1])
    rng = random.Random(count)
    print(f"# {count} free bodies under gravity: free_bodies.py {count}")
    print(f"world: free_{count}\nbodies:")
    for i in range(count):
        jx, jy, jz = (f"{x:.6g}" for x in moments(rng, i))
        spin = 10 ** rng.uniform(-1, 1)
        axis = vector(rng, 1)
        length = sum(x * x for x in axis) ** 0.5
        print(f"  - {{name: body_{i}, mass: {rng.uniform(0.5, 2):.6g}, "
              f"inertia: {{ixx: {jx}, iyy: {jy}, izz: {jz}}}, "
              f"position: {text([3 * (i % 100), 3 * (i // 100 % 100), 3 * (i // 10000)])}, "
              f"linear_velocity: {text(vector(rng, 1))}, "
              f"angular_velocity: {text([spin * x / length for x in axis])}}}")


if __name__ == "__main__":
    main()
