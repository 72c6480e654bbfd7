"""Saving, and files of other programs."""

from __future__ import annotations

import ctypes
import os
from typing import Any, Mapping, Optional, Union

import numpy as np

from . import _library
from ._arrays import address, floats, numbers
from ._core import Core, cell_count, id_count
from ._errors import InvalidField, WrongCount

Path = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]

_save = _library.function("save")
_save_file = _library.function("save_file")
_write_vtu = _library.function("write_vtu")
_write_medit = _library.function("write_medit")


class Writing(Core):
    """Saving, and files of other programs."""

    def tobytes(self) -> bytes:
        """The bytes of a saved triangulation, from which `deldrift.frombytes` makes one like it on any machine.

        Returns
        -------
        bytes
            Those that `save` writes to a file.
        """
        with self._reading as t:
            count = ctypes.c_size_t()
            self._check(_save(t, None, 0, count))
            buffer = bytearray(count.value)
            self._check(_save(t, (ctypes.c_char * len(buffer)).from_buffer(buffer), len(buffer), count))
        return bytes(buffer)

    def save(self, path: Path) -> None:
        """Saves the triangulation to a file, from which `deldrift.load` makes one like it on any machine.

        Positions, ids, simplices with their indices, segments and the timestamp are saved, options are not. The file is
        replaced when the new one is complete.

        Parameters
        ----------
        path : str or path
            Of the file.
        """
        name = file_name(path)
        with self._reading as t:
            self._check(_save_file(t, name))

    def write_vtu(
        self,
        path: Path,
        vertex_fields: Optional[Mapping[str, Any]] = None,
        simplex_fields: Optional[Mapping[str, Any]] = None,
    ) -> None:
        """Writes a file for ParaView and VTK (.vtu).

        Segments are lines behind the simplices: their markers are the cell data "marker", which is 0 for simplices, and
        the fields of simplices are NaN for them. Where points repeat, a vertex is a point for each period in which a simplex
        has it: the point data "vertex" are the ids.

        Parameters
        ----------
        path : str or path
            Of the file.
        vertex_fields : dict of str to array_like, optional
            Numbers, or rows of them, for each id, that are written along as point data.
        simplex_fields : dict of str to array_like, optional
            Numbers, or rows of them, for each simplex, that are written along as cell data.
        """
        name = file_name(path)
        with self._reading as t:
            of_vertices, keep_vertices = _fields("vertex_fields", vertex_fields, id_count(t), "ids")
            of_cells, keep_cells = _fields("simplex_fields", simplex_fields, cell_count(t), "simplices")
            status = _write_vtu(t, name, of_vertices, len(keep_vertices), of_cells, len(keep_cells))
            self._check(status, cell_fields="simplex_fields")

    def write_medit(self, path: Path, references: Any = None) -> None:
        """Writes a file for Mmg, FreeFem, Gmsh and others (MEDIT's .mesh).

        Segments are edges, with their markers as references. Where points repeat, a vertex is there for each period in which
        a simplex has it; the reference of each is its id.

        Parameters
        ----------
        path : str or path
            Of the file.
        references : array_like of int, optional
            A number of 32 bits for each simplex, such as `label_cells` gives, or one for all; 1 by default.
        """
        name = file_name(path)
        with self._reading as t:
            values = np.empty(0, np.int32)
            if references is not None:
                values = numbers("references", references, cell_count(t), "simplices")
            self._check(_write_medit(t, name, address(values) if len(values) else None, len(values)))


def file_name(path: Path) -> bytes:
    """A path as the system has it."""
    name = os.fsencode(path)
    if b"\0" in name:
        raise ValueError("path has a NUL character, which no path may have")
    return name


def _fields(
    argument: str, fields: Optional[Mapping[str, Any]], count: int, entries: str
) -> tuple[Any, list[np.ndarray]]:
    """Fields as the library takes them, and the arrays that they point to."""
    arrays = []
    listed = (_library.Field * len(fields or ()))()
    for field, (name, values) in zip(listed, (fields or {}).items()):
        array = floats(f"{argument}[{name!r}]", values)
        if array.ndim == 0 or len(array) != count:
            raise WrongCount(
                f"{argument}[{name!r}] has the shape {array.shape}, and there are {count} {entries}", argument
            )
        encoded = str(name).encode()
        if b"\0" in encoded:
            raise InvalidField(
                f"{argument} has the name {name!r} with a NUL character, which XML does not have", argument
            )
        field.name = encoded
        field.values = address(array)
        field.components = array.size // max(len(array), 1) if len(array) else 1
        arrays.append(array)
    return listed, arrays
