"""The Python part of Bielle: mesh conversion, pictures of results, ParaView files. It needs Debian's
/usr/bin/python3."""
