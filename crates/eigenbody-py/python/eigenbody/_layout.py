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
# Which coordinate of a joint is an angle without end: Pinocchio has its cosine and sine.
ANGLES = {"continuous": 0, "planar": 2}
# Velocities here: [angular; linear] in the body's frame.
ANGULAR_FIRST = {"pinocchio": False, "mujoco": False, "drake": True}
# What is turned into the world's frame.
WORLD = {"pinocchio": (), "mujoco": ("linear",), "drake": ("angular", "linear")}


@dataclass(frozen=True, eq=False)
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

    Pinocchio has the angle of a continuous and of a planar joint as its cosine and sine: `q_from` gives angles in [−π, π]. A planar
    joint's velocity is measured in the body's frame here and in Pinocchio, in the parent's in MuJoCo (two slides and a hinge) and Drake.

    `joints` names all moving joints in the order of the other library; left out, they stand as here. There is no layout where mimic
    joints follow, and none of the H of a reduced model.
    """

    model: Model
    engine: Literal["pinocchio", "mujoco", "drake"]
    # Of each number there, the coordinate or degree of freedom here.
    q_order: NDArray[np.intp]
    v_order: NDArray[np.intp]
    # Where cosines stand there; each has its sine behind it.
    _cosines: NDArray[np.intp]
    # First of our coordinates and DoFs, and the first DoF there, of every joint whose velocity may be turned.
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
        if sum(nq for nq, _ in widths.values()) != model.nq:
            raise InputError("model: its mimic joints follow; a layout is one of all joints: load it with mimic=False", what="model")
        q_order: list[int] = []
        v_order: list[int] = []
        cosines: list[int] = []
        turned: list[tuple[str, int, int, int]] = []
        for name in names:
            kind, q, v = known[name]
            nq, nv = widths[name]
            places, rates = list(range(nq)), list(range(nv))
            if kind == "floating":
                places = FLOATING[engine]
                rates = rates if ANGULAR_FIRST[engine] else [3, 4, 5, 0, 1, 2]
            elif kind == "spherical":
                places = SPHERICAL[engine]
            elif kind in ANGLES and engine == "pinocchio":
                angle = ANGLES[kind]
                cosines.append(len(q_order) + angle)
                places = [*places[: angle + 1], angle]
            if kind in ("floating", "spherical", "planar"):
                turned.append((kind, q, v, len(v_order)))
            q_order += [q + k for k in places]
            v_order += [v + k for k in rates]
        object.__setattr__(self, "model", model)
        object.__setattr__(self, "engine", engine)
        object.__setattr__(self, "q_order", np.array(q_order, dtype=np.intp))
        object.__setattr__(self, "v_order", np.array(v_order, dtype=np.intp))
        object.__setattr__(self, "_cosines", np.array(cosines, dtype=np.intp))
        object.__setattr__(self, "_turned", tuple(turned))

    def q_to(self, q: ArrayLike) -> Floats:
        """Our q, ``(..., nq)``, as the other library has it."""
        theirs = _rows("q", q, self.model.nq)[..., self.q_order]
        angles = theirs[..., self._cosines]
        theirs[..., self._cosines], theirs[..., self._cosines + 1] = np.cos(angles), np.sin(angles)
        return theirs

    def q_from(self, q: ArrayLike) -> Floats:
        """The other library's q as ours."""
        theirs = _rows("q", q, len(self.q_order))
        ours = np.empty((*theirs.shape[:-1], self.model.nq))
        ours[..., self.q_order] = theirs
        ours[..., self.q_order[self._cosines]] = np.arctan2(theirs[..., self._cosines + 1], theirs[..., self._cosines])
        return ours

    def v_to(self, q: ArrayLike, v: ArrayLike) -> Floats:
        """Our v, ``(..., nv)``, at our q, as the other library has it."""
        return (self.jacobian(q) @ _rows("v", v, len(self.v_order))[..., None])[..., 0]

    def v_from(self, q: ArrayLike, v: ArrayLike) -> Floats:
        """The other library's v, at our q, as ours: the map is orthogonal."""
        return (np.swapaxes(self.jacobian(q), -1, -2) @ _rows("v", v, len(self.v_order))[..., None])[..., 0]

    def matrix_to(self, q: ArrayLike, H: ArrayLike) -> Floats:
        """Our H, ``(..., nv, nv)``, at our q, as the other library has it."""
        J = self.jacobian(q)
        return J @ self._matrix(H) @ np.swapaxes(J, -1, -2)

    def matrix_from(self, q: ArrayLike, H: ArrayLike) -> Floats:
        """The other library's H, at our q, as ours."""
        J = self.jacobian(q)
        return np.swapaxes(J, -1, -2) @ self._matrix(H) @ J

    def _matrix(self, H: ArrayLike) -> Floats:
        H, n = _float(H), len(self.v_order)
        if H.shape[-2:] != (n, n):
            raise InputError(f"H has shape {H.shape}, expected (..., {n}, {n}): that of all degrees of freedom", what="H")
        return H

    def jacobian(self, q: ArrayLike) -> Floats:
        """The orthogonal matrix J of v_there = J v, at our q: ``(..., nv, nv)``."""
        q = _rows("q", q, self.model.nq)
        n = len(self.v_order)
        J = np.zeros((*q.shape[:-1], n, n))
        J[..., np.arange(n), self.v_order] = 1.0
        for kind, place, dof, there in self._turned:
            if kind == "planar":
                if self.engine != "pinocchio":
                    J[..., there : there + 2, dof : dof + 2] = _turn(q[..., place + 2])
                continue
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


def _rows(what: str, x: ArrayLike, width: int) -> Floats:
    rows = _float(x)
    if rows.shape[-1:] != (width,):
        raise InputError(f"{what} has shape {rows.shape}, expected (..., {width})", what=what)
    return rows


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


def _turn(angle: Floats) -> Floats:
    """From the body's frame to the parent's, of planar joints."""
    rows = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))
