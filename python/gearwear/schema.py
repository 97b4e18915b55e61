"""The schema of the scene."""

from __future__ import annotations

import json
from typing import Any

from gearwear import _native


def scene_schema() -> dict[str, Any]:
    """Every key of the scene with its meaning, unit, range and default, as JSON schema."""
    schema: dict[str, Any] = json.loads(_native.scene_schema())
    return schema
