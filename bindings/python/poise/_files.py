"""Grasp files: docs/grasp-file.md."""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence, Union

import numpy as np

from . import _core
from ._errors import FileError
from ._types import (
    Box,
    Contact,
    Cylinder,
    Disk,
    Domain,
    Ellipse,
    Ellipsoid,
    Load,
    MeshShape,
    Objective,
    Polygon,
    Shape,
    Sphere,
    Tilt,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

Path = Union[str, "os.PathLike[str]"]


@dataclass
class GraspFile:
    """What a grasp file says. All in SI units and in the object frame; normals point inwards."""

    loads: Sequence[Load]  #: at least one
    contacts: Sequence[Contact]
    name: str = ""
    safety: float = 1.0  #: every friction and torsion is divided by it
    angle: Optional[float] = None  #: plane: theta of the posture in which it is held now [rad]
    domain: Domain = Domain.all
    shape: Optional[Shape] = None
    up: Optional[NDArray[np.float64]] = None  #: space: the posture in which it is held now (3,)
    tilt: Optional[Tilt] = None  #: space: the postures to choose from; None: all
    #: What is allowed but looks like a mistake: "FILE:LINE:COLUMN: path: words".
    warnings: List[str] = field(default_factory=list)
    objective: Objective = Objective.grip  #: what is to be least
    #: "each", "coupled" or a list of drives, as in a grasp file; None: each
    drives: Union[str, List[Dict[str, Any]], None] = None
    fingers: Optional[Dict[str, Dict[str, Any]]] = None  #: closing and max_force, by label

    def grasp(self) -> _core.Grasp:
        """The grasp with all loads, checked and prepared. Raises InvalidGrasp."""
        return _core.Grasp(self.loads, self.contacts, self.safety, self.drives, self.fingers)


def load(file: Path) -> GraspFile:
    """Reads a grasp file, YAML or JSON; "-" is standard input. Raises FileError."""
    return _core._read_grasp_file(os.fspath(file))


def save(grasp: Union[GraspFile, _core.Grasp], file: Path) -> None:
    """Writes a grasp file, as JSON, which is YAML too."""
    text = json.dumps(to_dict(grasp), indent=2, ensure_ascii=False) + "\n"
    with open(file, "w", encoding="utf-8") as stream:
        stream.write(text)


def from_dict(values: Dict[str, Any]) -> GraspFile:
    """What a grasp file with these values says; arrays may be lists or numpy arrays.

    Raises FileError, with the path of the value that is wrong.
    """
    text = json.dumps(values, ensure_ascii=False, default=_plain)
    try:
        return _core._grasp_from_yaml(text, "")
    except FileError as error:
        raise FileError("", 0, 0, error.path, error.problem) from None


def to_dict(grasp: Union[GraspFile, _core.Grasp]) -> Dict[str, Any]:
    """The values of a grasp file that says this, in SI units."""
    file = (
        grasp
        if isinstance(grasp, GraspFile)
        else GraspFile(grasp.loads, grasp.contacts)
    )
    if not isinstance(grasp, GraspFile):
        file.drives, file.fingers = grasp.mechanism
    values: Dict[str, Any] = {"poise": 1, "dimension": len(file.contacts[0].position)}
    if file.name:
        values["name"] = file.name
    if file.safety != 1:
        values["safety"] = file.safety
    if file.objective != Objective.grip:
        values["objective"] = file.objective.value
    if file.angle is not None:
        values["angle_deg"] = math.degrees(file.angle)
    if file.domain != Domain.all:
        values["domain"] = file.domain.value
    if file.up is not None:
        values["up"] = np.asarray(file.up).tolist()
    if file.tilt is not None:
        tilt = {"from": file.tilt.from_.tolist(), "max_deg": math.degrees(file.tilt.most)}
        values["tilt"] = tilt
    first = file.loads[0]
    values["object"] = {"weight": first.weight, "com": first.com.tolist()}
    loads = [_load(load, first) for load in file.loads]
    if loads != [{}]:
        values["loads"] = loads
    if file.shape is not None:
        values["object"]["shape"] = _shape(file.shape)
    values["contacts"] = [_contact(contact) for contact in file.contacts]
    if file.drives is not None:
        values["drives"] = file.drives
    if file.fingers is not None:
        values["fingers"] = file.fingers
    return values


def _load(load: Load, first: Load) -> Dict[str, Any]:
    """What it has that the object of the first one has not."""
    values: Dict[str, Any] = {}
    if load.name:
        values["name"] = load.name
    if load.weight != first.weight:
        values["weight"] = load.weight
    if not np.array_equal(load.com, first.com):
        values["com"] = load.com.tolist()
    acceleration: Dict[str, Any] = {}
    if load.lift != 0:
        acceleration["up"] = load.lift
    if load.acceleration.any():
        acceleration["fixed"] = load.acceleration.tolist()
    if acceleration:
        values["acceleration"] = acceleration
    if load.fixed.any():
        acting = 0 - load.fixed  # not -0
        size = len(load.com)
        values["force"] = acting[:size].tolist()
        values["moment"] = acting[2].item() if size == 2 else acting[size:].tolist()
    return values


def _shape(shape: Shape) -> Dict[str, Any]:
    if isinstance(shape, Polygon):
        return {"polygon": shape.vertices.tolist()}
    if isinstance(shape, Box):
        return {"box": {"size": shape.size.tolist()}}
    if isinstance(shape, Cylinder):
        return {"cylinder": {"radius": shape.radius, "height": shape.height}}
    if isinstance(shape, MeshShape):
        return {"mesh": {"file": shape.file, "scale": shape.scale}}
    if isinstance(shape, (Ellipse, Ellipsoid)):
        return {type(shape).__name__.lower(): {"radii": shape.radii.tolist()}}
    return {type(shape).__name__.lower(): {"radius": shape.radius}}


def _contact(contact: Contact) -> Dict[str, Any]:
    values: Dict[str, Any] = {
        "position": contact.position.tolist(),
        "normal": contact.normal.tolist(),
        "friction": contact.friction,
    }
    if contact.min_normal != 0:
        values["min_normal"] = contact.min_normal
    if contact.max_normal != math.inf:
        values["max_normal"] = contact.max_normal
    if contact.share != 1:
        values["share"] = contact.share
    if contact.finger:
        values["finger"] = contact.finger
    if contact.torsion != 0:
        values["torsion"] = contact.torsion
    if contact.pad is not None:
        values["pad"] = {
            "points": contact.pad.points.tolist(),
            "shares": contact.pad.shares.tolist(),
            "axis": contact.pad.axis.tolist(),
            "reach": contact.pad.reach.tolist(),
        }
    return values


def _plain(value: Any) -> Any:
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} has no place in a grasp file")
