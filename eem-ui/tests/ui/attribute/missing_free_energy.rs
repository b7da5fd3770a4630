use eem::FreeEnergy;

#[derive(FreeEnergy)]
struct Spring {
    stiffness: f64,
}

fn main() {}
