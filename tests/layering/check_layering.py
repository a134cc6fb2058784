#!/usr/bin/env python3
"""Check who includes whom, who prints, and `using namespace` in headers. Standard library only.

usage: check_layering.py ROOT        exit 0: clean, 1: violations, one a line, 2: wrong usage
"""
import fnmatch
import re
import sys
from pathlib import Path

# A module may include itself and these. Tests and bench may include anything; nothing includes them.
MAY_INCLUDE = {
    "core": set(),
    "meshes": {"core"},
    "seepage": {"core", "meshes"},
    "sph": {"core", "meshes"},
    "coupling": {"core", "meshes", "seepage", "sph"},
    "app": {"core", "meshes", "seepage", "sph", "coupling"},
}
FOLDERS = set(MAY_INCLUDE) | {"tests", "bench"}

# Library headers: (what is included, which files may, how many files may, why).
LIBRARIES = [
    (r"(dolfinx|basix)[/.].*|petsc.*\.h|ufcx\.h", "seepage/[sd]ol[vf]*", 2,
     "a new dolfinx must touch few files"),
    (r"gmsh\.h.*", "meshes/[gm][me]s*.cpp", 3, "a new gmsh must touch few files"),
    (r"toml\+\+/.*|toml\.hpp", "app/*.cpp", 1, "one user of TOML"),
    (r"hdf5.*\.h|H5.*", "app/*.cpp", 1, "one user of HDF5"),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
PRINTS = re.compile(r"\bstd::(?:cout|cerr|clog)\b|\b(?:v?f?printf|puts|perror)\s*\(|\bfmt::print\b")
USING_NAMESPACE = re.compile(r"\busing\s+namespace\b")
COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)


def without_comments(text):
    """The text with comments blanked; strings and line numbers stay."""

    def blank(match):
        found = match.group(0)
        return found if found.startswith('"') else re.sub(r"[^\n]", " ", found)

    return COMMENT.sub(blank, text)


def check_include(root, module, file, bracket, header):
    """What is wrong with an include of ours or of a library, or None."""
    folder = header.split("/")[0]
    if bracket == '"' and folder not in FOLDERS:
        beside = (root / file).parent / header  # if not there, it is generated in the build folder
        if beside.exists():
            from_root = beside.relative_to(root).as_posix()
            return f'"{header}" is not written from the root: "{from_root}"'
    elif folder in FOLDERS and bracket == '"':
        if folder != module and folder not in MAY_INCLUDE[module]:
            allowed = ", ".join([*sorted(MAY_INCLUDE[module]), module])
            return f'{module} includes "{header}"; allowed: {allowed}'
    for pattern, where, _, why in LIBRARIES:
        if re.fullmatch(pattern, header) and not fnmatch.fnmatch(file, where):
            return f"includes <{header}>; allowed only in {where}: {why}"
    return None


def violations(root):
    """Every violation below root as 'file:line: what is wrong'."""
    found = []
    users = {pattern: set() for pattern, *_ in LIBRARIES}
    for module in MAY_INCLUDE:
        for path in sorted((root / module).rglob("*")):
            if path.suffix not in (".h", ".cpp"):
                continue
            file = path.relative_to(root).as_posix()
            for number, line in enumerate(without_comments(path.read_text()).splitlines(), 1):
                place = f"{file}:{number}: "
                if include := INCLUDE.match(line):
                    if problem := check_include(root, module, file, *include.groups()):
                        found.append(place + problem)
                    for pattern in users:
                        if re.fullmatch(pattern, include.group(2)):
                            users[pattern].add(file)
                elif module != "app" and PRINTS.search(line):
                    found.append(place + "prints; allowed only in app: tell the observer")
                elif path.suffix == ".h" and USING_NAMESPACE.search(line):
                    found.append(place + "`using namespace` in a header")
    for pattern, where, most, why in LIBRARIES:
        files = {file for file in users[pattern] if fnmatch.fnmatch(file, where)}
        if most is not None and len(files) > most:
            found.append(f"{' and '.join(sorted(files))}: {why}, so {most} file only")
    return found


def main(arguments):
    if len(arguments) != 1 or not (Path(arguments[0]) / "core").is_dir():
        print(__doc__, file=sys.stderr)
        return 2
    found = violations(Path(arguments[0]))
    print("\n".join(found) if found else "the layering holds")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
