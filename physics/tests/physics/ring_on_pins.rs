//! A ring on pins by condensed sectors against a curved beam on hinges.

use gearwear_bodies::gear_fem::ring::{GearCompliance, Surroundings};
use gearwear_bodies::gear_fem::sector::Sector;
use gearwear_bodies::gear_mesh::settings::{RimPins, ToothOnPins};
use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::solid::{Element, ElementKind, Solid};
use nalgebra::{DMatrix, DVector, RowDVector, Vector2};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::common::assert_close;

const STEEL: Elastic = Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 };
/// Centroidal radius and thickness of the plain ring, mm; its sectors.
const RADIUS_MM: f64 = 100.0;
const THICKNESS_MM: f64 = 6.0;
const SECTORS: usize = 36;
/// Elements of a sector along the ring and through its thickness.
const ALONG: usize = 4;
const THROUGH: usize = 2;

/// Slender curved beam that closes a circle, of unit width.
struct RingBeam {
    radius_mm: f64,
    thickness_mm: f64,
}

fn at(radius_mm: f64, angle_rad: f64) -> Vector2<f64> {
    radius_mm * Vector2::new(-angle_rad.sin(), angle_rad.cos())
}

fn cross(a: Vector2<f64>, b: Vector2<f64>) -> f64 {
    a.x * b.y - a.y * b.x
}

impl RingBeam {
    /// Work Σ f u of radial forces, N/mm by angle, on hinges at `pins` on the circle of `pin_radius_mm`: twice the complementary energy
    ///
    /// ```text
    /// U = ½ ∫ (M²/E'I + N²/E'A + V²/κGA) R dφ,     κ = 5/6
    /// ```
    ///
    /// least over the forces at one section and the reactions that keep the ring in equilibrium (Castigliano; S. Timoshenko, *Strength of
    /// Materials* II, 3rd ed. 1956, section 80).
    fn work(&self, loads: &[(f64, f64)], pins: &[f64], pin_radius_mm: f64) -> f64 {
        const STEPS: usize = 7200;
        let e = STEEL.young_modulus_mpa / (1.0 - STEEL.poisson_ratio.powi(2));
        let shear = STEEL.young_modulus_mpa / (2.0 * (1.0 + STEEL.poisson_ratio));
        let (area, inertia) = (self.thickness_mm, self.thickness_mm.powi(3) / 12.0);
        // Unknowns: both components of force and the moment at angle 0, then the reactions; the last column is what the loads do.
        let unknowns = 3 + 2 * pins.len();
        let known = unknowns;
        let axis = |component: usize| if component == 0 { Vector2::x() } else { Vector2::y() };
        let mut forces: Vec<(f64, Vector2<f64>, Vector2<f64>, usize)> = Vec::new();
        for (pin, &angle) in pins.iter().enumerate() {
            for component in 0..2 {
                forces.push((angle, at(pin_radius_mm, angle), axis(component), 3 + 2 * pin + component));
            }
        }
        for &(angle, load) in loads {
            forces.push((angle, at(self.radius_mm, angle), load * at(1.0, angle), known));
        }
        let start = at(self.radius_mm, 0.0);
        let mut flexibility = DMatrix::<f64>::zeros(unknowns + 1, unknowns + 1);
        for step in 0..STEPS {
            let angle = TAU * (step as f64 + 0.5) / STEPS as f64;
            let here = at(self.radius_mm, angle);
            let (normal, along) = (at(1.0, angle), Vector2::new(-angle.cos(), -angle.sin()));
            let [mut moment, mut axial, mut transverse] = [(); 3].map(|()| RowDVector::<f64>::zeros(unknowns + 1));
            let mut add = |place: usize, from: Vector2<f64>, force: Vector2<f64>| {
                moment[place] += cross(from - here, force);
                axial[place] += force.dot(&along);
                transverse[place] += force.dot(&normal);
            };
            add(0, start, Vector2::x());
            add(1, start, Vector2::y());
            for &(_, from, force, place) in forces.iter().filter(|(before, ..)| before.rem_euclid(TAU) < angle) {
                add(place, from, force);
            }
            moment[2] = 1.0;
            let length_mm = self.radius_mm * TAU / STEPS as f64;
            for (row, stiffness) in
                [(&moment, e * inertia), (&axial, e * area), (&transverse, shear * area * 5.0 / 6.0)]
            {
                flexibility += row.transpose() * row * (length_mm / stiffness);
            }
        }
        // Equilibrium of loads and reactions.
        let mut balance = DMatrix::<f64>::zeros(3, unknowns + 1);
        for &(_, from, force, place) in &forces {
            balance[(0, place)] += force.x;
            balance[(1, place)] += force.y;
            balance[(2, place)] += cross(from, force) / self.radius_mm;
        }
        let size = unknowns + 3;
        let scale = flexibility[(2, 2)];
        let mut system = DMatrix::<f64>::zeros(size, size);
        let mut right = DVector::<f64>::zeros(size);
        system.view_mut((0, 0), (unknowns, unknowns)).copy_from(&flexibility.view((0, 0), (unknowns, unknowns)));
        let own = balance.view((0, 0), (3, unknowns)) * scale;
        system.view_mut((unknowns, 0), (3, unknowns)).copy_from(&own);
        system.view_mut((0, unknowns), (unknowns, 3)).copy_from(&own.transpose());
        right.rows_mut(0, unknowns).copy_from(&-flexibility.view((0, known), (unknowns, 1)));
        right.rows_mut(unknowns, 3).copy_from(&(balance.view((0, known), (3, 1)) * -scale));
        let found = system.lu().solve(&right).expect("hinges hold the ring");
        let mut all = DVector::<f64>::zeros(unknowns + 1);
        all.rows_mut(0, unknowns).copy_from(&found.rows(0, unknowns));
        all[known] = 1.0;
        (all.transpose() * &flexibility * &all)[(0, 0)]
    }
}

/// Two opposite forces between two opposite hinges: with a = π/4 − 2/π and b = 2/π − ½ in units of W R³/E'I, diameters change by a along forces and by
/// b across (W. C. Young, R. G. Budynas, *Roark's Formulas for Stress and Strain*, 7th ed., table 9.2, case 1), so that hinges leave a − b²/a.
#[test]
fn val_beam_between_opposite_hinges() {
    let beam = RingBeam { radius_mm: 100.0, thickness_mm: 0.2 };
    let stiffness = STEEL.young_modulus_mpa / (1.0 - 0.3 * 0.3) * 0.2f64.powi(3) / 12.0;
    let (a, b) = (0.25 * PI - 2.0 / PI, 2.0 / PI - 0.5);
    let work = beam.work(&[(1e-9, 1.0), (PI, 1.0)], &[FRAC_PI_2, 3.0 * FRAC_PI_2], 100.0);
    assert_close("change of diameter", work, (a - b * b / a) * 1e6 / stiffness, 2e-3);
}

/// A sector of the plain ring, outer nodes of cuts first; forces may act on the inner nodes between the cuts.
fn plain_sector() -> Sector {
    let half_angle_rad = PI / SECTORS as f64;
    let (columns, rows) = (2 * ALONG + 1, 2 * THROUGH + 1);
    let mut points_mm = Vec::new();
    let mut node = vec![u32::MAX; columns * rows];
    for i in 0..columns {
        for j in (0..rows).filter(|j| i % 2 == 0 || j % 2 == 0) {
            let angle = half_angle_rad * (i as f64 / ALONG as f64 - 1.0);
            let depth_mm = THICKNESS_MM * (j as f64 / (2 * THROUGH) as f64 - 0.5);
            node[rows * i + j] = points_mm.len() as u32;
            points_mm.push(at(RADIUS_MM + depth_mm, angle));
        }
    }
    let id = |i: usize, j: usize| node[rows * i + j];
    let mut elements = Vec::new();
    for i in (0..2 * ALONG).step_by(2) {
        for j in (0..2 * THROUGH).step_by(2) {
            let corners = [id(i, j), id(i, j + 2), id(i + 2, j + 2), id(i + 2, j)];
            let middles = [id(i, j + 1), id(i + 1, j + 2), id(i + 2, j + 1), id(i + 1, j)];
            elements.push(Element::new(ElementKind::Quad8, &[corners, middles].concat(), 0));
        }
    }
    let cut = |i: usize| (0..rows).rev().map(|j| id(i, j)).collect();
    Sector {
        solid: Solid { points_mm, elements },
        clamp: Vec::new(),
        cuts: [cut(0), cut(columns - 1)],
        half_angle_rad,
        candidates: (1..columns - 1).map(|i| id(i, 0)).collect(),
        probes: Vec::new(),
        working_side_probes: 0,
    }
}

/// Even radial force on a pitch of a thin ring on three and four pins: work within 1.5 % of the beam's, with the pitch between pins and at one,
/// whose cut is among those of the loaded teeth.
#[test]
fn val_a_ring_on_pins_bends_as_a_curved_beam() {
    let beam = RingBeam { radius_mm: RADIUS_MM, thickness_mm: THICKNESS_MM };
    let nodes = 2 * ALONG - 1;
    let angles: Vec<f64> = (0..nodes).map(|i| PI / SECTORS as f64 * ((i + 1) as f64 / ALONG as f64 - 1.0)).collect();
    let force: Vec<(usize, f64)> = angles
        .iter()
        .enumerate()
        .flat_map(|(k, &angle)| {
            let unit = at(1.0 / nodes as f64, angle);
            [(2 * k, unit.x), (2 * k + 1, unit.y)]
        })
        .collect();
    let loads: Vec<(f64, f64)> = angles.iter().map(|&angle| (angle, 1.0 / nodes as f64)).collect();
    for count in [3, 4] {
        let mut works = Vec::new();
        for tooth in [ToothOnPins::BetweenPins, ToothOnPins::AtPin] {
            let (fine, coarse) =
                [(); 2].map(|()| plain_sector().condense(STEEL, Analysis::PlaneStrain).unwrap()).into();
            let pins = RimPins { count, tooth };
            let surroundings = Surroundings::PinnedRing { coarse: SECTORS - 5, pins };
            let ring = GearCompliance::new(fine, Some(&coarse), 5, surroundings).unwrap();
            let found = ring.displacement_along_mm(2, &force, 2, &force);
            let at_cut = |cut: u32| (f64::from(cut) - 0.5) * TAU / SECTORS as f64;
            let pins: Vec<f64> = pins.cuts(SECTORS as u32).into_iter().map(at_cut).collect();
            assert_eq!(pins.len(), count as usize);
            let outside_mm = RADIUS_MM + 0.5 * THICKNESS_MM;
            println!("{count} pins, {tooth:?}: {found:.6e} mm");
            assert_close("work", found, beam.work(&loads, &pins, outside_mm), 0.015);
            works.push(found);
        }
        assert!(works[0] > 1.5 * works[1], "{works:?}");
    }
}
