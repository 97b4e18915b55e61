"""NSGA-II of pymoo against the front of ``gearwear improve``: whether it finds designs that are better than the proposals.

    gearwear improve pair.toml --out study
    python validation/cross-check/improve_nsga2.py study --runs 600 --out improve-nsga2.csv

Designs are run by ``gearwear.evaluate`` on the contact surface of the scene as given. For each proposal p, with the goals y_k that are to be least,

    margin = max over designs q of min over k of (y_k(p) / y_k(q) - 1)

is how much better a design is in all goals together; at most the error of the goals, it is no better. The table has the margins and the least of each goal.
"""

from __future__ import annotations

import argparse
import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
from pymoo.algorithms.moo.nsga2 import NSGA2
from pymoo.core.problem import Problem
from pymoo.optimize import minimize

import gearwear

Numbers = np.ndarray[Any, np.dtype[np.float64]]

#: In place of the goals of a design that cannot be run.
UNUSABLE = 1e3
POPULATION = 40


def free_keys(summary: dict[str, Any]) -> dict[str, tuple[float, float]]:
    """Keys and ends of their ranges; words cannot be searched here."""
    keys = {}
    for one in summary["free"]:
        key, values = one.split(" = ")
        low, high = values.split(" ± ")[0].split(":")
        keys[key] = (float(low), float(high))
    return keys


class Designs(Problem):  # type: ignore[misc]
    """The designs of a study on the scene's own surface."""

    def __init__(self, scene: gearwear.Scene, keys: dict[str, tuple[float, float]], goals: list[str]) -> None:
        low, high = np.array(list(keys.values())).T
        super().__init__(n_var=len(keys), n_obj=len(goals), xl=low, xu=high)
        self.scene, self.keys, self.goals = scene, list(keys), goals
        self.found: list[Numbers] = []

    def _evaluate(self, x: Numbers, out: dict[str, Numbers], *_: Any, **__: Any) -> None:
        values = gearwear.evaluate(self.scene, self.keys, x, self.goals).values
        self.found.append(np.hstack([x, values]))
        out["F"] = np.nan_to_num(values, nan=UNUSABLE)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", type=Path)
    parser.add_argument("--runs", type=int, default=600)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--positions", type=int, help="other than the scene's")
    parser.add_argument("--out", type=Path, required=True)
    asked = parser.parse_args()
    summary = json.loads((asked.study / "summary.json").read_text(encoding="utf-8"))
    text = (asked.study / "scene.toml").read_text(encoding="utf-8").split("[improve]")[0]
    scene = gearwear.Scene.from_toml(text).with_({"numerics.verify": False, "numerics.error_estimate": False})
    if asked.positions:
        scene = scene.with_({"numerics.positions": asked.positions, "numerics.flank_points": 5 * asked.positions // 2})
    keys = free_keys(summary)
    # A key alone would make no scene where the table that it is in needs others.
    goals = [goal["goal"] for goal in summary["goals"]]
    problem = Designs(scene, keys, goals)
    minimize(problem, NSGA2(pop_size=POPULATION), ("n_eval", asked.runs), seed=asked.seed)
    found = np.vstack(problem.found)
    found = found[np.all(np.isfinite(found), axis=1)]
    of_goals = found[:, len(keys) :]
    with asked.out.open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file)
        table.writerow(["proposal", *goals, "error", "margin of NSGA-II", "runs"])
        for proposal in summary["proposals"]:
            figures = {figure["figure"]: figure for figure in proposal["figures"]}
            own = np.array([figures[goal]["value"] for goal in goals])
            errors = [figures[goal]["error"] for goal in goals]
            margin = float(np.max(np.min(own / of_goals - 1.0, axis=1)))
            error = "" if None in errors else f"{max(errors):.4f}"
            table.writerow([proposal["name"], *(f"{value:.4f}" for value in own), error, f"{margin:+.4f}", len(found)])
        table.writerow(["least by NSGA-II", *(f"{value:.4f}" for value in of_goals.min(axis=0)), "", "", len(found)])
    print(asked.out.read_text(encoding="utf-8"))


if __name__ == "__main__":
    main()
