"""Pictures of answers, by matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional, Sequence, Union

import numpy as np

from . import _core
from ._types import Objective

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray


def plot(
    what: Union[_core.PostureCurve, _core.Grasp, Sequence[_core.Grasp]],
    axes: Optional[Axes] = None,
    *,
    best: Optional[_core.BestSpatialPosture] = None,
) -> Axes:
    """Draws the force norm sqrt(V) [N] over all postures. Without axes, it makes its own figure.

    A posture curve, or a grasp in the plane: over the angle [degrees]. Each arc is drawn from its
    formula, from end to end; unholdable postures are grey, minima are marked with their kind.

    A grasp in space, or a list of scenarios: on the sphere of postures, seen from both ends of the
    object's z axis, in maps of equal area. Colours end at ten times the least norm; unholdable
    postures are hatched. The minima of best are marked, without it those of best_posture.
    """
    if axes is None:
        import matplotlib.pyplot as plt

        axes = plt.figure(layout="constrained").add_subplot()
    if isinstance(what, _core.PostureCurve):
        return _plot_curve(what, axes)
    grasps = [what] if isinstance(what, _core.Grasp) else list(what)
    if len(grasps) == 1 and grasps[0].dimension == 2:
        return _plot_curve(_core.posture_curve(grasps[0]), axes)
    return _plot_sphere(grasps, best, axes)


def _plot_curve(curve: _core.PostureCurve, axes: Axes) -> Axes:
    first, last = np.degrees([curve.domain.from_, curve.domain.to])
    is_grip = curve.objective == Objective.grip

    def height(value: Any) -> Any:
        least = np.maximum(value, 0)
        return least if is_grip else np.sqrt(least)

    for turn in (-360, 0, 360):  # arcs may run on beyond the end of the domain
        for arc in curve.arcs:
            theta = np.linspace(arc.from_, arc.to, 2 + int(60 * (arc.to - arc.from_)))
            axes.plot(np.degrees(theta) + turn, height(arc.value(theta)), color="C0")
        for gap in curve.unholdable_arcs:
            ends = np.degrees([gap.from_, gap.to]) + turn
            axes.axvspan(*ends, color="0.9", linewidth=0)
        for optimum in curve.optima:
            angle = np.degrees(optimum.angle)
            if optimum.maximum or not first <= angle + turn <= last:
                continue
            here = height(optimum.value)
            axes.plot(angle + turn, here, "o", color="C3")
            axes.annotate(
                f"{angle:.2f}°, {here:.4g}\n{optimum.kind.value}",
                (angle + turn, here),
                xytext=(0, -8),
                textcoords="offset points",
                ha="center",
                va="top",
                fontsize="small",
            )
    axes.set_xlim(first, last)
    axes.set_ylim(bottom=0)
    axes.set_xlabel("posture: turned counter-clockwise by [degrees]")
    axes.set_ylabel("grip to command" if is_grip else "force norm [N]")
    return axes


#: Where the discs of the two hemispheres are drawn.
_CENTRE = 1.3


def _on_map(up: NDArray[np.float64]) -> NDArray[np.float64]:
    """Lambert's azimuthal equal-area map of the hemisphere in which up lies, as a unit disc.

    The left one is seen from +z, the right one from -z, turned about the y axis.
    """
    x, y, z = up
    scale = 1 / np.sqrt(1 + abs(z))
    return np.array([x * scale - _CENTRE, y * scale] if z >= 0 else [_CENTRE - x * scale, y * scale])


def _plot_sphere(
    grasps: Sequence[_core.Grasp], best: Optional[_core.BestSpatialPosture], axes: Axes
) -> Axes:
    from matplotlib.colors import LogNorm
    from matplotlib.patches import Circle

    if best is None:
        answer = _core.best_posture(list(grasps))
        assert isinstance(answer, _core.BestSpatialPosture)
        best = answer

    pixels = 241
    side = (np.arange(pixels) + 0.5) / pixels * 2 - 1
    u, v = np.meshgrid(side, side)
    beyond = np.maximum(np.hypot(u, v), 1)  # the rim goes on: the disc's edge cuts pixels
    u, v = u / beyond, v / beyond
    z = np.maximum(1 - u**2 - v**2, 0)
    x, y = u * np.sqrt(1 + z), v * np.sqrt(1 + z)

    norms = []
    for sign in (1, -1):
        ups = np.column_stack([sign * x.ravel(), y.ravel(), sign * z.ravel()])
        effort = np.max([_core.hold_many(grasp, ups).effort for grasp in grasps], axis=0)
        norms.append(np.sqrt(effort).reshape(pixels, pixels))
    finite = np.array(norms)[np.isfinite(norms)]
    known = finite if best.best is None else np.append(finite, np.sqrt(best.best.effort))
    least = known.min() if known.size else 1.0
    most = min(max(finite.max(), 1.01 * least), 10 * least) if finite.size else 2 * least

    for sign, picture in zip((1, -1), norms):
        centre = (-sign * _CENTRE, 0)
        disc = axes.add_patch(
            Circle(centre, 1, facecolor="0.9", edgecolor="0.6", hatch="////", linewidth=0)
        )
        image = axes.imshow(
            np.where(np.isfinite(picture), picture, np.nan),
            extent=(centre[0] - 1, centre[0] + 1, -1, 1),
            origin="lower",
            cmap="viridis_r",
            norm=LogNorm(least, most),
            clip_path=disc,
            zorder=2,
        )
        axes.add_patch(Circle(centre, 1, fill=False, edgecolor="0.3", zorder=3))
        name = "+z" if sign > 0 else "−z"
        axes.text(-sign * _CENTRE, 1.26, f"{name} upwards", ha="center", va="bottom")
        for label, x_text, y_text, ha, va in [
            ("+x" if sign > 0 else "−x", 1.06, 0, "left", "center"),
            ("−x" if sign > 0 else "+x", -1.06, 0, "right", "center"),
            ("+y", 0, 1.05, "center", "bottom"),
            ("−y", 0, -1.05, "center", "top"),
        ]:
            axes.text(centre[0] + x_text, y_text, label, ha=ha, va=va, color="0.4")
    for k, posture in reversed(list(enumerate(best.minima))):
        text = f"{np.sqrt(posture.effort):.4g} N, {posture.manner.value}"
        axes.plot(
            *_on_map(posture.up),
            "*" if k == 0 else "o",
            markersize=16 if k == 0 else 8,
            color="white",
            markeredgecolor="black",
            zorder=4,
            linestyle="none",
            label=("best: " if k == 0 else "minimum: ") + text,
        )
    if best.minima:
        handles, labels = axes.get_legend_handles_labels()
        seen = dict(zip(reversed(labels), reversed(handles)))  # equal ones once
        axes.legend(
            seen.values(), seen.keys(), loc="upper center", bbox_to_anchor=(0.5, 0.0), frameon=False
        )
    if finite.size:
        bar = axes.figure.colorbar(
            image,
            ax=axes,
            label="force norm [N]",
            extend="max" if finite.max() > most else "neither",
            ticks=np.geomspace(least, most, 6),
            format="%.3g",
            shrink=0.7,
        )
        bar.ax.minorticks_off()
    axes.set_xlim(-2.6, 2.6)
    axes.set_ylim(-1.3, 1.5)
    axes.set_aspect("equal")
    axes.set_axis_off()
    return axes
