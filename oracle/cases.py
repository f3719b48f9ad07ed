"""The robots that eigenbody and the reference are compared on."""

from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

BASES = ("fixed", "floating")
CONFIGURATIONS = tuple(f"random({seed})" for seed in range(1, 21))


@dataclass(frozen=True)
class Robot:
    """A robot file inside an installed package."""

    name: str
    package: str
    file: str  # the end of its path, long enough to be unique

    def path(self) -> Path:
        """Where the package's own list of files says it is."""
        try:
            files = distribution(self.package).files or []
        except PackageNotFoundError:
            raise FileNotFoundError(f"package {self.package} is not installed") from None
        found = [file for file in files if file.as_posix().endswith(f"/{self.file}")]
        if len(found) != 1:
            raise FileNotFoundError(f"package {self.package} has {len(found)} files named {self.file}")
        return Path(found[0].locate())


def example(name: str, file: str) -> Robot:
    return Robot(name, "example-robot-data", file)


ROBOTS = (
    example("ur5", "ur_description/urdf/ur5_robot.urdf"),
    example("panda", "panda_description/urdf/panda.urdf"),
    example("xarm7", "xarm_description/urdf/xarm7.urdf"),
    example("g1", "g1_description/urdf/g1_29dof_rev_1_0.urdf"),
    example("talos_reduced", "talos_data/robots/talos_reduced.urdf"),
    example("anymal_b", "anymal_b_simple_description/robots/anymal.urdf"),
)
