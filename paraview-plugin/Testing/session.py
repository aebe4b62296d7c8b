"""The ParaView application as its own scripts run it: a report in a file, and an end on failure."""

import json
import os
import sys
import time
import traceback

from paraview import simple

OUTPUT = os.environ["POINTFRONT_OUTPUT"]
TICK = 200  # milliseconds
LONGEST = 700  # seconds until a session that hangs says what it waits for
AT_REST = 5  # ticks of the event loop: what is the same so often has come to rest


class Session:
    """A script of the application fills `found`, which NAME.json gets."""

    def __init__(self, name, **found):
        self.name = name
        self.found = {**found, "failure": None}

    def write(self):
        with open(os.path.join(OUTPUT, self.name + ".json"), "w") as file:
            json.dump(self.found, file, indent=1)

    def end(self):
        """Ends the application at once: scripts have no way out, and nothing is left to save."""
        self.write()
        sys.stdout.flush()
        os._exit(1 if self.found["failure"] else 0)

    def guarded(self, action):
        """Makes a function of `action` whose failure is written and ends the application."""
        def run(*_):
            try:
                action()
            except BaseException:
                self.found["failure"] = traceback.format_exc()
                print(self.found["failure"])
                self.end()
        return run

    def load(self):
        """Loads the plugin; a modal dialog would wait for somebody."""
        simple.GetSettingsProxy("GeneralSettings").ShowWelcomeDialog = 0
        simple.LoadPlugin(os.environ["POINTFRONT_PLUGIN"], remote=False, ns=globals())

    def every_tick(self, view, action, waits_for=lambda: "its end"):
        """Calls `action` in the view's event loop, again and again; it runs while a user would.
        `waits_for` says what has not come when the session hangs."""
        interactor = view.SMProxy.GetInteractor()
        begun = time.monotonic()

        @self.guarded
        def tick():
            action()
            if time.monotonic() - begun > LONGEST:
                raise AssertionError("it waits for %s: %s" % (waits_for(), self.found))
            interactor.CreateOneShotTimer(TICK)

        interactor.AddObserver("TimerEvent", tick)
        interactor.CreateOneShotTimer(TICK)
