//! Guards that restore a value after a failure, or after a panic of a user's function.

/// A value on which a function is called when the guard is dropped, also after a panic, unless it is [kept](Self::keep).
pub(super) struct Guard<T, F: FnOnce(&mut T)> {
    pub(super) value: T,
    restore: Option<F>,
}

impl<T, F: FnOnce(&mut T)> Guard<T, F> {
    pub(super) const fn new(value: T, restore: F) -> Self {
        let restore = Some(restore);
        Self { value, restore }
    }

    /// Leaves the value as it is.
    pub(super) fn keep(&mut self) {
        self.restore = None;
    }
}

impl<T, F: FnOnce(&mut T)> Drop for Guard<T, F> {
    fn drop(&mut self) {
        if let Some(restore) = self.restore.take() {
            restore(&mut self.value);
        }
    }
}

/// Calls `act`, and `restore` if `act` fails or panics.
pub(super) fn or_restore<T, R, E>(
    value: &mut T,
    restore: impl FnOnce(&mut T),
    act: impl FnOnce(&mut T) -> Result<R, E>,
) -> Result<R, E> {
    let mut guard = Guard::new(value, |value| restore(value));
    let result = act(&mut *guard.value)?;
    guard.keep();
    Ok(result)
}
