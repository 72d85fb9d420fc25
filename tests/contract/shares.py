"""Divides long sweeps between the everyday tests and the long ones."""

import os


def share(items):
    """Returns every third item; the others in the ctests with BIELLE_SHARE=rest, which are long."""
    shares = {"": items[::3], "rest": [item for k, item in enumerate(items) if k % 3]}
    return shares[os.environ.get("BIELLE_SHARE", "")]
