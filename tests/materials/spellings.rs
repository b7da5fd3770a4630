//! Every legal way to write a formula: what is written differently and means the same is the same
//! material, bit for bit.

use eem::FreeEnergy;

/// A plainly written material and others that spell the same.
macro_rules! same {
    ($test:ident at $x:expr; $({ $(#[$attribute:meta])+ })*) => {
        #[test]
        fn $test() {
            let mut found: Vec<Vec<u64>> = Vec::new();
            $({
                #[derive(FreeEnergy)]
                $(#[$attribute])+
                struct Model {
                    k: f64,
                    c: f64,
                }
                let model = Model { k: 1.7, c: 0.6 };
                let psi: f64 = model.free_energy(&$x);
                let (gradient, hessian) = model.hessian(&$x);
                let rows = hessian.iter().flatten().chain(&gradient).chain([&psi]);
                found.push(rows.map(|value| value.to_bits()).collect());
            })*
            assert!(found.len() > 1);
            assert!(found.iter().all(|bits| *bits == found[0]), "{found:x?}");
        }
    };
}

same! { calls_and_methods at [1.3, 2.1];
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| {
            c + k * ln(lambda) * exp(theta) + sqrt(lambda) * powf(theta, 2.5) - powi(lambda, 3) * recip(theta)
        })]
    }
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| {
            c + k * lambda.ln() * theta.exp() + lambda.sqrt() * theta.powf(2.5)
                - lambda.powi(3) * theta.recip()
        })]
    }
}

same! { parentheses_and_blocks at [1.3, 2.1];
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| k * lambda * theta - c * theta * ln(theta))]
    }
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| {
            ((k * (lambda)) * theta) - ((c) * theta * (ln((theta))))
        })]
    }
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| {
            k * { lambda * theta } - { c * theta * ln({ theta }) }
        })]
    }
}

same! { bindings at [1.3, 2.1];
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| {
            0.5 * k * ln(lambda / c).powi(2) - c * theta * ln(theta)
        })]
    }
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| {
            let strain = ln(lambda / c);
            let elastic = 0.5 * k * strain.powi(2);
            elastic - c * theta * ln(theta)
        })]
    }
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| {
            let elastic = {
                let ratio = lambda / c;
                let strain = ratio.ln();
                0.5 * k * strain * strain
            };
            elastic - {
                let heat = c * theta;
                heat * theta.ln()
            }
        })]
    }
}

same! { a_block_ends_its_names at [1.3, 2.1];
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| {
            k - c.powi(2) * lambda.powi(2) * theta.powi(2) - c * lambda
        })]
    }
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| {
            let square = { let part = c * lambda; part.powi(2) };
            k - square * theta.powi(2) - { let part = c; part * lambda }
        })]
    }
}

same! { signs at [1.3, 2.1];
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| k * lambda - c * theta.powi(3))]
    }
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| -c * theta.powi(3) + k * lambda)]
    }
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| -(c * theta.powi(3)) - -k * lambda)]
    }
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| -(-(k * lambda - c * theta.powi(3))))]
    }
}

same! { numbers at [1.3, 2.1];
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| {
            0.5 * k * lambda.powi(2) * theta.powf(1.5) + 1000.0 * c * lambda
        })]
    }
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| {
            1 / 2 * k * lambda.powi(2) * theta.powf(3 / 2) + 1_000 * c * lambda
        })]
    }
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| {
            5e-1 * k * lambda.powi(1 + 1) * theta.powf(0.1 + 1.4) + 1e3_f64 * c * lambda
        })]
    }
}

same! { derivatives at [1.3, 2.1];
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| {
            c + k * lambda.powi(3) + 3 * k * lambda.powi(2) * theta.powi(2)
        })]
    }
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| {
            let elastic = k * lambda.powi(3);
            c + elastic + diff(elastic, lambda) * theta.powi(2)
        })]
    }
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| {
            let elastic = k * lambda.powi(3);
            c + elastic + elastic.diff(lambda) * theta.powi(2)
        })]
    }
}

same! { the_order_of_arguments at [1.3, 2.1];
    {
        #[free_energy(|lambda: Stretch, theta: Temperature| k * lambda.powi(2) * theta.powi(3) / c)]
    }
    {
        #[free_energy(|theta: Temperature, lambda: Stretch| k * lambda.powi(2) * theta.powi(3) / c)]
    }
    {
        #[free_energy(|θ: Temperature, λ: Stretch| k * λ.powi(2) * θ.powi(3) / c)]
    }
    {
        #[free_energy(|r#type: Temperature, r#in: Stretch,| k * r#in.powi(2) * r#type.powi(3) / c)]
    }
}

same! { laws_of_dashpots at [1.3, 0.2, -0.1];
    {
        #[free_energy(|lambda: Stretch, a: Viscous, b: Viscous| k * (lambda - a).powi(2) * b.powi(2))]
        #[viscosity(a = c, b = k + c)]
    }
    {
        #[free_energy(|lambda: Stretch, a: Viscous, b: Viscous| k * (lambda - a).powi(2) * b.powi(2))]
        #[viscosity(b = { let sum = k + c; sum })]
        #[viscosity(a = c,)]
    }
}

/// Bounds, defaults, lifetimes of other fields and a `where` clause do not disturb.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| stiffness * lambda.powi(2) + offset)]
struct Generic<'a, T: Copy + Send = f64, const N: usize = 2>
where
    [u8; N]: Default,
{
    stiffness: T,
    offset: f32,
    #[allow(
        dead_code,
        reason = "a field that ψ does not mention may have any type"
    )]
    label: &'a [u8; N],
}

#[test]
fn generic_structs() {
    let model = Generic {
        stiffness: 3.0,
        offset: 0.25,
        label: b"ab",
    };
    let psi: f64 = model.free_energy(&[2.0]);
    assert_eq!(psi.to_bits(), 12.25_f64.to_bits());
}
