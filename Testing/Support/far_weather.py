"""The bad weather of far_server.py: how its answers are spoilt."""

import gzip
import time

import signature_v4

TOKEN = "a-token-of-the-tests"


class Weather:
    """How an answer is spoilt: the names of all functions here are weathers.

    Each gets the handler, the file's bytes and the range [begin, end) that is asked for. `times`
    counts the requests of one weather and file."""

    @staticmethod
    def reset(request, data, begin, end, times):
        """The connection is reset in the middle of the body, each second time."""
        if times % 2 == 1:
            request.answer(data, begin, end, send=max(1, (end - begin) // 2), after="reset")
        else:
            request.answer(data, begin, end)

    @staticmethod
    def resets(request, data, begin, end, times):
        """Always."""
        request.answer(data, begin, end, send=(end - begin) // 2, after="reset")

    @staticmethod
    def storm(request, data, begin, end, times):
        """503, twice of three times."""
        if times % 3:
            request.refuse(503)
        else:
            request.answer(data, begin, end)

    @staticmethod
    def storms(request, data, begin, end, times):
        """Always 503."""
        request.refuse(503)

    @staticmethod
    def busy(request, data, begin, end, times):
        """429 with Retry-After, the first time."""
        if times == 1:
            request.refuse(429, {"Retry-After": "1"})
        else:
            request.answer(data, begin, end)

    @staticmethod
    def tomorrow(request, data, begin, end, times):
        """503 that asks for a day of patience."""
        request.refuse(503, {"Retry-After": "86400"})

    @staticmethod
    def stall(request, data, begin, end, times):
        """The body stops in the middle, the first time."""
        if times == 1:
            request.answer(data, begin, end, send=(end - begin) // 2, after="stall")
        else:
            request.answer(data, begin, end)

    @staticmethod
    def stalls(request, data, begin, end, times):
        """Always."""
        request.answer(data, begin, end, send=(end - begin) // 2, after="stall")

    @staticmethod
    def trickle(request, data, begin, end, times):
        """Ten bytes a second: never a stall, and no end."""
        request.answer(data, begin, end, send=1, after="trickle")

    @staticmethod
    def short(request, data, begin, end, times):
        """The body is shorter than the range that the answer names."""
        request.answer(data, begin, end, body=data[begin:end - 1] if end > begin + 1 else b"")

    @staticmethod
    def long(request, data, begin, end, times):
        """The body is longer than the range that the answer names."""
        request.answer(data, begin, end, body=data[begin:end] + b"more")

    @staticmethod
    def elsewhere(request, data, begin, end, times):
        """The answer names and has another range than was asked for."""
        request.answer(data, begin + 1, min(end + 1, len(data)))

    @staticmethod
    def ranges_ignored(request, data, begin, end, times):
        """200 with the whole file."""
        request.answer(data, 0, len(data), status=200)

    @staticmethod
    def replaced(request, data, begin, end, times):
        """Another file of the same length after two requests; If-Match is obeyed."""
        request.answer(request.other(data, times > 2), begin, end, obey=True)

    @staticmethod
    def replaced_deaf(request, data, begin, end, times):
        """Likewise; the server does not know If-Match."""
        request.answer(request.other(data, times > 2), begin, end)

    @staticmethod
    def replaced_dated(request, data, begin, end, times):
        """Likewise; the server has no entity tags, but dates."""
        request.answer(request.other(data, times > 2), begin, end, tag=None,
                       date=1e9 + (60 if times > 2 else 0))

    @staticmethod
    def replaced_longer(request, data, begin, end, times):
        """A longer file after two requests; neither tags nor dates."""
        changed = data + b"x" if times > 2 else data
        request.answer(changed, begin, end, tag=None, date=None)

    @staticmethod
    def immutable(request, data, begin, end, times):
        """The server promises that the file stays what it is."""
        request.answer(data, begin, end, obey=True,
                       more={"Cache-Control": "public, max-age=600, immutable"})

    @staticmethod
    def weak(request, data, begin, end, times):
        """A weak entity tag, with which If-Match never matches."""
        request.answer(data, begin, end, tag='W/"1"', obey=True)

    @staticmethod
    def nameless(request, data, begin, end, times):
        """Neither tag nor date."""
        request.answer(data, begin, end, tag=None, date=None)

    @staticmethod
    def expired(request, data, begin, end, times):
        """403 after two requests: a signed address that has run out."""
        if times > 2:
            request.refuse(403)
        else:
            request.answer(data, begin, end)

    @staticmethod
    def circle(request, data, begin, end, times):
        """A redirect to itself."""
        request.redirect(request.path)

    @staticmethod
    def to_file(request, data, begin, end, times):
        """A redirect to a file of the reader's machine."""
        request.redirect("file://" + str(request.server.folder / request.file_name()))

    @staticmethod
    def to_private(request, data, begin, end, times):
        """A redirect to an address of the reader's network."""
        request.redirect(f"http://localhost:{request.server.server_port}/{request.file_name()}")

    @staticmethod
    def hop(request, data, begin, end, times):
        """A redirect to the file itself."""
        request.redirect("/" + request.file_name())

    @staticmethod
    def gzipped(request, data, begin, end, times):
        """The body is compressed although nobody asked."""
        request.answer(data, begin, end, body=gzip.compress(data[begin:end]),
                       more={"Content-Encoding": "gzip"})

    @staticmethod
    def endless(request, data, begin, end, times):
        """A body of no length that does not end."""
        request.answer(data, begin, end, after="endless")

    @staticmethod
    def endless_whole(request, data, begin, end, times):
        """Likewise, and ranges are ignored."""
        request.answer(data, 0, len(data), status=200, after="endless")

    @staticmethod
    def lying(request, data, begin, end, times):
        """The file is said to be as long as no file is."""
        request.answer(data, begin, end, total="9223372036854775807999")

    @staticmethod
    def huge(request, data, begin, end, times):
        """The file is said to be of 2^62 bytes, and each range of it is there."""
        request.answer(data, begin, end, total=str(2 ** 62))

    @staticmethod
    def headers(request, data, begin, end, times):
        """Headers of 100 MB."""
        request.flood(100 << 20)

    @staticmethod
    def two(request, data, begin, end, times):
        """503 while two other requests of the file are under way."""
        if request.server.under_way > 2:
            request.refuse(503)
        else:
            time.sleep(0.02)
            request.answer(data, begin, end)

    @staticmethod
    def bearer(request, data, begin, end, times):
        """401 without the token of the tests."""
        if request.headers.get("Authorization") == "Bearer " + TOKEN:
            request.answer(data, begin, end)
        else:
            request.refuse(401)

    @staticmethod
    def bearer_hop(request, data, begin, end, times):
        """A redirect to another host, which must not be sent the token."""
        request.redirect(f"http://localhost:{request.server.server_port}/{request.file_name()}")

    @staticmethod
    def forbidden(request, data, begin, end, times):
        """403."""
        request.refuse(403)

    @staticmethod
    def s3(request, data, begin, end, times):
        """403 without a sound signature of the key of the tests."""
        fault = signature_v4.fault_of(request.command, request.path, request.headers)
        if fault is None:
            request.answer(data, begin, end)
        else:
            request.server.faults.append(fault)
            request.refuse(403)
