//! Frictionless segment-to-segment contact of meshed surfaces with dual mortar multipliers.
//!
//! The pressure is defined on the slave surface, λ(ξ) = Σ ψ_i λ_i. With n the outward normal of the slave and x_m(ξ) the
//! projection along n onto the master, the gap is g = n · (x_m − x_s), and each multiplier satisfies
//!
//! ```text
//! g_i = ∫ ψ_i g dγ / w_i ≥ 0,    λ_i ≥ 0,    λ_i g_i = 0,      w_i = ∫ ψ_i dγ
//! ```
//!
//! The virtual work of the pressure, ∫ λ n · (δu_m − δu_s) dγ, gives the nodal forces; it is the transpose of the gap's
//! change with displacement, so forces and moments balance exactly.
//!
//! Kinematics are linear with exact initial gap: normals and projections are those of the undeformed surfaces.
//!
//! Source: B. Wohlmuth, *Acta Numerica* 20 (2011) 569–734; A. Popp, M. Gitterle, M. Gee and W. Wall, *Int. J. Numer. Meth.
//! Eng.* 83 (2010) 1428–1465.

pub mod dual_basis;
pub mod edge;
pub mod master_search;
pub mod mortar;
pub mod overlap;
pub mod surface;
pub mod zones;
