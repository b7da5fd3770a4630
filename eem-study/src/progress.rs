//! Who is told how far a study has come.

/// Is called with the steps made and those planned.
pub(crate) type Watch<'a> = dyn FnMut(u64, u64) + 'a;

/// How many steps are made, and who wants to know.
pub(crate) struct Progress<'a> {
    watch: Option<Box<Watch<'a>>>,
    done: u64,
    planned: u64,
}

impl<'a> Progress<'a> {
    /// None so far.
    pub(crate) fn new(watch: Option<Box<Watch<'a>>>) -> Self {
        let (done, planned) = (0, 0);
        Self {
            watch,
            done,
            planned,
        }
    }

    /// More steps are to be made.
    pub(crate) fn plan(&mut self, steps: u64) {
        self.planned = self.planned.saturating_add(steps);
    }

    /// Steps have been made.
    pub(crate) fn advance(&mut self, steps: u64) {
        self.done = self.done.saturating_add(steps);
        if let Some(watch) = self.watch.as_mut().filter(|_| steps > 0) {
            watch(self.done, self.planned);
        }
    }
}
