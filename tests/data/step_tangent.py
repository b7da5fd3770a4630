"""Residual and tangent of one step of the single pendulum in entropy form, to 20 digits.

    python3 step_tangent.py > step_tangent.csv        (needs mpmath)

R(d) = (2m/h) d - 2 p0 + h F(q0, q0 + d) with the internal variables eliminated, and dR/dd by central
differences with 60 digits. All discrete derivatives are plain difference quotients of energies, so
that nothing here is shared with an implementation in floating point.
"""
import mpmath as mp

mp.mp.dps = 60
m = mp.mpf
K0, K1, RATIO, COUPLING, CAPACITY, MU0, MU1, ETA0, A, REF, KAPPA, MASS = (
    m(100), m('0.5'), m('0.1'), m(4), m(1), m(5), m('0.1'), m(100), m(10), m(300), m(10), m(1))
Q0, P0, GAMMA0, THETA0 = [m('1.2'), m('0.7')], [m('0.3'), m('-1.1')], m('0.02'), m(330)


def psi(l, g, t):
    L, k = mp.log(l), K0 - K1 * (t - REF)
    elastic = k / 2 * L**2 - COUPLING * (t - REF) * L + CAPACITY * (t - REF - t * mp.log(t / REF))
    return (1 + RATIO) * elastic + (MU0 - MU1 * (t - REF)) * g**2 - RATIO * g * (k * L - COUPLING * (t - REF)) / l


def entropy(l, g, t):
    L = mp.log(l)
    return ((1 + RATIO) * (K1 / 2 * L**2 + COUPLING * L + CAPACITY * mp.log(t / REF))
            + MU1 * g**2 - RATIO * g * (K1 * L + COUPLING) / l)


def temperature(l, g, s):  # linear in ln(t), so two points give it
    return REF * mp.exp((s - entropy(l, g, REF)) / ((1 + RATIO) * CAPACITY))


def energy(l, g, s):
    t = temperature(l, g, s)
    return psi(l, g, t) + t * s


def quotient(f, a, b):
    if abs(b - a) < m(10)**-30:  # equal: a central difference
        d = m(10)**-18
        return (f(a + d) - f(a - d)) / (2 * d)
    return (f(b) - f(a)) / (b - a)


def viscosity(t):
    return ETA0 * mp.exp(A * (1 / t - 1 / REF))


def solve(f, x):  # Newton with differences
    for _ in range(60):
        r, n = f(x), len(x)
        J = mp.zeros(n, n)
        for j in range(n):
            d = m(10)**-25 * (1 + abs(x[j]))
            y = list(x); y[j] += d
            ry = f(y)
            for i in range(n):
                J[i, j] = (ry[i] - r[i]) / d
        dx = mp.lu_solve(J, -mp.matrix(r))
        x = [a + b for a, b in zip(x, dx)]
        if max(abs(b) / (1 + abs(a)) for a, b in zip(x, dx)) < m(10)**-48:
            return x
    raise RuntimeError('no convergence')


def residual(d, h):
    q1 = [a + b for a, b in zip(Q0, d)]
    l0, l1 = mp.hypot(*Q0), mp.hypot(*q1)
    s0 = entropy(l0, GAMMA0, THETA0)

    def discrete(g1, s1):
        f = (quotient(lambda x: energy(x, g1, s1), l0, l1) + quotient(lambda x: energy(x, GAMMA0, s0), l0, l1)) / 2
        g = -(quotient(lambda x: energy(l0, x, s1), GAMMA0, g1) + quotient(lambda x: energy(l1, x, s0), GAMMA0, g1)) / 2
        t = (quotient(lambda x: energy(l0, GAMMA0, x), s0, s1) + quotient(lambda x: energy(l1, g1, x), s0, s1)) / 2
        return f, g, t

    def balance(u):
        f, g, t = discrete(*u)
        eta = viscosity(t)
        return [u[0] - GAMMA0 - h * g / eta, u[1] - s0 - h / t * (g * g / eta + KAPPA * (REF - t))]

    f, _, _ = discrete(*solve(balance, [GAMMA0, s0]))
    return [2 * MASS / h * d[i] - 2 * P0[i] + h * f * (2 * Q0[i] + d[i]) / (l0 + l1) for i in range(2)]


print('step,d_x,d_y,R_x,R_y,K_xx,K_xy,K_yx,K_yy')
for h in (m('0.2'), m('0.001')):
    for increment in ('0', '1e-14', '1e-9', '1e-5', '1e-2', '1e-1'):
        # Exactly the doubles that a test reads.
        d = [m(float(increment) * 0.75), m(float(increment) * -0.5)]
        h = m(float(h))
        R = residual(d, h)
        e = m(10)**-14
        columns = []
        for j in range(2):
            up, down = list(d), list(d)
            up[j] += e; down[j] -= e
            columns.append([(a - b) / (2 * e) for a, b in zip(residual(up, h), residual(down, h))])
        K = [columns[j][i] for i in range(2) for j in range(2)]
        print(mp.nstr(h, 20), *(repr(float(x)) for x in d), *(mp.nstr(x, 20) for x in R + K), sep=',', flush=True)
