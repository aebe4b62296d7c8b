"""Which shared libraries render and bench load for each back end: see scenes.py."""

import os
import unittest

from scenes import BACKEND, TRIM, SceneTest
from tool import TOOL, run

SOFTWARE = BACKEND == "software"
WITH_VTK = os.environ["POINTFRONT_WITH_VTK"] == "1"


class Libraries(SceneTest):
    """Returns the libraries loaded into the process, as the dynamic linker tells them."""

    FOREIGN = ("libGL", "libEGL", "libOSMesa", "libX11", "libxcb", "libvtk", "libGLX")

    def loaded(self, *arguments, environment):
        log = self.folder / "linker"
        outcome = run(TOOL, *arguments, environment={
            **environment, "LD_DEBUG": "files", "LD_DEBUG_OUTPUT": str(log)})
        names = set()
        for file in self.folder.glob("linker.*"):
            for line in file.read_text(errors="replace").splitlines():
                if "calling init:" in line:
                    names.add(line.split("/")[-1])
            file.unlink()
        self.assertTrue(any(name.startswith("libpointfrontCore") for name in names), names)
        return outcome, [name for name in names if name.startswith(self.FOREIGN)]

    def test_software_loads_no_display_and_no_gl(self):
        store = self.build(TRIM)
        bare = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        for words in (("render", store, "-o", self.folder / "x.png"),
                      ("bench", store, "--path", "orbit", "--frames", 3, "--stats",
                       self.folder / "x.json")):
            outcome, foreign = self.loaded(*words, "--backend", "software", environment=bare)
            self.assertEqual(outcome.status, 0, outcome)
            self.assertEqual(foreign, [])

    @unittest.skipIf(SOFTWARE, "needs an X server")
    def test_opengl_is_seen_by_this_test(self):
        store = self.build(TRIM)
        outcome, foreign = self.loaded(
            "render", store, "-o", self.folder / "x.png", "--backend", "opengl",
            environment=dict(os.environ))
        self.assertEqual(outcome.status, 0, outcome)
        for library in ("libGL", "libX11", "libvtk"):
            self.assertTrue(any(name.startswith(library) for name in foreign), foreign)

    @unittest.skipIf(WITH_VTK, "this build has OpenGL")
    def test_without_vtk_opengl_is_refused(self):
        store = self.build(TRIM)
        for words in (("render", store, "-o", self.folder / "x.png"),
                      ("bench", store, "--path", "orbit", "--stats", self.folder / "x.json")):
            outcome = self.refuse(1, *words, "--backend", "opengl")
            self.assertIn("--backend software", outcome.err)
        self.assertEqual(self.entries(), ["cloud.pfront"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
