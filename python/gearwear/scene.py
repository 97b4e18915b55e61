"""Scenes: what is asked."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from gearwear._native import Scene as Native
from gearwear._native import key_fault
from gearwear.calibration import Calibration
from gearwear.errors import NotConverged, RunError, WornThrough
from gearwear.fem import FemPair
from gearwear.mesh import Mesh
from gearwear.run import Run
from gearwear.studies import Study
from gearwear.workers import ProgressArgument, Watched, thread_count

#: How unfinished runs end.
_FAILURES: dict[str, type[RunError]] = {"not-converged": NotConverged, "worn-through": WornThrough}


def _restored(name: str, text: str, folder: str, files: list[tuple[str, bytes]]) -> Scene:
    return Scene(Native.from_parts(name, text, folder, files))


class Scene:
    """A gear pair with its load, life and wear law: a scene, checked, with every file it names.

    Scenes never change; :meth:`with_` makes another one. Two are equal where their resolved texts (:meth:`to_toml`: every default filled in)
    and the contents of the files they name are. They can be keys of a dict, and are pickled as their text with these files.
    """

    __slots__ = ("_native",)
    _native: Native

    def __init__(self, native: Native) -> None:
        if not isinstance(native, Native):
            raise TypeError("a scene is made by Scene.preset, Scene.from_file, Scene.from_toml or Scene.from_dict")
        object.__setattr__(self, "_native", native)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a scene never changes; with_(...) makes another one, found: {name}")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"a scene never changes; without(...) makes another one, found: {name}")

    @classmethod
    def preset(cls, name: str) -> Scene:
        """A built-in scene, such as ``"fzg-c"`` (:func:`gearwear.presets`)."""
        return cls(Native.preset(name))

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Scene:
        """The scene in a file; files that it names lie beside it."""
        return cls(Native.open(os.fspath(path)))

    @classmethod
    def from_toml(cls, text: str, folder: str | os.PathLike[str] = "") -> Scene:
        """The scene in a text; files that it names lie in ``folder``, by default the current one."""
        return cls(Native.from_parts("scene", text, os.fspath(folder), []))

    @classmethod
    def from_dict(cls, tables: Mapping[str, Any], folder: str | os.PathLike[str] = "") -> Scene:
        """The scene that a dict of its tables is, such as ``{"pair": {"preset": "fzg-c"}, …}``; what is None is left out."""
        return cls.from_toml(Native.text_of(tables), folder)

    @classmethod
    def from_rexs(cls, path: str | os.PathLike[str], *, stage: int | None = None) -> Scene:
        """The scene of a cylindrical stage of a gear unit in REXS, of the only one without ``stage``, its number from 1: ``gearwear init --from``.

        What a scene cannot say of it is warned of. A stage that leaves open what a scene needs raises :class:`SceneError`, whose findings name it.
        """
        text, left_out = Native.text_of_rexs(os.fspath(path), stage)
        for warning in left_out:
            warnings.warn(warning, stacklevel=2)
        return cls(Native.from_parts(os.fspath(path), text, "", []))

    def __getitem__(self, key: str) -> Any:
        """The value of a key of the resolved scene, such as ``scene["operation.pinion_torque_Nm"]``; items of lists are numbered from 1.

        None where the scene leaves it out; a key that no scene has raises :class:`KeyError`.
        """
        if not isinstance(key, str):
            raise TypeError(f"found a key of type {type(key).__name__}; allowed: a text, such as 'operation.pinion_torque_Nm'")
        fault = key_fault(key)
        if fault is not None:
            raise KeyError(fault)
        value: Any = self.to_dict()
        for part in key.split("."):
            if isinstance(value, list):
                value = value[int(part) - 1] if part.isdigit() and 0 < int(part) <= len(value) else None
            else:
                value = value.get(part) if isinstance(value, dict) else None
        return value

    def with_(self, changes: Mapping[str, Any] | None = None, /, **more: Any) -> Scene:
        """The same scene with other values, all changed together: ``with_(**{"operation.pinion_torque_Nm": 250})``.

        Keys and values are those that :func:`gearwear.evaluate` and :func:`gearwear.sweep` take: ``"pair.{pinion,wheel}.teeth"`` is both keys, a
        number one of NumPy's too, or an array of one. A key whose value is None is left out, so that its default holds.
        """
        return Scene(self._native.with_all([*(changes or {}).items(), *more.items()]))

    def without(self, *keys: str) -> Scene:
        """The same scene without these keys, so that their defaults hold."""
        return Scene(self._native.with_all([(key, None) for key in keys]))

    def with_calibration(self, calibration: Calibration) -> Scene:
        """The same scene with this calibration, as if its file named it."""
        return Scene(self._native.with_calibration(calibration._native))

    def to_toml(self) -> str:
        """The resolved scene: every default filled in."""
        return self._native.to_toml()

    def to_dict(self) -> dict[str, Any]:
        """The same as a dict of its tables."""
        tables: dict[str, Any] = json.loads(self._native.to_json())
        return tables

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

    def plan(self) -> dict[str, list[dict[str, str]]]:
        """The stages that a run of it has (``"stages"``) and those left out (``"left_out"``), each with its name and the reason."""
        plan: dict[str, list[dict[str, str]]] = json.loads(self._native.plan_json())
        return plan

    def run(
        self,
        *,
        resume: str | os.PathLike[str] | None = None,
        threads: int | None = None,
        progress: ProgressArgument = False,
    ) -> Run:
        """Runs the wear simulation.

        ``resume`` is a folder in which the run is kept from its beginning on, as by ``gearwear run``: the same call goes on from the last checkpoint
        of a run that was stopped or killed there, to the same bits, and reads one that is complete. The run of another scene raises
        :class:`ValueError`.

        ``threads``, by default all cores and one in a worker process, never change a bit of the results. ``progress`` is True for a line on
        standard error, or a function that is called with the name of the stage and the part of it that is done. Ctrl-C stops it.

        Raises :class:`gearwear.SceneError` where the scene turns out to be wrong, :class:`gearwear.NotConverged` and
        :class:`gearwear.WornThrough` with what was finished, and :class:`gearwear.RunError` where nothing was.
        """
        count = thread_count(threads)
        folder = None if resume is None else os.fspath(resume)
        with Watched(progress) as told:
            native, failure = self._native.run(folder, count, told)
        run = Run(native)
        if failure is not None:
            raise _FAILURES.get(run.summary["stopped"], RunError)(failure, run)
        return run

    def calibrate(self, *, threads: int | None = None, progress: ProgressArgument = False) -> Calibration:
        """Calibrates the fast model of its pair with finite elements, for :meth:`with_calibration`."""
        count = thread_count(threads)
        with Watched(progress) as told:
            return Calibration(self._native.calibrate(count, told))

    def accuracy(
        self,
        *,
        within: float = 0.05,
        quick: bool = False,
        threads: int | None = None,
        progress: ProgressArgument = False,
    ) -> Study:
        """The error of every model that fits it against its run time: ``gearwear accuracy``, which takes minutes.

        ``summary["recommendations"]`` has the cheapest setting whose relative error stays ``within`` the one given; ``quick`` leaves the scene's own
        resolution out.
        """
        count = thread_count(threads)
        with Watched(progress) as told:
            return Study(self._native.accuracy(float(within), quick, count, told))

    def mesh(
        self,
        position_mm: float | None = None,
        *,
        three_dimensional: bool = False,
        loaded: bool = False,
        threads: int | None = None,
        progress: ProgressArgument = False,
    ) -> Mesh:
        """The finite-element mesh of its pair in contact at a position, by default the pitch point: ``gearwear mesh``.

        Both gears in the plane, or ``three_dimensional`` one pitch of each over the face width; that ``loaded`` with displacement and stress under
        the scene's torque, on unworn flanks.
        """
        if loaded and not three_dimensional:
            raise ValueError("loaded teeth are three-dimensional: mesh(three_dimensional=True, loaded=True)")
        count = thread_count(threads)
        with Watched(progress) as told:
            return Mesh(self._native.mesh(position_mm, three_dimensional, loaded, count, told))

    def fem(
        self, position_mm: float | None = None, *, threads: int | None = None, progress: ProgressArgument = False
    ) -> FemPair:
        """Solves the contact of its pair with plane finite elements: at one position of the path of contact, or over the mesh cycle."""
        count = thread_count(threads)
        with Watched(progress) as told:
            native, failure = self._native.fem(position_mm, count, told)
        if failure is not None:
            raise RunError(failure)
        return FemPair(native)

    def __eq__(self, other: object) -> bool:
        return self._native == other._native if isinstance(other, Scene) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._native)

    def __reduce__(self) -> tuple[Any, ...]:
        native = self._native
        return _restored, (native.name, native.text, str(Path(native.folder)), native.files)

    def __copy__(self) -> Scene:
        return self

    def __deepcopy__(self, _: dict[int, Any]) -> Scene:
        return self

    def __repr__(self) -> str:
        tables = self.to_dict()
        pair, operation = tables["pair"], tables["operation"]
        teeth = f"{pair['pinion']['teeth']}/{pair['wheel']['teeth']} teeth"
        module = next(f"{name.split('_')[0]} module {pair[name]:g} mm" for name in pair if name.endswith("_module_mm"))
        helix = pair.get("helix_angle_deg") or 0.0
        kind = f"helix angle {helix:g}°" if helix else "spur"
        torque = f"{operation['pinion_torque_Nm']:g} N·m"
        surface = tables.get("contact", {}).get("surface")
        law = tables["wear"].get("law", "a law for each gear")
        said = ", ".join(part for part in (teeth, module, kind, torque, surface, law) if part)
        return f"<gearwear.Scene {self.title!r}: {said}>"
