#!/usr/bin/python3
"""Frames a second that somebody who looks at `pointfront serve` gets, alone, and while another
process without the secret sends messages: 100,000 by default, a hundred in each try to get a
socket. Both are measured in turn, in one run; the processors are shared, so the second is that of
less processor time even where the server ignores the messages: a third measures what the same
process costs when it sends them to nobody (a server of its own that refuses all).

    Testing/Benchmarks/page_flood.py CLOUD.pfront [--messages 100000] [--seconds 8]

Python needs pointfront and what its page needs.
"""

import argparse
import asyncio
import multiprocessing
import re
import socket
import subprocess
import sys
import time
import urllib.parse

import aiohttp
import msgpack
from wslink.chunking import UnChunker, generate_chunks

REFUSAL = b"HTTP/1.1 403 Forbidden\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"


def flood(host, port, sent, stop):
    """Tries to get a socket, and sends a hundred messages without waiting for an answer."""
    greeting = (f"GET /ws HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\n"
                "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n").encode()
    messages = (bytes([0x82, 0x80 + 20]) + bytes(4) + bytes(20)) * 100
    while not stop.value:
        try:
            with socket.create_connection((host, port)) as line:
                line.sendall(greeting + messages)
                line.recv(1 << 16)
        except OSError:
            pass
        sent.value += 100


def refuse(listener):
    while True:
        line, _ = listener.accept()
        with line:
            try:
                line.recv(1 << 16)
                line.sendall(REFUSAL)
            except OSError:
                pass


class Viewer:
    def __init__(self, line):
        self._line = line
        self.frames = 0
        self._calls = 0

    async def call(self, method, arguments, system=False):
        self._calls += 1
        name = f"{'system' if system else 'rpc'}:c0:{self._calls}"
        message = msgpack.packb({"wslink": "1.0", "id": name, "method": method,
                                 "args": arguments, "kwargs": {}})
        for chunk in generate_chunks(message, 0):
            await self._line.send_bytes(chunk)
        return name

    async def answer_to(self, name):
        parts = UnChunker()
        parts.set_max_message_size(1 << 26)
        while True:
            got = parts.process_chunk((await self._line.receive()).data)
            if got is not None and got["id"] == name:
                return got

    async def count(self):
        parts = UnChunker()
        parts.set_max_message_size(1 << 26)
        async for message in self._line:
            got = parts.process_chunk(message.data)
            if got is not None and "rca.topic.stream" in got["id"]:
                self.frames += 1

    async def turn(self, area, seconds):
        """Frames a second while the mouse turns the cloud."""
        begin, before, x = time.monotonic(), self.frames, 400
        while time.monotonic() - begin < seconds:
            x = 300 + (x + 7) % 200
            await self.call("trame.rca.event", [area, "", {"type": "MouseMove", "x": x, "y": 300}])
            await asyncio.sleep(0.016)
        return (self.frames - before) / (time.monotonic() - begin)


async def measure(address, secret, arguments, targets):
    rates = {name: [] for name in targets}
    async with aiohttp.ClientSession() as session:
        async with session.ws_connect(f"{address}/ws?secret={secret}", max_msg_size=0) as line:
            viewer = Viewer(line)
            await viewer.answer_to(await viewer.call("wslink.hello", [{"secret": secret}], True))
            state = await viewer.answer_to(await viewer.call("trame.state.get", []))
            area = re.search(r'name=\\*"(\w+)', str(state["result"])).group(1)
            counter = asyncio.ensure_future(viewer.count())
            await viewer.call("trame.rca.size", [area, "", {"w": 1280, "h": 720, "p": 1}])
            press = {"type": "LeftButtonPress", "x": 400, "y": 300}
            await viewer.call("trame.rca.event", [area, "", press])
            await viewer.turn(area, arguments.seconds)  # reads all that is read only once
            total = {name: 0 for name in targets}
            while min([total[name] for name in targets if name != "alone"]) < arguments.messages:
                for name, target in targets.items():
                    sent, stop = multiprocessing.Value("l", 0), multiprocessing.Value("b", 0)
                    attacker = None
                    if target is not None:
                        attacker = multiprocessing.Process(target=flood, args=(*target, sent, stop))
                        attacker.start()
                    rates[name].append(await viewer.turn(area, arguments.seconds))
                    if attacker is not None:
                        stop.value = 1
                        attacker.join()
                        total[name] += sent.value
            counter.cancel()
    return rates, total


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cloud")
    parser.add_argument("--messages", type=int, default=100000)
    parser.add_argument("--seconds", type=float, default=8.0)
    arguments = parser.parse_args()
    command = [sys.executable, "-m", "pointfront", "serve", arguments.cloud, "--port", "0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        url = re.search(r"http://\S+", server.stdout.readline()).group(0)
        address, secret = url.split("/?secret=")
        place = urllib.parse.urlsplit(address)
        listener = socket.create_server(("localhost", 0))
        nobody = multiprocessing.Process(target=refuse, args=(listener,), daemon=True)
        nobody.start()
        targets = {"alone": None, "messages to nobody": ("localhost", listener.getsockname()[1]),
                   "messages to the server": (place.hostname, place.port)}
        rates, total = asyncio.run(measure(address, secret, arguments, targets))
        nobody.terminate()
        server.terminate()
    for name, measured in rates.items():
        middle = sorted(measured)[len(measured) // 2]
        print(f"{name}: {middle:.1f} frames/s, median of {len(measured)}; {total[name]} messages")


if __name__ == "__main__":
    main()
