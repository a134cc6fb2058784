"""Every key of `berm reference --format json-schema`, wrong in every way its type allows.

All keys are wrong in one way at a time, in one file: every one must be told with its line."""

import json
import os
import subprocess

from bases import Bad

LONG = "x" * 201


def leaves(schema, path=""):
    """Every key: its path and schema; any name is `fill`, any list has one table."""
    for name, child in schema.get("properties", {}).items():
        at = f"{path}.{name}" if path else name
        if child.get("type") == "object":
            named = child.get("additionalProperties")
            yield from leaves(named, at + ".fill") if isinstance(named, dict) else leaves(child, at)
        elif child.get("type") == "array" and child["items"].get("type") == "object":
            yield from leaves(child["items"], at + "[1]")
        else:
            yield at, child


def beyond(schema, end):
    """A number just outside, or None where there is no such end; a number inside a list likewise."""
    exclusive = "exclusiveMinimum" if end < 0 else "exclusiveMaximum"
    bound = schema.get("minimum" if end < 0 else "maximum")
    if exclusive in schema:
        return schema[exclusive]
    if bound is None:
        return None
    return bound + end if schema["type"] == "integer" else bound + end * max(1e-3, abs(bound) * 1e-3)


def nest(value, depth):
    return value if depth == 0 or value is None else [nest(value, depth - 1)]


def out_of_range(schema, end):
    if "anyOf" in schema:
        return out_of_range(schema["anyOf"][0], end)
    if schema.get("type") in ("number", "integer"):
        return beyond(schema, end)
    if schema.get("type") == "array":
        item = schema["items"]
        if "enum" in item:
            return None  # words have no range
        if item["type"] == "number":
            return [beyond(item, end)] * 2
        wrong = beyond(item["items"], end)
        return [[0, 0], [1, 0], [wrong, 1]]
    return None


def is_list(schema):
    return schema.get("type") == "array" or any(map(is_list, schema.get("anyOf", [])))


def is_only_list(schema):
    return schema.get("type") == "array" or (
        "anyOf" in schema and all(map(is_list, schema["anyOf"])))


def is_text(schema):
    return schema.get("type") == "string"


WAYS = {
    "below its range": lambda s: out_of_range(s, -1),
    "above its range": lambda s: out_of_range(s, 1),
    "a text": lambda s: None if is_text(s) else "some words",
    "a text of 201 letters": lambda s: LONG,
    "a number": lambda s: 12.5 if is_text(s) or is_only_list(s) or "enum" in s
                          or s.get("type") in ("integer", "boolean") else None,
    "true": lambda s: None if s.get("type") == "boolean" else True,
    "a table": lambda s: {},
    "a date": lambda s: "DATE",
    "an empty list": lambda s: [],
    "a list of texts": lambda s: ["a", "b", "c"],
    "a list in lists in lists": lambda s: [[[[1]]]],
    "not a number": lambda s: "NAN",
    "infinite": lambda s: "INF",
}


def toml(value):
    special = {"DATE": "2024-02-03", "NAN": "nan", "INF": "inf"}
    if isinstance(value, str):
        return special.get(value, json.dumps(value))
    return "{}" if value == {} else json.dumps(value)


def entry(way, wrong, keys):
    """A file with all keys wrong, a line each."""
    lines, words, header = [], [], None
    for path, schema in sorted(keys, key=lambda key: "." in key[0]):  # those of the top first
        value = wrong(schema)
        if value is None:
            continue
        table, _, name = path.rpartition(".")
        if table != header and table:
            lines.append(f"[[{table[:-3]}]]" if table.endswith("[1]") else f"[{table}]")
            header = table
        lines.append(f"{name} = {toml(value)}")
        words.append(f"case.toml:{len(lines)}: {path} = ")
    return Bad("every key " + way, tuple(words) + ("  allowed: ",),
               {"case.toml": "\n".join(lines) + "\n"})


def entries():
    text = subprocess.run([os.environ["BERM"], "reference", "--format", "json-schema"], check=True,
                          capture_output=True, text=True).stdout
    keys = list(leaves(json.loads(text)))
    assert len(keys) > 60
    made = [entry(way, wrong, keys) for way, wrong in WAYS.items()]
    print(sum(len(e.words) - 1 for e in made), "wrong values of", len(keys), "keys")
    return made
