//! Teeth in space: the elements, and the condensed teeth against plane strain and CalculiX.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use gearwear_bodies::gear::shaft::{EndFace, Shaft};
use gearwear_bodies::gear::spec::{AxisParallelism, PairSpec};
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_bodies::gear_fem::in_space::{self, FlankForces, PlaneSection, TeethInSpace};
use gearwear_bodies::gear_mesh::settings::{SectionDivisions, SpaceBody, SpaceResolution, Web, default_clamp};
use gearwear_bodies::gear_mesh::tooth_section::ExtrudedTooth;
use gearwear_fem::elastic::Elastic;
use gearwear_fem::quadrature::GAUSS_3;
use gearwear_files::data_table::DataTable;
use gearwear_mesh::quality;
use gearwear_physics::mesh_cycle::pair_in_space::{KeptInSpace, PairInSpace, PairInSpaceError};

use super::common::{assert_close, fzg_c, pair, preset};

const STEEL: Elastic = Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 };
const CLAMP_RADIUS_MM: PerGear<f64> = PerGear { pinion: 19.943, wheel: 37.897 };

/// Discs as wide as the teeth.
fn discs(clamp_radius_mm: PerGear<f64>) -> PerGear<SpaceBody> {
    clamp_radius_mm.map(|clamp_radius_mm| SpaceBody { clamp_radius_mm, web: None })
}

/// Discs as a scene has them that says nothing of its bodies.
fn usual_discs(pair: &GearPair) -> PerGear<SpaceBody> {
    let module_mm = pair.spec.transverse_module_mm();
    discs(PerGear::from_fn(|gear| default_clamp(pair.teeth[gear].root_radius_mm, module_mm).radius_mm))
}

fn even_load(teeth: &TeethInSpace, radius_mm: f64, face_width_mm: f64) -> FlankForces {
    let ends_mm = teeth.layer_ends_mm();
    let of_layer = |ends: &[f64]| {
        let length_mm = ends[1] - ends[0];
        let at = |place: f64| ends[0] + 0.5 * length_mm * (1.0 + place);
        GAUSS_3.map(|(place, weight)| (radius_mm, at(place), 0.5 * weight * length_mm / face_width_mm))
    };
    teeth.load(ends_mm.windows(2).flat_map(of_layer))
}

/// Where nothing can happen along the axis, space is the plane: end faces held in their planes, or ν = 0 and free ones. There, the
/// volume strain of an element is projected and its deviator is not, so that a little of one is left of the other.
#[test]
fn ver_plane_strain_from_three_dimensions() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    for gear in Gear::BOTH {
        let (tooth, width_mm) = (&pair.teeth[gear], pair.spec.face_width_mm);
        let radius_mm = pair.radius_at_mm(gear, pair.path.pitch_point_mm);
        let mesh = || ExtrudedTooth::of_gear(&pair, gear, &discs(CLAMP_RADIUS_MM), &SpaceResolution::USUAL);
        let held = TeethInSpace::in_plane_strain(tooth, mesh(), STEEL).unwrap();
        let brittle = Elastic { poisson_ratio: 0.0, ..STEEL };
        let free = TeethInSpace::new(tooth, mesh(), brittle, 1).unwrap();
        for (teeth, material, allowed) in [(held, STEEL, 2e-4), (free, brittle, 1e-3)] {
            let section = PlaneSection::new(tooth, &mesh().section, material).unwrap();
            let load = even_load(&teeth, radius_mm, width_mm);
            let in_space = width_mm * teeth.mm_per_n(&load, &load, 0);
            let name = format!("{} ν = {}", gear.name(), material.poisson_ratio);
            let in_plane = section.mm2_per_n(radius_mm);
            println!("{name}: {:.1e}", in_space / in_plane - 1.0);
            assert_close(&name, in_space, in_plane, allowed);
        }
    }
}

/// Maxwell and Betti: what a load here does there, the same load there does here, on one tooth and on two.
#[test]
fn ver_reciprocity() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    let mesh = ExtrudedTooth::of_gear(&pair, Gear::Pinion, &discs(CLAMP_RADIUS_MM), &SpaceResolution::USUAL);
    let teeth = TeethInSpace::new(&pair.teeth.pinion, mesh, STEEL, 2).unwrap();
    let [here, there] = [(34.9, 1.3, 1.0), (40.2, 11.8, 1.0)].map(|point| teeth.load([point]));
    for pitches in [0, 1] {
        let [a, b] = [teeth.mm_per_n(&here, &there, pitches), teeth.mm_per_n(&there, &here, -pitches)];
        assert!((a / b - 1.0).abs() < 1e-10, "{pitches}: {a} {b}");
        assert!(a > 0.0 && a < teeth.mm_per_n(&here, &here, 0), "{pitches}: {a}");
    }
}

/// Few layers: what a web changes is far from them.
const FEW_LAYERS: SpaceResolution = SpaceResolution { layers: [4, 4], ..SpaceResolution::USUAL };

/// The pinion of `fzg-c` on a web below a rim of 5 mm.
fn pinion_on_a_web(
    pair: &GearPair,
    clamp_radius_mm: f64,
    [thickness_mm, offset_mm]: [f64; 2],
    teeth: usize,
) -> TeethInSpace {
    let web = Some(Web { thickness_mm, rim_thickness_mm: 5.0, offset_mm });
    let bodies = PerGear { pinion: SpaceBody { clamp_radius_mm, web }, ..discs(CLAMP_RADIUS_MM) };
    let mesh = ExtrudedTooth::of_gear(pair, Gear::Pinion, &bodies, &FEW_LAYERS);
    TeethInSpace::new(&pair.teeth.pinion, mesh, STEEL, teeth).unwrap()
}

/// All teeth loaded alike twist the web as a disc of its thickness, by T/(4π G b_s) · (1/r_i² − 1/r_o²) between two radii (S. Timoshenko and J. N. Goodier,
/// *Theory of Elasticity*, art. 31: pure shear falls with the square of the radius).
#[test]
fn ver_a_web_twists_as_a_disc() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    let (teeth, base_mm) = (pair.teeth.pinion.teeth, pair.teeth.pinion.involute.base_radius_mm);
    let radius_mm = pair.radius_at_mm(Gear::Pinion, pair.path.pitch_point_mm);
    let yields_mm_per_n = |clamp_radius_mm| {
        let on_a_web = pinion_on_a_web(&pair, clamp_radius_mm, [5.0, 3.0], teeth as usize);
        let load = even_load(&on_a_web, radius_mm, pair.spec.face_width_mm);
        (0..teeth).map(|pitches| on_a_web.mm_per_n(&load, &load, pitches as i32)).sum::<f64>()
    };
    let shear_modulus_mpa = 0.5 * STEEL.young_modulus_mpa / (1.0 + STEEL.poisson_ratio);
    let twist_rad = f64::from(teeth) * base_mm / (4.0 * std::f64::consts::PI * shear_modulus_mpa * 5.0)
        * (12f64.powi(-2) - 18f64.powi(-2));
    let found = yields_mm_per_n(12.0) - yields_mm_per_n(18.0);
    println!("{:.1e}", found / (base_mm * twist_rad) - 1.0);
    // The web has few rows of elements.
    assert_close("twist", found, base_mm * twist_rad, 3e-3);
}

/// A web as wide as the teeth is no web; one beside the middle is the mirror image of one on the other side, and the teeth yield least above it.
#[test]
fn ver_webs_over_the_face_width() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    let width_mm = pair.spec.face_width_mm;
    let radius_mm = pair.radius_at_mm(Gear::Pinion, pair.path.pitch_point_mm);
    let own = |teeth: &TeethInSpace, z_mm: f64| {
        let load = teeth.load([(radius_mm, z_mm, 1.0)]);
        teeth.mm_per_n(&load, &load, 0)
    };
    let bodies = discs(PerGear { pinion: 15.0, ..CLAMP_RADIUS_MM });
    let disc = ExtrudedTooth::of_gear(&pair, Gear::Pinion, &bodies, &FEW_LAYERS);
    let disc = TeethInSpace::new(&pair.teeth.pinion, disc, STEEL, 1).unwrap();
    let [wide, before, after] =
        [[width_mm, 0.0], [4.0, -4.5], [4.0, 4.5]].map(|web| pinion_on_a_web(&pair, 15.0, web, 1));
    for z_mm in [0.7, 5.0, 7.0, 13.0] {
        // The disc has fewer rows of elements.
        assert_close("as wide as the teeth", own(&wide, z_mm), own(&disc, z_mm), 4e-3);
        assert_close("mirrored", own(&before, z_mm), own(&after, width_mm - z_mm), 1e-9);
        assert!(own(&before, z_mm) > own(&wide, z_mm), "{z_mm}");
    }
    assert!(own(&before, 2.5) < 0.95 * own(&before, 11.5));
}

/// Displacements even and odd under half a turn of the tooth add up to all: on a web in the middle, and on one so little beside it that there is no
/// such symmetry, and all are condensed together.
#[test]
fn ver_even_and_odd_displacements_are_all() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    let [symmetric, whole] = [0.0, 1e-4].map(|offset_mm| pinion_on_a_web(&pair, 15.0, [4.0, offset_mm], 2));
    let places = [(34.9, 1.3), (36.6, 7.0), (40.2, 11.8)];
    for pitches in [-1, 0, 1] {
        for of in places {
            for under in places {
                let [found, expected] = [&symmetric, &whole].map(|teeth| {
                    let [of, under] = [of, under].map(|(radius_mm, z_mm)| teeth.load([(radius_mm, z_mm, 1.0)]));
                    teeth.mm_per_n(&of, &under, pitches)
                });
                assert_close(&format!("{of:?} under {under:?}, {pitches}"), found, expected, 2e-4);
            }
        }
    }
}

#[test]
fn sections_are_well_shaped_on_all_presets() {
    for name in ["fzg-c", "fzg-a", "helical", "h501", "thesis-spur"] {
        let pair = pair(&preset(name));
        let bodies = usual_discs(&pair);
        for gear in Gear::BOTH {
            let mesh = ExtrudedTooth::of_gear(&pair, gear, &bodies, &SpaceResolution::USUAL).section.to_mesh();
            let found = quality::of_mesh(&mesh).unwrap().scaled_jacobian.value;
            assert!(found > 0.5, "{name} {}: {found}", gear.name());
        }
    }
}

#[test]
fn gears_with_too_few_teeth_are_refused() {
    let pair = pair(&PairSpec { face_width_mm: 900.0, ..preset("helical") });
    let steel = PerGear::from_fn(|_| STEEL);
    let refused =
        PairInSpace::new(&pair, &steel, &discs(CLAMP_RADIUS_MM), &SpaceResolution::USUAL, [0.0; 2]).map(|_| ());
    assert!(matches!(refused, Err(PairInSpaceError::TooFewTeeth { gear: Gear::Pinion, .. })), "{refused:?}");
}

/// A row of a table of CalculiX (validation/cross-check/README.md).
struct CrossChecked {
    /// The whole ring, or four teeth in a row with their outer cuts held.
    is_ring: bool,
    /// CalculiX's hexahedra are smaller than ours.
    is_finer: bool,
    /// Elements along each side of the section that one of ours becomes.
    section_split: usize,
    integration_points: u32,
    of: LoadedLine,
    under: LoadedLine,
    pitches: i32,
    mm_per_n: f64,
}

/// An even load along a line of contact.
struct LoadedLine {
    /// Radius of curvature of the pinion's flank in the middle of the face width.
    position_mm: f64,
    from_mm: f64,
    to_mm: f64,
}

/// Where a displacement is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    OnTheLoad,
    ElsewhereOnTheTooth,
    OnTheNextTooth,
}

impl CrossChecked {
    fn table(name: &str, teeth: u32) -> Vec<Self> {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/cross-check").join(name);
        let text = std::fs::read_to_string(path).unwrap();
        let rows = DataTable::read(&text, String::new).unwrap().rows.into_iter();
        rows.map(|(_, words)| words.iter().map(|word| word.parse().unwrap()).collect())
            .map(|row: Vec<f64>| Self {
                is_ring: row[0] == f64::from(teeth),
                is_finer: row[1] * row[2] > 1.0,
                section_split: row[1] as usize,
                integration_points: row[3] as u32,
                of: LoadedLine { position_mm: row[4], from_mm: row[5], to_mm: row[6] },
                under: LoadedLine { position_mm: row[7], from_mm: row[8], to_mm: row[9] },
                pitches: row[10] as i32,
                mm_per_n: row[11],
            })
            .collect()
    }

    /// Length on which both lines are loaded.
    fn shared_mm(&self) -> f64 {
        (self.of.to_mm.min(self.under.to_mm) - self.of.from_mm.max(self.under.from_mm)).max(0.0)
    }

    fn place(&self) -> Place {
        match (self.pitches, self.of.position_mm == self.under.position_mm && self.shared_mm() > 0.0) {
            (0, true) => Place::OnTheLoad,
            (0, false) => Place::ElsewhereOnTheTooth,
            _ => Place::OnTheNextTooth,
        }
    }
}

impl LoadedLine {
    fn length_mm(&self) -> f64 {
        self.to_mm - self.from_mm
    }

    /// Radius, place over the face width and part of the load at three points of each of the layers that end there.
    fn points(&self, pair: &GearPair, layer_ends_mm: &[f64]) -> Vec<(f64, f64, f64)> {
        let middle_mm = 0.5 * pair.spec.face_width_mm;
        let is_loaded =
            |ends: &&[f64]| 0.5 * (ends[0] + ends[1]) > self.from_mm && 0.5 * (ends[0] + ends[1]) < self.to_mm;
        let of_layer = |ends: &[f64]| {
            let (from_mm, layer_mm) = (ends[0], ends[1] - ends[0]);
            GAUSS_3.map(|(place, weight)| {
                let z_mm = from_mm + 0.5 * layer_mm * (1.0 + place);
                let rho_mm = self.position_mm + (middle_mm - z_mm) * pair.base_helix_angle_rad().tan();
                (pair.teeth.pinion.involute.radius_mm(rho_mm), z_mm, 0.5 * weight * layer_mm / self.length_mm())
            })
        };
        layer_ends_mm.windows(2).filter(is_loaded).flat_map(of_layer).collect()
    }
}

/// The usual section with so many elements for each.
fn finer(times: usize) -> SpaceResolution {
    let SectionDivisions { across, fillet, flank, land, radial } = SpaceResolution::USUAL.section;
    let [across, fillet, flank, land, radial] = [across, fillet, flank, land, radial].map(|count| times * count);
    SpaceResolution { section: SectionDivisions { across, fillet, flank, land, radial }, ..SpaceResolution::USUAL }
}

/// Whole rings and a row of four teeth on the same elements in CalculiX, and the row on finer ones. Ours have their volume strain
/// projected: they are softer than with 27 points of integration and mostly stiffer than with 8, most of all under the load itself. A
/// finer section is softer there, by what the same section in plane strain is.
#[test]
fn val_compliance_against_calculix() {
    let mut greatest = BTreeMap::new();
    for (name, file, slices) in
        [("thesis-helical", "helical-pinion-in-space.csv", Some(20)), ("fzg-c", "fzg-c-pinion-in-space.csv", None)]
    {
        let pair = pair(&preset(name));
        let tooth = &pair.teeth.pinion;
        // As the tables have it: 2.5 normal modules below the root circle.
        let bodies = discs(PerGear::from_fn(|gear| pair.teeth[gear].root_radius_mm - 2.5 * pair.spec.normal_module_mm));
        // Layers are those of `gearwear mesh`.
        let resolution = |times| SpaceResolution { slices, ..finer(times) };
        let mesh = |times| ExtrudedTooth::of_gear(&pair, Gear::Pinion, &bodies, &resolution(times));
        let ring = TeethInSpace::new(tooth, mesh(1), STEEL, 2).unwrap();
        let row = TeethInSpace::in_a_row(tooth, mesh(1), STEEL, 1).unwrap();
        let layer_ends_mm = ring.layer_ends_mm();
        let sections = [1, 2].map(|times| PlaneSection::new(tooth, &mesh(times).section, STEEL).unwrap());
        let in_plane_mm2_per_n = |times: usize, line: &LoadedLine| -> f64 {
            let points = line.points(&pair, &layer_ends_mm).into_iter();
            points.map(|(radius_mm, _, part)| part * sections[times - 1].mm2_per_n(radius_mm)).sum()
        };
        for found in CrossChecked::table(file, tooth.teeth) {
            let CrossChecked { of, under, .. } = &found;
            let teeth = if found.is_ring { &ring } else { &row };
            let load = |line: &LoadedLine| teeth.load(line.points(&pair, &layer_ends_mm));
            let mut own = teeth.mm_per_n(&load(of), &load(under), found.pitches);
            if found.place() == Place::OnTheLoad {
                let shorter = if of.length_mm() < under.length_mm() { of } else { under };
                let softer = in_plane_mm2_per_n(found.section_split, shorter) - in_plane_mm2_per_n(1, shorter);
                let shared_per_mm = found.shared_mm() / (of.length_mm() * under.length_mm());
                own += softer / pair.base_helix_angle_rad().cos() * shared_per_mm;
            }
            let difference = own / found.mm_per_n - 1.0;
            let key = (name, found.is_ring, found.is_finer, found.integration_points, found.place());
            let [least, most]: &mut [f64; 2] = greatest.entry(key).or_insert([f64::MAX, f64::MIN]);
            (*least, *most) = (least.min(difference), most.max(difference));
        }
    }
    for ((name, is_ring, is_finer, points, place), [least, most]) in greatest {
        let name = format!(
            "{name}, {}, {}, {points} points, {place:?}",
            if is_ring { "ring" } else { "row" },
            if is_finer { "finer" } else { "same elements" }
        );
        println!("{name}: {:+.2} to {:+.2} %", 100.0 * least, 100.0 * most);
        let allowed = match (place, points) {
            (Place::OnTheLoad, 27) => 0.016,
            (Place::OnTheLoad, _) => 0.01,
            (Place::ElsewhereOnTheTooth, 27) => 0.009,
            // Between held cuts the next tooth moves little, and elements of the body are coarse.
            (Place::OnTheNextTooth, 27) if is_finer => 0.012,
            (Place::OnTheNextTooth, 27) => 0.006,
            _ => 0.005,
        };
        assert!(least.abs().max(most.abs()) < allowed, "{name}: {least} {most}");
    }
}

/// Scenes that were made of one another share their teeth; other teeth are condensed anew.
#[test]
fn teeth_are_condensed_once() {
    let kept = KeptInSpace::default();
    let steel = PerGear::from_fn(|_| STEEL);
    let condensed = |spec: &PairSpec| {
        kept.condensed(&GearPair::new(spec).unwrap(), steel, discs(CLAMP_RADIUS_MM), 20, 600.0).unwrap()
    };
    let (first, again) = (condensed(&fzg_c()), condensed(&fzg_c()));
    assert!(Arc::ptr_eq(&first, &again));
    // What carries the teeth is no part of them.
    let mut on_a_shaft = fzg_c();
    let shaft = Shaft { diameter_mm: 40.0, bore_diameter_mm: 0.0, driven_at: EndFace::Start, bearings: None };
    on_a_shaft.gears.pinion.shaft = Some(shaft);
    on_a_shaft.axis_parallelism = AxisParallelism { in_plane_mm: 0.01, out_of_plane_mm: 0.01 };
    assert!(first.shares_teeth_with(&condensed(&on_a_shaft)));
    let mut relieved = fzg_c();
    relieved.gears.wheel.modification.profile_crowning_mm = 0.005;
    assert!(first.shares_teeth_with(&condensed(&relieved)));
    let wider = PairSpec { face_width_mm: 15.0, ..fzg_c() };
    assert!(!first.shares_teeth_with(&condensed(&wider)));
}

/// What the deformed tooth of a ring shows is what its compliance says, also under the load of a neighbour.
#[test]
fn ver_deformed_teeth_are_those_of_the_compliance() {
    let pair = pair(&preset("thesis-helical"));
    let tooth = &pair.teeth.pinion;
    let coarse = SpaceResolution { layers: [4, 4], ..SpaceResolution::USUAL };
    let mesh = ExtrudedTooth::of_gear(&pair, Gear::Pinion, &usual_discs(&pair), &coarse);
    let normals = in_space::flank_forces(tooth, &mesh);
    let teeth = TeethInSpace::new(tooth, mesh, STEEL, 2).unwrap();
    let own = teeth.load([(35.1, 4.0, 0.7), (35.3, 9.0, 0.3)]);
    let beside = teeth.load([(39.0, 16.0, 1.0)]);
    for pitches in [-1, 1] {
        let loads = [(0, 300.0, own.clone()), (pitches, 500.0, beside.clone())];
        let deformed = teeth.deformed(tooth, STEEL, &loads).unwrap();
        let along = |forces: &FlankForces| -> f64 {
            let of_node = |(node, part): &(u32, f64)| {
                let dot =
                    |(dof, force): &(u32, f64)| force * deformed.displacement_mm[*dof as usize / 3][*dof as usize % 3];
                part * normals[*node as usize].iter().map(dot).sum::<f64>()
            };
            forces.iter().map(of_node).sum()
        };
        let expected = 300.0 * teeth.mm_per_n(&own, &own, 0) + 500.0 * teeth.mm_per_n(&own, &beside, pitches);
        let found = along(&own);
        assert!((found / expected - 1.0).abs() < 1e-9, "{pitches}: {found} instead of {expected}");
        assert!(deformed.stress_mpa.iter().all(|stress| stress.amax() < 500.0));
    }
}
