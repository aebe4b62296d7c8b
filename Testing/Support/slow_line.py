"""A line between a program and a server: a round trip, a bandwidth and a limit of connections.

usage: slow_line.py PORT [--round-trip MS] [--megabits N] [--connections N]

Prints the port that it listens on; ends when its standard input ends. Any TCP server may be behind
it. A connection costs one round trip before its first byte, as TCP's own does; the bandwidth is
that of all connections together; more connections than the limit are closed at once.
"""

import argparse
import asyncio
import sys
import threading

PIECE = 16384


class SlowLine:
    """The line, in a thread of its own: `with SlowLine(port, 0.05, 100e6) as line: line.port`."""

    def __init__(self, target, round_trip=0.05, bits_per_second=0.0, connections=0):
        self.target = target
        self.round_trip = round_trip
        self.seconds_per_byte = 8.0 / bits_per_second if bits_per_second else 0.0
        self.connections = connections
        self.opened = 0  # connections so far
        self.refused = 0
        self.bytes_down = 0
        self.port = 0
        self._open = 0
        self._free_at = 0.0  # when the line down has sent what it holds
        self._tasks = set()
        self._loop = asyncio.new_event_loop()
        self._ready = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)

    def __enter__(self):
        self._thread.start()
        self._ready.wait()
        return self

    def __exit__(self, *_):
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()

    def _run(self):
        asyncio.set_event_loop(self._loop)
        server = self._loop.run_until_complete(
            asyncio.start_server(self._serve, "127.0.0.1", 0, limit=PIECE))
        self.port = server.sockets[0].getsockname()[1]
        self._ready.set()
        self._loop.run_forever()
        server.close()
        for task in asyncio.all_tasks(self._loop):
            task.cancel()
        for _ in range(3):  # tasks end, then their transports
            self._loop.run_until_complete(asyncio.sleep(0))
        self._loop.close()

    async def _serve(self, client_in, client_out):
        if self.connections and self._open >= self.connections:
            self.refused += 1
            client_out.transport.abort()
            return
        self._open += 1
        self.opened += 1
        server_out = None
        try:
            await asyncio.sleep(self.round_trip)
            server_in, server_out = await asyncio.open_connection("127.0.0.1", self.target)
            await asyncio.gather(self._carry(client_in, server_out, False),
                                 self._carry(server_in, client_out, True))
        except OSError:
            client_out.transport.abort()
        finally:
            self._open -= 1
            client_out.transport.abort()
            if server_out:
                server_out.transport.abort()

    async def _carry(self, source, target, down):
        """Bytes leave half a round trip after they came, as fast as the line is."""
        queue = asyncio.Queue(maxsize=64)
        sender = asyncio.ensure_future(self._send(queue, target))
        self._tasks.add(sender)
        sender.add_done_callback(self._tasks.discard)
        clock = self._loop.time
        try:
            while piece := await source.read(PIECE):
                due = clock()
                if down:
                    self._free_at = max(due, self._free_at) + len(piece) * self.seconds_per_byte
                    due = self._free_at
                    self.bytes_down += len(piece)
                await queue.put((due + self.round_trip / 2, piece))
        except OSError:
            pass
        await queue.put((clock() + self.round_trip / 2, b""))
        await sender

    async def _send(self, queue, target):
        gone = False
        while True:
            due, piece = await queue.get()
            await asyncio.sleep(max(0.0, due - self._loop.time()))
            try:
                if not piece:
                    target.close()
                    return
                if not gone:
                    target.write(piece)
                    await target.drain()
            except OSError:
                gone = True  # all that comes after it is taken and dropped


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("port", type=int)
    parser.add_argument("--round-trip", type=float, default=50.0, metavar="MS")
    parser.add_argument("--megabits", type=float, default=100.0)
    parser.add_argument("--connections", type=int, default=0)
    options = parser.parse_args()
    with SlowLine(options.port, options.round_trip / 1000, options.megabits * 1e6,
                  options.connections) as line:
        print(line.port, flush=True)
        sys.stdin.read()


if __name__ == "__main__":
    main()
