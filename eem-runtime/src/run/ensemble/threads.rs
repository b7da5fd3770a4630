//! Maps a slice in order, on several threads or on one.

/// `f(i, &inputs[i])` for all `i`, on the calling thread.
fn in_turn<I, T>(inputs: &[I], f: impl Fn(usize, &I) -> T) -> Vec<T> {
    let indexed = inputs.iter().enumerate();
    indexed.map(|(index, input)| f(index, input)).collect()
}

/// `f(i, &inputs[i])` for all `i`, on this number of threads; 0 means those of the present pool.
///
/// If the system refuses the threads, the calling one does all the work.
#[cfg(feature = "parallel")]
pub(super) fn map<I: Sync, T: Send>(
    threads: usize,
    inputs: &[I],
    f: impl Fn(usize, &I) -> T + Sync,
) -> Vec<T> {
    match threads {
        0 => at_once(inputs, f),
        1 => in_turn(inputs, f),
        _ => match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
            Ok(pool) => pool.install(|| at_once(inputs, &f)),
            Err(_) => in_turn(inputs, f),
        },
    }
}

/// Without threads.
#[cfg(not(feature = "parallel"))]
pub(super) fn map<I: Sync, T: Send>(
    _threads: usize,
    inputs: &[I],
    f: impl Fn(usize, &I) -> T + Sync,
) -> Vec<T> {
    in_turn(inputs, f)
}

/// On the threads of the present pool.
#[cfg(feature = "parallel")]
fn at_once<I: Sync, T: Send>(inputs: &[I], f: impl Fn(usize, &I) -> T + Sync) -> Vec<T> {
    use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};

    // No pieces of several members: one may take a thousand times as long as another.
    let indexed = inputs.par_iter().enumerate().with_max_len(1);
    indexed.map(|(index, input)| f(index, input)).collect()
}
