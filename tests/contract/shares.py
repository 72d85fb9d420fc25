"""Divides long sweeps between the everyday tests and the long ones."""

import os


def share(items):
    """Every third item everyday; the others in the ctests with BIELLE_SHARE=rest, which are long; all of them with BIELLE_SHARE=all."""
    shares = {"": items[::3], "rest": [item for k, item in enumerate(items) if k % 3], "all": items}
    return shares[os.environ.get("BIELLE_SHARE", "")]
