"""Scenes: made, changed, compared, pickled."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gearwear
from gearwear import Scene

TABLES = {
    "title": "a pair",
    "pair": {"preset": "fzg-c"},
    "operation": {"pinion_torque_Nm": 100, "pinion_revolutions": 1e4},
    "wear": {"law": "archard", "coefficient_m2_per_N": 1e-17},
}


def test_presets_are_scenes() -> None:
    assert "fzg-c" in gearwear.presets()
    for name in gearwear.presets():
        assert Scene.preset(name).title


def test_a_dict_is_the_text_that_says_the_same() -> None:
    text = (
        'title = "a pair"\n[pair]\npreset = "fzg-c"\n[operation]\npinion_torque_Nm = 100\npinion_revolutions = 1e4\n'
        '[wear]\nlaw = "archard"\ncoefficient_m2_per_N = 1e-17\n'
    )
    of_text, of_dict = Scene.from_toml(text), Scene.from_dict(TABLES)
    assert of_text == of_dict and hash(of_text) == hash(of_dict)
    assert of_text != of_dict.with_({"title": "another"})
    assert Scene.from_toml(of_text.to_toml()) == of_text
    assert of_text != "a scene"


def test_values_of_numpy_and_paths() -> None:
    scene = Scene.preset("fzg-c")
    changed = scene.with_(
        {
            "operation.pinion_torque_Nm": np.float64(250),
            "pair.pinion.teeth": np.int64(16),
            "numerics.verify": np.bool_(False),
            "operation.snapshots_h": np.array([1.0, 2.0]),
            "title": Path("x"),
        }
    )
    operation = changed.to_dict()["operation"]
    assert operation["pinion_torque_Nm"] == 250 and operation["snapshots_h"][:2] == [1.0, 2.0]
    assert changed.title == "x"
    assert scene == Scene.preset("fzg-c"), "the scene itself never changes"


def test_keys_change_together_and_none_leaves_out() -> None:
    scene = Scene.preset("fzg-c")
    short = scene.with_(**{"operation.snapshots_h": None, "operation.hours": 1})
    assert short.to_dict()["operation"]["hours"] == 1
    assert short == scene.without("operation.snapshots_h").with_({"operation.hours": 1})
    with pytest.raises(gearwear.SceneError, match="did you mean"):
        scene.without("operation.snapshot_h")


@pytest.mark.parametrize(
    ("value", "error", "words"),
    [
        (object(), TypeError, "operation.pinion_torque_Nm: found a value of type object; allowed: a number"),
        (1j, TypeError, "operation.pinion_torque_Nm: found a value of type complex"),
        (2**70, OverflowError, "operation.pinion_torque_Nm: found 1180591620717411303424"),
        ("much", gearwear.SceneError, 'operation.pinion_torque_Nm: found the text "much"'),
        (float("nan"), gearwear.SceneError, "operation.pinion_torque_Nm: found"),
        (np.array([1.0, 2.0]), gearwear.SceneError, "operation.pinion_torque_Nm: found a list"),
        ([object()], TypeError, "operation.pinion_torque_Nm.1: found a value of type object"),
        ({1: 2}, TypeError, "operation.pinion_torque_Nm: found the key 1; allowed: keys that are texts"),
    ],
)
def test_wrong_values_are_named(value: object, error: type[Exception], words: str) -> None:
    with pytest.raises(error) as caught:
        Scene.preset("fzg-c").with_({"operation.pinion_torque_Nm": value})
    assert words in str(caught.value)


def test_what_is_no_scene() -> None:
    with pytest.raises(TypeError, match="the scene: found a value of type list; allowed: a dict"):
        Scene.from_dict([])  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="Scene.preset"):
        Scene("fzg-c")  # type: ignore[arg-type]
    with pytest.raises(gearwear.SceneError, match="fzg-c"):
        Scene.preset("fzg-d")
    with pytest.raises(FileNotFoundError, match="nowhere.toml cannot be read"):
        Scene.from_file("nowhere.toml")
    scene = Scene.preset("fzg-c")
    with pytest.raises(AttributeError, match="never changes"):
        setattr(scene, "title", "x")
    with pytest.raises(AttributeError, match="never changes"):
        del scene._native


def test_bytes_that_are_no_text(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_bytes(b"title = '\xff'\n")
    with pytest.raises(gearwear.SceneError, match="not UTF-8") as caught:
        Scene.from_file(file)
    assert caught.value.findings[0].kind == "not-utf8"


def test_a_person_can_read_it() -> None:
    text = repr(Scene.preset("fzg-c"))
    for part in ["FZG type C", "16/24 teeth", "normal module 4.5 mm", "spur", "302 N·m", "archard"]:
        assert part in text, text
    assert "helix angle" in repr(Scene.preset("helical"))


def test_plan_and_warnings() -> None:
    plan = Scene.preset("fzg-c").plan()
    assert any(stage["name"] == "simulation" for stage in plan["stages"])
    assert all(stage["reason"] for stage in plan["left_out"])
    slip = Scene.preset("fzg-c").with_({"wear.coefficient_m2_per_N": 1e-8})
    assert slip.warnings and not Scene.preset("fzg-c").warnings


def test_a_scene_takes_the_files_it_names_along(tmp_path: Path) -> None:
    """A curve of tooth stiffness lies beside the scene, and goes with it where the file is gone."""
    tables = {**TABLES, "stiffness": {"model": "simon", "curve": "teeth.csv"}}
    with pytest.raises(gearwear.SceneError, match="stiffness.curve"):
        Scene.from_dict(tables, tmp_path)
    curve = tmp_path / "teeth.csv"
    curve.write_text("# flattening = excluded\nposition_mm,stiffness_N_per_mm_um\n4.4,10\n14,12\n23.6,11\n")
    scene = Scene.from_dict(tables, tmp_path)
    data = pickle.dumps(scene)
    curve.write_text("# flattening = excluded\nposition_mm,stiffness_N_per_mm_um\n4.4,10\n14,13\n23.6,11\n")
    assert Scene.from_dict(tables, tmp_path) != scene, "other contents of the file are another scene"
    curve.unlink()
    again: Scene = pickle.loads(data)
    assert again == scene == again.with_({"title": "a pair"})


def test_copies_are_the_scene_itself() -> None:
    scene = Scene.preset("fzg-c")
    assert copy.copy(scene) is scene and copy.deepcopy(scene) is scene
    again: Any = pickle.loads(pickle.dumps(scene))
    assert again == scene and again.text == scene.text and {scene: 1}[again] == 1


def test_keys_are_read_and_take_the_values_of_evaluate() -> None:
    scene = Scene.preset("fzg-c")
    assert scene["operation.pinion_torque_Nm"] == 302.0 and scene["pair.pinion"]["teeth"] == 16
    assert scene["helical.slices"] is None and scene["operation.phases.2.hours"] is None
    snapshots = scene.with_({"operation.snapshots_h": np.array([50.0])})
    assert snapshots == scene.with_({"operation.snapshots_h": [50]}) and snapshots["operation.snapshots_h.1"] == 50.0
    changed = scene.with_(
        {
            "pair.{pinion,wheel}.tip_rounding_mm": np.array([0.2]),
            "operation.pinion_torque_Nm": np.array([[250]]),
            "pair.pinion.teeth": np.float64(16.0),
            "contact.surface": np.array(["winkler"]),
        }
    )
    assert changed["pair.pinion.tip_rounding_mm"] == changed["pair.wheel.tip_rounding_mm"] == 0.2
    assert (changed["operation.pinion_torque_Nm"], changed["contact.surface"]) == (250.0, "winkler")
    assert changed.without("pair.{pinion,wheel}.tip_rounding_mm")["pair.wheel.tip_rounding_mm"] == 0.0
    with pytest.raises(KeyError, match="unknown key pair.face_widht_mm; .*did you mean pair.face_width_mm"):
        scene["pair.face_widht_mm"]
    with pytest.raises(TypeError, match="found a key of type int"):
        scene[0]  # type: ignore[index]
    with pytest.raises(gearwear.SceneError, match="teeth: found"):
        scene.with_({"pair.pinion.teeth": 16.5})
