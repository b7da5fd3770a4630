use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| lambda)]
struct Spring(f64);

fn main() {}
