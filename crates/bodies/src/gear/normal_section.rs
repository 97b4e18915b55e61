//! Normal section of helical teeth, in which contact, wear and measurement take place.
//!
//! Slices are transverse sections, and loads are shared along the transverse line of action, but the surfaces
//! touch along a line at the angle β_b in the plane of action, and are pressed together along their common normal. In the tangent
//! plane the direction across that line is the tangent of the transverse profile, e_t, as the line of contact and the normal lie
//! in the plane of action. Coordinates across the contact are therefore the same in both sections, and with w the transverse line load F_bt/b,
//!
//! ```text
//! normal force                 F_bn = F_bt/cos β_b
//! length of the line           l = b/cos β_b
//! load along the line          F_bn/l = w
//! gap along the normal         g_n(x) = cos β_b · g_t(x) + h           g_t along the transverse line of action, h: depth of wear
//! approach                     δ_n = cos β_b · δ_t,      work  w l δ_n = F_bt δ_t
//! radius of curvature          R_n = R_t/cos β_b
//! Hertz                        a² = 4 w R_n/(π E*)       p₀ = √(w E*/(π R_n)) = √cos β_b · p₀ of the transverse section
//! sliding                      v_s along e_t: as in the transverse section
//! area of a flank              dA = ds · dz/cos β_b
//! ```
//!
//! The wear depth of a point in a mesh is k ∫ p ds = k w ζ, as in a spur pair; the volume k F_bn s is 1/cos β_b times that of the
//! spur pair. Modifications are given along the transverse line of action, as on a drawing; normal to the flank, as in the field of removed
//! material, they are multiplied by cos β_b.
//!
//! For a spur pair cos β_b is exactly 1.
//!
//! Source: the geometry of the involute helicoid, ISO 21771:2007, 5.4 and 5.5; ISO 1328-1:2013, where deviations are measured;
//! K. L. Johnson, *Contact Mechanics* (1985), section 4.2.

use super::{Gear, GearPair, conjugate::ConjugateFlanks, involute::TangentFramePoint};

/// Obliquity of a line of contact in the plane of action, for conversion between transverse and normal section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Obliquity {
    /// Cosine of the base helix angle β_b.
    cos_base_helix: f64,
}

impl Obliquity {
    /// Lines of contact parallel to the axes.
    pub const SPUR: Self = Self { cos_base_helix: 1.0 };

    /// Lines of contact at the base helix angle `base_helix_rad`.
    pub fn new(base_helix_rad: f64) -> Self {
        Self { cos_base_helix: base_helix_rad.cos() }
    }

    /// Normal force from its transverse component, or normal force per mm of face width from the transverse line load.
    pub fn normal_force(self, transverse: f64) -> f64 {
        transverse / self.cos_base_helix
    }

    /// Approach, gap or depth along the normal from that along the transverse line of action, mm.
    pub fn normal_mm(self, transverse_mm: f64) -> f64 {
        transverse_mm * self.cos_base_helix
    }

    /// Approach, gap, depth or compliance along the transverse line of action from that along the normal, mm.
    pub fn transverse_mm(self, normal_mm: f64) -> f64 {
        normal_mm / self.cos_base_helix
    }

    /// Radius of curvature in the normal section from that in the transverse section, mm.
    pub fn normal_radius_mm(self, transverse_mm: f64) -> f64 {
        transverse_mm / self.cos_base_helix
    }

    /// Length of a line of contact from its width, mm; likewise area or worn volume of a flank from profile length or area times width.
    pub fn along_line(self, over_width: f64) -> f64 {
        over_width / self.cos_base_helix
    }

    /// Line load w R_n/R_t under which a contact with the transverse radius R_t is as wide as under w in the normal section, N/mm.
    pub fn as_wide_under_n_per_mm(self, line_load_n_per_mm: f64) -> f64 {
        line_load_n_per_mm / self.cos_base_helix
    }
}

/// Two flanks in their normal section.
#[derive(Clone, Copy)]
pub struct NormalSection<'a> {
    transverse: &'a dyn ConjugateFlanks,
    /// Obliquity of their line of contact.
    pub obliquity: Obliquity,
}

impl<'a> NormalSection<'a> {
    /// Flanks of a spur pair, whose transverse section is the normal one.
    pub fn of_spur(flanks: &'a dyn ConjugateFlanks) -> Self {
        Self { transverse: flanks, obliquity: Obliquity::SPUR }
    }
}

impl GearPair {
    /// Obliquity of the lines of contact.
    pub fn obliquity(&self) -> Obliquity {
        Obliquity::new(self.base_helix_angle_rad())
    }

    /// Flanks in their normal section.
    pub fn normal_section(&self) -> NormalSection<'_> {
        NormalSection { transverse: self, obliquity: self.obliquity() }
    }

    /// Area of all working flanks of a gear over the face width from a length of the profile, or their worn volume from a worn area of it.
    pub fn over_all_flanks(&self, gear: Gear, of_profile: f64) -> f64 {
        self.obliquity().along_line(of_profile * self.spec.face_width_mm) * f64::from(self.spec.gears[gear].teeth)
    }
}

impl ConjugateFlanks for NormalSection<'_> {
    fn contact_coordinate_mm(&self, gear: Gear, position_mm: f64) -> f64 {
        self.transverse.contact_coordinate_mm(gear, position_mm)
    }

    fn position_at_mm(&self, gear: Gear, coordinate_mm: f64) -> f64 {
        self.transverse.position_at_mm(gear, coordinate_mm)
    }

    fn in_tangent_frame(&self, gear: Gear, coordinate_mm: f64, position_mm: f64) -> TangentFramePoint {
        let TangentFramePoint { along_mm, drop_mm } =
            self.transverse.in_tangent_frame(gear, coordinate_mm, position_mm);
        TangentFramePoint { along_mm, drop_mm: self.obliquity.normal_mm(drop_mm) }
    }

    fn at_along(&self, gear: Gear, along_mm: f64, position_mm: f64) -> (f64, f64) {
        let (coordinate_mm, drop_mm) = self.transverse.at_along(gear, along_mm, position_mm);
        (coordinate_mm, self.obliquity.normal_mm(drop_mm))
    }

    fn flank_limits_mm(&self, gear: Gear) -> (f64, f64) {
        self.transverse.flank_limits_mm(gear)
    }

    fn curvature_radius_mm(&self, gear: Gear, position_mm: f64) -> f64 {
        self.obliquity.normal_radius_mm(self.transverse.curvature_radius_mm(gear, position_mm))
    }

    fn rolling_ratio(&self, gear: Gear, position_mm: f64) -> f64 {
        self.transverse.rolling_ratio(gear, position_mm)
    }

    fn sliding_mm(&self, from_mm: f64, to_mm: f64) -> f64 {
        self.transverse.sliding_mm(from_mm, to_mm)
    }

    /// Depth in the transverse section, where stiffness models separate flattening from the tooth.
    fn depth_mm(&self, gear: Gear, position_mm: f64) -> f64 {
        self.transverse.depth_mm(gear, position_mm)
    }
}
