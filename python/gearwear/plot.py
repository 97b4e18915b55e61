"""Plots of a run with matplotlib. Each takes the axes to draw on, and gives them back."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from gearwear.run import Flank, Gear, Run


def _axes(axes: Axes | None) -> Axes:
    if axes is not None:
        return axes
    from matplotlib import pyplot

    return pyplot.subplots()[1]


def _label(name: str, meaning: str) -> str:
    from gearwear import unit_of

    unit = unit_of(name)
    return f"{meaning}, {unit}" if unit else meaning


class Plots:
    """The plots of a run."""

    def __init__(self, run: Run) -> None:
        self._run = run

    def wear(self, gear: Gear | None = None, axes: Axes | None = None) -> Axes:
        """Wear depth over the flank of one gear, or of both; where the pair has slices, the maximum over the face width."""
        axes = _axes(axes)
        for name in self._gears(gear):
            flank: Flank = getattr(self._run, name)
            axes.plot(flank.roll_angle_deg, _greatest(flank.wear_um), label=name)
        return self._finished(axes, "roll_angle_deg", "roll angle", "wear_um", "wear depth")

    def pressure(self, gear: Gear = "pinion", axes: Axes | None = None) -> Axes:
        """Maximum pressure during one mesh over the flank of a gear, new and worn."""
        axes = _axes(axes)
        flank: Flank = getattr(self._run, self._gears(gear)[0])
        axes.plot(flank.roll_angle_deg, _greatest(flank.pressure_new_MPa), label="new")
        axes.plot(flank.roll_angle_deg, _greatest(flank.pressure_worn_MPa), label="worn")
        return self._finished(axes, "roll_angle_deg", "roll angle", "pressure_new_MPa", f"pressure of the {gear}")

    def load_share(self, axes: Axes | None = None) -> Axes:
        """Load share of a tooth pair over the path of contact, new and worn."""
        return self._cycle(axes, "load_share", "", "load share")

    def transmission_error(self, axes: Axes | None = None) -> Axes:
        """Loaded transmission error over the path of contact, new and worn."""
        return self._cycle(axes, "transmission_error", "_um", "transmission error")

    def history(self, axes: Axes | None = None) -> Axes:
        """Maximum wear of both gears over the life."""
        axes = _axes(axes)
        history = self._run.history
        for gear in ("pinion", "wheel"):
            axes.plot(history["revolutions"], history[f"{gear}_peak_wear_um"], marker=".", label=gear)
        return self._finished(axes, "revolutions", "pinion revolutions", "wear_um", "maximum wear depth")

    def _cycle(self, axes: Axes | None, name: str, unit: str, meaning: str) -> Axes:
        axes = _axes(axes)
        cycle = self._run.mesh_cycle
        for state in ("new", "worn"):
            axes.plot(cycle["position_mm"], cycle[f"{name}_{state}{unit}"], label=state)
        return self._finished(axes, "position_mm", "contact position", name + unit, meaning)

    def _finished(self, axes: Axes, x: str, x_meaning: str, y: str, y_meaning: str) -> Axes:
        axes.set(xlabel=_label(x, x_meaning), ylabel=_label(y, y_meaning), title=self._run.summary["title"])
        axes.legend()
        return axes

    @staticmethod
    def _gears(gear: str | None) -> tuple[str, ...]:
        if gear is None:
            return ("pinion", "wheel")
        if gear not in ("pinion", "wheel"):
            raise ValueError(f"gear: found {gear!r}; allowed: 'pinion', 'wheel'")
        return (gear,)


def _greatest(field: Any) -> Any:
    """A field over the flank, its maximum over the face width at each point."""
    return field if field.ndim == 1 else field.max(axis=0)
