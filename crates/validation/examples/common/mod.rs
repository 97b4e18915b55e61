//! Measurement of a run in a process of its own: times and peak memory.

use std::error::Error;
use std::fs;
use std::process::Command;
use std::time::Instant;

use serde_json::{Value, json};

/// Wall time since `start`, processor time of this process, both s, and its peak memory, GB; null what the system does not say.
pub(crate) fn cost_since(start: Instant) -> Value {
    json!({ "wall_s": start.elapsed().as_secs_f64(), "processor_s": processor_s(), "memory_GB": peak_memory_gb() })
}

fn peak_memory_gb() -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(1e-6 * line.split_whitespace().next()?.parse::<f64>().ok()?)
}

fn processor_s() -> Option<f64> {
    /// Clock ticks a second, as the kernel counts them for programs.
    const TICKS: f64 = 100.0;
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    // The name of the program, in parentheses, may have spaces.
    let (_, fields) = stat.rsplit_once(") ")?;
    let mut times = fields.split_whitespace().skip(11).map_while(|ticks| ticks.parse::<f64>().ok());
    Some((times.next()? + times.next()?) / TICKS)
}

/// Output of this program with `args`, JSON; an error where it printed none.
pub(crate) fn in_its_own_process(args: &[&str], threads: usize) -> Result<Value, Box<dyn Error>> {
    let mut one = Command::new(std::env::current_exe()?);
    let output = one.args(args).env("RAYON_NUM_THREADS", threads.to_string()).output()?;
    Ok(serde_json::from_slice(&output.stdout)?)
}
