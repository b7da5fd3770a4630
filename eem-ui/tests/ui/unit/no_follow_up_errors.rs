use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let wrong = lambda + theta;
    let also = k * wrong + k * theta;
    also * also + ln(also) + k * exp(lambda)
})]
struct Model {
    #[unit("N")]
    k: f64,
}

fn main() {}
