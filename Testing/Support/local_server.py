"""A connection and a server in threads of this process, which the tests' web servers share."""

import http.server
import socket
import threading

HERE = "127.0.0.1"


class Connection(http.server.BaseHTTPRequestHandler):
    """One connection, which stays open and says nothing to the terminal."""

    protocol_version = "HTTP/1.1"

    def setup(self):
        super().setup()
        self.connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, True)

    def log_message(self, *_):  # pylint: disable=arguments-differ
        pass


class LocalServer(http.server.ThreadingHTTPServer):
    """A server at some port of this machine, from `with` to its end."""

    daemon_threads = True
    request_queue_size = 128

    def __init__(self, connection):
        super().__init__((HERE, 0), connection)
        self.lock = threading.Lock()
        self.requests = []
        self._thread = threading.Thread(target=self.serve_forever, args=(0.05,), daemon=True)

    def handle_error(self, request, client_address):
        """A client that went away is no news."""

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self.shutdown()
        self._thread.join()
        self.server_close()
