"""Conversion of dictionaries to YAML text for the reader of model files."""

from __future__ import annotations

import json
import math
import os
import re
from typing import Any

import numpy as np

from ._core import InputError

_WORD = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_SPECIAL = {"null", "true", "false", "yes", "no", "on", "off", "y", "n"}


def yaml_text(value: Any, name: str) -> str:
    """The text of a dictionary: maps in block style, lists in one line.

    `name` stands for the dictionary in messages. A value without a YAML form raises an InputError with its path.
    """
    if not isinstance(value, dict):
        raise InputError(f"{name}: expected keys with values, found {_kind(value)}")
    return _block(value, name, "", "") if value else "{}\n"


def _block(entries: dict, name: str, path: str, indent: str) -> str:
    lines = []
    for key, value in entries.items():
        below = _below(key, name, path)
        if isinstance(value, dict) and value:
            lines.append(f"{indent}{_text(key)}:\n{_block(value, name, below, indent + '  ')}")
        else:
            lines.append(f"{indent}{_text(key)}: {_inline(value, name, below)}\n")
    return "".join(lines)


def _inline(value: Any, name: str, path: str) -> str:
    if isinstance(value, np.ndarray):
        value = value.tolist()
    elif isinstance(value, np.generic):
        value = value.item()
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return _number(value)
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, os.PathLike):
        return _text(os.fspath(value))
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_text(key)}: {_inline(each, name, _below(key, name, path))}"
                               for key, each in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_inline(each, name, f"{path}[{k}]") for k, each in enumerate(value, 1)) + "]"
    raise InputError(f"{name}: {path}: expected a number, a text, a list or keys with values, found {_kind(value)}")


def _number(value: float) -> str:
    """The shortest text that gives the same number."""
    if math.isfinite(value):
        return repr(float(value))
    return ".nan" if math.isnan(value) else ".inf" if value > 0 else "-.inf"


def _text(text: str) -> str:
    if _WORD.fullmatch(text) and text.lower() not in _SPECIAL:
        return text
    return json.dumps(text, ensure_ascii=False)


def _below(key: Any, name: str, path: str) -> str:
    if isinstance(key, str):
        return f"{path}.{key}" if path else key
    raise InputError(f"{name}: {path + ': ' if path else ''}a key must be a text, found {_kind(key)}")


def _kind(value: Any) -> str:
    kind = type(value).__name__
    return f"{'an' if kind[0] in 'aeiou' else 'a'} {kind}"
