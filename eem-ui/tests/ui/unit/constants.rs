use eem::FreeEnergy;

const R: f64 = 8.314;
const MOLES: f64 = 1.0;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    k * lambda.powi(2) - MOLES * R * theta * ln(lambda / length) - c * theta * ln(theta / PI)
})]
#[unit(R = "J/(mol K)", PI = "K", core::f64::consts::E = "1", length = "m", R = "J/K")]
#[unit(MOLE = "mol", UNRELATED = "kg", k::MOLES = "hands")]
struct Model {
    #[unit("N/m")]
    k: f64,
    length: f64,
    #[unit("J/K")]
    c: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda.powi(2) * self::R)]
#[unit(self::R = "kJ/N")]
struct Scaled {
    #[unit("N/m^2")]
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda.powi(2) + k * lambda)]
#[unit(R = "kJ/N")]
#[unit]
#[unit()]
#[unit(R)]
struct Nothing {
    #[unit("N/m")]
    k: f64,
}

fn main() {}
