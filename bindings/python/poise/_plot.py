"""Pictures of answers, by matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Optional

import numpy as np

from . import _core

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def plot(curve: _core.PostureCurve, axes: Optional[Axes] = None) -> Axes:
    """Draws the force norm sqrt(V) [N] of a posture curve over the angle [degrees].

    Each arc is drawn from its formula, from end to end; unholdable postures are grey, minima are
    marked with their kind. Without axes, it makes a figure of its own.
    """
    if axes is None:
        import matplotlib.pyplot as plt

        axes = plt.figure(layout="constrained").add_subplot()

    first, last = np.degrees([curve.domain.from_, curve.domain.to])
    for turn in (-360, 0, 360):  # arcs may run on beyond the end of the domain
        for arc in curve.arcs:
            theta = np.linspace(arc.from_, arc.to, 2 + int(60 * (arc.to - arc.from_)))
            norm = np.sqrt(np.maximum(arc.V(theta), 0))
            axes.plot(np.degrees(theta) + turn, norm, color="C0")
        for gap in curve.unholdable_arcs:
            ends = np.degrees([gap.from_, gap.to]) + turn
            axes.axvspan(*ends, color="0.9", linewidth=0)
        for optimum in curve.optima:
            angle = np.degrees(optimum.angle)
            if optimum.maximum or not first <= angle + turn <= last:
                continue
            norm = np.sqrt(optimum.effort)
            axes.plot(angle + turn, norm, "o", color="C3")
            axes.annotate(
                f"{angle:.2f}°, {norm:.4g} N\n{optimum.kind.value}",
                (angle + turn, norm),
                xytext=(0, -8),
                textcoords="offset points",
                ha="center",
                va="top",
                fontsize="small",
            )
    axes.set_xlim(first, last)
    axes.set_ylim(bottom=0)
    axes.set_xlabel("posture: turned counter-clockwise by [degrees]")
    axes.set_ylabel("force norm [N]")
    return axes
