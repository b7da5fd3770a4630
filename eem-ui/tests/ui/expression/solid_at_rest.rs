use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare, j: Dilatation| {
    let logarithm = ln(j) + log2(e2) + ln_1p(2 * e1 - 1) + atanh(1 + e1);
    let quotient = k / j + recip(e1 * j) + (2 * e2).powi(-1) + k / (sqrt(1 + j) - 1);
    let roots = sqrt(e2) + cbrt(j) + e2.powf(0.4) + sqrt(e1 - 1) + e2.powf(1.5)
        + j.powi(2).powf(1.25);
    k * (logarithm + quotient + roots)
})]
struct AtRest {
    k: f64,
}

// Lengths are positive, and strains have their bounds.
#[derive(FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare, j: Dilatation| {
    let sound = (1 + j).powf(0.7) + ln(1 + j) + ln(3 + 2 * e1) + 1 / (1 + j) + sqrt((1 + j).powi(2))
        + e2.powf(2.5) + (3 + 2 * e1).powf(0.5) + j.powi(2).powf(k);
    k * sound + (1 + e1).powf(2.5) + (1 - j).powf(1.5) + sqrt(j.powi(2) * k) + ln(-1 - j)
        + j.powf(2.5) + e1.powf(4.5)
})]
struct Bounds {
    k: f64,
}

// A fibre has a stretch where its strain is zero.
#[derive(FreeEnergy)]
#[free_energy(|warp: FibreStrain, weft: FibreStrain| {
    k * (ln(warp) + ln_1p(2 * weft).powi(2) + sqrt(1 + 2 * warp) + ln(1 + 2 * weft) / weft)
})]
struct Cloth {
    k: f64,
}

fn main() {}
