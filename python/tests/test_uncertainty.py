"""Studies of uncertainty: the figures of the command line, as arrays."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from test_sweep import scene

import gearwear

K = "wear.coefficient_m2_per_N"
TORQUE = "operation.pinion_torque_Nm"
UNCERTAIN = {K: "lognormal:1.5", TORQUE: "normal:5%"}
PEAK = "pinion.peak_wear_um"
N = 32


@pytest.fixture(scope="module")
def study() -> gearwear.Uncertainty:
    return gearwear.uncertainty(unverified(), UNCERTAIN, N, 3, limits={PEAK: 0.01}, threads=2)


def unverified() -> gearwear.Scene:
    return scene().with_({"numerics.verify": False})


def test_figures_are_those_of_the_command(study: gearwear.Uncertainty, tmp_path: Path) -> None:
    file, out = tmp_path / "scene.toml", tmp_path / "out"
    file.write_text(unverified().text, encoding="utf-8")
    uncertain = [option for key, given in UNCERTAIN.items() for option in ("--uncertain", f"{key}={given}")]
    numbers = ["--samples", str(N), "--seed", "3", "--limit", f"{PEAK}=0.01"]
    command = [sys.executable, "-m", "gearwear", "uncertainty", str(file), *uncertain, *numbers, "--out", str(out)]
    subprocess.run(command, capture_output=True, check=True)
    study.write(tmp_path / "written")
    assert (tmp_path / "written" / "samples.csv").read_bytes() == (out / "samples.csv").read_bytes()
    written = json.loads((out / "uncertainty.json").read_text(encoding="utf-8"))
    for one in (written, found := dict(study.summary)):
        del one["wall_s"], one["threads"]
    assert found == written
    peak = study.samples[PEAK]
    lines = (out / "samples.csv").read_text(encoding="utf-8").splitlines()
    at = lines[0].split(",").index(PEAK)
    assert peak.tolist() == [float(line.split(",")[at]) for line in lines[1:]]
    assert len(peak) == N * 4


def test_figures_as_arrays(study: gearwear.Uncertainty) -> None:
    """Wear of this model is k T: of independent factors with coefficients of variation a and b, k alone explains a²/((1 + a²)(1 + b²) − 1)."""
    assert study.outputs[0] == PEAK and f"life.{PEAK}=0.01" in study.outputs
    indices = study.indices(PEAK)
    assert indices is not None and indices.factors[:2] == [K, TORQUE]
    assert indices.first.shape == (len(indices.factors),) and indices.total_interval.shape == (len(indices.factors), 2)
    a_2, b_2 = np.expm1(np.log(1.5) ** 2), 0.05**2
    of_both = (1 + a_2) * (1 + b_2) - 1
    for intervals, exact in [
        (indices.first_interval, [a_2 / of_both, b_2 / of_both]),
        (indices.total_interval, [1 - b_2 / of_both, 1 - a_2 / of_both]),
    ]:
        assert (intervals[:, 0] < exact).all() and (exact < intervals[:, 1]).all()
    samples = study.samples
    of_a_and_b = [matrix in ("A", "B") for matrix in samples["matrix"]]
    peaks = np.sort(samples[PEAK][of_a_and_b])
    quantiles = study.quantiles(PEAK)
    known = [value for value in quantiles.values() if value is not None]
    assert list(quantiles) == ["p05", "p25", "p50", "p75", "p95"]
    assert len(known) == 5 and np.all(np.diff([peaks[0], *known, peaks[-1]]) > 0)
    band = study.band("pinion")
    assert band.quantiles_um.shape == (5, len(band.radius_mm)) and (np.diff(band.quantiles_um, axis=0) >= 0).all()
    with pytest.raises(KeyError, match="pinion, wheel"):
        study.band("rack")
    with pytest.raises(KeyError, match=PEAK):
        study.output("pinion.peak")


def test_correlated_keys(study: gearwear.Uncertainty) -> None:
    found = gearwear.uncertainty(unverified(), UNCERTAIN, 8, correlation={(K, TORQUE): 0.5}, outputs=[PEAK])
    assert found.outputs == [PEAK] and found.indices(PEAK) is None
    assert "correlated" in found.output(PEAK)["no_indices_because"]
    assert found.summary["correlation"] == [[1.0, 0.5], [0.5, 1.0]]


def test_what_is_wrong_is_named() -> None:
    with pytest.raises(ValueError, match="pair.face_widht_mm"):
        gearwear.uncertainty(scene(), {"pair.face_widht_mm": "±1%"}, 8)
    with pytest.raises(ValueError, match="allowed: KEY=DISTRIBUTION|normal:MEAN:SD"):
        gearwear.uncertainty(scene(), {K: "gamma:1:2"}, 8)
    with pytest.raises(ValueError, match=r"pinion.peek_wear_um.*did you mean pinion.peak_wear_um"):
        gearwear.uncertainty(scene(), {K: "±40%"}, 8, outputs=["pinion.peek_wear_um"])
    with pytest.raises(ValueError, match="found 1000000 samples"):
        gearwear.uncertainty(scene(), {K: "±40%"}, 1_000_000)
    with pytest.raises(ValueError, match="found 0 keys"):
        gearwear.uncertainty(scene(), {}, 8)
    with pytest.raises(ValueError, match="n: found 1; allowed: a whole number from 2"):
        gearwear.uncertainty(scene(), {K: "±40%"}, 1)
    with pytest.raises(gearwear.RunError, match="cannot be run"):
        gearwear.uncertainty(
            scene().with_({"wear.coefficient_m2_per_N": 1e-9}), {TORQUE: "±1%"}, 2, outputs=[PEAK]
        )
