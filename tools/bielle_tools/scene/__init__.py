"""Everything that is drawn of a mechanism, as meshes that move with frames; independent of the renderer."""

from .parts import FlexiblePart, Mesh, Part
from .scene import Scene, make_scene

__all__ = ["FlexiblePart", "Mesh", "Part", "Scene", "make_scene"]
