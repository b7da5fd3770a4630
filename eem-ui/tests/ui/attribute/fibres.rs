use eem::FreeEnergy;

// Several fibres, but one spring or solid.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, warp: FibreStrain, weft: FibreStrain| k * (lambda + warp + weft))]
struct Spring {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|warp: Fiber, e4| k * (warp + e4))]
struct Cloth {
    k: f64,
}

// A fibre has strain, not length.
#[derive(FreeEnergy)]
#[free_energy(|warp: FibreStrain| 0.5 * k * (warp - length).powi(2))]
struct Thread {
    #[unit("Pa")]
    k: f64,
    #[unit("m")]
    length: f64,
}

fn main() {}
