"""Scenes of seconds."""

from __future__ import annotations

import gearwear

#: Seconds of computation rather than minutes: a life of an hour, nothing verified, few positions.
SHORT = {
    "operation.snapshots_h": None,
    "operation.snapshots_revolutions": [4500, 9000],
    "operation.pinion_revolutions": 9000,
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
