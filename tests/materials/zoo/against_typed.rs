//! Materials of texts against derived ones: every function has the same bits.

use eem::typed::{
    DampedSpring0, DampedSpring1, DampedThermalSpring0, DampedThermalSpring1, Law, Source, Spring0,
    Spring1, Spring2, Spring3, ThermalSpring0, ThermalSpring1, ThermalSpring2, ThermalSpring3,
    compile, solid,
};
use eem::{Array, FreeEnergy};
use eem_material::free_energy::{Form, FormRows};

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

fn array<A: Array<f64>>(numbers: &[f64]) -> A {
    let mut array = A::filled(0.0);
    for (entry, &number) in array.as_mut().iter_mut().zip(numbers) {
        *entry = number;
    }
    array
}

/// All NaN are one.
fn bits(numbers: impl IntoIterator<Item = f64>) -> Vec<u64> {
    let bits = |number: f64| match number {
        number if number.is_nan() => f64::NAN.to_bits(),
        number => number.to_bits(),
    };
    numbers.into_iter().map(bits).collect()
}

fn rows_of<F: Array<f64>, V: Array<f64>, M: Array<V>>(first: &F, matrix: &M) -> Vec<u64> {
    let rows = matrix.as_ref().iter().flat_map(AsRef::as_ref);
    bits(first.as_ref().iter().chain(rows).copied())
}

fn flat<A: Array<f64>>(arrays: &[A]) -> Vec<u64> {
    bits(arrays.iter().flat_map(AsRef::as_ref).copied())
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
    assert!(M::HAS_PARAMETER_DERIVATIVES);
    let [x0, x1] = [&at.x0, &at.x1].map(|x| array::<M::Variables>(x));
    let corners: M::Corners = array(&at.corners);
    let count = model.parameter_names().len();
    assert_eq!(count, model.parameter_count());
    let seed: Vec<f64> = (0..64_u8)
        .map(|k| eem::Scalar::sin(1.0 + 2.0 * f64::from(k)))
        .collect();
    let own = |found: M::Parameters| bits(found.as_ref()[..count].iter().copied());
    let (weights, along) = (array(&seed), array(&seed));
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
            flat(&[model.temperature_form_tangent(&x0, &x1, &along)]),
        ),
        (
            "entropy_form_adjoint",
            own(model.entropy_form_adjoint(&x0, &x1, &corners, &weights)),
        ),
        (
            "entropy_form_tangent",
            flat(&[model.entropy_form_tangent(&x0, &x1, &corners, &along)]),
        ),
        (
            "gradient_adjoint",
            own(model.gradient_adjoint(&x1, &array(&seed))),
        ),
        ("energy_by_parameters", own(model.energy_by_parameters(&x1))),
        (
            "viscosity_adjoint",
            own(model.viscosity_adjoint(theta, &array(&seed))),
        ),
        (
            "drag_adjoint",
            own(model.drag_adjoint(theta, &array(&seed))),
        ),
    ]
}

fn of_state<M: FreeEnergy<f64>>(model: &M, at: &At) -> Results {
    let [x0, x1] = [&at.x0, &at.x1].map(|x| array::<M::Variables>(x));
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
        ("gradient", flat(&[model.gradient(&x1)])),
        ("hessian", rows_of(&gradient, &hessian)),
        ("caloric", bits(caloric(model.caloric(&x1)))),
        ("rates", flat(&[rates.forces, rates.slopes])),
        ("rates_at", flat(&[rates_at.forces, rates_at.slopes])),
        ("rates_at, s and psi", bits(others)),
        (
            "entropy_hessian",
            rows_of(&none, &model.entropy_hessian(&x1)),
        ),
        ("viscosity", flat(&[viscosities, viscosity_slopes])),
        ("drag", flat(&[drag, drag_slope])),
        (
            "has_constant_capacity",
            vec![u64::from(model.has_constant_capacity())],
        ),
    ];
    if M::THERMAL {
        for new in 0..=last {
            let (found, psi) = model.caloric_between(&x0, &x1, new)(theta);
            let found = caloric(found).into_iter().chain([psi]);
            all.push(("caloric_between", bits(found)));
        }
    }
    all
}

fn of_step<M: FreeEnergy<f64>>(model: &M, at: &At) -> Results {
    let [x0, x1] = [&at.x0, &at.x1].map(|x| array::<M::Variables>(x));
    let (corners, none): (M::Corners, _) = (array(&at.corners), M::Variables::filled(0.0));
    let old = model.entropy_form_old(&x0);
    let (response, tangent) = model.entropy_form(&old, &x1, &corners);
    let alone = model.entropy_form_response(&old, &x1, &corners);
    let mut all = vec![
        ("entropy_form", flat(&[response])),
        ("entropy_form, tangent", rows_of(&none, &tangent)),
        ("entropy_form_response", flat(&[alone])),
    ];
    if M::THERMAL {
        let mixed = model.mixed_states(&x0, &old, &x1, &corners);
        all.push(("mixed_states", flat(&mixed)));
    }
    let old = model.temperature_form_old(&x0);
    let (response, tangent) = model.temperature_form(&old, &x1);
    let alone = model.temperature_form_response(&old, &x1);
    all.extend([
        ("temperature_form", flat(&[response])),
        ("temperature_form, tangent", rows_of(&none, &tangent)),
        ("temperature_form_response", flat(&[alone])),
    ]);
    all
}

/// The same of a form, whose values are `forms`; returns what it keeps.
fn assert_same_form_in_rows<M: FreeEnergy<f64>, Old: Copy, P>(
    (model, memory, old): (&M, &P, Old),
    states: &[M::Variables; 2],
    rows: &FormRows<f64, M, Old, P>,
    forms: &[Form<f64, M>; 2],
    count: usize,
) -> Vec<Old> {
    let mut kept = vec![old; count];
    let each = |element| (model, &states[1 - element % 2]);
    (rows.old)(&each, &mut kept);
    let each = |element: usize| (model, &kept[element], &states[element % 2], memory);
    let mut of_rows = vec![forms[0]; count];
    (rows.form)(&each, &mut of_rows);
    let mut responses = vec![forms[0].0; count];
    (rows.response)(&each, &mut responses);
    for (element, (response, tangent)) in of_rows.iter().enumerate() {
        let form = &forms[element % 2];
        assert_eq!(rows_of(response, tangent), rows_of(&form.0, &form.1));
        assert_eq!(flat(&[responses[element]]), flat(&[form.0]));
    }
    kept
}

/// Elements that are evaluated together, at both states in turn, have the bits of one.
fn assert_same_in_rows<M: FreeEnergy<f64>>(model: &M, at: &At) {
    let Some(rows) = M::ROWS else {
        return;
    };
    let states = [&at.x0, &at.x1].map(|x| array::<M::Variables>(x));
    let corners: M::Corners = array(&at.corners);
    let last = M::Variables::LEN - 1;
    for count in [1, rows.most / 4, rows.most, 2 * rows.most + 1] {
        let old = states.map(|x0| model.temperature_form_old(&x0));
        let forms = [0, 1].map(|new| model.temperature_form(&old[1 - new], &states[new]));
        assert_same_form_in_rows(
            (model, &(), old[0]),
            &states,
            &rows.temperature_form,
            &forms,
            count,
        );
        let old = states.map(|x0| model.entropy_form_old(&x0));
        let forms = [0, 1].map(|new| model.entropy_form(&old[1 - new], &states[new], &corners));
        let with_corners = (model, &corners, old[0]);
        let kept =
            assert_same_form_in_rows(with_corners, &states, &rows.entropy_form, &forms, count);
        let here = |element: usize| element % 2;
        if M::THERMAL {
            let mixed = [0, 1].map(|new| {
                model.mixed_states(&states[1 - new], &old[1 - new], &states[new], &corners)
            });
            let mut found = vec![mixed[1]; count];
            let each = |element: usize| (model, &kept[element], &states[here(element)], &corners);
            (rows.mixed_states)(&each, &mut found);
            for (element, found) in found.iter().enumerate() {
                assert_eq!(flat(found), flat(&mixed[here(element)]));
            }
        }
        let viscosities = states.map(|x| model.viscosity(x[last]));
        let mut of_rows = vec![viscosities[0]; count];
        let each = |element| (model, &states[here(element)][last]);
        (rows.viscosity)(&each, &mut of_rows);
        for (element, (eta, slope)) in of_rows.iter().enumerate() {
            let one = &viscosities[here(element)];
            assert_eq!(flat(&[*eta, *slope]), flat(&[one.0, one.1]));
        }
        if M::THERMAL {
            let caloric = states.map(|x| model.caloric_at(x)(x[last]));
            let mut of_rows = vec![caloric[1]; count];
            let each = |element| (model, &states[here(element)]);
            (rows.caloric_at)(&each, &mut of_rows);
            let numbers = |(c, psi): &(eem::Caloric<f64>, f64)| {
                bits([c.entropy, c.heat_capacity, c.magnitude, *psi])
            };
            for (element, found) in of_rows.iter().enumerate() {
                assert_eq!(numbers(found), numbers(&caloric[here(element)]));
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
                    assert_same_in_rows(&model, at);
                    return everything(&model, at);
                }
            )*
            panic!("{law:?} has no shape")
        }
    };
}

shapes! {
    Spring0, Spring1, Spring2, Spring3,
    ThermalSpring0, ThermalSpring1, ThermalSpring2, ThermalSpring3,
    DampedSpring0, DampedSpring1, DampedThermalSpring0, DampedThermalSpring1,
    solid!(strains: 2),
    solid!(strains: 3),
    solid!(strains: 2, temperature: 1),
    solid!(strains: 3, temperature: 1),
    solid!(strains: 4, temperature: 1),
    solid!(strains: 2, dashpots: 2, temperature: 1),
    solid!(strains: 2, invariants: 3, volume_flow: 1, dashpots: 1, temperature: 1),
}

#[test]
fn materials_of_texts_have_the_bits_of_derived_ones() {
    let mut laws = 0;
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
        }
        laws += 1;
    }
    assert!(laws > 50, "{laws} laws");
}
