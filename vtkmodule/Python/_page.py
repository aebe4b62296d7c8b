"""A page with a view of stored clouds: drawn here, shown in a browser or in a notebook."""

import asyncio
import html as html_text
import itertools
import math
import threading

from ._controls import (CHOSEN_BY_CLIENTS, CLEAR, OVERLAY, POINT_SIZES, TECHNIQUES, TOGGLE, TOOLS,
                        Classes, Marks, colours_of, legend_state, may_choose)
from ._errors import PointFrontError

try:
    from trame.app import get_server
    from trame.ui.html import DivLayout
    from trame.widgets import html, rca
    from trame_rca.view_adapter import RcaViewAdapter

    from ._doors import Doors
    from ._lines import Lines
    from ._remote import LARGEST_EDGE, VIEWS, RemoteView
except ImportError as missing:
    raise PointFrontError(
        f"a page needs Python's packages trame, trame-rca and pillow: pip install trame trame-rca "
        f"pillow ({missing})") from None

START_SECONDS = 30.0  # for a server of a notebook

_BAR = ("position:absolute; left:8px; top:8px; display:flex; gap:6px; align-items:center; "
        "font:13px sans-serif; color:#ddd;")
_STATUS = ("position:absolute; left:8px; bottom:8px; font:12px sans-serif; color:#aaa; "
           "pointer-events:none;")
_OVER = "position:absolute; inset:0; pointer-events:none;"
_WHOLE = ("position:absolute; inset:0; overflow:hidden; background:#17191f;")
# A picture of another client's size is shown whole, not stretched.
_WHOLE_PICTURE = "{width: '100%', height: '100%', display: 'block', objectFit: 'contain'}"
_count = itertools.count(1)


def _status(facts):
    if "problem" in facts:
        return facts["problem"]
    if facts["moving"]:
        return "…"
    text = f"{facts['points']:,} points, error {facts['error_px']:.1f} px"
    if facts["failed_nodes"]:
        text += f", {facts['failed_nodes']} nodes could not be read"
    return text if facts["settled"] else text + " …"


class _Area(RcaViewAdapter):
    """trame-rca's adapter of an area, which knows one client: here each has a size of its own."""

    def __init__(self, view, name, client):
        super().__init__(view, name, scheduler=view, do_schedule_render_on_interaction=True)
        self._client = client  # whose message is being answered
        self._ratios = {}  # pixels of the screen for one of the page

    def update_size(self, _origin, size):
        ratio = _within(size.get("p", 1), 0.25, 8.0)
        edges = [_within(size.get(edge, 300), 10, LARGEST_EDGE) * ratio for edge in ("w", "h")]
        self._ratios[self._client()] = ratio
        self._rca.process_resize_event(*edges, self._client())
        self._scheduler.schedule_render()

    def on_interaction(self, _origin, event):
        ratio = self._ratios.get(self._client(), 1.0)
        event = {**event, **{key: event[key] * ratio for key in ("x", "y") if key in event}}
        self._rca.process_interaction_event(event, self._client())
        self._scheduler.schedule_render()

    def forget(self, client):
        self._ratios.pop(client, None)
        self._rca.forget(client)


def _within(number, least, most):
    """A client's number, or what is nearest to it; ValueError for what is none."""
    value = float(number)
    if math.isnan(value):
        raise ValueError("a client says NaN")
    return max(least, min(most, value))


class CloudPage:
    """A trame server with one view; all who open it see and move the same.

    paths      stores, drawn together
    arguments  {option of `pointfront render`: value or True}: {"color-by": "intensity"}
    """

    def __init__(self, paths, arguments=None):
        self._options = dict(arguments or {})
        self._camera = None  # that of the last frame
        if "style" not in self._options and "quality" not in self._options:  # they choose their own
            self._options.setdefault("technique", TECHNIQUES[0])
        self._start = dict(self._options)  # may be chosen, too, if the page does not offer it
        self._classes = Classes(paths)
        self.view = RemoteView(paths, self._arguments(), self._tell)
        self.server = get_server(f"pointfront-{next(_count)}", client_type="vue3")
        self._doors = Doors(self.server)
        self._lines = Lines(CHOSEN_BY_CLIENTS.__contains__, self._forget)
        state = self.server.state
        state.trame__title = "PointFront"
        state.colour = self._options.get("color-by", "")
        state.technique = self._options.get("technique", "")
        state.point_size = self._options.get("point-size", "")
        state.tool = ""
        state.status = ""
        state.frames = 0
        state.settled = False
        state.progress = 0
        state.aspect = 16 / 9
        self._colours = colours_of(paths[0])
        self._marks = Marks()
        self._legend = self.view.legend
        self._show_choices()
        self._show_marks(None)
        self._build(self._colours)
        state.change("colour", "technique", "point_size")(self._choose)
        state.change("tool")(self._take_up)
        self.server.trigger(TOGGLE)(self._toggle)
        self.server.trigger(CLEAR)(self._clear)

    def _build(self, colours):
        with DivLayout(self.server, style=_WHOLE) as self.layout:
            area = rca.RemoteControlledArea(
                display="image", event_throttle_ms=16, resize_throttle_ms=100,
                style="position:absolute; inset:0;",
                image_style=(_WHOLE_PICTURE,))
            self._area = _Area(self.view, area.name, lambda: self._lines.client)
            area.add_view_handler(self._area)
            with html.Div(style=_BAR):
                with html.Select(v_model=("colour",), title="colour"):
                    html.Option("colour", value="")
                    for name in colours:
                        html.Option(name, value=name)
                with html.Select(v_model=("technique",), title="technique"):
                    html.Option("technique", value="")
                    for name in TECHNIQUES:
                        html.Option(name, value=name)
                with html.Select(v_model=("point_size",), title="point size"):
                    html.Option("size", value="")
                    for size in POINT_SIZES:
                        html.Option(f"{size} px", value=size)
                for name in VIEWS:
                    html.Button(name, click=(self.view.look, f"['{name}']"))
                for name in TOOLS[1:]:
                    html.Button(name, click=f"tool = tool == '{name}' ? '' : '{name}'",
                                raw_attrs=[f":style=\"{{fontWeight: tool == '{name}' ? 'bold' : "
                                           f"'normal'}}\""])
            html.Div(OVERLAY, style=_OVER)
            html.Div("{{ status }}", style=_STATUS, classes="pointfront-status",
                     raw_attrs=[':data-frames="frames"', ':data-settled="settled"'])
        controller = self.server.controller
        controller.on_server_bind.add(self._doors.bind)
        controller.on_server_bind.add(self._lines.bind)
        controller.on_server_ready.add(self._doors.open)
        self.view.watch_network(self._lines.waiting)

    @property
    def query(self):
        """Returns what an address of this page ends with, behind '?'."""
        return self._doors.query

    def _forget(self, client):
        self._area.forget(client)

    def _arguments(self):
        words = []
        for name, value in self._classes.options(self._options).items():
            if value is True:
                words.append(f"--{name}")
            elif value not in (None, False, ""):
                words += [f"--{name}", value]
        return words

    def _choose(self, colour, technique, point_size, **_):
        chosen = dict(self._options)
        for name, option, value, offered in (
                ("colour", "color-by", colour, self._colours),
                ("technique", "technique", technique, TECHNIQUES),
                ("point_size", "point-size", point_size, POINT_SIZES)):
            if may_choose(value, offered, self._start.get(option)):
                chosen[option] = value
            else:  # others see what is drawn
                self.server.state[name] = self._options.get(option, "")
        if any(chosen[name] != self._options.get(name, "") for name in chosen):
            self._options = chosen
            self._draw_anew()

    def _toggle(self, code, shown):
        """A client's switch of a class."""
        with self.server.state:
            if isinstance(code, int) and self._classes.toggle(code, bool(shown)):
                self._draw_anew()
            self._show_choices()

    def _draw_anew(self):
        self.server.state.settled = False  # whoever looks sees at once that it loads
        self.server.state.progress = 0
        self.view.draw_with(self._arguments())

    def _show_choices(self):
        state = self.server.state
        state.legend = legend_state(self._legend, self._classes)
        state.classes = self._classes.state(self._legend)

    def _take_up(self, tool, **_):
        """A client's choice of what a click does."""
        self.view.picked = self._take if tool in TOOLS[1:] else None
        self._marks.clear()
        self._show_marks(None)

    def _take(self, point):
        """Takes what was clicked."""
        with self.server.state as state:
            self._marks.take(point, state.tool)
            self._show_marks(self._camera)

    def _clear(self):
        with self.server.state:
            self._marks.clear()
            self._show_marks(None)

    def _show_marks(self, camera):
        state = self.server.state
        state.rows = self._marks.rows
        state.marks = self._marks.drawn(camera, state.aspect) if camera else []

    def _progress(self, facts):
        """Percent: how near the picture is to the error that it is to have."""
        wanted = float(self._options.get("error", 1.0))
        return round(100 * min(1.0, wanted / max(facts["error_px"], wanted, 1e-9)))

    def _tell(self, facts):
        with self.server.state as state:
            state.status = _status(facts)
            state.settled = bool(facts.get("settled"))
            state.frames += 1
            if "problem" in facts:
                return
            state.progress = self._progress(facts)
            if "legend" in facts:
                self._legend = facts["legend"]
                self._show_choices()
            self._camera = facts["camera"]
            state.aspect = facts["width"] / facts["height"]
            self._show_marks(self._camera)

    def serve(self, **start):
        """Blocks until it is interrupted; `start` as trame's Server.start."""
        try:
            self.server.start(thread=True, open_browser=False, disable_logging=True,
                              show_connection_info=False, timeout=0, **start)
        finally:
            self.view.end()


_of_cells = {}  # {cell of a notebook: (run of it, its views)}


def view_of_cell(paths, height):
    """A NotebookView; those that an earlier run of the same cell made are ended."""
    cell, run = _running_cell()
    last_run, views = _of_cells.pop(cell, (run, []))
    if last_run != run:
        for view in views:
            view.close()
        views = []
    views = [*views, NotebookView(paths, height=height)]
    _of_cells[cell] = run, views
    return views[-1]


def _running_cell():
    """Returns a cell's key and its run's: the name that JupyterLab gives it; without one, its text.
    """
    from IPython import get_ipython

    shell = get_ipython()
    asked = shell.get_parent()
    name = asked.get("metadata", {}).get("cellId")
    return name or shell.user_ns["In"][-1], asked.get("header", {}).get("msg_id")


class NotebookView:
    """A view in a notebook's cell, of a server on a thread of its own. close() ends it, and so does
    the next run of the cell.

    Where the browser is not on this machine, trame's TRAME_IFRAME_BUILDER says by which way it
    reaches the server (JupyterHub is recognised).
    """

    def __init__(self, paths, arguments=None, height=600):
        self._ready = threading.Event()
        self._height = height
        self._loop = None
        self._page = None
        self._problem = None
        self.paths = list(paths)
        self._thread = threading.Thread(target=self._run, args=(paths, arguments), daemon=True,
                                        name="pointfront-view")
        self._thread.start()
        if not self._ready.wait(START_SECONDS):
            raise PointFrontError("the server of the view does not start")
        if self._problem is not None:
            raise self._problem

    def _run(self, paths, arguments):
        self._loop = asyncio.new_event_loop()
        asyncio.set_event_loop(self._loop)
        try:
            self._page = CloudPage(paths, arguments)
            self._page.server.controller.on_server_ready.add(lambda **_: self._ready.set())
            self._loop.run_until_complete(self._serve())
        except BaseException as problem:  # it is raised where the view was asked for
            self._problem = problem
            self._ready.set()
        finally:
            self._loop.close()

    async def _serve(self):
        try:
            await self._page.server.start(
                port=0, thread=True, exec_mode="coroutine", open_browser=False,
                disable_logging=True, show_connection_info=False, timeout=0)
        finally:
            await self._page.view.close()

    @property
    def url(self):
        """The page's address, as this machine sees it."""
        return f"http://localhost:{self._page.server.port}/index.html?{self._page.query}"

    def _repr_html_(self):
        layout = self._page.layout
        layout.iframe_style = f"border: none; width: 100%; height: {self._height}px;"
        frame = layout.iframe_builder(layout)
        frame["src"] += f"&{self._page.query}"
        attributes = " ".join(f'{name}="{html_text.escape(str(value))}"'
                              for name, value in frame.items())
        return f"<iframe {attributes}></iframe>"

    def close(self):
        """End the server; the cell shows its last picture no more."""
        if self._thread.is_alive():
            future = asyncio.run_coroutine_threadsafe(self._page.server.stop(), self._loop)
            future.result(START_SECONDS)
            self._thread.join(START_SECONDS)
