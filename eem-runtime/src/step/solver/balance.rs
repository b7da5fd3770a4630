//! The momentum balance of a node that moves, with the indices of its unknowns, and those of interface temperatures.

use crate::algebra::{scaled, vector};
use crate::element::group::{Sites, StepView, Trial, points};
use crate::element::masses::Masses;
use crate::element::tableau::UnknownSet;
use crate::step::certificate::Speeds;
use eem_material::number::compact::compact;

/// A moving node in Newton's method, during one step.
///
/// Moving nodes come first among the unknowns of a set, in their order: node `i` of them has the rows `D i`
/// to `D i + D − 1` of the set in the tangent and row `i` of the secant matrix.
#[derive(Clone, Copy, Debug)]
pub(super) struct Balance<const D: usize> {
    pub(super) node: usize,
    /// Its index in the trial, which has all nodes of every set of unknowns.
    pub(super) in_trial: usize,
    /// The set of unknowns to which it belongs.
    pub(super) set: u32,
    /// Its first row in the tangent.
    row: u32,
    /// Its diagonal entries in the tangent.
    pub(super) diagonal: [u32; D],
    /// Its diagonal entry in the secant matrix, if there is one.
    pub(super) secant_diagonal: u32,
    /// m, kg, and 1/m.
    pub(super) mass: f64,
    pub(super) per_mass: f64,
    /// `c (h/m) p⁰`, the displacement of free flight up to the stage, m; zero while nothing moves.
    pub(super) flight: [f64; D],
    /// 2m/h, or m/(ch) for a stage, kg/s.
    inertia: f64,
    /// The reciprocal of the length of its shortest element in the old state, 1/m; 1 without elements.
    pub(super) per_length: f64,
    /// `−h F⁰` with the part F⁰ of the force that depends on the old state and the loads only, N s; zero while nothing
    /// moves.
    pub(super) push: [f64; D],
}

impl<const D: usize> Balance<D> {
    /// Adds those of the nodes with a mass, for a set of unknowns.
    pub(super) fn add_all(masses: &Masses, sites: &Sites<'_, D>, all: &mut Vec<Self>) {
        let [set, _] = sites.sets;
        for (node, first) in sites.layout.nodes.iter().enumerate() {
            let (Some(mass), Some(first)) = (masses.get(node), *first) else {
                continue;
            };
            let own = Some(first / D);
            all.push(Self {
                node,
                in_trial: set * masses.len() + node,
                set: compact(set),
                row: compact(sites.row(Some(first))),
                diagonal: vector(|axis| {
                    let own = Some(first + axis);
                    compact(sites.place(own, own))
                }),
                secant_diagonal: compact(sites.secant_place(own, own)),
                mass,
                per_mass: mass.recip(),
                flight: [0.0; D],
                inertia: 0.0,
                per_length: 1.0,
                push: [0.0; D],
            });
        }
    }

    /// Makes it that of a scene with other masses.
    pub(super) fn set_mass(&mut self, masses: &Masses) {
        self.mass = masses.get(self.node).unwrap_or(self.mass);
        self.per_mass = self.mass.recip();
    }

    /// Its first row in the tangent.
    pub(super) fn row(&self) -> usize {
        self.row as usize
    }

    /// Its rows of a vector of the tangent.
    #[inline]
    pub(super) fn rows<'a>(&self, vector: &'a [[f64; 1]]) -> &'a [f64; D] {
        let first = self.row as usize;
        let rows = vector.as_flattened().get(first..first + D);
        rows.and_then(<[f64]>::as_array)
            .unwrap_or_else(|| no_such_row())
    }

    /// The same, mutable.
    #[inline]
    pub(super) fn rows_mut<'a>(&self, vector: &'a mut [[f64; 1]]) -> &'a mut [f64; D] {
        let first = self.row as usize;
        let rows = vector.as_flattened_mut().get_mut(first..first + D);
        rows.and_then(<[f64]>::as_mut_array)
            .unwrap_or_else(|| no_such_row())
    }

    /// `c h v⁰`, m.
    #[inline]
    fn flight_in(&self, view: &StepView<'_>, time: f64) -> [f64; D] {
        let velocities = points::<D>(view.state.velocities.values());
        if let Some(velocity) = velocities.get(self.node) {
            return scaled(time * view.step, velocity);
        }
        let mobility = time * view.step * self.per_mass;
        scaled(mobility, &points(view.state.momenta.values())[self.node])
    }

    /// Sets inertia, flight and push for a step, its set of unknowns and F⁰.
    #[inline]
    pub(super) fn weigh(&mut self, view: &StepView<'_>, set: &UnknownSet, force: [f64; D]) {
        self.inertia = self.mass * (set.inertia * view.per_step);
        if view.phase.moves() {
            self.flight = self.flight_in(view, set.time);
            self.push = scaled(-view.step, &force);
        } else {
            (self.flight, self.push) = ([0.0; D], [0.0; D]);
        }
    }

    /// `Δq` at a trial and its rest, m.
    #[inline]
    pub(super) fn moved<'a>(&self, trial: &'a Trial<D>) -> [&'a [f64; D]; 2] {
        [
            &trial.displacements[self.in_trial],
            &trial.carries[self.in_trial],
        ]
    }

    /// `Δq − h v⁰` at a trial, m.
    pub(super) fn change(&self, trial: &Trial<D>) -> [f64; D] {
        self.beyond_flight(self.moved(trial))
    }

    #[inline]
    fn beyond_flight(&self, [displacement, rest]: [&[f64; D]; 2]) -> [f64; D] {
        vector(|axis| (displacement[axis] - self.flight[axis]) + rest[axis])
    }

    /// `(t/m)(p + I)`, where an impulse and a momentum take the node in some time, m.
    #[inline]
    pub(super) fn displacement(
        &self,
        time: f64,
        momentum: &[f64; D],
        impulse: &[f64; D],
    ) -> [f64; D] {
        let mobility = time * self.per_mass;
        vector(|axis| mobility * (momentum[axis] + impulse[axis]))
    }

    /// Its velocities in a step.
    #[inline]
    pub(super) fn speeds(
        &self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        twice_per_step: f64,
    ) -> Speeds<D> {
        match points::<D>(view.state.velocities.values()).get(self.node) {
            None => Speeds::OfMass(self.per_mass),
            Some(&old) => {
                let change = scaled(twice_per_step, &self.change(trial));
                Speeds::Given { old, change }
            }
        }
    }

    /// `Δp = (2m/h)(Δq − (h/m) p⁰)`, N s, of a displacement, and the magnitude of its terms.
    ///
    /// It is accurate relative to Δp even where Δp is small compared with p, and relative to Δq where `Δp ≈ −2p⁰`.
    #[inline]
    pub(super) fn impulse(&self, displacement: [&[f64; D]; 2]) -> [[f64; D]; 2] {
        let [moved, _] = displacement;
        [
            scaled(self.inertia, &self.beyond_flight(displacement)),
            vector(|axis| self.inertia * moved[axis].abs()),
        ]
    }

    /// Starts residual and tangent of its momentum balance at a displacement, with `p¹` eliminated,
    ///
    /// ```text
    /// R = (2m/h)(q¹ − q⁰) − 2p⁰ + h F
    /// ```
    ///
    /// to which the elements add their contributions.
    #[inline]
    pub(super) fn balance(
        &self,
        displacement: [&[f64; D]; 2],
        values: &mut [f64],
        right: &mut [[f64; 1]],
    ) {
        for place in self.diagonal {
            values[place as usize] = self.inertia;
        }
        let [impulse, _] = self.impulse(displacement);
        *self.rows_mut(right) = vector(|axis| self.push[axis] - impulse[axis]);
    }
}

#[cold]
fn no_such_row() -> ! {
    unreachable!("rows come from the system")
}

/// A coupled interface temperature.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interface {
    /// The thermal slot, and its index in the trial.
    pub(super) slot: usize,
    pub(super) in_trial: usize,
    pub(super) row: usize,
}

impl Interface {
    /// Adds all of a set of unknowns.
    pub(super) fn add_all<const D: usize>(sites: &Sites<'_, D>, all: &mut Vec<Self>) {
        let first = sites.sets[0] * sites.layout.thermal;
        for (slot, unknown) in sites.layout.coupled.iter().enumerate() {
            if unknown.is_some() {
                all.push(Self {
                    slot,
                    in_trial: first + slot,
                    row: sites.row(*unknown),
                });
            }
        }
    }
}
