"""Studies that are read as the record of their command."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_sweep import scene

import gearwear

#: A case of one short run.
CASE = """
title = "a case"
group = "mine"
kind = "code-verification"
tier = "smoke"
requirement = "The pair has the base pitch of its module."

[[run]]
name = "short"
scene = "thesis-spur"
unset = ["operation.hours", "operation.snapshots_h"]
set = { "operation.pinion_revolutions" = 1.0, "numerics.step" = { revolutions = 1.0 }, "numerics.error_estimate" = false, "numerics.positions" = 40, "numerics.flank_points" = 100 }

[[quantity]]
name = "base pitch"
unit = "mm"
value = "short.summary.geometry.base_pitch_mm"
near = "PI() * 4.5 * cos(PI() / 9)"
within = { relative = 1e-12 }
source = "ISO 21771"
discretisation = { relative = 1e-12 }
"""


@pytest.fixture(scope="module")
def run() -> gearwear.Run:
    return scene().with_({"numerics.verify": False, "numerics.error_estimate": False}).run(threads=1)


def test_a_measured_profile(run: gearwear.Run, tmp_path: Path) -> None:
    """The run's own wear, 1.3 times as deep, is that of 1.3 k: this model's wear does not change what makes it."""
    radius, wear = run.pinion.radius_mm, run.pinion.wear_um
    worn = wear > 0.0
    measured = tmp_path / "measured.csv"
    rows = "".join(f"{r!r},{1.3 * w!r}\n" for r, w in zip(radius[worn].tolist(), wear[worn].tolist(), strict=True))
    measured.write_text(f"# gear = pinion\nradius_mm,wear_um\n{rows}")
    study = gearwear.compare(run, measured, shift_within_mm=0.0, threads=1)
    fitted = study.summary["fit"]["coefficient_m2_per_N"]
    assert fitted["value"] == pytest.approx(1.3 * fitted["of_run"], rel=0.01)
    study.write(tmp_path / "out")
    assert json.loads((tmp_path / "out" / "compare.json").read_text(encoding="utf-8")) == study.summary
    with pytest.raises(ValueError, match="fit: found 'speed'|fit: found \"speed\"; allowed: none, k, each, severe, both"):
        gearwear.compare(run, measured, fit="speed")
    with pytest.raises(ValueError, match="gear: found .*wheel"):
        gearwear.compare(run, measured, gear="wheel")
    with pytest.raises(FileNotFoundError):
        gearwear.compare(run, tmp_path / "nothing.csv")


def test_measured_profiles_of_both_gears(run: gearwear.Run, tmp_path: Path) -> None:
    """1.3 times the pinion's wear and 0.9 times the wheel's, with scatter, are those of 1.3 and 0.9 times the coefficient."""
    files = []
    noise = np.random.default_rng(1)
    for flank, name, factor in [(run.pinion, "pinion", 1.3), (run.wheel, "wheel", 0.9)]:
        worn = flank.wear_um > 0.0
        depth = factor * flank.wear_um[worn]
        depth += noise.normal(0.0, 0.02 * depth.max(), depth.size)
        rows = "".join(f"{r!r},{w!r}\n" for r, w in zip(flank.radius_mm[worn].tolist(), depth.tolist(), strict=True))
        files.append(tmp_path / f"{name}.csv")
        files[-1].write_text(f"# gear = {name}\nradius_mm,wear_um\n{rows}")
    fit = gearwear.compare(run, files, shift_within_mm=0.0, threads=1).summary["fit"]
    for own, name, factor in zip(fit["coefficients"], ["pinion", "wheel"], [1.3, 0.9], strict=True):
        assert own["gear"] == name and own["factor"]["value"] == pytest.approx(factor, rel=0.03)
    assert fit["correlation"]["parameters"] == ["k.pinion", "k.wheel"]
    assert np.array(fit["correlation"]["matrix"]).shape == (2, 2)
    with pytest.raises(ValueError, match="different gears"):
        gearwear.compare(run, [files[0], files[0]])
    with pytest.raises(ValueError, match="measured: found no profile"):
        gearwear.compare(run, [])


def test_profiles_as_arrays_and_frames(run: gearwear.Run, tmp_path: Path) -> None:
    """The same as from files, to the bit."""
    pandas = pytest.importorskip("pandas")
    columns: dict[str, dict[str, Any]] = {}
    for flank, name, factor in [(run.pinion, "pinion", 1.3), (run.wheel, "wheel", 0.9)]:
        worn = flank.wear_um > 0.0
        columns[name] = {"radius_mm": flank.radius_mm[worn], "height_um": -factor * flank.wear_um[worn]}
        rows = "".join(f"{r!r},{h!r}\n" for r, h in zip(*(values.tolist() for values in columns[name].values()), strict=True))
        (tmp_path / f"{name}.csv").write_text(f"# gear = {name}\n# hours = 1.0\nradius_mm,height_um\n{rows}")
    timed = {name: {"hours": 1.0, **values} for name, values in columns.items()}
    framed = [pandas.DataFrame({"gear": name, **values}) for name, values in columns.items()]
    options: dict[str, Any] = {"form": "none", "shift_within_mm": 0.0, "threads": 1}
    expected = gearwear.compare(run, [tmp_path / "pinion.csv", tmp_path / "wheel.csv"], **options).summary["fit"]
    assert gearwear.compare(run, timed, **options).summary["fit"] == expected
    frames = {name: frame.drop(columns="gear") for name, frame in zip(columns, framed, strict=True)}
    study = gearwear.compare(run, frames, **options)
    assert study.summary["fit"] == expected
    assert len(study.to_pandas()["compare"]) == sum(len(frame) for frame in frames.values())
    one = gearwear.compare(run, columns["pinion"], gear="pinion", **options)
    assert one.summary["fit"] == gearwear.compare(run, {"pinion": columns["pinion"]}, **options).summary["fit"]
    radius = columns["pinion"]["radius_mm"]
    for wrong, said in [
        ({"pinion": {"radius_mm": radius, "height_um": radius[1:]}}, "pinion: found .* of radius_mm, .* of height_um; allowed: as many"),
        ({"pinion": {"radius_mm": radius, "height_um": np.ones((2, 2))}}, "height_um: found an array of 2 dimensions"),
        ({"radius_mm": radius, "heights_um": radius}, "measured: .*height_um"),
    ]:
        with pytest.raises(ValueError, match=said):
            gearwear.compare(run, wrong)
    with pytest.raises(TypeError, match="measured: found int"):
        gearwear.compare(run, 3)


def test_remaining_life(run: gearwear.Run, tmp_path: Path) -> None:
    """Masses of 1.3 times the coefficient of the run, with a tenth of scatter at most: k lies in its interval, and what is left is as long."""
    end = run.summary["revolutions"]
    mass_g = 1e-3 * run.summary["pinion"]["worn_mass_mg"]
    revolutions = end * np.array([0.2, 0.4, 0.6])
    masses = 1.3 * mass_g * np.array([0.2, 0.4, 0.6]) * np.array([1.04, 0.97, 1.02])
    table = {"gear": "pinion", "revolutions": revolutions, "mass_loss_g": masses}
    options: dict[str, Any] = {"limit": {"pinion.worn_mass_mg": 1.3e3 * mass_g}, "threads": 1}
    study = gearwear.remaining_life(run, table, **options)
    [pinion] = study.summary["gears"]
    last = pinion["updates"][-1]
    k = last["coefficient_m2_per_N"]
    assert k["low"] < 1.3 * pinion["coefficient_of_run_m2_per_N"] < k["high"]
    left = last["life"]["remaining_revolutions"]
    assert left["low"] < 0.4 * end < left["high"] and left["median"] == pytest.approx(0.4 * end, rel=0.25)
    total = last["life"]["total_revolutions"]
    assert total["median"] == pytest.approx(0.6 * end + left["median"]) and total["low"] < end < total["high"]
    assert study.summary["other_gear"]["gear"] == "wheel"
    wheel = gearwear.remaining_life(run, table, other_k=5e-18, **options).summary["other_gear"]
    assert wheel["source"] == "given" and wheel["coefficient_m2_per_N"] == pytest.approx(5e-18)
    study.write(tmp_path / "out")
    assert json.loads((tmp_path / "out" / "remaining_life.json").read_text(encoding="utf-8")) == study.summary
    assert gearwear.Study.read(tmp_path / "out").summary == study.summary
    rows = study.tables["predictions"]
    assert len(rows["found"]) == 6
    file = tmp_path / "weighed.csv"
    lines = "".join(f"{n!r};{m!r}\n" for n, m in zip(revolutions.tolist(), masses.tolist(), strict=True))
    file.write_text(f"# gear = pinion\nrevolutions;mass_loss_g\n{lines}", encoding="utf-8")
    assert gearwear.remaining_life(run, file, **options).summary["gears"] == study.summary["gears"]
    known = gearwear.remaining_life(run, file, prior=(1e-17, 2e-17), threads=1).summary["gears"][0]
    assert known["prior"]["high_m2_per_N"] == 2e-17 and known["updates"][-1]["life"] is None
    refused: list[tuple[dict[str, Any], str]] = [
        ({"limit": {"pinion.root_wear_um": 1.0}}, "limit: found .*pinion.peak_wear_um"),
        ({"prior": "wet"}, "prior: found .*wet.*regime-2"),
        ({"gear": "wheel"}, "line 3: gear: found pinion"),
        ({"limit": {"wheel.peak_wear_um": 1.0}}, "a figure of a measured gear: pinion.peak_wear_um"),
    ]
    for wrong, said in refused:
        with pytest.raises(ValueError, match=said):
            gearwear.remaining_life(run, file, **wrong)
    with pytest.raises(ValueError, match="table: line 2: column: found depth; allowed: revolutions, hours"):
        gearwear.remaining_life(run, {"gear": "pinion", "hours": [1.0], "depth": [1.0]})
    with pytest.raises(TypeError, match="table: found int"):
        gearwear.remaining_life(run, 3)


def test_runs_side_by_side(run: gearwear.Run, tmp_path: Path) -> None:
    run.write(tmp_path / "run")
    study = gearwear.compare_runs({"one": run, "other": tmp_path / "run"})
    assert [one["name"] for one in study.summary["runs"]] == ["one", "other"]
    study.write(tmp_path / "out")
    assert (tmp_path / "out" / "variants.csv").exists()
    with pytest.raises(ValueError, match="found 1 runs; allowed: two or more"):
        gearwear.compare_runs({"one": run})
    with pytest.raises(ValueError, match="cannot be read"):
        gearwear.compare_runs({"one": run, "none": tmp_path / "none"})


def test_validation(tmp_path: Path) -> None:
    case = tmp_path / "mine"
    case.mkdir()
    (case / "case.toml").write_text(CASE)
    study = gearwear.validate([case], threads=1)
    assert [(one["name"], one["failure"]) for one in study.summary["cases"]] == [("mine", None)]
    [quantity] = [one for one in study.summary["cases"][0]["quantities"] if one["name"] == "base pitch"]
    assert quantity["value"] == pytest.approx(np.pi * 4.5 * np.cos(np.pi / 9), rel=1e-12)
    study.write(tmp_path / "out")
    assert (tmp_path / "out" / "junit.xml").exists()
    with pytest.raises(ValueError, match="no-such-case"):
        gearwear.validate(["no-such-case"])
    with pytest.raises(ValueError, match='tier: found "quick"; allowed: smoke, full, long'):
        gearwear.validate([], "quick")


def test_accuracy_refuses_what_is_no_share() -> None:
    with pytest.raises(ValueError, match="within: found 5; allowed: a share above 0 and at most 1"):
        scene().accuracy(within=5)


@pytest.mark.slow
def test_accuracy(tmp_path: Path) -> None:
    coarse = gearwear.Scene.preset("thesis-spur").with_(
        {
            "numerics.flank_points": 160,
            "numerics.positions": 80,
            "numerics.step": {"revolutions": 100000.0},
            "pair.pinion.tip_rounding_mm": 0.2,
            "pair.wheel.tip_rounding_mm": 0.2,
            "fem.elements_per_half_width": 3,
        }
    )
    study = coarse.accuracy(quick=True)
    assert study.summary["recommendations"] and study.summary["stopped"] == "completed"
    study.write(tmp_path)
    assert json.loads((tmp_path / "accuracy.json").read_text(encoding="utf-8")) == study.summary


def test_better_designs(tmp_path: Path) -> None:
    """A wider gear wears less: the proposal is the widest that is allowed, and its study is read again from its folder."""
    coarse = scene().with_({"numerics.verify": False, "numerics.error_estimate": False})
    study = gearwear.improve(
        coarse, free=["pair.face_width_mm = 10:20"], goals=["pinion.peak_wear_um"], evaluations=24, out=tmp_path / "out", threads=2
    )
    (proposal,) = study.summary["proposals"]
    assert proposal["values"] == [{"key": "pair.face_width_mm", "value": "20", "edge": "upper"}]
    assert (tmp_path / "out" / proposal["file"]).exists()
    assert gearwear.Study.read(tmp_path / "out").summary == study.summary
    with pytest.raises(gearwear.SceneError, match="improve.goals"):
        gearwear.improve(coarse, goals=["pinion.peak_ware_um"])
