//! The window of flank that a contact looks at: as long as the contact should need, and longer once it proves too short.

/// What is seen of both flanks through a window that reaches `half_length_mm` to either side of the contact.
pub(super) trait Sampled {
    /// Samples, points and whatever follows from them.
    type Samples;

    /// Samples the flanks anew.
    fn sample(&self, half_length_mm: f64) -> Self::Samples;
}

/// A window and the samples in it.
pub(super) struct GrowingWindow<F: Sampled> {
    /// Where the window lies.
    pub flanks: F,
    /// Half-length before it was ever too short.
    first_half_length_mm: f64,
    /// Half-length now.
    pub half_length_mm: f64,
    /// What is in it.
    pub samples: F::Samples,
}

impl<F: Sampled> GrowingWindow<F> {
    pub(super) fn new(flanks: F, half_length_mm: f64) -> Self {
        let samples = flanks.sample(half_length_mm);
        Self { flanks, first_half_length_mm: half_length_mm, half_length_mm, samples }
    }

    /// Samples it over another length, if it has another.
    pub(super) fn resize(&mut self, half_length_mm: f64) {
        if self.half_length_mm != half_length_mm {
            self.half_length_mm = half_length_mm;
            self.samples = self.flanks.sample(half_length_mm);
        }
    }

    /// Half as long again.
    pub(super) fn widen(&mut self) {
        self.resize(1.5 * self.half_length_mm);
    }

    /// Is again as long as at first.
    pub(super) fn reset(&mut self) {
        self.resize(self.first_half_length_mm);
    }
}
