//! A law as a material: the free energy of a spring or a solid, evaluated by tapes.

mod rows;
mod strains;

use core::cell::OnceCell;
use core::marker::PhantomData;
use core::slice;
use std::sync::Arc;

use eem_material::free_energy::{Array, Caloric, FreeEnergy, Rates, Rows};
use eem_material::number::scalar::Scalar;
use eem_runtime::Strain;

use crate::functions::{ByParameters, Functions, KEPT, MOST_PARAMETERS};
use crate::names::NAMELESS;
use crate::shape::{Measures, Shape};
use crate::tape::Tape;

/// A law as a material for scenes with the numbers `S`; made by [`Law::model`](crate::Law::model).
///
/// | | |
/// |---|---|
/// | H | its measures: [`Stretch`](crate::Stretch), [`Strains`](crate::Strains), [`Flow`](crate::Flow) |
/// | N | number of variables: measures, dashpots, temperature |
/// | K | dashpots in series |
/// | V | viscosities: K, and those of a viscous strain |
/// | D | dashpots in parallel with the spring, 0 or 1 |
/// | C | corners: 2 (N − 1) with a temperature, else 0 |
/// | R | responses: N + 1 with a temperature, else N |
///
/// Use the names of the shapes of springs, such as [`ThermalSpring1`](crate::ThermalSpring1), and [`solid!`](crate::solid). A
/// copy shares the tapes.
///
/// ```
/// use eem::FreeEnergy;
/// use eem::typed::{Law, Source, Spring0, compile};
///
/// let source = Source::new("|lambda: Stretch| 0.5 * k * (lambda - 1).powi(2)").parameter("k", None);
/// let law = Law::new(compile(&source)?, &[("k", 40.0)])?;
/// let spring: Spring0 = law.model()?;
/// assert_eq!(spring.free_energy(&[1.5]), 5.0);
/// assert_eq!(spring.gradient(&[1.5]), [20.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Typed<
    S,
    H,
    const N: usize,
    const K: usize,
    const V: usize,
    const D: usize,
    const C: usize,
    const R: usize,
> {
    functions: Arc<Functions<S>>,
    measures: PhantomData<H>,
}

impl<
    S: Scalar,
    H: Measures,
    const N: usize,
    const K: usize,
    const V: usize,
    const D: usize,
    const C: usize,
    const R: usize,
> Typed<S, H, N, K, V, D, C, R>
{
    /// The variables of a law of this type.
    pub(crate) const SHAPE: Shape = {
        assert!(R == N || R == N + 1, "there is one temperature or none");
        let [strains, _, dashpots, _] = H::AT_POINT;
        let (measures, flows) = (N - K - (R - N), V - K);
        // A viscous strain has five components, or six.
        let strains = match dashpots {
            0 => strains,
            dashpots => strains - (dashpots - K),
        };
        Shape {
            strains,
            joints: if strains == 0 { 0 } else { measures - strains },
            flows,
            dashpots: K,
            drag: D,
            thermal: R > N,
        }
    };

    /// The material of functions that have this shape.
    pub(crate) fn new(functions: Arc<Functions<S>>) -> Self {
        const {
            assert!(N == Self::SHAPE.variables(), "N = M + K + T");
            assert!(C == 2 * (N - 1) * (R - N), "C = 2 (N − 1) T");
            assert!(D <= 1, "one dashpot stands beside a spring");
            assert!(2 * N <= KEPT, "the old state can be kept");
            let (here, there) = (Self::SHAPE.at_point(), H::AT_POINT);
            assert!(
                here[0] == there[0] && here[1] == there[1],
                "the numbers of a point"
            );
            assert!(
                here[2] == there[2] && here[3] == there[3],
                "the numbers of a point"
            );
        }
        Self {
            functions,
            measures: PhantomData,
        }
    }

    /// The strains of a solid at a point.
    fn strains_at_point<const M: usize>(&self) -> [Strain; M] {
        core::array::from_fn(|index| self.functions.strains[index])
    }

    fn number(tape: &Tape<S>, x: &[S; N]) -> S {
        let mut number = [S::zero()];
        tape.run([x], [&mut number]);
        number[0]
    }

    /// A derivative with respect to parameters, or along a direction of them: NaN if the law has no derivatives, zero if it
    /// lacks the function that is differentiated.
    fn derivative<const I: usize, A: Array<S>>(
        &self,
        tape: impl Fn(&ByParameters<S>) -> Option<&Tape<S>>,
        inputs: [&[S]; I],
    ) -> A {
        let Some(all) = self.functions.by_parameters() else {
            return A::filled(S::from_f64(f64::NAN));
        };
        let mut found = A::filled(S::zero());
        if let Some(tape) = tape(all) {
            tape.run(inputs, [found.as_mut()]);
        }
        found
    }

    /// The entries of a direction for the parameters of this law.
    fn own<'a>(&self, direction: &'a [S; MOST_PARAMETERS]) -> &'a [S] {
        &direction[..self.functions.parameters.len()]
    }

    /// The temperature as the input of viscosities; no input if the law has no temperature.
    fn temperature_input(theta: &S) -> &[S] {
        if Self::THERMAL {
            slice::from_ref(theta)
        } else {
            &[]
        }
    }

    /// Forces, heat capacity and slopes; further results of the tape go to `others`.
    fn rates_of<const I: usize>(
        tape: &Tape<S>,
        inputs: [&[S]; I],
        others: &mut [S],
    ) -> Rates<[S; N]> {
        let (mut forces, mut slopes) = ([S::zero(); N], [S::zero(); N]);
        let count = if Self::THERMAL { N - 1 } else { 0 };
        tape.run(inputs, [&mut forces, &mut slopes[..count], others]);
        Rates { forces, slopes }
    }
}

impl<
    S: Scalar,
    H: Measures,
    const N: usize,
    const K: usize,
    const V: usize,
    const D: usize,
    const C: usize,
    const R: usize,
> FreeEnergy<S> for Typed<S, H, N, K, V, D, C, R>
{
    const MEASURES: usize = N - K - (R - N);
    const DASHPOTS: usize = K;
    const THERMAL: bool = R > N;
    const PER_VOLUME: bool = H::AT_POINT[0] > 0;
    const ROWS: Option<Rows<S, Self>> = Some(Self::rows());
    const MODEL: &'static str = NAMELESS;
    const HAS_PARAMETER_DERIVATIVES: bool = true;
    /// Empty: the names are known at run time, see `parameter_names`.
    const PARAMETERS: &'static [&'static str] = &[];

    type Parameters = [S; MOST_PARAMETERS];
    type Variables = [S; N];
    type Hessian = [[S; N]; N];
    type Viscosities = [S; V];
    type Drag = [S; D];
    type Corners = [S; C];
    type Response = [S; R];
    type Tangent = [[S; N]; R];
    type EntropyFormOld = [S; KEPT];
    type TemperatureFormOld = [S; KEPT];

    fn duplicate(&self) -> Self {
        self.clone()
    }

    fn model(&self) -> &'static &'static str {
        self.functions.name
    }

    fn kind(&self) -> u64 {
        self.functions.kind
    }

    fn parameter_count(&self) -> usize {
        self.functions.parameters.len()
    }

    fn parameter_names(&self) -> &'static [&'static str] {
        self.functions.parameter_names()
    }

    fn has_constant_capacity(&self) -> bool {
        self.functions.has_constant_capacity
    }

    fn parameter(&self, index: usize) -> S {
        self.functions.parameters[index]
    }

    fn free_energy(&self, x: &[S; N]) -> S {
        Self::number(&self.functions.free_energy, x)
    }

    fn energy_magnitude(&self, x: &[S; N]) -> S {
        Self::number(&self.functions.energy_magnitude, x)
    }

    fn internal_energy(&self, x: &[S; N]) -> S {
        Self::number(&self.functions.internal_energy, x)
    }

    fn gradient(&self, x: &[S; N]) -> [S; N] {
        let mut gradient = [S::zero(); N];
        self.functions.gradient.run([x], [&mut gradient]);
        gradient
    }

    fn hessian(&self, x: &[S; N]) -> ([S; N], [[S; N]; N]) {
        let (mut gradient, mut hessian) = ([S::zero(); N], [[S::zero(); N]; N]);
        let results = [&mut gradient[..], hessian.as_flattened_mut()];
        self.functions.hessian.run([x], results);
        (gradient, hessian)
    }

    fn caloric(&self, x: &[S; N]) -> Caloric<S> {
        let mut found = [S::zero(); 3];
        if let Some(tape) = &self.functions.caloric {
            tape.run([x], [&mut found]);
        }
        caloric(found)
    }

    fn caloric_at(&self, x: [S; N]) -> impl Fn(S) -> (Caloric<S>, S) {
        let staged = self.functions.caloric_at.as_ref();
        // Computed at the first call: a caller who knows the value at its first temperature often needs no other.
        let kept = OnceCell::new();
        move |theta| {
            let (mut found, mut free_energy) = ([S::zero(); 3], [S::zero()]);
            match staged {
                Some(staged) => {
                    let kept: &[S; KEPT] = kept.get_or_init(|| {
                        let mut kept = [S::zero(); KEPT];
                        staged.keep(&x[..N - 1], &mut kept);
                        kept
                    });
                    let count = staged.old.results();
                    let results = [&mut found[..], &mut free_energy];
                    staged.new.run([&kept[..count], &[theta]], results);
                }
                None => free_energy = [self.free_energy(&x)],
            }
            (caloric(found), free_energy[0])
        }
    }

    fn rates(&self, x: &[S; N]) -> Rates<[S; N]> {
        Self::rates_of(&self.functions.rates, [x], &mut [])
    }

    fn rates_at(&self, x: [S; N]) -> impl Fn(S) -> (Rates<[S; N]>, [S; 2]) {
        let mut kept = [S::zero(); KEPT];
        let staged = self.functions.rates_at.as_ref();
        let mut count = 0;
        if let Some(staged) = staged {
            staged.keep(&x[..N - 1], &mut kept);
            count = staged.old.results();
        }
        move |theta| {
            let mut others = [S::zero(); 2];
            let rates = match (staged, &self.functions.rates_of_state) {
                (Some(staged), _) => {
                    let inputs = [&kept[..count], &[theta][..]];
                    Self::rates_of(&staged.new, inputs, &mut others)
                }
                (None, Some(tape)) => Self::rates_of(tape, [&x], &mut others[1..]),
                (None, None) => unreachable!("one of them is there"),
            };
            (rates, others)
        }
    }

    fn entropy_hessian(&self, x: &[S; N]) -> [[S; N]; N] {
        let mut hessian = [[S::zero(); N]; N];
        if let Some(tape) = &self.functions.entropy_hessian {
            tape.run([x], [hessian.as_flattened_mut()]);
        }
        hessian
    }

    fn viscosity(&self, theta: S) -> ([S; V], [S; V]) {
        let (mut eta, mut slope) = ([S::zero(); V], [S::zero(); V]);
        if let Some(tape) = &self.functions.viscosity {
            let theta = Self::temperature_input(&theta);
            tape.run([theta], [&mut eta, &mut slope]);
        }
        (eta, slope)
    }

    fn drag(&self, theta: S) -> ([S; D], [S; D]) {
        let (mut eta, mut slope) = ([S::zero(); D], [S::zero(); D]);
        if let Some(tape) = &self.functions.drag {
            let theta = Self::temperature_input(&theta);
            tape.run([theta], [&mut eta, &mut slope]);
        }
        (eta, slope)
    }

    fn entropy_form_old(&self, x0: &[S; N]) -> [S; KEPT] {
        let mut kept = [S::zero(); KEPT];
        let form = &self.functions.entropy_form.staged;
        form.keep(x0, &mut kept);
        if let Some(mixed) = &self.functions.mixed_states {
            mixed.keep(x0, &mut kept[form.old.results()..]);
        }
        kept
    }

    fn entropy_form(
        &self,
        old: &[S; KEPT],
        x1: &[S; N],
        corners: &[S; C],
    ) -> ([S; R], [[S; N]; R]) {
        let (mut response, mut tangent) = ([S::zero(); R], [[S::zero(); N]; R]);
        let form = &self.functions.entropy_form.staged;
        let results = [&mut response[..], tangent.as_flattened_mut()];
        let old = &old[..form.old.results()];
        form.new.run([old, x1, corners], results);
        (response, tangent)
    }

    fn entropy_form_response(&self, old: &[S; KEPT], x1: &[S; N], corners: &[S; C]) -> [S; R] {
        let mut response = [S::zero(); R];
        let form = &self.functions.entropy_form;
        let old = &old[..form.staged.old.results()];
        form.response.run([old, x1, corners], [&mut response]);
        response
    }

    fn mixed_states(
        &self,
        _: &[S; N],
        old: &[S; KEPT],
        x1: &[S; N],
        corners: &[S; C],
    ) -> [[S; C]; 2] {
        let mut found = [[S::zero(); C]; 2];
        if let Some(mixed) = &self.functions.mixed_states {
            let first = self.functions.entropy_form.staged.old.results();
            let old = &old[first..first + mixed.old.results()];
            mixed
                .new
                .run([old, x1, corners], [found.as_flattened_mut()]);
        }
        found
    }

    fn temperature_form_old(&self, x0: &[S; N]) -> [S; KEPT] {
        let Some(form) = &self.functions.temperature_form else {
            return self.entropy_form_old(x0);
        };
        let mut kept = [S::zero(); KEPT];
        form.staged.keep(x0, &mut kept);
        kept
    }

    fn temperature_form(&self, old: &[S; KEPT], x1: &[S; N]) -> ([S; R], [[S; N]; R]) {
        let Some(form) = &self.functions.temperature_form else {
            return self.entropy_form(old, x1, &[S::zero(); C]);
        };
        let (mut response, mut tangent) = ([S::zero(); R], [[S::zero(); N]; R]);
        let results = [&mut response[..], tangent.as_flattened_mut()];
        let old = &old[..form.staged.old.results()];
        form.staged.new.run([old, x1], results);
        (response, tangent)
    }

    fn temperature_form_response(&self, old: &[S; KEPT], x1: &[S; N]) -> [S; R] {
        let Some(form) = &self.functions.temperature_form else {
            return self.entropy_form_response(old, x1, &[S::zero(); C]);
        };
        let mut response = [S::zero(); R];
        let old = &old[..form.staged.old.results()];
        form.response.run([old, x1], [&mut response]);
        response
    }

    fn temperature_form_adjoint(
        &self,
        x0: &[S; N],
        x1: &[S; N],
        weights: &[S; R],
    ) -> [S; MOST_PARAMETERS] {
        if !Self::THERMAL {
            return self.entropy_form_adjoint(x0, x1, &[S::zero(); C], weights);
        }
        self.derivative(
            |all| all.temperature_form_adjoint.as_ref(),
            [x0, x1, weights],
        )
    }

    fn temperature_form_tangent(
        &self,
        x0: &[S; N],
        x1: &[S; N],
        direction: &[S; MOST_PARAMETERS],
    ) -> [S; R] {
        if !Self::THERMAL {
            return self.entropy_form_tangent(x0, x1, &[S::zero(); C], direction);
        }
        self.derivative(
            |all| all.temperature_form_tangent.as_ref(),
            [x0, x1, self.own(direction)],
        )
    }

    fn entropy_form_adjoint(
        &self,
        x0: &[S; N],
        x1: &[S; N],
        corners: &[S; C],
        weights: &[S; R],
    ) -> [S; MOST_PARAMETERS] {
        self.derivative(
            |all| Some(&all.entropy_form_adjoint),
            [x0, x1, corners, weights],
        )
    }

    fn entropy_form_tangent(
        &self,
        x0: &[S; N],
        x1: &[S; N],
        corners: &[S; C],
        direction: &[S; MOST_PARAMETERS],
    ) -> [S; R] {
        self.derivative(
            |all| Some(&all.entropy_form_tangent),
            [x0, x1, corners, self.own(direction)],
        )
    }

    fn gradient_adjoint(&self, x: &[S; N], weights: &[S; N]) -> [S; MOST_PARAMETERS] {
        self.derivative(|all| Some(&all.gradient_adjoint), [x, weights])
    }

    fn energy_by_parameters(&self, x: &[S; N]) -> [S; MOST_PARAMETERS] {
        self.derivative(|all| Some(&all.energy), [x])
    }

    fn viscosity_adjoint(&self, theta: S, weights: &[S; V]) -> [S; MOST_PARAMETERS] {
        let inputs = [Self::temperature_input(&theta), weights];
        self.derivative(|all| all.viscosity_adjoint.as_ref(), inputs)
    }

    fn drag_adjoint(&self, theta: S, weights: &[S; D]) -> [S; MOST_PARAMETERS] {
        let inputs = [Self::temperature_input(&theta), weights];
        self.derivative(|all| all.drag_adjoint.as_ref(), inputs)
    }
}

fn caloric<S>([entropy, heat_capacity, magnitude]: [S; 3]) -> Caloric<S> {
    Caloric {
        entropy,
        heat_capacity,
        magnitude,
    }
}
