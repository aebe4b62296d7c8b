"""Who may reach a page: those who have its server's secret, from the server's own pages."""

import pathlib
import secrets
import urllib.parse

from ._errors import PointFrontError
from ._gate import Gate

try:
    from aiohttp import web  # trame's server
except ImportError as missing:
    raise PointFrontError(f"a page needs Python's package trame ({missing})") from None

# trame's page opens its socket by an address without the secret, and a cookie does not come from
# a frame in a page of another site, as a notebook's is. Nor does trame's page open it again.
_KEY_OF_SOCKETS = """<script>
(() => {
  const home = window.location.href;
  const secret = new URLSearchParams(window.location.search).get("secret");
  const Plain = window.WebSocket;
  let leaving = false;
  let notice = null;
  window.addEventListener("pagehide", () => { leaving = true; });
  const say = (text) => {
    if (notice === null) {
      notice = document.createElement("div");
      notice.className = "pointfront-notice";
      notice.style.cssText = "position:fixed; inset:0; z-index:10; display:flex; " +
        "align-items:center; justify-content:center; background:#17191fc0; color:#eee; " +
        "font:16px sans-serif;";
      document.body.appendChild(notice);
    }
    notice.textContent = text;
  };
  const tryAgain = async () => {
    try {
      const answer = await fetch(home, { cache: "no-store" });
      if (answer.ok) {
        window.location.replace(home);
        return;
      }
      say("This view has ended. A server that runs anew prints another address.");
    } catch (absent) {
      window.setTimeout(tryAgain, 1000);
    }
  };
  window.WebSocket = class extends Plain {
    constructor(url, protocols) {
      const whole = new URL(url, home);
      if (secret !== null) {
        whole.searchParams.set("secret", secret);
      }
      super(whole.href, protocols);
      this.addEventListener("close", () => {
        if (!leaving && notice === null) {
          say("The connection to the server is lost; trying again ...");
          window.setTimeout(tryAgain, 500);
        }
      });
    }
  };
})();
</script>
"""


class Doors:
    """The secret of one server, asked for before anything of the view is given or listened to.

    secret  of this server alone, a part of the address that is told. trame's page takes it out of
            the address and opens its socket with it; a cookie keeps it for a page that is loaded
            anew. The page's code, which is trame's, and nothing else is there without it: a socket
            is refused before it is one. Requests without it wait for their turn (Gate).
    """

    def __init__(self, server):
        self.secret = "s" + secrets.token_hex(16)  # digits alone would be a number to the page
        self._server = server
        self._page = None
        self._gate = Gate()
        self._listener = None

    @property
    def query(self):
        return f"secret={self.secret}"

    def bind(self, wslink_server):
        """Before the server listens."""
        self._server.protocol.updateSecret(self.secret)
        self._page = pathlib.Path(wslink_server.config["static"]["/"]) / "index.html"
        self._listener = wslink_server
        app = wslink_server.app
        app.router.add_post("/paraview/", self._answer_launcher)
        app.middlewares.append(self._middleware())

    def open(self, **_):
        """When the server listens."""
        self._gate.open(self._listener)

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
            invited = self._knows(request.query.get("secret"))
            known = invited or self._knows(request.cookies.get(self._cookie()))
            self._gate.heard(request.transport, known)
            if not known:
                await self._gate.turn()
            _refuse_foreign_pages(request)
            socket = "Upgrade" in request.headers or request.path == "/ws"
            if not socket and request.path not in ("/", "/index.html"):
                return await handler(request)
            if not known:
                _refuse("this view opens by the whole address that `pointfront serve` printed, "
                        "with its secret")
            if socket:
                return await handler(request)
            return self._give_page(request, invited) or await handler(request)

        return check

    def _give_page(self, request, invited):
        if request.path != "/index.html":
            return None  # "/" leads there
        text = self._page.read_text(encoding="utf-8").replace(
            "<script", _KEY_OF_SOCKETS + "<script", 1)
        answer = web.Response(text=text, content_type="text/html")
        if invited:
            answer.set_cookie(self._cookie(), self.secret, httponly=True, samesite="Strict")
        return answer


def _refuse(why):
    refusal = web.HTTPForbidden(text=why)
    refusal.force_close()  # who asks again begins again
    raise refusal


def _refuse_foreign_pages(request):
    """A browser connects any page to any server of its machine, and says which page asks. Only
    pages of this server, or of a proxy that says whom it stands for, reach the view.
    """
    origin = request.headers.get("Origin")
    hosts = {request.headers.get("Host"), request.headers.get("X-Forwarded-Host")}
    if origin is not None and urllib.parse.urlsplit(origin).netloc not in hosts:
        _refuse("a page of another server asks for this view")
