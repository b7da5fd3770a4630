//! The families of free energies of the random campaign, each with data over wide but physical ranges.

use std::sync::Arc;

use super::material::{
    Data, Law, hencky, hooke, logarithmic, maxwell, morse, published, thermoelastic, two_dashpots,
};
use super::models::VanDerWaals;
use super::models::wide::{
    Arrhenius, Branch, Debye, Decimal, Fene, Gent, Glass, LennardJones, Powers, Schottky,
    Stiffening, Transition, Voigt, WarmVoigt,
};
use super::random::Random;

/// What a spring has at the start: λ and θ.
pub(crate) type Start = [f64; 2];

/// A family of free energies.
#[derive(Clone, Copy)]
pub(crate) struct Family<const D: usize> {
    pub(crate) name: &'static str,
    /// Whether its force ends in a singularity, and may start close to it.
    pub(crate) is_singular: bool,
    pub(crate) make: fn(&mut Random, &Data, Start) -> Arc<dyn Law<D>>,
}

const fn regular<const D: usize>(
    name: &'static str,
    make: fn(&mut Random, &Data, Start) -> Arc<dyn Law<D>>,
) -> Family<D> {
    Family {
        name,
        is_singular: false,
        make,
    }
}

const fn singular<const D: usize>(
    name: &'static str,
    make: fn(&mut Random, &Data, Start) -> Arc<dyn Law<D>>,
) -> Family<D> {
    Family {
        name,
        is_singular: true,
        make,
    }
}

/// Those that are tried in every dimension: what momenta are kept by does not ask for the free energy, and every
/// pair of a model and a dimension has to be compiled.
pub(crate) const fn everywhere<const D: usize>() -> [Family<D>; 6] {
    [
        regular("Hooke", |_, data, _| hooke(data)),
        singular("Hencky", |_, data, _| hencky(data)),
        regular("Morse", |_, data, _| morse(data)),
        regular("Maxwell", |_, data, _| maxwell(data)),
        regular("thermoelastic", |_, data, _| thermoelastic(data)),
        regular("Arrhenius", |random, data, _| arrhenius(random, data)),
    ]
}

/// What is driven or held besides [`everywhere`]: a branch that relaxes to nothing, and dashpots in parallel with springs.
pub(crate) const fn driven<const D: usize>() -> [Family<D>; 3] {
    [
        regular("branch", |_, data, _| branch(data)),
        regular("Voigt", |_, data, _| voigt(data)),
        regular("warm Voigt", |_, data, _| warm_voigt(data)),
    ]
}

/// All of them, in space.
pub(crate) const IN_SPACE: [Family<3>; 20] = {
    let [hooke, hencky, morse, maxwell, thermoelastic, arrhenius] = everywhere();
    [
        hooke,
        hencky,
        morse,
        maxwell,
        thermoelastic,
        arrhenius,
        singular("logarithmic", |_, data, _| logarithmic(data)),
        singular("published", |_, data, _| published(data)),
        singular("two dashpots", |_, data, _| two_dashpots(data)),
        singular("log10", |_, data, _| decimal(data)),
        regular("sinh", |random, data, _| stiffening(random, data)),
        singular("van der Waals", van_der_waals),
        singular("Gent", gent),
        singular("FENE", fene),
        singular("Lennard-Jones", lennard_jones),
        singular("powers", |random, data, _| powers(random, data)),
        regular("Debye", debye),
        regular("Schottky", schottky),
        regular("tanh transition", transition),
        regular("glass transition", glass),
    ]
};

fn decimal(data: &Data) -> Arc<dyn Law<3>> {
    let per_decade = core::f64::consts::LN_10;
    Arc::new(Decimal {
        stiffness: data.modulus * per_decade.powi(2),
        coupling: data.coupling * data.length * per_decade,
        capacity: data.capacity * per_decade,
        length: data.length,
        theta_ref: data.theta_ref,
    })
}

fn stiffening(random: &mut Random, data: &Data) -> Arc<dyn Law<3>> {
    Arc::new(Stiffening {
        stiffness: data.stiffness,
        steepness: random.decades(0.1, 30.0) / data.length,
        length: data.length,
    })
}

/// From a thousandth of the free volume on.
fn van_der_waals(random: &mut Random, data: &Data, [lambda, theta]: Start) -> Arc<dyn Law<3>> {
    let covolume = lambda * (1.0 - random.decades(1e-3, 0.9));
    let gas = data.modulus / theta;
    Arc::new(VanDerWaals {
        gas,
        covolume,
        // Critical at 8 a/27 b R: between half and twice the temperature.
        cohesion: 27.0 / 8.0 * gas * covolume * theta * random.decades(0.5, 2.0),
        capacity: data.capacity,
        theta_ref: data.theta_ref,
    })
}

/// To a millionth of its limit, pulled or pressed.
fn gent(random: &mut Random, data: &Data, [lambda, _]: Start) -> Arc<dyn Law<3>> {
    let extension = lambda * random.uniform(-0.5, 0.5);
    Arc::new(Gent {
        stiffness: data.stiffness,
        limit: extension.abs() / (1.0 - random.decades(1e-6, 0.9)),
        length: lambda - extension,
    })
}

/// To a hundred thousandth of its limit.
fn fene(random: &mut Random, data: &Data, [lambda, _]: Start) -> Arc<dyn Law<3>> {
    Arc::new(Fene {
        stiffness: data.stiffness,
        limit: lambda / (1.0 - random.decades(1e-5, 0.9)),
    })
}

fn lennard_jones(random: &mut Random, data: &Data, [lambda, _]: Start) -> Arc<dyn Law<3>> {
    Arc::new(LennardJones {
        depth: data.modulus / 57.0,
        size: lambda / random.uniform(0.9, 2.0),
    })
}

fn powers(random: &mut Random, data: &Data) -> Arc<dyn Law<3>> {
    let [m, n] = [random.uniform(1.0, 8.0), random.uniform(1.0, 12.0)];
    let attraction = data.modulus / (m * (m + n));
    Arc::new(Powers {
        attraction,
        repulsion: attraction * m / n,
        m,
        n,
        length: data.length,
    })
}

fn debye(random: &mut Random, data: &Data, [_, theta]: Start) -> Arc<dyn Law<3>> {
    let ratio = random.decades(0.1, 30.0);
    let grown = 1.0 + ratio.powi(-3);
    // Where little heat is stored, little is exchanged: otherwise a stretch would multiply the temperature.
    let share = (1.0 - grown.recip()) * (1.0 + 3.0 / grown);
    Arc::new(Debye {
        stiffness: data.stiffness,
        coupling: data.coupling * share.min(1.0),
        capacity: data.capacity,
        length: data.length,
        scale: theta * ratio,
    })
}

fn schottky(random: &mut Random, data: &Data, [_, theta]: Start) -> Arc<dyn Law<3>> {
    let mut part = || data.capacity * random.decades(1e-2, 10.0);
    let [low_capacity, high_capacity] = [part(), part()];
    // Of the capacity that is left when all levels are frozen, and of the heat that stretching then exchanges.
    let share = random.decades(1e-3, 1.0);
    Arc::new(Schottky {
        stiffness: data.stiffness,
        coupling: data.coupling * share,
        low: theta * random.decades(1e-2, 1.0),
        low_capacity,
        high: theta * random.decades(1.0, 30.0),
        high_capacity,
        capacity: data.capacity * share,
        length: data.length,
    })
}

/// Over a ten thousandth to a tenth of the temperature.
fn transition(random: &mut Random, data: &Data, [_, theta]: Start) -> Arc<dyn Law<3>> {
    let width = theta * random.decades(1e-4, 0.1);
    let drop = data.stiffness * random.uniform(0.0, 0.9);
    // c − ½ drop e² θ/w² max|tanh″| is positive up to e = 0.7 l.
    let least = 0.2 * drop * data.length.powi(2) * theta / width.powi(2);
    Arc::new(Transition {
        stiffness: data.stiffness,
        drop,
        centre: theta * random.uniform(0.95, 1.05),
        width,
        capacity: data.capacity + least,
        length: data.length,
    })
}

/// Activation temperatures to 5e4 K, by which a percent of temperature changes η to its third.
fn arrhenius<const D: usize>(random: &mut Random, data: &Data) -> Arc<dyn Law<D>> {
    Arc::new(Arrhenius {
        stiffness: data.stiffness,
        branch: data.branch,
        coupling: data.coupling,
        capacity: data.capacity,
        length: data.length,
        theta_ref: data.theta_ref,
        eta: data.eta,
        a: (data.theta_ref * random.decades(1.0, 100.0)).min(5e4),
    })
}

fn branch<const D: usize>(data: &Data) -> Arc<dyn Law<D>> {
    Arc::new(Branch {
        stiffness: data.branch,
        length: data.length,
        eta: data.eta,
    })
}

fn voigt<const D: usize>(data: &Data) -> Arc<dyn Law<D>> {
    Arc::new(Voigt {
        stiffness: data.stiffness,
        length: data.length,
        eta: data.eta,
    })
}

fn warm_voigt<const D: usize>(data: &Data) -> Arc<dyn Law<D>> {
    Arc::new(WarmVoigt {
        stiffness: data.stiffness,
        coupling: data.coupling,
        capacity: data.capacity,
        length: data.length,
        theta_ref: data.theta_ref,
        eta: data.eta,
        a: 3.0 * data.theta_ref,
    })
}

/// 30 K below the transition to 60 K above.
fn glass(random: &mut Random, data: &Data, [_, theta]: Start) -> Arc<dyn Law<3>> {
    Arc::new(Glass {
        stiffness: data.stiffness,
        branch: data.branch,
        coupling: data.coupling,
        capacity: data.capacity,
        length: data.length,
        centre: theta - random.uniform(-30.0, 60.0),
        eta: data.eta,
        // The universal constants, 17.44 ln 10 and 51.6 K.
        c1: 40.2,
        c2: 51.6,
    })
}
