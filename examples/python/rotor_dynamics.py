"""Mesh stiffness over the rotation of the pinion, for models of rotors and drive lines (docs/outputs.md).

    pip install ./python opentorsion scipy
    python examples/python/rotor_dynamics.py --out out/rotor-dynamics

Writes ``mesh_stiffness.csv``, one pitch of the new and of the worn pair; prints the natural frequency of the pair alone in
closed form and in a drive line by openTorsion, and how much the load of the teeth swings about its mean at speeds around the resonance.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import opentorsion
from scipy.interpolate import CubicSpline

import gearwear

Numbers = np.ndarray[Any, np.dtype[np.float64]]

#: kg·m², of pinion and wheel with what turns with them: assumptions of this example.
INERTIA = (2.0e-3, 8.0e-3)
#: Stiffness of the shafts to both machines, N·m/rad, and inertia of each, kg·m²: assumptions.
SHAFT, MACHINE = 2.0e4, 0.5
#: Damping over critical damping of the mesh, an assumption too.
DAMPING = 0.07
#: Steps in a pitch, and pitches until what is left of the beginning is small.
STEPS, PITCHES = 400, 40
#: Speeds over that of resonance.
SPEEDS = (0.25, 0.35, 0.5, 0.7, 0.9, 1.0, 1.1, 1.3)


@dataclass(frozen=True)
class Mesh:
    """A pair under a constant load, over one pitch of the pinion."""

    #: Rotation of the pinion, rad, evenly spaced, both ends of the pitch.
    rotation: Numbers
    #: dF/dδ of the whole face width, N/m.
    stiffness: Numbers
    #: δ, m: approach along the line of action where nothing swings.
    transmission_error: Numbers
    #: F, N, in the direction of the line of action.
    load: float
    #: Base radii of pinion and wheel, m.
    radius: tuple[float, float]

    @staticmethod
    def of(run: gearwear.Run, scene: gearwear.Scene, state: str) -> Mesh:
        """The ``new`` or the ``worn`` pair."""
        cycle, gears = run.mesh_cycle, run.summary["geometry"]["gears"]
        width_mm = scene.to_dict()["pair"]["face_width_mm"]
        rotation = np.radians(cycle["pinion_rotation_deg"])
        pitch = np.linspace(rotation[0], rotation[0] + 2.0 * np.pi / gears["pinion"]["teeth"], 201)
        # N/(mm·µm) times mm is N/µm.
        stiffness = 1.0e6 * width_mm * np.interp(pitch, rotation, cycle[f"mesh_stiffness_{state}_N_per_mm_um"])
        error = 1.0e-6 * np.interp(pitch, rotation, cycle[f"transmission_error_{state}_um"])
        # One pitch later all is as before.
        stiffness[-1], error[-1] = stiffness[0], error[0]
        load = width_mm * run.summary["contact"]["line_load_N_per_mm"]
        pinion, wheel = (0.5e-3 * gears[gear]["base_diameter_mm"] for gear in ("pinion", "wheel"))
        return Mesh(pitch - pitch[0], stiffness, error, load, (pinion, wheel))

    @property
    def mass(self) -> float:
        """1/m = r₁²/J₁ + r₂²/J₂, kg."""
        return 1.0 / sum(radius**2 / inertia for radius, inertia in zip(self.radius, INERTIA, strict=True))

    @property
    def natural_frequency(self) -> float:
        """√(k/m) of the mean stiffness, 1/s."""
        return float(np.sqrt(self.stiffness[:-1].mean() / self.mass))

    def by_opentorsion(self) -> float:
        """The same with the drive line, by openTorsion, whose stiffness of a gear is a torque on the first of a pair over its rotation."""
        stiffness = self.stiffness[:-1].mean() * self.radius[0] ** 2
        pinion = opentorsion.ElasticGear(1, I=INERTIA[0], R=1.0e3 * self.radius[0])
        wheel = opentorsion.ElasticGear(2, I=INERTIA[1], R=1.0e3 * self.radius[1], k=stiffness, c=0.0, parent=pinion)
        shafts = [opentorsion.Shaft(node, node + 1, k=SHAFT) for node in (0, 2)]
        machines = [opentorsion.Disk(node, I=MACHINE) for node in (0, 3)]
        line = opentorsion.Assembly(shafts, disk_elements=machines, elastic_gear_elements=[pinion, wheel])
        squares = np.linalg.eigvals(np.linalg.solve(line.M, line.K))
        return float(np.sqrt(squares.real.max()))

    def swing(self, speeds: Numbers) -> Numbers:
        """Greatest load over the mean one at ``speeds`` of the pinion, rad/s, once the beginning has died away.

        About the load that the stiffness belongs to, with x the approach beyond the transmission error δ(φ) that the run found,
        m x″ + c x′ + k(φ) x = −m δ″(φ) − c δ′(φ); over φ, by the classical method of Runge and Kutta for all speeds at once.
        """
        pitch, mass = self.rotation[-1], self.mass * speeds**2
        damping = 2.0 * DAMPING * np.sqrt(self.mass * self.stiffness.mean()) * speeds
        step = pitch / STEPS
        # At the ends and in the middles of the steps of one pitch.
        angle = np.linspace(0.0, pitch, 2 * STEPS + 1)
        stiffness = CubicSpline(self.rotation, self.stiffness, bc_type="periodic")(angle)
        error = CubicSpline(self.rotation, self.transmission_error, bc_type="periodic")
        first, second = error(angle, 1), error(angle, 2)

        def change(state: Numbers, at: int) -> Numbers:
            along, rate = state
            return np.stack([rate, -second[at] - (damping * (first[at] + rate) + stiffness[at] * along) / mass])

        state, greatest = np.zeros((2, speeds.size)), np.zeros(speeds.size)
        for turn in range(PITCHES):
            for at in range(0, 2 * STEPS, 2):
                one = change(state, at)
                two = change(state + 0.5 * step * one, at + 1)
                three = change(state + 0.5 * step * two, at + 1)
                four = change(state + step * three, at + 2)
                state = state + step / 6.0 * (one + 2.0 * two + 2.0 * three + four)
                if turn >= 0.8 * PITCHES:
                    greatest = np.maximum(greatest, stiffness[at + 2] * state[0] + damping * state[1])
        return 1.0 + greatest / self.load


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/rotor-dynamics"))
    folder: Path = parser.parse_args().out
    folder.mkdir(parents=True, exist_ok=True)

    scene = gearwear.Scene.preset("fzg-c").with_(**{"numerics.positions": 400})
    run = scene.run()
    new, worn = Mesh.of(run, scene, "new"), Mesh.of(run, scene, "worn")
    columns = np.column_stack([np.degrees(new.rotation), new.stiffness, worn.stiffness])
    header = "pinion_rotation_deg,mesh_stiffness_new_N_per_m,mesh_stiffness_worn_N_per_m"
    np.savetxt(folder / "mesh_stiffness.csv", columns, fmt="%.6g", delimiter=",", header=header, comments="")

    print(f"mean mesh stiffness  {new.stiffness.mean():.3e} N/m new, {worn.stiffness.mean():.3e} N/m worn")
    of_pair, of_line = (frequency / (2.0 * np.pi) for frequency in (new.natural_frequency, new.by_opentorsion()))
    print(f"natural frequency    {of_pair:.0f} Hz of the pair alone, {of_line:.0f} Hz in the drive line by openTorsion")
    resonance = new.natural_frequency * new.rotation[-1] / (2.0 * np.pi)
    print(f"resonance            {resonance * 30.0 / np.pi:.0f} rpm of the pinion")
    print("speed over that      greatest load over its mean, new and worn")
    speeds = resonance * np.array(SPEEDS)
    for part, of_new, of_worn in zip(SPEEDS, new.swing(speeds), worn.swing(speeds), strict=True):
        print(f"{part:20.2f} {of_new:10.3f} {of_worn:10.3f}")


if __name__ == "__main__":
    main()
