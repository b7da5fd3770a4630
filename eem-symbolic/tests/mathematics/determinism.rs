//! The same law gives the same programs, byte for byte.

use crate::support::laws::{self, Law, Text};

#[test]
fn two_builds_are_equal() {
    for (first, second) in crate::support::all_laws()
        .into_iter()
        .zip(crate::support::all_laws())
    {
        let [first, second] = [first, second].map(|law| {
            let programs = format!("{:?}", law.model.programs());
            (programs, format!("{:?}", law.model.formulas()))
        });
        assert_eq!(first, second);
    }
}

#[test]
fn a_model_is_not_changed_by_its_programs() {
    let law = laws::pendulum();
    let first = format!("{:?}", law.model.programs());
    assert_eq!(first, format!("{:?}", law.model.programs()));
}

/// A spring, with sums and products in some order.
fn spring(psi: &str) -> Law {
    Text {
        name: "spring",
        measures: &["lambda"],
        dashpots: &[],
        parameters: &[("k", 1.0), ("beta", 1.0), ("c", 1.0), ("lambda0", 1.0)],
        psi,
        viscosities: &[],
        state: &[1.0, 300.0],
    }
    .law()
}

#[test]
fn the_order_of_writing_does_not_matter() {
    let [first, second] = [
        "0.5*k*ln(lambda/lambda0)*ln(lambda/lambda0) - beta*theta*ln(lambda/lambda0) - c*theta*ln(theta)",
        "-(ln(theta)*theta*c) - ln(lambda/lambda0)*theta*beta + ln(lambda/lambda0)*ln(lambda/lambda0)*k*0.5",
    ]
    .map(|psi| spring(psi).model);
    assert_eq!(
        format!("{:?}", first.formulas()),
        format!("{:?}", second.formulas())
    );
    assert_eq!(
        format!("{:?}", first.programs()),
        format!("{:?}", second.programs())
    );
}
