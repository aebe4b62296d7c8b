"""A web server for tests: ranges, entity tags, and every kind of bad weather.

usage: far_server.py FOLDER [--certificate PEM]

Prints the port that it listens on; ends when its standard input ends. "/NAME" is the file of the
folder. "/~WEATHER/NAME" is the same file in that weather (far_weather.py has the list), and
"/~log" what was asked so far, as JSON. Query strings say nothing. `/~s3/BUCKET/KEY` checks
signatures of version 4 (signature_v4.py).
"""

import argparse
import email.utils
import hashlib
import json
import os
import pathlib
import re
import socket
import ssl
import struct
import sys
import threading
import time
import urllib.parse

from far_weather import Weather
from local_server import Connection, LocalServer


def wanted_range(header, size):
    """[begin, end) of a Range header; None without one; False if it cannot be had."""
    match = re.fullmatch(r"bytes=(\d*)-(\d*)", header or "")
    if not match or match.groups() == ("", ""):
        return None
    first, last = match.groups()
    if first == "":
        return (max(0, size - int(last)), size) if int(last) and size else False
    begin = int(first)
    end = min(size, int(last) + 1) if last else size
    return (begin, end) if begin < min(end, size) else False


def asked_again(before, after):
    """Bytes of later requests that earlier ones of the same file had, too."""
    return sum(max(0, min(one["bytes"][1], other["bytes"][1])
                   - max(one["bytes"][0], other["bytes"][0]))
               for one in before for other in after
               if one["path"].partition("?")[0] == other["path"].partition("?")[0])


class Handler(Connection):
    """One connection."""

    def file_name(self):
        parts = urllib.parse.urlsplit(self.path).path.strip("/").split("/")
        parts = parts[1:] if parts[0].startswith("~") else parts
        return urllib.parse.unquote("/".join(parts))

    def weather(self):
        first = urllib.parse.urlsplit(self.path).path.strip("/").split("/")[0]
        return first[1:].replace("-", "_") if first.startswith("~") else ""

    def do_GET(self):  # pylint: disable=invalid-name
        server = self.server
        with server.lock:
            server.under_way += 1
        try:
            self.serve()
        except (BrokenPipeError, ConnectionResetError):
            self.close_connection = True
        finally:
            with server.lock:
                server.under_way -= 1

    def serve(self):
        if self.weather() == "log":
            with self.server.lock:
                text = json.dumps({"requests": self.server.requests,
                                   "faults": self.server.faults}).encode()
            self.answer(text, 0, len(text), status=200)
            return
        path = (self.server.folder / self.file_name()).resolve()
        inside = self.server.folder in path.parents
        key = (self.weather(), self.file_name())
        with self.server.lock:
            self.server.requests.append(seen := {
                "path": self.path, "bytes": (0, 0), "range": self.headers.get("Range"),
                "host": self.headers.get("Host"), "agent": self.headers.get("User-Agent"),
                "if_match": self.headers.get("If-Match"),
                "encoding": self.headers.get("Accept-Encoding"),
                "authorization": self.headers.get("Authorization") is not None})
            times = self.server.times[key] = self.server.times.get(key, 0) + 1
        self.server.before(self.path)
        if not inside or not path.is_file():
            self.refuse(404)
            return
        data = path.read_bytes() if path.stat().st_size < (1 << 22) else FileBytes(path)
        self.modified = path.stat().st_mtime
        self.tag = f'"{path.stat().st_mtime_ns:x}-{len(data):x}"'
        wanted = wanted_range(self.headers.get("Range"), len(data))
        if wanted is False:
            self.refuse(416, {"Content-Range": f"bytes */{len(data)}"})
            return
        begin, end = wanted or (0, len(data))
        seen["bytes"] = (begin, end)
        if self.weather():
            getattr(Weather, self.weather())(self, data, begin, end, times)
        else:
            self.answer(data, begin, end, obey=True)

    @staticmethod
    def other(data, changed):
        return bytes(byte ^ 1 for byte in data[0:len(data)]) if changed else data

    def answer(self, data, begin, end, status=None, body=None, send=None, after="", tag="",
               date=0.0, total="", more=None, obey=False):
        """tag: "": the file's own; None: none. after: what comes once `send` bytes are sent."""
        if tag == "":
            tag = getattr(self, "tag", None)
            if self.weather().startswith("replaced"):
                tag = '"' + hashlib.md5(data[0:len(data)]).hexdigest() + '"'
        condition = self.headers.get("If-Match")
        if obey and condition and (condition != tag or condition.startswith("W/")):
            self.refuse(412)
            return
        if status is None:
            status = 206 if self.headers.get("Range") else 200
        body = data[begin:end] if body is None else body
        self.send_response(status)
        if after == "endless":
            self.close_connection = True
            self.send_header("Connection", "close")
        else:
            self.send_header("Content-Length", str(len(body)))
        if status == 206:
            self.send_header("Content-Range", f"bytes {begin}-{end - 1}/{total or len(data)}")
        self.send_header("Accept-Ranges", "bytes")
        if tag:
            self.send_header("ETag", tag)
        if date is not None:
            self.send_header("Last-Modified", email.utils.formatdate(
                date or getattr(self, "modified", 1e9), usegmt=True))
        for name, value in (more or {}).items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body if send is None else body[:send])
        self.then(after)

    def then(self, after):
        if after == "reset":
            self.wfile.flush()
            time.sleep(0.05)
            self.connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER,
                                       struct.pack("ii", 1, 0))
            self.close_connection = True
        elif after == "stall":
            self.server.ending.wait(60)
            self.close_connection = True
        elif after == "trickle":
            while not self.server.ending.wait(0.1):
                self.wfile.write(b"x")
        elif after == "endless":
            while not self.server.ending.is_set():
                self.wfile.write(bytes(1 << 16))

    def refuse(self, status, more=None):
        text = b"the server refuses"
        self.send_response(status)
        self.send_header("Content-Length", str(len(text)))
        for name, value in (more or {}).items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(text)

    def redirect(self, target):
        self.send_response(302)
        self.send_header("Location", target)
        self.send_header("Content-Length", "0")
        self.end_headers()

    def flood(self, size):
        self.wfile.write(b"HTTP/1.1 206 Partial Content\r\n")
        line = b"X-Flood: " + b"f" * 1000 + b"\r\n"
        for _ in range(size // len(line)):
            self.wfile.write(line)
        self.wfile.write(b"\r\n")
        self.close_connection = True


class FileBytes:
    """A large file as bytes: only the slices that are asked for are read."""

    def __init__(self, path):
        self._file = open(path, "rb")  # pylint: disable=consider-using-with
        self._size = os.fstat(self._file.fileno()).st_size

    def __len__(self):
        return self._size

    def __getitem__(self, part):
        begin, end, _ = part.indices(self._size)
        return os.pread(self._file.fileno(), max(0, end - begin), begin)

    def __del__(self):
        self._file.close()


class FarServer(LocalServer):
    """`with FarServer(folder) as server: server.port, server.requests`. `server.before` is called
    with the path before a request is answered, and may wait."""

    def __init__(self, folder, certificate=None):
        super().__init__(Handler)
        if certificate:
            context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
            context.load_cert_chain(certificate)
            self.socket = context.wrap_socket(self.socket, server_side=True)
        self.folder = pathlib.Path(folder).resolve()
        self.ending = threading.Event()
        self.faults = []
        self.times = {}
        self.before = lambda path: None
        self.under_way = 0
        self.port = self.server_port

    def __exit__(self, *failure):
        self.ending.set()
        super().__exit__(*failure)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder")
    parser.add_argument("--certificate")
    options = parser.parse_args()
    with FarServer(options.folder, options.certificate) as server:
        print(server.port, flush=True)
        sys.stdin.read()


if __name__ == "__main__":
    main()
