"""Messages between the server of a page and those who look: bounded, one line for each."""

import asyncio
import collections
import logging

import msgpack
from aiohttp.http import HttpProcessingError
from wslink.chunking import HEADER_LENGTH, UnChunker, generate_chunks

FRAMES = "publish:trame.rca.topic.stream:"  # how the ids of frames begin
LARGEST_MESSAGE = 1 << 16  # bytes, of a client: events of a mouse, a choice
MESSAGES_IN_PARTS = 4  # from a client, at a time
LARGEST_BACKLOG = 1 << 22  # bytes for a client that does not take them, frames besides
PATIENCE_SECONDS = 20.0  # with one that takes nothing
PART = 1 << 20  # bytes of what is sent at a time

# All that a page asks for. Not among them: what ends the server, or sends frames to others.
ANSWERED = ("trame.state.get", "trame.state.update", "trame.trigger", "trame.lifecycle.update",
            "trame.error.client", "trame.rca.size", "trame.rca.event", "trame.rca.reset",
            "trame.rca.video.codecs", "trame.rca.video.negotiate", "unsubscribe")


class Parts(UnChunker):
    """Messages of a client, put together of their parts, in bounded memory."""

    def set_max_message_size(self, size):
        super().set_max_message_size(min(size, LARGEST_MESSAGE))

    def process_chunk(self, chunk):
        if len(chunk) < HEADER_LENGTH or len(self.pending_messages) > MESSAGES_IN_PARTS:
            raise ValueError("a part of a message without its head, or too many messages at a time")
        return super().process_chunk(chunk)


class Line:
    """To one client: messages in their order, and of frames the newest.

    A client that reads slowly gets fewer frames, one that does not read is let go; neither holds up
    others. Threads: the event loop's.
    """

    def __init__(self, socket, transport):
        self._socket = socket
        self._transport = transport
        self._messages = collections.deque()
        self._bytes = 0
        self._frame = None
        self._sending = False
        self._news = asyncio.Event()
        self._task = asyncio.get_running_loop().create_task(self._run())

    def put(self, message, is_frame):
        if is_frame:
            self._frame = message
        else:
            self._messages.append(message)
            self._bytes += len(message)
        if self._bytes > LARGEST_BACKLOG:
            self._cut()
        self._news.set()

    @property
    def waiting(self):
        """Frames that the client has not: that which is on its way, and that behind it."""
        return int(self._sending) + int(self._frame is not None)

    def close(self):
        self._task.cancel()

    def _cut(self):
        """At once: a client that reads nothing reads no farewell."""
        self._messages.clear()
        self._frame = None
        if self._transport is not None:
            self._transport.abort()

    def _next(self):
        if self._messages:
            message = self._messages.popleft()
            self._bytes -= len(message)
            return message
        frame, self._frame = self._frame, None
        return frame

    async def _run(self):
        try:
            while True:
                await self._news.wait()
                self._news.clear()
                while (message := self._next()) is not None:
                    self._sending = True
                    for part in generate_chunks(message, PART):
                        await asyncio.wait_for(self._socket.send_bytes(part), PATIENCE_SECONDS)
                    self._sending = False
        except (asyncio.TimeoutError, ConnectionError, RuntimeError):  # it is gone, or as good as
            self._cut()
        finally:
            self._sending = False


class Lines:
    """Stands between wslink's handler of sockets and its clients.

    accepted(key)  whether clients may change that part of the page's state
    left           called with the name of a client that has gone
    """

    def __init__(self, accepted, left):
        self._accepted = accepted
        self._left = left
        self._lines = {}
        self._handler = None
        self._server = None

    def bind(self, wslink_server):
        """Before the server listens."""
        quieten()
        self._server = wslink_server
        handler = self._handler = wslink_server._ws_handlers[0]
        self._onConnect, self._onClose = handler.onConnect, handler.onClose
        self._onMessage = handler.onMessage
        handler.onConnect, handler.onClose = self._begin, self._end
        handler.onMessage = self._take
        handler.sendWrappedMessage = self._send
        handler.sendWrappedError = self._send_error
        handler.functionMap = {name: found for name, found in handler.functionMap.items()
                               if name in ANSWERED}
        protocol, update = handler.functionMap["trame.state.update"]
        handler.functionMap["trame.state.update"] = (
            protocol, lambda to, changes: update(to, self._of_known(changes)))

    @property
    def client(self):
        """Whose message is being answered."""
        return self._server.last_active_client_id if self._server is not None else None

    def waiting(self):
        """Frames that the quickest client has not."""
        return min((line.waiting for name, line in self._lines.items()
                    if self._handler.isClientAuthenticated(name)), default=0)

    def _of_known(self, changes):
        return [change for change in changes if self._accepted(change.get("key"))]

    async def _begin(self, request, client):
        await self._onConnect(request, client)
        self._handler.unchunkers[client] = Parts()
        self._lines[client] = Line(self._handler.connections[client], request.transport)

    async def _end(self, client):
        line = self._lines.pop(client, None)
        if line is not None:
            line.close()
        if client in self._handler.unchunkers:
            await self._onClose(client)
        self._left(client)

    async def _take(self, is_binary, message, client):
        try:
            if not is_binary:
                raise ValueError("a text")
            await self._onMessage(is_binary, message, client)
        except Exception as problem:  # its message is at fault: the end of its line tells it
            logging.getLogger("pointfront").info("a client sent what is no message: %r", problem)
            await self._handler.connections[client].close(code=1007)

    async def _send(self, call, content, method="", client_id=None, skip_last_active_client=False):
        try:
            message = msgpack.packb({"wslink": "1.0", "id": call, "result": content})
        except (TypeError, ValueError, OverflowError):
            await self._send_error(call, -32002, "Method result cannot be serialized", method,
                                   client_id=client_id)
            return
        skipped = self._server.last_active_client_id if skip_last_active_client else None
        for name in [client_id] if client_id else list(self._lines):
            if name != skipped and self._handler.isClientAuthenticated(name):
                self._put(name, message, call.startswith(FRAMES))
        self._handler.network_monitor.network_call_completed()

    async def _send_error(self, call, code, text, data=None, client_id=None):
        error = {"code": code, "message": text}
        if isinstance(data, str):
            error["data"] = data
        message = msgpack.packb({"wslink": "1.0", "id": call, "error": error})
        for name in [client_id] if client_id else list(self._lines):
            self._put(name, message, False)

    def _put(self, name, message, is_frame):
        if name in self._lines:
            self._lines[name].put(message, is_frame)


class Escaped(logging.Filter):
    """Clients' words are logged as Python writes strings: they move no cursor of a terminal."""

    def filter(self, record):
        text = record.getMessage()
        if not text.isprintable():
            record.msg, record.args = ascii(text)[1:-1], None
        return True


def _is_of_this_server(record):
    """Not of a request that is none: anybody sends that, and its answer says what is wrong."""
    return not (record.exc_info and isinstance(record.exc_info[1], HttpProcessingError))


def quieten():
    """Escapes the logs of the libraries below, and has no faults of strangers in them."""
    logging.getLogger("aiohttp.server").addFilter(_is_of_this_server)  # again is once
    for name in ("wslink", "wslink.protocol", "wslink.backends.aiohttp", "wslink.websocket",
                 "aiohttp.access", "aiohttp.server", "aiohttp.web", "trame_server.protocol",
                 "pointfront"):
        logger = logging.getLogger(name)
        if not any(isinstance(f, Escaped) for f in logger.filters):
            logger.addFilter(Escaped())
