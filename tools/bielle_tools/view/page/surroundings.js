// The grid under the machine, or behind a planar one.

/// 1, 2 or 5 times a power of ten, about the given length
function nice(length) {
  const power = 10 ** Math.floor(Math.log10(length)), share = length / power;
  return power * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
}

class Surroundings {
  constructor(app) {
    const {low, high, size, centre, planar} = app.data, up = upAxis(app.data.gravity), normal = planar === null || planar === up ? up : planar;
    const [a, b] = [(normal + 1) % 3, (normal + 2) % 3], extent = Math.max(high[a] - low[a], high[b] - low[b], 0.2);
    this.step = nice(extent * size / 12);
    const step = this.step / size, level = normal === up ? low[normal] - 0.004 : (normal === 1 ? high[1] + 0.004 : low[normal] - 0.004);
    this.group = new THREE.Group();
    const lines = [[], []], reach = [a, b].map(k => [Math.floor((low[k] - 0.3 * extent + centre[k] / size) / step), Math.ceil((high[k] + 0.3 * extent + centre[k] / size) / step)]);
    [[a, b, 0], [b, a, 1]].forEach(([along, across, which]) => {
      const [from, to] = reach[1 - which];
      for (let k = from; k <= to; k++) {
        for (const end of reach[which]) {
          const p = [0, 0, 0];
          p[normal] = level;
          p[across] = k * step - centre[across] / size;
          p[along] = end * step - centre[along] / size;
          lines[k % 5 === 0 ? 1 : 0].push(...p);
        }
      }
    });
    lines.forEach((points, strong) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(points), 3));
      const object = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({color: strong ? "#aab4c0" : "#ccd4dd"}));
      object.frustumCulled = false;
      object.renderOrder = -1;
      this.group.add(object);
    });
  }
}
