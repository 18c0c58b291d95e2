"""Plain values: what goes into a grasp, and the words for what comes out."""

from __future__ import annotations

import enum
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Union

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class ContactState(enum.Enum):
    """What a contact does. Slipping: it uses all its friction, friction_used >= 1 - 1e-9."""

    unloaded = "unloaded"
    sticking = "sticking"
    slipping = "slipping"


class ForceLimit(enum.Enum):
    """Which limit of its normal force a contact is at, within 1e-9 of the weight."""

    none = "none"
    min = "min"
    max = "max"


class Manner(enum.Enum):
    """How the object is held, by its forces: the first that applies."""

    resting = "resting"  #: one finger carries everything
    cradled = "cradled"  #: it would be held without any friction
    pinched = "pinched"  #: friction carries


class Kind(enum.Enum):
    """Of an optimum of the curve."""

    boundary = "boundary"  #: an end of the domain or of the holdable set
    kink = "kink"  #: the curve has a corner
    smooth = "smooth"


class Objective(enum.Enum):
    """What is to be least."""

    grip = "grip"  #: the greatest effort of the drives: what to command
    effort = "effort"  #: the sum of squares of the contact forces


class Status(enum.Enum):
    """How sure the best posture is."""

    optimal = "optimal"  #: the best posture is within the wanted gap
    gap = "gap"  #: it is not, or nothing holdable was found and that nothing is was not proven
    unholdable = "unholdable"  #: proven: no posture of the domain can be held


class Domain(enum.Enum):
    """Postures to choose from: all of them, or those outside the fork of the fingers."""

    all = "all"
    pinching_up = "pinching-up"


def _vector(value: ArrayLike) -> NDArray[np.float64]:
    return np.array(value, dtype=float)


class Load:
    """A weight through a centre of mass, the accelerations of the object, and a fixed wrench.

    weight: [N], >= 0; above 0 where nothing else acts
    com: centre of mass (2,) or (3,) [m], object frame
    fixed: what the contacts must supply besides, about the object frame's origin, whatever the
        posture: force [N], moment [N m], (3,) or (6,), object frame. A tool that pushes the object
        with a force F at a point p asks for -wrench_of(F, p); None: nothing
    lift: acceleration of the object against gravity [m/s^2]
    acceleration: of the com, in a fixed direction of the object frame (2,) or (3,) [m/s^2]; None:
        none
    name: what people call it
    """

    def __init__(
        self,
        weight: float = 1.0,
        com: ArrayLike = (0.0, 0.0),
        *,
        fixed: ArrayLike | None = None,
        lift: float = 0.0,
        acceleration: ArrayLike | None = None,
        name: str = "",
    ) -> None:
        self.weight = float(weight)
        self.com = _vector(com)
        size = self.com.size
        self.fixed = np.zeros(3 if size == 2 else 6) if fixed is None else _vector(fixed)
        self.lift = float(lift)
        self.acceleration = np.zeros(size) if acceleration is None else _vector(acceleration)
        self.name = name

    def __repr__(self) -> str:
        words = [f"weight={self.weight!r}", f"com={self.com.tolist()}"]
        if self.fixed.any():
            words.append(f"fixed={self.fixed.tolist()}")
        if self.lift != 0:
            words.append(f"lift={self.lift!r}")
        if self.acceleration.any():
            words.append(f"acceleration={self.acceleration.tolist()}")
        if self.name:
            words.append(f"name={self.name!r}")
        return f"Load({', '.join(words)})"


class Pad:
    """A compliant pad on a rigid finger, in space: its normal force N is spread in fixed parts over
    its points, each of which passes on a tangential force up to mu times its part of N. The centre
    of pressure may move within the pad.

    points: (n, 3), from the contact's position [m], object frame
    shares: (n,), of N, > 0, sum 1; left out, all are equal
    axis: (3,), a direction in the pad's plane
    reach: (2,), how far the centre of pressure may move from the mean of the points, along the axis
        and across it [m], >= 0
    """

    def __init__(
        self,
        points: ArrayLike,
        shares: ArrayLike | None = None,
        axis: ArrayLike = (0.0, 0.0, 1.0),
        reach: ArrayLike = (0.0, 0.0),
    ) -> None:
        self.points = _vector(points).reshape(-1, 3)
        count = len(self.points)
        self.shares = np.full(count, 1.0 / max(count, 1)) if shares is None else _vector(shares)
        self.axis = _vector(axis)
        self.reach = _vector(reach)

    def __repr__(self) -> str:
        return f"Pad({len(self.points)} points, reach={self.reach.tolist()})"


class Contact:
    """A contact with Coulomb friction: a point, a soft point or a pad.

    The force of the finger on the object is given in the contact frame: the normal force along
    the inward normal n, and the tangential force, in the plane one number along n turned by +90
    degrees. A soft finger also passes on a moment m about n: (|t| / mu)^2 + (m / gamma)^2 <= n^2,
    and in the effort m counts as the force m mu / gamma.

    position: (2,), in space (3,) [m], object frame
    normal: (2,) or (3,), from the finger into the object; any length but 0
    friction: coefficient mu >= 0; 0 is a frictionless contact
    min_normal, max_normal: least and greatest normal force [N], >= 0
    share: the part of a pad that this contact stands for, in (0, 1]: its force counts as
        |f|^2 / share
    finger: label; left empty, the contact is a finger of its own
    torsion: gamma [m], >= 0, in space only: above 0 the finger is soft. Needs friction
    pad: a Pad, in space only: the contact is a pad, without torsion and share
    """

    def __init__(
        self,
        position: ArrayLike,
        normal: ArrayLike,
        friction: float = 0.0,
        min_normal: float = 0.0,
        max_normal: float = math.inf,
        share: float = 1.0,
        finger: str = "",
        torsion: float = 0.0,
        pad: Pad | None = None,
    ) -> None:
        self.position = _vector(position)
        self.normal = _vector(normal)
        self.friction = float(friction)
        self.min_normal = float(min_normal)
        self.max_normal = float(max_normal)
        self.share = float(share)
        self.finger = finger
        self.torsion = float(torsion)
        self.pad = pad

    def __repr__(self) -> str:
        words = [
            f"position={self.position.tolist()}",
            f"normal={self.normal.tolist()}",
            f"friction={self.friction!r}",
        ]
        if self.min_normal != 0:
            words.append(f"min_normal={self.min_normal!r}")
        if self.max_normal != math.inf:
            words.append(f"max_normal={self.max_normal!r}")
        if self.share != 1:
            words.append(f"share={self.share!r}")
        if self.finger:
            words.append(f"finger={self.finger!r}")
        if self.torsion != 0:
            words.append(f"torsion={self.torsion!r}")
        if self.pad is not None:
            words.append(f"pad={self.pad!r}")
        return f"Contact({', '.join(words)})"


@dataclass
class Disk:
    """Centred at the object frame's origin."""

    radius: float  #: [m]


class Ellipse:
    """Centred at the object frame's origin, its axes along x and y.

    radii: semi-axes along x and y (2,) [m]
    """

    def __init__(self, radii: ArrayLike) -> None:
        self.radii = _vector(radii)

    def __repr__(self) -> str:
        return f"Ellipse(radii={self.radii.tolist()})"


class Polygon:
    """Edge i leads from vertex i to vertex i + 1, the last one back to vertex 0.

    vertices: (n, 2) [m], in either orientation, not repeating the first
    """

    def __init__(self, vertices: ArrayLike) -> None:
        self.vertices = _vector(vertices)

    def __repr__(self) -> str:
        return f"Polygon(vertices={self.vertices.tolist()})"


class Box:
    """Centred at the object frame's origin, its edges along the axes.

    size: lengths of its edges along x, y and z (3,) [m]
    """

    def __init__(self, size: ArrayLike) -> None:
        self.size = _vector(size)

    def __repr__(self) -> str:
        return f"Box(size={self.size.tolist()})"


@dataclass
class Cylinder:
    """Centred at the object frame's origin, its axis along z."""

    radius: float  #: [m]
    height: float  #: [m]


@dataclass
class Sphere:
    """Centred at the object frame's origin."""

    radius: float  #: [m]


class Ellipsoid:
    """Centred at the object frame's origin, its axes along x, y and z.

    radii: semi-axes along x, y and z (3,) [m]
    """

    def __init__(self, radii: ArrayLike) -> None:
        self.radii = _vector(radii)

    def __repr__(self) -> str:
        return f"Ellipsoid(radii={self.radii.tolist()})"


@dataclass
class MeshShape:
    """A body bounded by a mesh that is read from a file."""

    file: str
    scale: float = 1.0  #: metres for one of its units


Shape = Union[Disk, Ellipse, Polygon, Box, Cylinder, Sphere, Ellipsoid, MeshShape]


class Tilt:
    """Postures in space to choose from: up at most an angle away from a given direction.

    from_: direction (3,) of any length but 0, object frame
    most: [rad], 0 to pi/2
    """

    def __init__(self, from_: ArrayLike, most: float) -> None:
        self.from_ = _vector(from_)
        self.most = float(most)

    def __repr__(self) -> str:
        return f"Tilt(from_={self.from_.tolist()}, most={self.most!r})"
