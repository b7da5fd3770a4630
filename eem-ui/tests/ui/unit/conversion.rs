use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| force * (per_metre * lambda + length) + force * per_metre * length)]
struct Model {
    #[unit("N")]
    force: f64,
    #[unit("mm/m")]
    per_metre: f64,
    #[unit("m")]
    length: f64,
}

fn main() {}
