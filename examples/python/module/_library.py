# SPDX-License-Identifier: MIT
"""Opens the shared library and compares its structs with _layout, which is generated from the C headers."""
from __future__ import annotations

import ctypes
import os
from typing import Any

from . import _layout, _paths

__version__ = _layout.VERSION


class Error(RuntimeError):
    """What the library refused or could not do: the line that it logged."""


def _open() -> ctypes.CDLL:
    path = os.environ.get("GLSSAO_LIBRARY") or os.path.join(os.path.dirname(__file__), _paths.LIBRARY)
    try:
        library = ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(f"glssao {__version__}: {error} (the environment variable GLSSAO_LIBRARY names another)") from None
    try:
        for name, (result, parameters) in _layout.FUNCTIONS.items():
            function = getattr(library, name)
            function.restype, function.argtypes = result, parameters
        size_of = library.occlude_struct_size
        number = library.glssao_version()
    except AttributeError as error:
        raise ImportError(f"glssao {__version__} does not fit its library: {error}") from None
    size_of.restype, size_of.argtypes = ctypes.c_size_t, [ctypes.c_char_p]
    version = f"{number >> 16}.{number >> 8 & 255}.{number & 255}"
    faults = [f"{struct.__name__} has {ctypes.sizeof(struct)} bytes here and {size_of(struct.__name__.encode())} there"
              for struct in _layout.STRUCTS if ctypes.sizeof(struct) != size_of(struct.__name__.encode())]
    if faults or version != __version__:
        raise ImportError("; ".join([f"this is glssao {__version__}, but {path} is of glssao {version}"] + faults))
    return library


library = _open()


def fill(struct: ctypes.Structure, values: dict[str, Any]) -> dict[str, Any]:
    """Sets the struct's fields of these names and returns the rest. Enums may be given by name: blur="none"."""
    rest = {}
    kinds = {field[0]: field[1] for field in struct._fields_}
    for name, value in values.items():
        if name not in kinds:
            rest[name] = value
            continue
        if name in struct.enums and isinstance(value, str):
            value = choose(struct.enums[name], name, value)
        elif issubclass(kinds[name], ctypes.Array):
            value = kinds[name](*value)
        setattr(struct, name, value)
    return rest


def choose(enum: Any, name: str, value: str) -> int:
    """The number of an enum's member, by its name in lower case."""
    try:
        return int(enum[value.upper()])
    except (AttributeError, KeyError):
        raise ValueError(f"{name} = {value!r}: want {', '.join(member.name.lower() for member in enum)}") from None


def settings_from(technique: str, quality: str, radius: float, values: dict[str, Any]) -> tuple[Any, dict[str, Any]]:
    """The default settings of that quality, changed by values; and those of values that are no settings."""
    settings = library.glssao_default_settings(choose(_layout.glssao_technique, "technique", technique),
                                               choose(_layout.glssao_quality, "quality", quality))
    settings.radius = radius
    return settings, fill(settings, values)


def refuse_rest(rest: dict[str, Any], *structs: Any) -> None:
    """A TypeError for names that are no fields."""
    if rest:
        known = sorted(field[0] for struct in structs for field in struct._fields_)
        raise TypeError(f"unknown: {', '.join(rest)}; known: {', '.join(known)}")
