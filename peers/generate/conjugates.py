"""Writes src/prototype/temperature/conjugates.rs; needs sympy, and cargo fmt afterwards.

What a careful user of a computer algebra system does by hand: the discrete derivatives of the logarithmic spring, as
plain difference quotients of the free energy, their derivatives with respect to the state at the end of the step, and
common subexpressions taken out.
"""

import sympy as sp
from sympy.printing.c import C99CodePrinter
from sympy.printing.precedence import PRECEDENCE

lambda_, theta = sp.symbols("lambda theta", positive=True)
lambda_0, theta_0, lambda_1, theta_1 = sp.symbols("lambda_0 theta_0 lambda_1 theta_1", positive=True)
stiffness, softening, coupling, capacity, length, theta_ref = data = sp.symbols(
    "stiffness softening coupling capacity natural_length theta_ref", positive=True
)

strain = sp.log(lambda_ / length)
modulus = stiffness - softening * theta_ref * sp.log(theta / theta_ref)
free_energy = (
    modulus * strain**2 / 2
    - coupling * (theta - theta_ref) * strain
    + capacity * (theta - theta_ref - theta * sp.log(theta / theta_ref))
)
entropy = -sp.diff(free_energy, theta)
energy = free_energy + theta * entropy


def at(function, length, temperature):
    return function.subs({lambda_: length, theta: temperature}, simultaneous=True)


def by_square(f):
    """The quotient in the squared length, averaged over both temperatures."""
    changes = at(f, lambda_1, theta_1) - at(f, lambda_0, theta_1) + at(f, lambda_1, theta_0) - at(f, lambda_0, theta_0)
    return changes / (2 * (lambda_1**2 - lambda_0**2))


def by_temperature(f):
    """The quotient in the temperature, averaged over both lengths."""
    changes = at(f, lambda_1, theta_1) - at(f, lambda_1, theta_0) + at(f, lambda_0, theta_1) - at(f, lambda_0, theta_0)
    return changes / (2 * (theta_1 - theta_0))


discrete_theta = by_temperature(energy) / by_temperature(entropy)
factor = by_square(energy) - discrete_theta * by_square(entropy)
change = at(entropy, lambda_1, theta_1) - at(entropy, lambda_0, theta_0)
values = [factor, discrete_theta, change]
results = [f for value in values for f in [value, sp.diff(value, lambda_1), sp.diff(value, theta_1)]]


class Printer(C99CodePrinter):
    def _print_Integer(self, number):
        return f"{number}.0"

    def _print_log(self, call):
        return f"{self.parenthesize(call.args[0], PRECEDENCE['Atom'], strict=True)}.ln()"

    def _print_Pow(self, power):
        if power.exp == -1:
            return super()._print_Pow(power)
        return f"{self.parenthesize(power.base, PRECEDENCE['Atom'], strict=True)}.powi({int(power.exp)})"


printer = Printer()
steps, results = sp.cse(results, symbols=sp.numbered_symbols("z"))
print("""//! Written by `generate/conjugates.py`: do not edit.

use super::Conjugates;
use crate::double_pendulum::ThermoelasticSpring;

/// φ, θ* and s₁ − s₀ of a step from (λ₀, θ₀) to (λ₁, θ₁).
#[inline(always)]
#[expect(clippy::too_many_lines, reason = "generated")]
pub(super) fn conjugates(
    spring: &ThermoelasticSpring,
    [lambda_0, theta_0]: [f64; 2],
    [lambda_1, theta_1]: [f64; 2],
) -> Conjugates {
    let &ThermoelasticSpring {""")
for name in data:
    print(f"        {name},")
print("    } = spring;")
for name, value in steps:
    print(f"    let {name} = {printer.doprint(value)};")
print("    Conjugates {")
for name, row in zip(["factor", "theta", "entropy"], zip(*[iter(results)] * 3)):
    print(f"        {name}: [")
    for value in row:
        print(f"            {printer.doprint(value)},")
    print("        ],")
print("    }\n}")
