//! The tooth mesher: nodes on the true profile, cuts that match, cells that are well shaped.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use gearwear_bodies::gear::modification::{Modification, Relief, ReliefShape};
use gearwear_bodies::gear::outline;
use gearwear_bodies::gear::removed_material::removed_mm;
use gearwear_bodies::gear::spec::PairSpec;
use gearwear_bodies::gear::tip_chamfer::TipChamfer;
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_bodies::gear_mesh::pair_mesh::PairSectors;
use gearwear_bodies::gear_mesh::settings::{
    Body, BodySettings, SectorSides, SpaceBody, SpaceResolution, Web, default_clamp,
};
use gearwear_bodies::gear_mesh::{self, FlankResolution, SectorSettings, ToothMeshError, ToothSector, ToothShape};
use gearwear_mesh::quality::{self, MeshQuality};
use gearwear_mesh::{CellBlock, CellKind, Mesh};
use gearwear_physics::contact::hertz;
use nalgebra::{Rotation2, Vector2};
use proptest::prelude::*;

use super::common::{assert_close, fzg_a, fzg_c, gear, pair, sector_mm2, spur, steel};

/// Load stage 9 of FZG: 302 N·m over 33.8289 mm and 14 mm.
const LINE_LOAD: f64 = 302e3 / 33.8289 / 14.0;

fn settings(pair: &GearPair, elements_per_half_width: f64) -> BodySettings {
    let module = pair.spec.normal_module_mm;
    let clamp_radius_mm = PerGear::from_fn(|g| default_clamp(pair.teeth[g].root_radius_mm, module).radius_mm);
    BodySettings::rings(clamp_radius_mm, elements_per_half_width)
}

fn sectors(pair: &GearPair, settings: &BodySettings) -> PairSectors {
    // The load grows with the module, so that the half-width stays the same part of the tooth.
    let load = LINE_LOAD * pair.spec.normal_module_mm / 4.5;
    let half_width = |xi: f64| hertz::flattening(pair, &steel(), xi).contact.loaded(load).half_width_mm;
    gear_mesh::pair_sectors(pair, settings, &half_width).expect("the teeth of the test can be meshed")
}

fn as_mesh(sector: &ToothSector) -> Mesh {
    let block = |kind| {
        let cells = sector.cells.iter().filter(|cell| cell.kind == kind);
        CellBlock::new(kind, cells.flat_map(|cell| cell.nodes().iter().map(|&node| node as usize)).collect())
    };
    Mesh {
        points: sector.points_mm.iter().map(|p| [p.x, p.y, 0.0]).collect(),
        cells: vec![block(CellKind::Triangle6), block(CellKind::Quad8)],
        ..Mesh::default()
    }
}

fn modified(mut spec: PairSpec, tip_rounding_mm: f64) -> PairSpec {
    for g in Gear::BOTH {
        spec.gears[g].modification = Modification {
            tip_relief: Some(Relief { amount_mm: 0.02, length_mm: 2.0, shape: ReliefShape::Linear }),
            root_relief: Some(Relief { amount_mm: 0.015, length_mm: 1.5, shape: ReliefShape::Parabolic }),
            profile_crowning_mm: 0.005,
            tip_rounding_mm,
            ..Modification::default()
        };
    }
    spec
}

fn chamfered(mut spec: PairSpec) -> PairSpec {
    for g in Gear::BOTH {
        spec.gears[g].tip_chamfer = Some(TipChamfer { height_mm: 0.4, angle_rad: 50f64.to_radians() });
    }
    spec
}

/// Pairs of every kind: standard, modified, sharp and full fillets, few teeth, many teeth, undercut.
fn pairs() -> Vec<(&'static str, PairSpec)> {
    let mut full_fillet = fzg_c();
    // The greatest factor that fits the rack 20°, 1.25: the fillets of a space meet.
    full_fillet.rack.fillet_radius_factor = 0.4719;
    let mut sharp_rack = fzg_c();
    sharp_rack.rack.fillet_radius_factor = 0.0;
    vec![
        ("fzg-c", fzg_c()),
        ("fzg-a", fzg_a()),
        ("relieved, rounded", modified(fzg_c(), 0.3)),
        ("relieved, hardly rounded", modified(fzg_c(), 0.02)),
        ("chamfered", chamfered(fzg_c())),
        ("relieved, rounded, chamfered", chamfered(modified(fzg_c(), 0.2))),
        ("relieved, sharp", modified(fzg_c(), 0.0)),
        ("full fillet", full_fillet),
        ("sharp rack", sharp_rack),
        ("eight teeth", spur(2.0, 57.1, 14.0, gear(8, 0.55, Some(21.6)), gear(48, 0.0, Some(99.6)))),
        ("many teeth", spur(1.0, 120.0, 14.0, gear(40, 0.0, None), gear(200, 0.0, None))),
        ("undercut", spur(2.0, 60.05, 14.0, gear(12, 0.0, Some(28.0)), gear(48, 0.0, Some(98.0)))),
    ]
}

/// Worst values a mesh may have.
struct Bars {
    least_angle_deg: f64,
    greatest_angle_deg: f64,
    scaled_jacobian: f64,
    jacobian_ratio: f64,
    aspect_ratio: f64,
}

/// For the pairs below; measured at 2 to 40 elements in a half-width: 26°, 119°, 0.51, 0.70, 2.9.
const USUAL: Bars = Bars {
    least_angle_deg: 22.0,
    greatest_angle_deg: 130.0,
    scaled_jacobian: 0.42,
    jacobian_ratio: 0.6,
    aspect_ratio: 3.5,
};

/// For whatever pair there is; measured over 460 random ones under 10 to 3000 N/mm at module 4.5: 19.6°, 119°, 0.39,
/// 0.36 (where the half-width is that of half a tooth; 0.5 elsewhere), 2.9.
const ANY: Bars = Bars {
    least_angle_deg: 17.0,
    greatest_angle_deg: 140.0,
    scaled_jacobian: 0.33,
    jacobian_ratio: 0.3,
    aspect_ratio: 4.5,
};

fn assert_well_shaped(what: &str, quality: &MeshQuality, bars: &Bars) {
    assert!(quality.least_angle_deg.value >= bars.least_angle_deg, "{what}: {quality:?}");
    assert!(quality.greatest_angle_deg.value <= bars.greatest_angle_deg, "{what}: {quality:?}");
    assert!(quality.scaled_jacobian.value >= bars.scaled_jacobian, "{what}: {quality:?}");
    assert!(quality.jacobian_ratio.value >= bars.jacobian_ratio, "{what}: {quality:?}");
    assert!(quality.aspect_ratio.value <= bars.aspect_ratio, "{what}: {quality:?}");
}

#[test]
fn cells_are_well_shaped_on_teeth_of_every_kind() {
    for (name, spec) in pairs() {
        let pair = pair(&spec);
        // The finest costs most and differs least.
        let elements: &[f64] = if name == "relieved, rounded" { &[2.0, 10.0, 40.0] } else { &[2.0, 10.0] };
        for &elements in elements {
            let sectors = sectors(&pair, &settings(&pair, elements));
            for g in Gear::BOTH {
                for (kind, sector) in [("fine", &sectors.fine[g]), ("coarse", &sectors.coarse[g])] {
                    let what = format!("{name}, {} {kind}, {elements} elements", g.name());
                    let quality = quality::of_mesh(&as_mesh(sector)).unwrap_or_else(|e| panic!("{what}: {e}"));
                    assert_well_shaped(&what, &quality, &USUAL);
                }
            }
        }
    }
}

/// The cells cover the sector exactly once: their area is that inside the outline of the boundary.
#[test]
fn ver_cells_tile_the_sector() {
    for (name, spec) in pairs() {
        let pair = pair(&spec);
        let sectors = sectors(&pair, &settings(&pair, 10.0));
        for sector in Gear::BOTH.iter().flat_map(|&g| [&sectors.fine[g], &sectors.coarse[g]]) {
            // Every inner side belongs to two cells, with the same middle node; the others make one closed boundary.
            let mut sides: BTreeMap<(u32, u32), (usize, u32, f64)> = BTreeMap::new();
            for cell in &sector.cells {
                let nodes = cell.nodes();
                let corners = nodes.len() / 2;
                for k in 0..corners {
                    let (a, b, middle) = (nodes[k], nodes[(k + 1) % corners], nodes[corners + k]);
                    let side = sides.entry((a.min(b), a.max(b))).or_insert((0, middle, 0.0));
                    assert_eq!(side.1, middle, "{name}: sides share their middle");
                    side.0 += 1;
                    side.2 += if a < b { 1.0 } else { -1.0 };
                }
            }
            assert!(sides.values().all(|side| side.0 <= 2), "{name}");
            assert!(sides.values().all(|side| side.0 == 1 || side.2 == 0.0), "{name}: cells turn the same way");
            let border = sides.values().filter(|side| side.0 == 1).count();
            let chains = [
                &sector.working_flank.nodes,
                &sector.back_flank.nodes,
                &sector.working_fillet,
                &sector.back_fillet,
                &sector.working_root_arc,
                &sector.back_root_arc,
                &sector.tip_land,
                &sector.left_cut,
                &sector.right_cut,
                &sector.clamp,
            ];
            assert_eq!(border, chains.iter().map(|chain| chain.len() / 2).sum::<usize>(), "{name}");
            let used: std::collections::BTreeSet<u32> =
                sector.cells.iter().flat_map(|cell| cell.nodes().to_vec()).collect();
            assert_eq!(used.len(), sector.points_mm.len(), "{name}: no node without a cell");
        }
    }
}

/// Sectors and the disc within them fill the section of a gear with unmodified teeth.
#[test]
fn ver_sectors_fill_the_section_of_a_gear() {
    for (name, spec) in pairs() {
        let mut spec = spec;
        Gear::BOTH.into_iter().for_each(|g| spec.gears[g].modification = Modification::default());
        let pair = pair(&spec);
        let settings = settings(&pair, 10.0);
        let sectors = sectors(&pair, &settings);
        for g in Gear::BOTH {
            let (tooth, sector, clamp_mm) = (&pair.teeth[g], &sectors.coarse[g], settings.clamp_radius_mm[g]);
            let filled_mm2 = f64::from(tooth.teeth) * sector_mm2(sector) + PI * clamp_mm * clamp_mm;
            let section = outline::section_mm2(tooth, 0.0, clamp_mm);
            assert_close(&format!("{name}, {}", g.name()), section, filled_mm2, 5e-4);
        }
    }
}

/// Every node of the flank lies where the string construction puts it, P = T + (ρ − c) n.
#[test]
fn ver_flank_nodes_lie_on_the_relieved_involute() {
    for (name, spec) in pairs() {
        let pair = pair(&spec);
        let sectors = sectors(&pair, &settings(&pair, 10.0));
        for g in Gear::BOTH {
            let tooth = &pair.teeth[g];
            let modification = Modification { tip_rounding_mm: 0.0, ..spec.gears[g].modification };
            let base = tooth.involute.base_radius_mm;
            for (sector, sides) in [(&sectors.fine[g], [-1.0, 1.0]), (&sectors.coarse[g], [-1.0, 1.0])] {
                for (chain, side) in [&sector.working_flank, &sector.back_flank].into_iter().zip(sides) {
                    assert!(chain.rho_mm[chain.involute.clone()].windows(2).all(|pair| pair[0] < pair[1]), "{name}");
                    assert!(chain.rho_mm[chain.involute.end..].iter().all(|rho| rho.is_nan()), "{name}");
                    for k in chain.involute.clone() {
                        let (rho, point) = (chain.rho_mm[k], sector.points_mm[chain.nodes[k] as usize]);
                        let removed = removed_mm(&modification, tooth, pair.active_start_rho_mm(g), rho);
                        // Radius and polar angle of a point whose string is shorter by what is removed.
                        let free = rho - removed;
                        let theta = tooth.base_half_angle_rad - rho / base + free.atan2(base);
                        let expected = base.hypot(free) * Vector2::new(side * theta.sin(), theta.cos());
                        assert!((point - expected).norm() < 1e-11, "{name} {}: ρ = {rho}", g.name());
                    }
                }
            }
        }
    }
}

#[test]
fn ver_arcs_lie_on_their_circles() {
    for (name, spec) in pairs() {
        let pair = pair(&spec);
        let settings = settings(&pair, 10.0);
        let sectors = sectors(&pair, &settings);
        for g in Gear::BOTH {
            let tooth = &pair.teeth[g];
            for sector in [&sectors.fine[g], &sectors.coarse[g]] {
                for (what, chain, radius) in [
                    ("tip", &sector.tip_land, tooth.tip_radius_mm),
                    ("root", &sector.working_root_arc, tooth.root_radius_mm),
                    ("root", &sector.back_root_arc, tooth.root_radius_mm),
                    ("clamp", &sector.clamp, settings.clamp_radius_mm[g]),
                ] {
                    for &node in chain {
                        let off = sector.points_mm[node as usize].norm() - radius;
                        assert!(off.abs() < 1e-10, "{name} {} {what}: off by {off:e}", g.name());
                    }
                }
            }
        }
    }
}

/// The rounding is a circle of the given radius that leaves flank and tip circle without a corner.
#[test]
fn ver_the_rounding_is_the_tangent_circle() {
    let spec = modified(fzg_c(), 0.3);
    let pair = pair(&spec);
    let sectors = sectors(&pair, &settings(&pair, 20.0));
    for g in Gear::BOTH {
        let (sector, tip) = (&sectors.fine[g], pair.teeth[g].tip_radius_mm);
        let flank = &sector.working_flank;
        let at = |k: usize| sector.points_mm[flank.nodes[k] as usize];
        let (first, last) = (flank.involute.end - 1, flank.nodes.len() - 1);
        assert!(last > first + 6);
        let end = at(last);
        // Tangent to the tip circle: the centre lies on the radius of the last point.
        let centre = end * (1.0 - 0.3 / tip);
        assert!((end.norm() - tip).abs() < 1e-10);
        for k in first..=last {
            assert!(((at(k) - centre).norm() - 0.3).abs() < 1e-9, "{}: node {k}", g.name());
        }
        // Tangent to the flank: its last chord makes the angle with the radius that a chord of a smooth curve makes.
        let (chord, radius) = (at(first) - at(first - 1), at(first) - centre);
        let sine = chord.dot(&radius) / (chord.norm() * radius.norm());
        assert!(sine.abs() < chord.norm() / pair.teeth[g].tip_rho_mm() + 1e-4, "{}: {sine}", g.name());
    }
}

#[test]
fn ver_fillet_nodes_lie_on_the_root_trochoid() {
    let pair = pair(&fzg_c());
    let sectors = sectors(&pair, &settings(&pair, 10.0));
    for g in Gear::BOTH {
        let tooth = &pair.teeth[g];
        // Distance to a fine polyline of the trochoid, in the frame of the space left of the tooth.
        let curve: Vec<Vector2<f64>> = (0..=20_000)
            .map(|k| tooth.trochoid.point_mm(PI / 2.0 + (tooth.fillet_end_angle_rad - PI / 2.0) * f64::from(k) / 2e4))
            .collect();
        let to_space = Rotation2::new(-PI / f64::from(tooth.teeth));
        let sector = &sectors.fine[g];
        assert_eq!(sector.back_fillet.len() / 2, 24, "elements along a fillet");
        // The fine flank above makes them smaller at its end.
        assert!((24..40).contains(&(sector.working_fillet.len() / 2)));
        for &node in &sector.working_fillet {
            let point = to_space * sector.points_mm[node as usize];
            let to_chord = |chord: &[Vector2<f64>]| {
                let (along, to) = (chord[1] - chord[0], point - chord[0]);
                let t = (to.dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
                (to - t * along).norm()
            };
            let nearest = curve.windows(2).map(to_chord).fold(f64::INFINITY, f64::min);
            // Height of the arc over a chord of some 3 mm/20 000, radius of curvature above 1 mm.
            assert!(nearest < 1e-7, "{}: {nearest:e}", g.name());
        }
    }
}

#[test]
fn cuts_match_under_rotation_by_the_pitch() {
    for (name, spec) in pairs() {
        let pair = pair(&spec);
        let sectors = sectors(&pair, &settings(&pair, 10.0));
        for g in Gear::BOTH {
            let turn = Rotation2::new(2.0 * PI / f64::from(pair.teeth[g].teeth));
            let (fine, coarse) = (&sectors.fine[g], &sectors.coarse[g]);
            let points = |sector: &ToothSector, cut: &[u32]| -> Vec<Vector2<f64>> {
                cut.iter().map(|&node| sector.points_mm[node as usize]).collect()
            };
            let left = points(fine, &fine.left_cut);
            assert!((4..=20).contains(&(left.len() / 2)), "{name}: {} elements on a cut", left.len() / 2);
            assert!(left.windows(2).all(|pair| pair[0].norm() < pair[1].norm()));
            for right in [points(fine, &fine.right_cut), points(coarse, &coarse.right_cut)] {
                assert_eq!(left.len(), right.len(), "{name}");
                for (left, right) in left.iter().zip(&right) {
                    assert!((turn * right - left).norm() < 1e-11, "{name}: {left} {right}");
                }
            }
        }
    }
}

/// Elements of the working flank are as long as asked for, a whole number on each stretch making them a little shorter.
#[test]
fn flank_elements_have_the_length_asked_for() {
    let pair = pair(&fzg_c());
    let sectors = sectors(&pair, &settings(&pair, 10.0));
    for g in Gear::BOTH {
        let (sector, start) = (&sectors.fine[g], pair.active_start_rho_mm(g));
        let (nodes, rho) = sector.working_flank.resolved_nodes();
        assert!(rho[0] < start);
        let base = pair.teeth[g].involute.base_radius_mm;
        for k in (0..nodes.len() - 2).step_by(2) {
            let middle = rho[k + 1].clamp(start, pair.teeth[g].tip_rho_mm());
            let position = pair.path.rho_mm(g, middle);
            let a = hertz::flattening(&pair, &steel(), position).contact.loaded(LINE_LOAD).half_width_mm;
            let length = (rho[k + 2].powi(2) - rho[k].powi(2)) / (2.0 * base);
            assert!(length <= 1.005 * a / 10.0, "{}: {length} at ρ = {middle}, a = {a}", g.name());
            // Below, only where the length may not grow as fast as the half-width does.
            assert!(
                length >= 0.9 * a / 10.0 || middle < start + 1.0,
                "{}: {length} at ρ = {middle}, a = {a}",
                g.name()
            );
        }
    }
}

/// Elements of roundings, and those of the flank that the mate's rounding touches, are refined as asked for; others keep their length.
#[test]
fn roundings_are_refined_by_themselves() {
    let mut spec = fzg_c();
    Gear::BOTH.into_iter().for_each(|g| spec.gears[g].modification.tip_rounding_mm = 0.1);
    let pair = pair(&spec);
    let settings = settings(&pair, 3.0);
    let [usual, refined] =
        [1.0, 3.0].map(|rounding_refinement| sectors(&pair, &BodySettings { rounding_refinement, ..settings }));
    for g in Gear::BOTH {
        // Lengths of the elements at the start of active profile, on the middle of the flank and on the rounding.
        let lengths_mm = |sectors: &PairSectors| {
            let sector = &sectors.fine[g];
            let (nodes, _) = sector.working_flank.resolved_nodes();
            let point = |k: usize| sector.points_mm[nodes[k] as usize];
            let ends = || (0..nodes.len() - 2).step_by(2).map(|k| (point(k), point(k + 2)));
            let at_radius = |radius_mm: f64| {
                let near =
                    ends().min_by(|a, b| (a.0.norm() - radius_mm).abs().total_cmp(&(b.0.norm() - radius_mm).abs()));
                near.map(|(a, b)| (b - a).norm()).unwrap()
            };
            let involute = pair.teeth[g].involute;
            let at_start = at_radius(involute.radius_mm(pair.active_start_rho_mm(g)));
            [at_start, at_radius(pair.working_pitch_radius_mm(g)), at_radius(pair.teeth[g].tip_radius_mm)]
        };
        let (usual, refined) = (lengths_mm(&usual), lengths_mm(&refined));
        let ratio = [0, 1, 2].map(|k| refined[k] / usual[k]);
        assert!((ratio[0] - 1.0 / 3.0).abs() < 0.04, "{}: {usual:?} {refined:?}", g.name());
        assert!((ratio[1] - 1.0).abs() < 0.02, "{}: {usual:?} {refined:?}", g.name());
        assert!((ratio[2] - 1.0 / 3.0).abs() < 0.04, "{}: {usual:?} {refined:?}", g.name());
    }
}

#[test]
fn kinks_of_reliefs_fall_on_nodes() {
    let spec = modified(fzg_c(), 0.3);
    let pair = pair(&spec);
    let sectors = sectors(&pair, &settings(&pair, 10.0));
    for g in Gear::BOTH {
        let chain = &sectors.fine[g].working_flank;
        for kink in [pair.teeth[g].tip_rho_mm() - 2.0, pair.active_start_rho_mm(g) + 1.5, pair.active_start_rho_mm(g)] {
            let ends = chain.rho_mm.iter().step_by(2);
            let nearest = ends.map(|rho| (rho - kink).abs()).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-9, "{}: {nearest:e} from ρ = {kink}", g.name());
        }
    }
}

/// Sizes the rest of the program counts on, fzg-c with 10 elements in a half-width: 12 to 25 thousand degrees of freedom
/// for a resolved tooth, below 1500 for another.
/// Elements are a third as long where linear reliefs begin, on the flank that has one and where the mate meets it, and the quadrilaterals lie under as much of
/// the flank as without.
#[test]
fn kinks_have_short_elements_and_quadrilaterals() {
    let plain = pair(&fzg_c());
    let mut spec = fzg_c();
    spec.gears.pinion.modification.tip_relief =
        Some(Relief { amount_mm: 0.015, length_mm: 2.0, shape: ReliefShape::Linear });
    let relieved = pair(&spec);
    for elements in [3.0, 10.0] {
        let of = |pair: &GearPair| sectors(pair, &settings(pair, elements)).fine;
        let (before, after) = (of(&plain), of(&relieved));
        for g in Gear::BOTH {
            let radii = |sector: &ToothSector| {
                let quads = sector.cells.iter().filter(|cell| cell.kind == CellKind::Quad8);
                let radii = quads.flat_map(|cell| cell.nodes()).map(|&node| sector.points_mm[node as usize].norm());
                radii.fold((f64::INFINITY, 0.0_f64), |(low, high), radius| (low.min(radius), high.max(radius)))
            };
            let ((low, high), (least, greatest)) = (radii(&before[g]), radii(&after[g]));
            assert!(
                least < low + 0.1 && greatest > high - 0.1,
                "{g:?} {elements}: {low} to {high}, {least} to {greatest} mm"
            );
            let position_mm = relieved.teeth.pinion.tip_rho_mm() - 2.0;
            let kink_rho_mm = relieved.path.rho_mm(g, position_mm);
            let length_mm = |sector: &ToothSector| {
                let (_, rho) = sector.working_flank.resolved_nodes();
                let k = rho.partition_point(|&rho| rho < kink_rho_mm).clamp(2, rho.len() - 2);
                let arc_mm = |k: usize| relieved.teeth[g].involute.arc_mm(rho[k]);
                arc_mm(k) - arc_mm(k - 1)
            };
            let ratio = length_mm(&after[g]) / length_mm(&before[g]);
            assert!((0.25..0.45).contains(&ratio), "{g:?} {elements}: {ratio}");
        }
    }
}

#[test]
fn sectors_have_the_size_they_should() {
    let pair = pair(&fzg_c());
    let sectors = sectors(&pair, &settings(&pair, 10.0));
    for g in Gear::BOTH {
        assert!((12_000..25_000).contains(&sectors.fine[g].dofs()), "{}", sectors.fine[g].dofs());
        assert!(sectors.coarse[g].dofs() < 1500, "{}", sectors.coarse[g].dofs());
    }
}

#[test]
fn the_same_tooth_gives_the_same_bits() {
    let pair = pair(&modified(fzg_c(), 0.3));
    let settings = settings(&pair, 10.0);
    let [one, other] = [sectors(&pair, &settings), sectors(&pair, &settings)];
    // Debug text shows every bit of a number, and NaN as NaN.
    assert!(format!("{one:?}") == format!("{other:?}"));
}

fn pair_mesh(pair: &GearPair, body: Body, position_mm: f64) -> Mesh {
    let settings = BodySettings { body, ..settings(pair, 6.0) };
    let sectors = sectors(pair, &settings);
    gear_mesh::pair_mesh(pair, &settings, &sectors, &gear_mesh::touching_pairs(pair, [0.0; 2]), position_mm).unwrap()
}

/// Nodes of a set of lines.
fn nodes_of(mesh: &Mesh, set: &str) -> Vec<Vector2<f64>> {
    let cells = &mesh.cell_sets[set];
    let mut nodes: Vec<usize> = mesh
        .cells
        .iter()
        .zip(cells)
        .flat_map(|(block, numbers)| {
            let n = block.kind.node_count();
            numbers.iter().flat_map(move |&cell| block.nodes[n * cell..n * (cell + 1)].to_vec())
        })
        .collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes.into_iter().map(|node| Vector2::new(mesh.points[node][0], mesh.points[node][1])).collect()
}

/// At any position the flanks of pair k touch on the line of action, at ξ + k p_b, and nowhere cut into each other.
#[test]
fn ver_working_flanks_touch_on_the_line_of_action() {
    let pair = pair(&fzg_c());
    let (sin, cos) = pair.working_pressure_angle_rad.sin_cos();
    let t1 = pair.path.involute.pinion.base_radius_mm * Vector2::new(sin, cos);
    for position in [pair.path.start_mm + 0.5, pair.path.pitch_point_mm, pair.path.end_mm - 0.5] {
        let mesh = pair_mesh(&pair, Body::Ring, position);
        let mut touched = 0;
        for (index, name) in [(-1.0, "flank-1"), (0.0, "flank-0"), (1.0, "flank+1")] {
            let xi = position + index * pair.path.base_pitch_mm;
            if xi < pair.path.start_mm + 0.2 || xi > pair.path.end_mm - 0.2 {
                continue;
            }
            let contact = t1 + xi * Vector2::new(-cos, sin);
            // The nodes nearest to the contact point lie on the common tangent, (sin α, cos α), but for the curvature.
            for g in Gear::BOTH {
                let nodes = nodes_of(&mesh, &format!("{}-{name}", g.name()));
                let near =
                    nodes.iter().map(|node| node - contact).min_by(|a, b| a.norm().total_cmp(&b.norm())).unwrap();
                // Half an element of 0.25/6 mm, the middle node between.
                assert!(near.norm() < 0.03, "{name} {}: {}", g.name(), near.norm());
                let across = near.dot(&Vector2::new(-cos, sin));
                let drop = near.norm_squared() / (2.0 * pair.path.rho_mm(g, xi));
                let sign = if g == Gear::Pinion { -1.0 } else { 1.0 };
                assert!((across - sign * drop).abs() < 1e-6, "{name} {}: {across:e} {drop:e}", g.name());
            }
            touched += 1;
        }
        assert!(touched >= 1);
    }
}

#[test]
fn a_ring_is_closed_and_a_sector_has_sides() {
    let pair = pair(&fzg_c());
    let ring = pair_mesh(&pair, Body::Ring, pair.path.pitch_point_mm);
    let sector = pair_mesh(&pair, Body::Sector { teeth: 3, sides: SectorSides::Free }, pair.path.pitch_point_mm);
    assert!(!ring.cell_sets.contains_key("pinion-sides") && sector.cell_sets.contains_key("pinion-sides"));
    for (mesh, teeth) in [(&ring, [16, 24]), (&sector, [3, 3])] {
        let quality = quality::of_mesh(mesh).unwrap();
        assert_well_shaped("pair", &quality, &USUAL);
        for (name, teeth) in ["pinion", "wheel"].into_iter().zip(teeth) {
            // Three resolved teeth; one land per tooth, on the tip circle.
            assert!(
                ["flank-1", "flank-0", "flank+1"]
                    .iter()
                    .all(|flank| mesh.cell_sets.contains_key(&format!("{name}-{flank}")))
            );
            assert!(!mesh.cell_sets.contains_key(&format!("{name}-flank+2")));
            let clamp: usize = mesh.cell_sets[&format!("{name}-clamp")].iter().map(Vec::len).sum();
            assert_eq!(clamp % teeth, 0);
        }
        // All cells belong to one of the bodies; lines to their surfaces.
        let bodies: usize = ["pinion", "wheel"].iter().flat_map(|body| &mesh.cell_sets[*body]).map(Vec::len).sum();
        assert_eq!(bodies, quality.cells);
    }
    // A closed ring has as many sides of cells at its border as it has lines: nothing is left open between teeth.
    let mut sides: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for block in &ring.cells[..2] {
        let corners = block.kind.node_count() / 2;
        for cell in block.iter() {
            for k in 0..corners {
                let (a, b) = (cell[k], cell[(k + 1) % corners]);
                *sides.entry((a.min(b), a.max(b))).or_default() += 1;
            }
        }
    }
    assert_eq!(sides.values().filter(|&&count| count == 1).count(), ring.cells[2].len());
}

#[test]
fn what_cannot_be_meshed_is_refused() {
    let pair = pair(&fzg_c());
    let shape = ToothShape::of(&pair, Gear::Pinion);
    let mesh = |clamp_radius_mm: f64, half_width_mm: f64, elements_per_half_width: f64| {
        let half_width = move |_: f64| half_width_mm;
        let flank = FlankResolution {
            half_width_mm: &half_width,
            elements_per_half_width,
            rounding_refinement: 1.0,
            margin_mm: 3.0 * half_width_mm,
            depth_half_widths: 1.0,
        };
        gear_mesh::sector(&shape, &SectorSettings { clamp_radius_mm, fillet_elements: 24, flank: Some(flank) })
    };
    assert!(mesh(20.0, 0.25, 10.0).is_ok());
    // r_f = 36 + 0.1817·4.5 − 5.625 = 31.1927 mm less a tenth of the module.
    for clamp in [0.0, -1.0, 31.0, f64::NAN] {
        assert!(matches!(mesh(clamp, 0.25, 10.0), Err(ToothMeshError::ClampRadius { .. })), "{clamp}");
    }
    for half_width in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        assert!(matches!(mesh(20.0, half_width, 10.0), Err(ToothMeshError::ElementLength { .. })), "{half_width}");
    }
    assert!(matches!(mesh(20.0, 0.25, 0.0), Err(ToothMeshError::NotPositive { .. })));
    let settings = BodySettings { body: Body::Sector { teeth: 4, sides: SectorSides::Free }, ..settings(&pair, 6.0) };
    let sectors = sectors(&pair, &settings);
    assert!(matches!(
        gear_mesh::pair_mesh(&pair, &settings, &sectors, &[0], 14.0),
        Err(ToothMeshError::SectorTeeth { sector_teeth: 4, teeth: 16 })
    ));
}

/// Any element length, from one that fills the tip land to a hundredth of it, gives a sound mesh.
#[test]
fn any_load_gives_a_mesh() {
    let pair = pair(&modified(fzg_c(), 0.1));
    for (half_width_mm, elements_per_half_width) in [(0.01, 4.0), (0.05, 8.0), (0.25, 8.0), (1.0, 8.0), (4.0, 8.0)] {
        let half_width = move |_: f64| half_width_mm;
        for g in Gear::BOTH {
            let flank = FlankResolution {
                half_width_mm: &half_width,
                elements_per_half_width,
                rounding_refinement: 1.0,
                margin_mm: 3.0 * half_width_mm,
                depth_half_widths: 1.0,
            };
            let clamp_radius_mm = pair.teeth[g].root_radius_mm - 11.25;
            let settings = SectorSettings { clamp_radius_mm, fillet_elements: 24, flank: Some(flank) };
            let sector = gear_mesh::sector(&ToothShape::of(&pair, g), &settings).unwrap();
            let quality = quality::of_mesh(&as_mesh(&sector)).unwrap();
            assert_well_shaped(&format!("{} a = {half_width_mm}", g.name()), &quality, &ANY);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// Whatever pair exists can be meshed, and well.
    #[test]
    fn prop_any_pair_can_be_meshed(
        teeth in (8u32..80, 8u32..80),
        shifts in (-0.3f64..0.7, -0.3f64..0.7),
        fillet in 0.1f64..0.45,
        module in 0.5f64..10.0,
        spread in 0.0f64..0.5,
        rounding in 0.0f64..0.1,
        relief_um in 0.0f64..20.0,
    ) {
        let centre = module * (0.5 * f64::from(teeth.0 + teeth.1) + shifts.0 + shifts.1 + spread * 0.2);
        let mut spec = spur(module, centre, 10.0, gear(teeth.0, shifts.0, None), gear(teeth.1, shifts.1, None));
        spec.rack.fillet_radius_factor = fillet;
        for g in Gear::BOTH {
            let relief = Relief { amount_mm: relief_um * 1e-3 * module / 4.5, length_mm: 0.4 * module, shape: ReliefShape::Linear };
            spec.gears[g].modification =
                Modification { tip_relief: Some(relief), tip_rounding_mm: rounding * module, ..Modification::default() };
        }
        let Ok(pair) = GearPair::new(&spec) else { return Ok(()) };
        let settings = settings(&pair, 4.0);
        let load = LINE_LOAD * module / 4.5;
        let half_width = |xi: f64| hertz::flattening(&pair, &steel(), xi).contact.loaded(load).half_width_mm;
        match gear_mesh::pair_sectors(&pair, &settings, &half_width) {
            Ok(sectors) => {
                for g in Gear::BOTH {
                    for sector in [&sectors.fine[g], &sectors.coarse[g]] {
                        let quality = quality::of_mesh(&as_mesh(sector)).unwrap();
                        assert_well_shaped("pair", &quality, &ANY);
                    }
                }
            }
            // Relieved teeth are thinner than the pair's own checks take them for.
            Err(ToothMeshError::TipRounding { .. } | ToothMeshError::PointedTip { .. }) => {}
            Err(error) => prop_assert!(false, "{error}"),
        }
    }
}

#[test]
fn elements_over_the_face_width_end_with_slices() {
    // The preset `helical`: transverse module 4.5 mm.
    let helix_angle_rad = 15f64.to_radians();
    let normal_module_mm = 4.5 * helix_angle_rad.cos();
    let pair = &PairSpec { helix_angle_rad, normal_module_mm, face_width_mm: 20.0, ..fzg_c() };
    let solid = PerGear { pinion: None, wheel: None }.map(|web| SpaceBody { clamp_radius_mm: 20.0, web });
    let even = |slices| SpaceResolution { slices, ..SpaceResolution::USUAL }.even_layers(pair);
    // 20 mm are 14.4 times 0.32 modules of 4.5 mm · cos 15°.
    assert_eq!([None, Some(5), Some(10), Some(20), Some(40), Some(80)].map(even), [15, 10, 10, 10, 20, 20]);
    assert_eq!([Some(24), Some(30), Some(60), Some(29), Some(23)].map(even), [12, 15, 20, 15, 15]);
    // 43 mm of module 6 mm under 26.2°, ε_β = 1.007, have all elements that there may be; under 15°, ε_β = 0.590, half as many.
    let of_helix = |degrees: f64| {
        let helix_angle_rad = degrees.to_radians();
        let wide = PairSpec { helix_angle_rad, normal_module_mm: 6.0, face_width_mm: 43.0, ..fzg_c() };
        SpaceResolution { slices: Some(20), ..SpaceResolution::USUAL }.even_layers(&wide)
    };
    assert_eq!([26.2, 15.0].map(of_helix), [20, 10]);
    let ends = SpaceResolution::of_slices(60).layer_ends_mm(pair, &solid);
    assert_eq!(ends.len(), 23);
    for (found, expected) in [(ends[1], 1.0 / 3.0), (ends[2], 1.0), (ends[20], 19.0), (ends[21], 20.0 - 1.0 / 3.0)] {
        assert!((found - expected).abs() < 1e-12, "{ends:?}");
    }
    // Of this web one face lies between two of them, and one at an end that is there, but for rounding.
    let web = Web { thickness_mm: 5.1 + 1e-9, rim_thickness_mm: 6.0, offset_mm: 1.55 };
    let bodies = PerGear { pinion: None, wheel: Some(web) }.map(|web| SpaceBody { clamp_radius_mm: 20.0, web });
    let with_web = SpaceResolution::of_slices(60).layer_ends_mm(pair, &bodies);
    let new: Vec<f64> = with_web.iter().copied().filter(|end| !ends.contains(end)).collect();
    assert!(with_web.len() == 24 && with_web.is_sorted() && (new[0] - 14.1).abs() < 1e-6, "{with_web:?}");
}
