//! Solids at rest, where all strains are zero, and next to it.

use crate::zoo::families;
use crate::zoo::specimen::Specimen;
use crate::zoo::states;

/// The largest strain next to rest.
const SMALL: f64 = 1e-9;

/// The state without strains, at the temperature of the specimen.
fn rest(specimen: &dyn Specimen) -> Vec<f64> {
    let mut x = specimen.state().to_vec();
    x[..specimen.measures() + specimen.dashpots()].fill(0.0);
    x
}

/// All strains small, in both directions where there are two; E:E is the square of a strain.
fn next_to_rest(specimen: &dyn Specimen) -> Vec<f64> {
    let mut x = rest(specimen);
    let count = specimen.measures() + specimen.dashpots();
    for (i, strain) in x[..count].iter_mut().enumerate() {
        *strain = match specimen.home()[i] {
            [0.0, _] => SMALL * SMALL,
            _ if i % 2 == 0 => SMALL,
            _ => -SMALL,
        };
    }
    x
}

/// Responses with their tangents in both forms.
fn forms(specimen: &dyn Specimen, x0: &[f64], x1: &[f64]) -> [Vec<f64>; 2] {
    let corners = states::corners(specimen, x0, x1);
    let corners: Vec<f64> = corners.iter().map(|corner| corner.theta).collect();
    [
        specimen.entropy_form(x0, x1, &corners),
        specimen.temperature_form(x0, x1),
    ]
}

fn solids() -> impl Iterator<Item = Box<dyn Specimen>> {
    let all = families::all().into_iter();
    all.filter(|specimen| specimen.is_solid())
}

#[test]
fn a_solid_may_be_at_rest() {
    for solid in solids() {
        let (name, x0) = (solid.name(), rest(&*solid));
        let gradient = solid.gradient(&x0);
        for form in forms(&*solid, &x0, &x0) {
            assert!(form.iter().all(|number| number.is_finite()), "{name}");
            for (force, slope) in form.iter().zip(&gradient[..solid.measures()]) {
                let error = (force - slope).abs();
                assert!(error <= 1e-14 * slope.abs(), "{name}: {force} and {slope}");
            }
        }
        let hessian = solid.hessian(&x0);
        assert!(hessian.iter().all(|number| number.is_finite()), "{name}");
    }
}

/// The forces of a step out of rest are means of those at its ends, up to the square of the strain.
#[test]
fn small_strains_keep_their_digits() {
    for solid in solids() {
        let (name, x0, x1) = (solid.name(), rest(&*solid), next_to_rest(&*solid));
        let (before, hessian) = (solid.gradient(&x0), solid.hessian(&x0));
        let n = x0.len();
        for form in forms(&*solid, &x0, &x1) {
            assert!(form.iter().all(|number| number.is_finite()), "{name}");
            for a in 0..solid.measures() {
                let row = &hessian[n + a * n..][..n];
                let products = row.iter().zip(x0.iter().zip(&x1));
                let change: f64 = products.map(|(h, (old, new))| 0.5 * h * (new - old)).sum();
                let (found, size) = (
                    form[a] - before[a],
                    row.iter().map(|h| h.abs()).sum::<f64>(),
                );
                // What ψ is beyond second order, and the rounding of a force.
                let allowed = 10.0 * size * SMALL * SMALL + 1e-15 * before[a].abs();
                let error = (found - change).abs();
                assert!(
                    error <= 1e-7 * size * SMALL + allowed,
                    "{name} {a}: {found:e}, {change:e}"
                );
            }
        }
    }
}
