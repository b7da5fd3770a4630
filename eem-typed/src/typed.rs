//! A law as a material: the free energy of a spring or a solid, evaluated by tapes.

mod strains;
mod together;

use core::cell::OnceCell;
use core::marker::PhantomData;
use core::slice;
use std::sync::Arc;

use eem_material::free_energy::{Array, Caloric, FreeEnergy, Rates, TogetherOf};

use crate::functions::{ByParameters, Functions, MOST_PARAMETERS, caloric};
use crate::names::NAMELESS;
use crate::shape::{KEPT, Measures, Shape};
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
/// | O | values of the old state that a form keeps: 4, 16, 24 for the springs with exact numbers, else 32 |
///
/// With D = 1 these are the most: dashpots and a temperature that a spring lacks are unused entries of arrays.
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
    H,
    const N: usize,
    const K: usize,
    const V: usize,
    const D: usize,
    const C: usize,
    const R: usize,
    const O: usize,
> {
    functions: Arc<Functions>,
    measures: PhantomData<H>,
}

impl<
    H: Measures,
    const N: usize,
    const K: usize,
    const V: usize,
    const D: usize,
    const C: usize,
    const R: usize,
    const O: usize,
> Typed<H, N, K, V, D, C, R, O>
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
    pub(crate) fn new(functions: Arc<Functions>) -> Self {
        const {
            assert!(N == Self::SHAPE.variables(), "N = M + K + T");
            assert!(C == 2 * (N - 1) * (R - N), "C = 2 (N − 1) T");
            assert!(D <= 1, "one dashpot stands beside a spring");
            assert!(O == Self::SHAPE.kept(), "what a form keeps");
            assert!(2 * N <= O, "the old state can be kept");
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

    fn number(tape: &Tape, x: &[f64; N]) -> f64 {
        let mut number = [0.0];
        tape.run([x], [&mut number]);
        number[0]
    }

    /// A derivative with respect to parameters, or along a direction of them: NaN if the law has no derivatives, zero if it
    /// lacks the function that is differentiated.
    fn derivative<const I: usize, A: Array<f64>>(
        &self,
        tape: impl Fn(&ByParameters) -> Option<&Tape>,
        inputs: [&[f64]; I],
    ) -> A {
        let Some(all) = self.functions.by_parameters() else {
            return A::filled(f64::NAN);
        };
        let mut found = A::filled(0.0);
        if let Some(tape) = tape(all) {
            tape.run(inputs, [found.as_mut()]);
        }
        found
    }

    /// The temperature as the input of viscosities; no input if the law has no temperature.
    fn temperature_input<'a>(&self, theta: &'a f64) -> &'a [f64] {
        if self.functions.is_thermal() {
            slice::from_ref(theta)
        } else {
            &[]
        }
    }

    /// Forces, heat capacity and slopes; further results of the tape go to `others`.
    fn rates_of<const I: usize>(
        &self,
        tape: &Tape,
        inputs: [&[f64]; I],
        others: &mut [f64],
    ) -> Rates<[f64; N]> {
        let (mut forces, mut slopes) = ([0.0; N], [0.0; N]);
        let count = (N - 1) * usize::from(self.functions.is_thermal());
        tape.run(inputs, [&mut forces, &mut slopes[..count], others]);
        Rates { forces, slopes }
    }
}

impl<
    H: Measures,
    const N: usize,
    const K: usize,
    const V: usize,
    const D: usize,
    const C: usize,
    const R: usize,
    const O: usize,
> FreeEnergy<f64> for Typed<H, N, K, V, D, C, R, O>
{
    const MEASURES: usize = N - K - (R - N);
    const DASHPOTS: usize = K;
    const THERMAL: bool = R > N;
    const PER_VOLUME: bool = H::AT_POINT[0] > 0;
    const MODEL: &'static str = NAMELESS;
    const HAS_PARAMETER_DERIVATIVES: bool = true;
    /// Empty: the names are known at run time, see `parameter_names`.
    const PARAMETERS: &'static [&'static str] = &[];

    type Parameters = [f64; MOST_PARAMETERS];
    type Variables = [f64; N];
    type Hessian = [[f64; N]; N];
    type Viscosities = [f64; V];
    type Drag = [f64; D];
    type Corners = [f64; C];
    type Response = [f64; R];
    type Tangent = [[f64; N]; R];
    type EntropyFormOld = [f64; O];
    type TemperatureFormOld = [f64; O];

    fn duplicate(&self) -> Self {
        self.clone()
    }

    fn model(&self) -> &'static &'static str {
        self.functions.name
    }

    fn kind(&self) -> u64 {
        self.functions.kind
    }

    fn together(&self) -> Option<&TogetherOf<Self>> {
        let together: &TogetherOf<Self> = &*self.functions;
        (H::AT_POINT[0] == 0).then_some(together)
    }

    fn parameter_count(&self) -> usize {
        self.functions.parameters.len()
    }

    fn parameter_names(&self) -> &'static [&'static str] {
        self.functions.parameter_names()
    }

    fn dashpots(&self) -> usize {
        self.functions.dashpots
    }

    fn drags(&self) -> usize {
        self.functions.drags
    }

    fn is_thermal(&self) -> bool {
        self.functions.is_thermal()
    }

    fn has_constant_capacity(&self) -> bool {
        self.functions.has_constant_capacity
    }

    fn parameter(&self, index: usize) -> f64 {
        self.functions.parameters[index]
    }

    fn free_energy(&self, x: &[f64; N]) -> f64 {
        Self::number(&self.functions.free_energy, x)
    }

    fn energy_magnitude(&self, x: &[f64; N]) -> f64 {
        Self::number(&self.functions.energy_magnitude, x)
    }

    fn internal_energy(&self, x: &[f64; N]) -> f64 {
        Self::number(&self.functions.internal_energy, x)
    }

    fn gradient(&self, x: &[f64; N]) -> [f64; N] {
        let mut gradient = [0.0; N];
        self.functions.gradient.run([x], [&mut gradient]);
        gradient
    }

    fn hessian(&self, x: &[f64; N]) -> ([f64; N], [[f64; N]; N]) {
        let (mut gradient, mut hessian) = ([0.0; N], [[0.0; N]; N]);
        let results = [&mut gradient[..], hessian.as_flattened_mut()];
        self.functions.hessian.run([x], results);
        (gradient, hessian)
    }

    fn caloric(&self, x: &[f64; N]) -> Caloric<f64> {
        let mut found = [0.0; 3];
        if let Some(tape) = &self.functions.caloric {
            tape.run([x], [&mut found]);
        }
        caloric(found)
    }

    fn caloric_at(&self, x: [f64; N]) -> impl Fn(f64) -> (Caloric<f64>, f64) {
        let staged = self.functions.caloric_at.as_ref();
        // Computed at the first call: a caller who knows the value at its first temperature often needs no other.
        let kept = OnceCell::new();
        move |theta| {
            let (mut found, mut free_energy) = ([0.0; 3], [0.0]);
            match staged {
                Some(staged) => {
                    let kept: &[f64; KEPT] = kept.get_or_init(|| {
                        let mut kept = [0.0; KEPT];
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

    fn rates(&self, x: &[f64; N]) -> Rates<[f64; N]> {
        self.rates_of(&self.functions.rates, [x], &mut [])
    }

    fn rates_at(&self, x: [f64; N]) -> impl Fn(f64) -> (Rates<[f64; N]>, [f64; 2]) {
        let mut kept = [0.0; KEPT];
        let staged = self.functions.rates_at.as_ref();
        let mut count = 0;
        if let Some(staged) = staged {
            staged.keep(&x[..N - 1], &mut kept);
            count = staged.old.results();
        }
        move |theta| {
            let mut others = [0.0; 2];
            let rates = match (staged, &self.functions.rates_of_state) {
                (Some(staged), _) => {
                    let inputs = [&kept[..count], &[theta][..]];
                    self.rates_of(&staged.new, inputs, &mut others)
                }
                (None, Some(tape)) => self.rates_of(tape, [&x], &mut others[1..]),
                (None, None) => unreachable!("one of them is there"),
            };
            (rates, others)
        }
    }

    fn entropy_hessian(&self, x: &[f64; N]) -> [[f64; N]; N] {
        let mut hessian = [[0.0; N]; N];
        if let Some(tape) = &self.functions.entropy_hessian {
            tape.run([x], [hessian.as_flattened_mut()]);
        }
        hessian
    }

    fn viscosity(&self, theta: f64) -> ([f64; V], [f64; V]) {
        let (mut eta, mut slope) = ([0.0; V], [0.0; V]);
        if let Some(tape) = &self.functions.viscosity {
            let theta = self.temperature_input(&theta);
            tape.run([theta], [&mut eta, &mut slope]);
        }
        (eta, slope)
    }

    fn drag(&self, theta: f64) -> ([f64; D], [f64; D]) {
        let (mut eta, mut slope) = ([0.0; D], [0.0; D]);
        if let Some(tape) = &self.functions.drag {
            let theta = self.temperature_input(&theta);
            tape.run([theta], [&mut eta, &mut slope]);
        }
        (eta, slope)
    }

    fn entropy_form_old(&self, x0: &[f64; N]) -> [f64; O] {
        let mut kept = [0.0; O];
        let form = &self.functions.entropy_form.staged;
        form.keep(x0, &mut kept);
        if let Some(mixed) = &self.functions.mixed_states {
            mixed.keep(x0, &mut kept[form.old.results()..]);
        }
        kept
    }

    fn entropy_form(
        &self,
        old: &[f64; O],
        x1: &[f64; N],
        corners: &[f64; C],
    ) -> ([f64; R], [[f64; N]; R]) {
        let (mut response, mut tangent) = ([0.0; R], [[0.0; N]; R]);
        let form = &self.functions.entropy_form.staged;
        let results = [&mut response[..], tangent.as_flattened_mut()];
        let old = &old[..form.old.results()];
        form.new.run([old, x1, corners], results);
        (response, tangent)
    }

    fn entropy_form_response(&self, old: &[f64; O], x1: &[f64; N], corners: &[f64; C]) -> [f64; R] {
        let mut response = [0.0; R];
        let form = &self.functions.entropy_form;
        let old = &old[..form.staged.old.results()];
        form.response.run([old, x1, corners], [&mut response]);
        response
    }

    fn mixed_states(
        &self,
        _: &[f64; N],
        old: &[f64; O],
        x1: &[f64; N],
        corners: &[f64; C],
    ) -> [[f64; C]; 2] {
        let mut found = [[0.0; C]; 2];
        if let Some(mixed) = &self.functions.mixed_states {
            let first = self.functions.entropy_form.staged.old.results();
            let old = &old[first..first + mixed.old.results()];
            mixed
                .new
                .run([old, x1, corners], [found.as_flattened_mut()]);
        }
        found
    }

    fn temperature_form_old(&self, x0: &[f64; N]) -> [f64; O] {
        let Some(form) = &self.functions.temperature_form else {
            return self.entropy_form_old(x0);
        };
        let mut kept = [0.0; O];
        form.staged.keep(x0, &mut kept);
        kept
    }

    fn temperature_form(&self, old: &[f64; O], x1: &[f64; N]) -> ([f64; R], [[f64; N]; R]) {
        let Some(form) = &self.functions.temperature_form else {
            return self.entropy_form(old, x1, &[0.0; C]);
        };
        let (mut response, mut tangent) = ([0.0; R], [[0.0; N]; R]);
        let results = [&mut response[..], tangent.as_flattened_mut()];
        let old = &old[..form.staged.old.results()];
        form.staged.new.run([old, x1], results);
        (response, tangent)
    }

    fn temperature_form_response(&self, old: &[f64; O], x1: &[f64; N]) -> [f64; R] {
        let Some(form) = &self.functions.temperature_form else {
            return self.entropy_form_response(old, x1, &[0.0; C]);
        };
        let mut response = [0.0; R];
        let old = &old[..form.staged.old.results()];
        form.response.run([old, x1], [&mut response]);
        response
    }

    fn temperature_form_adjoint(
        &self,
        x0: &[f64; N],
        x1: &[f64; N],
        weights: &[f64; R],
    ) -> [f64; MOST_PARAMETERS] {
        if !self.functions.is_thermal() {
            return self.entropy_form_adjoint(x0, x1, &[0.0; C], weights);
        }
        self.derivative(
            |all| all.temperature_form_adjoint.as_ref(),
            [x0, x1, weights],
        )
    }

    fn temperature_form_tangent(
        &self,
        x0: &[f64; N],
        x1: &[f64; N],
        direction: &[f64; MOST_PARAMETERS],
    ) -> [f64; R] {
        if !self.functions.is_thermal() {
            return self.entropy_form_tangent(x0, x1, &[0.0; C], direction);
        }
        self.derivative(
            |all| all.temperature_form_tangent.as_ref(),
            [x0, x1, self.functions.own(direction)],
        )
    }

    fn entropy_form_adjoint(
        &self,
        x0: &[f64; N],
        x1: &[f64; N],
        corners: &[f64; C],
        weights: &[f64; R],
    ) -> [f64; MOST_PARAMETERS] {
        self.derivative(
            |all| Some(&all.entropy_form_adjoint),
            [x0, x1, corners, weights],
        )
    }

    fn entropy_form_tangent(
        &self,
        x0: &[f64; N],
        x1: &[f64; N],
        corners: &[f64; C],
        direction: &[f64; MOST_PARAMETERS],
    ) -> [f64; R] {
        self.derivative(
            |all| Some(&all.entropy_form_tangent),
            [x0, x1, corners, self.functions.own(direction)],
        )
    }

    fn gradient_adjoint(&self, x: &[f64; N], weights: &[f64; N]) -> [f64; MOST_PARAMETERS] {
        self.derivative(|all| Some(&all.gradient_adjoint), [x, weights])
    }

    fn energy_by_parameters(&self, x: &[f64; N]) -> [f64; MOST_PARAMETERS] {
        self.derivative(|all| Some(&all.energy), [x])
    }

    fn viscosity_adjoint(&self, theta: f64, weights: &[f64; V]) -> [f64; MOST_PARAMETERS] {
        let inputs = [self.temperature_input(&theta), weights];
        self.derivative(|all| all.viscosity_adjoint.as_ref(), inputs)
    }

    fn drag_adjoint(&self, theta: f64, weights: &[f64; D]) -> [f64; MOST_PARAMETERS] {
        let inputs = [self.temperature_input(&theta), weights];
        self.derivative(|all| all.drag_adjoint.as_ref(), inputs)
    }
}
