use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| lambda)]
union Material {
    k: f64,
    c: f32,
}

fn main() {}
