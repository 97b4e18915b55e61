"""Results of a wear run."""

from __future__ import annotations

import json
import os
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

from gearwear import _native
from gearwear.figures import main_figures
from gearwear.kept import kind_of
from gearwear.table import Table
from gearwear.version import refuse_other

if TYPE_CHECKING:
    import numpy as np
    import pandas as pd
    import xarray as xr

    from gearwear.plot import Plots
    from gearwear.scene import Scene

    Numbers = np.ndarray[Any, np.dtype[np.float64]]
    Flags = np.ndarray[Any, np.dtype[np.bool_]]

Gear = Literal["pinion", "wheel"]

#: The plot that a notebook shows first, of equal sections and of slices.
_PICTURES = ("wear", "wear-pinion")


class Flank:
    """One flank, from base circle to tip circle. Arrays are read-only and borrow the memory of the run.

    Fields over the flank have one value a point, or, where the pair has slices over the face width, the shape (slices, points).
    """

    #: distance from the gear's axis (points)
    radius_mm: Numbers
    #: roll angle of the transverse involute (points)
    roll_angle_deg: Numbers
    #: place of each slice over the face width (slices)
    width_mm: Numbers
    #: material removed by modifications, normal to the flank
    removed_um: Numbers
    #: distance the point slides against the other flank during one mesh, new
    sliding_mm_per_mesh: Numbers
    #: wear depth at the end of the run, normal to the flank
    wear_um: Numbers
    #: maximum pressure during one mesh, new
    pressure_new_MPa: Numbers
    #: the same, worn
    pressure_worn_MPa: Numbers

    def __init__(self, native: _native.Run, gear: Gear) -> None:
        self._native = native
        self._gear: Gear = gear

    # Of a name that is none, a type checker says so.
    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            if name.startswith("_") or name not in Flank.__annotations__:
                allowed = ", ".join(Flank.__annotations__)
                raise AttributeError(f"a flank has no {name}; allowed: {allowed}", name=name, obj=self)
            array = self._native.flank_array(self._gear, name)
            self.__dict__[name] = array
            return array

    @cached_property
    def verified_wear_um(self) -> Numbers | None:
        """Wear depth at the end of the run by the finite elements that verify it; None without verification."""
        return self._native.flank_array(self._gear, "verified_wear_um")

    @cached_property
    def snapshot_wear_um(self) -> tuple[Numbers, ...]:
        """Wear depth at each snapshot of the history."""
        return tuple(self._native.snapshot_arrays(self._gear, False))

    @cached_property
    def snapshot_pressure_MPa(self) -> tuple[Numbers, ...]:
        """Maximum pressure during one mesh at each snapshot of the history."""
        return tuple(self._native.snapshot_arrays(self._gear, True))

    @cached_property
    def table(self) -> Table:
        """The rows of ``pinion.csv`` or ``wheel.csv``: a row for each point and slice."""
        columns = self._native.table(self._gear)
        assert columns is not None
        return Table(self._gear, columns)

    def to_pandas(self) -> pd.DataFrame:
        """The rows of ``pinion.csv`` or ``wheel.csv``."""
        return self.table.to_pandas()

    def to_xarray(self) -> xr.Dataset:
        """Fields over the flank, with the dimensions ``slice`` and ``point``; units and meanings are attributes."""
        from gearwear.labelled import of_flank

        return of_flank(self)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *Flank.__annotations__]

    def __reduce__(self) -> tuple[Any, ...]:
        return getattr, (Run(self._native), self._gear)

    def __repr__(self) -> str:
        return f"<{self._gear}: {self.radius_mm.size} points, {self.width_mm.size} slices>"


class Slices:
    """The mesh of one tooth slice by slice. Fields have the shape (positions, slices), read-only, and borrow the memory of the run."""

    #: place of each slice over the face width (slices)
    width_mm: Numbers
    #: how far the theoretical contact point of each slice is ahead of that in the middle of the face width (slices)
    ahead_mm: Numbers
    #: position of the tooth in the middle of the face width, also before A and after E (positions)
    position_mm: Numbers
    #: load of each slice per mm of face width, new
    line_load_new_N_per_mm: Numbers
    #: the same, worn
    line_load_worn_N_per_mm: Numbers
    #: maximum pressure of each slice, new
    peak_pressure_new_MPa: Numbers
    #: the same, worn
    peak_pressure_worn_MPa: Numbers
    #: whether a sharp tip edge cuts the contact off: its pressure is not defined, new
    at_sharp_edge_new: Flags
    #: the same, worn
    at_sharp_edge_worn: Flags

    def __init__(self, native: _native.Run) -> None:
        self._native = native

    # Of a name that is none, a type checker says so.
    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            if name.startswith("_") or name not in Slices.__annotations__:
                allowed = ", ".join(Slices.__annotations__)
                raise AttributeError(f"slices have no {name}; allowed: {allowed}", name=name, obj=self)
            array = self._native.slice_array(name)
            self.__dict__[name] = array
            return array

    @cached_property
    def table(self) -> Table:
        """The rows of ``slices.csv``."""
        columns = self._native.table("slices")
        assert columns is not None
        return Table("slices", columns)

    def to_pandas(self) -> pd.DataFrame:
        """The rows of ``slices.csv``."""
        return self.table.to_pandas()

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *Slices.__annotations__]

    def __reduce__(self) -> tuple[Any, ...]:
        return getattr, (Run(self._native), "slices")

    def __repr__(self) -> str:
        return f"<slices: {self.width_mm.size} slices, {self.position_mm.size} positions>"


class Run:
    """What a wear run found: arrays under the names of the CSV files, and the summary."""

    def __init__(self, native: _native.Run) -> None:
        self._native = native

    @cached_property
    def summary(self) -> dict[str, Any]:
        """What ``summary.json`` holds."""
        summary: dict[str, Any] = json.loads(self._native.summary_json)
        return summary

    @cached_property
    def pinion(self) -> Flank:
        """The pinion's flank."""
        return Flank(self._native, "pinion")

    @cached_property
    def wheel(self) -> Flank:
        """The wheel's flank."""
        return Flank(self._native, "wheel")

    @cached_property
    def mesh_cycle(self) -> Table:
        """A row for each loading position: load share, pressure, transmission error, new and worn."""
        return self._table("mesh_cycle")

    @cached_property
    def history(self) -> Table:
        """A row for each snapshot."""
        return self._table("history")

    @cached_property
    def profiles(self) -> Table:
        """A row for each point, slice, gear and snapshot: ``profiles.csv``."""
        return self._table("profiles")

    @cached_property
    def film(self) -> Table | None:
        """A row for each position, and slice: films and friction, new and worn; None where the scene asks for neither."""
        columns = self._native.table("film")
        return None if columns is None else Table("film", columns)

    @cached_property
    def torque_curve(self) -> Table | None:
        """A row for each torque: transmission error and flank pressure, new and worn; None where the scene names no torques."""
        columns = self._native.table("torque_curve")
        return None if columns is None else Table("torque_curve", columns)

    @cached_property
    def slices(self) -> Slices | None:
        """The mesh of one tooth slice by slice; None where all sections are alike."""
        return None if self._native.slice_array("width_mm") is None else Slices(self._native)

    @cached_property
    def scene(self) -> Scene:
        """The resolved scene that was run."""
        from gearwear.scene import Scene

        native = _native.Scene.from_parts("scene.toml", self._native.scene_toml, "", self._native.input_files)
        return Scene(native)

    @property
    def warnings(self) -> list[str]:
        """What the user should know."""
        warnings: list[str] = self.summary["warnings"]
        return warnings

    def _table(self, name: str) -> Table:
        columns = self._native.table(name)
        assert columns is not None
        return Table(name, columns)

    def to_pandas(self) -> dict[str, pd.DataFrame]:
        """The tables as data frames, by the names of their CSV files."""
        tables: dict[str, Any] = {
            "pinion": self.pinion,
            "wheel": self.wheel,
            "history": self.history,
            "profiles": self.profiles,
            "mesh_cycle": self.mesh_cycle,
        }
        if self.slices is not None:
            tables["slices"] = self.slices
        if self.film is not None:
            tables["film"] = self.film
        if self.torque_curve is not None:
            tables["torque_curve"] = self.torque_curve
        return {name: table.to_pandas() for name, table in tables.items()}

    def to_xarray(self) -> xr.Dataset:
        """Fields over both flanks (gear, slice, point), at the snapshots too, the mesh cycle (position) and the history (snapshot)."""
        from gearwear.labelled import of_run

        return of_run(self)

    @classmethod
    def read(cls, folder: str | os.PathLike[str]) -> Run:
        """The run in a folder that ``gearwear run`` or :meth:`write` of this version wrote, equal to that in every bit.

        A folder that is not there raises :class:`OSError`, one of something else, of another version, or of a run that is not finished
        :class:`ValueError`.
        """
        kind_of(folder, cls.__name__)
        return cls(_native.Run.read(os.fspath(folder)))

    def write(
        self,
        folder: str | os.PathLike[str],
        *,
        report: bool = True,
        workbook: bool = False,
        series: bool = False,
        figures: str | os.PathLike[str] | None = None,
    ) -> None:
        """Writes what ``gearwear run`` writes: tables, page, summary, scene.

        ``report=False`` leaves the page out; ``workbook``, ``series`` and ``figures``, a folder, are the options of the command.
        """
        into = None if figures is None else os.fspath(figures)
        self._native.write(os.fspath(folder), report, workbook, series, into)

    def figures(self) -> dict[str, str]:
        """The plots of the page as drawings, SVG, by name."""
        return dict(self._native.figures())

    @property
    def plot(self) -> Plots:
        """Plots with matplotlib, one for each drawing of the page: ``run.plot.wear()`` and others."""
        from gearwear.plot import Plots

        return Plots(self)

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (_native.VERSION, self._native.to_bytes())

    def __repr__(self) -> str:
        summary = self.summary
        wear = ", ".join(f"{gear} {summary[gear]['peak_wear_um']:.3g} µm" for gear in ("pinion", "wheel"))
        return f"<gearwear.Run {summary['title']!r}: {summary['stopped']}, maximum wear {wear}; {self._trust()}>"

    def _trust(self) -> str:
        """How far it can be trusted, in a few words."""
        error = self.summary["error"]["total"]["peak_wear"]
        known = [part for part in error.values() if part is not None]
        return f"within {100 * max(known):.2g} % of finite elements" if known else "not verified"

    def _repr_html_(self) -> str:
        from html import escape

        summary = self.summary
        of_gears = [figure for figure in main_figures() if figure.in_short_tables and figure.name.startswith("pinion.")]
        keys = [(figure.name.removeprefix("pinion."), f"{figure.row}, {figure.unit}") for figure in of_gears]
        rows = "".join(
            f"<tr><th style='text-align:left'>{name}</th><td>{summary['pinion'][key]:.4g}</td><td>{summary['wheel'][key]:.4g}</td></tr>"
            for key, name in keys
        )
        figures = self.figures()
        picture = next((figures[name] for name in _PICTURES if name in figures), "")
        notes = "".join(f"<li>{escape(text)}</li>" for text in self.warnings)
        return (
            f"<div><b>{escape(summary['title'])}</b> ({escape(summary['stopped'])}; {self._trust()})"
            f"<table><tr><th></th><th>pinion</th><th>wheel</th></tr>{rows}</table>"
            f"<div style='max-width:40em'>{picture}</div>" + (f"<ul>{notes}</ul>" if notes else "") + "</div>"
        )


def _restored(version: str, data: bytes) -> Run:
    refuse_other(version)
    return Run(_native.Run.from_bytes(data))
