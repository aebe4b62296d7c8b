"""Runs the programs that benchmarks measure."""

import subprocess
import sys


def call(*words):
    """Returns what a command prints; where it fails, the benchmark ends with what it said."""
    finished = subprocess.run([str(word) for word in words], capture_output=True, text=True,
                              check=False)
    if finished.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}: status {finished.returncode}\n{finished.stderr}")
    return finished.stdout
