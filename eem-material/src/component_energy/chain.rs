//! The chain rule between joint invariants and components of E and Γ.

use core::array;

use crate::free_energy::{Array, FreeEnergy};
use crate::joint::{DEVIATORIC, Joint, JointEnergy, Tensors};

/// Derivatives with respect to the variables: a row per quantity.
type Rows<const N: usize, const R: usize> = [[f64; N]; R];

/// A material with joint invariants, as a function of components.
pub(super) trait Chain: FreeEnergy<f64> + JointEnergy {
    /// Number of strains of the material.
    const STRAINS: usize = Self::MEASURES - Self::JOINT.len();

    /// Number of components of Γ: six if it has a trace.
    const COMPONENTS: usize = DEVIATORIC + has_trace(Self::JOINT) as usize;

    /// The indices of the first components of E and Γ.
    const FIRST: [usize; 2] = {
        let dashpots = Self::STRAINS + Self::COMPONENTS;
        [Self::STRAINS, dashpots + Self::DASHPOTS]
    };

    /// The index, among those of components, of a variable or conjugate of the material that belongs to no invariant.
    fn index(of_material: usize) -> usize {
        let invariants = Self::JOINT.len();
        if of_material < Self::STRAINS {
            of_material
        } else if of_material < Self::MEASURES + Self::DASHPOTS {
            of_material - invariants + Self::COMPONENTS
        } else {
            of_material - invariants + 2 * Self::COMPONENTS
        }
    }

    /// The invariant at an index of the variables of the material.
    #[inline]
    fn joint(&self, of_material: usize) -> Option<Joint> {
        let joint = of_material.checked_sub(Self::STRAINS)?;
        self.joints().get(joint).copied()
    }

    /// The invariants with their indices among the variables of the material.
    #[inline]
    fn invariants(&self) -> impl Iterator<Item = (usize, Joint)> {
        (Self::STRAINS..).zip(self.joints().iter().copied())
    }

    /// E and Γ.
    fn tensors<const N: usize>(x: &[f64; N]) -> Tensors {
        let [strain, viscous] = Self::FIRST.map(|first| &x[first..first + Self::COMPONENTS]);
        Tensors::new(strain, viscous)
    }

    /// The variables of the material.
    fn variables<const N: usize>(&self, x: &[f64; N]) -> Self::Variables {
        let tensors = Self::tensors(x);
        let mut variables = Self::Variables::filled(0.0);
        for (index, variable) in variables.as_mut().iter_mut().enumerate() {
            *variable = match self.joint(index) {
                Some(joint) => tensors.value(joint),
                None => x[Self::index(index)],
            };
        }
        variables
    }

    /// Conjugates of the components from those of the material, along gradients `P` of the invariants; those of Γ with
    /// the given sign.
    fn conjugates<const W: usize>(
        &self,
        along: &Tensors,
        of_material: &[f64],
        sign: f64,
    ) -> [f64; W] {
        let [strain, viscous] = Self::FIRST;
        let mut conjugates = [0.0; W];
        for (index, &value) in of_material.iter().enumerate() {
            let Some(joint) = self.joint(index) else {
                conjugates[Self::index(index)] = value;
                continue;
            };
            for k in 0..Self::COMPONENTS {
                conjugates[strain + k] += value * along.by_strain(joint, k);
                conjugates[viscous + k] += sign * (value * along.by_viscous(joint, k));
            }
        }
        conjugates
    }

    /// Weights of conjugates of the material from those of the components: the transpose of
    /// [`conjugates`](Self::conjugates).
    fn weights<A: Array<f64>>(&self, along: &Tensors, of_components: &[f64], sign: f64) -> A {
        let [strain, viscous] = Self::FIRST;
        let mut weights = A::filled(0.0);
        for (index, weight) in weights.as_mut().iter_mut().enumerate() {
            let Some(joint) = self.joint(index) else {
                *weight = of_components[Self::index(index)];
                continue;
            };
            for k in 0..Self::COMPONENTS {
                *weight += of_components[strain + k] * along.by_strain(joint, k);
                *weight += sign * (of_components[viscous + k] * along.by_viscous(joint, k));
            }
        }
        weights
    }

    /// Weights of the response of the material from those of the response by components.
    fn response_weights<const N: usize>(
        &self,
        ends: [&[f64; N]; 2],
        of_components: &[f64],
    ) -> Self::Response {
        let [old, new] = ends.map(Self::tensors);
        self.weights(&old.mean(&new), of_components, -1.0)
    }

    /// The derivatives of conjugates with respect to the new components, from those of the material. `fraction` is the
    /// weight of the new state in the gradients `along`: ½ for the mean of two states, 1 for a single state.
    fn slopes<const N: usize, const W: usize>(
        &self,
        [along, new]: [&Tensors; 2],
        (response, tangent): (&[f64], &[Self::Variables]),
        [sign, fraction]: [f64; 2],
    ) -> Rows<N, W> {
        let [strain, viscous] = Self::FIRST;
        let mut slopes = [[0.0; N]; W];
        for (index, row) in tangent.iter().enumerate() {
            let row: [f64; N] = self.conjugates(new, row.as_ref(), 1.0);
            let Some(joint) = self.joint(index) else {
                slopes[Self::index(index)] = row;
                continue;
            };
            let force = fraction * response[index];
            for k in 0..Self::COMPONENTS {
                let by = [along.by_strain(joint, k), sign * along.by_viscous(joint, k)];
                for (column, &entry) in row.iter().enumerate() {
                    slopes[strain + k][column] += by[0] * entry;
                    slopes[viscous + k][column] += by[1] * entry;
                }
                match joint {
                    Joint::Trace => {}
                    Joint::Square => slopes[viscous + k][viscous + k] += sign * (force + force),
                    Joint::Strain => {
                        slopes[strain + k][viscous + k] += force;
                        slopes[viscous + k][strain + k] += sign * force;
                    }
                }
            }
        }
        slopes
    }

    /// Splits the values of the old state for a form: those of the material, E and Γ.
    fn split<T: Array<f64>>(old: &[f64]) -> (T, Tensors) {
        let mut own = T::filled(0.0);
        let (of_material, components) = old.split_at(T::LEN);
        own.as_mut().copy_from_slice(of_material);
        let (strain, rest) = components.split_at(Self::COMPONENTS);
        (own, Tensors::new(strain, &rest[..Self::COMPONENTS]))
    }

    /// Joins what [`split`](Self::split) splits.
    fn joined<const N: usize, const W: usize>(own: &[f64], x0: &[f64; N]) -> [f64; W] {
        let mut all = [0.0; W];
        let (of_material, rest) = all.split_at_mut(own.len());
        of_material.copy_from_slice(own);
        for (part, first) in rest.chunks_exact_mut(Self::COMPONENTS).zip(Self::FIRST) {
            part.copy_from_slice(&x0[first..first + Self::COMPONENTS]);
        }
        all
    }

    /// The response of a form by components, from that of the material.
    fn response<const N: usize, const R: usize>(
        &self,
        old: &Tensors,
        x1: &[f64; N],
        of_material: &Self::Response,
    ) -> [f64; R] {
        let mean = old.mean(&Self::tensors(x1));
        self.conjugates(&mean, of_material.as_ref(), -1.0)
    }

    /// The response of a form by components with its tangent, from those of the material.
    fn form<const N: usize, const R: usize>(
        &self,
        old: &Tensors,
        x1: &[f64; N],
        (response, tangent): (Self::Response, Self::Tangent),
    ) -> ([f64; R], Rows<N, R>) {
        let new = Self::tensors(x1);
        let both = [&old.mean(&new), &new];
        let of_material = (response.as_ref(), tangent.as_ref());
        (
            self.response(old, x1, &response),
            self.slopes(both, of_material, [-1.0, 0.5]),
        )
    }

    /// Viscosities of the components from those of the material.
    fn spread<const K: usize>(own: &[f64]) -> [f64; K] {
        let dashpots = Self::DASHPOTS;
        array::from_fn(|k| match k.checked_sub(dashpots) {
            None => own[k],
            Some(component) if component < DEVIATORIC => own[dashpots],
            Some(_) => own[dashpots + 1],
        })
    }

    /// Weights of the viscosities of the material from those of the components: the transpose of
    /// [`spread`](Self::spread).
    fn gathered(of_components: &[f64]) -> Self::Viscosities {
        let dashpots = Self::DASHPOTS;
        let mut own = Self::Viscosities::filled(0.0);
        for (k, &weight) in of_components.iter().enumerate() {
            let place = match k.checked_sub(dashpots) {
                None => k,
                Some(component) if component < DEVIATORIC => dashpots,
                Some(_) => dashpots + 1,
            };
            own[place] += weight;
        }
        own
    }
}

impl<M: FreeEnergy<f64> + JointEnergy> Chain for M {}

const fn has_trace(invariants: &[Joint]) -> bool {
    let mut index = 0;
    while index < invariants.len() {
        if matches!(invariants[index], Joint::Trace) {
            return true;
        }
        index += 1;
    }
    false
}
