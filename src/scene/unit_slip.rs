//! Values probably given in another unit: m for mm, N·mm for N·m, MPa for GPa.
//!
//! A value is suspected only where it is far outside what gears have *and* a plain change of unit brings it back.
//! Lengths are judged against the module, torque against the tooth load it makes. A suspicion is a warning, never an
//! error: the value may be meant.

use toml::{Table, Value};

use super::problem::number;
use super::table;

/// A suspected slip of unit.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct UnitSlip {
    /// Path of the key.
    pub key: String,
    /// Value as given.
    pub value: f64,
    /// Value likely meant, in the unit of the key.
    pub meant: f64,
    /// Units that were likely confused.
    pub units: &'static str,
}

impl UnitSlip {
    /// The question alone: `did you mean 4.5? (m given for mm)`.
    pub(super) fn question(&self) -> String {
        format!("did you mean {}? ({})", number(self.meant), self.units)
    }

    /// The whole warning.
    pub(super) fn warning(&self) -> String {
        format!("{} = {}: {}", self.key, number(self.value), self.question())
    }
}

/// A change of unit: what the value is multiplied by, and how to say it.
type Conversion = (f64, &'static str);

const METRES: Conversion = (1e3, "m given for mm");
const MICROMETRES: Conversion = (1e-3, "µm given for mm");
const MILLIMETRES: Conversion = (1e3, "mm given for µm");
const METRES_FOR_MICROMETRES: Conversion = (1e6, "m given for µm");

/// Greatest plausible tooth load over width and module, MPa; ISO 6336 rates a few hundred at most.
const GREATEST_TOOTH_LOAD_MPA: f64 = 5000.0;

/// All suspicions in a scene, its preset expanded.
pub(super) fn find(scene: &Table) -> Vec<UnitSlip> {
    let mut search = SlipSearch { scene, slips: Vec::new() };
    search.lengths();
    search.angles();
    search.operation();
    search.materials();
    search.contact_and_wear();
    search.lubrication();
    search.teeth_of_plastic();
    search.slips
}

/// Suspects Young's modulus of `key`.
pub(super) fn young_modulus(key: &str, modulus_gpa: f64) -> Option<UnitSlip> {
    let conversions = [(1e-3, "MPa given for GPa"), (1e-9, "Pa given for GPa")];
    judge(key, modulus_gpa, [0.0, 1500.0], [0.001, 1500.0], &conversions)
}

/// Suspects `value` if it lies outside `credible` and one of the conversions brings it into `usual`.
fn judge(key: &str, value: f64, credible: [f64; 2], usual: [f64; 2], conversions: &[Conversion]) -> Option<UnitSlip> {
    if !value.is_finite() || (credible[0]..=credible[1]).contains(&value.abs()) {
        return None;
    }
    conversions.iter().find_map(|&(factor, units)| {
        // Dividing by a power of ten rounds once; multiplying by its inverse would leave a trail of digits.
        let meant = if factor < 1.0 { value / (1.0 / factor).round() } else { value * factor };
        let meant: f64 = format!("{meant:.12e}").parse().unwrap_or(meant);
        (usual[0]..=usual[1]).contains(&meant.abs()).then(|| UnitSlip { key: key.to_owned(), value, meant, units })
    })
}

fn as_number(value: &Value) -> Option<f64> {
    match value {
        Value::Integer(n) => Some(*n as f64),
        Value::Float(x) => Some(*x),
        _ => None,
    }
}

struct SlipSearch<'a> {
    scene: &'a Table,
    slips: Vec<UnitSlip>,
}

impl SlipSearch<'_> {
    /// The number at `key`, if there is one.
    fn get(&self, key: &str) -> Option<f64> {
        let (path, last) = key.rsplit_once('.')?;
        let table = path.split('.').try_fold(self.scene, |table, name| table.get(name)?.as_table())?;
        as_number(table.get(last)?)
    }

    /// Suspects each value of the list `key` as [`judge`] does.
    fn judge_list(&mut self, key: &str, credible: [f64; 2], usual: [f64; 2], conversions: &[Conversion]) {
        let Some((path, last)) = key.rsplit_once('.') else { return };
        let table = path.split('.').try_fold(self.scene, |table, name| table.get(name)?.as_table());
        let values = table.and_then(|table| table.get(last)?.as_array()).into_iter().flatten().filter_map(as_number);
        let slips = values
            .enumerate()
            .filter_map(|(index, value)| judge(&format!("{key}[{index}]"), value, credible, usual, conversions));
        self.slips.extend(slips);
    }

    /// Suspects the value of `key` as [`judge`] does.
    fn judge(&mut self, key: &str, credible: [f64; 2], usual: [f64; 2], conversions: &[Conversion]) {
        let slip = self.get(key).and_then(|value| judge(key, value, credible, usual, conversions));
        self.slips.extend(slip);
    }

    /// The module in mm, as given or as it was likely meant.
    fn module_mm(&self) -> Option<f64> {
        let (key, given) = ["pair.normal_module_mm", "pair.transverse_module_mm"]
            .into_iter()
            .find_map(|key| Some((key, self.get(key)?)))?;
        let slip = self.slips.iter().find(|slip| slip.key == key);
        Some(slip.map_or(given, |slip| slip.meant))
    }

    fn lengths(&mut self) {
        for key in ["pair.normal_module_mm", "pair.transverse_module_mm"] {
            self.judge(key, [0.04, 150.0], [0.04, 150.0], &[METRES, MICROMETRES]);
        }
        let Some(module) = self.module_mm() else { return };
        let teeth = [self.get("pair.pinion.teeth"), self.get("pair.wheel.teeth")];
        if let [Some(z1), Some(z2)] = teeth {
            let internal = table::at(self.scene, "pair.wheel.internal").and_then(Value::as_bool) == Some(true);
            let reference = module * if internal { z2 - z1 } else { z1 + z2 } / 2.0;
            let close = [0.6 * reference, 1.7 * reference];
            self.judge("pair.centre_distance_mm", [0.1 * reference, 10.0 * reference], close, &[METRES, MICROMETRES]);
        }
        for key in ["pair.backlash_um", "pair.normal_backlash_um"] {
            // Some hundredths of the module are usual.
            if self.get(key) != Some(0.0) {
                let conversions = [MILLIMETRES, METRES_FOR_MICROMETRES];
                self.judge(key, [0.3 * module, 1e3 * module], [2.0 * module, 500.0 * module], &conversions);
            }
        }
        let width = [0.05 * module, 1000.0 * module];
        self.judge("pair.face_width_mm", width, [module, 100.0 * module], &[METRES, MICROMETRES]);
        for (gear, teeth) in ["pinion", "wheel"].into_iter().zip(teeth) {
            if let Some(teeth) = teeth {
                self.diameters(gear, teeth, module);
            }
            self.modifications(gear, module);
        }
    }

    /// Diameters of a gear with `z` teeth, and its web.
    fn diameters(&mut self, gear: &str, z: f64, module: f64) {
        let (credible, usual) = ([0.05 * z * module, 20.0 * z * module], [0.5 * z * module, 2.0 * z * module]);
        for key in ["tip_diameter_mm", "tip_relief.begins_at_diameter_mm", "root_relief.begins_at_diameter_mm"] {
            self.judge(&format!("pair.{gear}.{key}"), credible, usual, &[METRES, MICROMETRES]);
        }
        for key in ["bore_diameter_mm", "shaft.diameter_mm"] {
            self.judge(&format!("pair.{gear}.{key}"), [0.02 * module, 20.0 * z * module], usual, &[METRES]);
        }
        let (credible, usual) = ([0.01 * z * module, 2.0 * z * module], [0.1 * z * module, 0.6 * z * module]);
        self.judge(&format!("fem.clamp_radius_mm.{gear}"), credible, usual, &[METRES, MICROMETRES]);
        for key in ["fem.web.GEAR.thickness_mm", "fem.web.GEAR.rim_thickness_mm", "pair.GEAR.rim_thickness_mm"] {
            let (credible, usual) = ([0.02 * module, 20.0 * z * module], [0.5 * module, 20.0 * module]);
            self.judge(&key.replace("GEAR", gear), credible, usual, &[METRES, MICROMETRES]);
        }
    }

    fn modifications(&mut self, gear: &str, module: f64) {
        // A relief of some millionths of the module has no effect; one of the whole module leaves no tooth.
        let (credible, usual) = ([0.02 * module, 1e3 * module], [0.1 * module, 50.0 * module]);
        for key in [
            "tip_relief.amount_um",
            "root_relief.amount_um",
            "end_relief.amount_um",
            "profile_crowning_um",
            "profile_slope_deviation_um",
            "lead_crowning_um",
        ] {
            let key = format!("pair.{gear}.{key}");
            if self.get(&key) != Some(0.0) {
                self.judge(&key, credible, usual, &[MILLIMETRES, METRES_FOR_MICROMETRES]);
            }
        }
        let (credible, usual) = ([0.01 * module, 20.0 * module], [0.05 * module, 5.0 * module]);
        for key in ["tip_relief.length_mm", "root_relief.length_mm"] {
            self.judge(&format!("pair.{gear}.{key}"), credible, usual, &[METRES, MICROMETRES]);
        }
    }

    fn angles(&mut self) {
        let degrees = 1.0_f64.to_degrees();
        for key in ["pair.pressure_angle_deg", "pair.transverse_pressure_angle_deg"] {
            let Some(value) = self.get(key) else { continue };
            let meant = (value * degrees * 10.0).round() / 10.0;
            if value < 1.0 && (10.0..=45.0).contains(&meant) {
                self.slips.push(UnitSlip { key: key.to_owned(), value, meant, units: "rad given for degrees" });
            }
        }
    }

    fn operation(&mut self) {
        if let (Some(module), Some(z1), Some(width)) =
            (self.module_mm(), self.get("pair.pinion.teeth"), self.get("pair.face_width_mm"))
            && !self.slips.iter().any(|slip| slip.key == "pair.face_width_mm")
        {
            // F_t/(b m) = 2000 T/(z m² b): the torque in N·m that makes a tooth load of 1 MPa.
            let torque_per_mpa = z1 * module * module * width / 2000.0;
            let usual = [1e-3 * torque_per_mpa, GREATEST_TOOTH_LOAD_MPA / 5.0 * torque_per_mpa];
            let credible = [0.0, GREATEST_TOOTH_LOAD_MPA * torque_per_mpa];
            let conversions = [(1e-3, "N·mm given for N·m")];
            self.judge("operation.pinion_torque_Nm", credible, usual, &conversions);
            let phases = self.scene.get("operation").and_then(|operation| operation.get("phases"));
            for (index, phase) in phases.and_then(Value::as_array).into_iter().flatten().enumerate() {
                let key = format!("operation.phases[{index}].pinion_torque_Nm");
                let torque = phase.get("pinion_torque_Nm").and_then(as_number);
                self.slips.extend(torque.and_then(|torque| judge(&key, torque, credible, usual, &conversions)));
            }
        }
        if let Some(module) = self.module_mm() {
            // A life ends after some hundredths or tenths of the module.
            let (credible, usual) = ([0.25 * module, 1e3 * module], [2.0 * module, 500.0 * module]);
            let conversions = [MILLIMETRES, METRES_FOR_MICROMETRES];
            self.judge("operation.stop.wear_um", credible, usual, &conversions);
            let (credible, usual) = ([0.01 * module, 5.0 * module], [0.05 * module, module]);
            self.judge("operation.stop.tip_thickness_mm", credible, usual, &[METRES, MICROMETRES]);
        }
        let hours = [0.0, 2e5];
        self.judge(
            "operation.hours",
            hours,
            hours,
            &[(1.0 / 3600.0, "s given for h"), (1.0 / 60.0, "min given for h")],
        );
    }

    fn materials(&mut self) {
        for table in ["material", "material.pinion", "material.wheel"] {
            let curve = format!("{table}.young_modulus_curve.young_modulus_GPa");
            self.judge_list(
                &curve,
                [0.0, 300.0],
                [0.05, 300.0],
                &[(1e-3, "MPa given for GPa"), (1e-9, "Pa given for GPa")],
            );
            let key = format!("{table}.young_modulus_GPa");
            let slip = self.get(&key).and_then(|modulus_gpa| young_modulus(&key, modulus_gpa));
            self.slips.extend(slip);
            let conversions = [(1e3, "g/cm³ given for kg/m³"), (1e12, "t/mm³ given for kg/m³")];
            self.judge(&format!("{table}.density_kg_per_m3"), [50.0, 1e5], [500.0, 25e3], &conversions);
        }
    }

    fn lubrication(&mut self) {
        for gear in ["pinion", "wheel"] {
            for key in ["roughness_Ra_um", "roughness_run_in_Ra_um", "roughness_Rq_um"] {
                let conversions = [MILLIMETRES, METRES_FOR_MICROMETRES];
                self.judge(&format!("pair.{gear}.{key}"), [0.005, 20.0], [0.01, 10.0], &conversions);
            }
        }
        let conversions = [(1e6, "m²/s given for mm²/s, which is cSt")];
        self.judge("lubricant.viscosity_40C_mm2_per_s", [2.0, 1e5], [5.0, 5e3], &conversions);
        self.judge("lubricant.viscosity_100C_mm2_per_s", [1.0, 1e4], [2.0, 500.0], &conversions);
        let conversions = [(1e9, "1/Pa given for 1/GPa"), (1e3, "1/MPa (mm²/N) given for 1/GPa")];
        self.judge("lubricant.pressure_viscosity_per_GPa", [2.0, 100.0], [3.0, 80.0], &conversions);
        self.judge_list("friction.table.slide_to_roll_ratio", [0.0, 2.0], [0.0, 2.0], &[(0.01, "% given for a ratio")]);
        let conversions = [(1e3, "g/cm³ given for kg/m³")];
        self.judge("lubricant.density_15C_kg_per_m3", [500.0, 2000.0], [500.0, 2000.0], &conversions);
    }

    fn teeth_of_plastic(&mut self) {
        let conversions = [(1e-6, "mm² given for m²"), (1e-4, "cm² given for m²")];
        self.judge("temperature.tooth.housing_area_m2", [1e-5, 20.0], [1e-3, 5.0], &conversions);
        let conversions = [(0.01, "% given for a part of 1")];
        self.judge("temperature.tooth.duty_cycle", [0.0, 1.0], [0.01, 1.0], &conversions);
    }

    fn contact_and_wear(&mut self) {
        let modulus_mpa = 1e3
            * ["material.young_modulus_GPa", "material.pinion.young_modulus_GPa"]
                .into_iter()
                .find_map(|key| self.get(key))
                .unwrap_or(206.0);
        if let Some(module) = self.module_mm() {
            // K/H is Young's modulus over a depth of some tenths of the module.
            let foundation = modulus_mpa / module;
            let conversions =
                [(1e3, "GPa/mm given for MPa/mm"), (1e-3, "MPa/m given for MPa/mm"), (1e-9, "Pa/m given for MPa/mm")];
            let (credible, usual) = ([0.05 * foundation, 5e3 * foundation], [0.5 * foundation, 5e2 * foundation]);
            self.judge("contact.foundation_MPa_per_mm", credible, usual, &conversions);
        }
        let conversions = [(1e-3, "N/mm² given for N/(mm·µm)"), (1e-9, "N/m² given for N/(mm·µm)")];
        self.judge("stiffness.pair_N_per_mm_um", [0.0, 500.0], [0.1, 100.0], &conversions);
        self.wear("wear", &[]);
        for gear in ["pinion", "wheel"] {
            self.wear(&format!("wear.{gear}"), &[gear]);
        }
    }

    /// The keys of a wear law in `table`, the one of `path` below `[wear]`.
    fn wear(&mut self, table: &str, path: &[&str]) {
        let both = self.scene.get("wear");
        let own = path.iter().fold(both, |at, name| at.and_then(|at| at.get(name)));
        let law = [own, both].into_iter().flatten().find_map(|table| table.get("law")?.as_str());
        // The coefficients k_r of the other laws have other sizes.
        if law == Some("archard") {
            let conversions = [(1e-6, "mm²/N given for m²/N"), (1e-9, "mm³/(N·m) given for m²/N")];
            self.judge(&format!("{table}.coefficient_m2_per_N"), [0.0, 1e-12], [1e-22, 3e-16], &conversions);
            let conversions = [(1e9, "m²/N given for mm³/(N·m)"), (1e3, "mm²/N given for mm³/(N·m)")];
            self.judge(&format!("{table}.coefficient_mm3_per_Nm"), [1e-13, f64::MAX], [1e-13, 1e-4], &conversions);
        }
        let conversions = [(1e3, "GPa given for MPa"), (1e-6, "Pa given for MPa")];
        self.judge(&format!("{table}.severe.above_MPa"), [5.0, 1e5], [100.0, 1e4], &conversions);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::presets;

    /// The slips of the fzg-c scene with one value exchanged.
    fn slips(key: &str, value: f64) -> Vec<UnitSlip> {
        let mut scene: Table = presets::PRESETS[0].text.parse().unwrap();
        let (path, last) = key.rsplit_once('.').unwrap();
        let table = path.split('.').fold(&mut scene, |table, name| {
            table.entry(name).or_insert_with(|| Value::Table(Table::new())).as_table_mut().unwrap()
        });
        table.insert(last.to_owned(), Value::Float(value));
        find(&scene)
    }

    #[test]
    fn usual_slips_are_named() {
        for (key, value, meant) in [
            ("pair.normal_module_mm", 0.0045, 4.5),
            ("pair.centre_distance_mm", 0.0915, 91.5),
            ("pair.face_width_mm", 0.014, 14.0),
            ("pair.pinion.tip_diameter_mm", 0.08246, 82.46),
            ("pair.pinion.tip_relief.amount_um", 0.02, 20.0),
            ("pair.pinion.tip_relief.begins_at_diameter_mm", 0.0801, 80.1),
            ("pair.backlash_um", 0.15, 150.0),
            ("pair.pressure_angle_deg", 0.349, 20.0),
            ("operation.pinion_torque_Nm", 302_000.0, 302.0),
            ("operation.hours", 459_900.0, 127.75),
            ("operation.stop.wear_um", 0.1, 100.0),
            ("operation.stop.tip_thickness_mm", 400.0, 0.4),
            ("fem.clamp_radius_mm.pinion", 0.01994, 19.94),
            ("material.young_modulus_GPa", 206_000.0, 206.0),
            ("material.young_modulus_GPa", 2.06e11, 206.0),
            ("material.density_kg_per_m3", 7.83, 7830.0),
            ("contact.foundation_MPa_per_mm", 5.4e14, 5.4e5),
            ("stiffness.pair_N_per_mm_um", 20_000.0, 20.0),
            ("wear.coefficient_m2_per_N", 1e-11, 1e-17),
            ("wear.coefficient_m2_per_N", 1e-8, 1e-17),
            ("wear.coefficient_mm3_per_Nm", 1e-17, 1e-8),
            ("wear.severe.above_MPa", 2e9, 2000.0),
            ("pair.pinion.roughness_Ra_um", 5e-4, 0.5),
            ("lubricant.viscosity_40C_mm2_per_s", 2.2e-4, 220.0),
            ("lubricant.pressure_viscosity_per_GPa", 2e-8, 20.0),
        ] {
            let found = slips(key, value);
            assert!(found.iter().any(|s| s.key == key && s.meant == meant), "{key} = {value:e}: {found:?}");
            assert_eq!(found.len(), 1, "{key}: {found:?}");
        }
    }

    #[test]
    fn unusual_but_credible_values_pass() {
        for (key, value) in [
            ("pair.face_width_mm", 0.5),
            ("pair.centre_distance_mm", 93.0),
            ("operation.pinion_torque_Nm", 1e-6),
            ("operation.pinion_torque_Nm", 2000.0),
            ("operation.hours", 1e5),
            ("operation.stop.wear_um", 5.0),
            ("material.young_modulus_GPa", 0.001),
            ("material.young_modulus_GPa", 1000.0),
            ("wear.coefficient_m2_per_N", 1e-13),
            ("stiffness.pair_N_per_mm_um", 0.2),
        ] {
            assert_eq!(slips(key, value), [], "{key} = {value}");
        }
    }
}
