//! Maps a slice in order, on several threads or on one.

use core::sync::atomic::{AtomicUsize, Ordering};

/// `f(w, i, &inputs[i])` for all `i`, on this number of threads, each of which keeps a `w` of its own; 0 means those of the
/// present pool.
///
/// If the system refuses the threads, the calling one does all the work.
pub(super) fn map<I: Sync, W: Default, T: Send>(
    threads: usize,
    inputs: &[I],
    f: impl Fn(&mut W, usize, &I) -> T + Sync,
) -> Vec<T> {
    let next = AtomicUsize::new(0);
    // Each thread takes one input after the other: one may take a thousand times as long as another.
    let work = || {
        let mut own = W::default();
        let indices = core::iter::repeat_with(|| next.fetch_add(1, Ordering::Relaxed));
        let taken = indices.map_while(|index| Some((index, inputs.get(index)?)));
        let found = taken.map(|(index, input)| (index, f(&mut own, index, input)));
        found.collect::<Vec<_>>()
    };
    let mut found = on_each(threads, inputs.len(), work);
    found.sort_by_key(|&(index, _)| index);
    found.into_iter().map(|(_, result)| result).collect()
}

/// What `work` returns on each of these threads; it is called at most `most` times.
#[cfg(feature = "parallel")]
fn on_each<T: Send>(threads: usize, most: usize, work: impl Fn() -> Vec<T> + Sync) -> Vec<T> {
    use rayon::iter::{IndexedParallelIterator, ParallelIterator, repeat_n};

    let on_pool = || {
        let threads = rayon::current_num_threads().min(most);
        let each = repeat_n((), threads).with_max_len(1);
        each.flat_map_iter(|()| work()).collect()
    };
    match threads {
        0 => on_pool(),
        1 => work(),
        _ => match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
            Ok(pool) => pool.install(on_pool),
            Err(_) => work(),
        },
    }
}

/// Without threads.
#[cfg(not(feature = "parallel"))]
fn on_each<T>(_threads: usize, _most: usize, work: impl Fn() -> Vec<T>) -> Vec<T> {
    work()
}
