use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| (a + b + c + d + e + f + g + h + i) * lambda)]
struct Model {
    #[unit("")]
    a: f64,
    #[unit("J/kg K")]
    b: f64,
    #[unit("K-1")]
    c: f64,
    #[unit("m**2")]
    d: f64,
    #[unit("m^x")]
    e: f64,
    #[unit("(m")]
    f: f64,
    #[unit("1000 N")]
    g: f64,
    #[unit("J/")]
    h: f64,
    #[unit("m + s")]
    i: f64,
}

fn main() {}
