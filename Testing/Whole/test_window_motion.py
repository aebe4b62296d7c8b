"""Windows of VTK that show two clouds: when the camera begins to move, and when it rests.

Environment: as test_random_windows.py. It needs a display.
usage: test_window_motion.py
"""

import time
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

    def test_a_window_at_rest_sleeps(self):
        """No thread of the process does anything, and nobody asks for another frame."""
        stores, camera = halves_of_a_town(self)
        for backend in BACKENDS:
            window = Window(SIZE)
            drawn = []
            window.window.AddObserver("EndEvent", lambda *_, frames=drawn: frames.append(1))
            case = {"style": WHITE, "error": 0.5, "camera": camera}
            mappers = window.show(stores, case, backend)
            for _ in range(200):
                window.window.Render()
                if not any(mapper.NeedsRender() for mapper in mappers):
                    break
                time.sleep(0.02)
            time.sleep(0.5)  # nodes that are read ahead come
            self.assertTrue(all(mapper.GetLastComplete() for mapper in mappers), backend)
            frames, before = len(drawn), time.process_time()
            time.sleep(1.0)
            self.assertLess(time.process_time() - before, 0.005, backend)
            self.assertFalse(any(mapper.NeedsRender() for mapper in mappers), backend)
            self.assertEqual(len(drawn), frames, backend)


if __name__ == "__main__":
    unittest.main()
