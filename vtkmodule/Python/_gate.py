"""How much of a server's time strangers get: whoever has not its secret waits for a turn."""

import asyncio
import resource
import socket
import time

TURNS_A_SECOND = 50.0
TURNS_AT_ONCE = 100.0  # a page and what it is made of takes about twenty
NO_FILES_SECONDS = 1.0  # where the process may open no more files
SILENT_SECONDS = 10.0  # from a connection to the end of its first request's head
STRANGERS = 512  # connections at a time: as many as say their head late, and come at that rate


def most_strangers():
    """Connections that strangers may have at a time: half of the process's files at most."""
    files, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
    return STRANGERS if files == resource.RLIM_INFINITY else min(STRANGERS, files // 2)


class Gate:
    """Connections and strangers' requests, in turns of one rate together.

    While all turns are taken no connection is accepted: whoever floods the server waits in the
    kernel and takes none of its time, and clients that are there already are not slowed down. New
    ones wait with the others. A connection that brings no whole head of a request is ended, and so
    is the oldest stranger's where there are too many: files are left for those with the secret.
    Threads: the event loop's.
    """

    def __init__(self, clock=time.monotonic):
        self._clock = clock
        self._turns = TURNS_AT_ONCE
        self._at = clock()
        self._opening = set()
        self._strangers = {}  # connections, in their order; what ends them if they stay silent
        self._most = most_strangers()

    def open(self, wslink_server):
        """Accepts connections in the server's place; when it listens."""
        factory = wslink_server.runner.server
        for one in wslink_server.site._server.sockets:  # aiohttp names them nowhere else
            asyncio.get_running_loop().remove_reader(one.fileno())
            listener = socket.socket(fileno=one.dup().detach())
            listener.setblocking(False)
            self._listen(listener, factory)

    async def turn(self):
        """Waits until a stranger's request has its turn."""
        wait = self._take()
        if wait > 0.0:
            await asyncio.sleep(wait)

    def heard(self, transport, invited):
        """A connection has brought the whole head of a request; `invited`: with the secret."""
        if transport in self._strangers:
            self._strangers[transport].cancel()
            if invited:
                del self._strangers[transport]

    def _take(self):
        """One turn; how many seconds it is until that comes."""
        now = self._clock()
        self._turns = min(TURNS_AT_ONCE, self._turns + (now - self._at) * TURNS_A_SECOND) - 1.0
        self._at = now
        return max(0.0, -self._turns / TURNS_A_SECOND)

    def _listen(self, listener, factory):
        asyncio.get_running_loop().add_reader(listener, self._accept, listener, factory)

    def _accept(self, listener, factory):
        loop = asyncio.get_running_loop()
        wait = 0.0
        try:
            line, _ = listener.accept()
        except (BlockingIOError, ConnectionAbortedError):
            return
        except OSError:
            wait = NO_FILES_SECONDS
        else:
            line.setblocking(False)
            task = loop.create_task(self._begin(factory, line))
            self._opening.add(task)
            task.add_done_callback(self._opened)
            wait = self._take()
        if wait > 0.0:
            loop.remove_reader(listener)
            loop.call_later(wait, self._listen, listener, factory)

    async def _begin(self, factory, line):
        loop = asyncio.get_running_loop()
        transport, _ = await loop.connect_accepted_socket(factory, line)
        if len(self._strangers) >= self._most:
            self._strangers = {one: silence for one, silence in self._strangers.items()
                               if not one.is_closing()}
        if len(self._strangers) >= self._most:
            self._end(next(iter(self._strangers)))
        self._strangers[transport] = loop.call_later(SILENT_SECONDS, self._end, transport)

    def _end(self, transport):
        silence = self._strangers.pop(transport, None)
        if silence is not None:
            silence.cancel()
            transport.abort()

    def _opened(self, task):
        self._opening.discard(task)
        task.cancelled() or task.exception()  # who went at once has no line
