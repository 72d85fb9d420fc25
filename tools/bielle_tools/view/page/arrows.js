// Arrows of reactions, contact forces, loads and velocities, in their own colours, with a common scale for each kind.

const ARROW_COLOURS = {"reactions": "#a8287a", "contact forces": "#c97a00", "loads": "#cf3d3d", "velocities": "#2f6fb2"};
const ARROW_LENGTH = 0.16;  // of the largest arrow of a kind, in sizes of the scene

class Arrows {
  constructor(descriptions, arrays) {
    this.all = descriptions.map(d => ({...d, origin: arrays.at(d.origin), vector: arrays.at(d.vector)}));
    this.kinds = Object.keys(ARROW_COLOURS).filter(kind => this.all.some(arrow => arrow.kind === kind));
    this.group = new THREE.Group();
    this.meshes = {};
    for (const kind of this.kinds) {
      const count = this.all.filter(arrow => arrow.kind === kind).length;
      const shaft = new THREE.CylinderBufferGeometry(1, 1, 0.75, 10), head = new THREE.CylinderBufferGeometry(0, 2.6, 0.25, 14);
      shaft.translate(0, 0.375, 0);
      head.translate(0, 0.875, 0);
      const material = new THREE.MeshLambertMaterial({color: ARROW_COLOURS[kind]});
      this.meshes[kind] = [shaft, head].map(geometry => new THREE.InstancedMesh(geometry.rotateX(Math.PI / 2), material, count));
      for (const mesh of this.meshes[kind]) { mesh.frustumCulled = false; mesh.visible = false; this.group.add(mesh); }
    }
  }

  largest(kind) { return Math.max(...this.all.filter(arrow => arrow.kind === kind).map(arrow => arrow.largest)); }

  /// shown: set of kinds; scale: factor of the length
  move(place, shown, scale, hidden) {
    for (const kind of this.kinds) {
      for (const mesh of this.meshes[kind]) mesh.visible = shown.has(kind);
      if (!shown.has(kind)) continue;
      const unit = ARROW_LENGTH * scale / this.largest(kind);
      this.all.filter(arrow => arrow.kind === kind).forEach((arrow, k) => {
        const [x, v] = [this.row(arrow.origin, place), this.row(arrow.vector, place)], length = unit * Math.hypot(...v);
        const q = fromZ(v), width = hidden(arrow.entry) || !(length > 1e-5) ? 0 : Math.min(0.0035 + 0.004 * scale, 0.12 * length);
        const matrix = new THREE.Matrix4().compose(new THREE.Vector3(...x), new THREE.Quaternion(q[1], q[2], q[3], q[0]), new THREE.Vector3(width, width, width ? length : 0));
        for (const mesh of this.meshes[kind]) mesh.setMatrixAt(k, matrix);
      });
      for (const mesh of this.meshes[kind]) mesh.instanceMatrix.needsUpdate = true;
    }
  }

  row(values, place) {
    const rows = values.length / 3, row = clamp(Math.floor(place), 0, rows - 1), next = Math.min(row + 1, rows - 1), share = place - row;
    return [0, 1, 2].map(k => values[3 * row + k] + share * (values[3 * next + k] - values[3 * row + k]));
  }
}
