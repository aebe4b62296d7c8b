"""The rows of docs/tradeoffs/curve.csv (quality_curve.py says what its columns are), in groups."""

import csv
import statistics

TECHNIQUES = ("points", "flat discs", "discs", "ellipses", "blended", "ewa", "ewa full")
PRESETS = ("draft", "balanced", "exact")
WORDS = ("scene", "view", "structure", "precision", "technique", "state")
OCTREE = ("octree", "the file's")


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return [{key: value if key in WORDS else number(value) for key, value in row.items()}
                for row in csv.DictReader(file)]


def number(text):
    """None where nothing was measured."""
    return float(text) if text else None


class Place:
    """One technique at one error in one scene, as means over the views."""

    def __init__(self, rows):
        self.pictures = [row for row in rows
                         if row["view"] != "orbit" and row["state"] == "complete"]
        self.orbit = next(row for row in rows if row["view"] == "orbit")
        self.motion = next((row for row in rows if row["state"] == "motion"), None)
        self.error_px = rows[0]["error_px"]

    def mean(self, column):
        values = [row[column] for row in self.pictures if row[column] is not None]
        return statistics.fmean(values) if values else None

    def most(self, column):
        return max(row[column] for row in self.pictures)


def places(rows, scene, technique, store=OCTREE):
    """The places of a technique in the order of their errors, finest first."""
    errors = {}
    for row in rows:
        if (row["scene"], row["technique"]) == (scene, technique) \
                and (row["structure"], row["precision"]) == store:
            errors.setdefault(row["error_px"], []).append(row)
    return [Place(errors[error_px]) for error_px in sorted(errors)]


def scenes_of(rows):
    return list(dict.fromkeys(row["scene"] for row in rows))
