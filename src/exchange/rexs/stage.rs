//! The two gears of a cylindrical stage, with what their file says or determines of them.

use super::RexsError;
use super::axes::{self, Axes};
use super::document::{DEG, MM, NONE, RexsComponent, RexsDocument, UM};
use super::drivetrain::Drivetrain;
use super::modifications::{self, Modifications};
use super::profile_shift::{self, Known};
use super::roles::Roles;

/// A stage and its gears, as the file numbers them.
#[derive(Debug)]
pub(super) struct RexsStage<'a> {
    pub component: &'a RexsComponent,
    pub gears: [&'a RexsComponent; 2],
}

/// A number of the file, or one that it determines.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Figure {
    pub value: f64,
    /// What it is derived from; None where it stands in the file.
    pub how: Option<String>,
}

impl Figure {
    pub(super) fn of_file(value: f64) -> Self {
        Self { value, how: None }
    }

    pub(super) fn derived(value: f64, how: &str) -> Self {
        Self { value, how: Some(how.to_owned()) }
    }
}

/// The pair; what the file does not determine is None.
#[derive(Debug)]
pub(super) struct Gears<'a> {
    pub normal_module_mm: Option<Figure>,
    pub pressure_angle_deg: Option<Figure>,
    /// With the sign of the pinion.
    pub helix_angle_deg: Figure,
    pub centre_distance_mm: Option<Figure>,
    pub face_width_mm: Option<Figure>,
    pub dedendum_factor: Option<f64>,
    pub roles: Roles,
    pub pinion: GearData<'a>,
    pub wheel: GearData<'a>,
}

/// One gear with its working flank.
#[derive(Debug)]
pub(super) struct GearData<'a> {
    pub component: &'a RexsComponent,
    /// Data of this gear in the stage, where the file has them.
    pub in_stage: Option<&'a RexsComponent>,
    pub teeth: Option<u32>,
    pub profile_shift: Option<Figure>,
    pub tip_diameter_mm: Option<f64>,
    pub thickness_allowance_um: Option<f64>,
    pub tip_chamfer_mm: Option<f64>,
    pub roughness_Ra_um: Option<f64>,
    pub modifications: Modifications,
}

/// A gear and its flanks, the working one first.
#[derive(Clone, Copy)]
struct Flanked<'a> {
    gear: &'a RexsComponent,
    in_stage: Option<&'a RexsComponent>,
    working: Option<&'a RexsComponent>,
    other: Option<&'a RexsComponent>,
}

impl<'a> RexsStage<'a> {
    /// All stages of two cylindrical gears, in the order of the file.
    fn all(document: &'a RexsDocument) -> impl Iterator<Item = Result<Self, &'a RexsComponent>> {
        let stages = document.components.iter().filter(|component| component.is_stage());
        stages.map(|component| {
            let relation = document
                .relation("stage", &[("stage", &component.id)])
                .filter(|_| component.kind == "cylindrical_stage");
            let gears = ["gear_1", "gear_2"].map(|role| document.component(relation?.member(role)?));
            match gears {
                [Some(first), Some(second)] if [first, second].iter().all(|gear| gear.kind == "cylindrical_gear") => {
                    Ok(RexsStage { component, gears: [first, second] })
                }
                _ => Err(component),
            }
        })
    }

    /// The `number`-th stage of two cylindrical gears, from 1; the only one without a number. Warns of others that are not in the model.
    pub(super) fn find(
        document: &'a RexsDocument,
        number: Option<usize>,
        warnings: &mut Vec<String>,
    ) -> Result<Self, RexsError> {
        let (mut stages, mut others) = (Vec::new(), Vec::new());
        for stage in Self::all(document) {
            match stage {
                Ok(stage) => stages.push(stage),
                Err(component) => others.extend(reason(document, component)),
            }
        }
        let index = match number {
            None if stages.len() == 1 => Some(0),
            None => None,
            Some(number) => number.checked_sub(1).filter(|&index| index < stages.len()),
        };
        match index {
            Some(index) => {
                warnings.append(&mut others);
                Ok(stages.swap_remove(index))
            }
            None => {
                let names = stages.iter().enumerate().map(|(index, stage)| {
                    let teeth = stage.gears.map(|gear| gear.text("number_of_teeth").unwrap_or("?")).join("/");
                    format!("{} ({}, {teeth} teeth)", index + 1, stage.component.label())
                });
                Err(RexsError::Stage { asked: number, stages: names.collect(), others })
            }
        }
    }

    /// Data of one gear, where the stage gives them.
    pub(super) fn data_of(&self, document: &'a RexsDocument, gear: &RexsComponent) -> Option<&'a RexsComponent> {
        let relation = document.relation("stage_gear_data", &[("stage", &self.component.id), ("gear", &gear.id)])?;
        document.component(relation.member("stage_gear_data")?)
    }

    /// Both gears; the driving one is the pinion.
    pub(super) fn gears(
        &self,
        document: &'a RexsDocument,
        train: &Drivetrain<'a>,
        warnings: &mut Vec<String>,
    ) -> Result<Gears<'a>, RexsError> {
        let roles = Roles::of(document, train, self, warnings)?;
        let [pinion, wheel] = [roles.pinion_side, 1 - roles.pinion_side].map(|side| self.gears[side]);
        let pinion = self.flanked(document, pinion, warnings);
        let wheel = self.flanked(document, wheel, warnings);

        let normal_module_mm =
            common("normal_module", [pinion.gear, wheel.gear], |gear| gear.number("normal_module", MM))?;
        let flanks = [&pinion, &wheel].map(|of| of.working.or(of.other).unwrap_or(of.gear));
        let pressure_angle_deg =
            common("normal_pressure_angle", flanks, |flank| flank.number("normal_pressure_angle", DEG))?;
        let helix_angle_deg = self.helix_angle_deg(pinion.gear, wheel.gear)?;
        let centre_distance_mm = self.centre_distance_mm(document)?;
        let face_width_mm = match self.component.number("common_face_width", MM)? {
            Some(width_mm) => Some(Figure::of_file(width_mm)),
            None => match [pinion.gear.number("face_width", MM)?, wheel.gear.number("face_width", MM)?] {
                [Some(one_mm), Some(other_mm)] => Some(Figure::of_file(one_mm.min(other_mm))),
                [one, other] => {
                    one.or(other).map(|width_mm| Figure::derived(width_mm, "that of one gear; the other has none"))
                }
            },
        };
        let section = match (&normal_module_mm, &pressure_angle_deg) {
            (Some(module), Some(angle)) => Some(NormalSection {
                normal_module_mm: module.value,
                pressure_angle_deg: angle.value,
                helix_angle_deg: helix_angle_deg.value,
            }),
            _ => None,
        };
        let mut pinion_data = pinion.data(document, section.as_ref(), warnings)?;
        let mut wheel_data = wheel.data(document, section.as_ref(), warnings)?;
        if let (Some(section), Some(distance), Some(z1), Some(z2)) =
            (&section, &centre_distance_mm, pinion_data.teeth, wheel_data.teeth)
        {
            let known = [(z1, &pinion_data), (z2, &wheel_data)]
                .map(|(teeth, data)| Known { teeth: f64::from(teeth), tip_diameter_mm: data.tip_diameter_mm });
            let shifts = [pinion_data.profile_shift.take(), wheel_data.profile_shift.take()];
            [pinion_data.profile_shift, wheel_data.profile_shift] =
                profile_shift::complete(section, distance.value, known, shifts);
        }
        let dedendum_factor = match &section {
            Some(section) => {
                let factors = [(&pinion, &pinion_data), (&wheel, &wheel_data)]
                    .map(|(of, data)| section.dedendum_factor(of, data));
                one_rack(factors, warnings)?
            }
            None => None,
        };
        Ok(Gears {
            normal_module_mm,
            pressure_angle_deg,
            helix_angle_deg,
            centre_distance_mm,
            face_width_mm,
            dedendum_factor,
            roles,
            pinion: pinion_data,
            wheel: wheel_data,
        })
    }

    /// Data of the ring of the planetary stage that this one is a mesh of.
    pub(super) fn ring_data(
        &self,
        document: &'a RexsDocument,
        ring: &'a RexsComponent,
        section: Option<&NormalSection>,
        warnings: &mut Vec<String>,
    ) -> Result<GearData<'a>, RexsError> {
        self.flanked(document, ring, warnings).data(document, section, warnings)
    }

    /// That of the pinion; of spur gears 0.
    fn helix_angle_deg(&self, pinion: &RexsComponent, wheel: &RexsComponent) -> Result<Figure, RexsError> {
        let [own_deg, of_wheel_deg] = [pinion, wheel].map(|gear| gear.number("helix_angle_reference_diameter", DEG));
        match (own_deg?, of_wheel_deg?) {
            (Some(own_deg), Some(of_wheel_deg)) if (own_deg + of_wheel_deg).abs() > 1e-6 => {
                let allowed =
                    format!("{} for external gears on parallel axes; crossed axes are not in the model", 0.0 - own_deg);
                Err(wheel.wrong("helix_angle_reference_diameter", of_wheel_deg.to_string(), allowed))
            }
            (Some(own_deg), _) => Ok(Figure::of_file(own_deg)),
            (None, Some(of_wheel_deg)) => Ok(Figure::derived(0.0 - of_wheel_deg, "against that of the other gear")),
            (None, None) => Ok(Figure::of_file(0.0)),
        }
    }

    /// As given, otherwise the distance of both axes.
    fn centre_distance_mm(&self, document: &RexsDocument) -> Result<Option<Figure>, RexsError> {
        let given = self.component.number("center_distance", MM)?;
        match (given, axes::of(document, self.gears)) {
            (_, Some(Axes::Crossed)) => Err(self.component.wrong(
                "u_axis_vector",
                "axes of its gears that cross".to_owned(),
                "parallel axes: crossed axes are not in the model".to_owned(),
            )),
            (Some(distance_mm), _) => Ok(Some(Figure::of_file(distance_mm))),
            (None, Some(Axes::Parallel(distance_mm))) => {
                Ok(Some(Figure::derived(distance_mm, "the distance of both axes (support_vector)")))
            }
            (None, None) => Ok(None),
        }
    }

    /// A gear with its flanks: the loaded one first, the left one where the file does not say.
    fn flanked(&self, document: &'a RexsDocument, gear: &'a RexsComponent, warnings: &mut Vec<String>) -> Flanked<'a> {
        let in_stage = self.data_of(document, gear);
        let relation = document.relation("flank", &[("gear", &gear.id)]);
        let [left, right] = ["left", "right"].map(|role| document.component(relation?.member(role)?));
        let said = in_stage.and_then(|data| document.word(data, "loaded_tooth_flank"));
        if said.is_none() && left.is_some() && right.is_some() {
            warnings
                .push(format!("{}: the file does not say which flank is loaded: the left one is taken", gear.label()));
        }
        let angles = [left, right].map(|flank| flank?.number("normal_pressure_angle", DEG).ok()?);
        if let [Some(left_deg), Some(right_deg)] = angles
            && (left_deg - right_deg).abs() > 1e-6
        {
            warnings.push(format!(
                "{}: asymmetric teeth are not in the model: both flanks get the pressure angle of the working one, not {left_deg}° and {right_deg}°",
                gear.label()
            ));
        }
        let (working, other) = if said == Some("right") { (right, left) } else { (left, right) };
        Flanked { gear, in_stage, working: working.or(other), other: other.filter(|_| working.is_some()) }
    }
}

/// Why a stage that is not of two external cylindrical gears is left out.
fn reason(document: &RexsDocument, stage: &RexsComponent) -> Option<String> {
    let relation = document.relation("stage", &[("stage", &stage.id)])?;
    let gears = ["gear_1", "gear_2"].map(|role| document.component(relation.member(role)?));
    let has_ring = gears.iter().flatten().any(|gear| gear.kind == "ring_gear");
    let meets_a_sun = |planet: &RexsComponent| {
        let mut stages = RexsStage::all(document).filter_map(Result::ok);
        stages.any(|stage| stage.gears.iter().any(|gear| gear.id == planet.id))
    };
    if has_ring && gears.into_iter().flatten().any(meets_a_sun) {
        // Read with the mesh of sun and planet.
        return None;
    }
    let why = if has_ring {
        "pairs with a ring gear are read as those of planetary stages, and no sun meets its planet"
    } else if stage.kind.starts_with("bevel") || stage.kind.starts_with("worm") {
        "bevel and worm gears are not in the model"
    } else {
        "it is not of two cylindrical gears"
    };
    Some(format!("{} is left out: {why}", stage.label()))
}

/// The rack of both gears.
fn one_rack(
    factors: [Result<Option<f64>, RexsError>; 2],
    warnings: &mut Vec<String>,
) -> Result<Option<f64>, RexsError> {
    let [own, other] = factors;
    match (own?, other?) {
        (Some(own), Some(other)) if (own - other).abs() > 0.005 => {
            warnings.push(format!(
                "the root diameters belong to two basic racks, dedendum factors {own:.4} and {other:.4}; a scene has one: that of the pinion is taken"
            ));
            Ok(Some(own))
        }
        (own, other) => Ok(own.or(other)),
    }
}

/// The normal section that both gears share.
#[derive(Debug)]
pub(super) struct NormalSection {
    pub normal_module_mm: f64,
    pub pressure_angle_deg: f64,
    pub helix_angle_deg: f64,
}

impl NormalSection {
    pub(super) fn transverse_pressure_angle_rad(&self) -> f64 {
        (self.pressure_angle_deg.to_radians().tan() / self.helix_angle_deg.to_radians().cos()).atan()
    }

    /// d = z m_n / cos β.
    pub(super) fn reference_diameter_mm(&self, teeth: f64) -> f64 {
        teeth * self.normal_module_mm / self.helix_angle_deg.to_radians().cos()
    }

    /// d_b = d cos α_t (ISO 21771).
    fn base_diameter_mm(&self, teeth: f64) -> f64 {
        self.reference_diameter_mm(teeth) * self.transverse_pressure_angle_rad().cos()
    }

    /// h_fP* of the rack whose root circle is the file's: d_f = d + 2 m_n (x_E − h_fP*).
    fn dedendum_factor(&self, of: &Flanked, data: &GearData) -> Result<Option<f64>, RexsError> {
        let (Some(root_mm), Some(teeth)) = (of.gear.number("root_diameter", MM)?, data.teeth) else { return Ok(None) };
        let finished = of.number("addendum_modification_coefficient_after_finishing", NONE)?;
        let shift = finished.or(data.profile_shift.clone()).map(|figure| figure.value);
        let Some(shift) = shift else { return Ok(None) };
        let reference_mm = self.reference_diameter_mm(f64::from(teeth));
        let factor = 0.5 * (reference_mm - root_mm) / self.normal_module_mm + shift;
        if factor > 0.0 && factor <= 3.0 {
            return Ok(Some(factor));
        }
        let allowed = "a root circle at most three modules within the shifted reference circle".to_owned();
        Err(of.gear.wrong("root_diameter", format!("{root_mm} mm"), allowed))
    }
}

impl<'a> Flanked<'a> {
    /// A number of the working flank, otherwise of the other one.
    fn number(&self, id: &str, units: super::document::Units) -> Result<Option<Figure>, RexsError> {
        for (flank, how) in [(self.working, None), (self.other, Some("that of the other flank"))] {
            if let Some(value) = flank.map(|flank| flank.number(id, units)).transpose()?.flatten() {
                return Ok(Some(Figure { value, how: how.map(str::to_owned) }));
            }
        }
        Ok(None)
    }

    fn data(
        &self,
        document: &RexsDocument,
        section: Option<&NormalSection>,
        warnings: &mut Vec<String>,
    ) -> Result<GearData<'a>, RexsError> {
        let gear = self.gear;
        // Of rings with either sign.
        let is_ring = gear.kind == "ring_gear";
        let number = gear.number("number_of_teeth", NONE)?.map(|number| if is_ring { number.abs() } else { number });
        if let Some(number) = number.filter(|number| !(1.0..=1e4).contains(number) || number.fract() != 0.0) {
            let allowed = "a whole number, positive: external gears, unless it is a ring_gear".to_owned();
            return Err(gear.wrong("number_of_teeth", number.to_string(), allowed));
        }
        let profile_shift = self.profile_shift(section)?;
        let base_mm = section.zip(number).map(|(section, teeth)| section.base_diameter_mm(teeth));
        let tip_mm = gear.number("tip_diameter", MM)?.map(|tip_mm| if is_ring { tip_mm.abs() } else { tip_mm });
        let tip_diameter_mm = tip_mm.filter(|&tip_mm| {
            let base_mm = base_mm.unwrap_or(0.0);
            let fits = tip_mm > base_mm;
            if !fits {
                warnings.push(format!(
                    "{}: tip_diameter {tip_mm} mm lies within the base circle of {base_mm:.3} mm and is left out: the basic rack gives the tip circle",
                    gear.label()
                ));
            }
            fits
        });
        let chamfer_mm = self.working.map(|flank| flank.number("tooth_tip_chamfer", MM)).transpose()?.flatten();
        let roughness = gear.number("arithmetic_mean_roughness_flank_iso_4287_1997", UM)?;
        let modifications = match self.working {
            Some(flank) => modifications::of(document, flank, &gear.label(), warnings)?,
            None => Modifications::default(),
        };
        Ok(GearData {
            component: gear,
            in_stage: self.in_stage,
            teeth: number.map(|number| number as u32),
            thickness_allowance_um: match (section, &profile_shift) {
                (Some(section), Some(shift)) => self.thickness_allowance_um(section, shift.value)?,
                _ => None,
            },
            profile_shift,
            tip_diameter_mm,
            tip_chamfer_mm: chamfer_mm.filter(|&chamfer_mm| chamfer_mm > 0.0),
            roughness_Ra_um: roughness.filter(|&roughness_um| roughness_um > 0.0),
            modifications,
        })
    }

    /// As the flanks give it.
    fn profile_shift(&self, section: Option<&NormalSection>) -> Result<Option<Figure>, RexsError> {
        if let Some(factor) = self.number("addendum_modification_coefficient", NONE)? {
            return Ok(Some(factor));
        }
        if let (Some(shift_mm), Some(section)) = (self.number("addendum_modification", MM)?, section) {
            return Ok(Some(Figure { value: shift_mm.value / section.normal_module_mm, how: shift_mm.how }));
        }
        let finished = self.number("addendum_modification_coefficient_after_finishing", NONE)?;
        Ok(finished.map(|finished| Figure::derived(finished.value, "that after finishing")))
    }

    /// E_sn: from the profile shift of the finished gear, 2 (x_E − x) m_n tan α_n, or the mean of both allowances of the span over cos α_n
    /// (ISO 21771).
    fn thickness_allowance_um(&self, section: &NormalSection, shift: f64) -> Result<Option<f64>, RexsError> {
        let angle = section.pressure_angle_deg.to_radians();
        if let Some(finished) = self.number("addendum_modification_coefficient_after_finishing", NONE)? {
            return Ok(Some(2e3 * (finished.value - shift) * section.normal_module_mm * angle.tan()));
        }
        let upper = self.gear.number("upper_backlash_allowance_referenced_to_span", UM)?;
        let lower = self.gear.number("lower_backlash_allowance_referenced_to_span", UM)?;
        Ok(upper.zip(lower).map(|(upper_um, lower_um)| 0.5 * (upper_um + lower_um) / angle.cos()))
    }
}

/// A figure that both have alike, or that one has.
fn common(
    id: &str,
    [one, other]: [&RexsComponent; 2],
    of: impl Fn(&RexsComponent) -> Result<Option<f64>, RexsError>,
) -> Result<Option<Figure>, RexsError> {
    match (of(one)?, of(other)?) {
        (Some(value), Some(second)) if (value - second).abs() > 1e-9 * value.abs() => {
            Err(other.wrong(id, second.to_string(), format!("{value}, as of {}", one.label())))
        }
        (Some(value), Some(_)) => Ok(Some(Figure::of_file(value))),
        (one, other) => Ok(one.or(other).map(|value| Figure::derived(value, "that of one gear; the other has none"))),
    }
}
