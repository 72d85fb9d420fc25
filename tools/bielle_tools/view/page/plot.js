// Recorded quantities over time, with a cursor at the moment that is shown; a click goes to a time.

const PLOT_COLOURS = ["#2f6fb2", "#cf3d3d", "#2e8b57", "#8a4fb0", "#c97a00", "#1d8a8a", "#7a5230", "#555f6e"];

/// Units of a column: `N, N m` are those of both halves, of forces and of moments.
function unitsOf({units, columns}, k) {
  const list = units.split(","), each = columns.length / list.length;
  return (Number.isInteger(each) ? list[Math.floor(k / each)] : units).trim();
}

class Quantities {
  constructor(app) { this.app = app; }

  /// The quantities of the sequence that is shown, of a run.
  list(shown = this.app.shown) {
    const q = shown.sequence.quantities;
    if (!q.read) {
      q.read = q.list.map(one => ({...one, values: this.app.arrays.at(one.data), times: this.app.arrays.at(q.times),
        title: one.entry === "energy" || one.entry === "solver" ? `${one.entry}/${one.name}` : one.entry.startsWith("measures/") ? one.entry : `${one.entry}/${one.name}`,
        unitsOf: k => unitsOf(one, k)}));
    }
    return q.read;
  }

  /// Quantities of an entry, also those that are recorded in another section under its name.
  of(entry) {
    const names = [entry, entry.replace(/^joints\//, "contacts/"), entry.replace(/^nodes\//, "supports/")];
    return this.list().filter(one => names.includes(one.entry));
  }

  column(quantity, k) { const n = quantity.times.length; return quantity.values.subarray(k * n, k * n + n); }

  now(quantity, k) {
    const values = this.column(quantity, k), {player, shown} = this.app;
    const at = shown.sequence.kind === "time" ? placeAt(quantity.times, player.time()) : player.place / (player.last || 1) * (values.length - 1);
    const row = Math.floor(at), next = Math.min(row + 1, values.length - 1);
    return values[row] + (at - row) * (values[next] - values[row]);
  }
}

class Plot {
  constructor(app) {
    this.app = app;
    this.series = [];
    this.select = document.getElementById("quantity");
    this.select.addEventListener("change", () => {
      const [title, column] = JSON.parse(this.select.value || "[]"), found = app.quantities.list().find(one => one.title === title);
      if (found) this.toggle(found, column);
      this.select.value = "";
    });
    const cursor = {id: "cursor", afterDraw: chart => {
      const {left, right, top, bottom} = chart.chartArea, x = chart.scales.x.getPixelForValue(this.position());
      if (!(x >= left - 1 && x <= right + 1)) return;
      Object.assign(chart.ctx, {strokeStyle: "#1f2530", lineWidth: 1});
      chart.ctx.beginPath();
      chart.ctx.moveTo(x, top);
      chart.ctx.lineTo(x, bottom);
      chart.ctx.stroke();
    }};
    Chart.defaults.font.size = 11;
    this.chart = new Chart(document.getElementById("plot"), {type: "line", data: {datasets: []}, plugins: [cursor], options: {
      animation: false, parsing: false, normalized: true, maintainAspectRatio: false, events: [], spanGaps: false,
      elements: {point: {radius: 0}, line: {borderWidth: 1.5}}, plugins: {legend: {display: false}, tooltip: {enabled: false}, decimation: {enabled: true}},
      scales: {x: {type: "linear", bounds: "data", ticks: {maxTicksLimit: 12}}, y: {ticks: {maxTicksLimit: 6}}}}});
    const canvas = document.getElementById("plot");
    canvas.addEventListener("pointerdown", event => { this.dragging = true; this.seek(event.offsetX); });
    canvas.addEventListener("pointermove", event => { if (this.dragging && event.buttons) this.seek(event.offsetX); });
    canvas.addEventListener("pointerup", () => { this.dragging = false; });
  }

  /// Abscissa of the cursor: the time, or the number of the row.
  position() { return this.app.player.byTime ? this.app.player.time() : this.app.player.place / (this.app.player.last || 1); }

  seek(pixel) {
    const x = this.chart.scales.x.getValueForPixel(pixel);
    this.app.player.pause();
    if (this.app.player.byTime) this.app.player.seek(x);
    else this.app.player.go(x * this.app.player.last);
  }

  /// Offers the quantities of the sequence that is shown, and keeps the series that it has.
  reset() {
    const list = this.app.quantities.list(), options = [element("option", {value: "", textContent: list.length ? "plot a quantity .." : "no quantities over time"})];
    const groups = new Map();
    for (const one of list) one.columns.forEach((column, k) => {
      const section = one.title.split("/")[0];
      if (!groups.has(section)) groups.set(section, element("optgroup", {label: section}));
      groups.get(section).append(element("option", {value: JSON.stringify([one.title, k]), textContent: `${one.title}${column ? " " + column : ""} [${one.unitsOf(k)}]`}));
    });
    this.select.replaceChildren(...options, ...groups.values());
    if (this.app.shown.sequence.quantities.left_out) this.select.append(element("option", {disabled: true, textContent: `${this.app.shown.sequence.quantities.left_out} more are left out: too many values`}));
    this.series = this.series.filter(({title}) => list.some(one => one.title === title));
    this.refill();
  }

  toggle(quantity, k) {
    const found = this.series.findIndex(one => one.title === quantity.title && one.column === k);
    if (found >= 0) this.series.splice(found, 1);
    else this.series.push({title: quantity.title, column: k});
    this.refill();
  }

  refill() {
    const datasets = [];
    this.series.forEach(({title, column}, i) => this.app.allShown.forEach((shown, run) => {
      const quantity = this.app.quantities.list(shown).find(one => one.title === title);
      if (!quantity || column >= quantity.columns.length) return;
      const values = this.app.quantities.column(quantity, column), byTime = this.app.player.byTime, n = values.length - 1 || 1;
      datasets.push({data: Array.from(values, (y, k) => ({x: byTime ? quantity.times[k] : k / n, y})), borderColor: PLOT_COLOURS[i % PLOT_COLOURS.length], borderDash: run ? [5, 3] : []});
    }));
    this.chart.data.datasets = datasets;
    const units = new Set(this.series.map(({title, column}) => { const one = this.app.quantities.list().find(q => q.title === title); return one ? one.unitsOf(column) : ""; }));
    Object.assign(this.chart.options.scales.y, {title: {display: true, text: units.size === 1 ? `[${[...units][0]}]` : ""}});
    Object.assign(this.chart.options.scales.x, {title: {display: true, text: this.app.player.byTime ? "time [s]" : "share of the load steps"}});
    document.getElementById("plot-box").classList.toggle("away", !datasets.length);
    this.chart.resize();
    this.chart.update("none");
    document.getElementById("series").replaceChildren(...this.series.map((one, i) => {
      const line = element("span", {className: "one", title: "click: take it out"});
      line.style.setProperty("--colour", PLOT_COLOURS[i % PLOT_COLOURS.length]);
      line.addEventListener("click", () => { this.series.splice(i, 1); this.refill(); });
      return line;
    }));
    this.app.resize();
    this.refresh();
  }

  /// Moves the cursor and writes the values of this moment.
  refresh() {
    if (!this.series.length) return;
    this.chart.draw();
    const list = this.app.quantities.list(), lines = document.getElementById("series").children;
    this.series.forEach(({title, column}, i) => {
      const one = list.find(q => q.title === title);
      if (one && lines[i]) lines[i].textContent = `${title}${one.columns[column] ? " " + one.columns[column] : ""} = ${shown(this.app.quantities.now(one, column))} ${one.unitsOf(column)}`;
    });
  }
}
