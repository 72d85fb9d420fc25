// Flexible bodies: points and stresses as sums of shapes, on the processor. Instances share the shapes of their body.

const COMPONENTS = ["xx", "yy", "zz", "yz", "xz", "xy"];

const ENOUGH = 200;  // points of a level that shows the extent of a body
const INVISIBLE = 2e-7, UNSEEN = 2e-4;  // shares of the size, and of the largest stress, below which a shape is left out

/// out += sum of factors[k] * shapes[k], four shapes at a time, of the first `count` numbers; shapes of n numbers follow each other.
function addShapes(out, shapes, factors, n, count) {
  const used = [];
  for (let k = 0; k < factors.length; k++) if (factors[k] !== 0) used.push(k);
  for (let i = 0; i < used.length; i += 4) {
    const [a, b, c, d] = [0, 1, 2, 3].map(k => shapes.subarray((used[i + k] ?? used[i]) * n, (used[i + k] ?? used[i]) * n + n));
    const [fa, fb, fc, fd] = [0, 1, 2, 3].map(k => i + k < used.length ? factors[used[i + k]] : 0);
    for (let j = 0; j < count; j++) out[j] += fa * a[j] + fb * b[j] + fc * c[j] + fd * d[j];
  }
}

/// A factor of 16-bit numbers, or 0 if its shape nowhere exceeds a limit.
function seen(factor, limit) { return Math.abs(factor) * 32767 < limit ? 0 : factor; }

/// Lets the first `count` items of an attribute be sent to the graphics card before the next picture.
function renew(attribute, count) {
  attribute.updateRange.count = count * attribute.itemSize;
  attribute.needsUpdate = true;
}

/// Largest and least eigenvalue of a symmetric matrix: the cubic in trigonometric form.
function principal(xx, yy, zz, yz, xz, xy) {
  const mean = (xx + yy + zz) / 3, a = xx - mean, b = yy - mean, c = zz - mean;
  const p = Math.sqrt((a * a + b * b + c * c + 2 * (yz * yz + xz * xz + xy * xy)) / 6);
  if (!(p > 0)) return [mean, mean];
  const half = (a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz)) / (2 * p * p * p);
  const phi = Math.acos(clamp(half, -1, 1)) / 3;
  return [mean + 2 * p * Math.cos(phi), mean + 2 * p * Math.cos(phi + 2 * Math.PI / 3)];
}

function mises(xx, yy, zz, yz, xz, xy) {
  return Math.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (yz * yz + xz * xz + xy * xy));
}

class Body {
  constructor(description, arrays) {
    Object.assign(this, {count: description.count, points: arrays.at(description.points), shapes: arrays.at(description.shapes),
                         scale: arrays.at(description.scale), nodes: arrays.at(description.nodes)});
    this.levels = description.levels.map(level => ({...level, index: new THREE.BufferAttribute(new Uint32Array(arrays.at(level.triangles)), 1)}));
    this.triangles = this.levels[0].index.array;
    this.sampled = this.levels.reduce((best, level) => level.count >= ENOUGH ? level : best);  // points that tell how far the body reaches
    if (description.stress) {
      this.stress = arrays.at(description.stress);
      this.stressScale = arrays.at(description.stress_scale);
      this.stressed = arrays.at(description.stressed);
      this.sums = new Float32Array(2 * this.points.length);
    }
  }

  /// The first `count` points.
  place(q, magnify, out, count) {
    out.set(this.points.subarray(0, 3 * count));
    addShapes(out, this.shapes, q.map((value, k) => seen(magnify * value * this.scale[k], INVISIBLE)), this.points.length, 3 * count);
  }

  /// One stress at each of the first `count` points [Pa]; -1e30 at points without.
  stressed_by(q, kind, out, largest, count) {
    this.sums.fill(0, 0, 6 * count);
    addShapes(this.sums, this.stress, q.map((value, k) => seen(value * this.stressScale[k], UNSEEN * largest)), this.sums.length, 6 * count);
    const s = this.sums, component = COMPONENTS.indexOf(kind);
    for (let k = 0, i = 0; k < count; k++, i += 6)
      out[k] = !this.stressed[k] ? -1e30 : component >= 0 ? s[i + component] : kind === "von_mises" ? mises(s[i], s[i + 1], s[i + 2], s[i + 3], s[i + 4], s[i + 5])
        : principal(s[i], s[i + 1], s[i + 2], s[i + 3], s[i + 4], s[i + 5])[kind === "largest" ? 0 : 1];
  }
}

class Flexible {
  constructor(description, body, arrays, tracks, scale) {
    Object.assign(this, {part: description, body, tracks, q: arrays.at(description.coordinates), missing: new Set(description.missing), level: 0});
    this.now = new Float32Array(body.count);
    const g = this.geometry = new THREE.BufferGeometry();
    this.points = body.points.slice();
    this.values = new Float32Array(body.points.length / 3).fill(-1e30);
    if (description.peak) this.peak = Float32Array.from(arrays.at(description.peak.data), v => description.peak.low + description.peak.step * (v + 32767));
    g.setAttribute("position", new THREE.BufferAttribute(this.points, 3).setUsage(THREE.DynamicDrawUsage));
    g.setAttribute("value", new THREE.BufferAttribute(this.values, 1).setUsage(THREE.DynamicDrawUsage));
    g.setIndex(body.levels[0].index);
    this.known = body.points.length / 3;  // points that are placed now
    this.look = new THREE.Vector4(1, 1, 1, 1);
    this.range = new THREE.Vector2();
    this.mesh = new THREE.Mesh(g, new THREE.ShaderMaterial({uniforms: {look: {value: this.look}, scale: {value: scale}, range: {value: this.range}}, vertexShader: FLEXIBLE_VERTEX,
                                                            fragmentShader: FLEXIBLE_FRAGMENT, extensions: {derivatives: true}}));
    this.mesh.frustumCulled = false;
    this.mesh.matrixAutoUpdate = false;
  }

  coordinates(place, rest, amplitude, out = this.now) {
    const n = this.body.count, rows = this.q.length / Math.max(n, 1), row = Math.min(Math.floor(place), rows - 1), next = Math.min(row + 1, rows - 1), share = place - row;
    for (let k = 0; k < n; k++) {
      out[k] = this.q[n * row + k] * (1 - share) + share * this.q[n * next + k];
      if (rest >= 0) out[k] = this.q[n * rest + k] + amplitude * (out[k] - this.q[n * rest + k]);
    }
    return out;
  }

  move(place, rest, amplitude, magnify, stress) {
    const start = 8 * this.part.track, p = this.tracks.poses;
    this.mesh.visible = this.look.w > HIDDEN && !Number.isNaN(p[start]) && !this.missing.has(Math.floor(place));
    if (!this.mesh.visible) return;
    this.mesh.matrix.compose(new THREE.Vector3(p[start], p[start + 1], p[start + 2]),
                             new THREE.Quaternion(p[start + 5], p[start + 6], p[start + 7], p[start + 4]), new THREE.Vector3(1, 1, 1));
    this.mesh.matrixWorldNeedsUpdate = true;
    this.coordinates(place, rest, amplitude);
    this.drawn = {magnify, stress};
    this.form(this.body.levels[this.level].count);
  }

  /// Places the first `count` points, with their stresses.
  form(count) {
    const {magnify, stress} = this.drawn;
    this.known = count;
    this.body.place(this.now, magnify, this.points, count);
    renew(this.geometry.attributes.position, count);
    if (this.body.stress && stress !== "none") {
      if (stress === "peak") this.values.set(this.peak.map((v, k) => this.body.stressed[k] ? v : -1e30));
      else this.body.stressed_by(this.now, stress, this.values, this.tracks.rows > 1 ? this.part.largest : 0, count);
      renew(this.geometry.attributes.value, count);
    }
  }

  /// Draws the coarsest level whose cells are no larger than `cell`. @returns whether that is another one
  detail(cell) {
    const levels = this.body.levels;
    let level = levels.length - 1;
    while (levels[level].cell > cell) level--;
    if (level === this.level) return false;
    this.level = level;
    this.geometry.setIndex(levels[level].index);
    if (levels[level].count > this.known && this.drawn) this.form(levels[level].count);
    return true;
  }

  /// Least and largest value as drawn now.
  extremes() {
    let low = Infinity, high = -Infinity;
    for (const v of this.values.subarray(0, this.known)) if (v > -1e29) { if (v < low) low = v; if (v > high) high = v; }
    return [low, high];
  }

  /// Point number k now, in units of the scene.
  corner(k) {
    if (k >= this.known) this.form(this.points.length / 3);
    return placed(this.tracks.poses, 8 * this.part.track, this.points.subarray(3 * k, 3 * k + 3));
  }
}
