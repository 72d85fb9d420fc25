"""The gallery: complete machines with pictures, pages and checks, for the command `gallery`."""
