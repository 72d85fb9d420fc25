"""A local page that reloads while a run grows, bound to the loopback address."""

import contextlib
import http.server
import io
import os
import shutil
import socketserver
import tempfile
import threading
import time

from ..messages import InputError, note

PAGE, STATE = "/", "/state"
TRIES, PAUSE = 10, 0.5  # attempts to build the first page; time between them [s]


def serve(paths, port, page):
    """Serves page(paths, token) until it is interrupted. The token changes when a file grows. @raises InputError if the first page cannot be
    built within some tries: a file is unreadable at moments while a run writes it"""
    def build(token):
        with copies(paths) as copied:
            try:
                return page(copied, token)
            except InputError as error:
                said = str(error)
                for copy, path in zip(copied, paths):
                    said = said.replace(copy, path)  # users know the file, not its copy
                raise InputError(said) from None
    handler = _handler(paths, build)
    try:
        server = _Server(("127.0.0.1", port), handler)
    except OSError as error:
        raise InputError(f"port {port} cannot be used: {error.strerror}") from None
    with server:
        handler.kept = _first(paths, build)  # wrong input is reported before the address is printed
        print(f"http://127.0.0.1:{server.server_address[1]}/  (Ctrl-C ends it)", flush=True)
        server.serve_forever()


def _first(paths, build):
    for again in reversed(range(TRIES)):
        token = token_of(paths)
        try:
            return token, build(token)
        except InputError:
            time.sleep(PAUSE)
            if not again or token == token_of(paths):
                raise  # the file stays as it is
    raise AssertionError


@contextlib.contextmanager
def copies(paths):
    """Copies of files of this moment, since a run changes them while they are read; other files next to them are found next to the copies."""
    with tempfile.TemporaryDirectory(prefix="bielle-view-") as folder:
        copied = []
        for number, path in enumerate(paths):
            if not os.path.isfile(path):
                copied.append(path)  # a missing file is reported by its reader
                continue
            own, around = os.path.join(folder, str(number)), os.path.dirname(os.path.abspath(path))
            os.mkdir(own)
            copied.append(shutil.copyfile(path, os.path.join(own, os.path.basename(path))))
            for entry in os.scandir(around):
                if entry.name.endswith(".h5") and entry.name != os.path.basename(path):
                    os.symlink(entry.path, os.path.join(own, entry.name))
        yield copied


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

        kept, said, lock = ("", ""), "", threading.Lock()

        def do_GET(self):  # pylint: disable=invalid-name
            host = (self.headers.get("Host") or "").partition(":")[0]
            if host not in ("127.0.0.1", "localhost"):  # a page elsewhere that resolves its own name to this address gets nothing
                self.send_error(403)
            elif self.path == STATE:
                self._answer(self._newest()[0], "text/plain")
            elif self.path == PAGE:
                self._answer(self._newest()[1], "text/html")
            else:
                self.send_error(404)

        def _newest(self):
            """The token of the newest page that could be built, and the page. A file that cannot be read now keeps the page before."""
            with Handler.lock:
                token = token_of(paths)
                if token != Handler.kept[0]:
                    try:
                        with contextlib.redirect_stderr(io.StringIO()):  # the notes of the first page would come again each time
                            Handler.kept = (token, build(token))
                    except InputError as error:
                        if str(error) != Handler.said:
                            Handler.said = str(error)
                            note(Handler.said)
                return Handler.kept

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
