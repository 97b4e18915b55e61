"""Measured profiles as the files that ``gearwear compare`` reads."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, Union

#: A file, or its columns: a dict, or a data frame of pandas.
Profile = Union[str, "os.PathLike[str]", Mapping[str, Any], Any]

GEARS = ("pinion", "wheel")


def profiles(measured: Profile | Sequence[Profile] | Mapping[str, Profile]) -> list[tuple[str, str | None]]:
    """The names of profiles, and their texts where they are no files."""
    if isinstance(measured, Mapping) and measured and all(key in GEARS for key in measured):
        return [_profile(profile, gear) for gear, profile in measured.items()]
    if isinstance(measured, (str, os.PathLike, Mapping)) or _is_frame(measured):
        return [_profile(measured, None)]
    if not isinstance(measured, Sequence):
        raise TypeError(f"measured: found {type(measured).__name__}; allowed: a file, a dict or data frame of columns, or a list of two")
    return [_profile(profile, None) for profile in measured]


def table(measured: Profile) -> tuple[str, str | None]:
    """The name of a table of wear measured at several times, and its text where it is no file."""
    if isinstance(measured, (str, os.PathLike)):
        return os.fspath(measured), None
    if not (isinstance(measured, Mapping) or _is_frame(measured)):
        raise TypeError(f"table: found {type(measured).__name__}; allowed: a file, or a dict or data frame of columns")
    import numpy as np

    lines, columns = [], {}
    for key in measured:
        values = np.asarray(measured[key])
        if values.ndim == 0:
            lines.append(f"# {key} = {values.item()}")
        elif values.ndim == 1:
            columns[key] = [_field(key, value) for value in values.tolist()]
        else:
            raise ValueError(f"table: {key}: found an array of {values.ndim} dimensions; allowed: one")
    _check_lengths("table", columns)
    lines.append(",".join(columns))
    lines += [",".join(row) for row in zip(*columns.values())]
    return "table", "\n".join(lines) + "\n"


def _field(key: str, value: object) -> str:
    """A value as a field; none where it is missing."""
    if value is None or value != value:
        return ""
    if isinstance(value, str):
        return f'"{value}"'
    return str(int(value)) if key == "tooth" and isinstance(value, float) and value.is_integer() else repr(value)


def _check_lengths(name: str, columns: Mapping[str, Sequence[object]]) -> None:
    lengths = {key: len(values) for key, values in columns.items()}
    if len(set(lengths.values())) > 1:
        found = ", ".join(f"{length} of {key}" for key, length in lengths.items())
        raise ValueError(f"{name}: found {found}; allowed: as many of each")


def _is_frame(profile: object) -> bool:
    return hasattr(profile, "columns") and hasattr(profile, "to_numpy")


def _profile(profile: Profile, gear: str | None) -> tuple[str, str | None]:
    if isinstance(profile, (str, os.PathLike)):
        return os.fspath(profile), None
    name = gear or "measured"
    if not (isinstance(profile, Mapping) or _is_frame(profile)):
        raise TypeError(f"{name}: found {type(profile).__name__}; allowed: a file, or a dict or data frame of columns")
    return name, _text(name, profile, gear)


def _text(name: str, profile: Any, gear: str | None) -> str:
    """The file that says what the columns do."""
    import numpy as np

    lines = [] if gear is None else [f"# gear = {gear}"]
    columns: dict[str, list[float]] = {}
    for key in profile:
        values = np.asarray(profile[key])
        if values.ndim == 0:
            lines.append(f"# {key} = {values.item()}")
        elif values.ndim == 1:
            columns[key] = values.astype(float).tolist()
        else:
            raise ValueError(f"{name}: {key}: found an array of {values.ndim} dimensions; allowed: one")
    _check_lengths(name, columns)
    lines.append(",".join(columns))
    lines += [",".join(map(repr, row)) for row in zip(*columns.values())]
    return "\n".join(lines) + "\n"
