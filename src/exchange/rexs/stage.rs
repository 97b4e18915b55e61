//! The two gears of a cylindrical stage.

use super::RexsError;
use super::document::{DEG, MM, NONE, RexsComponent, RexsDocument, UM};
use super::modifications::{self, Modifications};

/// A stage and its gears, as the file numbers them.
#[derive(Debug)]
pub(super) struct RexsStage<'a> {
    pub component: &'a RexsComponent,
    gears: [&'a RexsComponent; 2],
}

/// The pair, each figure common to both gears decided.
#[derive(Debug)]
pub(super) struct Gears<'a> {
    pub normal_module_mm: f64,
    pub pressure_angle_deg: f64,
    pub helix_angle_deg: f64,
    pub centre_distance_mm: f64,
    pub face_width_mm: f64,
    pub dedendum_factor: Option<f64>,
    pub pinion: GearData<'a>,
    pub wheel: GearData<'a>,
}

/// One gear with its working flank.
#[derive(Debug)]
pub(super) struct GearData<'a> {
    pub component: &'a RexsComponent,
    /// Data of this gear in the stage, where the file has them.
    pub in_stage: Option<&'a RexsComponent>,
    pub teeth: u32,
    pub profile_shift: f64,
    pub tip_diameter_mm: Option<f64>,
    pub thickness_allowance_um: Option<f64>,
    pub tip_chamfer_mm: Option<f64>,
    pub roughness_Ra_um: Option<f64>,
    pub modifications: Modifications,
}

impl<'a> RexsStage<'a> {
    /// The `number`-th stage of two cylindrical gears, from 1; the only one without a number.
    pub(super) fn find(document: &'a RexsDocument, number: Option<usize>) -> Result<Self, RexsError> {
        let stages: Vec<RexsStage> = document
            .components
            .iter()
            .filter(|component| component.kind == "cylindrical_stage")
            .filter_map(|component| {
                let relation = document.relation("stage", &[("stage", &component.id)])?;
                let [first, second] = ["gear_1", "gear_2"].map(|role| document.component(relation.member(role)?));
                let gears = [first?, second?];
                gears.iter().all(|gear| gear.kind == "cylindrical_gear").then_some(RexsStage { component, gears })
            })
            .collect();
        let index = match number {
            None if stages.len() == 1 => Some(0),
            None => None,
            Some(number) => number.checked_sub(1).filter(|&index| index < stages.len()),
        };
        match index {
            Some(index) => Ok(stages.into_iter().nth(index).expect("the index is that of a stage")),
            None => {
                let names = stages.iter().enumerate().map(|(index, stage)| {
                    let teeth = stage.gears.map(|gear| gear.text("number_of_teeth").unwrap_or("?")).join("/");
                    format!("{} ({}, {teeth} teeth)", index + 1, stage.component.label())
                });
                Err(RexsError::Stage { asked: number, stages: names.collect() })
            }
        }
    }

    /// Data of one gear, where the stage gives them.
    fn data_of(&self, document: &'a RexsDocument, gear: &RexsComponent) -> Option<&'a RexsComponent> {
        let relation = document.relation("stage_gear_data", &[("stage", &self.component.id), ("gear", &gear.id)])?;
        document.component(relation.member("stage_gear_data")?)
    }

    /// Both gears; the driving one is the pinion, gear_1 where the file does not say.
    pub(super) fn gears(&self, document: &'a RexsDocument, warnings: &mut Vec<String>) -> Result<Gears<'a>, RexsError> {
        let [first, second] = self.gears;
        let [first_drives, second_drives] =
            self.gears.map(|gear| Some(document.word(self.data_of(document, gear)?, "is_driving_gear")? == "true"));
        let (pinion, wheel) = match (first_drives, second_drives) {
            (Some(false), _) | (None, Some(true)) => (second, first),
            (Some(true), _) | (None, Some(false)) => (first, second),
            (None, None) => {
                warnings.push(format!("the file does not say which gear drives: {} is taken", first.label()));
                (first, second)
            }
        };
        let pinion_flank = working_flank(document, pinion, self.data_of(document, pinion), warnings)?;
        let wheel_flank = working_flank(document, wheel, self.data_of(document, wheel), warnings)?;

        let normal_module_mm = same(pinion, wheel, "normal_module", |gear| gear.needed("normal_module", MM))?;
        let pressure_angle_deg = same(pinion_flank, wheel_flank, "normal_pressure_angle", |flank| {
            flank.needed("normal_pressure_angle", DEG)
        })?;
        let [helix_angle_deg, of_wheel_deg] =
            [pinion, wheel].map(|gear| gear.number("helix_angle_reference_diameter", DEG));
        let (helix_angle_deg, of_wheel_deg) = (helix_angle_deg?.unwrap_or(0.0), of_wheel_deg?.unwrap_or(0.0));
        if (helix_angle_deg + of_wheel_deg).abs() > 1e-6 {
            let allowed = format!("{} for external gears on parallel axes", 0.0 - helix_angle_deg);
            return Err(wheel.wrong("helix_angle_reference_diameter", of_wheel_deg.to_string(), allowed));
        }
        let face_width_mm = match self.component.number("common_face_width", MM)? {
            Some(width) => width,
            None => pinion.needed("face_width", MM)?.min(wheel.needed("face_width", MM)?),
        };
        let section = NormalSectionData { normal_module_mm, pressure_angle_deg, helix_angle_deg };
        let pinion = section.gear(document, pinion, self.data_of(document, pinion), pinion_flank, warnings)?;
        let wheel = section.gear(document, wheel, self.data_of(document, wheel), wheel_flank, warnings)?;
        let dedendum_factor = match (
            section.dedendum_factor(&pinion, pinion_flank)?,
            section.dedendum_factor(&wheel, wheel_flank)?,
        ) {
            (Some(own), Some(other)) if (own - other).abs() > 0.005 => {
                warnings.push(format!(
                    "the root diameters belong to two basic racks, dedendum factors {own:.4} and {other:.4}; a scene has one: that of the pinion is taken"
                ));
                Some(own)
            }
            (own, other) => own.or(other),
        };
        Ok(Gears {
            normal_module_mm,
            pressure_angle_deg,
            helix_angle_deg,
            centre_distance_mm: self.component.needed("center_distance", MM)?,
            face_width_mm,
            dedendum_factor,
            pinion,
            wheel,
        })
    }
}

/// Data of the normal section that both gears share.
struct NormalSectionData {
    normal_module_mm: f64,
    pressure_angle_deg: f64,
    helix_angle_deg: f64,
}

impl NormalSectionData {
    fn gear<'a>(
        &self,
        document: &RexsDocument,
        gear: &'a RexsComponent,
        in_stage: Option<&'a RexsComponent>,
        flank: &RexsComponent,
        warnings: &mut Vec<String>,
    ) -> Result<GearData<'a>, RexsError> {
        let number = gear.needed("number_of_teeth", NONE)?;
        if !(1.0..=1e4).contains(&number) || number.fract() != 0.0 {
            let allowed = "a whole number, positive: external gears".to_owned();
            return Err(gear.wrong("number_of_teeth", number.to_string(), allowed));
        }
        let profile_shift = self.profile_shift(flank)?;
        let base_mm = self.base_diameter_mm(number);
        let tip_diameter_mm = gear.number("tip_diameter", MM)?.filter(|&tip_mm| {
            let fits = tip_mm > base_mm;
            if !fits {
                warnings.push(format!(
                    "{}: tip_diameter {tip_mm} mm lies within the base circle of {base_mm:.3} mm and is left out: the basic rack gives the tip circle",
                    gear.label()
                ));
            }
            fits
        });
        let roughness = match gear.number("arithmetic_average_roughness_flank", UM)? {
            None => gear.number("arithmetic_mean_roughness_flank_iso_4287_1997", UM)?,
            given => given,
        };
        Ok(GearData {
            component: gear,
            in_stage,
            teeth: number as u32,
            profile_shift,
            tip_diameter_mm,
            thickness_allowance_um: self.thickness_allowance_um(gear, flank, profile_shift)?,
            tip_chamfer_mm: flank.number("tooth_tip_chamfer", MM)?.filter(|&chamfer_mm| chamfer_mm > 0.0),
            roughness_Ra_um: roughness.filter(|&roughness_um| roughness_um > 0.0),
            modifications: modifications::of(document, flank, &gear.label(), warnings)?,
        })
    }

    fn profile_shift(&self, flank: &RexsComponent) -> Result<f64, RexsError> {
        match flank.number("addendum_modification_coefficient", NONE)? {
            Some(factor) => Ok(factor),
            None => match flank.number("addendum_modification", MM)? {
                Some(shift_mm) => Ok(shift_mm / self.normal_module_mm),
                None => Err(flank.missing("addendum_modification_coefficient")),
            },
        }
    }

    /// d_b = z m_n cos α_t / cos β (ISO 21771).
    fn base_diameter_mm(&self, teeth: f64) -> f64 {
        let cos_helix = self.helix_angle_deg.to_radians().cos();
        let transverse = (self.pressure_angle_deg.to_radians().tan() / cos_helix).atan();
        teeth * self.normal_module_mm / cos_helix * transverse.cos()
    }

    /// E_sn: from the profile shift of the finished gear, 2 (x_E − x) m_n tan α_n, or the mean of both allowances of the span over cos α_n
    /// (ISO 21771).
    fn thickness_allowance_um(
        &self,
        gear: &RexsComponent,
        flank: &RexsComponent,
        shift: f64,
    ) -> Result<Option<f64>, RexsError> {
        let angle = self.pressure_angle_deg.to_radians();
        if let Some(finished) = flank.number("addendum_modification_coefficient_after_finishing", NONE)? {
            return Ok(Some(2e3 * (finished - shift) * self.normal_module_mm * angle.tan()));
        }
        let upper = gear.number("upper_backlash_allowance_referenced_to_span", UM)?;
        let lower = gear.number("lower_backlash_allowance_referenced_to_span", UM)?;
        Ok(upper.zip(lower).map(|(upper_um, lower_um)| 0.5 * (upper_um + lower_um) / angle.cos()))
    }

    /// h_fP* of the rack whose root circle is the file's: d_f = d + 2 m_n (x_E − h_fP*).
    fn dedendum_factor(&self, gear: &GearData, flank: &RexsComponent) -> Result<Option<f64>, RexsError> {
        let Some(root_mm) = gear.component.number("root_diameter", MM)? else { return Ok(None) };
        let shift =
            flank.number("addendum_modification_coefficient_after_finishing", NONE)?.unwrap_or(gear.profile_shift);
        let reference_mm = f64::from(gear.teeth) * self.normal_module_mm / self.helix_angle_deg.to_radians().cos();
        let factor = 0.5 * (reference_mm - root_mm) / self.normal_module_mm + shift;
        if factor > 0.0 && factor <= 3.0 {
            return Ok(Some(factor));
        }
        let allowed = "a root circle at most three modules within the shifted reference circle".to_owned();
        Err(gear.component.wrong("root_diameter", format!("{root_mm} mm"), allowed))
    }
}

/// The flank that is loaded; the left one where the file does not say.
fn working_flank<'a>(
    document: &'a RexsDocument,
    gear: &RexsComponent,
    in_stage: Option<&RexsComponent>,
    warnings: &mut Vec<String>,
) -> Result<&'a RexsComponent, RexsError> {
    let relation = document.relation("flank", &[("gear", &gear.id)]);
    let [left, right] = ["left", "right"].map(|role| document.component(relation?.member(role)?));
    let said = in_stage.and_then(|data| document.word(data, "loaded_tooth_flank"));
    if said.is_none() && left.is_some() && right.is_some() {
        warnings.push(format!("{}: the file does not say which flank is loaded: the left one is taken", gear.label()));
    }
    let loaded = if said == Some("right") { right.or(left) } else { left.or(right) };
    loaded.ok_or_else(|| gear.missing("a relation to its flanks"))
}

/// A figure that both must have alike.
fn same(
    one: &RexsComponent,
    other: &RexsComponent,
    id: &'static str,
    of: impl Fn(&RexsComponent) -> Result<f64, RexsError>,
) -> Result<f64, RexsError> {
    let (value, second) = (of(one)?, of(other)?);
    if (value - second).abs() <= 1e-9 * value.abs() {
        Ok(value)
    } else {
        Err(other.wrong(id, second.to_string(), format!("{value}, as of {}", one.label())))
    }
}
