//! Working memory of the closing of a step.

use crate::algebra::bivector::Bivector;
use crate::element::group::{ComponentEnergy, Place, UnkeptEntropy};
use crate::element::layout::Layout;
use crate::step::explicit::components::Components;
use crate::step::explicit::vector::{add, dot, size};
use eem_material::number::compensated::Total;
use eem_material::number::scalar::{Mask, Real};

/// The progress of the closing of a component.
#[derive(Clone, Copy, Debug)]
pub(super) struct Progress<S: Real> {
    /// Number of corrections so far.
    pub(super) iterations: usize,
    /// Whether heat has been among them.
    pub(super) has_heated: S::Mask,
    /// The defect of the energy, J.
    pub(super) defect: S,
    /// [`defect_of`](super::Explicit::defect_of), while nothing has changed since.
    pub(super) present: Option<[S; 2]>,
    /// The magnitude of the terms of the energy where the closing began; zero before, J.
    pub(super) scale: S,
    /// The first defect over the scale.
    pub(super) correction: S,
    /// Heat that dashpots without temperature have lost in this step, J.
    pub(super) lost: S,
    /// The total entropy production, and the smallest one before the closing, `S::MAX` without any, J/K.
    pub(super) production: Total<S>,
    pub(super) least: S,
    /// The factor by which the closing has changed every production.
    pub(super) factor: S,
    /// Terms whose rounding explains the defect if no correction of the energy was possible, see
    /// [`rounding`](super::closing); zero otherwise, J.
    pub(super) granularity: S,
    /// Whether these are terms that do not vanish with the energy.
    pub(super) is_forgiven: S::Mask,
    /// Whether the energy is within tolerance, and whether a correction needs forces.
    pub(super) is_closed: S::Mask,
    pub(super) needs_forces: S::Mask,
    /// Whether the component was rotated rigidly because no correction was possible.
    pub(super) is_rigid: bool,
}

/// Sums over the masses of a component.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion<S, const D: usize> {
    /// L, kg m/s, and J about the origin of the component, kg m²/s.
    pub(super) linear: [S; D],
    pub(super) angular: Bivector<S, D>,
    /// `Σ |p|` and `Σ |q||p|` by sums of magnitudes, with coordinates q or arms about the origin, whichever are larger:
    /// positions are rounded to ε of their coordinates.
    pub(super) terms: [S; 2],
    /// Kinetic energy and that of weights, and the magnitude of its terms, J.
    pub(super) energy: Total<S>,
    pub(super) magnitude: S,
    pub(super) kinetic: S,
}

/// What an element with a thermostat receives in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct HeldBalance<S> {
    /// Entropy from dashpots and paths, and from the thermostat, J/K.
    pub(super) received: S,
    pub(super) given: S,
    /// Heat from the thermostat, and the part of it that the entropy does not tell, J.
    pub(super) heat: S,
    pub(super) by_course: S,
}

impl<S: Real> HeldBalance<S> {
    pub(super) fn none() -> Self {
        let [received, given, heat, by_course] = [S::zero(); 4];
        Self {
            received,
            given,
            heat,
            by_course,
        }
    }
}

/// Sums of rows of matrices, which bound the fastest motion.
#[derive(Clone, Debug)]
pub(super) struct RowSums<S> {
    /// `ω²` per node of the scene, 1/s².
    pub(super) squares: Vec<S>,
    /// c per thermal slot, J/K, and its share of conduction, 1/s.
    pub(super) capacities: Vec<S>,
    pub(super) flows: Vec<S>,
}

/// Working memory of the closing of a step.
#[derive(Clone, Debug)]
pub(super) struct Scratch<S: Real, const D: usize> {
    /// Per component.
    pub(super) progress: Vec<Progress<S>>,
    pub(super) motions: Vec<Motion<S, D>>,
    pub(super) energies: Vec<ComponentEnergy<S>>,
    /// Whether a component has to be evaluated, and whether its forces are needed.
    pub(super) open: Vec<bool>,
    pub(super) needs_forces: Vec<bool>,
    /// Lanes that have not changed and are inactive while the others are evaluated.
    pub(super) inactive: Vec<S::Mask>,
    /// c and `|∂c/∂ ln θ|` per thermal slot, and what it has produced itself in this step, J/K.
    pub(super) capacities: Vec<[S; 2]>,
    pub(super) produced: Vec<S>,
    /// An element whose stored entropy does not match its temperature after the closing, if there is one.
    pub(super) unkept: Option<UnkeptEntropy>,
    /// Per thermal slot.
    pub(super) held: Vec<HeldBalance<S>>,
    /// The forces of the elements on places, `γ̇` and `g γ̇`, where they are needed, N, m/s and W.
    pub(super) forces: Vec<[S; D]>,
    pub(super) creep: Vec<[S; 2]>,
    /// The production Π of each path of heat, J/K.
    pub(super) paths: Vec<S>,
    /// The smallest production of paths of heat between thermostats and reservoirs; `S::MAX` without any, J/K.
    pub(super) least: S,
    pub(super) stability: RowSums<S>,
    /// The sum of the stiffnesses of elements at each node of the scene, N/m, and whether it is known in this step.
    pub(super) stiffnesses: Vec<S>,
    pub(super) has_stiffnesses: bool,
}

impl<S: Real> Progress<S> {
    pub(super) fn none() -> Self {
        Self {
            iterations: 0,
            has_heated: S::Mask::none(),
            defect: S::zero(),
            present: None,
            scale: S::zero(),
            correction: S::zero(),
            lost: S::zero(),
            production: Total::default(),
            least: S::MAX,
            factor: S::one(),
            granularity: S::zero(),
            is_forgiven: S::Mask::none(),
            is_closed: S::Mask::none(),
            needs_forces: S::Mask::none(),
            is_rigid: false,
        }
    }
}

impl<S: Real, const D: usize> Motion<S, D> {
    /// Of no masses.
    pub(super) fn none() -> Self {
        Self {
            linear: [S::zero(); D],
            angular: Bivector::zero(),
            terms: [S::zero(); 2],
            energy: Total::default(),
            magnitude: S::zero(),
            kinetic: S::zero(),
        }
    }

    /// Adds the momenta of a mass at the end of an arm.
    #[inline]
    pub(super) fn add_momenta(&mut self, place: &Place<S, D>, arm: &[S; D]) {
        let p = place.p();
        add(&mut self.linear, S::one(), p);
        self.angular.add(S::one(), &Bivector::wedge(arm, p));
        let momentum = size(p);
        self.terms[0] += momentum;
        self.terms[1] += size(arm).maximum(size(place.q())) * momentum;
    }

    /// Adds momenta and energy of a mass at the end of an arm.
    #[inline]
    pub(super) fn add(&mut self, place: &Place<S, D>, arm: &[S; D], gravity: Option<&[S; D]>) {
        self.add_momenta(place, arm);
        let (q, p) = (place.q(), place.p());
        let kinetic = S::from_f64(0.5) * dot(p, p) * place.per_mass;
        self.energy.add(kinetic);
        self.kinetic += kinetic;
        self.magnitude += kinetic;
        for (&g, &q) in gravity.into_iter().flatten().zip(q) {
            let potential = -place.mass * g * q;
            self.energy.add(potential);
            self.magnitude += potential.abs();
        }
    }
}

impl<S: Real, const D: usize> Scratch<S, D> {
    /// A workspace for a scene with this many nodes.
    pub(super) fn new(components: &Components<S>, layout: &Layout, nodes: usize) -> Self {
        let (count, thermal) = (components.all.len(), layout.thermal);
        Self {
            progress: vec![Progress::none(); count],
            motions: vec![Motion::none(); count],
            energies: vec![ComponentEnergy::none(); count],
            open: vec![false; count],
            needs_forces: vec![false; count],
            inactive: vec![S::Mask::none(); count],
            capacities: vec![[S::zero(); 2]; thermal],
            produced: vec![S::zero(); thermal],
            unkept: None,
            held: vec![HeldBalance::none(); thermal],
            forces: vec![[S::zero(); D]; components.nodes.len()],
            creep: vec![[S::zero(); 2]; layout.viscous],
            paths: vec![S::zero(); components.paths.len()],
            least: S::MAX,
            stability: RowSums {
                squares: vec![S::zero(); nodes],
                capacities: vec![S::zero(); thermal],
                flows: vec![S::zero(); thermal],
            },
            stiffnesses: vec![S::zero(); nodes],
            has_stiffnesses: false,
        }
    }

    /// Clears the workspace for the closing of a step.
    pub(super) fn clear(&mut self) {
        self.progress.fill(Progress::none());
        self.inactive.fill(S::Mask::none());
        self.produced.fill(S::zero());
        self.held.fill(HeldBalance::none());
        self.unkept = None;
        self.has_stiffnesses = false;
        self.least = S::MAX;
    }
}
