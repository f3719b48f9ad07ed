"""The robot files of installed packages."""

from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path


def files(package: str, extension: str) -> list[Path]:
    """Every file of a package with an extension, by the package's own list, each once."""
    try:
        listed = distribution(package).files or []
    except PackageNotFoundError:
        raise FileNotFoundError(f"package {package} is not installed") from None
    return sorted({Path(file.locate()) for file in listed if file.suffix.lower() == extension})


def mjcf(package: str) -> Iterator[Path]:
    """The MJCF files of a package: XML files whose root element is <mujoco>."""
    for path in files(package, ".xml"):
        text = path.read_text(encoding="utf-8", errors="replace")
        if "<mujoco" in text and "<mujocoinclude" not in text:
            yield path


def short(path: Path, package: str) -> str:
    """A path from its package's folder on."""
    folder = package.replace("-", "_")
    parts = path.parts
    robots = "robots" if package == "example-robot-data" else folder
    return "/".join(parts[parts.index(robots) + 1 :]) if robots in parts else path.name
