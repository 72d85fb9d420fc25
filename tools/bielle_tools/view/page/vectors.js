// Small algebra on arrays: points [x, y, z], quaternions [w, x, y, z].

function rotate(w, x, y, z, p) {
  const tx = 2 * (y * p[2] - z * p[1]), ty = 2 * (z * p[0] - x * p[2]), tz = 2 * (x * p[1] - y * p[0]);
  return [p[0] + w * tx + y * tz - z * ty, p[1] + w * ty + z * tx - x * tz, p[2] + w * tz + x * ty - y * tx];
}

/// Point in the axes of a bone -> scene; the pose is 8 numbers at `start`: x y z stretch, w x y z.
function placed(poses, start, p) {
  const r = rotate(poses[start + 4], poses[start + 5], poses[start + 6], poses[start + 7], [p[0], p[1], p[2] * poses[start + 3]]);
  return [r[0] + poses[start], r[1] + poses[start + 1], r[2] + poses[start + 2]];
}

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

/// Smallest rotation that takes z to a direction.
function fromZ(d) {
  const n = Math.hypot(...d) || 1, w = 1 + d[2] / n;
  if (w < 1e-9) return [0, 1, 0, 0];
  const q = [w, -d[1] / n, d[0] / n, 0], m = Math.hypot(...q);
  return q.map(c => c / m);
}

function shown(x, digits = 4) {
  if (x === null || x === undefined || Number.isNaN(x)) return "-";
  if (x === 0) return "0";
  const a = Math.abs(x);
  return a >= 1e5 || a < 1e-3 ? x.toExponential(digits - 1) : String(Number(x.toPrecision(digits)));
}

function element(tag, properties = {}, ...children) {
  const found = Object.assign(document.createElement(tag), properties);
  found.append(...children);
  return found;
}
