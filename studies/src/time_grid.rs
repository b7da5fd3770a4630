//! Equal steps that reach an end time, and the finer grid of a reference.

/// Most steps one run records: a longer run fills the memory before it fills a figure.
const MOST_STEPS: f64 = 1e7;

/// An end time that exceeds the last full step by less than this fraction of a step is reached
/// by that step: 20 s in steps of 0.1 s are 200 steps although 0.1 is not exact in binary.
const END_SLACK: f64 = 1e-6;

/// Equal steps, of which every `stride`-th is recorded.
#[derive(Clone, Copy, Debug)]
pub struct TimeGrid {
    /// Step in seconds.
    pub step: f64,
    /// Number of steps.
    pub steps: usize,
    /// Steps from one recorded state to the next.
    pub stride: usize,
}

impl TimeGrid {
    /// The steps of size `step` that reach the time `end`, in seconds, all recorded.
    ///
    /// # Errors
    ///
    /// What to tell the user when there are more steps than can be recorded.
    pub fn reaching(end: f64, step: f64) -> Result<Self, String> {
        let steps = (end / step - END_SLACK).ceil().max(1.0);
        if steps > MOST_STEPS {
            return Err(format!(
                "{end} s in steps of {step} s are {steps:.0} steps; at most {MOST_STEPS:.0} are \
                 recorded"
            ));
        }
        let (steps, stride) = (count(steps), 1);
        Ok(Self {
            step,
            steps,
            stride,
        })
    }

    /// The time (s) that the last step reaches.
    pub fn end(self) -> f64 {
        self.step * as_real(self.steps)
    }

    /// The same end time with steps `2^halvings` times smaller; only the end is recorded.
    #[must_use]
    pub fn halved(self, halvings: u32) -> Self {
        let parts = 2_usize.pow(halvings);
        let steps = self.steps * parts;
        Self {
            step: self.step / as_real(parts),
            steps,
            stride: steps,
        }
    }

    /// The same times with steps of at most `longest`, recorded at least every `sampling` seconds
    /// and at every time of this grid.
    #[must_use]
    pub fn refined(self, longest: f64, sampling: f64) -> Self {
        let most = (MOST_STEPS / as_real(self.steps)).floor().max(1.0);
        let samples = (self.step / sampling).ceil().clamp(1.0, most);
        let stride = (self.step / samples / longest).ceil();
        let stride = stride.clamp(1.0, (most / samples).floor().max(1.0));
        Self {
            step: self.step / (samples * stride),
            steps: self.steps * count(samples * stride),
            stride: count(stride),
        }
    }
}

#[expect(
    clippy::cast_precision_loss,
    reason = "at most MOST_STEPS times a few thousand"
)]
fn as_real(count: usize) -> f64 {
    count as f64
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the callers' numbers are whole, positive and far below 2^53"
)]
fn count(whole: f64) -> usize {
    whole as usize
}
