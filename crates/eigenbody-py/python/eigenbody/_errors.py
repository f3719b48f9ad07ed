"""What can go wrong, with what a program wants to know about it as attributes."""

from __future__ import annotations

from typing import Any


class EigenbodyError(Exception):
    """Any failure of eigenbody."""

    def __init__(self, message: str, **details: Any) -> None:
        super().__init__(message)
        for name, value in details.items():
            setattr(self, name, value)


class ModelError(EigenbodyError, ValueError):
    """A file or an expression that gives no model.

    `file`, `line` and `column` (counted from 1) say where, `joint` and `link` what it is about; None where unknown.
    """

    file: str | None = None
    line: int | None = None
    column: int | None = None
    joint: str | None = None
    link: str | None = None


class InputError(EigenbodyError, ValueError):
    """An argument that does not fit: `what`, and `index` and `row` of the first offender; None where unknown."""

    what: str | None = None
    index: int | None = None
    row: int | None = None
    joint: str | None = None


class NotPositiveDefiniteError(EigenbodyError, ArithmeticError):
    """H is singular or indefinite to working precision: elimination met `pivot` at degree of freedom `dof`."""

    dof: int | None = None
    pivot: float | None = None
    row: int | None = None
