"""Who has not the secret of a page reaches nothing; who has it harms nobody: real sockets, and a
browser that looks on. Environment: as test_page.py.
"""

import asyncio
import concurrent.futures
import json
import os
import pathlib
import re
import socket
import struct
import subprocess
import sys
import threading
import time
import unittest
import urllib.error
import urllib.parse
import urllib.request

import aiohttp
import msgpack
from page_trial import InBrowser, Server
from wslink.chunking import UnChunker, generate_chunks

STRANGER = "elsewhere.example"
MESSAGES_IN_A_TRY = 400
TURNS_A_SECOND, TURNS_AT_ONCE = 50, 100  # as the page's Gate says; a refusal takes two
CONNECTIONS_OF_STRANGERS = 512


def status_of(url):
    try:
        with urllib.request.urlopen(url) as answer:
            return answer.status
    except urllib.error.HTTPError as refused:
        return refused.code


def in_loop(work):
    with concurrent.futures.ThreadPoolExecutor(1) as thread:  # playwright has this one's event loop
        return thread.submit(asyncio.run, work).result()


async def ask(socket, call, method, arguments):
    """Returns what a server's socket answers to a call."""
    message = msgpack.packb({"wslink": "1.0", "id": call, "method": method, "args": arguments,
                             "kwargs": {}})
    for chunk in generate_chunks(message, 0):
        await socket.send_bytes(chunk)
    parts = UnChunker()
    parts.set_max_message_size(1 << 24)
    while True:
        answer = parts.process_chunk((await socket.receive(20)).data)
        if answer is not None and answer["id"] == call:
            return answer


async def greet(address, secret):
    """Returns what a server answers to a greeting, and to a question for the whole state."""
    async with aiohttp.ClientSession() as session:
        async with session.ws_connect(address) as socket:
            return [await ask(socket, "system:c0:0", "wslink.hello", [{"secret": secret}]),
                    await ask(socket, "rpc:c0:1", "trame.state.get", [])]


async def status_of_socket(address):
    async with aiohttp.ClientSession() as session:
        try:
            async with session.ws_connect(address):
                return 101
        except aiohttp.WSServerHandshakeError as refused:
            return refused.status


def bogus_messages(host, port, count):
    """Messages of a socket to a server that gave none, as many as a packet or two have in each try
    to get one; what came back besides refusals.
    """
    greeting = (f"GET /ws HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\n"
                "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n").encode()
    message = bytes([0x81, 0x80 + 8]) + bytes(4) + b"\x1b[2Jtext"  # a text, unmasked by zeros
    strange = []
    for begin in range(0, count, MESSAGES_IN_A_TRY):
        with socket.create_connection((host, port)) as line:
            try:
                line.sendall(greeting + message * min(MESSAGES_IN_A_TRY, count - begin))
                answer = line.recv(1 << 16)
            except ConnectionError:
                continue
        if answer and not answer.startswith(b"HTTP/1.1 403"):
            strange.append(answer)
    return strange


def tries(host, port, seconds, together=16):
    """How many tries to get a socket, in so many threads, were answered."""
    end = time.monotonic() + seconds
    answered = [0] * together

    def go(place):
        while time.monotonic() < end:
            try:
                with socket.create_connection((host, port), 1.0) as line:
                    line.sendall(f"GET /ws HTTP/1.1\r\nHost: {host}:{port}\r\n\r\n".encode())
                    answered[place] += bool(line.recv(1 << 16))
            except OSError:
                pass  # it waits for a turn

    threads = [threading.Thread(target=go, args=(place,)) for place in range(together)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return sum(answered)


async def say_nothing(host, port, count):
    """How many of so many connections, of which every other one says half a request's head, the
    server ended, and the seconds that it took for the last one. They come hardly slower than the
    server takes them: what its kernel drops from a full queue is told nothing.
    """
    begun = time.monotonic()

    async def stay(place):
        await asyncio.sleep(max(0, place - TURNS_AT_ONCE) / (0.9 * TURNS_A_SECOND))
        reader, writer = await asyncio.open_connection(host, port)
        if place % 2:
            writer.write(f"GET / HTTP/1.1\r\nHost: {host}:{port}\r\n".encode())
        try:
            await reader.read()
        except ConnectionError:
            pass
        writer.close()
        return time.monotonic() - begun

    staying = [asyncio.ensure_future(stay(place)) for place in range(count)]
    ended, others = await asyncio.wait(staying, timeout=90.0)
    for one in others:
        one.cancel()
    return len(ended), max((one.result() for one in ended), default=0.0)


def speak_slowly(url, seconds):
    """Returns what a server answers to an honest request whose head takes so long."""
    address = urllib.parse.urlsplit(url)
    head = (f"GET /index.html?{address.query} HTTP/1.1\r\nHost: {address.netloc}\r\n"
            "Connection: close\r\n\r\n").encode()
    with socket.create_connection((address.hostname, address.port), 20.0) as line:
        for part in range(0, len(head), 10):
            line.sendall(head[part:part + 10])
            time.sleep(seconds * 10 / len(head))
        with line.makefile("rb") as answer:
            return answer.read()


def files_of(process):
    """How many the process has open."""
    return len(os.listdir(f"/proc/{process.pid}/fd"))


def seconds_of(process):
    """Processor time that it has taken, its children not counted."""
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


async def until_closed(line):
    """The code that a server gives when it closes a socket."""
    while (message := await line.receive()).type not in (
            aiohttp.WSMsgType.CLOSE, aiohttp.WSMsgType.CLOSED, aiohttp.WSMsgType.ERROR):
        pass
    return line.close_code


def area_of(state):
    """The name of the area with the picture, out of the page's template."""
    return re.search(r'name=\\?"(\w+)\\?"', json.dumps(state["result"]["state"])).group(1)


class Deaf:
    """A client that greets and then takes nothing more of what is sent to it."""

    def __init__(self, address, secret):
        self._address = address
        self._secret = secret
        self._loop = asyncio.new_event_loop()
        self._greeted = threading.Event()
        self._end = None
        self._thread = threading.Thread(target=self._loop.run_until_complete, args=(self._stay(),))

    async def _stay(self):
        self._end = asyncio.Event()
        async with aiohttp.ClientSession() as session:
            line = await session.ws_connect(self._address)
            await ask(line, "system:c0:0", "wslink.hello", [{"secret": self._secret}])
            line._response.connection.transport.pause_reading()
            self._greeted.set()
            await self._end.wait()
            line._response.connection.transport.abort()

    def __enter__(self):
        self._thread.start()
        assert self._greeted.wait(20)
        return self

    def __exit__(self, *_):
        self._loop.call_soon_threadsafe(self._end.set)
        self._thread.join()
        self._loop.close()


class Strangers(InBrowser):
    def test_pages_of_others_are_refused(self):
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        own = server.url.split("/?")[0]
        for origin, status in ((f"http://{STRANGER}", 403), (own, 200)):
            request = urllib.request.Request(server.url, headers={"Origin": origin})
            try:
                with urllib.request.urlopen(request) as answer:
                    self.assertEqual(answer.status, status)
            except urllib.error.HTTPError as refused:
                self.assertEqual(refused.code, status)
        server.end()

    def test_who_has_not_the_secret_is_refused(self):
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        own, secret = server.url.split("/?secret=")
        self.assertGreater(len(secret), 30)
        other = Server(self.store, "--port", "0")
        self.addCleanup(other.process.kill)
        theirs = other.url.split("/?secret=")[1]
        other.end()
        self.assertNotEqual(secret, theirs)
        for query, status in ((f"?secret={secret}", 200), ("", 403), ("?secret=", 403),
                              ("?secret=wslink-secret", 403), (f"?secret={theirs}", 403),
                              ("?secret=%C3%A4", 403)):
            for page in ("/", "/index.html"):
                self.assertEqual(status_of(own + page + query), status, page + query)
        asked = urllib.request.Request(f"{own}/paraview/", data=b"{}")
        with urllib.request.urlopen(asked) as answer:
            self.assertNotIn("secret", json.loads(answer.read()))
        said = in_loop(greet(f"{own}/ws?secret={secret}", "wslink-secret"))  # the second door
        self.assertIn("Authentication failed", str(said[0]))
        self.assertTrue(all("error" in answer for answer in said), said)
        said = in_loop(greet(f"{own}/ws?secret={secret}", secret))
        self.assertTrue(all("result" in answer for answer in said))
        server.end()

    def test_a_socket_is_refused_without_the_secret(self):
        """Before it is one: 100,000 messages of somebody who has not the secret reach nothing, and
        a view turns meanwhile."""
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        page = self.open(server.url)
        own = server.url.split("/?secret=")[0]
        for query in ("", "?secret=", "?secret=wslink-secret"):
            self.assertEqual(in_loop(status_of_socket(f"{own}/ws{query}")), 403, query)
        address = urllib.parse.urlsplit(own)
        before = self.turned_frames(page, lambda seconds: seconds > 3)
        sender = subprocess.Popen(
            [sys.executable, "-c", "import sys, test_strangers as t; "
             "sys.exit(str(t.bogus_messages(sys.argv[1], int(sys.argv[2]), 100000)) != '[]')",
             address.hostname, str(address.port)], cwd=pathlib.Path(__file__).parent)
        during = self.turned_frames(page, lambda _: sender.poll() is not None)
        self.assertEqual(sender.wait(), 0)
        after = self.turned_frames(page, lambda seconds: seconds > 3)
        print("frames a second: %.1f, with strangers %.1f, then %.1f" % (before, during, after))
        self.assertGreater(during, 0.75 * min(before, after))
        turned = self.settle(page, lambda: page.click("text=top"))
        self.assertGreater(turned.std(), 20)
        self.assertEqual(self.errors, [])
        self.assertEqual(server.end(), 130)
        self.assertEqual(server.said, "")

    def test_requests_that_are_none_fill_no_log(self):
        """Each is answered, and the server's own log says nothing of it."""
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        address = urllib.parse.urlsplit(server.url)
        for said in (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\r\n\r\n", b"GET\r\n\r\n",
                     b"GET / HTTP/9\r\n\r\n", b"GET / HTTP/1.1\r\nno header\r\n\r\n",
                     b"GET / HTTP/1.1\r\nContent-Length: x\r\n\r\n",
                     b"GET /" + b"a" * 20000 + b" HTTP/1.1\r\n\r\n",
                     b"GET / HTTP/1.1\r\nA: " + b"a" * 20000 + b"\r\n\r\n"):
            with socket.create_connection((address.hostname, address.port), 20.0) as line:
                line.sendall(said)
                self.assertRegex(line.recv(1 << 16), rb"\AHTTP/1\.[01] 4", said[:40])
        self.assertEqual(status_of(server.url), 200)
        self.assertEqual(server.end(), 130)
        self.assertEqual(server.said, "")

    def test_strangers_have_a_small_share_of_the_server(self):
        """Sixteen at a time, who ask as fast as they can: they are answered at a rate, and whoever
        has the secret comes in meanwhile.
        """
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        address = urllib.parse.urlsplit(server.url)
        seconds = 8.0
        before = seconds_of(server.process)
        sender = subprocess.Popen(
            [sys.executable, "-c", "import sys, test_strangers as t; "
             "print(t.tries(sys.argv[1], int(sys.argv[2]), float(sys.argv[3])))",
             address.hostname, str(address.port), str(seconds)],
            cwd=pathlib.Path(__file__).parent, stdout=subprocess.PIPE, text=True)
        self.addCleanup(sender.kill)
        time.sleep(2)
        begun = time.monotonic()
        self.assertEqual(status_of(server.url), 200)
        waited = time.monotonic() - begun
        answered = int(sender.communicate()[0])
        share = (seconds_of(server.process) - before) / seconds
        print("%d strangers answered, %.3f of a core, %.1f s until a viewer came in"
              % (answered, share, waited))
        self.assertGreater(answered, 20)
        self.assertLessEqual(2 * answered, TURNS_AT_ONCE + TURNS_A_SECOND * (seconds + 2.0))
        self.assertLess(share, 0.1)
        self.assertLess(waited, 6.0)
        self.assertEqual(server.end(), 130)

    def test_silent_connections_end(self):
        """A thousand that say nothing, or half a request: the server ends each after some seconds
        and holds few at a time, a view turns meanwhile, and whoever speaks slowly comes in.
        """
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        page = self.open(server.url)
        address = urllib.parse.urlsplit(server.url)
        before = self.turned_frames(page, lambda seconds: seconds > 3)
        files = files_of(server.process)
        sender = subprocess.Popen(
            [sys.executable, "-c", "import asyncio, sys, test_strangers as t; "
             "print(*asyncio.run(t.say_nothing(sys.argv[1], int(sys.argv[2]), 1000)))",
             address.hostname, str(address.port)],
            cwd=pathlib.Path(__file__).parent, stdout=subprocess.PIPE, text=True)
        self.addCleanup(sender.kill)
        held = []

        def sent(_):
            held.append(files_of(server.process) - files)
            return sender.poll() is not None

        with concurrent.futures.ThreadPoolExecutor(1) as thread:
            slow = thread.submit(speak_slowly, server.url, 6.0)
            during = self.turned_frames(page, sent)
            self.assertIn(b" 200 ", slow.result()[:20])
        ended, last = sender.communicate()[0].split()
        after = self.turned_frames(page, lambda seconds: seconds > 3)
        print("frames a second: %.1f, with silent connections %.1f, then %.1f; %d files at most, "
              "the last ended after %.1f s" % (before, during, after, max(held), float(last)))
        self.assertEqual(int(ended), 1000)
        self.assertLess(max(held), CONNECTIONS_OF_STRANGERS + 50)
        self.assertLess(files_of(server.process) - files, 20)
        self.assertGreater(during, 0.75 * min(before, after))
        self.open(server.url)
        turned = self.settle(page, lambda: page.click("text=top"))
        self.assertGreater(turned.std(), 20)
        self.assertEqual(self.errors, [])
        self.assertEqual(server.end(), 130)
        self.assertEqual(server.said, "")

    def turned_frames(self, page, ended):
        """Frames a second, while the mouse turns the view until ended(seconds)."""
        page.mouse.move(400, 250)
        page.mouse.down()
        begun, before, step = time.monotonic(), self.frames(page), 0
        while not ended(time.monotonic() - begun):
            page.mouse.move(400 + 3 * min(step % 100, 100 - step % 100), 250)
            page.wait_for_timeout(10)
            step += 1
        rate = (self.frames(page) - before) / (time.monotonic() - begun)
        page.mouse.up()
        return rate

    def test_a_viewer_neither_ends_the_server_nor_stalls_others_nor_fills_memory(self):
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        page = self.open(server.url)
        own, secret = server.url.split("/?secret=")
        in_loop(self.misbehave(f"{own}/ws?secret={secret}", secret))
        self.assertIsNone(server.process.poll(), "a viewer ended the server")
        turned = self.settle(page, lambda: page.click("text=top"))
        self.assertGreater(turned.std(), 20)
        self.assertEqual(self.errors, [])
        self.assertEqual(server.end(), 130)
        self.assertNotIn("\x1b", server.said)

    async def misbehave(self, address, secret):
        async with aiohttp.ClientSession() as session:
            async with session.ws_connect(address) as socket:
                await ask(socket, "system:c0:0", "wslink.hello", [{"secret": secret}])
                for method in ("application.exit", "application.exit.later", "trame.rca.push",
                               "trame.force.push"):
                    answer = await ask(socket, "rpc:c0:1", method, [])
                    self.assertIn("Unregistered", str(answer["error"]), method)
                changes = [{"key": f"k{i}", "value": "x" * 100} for i in range(100)]
                await ask(socket, "rpc:c0:2", "trame.state.update",
                          [[*changes, {"key": "colour", "value": "--style"}]])
                state = await ask(socket, "rpc:c0:3", "trame.state.get", [])
                self.assertNotIn("k1", state["result"]["state"])
                for size in ({"w": float("nan"), "h": 1}, {"w": 1e300, "h": -5, "p": 1e9},
                             {"w": "\x1b[2J", "h": None}):
                    await ask(socket, "rpc:c0:4", "trame.rca.size", [area_of(state), "", size])
                event = {"type": "MouseWheel", "x": float("inf"), "y": 0, "spinY": 1e308}
                await ask(socket, "rpc:c0:5", "trame.rca.event", [area_of(state), "", event])
                await socket.send_str("\x1b[2J a text")
                closed = await asyncio.wait_for(until_closed(socket), 20)
                self.assertEqual(closed, 1007)
            async with session.ws_connect(address) as socket:  # one that claims four gigabytes
                await ask(socket, "system:c0:0", "wslink.hello", [{"secret": secret}])
                await socket.send_bytes(struct.pack("<III", 7, 0, 0xffffffff) + b"x")
                self.assertEqual(await asyncio.wait_for(until_closed(socket), 20), 1007)

    def test_a_client_that_reads_nothing_stalls_nobody(self):
        server = Server(self.store, "--port", "0")
        self.addCleanup(server.process.kill)
        page = self.open(server.url)
        own, secret = server.url.split("/?secret=")
        with Deaf(f"{own}/ws?secret={secret}", secret):
            for view in ("top", "front", "iso", "left") * 5:
                before = self.frames(page)
                self.settle(page, lambda view=view: page.click(f"text={view}"))
                self.assertGreater(self.frames(page), before)
        self.assertEqual(server.end(), 130)


if __name__ == "__main__":
    unittest.main(verbosity=2)
