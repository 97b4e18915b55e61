//! The bodies that finite elements are made of.

use crate::scene::fem_file::{BodyKind, FemFile, WebFile, WebsFile};
use crate::scene::findings::Findings;
use crate::scene::gear_file::{GearFile, RimPinsFile};
use crate::scene::problem::number;
use gearwear_bodies::gear::{Gear, PerGear, spec::PairSpec};
use gearwear_bodies::gear_mesh::settings::{
    Body, BodySettings, DefaultClamp, NO_WEBS, RimPins, Web, default_clamp, default_ring_rim_mm, greatest_clamp_mm,
    least_ring_rim_mm, least_web_mm, rim_thickness_limits_mm,
};

const ELEMENTS_PER_HALF_WIDTH: f64 = 10.0;
/// Elements in a wear run: 3 and 8 give the same maximum wear within half a per cent (docs/accuracy.md).
const WEAR_ELEMENTS_PER_HALF_WIDTH: f64 = 3.0;
/// The same of a pair with an internal wheel, whose contact is wide beside what tip edges and reliefs change in it.
const INTERNAL_WEAR_ELEMENTS_PER_HALF_WIDTH: f64 = 4.0;
/// Elements with severe wear, which depends on where the pressure passes a limit: 3 and 8 differ by 3 %, 5 and 8 by 1 to 2 %.
const SEVERE_WEAR_ELEMENTS_PER_HALF_WIDTH: f64 = 5.0;
/// Number of elements in a half-width below which the pressure has an error of several per cent.
const FEW_ELEMENTS: f64 = 8.0;
const SECTOR_TEETH: u32 = 3;

/// Chooses what `[fem]` and the rim of an internal `wheel` leave open; a file without the table stays without it, and the bodies are the default ones.
pub(super) fn choose(
    file: &mut Option<FemFile>,
    wheel: Option<&mut GearFile>,
    pair: &PairSpec,
    findings: &mut Findings,
) -> Option<BodySettings> {
    let mut wheel = wheel.filter(|_| pair.is_internal());
    let outside_mm = wheel.as_deref_mut().map(|wheel| outside_radius(wheel, pair, findings));
    let pins = wheel.and_then(|wheel| wheel.rim_pins.as_mut()).map(|file| rim_pins(file, pair, findings));
    let bodies = match file {
        Some(file) => given(file, outside_mm, pair, findings),
        None => given(&mut FemFile::default(), outside_mm, pair, &mut Findings::default()),
    };
    let bodies = BodySettings { rim_pins: pins.unwrap_or(Some(None))?, ..bodies? };
    if bodies.rim_pins.is_some() && bodies.body != Body::Ring {
        findings.not_allowed("fem.body", "\"sector\" with pair.wheel.rim_pins", "\"ring\": pins hold a whole ring");
    }
    Some(bodies)
}

/// Checks the pins of an internal wheel.
fn rim_pins(file: &mut RimPinsFile, pair: &PairSpec, findings: &mut Findings) -> Option<Option<RimPins>> {
    const KEY: &str = "pair.wheel.rim_pins";
    let (count, most) = (file.count, pair.gears.wheel.teeth / 2);
    if !(RimPins::LEAST..=most).contains(&count) {
        let allowed = format!("{} to {most}, half the number of teeth", RimPins::LEAST);
        findings.not_allowed(&format!("{KEY}.count"), count.to_string(), allowed);
        return None;
    }
    if !pair.is_alike_over_width() {
        findings.not_allowed(KEY, "given for a pair whose sections differ over the face width", "left out");
        findings
            .help("pins hold the plane ring of spur pairs; teeth in space are held all round the outside of a ring");
        return None;
    }
    Some(Some(RimPins { count, tooth: *file.tooth.get_or_insert_default() }))
}

/// Chooses the outside radius of an internal wheel by the thickness of its rim; negative, `None` where it is refused.
fn outside_radius(wheel: &mut GearFile, pair: &PairSpec, findings: &mut Findings) -> Option<f64> {
    let root_mm = pair.root_radius_mm(Gear::Wheel);
    let rim_mm = *wheel.rim_thickness_mm.get_or_insert(default_ring_rim_mm(pair.transverse_module_mm()));
    let least_mm = least_ring_rim_mm(pair.normal_module_mm);
    if rim_mm < least_mm {
        let allowed = format!("at least {least_mm:.4} mm, a tenth of a module");
        findings.not_allowed("pair.wheel.rim_thickness_mm", number(rim_mm), allowed);
        return None;
    }
    Some(root_mm - rim_mm)
}

/// `outside_mm`: outside radius of an internal wheel.
fn given(
    file: &mut FemFile,
    outside_mm: Option<Option<f64>>,
    pair: &PairSpec,
    findings: &mut Findings,
) -> Option<BodySettings> {
    let body = body(file, pair, findings);
    let radii = file.clamp_radius_mm.get_or_insert_default();
    let pinion = clamp_radius(&mut radii.pinion, Gear::Pinion, pair, findings);
    let wheel = outside_mm.unwrap_or_else(|| clamp_radius(&mut radii.wheel, Gear::Wheel, pair, findings));
    let clamp_radius_mm = pinion.zip(wheel).map(|(pinion, wheel)| PerGear { pinion, wheel });
    let web = webs(file.web.as_mut(), pair, clamp_radius_mm, findings);
    // The default depends on the command and is not written into the file.
    let elements_per_half_width = file.elements_per_half_width.unwrap_or(ELEMENTS_PER_HALF_WIDTH);
    if elements_per_half_width < FEW_ELEMENTS {
        findings.warnings.push(format!(
            "fem.elements_per_half_width = {}: fewer than {FEW_ELEMENTS} elements in a half-width resolve the pressure poorly",
            number(elements_per_half_width)
        ));
    }
    Some(BodySettings {
        body: body?,
        clamp_radius_mm: clamp_radius_mm?,
        web: web?,
        rim_pins: None,
        elements_per_half_width,
        rounding_refinement: 1.0,
    })
}

fn webs(
    file: Option<&mut WebsFile>,
    pair: &PairSpec,
    clamp_radius_mm: Option<PerGear<f64>>,
    findings: &mut Findings,
) -> Option<PerGear<Option<Web>>> {
    let Some(WebsFile { pinion, wheel }) = file else { return Some(NO_WEBS) };
    let [pinion, wheel] = [(pinion, Gear::Pinion), (wheel, Gear::Wheel)].map(|(file, gear)| match file {
        Some(file) => web(file, gear, pair, clamp_radius_mm.map(|radius_mm| radius_mm[gear]), findings).map(Some),
        None => Some(None),
    });
    Some(PerGear { pinion: pinion?, wheel: wheel? })
}

fn web(
    file: &mut WebFile,
    gear: Gear,
    pair: &PairSpec,
    clamp_radius_mm: Option<f64>,
    findings: &mut Findings,
) -> Option<Web> {
    let table = format!("fem.web.{}", gear.name());
    let offset_mm = *file.offset_mm.get_or_insert(0.0);
    let web = Web { thickness_mm: file.thickness_mm, rim_thickness_mm: file.rim_thickness_mm, offset_mm };
    let (root_mm, width_mm) = (pair.root_radius_mm(gear), pair.face_width_mm);
    let [least_mm, greatest_mm] = rim_thickness_limits_mm(root_mm, clamp_radius_mm?, pair.normal_module_mm);
    if greatest_mm < least_mm {
        findings.not_allowed(
            &format!("fem.clamp_radius_mm.{}", gear.name()),
            number(clamp_radius_mm?),
            format!("a smaller radius: there is no room for a rim and a web below the root circle ({root_mm:.4} mm)"),
        );
        return None;
    }
    if !(least_mm..=greatest_mm).contains(&web.rim_thickness_mm) {
        let allowed = format!(
            "a thickness of {least_mm:.4} to {greatest_mm:.4} mm, between the root circle ({root_mm:.4} mm) and fem.clamp_radius_mm"
        );
        findings.not_allowed(&format!("{table}.rim_thickness_mm"), number(web.rim_thickness_mm), allowed);
        return None;
    }
    let least_mm = least_web_mm(pair.normal_module_mm);
    if !(least_mm..=width_mm).contains(&web.thickness_mm) {
        let allowed =
            format!("{least_mm:.4} to {} mm, from a tenth of a module to at most the face width", number(width_mm));
        findings.not_allowed(&format!("{table}.thickness_mm"), number(web.thickness_mm), allowed);
        return None;
    }
    let most_mm = 0.5 * (width_mm - web.thickness_mm);
    if offset_mm.abs() > most_mm {
        let allowed = format!("−{most_mm:.4} to {most_mm:.4}: within the face width");
        findings.not_allowed(&format!("{table}.offset_mm"), number(offset_mm), allowed);
        return None;
    }
    Some(web)
}

/// Elements in the half-width of contact of a wear run, with a severe transition or without.
pub(super) fn wear_elements_per_half_width(file: Option<&FemFile>, is_severe: bool, is_internal: bool) -> f64 {
    let default = match (is_severe, is_internal) {
        (true, _) => SEVERE_WEAR_ELEMENTS_PER_HALF_WIDTH,
        (false, true) => INTERNAL_WEAR_ELEMENTS_PER_HALF_WIDTH,
        (false, false) => WEAR_ELEMENTS_PER_HALF_WIDTH,
    };
    file.and_then(|file| file.elements_per_half_width).unwrap_or(default)
}

fn body(file: &mut FemFile, pair: &PairSpec, findings: &mut Findings) -> Option<Body> {
    match *file.body.get_or_insert_default() {
        BodyKind::Ring => {
            for (key, given) in
                [("fem.sector_teeth", file.sector_teeth.is_some()), ("fem.sector_sides", file.sector_sides.is_some())]
            {
                if given {
                    findings.unused(key, "only fem.body = \"sector\" has cut sides");
                }
            }
            Some(Body::Ring)
        }
        BodyKind::Sector => {
            let teeth = *file.sector_teeth.get_or_insert(SECTOR_TEETH);
            let sides = *file.sector_sides.get_or_insert_default();
            let most = Gear::BOTH.map(|gear| pair.gears[gear].teeth).into_iter().fold(u32::MAX, u32::min);
            if teeth.is_multiple_of(2) || teeth > most {
                let allowed = format!("an odd number of teeth, at most {most} (those of the smaller gear)");
                findings.not_allowed("fem.sector_teeth", teeth.to_string(), allowed);
                return None;
            }
            Some(Body::Sector { teeth, sides })
        }
    }
}

fn clamp_radius(given: &mut Option<f64>, gear: Gear, pair: &PairSpec, findings: &mut Findings) -> Option<f64> {
    let key = format!("fem.clamp_radius_mm.{}", gear.name());
    let root_mm = pair.root_radius_mm(gear);
    let bore_mm = pair.gears[gear].bore_diameter_mm.map_or(0.0, |diameter| 0.5 * diameter);
    let greatest_mm = greatest_clamp_mm(root_mm, pair.normal_module_mm);
    let Some(radius_mm) = *given else {
        let DefaultClamp { radius_mm, small_gear } = default_clamp(root_mm, pair.transverse_module_mm());
        // A body ends at its bore.
        let radius_mm = radius_mm.max(bore_mm).min(greatest_mm);
        if small_gear && bore_mm == 0.0 {
            findings.warnings.push(format!(
                "{key} = {radius_mm:.4}: the {} is too small for 2.5 modules of body below its root circle ({root_mm:.4} mm)",
                gear.name()
            ));
        }
        *given = Some(radius_mm);
        return Some(radius_mm);
    };
    // A gear without root circle is refused as such.
    if root_mm > 0.0 && (radius_mm > greatest_mm || radius_mm < bore_mm) {
        let least =
            if bore_mm > 0.0 { format!("at least {bore_mm:.4} (the bore)") } else { "greater than 0".to_owned() };
        let allowed =
            format!("a radius {least} and at most {greatest_mm:.4}, a tenth of a module below the root circle");
        findings.not_allowed(&key, number(radius_mm), allowed);
        return None;
    }
    Some(radius_mm)
}
