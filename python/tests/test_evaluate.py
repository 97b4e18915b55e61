"""Rows of values to outputs of the summary."""

from __future__ import annotations

import numpy as np
import pytest

import gearwear

TORQUE = "operation.pinion_torque_Nm"
PEAK = "pinion.peak_wear_um"


@pytest.fixture(scope="module")
def scene() -> gearwear.Scene:
    """A spur run of milliseconds whose only snapshot is its end."""
    return (
        gearwear.Scene.preset("thesis-spur")
        .without("operation.snapshots_h")
        .with_(
            {
                "operation.hours": 1.0,
                "contact.surface": "hertz-mean",
                "numerics.flank_points": 120,
                "numerics.positions": 60,
                "numerics.step": {"revolutions": 1000.0},
                "numerics.error_estimate": False,
                "numerics.verify": False,
            }
        )
    )


def test_rows_are_runs_and_threads_change_nothing(scene: gearwear.Scene) -> None:
    torques = np.array([[150.0], [302.0]])
    outputs = [PEAK, "worn.transmission_error_um.peak_to_peak"]
    found = gearwear.evaluate(scene, [TORQUE], torques, outputs)
    assert found.values.shape == (2, 2)
    assert found.status == (None, None)
    for row, torque in zip(found.values, torques[:, 0], strict=True):
        summary = scene.with_({TORQUE: float(torque), "operation.snapshots_h": [1.0]}).run(threads=1).summary
        assert row[0] == summary["pinion"]["peak_wear_um"]
        assert row[1] == summary["worn"]["transmission_error_um"]["peak_to_peak"]
    again = gearwear.evaluate(scene, [TORQUE], torques, outputs, threads=2)
    assert np.array_equal(found.values, again.values)


def test_a_failed_row_is_nan_and_says_why(scene: gearwear.Scene) -> None:
    rows: list[list[object]] = [["hertz", 300.0], ["hertz", -1.0], ["no-such-surface", 300.0]]
    found = gearwear.evaluate(scene, ["contact.surface", TORQUE], rows, [PEAK])
    assert np.isfinite(found.values[0, 0])
    assert np.isnan(found.values[1:, 0]).all()
    assert found.status[0] is None
    assert TORQUE in str(found.status[1])
    assert "contact.surface" in str(found.status[2])


def test_rows_as_a_frame(scene: gearwear.Scene) -> None:
    pandas = pytest.importorskip("pandas")
    rows = pandas.DataFrame({"surface": ["hertz", "hertz-mean", "rubber"], "torque": [200.0, 300.0, 300.0]})
    keys = ["contact.surface", TORQUE]
    found = gearwear.evaluate(scene, keys, rows, [PEAK])
    frame = found.to_pandas()
    assert list(frame) == [*keys, PEAK, "status"] and frame[TORQUE].tolist() == [200.0, 300.0, 300.0]
    assert frame[PEAK].to_numpy().tobytes() == found[PEAK].tobytes() == found.values[:, 0].tobytes()
    assert frame["status"].notna().tolist() == [False, False, True] and "1 failed" in repr(found)
    with pytest.raises(KeyError, match=f"found the output 'wear'; allowed: {PEAK}"):
        found["wear"]


def test_what_is_wrong_is_named(scene: gearwear.Scene) -> None:
    with pytest.raises(ValueError, match=r"operation.pinion_torqe_Nm.*operation.pinion_torque_Nm"):
        gearwear.evaluate(scene, ["operation.pinion_torqe_Nm"], [[1.0]], [PEAK])
    with pytest.raises(ValueError, match=r"pinion.peek_wear_um.*pinion.peak_wear_um"):
        gearwear.evaluate(scene, [TORQUE], [[1.0]], ["pinion.peek_wear_um"])
    with pytest.raises(ValueError, match="row 1: found 2 values; allowed: 1"):
        gearwear.evaluate(scene, [TORQUE], [[1.0], [1.0, 2.0]], [PEAK])
    with pytest.raises(ValueError, match="NaN; allowed: a finite number"):
        gearwear.evaluate(scene, [TORQUE], np.array([[np.nan]]), [PEAK])
    with pytest.raises(ValueError, match="1 dimensions; allowed: two"):
        gearwear.evaluate(scene, [TORQUE], np.array([1.0]), [PEAK])
    with pytest.raises(TypeError, match="keys"):
        gearwear.evaluate(scene, TORQUE, [[1.0]], [PEAK])
    with pytest.raises(TypeError, match=f"{TORQUE}: found a value of type"):
        gearwear.evaluate(scene, [TORQUE], [[object()]], [PEAK])


def test_figures_are_called_as_in_the_summary(scene: gearwear.Scene) -> None:
    figures = {figure.name: figure for figure in gearwear.main_figures()}
    assert (figures[PEAK].unit, figures["worn.transmission_error_um.peak_to_peak"].unit) == ("µm", "µm")
    assert gearwear.unit_of("worn.transmission_error_um.peak_to_peak") == "µm"
    new = gearwear.evaluate(scene, [TORQUE], [[200.0]], [PEAK])
    with pytest.warns(UserWarning, match=f"pinion_peak_wear_um is now called {PEAK}"):
        old = gearwear.evaluate(scene, [TORQUE], [[200.0]], ["pinion_peak_wear_um"])
    assert np.array_equal(old.values, new.values)
    with pytest.warns(UserWarning, match=f"pinion_peak_wear_um is now called {PEAK}"):
        swept = gearwear.sweep(scene, {TORQUE: [200.0]}, best="pinion_peak_wear_um")
    assert swept.summary["goal"]["figure"] == PEAK
