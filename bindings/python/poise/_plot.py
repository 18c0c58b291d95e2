"""Pictures of answers, by matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from ._types import Objective, Status

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray


class Plot:
    """Draws the force norm sqrt(V) [N] over all postures. Without axes, it makes its own figure.

    A posture curve, or a grasp in the plane: over the angle [degrees]. Each arc is drawn from its
    formula, from end to end; unholdable postures are grey, minima are marked with their kind.

    A grasp in space: on the sphere of postures, seen from both ends of the object's z axis, in maps
    of equal area. Colours end at ten times the least norm; unholdable postures are hatched. The
    minima of best are marked, without it those of best_posture.

    plot.turn draws a turn.
    """

    def __call__(
        self,
        what: Union[_core.PostureCurve, _core.Grasp],
        axes: Optional[Axes] = None,
        *,
        best: Optional[_core.BestSpatialPosture] = None,
    ) -> Axes:
        axes = axes or _new_axes()
        if isinstance(what, _core.PostureCurve):
            return _plot_curve(what, axes)
        if what.dimension == 2:
            return _plot_curve(_core.posture_curve(what), axes)
        return _plot_sphere(what, best, axes)

    def turn(
        self, turn: Union[_core.PlanarTurn, _core.SpatialTurn], axes: Optional[Axes] = None
    ) -> Axes:
        """Draws the grip, or the force norm sqrt(V) [N], over the angle of a turn [degrees].

        In the plane one way round is on either side of the start; in space the straight turn and
        the way of least peak start together, and the corners of the way are squares. Peaks are
        marked, stretches that cannot be held are grey. Every way reaches the dashed line.
        """
        axes = axes or _new_axes()
        if isinstance(turn, _core.PlanarTurn):
            return _plot_planar_turn(turn, axes)
        return _plot_spatial_turn(turn, axes)

    def __repr__(self) -> str:
        return "poise.plot"


plot = Plot()


def _new_axes() -> Axes:
    import matplotlib.pyplot as plt

    return plt.figure(layout="constrained").add_subplot()


def _height(value: Any, objective: Objective) -> Any:
    """What is drawn of V or F."""
    least = np.maximum(value, 0)
    return least if objective == Objective.grip else np.sqrt(least)


def _height_label(objective: Objective) -> str:
    return "grip to command" if objective == Objective.grip else "force norm [N]"


def _plot_curve(curve: _core.PostureCurve, axes: Axes) -> Axes:
    first, last = np.degrees([curve.domain.from_, curve.domain.to])
    for turn in (-360, 0, 360):  # arcs may run on beyond the end of the domain
        for arc in curve.arcs:
            theta = np.linspace(arc.from_, arc.to, 2 + int(60 * (arc.to - arc.from_)))
            height = _height(arc.value(theta), curve.objective)
            axes.plot(np.degrees(theta) + turn, height, color="C0")
        for gap in curve.unholdable_arcs:
            ends = np.degrees([gap.from_, gap.to]) + turn
            axes.axvspan(*ends, color="0.9", linewidth=0)
        for optimum in curve.optima:
            angle = np.degrees(optimum.angle)
            if optimum.maximum or not first <= angle + turn <= last:
                continue
            here = _height(optimum.value, curve.objective)
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
    axes.set_ylabel(_height_label(curve.objective))
    return axes


def _plot_planar_turn(turn: _core.PlanarTurn, axes: Axes) -> Axes:
    curve = _core.posture_curve(
        turn.grasp, force_cap=turn.force_cap, objective=turn.objective
    )
    drawn, peaks = [], []
    ways: List[_core.TurnPeak] = [turn] if turn.other is None else [turn, turn.other]
    for color, way in zip(("C0", "C1"), ways):
        angles, values = _planar_values(curve, turn.from_, way.angle)
        side = "counter-clockwise" if way.angle >= 0 else "clockwise"
        label = f"{_degrees(way.angle)} {side}: {_most(turn, way)}"
        _draw_way(axes, turn, angles, values, color, label)
        _shade(axes, way)
        drawn.append(values)
        peaks.append((way.at, way.peak))
    axes.set_xlabel("turned counter-clockwise by [degrees]")
    _mark_ends(axes, turn, [way.angle for way in ways])
    return _finish_turn(axes, turn, ways, np.concatenate(drawn), peaks)


def _planar_values(
    curve: _core.PostureCurve, start: float, angle: float
) -> Tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Angles from the start on, and V or F there; nan between arcs that do not meet."""
    low, high = min(0.0, angle), max(0.0, angle)
    parts = []
    for arc in curve.arcs:
        for whole in range(-3, 4):
            shift = 2 * np.pi * whole - start
            first, last = max(low, arc.from_ + shift), min(high, arc.to + shift)
            if first < last:
                theta = np.linspace(first, last, 2 + int(60 * (last - first)))
                parts.append((theta, arc.value(theta - shift)))
    parts.sort(key=lambda part: float(part[0][0]))
    angles, values = [np.zeros(0)], [np.zeros(0)]
    for theta, value in parts:
        if angles[-1].size and theta[0] > angles[-1][-1] + 1e-7:
            angles.append(theta[:1])
            values.append(np.array([np.nan]))
        angles.append(theta)
        values.append(value)
    return np.concatenate(angles), np.concatenate(values)


def _plot_spatial_turn(turn: _core.SpatialTurn, axes: Axes) -> Axes:
    way = turn.way
    angles, ups = _between(turn.from_, turn.then.up)
    values = _spatial_values(turn, ups)
    is_least = way is not None and len(way.ups) == 2
    name = "straight, the way of least peak" if is_least else "straight"
    label = f"{_degrees(turn.angle)} {name}: {_most(turn, turn)}"
    _draw_way(axes, turn, angles, values, "C0", label)
    _shade(axes, turn)
    drawn, peaks, ends = [values], [(turn.at, turn.peak)], [turn.angle]
    if way is not None and len(way.ups) > 2:
        angles, values, corners = _along(turn, way)
        label = f"{_degrees(angles[-1])} way of least peak: at most "
        _draw_way(
            axes, turn, angles, values, "C1", label + f"{_height(way.peak, turn.objective):.4g}"
        )
        inner = corners[1:-1]
        heights = _height(values[inner], turn.objective)
        axes.plot(np.degrees(angles[inner]), heights, "s", markersize=4, color="C1")
        drawn.append(values)
        peaks.append((angles[values.argmax()], values.max()))
        ends.append(angles[-1])
    if way is not None and np.isfinite(way.lower_bound):
        least = _height(way.lower_bound, turn.objective)
        label = f"every way needs at least {least:.4g}"
        axes.axhline(least, color="0.5", linestyle="--", linewidth=1, label=label)
    if way is not None and way.status == Status.unholdable:
        axes.plot([], [], " ", label="no way leads there")
    axes.set_xlabel("turned by [degrees]")
    _mark_ends(axes, turn, ends)
    return _finish_turn(axes, turn, [turn], np.concatenate(drawn), peaks)


def _between(
    orientation: NDArray[np.float64], up: NDArray[np.float64]
) -> Tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Angles of the smallest turn from an orientation to a posture, and the postures there."""
    rotation = _core.smallest_turn(orientation, up)
    sine = np.linalg.norm(rotation[1:])
    axis = rotation[1:] / sine if sine > 0 else np.array([1.0, 0, 0])
    angles = np.linspace(0, 2 * np.arctan2(sine, rotation[0]), 2 + int(120 * sine))
    # The world's z, turned back; the axis is level.
    z = np.array([0.0, 0, 1])
    back = np.outer(np.cos(angles), z) - np.outer(np.sin(angles), np.cross(axis, z))
    w, v = orientation[0], -orientation[1:]
    return angles, back + 2 * np.cross(v, np.cross(v, back) + w * back)


def _along(
    turn: _core.SpatialTurn, way: _core.Way
) -> Tuple[NDArray[np.float64], NDArray[np.float64], List[int]]:
    """Angles of a way, V or F there, and the indices of its corners."""
    angles, ups, corners = [np.zeros(1)], [way.ups[:1]], [0]
    for orientation, up in zip(way.orientations, way.ups[1:]):
        step, between = _between(orientation, up)
        angles.append(angles[-1][-1] + step[1:])
        ups.append(between[1:])
        corners.append(corners[-1] + len(step) - 1)
    return np.concatenate(angles), _spatial_values(turn, np.concatenate(ups)), corners


def _spatial_values(
    turn: _core.SpatialTurn, ups: NDArray[np.float64]
) -> NDArray[np.float64]:
    holds = _core.hold_many(
        turn.grasp, ups, force_cap=turn.force_cap, objective=turn.objective
    )
    if turn.objective == Objective.effort:
        return holds.effort
    return np.array([hold.grip if hold.holdable else np.inf for hold in holds])


def _degrees(angle: float) -> str:
    return f"{abs(np.degrees(angle)):.1f}°"


def _most(turn: Union[_core.PlanarTurn, _core.SpatialTurn], way: _core.TurnPeak) -> str:
    if not np.isfinite(way.peak):
        return "cannot be held all along"
    return f"at most {_height(way.peak, turn.objective):.4g}"


def _draw_way(
    axes: Axes,
    turn: Union[_core.PlanarTurn, _core.SpatialTurn],
    angles: NDArray[np.float64],
    values: NDArray[np.float64],
    color: str,
    label: str,
) -> None:
    heights = _height(np.where(np.isfinite(values), values, np.nan), turn.objective)
    axes.plot(np.degrees(angles), heights, color=color, label=label)


def _mark_ends(
    axes: Axes, turn: Union[_core.PlanarTurn, _core.SpatialTurn], angles: Sequence[float]
) -> None:
    ends = [(0.0, turn.now.value), *((angle, turn.then.value) for angle in angles)]
    drawn = [(np.degrees(at), _height(value, turn.objective)) for at, value in ends]
    held = [each for each in drawn if np.isfinite(each[1])]
    if not held:
        return
    told = [
        f"{name} {_height(posture.value, turn.objective):.4g}"
        for name, posture in (("now", turn.now), ("there", turn.then))
        if posture.holdable
    ]
    style = {"color": "black", "markerfacecolor": "white", "linestyle": "none"}
    axes.plot(*np.transpose(held), marker="o", label=", ".join(told), **style)


def _shade(axes: Axes, way: _core.TurnPeak) -> None:
    for stretch in way.unholdable:
        ends = np.degrees([stretch.from_, stretch.to])
        axes.axvspan(ends.min(), ends.max(), color="0.9", linewidth=0)


def _finish_turn(
    axes: Axes,
    turn: Union[_core.PlanarTurn, _core.SpatialTurn],
    ways: Sequence[_core.TurnPeak],
    values: NDArray[np.float64],
    peaks: Sequence[Tuple[float, float]],
) -> Axes:
    """values: all that are drawn; peaks: of each way, its angle and its value."""
    first, last = axes.get_xlim()
    for k, (angle, value) in enumerate(peaks):
        if not np.isfinite(value):
            continue
        where, height = np.degrees(angle), _height(value, turn.objective)
        part = (where - first) / (last - first)
        axes.plot(where, height, "o", color=f"C{k}")
        axes.annotate(
            f"{height:.4g} at {where:.1f}°",
            (where, height),
            xytext=(0, 7),
            textcoords="offset points",
            ha="left" if part < 0.1 else "right" if part > 0.9 else "center",
            va="bottom",
            fontsize="small",
        )
    finite = values[np.isfinite(values)]
    if finite.size and finite.max() > 0:
        most = finite.max()
        if any(way.unholdable for way in ways):  # beside such postures it may be huge
            ends = [each.value for each in (turn.now, turn.then) if each.holdable]
            known = [value for _, value in peaks if np.isfinite(value)]
            most = min(most, 9 * max([*ends, *known, finite.min()]))
        axes.set_ylim(0, 1.15 * _height(most, turn.objective))
    axes.set_xlim(first, last)
    axes.set_ylabel(_height_label(turn.objective))
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), frameon=False)
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
    grasp: _core.Grasp, best: Optional[_core.BestSpatialPosture], axes: Axes
) -> Axes:
    from matplotlib.colors import LogNorm
    from matplotlib.patches import Circle

    if best is None:
        answer = _core.best_posture(grasp)
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
        effort = _core.hold_many(grasp, ups).effort
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
