//! The memory of the machine, which is queried before much of it is reserved.
//!
//! An operating system that overcommits memory (Linux does) reserves anything, and ends the program later.

/// Up to this size, bytes, memory is reserved without a query of the machine, which takes longer than a small scene.
const SMALL: u64 = 1 << 28;

/// The memory that the machine has available, bytes; `None` if it is unknown, or if so little is needed that the machine
/// is not asked.
#[must_use]
pub fn available_for(needed: u64) -> Option<u64> {
    if needed <= SMALL { None } else { available() }
}

/// The memory that the machine or the control group of this process has available, bytes; `None` if unknown.
#[cfg(feature = "memory")]
fn available() -> Option<u64> {
    let mut system = sysinfo::System::new().ok()?;
    system.refresh_memory();
    let of_machine = system.available_memory();
    // The free memory of a control group does not count reclaimable memory such as the page cache.
    let limits = system.cgroup_limits();
    let of_group = limits.map(|limits| limits.total_memory.saturating_sub(limits.rss));
    let available = of_group.map_or(of_machine, |most| most.min(of_machine));
    (available > 0).then_some(available)
}

#[cfg(not(feature = "memory"))]
fn available() -> Option<u64> {
    None
}
