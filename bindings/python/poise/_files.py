"""Grasp files: docs/grasp-file.md."""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass, field
from typing import Any, Dict, List, Optional, Sequence, Union

import numpy as np

from . import _core
from ._errors import FileError
from ._types import Contact, Disk, Domain, Ellipse, Object, Shape

Path = Union[str, "os.PathLike[str]"]


@dataclass
class GraspFile:
    """What a grasp file says. All in SI units and in the object frame; normals point inwards."""

    object: Object
    contacts: Sequence[Contact]
    name: str = ""
    safety: float = 1.0  #: every friction is divided by it
    angle: Optional[float] = None  #: theta of the posture in which it is held now [rad]
    domain: Domain = Domain.all
    shape: Optional[Shape] = None
    #: What is allowed but looks like a mistake: "FILE:LINE:COLUMN: path: words".
    warnings: List[str] = field(default_factory=list)

    def grasp(self) -> _core.Grasp:
        """The grasp, checked and prepared."""
        return _core.Grasp(self.object, self.contacts, self.safety)


def load(file: Path) -> GraspFile:
    """Reads a grasp file, YAML or JSON; "-" is standard input. Raises FileError."""
    return _core.read_grasp_file(os.fspath(file))


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
        return _core.grasp_from_yaml(text, "")
    except FileError as error:
        raise FileError("", 0, 0, error.path, error.problem) from None


def to_dict(grasp: Union[GraspFile, _core.Grasp]) -> Dict[str, Any]:
    """The values of a grasp file that says this, in SI units."""
    file = (
        grasp
        if isinstance(grasp, GraspFile)
        else GraspFile(grasp.object, grasp.contacts)
    )
    values: Dict[str, Any] = {"poise": 1, "dimension": len(file.object.com)}
    if file.name:
        values["name"] = file.name
    if file.safety != 1:
        values["safety"] = file.safety
    if file.angle is not None:
        values["angle_deg"] = math.degrees(file.angle)
    if file.domain != Domain.all:
        values["domain"] = file.domain.value
    values["object"] = {"weight": file.object.weight, "com": file.object.com.tolist()}
    if file.shape is not None:
        values["object"]["shape"] = _shape(file.shape)
    values["contacts"] = [_contact(contact) for contact in file.contacts]
    return values


def _shape(shape: Shape) -> Dict[str, Any]:
    if isinstance(shape, Disk):
        return {"disk": {"radius": shape.radius}}
    if isinstance(shape, Ellipse):
        return {"ellipse": {"radii": shape.radii.tolist()}}
    return {"polygon": shape.vertices.tolist()}


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
    return values


def _plain(value: Any) -> Any:
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} has no place in a grasp file")
