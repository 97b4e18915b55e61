"""What the tests share: one short run of a spur pair, and one of a helical pair."""

from __future__ import annotations

from pathlib import Path

import pytest
from short_scenes import helical_scene, spur_scene

import gearwear

@pytest.fixture(scope="session")
def spur() -> gearwear.Run:
    return spur_scene().run(threads=1)


@pytest.fixture(scope="session")
def helical() -> gearwear.Run:
    return helical_scene().run(threads=1)


@pytest.fixture(scope="session")
def handed_scenes() -> list[Path]:
    """The scenes that `cargo test --release --test commands bad_input` found refused."""
    folder = Path(__file__).parents[2] / "target" / "tmp" / "bad_input"
    return sorted(folder.glob("*.toml"))
