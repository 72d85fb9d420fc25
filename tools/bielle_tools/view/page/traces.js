// Traces: paths of points over all rows of the sequence.

const TRACE_COLOURS = ["#cf3d3d", "#2f6fb2", "#2e8b57", "#8a4fb0", "#c97a00"];

class Traces {
  constructor(app) {
    this.app = app;
    this.group = new THREE.Group();
    this.wanted = [];
  }

  /// The point that was clicked, or the anchor of an entry.
  toggle(entry, point) {
    const found = this.wanted.findIndex(trace => trace.entry === entry);
    if (found >= 0 && !(point && point.world)) this.wanted.splice(found, 1);
    else {
      if (found >= 0) this.wanted.splice(found, 1);
      this.wanted.push({entry, point});
    }
    this.rebuild();
  }

  has(entry) { return this.wanted.some(trace => trace.entry === entry); }
  clear() { this.wanted = []; this.rebuild(); }

  rebuild() {
    for (const line of this.group.children) { line.geometry.dispose(); line.material.dispose(); }
    this.group.children.length = 0;
    this.wanted.forEach((trace, k) => {
      const points = this.path(trace);
      if (points.length < 6) return;
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(points), 3));
      const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({color: TRACE_COLOURS[k % TRACE_COLOURS.length]}));
      line.frustumCulled = false;
      this.group.add(line);
    });
    this.app.changed();
  }

  path({entry, point}) {
    const shown = this.app.shown, rows = shown.sequence.rows - (shown.rest >= 0 ? 1 : 0), points = [], pose = new Float32Array(8);
    const anchor = shown.layout.anchors.find(a => a.entry === entry), usable = point && point.shown === shown;
    const flexible = usable && point.flexible ? point.flexible : !usable && anchor && anchor.flexible !== undefined ? shown.flexible[anchor.flexible] : null;
    if (!usable && !anchor) return points;
    const track = flexible ? flexible.part.track : usable ? point.track : anchor.track, q = flexible && new Float32Array(flexible.body.count);
    for (let row = 0; row < rows; row++) {
      shown.tracks.pose(track, row, pose, 0, shown.rest, this.app.amplitude(), this.app.settings.magnify);
      let local = usable && !flexible ? point.local : anchor ? anchor.point : [0, 0, 0];
      if (flexible && usable) {
        flexible.coordinates(row, shown.rest, this.app.amplitude(), q);
        local = this.bent(flexible.body, q, point.corner);
      }
      const p = placed(pose, 0, local);
      if (Number.isFinite(p[0])) points.push(...p);
    }
    return points;
  }

  bent(body, q, corner) {
    const n = body.points.length, magnify = this.app.settings.magnify;
    return [0, 1, 2].map(i => {
      let x = body.points[3 * corner + i];
      for (let k = 0; k < q.length; k++) x += magnify * q[k] * body.scale[k] * body.shapes[n * k + 3 * corner + i];
      return x;
    });
  }
}
