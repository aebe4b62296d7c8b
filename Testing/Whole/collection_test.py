"""A collection of made-up tiles, for tests."""

import random

from tool import ToolTest

SIDE = 4  # tiles beside each other


class CollectionTest(ToolTest):
    """A folder of tiles, and commands on the collection `city` of them."""

    def setUp(self):
        super().setUp()
        self.city = self.folder / "city.pfcollection"
        (self.folder / "tiles").mkdir()

    def tile(self, number, points=3000, folder="tiles", lift=0.0):
        """A store of 100 m by 100 m at its place in a square of tiles."""
        rows = []
        draw = random.Random(number)
        x, y = 100.0 * (number % SIDE), 100.0 * (number // SIDE)
        for _ in range(points):
            rows.append(f"{x + 100 * draw.random():.3f} {y + 100 * draw.random():.3f} "
                        f"{lift + draw.random():.3f}")
        text = self.folder / f"{number}.xyz"
        text.write_text("\n".join(rows))
        store = self.folder / folder / f"tile_{number}.pfront"
        store.parent.mkdir(exist_ok=True)
        self.succeed("build", text, "-o", store, "--force", "--progress", "none")
        text.unlink()
        return store

    def collection(self, *arguments, **options):
        done = self.succeed("collection", *arguments, "--json", **options)
        return done.json

    def names(self):
        return sorted(tile["name"] for tile in self.collection("list", self.city)["tiles"])
