"""Clouds in which points share places: drawn as clouds that have one point in each place."""

import numpy

from random_forms import write_ept
from random_pairs import Forms, Refused


class Copies(Forms):
    """Each place once, and with copies: 2, 3 or 20 of each point, or 1,000 of one."""

    fixed_sizes = 0.3

    def make(self, number, rng):
        once = self.town(number, 5000)
        _, first = numpy.unique(once.records["grid"], axis=0, return_index=True)
        once = once.part(numpy.sort(first))
        count = len(once.records)
        copies = rng.choice((2, 3, 20, None))
        chosen = (numpy.repeat(numpy.arange(count), copies) if copies else
                  numpy.append(numpy.arange(count), numpy.full(1000, rng.randrange(count))))
        numpy.random.default_rng(number).shuffle(chosen)
        points = once.part(chosen)
        single = once.write(self.folder / "once.las")
        file = points.write(self.folder / "copies.las")
        words = ["--node-points", rng.choice((256, 400, 3000))]
        index = self.folder / "copies.pfindex"
        self.succeed("index", file, "-o", index, *words)
        self.stores = {
            "each place once": self.build("once.pfront", single, *words),
            "octree": self.build("o.pfront", file, *words),
            "kd-tree": self.build("k.pfront", file, "--structure", "kdtree", *words),
            "means": self.build("m.pfront", file, "--refinement", "replace", *words),
            "index": index, "EPT": write_ept(self.folder / "ept", points, len(chosen) // 20)}
        return self.stores["each place once"]

    def choose(self, rng):
        return {**super().choose(rng), "coarser": rng.choice(("1", "3", "10")),
                "of": rng.choice(list(self.stores))}

    def pictures(self, case):
        for name, store in self.stores.items():
            yield name, lambda store=store: self.drawn(store, case)
        # Not alike, but drawn() tells where a reported error is larger than the one asked for.
        try:
            self.drawn(self.stores[case["of"]], {**case, "error": case["coarser"]})
        except Refused:
            pass  # too few points: none is in the picture
