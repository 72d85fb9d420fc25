// State of entries: hidden, faint, chosen, isolated; and which groups of parts are shown.

/// Sentences on the marks of an entry.
function markSentences(marks) {
  return [...(marks.gap ? [`its frames are up to ${shown(marks.gap)} m apart`] : []), ...(marks.tilt ? [`its axes are up to ${shown(marks.tilt * 180 / Math.PI)}\u00B0 apart`] : []),
          ...(marks.redundant ? ["its constraints are redundant: its reaction is one of many"] : [])];
}

class Entries {
  constructor(app) {
    this.app = app;
    this.states = new Map();
    this.chosen = null;
    this.isolated = null;
    const found = new Map();
    for (const run of app.data.runs)
      for (const sequence of run.sequences)
        for (const part of [...app.data.layouts[sequence.layout].parts, ...sequence.scene.flexible])
          if (!found.has(part.entry)) found.set(part.entry, {entry: part.entry, type: part.type, colour: part.colour, group: part.group});
    this.all = [...found.values()];
    this.known = found;
  }

  state(entry) {
    if (!this.states.has(entry)) this.states.set(entry, {});
    return this.states.get(entry);
  }

  hidden(entry) { return Boolean(this.state(entry).hidden) || this.isolated !== null && this.isolated !== entry; }

  toggle(entry, what) {
    const state = this.state(entry);
    state[what] = !state[what];
    this.app.repaint();
  }

  choose(entry, point = null) {
    this.chosen = this.known.has(entry) ? entry : null;
    this.point = point;
    this.app.repaint();
    this.app.details.show(this.chosen);
  }

  isolate(entry) {
    this.isolated = this.isolated === entry ? null : entry;
    this.app.repaint();
  }

  showAll() {
    this.isolated = null;
    for (const state of this.states.values()) state.hidden = state.faint = false;
    this.app.repaint();
  }
}
