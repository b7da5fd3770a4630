//! From the elements to the global system.

use super::member::Member;
use super::pose::{Pose, spread};
use super::site::{Column, Contact, Site};
use super::{ElementGroup, StepView, Trial};
use crate::error::StateError;
use crate::free_energy::{Array, FreeEnergy};
use crate::kinematics::{Arms, Kinematics, Measures};
use crate::scalar::Real;
use crate::scheme::ElementScheme;
use crate::system::LinearSystem;

impl<S, M, K, C, const D: usize> ElementGroup<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// See [`Group::evaluate`](super::Group::evaluate).
    pub(super) fn evaluate_all(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: Option<&mut LinearSystem<S, 1>>,
    ) -> Result<(), StateError> {
        let kinematics = self.kinematics;
        let mut parts = system.map(LinearSystem::parts);
        for member in &mut self.members {
            let pose = member.respond(kinematics, view, trial, parts.is_some())?;
            let Some((values, right)) = &mut parts else {
                continue;
            };
            member.condense(view, &trial.seen_temperatures)?;
            let contact = member.site.contact.map(|at| &self.contacts[at]);
            let mut target = Target {
                values,
                right,
                contact,
            };
            if view.phase.moves() {
                member.assemble_momentum(kinematics, view, &pose, &mut target);
            }
            member.assemble_temperature(view, trial, &pose, &mut target);
        }
        Ok(())
    }
}

/// Where an element writes.
struct Target<'a, K: Kinematics<S, D>, S: Real, const D: usize> {
    values: &'a mut [S],
    right: &'a mut [[S; 1]],
    contact: Option<&'a Contact<K, S, D>>,
}

/// A response with the internal variables eliminated, relative to its present value:
/// `constant + Σ_a by_measure_a δπ_a + by_heat δr_s`.
struct CondensedRow<K: Kinematics<S, D>, S: Real, const D: usize> {
    constant: S,
    by_measure: Measures<K, S, D>,
    by_heat: S,
}

impl<S, M, K, C, const D: usize> Member<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// The factor by which heat from other elements enters the entropy balance:
    /// `∂r_s/∂Q = −h w/θ*`; zero without temperature.
    #[inline]
    pub(super) fn heat_factor(&self, view: &StepView<'_, S>) -> S {
        if !M::THERMAL {
            return S::zero();
        }
        -view.thermal_step() * S::from_f64(C::IMPLICIT) / self.temperature()
    }

    #[inline]
    fn condensed_row(&self, row: usize) -> CondensedRow<K, S, D> {
        let tangent = &self.answer.tangent[row];
        let mut condensed = CondensedRow::<K, S, D> {
            constant: S::zero(),
            by_measure: Measures::<K, S, D>::filled(S::zero()),
            by_heat: S::zero(),
        };
        for a in 0..M::MEASURES {
            condensed.by_measure[a] = tangent[a];
        }
        for u in 0..Self::UNKNOWNS {
            let by_unknown = tangent[M::MEASURES + u];
            condensed.constant -= by_unknown * self.condensed.constant[u];
            condensed.by_heat -= by_unknown * self.condensed.by_heat[u];
            for a in 0..M::MEASURES {
                condensed.by_measure[a] -= by_unknown * self.condensed.by_measure[u][a];
            }
        }
        condensed
    }

    /// The derivative of a condensed response by the new arms.
    #[inline]
    fn by_arm(&self, row: &CondensedRow<K, S, D>, pose: &Pose<K, S, D>) -> Arms<K, S, D> {
        let mut sum = Arms::<K, S, D>::filled([S::zero(); D]);
        for a in 0..M::MEASURES {
            for (sum, entry) in sum.as_mut().iter_mut().zip(pose.sensitivity[a].as_ref()) {
                for (sum, &entry) in sum.iter_mut().zip(entry) {
                    *sum += row.by_measure[a] * entry;
                }
            }
        }
        if C::IN_TEMPERATURE {
            let pairs = sum.as_mut().iter_mut().zip(self.by_increment.as_ref());
            for (sum, entry) in pairs {
                for (sum, &entry) in sum.iter_mut().zip(entry) {
                    *sum += row.by_heat * entry;
                }
            }
        }
        sum
    }

    /// The impulse `h w Gᵀ f*` on the nodes and its derivatives.
    #[inline]
    fn assemble_momentum(
        &self,
        kinematics: K,
        view: &StepView<'_, S>,
        pose: &Pose<K, S, D>,
        target: &mut Target<'_, K, S, D>,
    ) {
        let impulse = view.step * S::from_f64(C::IMPLICIT);
        let mut forces = Measures::<K, S, D>::filled(S::zero());
        for (a, force) in forces.as_mut().iter_mut().enumerate() {
            *force = impulse * self.answer.response[a];
        }
        let mut blocks = pose.curvature(kinematics, C::PLACEMENT, &forces);
        for a in 0..M::MEASURES {
            let row = self.condensed_row(a);
            let by_arm = self.by_arm(&row, pose);
            let change = forces[a] + impulse * row.constant;
            let direction = spread::<K, S, D>(&pose.direction[a]);
            for (&at, direction) in self.site.rows.as_ref().iter().zip(direction.as_ref()) {
                for (axis, &entry) in direction.iter().enumerate() {
                    target.right[at + axis][0] -= entry * change;
                }
            }
            for (i, direction) in pose.direction[a].as_ref().iter().enumerate() {
                for (j, by) in by_arm.as_ref().iter().enumerate() {
                    for (entries, &entry) in blocks[i][j].iter_mut().zip(direction) {
                        let along = impulse * entry;
                        for (block, &by) in entries.iter_mut().zip(by) {
                            *block += along * by;
                        }
                    }
                }
            }
            if let Some(contact) = target.contact {
                let heat = impulse * row.by_heat * self.heat_factor(view);
                contact.add_partners(&self.site, heat, &direction, target.values);
            }
        }
        for (i, row) in blocks.as_ref().iter().enumerate() {
            for (j, block) in row.as_ref().iter().enumerate() {
                self.site.add_block([i + 1, j + 1], block, target.values);
            }
        }
    }

    /// The equation `Θ − θ* = 0` of an element whose temperature neighbours see.
    #[inline]
    fn assemble_temperature(
        &self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        pose: &Pose<K, S, D>,
        target: &mut Target<'_, K, S, D>,
    ) {
        let (Some(contact), Some(slot)) = (target.contact, self.slots.thermal) else {
            return;
        };
        let row = self.condensed_row(Self::TEMPERATURE);
        let seen = trial.seen_temperatures[slot];
        target.right[contact.unknown][0] += self.temperature() + row.constant - seen;
        let by_node = spread::<K, S, D>(&self.by_arm(&row, pose));
        for (by, &place) in by_node.as_ref().iter().zip(contact.row.as_ref()) {
            subtract(target.values, place, by);
        }
        let heat = -row.by_heat * self.heat_factor(view);
        let mut diagonal = S::one();
        for partner in &contact.partners {
            let entry = heat * partner.conductance;
            target.values[partner.entry] += entry;
            diagonal -= entry;
        }
        target.values[contact.diagonal] += diagonal;
    }
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> Site<K, S, D> {
    /// Adds the block of the arms to two nodes: to the rows and columns of the nodes, and with the
    /// other sign to those of the first node.
    #[inline]
    pub(super) fn add_block(&self, [i, j]: [usize; 2], block: &[[S; D]; D], values: &mut [S]) {
        if self.is_mass[i] && self.is_mass[j] {
            add_rows(values, &self.blocks[i][j], block);
        }
        if self.is_mass[0] {
            add_rows(values, &self.blocks[0][0], block);
            if self.is_mass[i] {
                subtract_rows(values, &self.blocks[i][0], block);
            }
            if self.is_mass[j] {
                subtract_rows(values, &self.blocks[0][j], block);
            }
        }
    }

    /// Adds a column, `factor` times the direction of each node.
    #[inline]
    pub(super) fn add_column(
        &self,
        column: &Column<K, S, D>,
        factor: S,
        direction: &K::PerNode<[S; D]>,
        values: &mut [S],
    ) {
        let nodes = column.as_ref().iter().zip(direction.as_ref());
        for ((places, direction), &is_mass) in nodes.zip(self.is_mass.as_ref()) {
            if !is_mass {
                continue;
            }
            for (&place, &entry) in places.iter().zip(direction) {
                values[place] += factor * entry;
            }
        }
    }
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> Contact<K, S, D> {
    /// Adds the derivatives of `factor Σ κ (Θ_partner − Θ)` to the rows of the nodes, each with its
    /// direction.
    #[inline]
    fn add_partners(
        &self,
        site: &Site<K, S, D>,
        factor: S,
        direction: &K::PerNode<[S; D]>,
        values: &mut [S],
    ) {
        let mut own = S::zero();
        for partner in &self.partners {
            let entry = factor * partner.conductance;
            own -= entry;
            site.add_column(&partner.column, entry, direction, values);
        }
        site.add_column(&self.column, own, direction, values);
    }
}

/// Adds a block, row by row.
#[inline]
fn add_rows<S: Real, const D: usize>(values: &mut [S], places: &[usize; D], block: &[[S; D]; D]) {
    for (entries, &place) in block.iter().zip(places) {
        let Some(values) = values[place..].first_chunk_mut::<D>() else {
            continue;
        };
        for (value, &entry) in values.iter_mut().zip(entries) {
            *value += entry;
        }
    }
}

/// Subtracts a block, row by row.
#[inline]
fn subtract_rows<S: Real, const D: usize>(
    values: &mut [S],
    places: &[usize; D],
    block: &[[S; D]; D],
) {
    for (entries, &place) in block.iter().zip(places) {
        subtract(values, place, entries);
    }
}

/// Subtracts from consecutive entries.
#[inline]
pub(super) fn subtract<S: Real, const D: usize>(values: &mut [S], place: usize, entries: &[S; D]) {
    let Some(values) = values[place..].first_chunk_mut::<D>() else {
        return;
    };
    for (value, &entry) in values.iter_mut().zip(entries) {
        *value -= entry;
    }
}
