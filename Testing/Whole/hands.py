"""Mouse and keyboard of a person at an X server: events as devices give them (XTest)."""

import ctypes
import os
import pathlib
import time

import numpy

_CLICK_BUTTONS = {"left": 1, "middle": 2, "right": 3, "wheel up": 4, "wheel down": 5}


_SELECTION_REQUEST, _SELECTION_NOTIFY, _CLIENT_MESSAGE = 30, 31, 33
_HEAD = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
         ("display", ctypes.c_void_p)]


class _ClientMessage(ctypes.Structure):
    _fields_ = [*_HEAD, ("window", ctypes.c_ulong), ("message", ctypes.c_ulong),
                ("format", ctypes.c_int), ("data", ctypes.c_long * 5)]


class _Request(ctypes.Structure):
    _fields_ = [*_HEAD, *((name, ctypes.c_ulong) for name in
                          ("owner", "requestor", "selection", "target", "property", "time"))]


class _Notification(ctypes.Structure):
    _fields_ = [*_HEAD, *((name, ctypes.c_ulong) for name in
                          ("requestor", "selection", "target", "property", "time"))]


class _Image(ctypes.Structure):
    _fields_ = [*((name, ctypes.c_int) for name in ("width", "height", "xoffset", "format")),
                ("data", ctypes.c_void_p),
                *((name, ctypes.c_int) for name in (
                    "byte_order", "bitmap_unit", "bitmap_bit_order", "bitmap_pad", "depth",
                    "bytes_per_line", "bits_per_pixel"))]


class _Event(ctypes.Union):
    _fields_ = [("type", ctypes.c_int), ("client", _ClientMessage), ("request", _Request),
                ("notification", _Notification), ("pad", ctypes.c_long * 24)]


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
            ("XPending", ctypes.c_int, [ctypes.c_void_p]),
            ("XNextEvent", ctypes.c_int, [ctypes.c_void_p, ctypes.c_void_p]),
            ("XSendEvent", ctypes.c_int,
             [ctypes.c_void_p, ctypes.c_ulong, ctypes.c_int, ctypes.c_long, ctypes.c_void_p]),
            ("XCreateSimpleWindow", ctypes.c_ulong,
             [ctypes.c_void_p, ctypes.c_ulong, *[ctypes.c_int] * 2, *[ctypes.c_uint] * 3,
              *[ctypes.c_ulong] * 2]),
            ("XSetSelectionOwner", ctypes.c_int,
             [ctypes.c_void_p, *[ctypes.c_ulong] * 3]),
            ("XChangeProperty", ctypes.c_int,
             [ctypes.c_void_p, *[ctypes.c_ulong] * 3, *[ctypes.c_int] * 2, ctypes.c_char_p,
              ctypes.c_int]),
            ("XGetImage", ctypes.POINTER(_Image),
             [ctypes.c_void_p, ctypes.c_ulong, *[ctypes.c_int] * 2, *[ctypes.c_uint] * 2,
              ctypes.c_ulong, ctypes.c_int]),
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

    def seen(self, width, height):
        """Returns what the screen shows of the window, its texts, too: height by width by 3."""
        every_plane, by_pixels = ctypes.c_ulong(-1).value, 2
        image = self.x11.XGetImage(self.display, self.window, 0, 0, width, height, every_plane,
                                   by_pixels)
        if not image or image.contents.bits_per_pixel != 32:
            raise RuntimeError("the X server gives no picture of 32 bits a pixel")
        rows = ctypes.string_at(image.contents.data, height * image.contents.bytes_per_line)
        self.x11.XFree(image.contents.data)
        self.x11.XFree(image)
        pixels = numpy.frombuffer(rows, numpy.uint8).reshape(height, -1, 4)
        return pixels[:, :width, 2::-1]

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

    def drop(self, files, limit=20.0):
        """Drags files in, as a file manager does (Xdnd 5), and waits until they are taken."""
        atom = {name: self.x11.XInternAtom(self.display, name.encode(), 0) for name in (
            "XdndEnter", "XdndPosition", "XdndDrop", "XdndFinished", "XdndSelection",
            "XdndActionCopy", "text/uri-list")}
        source = self.x11.XCreateSimpleWindow(self.display, self.root, 0, 0, 1, 1, 0, 0, 0)
        self.x11.XSetSelectionOwner(self.display, atom["XdndSelection"], source, 0)
        for message, data in (
                ("XdndEnter", (5 << 24, atom["text/uri-list"], 0, 0)),
                ("XdndPosition", (0, self.corner[0] << 16 | self.corner[1], 0,
                                  atom["XdndActionCopy"])),
                ("XdndDrop", (0, 0, 0, 0))):
            event = _Event(client=_ClientMessage(
                type=_CLIENT_MESSAGE, display=self.display, window=self.window,
                message=atom[message], format=32, data=(source, *data)))
            self.x11.XSendEvent(self.display, self.window, 0, 0, ctypes.byref(event))
        self._sync()
        text = "".join(f"{pathlib.Path(file).resolve().as_uri()}\r\n" for file in files).encode()
        end = time.monotonic() + limit
        while time.monotonic() < end:
            if not self.x11.XPending(self.display):
                time.sleep(0.01)
                continue
            event = _Event()
            self.x11.XNextEvent(self.display, ctypes.byref(event))
            if event.type == _SELECTION_REQUEST:
                asked = event.request
                self.x11.XChangeProperty(self.display, asked.requestor, asked.property,
                                         asked.target, 8, 0, text, len(text))
                answer = _Event(notification=_Notification(
                    type=_SELECTION_NOTIFY, display=self.display, requestor=asked.requestor,
                    selection=asked.selection, target=asked.target, property=asked.property))
                self.x11.XSendEvent(self.display, asked.requestor, 0, 0, ctypes.byref(answer))
                self._sync()
            elif event.type == _CLIENT_MESSAGE and event.client.message == atom["XdndFinished"]:
                return
        raise TimeoutError("nobody took the files")
