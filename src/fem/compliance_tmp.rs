//! Temporary.
use super::factor::Factor;
impl Factor {
    /// Temporary.
    pub fn compliance(&self, columns: &[Vec<(u32, f64)>]) -> faer::Mat<f64> {
        let dofs = self.dofs();
        let n = columns.len();
        let mut c = faer::Mat::zeros(n, n);
        for (block, group) in columns.chunks(32).enumerate() {
            let mut x = vec![0.0; dofs * group.len()];
            for (column, own) in group.iter().zip(x.chunks_mut(dofs)) {
                for &(dof, value) in column {
                    own[dof as usize] += value;
                }
            }
            self.solve(group.len(), &mut x);
            for (k, own) in x.chunks(dofs).enumerate() {
                for (i, row) in columns.iter().enumerate() {
                    c[(i, 32 * block + k)] = row.iter().map(|&(dof, v)| v * own[dof as usize]).sum();
                }
            }
        }
        c
    }
}
