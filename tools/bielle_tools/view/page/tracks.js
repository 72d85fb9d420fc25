// Motion of the bones: 16-bit numbers, interpolated between rows.

class Tracks {
  constructor(description, arrays) {
    this.count = description.count;
    this.rows = description.rows;
    this.data = description.data ? arrays.at(description.data) : new Int16Array(0);
    this.low = description.low ? arrays.at(description.low) : new Float32Array(0);
    this.step = description.step ? arrays.at(description.step) : new Float32Array(0);
    this.poses = new Float32Array(8 * this.count);  // x y z stretch, w x y z
    this.rests = new Map(description.rests);  // from a track whose deformation is magnified to that of its pose at rest
    this.other = new Float32Array(8);
  }

  /// One number of a pose at a row.
  value(track, k, row) {
    const whole = this.data[(8 * track + k) * this.rows + row];
    return k < 4 ? this.low[4 * track + k] + this.step[4 * track + k] * (whole + 32767) : whole / 32767;
  }

  missing(track, row) { return this.data[(8 * track + 4) * this.rows + row] === -32768; }

  /// Pose (8) of a track at a place between rows; amplitude: share of the way from the pose of the row `rest`;
  /// magnify: factor of the deformation of beams.
  pose(track, place, out, start, rest = -1, amplitude = 1, magnify = 1) {
    const row = Math.min(Math.floor(place), this.rows - 1), next = Math.min(row + 1, this.rows - 1), share = place - row;
    if (!this.rows || this.missing(track, row) || share > 0 && this.missing(track, next)) { out.fill(NaN, start, start + 8); return; }
    for (let k = 0; k < 8; k++) {
      const a = this.value(track, k, row);
      out[start + k] = share > 0 ? a + share * (this.value(track, k, next) - a) : a;
      if (rest >= 0) { const r = this.value(track, k, rest); out[start + k] = r + amplitude * (out[start + k] - r); }
    }
    const n = Math.hypot(out[start + 4], out[start + 5], out[start + 6], out[start + 7]) || 1;
    for (let k = 4; k < 8; k++) out[start + k] /= n;
    if (magnify === 1 || !this.rests.has(track)) return;
    this.pose(this.rests.get(track), place, this.other, 0);
    this.magnify(out, start, magnify);
  }

  move(place, rest, amplitude, magnify = 1) {
    for (let track = 0; track < this.count; track++) this.pose(track, place, this.poses, 8 * track, rest, amplitude, magnify);
  }

  /// A pose moves away from `other`: its displacement and its rotation vector relative to it times a factor.
  magnify(p, a, factor) {
    const o = this.other, [w, x, y, z] = o.subarray(4), [W, X, Y, Z] = p.subarray(a + 4, a + 8);
    for (let k = 0; k < 3; k++) p[a + k] = o[k] + factor * (p[a + k] - o[k]);
    let r = [w * W + x * X + y * Y + z * Z, w * X - x * W - y * Z + z * Y, w * Y + x * Z - y * W - z * X, w * Z - x * Y + y * X - z * W];
    if (r[0] < 0) r = r.map(v => -v);
    const s = Math.hypot(r[1], r[2], r[3]), half = factor * Math.atan2(s, r[0]), c = Math.cos(half), [i, j, k] = r.slice(1).map(v => s > 0 ? v / s * Math.sin(half) : 0);
    p.set([w * c - x * i - y * j - z * k, w * i + x * c + y * k - z * j, w * j - x * k + y * c + z * i, w * k + x * j - y * i + z * c], a + 4);
  }
}
