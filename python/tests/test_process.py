"""The process around it: Ctrl-C, time of the import, the command line."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import gearwear

LONG = """
import signal, sys, time
import gearwear
# Started in the background by a shell, a process ignores the signal, and so do its children.
signal.signal(signal.SIGINT, signal.default_int_handler)
scene = gearwear.Scene.preset("fzg-c").with_(**{"numerics.step": {"revolutions": 5}, "numerics.verify": False,
    "numerics.error_estimate": False, "stiffness.model": "weber-banaschek"})
print("begins", flush=True)
try:
    scene.run(threads=2)
except KeyboardInterrupt:
    print("stopped", time.time(), flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_ctrl_c_stops_a_run_within_a_second() -> None:
    process = subprocess.Popen([sys.executable, "-c", LONG], stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None and process.stdout.readline() == "begins\n"
    time.sleep(1.5)
    assert process.poll() is None, "the run is too short for this test"
    begin = time.time()
    os.kill(process.pid, signal.SIGINT)
    said = process.stdout.readline().split()
    process.wait(10)
    assert said[0] == "stopped" and float(said[1]) - begin < 1.0


def test_a_function_that_fails_stops_the_run() -> None:
    scene = gearwear.Scene.preset("fzg-c").with_({"numerics.step": {"revolutions": 5}, "numerics.verify": False})

    def fails(stage: str, part: float) -> None:
        raise LookupError(stage)

    with pytest.raises(LookupError):
        scene.run(threads=1, progress=fails)


def test_the_import_is_lean() -> None:
    """Modules that `import gearwear` loads: few, and none of those that take longer than all of them."""
    code = "import sys; before = set(sys.modules); import gearwear; print(*sorted(set(sys.modules) - before))"
    loaded = _said(code).split()
    assert len(loaded) < 150, loaded
    heavy = {"asyncio", "concurrent.futures", "http", "multiprocessing", "subprocess", "unittest"}
    heavy |= {"matplotlib", "numpy", "pandas", "pyarrow", "scipy", "xarray"}
    assert not heavy.intersection(loaded), loaded


def _said(code: str) -> str:
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout


def test_the_command_line(tmp_path: Path) -> None:
    program = Path(sys.executable).parent / "gearwear"
    command = [str(program)] if program.exists() else [sys.executable, "-m", "gearwear"]
    version = subprocess.run([*command, "--version"], capture_output=True, text=True)
    assert (version.returncode, version.stdout) == (0, f"gearwear {gearwear.__version__}\n")
    printed = subprocess.run([*command, "init", "fzg-c"], capture_output=True, text=True, encoding="utf-8")
    assert printed.stdout == gearwear.Scene.preset("fzg-c").text
    wrong = subprocess.run([*command, "run"], capture_output=True, text=True)
    assert wrong.returncode == 2 and "Usage" in wrong.stderr
    missing = subprocess.run([*command, "plan", str(tmp_path / "nowhere.toml")], capture_output=True, text=True)
    assert missing.returncode == 2 and "cannot be read" in missing.stderr
