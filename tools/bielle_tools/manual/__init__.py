"""The manual: its pages are run, and built as a site."""
