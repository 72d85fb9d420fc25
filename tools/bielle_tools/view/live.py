"""A local page that reloads while a run grows, bound to the loopback address."""

import http.server
import os
import socketserver

from ..messages import InputError, note

PAGE, STATE = "/", "/state"


def serve(paths, port, page):
    """Serves page(token) until it is interrupted. The token changes when a file grows. @raises InputError if the first page cannot be built"""
    handler = _handler(paths, page)
    try:
        server = _Server(("127.0.0.1", port), handler)
    except OSError as error:
        raise InputError(f"port {port} cannot be used: {error.strerror}") from None
    with server:
        handler.kept = (token_of(paths), page(token_of(paths)))  # wrong input is told before the address
        print(f"http://127.0.0.1:{server.server_address[1]}/  (Ctrl-C ends it)", flush=True)
        server.serve_forever()


class _Server(socketserver.ThreadingMixIn, http.server.HTTPServer):
    daemon_threads = True


def token_of(paths):
    """Changes when one of the files does."""
    found = []
    for path in paths:
        try:
            status = os.stat(path)
            found.append(f"{status.st_size}-{status.st_mtime_ns}")
        except OSError:
            found.append("gone")
    return " ".join(found)


def _handler(paths, build):
    class Handler(http.server.BaseHTTPRequestHandler):
        """Answers the page, and the token of its files."""

        kept = ("", "")

        def do_GET(self):  # pylint: disable=invalid-name
            host = (self.headers.get("Host") or "").partition(":")[0]
            if host not in ("127.0.0.1", "localhost"):  # a page elsewhere that resolves its own name to this address gets nothing
                self.send_error(403)
            elif self.path == STATE:
                self._answer(token_of(paths), "text/plain")
            elif self.path == PAGE:
                self._answer(self._page(), "text/html")
            else:
                self.send_error(404)

        def _page(self):
            token = token_of(paths)
            if token != Handler.kept[0]:
                try:
                    Handler.kept = (token, build(token))
                except InputError as error:  # a file that is just being written: the last page stays
                    note(str(error))
            return Handler.kept[1]

        def _answer(self, text, kind):
            data = text.encode()
            self.send_response(200)
            self.send_header("Content-Type", f"{kind}; charset=utf-8")
            self.send_header("Content-Length", str(len(data)))
            self.send_header("Cache-Control", "no-store")
            self.end_headers()
            self.wfile.write(data)

        def log_message(self, *_):
            """Requests are not listed."""
    return Handler
