"""A bucket for tests: objects in memory, by the part of S3 that builds use.

`with BucketServer() as server:` answers at `server.endpoint` for the bucket `server.BUCKET`;
`server.objects` are its objects by their keys. Requests must be signed (signature_v4.py).
`server.before` is called with method and key before each request is done: it may return a status
that the request is refused with.
"""

import hashlib
import urllib.parse
from xml.sax.saxutils import escape

import signature_v4
from local_server import HERE, Connection, LocalServer


class Handler(Connection):
    """One connection."""

    def answer(self, status, body=b"", **headers):
        self.send_response(status)
        for name, value in headers.items():
            self.send_header(name.replace("_", "-"), value)
        if "Content_Length" not in headers:
            self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(body)

    def refuse(self, status, code):
        self.answer(status, f"<Error><Code>{code}</Code><Message>the bucket of the tests says so"
                            "</Message></Error>".encode())

    def fault(self, body):
        """Status and code of what is wrong with a request; None."""
        wrong = signature_v4.fault_of(self.command, self.path, self.headers)
        if wrong:
            return 403, "SignatureDoesNotMatch"
        told = self.headers.get("X-Amz-Content-Sha256", "")
        if not told.startswith("UNSIGNED") and body and told != hashlib.sha256(body).hexdigest():
            return 400, "XAmzContentSHA256Mismatch"
        return None

    def serve(self):
        server = self.server
        place = urllib.parse.urlsplit(self.path)
        query = dict(urllib.parse.parse_qsl(place.query, keep_blank_values=True))
        bucket, _, key = urllib.parse.unquote(place.path).lstrip("/").partition("/")
        body = self.rfile.read(int(self.headers.get("Content-Length", 0)))
        wrong = self.fault(body)
        refused = server.before(self.command, key)
        with server.lock:
            server.requests.append((self.command, key))
        if refused:
            self.refuse(refused, "SlowDown" if refused == 503 else "AccessDenied")
        elif wrong:
            self.refuse(*wrong)
        elif bucket != server.BUCKET:
            self.refuse(404, "NoSuchBucket")
        else:
            with server.lock:
                getattr(self, "do_" + self.command.lower())(key, query, body)

    do_GET = do_HEAD = do_PUT = do_POST = do_DELETE = serve  # names of the library

    def do_get(self, key, query, _):
        objects = self.server.objects
        if not key:
            self.list(query)
            return
        if key not in objects:
            self.refuse(404, "NoSuchKey")
            return
        data = objects[key]
        tag = f'"{hashlib.md5(data).hexdigest()}"'
        headers = {"ETag": tag, "Accept_Ranges": "bytes",
                   "Last_Modified": "Fri, 27 Nov 2026 08:00:00 GMT"}
        if self.headers.get("If-Match", tag) != tag:
            self.refuse(412, "PreconditionFailed")
            return
        first, _, last = self.headers.get("Range", "").removeprefix("bytes=").partition("-")
        if not first and not last:
            self.answer(200, data, Content_Length=str(len(data)), **headers)
            return
        begin = int(first) if first else max(0, len(data) - int(last))
        end = min(len(data), int(last) + 1) if first and last else len(data)
        self.answer(206, data[begin:end], Content_Length=str(end - begin),
                    Content_Range=f"bytes {begin}-{end - 1}/{len(data)}", **headers)

    do_head = do_get

    def list(self, query):
        keys = sorted(key for key in self.server.objects
                      if key.startswith(query.get("prefix", ""))
                      and key > query.get("continuation-token", ""))
        page = keys[:self.server.page]
        more = len(keys) > len(page)
        text = "".join(f"<Contents><Key>{escape(key)}</Key><Size>1</Size></Contents>"
                       for key in page)
        text += f"<IsTruncated>{str(more).lower()}</IsTruncated>"
        if more:
            text += f"<NextContinuationToken>{escape(page[-1])}</NextContinuationToken>"
        self.answer(200, f"<ListBucketResult>{text}</ListBucketResult>".encode(),
                    Content_Type="application/xml")

    def do_put(self, key, query, body):
        if "partNumber" in query:
            self.server.parts[query["uploadId"]][int(query["partNumber"])] = body
        else:
            self.server.objects[key] = body
        self.answer(200, ETag=f'"{hashlib.md5(body).hexdigest()}"')

    def do_post(self, key, query, _):
        """An upload in parts: the object is there when it is completed."""
        server = self.server
        if "uploads" in query:
            upload = f"upload{len(server.parts)}"
            server.parts[upload] = {}
            self.answer(200, "<InitiateMultipartUploadResult><UploadId>"
                             f"{upload}</UploadId></InitiateMultipartUploadResult>".encode())
            return
        parts = server.parts[query["uploadId"]]
        server.objects[key] = b"".join(parts[number] for number in sorted(parts))
        self.answer(200, b"<CompleteMultipartUploadResult><ETag>&quot;parts&quot;</ETag>"
                         b"</CompleteMultipartUploadResult>")

    def do_delete(self, key, query, _):
        if "uploadId" not in query:
            self.server.objects.pop(key, None)
        self.answer(204)


class BucketServer(LocalServer):
    """The server."""

    BUCKET = "land-of-the-tests"

    def __init__(self, page=1000):
        super().__init__(Handler)
        self.endpoint = f"http://{HERE}:{self.server_port}"
        self.page = page  # keys in an answer of a list
        self.objects = {}
        self.parts = {}
        self.before = lambda method, key: None

    def environment(self):
        """The variables by which a program finds it, and may write."""
        return {"AWS_ENDPOINT_URL": self.endpoint, "AWS_REGION": "eu-central-1",
                "AWS_ACCESS_KEY_ID": signature_v4.KEY_ID, "AWS_SECRET_ACCESS_KEY": signature_v4.KEY,
                "AWS_EC2_METADATA_DISABLED": "true", "no_proxy": HERE}
