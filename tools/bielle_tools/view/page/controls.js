// Buttons, options and keys.

const HELP = [["space", "play, pause"], ["\u2190 \u2192", "one step"], ["Home End", "first, last"], ["+ \u2212", "faster, slower"], ["L", "loop"], ["I X Y Z", "views"], ["O", "orthogonal or perspective"],
              ["F", "all in the picture"], ["N", "names"], ["G", "grid"], ["H", "hide the chosen entry"], ["A", "show everything"], ["Esc", "choose nothing"]];

class Controls {
  constructor(app) {
    this.app = app;
    this.views();
    this.switches();
    this.help();
    document.addEventListener("keydown", event => this.key(event));
  }

  views() {
    const box = document.getElementById("views"), button = (name, title, what) => {
      const found = element("button", {textContent: name, title});
      found.addEventListener("click", what);
      box.append(found);
      return found;
    };
    for (const name of ["iso", "x", "y", "z"]) button(name, `view ${name}`, () => this.app.camera.view(name));
    this.ortho = button("orthogonal", "orthogonal or perspective (O)", () => this.toggleOrtho());
    button("fit", "all in the picture (F)", () => this.app.camera.fit());
  }

  toggleOrtho() { this.app.camera.ortho = !this.app.camera.ortho; this.refresh(); this.app.changed(); }

  switches() {
    const box = document.getElementById("switches"), s = this.app.settings;
    this.buttons = [["tree", "the list of entries", () => document.getElementById("tree").classList.toggle("away", !(s.tree = !s.tree))], ["names", "labels (N)", () => { s.labels = !s.labels; }],
                    ["grid", "the grid (G)", () => { s.grid = !s.grid; }], ["plots", "the plot", () => document.getElementById("plots").classList.toggle("away", !(s.plots = !s.plots))]];
    for (const each of this.buttons) {
      const [name, title, what] = each, found = element("button", {textContent: name, title});
      found.addEventListener("click", () => { what(); this.refresh(); this.app.resize(); });
      box.append(found);
      each.push(found);
    }
  }

  refresh() {
    const s = this.app.settings, on = {tree: s.tree, names: s.labels, grid: s.grid, plots: s.plots};
    for (const [name, , , button] of this.buttons) button.classList.toggle("on", on[name]);
    this.ortho.classList.toggle("on", this.app.camera.ortho);
  }

  /// Options that suit the sequence that is shown.
  reset() {
    const {app} = this, s = app.settings, box = document.getElementById("options"), found = [], flexible = app.allShown.flatMap(each => each.flexible);
    const solids = flexible.some(f => f.body.stress), stresses = solids ? Object.keys(STRESSES) : app.allShown.some(each => each.stressed().length) ? EQUIVALENT : [];
    if (stresses.length) found.push(this.choice("stress", Object.fromEntries(stresses.map(key => [key, STRESSES[key]])), s.stress, value => { s.stress = value; }));
    if (flexible.length || app.allShown.some(each => each.tracks.rests.size)) found.push(this.slide("deformation", 0, 3, Math.log10(s.magnify), x => { s.magnify = Number((10 ** x).toPrecision(2)); return `x ${s.magnify}`; }));
    if (app.shown.sequence.kind === "mode") {
      found.push(this.slide("amplitude", -1.5, 1.5, Math.log10(s.amplitude), x => { s.amplitude = Number((10 ** x).toPrecision(2)); return `x ${s.amplitude}`; }));
      if (app.shown.sequence.decay) found.push(this.check("with its decay", s.decay, on => { s.decay = on; app.player.cycles = 0; }));
    }
    for (const kind of app.shown.arrows.kinds) found.push(this.check(`${kind}, up to ${shown(app.shown.arrows.largest(kind), 3)} ${kind === "velocities" ? "m/s" : "N"}`, s.arrows.has(kind), on => { s.arrows[on ? "add" : "delete"](kind); }, ARROW_COLOURS[kind]));
    if (app.shown.arrows.kinds.length) found.push(this.slide("arrows", -1, 1.5, Math.log10(s.arrowScale), x => { s.arrowScale = Number((10 ** x).toPrecision(2)); return `x ${s.arrowScale}`; }));
    const groups = new Set(app.entries.all.map(one => one.group));
    if (groups.size > 1) found.push(element("details", {}, element("summary", {textContent: "show"}), ...[...groups].map(group => this.check(
      {body: "bodies", beam: "beams", joint: "joints", spring: "springs, dampers", rope: "ropes", contact: "contacts", node: "nodes", ground: "supports, planes", force: "loads"}[group] || group,
      s.groups[group] !== false, on => { s.groups[group] = on; app.repaint(); }))));
    if (app.allShown.length > 1) found.push(this.slide("other runs", 0, 1, s.ghost, x => { s.ghost = x; app.repaint(); return `${Math.round(100 * x)} %`; }));
    box.replaceChildren(...found);
    this.refresh();
  }

  choice(name, values, value, what) {
    const select = element("select", {}, ...Object.entries(values).map(([key, text]) => element("option", {value: key, textContent: text || "none"})));
    select.value = value;
    select.addEventListener("change", () => { what(select.value); this.app.moved(); });
    return element("label", {}, name, select);
  }

  slide(name, min, max, value, what) {
    const input = element("input", {type: "range", min, max, step: "any", value}), text = element("span", {textContent: what(value)});
    input.addEventListener("input", () => { text.textContent = what(Number(input.value)); this.app.moved(); });
    return element("label", {}, name, input, text);
  }

  check(name, on, what, colour) {
    const input = element("input", {type: "checkbox", checked: on}), text = element("span", {textContent: name});
    if (colour) text.style.color = colour;
    input.addEventListener("change", () => { what(input.checked); this.app.moved(); });
    return element("label", {style: "justify-content: flex-start"}, input, text);
  }

  help() {
    const box = document.getElementById("help"), e = this.app.data.errors;
    box.append(element("table", {}, ...HELP.map(([key, text]) => element("tr", {}, element("td", {}, element("kbd", {textContent: key})), element("td", {textContent: text})))),
               element("p", {textContent: "Mouse: turn; right button or Shift: move; wheel: nearer, farther; click: identify."}),
               element("p", {textContent: `Numbers have 16 bits: positions to ${e.position.toExponential(1)} of the size, rotations to ${e.rotation.toExponential(1)} rad, ` +
                 `deformations to ${e.shape.toExponential(1)} of the size, stresses to ${e.stress.toExponential(1)} of the largest.`}),
               ...this.app.data.runs.filter(run => run.created_by).map(run => element("p", {textContent: `${run.name}: computed by ${run.created_by}.`})));
    document.getElementById("help-button").addEventListener("click", () => { box.hidden = !box.hidden; });
  }

  key(event) {
    if (["SELECT", "TEXTAREA"].includes(event.target.tagName) || event.target.type === "search" || event.ctrlKey || event.metaKey || event.altKey) return;
    const {app} = this, {player, settings: s} = app, faster = by => {
      const select = document.getElementById("speed");
      player.speed = SPEEDS[clamp(SPEEDS.indexOf(player.speed) + by, 0, SPEEDS.length - 1)];
      select.value = player.speed;
    };
    const chosen = app.entries.chosen;
    const keys = {" ": () => player.toggle(), ArrowLeft: () => player.step(-1), ArrowRight: () => player.step(1), Home: () => player.go(0), End: () => player.go(player.last),
                  "+": () => faster(1), "-": () => faster(-1), l: () => { player.loop.checked = !player.loop.checked; }, i: () => app.camera.view("iso"), x: () => app.camera.view("x"),
                  y: () => app.camera.view("y"), z: () => app.camera.view("z"), o: () => this.toggleOrtho(), f: () => app.camera.fit(), n: () => { s.labels = !s.labels; },
                  g: () => { s.grid = !s.grid; }, h: () => { if (chosen) app.entries.toggle(chosen, "hidden"); }, a: () => app.entries.showAll(), Escape: () => app.entries.choose(null)};
    const what = keys[event.key] || keys[event.key.toLowerCase()];
    if (!what) return;
    event.preventDefault();
    what();
    this.refresh();
    app.changed();
  }
}
