//! Materials of texts, and those behind tables, against derived ones: every function has the same bits.

use eem::typed::{
    DampedSpring, Law, Source, Spring0, Spring8, ThermalSpring0, ThermalSpring1, compile, solid,
};
use eem::{Array, FreeEnergy, Material};
use eem_material::arrays::{Arrays, SpringArrays};
use eem_material::free_energy::{ExactForm, MOST_TOGETHER, Steps};
use eem_material::tabled::Tabled;

use crate::zoo::behind_table::Behind;
use crate::zoo::families;
use crate::zoo::states;

/// States of a step and corner temperatures.
#[derive(Clone, Debug)]
pub(crate) struct At {
    x0: Vec<f64>,
    x1: Vec<f64>,
    corners: Vec<f64>,
}

/// A function and the bits of its results.
pub(crate) type Results = Vec<(&'static str, Vec<u64>)>;

/// The places that a material uses of its arrays, some of which have room for more variables than it has.
#[derive(Clone, Copy)]
struct Used {
    measures: usize,
    dashpots: usize,
    room: usize,
    drags: usize,
    is_thermal: bool,
}

impl Used {
    fn of<M: FreeEnergy<f64>>(model: &M) -> Self {
        Self {
            measures: M::MEASURES,
            dashpots: model.dashpots(),
            room: M::DASHPOTS - model.dashpots(),
            drags: model.drags(),
            is_thermal: model.is_thermal(),
        }
    }

    /// Of a state or a response.
    fn in_state(self) -> impl Fn(usize) -> bool + Copy {
        let beyond = self.measures + self.dashpots;
        move |index| index < beyond || self.is_thermal && index >= beyond + self.room
    }

    /// Of the mixed states, in two chains.
    fn in_corners(self) -> impl Fn(usize) -> bool + Copy {
        let all = self.measures + self.dashpots + self.room;
        move |index| index % all < self.measures + self.dashpots
    }

    fn in_viscosities(self) -> impl Fn(usize) -> bool + Copy {
        move |index| index < self.dashpots || index >= self.dashpots + self.room
    }

    fn in_drags(self) -> impl Fn(usize) -> bool + Copy {
        move |index| index < self.drags
    }
}

/// An array with these numbers at the places that are used.
fn array<A: Array<f64>>(is_used: impl Fn(usize) -> bool, numbers: &[f64]) -> A {
    let mut array = A::filled(0.0);
    let places = (0..A::LEN).filter(|&index| is_used(index));
    for (index, &number) in places.zip(numbers) {
        array[index] = number;
    }
    array
}

/// The numbers at these places.
fn at_used(is_used: impl Fn(usize) -> bool, numbers: &[f64]) -> impl Iterator<Item = f64> {
    let numbers = numbers.iter().copied().enumerate();
    numbers.filter_map(move |(index, number)| is_used(index).then_some(number))
}

/// All NaN are one.
fn bits(numbers: impl IntoIterator<Item = f64>) -> Vec<u64> {
    let bits = |number: f64| match number {
        number if number.is_nan() => f64::NAN.to_bits(),
        number => number.to_bits(),
    };
    numbers.into_iter().map(bits).collect()
}

fn rows_of<F: Array<f64>, V: Array<f64>, M: Array<V>>(
    is_used: impl Fn(usize) -> bool + Copy,
    first: &F,
    matrix: &M,
) -> Vec<u64> {
    let rows = matrix.as_ref().iter().enumerate();
    let rows = rows.filter(|(row, _)| is_used(*row));
    let rows = rows.flat_map(|(_, row)| at_used(is_used, row.as_ref()));
    bits(at_used(is_used, first.as_ref()).chain(rows))
}

fn flat<A: Array<f64>>(is_used: impl Fn(usize) -> bool + Copy, arrays: &[A]) -> Vec<u64> {
    bits((arrays.iter()).flat_map(|array| at_used(is_used, array.as_ref())))
}

/// Everything that a free energy computes, at the new state and between both.
pub(crate) fn everything<M: FreeEnergy<f64>>(model: &M, at: &At) -> Results {
    let mut all = of_state(model, at);
    all.extend(of_step(model, at));
    #[cfg(feature = "gradients")]
    all.extend(by_parameters(model, at));
    all
}

/// The derivatives by the parameters that there are: an array of a law has more room.
#[cfg(feature = "gradients")]
fn by_parameters<M: FreeEnergy<f64>>(model: &M, at: &At) -> Results {
    assert!(model.has_parameter_derivatives());
    let used = Used::of(model);
    let [x0, x1] = [&at.x0, &at.x1].map(|x| array::<M::Variables>(used.in_state(), x));
    let corners: M::Corners = array(used.in_corners(), &at.corners);
    let count = model.parameter_names().len();
    assert_eq!(count, model.parameter_count());
    let seed: Vec<f64> = (0..64_u8)
        .map(|k| eem::Scalar::sin(1.0 + 2.0 * f64::from(k)))
        .collect();
    let own = |found: M::Parameters| bits(found.as_ref()[..count].iter().copied());
    let weights = array(used.in_state(), &seed);
    let along = array(|_| true, &seed);
    let theta = x1[M::Variables::LEN - 1];
    let names = model.parameter_names().iter().flat_map(|name| name.bytes());
    vec![
        ("parameter_names", names.map(u64::from).collect()),
        (
            "temperature_form_adjoint",
            own(model.temperature_form_adjoint(&x0, &x1, &weights)),
        ),
        (
            "temperature_form_tangent",
            flat(
                used.in_state(),
                &[model.temperature_form_tangent(&x0, &x1, &along)],
            ),
        ),
        (
            "entropy_form_adjoint",
            own(model.entropy_form_adjoint(&x0, &x1, &corners, &weights)),
        ),
        (
            "entropy_form_tangent",
            flat(
                used.in_state(),
                &[model.entropy_form_tangent(&x0, &x1, &corners, &along)],
            ),
        ),
        (
            "gradient_adjoint",
            own(model.gradient_adjoint(&x1, &array(used.in_state(), &seed))),
        ),
        ("energy_by_parameters", own(model.energy_by_parameters(&x1))),
        (
            "viscosity_adjoint",
            own(model.viscosity_adjoint(theta, &array(used.in_viscosities(), &seed))),
        ),
        (
            "drag_adjoint",
            own(model.drag_adjoint(theta, &array(used.in_drags(), &seed))),
        ),
    ]
}

fn of_state<M: FreeEnergy<f64>>(model: &M, at: &At) -> Results {
    let used = Used::of(model);
    let [x0, x1] = [&at.x0, &at.x1].map(|x| array::<M::Variables>(used.in_state(), x));
    let last = M::Variables::LEN - 1;
    let (theta, none) = (x1[last], M::Variables::filled(0.0));
    let caloric = |c: eem::Caloric<f64>| [c.entropy, c.heat_capacity, c.magnitude];
    let (gradient, hessian) = model.hessian(&x1);
    let rates = model.rates(&x1);
    let (rates_at, others) = model.rates_at(x0)(theta);
    let (viscosities, viscosity_slopes) = model.viscosity(theta);
    let (drag, drag_slope) = model.drag(theta);
    let mut all = vec![
        ("free_energy", bits([model.free_energy(&x1)])),
        ("energy_magnitude", bits([model.energy_magnitude(&x1)])),
        ("internal_energy", bits([model.internal_energy(&x1)])),
        ("gradient", flat(used.in_state(), &[model.gradient(&x1)])),
        ("hessian", rows_of(used.in_state(), &gradient, &hessian)),
        ("caloric", bits(caloric(model.caloric(&x1)))),
        (
            "rates",
            flat(used.in_state(), &[rates.forces, rates.slopes]),
        ),
        (
            "rates_at",
            flat(used.in_state(), &[rates_at.forces, rates_at.slopes]),
        ),
        ("rates_at, s and psi", bits(others)),
        (
            "entropy_hessian",
            rows_of(used.in_state(), &none, &model.entropy_hessian(&x1)),
        ),
        (
            "viscosity",
            flat(used.in_viscosities(), &[viscosities, viscosity_slopes]),
        ),
        ("drag", flat(used.in_drags(), &[drag, drag_slope])),
        (
            "has_constant_capacity",
            vec![u64::from(model.has_constant_capacity())],
        ),
    ];
    if model.is_thermal() {
        for new in 0..=M::MEASURES + model.dashpots() {
            let (found, psi) = model.caloric_between(&x0, &x1, new)(theta);
            let found = caloric(found).into_iter().chain([psi]);
            all.push(("caloric_between", bits(found)));
        }
    }
    all
}

fn of_step<M: FreeEnergy<f64>>(model: &M, at: &At) -> Results {
    let used = Used::of(model);
    let [x0, x1] = [&at.x0, &at.x1].map(|x| array::<M::Variables>(used.in_state(), x));
    let (corners, none): (M::Corners, _) = (
        array(used.in_corners(), &at.corners),
        M::Variables::filled(0.0),
    );
    let old = model.entropy_form_old(&x0);
    let (response, tangent) = model.entropy_form(&old, &x1, &corners);
    let alone = model.entropy_form_response(&old, &x1, &corners);
    let mut all = vec![
        ("entropy_form", flat(used.in_state(), &[response])),
        (
            "entropy_form, tangent",
            rows_of(used.in_state(), &none, &tangent),
        ),
        ("entropy_form_response", flat(used.in_state(), &[alone])),
    ];
    if model.is_thermal() {
        let mixed = model.mixed_states(&x0, &old, &x1, &corners);
        all.push(("mixed_states", flat(used.in_corners(), &mixed)));
    }
    let old = model.temperature_form_old(&x0);
    let (response, tangent) = model.temperature_form(&old, &x1);
    let alone = model.temperature_form_response(&old, &x1);
    all.extend([
        ("temperature_form", flat(used.in_state(), &[response])),
        (
            "temperature_form, tangent",
            rows_of(used.in_state(), &none, &tangent),
        ),
        ("temperature_form_response", flat(used.in_state(), &[alone])),
    ]);
    all
}

/// Elements that are evaluated together, at both states in turn, have the bits of one.
fn assert_same_together<M: FreeEnergy<f64>>(model: &M, at: &At) {
    let Some(together) = model.together() else {
        return;
    };
    let (used, all) = (Used::of(model), |_| true);
    let states = [&at.x0, &at.x1].map(|x| array::<M::Variables>(used.in_state(), x));
    let corners: M::Corners = array(used.in_corners(), &at.corners);
    let last = M::Variables::LEN - 1;
    for count in [1, together.least(), MOST_TOGETHER - 1, MOST_TOGETHER] {
        let x0: Vec<_> = (0..count).map(|element| states[1 - element % 2]).collect();
        let x1: Vec<_> = (0..count).map(|element| states[element % 2]).collect();
        let corners_of_each = vec![corners; count];
        for form in [ExactForm::Temperature, ExactForm::Entropy] {
            let length = match form {
                ExactForm::Temperature => M::TemperatureFormOld::LEN,
                ExactForm::Entropy => M::EntropyFormOld::LEN,
            };
            let mut kept = vec![vec![0.0; length]; count];
            let mut places: Vec<_> = kept.iter_mut().map(|kept| &mut kept[..]).collect();
            together.keep(form, &x0, &mut places);
            let kept: Vec<_> = kept.iter().map(|kept| &kept[..]).collect();
            let steps = Steps {
                kept: &kept,
                x1: &x1,
                corners: &corners_of_each,
            };
            let none = (
                M::Response::filled(0.0),
                M::Tangent::filled(M::Variables::filled(0.0)),
            );
            let mut forms = vec![none; count];
            together.form(form, steps, &mut forms);
            let mut responses = vec![none.0; count];
            together.response(form, steps, &mut responses);
            let mut mixed = vec![[corners; 2]; count];
            if form == ExactForm::Entropy {
                together.mixed_states(steps, &mut mixed);
            }
            for element in 0..count {
                let (x0, x1) = (&x0[element], &x1[element]);
                let one = if form == ExactForm::Temperature {
                    model.temperature_form(&model.temperature_form_old(x0), x1)
                } else {
                    let old = model.entropy_form_old(x0);
                    if model.is_thermal() {
                        let one = model.mixed_states(x0, &old, x1, &corners);
                        assert_eq!(flat(all, &mixed[element]), flat(all, &one));
                    }
                    model.entropy_form(&old, x1, &corners)
                };
                let (response, tangent) = &forms[element];
                assert_eq!(
                    rows_of(all, response, tangent),
                    rows_of(all, &one.0, &one.1)
                );
                assert_eq!(flat(all, &[responses[element]]), flat(all, &[one.0]));
            }
        }
        let theta: Vec<_> = x1.iter().map(|x| x[last]).collect();
        let one = model.viscosity(theta[0]);
        let mut viscosities = vec![one; count];
        together.viscosity(&theta, &mut viscosities);
        for (&theta, (eta, slope)) in theta.iter().zip(&viscosities) {
            let one = model.viscosity(theta);
            assert_eq!(flat(all, &[*eta, *slope]), flat(all, &[one.0, one.1]));
        }
        if model.is_thermal() {
            let caloric_of = |x: &M::Variables| model.caloric_at(*x)(x[last]);
            let mut found = vec![caloric_of(&x0[0]); count];
            together.caloric_at(&x1, &mut found);
            let numbers = |(c, psi): &(eem::Caloric<f64>, f64)| {
                bits([c.entropy, c.heat_capacity, c.magnitude, *psi])
            };
            for (x, found) in x1.iter().zip(&found) {
                assert_eq!(numbers(found), numbers(&caloric_of(x)));
            }
        }
    }
}

macro_rules! shapes {
    ($($shape:ty),* $(,)?) => {
        /// The same of a law, whatever its shape is.
        fn of_law(law: &Law, at: &At) -> Results {
            $(
                let model: Result<$shape, _> = law.model();
                if let Ok(model) = model {
                    assert_same_together(&model, at);
                    return everything(&model, at);
                }
            )*
            panic!("{law:?} has no shape")
        }
    };
}

shapes! {
    Spring0,
    ThermalSpring0,
    ThermalSpring1,
    DampedSpring,
    Spring8,
    solid!(strains: 2),
    solid!(strains: 3),
    solid!(strains: 2, temperature: 1),
    solid!(strains: 3, temperature: 1),
    solid!(strains: 4, temperature: 1),
    solid!(strains: 2, dashpots: 2, temperature: 1),
    solid!(strains: 2, invariants: 3, volume_flow: 1, dashpots: 1, temperature: 1),
}

/// The same of a material behind a table, if it fits, or fits with room.
fn behind_table<M: Material, A: Arrays>(model: &M, at: &At) -> Option<Results> {
    let model = model.duplicate();
    let tabled = if Tabled::<A>::is_for::<M>() {
        Tabled::<A>::new::<_, [f64; 1]>(model)
    } else if Tabled::<A>::has_room_for::<M>() {
        Tabled::<A>::with_room::<_, [f64; 1]>(model)
    } else {
        return None;
    };
    assert!((*tabled).as_any().is::<M>());
    Some(everything(&Behind(tabled.duplicate()), at))
}

/// The same behind each table, with room for what forms keep of the old state, and without.
pub(crate) fn behind_tables<M: Material>(model: &M, at: &At) -> Vec<Results> {
    let all = [
        behind_table::<M, SpringArrays<1, 0, 0, 0, 1, 8>>,
        behind_table::<M, SpringArrays<1, 0, 0, 0, 1, 1>>,
        behind_table::<M, SpringArrays<2, 0, 0, 2, 3, 24>>,
        behind_table::<M, SpringArrays<2, 0, 0, 2, 3, 2>>,
        behind_table::<M, SpringArrays<3, 1, 0, 4, 4, 40>>,
        behind_table::<M, SpringArrays<3, 1, 0, 4, 4, 3>>,
        behind_table::<M, SpringArrays<4, 2, 1, 6, 5, 32>>,
        behind_table::<M, SpringArrays<10, 8, 1, 18, 11, 32>>,
    ];
    all.iter()
        .filter_map(|behind_table| behind_table(model, at))
        .collect()
}

/// The explicit scheme and users call them of the material.
const NOT_IN_TABLE: &[&str] = &[
    "internal_energy",
    "rates",
    "rates_at",
    "rates_at, s and psi",
    "gradient_adjoint",
];

#[test]
fn materials_of_texts_and_behind_tables_have_the_bits_of_derived_ones() {
    let (mut laws, mut tables) = (0, 0);
    for specimen in families::all() {
        let text = specimen.text();
        let mut source = Source::new(text.free_energy);
        for &(dashpot, viscosity) in text.viscosities {
            source = source.viscosity(dashpot, viscosity);
        }
        for (name, _) in &text.values {
            source = source.parameter(*name, None);
        }
        let compiled = compile(&source).unwrap_or_else(|faults| panic!("{faults}"));
        let law = Law::new(compiled, &text.values).unwrap();
        for step in states::steps(&*specimen) {
            let corners = states::corners(&*specimen, &step[0], &step[1]);
            let [x0, x1] = step;
            let corners = corners.iter().map(|corner| corner.theta).collect();
            let at = At { x0, x1, corners };
            let derived = specimen.everything(&at);
            let name = specimen.name();
            for ((function, derived), typed) in derived.iter().zip(of_law(&law, &at)) {
                assert_eq!(
                    (*function, derived),
                    (typed.0, &typed.1),
                    "{name}, {function} at {at:?}"
                );
            }
            let in_table: Vec<_> = (derived.into_iter())
                .filter(|(function, _)| !NOT_IN_TABLE.contains(function))
                .collect();
            for mut tabled in specimen.behind_tables(&at) {
                tabled.retain(|(function, _)| !NOT_IN_TABLE.contains(function));
                assert_eq!(in_table, tabled, "{name} behind a table at {at:?}");
                tables += 1;
            }
        }
        laws += 1;
    }
    assert!(laws > 50, "{laws} laws");
    assert!(tables > 2 * laws, "{tables} steps behind tables");
}
