"""Draws random cases of a kind of pair (random_pairs.py), and makes a case that differs smaller."""

import json
import time

from random_cases import seeds, shrunk
from tool import ToolTest


class PairTest(ToolTest):
    def check_found(self, found):
        """`found`: kinds, each with a case that once differed."""
        for number, (kind, case) in enumerate(found):
            folder = self.folder / str(number)
            folder.mkdir()
            with self.subTest(kind=kind.__name__, case=json.dumps(case)):
                pair = kind(folder)
                self.addCleanup(pair.close)
                self.assertIsNone(pair.difference(case))

    def check(self, kind, usual=40):
        """`usual`: how many cases, where the environment does not say it."""
        pair, begin, drawn = kind(self.folder), time.monotonic(), 0
        self.addCleanup(pair.close)
        for seed in seeds(usual):
            case = pair.case(seed)
            drawn += 1
            with self.subTest(kind=kind.__name__, seed=seed):
                difference = pair.difference(case)
                if difference is None:
                    continue

                def fails(style, case=case):
                    return pair.difference({**case, "style": style}) is not None

                case["style"] = shrunk(case["style"], fails)
                found = (f"{kind.__name__}, seed {seed}: {difference}; smallest: "
                         f"{pair.difference(case)}: {json.dumps(case)}")
                print(found, flush=True)  # a night is long
                self.fail(found)
        seconds = time.monotonic() - begin
        print(f"{kind.__name__}: {drawn} cases in {seconds:.0f} s, {pair.refused} of them refused",
              flush=True)
