"""Sweeps: the same rows whatever runs them, and what is kept when something goes wrong on the way."""

from __future__ import annotations

import csv
import json
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import time
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gearwear
from gearwear import executors
from gearwear.workers import thread_count

TORQUE = "operation.pinion_torque_Nm"
RELIEF = "pair.{pinion,wheel}.tip_rounding_mm"
#: Eight combinations, of which the first two fail.
VARY = {TORQUE: [-1.0, 150, 250.0, 302], RELIEF: "0.05:0.15:2"}
#: Columns that say how long it took.
TIMES = ("simulation_s", "wall_s")

#: The negative torque is said before the sweep begins.
pytestmark = pytest.mark.filterwarnings("ignore:operation.pinion_torque_Nm")

LINUX = pytest.mark.skipif(sys.platform == "win32", reason="processes of POSIX")


def scene() -> gearwear.Scene:
    """A spur run of milliseconds."""
    return gearwear.Scene.preset("thesis-spur").with_(
        {
            "operation.snapshots_h": None,
            "operation.hours": 1.0,
            "contact.surface": "hertz-mean",
            "numerics.flank_points": 120,
            "numerics.positions": 60,
            "numerics.step": {"revolutions": 1000.0},
            "numerics.verify": None,
        }
    )


def slow_scene() -> gearwear.Scene:
    """The same of a tenth of a second and more."""
    return scene().with_({"numerics.step": {"revolutions": 40.0}, "numerics.positions": 200})


def timeless(found: gearwear.Sweep) -> list[tuple[Any, ...]]:
    """All rows but their times, to the bit."""
    columns = [values.tolist() for name, values in found.items() if name not in TIMES]
    return [tuple(repr(value) for value in row) for row in zip(*columns, strict=True)]


@pytest.fixture(scope="module")
def whole() -> gearwear.Sweep:
    return gearwear.sweep(scene(), VARY)


def test_columns_are_those_of_the_command(whole: gearwear.Sweep, tmp_path: Path) -> None:
    (tmp_path / "scene.toml").write_text(scene().text, encoding="utf-8")
    out = tmp_path / "command"
    vary = [f"{TORQUE}=-1,150,250,302", f"{RELIEF}=0.05:0.15:2"]
    command(tmp_path / "scene.toml", out, vary)
    with (out / "sweep.csv").open(encoding="utf-8", newline="") as file:
        written = list(csv.DictReader(file))
    assert list(whole) == list(written[0])
    for name, values in whole.items():
        if name not in TIMES:
            texts = [row[name] for row in written]
            found = [float(text) if text else np.nan for text in texts] if values.dtype.kind in "fi" else texts
            assert np.array_equal(values, found, equal_nan=values.dtype.kind == "f"), name
    assert whole["index"].dtype == np.int64 and whole["index"].tolist() == list(range(8))
    assert whole["status"].tolist() == ["failed"] * 2 + ["ok"] * 6
    assert list(whole.failed) == [0, 1] and TORQUE in whole.failed[0]
    assert whole.rows[3][TORQUE] == 150.0 and whole.rows[3][RELIEF] == 0.15
    assert whole.summary["failed"] == 2 and repr(whole).endswith("2 failed>")
    assert timeless(pickle.loads(pickle.dumps(whole))) == timeless(whole)
    assert whole.to_pandas()["pinion.peak_wear_um"].idxmin() == whole.summary["best"][0]["index"]


def command(file: Path, out: Path, vary: list[str]) -> str:
    options = [option for one in vary for option in ("--vary", one)]
    arguments = [sys.executable, "-m", "gearwear", "sweep", str(file), *options, "--out", str(out)]
    return subprocess.run(arguments, capture_output=True, text=True, encoding="utf-8", check=True).stderr


def test_threads_change_nothing(whole: gearwear.Sweep) -> None:
    assert timeless(gearwear.sweep(scene(), VARY, threads=2)) == timeless(whole)


@pytest.mark.parametrize("engine", ["threads", "spawn", "fork", "forkserver"])
def test_executors_change_nothing(engine: str, whole: gearwear.Sweep, tmp_path: Path) -> None:
    if engine not in ("threads", *multiprocessing.get_all_start_methods()):
        pytest.skip(f"{engine} is not available here")
    pool: Executor = ThreadPoolExecutor(2)
    if engine != "threads":
        pool = ProcessPoolExecutor(2, multiprocessing.get_context(engine))
    with pool:
        found = gearwear.sweep(scene(), VARY, executor=pool, out=tmp_path)
    assert timeless(found) == timeless(whole)
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "columns.json", "report.html", "rows.jsonl", "scene.toml", "sweep.csv", "sweep.json", "sweep.parquet"
    ]


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_dask_changes_nothing(whole: gearwear.Sweep, monkeypatch: pytest.MonkeyPatch) -> None:
    distributed = pytest.importorskip("distributed", reason="dask.distributed is not here: a sweep on it is NOT tested")
    cluster = distributed.LocalCluster(n_workers=2, threads_per_worker=2, dashboard_address=None)
    with cluster, distributed.Client(cluster) as client:
        found = gearwear.sweep(scene(), VARY, executor=client.get_executor())
        monkeypatch.setattr(executors, "carry_out", fail_at_first)
        again = gearwear.sweep(scene(), VARY, executor=client.get_executor())
        # A function of a user that runs a scene on a worker has one thread there.
        threads = client.submit(thread_count, None).result()
    assert timeless(found) == timeless(again) == timeless(whole)
    assert threads == 1


def test_verified_rows_on_an_executor() -> None:
    """The best and the corners, chosen when all rows are there; `numerics.verify` is given by name."""
    verified = gearwear.Scene.preset("fzg-c").with_(
        {
            "operation.snapshots_h": None,
            "operation.hours": 0.5,
            "numerics.verify": True,
            "numerics.positions": 40,
            "numerics.flank_points": 80,
            "stiffness.model": "weber-banaschek",
        }
    )
    here = gearwear.sweep(verified, {TORQUE: [250, 302]})
    assert here["verified"].tolist() == ["best and corner"] * 2
    assert np.isfinite(here["error.total.peak_wear.pinion"]).all()
    with ThreadPoolExecutor(2) as pool:
        there = gearwear.sweep(verified, {TORQUE: [250, 302]}, executor=pool)
    assert timeless(there) == timeless(here)


class DiesOnce(Executor):
    """Tasks run here, but for those that are lost: the number of times for each task in the order they first come."""

    def __init__(self, *losses: int) -> None:
        self.left: dict[str, int] = {}
        self.losses = list(losses)
        self.count = 0

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        self.count += 1
        future: Future[Any] = Future()
        left = self.left.setdefault(args[1], self.losses.pop(0) if self.losses else 0)
        if left:
            self.left[args[1]] -= 1
            future.set_exception(ConnectionError("the worker is gone"))
        else:
            future.set_result(fn(*args, **kwargs))
        return future


def test_a_lost_row_is_run_again_and_given_up_in_the_end(whole: gearwear.Sweep) -> None:
    executor = DiesOnce(0, 0, 1, 2, 0, 7)
    found = gearwear.sweep(scene(), VARY, executor=executor)
    assert executor.count == 8 + 1 + 2 + 2
    assert list(found.failed) == [0, 1, 5]
    assert found.failed[5].endswith("the last time alone: ConnectionError: the worker is gone")
    kept = [row for row in range(8) if row != 5]
    assert [timeless(found)[row] for row in kept] == [timeless(whole)[row] for row in kept]


def test_an_executor_that_does_nothing_is_no_failed_row(tmp_path: Path) -> None:
    with pytest.raises(gearwear.RunError, match="has done none of its tasks.*ConnectionError"):
        gearwear.sweep(scene(), VARY, executor=DiesOnce(*[9] * 8), out=tmp_path)
    with pytest.raises(gearwear.RunError, match="has done none of its tasks"):
        gearwear.sweep(scene(), {TORQUE: [200]}, executor=DiesOnce(9))
    assert len((tmp_path / "rows.jsonl").read_text(encoding="utf-8").splitlines()) == 1


class Breaks(Executor):
    """Does three tasks, is broken with the fourth, and is no pool of `concurrent.futures`."""

    def __init__(self) -> None:
        self.count = 0
        self.closed = False

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future[Any]:
        self.count += 1
        if self.count > 3:
            raise BrokenExecutor("a process died")
        future: Future[Any] = Future()
        future.set_result(fn(*args, **kwargs))
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        self.closed = True


def test_another_pool_that_breaks_is_made_anew_by_a_function(whole: gearwear.Sweep, tmp_path: Path) -> None:
    with pytest.raises(BrokenExecutor, match="a process died"):
        gearwear.sweep(scene(), VARY, executor=Breaks(), out=tmp_path)
    made: list[Breaks] = []

    def make() -> Breaks:
        made.append(Breaks())
        return made[-1]

    assert timeless(gearwear.sweep(scene(), VARY, executor=make)) == timeless(whole)
    assert [one.closed for one in made] == [True] * 3
    with pytest.raises(TypeError, match="executor: found str"):
        gearwear.sweep(scene(), VARY, executor="processes")  # type: ignore[arg-type]


def die_once(sweep: bytes, task: str, losses: int) -> str:
    """Does a task, but kills its process the first time that it is asked for the third."""
    mark = Path(os.environ["GEARWEAR_TEST_MARK"])
    if json.loads(task) == {"run": 3} and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return carry_out(sweep, task, losses)


def fail_at_first(sweep: bytes, task: str, losses: int) -> str:
    if json.loads(task) == {"run": 3} and losses < 2:
        raise ConnectionError("the worker is gone")
    return carry_out(sweep, task, losses)


carry_out = executors.carry_out


@LINUX
@pytest.mark.parametrize("method", ["spawn", "fork"])
def test_a_worker_that_is_killed_costs_nothing_but_time(
    method: str, whole: gearwear.Sweep, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    mark = tmp_path / "mark"
    monkeypatch.setenv("GEARWEAR_TEST_MARK", str(mark))
    monkeypatch.setattr(executors, "carry_out", die_once)
    with ProcessPoolExecutor(2, multiprocessing.get_context(method)) as pool:
        found = gearwear.sweep(scene(), VARY, executor=pool)
    assert mark.exists()
    assert timeless(found) == timeless(whole)


KILLED = """
import multiprocessing, sys
from concurrent.futures import ProcessPoolExecutor
import gearwear
from test_sweep import VARY_SLOW, slow_scene
if __name__ == "__main__":
    with ProcessPoolExecutor(2, multiprocessing.get_context(sys.argv[2])) as pool:
        gearwear.sweep(slow_scene(), VARY_SLOW, executor=pool, out=sys.argv[1])
"""
VARY_SLOW = {TORQUE: "100:300:12"}


def rows_in(out: Path) -> int:
    journal = out / "rows.jsonl"
    return journal.read_text(encoding="utf-8").count("\n") - 1 if journal.exists() else 0


@LINUX
@pytest.mark.parametrize("method", ["spawn", "fork"])
def test_a_killed_sweep_goes_on_where_it_was(method: str, tmp_path: Path) -> None:
    """Here and on the command line; workers that outlive the process that was killed do not hold its journal."""
    out = tmp_path / "out"
    script = tmp_path / "killed.py"
    script.write_text(KILLED)
    paths = os.pathsep.join([str(Path(__file__).parent), os.environ.get("PYTHONPATH", "")])
    process = subprocess.Popen(
        [sys.executable, str(script), str(out), method], env={**os.environ, "PYTHONPATH": paths}, start_new_session=True
    )
    try:
        deadline = time.monotonic() + 60
        while rows_in(out) < 3:
            assert process.poll() is None and time.monotonic() < deadline, "no rows arrive"
            time.sleep(0.01)
        os.kill(process.pid, signal.SIGKILL)
        process.wait()
        before = rows_in(out)
        assert 3 <= before < 12, "the sweep is too short for this test"
        if method == "fork":
            (tmp_path / "scene.toml").write_text(slow_scene().text, encoding="utf-8")
            said = command(tmp_path / "scene.toml", out, [f"{TORQUE}=100:300:12"])
            assert f"{before} of them finished before" in said
        found = gearwear.sweep(slow_scene(), VARY_SLOW, threads=2, out=out)
    finally:
        # The workers of a pool that was killed are left waiting for it.
        os.killpg(process.pid, signal.SIGKILL)
    assert rows_in(out) == 12
    assert timeless(found) == timeless(gearwear.sweep(slow_scene(), VARY_SLOW, threads=2))


@LINUX
def test_ctrl_c_keeps_what_arrived(tmp_path: Path) -> None:
    code = (
        "import signal, sys, gearwear; from test_sweep import VARY_SLOW, slow_scene\n"
        # Started in the background by a shell, a process ignores the signal, and so do its children.
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "try:\n    gearwear.sweep(slow_scene(), VARY_SLOW, out=sys.argv[1])\n"
        "except KeyboardInterrupt:\n    print('stopped')"
    )
    out = tmp_path / "out"
    paths = os.pathsep.join([str(Path(__file__).parent), os.environ.get("PYTHONPATH", "")])
    process = subprocess.Popen(
        [sys.executable, "-c", code, str(out)], env={**os.environ, "PYTHONPATH": paths}, stdout=subprocess.PIPE, text=True
    )
    while rows_in(out) < 2 and process.poll() is None:
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    said, _ = process.communicate(timeout=10)
    assert said == "stopped\n"
    assert 2 <= rows_in(out) < 12


def test_another_sweep_is_refused(tmp_path: Path) -> None:
    gearwear.sweep(scene(), {TORQUE: [150, 250]}, out=tmp_path)
    with pytest.raises(ValueError, match="rows of another sweep: what is varied"):
        gearwear.sweep(scene(), {TORQUE: [150, 300]}, out=tmp_path)
    file = tmp_path / "file"
    file.touch()
    with pytest.raises(NotADirectoryError):
        gearwear.sweep(scene(), {TORQUE: [150, 250]}, out=file)


def test_what_is_wrong_is_named() -> None:
    wrong: list[tuple[dict[str, object], str]] = [
        ({"operation.pinion_torqe_Nm": [1.0]}, "unknown key operation.pinion_torqe_Nm"),
        ({TORQUE: [300, 200]}, "found 200 after 300; allowed: rising values"),
        ({TORQUE: "300:200:3"}, "reversed"),
        ({TORQUE: [float("nan")]}, "allowed: a finite number"),
        ({"contact.surface": ["rubber"]}, "found \"rubber\""),
        ({TORQUE: [-2, -1]}, "none of the combinations makes a scene|found -2 to -1"),
        ({}, "vary: found no key"),
    ]
    for vary, said in wrong:
        with pytest.raises(ValueError, match=said):
            gearwear.sweep(scene(), vary)
    with pytest.raises(TypeError, match=f"{TORQUE}: found None"):
        gearwear.sweep(scene(), {TORQUE: [None]})
    with pytest.raises(TypeError, match="vary: found str"):
        gearwear.sweep(scene(), f"{TORQUE}=1,2")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="unknown figure pinion.peak_ware_um.*pinion.peak_wear_um"):
        gearwear.sweep(scene(), VARY, best="pinion.peak_ware_um")
    with ThreadPoolExecutor(1) as pool, pytest.raises(ValueError, match="threads: found 2 beside an executor.*allowed: None"):
        gearwear.sweep(scene(), VARY, executor=pool, threads=2)
