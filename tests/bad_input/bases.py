"""Sound cases to be broken, and what an entry of the corpus is."""

import dataclasses

STIFFNESS = """dilation_angle_deg = 0
young_modulus_kPa = 1e5
poisson_ratio = 0.3
"""

FILL = """[soil.fill]
unit_weight_kN_m3 = 18
cohesion_kPa = 10
friction_angle_deg = 30
""" + STIFFNESS

DRY = """format = 1
title = "sound"
[section]
ground_m = [[0, 5], [10, 5], [25, 15], [35, 15]]
base_m = 0.0
""" + FILL + """[water]
pore_pressure = "none"
"""

CORE = """[soil.core]
unit_weight_kN_m3 = 19
cohesion_kPa = 20
friction_angle_deg = 25
""" + STIFFNESS + """conductivity_m_s = 1e-8
"""

DAM = """format = 1
[section]
ground_m = [[0, 0], [20, 10], [24, 10], [44, 0]]
base_m = [[0, -4], [44, -4]]
[[section.zone]]
soil = "core"
polygon_m = [[19, -4], [25, -4], [23, 9], [21, 9]]
""" + FILL + """conductivity_m_s = 1e-6
[water]
pore_pressure = "seepage"
left_level_m = 8.0
""" + CORE

MESH = DRY.replace("ground_m = [[0, 5], [10, 5], [25, 15], [35, 15]]\nbase_m = 0.0",
                   'mesh_file = "drawing.geo"')

GEO = """Point(1) = {0, 0, 0}; Point(2) = {20, 0, 0}; Point(3) = {20, 5, 0}; Point(4) = {0, 5, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Surface("fill") = {1};
"""

MSH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
2 1 "fill"
$EndPhysicalNames
$Nodes
4
1 0 0 0
2 20 0 0
3 20 5 0
4 0 5 0
$EndNodes
$Elements
2
1 2 2 1 1 1 2 3
2 2 2 1 1 1 3 4
$EndElements
"""


@dataclasses.dataclass
class Bad:
    """One broken input: files, a command, and what the answer has to hold."""

    name: str
    words: tuple  # all of them stand in the message
    files: dict = dataclasses.field(default_factory=dict)  # name to text or bytes; None: a folder
    command: tuple = ("check", "case.toml")
    code: int = 2
    nothing_run: bool = True  # the message ends so (not that of the command line's own mistakes)


def case(name, base, edits, *words, **more):
    """A base with pieces of its text replaced, each of which must be there."""
    text = base
    for old, new in edits:
        assert old in text, (name, old)
        text = text.replace(old, new, 1)
    return Bad(name, words, {"case.toml": text}, **more)


def given(name, setting, *words, base=DRY, **more):
    """A base with one --set, which the message names as the place."""
    key = setting.split("=")[0]
    return Bad(name, words or (key,), {"case.toml": base},
               ("check", "case.toml", "--set", setting), **more)


def raw(name, data, *words, **more):
    return Bad(name, words, {"case.toml": data}, **more)


def mesh(name, data, *words, file="drawing.geo", base=MESH, **more):
    text = base.replace("drawing.geo", file)
    return Bad(name, ("section.mesh_file", *words), {"case.toml": text, file: data}, **more)
