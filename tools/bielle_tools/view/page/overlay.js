// Texts over the picture: labels of entries, the axes, the step of the grid, the colour scale.

const MOST_LABELS = 400;

class Overlay {
  constructor(app) {
    this.app = app;
    this.canvas = document.getElementById("overlay");
    this.pen = this.canvas.getContext("2d");
    this.legend = document.getElementById("legend");
  }

  draw() {
    const stage = document.getElementById("stage"), ratio = window.devicePixelRatio || 1, [w, h] = [stage.clientWidth, stage.clientHeight], pen = this.pen;
    const s = this.app.settings, moving = s.labels || this.app.entries.chosen, key = JSON.stringify([w, h, ratio, s.grid, this.app.camera.saved()]);
    this.scale();
    if (!moving && key === this.drawnOf) return;  // nothing has changed
    this.drawnOf = moving ? null : key;
    if (this.canvas.width !== Math.round(w * ratio) || this.canvas.height !== Math.round(h * ratio))
      [this.canvas.width, this.canvas.height] = [Math.round(w * ratio), Math.round(h * ratio)];
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, w, h);
    pen.font = "12px system-ui, 'DejaVu Sans', sans-serif";
    this.triad(h);
    if (moving) this.labels();
    if (s.grid) {
      pen.fillStyle = "#6b7685";
      pen.textAlign = "right";
      pen.fillText(`grid ${shown(this.app.surroundings.step)} m`, w - 10, h - 10);
    }
  }

  triad(h) {
    const [right, up, back] = this.app.camera.axes(), pen = this.pen, origin = [42, h - 36];
    const axes = [0, 1, 2].map(k => ({k, x: right[k], y: up[k], z: back[k]})).sort((a, b) => a.z - b.z);
    pen.textAlign = "center";
    for (const {k, x, y} of axes) {
      pen.strokeStyle = pen.fillStyle = ["#c0392b", "#2e8b57", "#2f6fb2"][k];
      pen.lineWidth = 2;
      pen.beginPath();
      pen.moveTo(...origin);
      pen.lineTo(origin[0] + 24 * x, origin[1] - 24 * y);
      pen.stroke();
      if (Math.hypot(x, y) > 0.15) pen.fillText("xyz"[k], origin[0] + 32 * x, origin[1] - 32 * y + 4);
    }
    const g = this.app.data.gravity;
    if (!g) return;
    const n = Math.hypot(...g), [x, y] = [dot(g, right) / n, dot(g, up) / n];
    if (Math.hypot(x, y) < 0.2) return;
    pen.strokeStyle = pen.fillStyle = "#56606e";
    const [from, to] = [[92 - 16 * x, origin[1] - 6 + 16 * y], [92 + 16 * x, origin[1] - 6 - 16 * y]], s = [-y, -x];
    pen.beginPath();
    pen.moveTo(...from);
    pen.lineTo(...to);
    pen.stroke();
    pen.beginPath();
    pen.moveTo(to[0] + 4 * x, to[1] - 4 * y);
    pen.lineTo(to[0] - 4 * x + 4 * s[0], to[1] + 4 * y + 4 * s[1]);
    pen.lineTo(to[0] - 4 * x - 4 * s[0], to[1] + 4 * y - 4 * s[1]);
    pen.fill();
    pen.fillText("g", 106, origin[1]);
  }

  labels() {
    const {entries, shown, settings, camera} = this.app, taken = [], pen = this.pen;
    const wanted = settings.labels ? entries.all.map(one => one.entry) : [];
    if (entries.chosen) wanted.unshift(entries.chosen);
    let count = 0;
    pen.textAlign = "left";
    for (const entry of wanted) {
      if (count > MOST_LABELS) break;
      const p = entries.hidden(entry) || settings.groups[entries.known.get(entry).group] === false ? null : shown.anchor(entry);
      if (!p) continue;
      const follow = this.app.following(), [x, y, before] = camera.pixels(p), text = entry.slice(entry.indexOf("/") + 1), width = pen.measureText(text).width;
      if (!before || x < 0 || y < 0 || x > this.canvas.clientWidth || y > this.canvas.clientHeight) continue;
      const box = [x + 7, y - 15, x + 13 + width, y + 2];
      if (taken.some(t => box[0] < t[2] && box[2] > t[0] && box[1] < t[3] && box[3] > t[1])) continue;
      taken.push(box);
      count++;
      pen.fillStyle = entry === entries.chosen ? "#ffe9b8e8" : "#ffffffd0";
      pen.fillRect(box[0], box[1], box[2] - box[0], box[3] - box[1]);
      pen.fillStyle = "#1f2530";
      pen.fillText(text, x + 10, y - 3);
      pen.beginPath();
      pen.arc(x, y, 2, 0, 7);
      pen.fill();
    }
  }

  scale() {
    const s = this.app.settings, range = this.app.stressRange();
    this.legend.hidden = !range;
    if (!range) return;
    const key = `${s.stress} ${range.join()} ${s.magnify}`;
    if (key === this.legendOf) return;
    this.legendOf = key;
    const bar = element("div", {className: "bar"});
    bar.style.background = `linear-gradient(to top, ${this.app.data.colours.join()})`;
    const numbers = [1, 0.75, 0.5, 0.25, 0].map(share => element("span", {textContent: shown(1e-6 * (range[0] + share * (range[1] - range[0])), 3)}));
    this.legend.replaceChildren(bar, element("div", {className: "numbers"}, ...numbers), element("div", {}, STRESSES[s.stress], element("br"), "[MPa]"));
  }
}
