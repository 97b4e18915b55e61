"""Planetary stages: sun, planets and ring as a whole."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

from gearwear import _native
from gearwear._native import Stage as Native
from gearwear.errors import NotConverged, RunError, WornThrough
from gearwear.kept import kind_of
from gearwear.run import Flank, Run
from gearwear.scene import Scene
from gearwear.table import Table
from gearwear.version import refuse_other
from gearwear.workers import ProgressArgument, Watched, thread_count

#: A mesh of a stage.
StageMesh = Literal["sun-planet", "planet-ring"]

#: How unfinished runs end.
_FAILURES: dict[str, type[RunError]] = {"not-converged": NotConverged, "worn-through": WornThrough}


def _restored_stage(name: str, text: str, folder: str, files: list[tuple[str, bytes]]) -> PlanetaryStage:
    return PlanetaryStage(Native.from_parts(name, text, folder, files))


class PlanetaryStage:
    """A planetary stage with its load, life and wear laws: a scene with ``[planetary]``, checked, with every file it names.

    :func:`gearwear.sweep`, :func:`gearwear.uncertainty` and :func:`gearwear.evaluate` take it as they take a :class:`Scene`, with the keys of its file and the
    paths of its ``summary.json``. Stages never change; :meth:`with_` makes another one.
    """

    __slots__ = ("_native",)
    _native: Native

    def __init__(self, native: Native) -> None:
        if not isinstance(native, Native):
            raise TypeError("a stage is made by PlanetaryStage.from_file, from_toml, from_dict or from_rexs")
        object.__setattr__(self, "_native", native)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a stage never changes; with_(...) makes another one, found: {name}")

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> PlanetaryStage:
        """The stage in a file; files that it names lie beside it."""
        return cls(Native.open(os.fspath(path)))

    @classmethod
    def from_toml(cls, text: str, folder: str | os.PathLike[str] = "") -> PlanetaryStage:
        """The stage in a text; files that it names lie in ``folder``, by default the current one."""
        return cls(Native.from_parts("stage", text, os.fspath(folder), []))

    @classmethod
    def from_dict(cls, tables: Mapping[str, Any], folder: str | os.PathLike[str] = "") -> PlanetaryStage:
        """The stage that a dict of its tables is; what is None is left out."""
        return cls.from_toml(_native.Scene.text_of(tables), folder)

    @classmethod
    def from_rexs(cls, path: str | os.PathLike[str], *, stage: int | None = None) -> PlanetaryStage:
        """The planetary stage of a gear unit in REXS, by the number of a mesh of its sun with a planet: ``gearwear init --from``."""
        text, left_out = _native.Scene.text_of_rexs(os.fspath(path), stage)
        for warning in left_out:
            warnings.warn(warning, stacklevel=2)
        return cls(Native.from_parts(os.fspath(path), text, "", []))

    def with_(self, changes: Mapping[str, Any] | None = None, /, **more: Any) -> PlanetaryStage:
        """The same stage with other values of its keys, all changed together: ``with_({"planetary.load_sharing_factor": 1.1})``; None leaves a key out."""
        return PlanetaryStage(self._native.with_all([*(changes or {}).items(), *more.items()]))

    def without(self, *keys: str) -> PlanetaryStage:
        """The same stage without these keys, so that their defaults hold."""
        return PlanetaryStage(self._native.with_all([(key, None) for key in keys]))

    def mesh(self, mesh: StageMesh) -> Scene:
        """The scene of a mesh, ``"sun-planet"`` or ``"planet-ring"``: a pair that runs on the carrier, for finite elements, calibration and the rest."""
        return Scene(self._native.mesh(mesh))

    @property
    def text(self) -> str:
        """The text that it was made from, with the changes since."""
        return self._native.text

    @property
    def title(self) -> str:
        """What it is called."""
        return self._native.title

    @property
    def warnings(self) -> list[str]:
        """Likely slips of unit, and keys that are not used."""
        return self._native.warnings

    def run(
        self,
        *,
        resume: str | os.PathLike[str] | None = None,
        threads: int | None = None,
        progress: ProgressArgument = False,
    ) -> StageRun:
        """Runs the wear of both meshes, as :meth:`Scene.run` does that of a pair; ``resume`` is a folder in which the stage is kept.

        Raises :class:`gearwear.NotConverged`, :class:`gearwear.WornThrough` or :class:`gearwear.RunError` where a mesh fails; what was finished is in the
        error's ``stage``.
        """
        count = thread_count(threads)
        folder = None if resume is None else os.fspath(resume)
        with Watched(progress) as told:
            native, failure = self._native.run(folder, count, told)
        run = StageRun(native)
        if failure is not None:
            raise _FAILURES.get(run.summary["stopped"], RunError)(failure, stage=run)
        return run

    def __eq__(self, other: object) -> bool:
        return self._native == other._native if isinstance(other, PlanetaryStage) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._native)

    def __reduce__(self) -> tuple[Any, ...]:
        native = self._native
        return _restored_stage, (native.name, native.text, str(Path(native.folder)), native.files)

    def __copy__(self) -> PlanetaryStage:
        return self

    def __deepcopy__(self, _: dict[int, Any]) -> PlanetaryStage:
        return self

    def __repr__(self) -> str:
        return f"<gearwear.PlanetaryStage {self.title!r}>"


class StageRun:
    """What the run of a planetary stage found: the runs of both meshes, the flanks of all gears, and the summary."""

    def __init__(self, native: _native.StageRun) -> None:
        self._native = native

    @cached_property
    def summary(self) -> dict[str, Any]:
        """What ``summary.json`` holds."""
        summary: dict[str, Any] = json.loads(self._native.summary_json)
        return summary

    @cached_property
    def sun_planet(self) -> Run:
        """The run of sun (pinion) and planet (wheel)."""
        return self._mesh("sun-planet")

    @cached_property
    def planet_ring(self) -> Run:
        """The run of planet (pinion) and ring (wheel)."""
        return self._mesh("planet-ring")

    @property
    def sun(self) -> Flank:
        """The sun's flank."""
        return self.sun_planet.pinion

    @property
    def planet_sun_flank(self) -> Flank:
        """The planet's flank that meets the sun."""
        return self.sun_planet.wheel

    @property
    def planet_ring_flank(self) -> Flank:
        """The planet's flank that meets the ring."""
        return self.planet_ring.pinion

    @property
    def ring(self) -> Flank:
        """The ring's flank."""
        return self.planet_ring.wheel

    @cached_property
    def transmission_error(self) -> Table:
        """Transmission error of the stage over one base pitch, new and worn: the rows of ``transmission_error.csv``."""
        return Table("transmission_error", self._native.transmission_error())

    @cached_property
    def stage(self) -> PlanetaryStage:
        """The stage as its file gives it."""
        files = {name: data for run in (self.sun_planet, self.planet_ring) for name, data in run._native.input_files}
        return PlanetaryStage(Native.from_parts("scene.toml", self._native.scene_toml, "", list(files.items())))

    @property
    def warnings(self) -> list[str]:
        """What the user should know."""
        warnings: list[str] = self.summary["warnings"]
        return warnings

    def _mesh(self, name: StageMesh) -> Run:
        native = self._native.mesh(name)
        if native is None:
            raise ValueError(f"the mesh {name} was not begun: the other one did not come to its end")
        return Run(native)

    @classmethod
    def read(cls, folder: str | os.PathLike[str]) -> StageRun:
        """The run in a folder that ``gearwear run`` of a stage or :meth:`write` of this version wrote, equal to that in every bit."""
        kind_of(folder, cls.__name__)
        return cls(_native.StageRun.read(os.fspath(folder)))

    def write(
        self,
        folder: str | os.PathLike[str],
        *,
        report: bool = True,
        workbook: bool = False,
        series: bool = False,
        figures: str | os.PathLike[str] | None = None,
    ) -> None:
        """Writes what ``gearwear run`` of a stage writes: a folder of each mesh, and the files of the stage."""
        into = None if figures is None else os.fspath(figures)
        self._native.write(os.fspath(folder), report, workbook, series, into)

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored_run, (_native.VERSION, self._native.to_bytes())

    def __repr__(self) -> str:
        summary = self.summary
        flanks = {
            "sun": summary["sun"],
            "planet": summary["planet"]["sun_flank"],
            "planet (ring)": summary["planet"]["ring_flank"],
            "ring": summary["ring"],
        }
        wear = ", ".join(f"{name} {of['peak_wear_um']:.3g} µm" for name, of in flanks.items() if of is not None)
        return f"<gearwear.StageRun {summary['title']!r}: {summary['stopped']}, maximum wear {wear}>"


def _restored_run(version: str, data: bytes) -> StageRun:
    refuse_other(version)
    return StageRun(_native.StageRun.from_bytes(data))
