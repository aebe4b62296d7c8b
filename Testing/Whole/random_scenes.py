"""Random scenes: a style and a view drawn from a seed.

A scene is what `pointfront render` takes: a style (docs/user/styles.md) and a camera file. The same
seed gives the same scene everywhere.
"""

import random

from random_cases import chance

CLASSES = (2, 5, 6, 9)
COLOURS = ("auto", "rgb", "intensity", "elevation", "classification", "#d08030", "normal.z")
MAPS = ("viridis", "grey", ["#000080", "#ffff00"])
TECHNIQUES = ("points", "splats", "spheres", "silhouettes", "ewa")
TECHNIQUES_WEIGHTS = (4, 4, 3, 2, 2)


def random_colour(rng):
    if chance(rng, 0.25):
        colour = {"attribute": rng.choice(("intensity", "elevation")), "map": rng.choice(MAPS)}
        if chance(rng, 0.3):
            colour["logarithmic"] = False
        return colour
    if chance(rng, 0.1):
        return {"mix": ["#ff0000", rng.choice(COLOURS[1:5])], "share": round(rng.random(), 2)}
    return rng.choice(COLOURS)


def random_size(rng):
    if chance(rng, 0.5):
        return {"mode": "fixed", "px": rng.choice((1, 2, 3.5, 6, 11))}
    return {"mode": "spacing", "factor": rng.choice((0.6, 1.0, 1.5))}


def random_style(rng, whole):
    """`whole`: of a default, which is seldom hidden."""
    style = {}
    if chance(rng, 0.8 if whole else 0.5):
        style["technique"] = rng.choices(TECHNIQUES, TECHNIQUES_WEIGHTS)[0]
    if chance(rng, 0.6):
        style["color"] = random_colour(rng)
    if chance(rng, 0.3):
        style["size"] = random_size(rng)
    if chance(rng, 0.15 if whole else 0.4):
        style["opacity"] = rng.choice((0.2, 0.4, 0.5, 0.8))
    if chance(rng, 0.2):
        style["blended"] = True
    if chance(rng, 0.2):
        style["orientation"] = rng.choice(("view", "normal", [0.2, 0.3, 0.9]))
    if chance(rng, 0.15):
        style["accuracy"] = rng.choice(("exact", "full"))
    if chance(rng, 0.15):
        style["error_factor"] = rng.choice((0.5, 2.0))
    if chance(rng, 0.15):
        style["where"] = rng.choice(("return_number == 1", "intensity < 200", "intensity >= 50"))
    if not whole and chance(rng, 0.1):
        style["visible"] = False
    return style


def random_classes(rng, share):
    return {str(code): random_style(rng, False) for code in CLASSES if chance(rng, share)}


def random_lens(rng, size):
    width, height = size
    lens = {}
    kind = rng.choice(("circle", "rectangle", "mask", "around"))
    centre = [rng.randint(0, width), rng.randint(0, height)]
    if kind == "circle":
        lens.update(shape="circle", center_px=centre, radius_px=rng.choice((0, 30, 80, 150)))
    elif kind == "rectangle":
        lens.update(shape="rectangle", center_px=centre,
                    size_px=[rng.randint(0, width), rng.randint(1, height)])
    elif kind == "mask":
        rows = ["".join(rng.choice(".##") for _ in range(7)) for _ in range(5)]
        lens.update(shape="mask", mask=rows)
    else:
        lens.update(around_class=rng.choice(CLASSES), radius=rng.choice((1.0, 4.0)))
    inside = random_classes(rng, 0.4)
    if chance(rng, 0.5):
        inside["default"] = random_style(rng, True)
    lens["inside"] = inside or {"default": {"color": "#00ff00"}}
    return lens


def random_shading(rng):
    shading = {}
    modes = [mode for mode in ("lit", "edl") if chance(rng, 0.35)]
    if modes:
        shading["mode"] = modes if len(modes) > 1 else modes[0]
    if "edl" in modes and chance(rng, 0.5):
        shading.update(strength=rng.choice((0.2, 1.0)), radius_px=rng.choice((1, 2, 4)))
    if "lit" in modes and chance(rng, 0.3):
        shading.update(ambient=0.1, diffuse=0.9)
    if chance(rng, 0.15):
        shading["fill_holes"] = True
    return shading


def random_sheet(rng, size):
    sheet = {"default": random_style(rng, True)}
    classes = random_classes(rng, 0.4)
    if classes:
        sheet["classes"] = classes
    if chance(rng, 0.35):
        sheet["lenses"] = [random_lens(rng, size) for _ in range(rng.choice((1, 1, 2, 3)))]
    if chance(rng, 0.3):
        sheet["highlight"] = [
            {"class": code, "color": rng.choice(("#ffff00", "#00ffff")),
             "halo_px": rng.choice((0, 2, 5)), "tint": rng.choice((0.0, 0.3, 1.0))}
            for code in rng.sample(CLASSES, rng.choice((1, 2)))]
    shading = random_shading(rng)
    if shading:
        sheet["shading"] = shading
    if chance(rng, 0.1):
        sheet["show_classes"] = rng.sample(CLASSES, 3)
    if chance(rng, 0.1):
        sheet["where"] = rng.choice(("intensity > 20", "return_number == 1"))
    return sheet


def random_light(rng):
    return rng.choice((True, False, {"ambient": rng.choice((0.0, 0.1, 0.6))},
                       {"ambient": 0.2, "diffuse": rng.choice((0.3, 0.9))}))


def random_eye_dome(rng):
    return rng.choice((True, False, {"radius_px": rng.choice((2, 4))},
                       {"strength": rng.choice((0.1, 0.2, 1.0)), "radius_px": rng.choice((1, 3))}))


def add_looks(rng, sheet):
    """Light and eye-dome lighting of their own for some styles of a sheet and its lenses."""
    insides = [lens["inside"] for lens in sheet.get("lenses", ())]
    of_lenses = [style for inside in insides for style in inside.values()]
    for style in (sheet["default"], *sheet.get("classes", {}).values(), *of_lenses):
        if chance(rng, 0.35):
            style["light"] = random_light(rng)
        if chance(rng, 0.25):
            style["edl"] = random_eye_dome(rng)
    if chance(rng, 0.1):
        sheet.setdefault("shading", {}).setdefault("mode", "none")


VIEWS = ("oblique", "top", "near", "far", "grazing", "inside")


def random_camera(rng, bounds):
    """`bounds`: x, y, z of the low corner, then of the high one."""
    low, high = bounds[:3], bounds[3:]
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    span = max(high[0] - low[0], high[1] - low[1])
    view = rng.choice(VIEWS)
    at = [middle[axis] + rng.uniform(-0.3, 0.3) * (high[axis] - low[axis]) for axis in range(3)]
    turn = [rng.uniform(-1, 1), rng.uniform(-1, 1)]
    distance, rise = {"oblique": (0.7, 0.6), "top": (0.01, 1.2), "near": (0.12, 0.08),
                      "far": (6.0, 4.0), "grazing": (0.6, 0.03), "inside": (0.0, 0.0)}[view]
    if view == "inside":
        eye, at = at, [at[0] + turn[0] * span, at[1] + turn[1] * span, at[2]]
    else:
        eye = [at[0] + turn[0] * distance * span, at[1] + turn[1] * distance * span,
               at[2] + rise * span]
    camera = {"position": eye, "focal_point": at, "view_up": [0, 0, 1]}
    if view == "top":
        camera["view_up"] = [0, 1, 0]
    if view != "inside" and chance(rng, 0.3):
        camera["parallel_scale"] = span * {"near": 0.06, "far": 3.0}.get(view, 0.4)
    else:
        camera["view_angle"] = rng.choice((20, 45, 90))
    return view, camera


def random_scene(seed, bounds, size, looks=True):
    """(style, name of the view, camera) of a seed. `looks`: styles have light and eye-dome lighting
    of their own, in half of the seeds; all else of the scene is as without."""
    rng = random.Random(seed)
    sheet, view, camera = random_sheet(rng, size), *random_camera(rng, bounds)
    of_looks = random.Random(f"looks of {seed}")
    if looks and chance(of_looks, 0.5):
        add_looks(of_looks, sheet)
    return sheet, view, camera
