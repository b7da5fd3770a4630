//! Gauss rules of two to four points per axis.

use eem_material::number::scalar::Real;

/// Abscissas and weights on [−1, 1].
fn on_axis<S: Real>(points: usize) -> Vec<(S, S)> {
    let number = S::from_f64;
    match points {
        2 => {
            let root = (S::one() / number(3.0)).sqrt();
            vec![(-root, S::one()), (root, S::one())]
        }
        3 => {
            let root = number(0.6).sqrt();
            let [edge, middle] = [5.0, 8.0].map(|nine| number(nine) / number(9.0));
            vec![(-root, edge), (S::zero(), middle), (root, edge)]
        }
        // x² = 3/7 ∓ 2/7 √(6/5), weights (18 ± √30)/36
        _ => {
            let shift = number(2.0) * number(1.2).sqrt();
            let [inner, outer] = [number(3.0) - shift, number(3.0) + shift]
                .map(|seventh| (seventh / number(7.0)).sqrt());
            let [heavy, light] = [number(30.0).sqrt(), -number(30.0).sqrt()]
                .map(|root| (number(18.0) + root) / number(36.0));
            let half = [(outer, light), (inner, heavy)];
            let [first, second] = half.map(|(at, weight)| (-at, weight));
            vec![first, second, half[1], half[0]]
        }
    }
}

/// The points of a cell with their weights, the first coordinate fastest.
pub(crate) fn gauss<S: Real, const D: usize>(per_axis: usize) -> Vec<([S; D], S)> {
    let axis = on_axis::<S>(per_axis);
    let points = (0..D).fold(1, |points, _| points * axis.len());
    let point = |mut index: usize| {
        let (mut place, mut weight) = ([S::zero(); D], S::one());
        for at in &mut place {
            let (abscissa, share) = axis[index % axis.len()];
            index /= axis.len();
            *at = abscissa;
            weight *= share;
        }
        (place, weight)
    };
    (0..points).map(point).collect()
}
