//! Random scenes over the whole schema, each from a seed and its number alone.
//!
//! Ranges are those of gears that are made: modules of 1 to 8 mm, 10 to 45 teeth of the smaller gear, line loads per E* and module of
//! 5e-5 to 1.5e-3 (steel, at most 1800 MPa or so) and up to 2e-2 (plastics), wear of 1e-5 to 2e-3 modules. A scene that cannot be is refused with a
//! message. Resolutions are coarse, so that a scene takes hundredths of a second.

use std::f64::consts::PI;

use toml::{Table, Value};

use gearwear::scene::presets;
use gearwear::scene::table::set;

/// Presets whose pair is written out in their text.
const PAIRS: [&str; 6] = ["fzg-c", "fzg-a", "helical", "h501", "h701", "h951"];
const STEEL_GPA: f64 = 206.0;

/// One scene of so many has an internal wheel.
const EVERY_INTERNAL: u64 = 12;
/// One scene of so many has tip chamfers.
const EVERY_CHAMFERED: u64 = 6;

/// Random choices of one scene.
struct Draw {
    random: fastrand::Rng,
    table: Table,
}

/// Sizes that loads and wear are chosen by.
struct Sizes {
    module_mm: f64,
    teeth: [f64; 2],
    helix_rad: f64,
    face_width_mm: f64,
    /// E*, MPa.
    modulus_mpa: f64,
    is_plastic: bool,
    /// Whether the wheel has internal teeth, of which there are no temperatures.
    is_internal: bool,
}

/// Tables of wear laws, of both gears most often.
const WEAR_TABLES: [&str; 4] = ["wear", "wear", "wear.pinion", "wear.wheel"];

/// E/(1 − ν²), MPa.
fn plane_modulus_mpa(modulus_gpa: f64, poisson: f64) -> f64 {
    1e3 * modulus_gpa / (1.0 - poisson * poisson)
}

/// Target of load and wear.
struct Aim {
    line_load_n_per_mm: f64,
    torque_nm: f64,
    hertz_mpa: f64,
    revolutions: f64,
    depth_mm: f64,
    /// Coefficient that gives the depth, m²/N.
    coefficient: f64,
}

/// The scene of this number.
pub fn scene(seed: u64, index: u64) -> Table {
    // Neighbouring numbers give unrelated seeds (the finaliser of SplitMix64).
    let mut mixed = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(index.wrapping_mul(0xbf58_476d_1ce4_e5b9));
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    let mut draw = Draw { random: fastrand::Rng::with_seed(mixed ^ (mixed >> 31)), table: Table::new() };
    draw.set("title", format!("random scene {index} of seed {seed}"));
    let mut sizes = if index.is_multiple_of(EVERY_INTERNAL) { draw.internal_pair() } else { draw.pair() };
    draw.modifications(&sizes);
    draw.material(&mut sizes);
    let aim = draw.aim(&sizes);
    draw.operation(&aim);
    draw.contact(&sizes, &aim);
    let has_oil = draw.lubricant(&sizes);
    let has_tooth_temperature = draw.temperature(&sizes, has_oil);
    draw.wear(&aim, has_oil, has_tooth_temperature);
    draw.numerics(&aim);
    if index % EVERY_CHAMFERED == 1 {
        draw.chamfers(sizes.module_mm);
    }
    draw.table
}

impl Draw {
    fn set(&mut self, key: &str, value: impl Into<Value>) {
        set(&mut self.table, key, value);
    }

    fn chance(&mut self, part: f64) -> bool {
        self.random.f64() < part
    }

    fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.random.usize(..of.len())]
    }

    /// Evenly between two numbers, with four digits.
    fn between(&mut self, from: f64, to: f64) -> f64 {
        four_digits(from + (to - from) * self.random.f64())
    }

    fn chamfers(&mut self, module_mm: f64) {
        for gear in ["pinion", "wheel"] {
            if self.chance(0.7) {
                let height = four_digits(module_mm * self.between(0.02, 0.12));
                self.set(&format!("pair.{gear}.tip_chamfer_mm"), height);
                let angle = self.random.i64(45..=65);
                self.set(&format!("pair.{gear}.tip_chamfer_deg"), angle);
            }
        }
    }

    /// Number evenly distributed in the logarithm.
    fn logarithmic(&mut self, from: f64, to: f64) -> f64 {
        four_digits((from.ln() + (to / from).ln() * self.random.f64()).exp())
    }

    fn pair(&mut self) -> Sizes {
        if self.chance(0.2) {
            let name = self.pick(&PAIRS);
            if let Some(sizes) = self.pair_of(name) {
                return sizes;
            }
        }
        let module_mm = self.logarithmic(1.0, 8.0);
        let smaller = self.random.i64(10..=45);
        let greater = ((smaller as f64) * self.between(1.0, 4.0)) as i64;
        let teeth = if self.chance(0.1) { [greater, smaller] } else { [smaller, greater] };
        let is_helical = self.chance(0.3);
        let helix_deg = if is_helical { self.pick(&[-1.0, 1.0]) * self.between(4.0, 35.0) } else { 0.0 };
        let pressure_angle_deg = if self.chance(0.65) { 20.0 } else { self.between(16.0, 25.0) };
        let face_width_mm = four_digits(module_mm * self.between(4.0, 10.0));
        self.set("pair.normal_module_mm", module_mm);
        self.set("pair.pressure_angle_deg", pressure_angle_deg);
        if is_helical {
            self.set("pair.helix_angle_deg", helix_deg);
        }
        let backlash_um = four_digits(module_mm * self.between(10.0, 60.0));
        self.set("pair.backlash_um", backlash_um);
        self.set("pair.face_width_mm", face_width_mm);
        if self.chance(0.15) {
            let addendum = self.between(0.8, 1.25);
            self.set("pair.basic_rack.addendum_factor", addendum);
            self.set("pair.basic_rack.dedendum_factor", four_digits(addendum + 0.25));
            let fillet = self.between(0.1, 0.3);
            self.set("pair.basic_rack.fillet_radius_factor", fillet);
        }
        for (gear, teeth) in ["pinion", "wheel"].into_iter().zip(teeth) {
            self.set(&format!("pair.{gear}.teeth"), teeth);
            let shift = if self.chance(0.2) { 0.0 } else { self.between(-0.2, 0.5) };
            self.set(&format!("pair.{gear}.profile_shift"), shift);
            if self.chance(0.2) {
                let allowance = four_digits(-module_mm * self.between(5.0, 60.0));
                self.set(&format!("pair.{gear}.tooth_thickness_allowance_um"), allowance);
            }
        }
        let teeth = teeth.map(|teeth| teeth as f64);
        let helix_rad = helix_deg.to_radians();
        Sizes { module_mm, teeth, helix_rad, face_width_mm, modulus_mpa: 0.0, is_plastic: false, is_internal: false }
    }

    /// A pair with an internal wheel, whose tips are short enough for most pinions.
    fn internal_pair(&mut self) -> Sizes {
        let module_mm = self.logarithmic(1.0, 8.0);
        let pinion = self.random.i64(14..=40);
        let wheel = ((pinion as f64) * self.between(1.8, 4.0)) as i64;
        let face_width_mm = four_digits(module_mm * self.between(4.0, 10.0));
        let pressure_angle_deg = if self.chance(0.65) { 20.0 } else { self.between(18.0, 25.0) };
        self.set("pair.normal_module_mm", module_mm);
        self.set("pair.pressure_angle_deg", pressure_angle_deg);
        self.set("pair.face_width_mm", face_width_mm);
        let backlash_um = four_digits(module_mm * self.between(10.0, 60.0));
        self.set("pair.backlash_um", backlash_um);
        let shift = self.between(0.1, 0.5);
        self.set("pair.pinion.teeth", pinion);
        self.set("pair.pinion.profile_shift", shift);
        let of_wheel = four_digits(-shift - self.between(0.0, 0.2));
        self.set("pair.wheel.profile_shift", of_wheel);
        let helix_deg = if self.chance(0.2) { self.between(-20.0, 20.0) } else { 0.0 };
        self.set("pair.helix_angle_deg", helix_deg);
        let reference_mm = module_mm * wheel as f64 / helix_deg.to_radians().cos();
        let tip_mm = four_digits(reference_mm - 2.0 * module_mm * (self.between(0.6, 0.8) + of_wheel));
        if self.chance(0.5) {
            self.set("pair.wheel.teeth", wheel);
            self.set("pair.wheel.internal", true);
            self.set("pair.wheel.tip_diameter_mm", tip_mm);
        } else {
            self.set("pair.wheel.teeth", -wheel);
            self.set("pair.wheel.tip_diameter_mm", -tip_mm);
        }
        if self.chance(0.5) {
            let teeth = self.random.i64(12..=pinion.max(13));
            self.set("pair.wheel.cutter.teeth", teeth);
        }
        let teeth = [pinion, wheel].map(|teeth| teeth as f64);
        let (helix_rad, modulus_mpa, is_plastic) = (helix_deg.to_radians(), 0.0, false);
        Sizes { module_mm, teeth, helix_rad, face_width_mm, modulus_mpa, is_plastic, is_internal: true }
    }

    /// The pair of a preset, if its text writes it out.
    fn pair_of(&mut self, preset: &str) -> Option<Sizes> {
        let text: Table = presets::find(preset)?.text.parse().ok()?;
        let pair = text.get("pair")?.as_table()?;
        let number = |key: &str| pair.get(key).and_then(Value::as_float);
        let teeth = |gear: &str| Some(pair.get(gear)?.get("teeth")?.as_integer()? as f64);
        let sizes = Sizes {
            module_mm: number("normal_module_mm").or(number("transverse_module_mm"))?,
            teeth: [teeth("pinion")?, teeth("wheel")?],
            helix_rad: number("helix_angle_deg").unwrap_or(0.0).to_radians(),
            face_width_mm: number("face_width_mm")?,
            modulus_mpa: 0.0,
            is_plastic: false,
            is_internal: false,
        };
        self.table.insert("pair".to_owned(), Value::Table(pair.clone()));
        Some(sizes)
    }

    fn modifications(&mut self, sizes: &Sizes) {
        let m = sizes.module_mm;
        for gear in ["pinion", "wheel"] {
            let of = |key: &str| format!("pair.{gear}.{key}");
            for (relief, chance) in [("tip_relief", 0.3), ("root_relief", 0.1)] {
                if self.chance(chance) {
                    let (amount, length) = (m * self.between(0.5, 8.0), m * self.between(0.2, 0.8));
                    self.set(&of(&format!("{relief}.amount_um")), four_digits(amount));
                    self.set(&of(&format!("{relief}.length_mm")), four_digits(length));
                    let shape = self.pick(&["linear", "parabolic"]);
                    self.set(&of(&format!("{relief}.shape")), shape);
                }
            }
            if self.chance(0.15) {
                let height = four_digits(m * self.between(0.2, 4.0));
                self.set(&of("profile_crowning_um"), height);
            }
            if self.chance(0.6) {
                let rounding = four_digits(m * self.between(0.01, 0.06));
                self.set(&of("tip_rounding_mm"), rounding);
            }
        }
        // Modifications over the face width, which need slices.
        if !self.chance(if sizes.helix_rad == 0.0 { 0.08 } else { 0.4 }) {
            return;
        }
        let gear = self.pick(&["pinion", "wheel"]);
        let of = |key: &str| format!("pair.{gear}.{key}");
        match self.random.u8(0..5) {
            0 => {
                let height = four_digits(m * self.between(0.5, 4.0));
                self.set(&of("lead_crowning_um"), height);
            }
            1 => {
                let slope = four_digits(m * self.between(-4.0, 4.0));
                self.set(&of("helix_slope_deviation_um"), slope);
            }
            2 => {
                let amount = four_digits(m * self.between(0.5, 4.0));
                self.set(&of("end_relief.amount_um"), amount);
                let length = four_digits(sizes.face_width_mm * self.between(0.1, 0.3));
                self.set(&of("end_relief.length_mm"), length);
            }
            3 => {
                let (teeth, face) = (sizes.teeth[usize::from(gear == "wheel")], self.pick(&["start", "end"]));
                self.set(&of("shaft.diameter_mm"), four_digits(0.8 * m * teeth));
                self.set(&of("shaft.driven_at"), face);
            }
            _ => {
                let (in_plane, out_of_plane) = (m * self.between(-3.0, 3.0), m * self.between(-3.0, 3.0));
                self.set("pair.axis_parallelism.in_plane_um", four_digits(in_plane));
                self.set("pair.axis_parallelism.out_of_plane_um", four_digits(out_of_plane));
            }
        }
    }

    fn material(&mut self, sizes: &mut Sizes) {
        let mut of_gear = [plane_modulus_mpa(STEEL_GPA, 0.3); 2];
        match self.random.u8(0..10) {
            0..=3 => {}
            4 | 5 => {
                let (modulus, poisson) = (self.logarithmic(70.0, 220.0), self.between(0.2, 0.35));
                self.set("material.young_modulus_GPa", modulus);
                self.set("material.poisson_ratio", poisson);
                of_gear = [plane_modulus_mpa(modulus, poisson); 2];
            }
            6 => {
                for (gear, of_gear) in ["pinion", "wheel"].into_iter().zip(&mut of_gear) {
                    let (modulus, poisson) = (self.logarithmic(70.0, 220.0), self.between(0.2, 0.35));
                    self.set(&format!("material.{gear}.young_modulus_GPa"), modulus);
                    self.set(&format!("material.{gear}.poisson_ratio"), poisson);
                    *of_gear = plane_modulus_mpa(modulus, poisson);
                }
            }
            _ => {
                sizes.is_plastic = true;
                let both = self.chance(0.3);
                for (gear, of_gear) in
                    ["wheel", "pinion"].into_iter().zip(of_gear.iter_mut().rev()).take(1 + usize::from(both))
                {
                    let (modulus, poisson) = (self.logarithmic(1.0, 10.0), self.between(0.3, 0.42));
                    let name = self.pick(&["POM", "PA66", "PA46", "PBT", "PEEK"]);
                    self.set(&format!("material.{gear}.preset"), name);
                    self.set(&format!("material.{gear}.young_modulus_GPa"), modulus);
                    self.set(&format!("material.{gear}.poisson_ratio"), poisson);
                    *of_gear = plane_modulus_mpa(modulus, poisson);
                }
            }
        }
        sizes.modulus_mpa = 1.0 / (1.0 / of_gear[0] + 1.0 / of_gear[1]);
    }

    fn aim(&mut self, sizes: &Sizes) -> Aim {
        let part = if sizes.is_plastic { self.logarithmic(1e-3, 2e-2) } else { self.logarithmic(5e-5, 1.5e-3) };
        let line_load_n_per_mm = part * sizes.modulus_mpa * sizes.module_mm;
        let [z1, z2] = sizes.teeth;
        let (radius_mm, angle) = (0.5 * sizes.module_mm * z1 / sizes.helix_rad.cos(), 20f64.to_radians());
        let torque_nm = four_digits(1e-3 * line_load_n_per_mm * sizes.face_width_mm * radius_mm * angle.cos());
        let relative_radius_mm = radius_mm * angle.sin() * z2 / (z1 + z2);
        let revolutions = self.logarithmic(1e4, 1e7);
        let depth_mm = sizes.module_mm * self.logarithmic(1e-5, 2e-3);
        Aim {
            line_load_n_per_mm,
            torque_nm,
            hertz_mpa: (line_load_n_per_mm * sizes.modulus_mpa / (PI * relative_radius_mm)).sqrt(),
            revolutions,
            depth_mm,
            // A flank slides over its mate by about a third of the contact's width.
            coefficient: four_digits(1e-6 * depth_mm / (0.3 * line_load_n_per_mm * revolutions)),
        }
    }

    fn operation(&mut self, aim: &Aim) {
        let speed = self.logarithmic(50.0, 3000.0);
        self.set("operation.pinion_speed_rpm", speed);
        if !self.chance(0.2) {
            self.set("operation.pinion_torque_Nm", aim.torque_nm);
            self.set("operation.pinion_revolutions", aim.revolutions);
            return;
        }
        // Each phase is a whole number of steps.
        let count = self.random.usize(2..=3);
        let mut phases = Vec::new();
        for _ in 0..count {
            let mut phase = Table::new();
            phase.insert("pinion_revolutions".to_owned(), Value::Float(aim.revolutions / count as f64));
            let torque = four_digits(aim.torque_nm * if self.chance(0.3) { 1.0 } else { self.between(0.3, 1.0) });
            phase.insert("pinion_torque_Nm".to_owned(), Value::Float(torque));
            if self.chance(0.5) {
                phase.insert("pinion_speed_rpm".to_owned(), Value::Float(four_digits(speed * self.between(0.5, 2.0))));
            }
            phases.push(Value::Table(phase));
        }
        self.set("operation.phases", Value::Array(phases));
    }

    fn contact(&mut self, sizes: &Sizes, aim: &Aim) {
        let is_sliced = sizes.helix_rad != 0.0;
        let drawn = self.random.u16(0..1000);
        let surface = match drawn {
            0..=3 if !is_sliced => "fem",
            // Half-planes cost ten times what the others do.
            _ if drawn < if is_sliced { 600 } else { 500 } => "winkler",
            _ if drawn < 700 => "half-space",
            700..=874 => "hertz",
            _ => "hertz-mean",
        };
        self.set("contact.surface", surface);
        if matches!(surface, "winkler" | "half-space") && self.chance(0.15) {
            self.set("contact.tip_contact", false);
        }
        if surface == "winkler" {
            match self.random.u8(0..8) {
                0 => self.set("contact.match", "peak-pressure"),
                1 => self.set("contact.match", "approach"),
                2 => {
                    let half_width_mm = 2.0 * aim.line_load_n_per_mm / (PI * aim.hertz_mpa);
                    let foundation = 1.178 * sizes.modulus_mpa / half_width_mm * self.between(0.7, 1.5);
                    self.set("contact.foundation_MPa_per_mm", four_digits(foundation));
                }
                _ => {}
            }
        }
        if surface != "fem" {
            let model = match self.random.u16(0..1000) {
                0..=3 => "fem",
                4..=249 => "constant",
                250..=399 => "iso6336",
                _ => "weber-banaschek",
            };
            self.set("stiffness.model", model);
            if model == "constant" {
                let stiffness = sizes.modulus_mpa / 113e3 * self.between(10.0, 30.0);
                self.set("stiffness.pair_N_per_mm_um", four_digits(stiffness));
            }
        }
        let slices = self.random.i64(2..=4);
        self.set("helical.slices", slices);
        let coupling = self.pick(&["none", "slicing"]);
        self.set("helical.coupling", coupling);
    }

    fn lubricant(&mut self, sizes: &Sizes) -> bool {
        let has_oil = self.chance(0.25);
        if has_oil {
            let class = self.pick(&[32i64, 68, 100, 220, 460]);
            self.set("lubricant.viscosity_class", class);
            let temperature = self.between(40.0, 100.0);
            self.set("lubricant.temperature_C", temperature);
            let base = self.pick(&["mineral", "polyalphaolefin", "polyglycol"]);
            self.set("lubricant.base", base);
            let supply = self.pick(&["dip", "injection", "submerged"]);
            self.set("lubricant.supply", supply);
            let film = self.pick(&["hamrock", "grubin"]);
            self.set("lubricant.central_film", film);
            if self.chance(0.3) || sizes.is_internal {
                let bulk = four_digits(temperature + self.between(0.0, 30.0));
                self.set("lubricant.bulk_temperature_C", bulk);
            }
            for gear in ["pinion", "wheel"] {
                let roughness = self.logarithmic(0.1, 1.0);
                self.set(&format!("pair.{gear}.roughness_Ra_um"), roughness);
                if self.chance(0.5) {
                    self.set(&format!("pair.{gear}.roughness_run_in_Ra_um"), four_digits(0.6 * roughness));
                }
            }
        }
        if self.chance(if has_oil { 0.5 } else { 0.05 }) {
            let models = ["constant", "schlenk", "iso-6336-22", "iso-6336-21", "iso-6336-20", "benedict-kelley", "xu"];
            let model = if has_oil { self.pick(&models) } else { "constant" };
            self.set("friction.model", model);
            if model == "constant" {
                let friction = if sizes.is_plastic { self.between(0.04, 0.2) } else { self.between(0.02, 0.12) };
                self.set("friction.coefficient", friction);
            }
        }
        if has_oil && self.chance(0.3) {
            for factor in ["application", "dynamic", "transverse", "face"] {
                let value = self.between(1.0, 1.5);
                self.set(&format!("load_factors.{factor}"), value);
            }
        }
        has_oil
    }

    fn temperature(&mut self, sizes: &Sizes, has_oil: bool) -> bool {
        let has_tooth = sizes.is_plastic && !sizes.is_internal && self.chance(0.4);
        if !has_tooth && !self.chance(0.12) {
            return false;
        }
        let method = self.pick(&["tian-kennedy", "tian-kennedy", "williams", "heat-equation"]);
        self.set("temperature.method", method);
        let (velocity, partition) = (self.pick(&["sliding", "surface"]), self.pick(&["archard-rowntree", "equal"]));
        self.set("temperature.velocity", velocity);
        self.set("temperature.partition", partition);
        if !has_oil && !self.table.contains_key("friction") {
            let friction = self.between(0.03, 0.2);
            self.set("temperature.friction_coefficient", friction);
        }
        if has_tooth {
            let ambient = self.between(15.0, 50.0);
            self.set("temperature.tooth.ambient_temperature_C", ambient);
            let lubrication = self.pick(&["dry", "oil"]);
            self.set("temperature.tooth.lubrication", lubrication);
        } else if self.chance(0.5) {
            let bulk = self.between(40.0, 120.0);
            self.set("temperature.bulk_temperature_C", bulk);
        }
        has_tooth
    }

    fn wear(&mut self, aim: &Aim, has_oil: bool, has_tooth_temperature: bool) {
        let (law, coefficient) = match self.random.u8(0..20) {
            0 | 1 => ("adsorption", four_digits(1e3 * aim.coefficient)),
            2 | 3 => ("oxidation", self.logarithmic(3e-11, 3e-10)),
            _ => ("archard", aim.coefficient),
        };
        self.set("wear.law", law);
        if self.chance(0.1) {
            // 1e-8 mm³/(N·m) is 1e-17 m²/N.
            self.set("wear.coefficient_mm3_per_Nm", 1e9 * coefficient);
        } else {
            self.set("wear.coefficient_m2_per_N", coefficient);
        }
        if self.chance(0.15) {
            let gear = self.pick(&["pinion", "wheel"]);
            let own = if self.chance(0.3) { 0.0 } else { four_digits(coefficient * self.between(0.2, 3.0)) };
            self.set(&format!("wear.{gear}.coefficient_m2_per_N"), own);
        }
        if self.chance(0.15) {
            let whose = self.pick(&WEAR_TABLES);
            let above = four_digits(aim.hertz_mpa * self.between(0.7, 1.3));
            self.set(&format!("{whose}.severe.above_MPa"), above);
            let factor = self.logarithmic(2.0, 100.0);
            self.set(&format!("{whose}.severe.factor"), factor);
            let band = if self.chance(0.7) { four_digits(above * self.between(0.03, 0.2)) } else { 0.0 };
            self.set(&format!("{whose}.severe.band_MPa"), band);
        }
        if has_oil && self.chance(0.4) {
            let whose = self.pick(&WEAR_TABLES);
            let ratio = self.pick(&["composite", "iso-6336-22"]);
            self.set(&format!("{whose}.film.ratio"), ratio);
            if self.chance(0.5) {
                self.set(&format!("{whose}.film.law"), "priest-taylor");
            } else {
                self.set(&format!("{whose}.film.lambda"), numbers([0.3, 1.0, 3.0]));
                self.set(&format!("{whose}.film.factor"), numbers([1.5, 1.0, 0.1]));
            }
        }
        if has_tooth_temperature && self.chance(0.4) {
            // The wheel is of plastic in all of them.
            let whose = self.pick(&["wear", "wear.wheel"]);
            self.set(&format!("{whose}.warm.temperature_C"), numbers([20.0, 60.0, 120.0]));
            self.set(&format!("{whose}.warm.factor"), numbers([0.7, 1.0, 2.5]));
        }
    }

    fn numerics(&mut self, aim: &Aim) {
        let contact = self.table.get("contact").and_then(|contact| contact.get("surface")).and_then(Value::as_str);
        let has_half_planes = contact == Some("half-space");
        let points = self.random.i64(50..=90);
        self.set("numerics.flank_points", points);
        let positions =
            if has_half_planes { self.pick(&[20i64, 24, 30]) } else { self.pick(&[24i64, 40, 60, 60, 160]) };
        self.set("numerics.positions", positions);
        self.set("numerics.error_estimate", false);
        self.set("numerics.verify", false);
        if self.chance(0.3) {
            self.set("numerics.step", "adaptive");
            self.set("numerics.tolerance_um", four_digits((50.0 * aim.depth_mm).max(1e-3)));
        } else {
            let has_phases = self.table.get("operation").is_some_and(|operation| operation.get("phases").is_some());
            self.set("numerics.step.revolutions", aim.revolutions / if has_phases { 12.0 } else { 4.0 });
        }
        self.set("operation.snapshots_revolutions", numbers([aim.revolutions / 2.0, aim.revolutions]));
    }
}

fn numbers<const N: usize>(of: [f64; N]) -> Value {
    Value::Array(of.map(Value::Float).into())
}

/// The number with four digits, as a user would write it.
fn four_digits(number: f64) -> f64 {
    format!("{number:.3e}").parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_follows_from_seed_and_number_alone() {
        assert_eq!(scene(3, 17), scene(3, 17));
        assert_ne!(scene(3, 17), scene(3, 18));
        assert_ne!(scene(3, 17), scene(4, 17));
    }
}
