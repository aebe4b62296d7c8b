"""A view that is drawn here and shown in a browser: events come in, JPEG goes out."""

import asyncio
import concurrent.futures
import io
import math
import time

from PIL import Image

from ._errors import PointFrontError
from ._orbit import OrbitCamera
from ._stream import FrameStream

REST_SECONDS = 0.2  # without an event: the view is refined
MOVING_QUALITY = 60  # as JPEG counts it
RESTING_QUALITY = 90
FRAME_MS = 66.7  # the tool's, unless --frame-ms says otherwise
SLOW = 0.75  # times FRAME_MS: a frame in motion that takes longer makes the next motion's smaller
FAST = 0.375
VIEWS = ("iso", "top", "front", "back", "left", "right")
SCALES = (1.0, 0.75, 0.5)  # shares of the size, in motion
LARGEST_EDGE = 4096  # pixels
WAIT_MS = 50  # for what the disk gives; an event waits as long at most
MOST_TURNS = 50.0  # the wheel's in one event
SENT_AT_ONCE = 1  # frames that a slow line may be behind
STILL_PIXELS = 4  # a mouse that moved no farther while it was pressed has clicked


def jpeg(pixels, quality):
    """`pixels` height by width by 4, uint8; the fourth is ignored."""
    height, width = pixels.shape[:2]
    picture = Image.frombuffer("RGBX", (width, height), pixels, "raw", "RGBX", 0, 1)
    file = io.BytesIO()
    picture.save(file, "jpeg", quality=quality)
    return file.getvalue()


def _finite(number, most=1e6):
    """A client's number; ValueError for what is none."""
    value = float(number)
    if not abs(value) < math.inf:
        raise ValueError(f"a client says {value}")
    return max(-most, min(most, value))


def _frame_seconds(arguments):
    """That a frame in motion may take to be drawn."""
    words = [str(word) for word in arguments]
    at = words.index("--frame-ms") if "--frame-ms" in words else None
    try:
        return (FRAME_MS if at is None else float(words[at + 1])) / 1000
    except (IndexError, ValueError):  # the tool says what is wrong with it
        return FRAME_MS / 1000


class RemoteView:
    """Draws while its event loop runs, and hands on what was drawn.

    It is both the area and the scheduler of trame-rca's RcaViewAdapter (its
    RemoteControlledAreaProtocol and RcaRenderSchedulerProtocol).

    paths, arguments  as FrameStream's
    told              called with the facts of each frame, or with {"problem": text} at the end;
                      "legend" is among those of the first after the drawing changed
    picked            called with what `stream` says of the point that was clicked; None: there is
                      none. Without it a click does nothing

    Threads: the event loop's; frames are drawn and encoded on one of its own.
    """

    target_fps = 30.0  # asked of a scheduler; the view draws as fast as it can

    def __init__(self, paths, arguments=(), told=lambda facts: None):
        self._paths = list(paths)
        self._arguments = list(arguments)
        self._told = told
        self.picked = None
        self._clicks = None  # where the mouse was pressed, unless it was dragged since
        self._asked = []  # places that were clicked: column and row, parts of the height
        self._push = None
        self._pending = lambda: 0
        self._size = (1280, 720)
        self._sizes = {}  # each client's
        self._leading = None  # the client whose size pictures have: that which moved last
        self._scale = 0  # which of SCALES
        self._seconds = []  # one for each frame of this motion
        self._frame_seconds = _frame_seconds(self._arguments)
        self._orbit = None
        self._view = "iso"  # to be taken, instead of the camera
        self._last_facts = {}
        self._pressed = None
        self._at = (0.0, 0.0)
        self._pinch = 1.0
        self._moved = -REST_SECONDS  # when an event moved the camera
        self._stream = FrameStream(self._paths, self._arguments)
        self._restarts = False
        self._news = None  # an asyncio.Event, once there is a loop
        self._task = None
        self._drawing = concurrent.futures.ThreadPoolExecutor(1, "pointfront-frames")
        try:
            # An error is told here, not in the browser.
            self.legend = self._stream.frame(size=(16, 9), legend=True).facts["legend"]
        except PointFrontError:
            self._end_stream()
            raise

    # RcaRenderSchedulerProtocol
    @property
    def rca(self):
        return self

    def set_push_callback(self, callback):
        self._push = callback

    def schedule_render(self):
        if self._news is None:
            self._news = asyncio.Event()
            self._task = asyncio.get_running_loop().create_task(self._run())
        self._news.set()

    def reset(self):
        """A browser came: it has no picture yet."""
        self.schedule_render()

    async def close(self):
        if self._task is not None:
            self._task.cancel()
            await asyncio.gather(self._task, return_exceptions=True)
        self.end()

    def end(self):
        """Ends the tool; for when the event loop has ended."""
        self._drawing.submit(self._end_stream)
        self._drawing.shutdown(wait=True)

    # RemoteControlledAreaProtocol
    @property
    def img_cols_rows(self):
        raise PointFrontError("frames are pushed: none can be asked for")

    def process_resize_event(self, width, height, client=None):
        """Takes the size of a client's window. Who only looks sees all of who moves."""
        largest = max(width, height)
        scale = min(1.0, LARGEST_EDGE / largest)
        self._sizes[client] = (max(1, int(width * scale)), max(1, int(height * scale)))
        if self._leading not in self._sizes:
            self._leading = client
        self._size = self._sizes[self._leading]

    def forget(self, client):
        """It has gone."""
        self._sizes.pop(client, None)
        if client == self._leading and self._sizes:
            self._lead(next(iter(self._sizes)))
            self.schedule_render()

    def _lead(self, client):
        self._pressed = None
        self._leading = client
        self._size = self._sizes.get(client, self._size)

    def process_interaction_event(self, event, client=None):
        kind = event.get("type", "")
        begins = kind.endswith("ButtonPress") or kind in ("MouseWheel", "StartPinch")
        if client != self._leading:
            if not begins:
                return  # a mouse over a picture of another's
            self._lead(client)
        width, height = self._size
        at = (_finite(event.get("x", 0)) / height, _finite(event.get("y", 0)) / height)
        if kind.endswith("ButtonPress"):
            self._pressed = kind[:-len("ButtonPress")]
            self._at = at
            self._clicks = at if self._pressed == "Left" and not event.get("shiftKey") else None
        elif kind.endswith("ButtonRelease"):
            self._pressed = None
            if self._clicks is not None and self.picked is not None:
                self._asked = [(at[0], 1.0 - at[1])]
            self._clicks = None
        elif kind == "MouseMove" and self._pressed is not None:
            if self._clicks is not None and math.dist(at, self._clicks) * height <= STILL_PIXELS:
                return
            self._clicks = None
            self._drag(at[0] - self._at[0], at[1] - self._at[1], event.get("shiftKey"))
            self._at = at
        elif kind == "MouseWheel":
            self._zoom(1.1 ** -_finite(event.get("spinY", 0), MOST_TURNS), at, width / height)
        elif kind == "StartPinch":
            self._pinch = 1.0
        elif kind == "Pinch":
            factor = max(1e-3, _finite(event.get("factor", 1.0), 1e3))
            self._zoom(factor / self._pinch, None, 1.0)
            self._pinch = factor

    def _drag(self, right, up, shift):
        if self._orbit is None or (right == 0 and up == 0):
            return
        if self._pressed == "Right":
            self._orbit.zoom(4.0 ** up)
        elif self._pressed == "Middle" or shift:
            self._orbit.pan(right, up)
        else:
            self._orbit.rotate(right, up)
        self._moved = time.monotonic()

    def _zoom(self, factor, at, aspect):
        if self._orbit is None or factor == 1.0:
            return
        off = (at[0] - aspect / 2, at[1] - 0.5) if at is not None else (0.0, 0.0)
        self._orbit.zoom(factor, *off)
        self._moved = time.monotonic()

    # The methods below do what the page asks for.
    def look(self, view):
        """From "iso", "top", "front", "back", "left" or "right", at all of the cloud."""
        if view in VIEWS:
            self._view = view
            self.schedule_render()

    def draw_with(self, arguments):
        """With other arguments of the command line from now on, from where the camera is."""
        self._arguments = list(arguments)
        self._frame_seconds = _frame_seconds(self._arguments)
        self._restarts = True
        self.schedule_render()

    def watch_network(self, pending):
        """`pending()`: how many frames the quickest client has not taken yet."""
        self._pending = pending

    # Drawing, on its thread
    def _end_stream(self):
        if self._stream is not None:
            self._stream.close()
            self._stream = None

    def _draw(self, request, quality, restarts):
        if restarts:
            self._end_stream()
            self._stream = FrameStream(self._paths, self._arguments)
        frame = self._stream.frame(**request)
        return frame, None if frame.pixels is None else jpeg(frame.pixels, quality)

    # Drawing, as the event loop sees it
    def _request(self, moving):
        scale = SCALES[self._scale] if moving else 1.0
        request = {"size": [max(1, int(edge * scale)) for edge in self._size], "moving": moving}
        if self._view is not None:
            request["view"], self._view = self._view, None
        elif self._orbit is not None:
            request["camera"] = self._orbit.as_dictionary()
        return request

    async def _show(self, request, moving):
        while self._pending() > SENT_AT_ONCE:  # a slow line gets fewer frames, not older ones
            await asyncio.sleep(0.002)
        restarts, self._restarts = self._restarts, False
        if restarts:
            request["legend"] = True
        begin = time.monotonic()
        quality = MOVING_QUALITY if moving else RESTING_QUALITY
        loop = asyncio.get_running_loop()
        frame, data = await loop.run_in_executor(
            self._drawing, self._draw, request, quality, restarts)
        if self._orbit is None or "view" in request:
            self._orbit = OrbitCamera(frame.camera)
        if data is not None and self._push is not None:
            height, width = frame.pixels.shape[:2]
            now = time.time_ns() // 1_000_000
            self._push(data, {"type": "image/jpeg", "codec": "", "w": width, "h": height,
                              "st": now, "key": "key", "quality": quality})
            self._last_facts = {**frame.facts, "moving": moving}
            self._told(self._last_facts)
        elif frame.settled and self._last_facts.get("settled") is False:  # no pixel changed
            self._last_facts = {**self._last_facts, "settled": True}
            self._told(self._last_facts)
        if moving:
            self._seconds.append(time.monotonic() - begin)
        return frame

    async def _pick(self):
        """Asks for what was clicked, with the camera that is seen."""
        asked, self._asked = self._asked, []
        if not asked or self._orbit is None or self._view is not None or self._restarts:
            return
        request = self._request(False)
        height = request["size"][1]
        request["pick"] = [edge * height for edge in asked[-1]]
        loop = asyncio.get_running_loop()
        frame, _ = await loop.run_in_executor(self._drawing, self._draw, request, 0, False)
        if self.picked is not None:
            self.picked(frame.facts["picked"])

    def _choose_scale(self):
        """By the frames of the last motion, before the next: a size that changes within is ugly."""
        if len(self._seconds) >= 3:
            middle = sorted(self._seconds)[len(self._seconds) // 2]
            time_of_frame = middle / self._frame_seconds
            step = (time_of_frame > SLOW) - (time_of_frame < FAST)
            self._scale = max(0, min(len(SCALES) - 1, self._scale + step))
        self._seconds = []

    def _moves(self):
        return time.monotonic() - self._moved < REST_SECONDS

    async def _refine(self):
        """Frames at rest, until all is there or something happens."""
        self._choose_scale()
        frame = await self._show(self._request(False), False)
        while not frame.settled and not self._news.is_set():
            frame = await self._show({**self._request(False), "wait_ms": WAIT_MS}, False)

    async def _answer_events(self):
        """Frames in motion, until the mouse rests, and those at rest."""
        while self._moves():
            await self._show(self._request(True), True)
            if not self._news.is_set():  # the mouse rests: perhaps for a moment
                rest = self._moved + REST_SECONDS - time.monotonic()
                try:
                    await asyncio.wait_for(self._news.wait(), max(0.0, rest))
                except asyncio.TimeoutError:
                    break
            self._news.clear()
        await self._refine()

    async def _run(self):
        while True:
            await self._news.wait()
            self._news.clear()
            try:
                await self._pick()
                await self._answer_events()
            except Exception as problem:  # all who look are told; the next event begins again
                self._told({"problem": str(problem) or type(problem).__name__})
                self._restarts = True
                self._orbit = None
