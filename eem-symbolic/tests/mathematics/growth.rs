//! Programs grow with the size of the formula, and not with the number of its paths.

use crate::growing::FAMILIES;

/// Operations per node may differ by this factor between a formula and one of three times its size:
/// all of them have what the first nodes lack, neighbours of every kind.
const NEARLY_LINEAR: f64 = 1.5;

#[test]
fn operations_grow_nearly_linearly() {
    for family in FAMILIES {
        let per_node = [8, 24].map(|count| {
            let model = (family.model)(count);
            let nodes = model.graph.size(model.psi);
            let programs = model.programs();
            let temperature = programs.temperature_form.as_ref().expect("a thermal law");
            let of = |program: &eem_symbolic::Program| program.operation_count().new.total();
            let operations = [
                &programs.energy_magnitude,
                &programs.hessian,
                temperature,
                &programs.entropy_form,
            ]
            .map(of);
            println!(
                "{:20} {nodes:5} nodes {operations:6?} operations",
                family.name
            );
            operations.map(|operations| ratio(operations, nodes))
        });
        for (small, large) in per_node[0].iter().zip(per_node[1]) {
            assert!(
                large <= NEARLY_LINEAR * small,
                "{}: {small:.1} operations per node become {large:.1}",
                family.name
            );
        }
    }
}

/// Derivatives of derivatives: each one is a formula of its own, and a program grows with it.
#[test]
fn repeated_derivatives_cost_what_their_formulas_are_worth() {
    let per_node = [2, 6].map(|order| {
        let model = crate::growing::derivative(order);
        let nodes = model.graph.size(model.psi);
        ratio(
            model.programs().entropy_form.operation_count().new.total(),
            nodes,
        )
    });
    assert!(per_node[1] <= 2.0 * per_node[0], "{per_node:?}");
}

#[expect(clippy::cast_precision_loss, reason = "small counts")]
fn ratio(operations: usize, nodes: usize) -> f64 {
    operations as f64 / nodes as f64
}
