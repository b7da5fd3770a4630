//! The arrays for which elements are compiled.

use core::marker::PhantomData;

use crate::free_energy::{Array, Entry, FreeEnergy};

/// The arrays of materials with the same numbers of variables, see the types of [`FreeEnergy`] with these names.
pub trait Arrays: Entry {
    /// Number of measures.
    const MEASURES: usize;
    /// The most dashpots in series.
    const DASHPOTS: usize;
    /// Whether there may be a temperature.
    const THERMAL: bool;

    type Variables: Array<f64>;
    type Hessian: Array<Self::Variables>;
    type Viscosities: Array<f64>;
    type Drag: Array<f64>;
    type Corners: Array<f64>;
    type Response: Array<f64>;
    type Tangent: Array<Self::Variables>;
    /// Room for what a form keeps of the old state; a form that keeps more computes it again.
    type Kept: Array<f64>;
}

/// [`Arrays`] of these types; those of measures are first.
#[expect(clippy::type_complexity, reason = "one type for each kind of array")]
#[derive(Clone, Copy, Debug)]
pub struct Sizes<P, X, H, V, G, C, R, T, O>(PhantomData<(P, X, H, V, G, C, R, T, O)>);

impl<P, X, H, V, G, C, R, T, O> Arrays for Sizes<P, X, H, V, G, C, R, T, O>
where
    P: Array<f64>,
    X: Array<f64>,
    H: Array<X>,
    V: Array<f64>,
    G: Array<f64>,
    C: Array<f64>,
    R: Array<f64>,
    T: Array<X>,
    O: Array<f64>,
{
    const MEASURES: usize = P::LEN;
    const DASHPOTS: usize = X::LEN - P::LEN - Self::THERMAL as usize;
    const THERMAL: bool = R::LEN > X::LEN;

    type Variables = X;
    type Hessian = H;
    type Viscosities = V;
    type Drag = G;
    type Corners = C;
    type Response = R;
    type Tangent = T;
    type Kept = O;
}

/// The arrays of a material, with those of its measures, and room for O values of the old state.
pub type ArraysOf<M, P, O> = Sizes<
    P,
    <M as FreeEnergy<f64>>::Variables,
    <M as FreeEnergy<f64>>::Hessian,
    <M as FreeEnergy<f64>>::Viscosities,
    <M as FreeEnergy<f64>>::Drag,
    <M as FreeEnergy<f64>>::Corners,
    <M as FreeEnergy<f64>>::Response,
    <M as FreeEnergy<f64>>::Tangent,
    O,
>;

/// The arrays of springs.
///
/// | | |
/// |---|---|
/// | N | variables: the stretch, K viscous stretches, the temperature |
/// | K | dashpots in series |
/// | D | dashpots in parallel |
/// | C | corners: 2 (N − 1) with a temperature, else 0 |
/// | R | responses: N + 1 with a temperature, else N |
/// | O | values of the old state for which there is room |
pub type SpringArrays<
    const N: usize,
    const K: usize,
    const D: usize,
    const C: usize,
    const R: usize,
    const O: usize,
> = Sizes<
    [f64; 1],
    [f64; N],
    [[f64; N]; N],
    [f64; K],
    [f64; D],
    [f64; C],
    [f64; R],
    [[f64; N]; R],
    [f64; O],
>;
