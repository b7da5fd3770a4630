//! Numbers in messages are short, whatever their size.

use eem::prelude::*;

use super::Elastic;

#[test]
fn no_message_has_more_digits_than_a_number() {
    for size in [1e-300, 1e-200, 1.5e200, f64::MAX] {
        let mut texts = Vec::new();
        let mut refuse = |spoil: &dyn Fn(&mut Scene<2>, Node)| {
            let mut scene = Scene::<2>::new();
            let pivot = scene.anchor([0.0, 0.0]);
            let bob = scene.mass(1.0, [1.0, 0.0], [0.0, 0.0]);
            let spring = Elastic {
                stiffness: 1.0,
                length: 1.0,
            };
            scene.spring(spring, [pivot, bob]);
            spoil(&mut scene, bob);
            texts.push(
                Simulation::new(scene, Scheme::EemEntropy, 0.1)
                    .unwrap_err()
                    .to_string(),
            );
        };
        refuse(&|scene, _| {
            scene.mass(-size, [5.0, 0.0], [0.0, 0.0]);
        });
        refuse(&|scene, _| {
            scene.reservoir(-size);
        });
        refuse(&|scene, _| {
            let pivot = scene.anchor([0.3, 0.0]);
            scene.move_anchor(pivot, move |_| [-size, 0.0]);
        });
        let mut scene = Scene::<2>::new();
        scene.anchor([0.0, 0.0]);
        let mut run = Simulation::new(scene, Scheme::EemEntropy, 1e-150).unwrap();
        texts.push(run.set_step_size(-size).unwrap_err().to_string());
        let go_on = |_: &Simulation<2>, _: &StepReport| ControlFlow::Continue(());
        texts.push(run.run_until_with(-size, go_on).unwrap_err().to_string());
        for text in texts {
            assert!(text.len() < 200, "{text}");
            let digits = text.split(|c: char| !c.is_ascii_digit()).map(str::len);
            assert!(digits.max() <= Some(17), "{text}");
        }
    }
}
