"""pvbatch, on any number of ranks: the epochs of a collection are the steps of the time slider.

usage: pvbatch epochs.py STEPS NAME     STEPS: a JSON list, in the order of time: time, points
Saves NAME-0.png, NAME-1.png ...: one for each step.
"""

import json
import os
import sys

from paraview import simple

simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

from scene import Scene, require

steps, name = json.loads(sys.argv[1]), sys.argv[2]
times = [time for time, _ in steps]
scene = Scene()
require(list(scene.reader.TimestepValues) == times,
        "times: %s" % scene.reader.TimestepValues)
scene.color_by(scene.display, "rgb")
animation = simple.GetAnimationScene()
animation.UpdateAnimationUsingDataTimeSteps()
slider = simple.GetTimeKeeper()
require(list(slider.TimestepValues) == times, "the slider has %s" % slider.TimestepValues)


def drawn_at(time):
    animation.AnimationTime = time
    require(scene.view.ViewTime == time, "the view is at %s" % scene.view.ViewTime)
    scene.view.SMProxy.StillRender()
    return scene.frame()[0]


# In any order: forwards, backwards, and between two steps, where the earlier one lasts.
for number in [*range(len(steps)), *reversed(range(len(steps)))]:
    points = drawn_at(times[number])
    require(points == steps[number][1], "at %s: %d points drawn, the epoch has %d"
            % (times[number], points, steps[number][1]))
    scene.save("%s-%d" % (name, number))
between = drawn_at(0.5 * (times[0] + times[1]))
require(between == steps[0][1], "between two steps: %d points" % between)
