"""Runs the Python tools as shell commands, each in a copy of one process that has imported their modules.

Pages of the manual start the tools by name, and bielle-reduce starts convert_mesh.py for each deck, a hundred times in
some tests. The imports of numpy, h5py, meshio, matplotlib and VTK take nine tenths of the time of such a start. The
commands in the folder of `quick_tools` pass their arguments, folder, environment and streams to a server of the test,
whose copy runs the script of the tool (python_tool.py), and end with its exit status.
"""

import contextlib
import marshal
import os
import signal
import socket
import sys
import tempfile
import unittest
import unittest.mock

from python_tool import TOOLS, import_tools, run_script

INTERPRETER = b"#!/usr/bin/python3\n"
LONGEST = 1 << 20  # bytes of the arguments and the environment of a call
COMMAND = """#!/usr/bin/python3 -SE
import _socket, marshal, os, struct, sys
server = _socket.socket(_socket.AF_UNIX, _socket.SOCK_SEQPACKET)
server.connect({address!r})
call = marshal.dumps(({script!r}, sys.argv[1:], os.getcwd(), dict(os.environ)))
server.sendmsg([call], [(_socket.SOL_SOCKET, _socket.SCM_RIGHTS, struct.pack("3i", 0, 1, 2))])
status = server.recv(16)
if not status:
    sys.exit({script!r} + " ended without an exit status")
sys.exit(int(status))
"""


@contextlib.contextmanager
def quick_tools(*packages):
    """Yields a folder like tools/, whose Python commands are run by a server; the other commands and the package are
    links.

    `packages` are imported beforehand, as by `import_tools`
    """
    import_tools(*packages)
    with tempfile.TemporaryDirectory() as folder, socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as listening:
        listening.bind(os.path.join(folder, "server"))
        listening.listen(64)
        for name in os.listdir(TOOLS):
            _add(os.path.join(TOOLS, name), os.path.join(folder, name), listening.getsockname())
        sys.stdout.flush()
        sys.stderr.flush()
        server = os.fork()
        if server == 0:
            _serve(listening)
        try:
            yield folder
        finally:
            os.kill(server, signal.SIGTERM)
            os.waitpid(server, 0)


class WithQuickTools(unittest.TestCase):
    """Base class of tests whose programs use convert_mesh.py from `quick_tools`."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        tools = cls.enterClassContext(quick_tools("decks", "mesh"))
        cls.enterClassContext(unittest.mock.patch.dict(os.environ, BIELLE_TOOLS=tools))


def _add(path, command, address):
    if os.path.isfile(path):
        with open(path, "rb") as file:
            is_tool = os.access(path, os.X_OK) and file.readline() == INTERPRETER
        if is_tool:
            with open(command, "w", encoding="utf-8") as file:
                file.write(COMMAND.format(address=address, script=path))
            os.chmod(command, 0o700)
            return
    os.symlink(path, command)


def _serve(listening):
    """Runs each call in a copy of this process, until a signal ends the server."""
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    while True:
        connection, _ = listening.accept()
        with connection:
            if os.fork() == 0:
                _answer(connection)
        with contextlib.suppress(ChildProcessError):  # no process is left
            while os.waitpid(-1, os.WNOHANG)[0]:
                pass


def _answer(connection):
    status = 1
    try:
        call, streams, _, _ = socket.recv_fds(connection, LONGEST, 3)
        script, arguments, folder, environment = marshal.loads(call)
        os.dup2(streams[0], 0)
        status = run_script(script, arguments, folder, environment, *streams[1:])
        connection.send(str(status).encode())
    finally:
        os._exit(status)
