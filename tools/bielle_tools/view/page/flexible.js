// Flexible bodies: points and stresses as sums of shapes, on the processor. Instances share the shapes of their body.

const COMPONENTS = ["xx", "yy", "zz", "yz", "xz", "xy"];

const INVISIBLE = 2e-7, UNSEEN = 2e-4;  // shares of the size, and of the largest stress, below which a shape is left out

/// out += sum of factors[k] * shapes[k], four shapes at a time; shapes of n numbers follow each other.
function addShapes(out, shapes, factors, n) {
  const used = [];
  for (let k = 0; k < factors.length; k++) if (factors[k] !== 0) used.push(k);
  for (let i = 0; i < used.length; i += 4) {
    const [a, b, c, d] = [0, 1, 2, 3].map(k => shapes.subarray((used[i + k] ?? used[i]) * n, (used[i + k] ?? used[i]) * n + n));
    const [fa, fb, fc, fd] = [0, 1, 2, 3].map(k => i + k < used.length ? factors[used[i + k]] : 0);
    for (let j = 0; j < n; j++) out[j] += fa * a[j] + fb * b[j] + fc * c[j] + fd * d[j];
  }
}

/// A factor of 16-bit numbers, or 0 if its shape nowhere exceeds a limit.
function seen(factor, limit) { return Math.abs(factor) * 32767 < limit ? 0 : factor; }

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
    Object.assign(this, {count: description.count, points: arrays.at(description.points), triangles: arrays.at(description.triangles), shapes: arrays.at(description.shapes),
                         scale: arrays.at(description.scale), nodes: arrays.at(description.nodes)});
    if (description.stress) {
      this.stress = arrays.at(description.stress);
      this.stressScale = arrays.at(description.stress_scale);
      this.stressed = arrays.at(description.stressed);
      this.sums = new Float32Array(2 * this.points.length);
    }
  }

  place(q, magnify, out) {
    out.set(this.points);
    addShapes(out, this.shapes, q.map((value, k) => seen(magnify * value * this.scale[k], INVISIBLE)), this.points.length);
  }

  /// One stress at every point [Pa]; -1e30 at points without.
  stressed_by(q, kind, out, largest) {
    this.sums.fill(0);
    addShapes(this.sums, this.stress, q.map((value, k) => seen(value * this.stressScale[k], UNSEEN * largest)), this.sums.length);
    const s = this.sums, component = COMPONENTS.indexOf(kind);
    for (let k = 0, i = 0; k < out.length; k++, i += 6)
      out[k] = !this.stressed[k] ? -1e30 : component >= 0 ? s[i + component] : kind === "von_mises" ? mises(s[i], s[i + 1], s[i + 2], s[i + 3], s[i + 4], s[i + 5])
        : principal(s[i], s[i + 1], s[i + 2], s[i + 3], s[i + 4], s[i + 5])[kind === "largest" ? 0 : 1];
  }
}

class Flexible {
  constructor(description, body, arrays, tracks, scale) {
    Object.assign(this, {part: description, body, tracks, q: arrays.at(description.coordinates), missing: new Set(description.missing)});
    this.now = new Float32Array(body.count);
    const g = this.geometry = new THREE.BufferGeometry();
    this.points = Float32Array.from(body.points);
    this.values = new Float32Array(body.points.length / 3).fill(-1e30);
    if (description.peak) this.peak = Float32Array.from(arrays.at(description.peak.data), v => description.peak.low + description.peak.step * (v + 32767));
    g.setAttribute("position", new THREE.BufferAttribute(this.points, 3).setUsage(THREE.DynamicDrawUsage));
    g.setAttribute("value", new THREE.BufferAttribute(this.values, 1).setUsage(THREE.DynamicDrawUsage));
    g.setIndex(new THREE.BufferAttribute(new Uint32Array(body.triangles), 1));
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
    this.mesh.visible = this.look.w > 0.002 && !Number.isNaN(p[start]) && !this.missing.has(Math.floor(place));
    if (!this.mesh.visible) return;
    this.mesh.matrix.compose(new THREE.Vector3(p[start], p[start + 1], p[start + 2]),
                             new THREE.Quaternion(p[start + 5], p[start + 6], p[start + 7], p[start + 4]), new THREE.Vector3(1, 1, 1));
    this.mesh.matrixWorldNeedsUpdate = true;
    this.coordinates(place, rest, amplitude);
    this.body.place(this.now, magnify, this.points);
    this.geometry.attributes.position.needsUpdate = true;
    if (this.body.stress && stress !== "none") {
      if (stress === "peak") this.values.set(this.peak.map((v, k) => this.body.stressed[k] ? v : -1e30));
      else this.body.stressed_by(this.now, stress, this.values, this.tracks.rows > 1 ? this.part.largest : 0);
      this.geometry.attributes.value.needsUpdate = true;
    }
  }

  /// Least and largest value as drawn now.
  extremes() {
    let low = Infinity, high = -Infinity;
    for (const v of this.values) if (v > -1e29) { if (v < low) low = v; if (v > high) high = v; }
    return [low, high];
  }

  /// Point number k now, in units of the scene.
  corner(k) { return placed(this.tracks.poses, 8 * this.part.track, this.points.subarray(3 * k, 3 * k + 3)); }
}
