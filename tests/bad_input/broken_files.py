"""Meshes, places of files, directories of results and command lines that cannot be."""

import os
import subprocess

from bases import DRY, GEO, MESH, MSH, Bad, case, mesh

NO_SURFACE = GEO[:GEO.index("Physical")]


def msh(name, edits, *words):
    text = MSH
    for old, new in edits:
        assert old in text, (name, old)
        text = text.replace(old, new, 1)
    return mesh(name, text, *words, file="drawing.msh")


def geo(name, more, *words):
    return mesh(name, GEO + more + "\n", *words)


MESHES = [
    mesh("an empty geometry", b"", "drawing.geo"),
    mesh("a geometry that only ends", b"\n", "no physical surfaces"),
    mesh("a geometry of zeros", b"\0" * 1000 + b"\n", "drawing.geo"),
    mesh("a geometry of every byte", bytes(range(256)) * 20 + b"\n", "drawing.geo"),
    mesh("a geometry cut short", GEO[:len(GEO) // 2] + "\n", "gmsh cannot read it"),
    mesh("a geometry without a last line end", GEO.rstrip(), "the last line does not end"),
    mesh("a geometry without physical surfaces", NO_SURFACE, "no physical surfaces",
         'Physical Surface("fill")'),
    mesh("a surface without a name", NO_SURFACE + "Physical Surface(7) = {1};\n",
         "physical surface 7 has no name", "the name of a soil"),
    mesh("a surface of no soil", GEO.replace("fill", "clay"), '"clay"', "no soil has"),
    mesh("a surface that does not exist", NO_SURFACE + 'Physical Surface("fill") = {9};\n',
         "drawing.geo"),
    mesh("a geometry out of the plane", GEO.replace("20, 5, 0", "20, 5, 3"), "z = "),
    mesh("a geometry in light years", GEO.replace("20, 5, 0", "1e16, 5, 0"), "x, y <= 100000"),
    mesh("a geometry of no area", GEO.replace("20, 5, 0}; Point(4) = {0, 5", "20, 0, 0}; "
                                              "Point(4) = {0, 0"), "drawing.geo"),
    geo("two pieces", "Point(5) = {50, 0, 0}; Point(6) = {60, 0, 0}; Point(7) = {60, 5, 0};\n"
        "Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 5}; Curve Loop(2) = {5, 6, 7};\n"
        'Plane Surface(2) = {2}; Physical Surface("more") = {2};', "pieces"),
    geo("a loop without end", "For i In {1:2}\n i = 1;\nEndFor", "takes longer than 4 s"),
    geo("a billion points", "For i In {10:1000000000}\n Point(i) = {i, i, 0};\nEndFor",
        "gmsh cannot read it"),
    geo("a function that calls itself", "Macro a\nCall a;\nReturn\nCall a;", "drawing.geo"),
    geo("a border of a billion edges", "Transfinite Curve {1} = 1000000000;",
        "gmsh cannot read it"),
    geo("a system call", 'SystemCall "touch here";', "holds the word SystemCall"),
    geo("a system", 'System "touch here";', "holds the word System"),
    geo("a folder made", 'CreateDir "here";', "holds the word CreateDir"),
    geo("another file", 'Include "case.toml";', "holds the word Include"),
    geo("a file written", 'Save "here.msh";', "holds the word Save"),
    geo("a file printed", 'Printf("a") > "here";', "holds the word Print"),
    geo("words that gmsh does not know", "Foo Bar;", "gmsh cannot read it"),
    mesh("a geometry named .msh", GEO, "does not begin with $MeshFormat", file="drawing.msh"),
    mesh("a mesh of nothing", b"", "does not begin with $MeshFormat", file="drawing.msh"),
    mesh("a mesh of zeros", b"\0" * 1000, "does not begin with $MeshFormat", file="drawing.msh"),
    mesh("a mesh of its first line", "$MeshFormat\n", "drawing.msh", file="drawing.msh"),
    mesh("a mesh and then garbage", b"$MeshFormat\n" + bytes(range(256)) * 50, "drawing.msh",
         file="drawing.msh"),
    mesh("a mesh cut short", MSH[:len(MSH) * 2 // 3], "drawing.msh", file="drawing.msh"),
    mesh("a mesh of 101 MB", MSH.encode() + b"\n" * 101_000_000, "101 MB", "at most 100 MB",
         file="drawing.msh"),
    msh("a mesh of format 99", [("2.2 0 8", "99.9 0 8")], "drawing.msh"),
    msh("a mesh said to be binary", [("2.2 0 8", "2.2 1 8")], "drawing.msh"),
    msh("a mesh with a surface of no soil", [('"fill"', '"clay"')], '"clay"', "no soil has"),
    msh("a mesh without physical names", [('1\n2 1 "fill"\n', "0\n")], "has no name"),
    msh("a mesh with 9e18 nodes", [("$Nodes\n4", "$Nodes\n9000000000000000000")], "drawing.msh"),
    msh("a mesh with -1 nodes", [("$Nodes\n4", "$Nodes\n-1")], "drawing.msh"),
    msh("a mesh with 9e9 elements", [("$Elements\n2", "$Elements\n9000000000")], "drawing.msh"),
    msh("a mesh with a node that is not there", [("1 1 1 2 3", "1 1 1 2 77")], "drawing.msh"),
    msh("a mesh of nan", [("3 20 5 0", "3 nan 5 0")], "drawing.msh"),
    msh("a mesh at 1e300", [("3 20 5 0", "3 1e300 5 0")], "drawing.msh"),
    msh("a mesh with words for numbers", [("3 20 5 0", "3 a b c")], "drawing.msh"),
    msh("a mesh of no triangles", [("2\n1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n", "0\n")],
        "drawing.msh"),
    msh("a mesh of unknown elements", [("1 2 2 1 1 1 2 3", "1 999 2 1 1 1 2 3")], "drawing.msh"),
    msh("a mesh of one triangle twice over", [("2 2 2 1 1 1 3 4", "2 2 2 1 1 1 2 3")],
        "areas lie on each other", "without overlaps"),
]


def named(name, path, *words, **more):
    return case(name, MESH, [("drawing.geo", path)], "section.mesh_file", *words, **more)


def link_to_itself(path):
    path.symlink_to(path.name)


def link_to_hosts(path):
    path.symlink_to("/etc/hosts")


def sealed(path):
    path.write_text(DRY)
    path.chmod(0)


AS_NOBODY = os.geteuid() != 0  # root may read everything
NOBODY = ["setpriv", "--reuid=65534", "--clear-groups"]
PLACES = [
    Bad("a case that is not there", ("no/case.toml", "cannot be opened"), {},
        ("check", "no/case.toml"), 4),
    Bad("a folder for a case", ("is a directory",), {"case.toml": None}, code=4),
    Bad("no name for a case", ("cannot be opened",), {}, ("check", ""), 4),
    Bad("a device for a case", ("larger than 2 MB",), {}, ("check", "/dev/zero"), 4),
    Bad("nothing for a case", ("missing key format",), {}, ("check", "/dev/null")),
    Bad("a name of 5000 letters", ("cannot be opened",), {}, ("check", "x" * 5000), 4),
    Bad("a link to itself", ("cannot be opened",),
        {"case.toml": link_to_itself}, code=4),
    named("a mesh that is not there", "nowhere.msh", "there is no such file"),
    named("a mesh of another kind", "drawing.stl", "a .geo or .msh of gmsh"),
    named("a mesh without a name", "", "a .geo or .msh of gmsh"),
    named("a mesh out of the folder", "../drawing.geo", "leads out of the case file's folder"),
    named("a mesh out of the folder by a way round", "a/../../drawing.geo", "leads out"),
    named("a mesh with a path of many links", "x/" * 90 + "drawing.geo", "there is no such file"),
    named("a mesh with a long name", "x" * 190 + ".geo", "there is no such file"),
    Bad("a folder for a mesh", ("section.mesh_file", "there is no such file"),
        {"case.toml": MESH, "drawing.geo": None}),
    Bad("a pipe for a mesh", ("section.mesh_file", "there is no such file"),
        {"case.toml": MESH, "drawing.geo": os.mkfifo}),
    Bad("a mesh by a link out of the folder", ("section.mesh_file", "leads out"),
        {"case.toml": MESH, "drawing.geo": link_to_hosts}),
    Bad("a mesh by a link to itself", ("section.mesh_file", "there is no such file"),
        {"case.toml": MESH, "drawing.geo": link_to_itself}),
]
if AS_NOBODY:
    PLACES.append(Bad("a case that may not be read", ("cannot be opened",), {"case.toml": sealed},
                      code=4))
elif subprocess.run([*NOBODY, "test", "-x", os.environ.get("BERM", "")], check=False).returncode == 0:
    PLACES.append(Bad("a case that may not be read", ("case.toml: cannot be opened",),
                      {"case.toml": sealed}, ("as nobody", "check", "@/case.toml"), 4))
else:
    print("left out: a case that may not be read (root reads all, and nobody cannot start berm)")

RESULT = '{"format": 1, "inputs": {}'


def results(name, files, *words, code=2):
    return Bad(name, words, {f"out/{key}": value for key, value in files.items()},
               ("report", "out"), code, nothing_run=False)


def json_of(name, text, *words, code=2):
    return results(name, {"result.json": text, "case.toml": DRY}, "out", *words, code=code)


RUN = {"case.toml": DRY, "result.json": RESULT + "}"}
RESULTS = [
    Bad("results that are not there", ("nowhere", "is not a directory"), {}, ("report", "nowhere"),
        nothing_run=False),
    Bad("a file for results", ("is not a directory",), {"out": "text"}, ("report", "out"),
        nothing_run=False),
    Bad("an empty folder for results", ("holds neither result.json",), {"out": None},
        ("report", "out"), nothing_run=False),
    json_of("an empty result", "", "result.json", "run the case again"),
    json_of("a result cut short", RESULT, "result.json", "run the case again"),
    json_of("a result of zeros", b"\0" * 100, "run the case again"),
    json_of("a result that is a list", "[1, 2]", "run the case again"),
    json_of("a result of a later format", '{"format": 2, "inputs": {}}', "run the case again"),
    json_of("a result without inputs", '{"format": 1}', "run the case again"),
    json_of("a result of 100 000 brackets", '{"a":' * 100000, "out"),
    json_of("a result without fields", RESULT + "}", "results.h5", code=4),
    json_of("a result whose seepage is a number", RESULT + ', "seepage": 3}', "out"),
    json_of("a result whose lines are a number", RESULT + ', "seepage": {"lines": 3}}', "out"),
    json_of("a result whose lines have no file", RESULT + ', "seepage": {"lines": [{}]}}', "out"),
    json_of("a line out of the folder",
            RESULT + ', "seepage": {"lines": [{"file": "../../../etc/passwd"}]}}', "lines/passwd",
            code=4),
    results("a result without its case", {"result.json": RESULT + "}"}, "case.toml", code=4),
    results("fields of nothing", RUN | {"results.h5": b""}, "results.h5", code=4),
    results("fields of zeros", RUN | {"results.h5": b"\0" * 5000}, "results.h5", code=4),
    results("fields of every byte", RUN | {"results.h5": bytes(range(256)) * 40}, "results.h5",
            code=4),
    results("fields that only begin", RUN | {"results.h5": b"\x89HDF\r\n\x1a\n" + b"\0" * 88},
            "results.h5", code=4),
    results("a folder for fields", RUN | {"results.h5": None}, "results.h5", code=4),
    results("a comparison of nothing", {"comparison.json": "{}"}, "comparison.json"),
    results("a comparison of no waters", {"comparison.json": '{"format": 1, "waters": []}'}, "out"),
    results("a comparison of a number", {"comparison.json": '{"format": 1, "waters": 3}'}, "out"),
    results("a comparison of nameless waters",
            {"comparison.json": '{"format": 1, "waters": [{}]}'}, "out"),
    results("a study of nothing", {"study.json": "{}"}, "study.json"),
    results("a study without its case", {"study.json": '{"format": 1, "members": []}'},
            "case.toml", code=4),
    results("a folder for a result", {"result.json": None}, "out/result.json", "cannot be read",
            code=4),
]


def typed(name, command, *words, code=2, nothing_run=False, files=None):
    return Bad(name, words, {"case.toml": DRY} | (files or {}), tuple(command), code, nothing_run)


def vary(name, texts, *words, more=()):
    flags = [part for text in texts for part in ("--vary", text)]
    return typed(name, ["study", "case.toml", *flags, *more], *words, nothing_run=True)


COMMANDS = [
    typed("a command that is none", ["walk", "case.toml"], "walk"),
    typed("no case", ["check"], "CASE is required"),
    typed("two cases", ["check", "case.toml", "case.toml"], "case.toml"),
    typed("an option that is none", ["run", "case.toml", "--fast"], "--fast"),
    typed("an option of another command", ["check", "case.toml", "--out", "x"], "--out"),
    typed("quiet and verbose", ["run", "case.toml", "--quiet", "--verbose"], "--verbose"),
    typed("no threads", ["run", "case.toml", "--threads", "0"], "--threads", "range 1 to 1024"),
    typed("2000 threads", ["run", "case.toml", "--threads", "2000"], "--threads", "range 1 to 1024"),
    typed("threads in words", ["run", "case.toml", "--threads", "two"], "--threads"),
    typed("1e99 threads", ["run", "case.toml", "--threads", "1" * 99], "--threads"),
    typed("a template that is none", ["init", "x", "--template", "canal"], "canal", "embankment"),
    typed("a format that is none", ["reference", "--format", "pdf"], "pdf", "json-schema"),
    typed("a shell that is none", ["completion", "cmd"], "cmd", "bash"),
    typed("results in a file's place", ["run", "case.toml", "--out", "case.toml"], "case.toml",
          "cannot be made a directory", code=4),
    typed("results under a file", ["run", "case.toml", "--out", "case.toml/x"], "case.toml/x",
          code=4),
    typed("results in a device", ["run", "case.toml", "--out", "/dev/null"], "/dev/null", code=4),
    typed("results in a long name", ["run", "case.toml", "--out", "x" * 5000], "cannot be made",
          code=4),
    typed("a log in a folder's place", ["run", "case.toml", "--log", "/", "--out", "out"],
          "--log /: cannot be opened", code=4, files={"out": None}),
    typed("a case to begin that is there", ["init", "case"], "case.toml: is there already", code=4),
    typed("a case to begin nowhere", ["init", "no/folder/x"], "no/folder/x", code=4),
    vary("--vary without values", ["sph.spacing_m"], "not of the form key=values"),
    vary("--vary without a key", ["=1,2"], "="),
    vary("--vary of nothing", [""], "not of the form key=values"),
    vary("--vary with an empty value", ["sph.spacing_m=1,,2"], "a value is empty"),
    vary("--vary with a value twice", ["sph.spacing_m=1,1.0"], "is there twice"),
    vary("--vary of a key twice", ["sph.spacing_m=1", "sph.spacing_m=2"], "is varied already"),
    vary("--vary of an unknown key", ["sph.spacing=1,2"], "unknown key sph.spacing",
         "did you mean spacing_m?"),
    vary("--vary out of range", ["sph.spacing_m=1,-1"], "sph.spacing_m=-1", "spacing_m <="),
    vary("--vary over a range of one", ["sph.spacing_m=1:2:1"], "is not a range", "from 2 to 1000"),
    vary("--vary over a million", ["sph.spacing_m=1:2:1000000"], "is not a range"),
    vary("--vary over half a step", ["sph.spacing_m=1:2:2.5"], "is not a range"),
    vary("--vary over nan", ["sph.spacing_m=1:nan:3"], "is not a range"),
    vary("--vary in ratios from zero", ["sph.spacing_m=0:2:3:log"], "ends above 0"),
    vary("--vary with too many colons", ["sph.spacing_m=1:2:3:log:4"], "is not a range"),
    vary("--vary over 1000 x 1000 members",
         ["soil.fill.cohesion_kPa=1:2:1000", "soil.fill.friction_angle_deg=20:30:1000"], "members"),
    vary("--pairs of different lengths",
         ["soil.fill.cohesion_kPa=1,2", "soil.fill.friction_angle_deg=20,25,30"], "--vary",
         more=["--pairs"]),
    typed("no --vary", ["study", "case.toml"], "--vary is required"),
    typed("no jobs", ["study", "case.toml", "--vary", "sph.spacing_m=1", "--jobs", "0"], "--jobs"),
]
