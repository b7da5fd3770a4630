//! Kind 10: the same bits in every run, and after a state was saved and restored.

use super::drawing::{Class, Drawing};
use super::random::Random;
use super::tally::{Effort, Family, Tally};
use super::watched::{EXACT, Watched};

pub(crate) const FAMILIES: &[Family] = &[repeated_runs];

fn start(index: u64, class: Class) -> Option<Watched<2>> {
    let mut random = Random::new(index);
    let drawing = Drawing::<2>::at_random(&mut random, class, 6);
    let scheme = EXACT[random.below(EXACT.len())];
    drawing.world().start(scheme, drawing.step).ok()
}

fn repeated_runs(effort: Effort) -> Tally {
    let mut tally =
        Tally::new("random scenes run twice, and saved and restored half way: the same bits");
    let count = effort.of([2, 20, 1000]);
    let steps = effort.of([4, 10, 100]);
    for (index, class) in
        (0..count).flat_map(|index| [Class::Ordinary, Class::Wild].map(|c| (index, c)))
    {
        let [Some(mut first), Some(mut again), Some(mut later)] =
            [(); 3].map(|()| start(index, class))
        else {
            continue;
        };
        let label = format!("{class:?} {index}");
        first.steps(steps);
        tally.add(&label, &first.record);
        again.steps(steps / 2);
        let middle = again.run.checkpoint();
        let was_refused = again.record.refused.is_some();
        if !was_refused {
            again.steps(steps - steps / 2);
            let restored = later.run.restore(&middle);
            tally.claim(restored.is_ok(), format!("{label}: {restored:?}"));
            for _ in steps / 2..steps {
                if later.run.step().is_err() {
                    break;
                }
            }
            let is_same = later.run.checkpoint() == first.run.checkpoint();
            tally.claim(is_same, format!("{label}: restored, it goes another way"));
        }
        let is_same = again.run.checkpoint() == first.run.checkpoint();
        tally.claim(is_same, format!("{label}: the second run goes another way"));
    }
    tally
}
