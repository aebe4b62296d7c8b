"""How much of a server's time strangers get: whoever has not its secret waits for a turn."""

import asyncio
import socket
import time

TURNS_A_SECOND = 50.0
TURNS_AT_ONCE = 100.0  # a page and what it is made of takes about twenty
NO_FILES_SECONDS = 1.0  # where the process may open no more files


class Gate:
    """Connections and strangers' requests, in turns of one rate together.

    While all turns are taken no connection is accepted: whoever floods the server waits in the
    kernel and takes none of its time, and clients that are there already are not slowed down. New
    ones wait with the others. Threads: the event loop's.
    """

    def __init__(self, clock=time.monotonic):
        self._clock = clock
        self._turns = TURNS_AT_ONCE
        self._at = clock()
        self._opening = set()

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
            task = loop.create_task(loop.connect_accepted_socket(factory, line))
            self._opening.add(task)
            task.add_done_callback(self._opened)
            wait = self._take()
        if wait > 0.0:
            loop.remove_reader(listener)
            loop.call_later(wait, self._listen, listener, factory)

    def _opened(self, task):
        self._opening.discard(task)
        task.cancelled() or task.exception()  # who went at once has no line
