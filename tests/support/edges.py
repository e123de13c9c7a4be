"""Every field of a scene at the ends of its range, by the schema that the API publishes."""

import copy
from collections.abc import Iterator
from typing import Any

from seafoam.scene.models import Scene

Path = tuple[str | int, ...]
_SCHEMA = Scene.model_json_schema()
_KINDS: dict[str, type | tuple[type, ...]] = {
    "null": type(None),
    "boolean": bool,
    "number": (int, float),
    "integer": (int, float),
    "string": str,
    "array": list,
    "object": dict,
}


def edges(scene: Scene) -> Iterator[tuple[Path, Any]]:
    """Path and value: both ends of each number, other values of each choice, and nothing where that is allowed.

    The camera's fields are left out: other tests move it.
    """
    for path, value in _of(_SCHEMA, scene.model_dump(mode="json"), ()):
        if path[0] != "camera":
            yield path, value


def changed(scene: Scene, *changes: tuple[Path, Any]) -> Scene:
    """The scene with other values. Raises ``ValueError`` where they are refused, or their place is gone."""
    document = scene.model_dump(mode="json")
    for path, value in changes:
        node: Any = document
        try:
            for step in path[:-1]:
                node = node[step]
            node[path[-1]] = copy.deepcopy(value)
        except (TypeError, IndexError, KeyError):
            raise ValueError(f"{path}: no such place") from None
    return Scene.model_validate(document)


def _of(node: Any, value: Any, path: Path) -> Iterator[tuple[Path, Any]]:
    options = list(_options(node))
    if value is not None and any(option.get("type") == "null" for option in options):
        yield path, None
    fitting = next((option for option in options if _fits(option, value)), None)
    if fitting is None or "const" in fitting:
        return
    if "enum" in fitting:
        yield from ((path, other) for other in fitting["enum"] if other != value)
    elif isinstance(value, bool):
        yield path, not value
    elif isinstance(value, int | float):
        yield from ((path, fitting[end]) for end in ("minimum", "maximum") if fitting.get(end, value) != value)
    elif isinstance(value, list):
        for index, item in enumerate(value):
            inner = fitting["prefixItems"][index] if "prefixItems" in fitting else fitting["items"]
            yield from _of(inner, item, (*path, index))
        if value and "prefixItems" not in fitting and not fitting.get("minItems"):
            yield path, []
    elif isinstance(value, dict):
        for name, item in value.items():
            if name in fitting.get("properties", {}):
                yield from _of(fitting["properties"][name], item, (*path, name))


def _options(node: Any) -> Iterator[Any]:
    if "$ref" in node:
        yield from _options(_SCHEMA["$defs"][node["$ref"].rsplit("/", 1)[1]])
    elif either := node.get("anyOf") or node.get("oneOf"):
        for one in either:
            yield from _options(one)
    else:
        yield node


def _fits(option: Any, value: Any) -> bool:
    kind = option.get("type", "string")
    if isinstance(value, bool) != (kind == "boolean") or not isinstance(value, _KINDS[kind]):
        return False
    constants = {name: one["const"] for name, one in option.get("properties", {}).items() if "const" in one}
    return not isinstance(value, dict) or all(value.get(name, one) == one for name, one in constants.items())
