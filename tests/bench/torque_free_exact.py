#!/usr/bin/env python3
"""Judges free rotations that bench_torque_free_sweep could not: the closed form in 90 digits.

Reads the sweep's output, prints it on, and says how far each body's orientation is from Jacobi's
solution (van Zon and Schofield, J. Comput. Phys. 225 (2007) 145). Needs python3-mpmath.
"""

import sys

from mpmath import (atan, atan2, det, ellipf, ellipk, exp, expj, im, jtheta, matrix, mp, mpc, mpf,
                    nint, nstr, norm, pi, re, sign, sin, sqrt, zeros)

mp.dps = 90
FEW_TERMS = mpf("0.05")  # nomes up to which mpmath's own theta series are quick


def rotation(x, y, z, w):
    """The matrix of a quaternion that need not be unit."""
    n = x * x + y * y + z * z + w * w
    return matrix([
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z]]) / n


def shortest_arc(m):
    """The rotation by the shortest arc from m to the third axis."""
    m = m / norm(m)
    return rotation(m[1], -m[0], mpf(0), 1 + m[2])


def circled_frame(moments, m_body):
    """Moments, axes (columns, in the body) and momentum with the third axis circled, m3 > 0."""
    order = sorted(range(3), key=lambda i: moments[i])
    inertia = [moments[i] for i in order]
    axes = zeros(3, 3)
    for k, i in enumerate(order):
        axes[i, k] = 1
    if det(axes) < 0:
        axes[:, 2] = -axes[:, 2]
    m = axes.T * m_body
    i1, i2, i3 = inertia
    if (i3 - i2) / i3 * m[2] ** 2 < (i2 - i1) / i1 * m[0] ** 2:
        turn = matrix([[0, 0, 1], [0, -1, 0], [1, 0, 0]])
        axes, m, inertia = axes * turn, turn.T * m, [i3, i2, i1]
    if m[2] < 0:
        turn = matrix([[1, 0, 0], [0, -1, 0], [0, 0, -1]])
        axes, m = axes * turn, turn.T * m
    return inertia, axes, m


def orientation(moments, q, momentum, t):
    """The exact orientation (body to world) at time t, as a matrix, and k'^2."""
    start = rotation(*q)
    (i1, i2, i3), axes, m = circled_frame(moments, start.T * matrix(momentum))
    a1, a2, a3 = (i2 - i3) / (i2 * i3), (i3 - i1) / (i3 * i1), (i1 - i2) / (i1 * i2)
    size = norm(m)
    big1 = sqrt(m[0] ** 2 + abs(a1 / a2) * m[1] ** 2)
    big2 = sqrt(m[1] ** 2 + abs(a2 / a1) * m[0] ** 2)
    big3 = sqrt(m[2] ** 2 + abs(a3 / a2) * m[1] ** 2)
    kp2 = (abs(a1) * m[2] ** 2 - abs(a3) * m[0] ** 2) / (abs(a1) * big3 ** 2)
    k2 = 1 - kp2
    rate = sign(a2) * big3 * sqrt(abs(a1 * a2))
    quarter, quarter_p = ellipk(k2), ellipk(kp2)
    nome, nome_p = exp(-pi * quarter_p / quarter), exp(-pi * quarter / quarter_p)
    u0 = ellipf(atan2(m[1] / big2, m[0] / big1), k2)
    b = ellipf(atan(big3 / big1), kp2)
    spread = pi * quarter_p / quarter

    def theta(kind, z):
        if nome < FEW_TERMS:
            return jtheta(kind, z, nome)
        nearest = int(nint(re(z) / pi))
        total = mpc(0)  # a common factor is left out
        for n in range(nearest - 12, nearest + 13):
            centre = (n + mpf(1) / 2) * pi if kind in (1, 4) else n * pi
            total += (-1 if kind in (1, 2) and n % 2 else 1) * exp(-(z - centre) ** 2 / spread)
        return total

    t2, t3, t4 = (re(theta(k, mpf(0))) for k in (2, 3, 4))

    def momentum_at(u):
        z = pi * u / (2 * quarter)
        below = re(theta(4, z))
        return matrix([big1 * t4 / t2 * re(theta(2, z)), big2 * t3 / t2 * re(theta(1, z)),
                       big3 * t4 / t3 * re(theta(3, z))]) / below

    if nome < FEW_TERMS:
        z = mpc(0, pi * b / (2 * quarter))
        zeta = re(-1j * pi / (2 * quarter) * jtheta(4, z, nome, 1) / jtheta(4, z, nome))
        turning = size / i1 - zeta * rate
    else:
        zeta = 2 * pi / quarter_p * sum(nome_p ** n / (1 - nome_p ** (2 * n)) *
                                        sin(n * pi * b / quarter_p) for n in range(1, 80))
        energy = m[0] ** 2 / i1 + m[1] ** 2 / i2 + m[2] ** 2 / i3
        turning = energy / size + rate * (zeta + pi * b / (2 * quarter * quarter_p))

    def phase(u):
        v = momentum_at(u)
        return theta(4, mpc(pi * u / (2 * quarter), pi * b / (2 * quarter))) * mpc(v[0], -v[1])

    u = u0 + rate * t
    e = phase(u) / phase(u0)
    e = e / abs(e) * expj(turning * t)
    about = matrix([[re(e), -im(e), 0], [im(e), re(e), 0], [0, 0, 1]])
    exact = (start * axes * shortest_arc(momentum_at(u0)).T * about *
             shortest_arc(momentum_at(u)) * axes.T)
    return exact, kp2


def angle(a, b):
    """Angle of the rotation from a to b."""
    d = a.T * b
    sine = sqrt((d[2, 1] - d[1, 2]) ** 2 + (d[0, 2] - d[2, 0]) ** 2 + (d[1, 0] - d[0, 1]) ** 2) / 2
    return atan2(sine, (d[0, 0] + d[1, 1] + d[2, 2] - 1) / 2)


def main():
    judged, worst, smallest = 0, mpf(0), mpf(1)
    for line in sys.stdin:
        if not line.startswith("judge:"):
            print(line, end="")
            continue
        v = [mpf(float(word)) for word in line.split()[1:]]
        exact, kp2 = orientation(v[0:3], v[3:7], v[7:10], v[10])
        judged += 1
        worst = max(worst, angle(exact, rotation(*v[11:15])))
        smallest = min(smallest, kp2)
    print(f"{judged} judged in {mp.dps} digits: worst error {nstr(worst, 3)} rad, "
          f"k'^2 down to {nstr(smallest, 2)}")


if __name__ == "__main__":
    main()
