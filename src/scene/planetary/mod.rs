//! The file of a planetary stage, and the scenes of its two meshes.
//!
//! A stage is two pairs with a planet in common: sun and planet, planet and ring. The planet touches them with opposite flanks, so that neither mesh sees what the other
//! wears, and each is the scene of a pair ([`pair_scene`]), run with its own law, oil and resolution. A file with `planetary.mesh` is that of one pair, for every command
//! that takes a pair, such as that of finite elements.

#[allow(rustdoc::broken_intra_doc_links, reason = "tables of the file stand in brackets, as in TOML")]
pub mod file;
pub mod mesh;
mod pair_scene;
pub mod schema;
pub mod words;

use std::path::Path;
use std::sync::Arc;

use toml::{Table, Value};

use self::file::{MemberFile, StageFile};
use self::mesh::{PerMesh, StageMesh};
use super::draft::Draft;
use super::findings::Findings;
use super::loaded::LoadedScene;
use super::locate::Locator;
use super::problem::{ProblemKind, number};
use super::schema::Node;
use super::shape::{self, FileShape};
use super::{LoadError, Problem, Resolved, SceneError, SceneText, internal, table, text};
use gearwear_bodies::gear::planetary::{AssemblyError, Member, PlanetaryStage, ring_mesh_phase};
use gearwear_bodies::gear::{Gear, GearPair};
use gearwear_physics::results::run::InputFile;

/// Keys of other files, each with what to do.
const OF_OTHER_FILES: &[(&str, &str)] =
    &[("pair", "a planetary stage, [planetary], or a gear pair, [pair]: one of the two")];

/// A planetary stage, checked, with the scene of each mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanetaryScene {
    /// The file.
    pub given: Arc<SceneText>,
    /// Title, as given or made of the teeth.
    pub title: String,
    /// Teeth and planets.
    pub stage: PlanetaryStage,
    /// Member whose torque, speed and revolutions the file gives.
    pub member: Member,
    /// K_γ.
    pub load_sharing_factor: f64,
    /// Scene of each mesh.
    pub meshes: PerMesh<LoadedScene>,
    /// Geometry of each mesh.
    pub pairs: PerMesh<GearPair>,
    /// Least distance between the tip circles of neighbouring planets, mm; `None` of one planet.
    pub planet_clearance_mm: Option<f64>,
    /// Base pitches by which a planet's mesh with the ring is ahead of that with the sun.
    pub ring_mesh_phase: f64,
    /// What the user should know of both meshes.
    pub warnings: Vec<String>,
}

impl PlanetaryScene {
    /// The stage in a text; files it names lie in `folder`.
    ///
    /// # Errors
    /// [`LoadError`], with everything that is wrong.
    pub fn from_text(given: SceneText, folder: &Path) -> Result<Self, LoadError> {
        Self::from_parts(given, folder, &[])
    }

    /// The stage in a text: of the files it names, those among `files` need not be read, and the others lie in `folder`.
    ///
    /// # Errors
    /// As [`Self::from_text`].
    pub fn from_parts(given: SceneText, folder: &Path, files: &[InputFile]) -> Result<Self, LoadError> {
        let refused = |problems| SceneError { given: given.clone(), problems };
        let (table, mut findings) = text::parse(&given.text).map_err(refused)?;
        let Some(chosen) = ChosenStage::of(&table, &mut findings) else {
            return Err(refused(findings.in_order()).into());
        };
        let locator = findings.into_locator();
        let meshes = mesh_scenes(&chosen, (&given, folder, files), &locator)?;
        let assembled = Self::assembled(chosen, Arc::new(given.clone()), meshes, Findings::new(locator));
        Ok(assembled.map_err(refused)?)
    }

    /// The stage of `draft`, its own file with other values, whose meshes have these scenes.
    ///
    /// # Errors
    /// Everything that is wrong with the stage then.
    pub fn varied(&self, draft: &Draft, meshes: PerMesh<LoadedScene>) -> Result<Self, Vec<Problem>> {
        let (table, mut findings) = draft.to_resolve();
        match ChosenStage::of(&table, &mut findings) {
            Some(chosen) => Self::assembled(chosen, Arc::clone(&self.given), meshes, findings),
            None => Err(findings.in_order()),
        }
    }

    /// The stage of its meshes, checked as a whole.
    fn assembled(
        chosen: ChosenStage,
        given: Arc<SceneText>,
        meshes: PerMesh<LoadedScene>,
        mut findings: Findings,
    ) -> Result<Self, Vec<Problem>> {
        let pairs = meshes.as_ref().map(|scene| GearPair::new(&scene.scene().pair));
        let (Ok(with_sun), Ok(with_ring)) = (pairs.sun_planet, pairs.planet_ring) else {
            // A scene that is resolved has a pair.
            return Err(findings.in_order());
        };
        let ChosenStage { file, stage, member, title, .. } = chosen;
        let tip_diameter_mm = 2.0 * with_sun.teeth[Gear::Wheel].tip_radius_mm;
        let clearance = stage.planet_clearance_mm(with_sun.spec.centre_distance_mm, tip_diameter_mm);
        let planet_clearance_mm = clearance.unwrap_or_else(|error| {
            touching_planets(error, &mut findings);
            None
        });
        if !findings.problems.is_empty() {
            return Err(findings.in_order());
        }
        let warnings = StageMesh::BOTH.into_iter().flat_map(|mesh| {
            let of_mesh = move |warning: &String| format!("{}: {}", mesh.in_words(), words::of_stage(warning, mesh));
            meshes[mesh].warnings().iter().map(of_mesh).collect::<Vec<_>>()
        });
        Ok(Self {
            warnings: warnings.collect(),
            ring_mesh_phase: ring_mesh_phase(&with_sun, &with_ring),
            planet_clearance_mm,
            pairs: PerMesh { sun_planet: with_sun, planet_ring: with_ring },
            load_sharing_factor: file.planetary.load_sharing_factor.unwrap_or(1.0),
            member: member.into(),
            given,
            title,
            stage,
            meshes,
        })
    }
}

/// Resolves the scene of the mesh that `table`, the file of a stage, names in `planetary.mesh`.
pub(super) fn resolve_mesh(table: &Table, mut findings: Findings) -> Result<Resolved, Vec<Problem>> {
    let Some(chosen) = ChosenStage::of(table, &mut findings) else { return Err(findings.in_order()) };
    let Some(mesh) = chosen.file.planetary.mesh else {
        let allowed = StageMesh::BOTH.map(|mesh| format!("{:?}", mesh.folder())).join(" or ");
        findings.missing(&["planetary.mesh"], &allowed);
        findings.help(
            "one pair of a planetary stage is asked for here; gearwear run, plan, sweep and uncertainty take both",
        );
        return Err(findings.in_order());
    };
    let scene = chosen.pair_scene(mesh);
    let pair = SceneText { name: String::new(), text: scene.to_string() };
    let locator = findings.into_locator();
    match pair.resolve() {
        Ok(resolved) => Ok(Resolved {
            warnings: resolved.warnings.iter().map(|text| words::of_stage(text, mesh)).collect(),
            ..resolved
        }),
        Err(SceneError { problems, .. }) => {
            Err(problems.into_iter().map(|problem| words::told_of_stage(problem, mesh, &locator)).collect())
        }
    }
}

/// The stage of a file whose own keys are sound.
struct ChosenStage {
    /// The whole file, its ring with positive numbers.
    table: Table,
    file: StageFile,
    stage: PlanetaryStage,
    member: MemberFile,
    title: String,
}

impl ChosenStage {
    /// `None` where something is wrong, which is reported.
    fn of(table: &Table, findings: &mut Findings) -> Option<Self> {
        let table = with_positive_ring(table.clone(), findings);
        let file = typed(&table, findings)?;
        let (file, stage, member) = choose(file, findings).filter(|_| findings.problems.is_empty())?;
        let title = title(&table, &stage, &file);
        Some(Self { table, file, stage, member, title })
    }

    /// Scene of `mesh` as a pair.
    fn pair_scene(&self, mesh: StageMesh) -> Table {
        pair_scene::of_mesh(&self.table, &self.file, &self.stage, self.member, mesh, &self.title)
    }
}

impl PlanetaryScene {
    /// The files that its meshes name, as they were read.
    pub fn input_files(&self) -> Vec<InputFile> {
        let mut files: Vec<InputFile> = Vec::new();
        for file in self.meshes.both().into_iter().flat_map(LoadedScene::input_files) {
            if !files.contains(&file) {
                files.push(file);
            }
        }
        files
    }

    /// The stage with all these keys of its file changed together, each to a value or to nothing; alternatives and whole numbers as of
    /// [`LoadedScene::with_all`].
    ///
    /// # Errors
    /// What is wrong with the stage then.
    pub fn with_all(&self, changes: impl IntoIterator<Item = (String, Option<Value>)>) -> Result<Self, LoadError> {
        let mut draft = Draft::parse(&self.given.text).map_err(|problems| self.given.refused(problems))?;
        draft.change_all(changes);
        let folder = &self.meshes.sun_planet.folder;
        let given = SceneText { name: self.given.name.clone(), text: draft.to_toml() };
        Self::from_parts(given, folder, &self.input_files())
    }

    /// Problems of the scene of `mesh`, as of the stage's file.
    pub fn told_of_stage(&self, mesh: StageMesh, problems: Vec<Problem>) -> SceneError {
        let locator = Locator::new(&self.given.text).unwrap_or_default();
        let told = problems.into_iter().map(|problem| words::told_of_stage(problem, mesh, &locator));
        SceneError { given: (*self.given).clone(), problems: told.collect() }
    }
}

/// The file with a ring whose numbers are positive.
fn with_positive_ring(mut table: Table, findings: &mut Findings) -> Table {
    let centre_distance = table::at(&table, "planetary.centre_distance_mm").cloned();
    let Some(ring @ Value::Table(_)) = table::at(&table, "planetary.ring").cloned() else { return table };
    let mut pair = Table::new();
    table::set(&mut pair, "pair.wheel", ring);
    let pair = internal::with_positive_numbers(pair, findings);
    if let Some(ring) = table::at(&pair, "pair.wheel") {
        table::set(&mut table, "planetary.ring", ring.clone());
    }
    if let Some(length) = centre_distance {
        table::set(&mut table, "planetary.centre_distance_mm", length);
    }
    table
}

/// What the file says of the stage; the other tables are checked with the meshes.
fn typed(table: &Table, findings: &mut Findings) -> Option<StageFile> {
    let of_stage = ["planetary", "operation", "pair"].into_iter();
    let of_stage: Table = of_stage.filter_map(|name| Some((name.to_owned(), table.get(name)?.clone()))).collect();
    let format = FileShape { root: Node::root(schema::stage()), of_other_files: OF_OTHER_FILES };
    let sound = shape::check(format, &of_stage, findings);
    for mesh in StageMesh::BOTH {
        check_own_tables(mesh, table, findings);
    }
    if !findings.problems.is_empty() {
        return None;
    }
    text::typed(sound, findings)
}

/// Reports what cannot hold for one mesh alone: pair and operation are those of the stage.
fn check_own_tables(mesh: StageMesh, table: &Table, findings: &mut Findings) {
    let Some(Value::Table(own)) = table.get(mesh.table()) else { return };
    for name in own.keys().filter(|name| matches!(name.as_str(), "pair" | "operation" | "title" | "report")) {
        let key = format!("{}.{name}", mesh.table());
        findings.problem(
            ProblemKind::UnknownKey,
            &key,
            name,
            format!("{}, contact, wear and the other tables", mesh.gears().join(", ")),
        );
    }
}

/// Stage and given member, of a file whose values are in their ranges.
fn choose(file: StageFile, findings: &mut Findings) -> Option<(StageFile, PlanetaryStage, MemberFile)> {
    let planetary = &file.planetary;
    let held = planetary.held.unwrap_or(MemberFile::Ring);
    let by_default = if held == MemberFile::Sun { MemberFile::Carrier } else { MemberFile::Sun };
    let member = file.operation.member.unwrap_or(by_default);
    if member == held {
        let name = Member::from(held).name();
        findings.not_allowed("operation.member", format!("{name:?}, which is held"), "a member that turns");
    }
    let planets = planetary.planets as usize;
    if let Some(factor) = planetary.load_sharing_factor.filter(|&factor| factor > planets as f64) {
        let allowed = format!("a number from 1 to {planets}, the number of planets");
        findings.not_allowed("planetary.load_sharing_factor", number(factor), allowed);
    }
    let teeth = [("sun", &planetary.sun), ("planet", &planetary.planet), ("ring", &planetary.ring)];
    let [sun_teeth, planet_teeth, ring_teeth] = teeth.map(|(name, gear)| {
        let key = format!("planetary.{name}.teeth");
        if gear.teeth.is_none() {
            findings.missing(&[&key], "a whole number at least 5");
        }
        gear.teeth
    });
    let planet_angles_rad = match &planetary.planet_angles_deg {
        None => PlanetaryStage::equal_angles_rad(planets),
        Some(angles) => angles_of(angles, planets, findings)?,
    };
    let stage = PlanetaryStage {
        sun_teeth: sun_teeth?,
        planet_teeth: planet_teeth?,
        ring_teeth: ring_teeth?,
        planet_angles_rad,
        held: held.into(),
    };
    if let Err(error) = stage.check_assembly() {
        refuse_assembly(error, &stage, planetary.planet_angles_deg.is_some(), findings);
    }
    Some((file, stage, member))
}

/// Given angles in rad: as many as planets, rising from 0.
fn angles_of(angles_deg: &[f64], planets: usize, findings: &mut Findings) -> Option<Vec<f64>> {
    let rises = angles_deg.windows(2).all(|pair| pair[0] < pair[1]);
    if angles_deg.len() == planets && angles_deg.first() == Some(&0.0) && rises {
        return Some(angles_deg.iter().map(|angle| angle.to_radians()).collect());
    }
    let given: Vec<String> = angles_deg.iter().map(|&angle| number(angle)).collect();
    let allowed = format!("{planets} angles, one for each planet, rising from 0");
    findings.not_allowed("planetary.planet_angles_deg", format!("[{}]", given.join(", ")), allowed);
    None
}

/// Reports planets that cannot be put in, with what can be.
fn refuse_assembly(error: AssemblyError, stage: &PlanetaryStage, has_angles: bool, findings: &mut Findings) {
    let teeth = stage.sun_teeth + stage.ring_teeth;
    let key = if has_angles { "planetary.planet_angles_deg" } else { "planetary.planets" };
    let allowed = match has_angles {
        true => format!("multiples of 360°/{teeth}"),
        false => format!("a number of planets that divides {teeth}, the teeth of sun and ring together"),
    };
    findings.not_allowed(key, format!("planets that cannot be assembled ({error})"), allowed);
    if !has_angles {
        findings.help("or planet_angles_deg, multiples of 360° over the teeth of sun and ring together");
    }
}

/// Reports neighbouring planets that touch.
fn touching_planets(error: AssemblyError, findings: &mut Findings) {
    let allowed = "fewer planets, or planets with a smaller tip diameter";
    findings.not_allowed("planetary.planets", format!("planets that touch ({error})"), allowed);
}

/// Title as given, or of the numbers of teeth.
fn title(table: &Table, stage: &PlanetaryStage, file: &StageFile) -> String {
    if let Some(title) = table.get("title").and_then(Value::as_str) {
        return title.to_owned();
    }
    let PlanetaryStage { sun_teeth, planet_teeth, ring_teeth, .. } = stage;
    let module = match (file.planetary.normal_module_mm, file.planetary.transverse_module_mm) {
        (Some(module), _) => format!(", module {module} mm"),
        (None, Some(module)) => format!(", transverse module {module} mm"),
        (None, None) => String::new(),
    };
    let planets = stage.planets();
    let noun = if planets == 1 { "planet" } else { "planets" };
    format!("Planetary stage {sun_teeth}/{planet_teeth}/{ring_teeth}, {planets} {noun}{module}")
}

/// The scene of each mesh: the same file, which names the mesh.
///
/// # Errors
/// Everything that is wrong with either, in the words of the stage.
fn mesh_scenes(
    chosen: &ChosenStage,
    (given, folder, files): (&SceneText, &Path, &[InputFile]),
    locator: &Locator,
) -> Result<PerMesh<LoadedScene>, LoadError> {
    let mut problems: Vec<Problem> = Vec::new();
    let loaded = PerMesh::try_from_fn(|mesh| {
        let mut of_mesh = chosen.table.clone();
        table::set(&mut of_mesh, "planetary.mesh", mesh.folder());
        let name = format!("{} of {}", mesh.in_words(), given.name);
        match LoadedScene::from_parts(SceneText { name, text: of_mesh.to_string() }, folder, files.to_vec()) {
            Ok(loaded) => Ok(Some(loaded)),
            Err(LoadError::Scene(SceneError { problems: of_mesh, .. })) => {
                for problem in of_mesh {
                    let problem = words::told_of_stage(problem, mesh, locator);
                    if !problems.iter().any(|other| other.key == problem.key) {
                        problems.push(problem);
                    }
                }
                Ok(None)
            }
            Err(other) => Err(other),
        }
    })?;
    match (loaded.sun_planet, loaded.planet_ring) {
        (Some(sun_planet), Some(planet_ring)) => Ok(PerMesh { sun_planet, planet_ring }),
        _ => Err(SceneError { given: given.clone(), problems }.into()),
    }
}
