use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| lambda)]
enum Material {
    Steel,
    Rubber,
}

fn main() {}
