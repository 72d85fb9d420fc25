"""Parameter studies: description, runs, gathered numbers, figures, jobs."""
