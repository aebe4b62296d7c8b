"""Headers and secret addresses: this process knows them, its tools by their environment."""

import os
import sys
import urllib.parse

from . import _kernel
from ._errors import PointFrontError

VARIABLE = "POINTFRONT_FAR"  # for its user alone, unlike a command line

_headers = {}  # lines by origin
_addresses = {}  # whole addresses by their public forms, which name them to the tool


def traffic():
    """Traffic of this process with servers so far, a dictionary of numbers.

    requests       attempts, those after a fault or a redirection included
    bytes_fetched  all bodies together, bytes
    retries        requests that were made again
    cache_hits     reads that the cache on this machine's disk has answered
    cache_bytes    these reads together, bytes

    Opening, points() and chunks() count. Pictures, exports and `info` are the tool's work, which
    counts its own: `--stats` of its commands.
    """
    return _kernel.traffic()


def is_address(name):
    return isinstance(name, str) and "://" in name


def written(path):
    """The path of a file that is written; an address is a PointFrontError."""
    if is_address(path):
        raise PointFrontError(f"'{path}' is an address, and only files of this machine are "
                              "written; write a file and upload that")
    return path


def origin_of(address):
    """Scheme, host and port."""
    parts = urllib.parse.urlsplit(address)
    return f"{parts.scheme.lower()}://{parts.netloc.rsplit('@', 1)[-1].lower()}"


def use_headers(address, headers, token=None):
    """Headers of all requests to the server of an address from now on."""
    lines = [f"{name}: {value}" for name, value in dict(headers or {}).items()]
    if token is not None:
        lines.append(f"Authorization: Bearer {token}")
    if not is_address(address) or address.split(":")[0].lower() not in ("http", "https"):
        raise PointFrontError("headers and tokens are for addresses of http and https")
    if any(not line.isprintable() or line.startswith("[") for line in lines):
        raise PointFrontError("a header or a token has characters that no request can have")
    origin = origin_of(address)
    _kernel.learn_credentials("\n".join([f"[{origin}]", *lines]))
    _headers[origin] = lines


def named(address, public_form):
    """Returns the name under which the tool gets it. What is not secret needs nobody to remember
    it, nor does a public form that whoever started this process gave to it and to its tools.
    """
    if "?~" in address:
        return address
    if "?~" in public_form:
        _addresses[public_form] = address
    return public_form


def hide_secrets():
    """Starts this process's program anew if its command line names addresses with secrets, which
    everybody on the machine could read as long as it runs: now the environment has them.
    """
    words = [named(word, _kernel.public_form(word)) if is_address(word) else word
             for word in sys.orig_argv]
    if any(word in _addresses for word in words):
        os.execve(sys.executable, words, environment(words))


def with_settings(address, offline, cache, cache_size, timeout):
    """The name under which the kernel opens an address with settings of its own."""
    words = {}
    if offline is not None:
        words["offline"] = int(bool(offline))
    if cache is not None:
        words["cache"] = "off" if cache is False else _kernel.path_of(os.path.abspath(cache))
    if cache_size is not None:
        words["cache_size"] = _kernel.whole(str(cache_size))
    if timeout is not None:
        words["timeout"] = _kernel.whole(str(timeout))
    if not words:
        return address
    if not is_address(address):
        raise PointFrontError(f"{address}: offline, cache, cache_size and timeout are for "
                              "addresses, and this is a path")
    place, sign, rest = address.partition("#")  # "#epoch=2024"
    if rest.startswith("far:"):
        _, sign, rest = rest.partition("#")
    text = urllib.parse.urlencode(words, quote_via=urllib.parse.quote)
    return f"{place}#far:{text}{sign}{rest}"


def told_to_child(path):
    """The path and the headers that open it where it is unpickled.

    A pickle is a file, or goes through one: it has what is not secret. Only a child that
    multiprocessing is just starting (`spawn`) gets all, by the pipe from its parent.
    """
    context = sys.modules.get("multiprocessing.context")
    if not is_address(path) or context is None or context.get_spawning_popen() is None:
        whole = _addresses.get(path, path)
        plain = whole.split("#far:")[0]
        # A mark that stands for settings alone hides nothing.
        return (whole if "?~" not in _kernel.public_form(plain) else path), None
    return _addresses.get(path, path), _headers.get(origin_of(path))


def environment(words):
    """The environment of a tool with these words on its command line; None: this process's."""
    lines = []
    for word in filter(is_address, map(str, words)):
        if word in _addresses:
            mark = word.rsplit("?", 1)[-1].partition("#")[0]  # "#epoch=2024"
            lines.append(f"{mark} {_addresses[word]}")
    for origin in {origin_of(word) for word in map(str, words) if is_address(word)}:
        if origin in _headers:
            lines += [f"[{origin}]", *_headers[origin]]
    if not lines:
        return None
    given = os.environ.get(VARIABLE)
    return {**os.environ, VARIABLE: "\n".join([*([given] if given else []), *lines])}
