"""Plots of a run with matplotlib: one for each drawing of its page. Each takes the axes to draw on, and gives them back."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from gearwear.run import Flank, Gear, Run, Slices
    from gearwear.table import Table

#: State of the flanks.
State = Literal["new", "worn"]

_STATES = ("new", "worn")
_GEARS = ("pinion", "wheel")
#: Fields over a flank with a map.
_FIELDS = ("wear_um", "pressure_new_MPa", "pressure_worn_MPa", "sliding_mm_per_mesh", "removed_um")


def _axes(axes: Axes | None) -> Axes:
    if axes is not None:
        return axes
    from matplotlib import pyplot

    return pyplot.subplots()[1]


def _label(name: str, meaning: str) -> str:
    from gearwear import unit_of

    unit = unit_of(name)
    return f"{meaning}, {unit}" if unit else meaning


def _one_of(key: str, value: str, allowed: tuple[str, ...]) -> str:
    if value not in allowed:
        raise ValueError(f"{key}: found {value!r}; allowed: {', '.join(map(repr, allowed))}")
    return value


class Plots:
    """The plots of a run. Those along a flank or the path of contact have the points A to E marked."""

    def __init__(self, run: Run) -> None:
        self._run = run

    def pair(self, axes: Axes | None = None) -> Axes:
        """The pair in mesh, to scale, in the transverse section: outlines, line of action, path of contact."""
        axes = _axes(axes)
        drawing = json.loads(self._run._native.drawing_json)
        for gear in _GEARS:
            axes.plot(*zip(*drawing["outline"][gear], strict=True), label=gear, linewidth=0.8)
        axes.plot(*zip(*drawing["line_of_action"], strict=True), label="line of action", linestyle="--", linewidth=0.8)
        for name, (x, y) in drawing["path_of_contact"]:
            axes.plot([x], [y], "k.", markersize=3)
            axes.annotate(name, (x, y), textcoords="offset points", xytext=(3, 3))
        axes.set_aspect("equal")
        return self._finished(axes, ("position_mm", "x"), ("position_mm", "y"))

    def wear(self, gear: Gear | None = None, axes: Axes | None = None) -> Axes:
        """Wear depth over the flank of one gear, or of both; where the pair has slices, the maximum over the face width.

        A to E are marked for one gear: the flanks of both lie at other roll angles.
        """
        axes = _axes(axes)
        gears = _GEARS if gear is None else (_one_of("gear", gear, _GEARS),)
        for name in gears:
            flank: Flank = getattr(self._run, name)
            axes.plot(flank.roll_angle_deg, _greatest(flank.wear_um), label=name)
        if len(gears) == 1:
            self._mark_flank(axes, gears[0])
        return self._finished(axes, ("roll_angle_deg", "roll angle"), ("wear_um", "wear depth"))

    def pressure(self, gear: Gear = "pinion", axes: Axes | None = None) -> Axes:
        """Maximum pressure during one mesh over the flank of a gear, new and worn."""
        fields = {state: f"pressure_{state}_MPa" for state in _STATES}
        return self._along_flank(axes, gear, fields, f"pressure of the {gear}")

    def modifications(self, gear: Gear = "pinion", axes: Axes | None = None) -> Axes:
        """Material that the modifications of a gear remove, over its flank."""
        return self._along_flank(axes, gear, {gear: "removed_um"}, "material removed")

    def load_share(self, axes: Axes | None = None) -> Axes:
        """Load share of a tooth pair over the path of contact, new and worn."""
        return self._cycle(axes, "load_share_{}", "load share")

    def transmission_error(self, axes: Axes | None = None) -> Axes:
        """Loaded transmission error over the path of contact, new and worn."""
        return self._cycle(axes, "transmission_error_{}_um", "transmission error")

    def transmission_error_over_torque(self, axes: Axes | None = None) -> Axes:
        """Transmission error, peak to peak, over the torque on the pinion, new and worn; of scenes with ``operation.torque_curve_Nm``."""
        curve = self._run.torque_curve
        if curve is None:
            raise ValueError("found a run without torques; allowed: one of a scene with operation.torque_curve_Nm")
        axes = _axes(axes)
        for state in _STATES:
            values = curve[f"transmission_error_peak_to_peak_{state}_um"]
            axes.plot(curve["pinion_torque_Nm"], values, marker=".", label=state)
        return self._finished(
            axes, ("pinion_torque_Nm", "torque on the pinion"), ("transmission_error_um", "transmission error, peak to peak")
        )

    def mesh_stiffness(self, axes: Axes | None = None) -> Axes:
        """Mesh stiffness per mm of face width over the path of contact, new and worn."""
        return self._cycle(axes, "mesh_stiffness_{}_N_per_mm_um", "mesh stiffness")

    def cycle_pressure(self, axes: Axes | None = None) -> Axes:
        """Maximum pressure of a tooth pair over the path of contact, new and worn."""
        return self._cycle(axes, "peak_pressure_{}_MPa", "maximum pressure")

    def temperature(self, axes: Axes | None = None) -> Axes:
        """Maximum rise of the contact temperature over the path of contact, new, by each method."""
        methods = {"heat_equation": "heat equation", "williams": "Williams", "tian_kennedy": "Tian and Kennedy"}
        columns = {meaning: f"temperature_rise_{method}_K" for method, meaning in methods.items()}
        return self._over_path(axes, self._run.mesh_cycle, columns, "temperature rise")

    def peclet(self, axes: Axes | None = None) -> Axes:
        """Peclet number of both surfaces over the path of contact, new."""
        return self._over_path(axes, self._run.mesh_cycle, {gear: f"peclet_{gear}" for gear in _GEARS}, "Peclet number")

    def film(self, axes: Axes | None = None) -> Axes:
        """Local film thickness over the path of contact, new and worn, of the slice in the middle of the face width."""
        return self._film(axes, "local_film_{}_um", "film thickness")

    def film_ratio(self, axes: Axes | None = None) -> Axes:
        """Film over roughness λ over the path of contact, new and worn, likewise."""
        return self._film(axes, "lambda_{}", "λ")

    def friction(self, axes: Axes | None = None) -> Axes:
        """Coefficient of friction over the path of contact, new and worn, likewise."""
        return self._film(axes, "friction_{}", "coefficient of friction")

    def history(self, axes: Axes | None = None) -> Axes:
        """Maximum wear of both gears over the life."""
        axes = _axes(axes)
        history = self._run.history
        for gear in _GEARS:
            axes.plot(history["revolutions"], history[f"{gear}_peak_wear_um"], marker=".", label=gear)
        return self._finished(axes, ("revolutions", "pinion revolutions"), ("wear_um", "maximum wear depth"))

    def map(self, gear: Gear = "pinion", field: str = "wear_um", axes: Axes | None = None) -> Axes:
        """A field over the flank of a gear in colours, face width across and radius upwards; of pairs with slices."""
        self._slices()
        flank: Flank = getattr(self._run, _one_of("gear", gear, _GEARS))
        values = getattr(flank, _one_of("field", field, _FIELDS))
        axes = _axes(axes)
        mesh = axes.pcolormesh(flank.width_mm, flank.radius_mm, values.T, shading="nearest")
        meaning = flank.table.meanings[field]
        axes.figure.colorbar(mesh, ax=axes, label=_label(field, field.split("_")[0]))
        for name, radius in self._run._native.path_points(gear):
            axes.axhline(radius, color="0.8", linewidth=0.6)
            axes.annotate(name, (1.0, radius), xycoords=("axes fraction", "data"), va="center")
        axes.set(xlabel="face width, mm", ylabel=f"radius on the {gear}, mm", title=meaning)
        return axes

    def slice_load(self, state: State = "new", axes: Axes | None = None) -> Axes:
        """Load of each slice per mm of face width in colours, over the mesh of one tooth; of pairs with slices."""
        slices = self._slices()
        load = getattr(slices, f"line_load_{_one_of('state', state, _STATES)}_N_per_mm")
        return self._over_mesh(axes, slices, load, "line load, N/mm", f"load of each slice, {state}")

    def slice_film_ratio(self, state: State = "new", axes: Axes | None = None) -> Axes:
        """λ of each slice in colours, over path of contact and face width; of pairs with slices and oil."""
        self._slices()
        film, column = self._films(), f"lambda_{_one_of('state', state, _STATES)}"
        axes = _axes(axes)
        points = axes.scatter(film["position_mm"], film["width_mm"], c=film[column], s=8, marker="s")
        axes.figure.colorbar(points, ax=axes, label="λ")
        self._mark_path(axes)
        axes.set(xlabel="contact position, mm", ylabel="face width, mm", title=f"λ, {state}")
        return axes

    def over_width(self, gear: Gear = "pinion", axes: Axes | None = None) -> Axes:
        """Root and tip wear of a gear over the face width, over their means, after the first mesh and at the end; of pairs with slices."""
        import numpy as np

        self._slices()
        helical = self._run.summary["helical"]
        wear = helical["wear"][_one_of("gear", gear, _GEARS)]
        axes = _axes(axes)
        for zone, style in (("root", "-"), ("tip", "--")):
            for key, when in (("_first_mesh_um", "first mesh"), ("_um", "end of the run")):
                values = np.array(wear[f"{zone}_wear{key}"])
                if values.mean() > 0.0:
                    axes.plot(helical["width_mm"], values / values.mean(), style, marker=".", label=f"{zone}, {when}")
        return self._finished(axes, ("width_mm", "face width"), ("", f"wear of the {gear} over its mean"))

    def mesh_orders(self, axes: Axes | None = None) -> Axes:
        """Amplitudes of the first mesh orders of the transmission error, new and worn."""
        axes = _axes(axes)
        for place, state in enumerate(_STATES):
            amplitudes = self._run.summary[state]["mesh_orders_um"]
            axes.bar([order + 0.4 * place - 0.2 for order in range(1, len(amplitudes) + 1)], amplitudes, 0.4, label=state)
        return self._finished(axes, ("", "multiple of the tooth-mesh frequency"), ("amplitude_um", "amplitude"))

    def _slices(self) -> Slices:
        slices = self._run.slices
        if slices is None:
            raise ValueError("found a pair whose sections are all alike; allowed: one with slices over the face width")
        return slices

    def _films(self) -> Table:
        film = self._run.film
        if film is None:
            raise ValueError("found a run without films and friction; allowed: one of a scene with [lubricant] or [friction]")
        return film

    def _film(self, axes: Axes | None, name: str, meaning: str) -> Axes:
        import numpy as np

        film = self._films()
        middle = film["slice"] == film["slice"].max() // 2
        table = {column: np.asarray(values)[middle] for column, values in film.items()}
        return self._over_path(axes, table, {state: name.format(state) for state in _STATES}, meaning)

    def _cycle(self, axes: Axes | None, name: str, meaning: str) -> Axes:
        return self._over_path(axes, self._run.mesh_cycle, {state: name.format(state) for state in _STATES}, meaning)

    def _over_path(self, axes: Axes | None, table: Any, columns: dict[str, str], meaning: str) -> Axes:
        import numpy as np

        if all(np.isnan(table[column]).all() for column in columns.values()):
            raise ValueError(f"found a run without {meaning}; allowed: one of a scene that asks for it")
        axes = _axes(axes)
        for label, column in columns.items():
            axes.plot(table["position_mm"], table[column], label=label)
        self._mark_path(axes)
        return self._finished(axes, ("position_mm", "contact position"), (next(iter(columns.values())), meaning))

    def _over_mesh(self, axes: Axes | None, slices: Slices, values: Any, label: str, title: str) -> Axes:
        axes = _axes(axes)
        mesh = axes.pcolormesh(slices.position_mm, slices.width_mm, values.T, shading="nearest")
        axes.figure.colorbar(mesh, ax=axes, label=label)
        self._mark_path(axes)
        axes.set(xlabel="position of the tooth, mm", ylabel="face width, mm", title=title)
        return axes

    def _along_flank(self, axes: Axes | None, gear: str, fields: dict[str, str], meaning: str) -> Axes:
        flank: Flank = getattr(self._run, _one_of("gear", gear, _GEARS))
        axes = _axes(axes)
        for label, field in fields.items():
            axes.plot(flank.roll_angle_deg, _greatest(getattr(flank, field)), label=label)
        self._mark_flank(axes, gear)
        return self._finished(axes, ("roll_angle_deg", "roll angle"), (next(iter(fields.values())), meaning))

    def _mark_flank(self, axes: Axes, gear: str) -> None:
        import numpy as np

        flank: Flank = getattr(self._run, gear)
        points = self._run._native.path_points(gear)
        _mark(axes, [(name, float(np.interp(radius, flank.radius_mm, flank.roll_angle_deg))) for name, radius in points])

    def _mark_path(self, axes: Axes) -> None:
        _mark(axes, list(self._run.summary["geometry"]["curvature_radius_mm"].items()))

    def _finished(self, axes: Axes, x: tuple[str, str], y: tuple[str, str]) -> Axes:
        axes.set(xlabel=_label(*x), ylabel=_label(*y))
        axes.set_title(self._run.summary["title"], pad=16)
        axes.legend()
        return axes


def _mark(axes: Axes, places: list[tuple[str, float]]) -> None:
    """Lines at the points A to E, with their names above."""
    for name, place in places:
        axes.axvline(place, color="0.6", linewidth=0.6, linestyle=":")
        axes.annotate(name, (place, 1.0), xycoords=("data", "axes fraction"), ha="center", va="bottom")


def _greatest(field: Any) -> Any:
    """A field over the flank, its maximum over the face width at each point."""
    return field if field.ndim == 1 else field.max(axis=0)
