"""What is wrong with a scene: the same findings as on the command line."""

from __future__ import annotations

import pickle
import subprocess
import sys
from pathlib import Path

import pytest
from short_scenes import SHORT, spur_scene

import gearwear

FZG_C = gearwear.Scene.preset("fzg-c").text

#: Exchanges in the text of fzg-c that make it wrong.
WRONG = {
    "unknown key": ("face_width_mm = 14.0", "face_widht_mm = 14.0"),
    "wrong type": ("teeth = 24", 'teeth = "twenty-four"'),
    "out of range": ("teeth = 16", "teeth = 4"),
    "no such surface": ('# surface = "fem"', 'surface = "rubber" #'),
    "tip below the base circle": ("tip_diameter_mm = 82.46", "tip_diameter_mm = 67.0"),
    "no mesh": ("centre_distance_mm = 91.5", "centre_distance_mm = 80.0"),
    "decimal comma": ("face_width_mm = 14.0", "face_width_mm = 14,0"),
    "no TOML": ("[material]", "[material"),
    "said twice": ("face_width_mm = 14.0", "face_width_mm = 14.0\ntransverse_module_mm = 4.5"),
    "nothing": (FZG_C, ""),
}


def told(scene: Path) -> tuple[int, str]:
    """Exit status and messages of the command line."""
    command = [sys.executable, "-m", "gearwear", "run", "--quiet", "--out", str(scene.parent / "out"), str(scene)]
    done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8")
    return done.returncode, done.stderr


def same_findings(scene: Path) -> gearwear.SceneError:
    """What is wrong with the scene, which the command line says too, at the same place."""
    with pytest.raises(gearwear.SceneError) as caught:
        gearwear.Scene.from_file(scene).run()
    error = caught.value
    status, text = told(scene)
    assert status == 2, text
    assert error.findings
    for finding in error.findings[:20]:
        assert finding.message in text, f"{finding.message}\n{text}"
        assert finding.help is None or finding.help in text, f"{finding.help}\n{text}"
        assert f"scene.toml:{finding.line}:" in text, f"{finding}\n{text}"
    count = len(error.findings)
    assert count == 1 or f"{count} problems in" in text, text
    return error


@pytest.mark.parametrize("name", WRONG)
def test_the_same_findings_as_on_the_command_line(name: str, tmp_path: Path) -> None:
    found, exchanged = WRONG[name]
    assert found in FZG_C
    scene = tmp_path / "scene.toml"
    scene.write_text(FZG_C.replace(found, exchanged), encoding="utf-8")
    error = same_findings(scene)
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is gearwear.SceneError
    assert (again.name, again.findings, str(again)) == (error.name, error.findings, str(error))


def test_every_wrong_scene_of_the_program(handed_scenes: list[Path], tmp_path: Path) -> None:
    if not handed_scenes:
        pytest.skip("cargo test --test commands bad_input leaves the scenes: it was not run here")
    for handed in handed_scenes:
        scene = tmp_path / "scene.toml"
        scene.write_bytes(handed.read_bytes())
        same_findings(scene)


def test_a_scene_whose_spring_is_left_nothing(tmp_path: Path) -> None:
    """Found only when the run begins; it is the scene's fault all the same."""
    text = gearwear.Scene.preset("fzg-c").with_(
        {"contact.surface": "winkler", "contact.foundation_MPa_per_mm": 1e3, "numerics.verify": False, "stiffness.model": "weber-banaschek"}
    )
    scene = tmp_path / "scene.toml"
    scene.write_text(text.text, encoding="utf-8")
    error = same_findings(scene)
    assert error.findings[0].kind == "stiffness"


def test_errors_are_python_errors_of_their_kind() -> None:
    error = gearwear.SceneError("scene", [gearwear.Finding("missing", "a.b", "", "c", "try d", 3, "a.b is missing")])
    assert isinstance(error, ValueError) and isinstance(error, gearwear.GearwearError)
    assert str(error) == "scene, line 3: a.b is missing (try d)"
    assert issubclass(gearwear.NotConverged, gearwear.RunError)


def test_a_run_that_comes_to_no_end_keeps_what_was_finished() -> None:
    """A wear coefficient so great that a tooth is worn through within the hour."""
    changes = {"wear.coefficient_m2_per_N": 1e-12, "numerics.step": {"revolutions": 450}}
    cheap = {"contact.surface": "hertz", "contact.tip_contact": False, "numerics.positions": 20}
    with pytest.raises(gearwear.WornThrough, match="worn through after") as caught:
        spur_scene().with_(changes, **cheap).run(threads=1)
    error = caught.value
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is gearwear.WornThrough and str(again) == str(error)
    assert error.run is not None and again.run is not None
    assert again.run.summary == error.run.summary
    assert error.run.summary["stopped"] == "worn-through"
    # Of the steps that were taken the last before the tooth was gone, between two snapshots.
    last = error.run.history["revolutions"][-1]
    assert 0.0 < last == error.run.summary["revolutions"] and last not in SHORT["operation.snapshots_revolutions"]  # type: ignore[operator]
    assert error.run.pinion.wear_um.max() > 0.0


@pytest.mark.parametrize("threads", [0, -1, 1.5, True, "2"])
def test_numbers_of_threads(threads: object) -> None:
    with pytest.raises((TypeError, ValueError), match="threads: found"):
        gearwear.Scene.preset("fzg-c").run(threads=threads)  # type: ignore[arg-type]


def test_progress_that_is_none() -> None:
    with pytest.raises(TypeError, match="progress: found 3"):
        gearwear.Scene.preset("fzg-c").run(progress=3)  # type: ignore[arg-type]
