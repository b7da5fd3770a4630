use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda)]
struct Spring<T> {
    k: T,
    softening: f64,
    damping: T,
    single: f32,
    #[free_energy(unused)]
    density: f64,
    _length: f64,
    name: String,
}

fn main() {}
