"""Windows of VTK that show two clouds when the camera begins to move.

Environment: as test_random_windows.py. It needs a display.
usage: test_window_motion.py
"""

import unittest

from halves import SIZE, WHITE, halves_of_a_town, lit, moved
from test_random_windows import BACKENDS, Window
from tool import ToolTest


class WindowMotion(ToolTest):
    def test_no_cloud_vanishes_when_a_motion_begins(self):
        stores, camera = halves_of_a_town(self)
        for backend in BACKENDS:
            window = Window(SIZE)
            window.renderer.SetBackground(0, 0, 0)
            case = {"style": WHITE, "error": 0.5, "camera": camera}
            for mapper in window.show(stores, case, backend):
                mapper.CompleteOn()
                mapper.SetTargetFrameTime(1.0)
            window.window.SetDesiredUpdateRate(0.0001)
            for _ in range(3):  # the time of a frame is known frames later
                window.window.Render()
            rest = lit(window.pixels(again=False))
            self.assertGreater(min(rest), 1000)
            window.window.SetDesiredUpdateRate(15.0)
            for frame in range(1, 4):
                window.look(moved(camera, frame))
                window.window.Render()
                moving = lit(window.pixels(again=False))
                for before, now in zip(rest, moving):
                    self.assertGreater(now, before / 10, (backend, frame, rest, moving))


if __name__ == "__main__":
    unittest.main()
