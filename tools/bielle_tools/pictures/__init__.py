"""Pictures of a scene by VTK, without a display: sheets of stills (PNG, PDF, SVG) and films (GIF, MP4)."""
