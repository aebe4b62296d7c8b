"""Pairs of pictures leave parts out of a random sheet of styles, so that they can agree."""

import json


def styles_of(sheet):
    """Every style in a sheet, as a list of dictionaries to change."""
    styles = [sheet.setdefault("default", {}), *sheet.get("classes", {}).values()]
    for lens in sheet.get("lenses", ()):
        styles += lens.get("inside", {}).values()
    return styles


def with_fixed_sizes(sheet, metres):
    """Without sizes by spacing, which say how a cloud is stored."""
    sheet = json.loads(json.dumps(sheet))
    for style in styles_of(sheet):
        if style.get("size", {}).get("mode") == "spacing":
            style["size"] = {"mode": "fixed", "metres": metres * style["size"].get("factor", 1)}
    sheet["default"].setdefault("size", {"mode": "fixed", "metres": metres})
    return sheet


def with_known_ranges(sheet, bounds):
    """Colours with ranges of their own: usual ones are of a sample, which another tree chooses
    otherwise."""
    ranges = {"elevation": [bounds[2], bounds[5]], "intensity": [10, 200], "normal.z": [-1, 1]}

    def known(colour):
        if isinstance(colour, str) and colour in ranges:
            return {"attribute": colour, "range": ranges[colour]}
        if isinstance(colour, dict) and colour.get("attribute") in ranges:
            return {**colour, "range": ranges[colour["attribute"]]}
        if isinstance(colour, dict) and "mix" in colour:
            return {**colour, "mix": [known(one) for one in colour["mix"]]}
        return colour

    sheet = json.loads(json.dumps(sheet))
    for style in styles_of(sheet):
        if "color" in style:
            style["color"] = known(style["color"])
    return sheet


def without_sums(sheet):
    """Without splats that are averaged: each cloud averages its own only."""
    sheet = json.loads(json.dumps(sheet))
    for style in styles_of(sheet):
        style.pop("blended", None)
        if style.get("technique") == "ewa":
            style["technique"] = "splats"
    return sheet
