//! Tooth stiffness along the path of contact.
//!
//! A tooth pair is a spring of the teeth (bending, shear, body) in series with its contact surface (flattening). A model gives the
//! compliance of the **whole** pair at a reference load, and the spring of the teeth is the remainder after the compliance of the chosen surface:
//!
//! ```text
//! q_teeth(ξ) = q_pair(ξ) − δ_surface(ξ, w_ref) / w_ref
//! ```
//!
//! | model | given compliance |
//! |---|---|
//! | `constant` | spring of the teeth, without flattening |
//! | [`weber_banaschek`] | teeth, bodies and flattening of the generated profile, varying along the path |
//! | [`iso6336`] | single stiffness c', constant along the path |
//! | `fem`, `simon`, `wang-cheng` | [`curve`] from finite elements or the user's data |
//!
//! A curve may also give the part that all pairs in mesh share: the deflection of the gear bodies under the load of any pair displaces
//! all teeth. This part, q_b, is subtracted from the springs of the single pairs and is in series with all of them
//! together: the gears approach each other by q_b F more under the whole load F.
//!
//! At a tip edge, before A and after E and on its rounding, the load has another
//! angle to its tooth and acts at another height of its mate (`gear::tip_touch`): it turns towards the axis of its tooth, which is stiffer.
//! `weber-banaschek` holds for any load line, a curve of finite elements includes the effect, and a constant spring holds everywhere. Beyond A
//! and E (a curve: beyond its ends) the springs of the other models change in proportion to the teeth of Weber and
//! Banaschek,
//!
//! ```text
//! q(ξ) = q(ξ_end) q_WB(ξ)/q_WB(ξ_end)
//! ```
//!
//! As both flattening and the approach of the surface are nonlinear in the load, the whole compliance differs from the model at other loads than
//! the reference; the difference is reported ([`TeethSpring::split_remainder`]).

pub mod curve;
pub mod curve_file;
pub mod iso6336;
pub mod settings;
pub mod weber_banaschek;

use crate::contact::{ContactSurface, hertz};
use curve::{PairCompliance, StandsFor};
use gearwear_bodies::gear::{GearPair, PerGear, normal_section::Obliquity};
use gearwear_bodies::material::Material;
use settings::StiffnessSettings;
use weber_banaschek::ToothCompliance;

/// Reason why a stiffness model cannot be used with a contact surface.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StiffnessError {
    /// The model needs a curve, and none is given.
    #[error("the stiffness model needs a curve along the path of contact, and none is given")]
    NoCurve,
    /// The contact surface alone is softer than the whole pair of the model.
    #[error(
        "the approach of the contact surface alone is {surface_um:.3} µm under the whole load at position {position_mm:.3} mm, \
         more than the {pair_um:.3} µm of the whole tooth pair in the stiffness model; a stiffer surface or a softer stiffness model fits"
    )]
    SurfaceTooSoft {
        /// Radius of curvature of the pinion at the theoretical contact point.
        position_mm: f64,
        /// Approach of the surface.
        surface_um: f64,
        /// Approach of the pair.
        pair_um: f64,
    },
}

/// Compliance given by the model.
enum ModelCompliance<'a> {
    /// Spring of the teeth, N/mm².
    Teeth(f64),
    /// Bending, shear and bodies of each gear; flattening in closed form.
    WeberBanaschek,
    /// Compliance of the whole pair, mm²/N.
    WholePair(f64),
    /// Curve from finite elements or the user.
    Given(&'a PairCompliance),
}

/// Compliance of a pair's spring in two parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringParts {
    /// Compliance of the teeth, which is greater where they are oblique or end.
    pub teeth_mm2_per_n: f64,
    /// Compliance of the model's flattening less that of the surface at the reference load, which does not depend on the teeth.
    pub left_by_surface_mm2_per_n: f64,
}

impl SpringParts {
    /// Whole compliance with teeth `softness` times as compliant.
    pub fn mm2_per_n(self, softness: f64) -> f64 {
        softness * self.teeth_mm2_per_n + self.left_by_surface_mm2_per_n
    }
}

/// Spring of the teeth of a pair, in series with its contact surface.
pub struct TeethSpring<'a> {
    pair: &'a GearPair,
    material: PerGear<Material>,
    surface: &'a dyn ContactSurface,
    obliquity: Obliquity,
    curve: ModelCompliance<'a>,
    weber_banaschek: PerGear<ToothCompliance>,
    /// Reference load, at which spring and surface together have the model's compliance, N/mm.
    pub reference_line_load_n_per_mm: f64,
}

impl<'a> TeethSpring<'a> {
    /// Spring of a pair on a surface; the reference load is the whole line load. `given` is the curve of the
    /// models that need one.
    pub fn new(
        settings: StiffnessSettings,
        given: Option<&'a PairCompliance>,
        pair: &'a GearPair,
        material: &PerGear<Material>,
        surface: &'a dyn ContactSurface,
        line_load_n_per_mm: f64,
    ) -> Result<Self, StiffnessError> {
        let curve = match (settings, given) {
            (StiffnessSettings::Constant { pair_n_per_mm2 }, _) => ModelCompliance::Teeth(pair_n_per_mm2),
            (StiffnessSettings::Fem | StiffnessSettings::Simon | StiffnessSettings::WangCheng, Some(curve)) => {
                ModelCompliance::Given(curve)
            }
            (StiffnessSettings::Fem | StiffnessSettings::Simon | StiffnessSettings::WangCheng, None) => {
                return Err(StiffnessError::NoCurve);
            }
            (StiffnessSettings::WeberBanaschek, _) => ModelCompliance::WeberBanaschek,
            (StiffnessSettings::Iso6336, _) => ModelCompliance::WholePair(
                1.0 / iso6336::single_stiffness_n_per_mm2(&pair.spec, material, line_load_n_per_mm),
            ),
        };
        let weber_banaschek = PerGear::from_fn(|gear| ToothCompliance::new(&pair.teeth[gear], &material[gear]));
        let reference_line_load_n_per_mm = line_load_n_per_mm;
        let (material, obliquity) = (*material, pair.obliquity());
        Ok(Self { pair, material, surface, obliquity, curve, weber_banaschek, reference_line_load_n_per_mm })
    }

    /// Stiffness of the spring with the theoretical contact point at `position_mm`, N per mm of approach and mm of face
    /// width.
    ///
    /// # Errors
    /// [`StiffnessError::SurfaceTooSoft`] where the surface has all of the pair's compliance.
    pub fn n_per_mm2(&self, position_mm: f64) -> Result<f64, StiffnessError> {
        let (end_mm, yields) = self.beyond_stated(position_mm);
        Ok(self.stated_n_per_mm2(end_mm)? / yields)
    }

    /// Nearest position for which the model holds, and the ratio of the compliance at `position_mm` to that there.
    fn beyond_stated(&self, position_mm: f64) -> (f64, f64) {
        let (first_mm, last_mm) = self.stated_mm();
        let end_mm = position_mm.clamp(first_mm, last_mm);
        if end_mm == position_mm {
            return (end_mm, 1.0);
        }
        (end_mm, self.weber_banaschek_mm2_per_n(position_mm) / self.weber_banaschek_mm2_per_n(end_mm))
    }

    /// Range of positions for which the model holds.
    fn stated_mm(&self) -> (f64, f64) {
        let path = &self.pair.path;
        match &self.curve {
            // A constant spring holds everywhere.
            ModelCompliance::WeberBanaschek | ModelCompliance::Teeth(_) => (f64::NEG_INFINITY, f64::INFINITY),
            ModelCompliance::Given(curve) => {
                let (first_mm, last_mm) = curve.ends_mm();
                (first_mm.min(path.start_mm), last_mm.max(path.end_mm))
            }
            ModelCompliance::WholePair(_) => (path.start_mm, path.end_mm),
        }
    }

    /// Stiffness at a position for which the model holds.
    fn stated_n_per_mm2(&self, position_mm: f64) -> Result<f64, StiffnessError> {
        let Some(whole) = self.stated_pair_mm2_per_n(position_mm) else {
            let ModelCompliance::Teeth(spring) = self.curve else {
                unreachable!("all other models give a compliance of the pair")
            };
            return Ok(spring);
        };
        let surface = self.surface_mm2_per_n(position_mm);
        if surface < whole {
            Ok(1.0 / (whole - surface))
        } else {
            let um = 1e3 * self.reference_line_load_n_per_mm;
            Err(StiffnessError::SurfaceTooSoft { position_mm, surface_um: um * surface, pair_um: um * whole })
        }
    }

    /// Compliance of the bodies that all pairs in mesh share, part of each pair's spring, mm²/N; 0 where the model does not
    /// give it.
    pub fn shared_mm2_per_n(&self) -> f64 {
        match &self.curve {
            ModelCompliance::Given(curve) => curve.shared_mm2_per_n,
            ModelCompliance::Teeth(_) | ModelCompliance::WeberBanaschek | ModelCompliance::WholePair(_) => 0.0,
        }
    }

    /// Stiffness of a pair's spring without the shared bodies, N/mm².
    ///
    /// # Errors
    /// See [`Self::n_per_mm2`].
    pub fn own_n_per_mm2(&self, position_mm: f64) -> Result<f64, StiffnessError> {
        let (whole, shared) = (1.0 / self.n_per_mm2(position_mm)?, self.shared_mm2_per_n());
        if shared < whole { Ok(1.0 / (whole - shared)) } else { Err(self.too_soft(position_mm, whole - shared)) }
    }

    /// Error for a spring with the compliance `own_mm2_per_n` (≤ 0) without surface and shared bodies.
    pub(crate) fn too_soft(&self, position_mm: f64, own_mm2_per_n: f64) -> StiffnessError {
        let um = 1e3 * self.reference_line_load_n_per_mm;
        let surface_um = um * (self.surface_mm2_per_n(position_mm) + self.shared_mm2_per_n());
        StiffnessError::SurfaceTooSoft { position_mm, surface_um, pair_um: surface_um + um * own_mm2_per_n }
    }

    /// Whether the model is of the transverse section alone, without the effect of the helix angle.
    pub fn states_the_section(&self) -> bool {
        match &self.curve {
            ModelCompliance::WeberBanaschek | ModelCompliance::Given(_) => true,
            ModelCompliance::Teeth(_) | ModelCompliance::WholePair(_) => false,
        }
    }

    /// Whole spring in parts, shared bodies included; for models that are not of the transverse section the teeth are the only part.
    fn parts(&self, position_mm: f64) -> Result<SpringParts, StiffnessError> {
        let whole = 1.0 / self.n_per_mm2(position_mm)?;
        let left_by_surface_mm2_per_n = if self.states_the_section() {
            let (end_mm, yields) = self.beyond_stated(position_mm);
            let flattening = self.flattening_mm2_per_n(end_mm, self.reference_line_load_n_per_mm);
            yields * (flattening - self.surface_mm2_per_n(end_mm))
        } else {
            0.0
        };
        Ok(SpringParts { teeth_mm2_per_n: whole - left_by_surface_mm2_per_n, left_by_surface_mm2_per_n })
    }

    /// Spring of a pair without the shared bodies in parts, whose sum may be zero or negative.
    ///
    /// # Errors
    /// See [`Self::n_per_mm2`].
    pub fn own_parts(&self, position_mm: f64) -> Result<SpringParts, StiffnessError> {
        let parts = self.parts(position_mm)?;
        Ok(SpringParts { teeth_mm2_per_n: parts.teeth_mm2_per_n - self.shared_mm2_per_n(), ..parts })
    }

    /// Whole spring, shared bodies included, where the compliance of the section's teeth, too, is along the normal of an oblique line of
    /// contact: 1/cos β_b times as great along the transverse line of action.
    ///
    /// # Errors
    /// See [`Self::n_per_mm2`].
    pub(crate) fn oblique_parts(&self, position_mm: f64) -> Result<SpringParts, StiffnessError> {
        let parts = self.parts(position_mm)?;
        Ok(SpringParts { teeth_mm2_per_n: self.obliquity.transverse_mm(parts.teeth_mm2_per_n), ..parts })
    }

    /// Stiffness of the whole pair, flattening included, at the reference load, N/mm².
    pub fn pair_n_per_mm2(&self, position_mm: f64) -> Result<f64, StiffnessError> {
        Ok(1.0 / (1.0 / self.n_per_mm2(position_mm)? + self.surface_mm2_per_n(position_mm)))
    }

    /// Difference of the surface's part of the approach from the model's flattening at `load_fraction` of the reference load,
    /// relative to the pair's whole approach; `None` for models without flattening.
    pub fn split_remainder(&self, position_mm: f64, load_fraction: f64) -> Option<f64> {
        let (ModelCompliance::WeberBanaschek | ModelCompliance::Given(_)) = self.curve else { return None };
        let w = self.reference_line_load_n_per_mm;
        let part = load_fraction * w;
        let [flattening_mm, flattening_of_part_mm] =
            [w, part].map(|load| load * self.flattening_mm2_per_n(position_mm, load));
        let [surface_mm, surface_of_part_mm] = [w, part].map(|load| self.surface_mm(position_mm, load));
        // The spring is linear: with equal approaches at w, the difference is that of flattening and surface.
        let spring_differs_by = (flattening_mm - surface_mm) / w;
        let modelled_mm = surface_of_part_mm + spring_differs_by * part;
        let whole_mm = flattening_of_part_mm + part * self.teeth_mm2_per_n(position_mm);
        Some((modelled_mm - flattening_of_part_mm) / whole_mm)
    }

    /// Compliance of the whole pair in the model; `None` for a constant spring of the teeth.
    fn stated_pair_mm2_per_n(&self, position_mm: f64) -> Option<f64> {
        match &self.curve {
            ModelCompliance::Teeth(_) => None,
            ModelCompliance::WholePair(compliance) => Some(*compliance),
            ModelCompliance::WeberBanaschek | ModelCompliance::Given(_) => {
                let w = self.reference_line_load_n_per_mm;
                Some(self.teeth_mm2_per_n(position_mm) + self.flattening_mm2_per_n(position_mm, w))
            }
        }
    }

    /// Flattening in closed form over line load, along the transverse line of action.
    fn flattening_mm2_per_n(&self, position_mm: f64, line_load_n_per_mm: f64) -> f64 {
        let flattening = hertz::flattening(&self.pair.normal_section(), &self.material, position_mm);
        self.obliquity.transverse_mm(flattening.approach_mm(line_load_n_per_mm)) / line_load_n_per_mm
    }

    /// Flattening over line load of a spur pair with the same transverse section.
    fn flattening_of_section_mm2_per_n(&self, position_mm: f64, line_load_n_per_mm: f64) -> f64 {
        let flattening = hertz::flattening(self.pair, &self.material, position_mm);
        flattening.approach_mm(line_load_n_per_mm) / line_load_n_per_mm
    }

    /// Compliance of both teeth and bodies; 0 for models that do not separate it from flattening.
    fn teeth_mm2_per_n(&self, position_mm: f64) -> f64 {
        match &self.curve {
            ModelCompliance::WeberBanaschek => self.weber_banaschek_mm2_per_n(position_mm),
            ModelCompliance::Given(curve) => match curve.stands_for {
                StandsFor::Teeth => curve.at(position_mm),
                StandsFor::WholePair { line_load_n_per_mm } => {
                    curve.at(position_mm) - self.flattening_of_section_mm2_per_n(position_mm, line_load_n_per_mm)
                }
            },
            ModelCompliance::Teeth(_) | ModelCompliance::WholePair(_) => 0.0,
        }
    }

    /// Compliance of both teeth and bodies by Weber and Banaschek for a load along the normal of the contact.
    fn weber_banaschek_mm2_per_n(&self, position_mm: f64) -> f64 {
        let load_line = self.pair.touch(position_mm).load_line;
        PerGear::from_fn(|gear| self.weber_banaschek[gear].along_mm2_per_n(&load_line[gear])).sum()
    }

    fn surface_mm2_per_n(&self, position_mm: f64) -> f64 {
        let w = self.reference_line_load_n_per_mm;
        self.surface_mm(position_mm, w) / w
    }

    /// Approach of the surface under a line load along the transverse line of action.
    fn surface_mm(&self, position_mm: f64, line_load_n_per_mm: f64) -> f64 {
        let along_normal = self.surface.plain_approach_mm(&self.pair.normal_section(), position_mm, line_load_n_per_mm);
        self.obliquity.transverse_mm(along_normal)
    }
}
