//! Teeth in space: elements, and the condensed teeth against plane strain.

use gearwear::fem::elastic::Elastic;
use gearwear::fem::gear::in_space::{PlaneSection, TeethInSpace};
use gearwear::gear::GearPair;
use gearwear::gear_mesh::tooth_section::{ExtrudedTooth, SectionDivisions, ToothSection};

use super::common::fzg_c;

const STEEL: Elastic = Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 };

#[test]
fn try_out() {
    let pair = GearPair::new(&fzg_c()).unwrap();
    for (tooth, clamp) in [(&pair.teeth.pinion, 19.943), (&pair.teeth.wheel, 37.897)] {
        for times in [1, 2] {
            for nu in [0.3, 0.0] {
                let material = Elastic { poisson_ratio: nu, ..STEEL };
                let section = ToothSection::new(tooth, clamp, SectionDivisions::USUAL.refined(times));
                let plane = PlaneSection::new(tooth, &section, material).unwrap();
                let radius = tooth.reference_radius_mm;
                println!("z {} x{times} nu {nu} plane {:.6e}", tooth.teeth, plane.mm2_per_n(radius));
                if times == 1 {
                    let started = std::time::Instant::now();
                    let mesh = ExtrudedTooth::new(section.clone(), 14.0, 6, 0.0);
                    println!("{} nodes {} hex", mesh.points_mm.len(), mesh.hexahedra.len());
                    let teeth = TeethInSpace::new(tooth, mesh, material, 3).unwrap();
                    let mut forces = Vec::new();
                    let n = 48;
                    for k in 0..n {
                        teeth.add_load(radius, 14.0 * (k as f64 + 0.5) / n as f64, 1.0 / n as f64, &mut forces);
                    }
                    println!(
                        "space {:.6e} next {:.4e} {:.4e} {:?}",
                        14.0 * teeth.mm_per_n(&forces, &forces, 0),
                        14.0 * teeth.mm_per_n(&forces, &forces, 1),
                        14.0 * teeth.mm_per_n(&forces, &forces, 2),
                        started.elapsed()
                    );
                }
            }
        }
    }
}
