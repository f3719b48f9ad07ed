"""MJCF files made at random from everything that touches mass and joints, the same for the same seed."""

import random
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

COUNT = 150

SHAPES = {"sphere": 1, "capsule": 2, "cylinder": 2, "ellipsoid": 3, "box": 3}


class Maker:
    """One file."""

    def __init__(self, seed: int):
        self.random = random.Random(seed)
        self.names = 0
        self.degrees = self.random.random() < 0.5

    def numbers(self, count: int, low: float, high: float) -> str:
        return " ".join(f"{self.random.uniform(low, high):.4g}" for _ in range(count))

    def chance(self, p: float) -> bool:
        return self.random.random() < p

    def name(self, kind: str) -> str:
        self.names += 1
        return f"{kind}{self.names}"

    def angle(self, count: int) -> str:
        return self.numbers(count, -170, 170) if self.degrees else self.numbers(count, -3, 3)

    def orientation(self) -> str:
        angle = self.angle(1)
        forms = [
            "",
            f'quat="{self.numbers(4, -1, 1)}"',
            f'axisangle="{self.numbers(3, -1, 1)} {angle}"',
            f'euler="{self.angle(3)}"',
            f'xyaxes="{self.numbers(6, -1, 1)}"',
            f'zaxis="{self.numbers(3, -1, 1)}"',
        ]
        return self.random.choice(forms)

    def pose(self) -> str:
        return f'pos="{self.numbers(3, -0.5, 0.5)}" {self.orientation()}'

    def file(self) -> str:
        compiler = [f'angle="{"degree" if self.degrees else "radian"}"']
        options = {
            "eulerseq": self.random.choice(["xyz", "zyx", "XYZ", "xYz", "zxz"]),
            "boundmass": "0.01",
            "boundinertia": "0.001",
            "balanceinertia": "true",
            "inertiafromgeom": self.random.choice(["auto", "true"]),
            "inertiagrouprange": "0 2",
            "settotalmass": "12",
            "alignfree": "true",
            "autolimits": "true",
            "fitaabb": "true",
        }
        compiler += [f'{name}="{value}"' for name, value in options.items() if self.chance(0.3)]
        bodies = "".join(self.body(0, ["main"]) for _ in range(self.random.randint(1, 3)))
        return f"""<mujoco model="generated">
<compiler {" ".join(compiler)}/>
<default>
  <joint armature="0.01"/> <geom density="700"/>
  <default class="a"><geom size="0.1 0.2 0.3" {self.orientation()}/> <joint axis="1 0 1" pos="0.1 0 0"/>
    <default class="b"><geom type="box" mass="0.7"/> <joint type="slide" ref="0.1"/></default>
  </default>
</default>
<asset>
  <mesh name="tetra" vertex="0 0 0 0.3 0 0 0 0.2 0 0 0 0.4" scale="1 -1.2 0.8"/>
  <mesh name="wedge" vertex="0 0 0 0.2 0 0 0.2 0.3 0 0 0.3 0 0 0 0.25 0 0.3 0.2" refpos="0.1 0 0" refquat="1 0.2 0 0.3"
    inertia="{self.random.choice(["legacy", "convex", "shell", "exact"])}"/>
  <mesh name="cube" vertex="{" ".join(f"{x} {y} {z}" for x in (0, 0.2) for y in (0, 0.3) for z in (0, 0.1))}"/>
  <hfield name="field" nrow="2" ncol="2" size="0.2 0.3 0.1 0.2"/>
</asset>
<worldbody>
  <geom type="plane" size="1 1 1"/>
  {bodies}
</worldbody>
</mujoco>
"""

    def joints(self, depth: int) -> str:
        kind = self.random.choice(["free", "freejoint", "ball", "one", "one", "two", "three", "slides ball", "none"])
        if depth > 0 and kind.startswith("free"):
            kind = "two"
        if kind == "free":
            return f'<joint name="{self.name("j")}" type="free"/>'
        if kind == "freejoint":
            return f'<freejoint name="{self.name("j")}" align="{self.random.choice(["auto", "true", "false"])}"/>'
        if kind == "none":
            return ""
        single = ["hinge", "slide"]
        kinds = {
            "ball": ["ball"],
            "slides ball": ["slide", "slide", "ball"],
            "one": [self.random.choice(single)],
            "two": [self.random.choice(single) for _ in range(2)],
            "three": [self.random.choice(single) for _ in range(3)],
        }[kind]
        return "".join(self.joint(kind) for kind in kinds)

    def joint(self, kind: str) -> str:
        name = f'name="{self.name("j")}"' if self.chance(0.8) else ""
        joint = f'<joint {name} type="{kind}" pos="{self.numbers(3, -0.2, 0.2)}"'
        if kind != "ball":
            joint += f' axis="{self.numbers(3, -1, 1)}"'
        if kind != "ball" and self.chance(0.4):
            joint += f' ref="{self.angle(1) if kind == "hinge" else self.numbers(1, -1, 1)}"'
        if self.chance(0.3):
            joint += f' armature="{self.numbers(1, 0, 0.5)}"'
        if kind == "hinge" and self.chance(0.3):
            joint += ' range="-1 1"'
        return joint + "/>"

    def geom(self) -> str:
        shape = self.random.choice([*SHAPES, "mesh", "fit", "hfield", "class", "fromto", "visual"])
        group = f'group="{self.random.randint(0, 4)}"' if self.chance(0.2) else ""
        mass = self.random.choice(["", "", 'mass="0.3"', 'density="300"'])
        shell = 'shellinertia="true"' if self.chance(0.2) else ""
        rest = f"{self.pose()} {mass} {group}"
        if shape in SHAPES:
            return f'<geom type="{shape}" size="{self.numbers(SHAPES[shape], 0.05, 0.3)}" {rest} {shell}/>'
        if shape == "mesh":
            mesh = self.random.choice(["tetra", "wedge", "cube"])
            return f'<geom type="mesh" mesh="{mesh}" {rest}/>'
        if shape == "fit":
            kind = self.random.choice([*SHAPES])
            return f'<geom type="{kind}" mesh="{self.random.choice(["tetra", "cube"])}" {rest}/>'
        if shape == "hfield":
            return f'<geom type="hfield" hfield="field" {rest}/>'
        if shape == "class":
            return f'<geom class="{self.random.choice("ab")}" pos="{self.numbers(3, -0.5, 0.5)}"/>'
        if shape == "fromto":
            kind = self.random.choice(["capsule", "cylinder", "box", "ellipsoid"])
            return f'<geom type="{kind}" size="0.07" fromto="{self.numbers(6, -0.5, 0.5)}" {mass} {shell}/>'
        return f'<geom size="0.1" mass="0" {self.pose()}/>'

    def inertial(self) -> str:
        place = f'pos="{self.numbers(3, -0.3, 0.3)}" mass="{self.numbers(1, 0.2, 2)}"'
        a, b = self.random.uniform(0.1, 0.3), self.random.uniform(0.1, 0.3)
        if self.chance(0.5):
            return f'<inertial {place} {self.orientation()} diaginertia="{a:.4g} {b:.4g} 0.3"/>'
        return f'<inertial {place} fullinertia="{a + 0.2:.4g} {b + 0.2:.4g} 0.4 {self.numbers(3, -0.05, 0.05)}"/>'

    def body(self, depth: int, classes: list[str]) -> str:
        name = f'name="{self.name("b")}"' if self.chance(0.8) else ""
        childclass = f'childclass="{self.random.choice("ab")}"' if self.chance(0.2) else ""
        geoms = [self.geom() for _ in range(self.random.randint(1, 3))]
        # One plain geom, so that every moving body has mass.
        contents = f'<geom type="sphere" size="0.1" mass="0.5" {self.pose()}/>' + "".join(geoms[:-1])
        contents += f"<frame {self.pose()}>{geoms[-1]}{self.frame(depth, classes)}</frame>"
        if self.chance(0.3):
            contents += self.inertial()
        contents += self.joints(depth)
        if depth < 3:
            contents += "".join(self.body(depth + 1, classes) for _ in range(self.random.randint(0, 2)))
            if self.chance(0.3):
                contents += self.replicate(depth, classes)
        return f"<body {name} {childclass} {self.pose()}>{contents}</body>\n"

    def frame(self, depth: int, classes: list[str]) -> str:
        if depth >= 3 or self.chance(0.6):
            return ""
        childclass = f'childclass="{self.random.choice("ab")}"' if self.chance(0.3) else ""
        return f"<frame {childclass} {self.pose()}>{self.body(depth + 1, classes)}</frame>"

    def replicate(self, depth: int, classes: list[str]) -> str:
        place = f'offset="{self.numbers(3, -0.3, 0.3)}" euler="{self.angle(3)}" sep="-"'
        inside = self.geom() + (self.body(depth + 2, classes) if self.chance(0.7) else "")
        return f'<replicate count="{self.random.choice([1, 2, 3, 11])}" {place}>{inside}</replicate>'


@contextmanager
def files() -> Iterator[list[Path]]:
    """The files, in a folder that is removed afterwards."""
    with tempfile.TemporaryDirectory() as folder:
        paths = []
        for seed in range(COUNT):
            path = Path(folder) / f"generated_{seed}.xml"
            path.write_text(Maker(seed).file())
            paths.append(path)
        yield paths
