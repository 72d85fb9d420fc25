// The tree of entries: sections, names, types; a click chooses, the eye hides.

class Tree {
  constructor(app) {
    this.app = app;
    this.lines = new Map();
    const sections = new Map();
    for (const one of app.entries.all) {
      const section = one.entry.slice(0, one.entry.indexOf("/")) || "others";
      if (!sections.has(section)) sections.set(section, []);
      sections.get(section).push(one);
    }
    const box = document.getElementById("entries"), last = section => section === "nodes" ? 1 : 0;
    for (const [section, list] of [...sections].sort((a, b) => last(a[0]) - last(b[0])))
      box.append(element("details", {open: list.length < 400 && !(last(section) && sections.size > 1)}, element("summary", {textContent: `${section} (${list.length})`}), ...list.map(one => this.line(one))));
    document.getElementById("filter").addEventListener("input", event => this.filter(event.target.value));
    const notes = app.data.notes.map(([entry, reason]) => element("div", {textContent: `not drawn: ${entry}: ${reason}`}));
    const lines = app.data.by_lines.map(([entry, reason]) => element("div", {textContent: `drawn as lines between its interfaces: ${entry}: ${reason}`}));
    document.getElementById("notes").append(...notes, ...lines);
  }

  line(one) {
    const swatch = element("span", {className: "swatch"}), eye = element("button", {className: "eye", title: "show or hide", textContent: "\u25C9"});
    swatch.style.background = one.colour;
    const mark = element("span", {className: "mark"}), facts = this.facts(one.entry);
    mark.textContent = [["gap", facts.gap], ["tilt", facts.tilt], ["redundant", facts.redundant]].filter(([, value]) => value).map(([name]) => name).join(", ");
    mark.title = markSentences(facts).join("\n");
    const line = element("div", {className: "entry", title: one.entry}, swatch, element("span", {className: "name", textContent: one.entry.slice(one.entry.indexOf("/") + 1)}),
                         mark, element("span", {className: "type", textContent: one.type}), eye);
    line.addEventListener("click", () => this.app.entries.choose(one.entry));
    eye.addEventListener("click", event => { event.stopPropagation(); this.app.entries.toggle(one.entry, "hidden"); });
    this.lines.set(one.entry, line);
    return line;
  }

  facts(entry) {
    for (const sequence of this.app.data.runs[0].sequences) if (sequence.marks[entry]) return sequence.marks[entry];
    return {};
  }

  filter(text) {
    const wanted = text.toLowerCase();
    for (const [entry, line] of this.lines) line.style.display = entry.toLowerCase().includes(wanted) || (this.app.entries.known.get(entry).type || "").includes(wanted) ? "" : "none";
  }

  refresh() {
    for (const [entry, line] of this.lines) {
      line.classList.toggle("hidden", this.app.entries.hidden(entry));
      line.classList.toggle("chosen", this.app.entries.chosen === entry);
    }
    const line = this.lines.get(this.app.entries.chosen);
    if (line) line.scrollIntoView({block: "nearest"});
  }
}
