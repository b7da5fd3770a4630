//! Tangents of runs against gradients.

use eem::prelude::*;
use eem::{Gradient, GradientError, History, Input, Objective};

use super::{FORMS, INPUTS, NAMES, objective, start};

/// Along a direction of all inputs the objective changes as its gradient says.
pub(super) fn assert_tangent<const D: usize>(
    what: &str,
    run: &mut Simulation<D>,
    gradient: &Gradient<D>,
    objective: &Objective<D>,
) {
    let [adjoint, tangent, size] = run.changes_along(gradient, objective).unwrap();
    let off = (adjoint - tangent).abs() / size;
    if std::env::var_os("SHOW").is_some() {
        println!("{what}: {adjoint} {tangent}, {off:e}");
    }
    assert!(off <= 1e-11, "{what}: {adjoint} {tangent}, {off:e}");
    run.check_gradient(gradient, objective).unwrap();
}

/// An input with the derivative of an objective by it.
type Pair = (Input<2>, f64);

/// Columns of a table against the gradient of the same quantity at the end.
fn assert_columns(run: &mut Simulation<2>, of: Quantity<2>, pairs: Vec<Pair>) {
    let (inputs, expected): (Vec<_>, Vec<_>) = pairs.into_iter().unzip();
    let table = run.sensitivities(&inputs, [("g", of)]).unwrap();
    for (at, expected) in expected.into_iter().enumerate() {
        let got = *table.of(0, at).unwrap().last().unwrap();
        let off = (got - expected).abs();
        let input = inputs[at].name();
        assert!(
            off <= 1e-11 * expected.abs().max(1e-3),
            "{input}: {got} {expected}"
        );
    }
}

#[test]
fn every_input_has_a_column() {
    for scheme in FORMS {
        let (net, mut run) = start(&INPUTS, scheme);
        let [anchor, bob, tail] = net.nodes;
        let [voigt, two] = net.springs;
        let of = || Quantity::Temperature(two);
        let gradient = run.gradient(&Objective::at_end(of())).unwrap();
        let mut pairs: Vec<Pair> = Vec::new();
        for (element, names) in [
            (voigt, &NAMES[..]),
            (two, &["stiffness", "a", "mu1", "eta1", "mu2", "eta2"]),
        ] {
            for &name in names {
                let by = gradient.by_parameter(element, name).unwrap();
                pairs.push((Input::parameter(element, name), by));
            }
            pairs.push((
                Input::temperature(element),
                gradient.by_temperature(element).unwrap(),
            ));
        }
        for axis in 0..2 {
            for node in [anchor, bob, tail] {
                let by = gradient.by_position(node).unwrap()[axis];
                pairs.push((Input::position(node, axis), by));
                let by = gradient.by_velocity(node).unwrap()[axis];
                pairs.push((Input::velocity(node, axis), by));
            }
            pairs.push((Input::gravity(axis), gradient.by_gravity()[axis]));
            let by = gradient.by_viscous_stretch(two, axis).unwrap();
            pairs.push((Input::viscous_stretch(two, axis), by));
            let path = net.paths[axis];
            pairs.push((
                Input::conductance(path),
                gradient.by_conductance(path).unwrap(),
            ));
            let mass = [bob, tail][axis];
            pairs.push((Input::mass(mass), gradient.by_mass(mass).unwrap()));
        }
        let air = gradient.by_reservoir_temperature(net.air).unwrap();
        pairs.push((Input::reservoir_temperature(net.air), air));
        let force = gradient.by_force(tail).unwrap();
        let by_phase = force.iter().map(|(t, by)| by[0] * t.cos()).sum();
        pairs.push((Input::force(tail, |t: f64| [t.cos(), 0.0]), by_phase));
        assert_columns(&mut run, of(), pairs);
    }
}

#[test]
fn tables_have_the_columns_of_a_recorder() {
    let (net, mut run) = start(&INPUTS, Scheme::EemEntropy);
    let [_, bob, tail] = net.nodes;
    let inputs = [
        Input::mass(bob),
        Input::force(tail, |_| [1.0, 0.0]).named("push", "N"),
    ];
    let quantities = || {
        [
            ("q", Quantity::Position(bob)),
            ("v", Quantity::Velocity(tail)),
        ]
    };
    let table = run.sensitivities(&inputs, quantities()).unwrap();
    let heads: Vec<String> = table.columns().iter().map(eem::Column::head).collect();
    let expected = [
        "time (s)",
        "q_x by mass of node 1 (m/kg)",
        "q_x by push (m/N)",
        "q_y by mass of node 1 (m/kg)",
        "q_y by push (m/N)",
        "v_x by mass of node 1 ((m/s)/kg)",
        "v_x by push ((m/s)/N)",
        "v_y by mass of node 1 ((m/s)/kg)",
        "v_y by push ((m/s)/N)",
    ];
    assert_eq!(heads, expected);
    assert_eq!(table.times().len(), 17);
    assert_eq!(table.column("v_y by push"), table.of(3, 1));
    assert!(table.of(3, 2).is_none() && table.of(4, 0).is_none());
    // Rows in the middle are ends of shorter runs.
    let before = run.checkpoint();
    let middle = Objective::at(0.2, Quantity::Velocity(tail)).component(1);
    let by = run.gradient(&middle).unwrap().by_mass(bob).unwrap();
    let row = table
        .times()
        .iter()
        .position(|t| (t - 0.2).abs() < 1e-12)
        .unwrap();
    let got = table.of(3, 0).unwrap()[row];
    assert!((got - by).abs() <= 1e-11 * by.abs(), "{got} {by}");
    assert_eq!(run.checkpoint(), before);
}

#[test]
fn tangents_have_the_same_bits_when_steps_are_made_again() {
    for scheme in FORMS {
        let table = |history| {
            let net = super::net(&INPUTS);
            let mut run = Simulation::new(net.scene.clone(), scheme, 0.025).unwrap();
            run.control_steps(Tolerance::new(1e-3)).unwrap();
            run.keep_history(history);
            run.run_until(0.4).unwrap();
            let before = run.checkpoint();
            let inputs = [Input::parameter(net.springs[0], "eta"), Input::gravity(1)];
            let table = run
                .sensitivities(&inputs, [("e", Quantity::TotalEnergy)])
                .unwrap();
            assert_eq!(run.checkpoint(), before);
            table
        };
        let all = table(History::default());
        assert!(all.times().len() > 20);
        for history in [
            History::snapshots(200),
            History::snapshots(12),
            History::bytes(12_000),
        ] {
            assert_eq!(table(history), all);
        }
    }
}

#[test]
fn a_gradient_of_something_else_disagrees() {
    let (net, mut run) = start(&INPUTS, Scheme::EemTemperature);
    let gradient = run.gradient(&objective(&net)).unwrap();
    run.check_gradient(&gradient, &objective(&net)).unwrap();
    let other =
        objective(&net) + Objective::at_end(Quantity::Temperature(net.springs[1])).times(1e-4);
    let error = run.check_gradient(&gradient, &other).unwrap_err();
    assert!(matches!(error, GradientError::Disagrees { .. }));
    let scene = crate::support::single_pendulum_scene().0;
    let mut small = Simulation::new(scene, Scheme::EemTemperature, 0.1).unwrap();
    small.keep_history(History::default());
    let energy = Objective::at_end(Quantity::TotalEnergy);
    let foreign = small.check_gradient(&gradient, &energy).unwrap_err();
    assert!(foreign.to_string().contains("another scene"), "{foreign}");
}

#[test]
fn inputs_that_are_not_there_are_errors() {
    let (net, mut run) = start(&INPUTS, Scheme::EemEntropy);
    let [anchor, bob, tail] = net.nodes;
    let [voigt, two] = net.springs;
    let foreign = crate::support::single_pendulum_scene().1;
    for (input, expected) in [
        (Input::parameter(voigt, "k"), "it has stiffness, coupling"),
        (Input::mass(foreign), "another scene"),
        (Input::gravity(2), "component 2"),
        (Input::position(bob, 3), "component 3"),
        (Input::viscous_stretch(two, 2), "component 2"),
        (Input::force(bob, |_| [1.0, 0.0]), "has no force"),
        (Input::thrust(bob, 0, |_| 1.0), "has no rocket 0"),
        (Input::motion(anchor, |_| [1.0, 0.0]), "is not moved"),
        (Input::thermostat(voigt, |_| 1.0), "has no thermostat"),
        (Input::oven(net.air, |_| 1.0), "is not an oven"),
    ] {
        let quantity = || Quantity::Position(tail);
        let error = run
            .sensitivities(&[input], [("q", quantity())])
            .unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
    }
    let none = run.sensitivities(&[Input::mass(bob)], [("n", Quantity::NewtonIterations)]);
    assert!(matches!(none, Err(GradientError::NoDerivative { .. })));
}

/// A text has places for more parameters than its own.
#[cfg(feature = "typed")]
#[test]
fn springs_of_texts_have_tangents_by_their_parameters() {
    let source = eem::typed::Source::new("|x: Stretch| 0.5 * k * (x - l).powi(2)");
    let compiled = eem::typed::compile(&source.parameter("k", None).parameter("l", None)).unwrap();
    let law = eem::typed::Law::new(compiled, &[("k", 4.0), ("l", 1.0)]).unwrap();
    for scheme in FORMS {
        let mut scene = Scene::<1>::new();
        let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.1], [0.0])];
        let model: eem::typed::Spring0 = law.model().unwrap();
        let spring = scene.spring(model, ends);
        let mut run = Simulation::new(scene, scheme, 0.01).unwrap();
        run.keep_history(History::default());
        run.run_until(1.0).unwrap();
        let end = Objective::at_end(Quantity::Position(ends[1]));
        let gradient = run.gradient(&end).unwrap();
        run.check_gradient(&gradient, &end).unwrap();
        let inputs = ["k", "l"].map(|name| Input::parameter(spring, name));
        let table = run.sensitivities(&inputs, [("q", Quantity::Position(ends[1]))]);
        let table = table.unwrap();
        // q = l + 0.1 cos(2t) with ω² = k/m, and at rest at l + 0.1
        for (at, exact) in [-0.1 * 2.0_f64.sin() / 4.0, 1.0 - 2.0_f64.cos()]
            .into_iter()
            .enumerate()
        {
            let got = *table.of(0, at).unwrap().last().unwrap();
            assert!((got - exact).abs() < 1e-3, "{got} {exact}");
        }
    }
}

/// And for more dashpots: even zeros have the signs of those of a derived spring.
#[cfg(feature = "typed")]
#[test]
fn gradients_of_texts_have_the_bits_of_derived_ones() {
    let (k, l, m1, m2, m3) = (30.0, 1.0, 12.0, 9.0, 7.0);
    let text = "|x: Stretch, g1: Viscous, g2: Viscous, g3: Viscous| {
        0.5 * k * ln(x / l).powi(2) + 0.5 * m1 * (x - l - g1).powi(2)
            + 0.5 * m2 * (x - l - g2 - g3).powi(2) + 0.5 * m3 * (g3 + 0.3 * g1).powi(2)
    }";
    let mut source = eem::typed::Source::new(text).viscosity("x", "0.7");
    for (dashpot, viscosity) in [("g1", "2"), ("g2", "3"), ("g3", "5")] {
        source = source.viscosity(dashpot, viscosity);
    }
    let values = [("k", k), ("l", l), ("m1", m1), ("m2", m2), ("m3", m3)];
    let source = (values.iter()).fold(source, |source, (name, _)| source.parameter(*name, None));
    let law = eem::typed::Law::new(eem::typed::compile(&source).unwrap(), &values).unwrap();
    let typed = || -> eem::typed::Spring8 { law.model().unwrap() };
    let derived = || Branches { k, l, m1, m2, m3 };
    for scheme in FORMS {
        let shown = [
            shown_gradient(scheme, derived),
            shown_gradient(scheme, typed),
        ];
        assert!(shown[0] == shown[1], "{scheme}: {shown:#?}");
    }
}

/// The derivatives of a position with respect to all viscous stretches and parameters, where one of two springs does not move.
#[cfg(feature = "typed")]
fn shown_gradient<M: eem::Material>(scheme: Scheme, model: impl Fn() -> M) -> String {
    let mut scene = Scene::<2>::new();
    let ends = [
        scene.anchor([0.0, 0.0]),
        scene.mass(1.0, [1.2, 0.1], [0.0, 0.5]),
        scene.anchor([0.9, 0.2]),
    ];
    let springs = [
        scene.spring(model(), [ends[0], ends[1]]),
        scene.spring(model(), [ends[0], ends[2]]),
    ];
    let mut run = Simulation::new(scene, scheme, 2.0).unwrap();
    run.keep_history(History::default());
    for _ in 0..3 {
        run.step().unwrap();
    }
    let end = Objective::at_end(Quantity::Position(ends[1]));
    let gradient = run.gradient(&end).unwrap();
    let by = |spring: Element| {
        let stretches = [0, 1, 2].map(|k| gradient.by_viscous_stretch(spring, k).unwrap());
        let names = ["k", "l", "m1", "m2", "m3"];
        let parameters = names.map(|name| gradient.by_parameter(spring, name).unwrap());
        format!("{stretches:?} {parameters:?}")
    };
    springs.map(by).join("\n")
}

/// There are derivatives by 64 at most.
#[cfg(feature = "typed")]
#[test]
fn a_text_with_many_parameters_has_no_tangents_by_them() {
    let terms: Vec<String> = (0..65).map(|n| format!("k{n} * (x - 1).powi(2)")).collect();
    let text = format!("|x: Stretch| {}", terms.join(" + "));
    let names: Vec<String> = (0..65).map(|n| format!("k{n}")).collect();
    let source = eem::typed::Source::new(&text);
    let source = (names.iter()).fold(source, |source, name| source.parameter(name, None));
    let values: Vec<(&str, f64)> = names.iter().map(|name| (name.as_str(), 0.1)).collect();
    let law = eem::typed::Law::new(eem::typed::compile(&source).unwrap(), &values).unwrap();
    let model: eem::typed::Spring0 = law.model().unwrap();
    let mut scene = Scene::<1>::new();
    let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.1], [0.0])];
    let spring = scene.spring(model, ends);
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.1).unwrap();
    run.keep_history(History::default());
    run.run_until(0.5).unwrap();
    let end = Objective::at_end(Quantity::Position(ends[1]));
    let gradient = run.gradient(&end).unwrap();
    run.check_gradient(&gradient, &end).unwrap();
    for name in ["k0", "k64"] {
        let by = Input::parameter(spring, name);
        let table = run.sensitivities(&[by], [("q", Quantity::Position(ends[1]))]);
        for error in [
            gradient.by_parameter(spring, name).unwrap_err(),
            table.unwrap_err(),
        ] {
            assert!(
                matches!(error, GradientError::NoParameterDerivatives { .. }),
                "{error}"
            );
        }
    }
}

#[test]
fn derivatives_have_names_and_units() {
    let (scene, bob, spring, air) = crate::support::single_pendulum_scene();
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.1).unwrap();
    run.keep_history(History::default());
    run.run_until(1.0).unwrap();
    let warm = Objective::at_end(Quantity::Temperature(spring));
    let gradient = run.gradient(&warm).unwrap();
    let shown = gradient.to_string();
    for (name, unit) in [("k0", "K/(N m)"), ("ratio", "K"), ("theta_ref", "1")] {
        let line = shown.lines().find(|line| {
            let start = format!("| {name} of element 0 (ThermoViscoElastic) ");
            line.starts_with(&start)
        });
        let last = line.unwrap().trim_end_matches([' ', '|']);
        assert!(last.ends_with(&format!("| {unit}")), "{last}");
    }
    let by = |name: &str| {
        let mut all = gradient.iter();
        all.find(|(own, ..)| own == name).unwrap()
    };
    let (_, value, unit) = by("temperature of reservoir 0");
    let expected = gradient.by_reservoir_temperature(air).unwrap();
    assert_eq!((value, unit.as_str()), (expected, "1"));
    let (_, value, unit) = by("velocity y of node 1");
    let expected = gradient.by_velocity(bob).unwrap()[1];
    assert_eq!((value, unit.as_str()), (expected, "K/(m/s)"));
    assert_eq!(by("mass of node 1").2, "K/kg");
    assert_eq!(
        by("viscous stretch 0 of element 0 (ThermoViscoElastic)").2,
        "K/m"
    );
    // Sums of different quantities have no unit, squares of misfits the unit 1.
    let mixed = run.gradient(&(warm + Objective::time())).unwrap();
    assert!(mixed.iter().all(|(.., unit)| unit.is_empty()));
    let misfit = Objective::misfit(Quantity::Temperature(spring), [[1.0, 350.0, 0.5]]);
    let misfit = run.gradient(&misfit).unwrap();
    assert!(misfit.iter().any(|(.., unit)| unit == "1/kg"));
}

/// Dashpots that pull at one another, and one in parallel.
#[cfg(feature = "typed")]
#[derive(FreeEnergy)]
#[free_energy(|x: Stretch, g1: Viscous, g2: Viscous, g3: Viscous| {
    0.5 * k * ln(x / l).powi(2) + 0.5 * m1 * (x - l - g1).powi(2)
        + 0.5 * m2 * (x - l - g2 - g3).powi(2) + 0.5 * m3 * (g3 + 0.3 * g1).powi(2)
})]
#[viscosity(x = 0.7, g1 = 2, g2 = 3, g3 = 5)]
struct Branches {
    k: f64,
    l: f64,
    m1: f64,
    m2: f64,
    m3: f64,
}
