"""Input that is right, and input that is legal though doubtful: warned of, and gone on with."""

from bases import DAM, DRY, GEO, MESH, MSH, Bad, case

DRAWN = "ground_m = [[0, 5], [10, 5], [25, 15], [35, 15]]\nbase_m = 0.0"
RING = [[0, 0], [35, 0], [35, 15], [25, 15], [10, 5], [0, 5]]
# What is warned of does not depend on the bracket: a wide one is found in a second.
FAST = ("--set", "sph.spacing_m=1.5", "--set", "stability.tolerance=0.1", "--set",
        "output.figures=false", "--set", "output.report=false")


def right(name, base, edits, *words):
    return case(name, base, edits, "no mistakes", *words, code=0)


def doubtful(name, base, edits, *words):
    return case(name, base, edits, "no mistakes", "warning", *words, code=0)


def ran(name, base, edits, *words, more=()):
    entry = case(name, base, edits, "warning:", *words, code=0)
    entry.command = ("run", "case.toml", "--out", "out", *FAST, *more)
    return entry


ENTRIES = [
    right("the sound case", DRY, []),
    right("the sound dam", DAM, []),
    right("an outline counter-clockwise", DRY, [(DRAWN, f"outline_m = {RING}")], "350 m2"),
    right("an outline clockwise", DRY, [(DRAWN, f"outline_m = {RING[::-1]}")], "350 m2"),
    right("an outline closed", DRY, [(DRAWN, f"outline_m = {RING + RING[:1]}")], "350 m2"),
    right("a zone clockwise", DAM, [("[[19, -4], [25, -4], [23, 9], [21, 9]]",
                                     "[[21, 9], [23, 9], [25, -4], [19, -4]]")]),
    right("a zone that reaches out of the section", DAM, [("[21, 9]]", "[21, 90]]")]),
    right("titles in every script", DRY, [("sound", "Böschung 堤防 سد 🌊")], "堤防"),
    Bad("a byte order mark and the line ends of Windows", ("no mistakes",),
        {"case.toml": b"\xef\xbb\xbf" + DRY.replace("\n", "\r\n").encode()}, code=0),
    Bad("no line end at the end", ("no mistakes",), {"case.toml": DRY.rstrip()}, code=0),
    Bad("comments in every script", ("no mistakes",), {"case.toml": "# 堤防 €\n" + DRY}, code=0),
    Bad("a case in a folder with blanks and quotes", ("no mistakes",),
        {"a 'b' \"c\" $d/case.toml": DRY}, ("check", "a 'b' \"c\" $d/case.toml"), 0),
    Bad("a geometry", ("no mistakes",), {"case.toml": MESH, "drawing.geo": GEO}, code=0),
    Bad("a mesh", ("no mistakes",), {"case.toml": MESH.replace(".geo", ".msh"),
                                     "drawing.msh": MSH}, code=0),
    Bad("a mesh with the line ends of Windows", ("no mistakes",),
        {"case.toml": MESH.replace(".geo", ".msh"), "drawing.msh": MSH.replace("\n", "\r\n")},
        code=0),
    Bad("a mesh by an absolute path", ("no mistakes",), {"case.toml": MESH, "far/drawing.geo": GEO},
        ("check", "case.toml", "--set", "section.mesh_file=@/far/drawing.geo"), 0),
    Bad("a mesh in a folder below", ("no mistakes",), {"case.toml": MESH, "far/drawing.geo": GEO},
        ("check", "case.toml", "--set", "section.mesh_file=far/../far/drawing.geo"), 0),

    doubtful("a spacing too coarse for the section", DRY,
             [("[water]", "[sph]\nspacing_m = 3\n[water]")], "sph.spacing_m = 3", "10"),
    doubtful("dilation that the reduction undercuts", DRY,
             [("dilation_angle_deg = 0", "dilation_angle_deg = 30")], "soil.fill",
             "dilation_angle_deg = 30"),
    doubtful("zones without contrast for the water", DAM, [("= 1e-8", "= 1e-6")],
             "conductivity_m_s", "the same"),
    doubtful("a pool on a dry case", DRY, [('"none"', '"none"\nleft_level_m = 8')],
             "water.left_level_m", "left out of account"),
    doubtful("boundaries of a case without seepage", DAM, [('"seepage"', '"hydrostatic"'), (
        "[water]", '[[seepage.boundary]]\nkind = "seepage_face"\nline_m = [[30, -4], [44, -4]]\n'
        "[water]")], "seepage.boundary", "no effect"),
    doubtful("a soil without strength", DRY, [("= 10", "= 0"), ("= 30", "= 0")], "soil.fill",
             "no strength"),
    doubtful("a pool above the crest", DAM, [("= 8.0", "= 11.0")], "crest"),

    ran("a run with a pool on a dry case", DRY, [('"none"', '"none"\nleft_level_m = 8')],
        "water.left_level_m"),
    ran("a run whose factor is below one", DRY, [("= 10", "= 1"), ("= 30", "= 20")], "below 1"),
    ran("a run with dilation as large as friction", DRY,
        [("dilation_angle_deg = 0", "dilation_angle_deg = 30")], "dilation_angle_deg = 30"),
    ran("a run of coarse particles", DRY, [], "spacing_m = 3",
        more=("--set", "sph.spacing_m=3")),
]
