//! Mesh stiffness over one pitch of the pinion, out of rows that go from A to E.
//!
//! The stiffness repeats with the pitch 360°/z₁. Its mean over the pitch from the first row on is that of straight lines between the rows,
//! the last of them to the first row one pitch later:
//!
//! ```text
//! c = 1/p ∫ c(φ) dφ over [φ₀, φ₀ + p]        p = 360°/z₁
//! ```

/// Mesh stiffness as the columns of `mesh_cycle.csv` have it.
#[derive(Debug, Clone, Default)]
pub struct MeshStiffness {
    pub pinion_rotation_deg: Vec<f64>,
    /// dF/dδ of all pairs in contact per mm of face width, no number where the model does not give it.
    pub new_N_per_mm_um: Vec<f64>,
    /// Mesh stiffness of the worn pair.
    pub worn_N_per_mm_um: Vec<f64>,
}

/// The stiffness over one pitch.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct OverPitch {
    pub pinion_rotation_deg: Vec<f64>,
    /// Per mm of face width.
    per_width_N_per_mm_um: Vec<f64>,
    /// Per mm of face width.
    pub mean_N_per_mm_um: f64,
}

impl OverPitch {
    /// Of the whole face width.
    pub(super) fn stiffness_N_per_mm(&self, face_width_mm: f64) -> impl Iterator<Item = f64> {
        // 1 N/µm is 1000 N/mm.
        self.per_width_N_per_mm_um.iter().map(move |per_width| per_width * face_width_mm * 1e3)
    }
}

impl MeshStiffness {
    /// New and worn; None where it is not known over a whole pitch.
    pub(super) fn over_pitch(&self, pinion_teeth: u32) -> [Option<OverPitch>; 2] {
        [&self.new_N_per_mm_um, &self.worn_N_per_mm_um].map(|stiffness| self.one_pitch(stiffness, pinion_teeth))
    }

    fn one_pitch(&self, stiffness: &[f64], pinion_teeth: u32) -> Option<OverPitch> {
        let pitch_deg = 360.0 / f64::from(pinion_teeth);
        let (first, last) = (self.pinion_rotation_deg.first()?, self.pinion_rotation_deg.last()?);
        let count = self.pinion_rotation_deg.iter().take_while(|&angle| angle - first < pitch_deg).count();
        let (rotation, stiffness) = (&self.pinion_rotation_deg[..count], stiffness.get(..count)?);
        let is_known = last - first >= pitch_deg && stiffness.iter().all(|value| *value > 0.0 && value.is_finite());
        if !is_known || rotation.windows(2).any(|pair| pair[0] >= pair[1]) {
            return None;
        }
        let next = (first + pitch_deg, stiffness[0]);
        let rows: Vec<(f64, f64)> = rotation.iter().copied().zip(stiffness.iter().copied()).chain([next]).collect();
        let area: f64 = rows.windows(2).map(|two| 0.5 * (two[1].0 - two[0].0) * (two[0].1 + two[1].1)).sum();
        Some(OverPitch {
            pinion_rotation_deg: rotation.to_vec(),
            per_width_N_per_mm_um: stiffness.to_vec(),
            mean_N_per_mm_um: area / pitch_deg,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sine about 20 N/(mm·µm) over a pitch of 20°, in rows that go on beyond it: its mean is 20, by the trapezoidal rule of evenly spaced
    /// rows of a whole period exactly.
    #[test]
    fn ver_mean_over_one_pitch() {
        let rotation: Vec<f64> = (0..33).map(|row| -7.0 + f64::from(row)).collect();
        let sine = |angle: &f64| 20.0 + 5.0 * (std::f64::consts::TAU * angle / 20.0).sin();
        let stiffness = MeshStiffness {
            new_N_per_mm_um: rotation.iter().map(sine).collect(),
            worn_N_per_mm_um: vec![f64::NAN; 33],
            pinion_rotation_deg: rotation,
        };
        let [new, worn] = stiffness.over_pitch(18);
        let new = new.unwrap();
        assert_eq!((new.pinion_rotation_deg.len(), worn), (20, None));
        assert!((new.mean_N_per_mm_um - 20.0).abs() < 1e-12, "{new:?}");
        let whole: Vec<f64> = new.stiffness_N_per_mm(14.0).collect();
        assert!((whole[7] - 20.0 * 14.0 * 1e3).abs() < 1e-6, "{whole:?}");
        // 33 rows are less than the pitch of a gear with ten teeth.
        assert_eq!(stiffness.over_pitch(10), [None, None]);
        assert_eq!(MeshStiffness::default().over_pitch(18), [None, None]);
    }
}
