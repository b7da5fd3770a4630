"""Reference data of the tests: the published pendulums, discrete and continuous, with 40 digits.

    python3 reference.py CASE SCHEME STEP COUNT > CASE_SCHEME_hSTEP.csv
    python3 reference.py CASE exact TIME...     > CASE_exact.csv

CASE is single_pendulum, double_pendulum_romero, double_pendulum_kruger or double_pendulum_log;
SCHEME is eem-entropy or eem-temperature; STEP and TIME are in seconds. README.md in this folder has
the command of every file. Needs Python 3.11 and mpmath 1.3.0 (`pip install mpmath==1.3.0`). A step
takes 0.1 to 1 s, the whole of `exact` 2 to 10 min.

With 40 digits plain difference quotients are exact enough: the discrete equations are written here
as they are in the papers, without the divided differences of an implementation in floating point.
"""

import sys

import mpmath as mp

mp.mp.dps = 40


def numbers(*texts):
    return [mp.mpf(text) for text in texts]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def difference(a, b):
    return [x - y for x, y in zip(a, b)]


def norm(a):
    return mp.sqrt(dot(a, a))


class Logarithmic:
    """Thermoelastic spring, logarithmic in the stretch: Conde Martín, Betsch & García Orden (2016), (43)."""

    has_dashpot = False

    def __init__(self, stiffness, softening, coupling, capacity, length, theta_ref):
        self.stiffness, self.softening, self.coupling = numbers(stiffness, softening, coupling)
        self.capacity, self.length, self.theta_ref = numbers(capacity, length, theta_ref)

    def psi(self, l, g, t):
        strain, ref = mp.log(l / self.length), self.theta_ref
        modulus = self.stiffness - self.softening * ref * mp.log(t / ref)
        return (modulus / 2 * strain * strain - self.coupling * (t - ref) * strain
                + self.capacity * (t - ref - t * mp.log(t / ref)))

    def entropy(self, l, g, t):
        strain, ref = mp.log(l / self.length), self.theta_ref
        slope = -self.softening * ref / t
        return -slope / 2 * strain * strain + self.coupling * strain + self.capacity * mp.log(t / ref)


class ThermoViscoElastic:
    """Spring with one dashpot: García Orden & Romero (2012), §4.1."""

    has_dashpot = True

    def __init__(self):
        self.k0, self.k1, self.ratio, self.coupling = numbers(100, '0.5', '0.1', 4)
        self.capacity, self.mu0, self.mu1 = numbers(1, 5, '0.1')
        self.eta0, self.a, self.length, self.theta_ref = numbers(100, 10, 1, 300)

    def psi(self, l, g, t):
        strain, heating = mp.log(l / self.length), t - self.theta_ref
        k = self.k0 - self.k1 * heating
        elastic = (k / 2 * strain * strain - self.coupling * heating * strain
                   + self.capacity * (heating - t * mp.log(t / self.theta_ref)))
        return ((1 + self.ratio) * elastic + (self.mu0 - self.mu1 * heating) * g * g
                - self.ratio * g * (k * strain - self.coupling * heating) / l)

    def entropy(self, l, g, t):
        strain = mp.log(l / self.length)
        return ((1 + self.ratio) * (self.k1 / 2 * strain * strain + self.coupling * strain
                                    + self.capacity * mp.log(t / self.theta_ref))
                + self.mu1 * g * g - self.ratio * g * (self.k1 * strain + self.coupling) / l)

    def viscosity(self, t):
        return self.eta0 * mp.exp(self.a * (1 / t - 1 / self.theta_ref))


def energy(model, l, g, t):
    return model.psi(l, g, t) + t * model.entropy(l, g, t)


def temperature(model, l, g, s, guess):
    """θ with s(λ, γ, θ) = s, by Newton's method for ln θ."""
    t = guess
    for _ in range(200):
        d = mp.mpf(10) ** -18 * t
        slope = (model.entropy(l, g, t + d) - model.entropy(l, g, t - d)) / (2 * d)
        update = (model.entropy(l, g, t) - s) / (slope * t)
        update = max(min(update, mp.mpf(1)), mp.mpf(-1))
        t = t * mp.exp(-update)
        if abs(update) < mp.mpf(10) ** -30:
            return t
    raise RuntimeError('no temperature')


def quotient(f, x0, x1):
    """(f(x1) − f(x0))/(x1 − x0), and the derivative in the middle if the two are one."""
    if abs(x1 - x0) < mp.mpf(10) ** -28 * (1 + abs(x0)):
        d, middle = mp.mpf(10) ** -12 * (1 + abs(x0)), (x0 + x1) / 2
        return (f(middle + d) - f(middle - d)) / (2 * d)
    return (f(x1) - f(x0)) / (x1 - x0)


def partials(f, state0, state1):
    """Discrete derivatives of f(λ, γ, θ or s): the means over both orders in which the arguments
    change, García Orden & Romero (2012), (28)."""
    (l0, g0, x0), (l1, g1, x1) = state0, state1
    return [
        (quotient(lambda l: f(l, g1, x1), l0, l1) + quotient(lambda l: f(l, g0, x0), l0, l1)) / 2,
        (quotient(lambda g: f(l0, g, x1), g0, g1) + quotient(lambda g: f(l1, g, x0), g0, g1)) / 2,
        (quotient(lambda x: f(l0, g0, x), x0, x1) + quotient(lambda x: f(l1, g1, x), x0, x1)) / 2,
    ]


def algorithmic(scheme, model, state0, state1):
    """Force along λ, force on the dashpot and temperature of a step, and the change of entropy."""
    (l0, g0, t0), (l1, g1, t1) = state0, state1
    s0, s1 = model.entropy(*state0), model.entropy(*state1)
    if scheme == 'eem-temperature':
        e_l, e_g, e_t = partials(lambda l, g, t: energy(model, l, g, t), state0, state1)
        s_l, s_g, s_t = partials(model.entropy, state0, state1)
        theta = e_t / s_t
        return e_l - theta * s_l, -(e_g - theta * s_g), theta, s1 - s0

    def energy_of(l, g, s):
        # Either temperature is a guess as good as the other.
        return energy(model, l, g, temperature(model, l, g, s, t0))

    e_l, e_g, e_s = partials(energy_of, (l0, g0, s0), (l1, g1, s1))
    return e_l, -e_g, e_s, s1 - s0


class System:
    """Point masses and springs between them.

    springs: (model, i, j) with the numbers of two nodes, None for the origin;
    contacts: (spring, spring, conductance);
    surroundings: (spring, conductance, temperature).
    """

    def __init__(self, dimension, masses, springs, contacts=(), surroundings=()):
        self.dimension, self.masses, self.springs = dimension, numbers(*masses), springs
        self.contacts = [(a, b, mp.mpf(k)) for a, b, k in contacts]
        self.surroundings = [(a, mp.mpf(k), mp.mpf(t)) for a, k, t in surroundings]

    def unpack(self, z):
        """q, p, θ and γ of a state."""
        nodes, d, springs = len(self.masses), self.dimension, len(self.springs)
        vectors = [z[i * d:(i + 1) * d] for i in range(2 * nodes)]
        rest = z[2 * nodes * d:]
        return vectors[:nodes], vectors[nodes:], rest[:springs], rest[springs:]

    def arm(self, q, i, j):
        origin = [mp.mpf(0)] * self.dimension
        return difference(origin if i is None else q[i], origin if j is None else q[j])

    def heat(self, theta):
        """Entropy per time that conduction brings to each spring at these temperatures."""
        flows = [mp.mpf(0) for _ in self.springs]
        for a, b, k in self.contacts:
            flows[a] += k * (theta[b] - theta[a]) / theta[a]
            flows[b] += k * (theta[a] - theta[b]) / theta[b]
        for a, k, t in self.surroundings:
            flows[a] -= k * (theta[a] - t) / theta[a]
        return flows

    def to_surroundings(self, theta):
        """Entropy per time that the surroundings receive."""
        return sum((k * (theta[a] - t) / t for a, k, t in self.surroundings), mp.mpf(0))

    def energy(self, z):
        q, p, theta, gamma = self.unpack(z)
        kinetic = sum(dot(a, a) / 2 / m for a, m in zip(p, self.masses))
        lengths = [norm(self.arm(q, i, j)) for _, i, j in self.springs]
        springs = zip(self.springs, lengths, gamma, theta)
        return kinetic + sum(energy(spring[0], l, g, t) for spring, l, g, t in springs)

    def residual(self, scheme, z0, z1, h):
        """What a step has to bring to zero, and the temperatures θ* of the springs in it."""
        q0, p0, theta0, gamma0 = self.unpack(z0)
        q1, p1, theta1, gamma1 = self.unpack(z1)
        nodes, d = range(len(self.masses)), range(self.dimension)
        force = [[mp.mpf(0) for _ in d] for _ in nodes]
        theta, change, production, creep = [], [], [], []
        for k, (model, i, j) in enumerate(self.springs):
            r0, r1 = self.arm(q0, i, j), self.arm(q1, i, j)
            l0, l1 = norm(r0), norm(r1)
            states = (l0, gamma0[k], theta0[k]), (l1, gamma1[k], theta1[k])
            along, on_dashpot, t, ds = algorithmic(scheme, model, *states)
            theta.append(t)
            change.append(ds)
            for axis in d:
                pull = along / ((l0 + l1) / 2) * (r0[axis] + r1[axis]) / 2
                if i is not None:
                    force[i][axis] -= pull
                if j is not None:
                    force[j][axis] += pull
            if model.has_dashpot:
                eta = model.viscosity(t)
                production.append(on_dashpot * on_dashpot / eta / t)
                creep.append(gamma1[k] - gamma0[k] - h * on_dashpot / eta)
            else:
                production.append(mp.mpf(0))
                creep.append(gamma1[k] - gamma0[k])
        rows = [q1[i][x] - q0[i][x] - h / 2 / self.masses[i] * (p0[i][x] + p1[i][x])
                for i in nodes for x in d]
        rows += [p1[i][x] - p0[i][x] - h * force[i][x] for i in nodes for x in d]
        flows = zip(change, production, self.heat(theta))
        rows += [ds - h * (own + heat) for ds, own, heat in flows]
        return rows + creep, theta

    def step(self, scheme, z0, h):
        """The state after a step, and the entropy that the surroundings receive in it."""
        z, size = list(z0), range(len(z0))
        for _ in range(60):
            r, _ = self.residual(scheme, z0, z, h)
            tangent = mp.zeros(len(z), len(z))
            for j in size:
                d = mp.mpf(10) ** -16 * (1 + abs(z[j]))
                moved = z[:j] + [z[j] + d] + z[j + 1:]
                r_moved, _ = self.residual(scheme, z0, moved, h)
                for i in size:
                    tangent[i, j] = (r_moved[i] - r[i]) / d
            dz = mp.lu_solve(tangent, -mp.matrix(r))
            z = [a + b for a, b in zip(z, dz)]
            if max(abs(b) / (1 + abs(a)) for a, b in zip(z, dz)) < mp.mpf(10) ** -26:
                _, theta = self.residual(scheme, z0, z, h)
                return z, h * self.to_surroundings(theta)
        raise RuntimeError('no convergence')

    def rate(self, z):
        """The continuous equations: d/dt of q, p, θ, γ and of the entropy of the surroundings."""
        q, p, theta, gamma = self.unpack(z[:-1])
        velocity = [[x / m for x in row] for row, m in zip(p, self.masses)]
        force = [[mp.mpf(0)] * self.dimension for _ in p]
        flows, heating, creep = self.heat(theta), [], []
        for k, (model, i, j) in enumerate(self.springs):
            r, l = self.arm(q, i, j), norm(self.arm(q, i, j))
            g, t = gamma[k], theta[k]
            f = derivative(lambda x: model.psi(x, g, t), l)
            for axis in range(self.dimension):
                pull = f * r[axis] / l
                if i is not None:
                    force[i][axis] -= pull
                if j is not None:
                    force[j][axis] += pull
            stretching = dot(r, self.arm(velocity, i, j)) / l
            rest = flows[k] - derivative(lambda x: model.entropy(x, g, t), l) * stretching
            if model.has_dashpot:
                on_dashpot = -derivative(lambda x: model.psi(l, x, t), g)
                creep.append(on_dashpot / model.viscosity(t))
                rest += on_dashpot * creep[k] / t
                rest -= derivative(lambda x: model.entropy(l, x, t), g) * creep[k]
            else:
                creep.append(mp.mpf(0))
            heating.append(rest / derivative(lambda x: model.entropy(l, g, x), t))
        vectors = [x for row in velocity + force for x in row]
        return vectors + heating + creep + [self.to_surroundings(theta)]


def derivative(f, x):
    """f′(x) to about 25 digits."""
    d = mp.mpf(10) ** -13 * (1 + abs(x))
    return (f(x + d) - f(x - d)) / (2 * d)


def extrapolated(rate, z, h, columns=10):
    """A step of Gragg's modified midpoint rule with 2, 4, 6, … parts, extrapolated to none:
    Hairer, Nørsett & Wanner (1993), II.9. Of order 2·columns."""
    first, previous = rate(z), []
    for row in range(columns):
        parts = 2 * (row + 1)
        d = h / parts
        old, new = z, [a + d * b for a, b in zip(z, first)]
        for _ in range(parts - 1):
            old, new = new, [a + 2 * d * b for a, b in zip(old, rate(new))]
        smooth = [(a + b + d * c) / 2 for a, b, c in zip(old, new, rate(new))]
        table = [smooth]
        for column, earlier in enumerate(previous):
            factor = (mp.mpf(parts) / (2 * (row - column))) ** 2 - 1
            table.append([a + (a - b) / factor for a, b in zip(table[column], earlier)])
        previous = table
    return previous[-1]


def solution(system, z, times, longest):
    """The states at some times, in steps of at most `longest` seconds."""
    now, z = mp.mpf(0), z + [mp.mpf(0)]
    for time in times:
        count = int(mp.ceil((time - now) / longest))
        for _ in range(count):
            z = extrapolated(system.rate, z, (time - now) / count)
        now = time
        yield z


def double(springs, conductance, masses, state):
    models = [Logarithmic(*spring, length, 300) for spring, length in zip(springs, (2, 1))]
    system = System(3, masses, [(models[0], 0, None), (models[1], 1, 0)],
                    contacts=[(0, 1, conductance)])
    return system, numbers(*state)


def single_pendulum():
    system = System(2, [1], [(ThermoViscoElastic(), 0, None)], surroundings=[(0, 10, 300)])
    return system, numbers(3, 0, 0, 1, 380, 0)


# Stiffness, softening, coupling and capacity of both springs; q, p, θ and γ at the start.
CASES = {
    'single_pendulum': single_pendulum,
    'double_pendulum_romero': lambda: double(
        [('0.1', 0, '0.2', 5), (1, 0, '0.2', 5)], 300, [1, 2],
        [1, 0, 0, '2.2', 0, 0, 0, 2, 0, 1, 0, 0, 380, 310, 0, 0]),
    'double_pendulum_kruger': lambda: double(
        [(100, 0, '0.2', 1000), (100, 0, '0.2', 1000)], 10, [1, 2],
        [1, 0, 0, '2.2', 0, 0, 0, 1, 0, 0, '4.4', 0, 380, 310, 0, 0]),
    'double_pendulum_log': lambda: double(
        [(5000, 50, 20, 5000), (10000, 60, 20, 2000)], 300, [10, 20],
        [3, 0, '0.5', 3, 1, 1, 0, 10, 0, 0, 0, -20, 380, 298, 0, 0]),
}
# Steps of the continuous equations, s: small for stiff springs and for strong conduction.
LONGEST = {
    'single_pendulum': '0.04',
    'double_pendulum_romero': '0.02',
    'double_pendulum_kruger': '0.04',
    'double_pendulum_log': '0.02',
}
SINGLE = ['q1_x', 'q1_y', 'p1_x', 'p1_y', 'theta_1', 'gamma_1']
DOUBLE = [f'{v}{i}_{axis}' for v in 'qp' for i in (1, 2) for axis in 'xyz'] + ['theta_1', 'theta_2']


def write(*cells):
    print(*(mp.nstr(x, 20) if isinstance(x, mp.mpf) else x for x in cells), sep=',', flush=True)


def discrete_table(case, scheme, h, count):
    system, z = CASES[case]()
    columns = SINGLE if case == 'single_pendulum' else DOUBLE
    has_surroundings = bool(system.surroundings)
    received, start = mp.mpf(0), system.energy(z)

    def row(index):
        write(index, *z[:len(columns)], *[received] * has_surroundings)

    write('step', *columns, *['reservoir_entropy'] * has_surroundings)
    row(0)
    for index in range(count):
        z, entropy = system.step(scheme, z, h)
        received += entropy
        row(index + 1)
    end = system.energy(z) + sum(t for *_, t in system.surroundings) * received
    print('energy defect', mp.nstr((end - start) / start, 5), file=sys.stderr)


def exact_table(case, times):
    system, z = CASES[case]()
    if case == 'single_pendulum':
        # γ comes before θ in this table.
        columns, order = SINGLE[:4] + ['gamma_1', 'theta_1', 'reservoir_entropy'], [0, 1, 2, 3, 5, 4, 6]
    else:
        columns, order = DOUBLE, range(len(DOUBLE))
    write('time', *columns, 'error_estimate')
    # Steps with a local error of at most 1e-12, and half of that with one below 1e-16.
    longest = mp.mpf(LONGEST[case])
    runs = [solution(system, z, times, h) for h in (longest, longest / 2)]
    for time, coarse, fine in zip(times, *runs):
        error = max(abs(coarse[i] - fine[i]) for i in order)
        write(mp.nstr(time, 20, strip_zeros=True).removesuffix('.0'), *(fine[i] for i in order), mp.nstr(error, 2))


def main(arguments):
    match arguments:
        case [case, 'exact', *times] if case in CASES and times:
            exact_table(case, numbers(*times))
        case [case, 'eem-entropy' | 'eem-temperature' as scheme, step, count] if case in CASES:
            discrete_table(case, scheme, mp.mpf(step), int(count))
        case _:
            sys.exit(__doc__)


if __name__ == '__main__':
    main(sys.argv[1:])
