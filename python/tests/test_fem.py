"""Calibration and finite elements."""

from __future__ import annotations

import json
import pickle
from pathlib import Path

import meshio
import numpy as np
import pytest

import gearwear

ROOT = Path(__file__).parents[2]


def test_finite_elements_at_one_position(tmp_path: Path) -> None:
    scene = gearwear.Scene.preset("fzg-c").with_({"fem.elements_per_half_width": 3})
    pair = scene.fem(14.0, threads=1)
    assert pair.summary["positions"] == 1 and pair.mesh_cycle["position_mm"][0] == 14.0
    # Shares of the whole load add up to 1.
    assert np.isclose(pair.mesh_cycle["load_share"].sum(), 1.0, atol=1e-6)
    again: gearwear.FemPair = pickle.loads(pickle.dumps(pair))
    assert again.summary == pair.summary
    assert again.pressure["pressure_MPa"].tobytes() == pair.pressure["pressure_MPa"].tobytes()
    pair.write(tmp_path)
    assert json.loads((tmp_path / "summary.json").read_text()) == pair.summary
    back = gearwear.FemPair.read(tmp_path)
    for one in (back, pickle.loads(pickle.dumps(back))):
        assert one.summary == pair.summary and list(one.pressure) == list(pair.pressure)
        assert one.mesh_cycle["load_share"].tobytes() == pair.mesh_cycle["load_share"].tobytes()
    text = (ROOT / "meshes" / "cylinder-on-block.toml").read_text().replace("poisson_ratio = 0.3", "poisson_ratio = 3")
    (tmp_path / "wrong.toml").write_text(text)
    with pytest.raises(gearwear.SceneError, match="poisson_ratio: found 3"):
        gearwear.fem_problem(tmp_path / "wrong.toml")
    with pytest.raises(gearwear.RunError, match="outside the path of contact"):
        scene.fem(1.0)


def test_a_problem_of_ones_own(tmp_path: Path) -> None:
    problem = gearwear.fem_problem(ROOT / "meshes" / "cylinder-on-block.toml", progress=lambda stage, part: None)
    # Hertz: NAFEMS R0094, case 1, 3585 MPa.
    assert abs(problem.summary["contact"][0]["peak_pressure_MPa"] / 3585 - 1) < 0.05
    assert problem.summary["elements"] > 0
    problem.write(tmp_path)
    assert json.loads((tmp_path / "summary.json").read_text()) == problem.summary
    # Of the arrays the greatest is the figure.
    assert problem.contact["pressure_MPa"].max() == problem.summary["contact"][0]["peak_pressure_MPa"]
    for back in (gearwear.FemProblem.read(tmp_path), pickle.loads(pickle.dumps(problem))):
        assert back.summary == problem.summary and (back.mesh.points == problem.mesh.points).all()
        assert back.contact["pressure_MPa"].tobytes() == problem.contact["pressure_MPa"].tobytes()
        stress = problem.mesh.point_data["stress_MPa"]
        assert back.mesh.point_data["stress_MPa"].tobytes() == stress.tobytes()


def test_a_problem_as_a_dict() -> None:
    tables = {
        "title": "a square under tension",
        "body": [{"group": "square", "young_modulus_GPa": 200.0, "poisson_ratio": 0.0}],
        "fixed": [{"group": "left", "components": ["x", "y"]}],
        "load": [{"group": "right", "force_N_per_mm": [100.0, 0.0]}],
    }
    mesh = meshio.Mesh(
        np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]),
        [("quad", [[0, 1, 2, 3]]), ("line", [[3, 0], [1, 2]])],
        cell_sets={"square": [[0], []], "left": [[], [0]], "right": [[], [1]]},
    )
    found = gearwear.fem_problem(tables, mesh=mesh)
    assert np.allclose(found.mesh.point_data["stress_MPa"][:, 0], 100.0)
    assert len(found.contact) == 0 or len(found.contact["pressure_MPa"]) == 0


def test_what_is_no_calibration() -> None:
    with pytest.raises(ValueError):
        gearwear.Calibration.from_json("{}")


@pytest.mark.slow
def test_a_calibration_is_used(tmp_path: Path) -> None:
    from short_scenes import spur_scene

    scene = spur_scene().with_({"contact.surface": "winkler", "fem.elements_per_half_width": 3})
    calibration = scene.calibrate()
    assert pickle.loads(pickle.dumps(calibration)) == calibration
    calibration.write(tmp_path / "pair.calibration.json")
    assert gearwear.Calibration.from_file(tmp_path / "pair.calibration.json") == calibration
    calibrated = scene.with_calibration(calibration)
    assert calibrated != scene and pickle.loads(pickle.dumps(calibrated)) == calibrated
    assert calibrated.run().scene.to_dict()["contact"]["calibration"] == "inputs/calibration.json"
