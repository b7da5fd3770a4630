"""Reference data of the tests: a thermoelastic plate that tumbles in its plane, with 30 digits and more.

    python3 plate.py SCHEME STEPS > plate_SCHEME_h0.02.csv

SCHEME is eem-entropy or eem-temperature; STEPS is the number of steps of 0.02 s. The state is printed
at steps 0, 1, 2, 5, 10 and 20. Needs Python 3.11 and mpmath 1.3.0 (`pip install mpmath==1.3.0`). A step
takes 2 to 4 s.

The plate is 3 × 2 elements of four nodes in plane strain, of thickness 1; SI units. Each of the 2 × 2
Gauss points of an element has its own temperature. With 60 digits plain difference quotients are exact
enough: the discrete equations are written here as they are defined, without the divided differences of
an implementation in floating point.
"""

import sys
from fractions import Fraction
from functools import lru_cache
from operator import add, sub

import mpmath as mp

mp.mp.dps = 60

# Shear modulus and its decrease per kelvin, Lamé's first parameter, thermal stress per kelvin, heat
# capacity per volume, reference temperature, density, conductivity.
MU, MU_1, LAME, BETA, CAPACITY, THETA_REF, DENSITY, CONDUCTIVITY = 1000, 2, 2000, 3, 100, 300, 10, 20
# Temperature of the reservoir, and point and conductance of each link to it.
RESERVOIR, RESERVOIR_LINKS = 300, [(0, 50), (23, 20)]
# The double nearest to 0.02.
STEP = mp.mpf(0.02)
PRINTED = 0, 1, 2, 5, 10, 20

AXES = range(2)
# Node i + 4 j is at (i + j²/10, j). The nodes of an element run counterclockwise.
NODES = [(i + Fraction(j * j, 10), Fraction(j)) for j in range(3) for i in range(4)]
ELEMENTS = [(n, n + 1, n + 5, n + 4) for n in (0, 1, 2, 4, 5, 6)]
CORNERS = [(-1, -1), (1, -1), (1, 1), (-1, 1)]


def real(x):
    return mp.mpf(x.numerator) / x.denominator


def mean(a, b):
    return (a + b) / 2


def combine(f, rows, others):
    """f of each two corresponding entries."""
    return [list(map(f, *pair)) for pair in zip(rows, others)]


def psi(e1, J, t):
    """Helmholtz free energy per volume. e1: trace of the Green–Lagrange strain, J = det F, t: θ.

    Derivatives by J and by the measure j = J − 1 are the same; the measure e2 does not occur."""
    heating, log = t - THETA_REF, mp.log(J)
    return ((MU - MU_1 * heating) * (e1 - log) + LAME * log * log / 2 - BETA * heating * log
            + CAPACITY * (heating - t * mp.log(t / THETA_REF)))


def entropy(e1, J, t):
    log = mp.log(J)
    return MU_1 * (e1 - log) + BETA * log + CAPACITY * mp.log(t / THETA_REF)


def energy(e1, J, t):
    return psi(e1, J, t) + t * entropy(e1, J, t)


def energy_of_entropy(e1, J, s):
    t = THETA_REF * mp.exp((s - entropy(e1, J, mp.mpf(THETA_REF))) / CAPACITY)
    return energy(e1, J, t)


def quotient(f, x0, x1):
    """(f(x1) − f(x0))/(x1 − x0), and the derivative in the middle if the two are one."""
    if abs(x1 - x0) < mp.mpf(10) ** -20 * (1 + abs(x0)):
        d, middle = mp.mpf(10) ** -18 * (1 + abs(x0)), mean(x0, x1)
        return (f(middle + d) - f(middle - d)) / (2 * d)
    return (f(x1) - f(x0)) / (x1 - x0)


def partials(f, x0, x1):
    """Discrete derivatives of f: the means over both orders in which the arguments change, García
    Orden & Romero (2012), (28)."""
    return [mean(quotient(lambda x: f(*x0[:i], x, *x1[i + 1:]), x0[i], x1[i]),
                 quotient(lambda x: f(*x1[:i], x, *x0[i + 1:]), x0[i], x1[i])) for i in range(3)]


@lru_cache(maxsize=1000)
def algorithmic(scheme, x0, x1):
    """Conjugates of e1 and J, temperature of a step, and the change of entropy, all per volume.

    Cached for the tangent: moving one unknown changes the state of a few points only."""
    s0, s1 = entropy(*x0), entropy(*x1)
    if scheme == 'eem-temperature':
        e_e1, e_J, e_t = partials(energy, x0, x1)
        s_e1, s_J, s_t = partials(entropy, x0, x1)
        theta = e_t / s_t
        return e_e1 - theta * s_e1, e_J - theta * s_J, theta, s1 - s0
    return *partials(energy_of_entropy, (*x0[:2], s0), (*x1[:2], s1)), s1 - s0


def shapes(xi, eta):
    """Shape functions at a point of the parent square, and their derivatives there."""
    return ([(1 + a * xi) * (1 + b * eta) / 4 for a, b in CORNERS],
            [(a * (1 + b * eta) / 4, b * (1 + a * xi) / 4) for a, b in CORNERS])


def gauss_points(rule):
    """Of each point: element, shape functions, their derivatives by the reference position, weight.
    Element by element, the first parent coordinate fastest. rule: abscissas and weights on an axis."""
    for element in ELEMENTS:
        corners = [[real(x) for x in NODES[n]] for n in element]
        for (eta, v), (xi, w) in ((y, x) for y in rule for x in rule):
            values, slopes = shapes(xi, eta)
            (a, b), (c, d) = [[sum(x[i] * g[k] for x, g in zip(corners, slopes)) for k in AXES]
                              for i in AXES]
            det = a * d - b * c
            gradients = [((d * g - c * h) / det, (a * h - b * g) / det) for g, h in slopes]
            yield element, values, gradients, v * w * det


def mass_matrix():
    """Consistent masses by the rule of 3 × 3 points."""
    x, matrix = mp.sqrt(mp.mpf(3) / 5), [[mp.mpf(0)] * len(NODES) for _ in NODES]
    rule = [(-x, mp.mpf(5) / 9), (mp.mpf(0), mp.mpf(8) / 9), (x, mp.mpf(5) / 9)]
    for element, values, _, w in gauss_points(rule):
        for m, a in zip(element, values):
            for n, b in zip(element, values):
                matrix[m][n] += DENSITY * a * b * w
    return matrix


def conductances():
    """(point, point, W/K) of neighbours, computed in exact fractions.

    The lines ξ = 0 and η = 0 cut an element into four cells, one for each point. Half a cell, from its
    centre to the middle of an edge, conducts t = k |n·d|/|d|², where d joins the two and the normal n is
    as long as the edge. The two halves at a common edge conduct in series."""
    edges = {}
    for number, element in enumerate(ELEMENTS):
        for point, (a, b) in enumerate((a, b) for b in (-1, 1) for a in (-1, 1)):
            weights = [shapes(Fraction(a + c, 2), Fraction(b + d, 2))[0] for c, d in (*CORNERS, (0, 0))]
            *vertices, centre = [tuple(sum(v * NODES[n][i] for v, n in zip(values, element)) for i in AXES)
                                 for values in weights]
            for start, end in zip(vertices, vertices[1:] + vertices[:1]):
                x, y = map(sub, end, start)
                u, v = map(sub, map(mean, start, end), centre)
                t = CONDUCTIVITY * abs(x * v - y * u) / (u * u + v * v)
                edges.setdefault(frozenset((start, end)), []).append((4 * number + point, t))
    inner = [cells for cells in edges.values() if len(cells) == 2]
    return [(a, b, real(t * u / (t + u))) for (a, t), (b, u) in inner]


POINTS = list(gauss_points([(-1 / mp.sqrt(3), 1), (1 / mp.sqrt(3), 1)]))
MASS, LINKS = mass_matrix(), conductances()


def kinematics(q, element, gradients):
    """F and FᵀF in the plane, e1 and J. Nothing stretches across the plane."""
    F = [[sum(q[n][i] * b[k] for n, b in zip(element, gradients)) for k in AXES] for i in AXES]
    C = [[sum(F[i][k] * F[i][l] for i in AXES) for l in AXES] for k in AXES]
    return F, C, ((C[0][0] + C[1][1] - 2) / 2, F[0][0] * F[1][1] - F[0][1] * F[1][0])


def point_forces(scheme, q0, q1, t0, t1, point):
    """Internal forces of a point at its nodes, its temperature in the step and its change of entropy."""
    element, _, gradients, w = point
    F0, C0, x0 = kinematics(q0, element, gradients)
    F1, C1, x1 = kinematics(q1, element, gradients)
    f_e1, f_J, theta, ds = algorithmic(scheme, (*x0, t0), (*x1, t1))
    Fm, ((a, b), (_, d)) = combine(mean, F0, F1), combine(mean, C0, C1)
    # ΔJ = 2 cof(C_m):ΔE/(J⁰ + J¹) exactly, and Δe1 = 1:ΔE.
    f = 2 * f_J / (x0[1] + x1[1])
    S = [[f_e1 + f * d, -f * b], [-f * b, f_e1 + f * a]]
    P = [[w * sum(Fm[i][k] * S[k][l] for k in AXES) for l in AXES] for i in AXES]
    return [[P[i][0] * g + P[i][1] * h for i in AXES] for g, h in gradients], theta, w * ds


def unpack(z):
    """Increments of the positions and temperatures at the end of a step."""
    return [z[i:i + 2] for i in range(0, 2 * len(NODES), 2)], z[2 * len(NODES):]


def residual(scheme, state, z):
    """What a step has to bring to zero, and the temperatures θ* of the points in it: at the nodes inertia
    plus internal force, at the points θ* Δs/h less the heat that flows in."""
    (q0, v0, t0, _), (dq, t1) = state, unpack(z)
    acceleration = combine(lambda d, v: 2 / STEP * (d / STEP - v), dq, v0)
    balance = [[sum(m * a[i] for m, a in zip(row, acceleration)) for i in AXES] for row in MASS]
    q1, theta, heating = combine(add, q0, dq), [], []
    for point, a, b in zip(POINTS, t0, t1):
        forces, t, ds = point_forces(scheme, q0, q1, a, b, point)
        theta.append(t)
        heating.append(t * ds / STEP)
        for n, force in zip(point[0], forces):
            balance[n] = list(map(add, balance[n], force))
    for a, b, k in LINKS:
        heating[a] -= k * (theta[b] - theta[a])
        heating[b] -= k * (theta[a] - theta[b])
    for a, k in RESERVOIR_LINKS:
        heating[a] -= k * (RESERVOIR - theta[a])
    return [x for row in balance for x in row] + heating, theta


def step(scheme, state):
    """Positions, velocities, temperatures and the entropy of the reservoir after a step."""
    q0, v0, t0, received = state
    z, size = [STEP * x for row in v0 for x in row] + t0, mp.mpf(1)
    for _ in range(60):
        r, theta = residual(scheme, state, z)
        if size < mp.mpf(10) ** -36:
            dq, t1 = unpack(z)
            heat = STEP * sum(k * (theta[a] - RESERVOIR) for a, k in RESERVOIR_LINKS)
            v1 = combine(lambda d, v: 2 * d / STEP - v, dq, v0)
            return combine(add, q0, dq), v1, t1, received + heat / RESERVOIR
        # Close to the solution the tangent of the iteration before will do.
        if size > mp.mpf(10) ** -3:
            columns = []
            for j, x in enumerate(z):
                d = mp.mpf(10) ** -16 * (1 + abs(x))
                moved, _ = residual(scheme, state, z[:j] + [x + d] + z[j + 1:])
                columns.append([(a - b) / d for a, b in zip(moved, r)])
            lu, order = mp.mp.LU_decomp(mp.matrix(columns).T)
        dz = mp.mp.U_solve(lu, mp.mp.L_solve(lu, -mp.matrix(r), order))
        z, size = [a + b for a, b in zip(z, dz)], max(abs(b) / (1 + abs(a)) for a, b in zip(z, dz))
    raise RuntimeError('no convergence')


def total_energy(state):
    q, v, theta, received = state
    kinetic = sum(m * a[i] * b[i] / 2 for row, a in zip(MASS, v) for m, b in zip(row, v) for i in AXES)
    internal = sum(w * energy(*kinematics(q, e, g)[2], t) for (e, _, g, w), t in zip(POINTS, theta))
    return kinetic + internal + RESERVOIR * received


def write_state(index, state):
    q, v, theta, received = state
    for what, group, rows in (('q', '', q), ('v', '', v), ('theta', 0, [[t] for t in theta]),
                              ('reservoir_entropy', '', [[received]])):
        for n, row in enumerate(rows):
            print(index, what, group, n, *(mp.nstr(x, 20) for x in row), sep=',', flush=True)


def main(arguments):
    match arguments:
        case ['eem-entropy' | 'eem-temperature' as scheme, count]:
            q = [[real(x) for x in node] for node in NODES]
            v = [[x * y / 2 - y, 2 * x - y / 2] for x, y in q]
            state = q, v, [mp.mpf(320 + 4 * n) for n in range(len(POINTS))], mp.mpf(0)
        case _:
            sys.exit(__doc__)
    start = total_energy(state)
    print('step,what,group,index,values...')
    for index in range(int(count) + 1):
        if index > 0:
            state = step(scheme, state)
        if index in PRINTED:
            write_state(index, state)
    print('energy defect', mp.nstr((total_energy(state) - start) / start, 5), file=sys.stderr)


if __name__ == '__main__':
    main(sys.argv[1:])
