"""A robot file's mass matrix in ball arithmetic: its decimals are exact decimals.

Links in the world's frame; fixed base, mimic joints move freely, joints in the order of the file.
"""

import xml.etree.ElementTree as ElementTree
from pathlib import Path

from flint import arb

from spatial import Matrix, Vector, cross, dot, joint_space, moved, spatial_inertia, times, transposed, turn_x, turn_z


def exact(text: str) -> arb:
    """A decimal, exactly."""
    digits, _, exponent = text.lower().partition("e")
    whole, _, fraction = digits.partition(".")
    return arb(int(whole + fraction)) * arb(10) ** (int(exponent or 0) - len(fraction))


def vector(element: ElementTree.Element | None, name: str, default: str = "0 0 0") -> Vector:
    text = default if element is None else element.get(name, default)
    return [exact(number) for number in text.split()]


def turn_y(angle: arb) -> Matrix:
    s, c, one, zero = angle.sin(), angle.cos(), arb(1), arb(0)
    return [[c, zero, s], [zero, one, zero], [-s, zero, c]]


def rpy(element: ElementTree.Element | None) -> Matrix:
    """Fixed-axis roll, pitch, yaw."""
    roll, pitch, yaw = vector(element, "rpy")
    return times(turn_z(yaw), times(turn_y(pitch), turn_x(roll)))


def about(axis: Vector, angle: arb) -> Matrix:
    """Rodrigues' rotation about a unit vector."""
    K = cross(axis)
    KK = times(K, K)
    s, c = angle.sin(), 1 - angle.cos()
    return [[arb(int(i == j)) + K[i][j] * s + KK[i][j] * c for j in range(3)] for i in range(3)]


class Robot:
    """Revolute, continuous, prismatic and fixed joints."""

    def __init__(self, path: Path):
        root = ElementTree.parse(path).getroot()
        self.inertials = {link.get("name"): link.find("inertial") for link in root.findall("link")}
        self.joints = root.findall("joint")
        children = {joint.find("child").get("link") for joint in self.joints}
        (self.root,) = [name for name in self.inertials if name not in children]

    def mass_matrix(self, q: dict[str, float]) -> tuple[list[str], Matrix]:
        """Names of the moving joints in the file's order, and H."""
        frames = {self.root: (-1, turn_x(arb(0)), [arb(0)] * 3)}
        parents, axes, inertias, names = [], [], [], []
        waiting = list(self.joints)
        while waiting:
            joint = next(joint for joint in waiting if joint.find("parent").get("link") in frames)
            waiting.remove(joint)
            parent, R, origin = frames[joint.find("parent").get("link")]
            place = joint.find("origin")
            origin, R = moved(origin, R, vector(place, "xyz")), times(R, rpy(place))
            axis, kind = None, joint.get("type")
            if kind != "fixed":
                z = vector(joint.find("axis"), "xyz", "1 0 0")
                z = [x / dot(z, z).sqrt() for x in z]
                angle = arb(q[joint.get("name")])
                world = [dot(row, z) for row in R]
                if kind == "prismatic":
                    origin = moved(origin, R, [x * angle for x in z])
                    axis = [arb(0)] * 3 + world
                else:
                    R = times(R, about(z, angle))
                    axis = world + [dot(row, world) for row in cross(origin)]
            child = joint.find("child").get("link")
            frames[child] = (len(parents), R, origin)
            parents.append(parent)
            axes.append(axis)
            inertias.append(self._inertia(child, R, origin))
            names.append(joint.get("name"))
        H = joint_space(parents, axes, inertias)
        moving = [name for name, axis in zip(names, axes, strict=True) if axis is not None]
        order = [moving.index(j.get("name")) for j in self.joints if j.get("type") != "fixed"]
        return [moving[d] for d in order], [[H[i][j] for j in order] for i in order]

    def _inertia(self, link: str, R: Matrix, origin: Vector) -> Matrix:
        inertial = self.inertials[link]
        if inertial is None:
            return [[arb(0)] * 6 for _ in range(6)]
        place, tensor = inertial.find("origin"), inertial.find("inertia")
        entry = {name: exact(tensor.get(name, "0")) for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")}
        rows = [["ixx", "ixy", "ixz"], ["ixy", "iyy", "iyz"], ["ixz", "iyz", "izz"]]
        E = times(R, rpy(place))
        turned = times(times(E, [[entry[name] for name in row] for row in rows]), transposed(E))
        com = moved(origin, R, vector(place, "xyz"))
        return spatial_inertia(exact(inertial.find("mass").get("value")), com, turned)
