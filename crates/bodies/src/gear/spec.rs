//! Given data of a gear pair, as on a drawing.
//!
//! Profile shifts and rack factors are coefficients of the *normal* module (ISO 21771).
//!
//! A pair with an internal wheel has a negative number of teeth z there, and with it negative radii of the wheel and a negative centre distance (sign
//! convention of DIN 3960, in which ISO 21771 differs by positive diameters): all equations of external gears then hold. A profile shift is positive
//! where it moves the basic rack towards the tips, which are inside the reference circle of an internal gear.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use super::{
    involute::inv,
    measured_flank::MeasuredFlank,
    modification::Modification,
    per_gear::{Gear, PerGear},
    ring_fillet::RingSpec,
    shaft::Shaft,
    tip_chamfer::TipChamfer,
};

/// Basic rack that generates the teeth (ISO 53), as factors of the normal module.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BasicRack {
    /// Addendum factor h_aP*.
    pub addendum_factor: f64,
    /// Dedendum factor h_fP*.
    pub dedendum_factor: f64,
    /// Root fillet radius factor ρ_fP*.
    pub fillet_radius_factor: f64,
}

impl Default for BasicRack {
    /// Profile A of ISO 53: 1.0, 1.25, 0.38.
    fn default() -> Self {
        Self { addendum_factor: 1.0, dedendum_factor: 1.25, fillet_radius_factor: 0.38 }
    }
}

/// Given data of one gear.
#[derive(Debug, Clone, PartialEq)]
pub struct GearSpec {
    /// Number of teeth z.
    pub teeth: u32,
    /// Profile shift coefficient x, of the normal module.
    pub profile_shift: f64,
    /// Tip diameter d_a in mm, negative on an internal gear; `None` for that of the rack, reduced where the full tip clearance requires it.
    pub tip_diameter_mm: Option<f64>,
    /// Chamfer of the tip edges of both flanks; `None` where flanks end at the tip circle.
    pub tip_chamfer: Option<TipChamfer>,
    /// Tooth thickness allowance E_sn in mm in the normal section; negative thins the tooth.
    pub tooth_thickness_allowance_mm: f64,
    /// Bore diameter in mm.
    pub bore_diameter_mm: Option<f64>,
    /// Deliberate deviations from the involute.
    pub modification: Modification,
    /// Deviation of the flank as it was measured, beside the modification; finite-element meshes are without it.
    pub measured_flank: Option<Arc<MeasuredFlank>>,
    /// Shaft that twists under the torque over the face width; `None` for a rigid one.
    pub shaft: Option<Shaft>,
    /// Generation of internal teeth; `None` for external ones.
    pub ring: Option<RingSpec>,
}

impl GearSpec {
    /// Number of teeth z with the sign of ISO 21771, negative on an internal gear.
    pub fn z(&self) -> f64 {
        let teeth = f64::from(self.teeth);
        if self.ring.is_some() { -teeth } else { teeth }
    }
}

/// Deviations of the axes from parallel over the face width (ISO/TR 10064-3); positive ones open a gap between the working flanks towards the
/// full width.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AxisParallelism {
    /// Deviation f_Σδ in the common plane of the axes, mm.
    pub in_plane_mm: f64,
    /// Deviation f_Σβ across the common plane, mm.
    pub out_of_plane_mm: f64,
}

/// Given data of a pair.
#[derive(Debug, Clone, PartialEq)]
pub struct PairSpec {
    /// Normal module m_n in mm.
    pub normal_module_mm: f64,
    /// Normal pressure angle α_n in rad.
    pub normal_pressure_angle_rad: f64,
    /// Helix angle β at the reference cylinder in rad.
    pub helix_angle_rad: f64,
    /// Working centre distance a_w in mm, negative with an internal wheel.
    pub centre_distance_mm: f64,
    /// Common face width b in mm.
    pub face_width_mm: f64,
    /// Generating rack of both gears.
    pub rack: BasicRack,
    /// Deviations of the axes from parallel.
    pub axis_parallelism: AxisParallelism,
    /// Data of the gears.
    pub gears: PerGear<GearSpec>,
}

impl PairSpec {
    /// Transverse module m_t = m_n / cos β.
    pub fn transverse_module_mm(&self) -> f64 {
        self.normal_module_mm / self.helix_angle_rad.cos()
    }

    /// Transverse pressure angle: tan α_t = tan α_n / cos β.
    pub fn transverse_pressure_angle_rad(&self) -> f64 {
        (self.normal_pressure_angle_rad.tan() / self.helix_angle_rad.cos()).atan()
    }

    /// Overlap ratio ε_β = b |sin β| / (π m_n).
    pub fn overlap_ratio(&self) -> f64 {
        self.face_width_mm * self.helix_angle_rad.sin().abs() / (PI * self.normal_module_mm)
    }

    /// Whether all transverse sections of the pair are equal: no helix, parallel axes, no modification over the face width
    /// and no shaft that twists.
    pub fn is_alike_over_width(&self) -> bool {
        self.helix_angle_rad == 0.0
            && self.axis_parallelism == AxisParallelism::default()
            && !self.has_shafts()
            && Gear::BOTH.iter().all(|&gear| !self.gears[gear].modification.varies_over_width())
    }

    /// Pair on parallel axes and rigid shafts.
    pub fn on_rigid_parallel_shafts(&self) -> Self {
        let gears = self.gears.clone().map(|gear| GearSpec { shaft: None, ..gear });
        Self { axis_parallelism: AxisParallelism::default(), gears, ..self.clone() }
    }

    /// Whether either gear has a shaft that twists.
    pub fn has_shafts(&self) -> bool {
        Gear::BOTH.iter().any(|&gear| self.gears[gear].shaft.is_some())
    }

    /// Whether the wheel has internal teeth.
    pub fn is_internal(&self) -> bool {
        self.gears.wheel.ring.is_some()
    }

    /// Reference radius r = m_t z / 2.
    pub fn reference_radius_mm(&self, gear: Gear) -> f64 {
        0.5 * self.transverse_module_mm() * self.gears[gear].z()
    }

    /// Generating profile shift x_E m_n of `gear`, which includes the thickness allowance, mm.
    pub(crate) fn generating_shift_mm(&self, gear: Gear) -> f64 {
        let own = &self.gears[gear];
        own.profile_shift * self.normal_module_mm
            + own.tooth_thickness_allowance_mm / (2.0 * self.normal_pressure_angle_rad.tan())
    }

    /// Half the angle of the tooth of `gear` at its base circle, ψ_b = (π/2 + 2 x_E tan α_n)/z + inv α_t.
    pub fn base_half_angle_rad(&self, gear: Gear) -> f64 {
        let (m_n, alpha_n) = (self.normal_module_mm, self.normal_pressure_angle_rad);
        let shift_mm = self.generating_shift_mm(gear);
        (FRAC_PI_2 + 2.0 * shift_mm / m_n * alpha_n.tan()) / self.gears[gear].z()
            + inv(self.transverse_pressure_angle_rad())
    }

    /// Root radius r_f = r + x_E m_n − h_fP* m_n with the generating profile shift x_E; of an internal gear also as given, or as its cutter makes it.
    pub fn root_radius_mm(&self, gear: Gear) -> f64 {
        let own = &self.gears[gear];
        if let Some(root_mm) = own.ring.as_ref().and_then(|ring| ring.root_radius_mm(self)) {
            return root_mm;
        }
        let thinned_mm = own.tooth_thickness_allowance_mm / (2.0 * self.normal_pressure_angle_rad.tan());
        let shift_mm = own.profile_shift * self.normal_module_mm + thinned_mm;
        self.reference_radius_mm(gear) + shift_mm - self.rack.dedendum_factor * self.normal_module_mm
    }

    /// Tip radius as given, or that of the rack, shortened where the mate's root circle asks for it: r_a = r + (h_aP* + x + k) m_n, with the
    /// tip alteration k ≤ 0 that keeps the clearance c* = h_fP* − h_aP* (ISO 21771, section 4.2.5).
    pub fn tip_radius_mm(&self, gear: Gear) -> f64 {
        match self.gears[gear].tip_diameter_mm {
            Some(diameter) => 0.5 * diameter,
            None => self.rack_tip_radius_mm(gear).min(self.clear_tip_radius_mm(gear)),
        }
    }

    /// r + (h_aP* + x) m_n: tip radius as the rack of the teeth has it, without tip alteration.
    fn rack_tip_radius_mm(&self, gear: Gear) -> f64 {
        let addendum_factor = self.rack.addendum_factor + self.gears[gear].profile_shift;
        self.reference_radius_mm(gear) + addendum_factor * self.normal_module_mm
    }

    /// Tip radius that keeps the clearance c* from the mate's root circle.
    fn clear_tip_radius_mm(&self, gear: Gear) -> f64 {
        let mate = gear.mate();
        let mate_addendum_line = self.gears[mate].profile_shift - self.rack.addendum_factor;
        self.centre_distance_mm - self.reference_radius_mm(mate) - mate_addendum_line * self.normal_module_mm
    }
}
