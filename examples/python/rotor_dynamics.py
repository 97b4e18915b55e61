"""Mesh stiffness over the rotation of the pinion, for models of rotors and drive lines (docs/rotor-dynamics.md).

    pip install ./python opentorsion scipy
    python examples/python/rotor_dynamics.py --out out/rotor-dynamics

Writes ``mesh_stiffness.csv``, one pitch of the new and of the worn pair; prints the natural frequency of the pair on free shafts, by
openTorsion and in closed form, and how much the load of the teeth swings about its mean at speeds around the resonance.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import opentorsion
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

import gearwear

Numbers = np.ndarray[Any, np.dtype[np.float64]]

#: kg·m², of pinion and wheel with what turns with them: assumptions of this example.
INERTIA = (2.0e-3, 8.0e-3)
#: Damping over critical damping of the mesh, an assumption too.
DAMPING = 0.07
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
        """The same by openTorsion, whose stiffness is a torque on the first gear over its rotation."""
        stiffness = self.stiffness[:-1].mean() * self.radius[0] ** 2
        pinion = opentorsion.ElasticGear(0, I=INERTIA[0], R=1.0e3 * self.radius[0])
        wheel = opentorsion.ElasticGear(1, I=INERTIA[1], R=1.0e3 * self.radius[1], k=stiffness, c=0.0, parent=pinion)
        assembly = opentorsion.Assembly([], elastic_gear_elements=[pinion, wheel])
        squares = np.linalg.eigvals(np.linalg.solve(assembly.M, assembly.K))
        return float(np.sqrt(squares.real.max()))

    def swing(self, speed: float) -> float:
        """Greatest load over the mean one at a ``speed`` of the pinion in rad/s, once the beginning has died away.

        About the load that the stiffness belongs to, with x the approach beyond the transmission error δ(φ) that the run found,
        m x″ + c x′ + k(φ) x = −m δ″(φ) − c δ′(φ).
        """
        pitch = self.rotation[-1]
        stiffness = CubicSpline(self.rotation, self.stiffness, bc_type="periodic")
        error = CubicSpline(self.rotation, self.transmission_error, bc_type="periodic")
        damping = 2.0 * DAMPING * np.sqrt(self.mass * self.stiffness.mean())

        def motion(time: float, state: Numbers) -> list[float]:
            angle = (speed * time) % pitch
            along, rate = state
            excited = -self.mass * speed**2 * error(angle, 2) - damping * speed * error(angle, 1)
            return [rate, (excited - damping * rate - stiffness(angle) * along) / self.mass]

        periods = 40
        end = periods * pitch / speed
        times = np.linspace(0.8 * end, end, 1600)
        solved = solve_ivp(motion, (0.0, end), [0.0, 0.0], t_eval=times, max_step=pitch / speed / 40.0, rtol=1e-6)
        along, rate = solved.y
        dynamic = stiffness((speed * times) % pitch) * along + damping * rate
        return float(1.0 + dynamic.max() / self.load)


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
    print(f"natural frequency    {new.natural_frequency / (2.0 * np.pi):.1f} Hz, by openTorsion {new.by_opentorsion() / (2.0 * np.pi):.1f} Hz")
    resonance = new.natural_frequency * new.rotation[-1] / (2.0 * np.pi)
    print(f"resonance            {resonance * 30.0 / np.pi:.0f} rpm of the pinion")
    print("speed over that      greatest load over its mean, new and worn")
    for part in SPEEDS:
        print(f"{part:20.2f} {new.swing(part * resonance):10.3f} {worn.swing(part * resonance):10.3f}")


if __name__ == "__main__":
    main()
