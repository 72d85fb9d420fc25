// The chosen entry: name, type, keys, facts, values now; what can be done with it.

class Details {
  constructor(app) {
    this.app = app;
    this.box = document.getElementById("details");
    this.cells = [];
  }

  show(entry) {
    this.cells = [];
    this.box.hidden = !entry;
    if (!entry) return;
    const {app} = this, one = app.entries.known.get(entry), point = app.entries.point, close = element("button", {className: "close", textContent: "\u00D7"});
    close.addEventListener("click", () => app.entries.choose(null));
    this.box.replaceChildren(close, element("h2", {textContent: entry}), element("div", {textContent: one ? one.type : ""}), this.actions(entry));
    for (const said of markSentences(app.shown.sequence.marks[entry] || {})) this.box.append(element("div", {className: "mark", textContent: said}));
    this.table(app.data.runs[0].keys[entry] || []);
    this.values(entry, point);
    this.refresh();
  }

  actions(entry) {
    const {app} = this, state = app.entries.state(entry);
    const actions = [["hide", state.hidden, () => app.entries.toggle(entry, "hidden")], ["isolate", app.entries.isolated === entry, () => app.entries.isolate(entry)],
                     ["transparent", state.faint, () => app.entries.toggle(entry, "faint")], ["follow", app.follow === entry, () => app.followEntry(entry)],
                     ["trace", app.traces.has(entry), () => app.traces.toggle(entry, app.entries.point)]];
    return element("div", {className: "group"}, ...actions.map(([name, on, what]) => {
      const button = element("button", {textContent: name, className: on ? "on" : ""});
      button.addEventListener("click", () => { what(); this.show(entry); });
      return button;
    }));
  }

  table(rows) {
    if (!rows.length) return;
    this.box.append(element("table", {}, ...rows.map(([key, value]) => element("tr", {}, element("td", {textContent: key}), element("td", {textContent: value})))));
  }

  values(entry, point) {
    const {app} = this, table = element("table"), line = (name, value, what) => {
      const cell = element("td", {className: "value"}), row = element("tr", {}, element("td", {textContent: name}), cell);
      if (what) {
        row.className = "plottable";
        row.title = "click: plot it";
        row.addEventListener("click", what);
      }
      this.cells.push([cell, value]);
      table.append(row);
    };
    if (point && point.world && point.shown === app.shown) {
      line("point", () => app.real(app.pointNow(point)).map(x => shown(x)).join(", ") + " m");
      if (point.cell >= 0) line("stress here", () => { const stress = app.shown.stresses.at(point.cell); return stress === null ? "-" : `${shown(1e-6 * stress)} MPa`; });
      if (point.flexible && point.node >= 0) line(`mesh node ${point.node}`, () => app.settings.stress !== "none" && point.flexible.body.stress ? `${shown(1e-6 * point.flexible.values[point.corner])} MPa` : "-");
    }
    app.quantities.of(entry).forEach(quantity => quantity.columns.forEach((column, k) => line(
      `${quantity.name}${column ? " " + column : ""}`, () => `${shown(app.quantities.now(quantity, k))} ${quantity.unitsOf(k)}`, () => app.plot.toggle(quantity, k))));
    this.box.append(table);
  }

  /// Writes the values of this moment.
  refresh() { for (const [cell, value] of this.cells) cell.textContent = value(); }
}
