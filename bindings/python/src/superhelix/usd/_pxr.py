"""The USD library, and the errors that come from files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

try:
    from pxr import Gf, Sdf, Tf, Usd, UsdGeom, UsdPhysics, UsdShade, UsdSkel, UsdUtils, Vt
except ImportError as _error:
    raise ImportError(
        'superhelix.usd needs the USD library (the module pxr): pip install "superhelix[usd]", or pip install usd-core; inside Houdini, Maya '
        "or Omniverse, use the host's own Python, which has it"
    ) from _error

__all__ = [
    "Gf",
    "Sdf",
    "Usd",
    "UsdError",
    "UsdGeom",
    "UsdPhysics",
    "UsdShade",
    "UsdSkel",
    "UsdUtils",
    "UsdWarning",
    "Vt",
    "errors_of",
    "refuse",
    "reload_layers",
]


class UsdError(ValueError):
    """A stage that cannot be read or written. The text names the prim, the attribute and its value; path is the prim's path."""

    def __init__(self, path: Any, reason: str) -> None:
        super().__init__(f"{path}: {reason}")
        self.path = str(path)


class UsdWarning(UserWarning):
    """Something in a stage was left out or taken in another way than it says. The text names the prim."""


def refuse(prim: Any, reason: str) -> NoReturn:
    """Raises a UsdError about a prim."""
    raise UsdError(prim.GetPath(), reason)


@contextmanager
def errors_of(name: Any) -> Iterator[None]:
    """Turns an error of the USD library into one that names the file and says the library's words without its source lines."""
    try:
        yield
    except Tf.ErrorException as error:
        words = str(error).strip().splitlines()[-1]
        raise UsdError(name, f"the USD library says: {words.rsplit(' : ', 1)[-1].strip()}") from None
    except TypeError as error:
        if "to_python" not in str(error):
            raise
        raise UsdError(name, "has a value of a type that no attribute can have: the file is damaged") from None


def reload_layers(paths: Iterable[Path]) -> None:
    """Lets stages that this process has open see what is now in their files. A layer with unsaved changes keeps them."""
    for path in paths:
        layer = Sdf.Layer.Find(str(path))
        if layer and not layer.dirty:
            layer.Reload()
