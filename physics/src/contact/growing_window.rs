//! The window of flank in which a contact is looked for: longer once it proves too short.

/// Flanks that can be sampled in a window.
pub(super) trait Sampled {
    /// Samples of both flanks and quantities that follow from them.
    type Samples;

    /// Samples the flanks in a window of `half_length_mm` to either side of the contact.
    fn sample(&self, half_length_mm: f64) -> Self::Samples;
}

/// A window and the samples in it.
pub(super) struct GrowingWindow<F: Sampled> {
    /// Flanks.
    pub flanks: F,
    /// First half-length, mm.
    first_half_length_mm: f64,
    /// Present half-length, mm.
    pub half_length_mm: f64,
    /// Samples in the window.
    pub samples: F::Samples,
}

impl<F: Sampled> GrowingWindow<F> {
    pub(super) fn new(flanks: F, half_length_mm: f64) -> Self {
        let samples = flanks.sample(half_length_mm);
        Self { flanks, first_half_length_mm: half_length_mm, half_length_mm, samples }
    }

    /// Gives the window another length, and samples the flanks where that is new.
    pub(super) fn resize(&mut self, half_length_mm: f64) {
        if self.half_length_mm != half_length_mm {
            self.half_length_mm = half_length_mm;
            self.samples = self.flanks.sample(half_length_mm);
        }
    }

    /// Makes the window half as long again.
    pub(super) fn widen(&mut self) {
        self.resize(1.5 * self.half_length_mm);
    }

    /// Returns to the first length.
    pub(super) fn reset(&mut self) {
        self.resize(self.first_half_length_mm);
    }
}
