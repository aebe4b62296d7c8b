"""Which connections the gate of a page's server keeps, and how long: real sockets, no page."""

import asyncio
import socket
import types
import unittest
from unittest import mock

from pointfront import _gate


class Speaker(asyncio.Protocol):
    """A server's side of one connection. Its gate hears of each whole head; "secret" invites."""

    def __init__(self, gate, lost):
        self._gate = gate
        self._lost = lost
        self._head = b""

    def connection_made(self, transport):
        self._transport = transport

    def data_received(self, data):
        self._head += data
        if b"\r\n\r\n" in self._head:
            self._gate.heard(self._transport, b"secret" in self._head)
            self._transport.write(b"heard")

    def connection_lost(self, _):
        self._lost.release()


class Connections(unittest.IsolatedAsyncioTestCase):
    async def open(self):
        self.gate = _gate.Gate()
        self.lost = asyncio.Semaphore(0)
        self.listener = socket.create_server(("localhost", 0))
        self.addCleanup(self.listener.close)
        self.listener.setblocking(False)
        asyncio.get_running_loop().add_reader(self.listener, int)  # as the server, which gives way
        self.gate.open(types.SimpleNamespace(
            runner=types.SimpleNamespace(server=lambda: Speaker(self.gate, self.lost)),
            site=types.SimpleNamespace(_server=types.SimpleNamespace(sockets=[self.listener]))))

    async def connect(self, said=b""):
        reader, writer = await asyncio.open_connection(*self.listener.getsockname())
        self.addCleanup(writer.close)
        writer.write(said)
        if said.endswith(b"\r\n\r\n"):
            self.assertEqual(await reader.read(5), b"heard")
        return reader

    @staticmethod
    async def ended(reader, seconds):
        """Whether the server ends a connection within that time."""
        try:
            return await asyncio.wait_for(reader.read(), seconds) == b""
        except ConnectionError:
            return True
        except asyncio.TimeoutError:
            return False

    async def test_who_says_no_whole_head_is_ended(self):
        with mock.patch.object(_gate, "SILENT_SECONDS", 1.0):
            await self.open()
            heard = await self.connect(b"GET / HTTP/1.1\r\n\r\n")
            silent, half = await self.connect(), await self.connect(b"GET / HTTP/1.1\r\n")
            self.assertFalse(await self.ended(silent, 0.1))
            self.assertTrue(await self.ended(silent, 5.0))
            self.assertTrue(await self.ended(half, 5.0))
            self.assertFalse(await self.ended(heard, 0.1))  # the first of the three

    async def test_of_strangers_the_oldest_makes_way(self):
        """Those who have the secret stay, and those who left by themselves do not count."""
        with mock.patch.object(_gate, "most_strangers", lambda: 3):
            await self.open()
            viewer = await self.connect(b"secret\r\n\r\n")
            strangers = [await self.connect(b"\r\n\r\n") for _ in range(2)]
            for _ in range(5):
                reader, writer = await asyncio.open_connection(*self.listener.getsockname())
                writer.write(b"\r\n\r\n")
                await reader.read(5)
                writer.close()
                await asyncio.wait_for(self.lost.acquire(), 5.0)
            for stranger in strangers:
                self.assertFalse(await self.ended(stranger, 0.05))
            strangers += [await self.connect(b"\r\n\r\n") for _ in range(2)]
            self.assertTrue(await self.ended(strangers[0], 5.0))
            for one in [viewer, *strangers[1:]]:
                self.assertFalse(await self.ended(one, 0.05))

    def test_strangers_leave_half_of_the_files(self):
        for soft, most in ((64, 32), (1024, 512), (20000, 512), (-1, 512)):
            with mock.patch.object(_gate.resource, "getrlimit", lambda _, soft=soft: (soft, -1)):
                self.assertEqual(_gate.most_strangers(), most)


if __name__ == "__main__":
    unittest.main(verbosity=2)
