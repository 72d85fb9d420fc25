// Runs and their sequences as drawn: the first run in full, others as ghosts over it.

const GHOSTS = ["#3b78c9", "#c95a3b", "#5b9a3b", "#8a4fb0"];

/// One sequence of one run, with all of its objects.
class Shown {
  constructor(app, run, sequence, number) {
    const arrays = app.arrays, layout = app.data.layouts[sequence.layout], scene = sequence.scene;
    Object.assign(this, {app, run, sequence, number, layout, times: arrays.at(sequence.times)});
    this.tracks = new Tracks(scene.tracks, arrays);
    this.stresses = new BeamStresses(scene.stressed, sequence.rows, arrays);
    this.batch = new Batch(layout, arrays, this.tracks, this.stresses, app.scaleTexture);
    this.flexible = scene.flexible.map(d => new Flexible(d, app.body(d.body), arrays, this.tracks, app.scaleTexture));
    this.arrows = new Arrows(number ? [] : scene.arrows, arrays);
    this.group = new THREE.Group();
    this.group.add(this.batch.group, ...this.flexible.map(f => f.mesh), this.arrows.group);
    this.rest = sequence.kind === "mode" ? sequence.rows - 1 : -1;
  }

  move(place, amplitude) {
    const s = this.app.settings;
    this.place = place;
    this.tracks.move(place, this.rest, amplitude, s.magnify);
    this.batch.moved();
    this.stresses.move(place, s.stress);
    for (const f of this.flexible) f.move(place, this.rest, amplitude, s.magnify, s.stress);
    this.arrows.move(place, s.arrows, s.arrowScale, entry => this.app.entries.hidden(entry));
  }

  /// All that stresses colour: {largest, extremes(), range}.
  stressed() {
    const beams = this.stresses.largest > 0 ? [{largest: this.stresses.largest, extremes: () => this.stresses.extremes(), range: this.batch.range}] : [];
    return [...beams, ...this.flexible.filter(f => f.body.stress).map(f => ({largest: f.part.largest || 0, extremes: () => f.extremes(), range: f.range}))];
  }

  paint() {
    this.batch.paint(part => this.look(part));
    for (const f of this.flexible) {
      f.look.set(...this.look(f.part));
      f.mesh.material.transparent = f.look.w < CLEAR;
      f.mesh.material.depthWrite = f.look.w >= CLEAR;
      f.mesh.renderOrder = f.look.w < CLEAR ? 1 : 0;
    }
  }

  look(part) {
    const marks = this.sequence.kind === "state" && this.sequence.marks[part.entry];  // of a model that was only assembled
    const colour = new THREE.Color(marks ? part.marked : this.app.colours ? part.muted : part.colour), state = this.app.entries.state(part.entry), s = this.app.settings;
    let opacity = part.opacity;
    if (this.app.entries.hidden(part.entry) || s.groups[part.group] === false) opacity = 0;
    if (state.faint) opacity *= 0.25;
    if (this.number) { colour.lerp(new THREE.Color(GHOSTS[(this.number - 1) % GHOSTS.length]), 0.75); opacity *= s.ghost; }
    if (this.app.entries.chosen === part.entry) colour.lerp(new THREE.Color("#ffb000"), 0.6);
    return [colour.r, colour.g, colour.b, opacity];
  }

  /// Position of the label of an entry now, or null.
  anchor(entry) {
    this.anchors = this.anchors || new Map(this.layout.anchors.map(a => [a.entry, a]));
    const a = this.anchors.get(entry);
    if (!a) return null;
    const track = a.flexible === undefined ? a.track : this.flexible[a.flexible].part.track;
    const p = placed(this.tracks.poses, 8 * track, a.point);
    return Number.isFinite(p[0]) ? p : null;
  }

  dispose() {
    this.app.scene.remove(this.group);
    this.group.traverse(object => { if (object.geometry) object.geometry.dispose(); if (object.material) object.material.dispose(); });
    this.batch.bones.texture.dispose();
    this.batch.looks.texture.dispose();
    this.stresses.table.texture.dispose();
  }
}

/// Place between the rows of a sequence at a time; times ascend.
function placeAt(times, t) {
  if (times.length < 2 || t <= times[0]) return 0;
  if (t >= times[times.length - 1]) return times.length - 1;
  let low = 0, high = times.length - 1;
  while (high - low > 1) { const middle = (low + high) >> 1; if (times[middle] <= t) low = middle; else high = middle; }
  return low + (t - times[low]) / ((times[high] - times[low]) || 1);
}
