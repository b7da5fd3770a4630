//! What is refused, and how: values, shapes and names of laws.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#![allow(clippy::float_cmp, reason = "the numbers are exact")]

use eem::FreeEnergy;
use eem::typed::{Compiled, Law, LawError, Source, Spring0, Spring8, compile, solid};

fn compiled(psi: &str, parameters: &[&str]) -> Compiled {
    let source = parameters.iter().fold(Source::new(psi), |source, name| {
        source.parameter(*name, None)
    });
    compile(&source).unwrap()
}

fn linear() -> Compiled {
    compiled(
        "|lambda: Stretch| 0.5 * k * (lambda - l).powi(2)",
        &["k", "l"],
    )
}

#[test]
fn every_parameter_has_one_finite_value() {
    let refused = |values: &[(&str, f64)]| Law::new(linear(), values).unwrap_err().to_string();
    let missing = "parameter `l` has no value: give each parameter one";
    assert_eq!(refused(&[("k", 1.0)]), missing);
    let unknown = "there is no parameter `m` for the value 3.0: there are `k`, `l`";
    assert_eq!(refused(&[("k", 1.0), ("l", 2.0), ("m", 3.0)]), unknown);
    let repeated = "parameter `k` has two values, 1.0 and 2.0: give one";
    assert_eq!(refused(&[("k", 1.0), ("k", 2.0), ("l", 2.0)]), repeated);
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let infinite = format!("parameter `k` is {value:?}, which is not finite: give a number");
        assert_eq!(refused(&[("k", value), ("l", 2.0)]), infinite);
    }
    let none = Law::new(
        compiled("|lambda: Stretch| lambda.powi(2)", &[]),
        &[("k", 1.0)],
    );
    let text = "there is no parameter `k` for the value 1.0: there are none";
    assert_eq!(none.unwrap_err().to_string(), text);
}

#[test]
fn values_belong_to_names_in_any_order() {
    let law = Law::new(linear(), &[("l", 2.0), ("k", 10.0)]).unwrap();
    assert_eq!(
        law.parameters().collect::<Vec<_>>(),
        [("k", 10.0), ("l", 2.0)]
    );
    let spring: Spring0 = law.model().unwrap();
    assert_eq!(spring.gradient(&[5.0]), [30.0]);
    assert_eq!([0, 1].map(|index| spring.parameter(index)), [10.0, 2.0]);
}

#[test]
fn parameters_that_no_formula_mentions_may_have_values() {
    let spare = || {
        compiled(
            "|lambda: Stretch| k[1] * k[0] * lambda.powi(2)",
            &["k[2]", "_m"],
        )
    };
    let law = Law::new(spare(), &[("k[0]", 1.0), ("k[1]", 2.0), ("_m", 3.0)]).unwrap();
    let values: Vec<_> = law.parameters().collect();
    assert_eq!(values, [("k[0]", 1.0), ("k[1]", 2.0)]);
    assert!(Law::new(spare(), &[("k[0]", 1.0), ("k[1]", 2.0)]).is_ok());
    for name in ["k[2]", "k[-1]", "k[", "l[0]", "k", "_n"] {
        let values = [("k[0]", 1.0), ("k[1]", 2.0), (name, 1.0)];
        let error = Law::new(spare(), &values).unwrap_err();
        assert!(matches!(error, LawError::Unknown { .. }), "{name}: {error}");
    }
}

#[test]
fn a_type_is_refused_to_laws_of_another_shape() {
    let psi = "|e1: StrainTrace, e2: StrainSquare, m3: ViscousStrain, m1: ViscousTrace| {
        e1.powi(2) + e2 - m3 + m1.powi(2)
    }";
    let source = Source::new(psi).viscosity("m3", "3").viscosity("m1", "4");
    let flowing = Law::new(compile(&source).unwrap(), &[]).unwrap();
    let right: Result<solid!(strains: 2, invariants: 2, volume_flow: 1), _> = flowing.model();
    assert!(right.is_ok());
    let of_law = "the law has 2 strains, 2 invariants of a viscous strain with a trace";
    let wrong: Result<solid!(strains: 2, invariants: 2), _> = flowing.model();
    let text = "the type of the material has 2 strains, 2 invariants of a viscous strain";
    assert_eq!(wrong.unwrap_err().to_string(), format!("{of_law}; {text}"));
    let wrong: Result<solid!(strains: 4, temperature: 1), _> = flowing.model();
    let text = "the type of the material has 4 strains, 1 temperature";
    assert_eq!(wrong.unwrap_err().to_string(), format!("{of_law}; {text}"));
    let wrong: Result<Spring8, _> = flowing.model();
    let text = "the type of the material has 1 stretch, at most 8 dashpots in series, at most 1 beside, at most 1 temperature";
    assert_eq!(wrong.unwrap_err().to_string(), format!("{of_law}; {text}"));
}

#[test]
fn names_are_kept_once_and_not_without_end() {
    let law = || Law::new(linear(), &[("k", 1.0), ("l", 1.0)]).unwrap();
    let [first, second] = [(); 2].map(|()| law().named("rubber").unwrap().name());
    assert!(core::ptr::eq(first, second));
    let long = law().named(&"ö".repeat(33)).unwrap_err();
    assert!(matches!(&long, LawError::Name { .. }), "{long}");
    let refused = (0..2_000).find_map(|index| law().named(&format!("law {index}")).err());
    let text = refused.unwrap().to_string();
    assert!(text.contains("has used 1024 other names"), "{text}");
    assert_eq!(law().named("rubber").unwrap().name(), "rubber");
}

#[test]
fn a_long_formula_is_refused_only_beyond_the_room_for_it() {
    let sum = |terms: usize| {
        let terms: Vec<_> = (1..=terms)
            .map(|i| format!("ln(1 + {i} * lambda)"))
            .collect();
        let source = Source::new(format!("|lambda: Stretch| {}", terms.join(" + ")));
        Law::new(compile(&source).unwrap(), &[]).unwrap()
    };
    let spring: Spring0 = sum(100).model().unwrap();
    let exact: f64 = (1..=100).map(|i| (1.0 + f64::from(i)).ln()).sum();
    assert!((spring.free_energy(&[1.0]) - exact).abs() < 100.0 * f64::EPSILON * exact);
}
