//! Tooth stiffness along the path of contact.
//!
//! A tooth pair is a spring of the teeth (bending, shear, body) in series with its contact surface (flattening). What
//! must be right is the compliance of the whole pair; how it is split is bookkeeping. So a model states the **whole**
//! compliance at a reference load, and the spring of the teeth is what the chosen surface leaves of it:
//!
//! ```text
//! q_teeth(ξ) = q_pair(ξ) − δ_surface(ξ, w_ref) / w_ref
//! ```
//!
//! | model | what it states |
//! |---|---|
//! | `constant` | the spring of the teeth itself, without flattening |
//! | [`weber_banaschek`] | teeth, bodies and flattening of the generated profile, varying along the path |
//! | [`iso6336`] | the single stiffness c', the same along the path |
//! | `fem`, `simon`, `wang-cheng` | a [`curve`]: from finite elements, or the user's data |
//!
//! A curve may also say which part of it all pairs in mesh share: the gear bodies yield under the load of every pair, and take
//! all teeth with them. That part, q_b, is taken out of the springs of the single pairs and put in series with all of them
//! together: the gears approach each other by q_b F more, whoever carries F.
//!
//! Where a tip edge touches, before A and after E and where its rounding is the contact, the load meets the tooth under another
//! angle and its mate at another height ([`crate::gear::tip_touch`]): it turns towards the axis of its tooth, which yields the less.
//! `weber-banaschek` knows that for any load line, and a curve of finite elements has it in its values. A constant spring holds everywhere. The other models state
//! nothing beyond A and E (a curve: beyond its ends); there their spring changes in the same proportion as the teeth of Weber and
//! Banaschek,
//!
//! ```text
//! q(ξ) = q(ξ_end) q_WB(ξ)/q_WB(ξ_end)
//! ```
//!
//! Both flattening and the foundation's approach are nonlinear in the load; what the split leaves over at other loads than the
//! reference is reported ([`TeethSpring::split_remainder`]).

pub mod curve;
pub mod curve_file;
pub mod iso6336;
pub mod settings;
pub mod weber_banaschek;

use crate::contact::{ContactSurface, hertz};
use crate::gear::{GearPair, PerGear, normal_section::Obliquity};
use crate::material::Material;
use curve::{PairCompliance, StandsFor};
use settings::StiffnessSettings;
use weber_banaschek::ToothCompliance;

/// Why a stiffness and a surface do not go together.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StiffnessError {
    /// The model is a curve, and there is none.
    #[error("the stiffness model needs a curve along the path of contact, and none is given")]
    NoCurve,
    /// The contact surface alone is softer than the whole pair is meant to be.
    #[error(
        "the contact surface alone yields {surface_um:.3} µm under the whole load at position {position_mm:.3} mm, \
         more than the {pair_um:.3} µm of the whole tooth pair by the stiffness model"
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

/// What the model states.
enum Curve<'a> {
    /// Spring of the teeth, N/mm².
    Teeth(f64),
    /// Bending, shear and bodies of each gear; flattening in closed form.
    WeberBanaschek,
    /// Compliance of the whole pair, mm²/N.
    WholePair(f64),
    /// From finite elements or the user.
    Given(&'a PairCompliance),
}

/// Compliance of a pair's spring in its two parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringParts {
    /// Of the teeth: where they are oblique or end, this part yields more.
    pub teeth_mm2_per_n: f64,
    /// By how much the flattening that the model states exceeds the surface's approach, at the reference load; negative where the surface
    /// yields more. It is the surface's, and no tooth changes it.
    pub left_by_surface_mm2_per_n: f64,
}

impl SpringParts {
    /// The whole, where the teeth yield `softness` times as much.
    pub fn mm2_per_n(self, softness: f64) -> f64 {
        softness * self.teeth_mm2_per_n + self.left_by_surface_mm2_per_n
    }
}

/// The spring of the teeth of a pair, in series with its contact surface.
pub struct TeethSpring<'a> {
    pair: &'a GearPair,
    material: PerGear<Material>,
    surface: &'a dyn ContactSurface,
    obliquity: Obliquity,
    curve: Curve<'a>,
    weber_banaschek: PerGear<ToothCompliance>,
    /// The load at which spring and surface together have the model's compliance, N/mm.
    pub reference_line_load_n_per_mm: f64,
}

impl<'a> TeethSpring<'a> {
    /// Prepares the model for a pair on a surface; the reference load is the whole line load. `given` is the curve of the
    /// models that have one.
    pub fn new(
        settings: StiffnessSettings,
        given: Option<&'a PairCompliance>,
        pair: &'a GearPair,
        material: &PerGear<Material>,
        surface: &'a dyn ContactSurface,
        line_load_n_per_mm: f64,
    ) -> Result<Self, StiffnessError> {
        let curve = match (settings, given) {
            (StiffnessSettings::Constant { pair_n_per_mm2 }, _) => Curve::Teeth(pair_n_per_mm2),
            (StiffnessSettings::Fem | StiffnessSettings::Simon | StiffnessSettings::WangCheng, Some(curve)) => {
                Curve::Given(curve)
            }
            (StiffnessSettings::Fem | StiffnessSettings::Simon | StiffnessSettings::WangCheng, None) => {
                return Err(StiffnessError::NoCurve);
            }
            (StiffnessSettings::WeberBanaschek, _) => Curve::WeberBanaschek,
            (StiffnessSettings::Iso6336, _) => {
                Curve::WholePair(1.0 / iso6336::single_stiffness_n_per_mm2(&pair.spec, material, line_load_n_per_mm))
            }
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
    /// [`StiffnessError::SurfaceTooSoft`] where nothing of the pair's compliance is left for the teeth.
    pub fn n_per_mm2(&self, position_mm: f64) -> Result<f64, StiffnessError> {
        let (end_mm, yields) = self.beyond_stated(position_mm);
        Ok(self.stated_n_per_mm2(end_mm)? / yields)
    }

    /// The nearest position for which the model states something, and how many times as much as there the spring yields at `position_mm`.
    fn beyond_stated(&self, position_mm: f64) -> (f64, f64) {
        let (first_mm, last_mm) = self.stated_mm();
        let end_mm = position_mm.clamp(first_mm, last_mm);
        if end_mm == position_mm {
            return (end_mm, 1.0);
        }
        (end_mm, self.weber_banaschek_mm2_per_n(position_mm) / self.weber_banaschek_mm2_per_n(end_mm))
    }

    /// The positions for which the model states something.
    fn stated_mm(&self) -> (f64, f64) {
        let path = &self.pair.path;
        match &self.curve {
            // What the user gives holds everywhere.
            Curve::WeberBanaschek | Curve::Teeth(_) => (f64::NEG_INFINITY, f64::INFINITY),
            Curve::Given(curve) => {
                let (first_mm, last_mm) = curve.ends_mm();
                (first_mm.min(path.start_mm), last_mm.max(path.end_mm))
            }
            Curve::WholePair(_) => (path.start_mm, path.end_mm),
        }
    }

    /// The spring at a position for which the model states something.
    fn stated_n_per_mm2(&self, position_mm: f64) -> Result<f64, StiffnessError> {
        let Some(whole) = self.stated_pair_mm2_per_n(position_mm) else {
            let Curve::Teeth(spring) = self.curve else { unreachable!("only a given spring states no pair") };
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

    /// Compliance of the bodies that all pairs in mesh share, a part of each pair's spring, mm²/N; 0 where the model does not
    /// tell it.
    pub fn shared_mm2_per_n(&self) -> f64 {
        match &self.curve {
            Curve::Given(curve) => curve.shared_mm2_per_n,
            Curve::Teeth(_) | Curve::WeberBanaschek | Curve::WholePair(_) => 0.0,
        }
    }

    /// Stiffness of what a pair has to itself of the spring, beside the shared bodies, N/mm².
    ///
    /// # Errors
    /// As those of [`Self::n_per_mm2`].
    pub fn own_n_per_mm2(&self, position_mm: f64) -> Result<f64, StiffnessError> {
        let (whole, shared) = (1.0 / self.n_per_mm2(position_mm)?, self.shared_mm2_per_n());
        if shared < whole { Ok(1.0 / (whole - shared)) } else { Err(self.too_soft(position_mm, whole - shared)) }
    }

    /// That a spring beside surface and shared bodies would have the compliance `own_mm2_per_n` (≤ 0).
    pub(crate) fn too_soft(&self, position_mm: f64, own_mm2_per_n: f64) -> StiffnessError {
        let um = 1e3 * self.reference_line_load_n_per_mm;
        let surface_um = um * (self.surface_mm2_per_n(position_mm) + self.shared_mm2_per_n());
        StiffnessError::SurfaceTooSoft { position_mm, surface_um, pair_um: surface_um + um * own_mm2_per_n }
    }

    /// Whether the model speaks of the transverse section alone, and not of oblique teeth too.
    pub fn states_the_section(&self) -> bool {
        match &self.curve {
            Curve::WeberBanaschek | Curve::Given(_) => true,
            Curve::Teeth(_) | Curve::WholePair(_) => false,
        }
    }

    /// The whole spring in parts, shared bodies included. A model that does not speak of the section has no other part than the teeth.
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

    /// What a pair has to itself of the spring, beside the shared bodies, in parts: the whole may be nothing or less.
    ///
    /// # Errors
    /// As those of [`Self::n_per_mm2`].
    pub fn own_parts(&self, position_mm: f64) -> Result<SpringParts, StiffnessError> {
        let parts = self.parts(position_mm)?;
        Ok(SpringParts { teeth_mm2_per_n: parts.teeth_mm2_per_n - self.shared_mm2_per_n(), ..parts })
    }

    /// The whole spring, shared bodies included, where all of the section's compliance counts along the normal of an oblique line of
    /// contact, as flattening does: what the section says of its teeth, too, then yields 1/cos β_b times as much along the transverse line of
    /// action.
    ///
    /// # Errors
    /// As those of [`Self::n_per_mm2`].
    pub(crate) fn oblique_parts(&self, position_mm: f64) -> Result<SpringParts, StiffnessError> {
        let parts = self.parts(position_mm)?;
        Ok(SpringParts { teeth_mm2_per_n: self.obliquity.transverse_mm(parts.teeth_mm2_per_n), ..parts })
    }

    /// Stiffness of the whole pair, flattening included, at the reference load, N/mm².
    pub fn pair_n_per_mm2(&self, position_mm: f64) -> Result<f64, StiffnessError> {
        Ok(1.0 / (1.0 / self.n_per_mm2(position_mm)? + self.surface_mm2_per_n(position_mm)))
    }

    /// How far the surface's share of the approach at `load_fraction` of the reference load is from what the model's own
    /// flattening would be there, relative to the pair's whole approach; `None` where the model states no flattening.
    pub fn split_remainder(&self, position_mm: f64, load_fraction: f64) -> Option<f64> {
        let (Curve::WeberBanaschek | Curve::Given(_)) = self.curve else { return None };
        let w = self.reference_line_load_n_per_mm;
        let flattening = |load| load * self.flattening_mm2_per_n(position_mm, load);
        let surface = |load| self.surface_mm(position_mm, load);
        // The spring is linear, so the difference of whole approaches is that of the shares once both agree at w.
        let spring_differs_by = (flattening(w) - surface(w)) / w;
        let part = load_fraction * w;
        let modelled = surface(part) + spring_differs_by * part;
        let whole = flattening(part) + part * self.teeth_mm2_per_n(position_mm);
        Some((modelled - flattening(part)) / whole)
    }

    /// Compliance of the whole pair as the model states it.
    fn stated_pair_mm2_per_n(&self, position_mm: f64) -> Option<f64> {
        match &self.curve {
            Curve::Teeth(_) => None,
            Curve::WholePair(compliance) => Some(*compliance),
            Curve::WeberBanaschek | Curve::Given(_) => {
                let w = self.reference_line_load_n_per_mm;
                Some(self.teeth_mm2_per_n(position_mm) + self.flattening_mm2_per_n(position_mm, w))
            }
        }
    }

    /// Flattening in closed form, which is along the normal, over line load, along the transverse line of action.
    fn flattening_mm2_per_n(&self, position_mm: f64, line_load_n_per_mm: f64) -> f64 {
        let flattening = hertz::flattening(&self.pair.normal_section(), &self.material, position_mm);
        self.obliquity.transverse_mm(flattening.approach_mm(line_load_n_per_mm)) / line_load_n_per_mm
    }

    /// The same of a spur pair with the transverse section of this one.
    fn flattening_of_section_mm2_per_n(&self, position_mm: f64, line_load_n_per_mm: f64) -> f64 {
        let flattening = hertz::flattening(self.pair, &self.material, position_mm);
        flattening.approach_mm(line_load_n_per_mm) / line_load_n_per_mm
    }

    /// Compliance of both teeth and bodies; 0 for the models that do not tell it from flattening.
    fn teeth_mm2_per_n(&self, position_mm: f64) -> f64 {
        match &self.curve {
            Curve::WeberBanaschek => self.weber_banaschek_mm2_per_n(position_mm),
            Curve::Given(curve) => match curve.stands_for {
                StandsFor::Teeth => curve.at(position_mm),
                StandsFor::WholePair { line_load_n_per_mm } => {
                    curve.at(position_mm) - self.flattening_of_section_mm2_per_n(position_mm, line_load_n_per_mm)
                }
            },
            Curve::Teeth(_) | Curve::WholePair(_) => 0.0,
        }
    }

    /// Compliance of both teeth and bodies by Weber and Banaschek, for a load along the normal where the flanks touch.
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
