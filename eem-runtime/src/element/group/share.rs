//! The contribution of an element to the global system: computed on its own, then added at the matrix indices of the
//! element. Anchors have no equations.

use super::arms::{add_scaled, scale};
use super::eliminate::CondensedRow;
use super::member::Member;
use super::placed::{OfGroup, PlacedPoint};
use super::points::{Exchange, TrialView};
use super::pose::Pose;
use super::site::{ContactSite, HeatContact, Site};
use crate::element::conjugates::Family;
use crate::element::group::view::At;
use crate::element::kinematics::{Arms, Blocks, Gradient, Kinematics, Measures, Points};
use eem_material::free_energy::Array;

/// The contribution of the points of an element to the system of an iteration.
pub(super) struct Share<K: Kinematics<D>, const D: usize> {
    /// To the momentum balances of its nodes; `None` where nothing moves.
    pub(super) momentum: Option<Momentum<K, D>>,
    /// To the equations of the interface temperatures of its points.
    pub(super) heat: K::PerPoint<Option<Heat<K, D>>>,
}

/// The contribution of the points of an element to the momentum balances of its nodes.
pub(super) struct Momentum<K: Kinematics<D>, const D: usize> {
    /// `h w Gᵀ f*`, with the internal variables eliminated, N s.
    pub(super) pull: Arms<K, D>,
    /// Its derivatives with respect to the new arms.
    pub(super) blocks: Blocks<K, D>,
}

/// The contribution of a point with an interface temperature.
pub(super) struct Heat<K: Kinematics<D>, const D: usize> {
    /// The index of its contact.
    pub(super) contact: u32,
    /// `θ* − Θ`, with the internal variables eliminated, K.
    pub(super) residual: f64,
    /// The derivative of θ* with respect to the new arms, K/m.
    pub(super) by_arm: Arms<K, D>,
    /// The derivative of −θ* with respect to the heat that the point receives, K/W.
    pub(super) slope: f64,
    /// The derivative of `h w Gᵀ f*` with respect to that heat, N s/W.
    pub(super) pull: Arms<K, D>,
}

impl<K: Kinematics<D>, const D: usize> Share<K, D> {
    /// Empty, before any point is evaluated.
    #[inline]
    pub(super) fn none() -> Self {
        Self {
            momentum: None,
            heat: K::PerPoint::from_fn(|_| None),
        }
    }
}

impl<K: Kinematics<D>, const D: usize> PlacedPoint<K, D> {
    /// The derivative of a condensed response with respect to the new arms, times a factor.
    #[inline]
    fn by_arm<C: Family>(&self, row: &CondensedRow<Measures<K, D>>, factor: f64) -> Arms<K, D> {
        let mut sum = self.sensitivity[0];
        scale::<K, D>(&mut sum, factor * row.by_measure[0]);
        for a in 1..Measures::<K, D>::LEN {
            let by = factor * row.by_measure[a];
            add_scaled::<K, D>(&mut sum, by, &self.sensitivity[a]);
        }
        if !C::IS_EXACT
            && let Some(by_increment) = &self.by_increment
        {
            let by = -factor * row.by_heat;
            add_scaled::<K, D>(&mut sum, by, by_increment);
        }
        sum
    }

    /// The equation of the interface temperature of a point: Θ is θ*, or that of a damped scheme.
    #[inline]
    pub(super) fn heat<C: Family>(&self, exchange: &Exchange<K::Measures>) -> Heat<K, D> {
        let row = &exchange.heat;
        Heat {
            contact: exchange.contact,
            residual: row.value,
            by_arm: self.by_arm::<C>(row, 1.0),
            slope: row.by_heat * exchange.heat_factor,
            pull: Arms::<K, D>::filled([0.0; D]),
        }
    }

    /// Adds the impulse `h w Gᵀ f*` on the nodes and its derivatives to those of the points before, and the
    /// derivative with respect to heat from other elements to `heat`, if the point receives any.
    #[expect(
        clippy::inline_always,
        reason = "a call of its own costs 2 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn add_momentum<C: Family>(
        &self,
        (of, step): (OfGroup, f64),
        (pose, increments_by_arm): (&Pose<K, D>, Option<&Gradient<K, D>>),
        exchange: &Exchange<K::Measures>,
        heat: &mut Option<Heat<K, D>>,
        sum: &mut Option<Momentum<K, D>>,
    ) {
        let impulse = step * C::implicit(of.scheme);
        let mut forces = Measures::<K, D>::filled(0.0);
        let mut forces_by_arm = pose.direction;
        let mut values = forces;
        for a in 0..Measures::<K, D>::LEN {
            let row = &exchange.rows[a];
            forces[a] = impulse * exchange.forces[a];
            forces_by_arm[a] = self.by_arm::<C>(row, impulse);
            if !C::IS_EXACT
                && of.has_drag
                && let Some(by_arm) = increments_by_arm
            {
                let per_share = step.recip() * C::implicit(of.scheme).recip();
                let by = impulse * exchange.drags[a] * per_share;
                add_scaled::<K, D>(&mut forces_by_arm[a], by, &by_arm[a]);
            }
            values[a] = impulse * row.value;
            if let Some(heat) = heat {
                let by_heat = impulse * row.by_heat * exchange.heat_factor;
                add_scaled::<K, D>(&mut heat.pull, -by_heat, &pose.direction[a]);
            }
        }
        let (kinematics, at) = (&self.kinematics, C::placement(of.scheme));
        let pull = pose.pull(kinematics, at, &values);
        match sum {
            // Springs have one point, and no sum.
            None => {
                *sum = Some(Momentum {
                    pull,
                    blocks: pose.tangent(kinematics, at, &forces, &forces_by_arm),
                });
            }
            Some(sum) => {
                add_scaled::<K, D>(&mut sum.pull, 1.0, &pull);
                let blocks = &mut sum.blocks;
                pose.add_tangent(kinematics, at, (&forces, &forces_by_arm), blocks);
            }
        }
    }
}

impl<K: Kinematics<D>, const D: usize> Member<K, D> {
    /// Adds the contribution of the element to the entries of A and the rows of B.
    #[expect(
        clippy::inline_always,
        reason = "a call of its own costs 1 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn add_share(
        &self,
        share: &Share<K, D>,
        contacts: &Contacts<K, D>,
        (values, right): (&mut [f64], &mut [[f64; 1]]),
    ) {
        for heat in share.heat.as_ref().iter().flatten() {
            let (contact, own) = contacts.at(heat.contact);
            if share.momentum.is_some() {
                own.add_pull(contact, &self.site, &heat.pull, values);
            }
            own.add_balance(contact, &self.site, heat, values, right);
        }
        if let Some(momentum) = &share.momentum {
            self.site
                .add_momentum(momentum, right.as_flattened_mut(), values);
        }
    }
}

/// The contacts of a group: what points know of them, and their matrix indices.
pub(super) struct Contacts<K: Kinematics<D>, const D: usize> {
    pub(super) heat: Vec<HeatContact>,
    pub(super) sites: Vec<ContactSite<K, D>>,
}

impl<K: Kinematics<D>, const D: usize> Contacts<K, D> {
    pub(super) fn none() -> Self {
        Self {
            heat: Vec::new(),
            sites: Vec::new(),
        }
    }

    /// The trial of a step, as points see it.
    #[inline]
    pub(super) fn for_points<'a>(&'a self, (view, trial): At<'a, D>) -> TrialView<'a> {
        TrialView {
            view,
            interface: &trial.interface,
            is_start: trial.is_start,
            contacts: &self.heat,
        }
    }

    /// The contact with this index.
    #[inline]
    pub(super) fn at(&self, contact: u32) -> (&HeatContact, &ContactSite<K, D>) {
        (&self.heat[contact as usize], &self.sites[contact as usize])
    }
}

impl<K: Kinematics<D>, const D: usize> Site<K, D> {
    /// Adds the contribution to the balances of the nodes.
    #[expect(
        clippy::inline_always,
        reason = "a call of its own costs 2 % of a step"
    )]
    #[inline(always)]
    fn add_momentum(&self, momentum: &Momentum<K, D>, right: &mut [f64], values: &mut [f64]) {
        self.subtract_arms(&momentum.pull, &self.rows, right);
        for (i, row) in momentum.blocks.as_ref().iter().enumerate() {
            for (j, block) in row.as_ref().iter().enumerate() {
                self.add_block([i + 1, j + 1], block, values);
            }
        }
    }
}

impl<K: Kinematics<D>, const D: usize> ContactSite<K, D> {
    /// Adds the derivatives of a vector per arm times `Σ κ (Θ_partner − Θ)` to the rows of the nodes.
    #[inline]
    pub(super) fn add_pull(
        &self,
        contact: &HeatContact,
        site: &Site<K, D>,
        arms: &Arms<K, D>,
        values: &mut [f64],
    ) {
        let mut sum = 0.0;
        for (path, partner) in contact.paths.iter().zip(&self.partners) {
            let mut by_partner = *arms;
            scale::<K, D>(&mut by_partner, path.conductance);
            sum += path.conductance;
            site.add_column(&partner.column, &by_partner, values);
        }
        let mut by_own = *arms;
        scale::<K, D>(&mut by_own, -sum);
        site.add_column(&self.column, &by_own, values);
    }

    /// Adds the equation `Θ − θ* = 0`.
    #[inline]
    fn add_balance(
        &self,
        contact: &HeatContact,
        site: &Site<K, D>,
        heat: &Heat<K, D>,
        values: &mut [f64],
        right: &mut [[f64; 1]],
    ) {
        right[contact.unknown as usize][0] += heat.residual;
        site.subtract_arms(&heat.by_arm, &self.row, values);
        let mut diagonal = 1.0;
        for path in &contact.paths {
            let entry = heat.slope * path.conductance;
            values[path.entry as usize] += entry;
            diagonal -= entry;
        }
        values[contact.diagonal as usize] += diagonal;
    }
}

impl<K: Kinematics<D>, const D: usize> Site<K, D> {
    /// Subtracts a vector per arm from the entries that begin at the index of its node, and adds it to those of the
    /// first node.
    #[inline]
    pub(super) fn subtract_arms(
        &self,
        arms: &Arms<K, D>,
        places: &K::PerNode<u32>,
        target: &mut [f64],
    ) {
        for (i, arm) in arms.as_ref().iter().enumerate() {
            if self.is_mass[i + 1] {
                subtract(target, places[i + 1] as usize, arm);
            }
            if self.is_mass[0] {
                let entries = run_mut::<_, D>(target, places[0] as usize);
                for (sum, &entry) in entries.iter_mut().zip(arm) {
                    *sum += entry;
                }
            }
        }
    }

    /// Adds the block of the arms of the nodes i and j to the blocks (i, j) and (0, 0) of the nodes, and with the other
    /// sign to (i, 0) and (0, j).
    #[inline]
    pub(super) fn add_block(&self, [i, j]: [usize; 2], block: &[[f64; D]; D], values: &mut [f64]) {
        if self.is_mass[i] && self.is_mass[j] {
            self.add_rows(values, [i, j], block);
        }
        if self.is_mass[0] {
            self.add_rows(values, [0, 0], block);
            if self.is_mass[i] {
                self.subtract_rows(values, [i, 0], block);
            }
            if self.is_mass[j] {
                self.subtract_rows(values, [0, j], block);
            }
        }
    }

    /// Adds to the block of two nodes, row by row.
    #[inline]
    fn add_rows(&self, values: &mut [f64], [i, j]: [usize; 2], block: &[[f64; D]; D]) {
        let mut place = self.blocks[i][j] as usize;
        for entries in block {
            for (value, &entry) in run_mut::<_, D>(values, place).iter_mut().zip(entries) {
                *value += entry;
            }
            place += self.strides[i] as usize;
        }
    }

    /// Subtracts from the block of two nodes, row by row.
    #[inline]
    fn subtract_rows(&self, values: &mut [f64], [i, j]: [usize; 2], block: &[[f64; D]; D]) {
        let mut place = self.blocks[i][j] as usize;
        for entries in block {
            subtract(values, place, entries);
            place += self.strides[i] as usize;
        }
    }

    /// Adds a vector per arm to a column, given by the entry in the first row of each node, and subtracts it from the
    /// rows of the first node.
    #[expect(clippy::inline_always, reason = "a few numbers in registers")]
    #[inline(always)]
    pub(super) fn add_column(
        &self,
        column: &K::PerNode<u32>,
        arms: &Arms<K, D>,
        values: &mut [f64],
    ) {
        for (i, arm) in arms.as_ref().iter().enumerate() {
            if self.is_mass[i + 1] {
                let mut place = column[i + 1] as usize;
                for &entry in arm {
                    values[place] += entry;
                    place += self.strides[i + 1] as usize;
                }
            }
            if self.is_mass[0] {
                let mut place = column[0] as usize;
                for &entry in arm {
                    values[place] -= entry;
                    place += self.strides[0] as usize;
                }
            }
        }
    }
}

/// Subtracts from consecutive entries.
#[inline]
pub(super) fn subtract<const D: usize>(values: &mut [f64], place: usize, entries: &[f64; D]) {
    for (value, &entry) in run_mut::<_, D>(values, place).iter_mut().zip(entries) {
        *value -= entry;
    }
}

/// `D` consecutive entries, with one bounds check.
#[inline]
pub(super) fn run<T, const D: usize>(entries: &[T], first: usize) -> &[T; D] {
    match entries.get(first..first + D).map(TryInto::try_into) {
        Some(Ok(run)) => run,
        _ => not_from_the_system(),
    }
}

/// The same, mutable.
#[inline]
fn run_mut<T, const D: usize>(entries: &mut [T], first: usize) -> &mut [T; D] {
    match entries.get_mut(first..first + D).map(TryInto::try_into) {
        Some(Ok(run)) => run,
        _ => not_from_the_system(),
    }
}

#[cold]
fn not_from_the_system() -> ! {
    unreachable!("places and rows come from the system, which has them")
}
