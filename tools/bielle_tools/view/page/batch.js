// All rigid parts of a sequence as one mesh: bones and looks are in textures.

function table(count) {
  const width = Math.min(1024, Math.max(1, count)), height = Math.ceil(Math.max(1, count) / width);
  const data = new Float32Array(4 * width * height);
  const texture = new THREE.DataTexture(data, width, height, THREE.RGBAFormat, THREE.FloatType);
  texture.minFilter = texture.magFilter = THREE.NearestFilter;
  texture.needsUpdate = true;
  return {data, texture, size: new THREE.Vector2(width, height)};
}

class Batch {
  constructor(layout, arrays, tracks, stresses, scale) {
    const b = layout.batch;
    this.parts = layout.parts;
    this.tracks = tracks;
    this.points = arrays.at(b.points);
    this.owners = arrays.at(b.owners);
    this.boneOf = arrays.at(b.bones);
    this.cellOf = arrays.at(b.cells);
    this.triangles = arrays.at(b.triangles);
    this.bones = table(2 * tracks.count);
    this.looks = table(this.parts.length);
    this.range = new THREE.Vector2();
    this.uniforms = {bones: {value: this.bones.texture}, boneSize: {value: this.bones.size}, looks: {value: this.looks.texture}, lookSize: {value: this.looks.size},
                     stresses: {value: stresses.table.texture}, stressSize: {value: stresses.table.size}, scale: {value: scale}, range: {value: this.range}};
    const solid = this.geometry(arrays.at(b.normals), this.triangles), lines = this.geometry(arrays.at(b.normals), arrays.at(b.lines));
    this.group = new THREE.Group();
    this.passes = [[], []];  // objects that draw opaque, and transparent parts
    for (const clear of [0, 1]) {
      const uniforms = {...this.uniforms, clear: {value: clear}};
      const options = {uniforms, vertexShader: RIGID_VERTEX, side: THREE.DoubleSide, transparent: clear > 0, depthWrite: !clear};
      const faces = new THREE.Mesh(solid, new THREE.ShaderMaterial({...options, fragmentShader: RIGID_FRAGMENT, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1}));
      const edges = new THREE.LineSegments(lines, new THREE.ShaderMaterial({...options, fragmentShader: LINE_FRAGMENT}));
      for (const object of [faces, edges]) { object.frustumCulled = false; object.renderOrder = clear; this.passes[clear].push(object); this.group.add(object); }
    }
    const pick = {uniforms: {...this.uniforms, first: {value: 1}}, vertexShader: PICK_VERTEX, fragmentShader: PICK_FRAGMENT, side: THREE.DoubleSide};
    this.pickable = new THREE.Mesh(solid, new THREE.ShaderMaterial(pick));
    this.pickable.frustumCulled = false;
  }

  geometry(normals, index) {
    const g = new THREE.BufferGeometry();
    g.setAttribute("position", new THREE.BufferAttribute(this.points, 3));
    g.setAttribute("normal", new THREE.BufferAttribute(normals, 3, true));
    g.setAttribute("bone", new THREE.BufferAttribute(Float32Array.from(this.boneOf), 1));
    g.setAttribute("owner", new THREE.BufferAttribute(Float32Array.from(this.owners), 1));
    g.setAttribute("cell", new THREE.BufferAttribute(Float32Array.from(this.cellOf), 1));
    g.setIndex(new THREE.BufferAttribute(new Uint32Array(index.buffer, index.byteOffset, index.length), 1));
    return g;
  }

  /// Takes over the poses of the tracks. Bones without a pose go far out of sight.
  moved() {
    const data = this.bones.data, poses = this.tracks.poses;
    data.set(poses);
    for (let k = 0; k < poses.length; k += 8) if (Number.isNaN(poses[k])) data.fill(1e7, k, k + 3), data.fill(0, k + 3, k + 8);
    this.bones.texture.needsUpdate = true;
  }

  /// look(part): [r, g, b, opacity]. All points pass the shaders of each object, so one without parts is not drawn.
  paint(look) {
    const drawn = [false, false];
    this.parts.forEach((part, k) => {
      const found = look(part);
      this.looks.data.set(found, 4 * k);
      drawn[found[3] < CLEAR ? 1 : 0] ||= found[3] > HIDDEN;
    });
    this.passes.forEach((objects, clear) => { for (const object of objects) object.visible = drawn[clear]; });
    this.looks.texture.needsUpdate = true;
  }

  /// A corner of a part where it is drawn now, in units of the scene.
  corner(point) {
    return placed(this.tracks.poses, 8 * this.boneOf[point], this.points.subarray(3 * point, 3 * point + 3));
  }
}
