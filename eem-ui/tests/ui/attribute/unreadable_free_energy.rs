use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * )]
struct Unfinished {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy = "k * lambda"]
struct NameValue {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda lambda)]
struct MissingOperator {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| { let strain = k lambda; ln strain })]
struct MissingOperatorInBlock {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * |lambda|)]
struct Bars {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(k * lambda lambda)]
struct NoClosure {
    k: f64,
}

fn main() {}
