//! Quantiles of the wear over each flank, place by place.
//!
//! Places are points of the active profile of the scene as given; a sample's wear there lies even between the points of its own flank.

use super::record::{Band, Bands, FlankBand};
use crate::scene::opened::EachMesh;
use crate::varied_scene::StudiedRun;
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_bodies::reference::statistics::{SHARES, quantile};
use gearwear_physics::results::worn_pair::WearProfile;

/// Greatest number of places of a band.
const PLACES: usize = 160;

/// Radii of the places of each flank, mm.
pub(super) type Places = EachMesh<PerGear<Vec<f64>>>;

/// Places on the flanks of the scene as given.
pub(super) fn places_of(nominal: &StudiedRun) -> Places {
    nominal.pairs().map(|pair| PerGear::from_fn(|gear| places(&pair.flanks[gear])))
}

/// Wear of a run at the places.
pub(super) fn wear_at(places: &Places, found: &StudiedRun) -> Option<EachMesh<PerGear<Vec<f32>>>> {
    let pairs = found.pairs();
    EachMesh::for_each(places.kind(), |mesh| {
        let (flanks, places) = (&pairs.of(mesh)?.flanks, places.of(mesh)?);
        Some(PerGear::from_fn(|gear| at(&flanks[gear], &places[gear])))
    })
}

/// Wear over each flank.
pub(super) fn bands<'a>(
    places: &Places,
    nominal: &StudiedRun,
    ran: impl Iterator<Item = &'a EachMesh<PerGear<Vec<f32>>>>,
) -> Bands {
    let ran: Vec<&EachMesh<PerGear<Vec<f32>>>> = ran.collect();
    let pairs = nominal.pairs();
    let flanks = places.kind().meshes().into_iter().flat_map(|mesh| Gear::BOTH.map(|gear| (mesh, gear)));
    let bands = flanks.filter_map(|(mesh, gear)| {
        let wear: Vec<&[f32]> = ran.iter().filter_map(|wear| Some(wear.of(mesh)?[gear].as_slice())).collect();
        Some(FlankBand {
            flank: mesh.map_or(gear.name(), |mesh| mesh.flank(gear)),
            in_words: mesh.map_or(gear.name(), |mesh| mesh.flank_in_words(gear)),
            gear,
            band: band(&places.of(mesh)?[gear], &pairs.of(mesh)?.flanks[gear], &wear),
        })
    });
    Bands(bands.collect())
}

/// Wear at these radii, even between the points; 0 outside them.
fn at(profile: &WearProfile, radii: &[f64]) -> Vec<f32> {
    let (radius, wear) = (&profile.radius_mm, &profile.wear_um);
    let values = radii.iter().map(|&r| {
        let above = radius.partition_point(|&point| point < r);
        let value = match (above.checked_sub(1), radius.get(above)) {
            (Some(below), Some(&high)) => {
                let part = (r - radius[below]) / (high - radius[below]);
                wear[below] + part * (wear[above] - wear[below])
            }
            (None, Some(&high)) if high == r => wear[above],
            _ => 0.0,
        };
        value as f32
    });
    values.collect()
}

/// Places of a band: points of the active profile, thinned.
fn places(profile: &WearProfile) -> Vec<f64> {
    let [low, high] = profile.active_mm;
    let active: Vec<f64> = profile.radius_mm.iter().copied().filter(|r| (low..=high).contains(r)).collect();
    let every = active.len().div_ceil(PLACES).max(1);
    active.into_iter().step_by(every).collect()
}

fn band(places: &[f64], nominal: &WearProfile, wear: &[&[f32]]) -> Band {
    let mut quantiles_um = [const { Vec::new() }; 5];
    for place in 0..places.len() {
        let mut values: Vec<f64> = wear.iter().map(|wear| f64::from(wear[place])).collect();
        values.sort_by(f64::total_cmp);
        for (all, share) in quantiles_um.iter_mut().zip(SHARES) {
            all.push(quantile(&values, share).unwrap_or(f64::NAN));
        }
    }
    let nominal_um = at(nominal, places).into_iter().map(f64::from).collect();
    let radius_mm = places.iter().map(|radius| radius.abs()).collect();
    Band { radius_mm, nominal_um, quantiles_um }
}
