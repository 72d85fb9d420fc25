// Stresses: their colours, and those of beams, which are recorded for each element.

const STRESSES = {none: "", von_mises: "von Mises", peak: "von Mises, largest over time", largest: "largest principal", least: "least principal",
                  xx: "normal xx", yy: "normal yy", zz: "normal zz", yz: "shear yz", xz: "shear xz", xy: "shear xy"};
const EQUIVALENT = ["none", "von_mises", "peak"];  // those that beams have
const UNSTRESSED = -1e30;

/// A texture of the colours `#rrggbb` from nothing to the largest stress.
function scaleTexture(colours) {
  const data = new Uint8Array(4 * 256), stops = colours.map(text => new THREE.Color(text));
  for (let k = 0; k < 256; k++) {
    const x = k / 255 * (stops.length - 1), i = Math.min(Math.floor(x), stops.length - 2), c = stops[i].clone().lerp(stops[i + 1], x - i);
    data.set([255 * c.r, 255 * c.g, 255 * c.b, 255], 4 * k);
  }
  const texture = new THREE.DataTexture(data, 256, 1, THREE.RGBAFormat);
  texture.minFilter = texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/// Stresses of the elements of all beams of a sequence, one number in a texture for each.
class BeamStresses {
  constructor(descriptions, rows, arrays) {
    this.rows = rows;
    this.beams = descriptions.map(d => ({...d, values: arrays.at(d.values)}));
    this.largest = this.beams.reduce((most, beam) => Math.max(most, beam.largest), 0);
    this.table = table(this.beams.reduce((sum, beam) => sum + beam.count, 0));
  }

  move(place, kind) {
    const row = Math.min(Math.floor(place), this.rows - 1), next = Math.min(row + 1, this.rows - 1), share = place - row;
    let cell = 0;
    for (const beam of this.beams)
      for (let k = 0; k < beam.count; k++, cell++) {
        const own = beam.values.subarray(this.rows * k, this.rows * (k + 1));
        this.table.data[4 * cell] = kind === "peak" ? this.stress(own.reduce((a, b) => Math.max(a, b), -1), beam) : kind !== "von_mises" || own[row] < 0 || share > 0 && own[next] < 0
          ? UNSTRESSED : this.stress(own[row] + share * (own[next] - own[row]), beam);
      }
    if (cell) this.table.texture.needsUpdate = true;
  }

  stress(number, beam) { return number < 0 ? UNSTRESSED : number * beam.step; }

  /// Stress of a cell now [Pa], or null.
  at(cell) { return cell < 0 || this.table.data[4 * cell] <= UNSTRESSED ? null : this.table.data[4 * cell]; }

  extremes() {
    let low = Infinity, high = -Infinity;
    for (let k = 0; k < this.table.data.length; k += 4) { const v = this.table.data[k]; if (v > UNSTRESSED) { low = Math.min(low, v); high = Math.max(high, v); } }
    return [low, high];
  }
}
