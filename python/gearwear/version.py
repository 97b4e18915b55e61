"""The version that pickled results are of."""

from gearwear import _native


def refuse_other(version: str) -> None:
    """Raises where a result is of another version: its bytes mean something else here."""
    if version != _native.VERSION:
        raise ValueError(f"found a result of gearwear {version}; allowed: results of this version, {_native.VERSION}")
