"""Poise: how to turn a held object so that its fingers press least, and how hard they press.

The names are those of the C++ library; what C++ asks without arguments is an attribute here.
All values are in SI units and in the object frame.
"""

from ._core import *
from ._core import __version__
from ._errors import FileError, InvalidGrasp, PoiseError
from ._files import GraspFile, from_dict, load, save, to_dict
from ._plot import plot
from ._types import (
    Box,
    Contact,
    ContactState,
    Cylinder,
    Disk,
    Domain,
    Ellipse,
    Ellipsoid,
    ForceLimit,
    Kind,
    Load,
    Manner,
    MeshShape,
    Objective,
    Pad,
    Polygon,
    Sphere,
    Status,
    Tilt,
)

__all__ = sorted(name for name in globals() if not name.startswith("_"))
