"""Modifications of the flanks that keep a gear pair good until the end of its life (docs/sweep.md).

    pip install "./python[plot]" pymoo egobox optuna
    python examples/python/optimise.py --out out/optimise

Three studies, each by its name on the command line, or all of them:

``few-runs``  the relief with the least transmission error when new, of the pair and within the limits of the validation case
              s12-optimal-relief: its grid of 143 reliefs, egobox (Gaussian process, expected improvement) and Optuna (TPE)
``fzg-c``     tip and root relief and profile crowning against greatest wear and transmission error at the end of life: NSGA-II of pymoo
``helical``   the same with lead crowning too, for the preset ``helical``

Every optimiser asks for its runs through ``gearwear.evaluate``: a row of values for each run, several at a time.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")

import egobox
import numpy as np
import optuna
from matplotlib import pyplot
from matplotlib.axes import Axes
from pymoo.algorithms.moo.nsga2 import NSGA2
from pymoo.core.problem import Problem
from pymoo.optimize import minimize

import gearwear

Numbers = np.ndarray[Any, np.dtype[np.float64]]

NEW_ERROR = "new.transmission_error_um.peak_to_peak"
WORN_ERROR = "worn.transmission_error_um.peak_to_peak"
#: Wear of the active profile, of the tip edge and of the zone below the active profile: the greatest of them is minimised.
DEPTHS = [f"{gear}.{zone}_wear_um" for gear in ("pinion", "wheel") for zone in ("peak", "tip_edge", "below_sap")]
#: What keys of both gears begin with.
GEARS = "pair.{pinion,wheel}."
#: Of the unmodified pair and of the designs that are looked at.
COLOURS = ("black", "C0", "C2", "C1", "C3")
#: In place of the figures of a design that cannot be run: worse than any other, yet a number that optimisers can sort.
UNUSABLE = 1e3


@dataclass(frozen=True)
class Study:
    """A pair, the keys that are varied, and their limits."""

    scene: gearwear.Scene
    limits: dict[str, tuple[float, float]]

    def run(self, designs: Numbers, outputs: list[str]) -> Numbers:
        """The outputs of designs, a row each."""
        return gearwear.evaluate(self.scene, list(self.limits), designs, outputs).values

    @property
    def bounds(self) -> Numbers:
        """Lower and upper limits, a row for each key."""
        return np.array(list(self.limits.values()))


def with_reliefs(scene: gearwear.Scene, *ends: str, **changes: Any) -> gearwear.Scene:
    """The scene with reliefs of both gears, whose amounts and lengths can then be varied."""
    reliefs = {f"pair.{gear}.{end}": {"amount_um": 0.0, "length_mm": 2.0} for gear in ("pinion", "wheel") for end in ends}
    return scene.with_({**reliefs, **changes})


def clocks() -> tuple[float, float]:
    """Seconds on the wall and of all processors together."""
    return time.perf_counter(), time.process_time()


def elapsed(start: tuple[float, float]) -> str:
    """Both since ``start``."""
    wall_s, processor_s = (now - then for now, then in zip(clocks(), start))
    return f"{wall_s:.0f} s, {processor_s:.0f} s of processor time"


# Few runs: case s12-optimal-relief


def s12() -> Study:
    """The pair and the limits of the validation case s12-optimal-relief: one revolution, of which only the unworn state is asked for."""
    scene = gearwear.Scene.preset("thesis-spur").with_(
        {"operation.hours": None, "operation.snapshots_h": None, "operation.pinion_revolutions": 1.0},
        **{"numerics.step": {"revolutions": 1.0}, "numerics.positions": 200, "numerics.flank_points": 375},
    )
    limits = {GEARS + "tip_relief.amount_um": (10.0, 60.0), GEARS + "tip_relief.length_mm": (2.0, 8.0)}
    return Study(with_reliefs(scene, "tip_relief"), limits)


def of_grid(study: Study) -> tuple[Numbers, Numbers]:
    """The reliefs of the case's grid and their transmission errors."""
    grid = np.array([(amount, length) for amount in np.linspace(10, 60, 11) for length in np.linspace(2, 8, 13)])
    return grid, study.run(grid, [NEW_ERROR])[:, 0]


def by_egobox(study: Study, runs: int, seed: int) -> tuple[Numbers, Numbers]:
    """The designs that egobox asks for, in order, and their transmission errors: eight at first, then one after the other."""
    first = 8
    ego = egobox.Egor(study.bounds.tolist(), n_doe=first, seed=seed)
    found = ego.minimize(lambda designs: study.run(designs, [NEW_ERROR]), max_iters=runs - first)
    return np.asarray(found.x_doe), np.asarray(found.y_doe)[:, 0]


def by_optuna(study: Study, runs: int, seed: int) -> tuple[Numbers, Numbers]:
    """The same for Optuna's default sampler, asked for one design at a time."""
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    search = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=seed))
    designs, errors = [], []
    for _ in range(runs):
        trial = search.ask()
        design = [trial.suggest_float(key, low, high) for key, (low, high) in study.limits.items()]
        (error,) = study.run(np.array([design]), [NEW_ERROR])[0]
        search.tell(trial, error)
        designs.append(design)
        errors.append(error)
    return np.array(designs), np.array(errors)


def few_runs(out: Path, short: bool) -> None:
    """How many runs each search needs until it has a relief as good as the best of the grid."""
    study = s12()
    start = clocks()
    grid, errors = of_grid(study)
    best = int(np.nanargmin(errors))
    print(f"grid: {errors.size} runs, {errors[best]:.3f} µm at {grid[best, 0]:g} µm over {grid[best, 1]:g} mm")
    pyplot.figure(figsize=(7, 4.2), layout="constrained")
    pyplot.axhline(errors[best], color="black", linewidth=1, label=f"best of the grid, {errors.size} runs")
    searches = (("egobox", by_egobox, 30, "C0"), ("Optuna (TPE)", by_optuna, 143, "C1"))
    for name, search, runs, colour in searches:
        for seed in range(1 if short else 10):
            designs, found = search(study, runs, seed)
            least = np.minimum.accumulate(found)
            reached = np.flatnonzero(least <= errors[best])
            after = f"as good as the grid after {reached[0] + 1}" if reached.size else "never as good as the grid"
            design = designs[np.argmin(found)]
            print(f"{name}, seed {seed}: {after}; after {runs}: {least[-1]:.3f} µm at {design[0]:.1f} µm over {design[1]:.2f} mm")
            pyplot.step(np.arange(1, runs + 1), least, where="post", color=colour, linewidth=1, alpha=0.6, label=name if seed == 0 else None)
    axes = pyplot.gca()
    axes.set(xlabel="runs", ylabel="least transmission error so far, peak to peak, µm", xscale="log", yscale="log", xlim=(1, 143))
    axes.set_xticks([1, 2, 5, 10, 20, 50, 100], minor=False)
    axes.set_yticks([0.5, 1, 2, 5, 10, 20], minor=False)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter("")
    pyplot.legend()
    pyplot.savefig(out / "few-runs.svg")
    print(f"few-runs: {elapsed(start)}")


# Fronts: at the end of life

#: Coarser than the defaults, for the search alone: what it finds is run again on the defaults.
SEARCH = {
    "operation.snapshots_h": None,
    "operation.snapshots_revolutions": None,
    "numerics.positions": 100,
    "numerics.flank_points": 250,
    "numerics.tolerance_um": 0.2,
}


def fzg_c(**changes: Any) -> Study:
    """FZG type C over its 127.75 h."""
    return Study(
        with_reliefs(gearwear.Scene.preset("fzg-c"), "tip_relief", "root_relief", **changes),
        {
            GEARS + "tip_relief.amount_um": (0.0, 60.0),
            GEARS + "tip_relief.length_mm": (1.0, 7.0),
            GEARS + "root_relief.amount_um": (0.0, 20.0),
            GEARS + "root_relief.length_mm": (1.0, 4.0),
            GEARS + "profile_crowning_um": (0.0, 10.0),
        },
    )


def helical(**changes: Any) -> Study:
    """The helical pair of the preset over its 6·10⁵ revolutions; slices are coupled as plates where ``changes`` say nothing else."""
    study = fzg_c()
    scene = with_reliefs(gearwear.Scene.preset("helical"), "tip_relief", "root_relief", **changes)
    return Study(scene, study.limits | {GEARS + "lead_crowning_um": (0.0, 10.0)})


class Life(Problem):  # type: ignore[misc]
    """Greatest wear and transmission error at the end of life, both to be small; keeps all that was run."""

    def __init__(self, study: Study) -> None:
        super().__init__(n_var=len(study.limits), n_obj=2, xl=study.bounds[:, 0], xu=study.bounds[:, 1])
        self.study = study
        self.designs: list[Numbers] = []
        #: greatest wear, worn and new transmission error of each of them
        self.figures: list[Numbers] = []

    def _evaluate(self, x: Numbers, out: dict[str, Numbers], *_: object, **__: object) -> None:
        figures = figures_of(self.study, x)
        self.designs.append(x.copy())
        self.figures.append(figures)
        out["F"] = np.nan_to_num(figures[:, :2], nan=UNUSABLE)


def figures_of(study: Study, designs: Numbers) -> Numbers:
    """Greatest wear anywhere on either flank, and transmission error worn and new, a row for each design."""
    found = study.run(designs, [*DEPTHS, WORN_ERROR, NEW_ERROR])
    return np.column_stack([found[:, : len(DEPTHS)].max(axis=1), found[:, -2], found[:, -1]])


def front(name: str, coarse: Study, fine: Study, runs: int, out: Path) -> None:
    """The front of one pair by NSGA-II on coarse settings, and three designs of it again on the scene's own."""
    start = clocks()
    problem = Life(coarse)
    size = 24 if runs > 100 else 8
    minimize(problem, NSGA2(pop_size=size), ("n_gen", runs // size), seed=1)
    designs, figures = np.concatenate(problem.designs), np.concatenate(problem.figures)
    usable = np.isfinite(figures).all(axis=1)
    designs, figures = designs[usable], figures[usable]
    print(f"{name}: {usable.size} runs, {usable.size - len(designs)} of them without result, {elapsed(start)}")

    names = [key.removeprefix(GEARS) for key in coarse.limits]
    head = ",".join([*names, "greatest_wear_um", "worn_transmission_error_um", "new_transmission_error_um"])
    np.savetxt(out / f"{name}.csv", np.hstack([designs, figures]), delimiter=",", header=head, comments="")

    best = undominated(figures[:, :2])
    chosen = {
        "least wear": best[np.argmin(figures[best, 0])],
        "between": between(figures[:, :2], best),
        "least transmission error, worn": best[np.argmin(figures[best, 1])],
        "least transmission error, new": int(np.argmin(figures[:, 2])),
    }
    rows = np.vstack([np.zeros(len(coarse.limits)), designs[list(chosen.values())]])
    rows[0, [index for index, key in enumerate(coarse.limits) if key.endswith("length_mm")]] = 2.0
    labels = ["no modification", *chosen]
    (plain,) = figures_of(coarse, rows[:1])
    finished = [whole_run(fine, row) for row in rows]
    print("  " + ", ".join(names))
    for label, row, searched, run in zip(labels, rows, [plain, *figures[list(chosen.values())]], finished):
        print(f"  {label}: " + ", ".join(f"{value:.1f}" for value in row))
        print("    " + described(run.summary))
        print("    on the settings of the search " + ", ".join(f"{value:.2f}" for value in searched))

    _, (left, right) = pyplot.subplots(1, 2, figsize=(11, 4.4), layout="constrained")
    draw_front(left, figures, best, chosen, plain)
    for label, colour, run in zip(labels, COLOURS, finished):
        right.plot(run.mesh_cycle.position_mm, run.mesh_cycle.transmission_error_worn_um, color=colour, label=label)
    right.set(xlabel="contact position, mm", ylabel="transmission error at the end of life, µm")
    right.legend(fontsize=8)
    pyplot.savefig(out / f"{name}-front.svg")
    print(f"{name}: {elapsed(start)}")


def whole_run(study: Study, design: Numbers) -> gearwear.Run:
    """The run of one design, with all that a scene has by default, verification too."""
    values = dict(zip(study.limits, design.tolist()))
    each = {key.replace(GEARS, f"pair.{gear}."): value for key, value in values.items() for gear in ("pinion", "wheel")}
    return study.scene.with_(each).run()


def described(summary: dict[str, Any]) -> str:
    """The figures of a whole run, and how far they can be trusted."""
    wear = max(summary[gear][f"{zone}_wear_um"] for gear in ("pinion", "wheel") for zone in ("peak", "tip_edge", "below_sap"))
    worn, new = (summary[state]["transmission_error_um"]["peak_to_peak"] for state in ("worn", "new"))
    total = summary["error"]["total"]
    errors = [*total["peak_wear"].values(), total["transmission_error_peak_to_peak"]]
    stated = ", ".join("?" if error is None else f"{100 * error:.1f} %" for error in errors)
    return f"greatest wear, worn and new transmission error, µm: {wear:.2f}, {worn:.2f}, {new:.2f}; errors of peak wear and worn error {stated}"


def undominated(figures: Numbers) -> list[int]:
    """Rows that no other row beats in one figure without losing in the other, in the order of the first."""
    order = np.lexsort((figures[:, 1], figures[:, 0]))
    kept: list[int] = []
    for index in order:
        if not kept or figures[index, 1] < figures[kept[-1], 1]:
            kept.append(int(index))
    return kept


def between(figures: Numbers, front: list[int]) -> int:
    """The row of the front that is nearest to the best of both figures, each measured by its range over the front."""
    own = figures[front]
    span = np.ptp(own, axis=0)
    away = (own - own.min(axis=0)) / np.where(span > 0, span, 1.0)
    return front[int(np.argmin((away**2).sum(axis=1)))]


def draw_front(axes: Axes, figures: Numbers, best: list[int], chosen: Mapping[str, int], plain: Numbers) -> None:
    """All that was run, and the front among it."""
    axes.scatter(figures[:, 0], figures[:, 1], s=8, color="0.75", label="all runs")
    axes.plot(figures[best, 0], figures[best, 1], color="black", marker=".", linewidth=1, label="front")
    axes.scatter(plain[0], plain[1], marker="x", color=COLOURS[0], label="no modification")
    for colour, (label, index) in zip(COLOURS[1:], chosen.items()):
        axes.scatter(figures[index, 0], figures[index, 1], s=50, color=colour, zorder=3, label=label)
    axes.set(xlabel="greatest wear of either flank, µm", ylabel="transmission error worn, peak to peak, µm")
    axes.legend(fontsize=8)


def main() -> None:
    """The studies that are asked for."""
    parser = argparse.ArgumentParser(description="Modifications that keep a gear pair good until the end of its life.")
    parser.add_argument("studies", nargs="*", help="few-runs, fzg-c, helical; all by default")
    parser.add_argument("--out", type=Path, default=Path("out/optimise"))
    parser.add_argument("--short", action="store_true", help="one seed; fronts of 16 runs with closed-form stiffness, on the settings of the search alone, not verified")
    arguments = parser.parse_args()
    studies = arguments.studies or ["few-runs", "fzg-c", "helical"]
    arguments.out.mkdir(parents=True, exist_ok=True)
    runs = 16 if arguments.short else 240
    quick = {"stiffness.model": "weber-banaschek", "numerics.verify": False, "numerics.error_estimate": False}
    search: dict[str, Any] = SEARCH | (quick if arguments.short else {})
    slices = search | {"helical.coupling": "slicing", "contact.surface": "winkler", "helical.slices": 10, "numerics.positions": 60}
    for study in studies:
        if study == "few-runs":
            few_runs(arguments.out, arguments.short)
        elif study == "fzg-c":
            front(study, fzg_c(**search), fzg_c(**(search if arguments.short else {})), runs, arguments.out)
        elif study == "helical":
            front(study, helical(**slices), helical(**(slices if arguments.short else {})), runs, arguments.out)
        else:
            parser.error(f"studies: found {study}; allowed: few-runs, fzg-c, helical")


if __name__ == "__main__":
    main()
