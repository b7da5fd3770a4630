//! The energy–entropy–momentum scheme of order 4, TC-cG(2).
//!
//! Gauss collocation of two stages in which the conjugates `½N, −G, Θ` of an element are projections of
//! `∇e(C, γ, s)`, `C = λ²`, along its path through the step: continuous Galerkin in time (Groß & Betsch 2011)
//! with the strain assumed in time (Betsch & Steinmann 2001). The quadrature of the path has three points.

use super::gauss_4;
use crate::element::tableau::{Ending, Path, Supports, Tableau};

/// √3.
const ROOT: f64 = 1.732_050_807_568_877_3;

/// See the module.
pub(crate) static TABLEAU: Tableau = Tableau {
    ending: Ending::Increments {
        displacements: &[-ROOT, ROOT],
        impulses: &[-6.0 - 6.0 * ROOT, 6.0 * ROOT - 6.0],
    },
    path: Some(Path {
        integrals: &[
            &[0.142_953_373_068_073_02, -0.030_251_707_688_814_71],
            &[0.466_506_350_946_109_66, 0.033_493_649_053_890_34],
            &[0.530_251_707_688_814_7, 0.357_046_626_931_927],
        ],
        projection: &[&[OWN, 4.0 / 9.0, OTHER], &[OTHER, 4.0 / 9.0, OWN]],
        supports: Supports {
            times: &[0.5, 1.0],
            to_stages: &[
                &[2.0 / 3.0, -0.122_008_467_928_146_22],
                &[2.0 / 3.0, 0.455_341_801_261_479_55],
            ],
            integrals: &[
                &[0.466_506_350_946_109_66, 0.033_493_649_053_890_34],
                &[0.5, 0.5],
            ],
            mean: [&[0.0, 0.5, 1.0], &[1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0]],
        },
    }),
    ..gauss_4::RULE
};

/// `w_r ℓ_i(τ_r)/b_i` of the first and of the last point.
const OWN: f64 = 0.650_455_774_027_742_7;
const OTHER: f64 = -0.094_900_218_472_187_17;
