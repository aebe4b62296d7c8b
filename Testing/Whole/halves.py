"""A made-up town as two clouds beside each other, seen from above."""

from tool import SLOWNESS

WHITE = {"default": {"technique": "points", "color": "#ffffff"}}
SIZE = (640, 480)
# Under sanitizers as many as show what happens.
POINTS = 600000 if SLOWNESS == 1 else 100000


def halves_of_a_town(test, points=POINTS):
    """Two stores and a camera; `test` is a ToolTest."""
    test.succeed("generate", "--points", points, "--seed", 3, "-o", test.folder / "town.las")
    whole = test.build(test.folder / "town.las", name="town.pfront")
    low, high = (test.succeed("info", whole, "--json").json["bounds"][at:at + 3] for at in (0, 3))
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    stores = []
    for name, begin, end in (("left", low[0], middle[0]), ("right", middle[0], high[0])):
        half = test.folder / f"{name}.las"
        test.succeed("export", whole, "-o", half, "--box",
                     ",".join(map(str, (begin, *low[1:], end, *high[1:]))))
        stores.append(test.build(half, name=f"{name}.pfront"))
    camera = {"position": [middle[0], middle[1], high[2] + 1.2 * (high[1] - low[1])],
              "focal_point": middle, "view_up": [0, 1, 0], "view_angle": 45}
    return stores, camera


def moved(camera, frame):
    """A little to the right."""
    by = 0.2 * frame
    return {**camera, "position": [camera["position"][0] + by, *camera["position"][1:]],
            "focal_point": [camera["focal_point"][0] + by, *camera["focal_point"][1:]]}


def lit(pixels):
    """How many pixels each half of the picture shows of the clouds, which are white."""
    shown = pixels[..., :3].min(axis=2) == 255
    middle = shown.shape[1] // 2
    return int(shown[:, :middle].sum()), int(shown[:, middle:].sum())
