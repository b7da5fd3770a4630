//! The least times of several programs that run in turn.

use std::error::Error;
use std::time::{Duration, Instant};

/// Rounds: at least the first number, at most the second, in between as many as fit into the time.
const ROUNDS: [u32; 2] = [10, 1000];
const PATIENCE: Duration = Duration::from_millis(300);

/// Runs all sides, then all again, and so on: the speed of the machine changes, and each side shall meet all of it.
/// Every side returns its time; the least ones, s.
pub(super) fn in_turn<const K: usize>(
    mut sides: [&mut dyn FnMut() -> Result<Duration, Box<dyn Error>>; K],
) -> Result<[f64; K], Box<dyn Error>> {
    let [fewest, most] = ROUNDS;
    let mut least = [Duration::MAX; K];
    let started = Instant::now();
    for round in 0..most {
        if round >= fewest && started.elapsed() > PATIENCE {
            break;
        }
        for (side, least) in sides.iter_mut().zip(&mut least) {
            *least = side()?.min(*least);
        }
    }
    Ok(least.map(|time| time.as_secs_f64()))
}
