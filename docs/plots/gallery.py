#!/usr/bin/python3
"""Run the shipped cases and write docs/gallery.md with a picture and the answer of each.

    /usr/bin/python3 docs/plots/gallery.py BERM [CASE ...]

BERM is the program; without cases, all of GALLERY. Pictures go to docs/figures/gallery/. Needs
python3-pil, which Debian's matplotlib brings.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
PICTURES = ROOT / "docs" / "figures" / "gallery"
COLOURS = 96  # of a picture
WIDTH = 1000  # [pixels]

# Case and its picture: the figure of the run that says most.
GALLERY = {
    "two_sided_embankment/dry": "slip",
    "two_sided_embankment/hydrostatic": "slip",
    "two_sided_embankment/seepage": "slip",
    "two_sided_embankment/both_sides": "slip",
    "two_sided_embankment/unsaturated": "seepage",
    "two_sided_embankment/run_out": "run_out",
    "griffiths_lane_1999/slow_drawdown": "slip",
    "acads_1989/1a": "slip",
    "taylor_1937/undrained_cut": "slip",
    "cohesionless_slope/dry": "slip",
    "submerged_slope/full": "slip",
    "zoned_dam/core": "seepage",
    "gmsh_dam/steady": "slip",
    "trapezoidal_dam/drain": "seepage",
    "levee/cut_off": "seepage",
    "sheet_pile/seepage": "seepage",
}


def answer(result):
    """What the run found, in a line."""
    parts = []
    if "seepage" in result:
        parts.append(f"q = {result['seepage']['discharge_m2_s']:.4g} m²/s")
    for search in result.get("stability", {}).get("searches", [result.get("stability")]):
        if not search or not search["trials"]:
            continue
        where = f" ({search['region']})" if "searches" in result["stability"] else ""
        if not search["complete"]:
            parts.append(f"F undecided{where}")
            continue
        spread = search["uncertainty"]
        parts.append(f"F = {search['factor']:.3f}{where}, between {spread['low']:.3f} and "
                     f"{spread['high']:.3f}")
    if "runout" in result and result["runout"]["at_rest"]:
        parts.append(f"comes to rest {result['runout']['run_out_m']:.1f} m beyond the toe")
    return "; ".join(parts)


def run(berm, case, figure):
    """The result of a case; its picture is kept."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([berm, "run", ROOT / "cases" / f"{case}.toml", "--out", folder, "--quiet",
                        "--set", "output.report=false"], check=True)
        picture = Image.open(pathlib.Path(folder) / f"{figure}.png").convert("RGB")
        height = round(picture.height * WIDTH / picture.width)
        picture = picture.resize((WIDTH, height), Image.LANCZOS).quantize(COLOURS)
        picture.save(PICTURES / f"{case.replace('/', '_')}.png", optimize=True)
        return json.loads((pathlib.Path(folder) / "result.json").read_text(encoding="utf-8"))


def main(berm, cases):
    PICTURES.mkdir(parents=True, exist_ok=True)
    answers_file = PICTURES / "answers.json"
    known = json.loads(answers_file.read_text("utf-8")) if answers_file.exists() else {}
    for case in cases or GALLERY:
        result = run(berm, case, GALLERY[case])
        known[case] = {"title": result["title"], "answer": answer(result)}
        print(f"{case}: {known[case]['answer']}", flush=True)
    answers_file.write_text(json.dumps(known, indent=1, ensure_ascii=False) + "\n", "utf-8")
    lines = ["# Gallery", "",
             "The shipped cases as the program draws and answers them; written by "
             "`docs/plots/gallery.py`. Sources and published values: "
             "[cases/README.md](../cases/README.md).", ""]
    for case in GALLERY:
        if case in known:
            lines += [f"## {known[case]['title']}", "",
                      f"`berm run cases/{case}.toml`: {known[case]['answer']}", "",
                      f"![{known[case]['title']}](figures/gallery/{case.replace('/', '_')}.png)", ""]
    (ROOT / "docs" / "gallery.md").write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:])
