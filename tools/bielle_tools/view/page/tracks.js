// Motion of the bones: 16-bit numbers, interpolated between rows.

class Tracks {
  constructor(description, arrays) {
    this.count = description.count;
    this.rows = description.rows;
    this.data = description.data ? arrays.at(description.data) : new Int16Array(0);
    this.low = description.low ? arrays.at(description.low) : new Float32Array(0);
    this.step = description.step ? arrays.at(description.step) : new Float32Array(0);
    this.poses = new Float32Array(8 * this.count);  // x y z stretch, w x y z
  }

  /// One number of a pose at a row.
  value(track, k, row) {
    const whole = this.data[(8 * track + k) * this.rows + row];
    return k < 4 ? this.low[4 * track + k] + this.step[4 * track + k] * (whole + 32767) : whole / 32767;
  }

  missing(track, row) { return this.data[(8 * track + 4) * this.rows + row] === -32768; }

  /// Pose (8) of a track at a place between rows; amplitude: share of the way from the pose of the row `rest`.
  pose(track, place, out, start, rest = -1, amplitude = 1) {
    const row = Math.min(Math.floor(place), this.rows - 1), next = Math.min(row + 1, this.rows - 1), share = place - row;
    if (!this.rows || this.missing(track, row) || share > 0 && this.missing(track, next)) { out.fill(NaN, start, start + 8); return; }
    for (let k = 0; k < 8; k++) {
      const a = this.value(track, k, row);
      out[start + k] = share > 0 ? a + share * (this.value(track, k, next) - a) : a;
      if (rest >= 0) { const r = this.value(track, k, rest); out[start + k] = r + amplitude * (out[start + k] - r); }
    }
    const n = Math.hypot(out[start + 4], out[start + 5], out[start + 6], out[start + 7]) || 1;
    for (let k = 4; k < 8; k++) out[start + k] /= n;
  }

  move(place, rest, amplitude) {
    for (let track = 0; track < this.count; track++) this.pose(track, place, this.poses, 8 * track, rest, amplitude);
  }
}
