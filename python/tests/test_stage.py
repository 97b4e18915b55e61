"""Planetary stages: runs, what is kept of them, and studies of the whole stage."""

from __future__ import annotations

import copy
import pickle
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import gearwear

#: A stage whose run takes some hundredths of a second.
STAGE = """
[planetary]
planets = 4
load_sharing_factor = 1.2
normal_module_mm = 3.0
pressure_angle_deg = 20.0
centre_distance_mm = 60.0
face_width_mm = 20.0
sun = { teeth = 20, profile_shift = -0.3 }
planet = { teeth = 20, profile_shift = 0.3 }
ring = { teeth = 60, profile_shift = -0.3, tip_diameter_mm = 176.2, cutter = { teeth = 25 } }
[operation]
torque_Nm = 600.0
speed_rpm = 1000.0
hours = 1.0
snapshots_h = [1.0]
[contact]
surface = "hertz-mean"
[stiffness]
model = "constant"
pair_N_per_mm_um = 20.0
[wear]
law = "archard"
coefficient_m2_per_N = 1e-17
[numerics]
verify = false
error_estimate = false
flank_points = 120
positions = 40
"""

K_GAMMA = "planetary.load_sharing_factor"


def stage() -> gearwear.PlanetaryStage:
    return gearwear.PlanetaryStage.from_toml(STAGE)


def test_a_run_has_both_meshes_and_all_flanks(tmp_path: Path) -> None:
    run = stage().run(threads=1)
    summary = run.summary
    assert summary["stopped"] == "completed"
    for flank, of in (
        (run.sun, summary["sun"]),
        (run.planet_sun_flank, summary["planet"]["sun_flank"]),
        (run.planet_ring_flank, summary["planet"]["ring_flank"]),
        (run.ring, summary["ring"]),
    ):
        assert of["peak_wear_um"] == pytest.approx(np.max(flank.wear_um), rel=0.2)
    rows = run.transmission_error
    peak_to_peak = rows["stage_new_um"].max() - rows["stage_new_um"].min()
    assert peak_to_peak == summary["transmission_error"]["new"]["peak_to_peak"]
    assert run.sun_planet.summary == summary["sun_planet"]
    assert "ring" in repr(run)

    run.write(tmp_path / "out", report=False)
    for again in (gearwear.StageRun.read(tmp_path / "out"), pickle.loads(pickle.dumps(run))):
        assert again.summary == summary
        assert np.array_equal(again.ring.wear_um, run.ring.wear_um)
        assert np.array_equal(again.transmission_error["stage_worn_um"], rows["stage_worn_um"])
    assert again.stage == stage()
    with pytest.raises(ValueError, match="run of a planetary stage"):
        gearwear.Run.read(tmp_path / "out")
    kept = stage().run(resume=tmp_path / "kept", threads=1)
    read = stage().run(resume=tmp_path / "kept", threads=1)
    assert kept.planet_ring.summary["pinion"] == read.planet_ring.summary["pinion"] == summary["planet_ring"]["pinion"]


def test_stages_are_values() -> None:
    one = stage()
    other = one.with_({K_GAMMA: 1.0})
    assert one != other
    assert other.with_({K_GAMMA: 1.2}) == one
    assert other.without(K_GAMMA) == other
    assert pickle.loads(pickle.dumps(one)) == one == copy.deepcopy(one)
    assert len({one, stage(), other}) == 2
    assert one.mesh("planet-ring")["pair.wheel.internal"] is True
    with pytest.raises(KeyError, match="sun-planet, planet-ring"):
        one.mesh("sun")  # type: ignore[arg-type]
    with pytest.raises(gearwear.SceneError, match="cannot be assembled"):
        one.with_({"planetary.planets": 3})
    with pytest.raises(AttributeError, match="never changes"):
        one.title = "another"  # type: ignore[misc]


def test_a_sweep_has_the_figures_of_runs() -> None:
    vary: dict[str, object] = {"planetary.planets": [3, 4, 5], K_GAMMA: [1.0, 1.2]}
    found = gearwear.sweep(stage(), vary, outputs=["planetary.planet_clearance_mm"], threads=1)
    assert list(found.failed) == [0, 1]
    run = stage().run(threads=1).summary
    row = found.rows[3]
    assert row["ring.peak_wear_um"] == run["ring"]["peak_wear_um"]
    assert row["planet.sun_flank.peak_wear_um"] == run["planet"]["sun_flank"]["peak_wear_um"]
    assert row["transmission_error.worn.peak_to_peak"] == run["transmission_error"]["worn"]["peak_to_peak"]
    assert row["planetary.planet_clearance_mm"] == run["planetary"]["planet_clearance_mm"]
    with ProcessPoolExecutor(1) as pool:
        elsewhere = gearwear.sweep(stage(), vary, outputs=["planetary.planet_clearance_mm"], executor=pool)
    assert np.array_equal(elsewhere["sun.peak_wear_um"], found["sun.peak_wear_um"], equal_nan=True)
    outputs = ["ring.peak_wear_um", "sun_planet.worn.flank_pressure_MPa"]
    evaluated = gearwear.evaluate(stage(), [K_GAMMA], [[1.2], [9.0]], outputs, threads=1)
    assert evaluated.values[0, 0] == run["ring"]["peak_wear_um"]
    assert evaluated.status[1] is not None and "load_sharing_factor" in evaluated.status[1]


def test_uncertainty_of_a_stage() -> None:
    distributions = {K_GAMMA: "uniform:1:1.3", "wear.coefficient_m2_per_N": "lognormal:1.5"}
    study = gearwear.uncertainty(stage(), distributions, n=16, limits={"sun.peak_wear_um": 0.5}, threads=1)
    assert "transmission_error.worn.peak_to_peak" in study.outputs
    indices = study.indices("ring.peak_wear_um")
    assert indices is not None and indices.total[1] > indices.total[0]
    assert study.quantiles("life.sun.peak_wear_um=0.5")["p50"] is not None
    assert study.band("planet.ring_flank").quantiles_um.shape[0] == 5
    assert len(study.samples["point"]) == 16 * 4
