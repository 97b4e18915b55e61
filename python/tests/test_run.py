"""Results: the values of the files bit for bit, without copies, the same in every way of running."""

from __future__ import annotations

import csv
import json
import multiprocessing
import pickle
import re
import sys
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from short_scenes import helical_scene, spur_scene

import gearwear

FLANK = ("removed_um", "sliding_mm_per_mesh", "wear_um", "pressure_new_MPa", "pressure_worn_MPa")


def columns(file: Path) -> dict[str, list[str]]:
    with file.open(newline="") as lines:
        rows = list(csv.reader(lines))
    return {name: [row[number] for row in rows[1:]] for number, name in enumerate(rows[0])}


def numbers(texts: list[str]) -> np.ndarray[Any, Any]:
    """Numbers of a file: those not computed are empty fields; what is so or not is 1 or 0."""
    words = {"": np.nan, "true": 1.0, "false": 0.0}
    return np.array([words[text] if text in words else float(text) for text in texts])


def same_bits(one: Any, other: Any) -> bool:
    one, other = (np.ascontiguousarray(array, dtype=float).ravel() for array in (one, other))
    nothing = np.isnan(one) & np.isnan(other)
    return one.shape == other.shape and bool(np.all(nothing | (one.view(np.int64) == other.view(np.int64))))


def bits_of(run: gearwear.Run) -> dict[str, bytes]:
    """All numbers of a run."""
    arrays = {f"{name}.{gear}": getattr(getattr(run, gear), name) for gear in ("pinion", "wheel") for name in FLANK}
    arrays |= {f"mesh_cycle.{name}": values for name, values in run.mesh_cycle.items()}
    arrays |= {f"history.{name}": values for name, values in run.history.items()}
    return {name: np.ascontiguousarray(values).tobytes() for name, values in arrays.items()}


@pytest.mark.parametrize("name", ["spur", "helical"])
def test_arrays_are_the_values_of_the_files(name: str, request: pytest.FixtureRequest, tmp_path: Path) -> None:
    run: gearwear.Run = request.getfixturevalue(name)
    run.write(tmp_path)
    tables: dict[str, Any] = {"mesh_cycle": run.mesh_cycle, "history": run.history, "profiles": run.profiles}
    tables |= {"pinion": run.pinion.table, "wheel": run.wheel.table}
    if run.slices is not None:
        tables["slices"] = run.slices.table
    about = json.loads((tmp_path / "columns.json").read_text())["files"]
    for table_name, table in tables.items():
        file = columns(tmp_path / f"{table_name}.csv")
        assert list(file) == list(table), table_name
        assert about[f"{table_name}.csv"] == table.meanings
        for column, texts in file.items():
            if table[column].dtype.kind == "U":
                assert list(table[column]) == texts
            else:
                assert same_bits(table[column], numbers(texts)), f"{table_name}.{column}"
    for gear in ("pinion", "wheel"):
        flank, file = getattr(run, gear), columns(tmp_path / f"{gear}.csv")
        for column in FLANK:
            assert same_bits(getattr(flank, column), numbers(file[column])), column
        assert same_bits(np.tile(flank.radius_mm, flank.width_mm.size), numbers(file["radius_mm"]))
        assert same_bits(np.repeat(flank.width_mm, flank.radius_mm.size), numbers(file["width_mm"]))
        assert same_bits(flank.snapshot_wear_um[-1], flank.wear_um)
    assert json.loads((tmp_path / "summary.json").read_text()) == run.summary


def test_shapes(spur: gearwear.Run, helical: gearwear.Run) -> None:
    assert spur.pinion.wear_um.shape == spur.pinion.radius_mm.shape == (101,)
    assert spur.slices is None and len(spur.pinion.snapshot_wear_um) == len(spur.history["revolutions"])
    assert helical.pinion.wear_um.shape == (8, 101) and helical.pinion.radius_mm.shape == (101,)
    slices = helical.slices
    assert slices is not None
    assert slices.line_load_new_N_per_mm.shape == (slices.position_mm.size, 8)
    assert slices.at_sharp_edge_new.dtype == np.bool_


def test_every_column_of_a_flank_is_a_field(spur: gearwear.Run) -> None:
    places = {"point", "slice"}
    assert set(spur.pinion.table) - places == set(gearwear.Flank.__annotations__)


def test_nothing_is_copied(helical: gearwear.Run) -> None:
    """Two accesses, and two objects of the same result, give the same memory; nobody can change it."""
    again = gearwear.Run(helical._native)
    for name in gearwear.Flank.__annotations__:
        one, other = getattr(helical.pinion, name), getattr(again.pinion, name)
        assert one is getattr(helical.pinion, name) and one is not other
        assert one.ctypes.data == other.ctypes.data, name
        assert not one.flags.owndata and not one.flags.writeable and one.base is not None
        with pytest.raises(ValueError, match="read-only"):
            one[...] = 0
        with pytest.raises(ValueError):
            one.flags.writeable = True
    one, other = helical.pinion.snapshot_wear_um[0], again.pinion.snapshot_wear_um[0]
    assert one.ctypes.data == other.ctypes.data
    assert helical.mesh_cycle.load_share_new is helical.mesh_cycle["load_share_new"]
    with pytest.raises(ValueError):
        helical.mesh_cycle.load_share_new[0] = 0


def test_arrays_outlive_their_run() -> None:
    import gc

    wear = spur_scene().run(threads=1).pinion.wear_um
    kept = wear.copy()
    gc.collect()
    _ = [np.full(wear.shape, np.nan) for _ in range(100)]
    assert same_bits(wear, kept)


def test_names_that_are_none(spur: gearwear.Run) -> None:
    with pytest.raises(AttributeError, match="a flank has no wear_mm; allowed: .*wear_um"):
        spur.pinion.wear_mm  # type: ignore[attr-defined]
    with pytest.raises(AttributeError, match="no column load_share; allowed: .*load_share_new"):
        spur.mesh_cycle.load_share
    with pytest.raises(KeyError, match="no column load_share; allowed: .*load_share_new"):
        spur.mesh_cycle["load_share"]
    assert "wear_um" in dir(spur.pinion) and "load_share_new" in dir(spur.mesh_cycle)


def bits_in_a_process(scene: gearwear.Scene) -> dict[str, bytes]:
    return bits_of(scene.run())


@pytest.mark.parametrize("make", [spur_scene, helical_scene])
def test_the_same_bits_on_any_number_of_threads_and_in_every_process(make: Any) -> None:
    scene = make()
    expected = bits_of(scene.run(threads=1))
    assert bits_of(scene.run(threads=2)) == expected
    methods = ["spawn", "fork"] if sys.platform == "linux" else ["spawn"]
    for method in methods:
        with ProcessPoolExecutor(2, multiprocessing.get_context(method)) as pool:
            for bits in pool.map(bits_in_a_process, [scene, scene]):
                assert bits == expected, method


def threads_by_default(_: int) -> int:
    from gearwear.workers import thread_count

    return thread_count(None)


def test_one_thread_in_a_worker() -> None:
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        assert pool.submit(threads_by_default, 0).result() == 1
    assert threads_by_default(0) == 0


def test_a_run_is_pickled_bit_for_bit(spur: gearwear.Run, helical: gearwear.Run) -> None:
    for run in (spur, helical):
        again: gearwear.Run = pickle.loads(pickle.dumps(run))
        assert bits_of(again) == bits_of(run)
        assert again.summary == run.summary and again.scene == run.scene
        assert again._native.to_bytes() == run._native.to_bytes()
        for part in (run.pinion, run.wheel, run.slices, run.history, run.plot):
            back = pickle.loads(pickle.dumps(part))
            assert type(back) is type(part) and repr(back).split(" object")[0] == repr(part).split(" object")[0]
        assert pickle.loads(pickle.dumps(run.wheel)).wear_um.tobytes() == run.wheel.wear_um.tobytes()


def test_a_run_of_another_version() -> None:
    from gearwear.run import _restored

    with pytest.raises(ValueError, match=r"found a result of gearwear 0\.0\.1; allowed"):
        _restored("0.0.1", b"")
    with pytest.raises(ValueError, match="no result of this version"):
        _restored(gearwear.__version__, b"\x01\x02")


def returned(thing: Any) -> Any:
    return thing


def test_a_hundred_pickles_through_a_spawned_process(spur: gearwear.Run) -> None:
    """Scenes, results and exceptions, there and back."""
    random = np.random.default_rng(19)
    scene = spur_scene()
    things: list[Any] = []
    for number in range(100):
        torque = float(random.uniform(1, 400))
        changed = scene.with_({"operation.pinion_torque_Nm": torque})
        kinds: list[Callable[[], Any]] = [
            lambda: changed,
            lambda: spur,
            lambda: _caught(scene, {"operation.pinion_torque_Nm": -torque, "pair.pinion.teeth": number % 5}),
            lambda: gearwear.NotConverged(f"at {torque}", spur),
        ]
        things.append(kinds[number % 4]())
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        for thing, back in zip(things, pool.map(returned, things)):
            assert type(back) is type(thing)
            if isinstance(thing, gearwear.Scene):
                assert back == thing and hash(back) == hash(thing)
            elif isinstance(thing, gearwear.Run):
                assert bits_of(back) == bits_of(thing)
            elif isinstance(thing, gearwear.SceneError):
                assert back.findings == thing.findings and str(back) == str(thing)
            else:
                assert str(back) == str(thing) and bits_of(back.run) == bits_of(thing.run)


def _caught(scene: gearwear.Scene, changes: dict[str, Any]) -> gearwear.SceneError:
    with pytest.raises(gearwear.SceneError) as caught:
        scene.with_(changes)
    return caught.value


def test_the_files_of_the_command_line(spur: gearwear.Run, tmp_path: Path) -> None:
    """Wall times differ, and nothing else does."""
    import subprocess

    (tmp_path / "scene.toml").write_text(spur_scene().text)
    program, own = tmp_path / "program", tmp_path / "own"
    command = [sys.executable, "-m", "gearwear", "run", "--quiet", str(tmp_path / "scene.toml"), "--out", str(program)]
    subprocess.run(command, check=True)
    spur.write(own)
    assert sorted(p.name for p in program.iterdir()) == sorted(p.name for p in own.iterdir())
    for file in program.iterdir():
        if file.name == "record.bin":
            continue
        one, other = file.read_bytes(), (own / file.name).read_bytes()
        if file.name == "summary.json":
            one, other = (json.dumps(_without_times(json.loads(data))).encode() for data in (one, other))
        if file.name == "report.html":
            one, other = (re.sub(rb"[0-9.]+(?=\s?s<)|<td>[^<]*</td>", b"", data) for data in (one, other))
            continue
        assert one == other, file.name


def _without_times(summary: Any) -> Any:
    summary["stages"] = [stage["name"] for stage in summary["stages"] if stage["name"] != "report"]
    summary["wall_s"] = None
    return summary


def test_data_frames(spur: gearwear.Run, helical: gearwear.Run) -> None:
    pytest.importorskip("pandas")
    frames = spur.to_pandas()
    assert list(frames) == ["pinion", "wheel", "history", "profiles", "mesh_cycle"]
    assert same_bits(frames["pinion"]["wear_um"].to_numpy(), spur.pinion.wear_um)
    assert frames["pinion"].attrs["units"]["wear_um"] == "µm"
    assert "slices" in helical.to_pandas()


def test_data_sets(spur: gearwear.Run, helical: gearwear.Run) -> None:
    pytest.importorskip("xarray")
    for run in (spur, helical):
        data = run.to_xarray()
        assert data.wear_um.dims == ("gear", "slice", "point")
        assert same_bits(data.wear_um.sel(gear="wheel"), run.wheel.wear_um)
        assert same_bits(data.radius_mm.sel(gear="wheel"), run.wheel.radius_mm)
        assert data.wear_um.attrs["units"] == "µm" and data.load_share_new.dims == ("position",)
        assert same_bits(data.pinion_peak_wear_um, run.history["pinion_peak_wear_um"])
        assert same_bits(data.snapshot_wear_um.isel(snapshot=-1), data.wear_um)


def test_what_a_notebook_shows(spur: gearwear.Run, helical: gearwear.Run) -> None:
    for run in (spur, helical):
        page = run._repr_html_()
        assert "<svg" in page and "maximum wear" in page and "not verified" in page
    assert "not verified" in repr(spur) and "completed" in repr(spur)


def plotted(run: gearwear.Run, name: str) -> Any:
    """The plot of a drawing of the page, by its name."""
    plot = run.plot
    names: dict[str, Any] = {
        "load-sharing": plot.load_share,
        "lambda": plot.film_ratio,
        "map-wear": lambda gear: plot.map(gear),
        "map-sliding": lambda gear: plot.map(gear, "sliding_mm_per_mesh"),
        "map-pressure-new": lambda gear: plot.map(gear, "pressure_new_MPa"),
        "map-pressure-worn": lambda gear: plot.map(gear, "pressure_worn_MPa"),
        "map-modifications": lambda gear: plot.map(gear, "removed_um"),
        "slice-lambda": plot.slice_film_ratio,
    }
    before, _, last = name.rpartition("-")
    if last in ("pinion", "wheel", "new", "worn"):
        return (names.get(before) or getattr(plot, before.replace("-", "_")))(last)
    return (names.get(name) or getattr(plot, name.replace("-", "_")))()


def test_every_drawing_has_a_plot(spur: gearwear.Run, helical: gearwear.Run) -> None:
    pytest.importorskip("matplotlib").use("agg")
    from matplotlib import pyplot

    oil = {
        "lubricant": {"viscosity_class": 100, "temperature_C": 90.0},
        "temperature": {"bulk_temperature_C": 90.0},
        "pair.{pinion,wheel}.roughness_Ra_um": 0.5,
    }
    oiled = [scene.with_(oil).run() for scene in (spur_scene(), helical_scene())]
    assert {"film", "lambda", "temperature", "peclet"} <= oiled[0].figures().keys()
    assert "slice-lambda-worn" in oiled[1].figures()
    for run in (spur, helical, *oiled):
        for name in run.figures():
            axes = plotted(run, name)
            assert axes.get_xlabel() and axes.get_ylabel() and axes.get_title(), name
            marks = {text.get_text() for text in axes.texts}
            marked = not name.startswith(("history", "over-width", "mesh-orders"))
            assert marks == (set("ABCDE") if marked else set()), name
            axes.figure.canvas.draw()
            pyplot.close("all")
    axes = spur.plot.wear()
    assert axes.get_ylabel() == "wear depth, µm" and len(axes.lines) == 2
    assert spur.plot.mesh_stiffness().get_ylabel() == "mesh stiffness, N/(mm·µm)"
    assert spur.plot.load_share().get_ylabel() == "load share"
    pyplot.close("all")
    with pytest.raises(ValueError, match="gear: found 'sun'; allowed: 'pinion', 'wheel'"):
        spur.plot.pressure("sun")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="one with slices"):
        spur.plot.map()
    with pytest.raises(ValueError, match="without films"):
        spur.plot.film()
    with pytest.raises(ValueError, match="without temperature rise"):
        spur.plot.temperature()


def identifiers(svg: str) -> set[str]:
    return set(re.findall(r'id="([^"]+)"', svg)) | set(re.findall(r"url\(#([^)]+)\)", svg))


def test_drawings_on_one_page_do_not_cut_each_other(spur: gearwear.Run) -> None:
    """Identifiers are of the content: another run has others, the same one the same bytes."""
    other = spur_scene().with_({"operation.pinion_torque_Nm": 250.0}).run()
    assert spur_scene().run().figures() == spur.figures()
    for name, svg in spur.figures().items():
        own, theirs = identifiers(svg), identifiers(other.figures()[name])
        assert len(own) == 1
        if svg != other.figures()[name]:
            assert not own & theirs, name


def test_progress_is_told() -> None:
    told: list[tuple[str, float]] = []
    scene = spur_scene().with_({"numerics.positions": 400, "numerics.flank_points": 750, "operation.hours": 200})
    scene.without("operation.snapshots_h").run(threads=1, progress=lambda stage, part: told.append((stage, part)))
    assert all(0 <= part <= 1 and stage for stage, part in told)


def test_the_scene_of_a_run_gives_the_run(spur: gearwear.Run) -> None:
    assert bits_of(spur.scene.run(threads=1)) == bits_of(spur)
