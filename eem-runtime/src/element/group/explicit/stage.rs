//! The state of a scene at a stage of an explicit step, and its rates.

use crate::algebra::vector;
use crate::element::layout::Layout;

/// The number of stages whose rates are stored at the same time.
pub(crate) const KEPT: usize = 10;

/// Rows of rates and their coefficients, constants where they are used.
pub(crate) type Combination<'a> = (&'a [usize], &'a [f64]);

/// Variables at the start of a step, and their rates at its stages.
#[derive(Clone, Copy, Debug)]
#[repr(align(16))]
pub(crate) struct Past<const N: usize, const P: usize> {
    pub(crate) start: [[f64; N]; P],
    pub(crate) rates: [[[f64; N]; P]; KEPT],
}

impl<const N: usize, const P: usize> Past<N, P> {
    fn none() -> Self {
        let none = [[0.0; N]; P];
        Self {
            start: none,
            rates: [none; KEPT],
        }
    }

    /// `Σ a k` with some of the rates.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "rows and coefficients are constants of the caller"
    )]
    #[expect(
        clippy::needless_range_loop,
        reason = "with `array::from_fn` a step takes a quarter more instructions"
    )]
    pub(crate) fn combined(&self, (rows, a): Combination<'_>) -> [[f64; N]; P] {
        let mut sums = [[0.0; N]; P];
        for part in 0..P {
            for index in 0..N {
                let mut sum = a[0] * self.rates[rows[0]][part][index];
                for term in 1..a.len() {
                    sum += a[term] * self.rates[rows[term]][part][index];
                }
                sums[part][index] = sum;
            }
        }
        sums
    }

    /// Stores the newest rates in the last row; `y = y⁰ + h Σ a k`. Stored one by one, they are not loaded again.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "as above")]
    #[expect(clippy::needless_range_loop, reason = "as above")]
    pub(crate) fn advance(
        &mut self,
        newest: &[[f64; N]; P],
        h: f64,
        (rows, a): Combination<'_>,
    ) -> [[f64; N]; P] {
        let last = rows[rows.len() - 1];
        for part in 0..P {
            for index in 0..N {
                self.rates[last][part][index] = newest[part][index];
            }
        }
        self.after(h, (rows, a))
    }

    /// `y = y⁰ + h Σ a k`.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "as above")]
    #[expect(clippy::needless_range_loop, reason = "as above")]
    pub(crate) fn after(&self, h: f64, terms: Combination<'_>) -> [[f64; N]; P] {
        let mut y = self.combined(terms);
        for part in 0..P {
            for index in 0..N {
                y[part][index] = self.start[part][index] + h * y[part][index];
            }
        }
        y
    }
}

/// A mass, or an anchor in one of the components (connected bodies) that it holds.
///
/// In the order of the fields, vectors of the plane lie where they are loaded at once.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub(crate) struct Place<const D: usize> {
    /// q, m, and p, kg m/s.
    pub(crate) now: [[f64; D]; 2],
    /// Their rates: v, m/s, and F, N; for an anchor the reaction, N, which is used only if it is moved.
    pub(crate) rates: [[f64; D]; 2],
    /// 1/m for each axis; zero for anchors.
    per_mass: [f64; D],
    /// Its weight and the constant loads on it, N.
    pub(crate) force: [f64; D],
    pub(crate) past: Past<D, 2>,
    /// m; zero for anchors.
    pub(crate) mass: f64,
}

impl<const D: usize> Place<D> {
    /// At rest at the origin; an anchor has the mass zero.
    pub(crate) fn new(mass: f64) -> Self {
        let is_anchor = mass == 0.0;
        Self {
            now: [[0.0; D]; 2],
            rates: [[0.0; D]; 2],
            per_mass: [if is_anchor { 0.0 } else { mass.recip() }; D],
            force: [0.0; D],
            past: Past::none(),
            mass,
        }
    }

    /// The rates that follow from the momentum; forces are added to them.
    #[inline]
    pub(crate) fn begin_rates(&mut self) {
        self.rates = [
            vector(|axis| self.now[1][axis] * self.per_mass[axis]),
            [0.0; D],
        ];
    }

    /// Adds a force, N.
    #[inline]
    pub(crate) fn pull(&mut self, by: &[f64; D]) {
        let mut force = self.rates[1];
        for (force, &by) in force.iter_mut().zip(by) {
            *force += by;
        }
        self.rates[1] = force;
    }

    /// Subtracts a force, N.
    #[inline]
    pub(crate) fn push(&mut self, by: &[f64; D]) {
        let mut force = self.rates[1];
        for (force, &by) in force.iter_mut().zip(by) {
            *force -= by;
        }
        self.rates[1] = force;
    }

    /// 1/m.
    #[inline]
    pub(crate) const fn per_mass(&self) -> f64 {
        self.per_mass[0]
    }

    /// Calls a function for its rates, at the start of the step and now.
    pub(crate) fn each_rate(&mut self, visit: &mut dyn FnMut([&mut f64; 2])) {
        let starts = self.past.rates[0].as_flattened_mut().iter_mut();
        for (start, now) in starts.zip(self.rates.as_flattened_mut()) {
            visit([start, now]);
        }
    }

    #[inline]
    pub(crate) const fn q(&self) -> &[f64; D] {
        &self.now[0]
    }

    #[inline]
    pub(crate) const fn p(&self) -> &[f64; D] {
        &self.now[1]
    }

    #[inline]
    pub(crate) const fn velocity(&self) -> &[f64; D] {
        &self.rates[0]
    }
}

/// A rate at the present stage and at the start of the step, and its sum over the stages so far with their weights.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Integral {
    pub(crate) rate: f64,
    pub(crate) start: f64,
    pub(crate) sum: f64,
}

impl Integral {
    /// Begins a step, with the weight of its start.
    #[inline]
    pub(crate) fn begin(&mut self, weight: f64) {
        self.start = self.rate;
        self.sum = weight * self.rate;
    }

    /// Adds a stage of this weight.
    #[inline]
    pub(crate) fn add(&mut self, weight: f64, rate: f64) {
        self.rate = rate;
        self.sum += weight * rate;
    }
}

/// The thermostat of an element in a step, from θ⁰ to θ¹.
///
/// Heat and entropy that it gives obey `δQ = θ dS`. With the entropy G that the element lacks at the end of the step,
///
/// ```text
/// Q = θ¹ G + [ψ(x⁰, θ¹) − ψ(x⁰, θ⁰) + (θ¹ − θ⁰) s⁰] − ∫ ((f(θ) − f(θ¹)) λ̇ − (g(θ) − g(θ¹)) γ̇ + (1 − θ¹/θ) Q_in) dt
/// ```
///
/// with `x = (λ, γ)` and the heat `Q_in` of dashpots and paths. This is `∫ θ dS`, by `s = −∂ψ/∂θ`, without the rate of θ, which
/// may jump. Nothing but `θ G` is left where θ is constant.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Thermostat {
    /// Whether there is one.
    pub(crate) holds: bool,
    /// θ¹, K.
    pub(crate) last: f64,
    /// `Q_in` at the present stage and at the start of the step, W.
    pub(crate) received: f64,
    pub(crate) start: f64,
    /// The integral in units of the step, over the stages so far with their weights, W.
    pub(crate) sum: f64,
    /// `ψ(x⁰, θ¹) − ψ(x⁰, θ⁰)`, J.
    pub(crate) warming: f64,
}

impl Thermostat {
    /// `holds` says whether there is one.
    pub(crate) fn new(holds: bool) -> Self {
        Self {
            holds,
            last: 1.0,
            ..Self::default()
        }
    }

    /// Begins a step that ends with this temperature, K.
    pub(crate) fn begin(&mut self, last: f64) {
        (self.last, self.start) = (last, self.received);
        (self.sum, self.warming) = (0.0, 0.0);
    }

    /// `1 − θ¹/θ`.
    pub(crate) fn excess(&self, theta: f64) -> f64 {
        (theta - self.last) / theta
    }
}

/// The number of pairs of internal variables without reservoirs.
fn pairs(layout: &Layout) -> usize {
    (layout.viscous + layout.thermal).div_ceil(2)
}

/// The index of the first reservoir among thermal slots and reservoirs.
pub(crate) fn first_reservoir(layout: &Layout) -> usize {
    2 * pairs(layout) - layout.viscous
}

/// The internal variables at a stage, and the integrals of the step so far.
#[derive(Clone, Debug)]
pub(crate) struct Stage {
    /// The internal variables: viscous stretches, m, then the temperatures of thermal slots and, from the next pair on, of
    /// reservoirs, K.
    pub(crate) inner: Vec<f64>,
    /// Their rates `γ̇` and `θ̇`; before the elements have been evaluated the heat that flows into a thermal slot, W. Not used
    /// for a reservoir.
    pub(crate) inner_rates: Vec<f64>,
    /// Their starts and earlier rates, two variables per entry.
    pub(crate) inner_past: Vec<Past<1, 2>>,
    /// The index of the first temperature among the internal variables.
    pub(crate) temperatures: usize,
    /// The entropy production of each dashpot, `g γ̇/θ`, W/K, or without temperature its heat `g γ̇`, W.
    pub(crate) productions: Vec<Integral>,
    /// The heat of each dashpot, summed with the weights of the stages, W; empty unless it is metered.
    pub(crate) heats: Vec<f64>,
    pub(crate) has_heats: bool,
    /// The weight of this stage.
    pub(crate) weight: f64,
    /// Per thermal slot; empty without thermostats.
    pub(crate) thermostats: Vec<Thermostat>,
    pub(crate) has_thermostats: bool,
}

impl Stage {
    /// A stage of a scene.
    pub(crate) fn new(layout: &Layout, reservoirs: usize, thermostats: Vec<Thermostat>) -> Self {
        let pairs = pairs(layout);
        let all = 2 * pairs + reservoirs;
        Self {
            inner: vec![1.0; all],
            inner_rates: vec![0.0; all],
            inner_past: vec![Past::none(); pairs],
            temperatures: layout.viscous,
            productions: vec![Integral::default(); layout.viscous],
            heats: Vec::new(),
            has_heats: false,
            weight: 0.0,
            has_thermostats: !thermostats.is_empty(),
            thermostats,
        }
    }

    /// Adds the heat of a dashpot at this stage, W.
    #[cold]
    pub(crate) fn add_heat(&mut self, dashpot: usize, power: f64) {
        self.heats[dashpot] += self.weight * power;
    }

    /// Takes the heat of dashpots and paths that the element with a temperature receives, given its index among the internal
    /// variables, W. If a thermostat prescribes the temperature, sets its rate to zero.
    #[cold]
    pub(crate) fn receive(&mut self, temperature: usize, heat: f64) {
        let thermostat = &mut self.thermostats[temperature - self.temperatures];
        thermostat.received = heat;
        if thermostat.holds {
            self.inner_rates[temperature] = 0.0;
        }
    }

    /// An internal variable at the start of the step.
    pub(crate) fn inner_start(&self, index: usize) -> f64 {
        self.inner_past[index / 2].start[index % 2][0]
    }

    /// The temperature of a thermal slot or, with an index after those of the slots, of a reservoir, K.
    #[inline]
    pub(crate) fn theta(&self, slot: usize) -> f64 {
        self.inner[self.temperatures + slot]
    }

    #[inline]
    pub(crate) fn theta_mut(&mut self, slot: usize) -> &mut f64 {
        &mut self.inner[self.temperatures + slot]
    }

    /// Calls a function for all rates, at the start of the step and now.
    pub(crate) fn each_rate(&mut self, visit: &mut dyn FnMut([&mut f64; 2])) {
        let starts = self
            .inner_past
            .iter_mut()
            .flat_map(|past| &mut past.rates[0]);
        for ([start], now) in starts.zip(&mut self.inner_rates) {
            visit([start, now]);
        }
        for of in &mut self.productions {
            visit([&mut of.start, &mut of.rate]);
        }
        for of in &mut self.thermostats {
            visit([&mut of.start, &mut of.received]);
        }
    }

    /// Whether a thermostat prescribes the temperature of a thermal slot.
    #[inline]
    pub(crate) fn is_held(&self, slot: usize) -> bool {
        let thermostat = self.thermostats.get(slot);
        thermostat.is_some_and(|thermostat| thermostat.holds)
    }
}
