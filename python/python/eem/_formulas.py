"""Formulas of materials, as text and as LaTeX."""

from __future__ import annotations

import ast
import re
from typing import NamedTuple


class Argument(NamedTuple):
    """An argument of a free energy."""

    name: str
    #: ``"Stretch"``, ``"Viscous"`` or ``"Temperature"``
    role: str
    unit: str


class Formula(NamedTuple):
    """A formula that follows from a free energy."""

    #: what it defines: ``"ψ"``, ``"f"``, ``"g_2"``
    symbol: str
    #: both sides; a long one has several lines
    equation: str
    #: the unit of both sides
    unit: str


_GREEK = (
    "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau "
    "upsilon phi chi psi omega Gamma Delta Theta Lambda Xi Pi Sigma Phi Psi Omega"
).split()

_LOWER = 1  # sums
_HIGHER = 2  # products
_POWER = 3
_ATOM = 4


def latex(formulas: dict[str, Formula]) -> str:
    """The free energy and the viscosities in LaTeX."""
    lines = []
    for symbol, formula in formulas.items():
        if symbol == "ψ" or symbol.startswith("η"):
            lines.append(_equation(symbol, formula.equation))
    return "$$\\begin{aligned}" + r" \\ ".join(lines) + "\\end{aligned}$$"


def _equation(symbol: str, equation: str) -> str:
    _, _, right = equation.partition("=")
    first, *definitions = re.split(r"\n\s*(?=(?:where\s+)?\w+\s+=\s)", right)
    shown = _name(symbol.replace("ψ", "psi").replace("η", "eta")) + " &= " + _expression(first)
    for definition in definitions:
        name, _, value = definition.partition("=")
        name = name.replace("where", "").strip()
        shown += r" \\ " + _name(name) + " &= " + _expression(value)
    return shown


def _expression(text: str) -> str:
    """LaTeX of an expression; the text itself if it has another form than expected."""
    flat = " ".join(text.split())
    # `lambda` is a word of Python.
    names = re.sub(r"\b([A-Za-z_]\w*)\b", r"n_\1", flat).replace("^", "**")
    try:
        return _node(ast.parse(names, mode="eval").body)[0]
    except (SyntaxError, ValueError):
        return r"\text{" + re.sub(r"([_^&%$#{}\\])", r"\\\1", flat) + "}"


def _wrapped(shown: tuple[str, int], least: int) -> str:
    text, level = shown
    return text if level >= least else rf"\left({text}\right)"


def _node(node: ast.expr) -> tuple[str, int]:
    match node:
        case ast.Constant(value=value):
            return _number(value), _ATOM
        case ast.Name(id=name):
            return _name(name[2:]), _ATOM
        case ast.Subscript(value=ast.Name(id=name), slice=ast.Constant(value=index)):
            return f"{{{_name(name[2:])}}}_{{{index!r}}}", _ATOM
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return "-" + _wrapped(_node(operand), _HIGHER), _LOWER
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            return f"{_node(left)[0]} + {_wrapped(_node(right), _LOWER)}", _LOWER
        case ast.BinOp(left=left, op=ast.Sub(), right=right):
            return f"{_node(left)[0]} - {_wrapped(_node(right), _HIGHER)}", _LOWER
        case ast.BinOp(left=left, op=ast.Mult(), right=right):
            return rf"{_wrapped(_node(left), _HIGHER)} \, {_wrapped(_node(right), _HIGHER)}", _HIGHER
        case ast.BinOp(left=left, op=ast.Div(), right=right):
            return rf"\frac{{{_node(left)[0]}}}{{{_node(right)[0]}}}", _HIGHER
        case ast.BinOp(left=left, op=ast.Pow(), right=right):
            return f"{_wrapped(_node(left), _ATOM)}^{{{_node(right)[0]}}}", _POWER
        case ast.Call(func=ast.Name(id=name), args=arguments):
            shown = ", ".join(_node(argument)[0] for argument in arguments)
            return _function(name[2:], shown), _POWER
    raise ValueError(ast.dump(node))


def _number(value: object) -> str:
    text = repr(value)
    mantissa, exponent, power = text.partition("e")
    return rf"{mantissa} \cdot 10^{{{int(power)}}}" if exponent else text


def _function(name: str, shown: str) -> str:
    if name == "sqrt":
        return rf"\sqrt{{{shown}}}"
    if name in ("ln", "exp", "sin", "cos", "tan", "sinh", "cosh", "tanh"):
        return rf"\{name}\left({shown}\right)"
    return rf"\operatorname{{{_plain(name)}}}\left({shown}\right)"


def _plain(name: str) -> str:
    return name.replace("_", r"\_")


def _name(name: str) -> str:
    """``k_fast`` and ``k1`` with a subscript, ``theta`` in Greek."""
    found = re.fullmatch(r"([A-Za-z]+?)_?(\d+|(?<=_)\w+)?", name)
    stem, index = found.groups() if found else (name, None)
    if stem in _GREEK:
        shown = rf"\{stem}"
    elif len(stem) == 1:
        shown = stem
    else:
        shown = rf"\mathrm{{{_plain(stem)}}}"
    if index is None:
        return shown
    return f"{shown}_{{{index}}}" if index.isdigit() else rf"{shown}_{{\mathrm{{{_plain(index)}}}}}"
