//! Time from a free energy to its programs, by model and by size of the formula.
//!
//! This is nearly all that the derive does; `benches/README.md` of the workspace says how to measure
//! what it adds to `cargo check`.

#[path = "../eem-symbolic/tests/growing/mod.rs"]
mod growing;
#[allow(dead_code)] // Tests use more of it.
#[path = "../eem-symbolic/tests/support/laws.rs"]
mod laws;

use divan::{Bencher, black_box};
use eem_symbolic::{Model, Program, Programs};
use growing::{FAMILIES, Family};

/// Nodes of the formulas of growing size.
const NODES: [usize; 3] = [100, 300, 1000];

fn main() {
    for law in [laws::pendulum(), laws::logarithmic_stiffness()] {
        print_calls(law.name, &law.model);
    }
    for family in FAMILIES {
        for model in NODES.map(|nodes| member(&family, nodes)) {
            print_size(family.name, &model);
        }
    }
    divan::main();
}

/// The first member of a family with so many nodes.
fn member(family: &Family, nodes: usize) -> Model {
    let size = |model: &Model| model.graph.size(model.psi);
    let mut count = 1;
    while size(&(family.model)(count)) < nodes {
        count += count.div_ceil(16);
    }
    (family.model)(count)
}

/// Transcendental functions per iteration, beside the calls that differences made from values at
/// their ends would take at least.
fn print_calls(name: &str, model: &Model) {
    let programs = model.programs();
    let temperature = programs.temperature_form.as_ref();
    let forms = [
        ("temperature", temperature),
        ("entropy", Some(&programs.entropy_form)),
    ];
    for (form, program) in forms {
        let Some(program) = program else { continue };
        let count = program.transcendental_count();
        println!(
            "{name:22} {form:11} form: {} transcendental calls per iteration; from values at the ends \
             {} at least",
            count.calls, count.arguments
        );
    }
}

/// Nodes and operations per iteration.
fn print_size(name: &str, model: &Model) {
    let nodes = model.graph.size(model.psi);
    let programs = model.programs();
    let of = |program: &Program| program.operation_count().new.total();
    let temperature = programs.temperature_form.as_ref().map_or(0, of);
    let entropy = of(&programs.entropy_form);
    println!(
        "{name:16} {nodes:5} nodes, {temperature:6} and {entropy:6} operations of the temperature and \
         entropy form"
    );
}

#[divan::bench]
fn pendulum(bencher: Bencher<'_, '_>) {
    let model = laws::pendulum().model;
    bencher.bench_local(|| black_box(&model).programs());
}

#[divan::bench]
fn logarithmic_stiffness(bencher: Bencher<'_, '_>) {
    let model = laws::logarithmic_stiffness().model;
    bencher.bench_local(|| black_box(&model).programs());
}

/// One sample each: the larger ones take seconds.
#[divan::bench(args = NODES, consts = [0, 1, 2, 3, 4], sample_count = 1, sample_size = 1)]
fn growing_formula<const FAMILY: usize>(bencher: Bencher<'_, '_>, nodes: usize) {
    let model = member(&FAMILIES[FAMILY], nodes);
    bencher.bench_local(|| -> Programs { black_box(&model).programs() });
}
