"""The course of a contact pressure along a surface, reduced to the figures that are compared."""

from typing import NamedTuple

# Only where the pressure is above this part of the greatest is the ellipse fitted, that is within 0.87 half-widths: near its
# ends the penalty, CalculiX's extrapolation to nodes and the mesh blur the pressure over an element.
FITTED_ABOVE = 0.5


class Ellipse(NamedTuple):
    peak_mpa: float
    half_width_mm: float
    centre_mm: float


def hertz_ellipse(along_mm, pressure_mpa):
    """The ellipse p² = p₀² (1 − (s − s₀)²/a²), by least squares in p²."""
    least = FITTED_ABOVE * max(pressure_mpa)
    rows = [(s, p * p) for s, p in zip(along_mm, pressure_mpa) if p > least]
    middle = sum(s for s, _ in rows) / len(rows)
    power = [sum((s - middle) ** k for s, _ in rows) for k in range(5)]
    right = [sum((s - middle) ** k * squared for s, squared in rows) for k in range(3)]
    c0, c1, c2 = _solve([[power[i + j] for j in range(3)] for i in range(3)], right)
    peak_squared = c0 - c1 * c1 / (4.0 * c2)
    return Ellipse(peak_squared ** 0.5, (-peak_squared / c2) ** 0.5, middle - 0.5 * c1 / c2)


def mirrored(along_mm, pressure_mpa):
    """The whole course of a problem of which only along_mm ≥ 0 was solved."""
    half = sorted(zip(along_mm, pressure_mpa))
    whole = [(-s, p) for s, p in reversed(half) if s > 0.0] + half
    return [s for s, _ in whole], [p for _, p in whole]


def _solve(matrix, right):
    """Gauss elimination with pivoting."""
    rows = [[*row, value] for row, value in zip(matrix, right)]
    n = len(rows)
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(i + 1, n):
            factor = rows[k][i] / rows[i][i]
            rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    solution = [0.0] * n
    for i in reversed(range(n)):
        solution[i] = (rows[i][n] - sum(rows[i][k] * solution[k] for k in range(i + 1, n))) / rows[i][i]
    return solution
