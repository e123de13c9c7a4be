"""Other servers: a proxy that serves one below a path, which it strips, as nginx does, and a site of its own."""

import http.client
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from http.server import BaseHTTPRequestHandler, SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import urlsplit


@contextmanager
def proxied(address: str, prefix: str, removed: frozenset[str] = frozenset()) -> Iterator[str]:
    """The address of the server at ``address`` behind a proxy. removed: headers that it takes away, in lower case."""

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def do_GET(self) -> None:
            if not self.path.startswith(f"{prefix}/"):
                self.send_error(404, "this is not below the prefix")
                return
            body = self.rfile.read(int(self.headers.get("Content-Length", 0)))
            behind = http.client.HTTPConnection(urlsplit(address).netloc, timeout=120)
            headers = {**self.headers, "Connection": "close", "X-Forwarded-For": self.client_address[0]}
            headers["X-Forwarded-Prefix"] = prefix
            behind.request(self.command, self.path.removeprefix(prefix), body, headers)
            answer = behind.getresponse()
            content = answer.read()
            self.send_response_only(answer.status)
            for name, value in answer.getheaders():
                if name.lower() not in {"connection", "content-length", "transfer-encoding", *removed}:
                    self.send_header(name, value)
            if answer.status not in (204, 304):
                self.send_header("Content-Length", str(len(content)))
            self.end_headers()
            self.wfile.write(content)
            behind.close()

        do_POST = do_PUT = do_DELETE = do_HEAD = do_GET  # noqa: N815 (named by http.server)

        def log_message(self, *_: object) -> None:
            pass

    with _listening(Handler) as origin:
        yield f"{origin}{prefix}"


@contextmanager
def site(folder: Path) -> Iterator[str]:
    """The origin of a site with the files of a folder. Browsers let no page that a test makes up load what is here."""
    with _listening(partial(SimpleHTTPRequestHandler, directory=folder)) as origin:
        yield origin


@contextmanager
def _listening(handler: Callable[..., BaseHTTPRequestHandler]) -> Iterator[str]:
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        server.daemon_threads = True
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_address[1]}"
        server.shutdown()
