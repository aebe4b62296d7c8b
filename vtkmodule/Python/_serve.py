"""`pointfront serve`: a page with a view of stores, drawn here without a display."""

import argparse
import asyncio
import os
import signal
import sys

from . import _far
from ._errors import PointFrontError

# Options of `pointfront render`, and what argparse shows for their values.
VALUES = {"color-by": "ATTRIBUTE", "technique": "NAME", "style": "FILE.json", "classes": "LIST",
          "where": "CONDITION", "error": "PX", "point-size": "PX", "point-budget": "N",
          "memory": "BYTES", "background": "R,G,B", "quality": "NAME", "frame-ms": "MS"}
FLAGS = ("edl",)
INTERRUPTED = 130  # an exit status


def _port(text):
    number = int(text)
    if not 0 <= number <= 65535:
        raise ValueError
    return number


_port.__name__ = "port (0 to 65535)"  # argparse's messages name it


def address_of(host, port):
    """The address of a page; IPv6 stands in brackets."""
    name = f"[{host}]" if ":" in host and not host.startswith("[") else host
    return f"http://{name}:{port}/"


def parser():
    made = argparse.ArgumentParser(
        prog="pointfront serve",
        description="A page with a view of stores, drawn here in software: no display, no OpenGL. "
                    "All who open it see the same view. Options as of `pointfront render`.")
    made.add_argument("stores", nargs="+", metavar="STORE")
    made.add_argument("--port", type=_port, default=8080, help="8080; 0: any free one")
    made.add_argument("--host", default="localhost",
                      help="whom to listen to: localhost, or 0.0.0.0 for other machines; the whole "
                           "printed address opens the view, and nothing is encrypted")
    made.add_argument("--open", action="store_true", help="open it in this machine's browser")
    for name, shown in VALUES.items():
        made.add_argument(f"--{name}", metavar=shown)
    for name in FLAGS:
        made.add_argument(f"--{name}", action="store_true")
    return made


def end_by_signals():
    """From now on Ctrl-C, SIGTERM and SIGHUP end the event loop that runs, between two of its
    callbacks: Python's own interrupt comes anywhere, and what it leaves locked can keep the process
    for ever. The second one ends the process at once; the tool ends with its input.
    """
    loop = asyncio.get_running_loop()
    told = []

    def end():
        if told:
            os._exit(INTERRUPTED)
        told.append(True)
        for number in numbers:  # the loop will not run any more
            signal.signal(number, lambda *_: os._exit(INTERRUPTED))
        raise KeyboardInterrupt

    # Ignored ones stay so, as those of a shell's job in the background.
    numbers = [number for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
               if signal.getsignal(number) != signal.SIG_IGN]
    for number in numbers:
        loop.add_signal_handler(number, end)


def main(arguments):
    """Serves until it is interrupted; the exit status."""
    chosen = parser().parse_args(arguments)
    _far.hide_secrets()
    sys.argv = sys.argv[:1]  # trame reads it, too
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    os.environ.setdefault("WSLINK_WS_COMPRESS", "0")  # JPEG does not become smaller
    try:
        from ._kernel import StoredCloud
        from ._page import CloudPage

        given = vars(chosen)
        options = {name: given[name.replace("-", "_")] for name in (*VALUES, *FLAGS)}
        page = CloudPage(chosen.stores, {n: v for n, v in options.items() if v})
        for path in chosen.stores:
            for text in StoredCloud(path).description["warnings"]:
                print(f"pointfront serve: warning: {path}: {text}", file=sys.stderr, flush=True)

        def say(**_):
            end_by_signals()
            where = f"{address_of(chosen.host, page.server.port)}?{page.query}"
            print(f"pointfront serve: {where} (Ctrl-C ends it)", flush=True)
            if chosen.open:
                import webbrowser

                webbrowser.open(where)

        page.server.controller.on_server_ready.add(say)
        page.serve(port=chosen.port, host=chosen.host)
    except KeyboardInterrupt:
        return INTERRUPTED
    except (PointFrontError, OSError) as problem:
        print(f"pointfront serve: {problem}", file=sys.stderr)
        return 1
    return 0
