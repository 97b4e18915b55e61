"""What comes out goes in again: folders, pickles, values of a table, arrays."""

from __future__ import annotations

import multiprocessing
import pickle
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from short_scenes import spur_scene
from test_sweep import LINUX, RELIEF, TORQUE, VARY, die_once, scene, timeless
from test_uncertainty import K, PEAK, unverified

import gearwear
from gearwear import executors

ROOT = Path(__file__).parents[2]

pytestmark = pytest.mark.filterwarnings("ignore:operation.pinion_torque_Nm")


def same_table(one: gearwear.Table, other: gearwear.Table) -> bool:
    """Columns, kinds, units, meanings and every bit."""
    if list(one) != list(other) or one.units != other.units or one.meanings != other.meanings:
        return False
    return all(one[name].dtype == other[name].dtype and one[name].tobytes() == other[name].tobytes() for name in one)


@pytest.mark.parametrize("name", ["spur", "helical"])
def test_a_run_from_its_folder(name: str, request: pytest.FixtureRequest, tmp_path: Path) -> None:
    run: gearwear.Run = request.getfixturevalue(name)
    run.write(tmp_path / "run", workbook=True, series=True, figures=tmp_path / "figures")
    back = gearwear.Run.read(tmp_path / "run")
    assert back._native.to_bytes() == run._native.to_bytes()
    assert back.summary == run.summary and back.scene == run.scene and same_table(back.profiles, run.profiles)
    assert (tmp_path / "run" / "results.xlsx").exists() and (tmp_path / "run" / "flank.pvd").exists()
    assert {path.stem for path in (tmp_path / "figures").iterdir()} == set(run.figures())
    back.write(tmp_path / "run", report=False)
    assert not (tmp_path / "run" / "report.html").exists() and not (tmp_path / "run" / "results.xlsx").exists()


def test_a_run_of_the_command(tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(spur_scene().text)
    command = [sys.executable, "-m", "gearwear", "run", "--quiet", str(tmp_path / "scene.toml"), "--out", str(tmp_path / "out")]
    subprocess.run(command, check=True)
    run = gearwear.Run.read(tmp_path / "out")
    run.write(tmp_path / "again")
    # The page of the command was written before its own time was known.
    for file in sorted({path.name for path in (tmp_path / "out").iterdir()} - {"report.html"}):
        assert (tmp_path / "out" / file).read_bytes() == (tmp_path / "again" / file).read_bytes(), file
    assert run.pinion.wear_um.tobytes() == spur_scene().run().pinion.wear_um.tobytes()


def test_folders_that_are_none(spur: gearwear.Run, tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        gearwear.Run.read(tmp_path / "none")
    (tmp_path / "file").touch()
    with pytest.raises(NotADirectoryError):
        gearwear.Run.read(tmp_path / "file")
    with pytest.raises(ValueError, match="no file of a run or a study among its 1; allowed: the folder of a run"):
        gearwear.Run.read(tmp_path)
    spur.write(tmp_path / "run")
    with pytest.raises(ValueError, match="that of a run, which gearwear.Run.read reads; allowed: the folder of a sweep"):
        gearwear.Sweep.read(tmp_path / "run")
    with pytest.raises(ValueError, match="allowed: the folder of a study of accuracy, a comparison"):
        gearwear.Study.read(tmp_path / "run")
    record = tmp_path / "run" / "record.bin"
    whole = record.read_bytes()
    for damaged, said in [
        (whole[:-1], "incomplete"),
        (whole[:-1] + bytes([whole[-1] ^ 1]), "damaged"),
        (whole.replace(b'"program_version":"', b'"program_version":"9', 1), "written by gearwear 9"),
        (b"nothing", "not that of a record"),
    ]:
        record.write_bytes(damaged)
        with pytest.raises(ValueError, match=said):
            gearwear.Run.read(tmp_path / "run")
    record.write_bytes(whole)
    summary = tmp_path / "run" / "summary.json"
    summary.write_text(summary.read_text(encoding="utf-8").replace("FZG", "ZFG", 1), encoding="utf-8")
    with pytest.raises(ValueError, match="another run"):
        gearwear.Run.read(tmp_path / "run")
    summary.unlink()
    with pytest.raises(ValueError, match="not finished"):
        gearwear.Run.read(tmp_path / "run")


def test_a_study_of_uncertainty_from_its_folder(tmp_path: Path) -> None:
    study = gearwear.uncertainty(unverified(), {K: "lognormal:1.5", TORQUE: "normal:5%"}, 16)
    study.write(tmp_path / "out")
    for back in (gearwear.Uncertainty.read(tmp_path / "out"), pickle.loads(pickle.dumps(study))):
        assert back.summary == study.summary and same_table(back.samples, study.samples)
        assert back.band("wheel").quantiles_um.tobytes() == study.band("wheel").quantiles_um.tobytes()
        back.write(tmp_path / "again")
        for file in (tmp_path / "out").iterdir():
            assert file.read_bytes() == (tmp_path / "again" / file.name).read_bytes(), file.name


class Frozen:
    """A distribution with its parameters as ``scipy.stats`` freezes it."""

    def __init__(self, name: str, *args: float, **kwds: float) -> None:
        self.dist = type("Distribution", (), {"name": name})
        self.args, self.kwds = args, kwds


def test_distributions_of_scipy() -> None:
    def uncertain(distribution: Any) -> Any:
        return gearwear.uncertainty(unverified(), {TORQUE: distribution}, 4, outputs=[PEAK]).summary["uncertain"][0]

    assert uncertain(Frozen("norm", 250, scale=10.0))["given"] == "normal:250.0:10.0"
    assert uncertain(Frozen("uniform", loc=200, scale=100))["high"] == 300.0
    assert uncertain(Frozen("triang", 0.25, 200, 100))["mode"] == 225.0
    of_scipy = uncertain(Frozen("lognorm", s=np.log(1.5), scale=250))
    assert of_scipy["median"] == 250.0 and of_scipy["factor"] == pytest.approx(1.5, rel=1e-15)
    with pytest.raises(TypeError, match="found gamma; allowed: a text such as .*lognorm"):
        uncertain(Frozen("gamma", 2.0))
    with pytest.raises(ValueError, match="lognorm with loc=1.0; allowed: loc=0"):
        uncertain(Frozen("lognorm", 0.5, 1.0))
    stats = pytest.importorskip("scipy.stats", reason="SciPy is not here: its own distributions are NOT tested")
    assert uncertain(stats.norm(250, 10))["mean"] == 250.0


def test_a_sweep_from_its_folder(tmp_path: Path) -> None:
    outputs = ["geometry.transverse_contact_ratio", PEAK]
    found = gearwear.sweep(scene(), {**VARY, "contact.surface": ["hertz-mean", "hertz"]}, out=tmp_path, outputs=outputs)
    back = gearwear.Sweep.read(tmp_path)
    assert same_table(back, found) and back.summary == found.summary
    assert list(found).count(PEAK) == 1 and back[outputs[0]][-1] == found.rows[-1][outputs[0]]
    values = gearwear.evaluate(scene(), [TORQUE, RELIEF], [[302.0, 0.15]], [outputs[0], "peak_wear_um"])
    rows = found["contact.surface"] == "hertz-mean"
    assert values[outputs[0]][0] == found[outputs[0]][rows][-1]
    assert values["peak_wear_um"][0] == found["peak_wear_um"][rows][-1]
    with pytest.raises(ValueError, match=r"unknown output pinion.peek_wear_um.*did you mean"):
        gearwear.sweep(scene(), VARY, outputs=["pinion.peek_wear_um"])


def test_a_run_is_kept_and_goes_on(tmp_path: Path) -> None:
    """Of a killed process, to the same bits; the folder of another scene is left alone."""
    slow = spur_scene().with_({"numerics.step": {"revolutions": 5.0}, "operation.pinion_revolutions": 60000})
    (tmp_path / "scene.toml").write_text(slow.text)
    code = "import sys, gearwear; gearwear.Scene.from_file(sys.argv[1]).run(resume=sys.argv[2], threads=1)"
    out = tmp_path / "out"
    process = subprocess.Popen([sys.executable, "-c", code, str(tmp_path / "scene.toml"), str(out)])
    try:
        while not (out / "checkpoint.bin").exists() and process.poll() is None:
            pass
    finally:
        process.kill()
        process.wait()
    assert (out / "checkpoint.bin").exists(), "the run is too short for this test"
    run = slow.run(resume=out)
    assert not (out / "checkpoint.bin").exists()
    assert run.pinion.wear_um.tobytes() == slow.run().pinion.wear_um.tobytes()
    assert slow.run(resume=out).summary == run.summary == gearwear.Run.read(out).summary
    with pytest.raises(ValueError, match="holds the run of another scene: operation.pinion_torque_Nm"):
        slow.with_({TORQUE: 100.0}).run(resume=out)


def test_a_stage_of_rexs(tmp_path: Path) -> None:
    file = ROOT / "src" / "exchange" / "rexs" / "two_stages.rexs"
    with pytest.raises(ValueError, match="two_stages.rexs: .*stage"):
        gearwear.Scene.from_rexs(file)
    with pytest.raises(FileNotFoundError):
        gearwear.Scene.from_rexs(tmp_path / "none.rexs")
    printed = subprocess.run(
        [sys.executable, "-m", "gearwear", "init", "--from", str(file), "--stage", "1"], capture_output=True, text=True, check=True
    ).stdout
    try:
        made = gearwear.Scene.from_rexs(file, stage=1)
    except gearwear.SceneError as error:
        assert "REQUIRED" in printed and error.findings
    else:
        assert made.text == printed


@LINUX
@pytest.mark.filterwarnings("ignore::UserWarning")
def test_a_script_of_a_cluster(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A sweep whose worker is killed, read back; its winner as a scene, run, compared with arrays, plotted."""
    monkeypatch.setenv("GEARWEAR_TEST_MARK", str(tmp_path / "mark"))
    monkeypatch.setattr(executors, "carry_out", die_once)
    base = scene().with_({"numerics.verify": False, "numerics.error_estimate": False})
    with ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
        gearwear.sweep(base, VARY, executor=pool, out=tmp_path / "sweep", best=PEAK)
    assert (tmp_path / "mark").exists()

    found = gearwear.Sweep.read(tmp_path / "sweep")
    assert timeless(found) == timeless(gearwear.sweep(base, VARY, best=PEAK))
    best = int(np.nanargmin(found[PEAK]))
    winner = base.with_({key: found[key][[best]] for key in VARY})
    assert winner[TORQUE] == 150.0 and winner["pair.wheel.tip_rounding_mm"] == found[RELIEF][best]

    winner.run(resume=tmp_path / "run")
    run = gearwear.Run.read(tmp_path / "run")
    worn = run.pinion.wear_um > 0.0
    arrays = {"radius_mm": run.pinion.radius_mm[worn], "wear_um": 1.3 * run.pinion.wear_um[worn]}
    study = gearwear.compare(run, {"pinion": arrays}, shift_within_mm=0.0)
    study.write(tmp_path / "compared")
    for back in (gearwear.Study.read(tmp_path / "compared"), pickle.loads(pickle.dumps(study))):
        fitted = back.summary["fit"]["coefficient_m2_per_N"]
        assert fitted["value"] == pytest.approx(1.3 * fitted["of_run"], rel=0.01)
        assert same_table(back.tables["compare"], study.tables["compare"])

    pytest.importorskip("matplotlib").use("agg")
    from matplotlib import pyplot

    run.plot.wear(axes=pyplot.subplots()[1])
    pyplot.savefig(tmp_path / "wear.png")
    assert (tmp_path / "wear.png").stat().st_size > 0
