//! Masses and anchors at random places, and a random graph of springs between them.

use super::material::{Material, Ranges};
use super::random::Random;

/// A mass or an anchor.
pub(crate) struct Node<const D: usize> {
    /// `None` for an anchor.
    pub(crate) mass: Option<f64>,
    pub(crate) position: [f64; D],
    pub(crate) velocity: [f64; D],
}

/// A spring and its state.
pub(crate) struct Spring<const D: usize> {
    pub(crate) ends: [usize; 2],
    pub(crate) material: Material<D>,
    pub(crate) theta: f64,
    pub(crate) length: f64,
}

/// Up to two anchors and one to `most` masses, about 1 m from each other.
pub(crate) fn nodes<const D: usize>(random: &mut Random, wild: bool, most: usize) -> Vec<Node<D>> {
    let anchors = random.below(3);
    // Small scenes are tried more often: they cost less and find as much.
    let masses = 1 + random.below(most).min(random.below(most));
    let masses = if anchors == 0 { masses.max(2) } else { masses };
    #[expect(clippy::cast_precision_loss, reason = "small numbers")]
    let size = ((anchors + masses) as f64).powf(1.0 / D as f64);
    let mut nodes: Vec<Node<D>> = Vec::new();
    while nodes.len() < anchors + masses {
        let mut position: [f64; D] = core::array::from_fn(|_| random.uniform(0.0, size));
        // A wild mass may start close to an anchor.
        if wild && anchors > 0 && nodes.len() >= anchors && random.chance(0.1) {
            let near = random.decades(1e-6, 1e-1);
            let anchor = nodes[0].position;
            position = core::array::from_fn(|i| anchor[i] + near * random.uniform(0.1, 1.0));
        }
        let gap = |node: &Node<D>| {
            let squares = node
                .position
                .iter()
                .zip(&position)
                .map(|(a, b)| (a - b).powi(2));
            squares.sum::<f64>().sqrt()
        };
        if !wild && nodes.iter().any(|node| gap(node) < 0.5) {
            continue;
        }
        let mass = if wild {
            random.decades(1e-4, 1e4)
        } else {
            random.decades(0.3, 3.0)
        };
        let mass = (nodes.len() >= anchors).then_some(mass);
        nodes.push(Node {
            mass,
            position,
            velocity: [0.0; D],
        });
    }
    nodes
}

/// A random tree and some more springs.
pub(crate) fn springs<const D: usize>(
    random: &mut Random,
    wild: bool,
    nodes: &[Node<D>],
) -> Vec<Spring<D>> {
    let mut ends: Vec<[usize; 2]> = (1..nodes.len()).map(|b| [random.below(b), b]).collect();
    for _ in 0..random.below(nodes.len() + 1) {
        let (a, b) = (random.below(nodes.len()), random.below(nodes.len()));
        if a != b {
            ends.push([a, b]);
        }
    }
    let is_fixed = |end: usize| nodes[end].mass.is_none();
    ends.retain(|ends| !ends.iter().all(|&end| is_fixed(end)));
    let spring = |ends: [usize; 2]| {
        let [a, b] = ends.map(|end| nodes[end].position);
        let distance = (0..D).map(|i| (b[i] - a[i]).powi(2)).sum::<f64>().sqrt();
        let length = if wild {
            distance.max(1e-3) * random.decades(0.3, 3.0)
        } else {
            distance * random.uniform(0.85, 1.15)
        };
        let theta = if wild {
            random.decades(1.0, 1e4)
        } else {
            random.uniform(250.0, 400.0)
        };
        let ranges = if wild {
            &Ranges::WILD
        } else {
            &Ranges::ORDINARY
        };
        let material = Material::at_random(random, ranges, length, theta);
        Spring {
            ends,
            material,
            theta,
            length,
        }
    };
    ends.into_iter().map(spring).collect()
}
