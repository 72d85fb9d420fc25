"""The text of the model in a results file, in which every entry stands: parts and repetitions are written out."""

import yaml


def entries_of(results):
    """{"joints/main": {key: value as text, list or dict}} of the entries of the model; empty if its text cannot be read."""
    try:
        tree = yaml.load(results.text_of("input"), Loader=getattr(yaml, "CBaseLoader", yaml.BaseLoader))
    except (yaml.YAMLError, RecursionError):
        return {}
    return {f"{section}/{name}": entry for section, entries in (tree.items() if isinstance(tree, dict) else ())
            for name, entry in (entries.items() if isinstance(entries, dict) else ()) if isinstance(entry, dict)}
