//! The results of a run as attributes of the stage it was of.
//!
//! Where they stand follows the section "Load spectra" of the specification (spec.rexs.info, version 1.6): a load case holds what varies from
//! load to load, the accumulation what is summed up over all of them, all load cases have as many attributes, and what stands in these does
//! not stand in the model too.
//!
//! | file and run | figures of a load | of the whole life |
//! |---|---|---|
//! | no load spectrum, the same load | model | model |
//! | one load case, the same load | the load case | accumulation |
//! | several load cases, a phase for each with its load | in every load case those known of it; those of the greatest load alone in the accumulation, under an id that says so | accumulation |
//! | other loads than in the file | those of the greatest load, under an id that says so, in the accumulation, or the model without load spectrum | the same |
//!
//! Figures that no load changes stand in the model.

use std::collections::BTreeSet;

use quick_xml::escape::escape;
use serde_json::Value;

use super::RexsError;
use super::attributes::{self, AttributeKind, CUSTOM, FigureAttribute, Naming, Of, On};
use super::document::{RexsComponent, RexsDocument};
use super::drivetrain::Drivetrain;
use super::json;
use super::load;
use super::mesh_stiffness::MeshStiffness;
use super::places::{LoadSpectrum, NewElement, Places};
use super::planetary_unit;
use super::same_loads::{LoadOfPhase, Loads};
use super::same_pair;
use super::scene_text::rounded;
use super::stage::{GearData, Gears, RexsStage};
use crate::evaluate::output::SummaryOutput;
use crate::scene::planetary::mesh::{PerMesh, StageMesh};
use gearwear_bodies::gear::spec::PairSpec;
use gearwear_bodies::gear::{Gear, PerGear};

/// The version whose names of attributes are the first to be written.
const WRITTEN_FROM: &str = "1.4";
const GEAR_IN_STAGE: &str = "cylindrical_stage_gear_data";
const RING: &str = "ring_gear";

/// Results of a finished run that are written.
#[derive(Debug, Clone)]
pub struct RunResults {
    /// `summary.json`.
    pub summary: Value,
    pub pair: PairSpec,
    pub mesh_stiffness: MeshStiffness,
    pub wear_profile: PerGear<WearDepths>,
}

/// Wear depth of a flank from root to tip.
#[derive(Debug, Clone, Default)]
pub struct WearDepths {
    pub radius_mm: Vec<f64>,
    /// Maximum over the face width.
    pub depth_um: Vec<f64>,
}

/// A file with results in it.
#[derive(Debug)]
pub struct WithResults {
    /// The file.
    pub text: String,
    /// The stage, as messages name it.
    pub stage: String,
    /// Attributes that are in the format's database.
    pub standard: usize,
    /// Attributes that are not.
    pub custom: usize,
    pub warnings: Vec<String>,
}

/// A part of the file that says something of components.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FileSection {
    Model,
    /// By its place among the load cases.
    LoadCase(usize),
    Accumulation,
}

/// A component that results belong to.
#[derive(Debug)]
struct Target {
    on: On,
    /// The gear; of a stage none.
    gear: Option<Gear>,
    id: String,
    kind: &'static str,
    /// Line of its tag; None where the file does not have it yet.
    line: Option<usize>,
}

/// An attribute and where it is to stand.
#[derive(Debug)]
struct Placed {
    section: FileSection,
    /// Index of its target.
    target: usize,
    attribute: NewElement,
}

/// Results of a finished run of a planetary stage that are written.
#[derive(Debug, Clone)]
pub struct StageResults {
    /// `summary.json` of the stage.
    pub summary: Value,
    pub meshes: PerMesh<RunResults>,
}

/// The file of this text with the results of a run of its `number`-th cylindrical stage, from 1, or of its only one.
///
/// # Errors
///
/// As for [`super::scene`]; a run of another pair, and more than one load spectrum.
pub fn with_results(text: &str, number: Option<usize>, run: &RunResults) -> Result<WithResults, RexsError> {
    let document = opened(text)?;
    // What a scene cannot say of the stage was told when it was made.
    let stage = RexsStage::find(&document, number, &mut Vec::new())?;
    let train = Drivetrain::of(&document);
    let gears = stage.gears(&document, &train, &mut Vec::new())?;
    same_pair::check(&stage, &gears, &run.pair)?;
    let load = load::of(&document, &train, &stage, &gears, &mut Vec::new())?;
    let loads = Loads::of(&document, &load, &LoadOfPhase::all_of(&run.summary));
    written(text, &document, (&stage, &gears, loads), run)
}

/// The file of this text with the results of a run of the planetary stage whose mesh of sun and planet its `number`-th cylindrical stage is: in this
/// mesh, and in that of the same planet with the ring.
///
/// # Errors
///
/// As for [`with_results`]; a stage whose gears meet no ring.
pub fn with_results_of_stage(text: &str, number: Option<usize>, run: &StageResults) -> Result<WithResults, RexsError> {
    let with_sun = with_results_of_mesh(text, number, run, StageMesh::SunPlanet)?;
    let with_both = with_results_of_mesh(&with_sun.text, number, run, StageMesh::PlanetRing)?;
    Ok(WithResults {
        stage: format!("{} and {}", with_sun.stage, with_both.stage),
        standard: with_sun.standard + with_both.standard,
        custom: with_sun.custom + with_both.custom,
        ..with_both
    })
}

/// The file with the results of one mesh of a planetary stage.
fn with_results_of_mesh(
    text: &str,
    number: Option<usize>,
    run: &StageResults,
    mesh: StageMesh,
) -> Result<WithResults, RexsError> {
    let document = opened(text)?;
    let stage = RexsStage::find(&document, number, &mut Vec::new())?;
    let train = Drivetrain::of(&document);
    let gears = stage.gears(&document, &train, &mut Vec::new())?;
    let unit = planetary_unit::of(&document, &stage, &gears, &mut Vec::new())?;
    let unit = unit.ok_or_else(|| RexsError::NoRing { stage: stage.component.label() })?;
    let load = load::of(&document, &train, &stage, &gears, &mut Vec::new())?;
    let loads = Loads::of(&document, &load, &run.loads_of_driving_gear(unit.sun_drives));
    let (sun, planet) = if unit.sun_drives { (gears.pinion, gears.wheel) } else { (gears.wheel, gears.pinion) };
    let (stage, pinion, wheel) = match mesh {
        StageMesh::SunPlanet => (stage, sun, planet),
        StageMesh::PlanetRing => {
            let of_planet = unit.ring_mesh.data_of(&document, planet.component);
            let of_ring = unit.ring_mesh.data_of(&document, unit.ring.component);
            let planet = GearData { in_stage: of_planet, ..planet };
            (unit.ring_mesh, planet, GearData { in_stage: of_ring, ..unit.ring })
        }
    };
    let gears = Gears { pinion, wheel, ..gears };
    let run = &run.meshes[mesh];
    same_pair::check(&stage, &gears, &run.pair)?;
    written(text, &document, (&stage, &gears, loads), run)
}

impl StageResults {
    /// Loads of the sun in its mesh with one planet in the phases of the run, or of the planet where that drives it.
    fn loads_of_driving_gear(&self, sun_drives: bool) -> Vec<LoadOfPhase> {
        let planetary = &self.summary["planetary"];
        // The sun of a mesh turns relative to the carrier, that of the file to the housing.
        let of_sun = planetary["speed_ratio"]["sun"].as_f64().zip(planetary["planets"].as_f64());
        let of_sun = of_sun.zip(planetary["meshes_per_revolution"]["sun"].as_f64());
        let factor = of_sun.map(|((ratio, planets), meshes)| ratio.abs() * planets / meshes).filter(|_| sun_drives);
        let mesh = if sun_drives { StageMesh::SunPlanet } else { StageMesh::PlanetRing };
        let phases = LoadOfPhase::all_of(&self.meshes[mesh].summary).into_iter();
        let of_file = |phase: LoadOfPhase| LoadOfPhase {
            speed_rpm: phase.speed_rpm.zip(factor).map(|(speed_rpm, factor)| speed_rpm * factor),
            ..phase
        };
        phases.map(of_file).collect()
    }
}

/// The file of this text, if results can be written into it.
fn opened(text: &str) -> Result<RexsDocument, RexsError> {
    if json::is_json(text) {
        return Err(RexsError::OnlyXml);
    }
    let document = RexsDocument::parse(text)?;
    if document.version.as_str() < WRITTEN_FROM {
        let (line, found) = (document.version_line, document.version);
        return Err(RexsError::Version { line, found, allowed: "1.4 to 1.7 and 2.0" });
    }
    Ok(document)
}

/// The file with the results of a run of this mesh, whose gears are the pinion and wheel of the run, under these loads.
fn written(
    text: &str,
    document: &RexsDocument,
    (stage, gears, loads): (&RexsStage, &Gears, Loads),
    run: &RunResults,
) -> Result<WithResults, RexsError> {
    let mut places = Places::of(text)?;
    let spectrum = places.load_spectrum()?.filter(|spectrum| !spectrum.cases.is_empty());
    if spectrum.as_ref().map_or(0, |spectrum| spectrum.cases.len()) != document.load_cases.len() {
        return Err(RexsError::NoModel { line: 1, found: "a load_case outside <load_spectrum>".to_owned() });
    }
    let targets = targets(stage, gears, &places);
    let writer = Writer {
        run,
        naming: Naming::of(document, loads),
        loads,
        has_spectrum: spectrum.is_some(),
        load_cases: document.load_cases.len() as u64,
        targets: &targets,
    };
    let placed = writer.placed();
    add_gear_data(&mut places, stage, gears, &targets)?;
    put(&mut places, spectrum.as_ref(), &targets, &placed)?;

    let custom = placed.iter().filter(|placed| placed.attribute.id().starts_with(CUSTOM)).count();
    let mut warnings = Vec::new();
    if loads == Loads::Different {
        warnings.push(
            "the loads of the run are not those of the file: what depends on the load is written under custom_gearwear_greatest_load_…"
                .to_owned(),
        );
    }
    Ok(WithResults {
        text: places.changed(),
        stage: stage.component.label(),
        standard: placed.len() - custom,
        custom,
        warnings,
    })
}

/// The stage, its gears, and what is of each gear in it.
fn targets(stage: &RexsStage, gears: &Gears, places: &Places) -> Vec<Target> {
    let target =
        |on, gear, known: &RexsComponent, kind| Target { on, gear, id: known.id.clone(), kind, line: Some(known.line) };
    let mut targets = vec![target(On::Stage, None, stage.component, "cylindrical_stage")];
    let mut taken = BTreeSet::new();
    for (gear, data) in [(Gear::Pinion, &gears.pinion), (Gear::Wheel, &gears.wheel)] {
        let kind = if data.component.kind == RING { RING } else { "cylindrical_gear" };
        targets.push(target(On::Gear, Some(gear), data.component, kind));
        targets.push(match data.in_stage {
            Some(known) => target(On::GearInStage, Some(gear), known, GEAR_IN_STAGE),
            None => {
                let id = places.free_id("component", &taken);
                taken.insert(id.clone());
                Target { on: On::GearInStage, gear: Some(gear), id, kind: GEAR_IN_STAGE, line: None }
            }
        });
    }
    targets
}

struct Writer<'a> {
    run: &'a RunResults,
    naming: Naming<'a>,
    loads: Loads,
    has_spectrum: bool,
    load_cases: u64,
    targets: &'a [Target],
}

impl Writer<'_> {
    /// All attributes that the run has a value for.
    fn placed(&self) -> Vec<Placed> {
        let mut placed = Vec::new();
        for (key, attribute) in
            [("program_version", &attributes::PROGRAM_VERSION), ("scene_hash", &attributes::SCENE_HASH)]
        {
            let text = self.run.summary[key].as_str().map(|text| escape(text).into_owned());
            placed.extend(text.and_then(|text| self.place(attribute, None, text)));
        }
        for figure in attributes::figures() {
            self.figure(&figure, &mut placed);
        }
        self.mesh_stiffness(&mut placed);
        self.wear_profiles(&mut placed);
        placed
    }

    fn figure(&self, figure: &FigureAttribute, placed: &mut Vec<Placed>) {
        let of = figure.attribute.of;
        for gear in self.targets.iter().filter(|target| target.on == figure.attribute.on).map(|target| target.gear) {
            if matches!(of, Of::Phase | Of::Torque) && self.loads == Loads::PhaseForEach {
                // All load cases have as many attributes: each has it, or none.
                let values: Option<Vec<f64>> =
                    (1..=self.load_cases).map(|phase| self.of_phase(figure, gear, phase)).collect();
                for (case, value) in values.into_iter().flatten().enumerate() {
                    let section = FileSection::LoadCase(case);
                    placed.extend(self.place_number(figure, gear, value).map(|place| Placed { section, ..place }));
                }
            } else if of != Of::Phase {
                let value = self.number(&figure.path, gear, self.reference_phase());
                placed.extend(value.and_then(|value| self.place_number(figure, gear, value)));
            }
        }
    }

    fn reference_phase(&self) -> u64 {
        self.run.summary["reference_phase"].as_u64().unwrap_or(1)
    }

    /// The number at a path of the summary, of a gear and phase where the path names them.
    fn number(&self, path: &str, gear: Option<Gear>, phase: u64) -> Option<f64> {
        let path = path.replace("{gear}", gear.map_or("", Gear::name)).replace("{phase}", &phase.to_string());
        SummaryOutput::find(&path).ok()?.of(&self.run.summary)
    }

    /// A figure under the load of a phase.
    fn of_phase(&self, figure: &FigureAttribute, gear: Option<Gear>, phase: u64) -> Option<f64> {
        let value = self.number(&figure.path, gear, phase);
        if figure.attribute.of != Of::Torque {
            return value;
        }
        let [of_phase, of_reference] =
            [phase, self.reference_phase()].map(|phase| self.number("phases.{phase}.pinion_torque_Nm", None, phase));
        Some(value? * (of_phase? / of_reference?))
    }

    fn place_number(&self, figure: &FigureAttribute, gear: Option<Gear>, value: f64) -> Option<Placed> {
        self.place(&figure.attribute, gear, rounded(figure.in_unit(value)))
    }

    fn mesh_stiffness(&self, placed: &mut Vec<Placed>) {
        let pair = &self.run.pair;
        let over_pitch = self.run.mesh_stiffness.over_pitch(pair.gears.pinion.teeth);
        for (attribute, curve) in attributes::MEAN_MESH_STIFFNESS.iter().zip(&over_pitch) {
            let mean = curve.as_ref().map(|curve| rounded(curve.mean_N_per_mm_um));
            placed.extend(mean.and_then(|mean| self.place(attribute, None, mean)));
        }
        let [Some(new), _] = over_pitch else { return };
        let stiffness = array(new.stiffness_N_per_mm(pair.face_width_mm));
        placed.extend(self.place(&attributes::MESH_STIFFNESS, None, stiffness));
        for gear in Gear::BOTH {
            let per_pinion = f64::from(pair.gears.pinion.teeth) / f64::from(pair.gears[gear].teeth);
            let rotation = array(new.pinion_rotation_deg.iter().map(|angle_deg| angle_deg * per_pinion));
            placed.extend(self.place(&attributes::MESH_POSITIONS, Some(gear), rotation));
        }
    }

    fn wear_profiles(&self, placed: &mut Vec<Placed>) {
        for gear in Gear::BOTH {
            let WearDepths { radius_mm, depth_um } = &self.run.wear_profile[gear];
            let is_known = !depth_um.is_empty() && radius_mm.len() == depth_um.len();
            if is_known && radius_mm.iter().chain(depth_um).all(|value| value.is_finite()) {
                let diameters = array(radius_mm.iter().map(|radius_mm| 2.0 * radius_mm));
                placed.extend(self.place(&attributes::WEAR_DEPTH_DIAMETERS, Some(gear), diameters));
                placed.extend(self.place(&attributes::WEAR_DEPTH, Some(gear), array(depth_um.iter().copied())));
            }
        }
    }

    /// An attribute with what stands between its tags; None where this version of the format has none.
    fn place(&self, attribute: &AttributeKind, gear: Option<Gear>, markup: String) -> Option<Placed> {
        let target = self.targets.iter().position(|target| target.on == attribute.on && target.gear == gear)?;
        let id = self.naming.id(attribute)?;
        let section = self.section(attribute.of);
        Some(Placed { section, target, attribute: NewElement::attribute(id, self.naming.unit(attribute), markup) })
    }

    /// Where figures that are the same for all load cases stand.
    fn section(&self, of: Of) -> FileSection {
        match (self.has_spectrum, of) {
            (false, _) | (true, Of::Pair) => FileSection::Model,
            (true, Of::Load | Of::Torque) if self.loads == Loads::One => FileSection::LoadCase(0),
            (true, _) => FileSection::Accumulation,
        }
    }
}

fn array(values: impl IntoIterator<Item = f64>) -> String {
    let cells: String = values.into_iter().map(|value| format!("<c>{}</c>", rounded(value))).collect();
    format!("<array>{cells}</array>")
}

/// The components that the file lacks, each with the relation that names its gear and stage.
fn add_gear_data(places: &mut Places, stage: &RexsStage, gears: &Gears, targets: &[Target]) -> Result<(), RexsError> {
    let mut taken = BTreeSet::new();
    let mut relations = Vec::new();
    for target in targets.iter().filter(|target| target.line.is_none()) {
        let gear = if target.gear == Some(Gear::Wheel) { &gears.wheel } else { &gears.pinion };
        let id = places.free_id("relation", &taken);
        taken.insert(id.clone());
        let members = [(&stage.component.id, "stage"), (&gear.component.id, "gear"), (&target.id, "stage_gear_data")];
        let members = members
            .map(|(id, role)| NewElement::new("ref", vec![("id", id.clone()), ("role", role.to_owned())], Vec::new()));
        relations.push(NewElement::new(
            "relation",
            vec![("id", id), ("type", "stage_gear_data".to_owned())],
            members.into(),
        ));
    }
    if !relations.is_empty() {
        let node = places.first("relations")?;
        places.add(node, relations);
    }
    Ok(())
}

/// Whether an attribute of this id is among them.
fn has(placed: &[&Placed], id: &str) -> bool {
    placed.iter().any(|placed| placed.attribute.id() == id)
}

/// Puts all attributes in place. What an earlier run left under custom ids goes, and from the model what the load spectrum now says.
fn put(
    places: &mut Places,
    spectrum: Option<&LoadSpectrum>,
    targets: &[Target],
    placed: &[Placed],
) -> Result<(), RexsError> {
    let mut sections = vec![(FileSection::Model, Some(places.first("components")?))];
    if let Some(spectrum) = spectrum {
        sections
            .extend(spectrum.cases.iter().enumerate().map(|(case, node)| (FileSection::LoadCase(case), Some(*node))));
        sections.push((FileSection::Accumulation, spectrum.accumulation));
    }
    for (section, node) in sections {
        let mut new = Vec::new();
        for (index, target) in targets.iter().enumerate() {
            let of_target = placed.iter().filter(|placed| placed.target == index);
            let (here, elsewhere): (Vec<&Placed>, Vec<&Placed>) =
                of_target.partition(|placed| placed.section == section);
            let attributes: Vec<NewElement> = here.iter().map(|placed| placed.attribute.clone()).collect();
            if let Some(component) = node.and_then(|node| places.component(node, &target.id)) {
                places.take_out_attributes(component, |id| {
                    let is_moved = section == FileSection::Model && has(&elsewhere, id);
                    !has(&here, id) && (id.starts_with(CUSTOM) || is_moved)
                });
                places.set_attributes(component, attributes);
            } else if let (FileSection::Model, Some(line)) = (section, target.line) {
                return Err(RexsError::NoModel { line, found: "a component outside <components>".to_owned() });
            } else if !attributes.is_empty() || section == FileSection::Model {
                let xml = vec![("id", target.id.clone()), ("type", target.kind.to_owned())];
                new.push(NewElement::new("component", xml, attributes));
            }
        }
        match (node, spectrum) {
            (Some(node), _) => places.add(node, new),
            (None, Some(spectrum)) if !new.is_empty() => {
                places.add(spectrum.node, vec![NewElement::new("accumulation", Vec::new(), new)]);
            }
            _ => {}
        }
    }
    Ok(())
}
