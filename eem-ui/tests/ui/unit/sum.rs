use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    let travel = lambda - length;
    0.5 * k * travel.powi(2) + force - (c * warmth - work)
})]
struct Model {
    #[unit("N/m")]
    k: f64,
    #[unit("m")]
    length: f64,
    #[unit("N")]
    force: f64,
    #[unit("J")]
    c: f64,
    #[unit("K")]
    warmth: f64,
    #[unit("J")]
    work: f64,
}

fn main() {}
