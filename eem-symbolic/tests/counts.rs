mod support;
#[test]
fn print_counts() {
    for law in support::laws::all() {
        let programs = law.model.programs();
        let mut all = vec![("psi", &programs.free_energy), ("gradient", &programs.gradient), ("hessian", &programs.hessian), ("energy", &programs.internal_energy), ("entropy form", &programs.entropy_form)];
        if let Some(p) = &programs.caloric { all.push(("caloric", p)); }
        if let Some(p) = &programs.temperature_form { all.push(("temperature form", p)); }
        for (name, p) in all {
            let c = p.operation_count();
            println!("{} {name}: old {:?} = {}, new {:?} = {}, hoisted {}", law.name, c.old, c.old.total(), c.new, c.new.total(), p.hoisted().len());
        }
        println!("{:#?}", law.model.formulas());
        if std::env::var("DUMP").is_ok_and(|v| v == law.name) {
            for p in [&programs.entropy_form, programs.temperature_form.as_ref().unwrap()] {
                println!("-----");
            for (i, ins) in p.instructions.iter().enumerate() { println!("{i}: {:?} {:?} {}", ins.stage, ins.operation, if let eem_symbolic::Operation::Input(k) = ins.operation { p.inputs[k].name.clone() } else { String::new() }); }
            println!("{:?}", p.outputs);
            }
        }
    }
}
