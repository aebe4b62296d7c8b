"""All random tests share this: which seeds they take, and the smallest case that still fails.

Environment: POINTFRONT_RANDOM_FIRST the first seed (1), POINTFRONT_RANDOM_COUNT how many (40).
"""

import copy
import os

FIRST, COUNT = (int(os.environ.get(f"POINTFRONT_RANDOM_{name}", usual))
                for name, usual in (("FIRST", "1"), ("COUNT", "40")))


def seeds(usual=COUNT):
    """`usual`: how many, where the environment does not say it."""
    count = COUNT if "POINTFRONT_RANDOM_COUNT" in os.environ else usual
    return range(FIRST, FIRST + count)


def chance(rng, share):
    return rng.random() < share


def without_one(case):
    """Every case that lacks one entry of this one, larger entries first. Lists of numbers or
    strings stay whole: they are vectors, colours, names."""
    if isinstance(case, dict):
        for key in case:
            yield {other: copy.deepcopy(kept) for other, kept in case.items() if other != key}
        for key, value in case.items():
            for smaller in without_one(value):
                yield {**copy.deepcopy(case), key: smaller}
    elif isinstance(case, list) and case and isinstance(case[0], (dict, list)):
        for place in range(len(case)):
            yield copy.deepcopy(case[:place] + case[place + 1:])
        for place, value in enumerate(case):
            for smaller in without_one(value):
                yield [*copy.deepcopy(case[:place]), smaller, *copy.deepcopy(case[place + 1:])]


def shrunk(case, fails):
    """The smallest case that still fails: no entry can be left out. A case that is refused does
    not fail."""
    while True:
        smaller = next((one for one in without_one(case) if fails(one)), None)
        if smaller is None:
            return case
        case = smaller
