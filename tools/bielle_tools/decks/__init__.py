"""Meshes, materials, ties and masses in the decks of Abaqus, CalculiX, Nastran and other programs."""
