"""Controls over the picture of a page: choices, a legend, the classes, a point, a measure."""

import math

from . import _kernel
from ._orbit import projected
from ._pictures import described

TECHNIQUES = ("splats", "points", "spheres", "ewa")
POINT_SIZES = ("1", "2", "3", "4", "6", "8", "12")
TOOLS = ("", "pick", "measure")
# Clients may change these entries of the page's state; all else they say is let go.
CHOSEN_BY_CLIENTS = ("colour", "technique", "point_size", "tool")
SAMPLE_STEPS = 100  # along a cloud's longest edge, between points that are asked for their class
TOGGLE = "pointfront_toggle_class"  # a trigger of trame's
CLEAR = "pointfront_clear_marks"

_BOX = "background:#17191fc0; border-radius:4px; padding:6px 8px;"

# A template of Vue's, drawn over the picture. What is not clicked lets the mouse through.
OVERLAY = f"""
<svg v-if="marks.length" class="pointfront-marks" :viewBox="'0 0 ' + aspect + ' 1'"
  preserveAspectRatio="xMidYMid meet"
  style="position:absolute; inset:0; width:100%; height:100%; pointer-events:none;">
  <line v-if="marks.length == 2" :x1="marks[0][0]" :y1="marks[0][1]" :x2="marks[1][0]"
    :y2="marks[1][1]" stroke="#ffd54a" stroke-width="0.003"></line>
  <circle v-for="(mark, i) in marks" :key="i" :cx="mark[0]" :cy="mark[1]" r="0.007"
    fill="none" stroke="#ffd54a" stroke-width="0.003"></circle>
</svg>
<div style="position:absolute; right:8px; top:40px; display:flex; flex-direction:column; gap:8px;
  max-width:45%; max-height:calc(100% - 80px); font:12px sans-serif; color:#ddd;
  pointer-events:none;">
  <div v-if="legend" class="pointfront-legend" style="{_BOX}">
    <div>{{{{ legend.attribute }}}}</div>
    <div v-if="legend.ramp" :style="{{height: '12px', width: '160px', background: legend.ramp}}">
    </div>
    <div v-if="legend.ramp" style="display:flex; justify-content:space-between;">
      <span>{{{{ legend.low }}}}</span><span>{{{{ legend.high }}}}</span>
    </div>
    <div v-for="entry in legend.values" :key="entry[0]">
      <span :style="{{display: 'inline-block', width: '10px', height: '10px',
        background: entry[1]}}"></span>
      {{{{ entry[0] }}}}
    </div>
  </div>
  <div v-if="classes.length" class="pointfront-classes"
    style="{_BOX} overflow:auto; pointer-events:auto;">
    <label v-for="c in classes" :key="c.code" style="display:block; white-space:nowrap;">
      <input type="checkbox" :checked="c.shown" :disabled="c.last" :name="'class ' + c.code"
        @change="trigger('{TOGGLE}', [c.code, $event.target.checked])">
      <span v-if="c.colour" :style="{{display: 'inline-block', width: '10px', height: '10px',
        background: c.colour}}"></span>
      {{{{ c.code }}}} {{{{ c.name }}}}
    </label>
  </div>
  <div v-if="rows.length" class="pointfront-point"
    style="{_BOX} overflow:auto; pointer-events:auto;">
    <table><tr v-for="row in rows" :key="row[0]">
      <td style="padding-right:8px; color:#aaa;">{{{{ row[0] }}}}</td><td>{{{{ row[1] }}}}</td>
    </tr></table>
    <button @click="trigger('{CLEAR}')">clear</button>
  </div>
</div>
<div v-if="!settled" class="pointfront-loading"
  style="position:absolute; left:0; right:0; bottom:0; height:3px; pointer-events:none;">
  <div :style="{{height: '3px', width: progress + '%', background: '#6fb6ff'}}"></div>
</div>
"""


def colours_of(path):
    """Returns the attributes that the first store can be coloured by."""
    names = []
    for attribute in described(path)["attributes"]:
        name, components = attribute["name"], attribute["components"]
        whole = components == 1 or name in ("rgb", "normal")  # others have no colours of their own
        names += [name] if whole else [f"{name}[{i}]" for i in range(components)]
    computed = ["elevation"] + (["horizontality"] if "normal" in names else [])
    return names + [name for name in computed if name not in names]


def may_choose(value, offered, start):
    """Whether a client's value is "", one that the page offers, or the one that it started with."""
    return isinstance(value, str) and (not value or value in offered or value == start)


def classes_of(paths):
    """Whether all of these have a tree for each class, and {code: name} of their classes: all that
    they have a tree for, or those of a sample of the points.
    """
    found, layered = {}, True
    for path in paths:
        store = _kernel.StoredCloud(path)
        own = dict(store.description["classes"])
        if not own:
            layered = False
            own = _sampled_classes(store)
        found.update(own)
    return layered, dict(sorted(found.items()))


def _sampled_classes(store):
    from ._queries import Conditions

    if "classification" not in store.description["attributes"]:
        return {}
    x0, y0, z0, x1, y1, z1 = store.bounds
    sample = Conditions.of_all(
        spacing=max(x1 - x0, y1 - y0, z1 - z0) / SAMPLE_STEPS, attributes=["classification"])
    names = _kernel.class_names()
    return {int(code): names[int(code)] for code in set(sample.arrays(store)["classification"])}


def _number(value):
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def legend_state(legend, classes):
    """Returns the page's legend from what `stream` says; None: no legend, as for rgb.

    classes  the page's Classes, whose switches show the colours of classes if there are any
    """
    if not legend:
        return None
    if legend["attribute"] == "classification":
        named = classes.named(legend)
        return {"attribute": "classification", "values": named} if named else None
    if "values" in legend:
        return {"attribute": legend["attribute"],
                "values": [[_number(value), colour] for value, colour in legend["values"]]}
    low, high = legend["range"]
    return {"attribute": legend["attribute"], "low": _number(low), "high": _number(high),
            "ramp": f"linear-gradient(to right, {', '.join(legend['colours'])})"}


def _colours_of_classes(legend):
    """{code: colour}; none where points are coloured by something else."""
    if not legend or legend["attribute"] != "classification":
        return {}
    return {int(value): colour for value, colour in legend.get("values", ())}


class Classes:
    """The switches of object classes.

    paths  of the stores that are drawn
    """

    def __init__(self, paths):
        self._layered, self._names = classes_of(paths)
        self._hidden = set()

    def toggle(self, code, shown):
        """False for what is no class of these, changes nothing, or would hide all."""
        hidden = self._hidden - {code} if shown else self._hidden | {code}
        if code not in self._names or hidden == self._hidden or hidden == set(self._names):
            return False
        self._hidden = hidden
        return True

    def _has_switches(self):
        return len(self._names) > 1

    def named(self, legend):
        """Returns ["code name", colour] of a class that is alone and has no switch."""
        colours = _colours_of_classes(legend)
        return [[f"{code} {name}", colours[code]] for code, name in self._names.items()
                if code in colours and not self._has_switches()]

    def state(self, legend):
        """Returns the switches that the page shows; none where there is one class."""
        if not self._has_switches():
            return []
        colours = _colours_of_classes(legend)
        shown = set(self._names) - self._hidden
        return [{"code": code, "name": name, "shown": code in shown, "last": shown == {code},
                 "colour": colours.get(code)} for code, name in self._names.items()]

    def options(self, options):
        """`options` of the command line, and those that leave hidden classes out."""
        if not self._hidden:
            return options
        if self._layered and "classes" not in options:
            shown = sorted(set(self._names) - self._hidden)
            return {**options, "classes": ",".join(map(str, shown))}
        left_out = " and ".join(f"classification != {code}" for code in sorted(self._hidden))
        where = options.get("where")
        return {**options, "where": f"{where} and {left_out}" if where else left_out}


class Marks:
    """Points that were clicked: one that is looked at, or two that are measured."""

    def __init__(self):
        self._points = []
        self.rows = []

    def clear(self):
        self._points, self.rows = [], []

    def take(self, point, tool):
        """A point as `stream` reports it; None: the click met none."""
        if point is None:
            self.clear()
            self.rows = [["", "no point there"]]
        elif tool == "pick":
            self._points = [point["position"]]
            self.rows = _rows_of(point)
        else:
            first = self._points if len(self._points) == 1 else []
            self._points = [*first, point["position"]]
            self.rows = _measured(self._points)

    def drawn(self, camera, aspect):
        """Where they are in the picture, in parts of its height, from the left and the top."""
        marks = []
        for place in self._points:
            at = projected(camera, place)
            if at is None:
                return []
            marks.append([aspect / 2 + at[0], 0.5 - at[1]])
        return marks


def _rows_of(point):
    rows = [[axis, f"{value:.3f}"] for axis, value in zip("xyz", point["position"])]
    for name, value in point["attributes"].items():
        values = value if isinstance(value, list) else [value]
        rows.append([name, " ".join(map(_number, values))])
    return [*rows, ["id", str(point["id"])], ["store", point["store"].rsplit("/", 1)[-1]]]


def _measured(points):
    if len(points) < 2:
        return [["measure", "click the second point"]]
    dx, dy, dz = (b - a for a, b in zip(*points))
    return [["distance", f"{math.hypot(dx, dy, dz):.3f}"],
            ["horizontal", f"{math.hypot(dx, dy):.3f}"], ["height", f"{dz:+.3f}"]]
