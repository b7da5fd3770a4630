//! Springs of texts against derived ones: every function has the same bits, in `f64` and in `f32`.

use eem::typed::{Law, Source, Typed, compile};
use eem::{Array, FreeEnergy, Real};

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

fn array<S: Real, A: Array<S>>(numbers: &[f64]) -> A {
    let mut array = A::filled(S::zero());
    for (entry, &number) in array.as_mut().iter_mut().zip(numbers) {
        *entry = S::from_f64(number);
    }
    array
}

/// All NaN are one.
fn bits<S: Real>(numbers: impl IntoIterator<Item = S>) -> Vec<u64> {
    let bits = |number: S| match number.to_f64() {
        number if number.is_nan() => f64::NAN.to_bits(),
        number => number.to_bits(),
    };
    numbers.into_iter().map(bits).collect()
}

fn rows<S: Real, V: Array<S>, M: Array<V>>(first: &V, matrix: &M) -> Vec<u64> {
    let rows = matrix.as_ref().iter().flat_map(AsRef::as_ref);
    bits(first.as_ref().iter().chain(rows).copied())
}

fn flat<S: Real, A: Array<S>>(arrays: &[A]) -> Vec<u64> {
    bits(arrays.iter().flat_map(AsRef::as_ref).copied())
}

/// Everything that a free energy computes, at the new state and between both.
pub(crate) fn everything<S: Real, M: FreeEnergy<S>>(model: &M, at: &At) -> Results {
    let mut all = of_state(model, at);
    all.extend(of_step(model, at));
    all
}

fn of_state<S: Real, M: FreeEnergy<S>>(model: &M, at: &At) -> Results {
    let [x0, x1] = [&at.x0, &at.x1].map(|x| array::<S, M::Variables>(x));
    let last = M::Variables::LEN - 1;
    let (theta, none) = (x1[last], M::Variables::filled(S::zero()));
    let caloric = |c: eem::Caloric<S>| [c.entropy, c.heat_capacity, c.magnitude];
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
        ("hessian", rows(&gradient, &hessian)),
        ("caloric", bits(caloric(model.caloric(&x1)))),
        ("rates", flat(&[rates.forces, rates.slopes])),
        ("rates_at", flat(&[rates_at.forces, rates_at.slopes])),
        ("rates_at, s and psi", bits(others)),
        ("entropy_hessian", rows(&none, &model.entropy_hessian(&x1))),
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

fn of_step<S: Real, M: FreeEnergy<S>>(model: &M, at: &At) -> Results {
    let [x0, x1] = [&at.x0, &at.x1].map(|x| array::<S, M::Variables>(x));
    let (corners, none): (M::Corners, _) = (array(&at.corners), M::Variables::filled(S::zero()));
    let old = model.entropy_form_old(&x0);
    let (response, tangent) = model.entropy_form(&old, &x1, &corners);
    let alone = model.entropy_form_response(&old, &x1, &corners);
    let mut all = vec![
        ("entropy_form", flat(&[response])),
        ("entropy_form, tangent", rows(&none, &tangent)),
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
        ("temperature_form, tangent", rows(&none, &tangent)),
        ("temperature_form_response", flat(&[alone])),
    ]);
    all
}

macro_rules! shapes {
    ($([$n:literal, $k:literal, $d:literal, $c:literal, $r:literal])*) => {
        /// The same of a law, whatever its shape is.
        fn of_law<S: Real>(law: &Law, at: &At) -> Results {
            $(
                if let Ok(model) = law.model::<S, $n, $k, $d, $c, $r>() {
                    return everything::<S, Typed<S, $n, $k, $d, $c, $r>>(&model, at);
                }
            )*
            panic!("{law:?} has no shape")
        }
    };
}

shapes! {
    [1, 0, 0, 0, 1] [2, 1, 0, 0, 2] [3, 2, 0, 0, 3] [4, 3, 0, 0, 4]
    [2, 0, 0, 2, 3] [3, 1, 0, 4, 4] [4, 2, 0, 6, 5] [5, 3, 0, 8, 6]
    [1, 0, 1, 0, 1] [2, 1, 1, 0, 2] [2, 0, 1, 2, 3] [3, 1, 1, 4, 4]
}

#[test]
fn springs_of_texts_have_the_bits_of_derived_ones() {
    let mut laws = 0;
    for specimen in families::all().into_iter().filter(|one| !one.is_solid()) {
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
            let [double, single] = specimen.everything(&at);
            let name = specimen.name();
            for ((function, derived), typed) in double.iter().zip(of_law::<f64>(&law, &at)) {
                assert_eq!(
                    (*function, derived),
                    (typed.0, &typed.1),
                    "{name}, {function} at {at:?}"
                );
            }
            for ((function, derived), typed) in single.iter().zip(of_law::<f32>(&law, &at)) {
                assert_eq!(
                    (*function, derived),
                    (typed.0, &typed.1),
                    "{name}, {function} of f32 at {at:?}"
                );
            }
        }
        laws += 1;
    }
    assert!(laws > 50, "{laws} laws");
}
