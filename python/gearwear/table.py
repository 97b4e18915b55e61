"""Tables: columns of numbers under the names of the CSV files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    import pandas as pd
    import xarray as xr

    from gearwear._native import Columns

    Array = np.ndarray[Any, np.dtype[Any]]


class Table(Mapping[str, "Array"]):
    """The columns of a CSV file as read-only arrays, ``table.NAME`` or ``table["NAME"]``."""

    def __init__(self, name: str, columns: Columns) -> None:
        import numpy as np

        self._name = name
        self._values = {column: np.asarray(values) for column, _, _, values in columns}
        #: the unit of each column; None where it has none
        self.units = {column: unit for column, unit, _, _ in columns}
        #: what each column holds
        self.meanings = {column: meaning for column, _, meaning, _ in columns}

    def __getattr__(self, name: str) -> Array:
        values: dict[str, Array] = self.__dict__.get("_values", {})
        try:
            return values[name]
        except KeyError:
            allowed = ", ".join(values)
            raise AttributeError(f"the table has no column {name}; allowed: {allowed}", name=name, obj=self) from None

    def __getitem__(self, name: str) -> Array:
        try:
            return self._values[name]
        except KeyError:
            raise KeyError(f"the table has no column {name}; allowed: {', '.join(self._values)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._values]

    def __repr__(self) -> str:
        rows = len(next(iter(self._values.values()), ()))
        return f"<{self._name}: {rows} rows of {', '.join(self._values)}>"

    def to_pandas(self) -> pd.DataFrame:
        """The table as a data frame; units and meanings are in its ``attrs``."""
        import pandas as pd

        frame = pd.DataFrame({name: values.copy() for name, values in self._values.items()})
        frame.attrs = {"units": self.units, "meanings": self.meanings}
        return frame

    def to_xarray(self, dimension: str = "row", coordinates: tuple[str, ...] = ()) -> xr.Dataset:
        """The table as a data set along one dimension; each variable has its unit and its meaning as attributes."""
        import xarray as xr

        variables = {name: (dimension, values, self.attributes(name)) for name, values in self._values.items()}
        coords = {name: variables.pop(name) for name in coordinates if name in variables}
        return xr.Dataset(variables, coords)

    def attributes(self, name: str) -> dict[str, str]:
        """Unit and meaning of a column, as xarray and its plots have them."""
        given = {"units": self.units[name], "long_name": self.meanings[name]}
        return {key: text for key, text in given.items() if text}
