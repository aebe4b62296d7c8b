"""Mouse and keyboard of a person at an X server: events as devices give them (XTest)."""

import ctypes
import os
import time

_CLICK_BUTTONS = {"left": 1, "middle": 2, "right": 3, "wheel up": 4, "wheel down": 5}


def _library(name):
    library = ctypes.CDLL(name)
    for function, result, arguments in (
            ("XOpenDisplay", ctypes.c_void_p, [ctypes.c_char_p]),
            ("XDefaultRootWindow", ctypes.c_ulong, [ctypes.c_void_p]),
            ("XQueryTree", ctypes.c_int,
             [ctypes.c_void_p, ctypes.c_ulong, *[ctypes.POINTER(ctypes.c_ulong)] * 2,
              ctypes.POINTER(ctypes.POINTER(ctypes.c_ulong)), ctypes.POINTER(ctypes.c_uint)]),
            ("XFetchName", ctypes.c_int,
             [ctypes.c_void_p, ctypes.c_ulong, ctypes.POINTER(ctypes.c_char_p)]),
            ("XTranslateCoordinates", ctypes.c_int,
             [ctypes.c_void_p, ctypes.c_ulong, ctypes.c_ulong, ctypes.c_int, ctypes.c_int,
              *[ctypes.POINTER(ctypes.c_int)] * 2, ctypes.POINTER(ctypes.c_ulong)]),
            ("XFree", ctypes.c_int, [ctypes.c_void_p]),
            ("XStringToKeysym", ctypes.c_ulong, [ctypes.c_char_p]),
            ("XKeysymToKeycode", ctypes.c_ubyte, [ctypes.c_void_p, ctypes.c_ulong]),
            ("XkbKeycodeToKeysym", ctypes.c_ulong,
             [ctypes.c_void_p, ctypes.c_ubyte, ctypes.c_int, ctypes.c_int]),
            ("XInternAtom", ctypes.c_ulong, [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int]),
            ("XSync", ctypes.c_int, [ctypes.c_void_p, ctypes.c_int]),
            ("XCloseDisplay", ctypes.c_int, [ctypes.c_void_p]),
            ("XTestFakeMotionEvent", ctypes.c_int,
             [ctypes.c_void_p, *[ctypes.c_int] * 3, ctypes.c_ulong]),
            ("XTestFakeButtonEvent", ctypes.c_int,
             [ctypes.c_void_p, ctypes.c_uint, ctypes.c_int, ctypes.c_ulong]),
            ("XTestFakeKeyEvent", ctypes.c_int,
             [ctypes.c_void_p, ctypes.c_uint, ctypes.c_int, ctypes.c_ulong])):
        if hasattr(library, function):
            getattr(library, function).restype = result
            getattr(library, function).argtypes = arguments
    return library


class Hands:
    """At the window whose title begins with `title`; waits for it. Places are pixels from the upper
    left corner of the window."""

    def __init__(self, title, limit=60.0):
        self.x11, self.test = _library("libX11.so.6"), _library("libXtst.so.6")
        self.display = self.x11.XOpenDisplay(os.environ["DISPLAY"].encode())
        if not self.display:
            raise RuntimeError("no X server answers")
        self.root = self.x11.XDefaultRootWindow(self.display)
        end = time.monotonic() + limit
        self.window = None
        while self.window is None:
            if time.monotonic() > end:
                raise TimeoutError(f"no window {title}")
            time.sleep(0.05)
            self.window = next(
                (w for w in self._children(self.root) if self._name(w).startswith(title)), None)
        x, y, child = ctypes.c_int(), ctypes.c_int(), ctypes.c_ulong()
        self.x11.XTranslateCoordinates(self.display, self.window, self.root, 0, 0,
                                       ctypes.byref(x), ctypes.byref(y), ctypes.byref(child))
        self.corner = (x.value, y.value)

    def close(self):
        self.x11.XCloseDisplay(self.display)

    def _children(self, window):
        root, parent, count = ctypes.c_ulong(), ctypes.c_ulong(), ctypes.c_uint()
        children = ctypes.POINTER(ctypes.c_ulong)()
        self.x11.XQueryTree(self.display, window, ctypes.byref(root), ctypes.byref(parent),
                            ctypes.byref(children), ctypes.byref(count))
        found = [children[i] for i in range(count.value)]
        if count.value:
            self.x11.XFree(children)
        return found

    def _name(self, window):
        name = ctypes.c_char_p()
        known = self.x11.XFetchName(self.display, window, ctypes.byref(name))
        return name.value.decode(errors="replace") if known and name.value else ""

    def _sync(self):
        self.x11.XSync(self.display, 0)

    def move(self, x, y):
        self.test.XTestFakeMotionEvent(self.display, -1, self.corner[0] + x, self.corner[1] + y, 0)
        self._sync()

    def button(self, name, down):
        self.test.XTestFakeButtonEvent(self.display, _CLICK_BUTTONS[name], int(down), 0)
        self._sync()

    def click(self, x, y, name="left"):
        self.move(x, y)
        self.button(name, True)
        self.button(name, False)

    def drag(self, begin, end, name="left", steps=8):
        self.move(*begin)
        self.button(name, True)
        for step in range(1, steps + 1):
            self.move(*(round(a + (b - a) * step / steps) for a, b in zip(begin, end)))
            time.sleep(0.01)
        self.button(name, False)

    def _keycode(self, keysym):
        symbol = self.x11.XStringToKeysym(keysym.encode())
        code = self.x11.XKeysymToKeycode(self.display, symbol)
        if not code:
            raise ValueError(f"the keyboard has no key {keysym}")
        return code, self.x11.XkbKeycodeToKeysym(self.display, code, 0, 0) != symbol

    def hold(self, keysym, down):
        self.test.XTestFakeKeyEvent(self.display, self._keycode(keysym)[0], int(down), 0)
        self._sync()

    def press(self, keysym):
        """A key by its X name: "c", "question", "Escape"."""
        _, shifted = self._keycode(keysym)
        if shifted:
            self.hold("Shift_L", True)
        self.hold(keysym, True)
        self.hold(keysym, False)
        if shifted:
            self.hold("Shift_L", False)
