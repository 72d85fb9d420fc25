"""Python side of Bielle: mesh conversion, pictures of results, ParaView files. Needs Debian's /usr/bin/python3."""
