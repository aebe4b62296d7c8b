"""Random queries, as arguments of the tool and of Python's Cloud.points, and as filters in NumPy.

A query is a dictionary that JSON can print. Ends of boxes and vertices are often coordinates of
points, so that points lie exactly on boundaries.
"""

import json
from fractions import Fraction

import numpy

from random_cases import chance

# A condition may ask about these: a name, and how the user may write it.
NAMES = {"intensity": ("intensity", "Intensity"), "return_number": ("return_number",
         "return-number"), "classification": ("classification",), "user_data": ("USER_DATA",),
         "scan_angle": ("scan_angle",), "point_source_id": ("point_source_id",),
         "gps_time": ("gps_time", "gps-time"), "rgb[0]": ("rgb[0]",), "rgb[2]": ("rgb[2]",),
         "quality": ("quality", '"quality"'), "level": ("level",), "serial": ("serial",),
         "x": ("x",), "z": ("z", "elevation")}


def values_of(positions, columns, name):
    """World values as doubles."""
    if name in "xyz":
        return positions[:, "xyz".index(name)]
    if name.endswith("]"):
        return columns[name[:-3]][:, int(name[-2])].astype(float)
    return columns[name].astype(float)


def random_ends(rng, values):
    """A low and a high number: values of points, or between some."""
    finite = values[numpy.isfinite(values)]
    ends = sorted(float(finite[rng.randrange(len(finite))]) for _ in range(2))
    if chance(rng, 0.3):
        ends[1] = ends[1] + (ends[1] - ends[0]) / 3
    return ends


def is_float(name, columns):
    return name in columns and columns[name].dtype == numpy.float32


def as_export(number, name, columns):
    """The text that an export writes for such a value."""
    return str(numpy.float32(number)) if is_float(name, columns) else f"{number:.12g}"


def meant(text, name, values, columns):
    """The value that an export writes so, or else the number itself."""
    number = float(text)
    if is_float(name, columns):
        nearest = numpy.float32(number)
        return float(nearest) if float(str(nearest)) == number else number
    if name in (*"xyz", "level") and numpy.isfinite(number):
        nearest = float(values[numpy.argmin(abs(values - number))])
        return nearest if abs(nearest - number) <= 1e-15 * abs(values).max() else number
    return number


def random_condition(rng, positions, columns):
    """name as written, kind, numbers"""
    name = rng.choice(sorted(NAMES))
    low, high = random_ends(rng, values_of(positions, columns, name))
    kind = rng.choice(("[]", "()", "[)", "(]", "set", "not set", "not []", "==", "!=", "<", "<=",
                       ">", ">="))
    if kind in ("set", "not set"):
        values = values_of(positions, columns, name)
        numbers = [float(values[rng.randrange(len(values))]) for _ in range(rng.randint(1, 20))]
        numbers = [number for number in numbers if number == number] or [0.0]
    elif "(" in kind or "[" in kind:
        numbers = [-numpy.inf if chance(rng, 0.1) else low,
                   numpy.inf if chance(rng, 0.1) else high]
        if not numbers[0] < numbers[1]:
            kind, numbers = "==", [low]  # an empty range is refused
    else:
        numbers = [rng.choice((low, high))]
    short = chance(rng, 0.5)
    return [name, rng.choice(NAMES[name]), kind,
            [as_export(number, name, columns) if short else repr(number) for number in numbers]]


def condition_text(condition):
    _, written, kind, numbers = condition
    if "set" in kind:
        return f"{written} {'not ' if 'not' in kind else ''}in {{{', '.join(numbers)}}}"
    if len(numbers) == 2:
        ends = kind[-2:]
        return (f"{written} {'not ' if 'not' in kind else ''}in "
                f"{ends[0]}{numbers[0]}, {numbers[1]}{ends[1]}")
    return f"{written} {kind} {numbers[0]}"


def condition_mask(condition, positions, columns):
    name, _, kind, texts = condition
    values = values_of(positions, columns, name)
    numbers = [meant(text, name, values, columns) for text in texts]
    if "set" in kind:
        inside = numpy.isin(values, numbers)
    elif len(numbers) == 2:
        low, high = numbers
        inside = values > low if kind[-2] == "(" else values >= low
        inside &= values < high if kind[-1] == ")" else values <= high
    else:
        with numpy.errstate(invalid="ignore"):
            inside = {"==": values == numbers[0], "!=": values != numbers[0],
                      "<": values < numbers[0], "<=": values <= numbers[0],
                      ">": values > numbers[0], ">=": values >= numbers[0]}[kind]
    if kind.startswith("not"):
        inside = ~inside
    return inside & ~numpy.isnan(values)


def random_vertex(rng, positions):
    if chance(rng, 0.5):
        return [float(c) for c in positions[rng.randrange(len(positions))][:2]]
    low, high = positions[:, :2].min(axis=0), positions[:, :2].max(axis=0)
    return [float(a + rng.uniform(-0.1, 1.1) * (b - a)) for a, b in zip(low, high)]


def random_ring(rng, positions):
    """Also rings that cross themselves, and upright and level edges."""
    ring = [random_vertex(rng, positions) for _ in range(rng.randint(3, 8))]
    if chance(rng, 0.3):
        (x0, y0), (x1, y1) = ring[:2]
        ring = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
    return ring


def random_query(rng, positions, columns):
    query = {}
    if chance(rng, 0.35):
        ends = [random_ends(rng, positions[:, axis]) for axis in range(3)]
        if chance(rng, 0.5):
            ends[2] = [-1e9, 1e9]
        query["box"] = [end[0] for end in ends] + [end[1] for end in ends]
    if chance(rng, 0.25):
        query["polygons"] = [[random_ring(rng, positions) for _ in range(rng.choice((1, 1, 2)))]
                             for _ in range(rng.choice((1, 1, 3)))]
    if chance(rng, 0.2):
        centre, other = (positions[rng.randrange(len(positions))] for _ in range(2))
        query["sphere"] = [*map(float, centre), float(numpy.linalg.norm(other - centre))]
    if "polygons" not in query and chance(rng, 0.2):
        query["line"] = [random_vertex(rng, positions) for _ in range(rng.randint(1, 5))]
        if len(query["line"]) == 1:
            query["line"] *= 2  # a segment without length
        size = float(numpy.ptp(positions[:, :2], axis=0).max())
        query["within"] = size * rng.choice((1e-6, 0.02, 0.2))
    if chance(rng, 0.25):
        codes = sorted(set(columns["classification"].tolist()))
        query["classes"] = sorted({rng.choice(codes), rng.choice(codes), rng.randrange(256)})
    if chance(rng, 0.5):
        query["where"] = [random_condition(rng, positions, columns)
                          for _ in range(rng.choice((1, 1, 2, 3)))]
    if chance(rng, 0.2):
        size = float(numpy.ptp(positions, axis=0).max())
        query["spacing"] = size * rng.choice((0.001, 0.01, 0.03, 0.1, 0.5))
    if chance(rng, 0.3):
        query["attributes"] = sorted(rng.sample(sorted(columns), rng.randint(1, 3)))
    return query


def random_for_python(rng, positions, columns):
    """With what only Python asks for: inside of planes, and points by their ids."""
    if chance(rng, 0.1):
        return {"ids": [rng.randrange(len(positions)), rng.randint(1, 100)]}  # first, step
    query = random_query(rng, positions, columns)
    if chance(rng, 0.25):
        # Outwards and a point of the plane; some go through a point of the cloud, upright or level.
        query["planes"] = []
        for _ in range(rng.randint(1, 6)):
            normal = [rng.choice((-1.0, 0.0, 1.0)) if chance(rng, 0.3) else rng.uniform(-1, 1)
                      for _ in range(3)]
            if any(normal):
                place = positions[rng.randrange(len(positions))]
                query["planes"].append([normal, [float(c) for c in place]])
    return query


def ring_text(ring):
    return "(" + ", ".join(f"{x!r} {y!r}" for x, y in [*ring, ring[0]]) + ")"


def well_known_text(query):
    if "line" in query:
        return "LINESTRING (" + ", ".join(f"{x!r} {y!r}" for x, y in query["line"]) + ")"
    return "MULTIPOLYGON (" + ", ".join(
        "(" + ", ".join(map(ring_text, rings)) + ")" for rings in query["polygons"]) + ")"


def geojson(query):
    if "line" in query:
        return json.dumps({"type": "LineString", "coordinates": query["line"]})
    return json.dumps({"type": "MultiPolygon", "coordinates": [
        [[*ring, ring[0]] for ring in rings] for rings in query["polygons"]]})


def where_text(query):
    return " and ".join(map(condition_text, query["where"]))


def tool_arguments(query, folder):
    words = []
    if "box" in query:
        words += ["--box", ",".join(map(repr, query["box"]))]
    if "polygons" in query or "line" in query:
        text, name = ((well_known_text(query), "area.wkt") if len(repr(query)) % 2 else
                      (geojson(query), "area.geojson"))
        (folder / name).write_text(text)
        words += ["--corridor" if "line" in query else "--polygon", folder / name]
    if "line" in query:
        words += ["--within", repr(query.get("within", 1.0))]
    if "sphere" in query:
        words += ["--sphere", ",".join(map(repr, query["sphere"]))]
    if "classes" in query:
        words += ["--classes", ",".join(map(str, query["classes"]))]
    if query.get("where"):
        words += ["--where", where_text(query)]
    if "spacing" in query:
        words += ["--spacing", repr(query["spacing"])]
    return words


def python_arguments(query):
    words = {}
    if "box" in query:
        words["box"] = query["box"]
    if "polygons" in query or "line" in query:
        words["area"] = well_known_text(query)
    if "line" in query:
        words["line_distance"] = query.get("within", 1.0)
    if "sphere" in query:
        words["sphere"] = query["sphere"][:3], query["sphere"][3]
    if query.get("where"):
        words["where"] = where_text(query)
    for name in ("classes", "spacing", "attributes"):
        if name in query:
            words[name] = query[name]
    return words


def side(ax, ay, bx, by, points):
    """Sign of the determinant for each point, exactly."""
    px, py = points[:, 0], points[:, 1]
    left, right = (bx - ax) * (py - ay), (by - ay) * (px - ax)
    sign = numpy.sign(left - right)
    unsure = numpy.abs(left - right) <= 1e-12 * (numpy.abs(left) + numpy.abs(right))
    # Differences of nearly equal coordinates have lost digits, too.
    size = max(abs(ax), abs(bx), abs(ay), abs(by))
    unsure |= numpy.abs(left - right) <= 1e-14 * size * (abs(bx - ax) + abs(by - ay) + size)
    a, b = (Fraction(ax), Fraction(ay)), (Fraction(bx), Fraction(by))
    for i in numpy.nonzero(unsure)[0]:
        p = Fraction(float(px[i])), Fraction(float(py[i]))
        exact = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
        sign[i] = (exact > 0) - (exact < 0)
    return sign


def polygon_mask(rings, points):
    """Even-odd over all rings; an edge is in."""
    odd, on = numpy.zeros(len(points), bool), numpy.zeros(len(points), bool)
    px, py = points[:, 0], points[:, 1]
    for ring in rings:
        for (ax, ay), (bx, by) in zip(ring, [*ring[1:], ring[0]]):
            near = (py >= min(ay, by)) & (py <= max(ay, by))
            sign = numpy.zeros(len(points))
            sign[near] = side(ax, ay, bx, by, points[near])
            on |= near & (sign == 0) & (px >= min(ax, bx)) & (px <= max(ax, bx))
            upwards = by > ay
            odd ^= near & ((ay > py) != (by > py)) & ((sign > 0) if upwards else (sign < 0))
    return odd | on


def line_distance(line, points):
    distances = numpy.full(len(points), numpy.inf)
    for a, b in zip(map(numpy.array, line), map(numpy.array, line[1:])):
        along, offset = b - a, points - a
        length = float(along @ along)
        place = numpy.clip(offset @ along / length, 0, 1) if length else numpy.zeros(len(points))
        away = offset - place[:, None] * along
        distances = numpy.minimum(distances, numpy.sqrt((away ** 2).sum(axis=1)))
    return distances


def masks_of(query, positions, columns):
    """(points that must come, points that may): they differ by those within rounding of a curved
    boundary. Spacing is left out."""
    mask = numpy.ones(len(positions), bool)
    if "ids" in query:
        mask[:] = False
        mask[query["ids"][0]::query["ids"][1]] = True
    if "box" in query:
        low, high = numpy.array(query["box"][:3]), numpy.array(query["box"][3:])
        mask &= ((positions >= low) & (positions <= high)).all(axis=1)
    if "polygons" in query:
        inside = numpy.zeros(len(positions), bool)
        for rings in query["polygons"]:
            inside |= polygon_mask(rings, positions[:, :2])
        mask &= inside
    if query.get("classes"):
        mask &= numpy.isin(columns["classification"], query["classes"])
    for condition in query.get("where", ()):
        mask &= condition_mask(condition, positions, columns)
    surely, perhaps = mask, mask.copy()
    rounding = 1e-12 * float(numpy.abs(positions).max(initial=1.0))
    for distance, limit in curved(query, positions):
        surely = surely & (distance <= limit - rounding)
        perhaps = perhaps & (distance <= limit + rounding)
    return surely, perhaps


def curved(query, positions):
    if "sphere" in query:
        away = positions - numpy.array(query["sphere"][:3])
        yield numpy.sqrt((away ** 2).sum(axis=1)), query["sphere"][3]
    if "line" in query:
        yield line_distance(query["line"], positions[:, :2]), query.get("within", 1.0)
    for normal, place in query.get("planes", ()):
        yield (positions - numpy.array(place)) @ (normal / numpy.linalg.norm(normal)), 0.0
