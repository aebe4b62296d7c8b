"""A page with a view of stored clouds: drawn here, shown in a browser or in a notebook."""

import asyncio
import html as html_text
import itertools
import json
import secrets
import threading
import urllib.parse

from ._errors import PointFrontError
from ._pictures import run_tool

try:
    from aiohttp import web  # trame's server
    from trame.app import get_server
    from trame.ui.html import DivLayout
    from trame.widgets import html, rca
    from trame_rca.view_adapter import RcaViewAdapter

    from ._remote import VIEWS, RemoteView
except ImportError as missing:
    raise PointFrontError(
        f"a page needs Python's packages trame, trame-rca and pillow: pip install trame trame-rca "
        f"pillow ({missing})") from None

TECHNIQUES = ("splats", "points", "spheres", "ewa")
START_SECONDS = 30.0  # for a server of a notebook

_BAR = ("position:absolute; left:8px; top:8px; display:flex; gap:6px; align-items:center; "
        "font:13px sans-serif; color:#ddd;")
_STATUS = ("position:absolute; left:8px; bottom:8px; font:12px sans-serif; color:#aaa; "
           "pointer-events:none;")
_WHOLE = ("position:absolute; inset:0; overflow:hidden; background:#17191f;")
_count = itertools.count(1)


def colours_of(path):
    """What the first store can be coloured by."""
    names = [a["name"] for a in json.loads(run_tool(["info", "--json", path]))["attributes"]]
    computed = ["elevation"] + (["horizontality"] if "normal" in names else [])
    return names + [name for name in computed if name not in names]


def _status(facts):
    if "problem" in facts:
        return facts["problem"]
    if facts["moving"]:
        return "…"
    text = f"{facts['points']:,} points, error {facts['error_px']:.1f} px"
    if facts["failed_nodes"]:
        text += f", {facts['failed_nodes']} nodes could not be read"
    return text if facts["settled"] else text + " …"


class _Doors:
    """Who may reach the view: those who have the server's secret, from the server's own pages.

    secret  of this server alone, a part of the address that is told. trame's page takes it out of
            the address and opens its socket with it; a cookie keeps it for a page that is loaded
            anew. The page's code, which is trame's, and nothing else is there without it.
    """

    def __init__(self, server):
        self.secret = "s" + secrets.token_hex(16)  # digits alone would be a number to the page
        self._server = server

    @property
    def query(self):
        return f"secret={self.secret}"

    def bind(self, wslink_server):
        """Before the server listens."""
        self._server.protocol.updateSecret(self.secret)
        app = wslink_server.app
        app.router.add_post("/paraview/", self._answer_launcher)
        app.middlewares.append(self._middleware())

    def _cookie(self):
        return f"pointfront-{self._server.port}"  # browsers have the cookies of all ports in one

    def _knows(self, given):
        return given is not None and secrets.compare_digest(given.encode(), self.secret.encode())

    async def _answer_launcher(self, request):
        """trame's page asks for a launcher of servers before it takes the one that it came from,
        and the browser logs an error where there is none: tell it where that is.
        """
        page = urllib.parse.urlsplit(request.headers.get("Referer", "")).path
        if page.count("/") > 1:  # a proxy is between: the page finds the way by its own address
            raise web.HTTPNotFound()
        answer = {"sessionURL": "ws://USE_HOST/ws"}
        if self._knows(request.cookies.get(self._cookie())):
            answer["secret"] = self.secret
        return web.json_response(answer)

    def _middleware(self):
        @web.middleware
        async def check(request, handler):
            _refuse_foreign_pages(request)
            if request.path not in ("/", "/index.html"):
                return await handler(request)
            invited = self._knows(request.query.get("secret"))
            if not invited and not self._knows(request.cookies.get(self._cookie())):
                raise web.HTTPForbidden(text="this view opens by the whole address that "
                                             "`pointfront serve` printed, with its secret")
            answer = await handler(request)
            if invited:
                answer.set_cookie(self._cookie(), self.secret, httponly=True, samesite="Strict")
            return answer

        return check


def _refuse_foreign_pages(request):
    """A browser connects any page to any server of its machine, and says which page asks. Only
    pages of this server, or of a proxy that says whom it stands for, reach the view.
    """
    origin = request.headers.get("Origin")
    hosts = {request.headers.get("Host"), request.headers.get("X-Forwarded-Host")}
    if origin is not None and urllib.parse.urlsplit(origin).netloc not in hosts:
        raise web.HTTPForbidden(text="a page of another server asks for this view")


class CloudPage:
    """A trame server with one view; all who open it see and move the same.

    paths      stores, drawn together
    arguments  {option of `pointfront render`: value or True}: {"color-by": "intensity"}
    """

    def __init__(self, paths, arguments=None):
        self._options = dict(arguments or {})
        if "style" not in self._options and "quality" not in self._options:  # they choose their own
            self._options.setdefault("technique", TECHNIQUES[0])
        self.view = RemoteView(paths, self._arguments(), self._tell)
        self.server = get_server(f"pointfront-{next(_count)}", client_type="vue3")
        self._doors = _Doors(self.server)
        state = self.server.state
        state.trame__title = "PointFront"
        state.colour = self._options.get("color-by", "")
        state.technique = self._options.get("technique", "")
        state.status = ""
        state.frames = 0
        state.settled = False
        self._build(colours_of(paths[0]))
        state.change("colour", "technique")(self._choose)

    def _build(self, colours):
        with DivLayout(self.server, style=_WHOLE) as self.layout:
            area = rca.RemoteControlledArea(
                display="image", event_throttle_ms=16, resize_throttle_ms=100,
                style="position:absolute; inset:0;",
                image_style=("{width: '100%', height: '100%', display: 'block'}",))
            adapter = RcaViewAdapter(self.view, area.name, scheduler=self.view,
                                     do_schedule_render_on_interaction=True)
            area.add_view_handler(adapter)
            with html.Div(style=_BAR):
                with html.Select(v_model=("colour",), title="colour"):
                    html.Option("colour", value="")
                    for name in colours:
                        html.Option(name, value=name)
                with html.Select(v_model=("technique",), title="technique"):
                    html.Option("technique", value="")
                    for name in TECHNIQUES:
                        html.Option(name, value=name)
                for name in VIEWS:
                    html.Button(name, click=(self.view.look, f"['{name}']"))
            html.Div("{{ status }}", style=_STATUS, classes="pointfront-status",
                     raw_attrs=[':data-frames="frames"', ':data-settled="settled"'])
        controller = self.server.controller
        controller.on_server_ready.add(lambda **_: self._watch_network(adapter))
        controller.on_server_bind.add(self._doors.bind)

    @property
    def query(self):
        """What an address of this page ends with, behind '?'."""
        return self._doors.query

    def _watch_network(self, adapter):
        if adapter.streamer is not None:
            monitor = adapter.streamer.coreServer.network_monitor
            self.view.watch_network(lambda: monitor.pending)

    def _arguments(self):
        words = []
        for name, value in self._options.items():
            if value is True:
                words.append(f"--{name}")
            elif value not in (None, False, ""):
                words += [f"--{name}", value]
        return words

    def _choose(self, colour, technique, **_):
        chosen = {**self._options, "color-by": colour, "technique": technique}
        if any(chosen[name] != self._options.get(name, "") for name in chosen):
            self._options = chosen
            self.view.draw_with(self._arguments())

    def _tell(self, facts):
        with self.server.state as state:
            state.status = _status(facts)
            state.settled = bool(facts.get("settled"))
            state.frames += 1

    def serve(self, **start):
        """Blocks until it is interrupted; `start` as trame's Server.start."""
        try:
            self.server.start(thread=True, open_browser=False, disable_logging=True,
                              show_connection_info=False, timeout=0, **start)
        finally:
            self.view.end()


class NotebookView:
    """A view in a notebook's cell, of a server on a thread of its own. close() ends it.

    Where the browser is not on this machine, trame's TRAME_IFRAME_BUILDER says by which way it
    reaches the server (JupyterHub is recognised).
    """

    def __init__(self, paths, arguments=None, height=600):
        self._ready = threading.Event()
        self._height = height
        self._loop = None
        self._page = None
        self._problem = None
        self._thread = threading.Thread(target=self._run, args=(paths, arguments), daemon=True)
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
        """Of the page, as this machine sees it."""
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
