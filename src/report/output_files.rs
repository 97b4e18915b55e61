//! Names of the output files that several commands write or read.

/// The page.
pub const PAGE: &str = "report.html";
/// Main figures, written last.
pub const SUMMARY: &str = "summary.json";
/// The whole result to the bit.
pub const RECORD: &str = "record.bin";
/// The resolved scene.
pub const SCENE: &str = "scene.toml";
/// The resolved problem of finite elements.
pub const PROBLEM: &str = "problem.toml";
/// Displacement and stress of finite elements.
pub const SOLUTION: &str = "solution.vtu";
/// The pinion’s flank, point by point.
pub const PINION: &str = "pinion.csv";
/// The wheel’s flank, point by point.
pub const WHEEL: &str = "wheel.csv";
/// The snapshots.
pub const HISTORY: &str = "history.csv";
/// Both flanks at every snapshot.
pub const PROFILES: &str = "profiles.csv";
/// The mesh cycle, position by position.
pub const MESH_CYCLE: &str = "mesh_cycle.csv";
/// Load of every slice over the mesh; only where sections differ.
pub const SLICES: &str = "slices.csv";
/// Films and friction along the path of contact; only where asked for.
pub const FILM: &str = "film.csv";
/// Transmission error over torque; only where asked for.
pub const TORQUE_CURVE: &str = "torque_curve.csv";
/// Both flanks in space.
pub const FLANK: &str = "flank.vtu";
/// Both flanks in space at every snapshot; only where asked for.
pub const SERIES: &str = "flank.pvd";
/// Meaning of the columns of the tables.
pub const COLUMNS: &str = "columns.json";
/// Gap and pressure along the contacts of a problem.
pub const CONTACT: &str = "contact.csv";
/// Pressure along the flank at positions of a pair of finite elements.
pub const PRESSURE: &str = "pressure.csv";
