// The application: loads the data, shows a sequence of each run, draws when something changed.

class App {
  constructor(data, arrays) {
    Object.assign(this, {data, arrays, bodies: [], allShown: [], follow: null, dirty: true, number: 0, frames: 0});
    this.settings = {stress: "none", magnify: 1, amplitude: 1, decay: false, arrows: new Set(), arrowScale: 1, groups: {}, ghost: 0.4, labels: false, grid: true, tree: true, plots: true};
    this.quality = new Quality(this);
    const canvas = document.getElementById("scene"), options = {alpha: true, antialias: !this.quality.software};
    this.renderer = new THREE.WebGLRenderer({canvas, context: canvas.getContext("webgl2", options) || canvas.getContext("webgl", options) || undefined});
    this.renderer.setClearColor(0x000000, 0);
    this.scene = new THREE.Scene();
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x9099a5, 1.05));
    this.scaleTexture = scaleTexture(data.colours);
    this.surroundings = new Surroundings(this);
    this.traces = new Traces(this);
    this.scene.add(this.surroundings.group, this.traces.group);
    this.entries = new Entries(this);
    this.quantities = new Quantities(this);
    this.player = new Player(this);
    this.camera = new Camera(this);
    this.picking = new Picking(this);
    this.overlay = new Overlay(this);
    this.details = new Details(this);
    this.plot = new Plot(this);
    this.tree = new Tree(this);
    this.controls = new Controls(this);
    this.chooser();
    this.show(0);
    new ResizeObserver(() => {
      this.resize();
      if (!this.camera.touched && !this.following()) this.camera.fit();
    }).observe(document.getElementById("stage"));
  }

  /// Points of all that moves, over the sequence: some of each part at some rows.
  extent() {
    const {shown} = this, rows = shown.sequence.rows, picked = [...new Set([0, 1, 2, 3, 4, 5, 6, 7].map(k => Math.round(k / 7 * (rows - 1))))], points = [], before = shown.place;
    const b = shown.batch, corners = [], counts = new Uint32Array(b.parts.length);
    for (const owner of b.owners) counts[owner]++;
    b.owners.forEach((owner, k) => { if (!b.parts[owner].endless && k % Math.ceil(counts[owner] / 40) === 0) corners.push(k); });
    const every = Math.ceil(corners.length / 4000), all = p => { if (Number.isFinite(p[0])) points.push(p); };
    for (const f of shown.flexible) f.detail(f.body.sampled.cell);
    for (const row of picked) {
      shown.move(row, this.amplitude());
      for (let k = 0; k < corners.length; k += every) all(b.corner(corners[k]));
      for (const f of shown.flexible) for (let k = 0, n = f.body.sampled.count; k < n; k += Math.ceil(n / 100)) all(f.corner(k));
    }
    if (before !== undefined) this.moved();
    this.quality.refine();
    return points;
  }

  body(number) { return this.bodies[number] = this.bodies[number] || new Body(this.data.bodies[number], this.arrays); }
  get shown() { return this.allShown[0]; }

  chooser() {
    const select = document.getElementById("sequence"), list = this.data.runs[0].sequences;
    select.append(...list.map((sequence, k) => element("option", {value: k, textContent: sequence.title})));
    select.hidden = list.length < 2;
    select.addEventListener("change", () => this.show(Number(select.value)));
    if (this.data.runs.length > 1) document.getElementById("title").textContent = this.data.runs.map(run => run.name).join(", ");
  }

  /// Shows a sequence of the first run, and the sequences of the same number of the others.
  show(number) {
    for (const each of this.allShown) each.dispose();
    this.number = number;
    this.player.pause();
    this.allShown = this.data.runs.filter(run => run.sequences.length > number).map((run, k) => new Shown(this, run, run.sequences[number], k));
    for (const each of this.allShown) this.scene.add(each.group);
    document.getElementById("sequence").value = number;
    this.verdict();
    this.player.cycles = 0;
    this.player.reset();
    this.ranges = {};
    this.entries.point = null;
    this.traces.rebuild();
    this.controls.reset();
    this.plot.reset();
    this.repaint();
    this.details.show(this.entries.chosen);
    this.moved();
    if (!this.camera.touched) this.camera.fit();
  }

  /// Sentences on a model that was only checked, of all runs.
  verdict() {
    const box = document.getElementById("verdict"), several = this.allShown.length > 1;
    box.replaceChildren(...this.allShown.flatMap(each => each.sequence.said.map(text => element("div", {textContent: several ? `${each.run.name}: ${text}` : text}))));
    box.className = this.allShown.some(each => each.sequence.failed) ? "failed" : "";
    box.hidden = !box.children.length;
  }

  /// Amplitude of a mode: with its decay since it was started if that is wanted.
  amplitude() {
    const {settings: s, player} = this, decay = this.shown.sequence.decay;
    return s.amplitude * (s.decay && decay ? Math.exp(clamp(decay * (player.cycles + player.place / (player.last || 1)), -20, 1)) : 1);
  }

  moved() {
    const {player} = this;
    for (const each of this.allShown) {
      let place = player.place;
      if (each.number) place = player.byTime && each.sequence.kind === "time" ? placeAt(each.times, player.time()) : place / (player.last || 1) * (each.sequence.rows - 1);
      each.move(this.placeIn(each, place), this.amplitude());
    }
    const coloured = Boolean(this.colours);
    this.range();
    if (coloured !== Boolean(this.colours)) for (const each of this.allShown) each.paint();
    document.getElementById("moment").textContent = player.moment();
    player.slider.value = player.toShare(player.place);
    this.details.refresh();
    this.plot.refresh();
    this.changed();
  }

  /// The last phase of a mode is its first.
  placeIn(each, place) { return each.rest >= 0 && place >= each.rest ? place - each.rest : each.rest >= 0 && place > each.rest - 1 ? each.rest - 1 : place; }

  /// Colours of stresses cover the largest von Mises stress over time, or the extremes of the moments that were shown.
  range() {
    const {stress} = this.settings, all = this.allShown.flatMap(each => each.stressed());
    this.colours = null;
    for (const each of all) each.range.set(0, 0);
    if (stress === "none" || !all.length) return;
    let [low, high] = this.ranges[stress] || [0, 0];
    if (stress === "von_mises" || stress === "peak") high = Math.max(...all.map(each => each.largest));
    if (!["von_mises", "peak"].includes(stress) || !(high > 0)) for (const each of all) { const [a, b] = each.extremes(); low = Math.min(low, a); high = Math.max(high, b); }
    this.colours = this.ranges[stress] = [low, high];
    for (const each of all) each.range.set(low, high);
  }

  stressRange() { return this.colours; }
  changed() { this.dirty = true; }

  repaint() {
    for (const each of this.allShown) each.paint();
    this.tree.refresh();
    if (this.shown.place !== undefined) this.moved();
  }

  followEntry(entry) {
    this.follow = this.follow === entry ? null : entry;
    const p = this.following();
    if (p) this.camera.target = [0, 0, 0];
    else this.camera.fit();
    this.changed();
  }

  following() { return this.follow ? this.shown.anchor(this.follow) : null; }
  real(p) { return p.map((x, k) => x * this.data.size + this.data.centre[k]); }

  pointNow(point) { return point.flexible ? point.flexible.corner(point.corner) : placed(this.shown.tracks.poses, 8 * point.track, point.local); }

  resize() {
    const stage = document.getElementById("stage");
    this.renderer.setPixelRatio(this.quality.ratio);
    this.renderer.setSize(stage.clientWidth, stage.clientHeight, false);
    this.changed();
  }

  render() {
    this.camera.place(this.following());
    this.renderer.render(this.scene, this.camera.active);
  }

  draw(now) {
    this.player.advance(now);
    this.quality.adapt(now);
    this.quality.refine();
    if (this.dirty) {
      this.dirty = false;
      this.frames++;
      this.surroundings.group.visible = this.settings.grid;
      this.render();
      this.overlay.draw();
    }
    requestAnimationFrame(time => this.draw(time));
  }
}

async function start() {
  const waiting = document.getElementById("waiting");
  try {
    const data = JSON.parse(new TextDecoder().decode(await inflated("description")));
    const app = new App(data, new Arrays(await inflated("arrays")));
    app.resize();
    if (data.live) new Live(app);
    app.draw(performance.now());
    window.bielle = app;
    waiting.remove();
    app.ready = performance.now();
  } catch (error) {
    waiting.textContent = `This page cannot be shown: ${error.message}`;
    throw error;
  }
}

start();
