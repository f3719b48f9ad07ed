"""Coordinates as other libraries order them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from eigenbody._eigenbody import Model
from eigenbody._errors import InputError

Floats = NDArray[np.float64]

# Coordinates of a floating joint here: x, y, z, w, x, y, z; of a spherical one: w, x, y, z.
FLOATING = {"pinocchio": [0, 1, 2, 4, 5, 6, 3], "mujoco": [0, 1, 2, 3, 4, 5, 6], "drake": [3, 4, 5, 6, 0, 1, 2]}
SPHERICAL = {"pinocchio": [1, 2, 3, 0], "mujoco": [0, 1, 2, 3], "drake": [0, 1, 2, 3]}
# Velocities here: [angular; linear] in the body's frame.
ANGULAR_FIRST = {"pinocchio": False, "mujoco": False, "drake": True}
# What is turned into the world's frame.
WORLD = {"pinocchio": (), "mujoco": ("linear",), "drake": ("angular", "linear")}


@dataclass(frozen=True)
class Layout:
    """A robot's coordinates in the order and the frames of Pinocchio, MuJoCo or Drake.

    ============  ==========================  =====================================
    engine        floating base, q            floating base, v
    ============  ==========================  =====================================
    here          x y z, w x y z              angular, linear; both in the body's frame
    `pinocchio`   x y z, x y z w              linear, angular; both in the body's frame
    `mujoco`      x y z, w x y z              linear in the world's, angular in the body's frame
    `drake`       w x y z, x y z              angular, linear; both in the world's frame
    ============  ==========================  =====================================

    `joints` names all moving joints in the order of the other library; left out, they stand as here.
    """

    model: Model
    engine: Literal["pinocchio", "mujoco", "drake"]
    q_order: NDArray[np.intp]
    v_order: NDArray[np.intp]
    # First of our coordinates and DoFs, and the first DoF there, of every floating and spherical joint.
    _turned: tuple[tuple[str, int, int, int], ...]

    def __init__(self, model: Model, engine: Literal["pinocchio", "mujoco", "drake"], joints: Sequence[str] | None = None) -> None:
        if engine not in FLOATING:
            raise InputError(f"engine: '{engine}', expected pinocchio, mujoco or drake", what="engine")
        known = {name: (kind, q, v) for name, kind, q, v in model.joints}
        names = list(known) if joints is None else list(joints)
        if sorted(names) != sorted(known):
            missing, unknown = sorted(set(known) - set(names)), sorted(set(names) - set(known))
            raise InputError(f"joints: missing {missing}, unknown {unknown}, or named twice", what="joints")
        widths = _widths(model)
        q_order: list[int] = []
        v_order: list[int] = []
        turned: list[tuple[str, int, int, int]] = []
        for name in names:
            kind, q, v = known[name]
            nq, nv = widths[name]
            places, rates = list(range(nq)), list(range(nv))
            if kind == "floating":
                places = FLOATING[engine]
                rates = rates if ANGULAR_FIRST[engine] else [3, 4, 5, 0, 1, 2]
                turned.append((kind, q, v, len(v_order)))
            elif kind == "spherical":
                places = SPHERICAL[engine]
                turned.append((kind, q, v, len(v_order)))
            q_order += [q + k for k in places]
            v_order += [v + k for k in rates]
        object.__setattr__(self, "model", model)
        object.__setattr__(self, "engine", engine)
        object.__setattr__(self, "q_order", np.array(q_order, dtype=np.intp))
        object.__setattr__(self, "v_order", np.array(v_order, dtype=np.intp))
        object.__setattr__(self, "_turned", tuple(turned))

    def q_to(self, q: ArrayLike) -> Floats:
        """Our q, ``(..., nq)``, as the other library has it."""
        return _float(q)[..., self.q_order]

    def q_from(self, q: ArrayLike) -> Floats:
        """The other library's q as ours."""
        q = _float(q)
        ours = np.empty_like(q)
        ours[..., self.q_order] = q
        return ours

    def v_to(self, q: ArrayLike, v: ArrayLike) -> Floats:
        """Our v, ``(..., nv)``, at our q, as the other library has it."""
        return (self.jacobian(q) @ _float(v)[..., None])[..., 0]

    def v_from(self, q: ArrayLike, v: ArrayLike) -> Floats:
        """The other library's v, at our q, as ours: the map is orthogonal."""
        return (np.swapaxes(self.jacobian(q), -1, -2) @ _float(v)[..., None])[..., 0]

    def matrix_to(self, q: ArrayLike, H: ArrayLike) -> Floats:
        """Our H, ``(..., nv, nv)``, at our q, as the other library has it."""
        J = self.jacobian(q)
        return J @ _float(H) @ np.swapaxes(J, -1, -2)

    def matrix_from(self, q: ArrayLike, H: ArrayLike) -> Floats:
        """The other library's H, at our q, as ours."""
        J = self.jacobian(q)
        return np.swapaxes(J, -1, -2) @ _float(H) @ J

    def jacobian(self, q: ArrayLike) -> Floats:
        """The orthogonal matrix J of v_there = J v, at our q: ``(..., nv, nv)``."""
        q = _float(q)
        n = len(self.v_order)
        J = np.zeros((*q.shape[:-1], n, n))
        J[..., np.arange(n), self.v_order] = 1.0
        for kind, place, dof, there in self._turned:
            R = _rotation(q[..., place + 3 : place + 7] if kind == "floating" else q[..., place : place + 4])
            angular = "angular" in WORLD[self.engine] if kind == "floating" else self.engine == "drake"
            first = 0 if ANGULAR_FIRST[self.engine] or kind == "spherical" else 3
            if angular:
                J[..., there + first : there + first + 3, dof : dof + 3] = R
            if kind == "floating" and "linear" in WORLD[self.engine]:
                J[..., there + 3 - first : there + 6 - first, dof + 3 : dof + 6] = R
        return J


def _widths(model: Model) -> dict[str, tuple[int, int]]:
    widths = {"floating": (7, 6), "spherical": (4, 3), "planar": (3, 3), "cylindrical": (2, 2), "universal": (2, 2)}
    return {name: widths.get(kind, (1, 1)) for name, kind, _, _ in model.joints}


def _float(x: Any) -> Floats:
    return np.asarray(x, dtype=np.float64)


def _rotation(quaternion: Floats) -> Floats:
    """From the body's frame to the parent's, of quaternions w, x, y, z."""
    w, x, y, z = np.moveaxis(quaternion / np.linalg.norm(quaternion, axis=-1, keepdims=True), -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))
