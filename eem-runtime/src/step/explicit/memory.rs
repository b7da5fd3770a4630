//! Memory of an explicit scheme: targets and sums that it keeps from step to step, and the workspace of a closing.

use core::ops::Range;

use crate::algebra::bivector::Bivector;
use crate::algebra::{add, dot, size};
use crate::element::group::{Caloric, ComponentEnergy, UnkeptEntropy};
use crate::element::layout::Layout;
use crate::step::explicit::components::Components;
use eem_material::number::compensated::{Sum, Total};
use eem_material::number::digest::Digest;
use eem_material::number::scalar::Scalar;

/// Work of the loads on a component in a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LoadSums {
    /// J.
    pub(super) work: f64,
    /// `Σ |b| |f·ẋ|` of moved anchors, W, and `Σ |b| Σ_m |ℓ'_m| |f − f⁰||x|`, J: times ε/2, what the rounding of their positions x
    /// does to their work.
    pub(super) effort: f64,
    pub(super) noise: f64,
    /// `Σ |b| Σ |r||F|` in space, N m: times ε, the rounding of the torque.
    pub(super) moment: f64,
}

/// The target of the energy of a component, to twice the precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Target {
    /// E, with the heat that reservoirs have received and that dashpots have lost, J.
    pub(super) energy: Sum,
    /// Heat of dashpots in elements without temperature, J.
    pub(super) lost: Sum,
}

/// Values accumulated over the steps.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Books {
    /// Per component.
    pub(super) targets: Vec<Target>,
    /// The targets of the momenta of each component, to twice the precision: L, kg m/s, then, plane by plane, J about the anchor, or
    /// about the centre of mass where there is none, kg m²/s.
    pub(super) momenta: Vec<Sum>,
    /// The entropy that each reservoir has received from each component, J/K.
    pub(super) shares: Vec<Sum>,
    /// The largest |p|₂ of all states so far, kg m/s.
    pub(super) largest_momentum: f64,
    /// E less its targets, of all components, J.
    pub(super) residue: f64,
    /// The contribution of this state to the bound of a step, and the terms of its energies, J; `None` unless a step
    /// has led to it.
    pub(super) terms: Option<[f64; 2]>,
}

impl Target {
    /// Zero.
    pub(super) fn none() -> Self {
        let [energy, lost] = [Sum::new(0.0); 2];
        Self { energy, lost }
    }
}

impl Books {
    pub(super) fn new(components: &Components, dimension: usize) -> Self {
        let count = components.all.len();
        Self {
            targets: vec![Target::none(); count],
            momenta: vec![Sum::new(0.0); momenta_of(count, dimension).start],
            shares: vec![Sum::new(0.0); components.shares.len()],
            largest_momentum: 0.0,
            residue: 0.0,
            terms: None,
        }
    }

    /// Sets all sums to zero.
    pub(super) fn clear(&mut self) {
        self.targets.fill(Target::none());
        self.momenta.fill(Sum::new(0.0));
        self.shares.fill(Sum::new(0.0));
        (self.largest_momentum, self.residue) = (0.0, 0.0);
        self.terms = None;
    }

    /// Copies the values of `other`, of the same scene; targets only where steps change them.
    #[inline]
    pub(super) fn copy_from(&mut self, other: &Self, change_targets: bool) {
        if change_targets {
            self.targets.copy_from_slice(&other.targets);
            self.momenta.copy_from_slice(&other.momenta);
        }
        self.shares.copy_from_slice(&other.shares);
        self.largest_momentum = other.largest_momentum;
        self.residue = other.residue;
        self.terms = other.terms;
    }
}

/// The indices of the targets of the momenta of a component.
#[inline]
pub(super) const fn momenta_of(index: usize, dimension: usize) -> Range<usize> {
    let count = dimension * (dimension + 1) / 2;
    index * count..index * count + count
}

/// Targets, the entropies that reservoirs have received from each component, and the rates of the present state, bit for
/// bit.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct SavedExplicit {
    /// Whether the next step takes rates and targets from the state instead of what follows.
    pub(crate) is_new: bool,
    /// The digest of the state that it belongs to.
    pub(crate) state: Digest,
    pub(crate) is_motion_first: bool,
    /// All sums of the targets of each component.
    pub(crate) targets: Vec<Sum>,
    pub(crate) shares: Vec<Sum>,
    pub(crate) largest_momentum: f64,
    pub(crate) residue: f64,
    /// The rates of the stage vector, of dashpots and of thermostats.
    pub(crate) rates: Vec<f64>,
    /// The loads with weights, then without them.
    pub(crate) loads: Vec<f64>,
}

impl SavedExplicit {
    /// Sets all numbers to zero.
    pub(super) fn clear(&mut self) {
        self.targets.fill(Sum::new(0.0));
        self.shares.fill(Sum::new(0.0));
        (self.largest_momentum, self.residue) = (0.0, 0.0);
        self.rates.fill(0.0);
        self.loads.fill(0.0);
    }

    /// All sums with their names.
    pub(crate) fn sums(&self) -> [(&'static str, &[Sum]); 2] {
        [
            ("targets", &self.targets),
            ("shares of reservoirs", &self.shares),
        ]
    }

    /// All lists with their names.
    pub(crate) fn lists(&self) -> [(&'static str, &[f64]); 2] {
        [("rates", &self.rates), ("loads", &self.loads)]
    }
}

/// The progress of the closing of a component.
#[derive(Clone, Copy, Debug, Default)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a question of its own about the closing"
)]
pub(super) struct Progress {
    /// Number of corrections so far.
    pub(super) iterations: usize,
    /// Whether heat has been among them.
    pub(super) has_heated: bool,
    /// The defect of the energy, J.
    pub(super) defect: f64,
    /// [`defect_of`](super::accounts::Accounts::defect_of), while nothing has changed since.
    pub(super) present: Option<[f64; 2]>,
    /// The magnitude of the terms of the energy where the closing began, with what was carried; zero before, J.
    pub(super) scale: f64,
    /// The first defect over the scale.
    pub(super) correction: f64,
    /// The sum of the magnitudes of the relative changes of the motion that is not rigid.
    pub(super) moved: f64,
    /// The largest relative change of a temperature by one correction.
    pub(super) warmed: f64,
    /// Whether positions and viscous stretches have been changed.
    pub(super) has_shifted: bool,
    /// Heat that dashpots without temperature have lost in this step, J.
    pub(super) lost: f64,
    /// What moved anchors of a component without masses have taken and given in this step, J.
    pub(super) carried: f64,
    /// The total entropy production, and the smallest one before the closing, `f64::MAX` without any, J/K.
    pub(super) production: Total,
    pub(super) least: f64,
    /// The factor by which the closing has changed every production.
    pub(super) factor: f64,
    /// Terms whose rounding explains the defect if no correction of the energy was possible, see
    /// [`rounding`](super::closing); zero otherwise, J.
    pub(super) granularity: f64,
    /// Terms of the energy, in addition to `scale`, whose rounding explains the defect if step control would feel its correction; zero
    /// otherwise, J.
    pub(super) values: f64,
    /// The part of the defect that earlier steps have left, where the rest alone is rounding; zero otherwise, J.
    pub(super) debt: f64,
    /// The terms of the torque of loads, times the step, kg m²/s. Their rounding counts where that of the momenta is smaller.
    pub(super) moment: f64,
    /// Whether the defect is explained only with terms that do not vanish with the energy, or only without the debt.
    pub(super) is_forgiven: bool,
    /// Whether the energy is within tolerance.
    pub(super) is_closed: bool,
    /// Whether the component was rotated rigidly because no correction was possible.
    pub(super) is_rigid: bool,
}

/// The momenta of a component.
#[derive(Clone, Copy, Debug)]
pub(super) struct Momenta<const D: usize> {
    /// L, kg m/s, and J about the origin of the component, kg m²/s.
    pub(super) linear: [f64; D],
    pub(super) angular: Bivector<f64, D>,
}

/// Other sums over the masses of a component.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Motion {
    /// `Σ |p|` and `Σ |q||p|` by sums of magnitudes, with coordinates q or arms about the origin, whichever are larger:
    /// positions are rounded to ε of their coordinates.
    pub(super) terms: [f64; 2],
    /// Kinetic energy and that of constant forces, `−F·q`, and the magnitude of its terms, J.
    pub(super) value: Total,
    pub(super) magnitude: f64,
    pub(super) kinetic: f64,
}

/// What an element with a thermostat receives in a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct HeldBalance {
    /// Entropy from dashpots and paths, and from the thermostat, J/K.
    pub(super) received: f64,
    pub(super) given: f64,
    /// Heat from the thermostat, and the part of it that the entropy does not tell, J.
    pub(super) heat: f64,
    pub(super) by_course: f64,
}

/// Sums of rows of matrices, which bound the fastest motion.
#[derive(Clone, Debug)]
pub(super) struct RowSums {
    /// `ω²` per node of the scene, 1/s².
    pub(super) squares: Vec<f64>,
    /// c per thermal slot, J/K, and its share of conduction, 1/s.
    pub(super) capacities: Vec<f64>,
    pub(super) flows: Vec<f64>,
}

/// Working memory of the closing of a step.
#[derive(Clone, Debug)]
pub(super) struct Scratch {
    /// Per component.
    pub(super) progress: Vec<Progress>,
    /// The terms, in J, of which ε is the rounding of a product that is no normal number: of two momenta, or of a power, over the step.
    pub(super) subnormal: f64,
    pub(super) energies: Vec<ComponentEnergy>,
    /// Whether a component has to be evaluated, and whether its forces are needed.
    pub(super) open: Vec<bool>,
    pub(super) needs_forces: Vec<bool>,
    /// The forces of the elements on places, where they are needed, a vector each, N.
    pub(super) forces: Vec<f64>,
    /// Per thermal slot.
    pub(super) slots: Vec<Caloric>,
    /// An element whose stored entropy does not match its temperature after the closing, if there is one.
    pub(super) unkept: Option<UnkeptEntropy>,
    /// Per thermal slot.
    pub(super) held: Vec<HeldBalance>,
    /// `γ̇` and `g γ̇` of dashpots where they are needed, m/s and W.
    pub(super) creep: Vec<[f64; 2]>,
    /// The smallest production of paths of heat between thermostats and reservoirs; `f64::MAX` without any, J/K.
    pub(super) least: f64,
    pub(super) stability: RowSums,
    /// The sum of the stiffnesses of elements at each node of the scene, N/m, and whether it is known in this step.
    pub(super) stiffnesses: Vec<f64>,
    /// The terms of the force of each dashpot, N.
    pub(super) pulls: Vec<f64>,
    pub(super) has_stiffnesses: bool,
}

impl Progress {
    pub(super) fn none() -> Self {
        Self {
            least: f64::MAX,
            factor: 1.0,
            ..Self::default()
        }
    }
}

impl<const D: usize> Momenta<D> {
    /// Of no masses.
    pub(super) fn none() -> Self {
        Self {
            linear: [0.0; D],
            angular: Bivector::zero(),
        }
    }

    /// Replaces each component by a function of its index and of its value: those of L, then, plane by plane, those of J.
    #[inline]
    pub(super) fn change(&mut self, mut of: impl FnMut(usize, f64) -> f64) {
        for axis in 0..D {
            self.linear[axis] = of(axis, self.linear[axis]);
        }
        let mut index = D;
        for i in 0..D {
            for j in i + 1..D {
                let own = self.angular.at_mut([i, j]);
                *own = of(index, *own);
                index += 1;
            }
        }
    }

    /// Calls a function with the index and the value of each component.
    pub(super) fn each(mut self, visit: &mut dyn FnMut(usize, f64)) {
        self.change(|at, own| {
            visit(at, own);
            own
        });
    }

    /// Adds a momentum at the end of an arm.
    #[inline]
    pub(super) fn add(&mut self, p: &[f64; D], arm: &[f64; D]) {
        add(&mut self.linear, 1.0, p);
        self.angular.add(1.0, &Bivector::wedge(arm, p));
    }
}

impl Motion {
    /// Adds the terms of the momenta of a mass at the end of an arm.
    #[inline]
    pub(super) fn add_terms(&mut self, [q, p]: [&[f64]; 2], arm: &[f64]) {
        // Below the smallest normal number, rounding is that of this number.
        let momentum = size(p) + f64::MIN_POSITIVE;
        self.terms[0] += momentum;
        self.terms[1] += farther(arm, q) * momentum;
    }

    /// Adds the energy of a mass under a constant force.
    #[inline]
    pub(super) fn add_energy(&mut self, [q, p]: [&[f64]; 2], force: &[f64], per_mass: f64) {
        let kinetic = 0.5 * dot(p, p) * per_mass;
        self.value.add(kinetic);
        self.kinetic += kinetic;
        self.magnitude += kinetic;
        for (&force, &q) in force.iter().zip(q) {
            if force != 0.0 {
                let potential = -force * q;
                self.value.add(potential);
                self.magnitude += potential.abs();
            }
        }
    }
}

impl Scratch {
    /// A workspace for a scene with this many nodes.
    pub(super) fn new(
        components: &Components,
        layout: &Layout,
        [nodes, dimension]: [usize; 2],
    ) -> Self {
        let (count, thermal) = (components.all.len(), layout.thermal);
        Self {
            progress: vec![Progress::none(); count],
            subnormal: f64::MIN_POSITIVE,
            energies: vec![ComponentEnergy::default(); count],
            open: vec![false; count],
            needs_forces: vec![false; count],
            forces: vec![0.0; components.nodes.len() * dimension],
            slots: vec![Caloric::default(); thermal],
            unkept: None,
            held: vec![HeldBalance::default(); thermal],
            creep: vec![[0.0; 2]; layout.viscous],
            least: f64::MAX,
            stability: RowSums {
                squares: vec![0.0; nodes],
                capacities: vec![0.0; thermal],
                flows: vec![0.0; thermal],
            },
            stiffnesses: vec![0.0; nodes],
            pulls: vec![0.0; layout.viscous],
            has_stiffnesses: false,
        }
    }

    /// Clears the workspace for the closing of a step of the size h, s.
    pub(super) fn clear(&mut self, h: f64) {
        self.subnormal = f64::MIN_POSITIVE * (1.0 + h);
        self.progress.fill(Progress::none());
        self.slots.fill(Caloric::default());
        self.held.fill(HeldBalance::default());
        self.unkept = None;
        self.has_stiffnesses = false;
        self.least = f64::MAX;
    }
}

/// The size of an arm or of the coordinates of its end, whichever is larger: positions are rounded to ε of their coordinates.
#[inline]
pub(super) fn farther(arm: &[f64], position: &[f64]) -> f64 {
    Scalar::maximum(size(arm), size(position))
}
