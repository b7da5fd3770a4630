use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| lambda)]
struct Spring;

fn main() {}
