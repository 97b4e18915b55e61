"""Results as xarray data sets: dimensions with coordinates, units and meanings as attributes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

if TYPE_CHECKING:
    from gearwear.run import Flank, Run

#: Fields with a value for each point and slice.
FIELDS = ("removed_um", "sliding_mm_per_mesh", "wear_um", "pressure_new_MPa", "pressure_worn_MPa")


def over_slices(flank: Flank, field: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """A field with the shape (slices, points), also where all sections are alike."""
    return field.reshape(flank.width_mm.size, flank.radius_mm.size)


def of_flank(flank: Flank) -> xr.Dataset:
    """The fields over one flank."""
    about = flank.table.attributes
    coordinates = {
        "radius_mm": ("point", flank.radius_mm, about("radius_mm")),
        "roll_angle_deg": ("point", flank.roll_angle_deg, about("roll_angle_deg")),
        "width_mm": ("slice", flank.width_mm, about("width_mm")),
    }
    fields = {name: (("slice", "point"), over_slices(flank, getattr(flank, name)), about(name)) for name in FIELDS}
    if flank.snapshot_wear_um:
        snapshots = np.stack([over_slices(flank, wear) for wear in flank.snapshot_wear_um])
        fields["snapshot_wear_um"] = (("snapshot", "slice", "point"), snapshots, about("wear_um"))  # type: ignore[assignment]
    return xr.Dataset(fields, coordinates)


def of_run(run: Run) -> xr.Dataset:
    """Both flanks, the mesh cycle and the history in one data set."""
    flanks = xr.concat([of_flank(run.pinion), of_flank(run.wheel)], "gear", coords=["radius_mm", "roll_angle_deg"])
    flanks = flanks.assign_coords(gear=["pinion", "wheel"])
    cycle = run.mesh_cycle.to_xarray("position", ("position_mm",))
    history = run.history.to_xarray("snapshot", ("hours", "revolutions", "phase"))
    whole = xr.merge([flanks, cycle, history], combine_attrs="override", compat="equals", join="exact")
    summary = run.summary
    whole.attrs = {key: summary[key] for key in ("title", "program_version", "scene_hash", "stopped")}
    return whole
