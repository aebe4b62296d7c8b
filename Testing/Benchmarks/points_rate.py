#!/usr/bin/python3
"""Points a second and core from a store to NumPy arrays, and the memory that this takes.

    points_rate.py STORE [--attributes intensity,rgb,classification] [--rounds N]

Run it by a Python that has the package. Processor time of all threads counts, so the rate is that
of one core; the file is in the system's cache after the first round. Prints the best round, and how
much the process grew in the first one beside what the arrays take: a second copy would show.
"""

import argparse
import resource
import time

import pointfront


def peak_bytes():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("store")
    parser.add_argument("--attributes", default="intensity,rgb,classification")
    parser.add_argument("--rounds", type=int, default=5)
    chosen = parser.parse_args()
    names = chosen.attributes.split(",")
    grown, seconds, waited = None, [], []
    with pointfront.open(chosen.store) as cloud:
        for _ in range(chosen.rounds):
            before, begin, used = peak_bytes(), time.perf_counter(), time.process_time()
            points = cloud.points(attributes=names)
            seconds.append(time.process_time() - used)
            waited.append(time.perf_counter() - begin)
            if grown is None:
                grown = peak_bytes() - before
                arrays = sum(array.nbytes for array in points.values())
            count = len(points["id"])
            del points
    best = min(seconds)
    print(f"{count} points with {', '.join(names)}: {count / best / 1e6:.1f} M points/s a core "
          f"({best:.2f} s of processors, {min(waited):.2f} s waited)")
    print(f"arrays {arrays / 1e6:.0f} MB; the process grew by {grown / 1e6:.0f} MB")


if __name__ == "__main__":
    main()
