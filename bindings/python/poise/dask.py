"""Many grasps on a cluster, by Dask.distributed: docs/scale.md.

Partitions in, partitions out; which worker answers them, and what happens when one is lost, is the
scheduler's business.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Iterable, List, Sequence, Union

from . import _core

if TYPE_CHECKING:
    from distributed import Client, Future

Path = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Partition:
    """Lines of a file of JSON Lines, which every worker must be able to read."""

    file: str
    offset: int  #: where its first line begins [bytes]
    size: int  #: [bytes]
    first: int  #: number of its first record


@dataclass(frozen=True)
class AcronymPartition:
    """Grasps of a file of the ACRONYM data set, which every worker must be able to read."""

    file: str
    mesh_root: str  #: the folder that has its meshes/
    begin: int  #: its first grasp
    end: int  #: the grasp after its last
    first: int  #: number of its first record


def partitions(file: Path, records: int = 1000) -> List[Partition]:
    """Cuts a file of JSON Lines, a grasp in each, into partitions of so many records."""
    found: List[Partition] = []
    name = os.path.abspath(file)
    offset = size = first = lines = 0
    with open(name, "rb") as stream:
        for line in stream:
            size += len(line)
            lines += 1
            if lines - first == records:
                found.append(Partition(name, offset, size, first))
                offset, size, first = offset + size, 0, lines
    if size:
        found.append(Partition(name, offset, size, first))
    return found


def acronym_partitions(
    files: Sequence[Path], mesh_root: Path, grasps: int = 250
) -> List[AcronymPartition]:
    """Cuts files of the ACRONYM data set into partitions of at most so many grasps each."""
    found: List[AcronymPartition] = []
    first = 0
    root = os.path.abspath(mesh_root)
    for file in files:
        name = os.path.abspath(file)
        size = len(_core.Acronym(name, root))
        for begin in range(0, size, grasps):
            end = min(begin + grasps, size)
            found.append(AcronymPartition(name, root, begin, end, first + begin))
        first += size
    return found


def answer(partition: Union[Partition, AcronymPartition], **question: Any) -> bytes:
    """The lines that poise batch writes for a partition; question: see poise.answer_record."""
    if isinstance(partition, AcronymPartition):
        data = _core.Acronym(partition.file, partition.mesh_root)
        return b"".join(
            data.answer_record(
                n, partition.first + n - partition.begin, **question
            ).encode()
            for n in range(partition.begin, partition.end)
        )
    with open(partition.file, "rb") as stream:
        stream.seek(partition.offset)
        text = stream.read(partition.size)
    return b"".join(
        _core.answer_record(line, partition.first + k, **question).encode()
        for k, line in enumerate(text.removesuffix(b"\n").split(b"\n"))
    )


def batch(
    client: Client, parts: Sequence[Union[Partition, AcronymPartition]], **question: Any
) -> List[Future]:
    """The answers to partitions, in their order, as futures of their lines."""
    futures: List[Future] = client.map(answer, parts, pure=False, **question)
    return futures


def write(futures: Iterable[Future], file: Path) -> None:
    """Writes the lines of all partitions in their order; the file is there when it is whole.

    Raises what a partition raised that could not be answered; bad grasps are records.
    """
    part = os.fspath(file) + ".part"
    with open(part, "wb") as stream:
        for future in futures:
            stream.write(future.result())
            future.release()  # the workers forget it
        stream.flush()
        os.fsync(stream.fileno())
    os.replace(part, file)
