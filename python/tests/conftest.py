"""What the tests share: one short run of a spur pair, and one of a helical pair."""

from __future__ import annotations

from pathlib import Path

import pytest

import gearwear

#: Seconds of computation rather than minutes: a life of an hour, nothing verified, few positions.
SHORT = {
    "operation.snapshots_h": [0.5, 1.0],
    "operation.hours": 1.0,
    "numerics.verify": False,
    "numerics.error_estimate": False,
    "numerics.positions": 60,
    "numerics.flank_points": 100,
    "stiffness.model": "weber-banaschek",
}


def spur_scene() -> gearwear.Scene:
    return gearwear.Scene.preset("fzg-c").with_(SHORT)


def helical_scene() -> gearwear.Scene:
    return gearwear.Scene.preset("helical").with_(
        SHORT, **{"helical.slices": 8, "helical.coupling": "none", "numerics.positions": 30}
    )


@pytest.fixture(scope="session")
def spur() -> gearwear.Run:
    return spur_scene().run(threads=1)


@pytest.fixture(scope="session")
def helical() -> gearwear.Run:
    return helical_scene().run(threads=1)


@pytest.fixture(scope="session")
def handed_scenes() -> list[Path]:
    """The scenes that `cargo test --test commands bad_input` found refused."""
    folder = Path(__file__).parents[2] / "target" / "tmp" / "bad_input"
    return sorted(folder.glob("*.toml"))
