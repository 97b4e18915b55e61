"""Uncertainty: what a run's figures are worth where some of its keys are known only as distributions."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from operator import index
from typing import TYPE_CHECKING, Any

from gearwear.figures import warn_of_older_names
from gearwear.kept import Kept, as_kept
from gearwear.scene import Scene
from gearwear.stage import PlanetaryStage
from gearwear.table import Table
from gearwear.workers import ProgressArgument, Watched, thread_count

if TYPE_CHECKING:
    from gearwear import _native
    from gearwear.table import Array


@dataclass(frozen=True)
class Indices:
    """Sobol indices of a figure, one for each factor; intervals hold 95 %."""

    #: the uncertain keys, and the error of the fast model where it is known
    factors: list[str]
    #: the part of the variance that would go if the factor alone were known
    first: Array
    #: (factors, 2)
    first_interval: Array
    #: the part that would stay if all other factors were known
    total: Array
    #: (factors, 2)
    total_interval: Array


@dataclass(frozen=True)
class Band:
    """Wear over a flank, its maximum over the face width: quantiles place by place."""

    radius_mm: Array
    #: of the scene as given
    nominal_um: Array
    #: below which 5, 25, 50, 75 and 95 % of the samples lie: (5, places)
    quantiles_um: Array


class Uncertainty:
    """A study of uncertainty. Figures are named by their path in the summary, lives as ``"life.pinion.peak_wear_um=10"``."""

    def __init__(self, native: _native.Uncertainty | Kept) -> None:
        self._native = native

    @classmethod
    def read(cls, folder: str | os.PathLike[str]) -> Uncertainty:
        """The study in a folder that ``gearwear uncertainty`` or :meth:`write` wrote."""
        return cls(Kept.read(folder, "Uncertainty"))

    @cached_property
    def summary(self) -> dict[str, Any]:
        """What ``uncertainty.json`` holds."""
        summary: dict[str, Any] = json.loads(self._native.summary_json)
        return summary

    @property
    def outputs(self) -> list[str]:
        """The names of the figures."""
        return [output["output"] for output in self.summary["outputs"]]

    def output(self, name: str) -> dict[str, Any]:
        """All that ``uncertainty.json`` says of a figure."""
        for output in self.summary["outputs"]:
            if output["output"] == name:
                found: dict[str, Any] = output
                return found
        raise KeyError(f"the study has no figure {name}; allowed: {', '.join(self.outputs)}")

    def quantiles(self, name: str) -> dict[str, float | None]:
        """The value of a figure that 5, 25, 50, 75 and 95 % of the samples stay below, under ``"p05"`` to ``"p95"``; None where it is not known."""
        return dict(self.output(name)["quantiles"])

    def indices(self, name: str) -> Indices | None:
        """The Sobol indices of a figure; None where there are none, for the reason in ``output(name)["no_indices_because"]``."""
        import numpy as np

        found = self.output(name)["indices"]
        if found is None:
            return None

        def of(order: str) -> tuple[Array, Array]:
            each = [one[order] for one in found]
            return np.array([one["value"] for one in each]), np.array([[one["low"], one["high"]] for one in each])

        return Indices([one["factor"] for one in found], *of("first"), *of("total"))

    @cached_property
    def samples(self) -> Table:
        """A row for each sample: point, matrix, values of the keys, figures."""
        return Table("samples", self._native.samples())

    def band(self, gear: str) -> Band:
        """The wear over the flank of ``"pinion"`` or ``"wheel"``; of a stage of ``"sun"``, ``"planet.sun_flank"``, ``"planet.ring_flank"`` or ``"ring"``."""
        import numpy as np

        bands = self.summary["bands"]
        if gear not in bands:
            raise KeyError(f"found the gear {gear!r}; allowed: {', '.join(bands)}")
        return Band(**{name: np.array(values, dtype=float) for name, values in bands[gear].items()})

    def write(self, folder: str | os.PathLike[str]) -> None:
        """Writes what ``gearwear uncertainty`` writes."""
        self._native.write(os.fspath(folder))

    def __reduce__(self) -> tuple[Any, ...]:
        return Uncertainty, (as_kept(self._native),)

    def __repr__(self) -> str:
        summary = self.summary
        keys = ", ".join(one["key"] for one in summary["uncertain"])
        return f"<gearwear.Uncertainty {summary['title']!r}: {summary['samples']} samples of {keys}, {summary['failed']} runs failed>"


def uncertainty(
    scene: Scene | PlanetaryStage,
    distributions: Mapping[str, Any],
    n: int = 512,
    seed: int = 1,
    *,
    correlation: Mapping[tuple[str, str], float] | None = None,
    outputs: Iterable[str] = (),
    limits: Mapping[str, float] | None = None,
    own_surface: bool = False,
    run_all: bool = False,
    out: str | os.PathLike[str] | None = None,
    threads: int | None = None,
    progress: ProgressArgument = False,
) -> Uncertainty:
    """Runs ``scene`` for samples of uncertain keys: what ``gearwear uncertainty`` does, with the same figures.

    ``distributions`` has for each key a distribution as after ``--uncertain KEY=``: ``"lognormal:1.5"``, ``"normal:5%"``, ``"±2%"``, ``"uniform:10:14"``;
    or one of ``scipy.stats``: ``norm``, ``lognorm`` with ``loc`` 0, ``uniform`` or ``triang``, frozen with their parameters.
    ``n`` points of a Sobol sequence, best a power of two, give n (keys + 2) samples, or 2 n where keys are correlated; ``seed`` scrambles them.
    ``correlation`` has for pairs of keys the correlation of their normal scores. ``outputs`` are paths in the summary, by default the maximum wear
    and tip-edge wear of both gears and the transmission error, worn; ``limits`` has depths of wear in µm whose life is asked for:
    ``{"pinion.peak_wear_um": 10}``. The samples are run on a calibrated Winkler foundation where their figures differ there by at most 5 %, with
    ``own_surface`` always on the surface of the scene; most are read off a response surface of the others where it misses figures by at most 5 % of their
    standard deviation, with ``run_all`` none. ``out`` is a folder whose journal keeps each run as it is finished: the same
    call goes on with those that are missing, and ``write(out)`` adds the files. ``threads`` (None: all cores, one in a worker process) run a sample each and never change a bit of the results.

    What is wrong with the question raises :class:`ValueError`, and :class:`gearwear.RunError` is raised where no sample can be run.
    """
    if not isinstance(scene, (Scene, PlanetaryStage)):
        raise TypeError(f"scene: found {type(scene).__name__}; allowed: a gearwear.Scene or gearwear.PlanetaryStage")
    if not isinstance(distributions, Mapping):
        raise TypeError(f"distributions: found {type(distributions).__name__}; allowed: a dict of keys and their distributions")
    if isinstance(outputs, str):
        raise TypeError(f"outputs: found {outputs!r}; allowed: a list of texts")
    samples, scrambling = _whole("n", n, 2), _whole("seed", seed, 0)
    uncertain = [f"{key}={_as_given(key, distribution)}" for key, distribution in distributions.items()]
    pairs = [f"{one}:{other}={float(r)!r}" for (one, other), r in (correlation or {}).items()]
    depths = [f"{name}={float(depth)!r}" for name, depth in (limits or {}).items()]
    count = thread_count(threads)
    kept = list(outputs)
    folder = None if out is None else os.fspath(out)
    warn_of_older_names([*kept, *(limits or {})])
    with Watched(progress) as told:
        return Uncertainty(
            scene._native.uncertainty(uncertain, pairs, kept, depths, samples, scrambling, own_surface, run_all, folder, count, told)
        )


#: Shape parameters of the distributions of ``scipy.stats`` that are taken.
_SHAPES: dict[str, tuple[str, ...]] = {"norm": (), "lognorm": ("s",), "uniform": (), "triang": ("c",)}


def _as_given(key: str, distribution: Any) -> str:
    """A distribution as the command line has it."""
    if isinstance(distribution, str):
        return distribution
    name = getattr(getattr(distribution, "dist", None), "name", type(distribution).__name__)
    if name not in _SHAPES:
        allowed = f"a text such as 'normal:5%', or of scipy.stats {', '.join(_SHAPES)}"
        raise TypeError(f"{key}: found {name}; allowed: {allowed}")
    names = (*_SHAPES[name], "loc", "scale")
    given = {"loc": 0.0, "scale": 1.0} | dict(zip(names, distribution.args)) | distribution.kwds
    loc, scale = float(given["loc"]), float(given["scale"])
    if name == "norm":
        return f"normal:{loc!r}:{scale!r}"
    if name == "uniform":
        return f"uniform:{loc!r}:{loc + scale!r}"
    if name == "triang":
        return f"triangular:{loc!r}:{loc + float(given['c']) * scale!r}:{loc + scale!r}"
    if loc != 0.0:
        raise ValueError(f"{key}: found lognorm with loc={loc!r}; allowed: loc=0")
    return f"lognormal:{scale!r}:{math.exp(float(given['s']))!r}"


def _whole(name: str, value: int, least: int) -> int:
    try:
        number = index(value)
    except TypeError:
        raise TypeError(f"{name}: found {value!r}; allowed: a whole number") from None
    if not least <= number < 2**32:
        raise ValueError(f"{name}: found {number}; allowed: a whole number from {least} to {2**32 - 1}")
    return number
