//! Springs of texts run like derived ones: states, ledgers and certificates have the same bits.

mod solids;

use eem::prelude::*;
use eem::typed::{DampedSpring, Law, Source, Spring0, Spring8, ThermalSpring0, ThermalSpring1};

use eem_testkit::length::at_length;

use crate::kelvin_voigt::{BOTH, Isothermal};
use crate::support::dashpots::{ONE_DASHPOT, OneDashpot, ThreeDashpots};
use crate::support::{DoublePendulum, LogarithmicStiffness, ThermoViscoElastic};

/// A law whose parameters are these fields of a struct.
macro_rules! law {
    ($model:expr, $source:expr, [$($field:ident),*]) => {{
        let source = $source;
        $(let source = source.parameter(stringify!($field), None);)*
        let compiled = eem::typed::compile(&source).unwrap_or_else(|faults| panic!("{faults}"));
        eem::typed::Law::new(compiled, &[$((stringify!($field), $model.$field)),*]).unwrap()
    }};
}
use law;

fn thermo_visco_elastic(model: &ThermoViscoElastic) -> ThermalSpring1 {
    let source = Source::new(
        "|lambda: Stretch, gamma: Viscous, theta: Temperature| {
            let strain = ln(lambda / natural_length);
            let heating = theta - theta_ref;
            let elastic = 0.5 * (k0 - k1 * heating) * strain.powi(2)
                - coupling * heating * strain
                + capacity * (heating - theta * ln(theta / theta_ref));
            (1.0 + ratio) * elastic + (mu0 - mu1 * heating) * gamma.powi(2)
                - ratio * gamma * diff(elastic, lambda)
        }",
    )
    .viscosity("gamma", "eta0 * exp(a * (1.0 / theta - 1.0 / theta_ref))");
    let fields = law!(
        model,
        source,
        [
            k0,
            k1,
            ratio,
            coupling,
            capacity,
            mu0,
            mu1,
            eta0,
            a,
            natural_length,
            theta_ref
        ]
    );
    fields.named("ThermoViscoElastic").unwrap().model().unwrap()
}

/// The viscosity of [`OneDashpot`].
const CREEP: &str = "eta * exp(a * (1 / theta - 1 / theta_ref))";

fn one_dashpot(model: &OneDashpot) -> ThermalSpring1 {
    with_viscosity(model, CREEP)
}

fn with_viscosity(model: &OneDashpot, viscosity: &str) -> ThermalSpring1 {
    maxwell_damper(model, viscosity).model().unwrap()
}

fn maxwell_damper(model: &OneDashpot, viscosity: &str) -> Law {
    let source = Source::new(
        "|lambda: Stretch, gamma: Viscous, theta: Temperature| {
            let strain = ln(lambda / natural_length);
            0.5 * stiffness * strain.powi(2) - coupling * (theta - theta_ref) * strain
                + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
                + 0.5 * mu * (lambda - natural_length - gamma).powi(2)
        }",
    )
    .viscosity("gamma", viscosity);
    let fields = law!(
        model,
        source,
        [
            stiffness,
            coupling,
            capacity,
            natural_length,
            theta_ref,
            a,
            mu,
            eta
        ]
    );
    fields.named("MaxwellDamper").unwrap()
}

fn logarithmic_stiffness(model: &LogarithmicStiffness) -> ThermalSpring0 {
    let source = Source::new(
        "|lambda: Stretch, theta: Temperature| {
            let strain = ln(lambda / natural_length);
            let modulus = stiffness - softening * theta_ref * ln(theta / theta_ref);
            0.5 * modulus * strain.powi(2)
                - coupling * (theta - theta_ref) * strain
                + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
        }",
    );
    let fields = law!(
        model,
        source,
        [
            stiffness,
            softening,
            coupling,
            capacity,
            natural_length,
            theta_ref
        ]
    );
    fields
        .named("LogarithmicStiffness")
        .unwrap()
        .model()
        .unwrap()
}

/// A scene with its masses and springs.
type Built<const D: usize> = (Scene<D>, Vec<Node>, Vec<Element>);

/// A run with the handles of what is in it.
struct Running<const D: usize> {
    run: Simulation<D>,
    nodes: Vec<Node>,
    springs: Vec<Element>,
}

impl<const D: usize> Running<D> {
    fn new((scene, nodes, springs): &Built<D>, scheme: Scheme, step: f64) -> Self {
        Self {
            run: Simulation::new(scene.clone(), scheme, step).unwrap(),
            nodes: nodes.clone(),
            springs: springs.clone(),
        }
    }

    /// The certificate of a step with all digits, or why there is none.
    fn step(&mut self) -> Result<String, StepError> {
        let report = self.run.step()?;
        Ok(format!("{report:?}"))
    }

    /// The bits of the state, and the ledger with all digits.
    fn state(&self) -> (Vec<u64>, String) {
        let run = &self.run;
        let mut state = Vec::new();
        for &node in &self.nodes {
            for vector in [run.position(node), run.momentum(node)] {
                state.extend(vector.unwrap().iter().map(|number| number.to_bits()));
            }
        }
        for &spring in &self.springs {
            let stretches = (0..).map_while(|k| run.viscous_stretch(spring, k).ok());
            let numbers = [run.temperature(spring), run.entropy(spring)];
            let numbers = numbers.into_iter().flatten().chain(stretches);
            state.extend(numbers.chain(run.force(spring)).map(f64::to_bits));
            if let Ok(strain) = run.viscous_strain(spring) {
                state.extend(strain.iter().map(|number| number.to_bits()));
            }
        }
        (state, format!("{:?}", run.ledger()))
    }
}

/// All of a spring.
fn schemes() -> impl Iterator<Item = Scheme> {
    Scheme::ALL.into_iter().chain([Scheme::Auto])
}

/// Runs both scenes with these schemes: reports, ledgers and states agree after each step.
fn assert_same_bits<const D: usize>(
    [derived, typed]: [&Built<D>; 2],
    schemes: impl IntoIterator<Item = Scheme>,
    (steps, step): (usize, f64),
) {
    for scheme in schemes {
        let name = scheme.name();
        // The explicit scheme is stable only in short steps.
        let step = step
            * if scheme == Scheme::EemExplicit {
                0.1
            } else {
                1.0
            };
        let mut derived = Running::new(derived, scheme, step);
        let mut typed = Running::new(typed, scheme, step);
        for index in 0..steps {
            let reports = [derived.step(), typed.step()].map(Result::unwrap);
            assert_eq!(reports[0], reports[1], "{name}, step {index}");
            assert_eq!(derived.state(), typed.state(), "{name}, step {index}");
        }
    }
}

/// The single pendulum, with a spring of any material.
fn single<M: eem::Material>(model: M) -> Built<2> {
    let mut scene = Scene::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [3.0, 0.0], [0.0, 1.0]);
    let spring = scene.spring(model, [pivot, bob]);
    scene.set_temperature(spring, 380.0);
    let air = scene.reservoir(300.0);
    scene.conduct(spring, air, 10.0);
    (scene, vec![bob], vec![spring])
}

#[test]
fn a_pendulum_of_texts_has_the_bits_of_the_derived_one() {
    let model = ThermoViscoElastic::PENDULUM;
    let typed = single(thermo_visco_elastic(&model));
    assert_same_bits(
        [&single(model), &typed],
        schemes(),
        (at_length(1_000, 150), 0.01),
    );
}

#[test]
fn double_pendulums_of_texts_have_the_bits_of_derived_ones() {
    for pendulum in DoublePendulum::ALL {
        let (scene, nodes, springs) = pendulum.scene();
        let derived = (scene, nodes.to_vec(), springs.to_vec());
        let (scene, nodes, springs) = pendulum.scene_of(|model| logarithmic_stiffness(&model));
        let typed = (scene, nodes.to_vec(), springs.to_vec());
        assert_same_bits(
            [&derived, &typed],
            schemes(),
            (at_length(200, 30), pendulum.step),
        );
    }
}

/// Three dashpots, where the type of the text has room for eight.
fn three_dashpots(model: &ThreeDashpots) -> Law {
    let mut source = Source::new(
        "|lambda: Stretch, gamma1: Viscous, gamma2: Viscous, gamma3: Viscous, theta: Temperature| {
            let strain = ln(lambda / natural_length);
            let extension = lambda - natural_length;
            0.5 * stiffness * strain.powi(2) - coupling * (theta - theta_ref) * strain
                + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
                + 0.5 * mu1 * (extension - gamma1).powi(2) + 0.5 * mu2 * (extension - gamma2).powi(2)
                + 0.5 * mu3 * (extension - gamma3).powi(2)
        }",
    );
    for k in 1..=3 {
        let viscosity = format!("eta{k} * exp(a * (1 / theta - 1 / theta_ref))");
        source = source.viscosity(format!("gamma{k}"), viscosity);
    }
    law!(
        model,
        source,
        [
            stiffness,
            coupling,
            capacity,
            natural_length,
            theta_ref,
            a,
            mu1,
            eta1,
            mu2,
            eta2,
            mu3,
            eta3
        ]
    )
    .named("ThreeDashpots")
    .unwrap()
}

#[test]
fn a_spring_with_room_for_more_dashpots_has_the_bits_of_the_derived_one() {
    let model = ThreeDashpots::DATA;
    let typed: Spring8 = three_dashpots(&model).model().unwrap();
    let steps = (at_length(200, 30), 0.02);
    assert_same_bits([&single(model), &single(typed)], schemes(), steps);
}

#[test]
fn a_spring_of_a_larger_type_than_it_needs_has_the_same_bits() {
    let law = maxwell_damper(&ONE_DASHPOT, CREEP);
    let steps = (at_length(100, 30), 0.02);
    let own = single::<ThermalSpring1>(law.model().unwrap());
    let few = single::<DampedSpring>(law.model().unwrap());
    let many = single::<Spring8>(law.model().unwrap());
    for larger in [&few, &many] {
        assert_same_bits([&own, larger], schemes(), steps);
    }
    let smaller: Result<DampedSpring, _> = three_dashpots(&ThreeDashpots::DATA).model();
    assert!(smaller.is_err());
}

/// The same of dashpots in parallel, one of them in a spring without temperature.
#[test]
fn springs_with_a_dashpot_beside_have_the_bits_of_derived_ones() {
    // Some schemes have no dashpots in parallel.
    let schemes_of = |built: &Built<2>| {
        let scene = built.0.clone();
        schemes().filter(move |&scheme| Simulation::new(scene.clone(), scheme, 0.02).is_ok())
    };
    let steps = (at_length(200, 30), 0.02);
    let source = Source::new(
        "|lambda: Stretch, gamma: Viscous, theta: Temperature| {
            let strain = ln(lambda);
            0.5 * k * strain.powi(2) + 0.5 * branch * (strain - gamma).powi(2)
                - beta * (theta - theta_ref) * strain
                + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
        }",
    )
    .viscosity("gamma", "slow * theta_ref / theta")
    .viscosity("lambda", "fast * (theta_ref / theta).powf(1.5)");
    let law = law!(
        BOTH,
        source,
        [k, branch, beta, capacity, theta_ref, slow, fast]
    );
    let typed: DampedSpring = law.named("Both").unwrap().model().unwrap();
    let derived = single(BOTH);
    assert_same_bits([&derived, &single(typed)], schemes_of(&derived), steps);

    let swinging = |add: &dyn Fn(&mut Scene<2>, [Node; 2]) -> Element| {
        let mut scene = Scene::new();
        let ends = [
            scene.anchor([0.0, 0.0]),
            scene.mass(1.0, [1.3, 0.0], [0.0, 1.0]),
        ];
        let spring = add(&mut scene, ends);
        (scene, vec![ends[1]], vec![spring])
    };
    let model = Isothermal { k: 40.0, eta: 0.7 };
    let source =
        Source::new("|lambda: Stretch| 0.5 * k * (lambda - 1).powi(2)").viscosity("lambda", "eta");
    let law = law!(model, source, [k, eta]).named("Isothermal").unwrap();
    let derived = swinging(&|scene, ends| scene.spring(model.clone(), ends));
    let typed = swinging(&|scene, ends| scene.spring::<DampedSpring>(law.model().unwrap(), ends));
    assert_same_bits([&derived, &typed], schemes_of(&derived), steps);
}

#[test]
fn a_spring_without_a_dashpot_in_series_is_restored() {
    let warm = "|lambda: Stretch, theta: Temperature| {
        20 * (lambda - 1).powi(2) - 0.1 * (theta - 300) * (lambda - 1)
            + 2 * (theta - 300 - theta * ln(theta / 300))
    }";
    let cold = "|lambda: Stretch| 20 * (lambda - 1).powi(2)";
    let material = |text: &str| {
        let compiled = eem::typed::compile(&Source::new(text)).unwrap();
        Law::new(compiled, &[]).unwrap()
    };
    let restored = |scene: &Scene<2>| {
        for scheme in schemes() {
            let [mut first, mut again] =
                [(); 2].map(|()| Simulation::new(scene.clone(), scheme, 0.02).unwrap());
            first.step().unwrap();
            again.restore(&first.checkpoint()).unwrap();
            first.step().unwrap();
            again.step().unwrap();
            let states = [first, again].map(|run| format!("{:?}", run.checkpoint()));
            assert!(states[0] == states[1], "{scheme}");
        }
    };
    let warm: ThermalSpring0 = material(warm).model().unwrap();
    restored(&single(warm).0);
    let cold: Spring0 = material(cold).model().unwrap();
    let mut scene = Scene::new();
    let ends = [
        scene.anchor([0.0, 0.0]),
        scene.mass(1.0, [1.3, 0.0], [0.0, 1.0]),
    ];
    scene.spring(cold, ends);
    restored(&scene);
}

/// Springs of materials A, B, A at one mass, whose sums depend on the order of the groups.
fn three<A: eem::Material, B: eem::Material>(a: impl Fn() -> A, b: impl Fn() -> B) -> Built<2> {
    let mut scene = Scene::new();
    let bob = scene.mass(1.0, [0.3, 0.2], [0.4, 1.0]);
    let anchors = [[1.1, 0.0], [-0.7, 0.4], [0.1, -1.3]];
    let anchors = anchors.map(|position| scene.anchor(position));
    let springs = vec![
        scene.spring(a(), [anchors[0], bob]),
        scene.spring(b(), [anchors[1], bob]),
        scene.spring(a(), [anchors[2], bob]),
    ];
    for (&spring, temperature) in springs.iter().zip([380.0, 310.0, 290.0]) {
        scene.set_temperature(spring, temperature);
    }
    scene.conduct(springs[0], springs[1], 3.0);
    (scene, vec![bob], springs)
}

#[test]
fn two_laws_of_one_shape_are_two_materials() {
    let (a, b) = (ThermoViscoElastic::PENDULUM, ONE_DASHPOT);
    let derived = three(|| a.clone(), || b.clone());
    let typed = three(|| thermo_visco_elastic(&a), || one_dashpot(&b));
    assert_same_bits([&derived, &typed], schemes(), (at_length(200, 50), 0.02));
}

/// A chain of more springs than are evaluated at a time: of one law, of the same texts with other values, and in turn. Some
/// conduct heat to each other, one to the air, and one has a thermostat.
fn chain<M: eem::Material>(model: impl Fn(&ThermoViscoElastic) -> M) -> Built<2> {
    let soft = ThermoViscoElastic::PENDULUM;
    let stiff = ThermoViscoElastic {
        k0: 2.0 * soft.k0,
        ..soft.clone()
    };
    let models = [model(&soft), model(&stiff)];
    let mut scene = Scene::new();
    let mut last = scene.anchor([0.0, 0.0]);
    let (mut nodes, mut springs) = (Vec::new(), Vec::<Element>::new());
    for (index, x) in (0_u8..80).map(|index| (usize::from(index), f64::from(index))) {
        let node = scene.mass(0.5, [1.1 * x + 1.2, (0.7 * x).sin()], [0.1 * x.cos(), 0.3]);
        let is_stiff = (40..50).contains(&index) || (index > 60 && index % 2 == 0);
        let spring = scene.spring(models[usize::from(is_stiff)].duplicate(), [last, node]);
        scene.set_temperature(spring, 300.0 + 10.0 * (0.3 * x).cos());
        if index % 3 == 1 {
            scene.conduct(springs[index - 1], spring, 2.0);
        }
        nodes.push(node);
        springs.push(spring);
        last = node;
    }
    let air = scene.reservoir(300.0);
    scene.conduct(springs[7], air, 5.0);
    scene.set_temperature(springs[50], 300.0);
    scene.prescribe_temperature(springs[50], |t| 300.0 + 5.0 * t);
    (scene, nodes, springs)
}

#[test]
fn springs_that_are_evaluated_together_have_the_bits_of_derived_ones() {
    let derived = chain(Clone::clone);
    let typed = chain(thermo_visco_elastic);
    assert_same_bits(
        [&derived, &typed],
        [Scheme::EemTemperature, Scheme::EemEntropy],
        (at_length(40, 5), 0.02),
    );
    assert_same_bits([&derived, &typed], schemes(), (2, 0.02));
    // Trials at which a spring has no mixed state, and a step that is refused for it.
    let [derived, typed] = [&derived, &typed].map(|built| {
        let mut running = Running::new(built, Scheme::EemEntropy, 0.4);
        let outcome = (0..3).try_for_each(|_| running.step().map(drop));
        (outcome.unwrap_err().to_string(), running.state())
    });
    assert_eq!(derived.0, typed.0);
    assert!(derived.1 == typed.1, "the states before the refusal");
}

/// With a dashpot beside and none in series there are no viscosities to be found.
#[test]
fn springs_with_a_dashpot_beside_are_evaluated_together() {
    let chain = |add: &dyn Fn(&mut Scene<2>, [Node; 2]) -> Element| {
        let mut scene = Scene::new();
        let mut last = scene.anchor([0.0, 0.0]);
        let (mut nodes, mut springs) = (Vec::new(), Vec::new());
        for x in (0_u8..40).map(f64::from) {
            let node = scene.mass(0.5, [1.1 * x + 1.2, (0.7 * x).sin()], [0.1 * x.cos(), 0.3]);
            springs.push(add(&mut scene, [last, node]));
            nodes.push(node);
            last = node;
        }
        (scene, nodes, springs)
    };
    let model = Isothermal { k: 40.0, eta: 0.7 };
    let source =
        Source::new("|lambda: Stretch| 0.5 * k * (lambda - 1).powi(2)").viscosity("lambda", "eta");
    let law = law!(model, source, [k, eta]).named("Isothermal").unwrap();
    let derived = chain(&|scene, ends| scene.spring(model.clone(), ends));
    let typed = chain(&|scene, ends| law.add_spring(scene, ends).unwrap());
    let schemes = [
        Scheme::EemTemperature,
        Scheme::EemEntropy,
        Scheme::EemDamped,
    ];
    assert_same_bits([&derived, &typed], schemes, (20, 0.02));
}

#[test]
fn a_checkpoint_belongs_to_its_law() {
    let at = |model: ThermalSpring1| Running::new(&single(model), Scheme::EemTemperature, 0.01);
    let mut first = at(one_dashpot(&ONE_DASHPOT));
    first.run.step().unwrap();
    let saved = first.run.checkpoint();
    first.run.step().unwrap();

    let mut again = at(one_dashpot(&ONE_DASHPOT));
    again.run.restore(&saved).unwrap();
    again.run.step().unwrap();
    assert_eq!(first.state(), again.state());

    let slower = OneDashpot {
        eta: 21.0,
        ..ONE_DASHPOT
    };
    // The same parameters with the same values in another formula.
    let other = with_viscosity(&ONE_DASHPOT, "eta * exp(a * (1 / theta - 1 / 310))");
    for other in [one_dashpot(&slower), other] {
        let refused = at(other).run.restore(&saved).unwrap_err();
        assert!(
            refused.to_string().contains("parameters of materials"),
            "{refused}"
        );
    }
}

#[test]
fn a_step_of_texts_allocates_nothing_after_the_first() {
    let scene = three(
        || thermo_visco_elastic(&ThermoViscoElastic::PENDULUM),
        || one_dashpot(&ONE_DASHPOT),
    );
    for scheme in Scheme::ALL {
        let mut running = Running::new(&scene, scheme, 0.01);
        running.run.step().unwrap();
        let counted = allocation_counter::measure(|| {
            for _ in 0..20 {
                running.run.step().unwrap();
            }
        });
        assert_eq!(counted.count_total, 0, "{}: {counted:?}", scheme.name());
    }
}
