//! The pair in mesh, to scale, in contact at the pitch point.
//!
//! The pinion's axis is the origin and the wheel's lies on +y, an internal wheel's on −y; the pinion turns anticlockwise and pushes with the
//! anticlockwise flanks of its teeth, so that the line of action runs from T1 up to the left:
//!
//! ```text
//! T1 = r_b1 (sin α_wt, cos α_wt)        direction (−cos α_wt, sin α_wt)
//! ```

use nalgebra::{Rotation2, Vector2};

use crate::results::run::{GearCircles, PairDrawing};
use gearwear_bodies::gear::{Gear, GearPair, PerGear, outline::polyline};

/// Points on each fillet and flank.
const POINTS_PER_PIECE: usize = 20;

/// Draws `pair`, whose wheel is held at `wheel_clamp_radius_mm`: the outside of an internal one.
pub(super) fn draw(pair: &GearPair, wheel_clamp_radius_mm: f64) -> PairDrawing {
    let axis = PerGear { pinion: [0.0, 0.0], wheel: [0.0, pair.spec.centre_distance_mm] };
    let (sin, cos) = pair.working_pressure_angle_rad.sin_cos();
    let t1 = pair.path.involute.pinion.base_radius_mm * Vector2::new(sin, cos);
    let on_line = |position_mm: f64| {
        let point = t1 + position_mm * Vector2::new(-cos, sin);
        [point.x, point.y]
    };
    PairDrawing {
        outline: PerGear::from_fn(|gear| outline_in_place(pair, gear)),
        axis,
        bore_radius_mm: PerGear::from_fn(|gear| pair.spec.gears[gear].bore_diameter_mm.map(|d| 0.5 * d)),
        circles_mm: PerGear::from_fn(|gear| GearCircles {
            base: pair.teeth[gear].involute.base_radius_mm,
            working_pitch: pair.working_pitch_radius_mm(gear),
            tip: pair.teeth[gear].tip_radius_mm,
        }),
        line_of_action: [on_line(0.0), on_line(pair.path.line_of_action_mm)],
        path_of_contact: in_order_of_contact(pair)
            .into_iter()
            .map(|(name, position_mm)| (name.to_owned(), on_line(position_mm)))
            .collect(),
        rim_radius_mm: pair.spec.is_internal().then_some(wheel_clamp_radius_mm.abs()),
    }
}

/// Names and positions of A–E as the contact passes them.
fn in_order_of_contact(pair: &GearPair) -> Vec<(&'static str, f64)> {
    let mut points: Vec<_> = ["A", "B", "C", "D", "E"].into_iter().zip(pair.path.points_mm()).collect();
    points.sort_by(|a, b| a.1.total_cmp(&b.1));
    points
}

/// The outline turned until a working flank crosses the line of centres on the pitch circle.
fn outline_in_place(pair: &GearPair, gear: Gear) -> Vec<[f64; 2]> {
    let tooth = &pair.teeth[gear];
    let to_pitch_point = Rotation2::new(tooth.space_half_angle_rad(pair.working_pitch_radius_mm(gear)));
    polyline(tooth, POINTS_PER_PIECE)
        .into_iter()
        .map(|[x, y]| {
            let p = to_pitch_point * Vector2::new(x, y);
            match gear {
                Gear::Pinion => [p.x, p.y],
                // The wheel looks down on the pinion: turned by half a turn about its own axis. An internal one, at −y in its own frame, then
                // reaches beyond it.
                Gear::Wheel => [-p.x, pair.spec.centre_distance_mm - p.y],
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use gearwear_bodies::gear::flank_surface::FlankSurface;
    use gearwear_bodies::gear::modification::Modification;
    use gearwear_bodies::gear::spec::{AxisParallelism, BasicRack, GearSpec, PairSpec};

    /// The flanks in space, cut in the middle of the face width, are the working flanks drawn, but for the chords between the
    /// drawing's points. The pair is the preset h501 (FEUP).
    #[test]
    fn ver_flanks_in_space_are_those_drawn() {
        let gear = |teeth, profile_shift| GearSpec {
            teeth,
            profile_shift,
            tip_diameter_mm: None,
            tooth_thickness_allowance_mm: 0.0,
            bore_diameter_mm: None,
            modification: Modification::default(),
            measured_flank: None,
            shaft: None,
            ring: None,
            tip_chamfer: None,
        };
        let pair = GearPair::new(&PairSpec {
            normal_module_mm: 3.5,
            normal_pressure_angle_rad: 20f64.to_radians(),
            helix_angle_rad: 15f64.to_radians(),
            centre_distance_mm: 91.5,
            face_width_mm: 23.0,
            rack: BasicRack::default(),
            axis_parallelism: AxisParallelism::default(),
            gears: PerGear { pinion: gear(20, 0.1809), wheel: gear(30, 0.0891) },
        })
        .unwrap();
        let drawing = draw(&pair, 35.0);
        for gear in Gear::BOTH {
            let surface = FlankSurface::new(&pair, gear);
            let tooth = &pair.teeth[gear];
            for i in 0..=20 {
                let rho =
                    tooth.root_form_rho_mm() + (tooth.tip_rho_mm() - tooth.root_form_rho_mm()) * f64::from(i) / 20.0;
                let [x, y, z] = surface.point_mm(rho, 11.5, pair.path.pitch_point_mm);
                let outline = &drawing.outline[gear];
                let sides = outline.iter().zip(outline.iter().cycle().skip(1));
                let distance = sides
                    .map(|(from, to)| {
                        let (from, side) = (Vector2::from(*from), Vector2::from(*to) - Vector2::from(*from));
                        let along = ((Vector2::new(x, y) - from).dot(&side) / side.norm_squared()).clamp(0.0, 1.0);
                        (from + along * side - Vector2::new(x, y)).norm()
                    })
                    .fold(f64::INFINITY, f64::min);
                assert!(distance < 0.01 && z == 11.5, "{gear:?} at {rho}: {distance} mm off the outline");
            }
        }
    }
}
