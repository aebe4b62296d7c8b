"""Ways to run ParaView on random input; the seeds: see Testing/Whole/random_cases.py. Each function
is a test: see drive.py."""

import json
import os
import random
import subprocess
import sys

import pictures
from programs import HERE, tool

sys.path.append(os.path.join(HERE, "..", "..", "Testing", "Whole"))

from random_cases import seeds, shrunk
from random_scenes import random_camera, random_sheet

SIZE = [320, 240]
LEAST_ALIKE, TOLERANCE, STRONG_TOLERANCE = 0.995, 2, 8  # as Testing/Whole/test_random_styles.py
USUAL_STRENGTH, EDGE = 0.4, 6
AT_ONCE = 200  # scenes of one process, and seeds that share a cloud


def town(number):
    """A store of a made-up town, which is the environment's from now on; its bounds."""
    store = os.environ["POINTFRONT_STORE"] = os.path.abspath("town%d.pfront" % number)
    tool("generate", "--points", "20000", "--seed", str(number + 2), "-o", "town.las", "--force")
    tool("build", "town.las", "-o", store, "--force", "--normals", "pca", "--node-points", "500")
    described = json.loads(tool("info", store, "--json"))
    os.environ["POINTFRONT_POINTS"] = str(described["points"])
    return described["bounds"]


def scene_of(seed, bounds):
    rng = random.Random(seed)
    sheet = random_sheet(rng, SIZE)
    # ParaView colours by another attribute than the tool where a style names none.
    sheet["default"].setdefault("color", "rgb")
    camera = random_camera(rng, bounds)[1]
    return {"style": sheet, "camera": camera, "error": rng.choice(("0.01", "1", "3"))}


def drawn_by_tool(name, case):
    """False where the tool refuses it."""
    paths = {key: os.path.abspath("%s-%s.json" % (name, key)) for key in ("style", "camera")}
    for key, path in paths.items():
        with open(path, "w") as file:
            json.dump(case[key], file)
    done = subprocess.run(
        [os.environ["POINTFRONT_TOOL"], "render", os.environ["POINTFRONT_STORE"], "-o",
         name + ".png", "--size", "%dx%d" % tuple(SIZE), "--style", paths["style"], "--camera",
         paths["camera"], "--error", case["error"], "--background", "0.2,0.1,0.3"],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode not in (0, 1, 2) or (done.returncode == 1 and "no point" not in done.stderr
                                            and "of these classes" not in done.stderr):
        raise AssertionError("%s: %s" % (json.dumps(case), done.stderr))
    return done.returncode == 0


def differences(programs, cases):
    """By name, of those cases that differ; cases that the tool refuses do not."""
    known = [(name, case) for name, case in cases.items() if drawn_by_tool(name, case)]
    with open("cases.json", "w") as file:
        json.dump({"size": SIZE, "cases": [
            {"name": name, "style": os.path.abspath(name + "-style.json"),
             "camera": case["camera"], "error": case["error"]} for name, case in known]}, file)
    if known:
        programs.run(os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "random_drawing.py"),
                     "cases.json")
    found = {}
    inner = slice(EDGE, -EDGE)
    for name, case in known:
        strong = case["style"].get("shading", {}).get("strength", 0) > USUAL_STRENGTH
        for backend in ("opengl", "software"):
            one, other = (pictures.load(path)[inner, inner]
                          for path in (name + ".png", "%s-%s.png" % (name, backend)))
            share = pictures.differing(one, other, STRONG_TOLERANCE if strong else TOLERANCE)
            if 1 - share < LEAST_ALIKE:
                found[name] = "tool and %s: %.5f of the pixels differ" % (backend, share)
    return found


def random_scenes(programs):
    """Pictures of the tool and of ParaView."""
    failed = False
    chosen = list(seeds())
    for first in range(0, len(chosen), AT_ONCE):
        bounds = town(1 + first // AT_ONCE)
        cases = {"seed%d" % seed: scene_of(seed, bounds) for seed in chosen[first:first + AT_ONCE]}
        for name, difference in differences(programs, cases).items():
            case, failed = cases[name], True
            smallest = shrunk(case["style"], lambda style, case=case: bool(
                differences(programs, {"smaller": {**case, "style": style}})))
            print("%s: %s; smallest: %s" % (
                name, difference, json.dumps({**case, "style": smallest})), flush=True)
    if failed:
        raise AssertionError("ParaView draws other pictures than the tool")


def random_selections(programs):
    town(1)
    os.environ["POINTFRONT_CAMERA"] = ""
    programs.run(os.environ["POINTFRONT_PVBATCH"], os.path.join(HERE, "random_selections.py"))
