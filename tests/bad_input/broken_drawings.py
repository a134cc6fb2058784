"""Sections, zones, boundaries and lines that cannot be."""

import math

from bases import DAM, DRY, case

GROUND = "ground_m = [[0, 5], [10, 5], [25, 15], [35, 15]]"
BASE = "base_m = 0.0"
DRAWN = GROUND + "\n" + BASE
ZONE = "polygon_m = [[19, -4], [25, -4], [23, 9], [21, 9]]"


def ground(name, points, *words):
    return case(name, DRY, [(GROUND, f"ground_m = {points}")], *words)


def outline(name, points, *words):
    return case(name, DRY, [(DRAWN, f"outline_m = {points}")], *words)


def zone(name, points, *words):
    return case(name, DAM, [(ZONE, f"polygon_m = {points}")], *words)


def more(name, text, *words, base=DAM):
    return case(name, base, [("[soil.core]", text + "\n[soil.core]")], *words)


def boundary(name, text, *words):
    return more(name, "[[seepage.boundary]]\n" + text, *words)


def line(name, text, *words):
    return more(name, "[[output.line]]\n" + text, *words)


def ring(points, radius=10.0):
    return [[round(20 + radius * math.cos(2 * math.pi * k / points), 9),
             round(radius * math.sin(2 * math.pi * k / points), 9)] for k in range(points)]


MANY = "[" + ",".join(f"[{20 + k // 2 / 1e3:g},{k % 2}]" for k in range(5000)) + "]"
STAR = [[0, 0], [20, 15], [-5, 15], [15, 0], [7, 25]]
AT = "case.toml:4: section."
BROKEN = [
    ground("ground of no points", [], AT + "ground_m = []", "has 0 points", "at least 2 points"),
    ground("ground of one point", [[0, 5]], AT + "ground_m", "has 1 point", "at least 2 points"),
    ground("ground of numbers", [0, 5, 10, 5], AT + "ground_m", "point 1 is not [x, y]"),
    ground("ground in space", [[0, 5, 0], [10, 5, 0]], AT + "ground_m", "point 1 is not [x, y]"),
    ground("ground with nan", "[[0, 5], [10, nan]]", "y of point 2 is not a finite number"),
    ground("ground with infinity", "[[0, 5], [inf, 5]]", "x of point 2 is not a finite number"),
    ground("ground at 1e300", "[[0, 5], [1e300, 5]]", "x of point 2", "x, y <= 100000"),
    ground("ground of texts", '[["0", "5"], [1, 2]]', "x of point 1 is not a number"),
    ground("ground deep in brackets", "[[[[[0, 5]]]], [10, 5]]", "point 1 is not [x, y]"),
    ground("ground from right to left", [[35, 15], [0, 5]], AT + "ground_m = (0, 5)",
           "x falls from point 1 to point 2", "left to right"),
    ground("ground with an overhang", [[0, 5], [20, 9], [15, 12], [35, 15]], "(15, 12)",
           "x falls from point 2 to point 3", "outline_m"),
    ground("ground with a point twice", [[0, 5], [0, 5], [35, 15]], "points 1 and 2 are the same"),
    ground("ground of one place", [[3, 5], [3, 5]], "points 1 and 2 are the same"),
    ground("ground of no width", [[3, 5], [3, 15]], "section.base_m = (3, 0)", "are the same"),
    case("ground and base of no width", DRY,
         [(DRAWN, "ground_m = [[3, 5], [3, 15]]\nbase_m = [[3, 1], [3, 2]]")], "has no width"),
    ground("ground that folds back up", [[0, 5], [10, 5], [10, 15], [10, 8], [35, 15]],
           AT + "ground_m", "touches"),
    ground("ground below the base", [[0, -5], [35, -5]], "section.base_m", "5 m above the ground"),
    ground("ground through the base", [[0, 5], [18, -5], [35, 5]], "above the ground at x = 18"),
    ground("ground on the base", [[0, 0], [35, 0]], "no soil between ground and base"),
    ground("ground a hair above the base", [[0, 1e-12], [35, 1e-12]], "no soil between"),
    ground("ground of 5001 points", [[k / 100, 5] for k in range(5001)], "more than 5000"),
    case("base of another width", DRY, [(BASE, "base_m = [[0, 0], [20, 0]]")],
         "case.toml:5: section.base_m", "does not end where the ground ends", "to x = 35"),
    case("base from right to left", DRY, [(BASE, "base_m = [[35, 0], [0, 0]]")], "x falls"),
    case("base of one point", DRY, [(BASE, "base_m = [[0, 0]]")], "has 1 point"),
    case("base of text", DRY, [(BASE, 'base_m = "rock"')], 'section.base_m = "rock"',
         "a level or [[x, y], ...]"),
    case("base above all", DRY, [(BASE, "base_m = 99999")], "above the ground"),
    case("a base without ground", DRY, [(GROUND + "\n", "")], "missing key section.ground_m",
         "either ground_m and base_m, or outline_m, or mesh_file"),
    case("ground without a base", DRY, [(BASE + "\n", "")], "missing key section.base_m"),
    case("ground and an outline", DRY, [(BASE, BASE + "\noutline_m = [[0, 0], [1, 0], [0, 1]]")],
         "section.outline_m", "given together with ground_m or base_m"),
    outline("an outline of two points", [[0, 0], [9, 9]], "has 2 points", "at least 3 points"),
    outline("an outline of no area", [[0, 0], [9, 9], [18, 18]], AT + "outline_m"),
    outline("an outline of one place", [[1, 1], [1, 1], [1, 1]], "are the same"),
    outline("an outline like a bow tie", [[0, 0], [10, 10], [10, 0], [0, 10]], AT + "outline_m",
            "encloses no area"),
    outline("an outline like a crooked bow tie", [[0, 0], [10, 10], [10, 0], [0, 12]],
            AT + "outline_m", "edge 1 crosses edge 3"),
    outline("a star in one stroke", STAR, "crosses", "meet only at their common ends"),
    outline("an outline that touches itself", [[0, 0], [10, 0], [5, 5], [10, 10], [0, 10], [5, 5]],
            "touches"),
    outline("an outline with a spike", [[0, 0], [10, 0], [10, 10], [10, 15], [10, 10.5], [0, 10]],
            "touches"),
    outline("an outline closed twice", [[0, 0], [10, 0], [10, 10], [0, 0], [0, 0]], "are the same"),
    outline("an outline thinner than a hair", [[0, 0], [1e5, 0], [1e5, 1e-9], [0, 1e-9]], AT),
    outline("an outline with 0.1 um between points", [[0, 0], [1e4, 0], [1e4, 10], [1e4 - 1e-7, 10],
                                                      [0, 10]], "points 3 and 4 are the same"),
    zone("a zone outside", [[100, 100], [110, 100], [110, 110]], "section.zone[1].polygon_m",
         "lies outside the section"),
    zone("a zone in the air above", [[0, 8], [4, 8], [4, 10]], "lies outside the section"),
    zone("a zone beside, touching", [[44, -4], [60, -4], [60, 0], [44, 0]], "lies outside"),
    zone("a zone of two points", [[0, 0], [1, 1]], "case.toml:7: section.zone[1].polygon_m",
         "at least 3 points"),
    zone("a zone of no area", [[19, -4], [20, -3], [21, -2]], "section.zone[1].polygon_m"),
    zone("a zone that crosses itself", [[19, -4], [25, 9], [25, -4], [19, 9]], "crosses"),
    zone("a zone with a point twice", [[19, -4], [19, -4], [25, -4], [22, 9]], "are the same"),
    zone("a zone of nan", "[[19, nan], [25, -4], [22, 9]]", "y of point 1 is not a finite"),
    zone("a zone of no points", [], "section.zone[1].polygon_m = []", "has 0 points"),
    case("1001 zones", DAM, [("[[section.zone]]\n" + 'soil = "core"\n' + ZONE,
                              ("[[section.zone]]\n" + 'soil = "core"\n' + ZONE + "\n") * 1001)],
         "section.zone", "at most 1000 tables"),
    case("30 zones of 300 points outside", DRY,
         [("[soil.fill]", "".join(f'[[section.zone]]\nsoil = "fill"\npolygon_m = '
                                  f'{[[x + 9000, y] for x, y in ring(300)]}\n'.replace(" [", "[")
                                  for _ in range(30)) + "[soil.fill]")], "30 mistakes"),
    case("25 zones of 5000 points", DAM,
         [("[soil.core]", ('[[section.zone]]\nsoil = "core"\npolygon_m = ' + MANY + "\n") * 25
           + "[soil.core]")], "more than 10000 points in all"),
    case("a pool below the ground", DAM, [("= 8.0", "= -3.0")], "case.toml:18: water.left_level_m",
         "-3"),
    case("a pool at 1e300", DAM, [("= 8.0", "= 1e300")], "case.toml:18: water.left_level_m"),
    case("a pool of nan", DAM, [("= 8.0", "= nan")], "case.toml:18", "not a finite number"),
    case("seepage without water", DAM, [("left_level_m = 8.0\n", "")], "water.pore_pressure",
         "no water is given anywhere", "water.left_level_m"),
    case("hydrostatic without water", DAM,
         [('"seepage"', '"hydrostatic"'), ("left_level_m = 8.0\n", "")], "there is no water"),
    case("a free surface that goes back", DAM,
         [('"seepage"', '"hydrostatic"'), ("= 8.0", "= 8.0\nfree_surface_m = [[9, 1], [5, 1]]")],
         "case.toml:19: water.free_surface_m", "x does not increase"),
    case("a free surface of one point", DAM, [("= 8.0", "= 8.0\nfree_surface_m = [[9, 1]]")],
         "at least 2 points"),
    boundary("a boundary without a line", 'kind = "seepage_face"',
             "missing key seepage.boundary[1].line_m"),
    boundary("a boundary without a kind", "line_m = [[30, -4], [44, -4]]",
             "missing key seepage.boundary[1].kind"),
    boundary("a boundary of another kind", 'kind = "drain"\nline_m = [[30, -4], [44, -4]]',
             'seepage.boundary[1].kind = "drain"', '"head" | "seepage_face"'),
    boundary("a head without a value", 'kind = "head"\nline_m = [[44, -4], [44, 0]]',
             "missing key seepage.boundary[1].value", "the head in m"),
    boundary("a drain with a value", 'kind = "seepage_face"\nline_m = [[30, -4], [44, -4]]\nvalue=1',
             "seepage.boundary[1].value = 1", "takes no value"),
    boundary("an inflow of a river", 'kind = "inflow"\nline_m = [[30, -4], [44, -4]]\nvalue = 2',
             "seepage.boundary[1].value = 2", "-1 <= value <= 1"),
    boundary("rain from below", 'kind = "rain"\nline_m = [[20, 10], [24, 10]]\nvalue = -1e-6',
             "seepage.boundary[1].value", "0 <= value <= 1"),
    boundary("rain in the soil", 'kind = "rain"\nline_m = [[10, 0], [12, 0]]\nvalue = 1e-6',
             "seepage.boundary[1].kind", "does not rain inside the soil"),
    boundary("a boundary outside", 'kind = "impervious"\nline_m = [[100, 0], [110, 0]]',
             "seepage.boundary[1].line_m"),
    boundary("a boundary half outside", 'kind = "impervious"\nline_m = [[22, 0], [22, 50]]',
             "seepage.boundary[1].line_m"),
    boundary("a boundary of one place", 'kind = "impervious"\nline_m = [[22, 0], [22, 0]]',
             "points 1 and 2 are the same"),
    boundary("a boundary by a curve", 'kind = "impervious"\ncurve = "wall"',
             "seepage.boundary[1].curve", "no such physical curve", "it has none"),
    boundary("two walls on each other", 'kind = "impervious"\nline_m = [[12, -2], [12, 2]]\n'
             '[[seepage.boundary]]\nkind = "impervious"\nline_m = [[12, -1], [12, 3]]',
             "seepage.boundary[2].line_m"),
    line("a line outside", "points_m = [[100, 0], [110, 0]]", "output.line[1].points_m",
         "point 1 lies outside"),
    line("a line that leaves", "points_m = [[0, 0], [44, 0], [44, -1]]\n"
         "[[output.line]]\npoints_m = [[2, 0.5], [42, 0.5], [20, 11]]", "output.line[2].points_m"),
    line("a line of one point", "points_m = [[22, 0]]", "output.line[1].points_m", "has 1 point"),
    line("a line of one place", "points_m = [[22, 0], [22, 0]]", "are the same"),
    line("a line without points", 'name = "a"', "missing key output.line[1].points_m"),
    line("two lines of one file", 'name = "a b"\npoints_m = [[20, 0], [22, 0]]\n[[output.line]]\n'
         'name = "a_b"\npoints_m = [[20, 1], [22, 1]]', "output.line[2].name", "a_b.csv"),
    line("a line of one sample", "points_m = [[20, 0], [22, 0]]\nsamples = 1",
         "output.line[1].samples = 1", "2 <= samples"),
    more("a probe outside", "[output]\nprobes_m = [[22, 0], [22, 50]]", "output.probes_m",
         "[22, 50]", "point 2 lies outside"),
    more("a spacing wider than the section", "[sph]\nspacing_m = 10", "sph.spacing_m = 10",
         "<= spacing_m <="),
    more("a spacing for 10 million particles", "[sph]\nspacing_m = 0.002",
         "sph.spacing_m = 0.002", "<= spacing_m <="),
    more("elements as wide as the section", "[seepage]\nelement_size_m = 20",
         "seepage.element_size_m = 20", "<= element_size_m <="),
    more("elements of a millimetre", "[seepage]\nelement_size_m = 0.001",
         "seepage.element_size_m = 0.001"),
    more("a region that holds no soil", "[stability]\nsearch_region_m = [[90, 0], [99, 0], [99, 9]]",
         "stability.search_region_m", "holds no part of the section"),
    more("a region that crosses itself",
         "[stability]\nsearch_region_m = [[0, -4], [44, 10], [44, -4], [0, 10]]", "crosses"),
    more("no soil left to weaken",
         "[stability]\nexclude_region_m = [[-1, -5], [50, -5], [50, 20], [-1, 20]]",
         "leaves no soil to weaken"),
    more("a skin deeper than the section", "[stability]\nmin_depth_m = 500",
         "stability.min_depth_m"),
    more("a skin thinner than two spacings", "[stability]\nmin_depth_m = 0.01",
         "stability.min_depth_m = 0.01", "two spacings"),
    more("frames longer than the run-out",
         "[runout]\nfactor = 2\nduration_s = 1\nframe_interval_s = 2", "frame_interval_s = 2",
         "duration_s = 1"),
    more("a run-out from nowhere", "[stability]\nenabled = false\n[runout]\nshake_g = 0.1",
         "missing key runout.factor"),
]
